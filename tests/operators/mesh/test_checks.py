"""VERM: defects are found and named, sound meshes are silent."""

from script_runs import ran
from together import together

CUBE = (
    "OPTI DIME 3 ELEM CUB8 ; S = (DROI 1 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
    "V = S VOLU 'TRAN' 1 (0. 0. 1.) ; F = FACE 2 V ; "
)


def names_after(script: str) -> tuple[dict[str, int], str]:
    result = ran(script)
    root = result.session.root
    names = [n for n in ("MESH1", "MESH2", "NODE1", "NODE4", "NODE5") if n in root.names()]
    return {n: getattr(root.find(n), "n_cells", 1) for n in names}, result.output


def test_sound_meshes_are_silent() -> None:
    found, output = names_after(CUBE + "VERM V ; VERM (CHAN V 'QUAF') ; VERM (CHAN 'TET4' V) ;")
    assert found == {}
    assert "VERM" not in output


@together(
    "statements, expected",
    [
        ("VERM (V ET (CHAN 'CUB8' V) ET S ET (INVE S)) ;", {"MESH1": 1}),
        ("VERM (V ET (CHAN 'QUAD' (F VOLU 'TRAN' 1 (0. 0. 1.)))) ;", {"NODE1": 1, "NODE4": 1}),
        ("VERM (V ET (CHAN 'TET4' (F VOLU 'TRAN' 1 (0. 0. 1.)))) ;", {"MESH1": 2}),
    ],
)
def test_defects_are_named(statements: str, expected: dict[str, int]) -> None:
    found, output = names_after(CUBE + statements)
    assert found == expected
    assert f"({' ... '.join(expected)})" in output


@together("phrase", ["M 'CORR'", "'CORR' M"])
def test_corrected_meshes_have_each_cell_once(phrase: str) -> None:
    script = CUBE + f"M = V ET S ET (INVE S) ; N = VERM {phrase} ; VERM N ;"
    result = ran(script)
    assert result.output.count("VERM") == 1
    assert result.session.root.find("N").n_cells == 2

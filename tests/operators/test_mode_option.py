"""OPTI 'MODE' takes back what VALE 'MODE' says."""

from script_runs import ran
from together import together


@together(
    "dimension, mode, said",
    [
        (2, "PLAN CONT", "PLANCONT"),
        (2, "PLAN DEFO", "PLANDEFO"),
        (2, "PLAN GENE", "PLANGENE"),
        (2, "AXIS", "AXIS"),
        (1, "UNID", "UNIDPLANDYDZ"),
    ],
)
def test_mode_is_set_again_by_its_own_word(dimension, mode, said):
    result = ran(
        f"OPTI DIME {dimension} MODE {mode} ; M = VALE 'MODE' ; OPTI DIME 3 ; "
        f"OPTI DIME {dimension} ; OPTI 'MODE' M ; N = VALE 'MODE' ; "
        f"L = (EGA M N) ET (EGA M '{said}') ;"
    )
    assert result.session.root.find("L") is True


def test_a_mode_of_the_plane_gives_way_in_space():
    result = ran("OPTI 'DIME' 3 'ELEM' CUB8 'MODE' 'PLAN' ; M = VALE 'MODE' ;")
    assert result.session.root.find("M") == "TRID"
    assert [w.code for w in result.session.warnings] == ["operators.session.mode-in-space"]


@together("word, told", [("JAUMANN", 1), ("'QUAD'", 1), ("LINEAIRE", 0)])
def test_a_measure_of_strains_that_changes_nothing_is_told(word, told):
    warnings = ran(f"OPTI EPSILON {word} ;").session.warnings
    assert [w.code for w in warnings] == ["operators.session.strain-measure-without-effect"] * told

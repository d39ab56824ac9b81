"""EXPLORER: what it draws of a PASAPAS table, against an elastic bar in tension."""

import numpy as np
import pytest
import pyvista
from script_runs import ran

from ssilang.cli.run import run_text
from ssilang.operators.drawing import curves, scenes

BAR = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L = (0. 0.) DROI 2 (2. 0.) ; S = L TRAN 1 (0. 1.) ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; T = TABL 'PASAPAS' ; T . 'MODELE' = MO ;
T . 'CARACTERISTIQUES' = MATE MO 'YOUN' 10. 'NU' 0. ; P = S POIN 'PROC' (2. 0.) ;
B = (BLOQ 'UX' (COTE 4 S)) ET (BLOQ 'UY' L) ; T . 'BLOCAGES_MECANIQUES' = B ;
D = BLOQ 'UX' (COTE 2 S) ; T . 'BLOCAGES_MECANIQUES' = B ET D ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI D 0.2) (EVOL 'MANU' (PROG 0. 2.) (PROG 0. 2.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. 2. ; PASAPAS T ; O = TABL ; O . 'EVOL' = TABL ; E = O . 'EVOL' ;
"""


@pytest.fixture
def drawn(unsaved, monkeypatch, tmp_path):
    """Runs statements after BAR; what goes to DESS and TRAC."""

    def explore(text):
        found = []
        for module, name in ((curves, "draw_curves"), (scenes, "draw_scene")):
            real = getattr(module, name)

            def seen(first, *rest, _real=real, **named):
                found.append(first)
                return _real(first, *rest, **named)

            monkeypatch.setattr(module, name, seen)
        result = run_text(BAR + text, tmp_path)
        return result, found

    return explore


CURVES = [
    ("E . 'TYPE' = MOT 'TEMP' ; E . 'COMP' = MOT 'UX' ; E . 'POIN' = P", "'DEPL'", [[0, 0.2, 0.4]]),
    ("E . 'TYPE' = MOT 'TEMP' ; E . 'COMP' = MOT 'SMXX'", "'CONT'", [[0, 1, 2]]),
    (
        "E . 'TYPE' = MOT 'TEMP' ; E . 'COMP' = MOT 'SMXX' ; E . 'ELEM' = 2 ; E . 'PTG' = 4",
        "'CONT'",
        [[0, 1, 2]],
    ),
    (
        "E . 'TYPE' = MOT 'ESPA' ; E . 'COMP' = MOT 'UX' ; E . 'LIGN' = L",
        "'DEPL'",
        [[0, 0, 0], [0, 0.1, 0.2], [0, 0.2, 0.4]],
    ),
    (
        "E . 'TYPE' = MOT 'ESPA' ; E . 'COMP' = MOT 'SMXX' ; E . 'LIGN' = L",
        "'CONT'",
        [[0, 0, 0], [1, 1, 1], [2, 2, 2]],
    ),
]


@pytest.mark.parametrize(
    ("entries", "word", "truth"), CURVES + [(entries, "", truth) for entries, _, truth in CURVES]
)
def test_curves_in_time_and_along_a_line_are_those_of_the_bar(drawn, entries, word, truth):
    result, found = drawn(entries + f" ; EXPLORER T (MOTS {word} 'EVOL') O ;")
    assert result.exit_code == 0, result.message
    (evolution,) = found
    ordinates = [c.ordinates for c in evolution.parts]
    np.testing.assert_allclose(ordinates, truth, atol=1e-12)


@pytest.mark.parametrize(
    ("words", "scale"),
    [
        ("", None),
        ("(MOTS 'DEPL' 'CONT' 'SMXX') O", 3.0),
        ("(MOTS 'DEPL' 'REAC') O", 3.0),
        ("(MOTS 'CONT')", 0.0),
        ("(MOTS 'DEPL' 'VAR') O", 3.0),
    ],
)
def test_one_picture_is_drawn_for_each_time(drawn, words, scale):
    result, found = drawn(f"O . 'AMPL' = 3. ; EXPLORER T {words} ;")
    assert result.exit_code == 0, result.message
    assert len(found) == 3
    if scale is not None:
        assert {max(layer.scale for layer in layers) for layers in found} == {scale}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("(MOTS 'SMXX')", "is neither DEPL REAC"),
        ("(MOTS 'TEMP')", "no index TEMPERATURES"),
        ("(MOTS 'DEPL' 'EVOL') O", "no index TYPE"),
    ],
)
def test_requests_that_lack_something_are_refused(drawn, words, said):
    result, _ = drawn(f"EXPLORER T {words} ;")
    assert result.exit_code == 1
    assert said in result.message


def test_a_curve_of_no_field_is_refused(drawn):
    result, _ = drawn(
        "E . 'TYPE' = MOT 'TEMP' ; E . 'COMP' = MOT 'RZ' ; EXPLORER T (MOTS 'EVOL') O ;"
    )
    assert "has the component RZ" in result.message


LOADING = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L = (0. 0.) DROI 2 (2. 0.) ; S = L TRAN 1 (0. 1.) ;
T = TABL ; T . 'MODELE' = MODE S 'MECANIQUE' 'ELASTIQUE' ; O = TABL ;
E = EVOL 'MANU' (PROG 0. 1. 3.) (PROG 0. 2. 4.) ; TT = TABL ; TT . 0 = 0. ; TT . 1 = 5. ;
W = NOMC 'T' (COOR 1 S) ; TC = TABL ; TC . 0 = W ; TC . 1 = 3. * W ;
F = MANU 'CHPO' (2. 1.) 'FX' 1. 'FY' -10. 'NATURE' 'DISCRET' ;
D = MANU 'CHML' (T . 'MODELE') 'EPXX' 1. 'EPYY' 2. 'TYPE' 'DEFORMATIONS' 'STRESSES' ;
T . 'CHARGEMENT' = (CHAR 'MECA' F E) ET (CHAR 'T' TT TC) ET (CHAR 'DEFI' D) ;
"""


@pytest.fixture
def loading_drawn(monkeypatch, tmp_path):
    """Runs statements after LOADING; what goes to TRAC."""

    def explore(text):
        found = []
        real = scenes.draw_scene
        monkeypatch.setattr(
            scenes, "draw_scene", lambda f, *r, **n: (found.append(f), real(f, *r, **n))[1]
        )
        return run_text(LOADING + text, tmp_path), found

    return explore


@pytest.mark.parametrize(
    ("options", "count"),
    [
        ("", 3 + 2 + 1),
        ("O . 'TYPE' = MOT 'T' ;", 2),
        ("O . 'TYPE' = MOT 'MECA' ; O . 'COMP' = MOT 'FY' ;", 3),
        ("O . 'COMP' = MOT 'EPYY' ;", 1),
        ("O . 'COMP' = MOT 'UZ' ;", 0),
    ],
)
def test_explorer_draws_each_part_of_a_loading_at_each_of_its_times(loading_drawn, options, count):
    result, found = loading_drawn(options + " EXPLORER T 'CHAR' O ;")
    assert result.exit_code == 0, result.message
    assert len(found) == count
    assert ("no field" in result.output) == (count == 0)


def test_explorer_wants_a_loading_to_draw(loading_drawn):
    result, found = loading_drawn("OUBL T 'CHARGEMENT' ; EXPLORER T 'CHAR' ;")
    assert result.exit_code == 1
    assert "CHARGEMENT" in result.message
    assert not found


def test_explorer_knows_one_word_alone(loading_drawn):
    result, _ = loading_drawn("EXPLORER T 'DEPL' ;")
    assert result.exit_code == 1
    assert "LISTMOTS" in result.message


MODES = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((0. 0.) DROI 4 (4. 0.)) TRAN 2 (0. 1.) ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 1.E3 'NU' 0. 'RHO' 1. ; O = TABL ;
R = (RIGI MO MA) ET (BLOQ 'DEPL' (COTE 4 S)) ; T = VIBR 'SIMU' 1. 2 R (MASS MO MA) 'TBAS' ;
O . 'MAILLAGE' = S ; LD = COTE 2 S ;
"""


def test_modes_go_to_paraview_one_a_time(tmp_path):
    text = MODES + "O . 'FICHIER_VTK' = 'shapes' ; EXPLORER T (MOTS 'VTK') O ; "
    text += "OPTI 'SORT' 'kept' ; EXPLORER T (MOTS 'VTK') O ; SORT 'CHAI' 'a' ; "
    result = ran(text, tmp_path)
    collection = (tmp_path / "shapes.pvd").read_text()
    steps = [s.split('"') for s in collection.split("<DataSet ")[1:]]
    assert len(steps) == 2
    read = pyvista.read(tmp_path / steps[0][steps[0].index(" file=") + 1])
    shape = result.session.root.find("T").get("MODES").get(1).get("DEFORMEE_MODALE")
    written = np.abs(read.point_data["SHAPE"]).max()
    parts = shape.components
    assert written == pytest.approx(max(np.abs(parts[n].values).max() for n in ("UX", "UY")))
    assert (tmp_path / "kept").read_text() == "a\n"


def test_modes_are_drawn_with_arrows_a_second_mesh_and_words_for_trac(monkeypatch, tmp_path):
    found, real = [], scenes.draw_scene

    def seen(layers, *rest, **named):
        found.append((layers, rest, named))
        return real(layers, *rest, **named)

    monkeypatch.setattr(scenes, "draw_scene", seen)
    text = MODES + (
        "O . 'MAILLAGE_2' = LD ; O . 'MAILLAGE_VECTEUR' = LD ; O . 'TITRE' = MOT 'DEPL' ; "
        "O . 'LEGENDES' = MOTS 'first' 'second' ; O . 'OPTIONS_TRAC' = 'CACH NCLK' ; "
        "EXPLORER T (MOTS 'DEFO') O ;"
    )
    ran(text, tmp_path)
    assert [len(layers) for layers, _, _ in found] == [2, 2]
    assert [layers[1].scale for layers, _, _ in found] == [0.0, 0.0]
    (moved, _), (_, options, *_), _ = found[0]
    assert sorted(moved.arrows.parts[0].origins[:, 1]) == [0.0, 0.5, 1.0]
    assert set(moved.arrows.parts[0].origins[:, 0]) == {4.0}  # the end of the beam alone
    assert options.title.startswith("DEPL mode 1 :")
    assert options.title.endswith(" Hz first")
    assert options.hidden

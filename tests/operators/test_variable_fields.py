"""A tension test, clay in PASAPAS, VARI: parameters that are curves and fields."""

import numpy as np
import pytest
from script_runs import ran

from ssilang.cli.run import run_text
from ssilang.operators.fields.cell_extraction import _variables

PLATE = (
    "OPTI DIME 2 ELEM QUA4 ; P1 = 0. 0. ; P2 = 2. 0. ; L = DROI 2 P1 P2 ; S = TRAN 1 L (0. 1.) ; "
    "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; X Y = COOR S ; T = NOMC 'T' (X * 50.) ; "
    "E = EVOL 'MANU' 'T' (PROG 0. 100.) 'YOUN' (PROG 2.E11 1.E11) ; "
)


def test_nodal_field_through_a_law(found):
    top, names = found(PLATE + "C = VARI T E ; A = MINI C ; N = EXTR C 'COMP' ;", "A", "N")
    assert top == pytest.approx(1e11)
    assert [str(w) for w in names.values] == ["YOUN"]


def test_laws_in_cells_stand_at_the_support(found):
    """The temperatures at the centres x = 0.5 and 1.5 of the two cells are 25 and 75."""
    field, given = found(
        PLATE + "C = VARI MO T E 'GRAVITE' ; MA = MATE MO 'YOUN' E 'NU' 0.3 ; "
        "P = VARI 'NUAG' MO MA T 'GRAVITE' ;",
        "C", "P",
    )  # fmt: skip
    assert field.title == "SCALAIRE"
    assert field.blocks[0].support == "GRAVITE"
    block = given.blocks[0].components
    for values in (field.blocks[0].components["SCAL"], block["YOUN"]):
        np.testing.assert_allclose(np.ravel(values), [1.75e11, 1.25e11])
    assert float(np.ravel(block["NU"])[0]) == 0.3


@pytest.mark.parametrize("order", ["'NU' 0.3 'YOUN' F 'RHO' 2.", "'YOUN' F 'RHO' 2. 'NU' 0.3"])
def test_numbers_stand_where_a_field_beside_them_does(found, order):
    field, apart, plain = found(
        PLATE + "F = CHAN 'STRESSES' MO (CHAN 'CHAM' (5. + (0. * X)) MO) ; "
        f"A = MATE MO {order} ; B = (RIGI MO A) - (RIGI MO (MATE MO 'YOUN' 5. 'NU' 0.3)) ; "
        "C = MAXI 'ABS' (B * (NOMC 'UX' (X * Y))) ; D = MAXI 'ABS' ((RIGI MO A) * (NOMC 'UX' X)) ;",
        "A", "C", "D",
    )  # fmt: skip
    (block,) = field.blocks
    assert (block.support, set(block.components)) == ("STRESSES", {"YOUN", "NU", "RHO"})
    assert apart < 1e-12 * plain


def test_what_variable_components_depend_on_is_told():
    text = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; "
        "E = EVOL 'MANU' 'T' (PROG 0. 1.) 'YOUN' (PROG 1. 2.) ; "
        "F = EVOL 'MANU' 'DOSE' (PROG 0. 1.) 'NU' (PROG 0.2 0.3) ; "
        "MA = MATE MO 'YOUN' E 'NU' F 'RHO' 3. ; "
        "LIST (EXTR MA 'DEVA') ; LIST (EXTR MA 'COVA') ; "
    )
    result = ran(text)
    lines = result.output.split("\n")
    assert lines[1].split() == ["T", "DOSE"]
    assert lines[3].split() == ["YOUN", "NU"]
    result = run_text(text.replace("YOUN' E 'NU' F", "YOUN' 1. 'NU' 0."))
    assert "0 words" in result.output


def test_a_cloud_depends_on_its_columns_and_on_the_abscissas_of_its_curves():
    result = ran(
        "F = EVOL 'MANU' 'DOSE' (PROG 0. 1.) 'NU' (PROG 0.2 0.3) ; "
        "N = NUAG 'COMP' 'P' 1. 2. 'COMP' 'NU' F F ; "
    )
    assert _variables(result.session.root.find("N")) == ["P", "DOSE"]


def test_a_law_of_two_fields_may_take_one_after_the_other(found):
    """Between curves at two temperatures, at abscissas of both; beyond the last, as there."""
    script = PLATE.replace("X * 50.", "(X * 100.) - 20.") + (
        "D = NOMC 'DOSE' (0.15 + (0.1 * X)) ; "
        "F = EVOL 'MANU' 'DOSE' (PROG 0. 0.1 0.4) 'NU' (PROG 0.1 0.3 0.2) ; "
        "G = EVOL 'MANU' 'DOSE' (PROG 0. 0.23 0.4) 'NU' (PROG 0.4 0.12 0.14) ; "
        "N = NUAG 'COMP' 'T' 0. 100. 'COMP' 'NU' F G ; MA = MATE MO 'YOUN' 1. 'NU' N ; "
        "H = VARI 'NUAG' MO MA T 'GRAVITE' ; C = VARI 'NUAG' MO H D 'GRAVITE' ; "
        "B = VARI 'NUAG' MO MA (T ET D) 'GRAVITE' ;"
    )
    dose = np.array([0.2, 0.3])  # at the centres, where it is 30 and 130 degrees
    cold = np.interp(dose, [0, 0.1, 0.4], [0.1, 0.3, 0.2])
    warm = np.interp(dose, [0, 0.23, 0.4], [0.4, 0.12, 0.14])
    wanted = cold + np.array([0.3, 1.0]) * (warm - cold)
    for field in found(script, "C", "B"):
        np.testing.assert_allclose(np.ravel(field.blocks[0].components["NU"]), wanted)


BAR = (
    "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; B = 1. 0. ; L = DROI 1 A B ; "
    "M = MODE L MECANIQUE ELASTIQUE PLASTIQUE ISOTROPE BARR ; "
)
PULLED = (
    "BA = BLOQ 'UX' 'UY' A ; BB = BLOQ 'UX' B ; BC = BLOQ 'UY' B ; "
    "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; "
    "C = CHAR 'DIMP' (DEPI BB 0.03) E ; T = TABL ; T . 'MODELE' = M ; "
    "T . 'CARACTERISTIQUES' = MA ; T . 'BLOCAGES_MECANIQUES' = BA ET BB ET BC ; "
    "T . 'CHARGEMENT' = C ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; PASAPAS T ; "
    "X = MAXI (EXCO 'EFFX' (T . 'CONTRAINTES' . 10)) ; "
)


def material(curve, young="200.E9"):
    return BAR + f"MA = MATE M 'YOUN' {young} 'NU' 0.3 'SECT' 1. 'TRAC' ({curve}) ; "


STRAINS = np.array([0.0, 1e-3, 2e-2, 1e-1])
COLD, WARM = np.array([0.0, 200e6, 300e6, 340e6]), np.array([0.0, 200e6, 220e6, 230e6])


def curve(stresses):
    x, y = (" ".join(map(repr, v.tolist())) for v in (STRAINS, stresses))
    return f"(EVOL 'MANU' 'EPS' (PROG {x}) 'SIG' (PROG {y}))"


@pytest.mark.parametrize("share", [0.0, 0.25])
def test_a_pulled_bar_follows_its_tension_curve(found, share):
    """Alone, or between those of two temperatures: as far from both at the same plastic strain."""
    between = f"NUAG 'COMP' 'T' 0. 100. 'COMP' 'TRAC' {curve(COLD)} {curve(WARM)}"
    there = f"MA = VARI 'NUAG' M MA (MANU 'CHPO' L 1 'T' {100 * share}) 'STRESSES' ; "
    text = material(between) + there if share else material(curve(COLD))
    stress = found(text + PULLED, "X")
    at, parts = 0.03 - stress / 200e9, (COLD, WARM)
    flow = [np.interp(at, (STRAINS - part / 200e9)[1:], part[1:]) for part in parts]
    assert stress == pytest.approx((1 - share) * flow[0] + share * flow[1], rel=1e-6)

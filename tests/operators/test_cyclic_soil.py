"""PLASTIQUE IWAN in scripts: sheared cells in statics and dynamics, bad curves told at MATE."""

import numpy as np
import pytest
from references.masing import Masing, polygon
from references.soil_column import Column, bundle
from together import together

from ssilang.cli.run import run_text

SQUARE = (
    "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; "
    "S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; LOW = S POIN 'DROI' (0. 0.) (1. 0.) 1.E-6 ; "
    "TOP = S POIN 'DROI' (0. 1.) (1. 1.) 1.E-6 ; ACROSS = BLOQ 'UY' TOP ; "
)
CUBE = (
    "OPTI DIME 3 ELEM CUB8 ; "
    "S = ((DROI 1 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 0. 1.)) VOLU 1 'TRAN' (0. 1. 0.) ; "
    "LOW = S POIN 'PLAN' (0. 0. 0.) (1. 0. 0.) (0. 0. 1.) 1.E-6 ; "
    "TOP = S POIN 'PLAN' (0. 1. 0.) (1. 1. 0.) (0. 1. 1.) 1.E-6 ; ACROSS = BLOQ 'UY' 'UZ' TOP ; "
)
MODEL = "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'IWAN' ; "
CURVE = "(EVOL 'MANU' (PROG 1.E-5 1.E-4 1.E-3 1.E-2) (PROG 1. 0.8 0.3 0.05))"
STRAINS, RATIOS = np.array([1e-5, 1e-4, 1e-3, 1e-2]), np.array([1.0, 0.8, 0.3, 0.05])
GIVEN = f"'GGAM' {CURVE}"
# simple shear: no unknown is left but what is imposed
CYCLED = (
    "MOVED = BLOQ 'UX' TOP ; C = CHAR 'DIMP' (DEPI MOVED 1.) (EVOL 'MANU' (PROG 0. 1. 2. 3. 4.) "
    "(PROG 0. 2.E-3 -1.E-3 5.E-4 4.E-3)) ; T = TABL ; T . 'MODELE' = M ; "
    "T . 'CARACTERISTIQUES' = MA ; "
    "T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' LOW) ET ACROSS ET MOVED ; "
    "T . 'CHARGEMENT' = C ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.25 4. ; PASAPAS T ; "
) + " ".join(f"X{i} = MAXI (EXCO 'SMXY' (T . 'CONTRAINTES' . {i})) ;" for i in range(1, 17))
NAMES = [f"X{i}" for i in range(1, 17)]
PATH = np.interp(np.arange(1, 17) * 0.25, [0, 1, 2, 3, 4], [0, 2e-3, -1e-3, 5e-4, 4e-3])


def material(given=GIVEN):
    return MODEL + f"MA = MATE M 'YOUN' 2.6E8 'NU' 0.3 'RHO' 2000. {given} ; "


def wanted(strains=STRAINS, ratios=RATIOS):
    rules = Masing(polygon(1e8, np.asarray(strains), np.asarray(ratios)))
    return [rules.go(g) for g in PATH]


@pytest.mark.parametrize("body", [SQUARE, CUBE], ids=["plane", "space"])
def test_a_sheared_cell_follows_masings_rules(found, body):
    assert found(body + material() + CYCLED, *NAMES) == pytest.approx(wanted(), rel=1e-9)


@together("body", [SQUARE, CUBE])
@together("last, told", [(5e-3, False), (3.9e-3, True), (1.5e-3, True)])
def test_strains_beyond_the_last_point_of_a_curve_are_told(body, last, told):
    """Also where the path has come back; what an earlier calculation reached is not told again."""
    given = f"'GGAM' (EVOL 'MANU' (PROG 1.E-5 1.E-4 {last}) (PROG 1. 0.8 0.1))"
    back = CYCLED.replace("4.E-3", "0.") if last == 1.5e-3 else CYCLED
    more = "T . 'TEMPS_CALCULES' = PROG 4. 'PAS' 0.25 5. ; PASAPAS T ; "
    result = run_text(body + material(given) + back + more)
    assert not result.errors
    found = [w for w in result.session.warnings if w.code == "operators.dynamics.beyond-curve"]
    assert [w.data["share"] for w in found] == pytest.approx([100.0] * told)


@pytest.mark.parametrize("given", ["'GAMR' 3.E-4", "'GAMR' (MANU 'CHML' M 'GAMR' 3.E-4)"])
def test_a_reference_strain_stands_for_a_hyperbola(found, given):
    """Its polygon is within 0.56 % of the hyperbola: a branch adds twice that, a turn once."""
    stress = found(SQUARE + material(given) + CYCLED, *NAMES)
    rules = Masing(lambda g: 1e8 * g / (1 + abs(g) / 3e-4))
    assert stress == pytest.approx([rules.go(g) for g in PATH], abs=3 * 0.0056 * 1e8 * 3e-4)


def test_a_cell_under_a_shaken_base_moves_as_masses_on_springs(found):
    """One cell, base held, in the frame of the base: against explicit steps forty times finer."""
    script = SQUARE + material() + (
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = MA ; MAS = MASS M MA ; "
        "T . 'RIGI' = (RIGI M MA) ET (BLOQ 'DEPL' LOW) ET ACROSS ; T . 'MASS' = MAS ; "
        "LT = PROG 0. 'PAS' 1.E-4 0.04 ; "
        "PUSH = MAS * (MANU 'CHPO' S 1 'UX' -1.) ; "
        "T . 'CHAR' = CHAR 'MECA' PUSH (EVOL 'MANU' LT (200. * (SIN (18000. * LT)))) ; "
        "T . 'TEMPS_CALCULES' = LT ; T . 'PAS_SAUVES' = 'TOUS' ; R = DYNAMIC T ; "
        "U = EXTR (EVOL 'TEMP' R 'DEPL' 'UX' (S POIN 'PROC' (0. 1.))) 'ORDO' ; "
        "E = (MAXI (ABS (T . 'ENERGIES' . 'ECART'))) / (MAXI (T . 'ENERGIES' . 'DISSIPEE')) ; "
    )  # fmt: skip
    top, balance = found(script, "U", "E")
    strains, shares = bundle(STRAINS, RATIOS)
    one = np.ones(1)
    column = Column(one, 2000.0 * one, 1e8 * one, strains[None], shares[None])
    fine = np.arange(0, 0.04 + 1e-9, 2.5e-6)
    u, strain, _ = column.shaken(200.0 * np.sin(100 * np.pi * fine), 2.5e-6)
    assert np.abs(strain).max() > 10 * STRAINS[1]  # far beyond elasticity
    assert np.abs(np.asarray(top.values) - u[::40, 0]).max() < 2e-3 * np.abs(u).max()
    assert balance < 1e-9


@together(
    "given",
    [
        "'GAMR' 0.05",
        "'GGAM' (EVOL 'MANU' (PROG 1.E-3 1.E-2 1.E-1) (PROG 1. 0.8 0.3))",
    ],
)
def test_strains_in_percent_are_suspected(given):
    for script, wanted in ((given, ["operators.models.strains-in-percent"]), (GIVEN, [])):
        result = run_text(SQUARE + material(script))
        assert [w.code for w in result.session.warnings] == wanted


TRIAXIAL = (
    "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = MA ; "
    "T . 'BLOCAGES_MECANIQUES' = HELD ET MOVED ; "
    "T . 'CHARGEMENT' = (CHAR 'DIMP' (DEPI MOVED 1.) (EVOL 'MANU' (PROG 0. 1. 2. 3. 4.) "
    "(PROG 0. -2.E-3 1.E-3 -5.E-4 -4.E-3))) ET (CHAR 'MECA' SIDE (EVOL 'MANU' (PROG 0. 1. 4.) "
    "(PROG 0. 1. 1.))) ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.5 4. ; PASAPAS T ; "
)
ROUND = (
    "OPTI DIME 2 ELEM QUA4 MODE AXIS ; S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; "
    "LOW = S POIN 'DROI' (0. 0.) (1. 0.) 1.E-6 ; TOP = S POIN 'DROI' (0. 1.) (1. 1.) 1.E-6 ; "
    "HELD = (BLOQ 'UZ' LOW) ET (BLOQ 'UR' (S POIN 'DROI' (0. 0.) (0. 1.) 1.E-6)) ; "
    "MOVED = BLOQ 'UZ' TOP ; "
)
QUARTER = (
    "HELD = (BLOQ 'UY' LOW) ET (BLOQ 'UX' (S POIN 'PLAN' (0. 0. 0.) (0. 1. 0.) (0. 0. 1.) 1.E-6)) "
    "ET (BLOQ 'UZ' (S POIN 'PLAN' (0. 0. 0.) (1. 0. 0.) (0. 1. 0.) 1.E-6)) ; "
    "MOVED = BLOQ 'UY' TOP ; "
)


def test_a_round_sample_pressed_and_stretched_has_the_stresses_of_a_cube(found):
    """Triaxial cycles under a pressure on the side, about the axis and in space: to rounding."""
    along = " ".join(
        f"X{i} = MAXI (EXCO '{{0}}' (T . 'CONTRAINTES' . {i})) ; "
        f"Y{i} = MAXI (EXCO '{{1}}' (T . 'CONTRAINTES' . {i})) ; " for i in range(1, 9)
    )  # fmt: skip
    names = [f"{n}{i}" for i in range(1, 9) for n in "XY"]
    side = "SIDE = PRES 'MASS' M 4.E4 (S POIN 'DROI' (1. 0.) (1. 1.) 1.E-6) ; "
    # of a mesh of faces: those at x = 1 and at z = 1
    sides = "SIDE = PRES 'MASS' M 4.E4 (({}) ET ({})) ; ".format(
        *(
            f"(ENVE S) ELEM 'APPU' 'STRI' (S POIN 'PLAN' {p} 1.E-6)"
            for p in ("(1. 0. 0.) (1. 1. 0.) (1. 0. 1.)", "(0. 0. 1.) (1. 0. 1.) (0. 1. 1.)")
        )
    )
    side = side.replace("(S POIN", "((CONT S) ELEM 'APPU' 'STRI' (S POIN").replace(
        "1.E-6) ;", "1.E-6)) ;"
    )
    round_ = found(ROUND + material() + side + TRIAXIAL + along.format("SMZZ", "SMRR"), *names)
    cube = found(
        CUBE + QUARTER + material() + sides + TRIAXIAL + along.format("SMYY", "SMXX"), *names
    )
    assert np.ptp(round_[::2]) > 1e5
    assert round_[3::2] == pytest.approx([-4e4] * 7, rel=1e-7)
    assert round_ == pytest.approx(cube, rel=1e-9, abs=1e-3)

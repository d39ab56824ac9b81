"""Expansion of shells: free plates and rings move as the closed forms say, held ones press."""

from functools import partial
from pathlib import Path

import pytest
import script_runs
from together import together

ALPHA, THICKNESS = 1e-5, 0.1
LOWER, MIDDLE, UPPER = 0.0, 30.0, 60.0
SKINS = f"'TINF' {LOWER} 'T' {MIDDLE} 'TSUP' {UPPER}"
CELLS = dict.fromkeys(("DKT", "DST", "COQ3"), "TRI3")
CELLS |= {"COQ4": "QUA4", "COQ6": "TRI6", "COQ8": "QUA8"}


@pytest.fixture
def found(tmp_path: Path):
    """Function `(script, *names)`: the objects of these names; the script must succeed."""
    return partial(script_runs.found, folder=tmp_path)


def plate(element: str, temperatures: str) -> str:
    """2 m by 1 m in the plane z = 0, and the load of a temperature."""
    return (
        f"OPTI DIME 3 MODE TRID ELEM {CELLS[element]} ; O = 0 0 0 ; "
        "Q = (DROI 4 O (2 0 0)) TRAN 2 (0 1 0) ; P = Q POIN 'PROC' (2. 1. 0.) ; "
        f"M = MODE Q 'MECANIQUE' 'ELASTIQUE' '{element}' ; "
        f"A = MATE M 'YOUN' 1.E9 'NU' 0.3 'ALPH' {ALPHA} 'EPAI' {THICKNESS} ; "
        f"S = THET M A (MANU 'CHPO' Q {temperatures}) ; "
    )


@together("element", sorted(CELLS))
def test_plate_warmer_on_its_upper_skin_grows_and_bends(found, element: str) -> None:
    x, y, z = found(
        plate(element, SKINS)
        + "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' O)) (BSIG M S A) ; "
        "X = EXTR U 'UX' P ; Y = EXTR U 'UY' P ; Z = EXTR U 'UZ' P ;",
        "X", "Y", "Z",
    )  # fmt: skip
    mean, curvature = ALPHA * MIDDLE, ALPHA * (UPPER - LOWER) / THICKNESS
    assert x == pytest.approx(2 * mean, rel=2e-3)  # drilling springs off by a few 1e-6
    assert y == pytest.approx(mean, rel=2e-3)
    assert z == pytest.approx(-curvature * (2**2 + 1**2) / 2, rel=2e-3)


def test_mean_of_a_parabola_across_holds_the_plate(found) -> None:
    """Simpson's rule is exact: N = E h a (TINF + 4 T + TSUP) / 6 / (1 - nu)."""
    n, m, still = found(
        plate("DKT", "'TINF' 0. 'T' 30. 'TSUP' 12.")
        + "N = MAXI (EXCO 'N22' S) ; M1 = MAXI (EXCO 'M11' S) ; "
        f"A = MATE M 'YOUN' 1.E9 'NU' 0.3 'EPAI' {THICKNESS} ; "  # that nothing says to grow
        "Z = MAXI (THET M A (MANU 'CHPO' Q 'T' 30.)) 'ABS' ;",
        "N", "M1", "Z",
    )  # fmt: skip
    assert still == 0.0
    assert n == pytest.approx(1e9 * THICKNESS * ALPHA * (4 * 30.0 + 12.0) / 6 / 0.7)
    assert m == pytest.approx(1e9 * THICKNESS**3 / 12 * ALPHA * 12.0 / THICKNESS / 0.7)


def test_points_across_a_thick_shell_see_the_parabola(found) -> None:
    stress = found(plate("COQ8", "'TINF' 0. 'T' 30. 'TSUP' 12."), "S").blocks[0].components["SMSS"]
    height = 1 / 3**0.5
    for side, points in ((-1, stress[:, :4]), (1, stress[:, 4:])):
        warm = 30.0 + 6.0 * side * height - 24.0 / 3
        assert points == pytest.approx(1e9 * ALPHA * warm / 0.7)


@pytest.mark.parametrize("temperatures", ["'T' 30.", SKINS])
def test_a_warm_tube_grows_without_stress_far_from_its_ends(found, temperatures: str) -> None:
    radius, stress = found(
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; P = 3. 0. ; L = DROI 4 P (3. 1.) ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'COQ2' ; "
        f"A = MATE M 'YOUN' 1.E9 'NU' 0.3 'ALPH' {ALPHA} 'EPAI' {THICKNESS} ; "
        "U = RESO ((RIGI M A) ET (BLOQ 'UZ' P) ET (BLOQ 'RT' L)) "
        f"(BSIG M (THET M A (MANU 'CHPO' L {temperatures}))) ; "
        "R = MINI (EXCO 'UR' U) ; S = MAXI 'ABS' (EXCO 'N22' ((SIGM M A U) - "
        f"(THET M A (MANU 'CHPO' L {temperatures})))) ;",
        "R", "S",
    )  # fmt: skip
    assert radius == pytest.approx(ALPHA * MIDDLE * 3.0, rel=1e-9)
    assert stress == pytest.approx(0.0, abs=1e-6)


def test_orthotropic_shell_expands_along_its_axes(found) -> None:
    """Its first axis lies along y: ALP1 is the growth along y."""
    script = (
        plate("DKT", "'T' 1.").split("M = MODE")[0]
        + "M = MODE Q 'MECANIQUE' 'ELASTIQUE' 'ORTHOTROPE' 'DKT' ; "
        "A = MATE M 'DIRE' (0. 1. 0.) 'PARA' 'YG1' 4.E9 'YG2' 1.E9 'NU12' 0.2 'G12' 1.E9 "
        "'EPAI' 0.1 'ALP1' 3.E-5 'ALP2' 1.E-5 ; "
        "F = BSIG M (THET M A (MANU 'CHPO' Q 'T' 10.)) A ; "
        "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' O)) F ; "
        "X = EXTR U 'UX' P ; Y = EXTR U 'UY' P ;"
    )
    assert found(script, "X", "Y") == pytest.approx((2e-4, 3e-4), rel=2e-3)


def test_skins_without_the_middle_are_refused(tmp_path: Path) -> None:
    message = script_runs.refused(plate("DKT", "'TINF' 1. 'TSUP' 2."), folder=tmp_path)
    assert "no component T" in message

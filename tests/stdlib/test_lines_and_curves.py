"""@FRENET @LISSE @COUPLE @POMI ZIGZAG CONTSEG3 @DEDUIRE @CORIGI @SYSLIN against closed forms."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from script_runs import found, refused


def listed(values):
    return "PROG " + " ".join(repr(float(v)) for v in values)


def test_frames_of_a_circle_point_to_its_centre():
    tx, ny, bz = found(
        "OPTI DIME 2 ELEM SEG2 ; L = CERC 40 'ROTA' 180. (1. 0.) (0. 0.) ; T N B = @FRENET L ; "
        "P = L POIN 'PROC' (0. 1.) ; A = EXTR T 'TX' P ; C = EXTR N 'NY' P ; D = EXTR B 'BZ' P ;",
        "A", "C", "D",
    )  # fmt: skip
    assert (tx, ny, bz) == pytest.approx((-1.0, -1.0, 1.0), abs=1e-9)


def test_frames_of_a_helix_in_space():
    """Binormal of a helix of radius 1 and rise 1 a radian: it climbs at 45 degrees."""
    bz = found(
        "OPTI DIME 3 ELEM SEG3 ; O = 0. 0. 0. ; V = 0. 0. 1. ; P = 1. 0. 0. ; "
        f"Q L = @HELICE P 'POIN' O V {2 * math.pi} 360. 120 ; T N B = @FRENET L ; "
        "C = EXTR B 'BZ' (L POIN 60) ;",
        "C",
    )  # fmt: skip
    assert bz == pytest.approx(math.sqrt(0.5), abs=2e-3)


def test_frames_need_five_elements():
    assert "five elements" in refused(
        "OPTI DIME 2 ELEM SEG2 ; T N B = @FRENET (DROI 4 (0. 0.) (1. 0.)) ;"
    )


@pytest.mark.parametrize(
    ("left", "right", "ends"),
    [
        (50.0, 50.0, "natural"),
        (30.0, 50.0, ((1, math.tan(math.pi / 6)), (2, 0.0))),
        (0.0, -45.0, ((1, 0.0), (1, -1.0))),
    ],
)
def test_smoothed_curve_is_the_cubic_spline(left, right, ends):
    x, y = [0.0, 0.7, 1.0, 2.5], [1.0, -1.0, 0.5, 0.2]
    curve = found(
        f"E = EVOL 'MANU' ({listed(x)}) ({listed(y)}) ; F = @LISSE E {left} {right} 41 1 ; "
        "LX = EXTR F 'ABSC' ; LY = EXTR F 'ORDO' ;",
        "LX", "LY",
    )  # fmt: skip
    at, value = (np.asarray(c.values) for c in curve)
    assert at == pytest.approx(np.linspace(0.0, 2.5, 41))
    assert value == pytest.approx(CubicSpline(x, y, bc_type=ends)(at), abs=1e-10)


def test_smoothing_along_the_ordinates_swaps_the_axes():
    x, y = [0.04, 0.4, 0.53, 0.67, 0.77, 0.75], [-0.2, -0.13, -0.08, 0.0, 0.23, 0.41]
    lx, ly = found(
        f"E = EVOL 'MANU' ({listed(x)}) ({listed(y)}) ; F = @LISSE E 50. 0. 40 2 ; "
        "LX = EXTR F 'ABSC' ; LY = EXTR F 'ORDO' ;",
        "LX", "LY",
    )  # fmt: skip
    spline = CubicSpline(y, x, bc_type=((2, 0.0), (1, 0.0)))
    assert np.asarray(lx.values) == pytest.approx(spline(np.asarray(ly.values)), abs=1e-10)


def test_couple_joins_two_plane_curves():
    script = (
        "EA = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 0.) ; "
        "EB = EVOL 'MANU' (PROG 5. 6. 7.) (PROG 1. 2. 3.) ; L = @COUPLE EA EB {} ; "
        "X = MAXI (COOR 1 L) ; Y = MAXI (COOR 2 L) ; Z = MAXI (COOR 3 L) ; D = VALE 'DIME' ;"
    )
    assert found(script.format(1), "X", "Y", "Z", "D") == (7.0, 2.0, 3.0, 3)
    assert found(script.format(2), "X", "Y", "Z", "D") == (7.0, 2.0, 1.0, 3)


def test_nearest_polynomial_of_a_broken_line():
    """Against least squares by dense Gauss quadrature of the same broken line."""
    rng = np.random.default_rng(3)
    x, y = np.sort(rng.uniform(-2.0, 5.0, 9)), rng.normal(size=9)
    table, curve = found(
        f"E = EVOL 'MANU' ({listed(x)}) ({listed(y)}) ; T F = @POMI E 4 'IDEM' ; "
        "L = PROG (T . 0) (T . 1) (T . 2) (T . 3) (T . 4) ; V = EXTR F 'ORDO' ;",
        "L", "V",
    )  # fmt: skip
    gauss, weight = np.polynomial.legendre.leggauss(6)
    half = np.diff(x) / 2
    at = (x[:-1] + half)[:, None] + half[:, None] * gauss
    w = np.sqrt(half[:, None] * weight).ravel()
    powers = at.ravel()[:, None] ** np.arange(5)
    want = np.linalg.lstsq(w[:, None] * powers, w * np.interp(at.ravel(), x, y), rcond=None)[0]
    assert np.asarray(table.values) == pytest.approx(want, rel=1e-8, abs=1e-9)
    assert np.asarray(curve.values) == pytest.approx(x[:, None] ** np.arange(5) @ want, abs=1e-8)


def test_nearest_polynomial_has_four_points_a_step():
    lx = found("E = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 2.) ; T F = @POMI E 1 ; "
               "L = EXTR F 'ABSC' ;", "L")  # fmt: skip
    assert len(lx.values) == 9


def test_zigzag_turns_towards_the_second_vector():
    """Two quarter turns to the left, one half turn to the right of the lengths given."""
    script = (
        "OPTI DIME 2 ELEM SEG2 ; L = ZIGZAG (0. 0.) (2. 0.) (1. 1.) 400 'D' 2. 'A' 90. 'R' 1. "
        f"'S' {-math.pi / 2} 'R' 0.5 'D' 1. ; "
        "X = MESU L ; P = L POIN 'FINA' ; A B = COOR P ; N = NBEL L ;"
    )
    length, a, b, n = found(script, "X", "A", "B", "N")
    assert length == pytest.approx(2 + math.pi / 2 + math.pi / 2 + 1, rel=1e-4)
    assert (a, b) == pytest.approx((4.0, 0.0), abs=1e-9)
    assert abs(n - 400) <= 3


def test_zigzag_follows_sizes_in_a_tilted_plane():
    script = (
        "OPTI DIME 3 ELEM SEG2 ; L = ZIGZAG (1. 0. 0.) (0. 1. 0.) (0. 0. 1.) 'DINI' 0.05 'DFIN' "
        "0.2 "
        "'D' 1. 'A' 270. 'R' 1. ; P = L POIN 'FINA' ; A B C = COOR P ; X = MESU (L ELEM 1) ; "
        "Y = MESU (L ELEM (NBEL L)) ;"
    )
    a, b, c, first, last = found(script, "A", "B", "C", "X", "Y")
    assert (a, b, c) == pytest.approx((1.0, 0.0, 1.0), abs=1e-9)
    assert first == pytest.approx(0.05, rel=0.15)
    assert last == pytest.approx(0.2, rel=0.15)


def test_zigzag_names_what_it_does_not_know():
    assert "not Q" in refused(
        "OPTI DIME 2 ELEM SEG2 ; L = ZIGZAG (0. 0.) (1. 0.) (0. 1.) 3 'Q' 1. ;"
    )
    assert "in line" in refused(
        "OPTI DIME 2 ELEM SEG2 ; L = ZIGZAG (0. 0.) (1. 0.) (2. 0.) 3 'D' 1. ;"
    )


def test_contact_lines_keep_middles_between_ends():
    """A unit displacement imposed on one end of a SEG3 moves its middle by a half."""
    middle, count = found(
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA8 ; L1 = DROI 1 (0. 0.) (2. 0.) ; S = L1 TRAN 1 (0. "
        "1.) ; "
        "L2 = DROI 1 (2. -1.) (0. -1.) ; S2 = L2 TRAN 1 (0. -1.) ; R M1 M2 = CONTSEG3 L1 L2 ; "
        "MO = MODE (S ET S2) MECANIQUE ELASTIQUE ; B = BLOQ 'DEPL' (COTE 3 S) ; "
        "B2 = BLOQ 'DEPL' S2 ; B3 = BLOQ 'UY' (L1 POIN 'INIT') ; "
        "U = RESO ((RIGI MO (MATE MO YOUN 1. NU 0.3)) ET B ET B2 ET B3 ET R) (DEPI B3 1.) ; "
        "P = L1 POIN 'INIT' ; Q = L1 POIN 'FINA' ; X = EXTR U 'UY' P ; Y = EXTR U 'UY' Q ; "
        "Z = (EXTR U 'UY' (L1 POIN 'PROC' (1. 0.))) - ((X + Y) / 2.) ; N = NBEL M1 ;",
        "Z", "N",
    )  # fmt: skip
    assert middle == pytest.approx(0.0, abs=1e-12)
    assert count == 1


def test_deduced_mesh_follows_an_affine_move_of_its_boundary():
    """An elastic body takes a homogeneous strain of its boundary without any error inside."""
    error, area = found(
        "OPTI DIME 2 ELEM QUA4 ; S = ((0. 0.) DROI 4 (2. 0.)) TRAN 3 (0.5 1.) ; C = CONT S ; "
        "S2 = @DEDUIRE S C (C AFFI 3. (0. 0.) (1. 1.)) ; D = (S AFFI 3. (0. 0.) (1. 1.)) MOIN S2 ; "
        "A = MAXI (ABS D) ; B = MESU S2 ;",
        "A", "B",
    )  # fmt: skip
    assert error == pytest.approx(0.0, abs=1e-10)
    assert area == pytest.approx(6.0, rel=1e-9)


def test_deduced_mesh_wants_as_many_places_as_masters():
    assert "go to" in refused(
        "OPTI DIME 2 ELEM QUA4 ; S = ((0. 0.) DROI 4 (2. 0.)) TRAN 3 (0. 1.) ; "
        "A = @DEDUIRE S (CONT S) (COTE 1 S) ;"
    )


def test_rigid_motions_are_held_without_reactions_in_the_plane():
    """Uniform traction of a free plate: exact stretch, no mean motion, no mean rotation."""
    sx, mean, turn = found(
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((1. 1.) DROI 4 (5. 2.)) TRAN 2 (-1. 4.) ; "
        "MO = MODE S MECANIQUE ELASTIQUE ; MA = MATE MO YOUN 10. NU 0.3 ; F = PRES 'MASS' MO "
        "(CONT S) 2. ; R = @CORIGI S ; U = RESO ((RIGI MO MA) ET R) F ; E = EPSI MO U ; "
        "A = MAXI E 'AVEC' (MOTS 'EPXX') ; P = CHAN 'POI1' S ; B = SOMM (EXTR U 'VALE' 'UX' P) ; "
        "W = MAXI (ABS (REAC R U)) ;",
        "A", "B", "W",
    )  # fmt: skip
    assert abs(sx) == pytest.approx(2.0 / 10.0 * 0.7, rel=1e-9)
    assert mean == pytest.approx(0.0, abs=1e-10)
    assert turn == pytest.approx(0.0, abs=1e-9)


def test_rigid_motions_are_held_in_space_and_in_axial_mode():
    sizes = found(
        "OPTI DIME 3 ELEM CUB8 ; V = (((0. 0. 0.) DROI 1 (1. 0. 0.)) TRAN 1 (0. 2. 0.)) VOLU 1 "
        "TRAN "
        "(0. 0. 3.) ; MO = MODE V MECANIQUE ELASTIQUE ; MA = MATE MO YOUN 10. NU 0. ; "
        "F = PRES 'MASS' MO (ENVE V) -1. ; U = RESO ((RIGI MO MA) ET (@CORIGI V)) F ; "
        "A = MAXI (EXCO U 'UX') ; B = MAXI (EXCO U 'UY') ; C = MAXI (EXCO U 'UZ') ; ",
        "A", "B", "C",
    )  # fmt: skip
    assert np.abs(sizes) == pytest.approx([0.05, 0.1, 0.15], rel=1e-9)
    stretch = found(
        "OPTI DIME 2 MODE AXIS ELEM QUA4 ; S = ((0. 0.) DROI 2 (1. 0.)) TRAN 2 (0. 2.) ; "
        "MO = MODE S MECANIQUE ELASTIQUE ; MA = MATE MO YOUN 10. NU 0. ; "
        "F = PRES 'MASS' MO ((COTE 1 S) ET (COTE 3 S)) -1. ; "
        "U = RESO ((RIGI MO MA) ET (@CORIGI S)) F ; A = MAXI (ABS (EXCO U 'UZ')) ;",
        "A",
    )
    assert stretch == pytest.approx(0.1, rel=1e-9)


def test_small_system_needs_no_order_of_rows():
    rng = np.random.default_rng(1)
    matrix, side = rng.normal(size=(5, 5)), rng.normal(size=5)
    matrix[0, 0] = 0.0
    script = "M = TABL ; X = TABL ; "
    for i in range(5):
        script += f"M . {i + 1} = TABL ; X . {i + 1} = {float(side[i])!r} ; "
        script += "".join(f"M . {i + 1} . {j + 1} = {float(matrix[i, j])!r} ; " for j in range(5))
    script += "U = @SYSLIN M X ; L = PROG (U . 1) (U . 2) (U . 3) (U . 4) (U . 5) ;"
    assert np.asarray(found(script, "L").values) == pytest.approx(np.linalg.solve(matrix, side))


def test_singular_system_is_an_error():
    script = (
        "M = TABL ; M . 1 = TABL ; M . 2 = TABL ; M . 1 . 1 = 1. ; M . 1 . 2 = 2. ; M . 2 . 1 = "
        "2. ; "
        "M . 2 . 2 = 4. ; X = TABL ; X . 1 = 1. ; X . 2 = 1. ; U = @SYSLIN M X ;"
    )
    assert "singular" in refused(script)

"""FOUR2TRI: fields of a Fourier series in space."""

import numpy as np
import pytest
from script_runs import ran
from together import together

PLANE = (
    "OPTI DIME 2 MODE FOUR 3 ELEM QUA8 ; L0 = DROI 2 (0. 0.) (2. 0.) ; S1 = TRAN 2 L0 (0. 1.) ;"
    "OPTI ELEM SEG3 ; L1 = DROI 2 (2. 1.) (2. 3.) ; G = S1 ET L1 ; ELIM 1.E-6 G ;"
    "R Z = COOR G ; T = TABL ; T . 'MAILLAGE' = G ; D = TABL ; T . 'DEPLACEMENTS' = D ;"
    "D . 1 = (NOMC 'UR' (R * R)) ET (NOMC 'UT' (R * Z)) ET (NOMC 'UZ' (R * (Z + 2.))) ;"
    "T . 'CHPO_SYME' = TABL ; T . 'CHPO_SYME' . 1 = NOMC 'P' (R * Z) ;"
    "T . 'CHPO_ANTI' = TABL ; T . 'CHPO_ANTI' . 1 = NOMC 'P' (R + Z) ;"
)


def field(result, name, component, mesh="M"):
    value = result.session.root.find(name)
    nodes = result.session.root.find(mesh).sorted_node_ids
    return value.values_at(component, nodes)


def solved(script):
    result = ran(script)
    mesh = result.session.root.find("M")
    return result, mesh.nodes.coordinates[mesh.sorted_node_ids]


def expected(r, t, z, n):
    even, odd = (np.cos(n * t), np.sin(n * t)) if n >= 0 else (np.sin(-n * t), np.cos(n * t))
    turning = np.ones_like(t) if n == 0 else odd
    return r * r * even, r * z * turning, r * (z + 2) * even, r * z * even, (r + z) * odd


@together("n", [0, 1, 3, -2])
@together("upright", [False, True])
def test_fields_in_space(n, upright):
    """The harmonic 3 by the older form."""
    angles, scalars = "(PROG 0. PAS 30. 180.) ;", PLANE
    call = f"T . 'ANGLES' = {angles} FOUR2TRI T {n} ; M = T . 'MAILLAGE_3D' ;"
    if n == 3:
        scalars = PLANE.replace("CHPO_SYME", "CHAMPS_POINTS_SYMETRIQUES")
        scalars = scalars.replace("CHPO_ANTI", "CHAMPS_POINTS_ANTISYMETRIQUES")
        call = f"MO = MODE S1 'MECANIQUE' 'ELASTIQUE' ; M = FOUR2TRI MO T {n} {angles}"
    script = scalars + (
        f"T . 'REDRESSE' = {'VRAI' if upright else 'FAUX'} ; T . 'ELIM' = 1.E-8 ; {call}"
        "U = T . 'DEPLACEMENTS_3D' . 1 ; A = T . 'CHPO_SYME_3D' . 1 ; B = T . 'CHPO_ANTI_3D' . 1 ;"
        "H = T . 'ANGLE_3D' ;"
    )
    if n == 3:
        script = script.replace("T . 'CHPO_", "T . 'CHAMPS_POINTS_")
    result, points = solved(script)
    x, y, z = points.T if upright else (points[:, 0], -points[:, 2], points[:, 1])
    r, t = np.hypot(x, y), np.arctan2(y, np.where(np.hypot(x, y) > 1e-9, x, 1))
    ur, ut, uz, even, odd = expected(r, t, z, n)
    ux, uy = ur * np.cos(t) - ut * np.sin(t), ur * np.sin(t) + ut * np.cos(t)
    names = ["UX", "UY", "UZ"] if upright else ["UX", "UZ", "UY"]
    turned = uy if upright else -uy
    for name, exact in zip(names, (ux, turned, uz), strict=True):
        np.testing.assert_allclose(field(result, "U", name), exact, atol=1e-6)
    np.testing.assert_allclose(field(result, "A", "P"), even, atol=1e-6)
    np.testing.assert_allclose(field(result, "B", "P"), odd, atol=1e-6)
    np.testing.assert_allclose(field(result, "H", "SCAL"), np.degrees(t), atol=1e-6)


def test_whole_turn_closes_and_has_the_volume_of_the_body():
    result, points = solved(
        PLANE + "T . 'ELIM' = 1.E-8 ; FOUR2TRI T ; M = T . 'MAILLAGE_3D' ;"
        "V = MESU (T . 'MAILLAGE_3D_MASSIF') ; N = NBNO M ;"
        "P = NBNO ((T . 'MAILLAGE_3D_COQUE') POIN 'DROIT' (2. 0. 0.) (2. 1. 0.) 1.E-6) ;"
    )
    root = result.session.root
    assert len(np.unique(np.round(points, 6), axis=0)) == root.find("N")
    assert root.find("V") == pytest.approx(np.pi * 4, rel=0.02)
    assert root.find("P") == 5


@together("angles", [(0, 10, 90), (-30, 0, 45, 50, 200), (200, 300, 350, 460, 520)])
@together("upright", [False, True])
def test_sections_stand_at_the_angles_asked_for(angles, upright):
    listed = " ".join(f"{a}." for a in angles)
    result, points = solved(
        f"OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; T = TABL ;"
        f"T . 'MAILLAGE' = S ; T . 'REDRESSE' = {'VRAI' if upright else 'FAUX'} ;"
        f"T . 'ANGLES' = PROG {listed} ; FOUR2TRI T ; M = T . 'MAILLAGE_3D' ; V = MESU M ;"
        "X = COOR 1 S ; Y = COOR 2 S ; A = (MAXI X) - (MINI X) ; B = (MAXI Y) - (MINI Y) ;"
    )
    x, y = (points[:, 0], points[:, 1]) if upright else (points[:, 0], -points[:, 2])
    off = np.hypot(x, y) > 1e-9
    turned = np.degrees(np.arctan2(y[off], x[off])) % 360
    wanted = np.array(angles) % 360
    gap = np.abs(turned[:, None] - wanted)
    nearest = np.minimum(gap, 360 - gap)
    assert np.all(nearest.min(axis=1) < 1e-6)
    assert np.all(nearest.min(axis=0) < 1e-6)
    # a cell of one sector between radii a and b: half the sine of the angle by b^2 - a^2
    root, exact = result.session.root, 0.5 * np.sum(np.sin(np.radians(np.diff(angles)))) * 4
    assert root.find("V") == pytest.approx(exact)
    assert (root.find("A"), root.find("B")) == (2, 1)


def test_a_second_call_keeps_the_mesh():
    result, _ = solved(
        PLANE + "T . 'ANGLES' = PROG 0. 45. 90. ; T . 'ELIM' = 1.E-8 ; FOUR2TRI T 1 ;"
        "M = T . 'MAILLAGE_3D' ; U1 = T . 'DEPLACEMENTS_3D' . 1 ; FOUR2TRI T 3 ;"
        "N = T . 'MAILLAGE_3D' ; U = U1 + (T . 'DEPLACEMENTS_3D' . 1) ; Q = MAXI U ;"
    )
    assert result.session.root.find("M") is result.session.root.find("N")

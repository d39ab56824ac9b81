"""Links of DYNE on a mass of 2 kg: what they say they push, and what its motion shows of it."""

import numpy as np
import pytest
from script_runs import ran
from together import together

STEP = 2e-4
MASS = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0.3 0.1 ; Q = 0.28 0.13 ; PX = 0. 0. ; PY = 0. 0. ;
QX = 0. 0. ; QY = 0. 0. ; PR = 0. 0. ; TM = TABL 'BASE_DE_MODES' ;
DEBP MODE1 N*ENTIER R*POINT A*POINT C*MOT M*FLOTTANT ;
  T = TABL 'MODE' ; T . 'POINT_REPERE' = R ; T . 'FREQUENCE' = 0. ; T . 'MASSE_GENERALISEE' = M ;
  T . 'DEFORMEE_MODALE' = MANU 'CHPO' A 1 C 1. ; TM . N = T ;
FINP ;
MODE1 1 PX P 'UX' 2. ; MODE1 2 PY P 'UY' 2. ; MODE1 3 QX Q 'UX' 3. ; MODE1 4 QY Q 'UY' 3. ;
MODE1 5 PR P 'RZ' 0.5 ;
TB = TABL 'BASE_MODALE' ; TB . 'MODES' = TM ;
TI = TABL 'INITIAL' ; TI . 'VITESSE' = MANU 'CHPO' (PX ET PY) 1 'ALFA' (PROG {vx} {vy}) ;
L1 = TABL 'LIAISON_ELEMENTAIRE' ; TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ;
TL . 'LIAISON_B' . 1 = L1 ; TS = TABL 'SORTIE' ;
TS . 'LIAISON_B' = TABL 'LIAISON_B' ; TS . 'LIAISON_B' . L1 = VRAI ;
TS . 'VARIABLE' = TABL 'VARIABLE' ; TS . 'VARIABLE' . 'TYPE_SORTIE' = MOT 'LISTREEL' ;
TS . 'VARIABLE' . 'DEPLACEMENT' = VRAI ;
L1 . 'TYPE_LIAISON' = MOT '{kind}' ; {entries}
S = PROG 0. 'PAS' 0.01 1. ; TC = TABL 'CHARGEMENT' ;
TC . 'BASE_A' = CHAR (MANU 'CHPO' (PX ET PR) 1 'FALF' (PROG {push} {turn}) 'NATURE' 'DISCRET')
  (EVOL 'MANU' S (SIN (1200. * S))) ;
R = DYNE 'DE_VOGELAERE' TB TI TL TS TC 4000 2.E-4 ;
"""
RUBS = """
L1 . 'COEFFICIENT_GLISSEMENT' = 0.2 ; L1 . 'COEFFICIENT_ADHERENCE' = 0.3 ;
L1 . 'RAIDEUR_TANGENTIELLE' = -1. ; L1 . 'AMORTISSEMENT_TANGENTIEL' = 1.E-3 ;
"""
RING = """
OPTI DIME 3 ; L1 . 'NORMALE' = 0. 0. 2. ; L1 . 'EXCENTRATION' = {away} 0. ; OPTI DIME 2 ;
L1 . 'SUPPORT' = P ; L1 . 'RAYON' = 0.1 ; L1 . 'RAIDEUR' = 5.E3 ;
"""
POINTS = "L1 . 'POINT_A' = P ; L1 . 'POINT_B' = Q ; L1 . 'JEU' = 0.02 ; "


def moved(tmp_path, kind, entries, velocity=(0.5, -1.0), push=0.0, turn=0.0):
    """Results of the link, and paths of P and Q with their accelerations, shape `(2, steps)`."""
    vx, vy = velocity
    script = MASS.format(kind=kind, entries=entries, vx=vx, vy=vy, push=push, turn=turn)
    root = ran(script, output_directory=tmp_path).session.root
    results = root.find("R")
    moves = results.get("DEPLACEMENT")
    paths = [
        np.array([moves.get(root.find(n)).values for n in names])
        for names in (("PX", "PY"), ("QX", "QY"))
    ]
    pushes = [np.diff(x, 2, axis=1) / STEP**2 for x in paths]
    return results.get(root.find("L1")), paths, pushes


@together(
    "kind, more, away, velocity",
    [
        ("POINT_CERCLE", "", (0.02, -0.01), (0.5, -1.0)),
        ("POINT_CERCLE", "L1 . 'AMORTISSEMENT' = 30. ;", (0.02, -0.01), (0.5, -1.0)),
        ("POINT_CERCLE_FROTTEMENT", RUBS, (-0.03, 0.01), (0.5, 1.0)),
        (
            "POINT_CERCLE_FROTTEMENT",
            RUBS + "L1 . 'VITESSE_ENTRAINEMENT' = 3. ;",
            (-0.03, 0.01),
            (0.5, 1.0),
        ),
        (
            "POINT_CERCLE_FROTTEMENT",
            RUBS + "L1 . 'CONTACT_INTERIEUR' = FAUX ;",
            (0.12, 0.15),
            (0.5, 1.0),
        ),
    ],
)
def test_a_point_in_a_ring_or_outside_is_pushed_to_its_own_side(
    kind, more, away, velocity, tmp_path
):
    entries = RING.format(away=f"{away[0]} {away[1]}") + more
    link, (path, _), (push, _) = moved(tmp_path, kind, entries, velocity)
    u = np.array([link.get("UX").values, link.get("UY").values])
    np.testing.assert_allclose(u, path, atol=1e-12)
    out = u - np.array(away)[:, None]
    far = np.linalg.norm(out, axis=0)
    n = out / far
    inside = "FAUX" not in more
    overlap = np.maximum(far - 0.1 if inside else 0.1 - far, 0.0)
    rate = np.gradient(far, STEP)
    force = 5e3 * overlap + (30.0 if "AMORTISSEMENT' = 30" in more else 0.0) * rate
    force = np.where(overlap > 0.0, np.maximum(force, 0.0), 0.0)
    said = np.abs(link.get("FORCE_DE_CHOC" + ("_NORMALE" if RUBS in more else "")).values)
    np.testing.assert_allclose(said, force, atol=2e-3 * force.max())
    assert force.max() > 20.0
    total, sure = (-1.0 if inside else 1.0) * said * n, np.ones(len(said), dtype=bool)
    if RUBS in more:
        t = np.array([-n[1], n[0]])
        slip = (np.gradient(u, STEP, axis=1) * t).sum(axis=0) - (3.0 if "3." in more else 0.0)
        touched = (said > 1.0) & (np.abs(slip) > 0.01)
        rubbed = link.get("FORCE_DE_CHOC_TANGENTIELLE").values
        np.testing.assert_allclose(np.abs(rubbed[touched]), 0.2 * said[touched], rtol=1e-6)
        total -= 0.2 * said * np.sign(slip) * t
        sure = touched | (said == 0.0)
        assert touched.sum() > 100
    sure[1:-1] &= (said[:-2] > 0.0) == (said[2:] > 0.0)  # no touch begins or ends there
    np.testing.assert_allclose(
        (2.0 * push - total[:, 1:-1])[:, sure[1:-1]], 0.0, atol=2e-2 * force.max()
    )


def test_a_ring_that_is_free_gets_what_it_gives(tmp_path):
    entries = RUBS + (
        "OPTI DIME 3 ; L1 . 'NORMALE' = 0. 0. 1. ; OPTI DIME 2 ; L1 . 'POINT' = P ;"
        "L1 . 'CERCLE' = Q ; L1 . 'RAYON' = 0.1 ; L1 . 'RAIDEUR' = 5.E3 ;"
    )
    link, (p, q), (push, back) = moved(tmp_path, "POINT_CERCLE_MOBILE", entries)
    u = np.array([link.get("UX").values, link.get("UY").values])
    np.testing.assert_allclose(u, p - q, atol=1e-12)
    far = np.linalg.norm(u + np.array([[0.02], [-0.03]]), axis=0)  # P begins so far from Q
    said = np.abs(link.get("FORCE_DE_CHOC_NORMALE").values)
    np.testing.assert_allclose(said, 5e3 * np.maximum(far - 0.1, 0.0), atol=1e-6)
    assert said.max() > 20.0
    np.testing.assert_allclose(2.0 * push, -3.0 * back, atol=1e-3)
    assert np.abs(back).max() > 5.0


def test_points_that_strike_rub_each_other(tmp_path):
    entries = RUBS + POINTS + "L1 . 'NORMALE' = 0.6 -0.8 ; L1 . 'RAIDEUR' = 5.E3 ;"
    link, (p, q), (push, back) = moved(tmp_path, "POINT_POINT_FROTTEMENT", entries)
    n, t = np.array([0.6, -0.8]), np.array([0.8, 0.6])
    for name, path in (("A", p), ("B", q)):
        u = [link.get(f"{c}_POINT_{name}").values for c in ("UX", "UY")]
        np.testing.assert_allclose(u, path, atol=1e-12)
    said = link.get("FORCE_DE_CHOC_POINT_A").values
    np.testing.assert_allclose(said, -5e3 * np.maximum(n @ (p - q) - 0.02, 0.0), atol=1e-6)
    np.testing.assert_allclose(link.get("FORCE_DE_CHOC_POINT_B").values, -said)
    slip = np.gradient(t @ (p - q), STEP)
    total = said * n[:, None] - 0.2 * np.abs(said) * np.sign(slip) * t[:, None]
    sure = (np.abs(slip) > 0.01)[1:-1] & ((said[:-2] < 0.0) == (said[2:] < 0.0))
    assert (sure & (said[1:-1] < -1.0)).sum() > 50
    np.testing.assert_allclose((2.0 * push - total[:, 1:-1])[:, sure], 0.0, atol=0.5)
    np.testing.assert_allclose(2.0 * push, -3.0 * back, atol=1e-3)
    assert np.abs(said).max() > 20.0


LAW = np.array([[0.0, 0.0], [0.01, 60.0], [0.03, 90.0], [4.0, 450.0]])


def plastic(path, points, kinematic):
    """Forces along a path, plastic parts and their sums (return onto a piecewise linear law)."""
    slope = points[1, 1] / points[1, 0]
    parts, limits = points[1:, 0] - points[1:, 1] / slope, points[1:, 1]
    done, summed, out = 0.0, 0.0, []
    for x in path:
        for _ in range(200):  # bisection would do; steps are small
            if kinematic:
                centre = np.interp(abs(done), parts, limits - limits[0]) * np.sign(done)
                excess = abs(slope * (x - done) - centre) - limits[0]
                way = np.sign(slope * (x - done) - centre)
            else:
                excess = abs(slope * (x - done)) - np.interp(summed, parts, limits)
                way = np.sign(x - done)
            if excess <= 1e-9:
                break
            piece = np.searchsorted(parts, abs(done) if kinematic else summed, side="right")
            rise = np.diff(limits) / np.diff(parts)
            step = excess / (slope + rise[min(piece, len(rise)) - 1])
            done, summed = done + way * step, summed + step
        out.append((slope * (x - done), done, summed))
    return np.array(out).T


@pytest.mark.parametrize("hardening", ["ISOTROPE", "CINEMATIQUE"])
@pytest.mark.parametrize("turning", [False, True])
def test_yielding_links_follow_their_curve_and_unload_along_their_slope(
    hardening, turning, tmp_path
):
    kinematic = hardening == "CINEMATIQUE"
    points = LAW[[0, 1, 3]] if kinematic else LAW
    law = " ".join(map(str, points[:, 0])), " ".join(map(str, points[:, 1]))
    entries = POINTS + (
        f"L1 . 'LOI_DE_COMPORTEMENT' = EVOL 'MANU' (PROG {law[0]}) (PROG {law[1]}) ;"
        f"L1 . 'LIAISON_PERMANENTE' = VRAI ; L1 . 'ECROUISSAGE' = MOT '{hardening}' ;"
    )
    if turning:
        entries += "OPTI DIME 3 ; L1 . 'AXE_ROTATION' = 0. 0. -1. ; OPTI DIME 2 ;"
        kind, push, turn = "POINT_POINT_ROTATION_PLASTIQUE", 0.0, 150.0
    else:
        entries += "L1 . 'NORMALE' = 1. 0. ; "
        kind, push, turn = "POINT_POINT_DEPLACEMENT_PLASTIQUE", 150.0, 0.0
    link, (p, q), (pushed, _) = moved(tmp_path, kind, entries, (0.0, 0.0), push, turn)
    if turning:
        path = -(link.get("RZ_POINT_A").values - link.get("RZ_POINT_B").values)
        what, part = "MOMENT_DE_CHOC_POINT_", "ROTATION_PLASTIQUE"
    else:
        path, what, part = p[0] - q[0], "FORCE_DE_CHOC_POINT_", "DEPLACEMENT_PLASTIQUE"
    force, done, summed = plastic(path, points, kinematic)
    said = link.get(f"{what}A").values
    np.testing.assert_allclose(said, -force, atol=1e-2)
    np.testing.assert_allclose(link.get(f"{what}B").values, -said)
    np.testing.assert_allclose(link.get(part).values, done, atol=1e-5)
    np.testing.assert_allclose(link.get(f"{part}_CUMULE").values, summed, atol=1e-5)
    assert summed[-1] > 1.2 * np.abs(done).max()  # it yielded both ways
    if not turning:
        whole = 150.0 * np.interp(
            STEP * np.arange(4001), t := 0.01 * np.arange(101), np.sin(np.radians(1200.0 * t))
        )
        np.testing.assert_allclose(2.0 * pushed[0], (whole - force)[1:-1], atol=0.5)


COS, SIN = (f"L1 . 'FONCTION' = MOT '{word}' ;" for word in ("COS", "SIN"))


@together(
    "kind, entries, expected",
    [
        ("DEPLACEMENT", "", lambda x, v, t: x),
        ("VITESSE", "", lambda x, v, t: v),
        ("DEPLACEMENT", "L1 . 'EXPOSANT' = 3. ;", lambda x, v, t: x**3),
        ("DEPLACEMENT", COS, lambda x, v, t: np.cos(x)),
        ("DEPLACEMENT", SIN, lambda x, v, t: np.sin(x)),
        ("DEPLACEMENT", COS + "L1 . 'FREQUENCE' = 9. ;", lambda x, v, t: np.cos(9.0 * t) * x),
        ("DEPLACEMENT", SIN + "L1 . 'FREQUENCE' = 9. ;", lambda x, v, t: np.sin(9.0 * t) * x),
    ],
)
def test_a_mode_moves_another_by_a_coupling(kind, entries, expected, tmp_path):
    entries += (
        "L1 . 'SUPPORT' = QX ; L1 . 'ORIGINE' = PX ; L1 . 'COEFFICIENT' = -7. ;"
        "OUBL TL 'LIAISON_B' ; TL . 'LIAISON_A' = TABL 'LIAISON_A' ; TL . 'LIAISON_A' . 1 = L1 ;"
        "OUBL TS 'LIAISON_B' ; TS . 'LIAISON_A' = TABL 'LIAISON_A' ; TS . 'LIAISON_A' . L1 = VRAI ;"
    )
    link, (p, _), (_, back) = moved(tmp_path, f"COUPLAGE_{kind}", entries, (4.0, 0.0), 30.0)
    force = -7.0 * expected(p[0], np.gradient(p[0], STEP), STEP * np.arange(4001))
    said = link.get(f"FORCE_DE_COUPLAGE_{kind}").values
    np.testing.assert_allclose(said, force, atol=2e-2)
    np.testing.assert_allclose(3.0 * back[0], force[1:-1], atol=2e-2)
    assert np.ptp(p[0]) > 2.0


def test_a_plane_that_moves_drags_and_one_that_yields_stays_pressed_in(tmp_path):
    entries = "L1 . 'SUPPORT' = P ; L1 . 'NORMALE' = 0. -3. ; L1 . 'JEU' = 0.01 ; "
    entries += "L1 . 'RAIDEUR' = 5.E3 ; "
    drags = RUBS + "L1 . 'VITESSE_ENTRAINEMENT' = -4. 0. ;"
    link, _, (push, _) = moved(tmp_path, "POINT_PLAN_FROTTEMENT", entries + drags)
    said = link.get("FORCE_DE_CHOC_NORMALE").values
    np.testing.assert_allclose(2.0 * push[0], -0.2 * np.abs(said[1:-1]), atol=0.2)
    assert np.abs(said).max() > 80.0
    link, (p, _), _ = moved(tmp_path, "POINT_PLAN", entries + "L1 . 'SEUIL_PLASTIQUE' = 40. ;")
    over, given, forces = -p[1] - 0.01, 0.0, []
    for x in over:
        given = max(given, x - 40.0 / 5e3)
        forces.append(-5e3 * max(x - given, 0.0))
    np.testing.assert_allclose(link.get("FORCE_DE_CHOC").values, forces, atol=1e-3)
    np.testing.assert_allclose(link.get("DEPLACEMENT_PLASTIQUE").values[-1], given, atol=1e-6)
    assert given > 0.01

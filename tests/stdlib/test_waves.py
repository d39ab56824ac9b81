"""@COLONNE, @DRM, @BORDS, @ONDE: free fields brought into a mesh without a structure."""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest
from references.soil_column import bundle

from ssilang.cli.run import run_text

GROUND = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; S = TRAN 6 (DROI 12 (0. 0.) (12. 0.)) (0. -6.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E8 'NU' 0.3 'RHO' 1900. ; "
    "CX = COOR 1 S ; CY = COOR 2 S ; "
    "INN = S ELEM 'APPUYE' 'STRICTEMENT' "
    "((CX POIN 'COMPRIS' 2.99 9.01) INTE (CY POIN 'SUPERIEUR' -3.01)) ; "
    "MID = S ELEM 'APPUYE' 'STRICTEMENT' "
    "((CX POIN 'COMPRIS' 1.99 10.01) INTE (CY POIN 'SUPERIEUR' -4.01)) ; "
    "LAY = MID DIFF INN ; OUT = S DIFF MID ; "
    "LT = PROG 0. PAS 0.005 1. ; LX = (LT - 0.5) * (PI * 4.) ; LX = LX * LX ; "
    "ACC = EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX))) ; "
    "F = (COTE 2 S) ET (COTE 3 S) ET (COTE 4 S) ; CA = AMOR M F A ; "
    "K = RIGI M A ; MM = MASS M A ; C = (0.3 * MM) ET (1.E-3 * K) ; "
    "D = TABL ; D . 'MODELE' = M ; D . 'CARACTERISTIQUES' = A ; D . 'RIGI' = K ; "
    "D . 'MASS' = MM ; D . 'AMOR' = C ; "
)
COLUMN = (
    "SC = TRAN 6 (DROI 1 (50. 0.) (51. 0.)) (0. -6.) ; MC = MODE SC MECANIQUE ELASTIQUE ; "
    "T = TABL ; T . 'MODELE' = MC ; T . 'BASE' = COTE 3 SC ; T . 'DIRECTION' = 'UX' ; "
    "T . 'CARACTERISTIQUES' = MATE MC 'YOUN' 2.E8 'NU' 0.3 'RHO' 1900. ; "
    "T . 'ROCHER' = TABL ; T . 'ROCHER' . 'YOUNG' = 2.E9 ; T . 'ROCHER' . 'POISSON' = 0.3 ; "
    "T . 'ROCHER' . 'MASSE_VOLUMIQUE' = 2300. ; T . 'AMORTISSEMENT_MASSE' = 0.3 ; "
    "T . 'AMORTISSEMENT_RIGIDITE' = 1.E-3 ; T . 'ACCELERATION' = ACC ; "
    "T . 'TEMPS_CALCULES' = LT ; W = @COLONNE T ; D . 'MOUVEMENT' = W ; D . 'COLONNE' = SC ; "
)
RUN = (
    "E = TABL ; E . 'RIGI' = K ; E . 'MASS' = MM ; E . 'AMOR' = C ET CA ; E . 'CHAR' = CH ; "
    "E . 'TEMPS_CALCULES' = LT ; E . 'PAS_SAUVES' = 1 ; R = DYNAMIC E ; "
)
DRM = "D . 'COUCHE' = LAY ; D . 'INTERIEUR' = INN ; "


def ran(script):
    result = run_text(script)
    assert result.exit_code == 0, result.message
    return result


def histories(result, name, what, node, unknown="UX"):
    table = result.session.root.find(name)
    n = sum(isinstance(i, int) for i in table.indices())
    number = np.array([result.session.root.find(node).node])
    return np.array(
        [table.get(i + 1).get(what).values_at(unknown, number)[0] for i in range(n)]
    )  # fmt: skip


def test_column_moves_as_the_layer_on_rock():
    # shear column on rock: transfer from outcrop to surface, 1 / (cos k h + i r sin k h)
    result = ran(GROUND + COLUMN + "P = POIN SC 1 ;")
    found = histories(result, "W", "ACCE", "P")
    given = result.session.root.find("ACC").parts[0].ordinates
    n = 4096
    omega = 2 * np.pi * np.fft.rfftfreq(n, 0.005)
    stiff = 2e8 / 2.6 * (1 + 1e-3j * omega)
    density = 1900.0 * (1 - 0.3j / np.maximum(omega, 1e-3))
    k, z = omega * np.sqrt(density / stiff), np.sqrt(density * stiff)
    r = z / np.sqrt(2300.0 * 2e9 / 2.6)
    surface = np.fft.irfft(np.fft.rfft(given, n) / (np.cos(6 * k) + 1j * r * np.sin(6 * k)), n)
    assert np.abs(surface).max() > 1.3
    assert found == pytest.approx(surface[: len(found)], abs=0.02)


def explicit_steps(outcrop, step):
    """Surface's acceleration of six masses on bundles of springs over a dashpot of the rock."""
    strains = np.array([1e-5, 5e-5, 2e-4, 1e-3])
    slips, shares = bundle(strains, np.array([1.0, 0.8, 0.4, 0.12]))
    limits, stiff = 2e8 / 2.6 * shares * slips, 2e8 / 2.6 * shares
    mass = np.zeros((7, 7))
    for i in range(6):
        mass[i : i + 2, i : i + 2] += 1900 / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])
    inverse, rock = np.linalg.inv(mass), np.sqrt(2300 * 2e9 / 2.6)
    u, v, springs = np.zeros(7), np.zeros(7), np.zeros((6, 4))
    seen, strain, largest = [], np.zeros(6), 0.0
    for wanted in np.cumsum(outcrop) * step:
        stress = springs.sum(axis=1) + 1e-3 * 2e8 / 2.6 * np.diff(v)
        force = np.append(stress, 0.0) - np.append(0.0, stress) - 0.3 * (mass @ v)
        force[0] += rock * (wanted - v[0])
        v = v + step * (inverse @ force)
        u = u + step * v
        springs = np.clip(springs + np.outer(np.diff(u) - strain, stiff), -limits, limits)
        strain = np.diff(u)
        largest = max(largest, np.abs(strain).max())
        seen.append(u[-1])
    return np.array(seen), largest


def test_column_that_yields_moves_as_masses_on_springs_that_slip():
    curve = "(EVOL 'MANU' (PROG 1.E-5 5.E-5 2.E-4 1.E-3) (PROG 1. 0.8 0.4 0.12))"
    given = "'YOUN' 2.E8 'NU' 0.3 'RHO' 1900."
    script = COLUMN.replace("SC MECANIQUE ELASTIQUE", "SC MECANIQUE ELASTIQUE PLASTIQUE IWAN")
    script = script.replace(f"MATE MC {given}", f"MATE MC {given} 'GGAM' {curve}")
    result = ran(GROUND + "ACC = 4. * ACC ; " + script + "P = POIN SC 1 ;")
    found = histories(result, "W", "DEPL", "P")
    given_to = result.session.root.find("ACC").parts[0]
    fine = np.arange(0, 1.0, 1e-4)
    surface, strain = explicit_steps(
        np.interp(fine + 5e-5, given_to.abscissas, given_to.ordinates), 1e-4
    )
    assert strain > 2e-4  # far beyond elasticity
    expected = np.interp(np.arange(200) * 0.005, fine + 1e-4, surface)
    assert np.abs(found[:200] - expected).max() < 0.01 * np.abs(expected).max()


SOFT = "SOFT = MODE {of} MECANIQUE ELASTIQUE PLASTIQUE PARFAIT ; "
PARTS = "D . 'MODELE' = (MODE (S DIFF {of}) MECANIQUE ELASTIQUE) ET SOFT ; "


def test_soil_may_yield_only_where_no_matrix_stands_for_it():
    for of, load, told in (
        ("LAY", DRM + "CH = @DRM D ;", "14 elements"),
        ("OUT", DRM + "CH = @DRM D ;", "outside it"),
        ("S", "D . 'FRONTIERE' = F ; D . 'AMORTISSEURS' = CA ; CH = @BORDS D ;", "touch the edges"),
    ):
        parts = "D . 'MODELE' = SOFT ; " if of == "S" else PARTS.format(of=of)
        result = run_text(GROUND + COLUMN + SOFT.format(of=of) + parts + load)
        assert result.exit_code == 1
        assert told in result.message, result.message
        assert "PLASTIQUE PARFAIT" in result.message
    material = "D . 'CARACTERISTIQUES' = MATE (D . 'MODELE') 'YOUN' 2.E8 'NU' 0.3 'RHO' 1900. "
    ran(
        GROUND + COLUMN + DRM + SOFT.format(of="INN") + PARTS.format(of="INN") + material
        + "'SIGY' 1.E5 ; D . 'AMORTISSEURS' = CA ; CH = @DRM D ; D . 'FRONTIERE' = F ; "
        "CH = @BORDS D ;"
    )  # fmt: skip


def test_a_free_field_that_has_yielded_is_refused_where_its_motion_is_taken():
    given = "'YOUN' 2.E8 'NU' 0.3 'RHO' 1900."
    soft = COLUMN.replace("SC MECANIQUE ELASTIQUE", "SC MECANIQUE ELASTIQUE PLASTIQUE PARFAIT")
    soft = soft.replace(f"MATE MC {given}", f"MATE MC {given} 'SIGY' 4.E3")
    ground = GROUND.replace("PAS 0.005 1.", "PAS 0.005 0.7")
    drm = DRM + "D . 'AMORTISSEURS' = CA ; CH = @DRM D ; "
    edges = "D . 'FRONTIERE' = F ; D . 'AMORTISSEURS' = CA ; CH = @BORDS D ; "
    # the layer ends at 4 m, the edges at 6; shear is largest at the base
    for limit, load, place in (("4.E3", drm, "50.5 -3.5"), ("1.E4", edges, "50.5 -5.5")):
        result = run_text(ground + soft.replace("4.E3", limit) + load)
        assert result.exit_code == 1
        told = f"takes its motion: 2 elements, the most at {place}"
        assert told in result.message, result.message
    # what yields below the layer does not matter: nothing moves outside
    result = ran(
        ground + soft.replace("4.E3", "1.E4") + drm + RUN
        + "P = POIN SC 1 ; Q = INN POIN 'PROC' (6. 0.) ; O = OUT POIN 'PROC' (0. 0.) ;"
    )  # fmt: skip
    free = histories(result, "W", "ACCE", "P")
    assert np.abs(histories(result, "R", "ACCE", "Q") - free).max() < 1e-9 * np.abs(free).max()
    assert np.abs(histories(result, "R", "ACCE", "O")).max() < 1e-9 * np.abs(free).max()


def test_domain_reduction_leaves_nothing_outside():
    result = ran(
        GROUND + COLUMN + DRM + "D . 'AMORTISSEURS' = CA ; CH = @DRM D ; " + RUN
        + "P = POIN SC 1 ; Q = INN POIN 'PROC' (6. 0.) ; O = OUT POIN 'PROC' (0. 0.) ; "
        "V = OUT POIN 'PROC' (6. -6.) ;"
    )  # fmt: skip
    free = histories(result, "W", "ACCE", "P")
    peak = np.abs(free).max()
    assert np.abs(histories(result, "R", "ACCE", "Q") - free).max() < 1e-9 * peak
    for node in ("O", "V"):
        assert np.abs(histories(result, "R", "ACCE", node)).max() < 1e-9 * peak


def test_edges_let_the_column_s_motion_in():
    result = ran(
        GROUND + COLUMN + "D . 'FRONTIERE' = F ; D . 'AMORTISSEURS' = CA ; CH = @BORDS D ; " + RUN
        + "P = POIN SC 1 ; Q = S POIN 'PROC' (6. 0.) ; O = S POIN 'PROC' (0. 0.) ;"
    )  # fmt: skip
    free = histories(result, "W", "ACCE", "P")
    for node in ("Q", "O"):
        assert np.abs(histories(result, "R", "ACCE", node) - free).max() < 1e-9
    other = "D . 'FRONTIERE' = F ; D . 'AMORTISSEURS' = CA ; CH = @BORDS D ;"
    told = ran(GROUND + COLUMN.replace("2.E8", "1.2E8") + other).session.warnings
    assert "operators.dynamics.column-of-others" in {w.code for w in told}
    assert "operators.dynamics.column-of-others" not in {w.code for w in result.session.warnings}


WAVE = (
    "OND = TABL ; OND . 'POINTS' = S ; OND . 'ONDE' = '{kind}' ; "
    "OND . 'ANGLE' = 25. ; OND . 'POINT' = 0. 0. ; L1 = TABL ; L1 . 'YOUNG' = 2.E8 ; "
    "L1 . 'POISSON' = 0.3 ; L1 . 'MASSE_VOLUMIQUE' = 1900. ; OND . 'COUCHES' = TABL ; "
    "OND . 'COUCHES' . 1 = L1 ; OND . 'ACCELERATION' = ACC ; W = @ONDE OND ; "
    "D . 'AMOR' = 0. * K ; D . 'MOUVEMENT' = W ; C = 0. * K ; "
)


@pytest.mark.parametrize(("kind", "unknown"), [("SV", "UX"), ("P", "UY")])
def test_oblique_waves_pass_through_the_box(kind, unknown):
    # the surface's closed form delayed along x; elements of 1/100 of the wavelength
    result = ran(
        GROUND + WAVE.format(kind=kind)
        + "D . 'FRONTIERE' = F ; D . 'AMORTISSEURS' = CA ; CH = @BORDS D ; " + RUN
        + "Q = S POIN 'PROC' (6. 0.) ;"
    )  # fmt: skip
    expected = histories(result, "W", "ACCE", "Q", unknown)
    found = histories(result, "R", "ACCE", "Q", unknown)
    assert np.abs(expected).max() > 1.0
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()


def test_inclined_waves_in_layers_leave_nothing_outside():
    path = Path(__file__).resolve().parents[2] / "benchmarks" / "domain_reduction.py"
    spec = importlib.util.spec_from_file_location("domain_reduction", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["domain_reduction"] = module
    try:
        spec.loader.exec_module(module)
        found = module.measured("SV", 25, half=10, inner=5, end=1.0)
    finally:
        del sys.modules["domain_reduction"]
    # the free field of the elements: rounding; of theory: the mesh, 50 elements a wave
    assert found["outside, elements"] < 1e-9
    assert found["inside, elements"] < 1e-9
    assert found["outside, theory"] < 1e-3
    assert found["box against theory"] < 5e-3


RING = (
    "S0 = S ; S = S0 ELEM 'APPUYE' 'STRICTEMENT' "
    "((CX POIN 'COMPRIS' 0.99 11.01) INTE (CY POIN 'SUPERIEUR' -5.01)) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M A ; MM = MASS M A ; "
    "C = (0.3 * MM) ET (1.E-3 * K) ; D . 'MODELE' = M ; D . 'RIGI' = K ; D . 'MASS' = MM ; "
    "D . 'AMOR' = C ; PT = TABL ; PT . 'INTERIEUR' = S ; "
    "PT . 'MODELE' = MODE (S0 DIFF S) MECANIQUE ELASTIQUE ; PT . 'CARACTERISTIQUES' = A ; "
    "PM = @PML PT ; K = K ET (PM . 'RIGI') ; MM = MM ET (PM . 'MASS') ; CA = PM . 'AMOR' ; "
    "D . 'AMORTISSEURS' = CA ; OUT = (S DIFF MID) ; "
)


def test_a_matched_layer_stands_for_dampers_outside():
    result = ran(
        GROUND + RING + COLUMN + DRM + "CH = @DRM D ; " + RUN
        + "P = POIN SC 1 ; Q = INN POIN 'PROC' (6. 0.) ; O = OUT POIN 'PROC' (1. 0.) ; "
    )  # fmt: skip
    assert [w.code for w in result.session.warnings] == ["operators.dynamics.thin-layer"]
    free = histories(result, "W", "ACCE", "P")
    peak = np.abs(free).max()
    assert np.abs(histories(result, "R", "ACCE", "Q") - free).max() < 1e-9 * peak
    assert np.abs(histories(result, "R", "ACCE", "O")).max() < 1e-9 * peak


SPACE = (
    "OPTI DIME 3 MODE TRID ELEM CUB8 ; "
    "S = VOLU 2 (TRAN 2 (DROI 2 (0. 0. 0.) (8. 0. 0.)) (0. 8. 0.)) 'TRAN' (0. 0. -8.) ; "
    "LT = PROG 0. PAS 0.01 1.2 ; LX = (LT - 0.6) * (PI * 4.) ; LX = LX * LX ; "
    "W = TABL ; W . 'POINTS' = S ; W . 'POINT' = 4. 4. -8. ; W . 'ACCELERATION' = "
    "EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX))) ; W . 'COUCHES' = TABL ; "
    "C = TABL ; C . 'YOUNG' = 2.E8 ; C . 'POISSON' = 0.3 ; C . 'MASSE_VOLUMIQUE' = 1900. ; "
    "W . 'COUCHES' . 1 = C ; W . 'ONDE' = '{kind}' ; W . 'ANGLE' = {angle} ; {more}"
    "R = @ONDE W ; N = S POIN 'PROC' ({x} {y} {z}) ; "
)


def space(kind, angle, more="", at=(0.0, 0.0, 0.0)):
    """Accelerations (3, n) of a node, and the times."""
    x, y, z = at
    result = ran(SPACE.format(kind=kind, angle=float(angle), more=more, x=x, y=y, z=z))
    times = np.asarray(result.session.root.find("LT").values)
    return np.array([histories(result, "R", "ACCE", "N", u) for u in ("UX", "UY", "UZ")]), times


def ricker(times, later=0.0):
    x = (np.pi * 4 * (times - 0.6 - later)) ** 2
    return (1 - 2 * x) * np.exp(-x)


def test_sh_in_space_doubles_across_its_azimuth():
    # surface: twice the incident wave, later by the way from the record's point, both ways
    speed, turned, slanted = np.sqrt(2e8 / 2.6 / 1900), np.radians(35), np.radians(30)
    way = np.array([np.cos(turned) * np.sin(slanted), np.sin(turned) * np.sin(slanted),
                    np.cos(slanted)])  # fmt: skip
    across = np.array([-np.sin(turned), np.cos(turned), 0.0])
    for node in ((0.0, 0.0, 0.0), (8.0, 4.0, 0.0)):
        found, times = space("SH", 30, "W . 'AZIMUT' = 35. ; ", node)
        later = way @ (np.array(node) - [4.0, 4.0, -8.0]) / speed
        assert found == pytest.approx(2 * np.outer(across, ricker(times, later)), abs=2e-3)
    # at a depth the wave and its image meet
    found, times = space("SH", 30, "W . 'AZIMUT' = 35. ; ", (8.0, 4.0, -4.0))
    up, down = (
        way * [1, 1, sign] @ (np.array([8.0, 4.0, mirrored]) - [4.0, 4.0, -8.0 * sign]) / speed
        for sign, mirrored in ((1, -4.0), (-1, -4.0))
    )  # fmt: skip
    both = ricker(times, up) + ricker(times, down)
    assert found == pytest.approx(np.outer(across, both), abs=2e-3)


@pytest.mark.parametrize("kind", ["P", "SV"])
def test_an_azimuth_turns_the_motion_of_the_plane(kind):
    turned = np.radians(90.0)
    along, _ = space(kind, 20, at=(8.0, 4.0, 0.0))
    across, _ = space(kind, 20, "W . 'AZIMUT' = 90. ; ", (4.0, 8.0, 0.0))
    assert along[1] == pytest.approx(0 * along[1], abs=1e-12)
    assert np.abs(along[0]).max() > 0.1
    assert across == pytest.approx(along[[1, 0, 2]], abs=1e-12)
    # halfway: the same time, the motion turned by 45 degrees
    turned = np.radians(45.0)
    found, _ = space(kind, 20, "W . 'AZIMUT' = 45. ; W . 'POINT' = 4. 0. -8. ; ", (8.0, 4.0, 0.0))
    expected, _ = space(
        kind, 20, f"W . 'POINT' = {float(8 - 4 * np.sqrt(2))!r} 4. -8. ; ", (8.0, 4.0, 0.0)
    )  # fmt: skip
    assert found[0] == pytest.approx(np.cos(turned) * expected[0], abs=1e-9)
    assert found[1] == pytest.approx(np.sin(turned) * expected[0], abs=1e-9)
    assert found[2] == pytest.approx(expected[2], abs=1e-9)


@pytest.mark.parametrize(("kind", "component"), [("P", 2), ("SV", 0), ("SH", 1)])
def test_a_record_of_the_surface_comes_back_there(kind, component):
    said = "W . 'NATURE' = 'SURFACE' ; W . 'POINT' = 4. 4. 0. ; "
    found, times = space(kind, 25, said, (4.0, 4.0, 0.0))
    assert found[component] == pytest.approx(ricker(times), abs=2e-3)
    # with a surface above the points, the waves meet the points as at a depth
    deep, _ = space(kind, 0, "W . 'SURFACE' = 4. ; ", (4.0, 4.0, 0.0))
    same, _ = space(kind, 0, "W . 'POINT' = 4. 4. -12. ; ", (4.0, 4.0, -4.0))
    assert deep == pytest.approx(same, abs=1e-9)
    assert np.abs(deep).max() > 0.5


def begun(peak):
    """Seconds that @ONDE wants before a record, 0 if it says nothing; SV at 40 degrees."""
    result = ran(
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 2 (0. 0.) (20. -10.) ; W = TABL ; "
        f"LT = PROG 0. PAS 0.01 {peak + 1} ; LX = (LT - {peak}) * (PI * 3.) ; LX = LX * LX ; "
        "W . 'POINTS' = L ; W . 'POINT' = 0. 0. ; W . 'ONDE' = 'SV' ; W . 'ANGLE' = 40. ; "
        "C = TABL ; C . 'YOUNG' = 2.E8 ; C . 'POISSON' = 0.3 ; C . 'MASSE_VOLUMIQUE' = 1900. ; "
        "W . 'COUCHES' = TABL ; W . 'COUCHES' . 1 = C ; "
        "W . 'ACCELERATION' = EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX))) ; R = @ONDE W ;"
    )
    return sum(w.data["seconds"] for w in result.session.warnings)


def test_a_wave_beyond_the_critical_angle_is_said_to_begin_as_early_as_it_does():
    # total reflection turns the phase: the motion grows from ever, as the inverse square of time
    wanted = begun(0.6)
    assert wanted > 0.3
    assert begun(round(0.6 + 1.1 * wanted, 2)) == 0
    assert begun(round(0.6 + 0.7 * wanted, 2)) == pytest.approx(0.3 * wanted, rel=0.3)


def test_coarse_elements_and_reflecting_edges_are_told():
    result = ran(GROUND + COLUMN + DRM + "D . 'FREQUENCE' = 100. ; CH = @DRM D ;")
    warnings = {w.code: w.data for w in result.session.warnings}
    assert set(warnings) == {
        "operators.dynamics.element-too-long", "operators.dynamics.edges-reflect",
    }  # fmt: skip
    coarse = warnings["operators.dynamics.element-too-long"]
    assert coarse["wanted"] == pytest.approx(np.sqrt(2e8 / 2.6 / 1900) / 800)
    assert coarse["length"] == pytest.approx(1.0)
    edges = warnings["operators.dynamics.edges-reflect"]
    assert edges["distance"] == pytest.approx(2.0)
    assert edges["count"] == 25
    primary = np.sqrt(2e8 / 1900 * 0.7 / (1.3 * 0.4))
    assert edges["back"] == pytest.approx(4.0 / primary)


def test_refusals():
    for script, told in (
        ("D . 'COUCHE' = LAY ; D . 'INTERIEUR' = S ; CH = @DRM D ;", "does not stand between"),
        ("D . 'MOUVEMENT' = TABL ; " + DRM + "CH = @DRM D ;", "0 instants"),
        ("T . 'DIRECTION' = 'UZ' ; W = @COLONNE T ;", "@COLONNE: the direction"),
    ):
        result = run_text(GROUND + COLUMN + script)
        assert result.exit_code == 1
        assert told in result.message, result.message

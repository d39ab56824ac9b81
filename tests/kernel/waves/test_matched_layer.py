"""The perfectly matched layer: its elements, what it sends back, where it ends after long."""

import importlib.util
import itertools
import sys
from pathlib import Path

import numpy as np
import pytest
from script_runs import finder
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.waves.matched_layer import HISTORIES, matched_layer

_PATH = Path(__file__).resolve().parents[3] / "benchmarks" / "reflection.py"


@pytest.fixture(scope="module")
def waves():
    spec = importlib.util.spec_from_file_location("reflection", _PATH)
    module = importlib.util.module_from_spec(spec)
    sys.modules["reflection"] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules["reflection"]


BOX = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM {cell} ; S = TRAN {down} (DROI {across} (-{half}. 0.) "
    "({half}. 0.)) (0. -{deep}.) ; I = S ELEM 'APPUYE' 'STRICTEMENT' "
    "(((COOR 1 S) POIN 'COMPRIS' (-1. * {x}) {x}) INTE ((COOR 2 S) POIN 'SUPERIEUR' (-1. * {y}))) ;"
    "M = MODE I MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E8 'NU' {nu} 'RHO' 2000. ; "
    "N = MODE (S DIFF I) MECANIQUE ELASTIQUE ; B = MATE N 'YOUN' 2.E8 'NU' {nu} 'RHO' 2000. ; "
    "KI = RIGI M A ; MI = MASS M A ; "
    "T = TABL ; T . 'INTERIEUR' = I ; T . 'MODELE' = N ; T . 'CARACTERISTIQUES' = B ; "
)
LAYER = (
    "P = @PML T ; E = TABL ; E . 'RIGI' = KI ET (P . 'RIGI') ; E . 'MASS' = MI ET (P . 'MASS') ; "
    "E . 'AMOR' = P . 'AMOR' ; "
)


def box(cell="QUA4", across=8, down=4, half=4, deep=4, x=2.01, y=2.01, nu=0.3):
    return BOX.format(
        cell=cell, across=across, down=down, half=half, deep=deep, x=x, y=y, nu=nu
    )  # fmt: skip


def values(find, name):
    return np.asarray(find(name).values)


@together("cell", ["QUA4", "TRI3", "QUA8", "TRI6"])
def test_without_stretching_the_layer_is_the_elements(cell):
    find = finder(box(cell) + "KB = RIGI N B ; MB = MASS N B ;")
    made = matched_layer(find("N"), find("B"), find("I"), reflection=1.0)
    omega, numbering = 37.0, numbering_of(made.stiffness)
    K, M, C = (
        assemble(x, numbering).toarray() for x in (made.stiffness, made.mass, made.damping)
    )  # fmt: skip
    dynamic = K + 1j * omega * C - omega**2 * M
    history = np.isin(np.array(numbering.unknowns)[numbering.codes], HISTORIES)
    own, other = np.ix_(~history, ~history), np.ix_(~history, history)
    condensed = dynamic[own] - dynamic[other] @ np.linalg.solve(
        dynamic[np.ix_(history, history)], dynamic[other].T
    )
    alone = numbering_of(find("KB"))
    expected = assemble(find("KB"), alone) - omega**2 * assemble(find("MB"), alone)
    assert np.abs(condensed - expected.toarray()).max() < 1e-12 * np.abs(condensed).max()


def test_dampers_send_back_what_their_closed_form_says(waves):
    column = waves.dampers()
    for kind in ("P", "SV"):
        for angle in (0.0, 30.0, 60.0):
            found = waves.share(kind, angle, waves.measured(column, kind, angle))
            exact = waves.share(kind, angle, np.abs(waves.dashpots(kind, angle)))
            assert found == pytest.approx(exact, abs=4e-3)  # 16 elements a wave
    column = waves.dampers_in_space(6)
    for angle in (0.0, 45.0):
        exact = waves.dashpots_of_sh(angle)
        assert waves.measured_sh(column, angle, 6) == pytest.approx(exact, abs=4e-3)


def test_a_wave_loses_in_the_layer_what_the_stretching_says(waves):
    # exp(-2 / c int beta dx): the same for all frequencies, a power for the slower wave
    column = waves.layer(16, 0.3)
    ratio = waves.PRIMARY / waves.SHEAR
    for kind, exact in (("P", 0.3), ("SV", 0.3**ratio)):
        for share in (0.5, 0.125):
            found = waves.measured(column, kind, 0.0, waves.FREQUENCY * share)
            assert found.max() == pytest.approx(exact, abs=3e-3)
    # P at 30 degrees: each wave's way across the layer counts by its cosine, and the held edge
    # sends back P and SV
    sines = np.array([0.5, 0.5 / ratio])
    (p, s), (q, t) = sines, np.sqrt(1 - sines**2)
    at_edge = np.linalg.solve([[p, t], [-q, s]], [-p, -q])
    fades = 0.3 ** ((q + np.array([q, t * ratio])) / 2)
    found = waves.measured(column, "P", 30.0, waves.FREQUENCY / 2)
    assert found == pytest.approx(np.abs(at_edge) * fades, abs=3e-3)


@pytest.mark.parametrize(("angle", "most"), [(0.0, 0.01), (45.0, 0.01), (60.0, 0.015)])
def test_layer_of_eight_elements_sends_little_back(waves, angle, most):
    column = waves.layer(8)
    for kind in ("P", "SV"):
        found = waves.share(kind, angle, waves.measured(column, kind, angle))
        assert found < most
        if angle:  # an order of magnitude below dampers
            assert found < 0.1 * waves.share(kind, angle, np.abs(waves.dashpots(kind, angle)))


PULSE = (
    "LT = PROG 0. PAS 0.004 {end} ; LX = (LT - 0.1) * (PI * 12.) ; LX = LX * LX ; "
    "E . 'CHAR' = CHAR 'MECA' (FORC (5.E4 1.E5) (I POIN 'PROC' (1. 0.))) "
    "(EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX)))) ; "
    "E . 'TEMPS_CALCULES' = LT ; E . 'PAS_SAUVES' = 1 ; R = DYNAMIC E ; "
)


def test_energy_of_the_ground_leaves_and_never_comes_back():
    find = finder(
        box("QUA4", 12, 6, 6, 6, nu=0.45) + LAYER + PULSE.format(end=3.0)
        + "LE = PROG ; REPE PAS (DIME R) ; J = R . &PAS . 'DEPL' ; V = R . &PAS . 'VITE' ; "
        "LE = LE ET (PROG (0.5 * ((XTMX J KI) + (XTMX V MI)))) ; FIN PAS ; "
    )  # fmt: skip
    energy = values(find, "LE")
    ends = int(0.2 / 0.004)  # the load is over
    largest = energy.max()
    # each later half second has less; rounding ends the fall
    later = [energy[k : k + 125].max() for k in range(ends, len(energy) - 124, 125)]
    assert all(b < max(a, 1e-14 * largest) for a, b in itertools.pairwise(later))
    assert later[-1] < 1e-9 * largest


def test_static_limit_of_two_forces_on_the_surface():
    # Flamant: u = -2 (1 - nu^2) F / (pi E) ln r of each line force
    push = (
        "LT = PROG 0. PAS 0.004 1. ; E . 'CHAR' = CHAR 'MECA' "
        "((FORC (1.E5 0.) (I POIN 'PROC' (-2. 0.))) ET (FORC (-1.E5 0.) (I POIN 'PROC' (2. 0.)))) "
        "(EVOL 'MANU' (PROG 0. 0.05 2.) (PROG 0. 1. 1.)) ; E . 'TEMPS_CALCULES' = LT ; "
        "E . 'PAS_SAUVES' = 1 ; R = DYNAMIC E ; A1 = I POIN 'PROC' (-5. 0.) ; "
        "A2 = I POIN 'PROC' (5. 0.) ; "
        "L = EXTR ((EVOL 'TEMP' R 'DEPL' 'UX' A1) - (EVOL 'TEMP' R 'DEPL' 'UX' A2)) 'ORDO' ; "
    )
    find = finder(box("QUA4", 40, 14, 20, 14, x=12.01, y=6.01) + LAYER + push)
    exact = 2 * 2 * (1 - 0.3**2) * 1e5 / (np.pi * 2e8) * np.log(7 / 3)
    assert values(find, "L")[-1] == pytest.approx(exact, rel=0.04)
    dampers = "E = TABL ; E . 'RIGI' = KI ; E . 'MASS' = MI ; E . 'AMOR' = AMOR M F A ; "
    sides = "F = (CONT I) ELEM 'APPUYE' 'LARGEMENT' ((COOR 2 (CONT I)) POIN 'INFERIEUR' -0.01) ; "
    find = finder(box("QUA4", 40, 14, 20, 14, x=12.01, y=6.01) + sides + dampers + push)
    assert values(find, "L")[-1] > 2 * exact  # what a box without ground around it would do


def test_a_start_from_weight_is_kept():
    find = finder(
        box() + LAYER
        + "W = MI * (MANU 'CHPO' I 2 'UX' 0. 'UY' -9.81) ; "
        "BL = BLOQ 'UX' 'UY' (COTE 3 S) ; "
        "U0 = RESO (KI ET (RIGI N B) ET BL) W ; E . 'DEPL' = U0 ; "
        "LT = PROG 0. PAS 0.01 0.5 ; E . 'CHAR' = CHAR 'MECA' ((E . 'RIGI') * U0) "
        "(EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ; E . 'TEMPS_CALCULES' = LT ; "
        "E . 'PAS_SAUVES' = 1 ; R = DYNAMIC E ; Q = I POIN 'PROC' (0. 0.) ; "
        "L = EXTR (EVOL 'TEMP' R 'DEPL' 'UY' Q) 'ORDO' ; X = EXTR U0 'UY' Q ; "
    )  # fmt: skip
    assert find("X") < -1e-6
    assert values(find, "L") == pytest.approx(find("X"), rel=1e-8)


@together("change, told", [
        (("T . 'INTERIEUR' = I", "T . 'INTERIEUR' = S"), "does not reach beyond"),
        (("T . 'MODELE' = N", "N = MODE S MECANIQUE ELASTIQUE ; B = MATE N 'YOUN' 2.E8 'NU' 0.3 "
          "'RHO' 2000. ; T . 'MODELE' = N"), "in the box"),
        (("N = MODE (S DIFF I) MECANIQUE ELASTIQUE", "N = MODE (S DIFF I) MECANIQUE ELASTIQUE "
          "PLASTIQUE PARFAIT"), "PLASTIQUE PARFAIT"),
        (("MODE PLAN DEFO", "MODE PLAN CONT"), "plane strain"),
        (("P = @PML T", "T . 'REFLEXION' = 2. ; P = @PML T"), "0 < REFLEXION < 1"),
    ])  # fmt: skip
def test_refusals(change, told):
    script = box() + LAYER
    assert change[0] in script
    result = run_text(script.replace(*change, 1))
    assert result.exit_code == 1
    assert told in result.message, result.message


STEP = "E . 'TEMPS_CALCULES' = PROG 0. 0.1 ; R = DYNAMIC E ; "


@together(
    "script, told",
    [
        ("E . 'AMOR' = 0. * MI ; " + STEP, "without its AMOR"),
        ("E . 'MASS' = MI ; " + STEP, "without its MASS"),
        ("E . 'RIGI' = KI ; E . 'AMOR' = 0. * MI ; " + STEP, "without its RIGI AMOR"),
        ("U = RESO (E . 'RIGI') (FORC (0. 1.) (POIN I 1)) ; ", "no static stiffness"),
    ],
)
def test_part_of_a_layer_is_refused(script, told):
    result = run_text(box() + LAYER + script)
    assert result.exit_code == 1
    assert told in result.message, result.message


def test_a_thin_layer_is_told():
    result = run_text(box() + LAYER)
    assert [w.code for w in result.session.warnings] == ["operators.dynamics.thin-layer"]

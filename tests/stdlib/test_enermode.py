"""ENERMODE by closed forms; ORDOVIBC; SPPLANC: floor spectra by integrals and simulation."""

import numpy as np
import pytest
from scipy.linalg import expm
from script_runs import finder, ran

from ssilang.kernel.records.floors import Storey, floor_spectrum
from ssilang.kernel.records.modulated import (
    ModulatedSignal,
    Resolution,
    modulated_response_spectrum,
)
from ssilang.operators.drawing import curves as drawing

MASS = """
OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 39.478417604357434 P1 ;
B1 = VIBR 'SIMU' 1. 1 K1 (MASS 'UX' 1. P1) ; P2 = B1 . 'MODES' . 1 . 'POINT_REPERE' ;
"""
BAR = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; A = 0. 0. ; B = 8. 0. ; L = DROI 8 A B ;
MO = MODE L MECANIQUE ELASTIQUE BARR ; MA = MATE MO 'YOUN' 64. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
K = (RIGI MO MA) ET (BLOQ 'UX' A) ET (BLOQ 'UY' L) ; M = MASS MO MA ;
B1 = VIBR 'SIMU' 0.1 2 K M ; P1 = B1 . 'MODES' . 1 . 'POINT_REPERE' ;
P2 = B1 . 'MODES' . 2 . 'POINT_REPERE' ;
C = CHAR (FORC 'FX' 4. B) (EVOL 'MANU' (PROG 0. 1. 40.) (PROG 0. 1. 1.)) ;
TC = TABL 'CHARGEMENT' ; TC . 'BASE_A' = PJBA B1 C ; TI = TABL 'INITIAL' ;
TI . 'VITESSE' = (MANU 'CHPO' P1 1 'ALFA' 0.3) ET (MANU 'CHPO' P2 1 'ALFA' -0.2) ;
"""
OUTPUT = """
TV = TABL 'VARIABLE' ; TV . 'VITESSE' = VRAI ; TV . 'TRAVAIL_INTERIEUR' = VRAI ;
TV . 'TRAVAIL_EXTERIEUR' = VRAI ; TS = TABL 'SORTIE' ; TS . 'VARIABLE' = TV ;
"""
RUN = BAR + OUTPUT + "R = DYNE 'DE_VOGELAERE' B1 TC TI TS 400 0.01 ;"


@pytest.fixture
def drawn(monkeypatch):
    """Run a script; the times and the (external, internal, inertia, balance) of each picture."""
    pictures = []
    draw = drawing.draw_curves
    monkeypatch.setattr(
        drawing,
        "draw_curves",
        lambda curve, options: (pictures.append(curve), draw(curve, options))[1],
    )

    def run(script, folder):
        pictures.clear()
        result = ran(script, output_directory=folder)
        found = [(c.parts[0].abscissas, np.array([p.ordinates for p in c.parts])) for c in pictures]
        return result.session.root, found

    return run


def test_free_vibration_trades_motion_for_strain(drawn, tmp_path):
    _, [(t, works)] = drawn(
        MASS + OUTPUT + "TI = TABL 'INITIAL' ; TI . 'VITESSE' = MANU 'CHPO' P2 1 'ALFA' 2. ;"
        "R1 = DYNE 'DE_VOGELAERE' B1 TI TS 100 0.01 ; ENERMODE B1 R1 TI ;",
        tmp_path,
    )  # fmt: skip
    lost = 2.0 * np.sin(2 * np.pi * t) ** 2
    np.testing.assert_allclose(works[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(works[1], -lost, atol=2e-3)
    np.testing.assert_allclose(works[2], lost, atol=2e-3)
    np.testing.assert_allclose(works[3], works[:3].sum(axis=0), atol=1e-12)


def test_works_of_loaded_modes_are_the_integrals_of_their_powers(drawn, tmp_path):
    root, pictures = drawn(RUN + "ENERMODE B1 R TI VRAI ; ENERMODE B1 R TI ;", tmp_path)
    one, two, total = (works for _, works in pictures)
    np.testing.assert_allclose(one + two, total, atol=1e-12)
    assert np.abs(total[3]).max() < 1e-3 * np.abs(total[0]).max()
    t, shapes = pictures[0][0], root.find("B1").get("MODES")
    history = np.minimum(t, 1.0)
    for number, works in ((1, one), (2, two)):
        entry = shapes.get(number)
        mark, tip = entry.get("POINT_REPERE").node, root.find("B").node
        force = 4.0 * history * entry.get("DEFORMEE_MODALE").values_at("UX", np.array([tip]))[0]
        speed = np.array(
            [
                root.find("R").get(i + 1).get("VITESSE").values_at("ALFA", np.array([mark]))[0]
                for i in range(len(t))
            ]
        )
        power = force * speed
        exact = np.append(0.0, np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t)))
        np.testing.assert_allclose(works[0], exact, atol=2e-3 * np.abs(exact).max())


def test_runs_one_after_the_other_are_one_run(drawn, tmp_path):
    _, [(_, whole), (t, pieces)] = drawn(
        RUN + "S1 = DYNE 'DE_VOGELAERE' B1 TC TI TS 250 0.01 ; T2 = TABL 'INITIAL' ;"
        "T2 . 'REPRISE' = S1 . 'REPRISE' ; TR = TABL ; TR . 1 = S1 ;"
        "TR . 2 = DYNE 'DE_VOGELAERE' B1 TC T2 TS 150 0.01 ;"
        "TE = TABL 'ENSEMBLE_DE_BASES' ; TE . 1 = B1 ;"
        "ENERMODE B1 R ; ENERMODE TE TR ;",
        tmp_path,
    )  # fmt: skip
    assert t[250] == t[251]
    np.testing.assert_allclose(np.delete(pieces, 251, axis=1), whole, atol=1e-9)


SCRIPT = (
    "OPTI DIME 2 ; P1 = 0. 0. ; P2 = 1. 0. ; K1 = APPU 'UX' 4. P1 ; K2 = APPU 'UX' 9. P2 ; "
    "M = MASS 'UX' 1. (P1 ET P2) ; C = AMOR 'UX' 0.1 (P1 ET P2) ; "
    "B = VIBR 'SIMU' 0.1 2 (K1 ET K2) M ; MP = PJBA B M ; CP = PJBA B C ; "
    "T = VIBC MP (PJBA B (K1 ET K2)) CP ; ORDOVIBC T ; "
    "T2 = VIBC MP (PJBA B (K2 ET (4. * K1))) CP ; ORDOVIBC T2 T ; "
    "L1 = T . 'LISTE_FREQUENCES_REELLES' ; I1 = T . 'LISTE_FREQUENCES_IMAGINAIRES' ; "
    "L2 = T2 . 'LISTE_FREQUENCES_REELLES' ; F = T2 . 'MODES' . 3 . 'FREQUENCE_REELLE' ; "
)


def test_modes_increase_then_keep_their_shape():
    find = finder(SCRIPT)
    w = np.sqrt(np.array([4.0, 9.0]) - 0.05**2) / (2 * np.pi)
    np.testing.assert_allclose(find("L1").values, [-w[1], -w[0], w[0], w[1]], rtol=1e-9)
    np.testing.assert_allclose(find("I1").values, 0.05 / (2 * np.pi), rtol=1e-9)
    # the soft oscillator has become the stiff one (16 > 9): its modes keep their places
    moved = np.sqrt(np.array([16.0, 9.0]) - 0.05**2) / (2 * np.pi)
    np.testing.assert_allclose(find("L2").values, [-moved[1], -moved[0], moved[0], moved[1]])
    assert find("F") == find("L2").values[2]


def test_modes_of_a_projected_problem_stand_on_the_body():
    """As VIBC gives them itself where the real modes stand behind the matrices."""
    script = SCRIPT + (
        "RECOVIBC T B ; S = VIBC MP (PJBA B (K1 ET K2)) CP B ; ORDOVIBC S ; E = 0. ; "
        "REPE L 4 ; A1 = T . 'MODES' . &L ; A2 = S . 'MODES' . &L ; "
        "D1 = (A1 . 'DEFORMEE_MODALE_REELLE') - (A2 . 'DEFORMEE_MODALE_REELLE') ; "
        "D2 = (A1 . 'DEFORMEE_MODALE_IMAGINAIRE') - (A2 . 'DEFORMEE_MODALE_IMAGINAIRE') ; "
        "E = E + (MAXI 'ABS' D1) + (MAXI 'ABS' D2) ; FIN L ; "
        "X = XTX (T . 'MODES' . 1 . 'DEFORMEE_MODALE_REELLE') ; "
        "N1 = NBNO (T . 'MODES' . 'MAILLAGE') ; C = EXTR (A1 . 'DEFORMEE_MODALE_REELLE_P') 'COMP' ;"
        "RECOVIBC T B ; X2 = XTX (T . 'MODES' . 1 . 'DEFORMEE_MODALE_REELLE') ;"
    )
    find = finder(script)
    assert find("E") <= 1e-12
    assert find("X") > 0.1
    assert find("X2") == find("X")  # again: nothing changes
    assert list(find("C").values) == ["ALFA"]


def test_complex_modes_without_masses_are_told_and_drawn(tmp_path):
    shown = "RECOVIBC T B ; POSTVIBR T (MOTS 'TABL' 'LIST' 'DEFO') ; L = T . 'LISTE_FREQUENCES' ;"
    result = ran(SCRIPT + shown, output_directory=tmp_path)
    find = result.session.root.find
    np.testing.assert_array_equal(find("L").values, find("L1").values)
    assert f"{find('L1').values[0]:.5E}" in result.output


POWER = (np.array([0.2, 1.0, 5.0, 25.0]), np.array([0.1, 1.0, 0.8, 0.05]))
ENVELOPE = (np.array([0.0, 2.0, 8.0, 10.0]), np.array([0.0, 1.0, 1.0, 0.0]))
TWO = Storey(np.array([2.0, 7.0]), np.array([0.05, 0.05]), np.array([1.3, -0.4]))


def test_a_stiff_building_moves_with_its_ground():
    stiff = Storey(np.array([400.0]), np.array([0.3]), np.array([1.3]))
    f = np.array([0.5, 2.0, 10.0])
    deviations, factors = floor_spectrum(stiff, POWER, ENVELOPE, f, 0.05)
    ground = ModulatedSignal(*POWER, np.array([0.2, 25.0]), (ENVELOPE[0],), (ENVELOPE[1],))
    expected = modulated_response_spectrum(ground, 1.0 / f, 0.05, "DEPL", Resolution(50, 10, 5.0))
    np.testing.assert_allclose(deviations * factors, expected, rtol=3e-3)


def test_deviation_under_a_long_plateau_is_the_integral_of_the_stationary_answer():
    f0, xi = 3.0, 0.04
    steady = (np.array([0.0, 60.0]), np.array([1.0, 1.0]))
    deviation = floor_spectrum(TWO, POWER, steady, np.array([f0]), xi)[0][0]
    f = np.linspace(0.2, 25.0, 400_001)
    w, w0 = 2.0 * np.pi * f, 2.0 * np.pi * f0
    floor = np.ones(len(f), complex)
    for fn, x, c in zip(TWO.frequencies, TWO.dampings, TWO.participations, strict=True):
        wn = 2.0 * np.pi * fn
        floor += c * w**2 / (wn**2 - w**2 + 2j * x * wn * w)
    gain = np.abs(floor / (w0**2 - w**2 + 2j * xi * w0 * w)) ** 2
    variance = np.trapezoid(gain * np.interp(f, *POWER), f)
    assert deviation == pytest.approx(np.sqrt(variance), rel=5e-3)


@pytest.mark.parametrize("natural", [1.0, 2.0, 5.0])
def test_mean_of_the_largest_values_of_simulated_floors(natural):
    random = np.random.default_rng(5)
    step, n, count, xi = 0.005, 2200, 250, 0.02
    f = np.fft.rfftfreq(4096, step)
    density = np.where((f >= 0.2) & (f <= 25.0), np.interp(f, *POWER), 0.0)
    noise = random.normal(size=(count, len(f))) + 1j * random.normal(size=(count, len(f)))
    ground = np.fft.irfft(noise * np.sqrt(density * f[1]) / 2.0 * 4096, 4096)[:, :n]
    ground = ground * np.interp(step * np.arange(n), *ENVELOPE, right=0.0)
    w = 2.0 * np.pi * np.append(TWO.frequencies, natural)
    damping = np.append(TWO.dampings, xi)
    K, C = np.diag(w**2), np.diag(2.0 * damping * w)
    # the oscillator moves with its floor: M holds the accelerations of the modes
    M = np.eye(3)
    M[2, :2] = TWO.participations
    A = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    b = np.concatenate([np.zeros(3), -np.linalg.solve(M, np.ones(3))])
    E = expm(A * step)
    push = np.linalg.solve(A, (E - np.eye(6)) @ b)
    state, largest = np.zeros((count, 6)), np.zeros(count)
    for i in range(n):
        state = state @ E.T + ground[:, i, None] * push
        largest = np.maximum(largest, np.abs(state[:, 2]))
    deviation, factor = floor_spectrum(TWO, POWER, ENVELOPE, np.array([natural]), xi)
    # an oscillator in tune with a mode (2 Hz) has one long wave train: crossings are no law for it
    assert deviation[0] * factor[0] == pytest.approx(largest.mean(), rel=0.13)


FLOOR = """
T1 = TABL ; TS = TABL ; T1 . 'STRUC' = TS ; TS . 'NMODE' = 2 ;
TS . 'FREQU' = TABL ; TS . 'FREQU' . 1 = 2. ; TS . 'FREQU' . 2 = 7 ;
TS . 'AMORT' = TABL ; TS . 'AMORT' . 1 = 0.05 ; TS . 'AMORT' . 2 = 0.05 ;
TP = TABL ; T1 . 'PLANCH' = TP ; TP . 'COEFFPL' = TABL ;
TP . 'COEFFPL' . 1 = 1.3 ; TP . 'COEFFPL' . 2 = -0.4 ; TP . 'AMORTPL' = 0.02 ;
TP . 'TYPSPPL' = MOT '{kind}' ; TP . 'LISFREQ' = PROG 1. 4. ;
TE = TABL ; T1 . 'EXCIT' = TE ; TE . 'ENVE' = '{envelope}' ; TE . 'DUREE' = 10. ;
TE . 'TDEB' = {start} ; TE . 'TFIN' = 8. ;
TE . 'DSP' = EVOL 'MANU' 'FREQ' (PROG 0.2 1. 5. 25.) 'DSP' (PROG 0.1 1. 0.8 0.05) ;
T2 = SPPLANC T1 ; A = T2 . 'SIGM' ; B = T2 . 'FPIC' ; C = T2 . 'SPPL' ;
"""


@pytest.mark.parametrize(("kind", "power"), [("DEPL", 0), ("VITE", 1), ("ACCE", 2)])
def test_the_table_gives_the_spectrum(kind, power):
    result = ran(FLOOR.format(kind=kind, envelope="PLATLIN", start=2.0))
    f = np.array([1.0, 4.0])
    deviations, factors = floor_spectrum(TWO, POWER, ENVELOPE, f, 0.02)
    scale = (2.0 * np.pi * f) ** power
    a, b, c = (result.session.root.find(n).parts[0] for n in "ABC")
    np.testing.assert_allclose(a.ordinates, deviations * scale, rtol=1e-12)
    np.testing.assert_allclose(b.ordinates, factors, rtol=1e-12)
    np.testing.assert_allclose(c.ordinates, deviations * factors * scale, rtol=1e-12)
    np.testing.assert_array_equal(c.abscissas, f)

"""SISSIB against the modal combinations written out on a frame of three masses."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text

STIFFNESS = np.array([[900.0, -400, 0], [-400, 700, -300], [0, -300, 330]])
MASS = np.diag([1.0, 1.2, 0.8])
FREQUENCIES = [0.1, 1.0, 2.0, 4.0, 6.0, 10.0, 40.0]
SPECTRA = {0.02: [1, 4, 9, 8, 6, 3, 1.5], 0.1: [1, 2, 5, 4, 3, 2, 1.5]}
DIRECTIONS = {"X": 1.0, "Y": 0.7}


def frame(axis, scale):
    k = scale * STIFFNESS
    words = []
    for i, j in ((1, 2), (2, 3)):
        words.append(
            f"(MANU 'RIGI' (MANU 'SEG2' P{i} P{j}) (MOTS 'U{axis}') "
            f"(PROG {-k[i - 1, j - 1]} {k[i - 1, j - 1]} {-k[i - 1, j - 1]}))"
        )
    for i in (1, 2, 3):
        words.append(f"(APPU 'U{axis}' {k[i - 1].sum()} P{i})")
    return " ET ".join(words)


def script(rule, more=""):
    curves = " ET ".join(
        f"(EVOL 'MANU' (PROG {' '.join(map(str, FREQUENCIES))}) (PROG {' '.join(map(str, s))}))"
        for s in SPECTRA.values()
    )
    text = (
        "OPTI DIME 3 ELEM SEG2 ; P1 = 0. 0. 0. ; P2 = 0. 0. 1. ; P3 = 0. 0. 2. ;"
        f"K = {frame('X', 1)} ; L = {frame('Y', 1.7)} ; K = K ET L ;"
        "M = (MASS 'UX' 'UY' 1. P1) ET (MASS 'UX' 'UY' 1.2 P2) ET (MASS 'UX' 'UY' 0.8 P3) ;"
        "B = VIBR 'SIMU' 0.1 6 K M ; T = TABL 'DONNEE' ; T . 'STRUCTURE' = B ; LX = PROG ;"
        f"REPE B1 6 ; LX = LX ET (IPOL (B . 'MODES' . &B1 . 'FREQUENCE') (PROG 0. 10.) "
        "(PROG 0.02 0.1)) ; FIN B1 ; T . 'AMORTISSEMENT' = LX ;"
        f"T . 'RECOMBINAISON_MODES' = '{rule}' ; T . 'DUREE' = 6. ;"
        "T . 'SORTIES' = TABL 'SORTIES' ; T . 'SORTIES' . 'DEPLACEMENTS' = VRAI ;"
        f"T . 'SORTIES' . 'ACCELERATIONS' = VRAI ; T . 'EXCITATION' = TABL ; S = {curves} ;"
    )
    for i, (axis, factor) in enumerate(DIRECTIONS.items(), 1):
        text += (
            f"E = TABL ; E . 'DIRECTION' = '{axis}' ; E . 'SPECTRE' = S * {factor} ;"
            f"E . 'AMORTISSEMENT' = PROG 0.02 0.1 ; T . 'EXCITATION' . {i} = E ;"
        )
    return text + more


def damped(f):
    """Dampings of modes by their frequencies, and the spectrum there."""
    x = np.interp(f, [0, 10], [0.02, 0.1])
    low, high = (  # curves are lines on logarithmic paper
        np.exp(np.interp(np.log(f), np.log(FREQUENCIES), np.log(s))) for s in SPECTRA.values()
    )
    return x, low + (high - low) * (x - 0.02) / 0.08


def combined(rule, scale, factor, n_modes=3):
    """Displacements and accelerations of the masses in one direction, and the modal data."""
    squares, shapes = np.linalg.eig(np.linalg.solve(MASS, scale * STIFFNESS))
    order = np.argsort(squares)
    w, shapes = np.sqrt(squares[order]), shapes[:, order]
    f = w / (2 * np.pi)
    x, spectrum = damped(f)
    gamma = shapes.T @ MASS @ np.ones(3) / np.diag(shapes.T @ MASS @ shapes)
    acceleration = shapes * gamma * factor * spectrum
    found = []
    for answers in (acceleration / w**2, acceleration):
        if rule == "DIX_POUR_CENT":
            answers = np.abs(answers)
        total = np.zeros(3)
        for i in range(n_modes):
            for j in range(n_modes):
                total += answers[:, i] * answers[:, j] * correlation(rule, w, x, i, j)
        found.append(np.sqrt(total))
    return found, shapes * gamma, w


def correlation(rule, w, x, i, j):
    if i == j:
        return 1.0
    if rule == "CQC":
        r = w[j] / w[i]
        top = 8 * np.sqrt(x[i] * x[j]) * (x[i] + r * x[j]) * r**1.5
        bottom = (1 - r * r) ** 2 + 4 * x[i] * x[j] * r * (1 + r * r)
        return top / (bottom + 4 * (x[i] ** 2 + x[j] ** 2) * r * r)
    if rule == "ROSENBLUETH":
        wd, xd = w * np.sqrt(1 - x**2), x + 2 / (w * 6.0)
        return 1 / (1 + ((wd[i] - wd[j]) / (xd[i] * w[i] + xd[j] * w[j])) ** 2)
    return float(rule == "DIX_POUR_CENT" and abs(w[i] - w[j]) <= 0.1 * min(w[i], w[j]))


_READ = "".join(
    f"{n}{i} = EXTR (R . '{d}' . '{w}') '{c}' P{i} ;"
    for n, d, w, c in (
        ("D", "X", "DEPLACEMENTS", "UX"),
        ("A", "X", "ACCELERATIONS", "UX"),
        ("E", "Y", "DEPLACEMENTS", "UY"),
        ("F", "REPONSE_TOTALE", "ACCELERATIONS", "UY"),
    )
    for i in (1, 2, 3)
)


def read(text, *names):
    result = ran(text)
    root = result.session.root
    return [np.array([root.find(f"{n}{i}") for i in (1, 2, 3)]) for n in names]


@pytest.mark.parametrize("rule", ["SRSS", "CQC", "ROSENBLUETH", "DIX_POUR_CENT"])
def test_rules_of_combination(rule):
    found = read(script(rule) + "R = SISSIB T ;" + _READ, *"DAEF")
    (d, a), _, _ = combined(rule, 1.0, 1.0)
    (e, f), _, _ = combined(rule, 1.7, 0.7)
    np.testing.assert_allclose(found, (d, a, e, f), rtol=1e-8)


def test_directions_add_their_squares():
    text = script("CQC") + (
        "R = SISSIB T ; X = R . 'X' . 'DEPLACEMENTS' ;"
        "Y = R . 'Y' . 'DEPLACEMENTS' ; Z = R . 'REPONSE_TOTALE' . 'DEPLACEMENTS' ;"
        "D = MAXI (ABS ((Z * Z) - (X * X) - (Y * Y))) ;"
    )
    result = ran(text)
    assert result.session.root.find("D") < 1e-12


def test_results_serve_again():
    text = script("CQC") + (
        "R1 = SISSIB T ; T . 'REPRISE' = R1 . 'REPRISE' ;"
        "REPE B 2 ; T . 'EXCITATION' . &B . 'SPECTRE' = S * 100. ; FIN B ; R = SISSIB T ;"
    )
    found = read(text + _READ, "D")
    np.testing.assert_allclose(found[0], combined("CQC", 1.0, 1.0)[0][0], rtol=1e-8)


def test_truncation_adds_the_rigid_answer_of_the_modes_left_out():
    text = script("SRSS") + (
        "B = VIBR 'SIMU' 0.1 2 K M ; PM = PSMO K M (B . 'MODES') 'SEISME' 'UX' 'UY' ;"
        "B . 'PSEUDO_MODES' = PM ; T . 'STRUCTURE' = B ; T . 'TRONCATURE' = VRAI ;"
        "T . 'EXCITATION' . 1 . 'ACCELERATION_MAXIMALE' = 1.3 ; R = SISSIB T ;"
    )
    found = read(text + _READ, "D", "A")
    (d, a), shares, w = combined("SRSS", 1.0, 1.0, n_modes=1)
    kept = 1  # the two lowest modes are one along X and one along Y
    static = 1.3 * (shares[:, kept:] / w[kept:] ** 2).sum(axis=1)
    rigid = 1.3 * shares[:, kept:].sum(axis=1)
    np.testing.assert_allclose(found[0], np.hypot(d, static), rtol=1e-8)
    np.testing.assert_allclose(found[1], np.hypot(a, rigid), rtol=1e-8)


def test_accelerations_have_the_grounds_own_where_modes_are_left_out():
    """Masses that the modes do not move go with the ground; TRONCATURE is of pseudo-modes."""
    text = script("SRSS") + (
        "B = VIBR 'SIMU' 0.1 2 K M ; T . 'STRUCTURE' = B ;"
        "T . 'EXCITATION' . 1 . 'ACCELERATION_MAXIMALE' = 1.3 ; R = SISSIB T ;"
    )
    found = read(text + _READ, "D", "A")
    (d, a), shares, _ = combined("SRSS", 1.0, 1.0, n_modes=1)
    np.testing.assert_allclose(found[0], d, rtol=1e-8)
    np.testing.assert_allclose(found[1], np.hypot(a, 1.3 * shares[:, 1:].sum(axis=1)), rtol=1e-8)


def test_reactions_and_the_domain():
    text = script("SRSS", "K2 = K ET (BLOQ 'UX' 'UY' P1) ; B = VIBR 'SIMU' 0.1 4 K2 M ;") + (
        "B = REAC B K2 ; T . 'STRUCTURE' = B ; LX = PROG ; REPE B1 4 ; LX = LX ET "
        "(IPOL (B . 'MODES' . &B1 . 'FREQUENCE') (PROG 0. 10.) (PROG 0.02 0.1)) ; FIN B1 ;"
        "T . 'AMORTISSEMENT' = LX ; T . 'SORTIES' . 'REACTIONS' = VRAI ;"
        "T . 'SORTIES' . 'DOMAINE' = MANU 'POI1' P1 ; R = SISSIB T ;"
        "C = NBNO (EXTR (R . 'X' . 'DEPLACEMENTS') 'MAIL') ;"
        "Q = R . 'X' . 'REACTIONS' ; C1 = EXTR Q 'FX' P1 ; C2 = C ; C3 = 0. ;"
    )
    (found,) = read(text, "C")
    part = np.array([1, 2])
    squares, shapes = np.linalg.eig(
        np.linalg.solve(MASS[np.ix_(part, part)], STIFFNESS[np.ix_(part, part)])
    )
    f = np.sqrt(squares) / (2 * np.pi)
    spectrum = damped(f)[1]
    mass = MASS[np.ix_(part, part)]
    gamma = shapes.T @ mass @ np.ones(2) / np.diag(shapes.T @ mass @ shapes)
    answers = shapes * gamma * spectrum / squares
    assert found[1] == 1
    assert found[0] == pytest.approx(np.sqrt(((-400 * answers[0]) ** 2).sum()))


@together(
    "more, said",
    [
        ("T . 'RECOMBINAISON_MODES' = 'SOMME' ;", "SOMME"),
        ("T . 'SORTIES' = TABL ;", "asks for nothing"),
        ("T . 'AMORTISSEMENT' = PROG 0.05 ;", "1 dampings"),
        ("T . 'SORTIES' . 'CONTRAINTES' = VRAI ;", "CONTRAINTE_MODALE"),
        ("T . 'TRONCATURE' = VRAI ;", "PSEUDO_MODES"),
        ("T . 'EXCITATION' . 1 . 'AMORTISSEMENT' = PROG 0.05 ;", "SPECTRE has 2 curves"),
    ],
)
def test_what_is_missing_is_said(more, said):
    assert said in run_text(script("CQC", more) + "R = SISSIB T ;").message


FRAME = """
OPTI DIME 3 ELEM SEG2 ; A = 0. 0. 0. ; B = 0.3 0.2 4. ; L = DROI 4 A B ; CC = 0.1 0. 0. ;
MO = MODE L MECANIQUE ELASTIQUE POUT ;
MA = MATE MO YOUN 2.E10 NU 0.2 RHO 2500. SECT 0.1 INRY 2.E-3 INRZ 1.E-3 TORS 2.E-3 ;
K = (RIGI MO MA) ET (BLOQ DEPL ROTA A) ; M = (MASS MO MA) ET (MASS DEPL 800. B) ;
V = VIBR 'SIMU' 1. {modes} K M ; V = SIGS V MA MO ;
T = TABL 'DONNEE' ; T . 'STRUCTURE' = V ; T . 'AMORTISSEMENT' = PROG {modes} * 0.05 ;
T . 'RECOMBINAISON_MODES' = '{rule}' ; T . 'SORTIES' = TABL 'SORTIES' ;
T . 'SORTIES' . 'CONTRAINTES' = VRAI ; T . 'EXCITATION' = TABL ;
S = EVOL 'MANU' (PROG 0.1 5. 50.) (PROG 1. 8. 2.) ; N = MOTS X Y ;
REPE D 2 ; E = TABL ; E . 'DIRECTION' = EXTR N &D ; E . 'SPECTRE' = S * (FLOT &D) ;
  E . 'AMORTISSEMENT' = PROG 0.05 ; T . 'EXCITATION' . &D = E ; FIN D ;
F = TABL ; F . 1 = TABL ; F . 1 . 'TYPE' = 'POTEAU' ; F . 1 . 'MODE' = MO ;
R = SISSIB T F ; C = R . 'COVARIANCE' . 'POU1' ; Q = R . 'REPONSE_TOTALE' . 'CONTRAINTES' ;
G = R . 'CONTRAINTES_POUTRE' . 'POU1' ;
"""


def test_a_domain_that_is_a_model_gives_nodes_to_displacements_and_zones_to_forces():
    """A part has the values that the whole has there."""
    text = FRAME.format(modes=4, rule="SRSS").partition("R = SISSIB")[0] + (
        "T . 'SORTIES' . 'DEPLACEMENTS' = VRAI ; R = SISSIB T ;"
        "MB = REDU MO (ELEM L 'APPU' 'LARG' B) ;"
        "T . 'SORTIES' . 'DOMAINE' = MB ; R2 = SISSIB T ; U2 = R2 . 'X' . 'DEPLACEMENTS' ;"
        "NB = NBNO (EXTR U2 'MAIL') ; D = MAXI (ABS (U2 - (REDU (R . 'X' . 'DEPLACEMENTS') U2))) ;"
        "Q2 = R2 . 'Y' . 'CONTRAINTES' ; NE = NBEL (EXTR Q2 'MAIL') ;"
        "E = MAXI (ABS (Q2 - (REDU (R . 'Y' . 'CONTRAINTES') MB))) ; S = MAXI Q2 ;"
    )
    root = ran(text).session.root
    assert (root.find("NB"), root.find("NE")) == (2, 1)
    assert root.find("D") == 0.0
    assert root.find("E") == 0.0 < root.find("S")


def components(field):
    block = field.blocks[0]
    return {name: np.asarray(values).ravel() for name, values in block.components.items()}


@pytest.mark.parametrize("rule", ["SRSS", "CQC", "DIX_POUR_CENT"])
def test_envelopes_of_frames_hold_the_largest_forces(rule):
    result = ran(FRAME.format(modes=4, rule=rule))
    products = components(result.session.root.find("C"))
    largest = components(result.session.root.find("Q"))
    names = ["EFFX", "EFFY", "EFFZ", "MOMX", "MOMY", "MOMZ"]
    assert len(products) == 21
    for i, name in enumerate(names, 1):
        size = largest[name].max()
        np.testing.assert_allclose(
            np.sqrt(np.abs(products[f"C{i}{i}"])), largest[name], atol=1e-7 * size
        )
        for j in range(i + 1, 7):
            bound = np.sqrt(np.abs(products[f"C{i}{i}"] * products[f"C{j}{j}"]))
            assert (np.abs(products[f"C{i}{j}"]) <= bound * (1.0 + 1e-9) + 1e-12).all()


def test_products_of_two_forces_are_sums_over_modes_and_directions():
    text = FRAME.format(modes=2, rule="SRSS") + (
        "P = TABL ; REPE I 2 ; REPE J 2 ; X = G . &I . &J ;"
        " Y = (EXCO 'MOMY' X 'C') * (EXCO 'EFFZ' X 'C') ;"
        " SI ((&I + &J) EGA 2) ; W = Y ; SINON ; W = W + Y ; FINS ; FIN J ; FIN I ;"
        "Z = EXCO 'C35' C 'C' ; D = MAXI (ABS (Z - W)) ; N = MAXI (ABS W) ;"
    )
    result = ran(text)
    assert result.session.root.find("D") < 1e-9 * result.session.root.find("N")

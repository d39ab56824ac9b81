"""ISSLEQ: equivalent-linear soil against a column of layers solved by Fourier transform."""

import numpy as np
from script_runs import finder, ran
from together import together

from ssilang.cli.run import run_text

THICKNESS, DENSITY, YOUNG, POISSON = 1.0, 2000.0, 2.0e8, 0.25
F1, F2, CUTOFF, STEP, CHI = 2.0, 10.0, 12.5, 0.02, 0.7
STRAINS = np.array([0, 1e-5, 1e-4, 1e-3])
SHARES = np.array([1, 1, 0.75, 0.3])
DAMPINGS = np.array([0.02, 0.02, 0.06, 0.18])
TIMES = np.arange(151) * STEP


def signal(t):
    x = 2 * np.pi * 2.5 * (t - 1.6)
    return 2.5 * np.cos(x) * np.exp(-((x / 4) ** 2))


def numbers(values):
    return " ".join(f"{v:.12g}" for v in values)


def soil(n_layers, more=""):
    script = (
        "OPTI DIME 3 ELEM CUB8 ; L1 = DROI 1 (0. 0. 0.) (2. 0. 0.) ; S = TRAN 1 L1 (0. 2. 0.) ;"
        "T = TABL ; T . 'SOL' = TABL ; I = TABL ; K = TABL ;"
        f"LG = PROG {numbers(STRAINS)} ;"
        f"EG = EVOL 'MANU' LG (PROG {numbers(SHARES)}) ;"
        f"EH = EVOL 'MANU' LG (PROG {numbers(DAMPINGS)}) ; C = TABL ;"
        f"REPE B {n_layers} ; V = VOLU 'TRAN' 1 S (0. 0. -{THICKNESS}) ; C = TABL ;"
        "C . 'MAILLAGE' = V ; C . 'FRONTIERE' = FACE 3 V ; S = FACE 2 V ;"
        f"C . 'MODULE_E' = {YOUNG} ; C . 'POISSON' = {POISSON} ;"
        f"C . 'MASSE_VOLUMIQUE' = {DENSITY} ;"
        "C . 'G_GAMMA' = EG ; C . 'H_GAMMA' = EH ; I . &B = C ; FIN B ; C . 'BASE' = S ;"
        "P = TABL ; T . 'PARAMETRES' = P ; T . 'SOL' . 'ITERATION' = I ; P . 'POINT' = 0. 0. 0. ;"
        f"P . 'F1' = {F1} ; P . 'F2' = {F2} ; P . 'FC' = {CUTOFF} ; P . 'CHI' = {CHI} ;"
        f"P . 'CRITERE' = 0.02 ; P . 'GAMMAO_X' = EVOL 'MANU' (PROG {numbers(TIMES)}) "
        f"(PROG {numbers(signal(TIMES))}) ;"
    )
    return (
        script
        + more
        + "ISSLEQ T ; Z = T . 'STEP0' ; N = 0 ; REPE B 30 ;"
        + (
            "SI (NON (EXIS T (CHAI 'STEP' &B))) ; QUIT B ; FINSI ; N = &B ; FIN B ;"
            "U = T . (CHAI 'STEP' N) ; G = PROG ; H = PROG ; D = PROG ;"
            "REPE B (DIME I) ; G = G ET (MAXI (U . 'ITERATION' . 'T_GGO' . &B)) ;"
            "H = H ET (MAXI (U . 'ITERATION' . 'T_KSI' . &B)) ;"
            "D = D ET (MAXI (U . 'ITERATION' . 'T_DIS' . &B)) ; FIN B ;"
        )
    )


def column(shares, dampings):
    """Largest strains in the middle of layers under the signal at the free surface."""
    n = 2048
    t = np.arange(n) * STEP
    w = 2 * np.pi * np.fft.rfftfreq(n, STEP)[1:]
    u = -np.fft.rfft(signal(t))[1:] / w**2 * (w <= 2 * np.pi * CUTOFF)
    stress = np.zeros_like(u)
    mass_factor, stiffness_factor = 4 * np.pi * F1 * F2 / (F1 + F2), 1 / (np.pi * (F1 + F2))
    strains = []
    for share, damping in zip(shares, dampings, strict=True):
        modulus = share * YOUNG / (2 + 2 * POISSON) * (1 + 1j * w * damping * stiffness_factor)
        k = np.sqrt(DENSITY * (w**2 - 1j * w * damping * mass_factor) / modulus)
        a, b = u, stress / (modulus * k)
        for z in (THICKNESS / 2, THICKNESS):
            u = a * np.cos(k * z) + b * np.sin(k * z)
            slope = k * (b * np.cos(k * z) - a * np.sin(k * z))
            if z < THICKNESS:
                strains.append(np.abs(np.fft.irfft(np.concatenate([[0], slope]), n)).max())
        stress = modulus * slope
    return np.array(strains)


def equivalent_linear(n_layers):
    shares, dampings = np.ones(n_layers), np.full(n_layers, DAMPINGS[0])
    for _ in range(60):
        strains = column(shares, dampings)
        logarithm = np.log(CHI * strains)
        shares = np.interp(logarithm, np.log(STRAINS + 1e-12), SHARES)
        dampings = np.interp(logarithm, np.log(STRAINS + 1e-12), DAMPINGS)
    return shares, dampings, strains


def test_column_agrees_with_the_transfer_of_layers():
    find = finder(soil(5))
    shares, dampings, strains = equivalent_linear(5)
    assert shares[-1] < 0.8, "the case is not linear"
    np.testing.assert_allclose(find("D").values, strains, rtol=0.02)
    np.testing.assert_allclose(find("G").values, shares, rtol=0.02)
    np.testing.assert_allclose(find("H").values, dampings, rtol=0.03)
    assert find("N") >= 2


def test_constant_layers_keep_their_modulus():
    constant = (
        "K . 1 = I . 2 ; K . 1 . 'AMORTISSEMENT' = 0.05 ; T . 'SOL' . 'CONSTANTE' = K ; J = TABL ;"
        "J . 1 = I . 1 ; T . 'SOL' . 'ITERATION' = J ; I = J ;"
        "P . 'TYPE_CALCUL' = 'ISS_COMP_SIMP' ;"
    )
    find = finder(
        soil(2, constant)
        + "A = MINI (U . 'CONSTANTE' . 'O_GGO') ; B = MAXI (U . 'CONSTANTE' . 'O_KSI') ;"
        "C = NBEL (U . 'TOTALE' . 'O_SOL') ; D = EXIS T 'RES_DYN_X' ;"
        "E = MINI (U . 'ITERATION' . 'O_GGO') ;"
    )
    assert (find("A"), find("B"), find("C"), find("D")) == (1.0, 0.05, 2, True)
    assert find("E") < 1


@together(
    "more, said",
    [
        ("OUBL P 'GAMMAO_X' ;", "GAMMAO_X"),
        ("OUBL C 'BASE' ;", "BASE"),
        ("P . 'TYPE' = 'MIROIR' ;", "MIROIR"),
        ("P . 'TYPE_CALCUL' = 'ISS_COMP_SIMP' ;", "CONSTANTE"),
        ("OPTI DIME 2 ;", "3D"),
    ],
)
def test_what_is_missing_is_said(more, said):
    assert said in run_text(soil(1, more)).message


def test_damping_is_rayleighs_with_the_factor_of_each_layer():
    result = ran(
        soil(2, "I . 2 . 'H_GAMMA' = EH * 3. ; P . 'CRITERE' = 100. ;")
        + "Z = Z . 'ITERATION' ; A = PROG ; B = PROG ;"
        f"F1 = {F1} ; F2 = {F2} ; AL = 4. * PI * F1 * F2 / (F1 + F2) ; BE = 1. / (PI * (F1 + F2)) ;"
        "REPE B 2 ; X Y W = COOR (Z . 'T_SOL' . &B) ; V = (NOMC 'UX' (W * W)) ET (NOMC 'UZ' X) ;"
        "XI = 0.02 * (2 * &B - 1) ; A = A ET (XTMX V (Z . 'T_AMO' . &B)) ;"
        "B = B ET (XI * AL * (XTMX V (Z . 'T_MAS' . &B)) + (XI * BE * (XTMX V (Z . 'T_RIG' . &B))))"
        " ; FIN B ;"
    )
    found, exact = (result.session.root.find(n).values for n in "AB")
    assert len(found) == 2
    np.testing.assert_allclose(found, exact, rtol=1e-9)

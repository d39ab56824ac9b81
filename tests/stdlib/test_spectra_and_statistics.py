"""FTRAN EC8ACSIS FDENS REPART PARASTAT RAMBERG against closed forms."""

import numpy as np
import pytest
from scipy import stats
from script_runs import found
from together import together


def curve(value, part=0):
    return np.asarray(value.parts[part].abscissas), np.asarray(value.parts[part].ordinates)


def test_transfer_of_a_delay_has_modulus_one_and_a_phase_that_grows_with_frequency():
    value = found(
        "LT = PROG 0. PAS 0.01 2.55 ; X = LT - 0.5 * 30. ; Y = LT - 0.53 * 30. ;"
        "E1 = EVOL 'MANU' LT (EXP (X * X * -1.)) ; E2 = EVOL 'MANU' LT (EXP (Y * Y * -1.)) ;"
        "T1 = FTRAN E2 E1 8. 2 ;",
        "T1",
    )
    f, modulus = curve(value)
    assert f[0] == pytest.approx(2 / 2.56)
    assert f[-1] < 8
    np.testing.assert_allclose(modulus, 1, rtol=1e-6)
    assert len(value.parts) == 1


EC8 = (
    "T = TABL ; T . 'TYPE' = 'GSIG' ; T . 'SOIL' = 'B' ; T . 'AG' = 300. ; T . 'TINI' = 0.05 ;"
    "T . 'TFIN' = 20. ;"
)


def test_code_spectrum_branches():
    t, a = curve(found(EC8 + "E = EC8ACSIS T ;", "E"))
    up, flat, down = t < 0.2, (t >= 0.2) & (t <= 0.6), (t > 0.6) & (t < 3.3)
    np.testing.assert_allclose(a[up], 300 * (1 + t[up] / 0.2 * 1.5))
    np.testing.assert_allclose(a[flat], 750)
    np.testing.assert_allclose(a[down], 750 * 0.6 / t[down])
    assert t[0] == pytest.approx(0.05)
    assert t[-1] == pytest.approx(20)


def test_code_spectrum_displacement_is_bounded():
    t, d = curve(found(EC8 + "T . 'GRAN' = MOT 'DEPL' ; E = EC8ACSIS T ;", "E"))
    bound = 1.4 * 90 * 300 / 980.665
    assert d.max() == pytest.approx(bound)
    np.testing.assert_allclose(d[t > 0.99 * t[np.argmax(d)]], bound, rtol=0.02)


def test_design_spectrum_is_reduced_and_has_a_floor():
    script = EC8 + "T . 'TYPE' = 'ALIN' ; T . 'Q' = 2.5 ; E = EC8ACSIS T ;"
    t, a = curve(found(script, "E"))
    assert a.max() == pytest.approx(300.0)
    np.testing.assert_allclose(a[t > 3.1], 60.0)
    f, b = curve(found(script + "T . 'ABSC' = 'FREQ' ; F = EC8ACSIS T ;", "F"))
    np.testing.assert_allclose(1 / f[::-1], t)
    np.testing.assert_allclose(b[::-1], a)


LAWS = {
    "LOI_UNIFORME": ("A -1. B 3.", stats.uniform(-1, 4)),
    "LOI_DE_LAPLACE": ("", stats.laplace()),
    "LOI_NORMALE_STANDARD": ("", stats.norm()),
    "LOI_EXPONENTIELLE": ("LAMBDA 2. MU 0.3", stats.expon(0.3, 0.5)),
    "LOI_LOGNORMALE": (
        "MOYENNE 2. ECART_TYPE 0.8",
        stats.lognorm(np.sqrt(np.log(1.16)), scale=2 / np.sqrt(1.16)),
    ),
    "LOI_NORMALE": ("MOYENNE 1. ECART_TYPE 0.5", stats.norm(1, 0.5)),
    "LOI_WEIBULL_MIN": ("TAU 0.2 K 1.7 W 1.4", stats.weibull_min(1.7, 0.2, 1.2)),
    "LOI_NORMALE_TRONQUEE": (
        "MOYENNE 1. ECART_TYPE 0.5 MIN 0.5 MAX 1.8", stats.truncnorm(-1, 1.6, 1, 0.5),
    ),
    "LOI_NORMALE_TRONQUEE_INF": (
        "MOYENNE 1. ECART_TYPE 0.5 MIN 0.5", stats.truncnorm(-1, np.inf, 1, 0.5),
    ),
    "LOI_EXPONENTIELLE_TRONQUEE": (
        "LAMBDA 2. MU 0.3 MIN 0.5 MAX 1.5", stats.truncexpon(2, 0.5, 0.5),
    ),
    "LOI_GUMBEL_MAX": ("LAMBDA 2. MU 0.6", stats.gumbel_r(0.6, 0.5)),
    "LOI_DE_FRECHET": ("U 1.2 K 2.5 B 0.1", stats.invweibull(2.5, 0.1, 1.1)),
}  # fmt: skip


@together("law", LAWS)
def test_laws_are_those_of_scipy(law):
    words, exact = LAWS[law]
    pairs = words.split()
    entries = "".join(f"T . '{n}' = {v} ;" for n, v in zip(pairs[::2], pairs[1::2], strict=True))
    points = [-1.5, 0.05, 0.7, 1.3, 2.6]
    script = f"T = TABL ; T . 'TYPVA' = '{law}' ; {entries} D = PROG ; F = PROG ;"
    for x in points:
        script += f"D = D ET (FDENS T {x}) ; F = F ET (REPART T {x}) ;"
    density, distribution = found(script, "D", "F")
    np.testing.assert_allclose(density.values, exact.pdf(points), atol=1e-12, rtol=1e-9)
    np.testing.assert_allclose(distribution.values, exact.cdf(points), atol=1e-12, rtol=1e-9)


def test_moments_of_a_gaussian_by_quadrature():
    points, weights = np.polynomial.hermite_e.hermegauss(5)
    script = "T = TABL ;"
    for i, (x, w) in enumerate(zip(points, weights, strict=True), 1):
        x = 3 + 2 * x
        script += f"T . {i} = TABL ; T . {i} . 'POINT' = {x:.17g} ; T . {i} . 'POIDS' = {w:.17g} ;"
    values = found(script + "A B C D = PARASTAT T ;", "A", "B", "C", "D")
    np.testing.assert_allclose(values, (3, 2, 0, 3), atol=1e-12)


def test_moments_of_an_exponential_sample():
    x = stats.expon.rvs(size=40, random_state=3)
    script = "T = TABL ;" + "".join(
        f"T . {i} = TABL ; T . {i} . 'POINT' = {v:.17g} ; T . {i} . 'POIDS' = 1. ;"
        for i, v in enumerate(x, 1)
    )
    values = found(script + "A B C D = PARASTAT T ;", "A", "B", "C", "D")
    exact = (x.mean(), x.std(), stats.skew(x), stats.kurtosis(x, fisher=False))
    np.testing.assert_allclose(values, exact)


def test_ramberg_osgood_finds_the_law_again():
    stress = np.array([200, 240, 290, 330.0])
    strain = 1e-3 * (stress / 250 + 0.7 * (stress / 250) ** 6)
    lists = [" ".join(f"{v:.17g}" for v in part) for part in (strain, stress)]
    table = found(
        f"T = TABL ; T . 'SIG0' = 250 ; T . 'EPS0' = 1.E-3 ; T . 'COURBE_TRACTION' = "
        f"EVOL 'MANU' (PROG {lists[0]}) (PROG {lists[1]}) ; RAMBERG T ; A = T . 'ALPHA' ;"
        "N = T . 'N' ; R = T . 'AJUSTEMENT' ; E = T . 'COURBE_RAMBERG' ;",
        "A", "N", "R", "E",
    )  # fmt: skip
    np.testing.assert_allclose(table[:3], (0.7, 6, 1))
    np.testing.assert_allclose(curve(table[3]), (strain, stress))

"""@FRAGILITE @PASSAGE: what scripts write against the kernel; what is refused and told."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.records.fragility import of_cloud, of_exceedances
from ssilang.language.say.diagnostics import sentence

X = np.array([2.0, 1.0, 4.0, 3.0, 2.5, 3.0])
D = np.array([3.0, 1.0, 6.0, 3.5, 4.5, 4.2])
RECORDS = np.array([1, 2, 1, 5, 3, 4])
SUITE = (
    "T = TABL ; T . 'INTENSITES' = PROG 2. 1. 4. 3. 2.5 3. ; "
    "T . 'DEMANDES' = PROG 3. 1. 6. 3.5 4.5 4.2 ; T . 'SEUIL' = 4. ;"
)


def found(text):
    result = ran(text + "R = @FRAGILITE T ;")
    table = result.session.root.find("R")
    values = [table.get("MEDIANE"), table.get("DISPERSION"), *table.get("ECARTS").values]
    return values, table, [w.code for w in result.session.warnings]


def parts(fit):
    return [fit.median, fit.dispersion, fit.median_error, fit.dispersion_error]


def test_runs_in_any_order_with_ties_give_the_kernels_fit_and_its_curve():
    values, table, told = found(SUITE)
    fit = of_exceedances(X, (D > 4.0).astype(float), np.ones(6))
    assert values == pytest.approx(parts(fit))
    assert table.get("BORNES").values == pytest.approx(fit.bounds(), rel=1e-6)
    assert (table.get("DEPASSEMENTS"), told) == (3, [])
    curve = table.get("COURBE").parts[0]
    assert np.interp(fit.median, curve.abscissas, curve.ordinates) == pytest.approx(0.5, abs=1e-9)


def test_fewer_than_five_records_at_several_scales_tell_no_errors():
    values, _, told = found(SUITE + "T . 'SIGNAUX' = LECT 1 2 1 2 3 3 ;")
    assert np.isnan(values[2:]).all()
    assert values[:2] == pytest.approx(parts(of_exceedances(X, (D > 4.0) * 1.0, np.ones(6)))[:2])
    assert told == ["operators.curves.fragility-few-records"]


def test_factors_that_fall_and_records_at_several_scales():
    falling = SUITE.replace(
        "PROG 3. 1. 6. 3.5 4.5 4.2", "(PROG 6 * 12.) / (PROG 3. 1. 6. 3.5 4.5 4.2)"
    )
    more = "T . 'SEUIL' = 3. ; T . 'SENS' = 'DESSOUS' ; T . 'SIGNAUX' = LECT 1 2 1 5 3 4 ;"
    counts = of_exceedances(X, (D > 4.0).astype(float), np.ones(6), RECORDS)
    assert found(falling + more)[0] == pytest.approx(parts(counts))
    cloud = of_cloud(X, D, 4.0, capacity=0.3, records=RECORDS)
    more += "T . 'METHODE' = 'NUAGE' ; T . 'CAPACITE' = 0.3 ;"
    assert found(falling + more)[0] == pytest.approx(parts(cloud))


def test_counts_at_levels():
    text = (
        "T = TABL ; T . 'INTENSITES' = PROG 3. 1. 2. ; T . 'DEPASSEMENTS' = LECT 9 1 4 ; "
        "T . 'ESSAIS' = LECT 10 12 10 ;"
    )
    fit = of_exceedances(np.array([3.0, 1, 2]), np.array([9.0, 1, 4]), np.array([10.0, 12, 10]))
    assert found(text)[0] == pytest.approx(parts(fit))


@together(
    "more, code",
    [
        ("T . 'SEUIL' = 9. ; T . 'METHODE' = 'NUAGE' ;", "stdlib.fragilite-beyond"),
        ("T . 'CAPACITE' = 0.3 ;", "stdlib.fragilite-capacity"),
        ("T . 'ESSAIS' = LECT 6 * 2 ;", "stdlib.fragilite-runs"),
    ],
)
def test_what_is_not_used_or_goes_beyond_the_runs_is_told(more, code):
    assert code in found(SUITE + more)[2]


BASE = (
    "T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 20. ; T . 'YOUNG' = 2.E8 ; "
    "T . 'POISSON' = 0.25 ; T . 'MASSE_VOLUMIQUE' = 2000. ; "
)
RECORD = "LT = PROG 0. PAS 0.005 10. ; G = EVOL 'MANU' LT (SIN (720. * LT)) ; "


def told(result):
    return [sentence(w, "en")[0] for w in result.session.warnings]


def test_a_record_turns_the_base_by_the_slope_of_the_wave():
    """2 Hz at 4000 m/s: the raft is small, theta'' = -(dv''/dt)/c for VERT, half of it for HORI."""
    script = BASE + RECORD + (
        "T . 'VITESSE_APPARENTE' = 4000. ; T . 'ACCELERATION' = G ; R = @PASSAGE T ; "
        "A = EXTR (R . 'ACCELERATION_ANGULAIRE') 'ORDO' ; T . 'COMPOSANTE' = 'HORI' ; "
        "S = @PASSAGE T ; B = EXTR (S . 'ACCELERATION_ANGULAIRE') 'ORDO' ;"
    )  # fmt: skip
    result = ran(script)
    a, b = (result.session.root.find(n).values for n in "AB")
    t = 0.005 * np.arange(len(a))
    w, middle = 4 * np.pi, slice(800, 1200)
    slope = -(w / 4000.0) * np.cos(w * t)
    np.testing.assert_allclose(a[middle], slope[middle], atol=2e-3 * w / 4000.0)
    np.testing.assert_allclose(b, a / 2, atol=1e-15)
    assert not told(result)


def test_a_strip_moves_by_the_mean_of_the_wave_below():
    """An accelerogram of 8 Hz that takes 0.08 s below it, by the integral of (1 - 2 y) exp(-y)."""
    script = BASE + (
        "T . 'FORME' = 'BANDE' ; T . 'DEMI_LARGEUR' = 12. ; T . 'VITESSE_APPARENTE' = 300. ; "
        "LT = PROG 0. PAS 0.004 2. ; LY = (PI * 8. * (LT - 1.)) ** 2 ; "
        "T . 'ACCELERATION' = EVOL 'MANU' LT ((1. - (2. * LY)) * (EXP (-1. * LY))) ; "
        "R = @PASSAGE T ; A = EXTR (R . 'ACCELERATION') 'ORDO' ;"
    )
    result = ran(script)
    t = 0.004 * np.arange(501) - 1.0
    integral = [s * np.exp(-((np.pi * 8.0 * s) ** 2)) for s in (t + 0.04, t - 0.04)]
    found = result.session.root.find("A").values
    np.testing.assert_allclose(found, (integral[0] - integral[1]) / 0.08, rtol=0, atol=1e-8)


@pytest.mark.parametrize(("zeros", "early"), [(0.0, True), (0.1, False)])
def test_a_wave_at_the_edge_before_the_record_begins_is_told(zeros, early):
    """20 m at 400 m/s: the edge moves 0.05 s before the centre."""
    record = f"(LT MASQ 'COMPRIS' {zeros} {zeros + 0.2})"
    pulse = f"LT = PROG 0. PAS 0.002 1. ; G = EVOL 'MANU' LT {record} ; "
    result = ran(
        BASE.replace("'DISQUE'", "'BANDE'").replace("RAYON", "DEMI_LARGEUR")
        + pulse + "T . 'VITESSE_APPARENTE' = 400. ; T . 'ACCELERATION' = G ; R = @PASSAGE T ;"
    )  # fmt: skip
    texts = [text for text in told(result) if "before its record begins" in text]
    assert len(texts) == early
    if early:
        seconds = float(texts[0].split("moves ")[1].split(" s ")[0])
        assert 0.04 < seconds < 0.06


@together(
    "more, words",
    [
        ("T . 'FREQUENCES' = PROG 1. ;", "the motion is the same everywhere"),
        ("T . 'FREQUENCES' = PROG 1. ; T . 'INCOHERENCE' = 0.7 ;", "beyond what arrays have shown"),
        ("T . 'FREQUENCES' = PROG 1. ; T . 'VITESSE_APPARENTE' = 150. ;", "slower than Rayleigh's"),
    ],
)
def test_what_is_doubtful_is_told(more, words):
    result = ran(BASE + more + "R = @PASSAGE T ;")
    assert [words in text for text in told(result)] == [True]

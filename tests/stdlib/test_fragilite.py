"""@FRAGILITE: what scripts write against the kernel's fits; what is refused and told."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.records.fragility import of_cloud, of_exceedances

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

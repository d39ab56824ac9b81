"""Fragility: the probability that a demand passes its limit, lognormal in the intensity.

`P = Phi(ln(x / median) / dispersion)` at intensity `x`, from runs under a suite of records:

- stripes and incremental dynamic analysis: maximum likelihood of the exceedances that were counted,
  binomial at each intensity (Shinozuka et al., J. Eng. Mech. 126 (2000); Baker, Earthquake Spectra
  31 (2015)). It is a probit model in `ln x`, whose likelihood is concave; a maximum exists where
  runs that exceed and runs that do not overlap in intensity (Silvapulle, J. R. Stat. Soc. B 43
  (1981)), and nothing is given where they do not;
- a cloud: `ln demand = a + b ln x + e`, least squares (Cornell et al., J. Struct. Eng. 128 (2002)).
  It goes on beyond the demands that were reached, where line and scatter are taken to be the same.

Standard errors are those of the information at the fit. Runs of one record at several scales are
not independent: where records are named, scores are summed by record first (the sandwich of Liang
and Zeger, Biometrika 73 (1986)).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import optimize, special, stats

_FARTHEST = 700.0  # logarithm of a median that is still a number
LEAST_RUNS = 3
"""Two parameters and a degree of freedom."""
LEAST_RECORDS = 5
"""Of which errors by record are given: fewer scores tell too little of their scatter."""
_SAME = 1e-9
"""Of logarithms of intensities: records scaled to one level differ by rounding."""
_LEAST_SLOPE = 1e-6
"""Of the probit over a standard deviation of the intensities: less is none."""


@dataclass(frozen=True)
class Fragility:
    """A lognormal fragility.

    Attributes
    ----------
    median : float
        Intensity at which one run of two exceeds, in the unit of the intensities.
    dispersion : float
        Standard deviation of the logarithm of the intensity at which a run exceeds.
    median_error, dispersion_error : float
        Standard errors of the median's logarithm and of the dispersion; nan of runs of fewer
        than `LEAST_RECORDS` records at several intensities.
    exceeded, runs : int
        Runs that passed the limit, and all.
    """

    median: float
    dispersion: float
    median_error: float
    dispersion_error: float
    exceeded: int
    runs: int

    def probability(self, intensities: FloatArray) -> FloatArray:
        """Probabilities (n,) of exceedance at intensities above zero."""
        return np.asarray(stats.lognorm.cdf(intensities, self.dispersion, scale=self.median), float)

    def bounds(self, level: float = 0.95) -> tuple[float, float]:
        """Interval of confidence of the median, normal in its logarithm."""
        spread = np.exp(stats.norm.ppf(0.5 + 0.5 * level) * self.median_error)
        return float(self.median / spread), float(self.median * spread)


def of_exceedances(
    intensities: FloatArray,
    exceeded: FloatArray,
    runs: FloatArray,
    records: NDArray[np.int_] | None = None,
) -> Fragility:
    """Fragility by maximum likelihood of counts.

    Parameters
    ----------
    intensities : array (n,)
        Above zero, in any order; the same one may come several times.
    exceeded, runs : arrays (n,)
        How many runs passed the limit there, of how many.
    records : array of int (n,), optional
        Which record each entry is of, where records come at several intensities.

    Raises
    ------
    FieldError
        If no maximum exists, or exceedances do not grow with intensity.
    """
    x = _logarithms(intensities, exceeded, runs)
    if ((exceeded < 0.0) | (exceeded > runs)).any():
        raise FieldError("kernel.records.fragility-counts")
    total, passed = int(runs.sum()), int(exceeded.sum())
    if total < LEAST_RUNS:
        raise FieldError("kernel.records.fragility-runs", n=total)
    if passed == 0:
        raise FieldError("kernel.records.fragility-none", n=total, highest=intensities.max())
    if passed == total:
        raise FieldError("kernel.records.fragility-all", n=total, lowest=intensities.min())
    if not np.ptp(x) > _SAME:
        raise FieldError("kernel.records.fragility-one-level", intensity=intensities[0])
    above, below = intensities[exceeded > 0.0], intensities[exceeded < runs]
    if above.max() <= below.min() * (1.0 + _SAME):
        raise FieldError("kernel.records.fragility-falls")
    if below.max() <= above.min() * (1.0 + _SAME):
        raise FieldError("kernel.records.fragility-separated", low=below.max(), high=above.min())
    centre, scale = x.mean(), x.std()
    rows = np.column_stack([np.ones(len(x)), (x - centre) / scale])

    def terms(p: FloatArray) -> tuple[float, FloatArray, FloatArray]:
        """What is lost of the likelihood, scores (n, 2), information (2, 2)."""
        eta, held = rows @ p, runs - exceeded
        up, down = (np.exp(stats.norm.logpdf(eta) - special.log_ndtr(s * eta)) for s in (1.0, -1.0))
        missed = -float(exceeded @ special.log_ndtr(eta) + held @ special.log_ndtr(-eta))
        weights = exceeded * up * (up + eta) + held * down * (down - eta)
        return (
            missed,
            (exceeded * up - held * down)[:, None] * rows,
            rows.T @ (weights[:, None] * rows),
        )

    start = np.array([float(stats.norm.ppf(passed / total)), 1.0])
    found = optimize.minimize(
        lambda p: terms(p)[0],
        start,
        method="trust-exact",
        jac=lambda p: -terms(p)[1].sum(axis=0),
        hess=lambda p: terms(p)[2],
        tol=1e-10 * float(total),
    ).x
    a, b = found[0] - found[1] * centre / scale, found[1] / scale
    if not found[1] > _LEAST_SLOPE:
        raise FieldError("kernel.records.fragility-falls")
    back = np.array([[1.0, -centre / scale], [0.0, 1.0 / scale]])
    _, scores, information = terms(found)
    spread = back @ _covariance(information, scores, records) @ back.T
    # ln median = -a / b, dispersion = 1 / b
    to = np.array([[-1.0 / b, a / b**2], [0.0, -1.0 / b**2]])
    errors = np.sqrt(np.diag(to @ spread @ to.T))
    return Fragility(
        float(np.exp(-a / b)), float(1.0 / b), float(errors[0]), float(errors[1]), passed, total
    )


def of_cloud(
    intensities: FloatArray,
    demands: FloatArray,
    limit: float,
    *,
    below: bool = False,
    capacity: float = 0.0,
    records: NDArray[np.int_] | None = None,
) -> Fragility:
    """Fragility by the line of the demands' logarithms over those of the intensities.

    Parameters
    ----------
    intensities, demands : arrays (n,)
        Above zero, one entry a run.
    limit : float
        The demand that counts as exceedance: the capacity's median.
    below : bool
        Whether lower demands exceed (factors of safety, share in contact).
    capacity : float
        Dispersion of the capacity, added to the scatter of the demands as squares.
    records : array of int (n,), optional
        Which record each run is of, where records come at several intensities.

    Raises
    ------
    FieldError
        For demands that have no logarithm, or do not move towards the limit with intensity.
    """
    x = _logarithms(intensities, demands)
    n = len(x)
    if n < LEAST_RUNS:
        raise FieldError("kernel.records.fragility-runs", n=n)
    wrong = demands[~((demands > 0.0) & np.isfinite(demands))]
    if len(wrong) or not limit > 0.0:
        value = wrong[0] if len(wrong) else limit
        raise FieldError("kernel.records.fragility-demand", value=value)
    if not capacity >= 0.0:
        raise FieldError("kernel.records.fragility-capacity", value=capacity)
    if not np.ptp(x) > _SAME:
        raise FieldError("kernel.records.fragility-one-level", intensity=intensities[0])
    y = np.log(demands)
    line = stats.linregress(x, y)
    a, b = float(line.intercept), float(line.slope)
    goes, away = (b < 0.0 if below else b > 0.0), np.log(limit) - a
    if not goes or abs(away) > _FARTHEST * abs(b):  # a slope of rounding
        raise FieldError("kernel.records.fragility-cloud-falls", slope=b)
    e = y - a - b * x
    variance = float(e @ e) / (n - 2)
    rest = variance + capacity**2
    median = float(np.exp(away / b))
    passed = int(((demands < limit) if below else (demands > limit)).sum())
    if variance <= 1e-24 * max(1.0, float(y.var())):
        if capacity == 0.0:
            raise FieldError("kernel.records.fragility-no-scatter", median=median)
        return Fragility(median, capacity / abs(b), 0.0, 0.0, passed, n)
    rows = np.column_stack([np.ones(n), x])
    # unknowns: a, b, variance
    information = np.zeros((3, 3))
    information[:2, :2] = rows.T @ rows / variance
    information[2, 2] = 0.5 * (n - 2) / variance**2
    scores = np.column_stack([rows * e[:, None], 0.5 * (e**2 - e @ e / n) / variance]) / variance
    spread = _covariance(information, scores, records)
    dispersion = float(np.sqrt(rest)) / abs(b)
    to = (
        np.array([[-1.0, -np.log(median), 0.0], [0.0, -dispersion, 0.5 * dispersion * b / rest]])
        / b
    )
    errors = np.sqrt(np.diag(to @ spread @ to.T))
    return Fragility(median, dispersion, float(errors[0]), float(errors[1]), passed, n)


def _logarithms(intensities: FloatArray, *others: FloatArray) -> FloatArray:
    """Of intensities, as many as of all others and above zero."""
    if any(len(other) != len(intensities) for other in others):
        sizes = [len(intensities), *(len(other) for other in others)]
        raise FieldError("kernel.records.fragility-sizes", sizes=sizes)
    wrong = intensities[~((intensities > 0.0) & np.isfinite(intensities))]
    if len(wrong):
        raise FieldError("kernel.records.fragility-intensity", value=wrong[0])
    return np.log(intensities)


def _covariance(
    information: FloatArray, scores: FloatArray, records: NDArray[np.int_] | None
) -> FloatArray:
    """Of the parameters: the inverse information, about the scores of whole records if named."""
    inverse = np.asarray(np.linalg.inv(information), float)
    if records is None or len(set(records.tolist())) == len(records):
        return inverse
    _, which = np.unique(records, return_inverse=True)
    count = int(which.max()) + 1
    if count < LEAST_RECORDS:
        return np.full_like(inverse, np.nan)
    sums = np.zeros((count, scores.shape[1]))
    np.add.at(sums, which, scores)
    return np.asarray(inverse @ (sums.T @ sums * (count / (count - 1))) @ inverse)

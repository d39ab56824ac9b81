"""ZFRA: a fragility from counts, or from a cloud of demands, for @FRAGILITE."""

from dataclasses import astuple

from ssilang.kernel.records.fragility import LEAST_RECORDS, Fragility, of_cloud, of_exceedances
from ssilang.operators.prelude import *

_POINTS = 121
_INTENSITIES = arg("intensities", "LISTREEL", en="intensities", range=POSITIVE)
_RECORDS = key("records", "SIGN", "LISTENTI", range=ANY_NUMBER, en="record of each, by number")


@operator("ZFRA", family="signals", gives=("EVOLUTIO", "LISTREEL"))
def zfra(
    call: Call,
    intensities: ListReel = _INTENSITIES,
    exceeded: ListReel = Arg("LISTREEL", en="runs that exceed at each", range=NOT_NEGATIVE),
    runs: ListReel | None = Opt("LISTREEL", en="runs at each, 1 without it", range=POSITIVE),
    records: ListEnti | None = _RECORDS,
) -> tuple[Curve, ListReel]:
    """From counts."""
    of = np.ones(len(exceeded.values)) if runs is None else runs.values
    which = None if records is None else records.values
    return _told(call, of_exceedances(intensities.values, exceeded.values, of, which))


@zfra.form(said("NUAG"), gives=("EVOLUTIO", "LISTREEL"))
def _cloud(
    call: Call,
    word: str,
    intensities: ListReel = _INTENSITIES,
    demands: ListReel = Arg("LISTREEL", en="demand of each run", range=ANY_NUMBER),
    limit: float = Arg("FLOTTANT", en="demand that counts", range=ANY_NUMBER),
    below: bool = Flag("DESS", en="lower demands exceed"),
    capacity: float = Key(
        "CAPA", "FLOTTANT", range=NOT_NEGATIVE, default=0.0, en="dispersion of the capacity"
    ),
    records: ListEnti | None = _RECORDS,
) -> tuple[Curve, ListReel]:
    found = of_cloud(
        intensities.values, demands.values, limit, below=below, capacity=capacity,
        records=None if records is None else records.values,
    )  # fmt: skip
    return _told(call, found)


def _told(call: Call, found: Fragility) -> tuple[Curve, ListReel]:
    if np.isnan(found.median_error):
        call.warn("operators.curves.fragility-few-records", count=LEAST_RECORDS)
    x = found.median * np.exp(found.dispersion * np.linspace(-3.0, 3.0, _POINTS))
    part = CurvePart(x, found.probability(x), "intensity", "probability")
    return Curve((part,)), ListReel(astuple(found))

"""BRUI: random values."""

from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.operators.prelude import *


def session_generator(call: Call, skip: int | None) -> np.random.Generator:
    """The session's generator; `skip` starts it again, that many terms further."""
    options = workspace(call.session).options
    found = options.get("RANDOM GENERATOR")
    if found is None or skip is not None:
        found = np.random.default_rng(1)
        if skip:
            found.random(skip)
        options["RANDOM GENERATOR"] = found
    return found


BRUI = shared("BRUI", "numbers", full_name="BRUIT")
_NOISE = key("noise", "BLAN", optional=False, en="white noise")
_SKIP = opt("skip", "ENTIER", range=NOT_NEGATIVE, en="terms that the generator, begun again, skips")


@BRUI.form()
def _poisson(
    call: Call,
    noise: bool = _NOISE,
    law: str = Choice(("POIS",), optional=False, en="Poisson's law"),
    mean: int = Arg("ENTIER", range=NOT_NEGATIVE, en="mean"),
    count: int = Arg("ENTIER", range=NOT_NEGATIVE, en="number of values"),
    skip: int | None = _SKIP,
) -> ListEnti:
    return ListEnti(session_generator(call, skip).poisson(mean, count))


_DRAWN: dict[str, Callable[[np.random.Generator, float, float, int], FloatArray]] = {
    "GAUS": lambda generator, mean, width, n: generator.normal(mean, width, n),
    "UNIF": lambda generator, mean, width, n: generator.uniform(mean - width, mean + width, n),
    "EXPO": lambda generator, mean, width, n: generator.exponential(width, n),
}
"""Numbers (n,) by their law: of a mean, and a deviation or half width."""


@BRUI.form(gives="LISTREEL|EVOLUTIO|CHPOINT")
def _continuous(
    call: Call,
    noise: bool = _NOISE,
    law: str = Choice(("GAUS", "UNIF", "EXPO"), optional=False, en="law"),
    mean: float = Arg("FLOTTANT", en="mean", range=ANY_NUMBER),
    width: float = Arg("FLOTTANT", range=NOT_NEGATIVE, en="deviation or half width"),
    where: Any = Arg(
        "ENTIER", "LISTREEL", "MAILLAGE", en="number of values, times, or mesh", range=ANY_NUMBER
    ),
    colour: str | None = Choice(COLOURS, en="colour of the curve"),
    skip: int | None = _SKIP,
) -> Any:
    generator = session_generator(call, skip)
    if isinstance(where, int) and where < 0:
        raise call.error("operators.numbers.negative-count", where, where=where)
    nodes = where.sorted_node_ids if hasattr(where, "sorted_node_ids") else None
    count = where if isinstance(where, int) else len(where if nodes is None else nodes)
    values = _DRAWN[law](generator, mean, width, count)
    if isinstance(where, int):
        return ListReel(values)
    if nodes is not None:
        return NodeField.of(where.nodes, nodes, {"SCAL": values}, "DIFFUS")
    return Curve(
        (CurvePart(where.values, values, "TEMPS", "BRUIT", "", index_of(colour) if colour else 0),)
    )

"""Points as vectors: + - * /, PSCA, PVEC, PMIX, NORM."""

from ssilang.operators.dispatch import PSCA, PVEC
from ssilang.operators.mesh.tolerance import IN_PLANE, IN_SPACE
from ssilang.operators.numbers.arithmetic import rule
from ssilang.operators.prelude import *


def _made(like: Point, position: FloatArray) -> Point:
    return Point(like.nodes, int(like.nodes.add(position[None], like.density)[0]))


@rule("+ -", "POINT", "POINT")
def _add(sign: str, a: Point, b: Point) -> Point:
    step = b.coordinates if sign == "+" else -b.coordinates
    return _made(a, a.coordinates + step)


def _scale(sign: str, a: Any, b: Any) -> Point:
    point, factor = (a, float(b)) if isinstance(a, Point) else (b, float(a))
    return _made(point, point.coordinates * (1.0 / factor if sign == "/" else factor))


for _number in ("ENTIER", "FLOTTANT"):
    rule("* /", "POINT", _number)(_scale)
    rule("*", _number, "POINT")(_scale)


@PSCA.form()
def scalar_product_of_points(
    first: Point = Main("POINT", en="vector"), second: Point = Arg("POINT", en="vector")
) -> float:
    """Scalar product of two points."""
    return float(first.coordinates @ second.coordinates)


@PVEC.form(when=IN_SPACE)
def vector_product_of_points(
    first: Point = Main("POINT", en="vector"), second: Point = Arg("POINT", en="vector")
) -> Point:
    """Vector product of two points."""
    return _made(first, np.cross(first.coordinates, second.coordinates))


@PVEC.form(when=IN_PLANE)
def quarter_turn(first: Point = Main("POINT", en="vector")) -> Point:
    """A vector turned by a quarter turn."""
    return _made(first, np.cross([0.0, 0.0, 1.0], first.coordinates))


@operator("PMIX", family="mesh", full_name="PMIXTE")
def pmix(
    session: Session,
    call: Call,
    first: Point = Arg("POINT", en="vector"),
    second: Point = Arg("POINT", en="vector"),
    third: Point | None = Opt("POINT", en="vector, in space"),
) -> float:
    """Mixed product."""
    normal = np.cross(first.coordinates, second.coordinates)
    if workspace(session).dimension < 3:
        return float(normal[2])
    if third is None:
        raise call.missing(("POINT",))
    return float(normal @ third.coordinates)


@operator("NORM", family="mesh")
def norm(vector: Point = Arg("POINT", en="vector")) -> float:
    """Length of a vector."""
    return float(np.linalg.norm(vector.coordinates))

"""A nodal field of an instant of which only single values are asked for."""

from typing import TypeVar, overload

from ssilang.kernel.matrices.assembly import Numbering
from ssilang.language.search import nearest
from ssilang.operators.prelude import *

if TYPE_CHECKING:
    from ssilang.kernel.stepping.node_histories import NodeHistories


@dataclass(frozen=True, slots=True, eq=False)
class InstantField:
    """Stands for a nodal field that no one has made yet.

    Attributes
    ----------
    vector : array (n,)
        Values of the unknowns.
    make : callable
        Makes the field, with what `vector` does not hold (multipliers).
    """

    numbering: Numbering
    vector: FloatArray
    make: Callable[[], NodeField]


AnyField = NodeField | InstantField


MadeField = TypeVar("MadeField")


@dataclass(frozen=True)
class MadeFields(Sequence[MadeField]):
    """Fields of several instants, each made when it is asked for.

    Attributes
    ----------
    make : callable
        Makes the field at a place, from 0.
    """

    n_fields: int
    make: Callable[[int], MadeField]

    def __len__(self) -> int:
        return self.n_fields

    @overload
    def __getitem__(self, place: int) -> MadeField: ...
    @overload
    def __getitem__(self, place: slice) -> list[MadeField]: ...
    def __getitem__(self, place: int | slice) -> MadeField | list[MadeField]:
        if isinstance(place, slice):
            return [self[i] for i in range(*place.indices(self.n_fields))]
        if not 0 <= place < self.n_fields:
            raise IndexError(place)
        return self.make(place)


@dataclass(frozen=True)
class _Recorded(MadeFields[MadeField]):
    """Fields of all instants that a track holds.

    Attributes
    ----------
    name : str
        `u`, `v` or `a`; of joints `jump`, `traction` or `variables`.
    """

    track: "NodeHistories"
    name: str


class RecordedFields(_Recorded[AnyField]):
    """Of nodes."""


class RecordedPoints(_Recorded[CellField]):
    """Of joints."""

    def history(self, name: str, zone: int, cell: int, point: int) -> FloatArray | None:
        """A component at a point, the last one if it has fewer, of a cell, all counted from 1."""
        blocks = self[0].blocks
        if not 1 <= zone <= len(blocks) or name not in blocks[zone - 1].components:
            return None
        point = min(point, blocks[zone - 1].components[name].shape[1])
        return self.track.point_history(self.name, name, zone - 1, cell - 1, point - 1)


def value_in_time(call: Call, fields: Sequence[AnyField], name: str, node: int) -> FloatArray:
    """Values (n_fields,) of a component at a node; zero in fields that lack it there.

    Fields that are not made yet stay so if an unknown of theirs is asked for; what was recorded in
    time is taken as it stands.

    Raises
    ------
    SsiError
        If no field has the component there: `refused_place` says what there is.
    """
    if isinstance(fields, RecordedFields):
        history = fields.track.history(fields.name, name, node)
        if history is None:
            raise refused_place(call, fields[:1], name, node)
        return history
    places: dict[int, int] = {}
    found = np.zeros(len(fields))
    there = not fields
    for i, field in enumerate(fields):
        if isinstance(field, InstantField):
            key = id(field.numbering)
            if key not in places:
                places[key] = _place(field.numbering, name, node)
            if places[key] >= 0:
                found[i], there = field.vector[places[key]], True
                continue
            field = field.make()
        value = value_at(field, name, node)
        if value is not None:
            found[i], there = value, True
    if not there:
        raise refused_place(call, fields, name, node)
    return found


def value_at(field: NodeField, name: str, node: int) -> float | None:
    """Value of a component at a node, None where the field has none."""
    part = field.components.get(name)
    if part is None or not len(part.nodes):
        return None
    i = min(int(np.searchsorted(part.nodes, node)), len(part.nodes) - 1)
    return float(part.values[i]) if part.nodes[i] == node else None


def refused_place(call: Call, fields: Sequence[AnyField], name: str, node: int) -> SsiError:
    """The error for a component that no field has at a node: the nearest node, or the names."""
    made = [f.make() if isinstance(f, InstantField) else f for f in fields]
    parts = [f.components[name] for f in made if name in f.components]
    support = [p.nodes for p in parts if len(p.nodes)]
    if not support:
        known = list(dict.fromkeys(n for f in made for n in f.components))
        near = nearest(name, known)
        return call.error("operators.curves.no-such-component", name=name, known=known, near=near)
    nodes, table = np.unique(np.concatenate(support)), made[0].table
    distance = np.linalg.norm(table.coordinates[nodes] - table.coordinates[node], axis=1)
    i = int(np.argmin(distance))
    return call.error(
        "operators.curves.no-value-at-node", name=name, node=table.told(node),
        nearest=table.told(int(nodes[i])), distance=float(distance[i]),
    )  # fmt: skip


def tell_zero(call: Call, refused: SsiError, value: object = None) -> None:
    """Warn that values at a node that no field has are zero; an unknown component is refused."""
    if "distance" not in refused.data:
        raise refused
    call.warn("operators.curves.zero-at-node", value, **refused.data)


def _place(numbering: Numbering, name: str, node: int) -> int:
    return numbering.index_of(node, name) if name in numbering.unknowns else -1


def components_in_time(fields: Sequence[AnyField]) -> set[str]:
    """Names of the components of all fields; those of one numbering have the same."""
    if isinstance(fields, RecordedFields):
        fields = fields[:1]
    found: set[str] = set()
    seen: set[int] = set()
    for field in fields:
        if isinstance(field, InstantField):
            if id(field.numbering) in seen:
                continue
            seen.add(id(field.numbering))
            field = field.make()
        found.update(getattr(field, "components", ()))
    return found

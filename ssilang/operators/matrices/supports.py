"""BLOQ DEPI SYMT ANTI APPU: conditions on single nodes, their values, planes, springs."""

from ssilang.kernel.elements.solids.kinematics import SECTION_UNKNOWNS
from ssilang.kernel.matrices import imposed
from ssilang.kernel.matrices import relations as made
from ssilang.kernel.matrices.matrix import Relations
from ssilang.operators.prelude import *

_SENSE = {"MINI": 1, "MAXI": -1}
IN_PLANE = When(lambda s: workspace(s).mode.dimension != 3, "in the plane")
IN_SPACE = When(lambda s: workspace(s).mode.dimension == 3, "in space")


def as_matrix(relations: Relations) -> Matrix:
    """Conditions alone as a matrix."""
    return Matrix(relations.table, (), (relations,))


_TRANSLATIONS = frozenset({"UX", "UY", "UZ", "UR", "UT"})
_DISPLACEMENTS = _TRANSLATIONS | {"RX", "RY", "RZ", "RT"}
_FAR = 100.0  # times what all nodes span: no displacement


def warn_of_foreign(call: Call, unknowns: Sequence[str]) -> None:
    """Tell of displacements and rotations that no body has under the OPTI MODE in force."""
    mode = workspace(call.session).mode
    own = made.translations(mode) + made.rotations(mode)
    if mode is Mode.GENERALISED_PLANE_STRAIN:
        own += SECTION_UNKNOWNS
    foreign = [name for name in dict.fromkeys(unknowns) if name in _DISPLACEMENTS.difference(own)]
    if foreign:
        call.warn("operators.matrices.foreign-unknown", names=foreign, own=own, mode=mode.value)


_CENTRE = arg("centre", "POINT", en="centre")
_ON_AXIS = arg("on_axis", "POINT", en="second point of the axis")


_NAMES = (
    choice("sense", tuple(_SENSE), en="the unknowns stay at or above the value, or at or below"),
    key("groups", ("DEPL", "ROTA"), repeated=True, en="all displacements, all rotations"),
    key(
        "direction",
        "DIRECTION",
        "POINT",
        "CHPOINT",
        usual=NOT_ZERO,
        en="along a vector, or a field of vectors",
    ),
)
_ABOUT = "along or across the line from a centre (2D) or an axis (3D)"
_UNKNOWNS = many("unknowns", "MOT", "LISTMOTS", kind="component", en="unknowns")


def _held(*centre: Argument) -> tuple[Entry, ...]:
    """What BLOQ and APPU read to know unknowns and directions; points of RADI and ORTHO."""
    return (*_NAMES, key("polar", ("RADIAL", "ORTHO"), *centre, en=_ABOUT), _UNKNOWNS)


_SUPPORT = arg("support", "MAILLAGE", "POINT", en="nodes")


@dataclass
class _Held:
    """Unknowns and directions that BLOQ and APPU have read."""

    call: Call
    sense: str | None
    groups: list[str]
    direction: Point | NodeField | None
    polar: tuple[Any, ...] | None
    unknowns: tuple[str | ListMots, ...]

    @property
    def ws(self) -> Workspace:
        """What the session holds."""
        return workspace(self.call.session)

    def names(self) -> tuple[str, ...]:
        """Unknowns named one by one, or by DEPL and ROTA."""
        lists = (u.values if isinstance(u, ListMots) else [u.upper()] for u in self.unknowns)
        names = [str(n).rstrip() for words in lists for n in words]
        warn_of_foreign(self.call, names)
        if "DEPL" in self.groups:
            names += made.translations(self.ws.mode)
        if "ROTA" in self.groups:
            names += made.rotations(self.ws.mode)
        if not names:
            raise self.call.error("operators.matrices.no-unknown")
        return tuple(dict.fromkeys(names))  # each once: a spring named twice is no stiffer

    def directed(self) -> bool:
        """True if the condition is along a direction of its own at each node."""
        return self.direction is not None or self.polar is not None

    def along(self, nodes: IntArray) -> list[tuple[tuple[str, ...], FloatArray]]:
        """Pairs (unknowns, directions (n, dim)) for DIRECTION, RADIAL, ORTHO."""
        mode = self.ws.mode
        if self.polar is not None:
            word, centre, *other = (getattr(p, "coordinates", p) for p in self.polar)
            axis = other[0] - centre if other else None
            away = made.radial_directions(self.ws.nodes, nodes, centre, axis)
            if word == "ORTHO":
                away = made.orthoradial_directions(away, axis)
            return [(made.in_space(mode), away[:, : mode.dimension])]
        pairs = []
        for group in sorted({*self.groups}) or ["DEPL"]:
            names = made.in_space(mode) if group == "DEPL" else made.rotations(mode)
            pairs.append((names, self._directions(names, nodes)))
        return pairs

    def _directions(self, names: tuple[str, ...], nodes: IntArray) -> FloatArray:
        if isinstance(self.direction, Point):
            whole = self.direction.coordinates
            vector = whole[2:] if len(names) == 1 else whole[: len(names)]
            return np.tile(vector, (len(nodes), 1))
        assert self.direction is not None
        field = self.direction
        components = names if set(names) & set(field.components) else tuple(field.components)
        return np.stack([field.values_at(c, nodes) for c in components[: len(names)]], axis=1)


@operator("BLOQ", *_held(_CENTRE), _SUPPORT, when=IN_PLANE, family="relations", full_name="BLOQUE")
def bloq(call: Call, support: Mesh | Point, **said: Any) -> Matrix:
    """Conditions on single nodes."""
    held, nodes = _Held(call, **said), support.node_ids
    side, table = _SENSE.get(held.sense or "", 0), held.ws.nodes
    _some(nodes)
    if held.directed():
        pairs = held.along(nodes)
        return as_matrix(
            made.joined([made.blocked_along(table, nodes, names, d, side) for names, d in pairs])
        )
    return as_matrix(made.blocked(table, nodes, held.names(), side))


bloq.form(*_held(_CENTRE, _ON_AXIS), _SUPPORT, when=IN_SPACE)(bloq.forms[0].function)


def _some(nodes: IntArray) -> None:
    if len(nodes) == 0:
        raise MeshError("operators.matrices.nothing-to-hold")


def static_links(table: Table) -> list[tuple[Table, Point, str]]:
    """Entries of a LIAISONS_STATIQUES table: (sub-table, point, unknown), in order of number."""
    found = []
    for index, entry in table.items():
        if not isinstance(index, int) or not isinstance(entry, Table):
            continue
        point = entry.get("POINT_LIAISON", entry.get("POINT-LIAISON"))
        found.append((entry, point, str(entry.get("DDL_LIAISON", "")).rstrip()))
    return found  # type: ignore[return-value]


@bloq.form()
def bloq_of_table(call: Call, table: Table = Arg("TABLE", en="table LIAISONS_STATIQUES")) -> Matrix:
    """Conditions of a table of static links."""
    ws = workspace(call.session)
    parts: list[Relations] = []
    for entry, point, unknown in static_links(table):
        if not isinstance(point, Point) or not unknown:
            raise call.error("operators.matrices.link-wants-point-and-unknown", table)
        single = as_matrix(made.blocked(ws.nodes, point.node_ids, (unknown,)))
        entry.set("BLOCAGE", single)
        parts += single.relations
    if not parts:
        raise call.error("operators.matrices.table-without-entries", table)
    return Matrix(ws.nodes, (), tuple(parts))


# --- imposed values --------------------------------------------------------------------------


@operator("DEPI", family="relations", full_name="DEPIMPOSE")
def depi(
    call: Call,
    mixed: bool = Flag(
        "RELA", en="the field SCAL gives the value of relations between unknowns of one node"
    ),
    matrix: Matrix = Arg("RIGIDITE", en="conditions"),
    value: float | NodeField = Arg(
        "FLOTTANT",
        "CHPOINT",
        en="one value for all, or a field of the held unknowns",
        range=ANY_NUMBER,
    ),
) -> NodeField:
    """Values of conditions."""
    if not matrix.relations:
        raise call.error("operators.matrices.matrix-without-condition", matrix)
    by_field = imposed.imposed_by_node if mixed else imposed.imposed_from_field
    fill: Any = by_field if isinstance(value, NodeField) else imposed.imposed_uniform
    found: NodeField = fill(matrix.relations, value)
    way = float(np.abs(found.components["FLX"].values).max())
    size = float(np.ptp(matrix.table.coordinates, axis=0).max())
    if way > _FAR * size > 0.0 and all({*r.unknowns} <= _TRANSLATIONS for r in matrix.relations):
        call.warn("operators.matrices.imposed-far", value, way=way, size=size, times=way / size)
    return found


@depi.form()
def depi_of_table(call: Call, table: Table = Arg("TABLE", en="table LIAISONS_STATIQUES")) -> None:
    """Values of one on the conditions of a table of static links."""
    for entry, _, _ in static_links(table):
        block = entry.get("BLOCAGE")
        if not isinstance(block, Matrix):
            raise call.error("operators.matrices.link-without-blocage", table)
        entry.set("FORCE", imposed.imposed_uniform(block.relations, 1.0))


# --- planes of symmetry ----------------------------------------------------------------------


_GROUPS = key("groups", ("DEPL", "ROTA"), repeated=True, en="displacements, rotations")
_NEAR_PLANE = (
    arg("mesh", "MAILLAGE", "POINT", en="nodes"),
    opt(
        "tolerance",
        "FLOTTANT",
        range=NOT_NEGATIVE,
        en="distance up to which a node counts, else a tenth of the density",
        unit="m",
    ),
)


def _plane(points: int) -> tuple[Entry, ...]:
    """What SYMT and ANTI read: points of a line or plane, then nodes."""
    named = (arg(f"p{i + 1}", "POINT", en="point of the symmetry") for i in range(points))
    return (_GROUPS, *named, *_NEAR_PLANE)


def _mirror(
    call: Call,
    groups: list[str],
    mesh: Mesh | Point,
    tolerance: float | None,
    mirrored: bool,
    **points: Point,
) -> Matrix:
    ws = workspace(call.session)
    if not groups:
        raise call.error("operators.matrices.say-depl-or-rota")
    if ws.mode.dimension == 1:
        raise call.error("operators.matrices.symmetry-wants-dimensions")
    reach = ws.density / 10.0 if tolerance is None else tolerance
    if reach <= 0.0:
        raise call.error("operators.matrices.symmetry-distance-missing")
    plane = np.stack([p.coordinates for p in points.values()])
    near, normal = made.on_plane(ws.nodes, mesh.node_ids, plane, reach)
    names = made.in_space(ws.mode) if "DEPL" in groups else ()
    turns = made.rotations(ws.mode) if "ROTA" in groups else ()
    return as_matrix(made.mirror_rows(ws.nodes, near, normal, names, turns, mirrored))


@operator("SYMT", *_plane(2), when=IN_PLANE, family="relations", full_name="SYMT")
def symt(call: Call, **said: Any) -> Matrix:
    """Symmetry."""
    return _mirror(call, **said, mirrored=True)


symt.form(*_plane(3), when=IN_SPACE)(symt.forms[0].function)


@operator("ANTI", *_plane(2), when=IN_PLANE, family="relations", full_name="ANTISYMETRIE")
def anti(call: Call, **said: Any) -> Matrix:
    """Antisymmetry."""
    return _mirror(call, **said, mirrored=False)


anti.form(*_plane(3), when=IN_SPACE)(anti.forms[0].function)


# --- springs to the ground -------------------------------------------------------------------


_SPRINGS = Range(-1e20, 1e20)  # below zero: the moment of a weight
_STIFFNESS = arg("stiffness", "FLOTTANT", en="stiffness of each", range=ANY_NUMBER, usual=_SPRINGS)


@operator("APPU", *_held(_CENTRE), when=IN_PLANE, family="relations", full_name="APPUI")
def appu(
    call: Call, stiffness: float = _STIFFNESS, support: Mesh | Point = _SUPPORT, **said: Any
) -> Matrix:
    """Springs to the ground."""
    held, nodes = _Held(call, **said), support.node_ids
    if held.sense:
        raise call.error("operators.matrices.spring-works-both-ways")
    _some(nodes)
    if not held.directed():
        return made.springs(held.ws.nodes, nodes, held.names(), stiffness)
    parts = [
        made.springs(held.ws.nodes, nodes, names, stiffness, d) for names, d in held.along(nodes)
    ]
    return Matrix(held.ws.nodes, tuple(b for p in parts for b in p.blocks))


appu.form(*_held(_CENTRE, _ON_AXIS), when=IN_SPACE)(appu.forms[0].function)

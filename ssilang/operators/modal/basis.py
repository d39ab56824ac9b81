"""PJBA PSMO IDLI: projection on modes and static shapes, pseudo-modes."""

from ssilang.kernel.matrices.submatrices import together
from ssilang.kernel.modal.basis import (
    projected_matrix,
    projected_relations,
    static_complement,
    work,
)
from ssilang.kernel.modal.modes import eigenvalue
from ssilang.kernel.modal.shape_models import shape_points
from ssilang.kernel.statics.linear import product, solve
from ssilang.operators.dispatch import union
from ssilang.operators.matrices.element import joined
from ssilang.operators.prelude import *
from ssilang.operators.statics.solve import is_anywhere

BEYOND = 1e-3  # of the largest force at a node: no rounding


@dataclass(frozen=True)
class Shape:
    """A shape of a basis, the point that marks it and its unknown ('ALFA' mode, 'BETA' static)."""

    field: NodeField
    mark: Point
    unknown: str
    entry: Table


def shapes_of(call: Call, *tables: Table) -> list[Shape]:
    """Modes and static shapes of BASE_MODALE, BASE_DE_MODES, LIAISONS_STATIQUES tables."""
    found = [s for t in tables for s in shapes_in(t)]
    if not found:
        raise call.error("operators.modal.no-mode-no-shape", tables[0] if tables else None)
    return found


def shapes_in(table: Table) -> list[Shape]:
    """Shapes of one table, in order of number; none if it holds none.

    A table ENSEMBLE_DE_BASES gives those of its bases, one after the other.
    """
    inner = table.get("MODES")
    if isinstance(inner, Table):
        return shapes_in(inner)
    found: list[Shape] = []
    entries = [(i, e) for i, e in table.items() if isinstance(i, int) and isinstance(e, Table)]
    for _, entry in sorted(entries, key=lambda pair: pair[0]):
        if table.subtype == "ENSEMBLE_DE_BASES":
            found += shapes_in(entry)
        for index, unknown in (("DEFORMEE_MODALE", "ALFA"), ("DEFORMEE", "BETA")):
            field, mark = entry.get(index), entry.get("POINT_REPERE")
            if isinstance(field, NodeField) and isinstance(mark, Point):
                found.append(Shape(field, mark, unknown, entry))
    return found


def _at_marks(table: NodeTable, shapes: list[Shape], values: list[float], dual: bool) -> NodeField:
    parts: dict[str, NodeValues] = {}
    for unknown, force in (("ALFA", "FALF"), ("BETA", "FBET")):
        own = [
            (s.mark.node, v) for s, v in zip(shapes, values, strict=True) if s.unknown == unknown
        ]
        if own:
            own.sort()
            nodes, numbers = zip(*own, strict=True)
            name = force if dual else unknown
            parts[name] = NodeValues(np.array(nodes), np.array(numbers, dtype=float))
    return NodeField(table, parts, "DISCRET" if dual else "DIFFUS")


# --- projection ------------------------------------------------------------------------------


BASIS: Any = either(
    "basis",
    group(
        "tables",
        many("tables", "TABLE", at_least=1, en="modes, static shapes"),
    ),
    group(
        "model",
        arg("model", "MMODEL", en="model of shapes"),
        many("material", "MCHAML", at_least=1, en="its parameters"),
    ),
)


def basis_shapes(call: Call, basis: Chosen) -> list[Shape]:
    """Shapes of the tables, or of the model with its parameters, that `BASIS` has read."""
    if basis.word == "tables":
        return shapes_of(call, *basis["tables"])
    return _model_shapes(call, basis["model"], basis["material"])


def read_basis(call: Call) -> list[Shape]:
    """Shapes of the tables that stand in a call, or of a model with its parameters."""
    model = call.read("MMODEL")
    if model is None:
        return shapes_of(call, *call.all("TABLE"))
    return _model_shapes(call, model.value, (call.required("MCHAML"), *call.all("MCHAML")))


def _model_shapes(call: Call, model: Model, material: tuple[CellField, ...]) -> list[Shape]:
    points = shape_points(model.zones, joined(material))
    if not points:
        raise call.error("operators.modal.model-no-zone-modal", model)
    nodes = workspace(call.session).nodes
    return [Shape(p.field, Point(nodes, p.node), p.unknown, Table()) for p in points]


@operator(
    "PJBA",
    main("thing", "CHPOINT", "CHARGEME", "RIGIDITE", en="what is projected"),
    BASIS,
    gives=Like("thing"),
    family="modal",
)
def _pjba(call: Call, thing: NodeField | Load | Matrix, basis: Chosen) -> NodeField | Load | Matrix:
    shapes = basis_shapes(call, basis)
    if isinstance(thing, Load):
        return Load(tuple(replace(p, space=_forces(call, p.space, shapes)) for p in thing.parts))
    if isinstance(thing, NodeField):
        return _forces(call, thing, shapes)
    marks = np.array([s.mark.node for s in shapes])
    unknowns = [s.unknown for s in shapes]
    duals = ["FALF" if u == "ALFA" else "FBET" for u in unknowns]
    fields = [s.field for s in shapes]
    if not thing.blocks:
        return projected_relations(thing, fields, marks, unknowns)
    return projected_matrix(thing, fields, marks, unknowns, duals)


def _forces(call: Call, force: object, shapes: list[Shape]) -> NodeField:
    if not isinstance(force, NodeField):
        raise call.error("operators.modal.only-nodal-forces-times")
    known = {dual_of(name) for s in shapes for name in s.field.components}
    if known.isdisjoint(names := list(force.components)):
        call.warn("operators.modal.force-of-other-names", force, names=names, known=sorted(known))
    elif is_anywhere(force) and not any(_moved(s.field, force) for s in shapes):
        call.warn("operators.modal.force-on-supports", force)
    _tell_beyond(call, force, shapes[0].field)
    return _at_marks(force.table, shapes, [work(force, s.field) for s in shapes], dual=True)


def _moved(shape: NodeField, force: NodeField) -> bool:
    """Whether a shape moves anything that a force acts on."""
    laden = {n: p.nodes[p.values != 0.0] for n, p in force.components.items()}
    known = [n for n in shape.components if dual_of(n) in laden]
    return any(shape.values_at(n, laden[dual_of(n)]).any() for n in known)


def _tell_beyond(call: Call, force: NodeField, shape: NodeField) -> None:
    """Warn of inertia forces of masses that the modes were found without."""
    known, none = workspace(call.session).origins, ((), None)
    (_, mass), (_, field) = known.get(shape, none), known.get(force, none)
    if mass is None or field is None:
        return
    own = product(mass, field)
    for name in {"FX", "FY", "FZ"} & {*force.components}:
        part = force.components[name]
        pull, usual = np.abs(part.values), np.abs(own.values_at(name, part.nodes))
        scale = float(np.median(pull[usual > 0.0] / usual[usual > 0.0])) if usual.any() else 1.0
        beyond, off = pull - scale * usual, BEYOND * pull.max(initial=0.0)
        if beyond.min(initial=0.0) > -off and off < beyond.max(initial=0.0):
            told = {"node": force.table.told(int(part.nodes[beyond.argmax()]))}
            told |= {"driven": pull.sum() / scale, "mass": usual.sum()}
            call.warn("operators.modal.driven-beyond", **told)


@_pjba.form()
def project_list(
    call: Call,
    fields: ListChpo = Main("LISTCHPO", en="fields"),
    basis: Chosen = BASIS,
    count: int | None = Opt("ENTIER", range=POSITIVE, en="number of shapes, all without it"),
    metric: Matrix | None = Opt("RIGIDITE", en="matrix of the product"),
) -> ListChpo:
    """Products of fields with shapes."""
    shapes = basis_shapes(call, basis)[:count]
    dual = [s.field if metric is None else product(metric, s.field) for s in shapes]
    out: list[object] = []
    for field in fields.values:
        if not isinstance(field, NodeField):
            raise call.error("operators.modal.list-holds-something-else", fields)
        values = [work(d, field, same_names=metric is None) for d in dual]
        out.append(_at_marks(field.table, shapes, values, dual=False))
    return ListChpo(out)


# --- pseudo-modes ----------------------------------------------------------------------------


def _shock_points(call: Call, table: Table) -> list[tuple[Point, Point]]:
    """POINT and NORMALE of the entries 1, 2 ... of a table POINT_DE_LIAISON."""
    found = []
    for index, entry in table.items():
        if not isinstance(index, int):
            continue
        point, normal = (
            entry.get(n) if isinstance(entry, Table) else None for n in ("POINT", "NORMALE")
        )
        if not isinstance(point, Point) or not isinstance(normal, Point):
            raise call.error("operators.modal.shock-wants-point-and-normal", table, i=index)
        if not np.any(normal.coordinates):
            raise call.error("operators.modal.shock-normal-is-zero", table, i=index)
        found.append((point, normal))
    return found


class _Shifted:
    """Stiffness with its modes, shifted off zero frequency when there are free motions."""

    def __init__(
        self, call: Call, stiffness: Matrix, mass: Matrix | None, modes: list[Shape], f: float
    ) -> None:
        self.call, self.mass, self.modes = call, mass, modes
        known = [float(m.entry.get("FREQUENCE", 0.0)) for m in modes]  # type: ignore[arg-type]
        if f == 0.0 and any(abs(k) < 1e-5 for k in known):
            f = 0.5 * min((k for k in known if abs(k) >= 1e-5), default=0.0)
        shift = eigenvalue(f)
        if shift and mass is None:
            raise call.error("operators.modal.structure-free-motions-wants")
        self.system = together(stiffness, mass.scaled(-shift)) if shift and mass else stiffness
        masses = [float(m.entry.get("MASSE_GENERALISEE", 1.0)) for m in modes]  # type: ignore[arg-type]
        self.stiffnesses = [m * (eigenvalue(k) - shift) for m, k in zip(masses, known, strict=True)]

    def complement(self, force: NodeField) -> NodeField:
        """Static response to a force without what the modes hold of it."""
        shapes = [m.field for m in self.modes]
        works = [work(force, s) for s in shapes]
        return static_complement(solve(self.system, [force])[0], shapes, works, self.stiffnesses)

    def driven(self, field: NodeField, supports: bool) -> dict[str, Any]:
        """A concentrated force, or imposed displacements of supports (field FLX of DEPI)."""
        shapes = [m.field for m in self.modes]
        if supports:
            static = solve(self.system, [field])[0]
            reactions = field.components.get("FLX")
            works = [
                0.0
                if reactions is None
                else float(s.values_at("LX", reactions.nodes) @ reactions.values)
                for s in shapes
            ]
            shape = static_complement(static, shapes, works, self.stiffnesses)
        else:
            works = [work(field, s) for s in shapes]
            shape = self.complement(field)
        on_modes = _at_marks(field.table, self.modes, works, dual=True)
        return {"DEPLACEMENT": shape, "CHAMP_BASE_B": field, "CHAMP_BASE_A": on_modes}

    def struck(self, point: Point, normal: Point) -> dict[str, Any]:
        """A unit force at a point, along a normal."""
        along = normal.coordinates / np.linalg.norm(normal.coordinates)
        values = {
            name: np.array([share])
            for name, share in zip(("FX", "FY", "FZ"), along, strict=False)
            if share
        }
        force = NodeField.of(point.nodes, np.array([point.node]), values, "DISCRET")
        return {"DEPLACEMENT": self.complement(force), "POINT": point, "NORMALE": normal}

    def seismic(self, directions: list[str]) -> list[dict[str, Any]]:
        """Unit accelerations of the base along X, Y, Z: forces - M d."""
        if self.mass is None:
            raise self.call.error("operators.modal.seisme-wants-mass-matrix")
        nodes = np.unique(np.concatenate([b.nodes.ravel() for b in self.mass.blocks]))
        entries = []
        for name in directions:
            ones = NodeField.of(self.mass.table, nodes, {name: np.ones(len(nodes))}, "DIFFUS")
            force = product(self.mass.scaled(-1.0), ones)
            entries.append(
                {
                    "DEPLACEMENT": self.complement(force),
                    "DIRECTION": ("UX", "UY", "UZ").index(name) + 1,
                }
            )
        return entries


@operator("PSMO", family="modal")
def _psmo(
    call: Call,
    frequency: float = Key(
        "FREQ", "FLOTTANT", range=POSITIVE, unit="Hz", default=0.0, en="frequency of the response"
    ),
    seismic: bool = Flag("SEISME", en="displacements of supports, or accelerations of the base"),
    directions: list[str] = Key(("UX", "UY", "UZ"), repeated=True, en="of the base"),
    matrices: tuple[Matrix, ...] = Many("RIGIDITE", at_least=1, en="stiffness, and mass"),
    basis: Table = Arg("TABLE", en="modes"),
    shocks: Table | None = Opt("TABLE", en="points of shocks: . i . 'POINT' and . 'NORMALE'"),
    field: NodeField | ListChpo | None = Opt("CHPOINT", "LISTCHPO", en="forces, or field of DEPI"),
) -> Table:
    modes = shapes_of(call, basis)
    masses = [m for m in matrices if m.kind.startswith("MASS")]
    others = [m for m in matrices if not m.kind.startswith("MASS")]
    if len(others) != 1 or len(masses) > 1:
        raise call.error("operators.modal.psmo-wants-stiffness-mass")
    system = _Shifted(call, others[0], masses[0] if masses else None, modes, frequency)
    entries = system.seismic(directions) if directions else []
    if field is not None:
        fields: list[Any] = field.values if isinstance(field, ListChpo) else [field]
        entries += [system.driven(f, seismic) for f in fields]
    if shocks is not None:
        entries += [system.struck(p, n) for p, n in _shock_points(call, shocks)]
    if not entries:
        raise call.error("operators.modal.nothing-drives-structure-chpoint")
    return Table.numbered((Table.of(entry) for entry in entries), "PSEUDO_MODE")


@operator("IDLI", family="modal")
def _idli(
    call: Call,
    matrix: Matrix = Arg("RIGIDITE", en="conditions"),
    place: Mesh = Arg("MAILLAGE", en="points"),
) -> Table:
    inside = place.sorted_node_ids
    ws = workspace(call.session)
    pairs = sorted(
        {
            (int(node), unknown)
            for r in matrix.relations
            for node, unknown in zip(r.nodes, r.unknowns, strict=True)
            if node in inside
        }
    )
    if not pairs:
        call.warn("operators.modal.no-conditions-there")
    made = (
        Table.of({"POINT_LIAISON": Point(ws.nodes, node), "DDL_LIAISON": Mot(unknown)})
        for node, unknown in pairs
    )
    return Table.numbered(made, "LIAISONS_STATIQUES")


# --- union -----------------------------------------------------------------------------------


@union(("TABLE", "TABLE"))
def join_bases(first: Table, second: Table) -> Table:
    """Shapes of two tables of one sub-type, numbered through; other entries are the first's."""
    kinds = ("LIAISONS_STATIQUES", "BASE_MODALE", "BASE_DE_MODES")
    if first.subtype != second.subtype or first.subtype not in kinds:
        raise KernelError(
            "operators.modal.tables-cannot-joined", subtype=first.subtype, subtype_2=second.subtype
        )
    inner = [t.get("MODES") for t in (first, second)]
    if all(isinstance(t, Table) for t in inner):
        return Table.of([*first.items(), ("MODES", join_bases(*inner))], first.subtype)
    others = (pair for pair in first.items() if not isinstance(pair[0], int))
    pairs = [
        (k, i, v) for k, t in enumerate((first, second)) for i, v in t.items() if type(i) is int
    ]
    shapes = enumerate((entry for *_, entry in sorted(pairs)), start=1)
    return Table.of([*others, *shapes], first.subtype)

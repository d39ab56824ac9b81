"""Tables LIAISON_ELEMENTAIRE of DYNE read as links of the kernel, and their results as tables."""

from ssilang.kernel.modal import link_laws as law
from ssilang.kernel.modal.link_laws import LinkArrays, Points
from ssilang.kernel.modal.links import Link, link_arrays, segments_of
from ssilang.operators.modal.basis import Shape
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

LINKS = "TLIAI.LIAISON_A.I"
"""Where the entries of a link are declared, for DYNE and DYNC alike."""
Spin = tuple[int, FloatArray, FloatArray]
"""The mode that turns a point's body, its axis, and the point's place from the body's centre."""


def declared_by(call: Call) -> str:
    """The operator whose declaration of links counts; PASAPAS takes that of DYNE."""
    return call.name if call.name == "DYNC" else "DYNE"


ROUNDING = 1e-9
MOVES, TURNS = ("UX", "UY", "UZ"), ("RX", "RY", "RZ")


@dataclass(frozen=True)
class Basis:
    """Points that mark the unknowns, their unknowns, and their shapes where they are known."""

    marks: tuple[int, ...]
    unknowns: tuple[str, ...]
    shapes: tuple[Shape, ...] | None

    def rows(self, call: Call, point: Point, names: Sequence[str] = MOVES) -> FloatArray:
        """Components of the motion of a point, (3, n): zero where a shape has none."""
        if self.shapes is None:
            raise call.error("operators.modal.links-base-need-shapes")
        node = np.array([point.node])
        at = [[float(s.field.values_at(c, node)[0]) for s in self.shapes] for c in names]
        rows, spin = np.array(at), self.spin(call, point)
        if spin is not None:  # the kernel turns the body, by an angle however large
            rows[:, spin[0]] = spin[1] if names == TURNS else 0.0
        return rows

    def spin(self, call: Call, point: Point) -> Spin | None:
        """What turns the rigid body of a point (CORPS_RIGIDE), None where nothing does."""
        node = np.array([point.node])
        for mode, shape in enumerate(self.shapes or ()):
            if str(shape.entry.get(Mot("CORPS_RIGIDE"))).rstrip() not in ("True", "VRAI"):
                continue
            axis = np.array([float(shape.field.values_at(c, node)[0]) for c in TURNS])
            size = float(np.linalg.norm(axis))
            if size > 0.0:
                centre = shape.entry.get(Mot("CENTRE_DE_GRAVITE"))
                if not isinstance(centre, Point):
                    raise call.error("operators.modal.rigid-body-without-centre", shape.entry)
                return mode, axis / size, in_space(point) - in_space(centre)
        return None

    def unit(self, call: Call, point: Point, name: str) -> FloatArray:
        """Row (3, n) that picks the unknown of a mode by its point, given at the index `name`."""
        if point.node not in self.marks:
            raise call.error("operators.modal.link-without-mode", point, name=name)
        rows = np.zeros((3, len(self.marks)))
        rows[0, self.marks.index(point.node)] = 1.0
        return rows


@dataclass(frozen=True)
class Seen:
    """Motion of a point from those of the modes: its rows (3, n) and what turns its body."""

    rows: FloatArray
    spin: Spin | None = None

    def at(self, values: FloatArray) -> FloatArray:
        """Components (m, 3) of modes (m, n)."""
        moved: FloatArray = values @ self.rows.T
        if self.spin is None:
            return moved
        mode, axis, arm = self.spin
        angles = values[:, mode]
        turned = np.outer(np.cos(angles), arm) + np.outer(np.sin(angles), np.cross(axis, arm))
        moved += turned - arm + np.outer(1.0 - np.cos(angles), (axis @ arm) * axis)
        return moved


Named = tuple[str, int, Seen | int]
"""Index in the results, component, motion of a point or column of the record."""


def in_space(point: Point) -> FloatArray:
    """Coordinates of a point, three of them."""
    at = np.asarray(point.coordinates, dtype=float)
    return np.concatenate([at, np.zeros(3 - len(at))])


@dataclass(frozen=True)
class ReadLink:
    """A table of a link, the links that it makes, and what its results are made of.

    `nodes` are those of lines, one a link.
    """

    table: Table
    links: tuple[Link, ...]
    names: tuple[Named, ...] = field(default=())
    nodes: IntArray | None = None


@dataclass
class Places:
    """Points of lines and of turning bodies, and segments of lines, as they are met."""

    call: Call
    basis: Basis
    numbers: dict[int, int] = field(default_factory=dict)
    points: list[Point] = field(default_factory=list)
    segments: list[IntArray] = field(default_factory=list)

    def number(self, point: Point) -> int:
        """Number of a point among those whose place counts."""
        if point.node not in self.numbers:
            self.numbers[point.node] = len(self.points)
            self.points.append(point)
        return self.numbers[point.node]

    def ends(self, *points: tuple[Point, float]) -> tuple[tuple[int, float], ...]:
        """The points whose bodies turn, with their signs."""
        spins = [(p, s) for p, s in points if self.basis.spin(self.call, p) is not None]
        return tuple((self.number(p), s) for p, s in spins)

    def line(self, mesh: Mesh) -> tuple[float, float]:
        """First and last number (not included) of the segments of a line."""
        first = sum(len(s) for s in self.segments)
        cells = [b.connectivity for b in mesh.blocks if b.cell_type == "SEG2"]
        pairs = [[self.number(Point(mesh.nodes, int(n))) for n in c] for b in cells for c in b]
        self.segments.append(segments_of(np.array(pairs, dtype=np.int64), first))
        return float(first), float(first + len(pairs))

    def arrays(self, read: Sequence[ReadLink], n: int) -> LinkArrays:
        """All links for the compiled loop."""
        spins = [self.basis.spin(self.call, p) for p in self.points]
        none = (-1, np.zeros(3), np.zeros(3))
        modes, axes, arms = zip(*(s or none for s in spins), strict=True) if spins else ((),) * 3
        points = Points(
            np.array([self.basis.rows(self.call, p) for p in self.points]).reshape(-1, 3, n),
            np.array([in_space(p) for p in self.points]).reshape(-1, 3),
            np.array(modes, dtype=np.int64), np.array(axes, dtype=float).reshape(-1, 3),
            np.array(arms, dtype=float).reshape(-1, 3),
        )  # fmt: skip
        segments = np.concatenate([np.zeros((0, 4), dtype=np.int64), *self.segments])
        return link_arrays([k for r in read for k in r.links], n, points, segments)


class LinkTable:
    """Values of one table LIAISON_ELEMENTAIRE."""

    def __init__(self, call: Call, table: Table, places: Places) -> None:
        self.call, self.table, self.places = call, table, places
        self.entries = Entries(call, table, declared_by(call), LINKS)
        self.kind = str(self.need("TYPE_LIAISON"))

    def need(self, name: str) -> object:
        """A mandatory value."""
        value = self.entries.get(name)
        if value is None:
            raise self.call.error("operators.modal.link-without-entry", self.table, name=name)
        return value

    def real(self, name: str, default: float | None = None) -> float:
        """A number."""
        value = self.need(name) if default is None else self.entries.get(name)
        return float(default if value is None else value)  # type: ignore[arg-type]

    def point(self, name: str) -> Point:
        """A point."""
        value = self.need(name)
        assert isinstance(value, Point)
        return value

    def vector(self, name: str) -> FloatArray:
        """Coordinates of a point, three of them."""
        return in_space(self.point(name))

    def direction(self, name: str) -> FloatArray:
        """Unit vector."""
        v = self.vector(name)
        size = float(np.linalg.norm(v))
        if size == 0.0:
            raise self.call.error("operators.modal.no-length", self.table, name=name)
        return v / size

    def at(self, name: str, point: Point) -> float:
        """Value at a point of a field of one component, zero without the field."""
        field: NodeField | None = self.entries.get(name)
        if field is None:
            return 0.0
        if len(field.components) != 1:
            raise self.call.error(
                "operators.modal.one-component", field, name=name, names=list(field.components)
            )
        (component,) = field.components
        return float(field.values_at(component, np.array([point.node]))[0])

    def law(self) -> FloatArray | None:
        """Points of 'LOI_DE_COMPORTEMENT', if there is one."""
        curve: Curve | None = self.entries.get("LOI_DE_COMPORTEMENT")
        if curve is None:
            return None
        return np.stack([curve.parts[0].abscissas, curve.parts[0].ordinates], axis=1)


def _vector(column: int, values: FloatArray) -> dict[int, float]:
    return {column + i: float(v) for i, v in enumerate(values)}


def _spring(t: LinkTable) -> tuple[dict[int, float], FloatArray | None]:
    """Numbers of the normal spring: stiffness or law, damping, plastic limit, permanence."""
    points = t.law()
    numbers = {
        law.STIFF: 0.0 if points is not None else t.real("RAIDEUR"),
        law.DAMP: t.real("AMORTISSEMENT"),
        law.PERMANENT: float(t.entries.flag("LIAISON_PERMANENTE")),
    }
    limit = t.real("SEUIL_PLASTIQUE", 0.0)
    if limit > 0.0:
        if points is not None:
            raise t.call.error("operators.modal.seuil-plastique-goes-raideur", t.table)
        points = np.array([[0.0, 0.0], [limit / numbers[law.STIFF], limit]])
        numbers[law.PLASTIC] = 1.0
    return numbers, points


_RUBBING = {
    law.SLIDE: "COEFFICIENT_GLISSEMENT",
    law.STICK: "COEFFICIENT_ADHERENCE",
    law.TANGENT: "RAIDEUR_TANGENTIELLE",
    law.TANGENT_DAMP: "AMORTISSEMENT_TANGENTIEL",
}
"""Numbers of friction, and their entries."""


def _friction(t: LinkTable) -> dict[int, float]:
    if not t.kind.endswith(("_FROTTEMENT", "_MOBILE")):
        return {}
    numbers = {law.FRICTION: 1.0} | {place: t.real(name) for place, name in _RUBBING.items()}
    drive = t.table.get(Mot("VITESSE_ENTRAINEMENT"))
    if isinstance(drive, Point):
        numbers |= _vector(law.DX, t.vector("VITESSE_ENTRAINEMENT"))
    elif drive is not None:
        numbers[law.DX] = t.real("VITESSE_ENTRAINEMENT")
    if numbers[law.TANGENT] < 0.0 and numbers[law.TANGENT_DAMP] <= 0.0:
        raise t.call.error("operators.modal.oden-friction-wants-positive", t.table)
    return numbers


def _of_point(t: LinkTable, name: str, names: Sequence[str], tail: str = "") -> list[Named]:
    """The motion of the point at the index `name` under names of results."""
    basis, point = t.places.basis, t.point(name)
    spin = None if names == TURNS else basis.spin(t.call, point)
    seen = Seen(basis.rows(t.call, point, names), spin)
    return [(name + tail, i, seen) for i, name in enumerate(names)]


_RELATIVE: list[Named] = [(name, 0, law.X + i) for i, name in enumerate(MOVES)]


def _push_names(t: LinkTable, rubs: bool) -> list[Named]:
    rate: list[Named] = []
    if t.table.has(Mot("AMORTISSEMENT")):
        rate = [("VITESSE_NORMALE", 0, law.VN)]
    if not rubs:
        return [("FORCE_DE_CHOC", 0, law.FN), *rate]
    return [
        ("FORCE_DE_CHOC_NORMALE", 0, law.FN), ("FORCE_DE_CHOC_TANGENTIELLE", 0, law.FT),
        ("PUISSANCE_USURE_INSTANTANEE", 0, law.WEAR), ("VITESSE_TANGENTIELLE", 0, law.VT), *rate,
    ]  # fmt: skip


def _plane(t: LinkTable, basis: Basis) -> ReadLink:
    """POINT_PLAN on the basis or on a mode, with friction or without."""
    support = t.point("SUPPORT")
    numbers, points = _spring(t)
    numbers |= _friction(t)
    gap = t.real("JEU")
    if not t.table.has(Mot("NORMALE")):
        rows = basis.unit(t.call, support, "SUPPORT")
        numbers |= {law.NX: 1.0 if gap >= 0.0 else -1.0, law.GAP: abs(gap)}
        pushed = [(name, int(gap < 0.0), kept) for name, _, kept in _push_names(t, False)]
        named = [("DEPLACEMENT", 0, Seen(rows)), *pushed]
        return _read_one(t, law.PLANE, rows, numbers, points, named)
    rows, normal = basis.rows(t.call, support), t.direction("NORMALE")
    numbers |= _vector(law.NX, normal) | {law.GAP: gap}
    spins = t.places.ends((support, 1.0))
    if not spins and np.abs(normal @ rows).max() <= ROUNDING * np.abs(rows).max():
        t.call.warn("operators.modal.link-never-met", kind=t.kind)
    named = _RELATIVE + _push_names(t, law.FRICTION in numbers)
    if law.PLASTIC in numbers:
        named.append(("DEPLACEMENT_PLASTIQUE", 0, law.PLASTIC_PART))
    return _read_one(t, law.PLANE, rows, numbers, points, named, spins)


def _turning_circle(t: LinkTable, basis: Basis) -> ReadLink:
    """CERCLE_PLAN_FROTTEMENT, CERCLE_CERCLE_FROTTEMENT: a circle about SUPPORT that turns.

    Where it touches it moves by `u + theta x R n`: friction turns the circle.
    """
    support, normal = t.point("SUPPORT"), t.direction("NORMALE")
    centre, turns = basis.rows(t.call, support), basis.rows(t.call, support, TURNS)
    radius = t.real("RAYON_SUPPORT")
    numbers, points = _spring(t)
    numbers |= _friction(t) | _vector(law.NX, normal) | {law.RADIUS: radius}
    kind = law.PLANE
    if t.kind.startswith("CERCLE_CERCLE"):
        kind = law.CIRCLE
        numbers |= _about_circle(t, t.vector("EXCENTRATION"))
        sense = 1.0 if numbers[law.OUTSIDE] else -1.0
        numbers[law.GAP] = t.real("RAYON_BUTEE") + sense * radius
    else:
        numbers[law.GAP] = t.real("JEU")
    named = _of_point(t, "SUPPORT", MOVES, "_POINT_FIBRE_NEUTRE")
    named += [(f"V{c}_POINT_CONTACT", 0, law.VC + i) for i, c in enumerate("XYZ")]
    named += [n for n in _push_names(t, True) if n[0] != "VITESSE_TANGENTIELLE"]
    named += [(f"M{c}_POINT_FIBRE_NEUTRE", 0, law.MC + i) for i, c in enumerate("XYZ")]
    named += _of_point(t, "SUPPORT", TURNS, "_POINT_FIBRE_NEUTRE")
    return _read_one(t, kind, centre, numbers, points, named, turns=turns)


def _two_points(t: LinkTable, basis: Basis) -> ReadLink:
    """POINT_POINT and its variants with friction and plasticity (of displacements, rotations)."""
    turning = "ROTATION" in t.kind
    names = TURNS if turning else MOVES
    a, b = (basis.rows(t.call, t.point(p), names) for p in ("POINT_A", "POINT_B"))
    numbers, points = _spring(t)
    numbers |= _friction(t)
    axis = "AXE_ROTATION" if turning and t.table.has(Mot("AXE_ROTATION")) else "NORMALE"
    numbers |= _vector(law.NX, t.direction(axis))
    shut = t.kind.endswith("_PLASTIQUE") and numbers[law.PERMANENT]
    numbers[law.GAP] = 0.0 if shut else t.real("JEU")
    plastic = t.kind.endswith("_PLASTIQUE") and not (
        t.entries.flag("ELASTIQUE") or t.entries.flag("COMPORTEMENT_ELASTIQUE")
    )
    if plastic:
        if points is None:
            raise t.call.error("operators.modal.link-without-law", t.table)
        numbers[law.PLASTIC] = 1.0
        numbers[law.KINEMATIC] = float(t.need("ECROUISSAGE") == "CINEMATIQUE")
    kind = "MOMENT" if turning else "FORCE"
    named = [n for p in ("POINT_A", "POINT_B") for n in _of_point(t, p, names, f"_{p}")]
    named += [(f"{kind}_DE_CHOC_POINT_A", 0, law.FN), (f"{kind}_DE_CHOC_POINT_B", 1, law.FN)]
    if law.FRICTION in numbers:
        named.append(("FORCE_DE_CHOC_TANGENTIELLE", 0, law.FT))
        named.append(("PUISSANCE_USURE_INSTANTANEE", 0, law.WEAR))
    if plastic:
        word = "ROTATION" if turning else "DEPLACEMENT"
        named.append((f"{word}_PLASTIQUE", 0, law.PLASTIC_PART))
        named.append((f"{word}_PLASTIQUE_CUMULE", 0, law.PLASTIC_SUM))
    if t.table.has(Mot("AMORTISSEMENT")):
        named.append(("VITESSE_ROTATION_AXIALE" if turning else "VITESSE_NORMALE", 0, law.VN))
    pair = ((t.point("POINT_A"), 1.0), (t.point("POINT_B"), -1.0))
    ends = () if turning else t.places.ends(*pair)
    return _read_one(t, law.PLANE, a - b, numbers, points, named, ends)


def _about_circle(t: LinkTable, away: FloatArray) -> dict[int, float]:
    """Numbers of the circle that is touched: its side, and its centre in its plane."""
    axis = t.direction("NORMALE")
    side = {law.OUTSIDE: float(not t.entries.flag("CONTACT_INTERIEUR"))}
    return _vector(law.EX, away - (away @ axis) * axis) | side


def _circle(t: LinkTable, basis: Basis) -> ReadLink:
    """POINT_CERCLE, with friction, or on a circle that follows a point."""
    moving = t.kind.endswith("_MOBILE")
    point = t.point("POINT" if moving else "SUPPORT")
    rows, bodies = basis.rows(t.call, point), [(point, 1.0)]
    numbers, points = _spring(t)
    numbers |= _friction(t) | _vector(law.NX, t.direction("NORMALE")) | {law.GAP: t.real("RAYON")}
    if moving:
        rows = rows - basis.rows(t.call, t.point("CERCLE"))
        bodies.append((t.point("CERCLE"), -1.0))
        away = t.vector("CERCLE") - t.vector("POINT")
    else:
        away = t.vector("EXCENTRATION")
    numbers |= _about_circle(t, away)
    named = _RELATIVE + _push_names(t, law.FRICTION in numbers)
    return _read_one(t, law.CIRCLE, rows, numbers, points, named, t.places.ends(*bodies))


def _lines(t: LinkTable, basis: Basis) -> ReadLink:
    """LIGNE_LIGNE_FROTTEMENT and LIGNE_CERCLE_FROTTEMENT: a link for each node that may touch."""
    rings = t.kind.startswith("LIGNE_CERCLE")
    numbers = _friction(t)
    if numbers[law.TANGENT] >= 0.0:
        raise t.call.error("operators.modal.lines-rub-by-oden", t.table)
    plane = workspace(t.call.session).mode.dimension == 2
    flat = plane and not rings and not t.table.has(Mot("NORMALE"))
    axis = np.array([0.0, 0.0, 1.0]) if flat else t.direction("NORMALE")
    numbers |= _vector(law.NX, axis) | {law.GAP: t.real("RAYON") if rings else t.real("JEU")}
    master, slave = t.need("LIGNE_MAITRE"), t.need("LIGNE_ESCLAVE")
    if rings and t.entries.flag("INVERSION"):
        master, slave = slave, master
    pairs = [(slave, master, 0.0)]
    symmetry = t.entries.get("SYMETRIE")
    if symmetry is not None:
        pairs.append((master, slave, float(symmetry == "LOCALE")))
    links, nodes = [], []
    for touching, touched, only in pairs:
        line = t.places.line(touched) if isinstance(touched, Mesh) else (0.0, 0.0)
        if line[0] == line[1]:
            raise t.call.error("operators.modal.no-line-to-touch", t.table)
        numbers |= {law.FIRST: line[0], law.LAST: line[1], law.IF_TOUCHED: only}
        for point in _points_of(touching):
            spring = {law.STIFF: t.at("RAIDEURS", point), law.DAMP: t.at("AMORTISSEMENTS", point)}
            rows = basis.rows(t.call, point)
            ends = ((t.places.number(point), 1.0),)
            kind = law.RING if rings else law.LINE
            links.append(Link(kind, rows, rows, numbers | spring, ends=ends))
            nodes.append(point.node)
    named = [n for n in _push_names(t, True) if n[0].startswith("FORCE")]
    return ReadLink(t.table, tuple(links), tuple(named), np.array(nodes))


def _points_of(line: object) -> list[Point]:
    """Points of a line, which may be one point."""
    if isinstance(line, Mesh):
        return [Point(line.nodes, int(n)) for n in line.sorted_node_ids]
    assert isinstance(line, Point)
    return [line]


def _polynomial(t: LinkTable, basis: Basis) -> ReadLink:
    """POLYNOMIALE: a force on a mode, a product of powers of the motions of modes."""
    to = basis.unit(t.call, t.point("SUPPORT"), "SUPPORT")
    terms = []
    for origin, table in t.table.items():
        if isinstance(origin, Point) and isinstance(table, Table):
            row = np.flatnonzero(basis.unit(t.call, origin, "SUPPORT")[0])
            part = Entries(t.call, table, declared_by(t.call), f"{LINKS}.*")
            part.check()
            if any(part.get(n) for n in ("RETARD_DEPLACEMENT", "RETARD_VITESSE")):
                raise t.call.error("operators.modal.delays-not-built", table)
            words = ("EXPOSANT_DEPLACEMENT", "JEU_DEPLACEMENT", "EXPOSANT_VITESSE", "JEU_VITESSE")
            terms.append([float(row[0]), *(float(part.get(w)) for w in words)])
    numbers = {law.FACTOR: t.real("COEFFICIENT")}
    made = Link(law.POLYNOMIAL, to, to, numbers, terms=np.array(terms).reshape(-1, 5))
    return ReadLink(t.table, (made,), (("FORCE_POLYNOMIALE", 0, law.FN),))


def _read_one(
    t: LinkTable,
    kind: int,
    rows: FloatArray,
    numbers: dict[int, float],
    points: FloatArray | None,
    named: Sequence[Named],
    ends: tuple[tuple[int, float], ...] = (),
    turns: FloatArray | None = None,
) -> ReadLink:
    """A table that makes one contact."""
    made = Link(kind, rows, rows, numbers, points, ends=ends, turns=turns)
    return ReadLink(t.table, (made,), tuple(named))


_FUNCTIONS = {
    ("COS", False): law.COSINE, ("SIN", False): law.SINE,
    ("COS", True): law.COSINE_OF_TIME, ("SIN", True): law.SINE_OF_TIME,
}  # fmt: skip
"""Kinds of couplings by FONCTION, and whether it has a frequency."""


def _coupling(t: LinkTable, basis: Basis) -> ReadLink:
    """COUPLAGE_DEPLACEMENT and COUPLAGE_VITESSE: a force on a mode from the motion of another."""
    to, of = (basis.unit(t.call, t.point(p), p) for p in ("SUPPORT", "ORIGINE"))
    numbers = {law.FACTOR: t.real("COEFFICIENT"), law.EXPONENT: t.real("EXPOSANT")}
    named: list[Named] = [("DEPLACEMENT", 0, Seen(of))]
    if t.kind.endswith("_VITESSE"):
        named += [("VITESSE", 0, law.VN), ("FORCE_DE_COUPLAGE_VITESSE", 0, law.FN)]
        return ReadLink(t.table, (Link(law.VELOCITY, to, of, numbers),), tuple(named))
    kind = law.POWER
    named.append(("FORCE_DE_COUPLAGE_DEPLACEMENT", 0, law.FN))
    if t.table.has(Mot("FONCTION")):
        word = str(t.need("FONCTION"))
        timed = t.table.has(Mot("FREQUENCE"))
        numbers[law.FREQUENCY] = t.real("FREQUENCE", 0.0)
        kind = _FUNCTIONS[word, timed]
    return ReadLink(t.table, (Link(kind, to, of, numbers),), tuple(named))


_READERS = {
    "POINT_PLAN": _plane,
    "POINT_PLAN_FROTTEMENT": _plane,
    "CERCLE_PLAN_FROTTEMENT": _turning_circle,
    "CERCLE_CERCLE_FROTTEMENT": _turning_circle,
    "LIGNE_LIGNE_FROTTEMENT": _lines,
    "LIGNE_CERCLE_FROTTEMENT": _lines,
    "POLYNOMIALE": _polynomial,
    "POINT_POINT": _two_points,
    "POINT_POINT_FROTTEMENT": _two_points,
    "POINT_POINT_DEPLACEMENT_PLASTIQUE": _two_points,
    "POINT_POINT_ROTATION_PLASTIQUE": _two_points,
    "POINT_CERCLE": _circle,
    "POINT_CERCLE_FROTTEMENT": _circle,
    "POINT_CERCLE_MOBILE": _circle,
    "COUPLAGE_DEPLACEMENT": _coupling,
    "COUPLAGE_VITESSE": _coupling,
}


def links_of(call: Call, table: Table | None, basis: Basis) -> tuple[list[ReadLink], LinkArrays]:
    """Links of a table 'LIAISON' (LIAISON_A, LIAISON_B), conditions on one another included."""
    found: list[ReadLink] = []
    places = Places(call, basis)
    for name in ("LIAISON_A", "LIAISON_B"):
        inner = None if table is None else table.get(Mot(name))
        if isinstance(inner, Table):
            read = [_read(call, e, places) for e in _numbered(inner)]
            if len({id(r.table) for r in read}) < len(read):
                call.warn("operators.modal.link-twice", table, name=name)
            found += _with_conditions(read, len(found))
    return found, places.arrays(found, len(basis.marks))


def _numbered(table: Table) -> list[Table]:
    entries = sorted(((i, e) for i, e in table.items() if type(i) is int), key=lambda pair: pair[0])
    return [e for _, e in entries if isinstance(e, Table)]


def _read(call: Call, table: Table, places: Places) -> ReadLink:
    values = LinkTable(call, table, places)
    return _READERS[values.kind](values, places.basis)


def _with_conditions(read: list[ReadLink], first: int) -> list[ReadLink]:
    """Each link with the numbers of those that its table names with VRAI or FAUX."""
    numbers = {id(r.table): first + i for i, r in enumerate(read)}
    out = []
    for group, r in enumerate(read, first):
        named = {
            numbers[id(i)]: v for i, v in r.table.items() if id(i) in numbers and type(v) is bool
        }
        links = tuple(replace(k, conditions=named, group=group) for k in r.links)
        out.append(replace(r, links=links))
    return out


def link_results(
    call: Call,
    read: ReadLink,
    nodes: NodeTable,
    values: FloatArray,
    records: FloatArray,
    wanted: object,
) -> Table:
    """Table of lists in time of a link: displacements (m, n) and its records (m, k, RECORDS).

    Of lines the lists are sums over nodes; forces by node, fields, are given where they are asked
    for by name.
    """
    table = Table()
    for name, component, source in read.names:
        if isinstance(wanted, Table) and not wanted.get(Mot(name), False):
            continue
        if isinstance(source, int):
            numbers = _recorded(records, source, component).sum(axis=1)
        else:
            numbers = source.at(values)[:, component]
        table.set(Mot(name), ListReel(numbers))
    if isinstance(wanted, Table):
        if read.nodes is not None and wanted.get(_BY_NODE, False) is True:
            table.set(_BY_NODE, _by_node(read.nodes, nodes, records))
        for index, asked in wanted.items():
            if asked is True and not table.has(index):
                known = [n for n, _, _ in read.names]
                call.warn("operators.modal.link-gives-no", index=str(index), known=known)
    return table


_BY_NODE = Mot("CHPOINT_FORCE_DE_CHOC")


def _by_node(own: IntArray, nodes: NodeTable, records: FloatArray) -> Table:
    """Forces of the nodes of lines, normal and tangential, by number of the saved step."""
    table = Table()
    order = np.argsort(own)
    for step, record in enumerate(records, start=1):
        rubs = np.linalg.norm(record[order, law.FT : law.FT + 3], axis=1)
        values = {"NORM": record[order, law.FN], "TANG": rubs}
        table.set(step, NodeField.of(nodes, own[order], values, "DISCRET"))
    return table


def _recorded(records: FloatArray, column: int, component: int) -> FloatArray:
    """A column of records (m, k, RECORDS), as (m, k)."""
    if column == law.FT:
        return np.asarray(np.linalg.norm(records[:, :, law.FT : law.FT + 3], axis=2))
    return -records[:, :, column] if component == 1 else records[:, :, column]

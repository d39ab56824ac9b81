"""Tables LIAISON_ELEMENTAIRE of DYNE read as links of the kernel, and their results as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.mesh.mesh import Point
from ssilang.kernel.modal import links as law
from ssilang.kernel.modal.links import Link
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel, Mot, Table
from ssilang.operators.modal.basis import Shape
from ssilang.operators.tables.entries import Entries

LINKS = "TLIAI.LIAISON_A.I"
"""Where the entries of a link are declared, for DYNE and DYNC alike."""
Named = tuple[str, int, FloatArray | int]
"""Index in the results, component, rows of a point or column of the record."""
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
        rows = [[float(s.field.values_at(c, node)[0]) for s in self.shapes] for c in names]
        return np.array(rows)

    def unit(self, call: Call, point: Point, name: str) -> FloatArray:
        """Row (3, n) that picks the unknown of a mode by its point, given at the index `name`."""
        if point.node not in self.marks:
            raise call.error("operators.modal.link-without-mode", point, name=name)
        rows = np.zeros((3, len(self.marks)))
        rows[0, self.marks.index(point.node)] = 1.0
        return rows


@dataclass(frozen=True)
class ReadLink:
    """A link, its table, and the rows of the points whose motion is in the results."""

    table: Table
    link: Link
    names: tuple[Named, ...] = field(default=())


class LinkTable:
    """Values of one table LIAISON_ELEMENTAIRE."""

    def __init__(self, call: Call, table: Table) -> None:
        self.call, self.table = call, table
        self.entries = Entries(call, table, call.name, LINKS)
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
        at = np.asarray(self.point(name).coordinates, dtype=float)
        return np.concatenate([at, np.zeros(3 - len(at))])

    def direction(self, name: str) -> FloatArray:
        """Unit vector."""
        v = self.vector(name)
        size = float(np.linalg.norm(v))
        if size == 0.0:
            raise self.call.error("operators.modal.no-length", self.table, name=name)
        return v / size

    def says(self, name: str) -> bool:
        """A logical."""
        return self.entries.flag(name)

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
        law.PERMANENT: float(t.says("LIAISON_PERMANENTE")),
    }
    limit = t.real("SEUIL_PLASTIQUE", 0.0)
    if limit > 0.0:
        if points is not None:
            raise t.call.error("operators.modal.seuil-plastique-goes-raideur", t.table)
        points = np.array([[0.0, 0.0], [limit / numbers[law.STIFF], limit]])
        numbers[law.PLASTIC] = 1.0
    return numbers, points


def _friction(t: LinkTable) -> dict[int, float]:
    if not t.kind.endswith(("_FROTTEMENT", "_MOBILE")):
        return {}
    numbers = {
        law.FRICTION: 1.0,
        law.SLIDE: t.real("COEFFICIENT_GLISSEMENT"),
        law.STICK: t.real("COEFFICIENT_ADHERENCE"),
        law.TANGENT: t.real("RAIDEUR_TANGENTIELLE"),
        law.TANGENT_DAMP: t.real("AMORTISSEMENT_TANGENTIEL"),
    }
    drive = t.table.get(Mot("VITESSE_ENTRAINEMENT"))
    if isinstance(drive, Point):
        numbers |= _vector(law.DX, t.vector("VITESSE_ENTRAINEMENT"))
    elif drive is not None:
        numbers[law.DX] = t.real("VITESSE_ENTRAINEMENT")
    if numbers[law.TANGENT] < 0.0 and numbers[law.TANGENT_DAMP] <= 0.0:
        raise t.call.error("operators.modal.oden-friction-wants-positive", t.table)
    return numbers


def _of_point(rows: FloatArray, names: Sequence[str], tail: str = "") -> list[Named]:
    return [(name + tail, i, rows) for i, name in enumerate(names)]


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
        named = [("DEPLACEMENT", 0, rows), *_push_names(t, False)]
        return ReadLink(t.table, Link(law.PLANE, rows, rows, numbers, points), tuple(named))
    rows = basis.rows(t.call, support)
    numbers |= _vector(law.NX, t.direction("NORMALE")) | {law.GAP: gap}
    named = _of_point(rows, MOVES) + _push_names(t, law.FRICTION in numbers)
    if law.PLASTIC in numbers:
        named.append(("DEPLACEMENT_PLASTIQUE", 0, law.PLASTIC_PART))
    return ReadLink(t.table, Link(law.PLANE, rows, rows, numbers, points), tuple(named))


def _circle_on_plane(t: LinkTable, basis: Basis) -> ReadLink:
    """CERCLE_PLAN_FROTTEMENT: the point of a circle about SUPPORT that is nearest to a plane.

    It moves by `u + theta x R n`: friction turns the circle.
    """
    support, normal = t.point("SUPPORT"), t.direction("NORMALE")
    centre, turns = basis.rows(t.call, support), basis.rows(t.call, support, TURNS)
    radius = t.real("RAYON_SUPPORT")
    if radius <= 0.0:
        raise t.call.error("operators.modal.rayon-support-link-must", t.table)
    rows = centre + np.cross(turns.T, radius * normal).T
    numbers, points = _spring(t)
    numbers |= _friction(t) | _vector(law.NX, normal) | {law.GAP: t.real("JEU")}
    named = _of_point(centre, MOVES, "_POINT_FIBRE_NEUTRE")
    named += _of_point(turns, TURNS, "_POINT_FIBRE_NEUTRE")
    named += [n for n in _push_names(t, True) if n[0] != "VITESSE_TANGENTIELLE"]
    return ReadLink(t.table, Link(law.PLANE, rows, rows, numbers, points), tuple(named))


def _two_points(t: LinkTable, basis: Basis) -> ReadLink:
    """POINT_POINT and its variants with friction and plasticity (of displacements, rotations)."""
    turning = "ROTATION" in t.kind
    names = TURNS if turning else MOVES
    a, b = (basis.rows(t.call, t.point(p), names) for p in ("POINT_A", "POINT_B"))
    numbers, points = _spring(t)
    numbers |= _friction(t)
    axis = "AXE_ROTATION" if turning and t.table.has(Mot("AXE_ROTATION")) else "NORMALE"
    numbers |= _vector(law.NX, t.direction(axis))
    numbers[law.GAP] = 0.0 if numbers[law.PERMANENT] else t.real("JEU")
    plastic = t.kind.endswith("_PLASTIQUE") and not t.says("ELASTIQUE")
    if plastic:
        if points is None:
            raise t.call.error("operators.modal.link-without-law", t.table)
        numbers[law.PLASTIC] = 1.0
        numbers[law.KINEMATIC] = float(t.need("ECROUISSAGE") == "CINEMATIQUE")
    kind = "MOMENT" if turning else "FORCE"
    named = _of_point(a, names, "_POINT_A") + _of_point(b, names, "_POINT_B")
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
    return ReadLink(t.table, Link(law.PLANE, a - b, a - b, numbers, points), tuple(named))


def _circle(t: LinkTable, basis: Basis) -> ReadLink:
    """POINT_CERCLE, with friction, or on a circle that follows a point."""
    moving = t.kind.endswith("_MOBILE")
    rows = basis.rows(t.call, t.point("POINT" if moving else "SUPPORT"))
    numbers, points = _spring(t)
    numbers |= _friction(t) | _vector(law.NX, t.direction("NORMALE"))
    numbers |= {law.GAP: t.real("RAYON"), law.OUTSIDE: float(not t.says("CONTACT_INTERIEUR"))}
    if moving:
        rows = rows - basis.rows(t.call, t.point("CERCLE"))
        away = t.vector("CERCLE") - t.vector("POINT")
    else:
        away = t.vector("EXCENTRATION")
    axis = t.direction("NORMALE")
    numbers |= _vector(law.EX, away - (away @ axis) * axis)
    named = _of_point(rows, MOVES) + _push_names(t, law.FRICTION in numbers)
    return ReadLink(t.table, Link(law.CIRCLE, rows, rows, numbers, points), tuple(named))


def _coupling(t: LinkTable, basis: Basis) -> ReadLink:
    """COUPLAGE_DEPLACEMENT and COUPLAGE_VITESSE: a force on a mode from the motion of another."""
    to, of = (basis.unit(t.call, t.point(p), p) for p in ("SUPPORT", "ORIGINE"))
    numbers = {law.FACTOR: t.real("COEFFICIENT"), law.EXPONENT: t.real("EXPOSANT")}
    named: list[Named] = [("DEPLACEMENT", 0, of)]
    if t.kind.endswith("_VITESSE"):
        named += [("VITESSE", 0, law.VN), ("FORCE_DE_COUPLAGE_VITESSE", 0, law.FN)]
        return ReadLink(t.table, Link(law.VELOCITY, to, of, numbers), tuple(named))
    kind = law.POWER
    named.append(("FORCE_DE_COUPLAGE_DEPLACEMENT", 0, law.FN))
    if t.table.has(Mot("FONCTION")):
        word = str(t.need("FONCTION"))
        timed = t.table.has(Mot("FREQUENCE"))
        numbers[law.FREQUENCY] = t.real("FREQUENCE", 0.0)
        kind = {
            ("COS", False): law.COSINE, ("SIN", False): law.SINE,
            ("COS", True): law.COSINE_OF_TIME, ("SIN", True): law.SINE_OF_TIME,
        }[word, timed]  # fmt: skip
    return ReadLink(t.table, Link(kind, to, of, numbers), tuple(named))


_READERS = {
    "POINT_PLAN": _plane,
    "POINT_PLAN_FROTTEMENT": _plane,
    "CERCLE_PLAN_FROTTEMENT": _circle_on_plane,
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


def links_of(call: Call, table: Table | None, basis: Basis) -> list[ReadLink]:
    """Links of a table 'LIAISON' (LIAISON_A, LIAISON_B), conditions on one another included."""
    found: list[ReadLink] = []
    for name in ("LIAISON_A", "LIAISON_B"):
        inner = None if table is None else table.get(Mot(name))
        if isinstance(inner, Table):
            read = [_read(call, e, basis) for e in _numbered(inner)]
            found += _with_conditions(read, len(found))
    return found


def _numbered(table: Table) -> list[Table]:
    entries = sorted(((i, e) for i, e in table.items() if type(i) is int), key=lambda pair: pair[0])
    return [e for _, e in entries if isinstance(e, Table)]


def _read(call: Call, table: Table, basis: Basis) -> ReadLink:
    values = LinkTable(call, table)
    return _READERS[values.kind](values, basis)


def _with_conditions(read: list[ReadLink], first: int) -> list[ReadLink]:
    """Each link with the numbers of those that its table names with VRAI or FAUX."""
    numbers = {id(r.table): first + i for i, r in enumerate(read)}
    out = []
    for r in read:
        named = {
            numbers[id(i)]: v for i, v in r.table.items() if id(i) in numbers and type(v) is bool
        }
        out.append(replace(r, link=replace(r.link, conditions=named)))
    return out


def link_results(
    read: ReadLink, place: int, values: FloatArray, records: FloatArray, wanted: object
) -> Table:
    """Table of lists in time of a link: displacements (m, n) and records (m, L, RECORDS)."""
    table = Table()
    for name, component, source in read.names:
        if isinstance(wanted, Table) and not wanted.get(Mot(name), False):
            continue
        if isinstance(source, int):
            numbers = _recorded(records[:, place], source, component)
        else:
            numbers = values @ source[component]
        table.set(Mot(name), ListReel(numbers))
    return table


def _recorded(record: FloatArray, column: int, component: int) -> FloatArray:
    if column == law.FT:
        return np.asarray(np.linalg.norm(record[:, law.FT : law.FT + 3], axis=1))
    return -record[:, column] if component == 1 else record[:, column]

"""BLOQ DEPI SYMT ANTI APPU: conditions on single nodes, their values, planes, springs."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import imposed
from ssilang.kernel.matrices import relations as made
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.workspace import Workspace, workspace

_SENSE = {"MINI": 1, "MAXI": -1}
_KEYWORDS = ("MINI", "MAXI", "DEPL", "ROTA", "DIRECTION", "RADIAL", "ORTHO")


def nodes_of(support: Point | Mesh) -> IntArray:
    """Node numbers of a point or of a mesh, in the mesh's order."""
    return np.array([support.node]) if isinstance(support, Point) else support.node_ids


def as_matrix(relations: Relations) -> Matrix:
    """Conditions alone as a matrix."""
    return Matrix(relations.table, (), (relations,))


class _Held:
    """What BLOQ and APPU read: unknowns, directions, and then the support."""

    def __init__(self, call: Call) -> None:
        self.call = call
        self.ws: Workspace = workspace(call.session)
        self.sense = 0
        self.groups: set[str] = set()
        self.unknowns: list[str] = []
        self.direction: Any = None
        self.polar = ""
        self.centre: list[FloatArray] = []
        self._read_words()

    def _read_words(self) -> None:
        call = self.call
        while call.peek_word() is not None or call.operands:
            word = call.keyword(_KEYWORDS)
            if word in _SENSE:
                self.sense = _SENSE[word]
            elif word in ("DEPL", "ROTA"):
                self.groups.add(word)
            elif word == "DIRECTION":
                self.direction = call.required("POINT", "CHPOINT", after=call.keyword_end)
            elif word is not None:
                self.polar = word
                count = 2 if self.ws.mode.dimension == 3 else 1
                self.centre = [
                    call.required("POINT", after=call.keyword_end).coordinates.copy()
                    for _ in range(count)
                ]
            elif (name := call.word()) is not None:
                self.unknowns.append(name.upper().rstrip())
            else:
                names = call.read("LISTMOTS")
                if names is None:
                    break
                self.unknowns += [str(n).rstrip() for n in names.value.values]

    def names(self) -> tuple[str, ...]:
        """Unknowns named one by one, or by DEPL and ROTA."""
        names = list(self.unknowns)
        if "DEPL" in self.groups:
            names += made.translations(self.ws.mode)
        if "ROTA" in self.groups:
            names += made.rotations(self.ws.mode)
        if not names:
            raise self.call.error("operators.matrices.no-unknown")
        return tuple(names)

    def directed(self) -> bool:
        """True if the condition is along a direction of its own at each node."""
        return self.direction is not None or bool(self.polar)

    def along(self, nodes: IntArray) -> list[tuple[tuple[str, ...], FloatArray]]:
        """Pairs (unknowns, directions (n, dim)) for DIRECTION, RADIAL, ORTHO."""
        mode = self.ws.mode
        if self.polar:
            return [(made.in_space(mode), self._polar_directions(nodes))]
        pairs = []
        for group in sorted(self.groups) or ["DEPL"]:
            names = made.in_space(mode) if group == "DEPL" else made.rotations(mode)
            pairs.append((names, self._directions(names, nodes)))
        return pairs

    def _directions(self, names: tuple[str, ...], nodes: IntArray) -> FloatArray:
        if isinstance(self.direction, Point):
            whole = self.direction.coordinates
            vector = whole[2:] if len(names) == 1 else whole[: len(names)]
            return np.tile(vector, (len(nodes), 1))
        field: NodeField = self.direction
        components = names if set(names) & set(field.components) else tuple(field.components)
        return np.stack([field.values_at(c, nodes) for c in components[: len(names)]], axis=1)

    def _polar_directions(self, nodes: IntArray) -> FloatArray:
        axis = self.centre[1] - self.centre[0] if len(self.centre) == 2 else None
        dim = self.ws.mode.dimension
        away = made.radial_directions(self.ws.nodes, nodes, self.centre[0], axis)
        if self.polar == "ORTHO":
            away = made.orthoradial_directions(away, axis)
        return away[:, :dim]


def _bloq(call: Call) -> Matrix:
    table = call.read("TABLE")
    if table is not None:
        return _bloq_table(call, table.value)
    held = _Held(call)
    nodes = nodes_of(call.required("MAILLAGE", "POINT"))
    _some(nodes)
    if held.directed():
        rows = [
            made.blocked_along(held.ws.nodes, nodes, names, d, held.sense)
            for names, d in held.along(nodes)
        ]
        return as_matrix(made.joined(rows))
    return as_matrix(made.blocked(held.ws.nodes, nodes, held.names(), held.sense))


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


def _bloq_table(call: Call, table: Table) -> Matrix:
    ws = workspace(call.session)
    parts: list[Relations] = []
    for entry, point, unknown in static_links(table):
        if not isinstance(point, Point) or not unknown:
            raise call.error("operators.matrices.link-wants-point-and-unknown", table)
        single = as_matrix(made.blocked(ws.nodes, nodes_of(point), (unknown,)))
        entry.set("BLOCAGE", single)
        parts += single.relations
    if not parts:
        raise call.error("operators.matrices.table-without-entries", table)
    return Matrix(ws.nodes, (), tuple(parts))


operator(
    "BLOQ",
    family="relations",
    full_name="BLOQUE",
    help=Help(
        "Holds unknowns of the nodes of a mesh: zero, or the value that DEPI gives. With 'MINI' "
        "they stay at or above it, with 'MAXI' at or below. 'DEPL' and 'ROTA' name all "
        "displacements and rotations of the mode; 'DIRE' holds along a vector (or a field of "
        "vectors), 'RADI' and 'ORTHO' along or across the line from a point (2D) or an axis (3D).",
        "Bloque des inconnues aux nœuds d'un maillage : à zéro, ou à la valeur donnée par DEPI. "
        "Avec 'MINI' elles restent supérieures ou égales à cette valeur, avec 'MAXI' inférieures "
        "ou égales. 'DEPL' et 'ROTA' désignent tous les déplacements et rotations du mode ; "
        "'DIRE' bloque selon un vecteur (ou un champ de vecteurs), 'RADI' et 'ORTHO' selon le "
        "rayon ou perpendiculairement, depuis un point (2D) ou un axe (3D).",
        "RIG1 = BLOQ ('MINI' | 'MAXI') MOT1 (MOT2 ...) | LISTMOTS1 GEO1 ;\n"
        "RIG1 = BLOQ ('DEPL') ('ROTA') ('DIRE' VEC1 | CHPO1) GEO1 ;\n"
        "RIG1 = BLOQ 'RADI' | 'ORTHO' P1 (P2) GEO1 ;\n"
        "RIG1 = BLOQ TAB1 ;  (LIAISONS_STATIQUES)",
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L1 = DROI 2 (0. 0.) (1. 0.) ;"
            " B1 = BLOQ 'UX' 'UY' L1 ; LIST (NBNO (EXTR B1 'MAIL' 'MULT')) ;",
            "OPTI DIME 2 MODE PLAN DEFO ; P1 = 1. 0. ; B1 = BLOQ 'MINI' 'DIRE' (1. 1.) P1 ;",
        ),
    ),
    reads_itself=True,
)(_bloq)


# --- imposed values --------------------------------------------------------------------------


def _depi(call: Call) -> NodeField | None:
    table = call.read("TABLE")
    if table is not None:
        _depi_table(call, table.value)
        return None
    mixed = call.keyword(("RELA",)) is not None
    matrix: Matrix = call.required("RIGIDITE")
    if not matrix.relations:
        raise call.error("operators.matrices.matrix-without-condition", matrix)
    value = call.required("FLOTTANT", "CHPOINT")
    if not isinstance(value, NodeField):
        return imposed.imposed_uniform(matrix.relations, float(value))
    fill = imposed.imposed_by_node if mixed else imposed.imposed_from_field
    return fill(matrix.relations, value)


def _depi_table(call: Call, table: Table) -> None:
    for entry, _, _ in static_links(table):
        block = entry.get("BLOCAGE")
        if not isinstance(block, Matrix):
            raise call.error("operators.matrices.link-without-blocage", table)
        entry.set("FORCE", imposed.imposed_uniform(block.relations, 1.0))


operator(
    "DEPI",
    family="relations",
    full_name="DEPIMPOSE",
    help=Help(
        "Values imposed on conditions made by BLOQ, RELA ...: one number for all, or a field of "
        "the held unknowns. With 'RELA' a field SCAL gives the value of relations between unknowns "
        "of one node. Add the result to the second member of RESO.",
        "Valeurs imposées aux conditions de BLOQ, RELA ... : un nombre pour toutes, ou un champ "
        "des inconnues bloquées. Avec 'RELA' un champ SCAL donne la valeur de relations entre "
        "inconnues d'un même nœud. Le résultat s'ajoute au second membre de RESO.",
        "CHPO1 = DEPI RIG1 FLOT1 | CHPO2 | 'RELA' CHPO3 ;\nDEPI TAB1 ;  (LIAISONS_STATIQUES)",
        (
            "OPTI DIME 2 MODE PLAN DEFO ; P1 = 1. 0. ; B1 = BLOQ 'UX' P1 ;"
            " F1 = DEPI B1 1.E-3 ; LIST F1 ;",
        ),
    ),
    reads_itself=True,
)(_depi)


# --- planes of symmetry ----------------------------------------------------------------------


def _mirror(call: Call, mirrored: bool) -> Matrix:
    ws = workspace(call.session)
    groups = set()
    while (word := call.keyword(("DEPL", "ROTA"))) is not None:
        groups.add(word)
    if not groups:
        raise call.error("operators.matrices.say-depl-or-rota")
    dim = ws.mode.dimension
    if dim == 1:
        raise call.error("operators.matrices.symmetry-wants-dimensions")
    points = np.stack([call.required("POINT").coordinates for _ in range(dim)])
    mesh = call.required("MAILLAGE", "POINT")
    tolerance = call.optional("FLOTTANT", default=ws.density / 10.0)
    if tolerance <= 0.0:
        raise call.error("operators.matrices.symmetry-distance-missing")
    near, normal = made.on_plane(ws.nodes, nodes_of(mesh), points, tolerance)
    names = made.in_space(ws.mode) if "DEPL" in groups else ()
    turns = made.rotations(ws.mode) if "ROTA" in groups else ()
    return as_matrix(made.mirror_rows(ws.nodes, near, normal, names, turns, mirrored))


_PLANE_SYNTAX = "RIG1 = {} ('DEPL') ('ROTA') P1 P2 (P3 in 3D) GEO1 (FLOT1) ;"
_PLANE_EXAMPLE = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P1 = 0. 0. ; P2 = 0. 1. ; L1 = DROI 2 P1 P2 ;"
    " B1 = {} 'DEPL' P1 P2 L1 1.E-3 ;"
)
operator(
    "SYMT",
    family="relations",
    full_name="SYMT",
    help=Help(
        "Conditions of symmetry at the nodes of a mesh that lie on a line (2D) or plane (3D): no "
        "displacement across it ('DEPL'), no rotation about axes in it ('ROTA'). FLOT1 is the "
        "distance up to which a node counts (default a tenth of the density).",
        "Conditions de symétrie aux nœuds du maillage situés sur une droite (2D) ou un plan (3D) : "
        "pas de déplacement à travers ('DEPL'), pas de rotation autour d'axes du plan ('ROTA'). "
        "FLOT1 est la distance de sélection (par défaut un dixième de la densité).",
        _PLANE_SYNTAX.format("SYMT"),
        (_PLANE_EXAMPLE.format("SYMT"),),
    ),
    reads_itself=True,
)(lambda call: _mirror(call, True))
operator(
    "ANTI",
    family="relations",
    full_name="ANTISYMETRIE",
    help=Help(
        "Conditions of antisymmetry at the nodes of a mesh that lie on a line (2D) or plane (3D): "
        "no displacement within it, no rotation about its normal.",
        "Conditions d'antisymétrie aux nœuds du maillage situés sur une droite (2D) ou un plan "
        "(3D) : pas de déplacement dans le plan, pas de rotation autour de sa normale.",
        _PLANE_SYNTAX.format("ANTI"),
        (_PLANE_EXAMPLE.format("ANTI"),),
    ),
    reads_itself=True,
)(lambda call: _mirror(call, False))


# --- springs to the ground -------------------------------------------------------------------


def _appu(call: Call) -> Matrix:
    held = _Held(call)
    if held.sense:
        raise call.error("operators.matrices.spring-works-both-ways")
    stiffness = call.required("FLOTTANT")
    nodes = nodes_of(call.required("MAILLAGE", "POINT"))
    _some(nodes)
    if not held.directed():
        return made.springs(held.ws.nodes, nodes, held.names(), stiffness)
    parts = [
        made.springs(held.ws.nodes, nodes, names, stiffness, d) for names, d in held.along(nodes)
    ]
    return Matrix(held.ws.nodes, tuple(b for p in parts for b in p.blocks))


operator(
    "APPU",
    family="relations",
    full_name="APPUI",
    help=Help(
        "Linear springs to the ground at the nodes of a mesh, on the unknowns named or along a "
        "direction (as in BLOQ), of stiffness FLOT1 each.",
        "Ressorts linéaires vers le sol aux nœuds d'un maillage, sur les inconnues nommées ou "
        "selon une direction (comme BLOQ), de raideur FLOT1 chacun.",
        "RIG1 = APPU MOT1 ... | ('DEPL') ('ROTA') ('DIRE' VEC1) | 'RADI' P1 (P2) FLOT1 GEO1 ;",
        ("OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; R1 = APPU 'UX' 'UY' 1.E6 P1 ;",),
    ),
    reads_itself=True,
)(_appu)

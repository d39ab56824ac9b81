"""Moved copies of objects: PLUS MOIN TOUR SYME HOMO AFFI PROJ DEDU."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model
from ssilang.kernel.mesh.changes.transform import NodeCopier, PointMap, mapping_between, shift
from ssilang.kernel.mesh.generators.sweep import corresponding_nodes
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.fields.turned import turned_cell_field, turned_node_field
from ssilang.operators.mesh.following import following
from ssilang.operators.mesh.maps import (
    read_affinity,
    read_projection,
    read_scaling,
    read_symmetry,
    read_turn,
    rotation_matrix,
)
from ssilang.operators.mesh.moves import displacements
from ssilang.operators.workspace import Workspace, workspace

GEOMETRIC = ("POINT", "MAILLAGE", "CHPOINT", "MCHAML", "MMODEL", "TABLE")


def displacement_names(ws: Workspace) -> tuple[str, ...]:
    """Displacement components of the mode in force."""
    if ws.mode in (Mode.AXISYMMETRIC, Mode.FOURIER):
        return ("UR", "UZ")
    return ("UX", "UY", "UZ")[: ws.dimension]


class Copier:
    """Copies of objects of any kind whose nodes go through one `NodeCopier`."""

    def __init__(self, nodes: NodeCopier, rotation: FloatArray | None = None) -> None:
        self.nodes = nodes
        self.rotation = rotation
        self._blocks: dict[int, tuple[CellBlock, CellBlock]] = {}

    def block(self, block: CellBlock) -> CellBlock:
        """Copy of a block, the same one each time it is met."""
        made = self._blocks.get(id(block))
        if made is None:
            made = self._blocks[id(block)] = (block, self.nodes.block(block))
        return made[1]

    def mesh(self, mesh: Mesh) -> Mesh:
        """Copy of a mesh with its sides."""
        blocks = tuple(self.block(b) for b in mesh.blocks)
        return Mesh(mesh.nodes, blocks, tuple(self.mesh(s) for s in mesh.sides))

    def node_field(self, field: NodeField) -> NodeField:
        """The field on the copied nodes, vectors turned by the rotation if there is one."""
        components = {
            name: NodeField.of(field.table, self.nodes.of_nodes(part.nodes), {name: part.values})
            for name, part in field.components.items()
        }
        made = NodeField(
            field.table, {k: f.components[k] for k, f in components.items()}, field.nature
        )
        return made if self.rotation is None else turned_node_field(made, self.rotation)

    def cell_field(self, field: CellField) -> CellField:
        """The field on the copied cells, tensors turned by the rotation if there is one."""
        blocks = tuple(replace(b, cells=self.block(b.cells)) for b in field.blocks)
        made = CellField(blocks, field.title)
        return made if self.rotation is None else turned_cell_field(made, self.rotation)

    def model(self, model: Model) -> Model:
        """The model on the copied cells."""
        return Model(tuple(replace(z, cells=self.block(z.cells)) for z in model.zones))

    def table(self, table: Table) -> Table:
        """A table of copies, indices kept."""
        made = Table()
        for index, value in table.items():
            made.set(index, self(value) if type(value) in _COPIES else value)
        return made

    def __call__(self, value: Any) -> Any:
        return _COPIES[type(value)](self, value)


_COPIES: dict[type, Any] = {
    Point: lambda c, p: c.nodes.point(p),
    Mesh: Copier.mesh,
    NodeField: Copier.node_field,
    CellField: Copier.cell_field,
    Model: Copier.model,
    Table: Copier.table,
}


def copies(
    call: Call, objects: Sequence[Any], image: PointMap, rotation: FloatArray | None = None
) -> Any:
    """Copies of all objects through one map: one result, or a tuple."""
    if not objects:
        raise call.missing(GEOMETRIC)
    copier = Copier(NodeCopier(workspace(call.session).nodes, image), rotation)
    made = tuple(copier(v) for v in objects)
    return made if len(made) > 1 else made[0]


def _displaced(call: Call, objects: Sequence[Any], field: NodeField, sign: float) -> Any:
    """Copies whose nodes move by a field of displacements."""
    ws = workspace(call.session)

    def moved(ids: IntArray) -> FloatArray:
        return ws.nodes.coordinates[ids] + sign * displacements(field, ids)

    copier = Copier(NodeCopier(ws.nodes, by_node=moved))
    made = tuple(copier(v) for v in objects)
    return made if len(made) > 1 else made[0]


def _shifted(call: Call, sign: float) -> Any:
    operands = call.all(*GEOMETRIC)
    if len(operands) < 2:
        raise call.missing(("POINT", "CHPOINT"))
    *objects, last = operands
    if not isinstance(last, Point | NodeField):
        if not isinstance(objects[0], Point | NodeField):
            raise call.bad("the last operand is the vector (POINT) or the displacements", last)
        last, *objects = operands
    if isinstance(last, NodeField):
        return _displaced(call, objects, last, sign)
    return copies(call, objects, shift(sign * last.coordinates.copy()))


@operator(
    "PLUS",
    family="mesh",
    help=Help(
        en="Copies of objects moved by a vector or by a field of displacements (UX UY UZ or UR "
        "UZ); nodes that several objects share are copied once. As many results as objects.",
        fr="Copies d'objets translatés d'un vecteur ou d'un champ de déplacements (UX UY UZ ou UR "
        "UZ) ; les noeuds communs ne sont copiés qu'une fois. Autant de résultats que d'objets.",
        syntax="OBJ2 ... = OBJ1 ... PLUS VEC1|CHPO1 ;",
        examples=("OPTI DIME 2 ; P = 1. 0. ; Q = P PLUS (0. 2.) ; LIST (COOR 2 Q) ;",),
    ),
    reads_itself=True,
)
def plus(call: Call) -> Any:
    """Copy and move."""
    return _shifted(call, 1.0)


@operator(
    "MOIN",
    family="mesh",
    full_name="MOINS",
    help=Help(
        en="Copies of objects moved against a vector or a field of displacements; between two "
        "meshes of the same structure, the field of displacements that takes the second to the "
        "first.",
        fr="Copies d'objets translatés de l'opposé d'un vecteur ou d'un champ de déplacements ; "
        "entre deux maillages de même structure, le champ de déplacements qui mène du second au "
        "premier.",
        syntax="OBJ2 ... = OBJ1 ... MOIN VEC1|CHPO1 ;\nCHPO1 = GEO2 MOIN GEO1 ;",
        examples=("OPTI DIME 2 ; P = 1. 0. ; Q = P MOIN (0. 2.) ; LIST (COOR 2 Q) ;",),
    ),
    reads_itself=True,
)
def moin(call: Call) -> Any:
    """Copy and move backwards, or find the motion between two meshes."""
    operands = [o.value for o in call.operands]
    if len(operands) == 2 and all(isinstance(v, Mesh) for v in operands):
        after, before = call.required("MAILLAGE"), call.required("MAILLAGE")
        target = corresponding_nodes(before, after)
        ids = before.node_ids
        xyz = before.nodes.coordinates
        gap = xyz[target] - xyz[ids]
        names = displacement_names(workspace(call.session))
        return NodeField.of(
            before.nodes, ids, {name: gap[:, k] for k, name in enumerate(names)}, "DIFFUS"
        )
    return _shifted(call, -1.0)


@operator(
    "TOUR",
    family="mesh",
    full_name="TOURNER",
    help=Help(
        en="Copies of objects turned by an angle in degrees about a point (2D) or an axis (3D). "
        "Vectors in nodal fields and stresses and strains in cell fields turn too.",
        fr="Copies d'objets tournés d'un angle en degrés autour d'un point (2D) ou d'un axe (3D). "
        "Les vecteurs des champs par points, contraintes et déformations tournent aussi.",
        syntax="OBJ2 ... = OBJ1 ... TOUR FLOT1 POIN1 (POIN2) ;",
        examples=("OPTI DIME 2 ; P = 1. 0. ; Q = P TOUR 90. (0. 0.) ; LIST (COOR 2 Q) ;",),
    ),
    reads_itself=True,
)
def tour(call: Call) -> Any:
    """Copy and turn."""
    points = 1 if workspace(call.session).dimension < 3 else 2
    objects = _before(call, points)
    image, matrix = read_turn(call)
    return copies(call, objects, image, matrix)


def _before(call: Call, points: int) -> list[Any]:
    """Consume the objects to copy, leaving the last `points` points for the map."""
    found = []
    for operand in call.operands:
        if isinstance(operand.value, str):
            break
        if isinstance(operand.value, tuple(_COPIES)):
            found.append(operand)
    kept = [o for o in found if isinstance(o.value, Point)][-points:] if points else []
    taken = [o for o in found if not any(o is k for k in kept)]
    for operand in taken:
        call.operands.remove(operand)
        call.used.append(operand)
    return [o.value for o in taken]


@operator(
    "SYME",
    family="mesh",
    full_name="SYMETRIE",
    help=Help(
        en="Copies of points, meshes or nodal fields mirrored about a point, a line or a plane.",
        fr="Copies de points, maillages ou champs par points symétriques par rapport à un point, "
        "une droite ou un plan.",
        syntax="GEO1 ... = GEO2 ... SYME 'POINT' P1 | 'DROIT' P1 P2 | 'PLAN' P1 P2 P3 ;",
        examples=(
            "OPTI DIME 2 ; P = 1. 2. ; Q = P SYME 'DROIT' (0. 0.) (1. 0.) ; LIST (COOR 2 Q) ;",
        ),
    ),
    reads_itself=True,
)
def syme(call: Call) -> Any:
    """Copy and mirror."""
    objects = call.all(*GEOMETRIC)
    word = call.keyword(("POINT", "DROIT", "PLAN"))
    if word is None:
        raise call.bad("what is mirrored about is not said", hint="'POINT', 'DROIT' or 'PLAN'")
    needed = {"POINT": 1, "DROIT": 2, "PLAN": 3}[word]
    objects += _before(call, needed)
    return copies(call, objects, read_symmetry(call, word))


@operator(
    "HOMO",
    family="mesh",
    full_name="HOMOTHETIE",
    help=Help(
        en="Copies of objects scaled by a ratio about a point.",
        fr="Copies d'objets par homothétie de rapport et de centre donnés.",
        syntax="GEO1 ... = GEO2 ... HOMO RAPP1 POIN1 ;",
        examples=("OPTI DIME 2 ; P = 1. 2. ; Q = P HOMO 3. (0. 0.) ; LIST (COOR 2 Q) ;",),
    ),
    reads_itself=True,
)
def homo(call: Call) -> Any:
    """Copy and scale."""
    objects = _before(call, 1)
    return copies(call, objects, read_scaling(call))


@operator(
    "AFFI",
    family="mesh",
    full_name="AFFINITE",
    help=Help(
        en="Copies of objects stretched by a ratio along the direction of two points, the first of "
        "which stays in place.",
        fr="Copies d'objets par affinité de rapport donné suivant la direction de deux points, le "
        "premier restant en place.",
        syntax="GEO2 ... = GEO1 ... AFFI FLOT1 POIN1 POIN2 ;",
        examples=("OPTI DIME 2 ; P = 1. 2. ; Q = P AFFI 3. (0. 0.) (0. 1.) ; LIST (COOR 2 Q) ;",),
    ),
    reads_itself=True,
)
def affi(call: Call) -> Any:
    """Copy and stretch."""
    objects = _before(call, 2)
    return copies(call, objects, read_affinity(call))


@operator(
    "PROJ",
    family="mesh",
    full_name="PROJETER",
    help=Help(
        en="Copies of objects projected along a vector ('CYLI', the default) or from a point "
        "('CONI') on a plane, sphere, cylinder, cone or torus; in 2D on a line or a circle.",
        fr="Copies d'objets projetés suivant un vecteur ('CYLI', par défaut) ou depuis un point "
        "('CONI') sur un plan, une sphère, un cylindre, un cône ou un tore ; en 2D sur une droite "
        "ou un cercle.",
        syntax="GEO1 ... = GEO2 ... PROJ ('CYLI') VEC1 | 'CONI' SOMM1  'PLAN' P1 P2 P3 | "
        "'SPHE' C1 P1 | 'CYLI' C1 C2 P1 | 'CONI' S1 A1 P1 | 'TORI' C1 A1 C2 P1 | "
        "'DROI' P1 P2 | 'CERC' C1 P1 ;",
        examples=(
            "OPTI DIME 2 ; P = 1. 2. ; Q = P PROJ (0. 1.) 'DROI' (0. 0.) (1. 1.) ;"
            " LIST (COOR 2 Q) ;",
        ),
    ),
    reads_itself=True,
)
def proj(call: Call) -> Any:
    """Copy and project."""
    words = sum(isinstance(o.value, str) for o in call.operands)
    objects = _before(call, 0 if words > 1 else 1)  # two words: the first is 'CYLI' or 'CONI'
    return copies(call, objects, read_projection(call))


@operator(
    "DEDU",
    family="mesh",
    full_name="DEDUIRE",
    help=Help(
        en="Copy of a mesh of linear surfaces or volumes whose master nodes GEO2 have become those "
        "of GEO3, of the same structure; the others follow harmonically. 'REGU': then each inner "
        "node goes to the mean of its neighbours. A displacement of some nodes is carried to all "
        "in the same way. 'TRAN': copies of objects through the transformation that takes one mesh "
        "to another of the same structure; 'ROTA': the same, vectors and tensors of fields turning "
        "by the angle.",
        fr="Copie d'un maillage de surfaces ou volumes linéaires dont les noeuds maîtres GEO2 sont "
        "devenus ceux de GEO3, de même structure ; les autres suivent harmoniquement. 'REGU' : "
        "puis chaque noeud intérieur va au milieu de ses voisins. Un déplacement de certains "
        "noeuds est étendu à tous de même. 'TRAN' : copies d'objets par la transformation qui mène "
        "d'un maillage à un autre de même structure ; 'ROTA' : de même, vecteurs et tenseurs des "
        "champs tournant de l'angle.",
        syntax="GEO4 = DEDU GEO1 GEO2 GEO3 ('REGU') ;\nCHPO2 = DEDU GEO1 CHPO1 ;\n"
        "OBJ2 ... = OBJ1 ... DEDU 'TRAN' GEO1 GEO2 ;\n"
        "OBJ2 ... = OBJ1 ... DEDU 'ROTA' FLOT1 POIN1 (POIN2) GEO1 GEO2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; M = DROI 4 (0. 1.) (2. 1.) ;"
            " P = L POIN 'FINAL' ; Q = P DEDU 'TRAN' L M ; LIST (COOR 1 Q) ;",
        ),
    ),
    reads_itself=True,
)
def dedu(call: Call) -> Any:
    """Copy through the map between two meshes."""
    objects = call.all(*GEOMETRIC)
    angle = call.optional("FLOTTANT")
    word = call.keyword(("TRAN", "ROTA"))
    if word is None:
        made = following(call, objects)
        return made if isinstance(made, NodeField) else Copier(made[1]).mesh(made[0])
    if word == "ROTA" and angle is None:
        angle = call.required("FLOTTANT")
    later = objects + call.all(*GEOMETRIC)
    if len(later) < 3 or not all(isinstance(m, Mesh) for m in later[-2:]):
        raise call.missing(("MAILLAGE",))
    objects, rotation = later[:-2], None
    if word == "ROTA":
        count = 1 if workspace(call.session).dimension < 3 else 2
        points = [v for v in objects if isinstance(v, Point)][-count:]
        if len(points) < count:
            raise call.missing(("POINT",))
        objects = [v for v in objects if not any(v is p for p in points)]
        axis = points[1].coordinates - points[0].coordinates if count == 2 else np.eye(3)[2]
        rotation = rotation_matrix(float(angle), axis)
    copier = Copier(mapping_between(later[-2], later[-1]), rotation)
    made = tuple(copier(v) for v in objects)
    if not made:
        raise MeshError("nothing is given to transform")
    return made if len(made) > 1 else made[0]

"""Type words of the kernel's classes."""

from __future__ import annotations

from ssilang.kernel.curves.curve import Curve, Load
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.values import register_type

for _cls, _word in (
    (Point, "POINT"),
    (Mesh, "MAILLAGE"),
    (NodeField, "CHPOINT"),
    (CellField, "MCHAML"),
    (Model, "MMODEL"),
    (Matrix, "RIGIDITE"),
    (Curve, "EVOLUTIO"),
    (Load, "CHARGEME"),
):
    register_type(_cls, _word)

"""Type words of the classes that scripts hold besides those of the language itself."""

from __future__ import annotations

from ssilang.language.values import name_types

name_types(
    {
        "ssilang.kernel.mesh.mesh:Point": "POINT",
        "ssilang.kernel.mesh.mesh:Mesh": "MAILLAGE",
        "ssilang.kernel.fields.node_field:NodeField": "CHPOINT",
        "ssilang.kernel.fields.cell_field:CellField": "MCHAML",
        "ssilang.kernel.materials.model:Model": "MMODEL",
        "ssilang.kernel.matrices.matrix:Matrix": "RIGIDITE",
        "ssilang.kernel.curves.curve:Curve": "EVOLUTIO",
        "ssilang.kernel.curves.curve:Load": "CHARGEME",
        "ssilang.kernel.curves.cloud:Cloud": "NUAGE",
        "ssilang.kernel.matrices.superelement:SuperElement": "SUPERELE",
        "ssilang.kernel.fields.deformed:Deformed": "DEFORME",
        "ssilang.kernel.fields.deformed:Arrows": "VECTEUR",
        "ssilang.io.plots.labels:Annotation": "ANNOTATI",
        "ssilang.operators.modal.modes:Solution": "SOLUTION",
        "ssilang.operators.session.configurations:Configuration": "CONFIGUR",
    }
)

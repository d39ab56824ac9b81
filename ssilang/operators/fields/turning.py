"""Vectors and tensors of fields turned by a rotation."""

from ssilang.operators.prelude import *

_VECTORS = (("UX", "UY", "UZ"), ("FX", "FY", "FZ"), ("RX", "RY", "RZ"), ("MX", "MY", "MZ"))
_TENSORS = (
    ("SMXX", "SMYY", "SMZZ", "SMXY", "SMXZ", "SMYZ"),
    ("EPXX", "EPYY", "EPZZ", "GAXY", "GAXZ", "GAYZ"),
    ("EPXX", "EPYY", "EPZZ", "EPXY", "EPXZ", "EPYZ"),
)
_PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def turned_node_field(field: NodeField, rotation: FloatArray) -> NodeField:
    """Displacements, forces, rotations and moments multiplied by a rotation matrix (3, 3).

    Vectors are turned where one of their components is defined, the others counting as zero.
    """
    made = dict(field.components)
    for names in _VECTORS:
        present = [n for n in names if n in made]
        if not present:
            continue
        nodes = np.unique(np.concatenate([made[n].nodes for n in present]))
        old = np.column_stack([field.values_at(n, nodes) for n in names])
        new = old @ rotation.T
        for k, name in enumerate(names):
            if name in made or np.abs(new[:, k]).max(initial=0.0) > 0.0:
                part = NodeField.of(field.table, nodes, {name: new[:, k]})
                made[name] = part.components[name]
    return NodeField(field.table, made, field.nature)


def turned_cell_field(field: CellField, rotation: FloatArray) -> CellField:
    """Stresses and strains turned by a rotation matrix (3, 3); other components are kept."""
    blocks = tuple(
        replace(b, components=_turned_tensors(b.components, rotation)) for b in field.blocks
    )
    return CellField(blocks, field.title)


def _turned_tensors(components: Mapping[str, Any], rotation: FloatArray) -> dict[str, Any]:
    made = dict(components)
    for names in _TENSORS:
        present = [n for n in names if n in components]
        if not present or (names[3].startswith("GA") and "EPXY" in components):
            continue
        half = 0.5 if names[3].startswith("GA") else 1.0
        shape = np.broadcast_shapes(*(np.shape(components[n]) for n in present))
        tensor = np.zeros((*shape, 3, 3))
        for name, (i, j) in zip(names, _PLACES, strict=True):
            if name in components:
                value = components[name] * (1.0 if i == j else half)
                tensor[..., i, j] = tensor[..., j, i] = value
        tensor = rotation @ tensor @ rotation.T
        for name, (i, j) in zip(names, _PLACES, strict=True):
            value = tensor[..., i, j] / (1.0 if i == j else half)
            if name in components or np.abs(value).max(initial=0.0) > 0.0:
                made[name] = value
    return made

"""Elastic moduli of continuous elements from material parameters; Hooke matrices as fields."""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import CellFieldBlock, Support
from ssilang.kernel.materials import elasticity
from ssilang.kernel.materials.model import Mode, Zone


def material_axes(parameters: ZoneField, support: Support) -> FloatArray:
    """Axes of orthotropy (n_cells or 1, n_points or 1, 3, 3), unit vectors as rows.

    Built from the parameters V1X V1Y (V1Z) and V2X V2Y V2Z that MATE made from DIRECTION.
    """
    if "V1X" not in parameters:
        raise MaterialError("kernel.elements.orthotropic-material-needs-axes")
    rolled = parameters.zone.mode is Mode.FOURIER and "V2Z" in parameters
    flat = parameters.zone.mode is not Mode.THREE_DIMENSIONAL and not rolled

    def given(name: str) -> FloatArray:
        parts = (parameters.at(name + a, support, 0.0) for a in "XYZ")
        return np.stack(np.broadcast_arrays(*parts), axis=-1)

    first = given("V1")
    if flat:
        second = np.stack([-first[..., 1], first[..., 0], 0 * first[..., 0]], axis=-1)
    else:
        second = given("V2")
    v1, v2 = elasticity.two_axes(first, second)
    return np.stack([v1, v2, np.cross(v1, v2)], axis=-2)


_Pair = tuple[FloatArray, FloatArray]
"""Moduli and compliance."""


def _isotropic_pair(parameters: ZoneField, support: Support) -> _Pair:
    young, poisson = (parameters.at(name, support) for name in ("YOUN", "NU"))
    elasticity.check_isotropic(young, poisson)
    compliance = elasticity.isotropic_compliance(young, poisson)
    return elasticity.isotropic_moduli(young, poisson), compliance


def _orthotropic_pair(parameters: ZoneField, support: Support) -> _Pair:
    # the nine constants; those that a hypothesis does not use get harmless values
    constants = {name: parameters.at(name, support) for name in ("YG1", "YG2", "NU12", "G12")}
    mode = parameters.zone.mode
    shears = {"G23": constants["G12"], "G13": constants["G12"]}
    spared = {} if mode in (Mode.THREE_DIMENSIONAL, Mode.FOURIER) else shears
    if mode is Mode.PLANE_STRESS:
        nothing = np.zeros((1, 1))
        spared |= {"YG3": constants["YG2"], "NU23": nothing, "NU13": nothing}
    for name in ("YG3", "NU23", "NU13", "G23", "G13"):
        given = name in parameters or name not in spared
        constants[name] = parameters.at(name, support) if given else spared[name]
    local = elasticity.orthotropic_compliance(constants)
    axes = material_axes(parameters, support)
    moduli = elasticity.rotated_moduli(np.linalg.inv(local).astype(np.float64), axes)
    T = elasticity.strain_rotation(axes)
    back = np.linalg.inv(T)
    return moduli, back @ local @ np.swapaxes(back, -1, -2)


def _with_compliance(moduli: FloatArray) -> _Pair:
    return moduli, np.linalg.pinv(moduli).astype(np.float64)


def _anisotropic_pair(parameters: ZoneField, support: Support) -> _Pair:
    """The 21 terms D11 D21 D22 ... in the axes given, the global ones without."""
    terms = {
        (i, j): parameters.at(f"D{i + 1}{j + 1}", support, 0.0)
        for i in range(6)
        for j in range(i + 1)
    }
    shape = np.broadcast_shapes(*(t.shape for t in terms.values()))
    D = np.zeros((*shape, 6, 6))
    for (i, j), value in terms.items():
        D[..., i, j] = D[..., j, i] = value
    axes = material_axes(parameters, support) if "V1X" in parameters else np.eye(3)[None, None]
    return _with_compliance(elasticity.rotated_moduli(D, axes))


def _unidirectional_pair(parameters: ZoneField, support: Support) -> _Pair:
    """Stiffness along the first axis only."""
    young = parameters.at("YOUN", support)
    D = np.zeros((*young.shape, 6, 6))
    D[..., 0, 0] = young
    return _with_compliance(elasticity.rotated_moduli(D, material_axes(parameters, support)))


SOLID_LAWS: dict[str, Callable[[ZoneField, Support], _Pair]] = {
    "ISOTROPE": _isotropic_pair,
    "ORTHOTROPE": _orthotropic_pair,
    "ANISOTROPE": _anisotropic_pair,
    "UNIDIRECTIONNEL": _unidirectional_pair,
}


def symmetry_of(zone: Zone) -> str:
    """'ISOTROPE', 'ORTHOTROPE' ...: the kind of elasticity of a zone."""
    after = zone.behaviour[1:2] if zone.behaviour[:1] == ("ELASTIQUE",) else ()
    return after[0] if after else "ISOTROPE"


def _pair(zone: Zone, parameters: ZoneField, support: Support) -> _Pair:
    name = symmetry_of(zone)
    if name not in SOLID_LAWS:
        raise MaterialError(
            "kernel.elements.elasticity-not-available-element", name=name, element=zone.element
        )
    return SOLID_LAWS[name](parameters, support)


def solid_moduli(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Moduli (n_cells or 1, n_points or 1, n_strains, n_strains) of a zone's hypothesis."""
    return elasticity.reduced_moduli(_pair(zone, parameters, support)[0], zone.mode)


def solid_compliance(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Compliance with the same shape; in plane stress EPZZ follows from the stresses."""
    kept = list(elasticity.KEPT[zone.mode])
    return _pair(zone, parameters, support)[1][..., kept, :][..., kept]


HOOKE_COMPONENT = "MAHO"


def hooke_block(zone: Zone, moduli: FloatArray, support: Support) -> CellFieldBlock:
    """Block with one matrix (as an array object) a cell and point.

    Parameters
    ----------
    moduli : array (n_cells or 1, n_points or 1, s, s)
    """
    objects = np.empty(moduli.shape[:2], dtype=object)
    for place in np.ndindex(*objects.shape):
        objects[place] = moduli[place]
    values = np.broadcast_to(objects, (len(zone.cells), objects.shape[1]))
    return zone.block({HOOKE_COMPONENT: values}, support)


def moduli_from_field(material: ZoneField, support: Support) -> FloatArray | None:
    """Moduli (n_cells or 1, n_points or 1, s, s) of a field of Hooke matrices, None without one.

    Raises
    ------
    FieldError
        If the matrices were computed at other points.
    """
    if HOOKE_COMPONENT not in material:
        return None
    values, found = material.raw(HOOKE_COMPONENT)
    if values.shape[1] > 1 and found != support and {found, support} != {"RIGIDITE", "STRESSES"}:
        raise FieldError(
            "kernel.elements.hooke-matrices-stand-needed", found=found, support=support
        )
    first = values[0, 0]
    if all(v is first for v in values.ravel()):
        return np.asarray(first, dtype=float)[None, None]
    rows = [np.asarray(v, dtype=float) for v in values.ravel()]
    return np.array(rows).reshape(*values.shape, *rows[0].shape)


def inverted(zone: Zone, moduli: FloatArray) -> FloatArray:
    """Inverse of moduli; an error where they are singular."""
    try:
        return np.linalg.inv(moduli).astype(np.float64)
    except np.linalg.LinAlgError:
        raise MaterialError(
            "kernel.elements.elastic-matrix-element-cannot", element=zone.element
        ) from None

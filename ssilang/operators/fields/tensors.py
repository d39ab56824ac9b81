"""PRIN INVA VMIS TRES ENER GRAD INTG JACO: quantities derived from fields in cells."""

from ssilang.kernel.elements import families
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import SHELLS, family_name, support_rule
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.results import skin, structural_gradients, tensors
from ssilang.kernel.elements.results.frames import is_thin_shell
from ssilang.kernel.elements.results.integrals import integrals
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.elements.solids.gradients import (
    gradient_names,
    gradient_values,
    scalar_gradient,
)
from ssilang.kernel.elements.solids.solid import coordinates, zone_geometry
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.family import jump_gradient
from ssilang.operators.dispatch import INTG
from ssilang.operators.matrices.element import joined, present
from ssilang.operators.prelude import *
from ssilang.operators.statics.stresses import MODEL, on_zones, state_and_rest

_SKINS = ("SUPE", "MOYE", "INFE")


STATE = many("fields", "MCHAML", at_least=1, en="stresses or strains, and parameters")
_SIDE = choice(
    "side",
    _SKINS,
    default="MOYE",
    en="side of a shell: that of the normal, the middle (default) or the other",
)


def _equivalent(
    call: Call,
    model: Model,
    fields: tuple[CellField, ...],
    side: str,
    compute: Callable[[FloatArray], FloatArray],
    what: str,
) -> CellField:
    field, material = state_and_rest(fields)

    def make(zone: Zone) -> CellFieldBlock:
        plain = is_solid(zone) or skin.is_thick_shell(zone)
        if plain or (is_thin_shell(zone) and (what != "VMIS" or material is None)):
            T, support = _tensor(zone, field, material, side)
            return zone.block({"SCAL": compute(T)}, support)
        if what == "VMIS":
            values, support = tensors.section_equivalent(zone, field, material)
            return zone.block({"SCAL": values}, support)
        raise FieldError(
            "operators.fields.continuous-elements-only", what=what, element=zone.element
        )

    return on_zones(present(call, model), "SCALAIRE", make)


def _tensor(
    zone: Zone, field: CellField, material: CellField | None, side: str
) -> tuple[FloatArray, Support]:
    """Tensors of a continuous zone, or of a shell at one side."""
    if is_solid(zone):
        return tensors.tensor(zone, field)[:2]
    if skin.is_thick_shell(zone):
        if side != "MOYE":
            raise FieldError("operators.fields.no-side-of-thick-shell", element=zone.element)
        return skin.thick_tensor(zone, field)
    if not is_thin_shell(zone) or material is None:
        raise FieldError("operators.fields.no-stress-tensor", element=zone.element)
    return skin.shell_tensor(zone, field, material, side)


@operator("VMIS", family="stress")
def vmis(call: Call, model: Model = MODEL, fields: tuple[CellField, ...] = STATE) -> CellField:
    """Equivalent stress."""
    strains = next((f for f in fields if f.title == "DEFORMATIONS"), None)
    if strains is not None:
        call.warn("operators.fields.equivalent-of-strains", strains)
    return _equivalent(call, model, fields, "MOYE", tensors.von_mises, "VMIS")


@operator("TRES", family="stress", full_name="TRESCA")
def tres(
    call: Call, model: Model = MODEL, fields: tuple[CellField, ...] = STATE, side: str = _SIDE
) -> CellField:
    """Equivalent stress."""
    return _equivalent(call, model, fields, side, tensors.tresca, "TRES")


@operator("PRIN", family="stress", full_name="PRINCIPALE")
def prin(
    call: Call,
    model: Model = MODEL,
    fields: tuple[CellField, ...] = STATE,
    ordered: bool = Flag("TRID", en="the values decrease in the plane too"),
    side: str = _SIDE,
) -> CellField:
    """Principal values and directions."""
    field, material = state_and_rest(fields)

    def make(zone: Zone) -> CellFieldBlock:
        if skin.is_thick_shell(zone):  # its frames turn from point to point
            raise FieldError("operators.fields.no-directions-of-thick-shell", element=zone.element)
        T, support = _tensor(zone, field, material, side)
        if is_thin_shell(zone):
            T = skin.in_global_axes(zone, T)
        values = tensors.principal(zone, T, ordered and is_solid(zone))
        return cell_block(zone, tensors.PRINCIPAL, values, support)

    return on_zones(present(call, model), "PRINCIPALE", make)


@operator("INVA", family="stress", full_name="INVARIANT")
def inva(
    call: Call, model: Model = MODEL, fields: tuple[CellField, ...] = STATE, side: str = _SIDE
) -> tuple[CellField, CellField, CellField]:
    """Invariants."""
    field, material = state_and_rest(fields)
    rows: list[list[CellFieldBlock]] = [[], [], []]
    for zone in present(call, model).zones:
        T, support = _tensor(zone, field, material, side)
        for row, values in zip(rows, tensors.invariants(T), strict=True):
            row.append(zone.block({"SCAL": values}, support))
    one, two, three = (CellField(tuple(r), "SCALAIRE") for r in rows)
    return one, two, three


@operator("ENER", family="stress", full_name="ENERGIE")
def ener(
    call: Call,
    model: Model = MODEL,
    first: CellField = Arg("MCHAML", en="stresses"),
    second: CellField = Arg("MCHAML", en="strains"),
    others: tuple[CellField, ...] = Many("MCHAML", en="accepted, not used"),
) -> CellField:
    """Product of stresses and strains."""
    given = (first, second, *others)

    def make(zone: Zone) -> CellFieldBlock:
        family = families.family_of(zone)
        stress, strain = family.stress_names(zone), family.strain_names(zone)
        pair = [_holding(zone, given, names) for names in (stress, strain)]
        s, support = tensors.components_at_home(zone, pair[0], stress)
        e, other = tensors.components_at_home(zone, pair[1], strain)
        if s.shape[2] != e.shape[2] and 1 not in (s.shape[2], e.shape[2]):
            raise FieldError(
                "operators.fields.stresses-and-strains-apart", support=support, other=other
            )
        return zone.block({"SCAL": (s * e).sum(axis=1)}, support)

    return on_zones(present(call, model), "SCALAIRE", make)


def _holding(zone: Zone, fields: tuple[CellField, ...], names: tuple[str, ...]) -> CellField:
    wanted = set(names)
    for field in fields:
        if any(wanted.intersection(b.components) for b in field.blocks):
            return field
    raise FieldError("operators.fields.no-field-for-element", names=names, element=zone.element)


@operator("GRAD", family="stress", full_name="GRADIENT")
def grad(
    call: Call,
    model: Model = MODEL,
    field: NodeField = Arg("CHPOINT", en="displacements or a scalar"),
    given: tuple[CellField, ...] = Many("MCHAML", en="parameters"),
) -> CellField:
    """Gradients."""
    names = tuple(field.components)

    def make(zone: Zone) -> CellFieldBlock:
        seen = zone_field(zone, joined(given) if given else None)
        if is_joint(zone):
            return jump_gradient(zone, field, seen)
        if structural_gradients.is_structural(zone):
            values = structural_gradients.structural_gradient(zone, field, seen)
            return cell_block(zone, structural_gradients.structural_names(zone), values)
        if not is_solid(zone):
            raise FieldError("operators.fields.grad-of-solids-only", element=zone.element)
        if any(n in names for n in families.family_of(zone).layout(zone).unknowns):
            return cell_block(zone, gradient_names(zone), gradient_values(zone, field))
        if len(names) != 1:
            raise FieldError("operators.fields.grad-of-displacements-or-scalar", names=names)
        axes = "RZ" if "R" in gradient_names(zone)[0] else "XYZ"
        labels = tuple(f"{names[0].rstrip()},{a}" for a in axes[: coordinates(zone).shape[-1]])
        return cell_block(zone, labels, scalar_gradient(zone, field, names[0]))

    return on_zones(present(call, model), "GRADIENT", make)


@INTG.form(gives=by("by_cell", {True: "MCHAML"}, "FLOTTANT"))
def intg(
    call: Call,
    model: Model = Main("MMODEL", en="model"),
    by_cell: bool = Flag("ELEM", en="one value a cell"),
    component: str | None = Opt("MOT", kind="component", en="component, if there are several"),
    field: CellField = Arg("MCHAML", en="field to integrate"),
    others: tuple[CellField, ...] = Many("MCHAML", en="parameters"),
) -> float | CellField:
    """Integral of a field in cells."""
    wanted = component.rstrip() if component is not None else _only(call, field)
    material = others[0] if others else None
    parts = [integrals(z, field, wanted, material) for z in model.zones]
    if parts and all(p is None for p in parts):
        raise call.error("operators.fields.component-not-on-model", field, wanted=wanted)
    if not by_cell:
        return float(sum(p.sum() for p in parts if p is not None))
    blocks = [
        z.block({"SCAL": p[:, None]}, "GRAVITE")
        for z, p in zip(model.zones, parts, strict=True)
        if p is not None
    ]
    return CellField(tuple(blocks), "SCALAIRE")


def _only(call: Call, field: CellField) -> str:
    names = tuple(dict.fromkeys(n for b in field.blocks for n in b.components))
    if len(names) != 1:
        raise call.error("operators.fields.which-component", field, names=names)
    return names[0]


@operator("JACO", family="stress", full_name="JACOBIEN")
def jaco(model: Model = MODEL) -> CellField:
    """Jacobians."""

    def make(zone: Zone) -> CellFieldBlock:
        if is_solid(zone):
            geometry = zone_geometry(zone, "RIGIDITE", slice(0, len(zone.cells)))
            weights = support_rule(zone.element, "RIGIDITE").weights
            return zone.block({"SCAL": geometry.volumes / weights}, "RIGIDITE")
        shell = family_name(zone) in SHELLS
        if not (shell or structural_gradients.is_structural(zone)):
            raise FieldError("operators.fields.jaco-of-solids-only", element=zone.element)
        points = support_rule(zone.element, "RIGIDITE").points
        slopes = shape_gradients(zone.cells.cell_type, points)
        J = np.einsum("pki,ckd->cpid", slopes, zone.cells.coordinates)
        values = np.sqrt(np.linalg.det(J @ np.swapaxes(J, 2, 3)))
        return zone.block({"SCAL": values}, "RIGIDITE")

    return on_zones(model, "SCALAIRE", make)

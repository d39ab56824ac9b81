"""POLA PICA CAPI WORK FOFI TAGR: gradients and configurations of finite motions."""

from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.loads.loads import total
from ssilang.kernel.elements.results.structural_gradients import (
    is_structural,
    structural_forces,
    structural_names,
    structural_work,
)
from ssilang.kernel.elements.results.tensors import components_at_home
from ssilang.kernel.elements.solids import finite_motion
from ssilang.kernel.elements.solids.gradients import gradient_names
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.operators.matrices.element import joined, present
from ssilang.operators.prelude import *
from ssilang.operators.statics import stresses


def _solid(zone: Zone, name: str) -> None:
    if not is_solid(zone):
        raise FieldError(
            "operators.statics.for-continuous-elements", name=name, element=zone.element
        )


def _stands(zone: Zone, field: CellField, names: tuple[str, ...]) -> bool:
    seen = zone_field(zone, field)
    return any(n in seen for n in names)


@operator("POLA", family="stress", full_name="POLAIRE")
def pola(
    call: Call,
    model: Model = stresses.MODEL,
    fields: tuple[CellField, ...] = Many("MCHAML", at_least=1, en="gradients"),
    what: str = Choice(
        ("GEOM", "DEPL"),
        default="GEOM",
        en="what the field is: F (default), or F - 1 as GRAD gives it",
    ),
) -> tuple[CellField, CellField]:
    """Rotation and stretch."""
    gradient, by_displacement = joined(fields), what == "DEPL"
    rows: tuple[list[CellFieldBlock], list[CellFieldBlock]] = ([], [])
    for zone in present(call, model).zones:
        _solid(zone, "POLA")
        names = gradient_names(zone)
        flat, support = components_at_home(zone, gradient, names)
        for row, tensor in zip(
            rows,
            finite_motion.polar(finite_motion.transformation(zone, flat, by_displacement)),
            strict=True,
        ):
            row.append(
                cell_block(zone, names, finite_motion.gradient_components(zone, tensor), support)
            )
    turned, stretched = (CellField(tuple(r), "GRADIENT") for r in rows)
    return turned, stretched


_CARRIED = (
    stresses.MODEL,
    many("fields", "CHPOINT", "MCHAML", at_least=1, en="stresses or strains, and displacements"),
    choice(
        "frame", ("JAUM", "UTIL"), en="from or to the frame that turns with the matter; unchanged"
    ),
)


def _carried(
    call: Call, model: Model, fields: stresses.Fields, frame: str | None, forward: bool
) -> CellField:
    field, u = stresses.joined_cells(call, fields), stresses.displacement_of(call, fields, model)
    if len(stresses.nodal_of(fields)) > 1:
        raise call.error("operators.statics.no-cracks", name=call.name)
    if frame == "UTIL":
        return field

    def make(zone: Zone) -> CellFieldBlock:
        _solid(zone, call.name)
        names, values, support = finite_motion.carried(zone, field, u, forward, frame == "JAUM")
        return cell_block(zone, names, values, support)

    return stresses.on_zones(present(call, model), field.title, make)


@operator("PICA", *_CARRIED, family="stress")
def pica(call: Call, model: Model, fields: stresses.Fields, frame: str | None) -> CellField:
    """From the reference to the present configuration."""
    return _carried(call, model, fields, frame, True)


@operator("CAPI", *_CARRIED, family="stress")
def capi(call: Call, model: Model, fields: stresses.Fields, frame: str | None) -> CellField:
    """From the present to the reference configuration."""
    return _carried(call, model, fields, frame, False)


_STRESS_AND_GRADIENT = many(
    "fields", "MCHAML", at_least=1, en="stresses, gradients, and parameters"
)


@operator("WORK", family="stress")
def work_of(
    call: Call, model: Model = stresses.MODEL, fields: tuple[CellField, ...] = _STRESS_AND_GRADIENT
) -> CellField:
    """Work of stresses on gradients."""
    zones = present(call, model)
    stress, gradient = _stress_and_gradient(call, zones, fields)

    def make(zone: Zone) -> CellFieldBlock:
        if is_structural(zone):
            return cell_block(zone, ("SCAL",), structural_work(zone, stress, gradient)[:, None])
        _solid(zone, "WORK")
        values, support = finite_motion.work(zone, stress, gradient)
        return zone.block({"SCAL": values}, support)

    return stresses.on_zones(zones, "SCALAIRE", make)


def _stress_and_gradient(
    call: Call, model: Model, fields: tuple[CellField, ...]
) -> tuple[CellField, CellField]:
    if len(fields) < 2:
        raise call.missing(("MCHAML",))
    names = {z: gradient_names(z) for z in model.zones if is_solid(z)}
    names |= {z: structural_names(z) for z in model.zones if is_structural(z)}
    gradient = next((f for f in fields if any(_stands(z, f, n) for z, n in names.items())), None)
    if gradient is None:
        raise call.error("operators.statics.no-gradients")
    stress = next(f for f in fields if f is not gradient)
    return stress, gradient


@operator("FOFI", family="stress", full_name="FOFISS")
def fofi(
    call: Call, model: Model = stresses.MODEL, fields: tuple[CellField, ...] = _STRESS_AND_GRADIENT
) -> NodeField:
    """Forces of stresses on gradients."""
    zones = present(call, model)
    stress, gradient = _stress_and_gradient(call, zones, fields)
    rest = tuple(f for f in fields if f is not stress and f is not gradient)
    forces = []
    for zone in zones.zones:
        parameters = zone_field(zone, joined(rest) if rest else None)
        if is_structural(zone):
            forces.append(structural_forces(zone, stress, gradient, parameters))
            continue
        _solid(zone, "FOFI")
        forces.append(finite_motion.gradient_forces(zone, stress, gradient, parameters))
    return total(forces[0].table, forces)


@operator("TAGR", family="stress")
def tagr(call: Call, gradient: CellField = Arg("MCHAML", en="gradients")) -> CellField:
    """Transpose gradients."""
    blocks = []
    for block in gradient.blocks:
        names = {n: f"U{n[3]},{n[1]}" for n in block.components if len(n) == 4 and n[2] == ","}
        if not names or any(n not in block.components for n in names.values()):
            raise call.error(
                "operators.statics.not-gradients", gradient, components=block.components
            )
        made = {n: block.components[names.get(n, n)] for n in block.components}
        blocks.append(replace(block, components=made))
    return CellField(tuple(blocks), gradient.title)

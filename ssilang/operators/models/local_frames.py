"""Frames of elements: RTEN VLOC CALP, FREN along lines, VSUR for normals and tangents."""

from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import BEAMS, SHELLS, family_name, support_rule
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.results.frames import (
    SurfaceAxes,
    cylindrical_frames,
    fixed_frame,
    given_rotations,
    is_flat_shell,
    is_thin_shell,
    material_frames,
    points_of,
    polar_frames,
    seen_in,
    shell_in_axes,
    spherical_frames,
    strains_or_stresses,
    torus_frames,
)
from ssilang.kernel.elements.results.skin import SIDES, shell_skin, skin_stress
from ssilang.kernel.elements.results.tensors import tensor
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.mesh.lines.lines import frenet_frames
from ssilang.operators.fields.turning import turned_node_field
from ssilang.operators.matrices.element import joined, present
from ssilang.operators.prelude import *
from ssilang.operators.statics.stresses import on_zones, state_and_rest

Frames = Callable[[Zone, Support], FloatArray]
Surface = Callable[[Zone, Support], SurfaceAxes]


_CENTRE = arg("centre", "POINT", en="centre")
_ON_AXIS = arg("on_axis", "POINT", en="point of the axis")
_SECOND = opt("second", "POINT", en="vector of the plane of the first two axes, in space")


@operator("RTEN", family="stress", full_name="RTENS")
def rten(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    field: CellField = Arg("MCHAML", en="stresses or strains"),
    material: CellField | None = Opt("MCHAML", en="parameters with axes"),
    frame: Chosen | None = Cases(
        {
            "POLA": [_CENTRE],
            "CYLI": [_CENTRE, _ON_AXIS],
            "SPHE": [_CENTRE, _ON_AXIS],
            "TORI": [
                choice(
                    "section",
                    ("CART", "CIRC"),
                    default="CART",
                    en="straight axes in each half plane of the axis (default), or those of its "
                    "small circle",
                ),
                _CENTRE,
                _ON_AXIS,
                opt("on_circle", "POINT", en="centre of a small circle (CIRC)"),
            ],
        },
        en="polar, cylindrical or spherical coordinates, or those of a torus",
    ),
    product: str = Choice(
        ("RTAR", "RART"), default="RTAR", en="of matrices of rotation R: Rt A R (default) or R A Rt"
    ),
    first: Point | None = Opt("POINT", en="first axis"),
    second: Point | None = _SECOND,
) -> CellField:
    """Stresses or strains in another frame."""
    if frame is not None:
        frames = _round(call, frame)
        surface = _round_surface(frame, frames)
    elif first is not None:
        frames, surface = _fixed_axes(first, second)
    elif material is None:
        raise call.missing(("POINT",))
    else:
        frames, surface = _of_material(material, product)

    def make(zone: Zone) -> CellFieldBlock:
        thick = family_name(zone) == "thick" and material is not None
        if surface is not None and (thick or is_flat_shell(zone)):
            axes = surface(zone, strains_or_stresses(zone, field)[2])
            return shell_in_axes(zone, field, axes, material)
        if not is_solid(zone):
            raise FieldError("operators.models.rten-of-solids-only", element=zone.element)
        support = tensor(zone, field)[1]
        return seen_in(zone, field, frames(zone, support))

    return on_zones(model, field.title, make)


@rten.form()
def rten_of_vectors(
    field: NodeField = Arg("CHPOINT", en="vectors"),
    first: Point = Arg("POINT", en="first axis"),
    second: Point | None = _SECOND,
) -> NodeField:
    """Vectors in another frame."""
    return turned_node_field(field, _fixed(first, second))


def _fixed(first: Point, second: Point | None) -> FloatArray:
    return fixed_frame(first.coordinates, None if second is None else second.coordinates)


def _fixed_axes(first: Point, second: Point | None) -> tuple[Frames, Surface]:
    along, rotation = first.coordinates, _fixed(first, second)
    normal = None if second is None else np.cross(along, second.coordinates)
    return lambda zone, at: rotation, lambda zone, at: SurfaceAxes(along, normal=normal)


def _of_material(material: CellField, product: str) -> tuple[Frames, Surface | None]:
    """The frames that parameters hold: axes of orthotropy, or rotations, which no shell has."""
    if any("UX,X" in b.components for b in material.blocks):
        turned = product == "RTAR"
        return lambda zone, at: given_rotations(zone, material, at, turned), None

    def frames(zone: Zone, support: Support) -> FloatArray:
        return material_frames(zone, material, support)

    return frames, lambda zone, at: SurfaceAxes(frames(zone, at)[..., 0, :])


def _round_surface(frame: Chosen, frames: Frames) -> Surface | None:
    """Around the axis first, then to the side of the axis, or inwards where that is normal."""
    if frame.word == "POLA":
        return None
    axis = frame["on_axis"].coordinates - frame["centre"].coordinates
    around = 0 if frame.word == "TORI" and frame["section"] == "CIRC" else 1

    def axes(zone: Zone, support: Support) -> SurfaceAxes:
        rows = frames(zone, support)
        inwards = -rows[..., 2 if around == 0 else 0, :]
        return SurfaceAxes(rows[..., around, :], axis, inwards)

    return axes


def _round(call: Call, frame: Chosen) -> Frames:
    centre = frame["centre"].coordinates
    if frame.word == "POLA":
        return lambda zone, support: polar_frames(points_of(zone, support), centre)
    on_axis = frame["on_axis"].coordinates
    if frame.word == "TORI" and frame["section"] == "CIRC":
        if frame["on_circle"] is None:
            raise call.missing(("POINT",))
        circle = frame["on_circle"].coordinates
        return lambda zone, at: torus_frames(points_of(zone, at), centre, on_axis, circle)
    build = spherical_frames if frame.word == "SPHE" else cylindrical_frames
    return lambda zone, support: build(points_of(zone, support), centre, on_axis)


@operator("VLOC", family="model")
def vloc(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    fields: tuple[CellField, ...] = Many("MCHAML", at_least=1, en="parameters"),
) -> CellField:
    """Axes of orthotropy."""
    material = joined(fields)

    def make(zone: Zone) -> CellFieldBlock:
        axes = material_frames(zone, material, "RIGIDITE")
        full = np.broadcast_to(axes, (len(zone.cells), n_points(zone.element, "RIGIDITE"), 3, 3))
        space = zone.mode is Mode.THREE_DIMENSIONAL or is_thin_shell(zone)
        letters = "RZT" if zone.mode in (Mode.AXISYMMETRIC, Mode.FOURIER) else "XYZ"
        kept = 3 if space else 2
        names = tuple(f"V{i + 1}{letters[k]}" for i in range(kept) for k in range(kept))
        values = np.stack([full[..., i, k] for i in range(kept) for k in range(kept)], axis=1)
        return cell_block(zone, names, values, "RIGIDITE")

    return on_zones(present(call, model), "VECTEUR LOCAUX", make)


@operator("CALP", family="stress")
def calp(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    fields: tuple[CellField, ...] = Many(
        "MCHAML", at_least=1, en="stresses or strains, and parameters"
    ),
    side: str = Choice(
        tuple(SIDES),
        default="MOYE",
        en="side of a shell: that of the normal, the middle (default) or the other",
    ),
) -> CellField:
    """Skin stress of beams."""
    field, material = state_and_rest(fields)
    if material is None:
        raise call.missing(("MCHAML",))

    def make(zone: Zone) -> CellFieldBlock:
        if not is_thin_shell(zone):
            return skin_stress(zone, field, material)
        parts, support = shell_skin(zone, field, material, side)
        return zone.block(parts, support)

    return on_zones(present(call, model), field.title, make)


@operator("FREN", family="mesh", full_name="FRENET")
def fren(session: Session, line: Mesh = Arg("MAILLAGE", en="lines")) -> NodeField:
    """Frenet frame."""
    ids, frames = frenet_frames(line)
    dimension = workspace(session).dimension
    if dimension < 3:
        t = frames[:, 0]
        values = {"TX": t[:, 0], "TY": t[:, 1], "NX": -t[:, 1], "NY": t[:, 0]}
    else:
        values = {
            f"{row}{axis}": frames[:, k, j]
            for k, row in enumerate("TNB")
            for j, axis in enumerate("XYZ")
        }
    return NodeField.of(line.nodes, ids, values, "DIFFUS")


@operator("VSUR", family="models")
def vsur(
    model: Model = Arg("MMODEL", en="model"), unit: bool = Flag("NORM", en="of length 1")
) -> CellField:
    """Vectors of shells and beams."""
    blocks = [b for z in model.zones if (b := _block(z, unit)) is not None]
    return CellField(tuple(blocks), "NORMALES" if unit else "VECTEURS SURFACE")


def _block(zone: Zone, unit: bool) -> CellFieldBlock | None:
    family = family_name(zone)
    if family not in (*SHELLS, *BEAMS):
        return None
    vectors = _vectors(zone, family in SHELLS)
    if unit:
        vectors = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    if zone.mode is Mode.THREE_DIMENSIONAL:
        names: tuple[str, ...] = ("VX", "VY", "VZ")
    else:
        round_axis = zone.mode in (Mode.AXISYMMETRIC, Mode.FOURIER)
        names = ("VR", "VZ") if round_axis else ("VX", "VY")
    components = {name: vectors[..., i].copy() for i, name in enumerate(names)}
    return zone.block(components, "RIGIDITE")


def _vectors(zone: Zone, normal: bool) -> FloatArray:
    """Vectors (n_cells, n_points, 3) of the length of the Jacobian."""
    points = support_rule(zone.element, "RIGIDITE").points
    gradients = shape_gradients(zone.cells.cell_type, points)
    tangents = np.einsum("pki,ckd->cpid", gradients, zone.cells.coordinates)
    if not normal:
        return np.asarray(tangents[:, :, 0])
    if tangents.shape[2] == 1:  # a meridian: a quarter turn from the line
        t = tangents[:, :, 0]
        return np.stack([-t[..., 1], t[..., 0], 0.0 * t[..., 0]], axis=-1)
    return np.asarray(np.cross(tangents[:, :, 0], tangents[:, :, 1]))

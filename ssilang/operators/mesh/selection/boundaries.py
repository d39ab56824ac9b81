"""Boundaries of meshes: CONT ENVE ARET, and the sides kept from their making: COTE FACE."""

from ssilang.kernel.mesh import boundary, orientation
from ssilang.kernel.mesh.combine import gathered
from ssilang.operators.prelude import *


@operator("CONT", family="mesh", full_name="CONTOUR")
def cont(
    mesh: Mesh = Arg("MAILLAGE", en="surface"),
    which: str = Choice(
        ("EXTE", "INTE", "TOUT"), default="EXTE", en="edges of one cell, of three or more, or both"
    ),
    allowed: bool = Flag("NOID", en="the result may be empty"),
) -> Mesh:
    """Contour of a surface."""
    parts: list[Mesh] = []
    if which in ("EXTE", "TOUT"):
        parts.append(boundary.contour(mesh))
    if which in ("INTE", "TOUT"):
        parts.append(boundary.inner_contour(mesh))
    return not_empty(gathered(parts), allowed, "operators.mesh.no-contour")


def not_empty(found: Mesh, allowed: bool, code: str) -> Mesh:
    """The cells that were found; none are refused, unless that is allowed."""
    if not found.blocks and not allowed:
        raise MeshError(code)
    return found


@operator("ENVE", family="mesh", full_name="ENVELOPPE")
def enve(
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="volume, or surface"),
    inwards: bool = Flag("ORIE", en="faces described inwards in any case"),
    allowed: bool = Flag("NOID", en="the result may be empty"),
) -> Mesh:
    """Skin of a volume."""
    if mesh.blocks and mesh.dimension < 2:
        call.warn("operators.mesh.no-volume", mesh)
    if mesh.dimension < 3:
        skin = boundary.lone_cells(mesh, mesh.dimension)
    else:
        faces = boundary.envelope(orientation.orient(mesh, 3) if inwards else mesh)
        skin = Mesh(faces.nodes, tuple(orientation.flip(b) for b in faces.blocks))
    return not_empty(skin, allowed, "operators.mesh.no-envelope")


@operator("ARET", family="mesh", full_name="ARETE")
def aret(
    mesh: Mesh = Arg("MAILLAGE", en="surface or volume"),
    angle: float = Opt(
        "FLOTTANT",
        range=between(0.0, 180.0),
        default=20.0,
        en="turn of the skin from which on an edge is sharp",
        unit="deg",
    ),
) -> Mesh:
    """Sharp edges."""
    return boundary.sharp_edges(mesh, angle)


@operator("COTE", family="mesh")
def cote(
    call: Call,
    number: int = Arg("ENTIER", en="1 initial, 2 right, 3 final, 4 left", range=POSITIVE),
    mesh: Mesh = Arg("MAILLAGE", en="surface"),
) -> Mesh:
    """Give back a side."""
    return _one(call, number, all_sides(call, mesh), "operators.mesh.no-such-side")


@cote.form(gives=ANY)
def all_sides(call: Call, mesh: Mesh = Arg("MAILLAGE", en="surface")) -> tuple[Mesh, ...]:
    """Give back all sides."""
    if not mesh.sides:
        raise call.error("operators.mesh.no-sides", mesh)
    return mesh.sides


@operator("FACE", family="mesh")
def face(
    call: Call,
    number: int = Arg("ENTIER", en="1 start, 2 end, 3 around", range=POSITIVE),
    mesh: Mesh = Arg("MAILLAGE", en="volume"),
) -> Mesh:
    """Give back a face."""
    return _one(call, number, all_faces(call, mesh), "operators.mesh.no-such-face")


@face.form(gives=ANY)
def all_faces(call: Call, mesh: Mesh = Arg("MAILLAGE", en="volume")) -> tuple[Mesh, ...]:
    """Give back all faces."""
    if not mesh.sides:
        raise call.error("operators.mesh.no-faces", mesh)
    return mesh.sides


def _one(call: Call, number: int, kept: tuple[Mesh, ...], lacking: str) -> Mesh:
    if not 1 <= number <= len(kept):
        raise call.error(lacking, number, number=number, count=len(kept))
    return kept[number - 1]

"""Sides of surfaces and faces of volumes that meshes keep from their making: COTE FACE."""

from __future__ import annotations

from ssilang.operators.prelude import *


@operator(
    "COTE",
    arg("number", "ENTIER", en="1 initial, 2 right, 3 final, 4 left", range=POSITIVE),
    arg("mesh", "MAILLAGE", en="surface"),
    family="mesh",
)
def cote(call: Call, number: int, mesh: Mesh) -> Mesh:
    """Give back a side."""
    kept = _sides(call, mesh)
    if not 1 <= number <= len(kept):
        raise call.error("operators.mesh.no-such-side", number, number=number, count=len(kept))
    return kept[number - 1]


@cote.form(arg("mesh", "MAILLAGE", en="surface"), gives=ANY)
def all_sides(call: Call, mesh: Mesh) -> tuple[Mesh, ...]:
    """Give back all sides."""
    return _sides(call, mesh)


def _sides(call: Call, mesh: Mesh) -> tuple[Mesh, ...]:
    if not mesh.sides:
        raise call.error("operators.mesh.no-sides", mesh)
    return mesh.sides


@operator(
    "FACE",
    arg("number", "ENTIER", en="1 start, 2 end, 3 around", range=POSITIVE),
    arg("mesh", "MAILLAGE", en="volume"),
    family="mesh",
)
def face(call: Call, number: int, mesh: Mesh) -> Mesh:
    """Give back a face."""
    kept = _faces(call, mesh)
    if not 1 <= number <= len(kept):
        raise call.error("operators.mesh.no-such-face", number, number=number, count=len(kept))
    return kept[number - 1]


@face.form(arg("mesh", "MAILLAGE", en="volume"), gives=ANY)
def all_faces(call: Call, mesh: Mesh) -> tuple[Mesh, ...]:
    """Give back all faces."""
    return _faces(call, mesh)


def _faces(call: Call, mesh: Mesh) -> tuple[Mesh, ...]:
    if not mesh.sides:
        raise call.error("operators.mesh.no-faces", mesh)
    return mesh.sides

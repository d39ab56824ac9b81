"""Gradients of the displacements of beams and flat shells along their line or surface, in their
own frame, and what stresses do on them.

Translations are linear along a beam and as the shapes of the cell in a shell. Components are those
of the element's own frame, like its stresses': UX,X UY,X (UZ,X) of lines, UX,X UX,Y ... UZ,Y of
shells. Of the stresses the forces that lie along the line or surface work on them (EFFX; N11 N22
N12).
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import FLAT_SHELLS, LINES, family_name, support_rule
from ssilang.kernel.elements.families import components_of, family_of
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.shells.flat_shell import flat_frames, surface_slopes
from ssilang.kernel.elements.solids.gradients import gradient_names
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone

_SHELL_FORCES = np.array([[0, 2], [2, 1]])
"""Place of N11 N12, N12 N22 among N11 N22 N12."""


def is_structural(zone: Zone) -> bool:
    """Whether a zone has gradients here: beams, bars of two nodes, flat shells."""
    family = family_name(zone)
    return family in FLAT_SHELLS or (family in LINES and zone.cells.cell_type == "SEG2")


def structural_names(zone: Zone) -> tuple[str, ...]:
    """Components of the gradient."""
    moves = ("UX", "UY", "UZ")[: zone.mode.dimension]
    axes = "XY" if family_name(zone) in FLAT_SHELLS else "X"
    return tuple(f"{u},{a}" for u in moves for a in axes)


def names_of_gradient(zone: Zone) -> tuple[str, ...]:
    """Components of the gradient of displacements of solids, beams and flat shells, else none."""
    if is_structural(zone):
        return structural_names(zone)
    return gradient_names(zone) if is_solid(zone) else ()


@dataclass(frozen=True, eq=False)
class _Surface:
    """Own frames (n, d, d), derivatives of shapes (n, p, axes, k), weights (n, p)."""

    frames: FloatArray
    derivatives: FloatArray
    weights: FloatArray


def _surface(zone: Zone, parameters: ZoneField) -> _Surface:
    rule = support_rule(zone.element, "STRESSES")
    family = family_name(zone)
    if family in LINES:
        frame = beam_frame(zone, parameters)
        d = zone.mode.dimension
        pair = np.array([-1.0, 1.0]) / frame.lengths[:, None]
        derivatives = np.repeat(pair[:, None, None], len(rule), axis=1)
        shares = rule.weights / rule.weights.sum()
        return _Surface(frame.axes[:, :d, :d], derivatives, frame.lengths[:, None] * shares)
    frames, local = flat_frames(zone)
    return _Surface(frames, *surface_slopes(zone, local, rule))


def _translations(zone: Zone) -> tuple[Layout, list[int]]:
    """Rows of the element's vectors and which of them are translations, node by node."""
    layout = family_of(zone).layout(zone)
    return layout, [i for i, name in enumerate(layout.unknowns) if name[0] == "U"]


def structural_gradient(zone: Zone, displacement: NodeField, parameters: ZoneField) -> FloatArray:
    """Gradients (n_cells, n_components, n_points) at the points of 'STRESSES'."""
    surface = _surface(zone, parameters)
    layout, moves = _translations(zone)
    n, d = len(zone.cells), zone.mode.dimension
    u = layout.gather(displacement)[:, moves].reshape(n, -1, d)
    own = np.einsum("cij,ckj->cki", surface.frames, u)
    H = np.einsum("cpak,cki->ciap", surface.derivatives, own)
    return np.ascontiguousarray(H.reshape(n, -1, H.shape[-1]))


def _forces(zone: Zone, stress: CellField) -> FloatArray:
    """Forces (n_cells, axes, axes, n_points) along the line or surface."""
    names = ("N11", "N22", "N12") if family_name(zone) in FLAT_SHELLS else ("EFFX",)
    N = components_of(zone, stress, names)
    return N[:, _SHELL_FORCES] if len(names) == 3 else N[:, None]


def _tensor(zone: Zone, gradient: CellField) -> FloatArray:
    """Gradients (n_cells, moves, axes, n_points)."""
    flat = zone_field(zone, gradient).matrix(structural_names(zone), "STRESSES")
    return flat.reshape(len(flat), zone.mode.dimension, -1, flat.shape[-1])


def structural_work(zone: Zone, stress: CellField, gradient: CellField) -> FloatArray:
    """Sum of N_ij u_i,j (n_cells, n_points): a work per length or surface."""
    N, H = _forces(zone, stress), _tensor(zone, gradient)
    return np.einsum("cijp,cijp->cp", N, H[:, : N.shape[1]])


def structural_forces(
    zone: Zone, stress: CellField, gradient: CellField, parameters: ZoneField
) -> NodeField:
    """Nodal forces whose work in v is the integral of N_ij u_k,i v_k,j."""
    surface = _surface(zone, parameters)
    N, H = _forces(zone, stress), _tensor(zone, gradient)
    local = np.einsum(
        "cp,cijp,ckip,cpjn->cnk", surface.weights, N, H, surface.derivatives, optimize=True
    )
    layout, moves = _translations(zone)
    vectors = np.zeros((len(zone.cells), len(layout.unknowns)))
    vectors[:, moves] = np.einsum("cij,cni->cnj", surface.frames, local).reshape(len(local), -1)
    return layout.scatter(vectors)

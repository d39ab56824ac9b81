"""Surfaces swept by lines: TRAN, ROTA, REGL, GENE."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.generators.sweep import (
    Path,
    layer_cuts,
    mean_density,
    rotation,
    ruling,
    sweep_line,
    translation,
)
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.lines.subdivision import Subdivision
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.orientation import reversed_line
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.mesh.ends import (
    Cuts,
    chosen_family,
    count_and_number,
    read_count,
    read_sizes,
)
from ssilang.operators.workspace import workspace

_LAYERS_EN = (
    "N1 > 0: that many equal layers; N1 < 0: that many, graded by the mesh sizes; without N1 the "
    "sizes decide; DINI and DFIN replace them. If the first mesh is a surface its side 3 is swept "
    "and the result is the surface grown by the new cells. COTE gives the sides."
)
_LAYERS_FR = (
    "N1 > 0 : N1 couches égales ; N1 < 0 : N1 couches gradées selon les densités ; sans N1 les "
    "densités décident ; DINI et DFIN les remplacent. Si le premier maillage est une surface, son "
    "côté 3 est balayé et le résultat est la surface augmentée. COTE rend les côtés."
)


def line_to_sweep(mesh: Mesh) -> Mesh:
    """The mesh itself if it is a line, else its side 3 in the sense of its side 1."""
    if mesh.dimension < 2:
        return mesh
    if len(mesh.sides) < 3:
        raise MeshError(
            "this surface has no side 3 to sweep", "sweep a line, or a surface made by sweeping"
        )
    return reversed_line(mesh.sides[2])


def grown(first: Mesh, new: Mesh) -> Mesh:
    """The surface `first` continued by `new` from its side 3; `new` alone if it is a line."""
    if first.dimension < 2:
        return new
    made = union(first, new, as_given=True)
    old = first.sides
    if len(old) < 4:
        return made
    right = union(old[1], new.sides[1], as_given=True)
    left = union(new.sides[3], old[3], as_given=True)
    return Mesh(made.nodes, made.blocks, (old[0], right, new.sides[2], left))


def _swept(
    call: Call, mesh: Mesh, path_of: Callable[[Mesh], Path], end_size: float, cuts: Cuts
) -> Mesh:
    line = line_to_sweep(mesh)
    path = path_of(line)
    layers = layer_cuts(line, path, end_size, cuts.count, (cuts.first, cuts.last))
    surface = chosen_family(workspace(call.session)).need_surface()
    return grown(mesh, sweep_line(line, path, layers, surface))


@operator(
    "TRAN",
    family="mesh",
    full_name="TRANSLATION",
    help=Help(
        en="Surface swept by a line moved along a vector. " + _LAYERS_EN,
        fr="Surface engendrée par translation d'une ligne selon un vecteur. " + _LAYERS_FR,
        syntax="SURF1 = LIG1 TRAN (N1) ('DINI' DENS1) ('DFIN' DENS2) VEC1 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 4 (0. 0.) (1. 0.) ; S = L TRAN 3 (0. 1.) ;"
            " LIST (NBEL S) ;",
        ),
    ),
    reads_itself=True,
)
def tran(call: Call) -> Mesh:
    """Sweep a line along a vector."""
    cuts = Cuts()
    mesh = call.required("MAILLAGE")
    read_count(call, cuts)
    read_sizes(call, cuts)
    if not cuts.count:
        read_count(call, cuts)
    vector: Point = call.required("POINT")
    if not cuts.count:
        read_count(call, cuts)
    read_sizes(call, cuts)
    shift = vector.coordinates.copy()
    return _swept(call, mesh, lambda line: translation(shift), vector.density, cuts)


@operator(
    "ROTA",
    family="mesh",
    full_name="ROTATION",
    help=Help(
        en="Surface swept by a line turned by an angle in degrees about a point (2D) or an axis "
        "(3D). " + _LAYERS_EN,
        fr="Surface engendrée par rotation d'une ligne d'un angle en degrés autour d'un point (2D) "
        "ou d'un axe (3D). " + _LAYERS_FR,
        syntax="SURF1 = LIG1 ROTA (N1) FLOT1 ('DINI' DENS1) ('DFIN' DENS2) POIN1 (POIN2) ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (1. 0.) (2. 0.) ; S = L ROTA 8 90. (0. 0.) ;",
        ),
    ),
    reads_itself=True,
)
def rota(call: Call) -> Mesh:
    """Sweep a line about a centre or an axis."""
    cuts = Cuts()
    mesh = call.required("MAILLAGE")
    read_sizes(call, cuts)
    cuts.count, angle = count_and_number(call)
    if angle is None:
        raise call.missing(("FLOTTANT",))
    turn, size = read_rotation(call, angle, cuts)
    return _swept(call, mesh, turn, size, cuts)


def read_rotation(call: Call, angle: float, cuts: Cuts) -> tuple[Callable[[Mesh], Path], float]:
    """Consume the centre or the axis; the rotation and the mesh size at its end."""
    read_sizes(call, cuts)
    centre: Point = call.required("POINT")
    origin = centre.coordinates.copy()
    axis = np.array([0.0, 0.0, 1.0])
    size = centre.density
    if workspace(call.session).dimension == 3:
        second: Point = call.required("POINT")
        axis = second.coordinates - origin
        size = 0.5 * (size + second.density)
    read_sizes(call, cuts)
    return (lambda mesh: rotation(mesh, angle, origin, axis)), size


@operator(
    "REGL",
    family="mesh",
    full_name="REGLER",
    help=Help(
        en="Ruled surface between two lines with the same cells, described in the same sense. "
        + _LAYERS_EN
        + " If the second is a surface its side 1 is reached.",
        fr="Surface réglée entre deux lignes de même découpage, décrites dans le même sens. "
        + _LAYERS_FR
        + " Si le second est une surface, son côté 1 est atteint.",
        syntax="SURF1 = LIG1 REGL (N1) ('DINI' DENS1) ('DFIN' DENS2) LIG2 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 4 (0. 0.) (1. 0.) ; M = DROI 4 (0. 1.) (2. 1.) ;"
            " S = L REGL 3 M ;",
        ),
    ),
    reads_itself=True,
)
def regl(call: Call) -> Mesh:
    """Sweep a line to another one."""
    cuts = Cuts()
    first = call.required("MAILLAGE")
    read_count(call, cuts)
    read_sizes(call, cuts)
    second = call.required("MAILLAGE")
    if not cuts.count:
        read_count(call, cuts)
    read_sizes(call, cuts)
    goal = second
    if second.dimension > 1:
        if not second.sides:
            raise call.bad("this surface has no side 1 to reach", second)
        goal = second.sides[0]
    made = _swept(call, first, lambda line: ruling(line, goal), mean_density(goal), cuts)
    if goal is second:
        return made
    whole = union(made, second, as_given=True)
    if len(second.sides) < 4:
        return whole
    right = union(made.sides[1], second.sides[1], as_given=True)
    left = union(second.sides[3], made.sides[3], as_given=True)
    return Mesh(whole.nodes, whole.blocks, (made.sides[0], right, second.sides[2], left))


def generator_path(generator: Mesh) -> tuple[Path, Subdivision]:
    """The motion along a line, layer by layer at its cells."""
    block = generator.single_block()
    chain = generator.nodes.coordinates[line_chain(generator)].copy()
    offsets: FloatArray = chain - chain[0]
    place = np.linspace(0.0, 1.0, len(chain))
    n = len(block)

    def motion(x: FloatArray, s: float) -> FloatArray:
        shift = [[float(np.interp(s, place, offsets[:, k])) for k in range(3)]]
        moved: FloatArray = x + np.array(shift)
        return moved

    length = float(np.linalg.norm(np.diff(chain, axis=0), axis=1).sum())
    sizes = generator.nodes.density[[block.connectivity[0, 0], block.connectivity[-1, -1]]]
    fractions = np.linspace(0.0, 1.0, n + 1)
    return Path(motion, length), Subdivision(fractions, float(sizes[0]), float(sizes[1]))


@operator(
    "GENE",
    family="mesh",
    full_name="GENERATRICE",
    help=Help(
        en="Surface swept by a line moved parallel to itself along another line, one layer for "
        "each of its cells.",
        fr="Surface engendrée par une ligne déplacée parallèlement à elle-même le long d'une autre "
        "ligne, une couche par élément de celle-ci.",
        syntax="SURF1 = LIG1 GENE LIG2 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 4 (0. 0.) (1. 0.) ;"
            " M = QUEL SEG2 (0. 0.) (0. 1.) (1. 2.) ; S = L GENE M ;",
        ),
    ),
    reads_itself=True,
)
def gene(call: Call) -> Mesh:
    """Sweep a line along another line."""
    line = call.required("MAILLAGE")
    path, layers = generator_path(call.required("MAILLAGE"))
    surface = chosen_family(workspace(call.session)).need_surface()
    return sweep_line(line, path, layers, surface)

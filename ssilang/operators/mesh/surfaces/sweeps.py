"""Surfaces swept by lines: TRAN, ROTA, REGL, GENE."""

from ssilang.kernel.mesh.combine import side_by_side
from ssilang.kernel.mesh.generators import sweep
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.lines.subdivision import Subdivision, subdivide
from ssilang.kernel.mesh.orientation import reversed_line
from ssilang.language.vocabulary.terms import CELLS_ALONG
from ssilang.operators.mesh.lines.ends import *
from ssilang.operators.prelude import *

LAYERS = opt(
    "count",
    "ENTIER",
    en="number of layers, graded by the mesh sizes if negative; without it these decide",
    range=CELLS_ALONG,
)
_SWEPT = arg("swept", "MAILLAGE", en="line, or surface whose side 3 is swept")


def line_to_sweep(mesh: Mesh) -> Mesh:
    """The mesh itself if it is a line, else its side 3 in the sense of its side 1."""
    if mesh.dimension < 2:
        return mesh
    if len(mesh.sides) < 3:
        raise MeshError("operators.mesh.no-side-to-sweep")
    return reversed_line(mesh.sides[2])


def grown(first: Mesh, new: Mesh) -> Mesh:
    """The surface `first` continued by `new` from its side 3; `new` alone if it is a line."""
    return side_by_side(first, new, as_given=True) if first.dimension > 1 else new


def _along(call: Call, line: Mesh, path: sweep.Path, layers: Subdivision) -> Mesh:
    """The surface that a line sweeps; flat cells are told."""
    surface = chosen_family(workspace(call.session)).need_surface()
    made = sweep.sweep_line(line, path, layers, surface)
    warn_of_flat_cells(call, made)
    return made


def _swept(
    call: Call, mesh: Mesh, path_of: Callable[[Mesh], sweep.Path], end_size: float, cuts: Cuts
) -> Mesh:
    line = line_to_sweep(mesh)
    path = path_of(line)
    sizes = cuts.sizes((sweep.mean_density(line), end_size))
    layers = subdivide(path.length, *sizes, cuts.count)
    return grown(mesh, _along(call, line, path, layers))


@operator("TRAN", family="mesh", full_name="TRANSLATION")
def tran(
    call: Call,
    swept: Mesh = _SWEPT,
    count: int | None = LAYERS,
    sizes: Sizes = SIZES,
    vector: Point = Arg("POINT", en="vector", unit="m", usual=NOT_ZERO),
) -> Mesh:
    """Sweep a line along a vector."""
    shift = vector.coordinates.copy()
    cuts = cuts_of(count, sizes)
    return _swept(call, swept, lambda line: sweep.translation(shift), vector.density, cuts)


@operator("ROTA", family="mesh", full_name="ROTATION")
def rota(
    call: Call,
    swept: Mesh = _SWEPT,
    count: int | None = LAYERS,
    angle: float | None = ANGLE,
    sizes: Sizes = SIZES,
    axis: Sequence[Point] = AXIS,
) -> Mesh:
    """Sweep a line about a centre or an axis."""
    count, degrees = count_and_angle(call, count, angle)
    turn, size = turning(call, degrees, axis)
    return _swept(call, swept, turn, size, cuts_of(count, sizes))


def turning(
    call: Call, degrees: float, axis: Sequence[Point]
) -> tuple[Callable[[Mesh], sweep.Path], float]:
    """The rotation about what `AXIS` has read, and the mesh size at its end."""
    origin, direction = axis_of(call, axis)
    size = sum(p.density for p in axis) / len(axis)
    return (lambda mesh: sweep.rotation(mesh, degrees, origin, direction)), size


@operator("REGL", family="mesh", full_name="REGLER")
def regl(
    call: Call,
    swept: Mesh = _SWEPT,
    count: int | None = LAYERS,
    sizes: Sizes = SIZES,
    goal: Mesh = Arg("MAILLAGE", en="line to reach, or surface whose side 1 is reached"),
) -> Mesh:
    """Sweep a line to another one."""
    reached = goal
    if goal.dimension > 1:
        if not goal.sides:
            raise call.error("operators.mesh.no-side-to-reach", goal)
        reached = goal.sides[0]
    cuts = cuts_of(count, sizes)
    made = _swept(
        call, swept, lambda line: sweep.ruling(line, reached), sweep.mean_density(reached), cuts
    )
    return made if reached is goal else grown(made, goal)


def generator_path(generator: Mesh) -> tuple[sweep.Path, Subdivision]:
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
    return sweep.Path(motion, length), Subdivision(fractions, float(sizes[0]), float(sizes[1]))


@operator("GENE", family="mesh", full_name="GENERATRICE")
def gene(
    call: Call,
    line: Mesh = Arg("MAILLAGE", en="line that is swept"),
    way: Mesh = Arg("MAILLAGE", en="line along which it goes"),
) -> Mesh:
    """Sweep a line along another line."""
    path, layers = generator_path(way)
    return _along(call, line, path, layers)

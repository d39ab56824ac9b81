"""Volumes: VOLU by translation, rotation, along a line, between two surfaces, by thickness."""

from ssilang.kernel.mesh.combine import side_by_side
from ssilang.kernel.mesh.generators import sweep
from ssilang.kernel.mesh.lines.subdivision import Subdivision, subdivide
from ssilang.kernel.mesh.orientation import surface_normals
from ssilang.kernel.mesh.volumes.block import fill_block
from ssilang.kernel.mesh.volumes.volume import fill_volume
from ssilang.operators.mesh.lines.ends import *
from ssilang.operators.mesh.surfaces.sweeps import LAYERS, generator_path, turning
from ssilang.operators.prelude import *


def surface_to_sweep(mesh: Mesh, side: int) -> Mesh:
    """The mesh itself if it is a surface, else one of its faces (0 start, 1 end)."""
    if mesh.dimension < 3:
        return mesh
    if len(mesh.sides) < 2:
        raise MeshError("operators.mesh.no-face-to-sweep", side=side + 1)
    return mesh.sides[side]


def _make(
    base: Mesh, path: sweep.Path, end_size: float, count: int | None, said: Mapping[str, Any]
) -> Mesh:
    """What a surface sweeps, its layers as `_CUTS` has read them."""
    surface = surface_to_sweep(base, 1)
    if said["places"] is not None:
        layers = sweep.listed_cuts(said["places"].values, path.length)
    else:
        cuts = cuts_of(count, said["sizes"])
        sizes = cuts.sizes((sweep.mean_density(surface), end_size))
        layers = subdivide(path.length, *sizes, cuts.count)
    made = sweep.sweep_surface(surface, path, layers)
    return made if surface is base else side_by_side(base, made)


_BASE = arg("base", "MAILLAGE", en="surface, or volume whose face 2 is swept")
_CUTS = (
    LAYERS,
    SIZES,
    key("places", "PROG", "LISTREEL", range=ANY_NUMBER, en="positions of the layers"),
    flag("wordy", "VERB", en="accepted, without effect"),
)


@operator("VOLU", _BASE, *_CUTS, family="mesh", full_name="VOLUME")
def volu(
    call: Call,
    base: Mesh,
    count: int | None,
    goal: Mesh | None = Opt("MAILLAGE", en="surface to reach, or volume whose face 1 is reached"),
    thickness: float | NodeField | None = Opt(
        "FLOTTANT", "CHPOINT", range=POSITIVE, en="thickness to give to a shell", unit="m"
    ),
    outwards: Point | None = Opt(
        "POINT", en="vector from the inner to the outer skin of the shell"
    ),
    **said: Any,
) -> Mesh:
    """Fill a volume, span one between two surfaces, or thicken a shell."""
    if goal is not None:
        end = surface_to_sweep(goal, 0)
        path = sweep.ruling(surface_to_sweep(base, 1), end)
        made = _make(base, path, sweep.mean_density(end), count, said)
        return made if end is goal else side_by_side(made, goal)
    if thickness is None and count:
        thickness = float(count)
    if thickness is None:
        return fill_volume(base, workspace(call.session).colour)
    if outwards is None:
        raise call.missing(("POINT",))
    return thickened(base, thickness, outwards.coordinates.copy())


@volu.form(said("TRANSLATION"), _BASE, *_CUTS)
def translated(
    base: Mesh,
    count: int | None,
    vector: Point = Arg("POINT", en="vector", unit="m", usual=NOT_ZERO),
    **said: Any,
) -> Mesh:
    """Sweep a volume along a vector."""
    path = sweep.translation(vector.coordinates.copy())
    return _make(base, path, vector.density, count, said)


@volu.form(said("ROTATION"), _BASE, *_CUTS, ANGLE, AXIS)
def turned(
    call: Call,
    base: Mesh,
    count: int | None,
    angle: float | None,
    axis: Sequence[Point],
    **said: Any,
) -> Mesh:
    """Sweep a volume about an axis."""
    count, degrees = count_and_angle(call, count, angle)
    turn, size = turning(call, degrees, axis)
    path = turn(surface_to_sweep(base, 1))
    return _make(base, path, size, count, said)


@volu.form(
    select(
        "along",
        {"GENERATRICE": [arg("line", "MAILLAGE", en="line to follow")]},
        optional=False,
    ),
    _BASE,
    *_CUTS,
)
def along_line(call: Call, along: Chosen, base: Mesh, count: int | None, **said: Any) -> Mesh:
    """Sweep a volume along a line, a layer for each of its cells."""
    if count is not None or said["sizes"] or said["places"] is not None:
        call.warn("operators.mesh.line-gives-layers", count=along["line"].n_cells)
    path, layers = generator_path(along["line"])
    surface = surface_to_sweep(base, 1)
    made = sweep.sweep_surface(surface, path, layers)
    return made if surface is base else side_by_side(base, made)


def thickened(shell: Mesh, thickness: float | NodeField, direction: FloatArray) -> Mesh:
    """Bricks on a shell, half the thickness on each side along the nodes' mean normals.

    Parameters
    ----------
    thickness : float or NodeField
    direction : array (3,)
        From the inner to the outer skin.
    """
    ids = shell.node_ids
    normal = np.zeros((len(ids), 3))
    order = np.argsort(ids)
    for block in shell.blocks:
        vectors = surface_normals(block)
        vectors *= np.where(vectors @ direction < 0, -1.0, 1.0)[:, None]
        place = order[np.searchsorted(ids[order], block.connectivity)]
        for k in range(place.shape[1]):
            np.add.at(normal, place[:, k], vectors)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    if (length == 0.0).any():
        raise MeshError("operators.mesh.no-shell")
    normal /= length
    size = _thickness_at(shell, thickness)[:, None]
    inner = shell.nodes.add(shell.nodes.coordinates[ids] - 0.5 * size * normal)
    table = np.zeros(int(ids.max()) + 1, dtype=np.int64)
    table[ids] = inner
    blocks = tuple(
        type(b).make(b.nodes, b.cell_type, table[b.connectivity], b.colours) for b in shell.blocks
    )
    path = sweep.Path(lambda x, s: x + s * size * normal, float(size.mean()))
    return sweep.sweep_surface(
        Mesh(shell.nodes, blocks), path, Subdivision(np.array([0.0, 1.0]), 0, 0)
    )


def _thickness_at(shell: Mesh, thickness: float | NodeField) -> FloatArray:
    ids = shell.node_ids
    if not isinstance(thickness, NodeField):
        return np.full(len(ids), float(thickness))
    name = next(iter(thickness.components))
    values = thickness.values_at(name, ids, np.nan)
    if np.isnan(values).any():
        raise MeshError("operators.mesh.thickness-missing")
    return values


@operator("PAVE", family="mesh")
def pave(
    session: Session,
    call: Call,
    faces: tuple[Mesh, ...] = Many("MAILLAGE", en="six faces, opposite ones one after the other"),
) -> Mesh:
    """Fill a block."""
    if len(faces) != 6:
        raise call.error("operators.mesh.six-faces-wanted", n_faces=len(faces))
    return fill_block(faces, workspace(session).colour)

"""Grids written as .vtu are read back by meshio, an independent reader."""

import itertools
from dataclasses import replace

import meshio
import numpy as np
import pytest
from together import together

from ssilang.io.errors import OutputError
from ssilang.io.vtk import Encoding, grid_of, write_vtu
from ssilang.io.vtk.grid import ORDERS, DataArray, cell_arrays
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

# edges of VTK's quadratic cells whose middles follow the corners, in order (vtkQuadratic*.h)
VTK_EDGES = {
    "SEG3": [(0, 1)],
    "TRI6": [(0, 1), (1, 2), (2, 0)],
    "QUA8": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "TE10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "PR15": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "PY13": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
    "CU20": [
        *[(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)],
        *[(0, 4), (1, 5), (2, 6), (3, 7)],
    ],
}
SHAPES = {
    "SEG3": [(0, 0, 0), (1, 0, 0)],
    "TRI6": [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
    "QUA8": [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)],
    "TE10": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "PR15": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    "PY13": [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0), (1, 0, 1)],
    "CU20": [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (2, 0), (2, 1), (0, 1))],
}


def quadratic_cell(name: str) -> Mesh:
    """One straight cell; middles stand between their neighbours on the contours of the faces."""
    kind = CELL_TYPES[name]
    points = np.full((kind.n_nodes, 3), np.nan)
    points[list(kind.corners)] = SHAPES[name]
    contours = [local for face, local in kind.faces if face.endswith(("6", "8"))]
    if kind.dimension < 3:
        contours = [tuple(range(kind.n_nodes))]
    for contour in contours:
        for a, b, c in zip(
            contour, contour[1:] + contour[:1], contour[2:] + contour[:2], strict=True
        ):
            if b not in kind.corners:
                points[b] = (points[a] + points[c]) / 2
    assert not np.isnan(points).any()
    table = NodeTable()
    return Mesh.of(table, name, table.add(points)[None, :])


@together("name", sorted(VTK_EDGES))
def test_quadratic_middles_follow_vtk_edges(name, tmp_path, monkeypatch):
    # meshio 5.3 knows the node order of these two but not their dimension
    monkeypatch.setitem(meshio._mesh.topological_dimension, "wedge15", 3)
    monkeypatch.setitem(meshio._mesh.topological_dimension, "pyramid13", 3)
    write_vtu(tmp_path / "cell.vtu", grid_of(quadratic_cell(name)))
    read = meshio.read(tmp_path / "cell.vtu")
    points = read.points[read.cells[0].data[0]]
    corners = len(SHAPES[name])
    assert np.array_equal(points[:corners], np.array(SHAPES[name], dtype=float))
    for middle, (a, b) in zip(points[corners:], VTK_EDGES[name], strict=True):
        assert np.allclose(middle, (points[a] + points[b]) / 2, atol=0)


def test_every_cell_type_of_the_kernel_can_be_written():
    # cells of any number of nodes, made as they are asked for, carry matrices and have no shape
    shapes = {name for name, kind in CELL_TYPES.items() if kind.dimension or name == "POI1"}
    assert len(shapes) > 20
    assert shapes <= set(ORDERS)


def square_with_fields() -> tuple[Mesh, NodeField, CellField]:
    table = NodeTable()
    ids = table.add(np.array(list(itertools.product(range(4), range(3))), dtype=float))
    grid = ids.reshape(4, 3)
    corners = [grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]]
    mesh = Mesh.of(table, "QUA4", np.stack([c.ravel() for c in corners], axis=1))
    rng = np.random.default_rng(3)
    field = NodeField.of(
        table, ids, {"UX": rng.normal(size=12), "UY": rng.normal(size=12), "TEMP": np.arange(12.0)}
    )
    stress = {c: rng.normal(size=(6, 4)) for c in ("SMXX", "SMYY", "SMZZ", "SMXY")}
    cells = CellFieldBlock(mesh.blocks[0], {**stress, "VONM": np.arange(6.0)[:, None]}, "STRESSES")
    return mesh, field, CellField((cells,), "CONTRAINTES")


# a joint's faces with their middles, walked as its cell lists them, and the opened volume or area
JOINTS = {
    "RAC2": ([(0, 0, 0), (2, 0, 0)], "line", 2.0),
    "RAC3": ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], "line", 2.0),
    "LIA3": ([(0, 0, 0), (2, 0, 0), (0, 1, 0)], "surface", 1.0),
    "LIA4": ([(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)], "surface", 2.0),
    "LIA6": (
        [(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 0.5, 0), (0, 1, 0), (0, 0.5, 0)],
        "surface",
        1.0,
    ),
    "LIA8": (
        [
            (0, 0, 0),
            (1, 0, 0),
            (2, 0, 0),
            (2, 0.5, 0),
            (2, 1, 0),
            (1, 1, 0),
            (0, 1, 0),
            (0, 0.5, 0),
        ],
        "surface",
        2.0,
    ),
}


@pytest.mark.parametrize("name", sorted(JOINTS))
def test_an_opened_joint_fills_its_gap(name, tmp_path):
    """VTK's simplices of the cell between the faces, 1 apart: nodes in their right places.

    Their signs, and VTK's measure of a whole wedge, changed between VTK 9.6 and 9.7.
    """
    pyvista = pytest.importorskip("pyvista")
    face, kind, measure = JOINTS[name]
    up = np.array((0.0, 1.0, 0.0) if kind == "line" else (0.0, 0.0, 1.0))
    table = NodeTable()
    ids = table.add(np.concatenate([np.array(face, float), np.array(face, float) + up]))
    write_vtu(tmp_path / "joint.vtu", grid_of(Mesh.of(table, name, ids[None, :])))
    read = pyvista.read(tmp_path / "joint.vtu")
    pieces = read.triangulate().compute_cell_sizes()
    found = pieces.cell_data["Area" if kind == "line" else "Volume"]
    assert np.abs(found).sum() == pytest.approx(measure)
    assert abs(found.sum()) == pytest.approx(measure)
    # middles stand between the corners that VTK takes for their neighbours
    middles = {"RAC3": [(0, 1), (2, 3)], "LIA6": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3)]}
    points = read.points[read.cell_connectivity]
    corners = len(points) - len(middles.get(name, []))
    for middle, (a, b) in zip(points[corners:], middles.get(name, []), strict=True):
        assert np.array_equal(middle, (points[a] + points[b]) / 2)


@together(
    "family, names",
    [
        ("stress", ("SMXX", "SMYY", "SMZZ", "SMXY", "SMYZ", "SMXZ")),
        ("strain", ("EPXX", "EPYY", "EPZZ", "GAXY", "GAYZ", "GAXZ")),
        ("stress", ("SMRR", "SMZZ", "SMTT", "SMRZ", "SMZT", "SMRT")),
        ("strain", ("EPRR", "EPZZ", "EPTT", "GARZ", "GAZT", "GART")),
    ],
)
def test_six_different_components_stand_in_the_order_of_vtk(family, names, tmp_path):
    """XX YY ZZ XY YZ XZ, also where the components were given in another order."""
    mesh, _, _ = square_with_fields()
    values = {c: np.full((6, 4), 10.0 + k) for k, c in enumerate(names)}
    turned = dict(sorted(values.items(), reverse=True))
    cells = CellField((CellFieldBlock(mesh.blocks[0], turned, "STRESSES"),))
    write_vtu(tmp_path / "s.vtu", grid_of(mesh, {}, {"": cells}))
    tensor = meshio.read(tmp_path / "s.vtu").cell_data[family][0]
    np.testing.assert_array_equal(tensor, np.tile(10.0 + np.arange(6.0), (6, 1)))


@together("encoding", list(Encoding))
def test_fields_come_back_exactly(encoding, tmp_path):
    mesh, field, stress = square_with_fields()
    write_vtu(tmp_path / "f.vtu", grid_of(mesh, {"": field}, {"": stress}), encoding, time=0.25)
    read = meshio.read(tmp_path / "f.vtu")
    assert np.array_equal(read.points, mesh.nodes.coordinates[mesh.sorted_node_ids])
    moved = read.point_data["displacement"]
    assert np.array_equal(moved[:, 0], field.components["UX"].values)
    assert np.array_equal(moved[:, 1], field.components["UY"].values)
    assert not moved[:, 2].any()
    assert np.array_equal(read.point_data["TEMP"], np.arange(12.0))
    tensor = read.cell_data["stress"][0]
    means = stress.blocks[0].components
    assert np.array_equal(tensor[:, 3], means["SMXY"].mean(axis=1))
    assert not tensor[:, 4:].any()
    assert np.array_equal(read.cell_data["VONM"][0], np.arange(6.0))


def test_a_named_field_gives_its_name_to_the_first_vector(tmp_path):
    mesh, field, _ = square_with_fields()
    write_vtu(tmp_path / "v.vtu", grid_of(mesh, {"velocity": field}))
    assert set(meshio.read(tmp_path / "v.vtu").point_data) == {"velocity", "velocity_TEMP"}


def test_forces_of_a_shell_are_named_each_by_its_component():
    mesh, _, _ = square_with_fields()
    ones = {c: np.ones((6, 1)) for c in ("N11", "M11")}
    forces = CellField((CellFieldBlock(mesh.blocks[0], ones, "STRESSES"),))
    assert set(cell_arrays(forces, mesh, "F")) == {"F_N11", "F_M11"}


@together("encoding", Encoding)
@together("kind", ["<f8", ">f8", "<f4", ">f4", "<i4", ">i8", "u1", "?"])
def test_numbers_of_any_kind_and_order_are_read_back(kind, encoding, tmp_path):
    mesh, _, _ = square_with_fields()
    values = np.arange(24).reshape(2, 12).astype(kind).T  # neither contiguous nor of one value
    grid = replace(grid_of(mesh), point_data={"V": DataArray(values)})
    write_vtu(tmp_path / "k.vtu", grid, encoding)
    assert np.array_equal(meshio.read(tmp_path / "k.vtu").point_data["V"], values)


def test_component_names_of_gibiane_stay_readable(tmp_path):
    mesh, field, stress = square_with_fields()
    write_vtu(tmp_path / "n.vtu", grid_of(mesh, {"": field}, {"": stress}), Encoding.TEXT)
    text = (tmp_path / "n.vtu").read_text()
    assert 'ComponentName0="UX"' in text
    assert 'ComponentName3="SMXY"' in text


def test_nodes_without_a_value_stay_in_place_and_scalars_are_unknown_there():
    mesh, field, _ = square_with_fields()
    some = field.node_ids[:5]
    part = NodeField.of(mesh.nodes, some, {"UX": np.ones(5), "TEMP": np.ones(5)})
    data = grid_of(mesh, {"": part}).point_data
    assert data["displacement"].values[5:].sum() == 0
    assert np.isnan(data["TEMP"].values[5:].astype(float)).all()


def test_multipliers_make_no_array():
    mesh, field, _ = square_with_fields()
    away = mesh.nodes.add(np.zeros((1, 2)))
    both = NodeField(mesh.nodes, {**field.components, "LX": NodeValues(away, np.ones(1))})
    assert set(grid_of(mesh, {"": both}).point_data) == set(grid_of(mesh, {"": field}).point_data)


def test_cell_values_find_their_cells_in_another_order():
    mesh, _, stress = square_with_fields()
    block = mesh.blocks[0]
    turned = CellBlock.make(mesh.nodes, "QUA4", np.roll(block.connectivity[::-1], 1, axis=1))
    other = Mesh(mesh.nodes, (turned,))
    data = grid_of(other, {}, {"": stress}).cell_data
    assert np.array_equal(data["VONM"].values, np.arange(6.0)[::-1])


def test_cells_without_a_value_are_unknown():
    mesh, _, stress = square_with_fields()
    points = Mesh.of(mesh.nodes, "POI1", mesh.sorted_node_ids[:2, None])
    both = Mesh(mesh.nodes, (*points.blocks, *mesh.blocks))
    values = grid_of(both, {}, {"": stress}).cell_data["VONM"].values.astype(float)
    assert np.isnan(values[:2]).all()
    assert np.array_equal(values[2:], np.arange(6.0))


def test_joint_is_the_cell_between_its_faces():
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0), (0, 1), (1, 1)]))
    grid = grid_of(Mesh.of(table, "RAC2", ids[None, :]))
    x, y, _ = grid.points[grid.connectivity].T
    area = 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
    assert area == 1.0


def test_nothing_is_left_when_a_file_cannot_be_written(tmp_path):
    mesh, field, _ = square_with_fields()
    (tmp_path / "blocked").write_text("a file where a directory is needed")
    with pytest.raises(OutputError, match="cannot be written"):
        write_vtu(tmp_path / "blocked" / "x.vtu", grid_of(mesh, {"": field}))
    assert [p.name for p in tmp_path.iterdir()] == ["blocked"]


def test_tractions_and_openings_of_joints_are_vectors_in_their_axes():
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0), (0, 0), (1, 0), (0, 1), (1, 1)]))
    joint = CellBlock.make(table, "RAC2", ids[None, :4])
    solid = CellBlock.make(table, "QUA4", ids[None, [2, 3, 5, 4]])
    mesh = Mesh(table, (joint, solid))

    def field(**values: list[float]) -> CellField:
        parts = {k: np.array([v]) for k, v in values.items()}
        return CellField((CellFieldBlock(joint, parts, "STRESSES", "JOI2"),))

    cells = {"t": field(SMSN=[3.0, 5.0], SMN=[-7.0, -9.0]), "o": field(DRSN=[1.0], DRN=[2.0])}
    data = grid_of(mesh, {}, cells).cell_data
    assert np.array_equal(data["t"].values[0], [-8.0, 4.0, 0.0])
    assert data["t"].columns[:2] == ("SMN", "SMSN")
    assert np.array_equal(data["o"].values[0], [2.0, 1.0, 0.0])
    assert np.isnan(data["t"].values[1].astype(float)).all()


def test_axial_force_of_a_bar_is_a_number():
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0)]))
    mesh = Mesh.of(table, "SEG2", ids[None, :])
    force = CellFieldBlock(mesh.blocks[0], {"EFFX": np.array([[4.0]])}, "STRESSES", "BARR")
    data = grid_of(mesh, {}, {"": CellField((force,))}).cell_data
    assert data["EFFX"].values.shape == (1,)


def test_pyvista_reads_a_joint_with_its_traction(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0), (0, 0), (1, 0)]))
    mesh = Mesh.of(table, "RAC2", ids[None, :])
    values = {"SMSN": np.array([[1.0]]), "SMN": np.array([[-2.0]])}
    traction = CellField((CellFieldBlock(mesh.blocks[0], values, "STRESSES", "JOI2"),))
    opening = NodeField.of(table, ids, {"UY": np.array([0.0, 0, 0.5, 0.5])})
    write_vtu(tmp_path / "j.vtu", grid_of(mesh, {"": opening}, {"traction": traction}))
    read = pyvista.read(tmp_path / "j.vtu")
    assert np.array_equal(read.cell_data["traction"], [[-2.0, 1.0, 0.0]])
    # the closed joint has no area; moved by the displacement it has that of the gap
    assert read.area == pytest.approx(0.0, abs=1e-12)
    assert read.warp_by_vector("displacement").area == pytest.approx(0.5)

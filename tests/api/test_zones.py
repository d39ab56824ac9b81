"""Fields and meshes in Python with two zones, two kinds of cells and nodes in no order."""

import numpy as np
import pytest

import ssilang

DECK = """OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
P9 = 3. 1.5 ; P1 = 1. 0.5 ; P5 = 2. 0.5 ; P2 = 2. 1. ; P7 = 1. 1.25 ; P3 = 4. 0.75 ;
S1 = (MANU 'QUA4' P1 P5 P2 P7) COUL ROUG ; S2 = (MANU 'TRI3' P5 P3 P2) ET (MANU 'TRI3' P3 P9 P2) ;
S = S1 ET S2 ; M = (MODE S1 'MECANIQUE') ET (MODE S2 'MECANIQUE') ;
C = (NOMC 'X' (CHAN 'CHAM' (COOR 1 S) M)) ET (NOMC 'Y' (CHAN 'CHAM' (COOR 2 S2) (REDU M S2))) ;
U = (NOMC 'UX' (COOR 1 S)) ET (NOMC 'UY' (COOR 2 S2)) ; E = VIDE 'CHPOINT' ;
"""
PLACES = [(3, 1.5), (1, 0.5), (2, 0.5), (2, 1), (1, 1.25), (4, 0.75)]
ZONES = [[[1, 2, 3, 4]], [[2, 5, 3], [5, 0, 3]]]
IN_SECOND = {0, 2, 3, 5}


@pytest.fixture(scope="module")
def run():
    return ssilang.run(DECK)


@pytest.mark.parametrize("zone", [1, 2])
def test_values_of_a_zone_stand_where_its_cells_do(run, zone):
    field = run["C"]
    assert field.zones == 2
    assert field.components == ("X", "Y")
    corners = np.array([[PLACES[i] for i in cell] for cell in ZONES[zone - 1]], float)
    np.testing.assert_allclose(field.points(zone)[..., :2], corners)
    np.testing.assert_allclose(field.values("X", zone), corners[..., 0])
    with pytest.raises(ssilang.Error, match="zone"):
        field.values("X", 3)
    with pytest.raises(ssilang.Error, match="zone"):
        field.values("X", 0)
    with pytest.raises(ssilang.Error, match=r"1.*2"):
        field["X"]


def test_a_component_of_one_zone_needs_no_number(run):
    corners = np.array([[PLACES[i] for i in cell] for cell in ZONES[1]], float)
    np.testing.assert_allclose(run["C"]["Y"], corners[..., 1])
    with pytest.raises(ssilang.Error):
        run["C"].values("Y", 1)


def test_a_frame_has_a_row_a_point_of_each_zone(run):
    frame = run["C"].frame()
    rows = [
        (zone, k, n, PLACES[node][0], PLACES[node][1] if zone == 2 else None)
        for zone, cells in enumerate(ZONES, 1)
        for k, cell in enumerate(cells, 1)
        for n, node in enumerate(cell, 1)
    ]
    assert len(frame) == len(rows)
    found = frame.reset_index()[["zone", "cell", "point", "X", "Y"]].to_numpy().tolist()
    for row, wanted in zip(found, rows, strict=True):
        assert row[:4] == list(wanted[:4])
        assert np.isnan(row[4]) if wanted[4] is None else row[4] == wanted[4]


def test_nodes_without_a_component_are_told(run):
    field = run["U"]
    assert field.nodes.tolist() == [1, 2, 3, 4, 5, 6]
    np.testing.assert_allclose(field.points[:, :2], PLACES)
    np.testing.assert_allclose(field["UX"], [x for x, _ in PLACES])
    assert [i for i, y in enumerate(field["UY"]) if not np.isnan(y)] == sorted(IN_SECOND)
    array = np.asarray(field)
    assert array.shape == (6, 2)
    np.testing.assert_allclose(array[5], PLACES[5])
    frame = field.frame()
    assert frame.index.tolist() == [1, 2, 3, 4, 5, 6]
    np.testing.assert_allclose(
        frame[["x", "y", "UX"]].to_numpy()[:, [0, 2]], [[x, x] for x, _ in PLACES]
    )
    data = field.xarray()
    np.testing.assert_allclose(data["y"].to_numpy(), [y for _, y in PLACES])
    np.testing.assert_allclose(data["UX"].sel(node=6), 4.0)
    assert len(run["E"]) == 0

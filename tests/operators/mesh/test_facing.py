"""VISA: pairs of nodes at one place."""

from script_runs import ran

LINES = "OPTI DIME 2 ELEM SEG2 ; A = DROI 4 (0. 0.) (1. 0.) ; B = DROI 2 (1. 1.E-7) (0. 1.E-7) ; "


def test_double_nodes_of_one_mesh_with_the_density() -> None:
    result = ran("DENS 1.E-3 ; " + LINES + "M N = VISA (A ET B) ; K = NBNO M ;")
    m, n = (result.session.root.find(x).sorted_node_ids for x in "MN")
    assert len(m) == 3
    assert not set(m) & set(n)

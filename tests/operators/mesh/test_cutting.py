"""FUIT, and what COUP and FUIT refuse."""

import pytest

FRAME = (
    "OPTI DIME 2 ELEM SEG2 ; A = DROI 6 (0. 0.) (3. 0.) ; B = DROI 2 (3. 0.) (3. 1.) ; "
    "C = DROI 6 (3. 1.) (0. 1.) ; D = DROI 2 (0. 1.) (0. 0.) ; L = A ET B ET C ET D ; "
    "ELIM 1.E-6 L ; "
)


def test_one_part_holds_the_segment_and_the_other_its_inverse(found) -> None:
    segment, first, second = found(FRAME + "E F G = FUIT L (A POIN 3) C ;", "E", "F", "G")
    a, b = segment.single_block().connectivity[0]
    assert [a, b] in first.single_block().connectivity.tolist()
    assert [b, a] in second.single_block().connectivity.tolist()
    # the node stands at x = 1: anticlockwise, the segment going up has the left part behind it
    x = first.nodes.coordinates[first.sorted_node_ids]
    assert x[:, 0].max() == pytest.approx(1.0)

"""Every line goes from its first point to its last, and drawn the other way is the same line."""

import numpy as np
from script_runs import found
from together import together

PLACES = "A = 0.2 0.1 ; B = 3.1 0.7 ; C = 0.9 1.3 ; D = 2.4 -0.6 ; O = 1.45 1.3 ;"
# there, and back: nothing is symmetric
LINES = {
    "DROI": ("DROI {n} A B {sizes}", "DROI {n} B A {sizes}"),
    "CUBP": ("CUBP {n} A C D B {sizes}", "CUBP {n} B D C A {sizes}"),
    "CUBT": (
        "CUBT {n} A (1. 2.) (2. -1.) B {sizes}", "CUBT {n} B (-2. 1.) (-1. -2.) A {sizes}"
    ),
    "PARA": ("PARA {n} A C B {sizes}", "PARA {n} B C A {sizes}"),
    "CER3": ("CER3 {n} A C B {sizes}", "CER3 {n} B C A {sizes}"),
}  # fmt: skip


def places(line):
    """Coordinates of the nodes as the cells follow one another."""
    (block,) = line.blocks
    ends = block.coordinates[:, :, :2]
    assert (block.connectivity[1:, 0] == block.connectivity[:-1, 1]).all()
    return np.vstack([ends[:1, 0], ends[:, 1]])


@together("name", LINES)
@together(
    "n, sizes, turned",
    [("1", "", ""), ("7", "", ""), ("", "'DINI' 0.1 'DFIN' 0.4", "'DINI' 0.4 'DFIN' 0.1")],
)
def test_a_line_and_the_way_back(name, n, sizes, turned):
    there, back = LINES[name]
    there, back = there.format(n=n, sizes=sizes), back.format(n=n, sizes=turned)
    script = f"OPTI DIME 2 ELEM SEG2 ; {PLACES} L1 = {there} ; L2 = {back} ;"
    first, second, a, b = found(script, "L1", "L2", "A", "B")
    x = places(first)
    np.testing.assert_allclose(x[[0, -1]], [a.coordinates[:2], b.coordinates[:2]], atol=1e-12)
    np.testing.assert_allclose(x[::-1], places(second), atol=2e-6)
    lengths = np.linalg.norm(np.diff(x, axis=0), axis=1)
    if n:
        assert len(lengths) == int(n)
    else:
        assert lengths[0] < 0.6 * lengths[-1]

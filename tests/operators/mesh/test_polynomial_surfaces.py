"""DALL and SURF 'POLY', PARC: positions against their formulas."""

import numpy as np
import pytest
from script_runs import found, refused
from together import together

TWISTED = (
    "OPTI DIME 3 ELEM {element} DENS 0.25 ; "
    "S = {word} 'POLY' 3 2 (1. 0. 0.) (2. 0. 0.) (0. 0. 1.) (0. 1. 0.) (0. 0. 1.) (0. 0.5 0.) "
    "{more} ; "
)


@together("word", ["DALL", "SURF"])
@together("element", ["QUA4", "QUA8", "TRI3", "TRI6"])
@together("more", ["", "'REGU'", "'PARA' -1. 2. 0.5 1.5"])
def test_nodes_lie_on_the_polynomial(word, element, more):
    """x = 1 + 2 u, so u is known from x; then y = v (1 + u^2 / 2) gives v, and z = u^2 + u v."""
    mesh = found(TWISTED.format(word=word, element=element, more=more), "S")
    x, y, z = mesh.nodes.coordinates[mesh.node_ids].T
    u = (x - 1.0) / 2.0
    v = y / (1.0 + 0.5 * u**2)
    assert z == pytest.approx(u**2 + u * v, abs=1e-9)
    limits = (-1.0, 2.0, 0.5, 1.5) if "PARA" in more else (0.0, 1.0, 0.0, 1.0)
    assert (u.min(), u.max(), v.min(), v.max()) == pytest.approx(limits, abs=1e-9)
    assert {b.cell_type for b in mesh.blocks} == {element}


def test_parameters_are_even_or_lengths_are():
    """The parabola z = u^2 of width one: even in u, or even along the curve."""
    script = (
        "OPTI DIME 3 ELEM QUA4 DENS 0.2 ; S = DALL 'POLY' 3 2 (0. 0. 0.) (1. 0. 0.) (0. 0. 3.) "
        "(0. 1. 0.) (0. 0. 0.) (0. 0. 0.) {} ; L = COTE 1 S ; N = NBEL L ; A = MESU (L ELEM 1) ; "
        "B = MESU (L ELEM N) ; P = L POIN 2 ; X = COOR 1 P ;"
    )
    count, first, last, x = found(script.format(""), "N", "A", "B", "X")
    assert x == pytest.approx(1.0 / count)
    assert last > 3.0 * first
    _, first, last, _ = found(script.format("'REGU'"), "N", "A", "B", "X")
    assert last == pytest.approx(first, rel=0.05)  # chords of equal arcs


def test_parabolas_touch_the_circle_at_their_ends():
    """Ends on the circle, tangents those of the circle, middle halfway to where they meet."""
    mesh = found("OPTI DIME 2 ; L = PARC 3 (2. 0.) (0. 0.) (0. 2.) ;", "L")
    table = mesh.single_block().connectivity
    a, m, b = (mesh.nodes.coordinates[table[:, k], :2] for k in range(3))
    assert np.linalg.norm(a, axis=1) == pytest.approx(np.full(3, 2.0))
    assert np.linalg.norm(b, axis=1) == pytest.approx(np.full(3, 2.0))
    start, end = -3 * a + 4 * m - b, a - 4 * m + 3 * b
    assert (start * a).sum(axis=1) == pytest.approx(np.zeros(3), abs=1e-12)
    assert (end * b).sum(axis=1) == pytest.approx(np.zeros(3), abs=1e-12)
    assert (np.linalg.norm(m, axis=1) > 2.0).all()


def test_parabolas_continue_and_close_lines():
    script = (
        "OPTI DIME 2 ELEM SEG3 ; P = 1. 0. ; L = (0. 0.) DROI 2 P ; M = PARC 2 L (1. 1.) (2. 1.) ; "
        "N = NBEL M ; Q = M POIN 'FINA' ; X Y = COOR Q ;"
    )
    assert found(script, "N", "X", "Y") == pytest.approx((4, 2.0, 1.0))
    assert "1" in refused("OPTI DIME 2 ; L = PARC 1 (1. 0.) (0. 0.) (-1. 0.) ;")

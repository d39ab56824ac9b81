"""Meshing as scripts write it: the forms of the operators, read against closed forms."""

from typing import Any

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.mesh import Mesh

PLANE = "OPTI DIME 2 ELEM QUA4 ; O = 0. 0. ; A = 1. 0. ; B = 1. 1. ; "
SPACE = "OPTI DIME 3 ELEM CUB8 ; O = 0. 0. 0. ; A = 1. 0. 0. ; Z = 0. 0. 1. ; "
STRIP = PLANE + "L = O D 4 A ; S = L TRAN 2 (0. 1.) ; "


def value(script: str, name: str = "X") -> Any:
    return ran(script).session.root.find(name)


def xy(mesh: Mesh) -> np.ndarray:
    """Positions along a line."""
    return mesh.nodes.coordinates[line_chain(mesh), :2]


# ---- lines --------------------------------------------------------------------------------


@together(
    "phrase",
    ["DROI 4 O A", "O D 4 A", "O DROI A 4", "'DROIT' O A 4", "4 DROI O A"],
)
def test_line_reads_its_operands_in_any_order(phrase: str) -> None:
    assert xy(value(PLANE + f"X = {phrase} ;")) == pytest.approx(
        np.column_stack([np.linspace(0, 1, 5), np.zeros(5)])
    )


def test_lines_continue_one_another_and_close() -> None:
    line = value(PLANE + "X = O D 2 A D 3 B ; X = X D 4 ;")
    chain = line_chain(line)
    assert (line.n_cells, chain[0]) == (9, chain[-1])


def test_negative_number_grades_by_the_given_sizes() -> None:
    line = value(PLANE + "X = DROI -5 O A 'DINI' 0.1 'DFIN' 0.4 ;")
    sizes = np.diff(xy(line)[:, 0])
    assert len(sizes) == 5
    assert sizes[1:] / sizes[:-1] == pytest.approx(sizes[1] / sizes[0])
    assert sizes[0] < sizes[-1]


@together(
    "phrase",
    [
        "C 8 A O (0. 1.)",
        "CERC 8 'CENTR' A O (0. 1.)",
        "CERC 8 'PASS' A (0.6 0.8) (0. 1.)",
        "CERC 'ROTA' 8 90. A O",
        "CERC 8 'ROTA' 90 A O",
        "CER3 8 A (0.8 0.6) (0. 1.)",
        "LIGN 'ROTA' 8 O A 90.",
    ],
)
def test_arcs_lie_on_the_unit_circle(phrase: str) -> None:
    at = xy(value(PLANE + f"X = {phrase} ;"))
    assert np.linalg.norm(at, axis=1) == pytest.approx(1.0)
    turn = np.degrees(np.unwrap(np.arctan2(at[:, 1], at[:, 0])))
    assert turn == pytest.approx(np.linspace(0, 90, 9), abs=1e-9)


def test_whole_turn_closes_on_its_first_point() -> None:
    line = value(PLANE + "X = CERC 12 'ROTA' 360. A O 'ELIM' ;")
    chain = line_chain(line)
    assert chain[0] == chain[-1]
    assert len(line.node_ids) == 12


def test_polynomial_curve_uses_existing_ends() -> None:
    script = PLANE + "Q = 1. 1. ; X = COUR 4 (0. 0.) (1. 0.) (0. 1.) 'PINI' O 'PFIN' Q 'REGU' ; "
    line = value(script)
    at = xy(line)
    assert at[:, 1] == pytest.approx(at[:, 0] ** 2)
    assert line_chain(line)[-1] == value(script, "Q").node


def test_broken_line_from_lists_points_and_meshes() -> None:
    lists = value("OPTI DIME 2 ; X = QUEL SEG2 (PROG 0. 1. 2.) (PROG 0. 1. 0.) ;")
    points = value("OPTI DIME 2 ; X = QUEL SEG2 (0. 0.) (1. 1.) (2. 0.) ;")
    mesh = value("OPTI DIME 2 ; M = (0. 0.) ET (1. 1.) ET (2. 0.) ; X = QUEL SEG2 M ;")
    for line in (lists, points, mesh):
        assert xy(line) == pytest.approx(np.array([[0, 0], [1, 1], [2, 0]]))
    assert value("OPTI DIME 2 ; X = QUEL SEG3 (0. 0.) (1. 1.) (2. 0.) ;").n_cells == 1


# ---- surfaces and volumes -----------------------------------------------------------------


@pytest.mark.parametrize("line", ["QUA4", "QUA8"])
@pytest.mark.parametrize(("end", "corners"), [("K", [(2, 1), (0, 1)]), ("E", [(0.5, 2)])])
def test_a_seam_keeps_its_sides_around_it(line: str, end: str, corners: list) -> None:
    base = f"OPTI DIME 2 ELEM {line} ; O = 0. 0. ; A = 1. 0. ; E = 0.5 2. ; "
    base += f"L = O D 3 A ; K = DROI 5 (0. 1.) (2. 1.) ; S = COUT L {end} ; "
    run = ran(base)
    seam = run.session.root.find("S")
    assert run.session.root.find("L") is seam.sides[0]
    walked = [xy(side) for side in seam.sides]
    ends = [(0, 0), (1, 0), *corners, (0, 0)]
    assert [tuple(w[0]) for w in walked] == ends[:-1]
    assert [tuple(w[-1]) for w in walked] == ends[1:]
    skin = {n for side in seam.sides for n in line_chain(side)}
    assert skin == set(value(base + "X = CONT S ;").node_ids)
    assert [s.n_cells for s in seam.sides] == [3, 1, 5, 1] if end == "K" else [3, 1, 1]


@pytest.mark.parametrize(
    ("phrase", "cells"),
    [("O D {} A", 3), ("L TRAN {} (0. 2.)", 12), ("L REGL {} (L PLUS (0. 1.5))", 9)],
)
def test_a_number_of_zero_leaves_the_cuts_to_the_sizes(phrase: str, cells: int) -> None:
    base = "OPTI DIME 2 ELEM QUA4 DENS 0.5 ; O = 0. 0. ; A = 1.5 0. ; L = O D A ; X = "
    zero, without = (value(base + phrase.format(n) + " ;") for n in ("0", ""))
    assert zero.n_cells == cells
    assert zero.single_block().coordinates == pytest.approx(without.single_block().coordinates)


def test_a_line_between_two_points_is_had_by_its_old_operator_too() -> None:
    base = PLANE + "L = O D 4 A D 3 B ; P = L POIN 2 ; Q = L POIN 6 ; X = "
    parts = [xy(value(base + f"{p} ;")) for p in ("L COMP P Q", "ELEM L 'COMPRIS' P Q")]
    assert parts[0] == pytest.approx(parts[1])
    assert len(parts[0]) == 5


def test_cells_that_are_sound_keep_their_faces() -> None:
    base = SPACE + "L = O D 2 A ; V = (L TRAN 1 (0. 1. 0.)) VOLU 3 'TRAN' Z ; X = "
    faces = [value(f"{base} {v} FACE 2 ;") for v in ("V", "(REGE V)", "((REGE V) TOUR 30. O Z)")]
    assert [f.n_cells for f in faces] == [2, 2, 2]
    assert faces[1].single_block().coordinates[..., 2] == pytest.approx(np.ones((2, 4)))


@pytest.mark.parametrize(
    ("cell", "kinds"),
    [("TRI3", {"PRI6", "PYR5", "TET4"}), ("TRI6", {"PR15", "PY13", "TE10"})],
)
def test_prisms_about_an_axis_become_pyramids_and_tetrahedra(cell: str, kinds: set[str]) -> None:
    base = f"OPTI DIME 3 ELEM {cell} ; O = 0. 0. 0. ; Z = 0. 0. 2. ; L = O D 2 Z ; "
    base += "S = L TRAN 3 (1.5 0. 0.) ; V = S VOLU 4 'ROTA' 60. O Z ; ELIM V 1.E-6 ; W = REGE V ; "
    made = value(base + "X = W ;")
    assert {b.cell_type for b in made.blocks} == kinds
    assert all(len(set(row)) == len(row) for b in made.blocks for row in b.connectivity.tolist())
    before, after = value(base + "X = MESU V ;"), value(base + "X = MESU W ;")
    assert after == pytest.approx(before, rel=1e-3 if cell == "TRI6" else 1e-12)
    if cell == "TRI3":  # layers of the angle a hold sin(a) times the moment of the section
        assert after == pytest.approx(4 * np.sin(np.radians(15.0)) * 2 * 1.5**2 / 2)
    # each cell is the right way round
    parts = "".join(f"X = X + (ABS (MESU (W ELEM {k}))) ; " for k in kinds)
    assert value(f"{base} X = 0. ; {parts}") == pytest.approx(after)


def test_six_faces_come_in_any_order() -> None:
    base = SPACE + "".join(f"P{k} = {k % 2} {k // 2 % 2} {k // 4} ; " for k in range(8))
    edges = [(a, a | bit) for bit in (1, 2, 4) for a in range(8) if not a & bit]
    base += "".join(f"L{a}{b} = P{a} D {1 + (b - a)} P{b} ; " for a, b in edges)
    for bit in (1, 2, 4):
        u, v = (b for b in (1, 2, 4) if b != bit)
        for k in (0, bit):
            a, b, c, d = k, k | u, k | u | v, k | v
            base += f"F{bit}{k} = DALL L{a}{b} L{b}{c} L{d}{c} L{a}{d} 'PLAN' ; "
    pairs = ["F10 F11 F20 F22 F40 F44", "F10 F20 F40 F22 F44 F11", "F20 F44 F10 F11 F22 F40"]
    for faces in pairs:
        made = value(f"{base} X = PAVE {faces} ;")
        assert made.n_cells == 2 * 3 * 5
        assert value(f"{base} X = MESU (PAVE {faces}) ;") == pytest.approx(1.0)


@together("order", ["B1 B2 B3 B4", "B1 B4 B2 B3", "B3 B1 B4 B2", "B2 B4 B1 B3"])
def test_four_sides_of_a_grid_come_in_any_order(order: str) -> None:
    base = PLANE + "C = 0. 1. ; B1 = O D 2 A ; B2 = A D 3 B ; B3 = C D 2 B ; B4 = C D 3 O ; "
    made = value(f"{base} X = DALL {order} 'PLAN' ;")
    assert made.n_cells == 6
    assert value(f"{base} S = DALL {order} ; X = MESU S ;") == pytest.approx(1.0)
    middles = {tuple(x) for x in made.single_block().coordinates.mean(axis=1)[:, :2].round(6)}
    assert middles == {(i / 4, round(j / 6, 6)) for i in (1, 3) for j in (1, 3, 5)}


@pytest.mark.parametrize(("end", "told"), [("0. 1.04", 1), ("0. 1.", 0)])
def test_an_arc_of_two_radii_goes_about_a_centre_beside_the_given_one(end, told):
    """About the point of the mediator that is nearest; a wrong centre is told."""
    result = ran(f"{PLANE} B = {end} ; X = CERC 8 A O B ;")
    nodes = result.session.root.find("X")
    xyz = nodes.nodes.coordinates[nodes.node_ids]
    a, b = np.array([1.0, 0.0, 0.0]), np.array([*(float(v) for v in end.split()), 0.0])
    chord = b - a
    centre = chord * ((a + b) / 2 @ chord) / (chord @ chord)
    radii = np.linalg.norm(xyz - centre, axis=1)
    assert np.ptp(radii) < 1e-12
    assert radii[0] == pytest.approx(np.linalg.norm(a - centre))
    codes = [w.code for w in result.session.warnings]
    assert codes == ["operators.mesh.arc-about-moved-centre"] * told


@pytest.mark.parametrize(
    ("across", "up", "inner"),
    [
        (4, 3, [(1, 1), (2, 1), (3, 1), (3, 2), (2, 2), (1, 2)]),
        (4, 4, [(1, 1), (2, 1), (3, 1), (3, 2), (3, 3), (2, 3), (1, 3), (1, 2), (2, 2)]),
        (2, 4, [(1, 1), (1, 2), (1, 3)]),
    ],
)
def test_a_filled_contour_numbers_its_nodes_ring_after_ring(across, up, inner) -> None:
    """By hand; nodes of the contour come first, DALL goes row after row."""
    sides = (
        f"OPTI DIME 2 ELEM QUA4 ; A = 0. 0. ; B = {across}. 0. ; C = {across}. {up}. ; "
        f"D0 = 0. {up}. ; L1 = D {across} A B ; L2 = D {up} B C ; L3 = D {across} C D0 ; "
        f"L4 = D {up} D0 A ; N = NBNO (L1 ET L2 ET L3 ET L4) ; "
    )
    listed = "X = PROG ; Y = PROG ; REPE I ((NBNO S) - N) ; P = NOEU (N + &I) ; "
    listed += "X = X ET (COOR 1 P) ; Y = Y ET (COOR 2 P) ; FIN I ; "
    for word, expected in (
        ("SURF (L1 ET L2 ET L3 ET L4) PLAN", inner),
        ("DALL L1 L2 L3 L4 PLAN", sorted(inner, key=lambda p: p[::-1])),
    ):
        root = ran(f"{sides}S = {word} ; {listed}").session.root
        made = np.transpose([root.find("X").values, root.find("Y").values])
        np.testing.assert_allclose(made, expected, atol=1e-9)


@together(
    "made, length, first, last",
    [
        ("O D -4 E DINI 0.5 DFIN 0.", 2.0, 0.5, 0.0),
        ("O D -4 E DINI 0. DFIN 0.5", 2.0, 0.0, 0.5),
        ("O D -4 E DINI 0. DFIN 0.", 2.0, 0.0, 0.0),
        ("COTE 4 ((O D 1 A) TRAN -4 V DINI 0. DFIN 0.6)", 3.0, 0.6, 0.0),
        ("COTE 2 ((O D 1 A) TRAN -4 V DINI 0.6 DFIN 0.)", 3.0, 0.6, 0.0),
        ("COTE 2 (C TRAN -4 V)", 3.0, 0.4, 0.0),  # by the mean of the base's 0.2 and 0.6
    ],
)
def test_sizes_of_0_grade_a_given_number(made, length, first, last):
    base = "DENS 0.2 ; P = 0. 0. ; DENS 0.6 ; Q = 1. 0. ; C = P D 1 Q ;"
    text = f"{PLANE}E = 2. 0. ; V = 0. 3. ; {base}"
    places = xy(value(f"{text} X = {made} ;"))
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert len(steps) == 4
    assert steps.sum() == pytest.approx(length)
    ratio = steps[1:] / steps[:-1]
    grown = np.sqrt(ratio) - 1 / np.sqrt(ratio)
    np.testing.assert_allclose(grown, (last - first) / length, atol=1e-9)


def test_a_missing_end_of_a_statement_before_fin_and_names_that_are_none():
    assert value(f"{STRIP} X = 1 ; TRAC CACH S\nFIN ; X = 2 ;") == 1
    script = ran("T = TABL ; T . 1 = 5 ; A = 3 ; OUBL T . 1 ; OUBL (A + 1) ; X = A + (DIME T) ;")
    assert script.session.root.find("X") == 4

"""Edges of surfaces whose faces have different numbers of corners."""

import numpy as np
import pyvista
from hypothesis import given
from hypothesis import strategies as st

from ssilang.report.scenes import _cells_of, _edges_of, _pairs

FACE = st.integers(3, 6).flatmap(
    lambda n: st.lists(st.integers(0, 9), min_size=n, max_size=n, unique=True)
)


@given(st.lists(FACE, min_size=1, max_size=8))
def test_each_side_of_each_face_once(faces):
    surface = pyvista.PolyData(
        np.random.default_rng(1).normal(size=(10, 3)),
        faces=np.concatenate([[len(face), *face] for face in faces]),
    )
    wanted = {tuple(sorted((a, b))) for f in faces for a, b in zip(f, f[1:] + f[:1], strict=True)}
    found = _edges_of(surface).reshape(-1, 2)
    assert len(found) == len(wanted)
    assert {tuple(sorted(pair)) for pair in found.tolist()} == wanted


def test_no_faces_have_no_edges():
    assert _edges_of(pyvista.PolyData(np.zeros((2, 3)))).shape == (0,)


def test_lines_and_points_of_several_sizes_stand_one_behind_the_other():
    lines = pyvista.PolyData(np.eye(3), lines=[3, 0, 2, 1, 2, 1, 0]).GetLines()
    assert _pairs(lines).reshape(-1, 2).tolist() == [[0, 2], [2, 1], [1, 0]]
    points = pyvista.PolyData(np.eye(3), verts=[2, 2, 0, 1, 1]).GetVerts()
    assert _cells_of(points)[1].tolist() == [2, 0, 1]

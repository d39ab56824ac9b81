"""Axes from directions, radii and turns."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.results.frames import points_of
from ssilang.kernel.materials.axes import Directions, axis_parameters
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.materials.parameters import geometric_names, known_names, material_names
from tests.kernel.elements.samples import cell_zone, line_zone

X, Y = np.array([2.0, 0, 0]), np.array([0, 3.0, 0])


def test_direction_is_normalised_and_turned():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    for angle, expected in ((0.0, (1, 0)), (90.0, (0, 1)), (30.0, (np.sqrt(3) / 2, 0.5))):
        values, support = axis_parameters(zone, Directions(X, None, angle=angle))
        got = [values[n][0, 0] for n in ("V1X", "V1Y")]
        np.testing.assert_allclose(got, expected, atol=1e-15)
        assert support == "GRAVITE"


def test_axes_point_to_a_centre_in_the_plane_and_are_turned():
    zone, centre = cell_zone("QUA8", Mode.PLANE_STRAIN), np.array([1.0, -2.0, 0.0])
    values, support = axis_parameters(zone, Directions(centre, None, radial=True, angle=30.0))
    assert support == "RIGIDITE"
    way = (centre - points_of(zone, support)) @ [1.0, 1j, 0.0] * np.exp(1j * np.pi / 6)
    way /= np.abs(way)
    np.testing.assert_allclose(values["V1X"] + 1j * values["V1Y"], way)


def test_space_needs_two_vectors_that_are_not_parallel():
    zone = cell_zone("CUB8", Mode.THREE_DIMENSIONAL)
    with pytest.raises(MaterialError, match="two vectors"):
        axis_parameters(zone, Directions(X, None))
    with pytest.raises(MaterialError, match="parallel"):
        axis_parameters(zone, Directions(X, X))
    values, _ = axis_parameters(zone, Directions(X, X + Y))
    assert values["V2Y"][0, 0] == pytest.approx(1.0)


def test_each_element_knows_its_parameters():
    beam = line_zone("POUT", [(0, 0, 0), (1, 0, 0)], Mode.THREE_DIMENSIONAL)
    assert geometric_names(beam).required == ("SECT", "INRY", "INRZ", "TORS")
    joint = line_zone("JOI1", [(0, 0), (1, 0)], Mode.PLANE_STRAIN, ("ELASTIQUE", "JOINT_SDM"))
    assert {"KN", "KS", "FU", "GF", "FC", "FROT"} <= set(known_names(joint))
    solid = cell_zone("QUA4", Mode.PLANE_STRAIN)
    assert material_names(solid).required == ("YOUN", "NU")
    assert "SECT" not in known_names(solid)

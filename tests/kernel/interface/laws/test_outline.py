"""Bases that open as planes against sums over many places of them."""

import numpy as np
import pytest

from ssilang.kernel.interface.laws.columns import N_PARAMETERS, LawCode, Parameter
from ssilang.kernel.interface.laws.macro_law import outline_of

KN = 3e8
SHAPES = {
    "strip": (LawCode.STRIP, 2, {"LARG": 1.4}),
    "strip of a length": (LawCode.STRIP, 2, {"LARG": 1.4, "LONG": 3.0}),
    "rectangle": (LawCode.STRIP, 3, {"LARG": 1.4, "LONG": 3.0}),
    "disc": (LawCode.DISC, 3, {"RAYO": 0.8}),
    "springs": (LawCode.SPRINGS, 2, {"LARG": 1.4}),
}
AREAS = {"strip": 1.4, "strip of a length": 4.2, "rectangle": 4.2, "disc": np.pi * 0.64}


def places_of(name):
    """Equal parts of the base: places (n, d - 1) along t1 and t2."""
    s = (np.arange(400) + 0.5) / 200 - 1
    if name == "springs":
        return np.array([[-0.7], [0.7]])
    if name.startswith("strip"):
        return 0.7 * s[:, None]
    x, y = np.meshgrid(*((0.7 * s, 1.5 * s) if name == "rectangle" else (0.8 * s, 0.8 * s)))
    places = np.column_stack([x.ravel(), y.ravel()])
    return places if name == "rectangle" else places[np.hypot(*places.T) < 0.8]


@pytest.mark.parametrize("name", SHAPES)
def test_contact_pressure_and_opening_are_those_of_the_plane(name):
    code, d, given = SHAPES[name]
    p = np.zeros(N_PARAMETERS)
    for parameter, value in (given | {"KN": KN}).items():
        p[Parameter[parameter]] = value
    outline, places = outline_of(code, p, d), places_of(name)
    area = AREAS.get(name, 1.0)
    stiffness = 0.5 * KN if name == "springs" else KN / area
    assert outline.area == pytest.approx(area)
    assert outline.stiffness == pytest.approx(stiffness)
    w = np.random.default_rng(3).uniform(-1.0, 1.0, (40, d)) * [*(2e-3, 1e-3)[: d - 1], 1.5e-3]
    w[:6] = 0.0
    w[1, -1], w[2, -1], w[3, 0], w[4, -2] = 1e-3, -1e-3, 1e-3, -1e-3
    w[5, 0], w[5, -1] = 1e-3, 2e-4
    turns = w[:, :1] * places.T if d == 2 else w[:, :1] * places[:, 1] - w[:, 1:2] * places[:, 0]
    opened = w[:, -1:] + turns
    share = outline.share(w)
    np.testing.assert_allclose(share[1:], (opened < 0.0).mean(axis=1)[1:], atol=6e-3)
    assert np.ptp(share) == 1.0
    edge = 2e-5 if name != "springs" else 1e-15
    np.testing.assert_allclose(outline.opening(w), np.maximum(opened.max(axis=1), 0.0), atol=edge)
    pressed = stiffness * np.maximum(-opened.min(axis=1), 0.0)
    np.testing.assert_allclose(outline.pressure(w), pressed, atol=stiffness * edge)

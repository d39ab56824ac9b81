"""Curves and clouds against numpy, on points of unequal distance, in both senses."""

import itertools

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves import algebra
from ssilang.kernel.curves.cloud import Cloud, inverse_distance, moving_plane, on_grid
from ssilang.kernel.curves.curve import Curve, CurvePart

X = np.array([-1.0, 0.3, 0.9, 2.2, 4.0])
Y = np.array([2.0, -1.5, 0.5, 3.0, -2.5])
OTHER = CurvePart(np.array([-0.4, 0.5, 0.9, 5.0]), np.array([1.0, 4.0, -2.0, 3.5]))
PART = CurvePart(X, Y, "TIME", "FORCE", "legend", 3)


def refused(run, code, **data):
    with refusal(FieldError, f"kernel.curves.{code}") as caught:
        run()
    for name, value in data.items():
        assert caught.value.data[name] == value


def test_real_curves_combine_where_both_are():
    two = Curve((PART, OTHER), "title", "REEL")
    swapped = Curve((OTHER, PART))
    found = algebra.combined(two, swapped, "-", np.subtract)
    assert (found.title, len(found.parts)) == ("title", 2)
    x = np.array([-0.4, 0.3, 0.5, 0.9, 2.2, 4.0])
    gap = np.interp(x, X, Y) - np.interp(x, OTHER.abscissas, OTHER.ordinates)
    for part, exact in zip(found.parts, (gap, -gap), strict=True):
        np.testing.assert_array_equal(part.abscissas, x)
        np.testing.assert_allclose(part.ordinates, exact)
    assert (found.parts[0].legend, found.parts[0].colour) == ("legend", 3)
    near = CurvePart(X * (1 + 1e-12), Y + 1.0)
    product = algebra.combined(Curve((PART,)), Curve((near,)), "*", np.multiply)
    np.testing.assert_array_equal(product.parts[0].ordinates, Y * (Y + 1.0))
    np.testing.assert_array_equal(product.parts[0].abscissas, X)
    same = algebra.combined(Curve((PART,)), Curve((near,)), "-", lambda a, b: a - 2 * b)
    np.testing.assert_array_equal(same.parts[0].ordinates, Y - 2 * (Y + 1.0))
    one = Curve((PART,))
    refused(lambda: algebra.combined(two, one, "+", np.add), "objects-curves", n_parts=2,
            n_parts_2=1)  # fmt: skip
    refused(lambda: algebra.combined(one, Curve((OTHER,)), "*", np.multiply),
            "curves-multiplied-same-abscissas")  # fmt: skip
    zero = Curve((CurvePart(X, Y * (X < 4.0)),))
    refused(lambda: algebra.combined(one, zero, "/", np.divide), "ordinate-divisor-zero")
    apart = Curve((CurvePart(np.array([4.1, 5.0]), np.ones(2)),))
    refused(lambda: algebra.combined(one, apart, "+", np.add), "two-curves-no-abscissa")
    touching = Curve((CurvePart(np.array([4.0, 5.0]), np.array([1.0, 2.0])),))
    assert algebra.combined(one, touching, "+", np.add).parts[0].ordinates == pytest.approx([-1.5])


def pair(kind, values):
    names = {"PREE": "PIMA", "MODU": "PHAS"}
    parts = (values.real, values.imag) if kind == "PREE" else (
        np.abs(values), np.degrees(np.angle(values)))  # fmt: skip
    return tuple(
        CurvePart(X, part, kind=k) for part, k in zip(parts, (kind, names[kind]), strict=True)
    )


@together("kinds", [("PREE", "MODU"), ("MODU", "PREE")])
def test_complex_curves_combine_as_complex_numbers(kinds):
    p, q, r, s = np.random.default_rng(4).standard_normal((4, 2, 5)).view(float)
    values = [part[0] + 1j * part[1] for part in (p, q, r, s)]
    a = Curve(pair(kinds[0], values[0]) + pair(kinds[1], values[1]))
    b = Curve(pair(kinds[1], values[2]) + pair(kinds[0], values[3]))
    assert algebra.is_complex(a)
    assert not algebra.is_complex(Curve(a.parts[:3]))
    assert not algebra.is_complex(Curve((*a.parts[:2], PART, PART)))
    assert not algebra.is_complex(Curve(()))
    found = algebra.combined(a, b, "*", np.multiply)
    assert [part.kind for part in found.parts] == [part.kind for part in a.parts]
    for i in (0, 1):
        made = algebra.complex_values(*found.parts[2 * i : 2 * i + 2])
        np.testing.assert_allclose(made, values[i] * values[i + 2], rtol=1e-12)
    named = algebra.combined(Curve(a.parts, "t", "COMPLEXE"), b, "-", np.subtract)
    assert (named.title, named.kind) == ("t", "COMPLEXE")
    for both in ((a, Curve((PART,) * 4)), (Curve((PART,) * 4), a)):
        refused(lambda pair=both: algebra.combined(*pair, "+", np.add), "real-curve-complex-cannot")
    moved = Curve(tuple(CurvePart(X + 1, part.ordinates, kind=part.kind) for part in b.parts))
    refused(lambda: algebra.combined(a, moved, "+", np.add), "complex-curves-must-same")


@together("absolute", [False, True])
def test_integrals_are_those_of_the_polygon(absolute):
    y = np.abs(Y) if absolute else Y
    parts = np.diff(X) * (y[1:] + y[:-1]) / 2
    for first, last in ((0, 4), (1, 3), (2, 2)):
        exact = parts[first:last].sum()
        assert algebra.integral_along(PART, first, last, absolute) == pytest.approx(exact)
        assert algebra.integral_along(PART, last, first, absolute) == pytest.approx(-exact)
    turned = CurvePart(X[::-1], Y[::-1])
    fine = np.linspace(-0.2, 3.1, 20001)
    exact = np.trapezoid(np.interp(fine, X, y), fine)
    for part in (PART, turned):
        assert algebra.integral(part, -0.2, 3.1, absolute) == pytest.approx(exact, rel=1e-6)
        assert algebra.integral(part, 3.1, -0.2, absolute) == pytest.approx(-exact, rel=1e-6)
        assert algebra.integral(part, 0.3, 2.2, absolute) == pytest.approx(parts[1:3].sum())
    loop = CurvePart(np.array([0.0, 2.0, 2.0, 0.0, 0.0]), np.array([1.0, 1.0, 4.0, 4.0, 1.0]))
    assert algebra.integral_along(loop, 0, 4) == pytest.approx(-6.0)
    refused(lambda: algebra.integral(loop, 0.0, 1.0), "abscissas-must-increase-follows", x=0.0,
            x_2=2.0)  # fmt: skip


def test_primitives_and_samples():
    made = algebra.primitive(PART)
    exact = [0.0, *(np.trapezoid(Y[: i + 1], X[: i + 1]) for i in range(1, 5))]
    np.testing.assert_allclose(made.ordinates, exact)
    assert made.legend == "legend"
    at = np.array([-2.0, 0.0, 0.3, 3.0, 9.0])
    np.testing.assert_allclose(algebra.sampled(PART, at), np.interp(at, X, Y))
    back = CurvePart(X[[0, 1, 3, 2]], Y[:4])
    refused(lambda: algebra.sampled(back, at), "abscissas-must-increase-follows", x=0.9, x_2=2.2)
    for order in (slice(None), slice(None, None, -1)):
        found = algebra.interpolated(X[order], Y[order], at)
        np.testing.assert_allclose(found, np.interp(at, X, Y))
    twice = np.array([0.0, 1.0, 1.0, 2.0])
    assert algebra.interpolated(twice, np.arange(4.0), np.array([0.5, 1.5])) == pytest.approx(
        [0.5, 2.5]
    )
    refused(lambda: algebra.interpolated(X, Y[:4], at), "abscissas-ordinates", n_x=5, n_y=4)
    refused(lambda: algebra.interpolated(X[:0], Y[:0], at), "no-point-interpolate-between")
    refused(lambda: algebra.interpolated(np.array([0, 2.0, 1]), Y[:3], at),
            "abscissas-must-increase-decrease")  # fmt: skip
    assert Curve((PART, OTHER)).at(1.4) == pytest.approx(np.interp(1.4, X, Y))


@together("ends", [(None, None), (0.4, None), (None, -1.3), (2.0, 0.7)])
def test_splines_pass_through_their_points_with_the_ends_asked_for(ends):
    h = 1e-4
    for order, at in ((slice(None), 1.0), (slice(None, None, -1), 1.0)):
        x, y = X[order], Y[order]
        np.testing.assert_allclose(algebra.spline(x, y, X, *ends), Y, atol=1e-12)

        def slopes(p, x=x, y=y):
            v = algebra.spline(x, y, p + h * np.array([-2.0, -1, 0, 1, 2]), *ends)
            return (v[3] - v[1]) / (2 * h), (v[3] - 2 * v[2] + v[1]) / h**2

        for wanted, end, inward in ((ends[0], X[0], at), (ends[1], X[-1], -at)):
            first, second = slopes(end + 2 * h * inward)
            assert (second if wanted is None else first) == pytest.approx(wanted or 0.0, abs=2e-2)
        for knot in X[1:-1]:
            assert slopes(knot - h)[1] == pytest.approx(slopes(knot + h)[1], abs=2e-2)
    assert algebra.spline(X[:2], Y[:2], np.array([0.0]), None, None) == pytest.approx(
        np.interp(0.0, X, Y)
    )
    refused(lambda: algebra.spline(X[:1], Y[:1], X, None, None), "spline-needs-two-points", n_x=1)
    refused(lambda: algebra.spline(X, Y[:3], X, None, None), "spline-many-abscissas-values", n_x=5,
            n_y=3)  # fmt: skip
    refused(lambda: algebra.spline(X[[0, 2, 1, 3]], Y[:4], X, None, None),
            "abscissas-spline-must-increase")  # fmt: skip


def test_crossings_are_found_in_their_order():
    x, y = np.array([0.0, 3.0, 1.0, 2.0, 2.0, 5.0]), np.array([0.0, 6.0, 2.0, 9.0, 7.0, 10.0])
    np.testing.assert_allclose(algebra.crossings(x, y, 1.5), [3.0, 3.0 + 0.0, 5.5][1:])
    np.testing.assert_allclose(algebra.crossings(x, y, 2.0), [4.0, 9.0, 7.0])
    np.testing.assert_allclose(algebra.crossings(x, y, 4.0), [9.0])
    assert len(algebra.crossings(x, y, 5.1)) == 0


def test_units_are_kept_by_what_measures_the_same():
    measured = PART.measured("s", "N")
    assert measured.coloured(5).units == ("s", "N")
    assert (measured.coloured(5).colour, measured.colour) == (5, 3)
    assert algebra.primitive(measured).units == ("", "")
    assert PART.units == ("", "")


def test_clouds_join_by_names_and_give_their_rows():
    a = Cloud({"P": (3.0, 1), "Q": ("x", "y")})
    b = Cloud({"Q": ("z",), "P": (7.0,)})
    both = a.joined(b)
    assert both.columns == {"P": (3.0, 1, 7.0), "Q": ("x", "y", "z")}
    assert (len(both), len(Cloud({}))) == (3, 0)
    assert a.joined(Cloud({})) is Cloud({}).joined(a) is a
    assert both.rows([2, 0]).columns == {"P": (7.0, 3.0), "Q": ("z", "x")}
    np.testing.assert_array_equal(both.numbers("P"), [3.0, 1.0, 7.0])
    refused(lambda: a.joined(Cloud({"P": (1.0,)})), "clouds-of-other-components",
            first=["P", "Q"], second=["P"])  # fmt: skip
    refused(lambda: a.numbers("R"), "cloud-no-component", name="R")
    refused(lambda: a.numbers("Q"), "component-cloud-holds-objects", name="Q")


def test_functions_through_clouds():
    rng = np.random.default_rng(5)
    points, at = rng.uniform(-1.0, 1.0, (9, 2)), rng.uniform(-0.8, 0.8, (4, 2))
    values = rng.standard_normal((9, 3))
    for power in (1.0, 3.0):
        found = inverse_distance(points, values, at, power, 1e-9)
        for x, row in zip(at, found, strict=True):
            w = [np.linalg.norm(x - p) ** -power for p in points]
            np.testing.assert_allclose(row, np.average(values, axis=0, weights=w))
    step = points[4] + [3e-3, -4e-3]
    np.testing.assert_array_equal(inverse_distance(points, values, step[None], 2.0, 5.1e-3)[0],
                                  values[4])  # fmt: skip
    assert not np.allclose(inverse_distance(points, values, step[None], 2.0, 4.9e-3)[0], values[4])
    linear = points @ np.array([[1.0, 2.0], [-3.0, 0.5]]) + [0.7, -2.0]
    for gaussian in (False, True):
        found = moving_plane(points, linear, at, gaussian)
        np.testing.assert_allclose(found, at @ np.array([[1, 2], [-3, 0.5]]) + [0.7, -2], rtol=1e-9)
        pairs = itertools.combinations(points, 2)
        mean = np.mean([np.linalg.norm(p - q) for p, q in pairs])
        for x, row in zip(at, moving_plane(points, values, at, gaussian), strict=True):
            r = np.linalg.norm(points - x, axis=1) / mean
            W = np.diag(np.exp(-(r**2)) if gaussian else 1 / (1 + r))
            A = np.column_stack([np.ones(9), points - x])
            np.testing.assert_allclose(row, np.linalg.solve(A.T @ W @ A, A.T @ W @ values)[0])


def test_grids_are_interpolated_with_the_first_axis_fastest():
    axes = [np.array([0.0, 1.0, 4.0]), np.array([-1.0, 0.5]), np.array([2.0])]

    def f(x):
        return 1.0 + 2.0 * x[..., 0] - 3.0 * x[..., 1] + 0.5 * x[..., 0] * x[..., 1]

    grid = [(a, b, c) for c in axes[2] for b in axes[1] for a in axes[0]]
    values = f(np.array(grid))
    at = np.array([[0.2, 0.0, 2.0], [3.0, 0.4, 9.0], [4.0, 0.5, 2.0], [1.0, -1.0, 0.0]])
    np.testing.assert_allclose(on_grid(axes, values, at), f(at))
    outside = np.array([[-2.0, 0.0, 2.0], [9.0, 3.0, 2.0]])
    np.testing.assert_allclose(
        on_grid(axes, values, outside), f(np.clip(outside, [0, -1, 2], [4, 0.5, 2]))
    )
    refused(lambda: on_grid(axes, values[:5], at), "grid-nodes-needs-values", grid="3 x 2 x 1",
            wanted=6, n_values=5)  # fmt: skip
    refused(lambda: on_grid([axes[0][[0, 2, 1]], *axes[1:]], values, at),
            "coordinates-grid-must-increase")  # fmt: skip

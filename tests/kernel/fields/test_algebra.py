"""Sums, products and choices of fields against dictionaries, on supports that overlap in part."""

from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest
from refusing import refusal

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields import cell_algebra as cells
from ssilang.kernel.fields import node_algebra as nodes
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.mesh import CellBlock, same_cells
from ssilang.kernel.mesh.nodes import NodeTable

SEEDS = pytest.mark.parametrize("seed", range(4))


@pytest.fixture
def table():
    made = NodeTable()
    made.add(np.arange(36.0).reshape(12, 3))
    return made


def drawn(table, rng, names, nature="DIFFUS", title=""):
    """A field whose components have each their own nodes and no zero."""
    made = {}
    for name in names:
        ids = np.sort(rng.choice(12, rng.integers(3, 9), replace=False)).astype(np.int64)
        made[name] = NodeValues(
            ids, rng.uniform(0.5, 2.0, len(ids)) * rng.choice([-1, 1], len(ids))
        )
    return NodeField(table, made, nature, title)


def told(field):
    return {
        (name, int(n)): float(v)
        for name, part in field.components.items()
        for n, v in zip(part.nodes, part.values, strict=True)
    }


def assert_is(field, expected):
    found = told(field)
    assert found == pytest.approx(expected)
    assert all((np.diff(part.nodes) > 0).all() for part in field.components.values())


@SEEDS
def test_sums_of_node_fields(table, seed):
    rng = np.random.default_rng(seed)
    a = drawn(table, rng, ("UY", "UX"), title="mine")
    b = drawn(table, rng, ("UX", "RZ"), "DISCRET")
    wanted = defaultdict(float, told(a))
    for key, value in told(b).items():
        wanted[key] += -1.7 * value
    found = nodes.added(a, b, -1.7)
    assert_is(found, dict(wanted))
    assert (found.nature, found.title) == ("DISCRET", "mine")
    assert list(found.components) == ["UY", "UX", "RZ"]
    nothing = NodeField(table, {}, "")
    assert nodes.added(nothing, b).nature == nodes.added(b, nothing).nature == "DISCRET"
    assert nodes.common_nature("", "DIFFUS") == nodes.common_nature("DISCRET", "") == ""
    same = nodes.added(a, nodes.applied(a, np.square), 2.0)
    assert_is(same, {k: v + 2 * v**2 for k, v in told(a).items()})


@SEEDS
def test_products_of_node_fields(table, seed):
    rng = np.random.default_rng(seed)
    a = drawn(table, rng, ("UY", "UX"), title="a")
    s = drawn(table, rng, ("SCAL",), "DISCRET", "s")
    b, factor = drawn(table, rng, ("UX", "UY")), told(s)

    def by_scalar(run):
        return {(k, n): run(v, factor["SCAL", n]) for (k, n), v in told(a).items()
                if ("SCAL", n) in factor}  # fmt: skip

    assert_is(nodes.multiplied(a, s), by_scalar(lambda x, y: x * y))
    assert_is(nodes.multiplied(s, a), by_scalar(lambda x, y: x * y))
    assert_is(nodes.multiplied(a, s, divide=True), by_scalar(lambda x, y: x / y))
    for first, second, title in ((a, s, "a"), (s, a, "a"), (a, b, "a"), (b, a, "")):
        assert nodes.multiplied(first, second).title == title
    assert nodes.multiplied(a, s).nature == "DISCRET"
    cube = nodes.multiplied(nodes.applied(a, lambda x: x**4), a, divide=True)
    assert_is(cube, {k: v**3 for k, v in told(a).items()})
    two = told(b)
    assert_is(nodes.multiplied(a, b), {k: v * two[k] for k, v in told(a).items() if k in two})
    quotient = nodes.multiplied(a, b, divide=True)
    assert_is(quotient, {k: v / two[k] for k, v in told(a).items() if k in two})
    zero = nodes.applied(b, lambda x: np.where(np.arange(len(x)) == 1, 0.0, x))
    nodes.multiplied(a, zero)
    for wrong, code in ((lambda: nodes.multiplied(a, zero, divide=True), "field-divide-zero"),
                        (lambda: nodes.multiplied(s, a, divide=True), "field-field-not-defined"),
                        (lambda: nodes.multiplied(a, drawn(table, rng, ("UX", "RZ"))),
                         "field-field-not-defined")):  # fmt: skip
        with refusal(FieldError, f"kernel.fields.{code}"):
            wrong()


@SEEDS
def test_products_of_node_fields_by_names(table, seed):
    rng = np.random.default_rng(seed)
    a, b = drawn(table, rng, ("UX", "UY", "UZ"), title="a"), drawn(table, rng, ("FX", "FY", "FZ"))
    x, y = told(a), told(b)
    pairs = (
        ("UX", "RX", "UY", "UZ", "UY"),
        ("FZ", "FX", "FX", "FY", "MX"),
        ("P", "R", "Q", "P", "P"),
    )
    for divide, run in ((False, np.multiply), (True, np.divide)):
        wanted = defaultdict(float)
        for left, right, name in zip(*pairs, strict=True):
            for n in range(12):
                if (left, n) in x and (right, n) in y:
                    wanted[name, n] += run(x[left, n], y[right, n])
        found = nodes.multiplied_by_names(a, b, pairs, divide)
        assert_is(found, dict(wanted))
        assert found.title == "a"
    total = defaultdict(float)
    for left, right in (("UX", "FY"), ("UZ", "FX")):
        for n in range(12):
            if (left, n) in x and (right, n) in y:
                total[n] += x[left, n] * y[right, n]
    found = nodes.scalar_product(a, b, ("UX", "UZ", "RX", "UY"), ("FY", "FX", "FX", "MX"))
    assert dict(zip(found.nodes.tolist(), found.values, strict=True)) == pytest.approx(dict(total))


@SEEDS
def test_parts_and_unions_of_node_fields(table, seed):
    rng = np.random.default_rng(seed)
    a, b = drawn(table, rng, ("UX", "UY"), title="t"), drawn(table, rng, ("UY", "RZ"))
    x, y = told(a), told(b)
    chosen = rng.choice(12, 5)
    assert_is(nodes.restricted(a, chosen), {k: v for k, v in x.items() if k[1] in chosen})
    assert_is(nodes.renamed(a, ["UX"], ["RX"]), {(k.replace("UX", "RX"), n): v
                                                 for (k, n), v in x.items()})  # fmt: skip
    wanted = defaultdict(float)
    for (_, n), v in x.items():
        wanted["UY", n] += v
    assert_is(nodes.renamed(a, ["UX"], ["UY"]), dict(wanted))
    assert nodes.renamed(a, ["UX"], ["RX"]).title == "t"
    met = {k for k in x if k in y}
    assert_is(nodes.united(a, b, check=False), y | x)
    if met:
        with refusal(FieldError, "kernel.fields.component-field-node") as caught:
            nodes.united(a, b)
        key = min(met)
        assert (caught.value.data["values"], caught.value.data["values_2"]) == (x[key], y[key])
    close = nodes.applied(a, lambda v: v * (1 + 4e-7))
    assert told(nodes.united(a, close)) == x
    apart = NodeField(table, {"UX": a.components["UX"]}, "DISCRET")
    second = NodeField(table, {"RZ": b.components["RZ"]}, "DISCRET")
    assert list(nodes.united(apart, second).components) == ["UX", "RZ"]
    nothing = NodeField(table, {}, "DISCRET")
    assert told(nodes.united(a, nothing)) == told(nodes.united(nothing, a)) == x
    assert nodes.values_in_order(a, (), None).tolist() == []
    lumps = [NodeField(table, f.components, "DISCRET") for f in (a, b)]
    assert_is(nodes.united(*lumps), {k: x.get(k, 0.0) + y.get(k, 0.0) for k in x | y})
    with refusal(FieldError, "kernel.fields.fields-natures-cannot-joined"):
        nodes.united(a, lumps[1])
    at = rng.permutation(12)
    expected = [x.get((k, n), 0.0) for k in ("UY", "RZ", "UX") for n in at.tolist()]
    np.testing.assert_array_equal(nodes.values_in_order(a, ("UY", "RZ", "UX"), at), expected)
    np.testing.assert_array_equal(
        nodes.values_in_order(a, ("UY", "RZ"), None), a.components["UY"].values
    )
    np.testing.assert_array_equal(a.node_ids, sorted({n for _, n in x}))
    np.testing.assert_array_equal(a.values_at("UX", at, 7.0), [x.get(("UX", n), 7.0) for n in at])
    np.testing.assert_array_equal(a.values_at("RX", at, 7.0), 7.0)
    assert nodes.component(a, "UY") is a.components["UY"]
    with refusal(FieldError, "kernel.fields.field-no-component"):
        nodes.component(a, "RZ")
    order = rng.permutation(12)
    v = rng.standard_normal(12)
    mixed = NodeField.of(table, order, {"T": v})
    assert told(mixed) == {("T", int(n)): u for n, u in zip(order, v, strict=True)}


@pytest.mark.parametrize("nature", ["DISCRET", "DIFFUS"])
def test_operations_see_nodes_that_became_one(table, nature):
    rng = np.random.default_rng(9)
    a, b = (drawn(table, rng, names, nature) for names in (("UX", "UY"), ("UY", "RZ")))
    kept = {7: 2, 9: 5}
    for part in [*a.components.values(), *b.components.values()]:
        for gone, stays in kept.items():
            if nature == "DIFFUS" and {gone, stays} <= set(part.nodes.tolist()):
                part.values[part.nodes == gone] = part.values[part.nodes == stays]

    def met(field):
        made = {}
        for (name, n), v in told(field).items():
            key = name, kept.get(n, n)
            made[key] = v + made.get(key, 0.0) if nature == "DISCRET" else v
        return made

    x, y = met(a), met(b)
    table.merge(np.array([2, 5]), np.array([7, 9]))
    assert_is(a, x)
    assert_is(nodes.added(a, b), {k: x.get(k, 0.0) + y.get(k, 0.0) for k in x | y})
    assert_is(nodes.restricted(a, np.array([2, 3, 5])),
              {k: v for k, v in x.items() if k[1] in (2, 3, 5)})  # fmt: skip
    assert_is(nodes.multiplied(a, a), {k: v * v for k, v in x.items()})
    if nature == "DIFFUS":
        assert_is(nodes.united(a, b, check=False), y | x)


# --- fields in cells: zones of three, two and four cells, one of two points a cell


@pytest.fixture
def zones(table):
    rows = [[[0, 1], [1, 2], [2, 3]], [[3, 4], [4, 5]], [[5, 6], [6, 7], [7, 8], [8, 9]]]
    return [CellBlock.make(table, "SEG2", np.array(r)) for r in rows]


def of_cells(rng, zones, names, points=2, support="STRESSES", title="", constituent=""):
    blocks = tuple(
        CellFieldBlock(
            zone, {n: rng.uniform(0.5, 2.0, (len(zone), points)) for n in names}, support, "BARR",
            constituent,
        )
        for zone in zones
    )  # fmt: skip
    return CellField(blocks, title)


def values(field):
    return {
        (tuple(b.cells.raw[:, 0].tolist()), name): v
        for b in field.blocks
        for name, v in b.components.items()
    }


def assert_equal(found, expected):
    found = values(found)
    assert found.keys() == expected.keys()
    for key, value in expected.items():
        np.testing.assert_allclose(found[key], value, rtol=1e-13, err_msg=str(key))


@pytest.mark.parametrize("factor", [-1.7, 1.0, 2.0])
def test_sums_of_cell_fields(table, zones, factor):
    rng = np.random.default_rng(1)
    a = of_cells(rng, zones[:2], ("B", "A"), title="mine")
    b = of_cells(rng, [zones[2], zones[1]], ("A", "C"), points=1, support="GRAVITE", title="other")
    x, y = values(a), values(b)
    wanted = dict(x)
    for key, value in y.items():
        wanted[key] = wanted[key] + factor * value if key in wanted else factor * value
    found = cells.added(a, b, factor)
    assert_equal(found, wanted)
    assert found.title == "mine"
    assert [b.support for b in found.blocks] == ["STRESSES", "STRESSES", "GRAVITE"]
    assert cells.added(b, a).blocks[1].support == "STRESSES"
    assert cells.added(CellField(()), b).title == "other"
    apart = of_cells(rng, zones[:1], ("A",), constituent="STEEL")
    assert len(cells.added(a, apart).blocks) == 3  # the same cells, another body
    elsewhere = of_cells(rng, zones[:1], ("A",), points=3, support="MASSE")
    with refusal(FieldError, "kernel.fields.component-stands-field") as caught:
        cells.added(a, elsewhere)
    assert caught.value.data == {"name": "A", "support": "STRESSES", "support_2": "MASSE"}
    copy = CellBlock.make(table, "SEG2", zones[0].raw.copy())
    assert same_cells(copy, zones[0])
    assert not same_cells(CellBlock.make(table, "SEG2", zones[0].raw[::-1]), zones[0])
    assert not same_cells(zones[0], zones[1])
    four = [CellBlock.make(table, kind, np.array([[0, 1, 2, 3]])) for kind in ("QUA4", "TET4")]
    assert not same_cells(*four)


def test_products_of_cell_fields(zones):
    rng = np.random.default_rng(2)
    a = of_cells(rng, zones[:2], ("B", "A"), title="a")
    x = values(a)
    s = of_cells(rng, zones[::-1], ("SCAL",), points=1)
    y = {zone: v for (zone, _), v in values(s).items()}
    assert_equal(cells.multiplied(a, s), {k: v * y[k[0]] for k, v in x.items()})
    assert_equal(cells.multiplied(a, s, divide=True), {k: v / y[k[0]] for k, v in x.items()})
    two = of_cells(rng, zones[:2], ("SCAL",))
    assert_equal(cells.multiplied(two, a),
                 {k: v * values(two)[k[0], "SCAL"] for k, v in x.items()})  # fmt: skip
    b = of_cells(rng, zones[1::-1], ("A", "B"))
    assert_equal(cells.multiplied(a, b), {k: v * values(b)[k] for k, v in x.items()})
    one, other = of_cells(rng, zones[:2], ("P",)), of_cells(rng, zones[:2], ("Q",))
    assert_equal(
        cells.multiplied(a, other), {k: v * values(other)[k[0], "Q"] for k, v in x.items()}
    )
    assert_equal(cells.multiplied(one, other, divide=True),
                 {k: v / values(other)[k[0], "Q"] for k, v in values(one).items()})  # fmt: skip
    zero = cells.applied(b, lambda v: v * (np.arange(v.shape[1]) > 0), ["A"])
    assert_equal(zero, {k: v * ([0, 1] if k[1] == "A" else 1) for k, v in values(b).items()})
    for wrong, code in (
        (lambda: cells.multiplied(a, zero, divide=True), "field-divide-zero"),
        (lambda: cells.multiplied(s, a), "zone-first-field-not"),
        (lambda: cells.multiplied(two, a, divide=True), "cells-field-by-field-not-defined"),
        (lambda: cells.multiplied(a, of_cells(rng, zones[:2], ("A", "C"))),
         "cells-field-by-field-not-defined"),
    ):  # fmt: skip
        with refusal(FieldError, f"kernel.fields.{code}"):
            wrong()
    names = (("A", "B", "A", "Z"), ("SCAL", "SCAL", "SCAL", "SCAL"), ("P", "Q", "P", "R"))
    for divide in (False, True):
        found = cells.multiplied_by_names(a, two, names, divide, (2.0, 3.0, 5.0, 7.0))
        wanted = {}
        for zone in {k for k, _ in x}:
            f = values(two)[zone, "SCAL"]
            for name, parts in (("P", (("A", 2.0), ("A", 5.0))), ("Q", (("B", 3.0),))):
                wanted[zone, name] = sum(
                    x[zone, n] / f / w if divide else x[zone, n] * f * w for n, w in parts
                )
        assert_equal(found, wanted)
        assert found.title == "a"
    assert cells.multiplied(a, s).title == "a"
    part = cells.multiplied_by_names(a, CellField(two.blocks[1:]), names)
    assert [len(b.cells) for b in part.blocks] == [2]


def test_parts_and_unions_of_cell_fields(zones):
    rng = np.random.default_rng(3)
    a = of_cells(rng, zones[:2], ("B", "A"), title="mine")
    b = of_cells(rng, zones[1:], ("C",), points=1)
    assert_equal(cells.united(a, b), values(a) | values(b))
    assert cells.united(a, b).title == cells.united(replace(b, title=""), a).title == "mine"
    close = cells.applied(a, lambda v: v * (1 + 4e-7))
    assert_equal(cells.united(a, close), values(a))
    with pytest.raises(FieldError) as caught:
        cells.united(a, cells.applied(a, lambda v: v * (1 + 4e-6), ["A"]))
    assert (caught.value.code, caught.value.data) == (
        "kernel.fields.component-differs-between-two", {"name": "A"},
    )  # fmt: skip
    fewer = CellField(tuple(cells.rebuilt(z, {"A": z.components["A"][:, :1]}) for z in a.blocks))
    with refusal(FieldError, "kernel.fields.component-differs-between-two"):
        cells.united(a, fewer)
    both = cells.united(a, b)
    assert cells.component_names(both) == ["B", "A", "C"]
    x = values(both)
    found = cells.extracted(both, ("C", "A"), ("K", "L"))
    assert_equal(found, {(z, {"C": "K", "A": "L"}[n]): v for (z, n), v in x.items() if n != "B"})
    assert len(cells.extracted(both, ("A",), ("A",)).blocks) == 2
    with pytest.raises(FieldError) as caught:
        cells.extracted(both, ("D",), ("D",))
    assert caught.value.data == {"name": "D", "known": ["B", "A", "C"]}
    assert cells.extracted(both, ("D",), ("D",), check=False).blocks == ()
    renamed = cells.renamed(both, ("A",), ("Z",))
    assert_equal(renamed, {(z, n.replace("A", "Z")): v for (z, n), v in x.items()})
    assert [v.shape for v in cells.values_of(both, ("C", "A"))] == [(3, 2), (2, 2), (2, 1), (4, 1)]
    held = CellField((cells.rebuilt(a.blocks[0], {"O": np.array([["p"], ["q"], ["p"]], object)}),))
    assert cells.values_of(held) == []
    number = CellField((cells.rebuilt(a.blocks[0], {"O": np.array([[2.0], [3.0], [5.0]])}),))
    for wrong in (lambda: cells.applied(held, abs), lambda: cells.added(held, held),
                  lambda: cells.added(number, held), lambda: cells.multiplied(number, held),
                  lambda: cells.multiplied(held, number)):  # fmt: skip
        with refusal(FieldError, "kernel.fields.component-holds-objects-not"):
            wrong()
    told_by = cells.applied(held, np.vectorize(str.upper), objects=True)
    assert told_by.blocks[0].components["O"].ravel().tolist() == ["P", "Q", "P"]
    for sign, run in (("+", lambda *p: cells.added(*p[:2], objects=p[2])),
                      ("-", lambda *p: cells.added(*p[:2], -1.0, p[2])),
                      ("*", lambda *p: cells.multiplied(*p[:2], False, p[2])),
                      ("/", lambda *p: cells.multiplied(*p[:2], True, p[2]))):  # fmt: skip
        for first, second in ((held, number), (number, held), (held, held)):
            found = run(first, second, lambda s, p, q: f"{p}{s}{q}").blocks[0].components["O"]
            pairs_of = zip(
                *(f.blocks[0].components["O"].ravel() for f in (first, second)), strict=True
            )
            assert found.ravel().tolist() == [f"{p}{sign}{q}" for p, q in pairs_of]
    for kind in (float, int, np.float32, bool):
        y, taken = np.array([[2, 0, 2]], kind), []
        rule = lambda sign, p, q: f"{p}{sign}{taken.append(q) or q}"  # noqa: B023, E731
        found = cells.of_objects("*", np.array([["p"], ["q"]], object), y, rule)
        assert found.tolist() == [[f"{p}*{q}" for q in y[0]] for p in "pq"]
        assert len(taken) == 4
    assert cells.united(held, held).blocks[0].components["O"].shape == (3, 1)
    with refusal(FieldError, "kernel.fields.component-differs-between-two"):
        cells.united(number, held)


def test_each_cell_has_the_curve_of_its_own_values(zones):
    """At points, and of one value where a field has no more; equal ones are one object."""
    rng, x = np.random.default_rng(6), [-1.0, 0.5, 2.0]
    fields = [of_cells(rng, zones[:2], ("A",), n) for n in (2, 1, 2)]
    for field in fields:
        for block in field.blocks:
            block.components["A"][-1] = block.components["A"][0]
    found = cells.through("T", x, fields)
    for block, *of in zip(found.blocks, *(f.blocks for f in fields), strict=True):
        made = block.components["A"]
        rows = np.stack(np.broadcast_arrays(*(b.components["A"] for b in of)), axis=-1)
        assert made.shape == rows.shape[:2]
        for place in np.ndindex(made.shape):
            (part,) = made[place].parts
            assert (part.abscissa_name, part.ordinate_name) == ("T", "A")
            np.testing.assert_array_equal([part.abscissas, part.ordinates], [x, rows[place]])
        assert (made[-1] == made[0]).all()
    two, fewer = of_cells(rng, zones[:2], ("A", "B")), of_cells(rng, zones[:1], ("A",))
    moved = CellField(tuple(replace(b, support="MASSE") for b in fields[0].blocks))
    for at, given, code in (
        ([0.0, 0.0], fields[:2], "curves.abscissas-must-increase-follows"),
        ([0.0, 1.0], [fields[0], two], "fields.curves-of-one-component"),
        ([0.0, 1.0], [fields[0], fewer], "fields.curves-of-other-cells"),
        ([0.0, 1.0], [fields[0], moved], "fields.curves-of-other-cells"),
    ):
        with refusal(FieldError, f"kernel.{code}"):
            cells.through("T", at, given)

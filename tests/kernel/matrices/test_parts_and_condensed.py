"""Matrices made, taken apart and condensed, against dense ones summed term by term."""

import itertools
from collections import defaultdict
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from references.assembled import Bench
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError, KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices import build, by_hand, condensation, imposed, submatrices
from ssilang.kernel.matrices import superelement as supers
from ssilang.kernel.matrices.assembly import (
    assemble,
    constraint_matrix,
    numbering_of,
    vector_to_field,
)
from ssilang.kernel.matrices.build import matrix_from_sparse
from ssilang.kernel.matrices.impedance import factors, impedance
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

NAMES = ("UY", "UX")  # not in the order of the alphabet
DUAL = {"UX": "FX", "UY": "FY", "RZ": "MZ", "LX": "FLX"}


def terms(matrix):
    """Sums of element terms by ((node, equation), (node, unknown))."""
    found = defaultdict(float)
    for b in matrix.blocks:
        for nodes, values in zip(b.nodes[:, b.local], b.values, strict=True):
            for i, d in enumerate(b.duals):
                for j, u in enumerate(b.unknowns):
                    found[(int(nodes[i]), d), (int(nodes[j]), u)] += values[i, j]
    return {k: v for k, v in found.items() if v != 0.0}


def body(seed=1, symmetric=True, conditions=True):
    """Five nodes, two unlike blocks of elements, a tie of three terms and one of two."""
    rng, bench = np.random.default_rng(seed), Bench()
    nodes = [bench.node(*x) for x in rng.uniform(0.0, 3.0, (5, 2))]
    blocks = []
    for pairs in ([[0, 1], [3, 1], [2, 4]], [[4, 0], [2, 3]]):
        values = rng.standard_normal((len(pairs), 4, 4))
        if symmetric:
            values = values @ np.swapaxes(values, 1, 2) + 0.3 * np.eye(4)
        raw = np.array([[nodes[i] for i in p] for p in pairs])
        blocks.append(ElementMatrices(
            bench.table, raw, np.array([0, 1, 0, 1]), (*NAMES[:1] * 2, *NAMES[1:] * 2),
            ("FY", "FY", "FX", "FX"), values, "RIGIDITE", None, symmetric,
        ))  # fmt: skip
    if conditions:
        bench.relate([(2.0, "UX", nodes[3]), (-1.5, "UY", nodes[0]), (0.7, "UX", nodes[1])])
        bench.relate([(1.0, "UY", nodes[2]), (3.0, "UY", nodes[4])])
    return Matrix(bench.table, tuple(blocks), tuple(bench.relations))


def dense(matrix, like=None):
    """K, C of a matrix on a numbering, without `assemble`, and places of unknowns."""
    n = numbering_of(like or matrix)
    place = {(int(a), n.name(i)): i for i, a in enumerate(n.nodes)}
    equation = {(a, DUAL.get(u, u)): i for (a, u), i in place.items()}
    K = np.zeros((n.size, n.size))
    for (row, column), value in terms(matrix).items():
        K[equation[row], place[column]] = value
    rows = [row for r in matrix.relations for row in range(len(r))]
    C = np.zeros((len(rows), n.size))
    k = 0
    for r in matrix.relations:
        for i in range(len(r)):
            for t in range(r.row_start[i], r.row_start[i + 1]):
                C[k, place[int(r.nodes[t]), r.unknowns[t]]] += r.coefficients[t]
            k += 1
    return K, C, n, place


def near(found, expected, tolerance=1e-10):
    np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * np.abs(expected).max())


@pytest.mark.parametrize("symmetric", [True, False])
def test_relations_leave_the_work_of_the_motions_that_they_allow(symmetric):
    matrix = body(symmetric=symmetric)
    K, C, n, place = dense(matrix)
    near(assemble(matrix).toarray(), K)
    near(constraint_matrix(matrix).C.toarray(), C)
    small = condensation.condensed_by_relations(matrix, matrix)
    k, _, m, _ = dense(small)
    kept = [place[int(a), m.name(i)] for i, a in enumerate(m.nodes)]
    gone = np.setdiff1d(np.arange(n.size), kept)
    assert len(gone) == 2
    T = np.zeros((n.size, len(kept)))
    T[kept] = np.eye(len(kept))
    T[gone] = -np.linalg.solve(C[:, gone], C[:, kept])
    near(k, T.T @ K @ T)
    assert all(b.symmetric == symmetric for b in small.blocks)
    of, back = condensation.dependence(matrix)
    for made, exact, names in ((of, T, "UX"), (back, T.T, "FX")):
        A = np.zeros((n.size, n.size))
        at = {(a, u if names == "UX" else DUAL[u]): i for (a, u), i in place.items()}
        for (row, column), value in terms(made).items():
            A[at[row], at[column]] = value
        wide = np.zeros((n.size, n.size))
        if names == "UX":
            wide[:, kept] = exact
        else:
            wide[kept] = exact
        near(A, wide)
    again = condensation.condensed_by_relations(Matrix(matrix.table, matrix.blocks), of)
    assert terms(again).keys() == terms(small).keys()
    near([terms(again)[key] for key in terms(small)], list(terms(small).values()))
    weights = np.random.default_rng(3).uniform(1.0, 2.0, n.size)
    for dual in (False, True):
        given = vector_to_field(weights, n, dual=dual)
        S, _, marks, _ = dense(condensation.condensed_on_multipliers(matrix, given))
        assert marks.unknowns == ("LX",)
        near(S, C @ np.diag(weights) @ C.T)
    weights[place[1, "UX"]] = 0.0
    with refusal(FieldError, "kernel.matrices.diagonal-field-no-value") as caught:
        condensation.condensed_on_multipliers(matrix, vector_to_field(weights, n))
    assert caught.value.data["label"].data["name"] == "UX"
    with refusal(FieldError, "kernel.matrices.condensed-without-relations"):
        condensation.condensed_by_relations(matrix, body(conditions=False))


@pytest.mark.parametrize("inside", [True, False])
def test_a_condensed_body_is_the_body_that_its_masters_feel(inside):
    matrix = body()
    K, C, n, place = dense(matrix)
    rng = np.random.default_rng(5)
    rows = constraint_matrix(matrix)
    forces, d = rng.standard_normal(n.size), rng.standard_normal(2)
    load = vector_to_field(forces, n, dual=True)
    imposed_at = NodeValues(*(x[np.argsort(rows.multipliers)] for x in (rows.multipliers, d)))
    load = NodeField(load.table, {**load.components, "FLX": imposed_at}, "DISCRET")
    if inside:
        chosen = np.array([1, 4])
    else:
        chosen = NodeField.of(matrix.table, np.array([1]), {"UY": np.ones(1), "RZ": np.ones(1)})
    element = supers.condense(matrix, chosen, inside)
    held = element.masters
    if inside:
        np.testing.assert_array_equal(held, np.flatnonzero(np.isin(n.nodes, chosen)))
    else:
        expected = {place[1, "UY"], *np.flatnonzero((C != 0).any(axis=0))}
        assert set(held.tolist()) == expected
        assert held[element.asked].tolist() == [place[1, "UY"]]
    R = np.eye(n.size)[held]
    ties = np.vstack([C, R]) if inside else R
    zero = np.zeros((len(ties), len(ties)))
    system = np.block([[K, ties.T], [ties, zero]])
    count = len(ties) - len(held)

    def solved(f, values):
        return np.linalg.solve(system, np.concatenate([f, values]))

    units = np.array([solved(0 * forces, np.eye(len(ties))[count + i]) for i in range(len(held))])
    shapes = units[:, : n.size].T
    near(element.shapes, shapes)
    k = dense(element.stiffness, matrix)[0]
    near(k[np.ix_(held, held)], shapes.T @ K @ shapes)
    assert np.count_nonzero(k) <= len(held) ** 2
    assert element.stiffness.relations == (() if inside else matrix.relations)
    q = rng.standard_normal(len(held))
    whole = np.zeros(n.size)
    whole[held] = q
    motion = vector_to_field(whole, n)
    exact = solved(forces, np.concatenate([d[:count], q]))
    found = supers.inner_displacement(element, motion, load)
    for (node, name), i in place.items():
        near(found.values_at(name, np.array([node])), exact[i])
    if inside:
        near(found.values_at("LX", rows.multipliers), exact[n.size : n.size + 2])
    free = supers.inner_displacement(element, motion)
    for (node, name), i in place.items():
        near(free.values_at(name, np.array([node])), (shapes @ q)[i], 1e-9)
    still = solved(forces, np.concatenate([d[:count], 0 * q]))[: n.size]
    pushed = supers.condensed_load(element, load)
    expected = shapes.T @ (forces - K @ still)
    for i, at in enumerate(held):
        near(pushed.values_at(DUAL[n.name(at)], n.nodes[[at]]), expected[i])
    assert ("FLX" in pushed.components) is not inside
    alone = NodeField.of(load.table, np.array([1]), {"UX": np.ones(1)})
    one = supers.condense(body(conditions=False), alone, False)
    felt = supers.condensed_load(one, vector_to_field(forces, n, dual=True))
    assert set(felt.components) == {"FX"}
    M = body(seed=8, conditions=False)
    unit = supers.unit_shapes(element)
    if not inside:  # the others follow by least energy under the conditions
        a, b = element.asked, np.setdiff1d(np.arange(len(held)), element.asked)
        Kc, Cc = shapes.T @ K @ shapes, C[:, held]
        saddle = np.block([[Kc[np.ix_(b, b)], Cc[:, b].T], [Cc[:, b], np.zeros((2, 2))]])
        follow = np.linalg.solve(saddle, -np.vstack([Kc[np.ix_(b, a)], Cc[:, a]]))
        unit_exact = shapes[:, a] + shapes[:, b] @ follow[: len(b)]
        near(unit, unit_exact)
    mass = dense(supers.condensed_mass(element, M), matrix)[0]
    asked = held[element.asked]
    near(mass[np.ix_(asked, asked)], unit.T @ dense(M, matrix)[0] @ unit)
    assert len(supers.shape_fields(element)) == len(asked)
    with refusal(KernelError, "kernel.matrices.none-master-unknowns-unknown"):
        supers.condense(matrix, np.array([99]), inside)


@pytest.mark.parametrize("symmetric", [True, False, "first"])
def test_parts_of_a_matrix_are_its_terms(symmetric):
    matrix = body(symmetric=symmetric is True)
    if symmetric == "first":
        values = matrix.blocks[0].values
        first = replace(matrix.blocks[0], values=values + values.mT, symmetric=True)
        matrix = replace(matrix, blocks=(first, *matrix.blocks[1:]), cache={})
    kept = [sum(not b.symmetric for b in matrix.blocks), 2]
    first, second = matrix.relations
    first, second = replace(first, dual=second), replace(second, sense=np.array([1], np.int8))
    matrix = replace(matrix, relations=(first, second), cache={})
    all_terms = terms(matrix)
    for sign in (1.0, -1.0):
        part = submatrices.symmetric_part(matrix, sign)
        K, exact = dense(part, matrix)[0], dense(matrix)[0]
        near(K, 0.5 * (exact + sign * exact.T))
        assert len(part.relations) == (2 if sign > 0 else 0)
        assert [b.symmetric for b in part.blocks] == [sign > 0] * kept[sign > 0]
    for primal in ("", "UX", "UY LX", "UX UY", "RZ LX"):
        for dual in ("", "FX", "FY", "FX FY FLX", "MZ"):
            columns, rows = set(primal.split()), set(dual.split())
            part = submatrices.named_part(matrix, columns, rows)
            assert terms(part) == pytest.approx(
                {k: v for k, v in all_terms.items() if k[0][1] in rows and k[1][1] in columns}
            )
            assert len(part.relations) == (2 if "LX" in primal or "FLX" in dual else 0)
            alike = symmetric and (primal, dual) in (
                ("UX", "FX"),
                ("UX UY", "FX FY FLX"),
                ("UY LX", "FY"),
            )
            assert symmetric == "first" or all(b.symmetric == alike for b in part.blocks)
            assert len(part.blocks) == 2 * bool({"UX", "UY"} & columns and {"FX", "FY"} & rows)
    mesh = Mesh.of(matrix.table, "SEG2", np.array([[1, 3], [0, 4], [0, 3]]))
    part = submatrices.on_mesh(matrix, mesh)
    assert [b.nodes.tolist() for b in part.blocks] == [[[3, 1]], [[4, 0]]]
    assert [len(r) for r in part.relations] == [1]  # the other tie has node 2
    np.testing.assert_array_equal(part.blocks[0].values, matrix.blocks[0].values[1:2])
    diagonal = submatrices.diagonal(matrix)
    for (node, name), i in dense(matrix)[3].items():
        near(diagonal.values_at(name, np.array([node])), dense(matrix)[0][i, i])
    points = submatrices.multiplier_nodes(matrix)
    np.testing.assert_array_equal(diagonal.components["LX"].nodes, points)
    (one,) = submatrices.multiplier_nodes(matrix, unilateral=True)
    assert one == second.multipliers[0]
    assert submatrices.unknown_names(matrix) == ["UY", "UX", "LX"]
    assert submatrices.unknown_names(matrix, dual=True) == ["FY", "FX", "FLX"]
    np.testing.assert_array_equal(submatrices.relation_nodes(matrix), [0, 1, 2, 3, 4])
    other = submatrices.renamed(matrix, {"UX": "T"}, {"FY": "Q"}, False)
    moved = {((a, d.replace("FY", "Q")), (b, u.replace("UX", "T"))): v
             for ((a, d), (b, u)), v in all_terms.items()}  # fmt: skip
    assert terms(other) == pytest.approx(moved)
    assert other.relations[0].unknowns == ("T", "UY", "T")
    twice = submatrices.together(
        Matrix(matrix.table, (), matrix.relations, "MASSE"), matrix, matrix
    )
    assert terms(twice) == pytest.approx({k: 2 * v for k, v in all_terms.items()})
    assert (len(twice.relations), twice.kind) == (2, "RIGIDITE")
    own = submatrices.with_own_multipliers(matrix)
    assert not set(submatrices.multiplier_nodes(own)) & set(points)
    assert own.relations[0].dual.multipliers.tolist() == own.relations[0].multipliers.tolist()
    assert own.relations[1].dual is None
    assert [r.coefficients.tolist() for r in own.relations] == [
        r.coefficients.tolist() for r in matrix.relations
    ]
    assert terms(matrix.scaled(-2.5)) == pytest.approx({k: -2.5 * v for k, v in all_terms.items()})


@together("kept", [[0, 1, 2], [1], [0, 2], []])
def test_rows_on_a_mesh_are_whole_rows_of_unequal_terms(kept):
    """Those whose nodes are all in it, or whose multiplier is; they push where they pushed."""
    rng, bench = np.random.default_rng(7), Bench()
    for x in rng.uniform(0.0, 1.0, (9, 2)):
        bench.node(*x)
    starts, names = np.array([0, 3, 4, 6]), ("UX", "UY", "RZ", "UY", "UX", "RZ")
    C, D = (
        Relations(bench.table, starts, np.array([2, 4, 0, 1, 5, 3]), unknowns,
                  rng.standard_normal(6), np.array([8, 6, 7]), np.array([0, 1, -1], np.int8))
        for unknowns in (names, names[::-1])
    )  # fmt: skip
    rows = replace(C, dual=D)
    places = [n for k in kept for n in ([0, 2, 4], [6], [3, 5])[k]]
    mesh = Mesh.of(bench.table, "POI1", np.array(places, np.int64).reshape(-1, 1))
    part = submatrices.on_mesh(Matrix(bench.table, (), (rows,)), mesh)
    if not kept:
        assert part.relations == ()
        return
    (found,) = part.relations
    for new, old in ((found, C), (found.dual, D)):
        assert new.raw_multipliers.tolist() == old.raw_multipliers[kept].tolist()
        assert new.sense.tolist() == old.sense[kept].tolist()
        for row, k in enumerate(kept):
            mine, own = slice(*new.row_start[row : row + 2]), slice(*starts[k : k + 2])
            for name in ("raw_nodes", "unknowns", "coefficients"):
                assert list(getattr(new, name)[mine]) == list(getattr(old, name)[own])
        assert len(new.unknowns) == len(new.coefficients) == new.row_start[-1]


def test_sparse_matrices_become_elements_and_come_back():
    for symmetric in (True, False):
        K, _, n, _ = dense(body(symmetric=symmetric))
        K[np.abs(K) < 0.4] = 0.0
        made = matrix_from_sparse(sp.csr_array(K), n, "MASSE", symmetric)
        near(dense(made, body())[0], K)
        assert made.kind == "MASSE"


def test_impedances_are_those_of_complex_numbers():
    K, M, C = (body(seed, conditions=False) for seed in (1, 2, 3))
    w = 1.7
    names = zip(("RAIDEUR", "MASSE", "AMORTISSEMENT"), (K, M, C), strict=True)
    parts = [impedance(A, factors(kind, w), "IMPEDANCE") for kind, A in names]
    whole = defaultdict(float)
    for part in parts:
        for key, value in terms(part).items():
            whole[key] += value
    Z = dense(K)[0] + 1j * w * dense(C, K)[0] - w**2 * dense(M, K)[0]
    place = dense(K)[3]
    rng = np.random.default_rng(4)
    z = rng.standard_normal(len(place)) + 1j * rng.standard_normal(len(place))
    f = defaultdict(float)
    for (row, (node, name)), value in whole.items():
        i = place[node, name[-2:]]
        f[row] += value * (z[i].imag if name[0] == "I" else z[i].real)
    for (node, name), i in place.items():
        found = f[node, DUAL[name]] + 1j * f[node, "I" + DUAL[name]]
        near(found, (Z @ z)[i])
    swirled = replace(C, blocks=tuple(
        replace(b, unknowns=tuple({"UX": "UT"}.get(u, u) for u in b.unknowns)) for b in C.blocks
    ))  # fmt: skip
    plain, turned = (
        terms(impedance(swirled, factors("AMORTISSEMENT", w), "IMPEDANCE", turned=turn))
        for turn in (False, True)
    )
    assert turned == {k: -x if k[1][1].endswith("UT") else x for k, x in plain.items()}
    assert turned != plain == {(k[0], (k[1][0], k[1][1].replace("UX", "UT"))): x
                               for k, x in terms(parts[2]).items()}  # fmt: skip
    held = impedance(body(), factors("RAIDEUR", w), "IMPEDANCE")
    assert [r.unknowns for r in held.relations] == [
        ("UX", "UY", "UX"), ("UY", "UY"), ("IUX", "IUY", "IUX"), ("IUY", "IUY"),
    ]  # fmt: skip
    assert len(submatrices.multiplier_nodes(held)) == 4
    with refusal(KernelError, "kernel.matrices.conditions-only-doubled-raideur"):
        impedance(body(), factors("MASSE", w), "IMPEDANCE")


def test_matrices_written_by_hand():
    low = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    for sign in (1.0, -1.0):
        exact = [[1, sign * 2, sign * 4], [2, 3, sign * 5], [4, 5, 6]]
        for rows in ([low], [low[:1], low[1:3], low[3:]]):
            np.testing.assert_array_equal(by_hand.square(rows, 3, sign), exact)
    full = np.arange(9.0)
    for rows in ([full], [full[:3], full[3:6], full[6:]]):
        np.testing.assert_array_equal(by_hand.square(rows, 3, None), full.reshape(3, 3))
    for rows, sign, wanted in (([low], None, [9]), ([low[:5]], 1.0, [9, 6]),
                               ([full[:2], full[2:]], 1.0, [9, 6])):  # fmt: skip
        with pytest.raises(FieldError) as caught:
            by_hand.square(rows, 3, sign)
        assert caught.value.data["wanted"] == wanted
    table = NodeTable()
    table.add(np.arange(8.0).reshape(4, 2))
    given = NodeField(table, {
        "UX": NodeValues(np.array([0, 2]), np.array([3.0, 4.0])),
        "FY": NodeValues(np.array([1, 2]), np.array([5.0, 6.0])),
    })  # fmt: skip
    own = (2, "UX"), (2, "FX")
    usual, other = {"UX": ("UX", "FX"), "FY": ("UY", "FY")}, {"UX": ("UX", "FX"), "FY": ("T", "FY")}
    made = NodeField(table, {"UX": given.components["UX"], "SUM": given.components["FY"]})
    new = {"UX": ("UX", "FX"), "SUM": ("T", "SUM")}
    for meant, names, field in (
        (usual, None, given), (usual, {}, given), (other, {"FY": "T"}, given),
        (new, {"SUM": "T"}, made),
    ):  # fmt: skip
        for row, sign in itertools.product((False, True), (None, 1.0, -1.0)):
            wanted = {}
            for name, part in field.components.items():
                unknown, equation = meant[name]
                for node, value in zip(part.nodes.tolist(), part.values, strict=True):
                    first, second = (own[1], (node, unknown)), ((node, equation), own[0])
                    if not row:
                        first, second = second, first
                    wanted[first] = value
                    if sign is not None and (node, unknown) != own[0]:
                        wanted[second] = sign * value
            found = by_hand.column(field, 2, "UX", "FX", "MASSE", sign, row, names)
            assert {found.kind, *(b.kind for b in found.blocks)} == {"MASSE"}
            assert terms(found) == wanted
            assert all(b.symmetric == (sign == 1.0) for b in found.blocks)
    columns = [NodeField.of(table, np.array([3, 1]), {"ALFA": np.array([i, 2.0 * i + 1])})
               for i in (1.0, 5.0)]  # fmt: skip
    found = by_hand.from_columns(table, np.array([3, 1]), columns, "MASSE")
    assert terms(found) == {
        ((3, "FALF"), (3, "ALFA")): 1.0, ((1, "FALF"), (3, "ALFA")): 3.0,
        ((3, "FALF"), (1, "ALFA")): 5.0, ((1, "FALF"), (1, "ALFA")): 11.0,
    }  # fmt: skip
    assert not found.blocks[0].symmetric


def test_matrices_of_no_element():
    rng, table = np.random.default_rng(6), NodeTable()
    x = rng.uniform(0.0, 2.0, (6, 3))
    table.add(x)
    at = np.array([4, 1])
    made = build.nodal_diagonal(table, at, {"UY": np.array([2.0, 3.0]), "RZ": np.array([5.0, 7])},
                                "MASSE")  # fmt: skip
    diagonal = {(4, "UY"): 2.0, (1, "UY"): 3.0, (4, "RZ"): 5.0, (1, "RZ"): 7.0}
    assert terms(made) == {((n, DUAL[u]), (n, u)): v for (n, u), v in diagonal.items()}
    fields = []
    for names in (("UX", "FY"), ("UY", "MZ")):
        parts = {n: NodeValues(np.sort(rng.choice(6, 3, replace=False)), rng.standard_normal(3))
                 for n in names}  # fmt: skip
        fields.append(NodeField(table, parts))
    primal = {"FY": "UY", "MZ": "RZ"}
    vectors = [{(int(n), primal.get(k, k)): v for k, p in f.components.items()
                for n, v in zip(p.nodes, p.values, strict=True)} for f in fields]  # fmt: skip
    made = build.field_diagonal(fields[0], "RIGIDITE")
    assert terms(made) == {((n, DUAL[u]), (n, u)): v for (n, u), v in vectors[0].items()}
    wanted = defaultdict(float)
    for vector, factor in zip(vectors, (2.0, -0.5), strict=True):
        for (a, u), v in vector.items():
            for (b, w), z in vector.items():
                wanted[(a, DUAL[u]), (b, w)] += factor * v * z
    assert terms(build.sum_of_outer_products(fields, [2.0, -0.5], "MASSE")) == pytest.approx(wanted)
    with pytest.raises(FieldError) as caught:
        build.sum_of_outer_products(fields, [1.0], "MASSE")
    assert caught.value.data == {"n_fields": 2, "n_factors": 1}
    lines = Mesh.of(table, "SEG2", np.array([[2, 5], [1, 0]]))
    cables = build.cable_stiffness(lines, 3, 70.0, 2.0)
    u = 1e-3 * rng.standard_normal((6, 3))
    names = ("UX", "UY", "UZ")
    energy = sum(v * u[a, "XYZ".index(d[1])] * u[b, names.index(w)]
                 for ((a, d), (b, w)), v in terms(cables).items())  # fmt: skip
    exact = 0.0
    for a, b in ((2, 5), (1, 0)):
        length, along = np.linalg.norm(x[b] - x[a]), x[b] - x[a]
        exact += 70.0 / 0.02 * length * ((u[b] - u[a]) @ along / length**2) ** 2
    assert energy == pytest.approx(exact)
    matrix = rng.standard_normal((3, 3))
    made = build.repeated_matrix(lines, [("UX", "RZ"), ("UY",)], [("A", "B"), ("C",)], matrix,
                                 "RIGIDITE", False)  # fmt: skip
    rows = [[(2, "A"), (2, "B"), (5, "C")], [(1, "A"), (1, "B"), (0, "C")]]
    columns = [[(2, "UX"), (2, "RZ"), (5, "UY")], [(1, "UX"), (1, "RZ"), (0, "UY")]]
    wanted = {(r[i], c[j]): matrix[i, j] for r, c in zip(rows, columns, strict=True)
              for i in range(3) for j in range(3)}  # fmt: skip
    assert terms(made) == wanted
    lumped = terms(build.lumped_matrix(made, ("RZ",)))
    sums = [matrix[0].sum(), matrix[1, 1], matrix[2].sum()]
    assert lumped == pytest.approx({(r[i], c[i]): sums[i]
                                    for r, c in zip(rows, columns, strict=True)
                                    for i in range(3)})  # fmt: skip
    for given, n_forces in (([("UX",)], 2), ([("UX", "UY"), ("UX",), ("UX",)], None)):
        with pytest.raises(FieldError) as caught:
            build.repeated_matrix(lines, given, None, matrix, "RIGIDITE", True)
        assert caught.value.data.get("n_forces") == n_forces
    weights = NodeField.of(table, np.array([5, 0, 3, 2]), {"W": np.array([1.0, 2.0, 4.0, 0.5])})
    for radius, power, least in ((1.1, 1.0, 0.0), (1.6, 2.0, 0.1), (0.0, 1.0, 0.0)):
        at = [0, 2, 3, 5]
        w = weights.values_at("W", np.array(at))
        d = la.norm(x[at][:, None] - x[at][None], axis=2)
        share = np.eye(4) if radius == 0.0 else np.maximum(1 - d / radius, 0.0) ** power
        share = share * w
        share /= share.sum(axis=1, keepdims=True)
        share[share <= least] = 0.0
        found = terms(build.filter_weights(weights, radius, power, least, "T", "Q"))
        wanted = {
            ((at[i], "Q"), (at[j], "T")): share[i, j]
            for i, j in zip(*np.nonzero(share), strict=True)
        }
        assert found == pytest.approx(wanted)


def test_values_of_conditions_come_by_row():
    bench = Bench()
    nodes = [bench.node(*x) for x in ((1.0, 5.0), (2.0, 7.0), (4.0, 11.0))]
    bench.relate([(2.0, "UX", nodes[1])])
    bench.relate([(-3.0, "UY", nodes[0])])
    held = bench.relations
    marks = [int(r.multipliers[0]) for r in held]
    everywhere = imposed.imposed_uniform((*held, held[0]), 1.5).components["FLX"]
    assert (everywhere.nodes.tolist(), everywhere.values.tolist()) == (sorted(marks), [1.5, 1.5])
    given = NodeField(bench.table, {"UX": NodeValues(np.array(nodes), np.array([1.0, 2.0, 3.0])),
                                    "RZ": NodeValues(np.array(nodes), np.ones(3))})  # fmt: skip
    found = imposed.imposed_from_field(held, given).components["FLX"]
    assert (found.nodes.tolist(), found.values.tolist()) == ([marks[0]], [4.0])
    with pytest.raises(FieldError) as caught:
        imposed.imposed_from_field(held[1:], given)
    assert caught.value.data["held"] == ("UY",)
    bench.relate([(1.0, "UY", nodes[2]), (2.0, "UX", nodes[0]), (9.0, "RZ", nodes[1])])
    bench.relate([(1.0, "UX", nodes[1]), (4.0, "UY", nodes[1])])
    with refusal(FieldError, "kernel.matrices.field-values-fits-conditions") as caught:
        imposed.imposed_from_field(bench.relations, given)
    gaps = imposed.geometric_gaps(bench.stiffness).components["FLX"]
    marks = [int(r.multipliers[0]) for r in bench.relations]
    found = dict(zip(gaps.nodes.tolist(), gaps.values.tolist(), strict=True))
    assert found == dict(zip(marks, [-4.0, 15.0, -13.0, -30.0], strict=True))
    scalar = NodeField.of(
        bench.table, np.array([nodes[1], nodes[0]]), {"SCAL": np.array([6.0, 8.0])}
    )
    one_node = [*bench.relations[:2], bench.relations[3]]
    found = imposed.imposed_by_node(one_node, scalar).components["FLX"]
    assert dict(zip(found.nodes.tolist(), found.values.tolist(), strict=True)) == dict(
        zip((marks[0], marks[1], marks[3]), (6.0, 8.0, 6.0), strict=True)
    )
    for relations, field, code in ((bench.relations, scalar, "rela-fits-relations-between"),
                                   (one_node, given, "rela-wants-field-component")):  # fmt: skip
        with refusal(FieldError, f"kernel.matrices.{code}"):
            imposed.imposed_by_node(relations, field)

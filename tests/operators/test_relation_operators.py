"""Conditions as scripts write them: BLOQ, RELA, DEPI, SYMT, ANTI, APPU, solved by RESO."""

import numpy as np
import pytest
from script_runs import failed, finder, refused
from script_runs import found as objects

from ssilang.kernel.matrices.assembly import constraint_matrix, numbering_of

PLANE = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P0 = 0. 0. ; P1 = 1. 0. ; P2 = 2. 0. ;\n"
SPACE = "OPTI DIME 3 MODE TRID ELEM SEG2 ; P0 = 0. 0. 0. ; P1 = 1. 0. 0. ; P2 = 0. 1. 0. ;\n"


def rows(matrix):
    """Each row as {label: coefficient}, and the senses."""
    numbering = numbering_of(matrix)
    C = constraint_matrix(matrix, numbering)
    return (
        [
            {
                (numbering.unknowns[numbering.codes[j]], int(numbering.nodes[j])): float(v)
                for j, v in zip(C.C[[i]].indices, C.C[[i]].data, strict=True)
            }
            for i in range(len(C.sense))
        ],
        C.sense.tolist(),
    )


def test_blocked_unknowns_by_name_list_and_group():
    for words in ("'UX' 'UY'", "(MOTS 'UX' 'UY')", "'DEPL'", "UX UY"):
        held, _ = rows(objects(PLANE + f"B = BLOQ {words} (P0 ET P1) ;", "B"))
        assert sorted(next(iter(r)) for r in held) == [("UX", 0), ("UX", 1), ("UY", 0), ("UY", 1)]
    held, _ = rows(objects(SPACE + "B = BLOQ P0 'DEPL' 'ROTA' ;", "B"))
    assert sorted(next(iter(r))[0] for r in held) == ["RX", "RY", "RZ", "UX", "UY", "UZ"]


def test_axisymmetric_groups_name_the_radial_unknowns():
    script = "OPTI DIME 2 MODE AXIS ; P0 = 1. 0. ; B = BLOQ 'DEPL' 'ROTA' P0 ;"
    held, _ = rows(objects(script, "B"))
    assert sorted(next(iter(r))[0] for r in held) == ["RT", "UR", "UZ"]


def test_direction_is_made_of_length_one_and_keeps_the_sense():
    held, sense = rows(objects(PLANE + "B = BLOQ 'MAXI' 'DEPL' 'DIRE' (3. 4.) P1 ;", "B"))
    assert held == [pytest.approx({("UX", 1): 0.6, ("UY", 1): 0.8})]
    assert sense == [-1]


def test_radial_and_orthoradial_directions_in_space_and_plane():
    script = PLANE + "P3 = 3. 4. ; B = BLOQ 'RADI' P0 P3 ; O = BLOQ 'ORTHO' P0 P3 ;"
    radial, across = objects(script, "B", "O")
    assert rows(radial)[0][0] == pytest.approx({("UX", 3): 0.6, ("UY", 3): 0.8})
    assert rows(across)[0][0] == pytest.approx({("UX", 3): -0.8, ("UY", 3): 0.6})
    script = SPACE + "P3 = 3. 4. 5. ; PZ = 0. 0. 1. ; B = BLOQ 'RADIAL' P0 PZ P3 ;"
    assert sorted(abs(v) for v in rows(objects(script, "B"))[0][0].values()) == [0.6, 0.8]


def test_sum_with_signs_numbers_and_one_node_for_all():
    script = PLANE + (
        "L1 = DROI 2 (0. 1.) (2. 1.) ; L2 = DROI 2 (0. 2.) (2. 2.) ; C1 = 3. ;"
        "R = RELA 'MINI' 2.5 UX L1 - UY L2 + C1 UX P0 ;"
    )
    relation, upper, lower = objects(script, "R", "L1", "L2")
    found, sense = rows(relation)
    assert sense == [1, 1, 1]
    for row, a, b in zip(found, upper.node_ids, lower.node_ids, strict=True):
        assert row == {("UX", a): 2.5, ("UY", b): -1.0, ("UX", 0): 3.0}


def test_negative_numbers_start_a_term():
    found, _ = rows(objects(PLANE + "R = RELA 1. 'UX' P0 -2. 'UX' P1 - -3. 'UY' P1 ;", "R"))
    assert found == [{("UX", 0): 1.0, ("UX", 1): -2.0, ("UY", 1): 3.0}]


def test_terms_along_directions_and_on_all_displacements():
    script = PLANE + "R = RELA 2 DEPL DIRECTION (0. -5.) P0 - DEPL DIRE (1. 0.) P1 ;"
    assert rows(objects(script, "R"))[0] == [{("UY", 0): -2.0, ("UX", 1): -1.0}]
    found, _ = rows(objects(PLANE + "R = RELA DEPL P0 - DEPL P1 ;", "R"))
    assert found == [{("UX", 0): 1.0, ("UX", 1): -1.0}, {("UY", 0): 1.0, ("UY", 1): -1.0}]


def test_a_term_without_mesh_is_an_error_at_the_operator():
    result = failed(PLANE + "R = RELA 'UX' P0 - 'UX' ;")
    assert "Traceback" not in result.message


def test_imposed_values_by_number_and_by_field():
    script = PLANE + (
        "B1 = BLOQ 'UX' (P0 ET P1) ; F1 = DEPI B1 0.5 ;"
        "F2 = DEPI B1 (MANU 'CHPO' (P0 ET P1) 1 'UX' (PROG 1. 2.)) ;"
    )
    block, same, each = objects(script, "B1", "F1", "F2")
    points = block.relations[0].multipliers
    np.testing.assert_allclose(same.values_at("FLX", points), 0.5)
    np.testing.assert_allclose(each.values_at("FLX", points), [1.0, 2.0])


def test_symmetry_holds_across_and_antisymmetry_within():
    script = PLANE + (
        "PA = 0. 0. ; PB = 0. 1. ; L1 = DROI 2 PA PB ; L2 = DROI 2 PB (1. 1.) ;"
        "S = SYMT 'DEPL' 'ROTA' PA PB (L1 ET L2) 1.E-3 ;"
        "A = ANTI 'DEPL' PA PB (L1 ET L2) 1.E-3 ;"
    )
    mirror, opposite = objects(script, "S", "A")
    assert sorted(k[0] for r in rows(mirror)[0] for k in r) == ["RZ"] * 3 + ["UX"] * 3
    assert [k[0] for r in rows(opposite)[0] for k in r] == ["UY"] * 3


def test_rigid_body_keeps_its_shape_under_a_couple():
    script = PLANE + (
        "L1 = DROI 3 (0. 1.) (3. 1.) ; R = RELA 'CORI' 'DEPL' (P0 ET P2 ET L1) ;"
        "K = (APPU 'UX' 'UY' 5. (P0 ET P2 ET L1)) ET R ; U = RESO K (FORC 'FY' 1. P2) ;"
    )
    u = objects(script, "U")
    nodes = u.components["UX"].nodes
    table = u.table.coordinates[nodes]
    ux, uy = u.components["UX"].values, u.components["UY"].values
    design = np.zeros((2 * len(nodes), 3))
    design[: len(nodes), 0] = design[len(nodes) :, 1] = 1.0
    design[: len(nodes), 2], design[len(nodes) :, 2] = -table[:, 1], table[:, 0]
    fit, *_ = np.linalg.lstsq(design, np.concatenate([ux, uy]), rcond=None)
    np.testing.assert_allclose(design @ fit, np.concatenate([ux, uy]), atol=1e-12)
    assert abs(fit[2]) > 1e-3


def test_hooked_node_follows_the_line_and_a_sliding_one_only_across():
    base = PLANE + "L1 = DROI 1 P0 P2 ; PM = 0.5 0. ; PN = 1.5 0. ; L2 = DROI 1 PM PN ;\n"
    found, _ = rows(objects(base + "R = RELA PM 'ACCRO' L1 ;", "R"))
    assert found[0] == pytest.approx({("UX", 3): 1.0, ("UX", 0): -0.75, ("UX", 2): -0.25})
    assert len(found) == 2
    found, _ = rows(objects(base + "R = RELA L2 'GLISSANT' L1 ;", "R"))
    assert len(found) == 2
    assert found[0] == pytest.approx({("UY", 3): 1.0, ("UY", 0): -0.75, ("UY", 2): -0.25})


def test_relation_with_its_own_reaction_field():
    # u1 <= 1 kept by a force at the end of the bar (a remote control)
    script = (
        "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; PG = 0. 0. ; PC = 1. 0. ; PD = 3. 0. ;"
        "L1 = (DROI 1 PG PC) ET (DROI 1 PC PD) ; MO = MODE L1 'MECANIQUE' 'ELASTIQUE' 'BARR' ;"
        "MA = MATE MO 'YOUN' 1. 'NU' 0. 'SECT' 1. ;"
        "K = (RIGI MO MA) ET (BLOQ 'UX' PG) ET (BLOQ 'UY' L1) ; FO = FORC 'FX' -1. PD ;"
        "R = RELA 'MAXI' (MANU 'CHPO' PC 1 'UX' 1.) 'DUAL' FO ;"
        "U = RESO (K ET R) ((DEPI R 1.) ET (FORC 'FX' 2. PD)) ;"
    )
    u, relation = objects(script, "U", "R")
    multiplier = relation.relations[0].multipliers
    assert u.values_at("UX", [1])[0] == pytest.approx(1.0)
    assert u.values_at("UX", [2])[0] == pytest.approx(3.0)
    assert u.values_at("LX", multiplier)[0] == pytest.approx(1.0)


def test_rigid_body_with_rotations_carries_solid_nodes_along():
    script = PLANE + (
        "L1 = DROI 2 (0. 1.) (2. 1.) ; R = RELA 'CORI' 'DEPL' 'ROTA' (P0 ET P1) L1 ;"
        "K = R ET (APPU 'UX' 'UY' 'RZ' 1. P0) ; U = RESO K (MOME 'MZ' 2. P1) ;"
    )
    u, line = objects(script, "U", "L1")
    for node in (1, *line.node_ids):
        x, y, _ = u.table.coordinates[node]
        assert u.values_at("UX", [node])[0] == pytest.approx(-2.0 * y)
        assert u.values_at("UY", [node])[0] == pytest.approx(2.0 * x)
    assert u.values_at("RZ", [1])[0] == pytest.approx(2.0)


def test_a_flat_rigid_body_is_told_to_turn_about_a_centre_and_does():
    block = (
        "OPTI DIME 3 MODE TRID ELEM CUB8 ; B = (DROI 2 (0 0 0) (2 0 0)) TRAN 2 (0 2 0) ; "
        "V = B VOLU 'TRAN' 1 (0 0 1) ; M = MODE V 'MECANIQUE' 'ELASTIQUE' ; C = 1. 1. 0. ; "
    )
    assert "RELA 'CORI' 'DEPL' 'ROTA' C1 GEO1" in refused(block + "R = RELA 'CORI' 'DEPL' B ;")
    found = finder(
        block + "R = RELA 'CORI' 'DEPL' 'ROTA' C B ; H = BLOQ 'DEPL' 'RX' 'RZ' C ; "
        "T = BLOQ 'RY' C ; K = (RIGI M (MATE M 'YOUN' 1. 'NU' 0.)) ET R ET H ET T ; "
        "U = RESO K (DEPI T 0.1) ; A = EXTR U 'UZ' (V POIN 'PROC' (2 0 0)) ; "
        "Z = EXTR U 'UX' (V POIN 'PROC' (2 0 1)) ; S = MAXI (ABS (SIGM M (MATE M 'YOUN' 1. 'NU' "
        "0.) U)) ;"
    )
    assert found("A") == pytest.approx(-0.1)  # the angle times the arm
    assert found("Z") == pytest.approx(0.1)
    assert abs(found("S")) < 1e-12

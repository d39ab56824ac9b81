"""Modal operators as scripts use them: VIBR, NNOR, PJBA, RECO, PSMO, JEU, OSCI, SPO, VALP."""

import numpy as np
import pytest
from script_runs import found as objects
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.fields.node_algebra import applied
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.operators.modal.recombination import ratio

TWO_MASSES = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P1 = 0. 0. ; P2 = 1. 0. ;
L1 = DROI 1 P1 P2 ; MO = MODE L1 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
MA = MATE MO 'YOUN' 3. 'NU' 0. 'SECT' 1. ;
K1 = (RIGI MO MA) ET (APPU 'UX' 2. P1) ET (BLOQ 'UY' (P1 ET P2)) ;
M1 = MANU 'RIGI' 'TYPE' 'MASSE' (P1 ET P2) (MOTS 'UX') (PROG 0.5) ;
"""
K = np.array([[5.0, -3.0], [-3.0, 3.0]])
FREQUENCIES = np.sqrt(np.linalg.eigvalsh(K) / 0.5) / (2.0 * np.pi)


def mode(table, i):
    return table.get("MODES").get(i)


@together("words", ["'PROCHE' (PROG 0. 9.)", "'PROC' (PROG 0.1) (LECT 2)", "'SIMUL' 0. 2",
              "'INTER' 0. 10.", "'IRAM' 0.2 2 'LM'"])  # fmt: skip
def test_every_method_finds_both_modes(words):
    table = objects(TWO_MASSES + f"T = VIBR {words} K1 M1 ;", "T")
    assert table.subtype == "BASE_MODALE"
    modes = table.get("MODES")
    assert modes.subtype == "BASE_DE_MODES"
    assert len(modes) == 4  # SOUSTYPE, MAILLAGE and two modes
    found = [modes.get(i).get("FREQUENCE") for i in (1, 2)]
    np.testing.assert_allclose(found, FREQUENCIES, rtol=1e-12)
    assert [modes.get(i).get("NUMERO_MODE") for i in (1, 2)] == [1, 2]
    assert modes.get(1).get("POINT_REPERE").node != modes.get(2).get("POINT_REPERE").node


@together("ends, told", [("3. 10.", True), ("0. 10.", False), ("-1. 0.", True)])
def test_an_interval_without_a_mode_is_told(ends, told):
    result = ran(f"{TWO_MASSES} T = VIBR 'INTE' {ends} K1 M1 ; N = DIME (T . 'MODES') ;")
    assert (
        any(w.code == "operators.modal.no-frequency-between" for w in result.session.warnings)
        is told
    )


FREE_BODIES = {
    "OPTI DIME 3 MODE TRID ELEM SEG2 ; L = DROI 2 (0. 0. 0.) (1. 0. 0.) ; M = MODE L MECANIQUE "
    "POUT ; A = MATE M YOUN 2.E11 NU 0.3 RHO 1400. SECT 0.01 INRY 1.E-5 INRZ 3.E-5 TORS 4.E-5 ;": 6,
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = (DROI 3 (0. 0.) (2. 1.)) TRAN 2 (0. 1.) ; M = MODE "
    "L MECANIQUE ; A = MATE M YOUN 7.E10 NU 0.2 RHO 2500. ;": 3,
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = (DROI 30 (0. 0.) (2. 1.)) TRAN 9 (0. 1.) ; M = "
    "MODE L MECANIQUE ; A = MATE M YOUN 7.E10 NU 0.2 RHO 2500. ;": 3,
}


@together("ends", ["0. 1.", "0. 300.", "-1. 0.", "0.1 300."])
@together("body", FREE_BODIES)
def test_an_interval_has_the_free_motions_at_its_edge(body, ends):
    """Whose eigenvalues rounding puts on either side of zero."""
    table = objects(f"{body} T = VIBR 'INTE' {ends} (RIGI M A) (MASS M A) ;", "T").get("MODES")
    found = [table.get(i).get("FREQUENCE") for i in range(1, len(table) - 1)]
    assert found == ([] if ends[2] == "1" else [0.0] * FREE_BODIES[body])


def test_damped_structure_wants_iram_and_gives_complex_entries():
    damped = TWO_MASSES + "C1 = CHAN 'TYPE' (0.2 * M1) 'AMORTISS' ;"
    assert run_text(damped + "T = VIBR 'SIMU' 0. 1 K1 M1 C1 ;").exit_code == 1
    table = objects(damped + "T = VIBR 'IRAM' 0.4 2 K1 M1 C1 ;", "T")
    w, xi = 2.0 * np.pi * FREQUENCIES, 0.2 / (4.0 * np.pi * FREQUENCIES)
    real = [mode(table, i).get("FREQUENCE_REELLE") for i in (1, 2)]
    np.testing.assert_allclose(real, FREQUENCIES * np.sqrt(1.0 - xi**2))
    lost = [mode(table, i).get("FREQUENCE_IMAGINAIRE") for i in (1, 2)]
    np.testing.assert_allclose(lost, w * xi / (2.0 * np.pi))
    # near zero the mirror images - conj (f) are as near: four modes, by real part
    table = objects(damped + "T = VIBR 'IRAM' 0.01 4 K1 M1 C1 ;", "T")
    mirrored = [mode(table, i).get("FREQUENCE_REELLE") for i in (1, 2, 3, 4)]
    np.testing.assert_allclose(mirrored, [-real[1], -real[0], real[0], real[1]])


def test_unit_shapes_by_largest_value_and_by_mass():
    script = TWO_MASSES + (
        "T = VIBR 'SIMU' 0. 2 K1 M1 ; T1 = NNOR 'EUCL' T M1 ;"
        "U = MANU 'CHPO' P1 2 'UX' 4. 'UY' -8. ; U1 = NNOR U ; U2 = NNOR U 'SANS' (MOTS 'UY') ;"
    )
    unit, u1, u2 = objects(script, "T1", "U1", "U2")
    for i in (1, 2):
        x = mode(unit, i).get("DEFORMEE_MODALE").components["UX"].values
        assert 0.5 * x @ x == pytest.approx(1.0)
        assert mode(unit, i).get("MASSE_GENERALISEE") == pytest.approx(1.0)
        along = mode(unit, i).get("DEPLACEMENTS_GENERALISES").get(1)
        assert along == pytest.approx(0.5 * x.sum())
    assert u1.components["UY"].values[0] == -1.0
    assert u2.components["UX"].values[0] == 1.0


def test_projection_diagonalises_and_recombination_gives_the_solution_back():
    script = TWO_MASSES + (
        "T = VIBR 'SIMU' 0. 2 K1 M1 ; KP = PJBA K1 T ; F = FORC 'FX' 1.5 P2 ; FP = PJBA F T ;"
        "Q = RESO KP FP ; U = RECO Q T ; W = RESO K1 F ;"
    )
    projected, u, w = objects(script, "KP", "U", "W")
    values = projected.blocks[0].values[0]
    assert abs(values[0, 1]) < 1e-12 * values[0, 0]
    for name in ("UX", "UY"):
        nodes = w.components[name].nodes
        np.testing.assert_allclose(u.values_at(name, nodes), w.values_at(name, nodes), atol=1e-12)


def test_pseudo_mode_of_a_moved_support():
    script = TWO_MASSES + (
        "BL = BLOQ 'UX' P1 ; KB = K1 ET BL ; T = VIBR 'SIMU' 0. 1 KB M1 ;"
        "P = PSMO KB (T . 'MODES') 'SEISME' (DEPI BL 0.01) ; S = P . 1 . 'DEPLACEMENT' ;"
    )
    # the only mode follows the whole static motion of the free mass
    rest = objects(script, "S")
    np.testing.assert_allclose(rest.values_at("UX", np.array([0, 1])), [0.01, 0.0], atol=1e-12)


def test_gap_of_two_points_is_closed_not_crossed():
    script = (
        "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; P2 = 0. 0.3 ;"
        "R = RELA 'MINI' 'UY' P2 - 'UY' P1 ;"
        "K = R ET (BLOQ 'DEPL' P1) ET (APPU 'UX' 'UY' 10. P2) ;"
        "U1 = RESO K ((JEU R) ET (FORC 'FY' -8. P2)) ;"
        "U2 = RESO K ((JEU R) ET (FORC 'FY' -2. P2)) ;"
    )
    pressed, apart = objects(script, "U1", "U2")
    assert pressed.values_at("UY", np.array([1]))[0] == pytest.approx(-0.3)
    assert apart.values_at("UY", np.array([1]))[0] == pytest.approx(-0.2)


def test_harmonic_response_on_real_and_imaginary_parts():
    script = TWO_MASSES + (
        "C1 = CHAN 'TYPE' (APPU 'UX' 0.7 P1) 'AMORTISS' ; W1 = 1.3 ;"
        "Z = (IMPE K1) ET (IMPE M1 W1) ET (IMPE C1 W1 'AMOR') ;"
        "U = RESO Z (MANU 'CHPO' P2 2 'FX' 2. 'IFX' -1. 'NATURE' 'DISCRET') ;"
    )
    u = objects(script, "U")
    w = 1.3
    Z = K - w**2 * 0.5 * np.eye(2) + 1j * w * np.diag([0.7, 0.0])
    exact = np.linalg.solve(Z, [0.0, 2.0 - 1.0j])
    nodes = np.array([0, 1])
    np.testing.assert_allclose(u.values_at("UX", nodes), exact.real, rtol=1e-10)
    np.testing.assert_allclose(u.values_at("IUX", nodes), exact.imag, rtol=1e-10)
    np.testing.assert_allclose(u.values_at("IUY", nodes), 0.0, atol=1e-14)


def test_complex_modes_of_a_projected_system_are_couples_with_physical_shapes():
    script = TWO_MASSES + (
        "T = VIBR 'SIMU' 0. 2 K1 M1 ; C1 = CHAN 'TYPE' (APPU 'UX' 0.7 P1) 'AMORTISS' ;"
        "B1 = VIBC (PJBA M1 T) (PJBA K1 T) (PJBA C1 T) T ;"
        "B2 = VIBC (PJBA M1 T) (PJBA K1 T) (PJBA C1 T) T 1 ;"
    )
    every, first = objects(script, "B1", "B2")
    modes = every.get("MODES")
    assert len(modes) == 6
    assert every.get("CONVERGENCE") is True
    assert len(first.get("MODES")) == 4
    C = np.diag([0.7, 0.0])
    for i in range(1, 5):
        entry = modes.get(i)
        assert entry.subtype == "MODE_COMPLEXE"
        f = complex(entry.get("FREQUENCE_REELLE"), entry.get("FREQUENCE_IMAGINAIRE"))
        w = 2.0 * np.pi * f
        parts = [entry.get(f"DEFORMEE_MODALE_{p}") for p in ("REELLE", "IMAGINAIRE")]
        x, y = (p.values_at("UX", np.array([0, 1])) for p in parts)
        residual = (K + 1j * w * C - w**2 * 0.5 * np.eye(2)) @ (x + 1j * y)
        assert np.abs(residual).max() < 1e-9
    real = [modes.get(i).get("FREQUENCE_REELLE") for i in range(1, 5)]
    assert real[0] == pytest.approx(-real[1])
    assert real[2] == pytest.approx(-real[3])


def test_modal_matrices_are_those_of_the_projection():
    script = TWO_MASSES + (
        "T = VIBR 'SIMU' 0. 2 K1 M1 ; KM = RIGI T ; KP = PJBA K1 T ; MM = MASS (T . 'MODES') ;"
        "MP = PJBA M1 T ; CM = AMOR T (PROG 5. 2.) ; DK = EXTR KM 'DIAG' ; EK = EXTR KP 'DIAG' ;"
        "DM = EXTR MM 'DIAG' ; EM = EXTR MP 'DIAG' ; DC = EXTR CM 'DIAG' ;"
    )
    dk, ek, dm, em, dc = (
        f.components["ALFA"].values for f in objects(script, "DK", "EK", "DM", "EM", "DC")
    )
    np.testing.assert_allclose(dk, ek)
    np.testing.assert_allclose(dm, em)
    np.testing.assert_allclose(dc, 2.0 * np.array([0.05, 0.02]) * np.sqrt(dk * dm))


BAND = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L1 = DROI 4 (0. 0.) (4. 0.) ; S1 = L1 TRAN 1 (0. 1.) ;
MO = MODE S1 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 5. 'NU' 0.3 'RHO' 2. ;
K0 = RIGI MO MA ; M0 = MASS MO MA ; K1 = K0 ET (BLOQ 'DEPL' (S1 POIN 'DROI' (0. 0.) (0. 1.))) ;
E1 = S1 POIN 'DROI' (4. 0.) (4. 1.) ; B1 = BLOQ 'DEPL' E1 ; TS = IDLI B1 E1 ;
"""
HELD = BAND + "B2 = BLOQ TS ; DEPI TS ; RESO (K1 ET B2) TS ; REAC B2 TS ; "
PUSH = (
    "REPE B 2 ; I = 2 * &B ; TS . I . 'DDL_LIAISON' = MOT 'FY' ; "
    "TS . (I - 1) . 'DDL_LIAISON' = MOT 'FX' ; FIN B ; FORC TS ; RESO K1 TS ; "
)
PUSHED = BAND + PUSH


def dense(matrix):
    (block,) = matrix.blocks
    order = np.argsort(block.nodes[0])
    assert set(zip(block.unknowns, block.duals, strict=True)) <= {
        ("ALFA", "FALF"), ("BETA", "FBET")
    }  # fmt: skip
    return block.values[0][np.ix_(order, order)]


@together("order", ["TM TS", "TS TM"])
@together("statics", [HELD, PUSHED])
@together("fixed", ["K1", "(K1 ET B1)"])
def test_modes_with_static_shapes_give_the_projected_matrices(order, statics, fixed):
    """The works of forces and reactions are X^T K X, coupling terms of free modes included."""
    script = statics + (
        f"TM = VIBR 'SIMU' 0. 3 {fixed} M0 ; KM = RIGI {order} ; KP = PJBA K0 TM TS ; "
        f"MM = MASS {order} M0 ; MP = PJBA M0 TM TS ;"
    )
    km, kp, mm, mp = (dense(m) for m in objects(script, "KM", "KP", "MM", "MP"))
    assert km.shape == (7, 7)
    np.testing.assert_allclose(km, kp, rtol=1e-9, atol=1e-9 * np.abs(kp).max())
    np.testing.assert_allclose(mm, mp, rtol=1e-9, atol=1e-9 * np.abs(mp).max())


def test_static_shapes_alone_condense_the_stiffness_on_their_unknowns():
    """Rows of the condensed stiffness of a held band sum up to what its reactions hold."""
    script = HELD + "KS = RIGI TS ; KP = PJBA K0 TS ; MS = MASS TS M0 ; MP = PJBA M0 TS ;"
    ks, kp, ms, mp = (m.blocks[0].values[0] for m in objects(script, "KS", "KP", "MS", "MP"))
    np.testing.assert_allclose(ks, kp, rtol=1e-9, atol=1e-9 * np.abs(kp).max())
    np.testing.assert_allclose(ms, mp, rtol=1e-9)


def test_modes_are_sought_near_the_square_of_a_frequency():
    near = 0.41  # nearer to the second frequency, but its square to the first one's
    assert abs(FREQUENCIES[1] - near) < abs(FREQUENCIES[0] - near)
    assert abs(FREQUENCIES[1] ** 2 - near**2) > abs(FREQUENCIES[0] ** 2 - near**2)
    table = objects(TWO_MASSES + f"T = VIBR 'PROC' (PROG {near}) (LECT 1) K1 M1 ;", "T")
    assert mode(table, 1).get("FREQUENCE") == pytest.approx(FREQUENCIES[0])


def test_pseudo_mode_of_a_shock_is_that_of_a_unit_force_along_its_normal(found, refused):
    """Springs 400 and 900 apart, both modes kept but one: what is left is the other's part."""
    script = (
        "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; P2 = 1. 0. ; "
        "K = (APPU 'UX' 400. P1) ET (APPU 'UX' 900. P2) ET (APPU 'UY' 1600. P2) ; "
        "M = (MASS 'UX' 4. (P1 ET P2)) ET (MASS 'UY' 4. P2) ; "
        "T = VIBR 'SIMU' 1. 1 K M ; S = TABL 'POINT_DE_LIAISON' ; S . 1 = TABL ; "
        "S . 1 . 'POINT' = P2 ; S . 1 . 'NORMALE' = (3. 4.) ; "
    )
    x, y, same = found(
        script + "P = PSMO K (T . 'MODES') S ; D = P . 1 . 'DEPLACEMENT' ; "
        "X = EXTR D 'UX' P2 ; Y = EXTR D 'UY' P2 ; Z = NOEU (P . 1 . 'POINT') ; W = NOEU P2 ; "
        "L = Z EGA W ;",
        "X", "Y", "L",
    )  # fmt: skip
    assert (x, y) == pytest.approx((0.6 / 900.0, 0.8 / 1600.0))
    assert same
    flat = script + "S . 1 . 'NORMALE' = (0. 0.) ; P = PSMO K (T . 'MODES') «S» ;"
    assert "the NORMALE of entry 1 is zero" in refused(flat)
    empty = script + "S . 2 = TABL ; P = PSMO K (T . 'MODES') «S» ;"
    assert "entry 2 wants a POINT" in refused(empty)


def test_fields_are_compared_by_one_factor():
    """What a pseudo-mode stands for is found by it: fields that are proportional, and no others."""
    table = NodeTable()
    table.add(np.eye(4, 3))
    field = NodeField.of(
        table, np.array([2, 0, 3]), {"FY": [1.0, -2.0, 4.0], "FX": [0.5, 3.0, 0.0]}
    )
    assert ratio(applied(field, lambda x: -2.5 * x), field) == pytest.approx(-2.5)
    one = NodeField.of(table, np.array([0, 2]), {"FX": [3.0, 0.5]})
    for other, reference in (
        (field, applied(field, lambda x: 0.0 * x)),
        (one, field),
        (field, one),
        (3.0, field),
        (NodeField(table, {}, ""), NodeField(table, {}, "")),
    ):
        assert ratio(other, reference) is None
    assert ratio(one, NodeField.of(table, np.array([2, 0]), {"FX": [1.0, 6.0]})) == 0.5

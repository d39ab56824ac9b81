"""COMP ECOU KTAN HOTA CRIT MOTA against closed forms and finite differences."""

import numpy as np
import pytest

from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.matrices.assembly import assemble
from ssilang.kernel.statics.constitutive import respond

ZEROS = "Z = ZERO M 'DEFORMATIONS' ; S0 = ZERO M 'CONTRAINTES' ; V0 = ZERO M 'VARINTER' ; "
PLATE = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 1 (0 0) (1 0) ; S = TRAN 1 L (0. 1.) ; "
    "X Y = COOR S ; "
    "U = (NOMC 'UX' ((4.E-3 * X) + (1.E-3 * Y)) 'NATU' 'DIFFUS') ET "
    "(NOMC 'UY' (-1.E-3 * Y) 'NATU' 'DIFFUS') ; "
)
ELASTIC = "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E3 'NU' 0.3 ; "
MISES = (
    "M = MODE S MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE ; "
    "A = MATE M 'YOUN' 2.E3 'NU' 0.3 'SIGY' 3. 'H' 100. ; "
)
BAR = (
    "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; L = DROI 1 (0. 0.) (1. 0.) ; "
    "M = MODE L MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE BARR ; "
    "A = MATE M 'YOUN' 1.E3 'NU' 0. 'SIGY' 2. 'H' 250. 'SECT' 3. ; "
    "U = MANU 'CHPO' L 1 'UX' (PROG 0. 6.E-3) 'NATURE' 'DIFFUS' ; " + ZEROS
)
JOINT = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; P = 0. 0. ; Q = 1. 0. ; B = DROI 1 P Q ; "
    "T = B PLUS (0. 0.) ; J = RACC 1.E-6 T B ; "
    "M = MODE J MECANIQUE ELASTIQUE {law} JOI2 ; A = MATE M 'KN' 1.E6 'KS' 4.E5 {more} ; " + ZEROS
)


def component(field, name):
    return np.ravel(field.blocks[0].components[name])


def matrix(rigidity):
    return assemble(rigidity).toarray()


def test_elastic_law_adds_the_stress_of_the_step(found):
    a, b = found(
        PLATE + ELASTIC + ZEROS + "S1 = SIGM M A U ; C = COMP M (S1 ET (EPSI M U) ET A) "
        "(A ET (EPSI M (3. * U))) ; B = 3. * S1 ;",
        "C", "B",
    )  # fmt: skip
    for name in ("SMXX", "SMYY", "SMZZ", "SMXY"):
        np.testing.assert_allclose(component(a, name), component(b, name), rtol=1e-12)


def test_plastic_bar_hardens_keeps_its_plastic_strain_and_unloads(found):
    c, s, v, e, back, done = found(
        BAR + "E1 = EPSI M U ; C = COMP M (A ET Z) (A ET E1) ; "
        "D = COMP M (A ET E1 ET C) (A ET (0.5 * E1)) ; X = TABL ; "
        "S1 V1 D1 = ECOU M S0 V0 E1 A X ; OK = X . 'SUCCES' ;",
        "C", "S1", "V1", "D1", "D", "OK",
    )  # fmt: skip
    assert done is True
    plastic = (1e3 * 6e-3 - 2) / (1e3 + 250)
    for field in (c, s):
        np.testing.assert_allclose(component(field, "EFFX"), 3 * (2 + 250 * plastic), rtol=1e-9)
    for field, name in ((c, "EISS"), (v, "EPSE"), (e, "EISS"), (back, "EISS")):
        np.testing.assert_allclose(component(field, name), plastic, rtol=1e-9)
    np.testing.assert_allclose(component(back, "EFFX"), 3 * (2 + 250 * plastic - 3.0), rtol=1e-9)


def test_tangent_of_a_bar_is_elastic_inside_and_hardening_on_the_surface(found):
    script = (
        BAR + "S1 V1 E1 = ECOU M S0 V0 (EPSI M U) A ; K0 = RIGI M A ; "
        "K1 = KTAN M (0.5 * S1) V0 A ; K2 = KTAN M S1 V1 A ; K3 = RIGI M (HOTA M S1 V1 A) A ; "
        "X1 = MAXI (MOTA M S1 V1 A) ; X2 = MAXI (MOTA M (0.5 * S1) V1 A) ;"
    )
    assert found(script, "X1", "X2") == (250.0, 1000.0)
    k0, k1, k2, k3 = map(matrix, found(script, "K0", "K1", "K2", "K3"))
    np.testing.assert_allclose(k1, k0)
    expected = k0 * 250 / 1250
    np.testing.assert_allclose(k2, expected, rtol=1e-9)
    np.testing.assert_allclose(k3, expected, rtol=1e-9)


@pytest.mark.parametrize(
    ("law", "given"),
    [("BETON_BAEL", "'FC' 30."), ("PARFAIT_UNI", "'SIGY' 2. 'H' 0."), ("PARFAIT", "'SIGY' 2.")],
)
def test_tangent_of_a_bar_that_bears_nothing_is_its_stiffness(found, law, given):
    script = BAR.replace("CINEMATIQUE", law).replace("'SIGY' 2. 'H' 250.", given)
    k0, k1 = map(matrix, found(script + "K0 = RIGI M A ; K1 = KTAN M S0 V0 A ;", "K0", "K1"))
    np.testing.assert_allclose(k1, k0)


LINES = "OPTI DIME 3 MODE TRID ELEM {} ; L = DROI 2 (0. 0. 0.) (1. 2. .5) ; "
SHELL = LINES.format("TRI3") + "L = TRAN 1 L (0. .3 1.) ; "
HELD = {
    "POUT": LINES.format("SEG2"), "TUYA": LINES.format("SEG2"), "COQ3": SHELL, "DKT": SHELL,
    "Q4RI": "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L = TRAN 2 (DROI 2 (0 0) (1 0)) (.2 1.) ; ",
}  # fmt: skip


@pytest.mark.parametrize("perturbed", [False, True])
@pytest.mark.parametrize("element", HELD)
def test_tangent_of_an_elastic_state_is_the_stiffness(found, element, perturbed):
    given = "'SECT' .02 'INRY' 3.E-5 'INRZ' 5.E-5 'TORS' 7.E-5" if element == "POUT" else (
        "'EPAI' .02" + " 'RAYO' .2" * (element == "TUYA")) if element != "Q4RI" else ""  # fmt: skip
    way = "KTAN 'PERT' M (A ET Z ET S0) (Z ET A)" if perturbed else "KTAN M S0 V0 A"
    script = f"M = MODE L MECANIQUE ELASTIQUE {element} ; A = MATE M 'YOUN' 2.E3 'NU' .3 {given} ; "
    k0, k1 = map(matrix, found(
        HELD[element] + script + ZEROS + f"K0 = RIGI M A ; K1 = {way} ;", "K0", "K1"
    ))  # fmt: skip
    np.testing.assert_allclose(k1, k0, atol=1e-5 * np.abs(k0).max() * perturbed + 1e-300)


BENT = {
    "POUT": "'SECT' .02 'INRY' 3.E-5 'INRZ' 5.E-5 'TORS' 7.E-5 'DZ' .1 'DY' .1",
    "TUYA": "'EPAI' .02 'RAYO' .2",
}  # fmt: skip


@pytest.mark.parametrize("element", BENT)
def test_tangent_of_beams_that_yield_in_bending_is_a_share_of_the_stiffness(found, element):
    script = (
        "OPTI DIME 3 MODE TRID ELEM SEG2 ; P = 0 0 0 ; Q = 2. 0 0 ; L = DROI 1 P Q ; "
        f"M = MODE L MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE {element} ; "
        f"A = MATE M 'YOUN' 2.E3 'NU' .3 'SIGY' 1. 'H' 700. {BENT[element]} ; " + ZEROS +
        "N = MANU 'CHPO' L 1 'UX' 0. 'NATURE' 'DIFFUS' ; "
        "U = N + (MANU 'CHPO' Q 2 'UY' .2 'RZ' .2 'NATURE' 'DIFFUS') ; "
        "W = N + (MANU 'CHPO' Q 1 'UY' 1. 'NATURE' 'DIFFUS') ; "
        "S1 V1 E1 = ECOU M S0 V0 (EPSI M U A) A ; S2 V2 E2 = ECOU M S1 V1 (EPSI M (.01 * U) A) A ; "
        "D = .01 * (MAXI (EXCO 'MOMZ' (SIGM M A U))) ; "
        "R = ((MAXI (EXCO 'MOMZ' S2)) - (MAXI (EXCO 'MOMZ' S1))) / D ; "
        "K = KTAN M S1 V1 A ; G = RIGI M A ; "
        "A1 = XTMX U K ; B1 = XTMX U G ; A2 = XTMX W K ; B2 = XTMX W G ;"
    )  # fmt: skip
    share, *works = found(script, "R", "A1", "B1", "A2", "B2")
    assert 0.05 < share < 0.9
    np.testing.assert_allclose(works[::2], share * np.array(works[1::2]), rtol=1e-4)


@pytest.mark.parametrize("law", [ELASTIC, MISES])
def test_perturbed_tangent_is_the_consistent_one(found, law):
    script = (
        PLATE + law + ZEROS + "E1 = EPSI M U ; C = COMP M (A ET Z) (A ET E1) ; "
        "K = KTAN 'PERT' M (A ET Z) (C ET A ET E1) 'C1' 1.E-6 ; "
        "DU = MANU 'CHPO' S 2 'UX' 0. 'UY' 0. 'NATURE' 'DIFFUS' ; "
        "W = (NOMC 'UX' (1.E-7 * Y * X) 'NATU' 'DIFFUS') ET (NOMC 'UY' (2.E-7 * X) 'NATU' 'DIFFUS')"
        " ; D = COMP M (A ET Z) (A ET (EPSI M (U + W))) ; "
        "F = (BSIG M (REDU D M)) - (BSIG M (REDU C M)) ; R = F - (K * W) ; "
        "X1 = MAXI R 'ABS' ; X2 = MAXI F 'ABS' ;"
    )
    script = script.replace("(REDU D M)", "D").replace("(REDU C M)", "C")
    error, size = found(script, "X1", "X2")
    assert size > 0
    assert error < 1e-4 * size  # second order in a step of 1e-4


def test_joint_opens_and_loses_its_stiffness(found):
    script = JOINT.format(law="JOINT_SDM", more="") + (
        "O = MANU 'CHPO' T 2 'UX' 1.E-4 'UY' 2.E-4 'NATURE' 'DIFFUS' ; "
        "F = MANU 'CHPO' T 2 'UX' 1.E-4 'UY' -2.E-4 'NATURE' 'DIFFUS' ; "
        "C1 = COMP M (A ET Z) (A ET (EPSI M O A)) ; C2 = COMP M (A ET Z) (A ET (EPSI M F A)) ; "
        "K1 = KTAN M C1 C1 A ; K2 = KTAN M C2 C2 A ; K0 = RIGI M A ; "
    )
    c1, c2, k1, k2, k0 = found(script, "C1", "C2", "K1", "K2", "K0")
    np.testing.assert_allclose(component(c1, "SMN"), 0.0)
    np.testing.assert_allclose(component(c1, "SAUT"), 2e-4)
    np.testing.assert_allclose(component(c2, "SMN"), -200.0)
    np.testing.assert_allclose(component(c2, "SMSN"), 40.0)
    assert np.abs(matrix(k1)).max() == 0.0
    np.testing.assert_allclose(matrix(k2), matrix(k0), atol=1e-6)


def test_sliding_joint_has_the_unsymmetric_tangent_of_coulomb(found):
    script = JOINT.format(law="JOINT_SDM", more="'FROT' 0.5") + (
        "F = MANU 'CHPO' T 2 'UX' 1.E-3 'UY' -2.E-4 'NATURE' 'DIFFUS' ; "
        "C = COMP M (A ET Z) (A ET (EPSI M F A)) ; K = KTAN M C C A ; "
        "KS = KTAN M C C A 'SYME' ; R = CRIT M C C A ; "
    )
    c, k, ks, r = found(script, "C", "K", "KS", "R")
    np.testing.assert_allclose(component(c, "SMSN"), 0.5 * 200.0)
    np.testing.assert_allclose(component(r, "SCAL"), 0.0, atol=1e-9)
    K = matrix(k)
    # shear by a closing jump: -0.5 KN; no shear by a slip
    assert np.abs(K - K.T).max() > 1e4
    np.testing.assert_allclose(matrix(ks), (K + K.T) / 2, rtol=1e-12)


def test_mohr_coulomb_joint_starts_again_from_its_state(found):
    law = "PLASTIQUE COULOMB"
    script = JOINT.format(law=law, more="'FRIC' 30. 'COHE' 10.") + (
        "F = MANU 'CHPO' T 2 'UX' 6.E-4 'UY' -2.E-4 'NATURE' 'DIFFUS' ; E1 = EPSI M F A ; "
        "C1 = COMP M (A ET Z) (A ET E1) ; "
        "C2 = COMP M (A ET E1 ET C1) (A ET (2. * E1)) ; "
        "CE = COMP M (A ET Z) (A ET (2. * E1)) ; "
    )
    c1, c2, direct = found(script, "C1", "C2", "CE")
    # dilatancy presses the joint, the point stays on the surface
    pressed = -component(c1, "SMN")
    assert (pressed > 200).all()
    expected = 10 + pressed * np.tan(np.radians(30))
    np.testing.assert_allclose(component(c1, "SMSN"), expected, rtol=1e-9)
    # proportional loading: two steps are as good as one
    for name in ("SMSN", "SMN"):
        np.testing.assert_allclose(component(c2, name), component(direct, name), rtol=1e-6)


def test_criterion_of_von_mises(found):
    script = PLATE + MISES + ZEROS + "S1 = SIGM M A U ; C = CRIT M S1 V0 A ; V = VMIS M S1 ;"
    c, v = found(script, "C", "V")
    np.testing.assert_allclose(component(c, "SCAL"), component(v, "SCAL") - 3.0)


def test_a_point_joint_slips_in_space_beside_its_springs_of_rotation(found):
    """Slip along the shear that was tried, on Coulomb's cone; moments add up."""
    m, a, first, second = found(
        "OPTI DIME 3 ELEM SEG2 ; J = MANU 'SEG2' (0. 0. 0.) (0. 0. 1.) ; "
        "M = MODE J MECANIQUE ELASTIQUE PLASTIQUE COULOMB JOI1 ; "
        "A = MATE M 'KN' 1.E6 'KS' 4.E5 'QN' 7. 'QS' 11. 'FRIC' 30. 'COHE' 10. ; "
        "D = MANU 'CHML' M 'EXX' -3.E-5 'GXY' 2.E-4 'GXZ' -1.E-4 'CXX' 0.5 'CXY' 2. 'CXZ' -3. "
        "'STRESSES' ; H = 0.1 * D ; "
        + ZEROS + "S1 V1 E1 = ECOU M S0 V0 H A ; S2 V2 E2 = ECOU M S1 V1 (D - H) A ;",
        "M", "A", "S1", "S2",
    )  # fmt: skip
    names, jumps = first.blocks[0].components, np.array([-3e-5, 2e-4, -1e-4, 0.5, 2.0, -3.0])
    stiff = np.array([1e6, 4e5, 4e5, 7.0, 11.0, 11.0])

    def exact(jumps):
        trial = stiff * jumps
        limit, size = 10.0 - np.tan(np.pi / 6) * trial[0], np.linalg.norm(trial[1:3])
        return trial * np.where(np.isin(np.arange(6), (1, 2)), min(1.0, limit / size), 1.0)

    for field, share in ((first, 0.1), (second, 1.0)):
        got = [component(field, name)[0] for name in names]
        np.testing.assert_allclose(got, exact(share * jumps), rtol=1e-9)
    zone, small = m.zones[0], 1e-7 * np.diag(1 / stiff) * 30
    none = zone_field(zone, CellField(()))
    answer = respond(zone, a, np.zeros((1, 6, 1)), none, jumps[None, :, None])
    wanted = np.array([(exact(jumps + h) - exact(jumps - h)) / (2 * h.max()) for h in small]).T
    np.testing.assert_allclose(answer.tangent[0, 0], wanted, rtol=1e-5, atol=1.0)


# --- what laws say of themselves ----------------------------------------------------------------


@pytest.mark.parametrize(("strength", "push"), [(4.0, 10.0), (0.0, 25.0)])
def test_cone_of_a_dilating_joint_has_its_apex_at_the_tensile_strength(found, strength, push):
    given = f"'PHI' 30. 'MU' 12. 'FTRC' {strength}"
    script = JOINT.format(law="PLASTIQUE JOINT_DILATANT", more=given) + (
        f"F = MANU 'CHPO' T 2 'UX' 1.E-3 'UY' {-push / 1e6} 'NATURE' 'DIFFUS' ; "
        "C = COMP M (A ET Z) (A ET (EPSI M F A)) ; "
    )
    c = found(script, "C")
    pressed = -component(c, "SMN")
    assert (pressed > push).all()  # slip lifts the faces, which are held
    bound = (strength + pressed) * np.tan(np.radians(30))
    np.testing.assert_allclose(component(c, "SMSN"), bound, rtol=1e-9)


@pytest.mark.parametrize(("dimension", "angle"), [(2, 25.0), (3, 70.0)])
def test_anisotropic_body_shears_as_it_is_heated(found, dimension, angle):
    mesh = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 1 (0 0) (1 0) ; S = TRAN 1 L (0. 1.) ; "
        if dimension == 2
        else "OPTI DIME 3 ELEM CUB8 ; L = DROI 1 (0 0 0) (1 0 0) ; "
        "S = (TRAN 1 L (0. 1. 0.)) VOLU 1 TRAN (0. 0. 1.) ; "
    )
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    n = 4 if dimension == 2 else 6
    D = np.diag(np.arange(1.0, n + 1)) + 0.1
    rates = np.array([1.0, 2.0, 3.0, 0.5, -0.7, 0.9])[:n]
    axes = f"({c} {s}) " if dimension == 2 else f"({c} {s} 0.) ({-s} {c} 0.) "
    terms = " ".join(f"'D{i + 1}{j + 1}' {D[i, j]}" for i in range(n) for j in range(i + 1))
    names = ("ALP1", "ALP2", "ALP3", "AL12", "AL13", "AL23")
    script = mesh + (
        "M = MODE S MECANIQUE ELASTIQUE ANISOTROPE ; "
        f"A = MATE M DIRECTION {axes} {terms} "
        + " ".join(f"'{name}' {rate}" for name, rate in zip(names, rates, strict=False))
        + " ; H = EPTH M A (MANU 'CHPO' S 1 'T' 2. 'NATURE' 'DIFFUS') ; "
    )
    local = np.diag(rates[:3])
    for (i, j), rate in zip(((0, 1), (0, 2), (1, 2)), rates[3:], strict=False):
        local[i, j] = local[j, i] = rate / 2
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    whole = 2.0 * turn @ local @ turn.T
    h = found(script, "H")
    shown = {"EPXX": whole[0, 0], "EPYY": whole[1, 1], "GAXY": 2 * whole[0, 1]}
    if dimension == 3:
        shown |= {"GAXZ": 2 * whole[0, 2], "GAYZ": 2 * whole[1, 2]}
    for name, value in shown.items():
        np.testing.assert_allclose(component(h, name), value, rtol=1e-9, err_msg=name)


@pytest.mark.parametrize(
    ("script", "more"),
    [
        (PLATE + MISES, ()),
        (BAR, ()),
        (JOINT.format(law="PLASTIQUE COULOMB", more="'FRIC' 30. 'COHE' 10."), ("STAT",)),
    ],
)
def test_names_that_a_model_and_zeros_have_are_those_of_the_law_s_answer(found, script, more):
    script += (
        "Y = ZERO M 'DEFORMATIONS' ; W = ZERO M 'CONTRAINTES' ; "
        "C = COMP M (A ET W ET Y) (A ET Y) ; "
        "N = EXTR (ZERO M 'DEFINELA') 'COMP' ; V = EXTR M 'VARI' ; E = EXTR C 'COMP' ; "
        "S = EXTR M 'CONT' ; O = EXTR (ZERO M 'VARINTER') 'COMP' ; "
    )
    lists = found(script, "N", "V", "E", "S", "O")
    inelastic, inner, answered, stresses, zeros = (x.values for x in lists)
    assert set(inelastic) | set(inner) | set(stresses) == set(answered)
    assert set(zeros) == set(inner) >= {"EPSE", *more}


@pytest.mark.parametrize(("duration", "age"), [(3.0, 1.0), (0.5, 0.5)])
def test_creep_answers_over_the_time_between_two_states(found, duration, age):
    rate, young = 1e-6, 1e3
    script = (
        BAR.split("M = MODE")[0] + "M = MODE L MECANIQUE ELASTIQUE FLUAGE NORTON BARR ; "
        f"A = MATE M 'YOUN' {young} 'NU' 0. 'AF1' {rate} 'AF2' 2. 'AF3' {age} 'SECT' 3. ; "
        "D0 = MANU 'CHML' M 'TEMP' 1. 'TYPE' 'SCALAIRE' 'STRESSES' ; "
        f"D1 = MANU 'CHML' M 'TEMP' {1 + duration} 'TYPE' 'SCALAIRE' 'STRESSES' ; "
        "S0 = MANU 'CHML' M 'EFFX' 60. 'TYPE' 'CONTRAINTES' 'STRESSES' ; V0 = ZERO M 'VARINTER' ; "
        "E0 = ZERO M 'DEFORMATIONS' ; C = COMP M (A ET S0 ET V0 ET E0 ET D0) (A ET E0 ET D1) ; "
        f"K = KTAN M S0 V0 A 'DT' {duration} ; "
    )
    c, k = found(script, "C", "K")
    stress, crept = component(c, "EFFX") / 3.0, component(c, "EPSE")
    # held: what the stress loses the creep has gained, by the law of the stress at the end
    np.testing.assert_allclose(crept, rate * stress**2 * duration**age, rtol=1e-9)
    np.testing.assert_allclose(20.0 - stress, young * crept, rtol=1e-9)
    assert crept[0] > 1e-4
    slope = 2 * rate * stress[0] * duration**age
    top = np.abs(matrix(k)).max()
    assert top == pytest.approx(3.0 * young / (1 + young * slope), rel=1e-9)


@pytest.mark.parametrize(("element", "cell"), [("COQ8", "QUA8"), ("COQ6", "TRI6")])
def test_thick_shells_that_yield_answer_point_by_point_as_in_time(found, element, cell):
    script = (
        f"OPTI DIME 3 ELEM {cell} ; L = DROI 1 (0. 0. 0.) (1. 0. 0.) ; S = L TRAN 1 (0. 1. .3) ; "
        f"M = MODE S MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE {element} ; "
        "A = MATE M 'YOUN' 2.E3 'NU' .3 'SIGY' 1. 'H' 300. 'EPAI' .2 ; X = COOR 1 S ; "
        "U = (NOMC 'UX' (2.E-3 * X) 'NATU' 'DIFFUS') ET (NOMC 'UZ' (3.E-3 * X * X) 'NATU' 'DIFFUS')"
        " ET (NOMC 'RY' (-1.E-3 * X) 'NATU' 'DIFFUS') ; "
        + ZEROS
        + "BX = BLOQ 'UX' S ; BZ = BLOQ 'UZ' S ; BR = BLOQ 'RY' S ; "
        "D = (DEPI BX (EXCO 'UX' U 'UX')) ET (DEPI BZ (EXCO 'UZ' U 'UZ')) ET "
        "(DEPI BR (EXCO 'RY' U 'RY')) ; "
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
        "T . 'TEMPS_CALCULES' = PROG 1. ; "
        "T . 'BLOCAGES_MECANIQUES' = BX ET BZ ET BR ET (BLOQ 'UY' 'RX' 'RZ' S) ; "
        "T . 'CHARGEMENT' = CHAR 'DIMP' D (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; PASAPAS T ; "
        "C = COMP M (A ET Z) (A ET (EPSI M U A)) ; S1 = T . 'CONTRAINTES' . 1 ; "
        "LC = EXTR S1 'COMP' ; LV = EXTR M 'VARI' ; S2 = EXCO LC C LC ; V2 = EXCO LV C LV ; "
        "E1 = MAXI 'ABS' (S1 - S2) ; E0 = MAXI 'ABS' (EXCO 'SMSN' S1) ; "
        "S3 V3 E3 = ECOU M S2 V2 (EPSI M (1.E-5 * U) A) A ; K = KTAN M S2 V2 A ; "
        "F = (BSIG M S3 A) - (BSIG M S2 A) ; W = 1.E-5 * U ; G = RIGI M A ; "
        "X1 = MAXI (F - (K * W)) 'ABS' ; X2 = MAXI F 'ABS' ; X3 = MAXI (F - (G * W)) 'ABS' ; "
        "K0 = KTAN M S0 V0 A ; X4 = MAXI ((K0 * U) - (G * U)) 'ABS' ; X5 = MAXI (G * U) 'ABS' ; "
    )
    names = ("E1", "E0", "X1", "X2", "X3", "X4", "X5")
    off, shear, error, size, elastic, unlike, whole = found(script, *names)
    assert shear > 0.1
    assert off < 1e-9
    assert unlike < 1e-9 * whole
    assert error < 5e-3 * size
    assert elastic > 0.1 * size

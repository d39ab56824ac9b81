"""Yield criteria of bodies and joints by their definitions, and the slope of the surface there."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.interface import family as _joints  # noqa: F401
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.law_table import LAWS as LAW_TABLE
from ssilang.kernel.interface.laws.law_table import shown_variables, state_of
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics import constitutive
from ssilang.kernel.statics.yielding import criterion, tangent_modulus
from tests.kernel.elements.samples import cell_zone, line_zone

ELASTIC = {"YOUN": 1000.0, "NU": 0.3}
CURVE = Curve((CurvePart(np.array([0.0, 0.01, 0.1]), np.array([1.0, 2.0, 3.0]), "EPSE", "SIGM"),))
CONE = {"ALFA": 0.3, "BETA": 1.0, "K": 1.3, "ETA": 0.6, "MU": 2.0, "KL": 4.0, "GAMM": 0.1,
        "DELT": 1.0}  # fmt: skip
CENTRE = ("ALXX", "ALYY", "ALZZ", "ALXY", "ALXZ", "ALYZ")
LAWS = {
    "PARFAIT": {"SIGY": 1.2},
    "ISOTROPE": {"ECRO": CURVE},
    "CINEMATIQUE": {"SIGY": 1.2, "H": 80.0},
    "DRUCKER_PARFAIT": {"LTR": 1.0, "LCS": 5.0},
    "hardens": CONE | {"H": 50.0},
    "hardens no more": CONE | {"H": 900.0},
    "softens": CONE | {"H": -0.4, "KL": 1.0},
    "softens no more": CONE | {"H": -40.0, "KL": 1.0},
    "softens to nothing": CONE | {"H": -40.0},
    "stays": CONE | {"H": 0.0},
    "stays at the last": CONE | {"H": 0.0, "KL": 1.6},
    "J2": {"SIG0": 1.0, "SIGI": 2.0, "KISO": 30.0, "VELO": 150.0},
    "RH_COULOMB": {"COHE": 1.0, "PHI": 0.5},
}
EPSE = np.array([[0.004, 0.0, 0.02, 0.05]])


def field_of(zone, values, support="STRESSES"):
    return CellField((CellFieldBlock(zone.cells, values, support, zone.element),))


def body(name, element="QUA4", mode=Mode.PLANE_STRAIN):
    law = name if "K" not in LAWS[name] else "DRUCKER_PRAGER"
    zone = cell_zone(element, mode)
    words = ("ELASTIQUE", "ISOTROPE", "PLASTIQUE", law)
    zone = Zone(zone.cells, "MECANIQUE", words, element, mode)
    given = {k: np.full((1, 1), v, object if isinstance(v, Curve) else float)
             for k, v in (ELASTIC | LAWS[name]).items()}  # fmt: skip
    return zone, field_of(zone, given, "GRAVITE")


def mises(s):
    d = s - np.trace(s) / 3 * np.eye(3)
    return np.sqrt(1.5 * (d * d).sum())


def expected(name, s, e, centre):
    p = ELASTIC | LAWS[name]
    if name == "PARFAIT":
        return mises(s) - 1.2
    if name == "ISOTROPE":
        return mises(s) - np.interp(e, [0, 0.01, 0.1], [1, 2, 3])
    if name == "J2":
        return mises(s) - (1.0 + 30.0 * e + 1.0 - np.exp(-150.0 * e))
    if name == "CINEMATIQUE":
        return mises(s - centre) - 1.2
    if name == "DRUCKER_PARFAIT":  # nought in pure tension LTR and compression -LCS
        a, b = np.linalg.solve([[1.0, 1.0], [-5.0, 5.0]], [1.0, 1.0])
        scale = 2 * 5 / 6
        return scale * (a * np.trace(s) + b * mises(s) - 1.0)
    if "K" in p:
        last = p["KL"] * p["BETA"] / p["MU"]
        k = p["K"] + p["H"] * e
        least = last if last < p["K"] else 0.0  # of one that falls
        k = max(k, least) if p["H"] < 0 else min(k, last)
        return p["ALFA"] * np.trace(s) + p["BETA"] * mises(s) - k
    return None


@together("name", LAWS)
def test_criteria_are_those_of_the_laws(name):
    zone, field = body(name)
    rng = np.random.default_rng(3)
    stress = rng.standard_normal((1, 4, 4))
    shifts = 0.3 * rng.standard_normal((6, 1, 4))
    shifts[4:] = 0.0
    variables = {"EPSE": EPSE} | dict(zip(CENTRE, shifts, strict=True))
    seen = zone_field(zone, field_of(zone, variables))
    found = criterion(zone, field, stress, seen)
    for k in range(4):
        xx, yy, zz, xy = stress[0, :, k]
        s = np.array([[xx, xy, 0], [xy, yy, 0], [0, 0, zz]])
        a = shifts[:, 0, k]
        centre = np.array([[a[0], a[3], 0], [a[3], a[1], 0], [0, 0, a[2]]])
        wanted = expected(name, s, EPSE[0, k], centre)
        if wanted is None:  # rounded inside the pyramid of Mohr and Coulomb
            e = np.linalg.eigvalsh(s)
            sharp = (e[2] - e[0]) / 2 + (e[2] + e[0]) / 2 * np.sin(0.5) - np.cos(0.5)
            assert found[0, k] >= sharp - 1e-9
            assert found[0, k] == pytest.approx(sharp, abs=0.45)
        else:
            assert found[0, k] == pytest.approx(wanted, abs=1e-12)
    with pytest.raises(FieldError, match="ELASTIQUE"):
        criterion(cell_zone("QUA4", Mode.PLANE_STRAIN), field, stress, seen)


@together("name", ["PARFAIT", "ISOTROPE", "CINEMATIQUE", "J2"])
def test_the_slope_is_youngs_but_where_it_yields(name):
    zone, field = body(name)
    size = {"PARFAIT": 1.2, "CINEMATIQUE": 1.2}.get(name)
    sizes = np.interp(EPSE[0], [0, 0.01, 0.1], [1, 2, 3]) if size is None else np.full(4, size)
    left = np.exp(-150.0 * EPSE[0])
    sizes = 2.0 + 30.0 * EPSE[0] - left if name == "J2" else sizes
    slopes = {"PARFAIT": [0] * 4, "CINEMATIQUE": [80] * 4, "J2": 30.0 + 150.0 * left,
              "ISOTROPE": [100, 100, 1 / 0.09, 1 / 0.09]}[name]  # fmt: skip
    stress = np.zeros((1, 4, 4))
    stress[0, 0] = sizes * [1.0, 1.0, 0.9995, 0.99]  # the last one is inside
    zeros = {n: np.zeros((1, 4)) for n in CENTRE}
    seen = zone_field(zone, field_of(zone, {"EPSE": EPSE} | zeros))
    found = tangent_modulus(zone, field, stress, seen, 1e-3)
    np.testing.assert_allclose(found[0], [slopes[0], 1000.0, slopes[2], 1000.0])
    bar = line_zone("BARR", [[0.0, 0.0], [1.0, 2.0]], Mode.PLANE_STRAIN, zone.behaviour)
    given = {n: v[0] for n, v in field.blocks[0].components.items()} | {"SECT": [2.5]}
    given = field_of(bar, {n: np.array([v]) for n, v in given.items()}, "GRAVITE")
    state = {n: np.zeros((1, 2)) for n in CENTRE} | {"EPSE": EPSE[:, :2]}
    state, force = zone_field(bar, field_of(bar, state)), 2.5 * sizes[None, None, :2]
    np.testing.assert_allclose(criterion(bar, given, 1.1 * force, state), [0.1 * sizes[:2]])
    found = tangent_modulus(bar, given, force, state, 1e-3)
    np.testing.assert_allclose(found, [[slopes[0], 1000.0]], atol=1e-9)
    elastic = cell_zone("QUA4", Mode.PLANE_STRAIN)
    plain = field_of(elastic, {k: np.full((1, 1), v) for k, v in ELASTIC.items()}, "GRAVITE")
    np.testing.assert_allclose(tangent_modulus(elastic, plain, stress, seen, 1e-3), 1000.0)
    zone, field = body("DRUCKER_PARFAIT")
    with pytest.raises(FieldError, match="DRUCKER"):
        tangent_modulus(zone, field, stress, seen, 1e-3)


def joint(law, space, **given):
    table = NodeTable()
    x = np.array([[0, 0, 0], [2, 0, 0], [0.5, 1.5, 0.0]])[:, : 3 if space else 2]
    x = x if space else x[:2]
    ids = table.add(np.concatenate([x, x]))
    kind, element = ("LIA3", "JOT3") if space else ("RAC2", "JOI2")
    mode = Mode.THREE_DIMENSIONAL if space else Mode.PLANE_STRAIN
    zone = Zone(CellBlock.make(table, kind, ids[None]), "MECANIQUE", ("ELASTIQUE", law), element,
                mode)  # fmt: skip
    values = {k: np.full((1, 1), float(v)) for k, v in given.items()}
    return zone, field_of(zone, values)


@together("space", [False, True])
@together("rough", [0.0, 0.6])
@together("strength", [0.0, 3.0])
def test_joints_open_or_slide(space, rough, strength):
    given = {"KN": 1e4, "KS": 1e3, "FROT": rough, "FU": strength, "GF": 0.8}
    given = {k: v for k, v in given.items() if v}
    zone, field = joint("JOINT_SDM", space, **given)
    p, d = 3 if space else 2, 3 if space else 2
    t = 3 * np.random.default_rng(5).standard_normal((1, d, p))
    xi = np.linspace(0.1, 0.4, p)[None]
    seen = zone_field(zone, field_of(zone, {"SAUT": xi}))
    found = criterion(zone, field, t, seen)
    shear = np.linalg.norm(t[0, : d - 1], axis=0)
    normal = t[0, d - 1]
    soft = strength * np.exp(-strength / 0.8 * xi[0]) if strength else 0.0
    opening = normal - soft
    sliding = shear - rough * np.maximum(-normal, 0.0)
    np.testing.assert_allclose(found[0], np.maximum(opening, sliding) if rough else opening)


@together("space", [False, True])
def test_dilatant_joints_slide_on_coulombs_line(space):
    zone, field = joint("JOINT_DILATANT", space, KN=1e4, KS=1e3, PHI=30.0, MU=5.0, COHE=2.0,
                        FTRC=0.7)  # fmt: skip
    p = d = 3 if space else 2
    t = 2 * np.random.default_rng(5).standard_normal((1, d, p))
    found = criterion(zone, field, t, zone_field(zone, None))
    shear, normal = np.linalg.norm(t[0, : d - 1], axis=0), t[0, d - 1]
    sliding = shear + normal * np.tan(np.pi / 6) - 2.0
    np.testing.assert_allclose(found[0], np.maximum(sliding, normal - 0.7))


@together("word", [w for w, law in LAW_TABLE.items() if law.variables])
def test_states_are_what_their_variables_show(word):
    """Of a variable that sums several columns the first one takes what the others leave."""
    zone, _ = joint(word, True)
    law = LAW_TABLE[word]
    state = np.random.default_rng(3).uniform(0.1, 1.0, (1, 3, N_STATE))
    shown = shown_variables(law, state, 3)
    back = state_of(law, zone_field(zone, field_of(zone, shown)), (1, 3))
    again = shown_variables(law, back.reshape(1, 3, N_STATE), 3)
    for name, values in shown.items():
        single = len(law.variables[law.opposite.get(name, name)]) == 1
        np.testing.assert_allclose(again[name] if single else values, values)
        if single:
            column = back[:, law.variables[law.opposite.get(name, name)][0]]
            sign = -1.0 if name in law.opposite else 1.0
            np.testing.assert_allclose(sign * column, values.ravel())
    for first, *others in law.variables.values():
        if others:
            own = [columns for columns in law.variables.values() if columns[0] == first][-1]
            total = state[0][:, list(own)].sum(axis=1) - back[:, list(own[1:])].sum(axis=1)
            np.testing.assert_allclose(back[:, first], total)


@together("code", [LawCode.SDM, LawCode.MOHR])
def test_jumps_are_those_that_tractions_and_variables_came_from(code):
    """By the law itself, after paths of points that open, soften, close, slip and have no shear."""
    rng, m = np.random.default_rng(2), 600
    table, state = np.zeros((m, len(Parameter))), np.zeros((m, N_STATE))
    size = {"KN": 2e3, "KS1": 7e2, "KS2": 5e2, "FU": 1.5, "GF": 6e-3, "FC": -0.8, "FROT": 0.6,
            "TPHI": 0.6, "TPSI": 0.2, "COHE": 0.7, "FTRC": 0.5}  # fmt: skip
    for name, value in size.items():
        table[:, Parameter[name]] = value * rng.uniform(0.7, 1.4, m)
    for k, names in enumerate((("FU", "GF"), ("FC",), ("KS1",))):
        table[k::5, [Parameter[n] for n in names]] = 0.0
    for _ in range(8):
        w, before = rng.standard_normal((m, 3)) * [1e-3, 1e-3, 1.2e-3], state
        t, state, D = np.zeros((m, 3)), np.zeros_like(state), np.zeros((m, 3, 3))
        respond(np.full(m, code), w, before, table, t, state, D)
    found = constitutive._jump(constitutive.JointPoints(None, table, 3, (m, 1)), t, state, code)
    one = (t[:, 2] != 0.0) | (state[:, Variable.XI] <= 0.0)  # what is open may be anywhere
    assert np.mean(one) > 0.7
    one = one[:, None] & (table[:, [Parameter.KS1, Parameter.KS2, Parameter.KN]] > 0.0)
    np.testing.assert_allclose(found[one], w[one], rtol=1e-9, atol=1e-15)
    assert np.isfinite(found).all()


@together("shear", [0.0, 700.0])
def test_a_joint_that_does_not_move_keeps_its_tractions(shear):
    """Three points: in cohesive tension, closing, closed."""
    zone, field = joint("JOINT_SDM", True, KN=2e3, KS=shear, FU=1.5, GF=6e-3, FC=-0.8)
    stress = np.array([[[0.2, 0.3, -0.4], [-0.1, 0.2, 0.3], [0.5, -0.4, -2.0]]])
    stress[:, :2] *= shear > 0.0
    seen = zone_field(zone, field_of(zone, {"SAUT": np.array([[1e-3, 2e-3, 3e-3]])}))
    answer = constitutive.respond(zone, field, stress, seen, np.zeros_like(stress))
    np.testing.assert_allclose(answer.stress, stress, rtol=1e-9)
    np.testing.assert_allclose(list(answer.inelastic.values()), 0.0, atol=1e-15)
    probe = constitutive.probing_step(zone, field, stress, 0.01)
    normal = stress[:, 2].clip(0.0) / 2e3
    np.testing.assert_allclose(probe[:, 2], 0.01 * normal)
    np.testing.assert_allclose(probe[:, :2], 0.01 * stress[:, :2] / (shear or 1.0))

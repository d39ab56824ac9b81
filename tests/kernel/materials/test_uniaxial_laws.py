"""Steel and concrete of fibres along paths of strain, against closed forms written out here."""

import math

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS, check_parameters
from ssilang.kernel.materials.plastic.response import PointParameters

E, SY, SU, ESH, EU = 200e9, 400e6, 600e6, 0.02, 0.1
STEEL = {
    "YOUN": E, "NU": 0.3, "STSY": SY, "STSU": SU, "EPSH": ESH, "EPSU": EU, "ROFA": 20.0,
    "BFAC": 0.01, "A1FA": 18.5, "A2FA": 0.15, "FALD": 4.0, "A6FA": 0.0, "CFAC": 0.0, "AFAC": 0.0,
}  # fmt: skip
CONCRETE = {
    "YOUN": 30e9, "NU": 0.2, "STFC": 30e6, "EZER": 0.002, "STFT": 3e6, "ZETA": 100.0,
    "ST85": 6e6, "TRAF": 3.0, "ALF1": 0.0, "OME1": 0.0, "FAMX": -1.0,
}  # fmt: skip


def points(values: dict[str, float], m: int = 1) -> PointParameters:
    return PointParameters({n: np.full(m, float(v)) for n, v in values.items()}, {})


def along(name: str, values: dict[str, float], path: list[float]) -> list[float]:
    """Stresses at the ends of steps to the strains of a path."""
    law, p = PLASTIC_LAWS[name], points(values)
    stress, variables, last, out = np.zeros((1, 6)), np.zeros((1, len(law.variables))), 0.0, []
    for strain in path:
        step = np.zeros((1, 6))
        step[0, 0] = strain - last
        answer = law.respond(p, stress, step, variables)
        stress, variables, last = answer.stress, answer.variables, strain
        out.append(float(stress[0, 0]))
    return out


def test_first_loading_of_steel_has_a_plateau_and_a_curve_of_fourth_order() -> None:
    path = [0.001, 0.002, 0.01, 0.02, 0.05, 0.1, 0.12]
    wanted = [E * 0.001, SY, SY, SY, SU - (SU - SY) * (0.05 / 0.08) ** 4, SU, SU]
    assert along("ACIER_UNI", STEEL, path) == pytest.approx(wanted, rel=1e-12)
    down = along("ACIER_UNI", STEEL, [-e for e in path])
    assert down == pytest.approx([-s for s in wanted], rel=1e-12)
    # and a step does not matter where nothing turns round
    assert along("ACIER_UNI", STEEL, [0.05])[0] == pytest.approx(wanted[4], rel=1e-12)


def branch(e: float, er: float, sr: float, before: float, way: int, given: dict) -> float:
    """Giuffre, Menegotto and Pinto's curve, the two lines met by a linear solve."""
    b, ey = given["BFAC"], SY / E
    lines = np.array([[-E, 1.0], [-b * E, 1.0]])
    e0, s0 = np.linalg.solve(lines, [sr - E * er, way * (SY - b * E * ey)])
    xi = max((before - e0) / (e0 - er), 0.0)
    R = given["ROFA"] - given["A1FA"] * xi / (given["A2FA"] + xi)
    x = (e - er) / (e0 - er)
    return sr + (s0 - sr) * (b * x + (1 - b) * x / (1 + x**R) ** (1 / R))


def test_steel_that_turns_round_follows_menegotto_and_pinto() -> None:
    path = [0.03, 0.02, -0.01, 0.0, 0.025, 0.01]
    found = along("ACIER_UNI", STEEL, path)
    top = SU - (SU - SY) * (0.07 / 0.08) ** 4
    down = [branch(e, 0.03, top, -SY / E, -1, STEEL) for e in (0.02, -0.01)]
    up = [branch(e, -0.01, down[1], 0.03, 1, STEEL) for e in (0.0, 0.025)]
    last = branch(0.01, 0.025, up[1], -0.01, -1, STEEL)
    assert found == pytest.approx([top, *down, *up, last], rel=1e-10)


def test_a_small_unloading_of_steel_comes_back_to_the_first_curve() -> None:
    third = SY / E / 3
    found = along("ACIER_UNI", STEEL, [0.03, 0.03 - 0.9 * third, 0.05])
    assert found[2] == pytest.approx(SU - (SU - SY) * (0.05 / 0.08) ** 4, rel=1e-12)
    larger = along("ACIER_UNI", STEEL, [0.03, 0.03 - 1.1 * third, 0.05])
    assert larger[2] < 0.98 * found[2]  # cycles harden along BFAC


def test_steel_loses_no_energy_that_it_does_not_have() -> None:
    """A closed cycle of strain takes work: the area of its loop is that of the corners, rounded."""
    cycle = np.concatenate([np.linspace(a, b, 400)[1:] for a, b in ((0, 0.01), (0.01, -0.01),
                                                                    (-0.01, 0.01))])  # fmt: skip
    stress = np.array(along("ACIER_UNI", STEEL, list(cycle)))
    loop = slice(398, None)
    work = np.sum(0.5 * (stress[loop][1:] + stress[loop][:-1]) * np.diff(cycle[loop]))
    corners = 4 * SY * (0.01 - SY / E)  # elastic and perfectly plastic
    assert 0.6 * corners < work < corners * 1.2


SLENDER = {**STEEL, "FALD": 8.0, "A6FA": 620.0, "CFAC": 0.5, "AFAC": 0.006}


@together("given", [STEEL, SLENDER, CONCRETE])
def test_slopes_are_those_of_the_step_and_what_is_not_elastic_is_summed(given) -> None:
    """Steps to and fro, long and short, also beyond the curves' ends."""
    law = PLASTIC_LAWS["BETON_UNI" if given is CONCRETE else "ACIER_UNI"]
    p, rng, size = points(given), np.random.default_rng(6), 5e-3 if given is CONCRETE else 0.05
    stress, variables, compared = np.zeros((1, 6)), np.zeros((1, len(law.variables))), 0
    drawn = rng.uniform(-1.0, 1.0, 60) * rng.choice([0.05, 0.3, 1.0], 60)
    for step in size * np.concatenate([[0.6, 0.2], drawn]):

        def after(more, step=step, stress=stress, variables=variables):
            strain = np.array([[step + more, 0, 0, 0, 0, 0]])
            return law.respond(p, stress.copy(), strain, variables.copy())

        now, h = after(0.0), 1e-7 * size
        up, down = ((after(s * h).stress - now.stress)[0, 0] / (s * h) for s in (1, -1))
        if abs(up - down) < 1e-4 * given["YOUN"]:
            slope = now.tangent[0, 0, 0]
            assert slope == pytest.approx(0.5 * (up + down), abs=1e-5 * given["YOUN"])
            compared += 1
        if given is not CONCRETE:
            gone = abs(step - (now.stress - stress)[0, 0] / E)
            assert now.variables[0, 0] - variables[0, 0] == pytest.approx(gone)
        stress, variables = now.stress, now.variables
    assert compared > 50


def test_slender_bars_lose_strength_and_stiffness() -> None:
    """Monti and Nuti's branch down, and the softer one up behind it, for L / D = 8."""
    given = {**SLENDER, "A1FA": 0.0}
    found = along("ACIER_UNI", given, [0.03, -0.01, -0.03, -0.0295, 0.0])
    top, b = SU - (SU - SY) * (0.07 / 0.08) ** 4, 0.01
    e0 = (E * 0.03 - top - SY * (1 - b)) / (E * (1 - b))
    bc = 0.006 * (5 - 8) * math.exp((0.03 + SY / E) * b * E / (SY - 4 * SY / 8))
    s0 = -SY * (1 - b) + b * E * e0
    s0 -= (11 - 8) / (10 * (math.exp(4.0) - 1)) * b * E * (b - bc) / (1 - bc)

    def down(e: float) -> float:
        x = (e - 0.03) / (e0 - 0.03)
        return top + (s0 - top) * (bc * x + (1 - bc) * x / (1 + x**20) ** 0.05)

    assert found[1:3] == pytest.approx([down(-0.01), down(-0.03)], rel=1e-10)
    assert abs(found[2]) < abs(found[1])
    a5 = 1 + (5 - 8) / 7.5
    first = (SY * (1 - b) - found[2] - E * 0.03) / (E * (1 - b))
    soft = E * (a5 + (1 - a5) * math.exp(-620 * (0.03 - first) ** 2))
    # near the reversal the curve is its first line
    assert (found[3] - found[2]) / 0.0005 == pytest.approx(soft, rel=1e-6)
    assert soft < 0.95 * E
    s, er = found[2], -0.03  # the softer line meets that of hardening; far on the curve is near it
    e0 = (SY * (1 - b) + soft * er - s) / (soft - b * E)
    x, share = -er / (e0 - er), b * E / soft
    far = s + soft * (e0 - er) * (share * x + (1 - share) * x / (1 + x**20) ** 0.05)
    assert found[4] == pytest.approx(far, rel=1e-10)


@together(
    "change, rule",
    [
        ({"STSU": 3e8}, "STSY <= STSU"),
        ({"EPSH": 1e-3}, "STSY / YOUN <= EPSH"),
        ({"A1FA": 21.0}, "0 <= A1FA < ROFA"),
        ({"FALD": 12.0}, "0 <= FALD < 11"),
        ({"FALD": 8.0}, "CFAC > 0 (FALD > 5)"),
    ],
)
def test_steel_without_a_curve_is_refused(change: dict[str, float], rule: str) -> None:
    with refusal(MaterialError, "kernel.materials.law-condition") as caught:
        check_parameters(PLASTIC_LAWS["ACIER_UNI"], points({**STEEL, **change}))
    assert caught.value.data["rule"] == rule


def test_steel_at_the_ends_of_its_bounds_is_taken() -> None:
    ends = {"STSU": SY, "EPSH": SY / E, "BFAC": 0.0, "A1FA": 0.0, "FALD": 0.0}
    for change in ({name: end} for name, end in [*ends.items(), ("FALD", 5.0)]):
        check_parameters(PLASTIC_LAWS["ACIER_UNI"], points({**STEEL, **change}))
    assert along("ACIER_UNI", STEEL | {"STSU": SY}, [0.001, 0.05]) == pytest.approx([E * 0.001, SY])


def test_concrete_has_hognestad_s_parabola_a_line_and_a_rest() -> None:
    path = [-0.0005, -0.001, -0.002, -0.006, -0.02]
    x = np.array([0.25, 0.5, 1.0])
    wanted = [*(-30e6 * x * (2 - x)), -30e6 * (1 - 100 * 0.004), -6e6]
    assert along("BETON_UNI", CONCRETE, path) == pytest.approx(wanted, rel=1e-12)


def test_confined_concrete_has_the_strength_and_strain_of_the_model_code() -> None:
    """beta = 1 + 2.5 a w; behind the peak the line goes through 0.85 STFC at 0.0035 + 0.1 a w."""
    given = {**CONCRETE, "ALF1": 0.5, "OME1": 0.1, "ZETA": 0.0, "EZER": 0.002}
    beta = 1.125
    found = along("BETON_UNI", given, [-(beta**2) * 0.002, -(0.0035 + 0.1 * 0.05)])
    assert found == pytest.approx([-beta * 30e6, -0.85 * 30e6], rel=1e-12)
    strong = {**given, "OME1": 0.4}  # a w = 0.2: 1.125 + 1.25 a w is less than 1 + 2.5 a w
    beta = 1.125 + 1.25 * 0.2
    assert along("BETON_UNI", strong, [-(beta**2) * 0.002])[0] == pytest.approx(-beta * 30e6)


def test_concrete_unloads_and_comes_back_by_its_damaged_slope() -> None:
    x = 0.5
    slope = 30e9 * (1 + x) / (1 + x + x * x)
    left = -0.001 + 22.5e6 / slope
    found = along("BETON_UNI", CONCRETE, [-0.001, -0.0008, left, -0.0009, -0.001, -0.002])
    wanted = [-22.5e6, -22.5e6 + slope * 0.0002, 0.0, slope * (-0.0009 - left), -22.5e6, -30e6]
    assert found == pytest.approx(wanted, abs=1.0)


def test_concrete_cracks_softens_and_closes_where_the_crack_began() -> None:
    crack = 3e6 / 30e9
    whole = along("BETON_UNI", CONCRETE, [0.6 * crack, 0.2 * crack, 0.5 * crack])
    assert whole == pytest.approx([1.8e6, 0.6e6, 1.5e6])
    path = [crack, 2 * crack, crack, 0.0, -0.0005, 0.0, 2.5 * crack, 3 * crack, 4 * crack]
    found = along("BETON_UNI", CONCRETE, path)
    x = 0.25
    slope = 30e9 * (1 + x) / (1 + x + x * x)
    left = -0.0005 + 30e6 * x * (2 - x) / slope  # the crack begins there from now on
    begun = -left * 0.75e6 / crack
    assert found[:5] == pytest.approx([3e6, 1.5e6, 0.75e6, 0.0, -30e6 * x * (2 - x)], abs=1.0)
    assert found[5] == pytest.approx(begun, rel=1e-9)
    far = 3e6 * (1 - (2.5 * crack - left - crack) / (2 * crack))
    assert found[6] == pytest.approx(max(far, 0.0), rel=1e-9)
    assert found[7:] == pytest.approx([0.0, 0.0], abs=1e-6)


@together("widest, at", [(1.5, 1.5), (2.5, 2.5), (2.5, 1.25), (3.5, 3.5)])
def test_the_slope_of_a_crack_is_that_of_what_follows_as_it_opens(widest: float, at: float) -> None:
    """Behind the widest opening it softens, before it goes back to where it began."""
    law, p, crack = PLASTIC_LAWS["BETON_UNI"], points(CONCRETE), 3e6 / 30e9
    state = [np.zeros((1, 6)), np.zeros((1, len(law.variables)))]
    for step in (widest * crack, (at - widest) * crack):
        answer = law.respond(p, state[0], np.array([[step, 0, 0, 0, 0, 0]]), state[1])
        state = [answer.stress, answer.variables]
    on = law.respond(p, state[0], np.array([[1e-3 * crack, 0, 0, 0, 0, 0]]), state[1])
    slope = (on.stress[0, 0] - answer.stress[0, 0]) / (1e-3 * crack)
    assert answer.tangent[0, 0, 0] == pytest.approx(slope, rel=1e-6, abs=1.0)


@together(
    "change, code",
    [
        ({"FAMX": 10.0}, "soft-crack-closing"),
        ({"ALF1": 0.2, "OME1": 0.3}, "slope-and-confinement"),
        ({"TRAF": 1.0}, "law-condition"),
        ({"ZETA": 0.0, "EZER": 0.004}, "law-condition"),
        ({"ZETA": 0.0, "EZER": 0.01, "ALF1": 0.5, "OME1": 0.1}, "law-condition"),
    ],
)
def test_concrete_without_equations_is_refused(change: dict[str, float], code: str) -> None:
    with refusal(MaterialError, f"kernel.materials.{code}"):
        check_parameters(PLASTIC_LAWS["BETON_UNI"], points({**CONCRETE, **change}))

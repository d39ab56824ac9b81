"""The schemes against the papers' coefficients, and their steps against the equations themselves.

The reference here shares nothing with the package: three linear equations a step (balance at the
weighted instants, Newmark's two formulas), solved as they are written, with coefficients that
stand as numbers.
"""

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import recorded
from refusing import refusal
from script_runs import ran
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.stepping.newmark import generalised_alpha, hht, newmark

MASS, STIFFNESS, DASHPOT = 2.0, 800.0, 3.0  # 20 rad/s, 3.75 % of critical damping

# alpha_m, alpha_f, beta, gamma
TABLE = {
    "average acceleration": (newmark(), (0.0, 0.0, 1 / 4, 1 / 2)),
    "any stable pair": (newmark(0.7, 0.9), (0.0, 0.0, 0.7, 0.9)),
    # Hilber, Hughes and Taylor 1977: beta = (1 + a)^2 / 4, gamma = 1/2 + a
    "HHT 0.1": (hht(0.1), (0.0, 0.1, 0.3025, 0.6)),
    "HHT -0.1, as in the paper": (hht(-0.1), (0.0, 0.1, 0.3025, 0.6)),
    "HHT 0.3": (hht(0.3), (0.0, 0.3, 0.4225, 0.8)),
    # Chung and Hulbert 1993: (2 r - 1) / (r + 1), r / (r + 1), (1 - am + af)^2 / 4, 1/2 - am + af
    "alpha 0": (generalised_alpha(0.0), (-1.0, 0.0, 1.0, 1.5)),
    "alpha 0.5": (generalised_alpha(0.5), (0.0, 1 / 3, 4 / 9, 5 / 6)),
    "alpha 0.8": (generalised_alpha(0.8), (1 / 3, 4 / 9, 25 / 81, 11 / 18)),
    "alpha 1": (generalised_alpha(1.0), (1 / 2, 1 / 2, 1 / 4, 1 / 2)),
}


def one_step(numbers, m, c, k, dt, state, load, next_load):
    """u, v, a at the end of a step, from balance and Newmark's formulas as they are written."""
    am, af, beta, gamma = numbers
    u, v, a = state
    system = np.array(
        [
            [(1 - af) * k, (1 - af) * c, (1 - am) * m],
            [1.0, 0.0, -beta * dt**2],
            [0.0, 1.0, -gamma * dt],
        ]
    )
    right = [
        (1 - af) * next_load + af * load - af * (k * u + c * v) - am * m * a,
        u + dt * v + dt**2 * (0.5 - beta) * a,
        v + dt * (1 - gamma) * a,
    ]
    return np.linalg.solve(system, right)


def by_the_equations(numbers, times, loads, u0, v0):
    """The motion (n_times, 3) of the oscillator."""
    a0 = (loads[0] - DASHPOT * v0 - STIFFNESS * u0) / MASS
    states = [np.array([u0, v0, a0])]
    for i in range(1, len(times)):
        dt = times[i] - times[i - 1]
        states.append(
            one_step(numbers, MASS, DASHPOT, STIFFNESS, dt, states[-1], *loads[i - 1 : i + 1])
        )
    return np.array(states)


@together("scheme, numbers", TABLE.values())
def test_coefficients_are_those_of_the_papers(scheme, numbers):
    found = (scheme.alpha_m, scheme.alpha_f, scheme.beta, scheme.gamma)
    np.testing.assert_allclose(found, numbers, rtol=1e-14, atol=1e-15)


def test_only_the_average_acceleration_keeps_the_energy_of_linear_systems():
    kept = {name for name, (scheme, _) in TABLE.items() if scheme.average_acceleration}
    assert kept == {name for name, (_, numbers) in TABLE.items() if numbers == (0, 0, 0.25, 0.5)}
    assert "average acceleration" in kept


@together("beta, gamma", [(0.25, 0.49), (0.24, 0.5), (0.29, 0.6)])
def test_newmark_refuses_what_is_not_stable_at_any_step(beta, gamma):
    with refusal(KernelError, "kernel.stepping.newmark-scheme-beta-gamma"):
        newmark(beta, gamma)


@together("make", [lambda: hht(0.34), lambda: generalised_alpha(1.01)])
def test_parameters_out_of_range_are_refused(make):
    with pytest.raises(KernelError) as refused:
        make()
    assert refused.value.code.startswith("kernel.stepping.")


def oscillator(scheme, times, u0, v0, factors, others=0):
    """The oscillator, and others that stand still: many unknowns ask for other loops."""
    bench = Bench()
    top = bench.node(0.0, 0.0)
    bench.spring(STIFFNESS, top, unknown="UX")
    bench.mass(MASS, top)
    bench.dashpot(DASHPOT, top, "UX")
    bench.fix(top, "UY")
    for i in range(others):
        node = bench.node(1.0 + i, 0.0)
        bench.spring(50.0, node, unknown="UX")
        bench.mass(1.0, node)
        bench.dashpot(0.5 + 0.1 * i, node, "UX")
        bench.fix(node, "UY")
    problem = bench.problem(
        times,
        bench.load(bench.field((top, "FX", 1.0)), times, factors),
        displacement=bench.field((top, "UX", u0)),
        velocity=bench.field((top, "UX", v0)),
        scheme=scheme,
    )
    return problem, problem.numbering.index_of(top, "UX")


@together("way", ["default", "full Newton", "sparse"])
@together("scheme, numbers", TABLE.values())
def test_steps_are_those_of_the_equations(scheme, numbers, way, monkeypatch):
    if way == "sparse":
        monkeypatch.setattr("ssilang.kernel.stepping.problem.problem.SMALL", 0)
    times = np.concatenate([np.arange(40) * 0.01, 0.4 + np.arange(20) * 0.025])
    factors = 5.0 * np.cos(13.0 * times)
    problem, i = oscillator(scheme, times, 0.02, -0.7, factors, others=3 * (way != "default"))
    recorder, _ = recorded(problem, full_newton=way == "full Newton")
    exact = by_the_equations(numbers, times, factors, 0.02, -0.7)
    for column, name in enumerate("uva"):
        size = np.abs(exact[:, column]).max()
        np.testing.assert_allclose(recorder.of(name)[:, i], exact[:, column], atol=1e-11 * size)


@together("entry", [("GAMMA", 0.7), ("RHO_INF", 0.5), ("ALPHA_F", 0.1)])
def test_entries_of_dynamic_choose_the_scheme(entry, tmp_path):
    """GAMMA alone takes the beta that damps most without losing stability, (gamma + 1/2)^2 / 4."""
    name, value = entry
    numbers = {"GAMMA": (0.0, 0.0, 0.36, 0.7), "RHO_INF": (0.0, 1 / 3, 4 / 9, 5 / 6)}
    deck = f"""
    OPTI DIME 2 MODE PLAN ; P = 0. 0. ;
    K = (MANU 'RIGI' P (MOTS 'UX' 'UY') (PROG {STIFFNESS} 0. 0. 1.)) ET (BLOQ 'UY' P) ;
    M = MANU 'RIGI' 'TYPE' 'MASSE' P (MOTS 'UX' 'UY') (PROG {MASS} 0. 0. {MASS}) ;
    C = MANU 'RIGI' 'TYPE' 'AMORTISSEMENT' P (MOTS 'UX' 'UY') (PROG {DASHPOT} 0. 0. 0.) ;
    T1 = TABL ; T1 . 'RIGI' = K ; T1 . 'MASS' = M ; T1 . 'AMOR' = C ;
    T1 . 'DEPL' = MANU 'CHPO' P 1 'UX' 0.02 ; T1 . 'VITE' = MANU 'CHPO' P 1 'UX' -0.7 ;
    T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.01 0.5 ;
    T1 . '{name}' = {value} ; T1 . 'PAS_SAUVES' = 1 ;
    T2 = DYNAMIC T1 ;
    U = EXTR (EVOL 'TEMP' T2 'DEPL' 'UX' P) 'ORDO' ;
    """
    result = ran(deck, output_directory=tmp_path)
    found = result.session.root.find("U").values
    times = np.arange(51) * 0.01
    numbers = numbers.get(name, TABLE["HHT 0.1"][1])
    exact = by_the_equations(numbers, times, np.zeros(51), 0.02, -0.7)[:, 0]
    np.testing.assert_allclose(found, exact, atol=1e-10 * np.abs(exact).max())

"""Figures of the decks against the reference solutions, not against the decks' own formulas."""

from collections.abc import Callable

import numpy as np
import pytest
from references.bar import Bar, solve_bar
from references.contact import solve
from references.footing import (
    Disc,
    Rectangle,
    Strip,
    onset_acceleration,
    onset_ramp_time,
    onset_step_acceleration,
)
from references.oscillators import STRUCTURE_STIFFNESS, ClubA, ClubB, ClubC
from references.rocking import FlexibleTower, RigidTower, TwoSpringBlock, macro_element_period
from references.soil_column import Column, bundle
from scipy.optimize import brentq

from ssilang.cli.run import RunResult

from .running import numbers, variable


def hopping(case: ClubB | ClubC) -> Callable[[RunResult], None]:
    """The last and finest motion of club-b or club-c."""

    def compare(result: RunResult) -> None:
        t, u, v = (numbers(result, n) for n in ("LT", "LU", "LV"))
        exact_u, exact_v = case.motion(t)
        assert len(t) >= 4001
        assert np.max(np.abs(u - exact_u)) <= 2e-3 * np.max(np.abs(exact_u))
        assert np.max(np.abs(v - exact_v)) <= 5e-3 * np.max(np.abs(exact_v))

    return compare


def methods_on_a_wall(result: RunResult) -> None:
    """Corrected methods follow the rigid wall, penalty and SDM a wall of their stiffness."""
    curves = variable(result, "EVU").parts
    # impacts are seen at the end of their step: a lag of less than a step for each of the eight
    t, u = curves[2].abscissas, curves[2].ordinates
    error = np.max(np.abs(u - ClubA().motion(t)[0]))
    assert error <= 8 * (t[1] - t[0]) * ClubA().u0 * ClubA().w
    soft = ClubB(k_y=1e4 * STRUCTURE_STIFFNESS)
    for method in (1, 7):
        t, u = curves[method - 1].abscissas, curves[method - 1].ordinates
        assert np.max(np.abs(u - soft.motion(t)[0])) <= 1e-2 * soft.u0


def rocking(result: RunResult) -> None:
    """The whole history, not only the deck's samples."""
    block = TwoSpringBlock(1e5, 8e5, 5.0, 1.5, 5e7)
    start = np.array([1.5 * 0.01 - block.weight / block.k, 0.01])
    motion = solve(block.system(), start, np.zeros(2), 2.0)
    exact = motion(numbers(result, "LT"))[0]
    assert np.max(np.abs(numbers(result, "LTH") - exact[:, 1])) <= 3e-4 * 0.01
    assert np.max(np.abs(numbers(result, "LV") - exact[:, 0])) <= 1e-3 * np.ptp(exact[:, 0])


def tower(result: RunResult) -> None:
    """The mass's whole history and the column's deflection."""
    model = FlexibleTower(8e4, 4e4, 1.2e5, 8.0, 2.0, 6e6, 4e7)
    motion = solve(model.system(8.0, np.pi / 0.25), model.rest, np.zeros(3), 2.0)
    exact = motion(numbers(result, "LT"))[0]
    top = exact @ np.array([1.0, 0.0, -8.0])
    assert np.max(np.abs(numbers(result, "LU") - top)) <= 1e-3 * np.max(np.abs(top))
    assert np.max(np.abs(numbers(result, "LQ") - exact[:, 0])) <= 5e-3 * np.max(np.abs(exact[:, 0]))


def tower_3d(result: RunResult) -> None:
    """The whole history of lift and rotations."""
    model = RigidTower(1e5, 3.2e6, 5.0, 1.5, 2.0, 4e7)
    system = model.system(np.pi / 0.25, (4.0, 1.5, 2.0), (1.0, 5.0, -2.0))
    motion = solve(system, model.rest, np.zeros(3), 2.0)
    exact = motion(numbers(result, "LT"))[0]
    for column, name in enumerate(("LV", "LTHX", "LTHY")):
        error = np.abs(numbers(result, name) - exact[:, column]).max()
        assert error <= 1e-3 * np.abs(exact[:, column]).max(), name


def raft_3d(result: RunResult) -> None:
    """Position at every angle; the reference is in equilibrium there."""
    width, length, k0, normal, moment = (
        float(variable(result, n)) for n in ("B0", "L0", "K0", "N0", "M0")
    )
    model = Rectangle(width, length, k0, normal)
    angles = np.radians(numbers(result, "LANG"))
    found = np.stack([numbers(result, n) for n in ("LV", "LTHX", "LTHY")], axis=1)
    exact = np.array([model.position(moment * np.cos(a), moment * np.sin(a)) for a in angles])
    assert np.all(np.abs(found - exact).max(axis=0) <= 1e-4 * np.abs(exact).max(axis=0))


def bar(result: RunResult) -> None:
    """Foot and top of the bar up to its release."""
    motion, t = solve_bar(Bar(), 3.0), numbers(result, "LT")
    touching = t <= motion.releases[0]
    for name, x in (("LPIE", 0.0), ("LTOP", 10.0)):
        error = numbers(result, name) - 5.0 - motion.displacement(x, t)
        assert np.max(np.abs(error[touching])) <= 1e-2 * 5.0, name


def strip(result: RunResult) -> None:
    """Moment before and after lift-off."""
    width, k0, normal = (float(variable(result, n)) for n in ("B0", "K0", "N0"))
    model = Strip(width, 1.0, k0, normal)
    ratio, moment = numbers(result, "LTHE"), numbers(result, "LMOM")
    exact = model.moment(ratio * model.uplift_rotation) / model.uplift_moment
    lifted = ratio >= 1.5
    assert np.max(np.abs(moment[lifted] / exact[lifted] - 1.0)) <= 3e-3
    assert moment[ratio < 1.0] == pytest.approx(ratio[ratio < 1.0], rel=1e-9, abs=1e-12)


def disc(result: RunResult) -> None:
    """Moment at every rotation of the deck."""
    model = Disc(*(float(variable(result, n)) for n in ("R0", "K0", "N0")))
    ratio, moment = numbers(result, "LTHE"), numbers(result, "LMOM")
    exact = [float(model.moment(r * model.uplift_rotation)) / model.uplift_moment for r in ratio]
    assert moment == pytest.approx(exact, rel=1e-2)


def macro_element(result: RunResult) -> None:
    """The exact period that the deck holds is the reference's."""
    width, k0, normal, inertia = (float(variable(result, n)) for n in ("B0", "K0", "N0", "I0"))
    model = Strip(width, 1.0, k0, normal)
    exact = macro_element_period(model, inertia, 3.0 * model.uplift_rotation)
    assert variable(result, "PERX") == pytest.approx(exact, rel=1e-9)
    assert variable(result, "PER1") == pytest.approx(exact, rel=2e-4)


def block_on_soil(result: RunResult) -> None:
    """The VTK series: 51 instants of three parts, the joint as open as the deck's history says."""
    import pyvista
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(str(result.session.output_directory / "block.vtkhdf"))
    reader.UpdateInformation()
    steps = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = reader.GetOutputInformation(0).Get(steps)
    assert len(times) == 51
    step = next(i for i, t in enumerate(times) if t > 0.6)
    time = times[step]
    reader.SetStep(step)
    reader.Update()
    blocks = pyvista.wrap(reader.GetOutput())
    assert set(blocks.keys()) == {"soil", "block", "joint"}
    joint = blocks["joint"]
    opening, traction = joint.cell_data["opening"][:, 0], joint.cell_data["traction"][:, 0]
    lift = np.interp(time, numbers(result, "LT"), numbers(result, "LG"))
    # the first cell's mean lies a quarter metre inside the edge of the four metres
    assert opening[0] == pytest.approx(lift, rel=0.1)
    # a cell that the end of contact crosses has one open point and one closed
    assert np.all(traction <= 1e-6)
    assert np.all(traction[opening > 5e-3] == 0.0)
    soil = blocks["soil"]
    assert {"displacement", "velocity"} <= set(soil.point_data)
    assert "stress" in soil.cell_data


def onset(result: RunResult) -> None:
    """Edges before and beyond the onset, and the accelerations, against the closed forms."""
    strip_, disc_ = Strip(4.0, 1.0, 2e7, 6e5), Disc(2.0, 2e7, 6e5)
    ratios = numbers(result, "LRAT")
    edges: dict[str, list[float]] = {"LESTR": [], "LEDIS": []}
    for ratio in ratios:
        theta = brentq(lambda t, r=ratio: strip_.moment(t) - r * strip_.uplift_moment, 0.0, 1.0)
        lifted = float(strip_.lift(theta)) + theta * strip_.width / 2
        edges["LESTR"].append(lifted / (strip_.normal / (strip_.k0 * strip_.width)))
        theta = brentq(lambda t, r=ratio: disc_.moment(t) - r * disc_.uplift_moment, 1e-9, 1.0)
        phi = disc_.half_angle(theta)
        settled = disc_.normal / (disc_.k0 * np.pi * disc_.radius**2)
        lifted = disc_.radius * theta * (1 + np.cos(phi))
        if ratio <= 1:
            lifted = disc_.radius * theta - settled
        edges["LEDIS"].append(lifted / settled)
    # Gauss points see the contact's end to a fraction of a cell; the disc is a polygon
    assert numbers(result, "LESTR") == pytest.approx(edges["LESTR"], abs=5e-3)
    assert numbers(result, "LEDIS") == pytest.approx(edges["LEDIS"], rel=1e-2, abs=1e-2)
    inertia, height = 5e4 * 30.0, 5.0
    wanted = onset_acceleration(strip_.kern, height)
    assert variable(result, "AU0") == pytest.approx(wanted, rel=1e-12)
    time = onset_ramp_time(20.0, float(np.sqrt(strip_.stiffness / inertia)))
    assert variable(result, "TRAM") == pytest.approx(time, rel=1e-5)
    sudden = onset_step_acceleration(strip_.kern, height)
    assert variable(result, "ASUD") * wanted == pytest.approx(sudden, rel=1e-4)


def soil_column(result: RunResult) -> None:
    """Surface and strains at all times against explicit steps of springs that slip."""
    speeds, references = (
        np.repeat([300.0, 250, 200, 160], 5),
        np.repeat([15e-4, 12e-4, 1e-3, 8e-4], 5),
    )
    x = np.tan(np.arange(1, 21) * np.pi / 42) ** 2
    slips, shares = bundle(x, np.append(1.0, 1 / (1 + x[1:])))
    damped = (0.04 * np.pi * 10 / 11, 0.01 / (np.pi * 11))
    column = Column(
        np.ones(20), np.full(20, 1900.0), 1900 * speeds**2, references[:, None] * slips,
        np.tile(shares, (20, 1)), *damped,
    )  # fmt: skip
    given = numbers(result, "LTE"), numbers(result, "LAE")
    step = 1.25e-4
    fine = np.arange(0.0, given[0][-1] + 1e-9, step)
    u, strain, stress = column.shaken(np.interp(fine, *given), step)
    whole = round((given[0][1] - given[0][0]) / step)
    # average acceleration at 200 steps a second; half the step leaves a fourth of these errors
    for name, wanted, share in (
        ("LTOP", u[:, -1], 5e-3), ("LGLO", strain[:, 0], 0.025), ("LSLO", stress[:, 0], 0.025),
        ("LGMI", strain[:, 10], 0.01), ("LSMI", stress[:, 10], 0.02),
        ("LGHI", strain[:, 15], 0.02), ("LSHI", stress[:, 15], 0.04),
    ):  # fmt: skip
        error = np.abs(numbers(result, name) - wanted[::whole]).max()
        assert error <= share * np.abs(wanted).max(), name


COMPARISONS: dict[str, Callable[[RunResult], None]] = {
    "club_cast3m_2014/club_a_methods.ssi": methods_on_a_wall,
    "club_cast3m_2014/club_b_sdm.ssi": hopping(ClubB()),
    "club_cast3m_2014/club_c_sdm.ssi": hopping(ClubC()),
    "club_cast3m_2014/rocking_two_pairs.ssi": rocking,
    "footing/strip_uplift.ssi": strip,
    "footing/disc_uplift.ssi": disc,
    "footing/macro_element.ssi": macro_element,
    "footing/onset_of_uplift.ssi": onset,
    "footing/flexible_tower.ssi": tower,
    "footing/block_on_soil.ssi": block_on_soil,
    "footing/tower_3d.ssi": tower_3d,
    "footing/raft_3d.ssi": raft_3d,
    "seismic/soil_column.ssi": soil_column,
    "impact/bar_bounce.ssi": bar,
}

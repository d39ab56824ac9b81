"""Figures of the decks against the reference solutions, not against the decks' own formulas."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from references.footing import Strip
from references.oscillators import STRUCTURE_STIFFNESS, ClubA, ClubB, ClubC

from ssilang.language.values import Table

from .running import CASES, numbers, run_deck, variable


@pytest.mark.parametrize(
    ("name", "case"), [("club_b_sdm", ClubB()), ("club_c_sdm", ClubC())], ids=["club-b", "club-c"]
)
def test_hopping_oscillator_follows_the_exact_motion(name: str, case, tmp_path: Path):
    result = run_deck(CASES / "club_cast3m_2014" / f"{name}.ssi", tmp_path)
    assert result.exit_code == 0, result.message
    t, u, v = (numbers(result, n) for n in ("LT", "LU", "LV"))
    exact_u, exact_v = case.motion(t)
    assert len(t) >= 4001
    assert np.max(np.abs(u - exact_u)) <= 2e-3 * np.max(np.abs(exact_u))
    # where the force jumps the velocity is as exact as the displacement
    assert np.max(np.abs(v - exact_v)) <= 5e-3 * np.max(np.abs(exact_v))


def test_strip_moment_follows_the_closed_form(tmp_path: Path):
    result = run_deck(CASES / "footing" / "strip_uplift.ssi", tmp_path)
    assert result.exit_code == 0, result.message
    width, k0, normal = (float(variable(result, n)) for n in ("B0", "K0", "N0"))
    strip = Strip(width, 1.0, k0, normal)
    ratio, moment = numbers(result, "LTHE"), numbers(result, "LMOM")
    exact = strip.moment(ratio * strip.uplift_rotation) / strip.uplift_moment
    lifted = ratio >= 1.5
    assert np.max(np.abs(moment[lifted] / exact[lifted] - 1.0)) <= 3e-3
    assert moment[ratio < 1.0] == pytest.approx(ratio[ratio < 1.0], rel=1e-9, abs=1e-12)


def test_methods_on_the_rigid_wall_follow_their_own_exact_motions(tmp_path: Path):
    result = run_deck(CASES / "club_cast3m_2014" / "club_a_methods.ssi", tmp_path)
    assert result.exit_code == 0, result.message

    def history(method: int) -> tuple[np.ndarray, np.ndarray]:
        tables = [variable(result, n) for n in ("TT", "TU")]
        assert all(isinstance(t, Table) for t in tables)
        t, u = (t.get(method).values for t in tables)
        return t, u

    # impacts are seen at the end of their step: a lag of less than a step for each of the eight
    t, u = history(3)
    exact = ClubA().motion(t)[0]
    step = t[1] - t[0]
    assert np.max(np.abs(u - exact)) <= 8 * step * ClubA().u0 * ClubA().w
    # a joint of stiffness 1e4 k_s is the bilinear oscillator of that stiffness
    soft = ClubB(k_y=1e4 * STRUCTURE_STIFFNESS)
    for method in (1, 7):
        t, u = history(method)
        assert np.max(np.abs(u - soft.motion(t)[0])) <= 1e-2 * soft.u0

"""The figures of the page of questions: its deck runs with some of the rows of its tables."""

import re
from functools import cache
from pathlib import Path

import pytest
from script_runs import ran

_DOCS = Path(__file__).resolve().parents[2] / "docs"
_PAGE = (_DOCS / "faq.md").read_text(encoding="utf-8")
_DECK = re.findall(r"```ssi\n(.*?)```", _PAGE, re.DOTALL)[0]


def row(start: str) -> list[str]:
    line = next(t for t in _PAGE.splitlines() if t.startswith(f"| {start} |"))
    return [cell.strip() for cell in line.strip("|").split("|")]


@cache
def found(**changed: str) -> list[float]:
    deck = _DECK
    for name, value in changed.items():
        deck = re.sub(rf"{name} = \S+ ;", f"{name} = {value} ;", deck, count=1)
    result = ran(deck)
    return [result.session.root.find(n) for n in ("LIFT", "ACCE", "ERR1")]


def test_the_step_costs_energy_before_displacement():
    for start, changed in (("2 ms", {"DT0": "2.E-3"}), ("1 ms", {})):
        lift, _, error = found(**changed)
        _, told_lift, told_error = row(start)
        assert f"{1e3 * lift:.2f} mm" == told_lift
        assert error == pytest.approx(float(told_error), rel=0.05)
    lift, _, error = found(CONSERVE="VRAI")
    assert row("1 ms, `CONSERVATIF = VRAI`")[1] == f"{1e3 * lift:.2f} mm"
    assert error < 1e-11


def test_a_stiffer_joint_rings_more_and_lifts_the_same():
    soft, hard = found(), found(KN0="2.E9")
    assert row("average acceleration")[1] == f"{1e3 * hard[0]:.2f} mm"
    assert abs(hard[0] / soft[0] - 1) < 0.08
    assert hard[1] > 2 * soft[1]

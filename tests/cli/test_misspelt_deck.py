"""`ssilang check` finds slips of the fingers in a whole deck, each at its place, and no other."""

import re
from pathlib import Path

from together import together

from ssilang.cli.check import check_source
from ssilang.language.say.diagnostics import render
from ssilang.language.text.source import Source

_DECK = Path(__file__).resolve().parents[2] / "cases" / "footing" / "block_on_soil.ssi"
_SLIPS = {
    "operator": ("SIG0 = SIGM MOJ", "SIG0 = SGIM MOJ", "SGIM", "SIGM"),
    "option": ("OPTI DIME 2 MODE PLAN", "OPTI DIEM 2 MODE PLAN", "DIEM", "DIME"),
    "parameter": ("MATE MOS 'YOUN' YOUS", "MATE MOS 'YUON' YOUS", "YUON", "YOUN"),
    "entry": ("'TEMPS_CALCULES' =", "'TEMPS_CALCULS' =", "TEMPS_CALCULS", "TEMPS_CALCULES"),
    "keyword": ("LTP = PROG 0. 'PAS' 0.002", "LTP = PROG 0. 'PSA' 0.002", "PSA", "PAS"),
    "law": ("'JOINT_SDM' 'JOI2'", "'JOINT_SMD' 'JOI2'", "JOINT_SMD", "JOINT_SDM"),
    "component": ("BLO = (BLOQ 'UX' 'UY'", "BLO = (BLOQ 'UXX' 'UY'", "UXX", "UX"),
}


def _text() -> str:
    return _DECK.read_text(encoding="utf-8")


def _said(text: str) -> list[str]:
    problems, names = check_source(Source("deck", text))
    return [render(p, "en", names) for p in problems]


def test_the_deck_itself_is_sound():
    assert _text().count("\n") > 150
    assert _said(_text()) == []


@together("kind", _SLIPS)
def test_one_slip_is_found_where_it_stands(kind):
    right, wrong, word, meant = _SLIPS[kind]
    assert _text().count(right) == 1
    said = _said(_text().replace(right, wrong))
    line = next(n for n, t in enumerate(_text().replace(right, wrong).split("\n"), 1) if wrong in t)
    other = rf"(?<!\w){meant}(?!\w)"  # UX stands in UXX
    found = [s for s in said if word in s and re.search(other, s) and f":{line}:" in s]
    assert found, said


@together("own", ["HUMI", "SALINITY", "VX", "EIXX", "DRUCK"])
def test_a_name_of_one_s_own_that_is_near_no_component_is_no_slip(own):
    field = f"P1 = 0. 0. ; C = MANU 'CHPO' P1 1 '{own}' 2. ; LIST C ;"
    assert _said(f"OPTI DIME 2 ; {field}") == []


def test_seven_slips_are_found_together_and_nothing_else():
    text = _text()
    for right, wrong, _, _ in _SLIPS.values():
        text = text.replace(right, wrong)
    said = _said(text)
    for word in (word for _, _, word, _ in _SLIPS.values()):
        assert any(word in s for s in said), word
    assert len(said) == len(_SLIPS), said

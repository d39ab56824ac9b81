"""What operators refuse, why, where and in which words: scripts of `test_refusals.toml`."""

import tomllib
from pathlib import Path

import pytest
import script_runs
from together import together

from ssilang.cli.check import check_source
from ssilang.language.text.source import Source

ROWS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def assert_refused(script, code, said, folder):
    result = script_runs.failed(script, folder)
    assert [error.code for error in result.errors if error.severity == "error"] == [code], script
    for words in said:
        assert words in result.message


@pytest.mark.parametrize("code", ROWS["before_the_run"])
def test_check_says_the_same_at_the_same_place(code):
    """Of as many scripts as their types and words alone condemn."""
    found = 0
    for script in ROWS["refused"][code]:
        before, _, rest = (ROWS["before"] + script + " ;").partition("«")
        place, _, after = rest.partition("»")
        problems, _ = check_source(Source("script", before + place + after))
        told = [(p.code, p.span.start, p.span.end) for p in problems if p.severity == "error"]
        found += told == [(code, len(before), len(before) + len(place))]
    assert found >= ROWS["before_the_run"][code]


@together("code", ROWS["refused"])
def test_it_is_refused_for_its_reason_and_at_its_place(code, tmp_path):
    for script in ROWS["refused"][code]:
        assert_refused(ROWS["before"] + script + " ;", code, (), tmp_path)


TOLD = [
    (group["before"] + script, code, said)
    for group in ROWS["told"].values()
    for code, script, *said in group["rows"]
]


@together("script, code, said", TOLD)
def test_it_is_told(script, code, said, tmp_path):
    assert_refused(script, code, said, tmp_path)


SHOWN = {
    "CHAN TYPE E": "CHAM2 = CHAN 'TYPE' CHAM1 MOT1",
    "CHAN QUA8": "GEO2 = CHAN (TYPE) GEO1 (LENTI1)",
    "MANU QUA4 LI": "GEO1 = MANU TYPE POIN1 POIN2 ...|GEO2 (COUL1)",
    "INTE S C": "GEO3 = GEO1 INTE GEO2 ('NOVERIF')",
    "EXTR M 3": "OBJ1 = EXTR MODL1 'MAIL' | 'ZONE'",
    "MFIL S": "RIG1 = MFIL CHPO1 (X1 (X2 (X3))) (MOT1 (MOT2))",  # its only one
}


@together("script, syntax", SHOWN.items())
def test_the_syntax_shown_is_that_of_the_form_that_was_begun(script, syntax, tmp_path):
    message = script_runs.refused(f"{ROWS['before']} X = {script} ;", tmp_path)
    assert message.endswith(f"  = {syntax} ;")

"""OPTI 'MODE' takes back what VALE 'MODE' says."""

import pytest
from script_runs import ran


@pytest.mark.parametrize("mode", ["PLAN CONT", "PLAN DEFO", "PLAN GENE", "AXIS"])
def test_mode_is_set_again_by_its_own_word(mode):
    result = ran(
        f"OPTI DIME 2 MODE {mode} ; M = VALE 'MODE' ; OPTI DIME 3 ; OPTI DIME 2 ; OPTI 'MODE' M ; "
        "N = VALE 'MODE' ; L = EGA M N ;"
    )
    assert result.session.root.find("L") is True

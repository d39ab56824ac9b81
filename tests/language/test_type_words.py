"""Type words are compared on their eight letters."""

from script_runs import ran


def test_a_longer_type_word_of_a_parameter_is_cut() -> None:
    script = "DEBP F L1*'LISTREELS' N1/ENTIERS ; N2 = DIME L1 ; FINP N2 ; X = F (PROG 1. 2.) ;"
    result = ran(script)
    assert result.session.root.find("X") == 2

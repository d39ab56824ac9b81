"""Type words are compared on their eight letters."""

from ssilang.cli.run import run_text


def test_a_longer_type_word_of_a_parameter_is_cut() -> None:
    script = "DEBP F L1*'LISTREELS' N1/ENTIERS ; N2 = DIME L1 ; FINP N2 ; X = F (PROG 1. 2.) ;"
    result = run_text(script)
    assert result.exit_code == 0, result.message
    assert result.session.root.find("X") == 2

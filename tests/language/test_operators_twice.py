"""A name has one operator."""

import pytest

from ssilang.language.registry import OPERATORS, shared
from ssilang.operators.loader import prepare_operators


def test_a_second_operator_of_one_name_is_no_operator():
    prepare_operators()
    known = OPERATORS["ZOND"]
    with pytest.raises(ValueError, match="ZOND is declared twice"):
        shared("ZOND", "curves", "another")
    assert OPERATORS["ZOND"] is known

"""Cases that stand in one test all run, each alone, and all that fail are told."""

import os

import pytest
from together import together


def test_every_case_runs_in_a_folder_of_its_own_and_all_that_fail_are_told(tmp_path, monkeypatch):
    ran = []

    @together("number, word", [(3, "a"), (0, "b"), (1, "c"), (0, "d")], by=lambda case: case[0] > 2)
    @together("other", "xy")
    def check(number, word, other, tmp_path, monkeypatch):
        assert not list(tmp_path.iterdir())
        assert "OF_A_CASE" not in os.environ
        monkeypatch.setenv("OF_A_CASE", "1")
        (tmp_path / word).touch()
        ran.append(word + other)
        if word == "c":
            pytest.fail("no")
        assert 6 // number == 2

    (mark,) = check.pytestmark
    assert list(mark.args[1]) == ["True", "False"]
    check("True", tmp_path=tmp_path, monkeypatch=monkeypatch)
    (tmp_path / "rest").mkdir()
    with pytest.raises(AssertionError, match="3 of 3 cases") as told:
        check("False", tmp_path=tmp_path / "rest", monkeypatch=monkeypatch)
    assert ran == ["ax", "ay", "bx", "by", "cx", "cy", "dx", "dy"]
    said = str(told.value)
    assert said.count("ZeroDivisionError") == 4
    assert said.count("Failed: no") == 2


def test_no_cases_are_an_error():
    with pytest.raises(AssertionError, match="no cases"):
        together("number", [])

"""`ssilang help` of words, in both languages."""

import pytest


@pytest.mark.parametrize(
    "arguments",
    [
        ("--lang", "fr", "help", "KN"),
        ("--lang=fr", "help", "KN"),
        ("help", "KN", "--lang", "fr"),
    ],
)
def test_the_language_may_stand_before_the_command(ssilang, arguments):
    done = ssilang(*arguments)
    assert done.code == 0
    assert "Raideur normale du joint" in done.out


def test_what_is_searched_is_several_words(ssilang):
    done = ssilang("help", "friction", "angle")
    assert done.code == 0
    assert "PHI" in done.out


def test_an_unknown_word_gets_a_near_name(ssilang):
    done = ssilang("help", "TIOM")
    assert done.code == 1
    assert "did you mean TIMO?" in done.out

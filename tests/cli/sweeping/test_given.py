"""Values of the command line: how they are read, and how runs are named and combined."""

import pytest
from refusing import refusal
from together import together

from ssilang.cli.sweeping.given import (
    Case,
    GivenError,
    cases_of,
    folder_names,
    is_motion,
    parse_setting,
    parse_value,
    parse_values,
)
from ssilang.report.sweep_table import MOTION


@together(
    "text, values",
    [
        ("3", [3]), (" -3 ", [-3]), ("1.5d3", [1500.0]), ("+.5E-1", [0.05]), ("2.", [2.0]),
        ("vrai,FAUX", [True, False]), ("dense, Modal", ["dense", "Modal"]),
        ("b,3,a", ["b", 3, "a"]), ("1:7:2", [1, 3, 5, 7]), ("7:1:-3", [7, 4, 1]),
        ("0:0.3:0.1", [0.0, 0.1, 0.2, 0.3]), ("0.5:0.7:0.1", [0.5, 0.6, 0.7]),
        ("2:2:5", [2]), ("1.:3:1", [1.0, 2.0, 3.0]), ("a:b", ["a:b"]), ("a:b:c", ["a:b:c"]),
    ],
)  # fmt: skip
def test_values(text, values):
    found = parse_values(text)
    assert found == values
    assert [type(v) for v in found] == [type(v) for v in values]


@together(
    "text, code",
    [
        ("1:7:0", "cli.range-no-values-first"), ("1:7:-2", "cli.range-no-values-first"),
        ("7:1:2", "cli.range-no-values-first"), ("1:6:2", "cli.range-misses-end"),
        ("1::2", "cli.value-empty"), ("1,,2", "cli.value-empty"), ("1,2,", "cli.value-empty"),
        ("0:1:1.E-6", "cli.range-values"), ("1.E999", "cli.value-too-large"),
        ("9" * 6000, "cli.value-too-large"),
    ],
)  # fmt: skip
def test_values_that_are_none(text, code):
    with refusal(GivenError, code):
        parse_values(text)


def test_the_value_before_an_end_that_is_missed_is_told():
    with pytest.raises(GivenError) as caught:
        parse_values("1:6:2")
    assert (caught.value.data["end"], caught.value.data["last"]) == (5, 6)
    assert parse_value("1.d-2") == 0.01


@together("text", ["Z", "=3", "Z=", "1Z=3", "Z A=3", "Z= "])
def test_settings_that_are_none(text):
    with refusal(GivenError, "cli.not-name-value-ag"):
        parse_setting(text)


def test_all_combinations_the_last_name_fastest(tmp_path):
    for name, text in (("z.txt", "1 2\n"), ("a.at2", "x\n1.5D-3, -2\n"), ("note.md", "no number"),
                       (".hidden", "1\n"), ("raw.bin", "1\n\0")):  # fmt: skip
        (tmp_path / name).write_text(text)
    (tmp_path / "sub").mkdir()
    left = []
    cases = cases_of(["zed=2,1", "@amp=x=y"], tmp_path, left)
    motions = [str(tmp_path / n) for n in ("a.at2", "z.txt")]
    assert [(c.number, c.values) for c in cases] == [
        (i, {"ZED": z, "@AMP": "x=y", MOTION: m})
        for i, (z, m) in enumerate([(z, m) for z in (2, 1) for m in motions], 1)
    ]
    assert [p.name for p in left] == ["note.md", "raw.bin"]
    assert not is_motion(tmp_path / "gone")


@together("settings, code", [
        (["A=1", "a=2"], "cli.set-twice"), ([f"{MOTION}=x"], "cli.set-twice"),
        (["A=0.5,x,0.50"], "cli.value-twice"), ([], None), (["A=1,1.,VRAI"], None),
    ])  # fmt: skip
def test_what_is_given_twice(tmp_path, settings, code):
    (tmp_path / "m").write_text("1\n")
    if code is None:
        assert len(cases_of(settings, tmp_path)) == (3 if settings else 1)
        return
    with refusal(GivenError, code):
        cases_of(settings, tmp_path)


@together("folder, code", [("gone", "cli.not-folder-ground-motions"),
                                              ("bare", "cli.no-file")])  # fmt: skip
def test_folders_without_motions(tmp_path, folder, code):
    (tmp_path / "bare").mkdir()
    with refusal(GivenError, code):
        cases_of([], tmp_path / folder)


def test_folders_say_what_was_given():
    def names(*values):
        return folder_names([Case(i, v) for i, v in enumerate(values, 1)])

    assert names({"ZED": True, "AMP": 0.5}, {"ZED": False, "AMP": 0.5, MOTION: "/x/m1.AT2"}) == [
        "AMP=0.5_ZED=VRAI", "AMP=0.5_ZED=FAUX_m1"
    ]  # fmt: skip
    assert names({MOTION: "/x/m.AT2"}, {MOTION: "/x/m.VT2"}) == ["m.AT2", "m.VT2"]
    odd, other, long = names({"A": "x/y"}, {"A": "x y"}, {"A": "w" * 200})
    assert odd.startswith("A=x-y_")
    assert other.startswith("A=x-y_")
    assert odd != other
    assert long[:-7] == ("A=" + "w" * 200)[:120]
    assert len(long) == 127

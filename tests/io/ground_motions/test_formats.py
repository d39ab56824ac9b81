"""Ground motions of every format as databases write them; what suites have not in common."""

import numpy as np
import pytest
from together import together

from ssilang.io.errors import InputError
from ssilang.io.ground_motions.formats import read_cosmos, read_esm, read_peer, read_titled
from ssilang.io.ground_motions.record import GroundMotion, plain_unit, quantity_of
from ssilang.io.ground_motions.suite import motion_in, peaks_apart, units_named

REALS = [0.0] * 33 + [0.02] + [9.0] * 66


def _columns(values, width, count, digits):
    cells = [f"{v:{width}.{digits}E}" for v in values]
    return "\n".join("".join(cells[i : i + count]) for i in range(0, len(cells), count))


COSMOS = (
    "Uncorrected accelerogram Format v01.20 with 13 text lines\nNEAR QUAKE\n"
    f"100 Real-header values follow on  17 lines, Format= (6E14.6)\n{_columns(REALS, 14, 6, 6)}\n"
    "7 veloc pts, approx  0 secs, units=cm/sec (05), Format=(3E12.4)\n"
    f"{_columns([1, -2, 3, -4, 5, -6, 7], 12, 3, 4)}\nEnd-of-data\n"
)
FILES = {
    "m.AT2": (
        "PEER\n QUAKE, STATION 3 \nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 5, DT= .0200 SEC\n"
        "  .12E-02-.34E-02  5.D0\n -1. 2\n 9.",
        [0.0012, -0.0034, 5, -1, 2], 0.02, "QUAKE, STATION 3", "VITE", 0.01, 1,
    ),
    "m.DT2": ("a\nb\nc\n3 0.5 NPTS, DT\n1. 2. -3.", [1, 2, -3], 0.5, "b", "DEPL", 1.0, 0),
    "m.ASC": (
        "EVENT_NAME: Q\nSTATION_CODE: S\nSAMPLING_INTERVAL_S: 0.005\nNDATA: 3\nUNITS: mm/s^2\n"
        "STREAM: HNZ\nDATA_TYPE: DISPLACEMENT\n1.5\n\n-2.5e1\n0\n",
        [1.5, -25, 0], 0.005, "Q S HNZ", "DEPL", 1e-3, 0,
    ),
    "m.V1": (COSMOS, [1, -2, 3, -4, 5, -6, 7], 0.02, "NEAR QUAKE", "VITE", 0.01, 0),
}  # fmt: skip


@together("name", FILES)
def test_the_first_motion_of_a_file(tmp_path, name):
    text, values, dt, event, quantity, in_si, left_out = FILES[name]
    (tmp_path / name).write_text(text)
    found = motion_in(tmp_path / name)
    assert found.values == pytest.approx(values)
    assert found.times == pytest.approx([dt * i for i in range(len(values))])
    assert (found.event, found.quantity, found.left_out) == (event, quantity, left_out)
    assert (found.in_si, found.has_unit) == (in_si, in_si != 1.0)


def test_two_records_of_one_file(tmp_path):
    from ssilang.io.ground_motions.formats import read_cosmos

    second = COSMOS.replace("NEAR", "FAR").replace("7 veloc", "5 displ")
    second = second.replace("2.000000E-02", "5.000000E-02")
    (tmp_path / "m.v1").write_text(COSMOS + second)
    first, other = read_cosmos(tmp_path / "m.v1")
    assert (first.event, other.event) == ("NEAR QUAKE", "FAR QUAKE")
    assert (first.quantity, other.quantity, first.dt, other.dt) == ("VITE", "DEPL", 0.02, 0.05)
    assert (len(first.values), other.values.tolist()) == (7, [1, -2, 3, -4, 5])


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("t [ms]; vel_cm/s; acc (g)\n0;1;2\n5;3;-4\n9;5;6",
         [("VITE", 0.01), ("ACCE", 9.81)]),
        ("# time (s)\tEW in mm\tNS (m/s2)\n0 \t1\t2\t\n0.005\t3\t-4\n0.009\t5\t6\n",
         [("DEPL", 1e-3), ("ACCE", 1.0)]),
        ("0. 1. 2\n5D-3 3. -4\n9D-3 5. 6", [("ACCE", 1.0), ("ACCE", 1.0)]),
        ('"t";"u (cm)";vel;;\n0;1;2;\n.005;3;-4; ;\n.009;5;6', [("DEPL", 0.01), ("VITE", 1.0)]),
    ],
)  # fmt: skip
def test_tables_by_their_titles(tmp_path, text, columns):
    (tmp_path / "m.txt").write_text(text)
    found = read_titled(tmp_path / "m.txt")
    assert [(m.quantity, m.in_si) for m in found] == columns
    assert [m.values.tolist() for m in found] == [[1, 3, 5], [2, -4, 6]]
    for motion in found:
        assert '"' not in motion.event
        assert motion.times == pytest.approx([0, 0.005, 0.009])


@together(
    "text, code, line",
    [
        ("t;a\n0;1\n1;2\n1;3\n2;4", "io.titled-times-fall", 4),
        ("t;a\n\n0;1\n1;2;7\n2;4", "io.titled-other-columns", 4),
        ("t;a\n0;1\n1;x\n2;4", "io.line-no-number", 3),
        ("t;a\n0;1\n1;1_0\n2;4", "io.line-no-number", 3),
        ("t;a\n0;1\n1;\u0663\n2;4", "io.line-no-number", 3),
        ("t;a\n0;1\n1E-320;2\n2;4", "io.record-step", None),
        ("t;a\n-1E308;1\n1E308;2", "io.record-step", None),
        ("t;a\n0;1", "io.titled-no-table", None),
        ("t (h);a\n0;1\n1;2", "io.titled-time-unit", None),
    ],
)
def test_a_table_that_is_none(tmp_path, text, code, line):
    (tmp_path / "m.txt").write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_titled(tmp_path / "m.txt")
    assert (caught.value.code, caught.value.data.get("line")) == (code, line)


def _motions(**peaks):
    """Motions whose peak is a low."""
    return {n: GroundMotion(np.array([0.1 * v, -v]), 0.1, "", "ACCE", unit)
            for n, (v, unit) in peaks.items()}  # fmt: skip


@together(
    "peaks, in_si, apart",
    [
        ({"z": 300.0, "b": 1.0, "k": 2.0, "a": 4.0}, False, ["z"]),
        ({"z": 3.0, "b": 100.0, "k": 200.0, "a": 400.0}, False, ["z"]),
        ({"z": 3.0, "b": 100.0, "k": 200.0, "a": 4.0}, False, ["b", "k"]),  # as many: the larger
        ({"z": 3.0, "b": 0.0, "k": 2.9, "a": 14.0}, False, []),  # 4.7 times is no other unit
        ({"z": 3.0, "b": 1.0, "k": 15.0}, False, ["k"]),  # 5 times is
        ({"z": 300.0, "b": 0.0, "k": 1.0}, False, []),  # two say nothing
        ({"z": 300.0, "b": 1.0, "k": 2.0, "a": 4.0}, True, []),  # z is in cm/s2: 3
    ],
)
def test_motions_that_stand_apart(peaks, in_si, apart):
    motions = _motions(**{n: (v, "cm/s2" if n == "z" else "") for n, v in peaks.items()})
    found = peaks_apart(motions, in_si)
    assert sorted(found) == apart
    assert all(found[n] == pytest.approx(peaks[n]) for n in apart)


def test_units_are_told_where_they_differ():
    assert units_named(_motions(z=(1.0, "cm/s/s"), b=(2.0, "G"), k=(1.0, "?"))) == {
        "z": "CM/S2", "b": "G"
    }  # fmt: skip
    assert units_named(_motions(z=(1.0, "cm/sec^2"), b=(2.0, "CM/S**2"), k=(1.0, ""))) == {}
    assert [plain_unit(u) for u in ("m/sec/sec", "M/S\u00b2", "mm/s")] == ["M/S2", "M/S2", "MM/S"]
    texts = ("Displ. then ACCEL", "subacc", "velocity", "dep.", "none")
    assert [quantity_of(t) for t in texts] == ["DEPL", "", "VITE", "DEPL", ""]


HEAD_OF = {  # the step of each format stands for STEP
    "m.AT2": (read_peer, "P\nQ\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= STEP SEC\n1. 2. 3.\n"),
    "m.ASC": (read_esm, "SAMPLING_INTERVAL_S: STEP\nUNITS: cm/s^2\n1.5\n2.5\n3.5\n"),
    "m.V1": (read_cosmos, COSMOS.replace("  2.000000E-02", f"{'STEP':>14}").replace(
        "approx  0 secs, ", "")),
}  # fmt: skip


@pytest.mark.parametrize("name", HEAD_OF)
@together("step", ["1E-320", "1E-12", "1001.", "1E308", "0.", "1E400", "-.01"])
def test_a_step_that_no_record_has(tmp_path, name, step):
    read, text = HEAD_OF[name]
    path = tmp_path / name
    path.write_text(text.replace(" " * (10 if name == "m.V1" else 0) + "STEP", step.rjust(14)))
    with pytest.raises(InputError):
        read(path)
    path.write_text(text.replace(" " * (10 if name == "m.V1" else 0) + "STEP", "1000.".rjust(14)))
    found = read(path)
    assert (found[0] if isinstance(found, list) else found).dt == 1000.0


def test_an_underscore_is_no_part_of_a_number(tmp_path):
    path = tmp_path / "m.ASC"
    path.write_text(HEAD_OF["m.ASC"][1].replace("STEP", "0.01").replace("3.5", "3_5"))
    with pytest.raises(InputError) as refused:
        read_esm(path)
    assert (refused.value.code, refused.value.data["rest"]) == ("io.record-line-no-number", "3_5")

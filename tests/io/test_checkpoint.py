"""Checkpoints read back, by themselves and by numpy and zipfile alone."""

import json
import os
import zipfile
from pathlib import Path

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.io.checkpoint import Checkpoints, Deck, changed_names, digest_of_file
from ssilang.io.errors import InputError

DECK = Deck("1.2", "abc", {"ZG": "3", "AG": "0.5"})
TABLE = np.arange(12.0).reshape(3, 4)[:, ::2]  # neither contiguous nor square
STATE = {
    "z": TABLE, "a": {"deep": [TABLE.T, np.arange(3), None, "word", (1, 2.5)]}, "empty": [],
    "truth": np.bool_(True), "whole": np.int64(7), "mask": np.array([True, False]),
}  # fmt: skip
ROWS = [
    {"t": np.array([0.0, 0.5]), "force": np.array([[1.0, -2.0, 3.0], [4.0, 5.0, -6.0]])},
    {"t": np.array([1.0]), "force": np.array([[7.0, 8.0, 9.0]])},
    {"force": np.empty((0, 3)), "t": np.empty(0)},
]


def _kept(folder: Path) -> Checkpoints:
    """Two calculations kept in turn, the second one first."""
    made = Checkpoints(folder, DECK)
    assert [made.begin(), made.begin()] == [1, 2]
    assert not made.kept
    made.write(2, {"name": "other"}, {"x": -TABLE}, ROWS[1])
    for i, rows in enumerate(ROWS):
        made.write(1, {"name": "DYNA", "step": i}, {**STATE, "turn": i}, rows)
    made.write(2, {"name": "other"}, {"x": -2 * TABLE}, ROWS[0])
    assert made.kept
    return made


def _same(a: dict[str, np.ndarray], b: dict[str, np.ndarray]) -> bool:
    """Whether the arrays are the same, in the same order."""
    return list(a) == list(b) and all(
        a[n].dtype == b[n].dtype and np.array_equal(a[n], b[n]) for n in a
    )


def test_what_is_kept_comes_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    forced: list[tuple[int, int]] = []  # to the disk, before a name says that it is there
    monkeypatch.setattr(
        os, "fsync", lambda file: forced.append((os.fstat(file).st_ino, os.fstat(file).st_size))
    )
    _kept(tmp_path)
    kept = {(p.stat().st_ino, p.stat().st_size) for p in tmp_path.iterdir()}
    assert kept <= set(forced)
    going_on = Checkpoints(tmp_path, DECK, resume=True)
    assert going_on.found
    assert not going_on.kept
    going_on.check()
    first, second = going_on.read(1), going_on.read(2)
    assert first is not None
    assert second is not None
    assert going_on.kept
    assert first.call == {"name": "DYNA", "step": 2}
    assert (first.state["turn"], first.state["whole"], first.state["truth"]) == (2, 7, True)
    assert (first.state["empty"], first.state["a"]["deep"][2:]) == ([], [None, "word", [1, 2.5]])
    assert np.array_equal(first.state["z"], TABLE)
    assert np.array_equal(first.state["a"]["deep"][0], TABLE.T)
    assert np.array_equal(first.state["a"]["deep"][1], [0, 1, 2])
    assert first.state["mask"].tolist() == [True, False]
    assert len(first.rows) == 3
    assert all(_same(a, b) for a, b in zip(first.rows, ROWS, strict=True))
    assert second.call == {"name": "other"}
    assert np.array_equal(second.state["x"], -2 * TABLE)
    assert [list(r["t"]) for r in second.rows] == [[1.0], [0.0, 0.5]]
    assert going_on.read(3) is None
    assert Checkpoints(tmp_path, DECK).read(1) is None  # not asked to go on


def test_files_are_plain_zip_and_npy(tmp_path: Path) -> None:
    _kept(tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "1.rows", "1.state", "2.rows", "2.state"
    ]  # fmt: skip
    with zipfile.ZipFile(tmp_path / "1.state") as file:
        head = json.loads(file.read("head.json"))
        arrays = [np.load(file.open(f"{i}.npy")) for i in range(4)]
    assert (head["ssilang"], head["deck"], head["given"]) == ("1.2", "abc", dict(DECK.given))
    assert (head["batches"], head["length"]) == (3, (tmp_path / "1.rows").stat().st_size)
    assert np.array_equal(arrays[0], TABLE)
    with (tmp_path / "1.rows").open("rb") as stream:
        names = json.loads(np.load(stream).tobytes())
        assert names == ["t", "force"]
        assert np.array_equal(np.load(stream), ROWS[0]["t"])


def test_going_on_writes_behind_what_counts(tmp_path: Path) -> None:
    """What a killed run wrote behind the last checkpoint is written over; others stay."""
    _kept(tmp_path)
    with (tmp_path / "1.rows").open("ab") as stream:
        stream.write(b"half a row" * 500)
    going_on = Checkpoints(tmp_path, DECK, resume=True)
    assert going_on.read(1) is not None
    going_on.write(1, {"name": "DYNA"}, {}, {"t": np.array([9.0])})
    again = Checkpoints(tmp_path, DECK, resume=True)
    first, second = again.read(1), again.read(2)
    assert first is not None
    assert second is not None
    assert [r["t"].tolist() for r in first.rows] == [[0.0, 0.5], [1.0], [], [9.0]]
    assert len(second.rows) == 2


def test_a_new_run_leaves_nothing_of_the_old_one(tmp_path: Path) -> None:
    folder = tmp_path / "kept"
    _kept(folder)
    anew = Checkpoints(folder, DECK)
    anew.forget()  # it kept nothing: what stands there is not its own
    assert len(list(folder.iterdir())) == 4
    anew.write(1, {}, {"x": 1}, {})
    assert sorted(p.name for p in folder.iterdir()) == ["1.rows", "1.state"]
    anew.write(2, {}, {"x": 1}, {})
    assert len(list(folder.iterdir())) == 4
    (folder / "note.txt").write_text("mine")
    anew.forget()
    assert [p.name for p in folder.iterdir()] == ["note.txt"]
    assert not anew.found


@together(
    "deck, code, told",
    [
        (Deck("1.3", "abc", DECK.given), "io.checkpoint-of-version", {"version": "1.2"}),
        (Deck("1.2", "other", DECK.given), "io.checkpoint-of-deck", {}),
        (
            Deck("1.2", "abc", {"AG": "0.7", "B": "1"}),
            "io.checkpoint-of-parameters",
            {"before": ["AG=0.5", "B", "ZG=3"], "now": ["AG=0.7", "B=1", "ZG"]},
        ),
    ],
)
def test_checkpoints_of_another_run(tmp_path: Path, deck: Deck, code: str, told: dict) -> None:
    _kept(tmp_path)
    going_on = Checkpoints(tmp_path, deck, resume=True)
    for act in (going_on.check, lambda: going_on.read(2)):
        with refusal(InputError, code) as caught:
            act()
        assert {n: caught.value.data[n] for n in told} == told


@together("damaged", ["1.state", "1.rows"])
@together("harm", [lambda held: held[:70], lambda held: held[:-3] + b"\1\2\3"])
def test_a_damaged_file_is_told(tmp_path: Path, damaged: str, harm) -> None:
    _kept(tmp_path)
    path = tmp_path / damaged
    path.write_bytes(harm(path.read_bytes()))
    with refusal(InputError, "io.checkpoint-damaged") as caught:
        Checkpoints(tmp_path, DECK, resume=True).read(1)
    assert caught.value.data["path"] == path


def test_what_tells_files_and_parameters_apart(tmp_path: Path) -> None:
    for name, text in (("a", "x"), ("b", "x"), ("c", "y")):
        (tmp_path / name).write_text(text)
    a, b, c = (digest_of_file(tmp_path / n) for n in "abc")
    assert a == b != c
    assert digest_of_file(tmp_path / "gone") == ""
    assert changed_names({"z": "1", "a": "2", "m": "3"}, {"m": "3", "a": "4", "k": "5"}) == [
        "a", "k", "z"
    ]  # fmt: skip

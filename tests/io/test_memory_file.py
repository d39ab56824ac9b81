"""Files of a ground's memory that a stranger made: no pickles, no more than they hold."""

import io
import os
import pickle
import threading
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from together import together

from ssilang.io import memory_file
from ssilang.io.errors import InputError
from ssilang.io.memory_file import MemoryFile
from ssilang.kernel.solvers.low_rank import LowRank
from ssilang.kernel.stepping.rests.memory.kernels import Kernels, Stage

F = np.float32
FIRST, P, SUMS = np.ones((6, 6), F), np.eye(6, 2, dtype=F), np.ones((16, 2, 2), F)
ORDER, CLUSTERS = np.arange(6), np.arange(0, 7, 2)
RANKS = np.array([[0, -1], [1, 1], [0, -1], [0, 0], [1, 1], [0, -1]])
VALUES = np.ones(5 * 4, F)
OVER = np.array([0, 7399589116837456614, -5551089986157539896, 6])
"""Rising by 64 bits, for which the sizes of blocks are twenty numbers by 64 bits."""
UNREAD = [f"values{i}" for i in range(7, 15)]
NEAR = (LowRank(ORDER, CLUSTERS, RANKS, VALUES),) * 15
SOUND = Kernels(
    np.full(3, 6.0), 5e-3, 1e-2, FIRST, NEAR, (Stage(16, P, SUMS),), np.ones((3, 6, 2), F),
    np.ones((5, 2)), np.ones(20), 0,
)  # fmt: skip


def npy(values: Any) -> bytes:
    stream = io.BytesIO()
    np.save(stream, values, allow_pickle=True)
    return stream.getvalue()


def declaring(shape: tuple[int, ...]) -> bytes:
    """The head of an array, with nothing behind it."""
    stream = io.BytesIO()
    head = {"descr": "<f8", "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(stream, head)
    return stream.getvalue()


def ranks(at: tuple[int, int] = (0, 0), value: int = 0, count: int = 15) -> bytes:
    """Those of as many sums, with another value."""
    found = RANKS.copy()
    found[at] = value
    return npy(np.array([found] * count))


class Program:
    """Makes a folder when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = str(path)

    def __reduce__(self) -> tuple[Any, ...]:
        return os.mkdir, (self.path,)


def made(path: Path, packing: int = zipfile.ZIP_STORED, **arrays: bytes | None) -> MemoryFile:
    """A sound memory with other arrays in place of its own."""
    MemoryFile(path).write(SOUND)
    with zipfile.ZipFile(path) as file:
        whole = {n: file.read(n) for n in file.namelist()}
    with zipfile.ZipFile(path, "w", packing) as file:
        for name, raw in (whole | {f"{n}.npy": raw for n, raw in arrays.items()}).items():
            if raw is not None:
                file.writestr(name, raw)
    return MemoryFile(path)


@together(
    "arrays, told",
    [
        ({"first": npy(FIRST.astype(complex))}, "complex128"),
        ({"first": npy(np.full((6, 6), "1"))}, "<U1"),
        ({"first": npy(FIRST[:, :5])}, ""),
        ({"ranks": ranks(count=7)}, "values7"),
        ({"ranks": ranks(count=7), **dict.fromkeys(UNREAD)}, "8 kernels"),
        ({"ranks": ranks((0, 1), 0)}, "blocks"),
        ({"ranks": ranks((1, 1), 0)}, "blocks"),
        ({"ranks": ranks((1, 1), 2**62 + 1)}, "blocks"),
        ({"ranks": ranks((1, 0), 2)}, "blocks"),
        ({"ranks": ranks((1, 0), -1)}, "blocks"),
        ({"ranks": ranks((0, 1), -2)}, "blocks"),
        ({"order": npy(ORDER[::2])}, ""),
        ({"order": npy(np.zeros(6, int))}, "blocks"),
        ({"order": npy(ORDER.astype(np.int32))}, "int32"),
        ({"clusters": npy(np.array([0, 2, 4, 5]))}, "blocks"),
        ({"clusters": npy(np.array([1, 2, 4, 6]))}, "blocks"),
        ({"clusters": npy(np.array([0, 4, 2, 6]))}, "blocks"),
        ({"clusters": npy(np.array([0, 6]))}, ""),
        ({"clusters": npy(OVER)}, "blocks"),
        ({"clusters": npy(CLUSTERS[:, None])}, ""),
        ({"values3": npy(VALUES[:-1])}, "blocks"),
        ({"values3": npy(VALUES.astype(float))}, "float64"),
        ({"firsts": npy(np.array([15]))}, "16 kernels"),
        ({"loads": npy(np.full((3, 6, 2), np.nan, F))}, ""),
        ({"loads": npy(np.ones((3, 7, 2), F))}, ""),
        ({"loads": npy(np.ones((3, 6, 1), F))}, ""),
        ({"patterns": npy(np.ones((4, 2)))}, ""),
        ({"patterns": npy(np.ones((5, 3)))}, ""),
        ({"patterns": npy(np.ones((5, 2), F))}, ""),
        ({"mark": npy(np.ones(3))}, ""),
        ({"mark": npy(np.full((3, 1), 6.0))}, ""),
        ({"P0": npy(np.eye(6, 3, dtype=F))}, ""),
        ({"sums0": npy(SUMS[:, :1])}, ""),
        ({"sums0": npy(SUMS[:0])}, "16 kernels"),
        ({"dt": npy(np.array(np.nan))}, "nan s"),
        ({"tolerance": npy(np.array(np.nan))}, "to nan"),
        ({"tolerance": npy(np.array(-1.0))}, "to -1.0"),
        ({"firsts": npy(np.zeros(0, int))}, ""),
        ({"firsts": npy(np.array([16, 32]))}, ""),
        ({"estimate": npy(np.zeros(0, "M8[s]"))}, ""),
        ({"other": npy(FIRST)}, ": other"),
        ({"first": declaring((10**11, 2))}, ""),
        ({"first": declaring((10**7, 2))}, ""),
        ({"mark": npy(np.array([Program(Path("ran"))], object))}, "allow_pickle"),
        ({"first": pickle.dumps(Program(Path("ran")))}, ""),
    ],
)
def test_arrays_that_no_run_wrote_are_damage(arrays, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = made(tmp_path / "sound.npz").read()
    assert found is not None
    assert np.array_equal(found.stages[0].sums, SOUND.stages[0].sums)
    with pytest.raises(InputError, match=f"other.npz is damaged.*{told}"):
        made(tmp_path / "other.npz", **arrays).read()
    assert not (tmp_path / "ran").exists()


def test_what_is_packed_or_locked_is_damage(tmp_path):
    with pytest.raises(InputError, match=r"is damaged, .*: packed"):
        made(tmp_path / "a.npz", zipfile.ZIP_DEFLATED, first=npy(np.zeros((10**6, 2)))).read()
    locked = made(tmp_path / "b.npz")
    raw = bytearray(locked.path.read_bytes())
    raw[raw.find(b"PK\x01\x02") + 8] |= 1  # the first array, by a password
    raw[6] |= 1
    locked.path.write_bytes(raw)
    with pytest.raises(InputError, match=r"is damaged, .*: .*encrypted"):
        locked.read()


def test_the_memory_of_another_version_is_told(tmp_path):
    file = made(tmp_path / "a.npz")
    with zipfile.ZipFile(file.path) as whole:
        arrays = {n: whole.read(n) for n in whole.namelist() if n != "patterns.npy"}
    with zipfile.ZipFile(file.path, "w") as older:
        for name, raw in arrays.items():
            older.writestr(name, raw)
    with pytest.raises(InputError, match="another version of ssilang: patterns") as told:
        file.read()
    assert "makes it anew" in str(told.value.hint)


ROWS, NAME = np.arange(24.0, dtype=F).reshape(4, 3, 2), 16 * "a"


def test_rows_that_took_long_are_left_until_there_is_a_memory(tmp_path, monkeypatch):
    file, beside = MemoryFile(tmp_path / "a[1].npz"), MemoryFile(tmp_path / "b.npz")
    assert len(list(file.answered(NAME, (3, 2), iter(ROWS)))) == 4
    assert not list(tmp_path.iterdir())  # soon made again
    monkeypatch.setattr(memory_file, "LONG", 0.0)
    broken_off = file.answered(NAME, (3, 2), iter(ROWS))
    next(broken_off)
    broken_off.close()
    assert not list(tmp_path.iterdir())
    for _ in range(2):
        assert np.array_equal(list(file.answered(NAME, (3, 2), iter(ROWS))), ROWS)
        others = iter(ROWS[:1])
        assert np.array_equal(list(file.answered(NAME, (3, 2), others)), ROWS)
        assert len(list(others)) == 1  # not asked for
    assert len(list(beside.answered(NAME, (3, 2), iter(ROWS[:1])))) == 1
    file.write(SOUND)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a[1].npz", f"b.npz.{NAME}"]


@together(
    "raw",
    [
        npy(ROWS)[:-1], npy(ROWS.astype(float)), npy(ROWS[:, :2]), npy(ROWS + np.nan), b"",
        npy(np.array([Program(Path("ran"))], object)), declaring((10**11, 3, 2)),
    ],
)  # fmt: skip
def test_rows_that_no_run_left_are_made_anew(raw, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(memory_file, "LONG", 0.0)
    file, left = MemoryFile(tmp_path / "a.npz"), tmp_path / f"a.npz.{NAME}"
    left.write_bytes(raw)
    assert np.array_equal(list(file.answered(NAME, (3, 2), iter(ROWS[:2]))), ROWS[:2])
    assert left.read_bytes() == npy(ROWS[:2])
    assert not (tmp_path / "ran").exists()


@pytest.mark.skipif(os.name != "posix", reason="links of one system")
@pytest.mark.parametrize("name", ["basis.npz", "below/basis.npz"])
def test_a_file_in_a_folder_that_became_a_link_is_held_all_the_same(tmp_path, name):
    (tmp_path / "moved").mkdir()
    (tmp_path / "folder").symlink_to(tmp_path / "moved")
    done = threading.Event()

    def hold() -> None:
        with MemoryFile(tmp_path / "folder" / name).held():
            done.set()

    threading.Thread(target=hold, daemon=True).start()
    assert done.wait(20.0)

"""The scripts of the page on many runs: records are read, decks run, and a suite's fragility."""

import csv
import io
import re
from pathlib import Path

import numpy as np
import pytest

from ssilang.cli.run import RunOptions, run_file
from ssilang.cli.sweeping.sweep import SweepOptions, sweep

_PAGE = (Path(__file__).resolve().parents[2] / "docs" / "sweep.md").read_text(encoding="utf-8")
_READING, _ROCKING, _RECORDS, _OSCILLATOR = re.findall(r"```ssi\n(.*?)```", _PAGE, re.DOTALL)
_STEP = 0.01


@pytest.fixture
def pulse() -> np.ndarray:
    """Acceleration in g at steps of 0.01 s: one sine of 0.5 g and 1 s, then rest."""
    t = _STEP * np.arange(400)
    return np.where(t < 1.0, 0.5 * np.sin(2 * np.pi * t), 0.0)


@pytest.fixture
def folder(tmp_path: Path, pulse: np.ndarray) -> Path:
    head = [
        "a test",
        "one sine",
        "ACCELERATION IN UNITS OF G",
        f"NPTS= {len(pulse)}, DT= {_STEP} SEC",
    ]
    rows = ["".join(f"{v:16.8E}" for v in row) for row in pulse.reshape(-1, 5)]
    (tmp_path / "motions").mkdir()
    for name in ("motion.AT2", "motions/m1.AT2"):
        (tmp_path / name).write_text("\n".join([*head, *rows]) + "\n")
    table = [f"{_STEP * i:.2f},{9.81 * v:.9g}" for i, v in enumerate(pulse)]
    (tmp_path / "motion.csv").write_text("\n".join(["time (s),acceleration (m/s2)", *table]) + "\n")
    return tmp_path


def test_both_files_give_the_same_record(folder: Path, pulse: np.ndarray) -> None:
    (folder / "read.ssi").write_text(_READING)
    result = run_file(folder / "read.ssi", RunOptions(output_directory=folder / "out"))
    assert result.exit_code == 0, result.message
    find = result.session.root.find
    for name in ("ACCE", "ACCE2"):
        assert find(name).parts[0].ordinates == pytest.approx(9.81 * pulse, abs=1e-7)
    assert find("PGA") == pytest.approx(9.81 * np.abs(pulse).max(), rel=1e-7)
    # above the pulse's frequencies an oscillator follows the ground
    spectrum = find("SPEC").parts[0].ordinates
    assert spectrum[-1] == pytest.approx(find("PGA"), rel=0.05)


def test_the_deck_rocks_and_lifts_its_edges(folder: Path) -> None:
    (folder / "rocking.ssi").write_text(_ROCKING)
    result = run_file(folder / "rocking.ssi", RunOptions(output_directory=folder / "out"))
    assert result.exit_code == 0, result.message
    find = result.session.root.find
    settled = 9.81 * (3e4 + 3 * 2e3) / 2 / 5e7
    up = find("UY").values
    assert up[0] == pytest.approx(-settled, rel=0.2)
    assert up.max() > settled


@pytest.mark.usefixtures("one_after_the_other")
def test_the_suite_has_the_fragility_that_its_records_were_made_for(tmp_path: Path) -> None:
    (tmp_path / "records.ssi").write_text(_RECORDS)
    (tmp_path / "oscillator.ssi").write_text(_OSCILLATOR)
    motions = tmp_path / "results" / "records"
    made = run_file(tmp_path / "records.ssi", RunOptions(output_directory=motions))
    assert made.exit_code == 0, made.message
    options = SweepOptions(
        tmp_path / "oscillator.ssi", ["AG=1,2,4,6,10"], motions, tmp_path / "out", jobs=1,
        fragility=["drift>0.001"],
    )  # fmt: skip
    out, err = io.StringIO(), io.StringIO()
    assert sweep(options, out, err) == 0, err.getvalue()
    with (tmp_path / "out" / "sweep.csv").open(newline="") as file:
        runs = list(csv.DictReader(file, delimiter=";"))
    lengths = 0.04 * np.exp(0.3 * _normals())
    number = [int(re.search(r"sine_(\d+)", r["MOTION"])[1]) - 1 for r in runs]  # type: ignore[index]
    exact = np.array([float(r["AG"]) for r in runs]) * _drift(lengths[number], np.pi)
    assert np.array([float(r["drift"]) for r in runs]) == pytest.approx(exact, rel=2e-3)
    with (tmp_path / "out" / "fragility.csv").open(newline="") as file:
        fits = {(r["intensity"], r["method"]): r for r in csv.DictReader(file, delimiter=";")}
    # a drift of 1 mm: half of the records at a PGA of 2 pi d / L^2, whose dispersion is twice L's
    cloud, counts = fits["PGA", "cloud"], fits["PGA", "counts"]
    known = 2.0 * np.pi * 0.001 / 0.04**2
    assert float(cloud["median"]) == pytest.approx(known, rel=0.02)
    scatter = 0.6 * np.sqrt((_normals() ** 2).sum() * 5 / 48)
    assert float(cloud["dispersion"]) == pytest.approx(scatter, rel=0.01)
    assert float(counts["median"]) == pytest.approx(known, rel=0.05)  # a tenth of the records
    assert abs(float(counts["dispersion"]) - 0.6) < float(counts["dispersion_error"])
    assert abs(np.log(float(counts["median"]) / known)) < float(counts["median_error"])
    assert float(fits["PGD", "cloud"]["median"]) == pytest.approx(0.001, rel=0.01)
    assert float(fits["PGD", "cloud"]["dispersion"]) < 0.002
    assert fits["PGD", "counts"]["median"] == ""  # nothing overlaps
    assert "the likelihood has no maximum" in (tmp_path / "out" / "report.html").read_text()


def _normals() -> np.ndarray:
    """Deviates of the page's ten records."""
    found = re.search(r"LZ = PROG (.*?) ;", _RECORDS)
    assert found
    return np.array([float(x) for x in found[1].split()])


def _drift(length: np.ndarray, w: float) -> np.ndarray:
    """Largest motion of an undamped oscillator after one sine: its Fourier transform over w.

    Records are 20 straight lines: hats of a half width h, whose transforms are squares of sinc.
    """
    k, h = np.arange(21)[:, None], length / 20.0
    transform = h * (np.sin(0.1 * np.pi * k) * np.exp(1j * w * k * h)).sum(axis=0)
    return np.abs(transform) * np.sinc(w * h / (2.0 * np.pi)) ** 2 / w

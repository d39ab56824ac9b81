"""`ssilang warm` compiles what decks need, and no run after it compiles that again."""

import os
import re
import subprocess
import sys

import pytest

# peaks of a yielding oscillator: one compiled loop of the kernel
DECK = """
T1 = PROG 0. PAS 0.01 2. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (SIN (720. * T1)) ;
X1 = PROG 0.05 ; S1 = SPO G1 'AMOR' X1 'FREQ' (PROG 1. 2. 4.) 'ACCE' ;
S2 = SPON 'SIGN' G1 'SPEL' S1 'ACCE' 'AMOR' X1 'CINE' (PROG 2. 0.1) 'ACCE' ;
"""


@pytest.fixture
def warm(tmp_path):
    """Runs `ssilang warm` on words, with an empty home for compiled code."""
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    given |= {"XDG_CACHE_HOME": str(tmp_path / "home")}

    def run(*words, **extra):
        command = [sys.executable, "-m", "ssilang.cli.main", "warm", *words]
        return subprocess.run(
            command, cwd=tmp_path, env=given | extra, capture_output=True, text=True, check=False
        )

    return run


def test_functions_are_compiled_once_counted_and_kept(warm, tmp_path):
    (tmp_path / "peaks.ssi").write_text(DECK)
    first = warm("peaks.ssi")
    assert (first.returncode, first.stderr) == (0, "")
    kept = tmp_path / "home" / "ssilang" / "compiled"
    count = len(list(kept.glob("ssilang.kernel.records.inelastic-*/*.code")))
    assert count == len(list(kept.rglob("*.code"))) == 1
    deck, total = first.stdout.splitlines()
    assert re.fullmatch(r"peaks.ssi: 1 function compiled, \d+\.\d s", deck)
    assert total.startswith("1 function compiled for 1 deck in ")
    assert total.endswith(f"{kept} keeps 1")
    assert [p.name for p in tmp_path.iterdir() if p.name != "home"] == ["peaks.ssi"]
    second = warm("peaks.ssi", "--lang", "fr")
    assert "peaks.ssi : 0 fonction compilée" in second.stdout
    assert "en garde 1" in second.stdout


def test_decks_that_fail_or_are_not_there_are_told(warm, tmp_path):
    (tmp_path / "wrong.ssi").write_text("X = NOTHING 1 ;\n")
    failed = warm("wrong.ssi")
    assert failed.returncode == 1
    assert "NOTHING" in failed.stderr
    missing = warm("missing.ssi")
    assert missing.returncode == 2
    assert "missing.ssi" in missing.stderr


def test_a_machine_that_keeps_no_code_is_told_before_anything_runs(warm):
    refused = warm(SSILANG_PLAIN_NUMBA="1")
    assert refused.returncode == 1
    assert "compiled code would end with this process" in refused.stderr
    assert refused.stdout == ""

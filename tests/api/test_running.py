"""Runs from Python: parameters, what comes back, what stays on the disk, what goes wrong."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from refusing import refusal
from together import together

import ssilang
from ssilang.cli.main import main


def test_parameters_take_the_place_of_first_assignments_with_their_types():
    text = (
        "A = 1 ; B = 1. ; C = FAUX ; D1 = 'x' ; L = PROG 0. ; N = LECT 0 ; W = MOTS 'A' ; A = A ;"
    )
    given = {"a": 3, "B": 2.5, "C": True, "D1": "word", "L": [1.0, 2.0], "N": np.arange(3)}
    r = ssilang.run(text, W=["UX", "UY"], **given)
    assert (r["A"], r["B"], r["C"], r["D1"]) == (3, 2.5, True, "word")
    assert type(r["A"]) is int
    assert type(r["B"]) is float
    assert r["L"].tolist() == [1.0, 2.0]
    assert r["N"].tolist() == [0, 1, 2]
    assert r["W"] == ["UX", "UY"]


def test_a_series_of_pandas_is_an_evolution_over_its_index():
    import pandas as pd

    record = pd.Series([0.0, 2.0, 1.0], index=[0.0, 0.1, 0.2], name="ACCE")
    r = ssilang.run(
        "ACCE = EVOL 'MANU' (PROG 0.) (PROG 0.) ; B = MAXI (EXTR ACCE 'ORDO') ;", ACCE=record
    )
    assert r["B"] == 2.0
    assert r["ACCE"].series().equals(record)
    long = ssilang.run("X = 1 ; ACCE = 0 ;", ACCE=record.rename("acceleration of the base"))["ACCE"]
    assert (long.names, long.held.parts[0].ordinate_name) == (
        ("acceleration of the base",), "acceleration"
    )  # fmt: skip


@together(
    "given, said", [({"AGG": 1.0}, "did you mean AG?"), ({"langage": "fr"}, "its names are AG")]
)
def test_a_parameter_that_the_script_has_not_is_refused(given, said):
    with refusal(ssilang.Error, "cli.no-such-parameter") as caught:
        ssilang.run("AG = 1. ;", **given)
    assert caught.value.hint == said


def test_a_parameter_may_be_read_by_a_procedure_beside_the_script(tmp_path):
    (tmp_path / "@twice.ssi").write_text("DEBP @TWICE ; RESP (2. * SIZE) ; FINP ;")
    (tmp_path / "deck.ssi").write_text("X = @TWICE ;")
    assert ssilang.run(tmp_path / "deck.ssi", SIZE=4.0)["X"] == 8.0


def test_objects_of_another_run_and_of_python_are_refused_by_name(swing):
    with pytest.raises(ssilang.Error, match="U is a CHPOINT of another run"):
        ssilang.run("U = 1 ;", u=swing["U0"])
    with pytest.raises(ssilang.Error, match="takes no set of Python"):
        ssilang.run("U = 1 ;", u={1})
    with pytest.raises(ssilang.Error, match="a int is no script"):
        ssilang.run(3)


def test_an_error_has_code_place_and_the_message_of_the_command_line(tmp_path, monkeypatch, capsys):
    deck = tmp_path / "deck.ssi"
    deck.write_text("X = 2. ;\nMESS 'before' ;\nY = RACI X ;\n")
    with pytest.raises(ssilang.Error) as caught:
        ssilang.run(deck)
    error = caught.value
    monkeypatch.chdir(tmp_path)
    main([str(deck)])
    assert capsys.readouterr().err.startswith(str(error) + "\n")
    assert (error.code, error.line, error.column) == ("unknown-operator", 3, 5)
    assert error.file == str(deck)
    assert error.result["X"] == 2.0
    assert error.result.output.strip() == "before"


def test_messages_are_in_the_language_that_is_asked_for():
    with pytest.raises(ssilang.Error, match="erreur : le jeu de données n'a pas de ABC"):
        ssilang.run("X = 1 ;", language="fr")["ABC"]
    table = ssilang.run("T = TABL ; T . 'ABC' = PROG 1. ;", language="fr")["T"]
    with pytest.raises(ssilang.Error, match="vouliez-vous dire 'ABC'"):
        table["ABD"]
    with pytest.raises(ssilang.Error, match="erreur : "):
        ssilang.run("LIST (ABC + 1) ;", language="fr")


def test_all_errors_of_a_text_that_cannot_be_read_come_together():
    with pytest.raises(ssilang.Error) as caught:
        ssilang.run("X = (1 ;\nY = 2) ;\n")
    assert [n.line for n in caught.value.notices] == [1, 2]


def test_nothing_stays_on_the_disk_but_what_a_folder_was_asked_for(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    deck = "DESS (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; MESS 'x' ;"
    r = ssilang.run(deck)
    (picture,) = r.figures
    held = picture.path
    assert picture._repr_png_()[:4] == picture.save("copy.png").read_bytes()[:4] == b"\x89PNG"
    (tmp_path / "copy.png").unlink()
    assert picture._repr_svg_() is None
    assert list(tmp_path.iterdir()) == []
    del r, picture
    assert not held.parent.exists()
    kept = ssilang.run(deck, out="here")
    assert {p.name for p in (tmp_path / "here").iterdir()} == {
        "summary.json", *(p.name for p in kept.files)
    }  # fmt: skip
    assert capsys.readouterr() == ("", "")
    ssilang.run(deck, quiet=False)
    assert capsys.readouterr().out.strip() == "x"


def test_checks_warnings_and_time(swing):
    assert swing.checks["peak"].value == pytest.approx(0.2)
    assert [c.ok for c in swing.checks] == [True, False]
    assert len({*swing.checks, *swing.checks}) == 2  # values: nobody changes them behind a summary
    assert len(swing.checks) == repr(swing.checks).count("Check(") == 2
    assert swing.checks.frame().loc[1, "expected"] == 1.0
    with pytest.raises(KeyError, match="did you mean peak"):
        swing.checks["pek"]
    assert swing.output.strip() == "done"
    assert 0.0 < swing.seconds < 600.0


def test_what_calculations_took_is_that_of_the_summary(oscillator, tmp_path):
    r = ssilang.run(oscillator.replace("T2 = DYNAMIC T1 ;", 2 * "T2 = DYNAMIC T1 ;"), out=tmp_path)
    (summary,) = tmp_path.glob("summary.json")
    took = json.loads(summary.read_text())["statistics"]["calculations"]
    assert r.calculations == took
    assert [c["steps"] for c in took] == [500, 500]
    assert all(abs(c["energy_imbalance"]) < 1e-9 for c in took)
    r.calculations[0].clear()  # a copy
    assert r.calculations == took


def test_check_says_what_the_command_says():
    assert ssilang.check("X = 1 ; MESS X ;") == []
    (found,) = ssilang.check("X = 1 ;\nMESS (MAXX X) ;")
    assert (found.severity, found.line, found.column) == ("error", 2, 7)


def test_an_interruption_ends_the_run_and_the_program_goes_on():
    def stop():
        time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGINT)

    before = signal.getsignal(signal.SIGINT)
    threading.Thread(target=stop).start()
    with pytest.raises(KeyboardInterrupt):
        ssilang.run("I = 0 ; REPE B ; I = I + 1 ; FIN B ;")
    assert signal.getsignal(signal.SIGINT) is before
    assert ssilang.run("X = 1 ;")["X"] == 1


def test_importing_ssilang_imports_nothing_heavy():
    code = (
        "import sys, ssilang; assert 'run' in dir(ssilang);"
        "sys.exit(' '.join({'numpy', 'ssilang.api', 'ssilang.cli', 'pandas'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr.strip() == ""
    with pytest.raises(AttributeError, match="ruin"):
        ssilang.ruin  # noqa: B018


def test_what_the_stub_declares_is_what_there_is():
    stub = (Path(ssilang.__file__).with_suffix(".pyi")).read_text()
    declared = {line.split(" as ")[1] for line in stub.splitlines() if " as " in line}
    assert declared == set(ssilang._WHERE)
    for name in declared:
        assert getattr(ssilang, name).__name__ == name


def test_a_library_that_is_missing_is_named_with_the_line_that_installs_it(swing, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"needs pandas: pip install 'ssilang\[python\]'"):
        swing["U0"].frame()

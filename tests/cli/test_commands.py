"""`ssilang FILE`, `run`, `check`, `help`: output, messages, exit codes."""

import subprocess
import sys
from pathlib import Path

import pytest
from references.small_motions import OSCILLATOR
from together import together

from ssilang.cli.main import _compile_ahead
from ssilang.kernel.base.compiled import beside, cache
from ssilang.language.text.source import Source

NO_FILE = "no_such_file.ssi"
NOTEBOOK = Path(__file__).parents[2] / "docs" / "first_uplift.ipynb"
# arguments, {} being the script's file; the script; exit code; words on standard output, on error
COMMANDS = [
    ("run {} --debug", "y = 1 / 0 ;", 1, [], ["Traceback"]),
    ("run {} --lang fr", "y = 1 / 0 ;", 1, [], ["division par zéro"]),
    ("run {} --set AG=3.", "AG = 1. ;\nAG = 2. ;", 0, [], ["deck.ssi:2:", "line 2 gives it"]),
    ("{}", "OPTI 'LANG' 'FRAN' ;\ny = 1 / 0 ;", 1, [], ["division par zéro"]),
    ("run {} --lang fr", "SI (EGA 'ABC' 1) ; FINSI ;", 0, [],
     ["avertissement : le mot ABC est comparé à ce qui n'est pas un mot"]),
    ("run {} --max-statements 500", "REPE b ; x = &b ; FIN b ;", 1, [], ["500"]),
    (NO_FILE, "", 2, [], [NO_FILE]),
    (f"check {NO_FILE}", "", 2, [], [NO_FILE]),
    (f"check {NOTEBOOK}", "", 2, [], ["is a notebook of Jupyter"]),
    (str(NOTEBOOK), "", 2, [], ["is a notebook of Jupyter"]),
    (f"check {NO_FILE} {{}}", "X = 1 2 ;\nY = ;", 2, ["deck.ssi:1:"], []),
    ("check {}", "MESS 'never said' ;\ny = PORG 1. 2. ;", 1, ["did you mean PROG?"], []),
    ("check {}", "x = FLUX 1 2 3 ; MESS x ;", 1, [], []),
    ("check --syntax-only {}", "x = FLUX 1 2 3 ; MESS x ;", 0, [], []),
    ("check {}", "x = 1 / 2 ;\nMESS x ;", 0, ["warning"], []),
    ("{}", "x = 1 ;\ny = 1 / 0 ;", 1, [], ["deck.ssi:2:5"]),
    (".", "", 2, [], []),
    ("--lang fr --out o {}", "A = PRGO 1. ;", 1, [], ["erreur"]),
    ("help prog", "", 0, ["PROG", "Syntax"], []),
    ("help", "", 0, ["PROG", "DIME", "@VERIFIE"], []),
    ("help ZZZZ", "", 1, ["ZZZZ"], []),
    ("help CAPACITE", "", 1, ["CAPA is a Cast3M operator (heat)"], []),
    ("--lang fr help RESO", "", 0, ["RESO : opérateur"], []),
    ("--lang fr help KN", "", 0, ["Raideur normale du joint"], []),
    ("--lang=fr help KN", "", 0, ["Raideur normale du joint"], []),
    ("help KN --lang fr", "", 0, ["Raideur normale du joint"], []),
    ("help friction angle", "", 0, ["PHI"], []),
    ("help TIOM", "", 1, ["did you mean TIMO?"], []),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "text", "code", "out", "err"), COMMANDS)
def test_a_command_ends_with_its_code_and_says_what_it_should(
    ssilang, script, arguments, text, code, out, err
):
    done = ssilang(*arguments.format(script(text + "\n")).split())
    assert done.code == code
    assert [w for w in out if w not in done.out] == [w for w in err if w not in done.err] == []
    assert "never said" not in done.out
    assert ("Traceback" in done.err) is ("--debug" in arguments)


def test_commands_that_say_one_thing_alone(ssilang, script):
    from ssilang import __version__

    assert ssilang("version").out == f"ssilang {__version__}\n"
    sound = ssilang("check", script("y = PROG 1. 2. ;\nMESS (DIME y) ;\n"))
    assert (sound.code, sound.out) == (0, "")
    done = ssilang(script("MESS 'sum ' (1 + 2) ;\n"))
    assert (done.code, done.out, done.err) == (0, "sum 3\n", "")


@pytest.mark.parametrize(("text", "code"), [("x = 1 ;\n", 0), ("y = 1 / 0 ;\n", 1)])
def test_the_process_ends_without_a_search_through_all_that_is_left(script, tmp_path, text, code):
    program = (
        "import atexit, gc, sys\n"
        "from ssilang.cli.main import program\n"
        f"sys.argv = ['ssilang', {script(text)!r}, '-q']\n"
        "atexit.register(lambda: print('left to search:', len(gc.get_objects())))\n"
        "program()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == code, done.stderr
    assert int(done.stdout.split(":")[1]) < 1000  # of more than a hundred thousand


MASS_ON_A_SPRING = OSCILLATOR + "T2 = DYNAMIC T1 ;\n"


def test_verbose_runs_say_by_which_method_motions_are_calculated(ssilang, script):
    deck = script(MASS_ON_A_SPRING)
    assert "compiled" not in ssilang("run", deck).err
    said = ssilang("run", deck, "-v").err
    told = [line[:11] for line in said.split("\n")]
    assert told == ["DYNAMIC: co", "0 files in ", ""]
    assert "DYNAMIC: compiled, all modes: linear but" in said
    assert (
        "DYNAMIC: compilé, tous les modes : linéaire"
        in ssilang("run", deck, "-v", "--lang", "fr").err
    )


def test_scripts_come_by_standard_input(ssilang, process):
    done = process(stdin="MESS 'piped' ;\n")
    assert (done.code, done.out) == (0, "piped\n")
    assert ssilang("-", stdin="MESS 'dash' ;\n").out == "dash\n"
    done = process("--lang", "fr", stdin="A = PRGO 1. ;\n")
    assert (done.code, "erreur" in done.err) == (1, True)
    assert process("-", stdin="MESS 'déjà' ;\n".encode("latin-1")).out == "déjà\n"


def test_a_terminal_without_accents_does_not_stop_a_run(process, script):
    done = process(script("MESS 'déjà' ;\n"), PYTHONIOENCODING="ascii", LC_ALL="C")
    assert done.code == 0


FREE = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; P1 = 0. 0. ; L1 = DROI 2 P1 (1. 0.) ;\n"
    "S1 = L1 TRAN 2 (0. 1.) ; MO1 = MODE S1 MECANIQUE ELASTIQUE ;\n"
    "R = RIGI MO1 (MATE MO1 YOUN 1. NU 0.3) ; U = RESO R (FORC FX 1. P1) 'SOUC' ;\n"
)


@pytest.mark.parametrize(
    ("language", "label", "said"),
    [
        ("en", "warning: ", "the matrix is singular, with 3 free motions"),
        ("fr", "avertissement : ", "la matrice est singulière : 3 mouvements libres"),
    ],
)
def test_what_does_not_stop_a_run_is_called_a_warning(ssilang, script, language, label, said):
    done = ssilang("run", script(FREE), "--lang", language)
    assert done.code == 0
    assert done.err.startswith(label + said)
    assert "translation" in done.err
    assert "erreur" not in done.err
    assert "error" not in done.err


def test_a_setting_has_the_kind_of_the_number_that_it_replaces(ssilang, script):
    deck = script("AG = 4. ; N = 3 ; M = 4. ; MESS (AG / 10) ; MESS (N / 2) ; MESS (M / 10) ;\n")
    said = "AG=1", "--set", "N=5", "--set", "M=1.5"
    done = ssilang("run", deck, "--set", *said)
    assert [float(x) for x in done.out.split()[:3]] == [0.1, 2.0, 0.15]


def test_wrong_settings_are_told_in_the_language_asked_for(ssilang, script, capsys):
    with pytest.raises(SystemExit) as ended:
        ssilang("run", script("A = 1 ;\n"), "--set", "A", "--lang", "fr")
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith("erreur : 'A' n'est pas NOM=VALEUR")


def test_memory_is_bounded_by_option(process, script):
    text = "l1 = PROG 400000 * 1. ; t = TABL ; REPE b 400 ; t . &b = l1 * 2. ; FIN b ;\n"
    big = script(text)
    done = process("run", big, "--max-memory", "500")
    assert done.code == 1
    assert "memory" in done.err


def test_i_keeps_the_session(ssilang, script):
    done = ssilang("run", script("x = 41 ;\n"), "-i", stdin="MESS (x + 1) ;\n")
    assert "42" in done.out


def test_check_of_several_files(ssilang, script):
    done = ssilang("check", script("x = 1 ; MESS x ;\n", "a.ssi"), script("x = (1 ;\n", "b.ssi"))
    assert done.code == 1
    assert "b.ssi" in done.out
    assert "a.ssi" not in done.out


def test_version(process):
    assert process("--version").out.startswith("ssilang ")


@together("arguments", [["check"], ["run"], ["--nonsense"]])
def test_wrong_usage_gives_exit_code_2(arguments):
    from ssilang.cli.main import main

    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2


def test_deep_blocks_run_in_a_fresh_process(process, tmp_path):
    text = "A = 1 ; " + "SI VRAI ; " * 1000 + "A = 2 ; " + "FINSI ; " * 1000 + "MESS A ;"
    (tmp_path / "deep.ssi").write_text(text)
    done = process("deep.ssi")
    assert (done.code, done.out) == (0, "2\n"), done.err[-500:]


def test_one_line_closes_a_run_that_leaves_something(ssilang, script, tmp_path):
    out = str(tmp_path / "out")
    done = ssilang("run", script(MASS_ON_A_SPRING), "--out", out)
    assert "% " not in done.err
    assert done.err.endswith(" %\n")
    assert f"0 files in {out}, 0 warnings, energy within " in done.err
    assert ssilang("run", script(MASS_ON_A_SPRING), "--out", out, "-q").err == ""
    drawn = script("E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;\nDESS E ;\n")
    assert f" in {out}, 0 warnings\n" in ssilang("run", drawn, "--out", out).err
    french = ssilang("run", drawn, "--out", out, "--lang", "fr").err
    assert f" dans {out}, 0 avertissement\n" in french
    import json

    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert any(p.endswith(".png") for p in summary["pictures"])
    assert summary["figures"] == []


@together(
    "script, kept, begun",
    [
        ("J1 = MODE S1 'MECANIQUE' 'ELASTIQUE' 'joint' ;\nPASAPAS T1 ;", False, ["interface"]),
        ("J1 = MODE S1 'MECANIQUE' 'ELASTIQUE' 'JOINT' ;\nDYNAMIC T1 ;", True, []),
        ("J1 = MODE S1 'MECANIQUE' 'ELASTIQUE' 'JOINT' ;\n* PASAPAS\n", False, []),
        ("DYNAMIC T1 ;", False, []),
    ],
)
def test_joints_are_compiled_while_the_script_is_read(monkeypatch, script, kept, begun):
    entered = []
    monkeypatch.setattr(beside.BESIDE, "enter", entered.append)
    monkeypatch.setattr(cache, "is_compiled", lambda package: kept)
    _compile_ahead(Source("deck", script))
    assert entered == begun

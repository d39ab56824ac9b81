"""Options that name files, further scripts; a procedure's refusals, in both languages."""

from pathlib import Path

import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import RunOptions, run_file, run_text
from ssilang.language.say.diagnostics import render


def test_the_listing_goes_to_a_file_instead(tmp_path: Path) -> None:
    script = "MESS 'a' ; OPTI IMPR 'list.txt' ; MESS 'b' ; MESS 'c' 1 ; OPTI IMPR 6 ; MESS 'd' ;"
    result = run_text(script, tmp_path)
    assert result.output == "a\nd\n"
    assert (tmp_path / "list.txt").read_text() == "b\nc1\n"


def test_what_was_listed_can_be_read(tmp_path: Path) -> None:
    script = (
        "OPTI IMPR 'v.txt' ; MESS 'FORMAT' '(F6.2)' 2.5 ; OPTI IMPR 6 ; "
        "OPTI ACQU 'v.txt' ; ACQU X*FLOTTANT ;"
    )
    result = ran(script, tmp_path)
    assert result.session.root.find("X") == 2.5


def test_a_file_name_may_begin_like_a_format_word(tmp_path: Path) -> None:
    ran("OPTI SORT 'FORMES.txt' ; SORT 'CHAI' 'x' ;", tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["FORMES.txt"]


def test_another_script_runs_in_the_middle(tmp_path: Path) -> None:
    (tmp_path / "part.dgibi").write_text("Y = 2 * X ;\n")
    (tmp_path / "deck.ssi").write_text("X = 3 ; OPTI DONN 'part.dgibi' ; Z = Y + 1 ;")
    result = run_file(tmp_path / "deck.ssi", RunOptions(output_directory=tmp_path / "out"))
    assert result.session.root.find("Z") == 7


@pytest.mark.parametrize("name", ["../part.dgibi", "/etc/passwd"])
def test_scripts_of_other_folders_are_refused(name: str, tmp_path: Path) -> None:
    (tmp_path / "deck").mkdir()
    (tmp_path / "part.dgibi").write_text("Y = 1 ;")
    (tmp_path / "deck" / "deck.ssi").write_text(f"OPTI DONN '{name}' ;")
    result = run_file(tmp_path / "deck" / "deck.ssi", RunOptions(output_directory=tmp_path / "out"))
    assert result.errors[0].code == "forbidden-path"


@pytest.mark.parametrize("folder", ["/home/of/another/machine", "/gone/below/here"])
def test_what_goes_to_a_folder_that_is_not_here_is_in_the_output_folder(
    folder: str, tmp_path: Path
) -> None:
    deck = tmp_path / "deck" / "deck.ssi"
    deck.parent.mkdir()
    deck.write_text(
        f"OPTI DIME 2 ELEM SEG2 SAUV '{folder}/kept' ; L = DROI 3 (0. 0.) (1. 0.) ; SAUV L ; "
        f"OPTI SORT '{folder}/told.txt' ; SORT 'CHAI' 'here' ; N = 0 ; OUBL L ; "
        f"OPTI REST '{folder}/kept' ; REST ; N = NBEL L ;"
    )
    result = run_file(deck, RunOptions(output_directory=tmp_path / "out"))
    assert result.exit_code == 0, result.message
    assert result.session.root.find("N") == 3
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["kept", "told.txt"]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["deck", "out"]
    assert [w.code for w in result.session.warnings] == ["io.folder-not-here"] * 2


def test_a_folder_that_is_here_is_written_to_when_allowed_alone(tmp_path: Path) -> None:
    deck, other = tmp_path / "deck" / "deck.ssi", tmp_path / "other"
    deck.parent.mkdir()
    other.mkdir()
    deck.write_text(f"OPTI SORT '{other}/a.txt' ; SORT 'CHAI' 'x' ;")
    result = run_file(deck, RunOptions(output_directory=tmp_path / "out"))
    assert [e.code for e in result.errors] == ["forbidden-path"]
    assert list(other.iterdir()) == []
    run_file(deck, RunOptions(output_directory=tmp_path / "out", allowed=[other]))
    assert (other / "a.txt").read_text() == "x\n"


@together(
    "language, told",
    [
        ("en", "error 308: CONVT: ZUT is no unit of time"),
        ("fr", "erreur 308 : CONVT : ZUT n'est pas une unité de temps"),
    ],
)
def test_a_procedure_refuses_in_the_language_of_the_run(language, told, tmp_path):
    options = RunOptions(output_directory=tmp_path, language=language)
    result = run_text("A = 1 ;\nX = CONVT 1. 'ZUT' ;\n", options=options)
    assert result.exit_code == 1
    assert result.message.startswith(told), result.message
    assert "script:2:" in result.message
    assert result.errors[0].code == "stdlib.convt-no-unit-time-fs"


@together(
    "language, told",
    [
        ("en", "warning: IMPEDSOL: KAUSEL for DISQUE is static"),
        ("fr", "avertissement : IMPEDSOL : KAUSEL pour DISQUE est statique"),
    ],
)
def test_a_procedure_warns_at_the_line_of_the_script_and_goes_on(language, told, tmp_path):
    options = RunOptions(output_directory=tmp_path, language=language)
    text = (
        "OPTI DIME 2 ; T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 1. ; T . 'YOUNG' = 1. ;\n"
        "T . 'POISSON' = 0. ; T . 'MASSE_VOLUMIQUE' = 1. ; T . 'EPAISSEUR' = 3. ;\n"
        "R = IMPEDSOL T ; X = R . 'STATIQUE' . 'UX' ;"
    )
    result = run_text(text, options=options)
    (warning,) = result.session.warnings
    shown = render(warning, language)
    assert shown.startswith(told), shown
    assert "script:3:" in shown
    assert result.exit_code == 0
    assert result.session.root.find("X") == pytest.approx(8.0 * 0.5 / 2.0 * (1.0 + 1.0 / 6.0))

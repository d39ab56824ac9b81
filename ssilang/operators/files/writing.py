"""SORT: what it writes, by the word that follows; its text formats CSV and CHAI."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ssilang.io.csv_tables import Column, csv_lines
from ssilang.kernel.curves.curve import Curve
from ssilang.language.run.call import Call
from ssilang.language.run.session import Check
from ssilang.language.values import ListEnti, ListMots, ListReel, Table
from ssilang.operators.dispatch import ByWord
from ssilang.operators.files.outputs import option_name, output_path, run_output
from ssilang.operators.texts.words import read_text

SORT = ByWord(
    "SORT",
    "files",
    "Writes objects to the file that OPTI SORT names (fort.7 if it names none), in the output "
    "folder. The extension may be left out.",
    "Écrit des objets dans le fichier que nomme OPTI SORT (fort.7 sinon), dans le dossier de "
    "sortie. L'extension peut être omise.",
    "SORTIR",
)


def target_path(call: Call, suffix: str = "", also: tuple[str, ...] = ()) -> Path:
    """The file of OPTI SORT, with `suffix` unless it has it or one of `also`."""
    name = option_name(call.session, "SORT", 7)
    path = output_path(call, name)
    if suffix and path.suffix.lower() not in (suffix, *also):
        path = path.with_name(path.name + suffix)
    return path


_SEPARATORS = {"PVIR": ";", "VIRG": ",", "ESPA": " ", "TABU": "\t", "OBLI": "/"}


@SORT.on(
    "EXCE",
    syntax="SORT 'EXCE' OBJ1 (OBJ2 ...) ('NCOL' N1) ('SEPA' PVIR|VIRG|ESPA|TABU|OBLI) "
    "('DIGI' N2) ;",
    en="EXCE: a CSV table with a column for each list of the objects (LISTREEL LISTENTI LISTMOTS "
    "EVOLUTION TABLE), headed by the curves' axis names and the tables' indices. NCOL columns "
    "at most side by side, DIGI decimals. Further SORT statements append.",
    fr="EXCE : un tableau CSV, une colonne par liste des objets (LISTREEL LISTENTI LISTMOTS "
    "EVOLUTION TABLE), titrée par les noms des axes des évolutions et les indices des tables. "
    "NCOL colonnes au plus côte à côte, DIGI décimales. Les SORT suivants ajoutent au fichier.",
    examples=("OPTI SORT 'valeurs.csv' ; SORT 'EXCE' (PROG 1. 2. 3.) 'SEPA' 'VIRG' ;",),
)
def _exce(call: Call, word: str) -> None:
    columns: list[Column] = []
    options: dict[str, Any] = {}
    kinds = ("LISTENTI", "LISTREEL", "LISTMOTS", "EVOLUTIO", "TABLE")
    while True:
        said = call.keyword(("NCOL", "SEPA", "DIGI"))
        if said == "SEPA":
            named = call.keyword(tuple(_SEPARATORS))
            if named is None:
                raise call.error("operators.files.separator", separators=_SEPARATORS)
            options["separator"] = _SEPARATORS[named]
            continue
        if said is not None:
            n = call.required("ENTIER", after=call.keyword_end)
            if n < (1 if said == "NCOL" else 0):
                raise call.error("operators.files.positive-number", n, said=said, n=n)
            options["width" if said == "NCOL" else "digits"] = n
            continue
        operand = call.read(*kinds)
        if operand is None:
            break
        columns += _columns(operand.value, "")
    if not columns:
        raise call.missing(kinds)
    path = target_path(call, ".csv", (".txt", ".dat", ".xls"))
    run_output(call.session).add_lines("SORT", path, csv_lines(columns, **options))


def _columns(value: Any, name: str) -> list[Column]:
    if isinstance(value, ListReel | ListEnti | ListMots):
        return [Column(name, list(value.values))]
    if isinstance(value, Curve):
        made = []
        for part in value.parts:
            made.append(Column(part.abscissa_name, list(part.abscissa_words or part.abscissas)))
            made.append(Column(part.ordinate_name, list(part.words or part.ordinates)))
        return made
    if isinstance(value, Table):
        found: list[Column] = []
        for index, inner in value.items():
            found += _columns(inner, str(index) if isinstance(index, str | int | float) else "")
        return found
    return []


@SORT.on(
    "CHAI",
    syntax="SORT 'CHAI' OBJ1 (OBJ2 ...) ;",
    en="CHAI: a line of text, written as MESS writes it. Further SORT statements append.",
    fr="CHAI : une ligne de texte, écrite comme par MESS. Les SORT suivants ajoutent au fichier.",
    examples=("OPTI SORT 'notes.txt' ; SORT 'CHAI' 'x =' 2.5 ;",),
)
def _chai(call: Call, word: str) -> None:
    text = read_text(call)
    run_output(call.session).add_lines("SORT", target_path(call), [text])


@SORT.on(
    "BILA",
    syntax="SORT 'BILA' MOT1 FLOT1 (FLOT2 FLOT3) ;",
    en="BILA: reports a figure of the run under a name in summary.json, with the value expected "
    "and the tolerance on their distance if there are any.",
    fr="BILA : inscrit un résultat du calcul sous un nom dans summary.json, avec s'il y a lieu la "
    "valeur attendue et la tolérance sur l'écart.",
    examples=("SORT 'BILA' 'two and two' (2. + 2.) 4. 1.E-12 ;",),
)
def _bila(call: Call, word: str) -> None:
    name = str(call.required("MOT", after=call.keyword_end)).strip()
    value = float(call.required("FLOTTANT"))
    expected = call.read("FLOTTANT")
    tolerance = None if expected is None else float(call.required("FLOTTANT"))
    reference = None if expected is None else float(expected.value)
    call.session.checks.append(Check(name, value, reference, tolerance))

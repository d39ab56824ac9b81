"""LIST: what objects hold, in readable lines."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.kernel.curves.curve import Curve, Load
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.registry import Help, arg, flag, key, lead, many, named, shared
from ssilang.language.run.call import Call
from ssilang.language.run.session import Session
from ssilang.language.values import (
    ANNULE,
    ListChpo,
    ListEnti,
    ListMots,
    ListObje,
    ListReel,
    Objet,
    Procedure,
    Table,
    Texte,
    known_types,
    type_of,
)
from ssilang.operators.dispatch import LISTINGS, listing
from ssilang.operators.fields.signs import nature_word
from ssilang.operators.texts.fortran_format import formatted

_ROWS = 200  # rows printed of a field or curve before the middle is left out


def real(x: float) -> str:
    """A real in 12 columns."""
    if x == 0.0 or 1e-98 < abs(x) < 1e98:  # two digits of exponent: Python writes them the same
        return f"{x:12.5E}"
    return formatted("(1PE12.5)", x)


def _rows(cells: list[str], per_line: int) -> list[str]:
    return ["".join(cells[i : i + per_line]) for i in range(0, len(cells), per_line)]


@listing("ENTIER")
def _integer(value: int, mode: str) -> str:
    return f"Entier valant : {value}"


@listing("FLOTTANT")
def _real(value: float, mode: str) -> str:
    return f"Réel valant : {formatted('(1PE22.14)', value)}"


@listing("LOGIQUE")
def _logical(value: bool, mode: str) -> str:
    return f"Logique valant : {'VRAI' if value else 'FAUX'}"


@listing("MOT")
def _word(value: str, mode: str) -> str:
    return f"Chaîne de {len(value)} caractères de contenu : {value}"


@listing("TEXTE")
def _text(value: Texte, mode: str) -> str:
    return "Texte de contenu : " + " ".join(i.span.text for i in value.items)


@listing("LISTREEL")
def _reals(value: ListReel, mode: str) -> str:
    head = f"Liste de réels contenant {len(value)} réel(s)"
    if mode:
        return head
    return "\n".join([head + " :", *_rows([f" {real(v)}" for v in value.values.tolist()], 10)])


@listing("LISTENTI")
def _integers(value: ListEnti, mode: str) -> str:
    head = f"Liste d'entiers contenant {len(value)} entier(s)"
    if mode:
        return head
    return "\n".join([head + " :", *_rows([f" {v:7d}" for v in value.values.tolist()], 20)])


@listing("LISTMOTS")
def _words(value: ListMots, mode: str) -> str:
    head = f"Liste de mots contenant {len(value)} mot(s)"
    if mode:
        return head
    return "\n".join([head + " :", *_rows([f" {v.rstrip():<8s}" for v in value.values], 10)])


@listing("LISTCHPO", "LISTOBJE")
def _objects(value: ListChpo | ListObje, mode: str) -> str:
    kind = type_of(value.values[0]) if value.values else "objet"
    return f"Liste contenant {len(value)} objet(s) de type {kind}"


def brief(value: Any) -> str:
    """A value in a few characters, for tables."""
    if isinstance(value, bool):
        return "VRAI" if value else "FAUX"
    if isinstance(value, float):
        return real(value).strip()
    if isinstance(value, str):
        return value if len(value) <= 40 else value[:37] + "..."
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Table):
        return value.subtype
    if isinstance(value, Procedure):
        return value.name
    return f"{len(value)} éléments" if hasattr(value, "__len__") else ""


@listing("TABLE")
def _table(value: Table, mode: str) -> str:
    lines = [f"Table de {len(value)} indice(s)"]
    if mode:
        return lines[0]
    lines.append("  indice : type et valeur        objet : type et valeur")
    for index, held in value.items():
        left = f"{type_of(index):<8s} {brief(index)}"
        lines.append(f"  {left:<30s} {type_of(held):<8s} {brief(held)}".rstrip())
    return "\n".join(lines)


@listing("OBJET")
def _object(value: Objet, mode: str) -> str:
    lines = [f"Objet de classe {value.class_name}"]
    for name, held in value.attributes.items():
        lines.append(f"  élément {name:<24s} {type_of(held):<8s} {brief(held)}".rstrip())
    lines += [f"  méthode {name}" for name in value.methods]
    return "\n".join(lines)


@listing("PROCEDUR")
def _procedure(value: Procedure, mode: str) -> str:
    text = value.definition.span.text
    lines = text.split("\n")
    head = f"Procédure {value.name} ({value.origin}), {len(lines)} ligne(s)"
    if mode:
        return head
    return "\n".join([head, *(f"{i:5d}  {line}" for i, line in enumerate(lines, start=1))])


@listing("EVOLUTIO")
def _curves(value: Curve, mode: str) -> str:
    lines = [f"Evolution de {len(value.parts)} courbe(s), titre : {value.title}".rstrip()]
    for i, part in enumerate(value.parts, start=1):
        kind = part.kind or "REEL"
        lines.append(f"  courbe {i} de type {kind}, couleur {COLOURS[part.colour]}, "
                     f"{len(part.abscissas)} points, légende : {part.legend}".rstrip())  # fmt: skip
        if mode:
            continue
        lines.append(
            f"  {part.abscissa_name or 'abscisse':>13s} {part.ordinate_name or 'ordonnée':>13s}"
        )
        ordinates = part.words or [f" {real(y)}" for y in part.ordinates.tolist()]
        abscissas = part.abscissa_words or [real(x) for x in part.abscissas.tolist()]
        pairs = zip(abscissas, ordinates, strict=True)
        lines += _shortened([f"   {x} {y}" for x, y in pairs])
    return "\n".join(lines)


def _shortened(rows: list[str]) -> list[str]:
    if len(rows) <= _ROWS:
        return rows
    half = _ROWS // 2
    return [*rows[:half], f"   ... {len(rows) - _ROWS} lignes ...", *rows[-half:]]


@listing("CHPOINT")
def _node_field(value: NodeField, mode: str) -> str:
    nodes = value.node_ids
    names = list(value.components)
    head = f"Champ par points, {len(nodes)} noeuds, {len(names)} composante(s)"
    lines = [f"{head}, nature {nature_word(value.nature)}"]
    if value.title:
        lines.append(f"  titre : {value.title}")
    for name in names:
        v = value.components[name].values
        if len(v):
            lines.append(f"  {name:<8s} de {real(v.min())} à {real(v.max())}")
    if mode or not len(nodes):
        return "\n".join(lines)
    lines.append("  noeud  " + "".join(f"{n:>14s}" for n in names))
    columns = np.array([value.components[n].at(nodes, np.nan) for n in names])
    rows = []
    for k, node in enumerate(nodes.tolist()):
        cells = ["            ." if np.isnan(x) else f" {real(x)}" for x in columns[:, k]]
        rows.append(f"{node + 1:7d}  " + "".join(f"{c:>14s}" for c in cells))
    return "\n".join([*lines, *_shortened(rows)])


@listing("CHARGEME")
def _load(value: Load, mode: str) -> str:
    lines = [f"Chargement de {len(value.parts)} partie(s)"]
    for part in value.parts:
        if part.steps:
            what = f"{len(part.steps)} instants de {part.steps[0][0]:g} à {part.steps[-1][0]:g}"
        elif part.time is None:
            what = f"{type_of(part.space)} constant"
        else:
            x = part.time.parts[0].abscissas
            what = f"{type_of(part.space)} fois une évolution de {x[0]:g} à {x[-1]:g}"
        lines.append(f"  '{part.name:<4s}' {what}")
    return "\n".join(lines)


# --- with numbers behind the object ----------------------------------------------------------


def _procedure_lines(value: Procedure, first: int, last: int) -> str:
    lines = value.definition.span.text.split("\n")
    chosen = list(enumerate(lines, start=1))[max(first - 1, 0) : max(last, 0)]
    return "\n".join([_procedure(value, "RESU"), *(f"{i:5d}  {line}" for i, line in chosen)])


def _reals_by(value: ListReel, per_line: int, _: int) -> str:
    rows = _rows([f" {real(v)}" for v in value.values.tolist()], per_line)
    return "\n".join([_reals(value, "RESU") + " :", *rows])


def _integers_by(value: ListEnti, per_line: int, _: int) -> str:
    rows = _rows([f" {v:7d}" for v in value.values.tolist()], per_line)
    return "\n".join([_integers(value, "RESU") + " :", *rows])


def _table_within(value: Table, depth: int, _: int) -> str:
    return "\n".join(_nested(value, min(depth, _DEEPEST), (id(value),)))


def _nested(value: Table, depth: int, above: tuple[int, ...]) -> list[str]:
    """The table, and below each table that it holds that table's lines, moved in."""
    head, *rows = _table(value, "").split("\n")
    lines = [head, *rows[:1]]
    for row, (_, held) in zip(rows[1:], value.items(), strict=True):
        lines.append(row)
        if depth > 0 and isinstance(held, Table) and id(held) not in above:
            lines += ["    " + r for r in _nested(held, depth - 1, (*above, id(held)))]
    return lines


_DEEPEST = 10
_NUMBERED: dict[str, Callable[[Any, int, int], str]] = {
    "PROCEDUR": _procedure_lines,
    "LISTREEL": _reals_by,
    "LISTENTI": _integers_by,
    "TABLE": _table_within,
}


def described(value: Any, mode: str = "", numbers: Sequence[int] = ()) -> str:
    """The lines that LIST prints of an object, `numbers` being those that stand behind it."""
    numbered = _NUMBERED.get(type_of(value))
    if numbers and numbered is not None and min(numbers) > 0:
        return numbered(value, numbers[0], numbers[-1])
    entry = LISTINGS.get(type_of(value))
    if entry is not None:
        return entry(value, mode)
    if value is ANNULE:
        return "Objet non défini (ANNULE)"
    return f"Objet de type {type_of(value)}"


def _all_names(session: Session, kind: str) -> str:
    frame = session.frame
    rows = []
    for name in sorted(frame.names()):
        value = frame.find(name)
        if not kind or type_of(value) == kind:
            rows.append(f"  {name:<24s} {type_of(value):<8s} {brief(value)}".rstrip())
    return "\n".join([f"{len(rows)} objet(s) nommé(s){' de type ' + kind if kind else ''}", *rows])


LIST = shared(
    "LIST",
    "output",
    Help(
        en="Prints what an object holds ('RESUME': less); without object, the names in use; "
        "*TYPE, those of one type. A number behind a list of numbers: values in a line (10 reals, "
        "20 integers); behind a table: how deep the tables that it holds are printed (10 at most); "
        "behind a procedure: the line, or the first and the last line.",
        fr="Imprime le contenu d'un objet ('RESUME' : moins) ; sans objet, les noms connus ; "
        "*TYPE, ceux d'un type. Un entier derrière une liste de nombres : valeurs par ligne (10 "
        "réels, 20 entiers) ; derrière une table : profondeur d'impression de ses sous-tables (10 "
        "au plus) ; derrière une procédure : la ligne, ou la première et la dernière ligne.",
        syntax="LIST ('RESU') OBJ1 (N1 (N2)) ; LIST ; LIST *MOT1 ;",
        examples=(
            "LIST (PROG 1. 2. 3.) ;",
            "X = 3 ; LIST *ENTIER ;",
            "T = TABL ; T . 1 = TABL ; T . 1 . 'A' = 3. ; LIST T 1 ;",
            "LIST *'ENTIER' ; A = 3 ; LIST ;",
            "LIST 'RESU' ;",
        ),
    ),
    full_name="LISTE",
    terminal=True,
)


@LIST.form(
    key("star", "*", optional=False, en="all objects of a type", fr="les objets d'un type"),
    named("kind", en="type word", fr="mot de type"),
)
def _list_names(call: Call, star: bool, kind: str) -> None:
    wanted = kind[:8]
    if wanted not in known_types():
        raise call.error(
            "operators.texts.unknown-type", kind=wanted, known_types=sorted(known_types())
        )
    call.session.print(_all_names(call.session, wanted))


@LIST.form(
    flag("brief", "RESU", en="less of it", fr="en résumé"),
    arg("value", "*", "TEXTE", en="what is printed", fr="ce qui est imprimé"),
    many(
        "numbers",
        "ENTIER",
        en="values in a line, depth of tables, or first and last line",
        fr="valeurs par ligne, profondeur des tables, ou première et dernière ligne",
    ),
)
def _list_object(session: Session, brief: bool, value: Any, numbers: tuple[int, ...]) -> None:
    session.print(described(value, "RESU" if brief else "", numbers))


@LIST.form(lead("value", "*", "TEXTE", en="what is printed", fr="ce qui est imprimé"))
def _list_word(session: Session, value: Any) -> None:
    """A word that is spelt like the keyword, alone."""
    session.print(described(value))


@LIST.form()
def _list_all(session: Session) -> None:
    session.print(_all_names(session, ""))

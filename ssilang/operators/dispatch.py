"""Operators that several families share: one name, a table of what it does by type or by word.

A family adds its entry with the decorator `on`; help texts and examples add up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ssilang.language.call import Call, Operand
from ssilang.language.errors import SsiError
from ssilang.language.registry import OPERATORS, Help, Operator, operator
from ssilang.language.values import Mot, type_of

Entry = Callable[[Call, Any], Any]


def extend_help(name: str, syntax: str, en: str, fr: str, examples: tuple[str, ...]) -> None:
    """Add a paragraph, syntax lines and examples to an operator's help."""
    made: Operator = OPERATORS[name]
    old = made.help
    made.help = Help(
        "\n".join(t for t in (old.en, en) if t),
        "\n".join(t for t in (old.fr, fr) if t),
        "\n".join(t for t in (old.syntax, syntax) if t),
        (*old.examples, *examples),
    )


def _adder(
    name: str,
    table: dict[str, Entry],
    keys: tuple[str, ...],
    texts: tuple[str, str, str],
    examples: tuple[str, ...],
) -> Callable[[Entry], Entry]:
    """A decorator that enters a function under the keys and adds to the operator's help."""

    def add(entry: Entry) -> Entry:
        table.update(dict.fromkeys(keys, entry))
        extend_help(name, *texts, examples)
        return entry

    return add


class ByType:
    """An operator whose work depends on the type of its main operand.

    The first readable operand whose type has an entry is the main one; words written before it
    (`MAXI 'ABS' L`) are left for the entry to read.
    """

    def __init__(
        self,
        name: str,
        family: str,
        en: str,
        fr: str,
        full_name: str = "",
        terminal: bool = False,
    ) -> None:
        self.name = name
        self.entries: dict[str, Entry] = {}
        operator(
            name,
            family=family,
            help=Help(en, fr),
            full_name=full_name,
            terminal=terminal,
            reads_itself=True,
        )(self._run)

    def _run(self, call: Call) -> Any:
        operand = call.read(*self.entries) or self._behind_words(call)
        if operand is None:
            raise call.missing(tuple(self.entries))
        return self.entries[type_of(operand.value)](call, operand.value)

    def _behind_words(self, call: Call) -> Operand | None:
        """Consume the main operand that stands behind one or two words."""
        words = 0
        for i, operand in enumerate(call.operands):
            if type_of(operand.value) in self.entries:
                call.used.append(operand)
                return call.operands.pop(i)
            words += isinstance(operand.value, Mot)
            if words > 2:
                break
        return None

    def on(
        self,
        *types: str,
        syntax: str = "",
        en: str = "",
        fr: str = "",
        examples: tuple[str, ...] = (),
    ) -> Callable[[Entry], Entry]:
        """Decorator: a function `(call, value)` for main operands of the types."""

        return _adder(self.name, self.entries, types, (syntax, en, fr), examples)


class ByWord:
    """An operator whose work depends on the keyword that follows it.

    Without a known keyword the entry registered for '' runs, or for the type of an operand
    (`on_type`).
    """

    def __init__(
        self, name: str, family: str, en: str, fr: str, full_name: str = "", length: int = 4
    ) -> None:
        self.name = name
        self.length = length
        self.entries: dict[str, Entry] = {}
        self.by_type: dict[str, Entry] = {}
        operator(name, family=family, help=Help(en, fr), full_name=full_name, reads_itself=True)(
            self._run
        )

    def _run(self, call: Call) -> Any:
        word = call.keyword([w for w in self.entries if w], self.length)
        if word is not None:
            return self.entries[word](call, word)
        operand = call.read(*self.by_type) if self.by_type else None
        if operand is not None:
            return self.by_type[type_of(operand.value)](call, operand.value)
        if "" in self.entries:
            return self.entries[""](call, "")
        raise SsiError(
            "missing-keyword",
            call.span,
            operator=self.name,
            words=sorted(self.entries),
            found=call.peek_word() or "",
        )

    def on(
        self,
        *words: str,
        syntax: str = "",
        en: str = "",
        fr: str = "",
        examples: tuple[str, ...] = (),
    ) -> Callable[[Entry], Entry]:
        """Decorator: a function `(call, word)` for keywords (capitals, in full)."""

        return _adder(self.name, self.entries, words, (syntax, en, fr), examples)

    def on_type(
        self,
        *types: str,
        syntax: str = "",
        en: str = "",
        fr: str = "",
        examples: tuple[str, ...] = (),
    ) -> Callable[[Entry], Entry]:
        """Decorator: a function `(call, value)` when no keyword of the table is there."""

        return _adder(self.name, self.by_type, types, (syntax, en, fr), examples)


EXTR = ByType(
    "EXTR",
    "objects",
    "Takes a part out of an object.",
    "Extrait une partie d'un objet.",
    "EXTRAIRE",
    terminal=True,
)
DIME = ByType(
    "DIME",
    "objects",
    "Number of items of a list, table, word, curve ...",
    "Nombre d'éléments d'une liste, table, mot, évolution ...",
    "DIMENSION",
)
ENLE = ByType(
    "ENLE",
    "objects",
    "Removes items; gives a new object.",
    "Enlève des éléments ; rend un nouvel objet.",
    "ENLEVER",
)
REDU = ByType(
    "REDU",
    "fields",
    "Restricts an object to a smaller support.",
    "Réduit un objet à un support plus petit.",
    "REDUIRE",
)
MANU = ByWord(
    "MANU",
    "objects",
    "Makes an object from its parts, named by a keyword.",
    "Fabrique un objet à partir de ses éléments, selon un mot-clé.",
    "MANUEL",
)
CHAN = ByWord(
    "CHAN",
    "objects",
    "Changes an object in a way named by a keyword.",
    "Change un objet de la façon que dit le mot-clé.",
    "CHANGER",
)
MAXI = ByType(
    "MAXI",
    "fields",
    "Largest value of a list, field or curve.",
    "Plus grande valeur d'une liste, d'un champ ou d'une évolution.",
    "MAXIMUM",
)
MINI = ByType(
    "MINI",
    "fields",
    "Smallest value of a list, field or curve.",
    "Plus petite valeur d'une liste, d'un champ ou d'une évolution.",
    "MINIMUM",
)
COPI = ByType("COPI", "objects", "Copy of an object.", "Copie d'un objet.", "COPIER")
ORDO = ByType("ORDO", "objects", "Sorts the items of an object.", "Ordonne un objet.", "ORDONNER")

COUL = ByType("COUL", "objects", "Gives a colour.", "Attribue une couleur.", "COULEUR")
INVE = ByType("INVE", "objects", "Inverts an object.", "Inverse un objet.", "INVERSE")
UNIQ = ByType("UNIQ", "objects", "Removes doubles.", "Supprime les doublons.", "UNIQUE")
INTG = ByType(
    "INTG", "fields", "Integral of a field or a curve.", "Intégrale d'un champ ou d'une évolution."
)

ListingEntry = Callable[[Any, str], str]
LISTINGS: dict[str, ListingEntry] = {}
"""LIST: type -> function (value, 'RESU' or '') giving the text that is printed."""


def listing(*types: str) -> Callable[[ListingEntry], ListingEntry]:
    """Decorator: how LIST prints objects of these types."""

    def add(entry: ListingEntry) -> ListingEntry:
        for word in types:
            LISTINGS[word] = entry
        return entry

    return add


UnionRule = Callable[[Any, Any], Any]
UNIONS: dict[tuple[str, str], UnionRule] = {}
"""ET: (left type, right type) -> function."""


def union(*pairs: tuple[str, str]) -> Callable[[UnionRule], UnionRule]:
    """Decorator: what ET does on pairs of types."""

    def add(entry: UnionRule) -> UnionRule:
        for pair in pairs:
            UNIONS[pair] = entry
        return entry

    return add


def _unite(call: Call) -> Any:
    left = call.read("*")
    right = call.read("*") if left is not None else None
    if left is None or right is None:
        raise SsiError("two-operands", call.span, operator="ET")
    types = type_of(left.value), type_of(right.value)
    found = UNIONS.get(types)
    if found is None:
        raise SsiError(
            "no-rule", left.span.to(right.span), operator="ET", left=types[0], right=types[1]
        )
    return found(left.value, right.value)


operator(
    "ET",
    family="objects",
    help=Help(
        "Joins two objects: union of meshes, sum of matrices, concatenation of lists, logical and.",
        "Réunit deux objets : union de maillages, somme de rigidités, suite de listes, et logique.",
        "OBJ3 = OBJ1 ET OBJ2 ;",
        ("l = (PROG 1. 2.) ET 3. ; LIST l ;", "SI (VRAI ET FAUX) ; ERRE 5 ; FINSI ;"),
    ),
    reads_itself=True,
)(_unite)

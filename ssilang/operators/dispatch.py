"""Operators that several families share: one name, a table of what it does by type or by word.

A family adds its entry with the decorator `on`; help texts and examples add up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ssilang.language.registry import (
    ANY,
    OPERATORS,
    Help,
    arg,
    flag,
    main,
    operator,
    opt,
    said,
    shared,
)
from ssilang.language.run.call import Call
from ssilang.language.say.errors import SsiError
from ssilang.language.values import Mot, type_of
from ssilang.messages.message import Teller

if TYPE_CHECKING:
    from ssilang.language.text.source import Span

Entry = Callable[[Call, Any], Any]

UNDECLARED = "?"
"""Reason of a form that nobody has declared yet."""


def extend_help(name: str, syntax: str, en: str, fr: str, examples: tuple[str, ...]) -> None:
    """Add a paragraph, syntax lines and examples to an operator's help."""
    made = OPERATORS[name]
    old = made.about
    made.about = Help(
        "\n".join(t for t in (old.en, en) if t),
        "\n".join(t for t in (old.fr, fr) if t),
        "\n".join(t for t in (old.syntax, syntax) if t),
        (*old.examples, *examples),
    )


class Shared:
    """An operator whose forms stand in several families; `form` adds one (see `Operator.form`)."""

    def __init__(
        self,
        name: str,
        family: str,
        en: str,
        fr: str,
        full_name: str = "",
        terminal: bool = False,
        length: int = 4,
    ) -> None:
        self.name = name
        self.length = length
        self.operator = shared(name, family, Help(en, fr), full_name=full_name, terminal=terminal)
        self.form = self.operator.form


class ByType(Shared):
    """One whose work depends on the type of its main operand."""

    def on(
        self,
        *types: str,
        syntax: str = "",
        en: str = "",
        fr: str = "",
        examples: tuple[str, ...] = (),
    ) -> Callable[[Entry], Entry]:
        """Decorator: `(call, value)`, read by hand, for main operands of the types."""
        return self.form(
            main("value", *types), syntax=syntax, en=en, fr=fr, examples=examples,
            by_hand=UNDECLARED,
        )  # fmt: skip


class ByWord(Shared):
    """One whose work depends on the keyword that follows it."""

    def on(
        self,
        *words: str,
        of: tuple[str, ...] = (),
        syntax: str = "",
        en: str = "",
        fr: str = "",
        examples: tuple[str, ...] = (),
    ) -> Callable[[Entry], Entry]:
        """Decorator: a function `(call, word)` that reads by hand, for keywords (in full).

        With `of`, for operands of these types only: several families may share a keyword.
        """
        entries = (said(*words, length=self.length),) if words != ("",) else ()
        return self.form(
            *entries, of=of, syntax=syntax, en=en, fr=fr, examples=examples, by_hand=UNDECLARED
        )

    def on_type(
        self,
        *types: str,
        syntax: str = "",
        en: str = "",
        fr: str = "",
        examples: tuple[str, ...] = (),
    ) -> Callable[[Entry], Entry]:
        """Decorator: a function `(call, value)` that reads by hand, without a keyword."""
        return self.form(
            main("value", *types), syntax=syntax, en=en, fr=fr, examples=examples,
            by_hand=UNDECLARED,
        )  # fmt: skip


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
extend_help("DIME", "ENTI1 = DIME OBJ1 ;", "", "", ("LIST (DIME (PROG 1. 2. 3.)) ;",))
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

PSCA = ByType("PSCA", "fields", "Scalar product.", "Produit scalaire.", "PSCAL")
PVEC = ByType("PVEC", "fields", "Vector product.", "Produit vectoriel.")
COOR = ByType(
    "COOR",
    "mesh",
    "Coordinates of what an object stands on.",
    "Coordonnées du support d'un objet.",
    "COORDONNEE",
)
DIFF = ByType(
    "DIFF",
    "objects",
    "What belongs to one of two objects only (symmetric difference).",
    "Ce qui n'appartient qu'à l'un de deux objets (différence symétrique).",
    "DIFFERENCE",
)
INTE = ByType(
    "INTE",
    "objects",
    "What is common to two objects.",
    "Ce qui est commun à deux objets.",
    "INTERSECTION",
)

ListingEntry = Callable[[Any, bool, Teller], str]
LISTINGS: dict[str, ListingEntry] = {}
"""LIST: type -> function (value, whether in brief, what makes texts of codes)."""


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


CallUnionRule = Callable[[Call, Any, Any], Any]
CALL_UNIONS: dict[tuple[str, str], CallUnionRule] = {}
"""ET for rules that read the words 'TELQUEL' and 'NOER'."""


def union_with_call(*pairs: tuple[str, str]) -> Callable[[CallUnionRule], CallUnionRule]:
    """Decorator: what ET does on pairs of types, a function `(call, left, right)`.

    `call.used` holds the words read: 'TELQUEL' and 'NOER' are given by `union_words(call)`.
    """

    def add(entry: CallUnionRule) -> CallUnionRule:
        for pair in pairs:
            CALL_UNIONS[pair] = entry
        return entry

    return add


def union_words(call: Call) -> set[str]:
    """The words that stood with ET: 'TELQ', 'NOER'."""
    found: set[str] = set()
    while (said := call.keyword(("TELQ", "NOER"))) is not None:
        found.add(said)
    return found


def united(call: Call, left: Any, right: Any, span: Span) -> Any:
    """What ET makes of two objects.

    Raises
    ------
    SsiError
        'no-rule' when their types do not go together.
    """
    types = type_of(left), type_of(right)
    reading = CALL_UNIONS.get(types)
    if reading is not None:
        return reading(call, left, right)
    found = UNIONS.get(types) or UNIONS.get((types[0], "*")) or UNIONS.get(("*", types[1]))
    if found is None:
        raise SsiError("no-rule", span, operator="ET", left=types[0], right=types[1])
    return found(left, right)


def _unite(call: Call) -> Any:
    exact = call.keyword(("TELQ",)) is not None
    left = call.read("*")
    if left is not None and not call.operands and type_of(left.value) == "TABLE":
        return _unite_table(call, left.value)
    right = call.read("*") if left is not None else None
    if left is None or right is None:
        raise SsiError("two-operands", call.span, operator="ET")
    if exact and isinstance(left.value, str) and isinstance(right.value, str):
        return Mot(left.value + right.value)
    result = united(call, left.value, right.value, left.span.to(right.span))
    union_words(call)
    return result


def _unite_table(call: Call, table: Any) -> Any:
    values = [v for index, v in table.items() if type(index) is int]
    if not values:
        raise call.error("operators.tables.empty-table", table)
    total = values[0]
    if len(values) == 1:
        return total
    for value in values[1:]:
        total = united(call, total, value, call.span)
    return total


operator(
    "ET",
    flag("exact", "TELQ", en="words are joined with their blanks", fr="mots avec leurs blancs"),
    arg("first", en="object, or a table of objects", fr="objet, ou table d'objets"),
    opt("second", en="object joined to it", fr="objet qui s'y joint"),
    flag("merged", "NOER", en="doubles are no error", fr="les doublons ne sont pas une erreur"),
    gives=ANY,
    family="objects",
    help=Help(
        "Joins two objects: union of meshes, sum of matrices, concatenation of lists, logical and.",
        "Réunit deux objets : union de maillages, somme de rigidités, suite de listes, et logique.",
        "OBJ3 = OBJ1 ET OBJ2 ('NOER') ; OBJ3 = ET ('TELQUEL') OBJ1 OBJ2 ; OBJ2 = ET TAB1 ;",
        ("l = (PROG 1. 2.) ET 3. ; LIST l ;", "SI (VRAI ET FAUX) ; ERRE 5 ; FINSI ;"),
    ),
    reads_itself="the types of its operands, words too, choose a rule, which may read more",
)(_unite)

"""Operators that several families share: one name, forms by the type of an operand or by a word.

A family adds its forms with the decorator `form`; help texts add up.
"""

from ssilang.operators.prelude import *
from ssilang.operators.tables.soundness import other_values

EXTR = shared("EXTR", "objects", full_name="EXTRAIRE", terminal=True)
DIME = shared("DIME", "objects", full_name="DIMENSION")
ENLE = shared("ENLE", "objects", full_name="ENLEVER")
REDU = shared("REDU", "fields", full_name="REDUIRE")
MANU = shared("MANU", "objects", full_name="MANUEL", empties=False)
CHAN = shared("CHAN", "objects", full_name="CHANGER")
MAXI = shared("MAXI", "fields", full_name="MAXIMUM")
MINI = shared("MINI", "fields", full_name="MINIMUM")
COPI = shared("COPI", "objects", full_name="COPIER")
ORDO = shared("ORDO", "objects", full_name="ORDONNER")

COUL = shared("COUL", "objects", full_name="COULEUR")
INVE = shared("INVE", "objects", full_name="INVERSE")
UNIQ = shared("UNIQ", "objects", full_name="UNIQUE")
INTG = shared("INTG", "fields")
COMP = shared("COMP", "stress", full_name="COMPORTEMENT")

PSCA = shared("PSCA", "fields", full_name="PSCAL")
PVEC = shared("PVEC", "fields")
COOR = shared("COOR", "mesh", full_name="COORDONNEE")
DIFF = shared("DIFF", "objects", full_name="DIFFERENCE")
INTE = shared("INTE", "objects", full_name="INTERSECTION")

ListingEntry = Callable[[Any, bool, Teller], str]
LISTINGS: Filled[str, ListingEntry] = Filled("listings")
"""LIST: type -> function (value, whether in brief, what makes texts of codes)."""
listing = LISTINGS.entry
"""Decorator: how LIST prints objects of these types."""

UnionRule = Callable[[Any, Any], Any]
UNIONS: Filled[tuple[str, str], UnionRule] = Filled("unions")
"""ET: (left type, right type) -> function."""
union = UNIONS.entry
"""Decorator: what ET does on pairs of types."""

WordedUnionRule = Callable[[Collection[str], Any, Any], Any]
WORDED_UNIONS: Filled[tuple[str, str], WordedUnionRule] = Filled("unions with words")
"""ET for rules that heed the words 'TELQUEL' and 'NOER'."""
worded_union = WORDED_UNIONS.entry
"""Decorator: what ET does on pairs of types, a function `(words, left, right)`.

`words` are those of 'TELQ' and 'NOER' that stand with ET.
"""

WORDS_OF_UNION = ("TELQ", "NOER")
"""Words that may stand anywhere beside ET."""


def _words_of_union(call: Call) -> set[str]:
    """Words that stand with ET: before, between and behind objects, not in the place of words."""
    found: set[str] = set()
    values = [o.value for o in call.operands]
    words = [v for v in values if isinstance(v, str | ListMots)]
    objects = len(values) - len(words) >= 2 and not any(isinstance(v, ListMots) for v in words)
    while (said := call.keyword(WORDS_OF_UNION if objects else ("TELQ",))) is not None:
        found.add(said)
    return found


def joining(left: str, right: str) -> UnionRule | WordedUnionRule | None:
    """The rule by which ET joins objects of two types, None if they do not go together."""
    found = WORDED_UNIONS.get((left, right)) or UNIONS.get((left, right))
    return found or UNIONS.get((left, "*")) or UNIONS.get(("*", right))


def united(call: Call, left: Any, right: Any, span: Span, words: Collection[str] = ()) -> Any:
    """What ET makes of two objects, with the words that stand with it.

    Raises
    ------
    SsiError
        'no-rule' when their types do not go together.
    """
    types = type_of(left), type_of(right)
    found: Callable[..., Any] | None = joining(*types)
    if found is None:
        raise SsiError("no-rule", span, operator="ET", left=types[0], right=types[1])
    if types == ("MCHAML", "MCHAML") and (names := other_values(left, right)):
        told = {"operator": "ET", "names": sorted(names)}
        call.session.warn("operators.fields.components-twice", span, **told)
    return found(words, left, right) if types in WORDED_UNIONS else found(left, right)


@operator(
    "ET",
    flag("exact", "TELQ", en="words with their blanks, meshes in the order given"),
    arg("first", en="object, or a table or list of them"),
    opt("second", en="object joined to it"),
    flag("merged", "NOER", en="doubles are no error"),
    gives=ANY,
    family="objects",
    reads_itself="the types of its operands, words too, choose a rule, which may read more",
)
def _unite(call: Call) -> Any:
    words = _words_of_union(call)
    left = call.read("*")
    if left is not None and not call.operands and type_of(left.value) == "TABLE":
        return unite_all(call, left.value, [v for i, v in left.value.items() if type(i) is int])
    if left is not None and not call.operands and isinstance(left.value, ListObje):
        return unite_all(call, left.value, list(left.value.values))
    right = call.read("*") if left is not None else None
    if left is None or right is None:
        raise SsiError("two-operands", call.span, operator="ET")
    while (said := call.keyword(WORDS_OF_UNION)) is not None:
        words.add(said)
    if "TELQ" in words and isinstance(left.value, str) and isinstance(right.value, str):
        return Mot(left.value + right.value)
    if isinstance(left.value, bool) and isinstance(right.value, bool):
        return all([left.value, right.value, *call.all("LOGIQUE")])
    return united(call, left.value, right.value, left.span.to(right.span), words)


def unite_all(call: Call, holder: Any, values: list[Any]) -> Any:
    if not values:
        raise call.error("operators.tables.empty-table", holder)
    return reduce(lambda total, value: united(call, total, value, call.span), values)

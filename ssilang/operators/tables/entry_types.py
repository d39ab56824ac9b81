"""ZENT: procedures of the library check the entries of their tables before they use them."""

from __future__ import annotations

from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.tables.entries import Entries


@operator(
    "ZENT",
    family="tables",
    help=Help(
        en="Checks entries of a table for a procedure of the library: its name for messages, then "
        "each index with its type, or types with / between, ? in front where it may be missing.",
        fr="Contrôle les entrées d'une table pour une procédure de la bibliothèque : son nom pour "
        "les messages, puis chaque indice et son type, ou des types séparés par /, précédés de ? "
        "si l'entrée est facultative.",
        syntax="ZENT TAB1 MOT1 (INDICE1 MOT2 INDICE3 MOT4 ...) ;",
        examples=(
            "T1 = TABL ; T1 . 'DUREE' = 3. ; "
            "ZENT T1 'SPPLANC' 'DUREE' 'FLOTTANT' 'ENVE' '?MOT' ; LIST (T1 . 'DUREE') ;",
        ),
    ),
    reads_itself=True,
)
def zent(call: Call) -> None:
    """Refuse a table that a procedure cannot use, naming the entry and what it must be."""
    entries = Entries(call, call.required("TABLE"), str(call.required("MOT")))
    while (index := call.optional("MOT", "ENTIER")) is not None:
        said = str(call.required("MOT"))
        types = said.lstrip("?").split("/")
        at = index if isinstance(index, int) else str(index)
        if said.startswith("?"):
            entries.get(at, *types)
        else:
            entries.needed(at, *types)

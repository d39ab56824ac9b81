"""What to do where a slip shows the habit of another language, or a usual misunderstanding."""

from __future__ import annotations

import re
from collections.abc import Mapping

_CONDITION = (
    "a condition is written SI (A > 3) ; ... SINON ; ... FINSI ;",
    "une condition s'écrit SI (A > 3) ; ... SINON ; ... FINSI ;",
)
_LOOP = (
    "a loop is written REPE LOOP1 10 ; ... FIN LOOP1 ; &LOOP1 counts its turns",
    "une boucle s'écrit REPE TOUR1 10 ; ... FIN TOUR1 ; &TOUR1 compte ses tours",
)
_LEAVING = (
    "a loop is left by QUIT LOOP1 ; ITER LOOP1 ; goes to its next turn",
    "on sort d'une boucle par QUIT TOUR1 ; ITER TOUR1 ; passe au tour suivant",
)
_PRINT = ("printing is written MESS 'A is ' A ;", "un affichage s'écrit MESS 'A vaut ' A ;")
_PROCEDURE = (
    "a procedure is written DEBP NAME A*FLOTTANT ; ... FINP B ;",
    "une procédure s'écrit DEBP NOM A*FLOTTANT ; ... FINP B ;",
)
_TRUTH = (
    "these values are VRAI and FAUX; A ET B, A OU B, NON A combine them",
    "ces valeurs sont VRAI et FAUX ; A ET B, A OU B, NON A les combinent",
)
_COMMENT = (
    "a comment is a line whose first character is *",
    "un commentaire est une ligne dont le premier caractère est *",
)
_ITEM = (
    "an item of a list is EXTR LIST1 3, of a table TAB1 . 3",
    "un élément d'une liste est EXTR LIST1 3, d'une table TAB1 . 3",
)

FOREIGN: Mapping[str, tuple[str, str]] = {
    **dict.fromkeys(("IF", "ELSE", "ELSEIF", "ELIF", "ENDIF", "THEN", "SWITCH"), _CONDITION),
    **dict.fromkeys(("FOR", "WHILE", "DO", "ENDFOR", "ENDDO", "FOREACH", "POUR"), _LOOP),
    **dict.fromkeys(("BREAK", "CONTINUE"), _LEAVING),
    **dict.fromkeys(("PRINT", "PRINTF", "DISP", "PUTS", "WRITE", "ECHO"), _PRINT),
    **dict.fromkeys(("FUNCTION", "DEF", "PROC", "RETURN", "SUBROUTINE"), _PROCEDURE),
    **dict.fromkeys(("TRUE", "FALSE"), _TRUTH),
}
"""Words of other languages, with how what they mean is written (English, French)."""


def _in(language: str, sentences: tuple[str, str]) -> str:
    return sentences[0] if language == "en" else sentences[1]


def foreign_hint(word: str, language: str) -> str:
    """What to write for a word of another language, '' if it is none."""
    if re.search(r"[\[\]{}]", word):
        return _in(language, _ITEM)
    if word[:1] == "#" or word[:2] == "//":
        return _in(language, _COMMENT)
    sentences = FOREIGN.get(word.upper())
    return _in(language, sentences) if sentences else ""


def comment_hint(text: str, language: str) -> str:
    """For a statement that begins as comments of other languages do, '' for others."""
    return _in(language, _COMMENT) if re.match(r"\s*(#|//|!|%|\"\"\"|--|/)", text) else ""


_EXCESS = {
    "order": (
        "a phrase runs from left to right: put parentheses around what belongs together",
        "une phrase va de gauche à droite : mettez entre parenthèses ce qui va ensemble",
    ),
    "numbers": (
        "numbers side by side make a POINT where OPTI DIME 2 (or 3) was set and there are as many",
        "des nombres côte à côte font un POINT si OPTI DIME 2 (ou 3) le précède et qu'il y en a "
        "autant",
    ),
    "parentheses": (
        "operands stand behind their operator, without parentheses around them all: {0} A B ;",
        "les opérandes suivent leur opérateur, sans parenthèses autour de tous : {0} A B ;",
    ),
}


def excess_hint(data: Mapping[str, object], language: str) -> str:
    """What to do about an operand that nothing reads."""
    begins = foreign_hint(str(data.get("begins", "")), language)
    text = _in(language, _EXCESS.get(str(data.get("kind")), _EXCESS["order"]))
    return begins or text.format(data.get("caller", ""))


def no_result_hint(data: Mapping[str, object], language: str) -> str:
    """What to do about a name on the left of = that gets nothing."""
    count = int(str(data.get("count", 1)))
    if count == 1:
        return {
            "en": "what stands on the right of = gives no result; a procedure gives what stands "
            "behind its FINP",
            "fr": "ce qui est à droite de = ne donne aucun résultat ; une procédure donne ce qui "
            "suit son FINP",
        }[language]
    return {
        "en": f"{count} names stand on the left of =, the right side gives fewer results",
        "fr": f"{count} noms sont à gauche de =, la partie droite donne moins de résultats",
    }[language]


def not_a_table_hint(data: Mapping[str, object], language: str) -> str:
    """What to do about an index of something that has none."""
    name = data.get("name")
    if str(data.get("found")).startswith("LIST"):
        return {
            "en": f"an item of a list is taken by EXTR: EXTR {name} 1",
            "fr": f"un élément d'une liste se prend par EXTR : EXTR {name} 1",
        }[language]
    return {
        "en": "only a TABLE (made by TABL) and an OBJET have indices; was "
        f"{name} given another value?",
        "fr": f"seuls une TABLE (créée par TABL) et un OBJET ont des indices ; {name} a-t-il "
        "changé ?",
    }[language]


def word_hint(name: str, language: str) -> str:
    """For an object that stands where a word was wanted, which its name may have been meant as."""
    return {
        "en": f"{name} has a value here: the word {name} is written between quotes, '{name}'\n",
        "fr": f"{name} a ici une valeur : le mot {name} s'écrit entre apostrophes, '{name}'\n",
    }[language]

"""What ssilang/operators/drawing refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "empty-shape": Message(
        "the deformed shape is empty: it has no amplification",
        "la déformée est vide : elle n'a pas d'amplification",
    ),
    "no-colour-no-place": Message(
        "'{said}' is neither a colour nor one of {places:words}",
        "'{said}' n'est ni une couleur ni l'un de {places:words}",
    ),
    "colour-number": Message(
        "colours have the numbers 1 to {count}, not {given}",
        "les couleurs ont les numéros 1 à {count}, pas {given}",
    ),
    "colour-count": Message(
        "{n_colours} {n_colours:colour|colours} for {n_parts} {n_parts:part|parts}",
        "{n_colours} {n_colours:couleur|couleurs} pour {n_parts} {n_parts:partie|parties}",
    ),
    "equal-bounds": Message(
        "the bounds are both {low:g}",
        "les deux bornes valent {low:g}",
    ),
    "whole-number-wanted": Message(
        "INITIAL and FINAL hold whole numbers, curve {n} has {value!r}",
        "INITIAL et FINAL contiennent des entiers, la courbe {n} a {value!r}",
    ),
    "format-of-powers": Message(
        "{word} does not go with {scale}",
        "{word} ne va pas avec {scale}",
        "a logarithmic axis is marked by powers of ten",
        "un axe logarithmique est gradué en puissances de dix",
    ),
    "view-without-plane": Message(
        "DIRE turns the picture after the plane of COUP, and none is given",
        "DIRE tourne l'image d'après le plan de COUP, et aucun n'est donné",
        "'DIRE' 'COUP' P1 P2 P3: one looks from the eye at P1, P1 P2 goes upwards",
        "'DIRE' 'COUP' P1 P2 P3 : on regarde P1 depuis l'oeil, P1 P2 va vers le haut",
    ),
    "view-in-the-plane": Message(
        "DIRE turns a view in space: a picture in the plane has none",
        "DIRE tourne une vue dans l'espace : une image plane n'en a pas",
    ),
    "portion": Message(
        "curve {n} has points 1 to {n_points}: INITIAL and FINAL say {first} to {last}",
        "la courbe {n} a les points 1 à {n_points} : INITIAL et FINAL disent {first} à {last}",
    ),
    "dashes-list": Message(
        "LIGNE_VARIABLE holds a LISTENTI for each curve, curve {n} has {found}",
        "LIGNE_VARIABLE contient un LISTENTI par courbe, la courbe {n} a {found}",
    ),
    "dashes-count": Message(
        "LIGNE_VARIABLE gives {count} {count:dash|dashes} for the {wanted} "
        "{wanted:segment|segments} of curve {n}",
        "LIGNE_VARIABLE donne {count} {count:tiret|tirets} pour {wanted} "
        "{wanted:segment|segments} de la courbe {n}",
        "one for each segment, of the whole curve: its points less one",
        "un par segment, de la courbe entière : ses points moins un",
    ),
    "dashes-code": Message(
        "LIGNE_VARIABLE of curve {n} holds {code}",
        "LIGNE_VARIABLE de la courbe {n} contient {code}",
        "0 to {last}: full, TIRR, TIRC, TIRL, TIRM, POIN",
        "0 à {last} : continue, TIRR, TIRC, TIRL, TIRM, POIN",
    ),
    "word-beside-another": Message(
        "'{said}' stands twice, or beside another word that excludes it",
        "'{said}' figure deux fois, ou à côté d'un autre mot qui l'exclut",
    ),
    "component-missing": Message(
        "the field has none of {columns:words}",
        "le champ n'a aucune de ces composantes : {columns:words}",
        "it has {known}",
        "il a {known}",
    ),
    "unknown-word": Message(
        "{operator} does not know the word '{said}'",
        "{operator} ne connaît pas le mot '{said}'",
        "{near:?did you mean {near}?|its words are {words:words}}",
        "{near:?vouliez-vous dire {near} ?|ses mots sont {words:words}}",
    ),
    "useless-operand": Message(
        "{operator} has no use for this {found}",
        "{operator} ne prend pas ici d'objet {found}",
    ),
}

"""What ssilang/operators/numbers refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "word-and-number": Message(
        "the word {word} is compared with a number: they differ",
        "le mot {word} est comparé à un nombre : ils diffèrent",
        "a name that was never assigned is a word",
        "un nom jamais affecté est un mot",
        severity="warning",
    ),
    "two-of-one-kind": Message(
        "ATG of two objects needs two of the same kind",
        "ATG de deux objets en demande deux de même type",
    ),
    "exp-too-large": Message(
        "EXP of {x:g} is larger than any number that can be held",
        "EXP de {x:g} dépasse tout nombre représentable",
    ),
    "argument-above": Message(
        "{name} of {worst:g}: the argument must be above {low:g}",
        "{name} de {worst:g} : l'argument doit être supérieur à {low:g}",
    ),
    "argument-at-least": Message(
        "{name} of {worst:g}: the argument must be at least {low:g}",
        "{name} de {worst:g} : l'argument doit être au moins {low:g}",
    ),
    "argument-between": Message(
        "{name} of {worst:g}: the argument must be between {low:g} and {high:g}",
        "{name} de {worst:g} : l'argument doit être entre {low:g} et {high:g}",
    ),
    "list-lengths": Message(
        "the lists have {n_first} and {n_second} {n_second:item|items}",
        "les listes ont {n_first} et {n_second} {n_second:valeur|valeurs}",
    ),
    "fields-on-other-cells": Message(
        "the two fields do not stand on the same cells",
        "les deux champs ne portent pas sur les mêmes éléments",
    ),
    "integer-too-large": Message(
        "a value is too large for an integer",
        "une valeur est trop grande pour un entier",
    ),
    "list-integer-too-large": Message(
        "a result is too large for a list of integers, whose items have 64 bits",
        "un résultat est trop grand pour une liste d'entiers, dont les valeurs ont 64 bits",
    ),
    "list-not-finite": Message(
        "{sign} makes {count} {count:item|items} of the list infinite or no "
        "{count:number|numbers}, the first is item {item}: {value:g}",
        "{sign} rend {count} {count:valeur|valeurs} de la liste {count:infinie|infinies} ou "
        "indéfinie{count:|s}, la première est la valeur {item} : {value:g}",
        "a list was divided by zero; see MASQ and BORN",
        "une liste a été divisée par zéro ; voir MASQ et BORN",
        severity="warning",
    ),
    "negative-width": Message(
        "the width of a law is not negative, this one is {width:g}",
        "la largeur d'une loi n'est pas négative, celle-ci vaut {width:g}",
    ),
    "negative-count": Message(
        "the number of values is not negative, this one is {where}",
        "le nombre de valeurs n'est pas négatif, celui-ci vaut {where}",
    ),
    "not-number": Message(
        "'{word}' is not a number",
        "'{word}' n'est pas un nombre",
    ),
    "no-such-curve": Message(
        "there {n_parts:is|are} {n_parts} {n_parts:curve|curves}, none of number {place}",
        "il y a {n_parts} {n_parts:courbe|courbes}, aucune de numéro {place}",
    ),
    "which-component": Message(
        "which component?",
        "quelle composante ?",
        "components are {names:words}",
        "les composantes sont {names:words}",
    ),
    "negative-skip": Message(
        "the generator skips a number of terms, found {skip}",
        "le générateur saute un nombre de termes positif ou nul, trouvé {skip}",
    ),
    "not-third-degree": Message(
        "the polynomial is not of the third degree: A3 is 0",
        "le polynôme n'est pas du troisième degré : A3 est nul",
        "RACP takes any",
        "RACP prend tous les degrés",
    ),
    "constant-polynomial": Message(
        "the polynomial is constant: it has no roots, or all numbers",
        "le polynôme est constant : il n'a aucune racine, ou tout nombre l'est",
    ),
}

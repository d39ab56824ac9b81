"""What ssilang/operators/files refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-whole-number": Message(
        "{name}, line {line}: {value} is no whole number",
        "{name}, ligne {line} : {value} n'est pas un nombre entier",
    ),
    "all-lines-read": Message(
        "{name} has only {n_lines} {n_lines:line|lines}, all have been read",
        "{name} n'a que {n_lines} {n_lines:ligne|lignes}, toutes ont été lues",
    ),
    "no-number": Message(
        "{name}, line {line}: '{item}' is no number",
        "{name}, ligne {line} : '{item}' n'est pas un nombre",
    ),
    "no-name-with-type": Message(
        "ACQU wants names, each with *TYPE",
        "ACQU veut des noms, chacun avec *TYPE",
    ),
    "type-not-read": Message(
        "'{kind}' cannot be read from a file",
        "'{kind}' ne se lit pas dans un fichier",
        "types are {types}",
        "les types sont {types}",
    ),
    "size-missing": Message(
        "the number of values must follow {name}*{kind}",
        "le nombre de valeurs doit suivre {name}*{kind}",
    ),
    "figure-not-finite": Message(
        "a figure, what is expected of it and its tolerance are finite numbers: this of '{name}' "
        "is none",
        "un résultat, ce qu'on en attend et sa tolérance sont des nombres finis : celui-ci de "
        "'{name}' n'en est pas un",
        "look for what was divided by zero, or grew without bound",
        "cherchez ce qui a été divisé par zéro, ou a grandi sans borne",
    ),
    "record-without-unit": Message(
        "the record names no unit that is known: its values are read as they are",
        "l'enregistrement ne nomme pas d'unité connue : ses valeurs sont lues telles quelles",
        "LIRE '{kind}' '{file}' 9.81 if it is in g, 0.01 in cm/s2, 1. in m/s2",
        "LIRE '{kind}' '{file}' 9.81 s'il est en g, 0.01 en cm/s2, 1. en m/s2",
        severity="warning",
    ),
    "record-not-in-si": Message(
        "the record is in {unit}, and no factor makes metres and seconds of it: its values are "
        "read as they are",
        "l'enregistrement est en {unit}, et aucun facteur n'en fait des mètres et des secondes : "
        "ses valeurs sont lues telles quelles",
        "LIRE '{kind}' '{file}' 'SI' (times {factor:g}); LIRE '{kind}' '{file}' 1. to have it so",
        "LIRE '{kind}' '{file}' 'SI' (fois {factor:g}) ; LIRE '{kind}' '{file}' 1. pour l'avoir "
        "ainsi",
    ),
    "record-longer": Message(
        "'{file}' says that it has {count} {count:value|values}: the {left_out} behind "
        "{left_out:it is|them are} left out",
        "'{file}' dit avoir {count} {count:valeur|valeurs} : {left_out:celle qui suit est omise|"
        "les {left_out} qui suivent sont omises}",
        "where they belong to the record, the head must say so (NPTS)",
        "si elles font partie de l'enregistrement, l'en-tête doit le dire (NPTS)",
        severity="warning",
    ),
    "mesh-without-cells": Message(
        "{name} holds {count} {count:node|nodes} and no cell: the mesh is empty",
        "{name} contient {count} {count:noeud|noeuds} et aucun élément : le maillage est vide",
        "is the file cut? Its last lines should be elements, and what ends the format",
        "le fichier est-il tronqué ? Ses dernières lignes devraient être des éléments, et ce qui "
        "termine le format",
        severity="warning",
    ),
    "factor-and-si": Message(
        "a factor and 'SI' stand together: one of them makes the values",
        "un facteur et 'SI' sont donnés ensemble : l'un des deux fait les valeurs",
    ),
    "si-without-unit": Message(
        "{units:?no factor to SI is known of the unit {units}|the record names no unit}",
        "{units:?aucun facteur vers le SI n'est connu de l'unité {units}|l'enregistrement ne nomme "
        "pas d'unité}",
        "give the factor: LIRE '{kind}' '{file}' 9.81 if it is in g, 0.01 in cm/s2, 1. in m/s2",
        "donner le facteur : LIRE '{kind}' '{file}' 9.81 s'il est en g, 0.01 en cm/s2, 1. en m/s2",
    ),
    "record-in-other-units": Message(
        "the record is read in {unit}, the deck is in {system} (OPTI 'UNIT'): {needed}",
        "l'enregistrement est lu en {unit}, le jeu de données est en {system} (OPTI 'UNIT') : "
        "{needed}",
        "multiply it by {factor:g}",
        "le multiplier par {factor:g}",
        severity="warning",
    ),
    "no-such-channel": Message(
        "the file has {count} {count:record|records}",
        "le fichier a {count} {count:signal|signaux}",
        "CANAL counts from 1",
        "CANAL compte à partir de 1",
    ),
    "several-channels": Message(
        "{file} has {count} records: the first is read",
        "{file} a {count} signaux : le premier est lu",
        "'CANAL' N1 names another, 'CANAL' 1 this one",
        "'CANAL' N1 en nomme un autre, 'CANAL' 1 celui-ci",
        severity="warning",
    ),
    "no-such-format": Message(
        "'{word}' is no format that LIRE reads{near:?; did you mean '{near}'?}",
        "'{word}' n'est pas un format que lit LIRE{near:? ; vouliez-vous dire '{near}' ?}",
        "LIRE 'MESH' '...' reads meshes by the ending of the file; words are {known:words}",
        "LIRE 'MESH' '...' lit les maillages selon la fin du nom du fichier ; les mots sont "
        "{known:words}",
    ),
    "no-such-ending": Message(
        "{ending:?no mesh is known by the ending '{ending}'|the file's name has no ending that "
        "tells its format}{near:?; did you mean '{near}'?}",
        "{ending:?aucun maillage ne se reconnaît à la fin '{ending}'|le nom du fichier n'a pas de "
        "fin qui dise son format}{near:? ; vouliez-vous dire '{near}' ?}",
        "endings that are read: {endings:words}; or say the format: LIRE 'GMSH' '...'",
        "fins qui se lisent : {endings:words} ; ou dites le format : LIRE 'GMSH' '...'",
    ),
    "reader-says": Message(
        "{name}: its reader says: {remark}",
        "{name} : son lecteur dit : {remark}",
        severity="warning",
    ),
    "cells-left-out": Message(
        "{name}: cells without a counterpart here are left out: {told}",
        "{name} : des éléments sans équivalent ici sont omis : {told}",
        "the mesh has holes where they were; write it with other elements",
        "le maillage est troué à leur place ; l'écrire avec d'autres éléments",
        severity="warning",
    ),
    "cells-collapsed": Message(
        "{name}: {count} {count:cell has|cells have} nodes that coincide{left:?; {left} of them "
        "{left:stays as it is|stay as they are}|; simpler ones take their place}",
        "{name} : {count} {count:élément a|éléments ont} des noeuds confondus{left:? ; {left} "
        "d'entre eux {left:reste tel quel|restent tels quels}| ; de plus simples les remplacent}",
        severity="warning",
    ),
    "mesh-not-of-dimension": Message(
        "{name}: {count} {count:node has|nodes have} a coordinate beyond the {dimension} of OPTI "
        "DIME",
        "{name} : {count} {count:noeud a|noeuds ont} une coordonnée au-delà des {dimension} d'OPTI "
        "DIME",
        "OPTI DIME 3, or a mesh whose other coordinates are 0",
        "OPTI DIME 3, ou un maillage dont les autres coordonnées sont 0",
    ),
    "format-not-written": Message(
        "'{word}' is no format of meshes that SORT writes{near:?; did you mean '{near}'?}",
        "'{word}' n'est pas un format de maillage qu'écrit SORT{near:? ; vouliez-vous dire "
        "'{near}' ?}",
        "words are {known:words}",
        "les mots sont {known:words}",
    ),
    "ending-not-written": Message(
        "SORT 'MESH' writes no file '{name}'",
        "SORT 'MESH' n'écrit pas de fichier '{name}'",
        "{word:?SORT '{word}' writes that|endings that it writes: {endings:words}}",
        "{word:?SORT '{word}' écrit cela|fins qu'il écrit : {endings:words}}",
    ),
    "joints-not-written": Message(
        "{count} {count:joint is|joints are} left out: other programs have no such cells",
        "{count} {count:joint est omis|joints sont omis} : les autres programmes n'ont pas de tels "
        "éléments",
        "make them again with RACC behind LIRE, of the two sides",
        "refaites-les par RACC après LIRE, à partir des deux côtés",
        severity="warning",
    ),
    "not-of-one-file": Message(
        "'{word}' is for .vtu files, 'VTKHDF' asks for one .vtkhdf file, which is packed, begins "
        "anew with each run and needs no list",
        "'{word}' vaut pour les fichiers .vtu, 'VTKHDF' demande un fichier .vtkhdf, qui est "
        "compressé, recommence à chaque calcul et se passe de liste",
        "leave '{word}' out, or take 'VTU'",
        "ôtez '{word}', ou prenez 'VTU'",
    ),
    "no-such-procedure": Message(
        "{name} defines no procedure {wanted}",
        "{name} ne définit pas de procédure {wanted}",
        "it defines {found}",
        "il définit {found}",
    ),
    "all-structures-read": Message(
        "{name} holds {done} {done:structure|structures}, all have been read",
        "{name} contient {done} {done:structure|structures}, toutes ont été lues",
    ),
    "other-units": Message(
        "{name} was saved in {saved}, and the deck is in {present}: no number is converted",
        "{name} a été sauvé en {saved} et le jeu de données est en {present} : aucun nombre n'est "
        "converti",
        "OPTI 'UNIT' '{saved}' before REST, or other objects",
        "OPTI 'UNIT' '{saved}' avant REST, ou d'autres objets",
    ),
    "no-such-label": Message(
        "{name} has no record labelled '{label}'",
        "{name} n'a pas d'enregistrement de label '{label}'",
        "its labels are: {known}",
        "ses labels sont : {known}",
    ),
    "no-object-to-save": Message(
        "there is no object '{value}' to save",
        "il n'y a pas d'objet '{value}' à sauver",
    ),
    "positive-number": Message(
        "{said} wants a positive number, not {n}",
        "{said} veut un nombre positif, pas {n}",
    ),
    "only-matrix-market": Message(
        "only 'MM' 'ASSE' is supported, the assembled matrix as Matrix Market text",
        "seul 'MM' 'ASSE' existe, la matrice assemblée en texte Matrix Market",
    ),
    "no-such-mesh": Message(
        "{name} holds no mesh '{wanted}'",
        "{name} ne contient pas de maillage '{wanted}'",
        "it holds {known}",
        "il contient {known}",
    ),
}

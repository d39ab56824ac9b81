"""What ssilang/operators/texts refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "format-without-brackets": Message(
        "'{text}' is not a format: it stands between parentheses",
        "'{text}' n'est pas un format : un format est entre parenthèses",
        "for example 'FORMAT' '(F8.3)'",
        "par exemple 'FORMAT' '(F8.3)'",
    ),
    "bad-format": Message(
        "'{text}' is not a format that can be read",
        "'{text}' n'est pas un format lisible",
        "for example '(1PE12.5)'",
        "par exemple '(1PE12.5)'",
    ),
    "unknown-type": Message(
        "'{kind}' is no type",
        "'{kind}' n'est pas un type",
        "{known_types:words}",
        "{known_types:words}",
    ),
    "characters-beyond-end": Message(
        "'{word}' has {size} {size:character|characters}, {first} to {last} are not in it",
        "'{word}' a {size} {size:caractère|caractères}, {first} à {last} n'y sont pas",
    ),
    "no-such-character": Message(
        "'{word}' has {size} {size:character|characters}, none at place {place}",
        "'{word}' a {size} {size:caractère|caractères}, aucun à la place {place}",
    ),
    "unknown-type-named": Message(
        "'{kind}' is no type",
        "'{kind}' n'est pas un type",
        "types are {known_types:words}",
        "les types sont {known_types:words}",
    ),
    "blank-lines": Message(
        "SAUT prints 0 to {most} blank lines, not {found}",
        "SAUT imprime de 0 à {most} lignes vides, pas {found}",
    ),
    # ---- numbers of ERRE
    "out-of-tolerance": Message(
        "the deck found a result out of tolerance{said:?: {said}}",
        "le jeu de données a trouvé un écart{said:? : {said}}",
    ),
    "no-memory": Message(
        "not enough memory{said:?: {said}}", "mémoire insuffisante{said:? : {said}}"
    ),
    "incompatible-data": Message(
        "incompatible data{said:?: {said}}", "données incompatibles{said:? : {said}}"
    ),
    "not-foreseen": Message(
        "this operation is not foreseen{said:?: {said}}", "opération non prévue{said:? : {said}}"
    ),
    "not-implemented": Message(
        "this task is not implemented{said:?: {said}}", "tâche non implémentée{said:? : {said}}"
    ),
    "missing-object": Message(
        "an object is missing{said:?: {said}}", "il manque un objet{said:? : {said}}"
    ),
    "no-convergence": Message(
        "the calculation does not converge{said:?: {said}}",
        "le calcul ne converge pas{said:? : {said}}",
    ),
    "forbidden-operation": Message(
        "an attempt at a forbidden operation{said:?: {said}}",
        "tentative d'opération interdite{said:? : {said}}",
    ),
    "wrong-sub-type": Message(
        "the object has not the right sub-type{said:?: {said}}",
        "l'objet n'a pas le bon sous-type{said:? : {said}}",
    ),
    "deck-stops": Message(
        "the deck stops{said:?: {said}}", "le jeu de données s'arrête{said:? : {said}}"
    ),
    # ---- what is printed
    "integer": Message("Integer of value: {value}", "Entier valant : {value}"),
    "real": Message("Real of value: {value}", "Réel valant : {value}"),
    "logical": Message("Logical of value: {value}", "Logique valant : {value}"),
    "word": Message(
        "Word of {length} {length:character|characters}: {text}",
        "Mot de {length} {length:caractère|caractères} : {text}",
    ),
    "text": Message("Text: {text}", "Texte : {text}"),
    "reals": Message(
        "List of {count} {count:real|reals}{full:?:}",
        "Liste de {count} {count:réel|réels}{full:? :}",
    ),
    "integers": Message(
        "List of {count} {count:integer|integers}{full:?:}",
        "Liste de {count} {count:entier|entiers}{full:? :}",
    ),
    "words": Message(
        "List of {count} {count:word|words}{full:?:}", "Liste de {count} {count:mot|mots}{full:? :}"
    ),
    "objects": Message(
        "List of {count} {count:object|objects}{kind:? of type {kind}}",
        "Liste de {count} {count:objet|objets}{kind:? de type {kind}}",
    ),
    "items": Message("{count} {count:item|items}", "{count} {count:élément|éléments}"),
    "table": Message(
        "Table of {count} {count:index|indices}", "Table de {count} {count:indice|indices}"
    ),
    "table-index": Message("index: type and value", "indice : type et valeur"),
    "table-object": Message("object: type and value", "objet : type et valeur"),
    "object": Message("Object of class {name}", "Objet de classe {name}"),
    "attribute": Message("  element {name:<24}", "  élément {name:<24}"),
    "method": Message("  method {name}", "  méthode {name}"),
    "procedure": Message(
        "Procedure {name} ({origin}), {count} {count:line|lines}",
        "Procédure {name} ({origin}), {count} {count:ligne|lignes}",
    ),
    "curves": Message(
        "Evolution of {count} {count:curve|curves}{title:?, title: {title}}",
        "Évolution de {count} {count:courbe|courbes}{title:?, titre : {title}}",
    ),
    "curve": Message(
        "  curve {number} of type {kind}, colour {colour}, {count} {count:point|points}"
        "{legend:?, legend: {legend}}",
        "  courbe {number} de type {kind}, couleur {colour}, {count} {count:point|points}"
        "{legend:?, légende : {legend}}",
    ),
    "abscissa": Message("abscissa", "abscisse"),
    "ordinate": Message("ordinate", "ordonnée"),
    "lines-left-out": Message(
        "   ... {count} {count:line|lines} ...", "   ... {count} {count:ligne|lignes} ..."
    ),
    "node-field": Message(
        "Field at points, {n_nodes} {n_nodes:node|nodes}, {n_names} "
        "{n_names:component|components}, nature {nature}",
        "Champ par points, {n_nodes} {n_nodes:noeud|noeuds}, {n_names} "
        "{n_names:composante|composantes}, nature {nature}",
    ),
    "title-line": Message("  title: {title}", "  titre : {title}"),
    "extremes": Message("  {name:<8} from {low} to {high}", "  {name:<8} de {low} à {high}"),
    "node": Message("node", "noeud"),
    "load": Message(
        "Loading of {count} {count:part|parts}", "Chargement de {count} {count:partie|parties}"
    ),
    "load-of-steps": Message(
        "{count} {count:instant|instants} from {first:g} to {last:g}",
        "{count} {count:instant|instants} de {first:g} à {last:g}",
    ),
    "constant-load": Message("{kind}, constant", "{kind}, constant"),
    "load-in-time": Message(
        "{kind} times a curve from {first:g} to {last:g}",
        "{kind} fois une évolution de {first:g} à {last:g}",
    ),
    "undefined": Message("Object without value (ANNULE)", "Objet non défini (ANNULE)"),
    "of-type": Message("Object of type {kind}", "Objet de type {kind}"),
    "named": Message(
        "{count} named {count:object|objects}{kind:? of type {kind}}",
        "{count} {count:objet nommé|objets nommés}{kind:? de type {kind}}",
    ),
}

"""What ssilang/operators/lists refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-number-in-table": Message(
        "index {index} of the table holds no number but an object of type {found}",
        "l'indice {index} de la table ne porte pas un nombre mais un objet de type {found}",
    ),
    "no-list-in-table": Message(
        "the table holds no list of numbers or words",
        "la table ne contient aucune liste de nombres ou de mots",
    ),
    "no-place-to-insert": Message(
        "the list has {n_value} {n_value:item|items}, nothing goes to place {place}",
        "la liste a {n_value} {n_value:élément|éléments}, rien ne se met au rang {place}",
    ),
    "places-and-items": Message(
        "{n_places} {n_places:place|places} for {n_items} {n_items:item|items}",
        "{n_places} {n_places:rang|rangs} pour {n_items} {n_items:élément|éléments}",
    ),
    "words-to-replace": Message(
        "{n_olds} {n_olds:word|words} to replace by {n_news}",
        "{n_olds} {n_olds:mot|mots} à remplacer par {n_news}",
    ),
    "objects-of-one-type": Message(
        "the objects of a list are of one type, here {kinds:and}",
        "les objets d'une liste sont d'un seul type, ici {kinds:and}",
    ),
    "parameters-and-derivatives": Message(
        "{n_parameters} {n_parameters:parameter|parameters} for {n_derivatives} "
        "{n_derivatives:list|lists} of derivatives",
        "{n_parameters} {n_parameters:paramètre|paramètres} pour {n_derivatives} "
        "{n_derivatives:liste|listes} de dérivées",
        "give the derivative by each parameter, in their order",
        "donnez la dérivée par rapport à chaque paramètre, dans leur ordre",
    ),
    "one-value-a-point": Message(
        "the list has {found} {found:value|values}, {count} are wanted here",
        "la liste a {found} {found:valeur|valeurs}, il en faut {count} ici",
    ),
    "values-and-derivatives": Message(
        "the procedure does not give two lists of reals",
        "la procédure ne rend pas deux listes de réels",
        "it gives the values, then their derivatives by the parameters, point after point",
        "elle rend les valeurs, puis leurs dérivées par rapport aux paramètres, point après point",
    ),
    "gauss-newton-matrices": Message(
        "GANE {word}: the matrix and the right-hand side are not available as objects",
        "GANE {word} : la matrice et le second membre ne sont pas disponibles en objets",
        "without {word}, GANE gives the solution of that system",
        "sans {word}, GANE donne la solution de ce système",
    ),
    "no-derivatives": Message(
        "the table has no values at 0 and derivatives at 1, 2 ...",
        "la table n'a pas de valeurs en 0 et de dérivées en 1, 2 ...",
    ),
    "no-scalar-product": Message(
        "the table holds values and derivatives of different types",
        "la table contient des valeurs et des dérivées de types différents",
        "numbers, lists of reals or nodal fields, all of one type",
        "des nombres, des listes de réels ou des champs par points, tous d'un même type",
    ),
    "point-out-of-bounds": Message(
        "the point VX0 is not between VXMIN and VXMAX",
        "le point VX0 n'est pas entre VXMIN et VXMAX",
    ),
    "no-such-method": Message(
        "EXCE: METHODE is {methods:or}, not {method}",
        "EXCE : METHODE est {methods:or}, pas {method}",
    ),
    "setting-out-of-range": Message(
        "'{index}' is a number between {low:g} and {high:g}",
        "'{index}' est un nombre entre {low:g} et {high:g}",
    ),
    "numbers-in-entry": Message(
        "'{index}' holds {found} {found:number|numbers} one after the other, {count} are wanted",
        "'{index}' contient {found} {found:nombre|nombres} à la suite, il en faut {count}",
    ),
    "no-such-place": Message(
        "the list has {size} {size:item|items}, there is none at place {place}",
        "la liste a {size} {size:élément|éléments}, il n'y en a pas au rang {place}",
    ),
    "components-differ": Message(
        "the fields have not the same components",
        "les champs n'ont pas les mêmes composantes",
        "name the one wanted",
        "nommez celle que vous voulez",
    ),
    "no-single-point": Message(
        "the fields stand on {count} points",
        "les champs s'appuient sur {count} points",
        "name the point: EXTR LCHP1 'VALE' POIN1",
        "nommez le point : EXTR LCHP1 'VALE' POIN1",
    ),
    "empty-word": Message(
        "an empty word cannot be replaced",
        "un mot vide ne se remplace pas",
    ),
    "too-long": Message(
        "a list or word of {count:.4g} items is too long, the limit is {longest}",
        "une liste ou un mot de {count:.4g} éléments est trop long, la limite est {longest}",
        "look for a step that is too small or a count that is too large",
        "cherchez un pas trop petit ou un nombre trop grand",
    ),
    "repetition-count": Message(
        "an item is repeated a whole number of times, not {count}",
        "un élément se répète un nombre entier de fois, pas {count}",
    ),
    "steps-miss-end": Message(
        "steps of {step} do not lead from {start} to {end}",
        "des pas de {step} ne mènent pas de {start} à {end}",
        "LECT wants a step that divides the distance",
        "LECT veut un pas qui divise la distance",
    ),
    "steps-not-finite": Message(
        "steps of {step:g} from {start:g} to {end:g} are no finite numbers",
        "des pas de {step:g} de {start:g} à {end:g} ne sont pas des nombres finis",
    ),
    "steps-lead-away": Message(
        "steps of {step:g} do not lead from {start:g} to {end:g}: {step:?they go the other way|"
        "they go nowhere}",
        "des pas de {step:g} ne mènent pas de {start:g} à {end:g} : {step:?ils vont dans l'autre "
        "sens|ils ne mènent nulle part}",
        "{meant:?the step has the sign of the distance: PAS {meant:g}}",
        "{meant:?le pas a le signe de la distance : PAS {meant:g}}",
    ),
    "logarithm": Message(
        "a logarithm needs positive values",
        "un logarithme demande des valeurs positives",
        "smallest is {smallest:g}",
        "la plus petite est {smallest:g}",
    ),
    "integer-too-large": Message(
        "LECT takes integers that 64 bits hold",
        "LECT prend des entiers qui tiennent sur 64 bits",
        "PROG makes lists of reals",
        "PROG fait des listes de réels",
    ),
    "integers-only": Message(
        "LECT takes integers only",
        "LECT ne prend que des entiers",
        "PROG makes lists of reals",
        "PROG fait des listes de réels",
    ),
    "negative-step-count": Message(
        "NPAS is not negative, found {count}",
        "NPAS n'est pas négatif, trouvé {count}",
    ),
    "steps-without-end": Message(
        "steps need an end: it is repeated at least once, not 0 times",
        "des pas demandent une fin : elle se répète au moins une fois, pas 0 fois",
    ),
    "object-of-other-type": Message(
        "the objects of a list are of one type: {first} first, {found} here",
        "les objets d'une liste sont d'un seul type : {first} au début, {found} ici",
    ),
    "number-among-words": Message(
        "a number in MOTS is a repetition: N * MOT",
        "un nombre dans MOTS est une répétition : N * MOT",
    ),
    "lists-of-one-type": Message(
        "both lists must be of the same type",
        "les deux listes doivent être du même type",
    ),
    "coefficient-count": Message(
        "{n_objects} {n_objects:object|objects} for "
        "{n_factors} {n_factors:coefficient|coefficients}",
        "{n_objects} {n_objects:objet|objets} pour "
        "{n_factors} {n_factors:coefficient|coefficients}",
    ),
    "nothing-to-combine": Message(
        "the objects are not fields or lists of one type",
        "les objets ne sont pas des champs ou des listes d'un même type",
        "a TABLE holds them at 1, 2, 3 ...",
        "une TABLE les contient en 1, 2, 3 ...",
    ),
    "single-component": Message(
        "SOMT sums a field of a single component",
        "SOMT somme un champ d'une seule composante",
        "see EXCO and RESU",
        "voyez EXCO et RESU",
    ),
    "lengths-differ": Message(
        "the lists have not the same length",
        "les listes n'ont pas la même longueur",
    ),
    "finite-numbers": Message(
        "RAFF refines lists of finite numbers",
        "RAFF raffine des listes de nombres finis",
    ),
    "no-parts": Message(
        "an interval is cut into one part at least",
        "un intervalle se découpe en une partie au moins",
    ),
    "interval-size": Message(
        "the size of the intervals is positive, not {size:g}",
        "la taille des intervalles est positive, pas {size:g}",
    ),
    "dot-product": Message(
        "lists of {n_first} and {n_other} values have no dot product",
        "des listes de {n_first} et {n_other} valeurs n'ont pas de produit scalaire",
    ),
    "response-too-short": Message(
        "a response of {n_response} {n_response:value|values} cannot have {before} before 0",
        "une réponse de {n_response} {n_response:valeur|valeurs} ne peut en avoir {before} avant 0",
    ),
    "signal-too-short": Message(
        "a signal of {n_signal} {n_signal:value|values} is too short to be mirrored over {before}",
        "un signal de {n_signal} {n_signal:valeur|valeurs} est trop court "
        "pour être prolongé par symétrie sur {before}",
        "'PADD' fills with zeros",
        "'PADD' complète par des zéros",
    ),
    "function-undefined": Message(
        "the function is not defined at {x:g}",
        "la fonction n'est pas définie en {x:g}",
    ),
    "degree": Message(
        "the degree is between 1 and 500, not {degree}",
        "le degré est entre 1 et 500, pas {degree}",
    ),
    "point-or-mesh": Message(
        "a POINT or a MAILLAGE is looked for in a mesh",
        "dans un maillage se cherche un POINT ou un MAILLAGE",
    ),
    "sorted-lengths": Message(
        "lists sorted together have the same length, these have {sizes}",
        "des listes triées ensemble ont la même longueur, celles-ci ont {sizes}",
    ),
    "cost-count": Message(
        "'COUT' needs {needed} {needed:cost|costs} for {n} {n:item|items}, found {found}",
        "'COUT' demande {needed} {needed:coût|coûts} pour {n} {n:élément|éléments}, trouvé {found}",
    ),
    "no-list-to-sort-by": Message(
        "the list to sort by is not in the table",
        "la liste qui règle le tri n'est pas dans la table",
    ),
    "index-holds-no-list": Message(
        "the index does not hold a list of numbers or words",
        "l'indice ne contient pas une liste de nombres ou de mots",
    ),
    "item-of-other-type": Message(
        "the item is not of the type of the list",
        "l'élément n'est pas du type de la liste",
    ),
    "one-list-without-doubles": Message(
        "'UNIQ' sorts one list only",
        "'UNIQ' ne trie qu'une liste",
    ),
}

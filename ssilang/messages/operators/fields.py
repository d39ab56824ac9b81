"""What ssilang/operators/fields refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "projected-nowhere-outside": Message(
        "{count} {count:point lies|points lie} outside of the field's cells, the first at {at}: "
        "no value there, and SOUC is raised",
        "{count} {count:point est|points sont} hors des éléments du champ, le premier en {at} : "
        "pas de valeur là, et SOUC est levé",
        "a larger tolerance as last number, relative to the cells, takes in what is near",
        "une plus grande tolérance, dernier nombre, relative aux éléments, prend ce qui est près",
        severity="warning",
    ),
    "projected-zero-outside": Message(
        "{count} {count:point lies|points lie} outside of the field's cells, the first at {at}: "
        "0 there, and SOUC is raised",
        "{count} {count:point est|points sont} hors des éléments du champ, le premier en {at} : "
        "0 là, et SOUC est levé",
        "a larger tolerance as last number, relative to the cells, takes in what is near",
        "une plus grande tolérance, dernier nombre, relative aux éléments, prend ce qui est près",
        severity="warning",
    ),
    "no-inverse-of-zero": Message(
        "component {name} is 0 at ({at:.4g}): it has no inverse there",
        "la composante {name} vaut 0 en ({at:.4g}) : elle n'y a pas d'inverse",
    ),
    "field-no-component": Message(
        "the field has no component {name}",
        "le champ n'a pas de composante {name}",
        "{names:words}",
        "{names:words}",
    ),
    "no-such-zone": Message(
        "the field has {n_zones} {n_zones:zone|zones}, not {zone}",
        "le champ a {n_zones} {n_zones:zone|zones}, il n'y a pas de zone {zone}",
    ),
    "component-not-in-zone": Message(
        "component {name} is not defined in zone {zone}",
        "la composante {name} n'est pas définie dans la zone {zone}",
    ),
    "no-such-cell": Message(
        "zone {zone} has {n_cells} {n_cells:cell|cells}, not {cell}",
        "la zone {zone} a {n_cells} {n_cells:élément|éléments}, il n'y a pas d'élément {cell}",
    ),
    "no-such-point": Message(
        "the cells have {n_points} {n_points:point|points}, not {point}",
        "les éléments ont {n_points} {n_points:point|points}, il n'y a pas de point {point}",
    ),
    "no-coordinate": Message(
        "there is no coordinate {wanted}",
        "il n'y a pas de coordonnée {wanted}",
    ),
    "cloud-shares-some-components": Message(
        "the field ({given:words}) and the cloud ({columns:words}) must share some "
        "components, not all",
        "le champ ({given:words}) et le nuage ({columns:words}) doivent partager des "
        "composantes, mais pas toutes",
    ),
    "grid-component-is-one-list": Message(
        "component {name} of a grid holds one LISTREEL",
        "la composante {name} d'une grille contient un seul LISTREEL",
    ),
    "cloud-columns-differ": Message(
        "the components have different numbers of values ({counts})",
        "les composantes n'ont pas le même nombre de valeurs ({counts})",
    ),
    "no-row-beyond": Message(
        "no value of {name} is {below:?below|above} {low:g}",
        "aucune valeur de {name} n'est {below:?inférieure|supérieure} à {low:g}",
    ),
    "cloud-lacks-components": Message(
        "the cloud has no component {missing:words}",
        "le nuage n'a pas de composante {missing:words}",
    ),
    "component-type-missing": Message(
        "the type of component {name} is missing",
        "le type de la composante {name} manque",
        "NAME*TYPE",
        "NAME*TYPE",
    ),
    "cloud-lacks-component": Message(
        "the cloud has no component {name}",
        "le nuage n'a pas de composante {name}",
        "{columns:words}",
        "{columns:words}",
    ),
    "cloud-has-several-rows": Message(
        "the cloud has {n_rows} {n_rows:row|rows}: take one first",
        "le nuage a {n_rows} {n_rows:n-uplet|n-uplets} : prenez-en d'abord un",
    ),
    "field-is-zero": Message(
        "the field has no value that is not zero",
        "le champ n'a que des valeurs nulles",
    ),
    "front-is-a-line-mesh": Message(
        "in 3D '{word}' wants the front, a mesh of SEG2",
        "en 3D '{word}' veut le front, un maillage de SEG2",
    ),
    "pod-method-and-count": Message(
        "POD wants 'SNAPSHOTS' or 'CLASSIQUE' and a number of modes",
        "POD veut 'SNAPSHOTS' ou 'CLASSIQUE' et un nombre de modes",
    ),
    "no-field-to-decompose": Message(
        "there is no field to decompose",
        "il n'y a aucun champ à décomposer",
    ),
    "table-has-no-fields": Message(
        "the table has no fields {name}",
        "la table n'a pas de champs {name}",
    ),
    "ends-are-points": Message(
        "in 2D 'DEUX' wants one end of the line, or both, as points",
        "en 2D 'DEUX' veut une extrémité de la ligne, ou les deux, en points",
    ),
    "no-field-number": Message(
        "there is no field of number {number}",
        "il n'y a pas de champ numéro {number}",
    ),
    "list-lengths-differ": Message(
        "the lists have {lengths:words} items",
        "les listes ont {lengths:words} valeurs",
    ),
    "field-empty": Message(
        "the field is empty",
        "le champ est vide",
    ),
    "list-empty": Message(
        "the list is empty",
        "la liste est vide",
    ),
    "components-not-listed": Message(
        "{word} waits for the list of the components",
        "{word} attend la liste des composantes",
        "components are listed by MOTS, one alone too: {word} (MOTS 'UX')",
        "MOTS fait une liste de composantes, même d'une seule : {word} (MOTS 'UX')",
    ),
    "no-component-left": Message(
        "no component is left to look at",
        "il ne reste aucune composante à examiner",
        "known: {known:words}",
        "connus : {known:words}",
    ),
    "fields-do-not-match": Message(
        "fields compared value by value must have the same components and nodes",
        "des champs comparés valeur par valeur doivent avoir les mêmes composantes et les "
        "mêmes noeuds",
        "reduce them to the same mesh by REDU",
        "réduisez-les au même maillage par REDU",
    ),
    "limit-not-positive": Message(
        "the limit is positive, not {limit:g}",
        "la limite est positive, pas {limit:g}",
    ),
    "fields-of-other-zones": Message(
        "the two fields do not have the same components and zones",
        "les deux champs n'ont pas les mêmes composantes et les mêmes zones",
    ),
    "second-field-is-zero": Message(
        "the second field is zero: nothing limits it",
        "le second champ est nul : rien ne le limite",
    ),
    "one-component-compared": Message(
        "fields of one component, the same in both, are compared",
        "on compare des champs d'une seule composante, la même dans les deux",
    ),
    "not-a-contour": Message(
        "entry {number} is not a contour",
        "l'entrée {number} n'est pas un contour",
    ),
    "contour-without-area": Message(
        "contour {number} encloses no area",
        "le contour {number} n'entoure aucune aire",
    ),
    "node-twice-with-other-values": Message(
        "a node stands twice in the mesh with different values of {name}",
        "un noeud est deux fois dans le maillage avec des valeurs différentes de {name}",
    ),
    "one-point-field-needs": Message(
        "a field that is zero but at one point needs a model, cell, point, value",
        "un champ nul sauf en un point demande modèle, élément, point, valeur",
    ),
    "model-has-no-such-zone": Message(
        "the model has {n_zones} {n_zones:zone|zones}, not {zone}",
        "le modèle a {n_zones} {n_zones:zone|zones}, il n'y a pas de zone {zone}",
    ),
    "zone-has-no-such-point": Message(
        "the zone has {n_cells} {n_cells:cell|cells} of {n_points} {n_points:point|points} there",
        "la zone y a {n_cells} {n_cells:élément|éléments} de {n_points} {n_points:point|points}",
    ),
    "word-counts-differ": Message(
        "the lists have {n_left} and {n_right} {n_right:word|words}",
        "les listes ont {n_left} et {n_right} {n_right:mot|mots}",
    ),
    "field-counts-differ": Message(
        "the lists have {n_first} and {n_second} {n_second:field|fields}",
        "les listes ont {n_first} et {n_second} {n_second:champ|champs}",
    ),
    "coefficients-have-one-component": Message(
        "the field of coefficients has one component",
        "le champ des coefficients a une seule composante",
    ),
    "table-without-point-fields": Message(
        "the table holds no field at a point",
        "la table ne contient aucun champ indicé par un point",
    ),
    "values-per-point": Message(
        "{n_values} {n_values:value|values} for {n_nodes} {n_nodes:point|points}",
        "{n_values} {n_values:valeur|valeurs} pour {n_nodes} {n_nodes:point|points}",
        "a list needs a mesh of points (CHAN 'POI1') and one value a point",
        "une liste demande un maillage de points (CHAN 'POI1') et une valeur par point",
    ),
    "new-name-count": Message(
        "{n_old} {n_old:component|components}, {n_new} new {n_new:name|names}",
        "{n_old} {n_old:composante|composantes}, {n_new} {n_new:nouveau nom|nouveaux noms}",
    ),
    "renamed-name-count": Message(
        "{n_old} {n_old:name|names} to change into {n_new}",
        "{n_old} {n_old:nom|noms} à changer en {n_new}",
    ),
    "one-name-not-enough": Message(
        "the field has {n_known} {n_known:component|components}, one name is not enough",
        "le champ a {n_known} {n_known:composante|composantes}, un seul nom ne suffit pas",
        "give two lists of words: old names, new names",
        "donnez deux listes de mots : anciens noms, nouveaux noms",
    ),
    "poly-not-available": Message(
        "'POLY' is not available",
        "'POLY' n'est pas disponible",
        "give a field in cells",
        "donnez un champ par éléments",
    ),
    "mini-needs-a-model": Message(
        "'MINI' projects on a model, not on a mesh",
        "'MINI' projette sur un modèle, pas sur un maillage",
    ),
    "integration-points-none": Message(
        "{points} integration points in each direction are none",
        "{points} points d'intégration par direction n'en font aucun",
    ),
    "no-support": Message(
        "'{support}' is no support",
        "'{support}' n'est pas un support",
        "{supports:words}",
        "{supports:words}",
    ),
    "which-zeros": Message(
        "which zeros? one of {titles:words}",
        "quels zéros ? l'un de {titles:words}",
    ),
    "nature-unknown": Message(
        "the nature is INDETERMINE, DIFFUS or DISCRET",
        "la nature est INDETERMINE, DIFFUS ou DISCRET",
    ),
    "three-word-counts-differ": Message(
        "the three lists have {counts} words",
        "les trois listes ont {counts} mots",
    ),
    "model-for-hooke": Message(
        "with a model, matrices of Hooke are multiplied by strains",
        "avec un modèle, ce sont des matrices de Hooke qu'on multiplie par des déformations",
        "HOOK makes them, EPSI gives strains; without a model fields go component by component",
        "HOOK les fabrique, EPSI donne les déformations ; sans modèle, les champs se multiplient "
        "composante par composante",
    ),
    "table-of-fields": Message(
        "the table has no fields in cells at numbers",
        "la table n'a pas de champs par éléments à des indices numériques",
    ),
    "table-of-models": Message(
        "the table has no models and no meshes",
        "la table n'a ni modèles ni maillages",
        "PART deals a model or a mesh out into such a table",
        "PART partage un modèle ou un maillage en une telle table",
    ),
    "factor-count": Message(
        "{n_factors} {n_factors:factor|factors} for {n_names} {n_names:name|names}",
        "{n_factors} {n_factors:coefficient|coefficients} pour {n_names} {n_names:nom|noms}",
        "as many numbers as each list has words",
        "autant de nombres que chaque liste a de mots",
    ),
    "objects-do-not-go": Message(
        "{sign} does not go with what the cells hold: {types:words}",
        "{sign} ne va pas avec ce que portent les éléments : {types:words}",
        "curves, lists and numbers combine; points add up",
        "les évolutions, listes et nombres se combinent ; les points s'additionnent",
    ),
    "zero-no-power": Message(
        "zero has no power {exponent:g}",
        "zéro n'a pas de puissance {exponent:g}",
    ),
    "number-has-no-field-power": Message(
        "{number:g} cannot be raised to the powers of a field",
        "{number:g} ne peut être élevé aux puissances d'un champ",
    ),
    "division-by-zero": Message(
        "division by zero",
        "division par zéro",
    ),
    "components-per-list": Message(
        "in dimension {dimension} each list names {dimension} {dimension:component|components}",
        "en dimension {dimension} chaque liste nomme {dimension} "
        "{dimension:composante|composantes}",
    ),
    "negative-value-no-power": Message(
        "a negative value has no power {exponent:g}",
        "une valeur négative n'a pas de puissance {exponent:g}",
    ),
    "no-field-for-element": Message(
        "no field has components {names:words} for element {element}",
        "aucun champ n'a les composantes {names:words} pour l'élément {element}",
    ),
    "continuous-elements-only": Message(
        "{what} is for continuous elements, not {element}",
        "{what} vaut pour les éléments massifs, pas pour {element}",
    ),
    "no-side-of-thick-shell": Message(
        "the stresses of {element} stand at points across the thickness, not on its sides",
        "les contraintes de {element} sont en des points de l'épaisseur, non sur ses peaux",
        "leave SUPE or INFE out",
        "ôtez SUPE ou INFE",
    ),
    "no-directions-of-thick-shell": Message(
        "principal directions of {element}, whose frames turn from point to point, are not "
        "available",
        "les directions principales de {element}, dont les repères tournent d'un point à l'autre, "
        "ne sont pas disponibles",
        "VMIS, TRES and INVA need no directions",
        "VMIS, TRES et INVA n'en ont pas besoin",
    ),
    "no-stress-tensor": Message(
        "element {element} has no stress tensor here",
        "l'élément {element} n'a pas ici de tenseur des contraintes",
        "continuous elements have; shells with their parameters (EPAI)",
        "les massifs en ont un ; les coques aussi, avec leurs caractéristiques (EPAI)",
    ),
    "component-not-on-model": Message(
        "the field has no component {wanted} on the model",
        "le champ n'a pas de composante {wanted} sur le modèle",
    ),
    "which-component": Message(
        "which component? the field has {names:words}",
        "quelle composante ? le champ a {names:words}",
    ),
    "stresses-and-strains-apart": Message(
        "the stresses stand at '{support}', the strains at '{other}'",
        "les contraintes sont aux points '{support}', les déformations aux points '{other}'",
    ),
    "grad-of-solids-only": Message(
        "GRAD is for continuous elements, not {element}",
        "GRAD vaut pour les éléments massifs, pas pour {element}",
    ),
    "grad-of-displacements-or-scalar": Message(
        "GRAD takes displacements or one scalar, not {names:words}",
        "GRAD prend des déplacements ou un seul scalaire, pas {names:words}",
    ),
    "jaco-of-solids-only": Message(
        "JACO is for continuous elements, not {element}",
        "JACO vaut pour les éléments massifs, pas pour {element}",
    ),
    "no-component-is-abscissa": Message(
        "none of the components {names:words} is the abscissa '{wanted}' of the law",
        "aucune des composantes {names:words} n'est l'abscisse '{wanted}' de la loi",
        "name the abscissa of the curve as the component",
        "donnez à l'abscisse de l'évolution le nom de la composante",
    ),
    "law-is-one-curve": Message(
        "a law is one curve, this object has {n_parts}",
        "une loi est une seule courbe, cet objet en a {n_parts}",
    ),
    "parameters-and-fields-apart": Message(
        "the parameters and the fields they depend on stand on different cells",
        "les paramètres et les champs dont ils dépendent sont sur des éléments différents",
    ),
    # ---- what is printed
    "listed-field": Message(
        "MCHAML {title:?{title}|(no type)}, {count} {count:zone|zones}",
        "MCHAML {title:?{title}|(sans type)}, {count} {count:zone|zones}",
    ),
    "listed-cells": Message(
        "  {number}: {count} {count:cell|cells} {cell_type}, at {support}",
        "  {number} : {count} {count:maille|mailles} {cell_type}, support {support}",
    ),
    "listed-range": Message(
        "     {name:<8} {low:12.5E} to {high:12.5E}", "     {name:<8} {low:12.5E} à {high:12.5E}"
    ),
    "listed-cloud": Message(
        "Cloud of {count} {count:tuple|tuples} with {n_names} {n_names:component|components}",
        "Nuage de {count} {count:n-uplet|n-uplets} à {n_names} {n_names:composante|composantes}",
    ),
    "listed-column": Message(
        "  component {name}{kind:? of type {kind}}", "  composante {name}{kind:? de type {kind}}"
    ),
}

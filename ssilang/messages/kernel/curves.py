"""What ssilang/kernel/curves refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "abscissas-ordinates": Message(
        "{n_x} {n_x:abscissa|abscissas} for {n_y} {n_y:ordinate|ordinates}",
        "{n_x} {n_x:abscisse|abscisses} pour {n_y} {n_y:ordonnée|ordonnées}",
    ),
    "abscissas-spline-must-increase": Message(
        "abscissas of a spline must increase strictly",
        "les abscisses d'une spline doivent croître strictement",
    ),
    "clouds-of-other-components": Message(
        "clouds are joined row by row: {first:words} and {second:words} are not the same "
        "components",
        "des nuages se joignent ligne par ligne : {first:words} et {second:words} ne sont pas les "
        "mêmes composantes",
    ),
    "cloud-no-component": Message(
        "the cloud has no component {name}",
        "le nuage n'a pas de composante {name}",
        "it has {columns:?{columns:words}|none}",
        "il a {columns:?{columns:words}|aucune composante}",
    ),
    "complex-curves-must-same": Message(
        "complex curves must have the same abscissas",
        "des évolutions complexes doivent avoir les mêmes abscisses",
    ),
    "component-cloud-holds-objects": Message(
        "component {name} of the cloud holds objects, not numbers",
        "la composante {name} du nuage contient des objets, pas des nombres",
    ),
    "coordinates-grid-must-increase": Message(
        "the coordinates of a grid must increase",
        "les coordonnées d'une grille doivent croître",
    ),
    "grid-nodes-needs-values": Message(
        "a grid of {grid} nodes needs {wanted} values, not {n_values}",
        "une grille de {grid} noeuds demande {wanted} valeurs, pas {n_values}",
    ),
    "no-point-interpolate-between": Message(
        "there is no point to interpolate between",
        "il n'y a pas de point entre lesquels interpoler",
    ),
    "objects-curves": Message(
        "the objects have {n_parts} and {n_parts_2} {n_parts_2:curve|curves}",
        "les objets ont {n_parts} et {n_parts_2} {n_parts_2:courbe|courbes}",
    ),
    "ordinate-divisor-zero": Message(
        "an ordinate of the divisor is zero",
        "une ordonnée du diviseur est nulle",
    ),
    "real-curve-complex-cannot": Message(
        "a real curve and a complex one cannot be combined",
        "une évolution réelle et une complexe ne se combinent pas",
    ),
    "spline-many-abscissas-values": Message(
        "a spline has as many abscissas as values, found {n_x} and {n_y}",
        "une spline a autant d'abscisses que de valeurs, trouvé {n_x} et {n_y}",
    ),
    "spline-needs-two-points": Message(
        "a spline needs two points at least, found {n_x}",
        "une spline demande deux points au moins, trouvé {n_x}",
    ),
    "two-curves-no-abscissa": Message(
        "the two curves have no abscissa in common",
        "les deux évolutions n'ont aucune abscisse commune",
    ),
    "abscissas-must-increase-decrease": Message(
        "abscissas must increase or decrease all along",
        "les abscisses doivent croître ou décroître tout du long",
    ),
    "abscissas-must-increase-follows": Message(
        "abscissas must increase: {x:g} follows {x_2:g}",
        "les abscisses doivent croître : {x:g} suit {x_2:g}",
    ),
    "curves-multiplied-same-abscissas": Message(
        "curves are multiplied on the same abscissas only",
        "des évolutions ne se multiplient que sur les mêmes abscisses",
    ),
}

"""What ssilang/kernel/base refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "coordinates-grid-must-increase": Message(
        "the coordinates of a grid must increase",
        "les coordonnées d'une grille doivent croître",
    ),
    "cloud-no-component": Message(
        "the cloud has no component {name}",
        "le nuage n'a pas de composante {name}",
        "it has {columns:words}",
        "il a {columns:words}",
    ),
    "component-cloud-holds-objects": Message(
        "component {name} of the cloud holds objects, not numbers",
        "la composante {name} du nuage contient des objets, pas des nombres",
    ),
    "abscissas-must-increase-follows": Message(
        "abscissas must increase: {x:g} follows {x_2:g}",
        "les abscisses doivent croître : {x:g} suit {x_2:g}",
        "sort them by ORDO",
        "triez-les par ORDO",
    ),
    "two-curves-no-abscissa": Message(
        "the two curves have no abscissa in common",
        "les deux évolutions n'ont aucune abscisse commune",
    ),
    "real-curve-complex-cannot": Message(
        "a real curve and a complex one cannot be combined",
        "une évolution réelle et une complexe ne se combinent pas",
    ),
    "spline-needs-two-points": Message(
        "a spline needs two points at least, found {n_x}",
        "une spline demande deux points au moins, trouvé {n_x}",
    ),
    "spline-many-abscissas-values": Message(
        "a spline has as many abscissas as values, found {n_x} and {n_y}",
        "une spline a autant d'abscisses que de valeurs, trouvé {n_x} et {n_y}",
    ),
    "abscissas-spline-must-increase": Message(
        "abscissas of a spline must increase strictly",
        "les abscisses d'une spline doivent croître strictement",
    ),
    "no-point-interpolate-between": Message(
        "there is no point to interpolate between",
        "il n'y a pas de point entre lesquels interpoler",
    ),
    "curves-multiplied-same-abscissas": Message(
        "curves are multiplied on the same abscissas only",
        "des évolutions ne se multiplient que sur les mêmes abscisses",
        "bring one to the abscissas of the other by IPOL",
        "portez l'une aux abscisses de l'autre par IPOL",
    ),
    "ordinate-divisor-zero": Message(
        "an ordinate of the divisor is zero",
        "une ordonnée du diviseur est nulle",
    ),
    "complex-curves-must-same": Message(
        "complex curves must have the same abscissas",
        "des évolutions complexes doivent avoir les mêmes abscisses",
    ),
    "abscissas-must-increase-decrease": Message(
        "abscissas must increase or decrease all along",
        "les abscisses doivent croître ou décroître tout du long",
        "sort by ORDO, or use IPOL 'TOUS'",
        "triez par ORDO, ou prenez IPOL 'TOUS'",
    ),
    "signal-needs-two-points": Message(
        "a signal needs two points at least, found {n_x}",
        "un signal demande deux points au moins, trouvé {n_x}",
    ),
    "abscissas-not-regularly-spaced": Message(
        "the abscissas are not regularly spaced: steps differ by {worst:g} from {step:g}",
        "les abscisses ne sont pas à pas constant : des pas s'écartent de {worst:g} de la "
        "valeur {step:g}",
        "bring the signal to a constant step by IPOL",
        "portez le signal à un pas constant par IPOL",
    ),
    "acceleration-needs-two-points": Message(
        "the acceleration needs two points, a positive step and cut-off frequency",
        "l'accélération demande deux points, un pas et une fréquence de coupure positifs",
    ),
    "depth-outside-layers-end": Message(
        "a depth is outside the layers, which end at {bottom:g} m",
        "une profondeur est hors des couches, qui finissent à {bottom:g} m",
    ),
    "soil-needs-many-thicknesses": Message(
        "a soil needs as many thicknesses as densities, moduli and dampings",
        "un sol demande autant d'épaisseurs que de masses volumiques, de modules et "
        "d'amortissements",
    ),
    "thickness-density-modulus-layer": Message(
        "thickness, density and modulus of a layer must be positive",
        "l'épaisseur, la masse volumique et le module d'une couche doivent être positifs",
    ),
    "frequencies-rayleigh-damping-must": Message(
        "the frequencies of Rayleigh's damping must be positive",
        "les fréquences de l'amortissement de Rayleigh doivent être positives",
    ),
    "objects-curves": Message(
        "the objects have {n_parts} and {n_parts_2} {n_parts_2:curve|curves}",
        "les objets ont {n_parts} et {n_parts_2} {n_parts_2:courbe|courbes}",
    ),
    "abscissas-ordinates": Message(
        "{n_x} {n_x:abscissa|abscissas} for {n_y} {n_y:ordinate|ordinates}",
        "{n_x} {n_x:abscisse|abscisses} pour {n_y} {n_y:ordonnée|ordonnées}",
    ),
    "grid-nodes-needs-values": Message(
        "a grid of {grid} nodes needs {wanted} values, not {n_values}",
        "une grille de {grid} noeuds demande {wanted} valeurs, pas {n_values}",
    ),
}

"""What ssilang/kernel/waves refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "base-without-size": Message(
        "a base has half sizes above zero", "les demi-côtés d'une base sont positifs"
    ),
    "speed-not-positive": Message(
        "speeds of waves are above zero", "les vitesses d'ondes sont positives"
    ),
    "gamma-negative": Message(
        "incoherence {gamma:.4g} is negative", "l'incohérence {gamma:.4g} est négative"
    ),
    "layers-differ": Message(
        "each layer needs a density, two speeds and a damping",
        "chaque couche a une masse volumique, deux vitesses et un amortissement",
    ),
    "last-layer-endless": Message(
        "all layers but the last one have a thickness",
        "toutes les couches sauf la dernière ont une épaisseur",
    ),
    "layer-not-positive": Message(
        "thicknesses, densities and speeds of layers are positive, dampings not negative",
        "les épaisseurs, masses volumiques et vitesses des couches sont positives, les "
        "amortissements non négatifs",
    ),
    "frequencies-not-positive": Message(
        "the frequencies of Rayleigh's damping are positive",
        "les fréquences de l'amortissement de Rayleigh sont positives",
    ),
    "angle-not-upwards": Message(
        "a wave that comes up makes less than 90 degrees with the vertical, not {angle:g}",
        "une onde montante fait moins de 90 degrés avec la verticale, pas {angle:g}",
    ),
    "above-the-surface": Message(
        "a point lies {height:g} m above the free surface",
        "un point est à {height:g} m au-dessus de la surface libre",
    ),
    "record-too-short": Message(
        "a record has two points at least and a positive step",
        "un signal a au moins deux points et un pas positif",
    ),
    "step-not-positive": Message(
        "the step of the motion is positive, not {step:g}",
        "le pas du mouvement est positif, pas {step:g}",
    ),
    "surface-at-rest": Message(
        "at {angle:g} degrees the wave does not move the surface in the record's direction",
        "à {angle:g} degrés l'onde ne bouge pas la surface dans la direction du signal",
    ),
    "cells-without-elements": Message(
        "{count} {count:cell|cells} of the layer {count:is no element|are no elements} of the "
        "stiffness",
        "{count} {count:maille|mailles} de la couche {count:n'est pas un élément|ne sont pas des "
        "éléments} de la rigidité",
    ),
    "layer-not-around": Message(
        "the layer does not stand between what is inside and what is outside",
        "la couche n'est pas entre l'intérieur et l'extérieur",
        "it shares nodes with what is inside, and has others",
        "elle partage des noeuds avec l'intérieur et en a d'autres",
    ),
    "motion-not-known": Message(
        "the free field has no {unknown}; {count} {count:unknown is|unknowns are} missing",
        "le champ libre n'a pas {unknown} ; il manque {count} {count:inconnue|inconnues}",
    ),
    "outside-column": Message(
        "the column goes from {low:g} to {high:g} m, the ground has nodes at {height:g} m",
        "la colonne va de {low:g} à {high:g} m, le sol a des noeuds à {height:g} m",
    ),
    "matched-layer-plane-strain": Message(
        "a matched layer stands in plane strain alone",
        "une couche adaptée n'existe qu'en déformations planes",
        "in other modes dampers of the edges (AMOR) absorb; they want more distance",
        "dans les autres modes, des amortisseurs de bord (AMOR) absorbent ; ils veulent plus de "
        "distance",
    ),
    "matched-layer-elements": Message(
        "a matched layer takes solid elements (QUA4, QUA8, TRI3, TRI6), not {element}",
        "une couche adaptée prend des éléments massifs (QUA4, QUA8, TRI3, TRI6), pas {element}",
    ),
    "matched-layer-isotropic": Message(
        "a matched layer is linear and isotropic, not {behaviour}",
        "une couche adaptée est linéaire et isotrope, pas {behaviour}",
        "ground that yields stays inside the box; the layer takes its elastic model",
        "le sol qui se plastifie reste dans la boîte ; la couche prend son modèle élastique",
    ),
    "part-of-matched-layer": Message(
        "a matched layer is there without its {missing:words}",
        "une couche adaptée est là sans {missing:words}",
        "its RIGI, MASS and AMOR go together into a calculation in time",
        "ses RIGI, MASS et AMOR vont ensemble dans un calcul en temps",
    ),
    "matched-layer-at-rest": Message(
        "a matched layer has no static stiffness: it knows waves alone",
        "une couche adaptée n'a pas de rigidité statique : elle ne connaît que des ondes",
        "solve with the RIGI of its elements, then start DYNAMIC with the constant load "
        "RIGI * DEPL",
        "résoudre avec la RIGI de ses éléments, puis démarrer DYNAMIC avec le chargement constant "
        "RIGI * DEPL",
    ),
    "nothing-beyond-box": Message(
        "the layer does not reach beyond the box that the ground inside fills",
        "la couche ne dépasse pas la boîte que remplit le sol à l'intérieur",
    ),
    "layer-in-box": Message(
        "{count} {count:element|elements} of the layer (the first at {place:words}) "
        "{count:lies|lie} in the box that the ground inside fills",
        "{count} {count:élément|éléments} de la couche (le premier en {place:words}) "
        "{count:est|sont} dans la boîte que remplit le sol à l'intérieur",
        "the box has sides along the axes; all in it is ground inside",
        "la boîte a des côtés selon les axes ; tout ce qui y est est sol à l'intérieur",
    ),
}

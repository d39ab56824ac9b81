"""What ssilang/kernel/interface refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "joints-faces-no-integration": Message(
        "joints with {face} faces have no integration rule {rule}",
        "les joints à faces {face} n'ont pas de règle d'intégration {rule}",
        "GAUSS serves all faces, LOBATTO those of {nodal_weights}",
        "GAUSS vaut pour toutes les faces, LOBATTO pour celles en {nodal_weights}",
    ),
    "field-lacks-component": Message(
        "the field has no component {name} on joints {element}",
        "le champ n'a pas de composante {name} sur les joints {element}",
    ),
    "moduli-not-positive": Message(
        "the moduli D11 D21 ... of the joint give some motion a negative energy",
        "les modules D11 D21 ... du joint donnent une énergie négative à certains mouvements",
    ),
    "no-joint-law-called": Message(
        "no joint law is called {strange}",
        "aucune loi de joint ne s'appelle {strange}",
        "joints have {laws}",
        "les joints ont {laws}",
    ),
    "joint-parameter-not-finite": Message(
        "a joint parameter is not a finite number",
        "un paramètre de joint n'est pas un nombre fini",
    ),
    "joint-fu-gf-perfectly": Message(
        "a joint with FU = {fu:g} and GF = 0 is perfectly brittle, which JOINT_SDM refuses",
        "un joint avec FU = {fu:g} et GF = 0 est parfaitement fragile, ce que JOINT_SDM refuse",
        "give GF > FU^2/KN = {fu_2:g} N/m, or FU = 0 for a joint without tension",
        "donnez GF > FU^2/KN = {fu_2:g} N/m, ou FU = 0 pour un joint sans traction",
    ),
    "joint-parameter-not-finite-2": Message(
        "a joint parameter is not a finite number, or an angle reaches 90",
        "un paramètre de joint n'est pas un nombre fini, ou un angle atteint 90",
    ),
    "joint-parameter-must": Message(
        "the joint parameter {name} = {values:g} must be {wanted}",
        "le paramètre de joint {name} = {values:g} doit être {wanted}",
    ),
    "kn-must-exceed-fu": Message(
        "KN = {kn:g} must exceed FU^2/GF = {least:g}: the joint would soften faster than it "
        "unloads and one opening would have several tractions",
        "KN = {kn:g} doit dépasser FU^2/GF = {least:g} : le joint s'adoucirait plus vite "
        "qu'il ne se décharge et une ouverture aurait plusieurs tractions",
        "KN > {least:g} with this FU and GF, or FU < {largest:g} with this KN and GF",
        "KN > {least:g} avec ces FU et GF, ou FU < {largest:g} avec ces KN et GF",
    ),
    "law-two-points": Message(
        "{name} stands between two points, not on the faces of {element}",
        "{name} se place entre deux points, pas sur les faces de {element}",
        "JOI1 on a cell SEG2 from the lower point to the upper one",
        "JOI1 sur une maille SEG2, du point bas au point haut",
    ),
    "macro-ressorts-exists-two": Message(
        "MACRO_RESSORTS exists in two dimensions only",
        "MACRO_RESSORTS n'existe qu'en dimension 2",
        "MACRO_SEMELLE or MACRO_DISQUE",
        "prenez MACRO_SEMELLE ou MACRO_DISQUE",
    ),
    "macro-semelle-needs-long": Message(
        "MACRO_SEMELLE needs LONG, the second width, in three dimensions",
        "MACRO_SEMELLE demande LONG, la seconde largeur, en dimension 3",
    ),
    "macro-needs-cohe": Message(
        "{name} of a macro-element says nothing without COHE, the strength of the ground",
        "{name} d'un macro-élément ne dit rien sans COHE, la résistance du sol",
        "give COHE (Pa), or leave {name} out",
        "donnez COHE (Pa), ou omettez {name}",
    ),
    "bed-one-shear-stiffness": Message(
        "a macro-element whose ground yields has one shear stiffness: KS1 and KS2 differ",
        "un macro-élément au sol plastique a une seule raideur tangente : KS1 et KS2 diffèrent",
        "give KS alone",
        "donnez KS seule",
    ),
    "bed-has-its-own-twist": Message(
        "QN cannot be given with COHE: ground that yields resists twist by KS all over the base",
        "QN ne va pas avec COHE : un sol plastique résiste à la torsion par KS sur toute la base",
        "leave QN out",
        "omettez QN",
    ),
    "joint-needs-node-matrices": Message(
        "a joint needs {missing} at node {node}, which the matrices lack",
        "un joint demande {missing} au noeud {node}, que les matrices n'ont pas",
    ),
    "joint-cannot-integrated-nodes": Message(
        "the joint {element} cannot be integrated at its nodes (LOBATTO): weights there are "
        "negative or zero",
        "le joint {element} ne s'intègre pas à ses noeuds (LOBATTO) : les poids y sont "
        "négatifs ou nuls",
        "GAUSS, or linear faces ({nodal_weights:words})",
        "prenez GAUSS, ou des faces linéaires ({nodal_weights:words})",
    ),
    "coulomb-type-not-available": Message(
        "COULOMB with TYPE = {kind:g} is not available",
        "COULOMB avec TYPE = {kind:g} n'existe pas",
        "TYPE = 1: slip of the displacements; TYPE = 2, slip in rotation, is not built",
        "TYPE = 1 : glissement des déplacements ; TYPE = 2, glissement en rotation, n'est "
        "pas programmé",
    ),
    "joint-parameter-cell-fit": Message(
        "the joint parameter {name} has {n_values} {n_values:value|values} a cell where 1 or "
        "{g} fit",
        "le paramètre de joint {name} a {n_values} {n_values:valeur|valeurs} par élément, il "
        "en faut 1 ou {g}",
    ),
    "joint-joi1-normal-goes": Message(
        "{cells} of the joint JOI1 has a normal that goes from its second node to its first: "
        "opening and closing would be exchanged",
        "{cells} du joint JOI1 a une normale qui va de son second noeud à son premier : "
        "ouverture et fermeture seraient échangées",
        "reverse the DIRECTION, or the order of the two nodes",
        "inversez la DIRECTION, ou l'ordre des deux noeuds",
    ),
    "joint-no-area": Message(
        "{cells} of the joint {element} has no area",
        "{cells} du joint {element} est d'aire nulle",
    ),
    "joint-folded-part-negative": Message(
        "{cells} of the joint {element} is folded: part of it has a negative area",
        "{cells} du joint {element} est replié : une partie en est d'aire négative",
        "its nodes must follow one another round the face, on both sides in the same order",
        "ses noeuds doivent se suivre autour de la face, dans le même ordre des deux côtés",
    ),
    "joint-negative-area": Message(
        "{cells} of the joint {element} has a negative area",
        "{cells} du joint {element} est d'aire négative",
        "{axisymmetric:?radii must be positive|the thickness DIM3 must be positive}",
        "{axisymmetric:?les rayons doivent être positifs|l'épaisseur DIM3 doit être positive}",
    ),
    "joint-parameter-must-number": Message(
        "the joint parameter {name} must be a number, not {name_2}",
        "le paramètre de joint {name} doit être un nombre, pas {name_2}",
    ),
    "direction-joint-zero-vector": Message(
        "the direction {name} given for a joint is a zero vector",
        "la direction {name} donnée pour un joint est un vecteur nul",
    ),
    "cells": Message(
        "cell {first}{more:? (and {more} more)}",
        "l'élément {first}{more:? (et {more} {more:autre|autres})}",
    ),
    "joint-both-sides-same": Message(
        "{cells} of the joint {element} has both sides on the same nodes",
        "{cells} du joint {element} a ses deux faces sur les mêmes noeuds",
    ),
    "joint-normal-goes-first": Message(
        "{cells} of the joint {element} has a normal that goes from its first side to its "
        "second: opening and closing would be exchanged",
        "{cells} du joint {element} a une normale qui va de sa première face à sa seconde : "
        "ouverture et fermeture seraient échangées",
        "exchange the two sides: the first is the upper one",
        "échangez les deux côtés : le premier est le côté supérieur",
    ),
    "joint-joi1-no-length": Message(
        "{cells} of the joint JOI1 has no length, so its normal is unknown",
        "{cells} du joint JOI1 est de longueur nulle : sa normale est inconnue",
    ),
}

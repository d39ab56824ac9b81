"""What ssilang/operators/models refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "tensions-before-not-built": Message(
        "tensions before (PRE0) are not built",
        "les tensions préalables (PRE0) ne sont pas programmées",
        "PREC for the cables pulled now, added to the field of the others",
        "PREC pour les câbles tendus maintenant, ajouté au champ des autres",
    ),
    "cables-are-bars": Message(
        "prestressing cables are bars (BARR on SEG2), not {element}",
        "les câbles de précontrainte sont des barres (BARR sur SEG2), pas {element}",
    ),
    "cable-end-not-pulled": Message(
        "no end of the cable from node {first} to node {last} is among the points where "
        "it is pulled",
        "aucune extrémité du câble allant du noeud {first} au noeud {last} n'est parmi "
        "les points de mise en tension",
    ),
    "loss-is-a-number": Message(
        "'{name}' of the losses is a number",
        "'{name}' des pertes est un nombre",
    ),
    "tori-not-available": Message(
        "'TORI' is not available",
        "'TORI' n'est pas disponible",
        "'POLA', 'CYLI' and 'SPHE' are",
        "'POLA', 'CYLI' et 'SPHE' le sont",
    ),
    "rten-of-solids-only": Message(
        "RTEN is for continuous elements, not {element}",
        "RTEN vaut pour les éléments massifs, pas {element}",
    ),
    "what-to-remove": Message(
        "what is to be removed?",
        "que faut-il enlever ?",
        "'FORM' or 'COMP', and a word",
        "'FORM' ou 'COMP', et un mot",
    ),
    "several-constituents": Message(
        "the zones of the model have several constituents",
        "les zones du modèle ont plusieurs constituants",
    ),
    "section-list-count": Message(
        "{n_lists} {n_lists:list is|lists are} given: {space:?two curvatures and the normal "
        "force are needed "
        "in space|the curvature and the normal force are needed in the plane}",
        "{n_lists} {n_lists:liste est donnée|listes sont données} : {space:?il faut deux "
        "courbures et "
        "l'effort normal dans l'espace|il faut la courbure et l'effort normal dans le plan}",
    ),
    "lists-different-lengths": Message(
        "the lists have different lengths",
        "les listes ont des longueurs différentes",
        "one value a step",
        "une valeur par pas",
    ),
    "no-common-zone": Message(
        "the two models have no zone in common",
        "les deux modèles n'ont aucune zone commune",
    ),
    "only-diametre-min-built": Message(
        "only 'DIAMETRE_MIN' is built",
        "seul 'DIAMETRE_MIN' est programmé",
    ),
    "no-smallest-length": Message(
        "elements {element} have no smallest length",
        "les éléments {element} n'ont pas de plus petite longueur",
    ),
    "bending-elements-need-section": Message(
        "elements {element} bend: their thickness or section is needed",
        "les éléments {element} fléchissent : il faut leur épaisseur ou leur section",
        "TAIL 'DIAMETRE_MIN' MODL1 CAR1",
        "TAIL 'DIAMETRE_MIN' MODL1 CAR1",
    ),
    "hardening-given-twice": Message(
        "the hardening is given twice, by TRAC and by ECRO",
        "l'écrouissage est donné deux fois, par TRAC et par ECRO",
    ),
    "trac-needs-one-youn": Message(
        "TRAC needs YOUN as one number",
        "TRAC demande pour YOUN un seul nombre",
        "give ECRO instead",
        "donnez plutôt ECRO",
    ),
    "trac-is-a-curve": Message(
        "parameter TRAC is a curve",
        "le paramètre TRAC est une évolution",
        "EVOL 'MANU' strains stresses",
        "donnez EVOL 'MANU' déformations contraintes",
    ),
}

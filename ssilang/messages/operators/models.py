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
    "rten-of-solids-only": Message(
        "RTEN is for continuous elements and flat shells, not {element}",
        "RTEN vaut pour les éléments massifs et les coques planes, pas {element}",
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
    "reduction-given-twice": Message(
        "the fall of the shear modulus is given twice, by GAMR and by GGAM",
        "la réduction du module de cisaillement est donnée deux fois, par GAMR et par GGAM",
        "GGAM is a curve of G/Gmax, GAMR stands for 1 / (1 + gamma / GAMR)",
        "GGAM est une courbe de G/Gmax, GAMR veut dire 1 / (1 + gamma / GAMR)",
    ),
    "gamr-is-a-number": Message(
        "GAMR is a number or a field of numbers: the shear strain at which G is half of Gmax",
        "GAMR est un nombre ou un champ de nombres : la distorsion à laquelle G vaut la moitié de "
        "Gmax",
        "a curve of G/Gmax is given by GGAM",
        "une courbe de G/Gmax se donne par GGAM",
    ),
    "strains-in-percent": Message(
        "G is half of Gmax at a shear strain of {half:g}: no soil is known to stand that",
        "G vaut la moitié de Gmax à une distorsion de {half:g} : aucun sol connu ne va si loin",
        "shear strains are plain numbers: 0.05 % is 5.E-4",
        "les distorsions sont des nombres sans pourcent : 0.05 % s'écrit 5.E-4",
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
    "no-element-on-a-point": Message(
        "no element of this version stands on a point",
        "aucun élément de cette version ne porte sur un point",
    ),
    "mesh-empty": Message(
        "the mesh is empty",
        "le maillage est vide",
    ),
    "formulation-missing": Message(
        "the formulation is not said",
        "la formulation n'est pas dite",
        "MODE mesh 'MECANIQUE' 'ELASTIQUE'",
        "MODE maillage 'MECANIQUE' 'ELASTIQUE'",
    ),
    "only-sure-cells": Message(
        "the mesh holds nothing but SURE cells, which tie hanging nodes",
        "le maillage ne contient que des éléments SURE, qui attachent des noeuds pendants",
    ),
    "element-of-other-cells": Message(
        "element {element} does not stand on {kinds:words} cells",
        "l'élément {element} ne va pas sur des mailles {kinds:words}",
        "{element} needs {cell_type} cells{fitting:?\n{kinds:words} cells take {fitting:words}}",
        "{element} demande des mailles {cell_type}"
        "{fitting:?\nles mailles {kinds:words} prennent {fitting:words}}",
    ),
    "word-unknown": Message(
        "MODE does not know the word {said}",
        "MODE ne connaît pas le mot {said}",
        "{near:?did you mean {near}?|known: {known:words}}"
        "{fitting:?\n{kinds:words} cells take {fitting:words}}",
        "{near:?vouliez-vous dire {near} ?|connus : {known:words}}"
        "{fitting:?\nles mailles {kinds:words} prennent {fitting:words}}",
    ),
    "lists-for-impedance": Message(
        "only IMPEDANCE takes lists of unknowns",
        "seul IMPEDANCE prend des listes d'inconnues",
    ),
    "rule-without-joints": Message(
        "{rule} chooses the integration of joints: the mesh has none",
        "{rule} choisit l'intégration des joints : le maillage n'en a pas",
        "other elements have their own (Q4RI, Q8RI ... by name)",
        "les autres éléments ont la leur (Q4RI, Q8RI ... par leur nom)",
    ),
    "coq3-is-elastic": Message(
        "COQ3 has no plastic law",
        "COQ3 n'a pas de loi plastique",
        "DKT has: MODE ... DKT 'INTEGRE' 7 ;",
        "DKT en a : MODE ... DKT 'INTEGRE' 7 ;",
    ),
    "generalised-plasticity-not-built": Message(
        "plastic laws on the forces and moments of shells are not built",
        "les lois plastiques sur les efforts et moments des coques ne sont pas programmées",
        "points across the thickness: MODE ... DKT 'INTEGRE' 7 ;",
        "des points dans l'épaisseur : MODE ... DKT 'INTEGRE' 7 ;",
    ),
    "points-across": Message(
        "'INTEGRE' {count}: 2 to 15 points across",
        "'INTEGRE' {count} : 2 à 15 points dans l'épaisseur",
    ),
    "adherence-without-equation": Message(
        "the coefficient of adherence ADHE is not built: its notice gives no equation",
        "le coefficient d'adhérence ADHE n'est pas construit : sa notice ne donne pas d'équation",
        "COHE is the cohesion of the sides; a joint JOINT_SDM holds in tension up to FU",
        "COHE est la cohésion des bords ; un joint JOINT_SDM tient en traction jusqu'à FU",
    ),
    "anisotropy-of-two-points": Message(
        "joints {name} have no elasticity ANISOTROPE: of joints, only JOI1 (two points) has it",
        "les joints {name} n'ont pas d'élasticité ANISOTROPE : parmi les joints, seul JOI1 (deux "
        "points) l'a",
    ),
    "law-without-equations": Message(
        "the law {said} is not built: its notice names the parameters {names} and gives no "
        "equation",
        "la loi {said} n'est pas construite : sa notice nomme les paramètres {names} et ne donne "
        "aucune équation",
    ),
    "joint-law-not-built": Message(
        "the joint law {said} is not built: what its parameters BETA (unloading) and CPLG "
        "(coupling) do is published nowhere",
        "la loi de joint {said} n'est pas construite : ce que font ses paramètres BETA "
        "(décharge) et CPLG (couplage) n'est publié nulle part",
        "JOINT_SDM softens in tension with FU and GF; JOINT_DILATANT and COULOMB slide",
        "JOINT_SDM s'adoucit en traction avec FU et GF ; JOINT_DILATANT et COULOMB glissent",
    ),
    "footing-law-not-built": Message(
        "the law {said} of a footing is not built: its plasticity and uplift differ from the "
        "published model (Grange 2008), and no public text says how",
        "la loi de fondation {said} n'est pas construite : sa plasticité et son décollement "
        "diffèrent du modèle publié (Grange 2008), et aucun texte public ne dit comment",
        "MACRO_SEMELLE (LARG, LONG) and MACRO_DISQUE (RAYO) lift off, and yield with COHE; "
        "QULT is a bearing pressure",
        "MACRO_SEMELLE (LARG, LONG) et MACRO_DISQUE (RAYO) se décollent, et plastifient avec "
        "COHE ; QULT est une pression portante",
    ),
    "element-not-in-mode": Message(
        "element {name} does not exist in mode {mode}",
        "l'élément {name} n'existe pas en mode {mode}",
        "it exists in {names}",
        "il existe en {names}",
    ),
    "cells-carry-no-pressure": Message(
        "{cell_type} cells cannot carry a pressure in this space",
        "les éléments {cell_type} ne peuvent porter une pression dans cet espace",
    ),
    "formulation-not-available": Message(
        "the formulation {said} is not available",
        "la formulation {said} n'est pas disponible",
        "'MECANIQUE' 'ELASTIQUE' is, with {words:words}",
        "'MECANIQUE' 'ELASTIQUE' l'est, avec {words:words}",
    ),
    "behaviour-not-available": Message(
        "the behaviour {said} is not available",
        "le comportement {said} n'est pas disponible",
        "'MECANIQUE' 'ELASTIQUE' is, with {words:words}",
        "'MECANIQUE' 'ELASTIQUE' l'est, avec {words:words}",
    ),
    "no-parameter": Message(
        "no parameter is given",
        "aucun paramètre n'est donné",
        "NAME VALUE, such as 'YOUN' 2.E11",
        "NOM VALEUR, comme 'YOUN' 2.E11",
    ),
    "field-not-on-model": Message(
        "the field given for {name} is not defined on the model",
        "le champ donné pour {name} n'est pas défini sur le modèle",
    ),
    "parameter-is-no-model": Message(
        "parameter {name} is no model",
        "le paramètre {name} n'est pas un modèle",
    ),
    "parameter-is-no-nodal-field": Message(
        "parameter {name} is no field at points",
        "le paramètre {name} n'est pas un champ par points",
        "CHAN 'CHAM' makes cells",
        "CHAN 'CHAM' donne un champ par élément",
    ),
    "vect-is-a-vector": Message(
        "VECT takes a vector",
        "VECT prend un vecteur",
        "a POINT such as (0. 1. 0.)",
        "un POINT comme (0. 1. 0.)",
    ),
    "section-model-wrong": Message(
        "MODS takes the model of a section of fibres",
        "MODS prend le modèle d'une section de fibres",
    ),
    "section-material-wrong": Message(
        "MATS takes the material field of a section of fibres",
        "MATS prend le champ de matériau d'une section de fibres",
    ),
    "parameter-unknown": Message(
        "no zone of the model takes a parameter {name}",
        "aucune zone du modèle ne prend le paramètre {name}",
        "{near:?did you mean {near}? }known: {names:words}{told:?\n{told}}",
        "{near:?vouliez-vous dire {near} ? }connus : {names:words}{told:?\n{told}}",
    ),
    "field-has-several-components": Message(
        "the field given for {name} has several components: {names}",
        "le champ donné pour {name} a plusieurs composantes : {names}",
        "take one with EXCO",
        "prenez-en une par EXCO",
    ),
    "no-zone-has-axes": Message(
        "no zone of the model has axes",
        "aucune zone du modèle n'a d'axes",
        "ORTHOTROPE, ANISOTROPE or joints do",
        "ORTHOTROPE, ANISOTROPE ou les joints en ont",
    ),
    "parameter-range": Message(
        "parameter {name} = {wrong:g} is out of its range",
        "le paramètre {name} = {wrong:g} est hors de ses bornes",
        "{text}: {described}",
        "{text}: {described}",
    ),
    "friction-negative": Message(
        "{name} = {value:g}: a coefficient of friction below zero does not bound the shear",
        "{name} = {value:g} : un coefficient de frottement négatif ne borne pas le cisaillement",
        "give it without a sign; {name} = -1. says on purpose that nothing slides",
        "donnez-le sans signe ; {name} = -1. dit exprès que rien ne glisse",
        severity="warning",
    ),
    "friction-as-angle": Message(
        "{name} = {value:g} is an unusually large coefficient of friction",
        "{name} = {value:g} est un coefficient de frottement anormalement grand",
        "{degrees:?of an angle of {value:g} degrees it would be {tangent:.3g}}",
        "{degrees:?d'un angle de {value:g} degrés, ce serait {tangent:.3g}}",
        severity="warning",
    ),
    "no-stiffness": Message(
        "YOUN = 0: these cells resist nothing, and nodes that have no others are held by nothing",
        "YOUN = 0 : ces éléments ne résistent à rien, et les noeuds qui n'en ont pas d'autres ne "
        "sont tenus par rien",
        "leave such bodies out of the model, or give them a small modulus",
        "laissez de tels corps hors du modèle, ou donnez-leur un petit module",
        severity="warning",
    ),
    "unusual-value": Message(
        "{name} = {value:g}{unit:? {unit}} is unusually {small:?small|large}: in {system} it is "
        "usually {low:g} to {high:g}{unit:? {unit}} ({meaning})",
        "{name} = {value:g}{unit:? {unit}} est anormalement {small:?petit|grand} : en {system}, "
        "les valeurs usuelles vont de {low:g} à {high:g}{unit:? {unit}} ({meaning})",
        "{likely:?it looks like {likely:or}: write {written:or}, or correct OPTI 'UNIT' if the "
        "deck is in other units|correct it, or OPTI 'UNIT' if the deck is in other units}",
        "{likely:?cela ressemble à des {likely:or} : écrivez {written:or}, ou corrigez OPTI "
        "'UNIT' si le jeu de données est dans d'autres unités|corrigez-le, ou OPTI 'UNIT' si le "
        "jeu de données est dans d'autres unités}",
    ),
    "parameter-is-a-number": Message(
        "parameter {name} is a number, not a POINT",
        "le paramètre {name} est un nombre, pas un POINT",
    ),
    "contact-needs-dimensions": Message(
        "contact needs the plane or space",
        "le contact demande le plan ou l'espace",
    ),
    "contact-side-cells": Message(
        "a side of contact is made of SEG2 (plane), TRI3 or QUA4 (space), not {bad}",
        "un bord de contact se fait de SEG2 (plan), TRI3 ou QUA4 (espace), pas de {bad}",
    ),
    "cable-friction-needs-dimensions": Message(
        "cables with friction need the plane or space",
        "les câbles frottants demandent le plan ou l'espace",
    ),
    "cable-is-a-line": Message(
        "a cable is a line of SEG2, not of {bad}",
        "un câble est une ligne de SEG2, pas de {bad}",
    ),
    "friction-not-negative": Message(
        "MU and COHE of friction must not be negative",
        "MU et COHE ne peuvent être négatifs",
    ),
    "contact-parameter-varies": Message(
        "{name} varies along a side of contact",
        "{name} varie le long d'un bord de contact",
        "one value for a pair of sides",
        "une seule valeur par paire de bords",
    ),
    "friction-law-missing": Message(
        "the law of friction is not said",
        "la loi de frottement n'est pas dite",
        "FROTTANT COULOMB or FROCABLE",
        "FROTTANT COULOMB ou FROCABLE",
    ),
    "no-zone-behaves": Message(
        "no zone of the model behaves as {words:words}",
        "aucune zone du modèle n'a le comportement {words:words}",
    ),
    "no-zone-has": Message(
        "no zone of the model has {words:words}",
        "aucune zone du modèle n'a {words:words}",
    ),
    "listed-model": Message(
        "MMODEL of {count} {count:zone|zones}", "MMODEL de {count} {count:zone|zones}"
    ),
    "listed-zone": Message(
        "  {number}: {count} {count:cell|cells} {cell_type}, element {element}, {words:words}, "
        "mode {mode}{constituent:?, constituent {constituent}}",
        "  {number} : {count} {count:maille|mailles} {cell_type}, élément {element}, "
        "{words:words}, mode {mode}{constituent:?, constituant {constituent}}",
    ),
}

"""What ssilang/kernel/elements refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-shape-functions": Message(
        "{cell_type} cells have no shape functions",
        "les éléments {cell_type} n'ont pas de fonctions de forme",
    ),
    "vect-along-beam-must": Message(
        "VECT is along the beam: it must show the side of the local axis y",
        "VECT est le long de la poutre : il doit montrer le côté de l'axe local y",
    ),
    "cells-cannot-carry-surface": Message(
        "{cell_type} cells cannot carry a surface load",
        "les éléments {cell_type} ne peuvent porter de charge de surface",
    ),
    "element-no-equivalent-stress": Message(
        "element {element} has no equivalent stress",
        "l'élément {element} n'a pas de contrainte équivalente",
    ),
    "field-none-cells-element": Message(
        "the field has none of {names} on the cells of element {element}",
        "le champ n'a aucune des composantes {names} sur les éléments {element}",
        "it has: {present:?{present}|nothing there}",
        "il a : {present:?{present}|rien à cet endroit}",
    ),
    "principal-of-no-number": Message(
        "the stresses of element {element} are not finite numbers",
        "les contraintes de l'élément {element} ne sont pas des nombres finis",
        "look for a thickness of zero and for cells without length",
        "cherchez une épaisseur nulle et des éléments sans longueur",
    ),
    "element-no-geometric-stiffness": Message(
        "element {element} has no geometric stiffness",
        "l'élément {element} n'a pas de raideur géométrique",
    ),
    "section-no-element": Message(
        "a section has no element {element}",
        "une section n'a pas d'élément {element}",
        "it is made of POJS, TRIS and QUAS",
        "elle est faite de POJS, TRIS et QUAS",
    ),
    "beams-zone-different-sections": Message(
        "the beams of one zone have different sections ({name})",
        "les poutres d'une même zone ont des sections différentes ({name})",
        "give each section a model of its own, and join the models by ET",
        "donner à chaque section son modèle, et réunir les modèles par ET",
    ),
    "finite-motions-not-exist": Message(
        "finite motions do not exist for a Fourier harmonic",
        "les grands mouvements n'existent pas pour une harmonique de Fourier",
    ),
    "field-stands-wanted-stresses": Message(
        "the field stands at '{support}', it is wanted at 'STRESSES'",
        "le champ est en '{support}', il le faut en 'STRESSES'",
    ),
    "stresses-stand-gradients": Message(
        "the stresses stand at '{support}', the gradients at '{other}'",
        "les contraintes sont en '{support}', les gradients en '{other}'",
    ),
    "cells-carry-no-pressure": Message(
        "{cell_type} cells carry no pressure in this space",
        "les éléments {cell_type} ne portent pas de pression dans cet espace",
    ),
    "vector-radius-frame-zero": Message(
        "a vector or radius that gives a frame is zero",
        "un vecteur ou un rayon qui donne un repère est nul",
    ),
    "second-order-strains-not": Message(
        "second-order strains do not exist for a Fourier harmonic",
        "les déformations du second ordre n'existent pas pour une harmonique de Fourier",
    ),
    "hooke-matrices-stand-needed": Message(
        "the Hooke matrices stand at '{found}', they are needed at '{support}'",
        "les matrices de Hooke sont en '{found}', il les faut en '{support}'",
    ),
    "load-along-lines-beams": Message(
        "a load along lines is for beams and bars, not {element}",
        "une charge linéique est pour les poutres et les barres, pas {element}",
    ),
    "field-values-no-outer": Message(
        "the field has values on no outer side of the model",
        "le champ n'a de valeurs sur aucun côté extérieur du modèle",
    ),
    "volume-forces-continuous-elements": Message(
        "volume forces are for continuous elements, not {element}",
        "les forces de volume sont pour les éléments massifs, pas {element}",
        "multiply the mass matrix by the acceleration",
        "multipliez la matrice de masse par l'accélération",
    ),
    "pressure-pipes-not-element": Message(
        "a pressure in pipes is not for element {element}",
        "une pression dans les tuyaux n'est pas pour l'élément {element}",
    ),
    "load-shells-not-element": Message(
        "a load on shells is not for element {element}",
        "une charge sur les coques n'est pas pour l'élément {element}",
    ),
    "shells-off-mesh-exce": Message(
        "shells off their mesh (EXCE) are not available for COQ2",
        "les coques excentrées (EXCE) n'existent pas pour les COQ2",
    ),
    "shell-cell-reaches-across": Message(
        "a shell cell reaches across the axis of revolution",
        "un élément de coque traverse l'axe de révolution",
    ),
    "quadrangle-shell-no-area": Message(
        "a quadrangle of a shell has no area",
        "un quadrangle d'une coque est d'aire nulle",
        "remove it or merge its nodes",
        "ôtez-le ou confondez ses noeuds",
    ),
    "triangle-shell-no-area": Message(
        "a triangle of a shell has no area",
        "un triangle d'une coque est d'aire nulle",
        "remove it or merge its nodes",
        "ôtez-le ou confondez ses noeuds",
    ),
    "element-not-fill-space": Message(
        "element {element} does not fill its space: no projection on it",
        "l'élément {element} n'est pas massif : pas de projection sur lui",
    ),
    "no-cell-mesh-belongs": Message(
        "no cell of the mesh belongs to the model",
        "aucun élément du maillage n'appartient au modèle",
    ),
    "no-cell-mesh-belongs-2": Message(
        "no cell of the mesh belongs to the field's support",
        "aucun élément du maillage n'appartient au support du champ",
    ),
    "field-no-value-cells": Message(
        "the field has no value on the cells of the model",
        "le champ n'a pas de valeur sur les éléments du modèle",
    ),
    "turning-frame-couples-two": Message(
        "a turning frame couples the two parts of a harmonic, which one model does not hold",
        "un repère tournant couple les deux parties d'une harmonique, qu'un seul modèle ne "
        "porte pas",
        "the centrifugal stiffness about the axis is available",
        "la raideur centrifuge autour de l'axe existe",
    ),
    "corotational-damping-beams-space": Message(
        "corotational damping is for beams in space, not {element}",
        "l'amortissement corotatif est pour les poutres en 3D, pas {element}",
    ),
    "gyroscopic-coupling-beams-space": Message(
        "gyroscopic coupling is for beams in space, not {element}",
        "le couplage gyroscopique est pour les poutres en 3D, pas {element}",
    ),
    "element-no-matrices-turning": Message(
        "element {element} has no matrices of turning frames",
        "l'élément {element} n'a pas de matrices de repère tournant",
    ),
    "element-no-strains-second": Message(
        "element {element} has no strains of second order",
        "l'élément {element} n'a pas de déformations du second ordre",
    ),
    "elements-no-shear-strain": Message(
        "{element} elements have no shear strain of their own",
        "les éléments {element} n'ont pas de distorsion propre",
    ),
    "elasticity-not-available-shells": Message(
        "elasticity {kind} is not available for shells ({element})",
        "l'élasticité {kind} n'est pas disponible pour les coques ({element})",
    ),
    "element-no-skin": Message(
        "element {element} has no skin",
        "l'élément {element} n'a pas de peau",
    ),
    "cell-axisymmetric-model-reaches": Message(
        "a cell of an axisymmetric model reaches across the axis",
        "un élément d'un modèle axisymétrique traverse l'axe",
        "the first coordinate is the radius: it must not be negative",
        "la première coordonnée est le rayon : elle ne peut être négative",
    ),
    "vectors-axes-orthotropy-zero": Message(
        "the vectors that give the axes of orthotropy are zero or parallel",
        "les vecteurs qui donnent les axes d'orthotropie sont nuls ou parallèles",
    ),
    "elasticity-not-available-element": Message(
        "elasticity {name} is not available for element {element}",
        "l'élasticité {name} n'est pas disponible pour l'élément {element}",
    ),
    "elasticity-not-available-shb8": Message(
        "elasticity {symmetry_of} is not available for SHB8",
        "l'élasticité {symmetry_of} n'est pas disponible pour les SHB8",
    ),
    "impedance-joins-unknowns": Message(
        "an impedance joins {n_first} unknowns ({first:words}) to {n_second}",
        "une impédance joint {n_first} inconnues ({first:words}) à {n_second}",
        "one name at the second point for each at the first",
        "un nom au second point pour chaque nom au premier",
    ),
    "impedance-not-negative": Message(
        "{name} of an impedance is not negative: {values_min:g}",
        "{name} d'une impédance n'est pas négatif : {values_min:g}",
    ),
    "reduced-damping-amor-impedance": Message(
        "the reduced damping AMOR of an impedance needs its mass MASS",
        "l'amortissement réduit AMOR d'une impédance demande sa masse MASS",
        "a dashpot is given by VISC",
        "un amortisseur se donne par VISC",
    ),
    "field-empty": Message(
        "the field is empty",
        "le champ est vide",
    ),
    "thermal-expansion-joints-not": Message(
        "the thermal expansion of joints is not available",
        "la dilatation thermique des joints n'est pas disponible",
    ),
    "thermal-expansion-sections-fibres": Message(
        "the thermal expansion of sections of fibres is not available",
        "la dilatation thermique des sections de fibres n'existe pas",
        "leave ALPH out of the material of the fibres",
        "ôter ALPH du matériau des fibres",
    ),
    "middle-surface-shell-folds": Message(
        "the middle surface of a shell folds at a node",
        "la surface moyenne d'une coque se replie en un noeud",
    ),
    "curves-points-vary-inside": Message(
        "curves or points that vary inside a cell cannot be moved to other points",
        "des évolutions ou des points qui varient dans un élément ne peuvent être portés en "
        "d'autres points",
        "give them constant in each cell",
        "donnez-les constants par élément",
    ),
    "component-not-defined-cells": Message(
        "component {name} is not defined on all cells of the model's zone",
        "la composante {name} n'est pas définie sur tous les éléments de la zone du modèle",
    ),
    "cells-no-default-element": Message(
        "{cell_type} cells have no default element in mode {mode}",
        "les éléments {cell_type} n'ont pas de formulation par défaut en mode {mode}",
        "{names:?name one of {names}|cells that exist in mode {mode}}",
        "{names:?nommez l'un de {names}|des éléments qui existent en mode {mode}}",
    ),
    "integration-points-not-fix": Message(
        "{n_rule} integration points do not fix the {n_nodes} {n_nodes:value|values} of a "
        "{name} cell",
        "{n_rule} {n_rule:point|points} d'intégration ne fixent pas les {n_nodes} "
        "{n_nodes:valeur|valeurs} d'un élément {name}",
        "give more points in each direction (3 by default)",
        "donner plus de points par direction (3 par défaut)",
    ),
    "field-values-cell-element": Message(
        "a field at '{source}' has {n_values} {n_values:value|values} a cell, element "
        "{element} has {n_matrix} {n_matrix:point|points} there",
        "un champ en '{source}' a {n_values} {n_values:valeur|valeurs} par élément, "
        "l'élément {element} y a {n_matrix} {n_matrix:point|points}",
    ),
    "jacobian-vanishes-changes-sign": Message(
        "the Jacobian vanishes or changes sign inside {n_folded} {n_folded:cell|cells}, the "
        "first being number {first} of its block",
        "le jacobien s'annule ou change de signe dans {n_folded} "
        "{n_folded:élément|éléments}, dont le premier porte le numéro {first} de sa zone",
        "look for flat or folded cells in the mesh",
        "cherchez des éléments plats ou repliés dans le maillage",
    ),
    "beam-cell-zero-length": Message(
        "a beam cell has zero length",
        "un élément de poutre est de longueur nulle",
        "remove it or merge its nodes",
        "ôtez-le ou confondez ses noeuds",
    ),
    "hoop-on-axis": Message(
        "a ring (CERC) has a radius: node {node} lies on the axis",
        "une cerce (CERC) a un rayon : le noeud {node} est sur l'axe",
    ),
    "element-carries-fields-pressures": Message(
        "element {element} carries fields and pressures, it has no stiffness",
        "l'élément {element} porte des champs et des pressions, il n'a pas de rigidité",
        "name another: {others}",
        "nommez-en un autre : {others}",
    ),
    "element-describes-section-beam": Message(
        "element {element} describes the section of a beam and has no unknowns",
        "l'élément {element} décrit la section d'une poutre et n'a pas d'inconnues",
    ),
    "gradient-motion-determinant-not": Message(
        "the gradient of the motion has a determinant that is not positive",
        "le gradient du mouvement a un déterminant qui n'est pas positif",
    ),
    "line-cell-zero-length": Message(
        "a line cell has zero length",
        "un élément de ligne est de longueur nulle",
        "remove it or merge its nodes",
        "ôtez-le ou confondez ses noeuds",
    ),
    "elastic-matrix-element-cannot": Message(
        "the elastic matrix of element {element} cannot be inverted",
        "la matrice élastique de l'élément {element} ne s'inverse pas",
    ),
    "generalised-plane-strain-needs": Message(
        "generalised plane strain needs the point that carries the section's motion",
        "les déformations planes généralisées demandent le point qui porte le mouvement de "
        "la section",
    ),
    "pressure-along-face": Message(
        "{count} {count:shell cell lies|shell cells lie} along the vector of the pressure: to "
        "which side it pushes is not said",
        "{count} {count:élément de coque est parallèle|éléments de coque sont parallèles} au "
        "vecteur de la pression : le côté où elle pousse n'est pas dit",
    ),
    "pressure-component-field": Message(
        "a pressure has one component, this field has {names:?{names}|none}",
        "une pression a une composante, ce champ {names:?a {names}|n'en a aucune}",
    ),
    "volume-force-components-field": Message(
        "a volume force has components {wanted:words}, this field has {given:?{given:words}|none}",
        "une force de volume a pour composantes {wanted:words}, ce champ a "
        "{given:?{given:words}|aucune}",
    ),
    "shell-cell-zero-length": Message(
        "a shell cell has zero length",
        "un élément de coque est de longueur nulle",
        "remove it or merge its nodes",
        "ôtez-le ou confondez ses noeuds",
    ),
    "field-project-must-stand": Message(
        "the field to project must stand at nodes",
        "le champ à projeter doit être aux noeuds",
    ),
    "orthotropic-material-needs-axes": Message(
        "an orthotropic material needs its axes",
        "un matériau orthotrope demande ses axes",
    ),
    "impedance-changes-frequency-no": Message(
        "an impedance {law_of_impedance} that changes with the frequency is no matrix",
        "une impédance {law_of_impedance} qui dépend de la fréquence n'est pas une matrice",
    ),
    "curve-moco-named": Message(
        "a curve of MOCO is named '{said}'",
        "une courbe de MOCO s'appelle '{said}'",
    ),
    "field-no-component": Message(
        "the field has no component {name}: it has {components:?{components}|none}",
        "le champ n'a pas de composante {name} : il a {components:?{components}|rien}",
    ),
    "parameter-missing-element": Message(
        "parameter {name}{instead:? (or {instead} in its place)|} is missing for element {element} "
        "({law})",
        "le paramètre {name}{instead:? (ou {instead} à sa place)|} manque pour l'élément {element} "
        "({law})",
        "{given:?given: {given}|the field of properties holds nothing on these cells}",
        "{given:?sont donnés : {given}|le champ de propriétés ne contient rien sur ces éléments}",
    ),
    "parameter-curve-depends-field": Message(
        "parameter {name} is a curve: it depends on a field",
        "le paramètre {name} est une évolution : il dépend d'un champ",
    ),
    "impedance-no-strains": Message(
        "models IMPEDANCE have no strains",
        "les modèles IMPEDANCE n'ont pas de déformations",
    ),
    "pressure-cells-stands-nodes": Message(
        "a pressure in cells stands at nodes or is constant, this one has {n_values} "
        "{n_values:value|values} a cell",
        "une pression par élément est aux noeuds ou constante, celle-ci a {n_values} "
        "{n_values:valeur|valeurs} par élément",
    ),
    "cells-no-side-cell": Message(
        "{lost} of {n_faces} {cell_type} {n_faces:cell|cells} {lost:is|are} no side of a "
        "cell of the model",
        "{lost} des {n_faces} éléments {cell_type} {lost:n'est|ne sont} le côté d'aucun "
        "élément du modèle",
        "{inside:?give sides of the model's cells|the surface and the model's mesh must "
        "share their nodes}",
        "{inside:?donnez des côtés des éléments du modèle|la surface et le maillage du "
        "modèle doivent avoir les mêmes noeuds}",
    ),
    "work-no-gradients-fourier": Message(
        "there are no gradients of Fourier harmonics here",
        "il n'y a pas ici de gradients des harmoniques de Fourier",
    ),
}

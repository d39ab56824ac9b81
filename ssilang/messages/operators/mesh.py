"""What ssilang/operators/mesh refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "joint-on-itself": Message(
        "both sides of the joint are the same nodes: it never opens, and holds nothing",
        "les deux côtés du joint sont les mêmes noeuds : il ne s'ouvre jamais, et ne tient rien",
        "copy one side before (L2 = L1 PLUS (0. 0.)), and give each body its own",
        "copiez un côté avant (L2 = L1 PLUS (0. 0.)), et donnez le sien à chaque corps",
        severity="warning",
    ),
    "matrix-moved-by-field": Message(
        "a matrix is moved by a vector, not by a field of displacements",
        "une matrice se translate d'un vecteur, pas d'un champ de déplacements",
    ),
    "axis-points": Message(
        "{needed} {needed:point says|points say} where it turns, {n_points} are given",
        "{needed} {needed:point dit|points disent} où l'on tourne, il y en a {n_points}",
    ),
    "no-element-type": Message(
        "no element type is chosen yet",
        "aucun type d'élément n'est encore choisi",
        "set it: OPTI ELEM QUA4 (SEG2, TRI3 ...)",
        "choisissez-le : OPTI ELEM QUA4 (SEG2, TRI3 ...)",
    ),
    "size-not-positive": Message(
        "a mesh size is positive, this one is {size:g}",
        "une taille de maille est positive, pas {size:g}",
    ),
    "curve-length-not-positive": Message(
        "the length of the curve is positive, not {length:g}",
        "la longueur de la courbe est positive, pas {length:g}",
    ),
    "two-surfaces-wanted": Message(
        "a curve is the crossing of two surfaces, {n_surfaces} stand here",
        "une courbe est l'intersection de deux surfaces, il y en a ici {n_surfaces}",
        "'PLAN' P1, 'SPHE' C1, 'CYLI' A1 A2, 'CONI' S1 A1 or 'TORI' C1 A1 C2, twice",
        "'PLAN' P1, 'SPHE' C1, 'CYLI' A1 A2, 'CONI' S1 A1 ou 'TORI' C1 A1 C2, deux fois",
    ),
    "point-off-curve": Message(
        "the point behind {word} is not where the curve ends",
        "le point donné après {word} n'est pas à l'extrémité de la courbe",
    ),
    "no-double-fillet": Message(
        "CONG 'DOUBLE' is not available",
        "CONG 'DOUBLE' n'est pas disponible",
        "draw the two arcs with CERC",
        "tracez les deux arcs par CERC",
    ),
    "radius-not-positive": Message(
        "the radius is positive, this one is {radius:g}",
        "le rayon est positif, celui-ci vaut {radius:g}",
    ),
    "turn-not-whole": Message(
        "ELIM closes a turn of 360 degrees, the angle is {degrees:g}",
        "ELIM ferme un tour de 360 degrés, l'angle est de {degrees:g}",
    ),
    "mesh-as-centre": Message(
        "only the beginning of the line may be a mesh",
        "seul le début de la ligne peut être un maillage",
        "give points",
        "donnez des points",
    ),
    "no-angle-of-segment": Message(
        "a straight line has no angle",
        "un segment de droite n'a pas d'angle",
        "'ROTA' draws arcs",
        "'ROTA' trace des arcs",
    ),
    "points-and-lists": Message(
        "a line goes through points or through lists of coordinates, not both",
        "une ligne passe par des points ou par des listes de coordonnées, non les deux",
    ),
    "coordinate-lists-differ": Message(
        "the lists of coordinates have different lengths",
        "les listes de coordonnées n'ont pas la même longueur",
    ),
    "no-face-to-sweep": Message(
        "this volume has no face {side}",
        "ce volume n'a pas de face {side}",
        "give a surface, or a volume made by sweeping a surface",
        "donnez une surface, ou un volume engendré par une surface",
    ),
    "no-shell": Message(
        "a shell of triangles or quadrangles with an area is needed to thicken it",
        "il faut une coque de triangles ou de quadrangles d'aire non nulle pour l'épaissir",
    ),
    "thickness-missing": Message(
        "the field of thicknesses does not cover the surface",
        "le champ d'épaisseurs ne couvre pas la surface",
    ),
    "six-faces-wanted": Message(
        "a block has six faces, {n_faces} are given",
        "un bloc a six faces, {n_faces} sont données",
    ),
    "lines-wanted": Message(
        "RACC joins lines",
        "RACC relie des lignes",
        "between surfaces use LIAI",
        "entre surfaces, prenez LIAI",
    ),
    "surfaces-wanted": Message(
        "LIAI joins surfaces",
        "LIAI relie des surfaces",
        "between lines use RACC",
        "entre lignes, prenez RACC",
    ),
    "one-size-wanted": Message(
        "the field of sizes has {n_components} {n_components:component|components}, one is needed",
        "le champ de tailles a {n_components} {n_components:composante|composantes}, il en "
        "faut une",
        "EXCO picks one",
        "EXCO en prend une",
    ),
    "refined-before": Message(
        "the mesh has been refined before: its SURE cells tie nodes that a second division "
        "would move",
        "le maillage est déjà raffiné : ses éléments SURE attachent des noeuds qu'une "
        "seconde division déplacerait",
        "refine the first mesh to the sizes wanted in the end",
        "raffiner le premier maillage aux tailles voulues à la fin",
    ),
    "no-size-at-node": Message(
        "no size is given at node {node}",
        "aucune taille n'est donnée au noeud {node}",
        "give the field on the whole mesh",
        "donner le champ sur tout le maillage",
    ),
    "no-change-of-cells": Message(
        "cells of type {cell_type} cannot be changed into {target}",
        "les éléments {cell_type} ne peuvent être changés en {target}",
    ),
    "no-whole-cells": Message(
        "{n_order} {n_order:number does|numbers do} not make whole cells of {size} "
        "{size:point|points}",
        "{n_order} {n_order:numéro ne fait|numéros ne font} pas des éléments entiers de {size} "
        "{size:point|points}",
    ),
    "numbers-beyond-points": Message(
        "the numbers go beyond the {n_ids} {n_ids:point|points} of the mesh",
        "les numéros dépassent les {n_ids} {n_ids:point|points} du maillage",
    ),
    "no-target-type": Message(
        "no element type is chosen yet",
        "aucun type d'élément n'est encore choisi",
        "set it: OPTI ELEM, or name the type",
        "choisissez-le : OPTI ELEM, ou nommez le type",
    ),
    "points-of-cells": Message(
        "a cell {word} needs {size} {size:point|points}, {n_ids} are given",
        "un élément {word} demande {size} {size:point|points}, {n_ids} sont donnés",
    ),
    "no-such-node": Message(
        "there is no node {number}, numbers go from 1 to {n_nodes}",
        "il n'y a pas de noeud {number}, les numéros vont de 1 à {n_nodes}",
    ),
    "no-barycentre": Message(
        "the mesh is empty: it has no barycentre",
        "le maillage est vide : il n'a pas de barycentre",
    ),
    "no-such-node-of-cell": Message(
        "the mesh has no node {number} of element {cell}",
        "le maillage n'a pas de noeud {number} de l'élément {cell}",
    ),
    "no-such-point": Message(
        "point {number} is asked of {n_ids}",
        "le point {number} est demandé, il y en a {n_ids}",
    ),
    "no-junction": Message(
        "no point of the mesh joins more than two elements",
        "aucun point du maillage ne joint plus de deux éléments",
    ),
    "no-point-there": Message(
        "no point of the mesh lies there ({word})",
        "aucun point du maillage n'est à cet endroit ({word})",
        "give a larger distance",
        "donnez une distance plus grande",
    ),
    "no-points": Message(
        "the mesh is empty: it has no points",
        "le maillage est vide : il n'a pas de points",
    ),
    "no-such-coordinate": Message(
        "coordinate {axis} is asked in dimension {dimension}",
        "la coordonnée {axis} est demandée en dimension {dimension}",
    ),
    "no-plane": Message(
        "the three points lie in line and give no plane",
        "les trois points sont alignés et ne donnent pas de plan",
    ),
    "plane-only": Message(
        "VORO works in the plane only",
        "VORO ne travaille que dans le plan",
        "OPTI DIME 2",
        "OPTI DIME 2",
    ),
    "germs-are-points": Message(
        "the germs are a mesh of points (POI1)",
        "les germes sont un maillage de points (POI1)",
        "CHAN 'POI1' mesh",
        "CHAN 'POI1' maillage",
    ),
    "contour-of-segments": Message(
        "the contour is a closed line of SEG2",
        "le contour est une ligne fermée de SEG2",
        "CONT of a surface",
        "CONT d'une surface",
    ),
    "no-sides": Message(
        "this mesh keeps no sides",
        "ce maillage ne garde pas de côtés",
        "pick its cells with ELEM",
        "prenez ses éléments par ELEM",
    ),
    "no-faces": Message(
        "this mesh keeps no faces",
        "ce maillage ne garde pas de faces",
        "pick its cells with ELEM",
        "prenez ses éléments par ELEM",
    ),
    "no-such-side": Message(
        "side {number} is asked of a mesh that has {count}",
        "le côté {number} est demandé d'un maillage qui en a {count}",
    ),
    "no-such-face": Message(
        "face {number} is asked of a mesh that has {count}",
        "la face {number} est demandée d'un maillage qui en a {count}",
    ),
    "sizes-not-positive": Message(
        "a size is missing or not positive at some nodes",
        "une taille manque ou n'est pas positive en certains noeuds",
        "give a field of sizes on all nodes of the mesh",
        "donnez un champ de tailles sur tous les noeuds du maillage",
    ),
    "too-few-rows": Message(
        "{columns} {columns:column|columns} and {rows} {rows:row|rows} make no surface",
        "{columns} {columns:colonne|colonnes} et {rows} {rows:ligne|lignes} ne font pas une "
        "surface",
    ),
    "too-many-points": Message(
        "{columns} {columns:column|columns} and {rows} {rows:row|rows} are {needed} "
        "{needed:point|points}, not {n_points}",
        "{columns} {columns:colonne|colonnes} et {rows} {rows:ligne|lignes} font {needed} "
        "{needed:point|points}, non {n_points}",
    ),
    "no-side-to-sweep": Message(
        "this surface has no side 3 to sweep",
        "cette surface n'a pas de côté 3 à déplacer",
        "sweep a line, or a surface made by sweeping",
        "déplacez une ligne, ou une surface engendrée par déplacement",
    ),
    "no-side-to-reach": Message(
        "this surface has no side 1 to reach",
        "cette surface n'a pas de côté 1 à atteindre",
    ),
    "axis-without-length": Message(
        "the two points of the axis of rotation coincide",
        "les deux points de l'axe de rotation sont confondus",
    ),
    "points-in-excess": Message(
        "{count} {count:point is|points are} needed here, {n_points} are given",
        "il faut ici {count} {count:point|points}, il y en a {n_points}",
    ),
    "nothing-to-copy": Message(
        "nothing is given to transform",
        "rien n'est donné à transformer",
    ),
    "no-such-measure": Message(
        "{what} of a mesh of dimension {dimension} has no meaning",
        "{what} d'un maillage de dimension {dimension} n'a pas de sens",
    ),
    "simplices-wanted": Message(
        "'TOPO' is for a mesh of TRI3 or of TET4 alone",
        "'TOPO' vaut pour un maillage de TRI3 seuls ou de TET4 seuls",
    ),
    "metric-incomplete": Message(
        "the metric lacks {missing:words}",
        "il manque à la métrique {missing:words}",
        "G, or G11 G21 G22 (G31 G32 G33)",
        "G, ou G11 G21 G22 (G31 G32 G33)",
    ),
    "measure-of-other-cells": Message(
        "'{word}' is for {kinds:words}, not for {cell_type}",
        "'{word}' vaut pour {kinds:words}, pas pour {cell_type}",
    ),
    "wanted-length-not-positive": Message(
        "the length wanted must be > 0",
        "la longueur voulue doit être > 0",
    ),
    "no-distance": Message(
        "a distance is needed",
        "il faut une distance",
        "give FLOT1, or set a density with DENS",
        "donnez FLOT1, ou une densité par DENS",
    ),
    "no-contour": Message(
        "the mesh has no contour",
        "le maillage n'a pas de contour",
        "'NOID' allows an empty result",
        "'NOID' permet un résultat vide",
    ),
    "no-envelope": Message(
        "the mesh has no envelope",
        "le maillage n'a pas d'enveloppe",
        "it has no face of one cell only; 'NOID' allows that",
        "il n'a aucune face d'un seul élément ; 'NOID' le permet",
    ),
    "point-outside": Message(
        "the point is outside of all elements of the mesh",
        "le point est hors de tous les éléments du maillage",
        "'NOVE' allows that",
        "'NOVE' le permet",
    ),
    "no-cell-rests": Message(
        "no element of the mesh rests on these points",
        "aucun élément du maillage ne s'appuie sur ces points",
        "check that they belong to the mesh (ELIM), or use 'LARG'; 'NOVE' allows none",
        "vérifiez qu'ils sont du maillage (ELIM), ou prenez 'LARG' ; 'NOVE' permet aucun",
    ),
    "no-cell-of-colour": Message(
        "no element has colour {colour}",
        "aucun élément n'a la couleur {colour}",
        "see OPTI COUL and COUL",
        "voyez OPTI COUL et COUL",
    ),
    "unknown-filter": Message(
        "'{left}' is no element type, colour or keyword of ELEM",
        "'{left}' n'est ni un type d'élément, ni une couleur, ni un mot-clé d'ELEM",
    ),
    "no-such-cell": Message(
        "element {wrong} is asked of {n_cells}",
        "l'élément {wrong} est demandé, il y en a {n_cells}",
    ),
    "none-of-the-components": Message(
        "the field has none of these components",
        "le champ n'a aucune de ces composantes",
    ),
    "no-common-cell": Message(
        "the two meshes have no element in common",
        "les deux maillages n'ont aucun élément commun",
        "'NOVE' allows that",
        "'NOVE' le permet",
    ),
    "no-crossing": Message(
        "the two surfaces do not cross",
        "les deux surfaces ne se croisent pas",
        "'NOVE' allows that",
        "'NOVE' le permet",
    ),
    "closed-triangles-wanted": Message(
        "a closed surface of triangles is needed",
        "il faut une surface fermée de triangles",
        "change it: CHAN 'TRI3'",
        "changez-la : CHAN 'TRI3'",
    ),
    "no-cell-inside": Message(
        "no element lies inside",
        "aucun élément n'est à l'intérieur",
        "'NOID' allows an empty result",
        "'NOID' permet un résultat vide",
    ),
    "nothing-separates": Message(
        "nothing separates",
        "rien ne sépare",
        "say 'FACE', 'LIGN', 'MAIL' MAIL2 or 'ANGL'",
        "dites 'FACE', 'LIGN', 'MAIL' MAIL2 ou 'ANGL'",
    ),
    "no-such-number-of-parts": Message(
        "a mesh is not taken apart into {count} {count:part|parts}",
        "un maillage ne se partage pas en {count} {count:partie|parties}",
    ),
    # ---- what is printed
    "listed": Message(
        "MAILLAGE: {n_cells} {n_cells:cell|cells}, {n_nodes} {n_nodes:node|nodes}, {n_types} "
        "{n_types:type|types}, {n_sides} {n_sides:reference|references}",
        "MAILLAGE : {n_cells} {n_cells:élément|éléments}, {n_nodes} {n_nodes:noeud|noeuds}, "
        "{n_types} {n_types:type|types}, {n_sides} {n_sides:référence|références}",
    ),
    "listed-block": Message(
        " {count} {count:cell|cells} {cell_type} of {n_nodes} {n_nodes:node|nodes}",
        " {count} {count:élément|éléments} {cell_type} de {n_nodes} {n_nodes:noeud|noeuds}",
    ),
    "repeated-cells": Message(
        "VERM: {count} {count:cell stands|cells stand} on the nodes of another one ({name})",
        "VERM : {count} {count:élément est|éléments sont} sur les noeuds d'un autre ({name})",
    ),
    "unmatched-middles": Message(
        "VERM: {count} {count:middle node stands|middle nodes stand} on edges of linear cells "
        "({name})",
        "VERM : {count} {count:noeud milieu est|noeuds milieux sont} sur des arêtes d'éléments "
        "linéaires ({name})",
    ),
    "unfit-faces": Message(
        "VERM: {count} {count:triangular face lies|triangular faces lie} on quadrangular ones "
        "({name})",
        "VERM : {count} {count:face triangulaire est|faces triangulaires sont} sur des faces "
        "quadrangulaires ({name})",
    ),
    "doubles-left": Message(
        "REGENERER: {count} {count:cell still has|cells still have} a double node",
        "REGENERER : {count} {count:élément a|éléments ont} encore un noeud double",
    ),
}

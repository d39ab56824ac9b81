"""What ssilang/kernel/mesh refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-facets-to-project-on": Message(
        "the mesh has neither surfaces nor lines to project on",
        "le maillage n'a ni surfaces ni lignes sur lesquelles projeter",
    ),
    "node-out-of-range": Message(
        "a node would have the coordinate {value:g}",
        "un noeud aurait la coordonnée {value:g}",
        "coordinates are finite numbers below {limit:g}",
        "les coordonnées sont des nombres finis, inférieurs à {limit:g}",
    ),
    "point-opens-cone-lies": Message(
        "the point that opens the cone lies in the plane of its apex",
        "le point qui donne l'ouverture du cône est dans le plan de son sommet",
    ),
    "point-project-apex-projection": Message(
        "a point to project is the apex of the projection",
        "un point à projeter est le sommet de la projection",
    ),
    "first-two-faces-not": Message(
        "the first two faces do not have the same numbers of cells",
        "les deux premières faces n'ont pas les mêmes nombres d'éléments",
    ),
    "six-faces-qua4-qua8": Message(
        "six faces of QUA4, or of QUA8, are needed; these hold {kinds}",
        "il faut six faces de QUA4, ou de QUA8 ; celles-ci contiennent {kinds}",
    ),
    "face-no-grid-quadrangles-2": Message(
        "a face is no grid of quadrangles",
        "une face n'est pas une grille de quadrangles",
    ),
    "side-face-numbers-cells": Message(
        "a side face has other numbers of cells than the rest of the block",
        "une face latérale a d'autres nombres d'éléments que le reste du bloc",
    ),
    "edges-sought-volumes-surfaces": Message(
        "edges are sought on volumes or surfaces, this mesh has none",
        "les arêtes se cherchent sur des volumes ou des surfaces, ce maillage n'en a pas",
    ),
    "contour-encloses-no-area": Message(
        "the contour encloses no area",
        "le contour n'entoure aucune aire",
        "check that its lines form closed loops, in one sense",
        "vérifiez que ses lignes forment des boucles fermées, dans un seul sens",
    ),
    "contour-not-plane-point": Message(
        "the contour is not plane: a point is {off:g} away from its mean plane",
        "le contour n'est pas plan : un point est à {off:g} de son plan moyen",
        "use another kind of surface, or correct the points",
        "prenez une autre surface, ou corrigez",
    ),
    "points-surface-axis-coincide": Message(
        "the points of the surface's axis coincide",
        "les points de l'axe de la surface sont confondus",
    ),
    "contour-goes-through-axis": Message(
        "the contour goes through the axis of the surface",
        "le contour passe par l'axe de la surface",
    ),
    "contour-goes-round-axis": Message(
        "the contour goes all round the axis: the surface cannot be laid flat",
        "le contour fait tout le tour de l'axe : la surface ne se développe pas à plat",
        "make it in two parts",
        "faites-la en deux parties",
    ),
    "contour-both-sides-apex": Message(
        "the contour is on both sides of the apex of the cone",
        "le contour est des deux côtés du sommet du cône",
    ),
    "contour-goes-right-round": Message(
        "the contour goes right round the sphere",
        "le contour fait tout le tour de la sphère",
        "make the surface in two parts",
        "faites la surface en deux parties",
    ),
    "no-polygons-five-sides": Message(
        "no polygons of five sides or more in this mesh",
        "aucun polygone de cinq côtés ou plus dans ce maillage",
    ),
    "cells-type-cannot-changed": Message(
        "cells of type {name} cannot be changed into {target}",
        "les éléments {name} ne peuvent être changés en {target}",
    ),
    "lines-seg2-needed-triangulate": Message(
        "lines of SEG2 are needed to triangulate what they enclose",
        "il faut des lignes de SEG2 pour trianguler ce qu'elles entourent",
    ),
    "lines-enclose-nothing": Message(
        "the lines enclose nothing",
        "les lignes n'entourent rien",
        "a closed contour of SEG2 is needed around",
        "il faut autour un contour fermé de SEG2",
    ),
    "lines-not-plane-point": Message(
        "the lines are not plane: a point is {off:g} away from their mean plane",
        "les lignes ne sont pas planes : un point est à {off:g} de leur plan moyen",
    ),
    "nearest-nodes-neighbours-contour": Message(
        "the nearest nodes, {a} and {b}, are neighbours on the contour",
        "les noeuds les plus proches, {a} et {b}, sont voisins sur le contour",
        "give meshes of which no nodes are neighbours",
        "donner des maillages dont aucun noeud n'est voisin d'un autre",
    ),
    "contour-seg2-needed": Message(
        "a contour of SEG2 is needed",
        "il faut un contour de SEG2",
    ),
    "contour-not-line": Message(
        "the contour is not one line",
        "le contour n'est pas une seule ligne",
        "put several contours one by one",
        "traiter plusieurs contours l'un après l'autre",
    ),
    "mesh-no-node-contour": Message(
        "the {which} mesh has no node on the contour",
        "le maillage ({which}) n'a pas de noeud sur le contour",
    ),
    "two-meshes-same-node": Message(
        "the two meshes have one and the same node on the contour",
        "les deux maillages ont un seul et même noeud sur le contour",
    ),
    "two-ends-curve-same": Message(
        "the two ends of the curve are the same point",
        "les deux extrémités de la courbe sont le même point",
    ),
    "crossing-surfaces-starts-first": Message(
        "the crossing of the surfaces that starts at the first point does not come to the last",
        "l'intersection des surfaces qui part du premier point n'arrive pas au dernier",
        "are both points on the same branch of it?",
        "les deux points sont-ils sur la même branche ?",
    ),
    "two-surfaces-touch-without": Message(
        "the two surfaces touch without crossing at ({x:g}): no curve is defined there",
        "les deux surfaces se touchent sans se croiser en ({x:g}) : aucune courbe n'y est définie",
    ),
    "point-away-surfaces": Message(
        "the {name} point is {off:.3g} away from one of the surfaces",
        "le point {name} est à {off:.3g} de l'une des surfaces",
        "both ends lie on both surfaces",
        "les deux extrémités sont sur les deux surfaces",
    ),
    "two-ends-arc-coincide": Message(
        "the two ends of the arc coincide",
        "les deux extrémités de l'arc sont confondues",
    ),
    "ends-not-same-distance": Message(
        "the ends are not at the same distance of the centre: {r1:g} and {r2:g}",
        "les extrémités ne sont pas à la même distance du centre : {r1:g} et {r2:g}",
        "move the centre or one end",
        "déplacez le centre ou une extrémité",
    ),
    "three-points-line-no": Message(
        "the three points are in line: no circle goes through them",
        "les trois points sont alignés : aucun cercle n'y passe",
    ),
    "two-points-axis-coincide": Message(
        "the two points of the axis coincide",
        "les deux points de l'axe sont confondus",
    ),
    "point-turn-lies-axis": Message(
        "the point to turn lies on the axis",
        "le point à tourner est sur l'axe",
    ),
    "parabola-covers-half-turn": Message(
        "a parabola covers a half turn or more",
        "une parabole couvre un demi-tour ou davantage",
        "ask for more elements",
        "demandez plus d'éléments",
    ),
    "line-seg2-seg3-needed": Message(
        "a line of SEG2 or SEG3 is needed to cut a surface open",
        "il faut une ligne de SEG2 ou de SEG3 pour fendre une surface",
    ),
    "line-branches-node": Message(
        "the line branches at node {ends}",
        "la ligne a un branchement au noeud {ends}",
    ),
    "line-not-separate-cells": Message(
        "the line does not separate any cells of the surface",
        "la ligne ne sépare aucun élément de la surface",
    ),
    "line-not-made-edges": Message(
        "the line is not made of edges of the surface",
        "la ligne n'est pas faite d'arêtes de la surface",
    ),
    "cells-type-no-quadratic": Message(
        "cells of type {cell_type} have no quadratic counterpart here",
        "les éléments {cell_type} n'ont pas ici d'équivalent quadratique",
    ),
    "two-lines-parallel-no": Message(
        "the two lines are parallel: no arc rounds their corner",
        "les deux lignes sont parallèles : aucun arc n'arrondit leur coin",
    ),
    "two-lines-not-meet": Message(
        "the two lines do not meet: they pass {off:g} from one another",
        "les deux lignes ne se rencontrent pas : elles passent à {off:g} l'une de l'autre",
    ),
    "radius-too-large-lines": Message(
        "the radius is too large for the lines",
        "le rayon est trop grand pour les lignes",
        "give a smaller radius",
        "donnez un rayon plus petit",
    ),
    "mesh-empty-no-nodes": Message(
        "the mesh is empty: it has no nodes to move",
        "le maillage est vide : il n'a pas de noeuds à déplacer",
    ),
    "none-master-nodes-belongs": Message(
        "none of the master nodes belongs to the mesh",
        "aucun des noeuds maîtres n'appartient au maillage",
    ),
    "part-mesh-no-master": Message(
        "a part of the mesh has no master node",
        "une partie du maillage n'a pas de noeud maître",
        "give masters in each part",
        "donnez des maîtres dans chaque partie",
    ),
    "mesh-empty-no-line": Message(
        "the mesh is empty: there is no line",
        "le maillage est vide : il n'y a pas de ligne",
    ),
    "line-needed-mesh-holds": Message(
        "a line is needed, this mesh holds {cell_type}",
        "il faut une ligne, ce maillage contient {cell_type}",
    ),
    "four-sides-must-same": Message(
        "the four sides must be of the same type, all SEG2 or all SEG3",
        "les quatre côtés doivent être du même type, tous SEG2 ou tous SEG3",
    ),
    "side-surface-no-length": Message(
        "a side of the surface has no length",
        "un côté de la surface est de longueur nulle",
    ),
    "no-cell-first-mesh": Message(
        "no cell of the first mesh faces a cell of the second within {tolerance:g}",
        "aucun élément du premier maillage n'est en face d'un élément du second à moins de "
        "{tolerance:g}",
        "check that the two meshes correspond, or give a larger distance",
        "vérifiez que les deux maillages se correspondent, ou donnez une distance plus grande",
    ),
    "sides-do-not-fit": Message(
        "the two sides are joined over {surface:?an area|a length} of {joined:.4g} only: over "
        "{apart:.4g} more they face each other within {tolerance:g}, but {n_first} "
        "{n_first:cell|cells} of the first and {n_second} of the second do not fit, the first of "
        "them around ({place})",
        "les deux côtés ne sont joints que sur une {surface:?aire|longueur} de {joined:.4g} : sur "
        "{apart:.4g} de plus ils se font face à moins de {tolerance:g}, mais {n_first} "
        "{n_first:élément|éléments} du premier et {n_second} du second ne se correspondent pas, "
        "autour de ({place}) d'abord",
        "give both sides the same nodes",
        "donnez les mêmes noeuds aux deux côtés",
    ),
    "no-two-boundaries-inside": Message(
        "no two boundaries inside the mesh face each other within {tolerance:g}",
        "aucune paire de bords du maillage ne se fait face à moins de {tolerance:g}",
        "the parts must touch without sharing nodes",
        "les parties doivent se toucher sans noeuds communs",
    ),
    "no-joint-cell-made": Message(
        "no joint cell can be made on cells of type {cell_type}",
        "aucun élément de joint ne se fait sur des éléments {cell_type}",
    ),
    "line-needs-points-got": Message(
        "a line needs {quadratic:?an odd number of|two or more} points, got {n_chain}",
        "une ligne demande {quadratic:?un nombre impair de|au moins deux} points, "
        "elle en a reçu {n_chain}",
    ),
    "line-starts-ends-same": Message(
        "the line starts and ends at the same node {start}",
        "la ligne commence et finit au même noeud {start}",
        "give another end point",
        "donnez un autre point d'arrivée",
    ),
    "line-set-points-needed": Message(
        "a line or a set of points is needed to have a first and a last point",
        "il faut une ligne ou un ensemble de points pour avoir un premier et un dernier point",
    ),
    "sizes-wanted-positive": Message(
        "the sizes wanted are positive",
        "les tailles voulues sont positives",
        "the least is {sizes_min:g}",
        "la plus petite vaut {sizes_min:g}",
    ),
    "about-cells-needed": Message(
        "about {total:.1e} cells are needed",
        "il faudrait environ {total:.1e} éléments",
        "wish larger sizes",
        "demander de plus grandes tailles",
    ),
    "mesh-sizes-measured-edges": Message(
        "mesh sizes are measured on edges, this mesh has none",
        "les tailles de maille se mesurent sur des arêtes, ce maillage n'en a pas",
    ),
    "area-inside-line-asked": Message(
        "the area inside a line is asked of a mesh that is not a line",
        "l'aire intérieure à une ligne est demandée à un maillage qui n'est pas une ligne",
    ),
    "volume-inside-surface-asked": Message(
        "the volume inside a surface is asked of a mesh that is not a surface",
        "le volume intérieur à une surface est demandé à un maillage qui n'est pas une surface",
    ),
    "angles-lines-surfaces-mesh": Message(
        "angles are those of lines and surfaces, the mesh holds volumes",
        "les angles sont ceux de lignes et de surfaces, le maillage contient des volumes",
    ),
    "two-points-not-ends": Message(
        "the two points are not ends of cells of the line",
        "les deux points ne sont pas des extrémités d'éléments de la ligne",
    ),
    "no-way-leads-along": Message(
        "no way leads along the line from one point to the other",
        "aucun chemin ne mène d'un point à l'autre le long de la ligne",
    ),
    "two-opposite-sides-surface": Message(
        "two opposite sides of the surface have no length",
        "deux côtés opposés de la surface sont de longueur nulle",
    ),
    "mesh-empty-nothing-triangulate": Message(
        "the mesh is empty: there is nothing to triangulate",
        "le maillage est vide : il n'y a rien à trianguler",
    ),
    "points-too-few-line": Message(
        "the points are too few, or all in one line or plane",
        "les points sont trop peu nombreux, ou tous sur une droite ou dans un plan",
    ),
    "no-weights-keep-triangles": Message(
        "no weights keep the triangles of the surface",
        "aucun poids ne garde les triangles de la surface",
    ),
    "two-points-line-part": Message(
        "the two points of the line's part are the same",
        "les deux points de la partie de ligne sont confondus",
    ),
    "node-no-end-cell": Message(
        "node {node} is no end of a cell of the line",
        "le noeud {node} n'est pas l'extrémité d'un élément de la ligne",
    ),
    "mesh-empty-no-nearest": Message(
        "the mesh is empty: it has no nearest point",
        "le maillage est vide : il n'a pas de point le plus proche",
    ),
    "contour-encloses-no-area-2": Message(
        "the contour encloses no area",
        "le contour n'entoure aucune aire",
    ),
    "contour-made-lines-needed": Message(
        "a contour made of lines is needed",
        "il faut un contour fait de lignes",
    ),
    "mesh-volume-cells-needed": Message(
        "a mesh with volume cells is needed",
        "il faut un maillage avec des éléments de volume",
    ),
    "mesh-distances-taken-empty": Message(
        "the mesh that distances are taken to is empty",
        "le maillage auquel se prennent les distances est vide",
    ),
    "front-not-made-sides": Message(
        "the front is not made of sides of the surface",
        "le front n'est pas fait de côtés de la surface",
    ),
    "two-lines-same-nothing": Message(
        "the two lines are the same: there is nothing between them",
        "les deux lignes sont la même : il n'y a rien entre elles",
    ),
    "no-cell-mesh-away": Message(
        "no cell of the mesh is away from the point",
        "aucun élément du maillage n'est à l'écart du point",
    ),
    "cells-type-cannot-joined": Message(
        "cells of type {cell_type} cannot be joined to a point",
        "des éléments {cell_type} ne peuvent être joints à un point",
    ),
    "path-zero-length-cannot": Message(
        "a path of zero length cannot be cut by mesh sizes",
        "un chemin de longueur nulle ne se découpe pas en mailles",
    ),
    "mesh-sizes-ask-elements": Message(
        "the mesh sizes ask for {wanted:.3g} elements on one line",
        "les tailles de maille demandent {wanted:.3g} éléments sur une ligne",
    ),
    "triangle-surface-cuts-cannot": Message(
        "a triangle that the other surface cuts cannot be meshed",
        "un triangle que l'autre surface coupe ne peut être maillé",
        "refine the meshes",
        "raffinez les maillages",
    ),
    "two-points-axis-rotation": Message(
        "the two points of the axis of rotation coincide",
        "les deux points de l'axe de rotation sont confondus",
    ),
    "line-needed-sweep-surface": Message(
        "a line is needed to sweep a surface, this mesh holds {cell_type}",
        "il faut une ligne pour engendrer une surface, ce maillage contient {cell_type}",
    ),
    "list-layer-positions-needs": Message(
        "a list of layer positions needs two or more values, the ends different",
        "une liste de positions de couches demande deux valeurs ou plus, les extrêmes différentes",
    ),
    "mesh-empty": Message(
        "the mesh is empty",
        "le maillage est vide",
    ),
    "no-volume-swept-cells": Message(
        "no volume can be swept by cells of type {cell_type}",
        "aucun volume ne s'engendre d'éléments {cell_type}",
    ),
    "triangles-surface-cannot-kept": Message(
        "{n_lost} triangles of the surface cannot be kept in the volume's mesh",
        "{n_lost} triangles de la surface ne peuvent être gardés dans le maillage du volume",
        "make the surface's mesh finer or more regular where it is thin, or sweep the volume",
        "affinez le maillage de la surface ou rendez-le plus régulier là où le volume est "
        "mince, ou engendrez le volume par déplacement",
    ),
    "surface-asks-more-ten": Message(
        "the surface asks for more than ten million points inside",
        "la surface demande plus de dix millions de points intérieurs",
    ),
    "points-surface-cannot-triangulated": Message(
        "the points of the surface cannot be triangulated",
        "les points de la surface ne peuvent être triangulés",
    ),
    "node-not-belong-mesh": Message(
        "node {ids} does not belong to the mesh that gives the transformation",
        "le noeud {ids} n'appartient pas au maillage qui donne la transformation",
    ),
    "map-takes-many-points": Message(
        "the map takes as many points as it gives, one at least: got {n_old} and {n_new}",
        "la transformation prend autant de points qu'elle en donne, un au moins : trouvé "
        "{n_old} et {n_new}",
    ),
    "most-points-define-map": Message(
        "at most {dimension} points define the map, got {n_old}",
        "au plus {dimension} points définissent la transformation, trouvé {n_old}",
    ),
    "points-define-map-line": Message(
        "the points that define the map are in line or coincide",
        "les points qui définissent la transformation sont alignés ou confondus",
    ),
    "contour-crosses-itself": Message(
        "the contour crosses itself",
        "le contour se recoupe",
    ),
    "points-contour-cannot-triangulated": Message(
        "the points of the contour cannot be triangulated",
        "les points du contour ne peuvent être triangulés",
    ),
    "two-weights-differ-too": Message(
        "two weights differ by too much: a germ would lie outside of its cell",
        "deux poids diffèrent trop : un germe serait hors de sa cellule",
        "squares of weights differ by the square of the germs' distance at most",
        "les carrés des poids diffèrent au plus du carré de la distance des germes",
    ),
    "two-points-line-coincide": Message(
        "the two points of the line coincide",
        "les deux points de la droite sont confondus",
    ),
    "three-points-plane-line": Message(
        "the three points of the plane are in line",
        "les trois points du plan sont alignés",
    ),
    "apex-axis-point-coincide": Message(
        "the apex and the axis point coincide",
        "le sommet et le point de l'axe sont confondus",
    ),
    "two-points-torus-axis": Message(
        "the two points of the torus's axis coincide",
        "les deux points de l'axe du tore sont confondus",
    ),
    "direction-projection-zero": Message(
        "the direction of projection is zero",
        "la direction de projection est nulle",
    ),
    "two-points-direction-coincide": Message(
        "the two points that give the direction coincide",
        "les deux points qui donnent la direction sont confondus",
    ),
    "axis-cylindrical-coordinates-no": Message(
        "the axis of the cylindrical coordinates has no length",
        "l'axe des coordonnées cylindriques est de longueur nulle",
    ),
    "point-theta-lies-axis": Message(
        "the point that gives theta = 0 lies on the axis",
        "le point qui donne theta = 0 est sur l'axe",
    ),
    "face-no-grid-quadrangles": Message(
        "a face is no grid of quadrangles: it has {n_corners} {n_corners:corner|corners}, not 4",
        "une face n'est pas une grille de quadrangles : elle a {n_corners} "
        "{n_corners:coin|coins}, pas 4",
    ),
    "mesh-not-halved-parts": Message(
        "a mesh is not halved into {count} parts",
        "un maillage ne se coupe pas en {count} {count:partie|parties} par moitiés",
        "say 2, 4, 8 ...",
        "dites 2, 4, 8 ...",
    ),
    "point-end-segments-line": Message(
        "the point is an end of {n_touching} {n_touching:segment|segments} of the line, not of 1",
        "le point est l'extrémité de {n_touching} {n_touching:segment|segments} de la ligne, "
        "pas d'un seul",
    ),
    "mesh-cell-type-needed": Message(
        "a mesh of one cell type is needed, this one holds {kinds:?{kinds}|nothing}",
        "il faut un maillage d'un seul type d'élément, celui-ci {kinds:?contient {kinds}|est vide}",
    ),
    "line-seg2-seg3-needed-2": Message(
        "a line of SEG2 or SEG3 is needed, this mesh holds {kinds:?{kinds}|nothing}",
        "il faut une ligne de SEG2 ou de SEG3, ce maillage {kinds:?contient {kinds}|est vide}",
    ),
    "contour-seg2-seg3-needed": Message(
        "a contour of SEG2 or of SEG3 is needed, this mesh holds {kinds:?{kinds}|nothing}",
        "il faut un contour de SEG2 ou de SEG3, ce maillage {kinds:?contient {kinds}|est vide}",
    ),
    "no-mesh-holds": Message(
        "no {cell_type} in this mesh, which holds {kinds:?{kinds}|nothing}",
        "pas de {cell_type} dans ce maillage, qui {kinds:?contient {kinds}|est vide}",
    ),
    "two-meshes-not-same": Message(
        "the two meshes do not have the same structure: {first:?{first}|nothing} and "
        "{second:?{second}|nothing}",
        "les deux maillages n'ont pas la même structure : {first:?{first}|rien} et "
        "{second:?{second}|rien}",
        "they need the same cells in the same order",
        "il leur faut les mêmes éléments dans le même ordre",
    ),
    "distances-taken-not": Message(
        "distances are taken to {plane:?segments SEG2 in 2D|triangles TRI3 or quadrangles "
        "QUA4 in 3D}, not to {cell_type}",
        "les distances se prennent à {plane:?des segments SEG2 en 2D|des triangles TRI3 ou "
        "des quadrangles QUA4 en 3D}, pas à {cell_type}",
    ),
    "several-cells-node-line": Message(
        "several cells {ending:?end|start} at node {node}: the line branches there",
        "plusieurs éléments {ending:?finissent|commencent} au noeud {node} : la ligne y a un "
        "branchement",
    ),
    "cells-type-flat": Message(
        "{n_flat} {n_flat:cell|cells} of type {cell_type} {n_flat:is|are} flat",
        "{n_flat} {n_flat:élément|éléments} de type {cell_type} {n_flat:est plat|sont plats}",
    ),
    "point-no-projection-surface": Message(
        "{n_lost} {n_lost:point has|points have} no projection on the surface, the first at "
        "({x:g})",
        "{n_lost} {n_lost:point n'a|points n'ont} pas de projection sur la surface, le "
        "premier en ({x:g})",
        "check the direction or the apex of the projection",
        "vérifiez la direction ou le sommet de la projection",
    ),
    "four-side-faces-not": Message(
        "the four side faces do not lead from the first face to the second",
        "les quatre faces latérales ne mènent pas de la première face à la seconde",
    ),
    "centre-two-ends-line": Message(
        "the centre and the two ends are in line: there is no shorter arc",
        "le centre et les deux extrémités sont alignés : aucun arc n'est le plus court",
    ),
    "no-mesh-made-elements": Message(
        "no mesh can be made of {element} elements",
        "aucun maillage ne se fait d'éléments {element}",
    ),
    "no-surface-made-elements": Message(
        "no surface can be made of {line} elements",
        "aucune surface ne se fait d'éléments {line}",
    ),
    "cells-type-cannot-follow": Message(
        "cells of type {cell_type} cannot follow",
        "les éléments de type {cell_type} ne peuvent pas suivre",
    ),
    "four-sides-not-form": Message(
        "the four sides do not form a closed contour, one after the other",
        "les quatre côtés ne forment pas, l'un après l'autre, un contour fermé",
    ),
    "facing-cells-paired-within": Message(
        "facing cells are paired within a positive distance",
        "les éléments en face se cherchent à une distance positive",
    ),
    "line-cells-not-follow": Message(
        "the line's cells do not follow one another{twice:?: two nodes are at ({twice}), the ends "
        "of two parts}",
        "les éléments de la ligne ne se suivent pas{twice:? : deux noeuds sont en ({twice}), les "
        "bouts de deux parties}",
    ),
    "cells-not-divided": Message(
        "{cell_type} cells are not divided",
        "les éléments {cell_type} ne se divisent pas",
        "{value:words} are",
        "{value:words} se divisent",
    ),
    "nodes-merged-within-positive": Message(
        "nodes are merged within a positive distance",
        "les noeuds se confondent à une distance positive",
    ),
    "mesh-size-not-set": Message(
        "the mesh size is not set",
        "la taille de maille n'est pas fixée",
    ),
    "mesh-sizes-must-positive": Message(
        "mesh sizes must be positive, got {start_size:g} and {end_size:g}",
        "les tailles de maille doivent être positives, trouvé {start_size:g} et {end_size:g}",
    ),
    "polygons-straight-sides-contour": Message(
        "polygons have straight sides, the contour is of SEG3",
        "les polygones ont des côtés droits, le contour est en SEG3",
    ),
    "lines-contour-not-run": Message(
        "the lines of the contour do not all run in the same sense",
        "les lignes du contour ne vont pas toutes dans le même sens",
    ),
    "contour-crosses-itself-two": Message(
        "the contour crosses itself, or two of its lines cross",
        "le contour se recoupe, ou deux de ses lignes se croisent",
    ),
    "side-contour-passes-through": Message(
        "a side of the contour passes through another point or side of it",
        "un côté du contour passe par un autre de ses points ou de ses côtés",
        "look for crossing lines or coincident points",
        "cherchez des lignes qui se croisent ou des points au même endroit",
    ),
    "volume-filled-tri3-qua4": Message(
        "a volume is filled from TRI3 and QUA4, or from TRI6 and QUA8; this surface holds "
        "{kinds:?{kinds}|nothing}",
        "un volume se remplit à partir de TRI3 et QUA4, ou de TRI6 et QUA8 ; cette surface "
        "contient "
        "{kinds:?{kinds}|rien}",
    ),
    "germ-lies-outside-contour": Message(
        "a germ lies outside of the contour",
        "un germe est hors du contour",
    ),
    "two-germs-lie-same": Message(
        "two germs lie at the same place",
        "deux germes sont au même endroit",
        "merge them",
        "confondez-les",
    ),
    "surfaces-tri3-needed-cross": Message(
        "surfaces of TRI3 are needed to cross, this mesh holds {kinds:?{kinds}|nothing}",
        "il faut des surfaces de TRI3 à croiser, ce maillage {kinds:?contient {kinds}|est vide}",
    ),
    "adjacent-cells-described-opposite": Message(
        "adjacent cells are described in opposite senses, at {nodes:node|nodes} {nodes}",
        "des éléments voisins sont décrits en sens opposés, {nodes:au noeud|aux noeuds} {nodes}",
    ),
    "contour-not-closed-line": Message(
        "the contour is not closed: a line ends at {nodes:node|nodes} {nodes}",
        "le contour n'est pas fermé : une ligne s'arrête {nodes:au noeud|aux noeuds} {nodes}",
        "close it, or merge coincident points",
        "fermez-le, ou confondez les points au même endroit",
    ),
    "surface-not-closed-sides": Message(
        "the surface is not closed: {lone} {lone:side belongs|sides belong} to one face "
        "only, one near ({where:g})",
        "la surface n'est pas fermée : {lone} {lone:côté n'a|côtés n'ont} qu'une face, l'un "
        "près de ({where:g})",
        "merge coincident points, and check that no face is missing",
        "confondez les points au même endroit, et vérifiez qu'aucune face ne manque",
    ),
}

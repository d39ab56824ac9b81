"""French sentences for the errors of meshes and of models, by their English ones."""

from __future__ import annotations

MESHES: tuple[tuple[str, str], ...] = (
    # ---- lines and their sizes
    ("no element type is chosen yet", "aucun type d'élément n'est encore choisi"),
    ("set it: OPTI ELEM QUA4 (SEG2, TRI3 ...)", "choisissez-le : OPTI ELEM QUA4 (SEG2, TRI3 ...)"),
    ("set it: OPTI ELEM, or name the type", "choisissez-le : OPTI ELEM, ou nommez le type"),
    (
        "mesh sizes must be positive, got {} and {}",
        "les tailles de maille doivent être positives, trouvé {} et {}",
    ),
    (
        "give the number of elements (an ENTIER: 10, not 10.), or set sizes with DENS, DINI and "
        "DFIN",
        "donnez le nombre d'éléments (un ENTIER : 10, pas 10.), ou des tailles par DENS, DINI et "
        "DFIN",
    ),
    (
        "a path of zero length cannot be cut by mesh sizes",
        "un chemin de longueur nulle ne se découpe pas en mailles",
    ),
    (
        "the mesh sizes ask for {} elements on one line",
        "les tailles de maille demandent {} éléments sur une ligne",
    ),
    ("a mesh size is positive, this one is {}", "une taille de maille est positive, pas {}"),
    (
        "the line starts and ends at the same node {}",
        "la ligne commence et finit au même noeud {}",
    ),
    ("give another end point", "donnez un autre point d'arrivée"),
    (
        "a line of SEG2 or SEG3 is needed, this mesh holds {}",
        "il faut une ligne de SEG2 ou de SEG3, ce maillage contient {}",
    ),
    ("a line is needed, this mesh holds {}", "il faut une ligne, ce maillage contient {}"),
    (
        "a line is needed to sweep a surface, this mesh holds {}",
        "il faut une ligne pour engendrer une surface, ce maillage contient {}",
    ),
    ("the line's cells do not follow one another", "les éléments de la ligne ne se suivent pas"),
    (
        "join its parts with ET, and turn the reversed ones with INVE",
        "réunissez ses parties par ET, et retournez par INVE celles qui sont inversées",
    ),
    ("the two ends of the arc coincide", "les deux extrémités de l'arc sont confondues"),
    (
        "the ends are not at the same distance of the centre: {} and {}",
        "les extrémités ne sont pas à la même distance du centre : {} et {}",
    ),
    ("move the centre or one end", "déplacez le centre ou une extrémité"),
    (
        "the centre and the two ends are in line: there is no shorter arc",
        "le centre et les deux extrémités sont alignés : aucun arc n'est le plus court",
    ),
    (
        "make a half circle with CERC 'ROTA' or in two arcs",
        "faites un demi-cercle par CERC 'ROTA' ou en deux arcs",
    ),
    (
        "the three points are in line: no circle goes through them",
        "les trois points sont alignés : aucun cercle n'y passe",
    ),
    (
        "the lists of coordinates have different lengths",
        "les listes de coordonnées n'ont pas la même longueur",
    ),
    # ---- surfaces
    ("no mesh can be made of {} elements", "aucun maillage ne se fait d'éléments {}"),
    ("no surface can be made of {} elements", "aucune surface ne se fait d'éléments {}"),
    (
        "choose a surface element first: OPTI ELEM QUA4 (or TRI3, QUA8, TRI6)",
        "choisissez d'abord un élément de surface : OPTI ELEM QUA4 (ou TRI3, QUA8, TRI6)",
    ),
    (
        "the four sides do not form a closed contour, one after the other",
        "les quatre côtés ne forment pas, l'un après l'autre, un contour fermé",
    ),
    (
        "merge their common points with ELIM, or change their order",
        "confondez leurs points communs par ELIM, ou changez leur ordre",
    ),
    (
        "the four sides must be of the same type, all SEG2 or all SEG3",
        "les quatre côtés doivent être du même type, tous SEG2 ou tous SEG3",
    ),
    (
        "a contour of SEG2 or of SEG3 is needed, this mesh holds {}",
        "il faut un contour de SEG2 ou de SEG3, ce maillage contient {}",
    ),
    (
        "the contour is not closed: a line ends at node(s) {}",
        "le contour n'est pas fermé : une ligne s'arrête à : noeud(s) {}",
    ),
    (
        "close it, or merge coincident points with ELIM",
        "fermez-le, ou confondez par ELIM les points au même endroit",
    ),
    (
        "the lines of the contour do not all run in the same sense",
        "les lignes du contour ne vont pas toutes dans le même sens",
    ),
    ("turn some with INVE", "retournez-en par INVE"),
    ("the contour crosses itself", "le contour se recoupe"),
    (
        "the contour crosses itself, or two of its lines cross",
        "le contour se recoupe, ou deux de ses lignes se croisent",
    ),
    ("look at it with TRAC", "regardez-le par TRAC"),
    (
        "a side of the contour passes through another point or side of it",
        "un côté du contour passe par un autre de ses points ou de ses côtés",
    ),
    (
        "look for crossing lines or coincident points (ELIM)",
        "cherchez des lignes qui se croisent ou des points confondus (ELIM)",
    ),
    ("the contour encloses no area", "le contour n'entoure aucune aire"),
    (
        "check that its lines form closed loops, in one sense",
        "vérifiez que ses lignes forment des boucles fermées, dans un seul sens",
    ),
    (
        "the contour is not plane: a point is {} away from its mean plane",
        "le contour n'est pas plan : un point est à {} de son plan moyen",
    ),
    ("use another kind of surface, or correct the points", "prenez une autre surface, ou corrigez"),
    ("side {} is asked of a mesh that has {}", "le côté {} est demandé à un maillage qui en a {}"),
    ("this surface has no side 3 to sweep", "cette surface n'a pas de côté 3 à déplacer"),
    (
        "sweep a line, or a surface made by sweeping",
        "déplacez une ligne, ou une surface engendrée par déplacement",
    ),
    (
        "the two meshes do not have the same structure: {} and {}",
        "les deux maillages n'ont pas la même structure : {} et {}",
    ),
    (
        "they need the same cells in the same order",
        "il leur faut les mêmes éléments dans le même ordre",
    ),
    (
        "adjacent cells are described in opposite senses, at node(s) {}",
        "des éléments voisins sont décrits en sens opposés, à : noeud(s) {}",
    ),
    ("turn one of the parts with INVE, or use ORIE", "retournez une partie par INVE, ou ORIE"),
    # ---- volumes
    ("this volume has no face {}", "ce volume n'a pas de face {}"),
    (
        "give a surface, or a volume made by sweeping a surface",
        "donnez une surface, ou un volume engendré par une surface",
    ),
    (
        "the surface is not closed: {} sides belong to one face only, one near ({})",
        "la surface n'est pas fermée : {} côtés n'ont qu'une face, l'un près de ({})",
    ),
    (
        "merge coincident points with ELIM, and check that no face is missing",
        "confondez par ELIM les points au même endroit, et vérifiez qu'aucune face ne manque",
    ),
    ("no volume can be swept by cells of type {}", "aucun volume ne s'engendre d'éléments {}"),
    # ---- facing meshes, common points
    ("RACC joins lines", "RACC relie des lignes"),
    ("between surfaces use LIAI", "entre surfaces, prenez LIAI"),
    ("LIAI joins surfaces", "LIAI relie des surfaces"),
    ("between lines use RACC", "entre lignes, prenez RACC"),
    (
        "no cell of the first mesh faces a cell of the second within {}",
        "aucun élément du premier maillage n'est en face d'un élément du second à moins de {}",
    ),
    (
        "check that the two meshes correspond, or give a larger distance",
        "vérifiez que les deux maillages se correspondent, ou donnez une distance plus grande",
    ),
    (
        "facing cells are paired within a positive distance",
        "les éléments en face se cherchent à une distance positive",
    ),
    (
        "nodes are merged within a positive distance",
        "les noeuds se confondent à une distance positive",
    ),
    (
        "give the distance, or set the density (DENS) whose tenth is taken",
        "donnez la distance, ou une densité (DENS) dont le dixième est pris",
    ),
    ("a distance is needed", "il faut une distance"),
    ("give FLOT1, or set a density with DENS", "donnez FLOT1, ou une densité par DENS"),
    # ---- picking
    ("the mesh has no contour", "le maillage n'a pas de contour"),
    ("the mesh has no envelope", "le maillage n'a pas d'enveloppe"),
    ("the mesh is empty", "le maillage est vide"),
    ("no {} in this mesh, which holds {}", "pas de {} dans ce maillage, qui contient {}"),
    (
        "'{}' is no element type, colour or keyword of ELEM",
        "'{}' n'est ni un type d'élément, ni une couleur, ni un mot-clé d'ELEM",
    ),
    ("no element has colour {}", "aucun élément n'a la couleur {}"),
    ("element {} is asked of {}", "l'élément {} est demandé, il y en a {}"),
    (
        "no element of the mesh rests on these points",
        "aucun élément du maillage ne s'appuie sur ces points",
    ),
    (
        "check that they belong to the mesh (ELIM), or use 'LARG'; 'NOVE' allows none",
        "vérifiez qu'ils sont du maillage (ELIM), ou prenez 'LARG' ; 'NOVE' permet aucun",
    ),
    ("the two meshes have no element in common", "les deux maillages n'ont aucun élément commun"),
    ("point {} is asked of {}", "le point {} est demandé, il y en a {}"),
    (
        "there is no node {}, numbers go from 1 to {}",
        "il n'y a pas de noeud {}, les numéros vont de 1 à {}",
    ),
    ("no point of the mesh lies there ({})", "aucun point du maillage n'est à cet endroit ({})"),
    ("give a larger distance", "donnez une distance plus grande"),
    (
        "{} of {} {} cells are no side of a cell of the model",
        "{} éléments sur {} {} ne sont le côté d'aucun élément du modèle",
    ),
    (
        "the surface and the model's mesh must share their nodes (ELIM)",
        "la surface et le maillage du modèle doivent avoir les mêmes noeuds (ELIM)",
    ),
    (
        "give sides of the model's cells: lines of a surface (CONT, COTE), faces of a volume "
        "(ENVE, FACE)",
        "donnez des côtés des éléments du modèle : lignes d'une surface (CONT, COTE), faces d'un "
        "volume (ENVE, FACE)",
    ),
    # ---- joints, supports
    (
        "the step {} s does not resolve contact, whose half period is {} s with the mass attached "
        "to the joints",
        "le pas {} s ne résout pas le contact, dont la demi-période est {} s avec la masse liée "
        "aux joints",
    ),
    (
        "a line or face made twice has new nodes: name it once and use the name (BAS = P1 D P2 ;), "
        "take a part of the mesh (POIN, COTE), or join both with ELIM",
        "une ligne ou une face faite deux fois a de nouveaux noeuds : nommez-la une fois "
        "(BAS = P1 D P2 ;), prenez une partie du maillage (POIN, COTE), ou réunissez par ELIM",
    ),
    (
        "dt <= T_c/30 = {} s keeps energy; or CONSERVATIF, a softer joint",
        "dt <= T_c/30 = {} s conserve l'énergie ; ou CONSERVATIF, un joint plus souple",
    ),
    # ---- models and fields
    ("no zone of the model takes a parameter {}", "aucune zone du modèle ne prend le paramètre {}"),
    ("known: {}", "connus : {}"),
    (
        "{} cells have no default element in mode {}",
        "les éléments {} n'ont pas de formulation par défaut en mode {}",
    ),
    ("name one of {}", "nommez l'un de {}"),
    ("the formulation is not said", "la formulation n'est pas dite"),
    ("element {} does not exist in mode {}", "l'élément {} n'existe pas en mode {}"),
    ("it exists in {}", "il existe en {}"),
    ("the field has no component {}", "le champ n'a pas de composante {}"),
    ("its components are: {}", "ses composantes sont : {}"),
    ("the field is empty", "le champ est vide"),
    (
        "fields of natures {} and {} cannot be joined",
        "des champs de natures {} et {} ne se réunissent pas",
    ),
    (
        "give them the same nature by CHAN 'ATTRIBUT', or write + to add them",
        "donnez-leur la même nature par CHAN 'ATTRIBUT', ou ajoutez-les par +",
    ),
    (
        "component {} is {} in one field and {} in the other at node {}",
        "la composante {} vaut {} dans un champ et {} dans l'autre au noeud {}",
    ),
    (
        "diffuse fields must agree where both are defined; NOER keeps the first",
        "des champs diffus doivent s'accorder là où les deux existent ; NOER garde le premier",
    ),
    ("the field to divide by has a zero", "le champ diviseur a un zéro"),
    ("{} abscissas for {} ordinates", "{} abscisses pour {} ordonnées"),
)

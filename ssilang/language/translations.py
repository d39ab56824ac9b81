"""French of what the parts below the language report in English.

Kernel and operators raise errors whose sentence is English; they know no language. A sentence is
recognised here by its template and said again in French, with its figures and names taken over.
What has no template stays English. Rows are (English, French); `{}` stands for any text, the same
in the same order in both.
"""

from __future__ import annotations

import re
from functools import lru_cache

from ssilang.language.french_meshes import MESHES

TEMPLATES: tuple[tuple[str, str], ...] = (
    *MESHES,
    (
        "element {} carries fields and pressures, it has no stiffness",
        "l'élément {} porte des champs et des pressions, il n'a pas de rigidité",
    ),
    ("name another in MODE: {}", "nommez-en un autre dans MODE : {}"),
    # ---- tension curves
    (
        "TRAC begins at zero stress and strain, then comes the elastic limit",
        "TRAC part de contrainte et déformation nulles, puis vient la limite élastique",
    ),
    ("the first slope of TRAC is {}, YOUN is {}", "la première pente de TRAC est {}, YOUN vaut {}"),
    (
        "the second point of TRAC is the elastic limit",
        "le second point de TRAC est la limite élastique",
    ),
    (
        "TRAC rises by more than YOUN behind the elastic limit",
        "TRAC monte de plus que YOUN après la limite élastique",
    ),
    (
        "the hardening is given twice, by TRAC and by ECRO",
        "l'écrouissage est donné deux fois, par TRAC et par ECRO",
    ),
    ("TRAC needs YOUN as one number", "TRAC demande pour YOUN un seul nombre"),
    ("give ECRO instead", "donnez plutôt ECRO"),
    # ---- Voronoi partitions
    ("a germ lies outside of the contour", "un germe est hors du contour"),
    ("INCL takes the points inside", "INCL prend les points intérieurs"),
    ("two germs lie at the same place", "deux germes sont au même endroit"),
    ("merge them with ELIM", "confondez-les par ELIM"),
    (
        "two weights differ by too much: a germ would lie outside of its cell",
        "deux poids diffèrent trop : un germe serait hors de sa cellule",
    ),
    (
        "squares of weights differ by the square of the germs' distance at most",
        "les carrés des poids diffèrent au plus du carré de la distance des germes",
    ),
    ("VORO works in the plane only", "VORO ne travaille que dans le plan"),
    ("the germs are a mesh of points (POI1)", "les germes sont un maillage de points (POI1)"),
    ("the contour is a closed line of SEG2", "le contour est une ligne fermée de SEG2"),
    # ---- sections of fibres
    (
        "element {} describes the section of a beam and has no unknowns",
        "l'élément {} décrit la section d'une poutre et n'a pas d'inconnues",
    ),
    (
        "give its model to a beam TIMO: MATE MODL1 'MODS' model 'MATS' material",
        "donner son modèle à une poutre TIMO : MATE MODL1 'MODS' modèle 'MATS' matériau",
    ),
    ("FC = 0: concrete needs a strength", "FC = 0 : le béton veut une résistance"),
    (
        "the thermal expansion of sections of fibres is not available",
        "la dilatation thermique des sections de fibres n'existe pas",
    ),
    (
        "leave ALPH out of the material of the fibres",
        "ôter ALPH du matériau des fibres",
    ),
    ("a section has no element {}", "une section n'a pas d'élément {}"),
    ("it is made of POJS, TRIS and QUAS", "elle est faite de POJS, TRIS et QUAS"),
    (
        "the beams of one zone have different sections ({})",
        "les poutres d'une même zone ont des sections différentes ({})",
    ),
    (
        "give each section a model of its own, and join the models by ET",
        "donner à chaque section son modèle, et réunir les modèles par ET",
    ),
    (
        "a beam of fibres is ELASTIQUE SECTION PLASTIQUE SECTION, not {}",
        "une poutre à fibres est ELASTIQUE SECTION PLASTIQUE SECTION, pas {}",
    ),
    (
        "the laws of the fibres stand in the model of the section",
        "les lois des fibres sont dans le modèle de la section",
    ),
    (
        "elements of the family '{}' have no plastic law {}",
        "les éléments de la famille '{}' n'ont pas la loi plastique {}",
    ),
    (
        "fibres of sections (POJS TRIS QUAS) have {}",
        "les fibres de section (POJS TRIS QUAS) ont {}",
    ),
    (
        "beams with sections of fibres have no law between their forces and strains alone",
        "les poutres à fibres n'ont pas de loi entre leurs seuls efforts et déformations",
    ),
    (
        "PASAPAS and DYNAMIC take such models, MOCU gives moments from curvatures",
        "PASAPAS et DYNAMIC prennent ces modèles, MOCU donne les moments des courbures",
    ),
    (
        "the section does not find the normal force {} of value {}: {} is missing after {} "
        "iterations",
        "la section ne trouve pas l'effort normal {} de la valeur {} : il manque {} après {} "
        "itérations",
    ),
    (
        "is the force below the strength of the section?",
        "l'effort est-il inférieur à la résistance de la section ?",
    ),
    (
        "the fibres have no area or no YOUN: the section carries no normal force",
        "les fibres n'ont ni aire ni YOUN : la section ne porte pas d'effort normal",
    ),
    # ---- contours cut in two, sections, polygons, animations
    (
        "the nearest nodes, {} and {}, are neighbours on the contour",
        "les noeuds les plus proches, {} et {}, sont voisins sur le contour",
    ),
    (
        "give meshes of which no nodes are neighbours",
        "donner des maillages dont aucun noeud n'est voisin d'un autre",
    ),
    (
        "the word {} is compared with a number: they differ",
        "le mot {} est comparé à un nombre : ils diffèrent",
    ),
    (
        "a name that was never assigned is a word",
        "un nom jamais affecté est un mot",
    ),
    (
        "a turning frame couples the two parts of a harmonic, which one model does not hold",
        "un repère tournant couple les deux parties d'une harmonique, qu'un seul modèle ne porte "
        "pas",
    ),
    (
        "the centrifugal stiffness about the axis is available",
        "la raideur centrifuge autour de l'axe existe",
    ),
    (
        "shells off their mesh (EXCE) are not available for COQ2",
        "les coques excentrées (EXCE) n'existent pas pour les COQ2",
    ),
    (
        "'SHB8' is for models of elements SHB8",
        "'SHB8' vaut pour les modèles d'éléments SHB8",
    ),
    (
        "elasticity {} is not available for SHB8",
        "l'élasticité {} n'est pas disponible pour les SHB8",
    ),
    ("a contour of SEG2 is needed", "il faut un contour de SEG2"),
    ("the contour is not one line", "le contour n'est pas une seule ligne"),
    ("put several contours one by one", "traiter plusieurs contours l'un après l'autre"),
    (
        "the {} mesh has no node on the contour",
        "le maillage ({}) n'a pas de noeud sur le contour",
    ),
    (
        "the two meshes have one and the same node on the contour",
        "les deux maillages ont un seul et même noeud sur le contour",
    ),
    (
        "the three points lie in line and give no plane",
        "les trois points sont alignés et ne donnent pas de plan",
    ),
    (
        "polygons have straight sides, the contour is of SEG3",
        "les polygones ont des côtés droits, le contour est en SEG3",
    ),
    ("CHAN 'LINEAIRE' makes it straight", "CHAN 'LINEAIRE' le rend droit"),
    (
        "no polygons of five sides or more in this mesh",
        "aucun polygone de cinq côtés ou plus dans ce maillage",
    ),
    # ---- meshes refined by parts, crossings, projections
    ("{} cells are not divided", "les éléments {} ne se divisent pas"),
    ("{} are: CHAN LINE makes cells linear", "{} le font : CHAN LINE rend les éléments linéaires"),
    ("the sizes wanted are positive", "les tailles voulues sont positives"),
    ("about {} cells are needed", "il faudrait environ {} éléments"),
    ("wish larger sizes", "demander de plus grandes tailles"),
    (
        "the field of sizes has {} components, one is needed",
        "le champ de tailles a {} composantes, il en faut une",
    ),
    (
        "the mesh has been refined before: its SURE cells tie nodes that a second division would "
        "move",
        "le maillage est déjà raffiné : ses éléments SURE attachent des noeuds qu'une seconde "
        "division déplacerait",
    ),
    (
        "refine the first mesh to the sizes wanted in the end",
        "raffiner le premier maillage aux tailles voulues à la fin",
    ),
    ("no size is given at node {}", "aucune taille n'est donnée au noeud {}"),
    ("give the field on the whole mesh", "donner le champ sur tout le maillage"),
    (
        "the mesh holds nothing but SURE cells, which tie hanging nodes",
        "le maillage ne contient que des éléments SURE, qui attachent des noeuds pendants",
    ),
    (
        "lines of SEG2 are needed to triangulate what they enclose",
        "il faut des lignes de SEG2 pour trianguler ce qu'elles entourent",
    ),
    ("the lines enclose nothing", "les lignes n'entourent rien"),
    (
        "the lines are not plane: a point is {} away from their mean plane",
        "les lignes ne sont pas planes : un point est à {} de leur plan moyen",
    ),
    (
        "the {} point is {} away from one of the surfaces",
        "le point {} est à {} de l'une des surfaces",
    ),
    ("both ends lie on both surfaces", "les deux extrémités sont sur les deux surfaces"),
    (
        "the two ends of the curve are the same point",
        "les deux extrémités de la courbe sont le même point",
    ),
    (
        "the crossing of the surfaces that starts at the first point does not come to the last",
        "l'intersection des surfaces qui part du premier point n'arrive pas au dernier",
    ),
    (
        "are both points on the same branch of it?",
        "les deux points sont-ils sur la même branche ?",
    ),
    (
        "the two surfaces touch without crossing at ({}): no curve is defined there",
        "les deux surfaces se touchent sans se croiser en ({}) : aucune courbe n'y est définie",
    ),
    (
        "a curve is the crossing of two surfaces, {} stand here",
        "une courbe est l'intersection de deux surfaces, il y en a ici {}",
    ),
    (
        "element {} does not fill its space: no projection on it",
        "l'élément {} n'est pas massif : pas de projection sur lui",
    ),
    (
        "{} integration points do not fix the {} values of a {} cell",
        "{} points d'intégration ne fixent pas les {} valeurs d'un élément {}",
    ),
    (
        "give more points in each direction (3 by default)",
        "donner plus de points par direction (3 par défaut)",
    ),
    (
        "conditions are not made imaginary by CHAN",
        "CHAN ne rend pas imaginaires des conditions",
    ),
    (
        "the multiplier of a condition is always called LX here",
        "le multiplicateur d'une condition s'appelle toujours LX ici",
    ),
    # ---- stages of PASAPAS
    (
        "the load {} gives no {} at time {}",
        "le chargement {} ne donne aucun {} au temps {}",
    ),
    # ---- finite displacements
    (
        "a beam is shrunk to nothing",
        "une poutre est réduite à rien",
    ),
    (
        "finite displacements are not built for {} in this hypothesis",
        "les grands déplacements ne sont pas programmés pour {} dans cette hypothèse",
    ),
    (
        "continuous elements, bars and beams of the plane have them; leave "
        "'GRANDS_DEPLACEMENTS' for others",
        "les massifs, les barres et les poutres du plan les ont ; ôter "
        "'GRANDS_DEPLACEMENTS' pour les autres",
    ),
    (
        "plastic bodies have small displacements only",
        "les corps plastiques n'ont que de petits déplacements",
    ),
    ("a bar is shrunk to nothing", "une barre est réduite à rien"),
    # ---- time stepping on modes and its links, recombination
    ("link {} has no positive stiffness", "la liaison {} n'a pas de raideur positive"),
    (
        "the law of link {} wants two points or more, abscissas growing",
        "la loi de la liaison {} veut deux points ou plus, abscisses croissantes",
    ),
    (
        "the law of link {} is not elastic, then plastic with hardening",
        "la loi de la liaison {} n'est pas élastique, puis plastique avec écrouissage",
    ),
    (
        "its first line is the steepest; those behind it do not descend",
        "son premier segment est le plus raide ; les suivants ne descendent pas",
    ),
    ("the run diverges", "le calcul diverge"),
    (
        "shorten the step: the links are stiffer than it can follow",
        "raccourcir le pas : les liaisons sont trop raides pour lui",
    ),
    ("the mass of the modes is singular", "la masse des modes est singulière"),
    (
        "each mode and static shape needs a mass",
        "chaque mode et chaque déformée statique a besoin d'une masse",
    ),
    (
        "the step {} s is too long for {}: {} s at most",
        "le pas de {} s est trop long pour {} : {} s au plus",
    ),
    (
        "shorten the step, or leave out the highest modes",
        "raccourcir le pas, ou se passer des modes les plus hauts",
    ),
    (
        "the step and the numbers of steps must be positive",
        "le pas et les nombres de pas doivent être positifs",
    ),
    ("which scheme steps in time?", "quel schéma avance en temps ?"),
    (
        "DYNE wants a table BASE_MODALE or RAIDEUR_ET_MASSE",
        "DYNE veut une table BASE_MODALE ou RAIDEUR_ET_MASSE",
    ),
    (
        "plastic laws on the forces and moments of shells are not built",
        "les lois plastiques sur les efforts et moments des coques ne sont pas programmées",
    ),
    ("'INTEGRE' {}: 2 to 15 points across", "'INTEGRE' {} : 2 à 15 points dans l'épaisseur"),
    ("elements of the family '{}' do not creep", "les éléments de la famille '{}' ne fluent pas"),
    ("which law of creep?", "quelle loi de fluage ?"),
    (
        "creep goes with elasticity ISOTROPE, not with {}",
        "le fluage va avec l'élasticité ISOTROPE, pas avec {}",
    ),
    (
        "the answer of a law of creep depends on the duration of the step",
        "la réponse d'une loi de fluage dépend de la durée du pas",
    ),
    ("NORTON has {} = {}", "NORTON a {} = {}"),
    ("COQ3 has no plastic law", "COQ3 n'a pas de loi plastique"),
    ("thin shells have no plastic law {}", "les coques minces n'ont pas la loi plastique {}"),
    (
        "plastic shells have no law between their forces and strains alone",
        "les coques plastiques n'ont pas de loi entre leurs seuls efforts et déformations",
    ),
    (
        "'ADDI_SECOND' acts where there are no unknowns: {}",
        "'ADDI_SECOND' agit là où il n'y a pas d'inconnues : {}",
    ),
    ("DYNE knows no table '{}'", "DYNE ne connaît pas la table '{}'"),
    (
        "'TYPE_LIAISON' is {}: such links are not built",
        "'TYPE_LIAISON' est {} : de telles liaisons ne sont pas programmées",
    ),
    ("'{}' of a table LIAISON must be a TABLE of links", "'{}' d'une table LIAISON est une TABLE"),
    ("'{}' . {} must be a table of a link", "'{}' . {} est la table d'une liaison"),
    ("'{}' of a mode must be a number", "'{}' d'un mode est un nombre"),
    (
        "'MASSE_GENERALISEE' of a mode is {}, not above zero",
        "'MASSE_GENERALISEE' d'un mode vaut {}, qui n'est pas positif",
    ),
    ("'{}' is {}, not above zero", "'{}' vaut {}, qui n'est pas positif"),
    ("'BALOURD' is 0 or 1", "'BALOURD' vaut 0 ou 1"),
    ("give the 'POINT_REPERE' of a mode", "donner le 'POINT_REPERE' d'un mode"),
    (
        "the tangent of the branch at {} is not made of finite numbers",
        "la tangente à la branche en {} n'est pas faite de nombres finis",
    ),
    (
        "forces and their derivatives that are finite for all displacements",
        "forces et dérivées doivent être finies pour tout déplacement",
    ),
    ("the link has no '{}'", "la liaison n'a pas de '{}'"),
    ("'{}' of a link is a number", "'{}' d'une liaison est un nombre"),
    ("'{}' of a link is a point", "'{}' d'une liaison est un point"),
    ("'{}' of a link has no length", "'{}' d'une liaison est de longueur nulle"),
    (
        "links of base B need the shapes: give the table 'BASE_MODALE'",
        "les liaisons en base B veulent les déformées : donner la table 'BASE_MODALE'",
    ),
    (
        "'{}' of a link marks no mode of the basis",
        "'{}' d'une liaison ne repère aucun mode de la base",
    ),
    (
        "the matrices of DYNE are on ALFA and BETA: project them with PJBA",
        "les matrices de DYNE portent sur ALFA et BETA : les projeter par PJBA",
    ),
    ("the results go from {} to {} s", "les résultats vont de {} à {} s"),
    (
        "a load counts by pseudo-modes: the basis has no 'PSEUDO_MODES'",
        "un chargement compte par des pseudo-modes : la base n'a pas de 'PSEUDO_MODES'",
    ),
    (
        "{} elements have no shear strain of their own",
        "les éléments {} n'ont pas de distorsion propre",
    ),
    (
        "a full matrix of {} rows is too large",
        "une matrice pleine de {} lignes est trop grande",
    ),
    # ---- contact in time, CHARMECA, condition numbers
    (
        "the relations leave {} motions, their duals {}",
        "les relations laissent {} mouvements, leurs duales {}",
    ),
    (
        "the conserving step has no friction between meshes and no relations with a dual",
        "le pas conservatif n'a ni frottement entre maillages ni relations avec une duale",
    ),
    (
        "adapted steps are those of the condensed interface",
        "les pas adaptés sont ceux de l'interface condensée",
    ),
    (
        "a matrix added during the calculation has {} at node {}, which RIGI and MASS lack",
        "une matrice ajoutée pendant le calcul a {} au noeud {}, absent de RIGI et de MASS",
    ),
    (
        "unilateral relations (MINI, MAXI) cannot be added during a calculation",
        "des relations unilatérales (MINI, MAXI) ne s'ajoutent pas pendant un calcul",
    ),
    (
        "a force added during the calculation has {}, which the matrices lack",
        "une force ajoutée pendant le calcul a {}, absent des matrices",
    ),
    (
        "a force added during the calculation is not a finite number",
        "une force ajoutée pendant le calcul n'est pas un nombre fini",
    ),
    (
        "'VITEUNIL' has no effect: the conserving step keeps the energy of impacts by itself",
        "'VITEUNIL' est sans effet : le pas conservatif garde de lui-même l'énergie des chocs",
    ),
    (
        "'CONTACT_PERSISTANT' takes energy, 'CONSERVATIF' keeps it: they exclude each other",
        "'CONTACT_PERSISTANT' prend de l'énergie, 'CONSERVATIF' la garde : ils s'excluent",
    ),
    (
        "'REDUCTION' and 'CHARMECA' exclude each other",
        "'REDUCTION' et 'CHARMECA' s'excluent",
    ),
    (
        "the procedure CHARMECA must give one TABLE",
        "la procédure CHARMECA doit rendre une TABLE",
    ),
    (
        "the condition number of the matrix is {}: {} of 16 digits are left",
        "le conditionnement de la matrice vaut {} : il reste {} chiffres sur 16",
    ),
    (
        "the condition number of the stiffness with closed joints is {}: {} of 16 digits "
        "are left; with joints as stiff as the bodies at their nodes it is {}",
        "le conditionnement de la raideur, joints fermés, vaut {} : il reste {} chiffres "
        "sur 16 ; avec des joints aussi raides que les corps à leurs noeuds il vaut {}",
    ),
    (
        "{} nodes that conditions hold have no stiffness, but lie on nodes that have (one at {} "
        "{} {}): they hold nothing",
        "{} noeuds que des conditions tiennent n'ont pas de raideur, mais sont à la même place que "
        "des noeuds qui en ont (l'un en {} {} {}) : ils ne tiennent rien",
    ),
    (
        "the joint law {} is not built: what its parameters BETA (unloading) and CPLG "
        "(coupling) do is published nowhere",
        "la loi de joint {} n'est pas construite : ce que font ses paramètres BETA "
        "(décharge) et CPLG (couplage) n'est publié nulle part",
    ),
    # ---- plastic bodies, shapes, contact
    (
        "plastic bodies are stepped by Newmark, HHT or generalised alpha",
        "les corps plastiques avancent par Newmark, HHT ou alpha généralisé",
    ),
    (
        "plastic laws do not exist in mode {}",
        "les lois plastiques n'existent pas en mode {}",
    ),
    (
        "no plastic law of bodies is called {}",
        "aucune loi plastique de corps ne s'appelle {}",
    ),
    (
        "elements of the family '{}' have no plastic law",
        "les éléments de la famille '{}' n'ont pas de loi plastique",
    ),
    (
        "RH_COULOMB needs a cohesion COHE > 0",
        "RH_COULOMB demande une cohésion COHE > 0",
    ),
    (
        "models MODAL and STATIQUE have no strains of their own",
        "les modèles MODAL et STATIQUE n'ont pas de déformations propres",
    ),
    (
        "a shape {} needs {}",
        "une déformée {} demande {}",
    ),
    (
        "models IMPEDANCE have no strains",
        "les modèles IMPEDANCE n'ont pas de déformations",
    ),
    (
        "an impedance joins {} unknowns ({}) to {}",
        "une impédance joint {} inconnues ({}) à {}",
    ),
    (
        "{} of an impedance is not negative: {}",
        "{} d'une impédance n'est pas négatif : {}",
    ),
    (
        "the reduced damping AMOR of an impedance needs its mass MASS",
        "l'amortissement réduit AMOR d'une impédance demande sa masse MASS",
    ),
    (
        "a curve of MOCO is named '{}'",
        "une courbe de MOCO s'appelle '{}'",
    ),
    (
        "an impedance {} that changes with the frequency is no matrix",
        "une impédance {} qui dépend de la fréquence n'est pas une matrice",
    ),
    (
        "elements of the family '{}' have no law IMPEDANCE",
        "les éléments de la famille '{}' n'ont pas de loi IMPEDANCE",
    ),
    (
        "an impedance has no law {}",
        "une impédance n'a pas de loi {}",
    ),
    (
        "at {} Hz the system is singular",
        "à {} Hz le système est singulier",
    ),
    (
        "a unilateral condition has no harmonic response",
        "une condition unilatérale n'a pas de réponse harmonique",
    ),
    (
        "a law {} has no harmonic response",
        "une loi {} n'a pas de réponse harmonique",
    ),
    (
        "{} unknowns are too many to choose frequencies for",
        "{} inconnues sont trop pour un choix des fréquences",
    ),
    (
        "the system has no natural frequency to choose a sweep from",
        "le système n'a pas de fréquence propre pour choisir un balayage",
    ),
    (
        "the load ends at {} Hz, below the response, which begins at {} Hz",
        "le chargement finit à {} Hz, sous la réponse, qui commence à {} Hz",
    ),
    (
        "a side of contact is made of {}, not {}",
        "un bord de contact se fait de {}, pas de {}",
    ),
    ("the law of friction is not said", "la loi de frottement n'est pas dite"),
    (
        "contact with friction is no matrix: its forces depend on the way there",
        "le contact frottant n'est pas une matrice : ses forces dépendent du chemin",
    ),
    ("MU and COHE of friction must not be negative", "MU et COHE ne peuvent être négatifs"),
    ("{} varies along a side of contact", "{} varie le long d'un bord de contact"),
    ("a cable is a line of SEG2, not of {}", "un câble est une ligne de SEG2, pas de {}"),
    (
        "a cable with friction (FROCABLE) has no bars on its cells",
        "un câble frottant (FROCABLE) n'a pas de barres sur ses mailles",
    ),
    ("cables with friction are elastic", "les câbles frottants sont élastiques"),
    ("the cable branches at node {}", "le câble a un branchement au noeud {}"),
    ("no node of the cable lies in the body", "aucun noeud du câble n'est dans le volume"),
    (
        "prestressing cables are bars (BARR on SEG2), not {}",
        "les câbles de précontrainte sont des barres (BARR sur SEG2), pas {}",
    ),
    (
        "no state of contact and friction gives equilibrium",
        "aucun état de contact et de frottement ne donne l'équilibre",
    ),
    (
        "SOMT sums a field of a single component",
        "SOMT somme un champ d'une seule composante",
    ),
    # ---- super-elements
    (
        "none of the master unknowns is an unknown of the stiffness",
        "aucune des inconnues maîtresses n'est une inconnue de la rigidité",
    ),
    (
        "give nodes of the body, or fields of its unknowns (UX, UY ...)",
        "donnez des noeuds du corps, ou des champs de ses inconnues (UX, UY ...)",
    ),
    (
        "unilateral and non-associated conditions cannot be condensed",
        "des conditions unilatérales ou non associées ne se condensent pas",
    ),
    ("leave out 'NOMU'", "retirez 'NOMU'"),
    (
        "{} master unknowns make too large a full matrix (at most {})",
        "{} inconnues maîtresses font une matrice pleine trop grande (au plus {})",
    ),
    (
        "the conditions of the matrix hold the master unknown {}",
        "les conditions de la matrice bloquent l'inconnue maîtresse {}",
    ),
    (
        "leave out 'NOMU', or choose other masters",
        "retirez 'NOMU', ou choisissez d'autres maîtres",
    ),
    (
        "the super-element has no unknown for the force {}",
        "le super-élément n'a pas d'inconnue pour la force {}",
    ),
    # ---- meshes that follow, polynomial surfaces
    (
        "none of the master nodes belongs to the mesh",
        "aucun des noeuds maîtres n'appartient au maillage",
    ),
    (
        "a part of the mesh has no master node",
        "une partie du maillage n'a pas de noeud maître",
    ),
    ("give masters in each part", "donnez des maîtres dans chaque partie"),
    ("cells of type {} cannot follow", "les éléments de type {} ne peuvent pas suivre"),
    (
        "linear surfaces and volumes do: CHAN 'LINEAIRE'",
        "les surfaces et volumes linéaires le peuvent : CHAN 'LINEAIRE'",
    ),
    (
        "two opposite sides of the surface have no length",
        "deux côtés opposés de la surface sont de longueur nulle",
    ),
    (
        "a parabola covers a half turn or more",
        "une parabole couvre un demi-tour ou davantage",
    ),
    ("ask for more elements", "demandez plus d'éléments"),
    # ---- singular matrices
    (
        "the matrix is singular, with {} free motion that the loads drive ({})",
        "la matrice est singulière : {} mouvement libre, que le chargement entraîne ({})",
    ),
    (
        "the matrix is singular, with {} free motions that the loads drive ({})",
        "la matrice est singulière : {} mouvements libres, que le chargement entraîne ({})",
    ),
    (
        "the matrix is singular, with {} free motion that the loads drive",
        "la matrice est singulière : {} mouvement libre, que le chargement entraîne",
    ),
    (
        "the matrix is singular, with {} free motions that the loads drive",
        "la matrice est singulière : {} mouvements libres, que le chargement entraîne",
    ),
    (
        "not held: {}; hold it with BLOQ or RELA",
        "non tenu : {} ; bloquez-le par BLOQ ou RELA",
    ),
    (
        "not held: {}; hold it with BLOQ or RELA, or give it mass (MASS)",
        "non tenu : {} ; bloquez-le par BLOQ ou RELA, ou donnez-lui une masse (MASS)",
    ),
    (
        "the matrix has no unknown for the force {}",
        "la matrice n'a pas d'inconnue pour la force {}",
    ),
    (
        "load step {}, time {}: no equilibrium, full uplift: {} of {} joint points are open and "
        "nothing else holds the body at node {}",
        "pas de charge {}, temps {} : pas d'équilibre, décollement total : {} des {} points de "
        "joint sont ouverts et rien d'autre ne tient le corps au noeud {}",
    ),
    (
        "less eccentric loads, a support, or a dynamic calculation; if the loads press, the "
        "joint's sides are swapped: RACC and LIAI take the structure's first",
        "un chargement moins excentré, un appui, ou un calcul dynamique ; si le chargement "
        "presse, les côtés du joint sont inversés : RACC et LIAI prennent d'abord celui de la "
        "structure",
    ),
    (
        "the joint around {} {} {} opens where its bodies come together: its sides are swapped",
        "le joint autour de {} {} {} s'ouvre quand ses corps se rapprochent : ses côtés sont "
        "inversés",
    ),
    (
        "RACC and LIAI take the structure's side first",
        "RACC et LIAI prennent d'abord le côté de la structure",
    ),
    (
        "node {} lies on node {} of the matrix: coordinates that are written again make a new "
        "node, the mesh's own is MAIL1 POIN 'PROC' P1",
        "le noeud {} est sur le noeud {} de la matrice : des coordonnées écrites de nouveau font "
        "un nouveau noeud, celui du maillage est MAIL1 POIN 'PROC' P1",
    ),
    (
        "not held: {}; hold it with BLOQ or RELA; {} nodes lie on nodes of another body (ELIM)",
        "non tenu : {} ; bloquez-le par BLOQ ou RELA ; {} noeuds sont sur ceux d'un autre corps "
        "(ELIM)",
    ),
    (
        "take it out of the second member, or say 'NOID'",
        "ôtez-la du second membre, ou dites 'NOID'",
    ),
    # ---- tables of procedures
    ("{}: the entry '{}' is missing", "{} : l'entrée '{}' manque"),
    ("{}: '{}' must be {}, found {}", "{} : '{}' doit être {}, trouvé {}"),
    ("{}: '{}' is {}, which no matrix has", "{} : '{}' est {}, qu'aucune matrice n'a"),
    ("{}: '{}' names no component", "{} : '{}' ne nomme aucune composante"),
    (
        "{}: 'INST' holds instants that increase from 'DEBU' on",
        "{} : 'INST' contient des instants croissants à partir de 'DEBU'",
    ),
    ("{}: 'FREQ' is {}: more than {} steps", "{} : 'FREQ' vaut {} : plus de {} pas"),
    (
        "{}: 'MASSE_CONSTANTE' is not regular: Floquet exponents want a mass for each unknown",
        "{} : 'MASSE_CONSTANTE' n'est pas régulière : les exposants de Floquet demandent une masse "
        "pour chaque inconnue",
    ),
    (
        "a smaller increment of the control, or another control; supports (BLOCAGES_MECANIQUES) "
        "that hold the structure",
        "un incrément de pilotage plus petit, ou un autre pilotage ; des appuis "
        "(BLOCAGES_MECANIQUES) qui tiennent la structure",
    ),
    (
        "a smaller 'AUTOCRIT', or a control that grows along the path; supports "
        "(BLOCAGES_MECANIQUES) that hold the structure",
        "un 'AUTOCRIT' plus petit, ou un pilotage qui croît le long du chemin ; des appuis "
        "(BLOCAGES_MECANIQUES) qui tiennent la structure",
    ),
    # ---- procedures: entries, harmonic balance, sweeps, paths
    ("there is no field to decompose", "il n'y a aucun champ à décomposer"),
    ("no component is left to decompose", "il ne reste aucune composante à décomposer"),
    ("{}: '{}' and '{}' choose two schemes", "{} : '{}' et '{}' choisissent deux schémas"),
    ("{}: '{}' is {}", "{} : '{}' vaut {}"),
    ("{}: '{}' is for static calculations", "{} : '{}' est pour les calculs statiques"),
    ("{}: '{}' must be TABLE", "{} : '{}' doit être TABLE"),
    ("{}: '{}' is no result", "{} : '{}' n'est pas un résultat"),
    (
        "{}: 'AUTOCRIT', 'AUTOPAS' and 'AUTORESU' are positive",
        "{} : 'AUTOCRIT', 'AUTOPAS' et 'AUTORESU' sont positifs",
    ),
    (
        "{}: 'CONTACT' = 'PENALITE' needs 'COEFFICIENT'",
        "{} : 'CONTACT' = 'PENALITE' demande 'COEFFICIENT'",
    ),
    (
        "{}: 'CONTACT_PERSISTANT' takes energy, 'CONSERVATIF' keeps it: they exclude each other",
        "{} : 'CONTACT_PERSISTANT' ôte de l'énergie, 'CONSERVATIF' la garde : ils s'excluent",
    ),
    (
        "{}: 'MAXI_DEPLACEMENT' > 0 and 0 < 'DSMIN' <= 'DS' <= 'DSMAX' are wanted",
        "{} : il faut 'MAXI_DEPLACEMENT' > 0 et 0 < 'DSMIN' <= 'DS' <= 'DSMAX'",
    ),
    (
        "{}: 'N_PT_TFR' = {}: {} instants for {} harmonics",
        "{} : 'N_PT_TFR' = {} : {} instants pour {} harmoniques",
    ),
    (
        "{}: 'PARAMETRE_DE_PILOTAGE' does not change over step {}",
        "{} : 'PARAMETRE_DE_PILOTAGE' ne varie pas sur le pas {}",
    ),
    (
        "{}: 'PILOTAGE_INDIRECT' and 'AUTOMATIQUE' exclude one another",
        "{} : 'PILOTAGE_INDIRECT' et 'AUTOMATIQUE' s'excluent",
    ),
    (
        "{}: 'REDUCTION' and 'CHARMECA' exclude each other",
        "{} : 'REDUCTION' et 'CHARMECA' s'excluent",
    ),
    (
        "{}: 'REDUCTION' and 'NEWTON_COMPLET' choose two methods",
        "{} : 'REDUCTION' et 'NEWTON_COMPLET' choisissent deux méthodes",
    ),
    ("{}: 'REDUCTION' needs linear bodies", "{} : 'REDUCTION' demande des corps linéaires"),
    ("MODELE has plastic ones", "MODELE en a de plastiques"),
    (
        "{}: 'REPRISE' needs the results of an earlier calculation",
        "{} : 'REPRISE' demande les résultats d'un calcul précédent",
    ),
    (
        "{}: 'STABILITE': '{}' is for harmonic balance",
        "{} : 'STABILITE' : '{}' est pour l'équilibrage harmonique",
    ),
    ("{}: 'STABILITE': '{}' is not known", "{} : 'STABILITE' : '{}' n'est pas connu"),
    (
        "{}: 'TEMPS_CALCULES' holds the frequencies, at least one, none negative",
        "{} : 'TEMPS_CALCULES' contient les fréquences, une au moins, aucune négative",
    ),
    (
        "{}: 'VITEUNIL' corrects velocities of the average acceleration only",
        "{} : 'VITEUNIL' ne corrige que les vitesses de l'accélération moyenne",
    ),
    (
        "{}: imposed displacements do not go with harmonic balance",
        "{} : les déplacements imposés ne vont pas avec l'équilibrage harmonique",
    ),
    ("load by forces", "charger par des forces"),
    (
        "{}: no element has strains to control the load by",
        "{} : aucun élément n'a de déformations pour piloter la charge",
    ),
    (
        "{}: no result stands at the time of 'REPRISE', {}",
        "{} : aucun résultat n'est au temps de 'REPRISE', {}",
    ),
    ("the nearest is at {}", "le plus proche est à {}"),
    (
        "{}: no time of '{}' comes after the initial one, {}",
        "{} : aucun temps de '{}' ne suit le temps initial, {}",
    ),
    (
        "{}: stability wants 'RIGIDITE_CONSTANTE' and 'MASSE_CONSTANTE'",
        "{} : la stabilité demande 'RIGIDITE_CONSTANTE' et 'MASSE_CONSTANTE'",
    ),
    (
        "{}: the displacement of the controlled load causes no strain",
        "{} : le déplacement de la charge pilotée ne déforme rien",
    ),
    ("{}: the load does not change in time", "{} : la charge ne varie pas dans le temps"),
    (
        "{}: the load is not straight in time over 'TEMPS_CALCULES'",
        "{} : la charge n'est pas linéaire en temps sur 'TEMPS_CALCULES'",
    ),
    (
        "one line from the first time to the last: the load keeps its direction",
        "une droite du premier temps au dernier : la charge garde sa direction",
    ),
    (
        "{}: the matrices have no unknowns at 'POINT_FNL'",
        "{} : les matrices n'ont pas d'inconnues en 'POINT_FNL'",
    ),
    (
        "{}: the path begins at the first time of 'TEMPS_CALCULES'",
        "{} : le chemin commence au premier temps de 'TEMPS_CALCULES'",
    ),
    ("a new table for a new path", "une nouvelle table pour un nouveau chemin"),
    ("{}: the procedure {} must give one FLOTTANT", "{} : la procédure {} doit rendre un FLOTTANT"),
    ("{}: which load is controlled?", "{} : quelle charge est pilotée ?"),
    (
        "AUTOPILO gives no norm to the step that the load causes",
        "AUTOPILO ne donne pas de norme au pas que la charge cause",
    ),
    (
        "{} harmonics want {} instants of a period or more, {} are given",
        "{} harmoniques demandent {} instants par période ou plus, {} sont donnés",
    ),
    ("DYNC wants a table '{}'", "DYNC veut une table '{}'"),
    ("the table {} has no number '{}'", "la table {} n'a pas de nombre '{}'"),
    ("the table {} has no matrix '{}'", "la table {} n'a pas de matrice '{}'"),
    ("0 < 'DSMIN' <= 'DS0' <= 'DSMAX' is wanted", "il faut 0 < 'DSMIN' <= 'DS0' <= 'DSMAX'"),
    ("index {} is beyond the {} harmonics", "l'indice {} dépasse les {} harmoniques"),
    ("index {} of the table {} is a CHPOINT", "l'indice {} de la table {} est un CHPOINT"),
    ("'{}' of the table {} is a CHPOINT", "'{}' de la table {} est un CHPOINT"),
    (
        "link {} changes in time by a frequency of its own: harmonic balance wants forces of "
        "the motion alone",
        "la liaison {} varie dans le temps par une fréquence propre : l'équilibrage "
        "harmonique veut des forces du seul mouvement",
    ),
    (
        "link {} remembers its past (plastic, or sticking by springs): harmonic balance "
        "wants forces of the present motion",
        "la liaison {} se souvient du passé (plastique, ou adhérente par ressorts) : "
        "l'équilibrage harmonique veut des forces du mouvement présent",
    ),
    (
        "no first solution found at {} (residual {})",
        "aucune première solution trouvée en {} (résidu {})",
    ),
    (
        "another first value of the parameter, or a guess nearer to the solution",
        "une autre première valeur du paramètre, ou un départ plus proche de la solution",
    ),
    ("damping is between 0 and 1, not {}", "un amortissement est entre 0 et 1, pas {}"),
    (
        "each mode has a frequency, a damping and a participation",
        "chaque mode a une fréquence, un amortissement et une participation",
    ),
    ("the frequencies of modes are positive", "les fréquences des modes sont positives"),
    (
        "the frequencies of a spectrum and the duration are positive",
        "les fréquences d'un spectre et la durée sont positives",
    ),
    (
        "an initial field has values that are not finite numbers",
        "un champ initial a des valeurs qui ne sont pas des nombres finis",
    ),
    (
        "a load curve has values that are not finite numbers",
        "une courbe de charge a des valeurs qui ne sont pas des nombres finis",
    ),
    (
        "the matrix {} has values that are not finite numbers",
        "la matrice {} a des valeurs qui ne sont pas des nombres finis",
    ),
    ("joints need their parameters", "les joints demandent leurs paramètres"),
    ("give CARACTERISTIQUES with MODELE", "donner CARACTERISTIQUES avec MODELE"),
    (
        "the load {} has {}, which the matrices lack",
        "la charge {} a {}, que les matrices n'ont pas",
    ),
    (
        "undamped resonance, or a free motion at 0 Hz: leave this frequency out or add damping",
        "résonance sans amortissement, ou mouvement libre à 0 Hz : ôter cette fréquence ou amortir",
    ),
    (
        "only linear models work in a sweep of frequencies",
        "seuls les modèles linéaires vont dans un balayage en fréquence",
    ),
    ("the matrices have no unknowns", "les matrices n'ont pas d'inconnues"),
    ("a dashpot is given by VISC", "un amortisseur se donne par VISC"),
    ("the table holds no mode", "la table ne contient aucun mode"),
    (
        "the matrices have modes that 'BASE_MODALE' lacks",
        "les matrices ont des modes que 'BASE_MODALE' n'a pas",
    ),
    (
        "a body held by friction alone slides away when the loads exceed it: hold it, give "
        "it mass in a dynamic calculation, or take smaller steps",
        "un corps tenu par le seul frottement glisse quand les charges le dépassent : le "
        "tenir, lui donner une masse en dynamique, ou prendre des pas plus petits",
    ),
    (
        "hold with equalities (BLOQ, RELA without MINI or MAXI), or work in time",
        "tenir par des égalités (BLOQ, RELA sans MINI ni MAXI), ou calculer en temps",
    ),
    ("a number above zero", "un nombre positif"),
    ("leave one", "ôter l'un des deux"),
    ("give one", "n'en donner qu'un"),
    ("two tables '{}'", "deux tables '{}'"),
    (
        "the matrix is singular, with {} free motion",
        "la matrice est singulière : {} mouvement libre",
    ),
    (
        "the matrix is singular, with {} free motions",
        "la matrice est singulière : {} mouvements libres",
    ),
    (
        "the matrix is singular, with {} free motion ({})",
        "la matrice est singulière : {} mouvement libre ({})",
    ),
    (
        "the matrix is singular, with {} free motions ({})",
        "la matrice est singulière : {} mouvements libres ({})",
    ),
    ("{}: '{}' holds no curve", "{} : '{}' ne contient aucune courbe"),
    (
        "{}: '{}' has values that are not finite numbers",
        "{} : '{}' a des valeurs qui ne sont pas des nombres finis",
    ),
    ("{}: '{}' has {} instants", "{} : '{}' a {} instants"),
    ("two instants or more", "deux instants ou plus"),
    (
        "{}: '{}' does not increase: {} follows {} (values {} and {})",
        "{} : '{}' ne croît pas : {} suit {} (valeurs {} et {})",
    ),
    ("each instant after the one before it", "chaque instant après celui d'avant"),
    (
        "the times of a calculation must be at least two and strictly increase",
        "les instants d'un calcul sont deux au moins et croissent strictement",
    ),
    # ---- models
    ("MODE does not know the word {}", "MODE ne connaît pas le mot {}"),
    ("did you mean {}?", "vouliez-vous dire {} ?"),
    ("element {} does not stand on {} cells", "l'élément {} ne va pas sur des mailles {}"),
    ("{} needs {} cells", "{} demande des mailles {}"),
    # ---- materials
    (
        "parameter {} is missing for element {} ({})",
        "le paramètre {} manque pour l'élément {} ({})",
    ),
    (
        "the field of properties holds nothing on these cells: make it with MATE of this model "
        "(ET joins the fields of several)",
        "le champ de caractéristiques n'a rien sur ces éléments : faites-le par MATE de ce "
        "modèle (ET réunit les champs de plusieurs)",
    ),
    ("give it with MATE or CARA; given: {}", "donnez-le par MATE ou CARA ; sont donnés : {}"),
    (
        "parameter {} is a curve: it depends on a field",
        "le paramètre {} est une évolution : il dépend d'un champ",
    ),
    (
        "Poisson's ratio NU = {} is outside ]-1, 0.5[",
        "le coefficient de Poisson NU = {} est hors de ]-1, 0.5[",
    ),
    (
        "it is a ratio without unit: 0.3 for steel, 0.2 for concrete",
        "c'est un rapport sans unité : 0.3 pour l'acier, 0.2 pour le béton",
    ),
    (
        "use a value such as 0.49 with an incompressible element (ICQ4, BBAR) near 0.5",
        "près de 0.5, prenez 0.49 par exemple, avec un élément incompressible (ICQ4, BBAR)",
    ),
    (
        "an orthotropic material needs its axes",
        "un matériau orthotrope demande ses axes",
    ),
    # ---- laws of joints
    ("the joint parameter {} = {} must be {}", "le paramètre de joint {} = {} doit être {}"),
    ("a joint parameter is not a finite number", "un paramètre de joint n'est pas un nombre fini"),
    (
        "a joint with FU = {} and GF = 0 is perfectly brittle, which JOINT_SDM refuses",
        "un joint avec FU = {} et GF = 0 est parfaitement fragile, ce que JOINT_SDM refuse",
    ),
    (
        "give GF > FU^2/KN = {} N/m, or FU = 0 for a joint without tension",
        "donnez GF > FU^2/KN = {} N/m, ou FU = 0 pour un joint sans traction",
    ),
    (
        "KN = {} must exceed FU^2/GF = {}: the joint would soften faster than it unloads and one "
        "opening would have several tractions",
        "KN = {} doit dépasser FU^2/GF = {} : le joint s'adoucirait plus vite qu'il ne se décharge "
        "et une ouverture aurait plusieurs tractions",
    ),
    (
        "KN > {} with this FU and GF, or FU < {} with this KN and GF",
        "KN > {} avec ces FU et GF, ou FU < {} avec ces KN et GF",
    ),
    # ---- geometry of joints and cells
    (
        "{} of the joint {} has a normal that goes from its first side to its second: opening and "
        "closing would be exchanged",
        "{} du joint {} a une normale qui va de sa première face à sa seconde : ouverture et "
        "fermeture seraient échangées",
    ),
    (
        "walk both sides with the joint on the right hand, or exchange the two meshes given to "
        "RACC (LIAI): the first is the upper side",
        "parcourez les deux faces en ayant le joint à main droite, ou échangez les deux maillages "
        "donnés à RACC (LIAI) : le premier est la face supérieure",
    ),
    (
        "{} of the joint {} has both sides on the same nodes",
        "{} du joint {} a ses deux faces sur les mêmes noeuds",
    ),
    (
        "do not apply ELIM to the two sides of a joint together",
        "n'appliquez pas ELIM aux deux faces d'un joint ensemble",
    ),
    (
        "{} of the joint JOI1 has no length, so its normal is unknown",
        "{} du joint JOI1 est de longueur nulle : sa normale est inconnue",
    ),
    (
        "{} of the joint JOI1 has a normal that goes from its second node to its first: opening "
        "and closing would be exchanged",
        "{} du joint JOI1 a une normale qui va de son second noeud à son premier : ouverture et "
        "fermeture seraient échangées",
    ),
    (
        "reverse the DIRECTION, or the order of the two nodes",
        "inversez la DIRECTION, ou l'ordre des deux noeuds",
    ),
    (
        "the Jacobian vanishes or changes sign inside {} cell(s), the first being number {} of "
        "its block",
        "le jacobien s'annule ou change de signe dans {} élément(s), dont le premier porte le "
        "numéro {} de sa zone",
    ),
    (
        "look for flat or folded cells in the mesh",
        "cherchez des éléments plats ou repliés dans le maillage",
    ),
    # ---- steps that do not converge
    (
        "step {}, time {}: the interface iteration did not converge (residual {} of the jump "
        "after {} turns)",
        "pas {}, temps {} : l'itération de l'interface n'a pas convergé (résidu {} du saut après "
        "{} tours)",
    ),
    ("a smaller step, or softer joints", "un pas plus petit, ou des joints plus souples"),
    (
        "step {}, time {}: the motion grew beyond all numbers",
        "pas {}, temps {} : le mouvement a dépassé tout nombre",
    ),
    (
        "check loads, units and the step",
        "vérifiez le chargement, les unités et le pas",
    ),
    (
        "step {}, time {}: the joints have no stiffness left and nothing else holds the bodies",
        "pas {}, temps {} : les joints n'ont plus de raideur et rien d'autre ne tient les corps",
    ),
    (
        "give mass (MASS) to the bodies that only joints hold",
        "donnez une masse (MASS) aux corps que seuls des joints tiennent",
    ),
    (
        "no set of active unilateral conditions gives equilibrium",
        "aucun jeu de conditions unilatérales actives ne donne l'équilibre",
    ),
    # ---- records, constitutive laws, turning bodies
    (
        "the field has no value of {} at {} of the {} nodes of the line",
        "le champ n'a pas de valeur de {} en {} des {} noeuds de la ligne",
    ),
    (
        "a record to correct needs four points at least, found {}",
        "un enregistrement à corriger a au moins quatre points, il y en a {}",
    ),
    (
        "a power spectrum is positive, over increasing frequencies",
        "un spectre de puissance est positif, sur des fréquences croissantes",
    ),
    (
        "lists of {} and {} values have no dot product",
        "des listes de {} et {} valeurs n'ont pas de produit scalaire",
    ),
    (
        "one curve is needed, here are {}",
        "il faut une courbe, il y en a {}",
    ),
    (
        "the gradient of the motion has a determinant that is not positive",
        "le gradient du mouvement a un déterminant qui n'est pas positif",
    ),
    (
        "matter cannot be turned inside out: is the field F, or F - 1 ('DEPL')?",
        "la matière ne se retourne pas : le champ est-il F, ou F - 1 ('DEPL') ?",
    ),
    (
        "the second field has no strain ({}) on the cells of element {}",
        "le second champ n'a pas de déformation ({}) sur les éléments {}",
    ),
    (
        "the law {} of element {} has no criterion here",
        "la loi {} de l'élément {} n'a pas de critère ici",
    ),
    (
        "gyroscopic coupling is for beams in space, not {}",
        "le couplage gyroscopique est pour les poutres en 3D, pas {}",
    ),
    (
        "corotational damping is for beams in space, not {}",
        "l'amortissement corotatif est pour les poutres en 3D, pas {}",
    ),
    (
        "element {} has no matrices of turning frames",
        "l'élément {} n'a pas de matrices de repère tournant",
    ),
    (
        "the matrix has no relation",
        "la rigidité n'a pas de relation",
    ),
    (
        "the diagonal field has no value for {}",
        "le champ diagonal n'a pas de valeur pour {}",
    ),
    (
        "distances are taken to {} in {}D, not to {}",
        "les distances se prennent à {} en {}D, pas à {}",
    ),
    (
        "the matrix has negative terms ({}): they have no power {}",
        "la rigidité a des termes négatifs ({}) : ils n'ont pas de puissance {}",
    ),
    (
        "the fields have no energy: there is no mode",
        "les champs n'ont pas d'énergie : il n'y a pas de mode",
    ),
    (
        "the record has no whole shock",
        "l'enregistrement n'a pas de choc entier",
    ),
    (
        "a cable is made of segments of two nodes (SEG2)",
        "un câble est fait de segments à deux noeuds (SEG2)",
    ),
    # ---- bounds
    (
        "a list or word of {} items is too long, the limit is {}",
        "une liste ou un mot de {} éléments est trop long, la limite est {}",
    ),
    (
        "look for a step that is too small or a count that is too large",
        "cherchez un pas trop petit ou un nombre trop grand",
    ),
    # ---- surfaces that cross
    ("the two surfaces do not cross", "les deux surfaces ne se croisent pas"),
    (
        "surfaces of TRI3 are needed to cross, this mesh holds {}",
        "il faut des surfaces de TRI3 à croiser, ce maillage contient {}",
    ),
    (
        "CHAN 'TRI3' cuts quadrangles into triangles",
        "CHAN 'TRI3' coupe les quadrangles en triangles",
    ),
    (
        "a triangle that the other surface cuts cannot be meshed",
        "un triangle que l'autre surface coupe ne peut être maillé",
    ),
    # ---- spectra of oscillators that yield
    (
        "the elastic limit of an oscillator must be positive",
        "la limite élastique d'un oscillateur doit être positive",
    ),
    (
        "the factor of {} unknowns takes {} of memory, {} is free",
        "la factorisation de {} inconnues prend {} de mémoire, il en reste {}",
    ),
    (
        "multigrid solves symmetric positive matrices only",
        "le multigrille ne résout que des matrices symétriques positives",
    ),
    (
        "multigrid did not converge within {} turns: a body is free to move, or stiffnesses "
        "differ too much",
        "le multigrille n'a pas convergé en {} tours : un corps est libre, ou les raideurs sont "
        "trop différentes",
    ),
    ("a ductility is at least 1 ({})", "une ductilité vaut au moins 1 ({})"),
    (
        "the signal's times must go by equal steps",
        "les temps du signal doivent aller par pas égaux",
    ),
    (
        "the hardening ratio lies from 0 to 1, 1 left out ({})",
        "le rapport d'écrouissage va de 0 à 1, 1 exclu ({})",
    ),
    ("the law of Takeda is not available", "la loi de Takeda n'est pas disponible"),
    ("SPON wants '{}'", "SPON veut '{}'"),
    (
        "SPON wants a law (CINE ISOT ELAS) and the kinds of both spectra",
        "SPON veut une loi (CINE ISOT ELAS) et le type des deux spectres",
    ),
    (
        "a law wants a ductility and a hardening ratio",
        "une loi veut une ductilité et un rapport d'écrouissage",
    ),
    (
        "SPON wants one linear spectrum for each damping",
        "SPON veut un spectre linéaire par amortissement",
    ),
)
PARTS: tuple[tuple[str, str], ...] = (
    (r"the body of (\d+) nodes around", r"le corps de \1 noeuds autour de"),
    (r"\btranslation along\b", "translation suivant"),
    (r"\brotation about (\w+) around\b", r"rotation autour de \1 au point"),
    (r"\brotation about\b", "rotation autour de"),
    (r"\band (\d+) more\b", r"et \1 autres"),
    (r"\bat node (\d+)", r"au noeud \1"),
    (r"\ba mechanism\b", "un mécanisme"),
    (r"\b(\d+) more bodies\b", r"\1 autres corps"),
    (r"\bcell (\d+)\b", r"l'élément \1"),
)
"""Words inside of what a `{}` stands for (regular expressions)."""

_REFUSED = re.compile(r"([^:]+): '(\w+)' is refused: (.+)", re.DOTALL)
"""What an entry of a table is refused for is a sentence of its own."""


@lru_cache(maxsize=1)
def _patterns() -> list[tuple[re.Pattern[str], str]]:
    ordered = sorted(TEMPLATES, key=lambda row: -len(row[0].replace("{}", "")))
    return [
        (re.compile("(.+?)".join(map(re.escape, english.split("{}"))), re.DOTALL), french)
        for english, french in ordered
    ]


def in_french(sentence: str) -> str:
    """A sentence in French, unchanged if there is no template for it."""
    refused = _REFUSED.fullmatch(sentence)
    if refused is not None:
        procedure, index, reason = refused.groups()
        return f"{procedure} : '{index}' est refusé : {in_french(reason)}"
    for pattern, french in _patterns():
        found = pattern.fullmatch(sentence)
        if found is not None:
            return french.format(*map(_part, found.groups()))
    return sentence


def _part(text: str) -> str:
    for pattern, french in PARTS:
        text = re.sub(pattern, french, text)
    return text

"""What to write in a script where the kernel refuses: hints in the script's words.

The kernel knows no operators. Where a script is told what the kernel refused, these hints stand
in place of the kernel's own; they are filled with the same data.
"""

HINTS: dict[str, tuple[str, str]] = {
    "kernel.contact.side-contact-made-not": (
        "CONT, COTE, ENVE give such meshes",
        "CONT, COTE, ENVE donnent de tels maillages",
    ),
    "kernel.continuation.harmonic-balance-takes-plain": (
        "unilateral ones are nonlinear forces: write them in CHARMECA",
        "les unilatérales sont des forces non linéaires : écrivez-les dans CHARMECA",
    ),
    "kernel.curves.abscissas-must-increase-decrease": (
        "sort by ORDO, or use IPOL 'TOUS'",
        "triez par ORDO, ou prenez IPOL 'TOUS'",
    ),
    "kernel.curves.abscissas-must-increase-follows": (
        "sort them by ORDO",
        "triez-les par ORDO",
    ),
    "kernel.curves.curves-multiplied-same-abscissas": (
        "bring one to the abscissas of the other by IPOL",
        "portez l'une aux abscisses de l'autre par IPOL",
    ),
    "kernel.elements.beam-cell-zero-length": (
        "remove it or merge its nodes (ELIM, DEDU)",
        "ôtez-le ou confondez ses noeuds (ELIM, DEDU)",
    ),
    "kernel.elements.element-carries-fields-pressures": (
        "name another in MODE: {others}",
        "nommez-en un autre dans MODE : {others}",
    ),
    "kernel.elements.element-describes-section-beam": (
        "give its model to a beam TIMO: MATE MODL1 'MODS' model 'MATS' material",
        "donner son modèle à une poutre TIMO : MATE MODL1 'MODS' modèle 'MATS' matériau",
    ),
    "kernel.elements.gradient-motion-determinant-not": (
        "matter cannot be turned inside out: is the field F, or F - 1 ('DEPL')?",
        "la matière ne se retourne pas : le champ est-il F, ou F - 1 ('DEPL') ?",
    ),
    "kernel.elements.line-cell-zero-length": (
        "remove it or merge its nodes (ELIM, DEDU)",
        "ôtez-le ou confondez ses noeuds (ELIM, DEDU)",
    ),
    "kernel.elements.elastic-matrix-element-cannot": (
        "give the sheared sections SECY and SECZ to MATE or CARA",
        "donnez les sections cisaillées SECY et SECZ à MATE ou CARA",
    ),
    "kernel.elements.generalised-plane-strain-needs": (
        "give it to MODE after the word DPGE",
        "donnez-le à MODE après le mot DPGE",
    ),
    "kernel.elements.pressure-component-field": (
        "take one with EXCO",
        "prenez-en une par EXCO",
    ),
    "kernel.elements.volume-force-components-field": (
        "change their names with NOMC or EXCO",
        "changez leurs noms par NOMC ou EXCO",
    ),
    "kernel.elements.shell-cell-zero-length": (
        "remove it or merge its nodes (ELIM)",
        "ôtez-le ou confondez ses noeuds (ELIM)",
    ),
    "kernel.elements.field-project-must-stand": (
        "CHAN 'NOEUD' model field",
        "CHAN 'NOEUD' modèle champ",
    ),
    "kernel.elements.orthotropic-material-needs-axes": (
        "give DIRECTION and one vector (two in space) to MATE",
        "donnez à MATE DIRECTION et un vecteur (deux en 3D)",
    ),
    "kernel.elements.impedance-changes-frequency-no": (
        "it works in a sweep of frequencies: OPTI 'MODE' 'FREQ', then PASAPAS",
        "elle sert dans un balayage en fréquence : OPTI 'MODE' 'FREQ', puis PASAPAS",
    ),
    "kernel.elements.curve-moco-named": (
        "EVOL 'MANU' 'FREQ' LREEL1 'MOCO' LREEL2 (stiffness), ... 'VISC' LREEL3",
        "EVOL 'MANU' 'FREQ' LREEL1 'MOCO' LREEL2 (raideur), ... 'VISC' LREEL3",
    ),
    "kernel.elements.field-no-component": (
        "give the temperature the component T (NOMC)",
        "donnez à la température la composante T (NOMC)",
    ),
    "kernel.elements.parameter-missing-element": (
        "{given:?give it with MATE or CARA; given: {given}|the field of properties holds "
        "nothing on these cells: make it with MATE of this model (ET joins the fields of "
        "several)}",
        "{given:?donnez-le par MATE ou CARA ; sont donnés : {given}|le champ de "
        "caractéristiques n'a rien sur ces éléments : faites-le par MATE de ce modèle (ET "
        "réunit les champs de plusieurs)}",
    ),
    "kernel.elements.parameter-curve-depends-field": (
        "evaluate it first at the state wanted (VARI)",
        "évaluez-le d'abord à l'état voulu (VARI)",
    ),
    "kernel.elements.impedance-no-strains": (
        "their force is the stiffness (RIGI) times the displacement",
        "leur force est la raideur (RIGI) fois le déplacement",
    ),
    "kernel.elements.pressure-cells-stands-nodes": (
        "CHAN 'NOEUD'",
        "CHAN 'NOEUD'",
    ),
    "kernel.elements.cells-no-side-cell": (
        "{inside:?give sides of the model's cells: lines of a surface (CONT, COTE), faces of "
        "a volume (ENVE, FACE)|the surface and the model's mesh must share their nodes "
        "(ELIM)}",
        "{inside:?donnez des côtés des éléments du modèle : lignes d'une surface (CONT, "
        "COTE), faces d'un volume (ENVE, FACE)|la surface et le maillage du modèle doivent "
        "avoir les mêmes noeuds (ELIM)}",
    ),
    "kernel.fields.fields-natures-cannot-joined": (
        "give them the same nature by CHAN 'ATTRIBUT', or write + to add them",
        "donnez-leur la même nature par CHAN 'ATTRIBUT', ou ajoutez-les par +",
    ),
    "kernel.fields.field-divide-zero": (
        "see MASQ and BORN",
        "voyez MASQ et BORN",
    ),
    "kernel.fields.component-stands-field": (
        "bring them to the same points by CHAN",
        "portez-les aux mêmes points par CHAN",
    ),
    "kernel.fields.zone-first-field-not": (
        "reduce both to the same model by REDU",
        "réduisez les deux au même modèle par REDU",
    ),
    "kernel.fields.field-components": (
        "give a field of one component: EXCO takes it out",
        "donnez un champ d'une composante : EXCO l'extrait",
    ),
    "kernel.fields.field-not-stand-nodes": (
        "CHAN 'NOEUD' brings it there",
        "CHAN 'NOEUD' l'y porte",
    ),
    "kernel.fields.field-holds-no-principal": (
        "give the result of PRIN, or a LISTMOTS of the vector's components",
        "donnez le résultat de PRIN, ou un LISTMOTS des composantes du vecteur",
    ),
    "kernel.interface.joint-both-sides-same": (
        "do not apply ELIM to the two sides of a joint together",
        "n'appliquez pas ELIM aux deux faces d'un joint ensemble",
    ),
    "kernel.interface.joint-normal-goes-first": (
        "walk both sides with the joint on the right hand, or exchange the two meshes given "
        "to RACC (LIAI): the first is the upper side",
        "parcourez les deux faces en ayant le joint à main droite, ou échangez les deux "
        "maillages donnés à RACC (LIAI) : le premier est la face supérieure",
    ),
    "kernel.interface.joint-joi1-no-length": (
        "give it by MATE ... 'DIRECTION' n (from the first node to the second)",
        "donnez-la par MATE ... 'DIRECTION' n (du premier noeud au second)",
    ),
    "kernel.materials.trac-begins-zero-stress": (
        "EVOL 'MANU' (PROG 0. 1.E-3 0.1) (PROG 0. 200.E6 300.E6), or ECRO",
        "donnez EVOL 'MANU' (PROG 0. 1.E-3 0.1) (PROG 0. 200.E6 300.E6), ou ECRO",
    ),
    "kernel.matrices.field-values-fits-conditions": (
        "give relations a number, or 'RELA' and a field of component SCAL",
        "donnez aux relations un nombre, ou 'RELA' et un champ de composante SCAL",
    ),
    "kernel.matrices.matrix-no-relation": (
        "BLOQ and RELA make them",
        "BLOQ et RELA en font",
    ),
    "kernel.mesh.four-side-faces-not": (
        "give opposite faces one after the other, and merge common nodes with ELIM",
        "donnez les faces opposées l'une après l'autre, et confondez les noeuds communs par ELIM",
    ),
    "kernel.mesh.centre-two-ends-line": (
        "make a half circle with CERC 'ROTA' or in two arcs",
        "faites un demi-cercle par CERC 'ROTA' ou en deux arcs",
    ),
    "kernel.mesh.no-mesh-made-elements": (
        "see OPTI ELEM",
        "voyez OPTI ELEM",
    ),
    "kernel.mesh.no-surface-made-elements": (
        "choose a surface element first: OPTI ELEM QUA4 (or TRI3, QUA8, TRI6)",
        "choisissez d'abord un élément de surface : OPTI ELEM QUA4 (ou TRI3, QUA8, TRI6)",
    ),
    "kernel.mesh.cells-type-cannot-follow": (
        "linear surfaces and volumes do: CHAN 'LINEAIRE'",
        "les surfaces et volumes linéaires le peuvent : CHAN 'LINEAIRE'",
    ),
    "kernel.mesh.four-sides-not-form": (
        "merge their common points with ELIM, or change their order",
        "confondez leurs points communs par ELIM, ou changez leur ordre",
    ),
    "kernel.mesh.facing-cells-paired-within": (
        "give the distance, or set the density (DENS) whose tenth is taken",
        "donnez la distance, ou une densité (DENS) dont le dixième est pris",
    ),
    "kernel.mesh.line-cells-not-follow": (
        "{twice:?make both parts with the same point, or merge the nodes: ELIM GEO1 0.001|"
        "join its parts with ET, and turn the reversed ones with INVE}",
        "{twice:?faites les deux parties avec le même point, ou fusionnez les noeuds : ELIM GEO1 "
        "0.001|réunissez ses parties par ET, et retournez par INVE celles qui sont inversées}",
    ),
    "kernel.mesh.cells-not-divided": (
        "{value:words} are: CHAN LINE makes cells linear",
        "{value:words} le font : CHAN LINE rend les éléments linéaires",
    ),
    "kernel.mesh.nodes-merged-within-positive": (
        "give the distance, or set the density (DENS) whose tenth is taken",
        "donnez la distance, ou une densité (DENS) dont le dixième est pris",
    ),
    "kernel.mesh.mesh-size-not-set": (
        "say OPTI 'DENS' X before",
        "dites d'abord OPTI 'DENS' X",
    ),
    "kernel.mesh.mesh-sizes-must-positive": (
        "give the number of elements (an ENTIER: 10, not 10.), or set sizes with DENS, DINI "
        "and DFIN",
        "donnez le nombre d'éléments (un ENTIER : 10, pas 10.), ou des tailles par DENS, "
        "DINI et DFIN",
    ),
    "kernel.mesh.polygons-straight-sides-contour": (
        "CHAN 'LINEAIRE' makes it straight",
        "CHAN 'LINEAIRE' le rend droit",
    ),
    "kernel.mesh.lines-contour-not-run": (
        "turn some with INVE",
        "retournez-en par INVE",
    ),
    "kernel.mesh.contour-crosses-itself-two": (
        "look at it with TRAC",
        "regardez-le par TRAC",
    ),
    "kernel.mesh.side-contour-passes-through": (
        "look for crossing lines or coincident points (ELIM)",
        "cherchez des lignes qui se croisent ou des points confondus (ELIM)",
    ),
    "kernel.mesh.volume-filled-tri3-qua4": (
        "change its cells first: CHAN 'TRI3' or CHAN 'TRI6'",
        "changez d'abord ses éléments : CHAN 'TRI3' ou CHAN 'TRI6'",
    ),
    "kernel.mesh.germ-lies-outside-contour": (
        "INCL takes the points inside",
        "INCL prend les points intérieurs",
    ),
    "kernel.mesh.two-germs-lie-same": (
        "merge them with ELIM",
        "confondez-les par ELIM",
    ),
    "kernel.mesh.surfaces-tri3-needed-cross": (
        "CHAN 'TRI3' cuts quadrangles into triangles",
        "CHAN 'TRI3' coupe les quadrangles en triangles",
    ),
    "kernel.mesh.adjacent-cells-described-opposite": (
        "turn one of the parts with INVE, or use ORIE",
        "retournez une partie par INVE, ou ORIE",
    ),
    "kernel.mesh.contour-not-closed-line": (
        "close it, or merge coincident points with ELIM",
        "fermez-le, ou confondez par ELIM les points au même endroit",
    ),
    "kernel.mesh.surface-not-closed-sides": (
        "merge coincident points with ELIM, and check that no face is missing",
        "confondez par ELIM les points au même endroit, et vérifiez qu'aucune face ne manque",
    ),
    "kernel.modal.shapes-no-strains": (
        "recombine the displacement with RECO, then use the model of the body",
        "recombinez le déplacement par RECO, puis prenez le modèle du corps",
    ),
    "kernel.modal.matrices-not-symmetric-modes": (
        "use VIBR 'IRAM'",
        "prenez VIBR 'IRAM'",
    ),
    "kernel.plasticity.parameter-curve": (
        "EVOL 'MANU' strains stresses",
        "donnez EVOL 'MANU' déformations contraintes",
    ),
    "kernel.records.abscissas-not-regularly-spaced": (
        "bring the signal to a constant step by IPOL",
        "portez le signal à un pas constant par IPOL",
    ),
    "kernel.solvers.unknowns-without-stiffness": (
        "are there bodies with YOUN = 0? leave them out of the model (MODE)",
        "y a-t-il des corps de YOUN = 0 ? laissez-les hors du modèle (MODE)",
    ),
    "kernel.solvers.no-set-active-unilateral": (
        "turn the field of 'DUAL' round, or take MINI for MAXI",
        "retournez le champ de 'DUAL', ou prenez MINI au lieu de MAXI",
    ),
    "kernel.solvers.no-set-active-unilateral-2": (
        "a body held by MINI/MAXI conditions alone must be pressed against them by its loads",
        "un corps que seules des conditions MINI/MAXI tiennent doit être pressé contre elles "
        "par son chargement",
    ),
    "kernel.solvers.multigrid-solves-symmetric-positive": (
        "without ELIM 0, STAB and relations with a dual; a direct solver takes the others",
        "sans ELIM 0, ni STAB, ni relations avec une duale ; un solveur direct prend les autres",
    ),
    "kernel.solvers.multigrid-did-not-converge": (
        "hold every body (BLOQ); OPTI 'SOLVEUR' 'AUTO' factorises where memory holds the factor, "
        "and says which motion is free; OPTI 'SOLVEUR' 'MULTIGRILLE' 1.E-8 asks for less",
        "tenez chaque corps (BLOQ) ; OPTI 'SOLVEUR' 'AUTO' factorise si la mémoire suffit, et dit "
        "quel mouvement est libre ; OPTI 'SOLVEUR' 'MULTIGRILLE' 1.E-8 demande moins",
    ),
    "kernel.solvers.petsc-did-not-converge": (
        "hold every body (BLOQ); with more memory a direct solver says which motion is free",
        "tenez chaque corps (BLOQ) ; avec plus de mémoire un solveur direct dit quel "
        "mouvement est libre",
    ),
    "kernel.statics.beams-sections-fibres-no": (
        "PASAPAS and DYNAMIC take such models, MOCU gives moments from curvatures",
        "PASAPAS et DYNAMIC prennent ces modèles, MOCU donne les moments des courbures",
    ),
    "kernel.statics.unknowns-too-many-choose": (
        "say which: TAB1 . 'TEMPS_CALCULES' = PROG ... ;",
        "dites lesquelles : TAB1 . 'TEMPS_CALCULES' = PROG ... ;",
    ),
    "kernel.statics.system-no-natural-frequency": (
        "say which: TAB1 . 'TEMPS_CALCULES' = PROG ... ;",
        "dites lesquelles : TAB1 . 'TEMPS_CALCULES' = PROG ... ;",
    ),
    "kernel.statics.load-ends-hz-below": (
        "say the frequencies: TAB1 . 'TEMPS_CALCULES' = PROG ... ;",
        "dites les fréquences : TAB1 . 'TEMPS_CALCULES' = PROG ... ;",
    ),
    "kernel.statics.unilateral-condition-no-harmonic": (
        "hold with equalities (BLOQ, RELA without MINI or MAXI), or work in time",
        "tenir par des égalités (BLOQ, RELA sans MINI ni MAXI), ou calculer en temps",
    ),
    "kernel.statics.pressure-without-sides": (
        "join MODE GEO1 'CHARGEMENT' 'PRESSION' of these sides to MODELE",
        "joignez à MODELE le modèle MODE GEO1 'CHARGEMENT' 'PRESSION' de ces faces",
    ),
    "kernel.statics.pressure-follows": (
        "leave PRES out of CHARGEMENT; TAB1 . 'PROCEDURE_CHARMECA' = VRAI calls your procedure "
        "CHARMECA where the bodies are: T . 'ADDI_SECOND' = BSIG MODL1 (PRES MODL1 'PRES' P1)",
        "ôtez PRES de CHARGEMENT ; TAB1 . 'PROCEDURE_CHARMECA' = VRAI appelle votre procédure "
        "CHARMECA sur la configuration courante : T . 'ADDI_SECOND' = BSIG MODL1 "
        "(PRES MODL1 'PRES' P1)",
    ),
    "kernel.statics.pressure-is-no-field-in-cells": (
        "CHAR 'PRES' (PRES MODL1 'PRES' P1) EVOL1",
        "CHAR 'PRES' (PRES MODL1 'PRES' P1) EVOL1",
    ),
    "kernel.statics.free-strains-in-large-displacements": (
        "leave it out, or take out 'GRANDS_DEPLACEMENTS'",
        "ôtez-le, ou ôtez 'GRANDS_DEPLACEMENTS'",
    ),
    "kernel.statics.given-strain-is-no-field-in-cells": (
        "CHAR 'DEFI' (MANU 'CHML' MODL1 'EPXX' X1 ... 'TYPE' 'DEFORMATIONS' 'STRESSES') EVOL1",
        "CHAR 'DEFI' (MANU 'CHML' MODL1 'EPXX' X1 ... 'TYPE' 'DEFORMATIONS' 'STRESSES') EVOL1",
    ),
    "kernel.statics.load-not-mechanical": (
        "MECA (or FORC) and DIMP are taken here, PRES, T and DEFI by PASAPAS",
        "MECA (ou FORC) et DIMP sont admis ici, PRES, T et DEFI par PASAPAS",
    ),
    "kernel.statics.loads-drive-motions": (
        "not held: {free}{more:? and {more} more}; hold it with BLOQ or RELA{apart:?; "
        "{apart} {apart:node lies on a node|nodes lie on nodes} of another body (ELIM)}",
        "non tenu : {free}{more:? et {more} {more:autre|autres}} ; bloquez-le par BLOQ ou "
        "RELA{apart:? ; {apart} {apart:noeud est sur celui|noeuds sont sur ceux} d'un autre "
        "corps (ELIM)}",
    ),
    "kernel.statics.matrix-no-unknown-force": (
        "{n_above:?node {above} lies on node {below} of the matrix: coordinates that are "
        "written again make a new node, the mesh's own is MAIL1 POIN 'PROC' P1|take it out "
        "of the second member, or say 'NOID'}",
        "{n_above:?le noeud {above} est sur le noeud {below} de la matrice : des coordonnées "
        "écrites de nouveau font un nouveau noeud, celui du maillage est MAIL1 POIN 'PROC' "
        "P1|ôtez-la du second membre, ou dites 'NOID'}",
    ),
    "kernel.mesh.sides-do-not-fit": (
        "divide both sides alike (the same numbers and sizes in DROI), or say 'PART' to join "
        "only the cells that fit",
        "découpez les deux côtés de la même façon (mêmes nombres et tailles dans DROI), ou dites "
        "'PART' pour ne joindre que les éléments qui se correspondent",
    ),
    "kernel.statics.solution-without-multipliers": (
        "{others:?a BLOQ or RELA made again has multipliers of its own: give REAC the one that "
        "RESO, DYNAMIC or PASAPAS had|take the solution as RESO gives it; in DYNAMIC, "
        "MAILLAGE_SAUVE keeps only its nodes: add EXTR RIG1 'MAIL' 'MULT'}",
        "{others:?un BLOQ ou RELA refait a ses propres multiplicateurs : donnez à REAC celui "
        "qu'avait RESO, DYNAMIC ou PASAPAS|prenez la solution telle que RESO la donne ; dans "
        "DYNAMIC, MAILLAGE_SAUVE ne garde que ses noeuds : ajoutez EXTR RIG1 'MAIL' 'MULT'}",
    ),
    "kernel.statics.no-equilibrium-full-uplift": (
        "less eccentric loads, a support, or a dynamic calculation; if the loads press, the "
        "joint's sides are swapped: RACC (INVE GEO1) GEO2 turns it round, and a joint JOI1 opens "
        "where its second node goes along DIRECTION",
        "un chargement moins excentré, un appui, ou un calcul dynamique ; si le chargement "
        "presse, les côtés du joint sont inversés : RACC (INVE GEO1) GEO2 le retourne, et un "
        "joint JOI1 s'ouvre quand son second noeud va selon DIRECTION",
    ),
    "kernel.stepping.motions-without-mass": (
        "not held: {free}{more:? and {more} more}; hold it with BLOQ or RELA{apart:?; "
        "{apart} {apart:node lies on a node|nodes lie on nodes} of another body (ELIM)}, or "
        "give it mass (MASS)",
        "non tenu : {free}{more:? et {more} {more:autre|autres}} ; bloquez-le par BLOQ ou "
        "RELA{apart:? ; {apart} {apart:noeud est sur celui|noeuds sont sur ceux} d'un autre "
        "corps (ELIM)}, ou donnez-lui une masse (MASS)",
    ),
    "kernel.stepping.conditions-hold-every-unknown": (
        "leave some free: BLOQ of fewer nodes or unknowns, or RESO for the state that supports "
        "impose",
        "laissez-en libres : BLOQ de moins de noeuds ou d'inconnues, ou RESO pour l'état que "
        "les appuis imposent",
    ),
    "kernel.matrices.mass-negative": (
        "look for the sign in MASS or MANU, or in the factor of a matrix",
        "cherchez le signe dans MASS ou MANU, ou dans le coefficient d'une matrice",
    ),
    "kernel.stepping.matrix-added-during-calculation": (
        "give RIGI a stiffness (of zero, if need be) with this unknown",
        "donnez à RIGI une raideur (nulle, au besoin) avec cette inconnue",
    ),
    "kernel.stepping.unilateral-relations-mini-maxi": (
        "put them into RIGI from the start",
        "mettez-les dans RIGI dès le début",
    ),
    "kernel.stepping.joints-need-parameters": (
        "give CARACTERISTIQUES with MODELE",
        "donner CARACTERISTIQUES avec MODELE",
    ),
    "kernel.stepping.stiffness-holds-joints-whose": (
        "give MODELE and CARACTERISTIQUES with these joints",
        "donnez MODELE et CARACTERISTIQUES avec ces joints",
    ),
    "kernel.stepping.load-not-mechanical": (
        "MECA (or FORC) and DIMP are taken here, PRES, T and DEFI by PASAPAS",
        "MECA (ou FORC) et DIMP sont admis ici, PRES, T et DEFI par PASAPAS",
    ),
    "kernel.stepping.full-uplift": (
        "give it mass (MASS), a support, or loads that press it on its joints",
        "donnez-lui une masse (MASS), un appui, ou un chargement qui le presse sur ses joints",
    ),
    "kernel.stepping.full-uplift-of-body": (
        "give it mass (MASS), a support, or loads that press it on its joints",
        "donnez-lui une masse (MASS), un appui, ou un chargement qui le presse sur ses joints",
    ),
    "kernel.stepping.reduction-unilateral": (
        "leave 'REDUCTION', or describe contact by joints (JOINT_SDM)",
        "ôtez 'REDUCTION', ou décrivez le contact par des joints (JOINT_SDM)",
    ),
    "kernel.stepping.reduction-not-associated": (
        "leave 'REDUCTION'",
        "ôtez 'REDUCTION'",
    ),
    "kernel.stepping.reduction-steps": (
        "leave 'REDUCTION'",
        "ôtez 'REDUCTION'",
    ),
    "kernel.stepping.conserving-step-no-friction": (
        "leave 'CONSERVATIF'",
        "ôtez 'CONSERVATIF'",
    ),
    "kernel.continuation.link-remembers-past-plastic": (
        "friction that slides alone: 'RAIDEUR_TANGENTIELLE' negative",
        "prenez un frottement sans adhérence : 'RAIDEUR_TANGENTIELLE' négative",
    ),
    "kernel.matrices.conditions-matrix-hold-master": (
        "leave out 'NOMU', or choose other masters",
        "retirez 'NOMU', ou choisissez d'autres maîtres",
    ),
    "kernel.matrices.unilateral-non-associated-conditions": (
        "leave out 'NOMU'",
        "retirez 'NOMU'",
    ),
    "kernel.matrices.rigid-body-distances-needs": (
        "tie the nodes to a centre that turns, a point: RELA 'CORI' 'DEPL' 'ROTA' C1 GEO1 ; "
        "'NOVERIF' leaves a mechanism of nodes that lie too flat",
        "liez les noeuds à un centre qui tourne, un point : RELA 'CORI' 'DEPL' 'ROTA' C1 GEO1 ; "
        "'NOVERIF' laisse un mécanisme à des noeuds trop plats",
    ),
    "kernel.plasticity.time-no-solution-found": (
        "a smaller 'DSMIN'",
        "un 'DSMIN' plus petit",
    ),
    "kernel.plasticity.finite-displacements-not-built": (
        "continuous elements, bars, beams (POUT, TIMO) and plane COQ2 have them: mesh the body "
        "with these. Without 'GRANDS_DEPLACEMENTS' small displacements are calculated, another "
        "problem, whose stresses are right only while rotations stay far below 1",
        "les massifs, les barres, les poutres (POUT, TIMO) et les COQ2 du plan les ont : maillez "
        "le corps ainsi. Sans 'GRANDS_DEPLACEMENTS' on calcule de petits déplacements, un autre "
        "problème, dont les contraintes ne sont justes que si les rotations restent bien "
        "inférieures à 1",
    ),
    "kernel.plasticity.time-no-point-path": (
        "a smaller 'AUTOCRIT', or a control that grows along the path; supports "
        "(BLOCAGES_MECANIQUES) that hold the structure",
        "un 'AUTOCRIT' plus petit, ou un pilotage qui croît le long du chemin ; des appuis "
        "(BLOCAGES_MECANIQUES) qui tiennent la structure",
    ),
    "kernel.records.record-no-whole-shock": (
        "a lower 'DECL' or a shorter 'ACQU'",
        "donnez un 'DECL' plus bas ou un 'ACQU' plus court",
    ),
    "kernel.modal.default-list-frequencies-too": (
        "give 'FREQ'",
        "donnez 'FREQ'",
    ),
    "kernel.waves.nothing-beyond-box": (
        "TAB1 . 'INTERIEUR' is the ground inside, TAB1 . 'MODELE' that of the layer around it",
        "TAB1 . 'INTERIEUR' est le sol à l'intérieur, TAB1 . 'MODELE' celui de la couche autour",
    ),
}

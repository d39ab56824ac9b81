"""What the procedures of the standard library refuse: ERRE 'stdlib.name' values, in order."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "afevozt-horizontal-vertical-not": Message(
        "@AFEVOZT: HORIZONTAL or VERTICAL, not {1}",
        "@AFEVOZT : HORIZONTAL ou VERTICAL, pas {1}",
    ),
    "afevozt-two-times-least-aspect": Message(
        "@AFEVOZT: two times at least, and an aspect that is not zero, are needed",
        "@AFEVOZT : il faut au moins deux temps, et un rapport d'aspect non nul",
    ),
    "afevozt-times-no-curve": Message(
        "@AFEVOZT: there are {1} times, but no curve {2}",
        "@AFEVOZT : il y a {1} temps, mais pas de courbe {2}",
    ),
    "bilan-nothing-checked-table": Message(
        "@BILAN: nothing was checked with this table",
        "@BILAN : rien n'a été vérifié avec cette table",
    ),
    "bilan-checks-tolerance": Message(
        "{1} of {2} checks out of tolerance",
        "{1} vérifications sur {2} hors tolérance",
    ),
    "accord-records": Message(
        "@ACCORD: SIGNAUX is a table of records numbered from 1",
        "@ACCORD : SIGNAUX est une table de signaux numérotés à partir de 1",
    ),
    "accord-band": Message(
        "@ACCORD: PERIODES are two, increasing and above zero",
        "@ACCORD : PERIODES sont deux, croissantes et positives",
    ),
    "accord-target": Message(
        "@ACCORD: CIBLE goes from {1} to {2} Hz, the band from {3} to {4} Hz",
        "@ACCORD : CIBLE va de {1} à {2} Hz, la bande de {3} à {4} Hz",
        "PERIODES are in s, CIBLE is over Hz (FREQPERI turns one into the other)",
        "PERIODES sont en s, CIBLE est en Hz (FREQPERI passe de l'un à l'autre)",
    ),
    "accord-floor": Message(
        "@ACCORD: PLANCHER is from 0 to 2, not {1}",
        "@ACCORD : PLANCHER est entre 0 et 2, pas {1}",
    ),
    "accord-missed": Message(
        "@ACCORD: record {1} is {2} per cent from the target, TOLERANCE allows {3}",
        "@ACCORD : le signal {1} est à {2} pour cent du spectre visé, TOLERANCE en admet {3}",
        "a record nearer to the target, a shorter band or a larger TOLERANCE",
        "un signal plus proche, une bande plus courte ou une TOLERANCE plus grande",
        severity="warning",
    ),
    "accord-far": Message(
        "@ACCORD: record {1} is multiplied by {2}: it is none of the target's earthquake",
        "@ACCORD : le signal {1} est multiplié par {2} : il n'est pas du séisme visé",
        "codes and authors stay between 0.25 and 4; in g, or in cm/s2?",
        "codes et auteurs restent entre 0.25 et 4 ; en g, ou en cm/s2 ?",
        severity="warning",
    ),
    "accord-record": Message(
        "record {1}: times {2}, mean misfit {3} per cent, largest {4} per cent",
        "signal {1} : fois {2}, écart moyen {3} pour cent, le plus grand {4} pour cent",
    ),
    "accord-mean": Message(
        "mean of {1} records over the target: least {2} at {3} Hz, largest {4} at {5} Hz",
        "moyenne de {1} signaux sur la cible : au moins {2} à {3} Hz, au plus {4} à {5} Hz",
    ),
    "cible-soil": Message(
        "@CIBLE: SOL is A, B, C, D or E, not {1}",
        "@CIBLE : SOL est A, B, C, D ou E, pas {1}",
    ),
    "cible-needs": Message(
        "@CIBLE: the spectrum of {1} needs {2}",
        "@CIBLE : le spectre {1} demande {2}",
    ),
    "cible-frequency": Message(
        "@CIBLE: {1} Hz is a period beyond 4 s, where EN 1998-1 3.2.2.2 ends",
        "@CIBLE : {1} Hz est une période au-delà de 4 s, où s'arrête EN 1998-1 3.2.2.2",
        "FREQUENCES of 0.25 Hz at least",
        "FREQUENCES d'au moins 0.25 Hz",
    ),
    "cible-damping": Message(
        "@CIBLE: the spectrum of ASCE 7 is that of 5 per cent, AMORTISSEMENT is {1}",
        "@CIBLE : le spectre d'ASCE 7 est celui de 5 pour cent, AMORTISSEMENT vaut {1}",
    ),
    "cible-corners": Message(
        "@CIBLE: TL, {1} s, is below the corner SD1/SDS, {2} s",
        "@CIBLE : TL, {1} s, est sous le coin SD1/SDS, {2} s",
    ),
    "bilanssi-no-instants": Message(
        "@BILANSSI: no instant of RESULTATS has tractions of joints (CONTRAINTES)",
        "@BILANSSI : aucun instant de RESULTATS n'a de contraintes de joints (CONTRAINTES)",
        "the joints must be in MODELE of the run, and instants be saved, from DEBUT on",
        "les joints doivent être dans MODELE du calcul, et des instants gardés, à partir de DEBUT",
    ),
    "bilanssi-no-weight": Message(
        "@BILANSSI: nothing presses the footing at its first instant, t = {1} s: force {2} N",
        "@BILANSSI : rien n'appuie la semelle à son premier instant, t = {1} s : force {2} N",
        "gravity forgotten? DEBUT leaves instants before it out",
        "pesanteur oubliée ? DEBUT écarte les instants d'avant",
        severity="warning",
    ),
    "bilanssi-dead-load": Message(
        "@BILANSSI: the pressure at the first instant, {1} Pa, exceeds the capacity, {2} Pa",
        "@BILANSSI : la pression au premier instant, {1} Pa, dépasse la capacité, {2} Pa",
        severity="warning",
    ),
    "bilanssi-broadening": Message(
        "@BILANSSI: ELARGISSEMENT is from 0 to below 1, not {1}",
        "@BILANSSI : ELARGISSEMENT est entre 0 et moins de 1, pas {1}",
    ),
    "bilanssi-no-acceleration": Message(
        "@BILANSSI: PLANCHERS needs accelerations, which RESULTATS does not have at all instants",
        "@BILANSSI : PLANCHERS demande des accélérations, absentes de RESULTATS à un instant",
    ),
    "bilanssi-head": Message(
        "footing, {1} instants from {2} to {3} s                      value          at (s)",
        "semelle, {1} instants de {2} à {3} s                       valeur           à (s)",
    ),
    "bilanssi-floor": Message(
        "  floor {1}, {2}, {3} %: largest acceleration {4} at {5} Hz",
        "  plancher {1}, {2}, {3} % : plus grande accélération {4} à {5} Hz",
    ),
    "bilanssi-part": Message("least share in contact", "part en contact, la plus petite"),
    "bilanssi-pression": Message(
        "largest toe pressure (Pa)", "pression au bord, la plus grande (Pa)"
    ),
    "bilanssi-taux": Message(
        "largest pressure over the capacity", "pression sur capacité, la plus grande"
    ),
    "bilanssi-ouverture": Message("largest uplift (m)", "soulèvement, le plus grand (m)"),
    "bilanssi-moment": Message("largest moment (N m)", "moment, le plus grand (N m)"),
    "bilanssi-rotation": Message("largest rotation (rad)", "rotation, la plus grande (rad)"),
    "bilanssi-enfoncement": Message("largest settlement (m)", "enfoncement, le plus grand (m)"),
    "bilanssi-renversement": Message(
        "least factor of overturning", "coefficient de renversement, le plus petit"
    ),
    "bilanssi-glissement": Message(
        "least factor of sliding", "coefficient de glissement, le plus petit"
    ),
    "bilanssi-left-rotation": Message("rotation left (rad)", "rotation résiduelle (rad)"),
    "bilanssi-left-enfoncement": Message("settlement left (m)", "enfoncement résiduel (m)"),
    "cartoon-table-neither-resudepl-nor": Message(
        "@CARTOON: the table has neither RESUDEPL nor DEPLACEMENTS",
        "@CARTOON : la table n'a ni RESUDEPL ni DEPLACEMENTS",
    ),
    "cartoon-only-option-noscil-not": Message(
        "@CARTOON: the only option is NOSCIL, not {1}",
        "@CARTOON : la seule option est NOSCIL, pas {1}",
    ),
    "circons-corners-line": Message(
        "@CIRCONS: the corners are on a line",
        "@CIRCONS : les sommets sont alignés",
    ),
    "circons-corners-plane": Message(
        "@CIRCONS: the corners are in a plane",
        "@CIRCONS : les sommets sont dans un même plan",
    ),
    "corigi-no-rigid-motions-known": Message(
        "@CORIGI: no rigid motions are known in mode {1}",
        "@CORIGI : les mouvements de corps rigide ne sont pas connus en mode {1}",
    ),
    "couple-last-number-plane-xoz": Message(
        "@COUPLE: the last number is 1 (plane XOZ) or 2 (plane YOZ), not {1}",
        "@COUPLE : le dernier nombre est 1 (plan XOZ) ou 2 (plan YOZ), pas {1}",
    ),
    "couple-curves-points": Message(
        "@COUPLE: the curves have {1} and {2} points",
        "@COUPLE : les courbes ont {1} et {2} points",
    ),
    "deduire-master-nodes-go-places": Message(
        "@DEDUIRE: {1} master nodes go to {2} places",
        "@DEDUIRE : {1} noeuds maîtres vont à {2} positions",
    ),
    "frenet-least-five-elements-needed": Message(
        "@FRENET: at least five elements are needed, the line has {1}",
        "@FRENET : il faut au moins cinq éléments, la ligne en a {1}",
    ),
    "frenet-only-option-trace-not": Message(
        "@FRENET: the only option is TRACE, not {1}",
        "@FRENET : la seule option est TRACE, pas {1}",
    ),
    "helice-least-element-needed": Message(
        "@HELICE: at least one element is needed",
        "@HELICE : il faut au moins un élément",
    ),
    "impedsol-plane-space": Message(
        "IMPEDSOL: in a plane or in space, not in dimension {1}",
        "IMPEDSOL : dans un plan ou dans l'espace, pas en dimension {1}",
    ),
    "impedsol-poisson": Message(
        "IMPEDSOL: Poisson's ratio {1} is not from 0 to below 0.5",
        "IMPEDSOL : le coefficient de Poisson {1} n'est pas entre 0 et moins de 0.5",
    ),
    "impedsol-size-missing": Message(
        "IMPEDSOL: {1} needs {2}",
        "IMPEDSOL : {1} demande {2}",
    ),
    "impedsol-not-negative": Message(
        "IMPEDSOL: {1} must not be negative, it is {2}",
        "IMPEDSOL : {1} ne doit pas être négatif, il vaut {2}",
    ),
    "impedsol-rests-on-rock": Message(
        "IMPEDSOL: the base at depth {1} m lies on or below the rock at {2} m",
        "IMPEDSOL : la base à {1} m de profondeur est sur le rocher, à {2} m, ou plus bas",
    ),
    "impedsol-formula-of-shape": Message(
        "IMPEDSOL: no formula {1} for {2}",
        "IMPEDSOL : pas de formule {1} pour {2}",
        "DISQUE: VELETSOS CONES PAIS_KAUSEL KAUSEL; RECTANGLE: PAIS_KAUSEL GAZETAS CONES; "
        "BANDE: JAKUB",
        "DISQUE : VELETSOS CONES PAIS_KAUSEL KAUSEL ; RECTANGLE : PAIS_KAUSEL GAZETAS CONES ; "
        "BANDE : JAKUB",
    ),
    "impedsol-no-layer": Message(
        "IMPEDSOL: {1} for {2} is for a half-space; EPAISSEUR, a layer on rock, is not in it",
        "IMPEDSOL : {1} pour {2} vaut pour un demi-espace ; EPAISSEUR, une couche sur rocher, "
        "n'y est pas",
        "layers on rock: DISQUE with KAUSEL, BANDE with JAKUB",
        "couches sur rocher : DISQUE avec KAUSEL, BANDE avec JAKUB",
    ),
    "impedsol-no-embedment": Message(
        "IMPEDSOL: {1} for {2} is for footings at the surface; ENFONCEMENT is not in it",
        "IMPEDSOL : {1} pour {2} vaut pour des fondations en surface ; ENFONCEMENT n'y est pas",
        "embedded: PAIS_KAUSEL for DISQUE and RECTANGLE, KAUSEL for DISQUE in a layer",
        "enfoncées : PAIS_KAUSEL pour DISQUE et RECTANGLE, KAUSEL pour DISQUE dans une couche",
    ),
    "impedsol-static": Message(
        "IMPEDSOL: {1} for {2} is static; FREQUENCES have no meaning for it",
        "IMPEDSOL : {1} pour {2} est statique ; FREQUENCES n'a pas de sens pour elle",
        "against frequency: VELETSOS or CONES for DISQUE, PAIS_KAUSEL or CONES for RECTANGLE",
        "selon la fréquence : VELETSOS ou CONES pour DISQUE, PAIS_KAUSEL ou CONES pour RECTANGLE",
    ),
    "impedsol-damping-at-zero": Message(
        "IMPEDSOL: the dashpot of AMORTISSEMENT, 2 xi K/w, has no value at frequency zero",
        "IMPEDSOL : l'amortisseur d'AMORTISSEMENT, 2 xi K/w, n'a pas de valeur à la fréquence "
        "nulle",
        "give FREQUENCE, the frequency that counts, and FREQUENCES above zero",
        "donner FREQUENCE, la fréquence qui compte, et FREQUENCES au-dessus de zéro",
    ),
    "impedsol-no-radiation": Message(
        "IMPEDSOL: {1} for {2} is static: VISCOSITE has no radiation",
        "IMPEDSOL : {1} pour {2} est statique : VISCOSITE est sans rayonnement",
        severity="warning",
    ),
    "impedsol-range": Message(
        "IMPEDSOL: {2} = {3} is outside the range of {1}, {4} to {5}",
        "IMPEDSOL : {2} = {3} est hors du domaine de {1}, {4} à {5}",
        severity="warning",
    ),
    "impedsol-walls": Message(
        "IMPEDSOL: the dashpots of rotations count the waves from the base alone, not from the "
        "walls",
        "IMPEDSOL : les amortisseurs des rotations ne comptent que les ondes de la base, pas "
        "des parois",
        severity="warning",
    ),
    "impedsol-strip-vertical": Message(
        "IMPEDSOL: no vertical stiffness for BANDE; known formulas miss it by up to a quarter",
        "IMPEDSOL : pas de raideur verticale pour BANDE ; les formules connues s'en écartent "
        "jusqu'au quart",
        severity="warning",
    ),
    "impedsol-coupling": Message(
        "IMPEDSOL: the model at POINT leaves out the coupling of sliding and rocking, {1} N",
        "IMPEDSOL : le modèle au POINT ne contient pas le couplage glissement-balancement, {1} N",
        "put POINT at the height COUPLAGE/RAIDEUR above the base: rocking then loses "
        "COUPLAGE**2/RAIDEUR",
        "placer POINT à la hauteur COUPLAGE/RAIDEUR sur la base : le balancement y perd "
        "COUPLAGE**2/RAIDEUR",
        severity="warning",
    ),
    "impedsol-chosen": Message(
        "impedances: {1} for {2}",
        "impédances : {1} pour {2}",
    ),
    "impedsol-head": Message(
        "          K static      K             C             at {1} Hz, a0 = {2}",
        "          K statique    K             C             à {1} Hz, a0 = {2}",
    ),
    "isosurf-field-takes-none-values": Message(
        "@ISOSURF: the field takes none of the values",
        "@ISOSURF : le champ ne prend aucune de ces valeurs",
    ),
    "lisse-two-points-least-not": Message(
        "@LISSE: two points at least, not {1}",
        "@LISSE : deux points au moins, pas {1}",
    ),
    "lisse-points-must-follow-another": Message(
        "@LISSE: the points must follow one another along the beam",
        "@LISSE : les points doivent se suivre le long de la poutre",
    ),
    "mod-second-object-must-positive": Message(
        "@MOD: the second object must be positive",
        "@MOD : le second objet doit être positif",
    ),
    "ortho-characteristics-needed-list": Message(
        "@ORTHO: 13 characteristics are needed, the list has {1}",
        "@ORTHO : il faut 13 caractéristiques, la liste en a {1}",
    ),
    "ortho-not-mode-force": Message(
        "@ORTHO: {1} is not the mode in force, which is {2}",
        "@ORTHO : {1} n'est pas le mode en vigueur, qui est {2}",
    ),
    "palette-between-colours-not": Message(
        "@PALETTE: between 0 and 20 colours, not {1}",
        "@PALETTE : entre 0 et 20 couleurs, pas {1}",
    ),
    "palette-only-palette-arcenciel-not": Message(
        "@PALETTE: the only palette is ARCENCIEL, not {1}",
        "@PALETTE : la seule palette est ARCENCIEL, pas {1}",
    ),
    "pomi-degree-least-needed-not": Message(
        "@POMI: a degree of one at least is needed, not {1}",
        "@POMI : il faut un degré d'au moins un, pas {1}",
    ),
    "pomi-only-option-idem-not": Message(
        "@POMI: the only option is IDEM, not {1}",
        "@POMI : la seule option est IDEM, pas {1}",
    ),
    "repere-axes-drawn-two-three": Message(
        "@REPERE: axes are drawn in two or three dimensions",
        "@REPERE : les axes se tracent en dimension deux ou trois",
    ),
    "repere-sizes-come-three-groups": Message(
        "@REPERE: sizes come by {1}, in one to three groups; {2} were given",
        "@REPERE : les tailles se donnent par {1}, en un à trois groupes ; {2} sont données",
    ),
    "colonne-direction": Message(
        "@COLONNE: the direction is an axis of the plane or of space, not {1} in dimension {2}",
        "@COLONNE : la direction est un axe du plan ou de l'espace, pas {1} en dimension {2}",
    ),
    "seisme-gravity": Message(
        "@SEISME: g must be above zero, it is {1}",
        "@SEISME : g doit être positif, il vaut {1}",
    ),
    "seisme-points": Message(
        "@SEISME: a record has two points at least, this one has {1}",
        "@SEISME : un signal a au moins deux points, celui-ci en a {1}",
    ),
    "seisme-zero": Message(
        "@SEISME: the record is zero everywhere",
        "@SEISME : le signal est nul partout",
    ),
    "seisme-large": Message(
        "@SEISME: the largest acceleration is {1} m/s2, more than 10 g: in cm/s2?",
        "@SEISME : la plus grande accélération vaut {1} m/s2, plus de 10 g : en cm/s2 ?",
        severity="warning",
    ),
    "seisme-drifts": Message(
        "@SEISME: the record ends at a velocity of {1} m/s and a displacement of {2} m",
        "@SEISME : le signal finit à une vitesse de {1} m/s et un déplacement de {2} m",
        "COSI corrects it, as little as possible",
        "COSI le corrige, le moins possible",
        severity="warning",
    ),
    "seisme-peaks": Message(
        "PGA {1} m/s2 at {2} s, PGV {3} m/s, PGD {4} m",
        "PGA {1} m/s2 à {2} s, PGV {3} m/s, PGD {4} m",
    ),
    "seisme-energy": Message(
        "Arias {1} m/s, CAV {2} m/s, durations 5-75 % {3} s, 5-95 % {4} s",
        "Arias {1} m/s, CAV {2} m/s, durées 5-75 % {3} s, 5-95 % {4} s",
    ),
    "solvmec-table-no": Message(
        "@SOLVMEC: the table has no {1}",
        "@SOLVMEC : la table n'a pas {1}",
    ),
    "stat-abscissas-equal-no-regression": Message(
        "@STAT: all abscissas are equal, there is no regression line",
        "@STAT : les abscisses sont toutes égales, il n'y a pas de droite de régression",
    ),
    "syslin-rows-right-hand-sides": Message(
        "@SYSLIN: {1} rows for {2} right-hand sides",
        "@SYSLIN : {1} lignes pour {2} seconds membres",
    ),
    "syslin-row-no-column": Message(
        "@SYSLIN: row {1} has no column {2}",
        "@SYSLIN : la ligne {1} n'a pas de colonne {2}",
    ),
    "syslin-matrix-singular": Message(
        "@SYSLIN: the matrix is singular",
        "@SYSLIN : la matrice est singulière",
    ),
    "verifie-only-option-rela-found": Message(
        "@VERIFIE: the only option is RELA, found {1}",
        "@VERIFIE : la seule option est RELA, trouvé {1}",
    ),
    "verifie-relative-distance-zero-no": Message(
        "@VERIFIE: a relative distance to zero has no meaning",
        "@VERIFIE : un écart relatif à zéro n'a pas de sens",
    ),
    "vis3d-least-position-needed-not": Message(
        "@VIS3D: at least one position is needed, not {1}",
        "@VIS3D : il faut au moins une position, pas {1}",
    ),
    "visor-mesh-no-element-orientation": Message(
        "@VISOR: the mesh has no element with an orientation",
        "@VISOR : le maillage n'a pas d'élément orienté",
    ),
    "accevite-abscissas-freq-peri-not": Message(
        "ACCEVITE: the abscissas are FREQ or PERI, not {1}",
        "ACCEVITE : les abscisses sont FREQ ou PERI, pas {1}",
    ),
    "accevite-frequencies-periods-must-positive": Message(
        "ACCEVITE: frequencies and periods must be positive",
        "ACCEVITE : fréquences et périodes doivent être positives",
    ),
    "ajuste-pmin-pmax-want-bound": Message(
        "AJUSTE: PMIN and PMAX want a bound for each of the parameters P",
        "AJUSTE : PMIN et PMAX demandent une borne pour chacun des paramètres P",
    ),
    "anime-least-shape-needed-not": Message(
        "ANIME: at least one shape is needed, not {1}",
        "ANIME : il faut au moins une déformée, pas {1}",
    ),
    "anime-field-elements-needs-model": Message(
        "ANIME: a field by elements needs its model behind it",
        "ANIME : un champ par éléments demande son modèle à sa suite",
    ),
    "balourd-table-no": Message(
        "BALOURD: the table has no {1}",
        "BALOURD : la table n'a pas {1}",
    ),
    "balourd-table-no-force-fbalourd": Message(
        "BALOURD: the table has no force (FBALOURD, FBALREEL or FBAR_PROJ)",
        "BALOURD : la table n'a pas de force (FBALOURD, FBALREEL ou FBAR_PROJ)",
    ),
    "campbell-classement-modes-space": Message(
        "CAMPBELL: CLASSEMENT is for modes in space",
        "CAMPBELL : CLASSEMENT est pour les modes dans l'espace",
    ),
    "campbell-table-needs-base-modale": Message(
        "CAMPBELL: the table needs BASE_MODALE, or NMODES, RIGIDITE and MASSE",
        "CAMPBELL : la table demande BASE_MODALE, ou NMODES, RIGIDITE et MASSE",
    ),
    "campbell-table-no": Message(
        "CAMPBELL: the table has no {1}",
        "CAMPBELL : la table n'a pas {1}",
    ),
    "campbell-modes-speed-before": Message(
        "CAMPBELL: {1} modes at speed {2}, {3} before",
        "CAMPBELL : {1} modes à la vitesse {2}, {3} avant",
    ),
    "chpr0-field-component-needed": Message(
        "CHPR0: a field of one component is needed, this one has {1}",
        "CHPR0 : il faut un champ d'une seule composante, celui-ci en a {1}",
    ),
    "cinemb-walk-needs-three-dimensions": Message(
        "CINEMB: a walk needs three dimensions",
        "CINEMB : un parcours demande trois dimensions",
    ),
    "cinemb-places-directions-heads": Message(
        "CINEMB: {1} places, {2} directions, {3} heads",
        "CINEMB : {1} positions, {2} directions, {3} verticales",
    ),
    "cinemb-view-has-no-direction": Message(
        "CINEMB: the direction of view {1} has no length",
        "CINEMB : la direction de la vue {1} est de longueur nulle",
    ),
    "cinemb-view-looks-along-head": Message(
        "CINEMB: view {1} looks along the head",
        "CINEMB : la vue {1} regarde le long de la verticale",
    ),
    "contseg3-line-must-made-seg3": Message(
        "CONTSEG3: line {1} must be made of SEG3 only",
        "CONTSEG3 : la ligne {1} doit être faite de SEG3 seulement",
    ),
    "convt-no-unit-time-fs": Message(
        "CONVT: {1} is no unit of time (FS PS NS US MS S H J D A Y)",
        "CONVT : {1} n'est pas une unité de temps (FS PS NS US MS S H J D A Y)",
    ),
    "coq2mas-shells-space-only-opti": Message(
        "COQ2MAS: shells in space only (OPTI DIME 3)",
        "COQ2MAS : coques dans l'espace seulement (OPTI DIME 3)",
    ),
    "coq2mas-layers-cells-tri3-qua4": Message(
        "COQ2MAS: layers have cells TRI3 or QUA4, not {1}",
        "COQ2MAS : les couches ont des éléments TRI3 ou QUA4, pas {1}",
    ),
    "courspec-list-band-values-empty": Message(
        "COURSPEC: the list of band values is empty",
        "COURSPEC : la liste des valeurs par bande est vide",
    ),
    "courspec-time-step-must": Message(
        "COURSPEC: the time step is {1}, it must be > 0",
        "COURSPEC : le pas de temps est {1}, il doit être > 0",
    ),
    "creer-3d-field-cells-needs-model": Message(
        "CREER_3D: a field in cells needs its model",
        "CREER_3D : un champ par éléments demande son modèle",
    ),
    "creer-3d-mesh-field-nodes-field": Message(
        "CREER_3D: give a mesh with a field at nodes, or a field in cells with its model",
        "CREER_3D : donnez un maillage et un champ par points, ou un champ par éléments et "
        "son modèle",
    ),
    "decoappl-layers-not-go-surface": Message(
        "DECONV: the layers do not go from the surface to the base",
        "DECONV : les couches ne vont pas de la surface à la base",
    ),
    "deconv-direction-hori-vert-not": Message(
        "DECONV: the direction is HORI or VERT, not {1}",
        "DECONV : la direction est HORI ou VERT, pas {1}",
    ),
    "deconv-needs-opti-mode-four": Message(
        "DECONV: {1} needs OPTI MODE FOUR {2}",
        "DECONV : {1} demande OPTI MODE FOUR {2}",
    ),
    "deconv-mode-plane-strain-fourier": Message(
        "DECONV: the mode is plane strain or Fourier",
        "DECONV : le mode est en déformations planes ou de Fourier",
    ),
    "deconv3d-direction-ux-uy-uz": Message(
        "DECONV3D: the direction is UX, UY or UZ, not {1}",
        "DECONV3D : la direction est UX, UY ou UZ, pas {1}",
    ),
    "dedans-contours-two-dimensions-opti": Message(
        "DEDANS: contours are of two dimensions (OPTI DIME 2)",
        "DEDANS : les contours sont de dimension deux (OPTI DIME 2)",
    ),
    "destra-no-option": Message(
        "DESTRA: {1} is no option",
        "DESTRA : {1} n'est pas une option",
    ),
    "destra-table-no-curve": Message(
        "DESTRA: the table has no curve {1}",
        "DESTRA : la table n'a pas de courbe {1}",
    ),
    "ec8acsis-without-soil-table-needs": Message(
        "EC8ACSIS: without SOIL the table needs {1}",
        "EC8ACSIS : sans SOIL la table demande {1}",
    ),
    "ec8acsis-tini-must-below-tfin": Message(
        "EC8ACSIS: TINI must be below {1} and TFIN above {2}",
        "EC8ACSIS : TINI doit être inférieur à {1} et TFIN supérieur à {2}",
    ),
    "ec8acsis-type-alin-needs": Message(
        "EC8ACSIS: TYPE ALIN needs Q",
        "EC8ACSIS : TYPE ALIN demande Q",
    ),
    "ec8acsis-displacement-d0-reached-before": Message(
        "EC8ACSIS: the displacement D0 is reached before T2",
        "EC8ACSIS : le déplacement D0 est atteint avant T2",
    ),
    "enermode-basis-no-soustype": Message(
        "ENERMODE: the basis has no SOUSTYPE",
        "ENERMODE : la base n'a pas de SOUSTYPE",
    ),
    "enermode-table-sub-type-no": Message(
        "ENERMODE: a table of sub-type {1} is no modal basis",
        "ENERMODE : une table de sous-type {1} n'est pas une base modale",
    ),
    "enermode-no-result-dyne": Message(
        "ENERMODE: no result of DYNE",
        "ENERMODE : pas de résultat de DYNE",
    ),
    "enermode-basis-holds-no-mode": Message(
        "ENERMODE: the basis holds no mode",
        "ENERMODE : la base ne contient pas de mode",
    ),
    "explorer-words-go-listmots-alone": Message(
        "EXPLORER: words go in a LISTMOTS; alone, CHAR is known, {1} is not",
        "EXPLORER : les mots vont dans un LISTMOTS ; seul, CHAR est connu, {1} ne l'est pas",
    ),
    "explorer-table-no-index": Message(
        "EXPLORER: the table has no index {1}",
        "EXPLORER : la table n'a pas d'indice {1}",
    ),
    "explorer-table-holds-no-result": Message(
        "EXPLORER: the table holds no result, call PASAPAS on it first",
        "EXPLORER : la table ne contient pas de résultat, appelez d'abord PASAPAS avec elle",
    ),
    "explorer-neither-depl-reac-cont": Message(
        "EXPLORER: {1} is neither DEPL REAC CONT VAR TEMP EVOL nor a component",
        "EXPLORER : {1} n'est ni DEPL REAC CONT VAR TEMP EVOL ni une composante",
    ),
    "explorer-name-field-curve-beside": Message(
        "EXPLORER: name the field of the curve beside EVOL",
        "EXPLORER : nommez le champ de la courbe à côté d'EVOL",
    ),
    "explorer-evol-wants-table-topt1": Message(
        "EXPLORER: EVOL wants the table TOPT1 . EVOL",
        "EXPLORER : EVOL demande la table TOPT1 . EVOL",
    ),
    "explorer-table-topt1-evol-no": Message(
        "EXPLORER: the table TOPT1 . EVOL has no index {1}",
        "EXPLORER : la table TOPT1 . EVOL n'a pas d'indice {1}",
    ),
    "explorer-table-topt1-evol-no-2": Message(
        "EXPLORER: the table TOPT1 . EVOL has no index POIN",
        "EXPLORER : la table TOPT1 . EVOL n'a pas d'indice POIN",
    ),
    "explorer-table-topt1-evol-no-3": Message(
        "EXPLORER: the table TOPT1 . EVOL has no index LIGN",
        "EXPLORER : la table TOPT1 . EVOL n'a pas d'indice LIGN",
    ),
    "factorie-negative": Message(
        "FACTORIE: {1} is negative",
        "FACTORIE : {1} est négatif",
    ),
    "fdens-must-below": Message(
        "FDENS: A must be below B",
        "FDENS : A doit être inférieur à B",
    ),
    "filc-transition-hz-not-fit": Message(
        "FILC: the transition of {1} Hz does not fit around {2} Hz",
        "FILC : la transition de {1} Hz ne tient pas autour de {2} Hz",
    ),
    "flambage-table-needs-sig1-rigi": Message(
        "FLAMBAGE: the table needs SIG1, or RIGI and KSIG",
        "FLAMBAGE : la table demande SIG1, ou RIGI et KSIG",
    ),
    "flambage-lam1-must-below-lam2": Message(
        "FLAMBAGE: LAM1 must be below LAM2",
        "FLAMBAGE : LAM1 doit être inférieur à LAM2",
    ),
    "four2tri-harmonic-neither-nor-opti": Message(
        "FOUR2TRI: the harmonic is given neither here nor by OPTI MODE FOUR",
        "FOUR2TRI : l'harmonique n'est donnée ni ici ni par OPTI MODE FOUR",
    ),
    "four2tri-angles-needs-two-angles": Message(
        "FOUR2TRI: ANGLES needs two angles or more",
        "FOUR2TRI : ANGLES demande deux angles ou plus",
    ),
    "four2tri-angles-go-equal-positive": Message(
        "FOUR2TRI: ANGLES go from 0. by equal positive steps",
        "FOUR2TRI : ANGLES part de 0. par pas égaux et positifs",
    ),
    "four2tri-table-no-maillage-no": Message(
        "FOUR2TRI: the table has no MAILLAGE, no MODELE",
        "FOUR2TRI : la table n'a ni MAILLAGE, ni MODELE",
    ),
    "four2tri-mesh-neither-lines-nor": Message(
        "FOUR2TRI: the mesh has neither lines nor surfaces",
        "FOUR2TRI : le maillage n'a ni lignes ni surfaces",
    ),
    "frepart-line-no-length": Message(
        "FREPART: the line has no length",
        "FREPART : la ligne est de longueur nulle",
    ),
    "frepart-cell-nodes-line-cells": Message(
        "FREPART: cell {1} has {2} nodes; a line has cells SEG2 or SEG3",
        "FREPART : l'élément {1} a {2} noeuds ; une ligne a des éléments SEG2 ou SEG3",
    ),
    "fronabs-boundary-lysmer-white-not": Message(
        "FRONABS: the boundary is LYSMER or WHITE, not {1}",
        "FRONABS : la frontière est LYSMER ou WHITE, pas {1}",
    ),
    "fronabs-lines-only-space-amor": Message(
        "FRONABS: lines only; in space AMOR makes the dampers of a surface",
        "FRONABS : lignes seulement ; dans l'espace AMOR fait les amortisseurs d'une surface",
    ),
    "ftran-signals-points": Message(
        "FTRAN: signals of {1} and {2} points",
        "FTRAN : des signaux de {1} et {2} points",
    ),
    "ftran-signals-steps": Message(
        "FTRAN: signals of steps {1} and {2}",
        "FTRAN : des signaux de pas {1} et {2}",
    ),
    "ftran-only-frequencies-below-left": Message(
        "FTRAN: only {1} frequencies below {2}, of which {3} are left out",
        "FTRAN : {1} fréquences seulement sous {2}, dont {3} sont écartées",
    ),
    "ftran-second-signal-nothing-some": Message(
        "FTRAN: the second signal has nothing at the frequency {1}",
        "FTRAN : le second signal n'a rien à la fréquence {1}",
        "a lower F0, or a larger N1, leaves it out",
        "un F0 plus bas, ou un N1 plus grand, l'écarte",
    ),
    "fzero-function-same-sign-both": Message(
        "FZERO: the function has the same sign at both ends: {1} and {2}",
        "FZERO : la fonction a le même signe aux deux bouts : {1} et {2}",
    ),
    "hauban-ends-vertical": Message(
        "HAUBAN: the ends are on one vertical",
        "HAUBAN : les extrémités sont sur une même verticale",
    ),
    "hauban-no-catenary-length-cable": Message(
        "HAUBAN: no catenary has this length; is the cable too soft or too long?",
        "HAUBAN : aucune chaînette n'a cette longueur ; le câble est-il trop souple ou trop long ?",
    ),
    "int-comp-field-component-needed": Message(
        "INT_COMP: a field of one component is needed, this one has {1}",
        "INT_COMP : il faut un champ d'une seule composante, celui-ci en a {1}",
    ),
    "issleq-calculation": Message(
        "ISSLEQ: the calculation is in 3D",
        "ISSLEQ : le calcul est en 3D",
    ),
    "issleq-iss-comp-simp-needs": Message(
        "ISSLEQ: ISS_COMP_SIMP needs SOL . CONSTANTE",
        "ISSLEQ : ISS_COMP_SIMP demande SOL . CONSTANTE",
    ),
    "issleq-parametres-no-gammao-gammao": Message(
        "ISSLEQ: PARAMETRES has no GAMMAO_X, GAMMAO_Y or GAMMAO_Z",
        "ISSLEQ : PARAMETRES n'a pas GAMMAO_X, GAMMAO_Y ou GAMMAO_Z",
    ),
    "issleq-no-layer-base-base": Message(
        "ISSLEQ: no layer has BASE, the base of the soil",
        "ISSLEQ : aucune couche n'a BASE, la base du sol",
    ),
    "issleq-gamma-layer-goes-down": Message(
        "ISSLEQ: G_GAMMA of layer {1} goes down to zero",
        "ISSLEQ : G_GAMMA de la couche {1} descend à zéro",
    ),
    "issleq-no-convergence-after-steps": Message(
        "ISSLEQ: no convergence after 30 steps, last change {1}",
        "ISSLEQ : pas de convergence après 30 pas, dernière variation {1}",
    ),
    "m-damp-k-no-mode-go-last": Message(
        "M_DAMP_K: there is no mode {1} to go with the last damping",
        "M_DAMP_K : il n'y a pas de mode {1} pour le dernier amortissement",
    ),
    "m-dampin-dampings-modes": Message(
        "M_DAMPIN: {1} dampings for {2} modes",
        "M_DAMPIN : {1} amortissements pour {2} modes",
    ),
    "m-dampin-mode-no-stiffness": Message(
        "M_DAMPIN: mode {1} has no stiffness",
        "M_DAMPIN : le mode {1} n'a pas de raideur",
    ),
    "mailler-plane-meshes-only-opti": Message(
        "MAILLER: plane meshes only; OPTI DIME 2 comes first",
        "MAILLER : maillages plans seulement ; OPTI DIME 2 vient d'abord",
    ),
    "mailler-unknown-keyword-known-sol": Message(
        "MAILLER: unknown keyword {1}; known are SOL SEMELLE STRUCTURE POTEAU TAILLE ELEMENT "
        "ABSCISSE SYMETRIE SOUDE",
        "MAILLER : mot-clé {1} inconnu ; sont connus SOL SEMELLE STRUCTURE POTEAU TAILLE "
        "ELEMENT ABSCISSE SYMETRIE SOUDE",
    ),
    "mailler-object-type-no-place": Message(
        "MAILLER: an object of type {1} has no place among the keywords",
        "MAILLER : un objet de type {1} n'a pas de place parmi les mots-clés",
    ),
    "mailler-number-must-stand-behind": Message(
        "MAILLER: a number must stand behind its keyword",
        "MAILLER : un nombre doit suivre son mot-clé",
    ),
    "mailler-too-many-numbers-behind": Message(
        "MAILLER: too many numbers behind {1}",
        "MAILLER : trop de nombres derrière {1}",
    ),
    "mailler-footing-width-missing-semelle": Message(
        "MAILLER: the footing's width is missing (SEMELLE or LARGEUR_SEMELLE)",
        "MAILLER : la largeur de la semelle manque (SEMELLE ou LARGEUR_SEMELLE)",
    ),
    "mailler-must-positive-found": Message(
        "MAILLER: {1} must be positive, found {2}",
        "MAILLER : {1} doit être positif, trouvé {2}",
    ),
    "mailler-hauteur-semelle-must-not": Message(
        "MAILLER: HAUTEUR_SEMELLE must not be negative, found {1}",
        "MAILLER : HAUTEUR_SEMELLE ne doit pas être négatif, trouvé {1}",
    ),
    "mailler-taille-larger-half-footing": Message(
        "MAILLER: TAILLE {1} is larger than half the footing's width {2}",
        "MAILLER : TAILLE {1} dépasse la moitié de la largeur {2} de la semelle",
    ),
    "mailler-taille-loin-smaller-taille": Message(
        "MAILLER: TAILLE_LOIN {1} is smaller than TAILLE {2}",
        "MAILLER : TAILLE_LOIN {1} est inférieur à TAILLE {2}",
    ),
    "mailler-half-model-footing-abscisse": Message(
        "MAILLER: half a model has its footing at x = 0, ABSCISSE is {1}",
        "MAILLER : un demi-modèle a sa semelle en x = 0, ABSCISSE est {1}",
    ),
    "mailler-element-must-qua4-qua8": Message(
        "MAILLER: ELEMENT must be QUA4, QUA8, TRI3 or TRI6, found {1}",
        "MAILLER : ELEMENT est QUA4, QUA8, TRI3 ou TRI6, trouvé {1}",
    ),
    "mailler-soil-box-needs-width": Message(
        "MAILLER: a soil box needs its width and its depth: 'SOL' 24. 8., or LARGEUR_SOL and "
        "PROFONDEUR_SOL",
        "MAILLER : un massif de sol demande sa largeur et sa profondeur : 'SOL' 24. 8., ou "
        "LARGEUR_SOL et PROFONDEUR_SOL",
    ),
    "mailler-footing-width-centre-not": Message(
        "MAILLER: the footing (width {1}, centre {2}) does not stand inside the soil box of "
        "width {3}",
        "MAILLER : la semelle (largeur {1}, centre {2}) ne tient pas dans le massif de sol "
        "de largeur {3}",
    ),
    "mailler-structure-needs-width-height": Message(
        "MAILLER: a structure needs its width and its height: 'STRUCTURE' 2. 6., or "
        "LARGEUR_STRUCTURE and HAUTEUR_STRUCTURE",
        "MAILLER : une structure demande sa largeur et sa hauteur : 'STRUCTURE' 2. 6., ou "
        "LARGEUR_STRUCTURE et HAUTEUR_STRUCTURE",
    ),
    "mailler-structure-poteau-exclude": Message(
        "MAILLER: STRUCTURE and POTEAU exclude each other",
        "MAILLER : STRUCTURE et POTEAU s'excluent",
    ),
    "mailler-structure-width-wider-footing": Message(
        "MAILLER: the structure (width {1}) is wider than its footing ({2})",
        "MAILLER : la structure (largeur {1}) est plus large que sa semelle ({2})",
    ),
    "mailler-footing-without-height-must": Message(
        "MAILLER: a footing without height must be as wide as the structure on it ({1}), found {2}",
        "MAILLER : une semelle sans hauteur doit être aussi large que la structure qu'elle "
        "porte ({1}), trouvé {2}",
    ),
    "montagne-cache-titre-volume-fleche": Message(
        "MONTAGNE: CACHE, TITRE, VOLUME, FLECHE or SUPER, not {1}",
        "MONTAGNE : CACHE, TITRE, VOLUME, FLECHE ou SUPER, pas {1}",
    ),
    "montagne-field-component-needed": Message(
        "MONTAGNE: a field of one component is needed, this one has {1}",
        "MONTAGNE : il faut un champ d'une seule composante, celui-ci en a {1}",
    ),
    "moyespec-second-abscissa-must-exceed": Message(
        "MOYESPEC: the second abscissa must exceed the first",
        "MOYESPEC : la seconde abscisse doit dépasser la première",
    ),
    "multidec-signal-too-short-number": Message(
        "MULTIDEC: the signal is too short, or its number of points is not of the form 2 n + "
        "1 twice",
        "MULTIDEC : le signal est trop court, ou son nombre de points n'est pas deux fois de "
        "la forme 2 n + 1",
    ),
    "multirec-level-details-values": Message(
        "MULTIREC: level {1} has {2} details for {3} values",
        "MULTIREC : le niveau {1} a {2} détails pour {3} valeurs",
    ),
    "orbite-ideb-beyond-points": Message(
        "ORBITE: IDEB is beyond the {1} points",
        "ORBITE : IDEB est au-delà des {1} points",
    ),
    "parastat-values-same": Message(
        "PARASTAT: all values are the same",
        "PARASTAT : toutes les valeurs sont égales",
    ),
    "peche-table-no-index": Message(
        "PECHE: the table has no index {1}",
        "PECHE : la table n'a pas d'indice {1}",
    ),
    "peche-only-option-ipol-not": Message(
        "PECHE: the only option is IPOL, not {1}",
        "PECHE : la seule option est IPOL, pas {1}",
    ),
    "peche-not-between-times-results": Message(
        "PECHE: {1} is not between the times {2} and {3} of the results",
        "PECHE : {1} n'est pas entre les temps {2} et {3} des résultats",
    ),
    "peche-no-result-kept-add": Message(
        "PECHE: no result was kept at {1}: add IPOL to interpolate",
        "PECHE : aucun résultat n'a été gardé à {1} : ajoutez IPOL pour interpoler",
    ),
    "pointcyl-point-space-needs-height": Message(
        "POINTCYL: a point of space needs its height",
        "POINTCYL : un point de l'espace demande sa hauteur",
    ),
    "pointsph-spherical-coordinates-need-opti": Message(
        "POINTSPH: spherical coordinates need OPTI DIME 3",
        "POINTSPH : les coordonnées sphériques demandent OPTI DIME 3",
    ),
    "postvibr-table-no-soustype": Message(
        "POSTVIBR: the table has no SOUSTYPE",
        "POSTVIBR : la table n'a pas de SOUSTYPE",
    ),
    "postvibr-table-sub-type-holds": Message(
        "POSTVIBR: a table of sub-type {1} holds no mode",
        "POSTVIBR : une table de sous-type {1} ne contient pas de mode",
    ),
    "pout2mas-beams-space-only-opti": Message(
        "POUT2MAS: beams in space only (OPTI DIME 3)",
        "POUT2MAS : poutres dans l'espace seulement (OPTI DIME 3)",
    ),
    "pout2mas-gauss-massif-not": Message(
        "POUT2MAS: GAUSS or MASSIF, not {1}",
        "POUT2MAS : GAUSS ou MASSIF, pas {1}",
    ),
    "pout2mas-goes-gauss-only": Message(
        "POUT2MAS: {1} goes with GAUSS only",
        "POUT2MAS : {1} ne va qu'avec GAUSS",
    ),
    "pout2mas-model-elements-beams": Message(
        "POUT2MAS: the model has other elements than beams",
        "POUT2MAS : le modèle a d'autres éléments que des poutres",
    ),
    "pout2mas-relation-goes-massif-elements": Message(
        "POUT2MAS: RELATION_3D goes with MASSIF for elements TIMO",
        "POUT2MAS : RELATION_3D va avec MASSIF pour les éléments TIMO",
    ),
    "quadratu-number-points-between": Message(
        "QUADRATU: the number of points is between 1 and 15",
        "QUADRATU : le nombre de points est entre 1 et 15",
    ),
    "quadratu-law-norm-logn-unif": Message(
        "QUADRATU: the law is NORM, LOGN, UNIF or EXPO, not {1}",
        "QUADRATU : la loi est NORM, LOGN, UNIF ou EXPO, pas {1}",
    ),
    "ramberg-point-must-stress-plastic": Message(
        "RAMBERG: each point must have a stress and a plastic strain above zero",
        "RAMBERG : chaque point doit avoir une contrainte et une déformation plastique "
        "au-dessus de zéro",
    ),
    "ramberg-curve-needs-points-different": Message(
        "RAMBERG: the curve needs points of different stresses and strains",
        "RAMBERG : la courbe demande des points de contraintes et de déformations différentes",
    ),
    "repart-must-below": Message(
        "REPART: A must be below B",
        "REPART : A doit être inférieur à B",
    ),
    "respowns-response-spectrum-wanted": Message(
        "RESPOWNS: one response spectrum is wanted",
        "RESPOWNS : il faut un seul spectre de réponse",
    ),
    "respowns-spectrum-must-above-zero": Message(
        "RESPOWNS: the spectrum must be above zero",
        "RESPOWNS : le spectre doit être au-dessus de zéro",
    ),
    "respowns-no-period-ttrs-spectrum": Message(
        "RESPOWNS: no period of TTRS is in the spectrum",
        "RESPOWNS : aucune période de TTRS n'est dans le spectre",
    ),
    "respowsp-spectra-dampings": Message(
        "RESPOWSP: {1} spectra for {2} dampings",
        "RESPOWSP : {1} spectres pour {2} amortissements",
    ),
    "respowsp-spectra-must-above-zero": Message(
        "RESPOWSP: spectra must be above zero",
        "RESPOWSP : les spectres doivent être au-dessus de zéro",
    ),
    "respowsp-no-period-ttrs-spectra": Message(
        "RESPOWSP: no period of TTRS is in the spectra",
        "RESPOWSP : aucune période de TTRS n'est dans les spectres",
    ),
    "rota-imp-rotations-about-axis-need": Message(
        "ROTA_IMP: rotations about an axis need OPTI DIME 3",
        "ROTA_IMP : les rotations autour d'un axe demandent OPTI DIME 3",
    ),
    "rota-imp-angle-between-degrees-not": Message(
        "ROTA_IMP: the angle is between -90 and 90 degrees, not {1}",
        "ROTA_IMP : l'angle est entre -90 et 90 degrés, pas {1}",
    ),
    "rota-imp-points-axis-same": Message(
        "ROTA_IMP: the points of the axis are the same",
        "ROTA_IMP : les points de l'axe sont confondus",
    ),
    "rota-imp-nodes-axis": Message(
        "ROTA_IMP: all nodes are on the axis",
        "ROTA_IMP : tous les noeuds sont sur l'axe",
    ),
    "signsynt-first-word-fabr-blanc": Message(
        "SIGNSYNT: the first word is FABR or BLANC, not {1}",
        "SIGNSYNT : le premier mot est FABR ou BLANC, pas {1}",
    ),
    "signsynt-no-frequency-signal-below": Message(
        "SIGNSYNT: no frequency of the signal is below the cut-off FRCOUP",
        "SIGNSYNT : aucune fréquence du signal n'est sous la coupure FRCOUP",
    ),
    "signsynt-reference-spectrum-must-positive": Message(
        "SIGNSYNT: the reference spectrum must be positive at all frequencies",
        "SIGNSYNT : le spectre de référence doit être positif à toutes les fréquences",
    ),
    "sissib-frequence-masse-generalisee-mode": Message(
        "SISSIB: FREQUENCE and MASSE_GENERALISEE of mode {1} are above zero",
        "SISSIB : FREQUENCE et MASSE_GENERALISEE du mode {1} sont au-dessus de zéro",
    ),
    "sissib-structure-holds-no-mode": Message(
        "SISSIB: STRUCTURE holds no mode",
        "SISSIB : STRUCTURE ne contient pas de mode",
    ),
    "sissib-amortissement-dampings-modes": Message(
        "SISSIB: AMORTISSEMENT has {1} dampings for {2} modes",
        "SISSIB : AMORTISSEMENT a {1} amortissements pour {2} modes",
    ),
    "sissib-rosenblueth-needs-duree-duration": Message(
        "SISSIB: ROSENBLUETH needs DUREE, the duration of the earthquake",
        "SISSIB : ROSENBLUETH demande DUREE, la durée du séisme",
    ),
    "sissib-sorties-asks-nothing": Message(
        "SISSIB: SORTIES asks for nothing",
        "SISSIB : SORTIES ne demande rien",
    ),
    "sissib-troncature-needs-pseudo-modes": Message(
        "SISSIB: TRONCATURE needs PSEUDO_MODES in STRUCTURE",
        "SISSIB : TRONCATURE demande PSEUDO_MODES dans STRUCTURE",
    ),
    "sissib-spectre-curves-amortissement-dampings": Message(
        "SISSIB: SPECTRE has {1} curves, AMORTISSEMENT {2} dampings",
        "SISSIB : SPECTRE a {1} courbes, AMORTISSEMENT {2} amortissements",
    ),
    "sissib-need-mode": Message(
        "SISSIB: {1} need {2} in mode {3}",
        "SISSIB : {1} demandent {2} au mode {3}",
    ),
    "sissib-pseudo-mode-no": Message(
        "SISSIB: the pseudo-mode of {1} has no {2}",
        "SISSIB : le pseudo-mode de {1} n'a pas {2}",
    ),
    "sissib-excitation-no-item": Message(
        "SISSIB: EXCITATION has no item 1",
        "SISSIB : EXCITATION n'a pas d'élément 1",
    ),
    "sissib-envelopes-frames-type-poteau": Message(
        "SISSIB: envelopes are those of frames (TYPE POTEAU), not of {1}",
        "SISSIB : les enveloppes sont celles de portiques (TYPE POTEAU), pas de {1}",
    ),
    "sissib-frames-need-contrainte-modale": Message(
        "SISSIB: frames need CONTRAINTE_MODALE in mode {1}",
        "SISSIB : les portiques demandent CONTRAINTE_MODALE au mode {1}",
    ),
    "spplanc-nmode-number-modes-more": Message(
        "SPPLANC: NMODE, the number of modes, is 1 or more",
        "SPPLANC : NMODE, le nombre de modes, est 1 ou plus",
    ),
    "spplanc-duree-duration-above-zero": Message(
        "SPPLANC: DUREE, the duration, is above zero",
        "SPPLANC : DUREE, la durée, est au-dessus de zéro",
    ),
    "spplanc-plateau-needs-tdeb-tfin": Message(
        "SPPLANC: the plateau of PLATLIN needs TDEB and TFIN",
        "SPPLANC : le palier de PLATLIN demande TDEB et TFIN",
    ),
    "spplanc-tdeb-tfin-duree-must": Message(
        "SPPLANC: 0, TDEB, TFIN and DUREE must follow one another",
        "SPPLANC : 0, TDEB, TFIN et DUREE doivent se suivre",
    ),
    "tablo2d-rows-values": Message(
        "TABLO2D: {1} rows of {2} values, {3} were given",
        "TABLO2D : {1} lignes de {2} valeurs, {3} sont données",
    ),
    "tablo2d-values-zero-no-logarithm": Message(
        "TABLO2D: all values are zero, which have no logarithm",
        "TABLO2D : toutes les valeurs sont nulles, elles n'ont pas de logarithme",
    ),
    "tablo3d-rows-values": Message(
        "TABLO3D: {1} rows of {2} values, {3} were given",
        "TABLO3D : {1} lignes de {2} valeurs, {3} sont données",
    ),
    "trac3d-2-field-cells-needs-model": Message(
        "TRAC3D_2: a field in cells needs its model",
        "TRAC3D_2 : un champ par éléments demande son modèle",
    ),
    "trac3d-2-mesh-field-nodes-field": Message(
        "TRAC3D_2: give a mesh with a field at nodes, or a field in cells with its model",
        "TRAC3D_2 : donnez un maillage et un champ par points, ou un champ par éléments et "
        "son modèle",
    ),
    "trac3d-2-unknown-component": Message(
        "TRAC3D_2: unknown component {1}",
        "TRAC3D_2 : composante inconnue {1}",
    ),
    "trachis-keywords-pref-unit-not": Message(
        "TRACHIS: the keywords are PREF and UNIT, not {1}",
        "TRACHIS : les mots-clés sont PREF et UNIT, pas {1}",
    ),
    "trachis-unknown-unit-time": Message(
        "TRACHIS: unknown unit of time {1}",
        "TRACHIS : unité de temps inconnue {1}",
    ),
    "trachis-table-no-time": Message(
        "TRACHIS: the table has no time {1}",
        "TRACHIS : la table n'a pas le temps {1}",
    ),
    "trachit-keyword-pref-not": Message(
        "TRACHIT: the keyword is PREF, not {1}",
        "TRACHIT : le mot-clé est PREF, pas {1}",
    ),
    "trachit-table-no-time": Message(
        "TRACHIT: the table has no time {1}",
        "TRACHIT : la table n'a pas le temps {1}",
    ),
    "trachit-table-holds-no-time": Message(
        "TRACHIT: the table holds no time",
        "TRACHIT : la table ne contient aucun temps",
    ),
    "transfer-ground-moves-along-ux": Message(
        "TRANSFER: the ground moves along UX, UY or UZ, not {1}",
        "TRANSFER : le sol bouge suivant UX, UY ou UZ, pas {1}",
    ),
    "transfer-answer-depl-vite-acce": Message(
        "TRANSFER: the answer is DEPL, VITE or ACCE, not {1}",
        "TRANSFER : la réponse est DEPL, VITE ou ACCE, pas {1}",
    ),
    "transfer-form-moph-reim-not": Message(
        "TRANSFER: the form is MOPH or REIM, not {1}",
        "TRANSFER : la forme est MOPH ou REIM, pas {1}",
    ),
    "transfer-dampings-more-modes": Message(
        "TRANSFER: {1} dampings for more modes",
        "TRANSFER : {1} amortissements pour plus de modes",
    ),
    "transfer-table-holds-no-mode": Message(
        "TRANSFER: the table holds no mode",
        "TRANSFER : la table ne contient pas de mode",
    ),
    "vertytab-table-no-entry": Message(
        "VERTYTAB: the table has no entry {1}",
        "VERTYTAB : la table n'a pas d'entrée {1}",
    ),
    "vertytab-entry-type-not": Message(
        "VERTYTAB: the entry {1} is of type {2}, not {3}",
        "VERTYTAB : l'entrée {1} est de type {2}, pas {3}",
    ),
    "zigzag-least-element-needed-not": Message(
        "ZIGZAG: at least one element is needed, not {1}",
        "ZIGZAG : il faut au moins un élément, pas {1}",
    ),
    "zigzag-round-piece-needs-positive": Message(
        "ZIGZAG: a round piece needs R and a positive radius behind {1}",
        "ZIGZAG : un morceau rond demande R et un rayon positif derrière {1}",
    ),
    "zigzag-pieces-not": Message(
        "ZIGZAG: pieces are D, S R or A R, not {1}",
        "ZIGZAG : les morceaux sont D, S R ou A R, pas {1}",
    ),
    "zigzag-piece-no-length": Message(
        "ZIGZAG: piece {1} has no length",
        "ZIGZAG : le morceau {1} est de longueur nulle",
    ),
    "zigzag-no-piece-length-length": Message(
        "ZIGZAG: no piece is given: D length, S length R radius, A angle R radius",
        "ZIGZAG : aucun morceau n'est donné : D longueur, S longueur R rayon, A angle R rayon",
    ),
    "zigzag-number-elements-sizes-dini": Message(
        "ZIGZAG: give a number of elements or the sizes DINI and DFIN",
        "ZIGZAG : donnez un nombre d'éléments ou les tailles DINI et DFIN",
    ),
    "zigzag-two-vectors-line-make": Message(
        "ZIGZAG: the two vectors are in line and make no plane",
        "ZIGZAG : les deux vecteurs sont alignés et ne font pas de plan",
    ),
    "spplanc-no-mode": Message(
        "SPPLANC: FREQU, AMORT or COEFFPL have no item {1}",
        "SPPLANC : FREQU, AMORT ou COEFFPL n'ont pas d'élément {1}",
    ),
    # ---- what is printed
    "verifie-head": Message(
        "check                                                 obtained      expected    "
        "  distance     tolerance",
        "contrôle                                                obtenu       attendu    "
        "     écart     tolérance",
    ),
    "verifie-relative": Message(
        "{1} (relative)",
        "{1} (relatif)",
    ),
    "verifie-outside": Message(
        "   OUT OF TOLERANCE",
        "   HORS TOLÉRANCE",
    ),
    "bilan-all": Message(
        "all {1} checks within tolerance",
        "{1} contrôles, tous dans la tolérance",
    ),
    "visor-no-orientation": Message(
        "@VISOR: elements {1} have no orientation to show",
        "@VISOR : les éléments {1} n'ont pas d'orientation à montrer",
    ),
    "balourd-speed": Message(
        "BALOURD: speed {1}",
        "BALOURD : vitesse {1}",
    ),
    "campbell-speed": Message(
        "CAMPBELL: speed {1}",
        "CAMPBELL : vitesse {1}",
    ),
    "explorer-no-component": Message(
        "EXPLORER: no field of the loading has the component {1}",
        "EXPLORER : aucun champ du chargement n'a la composante {1}",
    ),
    "explorer-one-field": Message(
        "EXPLORER: one field of iso-values for each call, {1} is not drawn",
        "EXPLORER : un champ d'isovaleurs par appel, {1} n'est pas tracé",
    ),
    "issleq-step": Message(
        "ISSLEQ: step {1}, largest change of modulus or damping {2}",
        "ISSLEQ : itération {1}, plus grande variation de module ou d'amortissement {2}",
    ),
    "postvibr-no-mode": Message(
        "POSTVIBR: no mode",
        "POSTVIBR : aucun mode",
    ),
    "postvibr-head-shapes": Message(
        "  shape   unknown    node",
        "  forme  inconnue   noeud",
    ),
    "postvibr-head-modes": Message(
        "   mode   frequency (Hz)   generalised mass",
        "   mode   fréquence (Hz)  masse généralisée",
    ),
    "postvibr-shape": Message(
        "{1} shape {2}",
        "{1} forme {2}",
    ),
    "respowns-turn": Message(
        "RESPOWNS: turn {1}, deviation of the spectra {2}",
        "RESPOWNS : itération {1}, écart des spectres {2}",
    ),
    "respowns-after": Message(
        "RESPOWNS: after {1} turns the spectra deviate by {2}",
        "RESPOWNS : après {1} itérations les spectres s'écartent de {2}",
    ),
    "respowsp-turn": Message(
        "RESPOWSP: turn {1}, deviation of the spectra {2}",
        "RESPOWSP : itération {1}, écart des spectres {2}",
    ),
    "respowsp-after": Message(
        "RESPOWSP: after {1} turns the spectra deviate by {2}",
        "RESPOWSP : après {1} itérations les spectres s'écartent de {2}",
    ),
    "signsynt-turn": Message(
        "signal {1} turn {2} distance of the spectra {3}",
        "signal {1}, itération {2}, distance des spectres {3}",
    ),
    "sissib-all": Message(
        "SISSIB: {1}, all directions",
        "SISSIB : {1}, toutes les directions",
    ),
}

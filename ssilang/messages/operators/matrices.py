"""What ssilang/operators/matrices refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "extr-rigi-wants-word": Message(
        "EXTR RIG1 'RIGI' wants 'NOMU', 'MULT' or 'UNIL'",
        "EXTR RIG1 'RIGI' demande 'NOMU', 'MULT' ou 'UNIL'",
    ),
    "extr-wants-word-or-names": Message(
        "EXTR of a RIGIDITE wants a keyword or two names",
        "EXTR d'une RIGIDITE demande un mot-clé ou deux noms",
        "one of {words:words}",
        "l'un des mots {words:words}",
    ),
    "inco-wants-four-lists": Message(
        "CHAN 'INCO' of a matrix wants four lists, of equal lengths by pairs",
        "CHAN 'INCO' d'une matrice demande quatre listes, de longueurs égales deux à deux",
    ),
    "multiplier-keeps-its-name": Message(
        "the multiplier of a condition is always called LX here",
        "le multiplicateur d'une condition s'appelle toujours LX ici",
    ),
    "negative-terms-have-no-power": Message(
        "the matrix has negative terms ({smallest:g}): they have no power {power:g}",
        "la rigidité a des termes négatifs ({smallest:g}) : ils n'ont pas de puissance {power:g}",
    ),
    "conditions-not-imaginary": Message(
        "conditions are not made imaginary by CHAN",
        "CHAN ne rend pas imaginaires des conditions",
        "change the matrix before ET joins it to its conditions",
        "changez la matrice avant que ET la réunisse à ses conditions",
    ),
    "which-values": Message(
        "which values?",
        "quelles valeurs ?",
        "'ALEATOIRE', or 'UNIFORME' and a number",
        "'ALEATOIRE', ou 'UNIFORME' et un nombre",
    ),
    "force-without-lengthening": Message(
        "a force at no lengthening gives no stiffness",
        "une force sans allongement ne donne pas de raideur",
    ),
    "filter-radius-negative": Message(
        "the radius of a filter is not negative, this one is {radius:g}",
        "le rayon d'un filtre n'est pas négatif, celui-ci vaut {radius:g}",
    ),
    "products-do-not-match": Message(
        "{n_shapes} {n_shapes:field|fields}, {n_norms} {n_norms:product|products} and {n_forces} "
        "{n_forces:force|forces} do not match",
        "{n_shapes} {n_shapes:champ|champs}, {n_norms} {n_norms:produit|produits} et {n_forces} "
        "{n_forces:force|forces} ne vont "
        "pas ensemble",
    ),
    "product-is-zero": Message(
        "a field whose product U K U is zero cannot be orthogonalised to",
        "on ne peut orthogonaliser à un champ dont le produit U K U est nul",
    ),
    "sides-swapped": Message(
        "the joint around ({place}) opens where its bodies come together: its sides are swapped",
        "le joint autour de ({place}) s'ouvre quand ses corps se rapprochent : ses "
        "côtés sont inversés",
        "{overlap:?its sides lie {overlap:.4g} inside each other: move the bodies apart|{points:?"
        "turn its DIRECTION round (MATE), or the order of its two points|the way in which the "
        "first mesh of RACC or LIAI is walked decides: RACC (INVE GEO1) GEO2 turns it round}}",
        "{overlap:?ses côtés sont l'un dans l'autre de {overlap:.4g} : écartez les corps|{points:?"
        "inversez sa DIRECTION (MATE), ou l'ordre de ses deux points|le sens de parcours du "
        "premier maillage de RACC ou LIAI décide : RACC (INVE GEO1) GEO2 le retourne}}",
        severity="warning",
    ),
    "foreign-unknown": Message(
        "bodies have no {names:or} under OPTI MODE {mode}: such a condition holds nothing of them",
        "les corps n'ont pas {names:or} parmi leurs inconnues sous OPTI MODE {mode} : une telle "
        "condition n'en tient rien",
        "their unknowns are {own:words}",
        "leurs inconnues sont {own:words}",
        severity="warning",
    ),
    "beam-ends-on-solid": Message(
        "the {rotations:rotation|rotations} {rotations:and} at {nodes:node|nodes} {nodes:and}"
        "{more:? (and {more} more)} {rotations:is|are} held by nothing but the "
        "{shell:?shell|beam} that ends there on a solid: this is a hinge",
        "{rotations:la rotation|les rotations} {rotations:and} {nodes:au noeud|aux noeuds} "
        "{nodes:and}{more:? (et {more} {more:autre|autres})} "
        "{rotations:n'est tenue|ne sont tenues} par rien d'autre que la {shell:?coque|poutre} qui "
        "s'y termine sur un massif : c'est une articulation",
        "hold it by RELA, or let the {shell:?shell|beam} go on over a second node of the solid; a "
        "hinge that is meant has a node of its own, tied to the solid's by RELA",
        "tenez-la par RELA, ou prolongez la {shell:?coque|poutre} sur un second noeud du massif ; "
        "une articulation voulue a son propre noeud, lié par RELA à celui du massif",
        severity="warning",
    ),
    "held-nodes-without-stiffness": Message(
        "{n_held} {n_held:node|nodes} that conditions hold have no stiffness, but lie on nodes "
        "that have "
        "(one at {x:.4g} {y:.4g} {z:.4g}): they hold nothing",
        "{n_held} {n_held:noeud|noeuds} que des conditions tiennent n'ont pas de raideur, mais "
        "sont à la "
        "même place que des noeuds qui en ont (l'un en {x:.4g} {y:.4g} {z:.4g}) : ils ne "
        "tiennent rien",
        "a line or face made twice has new nodes: name it once and use the name (BAS = P1 D "
        "P2 ;), take a part of the mesh (POIN, COTE), or join both with ELIM",
        "une ligne ou une face faite deux fois a de nouveaux noeuds : nommez-la une fois "
        "(BAS = P1 D P2 ;), prenez une partie du maillage (POIN, COTE), ou réunissez par ELIM",
        severity="warning",
    ),
    "negative-stiffness": Message(
        "the stiffness of {count} {count:unknown is|unknowns are} negative ({name} at node {node}: "
        "{value:.4g}): it pushes away what moves",
        "la raideur de {count} {count:inconnue est négative|inconnues sont négatives} ({name} au "
        "noeud {node} : {value:.4g}) : elle repousse ce qui bouge",
        "give springs without a sign; one below zero (a weight that leans) needs a stiffer one "
        "beside it",
        "donnez les ressorts sans signe ; un ressort négatif (un poids qui penche) en veut un plus "
        "raide à côté",
        severity="warning",
    ),
    "negative-at-nodes": Message(
        "{kind}: the value at the nodes is negative ({amount:g}): it feeds motions instead of "
        "holding "
        "or braking them",
        "{kind} : la valeur aux noeuds est négative ({amount:g}) : elle nourrit les mouvements au "
        "lieu de les retenir ou de les freiner",
        "give its size, without a sign: dashpots act against motions both ways",
        "donnez sa valeur sans signe : les amortisseurs s'opposent aux mouvements dans les deux "
        "sens",
        severity="warning",
    ),
    "cells-twice": Message(
        "{kind}: {count} {count:cell stands|cells stand} there twice, with the same values (one at "
        "node {node}): {count:it counts|they count} double",
        "{kind} : {count} {count:élément y est|éléments y sont} deux fois, avec les mêmes valeurs "
        "(l'un au noeud {node}) : {count:il compte|ils comptent} double",
        "leave one of the two out: UNIQ GEO1 takes each cell of a mesh once, ET joins what has no "
        "cell in common; 2. * MAT1 doubles a matrix on purpose",
        "ôtez l'un des deux : UNIQ GEO1 prend chaque élément d'un maillage une fois, ET réunit ce "
        "qui n'a pas d'élément commun ; 2. * MAT1 double exprès une matrice",
        severity="warning",
    ),
    "no-mechanical-zone": Message(
        "the model has no mechanical zone",
        "le modèle n'a pas de zone mécanique",
        "CHARGEMENT zones only carry loads",
        "les zones CHARGEMENT ne portent que des charges",
    ),
    "friction-is-no-matrix": Message(
        "contact with friction is no matrix: its forces depend on the way there",
        "le contact frottant n'est pas une matrice : ses forces dépendent du chemin",
        "PASAPAS takes the model; RIGI takes CONTACT UNILATERAL",
        "PASAPAS prend le modèle ; RIGI prend CONTACT UNILATERAL",
    ),
    "point-twice-in-cell": Message(
        "a point stands twice in the cell",
        "un point est deux fois dans l'élément",
    ),
    "matrix-mesh-empty": Message(
        "the mesh of the matrix is empty",
        "le maillage de la matrice est vide",
        "give cells or points",
        "donnez des éléments ou des points",
    ),
    "terms-do-not-add": Message(
        "terms on all displacements do not add to terms on a single one",
        "des termes sur tous les déplacements ne s'ajoutent pas à des termes sur un seul",
    ),
    "term-without-mesh": Message(
        "a term of the relation has no mesh",
        "un terme de la relation n'a pas de maillage",
        "(number) 'UX' mesh + ...",
        "(nombre) 'UX' maillage + ...",
    ),
    "direction-without-length": Message(
        "the direction of a relation has no length",
        "la direction d'une relation est de longueur nulle",
    ),
    "line-slides-not-point": Message(
        "a line slides in a mesh, not a single point",
        "c'est une ligne qui coulisse dans un maillage, pas un point seul",
    ),
    "which-stiffness": Message(
        "which stiffness?",
        "quelle raideur ?",
        "'CENTRIFUGE' or 'EULER'",
        "'CENTRIFUGE' ou 'EULER'",
    ),
    "rotation-vector-in-space": Message(
        "a rotation vector has three components",
        "un vecteur rotation a trois composantes",
        "OPTI DIME 3 ;",
        "OPTI DIME 3 ;",
    ),
    "harm-not-available": Message(
        "'HARM' is not available",
        "'HARM' n'est pas disponible",
        "the impedance of a Fourier harmonic",
        "l'impédance d'une harmonique de Fourier",
    ),
    "extr-of-superele-wants-word": Message(
        "EXTR of a SUPERELE wants a keyword",
        "EXTR d'un SUPERELE demande un mot-clé",
        "one of {words:words}",
        "l'un des mots {words:words}",
    ),
    "nothing-to-hold": Message(
        "the mesh is empty: there is nothing to hold",
        "le maillage est vide : il n'y a rien à bloquer",
    ),
    "table-without-entries": Message(
        "the table has no entry numbered 1, 2 ...",
        "la table n'a pas d'entrée numérotée 1, 2 ...",
    ),
    "matrix-without-condition": Message(
        "this matrix holds no condition",
        "cette matrice ne contient pas de condition",
        "give what BLOQ or RELA made",
        "donnez ce que BLOQ ou RELA a fait",
    ),
    "say-depl-or-rota": Message(
        "say 'DEPL', 'ROTA' or both",
        "donnez 'DEPL', 'ROTA' ou les deux",
    ),
    "symmetry-wants-dimensions": Message(
        "a plane of symmetry wants 2 or 3 dimensions",
        "un plan de symétrie demande 2 ou 3 dimensions",
        "use BLOQ",
        "utilisez BLOQ",
    ),
    "symmetry-distance-missing": Message(
        "no distance says which nodes are on the symmetry",
        "aucune distance ne dit quels noeuds sont sur le plan de symétrie",
        "give it as the last argument, or set OPTI DENS: a tenth of it is used",
        "donnez-la en dernier argument, ou réglez OPTI DENS : son dixième est pris",
    ),
    "spring-works-both-ways": Message(
        "a spring works both ways",
        "un ressort agit dans les deux sens",
        "BLOQ has 'MINI' and 'MAXI'",
        "BLOQ a 'MINI' et 'MAXI'",
    ),
    "no-unknown": Message(
        "no unknown is named",
        "aucune inconnue n'est nommée",
        "say 'UX' 'UY' ..., 'DEPL', 'ROTA', 'DIRE' or 'RADI'",
        "donnez 'UX' 'UY' ..., 'DEPL', 'ROTA', 'DIRE' ou 'RADI'",
    ),
    "link-wants-point-and-unknown": Message(
        "each entry wants POINT_LIAISON (POINT) and DDL_LIAISON (MOT)",
        "chaque entrée demande POINT_LIAISON (POINT) et DDL_LIAISON (MOT)",
    ),
    "link-without-blocage": Message(
        "an entry has no BLOCAGE",
        "une entrée n'a pas de BLOCAGE",
        "call BLOQ on this table first",
        "appelez d'abord BLOQ sur cette table",
    ),
    # ---- what is printed
    "super-element": Message(
        "Super-element: {masters} master {masters:unknown|unknowns}, {inner} inside",
        "Super-élément : {masters} {masters:inconnue maître|inconnues maîtres}, {inner} à "
        "l'intérieur",
    ),
    "product-of-other-names": Message(
        "the product is zero: the field has {names:words}, and the unknowns of the matrix are "
        "{known:words}",
        "le produit est nul : le champ a {names:words}, et les inconnues de la matrice sont "
        "{known:words}",
        "a field is multiplied by the names of displacements (UX ...), and forces (FX ...) result",
        "un champ se multiplie sous les noms des déplacements (UX ...), et donne des forces "
        "(FX ...)",
        severity="warning",
    ),
}

"""What ssilang/kernel/matrices refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "field-no-value-something": Message(
        "the field gives no value where something is held ({held})",
        "le champ ne donne aucune valeur là où quelque chose est bloqué ({held})",
        "it has the components {components:?{components}|none}",
        "il a les composantes {components:?{components}|aucune}",
    ),
    "diagonal-field-no-value": Message(
        "the diagonal field has no value for {label}",
        "le champ diagonal n'a pas de valeur pour {label}",
        "it is the inverse of a diagonal mass, with components UX UY ...",
        "c'est l'inverse d'une masse diagonale, de composantes UX UY ...",
    ),
    "some-relations-cannot-eliminated": Message(
        "some of the relations cannot be eliminated: they are too full",
        "certaines relations ne peuvent être éliminées : elles sont trop pleines",
    ),
    "component-weights-needed": Message(
        "one component of weights is needed, here are {names:?{names:words}|none}",
        "il faut une composante de poids, il y a ici {names:?{names:words}|aucune}",
    ),
    "weights-around-node-zero": Message(
        "the weights around a node are all zero",
        "les poids autour d'un noeud sont tous nuls",
    ),
    "cable-made-segments-two": Message(
        "a cable is made of segments of two nodes (SEG2)",
        "un câble est fait de segments à deux noeuds (SEG2)",
    ),
    "segment-cable-no-length": Message(
        "a segment of the cable has no length",
        "un segment du câble est de longueur nulle",
    ),
    "conditions-only-doubled-raideur": Message(
        "conditions can only be doubled with 'RAIDEUR'",
        "des blocages ne se dédoublent qu'avec 'RAIDEUR'",
    ),
    "common-motion-needs-least": Message(
        "a common motion needs at least two nodes",
        "un mouvement commun demande au moins deux noeuds",
    ),
    "rigid-body-needs-least": Message(
        "a rigid body needs at least two nodes",
        "un corps rigide demande au moins deux noeuds",
    ),
    "no-middle-node-mesh": Message(
        "there is no middle node: the mesh has no quadratic cell",
        "il n'y a pas de noeud milieu : le maillage n'a pas d'élément quadratique",
    ),
    "no-node-first-mesh": Message(
        "no node of the first mesh lies in the second one",
        "aucun noeud du premier maillage n'est dans le second",
    ),
    "no-node-line-lies": Message(
        "no node of the line lies in the second mesh",
        "aucun noeud de la ligne n'est dans le second maillage",
    ),
    "sliding-relation-wants-line": Message(
        "a sliding relation wants a line, the mesh holds {cell_type}",
        "une relation glissante veut une ligne, le maillage contient {cell_type}",
    ),
    "none-master-unknowns-unknown": Message(
        "none of the master unknowns is an unknown of the stiffness",
        "aucune des inconnues maîtresses n'est une inconnue de la rigidité",
        "give nodes of the body, or fields of its unknowns (UX, UY ...)",
        "donnez des noeuds du corps, ou des champs de ses inconnues (UX, UY ...)",
    ),
    "master-unknowns-make-too": Message(
        "{n_masters} master unknowns make too large a full matrix (at most {largest})",
        "{n_masters} inconnues maîtresses font une matrice pleine trop grande (au plus {largest})",
    ),
    "super-element-no-unknown": Message(
        "the super-element has no unknown for the force {lost}",
        "le super-élément n'a pas d'inconnue pour la force {lost}",
    ),
    "full-matrix-rows-too": Message(
        "a full matrix of {n_places} rows is too large",
        "une matrice pleine de {n_places} lignes est trop grande",
        "damping proportional to mass and stiffness is sparse",
        "un amortissement proportionnel à la masse et à la raideur est creux",
    ),
    "numbering-needs-least-matrix": Message(
        "a numbering needs at least one matrix",
        "une numérotation demande au moins une matrice",
    ),
    "matrix-unknowns-numbering-lacks": Message(
        "the matrix has unknowns that the numbering lacks",
        "la matrice a des inconnues que la numérotation n'a pas",
    ),
    "relation-unknowns-numbering-lacks": Message(
        "a relation has unknowns that the numbering lacks",
        "une relation a des inconnues que la numérotation n'a pas",
    ),
    "meshes-relation-nodes": Message(
        "the meshes of a relation have {sizes:and} nodes",
        "les maillages d'une relation ont {sizes:and} noeuds",
        "give meshes of the same number of nodes, or of a single node",
        "donnez des maillages du même nombre de noeuds, ou d'un seul noeud",
    ),
    "factor-not-finite": Message(
        "the factor of {unknown} at node {node} is not a finite number",
        "le coefficient de {unknown} au noeud {node} n'est pas un nombre fini",
        "look for what was divided by zero, or grew without bound",
        "cherchez ce qui a été divisé par zéro, ou a grandi sans borne",
    ),
    "relation-node-no-coefficient": Message(
        "a relation at node {node} has no coefficient other than zero",
        "une relation au noeud {node} n'a que des coefficients nuls",
    ),
    "direction-node-no-length": Message(
        "the direction at node {node} has no length",
        "la direction au noeud {node} est de longueur nulle",
    ),
    "node-lies-axis-no": Message(
        "node {node} lies on the axis: it has no radial direction",
        "le noeud {node} est sur l'axe : il n'a pas de direction radiale",
    ),
    "field-relation-no-coefficient": Message(
        "the field of a relation has no coefficient other than zero",
        "le champ d'une relation n'a que des coefficients nuls",
    ),
    "points-define-symmetry-line": Message(
        "the points that define the symmetry are on one line or coincide",
        "les points qui définissent la symétrie sont alignés ou confondus",
    ),
    "antisymmetry-leaves-rotations-plane": Message(
        "antisymmetry leaves the rotations of a plane model free",
        "l'antisymétrie laisse libres les rotations d'un modèle plan",
    ),
    "unknown-at-node": Message(
        "{name} at node {node}",
        "{name} au noeud {node}",
    ),
    "no-node-within-symmetry": Message(
        "no node within {tolerance:g} of the symmetry; the nearest is at {nearest:g}",
        "aucun noeud à moins de {tolerance:g} de la symétrie ; le plus proche est à {nearest:g}",
        "raise the tolerance, or check the points",
        "augmentez la tolérance, ou vérifiez les points",
    ),
    "no-node-to-mirror": Message(
        "the mesh to be held by symmetry is empty",
        "le maillage à tenir par symétrie est vide",
    ),
    "columns-points": Message(
        "{n_columns} columns are given for {n_nodes} {n_nodes:point|points}",
        "{n_columns} colonnes sont données pour {n_nodes} {n_nodes:point|points}",
    ),
    "lists-names-cells-nodes": Message(
        "{n_at_nodes} {n_at_nodes:list|lists} of names for cells of {k} {k:node|nodes}",
        "{n_at_nodes} {n_at_nodes:liste|listes} de noms pour des éléments de {k} {k:noeud|noeuds}",
    ),
    "cell-names-rows-matrix": Message(
        "a cell {cell_type} with these names has {m} {m:row|rows}, the matrix is {n_matrix} "
        "x {n_matrix_2}, {n_forces} dual names",
        "un élément {cell_type} avec ces noms a {m} {m:ligne|lignes}, la matrice est "
        "{n_matrix} x {n_matrix_2}, avec {n_forces} noms duaux",
    ),
    "vectors-factors": Message(
        "{n_fields} {n_fields:vector|vectors} with {n_factors} {n_factors:factor|factors}",
        "{n_fields} {n_fields:vecteur|vecteurs} avec {n_factors} {n_factors:facteur|facteurs}",
    ),
    "matrix-rows-wants-terms": Message(
        "a matrix of {size} {size:row|rows} wants {wanted:or} terms, {n_terms} "
        "{n_terms:is|are} given",
        "une matrice de {size} {size:ligne|lignes} veut {wanted:or} termes, {n_terms} "
        "{n_terms:est donné|sont donnés}",
    ),
    "field-values-fits-conditions": Message(
        "a field of values fits conditions on a single unknown only",
        "un champ de valeurs ne va qu'avec des blocages d'une seule inconnue",
    ),
    "condensed-without-relations": Message(
        "the second matrix has no relations to condense by{swapped:?; the first one has: the "
        "matrix stands first, its relations second}",
        "la deuxième matrice n'a pas de relations pour condenser{swapped:? ; la première en a : "
        "la matrice vient d'abord, ses relations ensuite}",
    ),
    "matrix-no-relation": Message(
        "the matrix has no relation",
        "la rigidité n'a pas de relation",
    ),
    "rela-wants-field-component": Message(
        "values of relations are a field of one component, SCAL",
        "les valeurs de relations sont un champ d'une seule composante, SCAL",
    ),
    "rela-fits-relations-between": Message(
        "a field of values fits relations between unknowns of one node only",
        "un champ de valeurs ne va qu'avec des relations entre inconnues d'un même noeud",
    ),
    "conditions-matrix-hold-master": Message(
        "the conditions of the matrix hold the master unknown {label}",
        "les conditions de la matrice bloquent l'inconnue maîtresse {label}",
    ),
    "masters-leave-conditions-free": Message(
        "the unknowns of the kept conditions can move freely with the masters held",
        "les inconnues des conditions gardées sont libres quand les maîtres sont tenus",
    ),
    "unilateral-non-associated-conditions": Message(
        "unilateral and non-associated conditions cannot be condensed",
        "des conditions unilatérales ou non associées ne se condensent pas",
    ),
    "rigid-body-distances-needs": Message(
        "a rigid body by distances needs {plane:?three nodes not on a line|four nodes not in "
        "a plane}",
        "un corps rigide par les distances demande {plane:?trois noeuds non alignés|quatre "
        "noeuds hors d'un même plan}",
    ),
    "mass-negative": Message(
        "the mass of {unknown} is negative: {mass:g}",
        "la masse de {unknown} est négative : {mass:g}",
    ),
    # ---- what is printed
    "listed": Message(
        "RIGIDITE, {kind}: {count} {count:block|blocks} of element matrices",
        "RIGIDITE, {kind} : {count} {count:bloc|blocs} de matrices élémentaires",
    ),
    "listed-block": Message(
        "  {count} {count:matrix|matrices} of {size} {size:unknown|unknowns} ({names:words}), "
        "{symmetric:?symmetric|unsymmetric}",
        "  {count} {count:matrice|matrices} de {size} {size:inconnue|inconnues} ({names:words}), "
        "{symmetric:?symétrique|non symétrique}",
    ),
    "listed-conditions": Message(
        "  {count} {count:condition|conditions}", "  {count} {count:condition|conditions}"
    ),
    "listed-multiplier": Message("multiplier {node}", "multiplicateur {node}"),
    "listed-nodes": Message("    nodes {nodes:words}", "    noeuds {nodes:words}"),
}

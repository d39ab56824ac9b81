"""What ssilang/operators/modal refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-mode-no-shape": Message(
        "the table holds no mode and no static shape",
        "la table ne contient ni mode ni déformée statique",
    ),
    "no-frequency-between": Message(
        "no natural frequency lies between {low:g} and {high:g}: the table has no mode",
        "aucune fréquence propre n'est entre {low:g} et {high:g} : la table n'a pas de mode",
        "VIBR 'PROCHE' (PROG F1) finds the nearest one to a frequency",
        "VIBR 'PROCHE' (PROG F1) trouve la plus proche d'une fréquence",
    ),
    "model-no-zone-modal": Message(
        "the model has no zone MODAL or STATIQUE",
        "le modèle n'a pas de zone MODAL ou STATIQUE",
    ),
    "only-nodal-forces-times": Message(
        "only nodal forces times a curve can be projected",
        "on ne projette que des forces nodales multipliées par une évolution",
    ),
    "shock-wants-point-and-normal": Message(
        "entry {i} wants a POINT and a NORMALE, both points",
        "l'indice {i} demande un POINT et une NORMALE, deux points",
    ),
    "shock-normal-is-zero": Message(
        "the NORMALE of entry {i} is zero",
        "la NORMALE de l'indice {i} est nulle",
    ),
    "psmo-wants-stiffness-mass": Message(
        "PSMO wants one stiffness, and a mass for 'SEISME' and free bodies",
        "PSMO demande une rigidité, et une masse pour 'SEISME' et les corps libres",
    ),
    "nothing-drives-structure-chpoint": Message(
        "nothing drives the structure: give a CHPOINT, or 'SEISME' 'UX' ...",
        "rien n'excite la structure : donnez un CHPOINT, ou 'SEISME' 'UX' ...",
    ),
    "tables-cannot-joined": Message(
        "tables '{subtype}' and '{subtype_2}' cannot be joined",
        "les tables '{subtype}' et '{subtype_2}' ne se réunissent pas",
        "ET joins two tables LIAISONS_STATIQUES or two tables BASE_MODALE",
        "ET réunit deux tables LIAISONS_STATIQUES ou deux tables BASE_MODALE",
    ),
    "list-holds-something-else": Message(
        "the list holds something else than nodal fields",
        "la liste contient autre chose que des champs par points",
    ),
    "structure-free-motions-wants": Message(
        "a structure with free motions wants its mass matrix",
        "une structure qui a des mouvements libres demande sa matrice de masse",
    ),
    "seisme-wants-mass-matrix": Message(
        "'SEISME' wants the mass matrix",
        "'SEISME' demande la matrice de masse",
    ),
    "steps-of-continuation": Message(
        "'MAXI_DEPLACEMENT' > 0 and 0 < 'DSMIN' <= 'DS' <= 'DSMAX' are wanted",
        "il faut 'MAXI_DEPLACEMENT' > 0 et 0 < 'DSMIN' <= 'DS' <= 'DSMAX'",
    ),
    "entry-not-positive": Message(
        "'{index}' is {value:g}",
        "'{index}' vaut {value:g}",
        "a number above zero",
        "un nombre positif",
    ),
    "branch-lost": Message(
        "the branch is lost at {t:g}",
        "la branche est perdue en {t:g}",
        "a smaller 'DSMIN'",
        "un 'DSMIN' plus petit",
        severity="warning",
    ),
    "imposed-displacements-not-go": Message(
        "imposed displacements do not go with harmonic balance",
        "les déplacements imposés ne vont pas avec l'équilibrage harmonique",
        "load by forces",
        "charger par des forces",
    ),
    "instants-of-a-period": Message(
        "'N_PT_TFR' is {order}",
        "'N_PT_TFR' vaut {order}",
        "2**N_PT_TFR instants, {most_order} at most",
        "2**N_PT_TFR instants, {most_order} au plus",
    ),
    "too-few-instants": Message(
        "'N_PT_TFR' = {order}: {count} {count:instant|instants} for {harmonics} "
        "{harmonics:harmonic|harmonics}",
        "'N_PT_TFR' = {order} : {count} {count:instant|instants} pour {harmonics} "
        "{harmonics:harmonique|harmoniques}",
    ),
    "no-such-unknown": Message(
        "'COMP_FNL' is {wrong}, which no matrix has",
        "'COMP_FNL' est {wrong}, qu'aucune matrice n'a",
        "unknowns: {unknowns:words}",
        "inconnues : {unknowns:words}",
    ),
    "matrices-no-unknowns-point": Message(
        "the matrices have no unknowns at 'POINT_FNL'",
        "les matrices n'ont pas d'inconnues en 'POINT_FNL'",
    ),
    "stability-not-known": Message(
        "'STABILITE': '{wrong}' is not known",
        "'STABILITE' : '{wrong}' n'est pas connu",
        "{stability:words}",
        "{stability:words}",
    ),
    "stability-wants-rigidite-constante": Message(
        "stability wants 'RIGIDITE_CONSTANTE' and 'MASSE_CONSTANTE'",
        "la stabilité demande 'RIGIDITE_CONSTANTE' et 'MASSE_CONSTANTE'",
    ),
    "masse-constante-not-regular": Message(
        "'MASSE_CONSTANTE' is not regular: Floquet exponents want a mass for each unknown",
        "'MASSE_CONSTANTE' n'est pas régulière : les exposants de Floquet demandent une "
        "masse pour chaque inconnue",
    ),
    "no-such-time": Message(
        "the results go from {times:.6g} to {times_2:.6g} s",
        "les résultats vont de {times:.6g} à {times_2:.6g} s",
    ),
    "which-contributions": Message(
        "which contributions?",
        "quelles contributions ?",
        "{words:words}",
        "{words:words}",
    ),
    "no-such-step": Message(
        "there are {count} {count:step|steps}",
        "il y a {count} pas",
    ),
    "pseudo-modes-want-basis": Message(
        "pseudo-modes want a table of the basis",
        "les pseudo-modes demandent une table de la base",
    ),
    "no-such-shape": Message(
        "the basis has {n_shapes} {n_shapes:shape|shapes}",
        "la base a {n_shapes} {n_shapes:déformée|déformées}",
    ),
    "instants-for-harmonics": Message(
        "{harmonics} {harmonics:harmonic|harmonics} want {least} instants of a period or more, "
        "{samples} "
        "are given",
        "{harmonics} {harmonics:harmonique|harmoniques} demandent {least} instants par période "
        "ou plus, "
        "{samples} sont donnés",
    ),
    "start-wanted": Message(
        "DYNC wants a table 'INITIAL'",
        "DYNC veut une table 'INITIAL'",
        "with 'FREQUENCE', or 'ENERGIE'",
        "avec 'FREQUENCE', ou 'ENERGIE'",
    ),
    "steps-of-dync": Message(
        "0 < 'DSMIN' <= 'DS0' <= 'DSMAX' is wanted",
        "il faut 0 < 'DSMIN' <= 'DS0' <= 'DSMAX'",
    ),
    "no-such-mode": Message(
        "'MODE' is between 1 and {n_M}",
        "'MODE' est entre 1 et {n_M}",
    ),
    "number-wanted": Message(
        "the table {subtype} has no number '{name}'",
        "la table {subtype} n'a pas de nombre '{name}'",
    ),
    "number-not-positive": Message(
        "'{name}' is {value:g}, not above zero",
        "'{name}' vaut {value:g}, qui n'est pas positif",
    ),
    "table-wanted": Message(
        "DYNC wants a table '{name}'",
        "DYNC veut une table '{name}'",
    ),
    "no-such-harmonic": Message(
        "index {index} is beyond the {harmonics} {harmonics:harmonic|harmonics}",
        "l'indice {index} dépasse les {harmonics} harmoniques",
    ),
    "index-holds-a-field": Message(
        "index {index} of the table {subtype} is a CHPOINT",
        "l'indice {index} de la table {subtype} est un CHPOINT",
    ),
    "dyne-wants-table-base": Message(
        "DYNE wants a table BASE_MODALE or RAIDEUR_ET_MASSE",
        "DYNE veut une table BASE_MODALE ou RAIDEUR_ET_MASSE",
    ),
    "basis-without-modes": Message(
        "the table holds no mode",
        "la table ne contient aucun mode",
        "MODES . 1 ... each with 'DEFORMEE_MODALE' (CHPOINT), 'POINT_REPERE' (POINT), "
        "'FREQUENCE' and 'MASSE_GENERALISEE'",
        "MODES . 1 ... chacun avec 'DEFORMEE_MODALE' (CHPOINT), 'POINT_REPERE' (POINT), "
        "'FREQUENCE' et 'MASSE_GENERALISEE'",
    ),
    "mass-not-positive": Message(
        "'MASSE_GENERALISEE' of a mode is {masses_min:g}, not above zero",
        "'MASSE_GENERALISEE' d'un mode vaut {masses_min:g}, qui n'est pas positif",
    ),
    "mode-number-wanted": Message(
        "'{name}' of a mode must be a number",
        "'{name}' d'un mode est un nombre",
    ),
    "matrices-dyne-alfa-beta": Message(
        "the matrices of DYNE are on ALFA and BETA: project them with PJBA",
        "les matrices de DYNE portent sur ALFA et BETA : les projeter par PJBA",
    ),
    "matrix-wanted": Message(
        "the table {subtype} has no matrix '{name}'",
        "la table {subtype} n'a pas de matrice '{name}'",
    ),
    "table-chargement-no-load": Message(
        "the table CHARGEMENT has no load 'BASE_A' (PJBA makes it)",
        "la table CHARGEMENT n'a pas de chargement 'BASE_A' (PJBA le fait)",
    ),
    "table-reprise-not-hold": Message(
        "the table REPRISE does not hold the state of {links} {links:link|links}",
        "la table REPRISE ne contient pas l'état de {links} {links:liaison|liaisons}",
    ),
    "entry-is-a-field": Message(
        "'{name}' of the table {subtype} is a CHPOINT",
        "'{name}' de la table {subtype} est un CHPOINT",
    ),
    "two-tables-of-kind": Message(
        "two tables '{subtype}'",
        "deux tables '{subtype}'",
    ),
    "matrices-modes-base-modale": Message(
        "the matrices have modes that 'BASE_MODALE' lacks",
        "les matrices ont des modes que 'BASE_MODALE' n'a pas",
    ),
    "oden-friction-wants-positive": Message(
        "Oden's friction wants a positive velocity of regularisation",
        "le frottement d'Oden demande une vitesse de régularisation positive",
    ),
    "rayon-support-link-must": Message(
        "'RAYON_SUPPORT' of a link must be > 0",
        "'RAYON_SUPPORT' d'une liaison doit être > 0",
    ),
    "links-base-need-shapes": Message(
        "links of base B need the shapes: give the table 'BASE_MODALE'",
        "les liaisons en base B veulent les déformées : donner la table 'BASE_MODALE'",
        "in the table RAIDEUR_ET_MASSE, at the index 'BASE_MODALE'",
        "dans la table RAIDEUR_ET_MASSE, à l'indice 'BASE_MODALE'",
    ),
    "link-without-mode": Message(
        "'{name}' of a link marks no mode of the basis",
        "'{name}' d'une liaison ne repère aucun mode de la base",
        "give the 'POINT_REPERE' of a mode",
        "donner le 'POINT_REPERE' d'un mode",
    ),
    "link-without-entry": Message(
        "the link has no '{name}'",
        "la liaison n'a pas de '{name}'",
    ),
    "no-length": Message(
        "'{name}' of a link has no length",
        "'{name}' d'une liaison est de longueur nulle",
    ),
    "seuil-plastique-goes-raideur": Message(
        "'SEUIL_PLASTIQUE' goes with 'RAIDEUR', not with a law",
        "'SEUIL_PLASTIQUE' va avec 'RAIDEUR', pas avec une loi",
    ),
    "link-without-law": Message(
        "the link has no 'LOI_DE_COMPORTEMENT'",
        "la liaison n'a pas de 'LOI_DE_COMPORTEMENT'",
    ),
    "matrices-of-vibc": Message(
        "{n_matrices} {n_matrices:matrix is|matrices are} given",
        "{n_matrices} {n_matrices:matrice est donnée|matrices sont données}",
        "VIBC wants a mass, a stiffness and, if there is one, a damping",
        "VIBC demande une masse, une rigidité et, s'il y en a un, un amortissement",
    ),
    "four-numbers-wanted": Message(
        "'QUELCONQUE' wants a list of four numbers",
        "'QUELCONQUE' demande une liste de quatre nombres",
    ),
    "entry-is-a-table": Message(
        "'{place}' must be TABLE",
        "'{place}' doit être TABLE",
    ),
    "component-wanted": Message(
        "'{place} . {word}' names no component",
        "'{place} . {word}' ne nomme aucune composante",
        "TAB1 . {place} . '{word}' = MOT 'UX' ;",
        "TAB1 . {place} . '{word}' = MOT 'UX' ;",
    ),
    "harmonics-not-positive": Message(
        "'N_HARMONIQUE' is {harmonics}",
        "'N_HARMONIQUE' vaut {harmonics}",
        "1 or more",
        "1 ou plus",
    ),
    "unknown-result": Message(
        "'{wrong}' is no result",
        "'{wrong}' n'est pas un résultat",
        "MAXI TEMP VITE",
        "MAXI TEMP VITE",
    ),
    "no-such-component": Message(
        "'COMPOSANTES' is {component}, which no matrix has",
        "'COMPOSANTES' est {component}, qu'aucune matrice n'a",
        "unknowns: {unknowns:words}",
        "inconnues : {unknowns:words}",
    ),
    "no-harmonic-results": Message(
        "'RESULTATS_HBM' . {j} has no 'RESULTATS'",
        "'RESULTATS_HBM' . {j} n'a pas de 'RESULTATS'",
        "CONTINU gives them",
        "CONTINU les donne",
    ),
    "table-without-modes": Message(
        "the table holds no mode",
        "la table ne contient aucun mode",
    ),
    "mode-no-generalised-displacements": Message(
        "a mode has no generalised displacements in this direction",
        "un mode n'a pas de déplacements généralisés dans cette direction",
    ),
    "no-modes": Message(
        "the basis holds no modes",
        "la base ne contient pas de modes",
    ),
    "no-modes-with": Message(
        "the basis holds no modes with {name}",
        "la base ne contient pas de modes qui ont {name}",
    ),
    "two-tables-holds-modes": Message(
        "of two tables one holds modes, the other is LIAISONS_STATIQUES",
        "de deux tables, l'une contient des modes, l'autre est LIAISONS_STATIQUES",
    ),
    "static-shape-neither-force": Message(
        "a static shape has neither FORCE nor REACTION",
        "une déformée statique n'a ni FORCE ni REACTION",
        "call REAC on this table first",
        "appelez d'abord REAC sur cette table",
    ),
    "static-shapes-hold-no": Message(
        "static shapes hold no mass",
        "les déformées statiques ne portent pas de masse",
        "give the mass matrix too: MASS TAB1 MASS1",
        "donnez aussi la matrice de masse : MASS TAB1 MASS1",
    ),
    "dampings-and-modes-differ": Message(
        "{n_modes} {n_modes:mode wants|modes want} as many damping ratios, not {n_ratios}",
        "{n_modes} {n_modes:mode demande|modes demandent} autant d'amortissements réduits, pas "
        "{n_ratios}",
    ),
    "solution-out-of-scope": Message(
        "'{word}' gives an object SOLUTION of Cast3M's old substructures (STRU), which are out "
        "of ssilang's scope",
        "'{word}' donne un objet SOLUTION des anciennes sous-structures de Cast3M (STRU), hors "
        "du domaine de ssilang",
        "without it VIBR gives the same modes in a table BASE_MODALE",
        "sans lui, VIBR donne les mêmes modes dans une table BASE_MODALE",
    ),
    "mass-of-both-signs": Message(
        "the mass of {unknown} is negative: {value:g}; the modes are those of a load of both "
        "signs, as for buckling",
        "la masse de {unknown} est négative : {value:g} ; les modes sont ceux d'une charge des "
        "deux signes, comme au flambage",
        "of a structure that vibrates, look for the sign in MASS or MANU",
        "pour une structure qui vibre, cherchez le signe dans MASS ou MANU",
        severity="warning",
    ),
    "complex-modes": Message(
        "damped or unsymmetric systems have complex modes",
        "les systèmes amortis ou non symétriques ont des modes complexes",
        "use VIBR 'IRAM' for them",
        "calculez-les par VIBR 'IRAM'",
    ),
    "frequencies-and-numbers-differ": Message(
        "{n_frequencies} {n_frequencies:frequency|frequencies} and {n_numbers} "
        "{n_numbers:number|numbers} of "
        "modes are given",
        "{n_frequencies} {n_frequencies:fréquence|fréquences} et {n_numbers} "
        "{n_numbers:nombre|nombres} de "
        "modes sont donnés",
    ),
    "load-counts-pseudo-modes": Message(
        "a load counts by pseudo-modes: the basis has no 'PSEUDO_MODES'",
        "un chargement compte par des pseudo-modes : la base n'a pas de 'PSEUDO_MODES'",
    ),
    "least-mode-recombined-not": Message(
        "at least one mode is recombined, not {number:g}",
        "on recombine au moins un mode, pas {number:g}",
    ),
    "results-hold-no-steps": Message(
        "the results hold no {name} in steps",
        "les résultats ne contiennent pas de {name} par pas",
        "ask for it in the table SORTIE",
        "demandez-le dans la table SORTIE",
    ),
    "pseudo-modes-want-basis-and-time": Message(
        "pseudo-modes want a table of the basis and the time",
        "les pseudo-modes demandent une table de la base et le temps",
    ),
    "shape-no-stresses": Message(
        "a shape has no stresses",
        "une déformée n'a pas de contraintes",
        "SIGS gives them to the table",
        "SIGS les met dans la table",
    ),
    "shape-no-reactions": Message(
        "a shape has no reactions",
        "une déformée n'a pas de réactions",
        "REAC gives them to the table",
        "REAC les met dans la table",
    ),
    "nonlinear-forces-computed-time": Message(
        "nonlinear forces are computed in time",
        "les forces non linéaires se calculent en temps",
        "TAB1 . 'PROCEDURE_FREQUENCE_TEMPS' = MOT 'AFT' ;",
        "TAB1 . 'PROCEDURE_FREQUENCE_TEMPS' = MOT 'AFT' ;",
    ),
    "charmeca-gives-fields": Message(
        "CHARMECA must give {count} CHPOINTs in 'FNL_T'",
        "CHARMECA doit rendre {count} CHPOINT dans 'FNL_T'",
    ),
    "charmeca-gives-reals": Message(
        "CHARMECA must give {count} {count:real|reals} in '{place}'",
        "CHARMECA doit rendre {count} {count:réel|réels} dans '{place}'",
    ),
    "field-is-zero": Message(
        "the field is zero on the components looked at",
        "le champ est nul sur les composantes considérées",
    ),
    "nothing-to-multiply": Message(
        "the table holds no mode and no static shape to multiply",
        "la table ne contient ni mode ni déformée statique à multiplier",
    ),
    "unknown-table": Message(
        "{name} knows no table '{subtype}'",
        "{name} ne connaît pas de table '{subtype}'",
        "known: {known:words}",
        "connues : {known:words}",
    ),
}

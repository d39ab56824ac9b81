"""What ssilang/operators/statics refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-followers": Message(
        "follower loads of a procedure are not built for structures",
        "les forces suiveuses d'une procédure ne sont pas faites pour les structures",
    ),
    "small-strains-left": Message(
        "'LAGRANGIEN' 'TOTAL' is for small strains, and these reach {strain:.2g}: forces and "
        "stresses are wrong by some {error:.0%}",
        "'LAGRANGIEN' 'TOTAL' est fait pour de petites déformations, et celles-ci atteignent "
        "{strain:.2g} : forces et contraintes sont fausses d'environ {error:.0%}",
        "leave 'LAGRANGIEN' out: the law is then taken on the present geometry",
        "ôtez 'LAGRANGIEN' : la loi est alors prise sur la géométrie actuelle",
        severity="warning",
    ),
    "elastic-strains-large": Message(
        "elastic solids strain by {strain:.2g}: their law ties Green-Lagrange strains to "
        "Piola-Kirchhoff stresses, and Cauchy's differ by some {error:.0%} from those of "
        "'LAGRANGIEN' 'MI_PAS'",
        "les massifs élastiques se déforment de {strain:.2g} : leur loi lie les déformations de "
        "Green-Lagrange aux contraintes de Piola-Kirchhoff, et celles de Cauchy diffèrent "
        "d'environ {error:.0%} de celles de 'LAGRANGIEN' 'MI_PAS'",
        "MODE ... 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' with a SIGY that is never reached follows "
        "LAGRANGIEN",
        "MODE ... 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' avec un SIGY jamais atteint suit LAGRANGIEN",
        severity="warning",
    ),
    "strains-of-large-displacements": Message(
        "'DEFTO' of 'MES_SAUVEGARDES' keeps linear strains, not those of large displacements",
        "'DEFTO' de 'MES_SAUVEGARDES' garde les déformations linéaires, pas celles des grands "
        "déplacements",
    ),
    "times-and-objects-differ": Message(
        "{n_times} {n_times:time|times} for {n_objects} {n_objects:object|objects}",
        "{n_times} temps pour {n_objects} {n_objects:objet|objets}",
        "one object for each time, one time at least",
        "un objet pour chaque temps, un temps au moins",
    ),
    "not-loaded": Message(
        "the list holds objects of type {found}, of which no loading is made",
        "la liste contient des objets de type {found}, dont on ne fait pas de chargement",
    ),
    "static-path": Message("the path of loads is static", "le trajet de chargement est statique"),
    "imposed-elsewhere": Message(
        "{count} imposed {count:value belongs|values belong} to conditions that the matrix does "
        "not "
        "have: they move nothing",
        "{count} {count:valeur imposée est celle|valeurs imposées sont celles} de conditions "
        "que la "
        "matrice n'a pas : elles ne déplacent rien",
        "BLO1 = BLOQ ... ; RESO (... ET BLO1) (DEPI BLO1 ...) for that same BLO1",
        "BLO1 = BLOQ ... ; RESO (... ET BLO1) (DEPI BLO1 ...) pour ce même BLO1",
        severity="warning",
    ),
    "precision-not-positive": Message(
        "the precision must be positive, not {precision:g}",
        "la précision doit être positive, pas {precision:g}",
    ),
    "no-mechanical-zone": Message(
        "the model has no mechanical zone",
        "le modèle n'a pas de zone mécanique",
        "CHARGEMENT zones only carry loads",
        "les zones CHARGEMENT ne portent que des charges",
    ),
    "perturbation-not-positive": Message(
        "the coefficients of the perturbation must be positive",
        "les coefficients de la perturbation doivent être positifs",
    ),
    "second-field-has-no-strain": Message(
        "the second field has no strain ({names:words}) on the cells of element {element}",
        "le second champ n'a pas de déformation ({names:words}) sur les éléments {element}",
        "it has: {seen:?{seen:words}|nothing there}",
        "il a : {seen:?{seen:words}|rien}",
    ),
    "path-begins-at-first-time": Message(
        "the path begins at the first time of 'TEMPS_CALCULES'",
        "le chemin commence au premier temps de 'TEMPS_CALCULES'",
        "a new table for a new path",
        "une nouvelle table pour un nouveau chemin",
    ),
    "load-not-straight": Message(
        "the load is not straight in time over 'TEMPS_CALCULES'",
        "la charge n'est pas linéaire en temps sur 'TEMPS_CALCULES'",
        "one line from the first time to the last: the load keeps its direction",
        "une droite du premier temps au dernier : la charge garde sa direction",
    ),
    "load-does-not-change": Message(
        "the load does not change in time",
        "la charge ne varie pas dans le temps",
    ),
    "stability-for-harmonic-balance": Message(
        "'STABILITE': '{wrong}' is for harmonic balance",
        "'STABILITE' : '{wrong}' est pour l'équilibrage harmonique",
        "'DIAG'",
        "'DIAG'",
    ),
    "for-continuous-elements": Message(
        "{name} is for continuous elements, not {element}",
        "{name} vaut pour les éléments massifs, pas pour {element}",
    ),
    "no-cracks": Message(
        "{name} takes one field of displacements: cracks (XFEM) are not built",
        "{name} prend un seul champ de déplacements : les fissures (XFEM) ne sont pas programmées",
    ),
    "no-gradients": Message(
        "no field of gradients is given",
        "aucun champ de gradients n'est donné",
        "GRAD makes one",
        "GRAD en fait un",
    ),
    "not-gradients": Message(
        "a field of gradients has components UX,X UX,Y ...; this one has {components:words}",
        "un champ de gradients a les composantes UX,X UX,Y ... ; celui-ci a {components:words}",
    ),
    "frequencies-wanted": Message(
        "'TEMPS_CALCULES' holds the frequencies, at least one, none negative",
        "'TEMPS_CALCULES' contient les fréquences, une au moins, aucune négative",
    ),
    "dashpots-by-numbers": Message(
        "dashpots of impedances given by numbers count by the matrix of damping only",
        "les amortisseurs des impédances données par des nombres ne comptent que par la "
        "matrice d'amortissement",
        "TAB1 . 'AMORTISSEMENT' = AMOR MODELE CARACTERISTIQUES ;",
        "TAB1 . 'AMORTISSEMENT' = AMOR MODELE CARACTERISTIQUES ;",
        severity="warning",
    ),
    "law-has-no-harmonic-response": Message(
        "a law {behaviour:words} has no harmonic response",
        "une loi {behaviour:words} n'a pas de réponse harmonique",
        "only linear models work in a sweep of frequencies",
        "seuls les modèles linéaires vont dans un balayage en fréquence",
    ),
    "empty-mesh-for-force": Message(
        "the mesh is empty: there is nothing to share the force out to",
        "le maillage est vide : il n'y a rien sur quoi répartir la force",
    ),
    "no-numbered-entry": Message(
        "the table has no entry numbered 1, 2 ...",
        "la table n'a pas d'entrée numérotée 1, 2 ...",
    ),
    "not-shb8": Message(
        "'SHB8' is for models of elements SHB8",
        "'SHB8' vaut pour les modèles d'éléments SHB8",
    ),
    "load-not-available": Message(
        "'{found}' loads are not available",
        "les charges '{found}' ne sont pas disponibles",
        "'MASS' is",
        "'MASS' l'est",
    ),
    "no-moment-by-vector": Message(
        "a vector gives no moment in the plane",
        "un vecteur ne donne pas de moment dans le plan",
        "name it: 'MZ' value",
        "nommez-le : 'MZ' valeur",
    ),
    "entry-wants-point-and-unknown": Message(
        "each entry wants POINT_LIAISON (POINT) and DDL_LIAISON (MOT)",
        "chaque entrée demande POINT_LIAISON (POINT) et DDL_LIAISON (MOT)",
    ),
    "pressure-has-one-component": Message(
        "a pressure is a field with one component",
        "une pression est un champ à une composante",
    ),
    "curve-holds-no-number": Message(
        "the curve has {value:g} at abscissa {abscissa:g}{more:? (and {more} more)}",
        "l'évolution a {value:g} à l'abscisse {abscissa:g}{more:? (et {more} autres)}",
        "a gap in the record of a motion: fill it before",
        "un trou dans l'enregistrement d'un mouvement : comblez-le avant",
    ),
    "tables-are-empty": Message(
        "the tables are empty",
        "les tables sont vides",
    ),
    "parts-do-not-add-up": Message(
        "parts of types {kinds:words} do not add up",
        "des parties de types {kinds:words} ne s'additionnent pas",
        "name one",
        "nommez-en une",
    ),
    "loading-empty": Message(
        "the loading is empty",
        "le chargement est vide",
    ),
    "no-part-of-name": Message(
        "no part is called {names:words}",
        "aucune partie ne s'appelle {names:words}",
        "its parts are: {known}",
        "ses parties sont : {known}",
    ),
    "no-part-of-number": Message(
        "the loading has {n_parts} {n_parts:part|parts}, none of number {place}",
        "le chargement a {n_parts} {n_parts:partie|parties}, aucune de numéro {place}",
    ),
    "part-has-no-curve": Message(
        "this part has no curve in time",
        "cette partie n'a pas d'évolution en temps",
    ),
    "moving-load": Message(
        "moving loadings ('{said}') are not supported",
        "les chargements mobiles ('{said}') ne sont pas disponibles",
        "give the field at each time by two tables",
        "donnez le champ à chaque temps par deux tables",
    ),
    "one-curve-wanted": Message(
        "one curve is needed, this object has {n_parts}",
        "il faut une courbe, cet objet en a {n_parts}",
    ),
    "empty-curve": Message(
        "the curve is empty",
        "l'évolution est vide",
    ),
    "index-missing": Message(
        "index {i} is missing in one of the tables",
        "l'indice {i} manque dans l'une des tables",
        "times and fields are indexed by 0 1 2 ... without a gap",
        "les temps et les champs ont pour indices 0 1 2 ... sans trou",
    ),
    "time-and-field-wanted": Message(
        "at index {i} a time and a field are needed",
        "à l'indice {i} il faut un temps et un champ",
    ),
    "times-must-increase": Message(
        "times must increase: {time:g} follows {steps:g}",
        "les temps doivent croître : {time:g} suit {steps:g}",
    ),
    "no-time-after-start": Message(
        "no time of '{index}' comes after the initial one, {first:g}",
        "aucun temps de '{index}' ne suit le temps initial, {first:g}",
    ),
    "no-results-to-go-on-from": Message(
        "'REPRISE' needs the results of an earlier calculation",
        "'REPRISE' demande les résultats d'un calcul précédent",
    ),
    "no-result-at-time": Message(
        "no result stands at the time of 'REPRISE', {again:g}",
        "aucun résultat n'est au temps de 'REPRISE', {again:g}",
        "the nearest is at {times:g}",
        "le plus proche est à {times:g}",
    ),
    "charmeca-gives-a-table": Message(
        "the procedure CHARMECA must give one TABLE",
        "la procédure CHARMECA doit rendre une TABLE",
        "TAB2 = TABL ; TAB2 . 'ADDI_SECOND' = ... ; FINP TAB2 ;",
        "TAB2 = TABL ; TAB2 . 'ADDI_SECOND' = ... ; FINP TAB2 ;",
    ),
    "force-without-unknowns": Message(
        "'ADDI_SECOND' acts where there are no unknowns: {lost}",
        "'ADDI_SECOND' agit là où il n'y a pas d'inconnues : {lost}",
    ),
    "friction-of-sides-and-cables": Message(
        "sides with friction in space and cables with friction do not go together yet",
        "des bords frottants en 3D et des câbles frottants ne vont pas encore ensemble",
        "smooth sides (UNILATERAL) beside the cables",
        "prenez des bords sans frottement (UNILATERAL) avec les câbles",
    ),
    "cable-without-bars": Message(
        "a cable with friction (FROCABLE) has no bars on its cells",
        "un câble frottant (FROCABLE) n'a pas de barres sur ses mailles",
        "MODE cable 'MECANIQUE' 'ELASTIQUE' 'BARR', joined to the model",
        "MODE câble 'MECANIQUE' 'ELASTIQUE' 'BARR', réuni au modèle",
    ),
    "cable-not-elastic": Message(
        "cables with friction are elastic",
        "les câbles frottants sont élastiques",
        "ELASTIQUE alone for the bars",
        "donnez ELASTIQUE seul aux barres",
    ),
    "no-load-at-time": Message(
        "the load {word} gives no {staged} at time {time:g}",
        "le chargement {word} ne donne aucun {staged} au temps {time:g}",
        "CHAR '{word}' TABLE1 TABLE2 : times, and a {staged} for each",
        "CHAR '{word}' TABLE1 TABLE2 : des temps, et un {staged} pour chacun",
    ),
    "no-strain-to-control": Message(
        "no element has strains to control the load by",
        "aucun élément n'a de déformations pour piloter la charge",
        "write your own procedure: DEBP PILOINDI ... or DEBP AUTOPILO ...",
        "écrivez votre propre procédure : DEBP PILOINDI ... ou DEBP AUTOPILO ...",
    ),
    "procedure-gives-a-real": Message(
        "the procedure {name} must give one FLOTTANT",
        "la procédure {name} doit rendre un FLOTTANT",
    ),
    "no-norm-of-step": Message(
        "AUTOPILO gives no norm to the step that the load causes",
        "AUTOPILO ne donne pas de norme au pas que la charge cause",
    ),
    "two-controls": Message(
        "'PILOTAGE_INDIRECT' and 'AUTOMATIQUE' exclude one another",
        "'PILOTAGE_INDIRECT' et 'AUTOMATIQUE' s'excluent",
    ),
    "only-in-statics": Message(
        "'{asked}' is for static calculations",
        "'{asked}' est pour les calculs statiques",
    ),
    "which-load-is-controlled": Message(
        "which load is controlled?",
        "quelle charge est pilotée ?",
        "'DEPLACEMENTS_PILOTES' (from DEPI) or 'FORCES_PILOTEES'",
        "'DEPLACEMENTS_PILOTES' (de DEPI) ou 'FORCES_PILOTEES'",
    ),
    "control-does-not-change": Message(
        "'PARAMETRE_DE_PILOTAGE' does not change over step {k}",
        "'PARAMETRE_DE_PILOTAGE' ne varie pas sur le pas {k}",
        "it must reach beyond the last time",
        "il doit aller au-delà du dernier temps",
    ),
    "control-not-positive": Message(
        "'AUTOCRIT', 'AUTOPAS' and 'AUTORESU' are positive",
        "'AUTOCRIT', 'AUTOPAS' et 'AUTORESU' sont positifs",
    ),
    "path-ends-early": Message(
        "'AUTOPAS' = {most} {most:step|steps} did not reach the time asked for: the path ends "
        "at {times:g}",
        "'AUTOPAS' = {most} pas n'ont pas atteint le temps demandé : le chemin finit en {times:g}",
        "more steps, or a greater 'AUTOCRIT'",
        "davantage de pas, ou un 'AUTOCRIT' plus grand",
        severity="warning",
    ),
    "controlled-load-strains-nothing": Message(
        "the displacement of the controlled load causes no strain",
        "le déplacement de la charge pilotée ne déforme rien",
    ),
    "empty-fields": Message(
        "the fields hold nothing",
        "les champs ne contiennent rien",
    ),
    "badly-conditioned": Message(
        "the condition number of the matrix is {number:.0e}: {digits} of 16 digits are left",
        "le conditionnement de la matrice vaut {number:.0e} : il reste {digits} chiffres sur 16",
        "check units: the stiffest part reaches {most:.1e} ({stiff}), the softest "
        "{least:.1e} ({soft})",
        "vérifiez les unités : la partie la plus raide atteint {most:.1e} ({stiff}), la plus "
        "souple {least:.1e} ({soft})",
        severity="warning",
    ),
    "entry-has-no-force": Message(
        "an entry has no FORCE",
        "une entrée n'a pas de FORCE",
        "call DEPI on this table first",
        "appelez d'abord DEPI sur cette table",
    ),
    "no-displacement-no-gradient": Message(
        "EPSI takes displacements, or a field of gradients {names:words}",
        "EPSI prend des déplacements, ou un champ de gradients {names:words}",
        "this field has: {seen:?{seen:words}|nothing there}",
        "ce champ a : {seen:?{seen:words}|rien}",
    ),
    "no-stress-no-strain": Message(
        "neither field holds stresses or strains of the model",
        "aucun des champs ne contient de contraintes ou de déformations du modèle",
    ),
    "strain-not-available": Message(
        "strains '{word}' are not available",
        "les déformations '{word}' ne sont pas disponibles",
        "'LINE' and 'QUAD' are",
        "'LINE' et 'QUAD' le sont",
    ),
    "body-not-joined": Message(
        "nothing holds the body of {n_nodes} nodes around ({place}), which stays where it is: "
        "{n_doubled} of its nodes lie on nodes of another body and are not joined to them",
        "rien ne tient le corps de {n_nodes} noeuds autour de ({place}), qui reste où il est : "
        "{n_doubled} de ses noeuds sont à la place de noeuds d'un autre corps sans leur être liés",
        "ELIM joins nodes at the same place",
        "ELIM réunit les noeuds qui sont au même endroit",
        severity="warning",
    ),
}

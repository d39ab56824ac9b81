"""What ssilang/operators/curves refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "filter-without-corner": Message(
        "FILT of a record needs a corner",
        "FILT d'un signal demande une coupure",
        "'PHAU' F1 takes off what is slower, 'PBAS' F2 what is faster",
        "'PHAU' F1 ôte ce qui est plus lent, 'PBAS' F2 ce qui est plus rapide",
    ),
    "components-apart": Message(
        "the components have {n_first} and {n_second} instants, or not the same ones",
        "les composantes ont {n_first} et {n_second} instants, ou pas les mêmes",
        "IPOL brings one to the instants of the other",
        "IPOL porte l'une aux instants de l'autre",
    ),
    "damping-in-per-cent": Message(
        "a damping ratio of {ratio:g} is critical or more: in per cent?",
        "un amortissement réduit de {ratio:g} est critique ou plus : en pour cent ?",
        "5 % are 0.05: {meant:g} here",
        "5 % s'écrivent 0.05 : ici {meant:g}",
        severity="warning",
    ),
    "no-accelerations": Message(
        "the ordinates of the curve are called '{name}': they are taken as accelerations",
        "les ordonnées de l'évolution s'appellent '{name}' : elles sont prises comme accélérations",
        "read the file of the accelerations (.AT2); if they are some, EVOL 'MANU' names them "
        "'ACCE'",
        "lisez le fichier des accélérations (.AT2) ; si elles en sont, EVOL 'MANU' les nomme "
        "'ACCE'",
        severity="warning",
    ),
    "tolerance-not-positive": Message(
        "the largest misfit must be above zero, not {tolerance:g}",
        "le plus grand écart doit être positif, pas {tolerance:g}",
    ),
    "rotd-incomplete": Message(
        "'ROTD' takes two components, percentiles and the signal's own times",
        "'ROTD' prend deux composantes, des centiles et les instants du signal",
        "SPO EVOL1 EVOL2 'ROTD' (PROG 50. 100.) 'AMOR' 0.05 'ACCE'",
        "SPO EVOL1 EVOL2 'ROTD' (PROG 50. 100.) 'AMOR' 0.05 'ACCE'",
    ),
    "one-curve-wanted": Message(
        "one curve is needed, here are {n_parts}",
        "il faut une courbe, il y en a {n_parts}",
    ),
    "power-of-two": Message(
        "2**N1 points are used: N1 is between 1 and 26, not {power}",
        "2**N1 points sont pris : N1 est entre 1 et 26, pas {power}",
    ),
    "duration-too-short": Message(
        "the periods go from 0.04 s to the duration, which is {duration:g}",
        "les périodes vont de 0.04 s à la durée, qui vaut {duration:g}",
    ),
    "kind-of-spectrum": Message(
        "a spectrum is of DEPL, VITE or ACCE, not {name}",
        "un spectre est de DEPL, VITE ou ACCE, pas {name}",
    ),
    "frequency-not-positive": Message(
        "frequencies must be positive to divide by them",
        "les fréquences doivent être positives pour diviser par elles",
    ),
    "signals-outside-modulation": Message(
        "signals from {start:g} to {end:g} do not fit in the modulation, from {first:g} to "
        "{last:g}",
        "des signaux de {start:g} à {end:g} n'entrent pas dans la modulation, de {first:g} à "
        "{last:g}",
    ),
    "signal-too-short": Message(
        "a signal needs two instants and one sine at least",
        "un signal demande au moins deux instants et un sinus",
    ),
    "not-a-power-spectrum": Message(
        "a power spectrum stands over increasing frequencies, two at least",
        "une densité spectrale de puissance porte sur des fréquences croissantes, deux au moins",
    ),
    "limits-of-bands": Message(
        "{n_parts} {n_parts:modulation needs|modulations need} {least} {least:limit|limits} of "
        "bands, found {n_limits}",
        "{n_parts} {n_parts:modulation demande|modulations demandent} {least} "
        "{least:limite|limites} de bandes, trouvé {n_limits}",
    ),
    "modulations-differ": Message(
        "all modulations must begin and end together",
        "toutes les modulations doivent commencer et finir ensemble",
    ),
    "table-has-no-spectrum": Message(
        "the table holds no spectrum at 1, 2 ...",
        "la table ne contient pas de spectre en 1, 2 ...",
    ),
    "spectrum-and-dampings-wanted": Message(
        "table {index} wants a SPECTRE and its list AMORTISSEMENT",
        "la table {index} veut un SPECTRE et sa liste AMORTISSEMENT",
    ),
    "curves-and-dampings-differ": Message(
        "spectrum {index} has {n_parts} {n_parts:curve|curves} for {n_dampings} "
        "{n_dampings:damping|dampings}",
        "le spectre {index} a {n_parts} {n_parts:courbe|courbes} pour {n_dampings} "
        "{n_dampings:amortissement|amortissements}",
    ),
    "law-and-kinds-wanted": Message(
        "SPON wants a law (CINE ISOT ELAS) and the kinds of both spectra",
        "SPON veut une loi (CINE ISOT ELAS) et le type des deux spectres",
    ),
    "ductility-and-hardening-wanted": Message(
        "a law wants a ductility and a hardening ratio",
        "une loi veut une ductilité et un rapport d'écrouissage",
    ),
    "spectra-and-dampings-differ": Message(
        "SPON wants one linear spectrum for each damping",
        "SPON veut un spectre linéaire par amortissement",
    ),
    "takeda-not-available": Message(
        "the law of Takeda is not available",
        "la loi de Takeda n'est pas disponible",
        "CINE ISOT or ELAS",
        "CINE ISOT ou ELAS",
    ),
    "no-real-index": Message(
        "the table has no FLOTTANT index",
        "la table n'a pas d'indice FLOTTANT",
    ),
    "fields-of-one-kind": Message(
        "between {first:g} and {last:g} the table has not two fields of one kind",
        "entre {first:g} et {last:g}, la table n'a pas deux champs d'un même type",
        "IPOL takes two CHPOINT or two MCHAML",
        "IPOL prend deux CHPOINT ou deux MCHAML",
    ),
    "outside-table": Message(
        "{time:g} is outside of the table, {first:g} to {last:g}",
        "{time:g} est hors de la table, de {first:g} à {last:g}",
    ),
    "abscissas-have-one-component": Message(
        "a field of curvilinear abscissas has one component",
        "un champ d'abscisses curvilignes a une composante",
    ),
    "outside-line": Message(
        "{distance:g} is outside of the line, {first:g} to {last:g}",
        "{distance:g} est hors de la ligne, de {first:g} à {last:g}",
    ),
    "empty-curve": Message(
        "a curve is empty",
        "une courbe est vide",
    ),
    "bounds-differ": Message(
        "{n_low} lower and {n_high} upper bounds",
        "{n_low} bornes inférieures et {n_high} supérieures",
    ),
    "no-such-place": Message(
        "the curve has {count} {count:point|points}, places go from 1 to {count}",
        "la courbe a {count} {count:point|points}, les rangs vont de 1 à {count}",
    ),
    "no-axis-of-name": Message(
        "no axis is called '{wanted}'",
        "aucun axe ne s'appelle '{wanted}'",
        "axes: {names:words}",
        "axes : {names:words}",
    ),
    "no-such-curve": Message(
        "the object has {n_parts} {n_parts:curve|curves}, none of number {place}",
        "l'objet a {n_parts} {n_parts:courbe|courbes}, aucune de numéro {place}",
    ),
    "step-of-points": Message(
        "one point of N is kept: N is positive, not {step}",
        "un point sur N est gardé : N est positif, pas {step}",
    ),
    "no-axis-with-name": Message(
        "no axis is called '{wanted}'",
        "aucun axe ne s'appelle '{wanted}'",
    ),
    "which-curve": Message(
        "what kind of curve?",
        "quelle sorte d'évolution ?",
        "EVOL {kinds:words}",
        "EVOL {kinds:words}",
    ),
    "two-axis-names": Message(
        "one name may stand before each list, found {names:words}",
        "un seul nom peut précéder chaque liste, trouvé {names:words}",
        "EVOL 'MANU' 'TIME' LREE1 'FORCE' LREE2 ; a legend: 'LEGE' 'text'",
        "EVOL 'MANU' 'TEMPS' LREE1 'FORCE' LREE2 ; une légende : 'LEGE' 'texte'",
    ),
    "abscissas-and-ordinates-differ": Message(
        "{n_x} {n_x:abscissa|abscissas} for {n_y} {n_y:ordinate|ordinates}",
        "{n_x} {n_x:abscisse|abscisses} pour {n_y} {n_y:ordonnée|ordonnées}",
    ),
    "lists-differ": Message(
        "the lists have {n_x}, {n_values} and {n_values_2} {n_values_2:item|items}",
        "les listes ont {n_x}, {n_values} et {n_values_2} {n_values_2:valeur|valeurs}",
    ),
    "no-such-component": Message(
        "there is no component '{name}' here: {known:?there are {known}|the fields have "
        "none at all}",
        "il n'y a pas ici de composante '{name}' : {known:?il y a {known}|les champs "
        "n'en ont aucune}",
        "{near:?did you mean '{near}'?}",
        "{near:?vouliez-vous dire '{near}' ?}",
    ),
    "no-value-at-node": Message(
        "{name} has no value at node {node}: the nearest one that has it is {nearest}, at a "
        "distance of {distance:.4g}",
        "{name} n'a pas de valeur au noeud {node} : le plus proche qui en a une est {nearest}, à "
        "une distance de {distance:.4g}",
        "take a node of the mesh, as MAIL1 POIN 'PROC' P1 finds it; a point written anew is "
        "another node",
        "prenez un noeud du maillage, comme MAIL1 POIN 'PROC' P1 le trouve ; un point écrit à "
        "nouveau est un autre noeud",
    ),
    "no-value-on-line": Message(
        "the field has no value of {name} at {n_missing} of the {n_nodes} "
        "{n_nodes:node|nodes} of the line",
        "le champ n'a pas de valeur de {name} en {n_missing} des {n_nodes} "
        "{n_nodes:noeud|noeuds} de la ligne",
        "the curve is zero there",
        "la courbe y est nulle",
        severity="warning",
    ),
    "which-component": Message(
        "the field has several components",
        "le champ a plusieurs composantes",
        "name one: {names:words}",
        "nommez-en une : {names:words}",
    ),
    "no-results-in-time": Message(
        "the table holds no results in time at index {index}",
        "la table ne contient pas de résultats en temps à l'indice {index}",
        "DYNAMIC gives them in another table, TAB2 = DYNAMIC TAB1; PASAPAS keeps 'DEPLACEMENTS' "
        "in its own",
        "DYNAMIC les donne dans une autre table, TAB2 = DYNAMIC TAB1 ; PASAPAS garde "
        "'DEPLACEMENTS' dans la sienne",
    ),
    "no-such-step": Message(
        "there are {n_fields} {n_fields:step|steps}",
        "il y a {n_fields} pas",
    ),
    "no-value-at-point": Message(
        "no value of {name} in zone {zone}, cell {cell}, point {point}",
        "pas de valeur de {name} dans la zone {zone}, élément {cell}, point {point}",
    ),
    "fields-and-times-differ": Message(
        "{n_fields} {n_fields:field|fields} for {n_times} {n_times:time|times}",
        "{n_fields} {n_fields:champ|champs} pour {n_times} {n_times:instant|instants}",
    ),
    "no-modulation-of-wavelets": Message(
        "modulations of wavelets are not built: the notice does not name the filters",
        "les modulations d'ondelettes ne sont pas programmées : la notice ne nomme pas les filtres",
    ),
    "cannot-be-continued": Message(
        "this curve has too few points, or words, and cannot be continued",
        "cette courbe a trop peu de points, ou des mots, et ne se prolonge pas",
    ),
    "curves-two-by-two": Message(
        "curves are joined two by two: here are {n_parts} and {n_others}",
        "les courbes se joignent deux à deux : il y en a {n_parts} et {n_others}",
    ),
    "no-optimal-fit": Message(
        "'OPTI' is not available in LSQF",
        "'OPTI' n'est pas disponible dans LSQF",
        "'UNIF' or 'REDU'",
        "'UNIF' ou 'REDU'",
    ),
    "counts-not-positive": Message(
        "the numbers of intervals and of samples must be positive",
        "les nombres d'intervalles et d'échantillons doivent être positifs",
    ),
    "times-of-force-not-covered": Message(
        "displacement and velocity must cover the times of the force",
        "le déplacement et la vitesse doivent couvrir les instants de la force",
    ),
    "count-of-shocks": Message(
        "the number of shocks is positive, not {count}",
        "le nombre de chocs est positif, pas {count}",
    ),
    "only-inverse-transform": Message(
        "only the inverse transform is available",
        "seule la transformée inverse est disponible",
        "LAPL 'INVERSE' ...",
        "LAPL 'INVERSE' ...",
    ),
    "parts-differ": Message(
        "{n_real} real parts for {n_imaginary} imaginary parts",
        "{n_real} parties réelles pour {n_imaginary} parties imaginaires",
    ),
    "words-and-numbers": Message(
        "a curve of words and a curve of numbers cannot be joined",
        "une courbe de mots et une courbe de nombres ne se joignent pas",
    ),
    "last-points-together": Message(
        "the last two points of the curve have the same abscissa",
        "les deux derniers points de la courbe ont la même abscisse",
    ),
    "one-curve-at-a-time": Message(
        "one curve is transformed at a time, here are {n_parts}",
        "une courbe se transforme à la fois, il y en a {n_parts}",
    ),
    "complex-curve-wanted": Message(
        "one complex curve is needed",
        "il faut une courbe complexe",
        "made by TFR or EVOL 'COMP'",
        "faite par TFR ou EVOL 'COMP'",
    ),
    "frequencies-from-zero": Message(
        "the frequencies must begin at 0, not {f:g}",
        "les fréquences doivent commencer à 0, pas {f:g}",
    ),
    "filter-incomplete": Message(
        "a filter needs N1, a 'TYPE' and a positive step 'DFRQ'",
        "un filtre demande N1, un 'TYPE' et un pas 'DFRQ' positif",
    ),
    "peaks-of-one-curve": Message(
        "peaks and places are given for one curve only",
        "les pics et leurs rangs sont donnés pour une seule courbe",
    ),
    "times-and-values-in-pairs": Message(
        "times and values come in pairs, found {n_values} {n_values:number|numbers}",
        "instants et valeurs vont par paires, trouvé {n_values} {n_values:nombre|nombres}",
    ),
    "cut-off-not-positive": Message(
        "a cut-off frequency is positive, not {cut:g}",
        "une fréquence de coupure est positive, pas {cut:g}",
    ),
    "terms-below-diagonal": Message(
        "a diagonal of {n_diagonal} {n_diagonal:term|terms} has {needed} {needed:term|terms} "
        "below it, not {n_below}",
        "une diagonale de {n_diagonal} {n_diagonal:terme|termes} a {needed} {needed:terme|termes} "
        "au-dessous, pas {n_below}",
    ),
    "complex-eigenvalues": Message(
        "this matrix has complex eigenvalues",
        "cette matrice a des valeurs propres complexes",
    ),
    "power-of-two-of-wavelets": Message(
        "2**N1 points are used: N1 is between 1 and 20, not {power}",
        "2**N1 points sont pris : N1 est entre 1 et 20, pas {power}",
    ),
    "frequencies-must-increase": Message(
        "'FMIN' ({fmin:g}) and 'FMAX' ({fmax:g}) are positive and increase",
        "'FMIN' ({fmin:g}) et 'FMAX' ({fmax:g}) sont positifs et croissants",
    ),
    "transform-too-large": Message(
        "the transform would have too many values",
        "la transformée aurait trop de valeurs",
        "fewer frequencies 'NFRQ'",
        "moins de fréquences 'NFRQ'",
    ),
    "two-dimensions-wanted": Message(
        "a mesh needs two dimensions",
        "un maillage demande deux dimensions",
        "OPTI DIME 2 ;",
        "OPTI DIME 2 ;",
    ),
}

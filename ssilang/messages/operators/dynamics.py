"""What ssilang/operators/dynamics refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "instants-of-motion": Message(
        "MOUVEMENT holds {count} {count:instant|instants}, each needs TEMP, DEPL, VITE and ACCE",
        "MOUVEMENT contient {count} {count:instant|instants}, chacun a TEMP, DEPL, VITE et ACCE",
        "give the table of DYNAMIC, @ONDE or @COLONNE, with two instants at least",
        "donner la table de DYNAMIC, @ONDE ou @COLONNE, avec au moins deux instants",
    ),
    "motion-times-must-increase": Message(
        "the times of MOUVEMENT must increase",
        "les temps de MOUVEMENT doivent croître",
    ),
    "element-too-long": Message(
        "the element at {place:words} is {length:.3g} m long: at {frequency:.3g} Hz and "
        "{speed:.4g} m/s it may be {wanted:.3g} m ({elements} a wavelength); {count} too long",
        "l'élément en {place:words} est long de {length:.3g} m : à {frequency:.3g} Hz et "
        "{speed:.4g} m/s il peut l'être de {wanted:.3g} m ({elements} par longueur d'onde) ; "
        "{count} sont trop longs",
        "make the mesh finer, or give FREQUENCE if less matters",
        "affiner le maillage, ou donner FREQUENCE si moins importe",
        severity="warning",
    ),
    "edges-reflect": Message(
        "the box reflects: {count} {count:node|nodes} of its edges have no damper; from "
        "{place:words}, {distance:.3g} m from the layer, waves are back after {back:.3g} s",
        "le massif réfléchit : {count} {count:noeud|noeuds} de ses bords sans amortisseur ; de "
        "{place:words}, à {distance:.3g} m de la couche, les ondes reviennent après {back:.3g} s",
        "give AMORTISSEURS, with the matrices of DYNAMIC, or a wider box",
        "donner AMORTISSEURS, avec les matrices de DYNAMIC, ou un massif plus large",
        severity="warning",
    ),
    "reflection-of-layer": Message(
        "REFLEXION is between 0 and 1, not {reflection:g}",
        "REFLEXION est entre 0 et 1, pas {reflection:g}",
        "0.01 is one percent; without it the number of elements gives the value",
        "0.01 vaut un pour cent ; sans cette entrée, le nombre d'éléments donne la valeur",
    ),
    "thin-layer": Message(
        "the layer is {cells:.2g} elements thick: with fewer than {fewest} it reflects as much as "
        "dampers",
        "la couche a {cells:.2g} éléments d'épaisseur : avec moins de {fewest} elle réfléchit "
        "autant que des amortisseurs",
        "8 elements are usual",
        "8 éléments sont l'usage",
        severity="warning",
    ),
    "free-field-yields": Message(
        "the free field has yielded where the linear ground of the box takes its motion: {count} "
        "{count:element|elements}, the most at {place:words} (cumulated plastic strain "
        "{strain:.3g})",
        "le champ libre a plastifié là où le sol linéaire du massif prend son mouvement : {count} "
        "{count:élément|éléments}, le plus en {place:words} (déformation plastique cumulée "
        "{strain:.3g})",
        "no linear ground moves so: a linear column, of the moduli that ISSLEQ finds, given to the "
        "box too",
        "aucun sol linéaire ne bouge ainsi : une colonne linéaire, aux modules que trouve ISSLEQ, "
        "donnés aussi au massif",
    ),
    "soil-yields-outside": Message(
        "{count} {count:element|elements} of {law} (the first at {place:words}) "
        "{count:is|are} in the layer or outside it, where the soil has to be linear",
        "{count} {count:élément|éléments} de {law} (le premier en {place:words}) "
        "{count:est|sont} dans la couche ou à l'extérieur, où le sol doit être linéaire",
        "outside moves only what the structure sends back, which says nothing of yielding: make it "
        "elastic there; soil inside the layer may yield",
        "à l'extérieur ne bouge que ce que la structure renvoie, qui ne dit rien de la "
        "plasticité : le rendre élastique ; le sol à l'intérieur de la couche peut plastifier",
    ),
    "soil-yields-at-edges": Message(
        "{count} {count:element|elements} of {law} (the first at {place:words}) "
        "{count:touches|touch} the edges, where the soil has to be linear",
        "{count} {count:élément|éléments} de {law} (le premier en {place:words}) "
        "{count:touche|touchent} les bords, où le sol doit être linéaire",
        "the forces of the ground beyond come from the matrices of these elements: make a row of "
        "elements at the edges elastic",
        "les forces du sol au-delà viennent des matrices de ces éléments : rendre élastique une "
        "rangée d'éléments le long des bords",
    ),
    "wave-out-of-plane": Message(
        "{wave} waves are not available in dimension {dimension}",
        "les ondes {wave} ne sont pas disponibles en dimension {dimension}",
        "P and SV in the plane, all three in space",
        "P et SV dans le plan, toutes les trois dans l'espace",
    ),
    "wave-already-there": Message(
        "the wave is there before its record begins, by {seconds:.3g} s at the first point",
        "l'onde est là avant le début de son signal, de {seconds:.3g} s au premier point",
        "put that duration of zeros before the record",
        "mettre cette durée de zéros avant le signal",
        severity="warning",
    ),
    "record-drifts": Message(
        "the record ends at a velocity of {velocity:.3g} m/s, its largest is {largest:.3g} m/s: "
        "what is left is taken out",
        "le signal finit à la vitesse {velocity:.3g} m/s, sa plus grande est {largest:.3g} m/s : "
        "le reste est ôté",
        "COSI corrects it",
        "COSI le corrige",
        severity="warning",
    ),
    "layers-of-wave": Message(
        "COUCHES holds no layer 1",
        "COUCHES ne contient pas de couche 1",
    ),
    "layer-not-elastic": Message(
        "layer {number} needs YOUNG and MASSE_VOLUMIQUE above 0, POISSON between -1 and 0.5",
        "la couche {number} a YOUNG et MASSE_VOLUMIQUE positifs, POISSON entre -1 et 0.5",
    ),
    "thickness-of-layer": Message(
        "layer {number} has no EPAISSEUR: only the last one has no end",
        "la couche {number} n'a pas d'EPAISSEUR : seule la dernière est sans fin",
    ),
    "footing-without-joints": Message(
        "the model has no joints: what stands on the ground is not known",
        "le modèle n'a pas de joints : on ne sait pas ce qui repose sur le sol",
    ),
    "waves-before-the-record": Message(
        "the ground moves before the given acceleration begins: at {share:.2g} % of the largest "
        "velocity, which is cut off",
        "le sol bouge avant le début de l'accélération donnée : à {share:.2g} % de la plus grande "
        "vitesse, ce qui est coupé",
        "begin the record with {rest:.2g} s of zeros: waves cross the layers before they are felt",
        "commencez l'enregistrement par {rest:.2g} s de zéros : les ondes traversent les couches "
        "avant d'être ressenties",
        severity="warning",
    ),
    "base-without-question": Message(
        "FREQUENCES for factors is missing, or ACCELERATION for the record of the base",
        "il manque FREQUENCES pour les facteurs, ou ACCELERATION pour le signal de la base",
    ),
    "size-of-base": Message(
        "the base {shape} needs {name}, in metres, above zero",
        "la base {shape} demande {name}, en mètres, positif",
    ),
    "incoherence-large": Message(
        "INCOHERENCE {gamma:.3g} is beyond what arrays have shown (0 to {most:.3g})",
        "INCOHERENCE {gamma:.3g} dépasse ce que des réseaux ont montré (0 à {most:.3g})",
        "most dense arrays are fitted by 0.1 to 0.3",
        "0,1 à 0,3 convient à la plupart des réseaux denses",
        severity="warning",
    ),
    "base-moves-before-record": Message(
        "the base moves {seconds:.3g} s before its record begins, since the wave is at its edge "
        "first: this is cut off",
        "la base bouge {seconds:.3g} s avant le début de son signal, l'onde étant d'abord à son "
        "bord : c'est coupé",
        "put that duration of zeros before the record",
        "mettre cette durée de zéros avant le signal",
        severity="warning",
    ),
    "passage-impossible": Message(
        "no wave passes at {speed:.4g} m/s on ground whose shear waves do {shear:.4g} m/s",
        "aucune onde ne passe à {speed:.4g} m/s sur un sol dont les ondes de cisaillement vont à "
        "{shear:.4g} m/s",
        "VITESSE_APPARENTE is in m/s: Vs over the sine of the incidence, 1000 and more for most "
        "quakes",
        "VITESSE_APPARENTE est en m/s : Vs sur le sinus de l'incidence, 1000 et plus pour la "
        "plupart des séismes",
    ),
    "passage-slow": Message(
        "waves pass at {speed:.4g} m/s, slower than Rayleigh's on this ground (shear waves: "
        "{shear:.4g} m/s)",
        "les ondes passent à {speed:.4g} m/s, moins vite que celles de Rayleigh sur ce sol (ondes "
        "de cisaillement : {shear:.4g} m/s)",
        "VITESSE_APPARENTE is Vs over the sine of the incidence, 1000 m/s and more for most quakes",
        "VITESSE_APPARENTE vaut Vs sur le sinus de l'incidence, 1000 m/s et plus pour la plupart "
        "des séismes",
        severity="warning",
    ),
    "motion-everywhere-the-same": Message(
        "the motion is the same everywhere: INCOHERENCE is zero and VITESSE_APPARENTE is not given",
        "le mouvement est partout le même : INCOHERENCE est nulle et VITESSE_APPARENTE absente",
        "give one of them, else the base moves as the ground",
        "donner l'une des deux, sinon la base bouge comme le sol",
        severity="warning",
    ),
    "layer-too-coarse": Message(
        "the layer from {top:.4g} to {bottom:.4g} m below the surface has nodes {height:.3g} m "
        "apart: at {frequency:.3g} Hz and {speed:.4g} m/s they may be {wanted:.3g} m ({nodes} a "
        "wavelength)",
        "la couche de {top:.4g} à {bottom:.4g} m sous la surface a des noeuds distants de "
        "{height:.3g} m : à {frequency:.3g} Hz et {speed:.4g} m/s ils peuvent l'être de "
        "{wanted:.3g} m ({nodes} par longueur d'onde)",
        "make the layer's mesh finer, or lower FC if less matters",
        "affiner le maillage de la couche, ou baisser FC si moins importe",
        severity="warning",
    ),
    "footing-not-kept": Message(
        "the displacements have nothing at {node}, a node of the joints",
        "les déplacements n'ont rien à {node}, un noeud des joints",
        "MAILLAGE_SAUVE must hold the joints' mesh, or be left out",
        "MAILLAGE_SAUVE doit contenir le maillage des joints, ou être omis",
    ),
    "footing-no-variables": Message(
        "the ground of the macro-element yields: its internal variables are needed at each instant",
        "le sol du macro-élément plastifie : il faut ses variables internes à chaque instant",
        "the run must save VARIABLES_INTERNES with CONTRAINTES",
        "le calcul doit garder VARIABLES_INTERNES avec CONTRAINTES",
    ),
    "several-footings": Message(
        "the joints of the model are {count} footings",
        "les joints du modèle font {count} semelles",
        "give the model of one footing, and its parameters",
        "donner le modèle d'une seule semelle, et ses paramètres",
    ),
    "resumed": Message(
        "goes on behind step {step} of {steps}, t = {time:g}, where an earlier run was ended",
        "continue après le pas {step} sur {steps}, t = {time:g}, où un calcul précédent a fini",
        severity="warning",
    ),
    "resumed-elsewhere": Message(
        "the steps kept were calculated with {before}, what follows is with {now}: its last digits "
        "are not those of an undisturbed run",
        "les pas gardés ont été calculés avec {before}, la suite l'est avec {now} : ses derniers "
        "chiffres ne sont pas ceux d'un calcul sans interruption",
        severity="warning",
    ),
    "given": Message(
        "was done by an earlier run: its {steps} {steps:step|steps} are given back as they were",
        "a été fait par un calcul précédent : {steps:son pas est rendu tel quel|ses {steps} pas "
        "sont rendus tels quels}",
        severity="warning",
    ),
    "checkpoint-left": Message(
        "step {step} of {steps}, t = {time:g}, is kept in '{folder}'",
        "le pas {step} sur {steps}, t = {time:g}, est gardé dans '{folder}'",
        "the same command with --resume goes on from there",
        "la même commande avec --resume continue de là",
        severity="warning",
    ),
    "nothing-kept": Message(
        "'REPRISE' keeps nothing here: runs of a sweep, or of no deck, are not gone on with",
        "'REPRISE' ne garde rien ici : un calcul d'un balayage, ou sans jeu de données, n'est pas "
        "repris",
        severity="warning",
    ),
    "not-kept": Message(
        "'REPRISE' cannot keep a calculation with '{index}': {reason}",
        "'REPRISE' ne peut pas garder un calcul avec '{index}' : {reason}",
        "leave one of the two",
        "ôter l'un des deux",
    ),
    "not-kept-procedure": Message(
        "what the script's procedure remembers from step to step is not known",
        "ce que la procédure du script retient d'un pas à l'autre n'est pas connu",
    ),
    "not-kept-reduction": Message(
        "its results come at the end, when the error of the basis is known",
        "ses résultats viennent à la fin, quand l'erreur de la base est connue",
    ),
    "not-kept-path": Message(
        "steps along a path have no times that are known before",
        "les pas le long d'un chemin n'ont pas de temps connus d'avance",
    ),
    "not-kept-frequencies": Message(
        "frequencies are no steps, each is found by itself",
        "les fréquences ne sont pas des pas, chacune est trouvée seule",
    ),
    "steps-of-reprise": Message(
        "'REPRISE' . 'PAS' is {steps}",
        "'REPRISE' . 'PAS' vaut {steps}",
        "give the steps from one checkpoint to the next, 1 or more",
        "donner le nombre de pas d'un point de reprise au suivant, 1 ou plus",
    ),
    "minutes-of-reprise": Message(
        "'REPRISE' . 'MINUTES' is {minutes:g}",
        "'REPRISE' . 'MINUTES' vaut {minutes:g}",
        "give the minutes from one checkpoint to the next, more than 0",
        "donner les minutes d'un point de reprise au suivant, plus de 0",
    ),
    "checkpoint-of-files": Message(
        "the checkpoints in '{folder}' belong to a run that read other files: {files} "
        "{files:has|have} changed, or {files:is|are} read no more",
        "les points de reprise de '{folder}' viennent d'un calcul qui a lu d'autres fichiers : "
        "{files} {files:a|ont} changé, ou {files:n'est plus lu|ne sont plus lus}",
        "put them back as they were, or run without --resume",
        "les remettre tels qu'ils étaient, ou calculer sans --resume",
    ),
    "checkpoint-of-call": Message(
        "the checkpoint of calculation {number} in '{folder}' is that of another one "
        "({procedure}): the deck does not calculate what it did then (a date or time that it "
        "reads?)",
        "le point de reprise du calcul {number} dans '{folder}' est celui d'un autre "
        "({procedure}) : le jeu ne calcule plus ce qu'il calculait (une date ou une heure qu'il "
        "lit ?)",
        "run without --resume",
        "calculer sans --resume",
    ),
    "checkpoint-of-report": Message(
        "the run that left '{folder}' was made {reported:?with|without} --report",
        "le calcul qui a laissé '{folder}' a été fait {reported:?avec|sans} --report",
        "go on in the same way: --resume {reported:?--report|without --report}",
        "continuer de la même façon : --resume {reported:?--report|sans --report}",
    ),
    "charmeca-gives-a-table": Message(
        "the procedure CHARMECA must give one TABLE",
        "la procédure CHARMECA doit rendre une TABLE",
        "TCHAR = TABL ; TCHAR . 'ADDI_FNL' = ... ; FINP TCHAR ;",
        "TCHAR = TABL ; TCHAR . 'ADDI_FNL' = ... ; FINP TCHAR ;",
    ),
    "reduction-or-charmeca": Message(
        "'REDUCTION' and 'CHARMECA' exclude each other",
        "'REDUCTION' et 'CHARMECA' s'excluent",
        "leave one",
        "ôter l'un des deux",
    ),
    "reduction-or-newton": Message(
        "'REDUCTION' and 'NEWTON_COMPLET' choose two methods",
        "'REDUCTION' et 'NEWTON_COMPLET' choisissent deux méthodes",
        "give one",
        "n'en donner qu'un",
    ),
    "tolerance-of-reduction": Message(
        "'REDUCTION' is {tolerance:g}",
        "'REDUCTION' vaut {tolerance:g}",
        "a relative error, such as 1.E-6",
        "une erreur relative, telle que 1.E-6",
    ),
    "reduction-not-used": Message(
        "no reduced model was used: {refused}",
        "aucun modèle réduit n'a servi : {refused}",
        "the whole model was run, exactly",
        "le modèle complet a été calculé, exactement",
        severity="warning",
    ),
    "instants-must-increase": Message(
        "'INST' holds instants that increase from 'DEBU' on",
        "'INST' contient des instants croissants à partir de 'DEBU'",
        "one or more",
        "un ou plus",
    ),
    "frequency-not-positive": Message(
        "'FREQ' is {frequency:g}",
        "'FREQ' vaut {frequency:g}",
        "a cut-off frequency > 0 (Hz)",
        "une fréquence de coupure > 0 (Hz)",
    ),
    "too-many-steps": Message(
        "'FREQ' is {frequency:g}: more than {most_steps:g} steps",
        "'FREQ' vaut {frequency:g} : plus de {most_steps:g} pas",
        "dt = 1/(4 FREQ)",
        "dt = 1/(4 FREQ)",
    ),
    "results-stay-in-memory": Message(
        "'ECON' asks to keep results on disk: they stay in memory",
        "'ECON' demande de garder les résultats sur disque : ils restent en mémoire",
        "PAS_SAUVES and MAILLAGE_SAUVE make them smaller",
        "PAS_SAUVES et MAILLAGE_SAUVE les réduisent",
        severity="warning",
    ),
    "steps-not-written": Message(
        "'SAUV' asks to write each step to the file of OPTI SAUV: results stay in memory",
        "'SAUV' demande d'écrire chaque pas dans le fichier d'OPTI SAUV : les résultats "
        "restent en mémoire",
        "SAUV the table behind DYNAMIC, or use the VTK or CSV entries",
        "sauvez la table par SAUV après DYNAMIC, ou prenez les entrées VTK ou CSV",
        severity="warning",
    ),
    "reduction-of-plastic-bodies": Message(
        "'REDUCTION' needs linear bodies",
        "'REDUCTION' demande des corps linéaires",
        "MODELE has plastic ones",
        "MODELE en a de plastiques",
    ),
    "equal-steps-wanted": Message(
        "the acceleration GAMMAO needs equal steps of time",
        "l'accélération GAMMAO demande des pas de temps égaux",
        "IPOL it first",
        "interpolez-la d'abord par IPOL",
    ),
    "no-relations": Message(
        "'RELATIONS_SAUVEES' . '{name}' has no relations",
        "'RELATIONS_SAUVEES' . '{name}' n'a aucune relation",
        "a BLOQ, RELA or SYMT, as it stands in 'RIGI'",
        "un BLOQ, RELA ou SYMT, tel qu'il est dans 'RIGI'",
    ),
    "relations-not-in-stiffness": Message(
        "'RIGI' has not {n} {n:relation|relations} of 'RELATIONS_SAUVEES' . '{name}'",
        "'RIGI' n'a pas {n} {n:relation|relations} de 'RELATIONS_SAUVEES' . '{name}'",
        "give the very object that 'RIGI' was made with: each BLOQ or RELA is one of its own",
        "donner l'objet même dont 'RIGI' est fait : chaque BLOQ ou RELA en est un à part",
    ),
    "table-without-mesh": Message(
        "'MAILLAGE_VTK' is a TABLE without MAILLAGE",
        "'MAILLAGE_VTK' est une TABLE sans MAILLAGE",
    ),
    "left-for-good": Message(
        "all joints are open since t = {time:.4g} s at the latest, and open further to the end "
        "({least:.3g} m at least): the structure leaves the ground for good",
        "tous les joints sont ouverts depuis t = {time:.4g} s au plus tard, et s'ouvrent encore à "
        "la fin (d'au moins {least:.3g} m) : la structure quitte le sol pour de bon",
        "does the weight press it down (MASS times -9.81 along 'UY', or 'UZ' in space)?",
        "le poids la presse-t-il (MASS fois -9.81 selon 'UY', ou 'UZ' dans l'espace) ?",
        severity="warning",
    ),
    "footing-overloaded": Message(
        "at the start the loads press with {pressing:.4g} N on the footing at node {node}, whose "
        "ground bears {capacity:.4g} N: it sinks",
        "au départ le chargement presse de {pressing:.4g} N la fondation au noeud {node}, dont le "
        "sol supporte {capacity:.4g} N : elle s'enfonce",
        "check the weight, the size of the footing, and the strength COHE (or QULT)",
        "vérifiez le poids, la taille de la fondation et la résistance COHE (ou QULT)",
        severity="warning",
    ),
    "joints-out-of-proportion": Message(
        "the joints are {stiffer:?{stiffer:.1e} times as stiff as|{softer:.1e} times softer "
        "than} the "
        "bodies at the same nodes: digits are lost",
        "les joints sont {stiffer:?{stiffer:.1e} fois plus raides|{softer:.1e} fois plus souples} "
        "que les corps aux mêmes noeuds : des chiffres se perdent",
        "KN and KS are in Pa/m (N/m for JOI1); check their units",
        "KN et KS sont en Pa/m (N/m pour JOI1) ; vérifiez leurs unités",
        severity="warning",
    ),
    "badly-conditioned": Message(
        "the condition number of the stiffness with closed joints is {number:.0e}: {digits} "
        "of 16 digits are left; with joints as stiff as the bodies at their nodes it is "
        "{balanced:.0e}",
        "le conditionnement de la raideur, joints fermés, vaut {number:.0e} : il reste "
        "{digits} chiffres sur 16 ; avec des joints aussi raides que les corps à leurs "
        "noeuds il vaut {balanced:.0e}",
        "KN and KS are in Pa/m (N/m for JOI1), here KN = {kn:.3g}: check their units; "
        "{wanted_kn:.1e} is as stiff as the bodies",
        "KN et KS sont en Pa/m (N/m pour JOI1), ici KN = {kn:.3g} : vérifiez leurs unités ; "
        "{wanted_kn:.1e} est aussi raide que les corps",
        severity="warning",
    ),
    "no-mass": Message(
        "nothing has mass: the motion is a series of equilibria under the loads of each time",
        "rien n'a de masse : le mouvement est une suite d'équilibres sous le chargement de chaque "
        "instant",
        "give TAB1 . 'MASS' = MASS MODL1 MAT1 ; (MAT1 with RHO), or let PASAPAS find equilibria",
        "donnez TAB1 . 'MASS' = MASS MODL1 MAT1 ; (MAT1 avec RHO), ou laissez PASAPAS trouver les "
        "équilibres",
        severity="warning",
    ),
    "body-without-mass": Message(
        "the body at node {node} has no mass and only joints hold it: it follows its loads "
        "at once, and is lost where all its joints open"
        "{others:?; so {others:does|do} {others} {others:other|others}}",
        "le corps au noeud {node} n'a pas de masse et n'est tenu que par des joints : il "
        "suit aussitôt son chargement, et se perd quand tous ses joints s'ouvrent"
        "{others:? ; de même {others} {others:autre|autres}}",
        "give its MASS{others:?, or hold such bodies: BLOQ, RELA}",
        "donnez sa masse (MASS){others:?, ou tenez de tels corps : BLOQ, RELA}",
        severity="warning",
    ),
    "motion-elsewhere": Message(
        "'{index}' moves what no matrix has, and that is not seen: {lost}{more:?, {more} more}",
        "'{index}' déplace ce qu'aucune matrice n'a, et que le calcul ne voit pas : {lost}"
        "{more:?, {more} autres}",
        "the unknowns are {known}, in capital letters; a point written again is a new node: use "
        "the "
        "names of the mesh",
        "les inconnues sont {known}, en majuscules ; un point récrit est un nouveau noeud : "
        "reprenez "
        "les noms du maillage",
        severity="warning",
    ),
    "penalty-wants-coefficient": Message(
        "'CONTACT' = 'PENALITE' needs 'COEFFICIENT'",
        "'CONTACT' = 'PENALITE' demande 'COEFFICIENT'",
        "a stiffness, N/m",
        "une raideur, N/m",
    ),
    "no-corrected-velocities": Message(
        "'VITEUNIL' corrects velocities of the average acceleration only",
        "'VITEUNIL' ne corrige que les vitesses de l'accélération moyenne",
        "leave ALPHA_F, RHO_INF, BETA and GAMMA, or VITEUNIL = FAUX",
        "retirez ALPHA_F, RHO_INF, BETA et GAMMA, ou VITEUNIL = FAUX",
    ),
    "correction-without-effect": Message(
        "'VITEUNIL' has no effect: the conserving step keeps the energy of impacts by itself",
        "'VITEUNIL' est sans effet : le pas conservatif garde de lui-même l'énergie des chocs",
        "VITEUNIL = FAUX",
        "VITEUNIL = FAUX",
        severity="warning",
    ),
    "impacts-change-energy": Message(
        "impacts on 'MINI' or 'MAXI' relations changed the energy by {share:.2g} %: the motion "
        "after them depends on the step",
        "les chocs sur les relations 'MINI' ou 'MAXI' ont changé l'énergie de {share:.2g} % : le "
        "mouvement qui les suit dépend du pas",
        "{uncorrected:?'VITEUNIL' left to its default, }shorter steps, 'CONSERVATIF' = VRAI, or "
        "joints 'JOINT_SDM' in place of the relations",
        "{uncorrected:?'VITEUNIL' par défaut, }des pas plus courts, 'CONSERVATIF' = VRAI, ou des "
        "joints 'JOINT_SDM' à la place des relations",
        severity="warning",
    ),
    "beyond-curve": Message(
        "{share:.2g} % of the points of {law} were strained beyond the last point of the curve of "
        "G/Gmax: their shear stress stayed there, as if the soil flowed",
        "{share:.2g} % des points de {law} ont été déformés au-delà du dernier point de la courbe "
        "G/Gmax : leur contrainte de cisaillement y est restée, comme si le sol s'écoulait",
        "give the curve 'GGAM' up to the strains that are reached",
        "donnez la courbe 'GGAM' jusqu'aux déformations atteintes",
        severity="warning",
    ),
    "impacts-uncorrected": Message(
        "impacts on 'MINI' or 'MAXI' relations brought {share:.2g} % of energy: this scheme does "
        "not correct velocities",
        "les chocs sur les relations 'MINI' ou 'MAXI' ont apporté {share:.2g} % d'énergie : ce "
        "schéma ne corrige pas les vitesses",
        "the average acceleration does: leave ALPHA_F, RHO_INF, BETA and GAMMA; or "
        "'CONSERVATIF' = VRAI",
        "l'accélération moyenne le fait : retirez ALPHA_F, RHO_INF, BETA et GAMMA ; ou "
        "'CONSERVATIF' = VRAI",
        severity="warning",
    ),
    "conserving-or-persistent": Message(
        "'CONTACT_PERSISTANT' takes energy, 'CONSERVATIF' keeps it: they exclude each other",
        "'CONTACT_PERSISTANT' prend de l'énergie, 'CONSERVATIF' la garde : ils s'excluent",
        "leave one",
        "ôter l'un des deux",
    ),
    "parquet-needs-pyarrow": Message(
        "{name} needs pyarrow, which is not installed",
        "{name} demande pyarrow, qui n'est pas installé",
        "pip install 'ssilang[sweep]', or a name that ends with .csv",
        "pip install 'ssilang[sweep]', ou un nom qui finit par .csv",
    ),
    "two-schemes": Message(
        "'{given}' and '{given_2}' choose two schemes",
        "'{given}' et '{given_2}' choisissent deux schémas",
        "give one",
        "n'en donner qu'un",
    ),
    "conserving-and-scheme": Message(
        "'CONSERVATIF' and '{given}' choose two schemes",
        "'CONSERVATIF' et '{given}' choisissent deux schémas",
        "give one",
        "n'en donner qu'un",
    ),
    "contact-not-resolved": Message(
        "the step {dt:.3g} s does not resolve contact, whose half period is {contact_time:.3g} s "
        "with the mass attached to the joints",
        "le pas {dt:.3g} s ne résout pas le contact, dont la demi-période est {contact_time:.3g} s "
        "avec la masse attachée aux joints",
        "{conserving:?energy is kept; dt <= T_c/30 = {wanted_dt:.3g} s follows the contact too"
        "|dt <= T_c/30 = {wanted_dt:.3g} s keeps energy; or CONSERVATIF, a softer joint}",
        "{conserving:?l'énergie est gardée ; dt <= T_c/30 = {wanted_dt:.3g} s suit aussi le contact"
        "|dt <= T_c/30 = {wanted_dt:.3g} s garde l'énergie ; ou CONSERVATIF, un joint plus souple}",
        severity="warning",
    ),
    "energies-out-of-balance": Message(
        "{procedure}{number:?, calculation {number} of this run}: energies are out of balance by "
        "{energy} % of the largest one{amount:? ({amount})}",
        "{procedure}{number:?, calcul {number} de ce jeu} : les énergies ont un écart de {energy} "
        "% de la plus grande{amount:? ({amount})}",
        "likely: {causes:;}\nwhen it happens: TAB1 . 'ENERGIES' . 'ECART', beside 'TEMPS'",
        "sans doute : {causes:;}\nquand cela arrive : TAB1 . 'ENERGIES' . 'ECART', à côté de "
        "'TEMPS'",
        severity="warning",
    ),
    "imbalance-joint": Message(
        "a step too long for the joint (T_c/30 keeps energy, or CONSERVATIF, or a softer joint)",
        "un pas trop long pour le joint (T_c/30 garde l'énergie, ou CONSERVATIF, ou un joint plus "
        "souple)",
    ),
    "imbalance-stops": Message(
        "a step too long for what strikes (a shorter one, or CONSERVATIF)",
        "un pas trop long pour les chocs (un pas plus court, ou CONSERVATIF)",
    ),
    "imbalance-velocities": Message(
        "velocities corrected at impacts, which takes energy (VITEUNIL, CONTACT_PERSISTANT)",
        "des vitesses corrigées aux chocs, ce qui prend de l'énergie (VITEUNIL, "
        "CONTACT_PERSISTANT)",
    ),
    "imbalance-scheme": Message(
        "the scheme's own damping (ALPHA_F, RHO_INF, GAMMA), which is in no account",
        "l'amortissement propre au schéma (ALPHA_F, RHO_INF, GAMMA), qui n'est compté nulle part",
    ),
    "imbalance-added": Message(
        "what CHARMECA adds to matrices and loads, whose energy is in no account",
        "ce que CHARMECA ajoute aux matrices et aux charges, dont l'énergie n'est comptée nulle "
        "part",
    ),
    "imbalance-step": Message(
        "a step too long for the motion", "un pas trop long pour le mouvement"
    ),
    "imbalance-load-steps": Message(
        "the work of loads is taken along straight lines from one load step to the next",
        "le travail des charges est pris en ligne droite d'un pas de charge au suivant",
    ),
    "compiling": Message(
        "compiling the time loop, once on this machine (5 to 40 s)",
        "compilation de la boucle en temps, une fois sur cette machine (5 à 40 s)",
    ),
    "nothing-moves": Message(
        "nothing sets anything in motion: no load, no initial displacement, no initial velocity",
        "rien ne met quoi que ce soit en mouvement : ni chargement, ni déplacement ou vitesse "
        "initiaux",
        "TAB1 . 'CHAR', 'DEPL' or 'VITE'",
        "TAB1 . 'CHAR', 'DEPL' ou 'VITE'",
        severity="warning",
    ),
    "motion-against-supports": Message(
        "'{index}' does not obey {count} {count:condition|conditions} of 'RIGI' (BLOQ, RELA): "
        "{moved:?the first step jumps to what is imposed|these velocities are taken as nought}",
        "'{index}' ne respecte pas {count} {count:condition|conditions} de 'RIGI' (BLOQ, RELA) : "
        "{moved:?le premier pas saute à ce qui est imposé|ces vitesses sont prises nulles}",
        "give the field nought there, or leave the support out: what is held does not move",
        "donnez un champ nul à cet endroit, ou ôtez l'appui : ce qui est tenu ne bouge pas",
        severity="warning",
    ),
    "imposed-elsewhere": Message(
        "the load {name} imposes {count} {count:value|values} of conditions that 'RIGI' does not "
        "have: they move nothing",
        "le chargement {name} impose {count} {count:valeur|valeurs} de conditions que 'RIGI' n'a "
        "pas : elles ne déplacent rien",
        "BLO1 = BLOQ ... ; TAB1 . 'RIGI' = ... ET BLO1 ; and DEPI BLO1 for that same BLO1",
        "BLO1 = BLOQ ... ; TAB1 . 'RIGI' = ... ET BLO1 ; et DEPI BLO1 pour ce même BLO1",
        severity="warning",
    ),
    "nothing-presses": Message(
        "nothing presses the body at node {node} on what it stands on (along {axis}): without "
        "weight "
        "it carries no shear, and leaves at the first pull",
        "rien ne presse le corps du noeud {node} sur ce qui le porte (suivant {axis}) : sans "
        "poids il "
        "ne prend pas de cisaillement, et part à la première traction",
        "add its weight to 'CHAR', a constant load (GRAV, or FORC), and begin from the "
        "displacements "
        "that it makes ('DEPL')",
        "ajoutez son poids à 'CHAR', chargement constant (GRAV, ou FORC), et partez des "
        "déplacements "
        "qu'il donne ('DEPL')",
        severity="warning",
    ),
    "slides-away": Message(
        "nothing holds the body at node {node} along {axis}, and loads push it that way: it "
        "moves off",
        "rien ne tient le corps du noeud {node} suivant {axis}, et les chargements l'y poussent "
        ": il "
        "s'en va",
        "BLOQ '{axis}' of its support, a spring (APPU, RIGI), or loads without that component",
        "BLOQ '{axis}' de son appui, un ressort (APPU, RIGI), ou des chargements sans cette "
        "composante",
        severity="warning",
    ),
    "turns-away": Message(
        "the supports leave a motion free (a turn about them), and loads drive it: the model "
        "moves off",
        "les appuis laissent un mouvement libre (une rotation autour d'eux), et les chargements "
        "l'entraînent : le modèle s'en va",
        "RESO of the same matrix and load names the motion; hold a second point (BLOQ), or a "
        "rotation",
        "RESO de la même matrice et du même chargement nomme le mouvement ; tenez un second point "
        "(BLOQ), ou une rotation",
        severity="warning",
    ),
    "step-over-period": Message(
        "the step of {dt:.3g} is longer than the period of {period:.3g} of what the loads set in "
        "motion",
        "le pas de {dt:.3g} dépasse la période de {period:.3g} de ce que les chargements "
        "mettent en "
        "mouvement",
        "a step of {wanted:.3g} in TEMPS_CALCULES, {steps} for a period",
        "un pas de {wanted:.3g} dans TEMPS_CALCULES, {steps} par période",
        severity="warning",
    ),
    "overdamped": Message(
        "what the loads set in motion is damped {ratio:.3g} times beyond critical: it creeps, and "
        "does not swing",
        "ce que les chargements mettent en mouvement est amorti {ratio:.3g} fois plus que le "
        "critique : cela rampe, sans osciller",
        "with 'AMOR' = a M + b K the ratio is a / (2 w) + b w / 2 at w = 2 pi f: 5 % are 0.05, "
        "and b "
        "is in seconds",
        "avec 'AMOR' = a M + b K le taux vaut a / (2 w) + b w / 2 à w = 2 pi f : 5 % s'écrivent "
        "0.05, et b est en secondes",
        severity="warning",
    ),
    "driven-by-dashpots": Message(
        "the damping of what the loads set in motion is negative ({ratio:.3g} of the critical "
        "one): "
        "it grows without end",
        "l'amortissement de ce que les chargements mettent en mouvement est négatif "
        "({ratio:.3g} du "
        "critique) : cela croît sans fin",
        "'AMOR' = a M + b K with a and b of no sign, dashpots too",
        "'AMOR' = a M + b K avec a et b sans signe, les amortisseurs aussi",
        severity="warning",
    ),
    "masses-alone": Message(
        "{count} {count:node has a mass that hangs|nodes have masses that hang} on nothing (node "
        "{node}): no stiffness, condition or load",
        "{count} {count:noeud a une masse qui ne tient|noeuds ont des masses qui ne tiennent} à "
        "rien "
        "(noeud {node}) : ni raideur, ni condition, ni chargement",
        "a point written again is a new node: put the mass on the body's own, by its name or POIN",
        "un point récrit est un nouveau noeud : mettez la masse sur celui du corps, par son nom ou "
        "POIN",
        severity="warning",
    ),
    "load-twice": Message(
        "the load {name} stands twice in 'CHAR': it acts doubled",
        "le chargement {name} est deux fois dans 'CHAR' : il agit en double",
        "join each load once; FLOT1 * CHPO1 doubles a field on purpose",
        "réunissez chaque chargement une fois ; FLOT1 * CHPO1 double exprès un champ",
        severity="warning",
    ),
    "load-outside": Message(
        "the curve of the loads {name} goes from {begin:.6g} to {end:.6g}, the calculation from "
        "{first:.6g} to {last:.6g}: it is a constant there",
        "l'évolution du chargement {name} va de {begin:.6g} à {end:.6g}, le calcul de "
        "{first:.6g} à "
        "{last:.6g} : elle y est constante",
        "are the times of the two in the same unit, from the same origin?",
        "les temps des deux sont-ils dans la même unité, depuis la même origine ?",
        severity="warning",
    ),
    "load-begins": Message(
        "the curve of the loads {name} begins at {begin:.6g} with {value:.4g}, which counts from "
        "{first:.6g} on",
        "l'évolution du chargement {name} commence à {begin:.6g} par {value:.4g}, qui compte dès "
        "{first:.6g}",
        "give the curve from the first instant of the calculation on; are its times in other "
        "units?",
        "donnez l'évolution dès le premier instant du calcul ; ses temps sont-ils dans une autre "
        "unité ?",
        severity="warning",
    ),
    "load-missed": Message(
        "the load {name} changes between two instants of the calculation: {value:.4g} at "
        "{time:.6g} "
        "is seen as {seen:.4g}",
        "le chargement {name} change entre deux instants du calcul : {value:.4g} à {time:.6g} "
        "est vu "
        "comme {seen:.4g}",
        "put the instants of the curve into TEMPS_CALCULES, or steps that are shorter",
        "mettez les instants de l'évolution dans TEMPS_CALCULES, ou des pas plus courts",
        severity="warning",
    ),
    "load-ends": Message(
        "the curve of the loads {name} ends at {end:.6g} with {value:.4g}, which is kept until "
        "{last:.6g}",
        "l'évolution du chargement {name} finit à {end:.6g} par {value:.4g}, gardé jusqu'à "
        "{last:.6g}",
        "give the curve to the end of the calculation; are its times in other units?",
        "donnez l'évolution jusqu'à la fin du calcul ; ses temps sont-ils dans une autre unité ?",
        severity="warning",
    ),
}

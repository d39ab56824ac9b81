"""What ssilang/kernel/plasticity refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "loop-kept-factor": Message(
        "a factor kept over many steps, what yields beyond it iterated on as a load",
        "un facteur gardé pendant de nombreux pas, ce qui plastifie au-delà étant itéré comme "
        "une charge",
    ),
    "load-needs-field-temperatures": Message(
        "the load T needs a field of temperatures",
        "le chargement T demande un champ de températures",
    ),
    "beam-shrunk-nothing": Message(
        "a beam is shrunk to nothing",
        "une poutre est réduite à rien",
    ),
    "fibres-no-area-no": Message(
        "the fibres have no area or no YOUN: the section carries no normal force",
        "les fibres n'ont ni aire ni YOUN : la section ne porte pas d'effort normal",
    ),
    "plastic-bodies-stepped-newmark": Message(
        "plastic bodies are stepped by Newmark, HHT or generalised alpha",
        "les corps plastiques avancent par Newmark, HHT ou alpha généralisé",
        "leave CONSERVATIF and PAS_ADAPTE",
        "ôtez CONSERVATIF et PAS_ADAPTE",
    ),
    "bar-shrunk-nothing": Message(
        "a bar is shrunk to nothing",
        "une barre est réduite à rien",
    ),
    "epai-must": Message(
        "EPAI = {h_min:g}: it must be > 0",
        "EPAI = {h_min:g} : il faut une valeur > 0",
    ),
    "plastic-laws-not-exist": Message(
        "plastic laws do not exist in mode {value}",
        "les lois plastiques n'existent pas en mode {value}",
    ),
    "youn-plastic-law-needs": Message(
        "YOUN = {youn_min:g}: a plastic law needs YOUN > 0",
        "YOUN = {youn_min:g} : une loi plastique demande YOUN > 0",
    ),
    "section-not-find-normal": Message(
        "the section does not find the normal force {force:g} of value {row}: {rest:+.3g} is "
        "missing after {turns} {turns:iteration|iterations}",
        "la section ne trouve pas l'effort normal {force:g} de la valeur {row} : il manque "
        "{rest:+.3g} après {turns} {turns:itération|itérations}",
        "is the force below the strength of the section?",
        "l'effort est-il inférieur à la résistance de la section ?",
    ),
    "load-step-time-no": Message(
        "load step {k}, time {time:g}: no equilibrium found (residual {residual:.1e} after "
        "{n_residuals} {n_residuals:iteration|iterations}, step cut {halvings} "
        "{halvings:time|times})",
        "pas de charge {k}, temps {time:g} : pas d'équilibre trouvé (résidu {residual:.1e} "
        "après {n_residuals} {n_residuals:itération|itérations}, {halvings} "
        "{halvings:division|divisions} du pas)",
        "the load may exceed what the bodies can carry: impose displacements to go on",
        "le chargement dépasse peut-être ce que les corps peuvent porter : imposez des "
        "déplacements pour continuer",
    ),
    "step-time-no-equilibrium": Message(
        "step {k}, time {times:g}: no equilibrium found (residual {residual:.1e} after "
        "{turns} {turns:iteration|iterations})",
        "pas {k}, temps {times:g} : pas d'équilibre trouvé (résidu {residual:.1e} après "
        "{turns} {turns:itération|itérations})",
        "smaller steps",
        "prenez des pas plus petits",
    ),
    "step-time-no-point": Message(
        "step {k}, time {times:g}: no point of the path found, step cut {halvings} "
        "{halvings:time|times}",
        "pas {k}, temps {times:g} : aucun point du chemin trouvé après {halvings} "
        "{halvings:division|divisions} du pas",
        "a smaller increment of the control, or another control; supports "
        "(BLOCAGES_MECANIQUES) that hold the structure",
        "un incrément de pilotage plus petit, ou un autre pilotage ; des appuis "
        "(BLOCAGES_MECANIQUES) qui tiennent la structure",
    ),
    "parameter-curve": Message(
        "parameter {name} is a curve",
        "le paramètre {name} est une évolution",
    ),
    "unilateral-relations-mini-maxi": Message(
        "unilateral relations do not go with controlled loads",
        "des relations unilatérales ne vont pas avec un chargement piloté",
        "describe contact by joints (JOINT_SDM)",
        "décrivez le contact par des joints (JOINT_SDM)",
    ),
    "time-no-solution-found": Message(
        "time {t:g}: no solution found at the shortest step",
        "temps {t:g} : pas de solution trouvée au plus petit pas",
    ),
    "finite-yielding-not-built": Message(
        "yielding in large displacements is built for plastic laws of continuous elements, not "
        "for {element}",
        "la plastification en grands déplacements est construite pour les lois plastiques des "
        "massifs, pas pour {element}",
    ),
    "finite-displacements-not-built": Message(
        "finite displacements are not built for {element} in this hypothesis",
        "les grands déplacements ne sont pas programmés pour {element} dans cette hypothèse",
    ),
    "time-no-point-path": Message(
        "time {now:g}: no point of the path found, step cut {halvings} {halvings:time|times}",
        "temps {now:g} : aucun point du chemin trouvé après {halvings} "
        "{halvings:division|divisions} du pas",
    ),
}

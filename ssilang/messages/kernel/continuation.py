"""What ssilang/kernel/continuation refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "matrices-no-unknowns": Message(
        "the matrices have no unknowns",
        "les matrices n'ont pas d'inconnues",
    ),
    "no-first-solution-found": Message(
        "no first solution found at {t:g} (residual {size:.1e})",
        "aucune première solution trouvée en {t:g} (résidu {size:.1e})",
        "another first value of the parameter, or a guess nearer to the solution",
        "une autre première valeur du paramètre, ou un départ plus proche de la solution",
    ),
    "tangent-branch-not-made": Message(
        "the tangent of the branch at {t:g} is not made of finite numbers",
        "la tangente à la branche en {t:g} n'est pas faite de nombres finis",
        "forces and their derivatives that are finite for all displacements",
        "forces et dérivées doivent être finies pour tout déplacement",
    ),
    "link-changes-time-frequency": Message(
        "link {timed} changes in time by a frequency of its own: harmonic balance wants "
        "forces of the motion alone",
        "la liaison {timed} varie dans le temps par une fréquence propre : l'équilibrage "
        "harmonique veut des forces du seul mouvement",
    ),
    "harmonic-balance-takes-unknowns": Message(
        "harmonic balance takes {most} {most:unknown|unknowns} a node, found {pairs:words}",
        "l'équilibrage harmonique prend {most} {most:inconnue|inconnues} par noeud, trouvé "
        "{pairs:words}",
    ),
    "harmonic-balance-takes-plain": Message(
        "harmonic balance takes plain supports and relations",
        "l'équilibrage harmonique prend des blocages et relations ordinaires",
    ),
    "link-remembers-past-plastic": Message(
        "link {past} remembers its past (plastic, or sticking by springs): harmonic balance "
        "wants forces of the present motion",
        "la liaison {past} se souvient du passé (plastique, ou adhérente par ressorts) : "
        "l'équilibrage harmonique veut des forces du mouvement présent",
    ),
}

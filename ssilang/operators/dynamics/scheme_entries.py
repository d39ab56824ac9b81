"""Entries that choose the time scheme and the treatment of contact."""

from collections.abc import Callable
from dataclasses import replace

from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark
from ssilang.operators.tables.entries import Entries

SCHEME_ENTRIES = ("ALPHA_F", "RHO_INF", "BETA", "GAMMA")
NORMS = {True: "MASSE", False: "FAUX", "INERTIE": "MASSE", "RAIDEUR": "RIGIDITE"}
"""Norm of the kernel in which VITEUNIL corrects velocities."""


def contact_options(entries: Entries, dynamic: bool = True) -> ContactOptions:
    """How unilateral relations are solved, and velocities corrected (VITEUNIL).

    VRAI, the default of the average acceleration, corrects in the norm of the mass.
    """
    method = str(entries.get("CONTACT"))
    coefficient = entries.get("COEFFICIENT")
    if method == "PENALITE" and coefficient is None:
        raise entries.error("operators.dynamics.penalty-wants-coefficient")
    if not dynamic:
        return ContactOptions(method, coefficient)
    words = entries.flag("CONTACT_PERSISTANT"), entries.flag("MASSE_MODIFIEE")
    return ContactOptions(method, coefficient, _correction(entries, method), *words)


def _correction(entries: Entries, method: str) -> str:
    scheme = scheme_of(entries)
    average = scheme.average_acceleration
    given = entries.get("VITEUNIL")
    if scheme.conserving:
        # The conserving step reflects velocities by itself.
        if given is not None and given is not False:
            entries.warn("operators.dynamics.correction-without-effect")
        if entries.flag("CONTACT_PERSISTANT"):
            raise entries.error("operators.dynamics.conserving-or-persistent")
        return "FAUX"
    if given is None:
        return "MASSE" if average and method != "PENALITE" else "FAUX"
    word = NORMS[given]
    if word != "FAUX" and not average:
        raise entries.error("operators.dynamics.no-corrected-velocities")
    return word


def scheme_of(entries: Entries) -> Scheme:
    """Time scheme by ALPHA_F, RHO_INF, or BETA and GAMMA; average acceleration by default."""
    return replace(_basic_scheme(entries), adaptive=entries.flag("PAS_ADAPTE"))


def _basic_scheme(entries: Entries) -> Scheme:
    given = [name for name in SCHEME_ENTRIES if entries.has(name)]
    if entries.flag("CONSERVATIF"):
        if given:
            raise entries.error("operators.dynamics.conserving-and-scheme", given=given[0])
        return Scheme(conserving=True)
    if len(given) > 1 and given != ["BETA", "GAMMA"]:
        raise entries.error("operators.dynamics.two-schemes", given=given[0], given_2=given[1])
    if not given:
        return Scheme()
    values = [float(entries.needed(name)) for name in given]
    makers: dict[str, Callable[[float], Scheme]] = {
        "ALPHA_F": hht,
        "RHO_INF": generalised_alpha,
        "BETA": lambda beta: newmark(beta, values[-1] if len(values) == 2 else 0.5),
        "GAMMA": lambda gamma: newmark((gamma + 0.5) ** 2 / 4, gamma),
    }
    with entries.about(given[-1] if values[-1] < 0.5 else given[0]):  # gamma, where it is to blame
        return makers[given[0]](values[0])

"""Entries that choose the time scheme and the treatment of contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from ssilang.kernel.contact.options import ContactOptions
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    pass

SCHEME_ENTRIES = ("ALPHA_F", "RHO_INF", "BETA", "GAMMA")
CONTACT_ENTRIES = (
    "CONSERVATIF",
    "PAS_ADAPTE",
    "CONTACT",
    "COEFFICIENT",
    "CONTACT_PERSISTANT",
    "MASSE_MODIFIEE",
)


def contact_options(entries: Entries, dynamic: bool = True) -> ContactOptions:
    """How unilateral relations are solved, and velocities corrected (VITEUNIL).

    VRAI, the default of the average acceleration, corrects in the norm of the mass.
    """
    methods = ("LAGRANGE", "PENALITE", "AUGMENTE", "UZAWA")
    method = str(entries.get("CONTACT", "MOT") or "LAGRANGE").upper().rstrip()
    if method not in methods:
        raise entries.bad(f"'CONTACT' is '{method}'", "one of " + ", ".join(methods))
    coefficient = entries.get("COEFFICIENT", "FLOTTANT")
    if method == "PENALITE" and coefficient is None:
        raise entries.bad("'CONTACT' = 'PENALITE' needs 'COEFFICIENT'", "a stiffness, N/m")
    if not dynamic:
        return ContactOptions(method, coefficient)
    return ContactOptions(
        method,
        coefficient,
        _correction(entries, method),
        entries.flag("CONTACT_PERSISTANT"),
        entries.flag("MASSE_MODIFIEE"),
    )


def _correction(entries: Entries, method: str) -> str:
    scheme = scheme_of(entries)
    average = scheme.average_acceleration
    given = entries.get("VITEUNIL", "LOGIQUE", "MOT")
    if scheme.conserving:
        return _no_correction(entries, given)
    if given is None:
        return "MASSE" if average and method != "PENALITE" else "FAUX"
    word = {True: "MASSE", False: "FAUX"}.get(given, str(given).upper().rstrip())
    if word not in ("FAUX", "MASSE", "RIGIDITE"):
        raise entries.bad(f"'VITEUNIL' is '{given}'", "VRAI, FAUX, 'MASSE' or 'RIGIDITE'")
    if word != "FAUX" and not average:
        raise entries.bad(
            "'VITEUNIL' corrects velocities of the average acceleration only",
            "leave ALPHA_F, RHO_INF, BETA and GAMMA, or VITEUNIL = FAUX",
        )
    return word


def _no_correction(entries: Entries, given: object) -> str:
    """The conserving step reflects velocities by itself."""
    if given is not None and given is not False and str(given).upper().rstrip() != "FAUX":
        entries.warn(
            "'VITEUNIL' has no effect: the conserving step keeps the energy of impacts by itself",
            "VITEUNIL = FAUX",
        )
    if entries.flag("CONTACT_PERSISTANT"):
        raise entries.bad(
            "'CONTACT_PERSISTANT' takes energy, 'CONSERVATIF' keeps it: they exclude each other",
            "leave one",
        )
    return "FAUX"


def scheme_of(entries: Entries) -> Scheme:
    """Time scheme by ALPHA_F, RHO_INF, or BETA and GAMMA; average acceleration by default."""
    return replace(_basic_scheme(entries), adaptive=entries.flag("PAS_ADAPTE"))


def _basic_scheme(entries: Entries) -> Scheme:
    given = [name for name in SCHEME_ENTRIES if entries.has(name)]
    if entries.flag("CONSERVATIF"):
        if given:
            raise entries.bad(f"'CONSERVATIF' and '{given[0]}' choose two schemes", "give one")
        return Scheme(conserving=True)
    if len(given) > 1 and given != ["BETA", "GAMMA"]:
        raise entries.bad(f"'{given[0]}' and '{given[1]}' choose two schemes", "give one")
    if not given:
        return Scheme()
    values = [float(entries.needed(name, "FLOTTANT")) for name in given]
    makers: dict[str, Callable[[float], Scheme]] = {
        "ALPHA_F": hht,
        "RHO_INF": generalised_alpha,
        "BETA": lambda beta: newmark(beta, values[-1] if len(values) == 2 else 0.5),
        "GAMMA": lambda gamma: newmark((gamma + 0.5) ** 2 / 4, gamma),
    }
    with entries.about(given[0]):
        return makers[given[0]](values[0])

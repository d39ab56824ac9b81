"""How unilateral relations are enforced: a script's choice, free of heavy imports."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ContactOptions:
    """How unilateral relations are enforced.

    Attributes
    ----------
    method : 'LAGRANGE', 'PENALITE', 'AUGMENTE' or 'UZAWA'
    coefficient : float or None
        Penalty or augmentation.
    correction : 'FAUX', 'MASSE' or 'RIGIDITE'
        Of velocities when a relation closes.
    persistent : bool
        Relative velocity of relations that stay closed set to zero.
    modified_mass : bool
        Mass taken off the contact unknowns.
    """

    method: str = "LAGRANGE"
    coefficient: float | None = None
    correction: str = "FAUX"
    persistent: bool = False
    modified_mass: bool = False

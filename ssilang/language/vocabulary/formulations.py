"""What a model is about: the first word of MODE."""

from __future__ import annotations

from ssilang.language.vocabulary.terms import Word

WORDS = (
    Word(
        "MECANIQUE",
        "Mechanics: displacements, strains and stresses of bodies, structures and joints",
        "Mécanique : déplacements, déformations et contraintes des corps, structures et joints",
    ),
    Word(
        "CONTACT",
        "Two sides of a mesh that must not go into each other, with or without friction",
        "Deux bords de maillage qui ne doivent pas se pénétrer, avec ou sans frottement",
    ),
    Word(
        "CHARGEMENT",
        "Sides that carry a load, a pressure: for the operators PRES and BSIG",
        "Bords qui portent un chargement, une pression : pour les opérateurs PRES et BSIG",
    ),
    Word(
        "LIAISON",
        "Links of modes that DYNE steps: shocks, friction, couplings (tables PASAPAS)",
        "Liaisons de modes que DYNE intègre : chocs, frottement, couplages (tables PASAPAS)",
    ),
)

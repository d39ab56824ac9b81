"""The laws that a model may name, as data: words, families of elements that have them."""

from collections.abc import Collection

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.catalog import BARS, BEAMS, SOLID_FAMILIES, THIN_SHELLS
from ssilang.kernel.interface.laws.law_table import LAWS
from ssilang.kernel.materials.plastic.laws import (
    CREEP_LAWS,
    DAMAGE_LAWS,
    PLASTIC_LAWS,
    plastic_law,
)

FORMULATIONS = ("MECANIQUE", "CHARGEMENT", "CONTACT", "LIAISON")
OTHER_FORMULATIONS = {
    "LIQUIDE": "fluids", "NAVIER_STOKES": "fluids", "EULER": "fluids",
    "POREUX": "porous", "DARCY": "porous", "THERMOHYDRIQUE": "porous",
    "THERMIQUE": "heat", "CONVECTION": "heat", "RAYONNEMENT": "heat", "CHANGEMENT_PHASE": "heat",
    "MAGNETODYNAMIQUE": "electromagnetism", "ELECTROSTATIQUE": "electromagnetism",
    "FISSURE": "fracture",
    "DIFFUSION": "chemistry", "METALLURGIE": "chemistry",
    "MELANGE": "mechanics", "FROTTEMENT": "mechanics", "CONTRAINTE": "mechanics",
}  # fmt: skip
"""Formulations that are not built, by their subject; what is not mechanics is out of scope."""

ELASTICITIES: dict[str, tuple[str, ...]] = {
    "ISOTROPE": (
        *SOLID_FAMILIES, *THIN_SHELLS, "thick", "solid shell", *BARS, *BEAMS, "joint", "fibre",
    ),
    "SECTION": ("timoshenko",),
    "ORTHOTROPE": (*SOLID_FAMILIES, *THIN_SHELLS, "joint"),
    "ANISOTROPE": (*SOLID_FAMILIES, "joint"),  # of joints, those of two points
    "UNIDIRECTIONNEL": (*SOLID_FAMILIES, "plate"),
    "ARMATURE": ("bar",),
    "MODAL": ("shape",),
    "STATIQUE": ("shape",),
}  # fmt: skip
"""Linear elasticities and the families of elements that have them."""

JOINT_WORDS = (
    *(name for name in LAWS if name != "ELASTIQUE"),
    "CISAILLEMENT_ELASTIQUE", "FROTTEMENT_SYMETRIQUE", "PLASTIQUE",
)  # fmt: skip
"""Further words of joints; `ssilang.kernel.interface.laws.point_laws` says what they mean."""

PLASTIC_WORDS = tuple(w for w in PLASTIC_LAWS if w not in ELASTICITIES)
"""Words that follow PLASTIQUE in a model of bodies (beside ISOTROPE)."""

SECTION_FAMILIES = (*THIN_SHELLS, *BEAMS)
"""Families whose sections yield as a whole; DKT also at points across the thickness."""
PLASTIC_FAMILIES = ("solid", "incompressible", *BARS, "fibre", "thick", *SECTION_FAMILIES)
"""Families of elements that have plastic laws."""

UNIAXIAL_LAWS = ("PARFAIT_UNI", "BETON_BAEL", "ACIER_UNI", "BETON_UNI")
"""Plastic laws of one stress: those of fibres of sections and of bars."""
UNIAXIAL_FAMILIES = ("fibre", "bar")
"""Families of elements that have them."""

CREEP_FAMILIES = ("solid", "incompressible", *BARS, "thick", *THIN_SHELLS)
"""Families of elements that creep, thin shells by the forces of their sections."""

DAMAGE_FAMILIES = ("solid", *BARS)
"""Families of elements that are damaged."""

OWN_LAWS = {
    "FLUAGE": (CREEP_LAWS, CREEP_FAMILIES), "ENDOMMAGEMENT": (DAMAGE_LAWS, DAMAGE_FAMILIES),
}  # fmt: skip
"""Words that name a law behind them, beside PLASTIQUE: the laws, who has them."""

FIBRE_LAWS = (*UNIAXIAL_LAWS, "PARFAIT", "ISOTROPE", "CINEMATIQUE")
"""Plastic laws of the fibres of sections."""

SECTION_LAWS = ("PARFAIT", "ISOTROPE", "CINEMATIQUE")
"""Plastic laws of sections as a whole, and of points across the thickness of shells."""

OTHER_LINKS = ("PROFIL_PROFIL", "PALIER_FLUIDE", "NEWMARK")
"""Links between modes that Cast3M has and that are not built."""

OTHER_BEHAVIOURS = (
    "NON_LINEAIRE", "NON_LOCAL", "HOMOGENEISE", "CAOUTCHOUC",
    # plasticity: of metals, concrete, pipes and global sections, of rock joints, of soils
    "CHABOCHE1", "CHABOCHE2", "GAUVAIN", "GURSON", "STEINBERG", "ZERILLI", "PRESTON", "HINTE",
    "BETON", "OTTOSEN", "OTTOVARI", "BETOCYCL", "DRUCKER_PRAGER_2", "ENDOMMAGEABLE", "GLOBAL",
    "TUYAU_FISSURE", "LINESPRING", "BILIN_MOMY", "BILIN_EFFX", "BILIN_EFFZ", "TAKEDA_MOMY",
    "TAKEMO_EFFZ", "BA1D", "ACIER_ANCRAGE", "INTIMP", "FRAGILE_UNI", "STRUT_UNI",
    "CISAIL_NL", "INFILL_UNI", "PARFAIT_ANCRAGE", "RICBET_UNI", "OUGLOVA", "LIAISON_ACBE",
    "ANCRAGE_ELIGEHAUSEN", "INTJOI", "AMADEI", "HUJEUX", "UBIQUITOUS",
    "MOHR_COULOMB", "MRS_LADE", "DP_SOL", "IWPR3D_SOL", "VMT_FEFP", "RHMC_FEFP",
    "POWDER_FEFP", "POWDERCAP_FEFP",
    # damage
    "UNILATERAL", "ROTATING_CRACK", "SIC_SIC", "MVM", "SICSCAL", "SICTENS",
    "DAMAGE_TC", "DESMORAT", "FATSIN", "RICRAG", "GLRC_DM", "EFEM", "RICBET", "RICCOQ", "CONCYC",
    "PLASTIQUE_ENDOM", "PSURY", "ROUSSELIER", "GURSON2", "DRAGON", "BETON_URGC", "BETON_INSA",
    "BETON_DYNAR_LMT", "ENDO_PLAS",
    # creep and viscosity
    "POLYNOMIAL", "BLACKBURN", "BLACKBURN_2", "LEMAITRE", "RCCMR_316", "RCCMR_304", "CERAMIQUE",
    "MAXWELL", "MAXOTT", "KELVIN", "VISCOPLASTIQUE", "VISCO_EXTERNE", "GUIONNET", "ONERA", "OHNO",
    "VISCODOMMAGE", "POUDRE_A", "DDI", "KOCKS", "VISK2", "VISCOHINTE", "MISTRAL", "GATT_MONERIE",
    "VISCODD", "SYCO1", "SYCO2",
)  # fmt: skip
"""Laws that Cast3M has and that are not built here: refused by name."""

UNPUBLISHED = {
    "AMADEI": "FIMU SGMT I0 S0 B0 UP UR KNI FI0 VM",
    "DRUCKER_PRAGER_2": "GF LTR LCS LBI SIGY EPM EPU LCAR",
}
"""Laws whose notice names parameters and no equation, with these parameters."""

IMPEDANCE_LAWS = ("VOIGT", "REUSS", "COMPLEXE")
"""Words that follow IMPEDANCE, beside ELASTIQUE."""

UNDESCRIBED_LAWS = ("JOINT_SOFT", "JOINT_COAT")
"""Joint laws whose parameters BETA and CPLG no public text defines: refused with that reason."""

CHANGED_LAWS = ("ISS_GRANGE",)
"""Laws of footings whose notice says that they differ from the published model, and not how."""


def full_word(word: str, known: Collection[str]) -> str | None:
    """The known word that `word` writes in full, or at least by its first four letters."""
    said = word.upper().rstrip()
    if said in known:
        return said
    return next((k for k in known if len(said) >= 4 and k.startswith(said)), None)


def normalised(words: list[str], family: str) -> tuple[str, ...]:
    """The words of a law in order; ELASTIQUE ISOTROPE where nothing more is said.

    Parameters
    ----------
    words : list of str
        Full words.
    family : str
        Of the element: 'solid', 'bar', 'joint' ...

    Raises
    ------
    MaterialError
        If the element's family does not have the elasticity or law named.
    """
    if "IMPEDANCE" in words:
        return _impedance_words(words, family)
    rest = [w for w in words if w != "ELASTIQUE"]
    kind = rest.pop(0) if rest and rest[0] in ELASTICITIES else ""
    if kind and family not in ELASTICITIES[kind]:
        raise MaterialError(
            "kernel.materials.elements-family-no-elasticity", family=family, kind=kind
        )
    if rest and rest[0] == "PLASTIQUE" and family != "joint":
        return ("ELASTIQUE", kind or "ISOTROPE", *_plastic_words(rest, kind, family))
    if rest and rest[0] in OWN_LAWS:
        return ("ELASTIQUE", kind or "ISOTROPE", *_own_words(rest, kind, family))
    if rest and family != "joint":
        raise MaterialError("kernel.materials.behaviour-joints-only", rest=rest[0])
    if rest[1:2] and rest[0] == "PLASTIQUE" and rest[1] in PLASTIC_WORDS:
        raise MaterialError("kernel.materials.plastic-law-bodies-not", rest=rest[1])
    return ("ELASTIQUE", *([kind or "ISOTROPE"] if not rest or kind else []), *rest)


def _impedance_words(words: list[str], family: str) -> tuple[str, ...]:
    """ELASTIQUE, MODAL or STATIQUE if the point stands for a shape, IMPEDANCE and its law."""
    if family != "impedance":
        raise MaterialError("kernel.materials.elements-family-no-law", family=family)
    shape = [w for w in words if w in ("MODAL", "STATIQUE")]
    law = [w for w in words if w in IMPEDANCE_LAWS]
    known = ("ELASTIQUE", "IMPEDANCE", *shape, *law)
    other = next((w for w in words if w not in known), None)
    if other is not None or len(law) > 1 or len(shape) > 1:
        raise MaterialError(
            "kernel.materials.impedance-no-law", other=other or " ".join(law + shape)
        )
    return ("ELASTIQUE", *shape, "IMPEDANCE", *(law or ["ELASTIQUE"]))


def _own_words(words: list[str], elasticity: str, family: str) -> tuple[str, str]:
    """FLUAGE or ENDOMMAGEMENT, and the law behind it."""
    laws, families = OWN_LAWS[words[0]]
    if family not in families:
        raise MaterialError(
            "kernel.materials.family-without-law", family=family, group=words[0],
            families=families, shells="plate" in families,
        )  # fmt: skip
    if len(words) != 2 or words[1] not in laws:
        raise MaterialError("kernel.materials.which-law", group=words[0], laws=laws)
    if elasticity not in ("", "ISOTROPE"):
        told = {"group": words[0], "elasticity": elasticity}
        raise MaterialError("kernel.materials.law-of-isotropic-bodies", **told)
    return (words[0], words[1])


def _plastic_words(words: list[str], elasticity: str, family: str) -> tuple[str, str]:
    """PLASTIQUE and the law behind it, ISOTROPE where none is said."""
    law = words[1] if len(words) > 1 else "ISOTROPE"
    if elasticity == "SECTION" or law == "SECTION":
        if elasticity != law:
            raise MaterialError("kernel.materials.beam-fibres-elastique-section", law=law)
        return ("PLASTIQUE", law)
    if (family == "fibre" and law not in FIBRE_LAWS) or (
        family not in UNIAXIAL_FAMILIES and law in UNIAXIAL_LAWS
    ):
        told = {"family": family, "law": law, "fibre_laws": FIBRE_LAWS}
        raise MaterialError("kernel.materials.elements-family-no-plastic", **told)
    if family not in PLASTIC_FAMILIES:
        raise MaterialError("kernel.materials.elements-family-no-plastic-law", family=family)
    if family in SECTION_FAMILIES and law not in SECTION_LAWS:
        raise MaterialError(
            "kernel.materials.sections-no-plastic", law=law, section_laws=SECTION_LAWS
        )
    if elasticity not in ("", "ISOTROPE"):
        raise MaterialError("kernel.materials.plastic-laws-go-elasticity", elasticity=elasticity)
    plastic_law(("PLASTIQUE", law))
    return ("PLASTIQUE", law)

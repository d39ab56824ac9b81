"""Names of the parameters that elements and laws take, as data."""

from dataclasses import dataclass

from ssilang.kernel.elements import catalog
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.materials.plastic.laws import plastic_law

THERMAL = ("ALPH", "TREF", "TALP")
ORTHOTROPIC = ("YG1", "YG2", "NU12", "G12", "YG3", "NU23", "NU13", "G23", "G13")
ORTHOTROPIC_THERMAL = ("ALP1", "ALP2", "ALP3", "TREF", "TALP")
ANISOTROPIC = tuple(f"D{i}{j}" for i in range(1, 7) for j in range(1, i + 1))
ANISOTROPIC_THERMAL = (*ORTHOTROPIC_THERMAL, "AL12", "AL13", "AL23")
CABLE_LOSSES = ("FF", "PHIF", "GANC", "RMU0", "FPRG", "RH10")
AXES = ("V1X", "V1Y", "V1Z", "V2X", "V2Y", "V2Z")
JOINT_POINT = ("KS1", "KS2", "QS", "QN", "QS1", "QS2", "MASS", "JX", "JY", "JZ")
JOINT_THERMAL = (
    "ALPN", "ALPS", "ALP1", "ALP2", "ALQN", "ALQS", "ALQ1", "ALQ2", "TREF", "TALP",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Names:
    """Parameters that a zone needs, and those it takes besides."""

    required: tuple[str, ...] = ()
    optional: tuple[str, ...] = ()

    @property
    def all(self) -> tuple[str, ...]:
        """Both, required first."""
        return self.required + self.optional


_ELASTIC: dict[str, Names] = {
    "ISOTROPE": Names(("YOUN", "NU"), ("RHO", *THERMAL, "VISQ")),
    "ANISOTROPE": Names(ANISOTROPIC[:7], ("RHO", *ANISOTROPIC[7:], *ANISOTROPIC_THERMAL, *AXES)),
    "UNIDIRECTIONNEL": Names(("YOUN",), ("RHO", *THERMAL, *AXES)),
    "ARMATURE": Names(("YOUN",), ("NU", "RHO", *THERMAL, "VISQ", *CABLE_LOSSES)),
    "SECTION": Names(("MODS", "MATS"), ("RHO",)),
    "MODAL": Names(("FREQ", "MASS", "DEFO"), ("AMOR", "CGRA", "MADE")),
    "STATIQUE": Names(("DEFO", "RIDE", "MADE"), ("AMOR",)),
}
_AT_POINTS = ("MASS", "AMOR", "CPLE", "INER", "AROT")
_IMPEDANCE: dict[str, Names] = {
    "ELASTIQUE": Names(("RAID",), (*_AT_POINTS, "ZNU", "ALPH")),
    "VOIGT": Names(("RAID", "VISC"), _AT_POINTS),
    "REUSS": Names(("RAID", "VISC"), _AT_POINTS),
    "COMPLEXE": Names((), ("MOCO", "RAID", "VISC", *_AT_POINTS)),
}
_CONTACT: dict[str, Names] = {
    "UNILATERAL": Names((), ("JEU",)),
    "COULOMB": Names(("MU",), ("JEU", "COHE")),
    "FROCABLE": Names(("FF", "PHIF")),
}
_RUBS = ("GLIS", "ADHE", "RTAN", "ATAN")
_AT_LINES = Names(("LIMA", "LIES", "RAID", *_RUBS), ("NORM", "JEU", "AMOR", "RECH", "SYME", "SORT"))
_BETWEEN = ("AMOR", "LOIC", "PERM", "SORT")
LINKS: dict[tuple[str, ...], Names] = {
    ("POINT_PLAN",): Names((), ("NORM", "RAID", "JEU", *_BETWEEN, "SPLA")),
    ("POINT_PLAN", "FROTTEMENT"): Names(("NORM", *_RUBS), ("RAID", "JEU", *_BETWEEN)),
    ("POINT_POINT",): Names(("NORM", "POIB"), ("RAID", "JEU", *_BETWEEN)),
    ("POINT_POINT", "FROTTEMENT"): Names(("NORM", "POIB", *_RUBS), ("RAID", "JEU", *_BETWEEN)),
    ("POINT_POINT", "DEPLACEMENT_PLASTIQUE"): Names(
        ("NORM", "POIB", "LOIC"), ("ECRO", "JEU", *_BETWEEN)
    ),
    ("POINT_POINT", "ROTATION_PLASTIQUE"): Names(
        ("NORM", "POIB", "LOIC"), ("ECRO", "JEU", "ELAS", *_BETWEEN)
    ),
    ("POINT_CERCLE",): Names(("NORM", "RAID", "EXCE", "RAYO"), ("AMOR", "SORT")),
    ("POINT_CERCLE", "FROTTEMENT"): Names(
        ("NORM", "RAID", "EXCE", "RAYO", *_RUBS), ("CINT", "AMOR", "SORT")
    ),
    ("POINT_CERCLE", "MOBILE"): Names(
        ("NORM", "RAID", "PCER", "RAYO", *_RUBS), ("CINT", "AMOR", "SORT")
    ),
    ("CERCLE_PLAN", "FROTTEMENT"): Names(("NORM", "RAID", "RAYS", *_RUBS), ("JEU", "AMOR", "SORT")),
    ("CERCLE_CERCLE", "FROTTEMENT"): Names(
        ("NORM", "RAID", "EXCE", "RAYS", "RAYB", *_RUBS), ("CINT", "AMOR", "SORT")
    ),
    ("LIGNE_LIGNE", "FROTTEMENT"): _AT_LINES,
    ("LIGNE_CERCLE", "FROTTEMENT"): Names(
        (*_AT_LINES.required, "RAYO"), (*_AT_LINES.optional, "ACTN", "INVE")
    ),
    ("COUPLAGE", "DEPLACEMENT"): Names(("ORIG", "COEF"), ("SORT",)),
    ("COUPLAGE", "VITESSE"): Names(("ORIG", "COEF"), ("SORT",)),
    ("POLYNOMIALE",): Names(
        ("COEF",), (*(f"{c}CO{i}" for c in "PT" for i in range(1, 10)), "SORT")
    ),
}
"""Links of DYNE by their words, the formulation LIAISON."""
_ORTHOTROPIC: dict[Mode, int] = {  # how many of ORTHOTROPIC are required
    Mode.PLANE_STRESS: 4, Mode.THREE_DIMENSIONAL: 9, Mode.FOURIER: 9,
}  # fmt: skip

_GEOMETRY: dict[str, Names] = {
    **dict.fromkeys(catalog.SOLID_FAMILIES, Names((), ("DIM3",))),
    **dict.fromkeys(catalog.BARS, Names(("SECT",))),
    "fibre": Names(("ALPY", "ALPZ"), ("SECT",)),
    "joint": Names((), ("DIM3", "EPAI")),
    "pipe": Names(
        ("EPAI", "RAYO"),
        ("RACO", "VECT", "PRES", "CISA", "CFFX", "CFMX", "CFMY", "CFMZ", "CFPR", "OMEG"),
    ),
    "thick": Names(("EPAI",), ("EXCE",)),
    **dict.fromkeys(catalog.FLAT_SHELLS, Names(("EPAI",), ("EXCE", "CALF"))),
    "meridian": Names(("EPAI",), ("EXCE", "CALF", "DIM3")),
}
_BEAM_PLANE = Names(("SECT", "INRZ"), ("SECY", "SECZ", "INRY", "TORS", "VECT", "DX", "DY", "DZ"))
_BEAM_SPACE = Names(
    ("SECT", "INRY", "INRZ", "TORS"),
    ("SECY", "SECZ", "VECT", "VX", "VY", "VZ", "DX", "DY", "DZ", "OMEG"),
)


def material_names(zone: Zone) -> Names:
    """Parameters of the law of a zone."""
    if zone.formulation == "CONTACT":
        return _CONTACT[zone.behaviour[-1]]
    if zone.formulation == "LIAISON":
        return LINKS[zone.behaviour]
    if is_joint(zone) and "ANISOTROPE" in zone.behaviour:
        size = 6 if zone.mode is Mode.THREE_DIMENSIONAL else 3
        terms = ANISOTROPIC[: size * (size + 1) // 2]
        diagonal = tuple(f"D{i}{i}" for i in range(1, size + 1))
        rest = tuple(t for t in terms if t not in diagonal)
        thermal = ("ALP3", "ALQ3", *JOINT_THERMAL)
        return Names(diagonal, (*rest, "RHO", *JOINT_POINT[6:], *thermal, *AXES))
    if is_joint(zone):
        law = law_of(zone.behaviour)
        at_points = JOINT_POINT[6:] if law.two_points else JOINT_POINT
        taken = ("RHO", *law.optional, *at_points, *JOINT_THERMAL, *AXES)
        return Names(law.required, tuple(n for n in dict.fromkeys(taken) if n not in law.required))
    if "IMPEDANCE" in zone.behaviour:
        return _IMPEDANCE[zone.behaviour[-1]]
    kind = zone.behaviour[1] if len(zone.behaviour) > 1 else "ISOTROPE"
    if kind == "ORTHOTROPE":
        thin = catalog.family_name(zone) in catalog.THIN_SHELLS
        needed = 4 if thin else _ORTHOTROPIC.get(zone.mode, 7)
        rest = ("RHO", *ORTHOTROPIC[needed:], *ORTHOTROPIC_THERMAL, *AXES)
        return Names(ORTHOTROPIC[:needed], rest)
    plastic = plastic_law(zone.behaviour)
    if plastic is not None:
        elastic = _ELASTIC[kind]
        optional = (*elastic.optional, *plastic.defaults, *plastic.optional)
        return Names((*elastic.required, *plastic.required), optional)
    return _ELASTIC[kind]


def geometric_names(zone: Zone) -> Names:
    """Parameters of the section or thickness of a zone's elements."""
    family = catalog.family_name(zone)
    if "SECTION" in zone.behaviour:
        return Names((), ("VECT", "VX", "VY", "VZ", "OMEG"))
    if family in catalog.STRAIGHT_BEAMS:
        return _BEAM_SPACE if zone.mode is Mode.THREE_DIMENSIONAL else _BEAM_PLANE
    return _GEOMETRY.get(family, Names())


def idle_names(zone: Zone) -> tuple[str, ...]:
    """Parameters that a zone takes and that change nothing: the thickness outside of a plane."""
    if catalog.family_name(zone) in catalog.SOLID_FAMILIES:
        return () if zone.mode is Mode.PLANE_STRESS else ("DIM3",)
    return ("DIM3",) if zone.mode in (Mode.AXISYMMETRIC, Mode.FOURIER) else ()


def known_names(zone: Zone) -> tuple[str, ...]:
    """All parameters that a zone takes."""
    return material_names(zone).all + geometric_names(zone).all

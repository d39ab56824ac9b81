"""Components of fields: unknowns, forces, strains, stresses, internal variables."""

from __future__ import annotations

from ssilang.language.vocabulary.terms import Quantity

_PLACES = {
    "X": ("along x", "suivant x"), "Y": ("along y", "suivant y"), "Z": ("along z", "suivant z"),
    "R": ("along the radius", "suivant le rayon"),
    "T": ("around the axis", "suivant la circonférence"),
}  # fmt: skip
_ABOUT = {
    "X": ("about x", "autour de x"), "Y": ("about y", "autour de y"),
    "Z": ("about z", "autour de z"),
    "T": ("in the meridian plane", "dans le plan méridien"),
}  # fmt: skip
_TENSOR = ("XX", "YY", "ZZ", "XY", "XZ", "YZ", "RR", "TT", "RZ", "RT", "ZT")


def _c(
    name: str,
    kind: str,
    unit: str | None,
    en: str,
    fr: str,
    of: tuple[str, ...] = (),
) -> Quantity:
    return Quantity(name, en, fr, of, kind, unit)


def _imaginary(parts: tuple[Quantity, ...]) -> tuple[Quantity, ...]:
    """The imaginary parts of unknowns and forces in frequency: IUX, IFX."""
    return tuple(
        _c(("I" + p.name)[:4], p.kind, p.unit, f"Imaginary part of {p.name}",
           f"Partie imaginaire de {p.name}")
        for p in parts
    )  # fmt: skip


_UNKNOWNS = (
    *(
        _c(f"U{a}", "unknown", "m", f"Displacement {en}", f"Déplacement {fr}")
        for a, (en, fr) in _PLACES.items()
    ),
    *(
        _c(f"R{a}", "unknown", "rad", f"Rotation {en}", f"Rotation {fr}")
        for a, (en, fr) in _ABOUT.items()
    ),
    _c("ALFA", "unknown", "", "Participation in a mode of vibration (models MODAL)",
       "Participation à un mode de vibration (modèles MODAL)"),
    _c("BETA", "unknown", "", "Participation in a static shape (models STATIQUE)",
       "Participation à une déformée statique (modèles STATIQUE)"),
    _c("LX", "unknown", "N", "Multiplier of a relation: the force that keeps it",
       "Multiplicateur d'une relation : la force qui la maintient"),
    _c("T", "unknown", "K", "Temperature", "Température"),
    _c("P", "unknown", "Pa", "Pressure", "Pression"),
)  # fmt: skip

_FORCES = (
    *(
        _c(f"F{a}", "force", "N", f"Force {en}", f"Force {fr}")
        for a, (en, fr) in _PLACES.items()
    ),
    *(
        _c(f"M{a}", "force", "N m", f"Moment {en}", f"Moment {fr}")
        for a, (en, fr) in _ABOUT.items()
    ),
    _c("FALF", "force", "N", "Force on the participation in a mode (dual of ALFA)",
       "Force généralisée d'un mode (duale d'ALFA)"),
    _c("FBET", "force", "N", "Force on the participation in a static shape (dual of BETA)",
       "Force généralisée d'une déformée statique (duale de BETA)"),
    _c("FLX", "force", "m", "What a relation is to be equal to (dual of LX)",
       "Second membre d'une relation (dual de LX)"),
    _c("Q", "force", None, "Heat flow (dual of T)", "Flux de chaleur (dual de T)"),
    _c("FP", "force", "m3", "Volume (dual of P)", "Volume (dual de P)"),
)  # fmt: skip

_STRAINS = (
    *(
        _c(f"EP{a}", "strain", "", f"Strain {a}", f"Déformation {a}")
        for a in _TENSOR
        if a[0] == a[1]
    ),
    *(
        _c(f"GA{a}", "strain", "", f"Shear strain {a} (the whole angle, twice the tensor's)",
           f"Distorsion {a} (angle entier, double de celle du tenseur)")
        for a in _TENSOR
        if a[0] != a[1]
    ),
    _c("EPSS", "strain", "", "Strain of the mid-surface (or of a bar) along s",
       "Déformation de la surface moyenne (ou d'une barre) suivant s"),
    _c("GAST", "strain", "", "Shear strain of the mid-surface of a shell",
       "Distorsion de la surface moyenne d'une coque"),
    _c("GASN", "strain", "", "Transverse shear strain of a shell along s",
       "Distorsion transverse d'une coque suivant s"),
    _c("GATN", "strain", "", "Transverse shear strain of a shell along t",
       "Distorsion transverse d'une coque suivant t"),
    *(
        _c(f"RT{a}", "curvature", "1/m", f"Curvature {a} of a shell",
           f"Courbure {a} d'une coque")
        for a in ("SS", "TT", "ST", "ZZ")
    ),
    _c("EPS", "strain", "", "Strain along the axis of a beam",
       "Déformation suivant l'axe d'une poutre"),
    _c("GXY", "strain", "", "Shear strain of a beam along y", "Distorsion d'une poutre suivant y"),
    _c("GXZ", "strain", "", "Shear strain of a beam along z", "Distorsion d'une poutre suivant z"),
    _c("GXY", "jump", "m", "Slip of a joint of two points along its first tangent",
       "Glissement d'un joint de deux points suivant sa première tangente", ("JOI1",)),
    _c("GXZ", "jump", "m", "Slip of a joint of two points along its second tangent",
       "Glissement d'un joint de deux points suivant sa deuxième tangente", ("JOI1",)),
    *(
        _c(f"C{a}", "curvature", "1/m", f"{en} of a beam", f"{fr} d'une poutre")
        for a, en, fr in (
            ("X", "Twist", "Torsion unitaire"), ("Y", "Curvature about y", "Courbure autour de y"),
            ("Z", "Curvature about z", "Courbure autour de z"),
        )
    ),
    _c("EXX", "jump", "m", "Opening of a joint of two points, along its normal",
       "Ouverture d'un joint de deux points, suivant sa normale"),
    *(
        _c(f"CX{a}", "jump", "rad", f"Relative rotation of a joint of two points about {a}",
           f"Rotation relative d'un joint de deux points autour de {a}")
        for a in "XYZ"
    ),
    _c("DRN", "jump", "m", "Opening of a joint: jump along its normal, positive when open",
       "Ouverture d'un joint : saut suivant sa normale, positif à l'ouverture"),
    _c("DRSN", "jump", "m", "Slip of a joint in the plane", "Glissement d'un joint dans le plan"),
    _c("DRS1", "jump", "m", "Slip of a joint along its first tangent",
       "Glissement d'un joint suivant sa première tangente"),
    _c("DRS2", "jump", "m", "Slip of a joint along its second tangent",
       "Glissement d'un joint suivant sa deuxième tangente"),
    *(
        _c(f"GH{i:02}", "strain", None, f"Generalised strain {i} against hourglasses (SHB8)",
           f"Déformation généralisée {i} contre les modes de sablier (SHB8)")
        for i in range(1, 8)
    ),
)  # fmt: skip

_STRESSES = (
    *(
        _c(f"SM{a}", "stress", "Pa", f"{'Stress' if a[0] == a[1] else 'Shear stress'} {a}",
           f"{'Contrainte' if a[0] == a[1] else 'Cisaillement'} {a}")
        for a in _TENSOR
    ),
    *(
        _c(f"SM{a}", "stress", "Pa", f"{en} of a thick shell", f"{fr} d'une coque épaisse")
        for a, en, fr in (
            ("SS", "Stress along s", "Contrainte suivant s"),
            ("ST", "Shear stress in the surface", "Cisaillement dans la surface"),
            ("TN", "Transverse shear stress along t", "Cisaillement transverse suivant t"),
        )
    ),
    _c("SMTT", "stress", "Pa", "Stress along t of a thick shell",
       "Contrainte suivant t d'une coque épaisse", ("thick",)),
    _c("SMSN", "stress", "Pa", "Transverse shear stress along s of a thick shell",
       "Cisaillement transverse suivant s d'une coque épaisse", ("thick",)),
    _c("SMSN", "traction", "Pa", "Shear traction of a joint in the plane",
       "Traction tangente d'un joint dans le plan", ("joint",)),
    _c("SMN", "traction", "Pa", "Normal traction of a joint, positive in tension",
       "Traction normale d'un joint, positive en traction"),
    _c("SMS1", "traction", "Pa", "Shear traction of a joint along its first tangent",
       "Traction tangente d'un joint suivant sa première tangente"),
    _c("SMS2", "traction", "Pa", "Shear traction of a joint along its second tangent",
       "Traction tangente d'un joint suivant sa deuxième tangente"),
    _c("EFFX", "section force", "N", "Normal force of a bar, beam or joint of two points",
       "Effort normal d'une barre, d'une poutre ou d'un joint de deux points"),
    *(
        _c(f"EFF{a}", "section force", "N", f"Shear force along the local axis {b}",
           f"Effort tranchant suivant l'axe local {b}")
        for a, b in (("Y", "y"), ("Z", "z"))
    ),
    _c("MOMX", "section force", "N m", "Torsion moment", "Moment de torsion"),
    *(
        _c(f"MOM{a}", "section force", "N m", f"Bending moment about the local axis {b}",
           f"Moment fléchissant autour de l'axe local {b}")
        for a, b in (("Y", "y"), ("Z", "z"))
    ),
    *(
        _c(f"N{a}", "section force", "N/m", f"Membrane force {a} of a shell over its width",
           f"Effort membranaire {a} d'une coque par unité de largeur")
        for a in ("11", "22", "12", "ZZ")
    ),
    *(
        _c(f"M{a}", "section force", "N", f"Bending moment {a} of a shell over its width",
           f"Moment fléchissant {a} d'une coque par unité de largeur")
        for a in ("11", "22", "12", "ZZ")
    ),
    *(
        _c(f"V{i}", "section force", "N/m", f"Transverse shear force {i} of a shell",
           f"Effort tranchant {i} d'une coque")
        for i in (1, 2)
    ),
    *(
        _c(f"SH{i:02}", "stress", None, f"Generalised stress {i} against hourglasses (SHB8)",
           f"Contrainte généralisée {i} contre les modes de sablier (SHB8)")
        for i in range(1, 8)
    ),
    *(
        _c(f"SI{i}{i}", "principal", None, f"Principal stress (or strain) {i} (PRIN)",
           f"Contrainte (ou déformation) principale {i} (PRIN)")
        for i in (1, 2, 3)
    ),
    *(
        _c(f"CO{a}{i}", "principal", "", f"Component {a} of principal direction {i} (PRIN)",
           f"Composante {a} de la direction principale {i} (PRIN)")
        for i in (1, 2, 3)
        for a in "XYZ"
    ),
)  # fmt: skip

_VARIABLES = (
    _c("EPSE", "variable", "", "Cumulated equivalent plastic (or creep) strain",
       "Déformation plastique (ou de fluage) équivalente cumulée"),
    _c("EPSE", "variable", "m", "Cumulated plastic jump of a joint",
       "Saut plastique cumulé d'un joint", ("joint",)),
    _c("EPSE", "variable", "", "Strain that concrete keeps without stress",
       "Déformation que le béton garde sans contrainte", ("BETON_UNI",)),
    _c("EPSO", "variable", "", "Strain of a fibre of concrete or steel",
       "Déformation d'une fibre de béton ou d'acier"),
    _c("VPLA", "variable", "", "Plastic loss of volume of a clay (CAM_CLAY)",
       "Perte plastique de volume d'une argile (CAM_CLAY)"),
    _c("EPSM", "variable", "", "Least strain so far of a fibre of concrete (BETON_UNI)",
       "Plus petite déformation atteinte d'une fibre de béton (BETON_UNI)"),
    _c("OUVE", "variable", "", "Largest opening so far of a fibre of concrete (BETON_UNI)",
       "Plus grande ouverture atteinte d'une fibre de béton (BETON_UNI)"),
    _c("EPSR", "variable", "", "Strain at the last reversal of steel (ACIER_UNI)",
       "Déformation à la dernière inversion de l'acier (ACIER_UNI)"),
    _c("SIGR", "variable", "Pa", "Stress at the last reversal of steel (ACIER_UNI)",
       "Contrainte à la dernière inversion de l'acier (ACIER_UNI)"),
    _c("EPSP", "variable", "", "Strain at the reversal before the last one (ACIER_UNI)",
       "Déformation à l'avant-dernière inversion de l'acier (ACIER_UNI)"),
    _c("SENS", "variable", "", "Branch of steel (ACIER_UNI): 0 elastic, +-1 first loading, +-2 in "
       "cycles", "Branche de l'acier (ACIER_UNI) : 0 élastique, +-1 premier chargement, +-2 en "
       "cycles"),
    _c("FLAM", "variable", "", "1 once a bar of steel has buckled (ACIER_UNI)",
       "1 dès qu'une barre d'acier a flambé (ACIER_UNI)"),
    *(
        _c(f"AL{a}", "variable", "Pa", f"Centre of the elastic domain, component {a}",
           f"Centre du domaine élastique, composante {a}")
        for a in ("XX", "YY", "ZZ", "XY", "XZ", "YZ")
    ),
    _c("SAUT", "variable", "m", "Largest irreversible opening of a joint",
       "Plus grande ouverture irréversible d'un joint"),
    _c("GLI1", "variable", "m", "Slip of a joint along its first tangent",
       "Glissement d'un joint suivant sa première tangente"),
    _c("GLI2", "variable", "m", "Slip of a joint along its second tangent",
       "Glissement d'un joint suivant sa deuxième tangente"),
    _c("TASS", "variable", "m", "Mean settlement of the ground below a footing that yields",
       "Tassement moyen du sol plastique sous une fondation"),
    _c("PART", "variable", "", "Share of a footing's area that presses",
       "Part de l'aire d'une fondation qui presse"),
    _c("TASP", "variable", "m", "Settlement at the places below a footing whose ground yields",
       "Tassement aux points sous une fondation au sol plastique"),
    _c("GLP1", "variable", "m", "Slip along the first tangent at these places",
       "Glissement suivant la première tangente à ces points"),
    _c("GLP2", "variable", "m", "Slip along the second tangent at these places",
       "Glissement suivant la deuxième tangente à ces points"),
    *(
        _c(f"HYS{i}", "variable", "", f"Share of its force that a lead core has along t{i}",
           f"Part de son effort qu'un noyau de plomb a suivant t{i}")
        for i in (1, 2)
    ),
    _c("STAT", "variable", "", "State of a Mohr-Coulomb joint: 0 untouched, 1 open, 2 in contact",
       "État d'un joint de Mohr-Coulomb : 0 vierge, 1 ouvert, 2 en contact"),
    _c("EPOU", "variable", "m", "Opening of an open point of a Mohr-Coulomb joint",
       "Ouverture d'un point ouvert d'un joint de Mohr-Coulomb"),
    _c("LAM1", "variable", "m", "Plastic compression of a joint of two points",
       "Compression plastique d'un joint de deux points"),
    _c("PLA1", "variable", "m", "Plastic slip along the first tangent",
       "Glissement plastique suivant la première tangente"),
    _c("PLA2", "variable", "m", "Plastic slip along the second tangent",
       "Glissement plastique suivant la deuxième tangente"),
    _c("PLA3", "variable", "m", "Plastic and open normal jump", "Saut normal plastique et ouvert"),
    _c("ETAT", "variable", "", "State of a joint: 1 closed, 2 closing, 3 open, 4 opening",
       "État d'un joint : 1 fermé, 2 en fermeture, 3 ouvert, 4 en ouverture"),
    _c("ESTO", "variable", None, "Energy stored at a point of a joint (J/m2; J for two points)",
       "Énergie stockée en un point d'un joint (J/m2 ; J pour deux points)"),
    _c("EPER", "variable", None,
       "Energy lost at a point of a joint so far (J/m2; J for two points)",
       "Énergie perdue jusqu'ici en un point d'un joint (J/m2 ; J pour deux points)"),
    _c("SCAL", "scalar", None, "The one component of a scalar field",
       "L'unique composante d'un champ scalaire"),
    _c("MAHO", "scalar", None, "Matrix of Hooke (HOOK)", "Matrice de Hooke (HOOK)"),
)  # fmt: skip

WORDS = (
    *_UNKNOWNS,
    *_FORCES,
    *_imaginary(_UNKNOWNS),
    *_imaginary(_FORCES),
    *_STRAINS,
    *_STRESSES,
    *_VARIABLES,
)

"""Parameters of materials (MATE) and sections (CARA): meaning, unit, admissible and usual ranges.

Who takes a parameter, and whether it must be given, is the kernel's. `of` limits a meaning to the
laws, elements or families of elements that use the name for it. Usual ranges are wide, in SI: what
is outside is probably in another unit. The conditions between several parameters (KN > FU^2/GF)
are the laws' own.
"""

from __future__ import annotations

from ssilang.language.vocabulary import law_parameters
from ssilang.language.vocabulary.terms import (
    ANY_NUMBER,
    NOT_NEGATIVE,
    NOT_POSITIVE,
    POSITIVE,
    Quantity,
    Range,
    between,
)
from ssilang.language.vocabulary.terms import (
    parameter as _p,
)
from ssilang.language.vocabulary.terms import (
    unused_parameter as _unused,
)

_MACRO = ("MACRO_SEMELLE", "MACRO_DISQUE", "MACRO_RESSORTS")
_YIELDING = ("MACRO_SEMELLE", "MACRO_DISQUE")
_BEARINGS = ("APPUI_PLOMB", "APPUI_PENDULE")
_ONE_POINT = ("JOI1", *_MACRO, *_BEARINGS)
_SHELLS = ("plate", "meridian", "mindlin", "thick")
_STIFF = between(1e6, 1e12)  # moduli of soft clay to hard metal
_AXES = {"1": ("first", "premier"), "2": ("second", "deuxième"), "3": ("third", "troisième")}
_POISSON = (
    "Poisson's ratio, about 0.3 for soils and steel, 0.2 for concrete",
    "Coefficient de Poisson, environ 0.3 pour les sols et l'acier, 0.2 pour le béton",
)


_ELASTIC = (
    _p(
        "YOUN", "Pa", "Young's modulus", "Module d'Young", range=NOT_NEGATIVE, usual=_STIFF
    ),
    # of bodies the kernel refuses 0.5 itself, with what to do about it
    _p("NU", "", *_POISSON, range=Range(-1.0, 0.5, open_low=True)),
    _p(
        "RHO", "kg/m3", "Density", "Masse volumique", range=NOT_NEGATIVE, usual=between(10.0, 2.5e4)
    ),
    _p(
        "RHO", "kg/m2", "Mass of the joint's own matter, for each unit of its surface",
        "Masse propre du joint, par unité de surface", ("joint",), range=NOT_NEGATIVE,
    ),
    _p(
        "ALPH", "1/K", "Coefficient of thermal expansion", "Coefficient de dilatation thermique",
        usual=between(-1e-4, 1e-3), default=0.0,
    ),
    _unused("TREF", "K", "Reference temperature of expansion",
            "Température de référence de la dilatation"),
    _p("TALP", "K", "Temperature from which the coefficient of expansion is measured",
       "Température depuis laquelle le coefficient de dilatation est mesuré", default=0.0),
    _p("VISQ", "Pa s", "Viscosity, in the place of YOUN in the damping matrix (AMOR)",
       "Viscosité, à la place de YOUN dans la matrice d'amortissement (AMOR)",
       range=NOT_NEGATIVE),
)  # fmt: skip

_ORTHOTROPIC = (
    *(
        _p(f"YG{i}", "Pa", f"Young's modulus along the {en} axis",
           f"Module d'Young suivant le {fr} axe", range=POSITIVE, usual=_STIFF)
        for i, (en, fr) in _AXES.items()
    ),
    *(
        _p(f"NU{i}{j}", "", f"Poisson's ratio: strain along axis {j} under a stress along axis {i}",
           f"Coefficient de Poisson : déformation suivant l'axe {j} sous contrainte suivant "
           f"l'axe {i}")
        for i, j in ("12", "23", "13")
    ),
    *(
        _p(f"G{i}{j}", "Pa", f"Shear modulus in the plane of axes {i} and {j}",
           f"Module de cisaillement dans le plan des axes {i} et {j}", range=POSITIVE,
           usual=_STIFF)
        for i, j in ("12", "23", "13")
    ),
    *(
        _p(f"ALP{i}", "1/K", f"Thermal expansion along the {en} axis",
           f"Dilatation thermique suivant le {fr} axe", default=0.0)
        for i, (en, fr) in _AXES.items()
    ),
    *(
        _p(f"AL{i}{j}", "1/K", f"Thermal shear in the plane of axes {i} and {j}",
           f"Distorsion thermique dans le plan des axes {i} et {j}", default=0.0)
        for i, j in ("12", "23", "13")
    ),
    *(
        _p(f"D{i}{j}", "Pa", f"Term {i}, {j} of the matrix of Hooke (stress {i}, strain {j})",
           f"Terme {i}, {j} de la matrice de Hooke (contrainte {i}, déformation {j})",
           range=NOT_NEGATIVE if i == j else ANY_NUMBER, default=None if i == j else 0.0)
        for i in range(1, 7)
        for j in range(1, i + 1)
    ),
    *(
        Quantity(f"V{i}{c}", f"Component {c} of the {en} axis of the material (set by DIRECTION)",
                 f"Composante {c} du {fr} axe du matériau (donnée par DIRECTION)", kind="axes")
        for i, (en, fr) in (("1", _AXES["1"]), ("2", _AXES["2"]))
        for c in "XYZ"
    ),
)  # fmt: skip

_JOINTS = (
    _p("KN", "Pa/m", "Normal stiffness of the joint", "Raideur normale du joint",
       range=NOT_NEGATIVE, usual=between(1e5, 1e15)),
    _p("KN", "N/m", "Normal stiffness of a joint of two points or of a whole footing",
       "Raideur normale d'un joint de deux points ou d'une fondation entière", _ONE_POINT,
       range=NOT_NEGATIVE, usual=between(1e3, 1e16)),
    _p("KS", "Pa/m", "Shear stiffness of the joint (KS1 and KS2)",
       "Raideur tangente du joint (KS1 et KS2)", range=NOT_NEGATIVE, usual=between(0.0, 1e15)),
    _p("KS", "N/m", "Shear stiffness of a joint of two points",
       "Raideur tangente d'un joint de deux points", _ONE_POINT, range=NOT_NEGATIVE,
       usual=between(0.0, 1e16)),
    *(
        _p(f"KS{i}", unit, f"Shear stiffness along the {en} tangent (KS if not given)",
           f"Raideur tangente suivant la {fr} tangente (KS sinon)", of, range=NOT_NEGATIVE)
        for i, en, fr in (("1", "first", "première"), ("2", "second", "deuxième"))
        for unit, of in (("Pa/m", ()), ("N/m", _ONE_POINT))
    ),
    _p("FU", "Pa", "Tensile strength of the joint; 0: it opens freely",
       "Résistance en traction du joint ; 0 : il s'ouvre librement", range=NOT_NEGATIVE,
       usual=between(0.0, 1e8)),
    _p("FU", "N", "Tensile strength of a joint of two points; 0: it opens freely",
       "Résistance en traction d'un joint de deux points ; 0 : il s'ouvre librement",
       _ONE_POINT, range=NOT_NEGATIVE),
    _p("GF", "N/m", "Energy spent to open the joint fully, for each unit of its surface; with FU, "
       "more than FU**2/KN",
       "Énergie dépensée à l'ouverture complète du joint, par unité de surface ; avec FU, plus de "
       "FU**2/KN",
       range=NOT_NEGATIVE, usual=between(0.0, 1e6)),
    _p("GF", "J", "Energy spent to open a joint of two points fully",
       "Énergie dépensée à l'ouverture complète d'un joint de deux points", _ONE_POINT,
       range=NOT_NEGATIVE),
    _p("FC", "N", "Force at which an opened joint of two points is closed again, a compression",
       "Force à laquelle un joint ouvert de deux points est refermé, une compression", ("JOI1",),
       range=NOT_POSITIVE),
    _p("FC", "Pa", "Traction at which an opened joint is closed again, a compression (<= 0)",
       "Traction à laquelle un joint ouvert est refermé, une compression (<= 0)", ("JOINT_SDM",),
       range=NOT_POSITIVE),
    _p("FC", "Pa", "Strength of concrete in compression", "Résistance du béton en compression",
       ("BETON_BAEL",), usual=between(-1e9, 1e9)),
    _p("FROT", "", "Coulomb's coefficient of friction; negative: shear is not bounded",
       "Coefficient de frottement de Coulomb ; négatif : cisaillement non borné",
       usual=between(-1.0, 2.0)),
    _p("FROT", "", "Coulomb's coefficient below a footing whose ground yields (with COHE); "
       "negative: the cohesion alone bounds the shear",
       "Coefficient de Coulomb sous une fondation au sol plastique (avec COHE) ; négatif : "
       "seule la cohésion borne le cisaillement", _YIELDING, usual=between(-1.0, 2.0)),
    _p("FRIC", "deg", "Friction angle of the joint", "Angle de frottement du joint",
       range=Range(0.0, 90.0, open_high=True)),
    _p("FTRC", "Pa", "Tensile strength of a Mohr-Coulomb joint; 0: it opens and closes freely",
       "Résistance en traction d'un joint de Mohr-Coulomb ; 0 : il s'ouvre et se ferme librement",
       range=NOT_NEGATIVE),
    _p("FTRC", "N", "Tensile strength of a Mohr-Coulomb joint of two points",
       "Résistance en traction d'un joint de Mohr-Coulomb de deux points", ("JOI1",),
       range=NOT_NEGATIVE),
    _p("EF", "N/m", "Normal stiffness of a joint of two points beyond the closing ECN",
       "Raideur normale d'un joint de deux points au-delà de la fermeture ECN", ("JOI1",),
       range=NOT_NEGATIVE),
    _p("COHE", "Pa", "Undrained strength of the ground below the footing; 0: it never yields",
       "Cohésion non drainée du sol sous la fondation ; 0 : il ne plastifie jamais", _YIELDING,
       range=NOT_NEGATIVE, usual=between(0.0, 1e8)),
    _p("COHE", "N", "Cohesion of a joint of two points", "Cohésion d'un joint de deux points",
       ("JOI1",), range=NOT_NEGATIVE),
    _p("QULT", "Pa", "Pressure that the ground bears; default COHE times 5.14 (strip), "
       "5.14 (1 + 0.2 B/L) (rectangle), 6.05 (disc)",
       "Pression que le sol supporte ; par défaut COHE fois 5,14 (filante), "
       "5,14 (1 + 0,2 B/L) (rectangle), 6,05 (disque)", _YIELDING, range=NOT_NEGATIVE,
       usual=between(0.0, 1e9)),
    _p("PDUR", "", "Share of the ground's strength in hard spots, a tenth of the area; 0: none; "
       "more than 0.1: loops widen, stiffness and strength stay",
       "Part de la résistance du sol en points durs, un dixième de l'aire ; 0 : aucun ; plus de "
       "0.1 : les boucles s'élargissent, raideur et résistance restent", _YIELDING,
       range=between(0.0, 1.0)),
    _p("EF", "Pa/m", "Normal stiffness beyond the closing ECN",
       "Raideur normale au-delà de la fermeture ECN", range=NOT_NEGATIVE),
    _p("ECN", "m", "Closing beyond which the normal stiffness is EF; 0: never",
       "Fermeture au-delà de laquelle la raideur normale est EF ; 0 : jamais",
       range=NOT_NEGATIVE),
    _p("FNE", "N", "Compression from which a joint of two points yields; 0: never",
       "Compression à partir de laquelle un joint de deux points plastifie ; 0 : jamais",
       range=NOT_NEGATIVE),
    _p("QT", "N/m", "Tangent stiffness of a joint of two points that yields",
       "Raideur tangente d'un joint de deux points qui plastifie", range=NOT_NEGATIVE),
    _p("TYPE", "", "1: slip of the displacements", "1 : glissement en déplacement",
       range=between(1.0, 1.0)),
    _p("LARG", "m", "Width of the footing, along the first tangent in space",
       "Largeur de la fondation, suivant la première tangente dans l'espace", range=NOT_NEGATIVE),
    _p("LONG", "m", "Other width of the footing; 0: a strip", "Autre largeur de la fondation ; "
       "0 : bande", range=NOT_NEGATIVE),
    _p("QS", "N m", "Spring of the relative rotation (for each radian)",
       "Ressort de la rotation relative (par radian)", range=NOT_NEGATIVE),
    _p("QN", "N m", "Spring of the relative rotation about the normal (for each radian)",
       "Ressort de la rotation relative autour de la normale (par radian)", range=NOT_NEGATIVE),
    *(
        _p(f"QS{i}", "N m", f"Spring of the relative rotation about the {en} tangent (QS if not "
           "given)", f"Ressort de la rotation relative autour de la {fr} tangente (QS sinon)",
           range=NOT_NEGATIVE)
        for i, en, fr in (("1", "first", "première"), ("2", "second", "deuxième"))
    ),
    *(
        _unused(f"J{c}", "kg m2", f"Rotary inertia of a joint of two points about {c}",
                f"Inertie de rotation d'un joint de deux points autour de {c}")
        for c in "XYZ"
    ),
    _unused("ALPN", "m/K", "Thermal opening of the joint for each degree",
       "Ouverture thermique du joint par degré"),
    _unused("ALPS", "m/K", "Thermal slip of the joint for each degree",
       "Glissement thermique du joint par degré"),
    *(
        _unused(f"ALP{i}", "m/K", f"Thermal slip along the {en} tangent for each degree",
           f"Glissement thermique suivant la {fr} tangente par degré", ("joint",))
        for i, en, fr in (("1", "first", "première"), ("2", "second", "deuxième"))
    ),
    _unused("ALQN", "1/K", "Thermal rotation about the normal for each degree",
       "Rotation thermique autour de la normale par degré"),
    _unused("ALQS", "1/K", "Thermal rotation for each degree", "Rotation thermique par degré"),
    *(
        _unused(f"ALQ{i}", "1/K", f"Thermal rotation about the {en} tangent for each degree",
           f"Rotation thermique autour de la {fr} tangente par degré")
        for i, en, fr in (("1", "first", "première"), ("2", "second", "deuxième"))
    ),
)  # fmt: skip

_PLASTIC = (
    _p("SIGY", "Pa", "Yield stress", "Limite d'élasticité", range=POSITIVE,
       usual=between(1e2, 1e11)),
    _p("ECRO", None, "Curve of the strength over the cumulated plastic strain",
       "Courbe de la limite en fonction de la déformation plastique cumulée"),
    _p("TRAC", None, "Tension curve from zero, stress over the whole strain (in the place of ECRO)",
       "Courbe de traction depuis zéro, contrainte en fonction de la déformation totale (au lieu "
       "d'ECRO)"),
    _p("H", "Pa", "Hardening modulus", "Module d'écrouissage"),
    _p("LTR", "Pa", "Strength in simple tension", "Résistance en traction simple",
       range=POSITIVE),
    _p("LCS", "Pa", "Strength in simple compression", "Résistance en compression simple"),
    _p("ALFA", "", "Weight of the trace of stresses in the criterion",
       "Poids de la trace des contraintes dans le critère", ("DRUCKER_PRAGER",)),
    _p("BETA", "", "Weight of the deviator of stresses in the criterion",
       "Poids du déviateur des contraintes dans le critère", ("DRUCKER_PRAGER",),
       range=POSITIVE),
    _p("K", "Pa", "First strength of the criterion", "Résistance initiale du critère"),
    _p("ETA", "", "Weight of the trace of stresses in the ultimate criterion",
       "Poids de la trace des contraintes dans le critère ultime"),
    _p("MU", "", "Weight of the deviator of stresses in the ultimate criterion",
       "Poids du déviateur des contraintes dans le critère ultime", ("DRUCKER_PRAGER",),
       range=POSITIVE),
    _p("SIG0", "Pa", "First yield strength", "Première limite d'élasticité", range=POSITIVE,
       usual=between(1e3, 1e10)),
    _p("SIGI", "Pa", "Strength at which the exponential hardening ends",
       "Limite à laquelle l'écrouissage exponentiel s'arrête", range=POSITIVE,
       usual=between(1e3, 1e10)),
    _p("KISO", "Pa", "Slope of the linear hardening", "Pente de l'écrouissage linéaire",
       range=NOT_NEGATIVE),
    _p("VELO", "", "How fast the exponential hardening saturates: strength SIG0 + KISO p + "
       "(SIGI - SIG0)(1 - exp(-VELO p)), p the plastic strain",
       "Vitesse de saturation de l'écrouissage exponentiel : limite SIG0 + KISO p + "
       "(SIGI - SIG0)(1 - exp(-VELO p)), p la déformation plastique", range=NOT_NEGATIVE),
    _p("KL", "Pa", "Ultimate strength of the criterion", "Résistance ultime du critère"),
    _p("GAMM", "", "Weight of the trace of stresses in the flow",
       "Poids de la trace des contraintes dans l'écoulement"),
    _p("DELT", "", "Weight of the deviator of stresses in the flow",
       "Poids du déviateur des contraintes dans l'écoulement", range=NOT_NEGATIVE),
    _p("COHE", "Pa", "Cohesion", "Cohésion", range=NOT_NEGATIVE, usual=between(0.0, 1e8)),
    _p("COHE", "Pa", "Cohesion", "Cohésion", ("RH_COULOMB",), range=POSITIVE,
       usual=between(0.0, 1e8)),
    _p("PHI", "rad", "Friction angle", "Angle de frottement", ("RH_COULOMB",),
       range=Range(0.0, 1.5707963267948966, True, True)),
    _p("PHI", "deg", "Friction angle of the joint", "Angle de frottement du joint",
       ("JOINT_DILATANT",), range=Range(0.0, 90.0, open_high=True)),
    _p("MU", "deg", "Dilatancy angle of the joint", "Angle de dilatance du joint",
       ("JOINT_DILATANT",), range=Range(0.0, 90.0, open_high=True)),
    _p("GGAM", None, "Curve of G/Gmax over the shear strain gamma (no percentage), from G/Gmax = 1",
       "Courbe de G/Gmax en fonction de la distorsion gamma (sans pourcent), depuis G/Gmax = 1"),
    _p("GAMR", "", "Shear strain at which G is half of Gmax: G/Gmax = 1 / (1 + gamma / GAMR), in "
       "the place of GGAM", "Distorsion à laquelle G vaut la moitié de Gmax : G/Gmax = 1 / (1 + "
       "gamma / GAMR), au lieu de GGAM", range=POSITIVE, usual=between(1e-6, 1e-2)),
    _p("PREF", "Pa", "Mean pressure (compression positive) at which the curve of G/Gmax holds",
       "Pression moyenne (positive en compression) à laquelle vaut la courbe de G/Gmax",
       range=POSITIVE, usual=between(1e2, 1e8)),
    _p("AF1", None, "Factor of the creep strain, AF1 q**AF2 t**AF3 under a constant stress q; its "
       "unit depends on AF2 and AF3",
       "Facteur de la déformation de fluage, AF1 q**AF2 t**AF3 sous contrainte q constante ; son "
       "unité dépend d'AF2 et AF3",
       range=NOT_NEGATIVE),
    _p("AF2", "", "Exponent of the stress in creep", "Exposant de la contrainte dans le fluage",
       range=Range(1.0)),
    _p("AF3", "", "Exponent of the time in creep", "Exposant du temps dans le fluage",
       range=Range(0.0, 1.0, open_low=True)),
    _unused("SMAX", "Pa", "Largest stress of creep", "Contrainte maximale du fluage"),
)  # fmt: skip

_CONTACT = (
    _p("JEU", "m", "Gap that is open at the start", "Jeu ouvert au départ", default=0.0),
    _p("MU", "", "Coulomb's coefficient of friction", "Coefficient de frottement de Coulomb",
       ("CONTACT",), range=NOT_NEGATIVE, usual=between(0.0, 2.0)),
    _p("COHE", "Pa", "Cohesion of the sides in contact", "Cohésion des bords en contact",
       ("CONTACT",), range=NOT_NEGATIVE, default=0.0),
    _p("FF", "", "Friction of the cable for each radian of its angle",
       "Frottement du câble par radian de déviation", range=NOT_NEGATIVE,
       usual=between(0.0, 1.0)),
    _p("PHIF", "1/m", "Friction of the cable for each unit of its length",
       "Frottement du câble par unité de longueur", range=NOT_NEGATIVE, usual=between(0.0, 0.1)),
)  # fmt: skip

_POINTS = (
    _p("RAID", "N/m", "Stiffness on translations; a curve over the frequency for COMPLEXE",
       "Raideur en translation ; courbe en fonction de la fréquence pour COMPLEXE",
       range=NOT_NEGATIVE),
    _p("VISC", "N s/m", "Dashpot; a curve over the frequency for COMPLEXE",
       "Amortisseur ; courbe en fonction de la fréquence pour COMPLEXE", range=NOT_NEGATIVE),
    _p("MASS", "kg", "Mass at the point", "Masse au point", range=NOT_NEGATIVE),
    _p("MASS", "kg", "Modal mass", "Masse modale", ("MODAL",), range=NOT_NEGATIVE),
    _p("AMOR", "%", "Damping in per cent of the critical one",
       "Amortissement en pour cent du critique", range=NOT_NEGATIVE),
    _p("AMOR", "N s/m", "Damping of the shape: its term in the matrix that AMOR makes",
       "Amortissement de la forme, son terme dans la matrice que fait AMOR",
       ("MODAL", "STATIQUE"), default=0.0),
    _p("CPLE", "N m", "Stiffness on rotations (for each radian)",
       "Raideur en rotation (par radian)", range=NOT_NEGATIVE),
    _p("INER", "kg m2", "Inertia on rotations", "Inertie en rotation", range=NOT_NEGATIVE),
    _p("AROT", "%", "Damping on rotations in per cent of the critical one",
       "Amortissement en rotation en pour cent du critique", range=NOT_NEGATIVE),
    _p("MOCO", None, "Curves over the frequency: stiffness MOCO and dashpot VISC",
       "Courbes en fonction de la fréquence : raideur MOCO et amortisseur VISC"),
    _unused("ZNU", "", "Poisson's ratio of a spring", "Coefficient de Poisson d'un ressort"),
    _unused("ALPH", "1/K", "Thermal expansion of a spring", "Dilatation thermique d'un ressort",
            ("impedance",)),
    _p("FREQ", "Hz", "Frequency of the mode", "Fréquence du mode", range=NOT_NEGATIVE),
    _p("DEFO", None, "Shape: displacements, a field at points",
       "Déformée : déplacements, un champ par points"),
    _p("RIDE", None, "Stiffness times the shape, a field at points",
       "Rigidité multipliée par la déformée, un champ par points"),
    _p("MADE", None, "Mass times the shape, a field at points",
       "Masse multipliée par la déformée, un champ par points"),
    _p("CGRA", None, "Centre of the rigid body that the mode turns, a point (DYNE)",
       "Centre du corps rigide que le mode tourne, un point (DYNE)"),
)  # fmt: skip

_LINK = ("link",)
_LINKS = (
    _p("NORM", None, "Normal of a link, into the obstacle; a point",
       "Normale d'une liaison, vers l'obstacle ; un point"),
    _p("JEU", "m", "Gap of a link", "Jeu d'une liaison", _LINK, default=0.0),
    _p("RAID", "N/m", "Stiffness of a link; of lines a field at their nodes",
       "Raideur d'une liaison ; de lignes un champ à leurs noeuds", _LINK, range=NOT_NEGATIVE),
    _p("AMOR", "N s/m", "Damping of a link in contact; of lines a field at their nodes",
       "Amortissement d'une liaison en contact ; de lignes un champ à leurs noeuds", _LINK,
       default=0.0),
    _p("LOIC", None, "Force of a link against its displacement, a curve",
       "Force d'une liaison selon son déplacement, une courbe"),
    _p("PERM", "", "1: the link pulls too", "1 : la liaison tire aussi", default=0.0),
    _p("SPLA", "N", "Force beyond which a link yields",
       "Force au-delà de laquelle une liaison plastifie"),
    _p("GLIS", "", "Friction of a link, sliding", "Frottement d'une liaison, en glissement"),
    _p("ADHE", "", "Friction of a link, sticking", "Frottement d'une liaison, en adhérence"),
    _p("RTAN", "N/m", "Tangential stiffness of a link that sticks; below zero: Oden's law",
       "Raideur tangentielle d'une liaison qui adhère ; négative : loi d'Oden"),
    _p("ATAN", "N s/m", "Tangential damping of a link; velocity of regularisation of Oden's law",
       "Amortissement tangentiel d'une liaison ; vitesse de régularisation de la loi d'Oden"),
    _p("POIB", None, "Second point of a link, a point", "Second point d'une liaison, un point"),
    _p("ECRO", None, "Hardening of a link: ISOTROPE or CINEMATIQUE, a word",
       "Ecrouissage d'une liaison : ISOTROPE ou CINEMATIQUE, un mot"),
    _p("ELAS", "", "1: a plastic hinge stays elastic", "1 : une rotule plastique reste élastique",
       default=0.0),
    _p("PCER", None, "Centre of the circle of a link, a point",
       "Centre du cercle d'une liaison, un point"),
    _p("EXCE", None, "Centre of the circle of a link from its point, a point",
       "Centre du cercle d'une liaison depuis son point, un point", _LINK),
    _p("RAYO", "m", "Radius of the circle of a link", "Rayon du cercle d'une liaison", _LINK),
    _p("RAYS", "m", "Radius of the circle about the point of a link",
       "Rayon du cercle autour du point d'une liaison"),
    _p("RAYB", "m", "Radius of the fixed circle of a link", "Rayon du cercle fixe d'une liaison"),
    _p("CINT", "", "1: inside of the circle", "1 : à l'intérieur du cercle", default=1.0),
    _p("LIMA", None, "Line that is touched, a mesh", "Ligne touchée, un maillage"),
    _p("LIES", None, "Line whose nodes touch, a mesh or a point",
       "Ligne dont les noeuds touchent, un maillage ou un point"),
    _p("SYME", "", "1: nodes of either line touch the other",
       "1 : les noeuds de chaque ligne touchent l'autre", default=0.0),
    _unused("RECH", "", "Search along lines, local (0) or global (1): the whole line is looked at",
            "Recherche sur les lignes, locale (0) ou globale (1) : toute la ligne est regardée"),
    _p("ACTN", "", "1: the normal turns with the line (not built)",
       "1 : la normale tourne avec la ligne (pas programmé)", default=0.0),
    _p("INVE", "", "1: nodes of the line in a cylinder", "1 : noeuds de la ligne dans un cylindre",
       default=0.0),
    _p("ORIG", None, "Point that marks the mode whose motion acts, a point",
       "Point repère du mode dont le mouvement agit, un point"),
    _p("COEF", "", "Factor of a coupling", "Coefficient d'un couplage"),
    _p("SORT", None, "What is kept of a link, a table by its model",
       "Ce qui est gardé d'une liaison, une table par son modèle"),
    *(
        _p(f"{letter}CO{i}", None, f"{en} {i} of POLYNOMIALE", f"{fr} {i} de POLYNOMIALE")
        for letter, en, fr in (
            ("P", "Point that marks the mode", "Point repère du mode"),
            ("T", "Table CONTRIBUTION of the mode", "Table CONTRIBUTION du mode"),
        )
        for i in range(1, 10)
    ),
)  # fmt: skip

_SECTIONS = (
    _p("DIM3", "m", "Thickness in plane stress and plane strain",
       "Épaisseur en contraintes et déformations planes", range=NOT_NEGATIVE, default=1.0),
    _p("SECT", "m2", "Area of the section", "Aire de la section", range=NOT_NEGATIVE,
       usual=between(1e-8, 1e4)),
    _p("SECY", "m2", "Area reduced for shear along y (POUT: rigid without it; TIMO: SECT)",
       "Section réduite à l'effort tranchant suivant y (POUT : rigide sinon ; TIMO : SECT)",
       range=NOT_NEGATIVE),
    _p("SECZ", "m2", "Area reduced for shear along z (POUT: rigid without it; TIMO: SECT)",
       "Section réduite à l'effort tranchant suivant z (POUT : rigide sinon ; TIMO : SECT)",
       range=NOT_NEGATIVE),
    _p("INRY", "m4", "Second moment of area about the local axis y",
       "Moment quadratique autour de l'axe local y", range=NOT_NEGATIVE),
    _p("INRZ", "m4", "Second moment of area about the local axis z",
       "Moment quadratique autour de l'axe local z", range=NOT_NEGATIVE),
    _p("TORS", "m4", "Torsion constant", "Constante de torsion", range=NOT_NEGATIVE),
    _p("VECT", None, "Vector in the plane of the local axes x and y",
       "Vecteur du plan des axes locaux x et y"),
    *(
        _p(f"V{c}", "", f"Component {c} of the vector VECT", f"Composante {c} du vecteur VECT")
        for c in "XYZ"
    ),
    *(
        _p(f"D{c}", "m", f"Lever of the stresses of moment {m} in the section",
           f"Bras de levier des contraintes du moment {m} dans la section")
        for c, m in (("X", "MOMX"), ("Y", "MOMZ"), ("Z", "MOMY"))
    ),
    _p("OMEG", "rad/s", "Speed of rotation of the beam about itself",
       "Vitesse de rotation propre de la poutre"),
    _p("MODS", None, "Model of the section, made of POJS, TRIS and QUAS",
       "Modèle de la section, fait de POJS, TRIS et QUAS"),
    _p("MATS", None, "Material of the section, a field of MATE",
       "Matériau de la section, un champ de MATE"),
    _p("ALPY", "", "Factor of the shear stresses along y", "Facteur des cisaillements suivant y",
       range=NOT_NEGATIVE),
    _p("ALPZ", "", "Factor of the shear stresses along z", "Facteur des cisaillements suivant z",
       range=NOT_NEGATIVE),
    _p("EPAI", "m", "Thickness", "Épaisseur", range=NOT_NEGATIVE, usual=between(1e-5, 1e2)),
    _unused("EPAI", "m", "Thickness of the joint", "Épaisseur du joint", ("joint",)),
    _p("EXCE", "m", "Distance of the mid-surface from the mesh along the normal",
       "Distance de la surface moyenne au maillage suivant la normale", default=0.0),
    _p("CALF", "", "Weight of the moments in the equivalent stress (2/3)",
       "Poids des moments dans la contrainte équivalente (2/3)", _SHELLS, default=2 / 3),
    _p("RAYO", "m", "Radius of the footing", "Rayon de la fondation", ("MACRO_DISQUE",),
       range=NOT_NEGATIVE),
    _p("RAYO", "m", "Outer radius of the pipe", "Rayon extérieur du tuyau", range=NOT_NEGATIVE),
    _p("RACO", "m", "Radius of the bend; 0: straight", "Rayon du coude ; 0 : droit", default=0.0,
       range=NOT_NEGATIVE),
    _p("PRES", "Pa", "Inner pressure", "Pression interne", default=0.0),
    _unused("CISA", "", "Shear factor of the pipe", "Facteur de cisaillement du tuyau"),
    _p("CFFX", "", "Factor of the normal force in the equivalent stress",
       "Facteur de l'effort normal dans la contrainte équivalente", default=1.0),
    _p("CFMX", "", "Factor of the torsion in the equivalent stress (square root of 3 without it)",
       "Facteur de la torsion dans la contrainte équivalente (racine de 3 sinon)"),
    _p("CFMY", "", "Factor of the moment about y in the equivalent stress",
       "Facteur du moment autour de y dans la contrainte équivalente"),
    _p("CFMZ", "", "Factor of the moment about z in the equivalent stress",
       "Facteur du moment autour de z dans la contrainte équivalente"),
    _p("CFPR", "", "Factor of the pressure in the equivalent stress",
       "Facteur de la pression dans la contrainte équivalente"),
)  # fmt: skip

WORDS = (
    *_ELASTIC,
    *_ORTHOTROPIC,
    *_JOINTS,
    *_PLASTIC,
    *_CONTACT,
    *_POINTS,
    *_LINKS,
    *_SECTIONS,
    *law_parameters.WORDS,
)

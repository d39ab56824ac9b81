"""Parameters that one law alone has: steel and concrete in cycles, bearings, clay.

Part of `parameters`, whose head says what stands here.
"""

from __future__ import annotations

from ssilang.language.vocabulary.terms import (
    NOT_NEGATIVE,
    POSITIVE,
    Range,
    between,
)
from ssilang.language.vocabulary.terms import (
    parameter as _p,
)
from ssilang.language.vocabulary.terms import (
    unused_parameter as _unused,
)

_STRENGTH = between(1e5, 1e10)
_STEEL = (
    _p("STSY", "Pa", "Yield stress of the steel", "Limite d'élasticité de l'acier",
       range=POSITIVE, usual=_STRENGTH),
    _p("STSU", "Pa", "Ultimate stress of the steel", "Contrainte ultime de l'acier",
       range=POSITIVE, usual=_STRENGTH),
    _p("EPSH", "", "Strain at which the plateau ends and hardening begins",
       "Déformation à la fin du palier, où l'écrouissage commence", range=POSITIVE),
    _p("EPSU", "", "Strain at which the ultimate stress is reached",
       "Déformation à laquelle la contrainte ultime est atteinte", range=POSITIVE),
    _p("ROFA", "", "Roundness R0 of the curve of a first cycle (about 20)",
       "Courbure R0 du premier cycle (environ 20)", range=POSITIVE, usual=between(1.0, 100.0)),
    _p("BFAC", "", "Slope of hardening in cycles, relative to YOUN",
       "Pente d'écrouissage en cycles, rapportée à YOUN",
       range=Range(0.0, 1.0, open_high=True)),
    _p("A1FA", "", "Coefficient A1 of R = ROFA - A1 xi / (A2 + xi) (about 18.5)",
       "Coefficient A1 de R = ROFA - A1 xi / (A2 + xi) (environ 18,5)", range=NOT_NEGATIVE),
    _p("A2FA", "", "Coefficient A2 of R = ROFA - A1 xi / (A2 + xi) (about 0.15)",
       "Coefficient A2 de R = ROFA - A1 xi / (A2 + xi) (environ 0,15)", range=POSITIVE),
    _p("FALD", "", "Free length of the bar between hoops over its diameter; above 5 it buckles",
       "Longueur libre de la barre entre cadres sur son diamètre ; au-dessus de 5 elle flambe",
       range=Range(0.0, 11.0, open_high=True), default=0.0),
    _p("A6FA", "", "Buckling: coefficient A6 of the stiffness that comes back (about 620)",
       "Flambage : coefficient A6 de la raideur retrouvée (environ 620)", range=NOT_NEGATIVE,
       default=0.0),
    _p("CFAC", "", "Buckling: coefficient C (about 0.5)",
       "Flambage : coefficient C (environ 0,5)", range=NOT_NEGATIVE, default=0.0),
    _p("AFAC", "", "Buckling: coefficient A of the slope that falls (about 0.006)",
       "Flambage : coefficient A de la pente descendante (environ 0,006)", range=NOT_NEGATIVE,
       default=0.0),
)  # fmt: skip

_CONCRETE = (
    _p("STFC", "Pa", "Strength of the concrete in compression, positive",
       "Résistance du béton en compression, positive", range=POSITIVE, usual=_STRENGTH),
    _p("EZER", "", "Strain of the strength in compression, positive (about 0.002)",
       "Déformation au pic de compression, positive (environ 0,002)", range=POSITIVE,
       usual=between(1e-4, 0.1)),
    _p("STFT", "Pa", "Strength of the concrete in tension",
       "Résistance du béton en traction", range=NOT_NEGATIVE, usual=between(0.0, 1e8)),
    _p("ZETA", "", "Slope behind the peak: 1 over the strain in which all strength would be "
       "lost; 0: that of the confinement",
       "Pente après le pic : inverse de la déformation qui épuiserait la résistance ; 0 : celle "
       "du confinement", range=NOT_NEGATIVE),
    _p("ST85", "Pa", "Stress that crushed concrete keeps",
       "Contrainte que garde le béton écrasé", range=NOT_NEGATIVE),
    _p("TRAF", "", "Strain at which a crack carries no more, relative to that of STFT",
       "Déformation à laquelle une fissure ne porte plus, rapportée à celle de STFT",
       range=Range(1.0, open_low=True)),
    _p("ALF1", "", "Confinement: how well the hoops hold the core (alpha)",
       "Confinement : efficacité des cadres (alpha)", range=NOT_NEGATIVE, default=0.0),
    _p("OME1", "", "Confinement: mechanical volume of hoops over that of concrete (omega)",
       "Confinement : volume mécanique des cadres sur celui du béton (oméga)",
       range=NOT_NEGATIVE, default=0.0),
    _p("FAMX", "", "How cracks close: < 0, at once; the gradual closing is not available",
       "Fermeture des fissures : < 0, d'un coup ; la fermeture progressive n'est pas disponible",
       default=-1.0),
    *(
        _unused(name, unit, "Gradual closing of cracks", "Fermeture progressive des fissures")
        for name, unit in (("STPT", "Pa"), ("FACL", ""), ("FAM1", ""), ("FAM2", ""))
    ),
)  # fmt: skip

_BEARINGS = (
    _p("QD", "N", "Force that the lead core holds at no displacement",
       "Effort que le noyau de plomb garde à déplacement nul", range=POSITIVE,
       usual=between(1.0, 1e9)),
    _p("KPOS", "N/m", "Shear stiffness once the lead core yields: that of the rubber",
       "Raideur horizontale quand le plomb plastifie : celle du caoutchouc", range=NOT_NEGATIVE),
    _p("ETA", "", "Exponent of Bouc and Wen: 1 rounds the yielding, more makes it sharp",
       "Exposant de Bouc et Wen : 1 arrondit la plastification, plus la rend vive",
       ("APPUI_PLOMB",), range=Range(1.0), default=1.0),
    _p("BETA", "", "Wen's beta, of the term in |du|, gamma being 1 - beta; 0.5: elastic unloading",
       "Bêta de Bouc et Wen, du terme en |du| ; gamma est 1 - bêta ; 0,5 : décharge élastique",
       ("APPUI_PLOMB",), range=between(0.5, 1.0), default=0.5),
    _p("RAYO", "m", "Radius of the bowl of a pendulum", "Rayon de la cuvette d'un pendule",
       ("APPUI_PENDULE",), range=POSITIVE, usual=between(0.1, 100.0)),
    # the law itself refuses a slider without FROT, or below 0
    _p("FROT", "", "Coulomb's coefficient of friction of the slider",
       "Coefficient de frottement de Coulomb du patin", ("APPUI_PENDULE",),
       usual=between(0.0, 0.5)),
)  # fmt: skip

_CLAY = (
    _p("E0", "", "Void ratio of the start", "Indice des vides initial", range=NOT_NEGATIVE,
       usual=between(0.1, 10.0)),
    _p("M", "", "Slope of the critical state: von Mises' stress over pressure",
       "Pente de l'état critique : contrainte de von Mises sur pression", ("CAM_CLAY",),
       range=POSITIVE, usual=between(0.1, 3.0)),
    _p("P0", "Pa", "Preconsolidation pressure of the start, positive",
       "Pression de préconsolidation initiale, positive", range=POSITIVE,
       usual=between(1e2, 1e9)),
    _p("KAPA", "", "Slope of unloading: void ratio over the logarithm of the pressure",
       "Pente élastique : indice des vides sur logarithme de la pression", range=POSITIVE,
       usual=between(1e-4, 1.0)),
    _p("LAMD", "", "Slope of first loading: void ratio over the logarithm of the pressure",
       "Pente plastique : indice des vides sur logarithme de la pression", range=POSITIVE,
       usual=between(1e-3, 2.0)),
    _p("G1", "Pa", "Shear modulus, constant", "Module de cisaillement, constant", range=POSITIVE,
       usual=between(1e4, 1e11)),
    _p("COHE", "Pa", "Cohesion of clay: 0, no other is available",
       "Cohésion de l'argile : 0, aucune autre n'est disponible", ("CAM_CLAY",), default=0.0),
)  # fmt: skip

WORDS = (*_STEEL, *_CONCRETE, *_BEARINGS, *_CLAY)

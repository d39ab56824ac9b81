"""Laws of behaviour and the further words of MODE.

`kind` is where the word stands: elasticity, plastic (behind PLASTIQUE), creep (behind FLUAGE),
joint, impedance (behind IMPEDANCE), contact (behind CONTACT), load, choice (of integration, axes).
"""

from __future__ import annotations

from ssilang.language.vocabulary.terms import Word


def _law(kind: str, name: str, en: str, fr: str) -> Word:
    return Word(name, en, fr, (), kind)


WORDS = (
    _law(
        "elasticity", "ELASTIQUE",
        "Linear elasticity; of joints: both faces stay bonded",
        "Élasticité linéaire ; pour les joints : les deux faces restent collées",
    ),
    _law(
        "elasticity", "ISOTROPE",
        "Elasticity that is the same in all directions: YOUN and NU",
        "Élasticité identique dans toutes les directions : YOUN et NU",
    ),
    _law(
        "elasticity", "ORTHOTROPE",
        "Elasticity with three planes of symmetry; axes by DIRECTION or RADIAL in MATE",
        "Élasticité à trois plans de symétrie ; repère par DIRECTION ou RADIAL dans MATE",
    ),
    _law(
        "elasticity", "ANISOTROPE",
        "General elasticity by the terms of the matrix of Hooke (D11 D21 D22 and so on)",
        "Élasticité générale par les termes de la matrice de Hooke (D11 D21 D22, etc.)",
    ),
    _law(
        "elasticity", "UNIDIRECTIONNEL",
        "Stiffness along one direction only, such as reinforcement in a body",
        "Rigidité suivant une seule direction, comme des armatures dans un massif",
    ),
    _law(
        "elasticity", "SECTION",
        "Beam TIMO whose section is a model of fibres with a material of its own; with PLASTIQUE "
        "SECTION fibres yield",
        "Poutre TIMO dont la section est un modèle de fibres avec son matériau ; avec PLASTIQUE "
        "SECTION les fibres plastifient",
    ),
    _law(
        "elasticity", "MODAL",
        "A point stands for a mode of vibration; its unknown is ALFA",
        "Un point représente un mode de vibration ; son inconnue est ALFA",
    ),
    _law(
        "elasticity", "STATIQUE",
        "A point stands for a static shape; its unknown is BETA",
        "Un point représente une déformée statique ; son inconnue est BETA",
    ),
    _law(
        "elasticity", "IMPEDANCE",
        "Spring and dashpot on a point (POI1) or between two points (SEG2)",
        "Ressort et amortisseur en un point (POI1) ou entre deux points (SEG2)",
    ),
    _law(
        "plastic", "PLASTIQUE",
        "Plasticity; the word behind it says which law, ISOTROPE (von Mises) if none does",
        "Plasticité ; le mot suivant dit quelle loi, ISOTROPE (von Mises) sans mot",
    ),
    _law(
        "plastic", "PARFAIT",
        "Von Mises' perfect plasticity: the strength SIGY stays",
        "Plasticité parfaite de von Mises : la limite SIGY ne change pas",
    ),
    _law(
        "plastic", "ISOTROPE",
        "Von Mises' plasticity with isotropic hardening by a curve (ECRO or TRAC)",
        "Plasticité de von Mises à écrouissage isotrope donné par une courbe (ECRO ou TRAC)",
    ),
    _law(
        "plastic", "J2",
        "Von Mises' plasticity whose strength grows from SIG0 to SIGI by an exponential (VELO), "
        "and by a line (KISO)",
        "Plasticité de von Mises dont la limite croît de SIG0 à SIGI par une exponentielle (VELO) "
        "et par une droite (KISO)",
    ),
    _law(
        "plastic", "CINEMATIQUE",
        "Von Mises' plasticity with linear kinematic hardening: SIGY and H",
        "Plasticité de von Mises à écrouissage cinématique linéaire : SIGY et H",
    ),
    _law(
        "plastic", "DRUCKER_PARFAIT",
        "Drucker and Prager's perfect, associated cone for soils, by two strengths",
        "Cône de Drucker et Prager pour les sols, parfait et associé, par deux résistances",
    ),
    _law(
        "plastic", "DRUCKER_PRAGER",
        "Drucker and Prager's cone for soils with hardening and a flow of its own",
        "Cône de Drucker et Prager pour les sols, avec écrouissage et écoulement propre",
    ),
    _law(
        "plastic", "RH_COULOMB",
        "Mohr and Coulomb's criterion for soils with rounded edges: cohesion COHE, angle PHI",
        "Critère de Mohr et Coulomb pour les sols, à arêtes arrondies : cohésion COHE, angle PHI",
    ),
    _law(
        "plastic", "IWAN",
        "Soil under cyclic shear by nested surfaces (Iwan, Mroz, Prevost) through a curve of "
        "G/Gmax: GGAM, or a hyperbola by GAMR",
        "Sol sous cisaillement cyclique par surfaces emboîtées (Iwan, Mroz, Prevost) suivant une "
        "courbe de G/Gmax : GGAM, ou une hyperbole par GAMR",
    ),
    _law(
        "plastic", "IWAN_PRESSION",
        "As IWAN, strengths in proportion to the pressure: GGAM or GAMR hold at PREF; for sand",
        "Comme IWAN, résistances proportionnelles à la pression : GGAM ou GAMR valent à PREF ; "
        "pour un sable",
    ),
    _law(
        "plastic", "CAM_CLAY",
        "Modified Cam-Clay: an ellipse that grows with the plastic compression; elasticity that "
        "stiffens with the pressure, G1 constant",
        "Cam-Clay modifié : une ellipse qui croît avec la compression plastique ; élasticité qui "
        "se raidit avec la pression, G1 constant",
    ),
    _law(
        "plastic", "PARFAIT_UNI",
        "Yielding along a fibre of a section, such as a steel bar in concrete: SIGY and H",
        "Plasticité le long d'une fibre de section, comme une armature : SIGY et H",
    ),
    _law(
        "plastic", "BETON_BAEL",
        "Fibre of concrete: no tension, parabola and rectangle in compression up to FC",
        "Fibre de béton : sans traction, parabole et rectangle en compression jusqu'à FC",
    ),
    _law(
        "plastic", "ACIER_UNI",
        "Steel of fibres and bars in cycles: curves of Menegotto and Pinto, buckling if wanted",
        "Acier de fibres et de barres en cycles : courbes de Menegotto et Pinto, flambage au "
        "besoin",
    ),
    _law(
        "plastic", "BETON_UNI",
        "Concrete of fibres and bars: Hognestad's parabola, softening, confinement, cracks",
        "Béton de fibres et de barres : parabole de Hognestad, adoucissement, confinement, "
        "fissures",
    ),
    _law(
        "plastic", "SECTION",
        "Behind PLASTIQUE in a beam TIMO: the fibres of its section yield by their own laws",
        "Derrière PLASTIQUE dans une poutre TIMO : les fibres de la section ont leurs lois",
    ),
    _law(
        "creep", "FLUAGE",
        "Creep; the law stands behind it (NORTON)",
        "Fluage ; la loi suit (NORTON)",
    ),
    _law(
        "creep", "NORTON",
        "Norton's creep with strain hardening: AF1 q**AF2 t**AF3 under a constant stress",
        "Fluage de Norton à écrouissage en déformation : AF1 q**AF2 t**AF3 à contrainte constante",
    ),
    _law(
        "joint", "JOINT_SDM",
        "Joint that opens (uplift): unilateral contact by the Strong Discontinuity Method, with "
        "tensile softening FU GF if wanted and Coulomb's friction FROT",
        "Joint qui s'ouvre (décollement) : contact unilatéral par la méthode des discontinuités "
        "fortes, avec adoucissement en traction FU GF au besoin et frottement de Coulomb FROT",
    ),
    _law(
        "joint", "JOINT_DILATANT",
        "Mohr-Coulomb joint that opens while it slides: friction angle PHI, dilatancy angle MU",
        "Joint de Mohr-Coulomb qui s'ouvre en glissant : angle de frottement PHI, de dilatance MU",
    ),
    _law(
        "joint", "COULOMB",
        "Mohr-Coulomb joint with friction angle FRIC, cohesion and tensile strength",
        "Joint de Mohr-Coulomb : angle de frottement FRIC, cohésion et résistance en traction",
    ),
    _law(
        "joint", "MACRO_SEMELLE",
        "A whole rectangular footing in one joint of two points: rocking with uplift; with COHE "
        "its ground yields",
        "Une semelle rectangulaire entière en un joint de deux points : balancement, décollement ; "
        "avec COHE son sol plastifie",
    ),
    _law(
        "joint", "MACRO_DISQUE",
        "A whole circular footing in one joint of two points: rocking with uplift; with COHE its "
        "ground yields",
        "Une fondation circulaire entière en un joint de deux points : balancement, décollement ; "
        "avec COHE son sol plastifie",
    ),
    _law(
        "joint", "MACRO_RESSORTS",
        "A footing on two springs at its edges, in one joint of two points: rocking with uplift",
        "Une fondation sur deux ressorts de bord, en un joint de deux points : balancement avec "
        "décollement",
    ),
    _law(
        "joint", "APPUI_PLOMB",
        "A bearing of rubber with a lead core between two points: hysteresis of Bouc and Wen",
        "Un appui de caoutchouc à noyau de plomb entre deux points : hystérésis de Bouc et Wen",
    ),
    _law(
        "joint", "APPUI_PENDULE",
        "A friction pendulum between two points: a slider that its bowl lifts, and that may part",
        "Un pendule à frottement entre deux points : un patin que sa cuvette soulève et qui peut "
        "décoller",
    ),
    _law(
        "joint", "CISAILLEMENT_ELASTIQUE",
        "Behind JOINT_SDM: shear stays elastic when the joint is open",
        "Derrière JOINT_SDM : le cisaillement reste élastique à l'ouverture",
    ),
    _law(
        "joint", "FROTTEMENT_SYMETRIQUE",
        "Behind JOINT_SDM: the tangent of friction is made symmetric, at the price of iterations",
        "Derrière JOINT_SDM : tangente du frottement rendue symétrique, au prix d'itérations",
    ),
    _law(
        "impedance", "ELASTIQUE",
        "Behind IMPEDANCE: a spring alone, force RAID u (default)",
        "Derrière IMPEDANCE : un ressort seul, force RAID u (par défaut)",
    ),
    _law(
        "impedance", "VOIGT",
        "Spring and dashpot side by side: RAID u + VISC u'",
        "Ressort et amortisseur en parallèle : RAID u + VISC u'",
    ),
    _law(
        "impedance", "REUSS",
        "Spring and dashpot one behind the other, in frequency",
        "Ressort et amortisseur en série, en fréquence",
    ),
    _law(
        "impedance", "COMPLEXE",
        "Stiffness and dashpot that are functions of the frequency (MOCO)",
        "Raideur et amortisseur fonctions de la fréquence (MOCO)",
    ),
    _law(
        "contact", "UNILATERAL",
        "Contact without friction: sides may part, not go into each other",
        "Contact sans frottement : les bords peuvent se séparer, non se pénétrer",
    ),
    _law(
        "contact", "FROTTANT",
        "Contact with friction; the law stands behind it: COULOMB or FROCABLE",
        "Contact avec frottement ; la loi suit : COULOMB ou FROCABLE",
    ),
    _law(
        "contact", "COULOMB",
        "Coulomb's friction between two sides: coefficient MU, cohesion COHE",
        "Frottement de Coulomb entre deux bords : coefficient MU, cohésion COHE",
    ),
    _law(
        "contact", "FROCABLE",
        "A cable that slides in a body with the friction of BPEL 99: FF and PHIF",
        "Un câble qui glisse dans un massif avec le frottement du BPEL 99 : FF et PHIF",
    ),
    _law(
        "contact", "MESC",
        "No node of the second side goes into the first (default)",
        "Aucun noeud du second bord n'entre dans le premier (par défaut)",
    ),
    _law(
        "contact", "SYME",
        "Nodes of either side stay out of the other",
        "Les noeuds de chaque bord restent hors de l'autre",
    ),
    _law(
        "contact", "FAIB",
        "No penetration in the mean over each cell of the second side",
        "Pas de pénétration en moyenne sur chaque maille du second bord",
    ),
    _law(
        "contact", "MORT",
        "No penetration in a mean weighted at each node of the second side (mortar)",
        "Pas de pénétration en moyenne pondérée à chaque noeud du second bord (mortier)",
    ),
    _law(
        "load", "PRESSION",
        "Behind CHARGEMENT: the load is a pressure on sides",
        "Derrière CHARGEMENT : le chargement est une pression sur des bords",
    ),
    *(_law("link", name, en, fr) for name, en, fr in (
        ("POINT_PLAN", "A point and a plane",
         "Un point et un plan"),
        ("POINT_POINT", "Two points",
         "Deux points"),
        ("POINT_CERCLE", "A point and a circle",
         "Un point et un cercle"),
        ("CERCLE_PLAN", "A circle that turns and a plane",
         "Un cercle qui tourne et un plan"),
        ("CERCLE_CERCLE", "A circle that turns and a fixed circle",
         "Un cercle qui tourne et un cercle fixe"),
        ("LIGNE_LIGNE", "The nodes of a line and another line",
         "Les noeuds d'une ligne et une autre ligne"),
        ("LIGNE_CERCLE", "A line and circles about it",
         "Une ligne et des cercles autour d'elle"),
        ("COUPLAGE", "A force on a mode from the motion of another",
         "Une force sur un mode due au mouvement d'un autre"),
        ("POLYNOMIALE", "A force on a mode, a product of powers of motions",
         "Une force sur un mode, produit de puissances de mouvements"),
        ("FROTTEMENT", "Behind a link: with friction",
         "Derrière une liaison : avec frottement"),
        ("MOBILE", "Behind POINT_CERCLE: the circle moves",
         "Derrière POINT_CERCLE : le cercle bouge"),
        ("DEPLACEMENT_PLASTIQUE", "Behind POINT_POINT: an elastic-plastic spring",
         "Derrière POINT_POINT : un ressort élastoplastique"),
        ("ROTATION_PLASTIQUE", "Behind POINT_POINT: an elastic-plastic hinge",
         "Derrière POINT_POINT : une rotule élastoplastique"),
        ("DEPLACEMENT", "Behind COUPLAGE: of the displacement",
         "Derrière COUPLAGE : selon le déplacement"),
        ("VITESSE", "Behind COUPLAGE: of the velocity",
         "Derrière COUPLAGE : selon la vitesse"),
    )),
    _law(
        "choice", "GAUSS",
        "Joints are integrated at Gauss points (default)",
        "Les joints s'intègrent aux points de Gauss (par défaut)",
    ),
    _law(
        "choice", "LOBATTO",
        "Joints are integrated at the nodes of their faces: no oscillation when they are very "
        "stiff",
        "Les joints s'intègrent aux noeuds de leurs faces : pas d'oscillation s'ils sont très "
        "raides",
    ),
    _law(
        "choice", "INTEGRE",
        "Number of points across the thickness of plastic shells DKT",
        "Nombre de points dans l'épaisseur des coques plastiques DKT",
    ),
    _law(
        "choice", "CONS",
        "Name of the constituent, to tell models on the same cells apart",
        "Nom du constituant, pour distinguer des modèles sur les mêmes mailles",
    ),
    _law(
        "choice", "DPGE",
        "Point that carries the motion of the section in generalised plane strain",
        "Point qui porte le mouvement de la section en déformation plane généralisée",
    ),
    _law(
        "choice", "LIBRE",
        "The axes of a joint of two points stay as they are given",
        "Le repère d'un joint de deux points reste celui qui est donné",
    ),
    _law(
        "choice", "LIE",
        "The axes of a joint of two points follow it",
        "Le repère d'un joint de deux points le suit",
    ),
)  # fmt: skip

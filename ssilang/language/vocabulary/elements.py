"""Finite elements: what each is. Cells, unknowns, points and parameters are the kernel's."""

from __future__ import annotations

from ssilang.language.vocabulary.terms import Word


def _element(kind: str, name: str, en: str, fr: str) -> Word:
    return Word(name, en, fr, (), kind)


_SIDES = {"POL5": 5, "POL6": 6, "POL7": 7, "POL8": 8, "POL9": 9, "PO10": 10, "PO11": 11, "PO12": 12}

WORDS = (
    _element(
        "body", "TRI3", "Plane triangle of 3 nodes, linear", "Triangle plan à 3 noeuds, linéaire"
    ),
    _element(
        "body", "TRI6", "Plane triangle of 6 nodes, quadratic",
        "Triangle plan à 6 noeuds, quadratique",
    ),
    _element(
        "body", "QUA4", "Plane quadrangle of 4 nodes, bilinear",
        "Quadrangle plan à 4 noeuds, bilinéaire",
    ),
    _element(
        "body", "QUA8", "Plane quadrangle of 8 nodes, quadratic",
        "Quadrangle plan à 8 noeuds, quadratique",
    ),
    *(
        _element(
            "body", name, f"Plane polygon of {n} sides (Voronoi meshes)",
            f"Polygone plan à {n} côtés (maillages de Voronoï)",
        )
        for name, n in _SIDES.items()
    ),
    _element(
        "body", "Q4RI", "Quadrangle of 4 nodes integrated at one point, hourglasses controlled",
        "Quadrangle à 4 noeuds intégré en un point, modes de sablier contrôlés",
    ),
    _element(
        "body", "Q8RI", "Quadrangle of 8 nodes with reduced integration (4 points)",
        "Quadrangle à 8 noeuds à intégration réduite (4 points)",
    ),
    _element(
        "body", "TET4", "Tetrahedron of 4 nodes, linear", "Tétraèdre à 4 noeuds, linéaire"
    ),
    _element(
        "body", "TE10", "Tetrahedron of 10 nodes, quadratic",
        "Tétraèdre à 10 noeuds, quadratique",
    ),
    _element("body", "PRI6", "Prism of 6 nodes, linear", "Prisme à 6 noeuds, linéaire"),
    _element("body", "PR15", "Prism of 15 nodes, quadratic", "Prisme à 15 noeuds, quadratique"),
    _element(
        "body", "P15R", "Prism of 15 nodes with reduced integration (6 points)",
        "Prisme à 15 noeuds à intégration réduite (6 points)",
    ),
    _element("body", "PYR5", "Pyramid of 5 nodes, linear", "Pyramide à 5 noeuds, linéaire"),
    _element("body", "CUB8", "Cube of 8 nodes, trilinear", "Cube à 8 noeuds, trilinéaire"),
    _element("body", "CU20", "Cube of 20 nodes, quadratic", "Cube à 20 noeuds, quadratique"),
    _element(
        "body", "C20R", "Cube of 20 nodes with reduced integration (8 points)",
        "Cube à 20 noeuds à intégration réduite (8 points)",
    ),
    *(
        _element(
            "incompressible", name,
            f"{plain} with the volume change taken in the mean, for nearly incompressible matter",
            f"{plain} à variation de volume moyennée, pour les matériaux presque incompressibles",
        )
        for name, plain in (
            ("ICT3", "TRI3"), ("ICT6", "TRI6"), ("ICQ4", "QUA4"), ("ICQ8", "QUA8"),
            ("ICT4", "TET4"), ("IC10", "TE10"), ("ICP6", "PRI6"), ("IC15", "PR15"),
            ("ICY5", "PYR5"), ("ICC8", "CUB8"), ("IC20", "CU20"),
        )
    ),
    _element(
        "body", "M1D2", "Line of a one-dimensional column, 2 nodes",
        "Ligne d'une colonne unidimensionnelle, 2 noeuds",
    ),
    _element(
        "body", "M1D3", "Line of a one-dimensional column, 3 nodes",
        "Ligne d'une colonne unidimensionnelle, 3 noeuds",
    ),
    _element(
        "structure", "BARR", "Bar of 2 nodes: a normal force only",
        "Barre à 2 noeuds : effort normal seul",
    ),
    _element(
        "structure", "BAR3", "Bar of 3 nodes: a normal force only",
        "Barre à 3 noeuds : effort normal seul",
    ),
    _element(
        "structure", "CERC", "Ring about the axis of revolution, on a point: a normal force only",
        "Cerce autour de l'axe de révolution, sur un point : effort normal seul",
    ),
    _element(
        "structure", "POUT",
        "Euler-Bernoulli beam with cubic deflection, exact for loads at its nodes; SECY SECZ add "
        "shear flexibility",
        "Poutre d'Euler-Bernoulli à flèche cubique, exacte sous charges nodales ; SECY SECZ "
        "ajoutent la souplesse d'effort tranchant",
    ),
    _element(
        "structure", "TIMO",
        "Timoshenko beam, deflections and rotations linear, one integration point; also beams "
        "with a section of fibres",
        "Poutre de Timoshenko, flèches et rotations linéaires, un point d'intégration ; aussi les "
        "poutres à section de fibres",
    ),
    _element(
        "structure", "TUYA", "Pipe, straight or bent, under inner pressure",
        "Tuyau, droit ou coudé, sous pression interne",
    ),
    _element(
        "section", "POJS", "Fibre of a beam's section given by a point and its area SECT",
        "Fibre d'une section de poutre donnée par un point et son aire SECT",
    ),
    _element(
        "section", "TRIS", "Triangle of a beam's section, three fibres",
        "Triangle d'une section de poutre, trois fibres",
    ),
    _element(
        "section", "QUAS", "Quadrangle of a beam's section, four fibres",
        "Quadrangle d'une section de poutre, quatre fibres",
    ),
    _element(
        "shell", "DKT", "Thin flat shell, triangle of 3 nodes, without transverse shear",
        "Coque mince plane, triangle à 3 noeuds, sans cisaillement transverse",
    ),
    _element(
        "shell", "COQ3", "Thin flat shell, triangle of 3 nodes; stresses at one point",
        "Coque mince plane, triangle à 3 noeuds ; contraintes en un point",
    ),
    _element(
        "shell", "COQ4",
        "Flat shell of 4 nodes with transverse shear (Mindlin); RIGI holds the rotation about the "
        "normal by a small spring, which no stress of SIGM shows and BSIG does not give back",
        "Coque plane à 4 noeuds avec cisaillement transverse (Mindlin) ; RIGI tient la rotation "
        "autour de la normale par un petit ressort, qu'aucune contrainte de SIGM ne montre et que "
        "BSIG ne rend pas",
    ),
    _element(
        "shell", "COQ6", "Thick curved shell, triangle of 6 nodes, two layers of points",
        "Coque épaisse courbe, triangle à 6 noeuds, deux couches de points",
    ),
    _element(
        "shell", "COQ8", "Thick curved shell, quadrangle of 8 nodes, two layers of points",
        "Coque épaisse courbe, quadrangle à 8 noeuds, deux couches de points",
    ),
    _element(
        "shell", "COQ2", "Thin shell by its meridian line: of revolution, Fourier or plane",
        "Coque mince par sa méridienne : de révolution, Fourier ou plane",
    ),
    _element(
        "shell", "SHB8", "Shell made of cubes of 8 nodes, five points across the thickness",
        "Coque faite de cubes à 8 noeuds, cinq points dans l'épaisseur",
    ),
    _element(
        "load", "SEG2", "Loaded side of 2 nodes (pressure)",
        "Bord chargé à 2 noeuds (pression)",
    ),
    _element(
        "load", "SEG3", "Loaded side of 3 nodes (pressure)",
        "Bord chargé à 3 noeuds (pression)",
    ),
    _element(
        "joint", "JOI1",
        "Joint of two points, lower point first: normal, shear and rotation springs, or a law",
        "Joint de deux points, le point inférieur d'abord : ressorts normal, tangents, de "
        "rotation, ou une loi",
    ),
    _element(
        "joint", "JOI2", "Joint between two lines of 2 nodes (cells of RACC)",
        "Joint entre deux lignes à 2 noeuds (mailles de RACC)",
    ),
    _element(
        "joint", "JOI3", "Joint between two lines of 3 nodes",
        "Joint entre deux lignes à 3 noeuds",
    ),
    _element(
        "joint", "JOT3", "Joint between two triangles of 3 nodes (cells of LIAI)",
        "Joint entre deux triangles à 3 noeuds (mailles de LIAI)",
    ),
    _element(
        "joint", "JOI4", "Joint between two quadrangles of 4 nodes",
        "Joint entre deux quadrangles à 4 noeuds",
    ),
    _element(
        "joint", "JOT6", "Joint between two triangles of 6 nodes",
        "Joint entre deux triangles à 6 noeuds",
    ),
    _element(
        "joint", "JOI8", "Joint between two quadrangles of 8 nodes",
        "Joint entre deux quadrangles à 8 noeuds",
    ),
    *(
        _element(
            "joint", name, f"{plain} integrated at its nodes (MODE ... LOBATTO)",
            f"{plain} intégré à ses noeuds (MODE ... LOBATTO)",
        )
        for name, plain in (
            ("JNO2", "JOI2"), ("JNO3", "JOI3"), ("JNT3", "JOT3"), ("JNO4", "JOI4"),
        )
    ),
    _element(
        "shape", "MODAL", "Point that stands for a mode of vibration",
        "Point qui représente un mode de vibration",
    ),
    _element(
        "shape", "STATIQUE", "Point that stands for a static shape",
        "Point qui représente une déformée statique",
    ),
    _element(
        "link", "LIAI", "Point of a link of DYNE (MODE ... LIAISON)",
        "Point d'une liaison de DYNE (MODE ... LIAISON)",
    ),
    _element(
        "impedance", "IMP1", "Spring and dashpot on one point",
        "Ressort et amortisseur en un point",
    ),
    _element(
        "impedance", "IMP2", "Spring and dashpot between two points",
        "Ressort et amortisseur entre deux points",
    ),
    _element(
        "contact", "COS2", "Side of contact in the plane, line of 2 nodes",
        "Bord de contact dans le plan, ligne à 2 noeuds",
    ),
    _element(
        "contact", "COT3", "Side of contact in space, triangle of 3 nodes",
        "Face de contact dans l'espace, triangle à 3 noeuds",
    ),
    _element(
        "contact", "COQU", "Side of contact in space, quadrangle of 4 nodes",
        "Face de contact dans l'espace, quadrangle à 4 noeuds",
    ),
    _element(
        "generic", "BBAR", "The elements for nearly incompressible matter on any cells (ICQ4 ...)",
        "Les éléments pour matériaux presque incompressibles sur toutes mailles (ICQ4 ...)",
    ),
    _element(
        "generic", "POLY", "The elements of a mesh of polygons (TRI3 QUA4 POL5 ...)",
        "Les éléments d'un maillage de polygones (TRI3 QUA4 POL5 ...)",
    ),
)  # fmt: skip

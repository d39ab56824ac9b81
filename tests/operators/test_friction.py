"""Coulomb friction between meshes, cables that slide: closed forms of statics and of motion."""

import math

import numpy as np
import pytest
from together import together

BLOCK = """
OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ;
C = DROI 6 (-3. 0.) (3. 0.) ; Z = C TRAN 2 (0. -2.) ;
A = DROI 4 (-1. 0.) (1. 0.) ; S = A TRAN 2 (0. 1.) ;
MS = MODE S MECANIQUE ELASTIQUE ; MZ = MODE Z MECANIQUE ELASTIQUE ;
B = MATE (MS ET MZ) YOUN 1.E9 NU 0. RHO 2000. ;
BASE = BLOQ UX UY Z ; T = TABLE ;
"""


@pytest.mark.parametrize("method", ["MESC", "SYME", "FAIB", "MORT"])
def test_block_pushed_to_and_fro_slides_at_mu_times_its_load(found, method):
    """Held below mu N, then mu N against the slip, whichever way it goes."""
    forces = found(
        BLOCK + f"K = MODE (INVE C) CONTACT FROTTANT COULOMB A {method} ; "
        "D = BLOQ UX (COTE 2 S) ; T.MODELE = MS ET MZ ET K ; "
        "T.CARACTERISTIQUES = B ET (MATE K MU 0.3) ; T.BLOCAGES_MECANIQUES = BASE ET D ; "
        "T.TEMPS_CALCULES = PROG 0. PAS 1. 4. ; "
        "T.CHARGEMENT = (CHAR MECA (PRES MASS MS 1.E5 (COTE 3 S)) "
        "(EVOL MANU (PROG 0. 1. 9.) (PROG 0. 1. 1.))) ET (CHAR DIMP (DEPI D 1.E-3) "
        "(EVOL MANU (PROG 0. 1. 2. 3. 4.) (PROG 0. 0. .01 1. 0.))) ; PASAPAS T ; L = PROG ; "
        "REPE I 4 ; L = L ET (MAXI (RESU (EXCO FX (REAC D (T.DEPLACEMENTS . &I))))) ; FIN I ;",
        "L",
    ).values
    assert abs(forces[0]) < 1.0
    assert 0.0 < forces[1] < 6e4 * (1 - 1e-3)
    assert forces[2:] == pytest.approx([6e4, -6e4], rel=1e-9)


def test_cohesion_holds_over_the_area(found):
    force = found(
        BLOCK + "K = MODE (INVE C) CONTACT FROTTANT COULOMB A FAIB ; "
        "D = BLOQ UX (COTE 2 S) ; T.MODELE = MS ET MZ ET K ; "
        "T.CARACTERISTIQUES = B ET (MATE K MU 0.3 COHE 2.E4) ; "
        "T.BLOCAGES_MECANIQUES = BASE ET D ; T.TEMPS_CALCULES = PROG 0. 1. 2. ; "
        "T.CHARGEMENT = (CHAR MECA (PRES MASS MS 1.E5 (COTE 3 S)) "
        "(EVOL MANU (PROG 0. 1. 9.) (PROG 0. 1. 1.))) ET (CHAR DIMP (DEPI D 1.E-3) "
        "(EVOL MANU (PROG 0. 1. 2.) (PROG 0. 0. 1.))) ; PASAPAS T ; "
        "F = MAXI (RESU (EXCO FX (REAC D (T.DEPLACEMENTS . 2)))) ;",
        "F",
    )
    assert force == pytest.approx(0.3 * 2e5 + 2 * 2e4, rel=1e-9)


SLOPE = (
    BLOCK
    + """
K = MODE (INVE C) CONTACT FROTTANT COULOMB A FAIB ;
T.MODELE = MS ET MZ ET K ; T.CARACTERISTIQUES = B ET (MATE K MU 0.5) ;
T.BLOCAGES_MECANIQUES = BASE ; MA = MASS MS B ;
W = MA * (MANU CHPO S 2 UX (9.81 * (SIN {angle})) UY (-9.81 * (COS {angle})) ) ;
T.CHARGEMENT = CHAR MECA W (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
"""
)


def test_block_on_a_slope_under_the_friction_angle_stays(found):
    moved = found(
        SLOPE.format(angle=26.0) + "T.TEMPS_CALCULES = PROG 0. 1. ; PASAPAS T ; "
        "U = MAXI (EXCO UX (T.DEPLACEMENTS . 1)) ABS ;",
        "U",
    )
    assert moved < 1e-3


START = """
T1 = TABLE ; T1.MODELE = T.MODELE ; T1.CARACTERISTIQUES = T.CARACTERISTIQUES ;
T1.BLOCAGES_MECANIQUES = BASE ET H ; T1.TEMPS_CALCULES = PROG 0. 1. ; PASAPAS T1 ;
T.DEPLACEMENTS = TABLE ; T.DEPLACEMENTS.0 = T1.DEPLACEMENTS.1 ; T.DYNAMIQUE = VRAI ;
P = S POIN PROC (0. .5) ; T.RHO_INF = 0.5 ;
"""


def test_block_slides_down_with_its_constant_acceleration(found):
    """g (sin - mu cos), and the energy that friction takes."""
    x, v, lost = found(
        SLOPE.format(angle=40.0) + "H = BLOQ UX S ; T1 = TABLE ; "
        "T1.CHARGEMENT = T.CHARGEMENT ;"
        + START.replace("T1 = TABLE ;", "", 1)
        + "T.TEMPS_CALCULES = PROG 0. PAS .002 .2 ; PASAPAS T ; "
        "X = EXTR (T.DEPLACEMENTS . 100) UX P ; V = EXTR (T.VITESSES . 100) UX P ; "
        "L = T.ENERGIES . 'DISSIPEE' ; E = EXTR L (DIME L) ;",
        "X",
        "V",
        "E",
    )
    a = 9.81 * (math.sin(math.radians(40)) - 0.5 * math.cos(math.radians(40)))
    # the body's own waves, started by the release, count for some tenths of a per cent
    assert x == pytest.approx(0.5 * a * 0.04, rel=0.015)
    assert v == pytest.approx(a * 0.2, rel=0.015)
    weight = 2000.0 * 2.0 * 9.81 * math.cos(math.radians(40))
    assert lost == pytest.approx(0.5 * weight * x, rel=0.015)


def test_block_above_a_rough_ground_falls_freely(found):
    """Nothing touches at the start: there is gravity alone."""
    lifted = BLOCK.replace("(-1. 0.) (1. 0.)", "(-1. .1) (1. .1)")
    speed = found(
        SLOPE.replace(BLOCK, lifted).format(angle=0.0)
        + "T.DYNAMIQUE = VRAI ; T.TEMPS_CALCULES = PROG 0. PAS .01 .1 ; PASAPAS T ; "
        "V = MINI (EXCO UY (T.VITESSES . 10)) ;",
        "V",
    )
    assert speed == pytest.approx(-0.981, rel=1e-9)


def test_rubbing_oscillator_loses_the_same_stretch_in_each_half_period_and_sticks(found):
    """`2 mu N/k` a half period, until the spring is weaker than friction."""
    swing, rest, speed = found(
        SLOPE.format(angle=0.0).replace("MU 0.5", "MU 0.1") + "H = BLOQ UX S ; "
        "R = APPU UX (631655. / (NBNO S)) S ; T.RIGIDITE_CONSTANTE = R ; T1 = TABLE ; "
        "T1.CHARGEMENT = T.CHARGEMENT ET (CHAR DIMP (DEPI H .03) "
        "(EVOL MANU (PROG 0. 1.) (PROG 0. 1.))) ;"
        + START.replace("T1 = TABLE ;", "", 1)
        + "T.TEMPS_CALCULES = PROG 0. PAS .002 .8 ; PASAPAS T ; "
        "X = EXTR (T.DEPLACEMENTS . 125) UX P ; Y = EXTR (T.DEPLACEMENTS . 400) UX P ; "
        "V = EXTR (T.VITESSES . 400) UX P ;",
        "X",
        "Y",
        "V",
    )
    stretch = 2 * 0.1 * 4000.0 * 9.81 / 631655.0
    assert swing == pytest.approx(-(0.03 - stretch), abs=2e-4)
    assert rest == pytest.approx(0.03 - 2 * stretch, abs=3e-4)
    assert abs(speed) < 1e-3


ARC = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; O = 0. 0. ;
Q = CERC 6 (8. 0.) O (0. 8.) ; R = CERC 6 (12. 0.) O (0. 12.) ; S = REGL 3 Q R ;
C = CERC {n} (10. 0.) O (0. 10.) ; P1 = C POIN INIT ; P2 = C POIN FINA ;
MC = MODE C MECANIQUE ELASTIQUE BARR ; MS = MODE S MECANIQUE ELASTIQUE ;
K = MODE C CONTACT FROTTANT FROCABLE S ;
A = MATE MC YOUN 2.E11 NU .3 SECT 1.E-3 ;
G = A ET (MATE MS YOUN 3.E10 NU .2) ET (MATE K FF {f} PHIF {phi}) ;
T = TABLE ; T.MODELE = MS ET MC ET K ; T.CARACTERISTIQUES = G ;
"""


def test_cable_round_an_arc_loses_tension_as_the_capstan(found):
    """Euler and Eytelwein: exp(-(f alpha + phi s))."""
    f, phi, n = 0.3, 0.01, 60
    low, high, precise = found(
        ARC.format(n=n, f=f, phi=phi) + "T.BLOCAGES_MECANIQUES = (BLOQ DEPL S) ET "
        "(BLOQ DEPL P1) ; T.TEMPS_CALCULES = PROG 0. 1. ; "
        "T.CHARGEMENT = CHAR MECA (FORC FX -1.E5 P2) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ; "
        "PASAPAS T ; E = EXCO EFFX (REDU (T.CONTRAINTES . 1) MC) ; A1 = MINI E ; A2 = MAXI E ; "
        f"TP = TABLE ; TP . 'FF' = {f} ; TP . 'PHIF' = {phi} ; PR = PREC MC A 1.E5 TP ; "
        "D = (MAXI ABS (E - (EXCO EFFX PR))) / 1.E5 ;",
        "A1",
        "A2",
        "D",
    )
    half = 0.5 * math.pi / 2 / n
    length = 10.0 * (math.pi / 2 - half)
    assert low == pytest.approx(
        1e5 * math.exp(-f * (math.pi / 2 - 2 * half) - phi * length), rel=1e-3
    )
    assert high < 1e5
    assert precise < 1e-3


@together("sizes", [(0.0, 0.003, 0.0), (0.2, 0.002, 0.0), (0.2, 0.002, 0.004), (0.0, 0.003, 0.3)])
def test_tensions_of_a_prestressed_cable(found, sizes):
    """Friction, and a slip of the anchorage that takes E S times itself from the tensions."""
    f, phi, slip = sizes
    pulled, held_back, far = found(
        "OPTI DIME 2 ELEM SEG2 ; O = 0. 0. ; P = 50. 0. ; Q = 0. 50. ; L1 = CERC 200 P O Q ; "
        "L2 = DROI 100 Q (-30. 50.) ; L = L1 ET L2 ; "
        "M = MODE L MECANIQUE ELASTIQUE ARMATURE BARR ; "
        f"A = MATE M YOUN 1.9E11 SECT 1.E-3 FF {f} PHIF {phi} RMU0 1. GANC {slip} ; "
        f"T = TABLE ; T . 'FF' = {f} ; T . 'PHIF' = {phi} ; T . 'RMU0' = 1. ; "
        "P1 = PREC M A 1.E6 P ; P2 = PREC M A T 1.E6 P ; "
        "R = INTG M (P2 - P1) EFFX ; X = MINI P2 ; ",
        "R",
        "X",
        "X",
    )
    angle, length = math.pi / 2, 25 * math.pi + 30.0
    assert far == pytest.approx(1e6 * math.exp(-f * angle - phi * length), rel=2e-3)
    assert pulled == pytest.approx(slip * 1.9e8, rel=2e-3, abs=1e-3)
    assert held_back == far


MINDLIN = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; R = 10. ; A = .08 ; NU = .3 ; B1 = -1. 0. ; B2 = 1. 0. ;
C = (DROI B1 (-.15 0.) 'DINI' .1 'DFIN' .005) ET (DROI 60 (-.15 0.) (.15 0.)) ET
  (DROI (.15 0.) B2 'DINI' .005 'DFIN' .1) ; ELIM 1.E-6 C ;
Z = C TRAN (0. -1.) 'DINI' .005 'DFIN' .12 ; D1 = C PLUS (0. 0.) ;
S = D1 TRAN (0. 1.) 'DINI' .005 'DFIN' .12 ; X = COOR 1 S ;
DEPL S PLUS (NOMC (X * X / (2. * R) * (1. - (COOR 2 S))) 'UY' NATURE DISCRET) ;
MS = MODE S MECANIQUE ELASTIQUE ; MZ = MODE Z MECANIQUE ELASTIQUE ;
K = MODE (INVE C) CONTACT FROTTANT COULOMB D1 'MESC' ;
P = A * A * PI * 1.E9 / (8. * R * (1. - (NU * NU))) ;
TOP = S POIN DROI (-1. 1.) (1. 1.) 1.E-4 ; BAS = Z POIN DROI (-1. -1.) (1. -1.) 1.E-4 ;
H = TOP POIN PROC (0. 1.) ; T = TABL ; T . 'MODELE' = MS ET MZ ET K ;
T . 'CARACTERISTIQUES' = (MATE (MS ET MZ) YOUN 1.E9 'NU' NU) ET (MATE K MU .4) ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ DEPL BAS) ET (RELA ENSE UY TOP) ET (RELA ENSE UX TOP) ;
T . 'CHARGEMENT' = (CHAR MECA (FORC (0. (-1. * P)) H)
  (EVOL MANU (PROG 0. 1. 2.) (PROG 0. 1. 1.))) ET (CHAR MECA (FORC ((.64 * .4 * P) 0.) H)
  (EVOL MANU (PROG 0. 1. 2.) (PROG 0. 0. 1.))) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. 1.5 2. ; PASAPAS T ;
RE = REDU (T . 'REACTIONS' . 3) D1 ; FX = EXCO RE FX ; FY = EXCO RE FY ;
LX = PROG ; LP = PROG ; LQ = PROG ;
REPE B (NBNO D1) ; Q = D1 POIN &B ; LX = LX ET (COOR 1 Q) ;
  LP = LP ET (EXTR FY 'SCAL' Q) ; LQ = LQ ET (EXTR FX 'SCAL' Q) ; FIN B ;
"""


def test_cylinder_pressed_and_pushed_sticks_in_the_middle_as_cattaneo_and_mindlin_say(found):
    """Two like bodies, Q = 0.64 mu P: sticking over 0.6 of the half width of contact."""
    x, p, q, load = (np.asarray(getattr(v, "values", v)) for v in found(
        MINDLIN, "LX", "LP", "LQ", "P"
    ))  # fmt: skip
    a, mu, h = 0.08, 0.4, 0.005
    most = 2 * load / (math.pi * a) * h
    hertz = most * np.sqrt((1 - (x / a) ** 2).clip(0))
    mindlin = mu * (hertz - 0.6 * most * np.sqrt((1 - (x / (0.6 * a)) ** 2).clip(0)))
    inner = np.abs(x) < 0.95 * a  # the last node's share of the edge is a matter of the mesh
    assert np.abs(p - hertz)[inner].max() < 0.02 * most
    # the slope is without bound where sticking ends, between two nodes
    assert np.abs(-q - mindlin)[inner].max() < 0.03 * mu * most
    sliding = p > 0.01 * most
    ratio = np.abs(q[sliding]) / (mu * p[sliding])
    assert ratio.max() <= 1 + 1e-9
    stuck = np.abs(x[sliding])[ratio < 1 - 1e-6]
    assert 0.6 * a - h <= stuck.max() <= 0.6 * a + h

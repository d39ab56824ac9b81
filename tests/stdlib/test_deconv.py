"""DECONV, DECONV3D: a soil without structure moves as the free field does."""

import numpy as np
import pytest
from script_runs import found, ran

from ssilang.language.say.diagnostics import sentence

SOIL = "NU1 = 0.3 ; G1 = 2.E8 ; E1 = 2. * (1. + NU1) * G1 ; RO1 = 2000. ; "
MATRICES = (
    "MA1 = MATE M1 'YOUN' E1 'NU' NU1 'RHO' RO1 ; "
    "K1 = RIGI M1 MA1 ; MM1 = MASS M1 MA1 ; "
    "C1 = 0.05 * ((4. * PI * 100. / 25. * MM1) ET (1. / (PI * 25.) * K1)) ; "
)
SIGNAL = (
    "LT = PROG 0. PAS 0.02 1.2 ; LX = (LT - 0.6) * (PI * 4.) ; LX = LX * LX ; "
    "ACC1 = EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX))) ; "
)
LAYER = (
    "T1 = TABL ; T1 . 1 = TABL ; T1 . 1 . 'FRONTIERE' = BOR1 ; T1 . 1 . 'MASSE_VOLUMIQUE' = RO1 ; "
    "T1 . 1 . 'POISSON' = NU1 ; T1 . 1 . 'YOUNG' = E1 ; T1 . 1 . 'AMORTISSEMENT' = 0.05 ; "
)
RUN = (
    "TD = TABL ; TD . 'RIGI' = K1 ; TD . 'MASS' = MM1 ; TD . 'AMOR' = C1 ET (T2 . 'AMOR') ; "
    "TD . 'CHAR' = T2 . 'CHAR' ; TD . 'FREQ' = T2 . 'FCDYN' ; TD . 'INST' = LT ; "
    "TR = DYNAMIC TD ; LA = PROG ; LB = PROG ; REPE B1 (DIME LT) ; "
    "LA = LA ET (EXTR (TR . &B1 . 'ACCE') PA COMP1) ; "
    "LB = LB ET (EXTR (TR . &B1 . 'ACCE') PB COMP1) ; FIN B1 ; "
)


PLANE = (
    "OPTI DIME 2 MODE {mode} ELEM QUA8 ; PA = 0. 0. ; PB = 8. 0. ; "
    "S1 = TRAN 4 (DROI 4 PA PB) (0. -8.) ; BOR1 = COTE 2 S1 ; FON1 = COTE 3 S1 ; BOR2 = COTE 4 S1 ;"
    "M1 = MODE S1 MECANIQUE ELASTIQUE ; "
)


@pytest.mark.parametrize(
    ("mode", "direction", "component"),
    [("FOUR 1", "HORI", "UR"), ("FOUR 0", "VERT", "UZ")],
)
@pytest.mark.parametrize("dampers", ["LYSMER", "WHITE"])
def test_round_soil_moves_as_the_free_field(mode, direction, component, dampers):
    la, lb, given = found(
        PLANE.format(mode=mode) + SOIL + MATRICES + SIGNAL + LAYER
        + f"T2 = DECONV T1 FON1 M1 '{direction}' ACC1 5. 20. 20. '{dampers}' ; "
        + f"COMP1 = MOT '{component}' ; " + RUN + "LG = EXTR ACC1 'ORDO' ;",
        "LA", "LB", "LG",
    )  # fmt: skip
    assert np.abs(given.values).max() == pytest.approx(1.0)
    assert la.values == pytest.approx(given.values, abs=4e-3)
    assert lb.values == pytest.approx(given.values, abs=4e-3)


@pytest.mark.parametrize(
    ("held", "component", "options"),
    [("UX", "UY", "'VERT' ACC1 5. 20. 20. 'LYSMER'"), ("UY", "UX", "'HORI' ACC1 5. 20. 20.")],
    ids=["pressure waves", "shear waves"],
)
def test_a_plane_half(held, component, options):
    """The left side is the axis of symmetry of pressure waves, of antisymmetry of shear waves."""
    la, lb, given = found(
        PLANE.format(mode="PLAN DEFO") + SOIL + MATRICES + SIGNAL + LAYER
        + f"K1 = K1 ET (BLOQ '{held}' BOR2) ; T2 = DECONV T1 FON1 M1 {options} ; "
        + f"COMP1 = MOT '{component}' ; " + RUN + "LG = EXTR ACC1 'ORDO' ;",
        "LA", "LB", "LG",
    )  # fmt: skip
    assert la.values == pytest.approx(given.values, abs=4e-3)
    assert lb.values == pytest.approx(given.values, abs=4e-3)


@pytest.mark.parametrize("component", ["UX", "UY", "UZ"])
def test_box_of_soil(component):
    la, lb, given = found(
        "OPTI DIME 3 ELEM CU20 ; PA = 0. 0. 0. ; PB = 4. 4. 0. ; "
        "V1 = VOLU 'TRAN' 3 (TRAN 1 (DROI 1 PA (4. 0. 0.)) (0. 4. 0.)) (0. 0. -6.) ; "
        "ELIM 0.001 (V1 ET PB) ; BOR1 = FACE 3 V1 ; FON1 = FACE 2 V1 ; "
        "M1 = MODE V1 MECANIQUE ELASTIQUE ; " + SOIL + MATRICES + SIGNAL + LAYER
        + f"COMP1 = MOT '{component}' ; T2 = DECONV3D T1 PA FON1 M1 MA1 COMP1 ACC1 5. 20. 20. ; "
        + RUN + "LG = EXTR ACC1 'ORDO' ;",
        "LA", "LB", "LG",
    )  # fmt: skip
    assert la.values == pytest.approx(given.values, abs=4e-3)
    assert lb.values == pytest.approx(given.values, abs=4e-3)


@pytest.mark.parametrize(("direction", "component"), [("HORI", "UX"), ("VERT", "UY")])
def test_layers_given_from_the_bottom_up(direction, component):
    held = "UY" if component == "UX" else "UX"
    la, lb, given = found(
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA8 ; PA = 0. 0. ; PB = 6. 0. ; "
        "S1 = TRAN 3 (DROI 3 PA PB) (0. -3.) ; S2 = TRAN 3 (COTE 3 S1) (0. -4.) ; "
        "M1 = MODE S1 MECANIQUE ELASTIQUE ; M2 = MODE S2 MECANIQUE ELASTIQUE ; "
        "A1 = MATE M1 'YOUN' 2.E8 'NU' 0.2 'RHO' 1800. ; "
        "A2 = MATE M2 'YOUN' 9.E8 'NU' 0.4 'RHO' 2200. ; "
        "AL1 = 4. * PI * 100. / 25. ; BE1 = 1. / (PI * 25.) ; KA = RIGI M1 A1 ; KB = RIGI M2 A2 ; "
        "MA = MASS M1 A1 ; MB = MASS M2 A2 ; MM1 = MA ET MB ; "
        "K1 = KA ET KB ET (BLOQ '" + held + "' ((COOR 1 (S1 ET S2)) POIN 'INFERIEUR' 1.E-3)) ; "
        "C1 = (0.05 * ((AL1 * MA) ET (BE1 * KA))) ET (0.02 * ((AL1 * MB) ET (BE1 * KB))) ; "
        + SIGNAL
        + "T1 = TABL ; T1 . 1 = TABL ; T1 . 1 . 'FRONTIERE' = COTE 4 S2 ; "
        "T1 . 1 . 'YOUNG' = 9.E8 ; "
        "T1 . 1 . 'MASSE_VOLUMIQUE' = 2200. ; T1 . 1 . 'POISSON' = 0.4 ; "
        "T1 . 1 . 'AMORTISSEMENT' = 0.02 ; "
        "T1 . 2 = TABL ; T1 . 2 . 'FRONTIERE' = COTE 2 S1 ; T1 . 2 . 'YOUNG' = 2.E8 ; "
        "T1 . 2 . 'MASSE_VOLUMIQUE' = 1800. ; T1 . 2 . 'POISSON' = 0.2 ; "
        "T1 . 2 . 'AMORTISSEMENT' = 0.05 ; "
        f"T2 = DECONV T1 (COTE 3 S2) (M1 ET M2) '{direction}' ACC1 5. 20. 20. 'LYSMER' ; "
        f"COMP1 = MOT '{component}' ; " + RUN + "LG = EXTR ACC1 'ORDO' ;",
        "LA", "LB", "LG",
    )  # fmt: skip
    assert la.values == pytest.approx(given.values, abs=1e-3)
    assert lb.values == pytest.approx(given.values, abs=1e-3)


def test_accelerations_asked_for_and_given_inside():
    surface, base = found(
        PLANE.format(mode="FOUR 1") + SOIL + SIGNAL + LAYER
        + "P1 = TABL ; P1 . 'ENTREE' = TABL ; P1 . 'ENTREE' . 'NATURE' = CHAI 'INSIDE' ; "
        "P1 . 'ENTREE' . 'CONTROLE' = BOR1 POIN 'PROC' (0. -100.) ; "
        "P1 . 1 = MANU 'POI1' (BOR1 POIN 'PROC' PA) ; P1 . 2 = BOR1 POIN 'PROC' (0. -100.) ; "
        "T2 = DECONV T1 FON1 M1 'HORI' ACC1 5. 20. 20. 'LYSMER' P1 ; "
        "LS = IPOL LT (T2 . 'ACCE' . 1) ; LB = IPOL LT (T2 . 'ACCE' . 2) ; LG = EXTR ACC1 'ORDO' ; "
        "D1 = MAXI (LB - LG) 'ABS' ;",
        "LS", "D1",
    )  # fmt: skip
    assert base < 1e-3
    assert np.abs(surface.values).max() > 1.05


@pytest.mark.parametrize(("cells", "too_coarse"), [(4, True), (5, False)])
def test_a_layer_whose_nodes_are_too_far_apart_is_told(cells, too_coarse):
    """At the cut-off of 4 Hz and 31.62 m/s, 8 heights a wavelength are 0.988 m."""
    soil = PLANE.format(mode="PLAN DEFO").replace("TRAN 4", f"TRAN {cells}")
    result = ran(
        soil + SOIL.replace("2.E8", "2.E6") + SIGNAL + LAYER
        + "T2 = DECONV T1 FON1 M1 'HORI' ACC1 5. 20. 4. ;"
        + "T3 = DECONV T1 FON1 M1 'HORI' ACC1 5. 20. 4. ;"
    )  # fmt: skip
    told = [w for w in result.session.warnings if w.code.endswith("layer-too-coarse")]
    assert len(told) == too_coarse
    if too_coarse:
        text, _ = sentence(told[0], "en")
        assert "from 0 to 8 m" in text
        assert "1 m apart: at 4 Hz and 31.62 m/s they may be 0.988 m (8 a wavelength)" in text

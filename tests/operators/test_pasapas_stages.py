"""PASAPAS with models, supports and characteristics given in time: building and digging."""

import numpy as np
import pytest
from script_runs import ran, refused
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.curves.curve import Load

LAYERS = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
L0 = DROI 1 (0. 0.) (1. 0.) ; S1 = L0 TRAN 1 (0. 1.) ; L1 = S1 COTE 3 ;
S2 = L1 TRAN 1 (0. 1.) ; L2 = S2 COTE 3 ; S = S1 ET S2 ; P1 = L1 POIN 1 ; P2 = L2 POIN 1 ;
M1 = MODE S1 'MECANIQUE' {law} ; M2 = MODE S2 'MECANIQUE' {law} ;
MA = MATE (M1 ET M2) 'YOUN' 1.E6 'NU' 0. 'SIGY' 1.E9 ;
T = TABL ; T . 'MODELE' = M1 ET M2 ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' S) ET (BLOQ 'UY' L0) ;
TT = TABL ; TT . 0 = 0. ; TT . 1 = 2. ; TM = TABL ;
E1 = EVOL 'MANU' (PROG 0. 1. 4.) (PROG 0. 1. 1.) ;
E2 = EVOL 'MANU' (PROG 0. 1. 2. 3.) (PROG 0. 0. 0. 1.) ;
F1 = FORC (0. -1000.) L1 ; F2 = FORC (0. -1000.) L2 ;
T . 'TEMPS_CALCULES' = PROG 1. 1.5 2. 2.5 3. ;
"""
ELASTIC, PLASTIC = "'ELASTIQUE'", "'ELASTIQUE' 'PLASTIQUE' 'PARFAIT'"


def run(text, tmp_path, law=ELASTIC):
    if law == ELASTIC:
        text = text.replace("'SIGY' 1.E9", "")
    return ran(text.replace("{law}", law), output_directory=tmp_path).session.root.find


def stress(table, number):
    blocks = table.get("CONTRAINTES").get(number).blocks
    return [b.components["SMYY"].mean() for b in blocks if "SMYY" in b.components]


@together("law", [ELASTIC, PLASTIC])
def test_a_layer_built_on_a_loaded_one_comes_without_stress(law, tmp_path):
    text = f"""{LAYERS}
    TM . 0 = M1 ; TM . 1 = M1 ET M2 ;
    T . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MECA' F2 E2) ET (CHAR 'MODE' TT TM) ;
    PASAPAS T ; U1 = PROG ; U2 = PROG ;
    REPE B 5 ; U1 = U1 ET (EXTR (T . 'DEPLACEMENTS' . &B) 'UY' P1) ; FIN B ;
    REPE B 3 ; U2 = U2 ET (EXTR (T . 'DEPLACEMENTS' . (&B + 2)) 'UY' P2) ; FIN B ;
    """
    find = run(text, tmp_path, law)
    table = find("T")
    assert [v for _, v in table.get("TEMPS").items()] == [0.0, 1.0, 1.5, 2.0, 2.5, 3.0]
    u = 1e-3 * np.array([-1, -1, -1, -1.5, -2])
    assert find("U1").values == pytest.approx(u, rel=1e-9)
    assert find("U2").values == pytest.approx([0.0, -1e-3, -2e-3], rel=1e-9, abs=1e-12)
    assert [len(m.zones) for _, m in table.get("MODELES").items()] == [1, 1, 1, 2, 2, 2]
    assert stress(table, 1) == pytest.approx([-1000.0])
    assert stress(table, 3) == pytest.approx([-1000.0, 0.0], abs=1e-6)
    assert stress(table, 5) == pytest.approx([-2000.0, -1000.0], rel=1e-9)


def test_a_layer_dug_away_takes_its_load_path_with_it(tmp_path):
    text = f"""{LAYERS}
    TM . 0 = M1 ET M2 ; TM . 1 = M1 ; BH = BLOQ 'UY' L2 ;
    T . 'BLOCAGES_MECANIQUES' = (T . 'BLOCAGES_MECANIQUES') ET BH ;
    T . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MODE' TT TM) ; PASAPAS T ;
    """
    table = run(text, tmp_path)("T")
    assert stress(table, 2) == pytest.approx([-500.0, 500.0])
    assert stress(table, 3) == pytest.approx([-1000.0])


def test_cells_that_come_within_one_zone_have_no_stress(tmp_path):
    layers = LAYERS.replace("M1 = MODE S1", "MT = MODE S").replace("M1 ET M2", "MT")
    text = f"""{layers.replace("M2 = MODE S2 'MECANIQUE' {law} ;", "")}
    TM . 0 = REDU MT S1 ; TM . 1 = MT ;
    T . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MODE' TT TM) ; PASAPAS T ;
    """
    table = run(text, tmp_path)("T")
    assert stress(table, 2) == pytest.approx([-1000.0])
    assert np.sort(table.get("CONTRAINTES").get(5).blocks[0].components["SMYY"].mean(axis=1)) == (
        pytest.approx([-1000.0, 0.0], abs=1e-6)
    )


def test_supports_that_come_hold_what_has_moved(tmp_path):
    text = f"""{LAYERS}
    TM . 0 = BLOQ 'UX' P1 ; TM . 1 = BLOQ 'UY' L1 ; HELD = CHAR 'BLOM' (BLOQ 'UX' P1) ;
    T . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MECA' F2 E2) ET
      (CHAR 'DIMP' (DEPI (TM . 1) -1.E-3) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.))) ET
      (CHAR 'BLOM' TT TM) ET HELD ; PASAPAS T ;
    """
    table = run(text, tmp_path)("T")
    assert stress(table, 5) == pytest.approx([-1000.0, -1000.0], rel=1e-9)


def test_stiffer_layers_keep_the_strains_with_which_they_were_built(tmp_path):
    """The upper one came unstrained on a lower one that had gone down."""
    text = f"""{LAYERS.replace("NU' 0.", "NU' 0.2")}
    TM . 0 = M1 ; TM . 1 = M1 ET M2 ; TN = TABL ; TN . 0 = MA ; TN . 1 = MA ;
    TN . 2 = MATE (M1 ET M2) 'YOUN' 3.E6 'NU' 0.3 ; TN . 3 = TN . 2 ; OUBL T 'CARACTERISTIQUES' ;
    TI = TABL ; TI . 0 = 0. ; TI . 1 = 2.4 ; TI . 2 = 2.45 ; TI . 3 = 9. ;
    T . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MECA' F2 E2) ET (CHAR 'MODE' TT TM)
      ET (CHAR 'MATE' TI TN) ; PASAPAS T ; U = T . 'DEPLACEMENTS' . 5 ;
    U1 = EXTR U 'UY' P1 ; U2 = EXTR U 'UY' P2 ;
    """
    find = run(text, tmp_path)
    held = [(1.0 - nu**2) / young for young, nu in ((1e6, 0.2), (3e6, 0.3))]
    assert stress(find("T"), 5) == pytest.approx([-2000.0, -1000.0], rel=1e-9)
    sides = [b.components["SMXX"].mean() for b in find("T").get("CONTRAINTES").get(5).blocks]
    assert sides == pytest.approx([-600.0, -300.0], rel=1e-9)
    assert find("U1") == pytest.approx(-2000.0 * held[1], rel=1e-9)
    assert find("U2") - find("U1") == pytest.approx(1000.0 * (held[0] - held[1]), rel=1e-9)


WARM = """{mesh} M1 = MODE S 'MECANIQUE' {law} ;
EY = EVOL 'MANU' 'T' (PROG 0. 100.) 'YOUN' (PROG 2.E11 1.E11) ;
EA = NUAG 'COMP' 'T' 0. 100. 'COMP' 'ALPH' 1.E-5 2.E-5 ;
ES = EVOL 'MANU' 'T' (PROG 0. 100.) 'SIGY' (PROG 1.E8 5.E7) ;
MA = MATE M1 'YOUN' EY 'NU' 0. 'ALPH' EA 'TREF' 20. 'TALP' 10. {more} ;
E1 = EVOL 'MANU' (PROG 0. 1. 2. 3. 4.) (PROG 20. 60. 100. 60. 20.) ; E2 = E1 ** 0 ;
T = TABL ; T . 'MODELE' = M1 ; T . 'CARACTERISTIQUES' = MA ; T . 'BLOCAGES_MECANIQUES' = {held} ;
T . 'CHARGEMENT' = (CHAR 'T' (MANU 'CHPO' S 'T' 1.) E1) ET (CHAR 'MECA' {force} E2) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. 2. 3. 4. ; PASAPAS T ;
"""
PLANE = "OPTI DIME 2 MODE PLAN CONT ELEM {e} ; O = 0. 0. ; "
BARS = PLANE.format(e="SEG2") + "L = 2. 0. ; S = DROI 2 O L ; "
QUADS = PLANE.format(e="QUA4") + "K = DROI 1 O (0. 1.) ; S = K TRAN 2 (2. 0.) ; L = COTE 3 S ; "
SPACE = "OPTI DIME 3 ELEM {e} ; O = 0. 0. 0. ; K = DROI 1 O (0. 1. 0.) ; "
BRICKS = SPACE.format(e="CUB8") + (
    "K = K TRAN 1 (0. 0. 1.) ; S = K VOLU TRAN 2 (2. 0. 0.) ; L = FACE 2 S ; "
)
SHELLS = SPACE.format(e="TRI3") + "S = K TRAN 2 (2. 0. 0.) ; L = COTE 3 S ; "
HELD = {BARS: "(BLOQ 'UX' O) ET (BLOQ 'UY' S)", QUADS: "(BLOQ 'UX' K) ET (BLOQ 'UY' O)",
        BRICKS: "(BLOQ 'UX' K) ET (BLOQ 'UY' O) ET (BLOQ 'UZ' (O ET (K POIN 'PROC' (0. 1. 0.))))",
        SHELLS: "(BLOQ 'UX' K) ET (BLOQ 'UY' O) ET (BLOQ 'UZ' 'ROTA' S)"}  # fmt: skip


@together(
    "mesh, element, more, size",
    [
        (BARS, "BARR", "'SECT' 0.5", 0.5),
        (BARS, "POUT", "'SECT' 0.5 'INRZ' 0.1 'DZ' 0.1", 0.5),
        (QUADS, "", "'DIM3' 0.5", 1.0),
        (BRICKS, "", "", 1.0),
        (SHELLS, "DKT", "'EPAI' 0.5", 0.5),
    ],
)
@pytest.mark.parametrize("plastic", [False, True])
@pytest.mark.parametrize("stuck", [False, True])
def test_bars_whose_characteristics_depend_on_temperature(
    mesh, element, more, size, plastic, stuck, tmp_path
):
    """Pulled by 30 MPa, or held at both ends: stresses are E(T) (strain - thermal - plastic)."""
    law = f"'ELASTIQUE' {PLASTIC[11:] if plastic else ''} {element}"
    held = HELD[mesh] + " ET (BLOQ 'UX' L)" * stuck
    flat = mesh in (BARS, QUADS)
    force = f"(FORC ({'1.5E7 0.' if flat else '1.5E7 0. 0.' if size < 1 else '3.E7 0. 0.'}) L)"
    said = {"mesh": mesh, "law": law, "held": held, "force": force}
    find = ran(WARM.format(more=more + " 'SIGY' ES" * plastic, **said),
               output_directory=tmp_path).session.root.find  # fmt: skip
    left, wanted, found = 0.0, [], []
    for i, t in enumerate([60.0, 100.0, 60.0, 20.0], start=1):
        young, alpha, limit = 2e11 - 1e9 * t, 1e-5 + 1e-7 * t, 1e8 - 5e5 * t
        free = alpha * (t - 10.0) - 1.2e-5 * 10.0
        sigma = -young * (free + left) if stuck else 3e7
        if plastic and abs(sigma) > limit:
            sigma = np.sign(sigma) * limit
            left = -free - sigma / young
        stresses = find("T").get("CONTRAINTES").get(i).blocks[0].components
        u = find("T").get("DEPLACEMENTS").get(i).components["UX"].values.max()
        along = sum(v.mean() for n, v in stresses.items() if n in ("EFFX", "SMXX", "N11", "N22"))
        found += [along / size, 1e9 * u * (not stuck)]
        wanted += [sigma, 2e9 * (sigma / young + free) * (not stuck)]
    np.testing.assert_allclose(found, wanted, rtol=1e-8, atol=1.0)


def test_a_load_of_models_that_holds_fields_is_refused():
    text = LAYERS.replace("{law}", ELASTIC).replace("'SIGY' 1.E9", "")
    text += "T . 'CHARGEMENT' = CHAR 'MODE' F1 E1 ; PASAPAS T ;"
    assert "the load MODE gives no MMODEL" in refused(text)


def test_a_footing_built_on_settled_soil_stands_on_its_joint(tmp_path):
    text = """
    OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
    L0 = DROI 1 (0. 0.) (1. 0.) ; S1 = L0 TRAN 1 (0. 1.) ; LA = INVE (S1 COTE 3) ;
    LB = LA PLUS (0. 0.) ; S2 = LB TRAN 1 (0. 1.) ; L2 = S2 COTE 3 ;
    OPTI ELEM RAC2 ; J = RACC 1.E-6 LB LA ;
    M1 = MODE S1 'MECANIQUE' ; M2 = MODE S2 'MECANIQUE' ;
    MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' JOI2 ; MT = M1 ET M2 ET MJ ;
    T = TABL ; T . 'MODELE' = MT ; T . 'CARACTERISTIQUES' =
      (MATE (M1 ET M2) 'YOUN' 1.E6 'NU' 0.) ET (MATE MJ 'KN' 1.E8 'KS' 1.E8) ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' (S1 ET S2)) ET (BLOQ 'UY' L0) ;
    TT = TABL ; TT . 0 = 0. ; TT . 1 = 1.5 ; TM = TABL ; TM . 0 = M1 ; TM . 1 = MT ;
    T . 'CHARGEMENT' = (CHAR 'MECA' (FORC (0. -1000.) LA) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)))
      ET (CHAR 'MECA' (FORC (0. -1000.) L2) (EVOL 'MANU' (PROG 0. 1. 2. 9.) (PROG 0. 0. 1. 1.)))
      ET (CHAR 'MODE' TT TM) ;
    T . 'TEMPS_CALCULES' = PROG 1. 1.5 2. ; PASAPAS T ; U = T . 'DEPLACEMENTS' . 3 ;
    W = (EXTR U 'UY' (LB POIN 1)) - (EXTR U 'UY' (LA POIN 1)) ;
    """
    result = ran(text, output_directory=tmp_path)
    assert not result.session.warnings
    find = result.session.root.find
    assert stress(find("T"), 3) == pytest.approx([-2000.0, -1000.0], rel=1e-6)
    assert find("W") == pytest.approx(-1000.0 / 1e8, rel=1e-6)  # traction over KN


@together(
    "element, given, stiffness, held",
    [
        ("JOI1", "'KS' 1.E4", "'KN'", "(BLOQ 'DEPL' 'ROTA' P) ET (BLOQ 'UX' 'RZ' Q)"),
        ("BARR", "'NU' 0. 'SECT' 1.", "'YOUN'", "(BLOQ 'DEPL' P) ET (BLOQ 'UX' Q)"),
    ],
)
def test_what_is_stiffer_from_now_on_keeps_what_it_carries(element, given, stiffness, held):
    """1.E3 N on 1.E4 N/m, then 1.E3 N more on 3.E4 N/m: of both only the second is by the new."""
    find = ran(f"""
    OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P = 0. 0. ; Q = 0. 1. ; L = MANU 'SEG2' P Q ;
    ML = MODE L 'MECANIQUE' 'ELASTIQUE' '{element}' ; T = TABL ; T . 'MODELE' = ML ;
    T . 'CARACTERISTIQUES' = MATE ML {given} {stiffness} 1.E4 ;
    T . 'BLOCAGES_MECANIQUES' = {held} ; T . 'CHARGEMENT' =
      CHAR 'MECA' (FORC (0. -1.E3) Q) (EVOL 'MANU' (PROG 0. 2.) (PROG 0. 2.)) ;
    T . 'TEMPS_CALCULES' = PROG 1. ; PASAPAS T ;
    T . 'CARACTERISTIQUES' = MATE ML {given} {stiffness} 3.E4 ;
    T . 'TEMPS_CALCULES' = PROG 2. ; PASAPAS T ; U = PROG ;
    REPE B 2 ; U = U ET (EXTR (T . 'DEPLACEMENTS' . &B) 'UY' Q) ; FIN B ;
    """).session.root.find
    assert find("U").values == pytest.approx([-0.1, -0.1 - 1.0 / 30.0])
    (block,) = find("T").get("CONTRAINTES").get(2).blocks
    assert block.components["EFFX"].mean() == pytest.approx(-2000.0)


def test_loads_in_place_of_entries_stay_in_the_table_whatever_becomes_of_the_run(tmp_path):
    """As parts of CHARGEMENT they give the same; a procedure of the user ends the second run."""
    text = (
        LAYERS.replace("{law}", ELASTIC).replace("'SIGY' 1.E9", "")
        + """
    DEBP PERSO1 T1*TABLE ; T1 . 'SEEN' = TYPE (T1 . 'MODELE') ; SI T1 . 'END' ; ERRE 'E' ;
      FINSI ; FINP ;
    TM . 0 = M1 ; TM . 1 = M1 ET M2 ; B = T . 'BLOCAGES_MECANIQUES' ; R = COPI T ;
    R . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MODE' TT TM) ; PASAPAS R ;
    T . 'MODELE' = CHAR 'MODE' TT TM ; T . 'CHARGEMENT' = CHAR 'MECA' F1 E1 ;
    T . 'BLOCAGES_MECANIQUES' = CHAR 'BLOM' B ;
    T . 'PROCEDURE_PERSO1' = VRAI ; T . 'END' = FAUX ; PASAPAS T ;
    SEEN = EGA T . 'SEEN' 'CHARGEME' ;
    SUM = MAXI 'ABS' ((R . 'DEPLACEMENTS' . 5) - (T . 'DEPLACEMENTS' . 5)) ;
    LARGEST = MAXI 'ABS' (R . 'DEPLACEMENTS' . 5) ;
    T . 'TEMPS_CALCULES' = PROG 3.5 ; T . 'END' = VRAI ; PASAPAS T ;
    """
    )
    result = run_text(text, tmp_path)
    find = result.session.root.find
    table = find("T")
    assert [e.code for e in result.errors] == ["erre"], result.message
    assert find("SEEN") is True
    assert find("SUM") <= 1e-12 * find("LARGEST") > 0.0
    assert all(isinstance(table.get(w), Load) for w in ("MODELE", "BLOCAGES_MECANIQUES"))
    assert len(table.get("CHARGEMENT").parts) == 1

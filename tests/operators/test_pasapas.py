"""PASAPAS: static and dynamic steps, going on, temperatures, initial stresses, PERSO1."""

import numpy as np
import pytest
from script_runs import failed, finder, ran
from together import together

from ssilang.language.say.diagnostics import sentence

BAR = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
P1 = 0. 0. ; P2 = 2. 0. ; L = DROI 4 P1 P2 ; S = L TRAN 1 (0. 1.) ;
G = S COTE 4 ; R = S COTE 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ;
MA = MATE MO 'YOUN' 1.E6 'NU' 0. 'RHO' 1000. 'ALPH' 1.E-5 ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' G) ET (BLOQ 'UY' L) ;
F = FORC (1000. 0.) R ;
EV = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;
T . 'CHARGEMENT' = CHAR 'MECA' F EV ;
T . 'TEMPS_CALCULES' = PROG 0.25 'PAS' 0.25 1. ;
"""


def test_results_by_number_with_the_initial_state_first(tmp_path):
    find = finder(BAR + "PASAPAS T ; U = EXTR (T . 'DEPLACEMENTS' . 4) 'UX' P2 ;", tmp_path)
    T = find("T")
    assert [i for i, _ in T.get("TEMPS").items()] == [0, 1, 2, 3, 4]
    assert [v for _, v in T.get("TEMPS").items()] == pytest.approx([0, 0.25, 0.5, 0.75, 1])
    assert find("U") == pytest.approx(2e-3, rel=1e-12)
    stress = T.get("CONTRAINTES").get(2).blocks[0].components["SMXX"]
    assert stress == pytest.approx(500.0, rel=1e-12)
    reactions = T.get("REACTIONS").get(4).components["FX"].values
    assert reactions.sum() == pytest.approx(-1000.0)
    assert (T.get("CONV"), T.get("ERREUR")) == (True, False)


def test_saved_times(tmp_path):
    find = finder(BAR + "T . 'TEMPS_SAUVES' = PROG 0.5 1. ; PASAPAS T ;", tmp_path)
    assert [v for _, v in find("T").get("TEMPS").items()] == pytest.approx([0, 0.5, 1])


def test_second_call_goes_on_and_reprise_goes_back(tmp_path):
    text = f"""{BAR}
    PASAPAS T ; T . 'TEMPS_CALCULES' = PROG 0.5 'PAS' 0.5 2. ;
    T . 'CHARGEMENT' = CHAR 'MECA' F (EVOL 'MANU' (PROG 0. 2.) (PROG 0. 2.)) ;
    PASAPAS T ; N1 = DIME (T . 'TEMPS') ; U1 = EXTR (T . 'DEPLACEMENTS' . 6) 'UX' P2 ;
    T . 'REPRISE' = 0.5 ; PASAPAS T ; N2 = DIME (T . 'TEMPS') ;
    U2 = EXTR (T . 'DEPLACEMENTS' . 5) 'UX' P2 ;
    """
    find = finder(text, tmp_path)
    assert (find("N1"), find("N2")) == (7, 6)
    assert find("U1") == pytest.approx(4e-3)
    assert find("U2") == pytest.approx(4e-3)


def test_restrained_expansion_presses(tmp_path):
    text = f"""{BAR.replace("(BLOQ 'UX' G)", "(BLOQ 'UX' (G ET R))")}
    T . 'CHARGEMENT' = CHAR 'T' (MANU 'CHPO' S 1 'T' 10.) EV ; PASAPAS T ;
    """
    T = finder(text, tmp_path)("T")
    stress = T.get("CONTRAINTES").get(2).blocks[0].components["SMXX"]
    assert stress == pytest.approx(-1e6 * 1e-5 * 5.0, rel=1e-10)


def test_a_warm_body_goes_on_from_the_stresses_of_its_time(tmp_path):
    """Pulled and heated: in one run, and from fields that another run has left at t = 0.5."""
    warm = "T . 'CHARGEMENT' = (CHAR 'MECA' F EV) ET (CHAR 'T' (MANU 'CHPO' S 1 'T' 10.) EV) ; "
    again = """PASAPAS T ; T2 = TABL ; REPE B 4 ;
    M = EXTR (MOTS 'MODELE' 'CARACTERISTIQUES' 'BLOCAGES_MECANIQUES' 'CHARGEMENT') &B ;
    T2 . M = T . M ; FIN B ;
    T2 . 'TEMPS_CALCULES' = PROG 0.75 1. ; T2 . 'TEMPS' = TABL ; T2 . 'TEMPS' . 0 = 0.5 ;
    REPE B 2 ; M = EXTR (MOTS 'DEPLACEMENTS' 'CONTRAINTES') &B ; T2 . M = TABL ;
    T2 . M . 0 = T . M . 2 ; FIN B ; PASAPAS T2 ; """
    find = finder(BAR + warm + again, tmp_path)
    for step, held in ((1, 3), (2, 4)):
        whole, part = find("T"), find("T2")
        for word in ("UX", "UY"):
            exact, u = (x.get("DEPLACEMENTS").get(i).components[word].values for x, i in
                        ((whole, held), (part, step)))  # fmt: skip
            np.testing.assert_allclose(u, exact, rtol=1e-9, atol=1e-15)
        exact, s = (x.get("CONTRAINTES").get(i).blocks[0].components["SMXX"] for x, i in
                    ((whole, held), (part, step)))  # fmt: skip
        np.testing.assert_allclose(s, exact, rtol=1e-9)


@pytest.mark.parametrize(
    ("rate", "parts", "before", "moved"),
    [("1.E-2", "T", 0.0, 0.045), ("1.E-2", "T MECA", 0.0, -1.455), ("1.E-5", "MECA", 0.0, -1.5),
     ("0.", "MECA T", 0.0, -1.5), ("0.", "MECA", -5e3, -1.0), ("0.", "T MECA", 2e3, -1.7)],
)  # fmt: skip
def test_a_warm_elastic_joint_opens(rate, parts, before, moved):
    """2 m of a joint of 1.E4 N/m3 below a stiff plate that 3.E4 N push and that may expand.

    What stands in the joint `before` carries its share. The plate's own ALP1 is none of the joint,
    whose temperature is the mean of its sides: the ground's stays nought.
    """
    loads = {"MECA": "CHAR 'MECA' (FORC (0. -3.E4) P) EV"}
    loads["T"] = "CHAR 'T' ((MANU CHPO S 1 'T' 9.) ET (MANU CHPO B 1 'T' 0.)) EV"
    script = f"""OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
    A = DROI 2 (-1. 0.) (1. 0.) ; S = A TRAN 1 (0. 1.) ; B = A PLUS (0. 0.) ; J = RACC 1.E-6 A B ;
    MS = MODE S 'MECANIQUE' 'ELASTIQUE' ; MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOI2' ;
    MO = MS ET MJ ;
    T = TABL ; T . 'MODELE' = MO ; G = S ET J ; P = S POIN 'PROC' (0. 1.) ;
    EV = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; T . 'CARACTERISTIQUES' = MATE MO
      'YOUN' 1.E12 'NU' 0. 'ALPH' 0. 'KN' 1.E4 'KS' 1.E4 'ALPN' {rate} ;
    T . 'CARACTERISTIQUES' = (T . 'CARACTERISTIQUES') ET (MANU 'CHML' MS 'ALP1' 1. 'STRESSES') ;
    C = TABL ; T . 'CONTRAINTES' = C ;
    C . 0 = MANU 'CHML' MJ 'SMS' 0. 'SMN' {before} 'TYPE' 'CONTRAINTES' 'STRESSES' ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' B) ET (BLOQ 'UX' S) ;
    T . 'CHARGEMENT' = {" ET ".join(f"({loads[part]})" for part in parts.split())} ;
    T . 'TEMPS_CALCULES' = PROG 0. 1. ; PASAPAS T ; U = T . 'DEPLACEMENTS' . 1 ;
    L = EXTR (EVOL CHPO U UY A) 'ORDO' ;"""
    find = finder(script)
    np.testing.assert_allclose(find("L").values, moved, rtol=1e-6, atol=1e-6)
    blocks = find("T").get("CONTRAINTES").get(1).blocks
    (found,) = (b.components["SMN"] for b in blocks if "SMN" in b.components)
    np.testing.assert_allclose(found, -1.5e4 if "MECA" in parts else 0.0, rtol=1e-6, atol=0.01)


@pytest.mark.parametrize("first", [0, 2])
def test_initial_stress_is_balanced_by_the_first_load(first, tmp_path):
    text = f"""{BAR}
    T . 'CONTRAINTES' = TABL ; T . 'CONTRAINTES' . {first} = MANU 'CHML' MO 'SMXX' 250. 'SMYY' 0.
      'SMZZ' 0. 'SMXY' 0. 'TYPE' 'CONTRAINTES' 'STRESSES' ;
    PASAPAS T ; U = EXTR (T . 'DEPLACEMENTS' . {first + 1}) 'UX' P2 ;
    """
    find = finder(text, tmp_path)
    assert find("U") == pytest.approx(0.0, abs=1e-15)
    stress = find("T").get("CONTRAINTES").get(first + 4).blocks[0].components["SMXX"]
    assert stress == pytest.approx(1000.0, rel=1e-10)


def test_user_procedure_runs_after_each_time_and_may_stop(tmp_path):
    text = """
    DEBP PERSO1 T*TABLE ;
      T . 'COMPTE' = (T . 'COMPTE') + 1 ; W = T . 'WTABLE' ;
      SI ((W . 'PAS' NEG (T . 'COMPTE')) OU (W . 'T_FINAL' NEG (T . 'ESTIMATION' . 'TEMPS'))) ;
        ERRE 5 ;
      FINSI ;
      SI ((T . 'COMPTE') EGA 3) ; T . 'ARRET' = VRAI ; FINSI ;
    FINP ;
    """
    text += BAR + "T . 'COMPTE' = 0 ; T . 'PROCEDURE_PERSO1' = VRAI ; PASAPAS T ;"
    T = finder(text, tmp_path)("T")
    assert T.get("COMPTE") == 3
    assert len(T.get("TEMPS")) == 4


def test_dynamic_steps_follow_a_mode(tmp_path):
    text = f"""{BAR}
    OUBL T 'CHARGEMENT' ; T . 'DYNAMIQUE' = VRAI ;
    X = COOR 1 S ; T . 'DEPLACEMENTS' = TABL ; T . 'VITESSES' = TABL ;
    T . 'VITESSES' . 0 = NOMC 'UX' (SIN (45. * X)) ;
    T . 'TEMPS_CALCULES' = PROG 2.E-3 'PAS' 2.E-3 0.1 ; PASAPAS T ;
    U = EXTR (T . 'DEPLACEMENTS' . 31) 'UX' P2 ;
    """
    w = np.pi / 4 * np.sqrt(1e6 / 1000.0)  # first axial mode of a bar of 2 m
    assert finder(text, tmp_path)("U") == pytest.approx(np.sin(w * 0.062) / w, rel=1e-2)


def test_unilateral_support_opens_and_closes(tmp_path):
    text = (
        BAR.replace("(BLOQ 'UX' G)", "(BLOQ 'UX' G) ET B").replace(
            "T = TABL ;", "B = BLOQ 'MAXI' 'UX' R ; T = TABL ;"
        )
        + """
    T . 'CHARGEMENT' = (T . 'CHARGEMENT') ET
       (CHAR 'DIMP' (DEPI B 1.E-3) (EVOL 'MANU' (PROG 0. 1.) (PROG 1. 1.))) ;
    PASAPAS T ; U1 = EXTR (T . 'DEPLACEMENTS' . 1) 'UX' P2 ;
    U4 = EXTR (T . 'DEPLACEMENTS' . 4) 'UX' P2 ; RE = REAC (T . 'DEPLACEMENTS' . 4) B ;
    """
    )
    find = finder(text, tmp_path)
    assert find("U1") == pytest.approx(5e-4, rel=1e-10)
    assert find("U4") == pytest.approx(1e-3, rel=1e-10)
    assert find("RE").components["FX"].values.sum() == pytest.approx(-500.0, rel=1e-9)


def test_joint_of_the_wrong_unit_scale_is_reported(tmp_path):
    text = """
    OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
    P1 = 0. 0. ; P2 = 1. 0. ; L = DROI 2 P1 P2 ; S = L TRAN 1 (0. 1.) ; L2 = L PLUS (0. 0.) ;
    J = RACC 1.E-3 L L2 ;
    MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 1.E9 'NU' 0.2 ;
    MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; MAJ = MATE MJ 'KN' KN0 'KS' KN0 ;
    T = TABL ; T . 'MODELE' = MO ET MJ ; T . 'CARACTERISTIQUES' = MA ET MAJ ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' 'UY' L2) ET (BLOQ 'UX' S) ;
    T . 'CHARGEMENT' = CHAR 'MECA' (FORC (0. -1.E3) (S COTE 3)) ; T . 'TEMPS_CALCULES' = PROG 1. ;
    PASAPAS T ;
    """
    for stiffness, warned in (("1.E19", True), ("1.E10", False)):
        result = ran(text.replace("KN0", stiffness), output_directory=tmp_path)
        assert any("units" in sentence(w, "en")[1] for w in result.session.warnings) is warned


def test_user_procedure_sees_the_state_of_each_time_and_changes_the_load(tmp_path):
    text = """
    DEBP PERSO1 T*TABLE ;
      E = T . 'ESTIMATION' ; T . 'VUS' = (T . 'VUS') ET (EXTR (E . 'DEPLACEMENTS') 'UX' P2) ;
      SI ((E . 'TEMPS') EGA 0.5) ;
        T . 'WTABLE' . 'CHARGEMENT' = (T . 'CHARGEMENT') ET (T . 'CHARGEMENT') ;
      FINS ;
    FINP ;
    """
    text += BAR + "T . 'VUS' = PROG ; T . 'PROCEDURE_PERSO1' = VRAI ; "
    text += "T . 'TEMPS_SAUVES' = PROG 1. ; PASAPAS T ;"
    T = finder(text, tmp_path)("T")
    times = np.array([0.25, 0.5, 0.75, 1.0])
    wanted = 2e-3 * times * np.where(times > 0.5, 2, 1)  # sigma L / E of the bar of 2 m
    assert T.get("VUS").values == pytest.approx(wanted, rel=1e-9)
    assert [v for _, v in T.get("TEMPS").items()] == [0.0, 1.0]
    stress = T.get("CONTRAINTES").get(1).blocks[0].components["SMXX"]
    assert stress == pytest.approx(2000.0, rel=1e-9)
    assert T.get("CONTINUATION").get("TEMPS") == 1.0


def test_user_procedures_see_where_nodes_were_and_are(tmp_path):
    """REEV_MEC before the first step and after each; FOR0 and FOR around the step's own motion."""
    text = """
    DEBP REEV_MEC T*TABLE N*ENTIER ;
      T . 'VUS' = (T . 'VUS') ET (N * (1. + (T . 'TT' . 'TEMPS'))) ;
      SI (N EGA 0) ; T . 'WTABLE' . 'CHARGEMENT' = CHAR 'MECA' (2. * F) EV ; FINS ;
    FINP ;
    DEBP PERSO1 T*TABLE ;
      W = T . 'WTABLE' ; C = FORM (W . 'FOR') ; X = COOR 1 P2 ; FORM (W . 'FOR0') ;
      T . 'OU' = (T . 'OU') ET (X - (COOR 1 P2)) ; SI (NON (W . 'MEC1')) ; ERRE 'MEC1' ; FINS ;
      SI (NEG (MAXI (W . 'MAT_MEC') (MOTS 'YOUN')) 1.E6) ; ERRE 'MAT_MEC' ; FINS ;
    FINP ;
    """
    text += BAR + "T . 'VUS' = PROG ; T . 'OU' = PROG ; T . 'GRANDS_DEPLACEMENTS' = VRAI ; "
    text += "T . 'PROCEDURE_PERSO1' = VRAI ; T . 'PROCEDURE_REEV_MEC' = VRAI ; PASAPAS T ;"
    T = finder(text, tmp_path)("T")
    assert T.get("VUS").values == pytest.approx([0.0, 1.25, 1.5, 1.75, 2.0])
    ends = [T.get("DEPLACEMENTS").get(i).components["UX"].values.max() for i in range(1, 5)]
    assert T.get("OU").values == pytest.approx(ends, rel=1e-12)
    assert ends == pytest.approx(4e-3 * np.arange(0.25, 1.1, 0.25), rel=5e-3)


def test_user_procedure_takes_a_part_of_the_model_away(tmp_path):
    text = (
        """
    DEBP PERSO1 T*TABLE ;
      SI ((T . 'ESTIMATION' . 'TEMPS') EGA 0.5) ; T . 'WTABLE' . 'MODELE' = MO1 ; FINS ;
    FINP ;
    """
        + BAR.replace("TRAN 1 (0. 1.)", "TRAN 2 (0. 1.)")
        + """
    MO1 = REDU MO (S ELEM 'APPU' 'LARG' L) ; BD = BLOQ 'UX' R ;
    T . 'BLOCAGES_MECANIQUES' = (T . 'BLOCAGES_MECANIQUES') ET BD ;
    T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI BD 2.E-3) EV ;
    T . 'PROCEDURE_PERSO1' = VRAI ; PASAPAS T ; F = PROG ;
    REPE B 4 ; F = F ET (MAXI (RESU (REDU (T . 'REACTIONS' . &B) R))) ; FIN B ;
    N = NBEL (EXTR (T . 'CONTRAINTES' . 4) 'MAIL') ;
    """
    )
    find = finder(text, tmp_path)
    assert find("F").values == pytest.approx([250.0, 500.0, 375.0, 500.0], rel=1e-9)
    assert find("N") == 4


@pytest.mark.parametrize(
    ("saved", "kept"),
    [("", [0.25, 0.5, 0.6, 0.8]), ("0.25 0.8", [0.25, 0.8]), ("0.5 0.6 1.", [0.5, 0.6])],
)
def test_user_procedure_gives_other_times(tmp_path, saved, kept):
    text = """
    DEBP PERSO1 T*TABLE ;
      SI ((T . 'ESTIMATION' . 'TEMPS') EGA 0.5) ; T . 'A_CALCULER' = PROG 0.6 0.8 ; FINS ;
    FINP ;
    """
    wish = f"T . 'TEMPS_SAUVES' = PROG {saved} ; " if saved else ""
    T = finder(text + BAR + wish + "T . 'PROCEDURE_PERSO1' = VRAI ; PASAPAS T ;", tmp_path)("T")
    assert [v for _, v in T.get("TEMPS").items()] == [0.0, *kept]


def test_table_is_saved_during_the_calculation(tmp_path):
    text = BAR + "OPTI SAUV 'k.sauv' ; T . 'TEMPS_SAUVEGARDES' = PROG 0.5 ; PASAPAS T ; "
    text += "OUBL T ; OPTI REST 'k.sauv' ; REST ; N = DIME (T . 'TEMPS') ;"
    assert finder(text, tmp_path)("N") == 3


LOOSE = BAR.replace(
    "MO = MODE S", "S2 = S PLUS (9. 0.) ; P3 = S2 POIN 'PROC' P2 ; MO = MODE (S ET S2)"
)


def test_body_without_support_or_load_stays_at_rest(tmp_path):
    find = finder(LOOSE + "PASAPAS T ; U = EXTR (T . 'DEPLACEMENTS' . 4) 'UX' P2 ;", tmp_path)
    assert find("U") == pytest.approx(2e-3, rel=1e-12)


@together("push", [10.0, -10.0])
def test_load_on_a_body_without_support_is_refused(push, tmp_path):
    text = LOOSE.replace("F = FORC (1000. 0.) R", f"F = FORC (0. {push}) (P2 ET P3)")
    held = "T . 'BLOCAGES_MECANIQUES'"
    text += f"{held} = ({held}) ET (BLOQ 'UX' S2) ; PASAPAS T ;"  # one way is free
    result = failed(text, folder=tmp_path)
    assert "free motion" in result.message
    ended = result.session.root.find("T")
    assert (ended.get("CONV"), ended.get("ERREUR")) == (False, True)


def test_fields_in_cells_come_in_the_order_of_the_models_zones(found):
    script = (
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; A = 0. 0. ; B = 1. 0. ; L = DROI 1 A B ; "
        "S = L TRAN 1 (0. 1.) ; SB = S COTE 2 ; SG = S COTE 4 ; "
        "M1 = MODE S MECANIQUE ELASTIQUE PLASTIQUE PARFAIT CONS 'C1' ; "
        "M2 = MODE S MECANIQUE ELASTIQUE CONS 'C2' ; M = M1 ET M2 ; "
        "MA = (MATE M1 YOUN 1000. NU 0. SIGY 1.) ET (MATE M2 YOUN 100. NU 0.) ; "
        "K1 = BLOQ 'UX' SG ; K2 = BLOQ 'UX' SB ; K3 = BLOQ 'UY' L ; "
        "CH = CHAR 'DIMP' (DEPI K2 0.01) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; "
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = MA ; "
        "T . 'BLOCAGES_MECANIQUES' = K1 ET K2 ET K3 ; T . 'CHARGEMENT' = CH ; "
        "T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.25 1. ; PASAPAS T ; "
        "X = T . 'CONTRAINTES' . 4 ; Y = EXTR X 'SMXX' 1 1 1 ; "
    )
    field, stress = found(script, "X", "Y")
    assert [b.constituent for b in field.blocks] == ["C1", "C2"]
    assert 1.0 < stress < 2 / 3**0.5  # yields between a free and a plane extension
    field, stress = found(script.replace("M = M1 ET M2", "M = M2 ET M1"), "X", "Y")
    assert [b.constituent for b in field.blocks] == ["C2", "C1"]
    assert stress == pytest.approx(100 * 0.01)


PLATE = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
P1 = 0. 0. ; L = DROI 2 P1 (2. 0.) ; S = L TRAN 2 (0. 1.) ; G = S COTE 4 ; R = S COTE 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 1.E5 'NU' 0.3 ;
MP = MODE R 'CHARGEMENT' 'PRESSION' ; EV = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 0.25) ;
T = TABL ; T . 'MODELE' = MO ET MP ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' G) ET (BLOQ 'UY' P1) ;
T . 'TEMPS_CALCULES' = PROG 0. 0.5 1. 2. ;
"""
STRAIN = (
    "CHAR 'DEFI' (MANU 'CHML' MO 'EPXX' 1.E-3 'EPYY' 2.E-3 'TYPE' 'DEFORMATIONS' 'STRESSES') EV"
)


def test_pressure_on_an_edge_follows_its_curve(tmp_path):
    find = finder(
        PLATE + "T . 'CHARGEMENT' = CHAR 'PRES' (PRES MP 'PRES' 300.) EV ; PASAPAS T ;", tmp_path
    )
    T = find("T")
    for index, factor in enumerate((0.0, 0.5, 1.0, 0.25)):
        u = T.get("DEPLACEMENTS").get(index).components
        shortening, thickening = -factor * 300.0 / 1e5 * 2.0, factor * 0.3 * 300.0 / 1e5 * 1.0
        assert u["UX"].values.min() == pytest.approx(shortening, rel=1e-10, abs=1e-18)
        assert u["UY"].values.max() == pytest.approx(thickening, rel=1e-10, abs=1e-18)
        stress = T.get("CONTRAINTES").get(index).blocks[0].components
        assert stress["SMXX"] == pytest.approx(-300.0 * factor, rel=1e-10, abs=1e-9)
        assert stress["SMYY"] == pytest.approx(0.0, abs=1e-9)


def test_imposed_strains_move_a_free_plate_without_stress(tmp_path):
    T = finder(PLATE + f"T . 'CHARGEMENT' = {STRAIN} ; PASAPAS T ;", tmp_path)("T")
    u = T.get("DEPLACEMENTS").get(2).components
    assert u["UX"].values.max() == pytest.approx(1e-3 * 2.0, rel=1e-10)
    assert u["UY"].values.max() == pytest.approx(2e-3 * 1.0, rel=1e-10)
    assert T.get("CONTRAINTES").get(2).blocks[0].components["SMXX"] == pytest.approx(0.0, abs=1e-9)


def test_imposed_strains_press_a_held_plate(tmp_path):
    held = PLATE + "T . 'BLOCAGES_MECANIQUES' = BLOQ 'UX' 'UY' S ; "
    T = finder(held + f"T . 'CHARGEMENT' = {STRAIN} ; PASAPAS T ;", tmp_path)("T")
    stress = T.get("CONTRAINTES").get(3).blocks[0].components
    modulus = 0.25 * 1e5 / (1 - 0.3**2)
    assert stress["SMXX"] == pytest.approx(-modulus * (1e-3 + 0.3 * 2e-3), rel=1e-10)
    assert stress["SMYY"] == pytest.approx(-modulus * (2e-3 + 0.3 * 1e-3), rel=1e-10)


def test_pressure_in_large_displacements_is_that_of_charmeca(tmp_path):
    large = "T . 'GRANDS_DEPLACEMENTS' = VRAI ; "
    direct = (
        PLATE + large + "T . 'CHARGEMENT' = CHAR 'PRES' (PRES MP 'PRES' 1.) EV ; "
        "T . 'TEMPS_CALCULES' = PROG 0. 1. ; PASAPAS T ; "
    )  # fmt: skip
    cure = (
        "DEBP CHARMECA TT*TABLE TI*FLOTTANT ; X = TABL ; M1 = TT . 'WTABLE' . 'PRESSE' ; "
        "X . 'ADDI_SECOND' = BSIG M1 (PRES M1 'PRES' TI) ; FINP X ; " + PLATE + large
        + "T . 'MODELE' = MO ; T . 'WTABLE' = TABL ; T . 'WTABLE' . 'PRESSE' = MP ; "
        "T . 'PROCEDURE_CHARMECA' = VRAI ; T . 'TEMPS_CALCULES' = PROG 0. 1. ; PASAPAS T ; "
    )  # fmt: skip
    found = [
        finder(script, tmp_path / str(i))("T").get("DEPLACEMENTS").get(1).components["UX"].values
        for i, script in enumerate((cure, direct))
    ]
    assert found[0].min() == pytest.approx(-1.0 / 1e5 * 2.0, rel=1e-4)
    np.testing.assert_allclose(found[1], found[0], atol=1e-12)


@pytest.mark.parametrize(("law", "large"), [("", False), ("", True), ("PLASTIQUE PARFAIT", True)])
def test_strains_of_large_displacements_are_those_of_green_and_lagrange(law, large, tmp_path):
    script = f"""OPTI DIME 3 ELEM CUB8 ;
    S = ((DROI 1 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 1. 0.)) ; V = S VOLU 1 TRAN (0. 0. 1.) ;
    M = MODE V MECANIQUE ELASTIQUE ISOTROPE {law} ; A = MATE M YOUN 10. NU 0. {law and "SIGY 5."} ;
    P = BLOQ UZ (FACE 2 V) ; T = TABL PASAPAS ; T . MODELE = M ; T . CARACTERISTIQUES = A ;
    T . BLOCAGES_MECANIQUES = P ET (BLOQ UZ S) ET (BLOQ UX UY V) ;
    T . CHARGEMENT = CHAR DIMP (DEPI P 0.1) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ;
    T . TEMPS_CALCULES = PROG 0. 1. ; T . MES_SAUVEGARDES = TABL ;
    {(large and "T . GRANDS_DEPLACEMENTS = VRAI ;") or "T . MES_SAUVEGARDES . DEFTO = VRAI ;"}
    PASAPAS T ; MESS (MAXI (EXCO EPZZ (T . DEFORMATIONS . 1))) ' ' (TYPE (T . WTABLE . FOR0)) ;"""
    result = ran(script, output_directory=tmp_path)
    assert result.exit_code == 0, result.message
    *_, strain, configuration = result.output.split()
    assert float(strain) == pytest.approx(0.1 + 0.5 * 0.1**2 if large else 0.1)
    assert configuration == "CONFIGUR"

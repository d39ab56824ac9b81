"""Models MODAL and STATIQUE: super-elements of modes and static shapes, joined by relations."""

import numpy as np
import pytest

BEAMS = """
OPTI DIME 2 ELEM SEG2 MODE PLAN CONT ;
A = 0. 0. ; B = 1. 0. ; B2 = 1. 0. ; C = 2. 0. ;
L1 = DROI 8 A B ; L2 = DROI 8 B2 C ;
M1 = MODE L1 MECANIQUE ELASTIQUE POUT ; M2 = MODE L2 MECANIQUE ELASTIQUE POUT ;
MA1 = MATE M1 YOUN 2.E11 NU .3 RHO 7800. SECT .01 INRZ 1.E-5 ;
MA2 = MATE M2 YOUN 2.E11 NU .3 RHO 7800. SECT .01 INRZ 2.E-5 ;
K1 = (RIGI M1 MA1) ET (BLOQ DEPL ROTA A) ; K2 = (RIGI M2 MA2) ET (BLOQ DEPL ROTA C) ;
G1 = MASS M1 MA1 ; G2 = MASS M2 MA2 ;
TIE = (RELA UX B - UX B2) ET (RELA UY B - UY B2) ET (RELA RZ B - RZ B2) ;
DEBP BASIS K*RIGIDITE G*RIGIDITE P*POINT N*ENTIER ;
  T = TABLE 'LIAISONS_STATIQUES' ; W = MOTS UX UY RZ ;
  REPE I 3 ; T . &I = TABLE ; T . &I . 'POINT_LIAISON' = P ;
    T . &I . 'DDL_LIAISON' = EXTR W &I ; FIN I ;
  H = BLOQ T ; DEPI T ; S = RESO (K ET H) T ; REAC H S ; S G * ;
  V = VIBR 'PROC' (PROG 1.) (LECT N) (K ET H) G ;
  REPE I 3 ;
    Q = MODE (MANU POI1 (S . &I . 'POINT_REPERE')) MECANIQUE ELASTIQUE STATIQUE ;
    C = MATE Q DEFO (S . &I . 'DEFORMEE') RIDE (S . &I . 'REACTION')
      MADE (S . &I . 'MASSE_DEFORMEE') ;
    SI (EGA &I 1) ; MO = Q ; CA = C ; SINO ; MO = MO ET Q ; CA = CA ET C ; FINS ;
  FIN I ;
  REPE I N ; E = V . 'MODES' . &I ;
    Q = MODE (MANU POI1 (E . 'POINT_REPERE')) MECANIQUE ELASTIQUE MODAL ;
    C = MATE Q FREQ (E . 'FREQUENCE') MASS (E . 'MASSE_GENERALISEE') DEFO (E . 'DEFORMEE_MODALE') ;
    MO = MO ET Q ; CA = CA ET C ;
  FIN I ;
FINP MO CA S V ;
MO1 CA1 S1 V1 = BASIS K1 G1 B 4 ; MO2 CA2 S2 V2 = BASIS K2 G2 B2 4 ;
MO = MO1 ET MO2 ; CA = CA1 ET CA2 ;
"""


def test_craig_bampton_substructures_have_the_frequencies_of_the_whole(found):
    few, whole = found(
        BEAMS + "R = PJBA TIE MO CA ; "
        "V = VIBR 'PROC' (PROG 1.) (LECT 3) ((RIGI MO1 CA1) ET (RIGI MO2 CA2) ET R) "
        "((MASS MO1 CA1) ET (MASS MO2 CA2)) ; "
        "W = VIBR 'PROC' (PROG 1.) (LECT 3) (K1 ET K2 ET TIE) (G1 ET G2) ; "
        "F = PROG ; H = PROG ; REPE I 3 ; F = F ET (PROG (V . 'MODES' . &I . 'FREQUENCE')) ; "
        "H = H ET (PROG (W . 'MODES' . &I . 'FREQUENCE')) ; FIN I ;",
        "F",
        "H",
    )
    a, b = np.asarray(few.values), np.asarray(whole.values)
    assert (a >= b * (1 - 1e-9)).all()  # a Ritz basis is never softer
    assert a == pytest.approx(b, rel=2e-3)


def test_shape_matrices_are_the_body_s_on_its_shapes(found):
    """`X^T K X` and `X^T M X`, by the model and by PJBA of the body's own matrices."""
    error = found(
        BEAMS + "Q = MANU CHPO (EXTR MO1 MAIL) 2 ALFA 1. BETA 2. ; "
        "D = ((RIGI MO1 CA1) - (PJBA (RIGI M1 MA1) V1 S1)) * Q ; "
        "E = ((MASS MO1 CA1) - (PJBA G1 V1 S1)) * Q ; "
        "X = (MAXI D 'ABS') / (MAXI ((RIGI MO1 CA1) * Q) 'ABS') ; "
        "Y = (MAXI E 'ABS') / (MAXI ((MASS MO1 CA1) * Q) 'ABS') ; E = MAXI (PROG X Y) ;",
        "E",
    )
    assert error < 1e-8


def test_participations_recombine_to_the_same_field_by_model_and_by_tables(found):
    error = found(
        BEAMS + "Q = MANU CHPO (EXTR MO1 MAIL) 2 ALFA 1. BETA 2. ; "
        "R = RECO Q V1 S1 ; E = (MAXI ((RECO Q MO1 CA1) - R) 'ABS') / (MAXI R 'ABS') ;",
        "E",
    )
    assert error < 1e-12


def test_joined_tables_number_their_shapes_through(found):
    count, last = found(
        BEAMS + "S = S1 ET S2 ; N = DIME S ; E = (S . 6 . 'POINT_REPERE') EGA "
        "(S2 . 3 . 'POINT_REPERE') ; V = V1 ET V2 ; N = N + (DIME (V . 'MODES')) ;",
        "N",
        "E",
    )
    assert count == 7 + 10
    assert last

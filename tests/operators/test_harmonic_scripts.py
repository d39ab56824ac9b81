"""DYNC, HBM, CONTINU and HBM_POST through scripts, against closed forms and time integration."""

import numpy as np
import pytest
import script_runs

DAMPING, CUBIC, LOAD = 0.1, 0.25, 0.5
DUFFING = f"""
DEBP CHARMECA TAB1*TABLE ;
  X1 = TAB1 . 'DEP_NL' . 1 ;
  TAB1 . 'FNL_T' = TABL ; TAB1 . 'FNL_T' . 1 = (-1. * {CUBIC}) * (X1 ** 3) ;
  TAB1 . 'KNL_T' = TABL ; TAB1 . 'KNL_T' . 1 = TABL ;
  TAB1 . 'KNL_T' . 1 . 1 = (3. * {CUBIC}) * (X1 ** 2) ;
FINP ;
OPTI DIME 2 ELEM SEG2 MODE PLAN ;
P0 = 0. 0. ; P1 = 1. 0. ; T = TABL ;
T . 'MASSE_CONSTANTE' = (MASS 'UY' 1. P1) ET (MASS 'UY' 1. P0) ;
T . 'AMORTISSEMENT_CONSTANT' = MANU 'RIGI' P1 (MOTS 'UY') (PROG {DAMPING}) ;
T . 'RIGIDITE_CONSTANTE' = MANU 'RIGI' P1 (MOTS 'UY') (PROG 1.) ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'UY' P0 ;
T . 'N_HARMONIQUE' = NH ;
T . 'RESULTATS' = TABL ; R = TABL ; T . 'RESULTATS' . 1 = R ;
R . 'POINT_MESURE' = P1 ; R . 'COMPOSANTES' = MOT 'UY' ; R . 'TITRE' = MOT 'U' ;
R = TABL ; T . 'RESULTATS' . 2 = R ; R . 'POINT_MESURE' = P1 ; R . 'COMPOSANTES' = MOT 'UY' ;
HBM T ;
F1 = MANU 'CHPO' P1 1 'F2' {LOAD} 'NATURE' 'DISCRET' ;
T . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG 0. 20.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0.3 PAS 0.05 2.4 ; T . 'MAXI_DEPLACEMENT' = 1. ;
T . 'PRECISION' = 1.E-9 ; T . 'PROCEDURE_CHARMECA' = VRAI ;
T . 'PROCEDURE_FREQUENCE_TEMPS' = MOT 'AFT' ; T . 'POINT_FNL' = P1 ; T . 'COMP_FNL' = MOTS 'UY' ;
T . 'STABILITE' = MOTS 'DIAG' 'FLOQ' ;
"""


def reals(table, *path):
    for index in path:
        table = table.get(index)
    return np.asarray(table.values)


# --- HBM and CONTINU -------------------------------------------------------------------------


@pytest.fixture(scope="module")
def one_harmonic(tmp_path_factory):
    """The table of the oscillator with one harmonic, all frequencies in one call."""
    none = "DEBP SANS T1*TABLE X1/TABLE ; T1 . 9 = X1 ; FINP ; SANS (T . 'RESULTATS') ; "
    text = DUFFING + none + "CONTINU T ; HBM_POST T (MOTS 'MAXI' 'TEMP' 'VITE') ;"
    return script_runs.found("NH = 1 ; " + text, "T", folder=tmp_path_factory.mktemp("harmonic"))


def test_one_harmonic_by_hbm_and_continu_is_duffings_closed_form(one_harmonic):
    T = one_harmonic
    w = reals(T, "TEMPS_PROG")
    mean, cosine, sine = (reals(T, "RESULTATS_HBM", j, "RESULTATS") for j in (1, 2, 3))
    A = np.hypot(cosine, sine)
    left = ((1 + 0.75 * CUBIC * A**2 - w**2) ** 2 + (DAMPING * w) ** 2) * A**2
    np.testing.assert_allclose(left, LOAD**2, rtol=1e-7)
    assert np.abs(mean).max() < 1e-9
    drawn = T.get("RESULTATS_HBM").get("RESULTATS_EVOL").parts
    np.testing.assert_array_equal([p.ordinates for p in drawn], [mean, cosine, sine] * 2)
    assert w[-1] > 2.4
    turns = np.flatnonzero(np.diff(np.sign(np.diff(w))))
    assert len(turns) == 2  # two limit points
    largest, again = T.get("RESULTATS").get("RESULTATS_EVOL").parts
    assert (largest.legend, again.legend) == ("U", "UY")
    np.testing.assert_allclose(largest.abscissas, w)
    np.testing.assert_allclose(largest.ordinates, A, rtol=2e-3)  # 128 instants of a period
    motion = T.get("RESULTATS").get(1).get("RESULTATS_TEMPORELS")
    u, v = motion.get(7).parts[0], motion.get(-7).parts[0]
    angle = 2 * np.pi * u.abscissas
    np.testing.assert_allclose(u.ordinates, cosine[6] * np.cos(angle) + sine[6] * np.sin(angle))
    rate = w[6] * (sine[6] * np.cos(angle) - cosine[6] * np.sin(angle))
    np.testing.assert_allclose(v.ordinates, rate, atol=1e-12)


def test_stability_changes_at_both_limit_points_of_a_converged_series(found):
    T = found("NH = 5 ; " + DUFFING + "T . 'N_PT_TFR' = 6 ; CONTINU T ;", "T")
    names = T.get("COMPOSANTES")  # of the mean, of cosines (U, F) and of sines (V, G)
    for word, (cosine, sine) in (("DEPLACEMENT", "UV"), ("FORCE", "FG")):
        by = [[f"{cosine}1"], *([f"{cosine}{n}", f"{sine}{n}"] for n in range(2, 7))]
        assert [names.get(f"HARM_{word}").get(k).values for k in range(6)] == by
        assert names.get(f"{word}_HBM").values == [name for row in by for name in row]
    w = reals(T, "TEMPS_PROG")
    states = reals(T, "RESULTATS_STABILITE", "FLOQ", "STABILITE")
    assert len(states) == len(w) - 1
    turns = np.flatnonzero(np.diff(np.sign(np.diff(w)))) + 1
    np.testing.assert_array_equal(np.flatnonzero(np.diff(states)) + 1, turns)
    negative = reals(T, "RESULTATS_STABILITE", "DIAG")
    between = slice(turns[0] + 1, turns[1])
    assert set(negative[between] % 2) != set(negative[: turns[0]] % 2)


def test_a_further_call_goes_on_from_the_last_solution(found, one_harmonic):
    """Its first steps with forces as fields, the others with lists."""
    fields = """DEBP CHARMECA T1*TABLE ; F1 = SUIT ; K1 = PROG ; REPE B (DIME (T1 . 'DEP_NL')) ;
    X1 = EXTR (EXTR (T1 . 'DEP_NL') &B) 'UY' P1 ; K1 = K1 ET (3. * 0.25 * X1 * X1) ;
    F1 = F1 ET (SUIT (MANU 'CHPO' P1 1 'FY' (-0.25 * (X1 ** 3)) 'NATURE' 'DISCRET')) ; FIN B ;
    T2 = TABL ; T2 . 1 = TABL ; T2 . 1 . 1 = K1 ; T1 . 'FNL_T' = F1 ; T1 . 'KNL_T' = T2 ; FINP ;
    T . 'CALC_CHPO' = VRAI ; """
    text = "NH = 1 ; " + DUFFING + fields + "T . 'MAXIPAS' = 2 ; CONTINU T ; "
    text += "N1 = DIME (T . 'TEMPS_PROG') ; " + DUFFING[: DUFFING.index("OPTI")]
    text += "T . 'CALC_CHPO' = FAUX ; T . 'MAXIPAS' = 500 ; CONTINU T ; "
    n1, T = found(text, "N1", "T")
    w = reals(T, "TEMPS_PROG")
    assert n1 == 3
    cosine, sine = (reals(T, "RESULTATS_HBM", j, "RESULTATS") for j in (2, 3))
    A = np.hypot(cosine, sine)
    left = ((1 + 0.75 * CUBIC * A**2 - w**2) ** 2 + (DAMPING * w) ** 2) * A**2
    np.testing.assert_allclose(left, LOAD**2, rtol=1e-7)
    assert len(reals(T, "RESULTATS_STABILITE", "FLOQ", "STABILITE")) == len(w) - 1
    assert (w[n1:] > w[n1 - 1])[:5].all()
    whole = reals(one_harmonic, "TEMPS_PROG")
    np.testing.assert_allclose(w[:n1], whole[:n1], rtol=1e-9)
    assert w.max() == pytest.approx(whole.max(), abs=0.06)


def test_names_of_coefficients_follow_harmonics_and_unknowns(found):
    text = """
    OPTI DIME 2 ELEM SEG2 MODE PLAN ; P1 = 0. 0. ; T = TABL ; T . 'N_HARMONIQUE' = 2 ;
    T . 'RIGIDITE_CONSTANTE' = MANU 'RIGI' P1 (MOTS 'UX' 'UY') (PROG 2. 0. 0. 3.) ;
    T . 'AMORTISSEMENT_CONSTANT' = MANU 'RIGI' P1 (MOTS 'UX' 'UY') (PROG 0.1 0. 0. 0.1) ;
    T . 'MASSE_CONSTANTE' = (MASS 'UX' 1. P1) ET (MASS 'UY' 1. P1) ; HBM T ;
    """
    T = found(text, "T")
    names = T.get("COMPOSANTES").get("DEPLACEMENT_HBM").values
    assert names == ["U1", "U2", "U3", "U4", "V3", "V4", "U5", "U6", "V5", "V6"]
    assert T.get("COMPOSANTES").get("HARM_FORCE").get(2).values == ["F5", "F6", "G5", "G6"]


# --- loads along the arc length --------------------------------------------------------------

TRUSS = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P1 = 0. 1. ; P2 = 10. 0. ; L1 = DROI 1 P1 P2 ;
M1 = MODE L1 'MECANIQUE' 'ELASTIQUE' BARR ; T = TABL ; T . 'MODELE' = M1 ;
T . 'CARACTERISTIQUES' = MATE M1 'YOUN' 1.E9 'NU' 0. 'SECT' 0.1 ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' P1) ET (BLOQ 'UX' 'UY' P2) ;
T . 'GRANDS_DEPLACEMENTS' = VRAI ; F1 = FORC (0. -1.E4) P1 ;
T . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG 0. 9.) (PROG 0. 9.)) ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 0.5 3. ; T . 'MAXI_DEPLACEMENT' = 0.2 ;
T . 'STABILITE' = MOTS 'DIAG' ; T . 'RESULTATS' = TABL ; T . 'RESULTATS' . 1 = TABL ;
R = T . 'RESULTATS' . 1 ; R . 'POINT_MESURE' = P1 ; R . 'COMPOSANTES' = MOT 'UY' ;
"""


def test_truss_passes_both_limit_points_along_the_arc(found):
    T = found(TRUSS + "CONTINU T ;", "T")
    t, v = reals(T, "TEMPS_PROG"), -reals(T, "RESULTATS", 1, "RESULTATS")
    rest, length = np.hypot(1.0, 10.0), np.hypot(1.0 - v, 10.0)
    np.testing.assert_allclose(1e4 * t, -1e8 * (length / rest - 1) * (1 - v) / length, atol=0.02)
    steps = np.hypot(np.diff(t) / 0.5, np.diff(v) / 0.2)
    assert steps.max() < 1.3  # length one along the tangent, a little more along the curve
    assert t.max() > 3.0
    assert t.min() < -1.8
    limit = 1 - np.sqrt(1 / 3.0)  # of a shallow truss; here h/L = 0.1 shifts it by 0.4 per cent
    negative = reals(T, "RESULTATS_STABILITE", "DIAG") > 0
    clear = np.minimum(np.abs(v - limit), np.abs(v - 2 + limit)) > 0.01
    np.testing.assert_array_equal(negative[clear], ((v > limit) & (v < 2 - limit))[clear])


# --- DYNC ------------------------------------------------------------------------------------

ONE_MODE = """
OPTI DIME 2 ELEM SEG2 MODE PLAN DEFO ; P1 = 0. 0. ; A1 = 0. 0. ;
TM = TABL 'BASE_MODALE' ; TM . 'MODES' = TABL 'BASE_DE_MODES' ;
T1 = TABL 'MODE' ; TM . 'MODES' . 1 = T1 ; T1 . 'POINT_REPERE' = A1 ; T1 . 'NUMERO_MODE' = 1 ;
T1 . 'FREQUENCE' = {frequency} ; T1 . 'MASSE_GENERALISEE' = {mass} ;
T1 . 'DEFORMEE_MODALE' = MANU 'CHPO' P1 2 'UX' 0. 'UY' 1. 'NATURE' 'DIFFUS' ;
TA = TABL 'AMORTISSEMENT' ;
TA . 'AMORTISSEMENT' = MANU 'RIGI' 'TYPE' 'AMORTISSEMENT' A1 (MOTS 'ALFA') (PROG {damping}) ;
TC = TABL 'CHARGEMENT' ; TC . 1 = MANU 'CHPO' A1 1 'FALF' {load} ;
TI = TABL 'INITIAL' ; TN = TABL 'PARAMETRES_NUMERIQUES' ; TN . 'TYPE' = MOT 'FORC' ;
TL = TABL 'LIAISON' ; L1 = TABL 'LIAISON_ELEMENTAIRE' ;
"""
CUBIC_LINK = f"""
TL . 'LIAISON_A' = TABL 'LIAISON_A' ; TL . 'LIAISON_A' . 1 = L1 ;
L1 . 'TYPE_LIAISON' = MOT 'COUPLAGE_DEPLACEMENT' ; L1 . 'SUPPORT' = A1 ; L1 . 'ORIGINE' = A1 ;
L1 . 'COEFFICIENT' = -{CUBIC} ; L1 . 'EXPOSANT' = 3 ;
TI . 'FREQUENCE' = 0.3 ; TN . 'VAL_FIN' = 2.4 ; TN . 'DS0' = 0.02 ; TN . 'DSMAX' = 0.1 ;
TN . 'DSMIN' = 1.E-4 ;
"""


def one_mode(load, damping, mass=1.0, frequency=0.5 / np.pi):
    return ONE_MODE.format(frequency=frequency, damping=damping, load=load, mass=mass)


def test_dync_follows_duffings_closed_form_and_finds_its_limit_points(found):
    text = one_mode(LOAD, DAMPING, 1.3, 0.4 / np.pi) + CUBIC_LINK  # K = 0.8^2 m
    text += """R = DYNC TM TC TL TA TI TN 1 64 ; C = R . 'REPONSE' . 'COEFFICIENTS' ;
    C1 = C . 1 . A1 ; S1 = C . (-1) . A1 ; W = R . 'REPONSE' . 'FREQUENCE' ;
    N = R . 'REPONSE' . 'NORME_DEPLACEMENT' ; K = R . 'BIFURCATION' . 'TYPE' ;
    Q = R . 'BIFURCATION' . 'NORME_DEPLACEMENT' ; X = R . 'BIFURCATION' . 'FREQUENCE' ;
    Z = R . 'BIFURCATION' . 'KAPPA' ; TN . 'TYPE' = MOT 'NNM' ;
    TI . 'MODE' = 1 ; TI . 'ENERGIE' = 1.E-3 ; TN . 'VAL_FIN' = 2. ;
    F = DYNC TM TC TL TA TI TN 1 64 ; F = F . 'REPONSE' ;
    W0 = F . 'FREQUENCE' ; A0 = F . 'COEFFICIENTS' . 1 . A1 ; E0 = F . 'ENERGIE' ;"""
    names = ("C1", "S1", "W", "N", "K", "Q", "X", "Z", "W0", "A0", "E0")
    c, s, w, n, kinds, q, x, turns, w0, a0, energy = (x.values for x in found(text, *names))
    A = np.hypot(c, s)
    rest = 0.832 + 0.75 * CUBIC * A**2 - 1.3 * np.square(w)
    np.testing.assert_allclose((rest**2 + (DAMPING * np.array(w)) ** 2) * A**2, LOAD**2, rtol=1e-6)
    np.testing.assert_allclose(n, A, atol=1e-7)
    assert [(k.strip(), turn) for k, turn in zip(kinds, turns, strict=True)] == [("LP", 0.0)] * 2
    q, x = np.square(q), np.square(x)  # where the closed form has no slope over the amplitude
    rest = 0.832 + 0.75 * CUBIC * q - 1.3 * x
    np.testing.assert_allclose((rest**2 + DAMPING**2 * x) * q, LOAD**2, rtol=1e-6)
    np.testing.assert_allclose(rest**2 + DAMPING**2 * x + 1.5 * CUBIC * q * rest, 0.0, atol=1e-6)
    a0, w0 = np.square(a0), np.square(w0)  # without load and damping, whatever is given
    np.testing.assert_allclose(1.3 * w0, 0.832 + 0.75 * CUBIC * a0, rtol=1e-6)
    np.testing.assert_allclose(energy, 0.416 * a0 + 0.25 * CUBIC * a0**2, rtol=1e-6)


def test_dync_takes_an_unbalance_that_grows_with_the_square_of_frequency(found):
    text = one_mode(LOAD, DAMPING) + CUBIC_LINK
    text += """TC . 'BALOURD' = 1 ; TN . 'VAL_FIN' = 0.9 ;
    R = DYNC TM TC TA TI TN 1 64 ; W = R . 'REPONSE' . 'FREQUENCE' ;
    N = R . 'REPONSE' . 'NORME_DEPLACEMENT' ;"""
    w, n = (np.asarray(x.values) for x in found(text, "W", "N"))
    np.testing.assert_allclose(n, LOAD * w**2 / np.hypot(1 - w**2, DAMPING * w), rtol=1e-7)


UPLIFT = """
TL . 'LIAISON_B' = TABL 'LIAISON_B' ; TL . 'LIAISON_B' . 1 = L1 ;
L1 . 'TYPE_LIAISON' = MOT 'POINT_PLAN' ; L1 . 'SUPPORT' = P1 ; L1 . 'NORMALE' = 0. -1. ;
L1 . 'RAIDEUR' = 100. ; L1 . 'JEU' = 0. ;
TC . 0 = MANU 'CHPO' A1 1 'FALF' -10. ; TI . 0 = MANU 'CHPO' A1 1 'ALFA' -0.1 ;
TI . 'FREQUENCE' = 16. ; TN . 'VAL_FIN' = 11.9 ; TN . 'ISENS' = -1. ; TN . 'DS0' = 0.05 ;
TN . 'DSMAX' = 0.25 ; TN . 'DSMIN' = 1.E-4 ;
R = DYNC TM TC TL TA TI TN 11 256 ; C = R . 'REPONSE' . 'COEFFICIENTS' ;
W = R . 'REPONSE' . 'FREQUENCE' ; C0 = C . 0 . A1 ; C1 = C . 1 . A1 ; S1 = C . (-1) . A1 ;
U = R . 'REPONSE' . 'STABILITE' ;
"""
IN_TIME = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; SOL = 0. -1. ; P = 0. 0. ; J = MANU 'SEG2' SOL P ;
MO = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
T1 = TABL ; T1 . 'RIGI' = (BLOQ 'UX' 'UY' SOL) ET (BLOQ 'UX' P) ;
T1 . 'MASS' = MASS 'DEPL' 1. P ; T1 . 'AMOR' = MANU 'RIGI' P (MOTS 'UY') (PROG {damping}) ;
TT = PROG 0. PAS {step} {end} ; F1 = EVOL 'MANU' TT ({load} * (COS ((180. / PI * {w}) * TT))) ;
T1 . 'CHAR' = (CHAR 'MECA' (FORC (0. -10.) P)) ET (CHAR 'MECA' (FORC (0. 1.) P) F1) ;
T1 . 'DEPL' = MANU 'CHPO' P 1 'UY' -0.1 ;
T1 . 'MODELE' = MO ; T1 . 'CARACTERISTIQUES' = MATE MO 'KN' 100. 'KS' 0. ;
T1 . 'TEMPS_CALCULES' = TT ; T1 . 'PAS_SAUVES' = 1 ; R = DYNAMIC T1 ;
V = EXTR (EVOL 'TEMP' R 'DEPL' 'UY' P) 'ORDO' ;
"""


def test_uplift_on_a_one_sided_spring_is_what_dynamic_settles_on(found):
    """A mass that its weight holds on a spring which only pushes, shaken until it lifts off."""
    text = one_mode(8.0, 1.0, frequency=0.0) + UPLIFT
    w, c0, c1, s1, unstable = (
        np.asarray(x.values) for x in found(text, "W", "C0", "C1", "S1", "U")
    )
    i = int(np.argmin(np.abs(w - 12.0)))
    assert not unstable[i]
    assert np.hypot(c1[i], s1[i]) > 1.2 * abs(c0[i])  # it leaves the spring
    periods, steps = 32, 200
    step = 2 * np.pi / w[i] / steps
    history = found(
        IN_TIME.format(damping=1.0, step=f"{step:.17g}", end=f"{periods * steps * step:.17g}",
                       load=8.0, w=f"{w[i]:.17g}"),
        "V",
    )  # fmt: skip
    last = np.asarray(history.values)[-steps - 1 : -1]
    angle = 2 * np.pi * np.arange(steps) / steps
    got = [last.mean(), 2 * (last * np.cos(angle)).mean(), 2 * (last * np.sin(angle)).mean()]
    np.testing.assert_allclose(got, [c0[i], c1[i], s1[i]], atol=2e-3 * abs(c1[i]))


def test_links_with_a_past_are_refused(refused):
    text = one_mode(1.0, 0.1) + CUBIC_LINK
    text += """
    TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ; TL . 'LIAISON_B' . 1 = L1 ;
    L1 . 'TYPE_LIAISON' = MOT 'POINT_PLAN_FROTTEMENT' ; L1 . 'SUPPORT' = P1 ;
    L1 . 'NORMALE' = 0. -1. ; L1 . 'RAIDEUR' = 100. ; L1 . 'JEU' = 0. ;
    L1 . 'COEFFICIENT_GLISSEMENT' = 0.1 ; L1 . 'COEFFICIENT_ADHERENCE' = 0.1 ;
    L1 . 'RAIDEUR_TANGENTIELLE' = 100. ; L1 . 'AMORTISSEMENT_TANGENTIEL' = 1. ;
    R = DYNC TM TC TL TA TI TN 1 64 ;"""
    assert "remembers its past" in refused(text)

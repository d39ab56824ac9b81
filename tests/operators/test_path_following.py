"""PASAPAS along paths that loads in time cannot follow: snap-through, snap-back, collapse."""

from types import SimpleNamespace

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.plasticity.following import Split
from ssilang.language.say.diagnostics import sentence
from ssilang.operators.statics.path_following import AutomaticControl, ends_of, strain_points

ES, HEIGHT, SPAN = 2.1e11 * 0.05, 1.0, 10.0
TRUSS = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
P1 = 0. 1. ; P2 = 10. 0. ; L1 = DROI 1 P1 P2 ;
MO = MODE L1 'MECANIQUE' 'ELASTIQUE' BARR ;
T = TABL ; T . 'MODELE' = MO ;
T . 'CARACTERISTIQUES' = MATE MO 'YOUN' 2.1E11 'NU' 0.3 'SECT' 0.05 ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' P1) ET (BLOQ 'UX' 'UY' P2) ;
T . 'GRANDS_DEPLACEMENTS' = VRAI ;
F1 = FORC (0. -1.E6) P1 ;
"""
AUTOMATIC = """
T . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG 0. 10.) (PROG 0. 10.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 2.5 ; T . 'AUTOMATIQUE' = VRAI ;
"""
DEFLECTION = """
DEBP AUTOPILO D1*CHPOINT D2*CHPOINT M1*MMODEL C1*MCHAML T1*TABLE ;
  X1 = -1. * (EXTR D1 'UY' P1) ;
FINP X1 ;
"""


def truss_load(v):
    """Force at the top of one bar pushed down by v (its axial force is ES (l/L - 1))."""
    rest = np.hypot(HEIGHT, SPAN)
    length = np.hypot(HEIGHT - v, SPAN)
    return -ES * (length / rest - 1.0) * (HEIGHT - v) / length


def values(table, word):
    return [v for _, v in table.get(word).items()]


def moved(table, component, node):
    return np.array(
        [
            f.values_at(component, np.array([node]))[0] if component in f.components else 0.0
            for f in values(table, "DEPLACEMENTS")
        ]
    )


# --- automatic control -----------------------------------------------------------------------


def test_truss_snaps_through_both_limit_points_by_its_deflection(tmp_path):
    text = TRUSS + AUTOMATIC + DEFLECTION + "T . 'AUTOCRIT' = 0.075 ; PASAPAS T ;"
    find = ran(text, tmp_path).session.root.find
    table, top = find("T"), find("P1").node
    v, factors = -moved(table, "UY", top), np.array(values(table, "TEMPS"))
    np.testing.assert_allclose(1e6 * factors, truss_load(v), atol=1e-6 * 2e6)
    np.testing.assert_allclose(np.diff(v)[:-1], 0.075, rtol=1e-9)
    assert factors[-1] == pytest.approx(2.5)
    assert factors.min() < -1.99  # past the second limit point, the load hangs on the truss
    assert factors.max() == factors[-1]


def test_greatest_strain_controls_where_the_script_has_no_autopilo(tmp_path):
    text = TRUSS + AUTOMATIC + "T . 'AUTOCRIT' = 1.E-3 ; PASAPAS T ;"
    find = ran(text, tmp_path).session.root.find
    table, top = find("T"), find("P1").node
    v, factors = -moved(table, "UY", top), np.array(values(table, "TEMPS"))
    np.testing.assert_allclose(1e6 * factors, truss_load(v), atol=1e-6 * 2e6)
    assert (np.diff(v) > 0).all()
    # strain of the bar for a fall dv, seen along its first direction: dv h / L^2; the elastic
    # truss, as stiff as at the start, falls by dF / k0
    stiffness = (truss_load(1e-6) - truss_load(-1e-6)) / 2e-6
    fall, elastic = np.diff(v), 1e6 * np.diff(factors) / stiffness
    strain = np.maximum(fall, np.abs(fall - elastic)) * HEIGHT / 101.0
    np.testing.assert_allclose(strain[:-1], 1e-3, rtol=1e-6)
    assert factors.min() < -1.9


def test_a_norm_that_is_another_backwards_is_met_both_ways():
    class Lopsided(AutomaticControl):
        def _norm(self, total, elastic):
            return max(total[0], -3.0 * total[0])

    none, unit = np.zeros(1), np.ones(1)
    control = Lopsided(None, None, 0.6, lambda: unit, None)
    for known in (0.0, 0.06):
        found = control(Split(none, known * unit, none, unit), 0.5)
        assert found == pytest.approx([0.3 - known, -0.1 - known])


def test_one_step_in_so_many_is_saved_and_a_path_too_long_ends_with_a_warning(tmp_path):
    text = TRUSS + AUTOMATIC + DEFLECTION
    text += "T . 'AUTOCRIT' = 0.05 ; T . 'AUTORESU' = 4 ; T . 'AUTOPAS' = 10 ; PASAPAS T ;"
    result = ran(text, tmp_path)
    table, top = result.session.root.find("T"), result.session.root.find("P1").node
    v = -moved(table, "UY", top)
    np.testing.assert_allclose(v, [0.0, 0.2, 0.4, 0.5], rtol=1e-9)
    assert any("AUTOPAS" in sentence(w, "en")[0] for w in result.session.warnings)


# --- indirect control ------------------------------------------------------------------------

KN, FU, GF, KB = 1.0e5, 100.0, 1.0, 2.0e3
PULLED = f"""
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
S1 = 0. -1. ; P1 = 0. 0. ; Q1 = 0. 1. ;
J1 = MANU 'SEG2' S1 P1 ; L1 = DROI 1 P1 Q1 ;
MJ = MODE J1 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
MB = MODE L1 'MECANIQUE' 'ELASTIQUE' BARR ;
T = TABL ; T . 'MODELE' = MJ ET MB ;
T . 'CARACTERISTIQUES' = (MATE MJ 'KN' {KN} 'KS' {KN} 'FU' {FU} 'GF' {GF})
  ET (MATE MB 'YOUN' {KB} 'NU' 0. 'SECT' 1.) ;
B1 = BLOQ 'UY' Q1 ;
FIX = (BLOQ 'UX' 'UY' S1) ET (BLOQ 'UX' P1) ET (BLOQ 'UX' Q1) ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 1. 30. ;
T . 'PILOTAGE_INDIRECT' = VRAI ;
T . 'PARAMETRE_DE_PILOTAGE' = EVOL 'MANU' (PROG 0. 30.) (PROG 0. 3.E-2) ;
DEBP PILOINDI T1*TABLE U1*CHPOINT D1*CHPOINT D2*CHPOINT D3*CHPOINT X1*FLOTTANT ;
  Y1 = (X1 - (EXTR D1 'UY' P1) - (EXTR D2 'UY' P1)) / (EXTR D3 'UY' P1) ;
FINP Y1 ;
"""


def softening_force(w):
    """Traction of the joint opened by w from rest: the elastic line, then its envelope."""
    from scipy.special import lambertw

    a = FU / GF
    beyond = np.real(lambertw(-(a * FU / KN) * np.exp(-a * w))) / a
    return np.where(w * KN <= FU, w * KN, -beyond * KN)


@pytest.mark.parametrize("drive", ["displacement", "force"])
def test_softening_joint_on_a_soft_bar_is_followed_through_its_snap_back(drive, tmp_path):
    text = PULLED
    if drive == "displacement":
        text += "T . 'BLOCAGES_MECANIQUES' = FIX ET B1 ; "
        text += "T . 'DEPLACEMENTS_PILOTES' = DEPI B1 1. ; "
    else:
        text += "T . 'BLOCAGES_MECANIQUES' = FIX ; "
        text += "T . 'FORCES_PILOTEES' = FORC (0. 1.) Q1 ; "
    find = ran(text + "PASAPAS T ;", tmp_path).session.root.find
    table = find("T")
    w, end = (moved(table, "UY", find(n).node) for n in ("P1", "Q1"))
    np.testing.assert_allclose(w, 1e-3 * np.arange(31), atol=1e-14)
    force = softening_force(w)
    np.testing.assert_allclose(end, w + force / KB, rtol=1e-8)
    assert 0.0 < end[20] < 0.6 * end[1]  # the end goes back: no load in time gets there
    eta = table.get("COEFFICIENT_DE_PILOTAGE").values
    np.testing.assert_allclose(eta, end if drive == "displacement" else force, rtol=1e-8)


E, SY = 2.0e5, 200.0
BARS = f"""
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
P0 = 0. -1. ; A1 = 0. 0. ; A2 = -1. 0. ; A3 = 1. 0. ;
L1 = DROI 1 P0 A1 ; L2 = DROI 1 P0 A2 ; L3 = DROI 1 P0 A3 ; LT = L1 ET L2 ET L3 ;
MO = MODE LT 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' BARR ;
T = TABL ; T . 'MODELE' = MO ;
T . 'CARACTERISTIQUES' = MATE MO 'YOUN' {E} 'NU' 0.3 'SIGY' {SY} 'SECT' 1. 'RHO' 1. ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'UX' 'UY' (A1 ET A2 ET A3) ;
F1 = FORC (0. -1.) P0 ;
"""


def three_bars(v):
    """Load under which the joint of three perfectly plastic bars goes down by v."""
    upright = np.minimum(E * v, SY)
    inclined = np.minimum(E * v / 2.0, SY)
    return upright + 2.0 * inclined * np.sqrt(0.5)


def test_three_plastic_bars_are_pulled_to_collapse_by_their_greatest_strain(tmp_path):
    text = f"""{BARS}
    T . 'TEMPS_CALCULES' = PROG 0. PAS 1. 12. ; T . 'PILOTAGE_INDIRECT' = VRAI ;
    T . 'FORCES_PILOTEES' = F1 ;
    T . 'PARAMETRE_DE_PILOTAGE' = EVOL 'MANU' (PROG 0. 12.) (PROG 0. 3.E-3) ; PASAPAS T ;
    """
    find = ran(text, tmp_path).session.root.find
    v = -moved(find("T"), "UY", find("P0").node)
    np.testing.assert_allclose(v, 2.5e-4 * np.arange(13), atol=1e-14)
    eta = find("T").get("COEFFICIENT_DE_PILOTAGE").values
    np.testing.assert_allclose(eta, three_bars(v), rtol=1e-9)
    assert eta[-1] == pytest.approx(SY * (1 + np.sqrt(2.0)))


@together("seed", range(6))
def test_where_a_strain_is_never_reached_it_is_the_least_of_the_greatest(seed):
    """The greatest of lines `a + x b` is least where one that rises meets one that falls."""
    rng = np.random.default_rng(seed)
    size = 10.0**-seed
    b = size * rng.uniform(0.2, 3.0, 7) * [1, 1, 1, -1, -1, -1, -1]
    a = size * rng.uniform(-1.0, 1.0, 7)
    meet = ((a[3:] - a[:3, None]) / (b[:3, None] - b[3:])).ravel()
    greatest = (a + meet[:, None] * b).max(axis=1)
    least = greatest.min()
    assert ends_of(a, b, least - 0.5 * size) == pytest.approx([meet[greatest.argmin()]])
    for x in ends_of(a, b, least + 0.5 * size):
        assert (a + x * b).max() == pytest.approx(least + 0.5 * size)


@together(
    "norm, known, wanted",
    [
        (lambda v: 2.0 * v[0] - v[1], [0.0, 0.0], [0.5]),
        (lambda v: 2.0 * v[0] - v[1], [0.2, 0.3], [0.45]),
        (lambda v: np.abs(v).max(), [0.0, 0.0], [1.0, -1.0]),
        (lambda v: np.abs(v).max(), [0.2, 0.3], [1.3, -0.7]),
    ],
)
def test_a_norm_that_changes_its_sign_has_one_step_and_another_two(norm, known, wanted):
    class Control(AutomaticControl):
        def _norm(self, total, elastic):
            return norm(total) + 0.0 * elastic[0]

    control = Control(None, None, 2.0, lambda: np.array([7.0]), None)
    split = SimpleNamespace(
        du=np.array(known) - 1.0, rest=np.ones(2), unit=np.array([0.5, -1.0]), x=4.0
    )
    assert control(split, 0.5) == pytest.approx(wanted)


def test_strains_of_a_zone_alone_control_where_a_zone_is_given(tmp_path):
    text = f"""{BARS}
    T . 'TEMPS_CALCULES' = PROG 0. PAS 1. 4. ; T . 'PILOTAGE_INDIRECT' = VRAI ;
    T . 'FORCES_PILOTEES' = F1 ; T . 'ZONE_DE_PILOTAGE' = L2 ;
    T . 'PARAMETRE_DE_PILOTAGE' = EVOL 'MANU' (PROG 0. 4.) (PROG 0. 1.E-3) ; PASAPAS T ;
    """
    find = ran(text, tmp_path).session.root.find
    v = -moved(find("T"), "UY", find("P0").node)
    np.testing.assert_allclose(v, 5e-4 * np.arange(5), atol=1e-13)  # its strain is v/2


def test_every_zone_with_strains_is_looked_at_whatever_stands_before_it(tmp_path):
    text = """OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; P = 0. 0. ; Q = 2. 0. ; L = DROI 2 P Q ;
    S = L TRAN 2 (0. 1.) ; J = RACC 1.E-6 L (L PLUS (0. 0.)) ; B = DROI 1 P (0. 3.) ;
    M = (MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI2') ET
      (MODE (MANU 'POI1' P) 'MECANIQUE' 'ELASTIQUE' 'MODAL') ET
      (MODE S 'MECANIQUE' 'ELASTIQUE') ET (MODE B 'MECANIQUE' 'ELASTIQUE' 'BARR') ;"""
    find = ran(text, tmp_path).session.root.find
    for region, kept in (
        (None, [[True] * 4, [True]]),
        (find("S"), [[True] * 4]),
        (find("B"), [[True]]),
    ):
        given = {"MODELE": find("M"), "ZONE_DE_PILOTAGE": region}
        entries = SimpleNamespace(
            needed=given.get, get=given.get, error=lambda code: KeyError(code)
        )
        found = strain_points(entries, None).zones
        assert [k.tolist() for _, k in found] == kept


def test_collapse_load_is_where_automatic_steps_end(tmp_path):
    text = f"""{BARS}
    T . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG 0. 1.E3) (PROG 0. 1.E3)) ;
    T . 'TEMPS_CALCULES' = PROG 0. 600. ; T . 'AUTOMATIQUE' = VRAI ; T . 'AUTOPAS' = 12 ;
    T . 'AUTOCRIT' = 4.E-4 ; PASAPAS T ;
    """
    find = ran(text, tmp_path).session.root.find
    table = find("T")
    v, factors = -moved(table, "UY", find("P0").node), np.array(values(table, "TEMPS"))
    assert len(v) == 13
    np.testing.assert_allclose(factors, three_bars(v), rtol=1e-9)
    assert factors[-1] == pytest.approx(SY * (1 + np.sqrt(2.0)), rel=1e-9)
    assert v[-1] > 2.1e-3


def test_piloindi_gives_the_factor_by_itself(tmp_path):
    text = f"""{BARS}
    U1 = MANU 'CHPO' P0 2 'UX' 0. 'UY' -1. ; U0 = 0. * U1 ;
    X1 = PILOINDI T U0 U0 U0 U1 0.25 ; X2 = PILOINDI T U1 U0 U0 (-1. * U1) 0.25 ;
    X3 = AUTOPILO U1 U0 MO (T . 'CARACTERISTIQUES') T ;
    """
    find = ran(text, tmp_path).session.root.find
    assert (find("X1"), find("X2"), find("X3")) == pytest.approx((0.25, -0.25, 1.0))


# --- refusals --------------------------------------------------------------------------------

"""Beams with sections of fibres, elastic and plastic, against closed forms and plain beams."""

import numpy as np
import pytest

STEEL = "'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. 'ALPY' 0.8333 'ALPZ' 0.6"


def section(law="", extra="", ny=4, nz=6, centre=0.0):
    """A rectangle 0.1 (y) x 0.2 (z), its middle at `centre` along z."""
    return (
        f"OPTI DIME 3 ELEM QUA4 ; S = (DROI {ny} (-0.05 {centre - 0.1} 0.) "
        f"(0.05 {centre - 0.1} 0.)) TRAN {nz} (0. 0.2 0.) ; "
        f"MS = MODE S MECANIQUE ELASTIQUE {law} QUAS ; AS = MATE MS {STEEL} {extra} ; "
        "OPTI ELEM SEG2 ; L = DROI 8 (0. 0. 0.) (2. 0.5 1.) ; "
    )


BEAM = "M = MODE L MECANIQUE ELASTIQUE {} TIMO ; A = MATE M 'VECT' (0. 1. 0.) {} ; "
FIBRES = BEAM.format("SECTION", "'MODS' MS 'MATS' AS")
AREA, IY, IZ = 0.02, 0.1 * 0.2**3 / 12, 0.2 * 0.1**3 / 12


def test_elastic_section_is_the_plain_beam_of_its_rectangle(found):
    torsion = 0.8333 * IY + 0.6 * IZ
    plain = (
        f"'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. 'SECT' {AREA} 'INRY' {IY} 'INRZ' {IZ} "
        f"'TORS' {torsion} 'SECY' {0.8333 * AREA} 'SECZ' {0.6 * AREA}"
    )
    solve = (
        "B = BLOQ (POIN 1 L) 'DEPL' 'ROTA' ; F = (FORC (1. 2. 3.) (POIN 9 L)) ET "
        "(MOME (5. 6. 7.) (POIN 9 L)) ; U{0} = RESO ((RIGI M A) ET B) F ; "
        "S{0} = SIGM M A U{0} ; V{0} = MASS M A ; W{0} = V{0} * U1 ; "
        "K{0} = KSIG M S{0} A ; G{0} = K{0} * U1 ; "
    )
    u1, u2, s1, s2, w1, w2, g1, g2 = found(
        section() + FIBRES + solve.format(1) + BEAM.format("", plain) + solve.format(2),
        "U1", "U2", "S1", "S2", "W1", "W2", "G1", "G2",
    )  # fmt: skip
    for first, second in ((u1, u2), (w1, w2), (g1, g2)):
        for name in (n for n in second.components if n[0] in "URFM" and n[:2] != "FL"):
            ids = first.components[name].nodes
            scale = np.abs(second.values_at(name, ids)).max()
            np.testing.assert_allclose(
                first.values_at(name, ids), second.values_at(name, ids), atol=1e-9 * scale
            )
    for name, values in s1.blocks[0].components.items():
        np.testing.assert_allclose(values, s2.blocks[0].components[name], rtol=1e-7, atol=1e-9)


def test_gyroscopic_coupling_of_fibres_is_that_of_the_plain_shaft(found):
    plain = (
        f"'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. 'SECT' {AREA} 'INRY' {IY} 'INRZ' {IZ} "
        f"'TORS' {IY} 'OMEG' 3."
    )
    script = (
        section() + BEAM.format("SECTION", "'MODS' MS 'MATS' AS 'OMEG' 3.") + "G1 = GYRO M A ; "
        + BEAM.format("", plain) + "G2 = GYRO M A ; "
        "U = (MANU 'CHPO' L 2 'RY' 1. 'RZ' 2.) ; F1 = G1 * U ; F2 = G2 * U ; "
    )  # fmt: skip
    f1, f2 = found(script, "F1", "F2")
    for name in ("MX", "MY", "MZ"):
        ids = f2.components[name].nodes
        assert f1.values_at(name, ids) == pytest.approx(f2.values_at(name, ids), abs=1e-9)


def test_moment_curvature_of_a_perfectly_plastic_rectangle(found):
    # fibres of height 0.2 / 200: M = Mp (1 - (1 - c/h...)): closed form with the elastic core
    script = (
        section("PLASTIQUE PARFAIT_UNI", "'SIGY' 2.E8 'H' 0.", 1, 200)
        + "Z = PROG 4 * 0. ; C = PROG 0.005 0.01 0.02 0.1 ; MY MZ E = MOCU C Z Z MS AS 1.E-9 ; "
    )
    my, mz, e = found(script, "MY", "MZ", "E")
    k = np.array([0.005, 0.01, 0.02, 0.1])
    yield_k = 2e8 / (2e11 * 0.1)
    exact = np.where(
        k <= yield_k, 2e11 * IY * k, 2e8 * 0.1 * (0.1**2 - (0.1 * yield_k / k) ** 2 / 3)
    )
    np.testing.assert_allclose(my.values, exact, rtol=1e-4)
    np.testing.assert_allclose(mz.values, 0.0, atol=1e-3)
    np.testing.assert_allclose(e.values, 0.0, atol=1e-12)


def test_moment_under_a_normal_force_reaches_the_plastic_interaction(found):
    n = 0.5
    script = (
        section("PLASTIQUE PARFAIT_UNI", "'SIGY' 2.E8 'H' 0.", 1, 400)
        + f"N = PROG 30 * {-n * 2e8 * AREA} ; Z = PROG 30 * 0. ; C = PROG 0.01 PAS 0.01 0.3 ; "
        "MY MZ E T = MOCU C Z N MS AS 1.E-9 'VERIF' ; S = T . 'CONTRAINTES' . 30 ; "
        "X = INTG MS (EXCO 'SMXX' S) ; "
    )
    my, x = found(script, "MY", "X")
    assert my.values[-1] == pytest.approx(2e8 * 0.1 * 0.1**2 * (1 - n**2), rel=2e-3)
    assert x == pytest.approx(-n * 2e8 * AREA, rel=1e-8)  # the normal force, from the fibres


def test_kinematic_hardening_closes_a_cycle_of_the_moment(found):
    script = (
        section("PLASTIQUE PARFAIT_UNI", "'SIGY' 2.E8 'H' 2.E10", 1, 20)
        + "C = PROG 0.03 -0.03 0.03 -0.03 0.03 ; Z = PROG 5 * 0. ; "
        "MY MZ E = MOCU C Z Z MS AS 1.E-9 ; "
    )
    my = found(script, "MY").values
    assert my[2] == pytest.approx(my[4], rel=1e-9)
    assert my[1] == pytest.approx(-my[2], rel=1e-9)
    assert my[0] < 0.6 * (2e11 * IY * 0.03)


PUSH = """
L = DROI 20 (0. 0. 0.) (2. 0. 0.) ;
M = MODE L MECANIQUE ELASTIQUE SECTION PLASTIQUE SECTION TIMO ;
A = MATE M 'MODS' MS 'MATS' AS 'VECT' (0. 1. 0.) ;
CL = (BLOQ (POIN 1 L) 'DEPL' 'ROTA') ET (BLOQ L 'UX' 'UY' 'RZ' 'RX') ;
B2 = BLOQ (POIN 21 L) 'UZ' ;
T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = CL ET B2 ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI B2 0.05) (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 0.)) ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 0.1 {} ;
PASAPAS T ; N = (DIME (T . 'TEMPS')) - 1 ;
F = EXTR (T . 'REACTIONS' . N) (POIN 21 L) 'FZ' ;
V = T . 'VARIABLES_INTERNES' . N ; W = EXTR V 'VONS' 1 1 1 ; X = MAXI (EXCO W 'SMXX') ;
S = T . 'CONTRAINTES' . N ; MY = EXTR S 'MOMY' 1 1 1 ; MW = INTG MS ((EXCO W 'SMXX') * Z) ;
"""


def test_pushed_cantilever_of_fibres_reaches_its_plastic_moment(found):
    plastic = section("PLASTIQUE PARFAIT_UNI", "'SIGY' 2.E8 'H' 0.", 1, 40)
    depth = "Z = CHAN 'STRESSES' (CHAN 'CHAM' (EXCO 'SCAL' (COOR 2 S)) MS) MS ; "
    force, x, my = found(plastic + depth + PUSH.format("1."), "F", "X", "MY")
    # the point of the first beam is half of it away from its end
    assert abs(force) * (2.0 - 0.05) == pytest.approx(2e8 * 0.1 * 0.1**2, rel=3e-3)
    assert x == pytest.approx(2e8)
    assert abs(my) == pytest.approx(abs(force) * 1.95, rel=1e-6)


def test_section_law_of_beams_agrees_with_moment_curvature(found):
    plastic = section("PLASTIQUE CINEMATIQUE", "'SIGY' 2.E8 'H' 1.E10", 1, 20)
    depth = "Z = CHAN 'STRESSES' (CHAN 'CHAM' (EXCO 'SCAL' (COOR 2 S)) MS) MS ; "
    script = plastic + depth + PUSH.format("2.") + (
        "LM = PROG ; LC = PROG ; REPE B N ; I = &B ; "
        "LM = LM ET (EXTR (T . 'CONTRAINTES' . I) 'MOMY' 1 1 1) ; "
        "LC = LC ET (EXTR (EPSI M (T . 'DEPLACEMENTS' . I) A) 'CY' 1 1 1) ; FIN B ; "
        "O = PROG N * 0. ; Y1 Z1 E1 = MOCU LC O O MS AS 1.E-9 ; "
    )  # fmt: skip
    beam, alone = found(script, "LM", "Y1")
    # shear of the beam yields a little with it in von Mises' law
    np.testing.assert_allclose(alone.values, beam.values, rtol=0.01, atol=500.0)


def test_calculation_goes_on_from_the_fibres_of_an_earlier_one(found):
    plastic = section("PLASTIQUE PARFAIT_UNI", "'SIGY' 2.E8 'H' 1.E10", 1, 20)
    depth = "Z = CHAN 'STRESSES' (CHAN 'CHAM' (EXCO 'SCAL' (COOR 2 S)) MS) MS ; "
    whole = found(plastic + depth + PUSH.format("2."), "F")
    twice = PUSH.format("1.") + "T . 'TEMPS_CALCULES' = PROG 1.1 PAS 0.1 2. ; PASAPAS T ; " + (
        "N = (DIME (T . 'TEMPS')) - 1 ; F = EXTR (T . 'REACTIONS' . N) (POIN 21 L) 'FZ' ; "
    )  # fmt: skip
    parts = found(plastic + depth + twice, "F")
    assert abs(whole) > 1e3
    assert parts == pytest.approx(whole, rel=1e-7)


# ---- concrete -------------------------------------------------------------------------------

CONCRETE = section("PLASTIQUE BETON_BAEL", "'FC' 30.E6", 1, 400).replace("2.E11", "3.E10")
"""A rectangle 0.1 x 0.2."""


def test_crushed_concrete_section_is_the_integral_of_its_parabola(found):
    e = np.array([-0.5e-3, -1e-3, -2e-3, -3e-3])
    x = np.minimum(-e / 2e-3, 1.0)
    forces = -30e6 * x * (2 - x) * AREA
    # forces of the rising part only: the plateau leaves the strain free
    listed = " ".join(repr(float(n)) for n in forces[:2])
    script = CONCRETE + (
        f"N = PROG {listed} ; Z = PROG 2 * 0. ; MY MZ E = MOCU Z Z N MS AS 1.E-10 ; "
    )
    np.testing.assert_allclose(found(script, "E").values, e[:2], rtol=1e-6)


def test_concrete_without_tension_bends_about_its_open_side(found):
    # half of the section open: N = 0 has no moment, N < 0 on a section rotating about its edge
    k, h = 1e-3 / 0.2, 0.2
    u = 1e-3 / 2e-3  # largest x of the parabola
    force = 30e6 * 0.1 * h * (u - u**2 / 3)
    moment_edge = 30e6 * 0.1 * h**2 * (2 * u / 3 - u**2 / 4)
    script = CONCRETE + (
        f"C = PROG {k} ; N = PROG {-force} ; Z = PROG 0. ; MY MZ E T = MOCU C Z N MS AS 1.E-10 "
        "'VERIF' ; HI = MAXI (EXCO 'SMXX' (T . 'CONTRAINTES' . 1)) ; "
    )
    my, e, high = found(script, "MY", "E", "HI")
    assert e.values[0] == pytest.approx(-k * 0.1, rel=1e-5)  # zero strain at the upper edge
    assert my.values[0] == pytest.approx(moment_edge - force * 0.1, rel=1e-4)
    assert high <= 0.0


def test_unloaded_concrete_goes_down_its_line_and_opens(found):
    def force(e):
        return -30e6 * (2 * e - e**2) * AREA

    n = force(0.5)  # strain -1e-3
    back = 0.5 * n
    script = CONCRETE + (
        f"N = PROG {n} {back} {n} ; Z = PROG 3 * 0. ; MY MZ E = MOCU Z Z N MS AS 1.E-10 ; "
    )
    e = found(script, "E").values
    assert e[1] == pytest.approx(-1e-3 - (n - back) / (3e10 * AREA), rel=1e-6)
    assert e[2] == pytest.approx(e[0], rel=1e-6)


def test_reinforced_section_reaches_the_moment_of_its_steel(found):
    # steel at z = -0.08 pulls with all its strength on a block of concrete under full stress
    area = 2e-4
    script = CONCRETE + (
        "MP = MODE (MANU 'POI1' (0. -0.08 0.)) MECANIQUE ELASTIQUE PLASTIQUE PARFAIT_UNI POJS ; "
        f"AP = MATE MP 'YOUN' 2.E11 'NU' 0.3 'SIGY' 5.E8 'H' 0. 'SECT' {area} 'ALPY' 0. "
        "'ALPZ' 0. ; C = PROG -0.05 -0.1 -0.2 ; Z = PROG 3 * 0. ; "
        "MY MZ E = MOCU C Z Z (MS ET MP) (AS ET AP) 1.E-9 ; "
    )
    my = found(script, "MY").values
    pull = 5e8 * area
    depth = pull / (30e6 * 0.1)
    exact = -pull * (0.1 + 0.08 - depth / 2)
    assert my[-1] == pytest.approx(exact, rel=0.01)
    # the parabola's share of the block moves its resultant: a closed form at each curvature
    k = np.array([0.05, 0.1, 0.2])
    c = depth + 2e-3 / k / 3  # depth of the neutral axis: block c, parabola over 2e-3 / k
    first = 2e-3 / k
    moment = (c - first) ** 2 / 2 + 2 / 3 * first * (c - 5 / 8 * first)
    lever = 30e6 * 0.1 * moment / pull
    np.testing.assert_allclose(my, -pull * (0.18 - lever), rtol=2e-3)


SHAKEN = (
    "L = DROI 4 (0. 0. 0.) (0. 0. 3.) ; M = MODE L MECANIQUE ELASTIQUE SECTION {} TIMO ; "
    "A = MATE M 'MODS' MS 'MATS' AS 'VECT' (0. 1. 0.) ; T = TABL ; "
    "T . 'RIGI' = (RIGI M A) ET (BLOQ (POIN 1 L) 'DEPL' 'ROTA') ; T . 'MASS' = MASS M A ; {} "
    "T . 'CHAR' = CHAR 'MECA' (FORC (3.E4 1.E4 0.) (POIN 5 L)) (EVOL 'MANU' (PROG 0. 0.02 0.04 1.) "
    "(PROG 0. 1. 0. 0.)) ; T . 'TEMPS_CALCULES' = PROG 0. PAS 2.E-3 0.1 ; "
    "T . 'PAS_SAUVES' = 'TOUS' ; R = DYNAMIC T ; X = PROG ; REPE B 51 ; "
    "X = X ET (EXTR (R . &B . 'DEPL') (POIN 5 L) 'UX') ; FIN B ; "
    "E = T . 'ENERGIES' ; "
)
_FIBRES_IN_TIME = "T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "


def test_fibres_that_do_not_yield_move_in_time_as_the_elastic_beam(found):
    plain = found(section(ny=2, nz=4) + SHAKEN.format("", ""), "X").values
    law = section("PLASTIQUE PARFAIT_UNI", "'SIGY' 1.E12 'H' 0.", 2, 4)
    fibres = found(law + SHAKEN.format("PLASTIQUE SECTION", _FIBRES_IN_TIME), "X").values
    assert np.abs(plain).max() > 1e-3
    np.testing.assert_allclose(fibres, plain, atol=1e-9 * np.abs(plain).max())


def test_yielding_fibres_leave_a_beam_bent_in_time(found):
    law = section("PLASTIQUE PARFAIT_UNI", "'SIGY' 1.E8 'H' 0.", 2, 8)
    fibres = found(law + SHAKEN.format("PLASTIQUE SECTION", _FIBRES_IN_TIME), "X").values
    plain = found(section(ny=2, nz=8) + SHAKEN.format("", ""), "X").values
    assert np.abs(fibres - plain).max() > 0.05 * np.abs(plain).max()


def test_expansion_of_fibres_is_refused_and_none_without_their_alpha(found, refused):
    heat = FIBRES + "E = EPTH M A (MANU 'CHPO' L 1 'T' 10.) ; X = MAXI (EXCO 'EPS' E) 'ABS' ; "
    assert found(section() + heat, "X") == 0.0
    assert "expansion of sections of fibres" in refused(section(extra="'ALPH' 1.E-5") + heat)


OFFSET = (
    "OPTI DIME 3 ELEM QUA4 ; S = (DROI 2 (-0.05 -0.1 0.) (0.05 -0.1 0.)) TRAN 3 (0. 0.2 0.) ; "
    "S1 = S PLUS (0.3 0.4 0.) ; "
    f"MS = MODE S MECANIQUE ELASTIQUE QUAS ; AS = MATE MS {STEEL} ; "
    f"MT = MODE S1 MECANIQUE ELASTIQUE QUAS ; AT = MATE MT {STEEL} ; OPTI ELEM SEG2 ; "
    "L1 = DROI 4 (0. 0. 0.) (2. 0. 0.) ; L2 = L1 PLUS (0. 0.3 0.4) ; "
    "M1 = MODE L1 MECANIQUE ELASTIQUE SECTION TIMO ; "
    "M2 = MODE L2 MECANIQUE ELASTIQUE SECTION TIMO ; "
    "A1 = MATE M1 'MODS' MT 'MATS' AT 'VECT' (0. 1. 0.) ; "
    "A2 = MATE M2 'MODS' MS 'MATS' AS 'VECT' (0. 1. 0.) ; "
)
ARM = np.array([0.0, 0.3, 0.4])


def vector(field, names, node):
    return np.array([field.values_at(n, np.array([node]))[0] for n in names])


@pytest.mark.parametrize("force", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)])
def test_fibres_off_the_line_are_a_beam_on_a_line_beside(found, force):
    moment = np.cross(-ARM, force)
    script = OFFSET + (
        "U1 = RESO ((RIGI M1 A1) ET (BLOQ (POIN 1 L1) 'DEPL' 'ROTA')) "
        "(FORC ({} {} {}) (POIN 5 L1)) ; ".format(*force)
        + "U2 = RESO ((RIGI M2 A2) ET (BLOQ (POIN 1 L2) 'DEPL' 'ROTA')) "
        "((FORC ({} {} {}) (POIN 5 L2)) ET (MOME ({} {} {}) (POIN 5 L2))) ; ".format(
            *force, *(float(v) for v in moment)
        )
    )
    u1, u2, l1, l2 = found(script, "U1", "U2", "L1", "L2")
    ends = [line.blocks[0].connectivity[-1, -1] for line in (l1, l2)]
    turn1, turn2 = (vector(u, ("RX", "RY", "RZ"), e) for u, e in zip((u1, u2), ends, strict=True))
    move1, move2 = (vector(u, ("UX", "UY", "UZ"), e) for u, e in zip((u1, u2), ends, strict=True))
    np.testing.assert_allclose(turn1, turn2, atol=1e-9 * np.abs(turn2).max())
    moved = move2 - np.cross(turn2, ARM)
    np.testing.assert_allclose(move1, moved, atol=1e-9 * np.abs(moved).max())


def test_mass_of_fibres_off_the_line_is_that_of_a_beam_beside(found):
    move, turn = np.array([0.7, -0.4, 0.5]), np.array([0.3, 0.8, -0.6])
    beside = move + np.cross(turn, ARM)

    def motion(line, u):
        parts = zip(("UX", "UY", "UZ", "RX", "RY", "RZ"), (*u, *turn), strict=True)
        return f"MANU 'CHPO' {line} 6 " + " ".join(f"'{n}' {float(v)!r}" for n, v in parts)

    script = OFFSET + (
        f"X = XTMX ({motion('L1', move)}) (MASS M1 A1) ; "
        f"Y = XTMX ({motion('L2', beside)}) (MASS M2 A2) ; "
    )
    x, y = found(script, "X", "Y")
    assert x == pytest.approx(y, rel=1e-9)


@pytest.mark.parametrize(
    ("law", "given", "strains", "stresses"),
    [
        (
            "ACIER_UNI",
            "'YOUN' 2.E11 'NU' 0.3 'STSY' 4.E8 'STSU' 6.E8 'EPSH' 0.02 'EPSU' 0.1 'ROFA' 20. "
            "'BFAC' 0.01 'A1FA' 18.5 'A2FA' 0.15",
            (0.01, 0.05, 0.0499),
            # the plateau, the curve of fourth order, the elastic slope behind a reversal
            (4e8, 6e8 - 2e8 * 0.625**4, 6e8 - 2e8 * 0.625**4 - 2e7),
        ),
        (
            "BETON_UNI",
            "'YOUN' 3.E10 'NU' 0.2 'STFC' 3.E7 'EZER' 0.002 'STFT' 3.E6 'ZETA' 100. 'ST85' 6.E6 "
            "'TRAF' 3.",
            (-0.001, -0.006, -0.02),
            (-22.5e6, -18e6, -6e6),
        ),
    ],
)
def test_bars_have_the_laws_of_fibres(found, law, given, strains, stresses):
    """A bar of 2 m and 1e-3 m2 that is pulled by imposed displacements."""
    moved = " ".join(repr(2 * e) for e in strains)
    script = (
        f"OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; M = MODE L MECANIQUE ELASTIQUE "
        f"PLASTIQUE {law} BARR ; A = MATE M {given} 'SECT' 1.E-3 ; B = BLOQ 'UX' (POIN 2 L) ; "
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = "
        "B ET (BLOQ 'UX' (POIN 1 L)) ET (BLOQ 'UY' L) ; T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI B 1.) "
        f"(EVOL 'MANU' (PROG 0. 1. 2. 3.) (PROG 0. {moved})) ; T . 'TEMPS_CALCULES' = "
        "PROG 0. 'PAS' 1. 3. ; PASAPAS T ; X = PROG ; REPE B 3 ; "
        "X = X ET (EXTR (T . 'CONTRAINTES' . &B) 'EFFX' 1 1 1) ; FIN B ; "
    )
    np.testing.assert_allclose(found(script, "X").values, 1e-3 * np.array(stresses), rtol=1e-4)


def test_a_section_of_cracked_concrete_and_steel_has_the_moment_of_its_curves(found):
    """MOCU against an integral of both first curves over the plane strain that MOCU found."""
    concrete = (
        "'YOUN' 3.E10 'NU' 0.2 'STFC' 3.E7 'EZER' 0.002 'STFT' 3.E6 'ZETA' 100. 'ST85' 6.E6 "
        "'TRAF' 3. 'ALPY' 0. 'ALPZ' 0."
    )
    steel = (
        "'YOUN' 2.E11 'NU' 0.3 'STSY' 4.E8 'STSU' 6.E8 'EPSH' 0.01 'EPSU' 0.1 'ROFA' 20. "
        "'BFAC' 0.01 'A1FA' 18.5 'A2FA' 0.15 'SECT' 4.E-4 'ALPY' 0. 'ALPZ' 0."
    )
    script = (
        "OPTI DIME 3 ELEM QUA4 ; S = (DROI 1 (-0.1 -0.2 0.) (0.1 -0.2 0.)) TRAN 200 (0. 0.4 0.) ; "
        "B = MANU 'POI1' ((0. 0.15 0.) ET (0. -0.15 0.)) ; "
        "MC = MODE S MECANIQUE ELASTIQUE PLASTIQUE BETON_UNI QUAS ; "
        "MS = MODE B MECANIQUE ELASTIQUE PLASTIQUE ACIER_UNI POJS ; "
        f"A = (MATE MC {concrete}) ET (MATE MS {steel}) ; K = PROG 1.E-3 'PAS' 1.E-3 0.08 ; "
        "N = DIME K ; Z = PROG N * 0. ; "
        "MY MZ E = MOCU K Z Z (MC ET MS) A 1.E-10 ; "
    )
    moments, strains = (v.values for v in found(script, "MY", "E"))
    z = (np.arange(20000) + 0.5) / 20000 * 0.4 - 0.2

    def pressed(e):
        x = -e / 0.002
        return np.where(x <= 1, 3e7 * x * (2 - x), np.maximum(3e7 * (1 - 100 * (-e - 0.002)), 6e6))

    def sheet(e):
        cracked = np.clip(3e6 * (1 - (e - 1e-4) / 2e-4), 0, None)
        return np.where(e < 0, -pressed(e), np.where(e <= 1e-4, 3e10 * e, cracked))

    def bar(e):
        hard = 6e8 - 2e8 * ((0.1 - abs(e)) / 0.09) ** 4
        return np.sign(e) * (min(2e11 * abs(e), 4e8) if abs(e) <= 0.01 else hard)

    for k in (5, 30, 79):  # before and after cracks, and where the concrete is crushed
        e = strains[k] + 1e-3 * (k + 1) * z
        bars = [(y, 4e-4 * bar(strains[k] + 1e-3 * (k + 1) * y)) for y in (-0.15, 0.15)]
        along = 0.2 * 0.4 * sheet(e).mean() + sum(f for _, f in bars)
        moment = 0.2 * 0.4 * (sheet(e) * z).mean() + sum(y * f for y, f in bars)
        # in 400 layers; what was pressed a little before it was pulled cracks a little early
        assert abs(along) < 1e-2 * sum(abs(f) for _, f in bars)
        assert moments[k] == pytest.approx(moment, rel=5e-3)

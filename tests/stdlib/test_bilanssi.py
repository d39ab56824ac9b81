"""@BILANSSI: rigid footings against statics by hand, floor spectra against their definition."""

from functools import cache

import numpy as np
import pytest
from script_runs import ran

from ssilang.cli.run import RunOptions, run_text

B, K, N, MU, CAPACITY = 4.0, 2.0e7, 6.0e5, 0.7, 6.0e5
SHEARS = (2.0e5, 6.0e5, 9.0e5)  # 1 m above the footing: e = 1/3, 1, 1.5 m

STRIP = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; S = DROI 32 (0. 0.) (4. 0.) ; F = S PLUS (0. 0.) ;"
    "J = RACC 1.E-3 F S ; M = MODE J MECANIQUE ELASTIQUE JOINT_SDM JOI2 ; PC = 2. 1. ;"
    f"A = MATE M 'KN' {K} 'KS' {K} ;"
    "B = (BLOQ 'UX' 'UY' S) ET (RELA 'CORI' 'DEPL' 'ROTA' PC F) ;"
)
PUSH = (
    "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = B ;"
    "C = EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.) ;"
    f"E = EVOL 'MANU' (PROG 0. 1. 2. 3. 4.) (PROG 0. 0. {' '.join(f'{h:.1f}' for h in SHEARS)}) ;"
    f"T . 'CHARGEMENT' = (CHAR 'MECA' (FORC (0. {-N}) PC) C) ET "
    "(CHAR 'MECA' (FORC (1. 0.) PC) E) ; T . 'TEMPS_CALCULES' = PROG 0. 1. 2. 3. 4. ; PASAPAS T ;"
    "V = TABL ; V . 'RESULTATS' = T ; V . 'MODELE' = M ; V . 'CARACTERISTIQUES' = A ;"
)
VERDICT = f"V . 'CAPACITE' = {CAPACITY} ; V . 'FROTTEMENT' = {MU} ; R = @BILANSSI V ;"


def histories(result):
    table = result.session.root.find("R").get("HISTOIRES")
    return {str(k): np.array(v.values) for k, v in table.items()}


def peak(result, name):
    found = result.session.root.find("R").get("PICS").get(name)
    return found.get("VALEUR"), found.get("TEMPS")


@cache
def pushed():
    return ran(STRIP + PUSH + VERDICT)


def of_statics():
    """The share of a strip in contact and the pressure at its toe, at rest and pushed."""
    e = np.array([0.0, *SHEARS]) / N
    lifted = e > B / 6
    share = np.where(lifted, 3.0 * (0.5 - e / B), 1.0)
    toe = np.where(lifted, 2.0 * N / (3.0 * (B / 2 - e)), N / B * (1.0 + 6.0 * e / B))
    return share, toe


def test_contact_and_toe_pressure_of_a_strip_are_those_of_statics():
    got = histories(pushed())
    share, toe = of_statics()
    np.testing.assert_allclose(got["TEMPS"], [1.0, 2.0, 3.0, 4.0])
    np.testing.assert_allclose(got["FORCE"], N, rtol=1e-9)
    np.testing.assert_allclose(got["MOMENT"], [0.0, *(-h for h in SHEARS)], atol=1e-3)
    # cells of B/32, the one where contact ends is a straight line over two points
    np.testing.assert_allclose(got["PART"], share, atol=2e-3)
    np.testing.assert_allclose(got["PRESSION"], toe, rtol=3e-3)
    np.testing.assert_allclose(got["TAUX"], toe / CAPACITY, rtol=3e-3)


def test_factors_of_a_strip_are_those_of_statics():
    got = histories(pushed())
    expected = [1000.0, *(N * B / 2 / h for h in SHEARS)]
    np.testing.assert_allclose(got["RENVERSEMENT"], expected, rtol=1e-9)
    np.testing.assert_allclose(got["GLISSEMENT"][1:], [MU * N / h for h in SHEARS], rtol=1e-9)
    for name in ("PART", "RENVERSEMENT", "GLISSEMENT"):
        assert peak(pushed(), name) == (got[name].min(), 4.0)
    assert peak(pushed(), "ROTATION")[0] == got["ROTATION"][-1] < 0.0  # the one largest in size
    left = pushed().session.root.find("R").get("RESIDUS")
    assert left.get("ROTATION") == pytest.approx(got["ROTATION"][-1])


def test_rotation_and_settlement_in_full_contact():
    got = histories(pushed())
    assert got["ENFONCEMENT"][:2] == pytest.approx([N / (K * B)] * 2, rel=1e-9)
    assert got["ROTATION"][1] == pytest.approx(-SHEARS[0] / (K * B**3 / 12), rel=1e-9)


def test_a_raft_in_space_has_both_its_axes():
    lx, ly, moment = 6.0, 4.0, 3.0e5
    result = ran(
        f"OPTI DIME 3 ELEM QUA4 ; S = (DROI 6 (0. 0. 0.) ({lx} 0. 0.)) TRAN 4 (0. {ly} 0.) ;"
        "F = S PLUS (0. 0. 0.) ; J = LIAI F S ; M = MODE J MECANIQUE ELASTIQUE JOINT_SDM JOI4 ;"
        f"A = MATE M 'KN' {K} 'KS' {K} ; PC = {lx / 2} {ly / 2} 1. ;"
        "B = (BLOQ 'UX' 'UY' 'UZ' S) ET (RELA 'CORI' 'DEPL' 'ROTA' PC F) ;"
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = B ;"
        "C = EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.) ;"
        f"T . 'CHARGEMENT' = (CHAR 'MECA' (FORC (0. 0. {-N}) PC) C) ET "
        f"(CHAR 'MECA' (MOME 'MX' {moment} 'MY' {0.5 * moment} PC) C) ;"
        "T . 'TEMPS_CALCULES' = PROG 0. 1. ; PASAPAS T ;"
        "V = TABL ; V . 'RESULTATS' = T ; V . 'MODELE' = M ; V . 'CARACTERISTIQUES' = A ;"
        "R = @BILANSSI V ;"
    )
    got = histories(result)
    turns = moment / (K * lx * ly**3 / 12), 0.5 * moment / (K * ly * lx**3 / 12)
    assert got["MOMENT"] == pytest.approx(moment * np.sqrt(1.25), rel=1e-9)
    assert got["ROTATION"] == pytest.approx(np.hypot(*turns), rel=1e-9)
    assert got["RENVERSEMENT"] == pytest.approx(N * ly / 2 / moment, rel=1e-9)
    assert got["PART"] == pytest.approx(1.0)


def test_a_disc_in_axisymmetry_has_its_whole_force_and_no_moment():
    result = ran(
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; S = DROI 8 (0. 0.) (2. 0.) ; F = S PLUS (0. 0.) ;"
        "J = RACC 1.E-3 F S ; M = MODE J MECANIQUE ELASTIQUE JOINT_SDM JOI2 ;"
        f"A = MATE M 'KN' {K} 'KS' {K} ; PC = F POIN 1 ;"
        "B = (BLOQ 'UR' 'UZ' S) ET (BLOQ 'UR' F) ET (RELA 'ENSE' 'UZ' F) ;"
        + PUSH.replace("(FORC (1. 0.) PC)", "(FORC (0. -1.) PC)")
        + VERDICT
    )
    got = histories(result)
    pushed_down = N + np.array([0.0, *SHEARS])
    np.testing.assert_allclose(got["FORCE"], pushed_down, rtol=1e-9)
    np.testing.assert_allclose(got["PRESSION"], pushed_down / (4 * np.pi), rtol=1e-9)
    np.testing.assert_allclose(got["ENFONCEMENT"], pushed_down / (4 * np.pi * K), rtol=1e-9)
    assert not got["MOMENT"].any()
    assert "RENVERSEMENT" not in got


def test_floor_spectra_are_broadened_and_have_the_ground_added(tmp_path):
    frequencies = np.geomspace(0.5, 20.0, 25)
    listed = " ".join(f"{f:.12g}" for f in frequencies)
    text = (
        STRIP + "U0 = (MANU 'CHPO' PC 3 'UX' 0. 'UY' -7.5E-3 'RZ' 0.) ET "
        "(MANU 'CHPO' F 2 'UX' 0. 'UY' -7.5E-3) ; T = TABL ; T . 'DEPL' = U0 ;"
        "T . 'VITE' = 0. * U0 ; T . 'RIGI' = B ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ;"
        "T . 'MASS' = (MASS 'DEPL' 6.E4 PC) ET (MASS 'ROTA' 1.E5 PC) ;"
        "LT = PROG 0. 'PAS' 0.005 0.4 ; LA = SIN (LT * 720.) ;"
        "T . 'CHAR' = (CHAR 'MECA' (FORC (0. -6.E5) PC) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)))"
        " ET (CHAR 'MECA' (FORC (-6.E4 0.) PC) (EVOL 'MANU' LT LA)) ; T . 'TEMPS_CALCULES' = LT ;"
        "T . 'PAS_SAUVES' = 'TOUS' ; D = DYNAMIC T ; V = TABL ; V . 'RESULTATS' = D ;"
        "V . 'MODELE' = M ; V . 'CARACTERISTIQUES' = A ; P = TABL ; P . 'POINT' = PC ;"
        "P . 'COMPOSANTE' = 'UX' ; P . 'ACCELERATION_BASE' = EVOL 'MANU' LT LA ;"
        f"P . 'FREQUENCES' = PROG {listed} ; P . 'AMORTISSEMENTS' = PROG 0.02 0.05 ;"
        "Q = TABL ; Q . 'POINT' = PC ; Q . 'COMPOSANTE' = 'UX' ; Q . 'ELARGISSEMENT' = 0.1 ;"
        "Q . 'FREQUENCES' = P . 'FREQUENCES' ; Q . 'ACCELERATION_BASE' = 2. * "
        "(P . 'ACCELERATION_BASE') ; V . 'PLANCHERS' = TABL ; V . 'PLANCHERS' . 1 = P ;"
        "V . 'PLANCHERS' . 2 = Q ; V . 'FICHIER_CSV' = 'footing' ;"
        "V . 'DESSIN' = VRAI ; R = @BILANSSI V ; X = PROG ;"
        "REPE I (DIME LT) ; X = X ET (EXTR (D . &I . 'ACCE') 'UX' PC) ; FIN I ;"
        "S = SPO (EVOL 'MANU' LT (X + LA)) 'AMOR' (PROG 0.02 0.05) 'FREQ' (P . 'FREQUENCES')"
        " 'ACCE' ; W = SPO (EVOL 'MANU' LT (X + (2. * LA))) 'AMOR' 0.05 'FREQ' (P . 'FREQUENCES')"
        " 'ACCE' ; LA = PROG (MAXI (ABS (X + LA))) (MAXI (ABS (X + (2. * LA)))) ;"
    )
    result = ran(text, options=RunOptions(output_directory=tmp_path))
    find = result.session.root.find
    np.testing.assert_allclose(find("R").get("ACCELERATIONS").values, find("LA").values)
    fine = np.geomspace(0.5, 20.0, 20_001)
    for number, name, by in ((1, "S", 0.15), (2, "W", 0.1)):
        raw, wide = (find("R").get(w).get(number) for w in ("SPECTRES", "SPECTRES_ELARGIS"))
        for part, spectrum, expected in zip(wide.parts, raw.parts, find(name).parts, strict=True):
            np.testing.assert_allclose(spectrum.ordinates, expected.ordinates, rtol=1e-12)
            dense = np.interp(fine, frequencies, spectrum.ordinates)
            for f, value in zip(frequencies, part.ordinates, strict=True):
                near = (fine >= f / (1.0 + by)) & (fine <= f / (1.0 - by))
                assert value == pytest.approx(dense[near].max(), rel=1e-3)
    assert len(list(tmp_path.glob("*.png"))) == 5
    table = (tmp_path / "footing.csv").read_text()
    assert "RENVERSEMENT" in table.splitlines()[0]
    assert len(table.splitlines()) == 82


def test_dead_load_and_missing_weight_are_told():
    result = run_text(STRIP + PUSH + "V . 'CAPACITE' = 1.E5 ; R = @BILANSSI V ;")
    assert [w.code for w in result.session.warnings] == ["stdlib.bilanssi-dead-load"]
    lifted = PUSH.replace(f"(0. {-N})", "(0. 0.)").replace("0. 1. 2. 3. 4. ; P", "0. 1. ; P")
    result = run_text(STRIP + lifted + "R = @BILANSSI V ;")
    assert "stdlib.bilanssi-no-weight" in [w.code for w in result.session.warnings]


def macro(law, sizes, dimension=2):
    """A macro-element under a base that turns and slides; C below, PUSH pushes it 1 m above."""
    names = "'UX' 'UY' 'RZ'" if dimension == 2 else "'UX' 'UY' 'UZ' 'RX' 'RY' 'RZ'"
    points = "PC = 0. 0. ; PS = 0. -1. ;" if dimension == 2 else "PC = 0. 0. 0. ; PS = 0. 0. -1. ;"
    return (
        f"OPTI DIME {dimension} {'MODE PLAN DEFO' if dimension == 2 else ''} ELEM SEG2 ; {points}"
        f"J = MANU 'SEG2' PS PC ; M = MODE J MECANIQUE ELASTIQUE {law} JOI1 ;"
        f"A = MATE M {sizes} ; B = BLOQ {names} PS ;"
    )


AT_BASE = PUSH.replace("(FORC (1. 0.) PC)", "((FORC (1. 0.) PC) ET (MOME 'MZ' -1. PC))")


def test_a_macro_element_has_the_statics_of_a_strip():
    stiff = f"'KN' {K * B} 'KS' {K} 'LARG' {B}"
    got = verdict(macro("MACRO_SEMELLE", stiff) + AT_BASE + VERDICT)
    share, toe = of_statics()
    np.testing.assert_allclose(got["FORCE"], N, rtol=1e-9)
    assert got["ENFONCEMENT"][1] == pytest.approx(N / (K * B), rel=1e-9)
    np.testing.assert_allclose(got["MOMENT"], [0.0, *(-h for h in SHEARS)], atol=1e-3)
    np.testing.assert_allclose(got["PART"], share, rtol=1e-9)
    np.testing.assert_allclose(got["PRESSION"], toe, rtol=1e-9)
    np.testing.assert_allclose(got["RENVERSEMENT"][1:], [N * B / 2 / h for h in SHEARS], rtol=1e-9)
    np.testing.assert_allclose(got["GLISSEMENT"][1:], [MU * N / h for h in SHEARS], rtol=1e-9)
    # the edge that lifts: pressures fall to nothing where the base does, along a line
    turn = np.abs(got["ROTATION"])
    np.testing.assert_allclose(turn[2:], toe[2:] / K / (share[2:] * B), rtol=1e-9)
    np.testing.assert_allclose(got["OUVERTURE"], turn * B * (1 - share), rtol=1e-9)


def test_a_strip_on_clay_presses_and_drags_as_far_as_the_clay_goes():
    """A first push: N = q b + q r/2, r = q/(k theta) the part whose ground is still elastic."""
    c = 3.0 * N / ((2 + np.pi) * B)  # N is a third of the capacity
    most = N * (B - B / 3) / 2
    text = macro("MACRO_SEMELLE", f"'KN' {50 * K * B} 'KS' {50 * K} 'LARG' {B} 'COHE' {c!r}")
    moments = [part * most for part in (0.3, 0.6, 0.93)]
    pushed = (
        PUSH.replace("200000.0 600000.0 900000.0", " ".join(f"{m:.1f}" for m in moments))
        .replace("(FORC (1. 0.) PC)", "(MOME 'MZ' -1. PC)")
        .replace("(FORC (0. ", "(FORC (2.E4 ")
    )
    got = verdict(text + pushed + VERDICT)
    np.testing.assert_allclose(got["FORCE"], N, rtol=1e-6)
    np.testing.assert_allclose(got["MOMENT"][1:], [-m for m in moments], rtol=1e-6)
    assert got["PRESSION"][-1] == pytest.approx((2 + np.pi) * c, rel=0.02)  # less by the drag
    elastic = (2 + np.pi) * c / (50 * K * np.abs(got["ROTATION"][-1]))
    assert 0.1 * B < elastic < 0.5 * B
    assert got["PART"][-1] == pytest.approx(1 / 3 + elastic / (2 * B), abs=1 / 64)  # stripes
    np.testing.assert_allclose(got["GLISSEMENT"], MU * N / 2.0e4, rtol=1e-6)
    np.testing.assert_allclose(got["RENVERSEMENT"][-1], N * B / 2 / moments[-1], rtol=1e-6)


@pytest.mark.parametrize(
    ("law", "sizes", "area", "second", "edge"),
    [
        ("MACRO_SEMELLE", "'LARG' 6. 'LONG' 4.", 24.0, (4**3 * 6 / 12, 6**3 * 4 / 12), (2.0, 3.0)),
        ("MACRO_DISQUE", "'RAYO' 2.", 4 * np.pi, (4 * np.pi, 4 * np.pi), (2.0, 2.0)),
    ],
)
def test_a_macro_element_in_space_has_both_its_axes(law, sizes, area, second, edge):
    moment, shear = 2.0e5, 3.0e4
    turn = f"(MOME 'MX' {moment} 'MY' {moment / 2} PC)"
    push = (
        PUSH.replace("(FORC (0. ", "(FORC (0. 0. ")
        .replace("(FORC (1. 0.) PC)", f"(FORC ({shear} {2 * shear} 0.) PC)")
        .replace("0. 0. 200000.0 600000.0 900000.0", "0. 0. 1. 1. 1.")
        .replace("ET (CHAR", f"ET (CHAR 'MECA' {turn} E) ET (CHAR")
        .replace("0. 1. 2. 3. 4. ; P", "0. 1. 2. ; P")
    )
    text = macro(law, f"'KN' {K * area} 'KS' {K} 'QN' {K} {sizes}", 3)
    got = verdict(text + push + VERDICT)
    turns = moment / (K * second[0]), 0.5 * moment / (K * second[1])
    reach = np.hypot(*turns) * edge[0] if law == "MACRO_DISQUE" else np.dot(turns, edge)
    np.testing.assert_allclose(got["FORCE"], N, rtol=1e-9)
    assert got["ROTATION"][-1] == pytest.approx(np.hypot(*turns), rel=1e-9)
    assert got["PRESSION"][-1] == pytest.approx(N / area + K * reach, rel=1e-9)
    assert got["PART"][-1] == 1.0
    assert got["GLISSEMENT"][-1] == pytest.approx(MU * N / (shear * np.sqrt(5)), rel=1e-9)
    factors = N * edge[0] / moment, N * edge[1] / (moment / 2)
    assert got["RENVERSEMENT"][-1] == pytest.approx(min(factors), rel=1e-9)


def verdict(text):
    return histories(ran(text))

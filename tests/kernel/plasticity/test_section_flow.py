"""Sections that yield as a whole: pipes, beams, thin shells, against closed forms."""

import numpy as np
import pytest
from script_runs import finder, ran
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.materials.plastic.section_flow import (
    CreepingSections,
    SectionParameters,
    respond,
)

SY = 2e8
PUSH = """
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ; T . 'BLOCAGES_MECANIQUES' = BL ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI B2 {size}) (EVOL 'MANU' (PROG 0. {path}) (PROG 0. {at})) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 {end} ; {more} PASAPAS T ;
N = (DIME (T . 'TEMPS')) - 1 ; SI = T . 'CONTRAINTES' . N ;
R = T . 'REACTIONS' . N ;
F = XTY R (MANU 'CHPO' B 1 '{dual}' 1.) (MOTS '{dual}') (MOTS '{dual}') ;
Q = MAXI (VMIS MO SI MA) ;
"""
LINE = """
OPTI DIME 3 ELEM SEG2 ; L = DROI 4 (0. 0. 0.) (2. 0. 0.) ; A = POIN L 'INIT' ; B = POIN L 'FINA' ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' {law} {element} ;
MA = MATE MO 'YOUN' 2.E11 'NU' 0.3 {strength} {section} 'VECT' (0. 1. 0.) ;
B2 = BLOQ '{what}' B ; BL = (BLOQ 'DEPL' 'ROTA' A) ET B2 ;
"""
PIPE = "'EPAI' 0.01 'RAYO' 0.105"
AREA, INERTIA, MEAN = (
    np.pi * (0.105**2 - 0.095**2), np.pi / 4 * (0.105**4 - 0.095**4), 0.1,
)  # fmt: skip
BEAM = "'SECT' 0.02 'INRY' 1.E-4 'INRZ' 2.E-4 'TORS' 3.E-4 'DX' 0.1 'DY' 0.2 'DZ' 0.15"
PERFECT = {"law": "'PARFAIT'", "strength": f"'SIGY' {SY:g}"}


def run(tmp_path, deck, **words):
    words = {"path": "1.", "at": "1.", "end": "1.", "more": "", **PERFECT, **words}
    find = finder(f"{deck}{PUSH}".format(**words), tmp_path)
    return find


@together("element, section, what, dual, size, limit", [
        ("TUYA", PIPE, "UX", "FX", 0.01, SY * AREA),
        ("TUYA", PIPE, "RX", "MX", 0.4, SY * 2 * INERTIA / (np.sqrt(3) * MEAN)),
        ("TUYA", PIPE, "RZ", "MZ", 0.2, SY * INERTIA * 4 / np.pi / MEAN),
        ("TUYA", PIPE, "UY", "FY", 0.2, SY * INERTIA * 4 / np.pi / MEAN / 2.0),
        ("TUYA", f"{PIPE} 'CFMZ' 2.", "RZ", "MZ", 0.2, SY * INERTIA / 2 / MEAN),
        # an elbow: gamma = 8/9 / lambda^(2/3), lambda = 0.01 0.3 / 0.1^2
        (
            "TUYA", f"{PIPE} 'RACO' 0.3", "RZ", "MZ", 0.4,
            SY * INERTIA * 4 / np.pi / MEAN / (8 / 9 / 0.3 ** (2 / 3)),
        ),
        ("POUT", BEAM, "UZ", "FZ", 0.2, SY * 1e-4 / 0.15 / 2.0),
        ("POUT", BEAM, "RX", "MX", 0.2, SY * 3e-4 / 0.1),
        ("TIMO", BEAM, "RZ", "MZ", 0.2, SY * 2e-4 / 0.2),
        ("TIMO", BEAM, "UX", "FX", 0.01, SY * 0.02),
    ])  # fmt: skip
def test_a_line_carries_what_its_equivalent_stress_allows(
    tmp_path, element, section, what, dual, size, limit
):
    words = {"element": element, "section": section, "what": what, "dual": dual, "size": size}
    find = run(tmp_path, LINE, **words)
    assert abs(find("F")) == pytest.approx(limit, rel=1e-9)
    assert find("Q") == pytest.approx(SY, rel=1e-9)


@pytest.mark.parametrize("element", ["TUYA", "POUT", "TIMO"])
@pytest.mark.parametrize("law", ["ISOTROPE", "CINEMATIQUE"])
def test_pulled_and_pushed_it_is_the_bar_of_its_section(tmp_path, element, law):
    strength = {
        "ISOTROPE": "'ECRO' (EVOL 'MANU' 'EPS' (PROG 0. 0.002 0.05) 'SIG' (PROG 2.E8 2.4E8 4.E8))",
        "CINEMATIQUE": "'SIGY' 2.E8 'H' 2.E10",
    }[law]
    cycle = {"path": "1. 3. 4.", "at": "1. -0.6 0.3", "end": "4.", "size": 0.01}
    section = PIPE if element == "TUYA" else BEAM
    words = {"law": f"'{law}'", "strength": strength, "what": "UX", "dual": "FX", **cycle}
    found = run(tmp_path / "1", LINE, element=element, section=section, **words)("F")
    area = f"'SECT' {AREA if element == 'TUYA' else 0.02}"
    bar = LINE.replace(" 'VECT' (0. 1. 0.)", "").replace("'DEPL' 'ROTA' A", "'DEPL' L")
    bar = bar.replace("(BLOQ 'DEPL' L)", "(BLOQ 'UY' 'UZ' L) ET (BLOQ 'UX' A)")
    expected = run(tmp_path / "2", bar, element="BARR", section=area, **words)("F")
    assert found == pytest.approx(expected, rel=1e-9)


SHELL = """
OPTI DIME 2 'MODE' {mode} ELEM SEG2 ; L = DROI {cells} {ends} ;
A = POIN L 'INIT' ; B = POIN L 'FINA' ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' {law} COQ2 ;
MA = MATE MO 'YOUN' 2.E11 'NU' {nu} {strength} 'EPAI' 0.02 ;
B2 = BLOQ '{what}' {driven} ; BL = {held} ET B2 ;
"""
CANTILEVER = {"ends": "(0. 0.) (1. 0.)", "driven": "B", "held": "(BLOQ 'UX' 'UY' 'RZ' A)"}
RING = {"ends": "(1. 0.) (1. 0.5)", "driven": "L", "what": "UR", "dual": "FR"}


@together("words, limit", [
        # M = SIGY h^2/4, of a strip a metre wide; in plane strain N, M across make it 2/sqrt(3)
        ({"mode": "PLAN 'CONT'", **CANTILEVER, "what": "RZ", "dual": "MZ"}, SY * 0.02**2 / 4),
        ({"mode": "PLAN 'CONT'", **CANTILEVER, "what": "UX", "dual": "FX"}, SY * 0.02),
        (
            {"mode": "PLAN 'DEFO'", **CANTILEVER, "what": "UX", "dual": "FX", "cells": 1},
            2 / np.sqrt(3) * SY * 0.02,
        ),
        (
            {"mode": "PLAN 'DEFO'", **CANTILEVER, "what": "RZ", "dual": "MZ", "cells": 1},
            2 / np.sqrt(3) * SY * 0.02**2 / 4,
        ),
    ])  # fmt: skip
def test_a_strip_carries_the_plastic_moment(tmp_path, words, limit):
    find = run(tmp_path, SHELL, **{"cells": 8, "nu": 0.3, "size": 1.0, **words})
    assert abs(find("F")) == pytest.approx(limit, rel=1e-5)
    assert find("Q") == pytest.approx(SY, rel=1e-9)


@together("ends, force", [("free", 1.0), ("held", 2 / np.sqrt(3))])
def test_a_ring_carries_its_hoop_force(tmp_path, ends, force):
    held = "(BLOQ 'UZ' A)" if ends == "free" else "(BLOQ 'UZ' L)"
    words = {**RING, "mode": "AXIS", "cells": 8, "nu": 0.3, "size": 0.01}
    find = run(tmp_path, SHELL, held=f"{held} ET (BLOQ 'RT' L)", **words)
    names = find("SI").blocks[0].components
    assert names["N22"] == pytest.approx(np.full(names["N22"].shape, force * SY * 0.02), rel=1e-6)


PLATE = """
OPTI DIME 3 ELEM TRI3 ; L = DROI 3 (0. 0. 0.) (10. 0. 0.) ; S = L TRAN 1 (0. 1. 0.) ;
L1 = COTE S 4 ; B = COTE S 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' {law} {element} ;
MA = MATE MO 'YOUN' 2.E11 'NU' 0. {strength} 'EPAI' 0.5 {more_of} ;
B2 = BLOQ '{what}' B ; BL = (BLOQ 'UX' 'UZ' 'RY' L1) ET B2 ET (BLOQ 'UY' (POIN L1 1)) ;
"""


@together(
    "what, dual, size, more_of, limit",
    [
        ("RY", "MY", 0.1, "", SY * 0.5**2 / 4),
        ("RY", "MY", 0.1, "'CALF' 1.", SY * 0.5**2 / 6),
        ("UX", "FX", 0.02, "", SY * 0.5),
    ],
)
@together("element", ["DKT", "COQ3"])
def test_a_plate_yields_as_a_whole(tmp_path, element, what, dual, size, more_of, limit):
    words = {"element": element, "what": what, "dual": dual, "size": size, "more_of": more_of}
    find = run(tmp_path, PLATE, **words)
    # triangles of COQ3 in a pattern are not bent alike
    margin = 1e-3 if (element, what) == ("COQ3", "RY") else 1e-8
    assert abs(find("F")) == pytest.approx(limit, rel=margin)


@pytest.mark.parametrize("law", ["'PLASTIQUE' 'PARFAIT'", "'FLUAGE' 'NORTON'"])
@pytest.mark.parametrize("element", ["DKT", "COQ3"])
def test_below_yield_and_before_it_creeps_a_bent_plate_is_the_elastic_one(tmp_path, element, law):
    """Clamped, lifted at a corner: it bends otherwise at each point of a cell; and resumed."""
    find = ran(
        f"""
        OPTI DIME 3 ELEM TRI3 ; L = DROI 6 (0. 0. 0.) (10. 0. 0.) ; S = L TRAN 2 (0. 3. 0.) ;
        MO = MODE S 'MECANIQUE' 'ELASTIQUE' {law} {element} ;
        ME = MODE S 'MECANIQUE' 'ELASTIQUE' {element} ;
        AE = MATE ME 'YOUN' 2.E11 'NU' 0.3 'EPAI' 0.5 'ALPH' 1.E-5 ; T = TABL ;
        MA = MATE MO 'YOUN' 2.E11 'NU' 0.3 'EPAI' 0.5 'ALPH' 1.E-5
          'SIGY' 1.E12 'AF1' 1.E-60 'AF2' 3. 'AF3' 1. ;
        C1 = BLOQ 'DEPL' 'ROTA' (COTE S 4) ; C2 = BLOQ 'UZ' ((COTE S 2) POIN 'INIT') ;
        T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ; T . 'BLOCAGES_MECANIQUES' = C1 ET C2 ;
        TE = MANU 'CHPO' S 3 'TINF' 1. 'T' 3. 'TSUP' 8. ;
        EV = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;
        T . 'CHARGEMENT' = (CHAR 'DIMP' (DEPI C2 1.E-3) EV) ET (CHAR 'T' TE EV) ;
        T . 'TEMPS_CALCULES' = PROG 0. 0.5 1. ; PASAPAS T ; U = T . 'DEPLACEMENTS' . 2 ;
        H = THET ME AE TE ; K = (RIGI ME AE) ET C1 ET C2 ;
        V = RESO K ((DEPI C2 1.E-3) ET (BSIG ME AE H)) ;
        A = (MAXI 'ABS' (U - V) 'SANS' (MOTS 'LX')) / (MAXI 'ABS' V 'SANS' (MOTS 'LX')) ;
        T . 'CHARGEMENT' = (CHAR 'DIMP' (DEPI C2 1.E-3) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)))
          ET (CHAR 'T' TE (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.))) ;
        T . 'TEMPS_CALCULES' = PROG 2. ; PASAPAS T ; U = T . 'DEPLACEMENTS' . 3 ;
        B = (MAXI 'ABS' (U - V) 'SANS' (MOTS 'LX')) / (MAXI 'ABS' V 'SANS' (MOTS 'LX')) ;
        """.replace("'SIGY' 1.E12" if "FLUAGE" in law else "'AF1' 1.E-60 'AF2' 3. 'AF3' 1.", ""),
        output_directory=tmp_path,
    ).session.root.find
    assert find("A") < 1e-9
    assert find("B") < 1e-9


def test_a_calculation_goes_on_from_its_fields(tmp_path):
    again = "T . 'TEMPS_SAUVES' = PROG 0. 0.5 1. ;"
    words = {"element": "TUYA", "section": PIPE, "what": "UY", "dual": "FY", "size": 0.1}
    words |= {"law": "'CINEMATIQUE'", "strength": "'SIGY' 2.E8 'H' 2.E10", "more": again}
    resumed = (
        "T2 = COPI T ; T2 . 'REPRISE' = 0.5 ; PASAPAS T2 ; "
        "G = MAXI 'ABS' ((T2 . 'CONTRAINTES' . ((DIME (T2 . 'TEMPS')) - 1)) - SI) ; "
        "H0 = MAXI 'ABS' SI ; KK = INDE (T . 'CONTRAINTES') ;"
    )
    text = f"{LINE}{PUSH}".format(path="1.", at="1.", end="1.", **words) + resumed
    find = finder(text, tmp_path)
    assert find("G") < 1e-9 * find("H0")


def _points(seed, m=40):
    """Sections of random rigidities and forms, some without rigidity in shear."""
    rng = np.random.default_rng(seed)
    A, B = rng.normal(size=(2, m, 6, 6))
    D, P = A @ A.transpose(0, 2, 1) + np.eye(6), B @ B.transpose(0, 2, 1) + 0.5 * np.eye(6)
    for matrix in (D, P):
        matrix[: m // 2, 1:3] = matrix[: m // 2, :, 1:3] = 0.0
    curve = Curve((CurvePart(np.array([0.0, 0.3, 2.0]), np.array([1.0, 1.4, 2.0])),))
    return rng, D, P, curve


@together("law", ["PARFAIT", "ISOTROPE", "CINEMATIQUE"])
def test_the_answer_is_on_the_criterion_and_its_tangent_is_its_slope(law):
    rng, D, P, curve = _points(5)
    m, one = len(D), np.ones(len(D))
    values = {"YOUN": one, "SIGY": one} | ({"H": 0.4 * one} if law == "CINEMATIQUE" else {})
    curves = {"ECRO": ([curve], np.zeros(m, dtype=int))} if law == "ISOTROPE" else {}
    given = SectionParameters(values, curves, D, np.linalg.pinv(D, hermitian=True), P, 0.7 * one)
    strain, width = rng.normal(size=(m, 6)), 7 if law == "CINEMATIQUE" else 1
    zero = np.zeros((m, 6))
    found = respond(given, zero, strain, np.zeros((m, width)))
    centre = found.variables[:, 1:] if width > 1 else 0.0
    reduced = found.stress - centre
    q = np.sqrt(np.einsum("mi,mij,mj->m", reduced, P, reduced))
    p = found.variables[:, 0]
    assert (p > 0).sum() > m / 2
    strength = np.interp(p, [0, 0.3, 2.0], [1, 1.4, 2.0]) if law == "ISOTROPE" else one
    assert q[p > 0] == pytest.approx(strength[p > 0], rel=1e-10)
    # the power of the flow is that of the equivalent stress: (F - X) . strain of flow = q size p
    flow = np.einsum("mij,mj->mi", given.compliance @ D, strain) - np.einsum(
        "mij,mj->mi", given.compliance, found.stress
    )
    assert np.vecdot(reduced, flow) == pytest.approx(q * 0.7 * p, rel=1e-8, abs=1e-10)
    for k in range(6):
        step = np.zeros(6)
        step[k] = 1e-6
        up, down = (respond(given, zero, strain + s, np.zeros((m, width))) for s in (step, -step))
        slope = (up.stress - down.stress) / 2e-6
        assert found.tangent[:, :, k] == pytest.approx(slope, rel=1e-5, abs=1e-5)


@together(
    "element, section, said",
    [
        ("POUT", "'SECT' 0.02 'INRY' 1.E-4 'INRZ' 2.E-4 'TORS' 3.E-4", "moments-without-distances"),
        ("POUT", f"{BEAM} 'SECY' 0.01", "sheared-beam-is-elastic"),
    ],
)
def test_what_the_criterion_cannot_do_without_is_asked_for(tmp_path, element, section, said):
    words = {"element": element, "section": section, "what": "UX", "dual": "FX", "size": 1e-3}
    text = f"{LINE}{PUSH}".format(path="1.", at="1.", end="1.", more="", **PERFECT, **words)
    result = run_text(text, output_directory=tmp_path)
    assert [e.code.rpartition(".")[2] for e in result.errors] == [said]


@together("age", [0.4, 1.2])
def test_creep_goes_by_nortons_law_and_its_tangent_is_its_slope(age):
    """From an earlier strain of some points: p = (p0^(1/m) + (A q^n)^(1/m) t)^m."""
    rng, D, P, _ = _points(5)
    m, one = len(D), np.ones(len(D))
    law = {"YOUN": one, "AF1": 0.3 * one, "AF2": 3.0 * one, "AF3": age * one, "DT": 0.7 * one}
    given = CreepingSections(law, {}, D, np.linalg.pinv(D, hermitian=True), P, 0.7 * one)
    strain, zero = rng.normal(size=(m, 6)), np.zeros((m, 6))
    before = np.where(np.arange(m) % 2, 0.2, 0.0)[:, None]
    found = respond(given, zero, strain, before)
    q = np.sqrt(np.einsum("mi,mij,mj->m", found.stress, P, found.stress))
    expected = (before[:, 0] ** (1 / age) + (0.3 * q**3) ** (1 / age) * 0.7) ** age
    assert found.variables[:, 0] == pytest.approx(expected, rel=1e-9)
    released = np.einsum("mij,mj->mi", D, strain) - found.stress
    flow = np.einsum("mij,mj->mi", given.compliance, released)
    dp = found.variables[:, 0] - before[:, 0]
    assert np.vecdot(found.stress, flow) == pytest.approx(q * 0.7 * dp, rel=1e-8, abs=1e-10)
    for k in range(6):
        step = np.zeros(6)
        step[k] = 1e-6
        up, down = (respond(given, zero, strain + s, before) for s in (step, -step))
        slope = (up.stress - down.stress) / 2e-6
        assert found.tangent[:, :, k] == pytest.approx(slope, rel=1e-5, abs=1e-5)


def test_sections_without_time_or_with_weak_stress_do_not_creep():
    _, D, P, _ = _points(2)
    one = np.ones(len(D))
    for duration, size in ((0.0, 1.0), (1.0, 1e-30), (1.0, 0.0)):
        law = {"YOUN": one, "AF1": 0.3 * one, "AF2": 4.0 * one, "AF3": one, "DT": duration * one}
        given = CreepingSections(law, {}, D, np.linalg.pinv(D, hermitian=True), P, one)
        strain = size * np.ones((len(D), 6))
        found = respond(given, 0 * strain, strain, np.full((len(D), 1), 0.1))
        elastic = np.einsum("mij,mj->mi", D, strain)
        np.testing.assert_allclose(found.stress, elastic, rtol=1e-12)
        np.testing.assert_allclose(found.variables, 0.1, rtol=1e-12)
        assert np.isfinite(found.tangent).all()

"""What operators make of a model of several zones is what they make of each zone alone.

A plate of quadrangles, one of triangles of another matter that yields, and bars between them, in
any order; fields and matrices of the whole are those of the parts, forces and numbers add up.
"""

import itertools

import numpy as np
import pytest
from script_runs import session_after
from together import together

from ssilang.cli.run import execute
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.text.source import Source

PRELUDE = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
P9 = 3. 1.5 ; P1 = 1. 0.5 ; P5 = 2. 0.5 ; P2 = 2. 1. ; P7 = 1. 1.25 ; P3 = 4. 0.75 ; P4 = 1. -1. ;
S1 = (MANU 'QUA4' P1 P5 P2 P7) ET (MANU 'QUA4' P4 (2. -1.) P5 P1) ;
S2 = (MANU 'TRI3' P5 P3 P2) ET (MANU 'TRI3' P3 P9 P2) ;
S3 = (MANU 'SEG2' P3 P4) ET (MANU 'SEG2' P7 P9) ; ST = S1 ET S2 ET S3 ;
M1 = MODE S1 'MECANIQUE' 'ELASTIQUE' ;
A1 = MATE M1 'YOUN' 3. 'NU' 0.2 'RHO' 2. 'ALPH' 0.1 'VISQ' 5. ;
M2 = MODE S2 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ;
A2 = MATE M2 'YOUN' 7. 'NU' 0.3 'RHO' 5. 'SIGY' 0.5 'ALPH' 0.2 'VISQ' 4. ;
M3 = MODE S3 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
A3 = MATE M3 'YOUN' 11. 'NU' 0. 'SECT' 0.5 'RHO' 13. 'ALPH' 0.3 'VISQ' 6. ;
X = COOR 1 ST ; Y = COOR 2 ST ;
U = (NOMC 'UX' (0.3 * X * Y)) ET (NOMC 'UY' ((0.2 * X) - (0.1 * Y * Y))) ;
G = (NOMC 'FX' (X - Y)) ET (NOMC 'FY' (Y * Y)) ; T = NOMC 'T' (X + (2. * Y)) ;
"""
# by what they need: all zones, or those that have it; {M} the model, {A} its material
OF_CELLS = [
    "SIGM {M} {A} U", "EPSI {M} U", "ELAS {M} (EPSI {M} U) {A}", "GRAD {M} U",
    "ZERO {M} 'CONTRAIN'",
    "ZERO {M} 'VARINTER'", "EPTH {M} {A} T", "THET {M} {A} T",
    "COOR 1 {M}", "CHAN 'CHAM' X {M}", "CHAN 'STRESSES' {M} {A}",
    "ENER {M} (SIGM {M} {A} U) (EPSI {M} U)",
    "WORK {M} (SIGM {M} {A} U) (GRAD {M} U)", "EXCO 'YOUN' {A}", "{A} * 2.",
    "VARI {M} T (EVOL 'MANU' 'T' (PROG -9. 9.) 'Q' (PROG 1. 4.))",
    "REDU (SIGM (M3 ET M1 ET M2) (A2 ET A3 ET A1) U) {M}",
    "MANU 'CHML' {M} 'SCAL' 3.", "CHAN 'GRAVITE' {M} (EPSI {M} U)",
    "(SIGM {M} {A} U) + (SIGM {M} {A} (2. * U))", "PROI {M} (CHAN 'CHAM' X (M2 ET M1))",
]  # fmt: skip
OF_BODIES = [
    "JACO {M}", "VMIS {M} (SIGM {M} {A} U)",
    "PRIN (SIGM {M} {A} U) {M}", "TRES {M} (SIGM {M} {A} U)", "(HOOK {M} {A}) * (EPSI {M} U) {M}",
    "SIGM 'QUAD' {M} {A} U", "EPSI 'QUAD' {M} U", "RTEN (SIGM {M} {A} U) {M} (2. 1.)",
]  # fmt: skip
OF_NODES = ["BSIG {M} (SIGM {M} {A} U)", "BSIG {M} (THET {M} {A} T)"]
MATRICES = [
    "RIGI {M} {A}",
    "MASS {M} {A}",
    "LUMP {M} {A}",
    "KSIG {M} (SIGM {M} {A} U)",
    "AMOR {M} {A}",
]
NUMBERS = ["INTG {M} (ENER {M} (SIGM {M} {A} U) (EPSI {M} U))", "NBEL (EXTR {M} 'MAIL')",
           "XTX (EPSI {M} U)", "INTG {M} (COOR 1 {M})"]  # fmt: skip


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_after(PRELUDE, tmp_path_factory.mktemp("zones"))


def asked(session, phrase, zones, materials=None):
    """What a phrase makes of zones; of one alone the parentheses hold a name."""
    models = " ET ".join(f"M{z}" for z in zones)
    given = " ET ".join(f"A{z}" for z in materials or zones)
    execute(session, Source("s", f"R = {phrase.format(M=f'({models})', A=f'({given})')} ;"))
    return session.root.find("R")


def by_cell(field):
    """Components by the corners of a cell."""
    assert isinstance(field, CellField)
    found = {}
    for block in field.blocks:
        for k, corners in enumerate(block.cells.coordinates):
            parts = {n: np.asarray(v)[min(k, len(v) - 1)] for n, v in block.components.items()}
            found[corners.tobytes(), block.support] = parts
    return found


def by_node(field, scale=1.0):
    assert isinstance(field, NodeField)
    return {
        (int(n), name): scale * v
        for name, part in field.components.items()
        for n, v in zip(part.nodes, part.values, strict=True)
    }


def assert_near(found, wanted):
    assert set(found) == set(wanted)
    for key, value in wanted.items():
        assert found[key] == pytest.approx(value, rel=1e-12, abs=1e-13), key


@together("phrase", OF_CELLS + OF_BODIES)
def test_fields_in_cells_are_those_of_each_zone(session, phrase):
    zones = (1, 2) if phrase in OF_BODIES else (1, 2, 3)
    alone = {}
    for zone in zones:
        alone |= by_cell(asked(session, phrase, [zone]))
    for order in itertools.permutations(zones):
        found = by_cell(asked(session, phrase, order, order[::-1]))
        assert set(found) == set(alone)
        for key, parts in found.items():
            assert set(parts) == set(alone[key])
            for name, values in parts.items():
                np.testing.assert_allclose(values, alone[key][name], rtol=1e-12, atol=1e-13)


@together("phrase", [*OF_NODES, "CNEQ {M} G", *(f"({m}) * U" for m in MATRICES)])
def test_forces_add_up_over_zones(session, phrase):
    total = {}
    zones = (1, 2) if phrase.startswith("CNEQ") else (1, 2, 3)
    for zone in zones:
        for key, value in by_node(asked(session, phrase, [zone])).items():
            total[key] = total.get(key, 0.0) + value
    for order in itertools.permutations(zones):
        assert_near(by_node(asked(session, phrase, order, order[::-1])), total)


@pytest.mark.parametrize("phrase", NUMBERS)
def test_numbers_add_up_over_zones(session, phrase):
    total = sum(asked(session, phrase, [zone]) for zone in (1, 2, 3))
    for order in itertools.permutations((1, 2, 3)):
        assert asked(session, phrase, order, order[::-1]) == pytest.approx(total, rel=1e-13)

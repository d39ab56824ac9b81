"""Where values of points stand: in fields, in time at a place, and back; whose matrices leave."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from references.assembled import Bench
from refusing import refusal

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface import interface as shown
from ssilang.kernel.interface.laws.columns import N_STATE, Variable
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.mesh import CellBlock

SPRINGS, BASE = {"KN": 2e7, "KS": 1e7}, {"KN": 8e7, "KS": 4e7, "LARG": 4.0, "LONG": 6.0}
LINE, POINTS = (("DRSN", "DRN"), ("SMSN", "SMN")), (("GXY", "EXX"), ("EFFY", "EFFX"))
FACE = (("DRS1", "DRS2", "DRN"), ("SMS1", "SMS2", "SMN"))
POINTS_3 = (("GXY", "GXZ", "EXX"), ("EFFY", "EFFZ", "EFFX"))
BASE_2, BASE_3 = (("CXZ", "EXX"), ("MOMZ", "EFFX")), (
    ("CXY", "CXZ", "EXX"), ("MOMY", "MOMZ", "EFFX"))  # fmt: skip
# cell, element, law, its values, cells, points of a cell, names of jump and traction
ZONES = {
    Mode.PLANE_STRAIN: [
        ("RAC2", "JOI2", "JOINT_SDM", SPRINGS, 2, 2, LINE),
        ("SEG2", "JOI1", "MACRO_SEMELLE", BASE | {"COHE": 5e4}, 1, 1, BASE_2),
        ("RAC2", "JNO2", "COULOMB", SPRINGS | {"FRIC": 30.0, "COHE": 1e4}, 3, 2, LINE),
        ("SEG2", "JOI1", "JOINT_SDM", SPRINGS, 2, 1, POINTS),
        ("SEG2", "JOI1", "MACRO_SEMELLE", BASE, 2, 1, BASE_2),
    ],
    Mode.THREE_DIMENSIONAL: [
        ("SEG2", "JOI1", "MACRO_SEMELLE", BASE | {"COHE": 5e4}, 2, 1, BASE_3),
        ("LIA3", "JOT3", "JOINT_SDM", SPRINGS, 1, 3, FACE),
        ("SEG2", "JOI1", "JOINT_SDM", SPRINGS, 2, 1, POINTS_3),
        ("LIA4", "JNO4", "JOINT_SDM", SPRINGS, 2, 4, FACE),
    ],
}
CORNERS = {"SEG2": [[0, 0]], "RAC2": [[0, 0], [1, 0]], "LIA3": [[0, 0], [1, 0], [0, 1]],
           "LIA4": [[0, 0], [1, 0], [1, 1], [0, 1]]}  # fmt: skip


def standing(mode):
    """Joints of many kinds beside one another, and their rows, macro-elements last."""
    bench, d = Bench(mode), mode.dimension
    for row, (cell, element, law, given, n, _, _) in enumerate(ZONES[mode]):
        cells = []
        for k in range(n):
            x = np.array(CORNERS[cell], float)[:, : d - 1] + [3.0 * k, 9.0 * row][: d - 1]
            x[:, 0] += 100.0 * row
            sides = [[bench.node(*p, z) for p in x] for z in (0.0, -1.0 if cell == "SEG2" else 0.0)]
            cells.append(sides[0] + sides[1] if cell != "SEG2" else [sides[1][0], sides[0][0]])
        bench.joint(cell, cells, element, law, **given)
        for node in np.ravel(cells):
            for name in ("UX", "UY", "RZ") if d == 2 else ("UX", "UY", "UZ", "RX", "RY", "RZ"):
                bench.spring(1.0, node, unknown=name)
    order = sorted(range(len(ZONES[mode])), key=lambda i: "MACRO" in ZONES[mode][i][2])
    return bench, [ZONES[mode][i] for i in order]


@pytest.mark.parametrize("mode", ZONES)
def test_values_of_points_stand_where_they_are_asked_for(mode):
    bench, rows = standing(mode)
    joints = bench.problem(np.array([0.0, 1.0])).interface
    d, rng = mode.dimension, np.random.default_rng(3)
    w, t = rng.uniform(-1e-3, 1e-3, (2, 3, joints.n_points, d)) * [[[[1.0]]], [[[1e7]]]]
    state = np.zeros((3, joints.n_points, N_STATE))
    state[..., Variable.XI] = rng.uniform(0.0, 1e-3, state.shape[:2])
    state[..., Variable.SLIP1] = rng.uniform(0.0, 1e-3, state.shape[:2])
    history, carried = SimpleNamespace(w=w, t=t, state=state), t.copy()
    for bed in joints.beds:  # what yielding takes comes on top
        carried[:, bed.owner] += bed.taken(t[:, bed.points])
    later = {"jump": shown.interface_field(joints, w[2], "jump"),
             "traction": shown.interface_field(joints, t[2], "traction"),
             "variables": shown.state_field(joints, state[2], w[2], t[2])}  # fmt: skip

    def asked(kind, name, place):
        return shown.point_history(joints, history, kind, name, place)

    first = 0
    for zone, (_, element, law, given, n, g, names) in enumerate(rows):
        turned = element == "JOI1"  # the normal first
        for cell in range(n):
            for point in range(g):
                at, place = first + cell * g + point, (zone, cell, point)
                for kind, values, own in (("jump", w, names[0]), ("traction", carried, names[1])):
                    block = later[kind].blocks[zone]
                    assert tuple(block.components) == ((own[-1:] + own[:-1]) if turned else own)
                    for i, name in enumerate(own):
                        assert asked(kind, name, place).tolist() == values[:, at, i].tolist()
                        assert block.components[name][cell, point] == values[2, at, i]
                    assert asked(kind, "UX", place) is None
                block = later["variables"].blocks[zone].components
                assert {"ETAT", "ESTO", "EPER"} <= set(block)
                assert ("PART" in block) == ("COHE" in given and "MACRO" in law)
                for name, values in block.items():
                    if name.startswith("GLP") or name == "TASP":
                        continue  # of the places of a bed, many
                    assert asked("variables", name, place)[2] == pytest.approx(
                        values[cell, point], rel=1e-12
                    )
                assert asked("variables", "NONE", place) is None
                if law == "JOINT_SDM":
                    assert asked("variables", "SAUT", place).tolist() == state[:, at, 0].tolist()
                    assert asked("variables", "GLI1", place).tolist() == state[:, at, 1].tolist()
        first += n * g
        for wrong in ((zone, -1, 0), (zone, n, 0), (zone, 0, -1), (zone, 0, g)):
            assert asked("jump", names[0][0], wrong) is None
    for zone in (-1, len(rows)):
        assert asked("jump", rows[zone % len(rows)][-1][0][0], (zone, 0, 0)) is None
    assert first == joints.n_shown
    for kind, values in (("jump", w), ("traction", carried)):
        back = shown.point_values(joints, later[kind], kind)
        assert back[:first].tolist() == values[2, :first].tolist()
        assert back.shape == (joints.n_points, d)
        assert not back[first:].any()
        with refusal(FieldError, "kernel.interface.field-lacks-component"):
            shown.point_values(joints, CellField(later[kind].blocks[1:]), kind)
    plastic = shown.interface_field(joints, w[2], "plastic jump").blocks
    sliding = [(at, z) for at, z in enumerate(rows) if z[2] in ("JOINT_SDM", "COULOMB")]
    assert len(plastic) == len(sliding)
    for block, (at, (*_, names)) in zip(plastic, sliding, strict=True):
        for name in names[0]:  # EXX gives FEXX, DRN FRN
            values = block.components["F" + name.removeprefix("D")]
            assert (values == later["jump"].blocks[at].components[name]).all()


def test_matrices_of_joints_leave_with_their_zones():
    """Those of the same element on the same cells, whatever object holds these.

    Beside one of the law itself, linear ones are springs of their own.
    """
    bench, _ = standing(Mode.PLANE_STRAIN)
    zone, _, other, *_ = bench.zones
    copied = replace(zone, cells=CellBlock.make(bench.table, "RAC2", zone.cells.raw))
    turned = replace(zone, cells=CellBlock.make(bench.table, "RAC2", zone.cells.raw[::-1]))
    nodal, linear = replace(zone, element="JNO2"), replace(zone, behaviour=("ELASTIQUE",))
    of = {"nobody": None, "zone": zone, "copied": copied, "turned": turned, "nodal": nodal,
          "linear": linear, "other": other}  # fmt: skip
    blocks = {
        name: ElementMatrices(
            bench.table, np.array([[0, 1]]), np.arange(2), ("UX",) * 2, ("FX",) * 2,
            np.eye(2)[None], "RIGIDITE", owner,
        )
        for name, owner in of.items()
    }  # fmt: skip
    matrix = Matrix(bench.table, tuple(blocks.values()), (), "MASSE")
    left = shown.without_zones(matrix, (zone,))
    assert [*left.blocks] == [blocks[n] for n in ("nobody", "turned", "nodal", "linear", "other")]
    assert left.kind == "MASSE"
    alone = shown.without_zones(left, (zone,))
    assert [*alone.blocks] == [blocks[n] for n in ("nobody", "turned", "nodal", "other")]
    assert shown.without_zones(alone, (zone,)) is alone
    both = shown.without_zones(matrix, (of["linear"], zone))
    assert [*both.blocks] == [*alone.blocks]
    twice = replace(blocks["linear"], zone=replace(zone, behaviour=("ELASTIQUE",)))
    springs = Matrix(bench.table, (twice, blocks["linear"], twice))
    assert shown.without_zones(springs, (of["linear"],)).blocks == (twice, twice)
    assert shown.without_zones(springs, (zone,)).blocks == ()
    lawful = [n for n in of if n not in ("nobody", "linear")]
    assert [*shown.nonlinear_blocks(matrix)] == [blocks[n] for n in lawful]

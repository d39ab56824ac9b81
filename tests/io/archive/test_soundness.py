"""What an archive holds is taken as it is where it agrees, and refused by its field where not."""

import numpy as np
from together import together

from ssilang.io.archive.decoding import _AGREEMENTS, flaw_of
from ssilang.kernel.curves.curve import CurvePart
from ssilang.kernel.fields.cell_field import CellFieldBlock
from ssilang.kernel.fields.deformed import ArrowPart
from ssilang.kernel.fields.node_field import NodeValues
from ssilang.kernel.matrices.matrix import ElementMatrices, Relations
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable

TABLE = NodeTable()
TABLE.add(np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]]))
CELLS = CellBlock.make(TABLE, "TRI3", np.array([[3, 0, 1], [1, 2, 3]]))
TWO, THREE = np.array([0, 1]), np.array([2.0, -1.0, 0.5])
SOUND = {
    NodeValues: {"nodes": np.array([0, 2, 3]), "values": THREE},
    CellBlock: {"nodes": TABLE, "cell_type": "TRI3", "raw": np.array([[3, 0, 1], [1, 2, 3]]),
                "colours": np.array([0, 3])},
    CellFieldBlock: {"cells": CELLS, "components": {"V": np.ones((2, 1)), "A": np.ones((2, 3))},
                     "element": "TRI3"},
    CurvePart: {"abscissas": np.array([3.0, 1.0, 2.0]), "ordinates": THREE, "colour": 0},
    ElementMatrices: {"raw_nodes": np.array([[3, 0], [1, 2], [2, 0]]), "local": np.array([1, 0, 1]),
                      "unknowns": ("UY", "UX", "UX"), "duals": ("FY", "FX", "FX"),
                      "values": np.ones((3, 3, 3))},
    Relations: {"row_start": np.array([0, 2, 3]), "raw_nodes": np.array([3, 0, 1]),
                "unknowns": ("UY", "UX", "UX"), "coefficients": THREE,
                "raw_multipliers": TWO, "sense": np.zeros(2, np.int8)},
    ArrowPart: {"origins": np.ones((2, 3)), "vectors": np.zeros((2, 3)), "nodes": TWO},
}  # fmt: skip
# a class, the field that is damaged, what stands there, the field that is named
DAMAGED = [
    (NodeValues, "nodes", np.array([2, 0, 3])), (NodeValues, "nodes", np.array([0, 2, 2])),
    (NodeValues, "nodes", np.array([[0, 2, 3]])), (NodeValues, "values", np.ones(2)),
    (CellBlock, "cell_type", "TRI9"), (CellBlock, "cell_type", "SUPE3333333333"),
    (CellBlock, "cell_type", "TRI333"), (CellBlock, "raw", np.array([[0, 1], [1, 2]])),
    (CellBlock, "colours", np.zeros(1, int)), (CellBlock, "colours", np.array([0, -1])),
    (CellBlock, "colours", np.array([0, 10**6])),
    (CellFieldBlock, "components", {"V": np.ones((2, 1)), "A": np.ones((3, 1))}),
    (CellFieldBlock, "components", {"V": np.ones((2, 1)), "A": np.ones(2)}),
    (CellFieldBlock, "element", "TRI9"),
    (CurvePart, "ordinates", np.ones(2)), (CurvePart, "colour", -1), (CurvePart, "colour", 10**6),
    (CurvePart, "words", ("A", "B")),
    (ElementMatrices, "raw_nodes", np.array([1, 2, 3])),
    (ElementMatrices, "local", np.array([1, 0])), (ElementMatrices, "local", np.array([1, 0, 2])),
    (ElementMatrices, "local", np.array([1, 0, -1])), (ElementMatrices, "duals", ("FY", "FX")),
    (ElementMatrices, "values", np.ones((3, 2, 3))),
    (ElementMatrices, "values", np.ones((2, 3, 3))),
    (Relations, "row_start", np.array([0, 3, 2])), (Relations, "row_start", np.array([1, 2, 3])),
    (Relations, "row_start", np.array([0, 2, 2])), (Relations, "row_start", np.array([0, 3])),
    (Relations, "raw_nodes", np.array([3, 0])), (Relations, "coefficients", np.ones(2)),
    (Relations, "sense", np.zeros(3, np.int8)),
    (ArrowPart, "origins", np.ones((2, 1))), (ArrowPart, "vectors", np.zeros((3, 3))),
    (ArrowPart, "vectors", np.zeros((1, 2, 3))), (ArrowPart, "nodes", np.array([0])),
]  # fmt: skip


@together("name", ["SUPE41", "MULT42", "SURE43"])
def test_a_cell_of_many_nodes_is_taken_that_this_process_has_not_made(name: str) -> None:
    assert name not in CELL_TYPES
    raw = np.arange(int(name[4:]))[None, :]
    cells = {"nodes": TABLE, "cell_type": name, "raw": raw, "colours": np.zeros(1, int)}
    assert flaw_of(CellBlock, cells) == ""
    assert flaw_of(CellBlock, {**cells, "raw": raw[:, 1:]}) == "raw"


@together("cls", SOUND)
def test_what_agrees_is_taken(cls: type) -> None:
    assert flaw_of(cls, SOUND[cls]) == ""


@together("cls, name, value", DAMAGED)
def test_what_does_not_agree_is_named(cls: type, name: str, value: object) -> None:
    assert flaw_of(cls, SOUND[cls] | {name: value}) == name


def test_every_rule_is_tried() -> None:
    elsewhere = {"Zone", "LoadPart"}  # their parts are objects
    assert {cls.__name__ for cls in SOUND} | elsewhere == set(_AGREEMENTS)

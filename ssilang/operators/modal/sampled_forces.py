"""Nonlinear forces of harmonic balance by the procedure CHARMECA of the script."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.matrix import dual_of
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.values import ListChpo, ListReel, Mot, Table
from ssilang.operators.modal.harmonic_tables import numbered
from ssilang.operators.session.user_procedures import call_user
from ssilang.operators.tables.entries import Entries


def nonlinear_unknowns(entries: Entries) -> tuple[Point, list[str]] | None:
    """POINT_FNL and COMP_FNL where PROCEDURE_CHARMECA and AFT are asked for."""
    if not entries.flag("PROCEDURE_CHARMECA"):
        return None
    if entries.get("PROCEDURE_FREQUENCE_TEMPS") != "AFT":
        raise entries.error("operators.modal.nonlinear-forces-computed-time")
    names = entries.needed("COMP_FNL").values
    return entries.needed("POINT_FNL"), [n.rstrip() for n in names]


class Sampled:
    """Forces and stiffnesses by the procedure CHARMECA of the script (Cast3M's AFT).

    TAB1 . 'DEP_NL' holds the motion at equal instants of a period, a LISTCHPO ('CALC_CHPO' =
    VRAI) or one LISTREEL an unknown; the procedure sets 'FNL_T' alike and 'KNL_T' . i . j, the
    LISTREEL of - dF_i/dx_j.
    """

    def __init__(self, entries: Entries, point: Point, names: list[str]) -> None:
        self.entries, self.point, self.names = entries, point, names
        self.fields = entries.flag("CALC_CHPO")

    def __call__(self, motion: FloatArray) -> tuple[FloatArray, FloatArray]:
        """f (N, m) and -df/dx (N, m, m)."""
        table, count = self.entries.table, motion.shape
        table.set(Mot("DEP_NL"), self._given(motion))
        call_user(self.entries.call, "CHARMECA", table)
        force = self._forces(self.entries.needed("FNL_T"), count)
        stiffness = self.entries.needed("KNL_T")
        k = np.zeros((*count, count[1]))
        for i in range(count[1]):
            for j in range(count[1]):
                row = stiffness.get(i + 1)
                value = row.get(j + 1) if isinstance(row, Table) else None
                k[:, i, j] = self._list(value, count[0], f"KNL_T . {i + 1} . {j + 1}")
        return force, k

    def _given(self, motion: FloatArray) -> ListChpo | Table:
        if not self.fields:
            return numbered([ListReel(column.copy()) for column in motion.T])
        node = np.array([self.point.node])
        return ListChpo(
            [
                NodeField(
                    self.point.nodes,
                    {n: NodeValues(node, row[i : i + 1]) for i, n in enumerate(self.names)},
                    "DIFFUS",
                )
                for row in motion.copy()
            ]
        )

    def _forces(self, given: ListChpo | Table, count: tuple[int, ...]) -> FloatArray:
        if isinstance(given, Table):
            columns = [
                self._list(given.get(i + 1), count[0], f"FNL_T . {i + 1}") for i in range(count[1])
            ]
            return np.stack(columns, axis=1)
        if len(given) != count[0] or not all(isinstance(f, NodeField) for f in given.values):
            raise self.entries.error("operators.modal.charmeca-gives-fields", count=count[0])
        node, out = np.array([self.point.node]), np.zeros(count)
        for t, field in enumerate(given.values):
            assert isinstance(field, NodeField)
            for i, name in enumerate(self.names):
                out[t, i] = sum(float(field.values_at(n, node)[0]) for n in _either(field, name))
        return out

    def _list(self, value: object, count: int, place: str) -> FloatArray:
        if not isinstance(value, ListReel) or len(value.values) != count:
            raise self.entries.error(
                "operators.modal.charmeca-gives-reals", count=count, place=place
            )
        return np.asarray(value.values, dtype=float)


def _either(field: NodeField, name: str) -> list[str]:
    """The component as the script named it: by the unknown or by its force."""
    return [n for n in dict.fromkeys((name, dual_of(name))) if n in field.components]

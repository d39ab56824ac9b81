"""IPOL of clouds: functions of several variables given by points or on a grid."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.curves.cloud import Cloud, inverse_distance, moving_plane, on_grid
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.prelude import *


def interpolate_cloud(
    cloud: Cloud, field: NodeField | CellField, method: str, settings: dict[str, float]
) -> NodeField | CellField:
    """Evaluate the cloud at the values of a field; settings 'PID' and 'ELIM' of the method."""
    if isinstance(field, NodeField):
        return _at_nodes(cloud, field, method, settings)
    blocks = []
    for block in field.blocks:
        width = max((v.shape[1] for v in block.components.values()), default=1)
        shape = (len(block.cells), width)
        given = {
            k: np.broadcast_to(v, shape).ravel().astype(float) for k, v in block.components.items()
        }
        made = _evaluated(cloud, given, method, settings)
        blocks.append(cell_algebra.rebuilt(block, {k: v.reshape(shape) for k, v in made.items()}))
    return CellField(tuple(blocks), field.title)


def _at_nodes(cloud: Cloud, field: NodeField, method: str, settings: dict[str, float]) -> NodeField:
    nodes = field.node_ids
    given = {k: v.at(nodes) for k, v in field.components.items()}
    made = _evaluated(cloud, given, method, settings)
    return node_algebra.rebuilt(field, {k: NodeValues(nodes, v) for k, v in made.items()})


def _evaluated(
    cloud: Cloud, given: dict[str, FloatArray], method: str, settings: dict[str, float]
) -> dict[str, FloatArray]:
    names = [n for n in cloud.columns if n in given]
    wanted = [n for n in cloud.columns if n not in given]
    if not names or not wanted:
        raise FieldError(
            "operators.fields.cloud-shares-some-components", given=given, columns=cloud.columns
        )
    at = np.stack([given[n] for n in names], axis=1)
    if method == "GRIL":
        return {wanted[-1]: _grid(cloud, names, wanted[-1], at)}
    points = np.stack([cloud.numbers(n) for n in names], axis=1)
    values = np.stack([cloud.numbers(n) for n in wanted], axis=1)
    if method == "PID":
        found = inverse_distance(points, values, at, settings["PID"], settings["ELIM"])
    else:
        found = moving_plane(points, values, at, method == "GAUS")
    return {n: found[:, i] for i, n in enumerate(wanted)}


def _grid(cloud: Cloud, names: list[str], target: str, at: FloatArray) -> FloatArray:
    lists = {n: cloud.columns[n][0] for n in (*names, target)}
    for name, held in lists.items():
        if not isinstance(held, ListReel):
            raise FieldError("operators.fields.grid-component-is-one-list", name=name)
    arrays: dict[str, Any] = {n: getattr(held, "values", None) for n, held in lists.items()}
    return on_grid([arrays[n] for n in names], arrays[target], at)

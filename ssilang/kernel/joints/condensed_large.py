"""The interface iteration of `condensed` for many unknowns: linear algebra by LAPACK."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.joints.condensed import (
    ACCEPTED,
    HOLDING_TURN,
    MOST_TURNS,
    PLAIN_TURNS,
    TOLERANCE,
    hold_shear,
    release_shear,
    solve_interface,
)
from ssilang.kernel.joints.interface import Interface
from ssilang.kernel.joints.response import interface_response, interface_stiffness
from ssilang.kernel.mesh.nodes import FloatArray, IntArray

LARGE = 64
"""Unknowns from which LAPACK beats plain compiled loops."""


def solve_any_interface(
    joints: Interface,
    S: FloatArray,
    R: FloatArray,
    c: float,
    delta0: FloatArray,
    f0: FloatArray,
    state: FloatArray,
    y0: FloatArray,
    y: FloatArray,
    w: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    f: FloatArray,
    h: FloatArray,
) -> tuple[int, float]:
    """`solve_interface` with the method that suits the size; same arguments and results."""
    solve = solve_interface if joints.size <= LARGE else solve_large_interface
    return solve(
        joints.pairs, joints.B, joints.weights, joints.codes, joints.parameters, S, R, c, delta0,
        f0, state, y0, y, w, t, new, D, f, h,
    )  # fmt: skip


def solve_large_interface(
    pairs: IntArray,
    B: FloatArray,
    weights: FloatArray,
    codes: IntArray,
    p: FloatArray,
    S: FloatArray,
    R: FloatArray,
    c: float,
    delta0: FloatArray,
    f0: FloatArray,
    state: FloatArray,
    y0: FloatArray,
    y: FloatArray,
    w: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    f: FloatArray,
    h: FloatArray,
) -> tuple[int, float]:
    """As `solve_interface`."""

    def respond() -> tuple[FloatArray, float]:
        interface_response(pairs, B, weights, codes, p, delta0 + y, state, w, t, new, D, f)
        h[:] = c * (f - f0) - R @ y
        rest = y - y0 + S @ h
        return rest, float(np.abs(rest).max())

    K = np.zeros_like(S)
    rest, size = respond()
    scale = max(np.abs(y0).max(), np.abs(delta0).max(), 1e-300)
    try:
        for turn in range(1, MOST_TURNS + 1):
            scale = max(scale, float(np.abs(y).max()))
            if turn == HOLDING_TURN:
                interface_response(pairs, B, weights, codes, p, delta0, state, w, t, new, D, f)
                if hold_shear(codes, p, t, state):
                    y[:] = y0
                rest, size = respond()
            if size <= TOLERANCE * scale:
                return turn, size / scale
            interface_stiffness(pairs, B, weights, D, K)
            try:
                dy = -np.linalg.solve(np.eye(len(y)) + S @ (c * K - R), rest)
            except np.linalg.LinAlgError:
                return 0, size / scale
            before, length, start = size, 1.0, y.copy()
            for _ in range(12):
                y[:] = start + length * dy
                rest, size = respond()
                if turn <= PLAIN_TURNS or size < before:
                    break
                length *= 0.5
            if length * np.abs(dy).max() <= 1e-14 * scale and size <= ACCEPTED * scale:
                return turn, size / scale
        return -MOST_TURNS, size / scale
    finally:
        release_shear(state, new)

"""Laws of joints at points, called as the interface calls them."""

import numpy as np

from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, Parameter
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.point_state import energies_of_points


def table_of(n=1, **given):
    """Rows (n, N_PARAMETERS) of the parameters given."""
    table = np.zeros((n, N_PARAMETERS))
    for name, value in given.items():
        table[:, Parameter[name]] = value
    return table


def answer(code, w, state, p):
    """Tractions, states and tangents at jumps (n, d) or (d,)."""
    w = np.ascontiguousarray(np.atleast_2d(np.asarray(w, float)))
    n, d = w.shape
    t, new, D = np.zeros((n, d)), np.zeros((n, N_STATE)), np.zeros((n, d, d))
    respond(np.full(n, int(code)), w, state, p, t, new, D)
    return t, new, D


def energies(code, w, t, state, p):
    """Stored energy and energy lost so far of one point, from arrays (d,) and its rows."""
    codes = np.array([int(code)])
    return energies_of_points(codes, *(np.asarray(x, float)[None] for x in (w, t, state, p)))[:, 0]


def walk(code, path, p):
    """Tractions and states along a path of jumps (m, d), state committed at each."""
    state, tractions, states = np.zeros((1, N_STATE)), [], []
    for w in path:
        t, state, _ = answer(code, w, state, p)
        tractions.append(t[0])
        states.append(state[0])
    return np.array(tractions), np.array(states)

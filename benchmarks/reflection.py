"""What edges send back of plane waves, by the angle at which they meet them.

    OMP_NUM_THREADS=1 python benchmarks/reflection.py [--picture docs/pictures/reflection.png]

The ground is one column of elements, one element wide, with the matrices that a script makes of it:
what is left and right of it moves as it does, later by the time that the wave takes along the
edge. That is a plane wave of any angle, in the mesh and without limits of size. The top is moved
at one frequency; below stand the dampers of AMOR or the layer of @PML. The waves that such a mesh
carries follow from two rows of its own elements, so that what goes down and what comes up are told
apart to rounding, and the dispersion of the mesh is no error. Beside it, dampers in closed form
(Lysmer and Kuhlemeyer 1969): P and SV from the stresses at the edge, SH (1 - cos) / (1 + cos).

`by steps` measures the same in steps of DYNAMIC: a box as wide as the wave is long along the edge,
its sides tied to each other. Then what both cost, and leave, below a footing that is shaken.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.cli.run import run_text
from ssilang.kernel.matrices.assembly import assemble, constraint_matrix, numbering_of

YOUNG, POISSON, DENSITY = 1.976e8, 0.3, 1900.0
SHEAR = float(np.sqrt(YOUNG / (2 * (1 + POISSON)) / DENSITY))
PRIMARY = SHEAR * float(np.sqrt(2 * (1 - POISSON) / (1 - 2 * POISSON)))
ANGLES = (0, 15, 30, 45, 60, 75)
ROWS, A_WAVE = 12, 16
"""Elements above the edge, and in a wave of shear."""
FREQUENCY = SHEAR / A_WAVE  # elements of 1 m

_PLANE = "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; "
_COLUMN = "S = TRAN {rows} (DROI 1 (0. 0.) (1. 0.)) (0. -{rows}.) ; "
_MATERIAL = f"'YOUN' {YOUNG!r} 'NU' {POISSON!r} 'RHO' {DENSITY!r} ; "
_GROUND = "M = MODE I MECANIQUE ELASTIQUE ; A = MATE M " + _MATERIAL
_DAMPERS = "I = S ; " + _GROUND + "K = RIGI M A ; MM = MASS M A ; C = AMOR M (COTE 3 S) A ; "
_LAYER = (
    "I = S ELEM 'APPUYE' 'STRICTEMENT' ((COOR 2 S) POIN 'SUPERIEUR' (-{inside}. - 0.01)) ; "
    + _GROUND
    + "T = TABL ; T . 'INTERIEUR' = I ; T . 'MODELE' = MODE (S DIFF I) MECANIQUE ELASTIQUE ; "
    "T . 'CARACTERISTIQUES' = MATE (T . 'MODELE') " + _MATERIAL + "{reflection}P = @PML T ; "
    "K = (RIGI M A) ET (P . 'RIGI') ; MM = (MASS M A) ET (P . 'MASS') ; C = P . 'AMOR' ; "
)
_SPACE = (
    "OPTI DIME 3 MODE TRID ELEM CUB8 ; S = VOLU 1 "
    "(TRAN {rows} (DROI 1 (0. 0. 0.) (1. 0. 0.)) (0. 0. -{rows}.)) 'TRAN' (0. 1. 0.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M " + _MATERIAL
    + "F = (ENVE S) ELEM 'APPUYE' 'STRICTEMENT' ((COOR 3 S) POIN 'INFERIEUR' (-{rows}. + 0.01)) ; "
    "K = RIGI M A ; MM = MASS M A ; C = AMOR M F A ; "
)  # fmt: skip


@dataclass(frozen=True)
class Column:
    """Matrices of a column: K, M, C (n, n) of what is free, and the places of its unknowns."""

    matrices: tuple[np.ndarray, np.ndarray, np.ndarray]
    names: np.ndarray
    places: np.ndarray
    vertical: int

    @classmethod
    def of(cls, script: str, vertical: int = 1) -> Column:
        """The column of a script that names K, MM and C; `vertical` is its axis."""
        result = run_text(script)
        if result.exit_code:
            raise SystemExit(result.message)
        K, M, C = (result.session.root.find(name) for name in ("K", "MM", "C"))
        numbering = numbering_of(K, M, C)
        held = np.unique(constraint_matrix(K, numbering).C.indices)
        free = np.setdiff1d(np.arange(numbering.size), held)
        made = tuple(assemble(m, numbering).toarray()[np.ix_(free, free)] for m in (K, M, C))
        names = np.array(numbering.unknowns)[numbering.codes][free]
        return cls(made, names, numbering.table.coordinates[numbering.nodes[free]], vertical)


def dampers(rows: int = ROWS) -> Column:
    """Dampers below some rows of elements, plane strain."""
    return Column.of((_PLANE + _COLUMN + _DAMPERS).format(rows=rows))


def layer(cells: int, reflection: float | None = None, rows: int = ROWS) -> Column:
    """A matched layer of some cells below some rows of elements."""
    said = "" if reflection is None else f"T . 'REFLEXION' = {reflection!r} ; "
    made = (_PLANE + _COLUMN + _LAYER).format(rows=rows + cells, inside=rows, reflection=said)
    return Column.of(made)


def dampers_in_space(rows: int = ROWS) -> Column:
    """Dampers below some rows of bricks."""
    return Column.of(_SPACE.format(rows=rows), 2)


# ---- plane waves of the mesh ------------------------------------------------------------------


def reflected(column: Column, omega: float, along: float, unknowns: tuple[str, ...], rows: int):
    """Amplitudes (w, w) that come up, of unit waves that go down; the waves' vertical numbers.

    Parameters
    ----------
    omega, along : float
        Circular frequency, and wave number along the edge.
    unknowns : names of the w unknowns that move
    rows : elements above the edge

    Waves are sorted by their speed, the fastest first. Amplitudes are those of displacement, at the
    edge.
    """
    K, M, C = column.matrices
    A = K + 1j * omega * C - omega**2 * M
    depth = np.round(-column.places[:, column.vertical], 6)
    left, tie = _tied(column, along, unknowns)
    A, depth = tie.conj().T @ A @ tie, depth[left]
    names = column.names[left]
    at = [[int(np.flatnonzero((depth == j) & (names == u))[0]) for u in unknowns]
          for j in range(rows + 1)]  # fmt: skip
    down, up = _waves(A, at)
    given = np.zeros((len(A), len(unknowns)), complex)
    given[at[0], range(len(unknowns))] = 1.0
    inner = np.setdiff1d(np.arange(len(A)), at[0])
    moved = given
    moved[inner] = -np.linalg.solve(A[np.ix_(inner, inner)], A[np.ix_(inner, at[0])])
    # amplitudes at the edge, from all rows above it
    steps = np.arange(rows + 1) - rows
    shapes = [np.vstack([lam**j * phi for j in steps for phi in [shape]]).reshape(-1)
              for waves in (down, up) for lam, shape in waves]  # fmt: skip
    seen = moved[np.concatenate(at)]
    found = np.linalg.lstsq(np.array(shapes).T, seen, rcond=None)[0]
    w = len(unknowns)
    return found[w:] @ np.linalg.inv(found[:w]), np.array([1j * np.log(lam) for lam, _ in down])


def _tied(column: Column, along: float, unknowns: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Unknowns kept, and the motion of all of them (n, r): that at x = 0, later."""
    history = np.char.startswith(column.names.astype(str), "H")
    x, depth = column.places[:, 0], np.round(column.places[:, column.vertical], 6)
    edge = (abs(column.places[:, : column.vertical]) < 1e-9).all(axis=1)
    kept = np.flatnonzero(history | (edge & np.isin(column.names, unknowns)))
    place = {(column.names[i], depth[i]): j for j, i in enumerate(kept) if not history[i]}
    tie = np.zeros((len(x), len(kept)), complex)
    tie[kept, range(len(kept))] = 1.0
    for i in np.flatnonzero(~history & np.isin(column.names, unknowns)):
        tie[i, place[column.names[i], depth[i]]] = np.exp(-1j * along * x[i])
    return kept, tie


def _waves(A: np.ndarray, at: list[list[int]]):
    """Waves of a row of elements: (factor a row down, shape) of those that go down, and up."""
    import scipy.linalg as la

    one, two, three = at[2], at[3], at[4]
    below, here, above = (A[np.ix_(two, of)] for of in (three, two, one))
    w = len(two)
    zero, unit = np.zeros((w, w)), np.eye(w)
    values, vectors = la.eig(
        np.block([[zero, unit], [-above, -here]]), np.block([[unit, zero], [zero, below]])
    )
    going = np.where(abs(abs(values) - 1) < 1e-4, values.imag < 0, abs(values) < 1)
    found = []
    for part in (going, ~going):
        waves = [(values[i], vectors[:w, i] / np.linalg.norm(vectors[:w, i]))
                 for i in np.flatnonzero(part)]  # fmt: skip
        found.append(sorted(waves, key=lambda x: abs(np.angle(x[0]))))
    return found


# ---- closed form ------------------------------------------------------------------------------


def dashpots(kind: str, angle: float) -> np.ndarray:
    """Amplitudes (P, SV) that dampers send back of a unit wave P or SV, angle in degrees."""
    speed = PRIMARY if kind == "P" else SHEAR
    p = np.sin(np.radians(angle)) / speed
    q, s = (np.sqrt(1 / c**2 - p**2 + 0j) for c in (PRIMARY, SHEAR))
    q, s = (x if x.imag <= 0 else -x for x in (q, s))
    G, E = DENSITY * SHEAR**2, DENSITY * PRIMARY**2

    def wave(of: str, sign: float) -> np.ndarray:
        """Stress on the edge plus force of the dampers, both over i omega; z goes down."""
        k = sign * (q if of == "P" else s)
        ux, uz = (PRIMARY * p, PRIMARY * k) if of == "P" else (SHEAR * k, -SHEAR * p)
        xz = -G * (k * ux + p * uz)
        zz = -(E * k * uz + (E - 2 * G) * p * ux)
        return np.array([xz + DENSITY * SHEAR * ux, zz + DENSITY * PRIMARY * uz])

    away = np.column_stack([wave("P", -1.0), wave("S", -1.0)])
    return np.linalg.solve(away, -wave(kind[0], 1.0))


def dashpots_of_sh(angle: float) -> float:
    """Amplitude that dampers send back of SH."""
    c = np.cos(np.radians(angle))
    return float((1 - c) / (1 + c))


def share(kind: str, angle: float, amplitudes: np.ndarray) -> float:
    """Root of the energy that comes back, of amplitudes (P, SV)."""
    speed = PRIMARY if kind == "P" else SHEAR
    sines = np.sin(np.radians(angle)) / speed * np.array([PRIMARY, SHEAR])
    cosines = np.sqrt(np.maximum(1 - sines**2, 0.0))
    flux = np.array([PRIMARY, SHEAR]) * cosines
    return float(np.sqrt((np.abs(amplitudes) ** 2 * flux).sum() / (flux[0 if kind == "P" else 1])))


def measured(column: Column, kind: str, angle: float, frequency: float = FREQUENCY) -> np.ndarray:
    """Amplitudes (P, SV) that an edge sends back of a unit wave."""
    omega = 2 * np.pi * frequency
    along = omega * np.sin(np.radians(angle)) / (PRIMARY if kind == "P" else SHEAR)
    found, _ = reflected(column, omega, along, ("UX", "UY"), ROWS)
    return np.abs(found[:, 0 if kind == "P" else 1])


def measured_sh(column: Column, angle: float, rows: int = ROWS) -> float:
    """Amplitude that dampers in space send back of SH."""
    omega = 2 * np.pi * FREQUENCY
    along = omega * np.sin(np.radians(angle)) / SHEAR
    return float(np.abs(reflected(column, omega, along, ("UY",), rows)[0][0, 0]))

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

import sys
import time
from dataclasses import dataclass
from pathlib import Path

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


Wave = tuple[complex, np.ndarray]
"""Factor from a row of nodes to the one below, and shape of a wave."""


@dataclass(frozen=True)
class Column:
    """Matrices of a column: K, M, C (n, n) of what is free, and the places of its unknowns."""

    matrices: tuple[np.ndarray, np.ndarray, np.ndarray]
    names: np.ndarray
    places: np.ndarray
    vertical: int

    @classmethod
    def of(cls, script: str, vertical: int = 1) -> "Column":
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


def reflected(
    column: Column, omega: float, along: float, unknowns: tuple[str, ...], rows: int
) -> np.ndarray:
    """Amplitudes (w, w) that come up, of unit waves that go down, at the edge.

    Parameters
    ----------
    omega, along : float
        Circular frequency, and wave number along the edge.
    unknowns : names of the w unknowns that move
    rows : elements above the edge

    Waves are sorted by their speed, the fastest first. Amplitudes are those of displacement.
    """
    A, at = _seen_from_above(column, omega, along, unknowns, rows)
    moved = np.zeros((len(A), len(unknowns)), complex)
    moved[at[0], range(len(unknowns))] = 1.0
    inner = np.setdiff1d(np.arange(len(A)), at[0])
    moved[inner] = -np.linalg.solve(A[np.ix_(inner, inner)], A[np.ix_(inner, at[0])])
    return _told_apart(_waves(A, at), moved[np.concatenate(at)])


def _told_apart(waves: list[list[Wave]], seen: np.ndarray) -> np.ndarray:
    """Amplitudes (w, w) at the edge, of the motion (rows by unknowns, w) of two excitations."""
    w = seen.shape[1]
    steps = np.arange(len(seen) // w) - (len(seen) // w - 1)
    shapes = [np.concatenate([factor**j * shape for j in steps])
              for part in waves for factor, shape in part]  # fmt: skip
    found = np.linalg.lstsq(np.array(shapes).T, seen, rcond=None)[0]
    return found[w:] @ np.linalg.inv(found[:w])


def _seen_from_above(
    column: Column, omega: float, along: float, unknowns: tuple[str, ...], rows: int
) -> tuple[np.ndarray, list[list[int]]]:
    """Dynamic stiffness of a plane wave's column, and the places of the unknowns of each row."""
    K, M, C = column.matrices
    kept, tie = _tied(column, along, unknowns)
    A = tie.conj().T @ (K + 1j * omega * C - omega**2 * M) @ tie
    depth, names = np.round(-column.places[kept, column.vertical], 6), column.names[kept]
    at = [[int(np.flatnonzero((depth == j) & (names == u))[0]) for u in unknowns]
          for j in range(rows + 1)]  # fmt: skip
    return A, at


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


def _waves(A: np.ndarray, at: list[list[int]]) -> list[list[Wave]]:
    """Waves of a row of elements: those that go down, and up."""
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
        found.append(sorted(waves, key=lambda wave: abs(np.angle(wave[0]))))
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
    found = reflected(column, omega, along, ("UX", "UY"), ROWS)
    return np.abs(found[:, 0 if kind == "P" else 1])


def measured_sh(column: Column, angle: float, rows: int = ROWS) -> float:
    """Amplitude that dampers in space send back of SH."""
    omega = 2 * np.pi * FREQUENCY
    along = omega * np.sin(np.radians(angle)) / SHEAR
    return float(np.abs(reflected(column, omega, along, ("UY",), rows)[0, 0]))


# ---- the same by steps ------------------------------------------------------------------------

WIDE, PERIODS, A_PERIOD = 24, 12, 32
_BOX = "S = TRAN {rows} (DROI {wide} (0. 0.) ({wide}. 0.)) (0. -{rows}.) ; "
_DRIVEN = (
    "TOP = COTE 1 S ; LE = CHAN 'POI1' (INVE (COTE 4 S)) ; RI = CHAN 'POI1' (COTE 2 S) ; "
    "LE = LE DIFF (LE INTE ((COOR 2 LE) POIN 'SUPERIEUR' -0.01)) ; "
    "RI = RI DIFF (RI INTE ((COOR 2 RI) POIN 'SUPERIEUR' -0.01)) ; "
    "TIE = (RELA 'UX' LE - 'UX' RI) ET (RELA 'UY' LE - 'UY' RI) ; "
    "BX = BLOQ 'UX' TOP ; BY = BLOQ 'UY' TOP ; CX = (COOR 1 TOP) * (360. / {wide}.) ; "
    "LT = PROG 0. 'PAS' {step!r} {end!r} ; LW = LT * {degrees!r} ; LR = LT * {ramp!r} ; "
    "LR = 0.5 * ((LR + 1.) - (ABS (LR - 1.))) ; "
    "FC = DEPI B{way} (NOMC 'U{way}' (COS CX)) ; FS = DEPI B{way} (NOMC 'U{way}' (SIN CX)) ; "
    "E = TABL ; E . 'RIGI' = K ET TIE ET BX ET BY ; E . 'MASS' = MM ; E . 'AMOR' = C ; "
    "E . 'CHAR' = (CHAR 'DIMP' FC (EVOL 'MANU' LT (LR * (COS LW)))) ET "
    "(CHAR 'DIMP' FS (EVOL 'MANU' LT (LR * (SIN LW)))) ; "
    "E . 'TEMPS_CALCULES' = LT ; E . 'PAS_SAUVES' = 1 ; R = DYNAMIC E ; "
)


def by_steps(angle: float, cells: int | None) -> tuple[float, float]:
    """Root of the energy of SV that comes back in steps of DYNAMIC, and by matrices.

    `cells` None: dampers. Average acceleration moves at the frequency tan(omega dt / 2) 2 / dt.
    """
    along = 2 * np.pi / WIDE
    seen = along * SHEAR / np.sin(np.radians(angle))  # what the matrices see
    step = float(2 * np.pi / seen / A_PERIOD)
    omega = float(2 / step * np.arctan(seen * step / 2))
    make = _PLANE + _BOX + (_DAMPERS if cells is None else _LAYER)
    rows = ROWS + (cells or 0)
    motions = []
    for way in ("X", "Y"):
        end = PERIODS * 2 * np.pi / omega
        script = (make + _DRIVEN).format(
            rows=rows, wide=WIDE, inside=ROWS, reflection="", step=step, way=way,
            end=end, degrees=float(np.degrees(omega)), ramp=omega / (8 * np.pi),
        )  # fmt: skip
        motions.append(_harmonic(script, omega, along))
    column = dampers() if cells is None else layer(cells)
    A, at = _seen_from_above(column, seen, along, ("UX", "UY"), ROWS)
    found = _told_apart(_waves(A, at), np.array(motions).T)
    expected = reflected(column, seen, along, ("UX", "UY"), ROWS)
    return tuple(share("SV", angle, np.abs(x[:, 1])) for x in (found, expected))


def _harmonic(script: str, omega: float, along: float) -> np.ndarray:
    """Amplitude of exp(i (omega t - along x)) of each row's UX and UY, over the last periods."""
    result = run_text(script)
    if result.exit_code:
        raise SystemExit(result.message)
    table, ground = result.session.root.find("R"), result.session.root.find("I")
    count = sum(isinstance(i, int) for i in table.indices())
    nodes = ground.sorted_node_ids
    x, depth = ground.nodes.coordinates[nodes, :2].T
    kept = nodes[x < WIDE - 1e-6]
    x, depth = ground.nodes.coordinates[kept, :2].T
    turn = np.exp(1j * along * x)
    found = np.zeros((ROWS + 1, 2), complex)
    instants = [table.get(i + 1) for i in range(count - 3 * A_PERIOD, count)]
    times = np.array([float(i.get("TEMP")) for i in instants])
    kernel = np.exp(-1j * omega * times)
    for j, name in enumerate(("UX", "UY")):
        moved = np.array([i.get("DEPL").values_at(name, kept) for i in instants])
        # the grid of times holds no whole number of periods: fit, do not average
        basis = np.stack([kernel.conj(), kernel], axis=1)
        each = np.linalg.lstsq(basis, moved.astype(complex), rcond=None)[0][0]
        for row in range(ROWS + 1):
            at = np.abs(depth + row) < 1e-6
            found[row, j] = (each[at] * turn[at]).mean()
    return found.ravel()


# ---- what they cost and leave below a footing -------------------------------------------------

_FOOTING = (
    "S = TRAN {down} (DROI {wide} (-{half}. 0.) ({half}. 0.)) (0. -{down}.) ; "
    "I = S ELEM 'APPUYE' 'STRICTEMENT' (((COOR 1 S) POIN 'COMPRIS' (-{x}. - 0.01) ({x}. + 0.01)) "
    "INTE ((COOR 2 S) POIN 'SUPERIEUR' (-{y}. - 0.01))) ; "
)
_SHAKEN = (
    "LT = PROG 0. PAS 0.002 0.4 ; LX = (LT - 0.08) * (PI * 15.) ; LX = LX * LX ; "
    "F = (FORC (1.E5 1.E5) (I POIN 'PROC' (-2. 0.))) ET (FORC (1.E5 -1.E5) (I POIN 'PROC' (2. 0.)))"
    " ; E = TABL ; E . 'RIGI' = K ; E . 'MASS' = MM ; E . 'AMOR' = C ; E . 'CHAR' = "
    "CHAR 'MECA' F (EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX)))) ; "
    "E . 'TEMPS_CALCULES' = LT ; E . 'PAS_SAUVES' = 1 ; E . 'MAILLAGE_SAUVE' = I ; "
    "R = DYNAMIC E ; "
)
_SOFT = "'YOUN' 8.E7 'NU' 0.35 'RHO' 1800."
_STIFF = "'YOUN' 4.E8 'NU' 0.3 'RHO' 2000."
_LOWER = "(COTE 2 S) ET (COTE 3 S) ET (COTE 4 S)"


def _two_soils(script: str) -> str:
    """The script with 3 m of softer soil on top, through a matched layer too."""
    upper = "(({of}) INTE TOP)"
    lower = "(({of}) DIFF (({of}) INTE TOP))"
    for of, model, material in (("I", "M", "A"), ("S DIFF I", "N", "B")):
        parts = [
            f"{model}{i} = MODE {half.format(of=of)} MECANIQUE ELASTIQUE ; "
            f"{material}{i} = MATE {model}{i} {given} ; "
            for i, half, given in ((1, upper, _SOFT), (2, lower, _STIFF))
        ]
        both = f"{model} = {model}1 ET {model}2 ; {material} = {material}1 ET {material}2 ; "
        made = "".join(parts) + both
        if of == "I":
            script = script.replace(_GROUND, made)
        else:
            given = "T . 'MODELE' = MODE (S DIFF I) MECANIQUE ELASTIQUE ; "
            script = script.replace(given, made + "T . 'MODELE' = N ; ")
            whole = "T . 'CARACTERISTIQUES' = MATE (T . 'MODELE') " + _MATERIAL
            script = script.replace(whole, "T . 'CARACTERISTIQUES' = B ; ")
    top = "TOP = S ELEM 'APPUYE' 'STRICTEMENT' ((COOR 2 S) POIN 'SUPERIEUR' -3.01) ; "
    return script.replace("I = S", top + "I = S", 1)


def footing(x: int, y: int, cells: int | None, two: bool = False) -> tuple[np.ndarray, int, float]:
    """Motion of eight unknowns of a shaken surface, unknowns, and seconds of a processor.

    Waves of shear of 13 m at the peak of the load's spectrum; the box has the half width x and the
    depth y. `two` soils: the upper one is softer.
    """
    own = cells or 0
    tail = _DAMPERS.replace("COTE 3 S", _LOWER) if cells is None else _LAYER.split("; ", 1)[1]
    script = (_PLANE + _FOOTING + tail + _SHAKEN).format(
        wide=2 * (x + own), half=x + own, down=y + own, x=x, y=y, reflection=""
    )
    script = _two_soils(script) if two else script
    run_text(script.replace("PAS 0.002 0.4", "PAS 0.002 0.004"))  # compiled before
    begin = time.process_time()
    result = run_text(script)
    seconds = time.process_time() - begin
    if result.exit_code:
        raise SystemExit(result.message)
    find = result.session.root.find
    ground, table = find("I"), find("R")
    xy = ground.nodes.coordinates[ground.sorted_node_ids, :2]
    places = ((2.0, 0.0), (6.0, 0.0), (-8.0, -2.0), (0.0, -4.0))
    at = ground.sorted_node_ids[[int(np.argmin(np.hypot(*(xy - p).T))) for p in places]]
    count = sum(isinstance(i, int) for i in table.indices())
    moved = [np.concatenate([table.get(i + 1).get("DEPL").values_at(n, at) for n in ("UX", "UY")])
             for i in range(count)]  # fmt: skip
    return np.array(moved), numbering_of(find("K"), find("MM"), find("C")).size, seconds


def compare_footings() -> None:
    """Boxes round a shaken surface against one that no wave crosses twice."""
    exact = [footing(100, 80, None, two)[0] for two in (False, True)]
    print(
        "\nshaken surface: half width x depth (m), edge, unknowns, seconds, errors over the peak:"
    )
    print("one soil, and with 3 m of softer soil on top")
    for x, y, cells in (
        (10, 6, None), (20, 12, None), (40, 24, None), (10, 6, 4), (10, 6, 8), (10, 6, 16),
    ):  # fmt: skip
        errors = []
        for two in (True, False):
            moved, size, seconds = footing(x, y, cells, two)
            peaks = np.abs(exact[two]).max(axis=0).reshape(2, -1).max(axis=0)  # of each node
            gap = np.abs(moved - exact[two]).max(axis=0).reshape(2, -1)
            errors.append(float((gap / peaks).max()))
        edge = "dampers" if cells is None else f"layer {cells}"
        print(f"{x:4d} x {y:2d}  {edge:9s} {size:7d} {seconds:7.2f} {errors[1]:9.1e}"
              f"{errors[0]:9.1e}")  # fmt: skip


# ---- tables and picture -----------------------------------------------------------------------

LAYERS = (4, 8, 16)


def compare_angles() -> None:
    """Roots of the energies that come back, by angle."""
    edges = [("dampers", dampers()), *((f"layer {n}", layer(n)) for n in LAYERS)]
    print("root of the energy that comes back;", A_WAVE, "elements in a wave of shear")
    print(f"{'':18s}" + "".join(f"{a:9d}" for a in ANGLES))
    for kind in ("P", "SV"):
        print(f"{kind:3s}{'dampers, exact':15s}" + "".join(
            f"{share(kind, a, np.abs(dashpots(kind, a))):9.4f}" for a in ANGLES))  # fmt: skip
        for name, column in edges:
            for slower in (1, 4) if name == "layer 8" else (1,):
                found = (share(kind, a, measured(column, kind, a, FREQUENCY / slower))
                         for a in ANGLES)  # fmt: skip
                said = name if slower == 1 else f"{name}, f/{slower}"
                print(f"{kind:3s}{said:15s}" + "".join(f"{x:9.4f}" for x in found))
    column = dampers_in_space()
    print(f"SH {'dampers, exact':15s}" + "".join(f"{dashpots_of_sh(a):9.4f}" for a in ANGLES))
    print(f"SH {'dampers':15s}" + "".join(f"{measured_sh(column, a):9.4f}" for a in ANGLES))
    print("\nthe same by steps of DYNAMIC, SV at 45 degrees: by steps, by matrices")
    for cells in (None, 4, 8):
        print(f"{'dampers' if cells is None else f'layer {cells}':18s}"
              "{:9.4f}{:9.4f}".format(*by_steps(45.0, cells)))  # fmt: skip


def picture(path: Path) -> None:
    """Curves in closed form, points measured."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    angles = np.arange(0.0, 84.0, 1.0)
    few = np.arange(0.0, 84.0, 4.0)
    figure, axes = plt.subplots(1, 2, figsize=(8.0, 3.4), sharey=True)
    for axis, kind in zip(axes, ("P", "SV"), strict=True):
        exact = [share(kind, a, np.abs(dashpots(kind, a))) for a in angles]
        axis.semilogy(angles, exact, color="black", label="dampers, exact")
        column = dampers()
        points = [share(kind, a, measured(column, kind, a)) for a in few]
        axis.semilogy(few, points, "o", mfc="none", color="black", ms=4, label="dampers, measured")
        for cells, colour in zip(LAYERS, ("#c1272d", "#0000a7", "#008176"), strict=True):
            column = layer(cells)
            found = [share(kind, a, measured(column, kind, a)) for a in few]
            axis.semilogy(few, found, ".-", color=colour, label=f"layer of {cells} elements")
        axis.set(title=kind, xlabel="angle of incidence (degrees)", ylim=(5e-4, 1.0))
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("root of the energy sent back")
    axes[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main() -> None:
    """Tables, and the picture where a path is given."""
    compare_angles()
    compare_footings()
    if "--picture" in sys.argv:
        picture(Path(sys.argv[sys.argv.index("--picture") + 1]))


if __name__ == "__main__":
    main()

"""Inclined waves in layered ground, brought in by domain reduction: what moves outside the layer.

    OMP_NUM_THREADS=1 python benchmarks/domain_reduction.py [--picture docs/pictures/drm_layers.png]

Two layers on a half-space, a box of 40 x 15 m, elements of 1 m, no structure: all that moves
outside the layer of @DRM is an error. Once the free field is that of @ONDE (theory: the error
of the mesh is left), once that of the box under @BORDS (same elements and steps). Accelerations,
largest of all nodes outside, and inside against the free field, over the peak of the surface. SV at
40 degrees is beyond the critical angle (32): such a wave has no beginning, and a box that starts at
rest shows it where theory gives the free field.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

from ssilang.cli.run import run_text

CASES = (("SV", 0), ("SV", 20), ("SV", 30), ("SV", 40), ("P", 20), ("P", 40))
LAYERS = ((5.0, 1.8e8, 0.3, 1800.0), (5.0, 3.6e8, 0.3, 1900.0), (None, 9.6e8, 0.3, 2000.0))

_BOX = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; LS = DROI {wide} (-{half}. 0.) ({half}. 0.) ; "
    "S1 = TRAN 5 LS (0. -5.) ; S2 = TRAN 5 (COTE 3 S1) (0. -5.) ; "
    "S3 = TRAN 5 (COTE 3 S2) (0. -5.) ; S = S1 ET S2 ET S3 ; "
    "M1 = MODE S1 MECANIQUE ELASTIQUE ; M2 = MODE S2 MECANIQUE ELASTIQUE ; "
    "M3 = MODE S3 MECANIQUE ELASTIQUE ; M = M1 ET M2 ET M3 ; A = {materials} ; "
    "K = RIGI M A ; MM = MASS M A ; CO = CONT S ; "
    "F = CO ELEM 'APPUYE' 'LARGEMENT' ((COOR 2 CO) POIN 'INFERIEUR' -0.01) ; C = AMOR M F A ; "
    "CX = COOR 1 S ; CY = COOR 2 S ; I = S ELEM 'APPUYE' 'STRICTEMENT' "
    "((CX POIN 'COMPRIS' -{inner}.01 {inner}.01) INTE (CY POIN 'SUPERIEUR' -8.01)) ; "
    "L = (S ELEM 'APPUYE' 'LARGEMENT' I) DIFF I ; O = (S DIFF I) DIFF L ; "
    "LT = PROG 0. PAS {step} {end} ; LX = (LT - {peak}) * (PI * {frequency}) ; LX = LX * LX ; "
    "W = TABL ; W . 'POINTS' = S ; W . 'POINT' = 0. 0. ; W . 'ONDE' = '{kind}' ; "
    "W . 'ANGLE' = {angle}. ; W . 'ACCELERATION' = EVOL 'MANU' LT "
    "((1. - (2. * LX)) * (EXP (-1. * LX))) ; W . 'COUCHES' = TABL ; {layers}"
    "U1 = @ONDE W ; T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'RIGI' = K ; "
    "T . 'MASS' = MM ; T . 'AMORTISSEURS' = C ; T . 'FRONTIERE' = F ; T . 'COUCHE' = L ; "
    "T . 'INTERIEUR' = I ; T . 'MOUVEMENT' = U1 ; "
    "DEBP STEPS CH1*CHARGEMENT ; E = TABL ; E . 'RIGI' = K ; E . 'MASS' = MM ; E . 'AMOR' = C ; "
    "E . 'CHAR' = CH1 ; E . 'TEMPS_CALCULES' = LT ; E . 'PAS_SAUVES' = 1 ; R1 = DYNAMIC E ; "
    "FINP R1 ; "
)
_RUN = (
    "U2 = STEPS (@BORDS T) ; R1 = STEPS (@DRM T) ; T . 'MOUVEMENT' = U2 ; R2 = STEPS (@DRM T) ; "
    "Q = S POIN 'PROC' (0. 0.) ; "
)


def script(kind: str, angle: int, half: int = 20, inner: int = 12, end: float = 1.2) -> str:
    """Free fields U1 (@ONDE) and U2 (@BORDS), motions R1 and R2 by @DRM of each."""
    materials = " ET ".join(
        f"(MATE M{i} 'YOUN' {e!r} 'NU' {nu!r} 'RHO' {rho!r})"
        for i, (_, e, nu, rho) in enumerate(LAYERS, 1)
    )
    layers = "".join(
        f"W . 'COUCHES' . {i} = TABL ; W . 'COUCHES' . {i} . 'YOUNG' = {e!r} ; "
        f"W . 'COUCHES' . {i} . 'POISSON' = {nu!r} ; "
        f"W . 'COUCHES' . {i} . 'MASSE_VOLUMIQUE' = {rho!r} ; "
        + ("" if h is None else f"W . 'COUCHES' . {i} . 'EPAISSEUR' = {h!r} ; ")
        for i, (h, e, nu, rho) in enumerate(LAYERS, 1)
    )
    box = _BOX.format(
        wide=2 * half, half=half, inner=inner, materials=materials, layers=layers, kind=kind,
        angle=angle, step=0.004, end=end, peak=0.55, frequency=3.0,
    )  # fmt: skip
    return box + _RUN


def accelerations(find, name: str, nodes: np.ndarray) -> np.ndarray:
    """(instants, 2, nodes)."""
    table = find(name)
    count = sum(isinstance(i, int) for i in table.indices())
    return np.array([
        [table.get(i + 1).get("ACCE").values_at(u, nodes) for u in ("UX", "UY")]
        for i in range(count)
    ])  # fmt: skip


def measured(kind: str, angle: int, **sizes: float) -> dict[str, float]:
    """Largest accelerations over the peak of the surface; the histories under 'times' ..."""
    with tempfile.TemporaryDirectory() as folder:
        result = run_text(script(kind, angle, **sizes), Path(folder))
    if result.exit_code:
        raise SystemExit(result.message)
    find = result.session.root.find
    inside, outside = (find(n).sorted_node_ids for n in ("I", "O"))
    outside = np.setdiff1d(outside, find("L").sorted_node_ids)
    surface = np.array([find("Q").node])
    found: dict[str, float] = {}
    peak = float(np.abs(accelerations(find, "U2", surface)).max())
    for free, by, said in (("U1", "R1", "theory"), ("U2", "R2", "elements")):
        found[f"outside, {said}"] = float(np.abs(accelerations(find, by, outside)).max()) / peak
        gap = accelerations(find, by, inside) - accelerations(find, free, inside)
        found[f"inside, {said}"] = float(np.abs(gap).max()) / peak
    gap = accelerations(find, "U2", inside) - accelerations(find, "U1", inside)
    found["box against theory"] = float(np.abs(gap).max()) / peak
    return found


def main() -> None:
    """The table, and the picture where a path is given."""
    rows = {case: measured(*case) for case in CASES}
    print(f"{'':22s}" + "".join(f"{kind:>6s} {angle:2d}" for kind, angle in rows))
    for name in next(iter(rows.values())):
        print(f"{name:22s}" + "".join(f"{row[name]:9.1e}" for row in rows.values()))
    if "--picture" in sys.argv:
        picture(Path(sys.argv[sys.argv.index("--picture") + 1]))


def picture(path: Path) -> None:
    """The surface under SV at 20 degrees, and what moves outside by either free field."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    result = run_text(script("SV", 20))
    find = result.session.root.find
    times = np.asarray(find("LT").values)
    surface = np.array([find("Q").node])
    outside = np.setdiff1d(find("O").sorted_node_ids, find("L").sorted_node_ids)
    free = accelerations(find, "U2", surface)[:, :, 0]
    peak = np.abs(free).max()
    figure, axes = plt.subplots(1, 2, figsize=(8.0, 3.2))
    for i, (name, colour) in enumerate((("UX", "black"), ("UY", "#0000a7"))):
        axes[0].plot(times, free[:, i] / peak, color=colour, label=f"free field, {name}")
        by = accelerations(find, "R2", surface)[:, i, 0]
        axes[0].plot(times[::12], by[::12] / peak, "o", mfc="none", ms=4, color=colour,
                     label=f"inside, {name}")  # fmt: skip
    axes[0].set(xlabel="time (s)", ylabel="acceleration over the peak")
    for name, colour, said in (
        ("R1", "#c1272d", "free field of @ONDE"), ("R2", "#008176", "free field of the elements"),
    ):  # fmt: skip
        largest = np.abs(accelerations(find, name, outside)).max(axis=(1, 2)) / peak
        axes[1].semilogy(times, np.maximum(largest, 1e-17), color=colour, label=said)
    axes[1].axhline(1e-6, color="grey", ls=":")
    axes[1].set(xlabel="time (s)", ylabel="largest outside, over the peak")
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


if __name__ == "__main__":
    main()

"""The oscillator of club-b as a script, for the benchmarks."""

import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

YOUNG, INERTIA, HEIGHT, FREQUENCY, SOIL, RELEASE = 20.0e9, 0.2, 10.0, 10.0, 7.3888e6, 0.01
STIFFNESS = 3.0 * YOUNG * INERTIA / HEIGHT**3
MASS = STIFFNESS / (2.0 * np.pi * FREQUENCY) ** 2

STEPS = """
TAB1 . 'RIGI' = RIG ;
TAB1 . 'MASS' = MASS 'DEPL' {mass} PTOP ;
TAB1 . 'MODELE' = MOJ ;
TAB1 . 'CARACTERISTIQUES' = MAJ ;
TAB1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' {dt} 'NPAS' {steps} ;
TAB1 . 'PAS_SAUVES' = {every} ;
TAB1 . 'VITEUNIL' = FAUX ;
TAB2 = DYNAMIC TAB1 ;
EVU = EVOL 'TEMP' TAB2 'DEPL' 'UX' PTOP ;
LT = EXTR EVU 'ABSC' ;
LU = EXTR EVU 'ORDO' ;
FIN ;
"""
"""What both scripts end with."""

SCRIPT = (
    """
OPTI ECHO 0 ;
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
PBAS = 0. 0. ; PTOP = 0. {height} ; PSOL = -1. {height} ;
COL = DROI 1 PBAS PTOP ;
MOC = MODE COL 'MECANIQUE' 'ELASTIQUE' 'POUT' ;
MAC = MATE MOC 'YOUN' {young} 'NU' 0.2 'RHO' 0. 'SECT' 1. 'INRY' {inertia} 'INRZ' {inertia} ;
JOI = MANU 'SEG2' PSOL PTOP ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
MAJ = MATE MOJ 'KN' {soil} 'KS' 0. ;
BLO = (BLOQ 'UX' 'UY' 'RZ' PBAS) ET (BLOQ 'UX' 'UY' PSOL) ET (BLOQ 'UY' PTOP) ;
RIG = (RIGI MOC MAC) ET BLO ;
TAB1 = TABL ;
TAB1 . 'DEPL' = RESO RIG (FORC ({push} 0.) PTOP) ;
TAB1 . 'VITE' = 0. * (TAB1 . 'DEPL') ;
TAB1 . 'CHAR' = CHAR 'MECA' (FORC (0. 0.) PTOP) ;
"""
    + STEPS
)

POINT = (
    """
OPTI ECHO 0 ;
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
PTOP = 0. {height} ; PSOL = -1. {height} ;
JOI = MANU 'SEG2' PSOL PTOP ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
MAJ = MATE MOJ 'KN' {soil} 'KS' 0. ;
SPR = APPU 'UX' {stiffness} PTOP ;
RIG = SPR ET (BLOQ 'UX' 'UY' PSOL) ET (BLOQ 'UY' PTOP) ;
TAB1 = TABL ;
TAB1 . 'DEPL' = MANU 'CHPO' PTOP 1 'UX' {release} ;
"""
    + STEPS
)
"""The same as a mass on a spring and a joint."""


@dataclass(frozen=True)
class Run:
    """Times and displacements saved, and the seconds that the script took."""

    t: np.ndarray
    u: np.ndarray
    seconds: float


def run(steps: int, dt: float, every: int, folder: Path, script: str = SCRIPT) -> Run:
    """Run the script in this process."""
    from ssilang.cli.run import run_text

    text = script.format(
        young=YOUNG,
        inertia=INERTIA,
        height=HEIGHT,
        soil=SOIL,
        mass=repr(float(MASS)),
        push=repr(STIFFNESS * RELEASE),
        stiffness=repr(STIFFNESS),
        release=repr(RELEASE),
        dt=dt,
        steps=steps,
        every=every,
    )
    start = time.perf_counter()
    result = run_text(text, output_directory=folder)
    seconds = time.perf_counter() - start
    if result.exit_code:
        raise SystemExit(result.message)
    t, u = (result.session.root.find(n).values for n in ("LT", "LU"))
    return Run(t, u, seconds)


def steps_per_second(
    steps: int, dt: float, folder: Path, script: str = SCRIPT, repeats: int = 60
) -> tuple[float, float]:
    """Steps per second of the loop (the script's fixed part taken off), and that part (s).

    Short and long runs in turn, the fastest of each: the fixed part is several times the loop's.
    """
    run(100, dt, 100, folder, script)  # compiles
    short, long = np.inf, np.inf
    for _ in range(repeats):
        short = min(short, run(100, dt, 100, folder, script).seconds)
        long = min(long, run(100 + steps, dt, 100 + steps, folder, script).seconds)
    return steps / (long - short), short

"""Runs that several tests of reports look at, each made once."""

from __future__ import annotations

from pathlib import Path

import pytest

from ssilang.cli.run import RunOptions, run_file

ROCKING = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
T = MAILLER 'SOL' 12. 4. 'SEMELLE' 4. 1. 'STRUCTURE' 2. 4. 'TAILLE' 1. 2. ;
BODY = (T . 'SEMELLE') ET (T . 'STRUCTURE') ;
MO = MODE (T . 'TOTAL') 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 5.E8 'NU' 0.3 'RHO' 2000. ;
MJ = MODE (T . 'JOINT') 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
AJ = MATE MJ 'KN' 2.E8 'KS' 2.E8 'FROT' 0.7 ;
RI = (RIGI MO MA) ET (RIGI MJ AJ) ET (BLOQ 'DEPL' (T . 'BASE')) ; MS = MASS MO MA ;
FG = MS * (MANU 'CHPO' BODY 1 'UY' -9.81) ;
T1 = TABL ; T1 . 'MODELE' = MO ET MJ ; T1 . 'CARACTERISTIQUES' = MA ET AJ ;
T1 . 'RIGI' = RI ; T1 . 'MASS' = MS ; T1 . 'CHAR' = CHAR 'MECA' FG ;
T1 . 'DEPL' = RESO RI FG ; T1 . 'VITE' = MANU 'CHPO' BODY 1 'UX' 1. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-3 0.4 ; T1 . 'PAS_SAUVES' = 2 ;
T1 . 'PAS_SAUVES_VTK' = 40 ; T1 . 'MAILLAGE_VTK' = (T . 'TOTAL') ET (T . 'JOINT') ;
T1 . 'PAS_SAUVES_CSV' = 4 ; T1 . 'MAILLAGE_CSV' = T . 'SOMMET' ; T1 . 'FICHIER_CSV' = 'top' ;
T2 = DYNAMIC T1 ;
DESS (EVOL 'TEMP' T2 'DEPL' 'UX' (T . 'SOMMET')) 'TITR' 'drift of the top' ;
SORT 'BILA' 'steps <b>kept</b>' (DIME T2) 101. 0.5 ; SORT 'BILA' 'never so' 1. 2. 0.5 ;
"""

MODES = """
OPTI DIME 3 ELEM CUB8 ;
V = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 2 (0. 1. 0.) VOLU 'TRAN' 4 (0. 0. 6.) ;
M = MODE V 'MECANIQUE' 'ELASTIQUE' ; A = MATE M 'YOUN' 2.E10 'NU' 0.2 'RHO' 2500. ;
BAS = V POIN 'PLAN' (0. 0. 0.) (1. 0. 0.) (0. 1. 0.) ;
K = (RIGI M A) ET (BLOQ 'DEPL' BAS) ; BASE = VIBR 'SIMU' 1. 3 K (MASS M A) ;
"""


def run(folder: Path, text: str, report: bool = True, language: str = "en") -> Path:
    """The folder of results of a deck."""
    (folder / "deck.ssi").write_text(text)
    options = RunOptions(
        output_directory=folder / "out", summary=True, report=report, language=language
    )
    run_file(folder / "deck.ssi", options)
    return folder / "out"


@pytest.fixture(scope="session")
def rocking(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tower on soil that rocks, with its report."""
    return run(tmp_path_factory.mktemp("rocking"), ROCKING)


@pytest.fixture(scope="session")
def modes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A column's modes in space, with their report."""
    return run(tmp_path_factory.mktemp("modes"), MODES)

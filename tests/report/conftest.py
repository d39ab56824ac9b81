"""Runs that several tests of reports look at, each made once."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from chromium import PROGRAM, Chromium

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


VERDICT = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; S = DROI 8 (0. 0.) (4. 0.) ; F = S PLUS (0. 0.) ;
J = RACC 1.E-3 F S ; M = MODE J MECANIQUE ELASTIQUE JOINT_SDM JOI2 ; PC = 2. 1. ;
A = MATE M 'KN' 2.E7 'KS' 2.E7 ; B = (BLOQ 'UX' 'UY' S) ET (RELA 'CORI' 'DEPL' 'ROTA' PC F) ;
U0 = (MANU 'CHPO' PC 3 'UX' 0. 'UY' -7.5E-3 'RZ' 0.) ET (MANU 'CHPO' F 2 'UX' 0. 'UY' -7.5E-3) ;
T = TABL ; T . 'DEPL' = U0 ; T . 'VITE' = 0. * U0 ; T . 'RIGI' = B ; T . 'MODELE' = M ;
T . 'CARACTERISTIQUES' = A ; T . 'MASS' = (MASS 'DEPL' 6.E4 PC) ET (MASS 'ROTA' 1.E5 PC) ;
LT = PROG 0. 'PAS' 0.005 0.5 ; LA = SIN (LT * 720.) ;
T . 'CHAR' = (CHAR 'MECA' (FORC (0. -6.E5) PC) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.))) ET
  (CHAR 'MECA' (FORC (5.E5 0.) PC) (EVOL 'MANU' LT LA)) ; T . 'TEMPS_CALCULES' = LT ;
T . 'PAS_SAUVES' = 'TOUS' ; D = DYNAMIC T ; V = TABL ; V . 'RESULTATS' = D ;
V . 'MODELE' = M ; V . 'CARACTERISTIQUES' = A ; V . 'CAPACITE' = 2.E5 ; V . 'FROTTEMENT' = 0.7 ;
P = TABL ; P . 'POINT' = PC ; P . 'COMPOSANTE' = 'UX' ;
V . 'PLANCHERS' = TABL ; V . 'PLANCHERS' . 1 = P ; R = @BILANSSI V ;
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
def started(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chromium]:
    """A browser for all pages: its start takes as long as what a page is asked."""
    if PROGRAM is None:
        pytest.skip("needs Debian's chromium")
    made = Chromium(tmp_path_factory.mktemp("browser"))
    yield made
    made.close()


@pytest.fixture(scope="module")
def browser(started: Chromium) -> Iterator[Chromium]:
    """The same; what moves on its page does so no longer than a module."""
    yield started
    started.ask("Page.navigate", url="about:blank")


@pytest.fixture(scope="session")
def rocking(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tower on soil that rocks, with its report."""
    return run(tmp_path_factory.mktemp("rocking"), ROCKING)


@pytest.fixture(scope="session")
def modes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A column's modes in space, with their report."""
    return run(tmp_path_factory.mktemp("modes"), MODES)


@pytest.fixture(scope="session")
def verdict_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A rocking strip and its verdict, with their report in French."""
    return run(tmp_path_factory.mktemp("verdict"), VERDICT, language="fr")

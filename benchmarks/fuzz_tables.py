"""Puts hostile values into every entry of the tables that procedures take.

    python benchmarks/fuzz_tables.py [PROCEDURE ...] [--all]

Each procedure has a small sound deck here. Every entry of its table (nested tables too) is taken
away, then set to each hostile value: wrong types, empty lists and objects, NaN, zero matrices,
fields on another mesh, decreasing times. A run must end with a result or with a message that
names the entry. Prints defects, slow runs, and messages that do not name their entry (with --all
also what passed); exits 1 if there is a defect or a slow run.
"""

import io
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from ssilang.cli.interrupts import interrupt
from ssilang.cli.run import RunOptions, RunResult, execute, make_session, run_source
from ssilang.language.run.session import Limits
from ssilang.language.text.source import Source
from ssilang.language.values import Table

_SECONDS = 10

# objects that hostile values are made of; no name of the decks below
_SPARE = """
ZP1 = {point} ; ZP2 = ZP1 PLUS {point} ; ZM1 = MANU 'SEG2' ZP1 ZP2 ;
ZN1 = (PROG 0.) / (PROG 0.) ; ZNAN = EXTR ZN1 1 ; ZRI = MANU 'RIGI' ZP1 (MOTS 'UX') (PROG 3.) ;
ZR0 = MANU 'RIGI' ZP1 (MOTS 'UX') (PROG 0.) ; ZC1 = MANU 'CHPO' ZM1 1 'UX' 2. ;
ZCN = ZNAN * (MANU 'CHPO' ZM1 1 'UX' 1.) ; ZCX = MANU 'CHPO' ZM1 1 'XYZ' 2. ;
ZEV = EVOL 'MANU' 'T' (PROG 0. 1.) 'A' (PROG 1. 2.) ;
ZEN = EVOL 'MANU' 'T' (PROG 0. 1.) 'A' (ZN1 ET ZN1) ; ZCH = CHAR 'MECA' ZC1 ZEV ;
ZMO = MODE ZM1 'MECANIQUE' 'BARR' ; ZMA = MATE ZMO 'YOUN' 1. 'SECT' 1. ;
"""
HOSTILE = (
    "VRAI", "0", "-1", "1000000", "0.", "-1.", "1.E30", "1.E-30", "ZNAN", "'ABC'", "''", "(PROG)",
    "(PROG 1.)", "(PROG 1. 0.5 0.)", "(PROG 0. 0. 0.)", "(PROG -1. 1.)", "ZN1", "(ZN1 ET ZN1)",
    "(LECT)", "(LECT -1)", "(MOTS)", "(MOTS 'ABC')", "(TABL)", "(VIDE 'MAILLAGE')",
    "(VIDE 'CHPOINT')", "(VIDE 'MCHAML')", "(VIDE 'MMODEL')", "(VIDE 'RIGIDITE')",
    "(VIDE 'EVOLUTIO')", "(VIDE 'CHARGEME')", "ZP1", "ZM1", "ZRI", "ZR0", "ZC1", "ZCN", "ZCX",
    "ZEV", "ZEN", "ZCH", "ZMO", "ZMA",
)  # fmt: skip


@dataclass(frozen=True)
class Deck:
    """A sound calculation: what makes the table(s), the call, the tables to spoil."""

    setup: str
    call: str
    tables: tuple[str, ...] = ("T1",)
    left_out: tuple[str, ...] = ()  # entries that are objects, not parameters


_OSCILLATOR = """
OPTI DIME 2 ELEM SEG2 MODE PLAN ; P1 = 0. 0. ; T1 = TABL ;
T1 . 'RIGIDITE_CONSTANTE' = MANU 'RIGI' P1 (MOTS 'UY') (PROG 1.) ;
T1 . 'MASSE_CONSTANTE' = MASS 'UY' 1. P1 ; T1 . 'N_HARMONIQUE' = 1 ;
T1 . 'AMORTISSEMENT_CONSTANT' = MANU 'RIGI' P1 (MOTS 'UY') (PROG 0.1) ;
T1 . 'RESULTATS' = TABL ; T1 . 'RESULTATS' . 1 = TABL ;
T1 . 'RESULTATS' . 1 . 'POINT_MESURE' = P1 ; T1 . 'RESULTATS' . 1 . 'COMPOSANTES' = MOT 'UY' ;
T1 . 'RESULTATS' . 1 . 'TITRE' = MOT 'u' ; T1 . 'RESULTATS' . 1 . 'COULEUR' = MOT 'ROUG' ;
"""
_DUFFING = """
OPTI DIME 2 ELEM SEG2 ; P1 = 0. 0. ; A1 = 0. 0. ; TM = TABL 'BASE_MODALE' ;
TM . 'MODES' = TABL 'BASE_DE_MODES' ; TM . 'MODES' . 1 = TABL 'MODE' ; T1 = TM . 'MODES' . 1 ;
T1 . 'POINT_REPERE' = A1 ; T1 . 'NUMERO_MODE' = 1 ; T1 . 'FREQUENCE' = 0.159154943 ;
T1 . 'MASSE_GENERALISEE' = 1. ;
T1 . 'DEFORMEE_MODALE' = MANU 'CHPO' P1 1 'UX' 1. 'NATURE' 'DIFFUS' ;
L1 = TABL 'LIAISON_ELEMENTAIRE' ; L1 . 'TYPE_LIAISON' = MOT 'COUPLAGE_DEPLACEMENT' ;
L1 . 'SUPPORT' = A1 ; L1 . 'ORIGINE' = A1 ; L1 . 'COEFFICIENT' = -0.25 ; L1 . 'EXPOSANT' = 3 ;
TL = TABL 'LIAISON' ; TL . 'LIAISON_A' = TABL 'LIAISON_A' ; TL . 'LIAISON_A' . 1 = L1 ;
TC = TABL 'CHARGEMENT' ; TC . 1 = MANU 'CHPO' A1 1 'FALF' 0.2 ; TC . 'BALOURD' = 0 ;
TA = TABL 'AMORTISSEMENT' ; TA . 'AMORTISSEMENT' = AMOR TM (PROG 5.) ;
TI = TABL 'INITIAL' ; TI . 'FREQUENCE' = 0.5 ; TI . 1 = MANU 'CHPO' A1 1 'ALFA' 0.1 ;
TN = TABL 'PARAMETRES_NUMERIQUES' ; TN . 'TYPE' = MOT 'FORC' ; TN . 'VAL_FIN' = 0.7 ;
TN . 'DS0' = 0.02 ; TN . 'DSMAX' = 0.1 ; TN . 'DSMIN' = 1.E-4 ; TN . 'NBPAS' = 30 ;
TN . 'ISENS' = 1. ; TN . 'ITERMOY' = 4 ; TN . 'ITERMAX' = 20 ; TN . 'TOLERANCE' = 1.E-8 ;
TN . 'ANGLE_MAX' = 60. ;
"""
_SQUARE = """
OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ; L1 = DROI 2 (0. 0.) (0. 1.) ; S1 = L1 TRAN 2 (1. 0.) ;
L2 = COTE 3 S1 ; M1 = MODE S1 'MECANIQUE' 'ELASTIQUE' ; T1 = TABL ; T1 . 'MODELE' = M1 ;
T1 . 'CARACTERISTIQUES' = MATE M1 'YOUN' 1.E4 'NU' 0.2 'RHO' 1. ;
D1 = BLOQ 'UX' L2 ; T1 . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' L1 ;
E1 = EVOL 'MANU' (PROG 0. 10.) (PROG 0. 1.) ; F1 = FORC 'FX' 1. L2 ;
T1 . 'CHARGEMENT' = CHAR 'MECA' F1 E1 ; T1 . 'TEMPS_CALCULES' = PROG 0. PAS 0.5 1. ;
"""
DECKS = {
    "DYNAMIC": Deck(
        """
OPTI DIME 2 ELEM SEG2 MODE PLAN ; P1 = 0. 0. ; T1 = TABL ;
T1 . 'RIGI' = (APPUI 'DEPL' 'UX' 4. P1) ET (BLOQ 'UY' P1) ; T1 . 'MASS' = MASS 'DEPL' 1. P1 ;
T1 . 'AMOR' = MANU 'RIGI' P1 (MOTS 'UX') (PROG 0.1) ; T1 . 'DEPL' = MANU 'CHPO' P1 1 'UX' 1. ;
T1 . 'VITE' = MANU 'CHPO' P1 1 'UX' 1. ; T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.01 0.2 ;
T1 . 'CHAR' = CHAR 'MECA' (FORC 'FX' 1. P1) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
T1 . 'PAS_SAUVES' = 2 ; T1 . 'MAILLAGE_SAUVE' = P1 ; T1 . 'PAS_SAUVES_CSV' = 5 ;
T1 . 'MAILLAGE_CSV' = P1 ; T1 . 'COMPOSANTES_CSV' = MOTS 'UX' ; T1 . 'FICHIER_CSV' = 'a.csv' ;
T1 . 'MAILLAGE_VTK' = MANU 'POI1' P1 ; T1 . 'PAS_SAUVES_VTK' = 10 ; T1 . 'FICHIER_VTK' = 'v' ;
T1 . 'BETA' = 0.25 ; T1 . 'GAMMA' = 0.5 ; T1 . 'CONTACT' = 'LAGRANGE' ; T1 . 'VITEUNIL' = VRAI ;
T1 . 'COEFFICIENT' = 10. ; T1 . 'CONTACT_PERSISTANT' = FAUX ; T1 . 'MASSE_MODIFIEE' = FAUX ;
T1 . 'PAS_ADAPTE' = FAUX ; T1 . 'NEWTON_COMPLET' = FAUX ; T1 . 'CHARMECA' = FAUX ;
T1 . 'ECON' = FAUX ; T1 . 'SAUV' = FAUX ;
""",
        "T2 = DYNAMIC T1 ;",
    ),
    "DYNAMIC with a joint": Deck(
        """
OPTI DIME 2 ELEM SEG2 MODE PLAN ; PA = 0. 0. ; PB = 1. 0. ; PC = 0. 0. ; PD = 1. 0. ;
L1 = MANU 'SEG2' PA PB ; L2 = MANU 'SEG2' PC PD ; J1 = RACC 1.E-3 L1 L2 ; T1 = TABL ;
MJ = MODE J1 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; T1 . 'MODELE' = MJ ;
T1 . 'CARACTERISTIQUES' = MATE MJ 'KN' 10. 'KS' 10. ;
T1 . 'RIGI' = BLOQ 'DEPL' L1 ; T1 . 'MASS' = MASS 'DEPL' 1. L2 ;
T1 . 'VITE' = MANU 'CHPO' L2 1 'UY' 1. ; T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.01 0.2 ;
T1 . 'RHO_INF' = 0.9 ; T1 . 'REDUCTION' = 1.E-6 ;
""",
        "T2 = DYNAMIC T1 ;",
    ),
    "DYNAMIC by INST": Deck(
        """
OPTI DIME 2 ELEM SEG2 MODE PLAN ; P1 = 0. 0. ; T1 = TABL ;
T1 . 'RIGI' = (APPUI 'DEPL' 'UX' 4. P1) ET (BLOQ 'UY' P1) ; T1 . 'MASS' = MASS 'DEPL' 1. P1 ;
T1 . 'VITE' = MANU 'CHPO' P1 1 'UX' 1. ; T1 . 'INST' = PROG 0.1 0.2 ; T1 . 'FREQ' = 25. ;
T1 . 'DEBU' = 0. ; T1 . 'ALPHA_F' = 0.1 ;
""",
        "T2 = DYNAMIC T1 ;",
    ),
    "PASAPAS": Deck(
        _SQUARE
        + """
T1 . 'TEMPS_SAUVES' = PROG 1. ;
T1 . 'GRANDS_DEPLACEMENTS' = FAUX ; T1 . 'DYNAMIQUE' = FAUX ; T1 . 'PROCEDURE_PERSO1' = FAUX ;
T1 . 'DEPLACEMENTS' = TABL ; T1 . 'DEPLACEMENTS' . 0 = 0. * (MANU 'CHPO' S1 2 'UX' 1. 'UY' 1.) ;
T1 . 'CONTRAINTES' = TABL ; T1 . 'CONTRAINTES' . 0 = ZERO M1 'CONTRAIN' ;
T1 . 'TEMPS' = TABL ; T1 . 'TEMPS' . 0 = 0. ; T1 . 'PRECISION' = 1.E-6 ; T1 . 'MAXITERATION' = 30 ;
T1 . 'TEMPS_SAUVEGARDES' = PROG 7. ; T1 . 'HYPOTHESE_DEFORMATIONS' = MOT 'LINEAIRE' ;
""",
        "PASAPAS T1 ;",
    ),
    "PASAPAS in time": Deck(
        _SQUARE
        + """
T1 . 'DYNAMIQUE' = VRAI ; T1 . 'VITESSES' = TABL ; T1 . 'MASSE_CONSTANTE' = MASS 'DEPL' 1. S1 ;
T1 . 'VITESSES' . 0 = 0. * (MANU 'CHPO' S1 2 'UX' 1. 'UY' 1.) ; T1 . 'RHO_INF' = 0.8 ;
T1 . 'AMORTISSEMENT' = 0.01 * (RIGI M1 (T1 . 'CARACTERISTIQUES')) ;
T1 . 'RIGIDITE_CONSTANTE' = 0.01 * (RIGI M1 (T1 . 'CARACTERISTIQUES')) ;
""",
        "PASAPAS T1 ;",
    ),
    "PASAPAS steered": Deck(
        _SQUARE
        + """
T1 . 'AUTOMATIQUE' = VRAI ; T1 . 'AUTOCRIT' = 1.E-2 ; T1 . 'AUTOPAS' = 20 ; T1 . 'AUTORESU' = 1 ;
""",
        "PASAPAS T1 ;",
    ),
    "PASAPAS piloted": Deck(
        _SQUARE
        + """
T1 . 'PILOTAGE_INDIRECT' = VRAI ; T1 . 'FORCES_PILOTEES' = F1 ;
T1 . 'PARAMETRE_DE_PILOTAGE' = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.E-3) ;
T1 . 'ZONE_DE_PILOTAGE' = S1 ;
""",
        "PASAPAS T1 ;",
    ),
    "PASAPAS over frequencies": Deck(
        _SQUARE
        + """
OPTI MODE FREQ ; T1 . 'TEMPS_CALCULES' = PROG 1. 2. 3. ;
T1 . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG 0. 10.) (PROG 1. 1.)) ;
T1 . 'MASSE_CONSTANTE' = MASS 'DEPL' 1. S1 ;
T1 . 'AMORTISSEMENT' = 0.01 * (RIGI M1 (T1 . 'CARACTERISTIQUES')) ;
T1 . 'RIGIDITE_CONSTANTE' = 0.01 * (RIGI M1 (T1 . 'CARACTERISTIQUES')) ;
""",
        "PASAPAS T1 ;",
    ),
    "HBM": Deck(_OSCILLATOR, "HBM T1 ;"),
    "CONTINU": Deck(
        _OSCILLATOR
        + """
HBM T1 ; T1 . 'CHARGEMENT' = CHAR 'MECA' (MANU 'CHPO' P1 1 'F2' 0.1 'NATURE' 'DISCRET')
  (EVOL 'MANU' (PROG 0. 10.) (PROG 1. 1.)) ;
T1 . 'TEMPS_CALCULES' = PROG 0.1 PAS 0.1 0.6 ; T1 . 'MAXI_DEPLACEMENT' = 1. ;
T1 . 'FREQUENCE' = EVOL 'MANU' (PROG 0. 10.) (PROG 0. 10.) ; T1 . 'N_PT_TFR' = 4 ;
T1 . 'WTABLE' = TABL ; T1 . 'WTABLE' . 'DS' = 0.5 ; T1 . 'WTABLE' . 'DSMIN' = 1.E-3 ;
T1 . 'WTABLE' . 'DSMAX' = 1. ; T1 . 'STABILITE' = MOTS 'DIAG' 'HILL' ; T1 . 'PRECISION' = 1.E-6 ;
T1 . 'MAXITERATION' = 24 ; T1 . 'NB_ITERATION' = 6 ; T1 . 'MAXIPAS' = 20 ; T1 . 'PAS_SAUVES' = 1 ;
T1 . 'PROCEDURE_CHARMECA' = FAUX ; T1 . 'PROCEDURE_FREQUENCE_TEMPS' = MOT 'AFT' ;
""",
        "CONTINU T1 ;",
    ),
    "CONTINU of loads": Deck(
        """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P1 = 0. 1. ; P2 = 10. 0. ; L1 = DROI 1 P1 P2 ;
M1 = MODE L1 'MECANIQUE' 'ELASTIQUE' BARR ; T1 = TABL ; T1 . 'MODELE' = M1 ;
T1 . 'CARACTERISTIQUES' = MATE M1 'YOUN' 1.E9 'NU' 0. 'SECT' 0.1 ;
T1 . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' P1) ET (BLOQ 'UX' 'UY' P2) ;
T1 . 'GRANDS_DEPLACEMENTS' = VRAI ; F1 = FORC (0. -1.E4) P1 ;
T1 . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG -9. 9.) (PROG -9. 9.)) ;
T1 . 'TEMPS_CALCULES' = PROG 0. PAS 0.5 3. ; T1 . 'MAXI_DEPLACEMENT' = 0.2 ; T1 . 'MAXIPAS' = 30 ;
T1 . 'RESULTATS' = TABL ; T1 . 'RESULTATS' . 1 = TABL ; T1 . 'STABILITE' = MOTS 'DIAG' ;
T1 . 'RESULTATS' . 1 . 'POINT_MESURE' = P1 ; T1 . 'RESULTATS' . 1 . 'COMPOSANTES' = MOT 'UY' ;
""",
        "CONTINU T1 ;",
    ),
    "DYNC": Deck(
        _DUFFING,
        "R = DYNC TM TC TL TA TI TN 2 32 ;",
        ("TM", "TC", "TL", "TA", "TI", "TN"),
    ),
    "SISSIB": Deck(
        """
OPTI DIME 3 ; P1 = 0. 0. 0. ; K1 = APPU 'UX' 400. P1 ; T1 = TABL 'DONNEE' ;
T1 . 'STRUCTURE' = VIBR 'SIMU' 1. 1 K1 (MASS 'UX' 4. P1) ; T1 . 'AMORTISSEMENT' = PROG 0.05 ;
E1 = TABL ; E1 . 'DIRECTION' = 'X' ; E1 . 'SPECTRE' = EVOL 'MANU' (PROG 0.1 50.) (PROG 2. 2.) ;
E1 . 'AMORTISSEMENT' = PROG 0.05 ; E1 . 'ACCELERATION_MAXIMALE' = 1. ;
T1 . 'EXCITATION' = TABL 'EXCITATION' ; T1 . 'EXCITATION' . 1 = E1 ; T1 . 'DUREE' = 10. ;
T1 . 'RECOMBINAISON_MODES' = 'ROSENBLUETH' ; T1 . 'RECOMBINAISON_DIRECTIONS' = 'QUADRATIQUE' ;
T1 . 'SORTIES' = TABL 'SORTIES' ; T1 . 'SORTIES' . 'DEPLACEMENTS' = VRAI ;
T1 . 'SORTIES' . 'ACCELERATIONS' = VRAI ; T1 . 'SORTIES' . 'DOMAINE' = MANU 'POI1' P1 ;
T1 . 'TRONCATURE' = FAUX ; T1 . 'IMPRESSION' = FAUX ;
""",
        "T2 = SISSIB T1 ;",
    ),
    "SPPLANC": Deck(
        """
T1 = TABL ; TS = TABL ; T1 . 'STRUC' = TS ; TS . 'NMODE' = 1 ; OPTI DIME 2 ELEM SEG2 ;
TS . 'FREQU' = TABL ; TS . 'FREQU' . 1 = 3. ; TS . 'AMORT' = TABL ; TS . 'AMORT' . 1 = 0.05 ;
TP = TABL ; T1 . 'PLANCH' = TP ; TP . 'COEFFPL' = TABL ; TP . 'COEFFPL' . 1 = 1.3 ;
TP . 'AMORTPL' = 0.02 ; TP . 'TYPSPPL' = 'ACCE' ; TP . 'LISFREQ' = PROG 1. 3. 10. ;
TE = TABL ; T1 . 'EXCIT' = TE ; TE . 'ENVE' = 'PLATLIN' ; TE . 'DUREE' = 12. ;
TE . 'TDEB' = 2. ; TE . 'TFIN' = 9. ;
TE . 'DSP' = EVOL 'MANU' 'FREQ' (PROG 0.2 25.) 'DSP' (PROG 0.02 0.02) ;
""",
        "T2 = SPPLANC T1 ;",
    ),
}


def paths(name: str, table: Table, depth: int = 0) -> list[str]:
    """The entries of a table as a script writes them, nested tables too."""
    found = []
    for index, value in table.items():
        if not isinstance(index, str | int) or str(index) == "SOUSTYPE":
            continue
        path = f"{name} . {index}" if isinstance(index, int) else f"{name} . '{str(index).strip()}'"
        found.append(path)
        if isinstance(value, Table) and depth < 3:
            found += paths(path, value, depth + 1)
    return found


def entries_of(deck: Deck, folder: Path) -> list[str]:
    """All entries of a deck's tables."""
    source = Source("setup", _full(deck.setup), folder / "setup.ssi")
    session = make_session(source, RunOptions(folder), io.StringIO())
    execute(session, source)
    found = [p for name in deck.tables for p in paths(name, session.root.find(name))]
    return list(dict.fromkeys(found))


def _full(setup: str) -> str:
    flat = "DIME 3" not in setup
    return setup + _SPARE.format(point="(7. 8.)" if flat else "(7. 8. 9.)")


def run(text: str, folder: Path) -> tuple[RunResult, float]:
    """Run a deck with an alarm."""
    options = RunOptions(folder / "out", limits=Limits(50, 100_000))
    began = time.perf_counter()
    signal.alarm(_SECONDS)
    try:
        source = Source("deck", text, folder / "deck.ssi")
        return run_source(source, options, io.StringIO(), io.StringIO()), (
            time.perf_counter() - began
        )
    finally:
        signal.alarm(0)


def spoiled(deck: Deck, path: str, value: str | None) -> str:
    """The deck's text with one entry spoiled, or taken away."""
    table, _, index = path.rpartition(" . ")
    change = f"OUBL ({table}) {index} ;" if value is None else f"{path} = {value} ;"
    if value is None and "." not in table:
        change = f"OUBL {table} {index} ;"
    return f"{_full(deck.setup)} {change}\n{deck.call}\n"


def judged(result: RunResult, path: str) -> tuple[str, str]:
    """Kind of the outcome, and the message."""
    if not result.errors:
        return "passed", ""
    error = result.errors[0]
    text = result.message.split("\n")[0]
    if error.code in ("internal", "interrupted"):
        return ("defect" if error.code == "internal" else "slow"), text
    index = path.rpartition(" . ")[2].strip("'")
    words = [p.strip("' ") for p in path.split(" . ")[1:]]
    named = any(w in result.message.split("-->")[0] for w in words if not w.isdigit())
    return ("named" if named else "nameless"), f"{text}  [{index}]"


def campaign(name: str, deck: Deck, everything: bool) -> Counter[str]:
    """All entries of one procedure."""
    outcomes: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        sound, _ = run(f"{_full(deck.setup)}\n{deck.call}\n", folder)
        if sound.errors:
            print(f"{name}: the sound deck fails: {sound.message}")
            return Counter(defect=1)
        for path in entries_of(deck, folder):
            for value in (None, *HOSTILE):
                result, seconds = run(spoiled(deck, path, value), folder)
                kind, text = judged(result, path)
                outcomes[kind] += 1
                if kind in ("defect", "slow", "nameless") or everything:
                    print(
                        f"{name} | {kind} | {path} = {value} | {text} | {seconds:.1f}", flush=True
                    )
    print(name, dict(outcomes), flush=True)
    return outcomes


def main() -> int:
    """Run the campaigns."""
    signal.signal(signal.SIGALRM, interrupt)
    warnings.simplefilter("ignore")
    everything = "--all" in sys.argv
    wanted = [a for a in sys.argv[1:] if a != "--all"] or list(DECKS)
    total: Counter[str] = Counter()
    for name, deck in DECKS.items():
        if any(name.startswith(w) for w in wanted):
            total += campaign(name, deck, everything)
    print(dict(total))
    return 1 if total["defect"] or total["slow"] else 0


if __name__ == "__main__":
    sys.exit(main())

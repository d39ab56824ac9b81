"""REPRISE: decks that are ended and gone on with leave what the undisturbed run leaves."""

import contextlib
from pathlib import Path

import numpy as np
import pytest
from script_runs import ran

import ssilang.operators.files.saving  # how tables are encoded
from ssilang.cli.run import RunOptions, run_text
from ssilang.io.archive import Encoder
from ssilang.operators.dynamics import checkpoints
from ssilang.operators.dynamics.checkpoints import KeptCalculation
from tests.operators.test_friction import BLOCK
from tests.operators.test_pasapas_stages import LAYERS, PLASTIC
from tests.references.rocking_deck import ROCKING

EVERY = "T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = 7 ; "

PLATE = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; T = TABL ;
L1 = DROI {n} (0. 0.) (1. 0.) ; S1 = L1 TRAN {n} (0. 1.) ; L2 = COTE 3 S1 ;
M = MODE S1 'MECANIQUE' %s ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. %s ;
T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; B = BLOQ 'DEPL' L1 ; F = FORC (1.2E8 -1.E8) L2 ;
E = EVOL 'MANU' (PROG 0. 1. 2. 3.) (PROG 0. 0.5 -0.5 0.6) ; T . 'CHARGEMENT' = CHAR 'MECA' F E ;
T . 'BLOCAGES_MECANIQUES' = B ; T . 'TEMPS_CALCULES' = PROG 0. PAS 0.1 3. ;
"""
STEEL = PLATE.replace("{n}", "3") % ("'ELASTIQUE' 'PLASTIQUE' 'PARFAIT'", "'SIGY' 2.E8")
ELASTIC = PLATE.replace("{n}", "3") % ("'ELASTIQUE'", "")
LARGE = PLATE.replace("{n}", "12") % ("'ELASTIQUE'", "")
FOOTING = """
OPTI DIME 3 ELEM SEG2 ; PS = 0. 0. -1. ; PC = 0. 0. 0. ; T = TABL ; N0 = 1.5E6 ;
M = MODE (MANU 'SEG2' PS PC) 'MECANIQUE' 'ELASTIQUE' 'MACRO_SEMELLE' 'JOI1' ;
A = MATE M 'KN' 4.E8 'KS' 2.E8 'LARG' 4. 'LONG' 6. 'COHE' 5.E4 'PDUR' 0.3 ;
T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'RIGI' = BLOQ 'DEPL' 'ROTA' PS ;
T . 'MASS' = (MASS 'DEPL' 1.5E5 PC) ET (MASS 'ROTA' 1.E6 PC) ;
C = EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.) ;
T . 'CHAR' = (CHAR 'MECA' (FORC (0. 0. (-1. * N0)) PC) C) ET
 (CHAR 'MECA' ((FORC (2.E5 -3.E5 0.) PC) ET (MOME 'MX' 9.E5 'MY' 1.5E6 'MZ' 2.E5 PC))
  (EVOL 'MANU' (PROG 0. 0.1 0.3 9.) (PROG 0. 1. -1. -1.))) ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 5.E-3 0.3 ; T . 'PAS_SAUVES' = 2 ;
"""
DECKS = {
    "a footing in space on ground that yields": FOOTING + EVERY + "T2 = DYNAMIC T ; "
    "V = T2 . 30 . 'VARIABLES_INTERNES' ; MESS (EXTR V 'TASS' 1 1 1) (EXTR V 'PART' 1 1 1) ;",
    "bodies that rock": ROCKING + EVERY + "T . 'RELATIONS_SAUVEES' = TABL ; "
    "T . 'RELATIONS_SAUVEES' . 'SOL' = BLO ; T2 = DYNAMIC T ;",
    "two calculations": ROCKING + EVERY + "T2 = DYNAMIC T ; T . 'VITE' = 2. * (T . 'VITE') ; "
    "T . 'FICHIER_VTK' = 'second' ; T . 'FICHIER_CSV' = 'second' ; T3 = DYNAMIC T ;",
    "a plastic plate in motion": STEEL + EVERY + "T . 'CHAR' = T . 'CHARGEMENT' ; "
    "T . 'RIGI' = (RIGI M A) ET B ; T . 'MASS' = MASS M A ; T . 'PAS_SAUVES' = 2 ; "
    "T . 'RELATIONS_SAUVEES' = TABL ; T . 'RELATIONS_SAUVEES' . 'BASE' = B ; "
    "T . 'TEMPS_CALCULES' = PROG 0. PAS 2.E-4 0.008 ; T2 = DYNAMIC T ;",
    "a plastic plate": STEEL + EVERY + "PASAPAS T ;",
    "a plastic plate, moving": STEEL + EVERY + "T . 'DYNAMIQUE' = VRAI ; "
    "T . 'TEMPS_CALCULES' = PROG 0. PAS 2.E-4 0.006 ; PASAPAS T ;",
    "a plate in large displacements": ELASTIC + EVERY
    + "T . 'GRANDS_DEPLACEMENTS' = VRAI ; PASAPAS T ;",
    "an elastic plate, saved by SAUV": ELASTIC + EVERY
    + "OPTI SAUV 'plate.sauv' ; T . 'TEMPS_SAUVEGARDES' = PROG 0.5 2. ; PASAPAS T ;",
    "an elastic plate, moving": ELASTIC + EVERY + "T . 'DYNAMIQUE' = VRAI ; "
    "PASAPAS T ;",
    "a large plate of which few points are kept": LARGE + EVERY + "P1 = L2 POIN 3 ; "
    "T . 'CHAR' = T . 'CHARGEMENT' ; T . 'RIGI' = (RIGI M A) ET B ; T . 'MASS' = MASS M A ; "
    "T . 'MAILLAGE_SAUVE' = P1 ; T . 'PAS_SAUVES' = 'TOUS' ; T . 'EXTREMES' = VRAI ; "
    "T . 'PAS_SAUVES_CSV' = 1 ; T . 'MAILLAGE_CSV' = L2 ; T2 = DYNAMIC T ;",
    "friction": BLOCK + "K = MODE (INVE C) CONTACT FROTTANT COULOMB A MESC ; "
    "D = BLOQ UX (COTE 2 S) ; T.MODELE = MS ET MZ ET K ; "
    "T.CARACTERISTIQUES = B ET (MATE K MU 0.3) ; T.BLOCAGES_MECANIQUES = BASE ET D ; "
    "T.TEMPS_CALCULES = PROG 0. PAS .1 4. ; "
    "T.CHARGEMENT = (CHAR MECA (PRES MASS MS 1.E5 (COTE 3 S)) "
    "(EVOL MANU (PROG 0. 1. 9.) (PROG 0. 1. 1.))) ET (CHAR DIMP (DEPI D 1.E-3) "
    "(EVOL MANU (PROG 0. 1. 2. 3. 4.) (PROG 0. 0. .01 1. 0.))) ; " + EVERY + "PASAPAS T ;",
    "layers": LAYERS.replace("{law}", PLASTIC) + "TM . 0 = M1 ; TM . 1 = M1 ET M2 ; "
    "T . 'CHARGEMENT' = (CHAR 'MECA' F1 E1) ET (CHAR 'MECA' F2 E2) ET (CHAR 'MODE' TT TM) ; "
    "T . 'TEMPS_CALCULES' = PROG 0.1 PAS 0.1 3. ; " + EVERY + "PASAPAS T ;",
}  # fmt: skip


class Killed(BaseException):
    """Nothing is written any more."""


def content(result, folder: Path):
    """All that a run leaves: its tables as codes and arrays, its files but the summary."""
    assert ssilang.operators.files.saving.save
    encoder, find = Encoder(), result.session.root.find
    tables = [n for n in ("T", "T2", "T3") if find(n) is not None]
    codes = [encoder.encode(find(n)) for n in tables]
    files = {
        p.relative_to(folder).as_posix(): p.read_bytes() if p.suffix != ".sauv" else b""
        for p in sorted(folder.rglob("*"))
        if p.is_file() and p.name != "summary.json"
    }
    return codes, encoder.objects, encoder.arrays, files


def assert_same(found, truth):
    assert found[:2] == truth[:2]
    assert len(found[2]) == len(truth[2])
    for a, b in zip(found[2], truth[2], strict=True):
        assert a.dtype == b.dtype
        assert np.array_equal(a, b, equal_nan=True)
    assert found[3].keys() == truth[3].keys()
    for name, data in truth[3].items():
        assert found[3][name] == data, name


@pytest.fixture
def ended(monkeypatch):
    """Function `(call, step, how)`: calculations of that number end so behind that step."""
    reached = KeptCalculation.reached

    def install(call, step, how):
        def end(self, done, state):
            if how is KeyboardInterrupt and self.number == call and done >= step:
                raise KeyboardInterrupt
            reached(self, done, state)
            if self.number == call and done >= step:
                raise how

        monkeypatch.setattr(KeptCalculation, "reached", end if how else reached)

    return install


@pytest.mark.parametrize("name", DECKS)
def test_decks_that_were_ended_go_on_to_the_same_results(name, tmp_path, ended):
    deck, rng = DECKS[name], np.random.default_rng(len(name))
    truth_folder = tmp_path / "truth"
    truth = ran(deck, truth_folder)
    whole = content(truth, truth_folder)
    calls = 2 if name in ("two calculations", "layers") else 1
    for how in (KeyboardInterrupt, Killed):
        folder = tmp_path / how.__name__
        ended(calls, int(rng.integers(7, 10)), how)
        with contextlib.suppress(Killed):
            assert run_text(deck, folder).exit_code == 1
        assert (folder / "checkpoints" / f"{calls}.state").is_file()
        ended(0, 0, None)
        again = ran(deck, options=RunOptions(folder, resume=True))
        codes = [w.code for w in again.session.warnings]
        assert codes.count("operators.dynamics.resumed") == 1
        assert codes.count("operators.dynamics.given") == calls - 1
        assert_same(content(again, folder), whole)


@pytest.mark.parametrize("elsewhere", [True, False])
def test_another_machine_goes_on_and_says_what_is_another(tmp_path, ended, monkeypatch, elsewhere):
    ended(1, 8, KeyboardInterrupt)
    assert run_text(DECKS["bodies that rock"], tmp_path).exit_code == 1
    ended(0, 0, None)
    if elsewhere:
        own = checkpoints.arithmetic()
        monkeypatch.setattr(checkpoints, "arithmetic", lambda: own | {"processor": "another"})
    # its rounding leaves other numbers in the matrices
    monkeypatch.setattr(checkpoints, "digest_of", lambda problem: "other")
    again = run_text(DECKS["bodies that rock"], options=RunOptions(tmp_path, resume=True))
    told = [w for w in again.session.warnings if w.code == "operators.dynamics.resumed-elsewhere"]
    assert again.exit_code == (0 if elsewhere else 1)
    assert ["processor=another" in str(w) for w in told] == [True] * elsewhere


def test_what_bits_depend_on_has_kernels_and_threads():
    found = checkpoints.arithmetic()
    assert found["processor"]
    assert found["threads"].isdigit()
    if next(Path(np.__file__).parent.parent.glob("numpy.libs/*openblas*"), None):
        assert found["BLAS of numpy"]
        assert int(found["threads"]) >= 1

"""Senseless operands and entries of tables end in a message in words, never in a defect."""

import importlib.util
import sys
from pathlib import Path

import pytest
from script_runs import session_after
from together import together

from ssilang.cli.run import execute, run_text
from ssilang.language.say.diagnostics import sentence
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source

OBJECTS = """
OPTI 'DIME' 3 'ELEM' 'CUB8' 'MODE' 'TRID' ; DENS 0.5 ;
A = 0. 0. 0. ; B = 1. 0. 0. ; E = 0. 1. 0. ; L1 = DROI 2 A B ; W1 = L1 TRAN 2 E ;
MO = MODE L1 'MECANIQUE' 'BARR' ; MA = MATE MO 'YOUN' 2. 'NU' 0. 'RHO' 1. 'SECT' 1. ;
R1 = RIGI MO MA ; U1 = MANU 'CHPO' L1 1 'UX' 2. ; MZ = VIDE 'MAILLAGE' ;
T1 = PROG 0. 'PAS' 0.1 1. ; EV = EVOL 'MANU' 'T' T1 'A' T1 ; P0 = PROG ; K1 = MOTS 'UX' 'UY' ;
"""


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_after(OBJECTS, tmp_path_factory.mktemp("hostile"))


@pytest.mark.parametrize(
    ("statement", "says"),
    [
        ("X = BRUI 'BLAN' 'POIS' 7 2 -1", "skip >= 0"),
        ("X = SPO EV 'AMOR' 0.05 'FREQ' P0 'DEPL'", "one frequency"),
        ("X = SIAR EV 1. 'ACCE' 'NPOI' -1", "n_instants > 0"),
        ("X = IPOL 0.5 T1 P0 'SPLI'", "as many"),
        ("X = LIGN 'TRAN' 3 B E 0.5", "no angle"),
        ("X = LIGN 'ROTA' 3 W1 A E 20.", "mesh"),
        ("X = RELA 'GLIS' A W1", "line"),
        ("X = LECT (T1 * 1.E30)", "64 bits"),
        ("X = LECT ((PROG 0.) / (PROG 0.))", "64 bits"),
        ("X = RAFF (PROG 0. 1. 1.E9) 0.5", "too long"),
        ("X = RAFF (PROG 0. 1.) 1000000000", "too long"),
        ("X = RAFF ((PROG 0.) / (PROG 0.)) 0.5", "finite"),
    ],
)
def test_senseless_operands_are_refused_in_words(session, statement, says):
    with pytest.raises(SsiError) as caught:
        execute(session, Source("statement", statement + " ;"))
    assert caught.value.code != "internal"
    assert says in sentence(caught.value, "en")[0]


def test_crossing_of_a_very_long_surface_ends(session):
    """Its triangles are flat to rounding: the walk around a hole may come back to itself."""
    surfaces = (
        "OPTI ELEM TRI3 ; LA = DROI 2 (0. 0. 0.) (1.E9 0. 0.) ; SA = LA TRAN 2 (0. 2. 0.) ; "
        "LB = DROI 2 (-1. 1.1 -1.) (3. 1.1 -1.) ; SB = LB TRAN 2 (0. 0. 2.) ; OPTI ELEM CUB8 ; "
    )
    with pytest.raises(SsiError) as caught:
        execute(session, Source("statement", surfaces + "C D L M = INTE 'GEOM' SA SB ;"))
    assert caught.value.code != "internal"


def test_sum_of_squares_joins_fields_of_one_kind(session):
    with pytest.raises(SsiError) as caught:
        execute(session, Source("statement", "X = XTX 2. U1 MA 3. ;"))
    assert caught.value.code == "excess" or caught.value.code == "wrong-argument"


def test_an_empty_mesh_has_no_connected_parts(session):
    for parts in ("CCON MZ", "CCON 'STR1' MZ", "PART 'CONN' 'NESC' MZ"):
        execute(session, Source("statement", f"X = DIME ({parts}) ;"))
        assert session.root.find("X") == 0


def test_no_free_motion_means_no_projected_solution(session):
    with pytest.raises(SsiError) as caught:
        execute(
            session,
            Source("statement", "X N M = RESO (MASS MO MA) (MANU 'CHPO' L1 1 'SCAL' 2.) 'ENSE' ;"),
        )
    assert caught.value.code != "internal"


_CAMPAIGN = Path(__file__).resolve().parents[2] / "benchmarks" / "fuzz_tables.py"


def _campaign():
    spec = importlib.util.spec_from_file_location("fuzz_tables", _CAMPAIGN)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # its dataclasses look for it there
    spec.loader.exec_module(module)
    return module


FUZZ = _campaign()


def refused(name: str, path: str, value: str | None, folder: Path) -> str:
    """The message about a table with one entry spoiled (None: taken away)."""
    result = run_text(FUZZ.spoiled(FUZZ.DECKS[name], path, value), folder)
    assert result.errors, f"{path} = {value} passed"
    assert result.errors[0].code != "internal", result.message
    return result.message.split("-->")[0]


@together("name", FUZZ.DECKS)
def test_the_sound_decks_run(name, tmp_path):
    deck = FUZZ.DECKS[name]
    result = run_text(f"{deck.setup}\n{deck.call}\n", tmp_path)
    assert not result.errors, result.message


@together(
    "name, path, value, says",
    [
        # decreasing, standing and missing times
        ("DYNAMIC", "T1 . 'TEMPS_CALCULES'", "(PROG 1. 0.5 0.)", ["0.5 follows 1"]),
        ("DYNAMIC", "T1 . 'TEMPS_CALCULES'", "(PROG 0. 0. 0.)", ["0 follows 0"]),
        ("DYNAMIC", "T1 . 'TEMPS_CALCULES'", "(PROG)", ["is empty"]),
        ("DYNAMIC by INST", "T1 . 'INST'", "(PROG 1. 0.5 0.)", ["increase"]),
        ("DYNAMIC by INST", "T1 . 'FREQ'", "1.E30", ["1e+30", "steps"]),
        ("PASAPAS", "T1 . 'TEMPS_CALCULES'", "(PROG 1. 0.5 0.1)", ["0.5 follows 1"]),
        ("CONTINU", "T1 . 'TEMPS_CALCULES'", "(PROG 1. 0.5 0.)", ["0.5 follows 1"]),
        # NaN in numbers, lists, fields, curves and loads
        ("DYNAMIC", "T1 . 'TEMPS_CALCULES'", "(ZN1 ET ZN1)", ["not finite"]),
        ("DYNAMIC", "T1 . 'DEPL'", "ZCN", ["not finite"]),
        ("DYNAMIC", "T1 . 'CHAR'", "(CHAR 'MECA' ZCN ZEV)", ["not finite"]),
        ("CONTINU", "T1 . 'NB_ITERATION'", "ZNAN", ["not finite"]),  # hung
        ("DYNC", "TN . 'ITERMOY'", "ZNAN", ["number"]),  # hung
        # empty objects
        ("CONTINU", "T1 . 'FREQUENCE'", "(VIDE 'EVOLUTIO')", ["is empty"]),
        ("SPPLANC", "T1 . 'EXCIT' . 'DSP'", "(VIDE 'EVOLUTIO')", ["is empty"]),
        ("CONTINU of loads", "T1 . 'MODELE'", "(VIDE 'MMODEL')", ["is empty"]),
        ("HBM", "T1 . 'RESULTATS' . 1 . 'COMPOSANTES'", "(MOTS)", ["names no component"]),
        ("CONTINU of loads", "T1 . 'CARACTERISTIQUES'", "ZCH", ["must be MCHAML"]),
        # out of range
        ("DYNAMIC", "T1 . 'PAS_SAUVES'", "0", ["PAS_SAUVES >= 1"]),
        ("DYNAMIC with a joint", "T1 . 'RHO_INF'", "-1.", ["0 <= RHO_INF <= 1"]),
        ("DYNAMIC with a joint", "T1 . 'REDUCTION'", "0.", ["is 0"]),
        ("CONTINU", "T1 . 'N_PT_TFR'", "1000000", ["N_PT_TFR <= 20"]),
        ("CONTINU", "T1 . 'PRECISION'", "-1.", ["is -1"]),
        ("DYNC", "TI . 'FREQUENCE'", "0.", ["FREQUENCE > 0"]),
        ("DYNC", "TM . 'MODES' . 1 . 'MASSE_GENERALISEE'", "0.", ["is 0", "> 0"]),
        ("SISSIB", "T1 . 'STRUCTURE' . 'MODES' . 1 . 'FREQUENCE'", "0.", ["FREQUENCE > 0"]),
        ("SPPLANC", "T1 . 'EXCIT' . 'DUREE'", "-1.", ["DUREE > 0"]),
        # other types, other meshes, nothing at all
        ("HBM", "T1 . 'RESULTATS' . 1 . 'COMPOSANTES'", "'ABC'", ["ABC", "no matrix has"]),
        ("DYNC", "TM . 'MODES' . 1 . 'FREQUENCE'", "'ABC'", ["FLOTTANT"]),
        ("DYNC", "TL . 'LIAISON_A'", "VRAI", ["must be TABLE"]),
        ("DYNC", "TL . 'LIAISON_A' . 1 . 'SUPPORT'", "ZP1", ["no mode"]),
        ("SPPLANC", "T1 . 'STRUC'", "VRAI", ["must be TABLE", "LOGIQUE"]),
        ("SPPLANC", "T1 . 'PLANCH' . 'AMORTPL'", None, ["missing"]),
        ("SISSIB", "T1 . 'EXCITATION' . 1 . 'SPECTRE'", "3", ["EVOLUTIO", "ENTIER"]),
        ("SISSIB", "T1 . 'SORTIES' . 'DEPLACEMENTS'", "3", ["LOGIQUE", "ENTIER"]),
        ("SISSIB", "T1 . 'DUREE'", None, ["needs"]),
    ],
)  # fmt: skip
def test_an_entry_that_cannot_be_used_is_named(name, path, value, says, tmp_path):
    message = refused(name, path, value, tmp_path)
    index = path.rpartition(" . ")[2].strip("'")
    for word in (index, *says):
        assert word in message, message


@together(
    "name, path, value",
    [
        ("DYNAMIC with a joint", "T1 . 'MODELE'", "(VIDE 'MMODEL')"),
        ("PASAPAS in time", "T1 . 'MODELE'", "(VIDE 'MMODEL')"),
        ("PASAPAS piloted", "T1 . 'ZONE_DE_PILOTAGE'", "(VIDE 'MAILLAGE')"),
        ("DYNC", "TL . 'LIAISON_A' . 1 . 'EXPOSANT'", "1.E-30"),
        ("CONTINU", "T1 . 'MASSE_CONSTANTE'", "(VIDE 'RIGIDITE')"),
        ("HBM", "T1 . 'BLOCAGES_MECANIQUES'", "ZRI"),
        ("HBM", "T1 . 'BLOCAGES_MECANIQUES'", "(BLOQ 'UX' P1)"),
    ],
)
def test_objects_without_content_end_in_words(name, path, value, tmp_path):
    result = run_text(FUZZ.spoiled(FUZZ.DECKS[name], path, value), tmp_path)
    assert all(e.code != "internal" for e in result.errors), result.message

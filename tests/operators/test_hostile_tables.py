"""Entries of tables that no calculation can use are refused by name, in words."""

import importlib.util
import sys
from pathlib import Path

from together import together

from ssilang.cli.run import run_text

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

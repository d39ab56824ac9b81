"""Scripts that are well typed and make no sense: each is told, by its code."""

from pathlib import Path

import pytest

from ssilang.cli.run import run_text

PEER = "DATABASE\nSomewhere\n{0} TIME SERIES IN UNITS OF M/S\nNPTS= {1}, DT= .01 SEC\n1 2 3 4 5 6\n"
AVS = "4 1 0 0 0\n1 0. 0. 0.\n2 1. 0. 0.\n3 1. 1. 0.\n4 0. 1. 0.\n1 1 quad 1 2 3 4\n"
ABAQUS = "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n*ELEMENT, TYPE=CPE3\n1, 1, 2, 3\n"
NASTRAN = "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCROD,1,1,1,2\nENDDATA\n"
RECORD = "E = LIRE 'PEER' 'a.txt' 1. ; "
READ = {"a.txt": PEER.format("ACCELERATION", 6)}

FILES = {
    "velocities in a spectrum": (
        RECORD + "S = SPO E 'AMOR' 0.05 'FREQ' (PROG 1.) 'ACCE' ;",
        {"a.txt": PEER.format("VELOCITY", 6)}, "operators.curves.no-accelerations",
    ),
    "displacements integrated": (
        RECORD + "D V = INSI E ;", {"a.txt": PEER.format("DISPLACEMENT", 6)},
        "operators.curves.no-accelerations",
    ),
    "velocities corrected, by the file's ending": (
        "E = LIRE 'PEER' 'a.VT2' 1. ; C = COSI E ;", {"a.VT2": PEER.format("SOME", 6)},
        "operators.curves.no-accelerations",
    ),
    "velocities of ESM, their type with a word more": (
        "E = LIRE 'ESM' 'a.asc' 1. ; D V = INSI E ;",
        {"a.asc": "SAMPLING_INTERVAL_S: 0.1\nDATA_TYPE: VELOCITY SERIES\nUNITS: m/s\n1.\n2.\n"},
        "operators.curves.no-accelerations",
    ),
    "velocities of a table": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ; O = OSCI E 'AMOR' 0.05 'FREQ' 1. ;",
        {"a.csv": "time (s);ground velocity (m/s)\n0;0\n1;1\n2;0\n"},
        "operators.curves.no-accelerations",
    ),
    "velocities in figures of a record": (
        RECORD + "T = @SEISME E ;", {"a.txt": PEER.format("VELOCITY", 6)},
        "operators.curves.no-accelerations",
    ),
    "fewer values said than there are": (
        RECORD, {"a.txt": PEER.format("ACCELERATION", 4)}, "operators.files.record-longer",
    ),
    "no value said": (RECORD, {"a.txt": PEER.format("ACCELERATION", 0)}, "io.record-empty"),
    "more values said than there are": (
        RECORD, {"a.txt": PEER.format("ACCELERATION", 8)}, "io.line-says-values-file",
    ),
    "no value in ESM": (
        "E = LIRE 'ESM' 'a.asc' 1. ;", {"a.asc": "SAMPLING_INTERVAL_S: 0.1\nNDATA: 0\n"},
        "io.record-empty",
    ),
    "an Abaqus deck cut inside its nodes": (
        "T = LIRE 'ABAQ' 'm.inp' ;", {"m.inp": ABAQUS[:30]}, "operators.files.mesh-without-cells",
    ),
    "an Abaqus deck by its ending": (
        "T = LIRE 'm.inp' ;", {"m.inp": ABAQUS[:30]}, "operators.files.mesh-without-cells",
    ),
    "bulk data without elements": (
        "T = LIRE 'NAS' 'm.bdf' ;", {"m.bdf": NASTRAN.replace("CROD,1,1,1,2\n", "")},
        "operators.files.mesh-without-cells",
    ),
    "bulk data cut inside their nodes": (
        "T = LIRE 'NAS' 'm.bdf' ;", {"m.bdf": NASTRAN[:40]}, "io.mesh-file-cut",
    ),
    "an AVS file cut inside its nodes": (
        "OPTI LECT 'm.avs' ; T = LIRE 'AVS' ;", {"m.avs": AVS[:40]}, "io.avs-file-cut",
    ),
    "an AVS file cut inside its cells": (
        "OPTI LECT 'm.avs' ; T = LIRE 'AVS' ;", {"m.avs": AVS[:-18]}, "io.avs-file-cut",
    ),
    "an AVS file that says no cell": (
        "OPTI LECT 'm.avs' ; T = LIRE 'AVS' ;", {"m.avs": AVS.replace("4 1", "4 0", 1)[:-17]},
        "operators.files.mesh-without-cells",
    ),
}  # fmt: skip
"""Files that do not hold what they are read as."""

SENSIBLE_FILES = {
    "a record": (RECORD + "T = SPO E 'AMOR' 0.05 'FREQ' (PROG 1.) 'ACCE' ; D V = INSI E ;", READ),
    "what is called velocities and is not": (
        RECORD + "A = EVOL 'MANU' 'TEMP' (EXTR E 'ABSC') 'ACCE' (EXTR E 'ORDO') ; "
        "S = SPO A 'AMOR' 0.05 'FREQ' (PROG 1.) 'ACCE' ;",
        {"a.txt": PEER.format("VELOCITY", 6)},
    ),
    "meshes": (
        "T = LIRE 'm.inp' ; T = LIRE 'm.bdf' ; OPTI LECT 'm.avs' ; T = LIRE 'AVS' ;",
        {"m.inp": ABAQUS, "m.bdf": NASTRAN, "m.avs": AVS},
    ),
}


def told(script: str, folder: Path) -> list[str]:
    """Codes of the warnings and errors of a script in the plane."""
    result = run_text(f"OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; {script}", output_directory=folder)
    assert "defect of ssilang" not in result.message
    return [w.code for w in result.session.warnings] + [e.code for e in result.errors]


def written(files: dict[str, str], folder: Path) -> Path:
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder


@pytest.mark.parametrize("what", FILES)
def test_files_that_hold_something_else_are_told(what: str, tmp_path: Path) -> None:
    script, files, code = FILES[what]
    assert code in told(script, written(files, tmp_path))


@pytest.mark.parametrize("what", SENSIBLE_FILES)
def test_files_that_hold_what_they_say_are_not(what: str, tmp_path: Path) -> None:
    script, files = SENSIBLE_FILES[what]
    assert told(script, written(files, tmp_path)) == []

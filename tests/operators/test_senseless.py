"""Scripts that are well typed and make no sense: each is told, by its code."""

import math
import tomllib
from pathlib import Path

import pytest
from together import together

from ssilang.cli.run import run_text

PEER = "DATABASE\nSomewhere\n{0} TIME SERIES IN UNITS OF M/S\nNPTS= {1}, DT= .01 SEC\n1 2 3 4 5 6\n"
AVS = "4 1 0 0 0\n1 0. 0. 0.\n2 1. 0. 0.\n3 1. 1. 0.\n4 0. 1. 0.\n1 1 quad 1 2 3 4\n"
ABAQUS = "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n*ELEMENT, TYPE=CPE3\n1, 1, 2, 3\n"
NASTRAN = "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCROD,1,1,1,2\nENDDATA\n"
STL = "solid s\n" + 2 * "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 {0}\n" + "endsolid\n"
RECORD = "E = LIRE 'PEER' 'a.txt' 1. ; "
READ = {"a.txt": PEER.format("ACCELERATION", 6)}

TWICE = {
    "m.inp": ABAQUS.replace("3, 0., 1.", "2, 5., 5.\n3, 0., 1."),
    "c.inp": ABAQUS + "1, 2, 3, 1\n",
    "m.bdf": NASTRAN.replace("CROD", "GRID,2,,7.,0.,0.\nCROD"),
    "m.avs": AVS.replace("3 1. 1.", "2 1. 1."),
    **{
        f"m{again}.msh": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n"
        f"{again} 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 2\n$EndElements\n"
        for again in (1, 2)
    },
}


def cut(first: float) -> str:
    """A table of a record, its first value this part of the largest."""
    values = [first, *(math.sin(0.3 * i) * math.exp(-(((i - 60) / 30) ** 2)) for i in range(120))]
    rows = (f"{0.01 * i:.2f};{value / max(values):.6f}\n" for i, value in enumerate(values))
    return "time (s);acceleration (m/s2)\n" + "".join(rows)


def marked(mark: float, times: int) -> str:
    """A table of a record in which so many values are a mark."""
    rows = cut(0.1).splitlines()
    for row in range(40, 40 + 20 * times, 20):
        rows[row] = f"{rows[row].split(';')[0]};{mark}"
    return "\n".join(rows) + "\n"


FILES = {
    "a record with the mark of a missing value": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ;", {"a.csv": marked(-9.99, 1)},
        "operators.files.record-marked",
    ),
    "a record of ESM with three marks of missing values": (
        "E = LIRE 'ESM' 'a.asc' ;",
        {"a.asc": "SAMPLING_INTERVAL_S: 0.01\nDATA_TYPE: ACCELERATION\nUNITS: cm/s^2\n"
                  + "".join(f"{999.0 if i in (70, 90, 95) else 2.0 * math.sin(0.4 * i)}\n"
                            for i in range(300))},
        "operators.files.record-marked",
    ),
    **{
        f"a number borne twice, {name}": (
            f"OPTI LECT '{name}' ; T = LIRE 'AVS' ;" if "avs" in name else f"T = LIRE '{name}' ;",
            {name: text}, "io.mesh-number-twice",
        )
        for name, text in TWICE.items()
    },
    "steps of seconds": (
        RECORD, {"a.txt": PEER.format("ACCELERATION", 6).replace(".01", "1.")},
        "operators.files.record-slow",
    ),
    "a record with a part missing": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ;",
        {"a.csv": "time (s);acceleration (m/s2)\n0;0\n0.01;1\n0.02;2\n5.;0\n"},
        "operators.files.record-gap",
    ),
    "an earthquake of tens of g": (
        RECORD,
        {"a.txt": PEER.format("ACCELERATION", 6).replace("M/S", "G").replace("5 6", "5 60")},
        "operators.files.record-strong",
    ),
    "a record cut before its peak": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ;", {"a.csv": cut(0.4)}, "operators.files.record-begun",
    ),
    "a record of ESM cut behind its peak": (
        "E = LIRE 'ESM' 'a.asc' ;",
        {"a.asc": "SAMPLING_INTERVAL_S: 0.01\nDATA_TYPE: ACCELERATION\nUNITS: m/s^2\n"
                  + "".join(f"{(0.9**i) * (-1) ** i}\n" for i in range(60))},
        "operators.files.record-begun",
    ),
    "g by the factor of cm/s2": (
        RECORD.replace("1.", "0.01"),
        {"a.txt": PEER.format("ACCELERATION", 6).replace("M/S", "G")},
        "operators.files.record-other-factor",
    ),
    "cm/s2 by the factor of g": (
        "E = LIRE 'PEER' 'a.txt' 9.81 ; ",
        {"a.txt": PEER.format("ACCELERATION", 6).replace("M/S", "CM/S2")},
        "operators.files.record-other-factor",
    ),
    "values of a record at twice its step": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ; F = EVOL 'MANU' (PROG 0. PAS 0.02 2.4) (EXTR E 'ORDO') ;",
        {"a.csv": cut(0.1)}, "operators.curves.record-at-other-step",
    ),
    "values of a record, scaled, at a step of others": (
        "E = LIRE 'SIGNAL' 'a.csv' 9.81 ; L = -0.3 * (EXTR E 'ORDO') ; "
        "F = EVOL 'MANU' 'TEMP' (PROG 0. PAS 0.005 NPAS 120) 'ACCE' L ;",
        {"a.csv": cut(0.1)}, "operators.curves.record-at-other-step",
    ),
    "values of the first of two columns at another step": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ; L = EXTR (EXTR E 'COUR' 1) 'ORDO' ; "
        "F = EVOL 'MANU' (PROG 0. PAS 0.02 NPAS 120) L ;",
        {"a.csv": "t (s);ax (m/s2);ay (m/s2)\n"
                  + "".join(f"{i / 100};{i % 7 - 3};{i % 5 - 2}\n" for i in range(121))},
        "operators.curves.record-at-other-step",
    ),
    "a record in m/s2 times g": (
        "E = 9.81 * (LIRE 'PEER' 'a.txt' 'SI') ;", READ, "operators.curves.gravity-again",
    ),
    "a constant added to a record": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ; T = @SEISME (EVOL 'MANU' 'TEMP' (EXTR E 'ABSC') 'ACCE' "
        "(0.5 + (EXTR E 'ORDO'))) ;", {"a.csv": cut(0.1)}, "stdlib.seisme-drifts",
    ),
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
    "a cell twice in a deck": (
        "T = LIRE 'm.inp' ;", {"m.inp": ABAQUS + "2, 1, 2, 3\n"}, "operators.files.cells-repeated",
    ),
    "a cell twice in an AVS file": (
        "OPTI LECT 'm.avs' ; T = LIRE 'AVS' ;",
        {"m.avs": AVS.replace("4 1", "4 2", 1) + "2 1 quad 2 3 4 1\n"},
        "operators.files.cells-repeated",
    ),
    "a flat surface for the skin of a body": (
        "OPTI DIME 3 ; S = LIRE 'STL' 'm.stl' ;", {"m.stl": STL.format(0)},
        "operators.files.surface-flat",
    ),
    "a surface without a triangle, binary": (
        "OPTI DIME 3 ; S = LIRE 'STL' 'm.stl' ;", {"m.stl": 80 * "x" + 4 * "\0"},
        "io.holds-no-triangles",
    ),
    "a surface whose corner is nowhere": (
        "OPTI DIME 3 ; S = LIRE 'STL' 'm.stl' ;", {"m.stl": STL.format("nan")},
        "io.no-readable-stl-file",
    ),
    "a set of more numbers than there is memory": (
        "T = LIRE 'm.inp' ;",
        {"m.inp": ABAQUS + "*NSET, NSET=A, GENERATE\n1, 1000000000000, 1\n"},
        "io.no-readable-mesh-file",
    ),
    "a flat surface as a table": (
        "OPTI DIME 3 ; S = LIRE 'm.stl' ;", {"m.stl": STL.format(0)},
        "operators.files.surface-flat",
    ),
    "an AVS file that says no cell": (
        "OPTI LECT 'm.avs' ; T = LIRE 'AVS' ;", {"m.avs": AVS.replace("4 1", "4 0", 1)[:-17]},
        "operators.files.mesh-without-cells",
    ),
}  # fmt: skip
"""Files that do not hold what they are read as."""

SENSIBLE_FILES = {
    "a record with a peak of twice all others, a pulse and nothing else": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ; E = LIRE 'SIGNAL' 'b.csv' 1. ;",
        {
            "a.csv": marked(2.0, 1),
            "b.csv": "time (s);acceleration (m/s2)\n"
            + "".join(f"{0.01 * i:.2f};{float(i == 30)}\n" for i in range(80)),
        },
    ),
    "values of a record at its own step, later, in milliseconds, over their numbers, corrected": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ; Y = EXTR E 'ORDO' ; F = EVOL 'MANU' (EXTR E 'ABSC') Y ; "
        "F = EVOL 'MANU' (PROG 5. PAS 0.01 NPAS 120) (2. * Y) ; F = EVOL 'MANU' (PROG 0. PAS 10. "
        "1200.) Y ; F = EVOL 'MANU' (PROG 1. PAS 1. 121.) Y ; F = EVOL 'MANU' (PROG 0. PAS 0.02 "
        "2.4) (Y + 0.1) ;",
        {"a.csv": cut(0.1)},
    ),
    "a record that begins at a fifth of its peak": (
        "E = LIRE 'SIGNAL' 'a.csv' 1. ;",
        {"a.csv": cut(0.2)},
    ),
    "a record of a peak of 1 m/s2, scaled to g": (
        "E = 9.81 * (LIRE 'PEER' 'a.txt' 'SI') ;",
        {"a.txt": READ["a.txt"].replace("2 3 4 5 6", "-1 1 -1 1 0")},
    ),
    "surfaces": (
        "S = LIRE 'STL' 'm.stl' ; OPTI DIME 3 ; S = LIRE 'STL' 'n.stl' ;",
        {"m.stl": STL.format(0), "n.stl": STL.replace("0 1", "0 2", 1).format(1)},
    ),
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


PERIOD = math.pi / 10.0  # of the oscillator: 20 rad/s
DATA: dict[str, dict[str, object]] = {
    "steps of seconds": {"value": 1.0, "most": 0.2},
    "a record with a part missing": {"value": 4.98, "most": 0.01},
    "an earthquake of tens of g": {"value": 60.0 * 9.81, "most": 50.0},
    "fewer values said than there are": {"count": 4, "left_out": 2},
    "steps longer than a period": {"dt": 0.5, "period": PERIOD, "wanted": PERIOD / 20.0},
    "lead bearings beside the damping of the fixed base": {
        "frequency": math.sqrt(2.5e6 / (8 * 2500.0 + 3e5)) / (2 * math.pi)
    },
    "pendulums beside the damping of the fixed base": {
        "frequency": math.sqrt(9.81 / 2.0) / (2 * math.pi)
    },
    "cells longer than waves": {"node": "1 (0. 0.)", "length": 20.0, "speed": 50.0, "usual": 8},
    "long cells of soft clay on rock": {"length": 2.0, "speed": math.sqrt(4e6 / 2.6 / 1500.0)},
    "one layer that bends": {"count": 6, "slender": 10.0 / 3.0, "across": 0, "along": 1},
    "joints of the mesh that a raft had before": {"count": 5 * 7 + 4 * 9 - 2 * 20},
    "a line under a block with thirds of its divisions": {"count": 4, "node": "3 (0.5 0.)"},
    "a block in ground that was left": {"count": 5, "node": "1 (0. 0.)"},
    "springs of the ground on a node that is held": {"count": 3, "node": "2 (0. -1.)"},
    "a support below zero": {"count": 3, "value": 0.5e7 - 1e9},
    "a displacement of a hundred models": {"way": 150.0, "size": 1.0, "times": 150.0},
    "a footing drawn above its ground": {"gap": 0.05},
    "a footing in millimetres": {"width": 4000.0, "size": 11.0},
    "a verdict by parameters of others": {"share": 100.0},
    "a surface twisted": {"count": 4, "of": 12},
    "a moment beside a body on stops, held aside": {"off": 3e6 / 9.81e5 - 2.0, "width": 4.0},
    "a weight beside its macro-element": {"off": 6.5e5 / (25000.0 * 9.81) - 2.0, "width": 4.0},
    "a weight beside its round macro-element": {"off": 6e5 / (22500.0 * 9.81) - 2.0},
    "a weight beside its joints": {"off": 7e5 / (29500.0 * 9.81) - 2.0, "width": 4.0},
    "sides that absorb the waves of softer ground": {"times": 0.3846**0.5, "base": False},
    "dashpots at the base of softer ground than it bears": {"times": 0.3**0.5, "base": True},
    "a rotary inertia from left to right": {"way": (4.8e9 / 6e4) ** 0.5, "inertia": 4.8e9},
    "bounds beside the curve": {"high": math.sin(math.radians(86.4)), "word": "YBOR"},
    "a footing that leans": {"angle": math.degrees(math.atan(0.5))},
    "waves slower along the base than in the ground": {
        "speed": 10.0, "shear": math.sqrt(1e8 / 2.6 / 2000.0)
    },
    "a strength in MPa": {"share": 1e5 / 1e-4 / 1700.0, "strength": 1700.0},
    "a part of a weight on the ground below the joints": {
        "part": 100.0 * 1e5 / (29500.0 * 9.81 + 1e5)
    },
    "a box whose matrix has the moduli of before": {"off": 100.0 / 9.0},
    "ground in t/m3 below joints, its modulus in Pa": {
        "density": 1.9, "speed": math.sqrt(2e8 / 2.6 / 1.9), "wanted": 1900.0
    },
    "a storey's mass by MASS 'ROTA'": {
        "way": math.sqrt(2e4 / 600.0), "inertia": 2e4, "mass": 600.0, "size": 3.0
    },
    "a floor of twenty tonnes beside newtons": {
        "period": 2.0 * math.pi * math.sqrt(20.0 * 27.0 / (3.0 * 3e10 * 2e-3))
    },
    "an angle made of PI": {"value": math.pi / 6.0, "degrees": 30.0},
    "a strip that rested on softer joints than it rocks on": {"part": 200.0 / 3.0},
    "a record scaled twice": {"value": 38.0, "times": 38.0 / 9.81, "wanted": 9.81},
    "two steps a period": {"dt": 0.14, "period": PERIOD, "wanted": PERIOD / 20.0},
}  # fmt: skip
"""What is told of some of them beside their rows, reckoned by hand."""


FILES["g for m/s2 in a motion"] = (
    "{oscillator} " + RECORD + "F = CHAR (M * (MANU 'CHPO' P 'UX' -1.)) E ; {table} DYNAMIC T ;",
    {"a.txt": PEER.format("ACCELERATION", 6).replace("M/S", "G").replace(".01", ".2")},
    "operators.dynamics.shaken-in-g",
)


TABLES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
SETUPS, SENSIBLE, SENSELESS = TABLES["setups"], TABLES["sensible"], TABLES["told"]


def written_out(script: str) -> str:
    """The script in the plane, its words in braces replaced."""
    while "{" in script:
        script = script.format(**SETUPS)
    return f"OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; {script}"


def told(script: str, folder: Path, what: str = "", **known: object) -> list[str]:
    """Codes of the warnings and errors of a script in the plane; their data are looked at."""
    known |= DATA.get(what, {})
    result = run_text(written_out(script), output_directory=folder)
    assert "defect of ssilang" not in result.message
    found = [*result.session.warnings, *result.errors]
    if known:
        ((_, data),) = {w.code: w.data for w in found if known.keys() <= w.data.keys()}.items()
        wanted = {k: pytest.approx(v) if isinstance(v, float) else v for k, v in known.items()}
        assert {k: data[k] for k in known} == wanted
    return [w.code for w in found]


def written(files: dict[str, str], folder: Path) -> Path:
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder


@together("what", FILES)
def test_files_that_hold_something_else_are_told(what, tmp_path):
    script, files, code = FILES[what]
    assert code in told(script, written(files, tmp_path), what)


@together("what", SENSIBLE_FILES)
def test_files_that_hold_what_they_say_are_not(what, tmp_path):
    script, files = SENSIBLE_FILES[what]
    assert told(script, written(files, tmp_path)) == []


@pytest.mark.usefixtures("unsaved")
@together("what", SENSELESS)
def test_models_and_scripts_that_make_no_sense_are_told(what, tmp_path):
    code, script, *known = SENSELESS[what]
    assert code in told(script, tmp_path, what, **(known[0] if known else {}))


@pytest.mark.usefixtures("unsaved")
@together("what", SENSIBLE)
def test_what_is_near_to_them_is_not(what, tmp_path):
    codes = set(told(SENSIBLE[what], tmp_path))
    assert codes <= {"operators.dynamics.contact-not-resolved"}


@pytest.mark.parametrize(("speed", "step", "seen"), [
    (0.05, 4e-3, False), (1.5, 4e-3, True), (1.5, 2.5e-4, False), (0.05, 1e-2, False),
])  # fmt: skip
def test_a_step_too_long_for_contact_is_told_where_energies_show_it(speed, step, seen, tmp_path):
    script = (
        "{half} LJ = L ; PUSH = 0. ; {borne_by} T . 'CHAR' = CHAR 'MECA' W ; "
        f"T . 'VITE' = MANU 'CHPO' B 1 'UX' {speed} ; T . 'AMOR' = 0. * M ; "
        f"T . 'TEMPS_CALCULES' = PROG 0. PAS {step} 0.6 ; DYNAMIC T ;"
    )
    found = told(script, tmp_path)
    assert ("operators.dynamics.contact-not-resolved" in found) == seen


def test_one_layer_of_linear_cells_bends_too_stiff_by_what_is_told(tmp_path):
    script = (
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; B = DROI 1 (0 0) (0.3 0.) ; S = TRAN 6 B (0 6) ; "
        "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE MO 'YOUN' 3.E10 'NU' 0. ; T = COTE 3 S ; "
        "G = (RIGI MO A) ET (BLOQ 'DEPL' (B POIN 1)) ET (BLOQ 'UY' B) ; "
        "U = RESO G ((FORC (0. 1.) (T POIN 1)) ET (FORC (0. -1.) (T POIN 2))) ; "
        "X = ABS (EXTR U 'UX' (T POIN 1)) ;"
    )
    session = run_text(script, output_directory=tmp_path).session
    (layer,) = [w for w in session.warnings if w.code == "operators.matrices.layer-bends"]
    bent = 0.3 * 6.0**2 / (2.0 * 3.0e10 * 0.3**3 / 12.0)  # M l^2 / 2 E I
    assert bent / session.root.find("X") == pytest.approx(layer.data["stiffer"], rel=1e-3)


@together(
    "script, codes",
    [
        (  # what RESO has told, DYNAMIC does not tell again
            "{beam} K = K ET (BLOQ 'UY' (P ET Q)) ET (RELA 1. 'UX' P + 1. 'UX' Q) ; "
            "U = RESO K G ; T = TABL ; T . 'RIGI' = K ET (APPU 'RZ' 1.E3 P) ; T . 'MASS' = M ; "
            "T . 'CHAR' = CHAR 'MECA' G ; T . 'DEPL' = U ; T . 'TEMPS_CALCULES' = PROG 0. 0.001 ; "
            "DYNAMIC T ;",
            ["operators.matrices.relation-sign"],
        ),
        (  # its lower node is the footing's
            "{mast} J = MANU 'SEG2' P Q ; "
            "MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'MACRO_SEMELLE' 'JOI1' ; "
            "T . 'MODELE' = MO ET MJ ; AJ = MATE MJ 'KN' 8.E7 'KS' 1.E8 'LARG' 4. ; "
            "T . 'CARACTERISTIQUES' = A ET AJ ; T . 'CHAR' = CHAR 'MECA' G ; DYNAMIC T ;",
            ["operators.matrices.footing-turned"],
        ),
    ],
)
def test_one_mistake_is_told_once(script, codes, tmp_path):
    assert told(script, tmp_path) == codes


def test_a_motion_that_its_scheme_takes_leaves_all_of_its_energy_out_of_balance(tmp_path):
    script = written_out(
        "{oscillator} {table} T . 'CHAR' = CHAR (FORC (0. 0.) P) EV ; T . 'DEPL' = "
        "MANU 'CHPO' P 1 'UX' 1. ; T . 'TEMPS_CALCULES' = PROG 0. PAS 0.05 9. ; "
        "T . 'RHO_INF' = 0. ; DYNAMIC T ;"
    )
    session = run_text(script, output_directory=tmp_path).session
    (calculation,) = session.statistics["calculations"]
    assert calculation["energy_imbalance"] == pytest.approx(1.0, rel=1e-3)
    (cause,) = calculation["energy_imbalance_from"]
    assert "scheme" in cause


def test_free_motions_have_no_frequency(tmp_path):
    script = written_out("{moved} T = VIBR 'SIMU' 0.1 4 K M ;")
    modes = run_text(script, output_directory=tmp_path).session.root.find("T").get("MODES")
    found = [modes.get(i).get("FREQUENCE") for i in range(1, 5)]
    assert found[:3] == [0.0, 0.0, 0.0]
    assert found[3] > 1.0

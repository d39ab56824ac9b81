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
    "m.msh": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n2 0 1 0\n"
    "$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 2\n$EndElements\n",
}
FILES = {
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


TIMES = "LT = PROG 0. PAS 0.01 1. ; EV = EVOL 'MANU' LT (SIN (LT * 1000.)) ; "
TABLE = "T = TABL ; T . 'RIGI' = K ; T . 'MASS' = M ; T . 'CHAR' = F ; T . 'TEMPS_CALCULES' = LT ; "
OSCILLATOR = (
    TIMES + "P = 0. 0. ; K = RIGI 'UX' 400. P ; M = MASS 'UX' 1. P ; "
    "F = CHAR (FORC (1. 0.) P) EV ; {0} " + TABLE + "{1} DYNAMIC T ;"
)
SQUARE = (
    TIMES + "S = TRAN 2 (DROI 2 (0 0) (1 0)) (0 1) ; B = COTE 1 S ; H = COTE 3 S ; "
    "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE MO 'YOUN' 1.E7 'NU' 0. 'RHO' 2000. ; "
    "K = RIGI MO A ; M = MASS MO A ; F = CHAR (FORC (1. 0.) H) EV ; "
)
BODY = SQUARE + "{0} " + TABLE + "{1} DYNAMIC T ;"
TWO = (
    SQUARE + "Q = TRAN 2 (DROI 2 (1 0) (2 0)) (0 1) ; B = B ET (COTE 1 Q) ; "
    "N = MODE Q 'MECANIQUE' 'ELASTIQUE' ; A = MATE N 'YOUN' 1.E7 'NU' 0. 'RHO' 2000. ; "
    "K = K ET (RIGI N A) ; M = M ET (MASS N A) ; "
)
HELD = "K = K ET (BLOQ 'DEPL' B) ;"
FOOTING = (
    SQUARE + "G = B PLUS (0. 0.) ; MJ = MODE (RACC 0.001 B G) 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' "
    "'JOI2' ; AJ = MATE MJ 'KN' 1.E5 'KS' 1.E5 ; K = K ET (BLOQ 'DEPL' G) ; {0} "
    + TABLE
    + "T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = AJ ; {1} DYNAMIC T ;"
)
WEIGHT = "F = F ET (CHAR (FORC (0. -1.E4) H) (EVOL 'MANU' (PROG 0. 1.) (PROG 1. 1.))) ;"
PASAPAS = (
    SQUARE + "T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = A ; "
    "T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' B ; T . 'TEMPS_CALCULES' = PROG 0. 1. ; "
    "T . 'CHARGEMENT' = {0} ; PASAPAS T ;"
)

SHAKEN = "F = CHAR (M * (MANU 'CHPO' S 1 'UX' -1.)) EV ;"
PULLED = "F = CHAR (M * (MANU 'CHPO' S 1 'UY' -9.81)) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;"
FLOOR = (
    " X = EVOL 'TEMP' (DYNAMIC T) 'ACCE' 'UX' (H POIN 1) ; "
    "{0} Y = SPO X 'AMOR' 0.05 'FREQ' (PROG 5.) 'ACCE' ;"
)
HALF = "T . 'TEMPS_CALCULES' = PROG 0. PAS 0.01 0.5 ;"
AGAIN = "T . 'TEMPS_CALCULES' = PROG 0.5 PAS 0.01 1. ; {0} DYNAMIC T ;"
SEIS = "V = VIBR 'SIMU' {0} 1 K M ; C = SEIS (EVOL 'MANU' 'TEMP' LT 'ACCE' LT) V 1. 'UX' ;"
LOAD = "CHAR 'MECA' (FORC (300. 0.) H) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.))"
SAND = PASAPAS.replace("{0}", LOAD).replace(
    "T = TABL",
    "MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'DRUCKER_PARFAIT' ; "
    "A = MATE MO 'YOUN' 1.E7 'NU' 0. 'LTR' {0} 'LCS' (3. * {0}) ; T = TABL",
)
MATRICES = "operators.matrices."
PART = (
    SQUARE.replace("DROI 2", "DROI 4") + "G = B PLUS (0. 0.) ; Q = TRAN 1 G (0 -1) ; "
    "N = MODE Q 'MECANIQUE' 'ELASTIQUE' ; MJ = MODE (RACC 0.001 (B ELEM (LECT 1 2)) "
    "(G ELEM (LECT 1 2))) 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI2' ; "
    "AJ = MATE MJ 'KN' 1.E5 'KS' 1.E5 ; K = K ET (RIGI MJ AJ) ET (BLOQ 'DEPL' (COTE 3 Q)) "
    "ET (RIGI N (MATE N 'YOUN' 1.E7 'NU' 0.)) ; {0} U = RESO K (FORC (0. -1.) H) ;"
)
MACRO = (
    TIMES + "OPTI ELEM SEG2 ; {0} PT = 0. 1. ; MJ = MODE (MANU 'SEG2' {1}) 'MECANIQUE' 'ELASTIQUE' "
    "'MACRO_SEMELLE' 'JOI1' ; AJ = MATE MJ 'KN' 1.E7 'KS' 1.E7 'LARG' 4. ; K = BLOQ 'DEPL' 'ROTA' "
    "PB ; M = (MASS 'DEPL' 1. PT) ET (MASS 'ROTA' 1. PT) ; F = CHAR (FORC (0. -1.) PT) EV ; "
    + TABLE
    + "T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = AJ ; DYNAMIC T ;"
)


def loaded(x: str, y: str) -> str:
    """The oscillator's load with this curve."""
    return f"F = CHAR (FORC (1. 0.) P) (EVOL 'MANU' (PROG {x}) (PROG {y})) ;"


def flat(kind: str, nodes: str) -> str:
    """The stiffness of a cell."""
    model = f"C = MANU '{kind}' {nodes} ; N = MODE C 'MECANIQUE' 'ELASTIQUE' ; "
    return model + "K = RIGI N (MATE N 'YOUN' 1. 'NU' 0.) ;"


FLAT = "kernel.elements.jacobian-vanishes-changes-sign"
MODELS = {
    # initial motions and imposed values
    "forces for velocities": (
        OSCILLATOR.format("", "T . 'VITE' = MANU 'CHPO' P 'FX' 1. ;"),
        "D.motion-elsewhere",
    ),
    "small letters": (
        OSCILLATOR.format("", "T . 'VITE' = MANU 'CHPO' P 'ux' 1. ;"),
        "D.motion-elsewhere",
    ),
    "an unknown of no matrix": (
        OSCILLATOR.format("", "T . 'DEPL' = MANU 'CHPO' P 'UY' 1. ;"),
        "D.motion-elsewhere",
    ),
    "a new point": (
        OSCILLATOR.format("", "T . 'DEPL' = MANU 'CHPO' (0. 0.) 'UX' 1. ;"),
        "D.motion-elsewhere",
    ),
    "velocities of a support": (
        BODY.format(HELD, "T . 'VITE' = MANU 'CHPO' B 'UX' 1. ;"),
        "D.motion-against-supports",
    ),
    "displacements of a support": (
        BODY.format(HELD, "T . 'DEPL' = MANU 'CHPO' B 'UX' 1. ;"),
        "D.motion-against-supports",
    ),
    "a support that jumps at the start": (
        BODY.format(
            "L = BLOQ 'UX' B ; K = K ET L ET (BLOQ 'UY' B) ; F = CHAR (DEPI L 1.) "
            "(EVOL 'MANU' (PROG 0. 1.) (PROG 1. 1.)) ;",
            "",
        ),
        "D.motion-against-supports",
    ),
    "imposed on a condition of no matrix": (
        BODY.format(HELD + "F = CHAR (DEPI (BLOQ 'UX' H) 1.) EV ;", ""),
        "D.imposed-elsewhere",
    ),
    "the same in load steps": (
        PASAPAS.format(
            "CHAR 'DIMP' (DEPI (BLOQ 'UX' H) 1.) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.))"
        ),
        "D.imposed-elsewhere",
    ),
    "the same in statics": (
        SQUARE + HELD + "U = RESO K (DEPI (BLOQ 'UX' H) 1.) ;",
        "operators.statics.imposed-elsewhere",
    ),
    # supports, weight, mass
    "no weight on joints": (FOOTING.format("", ""), "D.nothing-presses"),
    "no weight on joints, a push at the start": (
        FOOTING.format("", "T . 'VITE' = MANU 'CHPO' S 1 'UX' 1. ;"),
        "D.nothing-presses",
    ),
    "joints of another stiffness": (
        FOOTING.format(
            WEIGHT + "K = K ET (RIGI MJ (MATE MJ 'KN' 1.01E5 'KS' 1.E5)) ;",
            "",
        ),
        "D.joints-of-others",
    ),
    "joints so soft that the body sinks in": (
        FOOTING.replace("'KN' 1.E5", "'KN' 1.E3").format(WEIGHT, ""),
        "D.sinks-in",
    ),
    "no weight on stops": (
        BODY.format("K = K ET (BLOQ 'MINI' 'UY' B) ET (BLOQ 'UX' B) ;", ""),
        "D.nothing-presses",
    ),
    "held upwards alone": (BODY.format("K = K ET (BLOQ 'UY' B) ;", ""), "D.slides-away"),
    "held sideways alone": (
        BODY.format("K = K ET (BLOQ 'UX' B) ; F = CHAR (FORC (0. 1.) H) EV ;", ""),
        "D.slides-away",
    ),
    "joints without shear": (
        FOOTING.replace("'KS' 1.E5", "'KS' 0.").format(WEIGHT, ""),
        "D.slides-away",
    ),
    "held at a point": (BODY.format("K = K ET (BLOQ 'DEPL' (B POIN 1)) ;", ""), "D.turns-away"),
    "mass on a new point": (
        OSCILLATOR.format("M = M ET (MASS 'UX' 1. (0. 0.)) ;", ""),
        "D.masses-alone",
    ),
    "mass and dashpot on a new point": (
        OSCILLATOR.format("M = M ET (MASS 'UX' 1. (0. 0.)) ;", "T . 'AMOR' = 0.1 * M ;"),
        "D.masses-alone",
    ),
    "both sides of joints held": (
        FOOTING.format(HELD + WEIGHT, ""),
        "D.joints-held",
    ),
    "a load on what is held": (
        BODY.format(HELD + "F = F ET (CHAR (FORC (1. 0.) B) EV) ;", ""),
        "D.load-on-supports",
    ),
    "dashpots on what is held": (
        BODY.format(HELD + "C = (AMOR MO B A) ET (0.1 * M) ;", "T . 'AMOR' = C ;"),
        "D.dashpots-on-supports",
    ),
    "springs on what is held": (
        SQUARE + HELD + "U = RESO (K ET (APPU 'UX' 1.E6 B)) (FORC (1. 0.) H) ;",
        "operators.matrices.springs-held",
    ),
    "masses of one way, and a weight": (
        BODY.format(HELD + "M = M ET (MASS 'UX' 1.E5 H) ;" + PULLED, ""),
        "D.masses-one-way",
    ),
    "cells longer than waves": (
        BODY.replace("(0 1)", "(0 40)").format(HELD + SHAKEN, ""),
        "D.cells-too-long",
    ),
    "a block in ground that was left": (
        SQUARE + "Q = TRAN 1 (DROI 1 (0.1 0.1) (0.9 0.1)) (0 0.8) ; N = MODE Q 'MECANIQUE' ; "
        "U = RESO (K ET (RIGI N (MATE N 'YOUN' 1. 'NU' 0.)) ET (BLOQ 'DEPL' (B ET Q))) "
        "(FORC (1. 0.) H) ;",
        "operators.matrices.cells-overlap",
    ),
    "the spectrum of a floor, relative to the ground": (
        BODY.format(HELD + SHAKEN, "") + FLOOR.format(""),
        "operators.curves.accelerations-relative",
    ),
    "a calculation called again to go on": (
        OSCILLATOR.format("", HALF) + AGAIN.format(""),
        "D.begins-again",
    ),
    "modes that leave most of the mass out": (
        SQUARE + HELD + SEIS.format(900.0),
        "operators.modal.mass-left-out",
    ),
    "checkpoints beyond the end": (
        OSCILLATOR.format("", "T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = 101 ;"),
        "D.checkpoints-beyond-end",
    ),
    "forces of supports among displacements": (
        SQUARE + HELD + "U = RESO K (FORC (1. 0.) H) ; X = MAXI (ABS U) ;",
        "operators.fields.extreme-of-multipliers",
    ),
    "friction that nothing presses": (SAND.format(10.0), "operators.statics.no-confinement"),
    "dashpots inside the body": (
        SQUARE + "L = DROI 2 (0 0.5) (1 0.5) ; ELIM 1.E-3 (S ET L) ; C = AMOR MO L A ;",
        "operators.matrices.border-inside",
    ),
    "a load before the first instant": (
        BODY.format(HELD, "T . 'TEMPS_CALCULES' = PROG 0.9 PAS 0.01 1. ;"),
        "D.load-before",
    ),
    "joints under a part of the body": (
        PART.format(""),
        "operators.matrices.beside-joints",
    ),
    "a footing that leans": (MACRO.format("PB = 0.5 0. ;", "PB PT"), MATRICES + "footing-inclined"),
    "a footing upside down": (MACRO.format("PB = 0. 0. ;", "PT PB"), MATRICES + "footing-turned"),
    "one instant of a motion": (
        FOOTING.format(WEIGHT, "T . 'PAS_SAUVES' = 'FINAL' ;").replace(
            "DYNAMIC T ;",
            "R = DYNAMIC T ; V = TABL ; V . 'RESULTATS' = R ; V . 'MODELE' = MJ ; "
            "V . 'CARACTERISTIQUES' = AJ ; X = @BILANSSI V ;",
        ),
        "stdlib.bilanssi-one-instant",
    ),
    "a record that drifts": (
        TIMES + "D V = INSI (EVOL 'MANU' 'TEMP' LT 'ACCE' (0.3 + (SIN (LT * 3600.)))) ;",
        "operators.curves.drifts",
    ),
    "a large mesh, by its matter": (
        SQUARE.replace("(1 0)", "(9000 0)"),
        "operators.models.unusual-size",
    ),
    "loads of nought": (OSCILLATOR.format("F = CHAR (FORC (0. 0.) P) EV ;", ""), "D.nothing-moves"),
    "a curve of nought": (OSCILLATOR.format(loaded("0. 1.", "0. 0."), ""), "D.nothing-moves"),
    "a spring beside the body": (
        SQUARE + HELD + "K = K ET (APPU 'UX' 1.E6 (0. 1.)) ; U = RESO K (FORC (1. 0.) H) ;",
        "operators.matrices.springs-apart",
    ),
    "a spring beside the body, in time": (
        BODY.format(HELD + "K = K ET (APPU 'UX' 1.E6 (5. 5.)) ;", ""),
        "operators.matrices.springs-apart",
    ),
    "bodies that touch": (
        TWO + "U = RESO (K ET (BLOQ 'DEPL' B)) (FORC (1. 0.) H) ;",
        "operators.matrices.bodies-apart",
    ),
    "bodies that touch, in time": (
        TWO + "K = K ET (BLOQ 'DEPL' B) ; " + TABLE + "DYNAMIC T ;",
        "operators.matrices.bodies-apart",
    ),
    # damping, steps, loads in time
    "beyond critical": (OSCILLATOR.format("", "T . 'AMOR' = AMOR 'UX' 400. P ;"), "D.overdamped"),
    "Rayleigh's beta for a ratio": (OSCILLATOR.format("", "T . 'AMOR' = 5. * K ;"), "D.overdamped"),
    "damping below zero": (
        OSCILLATOR.format("", "T . 'AMOR' = -0.01 * M ;"),
        "D.driven-by-dashpots",
    ),
    "a dashpot below zero": (
        OSCILLATOR.format("C = AMOR 'UX' -1. P ;", ""),
        "operators.matrices.negative-at-nodes",
    ),
    "a mass below zero": (
        OSCILLATOR.format("C = MASS 'UX' -1. P ;", ""),
        "operators.matrices.negative-at-nodes",
    ),
    "a spring below zero": (
        OSCILLATOR.replace("400.", "-400.").format("", ""),
        "operators.matrices.negative-stiffness",
    ),
    "a support below zero": (
        SQUARE + "U = RESO (K ET (BLOQ 'DEPL' B) ET (APPU 'UX' -1.E9 H)) (FORC (1. 0.) H) ;",
        "operators.matrices.negative-stiffness",
    ),
    "steps longer than a period": (
        OSCILLATOR.format("", "T . 'TEMPS_CALCULES' = PROG 0. 0.5 1. ;"),
        "D.step-over-period",
    ),
    "a first velocity in long steps": (
        OSCILLATOR.format(
            loaded("0. 1.", "0. 1.E-9"),
            "T . 'VITE' = MANU 'CHPO' P 'UX' 1. ; T . 'TEMPS_CALCULES' = PROG 0. PAS 0.4 2. ;",
        ),
        "D.step-over-period",
    ),
    "loads between the steps": (
        OSCILLATOR.format("", "T . 'TEMPS_CALCULES' = PROG 0. PAS 0.1 1. ;"),
        "D.load-missed",
    ),
    "load steps on what is held": (
        PASAPAS.format("CHAR 'MECA' (FORC (1. 0.) B) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.))"),
        "D.load-on-supports",
    ),
    "a pulse between load steps": (
        PASAPAS.format(
            "CHAR 'MECA' (FORC (1. 0.) H) (EVOL 'MANU' (PROG 0. 0.5 1.) (PROG 0. 1. 0.))"
        ),
        "D.load-missed",
    ),
    "loads that begin late": (OSCILLATOR.format(loaded("0.5 1.", "3. 4."), ""), "D.load-begins"),
    "loads that end early": (OSCILLATOR.format(loaded("0. 0.5", "3. 4."), ""), "D.load-ends"),
    "loads whose strong part comes later": (
        OSCILLATOR.format(loaded("0. 5. 6. 7.", "0. 0.01 1. 0."), ""),
        "D.load-ahead",
    ),
    "loads of a later time": (
        OSCILLATOR.format(loaded("5. 6. 7.", "0. 1. 0."), ""),
        "D.load-outside",
    ),
    "loads of an earlier time": (
        OSCILLATOR.format(loaded("-5. -4. -3.", "0. 1. 0."), ""),
        "D.load-outside",
    ),
    "a load joined with itself": (OSCILLATOR.format("F = F ET F ;", ""), "D.load-twice"),
    "energy kept of a law that has none": (
        FOOTING.replace("'JOINT_SDM'", "'JOINT_DILATANT'")
        .replace("'KS' 1.E5", "'KS' 1.E5 'PHI' 35. 'MU' 5.")
        .format(WEIGHT, "T . 'CONSERVATIF' = VRAI ;"),
        "D.conserving-other-laws",
    ),
    # bodies that are there twice
    "a mass joined with itself": (
        OSCILLATOR.format("M = M ET M ;", ""),
        "operators.matrices.cells-twice",
    ),
    "a spring joined with itself": (
        OSCILLATOR.format("K = K ET K ;", ""),
        "operators.matrices.cells-twice",
    ),
    "a mass joined with itself for modes": (
        SQUARE + HELD + "V = VIBR 'SIMU' 1. 1 K (M ET M) ;",
        "operators.matrices.cells-twice",
    ),
    "a stiffness joined with itself": (
        SQUARE + HELD + "U = RESO (K ET (RIGI MO A)) (FORC (1. 0.) H) ;",
        "operators.matrices.cells-twice",
    ),
    "a body copied and merged": (
        SQUARE + "Q = S ET (S PLUS (0. 0.)) ; ELIM Q 1.E-3 ; N = MODE Q 'MECANIQUE' 'ELASTIQUE' ; "
        "U = RESO ((RIGI N (MATE N 'YOUN' 1. 'NU' 0.)) ET (BLOQ 'DEPL' B)) (FORC (1. 0.) H) ;",
        "operators.matrices.cells-twice",
    ),
    "two models of a mesh": (
        SQUARE + "N = MO ET (MODE S 'MECANIQUE' 'ELASTIQUE') ; "
        "U = RESO ((RIGI N (MATE N 'YOUN' 1. 'NU' 0.)) ET (BLOQ 'DEPL' B)) (FORC (1. 0.) H) ;",
        "operators.matrices.cells-twice",
    ),
    # materials, cells, modes, spectra
    "friction below zero": (
        FOOTING.replace("'KS' 1.E5", "'KS' 1.E5 'FROT' -0.5").format(WEIGHT, ""),
        "operators.models.friction-negative",
    ),
    "a joint of a line with itself": (
        SQUARE + "J = RACC 0.001 B B ;",
        "operators.mesh.joint-on-itself",
    ),
    "damping in per cent": (
        TIMES + "A = EVOL 'MANU' 'TEMP' LT 'ACCE' (SIN (LT * 1000.)) ; "
        "S = SPO A 'AMOR' (PROG 0.02 5.) 'FREQ' (PROG 1.) 'ACCE' ;",
        "operators.curves.damping-in-per-cent",
    ),
    "a flat triangle": (flat("TRI3", "(0 0) (1 0) (0.5 1.E-14)"), FLAT),
    "a flat quadrangle": (flat("QUA4", "(0 0) (1 0) (1 1.E-14) (0 1.E-14)"), FLAT),
    "a flat tetrahedron": (
        "OPTI DIME 3 MODE TRID ; " + flat("TET4", "(0 0 0) (1 0 0) (0 1 0) (0.2 0.2 1.E-14)"),
        FLAT,
    ),
}
"""Models, loads and steps."""

SENSIBLE_MODELS = {
    "a mode of no mass, which what steps it refuses": SQUARE
    + HELD
    + SEIS.format(900.0).replace("C =", "V . 'MODES' . 1 . 'MASSE_GENERALISEE' = 0. ; C ="),
    "springs under a body held at its base": SQUARE
    + HELD
    + "U = RESO (K ET (APPU 'UX' 1.E6 S)) (FORC (1. 0.) H) ; X = MAXI U 'SANS' (MOTS 'LX') ;",
    "dashpots beside a base that is held": BODY.format(
        HELD + "C = (AMOR MO H A) ET (0.1 * M) ;", "T . 'AMOR' = C ;"
    ),
    "masses of all ways, and their weight": BODY.format(
        HELD + "M = M ET (MASS 'DEPL' 1.E5 H) ;" + PULLED,
        "T . 'DEPL' = RESO K (M * (MANU 'CHPO' S 1 'UY' -9.81)) ;",
    ),
    "cells of waves": BODY.format(HELD + SHAKEN, "") + FLOOR.format("X = X + EV ;"),
    "a calculation that goes on": OSCILLATOR.replace(" DYNAMIC T", " R = DYNAMIC T").format(
        "", HALF
    )
    + AGAIN.format("N = DIME R ; T . 'DEPL' = R . N . 'DEPL' ; T . 'VITE' = R . N . 'VITE' ;"),
    "the first mode of a body": SQUARE + HELD + SEIS.format(1.0),
    "ground with cohesion": SAND.format(1.0e5),
    "a weight that leans, held by a condition": OSCILLATOR.format(
        "Q = 0. 0. ; K = K ET (RIGI 'UX' -4. Q) ET (RELA 'UX' P - 'UX' Q) ;", ""
    ),
    "bodies that touch, tied": TWO
    + "K = K ET (BLOQ 'DEPL' B) ET (RELA 'UX' (COTE 2 S) - 'UX' (COTE 4 Q)) ; "
    + "U = RESO K (FORC (1. 0.) H) ;",
    "joints under a part of the body, conditions under the other": PART.format(
        "X = B ELEM (LECT 3 4) ; Y = G ELEM (LECT 3 4) ; "
        "K = K ET (RELA 'UX' X - 'UX' Y) ET (RELA 'UY' X - 'UY' Y) ;"
    ),
    "bodies that touch, made one": TWO.replace("; B = B", "; ELIM 1.E-4 S Q ; B = B")
    + "U = RESO (K ET (BLOQ 'DEPL' B)) (FORC (1. 0.) H) ;",
    "an oscillator": OSCILLATOR.format("", "T . 'AMOR' = AMOR 'UX' 2. P ;"),
    "a held body": BODY.format(HELD, "T . 'VITE' = MANU 'CHPO' H 'UX' 1. ;"),
    "a footing with its weight": FOOTING.format(WEIGHT, ""),
    "a free body that is thrown": BODY.format("", ""),
    "a weight that leans, held by a stiffer spring": OSCILLATOR.format(
        "K = K ET (RIGI 'UX' -100. P) ;", ""
    ),
    "a body on dashpots": BODY.format(
        "K = K ET (BLOQ 'UY' B) ;", "T . 'AMOR' = AMOR 'UX' 1.E4 B ;"
    ),
    "slow loads in long steps": OSCILLATOR.format(
        loaded("0. 100.", "0. 1."), "T . 'TEMPS_CALCULES' = PROG 0. PAS 1. 100. ;"
    ),
    "matrices joined with multiples of themselves": OSCILLATOR.format(
        "M = M ET (0.5 * M) ; K = K ET (0.5 * K) ;", ""
    ),
    "springs side by side": OSCILLATOR.format("K = K ET (RIGI 'UX' 400. P) ;", ""),
    "energy kept of joints": FOOTING.format(WEIGHT, "T . 'CONSERVATIF' = VRAI ;"),
    "friction that does not bound": FOOTING.replace("'KS' 1.E5", "'KS' 1.E5 'FROT' -1.").format(
        WEIGHT, ""
    ),
    "a thin cell": (flat("QUA4", "(0 0) (1 0) (1 1.E-6) (0 1.E-6)")),
}


PERIOD = math.pi / 10.0  # of the oscillator: 20 rad/s
DATA: dict[str, dict[str, object]] = {
    "joints of another stiffness": {"off": 0.01},
    "steps of seconds": {"value": 1.0, "most": 0.2},
    "a record with a part missing": {"value": 4.98, "most": 0.01},
    "an earthquake of tens of g": {"value": 60.0 * 9.81, "most": 50.0},
    "fewer values said than there are": {"count": 4, "left_out": 2},
    "velocities of a support": {"index": "VITE", "moved": False},
    "displacements of a support": {"index": "DEPL", "moved": True},
    "mass on a new point": {"count": 1},
    "beyond critical": {"ratio": 10.0},
    "Rayleigh's beta for a ratio": {"ratio": 50.0},
    "damping below zero": {"ratio": -2.5e-4},
    "imposed on a condition of no matrix": {"supports": "RIGI", "count": 3},
    "the same in load steps": {"supports": "BLOCAGES_MECANIQUES", "count": 3},
    "steps longer than a period": {"dt": 0.5, "period": PERIOD, "wanted": PERIOD / 20.0},
    "a pulse between load steps": {"time": 0.5, "value": 1.0, "seen": 0.0, "name": "MECA"},
    "loads that begin late": {"begin": 0.5, "value": 3.0, "first": 0.0},
    "loads that end early": {"end": 0.5, "value": 4.0, "last": 1.0},
    "loads of a later time": {"begin": 5.0, "end": 7.0, "first": 0.0, "last": 1.0},
}
"""What is told of some of them, reckoned by hand."""


FILES["g for m/s2 in a motion"] = (
    OSCILLATOR.format(RECORD + "F = CHAR (M * (MANU 'CHPO' P 'UX' -1.)) E ;", ""),
    {"a.txt": PEER.format("ACCELERATION", 6).replace("M/S", "G").replace(".01", ".2")},
    "operators.dynamics.shaken-in-g",
)


def told(script: str, folder: Path, what: str = "") -> list[str]:
    """Codes of the warnings and errors of a script in the plane; their data are looked at."""
    result = run_text(f"OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; {script}", output_directory=folder)
    assert "defect of ssilang" not in result.message
    found = [*result.session.warnings, *result.errors]
    if what in DATA:
        ((_, data),) = {w.code: w.data for w in found if DATA[what].keys() <= w.data.keys()}.items()
        assert {k: data[k] for k in DATA[what]} == pytest.approx(DATA[what])
    return [w.code for w in found]


def written(files: dict[str, str], folder: Path) -> Path:
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder


@together("what", FILES)
def test_files_that_hold_something_else_are_told(what: str, tmp_path: Path) -> None:
    script, files, code = FILES[what]
    assert code in told(script, written(files, tmp_path), what)


@pytest.mark.parametrize("what", SENSIBLE_FILES)
def test_files_that_hold_what_they_say_are_not(what: str, tmp_path: Path) -> None:
    script, files = SENSIBLE_FILES[what]
    assert told(script, written(files, tmp_path)) == []


@together("what", MODELS)
def test_models_that_make_no_sense_are_told(what: str, tmp_path: Path) -> None:
    script, code = MODELS[what]
    assert code.replace("D.", "operators.dynamics.") in told(script, tmp_path, what)


@together("what", SENSIBLE_MODELS)
def test_models_that_make_sense_are_not(what: str, tmp_path: Path) -> None:
    codes = told(SENSIBLE_MODELS[what], tmp_path)
    assert {c for c in codes if c != "operators.dynamics.contact-not-resolved"} == set()


DRAWN = tomllib.loads(Path(__file__).with_name("senseless_drawn.toml").read_text(encoding="utf-8"))
SETUPS = DRAWN.pop("setups")


@together("what", DRAWN)
def test_scripts_drawn_over_all_operators_are_told(what: str, tmp_path: Path) -> None:
    script = DRAWN[what]["script"]
    while "{" in script:
        script = script.format(**SETUPS)
    codes = told(script, tmp_path)
    code = DRAWN[what]["told"]
    assert code in codes if code else codes == []


SENSIBLE_ENDS = {
    "a joint between two points": "L = DROI 1 (0. 0.) (0. 0.) ;",
    "a surface about an axis": (
        "OPTI MODE AXIS ; X = (DROI 2 (0. 0.) (1. 0.)) ROTA 4 90. (0. 0.) ;"
    ),
    "one component after the other": (
        "C = MANU 'CHPO' (0. 0.) 'UX' 3. 'UY' 4. ; X = EXCO (MOTS 'UX' 'UY') C (MOTS 'UY' 'UX') ;"
    ),
    "a copy in its place": SQUARE + "X = S PLUS (0. 0.) ; ELIM X S 1.E-3 ;",
    "curves end to end": (
        "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; "
        "X = CONC E (EVOL 'MANU' (PROG 1. 2.) (PROG 1. 2.)) ;"
    ),
    "lists of words of one kind": "X = (MOTS 'UX' 'UX') ;",
    "the usual colour by a number below nought": SQUARE + "X = S COUL -3 ;",
    "an angle of rounding": "X = COS 3.3E-13 ; Y = SIN (PROG -2.E-13 0. 1.E-10) ;",
    "a signal whose last point closes the period": (
        "E = EVOL 'MANU' (PROG 0. PAS 1. 8.) (PROG 9 * 1.) ; X = TFR 3 E 'REIM' 'FMAX' 0.5 ;"
    ),
    "a disc by its radius": (
        "T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 2. ; T . 'YOUNG' = 1.E8 ; "
        "T . 'POISSON' = 0.3 ; T . 'MASSE_VOLUMIQUE' = 2000. ; T . 'FREQUENCE' = 1. ; "
        "R = IMPEDSOL T ;"
    ),
}


@together("what", SENSIBLE_ENDS)
def test_what_is_near_to_them_is_not(what: str, tmp_path: Path) -> None:
    assert told(SENSIBLE_ENDS[what], tmp_path) == []


def test_one_layer_of_linear_cells_bends_too_stiff_by_what_is_told(tmp_path: Path) -> None:
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


def test_free_motions_have_no_frequency(tmp_path: Path) -> None:
    script = "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; " + SQUARE + "T = VIBR 'SIMU' 0.1 4 K M ;"
    modes = run_text(script, output_directory=tmp_path).session.root.find("T").get("MODES")
    found = [modes.get(i).get("FREQUENCE") for i in range(1, 5)]
    assert found[:3] == [0.0, 0.0, 0.0]
    assert found[3] > 1.0

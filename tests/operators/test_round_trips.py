"""What is written and read again is what it was: mixed, unsorted, single and empty."""

import importlib.util
import itertools
import re
from collections import defaultdict

import numpy as np
import pytest
from script_runs import found, printed
from together import together

from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import Mesh, Point

# cells of one node, of several kinds that share nodes, in no order; of both orders; one alone
PLANE = {
    "mixed": "OPTI DIME 2 ELEM QUA4 ; P9 = 3. 1. ; P1 = 0. 0. ; P5 = 1. 0. ; P2 = 1. 1. ; "
    "P7 = 0. 1. ; P3 = 2. 0.5 ; P4 = 2.5 -0.5 ; "
    "S = (MANU 'TRI3' P5 P3 P2) ET (MANU 'QUA4' P1 P5 P2 P7) ET (MANU 'TRI3' P4 P3 P5) ET "
    "(MANU 'QUA4' P4 P9 P2 P3) ET (MANU 'SEG2' P7 P1) ;",
    "flat": "OPTI DIME 2 ELEM QUA4 ; P9 = 3. 1. ; P1 = 2. 0.5 ; P5 = 1. 0. ; P2 = 1. 1. ; "
    "S = (MANU 'TRI3' P5 P1 P2) ET (MANU 'TRI3' P9 P2 P1) ;",
    "curved": "OPTI DIME 2 ELEM QUA8 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
    "OPTI ELEM TRI6 ; S = ((DROI 1 (5. 0.) (6. 0.)) TRAN 2 (0.3 1.)) ET S ;",
    "row": "OPTI DIME 2 ELEM QUA4 ; "
    + "".join(f"P{i + 1} = {i % 5}. {i // 5}. ; " for i in range(10))
    + "S = (MANU 'QUA4' P3 P4 P9 P8) ET (MANU 'QUA4' P1 P2 P7 P6) ET (MANU 'QUA4' P4 P5 P10 P9) ET "
    "(MANU 'QUA4' P2 P3 P8 P7) ;",
    "one": "OPTI DIME 2 ELEM TRI3 ; S = MANU 'TRI3' (2. 0.) (2. 1.) (0. 0.) ;",
}
SPACE = {
    "mixed": "OPTI DIME 3 ELEM CUB8 ; P8 = 0. 0. 0. ; P1 = 1. 0. 0. ; P7 = 1. 1. 0. ; "
    "P2 = 0. 1. 0. ; "
    "P6 = 0. 0. 1. ; P3 = 1. 0. 1. ; P5 = 1. 1. 1. ; P4 = 0. 1. 1. ; P9 = 0.5 0.5 2. ; "
    "P10 = 2. 0. 0. ; P11 = 2. 0. 1. ; P12 = 3. 1. 2. ; "
    "S = (MANU 'TET4' P5 P12 P9 P11) ET (MANU 'CUB8' P8 P1 P7 P2 P6 P3 P5 P4) ET "
    "(MANU 'PYR5' P6 P3 P5 P4 P9) ET (MANU 'PRI6' P1 P10 P7 P3 P11 P5) ;",
    "one": "OPTI DIME 3 ELEM TET4 ; S = MANU 'TET4' (0. 0. 0.) (1. 0. 0.) (0. 1. 0.) (0. 0. 2.) ;",
}
MESHES = {f"{k} in {name}": text for name, group in (("the plane", PLANE), ("space", SPACE))
          for k, text in group.items()}  # fmt: skip
# a file's name, how it is written, how it is read, what meshes it has
FILES = {
    "own": ("'m'", "SORT S ;", "OPTI LECT 'm' ; OUBL S ; LIRE S ; S2 = S ;"),
    "archive": ("'x'", "OPTI SAUV 'm' ; SAUV S ;", "OUBL S ; OPTI REST 'm' ; REST ; S2 = S ;"),
    "Gmsh": ("'m.msh'", "SORT 'MESH' S ;", "T = LIRE 'm.msh' ; S2 = T . 'MAILLAGE' ;"),
    "MED": ("'m.med'", "SORT 'MESH' S ;", "T = LIRE 'm.med' ; S2 = T . 'S' ;"),
    "Abaqus": ("'m.inp'", "SORT 'MESH' S ;", "T = LIRE 'm.inp' ; S2 = T . 'S' ;"),
    "Abaqus deck": ("'m.inp'", "SORT 'ABAQ' S ;", "T = LIRE 'm.inp' ; S2 = T . 'MAILLAGE' ;"),
    "Nastran": ("'m.bdf'", "SORT 'NAS' S ;", "T = LIRE 'm.bdf' ; S2 = T . 'MAILLAGE' ;"),
    "AVS": ("'m.inp'", "SORT 'AVS' S ;",
            "OPTI LECT 'm.inp' ; T = LIRE 'AVS' ; S2 = T . 'LEMAILLA' ;"),
    "VTK": ("'m.vtu'", "SORT 'VTK ' S ;", "T = LIRE 'm.vtu' ; S2 = T . 'MAILLAGE' ;"),
}  # fmt: skip


def cells(mesh: Mesh) -> list:
    """Each cell by its kind and the coordinates of its nodes, in their order."""
    return sorted(
        (block.kind.name, np.round(corners, 9).tolist())
        for block in mesh.blocks
        for corners in block.coordinates
    )


LINELESS = ("Abaqus deck", "mixed in the plane")


@together("file, mesh", [p for p in itertools.product(FILES, MESHES) if p != LINELESS])
def test_cells_come_back_as_they_were(file, mesh, tmp_path):
    if file == "MED" and importlib.util.find_spec("h5py") is None:
        pytest.skip("h5py is not installed")
    name, write, read = FILES[file]
    script = f"{MESHES[mesh]} OPTI SORT {name} ; S1 = S ; {write} {read}"
    was, now = found(script, "S1", "S2", folder=tmp_path)
    assert cells(now) == cells(was)


# parts of mixed meshes: in another order than the whole, of two kinds, met by another, of points
PARTS = {
    "row in the plane": "Z = MANU 'QUA4' P4 P5 P10 P9 ; A = (MANU 'QUA4' P2 P3 P8 P7) ET Z ; "
    "L = MANU 'SEG2' P2 P1 ; V = L ET P9 ET P2 ; E = DIFF A A ;",
    "mixed in the plane": "Z = MANU 'QUA4' P4 P9 P2 P3 ; A = (MANU 'TRI3' P4 P3 P5) ET Z ; "
    "L = MANU 'SEG2' P7 P1 ; V = L ET P9 ET P2 ; E = DIFF A A ;",
    "mixed in space": "Z = MANU 'PYR5' P6 P3 P5 P4 P9 ; A = (MANU 'PRI6' P1 P10 P7 P3 P11 P5) ET "
    "Z ; L = MANU 'TRI3' P3 P5 P4 ; V = L ET P9 ET P2 ; E = DIFF A A ;",
}
TITLES = ("S", "Z", "A", "L", "V", "P9", "P2")


def held(value) -> list:
    """Cells of a mesh, or of a point."""
    return (
        [("POI1", [np.round(value.coordinates, 9).tolist()])]
        if isinstance(value, Point)
        else cells(value)
    )


@together("ending", ["msh", "med", "inp"])
@together("mesh", PARTS)
@together("given", ["mesh", "table"])
def test_named_parts_come_back_as_they_were(given, mesh, ending, tmp_path):
    if ending == "med" and importlib.util.find_spec("h5py") is None:
        pytest.skip("h5py is not installed")
    made = MESHES[mesh] + PARTS[mesh]
    table = "".join(f"T0 . '{n}' = {n} ; " for n in (*TITLES[:0:-1], "E"))
    what = "S" if given == "mesh" else "T0"
    script = (
        f"{made} T0 = TABL ; {table} T0 . 'MAILLAGE' = S ; T0 . 7 = Z ; OPTI SORT 'm.{ending}' ; "
        f"SORT 'MESH' {what} ; T = LIRE 'm.{ending}' ;"
    )
    read, *was = found(script, "T", *TITLES, folder=tmp_path)
    back = {str(k): v for k, v in read.items() if str(k)[0] != "@"}
    wanted = {}
    for name, value in zip(TITLES, was, strict=True):
        if given == "table" and name == "S":
            continue
        of = defaultdict(list)  # by dimension; a group of Gmsh has one, and one of points its nodes
        for kind, corners in held(value):
            d = 0 if kind == "POI1" else CELL_TYPES[kind].dimension if ending == "msh" else 1
            of[d].append((kind, corners))
        for d, group in of.items():
            behind = "_GN" if d == 0 and ending != "msh" else f"_{d}D"
            wanted[name if d == max(of) else name + behind] = group
    for name, value in wanted.items():
        assert cells(back[name]) == value, name
    others = {n for n in back if n not in wanted} - {"NOEUDS", "MAILLAGE"}
    assert {n for n in others if not re.fullmatch(r"P\d+", n)} == set()
    assert not others or given == "mesh"


def at_nodes(field) -> dict:
    """Values of a field at nodes by component and place."""
    return {
        (name, *np.round(field.table.coordinates[n], 9)): v
        for name, part in field.components.items()
        for n, v in zip(part.nodes, part.values, strict=True)
    }


def in_cells(field) -> dict:
    """Means of a field in cells by component, kind and place."""
    return {
        (name, block.cells.kind.name, str(np.round(corners, 9).tolist())): v.mean()
        for block in field.blocks
        for name, values in block.components.items()
        for corners, v in zip(block.cells.coordinates, values, strict=True)
    }


@together("mesh", MESHES)
@together("time", [1.25, -3.0])
def test_fields_come_back_from_avs(time, mesh, tmp_path):
    script = (
        f"{MESHES[mesh]} U = (NOMC 'UY' ((COOR 1 S) ** 3)) ET (NOMC 'UX' (COOR 2 S)) ET "
        "(MANU 'CHPO' ((CHAN 'POI1' S) POIN 'INIT') 'RZ' 4. 'NATURE' 'DIFFUS') ; "
        "G = CHAN 'CHAM' (NOMC 'K' ((COOR 1 S) + (3. * (COOR 2 S)))) S 'GRAVITE' ; "
        f"OPTI SORT 'm.inp' ; SORT 'AVS' S U G 'TEMP' {time} ; OPTI LECT 'm.inp' ; "
        "T = LIRE 'AVS' ; V = T . 'LECHPOIN' ; H = T . 'LEMCHAML' ; X = T . 'time' ;"
    )
    u, g, v, h, x = found(script, "U", "G", "V", "H", "X", folder=tmp_path)
    nothing = {("RZ", *place): 0.0 for _, *place in at_nodes(u)}
    assert at_nodes(v) == pytest.approx(nothing | at_nodes(u))
    assert in_cells(h) == pytest.approx(in_cells(g))
    assert x == time


LISTS = {
    "unsorted": ("PROG 3. -1.E-300 2.5E12 0.", [3.0, -1e-300, 2.5e12, 0.0]),
    "integers": ("LECT 5 -3 4 4", [5, -3, 4, 4]),
    "reals": ("PROG 0.1 0.3 -2. 1.", [0.1, 0.3, -2.0, 1.0]),
}
SIGNS = {"VIRG": ",", "PVIR": ";", "ESPA": " "}


@together("mark", SIGNS)
@together("rows", [4, 1])
@together("order", list(itertools.permutations(LISTS)))
def test_columns_come_back_in_their_order(order, rows, mark, tmp_path):
    made = " ".join(f"(EXTR ({LISTS[name][0]}) (LECT 1 PAS 1 {rows}))" for name in order)
    script = (
        f"OPTI SORT 'c.csv' ; SORT 'EXCE' {made} 'SEPA' '{mark}' ; "
        f"T = LIRE 'CSV' 'c.csv' 'SEPA' '{SIGNS[mark]}' ;"
    )
    table = found(script, "T", folder=tmp_path)
    for k, name in enumerate(order, 1):
        assert list(table.get(k).values) == LISTS[name][1][:rows]


SAVED = {
    "A": "A = 3", "Z1": "Z1 = -0.1", "B": "B = FAUX", "W": "W = 'a b'", "E": "E = LECT",
    "L": "L = LECT 3", "R": "R = PROG", "Q": "Q = PROG 2. -1. 0.5", "M": "M = MOTS 'UX' 'A' 'UX'",
    "T": "T = TABL ; T . 'Z' = 2 ; T . 1 = 'A' ; T . -3 = TABL ; T . 'A' = PROG",
}  # fmt: skip


@together("names", [list(SAVED), list(SAVED)[::-1], *([name] for name in SAVED)])
def test_values_come_back_from_an_archive(names, tmp_path):
    """All at once in either order, and each alone."""
    made = " ; ".join(SAVED[name] for name in names)
    script = f"{made} ; OPTI SAUV 's' ; SAUV {' '.join(names)} ; "
    again = "".join(f"{name}0 = {name} ; OUBL {name} ; " for name in names)
    script += f"{again} OPTI REST 's' ; REST ;"
    values = found(script, *(w for name in names for w in (f"{name}0", name)), folder=tmp_path)
    for was, now in zip(values[::2], values[1::2], strict=True):
        assert content(now) == content(was)
        assert type(now) is type(was)


def content(value):
    """Numbers, words and tables as plain values, in their order."""
    if hasattr(value, "items"):
        return [(str(index), content(one)) for index, one in value.items()]
    return list(value.values) if hasattr(value, "values") else value


@pytest.mark.parametrize("lengths", [(3, 1, 2), (1, 2, 3), (2, 2, 5)])
def test_lines_of_unequal_lengths_come_back_as_they_are(lengths, tmp_path):
    rows = [[10.0 * k + i for i in range(n)] for k, n in enumerate(lengths, 1)]
    (tmp_path / "c.csv").write_text("\n".join(";".join(map(str, r)) for r in rows) + "\n")
    read = f"LIRE 'CSV' '{tmp_path / 'c.csv'}'"
    by_line, by_column = found(f"A = {read} 'LIGN' ; B = {read} ;", "A", "B", folder=tmp_path)
    assert [list(by_line.get(k).values) for k in range(1, 4)] == rows
    columns = [[r[i] for r in rows if i < len(r)] for i in range(max(lengths))]
    assert [list(by_column.get(k).values) for k in range(1, max(lengths) + 1)] == columns


# objects of every type on cells of two kinds in two zones, on points in no order
MADE = f"""{PLANE["mixed"].replace("OPTI DIME 2", "OPTI DIME 2 MODE PLAN CONT")}
S1 = (MANU 'QUA4' P1 P5 P2 P7) ET (MANU 'QUA4' P4 P9 P2 P3) ;
S2 = (MANU 'TRI3' P5 P3 P2) COUL ROUG ; LN = MANU 'SEG2' P7 P1 ;
M1 = MODE S1 'MECANIQUE' 'CONS' 'A' ;
M2 = MODE S2 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ; M = M2 ET M1 ;
A = (MATE M1 'YOUN' 3. 'NU' 0.25) ET (MATE M2 'YOUN' 7. 'NU' 0.3 'SIGY' 0.5) ;
U = (NOMC 'UX' (COOR 2 (S1 ET S2))) ET
  (MANU 'CHPO' (P9 ET P1) 'UY' (PROG 4. -2.) 'NATURE' 'DIFFUS') ;
F = FORC (3. -1.) P9 ; SG = SIGM M A U ; K = (RIGI M A) ET (BLOQ 'UX' P7) ET (APPU 'UY' 5. P1) ;
R = RELA 'MINI' 2. 'UX' P2 - 'UY' P9 ; D = DEPI R -0.1 ;
E = (EVOL 'ROUG' 'MANU' 'LEGE' 'b' 't' (PROG 0. 2. 1.) 'u' (PROG 3. -1. 0.5)) ET
  (EVOL 'MANU' 'x' (PROG 1.) 'y' (PROG 2.)) ; H = EVOL 'MANU' (PROG 0. 3.) (PROG 2. -1.) ;
G = (CHAR 'MECA' F H) ET (CHAR 'DIMP' D H) ;
N = NUAG 'COMP' 'Z' 3. 1. 'COMP' 'A' 5. 6. ; LC = SUIT F (2. * F) ; LO = ENUM P9 P1 ;
W = MASS 'UX' 4. P9 ; B = VIBR 'SIMU' 1. 1 (APPU 'UX' 400. P9) W ; X = DEFO U S1 2. 'VERT' ;
DEBP PR V*ENTIER ; FINP (2 * V) ; T = TABL 'KIND' ; T . P9 = E ; T . 2 = TABL ; T . 2 . 'A' = S2 ;
"""
OBJECTS = ("S", "S2", "P9", "M", "A", "U", "F", "SG", "K", "R", "D", "E", "G", "N", "LC", "LO", "W",
           "B", "X", "T")  # fmt: skip


@pytest.mark.parametrize("names", [OBJECTS, OBJECTS[::-1], ("P9",), ("K",), ("T",)])
def test_objects_are_listed_as_before_when_they_come_back(names, tmp_path):
    """All in either order, and some alone; numbers of nodes may be others, their order not."""
    listed = " ".join(f"MESS '{n}' ; LIST {n} ;" for n in names)
    forget = " ".join(f"OUBL {n} ;" for n in names)
    script = f"{MADE} {listed} MESS 'again' ; OPTI SAUV 's' ; SAUV {' '.join(names)} ; {forget} "
    lines = printed(f"{script} OPTI REST 's' ; REST ; {listed}", folder=tmp_path)
    middle = lines.index("again")
    parts = (" ".join(part).split() for part in (lines[:middle], lines[middle + 1 :]))
    before, after = ([re.sub(r"^\d+$", "#", word) for word in part] for part in parts)
    assert after == before

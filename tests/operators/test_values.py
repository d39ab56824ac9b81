"""What operators give for every type of operand is the same function of numpy.

Fields stand on points in no order and on cells of two kinds in two zones; `x` and `y` are the
coordinates of where a value stands. Curves are two, of other lengths, and go back in places.
"""

import io
import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
import script_runs
from scipy import special
from script_runs import session_after
from together import together

from ssilang.cli.run import execute
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.text.source import Source

PRELUDE = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
P9 = 3. 1.5 ; P1 = 1. 0.5 ; P5 = 2. 0.5 ; P2 = 2. 1. ; P7 = 1. 1.25 ; P3 = 4. 0.75 ;
S1 = (MANU 'TRI3' P5 P3 P2) ET (MANU 'QUA4' P1 P5 P2 P7) ; S2 = MANU 'TRI3' P3 P9 P2 ;
S = S1 ET S2 ; M1 = MODE S1 'MECANIQUE' 'ELASTIQUE' ; M2 = MODE S2 'MECANIQUE' 'ELASTIQUE' ;
M = M1 ET M2 ; X = COOR 1 S ; Y = COOR 2 S ;
U = (NOMC 'UX' (X - 2.5)) ET (NOMC 'UY' (X * Y)) ; V = (NOMC 'UX' Y) ET (NOMC 'UY' (Y * Y)) ;
CX = CHAN 'CHAM' X M ; CY = CHAN 'CHAM' Y M ;
C = (NOMC 'VX' (CX - 2.5)) ET (NOMC 'VY' (CX * CY)) ;
D = (NOMC 'VX' CY) ET (NOMC 'VY' (CY * CY)) ;
L = PROG 3. -1. 0.5 ; K = PROG 0.25 2. -4. ; I = LECT 3 -2 0 7 ; W = MOTS 'UX' 'UY' ;
Z = MOTS 'VX' 'VY' ;
E = (EVOL 'MANU' 't' (PROG 1. 2. 4.) 'u' (PROG 3. -1. 0.5)) ET
  (EVOL 'MANU' 't' (PROG 0. 3.) 'v' (PROG 5. 0.25)) ;
"""
A, B = np.array([3.0, -1.0, 0.5]), np.array([0.25, 2.0, -4.0])
INTEGERS = np.array([3, -2, 0, 7])
UX, UY = (lambda x, y: x - 2.5), (lambda x, y: x * y)
VX, VY = (lambda x, y: y), (lambda x, y: y * y)


LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_after(PRELUDE, tmp_path_factory.mktemp("values"), io.StringIO())


def asked(session, phrase):
    execute(session, Source("statement", f"R = {phrase} ;"))
    return session.root.find("R")


def assert_field(found, wanted):
    """A field is these functions of the place, component by component."""
    if isinstance(found, NodeField):
        values = {
            name: [(found.table.coordinates[part.nodes], part.values)]
            for name, part in found.components.items()
        }
    else:
        assert isinstance(found, CellField)
        values = {}
        for block in found.blocks:
            for name, part in block.components.items():
                values.setdefault(name, []).append((block.cells.coordinates, part))
    assert list(values) == list(wanted)
    for name, function in wanted.items():
        for places, numbers in values[name]:
            x, y = places[..., 0], places[..., 1]
            exact = np.broadcast_to(function(x, y), x.shape)
            np.testing.assert_allclose(numbers, exact, rtol=1e-12, atol=1e-13)


FUNCTIONS = {
    "ABS": abs, "SIGN": lambda v: np.where(np.asarray(v) < 0, -1, 1), "EXP": np.exp,
    "ERF": special.erf, "ERFC": special.erfc,
    "SIN": lambda v: np.sin(np.radians(v)), "COS": lambda v: np.cos(np.radians(v)),
    "TAN": lambda v: np.tan(np.radians(v)), "SINH": np.sinh, "COSH": np.cosh, "TANH": np.tanh,
    "ASIH": np.arcsinh, "ATG": lambda v: np.degrees(np.arctan(v)), "-1. *": lambda v: -v,
}  # fmt: skip
PAIRS = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide,
    "ATG": lambda a, b: np.degrees(np.arctan2(a, b)),
}  # fmt: skip


def both(function, first, second):
    return [lambda x, y, f=f, g=g: function(f(x, y), g(x, y))
            for f, g in zip(first, second, strict=True)]  # fmt: skip


@together("word", FUNCTIONS)
def test_functions_of_all_types_of_operands(session, word):
    f = FUNCTIONS[word]
    assert asked(session, f"{word} -1.5") == pytest.approx(f(-1.5), rel=1e-14)
    np.testing.assert_allclose(asked(session, f"{word} L").values, f(A), rtol=1e-14)
    np.testing.assert_allclose(asked(session, f"{word} I").values, f(INTEGERS), rtol=1e-14)
    assert_field(
        asked(session, f"{word} U"), {"UX": lambda x, y: f(UX(x, y)), "UY": lambda x, y: f(x * y)}
    )
    assert_field(
        asked(session, f"{word} C"), {"VX": lambda x, y: f(UX(x, y)), "VY": lambda x, y: f(x * y)}
    )
    parts = asked(session, f"{word} E").parts
    assert [p.abscissas.tolist() for p in parts] == [[1, 2, 4], [0, 3]]
    for part, values in zip(parts, (A, [5.0, 0.25]), strict=True):
        np.testing.assert_allclose(part.ordinates, f(np.asarray(values)), rtol=1e-14)
    for axis in ("ABSC", "ORDO") if " " not in word else ():
        (part, _), place = asked(session, f"{word} '{axis}' E").parts, np.array([1.0, 2.0, 4.0])
        both = (f(place), A) if axis == "ABSC" else (place, f(A))
        np.testing.assert_allclose((part.abscissas, part.ordinates), both, rtol=1e-14)


@pytest.mark.parametrize("sign", PAIRS)
def test_two_operands_of_all_types(session, sign):
    f = PAIRS[sign]

    def made(a, b):
        return f"ATG {a} {b}" if sign == "ATG" else f"{a} {sign} {b}"

    assert asked(session, made(7.0, -2.0)) == pytest.approx(f(7.0, -2.0), rel=1e-14)
    np.testing.assert_allclose(asked(session, made("L", "K")).values, f(A, B), rtol=1e-14)
    both_fields = sign not in ("*", "/")
    for one, two, names in (("U", "V", ("UX", "UY")), ("C", "D", ("VX", "VY"))):
        if both_fields:
            wanted = both(f, (UX, UY), (VX, VY))
            assert_field(asked(session, made(one, two)), dict(zip(names, wanted, strict=True)))
        if sign == "ATG":
            continue
        for number in (-1.25, 2):
            wanted = [lambda x, y, g=g, n=number: f(g(x, y), n) for g in (UX, UY)]
            assert_field(asked(session, made(one, number)), dict(zip(names, wanted, strict=True)))
            if sign != "/":
                wanted = [lambda x, y, g=g, n=number: f(n, g(x, y)) for g in (UX, UY)]
                found = asked(session, made(number, one))
                assert_field(found, dict(zip(names, wanted, strict=True)))
    if sign == "ATG":
        return
    for number in (-1.25, 2):
        np.testing.assert_allclose(asked(session, made("L", number)).values, f(A, number))
        np.testing.assert_allclose(asked(session, made(number, "K")).values, f(number, B))
        if sign != "/":
            np.testing.assert_array_equal(asked(session, made("I", 2)).values, f(INTEGERS, 2))
            np.testing.assert_array_equal(asked(session, made(3, "I")).values, f(3, INTEGERS))
        for part, values in zip(
            asked(session, made("E", number)).parts, (A, [5.0, 0.25]), strict=True
        ):
            np.testing.assert_allclose(part.ordinates, f(np.asarray(values), number), rtol=1e-14)


WHOLE = [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 1.25), (4.0, 0.75), (3.0, 1.5)]
EVERY = {"UX": [UX(*p) for p in WHOLE], "UY": [UY(*p) for p in WHOLE]}
VEVERY = {"UX": [VX(*p) for p in WHOLE], "UY": [VY(*p) for p in WHOLE]}
CORNERS = [[(2, 0.5), (4, 0.75), (2, 1)], [(1, 0.5), (2, 0.5), (2, 1), (1, 1.25)],
           [(4, 0.75), (3, 1.5), (2, 1)]]  # fmt: skip


def dot(one, two):
    return sum(a * b for k in one for a, b in zip(one[k], two[k], strict=True))


def in_cells(function):
    """Sum over the corners of all cells."""
    return sum(function(*p) for cell in CORNERS for p in cell)


NUMBERS = {
    "MAXI U": max(EVERY["UX"] + EVERY["UY"]), "MINI U": min(EVERY["UX"] + EVERY["UY"]),
    "MAXI U 'AVEC' (MOTS 'UX')": 1.5, "MINI U 'SANS' (MOTS 'UX')": 0.5,
    "MAXI U 'ABS' (MOTS 'UX')": 1.5, "MINI U 'ABS' 'AVEC' (MOTS 'UX')": 0.5,
    "MAXI C 'ABS' 'SANS' (MOTS 'VY')": 1.5, "MINI C": -1.5, "MAXI C": 4.5, "MINI D": 0.25,
    "MAXI L": 3.0, "MINI L": -1.0, "MAXI K 'ABS'": 4.0, "MINI L 'ABS'": 0.5,
    "MAXI I": 7, "MINI I": -2, "MINI I 'ABS'": 0, "MAXI 'ABS' K": 4.0, "MINI 'ABS' C": 0.5,
    "C MASQ 'SUPERIEUR' 'SOMME' 1.1": 9, "MAXI (C MASQ 'EXISTE' 'Q')": 0.0,
    "XTX U": dot(EVERY, EVERY), "XTY U V W W": dot(EVERY, VEVERY),
    "XTY U V (MOTS 'UX') (MOTS 'UY')": dot({"": EVERY["UX"]}, {"": VEVERY["UY"]}),
    "XTX C": in_cells(lambda x, y: UX(x, y) ** 2 + UY(x, y) ** 2),
    "XTX C C 3. -1.": in_cells(lambda x, y: 4 * (UX(x, y) ** 2 + UY(x, y) ** 2)),
    "XTX U V 2. -3.": 4 * dot(EVERY, EVERY) - 12 * dot(EVERY, VEVERY) + 9 * dot(VEVERY, VEVERY),
    "(PROG 1. 2.) EGA (PROG 1. 2.5)": False, "(PROG 1. 2.5) EGA (PROG 1. 2.)": False,
    "(PROG 1. 2.) EGA (PROG 1. 2.5) 0.5": True, "(PROG 1. 2.5) NEG (PROG 1. 2.) 0.4": True,
    "SOMM L": 2.5, "SOMM I": 8, "EXTR U 'UY' P7": 1.25, "EXTR C 'VX' 1 1 3": -0.5,
    "EXTR C 'VY' 2 1 2": 1.0, "INTG E": [1.0 - 0.5, 3 * 5.25 / 2],
    "NBNO S": 6, "NBEL S": 3, "MESU S": 0.5 + 0.625 + 0.5 * abs(-1 * 0.25 - 0.75 * -2),
    "MESU (CONT S2)": math.hypot(1, 0.75) + math.hypot(1, 0.5) + math.hypot(2, 0.25),
    "SOMM 'CUMU' L": [3.0, 2.0, 2.5], "SOMT (EXCO 'UX' U)": sum(EVERY["UX"]),
    "NORM P9": math.hypot(3, 1.5), "PSCA P9 P3": 13.125, "PMIX P9 P3": 3 * 0.75 - 1.5 * 4,
}  # fmt: skip


@together("phrase", NUMBERS)
def test_numbers_of_fields_lists_and_meshes(session, phrase):
    found = asked(session, phrase)
    if hasattr(found, "values"):
        found = found.values.tolist()
    assert found == pytest.approx(NUMBERS[phrase], rel=1e-12)
    assert isinstance(found, int) == isinstance(NUMBERS[phrase], int)


FIELDS = {
    "EXCO 'UY' U": {"SCAL": UY},
    "EXCO 'UY' U 'UX'": {"UX": UY},
    "EXCO (MOTS 'UY' 'UX') U (MOTS 'FX' 'FY')": {"FX": UY, "FY": UX},
    "EXCO 'VY' C": {"VY": UY},
    "EXCO (MOTS 'VY' 'VX') C (MOTS 'A' 'B')": {"A": UY, "B": UX},
    "NOMC (MOTS 'UY') (MOTS 'Q') U": {"UX": UX, "Q": UY},
    "NOMC (MOTS 'VX') (MOTS 'Q') C": {"Q": UX, "VY": UY},
    "ENLE U 'UX'": {"UY": UY},
    "PSCA U V W W": {"SCAL": lambda x, y: UX(x, y) * y + x * y**3},
    "PSCA U V W (MOTS 'UY' 'UX')": {"SCAL": lambda x, y: UX(x, y) * y * y + x * y * y},
    "PSCA C D Z Z": {"SCAL": lambda x, y: UX(x, y) * y + x * y**3},
    "PVEC U W W": {"UX": lambda x, y: -x * y, "UY": UX},
    "PVEC C Z Z": {"VX": lambda x, y: -x * y, "VY": UX},
    "COLI U 2. V -3.": {k: lambda x, y, a=a, b=b: 2 * a(x, y) - 3 * b(x, y)
                        for k, a, b in (("UX", UX, VX), ("UY", UY, VY))},
    "U ET (NOMC 'T' X)": {"UX": UX, "UY": UY, "T": lambda x, y: x},
    "(EXCO 'UX' U) ** 2": {"SCAL": lambda x, y: UX(x, y) ** 2},
    "(NOMC 'T' Y) ** -0.5": {"T": lambda x, y: y**-0.5},
    "(EXCO 'VX' C) ** 3": {"VX": lambda x, y: UX(x, y) ** 3},
    "CY ** 0.5": {"SCAL": lambda x, y: y**0.5},
    "INVE Y": {"SCAL": lambda x, y: 1 / y},
    "X * Y": {"SCAL": UY},
    "X / Y": {"SCAL": lambda x, y: x / y},
    "CX * CY": {"SCAL": UY},
    "CX / CY": {"SCAL": lambda x, y: x / y},
    "U * Y": {"UX": lambda x, y: UX(x, y) * y, "UY": lambda x, y: x * y * y},
    "C * CY": {"VX": lambda x, y: UX(x, y) * y, "VY": lambda x, y: x * y * y},
    "12. / V": {"UX": lambda x, y: 12 / y, "UY": lambda x, y: 12 / y**2},
    "1. / D": {"VX": lambda x, y: 1 / y, "VY": lambda x, y: 1 / y**2},
    "V ** 2": {"UX": lambda x, y: y**2, "UY": lambda x, y: y**4},
    "D + 10. (MOTS 'VX')": {"VX": lambda x, y: y + 10, "VY": lambda x, y: y * y},
    "C * D": {"VX": lambda x, y: UX(x, y) * y, "VY": lambda x, y: x * y**3},
    "C * D (MOTS 'VX') (MOTS 'VY') (MOTS 'A')": {"A": lambda x, y: UX(x, y) * y * y},
    "BORN C 'VX' 'MAXIMUM' 1.": {"VX": lambda x, y: np.minimum(UX(x, y), 1)},
    "C / CY": {"VX": lambda x, y: UX(x, y) / y, "VY": lambda x, y: x},
    "MASQ X 'SUPERIEUR' 2.": {"SCAL": lambda x, y: x > 2},
    "X MASQ 'EGSUPE' 2.": {"SCAL": lambda x, y: x >= 2},
    "X MASQ 'INFERIEUR' 2.": {"SCAL": lambda x, y: x < 2},
    "X MASQ 'EGINFE' 2.": {"SCAL": lambda x, y: x <= 2},
    "X MASQ 'EGALE' 2.": {"SCAL": lambda x, y: x == 2},
    "X MASQ 'DIFFERENT' 2.": {"SCAL": lambda x, y: x != 2},
    "X MASQ 'COMPRIS' 2. 3.": {"SCAL": lambda x, y: (x >= 2) & (x <= 3)},
    "CX MASQ 'SUPERIEUR' 2.": {"SCAL": lambda x, y: x > 2},
    "CX MASQ 'EGINFE' 2.": {"SCAL": lambda x, y: x <= 2},
    "CX MASQ 'COMPRIS' 2. 3.": {"SCAL": lambda x, y: (x >= 2) & (x <= 3)},
    "MAXI U V": {"UX": lambda x, y: np.maximum(UX(x, y), y),
                 "UY": lambda x, y: np.maximum(x * y, y * y)},
    "MINI U V": {"UX": lambda x, y: np.minimum(UX(x, y), y),
                 "UY": lambda x, y: np.minimum(x * y, y * y)},
    "BORN U 'UX' 'COMPRIS' -1. 1.": {"UX": lambda x, y: np.clip(UX(x, y), -1, 1)},
    "COOR 2 U": {"SCAL": lambda x, y: y},
    "COOR 1 C": {"SCAL": lambda x, y: x},
    "REDU U S2": {"UX": UX, "UY": UY},
    "REDU C S2": {"VX": UX, "VY": UY},
    "CHAN 'CHPO' M CX": {"SCAL": lambda x, y: x},
    "VARI X (EVOL 'MANU' 'T' (PROG 0. 2. 4.) 'Q' (PROG 1. 5. 4.))": {
        "Q": lambda x, y: np.interp(x, [0, 2, 4], [1, 5, 4])},
    "IPOL X (PROG 0. 2. 4.) (PROG 1. 5. 4.)": {
        "SCAL": lambda x, y: np.interp(x, [0, 2, 4], [1, 5, 4])},
    "PROI (P1 ET P9) CX": {"SCAL": lambda x, y: x},
}  # fmt: skip


@together("phrase", FIELDS)
def test_fields_of_fields(session, phrase):
    assert_field(asked(session, phrase), FIELDS[phrase])


LISTS = {
    "L ET K": [*A, *B], "2. ET L": [2.0, *A], "I ET 4": [3, -2, 0, 7, 4], "L ** 2": A**2,
    "ORDO L": sorted(A), "ORDO L 'DECROISSANT'": sorted(A)[::-1], "ORDO I": [-2, 0, 3, 7],
    "ENLE L 2": [3.0, 0.5], "INSE L 2 9.": [3.0, 9.0, -1.0, 0.5], "EXTR L (LECT 3 1)": [0.5, 3.0],
    "INVE L": [0.5, -1.0, 3.0], "I - 1": [2, -3, -1, 6], "MASQ L 'SUPERIEUR' 0.": [1, 0, 1],
    "MASQ I 'EGINFE' 0": [0, 1, 1, 0], "IPOL (PROG 3. -1. 0.5) (PROG -2. 0. 4.) (PROG 1. 2. 10.)":
    [8.0, 1.5, 3.0], "MAXI L K": np.maximum(A, B),
    "MINI L K": np.minimum(A, B), "ENTI L": [3, -1, 0], "FLOT I": [3.0, -2.0, 0.0, 7.0],
    "EXTR E 'ORDO' 2": [5.0, 0.25], "EXTR E 'ABSC' 1": [1.0, 2.0, 4.0],
    "EXTR (PRIM E) 'ORDO' 1": [0.0, 1.0, 0.5],
    "PROG 3. PAS -0.5 1.5": [3.0, 2.5, 2.0, 1.5], "LECT 5 PAS -2 1 3 * 4": [5, 3, 1, 4, 4, 4],
    "RAFF L 2": [3.0, 1.0, -1.0, -0.25, 0.5], "BORN L 'COMPRIS' -0.5 1.": [1.0, -0.5, 0.5],
    "BORN I 'MAXIMUM' 2": [2, -2, 0, 2],
    "EXTR (1. - E) 'ORDO' 2": [-4.0, 0.75], "EXTR (E * E) 'ORDO' 1": A**2,
    "EXTR (E ** 2) 'ORDO' 1": A**2, "(LECT 4 5) - (PROG 1.5 1.)": [2.5, 4.0],
    "EXTR (ORDO (EVOL 'MANU' L K)) 'ORDO'": [2.0, -4.0, 0.25],
    "UNIQ (LECT 4 1 4 2 1)": [4, 1, 2], "I SAUF (LECT 0 3)": [-2, 7],
    "INTE (PROG 3. 1. 2.) (PROG 2. 3. 9.)": [3, 2],
    "POSI 0.5 'DANS' L": 3, "EXTR (L ET 7.) 4": 7.0, "DIME I": 4,
}  # fmt: skip


@together("phrase", LISTS)
def test_lists_of_lists_and_curves(session, phrase):
    found = asked(session, phrase)
    found = found.values if hasattr(found, "values") else found
    np.testing.assert_allclose(found, LISTS[phrase], rtol=1e-14, atol=1e-15)


@together("group", LISTED["printed"])
def test_objects_are_listed_as_they_are(group, tmp_path):
    output = io.StringIO()
    session = session_after(PRELUDE + LISTED["before"], tmp_path, output)
    for phrase, wanted in LISTED["printed"][group].items():
        begin = output.tell()
        execute(session, Source("statement", f"LIST {phrase} ;"))
        script_runs.assert_says(output.getvalue()[begin:], wanted)


def test_a_long_list_loses_its_middle_alone(tmp_path):
    output = io.StringIO()
    text = "N = PROG 1. 'PAS' 1. {} ; LIST (EVOL 'MANU' N (2. * N)) ;"
    session_after(text.format("200."), tmp_path, output)
    _, *kept, last = output.getvalue().split("ordinate")[1].splitlines()
    assert (len(kept), last.split()) == (199, ["2.00000E+02", "4.00000E+02"])
    output = io.StringIO()
    session_after(text.format("205."), tmp_path, output)
    rows = output.getvalue().split("ordinate")[1].splitlines()[1:]
    told = re.search(r"\d+", rows.pop(100))
    assert told is not None
    assert int(told.group()) == 5
    assert [float(r.split()[0]) for r in rows] == [*range(1, 101), *range(106, 206)]

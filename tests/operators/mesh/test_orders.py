"""Meshing operators read their operands and words in whatever order they stand."""

from typing import Any

from script_runs import ran
from together import together

from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.values import Table

PLANE = (
    "OPTI DIME 2 ELEM QUA4 DENS 0.4 ; O = 0. 0. ; A = 1. 0. ; B = 1. 1. ; C = 0. 1. ; P = 2. 1. ; "
    "V = 0. 1. ; L = DROI 2 O A ; M = DROI 2 C B ; K = QUEL 'SEG2' O C (0. 2.) ; "
    "S = L TRAN 2 V ; S1 = S ELEM 1 ; F = COOR 1 S ; G = L POIN 2 ; W = CHAN 'TRI3' S ; "
)
SPACE = (
    "OPTI DIME 3 ELEM CUB8 DENS 0.4 ; O = 0. 0. 0. ; A = 1. 0. 0. ; C = 0. 1. 0. ; Z = 0. 0. 1. ; "
    "X1 = -1. 0. 0. ; Y1 = -1. 1. 0. ; L = DROI 2 O A ; S = L TRAN 2 C ; T = S PLUS Z ; "
    "G = DROI 3 O Z ; W = CHAN 'TRI3' S ; "
)


def plain(value: Any) -> Any:
    """What an object holds, whatever the numbers of its nodes."""
    if isinstance(value, Point):
        return value.coordinates.round(9).tolist(), round(value.density, 9)
    if isinstance(value, Mesh):
        return [
            (b.cell_type, b.coordinates.round(9).tolist(), b.colours.tolist()) for b in value.blocks
        ]
    if isinstance(value, NodeField):
        return {k: p.values.round(9).tolist() for k, p in value.components.items()}
    if isinstance(value, CellField):
        return [{k: v.tolist() for k, v in b.components.items()} for b in value.blocks]
    if isinstance(value, Table):
        return [plain(v) for _, v in value.items()]
    return value if isinstance(value, bool | int | float) else str(getattr(value, "values", value))


def result(base: str, phrase: str) -> Any:
    return plain(ran(f"{base}R = {phrase} ;").session.root.find("R"))


SAME_IN_THE_PLANE = """
DROI 4 O A 'DINI' 0.1 | DROI 'DINI' 0.1 O 4 A | O DROI 'DINI' 0.1 A 4
DROI 3 L P | L DROI P 3 | L P DROI 3
CERC 4 A O C | A CERC 'CENTR' O C 4 | CERC A 'CENTR' 4 O C
CERC 4 'PASS' A B C | CERC 'PASS' A B 4 C
CERC 4 'ROTA' 90. A O | CERC 'ROTA' 4 90 A O | A CERC 'ROTA' 90. O 4 | A O CERC 4 90 'ROTA'
CERC 'ROTA' 90 A O | CERC 90. A O 'ROTA'
CERC 'DINI' 0.1 'ROTA' 90. A O 'DFIN' 0.2 | CERC 'ROTA' 'DFIN' 0.2 90. A 'DINI' 0.1 O
LIGN 'ROTA' 4 O A 90. | LIGN 4 O A 90. 'ROTA' | LIGN 'ROTA' O 4 A 90
LIGN 'TRAN' 4 O V 'DINI' 0.1 | LIGN 4 O V 'DINI' 0.1 'TRAN' | O LIGN 'DINI' 0.1 'TRAN' 4 V
QUEL 'SEG2' O A B | O A QUEL B 'SEG2'
CUBP 5 O A B C 'UNIF' | O CUBP 'UNIF' A B 5 C
COUR 5 O A V 'PARA' 0 2 | COUR 'PARA' 0. 2. 5 O A V | O COUR A 'PARA' 0. 2. V 5
COUR 5 'PINI' O O A V | COUR 5 O A V 'PINI' O
L TRAN 3 V | TRAN V 3 L | L V TRAN 3
L TRAN -3 'DINI' 0.1 V | L TRAN V 'DINI' 0.1 -3
L ROTA 8 90. P | L P ROTA 90. 8 | ROTA L 8 90 P
L REGL 3 M | L M REGL 3 | REGL L M 3
DALL 'PLAN' L (COTE 2 S) (COTE 3 S) (COTE 4 S) | DALL L (COTE 2 S) (COTE 3 S) 'PLAN' (COTE 4 S)
SURF 'PLAN' (CONT S) 1E-2 | (CONT S) SURF 1E-2 | (CONT S) SURF 'PLAN' 1E-2
COTE 2 S | S COTE 2
L POIN 2 | POIN 2 L
POIN 1. 2. 'DENS' 0.1 | POIN 'DENS' 0.1 1. 2.
S POIN 'DROI' O C 1E-3 | POIN 'DROIT' O C 1E-3 S | S POIN 1E-3 'DROI' O C
S POIN 'PROC' P | POIN 'PROC' P S
F POIN 'COMP' 0.2 0.6 'ABS' | POIN 'ABS' F 'COMP' 0.2 0.6
S ELEM 'QUA4' 2 | ELEM 'QUA4' 2 S | S ELEM 2 'QUA4'
S ELEM 'QUA4' 'COUL' 1 | S ELEM 'COUL' 1 'QUA4'
S ELEM 'CONT' (0.2 0.2) | ELEM 'CONT' (0.2 0.2) S
S ELEM 'APPU' 'LARG' L | S ELEM 'APPU' L 'LARG' | ELEM 'APPU' 'LARG' L S | S L ELEM 'APPU' 'LARG'
S ELEM 'APPU' 'LARG' O | O S ELEM 'APPU' 'LARG' | ELEM 'APPU' 'LARG' O S
L ELEM 'COMP' G A | ELEM 'COMP' G A L | L G A ELEM 'COMP'
S INTE S1 | INTE S S1 | S S1 INTE
P PLUS V | PLUS P V | P V PLUS
L PLUS V | V PLUS L | PLUS V L
P TOUR 90. O | TOUR 90 P O | P O TOUR 90.
P SYME 'DROIT' O A | SYME 'DROIT' P O A
P HOMO 3. O | HOMO 3 P O | P HOMO O 3
P AFFI 3. O V | AFFI P O V 3
P PROJ V 'DROI' O A | PROJ P V 'DROI' O A | P PROJ 'CYLI' V 'DROI' O A
O DEDU 'TRAN' L M | O L M DEDU 'TRAN' | O DEDU L M 'TRAN'
L DEDU 'ROTA' 90. O L M | L DEDU 90 O 'ROTA' L M
COOR 1 O | O COOR 1 | COOR O 1
COOR 'CURV' L | COOR L 'CURV' | COOR 1 L 'CURV'
A PSCA B | PSCA A B
CONT 'NOID' 'INTE' S | S CONT 'INTE' 'NOID'
ORIE S 'POINT' P | S ORIE P 'POINT'
CHAN 'POI1' S | CHAN S 'POI1' | S CHAN 'POI1'
MANU 'TRI3' ROUG O A B | MANU 'TRI3' O A B ROUG | O MANU TRI3 A ROUG B
S COUL 3 | COUL S ROUG | COUL ROUG S
INDI 'PLAN' S | S INDI 'PLAN'
INDI 'TOPO' W 1 'LISTREEL' | INDI W 'TOPO' 'LISTREEL' 1.
PART 'NESC' 'CONN' S | PART 'CONN' S 'NESC' | S PART 'CONN' 'NESC'
PART 'SEPA' S 'MAIL' L 'FACE' | PART 'SEPA' 'FACE' 'MAIL' L S
NBEL S (MOTS 'QUA4') | NBEL (MOTS 'QUA4') S
MESU 'DENS' S | S MESU 'DENS'
"""

SAME_IN_SPACE = """
S VOLU 3 'TRAN' Z | VOLU 'TRAN' Z S 3 | S VOLU 'TRAN' 3 Z
S VOLU 'DINI' 0.1 'TRAN' Z 'DFIN' 0.3 | S VOLU 'TRAN' 'DFIN' 0.3 Z 'DINI' 0.1
S VOLU 3 'ROTA' 90. X1 Y1 | S VOLU 'ROTA' 3 90 X1 Y1 | S X1 VOLU 90. 'ROTA' 3 Y1
S VOLU 'GENE' G | VOLU 'GENE' G S | S VOLU 3 'GENE' G
S VOLU 3 T | S T VOLU 3 | VOLU S T 3
S VOLU 1 Z | S VOLU 1. Z | Z VOLU S 1.
O TOUR 90. A C | TOUR O 90 A C
L PROJ 'CYLI' (1. 1. 0.) 'CYLI' O Z C | L PROJ (1. 1. 0.) 'CYLI' O Z C
A INTE 8 'CYLI' O Z 'PLAN' X1 C | A C INTE 'CYLI' O Z 'PLAN' X1 8 | INTE A 'CYLI' O Z 8 'PLAN' X1 C
"""


def _cases() -> list[Any]:
    rows = [(PLANE, row) for row in SAME_IN_THE_PLANE.strip().split("\n")]
    rows += [(SPACE, row) for row in SAME_IN_SPACE.strip().split("\n")]
    return [(base, row.split(" | ")) for base, row in rows]


@together("base, phrases", _cases())
def test_orders_give_the_same(base: str, phrases: list[str]) -> None:
    first, *others = (result(base, phrase) for phrase in phrases)
    assert others == [first] * (len(phrases) - 1)


MOTIONS = """
DEPL P 'PLUS' V | P DEPL 'PLUS' V | DEPL 'PLUS' P V
DEPL P 'TOUR' 90. O | DEPL P 'TOUR' O 90
DEPL P 'SYME' 'DROIT' O B | P DEPL 'SYME' 'DROIT' O B | DEPL 'SYME' 'DROIT' P O B
DEPL P 'PROJ' V 'DROI' O A | DEPL P 'PROJ' 'CYLI' V 'DROI' O A
"""


@together("row", MOTIONS.strip().split("\n"))
def test_points_move_alike_whatever_the_order(row: str) -> None:
    first, *others = (result(f"{PLANE}{motion} ;", "P") for motion in row.split(" | "))
    assert others == [first] * len(others)
    assert first != result(PLANE, "P")
    assert result(f"{PLANE}Q = {row.split(' | ')[0]} ;", "Q") == first

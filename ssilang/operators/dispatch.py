"""Operators that several families share: one name, forms by the type of an operand or by a word.

A family adds its forms with the decorator `form`; help texts and examples add up.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from ssilang.language.filled import Filled
from ssilang.language.registry import (
    ANY,
    Help,
    Operator,
    arg,
    flag,
    operator,
    opt,
    shared,
)
from ssilang.language.run.call import Call
from ssilang.language.say.errors import SsiError
from ssilang.language.values import ListMots, ListObje, Mot, type_of
from ssilang.messages.message import Teller

if TYPE_CHECKING:
    from ssilang.language.text.source import Span


def shared_operator(
    name: str,
    family: str,
    en: str,
    full_name: str = "",
    terminal: bool = False,
    examples: tuple[str, ...] = (),
    syntax: str = "",
) -> Operator:
    """An operator whose forms stand in several families; `form` adds one (see `Operator.form`)."""
    help = Help(en, syntax, examples)
    return shared(name, family, help, full_name=full_name, terminal=terminal)


EXTR = shared_operator(
    "EXTR",
    "objects",
    "Takes a part out of an object.",
    "EXTRAIRE",
    terminal=True,
    examples=(
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; P = 0. 0. ;\n"
            "C = MANU 'CHPO' P 'UX' 3. 'UY' 4. ;\n"
            "LIST (NBNO (EXTR C 'MAIL')) ; LIST (EXTR C 'COMP') ; LIST (EXTR C 'TITR') ;\n"
            "LIST (EXTR C 'TYPE') ; LIST (EXTR C 'NATU') ;"
        ),
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "M = MODE ((DROI 2 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE'\n"
            "'CONS' 'SOIL' ;\n"
            "LIST (NBEL (EXTR M 'MAIL')) ; LIST (TYPE (EXTR M 'ZONE')) ;\n"
            "LIST (TYPE (EXTR M 'FORM' 'MECANIQUE')) ;\n"
            "LIST (TYPE (EXTR M 'CONS' 'SOIL')) ;\n"
            "LIST (TYPE (EXTR M 'ELEM' 'QUA4')) ;\n"
            "LIST (TYPE (EXTR M 'COMP' 'ELASTIQUE')) ;\n"
            "LIST (EXTR M 'DEPL') ; LIST (EXTR M 'FORC') ; LIST (EXTR M 'DEFO') ;\n"
            "LIST (EXTR M 'CONT') ;\n"
            "LIST (EXTR M 'GRAD') ; LIST (EXTR M 'MATE') ; LIST (EXTR M 'GEOM') ;\n"
            "LIST (EXTR M 'VARI') ;\n"
            "LIST (EXTR M 'TEMP') ; LIST (EXTR M 'CONP') ; LIST (EXTR M 'PARA') ;\n"
            "LIST (EXTR M 'PHAS') ;\n"
            "LIST (EXTR M 'NLOC') ; LIST (EXTR M 'GRAF') ;"
        ),
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "M = MODE ((DROI 2 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "C = MANU 'CHML' M 'SCAL' 3. 'TYPE' 'SCALAIRE' ; LIST (EXTR C 'SCAL' 1 2 1) ;\n"
            "LIST (EXTR C 'TITR') ; LIST (EXTR C 'TYPE') ; LIST (NBEL (EXTR C 'MAIL')) ;\n"
            "LIST (EXTR C 'COMP') ; LIST (EXTR C 'CONS') ; LIST (EXTR C 'NBZO') ;\n"
            "LIST (EXTR C 'COVA') ; LIST (EXTR C 'DEVA') ;"
        ),
        (
            "N = NUAG 'COMP' 'X' 2. 'COMP' 'Y' 5. ; LIST (EXTR N 'Y') ;\n"
            "LIST (EXTR 'VELOCITY' 1 4) ; LIST (EXTR (MOTS 'UX' 'UY') 2) ;"
        ),
        (
            "OPTI DIME 2 ; P = 0. 0. ;\n"
            "K = (APPU 'UX' 4. P) ET (APPU 'UY' 3. P) ET (BLOQ 'UX' P) ;\n"
            "LIST (NBNO (EXTR K 'MAIL')) ; LIST (TYPE (EXTR K 'RIGI' 'NOMU')) ;\n"
            "LIST (EXTR K 'COMP') ;\n"
            "LIST (TYPE (EXTR K 'SYME')) ; LIST (TYPE (EXTR K 'ANTI')) ;\n"
            "LIST (EXTR (EXTR K 'UX' 'FX') 'COMP') ;\n"
            "LIST (EXTR (EXTR K (MOTS 'UY') (MOTS 'FY')) 'COMP') ;"
        ),
        (
            "OPTI DIME 2 ; P = 0. 0. ; F = FORC (0. -3.) P ;\n"
            "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;\n"
            "C = (CHAR 'MECA' F E) ET (CHAR 'DIMP' F E) ;\n"
            "LIST (EXTR C 'COMP') ; LIST (DIME (EXTR C 'CHAR' 2)) ;\n"
            "LIST (MINI (EXTR C 'CHAM' 1)) ;\n"
            "LIST (TYPE (EXTR C 'EVOL' 1)) ; LIST (DIME (EXTR C 'DIMP')) ;\n"
            "LIST (DIME (EXTR C (MOTS 'MECA' 'DIMP'))) ;\n"
            "LIST (TYPE (EXTR C 'LIBR')) ; LIST (TYPE (EXTR C 'LIE')) ;"
        ),
        (
            "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;\n"
            "S = ((0. 0.) DROI 8 (4. 0.)) TRAN 2 (0. 1.) ;\n"
            "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ;\n"
            "R = (RIGI MO (MATE MO 'YOUN' 1.E3 'NU' 0.3)) ET (BLOQ 'DEPL' (COTE 4 S)) ;\n"
            "SU = SUPE 'RIGI' R (COTE 2 S) ; LIST (NBNO (EXTR SU 'ELEM')) ;\n"
            "LIST (TYPE (EXTR SU 'RIGT')) ;"
        ),
        (
            "N = NUAG 'COMP' 'X' 0. 1. 2. 'COMP' 'Y' 5. 6. 9. ;\n"
            "LIST (EXTR N 'COMP') ; LIST (EXTR N 'MAXI' 'Y') ; LIST (EXTR N 'MINI' 'Y') ;\n"
            "LIST (EXTR N 'INFE' 'Y' 6.5) ; LIST (EXTR N 'SUPE' 'Y' 6.5) ;\n"
            "LIST (EXTR N 'ENTR' 'Y' 5.5 7.) ;"
        ),
        (
            "LIST (EXTR 'VELOCITY' (LECT 1 3 5)) ; LIST (EXTR (LECT 4 5 6) (LECT 1 3)) ;\n"
            "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'T' 3. ;\n"
            "LIST (MAXI (EXTR (SUIT C C) 2)) ; LIST (EXTR (ENUM 7 8) 2) ;\n"
            "T = EXTR 'POINT' ; LIST (DIME T) ;"
        ),
        (
            "A = EVOL 'ROUG' 'MANU' 'TIME' (PROG 0. 1. 3.) 'UX' (PROG 5. 6. 8.) ;\n"
            "B = EVOL 'BLEU' 'MANU' 'TIME' (PROG 0. 1. 3.) 'UY' (PROG 7. 7. 9.) ; C = A ET B ;\n"
            "LIST (EXTR C 'ABSC' 2) ; LIST (EXTR C 'UY') ;\n"
            "LIST (EXTR C 'COUR' 2) ; LIST (DIME (EXTR C 'COUR' 'TIME')) ;\n"
            "LIST (EXTR A 'PAS' 2) ; LIST (EXTR A 'AVAN' 1.) ;\n"
            "LIST (EXTR A 'COMP' 'INDI' 2 3 'ZERO') ;\n"
            "LIST (EXTR A 'LEGX') ; LIST (EXTR C 'LEGY' 2) ; LIST (EXTR A 'LEGE') ;\n"
            "LIST (EXTR C 'COUL') ;"
        ),
    ),
)
DIME = shared_operator(
    "DIME",
    "objects",
    "Number of items of a list, table, word, curve ...",
    "DIMENSION",
    examples=(
        (
            "LIST (DIME (EVOL 'MANU' (PROG 0. 1.) (PROG 3. 4.))) ;\n"
            "N = NUAG 'COMP' 'X' 0. 1. 2. 'COMP' 'Y' 5. 6. 9. ;\n"
            "MESS (DIME N 'COMP') (DIME N 'UPLE') ;\n"
            "OPTI DIME 2 ; P = 0. 0. ; F = FORC (0. -3.) P ;\n"
            "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;\n"
            "LIST (DIME (CHAR 'MECA' F E)) ;"
        ),
        "LIST (DIME (PROG 1. 2. 3.)) ;",
    ),
    syntax="ENTI1 = DIME OBJ1 ;",
)
ENLE = shared_operator(
    "ENLE",
    "objects",
    "Removes items; gives a new object.",
    "ENLEVER",
    examples=(
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\n"
            "L = DROI 2 (0. 0.) (1. 0.) ; N = DROI 2 (0. 0.) (1. 0.) ;\n"
            "M = (MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR') ET (MODE L 'CHARGEMENT'\n"
            "'PRESSION') ;\n"
            "LIST (NBEL (EXTR (ENLE M 'FORM' 'CHARGEMENT') 'MAIL')) ;"
        ),
        (
            "OPTI DIME 2 ; P = 0. 0. ; F = FORC (0. -3.) P ;\n"
            "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;\n"
            "C = (CHAR 'MECA' F E) ET (CHAR 'DIMP' F E) ; LIST (DIME (ENLE C 'DIMP')) ;"
        ),
    ),
)
REDU = shared_operator(
    "REDU",
    "fields",
    "Restricts an object to a smaller support.",
    "REDUIRE",
    examples=(
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "A = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ;\n"
            "B = (DROI 1 (1. 0.) (2. 0.)) TRAN 1 (0. 1.) ;\n"
            "M = MODE (A ET B) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "X = COOR 1 (MANU 'CHML' M 'SCAL' 1.) ;\n"
            "N = REDU M A ; LIST (NBEL (EXTR N 'MAIL')) ;\n"
            "LIST (MAXI (REDU X A)) ; LIST (TYPE (REDU M X)) ;\n"
            "R = REDU (RIGI M (MATE M 'YOUN' 1. 'NU' 0.)) A ;\n"
            "LIST (NBEL (EXTR R 'MAIL')) ;"
        ),
        ("N = NUAG 'COMP' 'X' 0. 1. 2. 'COMP' 'Y' 5. 6. 9. ;\nLIST (DIME (REDU N 'Y') 'COMP') ;"),
    ),
)
MANU = shared_operator(
    "MANU",
    "objects",
    "Makes an object from its parts, named by a keyword.",
    "MANUEL",
    examples=(
        (
            "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P (MOTS 'UX' 'UY') (PROG 3. 4.) ;\n"
            "LIST C ;\n"
            "K = MANU 'RIGI' C 'DIAG' ; LIST (EXTR K 'DIAG') ;\n"
            "R = MANU 'RIGI' C 'COLO' 'QUEL' P 'UX' ; LIST (EXTR R 'COMP') ;"
        ),
        (
            "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ;\n"
            "C = MANU 'CHPO' P 'FX' 3. 'NATURE' 'DISCRET' ;\n"
            "R = MANU 'RIGI' (SUIT C) (MANU 'POI1' Q) ; LIST (EXTR R 'COMP') ;"
        ),
    ),
)
CHAN = shared_operator(
    "CHAN",
    "objects",
    "Changes an object in a way named by a keyword.",
    "CHANGER",
    examples=(
        (
            "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'T' 3. ;\n"
            "D = MANU 'CHPO' P 'UX' 3. 'UY' 4. ;\n"
            "LIST (EXTR (CHAN 'COMP' 'U' C) 'COMP') ;\n"
            "LIST (EXTR (CHAN 'COMP' (MOTS 'UX' 'UY') (MOTS 'FX' 'FY') D) 'COMP') ;\n"
            "LIST (EXTR (CHAN 'TITR' C 'heat') 'TITR') ;"
        ),
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "M = MODE ((DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "C = MANU 'CHML' M 'SCAL' 3. ;\n"
            "LIST (EXTR (CHAN 'TYPE' C 'NUMBERS') 'TYPE') ;\n"
            "LIST (EXTR (CHAN 'CONS' C 'PART') 'CONS') ;"
        ),
        (
            "OPTI DIME 2 ; P = 0. 0. ; K = APPU 'UX' 4. P ;\n"
            "R = CHAN 'TYPE' K 'MASSE' ; LIST (EXTR R 'DIAG') ;\n"
            "R = CHAN 'INCO' K 'UX' 'UY' 'FX' 'FY' ; LIST (EXTR R 'COMP') ;\n"
            "R = CHAN 'INCO' K (MOTS 'UX') (MOTS 'UZ') (MOTS 'FX') (MOTS 'FZ') ;\n"
            "LIST (EXTR R 'COMP') ;\n"
            "R = CHAN 'INCO' K 'COMP' ; LIST (EXTR R 'COMP') ;\n"
            "L = K ET (RELA 'UX' P '-' 'UY' P) ; R = CHAN 'DEPE' L ; LIST (TYPE R) ;"
        ),
        (
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; M = CHAN 'POI1' L ;\n"
            "LIST (NBEL M) ;\n"
            "N = CHAN 'LIGN' L ; LIST (NBEL N) ;"
        ),
        (
            "OPTI DIME 2 ; P = 0. 0. ; F = FORC (0. -3.) P ;\n"
            "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;\n"
            "C = CHAN 'TABL' (CHAR 'MECA' F E) 'MECA' ; LIST (TIRE C 0.5 'MECA') ;"
        ),
        (
            "OPTI DIME 2 ELEM SEG2 ;\n"
            "P = (MANU 'POI1' (0. 0.)) ET (MANU 'POI1' (1. 0.)) ET (MANU 'POI1' (2. 0.))\n"
            ";\n"
            "L = CHAN P (LECT 1 2 2 3) ; LIST (NBEL L) ;"
        ),
    ),
)
MAXI = shared_operator(
    "MAXI",
    "fields",
    "Largest value of a list, field or curve.",
    "MAXIMUM",
    examples=(
        (
            "LIST (MAXI (PROG 1. 5.) (PROG 3. 2.)) ;\n"
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; P = 0. 0. ;\n"
            "LIST (MAXI (MANU 'CHPO' P 'T' 3.) (MANU 'CHPO' P 'T' 4.)) ;\n"
            "M = MODE ((DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "LIST (MAXI (COOR 1 (MANU 'CHML' M 'SCAL' 1.))) ;"
        ),
    ),
)
MINI = shared_operator(
    "MINI",
    "fields",
    "Smallest value of a list, field or curve.",
    "MINIMUM",
    examples=(
        (
            "LIST (MINI (PROG 1. 5.) (PROG 3. 2.)) ;\n"
            "N X Y = MINI (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 3. 9. 1.)) ; LIST Y ;\n"
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; P = 0. 0. ;\n"
            "LIST (MINI (MANU 'CHPO' P 'T' 3.) (MANU 'CHPO' P 'T' 4.)) ;\n"
            "M = MODE ((DROI 2 (1. 0.) (2. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "LIST (MINI (COOR 1 (MANU 'CHML' M 'SCAL' 1.))) ;"
        ),
    ),
)
COPI = shared_operator(
    "COPI",
    "objects",
    "Copy of an object.",
    "COPIER",
    examples=(
        (
            "E = EVOL 'MANU' (PROG 0. 1.) (PROG 3. 4.) ; F = COPI E ;\n"
            "LIST (EXTR F 'ORDO') ;\n"
            "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'T' 3. ; D = COPI C ;\n"
            "LIST (MAXI D) ;"
        ),
    ),
)
ORDO = shared_operator(
    "ORDO",
    "objects",
    "Sorts the items of an object.",
    "ORDONNER",
    examples=(
        (
            "L M = ORDO (PROG 3. 1. 2.) (LECT 30 10 20) ; LIST L ; LIST M ;\n"
            "X L = ORDO (LECT 10 20) 'COUT' (PROG 5. 1. 1. 5.) ; LIST X ; LIST L ;\n"
            "T = TABL ; T . 'A' = PROG 3. 1. 2. ; T . 'B' = PROG 0.3 0.1 0.2 ;\n"
            "T = ORDO T 'A' 'DECR' ; LIST (T . 'B') ;"
        ),
        (
            "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; B = 1. 0. ; C = 2. 0. ;\n"
            "L = ORDO ((DROI 1 B C) ET (DROI 1 A B)) ; LIST (COOR 1 (L POIN 'FINA')) ;"
        ),
    ),
)

COUL = shared_operator("COUL", "objects", "Gives a colour.", "COULEUR")
INVE = shared_operator("INVE", "objects", "Inverts an object.", "INVERSE")
UNIQ = shared_operator(
    "UNIQ",
    "objects",
    "Removes doubles.",
    "UNIQUE",
    examples=(
        ("OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (1. 0.) ;\nLIST (NBEL (UNIQ (L ET L))) ;"),
    ),
)
INTG = shared_operator("INTG", "fields", "Integral of a field or a curve.")

PSCA = shared_operator(
    "PSCA",
    "fields",
    "Scalar product.",
    "PSCAL",
    examples=(
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "M = MODE ((DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "C = MANU 'CHML' M 'VX' 3. 'VY' 4. ; L = MOTS 'VX' 'VY' ;\n"
            "LIST (MAXI (PSCA C C L L)) ;"
        ),
    ),
)
PVEC = shared_operator(
    "PVEC",
    "fields",
    "Vector product.",
    examples=(
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "M = MODE ((DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "C = MANU 'CHML' M 'VX' 3. 'VY' 4. ; L = MOTS 'VX' 'VY' ;\n"
            "LIST (MAXI (EXCO 'VX' (PVEC C L L))) ;"
        ),
        (
            "OPTI DIME 3 ELEM TRI3 ; P = 0 0 0 ; L = MOTS 'UX' 'UY' 'UZ' ;\n"
            "A = MANU 'CHPO' P 3 'UX' 1. 'UY' 0. 'UZ' 0. ;\n"
            "B = MANU 'CHPO' P 3 'UX' 0. 'UY' 2. 'UZ' 0. ;\n"
            "LIST (PVEC A B L L L) ;\n"
            "M = MODE (MANU 'TRI3' P (1 0 0) (0 1 0)) 'MECANIQUE' 'ELASTIQUE' 'DKT' ;\n"
            "A = MANU 'CHML' M 'UX' 1. 'UY' 0. 'UZ' 0. ;\n"
            "B = MANU 'CHML' M 'UX' 0. 'UY' 2. 'UZ' 0. ;\n"
            "LIST (MAXI (EXCO 'UZ' (PVEC A B L L L))) ;\n"
            "V = PVEC (1 0 0) (0 2 0) ; LIST (COOR 3 V) ;"
        ),
    ),
)
COOR = shared_operator(
    "COOR",
    "mesh",
    "Coordinates of what an object stands on.",
    "COORDONNEE",
    examples=(
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ;\n"
            "M = MODE S 'MECANIQUE' 'ELASTIQUE' ;\n"
            "F = MANU 'CHPO' S 1 'T' 1. ; C = MANU 'CHML' M 'SCAL' 1. ;\n"
            "X = COOR 1 (0.5 3.) ; MESS X ;\n"
            "MESS (MAXI (COOR 1 F)) (MAXI (COOR 2 M)) ;\n"
            "X Y = COOR S ; MESS (MAXI X) (MAXI Y) ;\n"
            "X Y = COOR F ; MESS (MAXI X) (MAXI Y) ;\n"
            "X Y = COOR M ; MESS (MAXI X) (MAXI Y) ;\n"
            "X Y = COOR C ; MESS (MAXI X) (MAXI Y) ;"
        ),
        ("OPTI DIME 2 ELEM SEG2 ;\nL = DROI 4 (0. 0.) (3. 4.) ; LIST (MAXI (COOR 'CURV' L)) ;"),
        (
            "OPTI DIME 1 ELEM SEG2 ;\n"
            "M = MODE (DROI 2 (POIN 0.) (POIN 3.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "X = COOR (MANU 'CHML' M 'SCAL' 1.) ; LIST (MAXI X) ;"
        ),
        (
            "OPTI DIME 3 ELEM TRI3 ;\n"
            "M = MODE (MANU 'TRI3' (0 0 1) (1 0 1) (0 1 1)) 'MECANIQUE' 'ELASTIQUE'\n"
            "'DKT' ;\n"
            "X Y Z = COOR (MANU 'CHML' M 'SCAL' 1.) ; LIST (MAXI Z) ;"
        ),
    ),
)
DIFF = shared_operator(
    "DIFF",
    "objects",
    "What belongs to one of two objects only (symmetric difference).",
    "DIFFERENCE",
)
INTE = shared_operator(
    "INTE",
    "objects",
    "What is common to two objects.",
    "INTERSECTION",
    examples=(
        (
            "OPTI DIME 3 ELEM SEG2 ; A = 1 0 0 ; B = 0 1 0 ; O = 0 0 0 ;\n"
            "L = A INTE 16 'SPHE' O 'PLAN' O B ; MESS (MESU L) ;\n"
            "L = A INTE 16 'CONI' (0 0 -1) O 'PLAN' O B ; MESS (MESU L) ;\n"
            "L = A INTE 16 'TORI' O (0 0 1) (2 0 0) 'PLAN' (-1 0 0) B ; MESS (MESU L) ;"
        ),
        (
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
            "S = (DROI 4 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ;\n"
            "M = MODE S 'MECANIQUE' 'ELASTIQUE' ;\n"
            "N = MODE (S PLUS (2. 0.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
            "LIST (NBEL (EXTR ((M ET N) INTE N) 'MAIL')) ;"
        ),
    ),
)

ListingEntry = Callable[[Any, bool, Teller], str]
LISTINGS: Filled[str, ListingEntry] = Filled("listings")
"""LIST: type -> function (value, whether in brief, what makes texts of codes)."""


def listing(*types: str) -> Callable[[ListingEntry], ListingEntry]:
    """Decorator: how LIST prints objects of these types."""

    def add(entry: ListingEntry) -> ListingEntry:
        for word in types:
            LISTINGS[word] = entry
        return entry

    return add


UnionRule = Callable[[Any, Any], Any]
UNIONS: Filled[tuple[str, str], UnionRule] = Filled("unions")
"""ET: (left type, right type) -> function."""


def union(*pairs: tuple[str, str]) -> Callable[[UnionRule], UnionRule]:
    """Decorator: what ET does on pairs of types."""

    def add(entry: UnionRule) -> UnionRule:
        for pair in pairs:
            UNIONS[pair] = entry
        return entry

    return add


WordedUnionRule = Callable[[Collection[str], Any, Any], Any]
WORDED_UNIONS: Filled[tuple[str, str], WordedUnionRule] = Filled("unions with words")
"""ET for rules that heed the words 'TELQUEL' and 'NOER'."""


def worded_union(*pairs: tuple[str, str]) -> Callable[[WordedUnionRule], WordedUnionRule]:
    """Decorator: what ET does on pairs of types, a function `(words, left, right)`.

    `words` are those of 'TELQ' and 'NOER' that stand with ET.
    """

    def add(entry: WordedUnionRule) -> WordedUnionRule:
        for pair in pairs:
            WORDED_UNIONS[pair] = entry
        return entry

    return add


WORDS_OF_UNION = ("TELQ", "NOER")
"""Words that may stand anywhere beside ET."""


def _words_of_union(call: Call) -> set[str]:
    """Words that stand with ET: before, between and behind objects, not in the place of words."""
    found: set[str] = set()
    values = [o.value for o in call.operands]
    words = [v for v in values if isinstance(v, str | ListMots)]
    objects = len(values) - len(words) >= 2 and not any(isinstance(v, ListMots) for v in words)
    while (said := call.keyword(WORDS_OF_UNION if objects else ("TELQ",))) is not None:
        found.add(said)
    return found


def joining(left: str, right: str) -> UnionRule | WordedUnionRule | None:
    """The rule by which ET joins objects of two types, None if they do not go together."""
    found = WORDED_UNIONS.get((left, right)) or UNIONS.get((left, right))
    return found or UNIONS.get((left, "*")) or UNIONS.get(("*", right))


def united(call: Call, left: Any, right: Any, span: Span, words: Collection[str] = ()) -> Any:
    """What ET makes of two objects, with the words that stand with it.

    Raises
    ------
    SsiError
        'no-rule' when their types do not go together.
    """
    types = type_of(left), type_of(right)
    found: Callable[..., Any] | None = joining(*types)
    if found is None:
        raise SsiError("no-rule", span, operator="ET", left=types[0], right=types[1])
    return found(words, left, right) if types in WORDED_UNIONS else found(left, right)


def _unite(call: Call) -> Any:
    words = _words_of_union(call)
    left = call.read("*")
    if left is not None and not call.operands and type_of(left.value) == "TABLE":
        return _unite_table(call, left.value)
    if left is not None and not call.operands and isinstance(left.value, ListObje):
        return _unite_all(call, left.value, list(left.value.values))
    right = call.read("*") if left is not None else None
    if left is None or right is None:
        raise SsiError("two-operands", call.span, operator="ET")
    while (said := call.keyword(WORDS_OF_UNION)) is not None:
        words.add(said)
    if "TELQ" in words and isinstance(left.value, str) and isinstance(right.value, str):
        return Mot(left.value + right.value)
    if isinstance(left.value, bool) and isinstance(right.value, bool):
        return all([left.value, right.value, *call.all("LOGIQUE")])
    return united(call, left.value, right.value, left.span.to(right.span), words)


def _unite_table(call: Call, table: Any) -> Any:
    return _unite_all(call, table, [v for index, v in table.items() if type(index) is int])


def _unite_all(call: Call, holder: Any, values: list[Any]) -> Any:
    if not values:
        raise call.error("operators.tables.empty-table", holder)
    total = values[0]
    if len(values) == 1:
        return total
    for value in values[1:]:
        total = united(call, total, value, call.span)
    return total


operator(
    "ET",
    flag("exact", "TELQ", en="words with their blanks, meshes in the order given"),
    arg("first", en="object, or a table or list of them"),
    opt("second", en="object joined to it"),
    flag("merged", "NOER", en="doubles are no error"),
    gives=ANY,
    family="objects",
    help=Help(
        "Joins two objects: union of meshes, sum of matrices, concatenation of lists, logical and.",
        "OBJ3 = OBJ1 ET OBJ2 ('NOER') ; OBJ3 = ET ('TELQUEL') OBJ1 OBJ2 ; OBJ2 = ET TAB1 | LOBJ1 ; "
        "LOG4 = ET LOG1 LOG2 LOG3 ... ;",
        (
            "l = (PROG 1. 2.) ET 3. ; LIST l ;",
            "SI (VRAI ET FAUX) ; ERRE 5 ; FINSI ;",
            "LIST (ET 'TELQUEL' 'a ' 'b') ;",
            "LIST (ET (ENUM (PROG 1.) (PROG 2. 3.))) ; MESS (ET VRAI VRAI FAUX) ;",
        ),
    ),
    reads_itself="the types of its operands, words too, choose a rule, which may read more",
)(_unite)

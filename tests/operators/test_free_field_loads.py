"""Loads of a free field: a motion that is not known somewhere is no rest."""

from script_runs import ran
from together import together

from ssilang.cli.run import run_text

COLUMN = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 3 (0. 0.) (3. 0.) ; S = TRAN 4 L (0. -4.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E8 'NU' 0.3 'RHO' 2000. ; "
    "Z = MANU 'CHPO' S 2 'UX' 1.E-3 'UY' 2.E-3 ; W = TABL ; REPE B 3 ; I = TABL ; "
    "I . 'TEMP' = 1. * &B ; I . 'DEPL' = &B * Z ; I . 'VITE' = Z ; I . 'ACCE' = -1. * &B * Z ; "
    "W . &B = I ; FIN B ; T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
    "T . 'RIGI' = RIGI M A ; T . 'MASS' = MASS M A ; T . 'FREQUENCE' = 10. ; T . 'MOUVEMENT' = W ; "
)
LOADS = {
    "ZDRM": "T . 'COUCHE' = S ; T . 'INTERIEUR' = COTE 3 S ; ",
    "ZBOR": "T . 'FRONTIERE' = COTE 2 S ; T . 'AMORTISSEURS' = AMOR M (COTE 2 S) A ; ",
}
WHOLE = "T . 'COLONNE' = COTE 2 S ; "


@together("column", ["", WHOLE])
@together("operator", LOADS)
def test_a_motion_that_is_known_everywhere_loads(operator, column):
    done = ran(
        f"{COLUMN}{LOADS[operator]}{column}C = {operator} T ; X = MAXI (RESU (TIRE C 2.)) 'ABS' ;"
    )
    assert done.session.root.find("X") > 0.0


@together("column", ["", WHOLE])
@together("operator", LOADS)
@together("of", ["DEPL", "VITE", "ACCE"])
@together("part", ["EXCO 'UX' Z 'UX'", "EXCO 'UY' Z 'UY'", "REDU Z (COTE 1 S)"])
def test_a_motion_that_is_not_known_somewhere_is_refused(operator, column, of, part):
    lost = f"I = W . 2 ; I . '{of}' = {part} ; "
    done = run_text(f"{COLUMN}{lost}{LOADS[operator]}{column}C = {operator} T ;")
    assert [e.code for e in done.errors] == ["kernel.waves.motion-not-known"], done.message

"""Examples that run, for laws, elements, components and options: by name, else by sort."""

from __future__ import annotations

from ssilang.language.vocabulary.terms import Word

_LINE = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\nL = DROI 4 (0. 0.) (2. 0.) ;\n"
_SQUARE = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\nL = DROI 2 (0. 0.) (1. 0.) ;\nS = TRAN 2 L (0. 1.) ;\n"
)
_SIDES = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\nSOIL = DROI 4 (0. 0.) (2. 0.) ;\n"
    "BASE = SOIL PLUS (0. 0.) ;\nJ = RACC 1.E-6 SOIL BASE ;\n"
)
_POINTS = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\nL = DROI 1 (0. 0.) (0. 0.1) ;\n"

_BODY = (
    "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ISOTROPE' ;\n"
    "A = MATE M 'YOUN' 5.E7 'NU' 0.3 'RHO' 1900. ;\nLIST (TYPE (RIGI M A)) ;"
)
_PLASTIC = "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' '{}' ;\n"
_ON_POINT = "OPTI DIME 2 MODE PLAN DEFO ;\nP = 0. 0. ;\nM = MODE (MANU POI1 P) 'MECANIQUE' {} ;\n"

EXAMPLES: dict[str, str] = {
    # laws
    "law elasticity": _SQUARE + _BODY,
    "ORTHOTROPE": _SQUARE + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ORTHOTROPE' ;\n"
    "A = MATE M 'YG1' 2.E9 'YG2' 1.E9 'YG3' 1.E9 'NU12' 0.2 'NU23' 0.2 'NU13' 0.2 'G12' 5.E8\n"
    "    'DIRECTION' (1. 0.) ;\nLIST (TYPE (RIGI M A)) ;",
    "law plastic": _SQUARE
    + _PLASTIC.format("RH_COULOMB")
    + "A = MATE M 'YOUN' 5.E7 'NU' 0.3 'COHE' 1.E4 'PHI' 0.52 ;\nLIST (TYPE A) ;",
    "PARFAIT": _SQUARE
    + _PLASTIC.format("PARFAIT")
    + "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SIGY' 2.4E8 ;\nLIST (TYPE A) ;",
    "law creep": _SQUARE
    + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'FLUAGE' 'NORTON' ;\n"
    + "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'AF1' 1.E-30 'AF2' 3. 'AF3' 1. ;\nLIST (TYPE A) ;",
    "law joint": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;\n"
    + "A = MATE M 'KN' 1.E10 'KS' 1.E10 'FROT' 0.5 ;\nLIST (TYPE (RIGI M A)) ;",
    "JOINT_DILATANT": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_DILATANT' ;\n"
    + "A = MATE M 'KN' 1.E10 'KS' 1.E10 'PHI' 30. 'MU' 5. ;\nLIST (TYPE A) ;",
    "MACRO_DISQUE": "OPTI DIME 3 MODE TRID ELEM SEG2 ;\nL = DROI 1 (0 0 0) (0 0 0.1) ;\n"
    "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'MACRO_DISQUE' 'JOI1' ;\n"
    "A = MATE M 'KN' 1.E10 'KS' 1.E10 'RAYO' 10. ;\nLIST (TYPE A) ;",
    "law impedance": _ON_POINT.format("'ELASTIQUE' 'IMPEDANCE' 'VOIGT'")
    + "A = MATE M 'RAID' 1.E9 'VISC' 1.E7 ;\nLIST (TYPE (RIGI M A)) ;",
    "law contact": _SIDES
    + "M = MODE SOIL 'CONTACT' 'FROTTANT' 'COULOMB' BASE ;\nA = MATE M 'MU' 0.6 ;\nLIST (TYPE A) ;",
    "law load": _SIDES + "M = MODE SOIL 'CHARGEMENT' 'PRESSION' ;\nLIST (TYPE M) ;",
    "law choice": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'LOBATTO' ;\nLIST (TYPE M) ;",
    # elements
    "element body": _SQUARE + _BODY,
    "element incompressible": _SQUARE
    + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ICQ4' ;\nLIST (TYPE M) ;",
    "BARR": _LINE + "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;\n"
    "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 0.01 ;\nLIST (TYPE (RIGI M A)) ;",
    "element structure": _LINE + "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'POUT' ;\n"
    "A = MATE M 'YOUN' 3.E10 'NU' 0.2 'RHO' 2500. 'SECT' 0.24 'INRZ' 7.2E-3 ;\n"
    "LIST (TYPE (RIGI M A)) ;",
    "element section": _SQUARE + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'QUAS' ;\n"
    "A = MATE M 'YOUN' 3.E10 'NU' 0.2 'ALPY' 0.83 'ALPZ' 0.83 ;\nLIST (TYPE A) ;",
    "element shell": "OPTI DIME 3 MODE TRID ELEM TRI3 ;\n"
    "S = TRAN 1 (DROI 1 (0 0 0) (1 0 0)) (0 1 0) ;\nM = MODE S 'MECANIQUE' 'ELASTIQUE' 'DKT' ;\n"
    "A = MATE M 'YOUN' 3.E10 'NU' 0.2 'EPAI' 0.3 ;\nLIST (TYPE (RIGI M A)) ;",
    "element load": _SIDES + "M = MODE SOIL 'CHARGEMENT' 'PRESSION' ;\nLIST (TYPE M) ;",
    "JOI1": _POINTS + "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'JOI1' ;\n"
    "A = MATE M 'KN' 1.E9 'KS' 1.E9 'QS' 1.E8 ;\nLIST (TYPE (RIGI M A)) ;",
    "element joint": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI2' ;\n"
    + "A = MATE M 'KN' 1.E10 'KS' 1.E10 ;\nLIST (TYPE (RIGI M A)) ;",
    "element impedance": _ON_POINT.format("'ELASTIQUE' 'IMPEDANCE'")
    + "A = MATE M 'RAID' 1.E9 ;\nLIST (TYPE (RIGI M A)) ;",
    "element contact": _SIDES + "M = MODE SOIL 'CONTACT' BASE ;\nLIST (TYPE M) ;",
    # components, options, formulations
    "component unknown": "OPTI DIME 2 ;\nU = MANU 'CHPO' (1. 0.) 1 'UX' 0.2 ;\n"
    "LIST (MAXI (EXCO 'UX' U)) ;",
    "component force": "OPTI DIME 2 ;\nF = FORC 'FX' 3. (1. 0.) ;\nLIST (MAXI (EXCO 'FX' F)) ;",
    "option": "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\nLIST (VALE 'MODE') ;",
    "formulation": _SQUARE + _BODY,
}  # fmt: skip


def example(kind: str, word: Word) -> str:
    """An example of a word, '' if there is none."""
    own = EXAMPLES.get(word.name, "") if kind in ("law", "element") else ""
    return own or EXAMPLES.get(f"{kind} {word.kind}") or EXAMPLES.get(kind, "")

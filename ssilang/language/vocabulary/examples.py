"""Examples that run, for laws, elements, components and options: by name, else by sort."""

from ssilang.language.vocabulary.terms import Word

_LINE = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\nL = DROI 4 (0. 0.) (2. 0.) ;\n"
_SQUARE = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\nL = DROI 2 (0. 0.) (1. 0.) ;\nS = TRAN 2 L (0. 1.) ;\n"
)
_SIDES = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\nSOIL = DROI 4 (0. 0.) (2. 0.) ;\n"
    "BASE = SOIL PLUS (0. 0.) ;\nJ = RACC 1.E-6 BASE SOIL ;\n"
)
_POINTS = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;\nL = DROI 1 (0. 0.) (0. 0.1) ;\n"

_BODY = (
    "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ISOTROPE' ;\n"
    "A = MATE M 'YOUN' 5.E7 'NU' 0.3 'RHO' 1900. ;\nLIST (TYPE (RIGI M A)) ;"
)
_PLASTIC = "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' '{}' ;\n"
_LINK = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM POI1 ;\nG = MANU POI1 (0. 0.) ;\n"
    "M = MODE G 'LIAISON' 'POINT_PLAN' ;\n"
    "A = MATE M 'NORM' (1. 0.) 'RAID' 1.E6 'JEU' 0.01 ;\nLIST (TYPE A) ;"
)
_ON_POINT = "OPTI DIME 2 MODE PLAN DEFO ;\nP = 0. 0. ;\nM = MODE (MANU POI1 P) 'MECANIQUE' {} ;\n"

_PLASTIC_VALUES = {
    "PARFAIT": "2.E11 'NU' 0.3 'SIGY' 2.4E8",
    "J2": "2.E11 'NU' 0.3 'SIG0' 2.4E8 'SIGI' 4.E8 'KISO' 1.E9 'VELO' 20.",
    "CINEMATIQUE": "2.E11 'NU' 0.3 'SIGY' 2.4E8 'H' 2.E9",
    "DRUCKER_PARFAIT": "5.E7 'NU' 0.3 'LTR' 1.E4 'LCS' 3.E4",
    "DRUCKER_PRAGER": "5.E7 'NU' 0.3 'ALFA' 0.2 'BETA' 1. 'K' 1.E4\n"
    "    'ETA' 0.2 'MU' 1. 'KL' 2.E4 'H' 1.E6 'GAMM' 0.1 'DELT' 1.",
    "CAM_CLAY": "2.E7 'NU' 0.3 'E0' 1. 'M' 1. 'P0' 1.E5 'KAPA' 0.05 'LAMD' 0.2 'G1' 8.E6",
    "RH_COULOMB": "5.E7 'NU' 0.3 'COHE' 1.E4 'PHI' 0.52",
}
_FIBRE_VALUES = {
    "PARFAIT_UNI": "2.E11 'NU' 0.3 'SIGY' 5.E8 'H' 1.E9 'ALPY' 0. 'ALPZ' 0.",
    "BETON_BAEL": "3.E10 'NU' 0.2 'FC' 3.E7 'ALPY' 0.83 'ALPZ' 0.83",
    "ACIER_UNI": "2.E11 'NU' 0.3 'STSY' 4.E8 'STSU' 6.E8 'EPSH' 0.02 'EPSU' 0.1\n"
    "    'ROFA' 20. 'BFAC' 0.01 'A1FA' 18.5 'A2FA' 0.15 'ALPY' 0. 'ALPZ' 0.",
    "BETON_UNI": "3.E10 'NU' 0.2 'STFC' 3.E7 'EZER' 0.002 'STFT' 3.E6\n"
    "    'ZETA' 100. 'ST85' 6.E6 'TRAF' 3. 'ALPY' 0.83 'ALPZ' 0.83",
}
_FOOTINGS = {
    "MACRO_SEMELLE": "'LARG' 10.", "MACRO_DISQUE": "'RAYO' 10.", "MACRO_RESSORTS": "'LARG' 10.",
}  # fmt: skip
_BEARINGS = {
    "APPUI_PLOMB": "'QD' 2.E5 'KPOS' 1.E6", "APPUI_PENDULE": "'RAYO' 2. 'FROT' 0.06",
}  # fmt: skip
_UPRIGHT = "OPTI DIME 3 MODE TRID ELEM SEG2 ;\nL = DROI 1 (0 0 0) (0 0 0.1) ;\n"

_DOUBLE = "DEBP DOUBLE X1*FLOTTANT ;\nFINP (2. * X1) ;\nY = DOUBLE 3. ;\nLIST Y ;"
_CLASS = (
    "DEBM ADDONE ; %N = %N + 1 ; FINM %N ;\nDEBM COUNTER ; %N = 0 ; %METHODE ADD ADDONE ; FINM ;\n"
    "O = OBJE COUNTER ;\nLIST (O%ADD) ;"
)

_OWN = ("elasticity", "plastic", "joint")
"""Sorts of laws of which one has an example of its own."""

EXAMPLES: dict[str, str] = {
    # laws
    "law elasticity": _SQUARE + _BODY,
    "ORTHOTROPE": _SQUARE + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ORTHOTROPE' ;\n"
    "A = MATE M 'YG1' 2.E9 'YG2' 1.E9 'YG3' 1.E9 'NU12' 0.2 'NU23' 0.2 'NU13' 0.2 'G12' 5.E8\n"
    "    'DIRECTION' (1. 0.) ;\nLIST (TYPE (RIGI M A)) ;",
    "law plastic": _SQUARE
    + "E = EVOL 'MANU' (PROG 0. 0.1) (PROG 2.4E8 3.E8) ;\n"
    + _PLASTIC.format("ISOTROPE")
    + "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'ECRO' E ;\nLIST (TYPE A) ;",
    "law creep": _SQUARE
    + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'FLUAGE' 'NORTON' ;\n"
    + "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'AF1' 1.E-30 'AF2' 3. 'AF3' 1. ;\nLIST (TYPE A) ;",
    "law damage": _SQUARE
    + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ENDOMMAGEMENT' 'MAZARS' ;\n"
    + "A = MATE M 'YOUN' 3.1E10 'NU' 0.2 'KTR0' 1.E-4 'ATRA' 0.8 'BTRA' 17000. 'ACOM' 1.4\n"
    + "    'BCOM' 1900. ;\nLIST (TYPE A) ;",
    "law joint": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;\n"
    + "A = MATE M 'KN' 1.E10 'KS' 1.E10 'FROT' 0.5 ;\nLIST (TYPE (RIGI M A)) ;",
    "COULOMB": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'COULOMB' ;\n"
    + "A = MATE M 'KN' 1.E10 'KS' 1.E10 'FRIC' 30. 'COHE' 0. ;\nLIST (TYPE A) ;",
    "JOINT_DILATANT": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_DILATANT' ;\n"
    + "A = MATE M 'KN' 1.E10 'KS' 1.E10 'PHI' 30. 'MU' 5. ;\nLIST (TYPE A) ;",
    "law impedance": _ON_POINT.format("'ELASTIQUE' 'IMPEDANCE' 'VOIGT'")
    + "A = MATE M 'RAID' 1.E9 'VISC' 1.E7 ;\nLIST (TYPE (RIGI M A)) ;",
    "law contact": _SIDES
    + "M = MODE SOIL 'CONTACT' 'FROTTANT' 'COULOMB' BASE ;\nA = MATE M 'MU' 0.6 ;\nLIST (TYPE A) ;",
    "law link": _LINK,
    "element link": _LINK,
    "formulation LIAISON": _LINK,
    "law load": _SIDES + "M = MODE SOIL 'CHARGEMENT' 'PRESSION' ;\nLIST (TYPE M) ;",
    "law choice": _SIDES
    + "M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'LOBATTO' ;\nLIST (TYPE M) ;",
    **{
        law: _SQUARE + _PLASTIC.format(law) + f"A = MATE M 'YOUN' {rest} ;\nLIST (TYPE A) ;"
        for law, rest in _PLASTIC_VALUES.items()
    },
    **{
        law: _SQUARE
        + _PLASTIC.format(f"{law}' 'QUAS")
        + f"A = MATE M 'YOUN' {rest} ;\nLIST (TYPE A) ;"
        for law, rest in _FIBRE_VALUES.items()
    },
    **{
        law: _UPRIGHT + f"M = MODE L 'MECANIQUE' 'ELASTIQUE' '{law}' 'JOI1' ;\n"
        f"A = MATE M 'KN' 1.E10 'KS' 1.E10 {rest} ;\nLIST (TYPE A) ;"
        for law, rest in _FOOTINGS.items()
    },
    **{
        law: _UPRIGHT + f"M = MODE L 'MECANIQUE' 'ELASTIQUE' '{law}' 'JOI1' ;\n"
        f"A = MATE M 'KN' 1.E9 'KS' 1.E7 {rest} ;\nLIST (TYPE A) ;"
        for law, rest in _BEARINGS.items()
    },
    # elements
    "element body": _SQUARE + _BODY,
    "element incompressible": _SQUARE
    + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'ICQ4' ;\nLIST (TYPE M) ;",
    "BARR": _LINE + "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;\n"
    "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 0.01 ;\nLIST (TYPE (RIGI M A)) ;",
    "CERC": "OPTI DIME 2 MODE AXIS ;\nP = 2. 0. ;\n"
    "M = MODE (MANU POI1 P) 'MECANIQUE' 'ELASTIQUE' 'CERC' ;\n"
    "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 1.E-4 ;\nLIST (TYPE (RIGI M A)) ;",
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
    "BBAR": _SQUARE + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'BBAR' ;\nLIST (TYPE M) ;",
    "POLY": _SQUARE + "M = MODE S 'MECANIQUE' 'ELASTIQUE' 'POLY' ;\nLIST (TYPE M) ;",
    "MODAL": _ON_POINT.format("'ELASTIQUE' 'MODAL'")
    + "U = MANU 'CHPO' P 1 'UY' 1. ;\nA = MATE M 'FREQ' 2. 'MASS' 1.E5 'DEFO' U ;\n"
    + "LIST (TYPE (RIGI M A)) ;",
    "STATIQUE": _ON_POINT.format("'ELASTIQUE' 'STATIQUE'")
    + "U = MANU 'CHPO' P 1 'UY' 1. ;\nF = MANU 'CHPO' P 1 'FY' 1.E9 ;\n"
    + "A = MATE M 'DEFO' U 'RIDE' F 'MADE' F ;\nLIST (TYPE (RIGI M A)) ;",
    "IMPEDANCE": _ON_POINT.format("'ELASTIQUE' 'IMPEDANCE'")
    + "A = MATE M 'RAID' 1.E9 ;\nLIST (TYPE (RIGI M A)) ;",
    # components, options, formulations
    "component unknown": "OPTI DIME 2 ;\nU = MANU 'CHPO' (1. 0.) 1 'UX' 0.2 ;\n"
    "LIST (MAXI (EXCO 'UX' U)) ;",
    "component force": "OPTI DIME 2 ;\nF = FORC 'FX' 3. (1. 0.) ;\nLIST (MAXI (EXCO 'FX' F)) ;",
    "value": "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\nLIST (VALE 'MODE') ;",
    "option": "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\nLIST (VALE 'MODE') ;",
    "formulation MECANIQUE": _SQUARE + _BODY,
    "formulation CONTACT": _SIDES + "M = MODE SOIL 'CONTACT' BASE ;\nLIST (TYPE M) ;",
    "formulation CHARGEMENT": _SIDES + "M = MODE SOIL 'CHARGEMENT' 'PRESSION' ;\nLIST (TYPE M) ;",
    # structure of a script
    "structure": "I = 4 ;\nSI (I > 3) ; MESS 'more' ; SINON ; MESS 'less' ; FINSI ;",
    "structure REPETER": "REPE BL 3 ; MESS &BL ; FIN BL ;",
    "structure DEBPROC": _DOUBLE, "structure FINPROC": _DOUBLE,
    "structure TEXTE": "T = TEXT 'A = 3 + 4' ;\nT ;\nLIST A ;",
    "structure DEBMETH": _CLASS, "structure FINMETH": _CLASS,
}  # fmt: skip


def example(kind: str, word: Word) -> str:
    """An example of a word, '' if there is none."""
    keys = [f"{kind} {word.name}", f"{kind} {word.kind}", kind]
    if kind == "element" or (kind == "law" and word.kind in _OWN):
        keys.insert(0, word.name)
    return next((EXAMPLES[key] for key in keys if key in EXAMPLES), "")

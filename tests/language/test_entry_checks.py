"""Tables given to procedures: what cannot be used is refused, what nobody reads is a warning."""

import io

from script_runs import ran
from together import together

from ssilang.cli.run import RunOptions, make_session, phrase_values, run_text
from ssilang.language.say.diagnostics import sentence
from ssilang.language.search import meant, slips
from ssilang.language.text.source import Source

OSCILLATOR = """
OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; T1 = TABL ;
T1 . 'RIGI' = (APPU 'DEPL' 'UX' 4. P) ET (BLOQ 'UY' P) ; T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'VITE' = MANU 'CHPO' P 1 'UX' 1. ; T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ;
"""
BLOCK = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L1 = DROI 1 (0. 0.) (0. 1.) ; S1 = L1 TRAN 1 (1. 0.) ;
M1 = MODE S1 'MECANIQUE' 'ELASTIQUE' ; D1 = BLOQ 'UX' (COTE 3 S1) ;
E1 = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; C1 = CHAR 'DIMP' (DEPI D1 1.E-3) E1 ;
T1 = TABL ; T1 . 'MODELE' = M1 ; T1 . 'CARACTERISTIQUES' = MATE M1 'YOUN' 1.E9 'NU' 0.2 ;
T1 . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' L1) ET D1 ; T1 . 'TEMPS_CALCULES' = PROG 0. 1. ;
"""
DYNAMIC, PASAPAS = (OSCILLATOR, "T2 = DYNAMIC T1 ;"), (BLOCK, "PASAPAS T1 ;")


def warnings(text: str, language: str = "en") -> list[str]:
    """Sentences and hints about entries, of a run that goes well."""
    result = ran(text)
    found = [w for w in result.session.warnings if w.code.startswith("entry")]
    return [" = ".join(sentence(w, language)) for w in found]


@together("deck, entry, word", [
        (DYNAMIC, "T1 . 'VITEUNIL' = MOT 'FAUX' ;", "FAUX"),
        (PASAPAS, "T1 . 'GRANDS_DEPLACEMENTS' = 'vrai' ;", "VRAI"),
        (PASAPAS, "T1 . 'MES_SAUVEGARDES' = TABL ; T1 . 'MES_SAUVEGARDES' . 'DEFTO' = 'FAUX' ;",
         "FAUX"),
    ])  # fmt: skip
def test_a_word_for_a_logical_is_told_and_taken_as_it(deck, entry, word):
    script, call = deck
    result = ran(script + entry + call)
    (told,) = [w for w in result.session.warnings if w.code == "word-of-truth"]
    assert told.data["word"] == word
    plain = run_text(script + entry.replace("MOT 'FAUX'", "FAUX").replace("'FAUX'", "FAUX") + call)
    assert [w.code for w in plain.session.warnings if w.code == "word-of-truth"] == (
        ["word-of-truth"] if word == "VRAI" else []
    )


@together(
    "deck, entry, right",
    [
        (DYNAMIC, "T1 . 'CHARGEMENT' = 1 ;", "'CHAR'"),
        (DYNAMIC, "T1 . 'AMORTISSEMENT' = 1 ;", "'AMOR'"),
        (DYNAMIC, "T1 . 'TEMPS_CALUCLES' = 1 ;", "'TEMPS_CALCULES'"),
        (DYNAMIC, "T1 . 'VITEUNLI' = 1 ;", "'VITEUNIL'"),
        (DYNAMIC, "T1 . 'PROCEDURE_CHARMECA' = 1 ;", "'CHARMECA'"),
        (PASAPAS, "T1 . 'CHAR' = C1 ;", "'CHARGEMENT'"),
        (PASAPAS, "T1 . 'AMOR' = 1 ;", "'AMORTISSEMENT'"),
        (PASAPAS, "T1 . 'FICHIER_VTK' = 'X' ;", "one of DYNAMIC"),
        (PASAPAS, "T1 . 'CECI' = 1 ;", "ssilang help PASAPAS"),
    ],
)
def test_an_entry_that_nobody_reads_is_a_warning_that_names_the_right_one(deck, entry, right):
    (said,) = warnings(deck[0] + entry + deck[1])
    assert right in said
    assert entry.split("'")[1] in said


@together(
    "more",
    [
        "T1 . 'CHARGEMENT' = C1 ; T1 . 'CHAR' = C1 ; MESS (TYPE (T1 . 'CHAR')) ;",
        "T1 . 'MON_SEUIL' = 1.E-3 ; SI (EXIS T1 'MON_SEUIL') ; FINSI ;",
        "T1 . 'MOVA' = 'UX' ;",
        "T1 . 'MAXI_DEPLACEMENT' = 1. ; SI FAUX ; CONTINU T1 ; FINSI ;",
    ],
)
def test_what_the_script_reads_and_what_is_known_is_no_warning(more):
    assert warnings(BLOCK + more + "PASAPAS T1 ;") == []


def test_what_a_procedure_of_the_script_reads_is_no_warning():
    text = """
    DEBP PERSO1 TAB1*TABLE ; SI ((TAB1 . 'MON_SEUIL') > 3.) ; TAB1 . 'ARRET' = VRAI ; FINSI ; FINP ;
    """
    text += BLOCK + "T1 . 'PROCEDURE_PERSO1' = VRAI ; T1 . 'MON_SEUIL' = 1. ;"
    assert warnings(text + "PASAPAS T1 ;") == []
    assert len(warnings(text.replace("TAB1 . 'MON_SEUIL'", "1.") + "PASAPAS T1 ;")) == 1


def test_results_and_a_second_call_are_no_warning():
    assert warnings(BLOCK + "T1 . 'CHARGEMENT' = C1 ; PASAPAS T1 ; PASAPAS T1 ;".replace(
        "PASAPAS T1 ; PASAPAS", "PASAPAS T1 ; T1 . 'TEMPS_CALCULES' = PROG 2. ; PASAPAS"
    )) == []  # fmt: skip
    assert warnings(OSCILLATOR + "T2 = DYNAMIC T1 ; T2 = DYNAMIC T1 ;") == []


def test_warnings_speak_french():
    (said,) = warnings(OSCILLATOR + "T1 . 'CHARGEMENT' = 1 ; T2 = DYNAMIC T1 ;", "fr")
    assert "n'est pas un indice de DYNAMIC" in said
    assert "vouliez-vous dire 'CHAR' ?" in said


@together("value", ["VRAI", "FAUX", "'INERTIE'", "'RAIDEUR'", "MOT 'MASSE'", "MOT 'RIGIDITE'"])
def test_documented_words_and_older_ones_work(value):
    assert warnings(OSCILLATOR + f"T1 . 'VITEUNIL' = {value} ; T2 = DYNAMIC T1 ;") == []


@together("word", ["'TOUS'", "'tous'", "'FINAL'", "'FINA'"])
def test_words_compare_on_four_letters(word):
    assert warnings(OSCILLATOR + f"T1 . 'PAS_SAUVES' = {word} ; T2 = DYNAMIC T1 ;") == []


def test_entries_inside_of_tables_are_checked():
    text = """
    T1 = TABL ; TS = TABL ; T1 . 'STRUC' = TS ; TS . 'NMODE' = 1.5 ;
    T1 . 'PLANCH' = TABL ; T1 . 'EXCIT' = TABL ; T2 = SPPLANC T1 ;
    """
    assert "'STRUC' . 'NMODE' must be ENTIER" in run_text(text).message


def test_swapped_letters_count_once():
    assert slips("TEMPS", "TMEPS") == 1
    assert slips("TEMPS", "TEMP") == 1
    assert slips("CHAR", "CHOIR") == 2
    assert meant("VITESSE", ["VITE", "DEPL"]) == "VITE"
    assert meant("XYZ", ["VITE", "DEPL"]) == ""


def test_entries_without_effect_are_told_once_and_those_that_ask_for_nothing_are_not():
    more = "T1 . 'K_TANGENT' = 3 ; T1 . 'MAXISOUSPAS' = 5 ; T1 . 'ACCELERATION' = FAUX ;"
    more += "T1 . 'HYPOTHESE_DEFORMATIONS' = 'LINEAIRE' ;"  # what PASAPAS does anyway
    result = ran(BLOCK + more + "PASAPAS T1 ;")
    (said,) = [w for w in result.session.warnings if w.code == "entries-without-effect"]
    told, _ = sentence(said, "en")
    assert "'K_TANGENT' and 'MAXISOUSPAS' without effect" in told
    assert "ACCELERATION" not in told
    assert "HYPOTHESE_DEFORMATIONS" not in told
    told, _ = sentence(said, "fr")
    assert "'K_TANGENT' et 'MAXISOUSPAS' sans effet" in told


def test_an_entry_without_effect_here_that_the_script_reads_itself_is_no_warning():
    more = "T1 . 'PRECISION' = 1.E-3 ; SI ((T1 . 'PRECISION') > 1.) ; FINSI ;"
    result = ran(BLOCK + more + "PASAPAS T1 ;")
    assert not [w for w in result.session.warnings if w.code == "entries-without-effect"]


HARMONICS = (
    """OPTI DIME 2 ELEM SEG2 MODE PLAN ; P1 = 0. 0. ; T1 = TABL ;
    T1 . 'RIGIDITE_CONSTANTE' = MANU 'RIGI' P1 (MOTS 'UY') (PROG 4.) ;
    T1 . 'MASSE_CONSTANTE' = MASS 'UY' 1. P1 ; T1 . 'N_HARMONIQUE' = 1 ;
    T1 . 'AMORTISSEMENT_CONSTANT' = MANU 'RIGI' P1 (MOTS 'UY') (PROG 0.4) ;
    T1 . 'RESULTATS' = TABL ; T1 . 'RESULTATS' . 1 = TABL ;
    T1 . 'RESULTATS' . 1 . 'POINT_MESURE' = P1 ; T1 . 'RESULTATS' . 1 . 'COMPOSANTES' = MOT 'UY' ;
    HBM T1 ; F1 = MANU 'CHPO' P1 1 'F2' 1. 'NATURE' 'DISCRET' ;
    T1 . 'CHARGEMENT' = CHAR 'MECA' F1 (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
    T1 . 'TEMPS_CALCULES' = PROG 1. PAS 0.5 2. ; T1 . 'MAXI_DEPLACEMENT' = 1. ;""",
    "CONTINU T1 ;",
    "T1 . 'N_PT_POTS' = 64 ; HBM_POST T1 ;",
)


def test_what_had_the_table_in_an_earlier_cell_owns_its_entries():
    """HBM_POST reads a table that HBM and CONTINU filled, though its cell names neither."""
    session = make_session(Source("cell", ""), RunOptions(), io.StringIO())
    for cell in HARMONICS:
        phrase_values(session, Source("cell", cell))
    found = [" = ".join(sentence(w, "en")) for w in session.warnings if w.code.startswith("entry")]
    assert len(found) == 1
    assert "'N_PT_POTS'" in found[0]
    assert "'N_PT_POST'" in found[0]

"""The vocabulary and the kernel know the same words; every entry is sound; help shows them."""

import itertools
import math
import re
from pathlib import Path

import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.elements.catalog import ELEMENTS, GENERIC_ELEMENTS
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.elements.solids.solid_moduli import HOOKE_COMPONENT
from ssilang.kernel.fields.node_algebra import SCALAR
from ssilang.kernel.interface.bed import AT_PLACES, OF_WHOLE
from ssilang.kernel.interface.interface import COMMON_VARIABLES
from ssilang.kernel.interface.laws.law import DEFAULTS
from ssilang.kernel.interface.laws.law_table import LAWS as JOINT_LAWS
from ssilang.kernel.materials.behaviours import FORMULATIONS
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.materials.parameters import LINKS
from ssilang.kernel.materials.plastic.laws import CREEP_LAWS, DAMAGE_LAWS, PLASTIC_LAWS
from ssilang.kernel.matrices.matrix import PRIMAL_TO_DUAL
from ssilang.language import vocabulary
from ssilang.language.registry import find_operator, keywords_of
from ssilang.language.say.reference import operator_page, page_text
from ssilang.language.vocabulary.examples import example, examples
from ssilang.language.vocabulary.terms import Option, Quantity, Range, units
from ssilang.messages.message import teller
from ssilang.operators.loader import load_operators
from ssilang.operators.models.contact import METHODS
from ssilang.operators.models.mode import LAW_WORDS
from ssilang.operators.session.options import READERS
from ssilang.operators.vocabulary import pages, words
from ssilang.operators.vocabulary.law_tables import law_tables
from ssilang.operators.vocabulary.pages import exact_pages, help_text, near_name, vocabulary_text

_ROOT = Path(__file__).parents[2]

load_operators()


def components():
    """Every component that an element or a law gives, with the duals of unknowns."""
    names = {*PRIMAL_TO_DUAL, *PRIMAL_TO_DUAL.values(), HOOKE_COMPONENT, SCALAR, *PRINCIPAL}
    names |= {*COMMON_VARIABLES, *OF_WHOLE, *AT_PLACES}
    for element in ELEMENTS:
        for part in words.components_of(element):
            names |= {*part.unknowns, *part.strains, *part.stresses}
    laws = (
        *PLASTIC_LAWS.values(),
        *CREEP_LAWS.values(),
        *DAMAGE_LAWS.values(),
        *JOINT_LAWS.values(),
    )
    return names.union(*({*law.variables, *getattr(law, "opposite", ())} for law in laws))


_ALL = [(kind, word) for kind in vocabulary.KINDS for word in vocabulary.words(kind)]
_CHOICES = ("GAUSS", "LOBATTO", "INTEGRE", "CONS", "DPGE", "LIBRE", "LIE")
_KNOWN = {
    "formulation": FORMULATIONS,
    "law": (
        *LAW_WORDS, *METHODS, *_CHOICES, "UNILATERAL", "FROTTANT", "COULOMB", "FROCABLE",
        "PRESSION",
        *(word for words_of_link in LINKS for word in words_of_link),
    ),
    "element": (*ELEMENTS, *GENERIC_ELEMENTS),
    "parameter": words.known_parameters(),
    "component": components(),
    "option": tuple(READERS),
    "structure": (
        "SI", "SINON", "FINSI", "REPETER", "DEBPROC", "FINPROC", "DEBMETH", "FINMETH", "TEXTE",
    ),
}  # fmt: skip


@together("kind", vocabulary.KINDS)
def test_every_word_has_an_entry_and_every_entry_is_known(kind):
    known, declared = set(_KNOWN[kind]), set(vocabulary.names(kind))
    assert known - declared == set(), "words without an entry"
    assert declared - known == set(), "entries that nothing knows"


@together("name", words.known_parameters())
def test_every_meaning_of_a_parameter_is_that_of_some_law_or_element(name):
    used = [meaning for _, meaning in words.owners(name)]
    for word in vocabulary.meanings("parameter", name):
        assert word in used, f"{name} of {word.of}: nothing takes it"


def test_meanings_are_limited_to_what_exists():
    families = {k.family for k in ELEMENTS.values()}
    known = {*families, *ELEMENTS, *_KNOWN["law"], "CONTACT"}
    for _, word in _ALL:
        assert set(word.of) <= known, f"{word.name} is limited to {word.of}"


@together("kind, word", _ALL)
def test_an_entry_is_whole(kind, word):
    assert word.name == word.name.upper()
    values = word.values if isinstance(word, Option) else ()
    for entry in (word, *values):
        assert entry.en, entry.name
        assert entry.fr, entry.name
        assert entry.en[-1] != "."
        assert entry.fr[-1] != "."
    for language in ("en", "fr"):
        assert word.meaning(language)[:20] in vocabulary_text(kind, word, language)


@together("word", [w for _, w in _ALL if isinstance(w, Quantity)])
def test_units_and_ranges_are_sound(word):
    assert word.unit is None or word.unit in units()
    for span in (word.range, word.usual):
        assert span.low <= span.high
        assert span.low < span.high or not (span.open_low or span.open_high)
    assert word.default is None or word.default in word.range
    ends = [e for e in (word.usual.low, word.usual.high) if math.isfinite(e)]
    assert all(e in word.range or e in (word.range.low, word.range.high) for e in ends)


def test_defaults_of_the_kernel_are_in_their_ranges():
    for name, default in DEFAULTS.items():
        for word in vocabulary.meanings("parameter", name):
            assert default in word.range


def test_one_meaning_has_one_unit_in_each_zone():
    joint = words.sample("JOI2", Mode.PLANE_STRAIN)
    points = words.sample("JOI1", Mode.PLANE_STRAIN)
    assert words.parameter("KN", joint).unit == "Pa/m"
    assert words.parameter("KN", points).unit == "N/m"
    soil = words.sample(
        "QUA4", Mode.PLANE_STRAIN, ("ELASTIQUE", "ISOTROPE", "PLASTIQUE", "RH_COULOMB")
    )
    slips = words.sample("JOI2", Mode.PLANE_STRAIN, ("ELASTIQUE", "JOINT_DILATANT"))
    assert words.parameter("PHI", soil).unit == "rad"
    assert words.parameter("PHI", slips).unit == "deg"


@together("key", examples())
def test_examples_run(key, tmp_path):
    ran(examples()[key], output_directory=tmp_path)


@together("kind", ["law", "element"])
def test_every_law_and_element_has_an_example(kind):
    for word in vocabulary.words(kind):
        assert example(kind, word), word.name


@together(
    "kind, said, name",
    [("law", "JOINT_SDM", "JOINT_SDM"), ("law", "joint_s", "JOINT_SDM"),
     ("law", "ELAS", "ELASTIQUE"),
     ("law", "ELA", ""), ("element", "POUTRE", "POUT"), ("option", "DIMENSION", "DIME"),
     ("parameter", "YOUNG", "YOUN"), ("parameter", "RHOX", ""),
     ("component", "UX", "UX"), ("component", "UXX", "")],
)  # fmt: skip
def test_words_are_found_as_the_language_compares_them(kind, said, name):
    assert vocabulary.full_name(kind, said) == name
    found = vocabulary.find(kind, said)
    assert (found.name if found else "") == name


@together("name", ["BLOQ", "EXTR", "MODE"])
def test_keywords_are_told_in_order_however_a_process_keeps_words(name):
    told = keywords_of(find_operator(name))
    assert len(told) > 2
    assert all(one < other for one, other in itertools.pairwise(told))


def test_near_names_of_a_list():
    assert vocabulary.near("element", "TIOM")[0] == "TIMO"
    assert vocabulary.near("parameter", "YUON")[0] == "YOUN"


@together("low, text", [(Range(), ""), (Range(0.0), "K >= 0"), (Range(0.0, open_low=True), "K > 0"),
     (Range(high=0.0), "K <= 0"), (Range(-1.0, 0.5, True, True), "-1 < K < 0.5")])  # fmt: skip
def test_ranges_are_told_as_inequalities(low, text):
    assert low.text("K") == text


# ---- help ------------------------------------------------------------------------------------


@together(
    "word, parts",
    [
        ("JOINT_SDM", ("law of joints", "JOI2", "FROT", "Pa/m", "required", "JOINT_DILATANT")),
        ("KN", ("Pa/m", "N/m", "MACRO_SEMELLE", "JOI1", "KN >= 0")),
        ("POUT", ("SEG2", "TRID", "UX UY UZ RX RY RZ", "EFFX", "Area of the section")),
        ("UX", ("Displacement along x", "Dual", "FX", "QUA4")),
        ("PLAN", ("value of OPTI MODE", "keyword of")),
        ("MASS", ("operator", "Modal mass", "kg")),
        ("DIME", ("operator", "option of OPTI", "ENTIER")),
    ],
)
def test_help_of_a_word(word, parts):
    text = help_text(word, "en")
    for part in parts:
        assert part in text


@together("language", ["en", "fr"])
def test_pages_of_unknowns_and_of_their_duals_name_each_other(language):
    head = teller(language)("help.dual")
    for primal, dual in PRIMAL_TO_DUAL.items():
        for one, other in ((primal, dual), (dual, primal)):
            for word in vocabulary.meanings("component", one):
                lines = vocabulary_text("component", word, language).split("\n")
                assert [s.split()[1:] for s in lines if s.startswith(f"{head} ")] == [[other]], one


def test_a_word_with_several_meanings_lists_them_all():
    mass = [page.partition("\n")[0] for page in exact_pages("MASS", "en")]
    assert mass[0] == "MASS (MASSE) : operator [matrix]"
    assert mass[1:3] == ["MASS : parameter of MATE or CARA"] * 2  # at a point, of a mode
    phi = help_text("PHI", "en")
    assert "rad" in phi
    assert "deg" in phi


@pytest.mark.parametrize(
    ("query", "name"),
    [("uplift", "JOINT_SDM"), ("décollement", "JOINT_SDM"), ("damping", "AMOR"),
     ("amortissement", "AMOR"), ("contact", "FROTTANT"), ("modes", "VIBR")],
)  # fmt: skip
@pytest.mark.parametrize("language", ["en", "fr"])
def test_help_searches_both_languages(query, name, language):
    assert f"  {name} " in help_text(query, language)


def test_pages_of_the_manual_that_name_a_word_stand_below_it():
    pages = {f"docs/{p.name}": p.read_text("utf-8") for p in (_ROOT / "docs").glob("*.md")}
    for name in ("JOINT_SDM", "MACRO_SEMELLE", "IWAN"):
        naming = {path for path, text in pages.items() if name in re.findall(r"\w+", text)}
        assert 0 < len(naming) < len(pages)
        assert set(re.findall(r"docs/\w+\.md", help_text(name, "en"))) == naming


def test_nothing_found_gives_a_near_name():
    assert help_text("JOINT_SMD", "en") == ""
    assert near_name("JOINT_SMD") == "JOINT_SDM"


# ---- refusals ---------------------------------------------------------------------------------

_BAR = (
    "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; "
    "M = MODE L MECANIQUE ELASTIQUE BARR ; A = MATE M 'SECT' 1. {} ;"
)


@together("given", ["'YOUN' 0. 'NU' 0.5", "'YOUN' 2.E11 'NU' 0. 'ALPH' -1.E-6"])
def test_mate_takes_numbers_in_their_range(given, tmp_path):
    ran(_BAR.format(given), output_directory=tmp_path)


def test_info_searches_too(tmp_path):
    done = run_text("INFO 'uplift' ;", output_directory=tmp_path)
    assert "JOINT_SDM" in done.output


def test_a_misspelt_component_of_a_force_gets_a_near_name(tmp_path):
    text = "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; F = {} '{}' 3. L ;"
    asked = "did you mean '{}'?"
    for operator, word, near in (
        ("FORC", "FXX", asked.format("FX")), ("FORC", "MZ", "it is one of MOME"),
        ("FORC", "UY", asked.format("FY")), ("MOME", "RZ", asked.format("MZ")),
        ("FORC", "T", ""),
    ):  # fmt: skip
        told = run_text(text.format(operator, word), output_directory=tmp_path).message
        assert f"found a MOT ('{word}')" in told
        assert near in told
        assert near or "did you mean" not in told


def test_components_of_ones_own_are_taken(tmp_path):
    text = "OPTI DIME 2 ; P = 0. 0. ; U = MANU 'CHPO' P 1 'MINE' 2. ; V = EXCO 'MINE' U 'UX' ;"
    assert run_text(text, output_directory=tmp_path).exit_code == 0


# ---- the tables of MATE: what the laws of the kernel take, under the words of MODE


@together("language", ["en", "fr"])
def test_the_help_of_mate_has_a_table_of_each_law(language):
    tables = {t.title.split(" : ")[0]: t for t in law_tables(language)}
    assert {f"PLASTIQUE {name}" for name in PLASTIC_LAWS} - set(tables) == {"PLASTIQUE SECTION"}
    assert {f"FLUAGE {name}" for name in CREEP_LAWS} <= set(tables)
    assert {f"ENDOMMAGEMENT {name}" for name in DAMAGE_LAWS} <= set(tables)
    assert {"ELASTIQUE", *(f"ELASTIQUE {n}" for n in JOINT_LAWS if n != "ELASTIQUE")} <= set(tables)
    told = page_text(operator_page(find_operator("MATE")), language)
    for title, table in tables.items():
        assert f"  {title} : " in told
        assert all(len(row) == len(table.heads) and row[0] and row[4] for row in table.rows)


def whole(tables, title):
    """Names of a law's parameters, with those of the law that its note names."""
    table = tables[title]
    names = {row[0] for row in table.rows}
    like = re.match(r"as (.*?)(, and)?$", table.note)
    return names | whole(tables, like.group(1)) if like else names


def test_the_tables_of_mate_hold_what_the_kernel_asks_for():
    tables = {t.title.split(" : ")[0]: t for t in law_tables("en")}
    for name, law in PLASTIC_LAWS.items():
        if name != "SECTION":
            assert {*law.required, *law.defaults} <= whole(tables, f"PLASTIQUE {name}")
            told = {row[0]: row[2] for row in tables[f"PLASTIQUE {name}"].rows}
            defaults = {n: f"{v:g}" for n, v in law.defaults.items() if n in told}
            assert {n: told[n] for n in defaults} == defaults
    for name in JOINT_LAWS:
        assert {"KN", "KS"} <= whole(tables, " ".join(dict.fromkeys(("ELASTIQUE", name))))
    rows = {row[0]: row for row in tables["PLASTIQUE CAM_CLAY"].rows}
    assert rows["P0"] == (
        "P0", "Pa", "required", "P0 > 0", "Preconsolidation pressure of the start, positive",
    )  # fmt: skip
    assert "YOUN" not in rows  # of isotropic elasticity
    assert [row[0] for row in tables["PLASTIQUE IWAN_PRESSION"].rows] == ["PREF"]


@together("name, own, other", [
        ("CONTACT", "UNILATERAL FROTTANT COULOMB", "PARFAIT POINT_PLAN PRESSION JOINT_SDM"),
        ("LIAISON", "POINT_PLAN POINT_CERCLE", "PARFAIT UNILATERAL PRESSION JOINT_SDM"),
        ("MECANIQUE", "PARFAIT JOINT_SDM ORTHOTROPE NORTON", "UNILATERAL POINT_PLAN PRESSION"),
        ("CHARGEMENT", "PRESSION", "PARFAIT UNILATERAL POINT_PLAN"),
    ])  # fmt: skip
def test_a_formulation_lists_its_own_laws(name, own, other):
    (told,) = pages._formulation(vocabulary.find("formulation", name), "en")
    found = set(" ".join(told).replace(",", " ").split())
    assert set(own.split()) <= found
    assert found.isdisjoint(other.split())


@together("law", vocabulary.words("law"))
def test_the_zone_that_shows_a_law_has_it(law):
    zone = words.sample_of_law(law)
    if zone is None:
        assert law.name not in {*PLASTIC_LAWS, *CREEP_LAWS, *DAMAGE_LAWS, *JOINT_LAWS} - {
            "SECTION",
            "ELASTIQUE",
        }
        return
    assert law.name in zone.behaviour
    if law.kind == "joint":
        alone = JOINT_LAWS[law.name].macro or JOINT_LAWS[law.name].two_points
        assert zone.element == ("JOI1" if alone else "JOI2")
    elif law.kind in ("plastic", "creep", "damage"):
        group = {"plastic": "PLASTIQUE", "creep": "FLUAGE"}.get(law.kind, "ENDOMMAGEMENT")
        assert zone.behaviour[-2:] == (group, law.name)
    assert zone.element in words.elements_of_law(law)


def test_hints_and_searches_end_where_they_say():
    zone = words.sample_of_law(vocabulary.find("law", "ANISOTROPE"))  # of thirty parameters
    names = [r.word.name for r in words.parameter_rows(zone, section=True)]
    assert len(words.told_parameters(zone, names, "en")) == 12 < len(names)
    shown = pages.found_text("field", "en").split("\n")
    assert len(shown) == 20 + 2  # a head, and how many more there are

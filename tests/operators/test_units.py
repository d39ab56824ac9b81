"""OPTI 'UNIT': warnings of numbers in other units, and units of what is written.

The expected numbers are those of tables of materials: steel is 210 GPa and 7850 kg/m3, whatever
the units of a deck.
"""

import io
import json
import re
from pathlib import Path
from xml.etree import ElementTree

import meshio
import pytest
from script_runs import ran
from together import together

from ssilang.cli.check import check_source
from ssilang.cli.run import RunOptions, RunResult, run_source, run_text
from ssilang.language.text.source import Source
from ssilang.language.vocabulary.terms import units
from ssilang.language.vocabulary.unit_systems import SYSTEMS, result_unit

BODY = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = TRAN 1 (DROI 1 (0. 0.) (2. 0.)) (0. 1.) ; "
    "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; "
)
STEEL = {  # Young's modulus and density
    "SI": ("210.E9", "7850."),
    "KN-M": ("210.E6", "7.85"),
    "MN-M": ("210.E3", "7.85E-3"),
    "N-MM": ("210.E3", "7.85E-9"),
}
CLAY = {"SI": ("5.E6", "1700."), "KN-M": ("5.E3", "1.7"), "MN-M": ("5.", "1.7E-3"),
        "N-MM": ("5.", "1.7E-9")}  # fmt: skip


def warned(system: str, given: str, model: str = BODY) -> list[dict[str, object]]:
    """Data of the warnings of a MATE in a system ('' for none)."""
    option = f"OPTI 'UNIT' '{system}' ; " if system else ""
    made = ran(f"{model}{option}A = MATE MO {given} ; LIST (TYPE A) ;")
    known = {"unusual-value", "unusual-ratio", "no-stiffness", *([] if system else ["no-units"])}
    assert {w.code.removeprefix("operators.models.") for w in made.session.warnings} <= known
    return [w.data for w in made.session.warnings if w.code == "operators.models.unusual-value"]


# ---- systems


def test_a_unit_of_mass_is_what_a_unit_of_force_accelerates():
    masses = {name: s.mass for name, s in SYSTEMS.items()}
    assert masses == pytest.approx({"SI": 1.0, "KN-M": 1e3, "MN-M": 1e6, "N-MM": 1e3})


@together(
    "system, unit, written, factor",
    [
        ("N-MM", "Pa", "MPa", 1e6),
        ("N-MM", "kg/m3", "t/mm3", 1e12),
        ("N-MM", "Pa/m", "MPa/mm", 1e9),
        ("N-MM", "N/m", "N/mm", 1e3),
        ("N-MM", "m4", "mm4", 1e-12),
        ("N-MM", "J", "mJ", 1e-3),
        ("KN-M", "kg m2", "t m2", 1e3),
        ("KN-M", "N s/m", "kN s/m", 1e3),
        ("MN-M", "kg/m3", "kt/m3", 1e6),
        ("MN-M", "N m", "MN m", 1e6),
        ("MN-M", "1/(m K)", "1/(m K)", 1.0),
    ],
)
def test_units_of_a_system(system, unit, written, factor):
    assert SYSTEMS[system].written(unit) == written
    assert SYSTEMS[system].factor(unit) == pytest.approx(factor, rel=1e-14)


def test_every_unit_of_the_vocabulary_has_its_size_in_every_system():
    for unit in units():
        assert SYSTEMS["SI"].factor(unit) == 1.0
        assert SYSTEMS["SI"].written(unit) == unit
        assert all(s.factor(unit) > 0.0 for s in SYSTEMS.values())


# ---- materials


@together("system", SYSTEMS)
@together("material", [STEEL, CLAY])
def test_materials_in_their_units_are_taken_in_silence(system, material):
    young, density = material[system]
    assert warned(system, f"'YOUN' {young} 'NU' 0.3 'RHO' {density} 'ALPH' 1.2E-5") == []


@together(
    "system, given, likely, written",
    [
        ("N-MM", "'YOUN' 2.1E11 'NU' 0.3", ["Pa"], ["210000"]),
        ("N-MM", "'YOUN' 2.E5 'NU' 0.3 'RHO' 7850.", ["kg/m3"], ["7.85e-09"]),
        ("MN-M", "'YOUN' 3.E4 'NU' 0.2 'RHO' 2500.", ["kg/m3"], ["0.0025"]),
        ("MN-M", "'YOUN' 3.E4 'NU' 0.2 'RHO' 2.5", ["t/m3"], ["0.0025"]),
        ("KN-M", "'YOUN' 3.E7 'NU' 0.2 'RHO' 2500.", ["kg/m3"], ["2.5"]),
        ("SI", "'YOUN' 30. 'NU' 0.2", ["MPa", "GPa"], ["3e+07", "3e+10"]),
        ("SI", "'YOUN' 3.E10 'NU' 0.2 'RHO' 2.5", ["t/m3"], ["2500"]),
        ("SI", "'YOUN' 2.1E5 'NU' 0.3", ["kPa", "MPa"], ["2.1e+08", "2.1e+11"]),
        ("SI", "'YOUN' 2.1E11 'NU' 0.3 'ALPH' 12.", ["1e-6/K"], ["1.2e-05"]),
    ],
)
def test_numbers_in_another_unit_are_told_with_the_unit_they_look_like(
    system, given, likely, written
):
    (told,) = warned(system, given)
    assert (told["likely"], told["written"]) == (likely, written)


@together(
    "system, width, told",
    [("SI", 6000.0, True), ("N-MM", 6000.0, False), ("KN-M", 400.0, False), ("", 6000.0, False)],
)
def test_millimetres_of_a_drawing_are_told(system, width, told):
    option = f"OPTI 'UNIT' '{system}' ; " if system else ""
    young = STEEL[system or "SI"][0]
    script = BODY.replace("(2. 0.)", f"({width} 0.)") + option
    made = run_text(script + f"A = MATE MO 'YOUN' {young} ; B = MATE MO 'YOUN' {young} ;")
    assert [w.code for w in made.session.warnings] == ["operators.models.unusual-size"] * told


def test_bounds_are_told_in_the_units_of_the_deck():
    (told,) = warned("N-MM", "'YOUN' 2.E5 'NU' 0.3 'RHO' 7850.")
    assert (told["unit"], told["small"]) == ("t/mm3", False)
    assert (told["low"], told["high"]) == pytest.approx((1e-11, 1.2e-8))


def test_without_the_option_nothing_is_said():
    assert warned("", "'YOUN' 30. 'NU' 0.2 'RHO' 1.E9") == []


def test_nought_is_usual_in_any_unit():
    assert warned("SI", "'YOUN' 0. 'NU' 0. 'RHO' 0.") == []


def test_sections_and_joints_are_looked_at_too():
    bar = "OPTI DIME 2 ELEM SEG2 ; MO = MODE (DROI 1 (0. 0.) (1. 0.)) 'MECANIQUE' BARR ; "
    (told,) = warned("SI", "'YOUN' 2.1E11 'NU' 0.3 'SECT' 1.E5", bar)
    assert (told["name"], told["likely"], told["written"]) == (
        "SECT",
        ["mm2", "cm2"],
        ["0.1", "10"],
    )
    joint = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 1 (0. 0.) (1. 0.) ; "
        "MO = MODE (RACC 1.E-3 L (L PLUS (0. 0.))) 'MECANIQUE' 'ELASTIQUE' 'JOINT' 'JOI2' ; "
    )
    (told,) = warned("SI", "'KN' 100. 'KS' 1.E9", joint)  # 100 GPa/m
    assert told["name"] == "KN"
    assert "GPa/m" in told["likely"]


def test_a_field_is_looked_at_by_its_extremes():
    two = (
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = TRAN 1 (DROI 2 (0. 0.) (2. 0.)) (0. 1.) ; "
        "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; "
        "C = MANU 'CHML' MO 'YOUN' 2.1E11 'TYPE' 'CARACTERISTIQUES' 'GRAVITE' ; "
    )
    assert warned("SI", "'YOUN' C 'NU' 0.3", two) == []
    (told,) = warned("SI", "'YOUN' (1.E-9 * C) 'NU' 0.3", two)
    assert told["value"] == pytest.approx(210.0)


def test_a_statement_in_a_loop_is_told_once_and_procedures_of_the_library_never():
    made = run_text(
        f"{BODY}OPTI 'UNIT' 'SI' ; REPE B 3 ; A = MATE MO 'YOUN' 30. 'NU' 0.2 ; FIN B ; LIST A ;"
    )
    assert [w.data["value"] for w in made.session.warnings] == [30.0]
    centre = run_text(f"{BODY}OPTI 'UNIT' 'SI' ; G = @CDG MO ; LIST G ;")  # RHO 1. inside
    assert (centre.exit_code, centre.session.warnings) == (0, []), centre.message


def test_the_option_is_read_back_and_holds_from_its_place_on():
    made = ran(
        f"{BODY}A = MATE MO 'YOUN' 30. 'NU' 0.2 ; OPTI UNIT SI ; U = VALE 'UNIT' ; "
        "OPTI 'UNIT' 'mn-m' ; B = MATE MO 'YOUN' 30. 'NU' 0.2 ; V = VALE 'UNIT' ; LIST (A ET B) ;"
    )
    assert made.session.warnings == []
    assert [made.session.root.find(n) for n in "UV"] == ["SI", "MN-M"]
    assert run_text("U = VALE 'UNIT' ;").errors[0].code == "operators.session.option-not-set"


@together("said", ["N-M", "MN-MM", "CGS", "SIX"])
def test_a_system_is_written_whole(said):
    (error,) = run_text(f"OPTI 'UNIT' '{said}' ;").errors
    assert error.code == "operators.session.no-value-of-option"
    assert error.data["values"] == ["'SI'", "'KN-M'", "'MN-M'", "'N-MM'"]


# ---- what is written

MOTION = """
OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; T = TABL ; {option}
T . 'RIGI' = RIGI 'DEPL' 100. P1 ; T . 'MASS' = MASS 'DEPL' 1. P1 ;
T . 'CHAR' = CHAR 'MECA' (FORC 'FX' 1. P1) (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.314 ; T . 'TEMPS_SAUVES' = PROG 0. 0.1 0.2 ;
T . 'TEMPS_SAUVES_CSV' = PROG 0. 0.1 ; T . 'MAILLAGE_CSV' = P1 ; T . 'FICHIER_CSV' = 'motion' ;
R = DYNAMIC T ;
E = EVOL 'TEMP' R 'VITE' 'UX' P1 ; D = EVOL 'TEMP' R 'DEPL' 'UX' P1 ;
"""


def moved(folder: Path, system: str, more: str) -> RunResult:
    option = f"OPTI 'UNIT' '{system}' ;" if system else ""
    options = RunOptions(output_directory=folder, summary=True)
    return ran(MOTION.replace("{option}", f"{option} OPTI TRAC SVG ;") + more, options=options)


def texts(folder: Path, number: int = 1) -> set[str]:
    (path,) = folder.glob(f"{number:04d}_*.svg")
    root = ElementTree.parse(path).getroot()
    return {t.text or "" for t in root.iter("{http://www.w3.org/2000/svg}text")}


def test_axes_of_curves_carry_the_units_of_the_deck(tmp_path):
    moved(
        tmp_path,
        "N-MM",
        "DESS E ; DESS D 'TITX' 'time' ; DESS (1000. * D) ; DESS (E ET D) ; DESS (D COUL 'ROUG') ;",
    )
    assert {"TEMP (s)", "UX (mm/s)"} <= texts(tmp_path, 1)
    assert {"time", "UX (mm)"} <= texts(tmp_path, 2)
    assert {"TEMP", "UX"} <= texts(tmp_path, 3)  # what the script makes of it is its own
    assert {"TEMP", "UX"} <= texts(tmp_path, 4)  # a velocity beside a displacement
    assert {"TEMP (s)", "UX (mm)"} <= texts(tmp_path, 5)  # a colour changes no unit


def test_without_the_option_axes_and_columns_carry_names_alone(tmp_path):
    moved(tmp_path, "", "DESS E ; OPTI SORT 'e.csv' ; SORT 'EXCE' E ;")
    assert {"TEMP", "UX"} <= texts(tmp_path)
    assert (tmp_path / "e.csv").read_text().splitlines()[0] == "TEMP;UX"
    assert (tmp_path / "motion.csv").read_text().splitlines()[0].startswith("TEMP;DEPL_UX_1;")
    assert json.loads((tmp_path / "summary.json").read_text())["units"] is None


def test_columns_of_tables_carry_the_units_of_the_deck(tmp_path):
    moved(
        tmp_path, "KN-M", "OPTI SORT 'e.csv' ; SORT 'EXCE' E ; OPTI SORT 'd.csv' ; SORT 'EXCE' D ;"
    )
    assert (tmp_path / "e.csv").read_text().splitlines()[0] == "TEMP (s);UX (m/s)"
    assert (tmp_path / "d.csv").read_text().splitlines()[0] == "TEMP (s);UX (m)"
    head = (tmp_path / "motion.csv").read_text().splitlines()[0].split(";")
    assert {"TEMP (s)", "DEPL_UX_1 (m)", "VITE_UX_1 (m/s)", "ACCE_UX_1 (m/s2)"} <= set(head)


def test_forces_of_results_keep_their_unit_and_velocities_are_no_lengths():
    assert result_unit("FX", "REAC") == "N"
    assert result_unit("SMXX", "CONTRAINTES") == "Pa"
    assert result_unit("RZ", "ACCE") == "rad/s2"
    assert result_unit("UX", "ANYTHING") == result_unit("WHAT", "DEPL") == ""


def test_axes_of_pictures_in_the_plane_say_the_unit_of_length(tmp_path):
    ran(f"{BODY}OPTI 'UNIT' 'N-MM' 'TRAC' 'SVG' ; TRAC S ;", tmp_path)
    assert {"x (mm)", "y (mm)"} <= texts(tmp_path)


def test_vtk_files_hold_the_units_with_their_sizes(tmp_path):
    text = "OPTI SORT 's' ; SORT 'VTK ' S ; OPTI SORT 't' ; SORT 'VTK ' S 'TEMP' 1. 'NOUV' ;"
    ran(f"{BODY}OPTI 'UNIT' 'N-MM' ; {text}", tmp_path)
    held = meshio.read(tmp_path / "s.vtu").field_data
    sizes = {name: float(value[0]) for name, value in held.items() if ": " in name}
    assert sizes == pytest.approx(
        {"length: mm": 1e-3, "force: N": 1.0, "mass: t": 1e3, "time: s": 1.0, "stress: MPa": 1e6,
         "energy: mJ": 1e-3}
    )  # fmt: skip
    (stepped,) = tmp_path.glob("t.0001*.vtu")
    assert {"TimeValue", "length: mm"} <= set(meshio.read(stepped).field_data)


def test_summary_says_the_units_and_energies_in_joules(tmp_path):
    """The work of 1 N over 0.02 m at the peak; with N and mm the same numbers are a thousandth."""
    for system, largest in (("SI", 0.02), ("N-MM", 0.02e-3), ("KN-M", 20.0)):
        moved(tmp_path / system, system, "")
        told = json.loads((tmp_path / system / "summary.json").read_text())
        (line,) = told["statistics"]["calculations"]
        found = line["energy_imbalance_joules"] / line["energy_imbalance"]
        assert found == pytest.approx(largest, rel=1e-4)
    assert told["units"] == {
        "system": "KN-M", "length": "m", "force": "kN", "mass": "t", "time": "s", "stress": "kPa",
        "energy": "kJ",
    }  # fmt: skip


def test_the_closing_line_says_the_energy_in_the_units_of_the_deck(tmp_path):
    ends = {}
    for system in ("", "N-MM"):
        option = f"OPTI 'UNIT' '{system}' ;" if system else ""
        told, folder = io.StringIO(), tmp_path / (system or "none")
        options = RunOptions(output_directory=folder, summary=True)
        source = Source("deck", MOTION.replace("{option}", option))
        assert run_source(source, options, io.StringIO(), told).exit_code == 0
        ends[system] = told.getvalue().splitlines()[-1]
    assert re.search(r"energy within \S+ %$", ends[""])
    assert re.search(r"energy within \S+ % \(\S+ mJ\)$", ends["N-MM"])


def test_check_knows_the_words_and_finds_a_slip():
    script = "OPTI DIME 2 'UNIT' 'N-MM' 'ELEM' 'QUA4' ; OPTI 'UNIT' 'SI' ;"
    assert check_source(Source("deck", script))[0] == []
    (slip,) = check_source(Source("deck", "OPTI DIME 2 'UNIY' 'SI' ;"))[0]
    assert (slip.code, slip.data["near"]) == ("near-word", "UNIT")


def test_units_are_saved_and_others_are_told(tmp_path):
    ran("OPTI 'UNIT' 'N-MM' ; X = 1 ; OPTI SAUV 'x' ; SAUV X ;", tmp_path)
    again = run_text("OPTI REST 'x' ; REST ; U = VALE 'UNIT' ; LIST X ;", tmp_path)
    assert (again.exit_code, again.session.warnings) == (0, []), again.message
    assert again.session.root.find("U") == "N-MM"
    other = run_text("OPTI 'UNIT' 'SI' 'REST' 'x' ; REST ; U = VALE 'UNIT' ; LIST X ;", tmp_path)
    assert [w.code for w in other.session.warnings] == ["operators.files.other-units"]
    assert other.session.root.find("U") == "SI"

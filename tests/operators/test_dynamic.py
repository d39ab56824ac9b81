"""DYNAMIC: entries, what is kept, files, refusals."""

import numpy as np
import pytest
from references.small_motions import HOPPER, OSCILLATOR
from script_runs import failed, ran
from together import together

from ssilang.cli.run import RunOptions
from ssilang.language.say.diagnostics import sentence


def table(result, name="T2"):
    return result.session.root.find(name)


def fails(text, tmp_path):
    return failed(text, folder=tmp_path).message


def test_free_oscillation_and_the_default_cadence(tmp_path):
    found = table(ran(OSCILLATOR + "T2 = DYNAMIC T1 ;", tmp_path))
    times = [found.get(i).get("TEMP") for i in range(1, len(found) + 1)]
    assert times == pytest.approx(np.arange(26) * 0.04)
    last = found.get(26).get("DEPL")
    node = last.components["UX"].nodes[-1]
    node = int(last.components["UX"].nodes[np.argmax(np.abs(last.components["UX"].values))])
    value = last.values_at("UX", np.array([node]))[0]
    assert value == pytest.approx(np.sin(2.0) / 2, abs=1e-4)


@together(
    "entry, times",
    [
        ("T1 . 'PAS_SAUVES' = 30 ;", [0.0, 0.3, 0.6, 0.9, 1.0]),
        ("T1 . 'PAS_SAUVES' = 'FINAL' ;", [1.0]),
        ("T1 . 'TEMPS_SAUVES' = PROG 0.25 0.5 ;", [0.25, 0.5]),
    ],
)
def test_saved_instants(entry, times, tmp_path):
    found = table(ran(OSCILLATOR + entry + "T2 = DYNAMIC T1 ;", tmp_path))
    assert [found.get(i + 1).get("TEMP") for i in range(len(found))] == pytest.approx(times)
    assert len(found) == len(times)


@together("entry, step", [("T1 . 'FREQ' = 100. ; ", 0.0025), ("", 0.5)])
def test_older_entries_start_at_zero_and_keep_their_instants(entry, step, tmp_path):
    text = OSCILLATOR + "OUBL T1 'TEMPS_CALCULES' ; T1 . 'INST' = PROG 0.5 1. ;" + entry
    text += "T2 = DYNAMIC T1 ; E = T1 . 'ENERGIES' . 'TEMPS' ;"
    result = ran(text, tmp_path)
    found = table(result)
    assert [found.get(i).get("TEMP") for i in (1, 2)] == [0.5, 1.0]
    assert len(found) == 2
    times = table(result, "E").values
    assert times[0] == 0.0
    assert np.diff(times) == pytest.approx(step)


def test_reactions_come_from_the_multipliers(tmp_path):
    text = OSCILLATOR.replace("(BLOQ 'UX' 'UY' Q)", "B ").replace(
        "T1 = TABL ;", "T1 = TABL ; B = BLOQ 'UX' 'UY' Q ;"
    )
    text += "T1 . 'PAS_SAUVES' = 'TOUS' ; T2 = DYNAMIC T1 ;"
    text += "R = MAXI (REAC (T2 . 51 . 'DEPL') B) 'ABS' ; U = EXTR (T2 . 51 . 'DEPL') 'UX' P ;"
    result = ran(text, tmp_path)
    assert table(result, "R") == pytest.approx(4.0 * table(result, "U"), rel=1e-10)


def test_joints_in_the_stiffness_are_replaced_by_their_law(tmp_path):
    one = ran(HOPPER + "T2 = DYNAMIC T1 ;", tmp_path)
    text = HOPPER + "T1 . 'RIGI' = (T1 . 'RIGI') ET (RIGI MO MA) ; T2 = DYNAMIC T1 ;"
    two = ran(text, tmp_path)
    ends = [table(r).get(126).get("DEPL").components["UY"].values for r in (one, two)]
    np.testing.assert_array_equal(*ends)
    assert ends[0].max() > 0.0
    last = table(one).get(126)
    assert last.get("SAUTS").blocks[0].components["EXX"][0, 0] == pytest.approx(ends[0].max())
    energies = table(one, "T1").get("ENERGIES")
    assert np.abs(energies.get("ECART").values).max() < 1e-3


def test_bonded_joint_without_its_law_is_refused(tmp_path):
    text = HOPPER + "T1 . 'RIGI' = (T1 . 'RIGI') ET (RIGI MO MA) ; OUBL T1 'MODELE' ;"
    assert "bonded" in fails(text + "T2 = DYNAMIC T1 ;", tmp_path)


def test_vtk_series_and_csv_file(tmp_path):
    text = f"""{HOPPER}
    T1 . 'PAS_SAUVES_VTK' = 100 ; T1 . 'MAILLAGE_VTK' = J ; T1 . 'FICHIER_VTK' = 'hop' ;
    T1 . 'PAS_SAUVES_CSV' = 'TOUS' ; T1 . 'MAILLAGE_CSV' = MANU 'POI1' P ;
    T1 . 'COMPOSANTES_CSV' = MOTS 'UY' ; T1 . 'FICHIER_CSV' = 'hop' ;
    T1 . 'MAILLAGE_SAUVE' = MANU 'POI1' P ;
    T2 = DYNAMIC T1 ; N = DIME (T1 . 'RESULTATS_CSV') ;
    """
    result = ran(text, tmp_path)
    assert (tmp_path / "hop.pvd").is_file()
    assert len(list(tmp_path.glob("hop.*.vtu"))) == 6
    lines = (tmp_path / "hop.csv").read_text().splitlines()
    assert len(lines) == 502
    assert len(lines[0].split(";")) == table(result, "N") == 4
    assert set(table(result).get(1).get("DEPL").components) == {"UX", "UY"}


@pytest.mark.parametrize(
    ("every", "asked", "one_file"),
    [(10, "", True), (11, "", False), (10, "VTU", False), (100, "VTKHDF", True)],
)
def test_more_than_50_instants_are_one_file_unless_said(every, asked, one_file, tmp_path):
    text = HOPPER + f"T1 . 'PAS_SAUVES_VTK' = {every} ; T1 . 'MAILLAGE_VTK' = J ;"
    text += f"T1 . 'FORMAT_VTK' = '{asked}' ;" if asked else ""
    ran(text + "T2 = DYNAMIC T1 ;", tmp_path)
    instants = -(-501 // every)  # of 501, and the last one
    instants += (501 - 1) % every != 0
    assert (tmp_path / "dynamic.vtkhdf").is_file() == one_file
    assert (tmp_path / "dynamic.pvd").is_file() == (not one_file)
    assert len(list(tmp_path.glob("*.vtu"))) == (0 if one_file else instants)


def test_both_kinds_of_series_have_the_same_fields_and_names(tmp_path):
    import pyvista
    from vtkmodules.vtkIOHDF import vtkHDFReader

    series = HOPPER + "T1 . 'PAS_SAUVES_VTK' = 100 ; T1 . 'MAILLAGE_VTK' = J ;"
    for name in ("VTU", "VTKHDF"):
        ran(series + f"T1 . 'FORMAT_VTK' = '{name}' ; T2 = DYNAMIC T1 ;", tmp_path)
    reader = vtkHDFReader()
    reader.SetFileName(str(tmp_path / "dynamic.vtkhdf"))
    reader.UpdateInformation()
    for step, path in enumerate(sorted(tmp_path.glob("dynamic.*.vtu"))):
        reader.SetStep(step)
        reader.Update()
        one, two = pyvista.wrap(reader.GetOutput()), pyvista.read(path)
        for mine, theirs in ((one.point_data, two.point_data), (one.cell_data, two.cell_data)):
            assert set(mine) == set(theirs) != set()
            for name in mine:
                np.testing.assert_array_equal(mine[name], theirs[name])
        (group,) = (n for n in two.field_data if n.startswith("group_"))
        assert group == "group_J"
        assert set(one.cell_data["group"]) == set(two.field_data[group])
        components = {n for n in one.field_data if ":" in n}  # which a .vtu has in its arrays
        assert {n.split(":")[0] for n in components} <= {*one.point_data, *one.cell_data}
        assert set(one.field_data) - components - {"Time"} == set(two.field_data) - {"TimeValue"}
    assert reader.GetNumberOfSteps() == 6


def test_lists_asked_for_without_a_file_are_written_to_one(tmp_path):
    asked = "T1 . 'PAS_SAUVES_CSV' = 'TOUS' ; T1 . 'MAILLAGE_CSV' = MANU 'POI1' P ;"
    result = ran(HOPPER + asked + "T2 = DYNAMIC T1 ; N = DIME (T1 . 'RESULTATS_CSV') ;", tmp_path)
    lines = (tmp_path / "dynamic.csv").read_text().splitlines()
    assert len(lines) == 502
    assert len(lines[0].split(";")) == table(result, "N")


def test_unresolved_contact_warns_with_the_step_to_use(tmp_path):
    text = HOPPER.replace("1000.", "1.E7") + "T2 = DYNAMIC T1 ;"
    result = ran(text, tmp_path)
    warning = result.session.warnings[0]
    wanted = np.pi * np.sqrt(1.0 / 1e7) / 30
    assert f"{wanted:.3g}" in sentence(warning, "en")[1]
    assert not ran(HOPPER + "T2 = DYNAMIC T1 ;", tmp_path).session.warnings


@together(
    "entry, words",
    [
        ("T1 . 'CHARMECA' = VRAI ;", ["no procedure", "CHARMECA", "DEBP CHARMECA"]),
        ("T1 . 'VITEUNIL' = 'TOTO' ;", ["VITEUNIL", "TOTO"]),
        ("T1 . 'ALPHA_F' = 0.1 ; T1 . 'RHO_INF' = 0.5 ;", ["ALPHA_F", "RHO_INF", "two schemes"]),
        ("T1 . 'ALPHA_F' = 0.5 ;", ["0.5", "out of range"]),
        ("T1 . 'ALPHA_F' = 0.1 ; T1 . 'VITEUNIL' = VRAI ;", ["average acceleration"]),
        ("T1 . 'RIGI' = 3 ;", ["RIGI", "RIGIDITE", "ENTIER"]),
        ("T1 . 'PAS_SAUVES' = 'PARFOIS' ;", ["PARFOIS", "TOUS"]),
        ("T1 . 'TEMPS_SAUVES' = PROG 3. ;", ["3", "outside"]),
        ("T1 . 'TEMPS_CALCULES' = PROG 0. 1. 0.5 ;", ["TEMPS_CALCULES", "0.5 follows 1"]),
        ("OUBL T1 'RIGI' ;", ["RIGI", "missing"]),
        ("T1 . 'CONTACT' = 'PENALITE' ;", ["COEFFICIENT"]),
        ("T1 . 'PAS_SAUVES_VTK' = 1 ;", ["MAILLAGE_VTK", "missing"]),
    ],
)
def test_wrong_entries_are_named(entry, words, tmp_path):
    message = fails(OSCILLATOR + entry + "T2 = DYNAMIC T1 ;", tmp_path)
    for word in words:
        assert word in message


def test_misspelt_entry_is_reported(tmp_path):
    result = ran(OSCILLATOR + "T1 . 'PAS_SAUVE' = 1 ; T2 = DYNAMIC T1 ;", tmp_path)
    assert result.session.warnings[0].data["near"] == "PAS_SAUVES"


def test_schemes_agree_on_a_smooth_motion(tmp_path):
    ends = []
    for entry in (
        "",
        "T1 . 'ALPHA_F' = 0.05 ;",
        "T1 . 'RHO_INF' = 0.9 ;",
        "T1 . 'BETA' = 0.25 ; T1 . 'GAMMA' = 0.5 ;",
        "T1 . 'CONSERVATIF' = VRAI ;",
        "T1 . 'NEWTON_COMPLET' = VRAI ;",
    ):
        text = OSCILLATOR + entry + "T2 = DYNAMIC T1 ; U = EXTR (T2 . 26 . 'DEPL') 'UX' P ;"
        ends.append(table(ran(text, tmp_path), "U"))
    assert ends == pytest.approx([ends[0]] * 6, abs=1e-4)


def test_relation_mini_bounces_and_keeps_energy(tmp_path):
    text = OSCILLATOR.replace("PROG 0. 'PAS' 0.01 1.", "PROG 0. 'PAS' 0.01 6.")
    text += """
    B = BLOQ 'MAXI' 'UX' P ;
    T1 . 'RIGI' = (T1 . 'RIGI') ET B ;
    T1 . 'CHAR' = CHAR 'DIMP' (DEPI B 0.2) (EVOL 'MANU' (PROG 0. 10.) (PROG 1. 1.)) ;
    T1 . 'PAS_SAUVES' = 'TOUS' ; T2 = DYNAMIC T1 ; V = EXTR (T2 . 51 . 'VITE') 'UX' P ;
    M = MAXI (EXTR (EVOL 'TEMP' T2 'DEPL' 'UX' P) 'ORDO') ;
    """
    result = ran(text, tmp_path)
    assert table(result, "M") == pytest.approx(0.2, abs=1e-12)
    assert table(result, "V") < 0.0
    energies = table(result, "T1").get("ENERGIES")
    assert energies.get("ELASTIQUE").values[-1] + energies.get("CINETIQUE").values[
        -1
    ] == pytest.approx(0.5, rel=1e-9)


SHAKEN = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
T = MAILLER 'SOL' 24. 8. 'SEMELLE' 4. 1. 'TAILLE' 0.5 1. ;
V = (T . 'SOL') ET (T . 'SEMELLE') ;
MS = MODE V 'MECANIQUE' 'ELASTIQUE' ;
AS = MATE MS 'YOUN' 5.E7 'NU' 0.3 'RHO' 1900. ;
MJ = MODE (T . 'JOINT') 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
AJ = MATE MJ 'KN' 2.E8 'KS' 1.E8 'FROT' 0.7 ;
R1 = RIGI MS AS ; M1 = MASS MS AS ;
T1 = TABL ;
T1 . 'RIGI' = R1 ET (BLOQ 'DEPL' (T . 'BASE')) ;
T1 . 'MASS' = M1 ; T1 . 'AMOR' = (0.5 * M1) ET (2.E-3 * R1) ;
T1 . 'MODELE' = MJ ; T1 . 'CARACTERISTIQUES' = AJ ;
F = (M1 * (MANU 'CHPO' V 2 'UX' 0. 'UY' -9.81 'NATURE' 'DIFFUS')) ;
T1 . 'CHAR' = CHAR 'MECA' F ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 5.E-3 0.5 ;
"""


def test_reduction_agrees_with_the_whole_model(tmp_path):
    asked = "T2 = DYNAMIC T1 ; T1 . 'REDUCTION' = 1.E-5 ; T3 = DYNAMIC T1 ;"
    result = ran(SHAKEN + asked, tmp_path)
    whole, reduced = result.session.statistics["calculations"]
    assert whole["loop"] == "condensed"
    assert reduced["reduced"]
    assert reduced["estimated_error"] <= 1e-5
    last = [table(result, n).get(26).get("DEPL").components["UY"].values for n in ("T2", "T3")]
    assert np.abs(last[0] - last[1]).max() <= 1e-5 * np.abs(last[0]).max()


def test_motions_share_the_memory_of_their_ground(tmp_path):
    """Made in the first, found by the second; the whole model moves the block alike."""
    still = "T1 . 'DEPL' = RESO ((T1 . 'RIGI') ET (RIGI MI AI)) F ; T1 . 'MAILLAGE_SAUVE' = J ;"
    joint = """
MI = MODE (T . 'JOINT') 'MECANIQUE' 'ELASTIQUE' 'JOI2' ; AI = MATE MI 'KN' 2.E8 'KS' 1.E8 ;
J = (T . 'JOINT') ET (T . 'SEMELLE') ;
LT = T1 . 'TEMPS_CALCULES' ;
EV = EVOL 'MANU' LT (3. * (SIN (720. * LT))) ;
T1 . 'CHAR' = (T1 . 'CHAR') ET (CHAR 'MECA' (M1 * (MANU 'CHPO' V 1 'UX' 1.)) EV) ;
"""
    runs = "".join(
        f"T1 . 'REDUCTION' = 1.E-3 ; T1 . 'MEMOIRE' = 'ground' ; T{i} = DYNAMIC T1 ;"
        for i in (3, 4)
    )
    text = SHAKEN + joint + still + "T2 = DYNAMIC T1 ;" + runs
    options = RunOptions(output_directory=tmp_path / "runs" / "a", shared=tmp_path)
    result = ran(text, options=options)
    lines = result.session.statistics["calculations"]
    assert [line["loop"] for line in lines] == ["condensed", "memory", "memory"]
    assert max(line["estimated_error"] for line in lines[1:]) <= 1e-3
    assert (tmp_path / "ground.npz").is_file()
    found = [table(result, n).get(26).get("DEPL").components["UX"] for n in ("T2", "T3", "T4")]
    for other in found[1:]:
        assert np.abs(other.values - found[0].values).max() <= 1e-3 * np.abs(found[0].values).max()


def test_reduction_of_a_small_problem_runs_it_whole(tmp_path):
    result = ran(OSCILLATOR + "T1 . 'REDUCTION' = 1.E-6 ; T2 = DYNAMIC T1 ;", tmp_path)
    line = result.session.statistics["calculations"][0]
    assert not line["reduced"]
    assert line["estimated_error"] is None
    assert line["not_reduced_because"]


def test_reduction_goes_with_one_method(tmp_path):
    both = "T1 . 'REDUCTION' = 1.E-6 ; T1 . 'NEWTON_COMPLET' = VRAI ; T2 = DYNAMIC T1 ;"
    assert "NEWTON_COMPLET" in fails(OSCILLATOR + both, tmp_path)


def test_a_warning_of_the_library_stands_at_the_scripts_own_line(tmp_path):
    result = ran(OSCILLATOR + "T1 . 'ECON' = VRAI ;\nT2 = DYNAMIC T1 ;", tmp_path)
    warning = next(w for w in result.session.warnings if "'ECON'" in sentence(w, "en")[0])
    assert warning.span.source.name == "script"
    assert warning.span.text == "DYNAMIC"


ROCKING = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 8 (0. 0.) (1. 0.) ; S = L TRAN 30 (0. 3.) ;
G = L PLUS (0. 0.) ; MO = MODE S 'MECANIQUE' 'ELASTIQUE' ;
MA = MATE MO 'YOUN' 3.E9 'NU' 0.2 'RHO' 2500. ;
MJ = MODE (RACC 1.E-3 L G) 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI2' ;
K = RIGI MO MA ; MS = MASS MO MA ; W = MS * (MANU 'CHPO' S 1 'UY' -9.81) ;
LT = PROG 0. PAS 1.E-3 8. ; T = TABL ; T . 'TEMPS_CALCULES' = LT ;
EV = EVOL 'MANU' LT ({0} * (SIN (LT * 450.)) * (MASQ LT 'EGINFE' 0.8)) ;
T . 'RIGI' = K ET (BLOQ 'DEPL' G) ; T . 'MASS' = MS ; T . 'AMOR' = 2.E-5 * K ;
T . 'CHAR' = (CHAR 'MECA' W) ET (CHAR 'MECA' (MS * (MANU 'CHPO' S 1 'UX' 1.)) EV) ;
T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = MATE MJ 'KN' 1.E9 'KS' 1.E9 ;
T . 'PAS_SAUVES' = 80 ; P = S POIN 'PROC' (0. 3.) ; A = DYNAMIC T ;
T . 'REDUCTION' = 3.E-3 ; B = DYNAMIC T ;
X = PROG ; Y = PROG ; REPE B1 100 ; X = X ET (PROG (EXTR (A . &B1 . 'DEPL') 'UX' P)) ;
Y = Y ET (PROG (EXTR (B . &B1 . 'DEPL') 'UX' P)) ; FIN B1 ;
"""


@pytest.mark.parametrize(("push", "amplifies"), [(5.0, True), (1.0, False)])
def test_a_reduced_motion_that_amplifies_is_told(push, amplifies, tmp_path):
    result = ran(ROCKING.format(push), tmp_path)
    told = [
        w for w in result.session.warnings if w.code == "operators.dynamics.reduction-amplified"
    ]
    whole, reduced = (np.array(result.session.root.find(n).values) for n in ("X", "Y"))
    error = np.abs(reduced - whole).max() / np.abs(whole).max()
    estimate = result.session.statistics["calculations"][1]["estimated_error"]
    assert [error > 10 * estimate and error > 3e-3, bool(told)] == [amplifies, amplifies]


PRESSED = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L = DROI 2 (0. 0.) (1. 0.) ; S = L TRAN 2 (0. 1.) ;
M = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE M 'YOUN' 1.E6 'NU' 0.2 'RHO' 1.E3 ; H = COTE 3 S ;
LT = PROG 0. 'PAS' 1.E-3 0.03 ; E = EVOL 'MANU' LT (SIN (LT * 3000.)) ;
MP = MODE H 'CHARGEMENT' 'PRESSION' ;
DEBP RUND C*CHARGEME ;
  T = TABL ; T . 'RIGI' = (RIGI M A) ET (BLOQ 'DEPL' L) ; T . 'MASS' = MASS M A ; T . 'CHAR' = C ;
  T . 'TEMPS_CALCULES' = LT ; T . 'PAS_SAUVES' = 1 ; R = DYNAMIC T ;
FINP (R . 31 . 'DEPL') ;
"""


def test_a_pressure_given_as_its_forces_is_a_load_by_any_name(tmp_path):
    end = "U = RUND (CHAR '{0}' (PRES 'MASS' M 1.E4 H) E) ; X = MAXI U 'ABS' ;"
    pressed, forced = (
        ran(PRESSED + end.format(n), tmp_path).session.root for n in ("PRES", "MECA")
    )
    assert pressed.find("X") > 1e-3
    assert pressed.find("X") == forced.find("X")
    assert "PRES is not mechanical" in fails(
        PRESSED + "U = RUND (CHAR 'PRES' (PRES MP 'PRES' 1.E4) E) ;", tmp_path
    )

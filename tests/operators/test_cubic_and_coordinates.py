"""DEG3; POINTCYL and POINTSPH of the library."""

import pytest
from script_runs import ran

from ssilang.cli.run import run_text


def values(text, folder, *names):
    result = ran(text, output_directory=folder)
    return [result.session.root.find(n) for n in names]


def test_three_real_roots_in_growing_order(tmp_path):
    text = "R1 I1 R2 I2 R3 I3 = DEG3 -6. 11. -6. 1. ;"
    found = values(text, tmp_path, "R1", "I1", "R2", "I2", "R3", "I3")
    assert found == pytest.approx([1.0, 0.0, 2.0, 0.0, 3.0, 0.0], abs=1e-12)


def test_one_real_root_and_a_pair(tmp_path):
    text = "R1 I1 R2 I2 R3 I3 = DEG3 -1. 0. 0. 1. ;"  # cube roots of one
    found = values(text, tmp_path, "R1", "I1", "R2", "I2", "R3", "I3")
    half = 3**0.5 / 2
    assert found == pytest.approx([1.0, 0.0, -0.5, -half, -0.5, half], abs=1e-12)


def test_a_parabola_is_refused(tmp_path):
    assert run_text("R1 I1 = DEG3 1. 2. 3. 0. ;", output_directory=tmp_path).exit_code == 1


def test_cylindrical_and_spherical_points(tmp_path):
    text = "OPTI DIME 3 ; P = POINTCYL 2. 90. 5. ; X Y Z = COOR P ;"
    assert values(text, tmp_path, "X", "Y", "Z") == pytest.approx([0.0, 2.0, 5.0], abs=1e-12)
    text = "OPTI DIME 3 ; P = POINTSPH 2. 180. 30. ; X Y Z = COOR P ;"
    found = values(text, tmp_path, "X", "Y", "Z")
    assert found == pytest.approx([-(3**0.5), 0.0, 1.0], abs=1e-12)


def test_lists_give_meshes_of_points(tmp_path):
    text = "OPTI DIME 2 ; M = POINTCYL (PROG 1. 2. 3.) (PROG 0. 90. 180.) ; N = NBNO M ;"
    assert values(text, tmp_path, "N") == [3]
    text = "OPTI DIME 3 ; L = PROG 1. 2. ; M = POINTSPH L L L ; N = NBNO M ;"
    assert values(text, tmp_path, "N") == [2]


def test_spherical_points_need_three_dimensions(tmp_path):
    result = run_text("OPTI DIME 2 ; P = POINTSPH 1. 2. 3. ;", output_directory=tmp_path)
    assert result.errors[0].code == "stdlib.pointsph-spherical-coordinates-need-opti"

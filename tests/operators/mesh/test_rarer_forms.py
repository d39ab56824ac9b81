"""Rarer meshing operators and forms, as scripts write them."""

from typing import Any

import numpy as np
import pytest
from script_runs import failed, ran
from together import together

PLANE = "OPTI DIME 2 ELEM QUA4 ; O = 0. 0. ; A = 1. 0. ; B = 1. 1. ; E = 0. 1. ; "
SPACE = "OPTI DIME 3 ELEM CUB8 ; O = 0. 0. 0. ; A = 1. 0. 0. ; Z = 0. 0. 1. ; "


def value(script: str, name: str = "X") -> Any:
    return ran(script).session.root.find(name)


def message(script: str) -> str:
    return failed(script).message


FRAME = """OPTI DIME 2 ELEM SEG2 ; O = 0. 0. ; A = 4. 0. ; B = 4. 4. ; E = 0. 4. ;
C = O D 4 A D 4 B D 4 E D 4 O ; M = C POIN 'PROC' (2. 0.) ; """


def test_nothing_found_in_a_field_is_an_empty_mesh_and_a_doubt() -> None:
    field = FRAME + "U = COOR 1 C ; "
    for none in ("U POIN 'SUPE' 9.", "U POIN 'MAXI' 'SANS' (MOTS 'SCAL')"):
        assert value(field + f"V = {none} ; X = NBEL V ;") == 0
        assert value(field + f"V = {none} ; X = SOUC ;") is True
    assert value(field + "V = U POIN 'SUPE' 3. ; X = SOUC ;") is False


@together(
    "length, option, inwards",
    [("1.", "", True), ("-1.", "", False), ("1.", "'ORIE'", True), ("-1.", "'ORIE'", True)],
)
def test_skin_of_cells_in_the_direct_sense_faces_inwards(length, option, inwards) -> None:
    script = (
        "OPTI DIME 3 ELEM CUB8 ; S = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 2 (0. 1. 0.) ; "
        f"V = S VOLU 2 'TRAN' (0. 0. {length}) ; X = ENVE V {option} ; "
    )
    skin = value(script)
    faces = np.concatenate([b.coordinates for b in skin.blocks])
    middle = faces.mean(axis=(0, 1))
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    sides = (normals * (faces.mean(axis=1) - middle)).sum(axis=1)
    assert ((sides < 0) == inwards).all()


@together("skin, cells", [("E", {"TE10", "PY13"}), ("(CHAN 'TRI6' E)", {"TE10"})])
def test_quadratic_skins_are_filled_and_keep_their_middles(skin: str, cells: set[str]) -> None:
    script = SPACE + (
        "OPTI ELEM CU20 ; V = ((O D 2 A) TRAN 2 (0. 1. 0.)) VOLU 2 'TRAN' Z ; E = ENVE V ; "
        f"F = {skin} ; W = VOLU F ; N = NBNO F ; G = ENVE W ; K = NBNO G ; "
    )
    assert set(value(script + "X = W ELEM 'TYPE' ;").values) == cells
    assert value(script + "X = MESU W ;") == pytest.approx(1.0)
    # the skin's nodes are those of the volume: all cells are common
    assert value(script + "X = NBEL (G INTE F) ;") == value(script + "X = NBEL F ;")

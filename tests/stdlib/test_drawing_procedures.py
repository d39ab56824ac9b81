"""ANIME AFFICHE CINEMA CINEMB @VIS3D @CARTOON @VISOR @REPERE: what they give to the picture."""

import numpy as np
import pytest
from script_runs import found, ran

from tests.windows import needs_window

_BAND = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((0. 0.) DROI 4 (4. 0.)) TRAN 2 (0. 1.) ; "
    "U = (NOMC 'UX' (0. * (COOR 1 S))) ET (NOMC 'UY' (COOR 1 S)) ; "
)


def positions(part):
    """Where the nodes of a drawn shape stand."""
    nodes = np.unique(np.concatenate([b.connectivity.ravel() for b in part.mesh.blocks]))
    at = part.mesh.nodes.coordinates[nodes].copy()
    for k, name in enumerate(("UX", "UY", "UZ")):
        at[:, k] += part.scale * part.displacement.values_at(name, nodes)
    return at


def largest(field):
    return float(max(c.values.max() for c in field.components.values()))


def test_animated_shapes_grow_to_the_full_amplitude():
    shape = found(_BAND + "D = ANIME 4 S U 0.2 ;", "D")
    assert [p.scale for p in shape.parts] == pytest.approx([0.05, 0.1, 0.15, 0.2])


def test_animated_forces_and_scalars_grow_alike():
    shape = found(
        _BAND + "F = FORC (0. 8.) (S POIN 1) ; D = ANIME 2 S U 0.2 F 0.5 'BLEU' (COOR 1 S) ;", "D"
    )
    tips = [np.abs(p.arrows.parts[0].vectors).max() for p in shape.parts]
    assert tips == pytest.approx([4.0, 8.0])
    assert [largest(p.field) for p in shape.parts] == pytest.approx([2.0, 4.0])


def test_lone_second_field_is_the_scalar_shown():
    shape = found(_BAND + "D = ANIME 2 S U 0.2 (COOR 1 S) ;", "D")
    assert [p.arrows for p in shape.parts] == [None, None]
    assert [largest(p.field) for p in shape.parts] == pytest.approx([2.0, 4.0])


def test_cartoon_amplifies_to_a_tenth_of_the_mesh():
    table = "T = TABL ; T . 'RESUDEPL' = TABL ; T . 'RESUDEPL' . 0 = 0. * U ; "
    shape = found(_BAND + table + "T . 'RESUDEPL' . 1 = U ; D = @CARTOON T S 'NOSCIL' ;", "D")
    assert len(shape.parts) == 2
    assert positions(shape.parts[1])[:, 1].max() == pytest.approx(1.0 + 0.4)


def test_walk_brings_each_view_into_the_first_frame():
    """A line 5 ahead stands in one place for all who see it so, 5 farther from twice as far."""
    views = found(
        "OPTI DIME 3 ELEM SEG2 ; L = (0. 0. 0.) DROI 1 (0. 0. 1.) ; "
        "Q = (0. -5. 0.) ET (5. 0. 0.) ET (0. -10. 0.) ; "
        "V = (0. 1. 0.) ET (-1. 0. 0.) ET (0. 2. 0.) ; D = CINEMA L Q V (0. 0. 2.) ; ",
        "D",
    ).parts
    still = positions(views[0])
    assert positions(views[1]) == pytest.approx(still)
    assert still == pytest.approx(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
    assert positions(views[2]) == pytest.approx(still + np.array([0.0, 5.0, 0.0]))


def test_turned_head_turns_the_view():
    views = found(
        "OPTI DIME 3 ELEM SEG2 ; L = (0. 0. 0.) DROI 1 (0. 0. 1.) ; Q = (0. -5. 0.) ET (0. -5. "
        "0.) ; "
        "V = (0. 1. 0.) ET (0. 1. 0.) ; D = CINEMB L Q V ((0. 0. 1.) ET (1. 0. 0.)) ; ",
        "D",
    ).parts
    assert positions(views[1])[1] == pytest.approx([-1.0, 0.0, 0.0], abs=1e-12)


def test_arrows_tell_the_sense_of_plane_elements():
    script = "OPTI DIME 2 ELEM QUA4 ; S = ((0. 0.) DROI 1 (3. 0.)) TRAN 1 (0. 3.) ; "
    up = found(script + "V = @VISOR S ;", "V").parts[0]
    down = found(script + "V = @VISOR (INVE S) 1. 'BLEU' ;", "V").parts[0]
    assert up.vectors[0, :2] == pytest.approx([0.0, 2.0])
    assert down.vectors[0, :2] == pytest.approx([0.0, -3.0])


def test_arrows_follow_lines_and_normals():
    line = found("OPTI DIME 2 ELEM SEG3 ; V = @VISOR ((0. 0.) DROI 1 (3. 3.)) 1. ;", "V").parts[0]
    assert line.vectors[0, :2] == pytest.approx([3.0, 3.0])
    skin = found(
        "OPTI DIME 3 ELEM QUA8 ; S = ((0. 0. 0.) DROI 1 (0. 2. 0.)) TRAN 1 (0. 0. 2.) ; "
        "V = @VISOR S 1. ;",
        "V",
    ).parts[0]  # fmt: skip
    assert skin.vectors[0] == pytest.approx([2.0, 0.0, 0.0])


def test_axes_have_the_lengths_asked_for():
    mesh, plain = found(
        "OPTI DIME 3 ; A = @REPERE (1. 1. 1.) (PROG 2. 3. 4.) 'ROUG' ; "
        "B = @REPERE (1. 1. 1.) (PROG 2. 3. 4.) FAUX ; XA = MAXI (COOR 1 B) ; YA = MAXI (COOR 2 "
        "B) ; "
        "ZA = MAXI (COOR 3 B) ;",
        "A", "B",
    )  # fmt: skip
    assert sum(b.connectivity.shape[0] for b in plain.blocks) == 9
    assert sum(b.connectivity.shape[0] for b in mesh.blocks) == 9 + 2 + 2 + 3
    at = plain.nodes.coordinates[np.concatenate([b.connectivity.ravel() for b in plain.blocks])]
    assert at.max(axis=0) == pytest.approx([3.0, 4.0, 5.0])


@needs_window
def test_turned_skin_and_loaded_shape_are_drawn(tmp_path):
    script = _BAND + (
        "MO = MODE S MECANIQUE ELASTIQUE ; R = (RIGI MO (MATE MO YOUN 1.E3 NU 0.)) ET "
        "(BLOQ 'DEPL' (COTE 4 S)) ; AFFICHE R (FORC (0. -1.) (S POIN 'PROC' (4. 1.))) S 1. 0.5 ; "
        "OPTI DIME 3 ELEM CUB8 ; V = (((0. 0. 0.) DROI 1 (2. 0. 0.)) TRAN 1 (0. 1. 0.)) VOLU 1 "
        "TRAN (0. 0. 1.) ; @VIS3D V (0. 0. 0.) (0. 0. 1.) (0. -9. 4.) 3 60. ;"
    )
    ran(script, output_directory=tmp_path)
    assert len(list(tmp_path.rglob("*.png"))) == 2

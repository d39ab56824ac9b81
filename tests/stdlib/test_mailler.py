"""MAILLER: where its parts lie, what they share, what it refuses."""

import numpy as np
import pytest
from script_runs import found
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.values import Mot, Table

BOX = "'SOL' 24. 8. 'SEMELLE' 4. 1. 'STRUCTURE' 2. 6. 'TAILLE' 0.5 2."


def mailler(call: str, options: str = "OPTI DIME 2 ELEM QUA4 ;") -> Table:
    """The table of a call of MAILLER."""
    return found(f"{options} {call if 'T1 =' in call else 'T1 = MAILLER ' + call + ' ;'}", "T1")


def part(table: Table, name: str) -> Mesh:
    found = table.get(Mot(name))
    assert isinstance(found, Mesh), name
    return found


def box(mesh: Mesh) -> list[float]:
    """Smallest and largest x, smallest and largest y."""
    x = mesh.nodes.coordinates[mesh.sorted_node_ids]
    return [*(x[:, 0].min(), x[:, 0].max()), *(x[:, 1].min(), x[:, 1].max())]


def signed_areas(mesh: Mesh) -> np.ndarray:
    """Areas of the cells' corner polygons, positive when they turn the right way."""
    areas = []
    for block in mesh.blocks:
        corners = 4 if block.cell_type.startswith("QUA") else 3
        step = 2 if block.cell_type in ("QUA8", "TRI6") else 1
        x = block.coordinates[:, : corners * step : step, :2]
        y = np.roll(x, -1, axis=1)
        areas.append(0.5 * np.sum(x[..., 0] * y[..., 1] - x[..., 1] * y[..., 0], axis=1))
    return np.concatenate(areas)


@pytest.mark.parametrize("element", ["QUA4", "QUA8", "TRI3", "TRI6"])
def test_parts_fill_their_rectangles_and_turn_the_right_way(element):
    t = mailler(BOX + f" 'ELEMENT' '{element}'")
    for name, area, limits in (
        ("SOL", 192.0, [-12, 12, -8, 0]),
        ("SEMELLE", 4.0, [-2, 2, 0, 1]),
        ("STRUCTURE", 12.0, [-1, 1, 1, 7]),
    ):
        cells = signed_areas(part(t, name))
        assert np.all(cells > 0.0), name
        assert cells.sum() == pytest.approx(area, rel=1e-12)
        assert box(part(t, name)) == pytest.approx(limits, abs=1e-12)
        assert {b.cell_type for b in part(t, name).blocks} == {element}
    assert signed_areas(part(t, "TOTAL")).sum() == pytest.approx(208.0, rel=1e-12)


def test_named_lines_and_points_lie_where_their_names_say():
    t = mailler(BOX)
    for name, limits in (
        ("BASE", [-12, 12, -8, -8]),
        ("GAUCHE", [-12, -12, -8, 0]),
        ("DROITE", [12, 12, -8, 0]),
        ("COTES", [-12, 12, -8, 0]),
        ("SIDES", [-12, 12, -8, 0]),
        ("SURFACE", [-12, 12, 0, 0]),
        ("FACE_SOL", [-2, 2, 0, 0]),
        ("FACE_SEMELLE", [-2, 2, 0, 0]),
        ("FOOTING", [-2, 2, 0, 1]),
    ):
        assert box(part(t, name)) == pytest.approx(limits, abs=1e-12), name
    for name, place in (
        ("CENTRE", (0, 0)),
        ("SOMMET", (0, 7)),
        ("BORD_GAUCHE", (-2, 0)),
        ("BORD_DROIT", (2, 0)),
    ):
        point = t.get(Mot(name))
        assert isinstance(point, Point)
        assert point.coordinates[:2] == pytest.approx(place, abs=1e-12)


def test_joint_has_double_nodes_and_the_structure_is_tied_to_its_footing():
    t = mailler(BOX)
    upper, lower = (set(part(t, n).node_ids) for n in ("FACE_SEMELLE", "FACE_SOL"))
    assert len(upper) == len(lower) == 9
    assert not upper & lower
    assert lower <= set(part(t, "SOL").node_ids)
    assert upper <= set(part(t, "SEMELLE").node_ids)
    assert part(t, "JOINT").n_cells == 8
    assert set(part(t, "JOINT").node_ids) == upper | lower
    shared = set(part(t, "SEMELLE").node_ids) & set(part(t, "STRUCTURE").node_ids)
    assert len(shared) == 5
    assert not set(part(t, "SOL").node_ids) & set(part(t, "SEMELLE").node_ids)


def test_table_and_keywords_give_the_same_meshes():
    t = mailler(BOX)
    fields = {
        "LARGEUR_SOL": 24.0,
        "PROFONDEUR_SOL": 8,
        "LARGEUR_SEMELLE": 4,
        "HAUTEUR_SEMELLE": 1.0,
        "LARGEUR_STRUCTURE": 2.0,
        "HAUTEUR_STRUCTURE": 6.0,
        "TAILLE": 0.5,
        "TAILLE_LOIN": 2.0,
    }
    lines = " ".join(f"T0 . '{k}' = {v} ;" for k, v in fields.items())
    u = mailler(f"T0 = TABL ; {lines} T1 = MAILLER T0 ;")
    for name in ("SOL", "SEMELLE", "STRUCTURE", "JOINT"):
        a, b = part(t, name), part(u, name)
        assert a.n_cells == b.n_cells
        assert np.allclose(
            a.nodes.coordinates[a.node_ids], b.nodes.coordinates[b.node_ids], atol=1e-12
        )


def test_cells_are_small_near_the_footing_and_large_far_from_it():
    t = mailler(BOX)
    x = np.unique(np.round(part(t, "BASE").nodes.coordinates[part(t, "BASE").node_ids, 0], 9))
    widths = np.diff(x)
    assert widths[np.abs(x[:-1] + 0.25) < 1.7] == pytest.approx(0.5)
    assert 1.5 < widths[-1] < 2.5
    assert np.all(np.diff(widths[x[:-1] >= 2.0]) >= -1e-9)


@together("options", ["OPTI DIME 2 MODE PLAN ELEM QUA4 ;", "OPTI DIME 2 MODE AXIS ;"])
def test_half_a_model_lies_right_of_its_axis(options):
    word = "" if "AXIS" in options else " 'SYMETRIE'"
    t = mailler(BOX + word, options)
    assert box(part(t, "SOL")) == pytest.approx([0, 12, -8, 0], abs=1e-12)
    assert box(part(t, "AXE")) == pytest.approx([0, 0, -8, 0], abs=1e-12)
    assert part(t, "JOINT").n_cells == 4
    assert box(part(t, "STRUCTURE")) == pytest.approx([0, 1, 1, 7], abs=1e-12)
    assert t.get(Mot("GAUCHE")) is None


def test_column_goes_down_through_the_footing_on_shared_nodes():
    t = mailler("'SOL' 24. 8. 'SEMELLE' 4. 1. 'POTEAU' 6. 'TAILLE' 0.5 2. 'ABSCISSE' 3.")
    column = part(t, "STRUCTURE")
    assert {b.cell_type for b in column.blocks} == {"SEG2"}
    assert box(column) == pytest.approx([3, 3, 0, 7], abs=1e-12)
    assert len(set(column.node_ids) & set(part(t, "SEMELLE").node_ids)) == 3
    assert box(part(t, "FACE_SOL")) == pytest.approx([1, 5, 0, 0], abs=1e-12)


def test_welded_footing_shares_the_soil_nodes():
    t = mailler(BOX + " 'SOUDE'")
    assert t.get(Mot("JOINT")) is None
    assert len(set(part(t, "SOL").node_ids) & set(part(t, "SEMELLE").node_ids)) == 9


def test_footing_without_soil_stands_on_a_fixed_line():
    t = mailler("'SEMELLE' 4. 'STRUCTURE' 4. 6. 'TAILLE' 0.5")
    assert t.get(Mot("SOL")) is None
    assert box(part(t, "BASE")) == pytest.approx([-2, 2, 0, 0], abs=1e-12)
    assert part(t, "JOINT").n_cells == 8
    assert part(t, "TOTAL").n_cells == part(t, "STRUCTURE").n_cells == 96


def test_unknown_or_mistyped_index_of_the_table_is_named():
    start = "OPTI DIME 2 ; T0 = TABL ; T0 . 'LARGEUR_SEMELLE' = 4. ;"
    unknown = run_text(f"{start} T0 . 'LARGUEUR_SOL' = 3. ; T1 = MAILLER T0 ;")
    assert unknown.session.warnings[0].data["near"] == "LARGEUR_SOL"
    mistyped = run_text(f"{start} T0 . 'TAILLE' = 'fine' ; T1 = MAILLER T0 ;")
    assert "'TAILLE' must be FLOTTANT, found MOT" in mistyped.message

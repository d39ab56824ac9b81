"""Runs decks and keeps small copies of their pictures for the pages of `cases/`.

    python cases/make_pictures.py [deck ...]

Each picture is the deck's own (DESS or TRAC), scaled to 640 pixels and 128 colours.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

HERE = Path(__file__).parent
WIDTH, COLOURS, LARGEST = 640, 128, 60_000

# deck: number of its picture to name of the copy
PICTURES = {
    "club_cast3m_2014/club_a_methods": {1: "club_a_displacement", 2: "club_a_velocity"},
    "club_cast3m_2014/club_b_sdm": {1: "club_b_displacement", 2: "club_b_velocity"},
    "club_cast3m_2014/club_c_sdm": {1: "club_c_displacement"},
    "club_cast3m_2014/rocking_two_pairs": {1: "rocking_two_pairs"},
    "footing/strip_uplift": {1: "strip_uplift"},
    "footing/disc_uplift": {1: "disc_uplift"},
    "footing/embedded_disc": {2: "disc_impedance"},
    "footing/onset_of_uplift": {1: "onset_of_uplift"},
    "footing/macro_element": {2: "macro_rocking"},
    "footing/macro_plastic": {1: "macro_plastic", 2: "macro_settlement"},
    "footing/macro_against_soil": {1: "macro_against_soil"},
    "footing/bridge_pier": {1: "bridge_pier"},
    "footing/wind_turbine": {1: "wind_turbine"},
    "footing/winkler_beam": {1: "winkler_beam"},
    "footing/flexible_tower": {1: "flexible_tower"},
    "footing/raft_3d": {1: "raft_3d"},
    "footing/tower_3d": {1: "tower_3d"},
    "footing/housner_block": {1: "housner_block"},
    "footing/block_on_soil": {1: "block_lift", 3: "block_energies", 4: "block_deformed"},
    "basics/patch_elements": {1: "patch_elements"},
    "basics/patch_joint": {1: "patch_joint"},
    "basics/cantilever": {1: "cantilever"},
    "basics/lifted_beam": {1: "lifted_beam"},
    "basics/fibre_column": {1: "fibre_column"},
    "basics/rubbing_cylinder": {1: "rubbing_cylinder"},
    "basics/beam_frequencies": {1: "beam_frequencies"},
    "basics/bar_frequencies": {1: "bar_frequencies"},
    "impact/bar_bounce": {1: "bar_bounce"},
    "published/friction_slider": {1: "friction_slider"},
    "published/bar_on_wall": {1: "bar_on_wall"},
    "published/sheared_fault": {1: "sheared_fault"},
    "published/newmark_by_hand": {1: "newmark_by_hand"},
    "published/rocking_block": {1: "rocking_block"},
    "published/rocking_wall": {1: "rocking_wall"},
    "published/wave_in_column": {1: "wave_in_column"},
    "published/nafems_contact": {1: "nafems_contact"},
    "published/equivalent_linear": {1: "equivalent_linear"},
    "seismic/tower_on_cones": {1: "tower_on_cones"},
    "seismic/incoherent_raft": {1: "incoherent_spectrum", 2: "incoherent_factors"},
    "seismic/isolated_block": {1: "isolated_roof", 2: "isolated_loops"},
    "seismic/record_to_verdict": {1: "verdict_spectrum", 2: "verdict_record"},
    "seismic/oblique_waves": {1: "oblique_waves"},
    "seismic/matched_layer": {1: "matched_lift", 2: "matched_energy"},
    "seismic/soil_column": {1: "column_surface", 2: "column_loops"},
    "seismic/reactor": {
        1: "reactor_open",
        2: "reactor_moment",
        4: "reactor_spectrum",
        8: "reactor_pressure",
        9: "reactor_deformed",
    },
    "seismic/tower_quake": {
        1: "quake_surface",
        2: "quake_lift",
        3: "quake_moment",
        4: "quake_deformed",
    },
}


def shrink(source: Path, target: Path) -> None:
    """A small copy of a picture."""
    image = Image.open(source).convert("RGB")
    height = round(image.height * WIDTH / image.width)
    small = image.resize((WIDTH, height), Image.Resampling.LANCZOS)
    small.quantize(COLOURS, Image.Quantize.MAXCOVERAGE).save(target, optimize=True)
    if target.stat().st_size > LARGEST:
        raise SystemExit(f"{target} is larger than {LARGEST} bytes")


def main(decks: list[str]) -> None:
    """Make the pictures of some decks, all if none is named."""
    for deck in decks or PICTURES:
        target = HERE / Path(deck).parent / "pictures"
        target.mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-m", "ssilang.cli.main", f"{HERE / deck}.ssi"]
            subprocess.run([*command, "--out", folder], check=True, capture_output=True)
            for number, name in PICTURES[deck].items():
                (source,) = Path(folder).glob(f"{number:04d}_*.png")
                shrink(source, target / f"{name}.png")


if __name__ == "__main__":
    main(sys.argv[1:])

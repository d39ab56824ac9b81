"""Every deck of `cases/` runs and passes; spoilt, it says so and the run fails.

That its checks can fail is a deck's own: what costs more than a glance is tried again when the deck
changes, or what spoils it. `spoilt.toml` has the digest of those that failed as they should.
"""

import hashlib
import json
import os
import re
import tomllib
from pathlib import Path

import pytest

from ssilang.language.run.session import Check
from ssilang.operators.drawing import pictures, scenes
from ssilang.operators.files import writing

from .comparisons import COMPARISONS
from .running import CASES, DECKS, run_changed, run_deck

# deck, text of the deck, what spoils it: a stiffness, a load, a tolerance
SPOILT = [
    ("basics/patch_elements.ssi", "SIG0 = YOU0 * 1.E-3 /", "SIG0 = 1.001 * YOU0 * 1.E-3 /"),
    ("basics/patch_joint.ssi", "((1. / KN0) +", "((1.001 / KN0) +"),
    ("basics/cantilever.ssi", "'INRZ' INE0", "'INRZ' (1.001 * INE0)"),
    ("basics/lifted_beam.ssi", "'INRZ' INE0", "'INRZ' (1.05 * INE0)"),
    ("basics/fibre_column.ssi", "'SIGY' SY0", "'SIGY' (1.01 * SY0)"),
    ("basics/rubbing_cylinder.ssi", "'MU' MU0)", "'MU' (1.1 * MU0))"),
    (
        "basics/beam_frequencies.ssi",
        "'TORS' 1.E-8",
        "'TORS' 1.E-8 'SECY' (0.1 * SEC0) 'SECZ' (0.1 * SEC0)",
    ),
    ("basics/bar_frequencies.ssi", "'RHO' RHO0", "'RHO' (1.01 * RHO0)"),
    ("club_cast3m_2014/club_a_methods.ssi", "INR0 'INRZ' INR0", "INR0 'INRZ' (1.02 * INR0)"),
    ("club_cast3m_2014/club_b_sdm.ssi", "'KN' KY0 'KS'", "'KN' (1.02 * KY0) 'KS'"),
    ("club_cast3m_2014/club_c_sdm.ssi", "'KN' KY0 'KS'", "'KN' (1.02 * KY0) 'KS'"),
    ("club_cast3m_2014/rocking_two_pairs.ssi", "'KN' K0 'KS'", "'KN' (1.02 * K0) 'KS'"),
    ("footing/winkler_beam.ssi", "'KN' K0 'KS'", "'KN' (1.02 * K0) 'KS'"),
    ("footing/flexible_tower.ssi", "'KN' K0 'KS'", "'KN' (1.02 * K0) 'KS'"),
    ("footing/tower_3d.ssi", "'KN' K0 'KS'", "'KN' (1.02 * K0) 'KS'"),
    ("footing/raft_3d.ssi", "'KN' K0 'KS'", "'KN' (1.01 * K0) 'KS'"),
    ("footing/housner_block.ssi", "'ROTA' J0 PC", "'ROTA' (1.01 * J0) PC"),
    ("impact/bar_bounce.ssi", "'YOUN' YOU0", "'YOUN' (1.05 * YOU0)"),
    ("footing/block_on_soil.ssi", "W0 = RHOB * B0", "W0 = 1.01 * RHOB * B0"),
    ("footing/disc_uplift.ssi", "'KN' K0 'KS'", "'KN' (1.1 * K0) 'KS'"),
    ("footing/embedded_disc.ssi", "'YOUN' (2. * G0", "'YOUN' (2.1 * G0"),
    ("footing/macro_element.ssi", "'KS' 1.E8 'RAYO' R0", "'KS' 1.E8 'RAYO' (1.001 * R0)"),
    ("footing/macro_plastic.ssi", "'LARG' B0 'COHE' C0 ;", "'LARG' B0 'COHE' (1.02 * C0) ;"),
    ("footing/macro_against_soil.ssi", "'LARG' B0 'COHE' C0", "'LARG' B0 'COHE' (0.9 * C0)"),
    ("footing/onset_of_uplift.ssi", "'MZ' (N0 * B0 / 6.)", "'MZ' (1.01 * N0 * B0 / 6.)"),
    ("footing/wind_turbine.ssi", "'KN' K0 'KS' K0", "'KN' (1.03 * K0) 'KS' K0"),
    ("footing/when_it_matters.ssi", "'KS' KH0 'RAYO'", "'KS' (1.02 * KH0) 'RAYO'"),
    ("footing/bridge_pier.ssi", "MAJ = MATE MOJ 'KN' K0", "MAJ = MATE MOJ 'KN' (1.02 * K0)"),
    ("footing/strip_uplift.ssi", "'KN' K0 'KS'", "'KN' (1.02 * K0) 'KS'"),
    ("published/unilateral_plate.ssi", "KTOT = 1.E4", "KTOT = 1.001E4"),
    ("published/friction_slider.ssi", "'FROT' MU0", "'FROT' (1.02 * MU0)"),
    ("published/equivalent_linear.ssi", "'CHI' = 0.65", "'CHI' = 0.75"),
    ("published/bar_on_wall.ssi", "'YOUN' YOU0", "'YOUN' (1.05 * YOU0)"),
    ("published/mass_on_stop.ssi", "MASS 'DEPL' M1 PB", "MASS 'DEPL' (1.02 * M1) PB"),
    ("published/shaken_slider.ssi", "'FROT' MU0", "'FROT' (1.002 * MU0)"),
    ("published/newmark_by_hand.ssi", "MASS 'DEPL' M0 PB", "MASS 'DEPL' (1.005 * M0) PB"),
    ("published/rocking_block.ssi", "'ROTA' (M0 *", "'ROTA' (1.02 * M0 *"),
    ("published/rocking_wall.ssi", "'ROTA' J0 PG", "'ROTA' (1.2 * J0) PG"),
    ("published/nafems_contact.ssi", "'YOUN' 70000.", "'YOUN' 71000."),
    ("published/wave_in_column.ssi", "'YOUNG' = YOU0", "'YOUNG' = 1.2 * YOU0"),
    ("published/sheared_fault.ssi", "'FROT' MU0", "'FROT' (1.03 * MU0)"),
    ("published/nafems_elasticity.ssi", "-10.E6 OUT1", "-10.1E6 OUT1"),
    ("published/nafems_vibration.ssi", "P3 = 10. 0.5", "P3 = 10. 0.52"),
    ("seismic/tower_on_cones.ssi", "'RAYON' = R0", "'RAYON' = 1.02 * R0"),
    ("seismic/incoherent_raft.ssi", "'INCOHERENCE' = GAM0 ; RCHA", "'INCOHERENCE' = 0.21 ; RCHA"),
    ("seismic/isolated_block.ssi", "'FROT' MU0", "'FROT' (1.01 * MU0)"),
    ("seismic/record_to_verdict.ssi", "LFO0 = 1.2 *", "LFO0 = 1.21 *"),
    ("seismic/oblique_waves.ssi", "TCO . 'YOUNG' = YOUS", "TCO . 'YOUNG' = (1.05 * YOUS)"),
    (
        "seismic/matched_layer.ssi",
        "TCOU = SECOUSSE",
        "TPM . 'REFLEXION' = 0.5 ; TCOU = SECOUSSE",
    ),
    ("seismic/soil_column.ssi", "'GAMR' GR0", "'GAMR' (1.02 * GR0)"),
    ("starters/oscillator.ssi", "'INRY' INE0 'INRZ' INE0", "'INRY' INE0 'INRZ' (1.02 * INE0)"),
    ("starters/frame.ssi", "(-1. * G0)", "(-1.001 * G0)"),
    ("starters/tower.ssi", "'RHO' 2000.", "'RHO' 2001."),
    ("starters/raft.ssi", "FG = FORC (0. 0. (-1. * WEI0))", "FG = FORC (0. 0. (-1.01 * WEI0))"),
    ("seismic/reactor.ssi", "'KS' KN0 'FROT' MU0", "'KS' KN0 'FROT' (1.1 * MU0)"),
    ("seismic/tower_quake.ssi", ". 'YOUNG' = YOUS", ". 'YOUNG' = 1.02 * YOUS"),
]

# as long and as fine as it takes for all checks to pass, and for the same deck, spoilt, to fail; a
# release runs them whole (`cases/make_pictures.py`)
SMALLER = {
    "published/nafems_contact.ssi": [("0.5 1.) ;", "1.) ;")],
    "published/rocking_wall.ssi": [("'PAS' 2.5E-5 3.6", "'PAS' 1.E-4 3.6")],
    "published/sheared_fault.ssi": [
        ("DROI A1 A2 'DINI' 4.", "DROI A1 A2 'DINI' 5."),
        ("DROI A3 A4 'DINI' H0 'DFIN' 4.", "DROI A3 A4 'DINI' H0 'DFIN' 5."),
        ("(0. Y1) 'DINI' H0 'DFIN' 4.", "(0. Y1) 'DINI' H0 'DFIN' 5."),
    ],
    "published/shaken_slider.ssi": [
        (
            "'PAS' 2.5E-5 12. ; TAB1 . 'PAS_SAUVES' = 400",
            "'PAS' 1.E-4 12. ; TAB1 . 'PAS_SAUVES' = 100",
        ),
    ],
    "seismic/reactor.ssi": [
        ("DUREE = 5.", "DUREE = 1.2"),
        ("NA0 = 4 ; NR0 = 3 ; NO0 = 5 ; NZ1 = 2", "NA0 = 3 ; NR0 = 2 ; NO0 = 4 ; NZ1 = 2"),
        ("NZ2 = 4 ; NW0 = 5 ;", "NZ2 = 3 ; NW0 = 4 ;"),
        ("TLAG = MOUVOIR CHAQ DUR2 KLAG ; DYNAMIC TLAG ;", ""),  # no check looks at it
        ("(DEFAUT TLAG) (DEFAUT TLCO)", "(DEFAUT TLCO)"),
        ("REPE BA 12 ;", "REPE BA 3 ;"),
        ("(&BA - 7)", "(&BA - 2)"),
    ],
    "seismic/isolated_block.ssi": [("DUREE = 16.", "DUREE = 4.")],
    "seismic/oblique_waves.ssi": [
        ("DUREE = 1.4", "DUREE = 0.9"),
        (
            "(DT0 / 8.) DUREE ; TQUA . 'PAS_SAUVES' = 8",
            "(DT0 / 4.) DUREE ; TQUA . 'PAS_SAUVES' = 4",
        ),
    ],
    "seismic/matched_layer.ssi": [
        ("DUREE = 2.4 ; DCOM = 1.6", "DUREE = 1.6 ; DCOM = 0.8"),
        ("DT0 = 1.6E-3 ; NSAU = 10", "DT0 = 3.2E-3 ; NSAU = 5"),
    ],
    "seismic/record_to_verdict.ssi": [
        ("1.25E-3 (MAXI LT0) ; T1 . 'PAS_SAUVES' = 8", "2.5E-3 3. ; T1 . 'PAS_SAUVES' = 8")
    ],
    "seismic/tower_quake.ssi": [
        ("DUREE = 3. ;", "DUREE = 2.4 ;"),
        ("'TAILLE' 0.75 1.5", "'TAILLE' 1.5 1.5"),
    ],
}

# what a spoilt deck leaves out or runs coarser besides
SHORTER = {
    "club_cast3m_2014/club_a_methods.ssi": [("DUREE = 0.4 ;", "DUREE = 0.16 ;")],
    "club_cast3m_2014/club_b_sdm.ssi": [("DUREE = 1. ;", "DUREE = 0.15 ;")],
    "club_cast3m_2014/club_c_sdm.ssi": [("DUREE = 1. ;", "DUREE = 0.15 ;")],
    "footing/block_on_soil.ssi": [("1.44E-3 7.2E-4 3.6E-4", "1.44E-3 1.44E-3 1.44E-3")],
    "published/rocking_block.ssi": [("REPE BA 2", "REPE BA 1")],
    "seismic/reactor.ssi": [("COMPARE = VRAI ; IMAGES = VRAI", "COMPARE = FAUX ; IMAGES = FAUX")],
    "seismic/tower_quake.ssi": [
        ("TFIN = SEISME 1. (DT0 / 2.) 16 'JOINT' ; LFIN = SOMMET TFIN", "LFIN = LTOP"),
        ("TBON = SEISME 1. DT0 8 'COLLE' ;", "TBON = TQUA ;"),
        ("TWEA = SEISME 0.02 DT0 8 'JOINT' ;", "TWEA = TQUA ;"),
        ("TWEB = SEISME 0.02 DT0 8 'COLLE' ;", "TWEB = TQUA ;"),
    ],
}


def name_of(deck: Path) -> str:
    return str(deck.relative_to(CASES))


@pytest.fixture
def in_one_format(unplaced: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Curves are drawn as SVG alone, scenes as PNG: what is drawn is the same."""
    asked = pictures.picture_formats
    monkeypatch.setattr(pictures, "picture_formats", lambda *given: asked(*given)[-1:])


@pytest.mark.long
@pytest.mark.usefixtures("in_one_format")
@pytest.mark.parametrize("deck", DECKS, ids=name_of)
def test_deck_runs_within_its_tolerances_and_agrees_with_the_reference(deck: Path, tmp_path: Path):
    smaller = SMALLER.get(name_of(deck))
    result = run_changed(deck, tmp_path, *smaller) if smaller else run_deck(deck, tmp_path)
    assert result.exit_code == 0, result.message
    assert "checks within tolerance" in result.output
    compare = COMPARISONS.get(name_of(deck))
    if compare is not None:
        compare(result)


@pytest.fixture
def undrawn(unsaved: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures cost some decks half of their time; the deck as it is draws them."""
    monkeypatch.setattr(scenes, "_draw_files", lambda *_: None)


class _NoticedError(BaseException):
    """A check is out of tolerance: what comes behind it is not waited for."""


def noted(name: str, value: float, expected: float, tolerance: float) -> Check:
    """What @VERIFIE leaves for the summary: its tolerance is that of the difference."""
    if not abs(value - expected) <= tolerance:
        raise _NoticedError(name)
    return Check(name, value, expected, tolerance)


def spoiling(deck: str, old: str, new: str) -> list[tuple[str, str]]:
    """All changes of a deck's spoilt twin."""
    return [(old, new), *SMALLER.get(deck, []), *SHORTER.get(deck, [])]


def digest(deck: str, old: str, new: str) -> str:
    """What a deck and its changes are known by."""
    text = (CASES / deck).read_text(encoding="utf-8") + json.dumps(spoiling(deck, old, new))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


TRIED_FILE = Path(__file__).with_name("spoilt.toml")
TRIED = tomllib.loads(TRIED_FILE.read_text(encoding="utf-8"))
DUE = [twin for twin in SPOILT if TRIED.get(twin[0]) != digest(*twin)]


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize(("deck", "old", "new"), DUE, ids=lambda x: x if "/" in x else "")
def test_spoilt_deck_fails_on_its_own_checks(
    deck: str, old: str, new: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    changes = spoiling(deck, old, new)
    if deck.startswith("basics/"):
        result = run_changed(CASES / deck, tmp_path, *changes)
        assert result.exit_code == 1
        assert "out of tolerance" in result.message
    else:
        monkeypatch.setattr(writing, "Check", noted)
        with pytest.raises(_NoticedError):
            run_changed(CASES / deck, tmp_path, *changes)
    if deck in TRIED and "SSILANG_UPDATE" in os.environ:
        TRIED[deck] = digest(deck, old, new)
        lines = (f'"{d}" = "{h}"\n' for d, h in TRIED.items())
        TRIED_FILE.write_text("".join(lines), encoding="utf-8")
    elif deck in TRIED:
        pytest.fail(f"it failed as it should: SSILANG_UPDATE=1 writes that to {TRIED_FILE.name}")


def test_every_deck_has_a_spoilt_twin():
    assert {d for d, _, _ in SPOILT} == {name_of(d) for d in DECKS}
    assert {d for d, _, _ in SPOILT} >= {*TRIED}


def test_the_table_of_decks_names_every_deck():
    table = (CASES / "README.md").read_text(encoding="utf-8")
    missing = [d.stem for d in DECKS if f"| `{d.stem}` |" not in table]
    assert not missing


def test_pictures_of_the_pages_exist_and_are_small():
    for page in CASES.rglob("README.md"):
        text = page.read_text(encoding="utf-8")
        for name in re.findall(r"\]\((pictures/[^)]+)\)", text):
            assert (page.parent / name).stat().st_size < 60_000, name

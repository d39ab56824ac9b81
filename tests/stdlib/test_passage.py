"""@PASSAGE: the base's record and factors from a script, and what is told."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.language.say.diagnostics import sentence

BASE = (
    "T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 20. ; T . 'YOUNG' = 2.E8 ; "
    "T . 'POISSON' = 0.25 ; T . 'MASSE_VOLUMIQUE' = 2000. ; "
)
RECORD = "LT = PROG 0. PAS 0.005 10. ; G = EVOL 'MANU' LT (SIN (720. * LT)) ; "


def told(result):
    return [sentence(w, "en")[0] for w in result.session.warnings]


def test_a_record_turns_the_base_by_the_slope_of_the_wave():
    """2 Hz at 4000 m/s: the raft is small, theta'' = -(dv''/dt)/c for VERT, half of it for HORI."""
    script = BASE + RECORD + (
        "T . 'VITESSE_APPARENTE' = 4000. ; T . 'ACCELERATION' = G ; R = @PASSAGE T ; "
        "A = EXTR (R . 'ACCELERATION_ANGULAIRE') 'ORDO' ; T . 'COMPOSANTE' = 'HORI' ; "
        "S = @PASSAGE T ; B = EXTR (S . 'ACCELERATION_ANGULAIRE') 'ORDO' ;"
    )  # fmt: skip
    result = ran(script)
    a, b = (result.session.root.find(n).values for n in "AB")
    t = 0.005 * np.arange(len(a))
    w, middle = 4 * np.pi, slice(800, 1200)
    slope = -(w / 4000.0) * np.cos(w * t)
    np.testing.assert_allclose(a[middle], slope[middle], atol=2e-3 * w / 4000.0)
    np.testing.assert_allclose(b, a / 2, atol=1e-15)
    assert not told(result)


@pytest.mark.parametrize(("zeros", "early"), [(0.0, True), (0.1, False)])
def test_a_wave_at_the_edge_before_the_record_begins_is_told(zeros, early):
    """20 m at 400 m/s: the edge moves 0.05 s before the centre."""
    record = f"(LT MASQ 'COMPRIS' {zeros} {zeros + 0.2})"
    pulse = f"LT = PROG 0. PAS 0.002 1. ; G = EVOL 'MANU' LT {record} ; "
    result = ran(
        BASE.replace("'DISQUE'", "'BANDE'").replace("RAYON", "DEMI_LARGEUR")
        + pulse + "T . 'VITESSE_APPARENTE' = 400. ; T . 'ACCELERATION' = G ; R = @PASSAGE T ;"
    )  # fmt: skip
    texts = [text for text in told(result) if "before its record begins" in text]
    assert len(texts) == early
    if early:
        seconds = float(texts[0].split("moves ")[1].split(" s ")[0])
        assert 0.04 < seconds < 0.06


@together(
    "more, words",
    [
        ("T . 'FREQUENCES' = PROG 1. ;", "the motion is the same everywhere"),
        ("T . 'FREQUENCES' = PROG 1. ; T . 'INCOHERENCE' = 0.7 ;", "beyond what arrays have shown"),
        ("T . 'FREQUENCES' = PROG 1. ; T . 'VITESSE_APPARENTE' = 150. ;", "slower than Rayleigh's"),
    ],
)
def test_what_is_doubtful_is_told(more, words):
    result = ran(BASE + more + "R = @PASSAGE T ;")
    assert [words in text for text in told(result)] == [True]

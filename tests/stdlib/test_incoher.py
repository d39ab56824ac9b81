"""@INCOHER: factors and records of a raft, rotations by their signs, what is refused."""

import numpy as np
import pytest
from scipy.special import jv

from ssilang.cli.run import run_text

SHAPES = {
    "BANDE": {"DEMI_LARGEUR": 15.0},
    "DISQUE": {"RAYON": 15.0},
    "RECTANGLE": {"DEMI_LONGUEUR": 15.0, "DEMI_LARGEUR": 10.0},
}
RECORD = (
    "LT = PROG 0. PAS 0.01 4. ; LX = (LT - 2.) * (PI * 2.) ; LX = LX * LX ; "
    "ACC = EVOL 'MANU' LT ((1. - (2. * LX)) * (EXP (-1. * LX))) ; "
)


def run(shape, component, dimension=3, frequencies=(), **entries):
    given = {"FORME": f"'{shape}'", "COMPOSANTE": f"'{component}'", **SHAPES.get(shape, {})}
    if len(frequencies):
        given["FREQUENCES"] = "(PROG " + " ".join(f"{f:.17e}" for f in frequencies) + ")"
    lines = [f"T . '{k}' = {v} ;" for k, v in {**given, **entries}.items()]
    script = RECORD + f"OPTI DIME {dimension} ; T = TABL ; " + " ".join(lines)
    return run_text(script + " W = @INCOHER T ;")


def curves(result, of):
    assert result.exit_code == 0, result.message
    table = result.session.root.find("W").get(of)
    return {name: part.get(name).parts[0].ordinates for part in [table] for name, _ in part.items()}


def test_a_wave_that_passes_below_each_shape():
    frequencies, speed = np.array([0.5, 2.0, 7.0]), 900.0
    z = 2 * np.pi * frequencies / speed * 15.0
    more = {"VITESSE_APPARENTE": speed}
    strip = curves(run("BANDE", "UY", 2, frequencies, **more), "FACTEURS")
    assert strip["UY"] == pytest.approx(np.abs(np.sin(z) / z), rel=1e-9)
    rocking = 3 * (np.sin(z) - z * np.cos(z)) / z**2 / 15.0
    assert strip["RZ"] == pytest.approx(np.abs(rocking), rel=1e-9)
    disc = curves(run("DISQUE", "UY", 3, frequencies, **more), "FACTEURS")
    assert disc["UY"] == pytest.approx(np.abs(2 * jv(1, z) / z), rel=1e-9)
    # torsion about the vertical has twice the inertia of rocking
    assert disc["RZ"] == pytest.approx(np.abs(4 * jv(2, z) / z / 15.0), rel=1e-9)
    rectangle = curves(run("RECTANGLE", "UY", 3, frequencies, **more), "FACTEURS")
    assert rectangle["RZ"] == pytest.approx(np.abs(rocking) * 225 / 325, rel=1e-9)
    # along the other axis
    turned = curves(run("RECTANGLE", "UX", 3, frequencies, AZIMUT=90.0, **more), "FACTEURS")
    y = z / 1.5
    assert turned["UX"] == pytest.approx(np.abs(np.sin(y) / y), rel=1e-9)


@pytest.mark.parametrize("azimuth", [0.0, 90.0, 40.0])
def test_a_slow_record_turns_the_raft_as_the_ground(azimuth):
    # u(t - s . x): slopes -s du/dt, and the rigid rotation of that ground
    way = np.radians(azimuth)
    slowness = np.array([np.cos(way), np.sin(way)]) / 2.0e4
    given = {"AZIMUT": azimuth, "VITESSE_APPARENTE": 2.0e4, "ACCELERATION": "ACC"}
    made = curves(run("DISQUE", "UZ", **given), "ACCELERATION")
    x = (0.01 * np.arange(401) - 2.0) * 2 * np.pi
    jerk = 2 * np.pi * (4 * x**3 - 6 * x) * np.exp(-(x**2))
    small = 1e-4 * np.abs(jerk).max() / 2.0e4
    assert made["RX"] == pytest.approx(-slowness[1] * jerk, abs=small)
    assert made["RY"] == pytest.approx(slowness[0] * jerk, abs=small)
    across = curves(run("DISQUE", "UX", **given), "ACCELERATION")
    assert across["RZ"] == pytest.approx(slowness[1] * jerk / 2, abs=small)
    along = curves(run("DISQUE", "UY", **given), "ACCELERATION")
    assert along["RZ"] == pytest.approx(-slowness[0] * jerk / 2, abs=small)


def test_incoherence_and_a_wave_keep_the_record_s_spectrum_times_the_factor():
    given = {"INCOHERENCE": 0.2, "VITESSE": 250.0, "VITESSE_APPARENTE": 1000.0}
    frequencies = np.arange(1, 40) / 4.01  # those of a Fourier transform of the record
    result = run("DISQUE", "UZ", 3, frequencies, ACCELERATION="ACC", **given)
    made, factor = curves(result, "ACCELERATION"), curves(result, "FACTEURS")
    record = np.fft.rfft(result.session.root.find("ACC").parts[0].ordinates)[1:40]
    for name in ("UZ", "RY"):
        found = np.abs(np.fft.rfft(made[name])[1:40])
        expected = np.abs(record) * factor[name]
        assert found == pytest.approx(expected, abs=1e-3 * expected.max())
    assert 0 < curves(result, "COHERENCES")["RY"].min() < 1
    assert not result.session.warnings


@pytest.mark.parametrize(
    ("shape", "component", "dimension", "entries", "told"),
    [
        ("BANDE", "UZ", 2, {}, "UZ is no direction in dimension 2"),
        ("BANDE", "UX", 3, {}, "goes in a plane"),
        ("DISQUE", "UX", 3, {"INCOHERENCE": 0.2}, "VITESSE"),
        ("DISQUE", "UX", 3, {"INCOHERENCE": -0.2}, "not negative"),
        ("DISQUE", "UX", 3, {"RAYON": 0.0}, "RAYON is positive"),
        ("DISQUE", "UX", 3, {"DEMI_LARGEUR": 3.0}, "size of another FORME"),
        ("DISQUE", "UX", 3, {"AZIMUT": 3.0}, "no wave passes"),
        ("BANDE", "UX", 2, {"AZIMUT": 3.0, "VITESSE_APPARENTE": 900.0}, "across a BANDE"),
        ("DISQUE", "UX", 3, {"VITESSE_APPARENTE": 900.0}, "FREQUENCES or ACCELERATION"),
        ("DISQUE", "UX", 3, {"VITESSE_APPARENTE": 9e2, "FREQUENCES": "PROG -1."}, "none negative"),
        (
            "DISQUE", "UX", 3,
            {"VITESSE_APPARENTE": 9e2, "ACCELERATION": "EVOL 'MANU' (PROG 0. 1. 3.) (PROG 3*0.)"},
            "equal steps",
        ),
    ],
)  # fmt: skip
def test_what_is_refused(shape, component, dimension, entries, told):
    result = run(shape, component, dimension, **entries)
    assert result.exit_code == 1
    assert told in result.message, result.message


@pytest.mark.parametrize(
    ("entries", "code"),
    [
        ({"INCOHERENCE": 0.7, "VITESSE": 200.0}, "incoherence-range"),
        ({"VITESSE_APPARENTE": 150.0, "VITESSE": 200.0}, "apparent-speed-range"),
        ({}, "motion-coherent"),
        (
            {"VITESSE_APPARENTE": 90.0, "ACCELERATION": "EVOL 'MANU' LT (EXP (-1. * LT))"},
            "motion-before-record",
        ),
    ],
)
def test_what_is_told(entries, code):
    result = run("DISQUE", "UX", 3, [1.0], **entries)
    assert result.exit_code == 0, result.message
    assert [w.code.rpartition(".")[2] for w in result.session.warnings] == [code]

"""Problems built in a few lines, against closed forms and against the same deck."""

import numpy as np
import pytest
from together import together

import ssilang
from ssilang import Builder

G = 9.81
STONE = {"YOUN": 3e10, "NU": 0.2, "RHO": 2400.0}


def test_blocks_at_rest_carry_their_weights_in_their_joints():
    """Two beside each other, of other weights and sizes: each in its own joint."""
    b, found = Builder(), []
    for x, width, rho in ((-1, 2, 2400.0), (3, 4, 1500.0)):
        block = b.block((x, 0), (x + width, 1), size=0.5, **STONE | {"RHO": rho})
        found.append((block, b.joint(block, KN=1e9, KS=1e9, FROT=0.7), rho * G * width))
    motion = b.run([0.0, 0.001, 0.002])
    for (block, joint, weight), x, width in zip(found, (1, 7), (2, 4), strict=True):
        normal = motion.traction(joint)[-1, :, -1]
        assert len(normal) == 4 * width
        assert normal.mean() * width == pytest.approx(-weight, rel=2e-3)
        assert motion.contact(joint) == pytest.approx(1.0)
        assert np.ptp(motion.history("DEPL", "UY", (x, 1), of=block).y) < 1e-9
    with pytest.raises(ssilang.Error, match="nearest"):
        motion.history("DEPL", "UY", (1, 1), of=block)


@together(
    "dimension, corners, unknown", [(2, ((0, 0), (1, 2)), "UY"), (3, ((0, 0, 0), (1, 2, 1)), "UZ")]
)
def test_a_block_thrown_upwards_flies_as_a_stone(dimension, corners, unknown):
    b = Builder(dimension)
    block = b.block(*corners, size=1.0, **STONE)
    joint = b.joint(block, KN=2e8, KS=0.0)
    b.push(block, **{unknown: 1.0})
    motion = b.run(np.linspace(0.0, 0.15, 301), start="unloaded")
    exact = motion.times - G * motion.times**2 / 2
    assert motion.opening(joint) == pytest.approx(
        np.tile(exact, (motion.opening(joint).shape[1], 1)).T, abs=1e-9
    )
    assert motion.contact(joint)[1:] == pytest.approx(0.0)
    assert motion.history("DEPL", unknown, corners[1], of=block).y == pytest.approx(exact, abs=1e-9)


def test_a_shaken_block_on_soil_moves_as_in_the_deck():
    """Footing on soil with a joint, base shaken: a script of the same mesh gives the same."""
    times, record = np.linspace(0.0, 0.1, 51), np.sin(np.linspace(0.0, 0.1, 51) * 60.0)
    b = Builder()
    soil = b.block((-2, -1), (2, 0), size=1.0, YOUN=5e8, NU=0.3, RHO=2000.0)
    foot = b.block((-1, 0), (1, 1), size=1.0, **STONE)
    b.joint(foot, soil, KN=1e9, KS=1e9, FROT=0.7)
    assert repr(b.mesh()) == "<MAILLAGE 6 QUA4, 16 nodes>"  # 5 x 2 and 3 x 2
    b.fix(soil)
    b.damp(mass=0.5)
    b.shake(times, 6.0 * record)
    ours = b.run(times).history("DEPL", "UX", (1, 1), of=foot)
    deck = """OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
    T = MAILLER 'SOL' 4. 1. 'SEMELLE' 2. 1. 'TAILLE' 1. 1. ;
    MO = (MODE (T . 'SOL') MECANIQUE ELASTIQUE) ET (MODE (T . 'SEMELLE') MECANIQUE ELASTIQUE) ;
    MA = (MATE (MODE (T . 'SOL') MECANIQUE ELASTIQUE) 'YOUN' 5.E8 'NU' 0.3 'RHO' 2000.)
      ET (MATE (MODE (T . 'SEMELLE') MECANIQUE ELASTIQUE) 'YOUN' 3.E10 'NU' 0.2 'RHO' 2400.) ;
    MJ = MODE (T . 'JOINT') MECANIQUE ELASTIQUE JOINT_SDM ;
    AJ = MATE MJ 'KN' 1.E9 'KS' 1.E9 'FROT' 0.7 ;
    RI = (RIGI MO MA) ET (BLOQ 'DEPL' (T . 'BASE')) ; MS = MASS MO MA ;
    ALL = (T . 'SOL') ET (T . 'SEMELLE') ;
    DOWN = MS * (MANU 'CHPO' ALL 1 'UY' -9.81) ;
    SIDE = MS * (MANU 'CHPO' ALL 1 'UX' -1.) ;
    T1 = TABL ; T1 . 'RIGI' = RI ; T1 . 'MASS' = MS ; T1 . 'AMOR' = 0.5 * MS ;
    T1 . 'MODELE' = MJ ; T1 . 'CARACTERISTIQUES' = AJ ;
    T1 . 'CHAR' = (CHAR 'MECA' DOWN) ET (CHAR 'MECA' SIDE ACCE) ;
    T1 . 'DEPL' = RESO (RI ET (RIGI MJ AJ)) DOWN ;
    T1 . 'TEMPS_CALCULES' = TIMES ; T1 . 'PAS_SAUVES' = 1 ;
    T2 = DYNAMIC T1 ;"""
    import pandas as pd

    given = {"ACCE": pd.Series(6.0 * record, times), "TIMES": times}
    theirs = ssilang.run(deck, **given).history("DEPL", "UX", (1.0, 1.0))
    assert abs(theirs.y).max() > 1e-5
    assert ours.y == pytest.approx(theirs.y, abs=1e-9 * abs(theirs.y).max())


@together(
    "wrong, said",
    [
        (lambda b, p: b.block((0, 0), (0, 1), size=1.0, **STONE), "no corners of a block"),
        (lambda b, p: b.block((0, 0, 0), (1, 1, 1), size=1.0, **STONE), "no corners of a block"),
        (lambda b, p: b.block((0, 0), (1, 1), size=1.0, YOUNG=1e9, NU=0.2), "did you mean 'YOUN'"),
        (lambda b, p: b.block((0, 0), (1, 1), size=1.0, YOUN=1e9), "the law needs NU"),
        (lambda b, p: b.joint(p, law="JOINT_SDN", KN=1e9, KS=1e9), "JOINT_SDN"),
        (lambda b, p: b.fix(p, "botom"), "did you mean 'bottom'"),
        (lambda b, p: b.push(p, UZ=1.0), "there are UX and UY"),
        (lambda b, p: b.joint(p, p, KN=1e9, KS=1e9), "error: "),
        (lambda b, p: b.run([0.0, 0.1], start="moving"), "not 'moving'"),
        (lambda b, p: b.run([0.1, 0.0], start="unloaded"), "error: "),
        (lambda b, p: Builder(4), "not 4"),
    ],
)
def test_what_makes_no_problem_is_refused_by_name(wrong, said):
    b = Builder()
    part = b.block((5, 0), (6, 1), size=1.0, **STONE)
    with pytest.raises(ssilang.Error, match="error") as caught:
        wrong(b, part)
    assert said in str(caught.value)


def test_refusals_are_in_the_language_of_the_builder():
    b = Builder(language="fr")
    with pytest.raises(ssilang.Error, match="erreur : la loi demande NU"):
        b.block((0, 0), (1, 1), size=1.0, YOUN=1e9)
    part = b.block((0, 0), (1, 1), size=1.0, **STONE)
    with pytest.raises(ssilang.Error, match="une partie n'a pas de côté 'haut'"):
        b.fix(part, "haut")
    with pytest.raises(ssilang.Error, match="erreur : "):
        b.run([0.1, 0.0], start="unloaded")

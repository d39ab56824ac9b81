"""@CIBLE @ACCORD AJUSTE against closed forms, SciPy's least squares, spectra by themselves."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares
from script_runs import prog, ran
from together import together

from ssilang.kernel.modal.oscillator import spectrum

X = np.linspace(0.1, 3.0, 25)
NOISE = 0.02 * np.cos(17.0 * np.arange(25) ** 2)
WEIGHTS = 1.0 + np.arange(25) % 4

DECAY = """
DEBP {f} X1*TABLE P1*LISTREEL ;
  T1 = TABL ; T1 . 'F' = TABL ; X1 = X1 . 1 ;
  T1 . 'F' . 1 = EXP ((0. - (EXTR P1 1)) * X1) ;
  T1 . 'F' . 2 = COS ((180. / PI * (EXTR P1 2)) * X1) ;
  T1 . 'G' = 0.5 * X1 ;
FINP T1 ;
DEBP {d} X1*TABLE P1*LISTREEL ;
  T1 = TABL ; T1 . 'F' = TABL ; T1 . 'F' . 1 = TABL ; T1 . 'F' . 2 = TABL ; X1 = X1 . 1 ;
  T1 . 'F' . 1 . 1 = 0. - (X1 * (EXP ((0. - (EXTR P1 1)) * X1))) ;
  T1 . 'F' . 1 . 2 = 0. * X1 ;
  T1 . 'F' . 2 . 1 = 0. * X1 ;
  T1 . 'F' . 2 . 2 = 0. - (X1 * (SIN ((180. / PI * (EXTR P1 2)) * X1))) ;
FINP T1 ;
"""

PLAIN = DECAY.format(f="FCT", d="DERI")


def shape(z):
    q1, q2, p1, p2 = z
    return q1 * np.exp(-p1 * X) + q2 * np.cos(p2 * X) + 0.5 * X


def fitted(measured, entries="", procedures=PLAIN, kl=(2, 2)):
    result = ran(
        procedures
        + f"T = TABL ; T . 'X' = TABL ; T . 'X' . 1 = {prog(X)} ; T . 'F' = {prog(measured)} ;"
        f"T . 'K' = {kl[0]} ; T . 'L' = {kl[1]} ; {entries} Q P = AJUSTE T ;"
    )
    root = result.session.root
    return np.concatenate([root.find("Q").values, root.find("P").values])


BOUNDS = "T . 'PMIN' = PROG 0. 0. ; T . 'PMAX' = PROG 6. 8. ; "


def test_noisy_weighted_values_give_what_scipy_finds():
    true = (2.0, -0.7, 0.9, 4.1)
    measured = shape(true) + NOISE
    peer, plain = (
        least_squares(
            lambda z, w=w: w * (shape(z) - measured), true, xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        for w in (np.sqrt(WEIGHTS), 1.0)
    )
    found = fitted(measured, BOUNDS + f"T . 'POIDS' = {prog(WEIGHTS)} ;")
    assert found == pytest.approx(peer.x, rel=1e-6)
    assert peer.x != pytest.approx(plain.x, rel=1e-4)


def test_a_bound_holds_its_parameter_by_procedures_of_other_names():
    measured = shape((2.0, -0.7, 0.9, 4.1))
    peer = least_squares(
        lambda z: shape(z) - measured,
        (2.0, -0.7, 1.5, 4.1),
        bounds=([-9, -9, 1.2, 0], [9, 9, 6, 8]),
    )
    entries = "T . 'PMIN' = PROG 1.2 0. ; T . 'PMAX' = PROG 6. 8. ; "
    entries += "T . 'NOM_FCT' = 'MYF' ; T . 'NOM_DERI' = 'MYD' ;"
    found = fitted(measured, entries, DECAY.format(f="MYF", d="MYD"))
    assert found[2] == pytest.approx(1.2)
    assert found == pytest.approx(peer.x, rel=1e-4)


def test_without_nonlinear_parameters_it_is_linear_least_squares():
    linear = (
        "DEBP FCT X1*TABLE P1*LISTREEL ; T1 = TABL ; T1 . 'F' = TABL ;"
        "T1 . 'F' . 1 = (X1 . 1) ** 0 ; T1 . 'F' . 2 = X1 . 1 ; T1 . 'F' . 3 = (X1 . 1) ** 2 ;"
        "FINP T1 ; "
    )
    measured = 1.0 - 2.0 * X + 0.3 * X**2 + NOISE
    found = fitted(measured, procedures=linear, kl=(0, 3))
    peer = np.linalg.lstsq(np.stack([X**0, X, X**2], axis=1), measured, rcond=None)[0]
    assert found == pytest.approx(peer, rel=1e-9)


def test_further_bounds_are_told_and_left():
    one = (
        "DEBP FCT X1*TABLE P1*LISTREEL ; T1 = TABL ; T1 . 'F' = TABL ;"
        "T1 . 'F' . 1 = EXP ((0. - (EXTR P1 1)) * (X1 . 1)) ; FINP T1 ;"
        "DEBP DERI X1*TABLE P1*LISTREEL ; T1 = TABL ; T1 . 'F' = TABL ; T1 . 'F' . 1 = TABL ;"
        "T1 . 'F' . 1 . 1 = 0. - ((X1 . 1) * (EXP ((0. - (EXTR P1 1)) * (X1 . 1)))) ; FINP T1 ;"
    )
    bounds = "T . 'PMIN' = PROG 0. -5. 3. ; T . 'PMAX' = PROG 6. -4. ; "
    told = ran(
        f"{one}T = TABL ; T . 'X' = TABL ; T . 'X' . 1 = {prog(X)} ; T . 'K' = 1 ; "
        f"T . 'F' = {prog(2.0 * np.exp(-0.7 * X))} ; T . 'L' = 1 ; {bounds} Q P = AJUSTE T ;"
    )
    found = [told.session.root.find(n).values for n in "QP"]
    assert np.concatenate(found) == pytest.approx([2.0, 0.7], rel=1e-6)
    assert [w.code for w in told.session.warnings] == ["stdlib.ajuste-more-bounds"]


@pytest.mark.parametrize("damping", [0.0, 0.5, 30.0])
@pytest.mark.parametrize("apart", [1.0, 1e-4])
def test_a_step_is_the_damped_least_squares_of_columns_of_norm_one(damping, apart):
    """Against numpy, the columns above a unit matrix; the second may be nearly the first."""
    columns = [np.array([1.0, 2.0, 3.0, 4.0, 0.5])]
    columns += [columns[0] + apart * np.array([0.0, 1.0, -1.0, 2.0, 0.0]), np.zeros(5)]
    columns += [np.array([0.0, 30.0, 0.0, -20.0, 10.0])]
    side = np.array([1.0, 0.0, 2.0, 5.0, -1.0])
    norms = np.array([np.linalg.norm(c) or 1.0 for c in columns])
    unit = np.column_stack(columns) / norms
    whole = np.vstack([unit, np.sqrt(damping) * np.eye(4)])
    expected = np.linalg.lstsq(whole, np.concatenate([side, np.zeros(4)]), rcond=None)[0]
    text = (Path(__file__).parents[2] / "stdlib" / "ajuste.ssi").read_text(encoding="utf-8")
    given = " ".join(f"C . {k} = {prog(c)} ;" for k, c in enumerate(columns, 1))
    root = ran(
        text + f"C = TABL ; {given} D R = AJUSTE_M C 4 {prog(side)} {damping} ;"
    ).session.root
    assert root.find("D").values == pytest.approx(expected / norms, rel=1e-6, abs=1e-9)
    assert root.find("R").values == pytest.approx(side - unit @ expected, rel=1e-6, abs=1e-9)


def found(text, *names):
    result = ran(text)
    got = [result.session.root.find(name) for name in names]
    return [*got, [w.code for w in result.session.warnings]]


TARGET = "T = TABL ; T . 'CODE' = '{code}' ; T . 'FREQUENCES' = PROG {f} ; {more} E = @CIBLE T ;"


@together("code, more, values", [
        # corners of type 1, ground B: S 1.2, TB 0.15, TC 0.5, TD 2 s
        ("EC8", "T . 'AG' = 2. ; T . 'SOL' = 'B' ;",
         {1e12: 2.4, 1 / 0.075: 4.2, 1 / 0.3: 6.0, 1.0: 3.0, 0.25: 6.0 * 0.5 * 2 / 16}),
        ("EC8", "T . 'AG' = 1. ; T . 'SOL' = 'D' ; T . 'TYPE' = 2 ; T . 'AMORTISSEMENT' = 0.1 ;",
         {1e12: 1.8, 5.0: 4.5 * np.sqrt(2 / 3), 1.0: 4.5 * np.sqrt(2 / 3) * 0.3}),
        ("EC8", "T . 'AG' = 1. ; T . 'SOL' = 'A' ; T . 'COMPOSANTE' = 'VERT' ;",
         {1e12: 0.9, 10.0: 2.7, 2.0: 2.7 * 0.3, 0.5: 2.7 * 0.15 / 4}),
        # TS 0.6 s, T0 0.12 s
        ("ASCE7", "T . 'SDS' = 1. ; T . 'SD1' = 0.6 ; T . 'TL' = 8. ;",
         {1e12: 0.4 * 9.81, 1 / 0.06: 0.7 * 9.81, 4.0: 9.81, 0.5: 0.3 * 9.81,
          0.1: 0.6 * 8 / 100 * 9.81}),
    ])  # fmt: skip
def test_spectra_of_codes_at_and_between_their_corners(code, more, values):
    text = TARGET.format(code=code, f=" ".join(f"{f:.12g}" for f in sorted(values)), more=more)
    curve, _ = found(text, "E")
    np.testing.assert_allclose(
        curve.parts[0].ordinates, [values[f] for f in sorted(values)], rtol=1e-8
    )


SUITE = """
LT = PROG 0. PAS 0.02 12. ; B = (SIN (LT * 15.)) ** 2 ;
A = EVOL 'MANU' 'TEMP' LT 'ACCE'
  (B * ((SIN (LT * 500.)) + (COS (LT * 1250.)) + (SIN (LT * 220.)))) ;
C = EVOL 'MANU' 'TEMP' LT 'ACCE' (B * ((COS (LT * 410.)) + (COS (LT * 900.)) + (SIN (LT * 260.)))) ;

T = TABL ; T . 'SIGNAUX' = TABL ; T . 'PERIODES' = PROG 0.15 2. ;
"""


def test_multiples_of_one_record_get_the_factors_that_undo_them():
    text = f"""{SUITE}
    T . 'CIBLE' = SPO A 'AMOR' 0.05 'FREQ' (PROG 0.5 PAS 0.001 7.) 'ACCE' ;
    T . 'SIGNAUX' . 1 = 4. * A ; T . 'SIGNAUX' . 2 = 0.5 * A ; S = @ACCORD T ;
    T . 'PLANCHER' = 1.5 ; U = @ACCORD T ; T . 'CIBLE' = 100. * (T . 'CIBLE') ; V = @ACCORD T ;
    """
    table, higher, _, warnings = found(text, "S", "U", "V")
    np.testing.assert_allclose(table.get("FACTEURS").values, [0.25, 2.0], rtol=1e-4)
    assert np.abs(table.get("RAPPORT").parts[0].ordinates - 1.0).max() < 2e-3
    least = higher.get("RAPPORT").parts[0].ordinates.min()
    assert least == pytest.approx(1.5, rel=1e-9)
    assert warnings == ["stdlib.accord-far", "stdlib.accord-far"]


def test_a_suite_matched_by_wavelets_has_the_target_and_its_mean_stays_above_the_floor():
    text = f"""{SUITE}
    T . 'CIBLE' = EVOL 'MANU' 'FREQ' (PROG 0.3 2. 10.) 'ACCE' (PROG 1. 5. 5.) ;
    T . 'SIGNAUX' . 1 = A ; T . 'SIGNAUX' . 2 = C ; T . 'METHODE' = 'ONDELETTES' ;
    T . 'PLANCHER' = 0.95 ; T . 'TOLERANCE' = 0.12 ; S = @ACCORD T ;
    """
    table, warnings = found(text, "S")
    assert warnings == []
    f = np.geomspace(0.5, 1 / 0.15, 60)
    wanted = np.interp(f, [0.3, 2.0, 10.0], [1.0, 5.0, 5.0])
    got = []
    for i in (1, 2):
        part = table.get("SIGNAUX").get(i).parts[0]
        got.append(spectrum(part.abscissas, part.ordinates, f, 0.05, "ACCE"))
        assert np.abs(got[-1] / wanted - 1.0).max() < 0.13 / 0.95
        told = table.get("SPECTRES").get(i).parts[0]
        np.testing.assert_allclose([told.abscissas, told.ordinates], [f, got[-1]], rtol=1e-6)
    mean = np.mean(got, axis=0)
    assert (mean / wanted).min() > 0.95 - 1e-6
    np.testing.assert_allclose(table.get("MOYENNE").parts[0].ordinates, mean, rtol=1e-6)

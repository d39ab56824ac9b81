"""EVOL in its kinds, parts of curves, arithmetic, interpolation, integrals."""

import pytest
from together import together


def test_parts_of_a_transform_are_taken_by_the_names_of_their_axes(found):
    """A cosine of eight points: half its sum stands in the real part of its line alone."""
    signal = "T = PROG 0. 'PAS' 0.125 0.875 ; C = EVOL 'MANU' T (COS (T * 360.)) ; "
    real, imaginary = found(
        signal + "F = TFR 3 C 'REIM' ; R = EXTR F 'PART REEL' ; I = EXTR F 'PART IMAG' ;", "R", "I"
    )
    assert real.values[1] == pytest.approx(0.5)
    assert abs(real.values[[0, 2, 3]]).max() < 1e-12
    assert abs(imaginary.values).max() < 1e-12


@together(
    "names, kept",
    [
        (("F(T)", "G(T)"), ("F(T)", "G(T)")),
        (("'TIME'", "'FORCE'"), ("TIME", "FORCE")),
        (("TIME", ""), ("TIME", "")),
        (("'F (T)'", "X"), ("F (T)", "X")),
    ],
)
def test_one_name_stands_before_each_list(found, names, kept):
    text = "E = EVOL 'MANU' {} (PROG 0. 1.) {} (PROG 2. 3.) ;"
    part = found(text.format(*names), "E").parts[0]
    assert (part.abscissa_name, part.ordinate_name) == kept


@together(
    "place, legends",
    [
        ("P1", ["UX P1"]),
        ("(POIN 1 L)", ["UX P1"]),
        ("(POIN 2 L)", ["UX 3"]),
        ("L", ["UX P1", "UX 3", "UX TOP"]),
    ],
)
def test_legends_name_the_points_of_the_script(found, place, legends):
    e = found(
        "OPTI DIME 2 ; P1 = 0. 0. ; TOP = 2. 0. ; L = (P1 ET (1. 0.)) ET TOP ; "
        "C = MANU 'CHPO' L 1 'UX' 2. ; "
        f"E = EVOL 'TEMP' (SUIT C C) (PROG 0. 1.) 'UX' {place} ; ",
        "E",
    )
    assert [p.legend for p in e.parts] == legends

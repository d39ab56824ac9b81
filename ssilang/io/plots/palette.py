"""Cast3M's colours: names in order of their numbers, and the shades used on white paper.

A mesh or a curve holds the index into `COLOURS` (0 = DEFA, black on white here). Saturated screen
colours are toned so that lines and words stay readable in print; the hue is the name's.
"""

from pathlib import Path

from ssilang.io.errors import OutputError
from ssilang.remembered import tables_of

_SHADES: dict[str, str] = tables_of(Path(__file__).with_suffix(".toml"))
COLOURS: tuple[str, ...] = tuple(_SHADES)

# used one after the other where a drawing holds several curves without a colour of their own
CYCLE: tuple[str, ...] = ("BLEU", "ROUG", "VERT", "ORAN", "VIOL", "TURQ", "BRUN", "ROSE", "GRIS")


def shade(colour: int | str, ink: bool = False) -> str:
    """The shade '#rrggbb' of a colour given by index or by name (first four letters count).

    `ink`: of lines and words; white ones are black on the white paper.

    Raises
    ------
    OutputError
        For an unknown colour.
    """
    if isinstance(colour, str):
        colour = index_of(colour)
    if not 0 <= colour < len(COLOURS):
        raise OutputError("io.colour-number-not", colour=colour, n_names=len(COLOURS) - 1)
    return _SHADES["DEFA" if ink and COLOURS[colour] == "BLAN" else COLOURS[colour]]


def index_of(name: str) -> int:
    """Index of a colour name, first four letters.

    Raises
    ------
    OutputError
        For an unknown colour.
    """
    key = name.strip().upper()[:4]
    if key not in _SHADES:
        raise OutputError("io.no-colour", name=name, names=COLOURS)
    return COLOURS.index(key)

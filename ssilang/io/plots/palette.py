"""Cast3M's colours: names in order of their numbers, and the shades used on white paper.

A mesh or a curve holds the index into `COLOURS` (0 = DEFA, black on white here). Saturated screen
colours are toned so that lines and words stay readable in print; the hue is the name's.
"""

from ssilang.io.errors import OutputError

_SHADES: dict[str, str] = {
    "DEFA": "#1b1f24",
    "BLEU": "#1f5fbf",
    "ROUG": "#cf2a2a",
    "ROSE": "#d6399b",
    "VERT": "#1e8c3a",
    "TURQ": "#17a6a8",
    "JAUN": "#e3b505",
    "BLAN": "#ffffff",
    "NOIR": "#000000",
    "VIOL": "#8423b5",
    "ORAN": "#f08a00",
    "AZUR": "#2f94ee",
    "OCEA": "#3ca86e",
    "CYAN": "#6fbfe8",
    "OLIV": "#8fb02e",
    "GRIS": "#9aa0a6",
    "POUR": "#c22a86",
    "BRUN": "#8b4a1b",
    "BRIQ": "#a83232",
    "CORA": "#f4805a",
    "BEIG": "#e8d2a8",
    "OR": "#e0b400",
    "MARI": "#14316b",
    "BOUT": "#0d5c2a",
    "LIME": "#7fd41b",
    "LAVA": "#c3c3ec",
    "BRON": "#c9982a",
    "KAKI": "#d6cc7a",
    "PEAU": "#f5b5bf",
    "CARA": "#c4843f",
    "INDI": "#4b2a8c",
}
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

r"""Titles with indices, exponents and Greek letters: `_{i}`, `^{2}`, `\a`.

The letter after the backslash is that of the Symbol font: `\a` alpha, `\W` capital omega.
"""

import re

_LATIN = "abgdezhqiklmnxoprstufcyw"
_GREEK = "αβγδεζηθικλμνξοπρστυφχψω"
_SYMBOLS: dict[str, str] = dict(zip(_LATIN, _GREEK, strict=True))
_SYMBOLS |= {latin.upper(): greek.upper() for latin, greek in _SYMBOLS.items()}
_SYMBOLS |= {"j": "φ", "J": "ϑ", "v": "ϖ", "V": "ς"}

_GREEK_MARK = re.compile(r"\\([A-Za-z])")
_SCRIPT = re.compile(r"([_^])\{([^{}]*)\}")
_MATH_SPECIAL = re.compile(r"([%#&$_^{}\\~ ])")
LONGEST = 240
"""Characters of a text for which a picture has room; fonts take a minute for 300 000."""


def cut(text: str) -> str:
    """`text` as far as a picture has room for it."""
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"


def to_mathtext(text: str) -> str:
    """`text` as matplotlib's text: scripts in math mode, everything else literal."""
    text = _GREEK_MARK.sub(lambda m: _SYMBOLS.get(m.group(1), m.group(0)), cut(text))
    pieces: list[str] = []
    end = 0
    for script in _SCRIPT.finditer(text):
        pieces.append(_plain(text[end : script.start()]))
        body = _MATH_SPECIAL.sub(r"\\\1", script.group(2))
        pieces.append(f"$\\mathregular{{{{}}{script.group(1)}{{{body}}}}}$" if body else "")
        end = script.end()
    return "".join(pieces) + _plain(text[end:])


def _plain(text: str) -> str:
    return text.replace("$", r"\$")

"""Control characters as text that is seen: a script or a file's name steers no terminal."""

from __future__ import annotations

import re

# all but the tab and the line end, which lay out text; those of eight bits steer as ESC does
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


def visible(text: str) -> str:
    """The text with control characters written as in a program: `\\x1b`."""
    return _CONTROL.sub(lambda m: f"\\x{ord(m.group()):02x}", text)

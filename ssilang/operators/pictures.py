"""Pictures of a run: their formats, names and numbers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ssilang.language.session import Session
from ssilang.operators.files import run_output
from ssilang.operators.workspace import workspace

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FORMATS = {"PNG": ("png",), "SVG": ("svg",), "PDF": ("pdf",)}


def picture_formats(session: Session, usual: tuple[str, ...]) -> tuple[str, ...]:
    """Formats to write: the one of OPTI TRAC if it is PNG, SVG or PDF, else the usual ones."""
    return _FORMATS.get(str(workspace(session).options.get("TRAC", "")), usual)


def picture_name(session: Session, title: str, fallback: str) -> str:
    """Name of a picture: OPTI FTRA's file, else its title, else the name of what is drawn."""
    chosen = workspace(session).options.get("FTRA")
    if isinstance(chosen, str) and chosen.strip():
        return Path(chosen.strip()).stem
    return title.strip() or fallback


def save_picture(session: Session, figure: Figure, name: str, formats: tuple[str, ...]) -> None:
    """Write a figure under the next number."""
    output = run_output(session)
    output.wrote(*output.pictures.save(figure, name, formats))

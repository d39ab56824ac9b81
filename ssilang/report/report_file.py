"""Writes `report.html` of a folder of results."""

from __future__ import annotations

from pathlib import Path

from ssilang.io.atomic import write_text
from ssilang.report.deck_text import Colours
from ssilang.report.page import page_of
from ssilang.report.results import read_results
from ssilang.report.sweep_page import sweep_page
from ssilang.report.sweep_table import is_sweep, read_sweep

NAME = "report.html"


def make_report(folder: Path, language: str, colours: Colours) -> Path:
    """Write the report of a folder, of a run or a sweep, into it.

    Parameters
    ----------
    language : 'en' or 'fr'
    colours : callable
        Start, end and colour of the words of a deck.

    Raises
    ------
    InputError, OutputError
        If no run has left anything there, or it cannot be written.
    """
    path = folder / NAME
    if is_sweep(folder):
        write_text(path, sweep_page(read_sweep(folder), language))
    else:
        write_text(path, page_of(read_results(folder), language, colours))
    return path

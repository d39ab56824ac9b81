"""Running a script in a test and looking at what it made."""

import io
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, TextIO

import numpy as np
import pytest

from ssilang.cli.run import RunOptions, RunResult, execute, make_session, run_text
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.run.session import Session
from ssilang.language.text.source import Source


def ran(
    script: str, output_directory: Path | None = None, options: RunOptions | None = None
) -> RunResult:
    """The end of a script that must succeed."""
    result = run_text(script, output_directory, options)
    assert result.exit_code == 0, result.message
    return result


HOPPING = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; T = TABL ; LIN1 = PROG 0. PAS {dt} {end} ;
PS = 0. -1. ; PM = 0. 0. ; JOI = MANU 'SEG2' PS PM ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
T . 'RIGI' = (BLOQ 'UX' 'UY' PS) ET (BLOQ 'UX' PM) ; T . 'MASS' = MASS 'DEPL' 1.E3 PM ;
T . 'MODELE' = MOJ ; T . 'CARACTERISTIQUES' = MATE MOJ 'KN' 1.E7 'KS' 0. ;
T . 'CHAR' = (CHAR 'MECA' (FORC (0. -1.E4) PM)) ET
  (CHAR 'MECA' (FORC (0. 3.E4) PM) (EVOL 'MANU' LIN1 (SIN (LIN1 * 500.)))) ;
T . 'TEMPS_CALCULES' = LIN1 ; T . 'PAS_SAUVES' = {every} ;
T . 'PAS_SAUVES_VTK' = {every} ; T . 'MAILLAGE_VTK' = JOI ;
T . 'PAS_SAUVES_CSV' = 1 ; T . 'MAILLAGE_CSV' = PM ;
T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = {steps} ;
T2 = DYNAMIC T ;
"""
"""A mass that leaves a joint again and again: files of all kinds, checkpoints."""

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def session_after(text: str, folder: Path, output: TextIO | None = None) -> Session:
    """A session that has run a text."""
    made = make_session(Source("prelude", ""), RunOptions(folder), output or io.StringIO())
    execute(made, Source("prelude", text))
    return made


def found(script: str, *names: str, folder: Path | None = None) -> Any:
    """The objects of these names, one alone for one name; the script must succeed."""
    root = ran(script, folder).session.root
    values = tuple(root.find(n) for n in names)
    return values[0] if len(values) == 1 else values


def finder(script: str, folder: Path | None = None) -> Callable[[str], Any]:
    """What finds the objects of a script by their names; the script must succeed."""
    return ran(script, folder).session.root.find


def printed(script: str, folder: Path | None = None) -> list[str]:
    """The lines that a script prints; it must succeed."""
    return ran(script, folder).output.rstrip("\n").split("\n")


def failed(script: str, folder: Path | None = None) -> RunResult:
    """The end of a script that must fail at what stands between « and », where these stand."""
    before, here, rest = script.partition("«")
    place, _, after = rest.partition("»")
    result = run_text(before + place + after, output_directory=folder)
    assert result.exit_code == 1
    assert "defect of ssilang" not in result.message
    if here:
        span = result.errors[0].span
        assert (span.start, span.source.text[span.start : span.end]) == (len(before), place)
    return result


def refused(script: str, folder: Path | None = None) -> str:
    """The message of a script that must fail, as `failed`."""
    return failed(script, folder).message


def assert_says(output: str, wanted: str) -> None:
    """A text is as known but for blanks: words as they are, numbers to four digits."""
    found = " ".join(output.split())
    assert _NUMBER.sub("#", found) == _NUMBER.sub("#", wanted)
    numbers = [[float(x) for x in _NUMBER.findall(t)] for t in (found, wanted)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-4, abs=1e-9)


def assert_field(field: Any, wanted: Mapping[str, Callable[..., Any]]) -> None:
    """Every component is its function of the place, in all nodes or points."""
    if isinstance(field, NodeField):
        at = field.table.coordinates
        parts = [(n, at[p.nodes], p.values) for n, p in field.components.items()]
    else:
        parts = [(n, b.cells.coordinates, v) for b in field.blocks for n, v in b.components.items()]
    assert list(dict.fromkeys(n for n, *_ in parts)) == list(wanted)
    for name, place, values in parts:
        if values.shape[1:] != place.shape[1:-1]:
            place = place.mean(axis=1, keepdims=True)
        exact = wanted[name](*np.moveaxis(place, -1, 0))
        np.testing.assert_allclose(values, np.broadcast_to(exact, values.shape), 1e-12, 1e-12)


def prog(values: Iterable[float]) -> str:
    """A list of reals, all their digits."""
    return "(PROG " + " ".join(f"{v:.17g}" for v in values) + ")"

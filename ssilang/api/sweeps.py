"""One script over many values and ground motions, from Python: a DataFrame of what it reports."""

import io
import os
import sys
import tempfile
import warnings
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from ssilang.api.errors import Error, Notice, refused
from ssilang.api.running import Allowed, Script, folders
from ssilang.api.view import library
from ssilang.cli.sweeping.given import Case, GivenError, Value, combined, motions_in
from ssilang.cli.sweeping.pool import dask_installed
from ssilang.cli.sweeping.sweep import (
    SweepOptions,
    run_cases,
    write_reports,
    write_results,
)
from ssilang.cli.sweeping.worker import Row
from ssilang.language.say.errors import SsiError
from ssilang.report.sweep_table import MOTION, RESERVED

if TYPE_CHECKING:
    import pandas


def sweep(
    script: Script,
    /,
    *,
    records: Script | Iterable[Script] | None = None,
    out: Script | None = None,
    jobs: int = 0,
    scheduler: str = "",
    allow: Allowed = (),
    language: str = "en",
    quiet: bool = True,
    report: bool = False,
    **values: Any,
) -> "pandas.DataFrame":
    """Run a script for all combinations of values and ground motions, as `ssilang sweep` does.

    Parameters
    ----------
    script : path
    records : path, or paths
        A folder of ground motions, or their files; the script finds the path of one in MOTION.
    out : path, optional
        Folder for what the runs write, for `sweep.csv`, joined `histories` and pictures of the
        figures; a sweep of that folder that was stopped goes on. Without it nothing stays.
    jobs : int
        Processes; 0: one a core.
    scheduler : str
        Address of a Dask scheduler, whose workers run instead of processes here.
    allow, language, quiet
        As for `run`.
    report : bool
        Whether each run and the sweep leave a page, `report.html`, in `out`.
    **values
        A value or several for names of the script; the last name changes fastest.

    Returns
    -------
    pandas.DataFrame
        A row a run, by its number: its values, a column for each figure that the script reports,
        `exit_code`, `seconds`, `error` ('' of a run that ended well), `warnings` (their codes),
        and `folder` if one was asked for. Runs that fail are warned of.

    Raises
    ------
    Error
        If the script cannot be read, or does not have a name that is given values.

    Examples
    --------
    ::

        table = ssilang.sweep("tower.ssi", AG=[0.2, 0.4], records="motions")
        table.pivot_table("uplift", "AG", "MOTION")
    """
    pd = library("pandas", language)
    if isinstance(script, str) and (";" in script or "\n" in script):
        raise refused("api.sweep-of-a-file", language)
    if report and out is None:
        raise refused("api.report-without-folder", language)
    options = SweepOptions(
        Path(script), out=None if out is None else Path(out), jobs=jobs, scheduler=scheduler,
        allowed=folders(allow), language=language,
        report=report,
    )  # fmt: skip
    told = (io.StringIO(), io.StringIO()) if quiet else (sys.stdout, sys.stderr)
    try:
        if scheduler and not dask_installed():
            raise GivenError("cli.cluster-needs-dask-distributed")
        cases = _cases(values, records, language)
        rows = _rows(cases, options, *told)
    except GivenError as problem:
        raise Error([Notice.of(SsiError.of(problem, None), language)]) from None
    except SsiError as problem:
        raise Error([Notice.of(problem, language)]) from None
    _warn_of_failures(rows, language)
    made = pd.DataFrame(rows).set_index("run")
    last = [name for name in RESERVED if name in made and (out is not None or name != "folder")]
    return made[[*(name for name in made if name not in RESERVED), *last]]


def _cases(
    values: dict[str, Any], records: Script | Iterable[Script] | None, language: str
) -> list[Case]:
    axes = {name.upper(): _axis(name, given, language) for name, given in values.items()}
    if isinstance(records, (str, os.PathLike)):
        axes[MOTION] = [*motions_in(Path(records), [])]
    elif records is not None:
        axes[MOTION] = [str(Path(r).resolve()) for r in records]
    return combined(axes)


def _axis(name: str, given: Any, language: str) -> list[Value]:
    """The values of a name: one, or those of a sequence."""
    several = isinstance(given, (Sequence, np.ndarray, set)) or hasattr(given, "to_numpy")
    values = list(given) if several and not isinstance(given, str) else [given]
    plain = [v.item() if isinstance(v, np.generic) else v for v in values]
    plain = [os.fspath(v) if isinstance(v, os.PathLike) else v for v in plain]
    for value in plain:
        if not isinstance(value, bool | int | float | str):
            kind = type(value).__name__
            raise refused("api.no-value-of-sweep", language, name=name, kind=kind)
    if not plain:
        raise refused("api.no-value-of-sweep", language, name=name, kind="[]")
    return plain


def _rows(cases: list[Case], options: SweepOptions, out: TextIO, err: TextIO) -> list[Row]:
    """Rows of all cases; tables and pictures too, if a folder was asked for."""
    if options.out is not None:
        rows = run_cases(cases, options, out, err)
        write_results(rows, list(cases[0].values), options.folder)
        if options.report:
            write_reports(rows, options)
        return rows
    with tempfile.TemporaryDirectory(prefix="ssilang-") as folder:
        options.out = Path(folder)
        return run_cases(cases, options, out, err)


def _warn_of_failures(rows: list[Row], language: str) -> None:
    failed = [row for row in rows if row["exit_code"] != 0]
    if failed:
        notice = refused(
            "api.runs-failed", language,
            count=len(failed), total=len(rows), error=failed[0]["error"],
        )  # fmt: skip
        warnings.warn(notice.notices[0].text, RuntimeWarning, stacklevel=3)

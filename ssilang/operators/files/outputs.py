"""The files that operators read and write: where they may be, what the options call them."""

import os
from pathlib import Path

from ssilang.io.atomic import fault_on_windows, portable
from ssilang.io.run_output import RunOutput
from ssilang.operators.prelude import *


def run_output(session: Session) -> RunOutput:
    """The files of the session's run."""
    ws = workspace(session)
    if ws.output is None:
        ws.output = RunOutput(
            Path(session.output_directory), Path(session.script_directory), tuple(session.allowed)
        )
    return ws.output


def digests_of_read(session: Session) -> dict[str, str]:
    """Digests of the files that the deck has read so far, by their path from its folder."""
    from ssilang.io.checkpoint import digest_of_file

    output, folder = run_output(session), Path(session.script_directory).resolve()
    paths = [p for p in (*output.read, *session.library.read) if p not in output.files]
    found = {p.resolve(): digest_of_file(p) for p in paths}
    return {
        str(p.relative_to(folder) if p.is_relative_to(folder) else p): d for p, d in found.items()
    }


def output_path(call: Call, name: str) -> Path:
    """Where a file is written: below the output folder.

    A whole path to a folder that this machine does not have leads there, too, with a warning.

    Raises
    ------
    SsiError
        'forbidden-path' for a place outside of it that no `--allow` permits.
    """
    output = run_output(call.session)
    path = output.target(name)
    if path is None:
        path = _elsewhere(output, name)
        if path is None:
            raise _forbidden(call, name, output.directory)
        if path not in output.files:
            call.warn("io.folder-not-here", name=name.strip(), file=path.name)
    if path not in output.files and (reason := fault_on_windows(name)):
        call.warn("io.name-stays-here", name=name.strip(), reason=reason)
    return path


def _elsewhere(output: RunOutput, name: str) -> Path | None:
    """Where a file is written whose whole path is of another machine; None for one of this one."""
    meant = Path(portable(name.strip()))
    away = meant.root and not os.path.isdir(meant.parent)
    return output.target(meant.name) if away else None


def input_path(call: Call, name: str) -> Path:
    """An existing file to read, below the script's folder or the output folder.

    Raises
    ------
    SsiError
        'forbidden-path' outside of them, 'missing-file' if there is no such file.
    """
    output = run_output(call.session)
    path = output.source(name)
    if path is None and (path := _elsewhere(output, name)) not in output.files:
        raise forbidden_path(call, name)
    if not path.is_file():
        raise call.error("missing-file", name, path=str(path), reason="")
    if output.is_foreign(path):
        call.session.warn("other-case", call.span, path=str(path))
    return path


def file_to_read(call: Call, name: str, suffix: str) -> Path:
    """An existing file to read, by its name or, where there is none, its name with a suffix."""
    output = run_output(call.session)
    with_suffix, plain = output.source(name + suffix), output.source(name)
    if with_suffix is not None and with_suffix.is_file() and not (plain and plain.is_file()):
        return with_suffix
    return input_path(call, name)


def forbidden_path(call: Call, name: str) -> SsiError:
    """The refusal of a file outside of the script's folder and of the output folder."""
    return _forbidden(call, name, run_output(call.session).inputs)


def _forbidden(call: Call, name: str, base: Path) -> SsiError:
    path = (base / portable(name)).resolve()
    return call.error("forbidden-path", name, path=str(path), folder=str(path.parent))


def option_name(session: Session, word: str, default: int) -> str:
    """The file that OPTI names for `word` ('SORT', 'SAUV', ...): a name, or fort.N for unit N."""
    value: Any = workspace(session).options.get(word, default)
    return f"fort.{value}" if isinstance(value, int) else str(value).strip()

"""Gmsh's own scripts (.geo), meshed by Gmsh in a guarded process of its own (`gmsh_alone`)."""

import os
import re
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

from ssilang.io.errors import InputError, text_of
from ssilang.io.mesh_files import gmsh_alone
from ssilang.io.mesh_files.file_mesh import FileMesh
from ssilang.io.mesh_files.foreign import read_foreign

FREE = "SSILANG_ALLOW_GEO"
"""In the environment (`--allow-geo` puts it there): scripts run where no guard is to be had."""

LONGEST = 600
"""Seconds that Gmsh may take; SSILANG_GEO_SECONDS in the environment says otherwise."""
_PASSED = ("LD_LIBRARY_PATH", "PATH", "SYSTEMROOT")  # of the environment

# What the guard would refuse is said before: a help, and no guard.
_OUTWARD = re.compile(
    r"\b(NonBlockingSystemCall|SystemCall|System|Save|Print|OnelabRun|ExternalProcess|CreateDir)\b"
    r"|\bPrintf\s*\([^;]*\)\s*>"
)
_PASSIVE = re.compile(r'"[^"\n]*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def read_geo(path: Path, dimension: int) -> FileMesh:
    """The mesh that Gmsh makes of a script, which may read what stands below its folder.

    Raises
    ------
    InputError
        Without Gmsh or a guard, if the script reaches out of its folder, or if Gmsh cannot mesh it.
    """
    text = text_of(path)
    outward = _OUTWARD.search(_PASSIVE.sub(" ", text))
    if outward is not None:
        raise InputError("io.geo-reaches-out", name=path.name, word=outward.group(0)[:40])
    found = find_spec("gmsh")
    if found is None or found.origin is None:
        raise InputError("io.gmsh-missing", error="")
    with tempfile.TemporaryDirectory() as room:
        folder = Path(room).resolve() / "made"
        folder.mkdir()
        return _meshed(path.resolve(), folder, dimension, str(Path(found.origin).parent))


def _meshed(script: Path, folder: Path, dimension: int, library: str) -> FileMesh:
    free = os.environ.get(FREE, "")
    asked = os.environ.get("SSILANG_GEO_SECONDS", "")
    longest = int(asked) if asked.isdecimal() else LONGEST
    own = [sys.executable, "-P", gmsh_alone.__file__]
    kept = {k: v for k, v in os.environ.items() if k in _PASSED}
    nothing = subprocess.DEVNULL
    try:
        code = subprocess.run(
            [*own, str(script), str(folder), str(dimension), library, free],
            stdin=nothing, stdout=nothing, stderr=nothing, check=False, cwd=folder,
            timeout=longest, env=kept | {"HOME": str(folder), "TMPDIR": str(folder)},
        ).returncode  # fmt: skip
    except subprocess.TimeoutExpired as error:
        raise InputError("io.geo-takes-long", name=script.name, seconds=longest) from error
    if code == gmsh_alone.UNGUARDED:
        raise InputError("io.geo-unguarded", name=script.name)
    note, made = folder / gmsh_alone.TOLD, folder / gmsh_alone.MADE
    told = note.read_text(encoding="utf-8", errors="replace") if note.is_file() else ""
    if told.startswith("import: "):  # a library of the system that Gmsh draws with
        raise InputError("io.gmsh-missing", error=told.removeprefix("import: "))
    if told or code or not made.stat().st_size:
        fault = told[:200] or f"exit {code}"
        raise InputError("io.no-readable-mesh-file", name=script.name, kind="GEO", error=fault)
    return read_foreign(made, "GMSH")

"""Gmsh's own scripts (.geo), meshed by Gmsh in a process of its own."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

from ssilang.io.errors import InputError
from ssilang.io.mesh_files.file_mesh import FileMesh
from ssilang.io.mesh_files.foreign import read_foreign
from ssilang.system_reasons import system_reason

# commands of a .geo file that run programs, or read and write other files than itself
_OUTWARD = re.compile(
    r"\b(NonBlockingSystemCall|SystemCall|System|Include|Merge|MergeFile|Open|Save|Print|OnelabRun|"
    r"Plugin|ShapeFromFile|CreateDir|Exit)\b|\bPrintf\s*\([^;]*\)\s*>"
)
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_MESHED = """
import sys, gmsh
gmsh.initialize([], interruptible=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
try:
    gmsh.open(sys.argv[1])
    gmsh.model.mesh.generate(int(sys.argv[3]))
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.write(sys.argv[2])
except Exception as error:
    told = [t for t in gmsh.logger.get() if t.startswith("Error")]
    sys.exit((told or [str(error)])[0].removeprefix("Error: "))
"""


def read_geo(path: Path, dimension: int) -> FileMesh:
    """The mesh that Gmsh makes of a script.

    Raises
    ------
    InputError
        Without Gmsh, if the script reaches out of itself, or if Gmsh cannot mesh it.
    """
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError("io.cannot-read", path=path, strerror=system_reason(error)) from error
    outward = _OUTWARD.search(_COMMENT.sub("", text))
    if outward is not None:
        raise InputError("io.geo-reaches-out", name=path.name, word=outward.group(0)[:40])
    if find_spec("gmsh") is None:
        raise InputError("io.gmsh-missing", error="")
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / f"{path.stem}.msh"
        command = [sys.executable, "-c", _MESHED, str(path), str(made), str(dimension)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
        told = (done.stderr.strip().splitlines() or [f"exit {done.returncode}"])[-1]
        if "cannot open shared object" in told:  # a library of the system that Gmsh draws with
            raise InputError("io.gmsh-missing", error=told)
        if done.returncode or not made.is_file():
            raise InputError(
                "io.no-readable-mesh-file", name=path.name, kind="GEO", error=told[:200]
            )
        return read_foreign(made, "GMSH")

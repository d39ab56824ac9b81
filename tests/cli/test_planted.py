"""Modules that lie beside a deck, under the names of libraries, are not imported by any start."""

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from petsc_there import COMMAND as COMMAND_OF_PETSC
from petsc_there import environment

from ssilang.io.mesh_files import gmsh_alone
from ssilang.kernel.solvers.petsc.client import SERVER

NAMES = (
    "numpy", "scipy", "numba", "matplotlib", "lark", "random", "encodings", "sitecustomize",
    "usercustomize", "tomllib", "pickle", "multiprocessing", "socket", "struct", "json", "typing",
    "contextlib", "concurrent", "gmsh", "ipykernel", "pygls", "resource", "tempfile", "ssilang",
)  # fmt: skip
LATE = (*NAMES[:9], "tomllib", "pickle", "json", "typing", "concurrent", "tempfile")
DECK = "OPTI DIME 2 ; X = 1. ; L = PROG X 2. ; SORT 'BILA' 'top' (MAXI L) ;\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A stranger's folder: a deck, and modules that tell that they ran."""
    ran = tmp_path / "ran"
    ran.mkdir()
    place = tmp_path / "deck"
    place.mkdir()
    plant(place, ran, NAMES)
    (place / "case.ssi").write_text(DECK)
    return place


def plant(place: Path, ran: Path, names: tuple[str, ...]) -> None:
    for name in names:
        (place / f"{name}.py").write_text(
            f"open({str(ran / name)!r}, 'w').close()\nraise ImportError({name!r})\n"
        )


def ran(folder: Path) -> list[str]:
    return sorted(p.name for p in (folder.parent / "ran").iterdir())


def start(folder: Path, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        words, cwd=folder, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
        env=os.environ | environment, timeout=100,
    )  # fmt: skip


COMMAND = str(Path(sys.executable).parent / "ssilang")
SAFE = (sys.executable, "-P", "-m", "ssilang.cli.main")
TWO = (
    "import sys; from ssilang.cli.main import main; "
    "sys.exit(main(['check', 'case.ssi']) or main(['help', 'DYNAMIC']))"
)


def test_what_is_planted_runs_where_the_folder_is_searched(folder: Path) -> None:
    """What the other tests look for does happen."""
    start(folder, sys.executable, "-c", "import random")
    assert "random" in ran(folder)


@pytest.mark.parametrize(
    "words",
    [
        (*SAFE, "case.ssi"),
        (*SAFE[:2], "-c", TWO),
        (COMMAND, "sweep", "case.ssi", "--set", "X=1,2,3", "--jobs", "2", "--out", "swept"),
        (COMMAND, "sweep", "case.ssi", "--set", "X=1,2,3,4,5", "--jobs", "1", "--out", "grown"),
    ],
    ids=["module", "check and help", "sweep", "sweep from one"],
)
def test_a_start_in_a_strangers_folder(folder: Path, words: tuple[str, ...]) -> None:
    done = start(folder, *words)
    assert ran(folder) == []
    assert done.returncode == 0, done.stderr


def test_a_module_without_its_option_takes_libraries_from_elsewhere(tmp_path: Path) -> None:
    """`python -m` itself reads some of Python's own modules there, before anything of ours."""
    place = tmp_path / "deck"
    place.mkdir()
    (tmp_path / "ran").mkdir()
    plant(place, tmp_path / "ran", LATE)
    (place / "case.ssi").write_text(DECK)
    done = start(place, sys.executable, "-m", "ssilang.cli.main", "case.ssi")
    assert ran(place) == []
    assert done.returncode == 0, done.stderr


def test_the_language_server(folder: Path) -> None:
    if find_spec("pygls") is None:
        pytest.skip("pygls is not installed")
    start(folder, *SAFE, "lsp")
    assert ran(folder) == []


def test_the_kernel_of_notebooks(folder: Path, tmp_path: Path) -> None:
    if find_spec("jupyter_client") is None:
        pytest.skip("jupyter_client is not installed")
    from ssilang.jupyter.__main__ import install

    spec = json.loads((install(str(tmp_path / "prefix")) / "kernel.json").read_text())
    words = [w.replace("{connection_file}", "nowhere.json") for w in spec["argv"]]
    start(folder, *words, "--help")
    assert ran(folder) == []


def test_the_kernel_of_notebooks_once_it_serves(folder: Path) -> None:
    """Libraries of IPython that do not heed `-P` put the notebook's folder before all others."""
    if find_spec("ipykernel") is None:
        pytest.skip("ipykernel is not installed")
    code = (
        "import sys; sys.path.remove(''); from ipykernel.kernelapp import IPKernelApp as App; "
        "from importlib.util import find_spec; App.start = lambda app: "
        "print(find_spec('gmsh'), file=open('found.txt', 'w')); "
        "from ssilang.jupyter.__main__ import main; main(['-f', 'made.json'])"
    )
    done = start(folder, sys.executable, "-c", code)
    assert (folder / "found.txt").is_file(), done.stderr
    assert str(folder) not in (folder / "found.txt").read_text()


def test_the_second_compiler(folder: Path) -> None:
    """It is told the paths of the run; an empty one would be the working folder."""
    code = (
        "import time; from ssilang.kernel.base.compiled import beside, ALLOWED; "
        "ALLOWED.add('beside'); beside.free_cores = lambda: 2; beside.BESIDE._start(); "
        "time.sleep(1.0); assert beside.BESIDE._process.poll() is None"
    )
    done = start(folder, sys.executable, "-P", "-c", code, PYTHONPATH="")
    assert ran(folder) == []
    assert done.returncode == 0, done.stderr


def test_the_process_of_gmsh(folder: Path) -> None:
    (folder / "box.geo").write_text("Point(1) = {0, 0, 0, 1};\n")
    (folder / "case.ssi").write_text("OPTI DIME 2 ; T = MAILLER 'box.geo' ;\n")
    done = start(folder, COMMAND, "case.ssi")
    assert ran(folder) == []
    assert "Traceback" not in done.stderr
    assert (folder / "results" / "case" / "summary.json").is_file()
    assert Path(gmsh_alone.__file__).is_file()


DRAWN = """OPTI DIME 2 ; L = PROG 0. 1. ; TITR 'a title' ; DESS (EVOL 'MANU' L L) ;
P = 0. 0. ; Q = 1. 0. ; J = MANU 'SEG2' P Q ; M = MODE J 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
K = (RIGI M (MATE M 'YOUN' 1. 'SECT' 1.)) ET (BLOQ 'UX' 'UY' P) ET (BLOQ 'UY' Q) ;
SORT 'BILA' 'moved' (MAXI (RESO K (FORC (1. 0.) Q))) ;
"""


def test_settings_of_libraries(tmp_path: Path) -> None:
    """A figure's LaTeX would be a program, and a run without compiled code never ends."""
    (tmp_path / "ran").mkdir()
    place, programs = tmp_path / "deck", tmp_path / "programs"
    for folder in (place, programs):
        folder.mkdir()
    (place / "case.ssi").write_text(DRAWN)
    (place / "matplotlibrc").write_text("text.usetex: True\nfont.size: 40\n")
    (place / ".numba_config.yaml").write_text("disable_jit: 1\n")
    (programs / "latex").write_text(f"#!/bin/sh\n: > {tmp_path}/ran/latex\n")
    (programs / "latex").chmod(0o755)
    code = (
        "import sys; from ssilang.cli.main import main; code = main(sys.argv[1:]); import numba; "
        "numba.core.config.reload_config(); sys.exit(code or numba.config.DISABLE_JIT)"
    )
    path = os.pathsep.join((str(programs), os.environ["PATH"]))
    done = start(place, sys.executable, "-P", "-c", code, "case.ssi", PATH=path)
    assert done.returncode == 0, done.stderr
    assert ran(place) == []


@pytest.mark.usefixtures("petsc_is_there")
def test_options_of_petsc(tmp_path: Path) -> None:
    """Its options write any file."""
    (tmp_path / "case.ssi").write_text("OPTI 'SOLVEUR' 'PETSC' ; " + DRAWN.replace("\n", " "))
    (tmp_path / ".petscrc").write_text(f"-info {tmp_path}/written\n")
    done = start(tmp_path, COMMAND, "--petsc", COMMAND_OF_PETSC, "case.ssi", **environment())
    assert done.returncode == 0, done.stderr
    assert "PETSc" in (tmp_path / "results" / "case" / "summary.json").read_text()
    assert not list(tmp_path.glob("written*"))


def test_the_server_of_petsc(folder: Path) -> None:
    start(folder, sys.executable, str(SERVER), str(folder))
    assert ran(folder) == []

"""A release: what is packed, and what is installed of it where nothing else is."""

import importlib.metadata as metadata
import json
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from dataclasses import dataclass
from pathlib import Path

import pytest

from ssilang import __version__

_ROOT = Path(__file__).resolve().parents[1]
_NESTED = ("grammar", "stdlib", "cases", "docs")  # at the top of the tree, inside the package

pytest.importorskip("hatchling", reason="builds the wheel: pip install '.[test]'")


@dataclass
class Release:
    """What a release is made of: source distribution, the tree unpacked from it, wheel."""

    sdist: Path
    tree: Path
    wheel: Path


@dataclass
class Environment:
    """A Python in which the wheel and what it asks for is installed, and nothing else."""

    python: Path
    folder: Path

    def ssilang(self, *arguments: str) -> str:
        """What the installed command prints, in an empty folder; it must end well."""
        done = subprocess.run(
            [str(self.python.with_name("ssilang")), *arguments],
            cwd=self.folder, env=_environment(), capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


def _environment() -> dict[str, str]:
    """Variables of the installed program: no other tree is seen, and nothing is compiled."""
    hidden = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV")
    kept = {name: value for name, value in os.environ.items() if name not in hidden}
    return {**kept, "NUMBA_DISABLE_JIT": "1"}


def _build(kind: str, tree: Path, target: Path) -> Path:
    command = [sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", str(target)]
    subprocess.run(command, cwd=tree, check=True, capture_output=True)
    return next(target.iterdir())


@pytest.fixture(scope="module")
def release(tmp_path_factory: pytest.TempPathFactory) -> Release:
    """Both files, the wheel from the source distribution, as `python -m build` makes them."""
    folder = tmp_path_factory.mktemp("release")
    sdist = _build("sdist", _ROOT, folder / "sdist")
    with tarfile.open(sdist) as packed:
        safely = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}  # from 3.11.4
        packed.extractall(folder, **safely)
    tree = folder / sdist.name.removesuffix(".tar.gz")
    return Release(sdist, tree, _build("wheel", tree, folder / "wheel"))


@pytest.fixture(scope="module")
def installed(release: Release, tmp_path_factory: pytest.TempPathFactory) -> Environment:
    """The wheel put by pip into an empty environment, its dependencies as links to ours.

    Only what the wheel asks for is there, and what that asks for: no extra, no tool of the tests.
    """
    folder = tmp_path_factory.mktemp("installed")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder / "v")], check=True)
    python = folder / "v" / "bin" / "python"
    subprocess.run(
        [sys.executable, "-m", "pip", "--python", str(python), "install", "--quiet",
         "--no-deps", "--no-index", "--no-compile", str(release.wheel)],
        check=True, env=_environment(),
    )  # fmt: skip
    site = next((folder / "v" / "lib").glob("python3*")) / "site-packages"
    own = metadata.Distribution.at(next(site.glob("ssilang-*.dist-info")))
    for found in _needed(own).values():
        for top in {f.parts[0] for f in found.files or () if f.parts[0] != ".."}:
            source, link = Path(str(found.locate_file(top))), site / top
            if source.exists() and not link.exists():
                link.symlink_to(source)
    empty = folder / "empty"
    empty.mkdir()
    return Environment(python, empty)


def _needed(start: metadata.Distribution) -> dict[str, metadata.Distribution]:
    """What a distribution asks for without extras, directly or not, by name."""
    from packaging.requirements import Requirement

    found: dict[str, metadata.Distribution] = {}
    waiting = [start]
    while waiting:
        for line in waiting.pop().requires or ():
            asked = Requirement(line)
            wanted = asked.marker is None or asked.marker.evaluate({"extra": ""})
            if wanted and asked.name.lower() not in found:
                found[asked.name.lower()] = metadata.distribution(asked.name)
                waiting.append(found[asked.name.lower()])
    return found


def test_the_source_distribution_is_the_tree(release):
    asked = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=_ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if asked.returncode:
        pytest.skip("no git checkout")
    tree = {name for name in asked.stdout.split("\0") if name and (_ROOT / name).exists()}
    packed = {
        p.relative_to(release.tree).as_posix() for p in release.tree.rglob("*") if p.is_file()
    }
    assert packed - {"PKG-INFO"} == tree


def test_the_wheel_has_the_package_and_the_files_that_it_reads(release):
    tree = release.tree
    wanted = {
        (Path(inside) / path.relative_to(tree / folder)).as_posix()
        for folder, inside in (("ssilang", "ssilang"), *((n, f"ssilang/{n}") for n in _NESTED))
        for path in (tree / folder).rglob("*")
        if path.is_file()
    }
    with zipfile.ZipFile(release.wheel) as packed:
        names = set(packed.namelist())
    own = {name for name in names if not name.startswith(f"ssilang-{__version__}.dist-info/")}
    assert own == wanted
    assert f"ssilang-{__version__}.dist-info/licenses/LICENSE" in names


def test_one_version_everywhere(release):
    assert release.sdist.name == f"ssilang-{__version__}.tar.gz"
    changes = (_ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(r"^## (.+)$", changes, re.MULTILINE)[1] == __version__
    cited = (_ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (.+)$", cited, re.MULTILINE)[1] == __version__
    editor = json.loads((_ROOT / "editors/vscode/package.json").read_text(encoding="utf-8"))
    assert editor["version"] == __version__


def test_the_installed_program_is_its_own(installed):
    code = "import ssilang, importlib.util as u; print(ssilang.__file__, u.find_spec('pytest'))"
    said = subprocess.run(
        [str(installed.python), "-c", code],
        cwd=installed.folder, env=_environment(), capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    assert Path(said.split()[0]).is_relative_to(installed.folder.parent)
    assert said.split()[1] == "None"
    assert installed.ssilang("--version") == f"ssilang {__version__}\n"


def test_a_starter_runs_where_the_wheel_is_installed(installed):
    """Deck, procedures of the library (`@VERIFIE`), picture, report with its scripts."""
    installed.ssilang("new", "oscillator")
    said = installed.ssilang("oscillator.ssi", "--report")
    assert "all 2 checks within tolerance" in said
    results = installed.folder / "results" / "oscillator"
    assert list(results.glob("*.png"))
    page = (results / "report.html").read_text(encoding="utf-8")
    assert "vtk" in page
    assert "uPlot" in page


def test_help_of_the_installed_program_has_procedures_entries_and_pages(
    installed,
):
    said = installed.ssilang("help", "PASAPAS")
    assert "TEMPS_CALCULES" in said
    assert "docs/" in said

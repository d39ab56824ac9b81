"""The extension of VS Code: its colours on all decks, and that it can be packaged."""

import json
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "editors" / "vscode"
_SECONDS = 240  # to fetch the packages

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(shutil.which("npm") is None, reason="needs npm"),
]


def npm(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["npm", *arguments], cwd=FOLDER, capture_output=True, text=True, timeout=_SECONDS
    )


@pytest.fixture(scope="module")
def installed():
    if npm("ls").returncode == 0:
        return
    try:
        done = npm("install", "--no-audit", "--no-fund", "--prefer-offline", "--no-package-lock")
    except subprocess.TimeoutExpired:
        pytest.skip("the packages were not fetched in time")
    if done.returncode:
        pytest.skip(f"npm fetched no packages: {done.stderr.strip()[-200:]}")


def test_colours_and_package(installed):
    tried = npm("test")
    assert tried.returncode == 0, tried.stdout + tried.stderr
    assert "decks" in tried.stdout
    made = npm("run", "package")
    assert made.returncode == 0, made.stdout + made.stderr
    version = json.loads((FOLDER / "package.json").read_text())["version"]
    with zipfile.ZipFile(FOLDER / f"ssilang-{version}.vsix") as package:
        names = set(package.namelist())
    for needed in ("dist/extension.js", "syntaxes/gibiane.tmLanguage.json", "package.json"):
        assert f"extension/{needed}" in names


def test_what_the_package_names_is_there():
    package = json.loads((FOLDER / "package.json").read_text())
    contributes = package["contributes"]
    files = [entry["path"] for entry in (*contributes["grammars"], *contributes["snippets"])]
    files += [entry["configuration"] for entry in contributes["languages"]]
    for file in files:
        json.loads((FOLDER / file).read_text())
    declared = {entry["command"] for entry in contributes["commands"]}
    source = (FOLDER / "src" / "extension.js").read_text()
    assert declared == {c for c in declared if f'registerCommand("{c}"' in source}

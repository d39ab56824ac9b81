"""What a public project has beside its program: workflows, forms, images, recipes."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

from ssilang import __version__

_ROOT = Path(__file__).resolve().parents[1]
_GITHUB = _ROOT / ".github"
_PROJECT = tomllib.loads((_ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
_CONDA = {"matplotlib": "matplotlib-base"}  # without windows of its own
_FILES = [
    *sorted((_GITHUB / "workflows").glob("*.yml")),
    *sorted((_GITHUB / "ISSUE_TEMPLATE").glob("*.yml")),
    _ROOT / "CITATION.cff",
]


def read(path: Path) -> Any:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def readme_commands() -> list[str]:
    """The commands of the README that make an environment: set-up with a result, and tests."""
    text = (_ROOT / "README.md").read_text(encoding="utf-8")
    return re.findall(r"^python3 -m venv .+$", text, re.MULTILINE)


def runs(workflow: str) -> list[str]:
    """The commands of a workflow."""
    jobs = read(_GITHUB / "workflows" / workflow)["jobs"].values()
    return [step["run"] for job in jobs for step in job["steps"] if "run" in step]


@pytest.mark.parametrize("path", _FILES, ids=lambda p: p.name)
def test_files_are_what_their_readers_expect(path, capsys):
    reason = "has the schemas: pip install '.[test]'"
    program = pytest.importorskip("check_jsonschema", reason=reason).main
    kind = {"workflows": "github-workflows", "ISSUE_TEMPLATE": "github-issue-forms"}
    schema = kind.get(path.parent.name, "citation-file-format")
    if path.name == "config.yml":
        schema = "github-issue-config"
    with pytest.raises(SystemExit) as ended:
        program(["--builtin-schema", f"vendor.{schema}", str(path)])
    assert ended.value.code == 0, capsys.readouterr()


def test_an_image_is_made_by_the_commands_of_the_readme():
    lines = (_ROOT / "Dockerfile").read_text(encoding="utf-8").splitlines()
    steps = [line.removeprefix("RUN ") for line in lines if line.startswith("RUN python3")]
    result, tests = readme_commands()
    assert steps == [tests, result]  # the image is the last one
    assert len(lines) <= 10


def test_workflows_run_what_the_pages_say():
    _, tests = readme_commands()
    assert tests in runs("tests.yml")
    said = "pip install '.[docs]' && python docs/web_pages.py"
    assert f"`{said}`" in (_ROOT / "README.md").read_text(encoding="utf-8")
    assert said in runs("docs.yml")


def test_the_suite_runs_on_all_systems_and_pythons():
    matrix = read(_GITHUB / "workflows" / "tests.yml")["jobs"]["suite"]["strategy"]["matrix"]
    assert {name.partition("-")[0] for name in matrix["os"]} == {"ubuntu", "windows", "macos"}
    asked = SpecifierSet(_PROJECT["requires-python"])
    minors = [int(version.partition(".")[2]) for version in matrix["python"]]
    assert minors == list(range(minors[0], minors[-1] + 1))
    assert asked.contains(f"3.{minors[0]}")
    assert not asked.contains(f"3.{minors[0] - 1}")


def test_the_recipe_asks_for_what_the_package_asks_for():
    recipe = read(_ROOT / "conda" / "recipe.yaml")
    asked = [Requirement(line) for line in _PROJECT["dependencies"]]
    wanted = {_CONDA.get(r.name, r.name): r.specifier for r in asked}
    wanted["python"] = SpecifierSet(_PROJECT["requires-python"])
    lines = [line.partition(" ") for line in recipe["requirements"]["run"]]
    assert {name: SpecifierSet(bounds) for name, _, bounds in lines} == wanted
    assert len(lines) == len(wanted)
    host = {line.partition(" ")[0] for line in recipe["requirements"]["host"]}
    assert host == {"python", "pip", "hatchling"}


def test_the_recipe_is_of_this_release():
    recipe = read(_ROOT / "conda" / "recipe.yaml")
    assert recipe["context"]["version"] == __version__
    scripts = [f"{name} = {target}" for name, target in _PROJECT["scripts"].items()]
    assert recipe["build"]["python"]["entry_points"] == scripts
    about = recipe["about"]
    assert (about["summary"], about["license"]) == (_PROJECT["description"], _PROJECT["license"])
    assert (_ROOT / about["license_file"]).is_file()


def test_hooks_are_the_tools_that_the_tests_run():
    hooks = [h for repo in read(_ROOT / ".pre-commit-config.yaml")["repos"] for h in repo["hooks"]]
    tools = [hook["entry"].removeprefix("python -m ").split()[0] for hook in hooks]
    assert tools == ["ruff", "ruff", "pyrefly", "lint-imports"]
    house = (_ROOT / "tests" / "test_house.py").read_text(encoding="utf-8")
    for tool in tools:
        assert f'"{tool}"' in house


def test_no_address_is_made_up():
    paths = [p for p in _GITHUB.rglob("*") if p.is_file()]
    paths += [
        _ROOT / name for name in (".pre-commit-config.yaml", "Dockerfile", "conda/recipe.yaml")
    ]
    for path in paths:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"https?://|\w@\w+\.\w{2,3}\b", text), path

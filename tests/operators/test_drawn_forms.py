"""Forms of operators drawn by a seed, each written from Cast3M's notice before it was first run.

A file `drawn_SEED.forms` holds a short script a form and, behind `---`, what it prints (numbers to
1e-4; `~`: what stands last), or behind `--!` a word of the refusal.
"""

from pathlib import Path

import pytest
from together import together
from unchanged import operands_stay  # noqa: F401

from ssilang.cli.run import run_text

FILES = sorted(Path(__file__).with_name("drawn_forms").glob("*.forms"))
TOLERANCE = 1e-4  # of what scripts print in six digits


def forms() -> list[tuple[str, str, str]]:
    """Name, script and expected output of every form."""
    found = []
    for path in FILES:
        for block in path.read_text(encoding="utf-8").split("\n=== ")[1:]:
            name, _, rest = block.partition("\n")
            script, _, expected = rest.rpartition("\n--")
            found.append((f"{path.stem}-{name}", script, expected.strip()))
    return found


def same(printed: str, expected: str) -> bool:
    """Whether a printed item is the expected one."""
    try:
        return float(printed) == pytest.approx(float(expected), rel=TOLERANCE, abs=1e-9)
    except ValueError:
        return printed == expected


@pytest.mark.usefixtures("unsaved", "operands_stay")
@together("name, script, expected", forms(), by=lambda f: f[0].partition("-")[0])
def test_a_form_does_what_its_notice_says(name, script, expected, tmp_path):
    result = run_text(script, output_directory=tmp_path)
    if expected.startswith("!"):
        assert result.exit_code == 1
        assert "defect of ssilang" not in result.message
        assert expected[1:].strip() in result.message
        return
    assert result.exit_code == 0, f"{name}: {result.message}"
    printed, wanted = result.output.split(), expected.removeprefix("-").strip().split()
    if wanted[0].startswith("~"):
        wanted[0] = wanted[0].removeprefix("~")
        printed = printed[-len(wanted) :]
    assert len(printed) == len(wanted), result.output
    assert all(map(same, printed, wanted)), f"{printed} {wanted}"

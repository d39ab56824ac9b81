"""SECURITY.md names all readers of what others may have written, with tests that there are."""

import ast
import re
from pathlib import Path

import pytest
from together import together

from ssilang.cli.main import main

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "SECURITY.md").read_text(encoding="utf-8")
ROWS = re.findall(
    r"^\| [^|]+ \| `(ssilang/[^`]+)` \| [^|]+ \| `(tests/[^`]+)` \|$", TEXT, re.MULTILINE
)
READS = re.compile(
    r"json\.loads?\(|ElementTree|ZipFile\(|np\.load\(|loadtxt|fromfile|pickle\.loads|read_table|"
    r"read_array|tomllib\.load|h5py|meshio\.|pyvista\.(?:read|get_reader)|vtkHDFReader"
)


@together("module, test", ROWS)
def test_each_reader_is_there_and_has_its_test(module, test):
    assert (ROOT / module).is_file()
    file, _, name = test.partition("::")
    found = ast.walk(ast.parse((ROOT / file).read_text(encoding="utf-8")))
    assert name in {n.name for n in found if isinstance(n, ast.FunctionDef)}


def test_no_row_is_written_another_way():
    lines = [line for line in TEXT.splitlines() if line.startswith("| ")]
    assert len(ROWS) == len(lines) - 2 > 20


def test_each_module_that_reads_is_named():
    reading = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "ssilang").rglob("*.py")
        if READS.search(path.read_text(encoding="utf-8"))
    }
    assert len(reading) > 15
    assert {name for name in reading if f"`{name}`" not in TEXT} == set()


ENTITIES = "".join(
    f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True)
)
GROWING = (
    f'<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "{"a" * 20}">{ENTITIES}'
    '<!ENTITY x SYSTEM "file:///etc/hostname">]>'
    '<VTKFile type="UnstructuredGrid" version="0.1"><Collection>CONTENT</Collection></VTKFile>'
)


@pytest.mark.parametrize("content", ["&i;", "&x;"], ids=["two thousand million letters", "a file"])
def test_xml_that_grows_is_refused(content, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bomb.vtu").write_text(GROWING.replace("CONTENT", content))
    (tmp_path / "case.ssi").write_text("OPTI DIME 2 ; T = LIRE 'MESH' 'bomb.vtu' ;")
    assert main([str(tmp_path / "case.ssi")]) == 1
    assert "bomb.vtu cannot be read" in capsys.readouterr().err
    from ssilang.io.errors import InputError
    from ssilang.io.vtk.series import read_pvd

    (tmp_path / "bomb.pvd").write_text(GROWING.replace("CONTENT", content))
    with pytest.raises(InputError):
        read_pvd(tmp_path / "bomb.pvd")

"""Reports of folders that somebody else has written: nothing of the reader's, and no traceback."""

import copy
import json
import math
import random
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from together import together

from ssilang.cli.main import main
from ssilang.cli.run import write_report
from ssilang.io.atomic import inside
from ssilang.report import scenes
from ssilang.report.page import page_of
from ssilang.report.results import read_results, tables_of
from ssilang.system import CAN_FORK
from tests.report.test_report_file import Sections, page

SECRET = "ZQX"


def whole(folder: Path) -> dict[str, dict[str, Any]]:
    """Both records of a run."""
    return {n: json.loads((folder / n).read_text()) for n in ("summary.json", RECORD)}


RECORD = "report/contents.json"


def put(folder: Path, records: dict[str, dict[str, Any]], source: Path) -> Path:
    """A folder with these records and the tables of a run."""
    (folder / "report").mkdir(parents=True, exist_ok=True)
    for name, record in records.items():
        (folder / name).write_text(json.dumps(record))
    for path in (source / "report").glob("*.csv"):
        (folder / "report" / path.name).write_bytes(path.read_bytes())
    return folder


def names_the_deck(records: dict[str, Any], folder: Path, secret: Path) -> None:
    del records[RECORD]
    records["summary.json"]["deck"] = str(secret)


def names_the_deck_without_a_digest(records: dict[str, Any], folder: Path, secret: Path) -> None:
    names_the_deck(records, folder, secret)
    del records["summary.json"]["deck_digest"]


def names_a_table(records: dict[str, Any], folder: Path, secret: Path) -> None:
    records[RECORD]["calculations"][0]["table"] = str(secret)


def climbs_to_a_table(records: dict[str, Any], folder: Path, secret: Path) -> None:
    records[RECORD]["calculations"][0]["table"] = f"../../{secret.parent.name}/{secret.name}"


def links_a_table(records: dict[str, Any], folder: Path, secret: Path) -> None:
    (folder / "top.csv").symlink_to(secret)


def links_a_picture(records: dict[str, Any], folder: Path, secret: Path) -> None:
    (folder / "a.png").symlink_to(secret)
    records["summary.json"]["files"].append({"path": "a.png", "bytes": 1})


def links_the_record(records: dict[str, Any], folder: Path, secret: Path) -> None:
    record = records.pop(RECORD)
    (secret.parent / "contents.json").write_text(json.dumps({**record, "text": SECRET}))
    (folder / "report").mkdir()
    (folder / RECORD).symlink_to(secret.parent / "contents.json")


def links_the_folder(records: dict[str, Any], folder: Path, secret: Path) -> None:
    record = records.pop(RECORD)
    (secret.parent / "contents.json").write_text(json.dumps({**record, "text": SECRET}))
    (folder / "report").symlink_to(secret.parent)


WAYS: list[Callable[[dict[str, Any], Path, Path], None]] = [
    names_the_deck, names_the_deck_without_a_digest, names_a_table, climbs_to_a_table,
    links_a_table, links_a_picture, links_the_record, links_the_folder,
]  # fmt: skip


@pytest.mark.parametrize("way", WAYS)
def test_nothing_of_the_reader_is_shown(way, rocking, tmp_path):
    import base64

    secret = tmp_path / "home" / "secret.csv"
    secret.parent.mkdir()
    secret.write_text("time;CINETIQUE\n0;1\n1;31415926.5\n2;31415926.5\n")
    folder, records = tmp_path / "theirs", whole(rocking)
    folder.mkdir()
    way(records, folder, secret)
    if (folder / "report").exists():
        (folder / "summary.json").write_text(json.dumps(records["summary.json"]))
    else:
        put(folder, records, rocking)
    write_report(folder, "en")
    text = page(folder)
    assert "ZQX" not in text
    assert "31415926" not in text
    assert "3.14159" not in text
    assert base64.b64encode(secret.read_bytes()).decode()[:30] not in text


def test_a_deck_that_is_what_ran_is_shown(rocking, tmp_path):
    records = whole(rocking)
    del records[RECORD]
    put(tmp_path, records, rocking)
    assert "T2 = DYNAMIC T1 ;" in read_results(tmp_path).text
    deck = rocking.parent / "deck.ssi"
    before = deck.read_text()
    try:
        deck.write_text(before + "* later\n")
        assert read_results(tmp_path).text == ""
    finally:
        deck.write_text(before)


def test_a_series_reads_its_own_parts_alone(rocking, tmp_path):
    from ssilang.report.scenes import SceneError, packed_scene

    elsewhere = tmp_path / "home"
    elsewhere.mkdir()
    folder = tmp_path / "theirs"
    folder.mkdir()
    for path in rocking.glob("*.vtu"):
        (elsewhere / path.name).write_bytes(path.read_bytes())
        (folder / path.name).symlink_to(elsewhere / path.name)
    (series,) = rocking.glob("*.pvd")
    for start in ("", f"{elsewhere}/", "../home/"):
        text = series.read_text().replace('file="', f'file="{start}')
        (folder / series.name).write_text(text)
        with pytest.raises(SceneError):
            packed_scene(folder / series.name, 10**7)


def grid_of(numbers: int, *, last: int = 3) -> str:
    """A triangle whose points have so many zeros each, packed as `write_vtu` packs."""
    from ssilang.io.vtk.vtu import _packed

    arrays = [
        (f'Float64" Name="zeros" NumberOfComponents="{numbers}', bytes(24 * numbers)),
        ('Float64" NumberOfComponents="3', struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)),
        ('Int64" Name="connectivity', struct.pack("<3q", 0, 1, 2)),
        ('Int64" Name="offsets', struct.pack("<q", last)),
        ('UInt8" Name="types', b"\5"),
    ]
    made = [
        f'<DataArray type="{head}" format="binary">{_packed(raw, True)}</DataArray>'
        for head, raw in arrays
    ]
    return (
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"'
        ' header_type="UInt64" compressor="vtkZLibDataCompressor"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="3" NumberOfCells="1"><PointData>{made[0]}</PointData>'
        f"<Points>{made[1]}</Points><Cells>{''.join(made[2:])}</Cells></Piece>"
        "</UnstructuredGrid></VTKFile>"
    )


def listed(folder: Path, names: list[str]) -> Path:
    """A series of files at one instant."""
    entries = "".join(f'<DataSet timestep="0" file="{name}"/>' for name in names)
    text = f'<VTKFile type="Collection"><Collection>{entries}</Collection></VTKFile>'
    (folder / "a.pvd").write_text(text)
    return folder / "a.pvd"


@pytest.mark.skipif(not CAN_FORK, reason="nothing bounds VTK there")
@pytest.mark.parametrize(
    ("numbers", "last"), [(4_000_000, 3), (1, 2 * 10**10)], ids=["unpacks", "declares"]
)
def test_a_series_that_takes_all_memory_is_damaged(numbers, last, tmp_path, monkeypatch):
    monkeypatch.setattr(scenes, "_ROOM", 8 * 10**7)
    (tmp_path / "a.vtu").write_text(grid_of(1000))
    told, _ = scenes.guarded_scene(listed(tmp_path, ["a.vtu"]), 10**7)
    assert told["arrays"]["points"][1] == 9
    (tmp_path / "a.vtu").write_text(grid_of(numbers, last=last))
    with pytest.raises(scenes.SceneError) as problem:
        scenes.guarded_scene(tmp_path / "a.pvd", 10**7)
    assert problem.value.code == "report.series-damaged"


def test_a_part_of_a_series_is_read_once(tmp_path, monkeypatch):
    import pyvista

    read, count = pyvista.read, 0

    def counted(path: Path) -> Any:
        nonlocal count
        count += 1
        return read(path)

    monkeypatch.setattr(pyvista, "read", counted)
    (tmp_path / "a.vtu").write_text(grid_of(1))
    (tmp_path / "b.vtu").write_text(grid_of(1))
    names = ["a.vtu", "./a.vtu", "b.vtu"] * 300
    told, _ = scenes.packed_scene(listed(tmp_path, names), 10**7)
    assert told["arrays"]["points"][1] == 18
    assert count <= 4  # for the shape, and for its fields
    with pytest.raises(scenes.SceneError):
        scenes.packed_scene(listed(tmp_path, [f"{n}.vtu" for n in range(1001)]), 10**7)


def leaves(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Places of a record, not all rows of a list."""
    yield path
    if isinstance(value, dict):
        for name, each in value.items():
            yield from leaves(each, (*path, name))
    elif isinstance(value, list):
        for i in range(min(len(value), 2)):
            yield from leaves(value[i], (*path, i))


BAD: tuple[Any, ...] = (
    None, "x", -1, 1e300, True, [], {}, [[]], {"a": 1}, 10**400, math.nan, math.inf,
    "</script><script>alert(1)", "\x1b]0;a\x07", "{x}", "../../etc/passwd", "\0",
)  # fmt: skip


@pytest.mark.parametrize("name", ["summary.json", RECORD])
@pytest.mark.parametrize("kind", ["rocking", "verdict_run"])
def test_wrong_kinds_of_values_are_refused_or_shown(name, kind, tmp_path, request):
    """Each place of a record, a few values each: a refusal or a page, and no other error."""
    from ssilang.io.errors import InputError

    source: Path = request.getfixturevalue(kind)
    records = whole(source)
    for calculation in records[RECORD]["calculations"]:
        calculation["scene"] = None  # a second each
    choose = random.Random(name + kind)
    refused = shown = 0
    places = list(leaves(records[name]))[1:]
    for place in choose.sample(places, min(len(places), 50)):
        for bad in choose.sample(BAD, 2):
            changed = copy.deepcopy(records)
            holder = changed[name]
            for step in place[:-1]:
                holder = holder[step]
            holder[place[-1]] = bad
            put(tmp_path, changed, source)
            try:
                results = read_results(tmp_path)
            except InputError as problem:
                refused += problem.code in ("report.not-a-summary", "report.damaged")
                continue
            text = page_of(results, "en", lambda text: [])
            assert "<script>alert" not in text
            assert "\x1b" not in text
            refused += any("contents.json" in n for n in results.unread)
            shown += 1
    assert refused > 20
    assert shown > 5


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"version": 1}', "version: 1 != text"),
        ("[" * 100_000, "brackets"),
        ('{"version": "1", "deck": "a", "seconds": NaN}', "seconds: None != a number"),
        ('{"version": "1", "deck": "a"}', "seconds = ?"),
        ("\xff", "cannot be read"),
    ],
)
def test_a_damaged_summary_is_told_by_its_place(text, said, tmp_path, capsys):
    (tmp_path / "summary.json").write_bytes(text.encode("latin-1"))
    assert main(["report", str(tmp_path)]) == 2
    assert said in capsys.readouterr().err


def test_a_record_that_is_no_record_says_where(rocking, tmp_path):
    records = whole(rocking)
    records[RECORD]["calculations"][0]["table"] = 3
    write_report(put(tmp_path, records, rocking), "en")
    assert "calculations[0].table: 3 != text" in Sections(page(tmp_path)).text["header"]


@pytest.mark.parametrize("half", ["\ud800", "a\udfff"])
def test_half_a_character_is_refused(half, rocking, tmp_path):
    records = whole(rocking)
    records[RECORD]["calculations"][0]["title"] = "a whole one: \U0001f3d7"
    folder = put(tmp_path / "results", records, rocking)
    assert main(["report", str(folder)]) == 0
    told = "Damaged, not shown: report/contents.json"
    assert told not in Sections(page(folder)).text["header"]
    records[RECORD]["text"] = half
    put(folder, records, rocking)
    assert main(["report", str(folder)]) == 0
    assert told in Sections(page(folder)).text["header"]


def test_cells_without_an_end_are_no_table(rocking, tmp_path):
    put(tmp_path, whole(rocking), rocking)
    (tmp_path / "top.csv").write_text('a;b\n1;"' + "2" * 200_000)
    assert read_results(tmp_path).tables == {}
    (tmp_path / "up.csv").write_text("a;b\n1;2\n3;4")
    (found,) = tables_of([tmp_path / n for n in ("top.csv", "top.txt", "up.csv")], []).values()
    assert {name: column.tolist() for name, column in found.items()} == {"a": [1, 3], "b": [2, 4]}


def test_tables_of_columns_are_read_and_damaged_ones_named(tmp_path):
    pa, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    given = {
        "x": {"t": [1, 2], "b": [0.5, -3.5]},
        "v": {"t": [1, 2]},
        "y": {"t": [1], "b": [2.5]},
        "z": {"t": [1, 2], "b": ["c", "d"]},
    }
    for name, columns in given.items():
        parquet.write_table(pa.table(columns), tmp_path / f"{name}.parquet")
    (tmp_path / "cut.parquet").write_bytes((tmp_path / "x.parquet").read_bytes()[:-9])
    paths, unread = [tmp_path / f"{n}.parquet" for n in ("v", "y", "z", "cut", "gone", "x")], []
    found = tables_of(paths, unread)
    assert unread == ["cut.parquet", "gone.parquet"]
    shown = {n: {k: v.tolist() for k, v in columns.items()} for n, columns in found.items()}
    assert shown == {"x.parquet": given["x"]}
    assert [*shown["x.parquet"]] == ["t", "b"]


@together("name", ["../a", "/etc/passwd", "//host/a", "\\\\host\\a", "a\0", "b", "c"])
def test_what_stands_elsewhere_is_not_inside(name, tmp_path):
    folder = tmp_path / "in"
    (folder / "d").mkdir(parents=True)
    (tmp_path / "a").write_text("x")
    (folder / "b").symlink_to(tmp_path / "a")
    (folder / "c").symlink_to("c")
    (folder / "d" / "e").write_text("x")
    (folder / "f").symlink_to("d/e")
    assert inside(folder, name) is None
    assert inside(folder, "d/e") is not None
    assert inside(folder, "f") is not None

"""What a run with --report leaves and what its page holds; folders that hold no run."""

import json
import re
import warnings
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyvista
from refusing import refusal
from together import together

from ssilang.cli.main import main
from ssilang.cli.run import RunOptions, run_file, run_text, write_report
from ssilang.report.html import asset
from ssilang.report.results import read_results
from ssilang.report.scenes import LARGEST, SceneError, packed_scene

STRIP = Path(__file__).parents[2] / "cases" / "footing" / "strip_uplift.ssi"
WIDTH, MODULUS, FORCE = 4.0, 2e7, 6e5


def page(folder: Path) -> str:
    return (folder / "report.html").read_text(encoding="utf-8")


def data(text: str, name: str) -> Any:
    """What the page's script reads."""
    found = re.search(rf'<script type="application/json" id="data-{name}">(.*?)</script>', text)
    assert found is not None
    return json.loads(found[1])


class Sections(HTMLParser):
    """Text of the page by section; scripts and styles are no text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.text: dict[str, str] = {}
        self.addresses: list[str] = []
        self._now, self._skip = "", False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        told = dict(attrs)
        self.addresses += [v or "" for k, v in attrs if k in ("src", "href")]
        if tag in ("section", "header"):
            self._now = told.get("id") or tag
        self._skip = tag in ("script", "style")

    def handle_endtag(self, tag: str) -> None:
        self._skip = False

    def handle_data(self, data: str) -> None:
        if not self._skip:
            self.text[self._now] = self.text.get(self._now, "") + data


def test_a_rigid_strip_in_time_against_closed_forms(tmp_path):
    """M/M_u = 3 - 2 sqrt(theta_u/theta), contact B sqrt(theta_u/theta), toe 2 N/contact."""
    run_file(STRIP, RunOptions(output_directory=tmp_path, summary=True, report=True))
    (calculation,) = read_results(tmp_path).calculations
    found = {name: values[1:] for name, values in calculation.columns.items()}
    turn = found["rotation_z_1"] * MODULUS * WIDTH**2 / (2.0 * FORCE)  # over theta_u
    # the deck turns the footing by 0.25 to 10 theta_u
    assert turn[[0, -1]] == pytest.approx([0.25, 10.0], rel=1e-9)
    contact = np.minimum(turn**-0.5, 1.0)
    moment = np.where(turn <= 1.0, turn, 3.0 - 2.0 * contact)
    toe = np.where(turn <= 1.0, (1.0 + turn) / 2.0, 1.0 / contact) * 2.0 * FORCE / WIDTH
    # two Gauss points see the contact's end to a fraction of one of 16 elements
    np.testing.assert_allclose(found["share_1"], contact, atol=3e-4)
    np.testing.assert_allclose(found["moment_z_1"], moment * FORCE * WIDTH / 6.0, rtol=2e-3)
    np.testing.assert_allclose(found["pressure_1"], toe, rtol=2e-3)
    np.testing.assert_allclose(found["force_1"], FORCE, rtol=1e-9)


def test_the_page_shows_what_ran(rocking):
    text = page(rocking)
    seen = Sections(text).text
    assert "deck.ssi" in seen["header"]
    assert "1 / 2" in seen["header"]
    assert "steps <b>kept</b>" in seen["checks"]  # a name is text, whatever it looks like
    assert "missed" in seen["checks"]
    assert "opening of joints" in seen["largest"]
    assert "T2 = DYNAMIC T1 ;" in seen["deck"]
    titles = [c["title"] for c in data(text, "charts")]
    wanted = ("share in contact", "toe pressure (largest)", "moment against rotation", "energies")
    assert set(wanted) <= set(titles)
    assert "drift of the top" in titles
    assert any(t.startswith("top.csv: DEPL") for t in titles)
    read = re.findall(r"\bwords\.(\w+)", asset("charts.js") + asset("scene.js"))
    assert {"play", "zoomIn"} <= {*read} <= data(text, "words").keys()


def test_the_page_asks_for_nothing_elsewhere(rocking):
    found = Sections(page(rocking))
    assert [a for a in found.addresses if not a.startswith(("data:", "#"))] == []
    assert "@import" not in page(rocking).split("</style>")[0]


def test_the_histories_agree_with_what_the_run_told(rocking):
    (calculation,) = read_results(rocking).calculations
    peaks = {x["kind"]: x["value"] for x in calculation.largest if not x["component"]}
    # 200 steps are all kept; the ends of cells open further than their points
    opening = calculation.columns["opening_1"].max()
    assert peaks["OUVERTURE"] <= opening < 1.3 * peaks["OUVERTURE"]
    assert calculation.columns["share_1"].min() < 0.5
    energies = calculation.columns
    total = sum(energies[n] for n in ("CINETIQUE", "ELASTIQUE", "JOINTS", "DISSIPEE", "AMORTIE"))
    left = total - energies["EXTERIEURE"]
    np.testing.assert_allclose(left - left[0], energies["ECART"], atol=1e-4)
    assert len(calculation.columns["time"]) == 201


def test_a_scene_keeps_displacements_to_sixteen_bits(rocking):
    import base64
    import zlib

    series = rocking / "report" / "scene_1.vtkhdf"
    told, text = packed_scene(series, 10**7)
    blob = zlib.decompress(base64.b64decode(text))

    def array(name: str, kind: str) -> Any:
        at, size = told["arrays"][name]
        return np.frombuffer(blob, kind, size, at)

    points = array("points", "<f4").reshape(-1, 3)
    field = next(f for f in told["fields"] if f["name"] == "displacement")
    frames = array("field:displacement", "<i2").reshape(len(told["times"]), -1)
    moved = np.cumsum(frames, axis=0, dtype=np.int16) * field["scale"]
    top = np.argmax(points[:, 1])
    found = read_results(rocking).tables["top.csv"]  # every fourth step, its own way to a file
    drift = next(v for k, v in found.items() if k.startswith("DEPL_UX"))
    here = np.interp(found["TEMP"], told["times"], moved[:, 3 * top])
    kept = np.isin(np.round(found["TEMP"], 9), np.round(told["times"], 9))
    assert kept.sum() > 5
    np.testing.assert_allclose(here[kept], drift[kept], atol=field["high"] / LARGEST)


def test_instants_that_are_damaged_or_have_another_mesh_are_left_out(
    rocking, tmp_path, capfd, monkeypatch
):
    for path in (*rocking.glob("*.vtu"), *rocking.glob("*.pvd")):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    files = sorted(tmp_path.glob("*.vtu"))
    whole, _ = packed_scene(next(tmp_path.glob("*.pvd")), 10**7)
    assert len(whole["times"]) == len(files) == 6
    files[0].write_bytes(files[0].read_bytes()[:500])
    short = pyvista.read(files[2])
    short.extract_cells(range(20)).save(files[2])
    with warnings.catch_warnings(action="error"):  # pyvista shows none of its own
        found, _ = packed_scene(next(tmp_path.glob("*.pvd")), 10**7)
    assert found["times"] == [t for i, t in enumerate(whole["times"]) if i not in (0, 2)]
    assert found["left_out"] == 2
    (series,) = tmp_path.glob("*.pvd")
    series.with_name("z.pvd").write_bytes(series.read_bytes())
    monkeypatch.setattr("ssilang.report.page.MOST_SCENES", 1)
    with warnings.catch_warnings(action="error"):
        write_report(tmp_path, "en")
    assert len(data(page(tmp_path), "scenes")) == 1
    said = Sections(page(tmp_path)).text["scene"]
    assert f"{series.name}: 2 instants are damaged or have another mesh, and left out" in said
    assert "1 further scene left out" in said
    assert capfd.readouterr().err == ""


def listed(*parts: str) -> str:
    return f"<VTKFile type='Collection'><Collection>{''.join(parts)}</Collection></VTKFile>"


@together("name, content, code", [
    *(("a.vtkhdf", part, "series-damaged") for part in (0.02, 0.4, 0.9, 0.999)),
    ("a.pvd", "<VTKFile", "series-damaged"), ("a.pvd", listed(), "nothing-to-see"),
    ("a.pvd", listed("<DataSet timestep='nan' file='a.vtu'/>"), "series-damaged"),
    ("a.pvd", listed("<DataSet timestep='1' file='a.vtu'/>"), "nothing-to-see"),
    ("b.pvd", listed(), "series-gone"),
])  # fmt: skip
def test_half_a_series_or_none_is_told(rocking, tmp_path, name, content, code):
    pyvista.UnstructuredGrid().save(tmp_path / "a.vtu")
    data = (rocking / "report" / "scene_1.vtkhdf").read_bytes()
    cut = content.encode() if isinstance(content, str) else data[: int(content * len(data))]
    (tmp_path / name.replace("b", "a")).write_bytes(cut)
    with refusal(SceneError, f"report.{code}"):
        packed_scene(tmp_path / name, 10**7)


def test_joints_in_a_part_of_their_own_are_found(tmp_path):
    """A table in MAILLAGE_VTK: the parts are blocks, and only one has openings."""
    from tests.report.conftest import ROCKING

    parts = ROCKING.replace(
        "'MAILLAGE_VTK' = (T . 'TOTAL') ET (T . 'JOINT') ;",
        "'MAILLAGE_VTK' = TABL ; T1 . 'MAILLAGE_VTK' . 'A' = T . 'TOTAL' ; "
        "T1 . 'MAILLAGE_VTK' . 'J' = T . 'JOINT' ; T1 . 'FORMAT_VTK' = 'VTKHDF' ;",
    )
    run_text(parts, tmp_path)
    told, _ = packed_scene(tmp_path / "dynamic.vtkhdf", 10**7)
    opening = next(f for f in told["fields"] if f["name"] == "opening")
    assert opening["high"] > 1e-3
    assert told["arrays"]["joint_lines"][1] == 2 * 4  # four cells under the footing


def test_a_scene_fits_into_few_bytes(rocking):
    series = rocking / "report" / "scene_1.vtkhdf"
    whole, text = packed_scene(series, 10**7)
    few, short = packed_scene(series, len(text) // 2)
    assert len(short) <= len(text) // 2
    assert 1 < len(few["times"]) < len(whole["times"])
    assert few["times"][0] == whole["times"][0]
    assert few["times"][-1] == whole["times"][-1]


def test_modes_are_a_scene(modes):
    (scene,) = data(page(modes), "scenes")
    assert scene["kind"] == "modes"
    assert not scene["flat"]
    # a cantilever of 6 m with a square section: both bending modes are one frequency
    assert len(scene["frequencies"]) == 3
    assert scene["frequencies"][0] == pytest.approx(scene["frequencies"][1], rel=1e-6)


def test_a_report_is_made_again_in_french(rocking, tmp_path, capsys):
    before = page(rocking)
    try:
        assert main(["report", str(rocking), "--lang", "fr"]) == 0
        assert capsys.readouterr().out.startswith("rapport : ")
        text = page(rocking)
    finally:
        (rocking / "report.html").write_text(before, encoding="utf-8")
    assert '<html lang="fr">' in text
    assert "plus grande ouverture" in Sections(text).text["header"]
    assert "moment en fonction de la rotation" in [c["title"] for c in data(text, "charts")]
    english, french = data(before, "charts"), data(text, "charts")
    assert [c["lines"][0]["y"] for c in english] == [c["lines"][0]["y"] for c in french]


def test_a_run_that_failed_says_so_at_the_top(tmp_path):
    (tmp_path / "deck.ssi").write_text("X = 1 ;\nMESS 'a' ;\nY = X / 0 ;\n")
    options = RunOptions(output_directory=tmp_path / "out", summary=True, report=True)
    assert run_file(tmp_path / "deck.ssi", options).exit_code == 1
    seen = Sections(page(tmp_path / "out")).text
    assert "the run failed (exit code 1)" in seen["header"]
    assert "line 3:" in seen["header"]
    assert '<li id="line-3" class=wrong>' in page(tmp_path / "out")


def test_a_run_without_the_option_has_its_series_and_tables(rocking, tmp_path):
    summary = json.loads((rocking / "summary.json").read_text())
    kept = [f for f in summary["files"] if not f["path"].startswith("report/")]
    (tmp_path / "summary.json").write_text(json.dumps({**summary, "files": kept}))
    for name in [f["path"] for f in kept]:
        (tmp_path / name).write_bytes((rocking / name).read_bytes())
    write_report(tmp_path, "en")
    text = page(tmp_path)
    assert "made without --report" in Sections(text).text["header"]
    (scene,) = data(text, "scenes")
    assert {"displacement", "opening", "pressure"} <= {f["name"] for f in scene["fields"]}
    assert next(c["title"] for c in data(text, "charts")).startswith("top.csv")
    assert "T2 = DYNAMIC T1 ;" in Sections(text).text["deck"]  # from the deck's own file


def test_half_written_files_are_named_and_the_rest_is_shown(rocking, tmp_path):
    """A run that was killed: no summary, half a table, half a series."""
    (tmp_path / "report").mkdir()
    for path in (rocking / "report").iterdir():
        (tmp_path / "report" / path.name).write_bytes(path.read_bytes())
    scene = tmp_path / "report" / "scene_1.vtkhdf"
    scene.write_bytes(scene.read_bytes()[:1000])
    table = tmp_path / "report" / "calculation_1.csv"
    table.write_text(table.read_text()[:-20])
    write_report(tmp_path, "en")
    text = page(tmp_path)
    assert "has not come to its end" in Sections(text).text["header"]
    assert "scene_1.vtkhdf is damaged" in Sections(text).text["scene"]
    share = next(c for c in data(text, "charts") if c["title"] == "share in contact")
    assert len(share["lines"][0]["x"]) == 200  # the last line is cut


def test_axes_have_the_units_of_the_deck(rocking, tmp_path):
    summary = json.loads((rocking / "summary.json").read_text())
    summary["units"] = {"system": "KN-M", "length": "m", "force": "kN"}
    (tmp_path / "summary.json").write_text(json.dumps(summary))
    (tmp_path / "report").mkdir()
    for name in ("contents.json", "calculation_1.csv"):
        (tmp_path / "report" / name).write_bytes((rocking / "report" / name).read_bytes())
    write_report(tmp_path, "en")
    axes = {c["title"]: (c["x"], c["y"]) for c in data(page(tmp_path), "charts")}
    assert axes["toe pressure (largest)"] == ("time (s)", "toe pressure (largest) (kPa)")
    assert axes["moment against rotation"] == ("rotation (rad)", "moment (kN.m)")
    assert axes["energies"] == ("time (s)", "energy (kJ)")
    assert "units KN-M: m, kN" in Sections(page(tmp_path)).text["header"]
    assert "scene_1.vtkhdf is gone" in Sections(page(tmp_path)).text["scene"]


def test_a_damaged_record_is_named(rocking, tmp_path):
    (tmp_path / "report").mkdir()
    (tmp_path / "summary.json").write_bytes((rocking / "summary.json").read_bytes())
    for text in ("{", "[]", '{"calculations": [3]}', '{"calculations": []}'):
        (tmp_path / "report" / "contents.json").write_text(text)
        write_report(tmp_path, "en")
        assert "Damaged, not shown: report/contents.json" in Sections(page(tmp_path)).text["header"]


def test_footings_that_nobody_follows_are_counted(rocking, tmp_path, monkeypatch):
    assert "smaller footing" not in Sections(page(rocking)).text["header"]
    monkeypatch.setattr("ssilang.kernel.stepping.node_histories.MOST", 0)
    options = RunOptions(output_directory=tmp_path / "out", summary=True, report=True)
    run_file(rocking.parent / "deck.ssi", options)
    assert "Left out: 1 smaller footing." in Sections(page(tmp_path / "out")).text["header"]


@pytest.mark.parametrize(
    ("files", "said"),
    [
        (None, "is not a folder"),
        ({}, "holds no results of a run"),
        ({"a.txt": "no"}, "holds no results of a run"),
        ({"summary.json": "{"}, "cannot be read"),
        ({"summary.json": "[1]"}, "is not the summary of a run"),
        ({"summary.json": '{"version": "0.1", "files": 3}'}, "is not the summary of a run"),
    ],
)
def test_folders_without_a_run_are_refused(files, said, tmp_path, capsys):
    folder = tmp_path / "results"
    for name, text in (files or {}).items():
        folder.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    if files == {}:
        folder.mkdir()
    assert main(["report", str(folder)]) == 2
    assert said in capsys.readouterr().err
    assert not (folder / "report.html").exists()

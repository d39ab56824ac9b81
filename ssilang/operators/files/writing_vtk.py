"""SORT 'VTK ': meshes and fields to .vtu files and the .pvd that lists them."""

from pathlib import Path

from ssilang.io.run_output import RunOutput
from ssilang.io.vtk.labels import Labels, labels_of
from ssilang.io.vtk.series import Part, Series, SeriesWriter, strip_extension
from ssilang.io.vtk.vtu import Encoding
from ssilang.kernel.mesh.changes.local_refinement import parted
from ssilang.operators.files.outputs import run_output
from ssilang.operators.files.writing import SORT, target_path
from ssilang.operators.prelude import *
from ssilang.operators.workspace import units_in_si

_ENCODINGS = ("FORM", "BINA", "ZIP")
_LISTS = ("AUTO", "NOUV", "SUIT", "NPVD")
_FORMATS = ("VTU", "VTKHDF")
_WORDS = (*_ENCODINGS, *_LISTS, *_FORMATS, "TEMP", "DOUBLE_PRECISION")
_OF_FILES = ("FORM", "BINA", "SUIT", "NPVD")  # words that say nothing of one file for all
_OBJECTS = ("MAILLAGE", "CHPOINT", "MCHAML", "TABLE")


@dataclass
class _Said:
    """What a SORT 'VTK ' statement holds: objects by name, and its options."""

    meshes: dict[str, Mesh] = field(default_factory=dict)
    points: dict[str, NodeField] = field(default_factory=dict)
    cells: dict[str, CellField] = field(default_factory=dict)
    encoding: Encoding = Encoding.ZIP
    listing: str = "AUTO"
    format: str = ""
    of_files: str = ""
    time: float | None = None
    constants: dict[str, float] = field(default_factory=dict)

    def add(self, value: Any, name: str) -> None:
        """Add an object under its name, or under a usual one."""
        if isinstance(value, Mesh):
            self.meshes[name or f"{len(self.meshes) + 1:04d}"] = parted(value)[0]
        elif isinstance(value, NodeField):
            self.points[name or f"CHPO{len(self.points) + 1}"] = value
        elif isinstance(value, CellField):
            self.cells[name or f"CHEL{len(self.cells) + 1}"] = value


_TIME = arg("t", "FLOTTANT", en="time", unit="s", range=ANY_NUMBER)


@SORT.form(
    said("VTK"),
    many(
        "objects", *_OBJECTS, "MOT", en="meshes, fields and tables of them, each with a name or not"
    ),
    choice("encoding", _ENCODINGS, default="ZIP", en="as text, binary or packed"),
    choice(
        "listing", _LISTS, default="AUTO", en="the series goes on, begins anew, or is not listed"
    ),
    choice(
        "format",
        _FORMATS,
        en="files by instant and mesh with a list, or one file for all (VTU if nothing is said)",
    ),
    key("time", "TEMP", _TIME, en="time, in s"),
    flag("double", "DOUBLE_PRECISION", en="changes nothing"),
    gives=(),
    by_hand="a word right behind an object is its name, unless it says an option",
)
def _vtk(call: Call, word: str) -> None:
    said = _read(call)
    if not said.meshes:
        raise call.missing(("MAILLAGE",))
    path = strip_extension(target_path(call))
    output = run_output(call.session)
    begun = output.series.get(path)
    one_file = said.format == "VTKHDF" or (not said.format and begun is not None and begun.one_file)
    if one_file and said.of_files:
        raise call.error("operators.files.not-of-one-file", said.of_files, word=said.of_files)
    # The parts of a step; cells keep their names of the step before where the mesh is the same.
    meshes = said.meshes
    if one_file and len(meshes) == 1:
        meshes = {"": next(iter(meshes.values()))}
    before = {} if begun is None else begun.labels
    known = {n: before[n][1] for n, m in meshes.items() if n in before and before[n][0] is m}
    labels = known if len(known) == len(meshes) else cell_labels(call.session, meshes)
    parts = {name: _part(mesh, said, labels[name]) for name, mesh in meshes.items()}
    if one_file:
        writer: Series = _one_file(output, path, said, tuple(parts))
    elif said.time is None and len(parts) == 1:
        (part,) = parts.values()
        listed = said.listing != "NPVD"
        single = SeriesWriter(path, said.encoding, listed=listed, constants=said.constants)
        single.write_single(part)
        output.wrote(*single.files)
        output.series.pop(path, None)
        return
    else:
        writer = _files(output, path, said, tuple(parts))
    writer.write_parts(said.time or 0.0, parts)
    output.wrote(*writer.files)


def _one_file(output: RunOutput, path: Path, said: _Said, parts: tuple[str, ...]) -> Series:
    """The .vtkhdf to which the step is added."""
    begun = output.series.get(path)
    goes_on = begun is not None and begun.one_file and said.listing != "NOUV"
    if begun is not None and goes_on and begun.accepts(said.time or 0.0, parts):
        return begun
    return output.begin_series(path, said.constants, one_file=True)


def _files(output: RunOutput, path: Path, said: _Said, parts: tuple[str, ...]) -> Series:
    """The series of .vtu files to which the step is added."""
    begun, time = output.series.get(path), said.time or 0.0
    anew = begun is None or begun.one_file or said.listing == "NOUV"
    if begun is None or anew or (said.listing == "AUTO" and not begun.accepts(time, parts)):
        begun = SeriesWriter(
            path, said.encoding, resume=said.listing == "SUIT", listed=said.listing != "NPVD",
            constants=said.constants,
        )  # fmt: skip
    output.keep_series(begun)
    return begun


def _read(call: Call) -> _Said:
    said = _Said(constants=units_in_si(call.session))
    while True:
        # a word behind an object is looked at as its name first
        first = call.operands[0].value if call.operands else None
        word = call.keyword(_WORDS) if isinstance(first, str) else None
        if word in _OF_FILES:
            said.of_files = str(word)
        if word in _FORMATS:
            said.format = str(word)
        elif word in _ENCODINGS:
            said.encoding = Encoding(word)
        elif word in _LISTS:
            said.listing = str(word)
        elif word == "TEMP":
            said.time = float(call.given(_TIME, call.keyword_end))
        if word is not None:
            continue
        operand = call.read(*_OBJECTS)
        if operand is None:
            return said
        if isinstance(operand.value, Table):
            for index, value in operand.value.items():
                said.add(value, _index_name(index))
        else:
            usual = "" if isinstance(operand.value, Mesh) else operand.name
            said.add(operand.value, _given_name(call) or usual)


def _given_name(call: Call) -> str:
    """The word right behind the object just read, unless it is an option."""
    if not call.operands or not isinstance(call.operands[0].value, str):
        return ""
    text = str(call.operands[0].value).strip()
    known = any(text.upper()[:4] == w[:4] for w in _WORDS)
    behind = call.operands[1].value if len(call.operands) > 1 else None
    is_time = isinstance(behind, int | float) and not isinstance(behind, bool)
    # a field may well be called TEMP: it is the option only before a number
    if known and (text.upper()[:4] != "TEMP" or is_time):
        return ""
    call.used.append(call.operands.pop(0))
    return text


def _index_name(index: object) -> str:
    if isinstance(index, float):
        return f"{index:g}"
    return str(index).strip() if isinstance(index, str | int) else ""


def _part(mesh: Mesh, said: _Said, labels: Labels) -> Part:
    """The mesh with the fields that have values on it."""
    ids = mesh.sorted_node_ids
    points = {n: f for n, f in said.points.items() if np.isin(f.node_ids, ids).any()}
    return Part(mesh, points, said.cells, labels)


# What a script calls the cells that go to a VTK file: meshes and models by their names.

_PARTS = (Mesh, Model, Point, str)


def cell_labels(session: Session, parts: Mapping[str, Mesh]) -> dict[str, Labels]:
    """Labels of the cells of named parts.

    `group` is the smallest mesh with a name in the script that has the cell, `material` the
    smallest such model, `part` which of several parts.
    """
    groups: dict[str, tuple[CellBlock, ...]] = {}
    materials: dict[str, tuple[CellBlock, ...]] = {}
    for name, value in _named(session):
        if isinstance(value, Mesh):
            groups.setdefault(name, value.blocks)
        elif isinstance(value, Model):
            materials.setdefault(name, tuple(zone.cells for zone in value.zones))
    told = {"group": groups, "material": materials}
    return {
        name: labels_of(mesh, told, (i, name) if len(parts) > 1 else None)
        for i, (name, mesh) in enumerate(parts.items(), start=1)
    }


def _named(session: Session) -> Iterator[tuple[str, Any]]:
    """Objects by their names, then those of tables by theirs."""
    found = session.frame.named()
    yield from found.items()
    for value in found.values():
        # those that are made as they are asked for hold none, nor do those of other entries
        if type(value) is Table and all(isinstance(v, _PARTS) for _, v in value.items()):
            for index, held in value.items():
                if isinstance(index, str):
                    yield index.strip(), held

"""SAUV and REST: objects kept in a file between two runs."""

from contextlib import closing

# families of elements that restored models may have
import ssilang.kernel.elements.springs
import ssilang.kernel.interface.family
import ssilang.kernel.modal.shape_models  # noqa: F401
from ssilang.io.archive import Archive, Decoder, Encoder, Record, read_archive, write_archive
from ssilang.io.archive.classes import Packing, register_packing
from ssilang.language.run.scopes import PREDEFINED, Frame
from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.parser import parse_statements
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import Definition, Script, print_items
from ssilang.language.values import Objet, Solution, Texte
from ssilang.operators.files.outputs import input_path, option_name, output_path, run_output
from ssilang.operators.prelude import *
from ssilang.operators.session.configurations import Configuration

# ---- how objects of the language are taken apart


def _list_packing(cls: type) -> Packing:
    def fill(made: Any, values: Any) -> None:
        made.values = cls(values).values
        flat = not isinstance(made.values, np.ndarray) or made.values.ndim == 1
        if not flat or not all(isinstance(v, _HELD.get(cls, object)) for v in made.values):
            raise TypeError(cls.__name__)

    return Packing(lambda v: v.values, lambda _: cls(), fill, mutable=True)


_HELD: dict[type, type] = {ListChpo: NodeField}


def _fill_table(made: Table, pairs: Any) -> None:
    for index, value in pairs:
        made.set(index, value)


def _fill_objet(made: Objet, parts: Any) -> None:
    made.class_name, attributes, methods = parts
    if not isinstance(made.class_name, str):
        raise TypeError("class_name")
    made.attributes.update(attributes)
    made.methods.update(methods)


def _source_of(value: Procedure) -> list[str]:
    span = value.definition.span
    return [value.name, span.source.code[span.start : span.end], value.origin]


def _procedure(parts: Any) -> Procedure:
    name, text, origin = parts
    if not all(isinstance(part, str) for part in parts):
        raise TypeError("Procedure")
    body = _parsed(Source(f"saved {name}", text.rstrip().rstrip(";") + ";")).body
    if len(body) == 1 and isinstance(body[0], Definition):
        return Procedure(name, body[0], origin)
    whole = _parsed(Source(f"saved {name}", text))
    return Procedure(name, Definition(name, (), whole.body, (), False, whole.span), origin)


def _configuration(coordinates: Any) -> Configuration:
    if coordinates.ndim != 2 or coordinates.shape[1] != 3 or coordinates.dtype.kind != "f":
        raise ValueError("Configuration")
    return Configuration(coordinates)


def _parsed(source: Source) -> Script:
    try:
        return parse(source)
    except (SsiError, SeveralErrors) as error:
        raise ValueError(source.name) from error


def _texte(text: str) -> Texte:
    # behind a blank: a sign * in the first column would begin a comment
    try:
        statements = parse_statements(Source("saved text", f" {text};")) if text.strip() else []
    except (SsiError, SeveralErrors) as error:
        raise ValueError("text") from error
    return Texte(tuple(item for s in statements for item in s.items))


_SOLUTION = Packing(lambda s: list(s.modes), lambda modes: Solution(tuple(modes)))
for _cls in (ListReel, ListEnti, ListMots, ListChpo, ListObje):
    register_packing(_cls, _cls.__name__, _list_packing(_cls))
register_packing(Mot, "Mot", Packing(str, Mot))
register_packing(Configuration, "Configuration", Packing(lambda c: c.coordinates, _configuration))
register_packing(Annule, "Annule", Packing(lambda _: None, lambda _: Annule()))
register_packing(Solution, "Solution", _SOLUTION)
register_packing(Texte, "Texte", Packing(lambda v: print_items(v.items), _texte))
register_packing(Procedure, "Procedure", Packing(_source_of, _procedure))
_TABLE = Packing(
    lambda t: [list(p) for p in t.items()], lambda _: Table(), _fill_table, mutable=True
)
for _table in (Table, LazyTable, LazyRows):  # what is made later is made to be saved
    register_packing(_table, "Table", _TABLE)
_OBJET = Packing(
    lambda o: [o.class_name, o.attributes, o.methods], lambda _: Objet(), _fill_objet, mutable=True
)
register_packing(Objet, "Objet", _OBJET)


# ---- SAUV


@dataclass
class _Begun:
    """The file that SAUV is writing since OPTI named it."""

    encoder: Encoder = field(default_factory=Encoder)
    records: list[Record] = field(default_factory=list)


_WORDS = (
    flag("formatted", "FORMAT", en="changes nothing"),
    key("label", "LABEL", "MOT", default="", en="label of the record"),
    flag("silent", "MUET", en="changes nothing"),
)


@operator(
    "SAUV",
    *_WORDS,
    many("objects", "*", "TEXTE", whole=True, en="objects, all that have a name by default"),
    family="files",
    full_name="SAUVER",
)
def sauv(
    call: Call, formatted: bool, label: str, silent: bool, objects: tuple[Operand, ...]
) -> None:
    """Add a record to the file and write it."""
    frame = call.session.frame
    operands = [(o.name, o.value) for o in objects]
    for name, value in operands:
        if not name and isinstance(value, str) and frame.find(value.upper()) is None:
            raise call.error("operators.files.no-object-to-save", value, value=value)
    if not operands:
        operands = [(n, frame.find(n)) for n in sorted(_own_names(frame))]
    save(call, operands, str(label).strip())


def save(call: Call, operands: list[tuple[str, Any]], label: str = "") -> None:
    """Add objects with their names to the file that OPTI SAUV names, and write it."""
    frame = call.session.frame
    output = run_output(call.session)
    begun = output.opened.setdefault("SAUV", _Begun())
    assert isinstance(begun, _Begun)
    record = _record(begun, frame, workspace(call.session).nodes, operands, label)
    path = output_path(call, option_name(call.session, "SAUV", 8))
    settings = {word: of(workspace(call.session)) for word, of in _SETTINGS.items()}
    write_archive(
        path, begun.encoder.objects, begun.encoder.arrays, [*begun.records, record], settings
    )
    begun.records.append(record)
    output.wrote(path)


def _own_names(frame: Frame) -> set[str]:
    """Names that the script has given; those that every session has and loops' counters not."""
    given = {n for n in frame.names() if n[0] != "&"}
    return {n for n in given if n not in PREDEFINED or frame.find(n) is not PREDEFINED[n]}


def _record(
    begun: _Begun, frame: Frame, table: NodeTable, operands: list[tuple[str, Any]], label: str
) -> Record:
    """Codes of the operands, and of every named object that they hold."""
    encoder = begun.encoder
    before = encoder.held()
    encoder.begin_record()
    codes = [(name, encoder.encode(value)) for name, value in operands]
    reached = encoder.held() - before
    stood_on = np.flatnonzero(encoder.nodes(reached, len(table)))
    nodes = set(table.resolve(stood_on).tolist())
    record = Record(label, {name: code for name, code in codes if name})
    for name in sorted(_own_names(frame)):
        value = frame.find(name)
        if name not in record.names and _is_reached(value, reached, nodes):
            record.names[name] = encoder.encode(value)
    return record


def _is_reached(value: Any, reached: set[int], nodes: set[int]) -> bool:
    """Whether an object, or all that it consists of (blocks of a mesh, zones of a model), is in."""
    if id(value) in reached or (isinstance(value, Point) and value.node in nodes):
        return True
    parts = getattr(value, "blocks", None) or getattr(value, "zones", None) or ()
    return bool(parts) and all(id(part) in reached for part in parts)


_SETTINGS: dict[str, Callable[[Workspace], Any]] = {
    "DIME": lambda ws: ws.dimension,
    "MODE": lambda ws: ws.mode.name,
    "ELEM": lambda ws: ws.element,
    "TITR": lambda ws: ws.title,
    "INCO": lambda ws: ws.options.get("INCO", {}),
    "UNIT": lambda ws: str(ws.options.get("UNIT", "")),
}
"""Settings that a file keeps."""


# ---- REST


@operator("REST", *_WORDS, gives=ANY, family="files", full_name="RESTITUER")
def rest(call: Call, formatted: bool, label: str, silent: bool) -> None:
    """Read a file's records into names."""
    name = option_name(call.session, "REST", 2)
    with closing(read_archive(input_path(call, name))) as archive:
        _restore(call, archive, name, str(label).strip())


def _restore(call: Call, archive: Archive, name: str, label: str) -> None:
    ws = workspace(call.session)
    labels = [r.label for r in archive.records]
    if label and label not in labels:
        known = ", ".join(x for x in labels if x) or "none"
        raise InputError("operators.files.no-such-label", name=name, label=label, known=known)
    check_settings(archive, name)
    records = archive.records[: labels.index(label) + 1] if label else archive.records
    decoder = Decoder(archive, ws.nodes)
    frame, others = call.session.frame, list[str]()
    for held, value in decoder.named(records):
        before = frame.find(held)
        if isinstance(value, float) and before not in (None, value):
            others.append(held)
        frame.assign(held, value)
    if others:
        call.warn("operators.files.other-numbers", name=name, names=others)
    if decoder.not_finite:
        call.warn("operators.files.not-finite-numbers", name=name, names=decoder.not_finite)
    if added := dict(archive.settings.get("INCO", {})):
        ws.options["INCO"] = {**ws.options.get("INCO", {}), **added}
    _restore_units(call, name, str(archive.settings.get("UNIT", "")))
    if not ws.dimension:
        saved = archive.settings
        ws.dimension = int(saved.get("DIME", 0))
        ws.element = str(saved.get("ELEM", ""))
        if saved.get("MODE") in Mode.__members__:
            ws.mode = Mode[saved["MODE"]]


def _restore_units(call: Call, name: str, saved: str) -> None:
    """The units of the file, where the script has named none; others than its own are told."""
    ws = workspace(call.session)
    if ws.units is None:
        ws.options.update({"UNIT": Mot(saved)} if saved else {})
    elif saved and saved != ws.units.name:
        call.warn("operators.files.other-units", name=name, saved=saved, present=ws.units.name)


_RULES: dict[str, Callable[[Any], bool]] = {
    "DIME": lambda said: type(said) is int and said in range(4),
    "ELEM": lambda said: said == "" or (isinstance(said, str) and said in CELL_TYPES),
    "MODE": lambda said: isinstance(said, str),
    "TITR": lambda said: isinstance(said, str),
    "UNIT": lambda said: said in ("", *SYSTEMS),
    "INCO": lambda said: isinstance(said, dict) and all(isinstance(v, str) for v in said.values()),
}
"""What settings of a file hold."""


def check_settings(archive: Archive, name: str) -> None:
    """Refuse settings that no session has; a file need not have them all."""
    for word, holds in _RULES.items():
        if word in archive.settings and not holds(archive.settings[word]):
            raise InputError("io.damaged-object", name=name, kind="OPTI", part=word)

"""SORT: what it writes, by the word that follows; its text formats CSV and CHAI."""

from pathlib import Path

from ssilang.io.tables import Column, csv_lines
from ssilang.language.run.session import Check
from ssilang.operators.files.outputs import option_name, output_path, run_output
from ssilang.operators.prelude import *
from ssilang.operators.texts.words import TEXT, TEXT_IS_FREE, read_text

SORT = shared("SORT", "files", full_name="SORTIR")


def target_path(call: Call, suffix: str = "", also: tuple[str, ...] = ()) -> Path:
    """The file of OPTI SORT, with `suffix` unless it has it or one of `also`."""
    name = option_name(call.session, "SORT", 7)
    path = output_path(call, name)
    if suffix and path.suffix.lower() not in (suffix, *also):
        path = path.with_name(path.name + suffix)
    return path


_SEPARATORS = {"PVIR": ";", "VIRG": ",", "ESPA": " ", "TABU": "\t", "OBLI": "/"}


@SORT.form(said("EXCE"))
def _exce(
    call: Call,
    objects: tuple[Any, ...] = Many(
        "LISTENTI",
        "LISTREEL",
        "LISTMOTS",
        "EVOLUTIO",
        "TABLE",
        at_least=1,
        en="lists, or what holds them",
        range=CARRIED,
    ),
    width: int | None = Key("NCOL", "ENTIER", range=POSITIVE, en="columns side by side"),
    digits: int | None = Key("DIGI", "ENTIER", range=NOT_NEGATIVE, en="decimals"),
    separator: Chosen | None = Cases(
        {"SEPA": [choice("sign", tuple(_SEPARATORS), optional=False)]}, en="separator"
    ),
) -> None:
    given = {"width": width, "digits": digits}
    options: dict[str, Any] = {name: n for name, n in given.items() if n is not None}
    if separator is not None:
        options["separator"] = _SEPARATORS[separator["sign"]]
    units = workspace(call.session).units
    columns = [column for value in objects for column in _columns(value, "", units)]
    if not columns:
        raise call.missing(("LISTREEL", "EVOLUTIO", "TABLE"))
    path = target_path(call, ".csv", (".txt", ".dat", ".xls"))
    run_output(call.session).add_lines("SORT", path, csv_lines(columns, **options))


def _columns(value: Any, name: str, units: UnitSystem | None) -> list[Column]:
    if isinstance(value, ListReel | ListEnti | ListMots):
        return [Column(name, list(value.values))]
    if isinstance(value, Curve):
        made = []
        for part in value.parts:
            x, y = (units.written(u) if units and u else "" for u in part.units)
            made.append(Column(part.abscissa_name, list(part.abscissa_words or part.abscissas), x))
            made.append(Column(part.ordinate_name, list(part.words or part.ordinates), y))
        return made
    if isinstance(value, Table):
        found: list[Column] = []
        for index, inner in value.items():
            title = str(index) if isinstance(index, str | int | float) else ""
            found += _columns(inner, title, units)
        return found
    return []


@SORT.form(said("CHAI"), *TEXT, gives=(), by_hand=TEXT_IS_FREE)
def _chai(call: Call, word: str) -> None:
    text = read_text(call)
    run_output(call.session).add_lines("SORT", target_path(call), [text])


@SORT.form(said("BILA"))
def _bila(
    call: Call,
    name: str = Lead("MOT", en="name of the figure"),
    value: float = Arg("FLOTTANT", en="figure", range=ANY_NUMBER),
    expected: float | None = Opt("FLOTTANT", en="value expected", range=ANY_NUMBER),
    tolerance: float | None = Opt("FLOTTANT", range=NOT_NEGATIVE, en="largest distance to it"),
) -> None:
    if expected is not None and tolerance is None:
        raise call.missing(("FLOTTANT",))
    said, checks = str(name).strip(), call.session.checks
    before = next((c.value for c in checks if c.name == said), value)
    if before != value and expected is None:  # checks may bear one name
        call.warn("operators.files.figure-twice", name=said, value=value, before=before)
    checks.append(Check(said, value, expected, tolerance))

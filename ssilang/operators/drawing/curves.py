"""DESS: curves drawn to files."""

from itertools import count

from ssilang.io.plots.graphs.curves import CurveOptions, draw_curves
from ssilang.io.plots.graphs.line_style import DASHES, LINE_OPTIONS, LineStyle, parse_style
from ssilang.io.plots.graphs.traces import seen
from ssilang.io.recording import Recording
from ssilang.language.registry import Select, words_in
from ssilang.operators.drawing import pictures
from ssilang.operators.files.outputs import run_output
from ssilang.operators.prelude import *

_ENDS = (arg("low", "FLOTTANT", range=ANY_NUMBER), arg("high", "FLOTTANT", range=ANY_NUMBER))


def _bounds(name: str, word: str, en: str) -> Any:
    return key(name, word, *_ENDS, en=en)


def _title_place(name: str, word: str) -> Select:
    at_end = choice("at", ("EXCE", "CENT"), en="at the end or in the middle")
    return select(name, {word: [at_end]}, en="where that stands")


_OPTIONS: tuple[Entry, ...] = (
    flag("log_x", "LOGX", en="logarithmic abscissas"),
    flag("log_y", "LOGY", en="logarithmic ordinates"),
    select(
        "grid",
        {
            "GRIL": [
                choice("dash", tuple(DASHES), default="LIGN", en="dash"),
                flag("grey", "GRIS", en="in grey"),
            ]
        },
        en="grid",
    ),
    flag("square", "CARR", en="square frame"),
    _bounds("x_limits", "XBOR", "bounds of the abscissas"),
    _bounds("y_limits", "YBOR", "bounds of the ordinates"),
    key("x_step", "XGRA", "FLOTTANT", range=POSITIVE, en="step of the abscissas"),
    key("y_step", "YGRA", "FLOTTANT", range=POSITIVE, en="step of the ordinates"),
    flag("extremes", "MIMA", en="extreme values are written"),
    key(
        "difference",
        "ECAR",
        opt("on", "LOGIQUE", default=True),
        en="a second frame with the curves less the first; FAUX: never",
    ),
    flag("date", "DATE", en="the date is written"),
    flag("logo", "LOGO", en="changes nothing"),
    flag("separate", "SEPA", en="a frame for each curve"),
    key(
        "chosen",
        "CHOI",
        many("numbers", "ENTIER", "LISTENTI", range=POSITIVE),
        default=(),
        en="numbers of the curves drawn",
    ),
    key("title", "TITR", "MOT", en="title"),
    key("x_title", "TITX", "MOT", en="title of the abscissas"),
    key("y_title", "TITY", "MOT", en="title of the ordinates"),
    _title_place("x_place", "POSX"),
    _title_place("y_place", "POSY"),
    key("x_format", "XFMT", "MOT", en="format of abscissas"),
    key("y_format", "YFMT", "MOT", en="format of ordinates"),
    flag("axes", "AXES", en="axes through the origin"),
    flag("no_click", "NCLK", en="changes nothing"),
    select(
        "legend",
        {
            "LEGE": [
                choice("corner", ("NO", "NE", "SO", "SE", "EXT"), en="corner"),
                key(
                    "at",
                    "XY",
                    arg("x", "FLOTTANT", range=ANY_NUMBER),
                    arg("y", "FLOTTANT", range=ANY_NUMBER),
                    en="place",
                ),
            ]
        },
        en="legend",
    ),
)


_NAMED = {"DEPL": "m", "VITE": "m/s", "ACCE": "m/s2"}
_MOTIONS = {"m": "m", "cm": "m", "mm": "m", "m/s": "m/s", "cm/s": "m/s", "mm/s": "m/s"}
_MOTIONS |= {"m/s2": "m/s2", "m/s^2": "m/s2", "cm/s2": "m/s2", "g": "m/s2"}
"""Units of motions by what they measure; names of curves of a motion."""


@operator(
    "DESS",
    many("curves", "EVOLUTIO", at_least=1, whole=True, en="curves"),
    opt("table", "TABLE", en="styles by number of curve, names, ends and dashes"),
    *_OPTIONS,
    family="drawing",
    full_name="DESSIN",
)
def dess(call: Call, curves: tuple[Operand, ...], table: Table | None, **said: Any) -> None:
    """Draw and write."""
    first: Curve = curves[0].value
    parts = [part for c in curves for part in c.value.parts]
    curve = Curve(tuple(parts), first.title, first.kind)
    pictures.refuse_rest(call, words_in(_OPTIONS))
    found = _settings(**said)
    for name, word, along in (("x_limits", "XBOR", "abscissas"), ("y_limits", "YBOR", "ordinates")):
        low, high = sorted(found.get(name, (-np.inf, np.inf)))
        if low == high:
            raise call.error("operators.drawing.equal-bounds", low=low)
        drawn = np.concatenate([getattr(p, along) for p in parts])
        if drawn.size and (drawn.max() < low or drawn.min() > high):
            told = {"low": float(drawn.min()), "high": float(drawn.max())}
            call.warn("operators.drawing.nothing-within", word=word, **told)
    for axis in "XY":
        if {f"log_{axis.lower()}", f"{axis.lower()}_format"} <= {*found}:
            raise call.error(
                "operators.drawing.format-of-powers", word=f"{axis}FMT", scale=f"LOG{axis}"
            )
    _tell_unit(call, parts, str(found.get("y_title", "")))
    if table is not None:
        found |= _styles(call, table, [len(part.abscissas) for part in parts])
    found["names"] = _told_apart(curves) | found.get("names", {})
    # the title of the evolution, else the one in force
    if "title" not in found and not curve.title.strip():
        found["title"] = workspace(call.session).title
    units = workspace(call.session).units
    options = CurveOptions(**found, written=units.written if units else None)
    figure = draw_curves(curve, options)
    vain = (told for n, told in _TRACES.items() if found.get(n) and not seen(figure, n))
    pictures.tell_vain(call, vain)
    title = str(found.get("title") or curve.title)
    stem = pictures.picture_name(call.session, title, curves[0].name or "dess")
    files = pictures.save_picture(call.session, figure, stem, ("png", "svg"))
    recording = run_output(call.session).recording
    if recording is not None:
        _take_down(recording, curve, options, title, [f.name for f in files])


_TRACES = {
    "legend": ("LEGE", "operators.drawing.no-curve-named"),
    "difference": ("ECAR", "operators.drawing.no-differences"),
    "separate": ("SEPA", "operators.drawing.one-curve"),
    "x_title_at_end": ("POSX", "operators.drawing.axis-untitled"),
    "y_title_at_end": ("POSY", "operators.drawing.axis-untitled"),
    "x_step": ("XGRA", "operators.drawing.axis-of-its-own"),
    "y_step": ("YGRA", "operators.drawing.axis-of-its-own"),
    "x_format": ("XFMT", "operators.drawing.axis-of-its-own"),
    "axes": ("AXES", "operators.drawing.no-origin"),
    "extremes": ("MIMA", "operators.drawing.no-finite-value"),
}
"""Options that the data may leave without effect: the word of each, and why that is."""


def _tell_unit(call: Call, parts: Sequence[CurvePart], title: str) -> None:
    """Warn of a title of the ordinates whose unit is that of another kind of motion."""
    said = _MOTIONS.get(title.rpartition("(")[2].rstrip().removesuffix(")")) if "(" in title else ""
    kinds = {_MOTIONS.get(p.units[1]) or _NAMED.get(p.ordinate_name.strip()) for p in parts}
    if said and len(kinds) == 1 and (kind := kinds.pop()) and kind != said:
        call.warn("operators.drawing.unit-of-another", title=title, kind=kind)


def _told_apart(curves: tuple[Operand, ...]) -> dict[int, str]:
    """Names of curves that share a legend, by number: it and the evolution's name, else the number.

    Those that the script has made of one colour look alike, and their legend stands once.
    """
    alike: dict[str, list[tuple[int, int, str]]] = {}
    numbers = count(1)
    for operand in curves:
        name = operand.name if len(operand.value.parts) == 1 else ""
        for part in operand.value.parts:
            row = next(numbers), part.colour, name
            alike.setdefault(part.legend.strip(), []).append(row)
    found: dict[int, str] = {}
    for legend, rows in alike.items():
        _, colours, names = (set(column) for column in zip(*rows, strict=True))
        if legend and len(rows) > 1 and (len(colours) > 1 or colours == {0}):
            own = len(names - {""}) == len(rows)
            found |= {n: f"{legend} {name if own else n}" for n, _, name in rows}
    return found


def _take_down(
    recording: Recording, curve: Curve, options: CurveOptions, title: str, files: list[str]
) -> None:
    """The same curves for the run's report, where they are of numbers."""
    numbers = options.chosen or range(1, len(curve.parts) + 1)
    drawn = {n: curve.parts[n - 1] for n in numbers}
    plain = {n: p for n, p in drawn.items() if not p.words and not p.abscissa_words}
    if not plain:
        return
    first = next(iter(plain.values()))
    told = {
        "title": title,
        "x": options.x_title or first.abscissa_name,
        "y": options.y_title or first.ordinate_name,
        "log": [options.log_x, options.log_y],
        "files": files,
    }
    lines = [
        {"name": options.names.get(n, p.legend), "x": p.abscissas, "y": p.ordinates}
        for n, p in plain.items()
    ]
    recording.draw(told, lines)


def _settings(
    grid: Chosen | None,
    chosen: tuple[Any, ...],
    x_place: Chosen | None,
    y_place: Chosen | None,
    legend: Chosen | None,
    **plain: Any,
) -> dict[str, Any]:
    """Options of the drawing from what DESS has read."""
    numbers = [[n] if isinstance(n, int) else n.values.tolist() for n in chosen]
    found = pictures.asked(plain)
    if plain["difference"] is False:
        found["difference"] = False
    found["chosen"] = tuple(n for several in numbers for n in several)
    if grid is not None:
        found |= {"grid": grid["dash"], "grey_grid": grid["grey"]}
    for name, place in (("x_title_at_end", x_place), ("y_title_at_end", y_place)):
        found[name] = place is not None and place["at"] == "EXCE"
    if legend is not None:
        found["legend"] = legend["corner"] or ("XY" if legend["at"] else "")
        found["legend_at"] = legend["at"]
    return found


_DASHES = len(DASHES) - 1  # last code of LIGNE_VARIABLE: 0 full, 1 to 5 TIRR TIRC TIRL TIRM POIN


def _styles(call: Call, table: Table, sizes: list[int]) -> dict[str, Any]:
    """Styles, names, spans and dashes of curves of so many points, from DESS's table."""
    styles: dict[int, LineStyle] = {}
    for index, value in table.items():
        if isinstance(index, int) and isinstance(value, str):
            styles[index] = style = parse_style(value)
            if style.unread:
                call.warn("io.no-line-option", words=style.unread, n=index, options=LINE_OPTIONS)
    first, last = _by_number(table, "INITIAL"), _by_number(table, "FINAL")
    for spans in (first, last):
        for n, value in spans.items():
            if not isinstance(value, int):
                raise call.error("operators.drawing.whole-number-wanted", n=n, value=value)
    for n in {*first, *last} & {*range(1, len(sizes) + 1)}:
        start, end = first.get(n, 1), last.get(n, sizes[n - 1])
        if not 1 <= start <= end <= sizes[n - 1]:
            raise call.error(
                "operators.drawing.portion", n=n, first=start, last=end, n_points=sizes[n - 1]
            )
    dashes = {
        n: codes for n, codes in _by_number(table, "LIGNE_VARIABLE").items() if 1 <= n <= len(sizes)
    }
    beyond = [
        n
        for n, codes in dashes.items()
        if isinstance(codes, ListEnti) and len(codes.values) >= sizes[n - 1]
    ]
    if beyond:
        call.warn("operators.drawing.dashes-beyond", curves=beyond, n_curves=len(beyond))
    return {
        "styles": styles,
        "names": {n: str(text) for n, text in _by_number(table, "TITRE").items()},
        "spans": {n: (first.get(n), last.get(n)) for n in {*first, *last}},
        "dash_codes": {n: _dashes(call, n, codes, sizes) for n, codes in dashes.items()},
    }


def _dashes(call: Call, n: int, codes: Any, sizes: list[int]) -> IntArray:
    """Dashes of all segments of curve n, of which the table must give each.

    Published decks give one for each point: those behind the last segment are told and left out.
    """
    if not isinstance(codes, ListEnti):
        raise call.error("operators.drawing.dashes-list", n=n, found=type_of(codes))
    given, wanted = len(codes.values), sizes[n - 1] - 1
    if given < wanted:
        raise call.error("operators.drawing.dashes-count", n=n, count=given, wanted=wanted)
    dashes = codes.values[:wanted]
    wrong = dashes[(dashes < 0) | (dashes > _DASHES)]
    if len(wrong):
        raise call.error("operators.drawing.dashes-code", n=n, code=int(wrong[0]), last=_DASHES)
    return dashes


def _by_number(table: Table, name: str) -> dict[int, Any]:
    inner = table.get(name)
    if not isinstance(inner, Table):
        return {}
    return {k: v for k, v in inner.items() if isinstance(k, int)}

"""DESS: curves drawn to files."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ssilang.io.plots.graphs.curves import CurveOptions, draw_curves
from ssilang.io.plots.graphs.line_style import DASHES, LineStyle, parse_style
from ssilang.kernel.curves.curve import Curve
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.drawing.pictures import (
    picture_formats,
    picture_name,
    refuse_rest,
    save_picture,
)
from ssilang.operators.workspace import workspace

Option = Callable[[Call, dict[str, Any]], None]


def _flags(**values: Any) -> Option:
    return lambda call, found: found.update(values)


def _pair(name: str) -> Option:
    def read(call: Call, found: dict[str, Any]) -> None:
        after = call.keyword_end
        low, high = (float(call.required("FLOTTANT", after=after)) for _ in range(2))
        if low == high:
            raise call.error("operators.drawing.equal-bounds", low, low=low)
        found[name] = (low, high)

    return read


def _value(name: str, type_word: str) -> Option:
    def read(call: Call, found: dict[str, Any]) -> None:
        found[name] = call.required(type_word, after=call.keyword_end)

    return read


def _grid(call: Call, found: dict[str, Any]) -> None:
    found["grid"] = "LIGN"
    while (word := call.keyword((*DASHES, "GRIS"))) is not None:
        found |= {"grey_grid": True} if word == "GRIS" else {"grid": word}


def _choice(call: Call, found: dict[str, Any]) -> None:
    numbers: list[int] = []
    for value in call.all("ENTIER", "LISTENTI"):
        numbers += [value] if isinstance(value, int) else [int(v) for v in value.values]
    found["chosen"] = tuple(numbers)


def _place_of_title(name: str) -> Option:
    def read(call: Call, found: dict[str, Any]) -> None:
        found[name] = call.keyword(("EXCE", "CENT")) == "EXCE"

    return read


def _legend(call: Call, found: dict[str, Any]) -> None:
    place = call.keyword(("NO", "NE", "SO", "SE", "EXT", "XY"))
    found["legend"] = place or ""
    if place == "XY":
        after = call.keyword_end
        found["legend_at"] = tuple(call.required("FLOTTANT", after=after) for _ in range(2))


_OPTIONS: dict[str, Option] = {
    "LOGX": _flags(log_x=True),
    "LOGY": _flags(log_y=True),
    "GRIL": _grid,
    "CARR": _flags(square=True),
    "XBOR": _pair("x_limits"),
    "YBOR": _pair("y_limits"),
    "XGRA": _value("x_step", "FLOTTANT"),
    "YGRA": _value("y_step", "FLOTTANT"),
    "MIMA": _flags(extremes=True),
    "DATE": _flags(date=True),
    "LOGO": _flags(),
    "SEPA": _flags(separate=True),
    "CHOI": _choice,
    "TITR": _value("title", "MOT"),
    "TITX": _value("x_title", "MOT"),
    "TITY": _value("y_title", "MOT"),
    "POSX": _place_of_title("x_title_at_end"),
    "POSY": _place_of_title("y_title_at_end"),
    "XFMT": _value("x_format", "MOT"),
    "YFMT": _value("y_format", "MOT"),
    "AXES": _flags(axes=True),
    "NCLK": _flags(),
    "LEGE": _legend,
}


@operator(
    "DESS",
    family="drawing",
    full_name="DESSIN",
    help=Help(
        en="Draws curves to a numbered picture in the output folder, as PNG and SVG. Scales: LOGX "
        "LOGY, XBOR YBOR with two bounds, XGRA YGRA with a step, CARR for a square frame, AXES "
        "through the origin, GRIL (dash) (GRIS). Texts: TITR TITX TITY, POSX POSY EXCE or CENT, "
        "XFMT YFMT with a Fortran format, LEGE with a corner NO NE SO SE, EXT or XY x y, MIMA, "
        "DATE. SEPA draws each curve in its own frame, CHOI some of them. The table holds, by "
        "number of curve, words NOLI TIRR TIRC TIRL TIRM REMP BLAN REGU LABEL txt MARQ (size) "
        "(PLEIN) kind; tables TITRE, INITIAL, FINAL and LIGNE_VARIABLE by number give legends, "
        "first and last point and a dash for each segment.",
        fr="Dessine des évolutions dans une image numérotée du dossier de sortie, en PNG et SVG. "
        "Échelles : LOGX LOGY, XBOR YBOR et deux bornes, XGRA YGRA et un pas, CARR pour un cadre "
        "carré, AXES par l'origine, GRIL (tirets) (GRIS). Textes : TITR TITX TITY, POSX POSY EXCE "
        "ou CENT, XFMT YFMT et un format Fortran, LEGE et un coin NO NE SO SE, EXT ou XY x y, "
        "MIMA, DATE. SEPA sépare les courbes, CHOI en choisit. La table contient, par numéro de "
        "courbe, les mots NOLI TIRR TIRC TIRL TIRM REMP BLAN REGU LABEL txt MARQ (taille) (PLEIN) "
        "forme ; ses tables TITRE, INITIAL, FINAL et LIGNE_VARIABLE donnent par numéro la légende, "
        "le premier et le dernier point, et les tirets de chaque segment.",
        syntax="DESS EVOL1 ('LOGX') ('LOGY') ('GRIL' (TYPE) ('GRIS')) ('CARR') ('XBOR' X1 X2) "
        "('YBOR' Y1 Y2) ('XGRA' DX) ('YGRA' DY) ('MIMA') ('DATE') ('SEPA') ('CHOI' N1 ...) "
        "('TITR' T) ('TITX' T) ('TITY' T) ('POSX' M) ('POSY' M) ('XFMT' F) ('YFMT' F) ('AXES') "
        "('LEGE' (PLACE)) (TAB1) ;",
        examples=(
            "EV = EVOL 'MANU' 't' (PROG 0. 1. 2.) 'u' (PROG 0. 3. 1.) ; DESS EV 'GRIL' 'MIMA' ;",
        ),
    ),
    reads_itself=True,
)
def dess(call: Call) -> None:
    """Read curves, options and table in any order; draw and write."""
    found: dict[str, Any] = {}
    curve: Curve | None = None
    name, table = "", None
    while True:
        word = call.keyword(list(_OPTIONS))
        if word is not None:
            _OPTIONS[word](call, found)
            continue
        operand = call.read("EVOLUTIO", "TABLE")
        if operand is None:
            break
        if isinstance(operand.value, Table):
            table = operand.value
        elif curve is None:
            curve, name = operand.value, operand.name
        else:
            curve = Curve(curve.parts + operand.value.parts, curve.title, curve.kind)
    if curve is None:
        raise call.missing(("EVOLUTIO",))
    refuse_rest(call, _OPTIONS)
    if table is not None:
        found |= _styles(call, table)
    # the title of the evolution, else the one in force
    if "title" not in found and not curve.title.strip():
        found["title"] = workspace(call.session).title
    figure = draw_curves(curve, CurveOptions(**found))
    title = str(found.get("title") or curve.title)
    stem = picture_name(call.session, title, name or "dess")
    save_picture(call.session, figure, stem, picture_formats(call.session, ("png", "svg")))


def _styles(call: Call, table: Table) -> dict[str, Any]:
    """Styles, names, spans and dashes of the curves, from DESS's table."""
    styles: dict[int, LineStyle] = {}
    for index, value in table.items():
        if isinstance(index, int) and isinstance(value, str):
            styles[index] = parse_style(value)
    first, last = _by_number(table, "INITIAL"), _by_number(table, "FINAL")
    for spans in (first, last):
        for n, value in spans.items():
            if not isinstance(value, int):
                raise call.error("operators.drawing.whole-number-wanted", n=n, value=value)
    return {
        "styles": styles,
        "names": {n: str(text) for n, text in _by_number(table, "TITRE").items()},
        "spans": {n: (first.get(n), last.get(n)) for n in {*first, *last}},
        "dash_codes": {
            n: getattr(codes, "values", codes)
            for n, codes in _by_number(table, "LIGNE_VARIABLE").items()
        },
    }


def _by_number(table: Table, name: str) -> dict[int, Any]:
    inner = table.get(name)
    if not isinstance(inner, Table):
        return {}
    return {k: v for k, v in inner.items() if isinstance(k, int)}

"""DEFO VECT ANNO: shapes, arrows and texts for TRAC; COUL of them and of curves; their unions."""

from ssilang.io.plots.labels import PLACES, Annotation, Category, Tag
from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.kernel.fields import deformed
from ssilang.operators.dispatch import COUL, EXTR, union
from ssilang.operators.prelude import *


@union(("DEFORME", "DEFORME"), ("VECTEUR", "VECTEUR"))
def together(left: Any, right: Any) -> Any:
    """Shapes or arrows in one picture."""
    return replace(left, parts=left.parts + right.parts)


def is_colour(word: str) -> bool:
    """Whether a word names a colour, by four letters; several words are a text."""
    return word.strip().upper()[:4] in COLOURS and " " not in word.strip()


@operator("DEFO", family="drawing", full_name="DEFORME")
def defo(
    call: Call,
    colour: str | None = Choice(COLOURS, en="colour"),
    mesh: Mesh = Arg("MAILLAGE", en="mesh"),
    displacement: NodeField = Arg("CHPOINT", en="displacements", unit="m"),
    scale: float | None = Opt("FLOTTANT", en="amplification", range=ANY_NUMBER),
    arrows: deformed.Arrows | None = Opt("VECTEUR", en="arrows drawn on it"),
    field: NodeField | None = Opt("CHPOINT", en="field shown on it"),
    cells: CellField | None = Opt("MCHAML", en="field in cells shown on it"),
    model: Model | None = Opt("MMODEL", en="its model"),
) -> deformed.Deformed:
    """Mesh, displacement and what goes with them."""
    moved = [p.nodes for p in displacement.components.values()]
    if moved and len(mesh.node_ids) and not np.isin(mesh.node_ids, np.concatenate(moved)).any():
        call.warn("operators.drawing.moves-nothing", displacement)
    shade = None if colour is None else index_of(colour)
    shown = field if cells is None else cells
    return deformed.Deformed(
        (deformed.DeformedPart(mesh, displacement, scale, shade, arrows, shown, model),)
    )


_FAMILIES = {
    "DEPL": (("UX", "UY", "UZ"), ("UR", "UZ", "")),
    "FORC": (("FX", "FY", "FZ"), ("FR", "FZ", "")),
}


VECT = shared("VECT", "drawing", full_name="VECTEUR")
_SCALE = opt(
    "scale", "FLOTTANT", en="amplification, chosen by the picture by default", range=ANY_NUMBER
)


@VECT.form()
def _nodal(
    call: Call,
    chpoint: NodeField = Main("CHPOINT", en="nodal field"),
    names: tuple[ListMots | str, ...] = Many(
        "LISTMOTS", "MOT", en="DEPL, FORC or components, and a colour", kind="component"
    ),
    scale: float | None = _SCALE,
) -> deformed.Arrows:
    words: list[str] = []
    colour = 0
    for value in names:
        if not isinstance(value, str):
            words += [str(v) for v in value.values]
        elif is_colour(value) and value.strip() not in chpoint.components:
            colour = index_of(value)
        else:
            words.append(str(value))
    columns = _columns(call, chpoint, words)
    made = deformed.arrows_at_nodes(chpoint, columns, scale, colour)
    if not any(c in chpoint.components for c in columns):
        known = ", ".join(chpoint.components) or "none"
        raise call.error(
            "operators.drawing.component-missing", chpoint, columns=columns, known=known
        )
    return made


def _columns(call: Call, chpoint: NodeField, words: list[str]) -> tuple[str, str, str]:
    said = [w.strip() for w in words]
    family = said[0].upper()[:4] if len(said) == 1 else ""
    if family in _FAMILIES and said[0] not in chpoint.components:
        plain, axial = _FAMILIES[family]
        return axial if axial[0] in chpoint.components else plain
    if said:
        return tuple([*said, "", "", ""][:3])  # type: ignore[return-value]
    for plain, axial in _FAMILIES.values():
        for columns in (axial, plain):
            if columns[0] in chpoint.components:
                return columns
            if columns is plain and any(c in chpoint.components for c in columns):
                return columns
    size = max(workspace(call.session).dimension, 1)
    return tuple([*list(chpoint.components)[:size], "", "", ""][:3])  # type: ignore[return-value]


@VECT.form()
def _in_cells(
    mchaml: CellField = Main("MCHAML", en="field in cells"),
    ignored: tuple[object, ...] = Many(
        "MCHAML", "MMODEL", en="characteristics and model: arrows stand in the middle of the cells"
    ),
    words: tuple[ListMots | str, ...] = Many(
        "LISTMOTS", "MOT", en="components, principal stresses or colours", kind="component"
    ),
    scale: float | None = _SCALE,
) -> deformed.Arrows:
    single = [str(w).strip() for w in words if isinstance(w, str)]
    lists = [[str(v).strip() for v in w.values] for w in words if isinstance(w, ListMots)]
    names = {c for block in mchaml.blocks for c in block.components}
    columns = next((x for x in lists if any(c in names for c in x)), None)
    colours = [index_of(c) for x in lists if x is not columns for c in x]
    colours += [index_of(w) for w in single if is_colour(w) and w not in names]
    if columns is not None:
        shade = colours[0] if colours else 0
        return deformed.arrows_in_cells(mchaml, tuple([*columns, "", "", ""][:3]), scale, shade)  # type: ignore[arg-type]
    chosen = [w for w in single if w in names]
    return deformed.principal_strokes(mchaml, scale, tuple(chosen), tuple(colours))


@EXTR.form()
def amplification(
    call: Call,
    shape: deformed.Deformed = Main("DEFORME", en="deformed shapes"),
    what: str = Choice(("AMPL",), optional=False, en="amplification"),
) -> float:
    """By how much the displacement is amplified."""
    if not shape.parts:
        raise call.error("operators.drawing.empty-shape", shape)
    first = shape.parts[0]
    if first.scale is not None:
        return float(first.scale)
    return deformed.automatic_scale(first.mesh, first.displacement)


ANNO = shared("ANNO", "drawing")


union(("ANNOTATI", "ANNOTATI"))(Annotation.joined)


@ANNO.form(said("CATE"))
def _category(
    colour: str = Arg("MOT", en="colour", kind="colour"), text: str = Arg("MOT", en="its meaning")
) -> Annotation:
    if not is_colour(colour) and is_colour(text):
        colour, text = text, colour
    return Annotation((Category(index_of(colour), str(text)),))


@ANNO.form(said("ETIQ"))
def _tag(
    call: Call,
    point: Point = Arg("POINT", en="where"),
    words: tuple[str, ...] = Many(
        "MOT", at_least=1, en="the text; a colour and a side, before it or behind it"
    ),
    distance: float | None = Opt("FLOTTANT", en="distance of the text", unit="m", range=ANY_NUMBER),
    link: bool = Opt("LOGIQUE", default=True, en="whether a line is drawn"),
) -> Annotation:
    found: dict[str, str] = {}
    for word in words:
        side = word.strip().upper() in PLACES and "place" not in found
        role = (
            "place" if side else "colour" if is_colour(word) and "colour" not in found else "text"
        )
        if role in found:
            raise call.error("operators.drawing.no-colour-no-place", said=word, places=PLACES)
        found[role] = word
    if "text" not in found:  # the text is spelt as a side or a colour
        role = next(r for r, word in found.items() if word is words[-1])
        found["text"] = found.pop(role)
    colour = index_of(found["colour"]) if "colour" in found else 0
    place = found.get("place", "NE").strip().upper()
    return Annotation((), (Tag(point, str(found["text"]), colour, place, distance, link),))


@COUL.form(gives=Like("value"))
def _recolour(
    call: Call,
    value: Any = Main("EVOLUTIO", "DEFORME", "VECTEUR", en="what is coloured"),
    given: ListMots | int | str | None = Opt(
        "LISTMOTS",
        "ENTIER",
        "MOT",
        en="colour, its number, or one for each part",
        kind="colour",
        range=ANY_NUMBER,
    ),
) -> Any:
    if given is None:
        colours = [workspace(call.session).colour] * len(value.parts)
    elif isinstance(given, ListMots):
        colours = [index_of(str(v)) for v in given.values]
        if len(colours) < len(value.parts):
            told = {"n_colours": len(colours), "n_parts": len(value.parts)}
            raise call.error("operators.drawing.colour-count", given, **told)
    else:
        colours = [_colour(call, given)] * len(value.parts)
    parts = tuple(_coloured(p, c) for p, c in zip(value.parts, colours, strict=False))
    return replace(value, parts=parts)


def _coloured(part: Any, colour: int) -> Any:
    is_curve = isinstance(part, CurvePart)
    return part.coloured(colour) if is_curve else replace(part, colour=colour)


def _colour(call: Call, given: str | int) -> int:
    """Index of a colour given by name, or by its number from 1 (negative: the default)."""
    if isinstance(given, str):
        return index_of(given)
    if given > len(COLOURS):
        raise call.error("operators.drawing.colour-number", given, count=len(COLOURS), given=given)
    return max(given - 1, 0)

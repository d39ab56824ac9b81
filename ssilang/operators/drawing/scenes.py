"""TRAC: meshes, deformed shapes, arrows and fields drawn to files."""

import numpy as np

from ssilang.io.errors import NoGraphicsError
from ssilang.io.plots.animation import animation_frames, save_animation
from ssilang.io.plots.composition import Composition, Subjects, compose
from ssilang.io.plots.labels import Annotation
from ssilang.io.plots.layers import PictureOptions
from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.io.plots.scene import draw_scene
from ssilang.io.plots.values import VON_MISES
from ssilang.io.plots.view import DEFAULT_DIRECTION, Plane, View, plane_view, view_along
from ssilang.kernel.fields.deformed import Arrows, Deformed
from ssilang.kernel.matrices.submatrices import relation_nodes, support_mesh
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.combine import union as united
from ssilang.language.registry import words_in
from ssilang.language.vocabulary.unit_systems import result_unit
from ssilang.operators.drawing import pictures
from ssilang.operators.drawing.objects import together
from ssilang.operators.files.outputs import run_output
from ssilang.operators.prelude import *


@dataclass
class _Said:
    """What a TRAC statement holds."""

    subjects: Subjects = field(default_factory=Subjects)
    options: dict[str, Any] = field(default_factory=dict)
    eye: Point | None = None
    aimed: tuple[FloatArray, FloatArray] | None = None  # what one looks at, what goes upwards
    names: list[str] = field(default_factory=list)
    qualify: bool = False
    animation: str = ""


_ISO = {"LIGN": "LIGNE", "SULI": "SULI"}


_POINTS = tuple(arg(name, "POINT") for name in ("a", "b", "c"))
_TEXT = arg("text", "MOT")
_OPTIONS: tuple[Entry, ...] = (
    flag("names", "QUAL", en="names of points and meshes"),
    flag("node_numbers", "NOEU", en="numbers of the nodes"),
    select("one_colour", {"COUL": [choice("colour", COLOURS, en="colour")]}, en="in one colour"),
    flag("cell_numbers", "ELEM", en="numbers of the cells"),
    flag("hidden", "CACH", en="the back is hidden"),
    choice("filled", ("FACE", "FACB", "FSDB"), en="faces are filled"),
    key(
        "shrink",
        "ECLA",
        opt("size", "FLOTTANT", default=0.5, range=POSITIVE),
        en="cells are shrunk by a factor",
    ),
    key("beyond", "COUP", *_POINTS, en="only what is beyond a plane"),
    key("section", "SECT", *_POINTS, en="what a plane cuts"),
    key("title", "TITR", _TEXT, en="title"),
    key("legend_name", "LEGE", _TEXT, en="title of the legend"),
    flag("no_legend", "NOLE", en="no legend"),
    flag("date", "DATE", en="the date is written"),
    flag("point_values", "CHAM", en="values at the nodes"),
    key("frame", "BOIT", "MAILLAGE", en="what is framed"),
    choice("animation", ("ANIM", "OSCI"), en="an animated picture, also back"),
    flag("no_click", "NCLK", en="changes nothing"),
    flag("edges", "ARET", en="the first mesh hides, without its cells' edges"),
    flag(
        "direct",
        "DIRE",
        en="one looks from the eye at the first point of COUP, the second one upwards",
    ),
    flag("logo", "LOGO", en="changes nothing"),
)


def _matrix(said: _Said, value: Any) -> None:
    cells, held = support_mesh(Matrix(value.table, value.blocks, ())), relation_nodes(value)
    parts = [cells] if cells.blocks else []
    if len(held):
        parts.append(poi1(value.table, held, 2))
    said.subjects.meshes.append(united(*parts, as_given=True) if parts else cells)


def _parts(said: _Said, value: Deformed | Arrows) -> None:
    name = "deformed" if isinstance(value, Deformed) else "arrows"
    old = getattr(said.subjects, name)
    setattr(said.subjects, name, value if old is None else together(old, value))


def _values(said: _Said, value: Any) -> None:
    # a second field holds characteristics, which von Mises of solids does not need
    if said.subjects.values is None:
        said.subjects.values = value


def _annotation(said: _Said, value: Annotation) -> None:
    old = said.options.get("annotation")
    said.options["annotation"] = value if old is None else old.joined(value)


_OBJECTS: dict[str, Callable[[_Said, Any], None]] = {
    "MAILLAGE": lambda said, value: said.subjects.meshes.append(value),
    "RIGIDITE": _matrix,
    "DEFORME": _parts,
    "VECTEUR": _parts,
    "CHPOINT": _values,
    "MCHAML": _values,
    "MMODEL": lambda said, value: None,
    "ENTIER": lambda said, value: said.options.update(level_count=value),
    "LISTREEL": lambda said, value: said.options.update(levels=value.values),
    "POINT": lambda said, value: setattr(said, "eye", value),
    "ANNOTATI": _annotation,
}


@operator(
    "TRAC",
    many(
        "objects",
        *_OBJECTS,
        whole=True,
        en="meshes, deformed shapes, arrows, fields, levels, eye, texts",
        range=ANY_NUMBER,
    ),
    *_OPTIONS,
    family="drawing",
    full_name="TRACER",
)
def trac(call: Call, objects: tuple[Operand, ...], **options: Any) -> None:
    """Draw and write."""
    if options["direct"] and options["beyond"] is None:
        raise call.error("operators.drawing.view-without-plane")
    if options["direct"] and _is_flat(workspace(call.session)):
        raise call.error("operators.drawing.view-in-the-plane")
    said = _said(**options)
    for operand in objects:
        _OBJECTS[type_of(operand.value)](said, operand.value)
        if operand.name and type_of(operand.value) not in ("ENTIER", "LISTREEL", "POINT", "MMODEL"):
            said.names.append(operand.name)
    pictures.refuse_rest(call, words_in(_OPTIONS))
    _draw(call, call.session, said)


def _said(
    names: bool,
    one_colour: Chosen | None,
    filled: str | None,
    no_legend: bool,
    animation: str | None,
    direct: bool,
    **plain: Any,
) -> _Said:
    """Options of the picture from what TRAC has read."""
    options = pictures.asked(plain)
    aimed = None
    if direct:
        a, b, _ = (p.coordinates for p in options["beyond"])
        aimed = a, b - a
    for plane in {"beyond", "section"} & {*options}:
        options[plane] = Plane.through(*(p.coordinates for p in options[plane]))
    if one_colour is not None:
        said = one_colour["colour"]
        options["only_colour"] = index_of(said) if said else 0
    if filled:
        options["filled"] = filled
    if no_legend:
        options["legend"] = False
    return _Said(options=options, qualify=names, animation=animation or "", aimed=aimed)


def _draw(call: Call, session: Session, said: _Said) -> None:
    ws = workspace(session)
    subjects = said.subjects
    if subjects.values is None and not subjects.meshes:
        if subjects.deformed is None and said.eye is not None:
            subjects.meshes = [said.eye.mesh]
        elif subjects.deformed is None and subjects.arrows is None:
            raise call.missing(("MAILLAGE", "CHPOINT", "MCHAML", "DEFORME", "VECTEUR"))
    made = compose(subjects)
    options = dict(said.options)
    if options.pop("edges", False):
        made.layers[:1] = [replace(layer, edges=False) for layer in made.layers[:1]]
        options["hidden"] = True
    options.setdefault("title", ws.title)
    options["iso"] = _ISO.get(str(ws.options.get("ISOV", ""))[:4].upper(), "SURFACE")
    options["notes"] = made.notes
    if made.legend.categories:
        given = options.get("annotation", Annotation())
        options["annotation"] = made.legend.joined(given)
    options["unit_of"] = _unit_of(ws)
    options["axes"] = _axes(ws)
    if said.qualify:
        options["labels"] = _labels(session, [layer.mesh for layer in made.layers])
    view = _view(session, said, [layer.mesh for layer in made.layers])
    pictures.tell_vain(call, _in_vain(said, made, flat=_is_flat(ws)))
    try:
        _draw_files(session, said, made, view, PictureOptions(**options))
    except NoGraphicsError as problem:  # what was calculated is not lost for a picture
        call.warn(problem.code, **problem.data)


def _in_vain(said: _Said, made: Composition, *, flat: bool) -> Iterator[tuple[str, str]]:
    """Words that ask for what the picture does not have, each with the reason."""
    deformed, options = said.subjects.deformed, said.options
    if all(layer.field is None for layer in made.layers):
        asked = {"legend_name": "LEGE", "point_values": "CHAM", "level_count": "N", "levels": "N"}
        for word in sorted({w for name, w in asked.items() if name in options}):
            yield word, "operators.drawing.no-field"
    elif "shrink" in options and said.subjects.values is not None:
        yield "ECLA", "operators.drawing.cells-of-field"
    if said.animation and (deformed is None or len(deformed.parts) < 2):
        yield said.animation, "operators.drawing.one-picture"
    if flat and "beyond" in options:
        yield "COUP", "operators.drawing.nothing-behind"


def _draw_files(
    session: Session, said: _Said, made: Composition, view: View, options: PictureOptions
) -> None:
    stage = run_output(session).pictures.stage
    figure = draw_scene(made.layers, (view,), options, made.arrows, made.components, stage)
    stem = pictures.picture_name(session, options.title, "-".join(said.names[:3]) or "trac")
    files = pictures.save_picture(session, figure, stem, ("png",))
    deformed = said.subjects.deformed
    if said.animation and deformed is not None and len(deformed.parts) > 1:
        frames = animation_frames(deformed, said.subjects, view, options, stage)
        path = save_animation(frames, files[0].with_suffix(".gif"), said.animation == "OSCI")
        run_output(session).wrote(path)


def _axes(ws: Workspace) -> tuple[str, str]:
    """What stands at the sides of a picture in the plane: coordinates in the deck's units."""
    if ws.units is None:
        return "", ""
    round_axis = ws.mode in (Mode.AXISYMMETRIC, Mode.FOURIER)
    first, second = "rz" if round_axis else "xy"
    unit = ws.units.written("m")
    return f"{first} ({unit})", f"{second} ({unit})"


def _unit_of(ws: Workspace) -> Callable[[str], str] | None:
    """Units of components that are certain, in the deck's system (UX may be a speed)."""
    units = ws.units
    if units is None:
        return None

    def unit_of(component: str) -> str:
        return units.written("Pa" if component == VON_MISES else result_unit(component, ""))

    return unit_of


def _view(session: Session, said: _Said, meshes: list[Mesh]) -> View:
    """The plane in two dimensions; in space from the eye, OPTI OEIL or the usual direction."""
    ws = workspace(session)
    if _is_flat(ws):
        return plane_view()
    eye = said.eye or ws.options.get("OEIL")
    if said.aimed is not None:
        place, upright = said.aimed
        return view_along(
            eye.coordinates - place if isinstance(eye, Point) else DEFAULT_DIRECTION, upright
        )
    if not isinstance(eye, Point):
        return view_along(DEFAULT_DIRECTION)
    clouds = [m.nodes.coordinates[m.sorted_node_ids] for m in meshes if m.n_cells]
    points = np.concatenate(clouds) if clouds else np.zeros((1, 3))
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return view_along(eye.coordinates - middle)


def _is_flat(ws: Workspace) -> bool:
    return ws.mode is not Mode.THREE_DIMENSIONAL and ws.dimension < 3


def _labels(session: Session, meshes: list[Mesh]) -> tuple[tuple[str, Mesh], ...]:
    """Names of the script's points and meshes that lie in what is drawn."""
    drawn = np.unique(np.concatenate([m.sorted_node_ids for m in meshes] or [np.empty(0, int)]))
    found = []
    for name, value in session.frame.named().items():
        if isinstance(value, Point):
            value = value.mesh
        if not isinstance(value, Mesh) or not value.n_cells:
            continue
        if np.isin(value.sorted_node_ids, drawn).all() and not any(value is m for m in meshes):
            found.append((name, value))
    return tuple(found)

"""TRAC: meshes, deformed shapes, arrows and fields drawn to files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ssilang.io.plots.animation import animation_frames, save_animation
from ssilang.io.plots.composition import Subjects, compose
from ssilang.io.plots.labels import Annotation
from ssilang.io.plots.layers import PictureOptions
from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.io.plots.palette import index_of
from ssilang.io.plots.scene import draw_scene
from ssilang.io.plots.view import DEFAULT_DIRECTION, Plane, View, plane_view, view_along
from ssilang.kernel.fields.deformed import Arrows, Deformed
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.support import support_mesh
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call, Operand
from ssilang.language.run.session import Session
from ssilang.language.values import type_of
from ssilang.operators.drawing.pictures import (
    picture_formats,
    picture_name,
    refuse_rest,
    save_picture,
)
from ssilang.operators.files.outputs import run_output
from ssilang.operators.workspace import workspace


@dataclass
class _Said:
    """What a TRAC statement holds."""

    subjects: Subjects = field(default_factory=Subjects)
    options: dict[str, Any] = field(default_factory=dict)
    eye: Point | None = None
    names: list[str] = field(default_factory=list)
    qualify: bool = False
    animation: str = ""


Option = Callable[[Call, _Said], None]
_ISO = {"LIGN": "LIGNE", "SULI": "SULI"}


def _flags(**values: Any) -> Option:
    return lambda call, said: said.options.update(values)


def _colour(call: Call, said: _Said) -> None:
    word = call.keyword(COLOURS)
    said.options["only_colour"] = index_of(word) if word else 0


def _shrink(call: Call, said: _Said) -> None:
    operand = call.read("FLOTTANT", after=call.keyword_end)
    said.options["shrink"] = operand.value if operand else 0.5


def _plane(name: str) -> Option:
    def read(call: Call, said: _Said) -> None:
        after = call.keyword_end
        points = [call.required("POINT", after=after).coordinates for _ in range(3)]
        said.options[name] = Plane.through(*points)

    return read


def _text(name: str) -> Option:
    def read(call: Call, said: _Said) -> None:
        said.options[name] = str(call.required("MOT", after=call.keyword_end))

    return read


def _box(call: Call, said: _Said) -> None:
    said.options["frame"] = call.required("MAILLAGE", after=call.keyword_end)


def _animate(word: str) -> Option:
    return lambda call, said: setattr(said, "animation", word)


def _qualify(call: Call, said: _Said) -> None:
    said.qualify = True


_OPTIONS: dict[str, Option] = {
    "QUAL": _qualify,
    "NOEU": _flags(node_numbers=True),
    "COUL": _colour,
    "ELEM": _flags(cell_numbers=True),
    "CACH": _flags(hidden=True),
    "FACE": _flags(filled=True),
    "FACB": _flags(filled=True),
    "FSDB": _flags(filled=True),
    "ECLA": _shrink,
    "COUP": _plane("beyond"),
    "SECT": _plane("section"),
    "TITR": _text("title"),
    "LEGE": _text("legend_name"),
    "NOLE": _flags(legend=False),
    "DATE": _flags(date=True),
    "CHAM": _flags(point_values=True),
    "BOIT": _box,
    "NCLK": _flags(),
    "ARET": _flags(),
    "ANIM": _animate("ANIM"),
    "OSCI": _animate("OSCI"),
    "DIRE": _flags(),
    "LOGO": _flags(),
}


def _mesh(said: _Said, value: Any) -> None:
    said.subjects.meshes.append(value)


def _matrix(said: _Said, value: Any) -> None:
    said.subjects.meshes.append(support_mesh(value))


def _deformed(said: _Said, value: Deformed) -> None:
    old = said.subjects.deformed
    said.subjects.deformed = value if old is None else Deformed(old.parts + value.parts)


def _arrows(said: _Said, value: Arrows) -> None:
    old = said.subjects.arrows
    said.subjects.arrows = value if old is None else Arrows(old.parts + value.parts)


def _values(said: _Said, value: Any) -> None:
    # a second field holds characteristics, which von Mises of solids does not need
    if said.subjects.values is None:
        said.subjects.values = value


def _annotation(said: _Said, value: Annotation) -> None:
    old = said.options.get("annotation")
    said.options["annotation"] = value if old is None else old.joined(value)


_OBJECTS: dict[str, Callable[[_Said, Any], None]] = {
    "MAILLAGE": _mesh,
    "RIGIDITE": _matrix,
    "DEFORME": _deformed,
    "VECTEUR": _arrows,
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
    family="drawing",
    full_name="TRACER",
    help=Help(
        en="Draws to a numbered PNG picture in the output folder: a mesh (or the one that a "
        "matrix stands on), deformed shapes, arrows, a nodal field or a field in cells as "
        "iso-values (in OPTI ISOV's way), with a number or a list of levels; a further mesh is "
        "drawn as lines. A POINT is the eye of a view in space. Words: CACH hides what is behind, "
        "FACE fills, ECLA shrinks cells, COUL draws one colour, NOEU ELEM QUAL CHAM write numbers, "
        "names and values, COUP shows what is beyond a plane, SECT what is cut by it, BOIT frames "
        "a mesh, TITR LEGE NOLE DATE for texts; ANIME writes an animated GIF of the successive "
        "deformed shapes beside the picture, OSCIL one that also runs back. A field of several "
        "components is drawn in several panels, a stress in cells as von Mises.",
        fr="Trace dans une image PNG numérotée du dossier de sortie : un maillage (ou celui sur "
        "lequel s'appuie une rigidité), des déformées, des vecteurs, un champ par points ou par "
        "éléments en isovaleurs (selon OPTI ISOV), avec un nombre ou une liste de niveaux ; un "
        "autre maillage est tracé en lignes. Un POINT est l'oeil d'une vue dans l'espace. Mots : "
        "CACH cache l'arrière, FACE remplit, ECLA réduit les éléments, COUL ne trace qu'une "
        "couleur, NOEU ELEM QUAL CHAM écrivent numéros, noms et valeurs, COUP montre ce qui est "
        "au-delà d'un plan, SECT ce qu'il coupe, BOIT cadre sur un maillage, TITR LEGE NOLE DATE "
        "pour les textes ; ANIME écrit à côté de l'image un GIF animé des déformées successives, "
        "OSCIL un GIF aller et retour. Un champ à plusieurs composantes a plusieurs vignettes, "
        "une contrainte par éléments est tracée en von Mises.",
        syntax="TRAC MAIL1 (OEIL1) ('QUAL') ('NOEU') ('ELEM') ('COUL' (COUL1)) ('CACH') ('FACE') "
        "('ECLA' (FLOT1)) ('COUP' P1 P2 P3) ('SECT' P1 P2 P3) ('TITR' T) ('BOIT' MAIL2) ;\n"
        "TRAC DEFO1 (OEIL1) ('ANIME' | 'OSCIL') ... ; TRAC VEC1 MAIL1 ... ;\n"
        "TRAC (N1 | LISTREEL1) CHPO1 (MAIL1 | DEFO1) (MAIL2) (VEC1) ('LEGE' T) ('NOLE') ... ;\n"
        "TRAC (N1 | LISTREEL1) MODEL1 MCHAML1 (DEFO1) (MAIL1) ... ; TRAC 'ARET' MAIL1 MAIL2 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 4 (0. 0.) (1. 0.) ; "
            "S = TRAN L 3 (0. 1.) ; TRAC S 'NOEU' 'TITR' 'A square' ;",
        ),
    ),
    reads_itself=True,
)
def trac(call: Call) -> None:
    """Read objects and options in any order; draw and write."""
    said = _Said()
    session = call.session
    while True:
        word = call.keyword(list(_OPTIONS))
        if word is not None:
            _OPTIONS[word](call, said)
            continue
        operand = call.read(*_OBJECTS)
        if operand is None:
            break
        _OBJECTS[type_of(operand.value)](said, operand.value)
        _keep_name(said, operand)
    refuse_rest(call, _OPTIONS)
    _draw(call, session, said)


def _keep_name(said: _Said, operand: Operand) -> None:
    if operand.name and type_of(operand.value) not in ("ENTIER", "LISTREEL", "POINT", "MMODEL"):
        said.names.append(operand.name)


def _draw(call: Call, session: Session, said: _Said) -> None:
    ws = workspace(session)
    subjects = said.subjects
    if subjects.values is None and not subjects.meshes:
        if subjects.deformed is None and said.eye is not None:
            subjects.meshes = [poi1(said.eye.nodes, np.array([said.eye.node]))]
        elif subjects.deformed is None and subjects.arrows is None:
            raise call.missing(("MAILLAGE", "CHPOINT", "MCHAML", "DEFORME", "VECTEUR"))
    made = compose(subjects)
    options = dict(said.options)
    options.setdefault("title", ws.title)
    options["iso"] = _ISO.get(str(ws.options.get("ISOV", ""))[:4].upper(), "SURFACE")
    options["notes"] = made.notes
    if said.qualify:
        options["labels"] = _labels(session, [layer.mesh for layer in made.layers])
    view = _view(session, said, [layer.mesh for layer in made.layers])
    figure = draw_scene(made.layers, (view,), PictureOptions(**options), made.arrows,
                        made.components)  # fmt: skip
    stem = picture_name(session, options["title"], "-".join(said.names[:3]) or "trac")
    files = save_picture(session, figure, stem, picture_formats(session, ("png",)))
    deformed = subjects.deformed
    if said.animation and deformed is not None and len(deformed.parts) > 1:
        frames = animation_frames(deformed, subjects, view, PictureOptions(**options))
        path = save_animation(frames, files[0].with_suffix(".gif"), said.animation == "OSCI")
        run_output(session).wrote(path)


def _view(session: Session, said: _Said, meshes: list[Mesh]) -> View:
    """The plane in two dimensions; in space from the eye, OPTI OEIL or the usual direction."""
    ws = workspace(session)
    if ws.mode is not Mode.THREE_DIMENSIONAL and ws.dimension < 3:
        return plane_view()
    eye = said.eye or ws.options.get("OEIL")
    if not isinstance(eye, Point):
        return view_along(DEFAULT_DIRECTION)
    clouds = [m.nodes.coordinates[m.sorted_node_ids] for m in meshes if m.n_cells]
    points = np.concatenate(clouds) if clouds else np.zeros((1, 3))
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return view_along(eye.coordinates - middle)


def _labels(session: Session, meshes: list[Mesh]) -> tuple[tuple[str, Mesh], ...]:
    """Names of the script's points and meshes that lie in what is drawn."""
    drawn = np.unique(np.concatenate([m.sorted_node_ids for m in meshes] or [np.empty(0, int)]))
    found = []
    for name in sorted(session.frame.names()):
        value = session.frame.find(name)
        if isinstance(value, Point):
            value = poi1(value.nodes, np.array([value.node]))
        if not isinstance(value, Mesh) or not value.n_cells:
            continue
        if np.isin(value.sorted_node_ids, drawn).all() and not any(value is m for m in meshes):
            found.append((name, value))
    return tuple(found)

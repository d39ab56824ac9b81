"""SOLUTION: modes as one object (MANU 'MODE', VIBR 'SOLU'), and the operators that read it."""

from ssilang.kernel.elements import families
from ssilang.kernel.waves.shaken import AXES
from ssilang.language.values import Solution
from ssilang.operators.dispatch import DIME, MANU, union
from ssilang.operators.matrices.element import joined, present, rigi
from ssilang.operators.modal.basis import Shape, shapes_in
from ssilang.operators.modal.matrices import modal_stiffness
from ssilang.operators.modal.modes import directions
from ssilang.operators.prelude import *
from ssilang.operators.statics.loads_in_time import tire
from ssilang.operators.tables.indices import copied

# SEIS SIGS: seismic loads on modal bases, stresses of modes.


@operator("SEIS", family="modal", full_name="SEISME")
def seis(
    call: Call,
    curve: Curve = Arg("EVOLUTIO", en="acceleration of the ground", over="s"),
    table: Table = Arg("TABLE", en="basis"),
    factor: float = Arg("FLOTTANT", en="factor", usual=NOT_ZERO),
    direction: str = Choice(AXES, optional=False, en="direction of the ground"),
) -> Load:
    """Seismic load."""
    shapes = [s for s in shapes_in(table) if s.unknown == "ALFA"]
    if not shapes:
        raise call.error("operators.modal.table-without-modes", table)
    values = {}
    for shape in shapes:
        along = shape.entry.get(Mot("DEPLACEMENTS_GENERALISES"))
        number = along.get(AXES.index(direction) + 1) if isinstance(along, Table) else None
        if not isinstance(number, int | float):
            raise call.error("operators.modal.mode-no-generalised-displacements", table)
        values[shape.mark.node] = float(number)
    _tell_left_out(call, shapes, values, direction)
    nodes = np.array(sorted(values))
    part = NodeValues(nodes, -factor * np.array([values[int(n)] for n in nodes]))
    field = NodeField(shapes[0].mark.nodes, {"FALF": part}, "DISCRET")
    return Load((LoadPart("MECA", field, curve),))


HALF = 0.5  # of the mass that moves; with less the answer is that of the rest


def _tell_left_out(
    call: Call, shapes: Sequence[Shape], moved: dict[int, float], direction: str
) -> None:
    """Warn of modes that nothing holds, and of mass free to move that they leave out."""
    words, axis, held = ("MASSES_MOBILES", "MASSE_GENERALISEE"), AXES.index(direction) + 1, 0.0
    still = [s for s in shapes if s.entry.get(Mot("FREQUENCE")) == 0.0 and moved[s.mark.node]]
    if still:
        call.warn("operators.modal.free-mode-shaken", count=len(still), axis=direction)
    for shape in shapes:
        masses, mass = (shape.entry.get(Mot(word)) for word in words)
        whole = masses.get(axis) if isinstance(masses, Table) else None
        if not isinstance(whole, float) or not isinstance(mass, float) or mass <= 0.0:
            return  # other modes than VIBR's
        held += moved[shape.mark.node] ** 2 / mass / (whole or np.inf)
    if held < HALF:
        told = {"share": 100.0 * held, "rest": 100.0 - 100.0 * held, "axis": direction}
        call.warn("operators.modal.mass-left-out", **told)


@operator("SIGS", family="modal", full_name="SIGSOL")
def sigs(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    material: tuple[CellField, ...] = Many("MCHAML", at_least=1, en="parameters"),
    table: Table = Arg("TABLE", en="shapes"),
) -> Table:
    """Stresses of modes."""
    made, found = with_stresses(present(call, model), joined(material), table)
    if not found:
        raise call.error("operators.modal.no-mode-no-shape", table)
    return made


def with_stresses(model: Model, material: CellField, table: Table) -> tuple[Table, int]:
    """The table, and those in it, copied with the stresses; and how many were computed."""
    made, found = copied(table), 0
    for shape, entry in (("DEFORMEE_MODALE", "CONTRAINTE_MODALE"), ("DEFORMEE", "CONTRAINTE")):
        field = table.get(Mot(shape))
        if isinstance(field, NodeField):
            blocks = tuple(families.stress(z, material, field) for z in model.zones)
            made.set(Mot(entry), CellField(blocks, "CONTRAINTES"))
            return made, 1
    for index, value in table.items():
        if isinstance(value, Table):
            inner, count = with_stresses(model, material, value)
            found += count
            if count:
                made.set(index, inner)
    return made, found


_MAIN = arg("solution", "SOLUTION", en="modes")


@MANU.form(said("MODE"))
def mode_by_hand(
    call: Call,
    number: int | None = Key("NUME", "ENTIER", range=POSITIVE, en="its number, 1 without it"),
    frequency: float = Arg("FLOTTANT", en="frequency", unit="Hz", range=ANY_NUMBER),
    mass: float = Arg("FLOTTANT", en="generalised mass", unit="kg", range=POSITIVE),
    x: float = Opt("FLOTTANT", default=0.0, en="generalised displacements", range=ANY_NUMBER),
    y: float = Opt("FLOTTANT", default=0.0, en="generalised displacements", range=ANY_NUMBER),
    z: float = Opt("FLOTTANT", default=0.0, en="generalised displacements", range=ANY_NUMBER),
    shape: NodeField = Arg("CHPOINT", en="shape"),
    stresses: CellField | None = Opt("MCHAML", en="its stresses"),
) -> Solution:
    """One mode."""
    nodes = workspace(call.session).nodes
    entries: dict[str, Any] = {
        "NUMERO_MODE": number or 1,
        "POINT_REPERE": Point(nodes, int(nodes.add([[0.0, 0.0, 0.0]])[0])),  # type: ignore[arg-type]
        "FREQUENCE": frequency,
        "MASSE_GENERALISEE": mass,
        "DEPLACEMENTS_GENERALISES": directions((x, y, z)),
        "DEFORMEE_MODALE": shape,
    }
    if stresses is not None:
        entries["CONTRAINTE_MODALE"] = stresses
    return Solution((Table.of(entries, "MODE"),))


@union(("SOLUTION", "SOLUTION"))
def join_solutions(first: Solution, second: Solution) -> Solution:
    """The modes of both."""
    return Solution((*first.modes, *second.modes))


@DIME.form()
def count_modes(solution: Solution = Main("SOLUTION", en="modes")) -> int:
    """Number of modes."""
    return len(solution.modes)


_ENTRIES = {
    "FREQ": "FREQUENCE", "MGEN": "MASSE_GENERALISEE", "POIN": "POINT_REPERE",
    "DEPL": "DEFORMEE_MODALE", "CONT": "CONTRAINTE_MODALE",
}  # fmt: skip
_ALONG = {"QX": 1, "QY": 2, "QZ": 3}


@tire.form(gives="FLOTTANT|ENTIER|POINT|CHPOINT|MCHAML")
def of_a_mode(
    call: Call,
    solution: Solution = _MAIN,
    word: str = Arg("MOT", en="FREQ, MGEN, QX, QY, QZ, POIN, DEPL or CONT"),
    which: Chosen | None = Cases(
        {
            word: [arg("number", "ENTIER", range=POSITIVE, en="its place, or its number")]
            for word in ("RANG", "CAS", "NUME")
        },
        en="which mode, the last without it",
    ),
) -> Any:
    """What one mode holds."""
    modes = solution.modes
    if which is not None and which.word == "NUME":
        modes = tuple(m for m in modes if m.get(Mot("NUMERO_MODE")) == which["number"])
    elif which is not None:
        modes = modes[which["number"] - 1 : which["number"]]
    if not modes:
        raise call.error(
            "operators.modal.solution-without-mode", solution, count=len(solution.modes)
        )
    name = word.rstrip().upper()[:4]
    if name in _ALONG:
        along = modes[-1].get(Mot("DEPLACEMENTS_GENERALISES"))
        held = along.get(_ALONG[name]) if isinstance(along, Table) else None
    else:
        held = modes[-1].get(Mot(_ENTRIES.get(name, name)))
    if held is None:
        known = (*_ENTRIES, *_ALONG)
        raise call.error("operators.modal.mode-without-word", word, word=name, known=known)
    return held


@sigs.form()
def stressed(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    material: tuple[CellField, ...] = Many("MCHAML", at_least=1, en="parameters"),
    solution: Solution = _MAIN,
) -> Solution:
    """The modes with their stresses."""
    model, given = present(call, model), joined(material)
    return Solution(tuple(with_stresses(model, given, m)[0] for m in solution.modes))


@rigi.form()
def stiffness_of_modes(call: Call, solution: Solution = _MAIN) -> Matrix:
    """Generalised stiffnesses on the diagonal."""
    return modal_stiffness(call, solution.table, None)

"""VIBR: natural modes, as the language's table BASE_MODALE."""

from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.submatrices import support_mesh
from ssilang.kernel.modal.modes import ComplexMode, complex_modes, modes_between, modes_near
from ssilang.kernel.modal.modes import Mode as RealMode
from ssilang.kernel.statics import doubled
from ssilang.language.values import Solution
from ssilang.operators.matrices import connections
from ssilang.operators.prelude import *
from ssilang.operators.statics.solve import first_cells
from ssilang.operators.workspace import solver_of

_FREQUENCY = arg("frequency", "FLOTTANT", range=NOT_NEGATIVE, en="frequency", unit="Hz")
_COUNT = arg("count", "ENTIER", range=POSITIVE, en="number of modes")


def _wanted(call: Call, method: Chosen) -> list[tuple[float, int]]:
    """Frequencies, and how many modes near each."""
    if method.word != "PROCHE":
        return [(method["frequency"], max(method["count"], 1))]
    frequencies, counts = method["frequencies"].values, method["counts"]
    numbers = [1] * len(frequencies) if counts is None else list(counts.values)
    if len(numbers) != len(frequencies):
        told = {"n_frequencies": len(frequencies), "n_numbers": len(numbers)}
        raise call.error("operators.modal.frequencies-and-numbers-differ", **told)
    return [(float(f), int(n)) for f, n in zip(frequencies, numbers, strict=True)]


@operator(
    "VIBR", family="modal", full_name="VIBRATION", gives=by("solution", {True: "SOLUTION"}, "TABLE")
)
def _vibr(
    call: Call,
    solution: bool = Flag("SOLU", en="an object SOLUTION in place of a table"),
    method: Chosen = Cases(
        {
            "PROCHE": [
                arg("frequencies", "LISTREEL", en="frequencies", unit="Hz", usual=NOT_NEGATIVE),
                opt("counts", "LISTENTI", en="modes near each, 1", range=POSITIVE),
            ],
            "INTERVALLE": [
                arg("low", "FLOTTANT", en="one end", unit="Hz", range=ANY_NUMBER),
                arg("high", "FLOTTANT", en="the other", unit="Hz", range=ANY_NUMBER),
            ],
            "SIMULTANE": [_FREQUENCY, _COUNT],
            "IRAM": [
                _FREQUENCY,
                _COUNT,
                opt("decay", "FLOTTANT", default=0.0, en="imaginary part", range=ANY_NUMBER),
            ],
        },
        optional=False,
        en="near frequencies, in an interval, near one",
    ),
    lowest: int = Key("BASSE", "ENTIER", range=POSITIVE, default=0, en="so many from the low end"),
    highest: int = Key(
        "HAUTE", "ENTIER", range=POSITIVE, default=0, en="so many from the high end"
    ),
    shown: bool = Flag("IMPR", en="accepted, changes nothing"),
    multiple: bool = Flag("MULT", en="accepted, changes nothing"),
    table: bool = Flag("TBAS", en="a table: the default"),
    largest: bool = Flag("LM", en="accepted, changes nothing"),
    matrices: tuple[Matrix, ...] = Many(
        "RIGIDITE", en="stiffness, mass, and damping", distinct=True
    ),
    first: object = Opt("LISTCHPO", en="shapes to begin with: accepted, change nothing"),
    signed: bool = Opt(
        "LOGIQUE", default=True, en="negative frequencies of unstable modes (default VRAI)"
    ),
) -> "Table | Solution":
    made = _modes(call, method, lowest, highest, matrices, signed)
    if not solution:
        return made
    modes = made.get(Mot("MODES"))
    assert isinstance(modes, Table)
    return Solution(tuple(m for _, m in modes.items() if isinstance(m, Table)))


def _modes(
    call: Call,
    method: Chosen,
    lowest: int,
    highest: int,
    matrices: tuple[Matrix, ...],
    signed: bool,
) -> Table:
    """The table BASE_MODALE that is asked for."""
    if len(matrices) < 2:
        raise call.missing(("RIGIDITE",))
    stiffness, mass, damping = matrices_by_kind(matrices)
    connections.warn_connections(call.session, call.span, "VIBR", stiffness)
    connections.warn_repeated(call.session, call.span, "VIBR", mass, "MASS", stiffness)
    if (found := connections.rotary_without_mass(mass)) is not None:
        call.warn("operators.matrices.rotary-alone", **found)
    _warn_of_mass(call, stiffness, mass)
    if damping is None:
        mass, stiffness = (_as_symmetric(m, stiffness) for m in (mass, stiffness))
    if damping is not None or not (
        assembly.is_symmetric(stiffness) and assembly.is_symmetric(mass)
    ):
        return _complex(call, method, stiffness, mass, damping)
    if method.word == "INTERVALLE":
        ends = sorted((method["low"], method["high"]))
        modes = modes_between(stiffness, mass, ends[0], ends[1], solver_of(call.session))
        if not modes and mass.inertial:  # a factor of buckling is no frequency
            call.warn("operators.modal.no-frequency-between", low=ends[0], high=ends[1])
        if lowest:
            modes = modes[:lowest]
        elif highest:
            modes = modes[-highest:]
    else:
        wanted = _wanted(call, method)
        modes = modes_near(stiffness, mass, wanted, solver_of(call.session))
        if len(wanted) == 1 and len(modes) < wanted[0][1]:
            call.warn("operators.modal.fewer-modes", asked=wanted[0][1], found=len(modes))
        unknowns = assembly.numbering_of(mass)
        shapes = [assembly.field_to_vector(m.shape, unknowns, dual=False) for m in modes]
        twice = [m for m, u, v in zip(modes, shapes, shapes[1:], strict=False) if np.allclose(u, v)]
        if twice:
            call.warn("operators.modal.mode-twice", frequency=twice[0].frequency)
    origin = first_cells(stiffness), mass
    workspace(call.session).origins.update((mode.shape, origin) for mode in modes)
    free = sum(m.frequency == 0.0 for m in modes)
    if free and stiffness.relations and mass.inertial:  # a body that nothing holds is meant to fly
        call.warn("operators.modal.free-motions", count=free)
    return modal_table(call, mass, [_real_entry(m, signed) for m in modes])


def _warn_of_mass(call: Call, stiffness: Matrix, mass: Matrix) -> None:
    """Tell of masses that the stiffness does not know, that supports hold, or of both signs."""
    if not mass.inertial:
        return  # a buckling load made by hand
    known, heavy = assembly.numbering_of(stiffness), assembly.numbering_of(mass)
    lumps = [b for b in mass.blocks if b.zone is None and b.raw_nodes.shape[1] == 1]
    idle = doubled.idle_nodes(lumps, stiffness)
    found = {
        "operators.dynamics.masses-alone": np.setdiff1d(heavy.nodes, known.nodes),
        "operators.matrices.masses-on-supports": idle if len(idle) == len(lumps) else idle[:0],
    }
    for code, nodes in found.items():
        if len(nodes):
            call.warn(code, count=len(nodes), node=mass.table.told(int(nodes[0])))
    names = sorted({*heavy.unknowns} - {*known.unknowns})
    if names and any(b.zone for b in stiffness.blocks):
        call.warn("operators.matrices.mass-of-nothing", names=names)
    if found := assembly.negative_mass(assembly.assemble(mass, heavy), heavy):
        call.warn("operators.modal.mass-of-both-signs", unknown=found[0], value=found[1])


def matrices_by_kind(
    matrices: Sequence[Matrix], mass_first: bool = False
) -> tuple[Matrix, Matrix, Matrix | None]:
    """Stiffness, mass and damping, by their kinds where these tell, else in that order.

    `mass_first`: else mass, stiffness, damping.
    """
    left = list(matrices[:3])
    masses = [m for m in left if m.kind.startswith("MASS")]
    mass = masses[0] if len(masses) == 1 else left[0 if mass_first else 1]
    left.remove(mass)
    damped = [m for m in left if m.kind.startswith("AMOR")]
    if len(left) == 1:
        return left[0], mass, None
    damping = damped[0] if len(damped) == 1 else left[1]
    left.remove(damping)
    return left[0], mass, damping


def _as_symmetric(matrix: Matrix, stiffness: Matrix) -> Matrix:
    """The matrix of symmetric blocks where unsymmetric ones (KP ASYM) sum up to what is symmetric.

    Unknowns that the stiffness holds do not count: pressure on a held edge is symmetric.
    """
    if assembly.is_symmetric(matrix) or any(r.dual is not None for r in matrix.relations):
        return matrix
    numbering = assembly.numbering_of(stiffness)
    if not np.isin(assembly.numbering_of(matrix).nodes, numbering.nodes).all():
        return matrix
    rows = assembly.constraint_matrix(stiffness, numbering).C
    held = rows[np.diff(rows.indptr) == 1].indices
    K = assembly.assemble(matrix, numbering)
    apart = abs(K - K.T).tocoo()
    counts = ~(np.isin(apart.row, held) | np.isin(apart.col, held))
    if apart.data[counts].max(initial=0.0) > 1e-9 * abs(K).max():
        return matrix
    parts = (
        replace(b, values=(b.values + b.values.swapaxes(1, 2)) / 2, symmetric=True)
        for b in matrix.blocks
    )
    return replace(matrix, blocks=tuple(parts))


def _complex(
    call: Call, method: Chosen, stiffness: Matrix, mass: Matrix, damping: Matrix | None
) -> Table:
    if method.word != "IRAM":
        raise call.error("operators.modal.complex-modes")
    ((frequency, count),) = _wanted(call, method)
    near = complex(frequency, method["decay"])
    modes = complex_modes(stiffness, mass, damping, near, count)
    return modal_table(call, mass, [{n: of(m) for n, of in _COMPLEX.items()} for m in modes])


# --- tables ----------------------------------------------------------------------------------


def directions(values: Sequence[float]) -> Table:
    return Table.of({i + 1: float(v) for i, v in enumerate(values)}, "DEPLACEMENTS_GENERALISES")


def _real_entry(mode: RealMode, signed: bool) -> dict[str, Any]:
    return {
        "FREQUENCE": mode.frequency if signed else abs(mode.frequency),
        "MASSE_GENERALISEE": mode.mass,
        "DEPLACEMENTS_GENERALISES": directions(mode.along),
        "MASSES_MOBILES": directions(mode.moving),
        "DEFORMEE_MODALE": mode.shape,
    }


_COMPLEX: dict[str, Callable[[ComplexMode], Any]] = {
    "FREQUENCE_REELLE": lambda mode: mode.frequency.real,
    "MASSE_GENERALISEE_REELLE": lambda mode: mode.mass.real,
    "DEFORMEE_MODALE_REELLE": lambda mode: mode.real,
    "DEPLACEMENTS_GENERALISES_REELS": lambda mode: directions([a.real for a in mode.along]),
    "FREQUENCE_IMAGINAIRE": lambda mode: mode.frequency.imag,
    "MASSE_GENERALISEE_IMAGINAIRE": lambda mode: mode.mass.imag,
    "DEFORMEE_MODALE_IMAGINAIRE": lambda mode: mode.imaginary,
    "DEPLACEMENTS_GENERALISES_IMAGINAIRES": lambda mode: directions([a.imag for a in mode.along]),
}
"""What the table of a complex mode says of it."""


def modal_table(
    call: Call, mass: Matrix, entries: list[dict[str, Any]], subtype: str = "MODE"
) -> Table:
    """The BASE_MODALE table of modes, each with a point of its own that marks it."""
    ws = workspace(call.session)
    modes = Table.of({"MAILLAGE": support_mesh(mass)}, "BASE_DE_MODES")
    for number, entry in enumerate(entries, start=1):
        mark = Point(ws.nodes, int(ws.nodes.add([[0.0, 0.0, 0.0]])[0]))  # type: ignore[arg-type]
        modes.set(number, Table.of({"NUMERO_MODE": number, "POINT_REPERE": mark, **entry}, subtype))
    return Table.of({"MODES": modes}, "BASE_MODALE")

"""Loads of PASAPAS that depend on where bodies are: of CHARMECA, pressures on sides that turn."""

from contextlib import contextmanager

from ssilang.kernel.fields.deformed import displacements
from ssilang.kernel.matrices.assembly import assemble, field_to_vector, outside, vector_to_field
from ssilang.kernel.plasticity.added_load import SHIFT, Added, LoadLaw, loaded_bulk
from ssilang.kernel.plasticity.bulk import Bulk, State
from ssilang.kernel.statics.thermal_load import along_normals, pressures
from ssilang.kernel.stepping.problem.problem import Inputs, Problem
from ssilang.operators.prelude import *
from ssilang.operators.session.user_procedures import call_user
from ssilang.operators.statics.bodies import Bodies
from ssilang.operators.statics.loads_in_time import part_at
from ssilang.operators.statics.pasapas_steering import tell_step
from ssilang.operators.tables.entries import Entries


class LoadByProcedure:
    """Calls `TAB2 = CHARMECA TAB1 TIME` and reads its load.

    Meanwhile TAB1 . 'ESTIMATION' holds TEMPS and DEPLACEMENTS of the state under trial, and in
    finite displacements the nodes stand where the bodies are.
    """

    def __init__(self, entries: Entries, problem: Problem, moves: bool) -> None:
        self.entries, self.problem, self.moves = entries, problem, moves

    def __call__(self, time: float, u: FloatArray) -> Added:
        """The load at a time, for a displacement."""
        numbering, table = self.problem.numbering, self.entries.table
        field = vector_to_field(u, numbering)
        kept = table.get("ESTIMATION") if table.has("ESTIMATION") else None
        table.set(Mot("ESTIMATION"), Table.of({"TEMPS": time, "DEPLACEMENTS": field}))
        tell_step(table, time)
        try:
            with _moved(field, self.moves):
                results = call_user(self.entries.call, "CHARMECA", table, time)
                return self._read(results)
        finally:
            table.remove("ESTIMATION")
            if kept is not None:
                table.set(Mot("ESTIMATION"), kept)

    def _read(self, results: list[object]) -> Added:
        if len(results) != 1 or not isinstance(results[0], Table):
            raise self.entries.error("operators.statics.charmeca-gives-a-table")
        found = Entries(self.entries.call, results[0], "PASAPAS", "TCHAR")
        found.check()
        numbering = self.problem.numbering
        load: NodeField | None = found.get("ADDI_SECOND")
        matrix = found.get("ADDI_MATRICE")
        if load is None:
            return Added(np.zeros(numbering.size))
        lost = outside(load, numbering)
        if lost:
            raise found.error("operators.statics.force-without-unknowns", lost=lost[0])
        stiffness = None if matrix is None else assemble(matrix, numbering)
        return Added(field_to_vector(load, numbering), stiffness)


@contextmanager
def _moved(field: NodeField, moves: bool) -> Iterator[None]:
    """Nodes where the field takes them, for a while."""
    if not moves:
        yield
        return
    nodes = field.table
    kept = nodes.coordinates.copy()
    nodes.coordinates[:] += displacements(field)
    try:
        yield
    finally:
        nodes.coordinates[: len(kept)] = kept


def procedure_law(entries: Entries) -> Callable[[Problem], LoadLaw]:
    """The load of CHARMECA, once the problem is numbered."""
    moves = entries.flag("GRANDS_DEPLACEMENTS")
    return lambda problem: LoadByProcedure(entries, problem, moves)


def pressure_law(load: Load, sides: tuple[Zone, ...]) -> Callable[[Problem], LoadLaw]:
    """Pressures on sides that stand where the bodies have taken them, once it is numbered."""
    parts = pressures(load)

    def of_problem(problem: Problem) -> LoadLaw:
        def law(time: float, u: FloatArray) -> Added:
            total = np.zeros(problem.numbering.size)
            with _moved(vector_to_field(u, problem.numbering), True):
                for part in parts:
                    pushed = along_normals(part_at(part, time), sides)
                    total += field_to_vector(pushed, problem.numbering)
            return Added(total)

        return law

    return of_problem


def loaded_bodies(law_of: Callable[[Problem], LoadLaw], said: str, bodies: Bodies | None) -> Bodies:
    """Bodies, if there are any, under a load that depends on where they are."""

    def make(problem: "Problem", inputs: "Inputs") -> tuple[Bulk, State]:
        from ssilang.kernel.plasticity.following import no_bodies

        start: tuple[Bulk, State] = (no_bodies(problem), ())
        bulk, state = start if bodies is None else bodies(problem, inputs)
        first = float(problem.times[0])
        still = bulk.respond(state, np.zeros(bulk.size), first).tangent
        # Where unknowns meet: all those of two nodes that the matrix ties, or of one.
        numbering = problem.numbering
        _, places = np.unique(numbering.nodes, return_inverse=True)
        n = numbering.size
        ones = np.ones(n)
        standing = sp.csr_array((ones, (places, np.arange(n))), shape=(int(places.max()) + 1, n))
        tied = standing @ (abs(problem.K) + abs(still) + sp.eye_array(n)) @ standing.T
        pattern = sp.csr_array((standing.T @ tied @ standing) > 0)
        instant = SHIFT * float(np.ptp(problem.times))
        loaded = loaded_bulk(bulk, law_of(problem), _shifts(problem), instant, pattern, said)
        return loaded, loaded.begin(state, problem.u, first)

    return make


def _shifts(problem: Problem) -> FloatArray:
    """Small differences of the unknowns: lengths, and turns."""
    numbering = problem.numbering
    ends = numbering.table.coordinates[numbering.nodes]
    extent = float(np.ptp(ends, axis=0).max(initial=0.0)) or 1.0
    turns = np.array([name.startswith("R") for name in numbering.unknowns])
    return np.where(turns[numbering.codes], SHIFT, SHIFT * extent)

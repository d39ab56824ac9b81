"""ZCON of harmonic balance along the arc (CONTINU, 'HBM' = VRAI), nonlinear forces by CHARMECA."""

from ssilang.kernel.continuation.arc import Branch, Lengths, Tracer
from ssilang.kernel.continuation.arc import Point as Solution
from ssilang.kernel.continuation.expansion import FrequencyProblem, Names
from ssilang.kernel.continuation.harmonics import basis_of, exponents, unstable
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.submatrices import together
from ssilang.kernel.stepping.problem.constraints import constraints_of
from ssilang.kernel.stepping.problem.loading import loading_of
from ssilang.operators.modal.hbm import asked_results, curve, joined, known_names, longer
from ssilang.operators.prelude import *
from ssilang.operators.session.user_procedures import call_user
from ssilang.operators.tables.entries import Entries


def nonlinear_unknowns(entries: Entries) -> tuple[Point, list[str]] | None:
    """POINT_FNL and COMP_FNL where PROCEDURE_CHARMECA and AFT are asked for."""
    if not entries.flag("PROCEDURE_CHARMECA"):
        return None
    if entries.get("PROCEDURE_FREQUENCE_TEMPS") != "AFT":
        raise entries.error("operators.modal.nonlinear-forces-computed-time")
    names = entries.needed("COMP_FNL").values
    return entries.needed("POINT_FNL"), [n.rstrip() for n in names]


class Sampled:
    """Forces and stiffnesses by the procedure CHARMECA of the script (Cast3M's AFT).

    TAB1 . 'DEP_NL' holds the motion at equal instants of a period, a LISTCHPO ('CALC_CHPO' =
    VRAI) or one LISTREEL an unknown; the procedure sets 'FNL_T' alike and 'KNL_T' . i . j, the
    LISTREEL of - dF_i/dx_j. 'TIME' holds the pseudo-time.
    """

    def __init__(self, entries: Entries, point: Point, names: list[str]) -> None:
        self.entries, self.point, self.names = entries, point, names
        self.fields = entries.flag("CALC_CHPO")

    def __call__(self, motion: FloatArray, time: float) -> tuple[FloatArray, FloatArray]:
        """f (N, m) and -df/dx (N, m, m)."""
        table, count = self.entries.table, motion.shape
        table.set(Mot("TIME"), float(time))
        table.set(Mot("DEP_NL"), self._given(motion))
        call_user(self.entries.call, "CHARMECA", table)
        force = self._forces(self.entries.needed("FNL_T"), count)
        stiffness = self.entries.needed("KNL_T")
        k = np.zeros((*count, count[1]))
        for i in range(count[1]):
            for j in range(count[1]):
                row = stiffness.get(i + 1)
                value = row.get(j + 1) if isinstance(row, Table) else None
                k[:, i, j] = self._list(value, count[0], f"KNL_T . {i + 1} . {j + 1}")
        return force, k

    def _given(self, motion: FloatArray) -> ListChpo | Table:
        if not self.fields:
            return Table.numbered([ListReel(column.copy()) for column in motion.T])
        node = np.array([self.point.node])
        rows = (dict(zip(self.names, row[:, None], strict=True)) for row in motion.copy())
        return ListChpo([NodeField.of(self.point.nodes, node, row, "DIFFUS") for row in rows])

    def _forces(self, given: ListChpo | Table, count: tuple[int, ...]) -> FloatArray:
        if isinstance(given, Table):
            columns = [
                self._list(given.get(i + 1), count[0], f"FNL_T . {i + 1}") for i in range(count[1])
            ]
            return np.stack(columns, axis=1)
        if len(given) != count[0] or not all(isinstance(f, NodeField) for f in given.values):
            raise self.entries.error("operators.modal.charmeca-gives-fields", count=count[0])
        node, out = np.array([self.point.node]), np.zeros(count)
        for t, field in enumerate(given.values):
            assert isinstance(field, NodeField)
            for i, name in enumerate(self.names):
                out[t, i] = sum(float(field.values_at(n, node)[0]) for n in _either(field, name))
        return out

    def _list(self, value: object, count: int, place: str) -> FloatArray:
        if not isinstance(value, ListReel) or len(value.values) != count:
            raise self.entries.error(
                "operators.modal.charmeca-gives-reals", count=count, place=place
            )
        return np.asarray(value.values, dtype=float)


def _either(field: NodeField, name: str) -> list[str]:
    """The component as the script named it: by the unknown or by its force."""
    return [n for n in dict.fromkeys((name, dual_of(name))) if n in field.components]


STABILITY = ("DIAG", "FLOQ", "HILL")
BEND = np.radians(60.0)
"""Angle between two steps beyond which the second one is cut."""


def lengths_of(entries: Entries) -> Lengths:
    """How far steps go: WTABLE . DS DSMIN DSMAX, NB_ITERATION, MAXITERATION, units."""
    times = np.asarray(entries.needed("TEMPS_CALCULES").values)
    entries.times("TEMPS_CALCULES")  # refuses what does not increase
    work = _work(entries)
    start = work.get("DS")
    least = work.get("DSMIN") or 1e-3 * start
    most = work.get("DSMAX") or max(start, 1.0)
    if not least <= start <= most:
        raise entries.error("operators.modal.steps-of-continuation")
    return Lengths(
        start, least, most,
        entries.get("NB_ITERATION"), round(entries.get("MAXITERATION")),
        entries.needed("MAXI_DEPLACEMENT"), float(np.mean(np.diff(times))),
        entries.get("PRECISION"),
        BEND,
    )  # fmt: skip


def _work(entries: Entries) -> Entries:
    """The entries of WTABLE, of an empty one if there is none."""
    table = entries.get("WTABLE") or Table()
    return Entries(entries.call, table, "CONTINU", "TAB1.WTABLE")


@dataclass(frozen=True, eq=False)
class Begin:
    """Where a branch starts: U (r,), t, way there (U, t) or None, number of the last result."""

    u: FloatArray
    t: float
    way: tuple[FloatArray, float] | None
    number: int


def continue_harmonics(entries: Entries) -> None:
    """Follow the branch and fill the tables."""
    names = known_names(entries)
    problem = _problem(entries, names)
    times = np.asarray(entries.needed("TEMPS_CALCULES").values)
    if law := problem.samples:
        still = np.ones((len(problem.basis.values), problem.places.shape[1]))
        problem.timed = bool((law(still, times[0])[0] != law(still, times[-1])[0]).any())
    tracer = Tracer(problem, lengths_of(entries))
    begin = _begin(entries, problem, float(times[0]))
    if begin.way is None:
        first = tracer.first(begin.u, begin.t)
    else:
        first = tracer.turned(tracer.first(begin.u, begin.t), *begin.way)
    low, high = float(times[0]), float(times[-1])
    branch = tracer.follow(first, entries.get("MAXIPAS"), lambda t: low <= t <= high, land=True)
    if branch.ended == "no solution":
        entries.warn("operators.modal.branch-lost", t=branch.points[-1].t)
    _fill(entries, problem, tracer, branch, begin, names)


# --- the problem -------------------------------------------------------------------------------


def _problem(entries: Entries, names: Names) -> FrequencyProblem:
    words = ("RIGIDITE_HBM", "AMORTISSEMENT_HBM", "MASSE_HBM")
    K, C, M = (entries.needed(w) for w in words)
    whole = together(K, entries.get("BLOCAGES_HBM") or Matrix(K.table))
    numbering = assembly.numbering_of(whole, C, M)
    rows = assembly.constraint_matrix(whole, numbering)
    load: Load | None = entries.get("CHARGEMENT")
    loading = loading_of(load, numbering, rows.multipliers)
    if loading.imposed.any():
        raise entries.error("operators.modal.imposed-displacements-not-go")
    constraints = constraints_of(rows, numbering.size <= 160)
    law = entries.get("FREQUENCE")
    found, samples = nonlinear_unknowns(entries), None
    order = entries.get("N_PT_TFR")
    least = int(np.ceil(np.log2(4 * names.places)))
    count = 2 ** (order if order is not None else least)
    if count < 2 * names.harmonics + 1:
        raise entries.error(
            "operators.modal.too-few-instants", order=order, count=count, harmonics=names.harmonics
        )
    places = np.zeros((names.places, 0), dtype=np.int64)
    if found is not None:
        samples = Sampled(entries, *found)
        places = _places(entries, numbering, names, *found)
    return FrequencyProblem(
        numbering, assembly.assemble(whole, numbering),
        assembly.assemble(C, numbering), assembly.assemble(M, numbering),
        constraints.T, loading, float if law is None else law.at,
        basis_of(names.harmonics, count), places, samples,
    )  # fmt: skip


def _places(
    entries: Entries, numbering: assembly.Numbering, names: Names, point: Point, unknowns: list[str]
) -> IntArray:
    wrong = [u for u in unknowns if u not in names.unknowns]
    if wrong:
        raise entries.error(
            "operators.modal.no-such-unknown", wrong=wrong[0], unknowns=names.unknowns
        )
    found = [
        [numbering.index_of(point.node, names.coefficient(u, p)) for u in unknowns]
        for p in range(names.places)
    ]
    places = np.array(found, dtype=np.int64)
    if (places < 0).any():
        raise entries.error("operators.modal.matrices-no-unknowns-point")
    return places


# --- start and results -------------------------------------------------------------------------


def _begin(entries: Entries, problem: FrequencyProblem, first: float) -> Begin:
    """The last result, where there is one; else DEPLACEMENTS . 0 at the first time."""
    number = max(entries.numbers("DEPLACEMENTS"), default=0)
    known = entries.at("DEPLACEMENTS", number)
    time = entries.at("TEMPS", number)
    again = time is not None and entries.has("TEMPS_PROG")
    work = _work(entries)
    way = None
    if work.has("DTIME0") and work.has("DDEP0"):
        moved = _reduced(problem, work.needed("DDEP0"))
        way = (moved, float(work.needed("DTIME0")))
    u = np.zeros(problem.T.shape[1]) if known is None else _reduced(problem, known)
    if again:
        return Begin(u, float(time), way, number)
    return Begin(u, first, way, -1)


def _reduced(problem: FrequencyProblem, field: NodeField) -> FloatArray:
    """What is left of a field of coefficients by the supports, (r,)."""
    u = assembly.field_to_vector(field, problem.numbering, dual=False)
    T = problem.T
    gram = sp.csr_array(T.T @ T).toarray()
    return np.asarray(np.linalg.solve(gram, T.T @ u))


def _fill(
    entries: Entries, problem: FrequencyProblem, tracer: Tracer, branch: Branch, begin: Begin,
    names: Names,
) -> None:  # fmt: skip
    table, again = entries.table, begin.number >= 0
    points = branch.points[1:] if again else branch.points
    if again and not points:
        return
    all_times = longer(table, "TEMPS_PROG", np.array([p.t for p in points]))
    every = entries.get("PAS_SAUVES")
    times, fields = table.inner("TEMPS"), table.inner("DEPLACEMENTS")
    number = begin.number
    for i, point in enumerate(points):
        if i % every == 0 or i == len(points) - 1:
            number += 1
            times.set(number, float(point.t))
            fields.set(number, _field(problem, point.u))
    _say_way(table, problem, branch)
    _curves(entries, problem, points, all_times)
    _stability(entries, problem, tracer, points, again, names)


def _field(problem: FrequencyProblem, u: FloatArray) -> NodeField:
    return assembly.vector_to_field(problem.T @ u, problem.numbering)


def _say_way(table: Table, problem: FrequencyProblem, branch: Branch) -> None:
    """WTABLE . DTIME0 DDEP0: the last increment, from which a further call goes on."""
    if len(branch.points) < 2:
        return
    work = table.inner("WTABLE")
    before, last = branch.points[-2:]
    work.set(Mot("DTIME0"), float(last.t - before.t))
    work.set(Mot("DDEP0"), _field(problem, last.u - before.u))


def _curves(
    entries: Entries, problem: FrequencyProblem, points: list[Solution], times: FloatArray
) -> None:
    """Lists and curves of the results asked for."""
    asked_all = asked_results(entries, "RESULTATS_HBM")
    if not asked_all:
        return
    U = np.array([problem.T @ p.u for p in points])
    curves = []
    for asked in asked_all:
        place = problem.numbering.index_of(asked.point.node, asked.component)
        values = np.zeros(len(points)) if place < 0 else U[:, place]
        whole = longer(asked.table, "RESULTATS", values)
        drawn = curve(times, whole, ("t", asked.component), asked.title, asked.colour)
        asked.table.set(Mot("RESULTATS_EVOL"), drawn)
        curves.append(drawn)
    inner = entries.needed("RESULTATS_HBM")
    inner.set(Mot("RESULTATS_EVOL"), joined(curves))
    inner.set(Mot("TITRE"), Table.numbered([Mot(a.title) for a in asked_all]))


def _stability(
    entries: Entries, problem: FrequencyProblem, tracer: Tracer, points: list[Solution],
    again: bool, names: Names,
) -> None:  # fmt: skip
    """RESULTATS_STABILITE at all points but the last, which a further call starts from."""
    asked = entries.get("STABILITE")
    words = [w.strip() for w in asked.values] if isinstance(asked, ListMots) else []
    words = ["FLOQ"] if asked is True else words
    wrong = [w for w in words if w not in STABILITY]
    if wrong:
        raise entries.error(
            "operators.modal.stability-not-known", wrong=wrong[0], stability=STABILITY
        )
    if not words:
        return
    inner = entries.table.inner("RESULTATS_STABILITE")
    seen = points[:-1]
    if again:  # the last point of the call before was left out
        first = _begin_again(entries, problem, tracer, len(points))
        seen = [first, *seen] if first is not None else seen
    if "DIAG" in words:
        counts = [float((np.linalg.eigvals(p.jacobian).real < 0).sum()) for p in seen]
        longer(inner, "DIAG", np.array(counts))
    if "FLOQ" in words or "HILL" in words:
        _floquet(entries, problem, seen, inner)


def _begin_again(
    entries: Entries, problem: FrequencyProblem, tracer: Tracer, new: int
) -> Solution | None:
    times = np.asarray(entries.needed("TEMPS_PROG").values)
    numbers = entries.numbers("DEPLACEMENTS")
    at = float(times[len(times) - new - 1])
    for number in sorted(numbers, reverse=True):
        if entries.at("TEMPS", number) == at:
            return tracer.first(_reduced(problem, entries.at("DEPLACEMENTS", number)), at)
    return None


def _floquet(
    entries: Entries, problem: FrequencyProblem, points: list[Solution], inner: Table
) -> None:
    of = _exponents(entries, problem)
    found = np.array([of(p) for p in points])
    table = inner.inner("FLOQ")
    for word, values in (("EXPOSANT_REEL", found.real), ("EXPOSANT_IMAG", found.imag)):
        lists = table.inner(word)
        for i, column in enumerate(values.T, start=1):
            longer(lists, i, column)
    states = [
        int(unstable(e, max(problem.frequency(p.t), 1e-12)))
        for e, p in zip(found, points, strict=True)
    ]
    known = table.get("STABILITE")
    past = list(known.values) if isinstance(known, ListEnti) else []
    table.set(Mot("STABILITE"), ListEnti(np.array([*past, *states], dtype=np.int64)))


def _exponents(entries: Entries, problem: FrequencyProblem) -> Callable[[Solution], FloatArray]:
    """Floquet exponents of a solution, from the matrices of the motion itself."""
    words = ("RIGIDITE_CONSTANTE", "AMORTISSEMENT_CONSTANT", "MASSE_CONSTANTE")
    K, C, M = (entries.get(w) for w in words)
    if K is None or M is None:
        raise entries.error("operators.modal.stability-wants-rigidite-constante")
    C = Matrix(K.table) if C is None else C
    whole = together(K, entries.get("BLOCAGES_MECANIQUES") or Matrix(K.table))
    numbering = assembly.numbering_of(whole, C, M)
    rows = assembly.constraint_matrix(whole, numbering)
    T = constraints_of(rows, numbering.size <= 160).T.toarray()
    k, c, m = (T.T @ assembly.assemble(x, numbering).toarray() @ T for x in (whole, C, M))
    if np.linalg.matrix_rank(m) < len(m):
        raise entries.error("operators.modal.masse-constante-not-regular")
    found = nonlinear_unknowns(entries)
    at = [] if found is None else [numbering.index_of(found[0].node, n) for n in found[1]]
    rows_of = T[at]

    def of(point: Solution) -> FloatArray:
        stiffness = np.broadcast_to(k, (len(problem.basis.values), *k.shape))
        if at:
            stiffness = k + np.einsum(
                "ia,tij,jb->tab", rows_of, problem.sampled(point.u, point.t)[1], rows_of
            )
        damping = np.broadcast_to(c, stiffness.shape)
        w = problem.frequency(point.t)
        if w <= 0.0:  # at rest: as if the period were that of one unit
            damping, stiffness = damping[:1], stiffness.mean(axis=0, keepdims=True)
        return exponents(m, damping, stiffness, w if w > 0.0 else 1.0)

    return of

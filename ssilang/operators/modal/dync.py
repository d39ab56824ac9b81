"""DYNC: branches of periodic motions on modes by harmonic balance and continuation."""

from ssilang.kernel.continuation.arc import Lengths
from ssilang.kernel.continuation.harmonics import LinkForces, Oscillators, basis_of
from ssilang.kernel.continuation.response import Response, forced_response, normal_mode
from ssilang.kernel.matrices.assembly import field_to_vector
from ssilang.operators.modal.dyne import (
    TABLES,
    System,
    damping_of,
    system_of,
    tables_by_role,
)
from ssilang.operators.modal.dyne_links import links_of
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

_ROLES = {
    "TMOD": "system", "TCHR": "loads", "TLIAI": "links", "TAMOR": "damping", "TINI": "start",
    "TNUM": "numbers",
}  # fmt: skip


@operator("DYNC", family="modal")
def _dync(
    call: Call,
    given: tuple[Table, ...] = TABLES,
    harmonics: int = Arg("ENTIER", range=POSITIVE, en="number of harmonics"),
    samples: int = Arg("ENTIER", range=POSITIVE, en="instants of a period"),
) -> Table:
    tables = tables_by_role(call, given, _ROLES)
    for role, name in (("system", "BASE_MODALE"), ("numbers", "PARAMETRES_NUMERIQUES")):
        if role not in tables:
            raise call.error("operators.modal.table-wanted", name=name)
    if "start" not in tables:
        raise call.error("operators.modal.start-wanted")
    if samples < 2 * (2 * harmonics + 1):
        told = {"harmonics": harmonics, "least": 2 * (2 * harmonics + 1), "samples": samples}
        raise call.error("operators.modal.instants-for-harmonics", **told)
    system = system_of(call, tables["system"])
    numbers = Entries(call, tables["numbers"], "DYNC", "TNUM")
    kind = str(numbers.get("TYPE"))
    oscillators = _oscillators(call, tables, system, harmonics, samples, kind == "NNM")
    lengths, most = _lengths(numbers), int(numbers.get("NBPAS"))
    start = Entries(call, tables["start"], "DYNC", "TINI")
    end = numbers.needed("VAL_FIN")
    if kind == "NNM":
        mode = start.get("MODE") - 1
        if mode >= len(system.M):
            raise call.error("operators.modal.no-such-mode", tables["start"], n_M=len(system.M))
        found = normal_mode(oscillators, mode, start.needed("ENERGIE"), end, lengths, most)
    else:
        first, sense = start.needed("FREQUENCE"), numbers.get("ISENS")
        guess = _guess(call, tables["start"], system, oscillators, first)
        found = forced_response(oscillators, guess, first, end, sense, lengths, most)
    return _results(call, found, system, kind == "NNM")


def _oscillators(
    call: Call, tables: dict[str, Table], system: System, harmonics: int, samples: int, free: bool
) -> Oscillators:
    n = len(system.M)
    forces = LinkForces(links_of(call, tables.get("links"), system.basis)[1])
    load = np.zeros((2 * harmonics + 1, n))
    table = tables.get("loads")
    unbalance = False
    if table is not None and not free:
        load = _coefficients(call, table, system, harmonics, dual=True)
        unbalance = bool(table.get(Mot("BALOURD"), 0))
    damping = np.zeros((n, n)) if free else damping_of(call, tables.get("damping"), system)
    basis = basis_of(harmonics, samples)
    return Oscillators(system.M, damping, system.K, basis, forces, load, unbalance)


def _coefficients(
    call: Call, table: Table, system: System, harmonics: int, dual: bool
) -> FloatArray:
    """Fields at the indices 0, +j (cosine) and -j (sine) as coefficients (2 H + 1, n)."""
    out = np.zeros((2 * harmonics + 1, len(system.M)))
    for index, value in table.items():
        if type(index) is not int or isinstance(value, Annule):
            continue
        if abs(index) > harmonics:
            raise call.error(
                "operators.modal.no-such-harmonic", table, index=index, harmonics=harmonics
            )
        assert isinstance(value, NodeField)  # the table is checked
        place = 0 if index == 0 else 2 * abs(index) - (1 if index > 0 else 0)
        out[place] = field_to_vector(value, system.numbering, dual=dual)
    return out


def _guess(
    call: Call, table: Table, system: System, oscillators: Oscillators, w: float
) -> FloatArray:
    """What INITIAL says, or else the linear response."""
    said = _coefficients(call, table, system, oscillators.basis.harmonics, dual=False)
    if said.any():
        return said
    Z, _ = oscillators.linear(w)
    load = oscillators.load * (w * w if oscillators.unbalance else 1.0)
    return np.asarray(np.linalg.lstsq(Z, load.ravel(), rcond=None)[0].reshape(said.shape), float)


def _lengths(numbers: Entries) -> Lengths:
    start = numbers.get("DS0")
    least, most = numbers.get("DSMIN") or 1e-3 * start, numbers.get("DSMAX") or 10 * start
    if not least <= start <= most:
        raise numbers.call.error("operators.modal.steps-of-dync", numbers.table)
    return Lengths(
        start, least, most, numbers.get("ITERMOY"), round(numbers.get("ITERMAX")),
        tolerance=numbers.get("TOLERANCE"), bend=float(np.radians(numbers.get("ANGLE_MAX"))),
    )  # fmt: skip


# --- results -----------------------------------------------------------------------------------


def _results(call: Call, found: Response, system: System, free: bool) -> Table:
    if found.ended == "no solution":
        call.session.warn(
            "operators.modal.branch-lost", call.span, operator="DYNC", t=found.frequencies[-1]
        )
    entries = {"REPONSE": _response(found, system, free), "BIFURCATION": _bifurcations(found)}
    return Table.of(entries, "RESULTAT_DYNC")


def _response(found: Response, system: System, free: bool) -> Table:
    Q = np.array(found.coefficients)
    exponents = np.array(found.exponents)
    assert system.basis.shapes is not None
    marks = [shape.mark for shape in system.basis.shapes]
    by_order = Table()
    for place in range(Q.shape[1]):
        order = (place + 1) // 2 * (1 if place % 2 else -1)
        histories = (ListReel(values.copy()) for values in Q[:, place].T)
        by_order.set(order, Table.of(zip(marks, histories, strict=True)))
    entries: dict[str, Any] = {
        "FREQUENCE": ListReel(np.array(found.frequencies)),
        "COEFFICIENTS": by_order,
        "NORME_DEPLACEMENT": ListReel(np.linalg.norm(Q.reshape(len(Q), -1), axis=1)),
        "STABILITE": ListEnti(np.array([int(u) for u in found.unstable], dtype=np.int64)),
        "EXPOSANT_REEL": _numbered(exponents.real),
        "EXPOSANT_IMAGINAIRE": _numbered(exponents.imag),
    }
    if free:
        entries["ENERGIE"] = ListReel(np.array(found.energies))
    return Table.of(entries)


def _numbered(columns: FloatArray) -> Table:
    return Table.numbered(ListReel(column.copy()) for column in np.asarray(columns).T)


def _bifurcations(found: Response) -> Table:
    all_found = found.bifurcations
    norms = [float(np.linalg.norm(b.coefficients)) for b in all_found]
    entries: dict[str, Any] = {
        "TYPE": ListMots([b.kind for b in all_found]),
        "NORME_DEPLACEMENT": ListReel(np.array(norms)),
        "FREQUENCE": ListReel(np.array([b.frequency for b in all_found])),
        "KAPPA": ListReel(np.array([b.new_frequency for b in all_found])),
    }
    vectors = {
        "VECTEUR_REEL": [b.vector.real for b in all_found],
        "VECTEUR_IMAGINAIRE": [b.vector.imag for b in all_found],
        "COEFFICIENTS": [b.coefficients.ravel() for b in all_found],
    }
    for name, rows in vectors.items():
        entries[name] = Table.numbered(ListReel(np.array(row, dtype=float)) for row in rows)
    return Table.of(entries)

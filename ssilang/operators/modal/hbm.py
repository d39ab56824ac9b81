"""ZHBM: matrices of harmonic balance (procedure HBM); ZHPO: results in time (HBM_POST).

Tables of HBM, CONTINU and HBM_POST: results asked for, curves, entries by number.
"""

from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.kernel.continuation import expansion
from ssilang.kernel.continuation.expansion import Names, names_of
from ssilang.kernel.continuation.harmonics import basis_at
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries


@dataclass(frozen=True, eq=False)
class Drawn:
    """A result: its table, title and colour."""

    table: Table
    title: str
    colour: int


@dataclass(frozen=True, eq=False)
class Asked(Drawn):
    """A result asked for at a point, in a component."""

    point: Point
    component: str


def asked_results(entries: Entries, index: str) -> list[Asked]:
    """Results 1, 2 ... of the table at an index; none without it."""
    return [_asked(entries, own, place) for own, place in _numbered(entries, index)]


def _numbered(entries: Entries, index: str) -> Iterator[tuple[Entries, str]]:
    inner = entries.get(index) or Table()
    given = ((i, v) for i, v in inner.items() if type(i) is int and not isinstance(v, Annule))
    for i, table in sorted(given):
        assert isinstance(table, Table)  # the whole table is checked
        yield Entries(entries.call, table, entries.procedure, f"TAB1.{index}.I"), f"{index} . {i}"


def _drawn(own: Entries, component: str) -> tuple[Table, str, int]:
    name = str(own.table.get("COULEUR") or "").strip().upper()[:4]
    title = str(own.get("TITRE") or component).rstrip()
    return own.table, title, (index_of(name) if name in COLOURS else 0)


def _asked(entries: Entries, own: Entries, place: str) -> Asked:
    point: Point = own.needed("POINT_MESURE")
    word = "COMPOSANTE" if own.has("COMPOSANTE") else "COMPOSANTES"
    given = own.needed(word)
    words = given.values if isinstance(given, ListMots) else [str(given)]
    if not words or not words[0].strip():
        raise entries.error("operators.modal.component-wanted", place=place, word=word)
    return Asked(*_drawn(own, words[0]), point, words[0].rstrip())


def curve(x: FloatArray, y: FloatArray, names: tuple[str, str], title: str, colour: int) -> Curve:
    """One curve."""
    return Curve((CurvePart(x.copy(), y.copy(), names[0], names[1], title, colour),), title)


def joined(curves: Sequence[Curve]) -> Curve:
    """All curves as one object."""
    return Curve(tuple(p for c in curves for p in c.parts))


def longer(table: Table, index: str | int, values: FloatArray) -> FloatArray:
    """The list at an index with more values behind, also set there."""
    known = table.get(index)
    whole = np.concatenate([known.values, values]) if isinstance(known, ListReel) else values
    index = Mot(index) if isinstance(index, str) else index
    table.set(index, ListReel(np.array(whole, dtype=float)))
    return np.asarray(whole)


MATRICES = {
    "RIGIDITE_HBM": ("RIGIDITE_CONSTANTE", expansion.stiffness_terms),
    "AMORTISSEMENT_HBM": ("AMORTISSEMENT_CONSTANT", expansion.damping_terms),
    "MASSE_HBM": ("MASSE_CONSTANTE", expansion.mass_terms),
    "BLOCAGES_HBM": ("BLOCAGES_MECANIQUES", expansion.stiffness_terms),
    # a perturbation that grows as exp(a t) meets Z + a (MASSE_HBM_1 w + AMORTISSEMENT_HBM_1)
    # + a^2 MASSE_HBM_2
    "MASSE_HBM_1": ("MASSE_CONSTANTE", lambda h: 2.0 * expansion.damping_terms(h)),
    "MASSE_HBM_2": ("MASSE_CONSTANTE", expansion.stiffness_terms),
    "AMORTISSEMENT_HBM_1": ("AMORTISSEMENT_CONSTANT", expansion.stiffness_terms),
}


def known_names(entries: Entries) -> Names:
    """Unknowns and harmonics of a table given to HBM."""
    harmonics = entries.needed("N_HARMONIQUE")
    given = [m for source, _ in MATRICES.values() if (m := entries.get(source)) is not None]
    return names_of(given, harmonics)


@operator("ZHBM", family="modal")
def zhbm(call: Call, table: Table = Arg("TABLE", en="table of HBM")) -> None:
    """Read the matrices of the motion, add those of its coefficients."""
    entries = Entries(call, table, "HBM")
    names = known_names(entries)
    for index, (source, terms) in MATRICES.items():
        given = entries.get(source)
        if given is None:
            given = Matrix(entries.needed("MASSE_CONSTANTE").table)
        if index == "BLOCAGES_HBM":
            given = Matrix(given.table, given.blocks, given.relations)
        elif index not in ("RIGIDITE_HBM",):
            given = Matrix(given.table, given.blocks, (), given.kind)
        entries.table.set(Mot(index), expansion.expanded(given, names, terms(names.harmonics)))
    entries.table.set(Mot("HBM"), True)
    _components(entries, names)
    _results(entries, names)


def _components(entries: Entries, names: Names) -> None:
    places = range(names.places)
    primal = [[names.coefficient(u, p) for u in names.unknowns] for p in places]
    dual = [[names.coefficient(u, p, True) for u in names.unknowns] for p in places]
    table: dict[str, Any] = {"DEPLACEMENT": ListMots(list(names.unknowns))}
    table["FORCE"] = ListMots(list(names.duals))
    for word, found in (("DEPLACEMENT", primal), ("FORCE", dual)):
        table[f"{word}_HBM"] = ListMots([n for row in found for n in row])
        rows = {k: found[max(2 * k - 1, 0) : 2 * k + 1] for k in range(names.harmonics + 1)}
        by_harmonic = {k: ListMots([n for r in own for n in r]) for k, own in rows.items()}
        table[f"HARM_{word}"] = Table.of(by_harmonic)
    entries.table.set(Mot("COMPOSANTES"), Table.of(table))


def _results(entries: Entries, names: Names) -> None:
    """RESULTATS_HBM, one a coefficient of each result, and INDICES_HBM of the results."""
    found, number, titles = Table(), 0, []
    for asked in asked_results(entries, "RESULTATS"):
        if asked.component not in names.unknowns:
            told = {"component": asked.component, "unknowns": names.unknowns}
            raise entries.error("operators.modal.no-such-component", **told)
        given = asked.table.get("COULEUR_HBM")
        own = range(number + 1, number + 1 + names.places)
        for place, number in enumerate(own):
            titles.append(_title(asked.title, place))
            found.set(number, _coefficient(asked, names, place, titles[-1], given))
        asked.table.set(Mot("INDICES_HBM"), ListEnti(np.array(own, dtype=np.int64)))
    if number:
        found.set(Mot("TITRE"), Table.numbered([Mot(t) for t in titles]))
        entries.table.set(Mot("RESULTATS_HBM"), found)


def _title(title: str, place: int) -> str:
    return (
        title
        + (" 0" if place == 0 else f" {'sin' if place % 2 == 0 else 'cos'}")
        + (f" {(place + 1) // 2}" if place else "")
    )


def _coefficient(asked: Asked, names: Names, place: int, title: str, given: object) -> Table:
    coefficient = Mot(names.coefficient(asked.component, place))
    table: dict[str, Any] = {"POINT_MESURE": asked.point, "COMPOSANTES": coefficient}
    table["TITRE"] = Mot(title)
    words = given.values if isinstance(given, ListMots) and given.values else None
    own = asked.table.get("COULEUR") if words is None else Mot(words[place % len(words)])
    return Table.of(table if own is None else table | {"COULEUR": own})


# --- HBM_POST ----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Motion:
    """Coefficients (n_points, 2 H + 1) of one result along a branch, t and w there."""

    coefficients: FloatArray
    times: FloatArray
    frequencies: FloatArray


@operator("ZHPO", family="modal")
def zhpo(
    call: Call,
    table: Table = Arg("TABLE", en="table of HBM_POST"),
    results: ListMots = Arg("LISTMOTS", en="MAXI, TEMP, VITE"),
) -> None:
    """Maxima, motions and velocities from the coefficients."""
    entries = Entries(call, table, "HBM_POST")
    wanted = [w.strip().upper()[:4] for w in results.values]
    wrong = [w for w in wanted if w not in ("MAXI", "TEMP", "VITE")]
    if wrong:
        raise entries.error("operators.modal.unknown-result", wrong=wrong[0])
    harmonics = entries.needed("N_HARMONIQUE")
    count = entries.get("N_PT_POST") or 2**7 * harmonics
    shares = np.arange(count + 1) / count
    values, rates = basis_at(harmonics, 2 * np.pi * shares)
    every = entries.get("PAS_SAUVES")
    curves, titles = [], []
    for own, _ in _numbered(entries, "RESULTATS"):
        asked = Drawn(*_drawn(own, str(own.table.get("COMPOSANTES") or "U")))
        motion = _motion(entries, asked)
        if "MAXI" in wanted:
            largest = np.abs(motion.coefficients @ values.T).max(axis=1)
            curves.append(curve(motion.times, largest, ("t", "MAXI"), asked.title, asked.colour))
            titles.append(Mot(asked.title))
        if "TEMP" in wanted or "VITE" in wanted:
            asked.table.set(
                Mot("RESULTATS_TEMPORELS"),
                _in_time(motion, asked, (shares, values, rates), wanted, every),
            )
    shown = entries.table.get("RESULTATS")
    if curves and isinstance(shown, Table):
        shown.set(Mot("RESULTATS_EVOL"), joined(curves))
        entries.table.set(Mot("RESULTATS_EVOL"), joined(curves))
        shown.set(Mot("TITRE"), Table.numbered(titles))


def _motion(entries: Entries, asked: Drawn) -> Motion:
    own = Entries(entries.call, asked.table, "HBM_POST", "TAB1.RESULTATS.I")
    numbers = own.needed("INDICES_HBM").values
    found = entries.needed("RESULTATS_HBM")
    lists = []
    for j in numbers:
        inner = found.get(int(j))
        values = inner.get("RESULTATS") if isinstance(inner, Table) else None
        if not isinstance(values, ListReel):
            raise entries.error("operators.modal.no-harmonic-results", j=j)
        lists.append(np.asarray(values.values))
    times = np.asarray(entries.needed("TEMPS_PROG").values)
    law = entries.get("FREQUENCE")
    frequencies = times if law is None else np.array([law.at(float(t)) for t in times])
    return Motion(np.stack(lists, axis=1), times, frequencies)


def _in_time(
    motion: Motion, asked: Drawn, period: tuple[FloatArray, FloatArray, FloatArray],
    wanted: list[str], every: int,
) -> Table:  # fmt: skip
    shares, values, rates = period
    table = Table()
    for i in range(0, len(motion.times), every):
        row = motion.coefficients[i]
        if "TEMP" in wanted:
            y = values @ row
            table.set(i + 1, curve(shares, y, ("t/T", "U"), asked.title, asked.colour))
        if "VITE" in wanted:
            y = motion.frequencies[i] * (rates @ row)
            table.set(-i - 1, curve(shares, y, ("t/T", "V"), asked.title, asked.colour))
    return table

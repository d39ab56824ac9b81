"""Reading the entries of a procedure's table by what is declared of them."""

from contextlib import contextmanager

from ssilang.kernel.stepping.times import every, nearest
from ssilang.language.vocabulary.entries import NUMBER, TableEntry
from ssilang.language.vocabulary.entry_checks import TableCheck, checked, shown
from ssilang.operators.prelude import *


class Entries:
    """The entries of a table given to a procedure.

    Types, defaults and allowed words are those declared in `stdlib/PROCEDURE.toml`. An index that
    the procedure does not declare is never read: functions shared by several procedures ask for
    what some of them do not have.

    Parameters
    ----------
    procedure : str
        Whose declaration it is; its name in messages.
    path : str
        Where the table is declared: the argument, or the argument and indices, with dots.
    """

    def __init__(self, call: Call, table: Table, procedure: str, path: str = "TAB1") -> None:
        self.call, self.table, self.procedure = call, table, procedure
        self.path = tuple(path.split("."))
        declared = call.session.library.declared(procedure)
        assert declared is not None, f"{procedure} declares no entries"
        self.declared = declared

    def inside(self, index: str | int) -> "Entries | None":
        """The entries of the table at an index, None if there is none."""
        table = self.get(index)
        if not isinstance(table, Table):
            return None
        step = NUMBER if isinstance(index, int) else index
        return Entries(self.call, table, self.procedure, ".".join((*self.path, step)))

    def check(self) -> None:
        """Check the whole table, as those among the arguments of a procedure are."""
        check = TableCheck(self.call.session, self.declared, self.place)
        check.run(self.table, self.path, self.path)

    def _declared(self, index: str | int) -> TableEntry | None:
        return self.declared.at(self.path, index)

    def has(self, index: str | int) -> bool:
        """Whether the entry is given (and not ANNULE)."""
        return self.table.has(index) and not isinstance(self.table.get(index), Annule)

    def get(self, index: str | int) -> Any:
        """The value at an index; where it is not given its default, None without one.

        Raises
        ------
        SsiError
            If it is of no declared type, no allowed word, or holds values that are not finite.
        """
        entry = self._declared(index)
        if entry is None:
            return None
        if not self.has(index):
            return entry.fallback
        where = (*self.path, index)
        try:
            return checked(
                self.call.session, entry, self.table.get(index), where,
                procedure=self.procedure, operator=self.procedure,
            )  # fmt: skip
        except SsiError as error:
            error.span = self.call.span
            raise

    def default(self, index: str) -> Any:
        """What counts where an entry is not given."""
        entry = self._declared(index)
        assert entry is not None
        return entry.fallback

    def times(self, index: str) -> FloatArray | None:
        """Instants (n,) that increase, two at least; None if the entry is not given."""
        given = self.get(index)
        if given is None:
            return None
        values = np.asarray(given.values, dtype=float)
        if len(values) < 2:
            raise self.error("operators.tables.few-instants", index=index, count=len(values))
        self.increasing(index, values)
        return values

    def increasing(self, index: str, values: FloatArray) -> None:
        """Refuse instants (n,) of an entry that do not increase."""
        wrong = np.flatnonzero(np.diff(values) <= 0.0)
        if len(wrong):
            i = int(wrong[0])
            raise self.error(
                "operators.tables.instants-not-increasing", index=index, value=values[i + 1],
                before=values[i], place=i + 1, next_place=i + 2,
            )  # fmt: skip

    @contextmanager
    def about(self, index: str) -> Iterator[None]:
        """What is wrong inside is wrong with an entry: the message names it."""
        try:
            yield
        except KernelError as problem:
            raise self.error("refused-entry", index=index, problem=problem) from problem

    def needed(self, index: str | int) -> Any:
        """The value at an index that must be there."""
        value = self.get(index)
        if value is None:
            raise self.call.error(
                "entry-missing", procedure=self.procedure, where=shown((*self.path, index))
            )
        return value

    def flag(self, index: str) -> bool:
        """A LOGIQUE; FAUX where neither the table nor the declaration says anything."""
        return self.get(index) is True

    def numbers(self, index: str) -> list[int]:
        """Integer indices of the table at an index, none if there is no table."""
        inner = self.table.get(index)
        return [i for i, _ in inner.items() if type(i) is int] if isinstance(inner, Table) else []

    def at(self, index: str, number: int) -> Any:
        """`TAB1 . index . number`, None if there is none."""
        inner = self.table.get(index)
        if not isinstance(inner, Table) or not inner.has(number):
            return None
        path = ".".join((*self.path, index))
        return Entries(self.call, inner, self.procedure, path).get(number)

    def forget_after(self, number: int) -> None:
        """Remove the results of higher numbers."""
        for _, inner in self.table.items():
            if isinstance(inner, Table):
                for i, _ in inner.items():
                    if type(i) is int and i > number:
                        inner.remove(i)

    def refuse(self, wrong: Mapping[str, str]) -> None:
        """Refuse entries that have no effect here; `wrong` has the code that says why, by index.

        A LOGIQUE at FAUX asks for nothing and passes.
        """
        for index, code in wrong.items():
            if self.has(index) and self.table.get(index) is not False:
                raise self.error(
                    "operators.tables.entry-not-available", index=index, reason=Sentence(code)
                )

    def saved_steps(self, suffix: str, times: FloatArray) -> NDArray[np.bool_]:
        """Steps asked for by PAS_SAUVES(suffix) or TEMPS_SAUVES(suffix), shape (n_times,)."""
        wanted = self.get("TEMPS_SAUVES" + suffix)
        if wanted is not None:
            with self.about("TEMPS_SAUVES" + suffix):
                return self.nearest("TEMPS_SAUVES" + suffix, times, wanted.values)
        cadence = self.get("PAS_SAUVES" + suffix)
        if isinstance(cadence, int):
            if self.has("PAS_SAUVES" + suffix) and cadence > (count := len(times) - 1):
                told = {"index": "PAS_SAUVES" + suffix, "cadence": cadence, "count": count}
                self.warn("operators.tables.cadence-beyond-end", **told)
            with self.about("PAS_SAUVES" + suffix):
                return every(times, cadence)
        saved = np.full(len(times), cadence == "TOUS")
        saved[-1] = cadence is not None
        return saved

    def nearest(self, index: str, times: FloatArray, wanted: FloatArray) -> NDArray[np.bool_]:
        """Steps nearest to the instants of an entry; told where several have the same one."""
        chosen = nearest(times, wanted)
        count = int(chosen.sum())
        if count < len(wanted):
            told = {"index": index, "count": count, "wanted": len(wanted)}
            self.warn("operators.tables.instants-of-one-step", **told)
        return chosen

    def error(self, code: str, /, **data: object) -> SsiError:
        """An error of the procedure."""
        return self.call.error(code, None, **{"speaker": self.procedure, **data})

    @property
    def place(self) -> Span:
        """Where the script calls the procedure: its own line, not one of the library."""
        return self.call.session.own_place(self.call.span)

    def warn(self, code: str, /, **data: object) -> None:
        """A warning of the procedure."""
        self.call.session.warn(code, self.place, **{"operator": self.procedure, **data})

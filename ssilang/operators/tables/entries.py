"""Reading the entries of a procedure's table: typed, with errors that name the index."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.curve import Curve, Load
from ssilang.kernel.dynamics.plan import every, nearest
from ssilang.kernel.errors import KernelError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.language.call import Call
from ssilang.language.diagnostics import nearest as nearest_word
from ssilang.language.errors import SsiError
from ssilang.language.source import Span
from ssilang.language.values import Annule, ListReel, Table, type_of


class Entries:
    """The entries of a table given to a procedure.

    Parameters
    ----------
    procedure : str
        Name for messages.
    """

    def __init__(self, call: Call, table: Table, procedure: str) -> None:
        self.call, self.table, self.procedure = call, table, procedure

    def has(self, index: str | int) -> bool:
        """Whether the entry is given (and not ANNULE)."""
        return self.table.has(index) and not isinstance(self.table.get(index), Annule)

    def get(self, index: str | int, *types: str) -> Any:
        """The value at an index, None if there is none.

        Raises
        ------
        SsiError
            If it is of none of the types, or holds values that are not finite numbers.
        """
        if not self.has(index):
            return None
        value = self.table.get(index)
        found = type_of(value)
        if found in types:
            self._sound(index, value)
            return value
        if found == "ENTIER" and "FLOTTANT" in types:
            return float(value)  # type: ignore[arg-type]
        raise self.bad(f"'{index}' must be {' or '.join(types)}, found {found}")

    def _sound(self, index: str | int, value: object) -> None:
        """Refuse values that no calculation can use."""
        if isinstance(value, Curve) and not value.parts:
            raise self.bad(f"'{index}' holds no curve")
        if not all(np.isfinite(v).all() for v in _numbers_in(value)):
            raise self.bad(f"'{index}' has values that are not finite numbers")

    def times(self, index: str) -> FloatArray | None:
        """Instants (n,) that increase, two at least; None if the entry is not given."""
        given = self.get(index, "LISTREEL")
        if given is None:
            return None
        values = np.asarray(given.values, dtype=float)
        if len(values) < 2:
            raise self.bad(f"'{index}' has {len(values)} instants", "two instants or more")
        self.increasing(index, values)
        return values

    def increasing(self, index: str, values: FloatArray) -> None:
        """Refuse instants (n,) of an entry that do not increase."""
        wrong = np.flatnonzero(np.diff(values) <= 0.0)
        if len(wrong):
            i = int(wrong[0])
            raise self.bad(
                f"'{index}' does not increase: {values[i + 1]:g} follows {values[i]:g} "
                f"(values {i + 1} and {i + 2})",
                "each instant after the one before it",
            )

    @contextmanager
    def about(self, index: str) -> Iterator[None]:
        """What is wrong inside is wrong with an entry: the message names it."""
        try:
            yield
        except KernelError as problem:
            raise self.error("refused-entry", index=index, problem=problem) from problem

    def needed(self, index: str | int, *types: str) -> Any:
        """The value at an index that must be there."""
        value = self.get(index, *types)
        if value is None:
            raise self.bad(f"the entry '{index}' is missing", f"TAB1 . '{index}' = ... ;")
        return value

    def flag(self, index: str, default: bool = False) -> bool:
        """A LOGIQUE."""
        value = self.get(index, "LOGIQUE")
        return default if value is None else bool(value)

    def numbers(self, index: str) -> list[int]:
        """Integer indices of the table at an index, none if there is no table."""
        inner = self.table.get(index)
        return [i for i, _ in inner.items() if type(i) is int] if isinstance(inner, Table) else []

    def at(self, index: str, number: int, *types: str) -> Any:
        """`TAB1 . index . number`, None if there is none."""
        inner = self.table.get(index)
        if not isinstance(inner, Table) or not inner.has(number):
            return None
        return Entries(self.call, inner, f"{self.procedure}, {index}")._number(number, types)

    def _number(self, number: int, types: tuple[str, ...]) -> Any:
        value = self.table.get(number)
        if type_of(value) not in types:
            found = type_of(value)
            raise self.bad(f"index {number} must be {' or '.join(types)}, found {found}")
        return value

    def forget_after(self, number: int) -> None:
        """Remove the results of higher numbers."""
        for _, inner in self.table.items():
            if isinstance(inner, Table):
                for i, _ in inner.items():
                    if type(i) is int and i > number:
                        inner.remove(i)

    def refuse(self, wrong: Mapping[str, str]) -> None:
        """Refuse entries that have no effect here; `wrong` says why, by index.

        A LOGIQUE at FAUX asks for nothing and passes.
        """
        for index, reason in wrong.items():
            if self.has(index) and self.table.get(index) is not False:
                raise self.bad(f"the entry '{index}' is not available: {reason}")

    def warn_unknown(self, known: Collection[str]) -> None:
        """Say which words of the table are no entries, with the nearest entry."""
        for index, _ in self.table.items():
            if not isinstance(index, str) or str(index).rstrip() in known:
                continue
            near = nearest_word(str(index), known, 0.75)
            if near:
                self.warn(
                    f"'{index}' is no entry of {self.procedure} and has no effect",
                    f"did you mean '{near}'?",
                )

    def saved_steps(
        self, suffix: str, times: FloatArray, default: Callable[[], NDArray[np.bool_]]
    ) -> NDArray[np.bool_]:
        """Steps asked for by PAS_SAUVES(suffix) or TEMPS_SAUVES(suffix), shape (n_times,)."""
        wanted = self.get("TEMPS_SAUVES" + suffix, "LISTREEL")
        if wanted is not None:
            with self.about("TEMPS_SAUVES" + suffix):
                return nearest(times, wanted.values)
        cadence = self.get("PAS_SAUVES" + suffix, "ENTIER", "MOT")
        if cadence is None:
            return default()
        if isinstance(cadence, int):
            with self.about("PAS_SAUVES" + suffix):
                return every(times, cadence)
        word = str(cadence).upper().rstrip()
        if word == "TOUS":
            return np.ones(len(times), bool)
        if word == "FINAL":
            last = np.zeros(len(times), bool)
            last[-1] = True
            return last
        raise self.bad(
            f"'PAS_SAUVES{suffix}' is '{cadence}'", "an ENTIER (one step in N), 'TOUS' or 'FINAL'"
        )

    def error(self, code: str, /, **data: object) -> SsiError:
        """An error of the procedure."""
        return self.call.error(code, None, **{"speaker": self.procedure, **data})

    def bad(self, message: str, hint: str = "") -> SsiError:
        """An error of the procedure, in a sentence that stands in no catalogue yet."""
        return self.call.bad(f"{self.procedure}: {message}", hint=hint)

    @property
    def place(self) -> Span:
        """Where the script calls the procedure: its own line, not one of the library."""
        session, place = self.call.session, self.call.span
        frame = session.frame
        while frame.pending is not None and frame.procedure in session.library.standard_names:
            place = frame.pending.span
            assert frame.caller is not None
            frame = frame.caller
        return place

    def warn(self, code: str, hint: str = "", /, **data: object) -> None:
        """A warning of the procedure."""
        if " " in code:  # a sentence of its own, not yet in a catalogue
            code, data = "bad-value", {"message": code, "hint": hint}
        self.call.session.warn(code, self.place, **{"operator": self.procedure, **data})


def _numbers_in(value: object) -> list[Any]:
    """The numbers that an object holds, as arrays."""
    if isinstance(value, float):
        return [value]
    if isinstance(value, ListReel):
        return [np.asarray(value.values, dtype=float)]
    if isinstance(value, NodeField):
        return [p.values for p in value.components.values()]
    if isinstance(value, Curve):
        return [a for p in value.parts for a in (p.abscissas, p.ordinates)]
    if isinstance(value, Load):
        held = [h for p in value.parts for h in (p.space, p.time, *(f for _, f in p.steps))]
        return [n for h in held for n in _numbers_in(h)]
    return []

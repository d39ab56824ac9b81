"""REPRISE: DYNAMIC and PASAPAS keep their state on the way, and `--resume` goes on from it.

What is kept are the calculation's own state (`kernel.stepping.keeping`), what its observers hold,
and the instants that they were given. An observer that says what it holds (`held`) gets it back
(`hold`); the others are given their instants again.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import IntArray
from ssilang.language.values import Table
from ssilang.messages.message import Sentence
from ssilang.operators.files.outputs import run_output
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.io.checkpoint import Checkpoints, Rows
    from ssilang.kernel.plasticity.bulk import Bulk
    from ssilang.kernel.plasticity.bulk import State as BulkState
    from ssilang.kernel.stepping.keeping import State
    from ssilang.kernel.stepping.problem.problem import Problem
    from ssilang.kernel.stepping.snapshot import Observer, Snapshot

Bodies = tuple["Bulk", "BulkState"]

UNKNOWNS = ("u", "v", "a", "reaction")
POINTS = ("w", "t", "state", "contact")
"""Parts of an instant: those on the unknowns, of which some may do, and the others."""


@runtime_checkable
class Holding(Protocol):
    """An observer that says in plain values and arrays what it holds, and takes it back."""

    def held(self) -> Any:
        """What a checkpoint keeps."""
        ...

    def hold(self, kept: Any) -> None:
        """Go on from a checkpoint."""
        ...


class KeptCalculation:
    """One calculation with its observers, as a `Keeper` and as an observer itself.

    Parameters
    ----------
    observers : sequence of Observer
        Of the calculation.
    every : int
        Steps after which a checkpoint is written, 0: none.
    minutes : float
        Minutes after which one is written, infinity: none.
    bodies : (Bulk, State), optional
        Plastic bodies: instants hold their states too.
    """

    def __init__(
        self, entries: Entries, problem: Problem, observers: Sequence[Observer],
        checkpoints: Checkpoints, every: int, minutes: float, bodies: Bodies | None = None,
    ) -> None:  # fmt: skip
        self.entries, self.problem, self.bodies = entries, problem, bodies
        self.session, self.checkpoints = entries.call.session, checkpoints
        self.every, self.seconds = every, 60.0 * minutes
        self.number, self._known = checkpoints.begin(), ""
        self._holding = [o for o in observers if isinstance(o, Holding)]
        self._given_again = [o for o in observers if not isinstance(o, Holding)]
        self.wanted: NDArray[np.bool_] = np.zeros(len(problem.times), bool)
        for observer in self._given_again:
            self.wanted |= observer.wanted
        self._few = _unknowns_read(problem, self._given_again)
        self._waiting: list[list[Any]] = []
        self._written, self._at = 0, time.monotonic()

    # ---- an observer

    def receive(self, snapshot: Snapshot) -> None:
        """Keep an instant, as far as the observers read it."""
        few = self._few
        found: list[Any] = [snapshot.step]
        whole = [getattr(snapshot, name) for name in UNKNOWNS]
        found += whole if few is None else [x[few] for x in whole]
        found += [getattr(snapshot, name).copy() for name in POINTS]
        if self.bodies is not None:
            from ssilang.kernel.stepping.keeping import leaves

            found += leaves(getattr(snapshot, "bulk_state"))  # noqa: B009
        self._waiting.append(found)

    def close(self) -> None:
        """Nothing to do: what waits goes with the next checkpoint."""

    # ---- a keeper

    def stride(self, done: int, small: bool) -> int:
        """Steps up to the next instant at which the state may be kept."""
        from ssilang.kernel.stepping.keeping import stride_of

        return stride_of(done, small, self.every)

    def steady(self) -> AbstractContextManager[None]:
        """Interruptions wait."""
        return self.session.hold()

    def reached(self, done: int, state: Callable[[], State]) -> None:
        """Write a checkpoint if it is time to."""
        if self.session.was_interrupted():
            raise KeyboardInterrupt
        by_steps = self.every > 0 and done % self.every == 0
        if by_steps or time.monotonic() - self._at >= self.seconds:
            self._write(done, state())

    def left(self, done: int, state: Callable[[], State]) -> None:
        """The run is told to end: write a last checkpoint, and say how to go on."""
        if done > self._written:
            self._write(done, state())
        if self._written:
            self.entries.warn(
                "operators.dynamics.checkpoint-left",
                step=self._written,
                steps=len(self.problem.times) - 1,
                time=self.problem.times[self._written],
                folder=self.checkpoints.folder,
            )

    def finished(self, done: int, state: Callable[[], State]) -> None:
        """Keep the results too: a deck that goes on elsewhere does not step again."""
        if done > self._written:
            self._write(done, state())

    def last(self) -> State | None:
        """What an earlier run kept; the observers get what they had."""
        kept = self.checkpoints.read(self.number)
        if kept is None:
            return None
        self._check(kept.call)
        rows = kept.rows
        for snapshot in self._instants(rows):
            for observer in self._given_again:
                if observer.wanted[snapshot.step]:
                    observer.receive(snapshot)
        for observer, held in zip(self._holding, kept.state["held"], strict=True):
            observer.hold(held)
        self._written, steps = len(rows["energies"]) - 1, len(self.problem.times) - 1
        at = self.problem.times[self._written]
        code = "operators.dynamics.resumed" if self._written < steps else "operators.dynamics.given"
        self.entries.warn(code, step=self._written, steps=steps, time=at)
        state: State = kept.state["own"]
        return state | {"energies": rows["energies"]}

    # ---- files

    def _write(self, done: int, state: State) -> None:
        with self.session.hold():
            first = self._written + 1 if self._written else 0
            rows = self._rows() | {"energies": state["energies"][first:]}
            own = {k: v for k, v in state.items() if k != "energies"}
            held = [o.held() for o in self._holding]
            self.checkpoints.write(self.number, self._call(), {"own": own, "held": held}, rows)
            self._waiting.clear()
            self._written, self._at = done, time.monotonic()

    def _rows(self) -> Rows:
        """The instants that wait, part by part."""
        columns = zip(*self._waiting, strict=True) if self._waiting else ([] for _ in self._blank())
        return {
            name: np.stack([np.asarray(x) for x in column]) if self._waiting else blank
            for (name, blank), column in zip(self._blank(), columns, strict=True)
        }

    def _blank(self) -> Iterator[tuple[str, NDArray[Any]]]:
        """Names of the parts of an instant, with those of no instant."""
        from ssilang.kernel.stepping.keeping import leaves

        p, joints = self.problem, self.problem.interface
        n = p.numbering.size if self._few is None else len(self._few)
        yield "step", np.zeros(0, np.int64)
        for name in UNKNOWNS:
            yield name, np.zeros((0, n))
        shape = (0, 0, 1) if joints is None else (0, joints.n_points, joints.dimension)
        yield "w", np.zeros(shape)
        yield "t", np.zeros(shape)
        yield "state", np.zeros((0, *p.state.shape)) if joints is not None else np.zeros(shape)
        yield "contact", np.zeros((0, 0 if p.contact is None else p.contact.size))
        for i, leaf in enumerate(leaves(self.bodies[1]) if self.bodies is not None else []):
            yield f"body{i}", np.zeros((0, *np.shape(leaf)))

    def _instants(self, rows: Rows) -> Iterator[Snapshot]:
        from ssilang.kernel.plasticity.snapshot import BulkSnapshot
        from ssilang.kernel.stepping.keeping import rebuilt
        from ssilang.kernel.stepping.snapshot import Snapshot

        times, n = self.problem.times, self.problem.numbering.size
        for k, step in enumerate(rows["step"].tolist()):
            parts = {name: rows[name][k] for name in (*UNKNOWNS, *POINTS)}
            if self._few is not None:
                for name in UNKNOWNS:
                    whole = np.zeros(n)
                    whole[self._few] = parts[name]
                    parts[name] = whole
            at = (self.problem, step, float(times[step]))
            if self.bodies is None:
                yield Snapshot(*at, **parts)
                continue
            bulk, start = self.bodies
            leaves = [rows[name][k] for name in rows if name.startswith("body")]
            state = rebuilt(start, [x if x.ndim else float(x) for x in leaves])
            yield BulkSnapshot(*at, **parts, bulk=bulk, bulk_state=state)

    # ---- whose it is

    def _call(self) -> dict[str, Any]:
        from ssilang.kernel.stepping.keeping import leaves
        from ssilang.kernel.stepping.problem.digest import digest_of

        self._known = self._known or digest_of(self.problem)
        bodies = [] if self.bodies is None else [str(np.shape(x)) for x in leaves(self.bodies[1])]
        return {
            "procedure": self.entries.procedure,
            "problem": self._known,
            "bodies": bodies,
            "files": self._files(),
        }

    def _files(self) -> dict[str, str]:
        """Digests of the files that the deck has read so far."""
        from ssilang.io.checkpoint import digest_of_file

        output, folder = run_output(self.session), Path(self.session.script_directory).resolve()
        paths = [p for p in (*output.read, *self.session.library.read) if p not in output.files]
        found = {p.resolve(): digest_of_file(p) for p in paths}
        return {
            str(p.relative_to(folder) if p.is_relative_to(folder) else p): d
            for p, d in found.items()
        }

    def _check(self, kept: dict[str, Any]) -> None:
        """Refuse what an earlier run kept of another calculation, or read from other files."""
        own, folder = self._call(), self.checkpoints.folder
        before, now = kept["files"], own["files"]
        changed = sorted(f for f in before.keys() | now if before.get(f) != now.get(f))
        if changed:
            raise self.entries.error(
                "operators.dynamics.checkpoint-of-files", folder=folder, files=changed
            )
        if any(kept[word] != own[word] for word in ("procedure", "problem", "bodies")):
            raise self.entries.error(
                "operators.dynamics.checkpoint-of-call",
                folder=folder, number=self.number, procedure=kept["procedure"],
            )  # fmt: skip


def _unknowns_read(problem: Problem, observers: Sequence[Observer]) -> IntArray | None:
    """Unknowns that observers read, where they are few of a large problem; None: all."""
    nodes = [getattr(o, "nodes", None) for o in observers]
    if problem.small or any(n is None for n in nodes):
        return None
    read = np.concatenate([np.zeros(0, np.int64), *(n for n in nodes if n is not None)])
    multipliers = problem.multipliers
    if problem.contact is not None:
        multipliers = np.concatenate([multipliers, problem.contact.multipliers])
    if np.isin(multipliers, read).any():
        return None
    found: IntArray = np.flatnonzero(np.isin(problem.numbering.nodes, read))
    return found


# ---- what is read --------------------------------------------------------------------------------


def kept_calculation(
    entries: Entries, problem: Problem, observers: Sequence[Observer],
    not_kept: Sequence[str] = (), bodies: Bodies | None = None,
) -> KeptCalculation | None:  # fmt: skip
    """What REPRISE asks for; None without it.

    Parameters
    ----------
    not_kept : sequence of str
        Entries in force whose calculation cannot be kept.
    """
    asked = entries.inside("REPRISE") if isinstance(entries.get("REPRISE"), Table) else None
    if asked is None:
        return None
    for index in not_kept:
        reason = Sentence(REASONS[index])
        raise entries.error("operators.dynamics.not-kept", index=index, reason=reason)
    steps, minutes = asked.get("PAS"), asked.get("MINUTES")
    if steps is not None and steps < 1:
        raise entries.error("operators.dynamics.steps-of-reprise", steps=steps)
    if steps is not None and not asked.has("MINUTES"):
        minutes = np.inf
    if not minutes > 0.0:
        raise entries.error("operators.dynamics.minutes-of-reprise", minutes=minutes)
    output = run_output(entries.call.session)
    if entries.call.session.integrate is not None or output.checkpoints is None:
        entries.warn("operators.dynamics.nothing-kept")
        return None
    return KeptCalculation(
        entries, problem, observers, output.checkpoints, steps or 0, float(minutes), bodies
    )


REASONS = {
    "CHARMECA": "operators.dynamics.not-kept-procedure",
    "PROCEDURE_CHARMECA": "operators.dynamics.not-kept-procedure",
    "PROCEDURE_PERSO1": "operators.dynamics.not-kept-procedure",
    "REDUCTION": "operators.dynamics.not-kept-reduction",
    "AUTOMATIQUE": "operators.dynamics.not-kept-path",
    "PILOTAGE_INDIRECT": "operators.dynamics.not-kept-path",
}
"""Why calculations cannot be kept, by the entry that asks for them."""

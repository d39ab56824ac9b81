"""REPRISE: DYNAMIC and PASAPAS keep their state on the way, and `--resume` goes on from it.

What is kept are the calculation's own state (`kernel.stepping.keeping`), what its observers hold,
and the instants that they were given. An observer that says what it holds (`content`) gets it back
(`restore`); tracks get their rows back, the others are given their instants again.
"""

import time
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Protocol, runtime_checkable

from ssilang.io.checkpoint import Checkpoints, Kept, Rows, changed_names
from ssilang.kernel.stepping.keeping import State, digest_of, fitting, leaves, rebuilt, stride_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Observer, Snapshot
from ssilang.kernel.stepping.state import WHOLE
from ssilang.kernel.stepping.track import Rows as TrackRows
from ssilang.kernel.stepping.track import Track, View
from ssilang.operators.files.outputs import digests_of_read, run_output
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries
from ssilang.threads import blas

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.bulk import Bulk
    from ssilang.kernel.plasticity.bulk import State as BulkState

Bodies = tuple["Bulk", "BulkState"]


@runtime_checkable
class Holding(Protocol):
    """An observer that says in plain values and arrays what it holds, and takes it back."""

    def content(self) -> Any:
        """What a checkpoint keeps."""

    def restore(self, kept: Any) -> None:
        """Go on from a checkpoint."""


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
        self._holding: list[Any] = [o for o in observers if _holds(o)]
        rest = [o for o in observers if not _holds(o)]
        self._tracks = [KeptTrack(o) for o in rest if _is_track(o)]
        self._given_again = [o for o in rest if not _is_track(o)]
        self.wanted: NDArray[np.bool_] = np.zeros(len(problem.times), bool)
        for observer in self._given_again:
            self.wanted |= observer.wanted
        self._waiting: list[list[Any]] = []
        self._written, self._at = 0, time.monotonic()
        self._before: tuple[int, State] | None = None

    # ---- an observer

    def receive(self, snapshot: Snapshot) -> None:
        """Keep an instant for those that are given it again."""
        found = [snapshot.step, *(getattr(snapshot, name) for name in WHOLE)]
        if self.bodies is not None:
            found += leaves(getattr(snapshot, "bulk_state"))  # noqa: B009
        self._waiting.append(found)

    def close(self) -> None:
        """Nothing to do: what waits goes with the next checkpoint."""

    # ---- a keeper

    def stride(self, done: int, unknowns: int) -> int:
        """Steps up to the next instant at which the state may be kept."""
        return stride_of(done, unknowns, self.every)

    @contextmanager
    def steady(self, done: int, state: Callable[[], State]) -> Iterator[None]:
        """Interruptions wait; the state before is kept where what solves may be lost."""
        if self.problem.solver.petsc is not None:
            self._before = done, state()
        with self.session.hold():
            yield
        self._before = None

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
            times, folder = self.problem.times, self.checkpoints.folder
            told = {"step": self._written, "time": times[self._written], "folder": folder}
            self.entries.warn("operators.dynamics.checkpoint-left", **told, steps=len(times) - 1)

    def lost(self, done: int, state: Callable[[], State]) -> None:
        """What solves has ended: as `left`, from before the steps that it broke off."""
        if self._before is None:
            self.left(done, state)
        else:
            before, kept = self._before
            self.left(before, lambda: kept)

    def finished(self, done: int, state: Callable[[], State]) -> None:
        """Keep the results too: a deck that goes on elsewhere does not step again."""
        if done > self._written:
            self._write(done, state())

    def last(self) -> State | None:
        """What an earlier run kept; the observers get what they had."""
        kept = self.checkpoints.read(self.number)
        if kept is None:
            return None
        with fitting():
            return self._taken(kept)

    def _taken(self, kept: Kept) -> State:
        self._check(kept.call)
        for batch in kept.rows:
            for i, track in enumerate(self._tracks):
                track.give(self.problem, i, batch)
            for snapshot in self._instants(batch):
                for observer in self._given_again:
                    if observer.wanted[snapshot.step]:
                        observer.receive(snapshot)
        for observer, held in zip(self._holding, kept.state["held"], strict=True):
            observer.restore(held)
        energies = np.concatenate([batch["energies"] for batch in kept.rows])
        self._written, steps = len(energies) - 1, len(self.problem.times) - 1
        at = self.problem.times[self._written]
        code = "operators.dynamics.resumed" if self._written < steps else "operators.dynamics.given"
        self.entries.warn(code, step=self._written, steps=steps, time=at)
        before, now = kept.call["arithmetic"], self._call()["arithmetic"]
        if changed := changed_names(before, now):
            told = {"before": before, "now": now}
            self.entries.warn(
                "operators.dynamics.resumed-elsewhere",
                **{key: [f"{n}={d.get(n, '')}" for n in changed] for key, d in told.items()},
            )
        state: State = kept.state["own"]
        return state | {"energies": energies}

    # ---- files

    def _write(self, done: int, state: State) -> None:
        with self.session.hold():
            first = self._written + 1 if self._written else 0
            rows = self._rows() | {"energies": state["energies"][first:]}
            for i, track in enumerate(self._tracks):
                rows |= track.rows(i)
            own = {k: v for k, v in state.items() if k != "energies"}
            held = [o.content() for o in self._holding]
            self.checkpoints.write(self.number, self._call(), {"own": own, "held": held}, rows)
            self._waiting.clear()
            self._written, self._at = done, time.monotonic()

    def _rows(self) -> Rows:
        """The instants that wait, part by part."""
        names = ["step", *WHOLE]
        columns = [np.stack([np.asarray(x) for x in c]) for c in zip(*self._waiting, strict=True)]
        names += [f"body{i}" for i in range(len(columns) - len(names))]
        return dict(zip(names, columns, strict=False))

    def _instants(self, rows: Rows) -> Iterator[Snapshot]:
        from ssilang.kernel.plasticity.snapshot import BulkSnapshot

        times = self.problem.times
        for k, step in enumerate(rows["step"].tolist() if "step" in rows else ()):
            parts = {name: rows[name][k] for name in WHOLE}
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
        p = self.problem
        self._known = self._known or digest_of(p)
        bodies = [] if self.bodies is None else [str(np.shape(x)) for x in leaves(self.bodies[1])]
        return {
            "procedure": self.entries.procedure,
            "problem": self._known,
            "sizes": [len(x) for x in (p.numbering.nodes, p.state, p.times)],
            "arithmetic": arithmetic(),
            "bodies": bodies,
            "report": run_output(self.session).recording is not None,
            "files": digests_of_read(self.session),
        }

    def _check(self, kept: dict[str, Any]) -> None:
        """Refuse what an earlier run kept of another calculation, or read from other files."""
        own, folder = self._call(), self.checkpoints.folder
        if changed := changed_names(kept["files"], own["files"]):
            raise self.entries.error(
                "operators.dynamics.checkpoint-of-files", folder=folder, files=changed
            )
        if kept.get("report", False) != own["report"]:
            raise self.entries.error(
                "operators.dynamics.checkpoint-of-report", folder=folder, reported=not own["report"]
            )
        # rounding of another machine leaves other numbers of the same problem
        same = kept["arithmetic"] == own["arithmetic"]
        words = ("procedure", "bodies", "sizes", *(("problem",) if same else ()))
        if any(kept[word] != own[word] for word in words):
            raise self.entries.error(
                "operators.dynamics.checkpoint-of-call",
                folder=folder, number=self.number, procedure=kept["procedure"],
            )  # fmt: skip


@cache
def arithmetic() -> dict[str, str]:
    """What the last bits of a result depend on, by name."""
    import scipy

    from ssilang.kernel.base.compiled.machine import processor

    found = {"numpy": np.__version__, "scipy": scipy.__version__}
    for library in (np, scipy):
        kernels, threads = blas(Path(str(library.__file__)).parent)
        found |= {f"BLAS of {library.__name__}": kernels, "threads": str(threads)}
    return found | {"processor": processor().split()[1]}


def _holds(observer: Observer) -> bool:
    """Whether an observer says what it holds."""
    return isinstance(observer, Holding) and observer.content() is not None


def _is_track(observer: Observer) -> bool:
    """Whether an observer takes rows (a table of whole instants does not)."""
    return isinstance(observer, Track) and not getattr(observer, "whole", False)


class KeptTrack:
    """The rows of an observer that takes them: those that came since the last checkpoint.

    Rows of a loop's coordinates are kept as the unknowns that follow from them, the same numbers.
    """

    def __init__(self, track: Any) -> None:
        self.track, self._kept = track, 0

    def rows(self, number: int) -> Rows:
        """Arrays by names that begin with the track's number, and with that of the group."""
        new, self._kept = self.track.pieces[self._kept :], len(self.track.pieces)
        groups: list[dict[str, list[NDArray[Any]]]] = []
        for piece in new:
            parts = _parts_of(piece)
            shapes = {name: x.shape[1:] for name, x in parts.items()}
            if not groups or {n: x[0].shape[1:] for n, x in groups[-1].items()} != shapes:
                groups.append({name: [] for name in parts})
            for name, x in parts.items():
                groups[-1][name].append(x)
        return {
            f"{number}.{g}.{name}": np.concatenate(x)
            for g, group in enumerate(groups)
            for name, x in group.items()
        }

    def give(self, problem: Problem, number: int, rows: Rows) -> None:
        """Give rows of a batch back."""
        groups: dict[str, dict[str, NDArray[Any]]] = {}
        for key, x in rows.items():
            if key.startswith(f"{number}."):
                _, group, name = key.split(".")
                groups.setdefault(group, {})[name] = x
        for parts in groups.values():
            self.track.pieces.append(_piece_of(problem, self.track.unknowns, parts))
        self._kept = len(self.track.pieces)


def _parts_of(rows: TrackRows) -> dict[str, NDArray[Any]]:
    """Rows as arrays, one instant a row."""
    found = {name: rows.values(name) for name in ("u", "v", "a")} | rows.joints._asdict()
    for name in ("reaction", "contact"):
        if len(kept := getattr(rows.tap, name)) == len(rows) and kept.shape[1]:
            found[name] = kept
    return {"step": rows.steps_taken, **found}


def _piece_of(problem: Problem, unknowns: IntArray, parts: dict[str, NDArray[Any]]) -> TrackRows:
    steps = parts["step"]
    shapes = {name: x.shape[1:] for name, x in parts.items() if name != "step"}
    view = View(unknowns, shapes)
    tap = view.tap(np.arange(len(steps)))
    for name in shapes:
        getattr(tap, name)[:] = parts[name]
    factors = problem.loading.at(problem.times[steps])
    return TrackRows(problem, steps, unknowns, view, tap, factors)


# ---- what is read --------------------------------------------------------------------------------


def steps_of_reprise(entries: Entries) -> int | None:
    """Steps from one checkpoint to the next (0: by the clock); None without REPRISE."""
    asked = entries.inside("REPRISE")
    return None if asked is None else asked.get("PAS") or 0


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
    asked = entries.inside("REPRISE")
    if asked is None:
        return None
    for index in not_kept:
        reason = Sentence(REASONS[index])
        raise entries.error("operators.dynamics.not-kept", index=index, reason=reason)
    steps, minutes = asked.get("PAS"), asked.get("MINUTES")
    if steps is not None and not asked.has("MINUTES"):
        minutes, count = np.inf, len(problem.times) - 1
        if steps > count:
            entries.warn("operators.dynamics.checkpoints-beyond-end", every=steps, count=count)
    output = run_output(entries.call.session)
    if output.checkpoints is None:
        entries.warn("operators.dynamics.nothing-kept")
        return None
    return KeptCalculation(
        entries, problem, observers, output.checkpoints, steps or 0, float(minutes), bodies
    )


REASONS = {
    "CHARMECA": "operators.dynamics.not-kept-procedure",
    "PROCEDURE_CHARMECA": "operators.dynamics.not-kept-procedure",
    "PROCEDURE_PERSO1": "operators.dynamics.not-kept-procedure",
    "PROCEDURE_REEV_MEC": "operators.dynamics.not-kept-procedure",
    "REDUCTION": "operators.dynamics.not-kept-reduction",
    "AUTOMATIQUE": "operators.dynamics.not-kept-path",
    "PILOTAGE_INDIRECT": "operators.dynamics.not-kept-path",
}
"""Why calculations cannot be kept, by the entry that asks for them."""

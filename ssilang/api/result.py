"""What a run leaves, for Python: objects by name, histories, pictures, checks, warnings, files."""

import shutil
import weakref
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.api import histories
from ssilang.api.errors import Error, MissingKey, Notice, refused
from ssilang.api.html import rows_html
from ssilang.api.objects import CurveView, held, seen
from ssilang.api.view import library
from ssilang.cli.run import phrase_values
from ssilang.cli.summary import pictures_among
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.run.not_built import NotBuilt
from ssilang.language.run.scopes import PREDEFINED, Frame
from ssilang.language.run.session import Check, Session
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.search import nearest_told
from ssilang.language.text.source import Source
from ssilang.language.values import Table, type_of
from ssilang.operators.files.outputs import run_output
from ssilang.operators.workspace import workspace

if TYPE_CHECKING:
    import pandas

_SAME_PLACE = 1e-6  # of the size of the model


@dataclass(frozen=True)
class Picture:
    """A picture that a run made; notebooks show it.

    Attributes
    ----------
    path : Path
        Where it is; without a folder asked for it goes with the result.
    others : tuple of Path
        The same in other formats.
    """

    path: Path
    others: tuple[Path, ...] = ()

    def save(self, path: Path | str) -> Path:
        """Copy it to a place of its own."""
        return Path(shutil.copyfile(self.path, path))

    def _repr_png_(self) -> bytes | None:
        return self.path.read_bytes() if self.path.suffix == ".png" else None

    def _repr_svg_(self) -> str | None:
        if self.path.suffix == ".png":  # one form is enough, and a scene has many lines
            return None
        return self.path.read_text(encoding="utf-8") if self.path.suffix == ".svg" else None


def _files(session: Session) -> list[Path]:
    return [p for p in run_output(session).files if p.is_file()]


def pictures_of(session: Session) -> list[Picture]:
    """Pictures that a session has made so far, in order, each once in whatever formats."""
    alike: dict[Path, list[Path]] = {}
    for path in pictures_among(_files(session)):
        alike.setdefault(path.with_suffix(""), []).append(path)
    ordered = (sorted(paths, key=lambda p: p.suffix != ".png") for paths in alike.values())
    return [Picture(first, tuple(others)) for first, *others in ordered]


class Checks(Sequence[Check]):
    """Figures in order, by place or by name."""

    def __init__(self, found: Sequence[Check], language: str) -> None:
        self._found, self._language = tuple(found), language

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return self._found[key]
        for check in self._found:
            if check.name == key:
                return check
        told = {"name": key, **nearest_told(key, (c.name for c in self._found))}
        raise refused("api.no-such-figure", self._language, MissingKey, **told)

    def __len__(self) -> int:
        return len(self._found)

    def frame(self) -> "pandas.DataFrame":
        """A DataFrame: a row a figure."""
        return library("pandas", self._language).DataFrame([vars(c) for c in self._found])

    def __repr__(self) -> str:
        return repr(list(self._found))


@dataclass(eq=False)
class Result(Mapping[str, Any]):
    """What a run left: a mapping of the names of the script to what they stand for.

    Numbers, words and logicals are Python's own, lists are arrays; tables, fields, meshes and
    curves have the forms of `ssilang.api`, each with the kernel's object in `held`.

    Attributes
    ----------
    session : Session
        The session that ran, for who needs its inside.
    seconds : float
        What the run took.

    Examples
    --------
    >>> import ssilang
    >>> r = ssilang.run("X = 1. + 2. ; L = PROG 1. PAS 1. 5. ; MESS 'X is' X ;")
    >>> r["X"], r["L"].sum(), r.output
    (3.0, np.float64(15.0), 'X is 3.00000E+00\\n')
    >>> r.evaluate("MAXI (L * X)")
    15.0
    >>> r["XX"]
    Traceback (most recent call last):
        ...
    ssilang.api.errors.MissingKey: error: the script has no XX
      = there are X and L
    """

    session: Session
    seconds: float
    _printed: StringIO = field(repr=False)
    _kept: bool = field(default=True, repr=False)  # a folder was asked for

    def __post_init__(self) -> None:
        if not self._kept:  # it was made for this run alone
            folder = Path(self.session.output_directory)
            weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)

    # ---- objects -------------------------------------------------------------------------------

    @property
    def _names(self) -> dict[str, Any]:
        root = self.session.root
        names = {n for n in root.names() if n[0] != "&"}
        return {
            n: v for n, v in root.variables.items() if n in names and v is not PREDEFINED.get(n)
        }

    def __getitem__(self, name: str) -> Any:
        value = self.session.root.find(name.upper())
        if value is None or type(value) is NotBuilt:
            told = {"name": name, **nearest_told(name, self._names)}
            raise refused("api.no-such-name", self.language, MissingKey, **told)
        return seen(value, self.language)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return str(name).upper() in self._names

    def evaluate(self, phrase: str, /, **names: Any) -> Any:
        """The value of a phrase of the language, in the session that the run left.

        Parameters
        ----------
        phrase : str
            One or several statements; the value of the last one is given, all of them as a tuple
            where there are several. Names that they assign are forgotten.
        **names
            Objects of Python that the phrase reads under these names.

        Raises
        ------
        Error
            As `run`.

        Examples
        --------
        >>> import ssilang
        >>> r = ssilang.run("L = PROG 1. 2. 4. ;")
        >>> r.evaluate("MAXI (L * K)", K=10.0)
        40.0
        """
        text = phrase if phrase.rstrip().endswith(";") else f"{phrase} ;"
        found = self._evaluated(text, {n.upper(): held(v, self.language) for n, v in names.items()})
        values = [seen(v, self.language) for v in found]
        return values[0] if len(values) == 1 else tuple(values) or None

    def _evaluated(self, text: str, names: Mapping[str, Any]) -> list[Any]:
        session = self.session
        frame = Frame(session.root)
        frame.variables.update(names)
        session.frame = frame
        try:
            return phrase_values(session, Source("<python>", text))
        except SeveralErrors as several:
            raise self._error(several.errors) from None
        except SsiError as error:
            raise self._error([error]) from None
        finally:
            session.frame = session.root

    def _error(self, errors: Sequence[SsiError]) -> Error:
        names = self.session.frame.names() | self.session.library.standard_names
        return Error([Notice.of(e, self.language, names) for e in errors], self)

    # ---- histories -----------------------------------------------------------------------------

    def history(self, word: str, component: str, point: Any, table: Any = None) -> CurveView:
        """A component of what a calculation saved, at a point in time, as EVOL 'TEMP' gives it.

        Parameters
        ----------
        word : str
            'DEPL', 'VITE' or 'ACCE', as the table of results has them.
        component : str
            'UX', 'UY' ...
        point : str, int, sequence of float or object
            A point: by a phrase of the script ('TOP', "T . 'SOMMET'"), by the number of its node
            from 1, by its coordinates, or as the object itself. A mesh gives a curve a node.
        table : str or TableView, optional
            The table of results, where the script has several.

        Raises
        ------
        Error
            For a word, a component or a point that is not there: what is near.
        """
        results = self._results(table)
        index = histories.full_word(results, word, self.language)
        text = f"EVOL 'TEMP' RESULTS '{index}' '{component}' PLACE ;"
        place = self._place(point, results, index, component)
        if isinstance(place, Point):  # as a mesh: the curve gets the name that the script gave it
            place = place.mesh
        found = self._evaluated(text, {"RESULTS": results, "PLACE": place})
        return CurveView(found[0], self.language)

    def _results(self, table: Any) -> Table:
        """The table of results that is meant."""
        if isinstance(table, str):
            table = self[table]
        if table is not None:
            value = held(table, self.language)
            if not histories.is_results(value):
                raise refused("api.no-results", self.language)
            return value  # type: ignore[no-any-return]
        tables = {n: v for n, v in self._names.items() if histories.is_results(v)}
        if len({id(v) for v in tables.values()}) != 1:
            code = "api.which-results" if tables else "api.no-results-here"
            data = {"names": list(tables)} if tables else {}
            raise refused(code, self.language, **data)
        return next(iter(tables.values()))  # type: ignore[no-any-return]

    def _place(self, point: Any, table: Table, word: str, component: str) -> Point | Mesh:
        nodes = workspace(self.session).nodes
        if isinstance(point, str):
            found = self._evaluated(f"{point} ;", {})
            point = found[0] if len(found) == 1 else found
        else:
            point = getattr(point, "held", point)
        if isinstance(point, Point | Mesh):
            return point
        if isinstance(point, int | np.integer) and not isinstance(point, bool):
            if not 1 <= point <= len(nodes):
                raise refused("api.no-such-node", self.language, number=point, count=len(nodes))
            return Point(nodes, int(point) - 1)
        try:
            at = np.asarray(point, dtype=float)
        except (TypeError, ValueError):
            at = np.zeros(0)
        if at.ndim != 1 or not 1 <= len(at) <= 3:
            raise refused("api.no-point", self.language, kind=type(point).__name__)
        return Point(nodes, self._node_at(at, table, word, component))

    def _node_at(self, at: Any, table: Table, word: str, component: str) -> int:
        """The node at coordinates, of those where the component was saved."""
        nodes = workspace(self.session).nodes
        known = histories.nodes_of(table, word, component)
        among = known if len(known) else np.unique(nodes.resolve(np.arange(len(nodes))))
        x = nodes.coordinates[among]
        distance = np.linalg.norm(x - np.pad(at, (0, 3 - len(at))), axis=1)
        near = among[distance <= _SAME_PLACE * (np.ptp(x, axis=0).max() or 1.0)]
        if len(near) == 1 or (len(near) and not len(known)):  # EVOL tells of the component
            return int(near[0])
        if len(near):
            told = [nodes.told(n) for n in near[:5].tolist()]
            raise refused("api.several-nodes", self.language, nodes=told)
        i = int(distance.argmin())
        told_at = nodes.told(int(among[i]))
        raise refused("api.no-node-there", self.language, nearest=told_at, distance=distance[i])

    # ---- beside them ---------------------------------------------------------------------------

    @property
    def language(self) -> str:
        """'en' or 'fr'."""
        return self.session.language

    @property
    def output(self) -> str:
        """What the script printed."""
        return self._printed.getvalue()

    @property
    def warnings(self) -> list[Notice]:
        """What the run warned of."""
        return [Notice.of(w, self.language) for w in self.session.warnings]

    @property
    def calculations(self) -> list[dict[str, Any]]:
        """What each motion and each sequence of load steps took, as in `summary.json`.

        `energy_imbalance` is the largest energy from nowhere, a share of what there was.
        """
        return [dict(c) for c in self.session.statistics.get("calculations", [])]

    @property
    def checks(self) -> Checks:
        """Figures that the script reports, with what was expected: by place or by name."""
        return Checks(self.session.checks, self.language)

    @property
    def files(self) -> list[Path]:
        """Files that the run wrote; without a folder asked for they go with the result."""
        return _files(self.session)

    @property
    def figures(self) -> list[Picture]:
        """Pictures that the run made, in order."""
        return pictures_of(self.session)

    @property
    def report(self) -> Path:
        """The page `report.html` of the run; without a folder asked for it goes with the result.

        Raises
        ------
        Error
            If it was run without `report=True`.
        """
        path = Path(self.session.output_directory) / "report.html"
        if not path.is_file():
            raise refused("api.no-report", self.language)
        return path

    def _repr_html_(self) -> str:
        rows = [(name, type_of(value)) for name, value in self._names.items()]
        return rows_html(("", f"{self.seconds:.2f} s"), rows)

    def __repr__(self) -> str:
        names = list(self._names)
        shown = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
        return f"<Result of {self.seconds:.2f} s: {shown}>"

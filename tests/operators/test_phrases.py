"""What a phrase gives is the value beside it (`test_phrases.toml`), reckoned without the package.

A group is said behind its `before` in one session, else each phrase in one of its own, behind its
`start` if it has one. What stands before the last `;` of a phrase is said first, what stands behind
it gives the value, or several names with & between: numbers, words and lists as they are, points by
their coordinates, curves as [abscissas, ordinates], meshes as [kind, cells of points] by block,
tables by what they hold, matrices whole, fields by functions of x, y and z for each component.
"""

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy import signal, special
from script_runs import assert_field, session_after
from together import together
from unchanged import operands_stay  # noqa: F401

from ssilang.cli.run import execute
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import assemble
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.text.source import Source
from ssilang.language.values import Table
from ssilang.operators.workspace import workspace

GROUPS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def oscillator(frequency, damping, values, times, start=(0.0, 0.0)):
    """Displacements of x'' + 2 xi w x' + w^2 x = g, at equal times between which g is linear."""
    w = 2 * math.pi * frequency
    system = [[0, 1], [-w * w, -2 * damping * w]], [[0], [1]], [[1, 0]], [[0]]
    return signal.lsim(system, values, times, start)[1]


KNOWN = {"np": np, "math": math, "pi": math.pi, "special": special, "approx": pytest.approx}
KNOWN |= {"sig": signal, "osc": oscillator, "T8": np.arange(8) / 2}
KNOWN |= {"G8": np.array([0, 2, -1, 3, 0.5, -4, 1, 2])}
ROWS = [(g, p) for g, group in GROUPS.items() for p in group if p not in ("before", "start")]


@pytest.fixture(scope="module")
def sessions(tmp_path_factory):
    made = {}

    def of(group):
        if group not in made or "before" not in GROUPS[group]:
            before = GROUPS[group].get("before") or GROUPS[group].get("start", "")
            made[group] = session_after(before, tmp_path_factory.mktemp(group))
        return made[group]

    return of


def plain(value, dimension=2):
    """What tests compare of an object of the language."""
    match value:
        case Curve():
            return [[plain(p.abscissa_words or p.abscissas.tolist()),
                     plain(p.words or p.ordinates.tolist())] for p in value.parts]  # fmt: skip
        case Mesh():
            at = value.nodes.coordinates[:, :dimension]
            return [[b.cell_type, at[b.connectivity].tolist()] for b in value.blocks]
        case Matrix():
            return assemble(value).toarray()
        case Table():
            return {key: plain(item, dimension) for key, item in value.items()}
        case list() | tuple():
            return [plain(item, dimension) for item in value]
        case str():
            return value.rstrip()
    if hasattr(value, "coordinates") and hasattr(value, "node"):
        return value.coordinates[:dimension].tolist()
    if hasattr(value, "values") and not isinstance(value, NodeField | CellField):
        return plain(list(value.values), dimension)
    return value


def assert_plain(found, wanted):
    if type(wanted).__name__.startswith("Approx"):
        assert found == wanted
    elif callable(wanted):
        assert wanted(found), found
    elif isinstance(wanted, dict):
        assert set(found) == set(wanted)
        for key, item in wanted.items():
            assert_plain(found[key], item)
    elif isinstance(wanted, list | tuple | np.ndarray):
        assert len(found) == len(wanted), found
        for one, other in zip(found, wanted, strict=True):
            assert_plain(one, other)
    elif isinstance(wanted, int | float | np.number) and not isinstance(wanted, bool):
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-12)
    else:
        assert found == wanted


@pytest.mark.usefixtures("operands_stay")
@together("group, phrase", ROWS, by=lambda row: row[0])
def test_a_phrase_gives_its_value(sessions, group, phrase):
    session = sessions(group)
    said, _, asked = phrase.rpartition(";")
    names = asked.split(" & ")
    said += " ;" if said else ""
    if len(names) == 1:
        said, names = f"{said} ZZ = {asked} ;", ["ZZ"]
    execute(session, Source("phrase", said))
    found = [session.root.find(name.strip()) for name in names]
    found = found if len(names) > 1 else found[0]
    wanted = eval(GROUPS[group][phrase], KNOWN)
    if isinstance(found, NodeField | CellField):
        assert_field(found, wanted)
    else:
        dimension = workspace(session).dimension
        assert_plain(plain(found, dimension), wanted)

"""What a script gives fulfils the conditions beside it (`test_scripts.toml`).

A case's script goes on behind the start that it names, in a session of its own.
"""

import math
import re
import tomllib
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.matrices.assembly import assemble, numbering_of

GROUPS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
CASES = [(g, name) for g, cases in GROUPS.items() for name in cases if name != "starts"]
KNOWN = {
    "np": np, "math": math, "approx": pytest.approx, "numbering_of": numbering_of,
    "close": partial(pytest.approx, rel=1e-7, abs=0.0),
    "component": lambda field, name: np.ravel(field.blocks[0].components[name]),
    "dense": lambda matrix: assemble(matrix).toarray(),
    "parts": lambda curve: [(p.abscissas, p.ordinates) for p in curve.parts],
}  # fmt: skip


@together("group, name", CASES, by=lambda case: case[0])
def test_what_a_script_gives_holds(group, name, tmp_path):
    case, starts = GROUPS[group][name], GROUPS[group].get("starts", {})
    root = ran(starts.get(case.get("start"), "") + "\n" + case["script"], tmp_path).session.root
    where = case.get("where", {})
    names = set(re.findall(r"\b[A-Z][A-Z0-9]*\b", " ".join([*where.values(), *case["holds"]])))
    known = KNOWN | {n: value for n in names if (value := root.find(n)) is not None}
    for short, text in where.items():
        known[short] = eval(text, known)
    for condition in case["holds"]:
        assert eval(condition, known), condition

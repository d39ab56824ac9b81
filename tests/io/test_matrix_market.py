"""Assembled matrices as text: terms by columns, conditions that push otherwise than they bind."""

import numpy as np
import scipy.io

from ssilang.io.matrix_market import market_text, node_lines, system_of, unknown_lines
from tests.kernel.stepping.problem.test_non_associated import K1, K2, C, D, lever


def test_a_system_has_what_binds_below_and_what_pushes_beside(tmp_path):
    bench, one, two = lever()
    system = system_of(bench.stiffness)
    found = np.zeros((system.size, system.size))
    found[system.rows, system.columns] = system.values
    keys = [*zip(system.columns.tolist(), system.rows.tolist(), strict=True)]
    assert keys == sorted(keys)
    at = [
        i for n in (one, two) for i in np.flatnonzero(system.nodes == n) if system.names[i] == "UY"
    ]
    lever_row = system.size - 1
    assert (found[at, at].tolist(), found[lever_row, at].tolist()) == ([K1, K2], C.tolist())
    assert found[at, lever_row].tolist() == D.tolist()
    (tmp_path / "k.mm").write_bytes(market_text(system))
    assert np.array_equal(scipy.io.mmread(tmp_path / "k.mm").toarray(), found)
    ids = [int(line.split()[3]) - 1 for line in node_lines(system, bench.table.coordinates)]
    assert ids == np.unique(system.nodes).tolist()
    local = [int(line.split()[0]) - 1 for line in unknown_lines(system)[: system.size]]
    assert [ids[i] for i in local] == system.nodes.tolist()

"""Where the processes of a sweep begin."""

import os

from together import together

from ssilang.cli.sweeping import pool
from ssilang.cli.sweeping.pool import elsewhere


@together("before", [None, "0", "yes"])
def test_processes_import_nothing_from_the_working_folder(before, monkeypatch):
    name = "PYTHONSAFEPATH"
    monkeypatch.delenv(name, raising=False)
    if before is not None:
        monkeypatch.setenv(name, before)
    with elsewhere():
        assert os.environ[name] == "1"
    assert os.environ.get(name) == before


@together(
    "tasks, forks, way", [(7, True, "run_here"), (8, True, "run_grown"), (9, False, "run_here")]
)
def test_the_others_wait_for_the_first_run_where_they_are_many(tasks, forks, way, monkeypatch):
    asked = []
    for name in ("run_here", "run_grown"):
        monkeypatch.setattr(pool, name, lambda *given, name=name: asked.append((name, *given)))
    monkeypatch.setattr(pool, "CAN_FORK", forks)
    pool.run_all(range(tasks), 2, str)
    assert asked == [(way, range(tasks), 2, str)]

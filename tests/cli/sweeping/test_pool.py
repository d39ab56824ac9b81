"""Where the processes of a sweep begin."""

import os

from together import together

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

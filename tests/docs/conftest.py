"""What the tests of the manual share."""

import importlib.util
import sys
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def build():
    """The module `docs/build.py`, which stands in no package."""
    path = Path(__file__).resolve().parents[2] / "docs" / "build.py"
    spec = importlib.util.spec_from_file_location("build_manual", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["build_manual"] = module
    spec.loader.exec_module(module)
    return module

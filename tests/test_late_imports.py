"""Modules that are seldom used load when something in them is asked for, and are whole then."""

import subprocess
import sys

import pytest

from ssilang.late_imports import SELDOM


def told(code):
    done = subprocess.run(
        [sys.executable, "-c", f"import sys\n{code}"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_sparse_matrices_and_compiled_code_load_none_of_them():
    # a lazy module has the class of its loader until something in it is asked for
    code = (
        "import ssilang.kernel.base.sparse, scipy.sparse.linalg, numba\n"
        f"found = [n for n in {sorted(SELDOM)!r} if n in sys.modules]\n"
        "print(*(n for n in found if type(sys.modules[n]) is type(sys)))"
    )
    assert told(code) == []


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("import ssilang, numpy as np; print(np.testing.suppress_warnings.__name__)",
         ["suppress_warnings"]),
        ("import ssilang, numpy as np; print(np.ma.masked_less([1, 2], 2).count())", ["1"]),
        ("import ssilang; from numpy.testing import assert_equal; assert_equal(1, 1)", []),
        ("import ssilang, numpy.f2py; print(callable(numpy.f2py.run_main))", ["True"]),
        ("import ssilang, numpy.f2py.auxfuncs as f; print(f.isscalar.__name__)", ["isscalar"]),
        ("import ssilang, html; print(html.escape('<'))", ["&lt;"]),
        ("import ssilang; from xml.etree.ElementTree import fromstring as f; print(f('<a/>').tag)",
         ["a"]),
        ("import ssilang; from importlib.metadata import version; print(bool(version('numpy')))",
         ["True"]),
    ],
)  # fmt: skip
def test_they_are_whole_when_they_are_used(code, said):
    assert told(code) == said


def test_one_that_is_not_installed_is_not_found():
    code = (
        "import ssilang, ssilang.late_imports as late\n"
        "late.SELDOM = frozenset({'no_such_module'})\n"
        "try:\n    import no_such_module\nexcept ModuleNotFoundError:\n    print('none')"
    )
    assert told(code) == ["none"]


@pytest.mark.skipif(sys.version_info[:2] == (3, 12), reason="Python 3.12 freezes objects itself")
def test_what_lasts_is_old_at_once_and_garbage_of_it_is_still_found():
    code = (
        "import gc\nfrom ssilang.late_imports import lasting\nclass Held: pass\n"
        "def old_and_kept(*where):\n"
        "    return sorted(x is kept for x in gc.get_objects(*where) if type(x) is Held)\n"
        "with lasting():\n    print(gc.isenabled())\n    kept, garbage = Held(), Held()\n"
        "    garbage.itself = garbage\n    del garbage\n"
        "print(gc.isenabled(), *old_and_kept(2))\ngc.collect()\nprint(*old_and_kept())"
    )
    assert told(code) == ["False", "True", "False", "True", "True"]


def test_what_someone_keeps_from_the_search_stays_kept():
    code = (
        "import gc\nfrom ssilang.late_imports import lasting\n"
        "gc.freeze(); before = gc.get_freeze_count()\n"
        "with lasting():\n    pass\n"
        "print(gc.get_freeze_count() == before)"
    )
    assert told(code) == ["True"]

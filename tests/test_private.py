"""Kept code that another could have written is never read."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from together import together

from ssilang import private
from ssilang.kernel.base.compiled import cache
from ssilang.private import opened_to_others, private_folder

pytestmark = pytest.mark.skipif(os.name != "posix", reason="modes and owners of one system")

# a compiled function of a module: prints a result and how often kept code was loaded
PROGRAM = """
from ssilang.kernel.base.compiled.compiler import compiled


@compiled
def double(x):
    return 2.0 * x


print(double(4.0), double.loaded)
"""


@pytest.fixture
def home():
    """A folder of caches that others may pass through (pytest's own ones are closed)."""
    with tempfile.TemporaryDirectory(prefix="caches") as made:
        os.chmod(made, 0o755)
        yield Path(made).resolve()


def kept(home):
    return home / "ssilang" / "compiled"


def test_folders_are_made_for_the_user_alone_whatever_the_mask_says(home):
    before = os.umask(0)
    try:
        assert private_folder(kept(home)) is None
    finally:
        os.umask(before)
    assert kept(home).stat().st_mode & 0o777 == 0o700
    assert kept(home).parent.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("mode", [0o777, 0o755, 0o770, 0o701, 0o1777])
def test_a_folder_that_is_open_to_others_is_refused(home, mode):
    kept(home).mkdir(parents=True)
    kept(home).chmod(mode)
    assert private_folder(kept(home)) == kept(home)
    kept(home).chmod(0o700)
    assert private_folder(kept(home)) is None


def test_a_folder_of_another_user_is_refused(home, monkeypatch):
    assert private_folder(kept(home)) is None
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    assert opened_to_others(kept(home)) == kept(home)


def test_a_folder_below_one_of_another_user_is_refused(home, monkeypatch):
    assert private_folder(kept(home)) is None
    monkeypatch.setattr(private, "_SYSTEM", -1)  # the root of the files is another user's now
    monkeypatch.setattr(os, "geteuid", lambda: -2)
    monkeypatch.setattr(private, "_is_own", lambda found: True)
    assert opened_to_others(kept(home)) == Path(home.anchor)


def test_links_and_files_are_refused(home):
    (home / "prepared").mkdir(mode=0o700)
    (home / "link").symlink_to(home / "prepared")
    (home / "file").write_text("")
    (home / "loop").symlink_to(home / "loop")
    for name in ("link", "file", "loop", "file/below", "loop/below"):
        assert private_folder(home / name) == home / name
    assert private_folder(home / "prepared") is None


@pytest.mark.parametrize(
    ("mode", "safe"), [(0o777, False), (0o775, False), (0o1777, True), (0o755, True)]
)
def test_a_folder_that_others_can_exchange_is_refused(home, mode, safe):
    way = home / "way"
    (way / "compiled").mkdir(parents=True, mode=0o700)
    way.chmod(mode)
    assert opened_to_others(way / "compiled") == (None if safe else way)


def test_what_others_do_not_get_to_need_not_be_closed(home):
    (home / "way" / "compiled").mkdir(parents=True, mode=0o700)
    (home / "way").chmod(0o775)
    assert opened_to_others(home / "way" / "compiled") == home / "way"
    home.chmod(0o700)
    assert opened_to_others(home / "way" / "compiled") is None


def test_links_on_the_way_are_followed_to_where_they_lead(home):
    (home / "real").mkdir()
    (home / "real").chmod(0o777)
    (home / "way").symlink_to(home / "real")
    assert private_folder(home / "way" / "compiled") == home / "real"
    (home / "real").chmod(0o755)
    assert private_folder(home / "way" / "compiled") is None


def test_a_folder_that_the_user_names_may_be_read_by_others(home):
    named = home / "named"
    named.mkdir()
    named.chmod(0o755)
    assert private_folder(named, closed=0o022) is None
    named.chmod(0o775)
    assert private_folder(named, closed=0o022) == named


def test_a_fresh_folder_is_refused_where_others_can_exchange_it(monkeypatch):
    made = private.fresh_folder()
    assert made is not None
    assert made.stat().st_mode & 0o777 == 0o700
    monkeypatch.setattr(private, "_is_safe", lambda parent: False)
    assert private.fresh_folder() is None


def run_program(home, **environment):
    """Result of the compiled function, and how often its code was loaded."""
    (home / "program.py").write_text("from doubling import double")
    (home / "doubling.py").write_text(PROGRAM)
    temporary = tempfile.mkdtemp(dir=home)  # a new one: no code is kept there
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    given |= {"PYTHONPATH": os.pathsep.join(sys.path), "TMPDIR": temporary, **environment}
    made = subprocess.run(
        [sys.executable, "program.py"], capture_output=True, text=True, cwd=home, env=given,
        check=False,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    assert not [p for p in Path(temporary).iterdir() if p.name != f"ssilang-{os.geteuid()}"]
    return made.stdout.split()


def test_prepared_code_is_not_loaded(home):
    # the folder is filled by the user himself and then opened: it is as if others had filled it
    given = {"XDG_CACHE_HOME": str(home / "caches")}
    assert run_program(home, **given) == ["8.0", "0"]  # compiled
    assert run_program(home, **given) == ["8.0", "1"]  # loaded
    kept(home / "caches").chmod(0o777)
    assert run_program(home, **given) == ["8.0", "0"]


def test_a_folder_that_the_user_names_for_code_is_checked_too(home, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(home / "named"))
    monkeypatch.setattr(private, "REFUSED", [])
    assert cache._given.__wrapped__(str(home / "named")) == home / "named"
    assert cache._folder() == home / "named"
    (home / "named").chmod(0o777)
    assert home not in cache._given.__wrapped__(str(home / "named")).parents
    assert [(home / "named", home / "named")] == private.REFUSED


@pytest.mark.parametrize(("mode", "first"), [(0o700, 0), (0o777, 1)])
def test_the_temporary_folder_is_checked_as_the_user_s_own(home, monkeypatch, mode, first):
    (home / "file").write_text("")  # no folder can be made below a file
    one, two = home / "one", home / "two"
    one.mkdir()
    one.chmod(mode)
    monkeypatch.setattr(private, "REFUSED", [])
    assert private.first_private(home / "file" / "x", one, two) == (one, two)[first]
    assert len(private.REFUSED) == first
    assert all(told == (one, one) for told in private.REFUSED)


def test_code_of_a_package_of_the_kernel_is_found(home, monkeypatch):
    monkeypatch.setattr(cache, "_base", lambda: home)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    assert not cache.is_compiled("stepping")  # the package that DYNAMIC asks for
    made = cache.folder_of.__wrapped__("ssilang.kernel.stepping.newmark")
    (made / "newmark.code").write_text("")
    assert cache.is_compiled("stepping")


def test_a_refused_folder_is_told_once(home, monkeypatch):
    from ssilang.cli.run import run_text

    monkeypatch.setattr(private, "REFUSED", [(kept(home), home)])
    told = [[w.code for w in run_text("X = 1 ;", home / "out").session.warnings] for _ in range(2)]
    assert told == [["cli.kept-folder-refused"], []]


def test_a_run_tells_of_the_folder_that_it_refused(home):
    kept(home).mkdir(parents=True)
    kept(home).chmod(0o777)
    deck = (  # of what is compiled, little
        "A = EVOL 'MANU' 'TEMPS' (PROG 0. 'PAS' 0.1 1.) 'ACCE' (PROG 11 * 1.) ;\n"
        "L = PROG 0.01 ; B = SPO A 'FREQ' (PROG 1. 2.) 'AMOR' L 'DEPL' ;\n"
        "C = SPON 'SIGN' A 'SPEL' B 'DEPL' 'AMOR' L 'CINE' (PROG 2. 0.1) 'DEPL' ;\n"
    )
    (home / "deck.ssi").write_text(deck)
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    made = subprocess.run(
        [sys.executable, "-m", "ssilang.cli.main", "deck.ssi"], cwd=home,
        env=given | {"XDG_CACHE_HOME": str(home)}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    assert made.stderr.count(f"others could have put code or words into {kept(home)}: nothing") == 1
    assert not any(kept(home).iterdir())


def started(home):
    return home / "ssilang" / "started"


def run_script(home, text, **environment):
    """A run of the command in an empty folder of its own; '' takes a variable away."""
    folder = Path(tempfile.mkdtemp(dir=home))
    (folder / "deck.ssi").write_text(text)
    given = {k: v for k, v in os.environ.items() if k not in ("NUMBA_CACHE_DIR", "HOME")}
    given |= {"PYTHONPATH": os.pathsep.join(sys.path), "XDG_CACHE_HOME": "", **environment}
    made = subprocess.run(
        [sys.executable, "-m", "ssilang.cli.main", "deck.ssi"], cwd=folder, check=False,
        env={k: v for k, v in given.items() if v}, capture_output=True, text=True,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    assert {p.name for p in folder.iterdir()} <= {"deck.ssi", "results"}
    return made


def spoilt(kept_file):
    """A file of what is kept with the signs of numbers read as nothing."""
    text = kept_file.read_text(encoding="utf-8")
    kept_file.write_text(text.replace("[+-]", "[+]"), encoding="utf-8")
    return kept_file


def test_words_that_another_could_have_written_are_not_read(home):
    """The same file decides what -9.81 is where only the user could have written it."""
    script, caches = "X = PROG -9.81 ; LIST X ;", str(home)
    first = run_script(home, script, XDG_CACHE_HOME=caches)
    (words,) = started(home).glob("words-*.json")
    assert [p.stat().st_mode & 0o777 for p in (started(home), started(home).parent)] == [0o700] * 2
    assert "-9.81" in first.stdout
    assert "[+-]" in words.read_text()
    spoilt(words)
    started(home).chmod(0o777)
    told = run_script(home, script, XDG_CACHE_HOME=caches)
    assert told.stdout == first.stdout
    assert told.stderr.count(f"could have put code or words into {started(home)}") == 1


def test_a_link_in_the_place_of_what_is_kept_is_not_followed(home):
    started(home).parent.mkdir(mode=0o700)
    (home / "theirs").mkdir(mode=0o777)
    started(home).symlink_to(home / "theirs")
    told = run_script(home, "MESS 1 ;", XDG_CACHE_HOME=str(home))
    assert not list((home / "theirs").iterdir())
    assert "could have put code or words into" in told.stderr


@together(
    "environment", [{"HOME": ""}, {"HOME": "~"}, {"HOME": "some/where"}, {"XDG_CACHE_HOME": "near"}]
)
def test_without_a_home_nothing_is_kept_beside_the_deck(monkeypatch, environment):
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.delenv("HOME", raising=False)
    for name, value in ({"HOME": "none"} | environment).items():
        monkeypatch.setenv(name, value) if value else monkeypatch.delenv(name, False)
    found = private.places("started")
    assert all(p.is_absolute() for p in found)
    assert len(found) == 1 + ("HOME" in environment and not environment["HOME"])


def test_a_run_without_a_home_leaves_nothing_beside_the_deck(home):
    run_script(home, "MESS 1 ;", HOME="none", TMPDIR=tempfile.mkdtemp(dir=home))


def test_a_user_without_a_name_keeps_things_in_a_temporary_folder(home, monkeypatch):
    monkeypatch.delenv("HOME", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setenv("TMPDIR", str(home))
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)
    assert private.places("started") == [home / f"ssilang-{os.geteuid()}" / "started"]

"""Where compiled code is kept.

Numba keeps compiled code beside each module and looks at that module's file alone to tell whether
it is still good: a function keeps the old code of what it calls. The code of a module compiled here
is therefore kept in a folder named after its text and that of all modules of the kernel that it
imports or names as CODE, directly or not: an edit costs the code that it may change, and no other.

Kept code is run unseen, so a folder is used only if nobody else could have put his own there
(`private`); else a run compiles into a folder that ends with it.
"""

import os
import re
import shutil
import sys
import time
from functools import cache
from importlib.util import source_hash
from pathlib import Path

from ssilang import private
from ssilang.kernel.base.compiled import PLAIN, UNTRIED

SUFFIX = ".code"  # of a file with a function's machine code
KEPT_SECONDS = 30 * 86400.0  # code of older states of a module is removed after this
IMPORTED = re.compile(
    r'^(?:from|CODE =) "?(ssilang\.kernel[\w.]*)(?:"| import (\([^)]*\)|.*))$', re.MULTILINE
)  # or written by
PACKAGE = Path(__file__).parents[3]  # ssilang


def is_compiled(package: str) -> bool:
    """Whether functions of a package of the kernel ('stepping') were compiled before."""
    base = None if PLAIN else _folder()
    if base is None:
        return False
    start = f"ssilang.kernel.{package}."
    kept = (name.rpartition("-") for name in os.listdir(base) if name.startswith(start))
    return any(
        any((base / f"{module}-{state}").glob(f"*{SUFFIX}"))
        for module, _, state in kept
        if state == state_of(module)
    )


def state_of(module: str, package: Path = PACKAGE) -> str:
    """A name for the text of a module and of those that it imports from the kernel.

    Parameters
    ----------
    package : Path
        Folder of ssilang.
    """
    known, waiting = {}, [module]
    while waiting:
        name = waiting.pop()
        if name not in known:
            known[name], imported = _read(name, package)
            waiting += imported
    return digest("".join(known[name] for name in sorted(known)))


def digest(text: str) -> str:
    """16 letters that tell a text from others, as Python tells sources; hashlib loads OpenSSL."""
    return source_hash(text.encode()).hex()


@cache
def _read(module: str, package: Path) -> tuple[str, tuple[str, ...]]:
    """Digest of a module's name and text, and the modules that it imports from the kernel."""
    path = _source(module, package)
    try:
        text = path.read_text(encoding="utf-8")
    except OSError:  # a name that is imported and no module
        return "", ()
    names = [
        (m, [f"{m}.{word}" for word in re.findall(r"\w+", rest)])
        for m, rest in IMPORTED.findall(text)
    ]
    found = [n for m, inside in names for n in (m, *(inside if _is_package(m, package) else ()))]
    return digest(f"{module}\n{text}"), tuple(found)


def _source(module: str, package: Path) -> Path:
    """The file of a module; of somebody else's, that is imported, '.' if it has none."""
    if not module.startswith("ssilang."):
        return Path(getattr(sys.modules.get(module), "__file__", None) or "")
    path = package.joinpath(*module.split(".")[1:])
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _is_package(module: str, package: Path) -> bool:
    return package.joinpath(*module.split(".")[1:]).is_dir()


def kept_code() -> tuple[Path, int] | None:
    """The folder that keeps code for later processes and the number of functions in it, if any."""
    given = os.environ.get("NUMBA_CACHE_DIR")
    known = [Path(given)] if given else [] if PLAIN else private.places("compiled")
    base = _folder()
    if base is None or base not in [place.resolve() for place in known]:
        return None
    return base, sum(1 for _ in base.rglob("*.nbc" if PLAIN else f"*{SUFFIX}"))


def _folder() -> Path | None:
    """Where code is kept: in the folder that NUMBA_CACHE_DIR names, else in one of ours."""
    return given_folder() if os.environ.get("NUMBA_CACHE_DIR") else None if PLAIN else _base()


def given_folder() -> Path | None:
    """The folder that NUMBA_CACHE_DIR names, if it does and only we could have written to it."""
    given = os.environ.get("NUMBA_CACHE_DIR")
    return _given(given) if given else None


@cache
def plain_folder() -> Path | None:
    """Where plain numba keeps code if versions were not tried, for the kernel as it is now.

    Numba looks at the file of a function alone, and not at what that calls; the folder is named
    after all files.
    """
    if not UNTRIED or os.environ.get("SSILANG_PLAIN_NUMBA"):
        return None
    files = sorted((PACKAGE / "kernel").rglob("*.py"))
    state = digest("".join(f"{f} {(s := f.stat()).st_size} {s.st_mtime_ns}\n" for f in files))
    return private.first_private(*private.places(f"plain/{state}"))


@cache
def _base() -> Path | None:
    """Folder that keeps code: the user's, a temporary one, a new one, or None if none is safe."""
    return private.first_private(*private.places("compiled")) or private.fresh_folder()


@cache
def _given(name: str) -> Path | None:
    """The folder that NUMBA_CACHE_DIR names, or a new one if others could have written to it."""
    return private.first_private(Path(name), closed=0o022) or private.fresh_folder()


@cache
def folder_of(module: str) -> Path | None:
    """Where the code of a module in its present state is kept; it counts as used now.

    None: there is no place where nobody else could put his own, or the module is no file, by whose
    text its code could be told.
    """
    base = _folder()
    if base is None or not _source(module, PACKAGE).is_file():
        return None
    folder = base / f"{module}-{state_of(module)}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        os.utime(folder)
        if not os.environ.get("NUMBA_CACHE_DIR"):  # else others may keep theirs there
            _remove_old(base)
    except OSError:  # another process removes the same folders, or the disk is full
        pass
    return folder if private.opened_to_others(folder) is None else None


@cache
def _remove_old(base: Path) -> None:
    """Remove code of older states of modules that nobody has used for long, once a process."""
    limit = time.time() - KEPT_SECONDS
    with os.scandir(base) as found:
        old = [f.name for f in found if f.is_dir() and f.stat().st_mtime < limit]
    for name in old:
        if name != f"{(module := name.rpartition('-')[0])}-{state_of(module)}":
            shutil.rmtree(base / name, ignore_errors=True)

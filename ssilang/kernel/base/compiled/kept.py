"""Compiled code on disk: a file for each function and kinds of arguments.

The name of the file tells them, so that processes which fill a folder at a time need no index. It
also tells who made it: numba's, LLVM's, numpy's and Python's version, the processor.
"""

import importlib.util
import os
import pickle
import sys
import tempfile
from functools import cache
from pathlib import Path

import llvmlite
import numpy as np

from ssilang.kernel.base.compiled.cache import SUFFIX, digest, folder_of
from ssilang.kernel.base.compiled.machine import Code, processor


def load(module: str, function: str, words: str) -> Code | None:
    """The code that is kept of a function for kinds of arguments, None if there is none."""
    place = _place(module, function, words)
    if place is None:
        return None
    try:
        return Code(*pickle.loads(place.read_bytes()))
    except Exception:  # none yet, or another program has written it: it is compiled
        return None


def save(module: str, function: str, words: str, code: Code) -> None:
    """Keep code for later processes; where that is not possible nothing is kept."""
    place = _place(module, function, words)
    if place is None:
        return
    try:
        number, name = tempfile.mkstemp(dir=place.parent, prefix=".", suffix=".new")
        with os.fdopen(number, "wb") as file:
            file.write(pickle.dumps(tuple(code), pickle.HIGHEST_PROTOCOL))
        os.replace(name, place)
    except OSError:  # another process removes old code, the disk is full
        pass


def _place(module: str, function: str, words: str) -> Path | None:
    folder = folder_of(module)
    if folder is None:
        return None
    told = "\n".join([module, function, words, _maker()])
    return folder / f"{function.rpartition('.')[2]}-{digest(told)}{SUFFIX}"


@cache
def _maker() -> str:
    found = importlib.util.find_spec("numba")  # its folder: nothing is imported
    version = ""
    if found is not None and found.origin is not None:
        version = Path(found.origin).with_name("_version.py").read_text(encoding="utf-8")
    made_by = (version, llvmlite.__version__, np.__version__, sys.version, processor())
    return "\n".join(made_by)

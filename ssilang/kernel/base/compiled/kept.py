"""Compiled code that is kept on disk, loaded without what only compiling needs.

Numba imports its implementations of Python and numpy, some 100 modules, before it looks whether
code is kept, and others for names that only interpreted code would look up. Kept code is linked
machine code: it needs numba's own memory management at most. What is not kept is compiled, and
numba's compiler imports all that it needs by itself.
"""

# mypy: allow-untyped-calls

from __future__ import annotations

import pickle
from typing import Any

from numba.core import environment
from numba.core.caching import FunctionCache
from numba.core.runtime.nrt import rtsys


class KeptCode(FunctionCache):
    """Where the code of one function is kept."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled function for a signature, None if it is not kept."""
        rtsys.initialize(target_context)
        with self._guard_against_spurious_io_errors():
            return self._load_overload(sig, target_context)

    def _load_overload(self, sig: Any, target_context: Any) -> Any:
        files = self._cache_file
        name = files._load_index().get(self._index_key(sig, target_context.codegen()))
        try:
            if name is not None:
                with open(files._data_path(name), "rb") as file:
                    return self._impl.rebuild(target_context, _Unpickler(file).load())
        except FileNotFoundError:  # another process removes old code
            pass
        return None


class _Unpickler(pickle.Unpickler):
    """Reads what numba keeps; the environments of numba's own functions have no names in them."""

    def find_class(self, module: str, name: str) -> Any:
        """What a name of the file stands for."""
        if (module, name) == ("numba.core.environment", "_rebuild_env"):
            return _environment
        return super().find_class(module, name)


def _environment(module: str, constants: list[Any], name: str) -> Any:
    """Constants of compiled code; names of its module, which only interpreted code looks up."""
    known = environment.lookup_environment(name)
    if known is not None or not module.startswith("numba."):
        return known or environment._rebuild_env(module, constants, name)
    made = environment.Environment({"__name__": module})
    made.consts[:], made.env_name = constants, name
    environment.Environment._memo[name] = made
    return made

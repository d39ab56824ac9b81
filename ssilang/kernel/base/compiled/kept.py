"""Compiled code that is kept on disk, loaded without what only compiling needs.

Numba imports its implementations of Python and numpy, some 100 modules, before it looks whether
code is kept, and others for names that only interpreted code would look up; it reads LLVM's form of
the code too, which serves where the code is linked into new one. Kept code is machine code: it
needs numba's own memory management at most. What is not kept is compiled, and numba's compiler
imports all that it needs by itself.
"""

# mypy: allow-untyped-calls

from __future__ import annotations

import hashlib
import pickle
from typing import Any

import llvmlite.binding as llvm
from numba.core import environment
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompileResult
from numba.core.runtime.nrt import rtsys

from ssilang.late_imports import load_blas

FORMAT = "ssilang 1"
_ALGEBRA = (b"numba_x", b"numba_ez_")
"""How numba's names of calls of BLAS and LAPACK begin."""


class _Loaded(JITCodeLibrary):
    """Machine code from a file; LLVM's form of it is read where new code links it."""

    bitcode = b""

    def _get_module_for_linking(self) -> Any:
        if self._shared_module is None:
            self._shared_module = llvm.parse_bitcode(self.bitcode)
        return self._shared_module


class _Results(CompileResultCacheImpl):
    """What is kept of a compiled function: what numba keeps, and names of all that it defines."""

    def reduce(self, made: Any) -> Any:
        """As it is written."""
        module = made.library._get_module_for_linking()
        defined = [
            value.name
            for values in (module.functions, module.global_variables)
            for value in values
            if not value.is_declaration
        ]
        return FORMAT, defined, super().reduce(made)

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        """The compiled function, None if another program has written it."""
        if payload[0] != FORMAT:
            return None
        _, defined, (code, fndesc, env, signature, objectmode, lifted, note, init, envs) = payload
        for start in init:
            start()
        library = _library(target_context.codegen(), code, defined)
        result: Any = CompileResult
        made = result(
            target_context=target_context,
            typing_context=target_context.typing_context,
            library=library,
            environment=env,
            entry_point=target_context.get_executable(library, fndesc, env),
            fndesc=fndesc,
            type_annotation=note,
            signature=signature,
            objectmode=objectmode,
            lifted=lifted,
            typing_error=None,
            call_helper=None,
            metadata=None,
            reload_init=init,
            referenced_envs=envs,
        )
        for referenced in envs:
            library.codegen.set_env(referenced.env_name, referenced)
        return made


def _library(codegen: Any, code: Any, defined: list[str]) -> Any:
    """Code ready to run."""
    name, kind, data = code
    if kind != "object":
        return codegen.unserialize_library(code)
    made = _Loaded(codegen, name)
    machine, made.bitcode = data
    if any(symbol in machine for symbol in _ALGEBRA):
        load_blas()
    made.enable_object_caching()
    made._set_compiled_object(machine)
    made._finalize_final_module()
    codegen._engine._defined_symbols.update(defined)
    return made


class KeptFiles(IndexDataCacheFile):
    """Files of one function's code, which several processes may fill at a time.

    Numba numbers them: two processes that compile for other types take the same number, and the
    code of one stands under the types of the other. Here the types name the file.
    """

    def save(self, key: Any, data: Any) -> None:
        """Write code, then the index that leads to it."""
        digest = hashlib.sha256(self._dump((self._source_stamp, key))).hexdigest()[:16]
        name = self._data_name_pattern.replace("{number:d}", digest)
        self._save_data(name, data)
        self._save_index(self._load_index() | {key: name})


class KeptCode(FunctionCache):
    """Where the code of one function is kept."""

    _impl_class = _Results

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        self._cache_file.__class__ = KeptFiles

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


def keep(made: Any) -> None:
    """Let a function of numba's find its code on disk, or keep it there once it is compiled."""
    made._cache = KeptCode(made.py_func)


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

"""Machine code from a file, made ready to run without numba's compiler.

LLVM links it with the functions of numba's own three libraries in C (conversions of arguments,
memory of arrays, closures), which are loaded by their files: the packages around them import some
200 modules, a sixth of a short run. Where something is compiled, numba loads itself as ever.
"""

# mypy: allow-untyped-calls

import builtins
import ctypes
import importlib.util
import os
import pickle
import sys
from collections.abc import Callable
from functools import cache
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader, ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple, cast

import llvmlite.binding as llvm

SYMBOL = "ssilang_resolve"
"""By which code asks for the address of another function (`apart`)."""
STOPPED = 1  # its answer if someone interrupts: no address
BLAS = {"numba_xxdot": "scipy.linalg.cython_blas"}
BLAS |= dict.fromkeys(("numba_xxgemm", "numba_xxgemv"), BLAS["numba_xxdot"])
"""Functions of numba's that call the BLAS which scipy brings, and where it is."""
LIBRARIES = ("numba._helperlib", "numba._dynfunc", "numba.core.runtime._nrt_python")


class Code(NamedTuple):
    """Machine code of one function for types of arguments.

    Attributes
    ----------
    object : bytes
        As LLVM writes it.
    native, wrapper : str
        Symbols: the function for compiled callers, and for Python (empty: none).
    needs : list
        Symbols that the code does not define itself.
    environments : list
        Name, module and constants of each that the code refers to.
    own : str
        Name of the function's own.
    result : str
        Type of what it returns.
    """

    object: bytes
    native: str
    wrapper: str
    needs: list[str]
    environments: list[tuple[str, str, list[Any]]]
    own: str
    result: str


class Ready(NamedTuple):
    """A function that can be called: from Python (None: it is not made for it), by its address."""

    call: Callable[..., Any] | None
    address: int
    result: str


class Machine:
    """LLVM's linker, what can be linked, what was."""

    def __init__(self) -> None:
        helpers, functions, memory = (library(name) for name in LIBRARIES)
        self._made = functions
        self._known = {f"numba_{name}": a for name, a in functions.c_helpers.items()}
        for name, address in helpers.c_helpers.items():
            self._known[f"numba_{name}"] = self._known[name] = address
        for name, address in memory.c_helpers.items():
            self._known[name if name.startswith("_") else f"NRT_{name}"] = address
        for value in vars(builtins).values():
            if isinstance(value, type) and issubclass(value, BaseException):
                self._known[f"PyExc_{value.__name__}"] = id(value)
        self._known["_Py_NoneStruct"] = id(None)
        self._known["numba_unpickle"] = cast(int, ctypes.cast(_UNPICKLE, ctypes.c_void_p).value)
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        target = llvm.Target.from_triple(llvm.get_process_triple())
        machine = target.create_target_machine(opt=0, jit=True)
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
        self._environments: dict[str, Any] = {}

    def load(self, code: Code, module: str, name: str) -> Ready:
        """The function `name` of a module, ready to be called."""
        for symbol in code.needs:
            if symbol in BLAS:
                library(BLAS[symbol])  # else all of scipy.linalg is imported at the first call
            address = self._known.pop(symbol, None)
            if address is not None:
                llvm.add_symbol(symbol, address)
        engine = self._engine
        engine.add_object_file(llvm.ObjectFileRef.from_data(code.object))
        engine.finalize_object()
        for environment, of, constants in code.environments:
            self._place(environment, of, constants)
        call = None
        if code.wrapper:
            entry = engine.get_function_address(code.wrapper)
            own = self._environments[code.own]
            call = self._made.make_function(sys.modules[module], name, "", entry, own, (self,))
        return Ready(call, int(engine.get_function_address(code.native)), code.result)

    def _place(self, name: str, module: str, constants: list[Any]) -> None:
        """Let code find its constants: numba's code asks a place of that name for them."""
        if name not in self._environments:
            found = sys.modules.get(module)
            names = {"__name__": module} if found is None else vars(found)
            made = self._made.Environment(names)
            made.consts[:] = constants
            self._environments[name] = made
        place = self._engine.get_global_value_address(name)
        (ctypes.c_void_p * 1).from_address(place)[0] = id(self._environments[name])


def _unpickle(data: int, size: int, digest: int) -> Any:
    """Classes of results and errors, that code holds as pickles: numba would read them by itself.

    `digest` tells equal pickles: one is read once.
    """
    name = ctypes.string_at(digest, SHA1)
    if name not in _READ:
        _READ[name] = pickle.loads(ctypes.string_at(data, size))
    return _READ[name]


SHA1 = 20  # bytes
_READ: dict[bytes, Any] = {}
_UNPICKLE = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.c_void_p, ctypes.c_int, ctypes.c_void_p)(
    _unpickle
)


@cache
def machine() -> Machine:
    """The one of this process."""
    return Machine()


@cache
def processor() -> str:
    """What machine code is made for: system, processor and its abilities.

    Numba makes it for another one where NUMBA_CPU_NAME and NUMBA_CPU_FEATURES say so ('generic',
    for machines that differ and share a disk).
    """
    name = os.environ.get("NUMBA_CPU_NAME") or llvm.get_host_cpu_name()
    abilities = os.environ.get("NUMBA_CPU_FEATURES")
    return f"{llvm.get_process_triple()} {name} {_abilities() if abilities is None else abilities}"


def _abilities() -> str:
    try:
        return str(llvm.get_host_cpu_features().flatten())
    except RuntimeError:  # LLVM does not know this system's
        return ""


def library(name: str) -> ModuleType:
    """A module in C of numba or scipy, without the packages that it lies in."""
    if name in sys.modules:
        return sys.modules[name]
    package, *inside, last = name.split(".")
    spec = importlib.util.find_spec(package)
    if spec is None or spec.origin is None:
        raise ImportError(name)
    folder = Path(spec.origin).parent.joinpath(*inside)
    files = (folder / (last + suffix) for suffix in EXTENSION_SUFFIXES)
    path = next((str(file) for file in files if file.is_file()), None)
    if path is None:
        raise ImportError(name)
    loader = ExtensionFileLoader(name, path)
    made = importlib.util.module_from_spec(ModuleSpec(name, loader, origin=path))
    sys.modules[name] = made
    loader.exec_module(made)
    return made

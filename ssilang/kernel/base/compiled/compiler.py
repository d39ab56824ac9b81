"""The decorators for compiled inner loops, with types that can be followed.

A function finds its kept code when it is called, or has numba make it, which is imported then.

Numba counts the references to each array that it slices or takes out of a record, by two locked
instructions each time: half of the time of a small step. Functions that neither make arrays nor
hand any back need no count, their callers hold all that they see; they are compiled without it.
"""

import functools
import inspect
import re
import sys
import threading
from collections.abc import Callable
from types import GenericAlias
from typing import Any, TypeVar, cast

from ssilang.kernel.base.compiled import PLAIN, UNCOMPILED
from ssilang.kernel.base.compiled.beside import BESIDE, title
from ssilang.kernel.base.compiled.cache import given_folder, plain_folder
from ssilang.kernel.base.compiled.kept import load, save
from ssilang.kernel.base.compiled.kinds import Key, key_of, words_of, words_of_types
from ssilang.kernel.base.compiled.machine import Ready, machine

Function = TypeVar("Function", bound=Callable[..., Any])
Types = tuple[Any, ...]

# no entry for C, that nothing uses: it takes time to compile
_OPTIONS: dict[str, Any] = {"error_model": "numpy", "no_cfunc_wrapper": True}
_LOCK = threading.RLock()  # one function is made ready at a time

SCALARS = {"None", "bool", "int", "float", "tuple", "Quantity"}
MAKERS = {"array", "copy", "dot", "empty", "full", "sort", "zeros"}
"""Types of results that are no arrays; names that bring arrays into a function."""


class Compiled:
    """A compiled function; compiled callers get its part (`linked`).

    Attributes
    ----------
    loaded : int
        How many times code was found on disk.
    """

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        functools.update_wrapper(self, function)
        self.py_func, self.options = function, options
        self.name: str | None = function.__qualname__  # under which code is kept, None: not
        if function.__closure__:
            self.name = None  # what it closes over is not in the name
        self.loaded = 0
        self._count = function.__code__.co_argcount
        self._any = bool(function.__code__.co_flags & inspect.CO_VARARGS)  # `*args` and no other
        self._seen: dict[Key, Callable[..., Any]] = {}
        self._ready: dict[str, Ready] = {}

    def __call__(self, *args: Any, **named: Any) -> Any:
        if self._any:
            args = (args,)
        elif named or len(args) != self._count:
            bound = inspect.signature(self.py_func).bind(*args, **named)
            bound.apply_defaults()
            args = bound.args
        key = key_of(args)
        call = self._seen.get(key)
        if call is None:
            call = self._seen[key] = self._found(key, args)
        return call(*args)

    def _found(self, key: Key, args: tuple[Any, ...]) -> Callable[..., Any]:
        words = words_of(key)
        if words is None:  # kinds that only numba tells
            words = words_of_types(self._types(args))
        ready = self.ready(words, lambda: self._types(args))
        if ready is None or ready.call is None:
            raise TypeError(f"{self.py_func.__qualname__} is not made for Python")
        return ready.call

    def _types(self, args: tuple[Any, ...]) -> Types:
        return tuple(self.dispatcher.typeof_pyval(value) for value in args)

    @functools.cached_property
    def dispatcher(self) -> Any:
        """Numba's function, a `Linked`."""
        from ssilang.kernel.base.compiled.linked import Linked

        options = self.options | {"_nrt": counts(self.py_func)}
        return Linked(self.py_func, None, options | {"nopython": True, "boundscheck": None})

    @property
    def _numba_type_(self) -> Any:
        """Read by numba where compiled code names the function."""
        return self.dispatcher._numba_type_

    def ready(self, words: str, types: Callable[[], Types]) -> Ready | None:
        """Code for kinds of arguments, found or made; None if the run itself makes it.

        Parameters
        ----------
        words : str
            As `kinds` writes them.
        types : function
            Gives numba's types of them, if they are needed.
        """
        found = self._ready.get(words)
        if found is not None:
            return found
        module, name = self.py_func.__module__, self.py_func.__qualname__
        with _LOCK, BESIDE.taking(title(module, self.name or name, words)) as mine:
            found = self._kept(words)
            if found is None:
                if not mine and BESIDE.found is not None:
                    return None
                code, found = self.dispatcher.made(types())
                if self.name is not None:
                    save(module, self.name, words, code)
        self._ready[words] = found
        return found

    def _kept(self, words: str) -> Ready | None:
        if self.name is None:
            return None
        code = load(self.py_func.__module__, self.name, words)
        if code is None:
            return None
        self.loaded += 1
        return machine().load(code, self.py_func.__module__, self.py_func.__name__)

    def has(self, words: str) -> bool:
        """Whether the code is there in this process."""
        return words in self._ready

    def __deepcopy__(self, memo: dict[int, Any]) -> "Compiled":
        return self

    def __reduce__(self) -> str:
        return self.py_func.__qualname__


def compiled(function: Function) -> Function:
    """Compile with numba (no Python objects, result kept on disk for the next start)."""
    return _made(function, False)


def compiled_fast(function: Function) -> Function:
    """As `compiled`, sums in any order (vectors); NaN and infinity keep their meaning."""
    return _made(function, {"reassoc", "contract", "nsz", "arcp"})


def compiled_fused(function: Function) -> Function:
    """As `compiled`, products fused with sums; no other order of sums, so what cancels does."""
    return _made(function, {"contract"})


def compiled_inline(function: Function) -> Function:
    """As `compiled_fast`, written out in each caller: large records need not be handed over."""
    return _made(function, {"reassoc", "contract", "nsz", "arcp"}, True)


def compiled_free(function: Function) -> Function:
    """As `compiled`: other threads run meanwhile."""
    return _made(function, False, nogil=True)


def compiled_threaded(function: Function) -> Function:
    """As `compiled_fast`, for `base.threads`: other threads run meanwhile."""
    return _made(function, {"reassoc", "contract", "nsz", "arcp"}, nogil=True)


def _made(
    function: Function, freedom: set[str] | bool, inline: bool = False, nogil: bool = False
) -> Function:
    options = _OPTIONS | {"fastmath": freedom, "forceinline": inline}
    options |= {"nogil": True} if nogil else {}
    if not (PLAIN or UNCOMPILED):
        return cast(Function, Compiled(function, options))
    import numba

    njit: Any = numba.njit  # untyped: options that it does not tell of

    kept = given_folder() or plain_folder()
    if kept is not None:
        numba.config.CACHE_DIR = str(kept)  # type: ignore[attr-defined]
    return cast(Function, njit(cache=kept is not None, _nrt=True, **options)(function))


def counts(function: Callable[..., Any]) -> bool:
    """Whether a function must count references: it makes arrays, or hands some back.

    A function without counts would never give back arrays that it gets from what it calls.
    """
    names, known = set(function.__code__.co_names), function.__globals__
    called = {name for name in names if hasattr(known.get(name), "py_func")}
    own = MAKERS & names - called or _gives_arrays(function)
    return bool(own) or any(_gives_arrays(known[name].py_func) for name in called)


def _gives_arrays(function: Callable[..., Any]) -> bool:
    """Whether the annotated result is or holds an array."""
    result = function.__annotations__.get("return", "not annotated")
    return _holds_arrays(result, function.__globals__)


def written(annotation: Any) -> str:
    """A type as annotations have it: by its name, or as it is written."""
    text = getattr(annotation, "__forward_arg__", annotation)
    return text.__name__ if isinstance(text, type) else str(text)


def _holds_arrays(annotation: Any, names: dict[str, Any]) -> bool:
    """Whether a type that is written so is none of numbers, and no record of numbers alone."""
    for word in re.findall(r"\w+", written(annotation)):
        kind, own, parts = names.get(word), names, list[Any]()
        if hasattr(kind, "_fields"):
            parts, own = [*kind.__annotations__.values()], vars(sys.modules[kind.__module__])
        elif isinstance(kind, GenericAlias):  # a name for a tuple
            parts = [kind]
        if word not in SCALARS and not (parts and not any(_holds_arrays(p, own) for p in parts)):
            return True
    return False

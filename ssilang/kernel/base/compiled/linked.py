"""Numba's dispatcher, as it compiles less for a function that compiled code calls.

Numba makes machine code, and a way in for Python, of each function, also where only the code linked
into its callers will ever run; it optimises that before and after. What is linked here is a part:
types and statements in LLVM's form, untouched until the caller is optimised as a whole. What Python
calls, and what is reached by its address (`apart`), is made as numba makes it, and kept.
"""

# mypy: allow-untyped-calls

from collections.abc import Callable
from typing import Any

from numba.core import compiler
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher
from numba.core.typing.templates import make_concrete_template

from ssilang.kernel.base.compiled.beside import BESIDE
from ssilang.kernel.base.compiled.machine import Code, Ready
from ssilang.late_imports import without_collections

Types = tuple[Any, ...]

_NOT_TYPED_BY = ("no_cpython_wrapper", "no_cfunc_wrapper", "no_compile")


class _Shared(compiler.Flags):
    """Options under which types are found: one object for equal ones, told by its identity.

    They are part of the key of what numba knows of each operator. It compares them option by
    option, and finds all types again under options that say only how Python enters: a tenth of
    the time of compiling.
    """

    __slots__ = ()
    __hash__ = object.__hash__
    __eq__ = object.__eq__


_SHARED: list[_Shared] = []


class _Options(compiler.Flags):
    """Options of a function; the copy under which it is compiled is shared."""

    __slots__ = ()

    def copy(self) -> _Shared:
        made = _Shared(self)
        for name in _NOT_TYPED_BY:
            made.discard(name)
        for known in _SHARED:
            if known.values() == made.values():
                return known
        _SHARED.append(made)
        return made


class _Whole(JITCodeLibrary):
    """Code that is optimised once, when all that it calls is linked."""

    counts = True  # references to arrays

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self) -> None:
        """Without numba's passes before all others where there are no counts for them to remove."""
        if self.counts:
            super()._optimize_final_module()
        else:
            passes, builder = self._codegen._module_pass_manager()
            passes.run(self._final_module, builder)


class _Part(_Whole):
    """Code that goes into that of its callers and is not run where it stands."""

    def finalize(self) -> None:
        """Link what it calls; its callers optimise and translate it."""
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._finalized = True


class _Compiler(compiler.Compiler):
    """Numba's passes; the code is a `_Whole` if it is to be no part."""

    def _compile_core(self) -> Any:
        if self.state.library is None:
            BESIDE.enter(self.state.func_id.modname)
            codegen = self.state.targetctx.codegen()
            self.state.library = _Whole(codegen, self.state.func_id.func_qualname)
            self.state.library.counts = self.state.flags.nrt
            self.state.library.enable_object_caching()
        return super()._compile_core()


class Linked(CPUDispatcher):
    """A compiled function; compiled callers get its part."""

    _compiler: Any  # numba's: takes the function through the passes

    def __init__(self, function: Callable[..., Any], kinds: Any, options: dict[str, Any]) -> None:
        super().__init__(function, kinds, options, _Compiler)
        self._compiler._customize_flags = _Options
        self._parts: dict[Types, Any] = {}

    def _compilation_chain_init_hook(self) -> None:
        """Packages that teach numba types of theirs are not looked for: none comes in here."""

    def made(self, args: Types) -> tuple[Code, Ready]:
        """Code that Python can call, or by its address: to be kept, and to be called."""
        with without_collections():  # a million objects that last: a sixth of compiling otherwise
            self.compile(args)
        done: Any = self.overloads[args]
        library, names = done.library, done.fndesc
        module = library._get_module_for_linking()
        values = [value for of in (module.functions, module.global_variables) for value in of]
        code = Code(
            library._get_compiled_object(),
            names.llvm_func_name,
            "" if self.targetoptions.get("no_cpython_wrapper") else names.llvm_cpython_wrapper_name,
            [value.name for value in values if value.is_declaration],
            [
                (e.env_name, str(e.globals.get("__name__")), list(e.consts))
                for e in done._find_referenced_environments()
            ],
            names.env_name,
            str(done.signature.return_type),
        )
        address = int(library.get_pointer_to_function(names.llvm_func_name))
        return code, Ready(done.entry_point if code.wrapper else None, address, code.result)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Type of a call in compiled code: numba asks before it compiles the call."""
        pysig, args = self._compiler.fold_argument_types(args, kws)
        part = self._part(tuple(args))
        name = self.py_func.__name__
        template = make_concrete_template(name, key=name, signatures=[part.signature])
        return template, pysig, args, {}

    def get_overload(self, sig: Any) -> Any:
        """Key under which numba finds the code of that call."""
        return self._part(tuple(sig)).entry_point

    def _part(self, args: Types) -> Any:
        if args not in self._parts:
            self._parts[args] = self._made(args)
        return self._parts[args]

    @global_compiler_lock  # type: ignore[untyped-decorator]
    def _made(self, args: Types) -> Any:
        options = compiler.Flags()
        self.targetdescr.options.parse_as_flags(options, self.targetoptions)
        options = _Options(options)
        for name in _NOT_TYPED_BY:
            setattr(options, name, True)
        context: Any = self.targetctx
        library = _Part(context.codegen(), self.py_func.__qualname__)
        made = compiler.compile_extra(
            self.typingctx, context, self.py_func, args, None, options, {}, library
        )
        key = object()
        context.insert_user_function(key, made.fndesc, [library])
        return made._replace(entry_point=key)

"""From the items of a phrase to operands: names, parentheses, tables, attributes."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any

from ssilang.language.run.call import Operand
from ssilang.language.run.leftovers import is_call, is_named_object, is_operator
from ssilang.language.run.not_built import read
from ssilang.language.run.procedures import method_of
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.values import ANNULE, Mot, Objet, Table, type_of

# methods that every object has: METHODE and HERITE, operators that also want the object
_METHODS_OF_ALL = frozenset({"METH", "HERI"})


class OperandReader(ABC):
    """The half of the evaluator that looks values up; the other half runs phrases."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._with_unread: set[tree.Paren] = set()
        self._operand: dict[type, Callable[[Any], list[Operand]]] = {
            tree.Number: lambda i: [Operand(i.value, i.span)],
            tree.Quoted: lambda i: [Operand(Mot(i.text), i.span)],
            tree.Symbol: lambda i: [Operand(Mot(i.text), i.span)],
            tree.Name: self._name,
            tree.Paren: self._paren,
            tree.Path: self._path,
            tree.Attribute: self._attribute,
        }

    @abstractmethod
    def phrase(
        self, items: Sequence[tree.Item], span: Span, one_name: bool = True
    ) -> list[Operand]:
        """Run a phrase; the operands that are left."""

    @abstractmethod
    def scalar(self, statement: tree.Statement | tree.Paren) -> Any:
        """Value of a phrase of scalars by the short way, None if it is not one."""

    @abstractmethod
    def refuse_leftovers(self, left: Sequence[Operand], taken: Sequence[Operand] = ()) -> None:
        """Raise the error for operands that nothing read, behind those taken, if there are any."""

    def operands_of(self, items: Sequence[tree.Item]) -> list[Operand]:
        """Operands of items: names replaced by their objects, parentheses run."""
        table = self._operand
        if len(items) == 1:
            return table[type(items[0])](items[0])
        found: list[Operand] = []
        if tree.Paren not in map(type, items):
            for item in items:
                found += table[type(item)](item)
            return found
        parens = {
            i: self._paren(item) for i, item in enumerate(items) if isinstance(item, tree.Paren)
        }
        for i, item in enumerate(items):
            found.extend(parens[i] if i in parens else table[type(item)](item))
        return found

    def _name(self, item: tree.Name) -> list[Operand]:
        value = self.session.frame.find(item.text)
        if value is None:
            value = self.session.library.find(item.text)
            if value is None:
                return [Operand(Mot(item.word), item.span)]
        return [Operand(read(value, item.span), item.span, item.text)]

    def _paren(self, item: tree.Paren) -> list[Operand]:
        value = self.scalar(item)
        if value is not None:
            return [Operand(value, item.span)]
        results = self.phrase(item.items, item.span)
        if not results:
            return []
        if is_call(results):
            self.refuse_leftovers(results)
        if len(results) > 1:
            unread = [o for o in results[1:] if not o.result]
            if results[0].result and unread and all(map(is_named_object, results[1:])):
                # Warn, once for a place, of an object that a parenthesis with a result leaves
                # unread. Published decks have such parentheses, mostly unions with an ET too few,
                # and Cast3M runs them.
                operand = unread[0]
                if item not in self._with_unread:
                    self._with_unread.add(item)
                    found = type_of(operand.value)
                    self.session.warn("unread-object", operand.span, name=operand.name, found=found)
                return [Operand(results[0].value, item.span, results[0].name)]
            word = results[:1] if unread and isinstance(results[0].value, Mot) else []
            self.refuse_leftovers(word + (unread or results[1:]), results[:1])
        value = results[0].value
        return [Operand(value, item.span, results[0].name)]

    def single(self, item: tree.Item) -> Any:
        operands = self._operand[type(item)](item)
        if len(operands) != 1:
            raise SsiError("index", item.span)
        return operands[0].value

    def _path(self, item: tree.Path) -> list[Operand]:
        value = self.single(item.base)
        apart: list[Operand] = []
        refusal = None
        for index in item.indices:
            if type(value) not in (int, float):
                value = self.element(value, index, item)
                continue
            # the dot of a number, `a0. 0.`, separates nothing, unless a word that is no operator's
            # is an index
            refused, following = self.no_table(value, item, index), self.single(index)
            if isinstance(following, Mot) and not is_operator(index, following):
                raise refused
            self.session.warn("dot-of-number", refused.span, **refused.data)
            apart.append(Operand(value, refused.span or item.span, refusal=refusal))
            value, refusal = following, refused
        span = item.indices[-1].span if apart else item.span
        return [*apart, Operand(value, span, refusal=refusal)]

    def element(
        self, holder: Any, index: tree.Item, item: tree.Path, missing: str = "no-index"
    ) -> Any:
        if isinstance(holder, Objet):
            return holder.attributes.get(self.single(index), ANNULE)
        if not isinstance(holder, Table):
            raise self.no_table(holder, item, index)
        where = self.single(index)
        value = holder.get(where)
        if value is None:
            path = Span(item.span.source, item.span.start, index.span.end).text
            known = [k for k, _ in holder.items()]
            raise SsiError(missing, index.span, index=where, known=known, path=path)
        return value

    def no_table(self, holder: Any, item: tree.Path, index: tree.Item) -> SsiError:
        base, before = item.base.span, item.indices[: item.indices.index(index)]
        at = base.to(before[-1].span) if before else base
        alone = isinstance(holder, Mot) and self.session.frame.find(base.text.upper()) is None
        code = "undefined-table" if alone and not before else "not-a-table"
        return SsiError(code, at, found=type_of(holder), name=at.text)

    def _attribute(self, item: tree.Attribute) -> list[Operand]:
        holder = self.object_of(item)
        method = method_of(holder, item.name)
        if method is not None:
            return [Operand(method, item.span, str(item.name))]
        value = holder.attributes.get(item.name)
        if value is None:
            word = Mot(str(item.name))
            if word[:4] in _METHODS_OF_ALL:
                return [Operand(word, item.span), Operand(holder, item.span)]
            text = item.span.text.rpartition("%")[0].strip() or "%"
            refusal = SsiError("no-attribute", item.span, name=item.name, holder=text)
            return [Operand(word, item.span, refusal=refusal)]
        return [Operand(value, item.span, str(item.name))]

    def object_of(self, item: tree.Attribute) -> Objet:
        holder = self.single(item.base) if item.base is not None else self.session.frame.object
        if not isinstance(holder, Objet):
            code = "not-an-object" if item.base is not None else "no-object-runs"
            raise SsiError(code, item.span, found=type_of(holder), name=item.name)
        return holder

"""Names that an operator of Cast3M which is not built should have given a value."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ssilang.language.cast3m import find_cast3m_word
from ssilang.language.registry import find_operator
from ssilang.language.say.diagnostics import suggestion
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Span
from ssilang.language.text.tree import Name, Statement
from ssilang.messages.message import Sentence


@dataclass(frozen=True, slots=True, eq=False)
class NotBuilt:
    """What stands in a name until it gets another value; reading it is the refusal put off.

    Parameters
    ----------
    error : SsiError
        The refusal of the operator, with its place.
    """

    error: SsiError

    def refusal(self, reader: Span) -> SsiError:
        """The operator's refusal, which says where its result is read."""
        line = reader.source.position(reader.start)[0]
        note = Sentence("read-here", name=reader.text, line=line)
        return SsiError(self.error.code, self.error.span, **self.error.data, read_here=note)


def put_off(statement: Statement, error: SsiError, names: Iterable[str]) -> NotBuilt | None:
    """What the names of a statement get whose operator Cast3M has and ssilang has not.

    Only names: what stands in a table is found without a name. An operator without a name on its
    left does something, what a procedure refuses inside is no result of this statement, and a
    word that is nearly another name is misspelt.

    Parameters
    ----------
    names : iterable of str
        Names that have a value, and those of procedures.
    """
    targets = statement.targets
    if error.code != "unknown-operator" or error.calls or not targets or "read_here" in error.data:
        return None
    known = find_cast3m_word(str(error.data["name"]))
    if known is None or known.kind != "operator" or known.here or find_operator(known.name):
        return None
    if suggestion(error, names) or not all(isinstance(t, Name) for t in targets):
        return None
    return NotBuilt(error)


def read(value: Any, reader: Span) -> Any:
    """The value of a name.

    Raises
    ------
    SsiError
        'unknown-operator' where the operator that should have made it is not built.
    """
    if type(value) is NotBuilt:
        raise value.refusal(reader)
    return value

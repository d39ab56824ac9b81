"""From an error to the text that its reader sees: place, source line, caret, hint, calls."""

from collections.abc import Iterable
from typing import Any, cast

from ssilang.language.cast3m import IN_SCOPE, find_cast3m_word
from ssilang.language.registry import ANY, OPERATORS, Page, find_operator, keywords_of
from ssilang.language.say import hints
from ssilang.language.say.errors import SsiError
from ssilang.language.search import LIKE, SHORT_LIKE, VERY_LIKE, nearest
from ssilang.language.text.source import Span
from ssilang.language.values import type_of
from ssilang.language.vocabulary import words_of
from ssilang.messages import message
from ssilang.messages.message import Sentence, help_texts
from ssilang.resources import resource

_LETTERS = 4  # that an operator goes by
_LINE_SHOWN = 160  # characters of a source line
_CALLS_SHOWN = 4  # at each end of the chain
_INDICES_SHOWN = 20


_KINDS = {"error": "label-error", "warning": "label-warning", "note": "label-note"}


_NOTES = ("held_word", "unread_word", "quoted_operator", "begins_line", "read_here", "in_branch")
"""Data that phrases add to errors: sentences that are said before the hint (`phrase_errors`)."""


class _Data(dict[str, Any]):
    def __missing__(self, name: str) -> str:
        return ""


def render(error: SsiError, language: str = "en", names: Iterable[str] = ()) -> str:
    """The whole message of an error, several lines, without colours.

    Parameters
    ----------
    language : 'en' or 'fr'
    names : iterable of str
        Known variables and procedures, for the suggestion of a near name.
    """
    head, hint = sentence(error, language, names)
    number = message.find(error.code).number
    if error.code == "erre" or error.code.startswith("stdlib."):  # what ERRE gives
        number = int(str(error.data.get("number", 0)))
    kind = message.sentence(_KINDS[error.severity], {}, language)
    label = f"{kind} {number}" if number else kind
    lines = [message.sentence("labelled", {"label": label, "head": head}, language)]
    place, calls = _seen(error)
    if place is not None:
        lines += _place(place, "-->")
    lines += [f"  = {part}" for part in hint.split("\n") if part]
    return message.visible("\n".join(lines + _calls(calls, language)))


def _seen(error: SsiError) -> tuple[Span | None, list[tuple[str, Span]]]:
    """Where the reader's own script is wrong, and the chain of calls outside of it.

    What a procedure of the standard library reports is shown at the call in the script.
    """
    place, calls = error.span, list(error.calls)
    while place is not None and calls and _is_standard(place):
        place = calls.pop(0)[1]
    return (
        (error.span, list(error.calls)) if place is None or _is_standard(place) else (place, calls)
    )


def _is_standard(span: Span) -> bool:
    path = span.source.path
    return path is not None and path.parent == resource("stdlib")


def _calls(calls: list[tuple[str, Span]], language: str) -> list[str]:
    """The chain of procedures, innermost first; the middle of a long one is left out."""
    lines = []
    for name, span in calls:
        line, column = span.source.position(span.start)
        called = message.sentence("called-by", {"name": name}, language)
        lines.append(f"  {called} {span.source.name}:{line}:{column}")
    if len(lines) <= 2 * _CALLS_SHOWN:
        return lines
    count = len(lines) - 2 * _CALLS_SHOWN
    return [*lines[:_CALLS_SHOWN], f"  ... {count} ...", *lines[-_CALLS_SHOWN:]]


def sentence(error: SsiError, language: str, names: Iterable[str] = ()) -> tuple[str, str]:
    """What is wrong, and the hint ('' if there is none)."""
    data = _Data(error.data)
    if "." not in error.code:  # the language's own sentences have parts that are computed
        data.update(_derived(error, language, names))
    text = message.sentence(error.code, data, language)
    hint = message.hint(error.code, data, language, script=True).strip()
    notes = (n for name in _NOTES if isinstance(n := error.data.get(name), Sentence))
    before = [message.sentence(n.code, n.data, language) for n in notes]
    return text, "\n".join(h for h in (*before, hint) if h)


def suggestion(error: SsiError, names: Iterable[str] = ()) -> str:
    """The word that is meant in place of the one where the error is, '' if none is near."""
    made = {**error.data, **(_derived(error, "en", names) if "." not in error.code else {})}
    near = made.get("near") or made.get("like") or ""
    for part in ("near_hint", "known_hint", "bare_hint"):
        hint = made.get(part)
        if not near and isinstance(hint, Sentence):
            near = hint.data.get("near", "")
    return str(near).strip("'")


def _place(span: Span, arrow: str) -> list[str]:
    line, column = span.source.position(span.start)
    text = span.source.line(line).replace("\t", " ").rstrip()
    width = max(1, min(span.end, span.start + len(text) - column + 1) - span.start)
    margin = " " * len(str(line))
    text, before, width = _window(text, column - 1, width)
    caret = " " * before + "^" * width
    return [
        f"{margin} {arrow} {span.source.name}:{line}:{column}",
        f"{margin} |",
        f"{line} | {text}",
        f"{margin} | {caret}",
    ]


def _window(text: str, before: int, width: int) -> tuple[str, int, int]:
    """The part of a very long line around the caret, and where the caret stands in it."""
    if len(text) <= _LINE_SHOWN:
        return text, before, width
    first = max(0, min(before - _LINE_SHOWN // 3, len(text) - _LINE_SHOWN))
    shown = text[first : first + _LINE_SHOWN]
    if first:
        shown = "..." + shown[3:]
    if first + _LINE_SHOWN < len(text):
        shown = shown[:-3] + "..."
    before -= first
    return shown, before, max(1, min(width, _LINE_SHOWN - before))


def _derived(error: SsiError, language: str, names: Iterable[str]) -> dict[str, object]:
    """Parts of sentences computed from the data of the error."""
    data = error.data
    made: dict[str, object] = {}
    join = or_(language)
    if "expected" in data and isinstance(data["expected"], list):
        made["types"] = _types_text(data["expected"], language)
    if "words" in data and isinstance(data["words"], list):
        made["words_text"] = join.join(f"'{w}'" for w in data["words"][:12])
    if data.get("found") and error.code == "missing-keyword":
        made["found_word"] = Sentence("found-word", found=data["found"])
    if error.code == "wrong-argument":
        made["found_text"] = _found(data, language)
        made["caller_hint"] = hints.caller_hint(_code_before(error.span), str(data.get("operator")))
    if error.code in ("not-a-table", "dot-of-number"):
        made["a_found"] = _article(str(data["found"]), language)
        made["not_a_table_hint"] = hints.not_a_table_hint(data)
    if error.code == "excess" and data.get("name"):
        made["named"] = f" ({data['name']})"
    if data.get("found") == "nothing":
        made["found"] = Sentence("nothing")
    if data.get("wanted"):
        made["wanted_text"] = Sentence("of-type", wanted=data["wanted"])
    if data.get("before"):
        made["before_text"] = Sentence("ended-by-word", before=data["before"])
    if data.get("bare") and error.code == "wrong-argument" and "held_word" not in data:
        word = str(data["value"])
        near = nearest(word, [n for n in names if n != word])
        known = elsewhere(word, language)
        made["bare_hint"] = f"{known}\n" if known else Sentence("bare-word", word=word, near=near)
    if data.get("found") in ("ENTIER", "FLOTTANT") and "POINT" in _expected(data):
        made["point_hint"] = Sentence("point-in-parentheses")
    if data.get("quoted"):
        made["keyword_hint"] = _keyword_hint(data)
    if _expected(data) == ["MOT"] and data.get("name") and error.code == "wrong-argument":
        made["word_hint"] = hints.word_hint(str(data["name"]))
    near = _near_hint(data, language, names)
    outside = error.code == "unknown-operator" and near == elsewhere(str(data["name"]), language)
    made["outside"], made["near_hint"] = (near, "") if outside else ("", near)
    made["excess_hint"] = hints.excess_hint(data)
    made["no_result_hint"] = hints.no_result_hint(data)
    made["comment_hint"] = hints.comment_hint(_text_from(error.span))
    made["syntax_hint"] = _syntax_hint(data)
    made["known_hint"] = _known_hint(data)
    if "index" in data:
        made["index"] = _shown_index(data["index"])
    made["inside_text"] = _inside(data)
    return made


def _text_from(span: Span | None) -> str:
    """The source from a place on."""
    return span.source.text[span.start : span.start + 80] if span else ""


def _code_before(span: Span | None) -> str:
    """The source up to a place, without comments."""
    return span.source.code[: span.start] if span else ""


def _types_text(types: list[str], language: str) -> str:
    """Expected types as a phrase: 'a RIGIDITE', 'an ENTIER or a FLOTTANT', 'one of A, B or C'."""
    if types == [ANY]:
        return message.sentence("any-object", {}, language)
    if len(types) <= 2:
        return or_(language).join(_article(t, language) for t in types)
    return message.sentence("one-of-types", {"types": types}, language)


# words of types that are feminine in French
_FEMININE = frozenset({"RIGIDITE", "TABLE", "EVOLUTIO", "PROCEDUR", "DEFORME", "ANNOTATI"})


def _article(kind: str, language: str) -> str:
    code = "an-object-of-type" if kind[0] in "AEIO" else "a-object-of-type"
    return message.sentence(code, {"kind": kind, "feminine": kind in _FEMININE}, language)


def or_(language: str) -> str:
    """What stands between words of which one is meant."""
    return f" {message.teller(language)('help.or')} "


def _expected(data: dict[str, object]) -> list[str]:
    expected = data.get("expected")
    return expected if isinstance(expected, list) else []


def _keyword_hint(data: dict[str, object]) -> hints.Hint:
    """A quoted word of the phrase that is nearly a keyword of its operator."""
    found = find_operator(str(data.get("operator", "")))
    quoted = data.get("quoted")
    if found is None or not isinstance(quoted, list):
        return ""
    keywords = [w.rstrip() for w in keywords_of(found)]
    others = words_of(found.name)
    beginnings = {w[:_LETTERS] for w in (*keywords, *others)}
    for word in quoted:
        dual = _dual_of_keyword(word.upper(), keywords) if word.upper() in others else ""
        if word.upper()[:_LETTERS] in beginnings and not dual:
            continue
        alike = [o for o in OPERATORS.values() if o.family == found.family]
        owner = next((o.name.strip() for o in alike if word.upper() in keywords_of(o)), "")
        if owner:
            return Sentence("keyword-of-another", word=word, operator=found.name, owner=owner)
        if dual:
            return Sentence("no-keyword", word=word, operator=found.name.strip(), near=dual)
        near = nearest(word, keywords) or nearest(word, others, SHORT_LIKE)
        if near:
            return Sentence("no-keyword", word=word, operator=found.name.strip(), near=near)
    return ""


def _dual_of_keyword(word: str, keywords: list[str]) -> str:
    """The keyword of two letters that differs from a component in the first alone: FX for UX."""
    duals = [k for k in keywords if len(k) == len(word) == 2 and k[1] == word[1]]
    return duals[0] if len(duals) == 1 and word not in keywords else ""


def _found(data: dict[str, object], language: str) -> str:
    kind = _article(str(data["found"]), language)
    detail = str(data.get("name") or "") or (f"'{data['value']}'" if data.get("value") else "")
    return f"{kind} ({detail})" if detail else kind


def _near_hint(data: dict[str, object], language: str, names: Iterable[str]) -> hints.Hint:
    if "name" not in data:
        return ""
    word = str(data["name"])
    if word in (names := frozenset(names)):  # of a word in quotes: the name alone is no error
        return Sentence("word-and-name", word=word)
    foreign = hints.foreign_hint(word)
    if foreign:
        return foreign
    known = elsewhere(word, language)
    candidates = {*OPERATORS, *(o.full_name for o in OPERATORS.values()), *names}
    # a misspelt long name may begin as an operator of another subject does
    near = nearest(word, candidates, VERY_LIKE if known else LIKE)
    if known and not (near and len(word) > _LETTERS):
        return known
    if near:
        return Sentence("did-you-mean", near=near)
    return Sentence("give-a-value", word=word)


def elsewhere(word: str, language: str) -> str:
    """What to say of a word of Cast3M that is no operator here, '' if it is none."""
    found = find_cast3m_word(word)
    if found is None or (found.kind != "table" and find_operator(found.name) is not None):
        return ""
    data: dict[str, Any] = {
        "name": found.name.replace(".", " "),
        "operator": found.kind != "procedure",
    }
    code = "out-of-scope"
    if found.here:
        code, data["name"] = "stands-first", word
    elif found.subject == IN_SCOPE:
        code, data["reason"] = "not-built", Sentence(f"help.reason-{found.reason}")
    else:
        data["subject"] = Sentence(f"help.subject-{found.subject}")
    return message.sentence(code, data, language)


def _syntax_hint(data: dict[str, object]) -> str:
    found = find_operator(str(data.get("operator", "")))
    if found is None:
        return ""
    family, operator, form = cast(Page, data.get("form_page", ("", "", "")))
    of_form = help_texts(family, operator).get(form, {})
    lines = str(of_form.get("syntax", found.help.syntax)).split("\n")
    given = data.get("quoted")
    quoted = [w for w in given if len(w) > 1] if isinstance(given, list) else []
    # of several forms, the one that a keyword of the phrase belongs to
    return next((line for line in lines for w in quoted if f"'{w[:4]}" in line), lines[0])


def _known_hint(data: dict[str, object]) -> hints.Hint:
    known = data.get("known")
    if not isinstance(known, list):
        return ""
    near = nearest(str(data.get("index")), [k for k in known if isinstance(k, str)])
    if near:
        return Sentence("did-you-mean", near=f"'{near}'")
    shown = ", ".join(_shown_index(k) for k in known[:_INDICES_SHOWN])
    more = f" ... {_shown_index(known[-1])}" if len(known) > _INDICES_SHOWN else ""
    return Sentence("indices-known", known=shown + more)


def _shown_index(index: object) -> str:
    """An index of a table as a script would write it; of other objects the type."""
    if isinstance(index, str | int | float):
        return repr(index)
    return type_of(index)


def _inside(data: dict[str, object]) -> hints.Hint:
    if not data.get("inside"):
        return ""
    where = f"{data['inside']} {data.get('inside_name', '')}".strip()
    return Sentence("innermost-block", where=where, line=data.get("line"))

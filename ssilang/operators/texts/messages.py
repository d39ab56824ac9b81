"""MESS, ERRE, SAUT, TITR: what a script says to its reader."""

from ssilang.messages.message import find
from ssilang.operators.prelude import *
from ssilang.operators.texts.words import TEXT, TEXT_IS_FREE, filling, read_text, written


@operator("MESS", *TEXT, family="output", full_name="MESSAGE", reads_itself=TEXT_IS_FREE)
def mess(call: Call) -> None:
    """Print one line."""
    call.session.print(read_text(call, apart=True))


_BLANK_LINES = 1000  # that SAUT prints at most
_OF_LIBRARY = "stdlib."
_STOPPED = 308  # Cast3M's number of an error that a script reports in its own words


def _tell(call: Call, code: str, values: Sequence[Any]) -> None:
    """What a procedure of the library refuses or warns of: a code, then what fills its sentence.

    The sentence says which of the two it is; a warning is shown at the call in the script.
    """
    if find(code).severity == "error":
        raise SsiError(code, call.span, **filling(values), number=_STOPPED)
    warning = SsiError(code, call.span, **filling(values))
    warning.warns = True
    frame = call.session.frame
    while frame.caller is not None:
        if frame.pending is not None:
            warning.calls.append((frame.procedure, frame.pending.span))
        frame = frame.caller
    call.session.report(warning)


_NUMBERED = {
    5: "operators.texts.out-of-tolerance",
    6: "operators.texts.no-memory",
    21: "operators.texts.incompatible-data",
    22: "operators.texts.not-foreseen",
    26: "operators.texts.not-implemented",
    37: "operators.texts.missing-object",
    153: "operators.texts.no-convergence",
    251: "operators.texts.forbidden-operation",
    626: "operators.texts.wrong-sub-type",
}
"""What the numbers most used in decks mean: codes of sentences in words of our own."""


ERRE = shared("ERRE", "output", full_name="ERREUR")


@ERRE.form()
def _numbered(
    call: Call,
    number: int = Arg("ENTIER", en="number of the message", range=ANY_NUMBER),
    values: tuple[Any, ...] = Key(
        "AVEC",
        many(
            "values",
            "MOT",
            "ENTIER",
            "FLOTTANT",
            "LOGIQUE",
            "LISTMOTS",
            "LISTENTI",
            "LISTREEL",
            range=CARRIED,
        ),
        default=(),
        en="what completes the message",
    ),
) -> None:
    if number == 0:
        return
    words: list[str] = []
    for value in values:
        many = value.values if isinstance(value, ListReel | ListEnti | ListMots) else [value]
        words += [written(float(v) if isinstance(value, ListReel) else v).strip() for v in many]
    said = " ".join(words)
    code = _NUMBERED.get(abs(number), "operators.texts.deck-stops")
    if number < 0:
        call.session.print(f" ***** {-number} ***** {said or call.session.told(code, said=said)}")
        return
    raise SsiError("erre", call.span, message=Sentence(code, said=said), number=number)


@ERRE.form()
def _worded(
    call: Call,
    text: str = Arg("MOT", en="what is wrong"),
    values: tuple[Any, ...] = Many(
        "MOT",
        "ENTIER",
        "FLOTTANT",
        "LOGIQUE",
        en="what completes a sentence of the library",
        range=CARRIED,
    ),
) -> None:
    if text.startswith(_OF_LIBRARY):
        _tell(call, str(text), values)
        return
    raise SsiError("erre", call.span, message=str(text), number=_STOPPED)


@operator("SAUT", family="output")
def saut(
    call: Call,
    count: int = Opt("ENTIER", default=1, en="number of lines", range=between(0, _BLANK_LINES)),
    what: str | None = Choice(("LIGN", "PAGE"), en="lines, or a page"),
) -> None:
    """Print blank lines."""
    for _ in range(1 if what == "PAGE" else count):
        call.session.print("")


@operator("TITR", *TEXT, family="output", full_name="TITRE", reads_itself=TEXT_IS_FREE)
def titr(call: Call) -> None:
    """Set the title."""
    workspace(call.session).title = read_text(call)

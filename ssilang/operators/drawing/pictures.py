"""Pictures of a run: their formats, names and numbers."""

from pathlib import Path

from ssilang.language.search import nearest
from ssilang.operators.files.outputs import run_output
from ssilang.operators.prelude import *

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FORMATS = {"PNG": ("png",), "SVG": ("svg",), "PDF": ("pdf",)}


def picture_formats(session: Session, usual: tuple[str, ...]) -> tuple[str, ...]:
    """Formats to write: the one of OPTI TRAC if it is PNG, SVG or PDF, else the usual ones."""
    return _FORMATS.get(str(workspace(session).options.get("TRAC", "")), usual)


def picture_name(session: Session, title: str, fallback: str) -> str:
    """Name of a picture: OPTI FTRA's file, else its title, else the name of what is drawn."""
    chosen = workspace(session).options.get("FTRA")
    if isinstance(chosen, str) and chosen.strip():
        return Path(chosen.strip()).stem
    return title.strip() or fallback


def save_picture(
    session: Session, figure: "Figure", name: str, usual: tuple[str, ...]
) -> list[Path]:
    """Write a figure under the next number; returns the files."""
    output = run_output(session)
    files = output.pictures.save(figure, name, picture_formats(session, usual))
    output.wrote(*files)
    return files


def asked(options: dict[str, Any]) -> dict[str, Any]:
    """Options that a statement gives, without those of other programs' windows."""
    idle = ("no_click", "logo")
    said = {k: v for k, v in options.items() if k not in idle}
    return {k: v for k, v in said.items() if v is not None and v is not False}


def tell_vain(call: Call, vain: Iterable[tuple[str, str]]) -> None:
    """Warn of words, each with the code of the reason, that change nothing in a picture."""
    for word, reason in vain:
        call.warn("operators.drawing.changes-nothing", word, word=word, why=Sentence(reason))


def refuse_rest(call: Call, words: Iterable[str]) -> None:
    """Refuse what a drawing statement has not read, before anything is drawn.

    FIN alone, where the ; before it is missing, ends the run behind the picture.
    """
    if not call.operands or [str(o.value).upper() for o in call.operands] == ["FIN"]:
        return
    left, known = call.operands[0], tuple(dict.fromkeys(words))
    call.used.append(left)
    if isinstance(left.value, str):
        if str(left.value).rstrip().upper()[:4] in known:
            raise call.error("operators.drawing.word-beside-another", left.value, said=left.value)
        near = nearest(str(left.value), known)
        raise call.error(
            "operators.drawing.unknown-word", left.value, said=left.value, near=near, words=known
        )
    raise call.error("operators.drawing.useless-operand", left.value, found=type_of(left.value))

"""INFO: the help of an operator or procedure, during a session."""

from __future__ import annotations

from ssilang.language.call import Call
from ssilang.language.library import standard_procedures
from ssilang.language.reference import find_page, page_text
from ssilang.language.registry import Help, operator


@operator(
    "INFO",
    family="session",
    full_name="INFORMATION",
    help=Help(
        en="Prints the help of an operator or of a procedure of the standard library.",
        fr="Affiche l'aide d'un opérateur ou d'une procédure de la bibliothèque.",
        syntax="INFO NAME1 ;",
        examples=("INFO DENS ;",),
    ),
    reads_itself=True,
)
def info(call: Call) -> None:
    """Print the page of the word that follows."""
    said = call.word()
    if said is None:
        raise call.missing(("MOT",))
    page = find_page(said, standard_procedures())
    if page is None:
        raise call.bad(
            f"there is no help about {said.upper()}", said, "`ssilang help` lists what there is"
        )
    call.session.print(page_text(page, call.session.language))

"""INFO, NOTI, AIDE: help during a session; SOUC: the flag of doubts."""

from __future__ import annotations

from ssilang.language.registry import OPERATORS, Help, operator
from ssilang.language.run.call import Call
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.reference import (
    operator_page,
    overview,
    procedure_page,
)
from ssilang.language.values import ListMots
from ssilang.operators.word_pages import help_text, near_name


@operator(
    "INFO",
    family="session",
    full_name="INFORMATION",
    help=Help(
        en="Prints the help of an operator, of a procedure of the standard library, of a law, an "
        "element, a parameter, a component or an option; of another word, what help knows of it.",
        fr="Affiche l'aide d'un opérateur, d'une procédure de la bibliothèque, d'une loi, d'un "
        "élément, d'un paramètre, d'une composante ou d'une option ; d'un autre mot, ce que l'aide "
        "en sait.",
        syntax="INFO NAME1 ;",
        examples=("INFO DENS ;", "INFO JOINT_SDM ;", "INFO 'uplift' ;"),
    ),
    reads_itself=True,
)
def info(call: Call) -> None:
    """Print the page of the word that follows."""
    said = call.word()
    if said is None:
        raise call.missing(("MOT",))
    text = help_text(said, call.session.language)
    if not text:
        near = near_name(said)
        hint = f"did you mean {near}?" if near else "`ssilang help` lists what there is"
        raise call.bad(f"there is no help about {said.upper()}", said, hint)
    call.session.print(text)


@operator(
    "NOTI",
    family="session",
    full_name="NOTICE",
    help=Help(
        en="Prints the list of all operators and procedures, a line each.",
        fr="Affiche la liste des opérateurs et des procédures, une ligne chacun.",
        syntax="NOTI (MOT1) ;",
        examples=("NOTI GIBI ;",),
    ),
    reads_itself=True,
)
def noti(call: Call) -> None:
    """Print the overview; the word that may follow chooses nothing here."""
    call.word()
    language = call.session.language
    call.session.print(overview(standard_procedures().values(), language))


@operator(
    "AIDE",
    family="session",
    help=Help(
        en="List of the operators and procedures whose help contains a text; the list is printed "
        "if it is not empty.",
        fr="Liste des opérateurs et procédures dont l'aide contient un texte ; la liste est "
        "affichée si elle n'est pas vide.",
        syntax="LISMO1 = AIDE MOT1 ;",
        examples=("L1 = AIDE 'EIGEN' ; LIST (DIME L1) ;",),
    ),
    reads_itself=True,
)
def aide(call: Call) -> ListMots:
    """Search the help in both languages, whatever the case."""
    said = call.word()
    if said is None:
        raise call.missing(("MOT",))
    pages = [operator_page(o) for n, o in sorted(OPERATORS.items()) if n == o.name]
    pages += [procedure_page(p) for p in standard_procedures().values()]
    wanted = said.upper()
    found = [
        p.name
        for p in pages
        if wanted in " ".join((p.name, p.full_name, p.title, p.help.en, p.help.fr)).upper()
    ]
    if found:
        call.session.print(" ".join(found))
    return ListMots(found)


@operator(
    "SOUC",
    family="session",
    full_name="SOUCI",
    help=Help(
        en="Flag of doubts: without argument, whether it is raised; with an ENTIER, raises it to "
        "that level (it only grows; 0 lowers it).",
        fr="Indicateur de soucis : sans argument, s'il est levé ; avec un ENTIER, le porte à ce "
        "niveau (il ne fait que croître ; 0 l'annule).",
        syntax="LOG1 = SOUC ; SOUC N1 ;",
        examples=("SOUC 2 ; LIST (SOUC) ; SOUC 0 ; LIST (SOUC) ;",),
    ),
    reads_itself=True,
)
def souc(call: Call) -> bool | None:
    """Read or set the flag, which lives in the session's options."""
    options = call.session.options
    level = int(options.get("SOUC", 0))
    operand = call.read("ENTIER")
    if operand is None:
        return level != 0
    options["SOUC"] = max(level, operand.value) if operand.value else 0
    return None

"""OPTI, VALE, DENS: the settings of a calculation, several in one statement."""

import sys

from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.kernel.matrices.matrix import PRIMAL_TO_DUAL
from ssilang.kernel.mesh.cells import POLYGON_SIDES
from ssilang.kernel.solvers.backends import PETSC
from ssilang.kernel.solvers.factor import COARSEST, FINEST
from ssilang.language.say.diagnostics import elsewhere
from ssilang.language.search import nearest, nearest_names
from ssilang.language.values import Texte
from ssilang.operators.prelude import *
from ssilang.operators.session.option_files import UNIT, include, read_file_option
from ssilang.operators.workspace import MULTIGRID_WORD, TOLERANCE

Reader = Callable[[Call, str], None]
READERS: dict[str, Reader] = {}
"""Option word -> function that reads its value from the call and stores it."""

# what VALE gives for an option that was never set
_DEFAULTS: dict[str, Any] = {
    "ACQU": 9, "ASSI": 0, "ATTE": 0, "CADR": 30.0, "COSC": "NOIR", "DEBU": 0, "DONN": 5,
    "ECHO": 1, "EPSI": "LINEAIRE", "EPTR": 1, "ERRE": 0, "FTRA": "", "IMPI": 0, "IMPR": 6,
    "ISOV": "SURFACE", "LANG": "FRAN", "LECT": 4, "LOCA": False, "NBP": 0, "NGMA": 100000,
    "NIVE": 19, "OMBR": True, "PARA": False, "PLAC": 0, "POLI": "8_BY_13", "POTR": "COURIER_14",
    "RESO": "DIRECTE", "REST": 2, "SAUV": 8, "SORT": 7, "SOUC": 0, "TRAC": "BENS", "VERI": 0,
    "SOLV": "AUTO", "ZERO": 4, "PETI": sys.float_info.min, "GRAN": sys.float_info.max,
    "PREC": sys.float_info.epsilon,
}  # fmt: skip
# cells of more than four straight sides go by one name
_CELLS = (*(c for c in CELL_TYPES if c not in POLYGON_SIDES), "POLY")
_MODES: dict[str, Mode] = {
    "AXIS": Mode.AXISYMMETRIC, "FOUR": Mode.FOURIER, "TRID": Mode.THREE_DIMENSIONAL,
    "UNID": Mode.UNIDIMENSIONAL, "CONT": Mode.PLANE_STRESS, "DEFO": Mode.PLANE_STRAIN,
    "GENE": Mode.GENERALISED_PLANE_STRAIN,
}  # fmt: skip
_LINES = ("PLAN", "AXIS", "SPHE")
_UNID = (
    "DYDZ", "DYCZ", "CYDZ", "CYCZ", "GYDZ", "GYCZ", "DYGZ", "CYGZ", "GYGZ", "AXDZ", "AXCZ", "AXGZ",
)  # fmt: skip
_KEPT_INTEGERS = ("ASSI", "ATTE", "DEBU", "ECHO", "EPTR", "IMPI", "NBP", "NGMA", "NIVE", "PLAC",
                  "SURV", "VERI", "ZERO", "SOUC")  # fmt: skip
_KEPT_REALS = ("CADR", "PETI", "GRAN", "PREC")
_NUMBERS = {
    "DIME": arg("DIME", "ENTIER", en="dimensions of space", range=between(1, 3)),
    "DENS": arg("DENS", "FLOTTANT", en="mesh size", range=POSITIVE),
    "FOUR": arg("FOUR", "ENTIER", en="number of the harmonic", range=ANY_NUMBER),
    **{w: arg(w, "ENTIER", range=ANY_NUMBER) for w in _KEPT_INTEGERS},
    **{w: arg(w, "FLOTTANT", range=POSITIVE) for w in _KEPT_REALS},
}
"""What options that are numbers may be."""
_RESIDUAL = opt(
    "MULTIGRILLE", "FLOTTANT", en="residual at which it ends, 1e-12 without a number",
    range=between(FINEST, COARSEST),
)  # fmt: skip
_SCALES = arg("NORM", "LISTREEL", en="scales of unknowns", range=POSITIVE)
_ENGLISH = {"STRESS": "CONT", "STRAIN": "DEFO"}  # behind MODE PLAN
_UNNUMBERED = 5  # what an error without a number of Cast3M's counts as
_KNOWN_BY_SESSION = frozenset({"ECHO", "ERRE", "DEBU", "VERI", "FREQ", "LOCA"})


def reader(*words: str) -> Callable[[Reader], Reader]:
    """Decorator: how these options are read."""

    def add(body: Reader) -> Reader:
        for word in words:
            READERS[word] = body
        return body

    return add


def _store(call: Call, word: str, value: Any) -> None:
    workspace(call.session).options[word] = value
    if word in _KNOWN_BY_SESSION:
        call.session.options[word] = value


def value_word(call: Call) -> str:
    """The word that follows the keyword just read, also when a variable bears that name."""
    for operand in call.operands:
        if operand.span.start < call.keyword_end:
            continue
        if isinstance(operand.value, str):
            break
        if operand.name and not isinstance(operand.value, Texte):
            call.operands.remove(operand)
            call.used.append(operand)
            return operand.name
        break
    return str(call.required("MOT", after=call.keyword_end))


def _one_of(call: Call, option: str, words: tuple[str, ...]) -> str:
    said = value_word(call).upper().rstrip()
    for word in words:
        if said[:4] == word[:4].rstrip():
            return word
    raise _no_value(call, option, said, words)


def _no_value(
    call: Call, option: str, said: str, words: tuple[str, ...], *, quoted: bool = False
) -> SsiError:
    from ssilang.operators.vocabulary.words import told_values  # knows the kernel: slow to load

    outside = elsewhere(said, call.session.language)
    told = [outside] if outside else told_values(option, words, call.session.language)
    return SsiError(
        "operators.session.no-value-of-option",
        call.used[-1].span,
        said=said,
        option=option,
        near=_shown(nearest(said, words, 0.5), quoted),
        values=[_shown(w, quoted) for w in words],
        told="".join(f"\n{line}" for line in told),
    )


def _shown(word: str, quoted: bool) -> str:
    return f"'{word}'" if quoted and word else word


@reader("DIME")
def _dime(call: Call, word: str) -> None:
    n = call.given(_NUMBERS[word], call.keyword_end)
    ws = workspace(call.session)
    ws.dimension = n
    if ws.mode.dimension != n:
        ws.mode = {1: Mode.UNIDIMENSIONAL, 2: Mode.PLANE_STRAIN, 3: Mode.THREE_DIMENSIONAL}[n]


@reader("ELEM")
def _elem(call: Call, word: str) -> None:
    workspace(call.session).element = _one_of(call, "ELEM", _CELLS)


@reader("DENS")
def _dens(call: Call, word: str) -> None:
    workspace(call.session).density = float(call.given(_NUMBERS[word], call.keyword_end))


@reader("COUL")
def _coul(call: Call, word: str) -> None:
    workspace(call.session).colour = index_of(value_word(call))


@reader("MODE")
def _mode(call: Call, word: str) -> None:
    ws = workspace(call.session)
    said = _one_of(call, "MODE", ("PLAN", "AXIS", "FOURIER", "TRID", "UNID", "FREQ"))
    glued = str(call.used[-1].value).upper().rstrip()[4:]  # PLANCONT, as VALE 'MODE' says it
    _store(call, "FREQ", said == "FREQ")
    if said == "FREQ":  # the hypothesis on displacements stays
        return
    if said == "PLAN":
        said = call.keyword(("CONT", "DEFO", "GENE")) or (glued if glued in _MODES else "DEFO")
        if said == "GENE":
            point = call.read("POINT", after=call.keyword_end, only=True)
            _store(call, "DPGE", point and point.value)
    elif said == "FOURIER":
        said = "FOUR"
        if call.keyword(("NOHARM",)) is None:
            ws.fourier = call.given(_NUMBERS[said], call.keyword_end)
        if ws.dimension == 3:  # a harmonic asked for after CREER_3D went to space
            ws.dimension = 2
    elif said == "UNID":
        line = call.keyword(_LINES) or (glued[:4] if glued[:4] in _LINES else "PLAN")
        across = call.keyword(_UNID) or (glued[4:] if glued[4:] in _UNID else "DYDZ")
        if (word := across if line == "PLAN" else line) != "DYDZ":
            raise call.error("operators.session.line-not-built", word=word)
    ws.mode = _MODES[said]


@reader("OEIL")
def _oeil(call: Call, word: str) -> None:
    _store(call, word, call.required("POINT", after=call.keyword_end))


@reader(*_KEPT_INTEGERS, *_KEPT_REALS)
def _number(call: Call, word: str) -> None:
    _store(call, word, call.given(_NUMBERS[word], call.keyword_end))


@reader("OMBR", "PARA", "LOCA")
def _logical(call: Call, word: str) -> None:
    _store(call, word, call.required("LOGIQUE", after=call.keyword_end))


@reader("COSC", "ISOV", "POLI", "POTR", "RESO", "NAVI", "TITR", "ECRA")
def _word(call: Call, word: str) -> None:
    _store(call, word, Mot(value_word(call).rstrip()))


@reader("EPSI")
def _strain(call: Call, word: str) -> None:
    known = ("LINEAIRE", "QUADRATIQUE", "TRUESDELL", "JAUMANN", "UTILISATEUR")
    said = _one_of(call, word, known)
    _store(call, word, Mot(said))
    if said != "LINEAIRE":
        call.warn("operators.session.strain-measure-without-effect", word=said)


@reader("TRAC")
def _trac(call: Call, word: str) -> None:
    known = ("BENSON", "IBM", "GKS", "PHIGS", "X", "PS", "PSC", "MIF", "OPENGL", "XWINDOW",
             "PSC8", "PNG", "SVG", "PDF")  # fmt: skip
    _store(call, word, Mot(_one_of(call, "TRAC", known)))


@reader("ERRE")
def _erre(call: Call, word: str) -> None:
    _store(call, word, Mot(_one_of(call, "ERRE", ("FATALE", "NORMALE", "CONTROLE", "IGNORE"))))


@reader("UNIT")
def _unit(call: Call, word: str) -> None:
    said = value_word(call).upper().rstrip()
    if said not in SYSTEMS:  # whole: MN-MM is not MN-M
        raise _no_value(call, "UNIT", said, tuple(SYSTEMS), quoted=True)
    _store(call, word, Mot(said))


@reader("SOLV")
def _solv(call: Call, word: str) -> None:
    said = _one_of(call, "SOLVEUR", ("AUTO", PETSC, MULTIGRID_WORD))
    if said == PETSC and workspace(call.session).petsc is None:
        raise call.error("kernel.solvers.petsc-no-command", call.used[-1].value)
    _store(call, word, Mot(said))
    _store(call, TOLERANCE, call.given(_RESIDUAL) if said == MULTIGRID_WORD else None)


@reader("LANG")
def _lang(call: Call, word: str) -> None:
    said = value_word(call).upper()
    call.session.language = "fr" if said.startswith("FRA") else "en"
    _store(call, word, Mot(said[:4]))


@reader("INCO")
def _inco(call: Call, word: str) -> None:
    primal = call.required("LISTMOTS", "MOT", after=call.keyword_end)
    dual = call.required("LISTMOTS", "MOT", after=call.keyword_end)
    names = [
        [str(w).strip()[:4] for w in (said.values if isinstance(said, ListMots) else [said])]
        for said in (primal, dual)
    ]
    if len(names[0]) != len(names[1]):
        told = {"n_primal": len(names[0]), "n_dual": len(names[1])}
        raise call.error("operators.session.unknowns-in-pairs", dual, **told)
    earlier = workspace(call.session).options.get(word, {})
    _store(call, word, {**earlier, **dict(zip(*names, strict=True))})


@reader("NORM")
def _norm(call: Call, word: str) -> None:
    said = call.keyword(("AUTO", "ANNU"))
    if said is not None:
        _store(call, word, Mot(said))
        return
    pairs: list[Any] = []
    while (names := call.read("LISTMOTS")) is not None:
        pairs += [names.value, call.given(_SCALES)]
    _store(call, word, tuple(pairs))


READERS.update(
    dict.fromkeys(("ACQU", "FTRA", "IMPR", "LECT", "REST", "SAUV", "SORT"), read_file_option)
)


@reader("DONN")
def _donn(call: Call, word: str) -> None:
    said = call.given(UNIT)
    if isinstance(said, str):
        include(call, said)


@operator(
    "OPTI",
    each(
        "settings",
        arg("option", "MOT", en="option", kind="option"),
        arg("value", en="its value"),
        en="options, each with its value",
    ),
    family="session",
    full_name="OPTION",
    gives=(),
    reads_itself="each option reads its value, a word even where a variable bears its name",
)
def opti(call: Call) -> None:
    """Read option after option; then check that mode and dimension agree."""
    options = sorted(READERS)
    found = False
    while (word := call.keyword(options)) is not None:
        READERS[word](call, word)
        found = True
    left = call.peek_word()
    if left is not None:
        word = call.word()
        raise _unknown_option(call, left, word)
    if not found:
        raise call.error("operators.session.no-option")
    ws = workspace(call.session)
    if ws.dimension and ws.mode.dimension != ws.dimension:
        told = {"mode": ws.mode.value, "dimension": ws.mode.dimension, "present": ws.dimension}
        if ws.dimension != 3:
            raise call.error("operators.session.mode-and-dimension", **told)
        call.warn("operators.session.mode-in-space", mode=ws.mode.value)
        ws.mode = Mode.THREE_DIMENSIONAL


def _unknown_option(call: Call, said: str, word: str | None = None) -> SsiError:
    hidden = next((o for o in (*call.operands, *call.used) if o.name[:4] in READERS), None)
    if hidden is not None:
        return SsiError(
            "operators.session.hidden-option",
            hidden.span,
            name=hidden.name,
            found=type_of(hidden.value),
            said=word or said,
        )
    meant = _ENGLISH.get((word or said).upper().strip())
    near = [meant] if meant else nearest_names(said.strip()[:4], sorted(READERS), 0.5)
    from ssilang.operators.vocabulary.words import told_options

    told = told_options(near, call.session.language)
    return SsiError(
        "operators.session.unknown-option",
        call.used[-1].span if call.used else call.span,
        said=word or said,
        near=near[0] if near else "",
        options=sorted(READERS),
        told="".join(f"\n{line}" for line in told),
    )


_CURRENT: dict[str, Callable[[Workspace], Any]] = {
    "DIME": lambda ws: ws.dimension,
    "ELEM": lambda ws: Mot(ws.element or "    "),
    "DENS": lambda ws: ws.density,
    "COUL": lambda ws: Mot(COLOURS[ws.colour]),
    "MODE": lambda ws: Mot("FREQ" if ws.in_frequency else ws.mode.value.replace(" ", "")),
}


@operator("VALE", gives=ANY, family="session", full_name="VALEUR", terminal=True)
def vale(
    call: Call,
    said: str = Lead("MOT", en="option", kind="option"),
    harmonic: bool = Flag("FOUR", en="the harmonic of MODE FOUR"),
) -> Any:
    """Read an option back."""
    ws = workspace(call.session)
    word = said.upper()[:4].rstrip()
    if word == "ERMA":
        shown = [w for w in call.session.warnings if getattr(w, "severity", "") == "error"]
        return max((int(w.data.get("number") or _UNNUMBERED) for w in shown), default=0)
    if not any(word in known for known in (_CURRENT, _DEFAULTS, READERS)):
        raise _unknown_option(call, said.upper(), said)
    if word == "MODE" and harmonic:
        return ws.fourier
    if word == "INCO":
        pairs = {**PRIMAL_TO_DUAL, **ws.options.get("INCO", {})}
        return ListMots(list(pairs)), ListMots(list(pairs.values()))
    if word in _CURRENT:
        return _CURRENT[word](ws)
    value = ws.options.get(word, _DEFAULTS.get(word))
    if value is None:
        raise call.error("operators.session.option-not-set", word=word)
    if word == "ERRE":
        return {"IGNORE": 2, "CONTROLE": 1}.get(str(value), 0)
    return Mot(value) if isinstance(value, str) else value


@operator("DENS", family="mesh", full_name="DENSITE")
def dens(
    session: Session, size: float = Arg("FLOTTANT", en="mesh size", unit="m", range=POSITIVE)
) -> None:
    """Set the density in force."""
    workspace(session).density = size

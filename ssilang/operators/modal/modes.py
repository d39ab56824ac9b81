"""VIBR: natural modes, as the language's table BASE_MODALE."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ssilang.kernel.matrices.assembly import is_symmetric
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.submatrices import support_mesh
from ssilang.kernel.mesh.mesh import Point
from ssilang.kernel.modal.complex_modes import ComplexMode, complex_modes
from ssilang.kernel.modal.modes import Mode, modes_between, modes_near
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Mot, Table
from ssilang.operators.matrices.doubled import warn_doubled_supports
from ssilang.operators.workspace import workspace

_METHODS = ("PROCHE", "INTERVALLE", "SIMULTANE", "IRAM")
_OPTIONS = ("IMPR", "BASSE", "HAUTE", "MULT", "TBAS", "LM")


class _Asked:
    """What VIBR's words say: method, frequencies, numbers of modes."""

    def __init__(self, call: Call) -> None:
        self.method = ""
        self.wanted: list[tuple[float, int]] = []
        self.interval = (0.0, 0.0)
        self.lowest = self.highest = 0
        self.decay = 0.0
        while (word := call.keyword((*_METHODS, *_OPTIONS))) is not None:
            if word in _METHODS:
                self.method = word
                _READERS[word](self, call)
            elif word == "BASSE":
                self.lowest = call.required("ENTIER", after=call.keyword_end)
            elif word == "HAUTE":
                self.highest = call.required("ENTIER", after=call.keyword_end)
        if not self.method:
            raise call.error("operators.modal.which-method", methods=_METHODS)

    def read_near(self, call: Call) -> None:
        """PROCHE: frequencies, and how many modes near each (default 1)."""
        place = call.keyword_end
        frequencies = call.required("LISTREEL", after=place).values
        counts = call.read("LISTENTI", after=place)
        numbers = [1] * len(frequencies) if counts is None else list(counts.value.values)
        if len(numbers) != len(frequencies):
            raise call.error(
                "operators.modal.frequencies-and-numbers-differ",
                n_frequencies=len(frequencies),
                n_numbers=len(numbers),
            )
        self.wanted = [(float(f), int(n)) for f, n in zip(frequencies, numbers, strict=True)]

    def read_interval(self, call: Call) -> None:
        """INTERVALLE: two frequencies."""
        place = call.keyword_end
        low, high = call.required("FLOTTANT", after=place), call.required("FLOTTANT", after=place)
        self.interval = (min(low, high), max(low, high))

    def read_number(self, call: Call) -> None:
        """SIMULTANE and IRAM: a frequency and a number of modes."""
        place = call.keyword_end
        frequency = float(call.required("FLOTTANT", after=place))
        count = max(int(call.required("ENTIER", after=place)), 1)
        self.wanted = [(frequency, count)]
        if self.method == "IRAM":
            decay = call.read("FLOTTANT")
            self.decay = 0.0 if decay is None else float(decay.value)

    def cut(self, modes: list[Mode]) -> list[Mode]:
        """INTERVALLE with BASSE or HAUTE: so many modes from one end."""
        if self.lowest:
            return modes[: self.lowest]
        return modes[-self.highest :] if self.highest else modes


_READERS = {
    "PROCHE": _Asked.read_near,
    "INTERVALLE": _Asked.read_interval,
    "SIMULTANE": _Asked.read_number,
    "IRAM": _Asked.read_number,
}


def _vibr(call: Call) -> Table:
    if (word := call.keyword(("SOLU",))) is not None:
        raise call.error("operators.modal.no-solution-object", word=word)
    asked = _Asked(call)
    matrices: list[Matrix] = call.all("RIGIDITE")
    if len(matrices) < 2:
        raise call.missing(("RIGIDITE",))
    signed = call.optional("LOGIQUE", default=True)
    stiffness, mass, damping = matrices_by_kind(matrices)
    warn_doubled_supports(call.session, call.span, "VIBR", stiffness)
    if damping is not None or not (is_symmetric(stiffness) and is_symmetric(mass)):
        return _complex(call, asked, stiffness, mass, damping)
    if asked.method == "INTERVALLE":
        modes = asked.cut(modes_between(stiffness, mass, *asked.interval))
    else:
        modes = modes_near(stiffness, mass, asked.wanted)
    return modal_table(call, mass, [_real_entry(m, signed) for m in modes])


def matrices_by_kind(
    matrices: Sequence[Matrix], mass_first: bool = False
) -> tuple[Matrix, Matrix, Matrix | None]:
    """Stiffness, mass and damping, by their kinds where these tell, else in that order.

    `mass_first`: else mass, stiffness, damping.
    """
    left = list(matrices[:3])
    masses = [m for m in left if m.kind.startswith("MASS")]
    mass = masses[0] if len(masses) == 1 else left[0 if mass_first else 1]
    left.remove(mass)
    damped = [m for m in left if m.kind.startswith("AMOR")]
    if len(left) == 2:
        damping = damped[0] if len(damped) == 1 else left[1]
        left.remove(damping)
        return left[0], mass, damping
    return left[0], mass, None


def _complex(
    call: Call, asked: _Asked, stiffness: Matrix, mass: Matrix, damping: Matrix | None
) -> Table:
    if asked.method != "IRAM":
        raise call.error("operators.modal.complex-modes")
    frequency, count = asked.wanted[0]
    near = complex(frequency, asked.decay)
    modes = complex_modes(stiffness, mass, damping, near, count)
    return modal_table(call, mass, [_complex_entry(m) for m in modes])


# --- tables ----------------------------------------------------------------------------------


def filled(subtype: str, items: dict[Any, Any]) -> Table:
    """A table of a sub-type with its entries."""
    table = Table(subtype)
    for index, value in items.items():
        table.set(Mot(index) if isinstance(index, str) else index, value)
    return table


def _directions(values: Sequence[float]) -> Table:
    return filled("DEPLACEMENTS_GENERALISES", {i + 1: float(v) for i, v in enumerate(values)})


def _real_entry(mode: Mode, signed: bool) -> dict[str, Any]:
    return {
        "FREQUENCE": mode.frequency if signed else abs(mode.frequency),
        "MASSE_GENERALISEE": mode.mass,
        "DEPLACEMENTS_GENERALISES": _directions(mode.along),
        "DEFORMEE_MODALE": mode.shape,
    }


def _complex_entry(mode: ComplexMode) -> dict[str, Any]:
    return {
        "FREQUENCE_REELLE": mode.frequency.real,
        "MASSE_GENERALISEE_REELLE": mode.mass.real,
        "DEFORMEE_MODALE_REELLE": mode.real,
        "DEPLACEMENTS_GENERALISES_REELS": _directions([a.real for a in mode.along]),
        "FREQUENCE_IMAGINAIRE": mode.frequency.imag,
        "MASSE_GENERALISEE_IMAGINAIRE": mode.mass.imag,
        "DEFORMEE_MODALE_IMAGINAIRE": mode.imaginary,
        "DEPLACEMENTS_GENERALISES_IMAGINAIRES": _directions([a.imag for a in mode.along]),
    }


def modal_table(
    call: Call, mass: Matrix, entries: list[dict[str, Any]], subtype: str = "MODE"
) -> Table:
    """The BASE_MODALE table of modes, each with a point of its own that marks it."""
    ws = workspace(call.session)
    modes = filled("BASE_DE_MODES", {"MAILLAGE": support_mesh(mass)})
    for number, entry in enumerate(entries, start=1):
        mark = Point(ws.nodes, int(ws.nodes.add([[0.0, 0.0, 0.0]])[0]))  # type: ignore[arg-type]
        modes.set(number, filled(subtype, {"NUMERO_MODE": number, "POINT_REPERE": mark, **entry}))
    return filled("BASE_MODALE", {"MODES": modes})


operator(
    "VIBR",
    family="modal",
    full_name="VIBRATION",
    help=Help(
        "Natural modes, [K - (2 pi f)^2 M] x = 0, of frequencies near the given ones (PROC: for "
        "each frequency of a list, so many; SIMU, IRAM: so many near one) or in an interval "
        "(INTE; BASS or HAUT keeps so many from one end). Table BASE_MODALE: . 'MODES' . i holds "
        "FREQUENCE (negative if unstable, unless FAUX is given), MASSE_GENERALISEE, "
        "DEFORMEE_MODALE (largest displacement 1), DEPLACEMENTS_GENERALISES . 1 to 3 and "
        "POINT_REPERE. Unilateral conditions count as equalities. A damping matrix or an "
        "unsymmetric stiffness gives complex modes (IRAM), mirror images (- conj f) included.",
        "Modes propres, [K - (2 pi f)^2 M] x = 0, de fréquences voisines de celles données "
        "(PROC : pour chaque fréquence d'une liste, tant ; SIMU, IRAM : tant autour d'une) ou "
        "dans un intervalle (INTE ; BASS ou HAUT en garde tant d'un côté). Table BASE_MODALE : "
        ". 'MODES' . i contient FREQUENCE (négative si instable, sauf avec FAUX), "
        "MASSE_GENERALISEE, DEFORMEE_MODALE (plus grand déplacement 1), "
        "DEPLACEMENTS_GENERALISES . 1 à 3 et POINT_REPERE. Les conditions unilatérales comptent "
        "comme des égalités. Une matrice d'amortissement ou une raideur non symétrique donne "
        "des modes complexes (IRAM), images (- conj f) comprises.",
        "TAB1 = VIBR 'PROCHE' LREEL1 (LENTI1) RIG1 MASS1 (LOG1) ;\n"
        "TAB1 = VIBR 'INTERVALLE' F1 F2 ('BASSE' | 'HAUTE' N1) ('MULT') RIG1 MASS1 ;\n"
        "TAB1 = VIBR 'SIMULTANE' F1 N1 RIG1 MASS1 ;\n"
        "TAB1 = VIBR 'IRAM' F1 N1 RIG1 MASS1 (AMO1) ('LM') ;",
        (
            "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 400. P1 ;"
            " M1 = MASS 'UX' 4. P1 ; T1 = VIBR 'SIMU' 1. 1 K1 M1 ;"
            " LIST (T1 . 'MODES' . 1 . 'FREQUENCE') ;",
        ),
    ),
    reads_itself=True,
)(_vibr)

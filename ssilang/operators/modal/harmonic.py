"""IMPE VIBC: matrices of harmonic motions, complex modes of small systems."""

from ssilang.kernel.matrices.impedance import factors, impedance
from ssilang.kernel.modal.modes import ComplexMode, conjugate_modes
from ssilang.operators.modal.basis import Shape, shapes_of
from ssilang.operators.modal.modes import matrices_by_kind, modal_table
from ssilang.operators.modal.recombination import recombined
from ssilang.operators.prelude import *

_KINDS = {"RIGI": "RAIDEUR", "MASS": "MASSE", "AMOR": "AMORTISSEMENT"}


@operator("IMPE", family="modal", full_name="IMPEDANCE")
def _impe(
    call: Call,
    kind_of: str | None = Choice(
        ("MASSE", "RAIDEUR", "AMORTISSEMENT"), en="what the matrix is, by its type without it"
    ),
    four: ListReel | None = Key(
        "QUELCONQUE", "LISTREEL", range=ANY_NUMBER, en="factors of the four blocks"
    ),
    matrix: Matrix = Arg("RIGIDITE", en="matrix"),
    other: Matrix | None = Opt("RIGIDITE", en="of the imaginary rows"),
    pulsation: float = Opt(
        "FLOTTANT",
        default=1.0,
        en="circular frequency, 1 without it",
        unit="rad/s",
        usual=NOT_NEGATIVE,
    ),
    buckling: bool = Opt("LOGIQUE", default=False, en="of type MASSE"),
) -> Matrix:
    kind = "MASSE" if buckling else matrix.kind
    if four is not None:
        values = [float(v) for v in four.values]
        if len(values) != 4:
            raise call.error("operators.modal.four-numbers-wanted", four)
        return impedance(matrix, (values[0], values[1], values[2], values[3]), kind, other)
    said = kind_of or _KINDS.get(matrix.kind[:4], "RAIDEUR")
    turned = other is not None and said == "AMORTISSEMENT"
    return impedance(matrix, factors(said, pulsation), kind, other, turned)


def _entry(mode: ComplexMode, shapes: list[Shape] | None) -> dict[str, Any]:
    def physical(field: NodeField) -> NodeField:
        return field if shapes is None else recombined(field, shapes)

    return {
        "FREQUENCE_REELLE": mode.frequency.real,
        "FREQUENCE_IMAGINAIRE": mode.frequency.imag,
        "DEFORMEE_MODALE_REELLE": physical(mode.real),
        "DEFORMEE_MODALE_IMAGINAIRE": physical(mode.imaginary),
    }


@operator("VIBC", family="modal", full_name="VIBC")
def _vibc(
    call: Call,
    matrices: tuple[Matrix, ...] = Many("RIGIDITE", en="mass, stiffness, and damping"),
    basis: Table | None = Opt("TABLE", en="basis of the projection"),
    pairs: int | None = Opt("ENTIER", range=POSITIVE, en="number of couples, all without it"),
) -> Table:
    if len(matrices) not in (2, 3):
        raise call.error("operators.modal.matrices-of-vibc", n_matrices=len(matrices))
    stiffness, mass, damping = matrices_by_kind(matrices, mass_first=True)
    modes = conjugate_modes(stiffness, mass, damping, pairs)
    shapes = None if basis is None else shapes_of(call, basis)
    table = modal_table(call, mass, [_entry(m, shapes) for m in modes], "MODE_COMPLEXE")
    table.set("CONVERGENCE", True)
    return table

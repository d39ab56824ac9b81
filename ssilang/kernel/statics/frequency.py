"""Harmonic responses: `[K + i w C - w^2 M + Z(f)] u = F(f)` over a sweep of frequencies.

Forces and displacements are `Re(u exp(i w t))`, w = 2 pi f; their imaginary parts are components
of their own (IUX beside UX, IFX beside FX).
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import FieldError, KernelError, SingularMatrixError
from ssilang.kernel.base.scientific import la, sp, spla
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.elements.family import element_matrices
from ssilang.kernel.elements.springs import dynamic_stiffness
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, imaginary
from ssilang.kernel.stepping.problem.loading import is_mechanical, terms_of

_DENSE = 300
"""Up to this many unknowns full matrices are faster than sparse ones."""
_LARGEST_GUESS = 600
"""Up to this many unknowns the natural frequencies are found for a default sweep."""


@dataclass(frozen=True, eq=False)
class HarmonicInputs:
    """What vibrates.

    Attributes
    ----------
    stiffness : Matrix
        With the conditions; unilateral ones are refused.
    load : Load or None
        Fields times functions of the frequency; FLX imposes values of the conditions.
    springs : tuple of (Zone, ZoneField)
        Impedances that depend on the frequency.
    """

    stiffness: Matrix
    mass: Matrix | None
    damping: Matrix | None
    load: Load | None
    springs: tuple[tuple[Zone, ZoneField], ...] = ()


@dataclass(frozen=True, eq=False)
class Harmonic:
    """The response at one frequency: displacements (UX IUX ...), reactions (FX IFX ...)."""

    frequency: float
    displacement: NodeField
    reactions: NodeField


def sweep(inputs: HarmonicInputs, frequencies: FloatArray) -> Iterator[Harmonic]:
    """The responses at frequencies in Hz, one after the other.

    Raises
    ------
    SingularMatrixError
        At a frequency where the system is singular: resonance without damping, free motions at 0.
    KernelError
        For unilateral conditions.
    FieldError
        For forces on unknowns that the matrices lack.
    """
    system = _System(inputs)
    for frequency in frequencies:
        yield system.at(float(frequency))


class _System:
    """Assembled parts of a sweep, on one numbering."""

    def __init__(self, inputs: HarmonicInputs) -> None:
        self.springs = inputs.springs
        matrices = [m for m in (inputs.stiffness, inputs.mass, inputs.damping) if m is not None]
        here = Matrix(inputs.stiffness.table, tuple(b for b, _ in self._spring_blocks(1.0)))
        self.numbering = assembly.numbering_of(*matrices, here)
        self.rows: assembly.ConstraintRows = assembly.constraint_matrix(
            inputs.stiffness, self.numbering
        )
        if self.rows.sense.any():
            raise KernelError("kernel.statics.unilateral-condition-no-harmonic")
        self.K, self.M, self.C = (
            sp.csr_array((self.numbering.size,) * 2)
            if m is None
            else assembly.assemble(m, self.numbering)
            for m in (inputs.stiffness, inputs.mass, inputs.damping)
        )
        self.loads = list(_loads(inputs.load, self.numbering, self.rows))

    def _spring_blocks(self, frequency: float) -> list[tuple[ElementMatrices, ElementMatrices]]:
        """Real and imaginary parts of the impedances that depend on the frequency."""
        found = []
        for zone, parameters in self.springs:
            made = dynamic_stiffness(zone, parameters, frequency)
            if made is not None:
                real = element_matrices(zone, made[1], made[0].real, "RIGIDITE")
                found.append((real, replace(real, values=made[0].imag)))
        return found

    def operator(self, frequency: float) -> sp.csr_array:
        """`K + i w C - w^2 M + Z(f)`."""
        w = 2.0 * np.pi * frequency
        parts: tuple[Any, Any, Any] = (self.K, self.M, self.C)
        K, M, C = parts
        total = K - w * w * M + 1j * w * C
        pairs = self._spring_blocks(frequency)
        for factor, blocks in ((1.0, [r for r, _ in pairs]), (1j, [i for _, i in pairs])):
            if blocks:
                part: Any = assembly.assemble_blocks(blocks, self.numbering)
                total = total + factor * part
        return sp.csr_array(total)

    def at(self, frequency: float) -> Harmonic:
        """Displacement and reactions."""
        n = self.numbering.size
        f, d = np.zeros(n, complex), np.zeros(len(self.rows.multipliers), complex)
        for force, imposed, (x, y) in self.loads:
            factor = np.interp(frequency, x, y)
            f += factor * force
            d += factor * imposed
        A = self.operator(frequency)
        scale = float(abs(A).max()) if A.nnz else 1.0
        C, D = scale * self.rows.C, scale * self.rows.D
        rows: list[list[Any]] = [[A, D.T], [C, None]]
        b = np.concatenate([f, scale * d])
        solution = _solved(sp.csc_array(sp.block_array(rows) if len(d) else A), b, frequency)
        u, multipliers = solution[:n], scale * solution[n:]
        reactions = -np.asarray(self.rows.D.T @ multipliers)
        return Harmonic(
            frequency, self._field(u, False, multipliers), self._field(reactions, True, None)
        )

    def _field(
        self, values: ComplexArray, dual: bool, multipliers: ComplexArray | None
    ) -> NodeField:
        def part(take: str) -> NodeField:
            more = None
            if multipliers is not None:
                more = (self.rows.multipliers, getattr(multipliers, take))
            return assembly.vector_to_field(getattr(values, take), self.numbering, dual, more)

        real = part("real")
        parts = {**real.components}
        parts |= {imaginary(name): p for name, p in part("imag").components.items()}
        return NodeField(real.table, parts, real.nature)


def _solved(A: sp.csc_array, b: ComplexArray | FloatArray, frequency: float) -> ComplexArray:
    try:
        x = np.linalg.solve(A.toarray(), b) if len(b) <= _DENSE else spla.splu(A).solve(b)
    except (np.linalg.LinAlgError, RuntimeError):
        x = np.full(len(b), np.nan)
    size = float(np.abs(b).max()) if len(b) else 0.0
    rest = np.asarray(A @ x) - b
    if not np.isfinite(x).all() or np.abs(rest).max() > 1e-6 * size:
        raise SingularMatrixError("kernel.statics.hz-system-singular", frequency=frequency)
    return np.asarray(x, dtype=np.complex128)


def _loads(
    load: Load | None, numbering: assembly.Numbering, rows: assembly.ConstraintRows
) -> Iterator[tuple[ComplexArray, ComplexArray, tuple[FloatArray, FloatArray]]]:
    """Complex forces, imposed values and functions of the frequency of the parts of a load."""
    for part in load.parts if load is not None else ():
        if not is_mechanical(part):
            raise FieldError("kernel.statics.load-not-mechanical", name=part.name)
        for field, curve in terms_of(part):
            if not isinstance(field, NodeField):
                raise FieldError("kernel.statics.mechanical-load-made-nodal")
            real, other = split(field, numbering)
            lost = assembly.outside(real, numbering) + assembly.outside(other, numbering)
            if lost:
                raise FieldError("kernel.statics.load-matrices-lack", name=part.name, lost=lost[0])
            forces = [assembly.field_to_vector(g, numbering) for g in (real, other)]
            imposed = [assembly.imposed_values(g, rows.multipliers) for g in (real, other)]
            yield forces[0] + 1j * forces[1], imposed[0] + 1j * imposed[1], curve


def split(field: NodeField, numbering: assembly.Numbering) -> tuple[NodeField, NodeField]:
    """Real and imaginary parts of a field of forces, both under the names of real ones."""
    names = {imaginary(d): d for d in (*numbering.duals, "FLX")}
    other = {names[n]: p for n, p in field.components.items() if n in names}
    real = {n: p for n, p in field.components.items() if n not in names}
    return (NodeField(field.table, real, field.nature), NodeField(field.table, other, field.nature))


def default_frequencies(inputs: HarmonicInputs) -> FloatArray:
    """Frequencies that show every resonance of a small system.

    From a twentieth of the lowest natural frequency to twice the highest one, within the
    functions of the load, closer around each of them.

    Raises
    ------
    KernelError
        If the system is large, or has no natural frequency.
    """
    system = _System(inputs)
    if system.numbering.size > _LARGEST_GUESS:
        raise KernelError("kernel.statics.unknowns-too-many-choose", size=system.numbering.size)
    natural = natural_frequencies(system)
    if not len(natural):
        raise KernelError("kernel.statics.system-no-natural-frequency")
    low, high = natural[0] / 20.0, 2.0 * natural[-1]
    spans = [(x[0], x[-1]) for _, _, (x, _) in system.loads if len(x) > 1]
    if spans:
        low, high = max(low, min(a for a, _ in spans)), min(high, max(b for _, b in spans))
    if not low < high:
        raise KernelError("kernel.statics.load-ends-hz-below", high=high, low=low)
    return _closer_near(natural, low, high)


def _closer_near(natural: FloatArray, low: float, high: float) -> FloatArray:
    """From low to high by 2 %, or by 8 % of the way to the nearest resonance if that is less.

    Linear interpolation of `1 / (f - f_n)` between such points errs by 0.2 %. Resonances
    themselves, where nothing may dampen, are stepped over.
    """
    found = [low]
    while found[-1] < high:
        f = found[-1]
        nearest = float(natural[np.abs(natural - f).argmin()])
        gap = 0.002 * nearest
        step = min(0.02 * f, 0.08 * max(abs(f - nearest), gap))
        if f < nearest and nearest - f - step < gap:
            step = nearest + gap - f
        found.append(f + step)
    return np.array([*found[:-1], high])


def natural_frequencies(system: _System) -> FloatArray:
    """Undamped natural frequencies in Hz, increasing, rigid motions left out."""
    free = np.eye(system.numbering.size)
    if system.rows.C.shape[0]:
        free = la.null_space(system.rows.C.toarray())
    springs = [r for r, _ in system._spring_blocks(0.0)]
    K = system.K + (
        assembly.assemble_blocks(springs, system.numbering) if springs else 0.0 * system.K
    )
    pair = [np.asarray(free.T @ np.asarray(matrix @ free)) for matrix in (K, system.M)]
    values = np.asarray(la.eig(pair[0], pair[1], right=False))
    real = np.asarray(values[np.isfinite(values)].real, float)
    if not len(real) or real.max() <= 0.0:
        return np.zeros(0)
    return np.sqrt(np.sort(real[real > 1e-8 * real.max()])) / (2.0 * np.pi)

"""Moments of a section of fibres that is bent under a normal force (MOCU)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError, KernelError
from ssilang.kernel.elements.beams.fibre_section import FibreSection
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.plastic.uniaxial import Along
from ssilang.kernel.plasticity import fibre_points

TURNS = 200
SOFT = 0.01  # of the elastic stiffness: slopes that lead too far


@dataclass(frozen=True, eq=False)
class BentSection:
    """Answer of a section to n values of its curvatures and of its normal force.

    Attributes
    ----------
    moments : array (n, 2)
        MOMY and MOMZ.
    strains : array (n,)
        EPS, the strain of the line.
    ends : list of Along
        What the fibres have at each value.
    """

    moments: FloatArray
    strains: FloatArray
    groups: tuple[fibre_points.FibreGroup, ...]
    ends: list[Along]

    def fields(self) -> tuple[list[CellField], list[CellField]]:
        """Stresses, and internal variables, on the section at each value."""
        found = []
        for end in self.ends:
            stress = np.zeros((len(end.stress), 6))
            stress[:, 0] = end.stress
            found.append(fibre_points.section_fields(self.groups, stress, end.variables))
        return [s for s, _ in found], [v for _, v in found]


def bend(
    section: FibreSection, curvatures: FloatArray, forces: FloatArray, tolerance: float
) -> BentSection:
    """Bend a section step by step from its virgin state.

    Parameters
    ----------
    curvatures : array (n, 2)
        CY and CZ at the end of each step.
    forces : array (n,)
        EFFX at the end of each step.
    tolerance : float
        Error of the normal force, relative to the sum of the fibres' forces without sign.

    Raises
    ------
    ConvergenceError
        If the section cannot carry the normal force.
    """
    groups = fibre_points.fibre_groups(section)
    f = len(section.areas)
    law = fibre_points.SectionLaw(groups, f)
    y, z = section.places.T
    end = Along(np.zeros(f), np.zeros((f, law.width)), np.zeros(f))
    eps, bent = 0.0, np.zeros(2)
    moments, strains, ends = np.zeros((len(forces), 2)), np.zeros(len(forces)), []
    for i, (wanted, force) in enumerate(zip(curvatures, forces, strict=True)):
        turn = z * (wanted[0] - bent[0]) - y * (wanted[1] - bent[1])

        def answer(step: float, turn: FloatArray = turn, start: Along = end) -> Along:
            return law.along(start.stress, step + turn, start.variables)

        led = _led(section, end, turn, float(force))
        step, end = _balanced(answer, section, float(force), tolerance, i, led)
        eps, bent = eps + step, wanted
        along = section.areas * end.stress
        moments[i], strains[i] = (along @ z, -along @ y), eps
        ends.append(end)
    return BentSection(moments, strains, groups, ends)


def _led(section: FibreSection, end: Along, turn: FloatArray, force: float) -> float:
    """Step of the strain of the line to which the last slopes lead; 0 where they are soft."""
    areas, forces = section.areas, section.areas * end.slope
    size = float(forces.sum())
    if size <= SOFT * float(areas @ section.moduli[:, 0]):
        return 0.0
    return (force - float(areas @ end.stress) - float(forces @ turn)) / size


def _balanced(
    answer: Callable[[float], Along],
    section: FibreSection,
    force: float,
    tolerance: float,
    row: int,
    step: float,
) -> tuple[float, Along]:
    """Step of the strain of the line that gives the normal force, and what fibres have then.

    By Newton inside a bracket, from a first step.
    """
    areas = section.areas
    elastic = float(areas @ section.moduli[:, 0])
    if elastic <= 0:
        raise KernelError("kernel.plasticity.fibres-no-area-no")
    low, high = -np.inf, np.inf
    for _ in range(TURNS):
        found = answer(step)
        rest = float(areas @ found.stress) - force
        size = float(areas @ np.abs(found.stress)) + abs(force)
        if abs(rest) <= max(tolerance, 1e-14) * size:
            return step, found
        low, high = (low, step) if rest > 0 else (step, high)
        tangent = float(areas @ found.slope)
        newton = step - rest / (tangent if tangent > 1e-9 * elastic else elastic)
        step = newton if low < newton < high else 0.5 * (low + high)
        if np.isfinite(high - low) and high - low <= 1e-15 * max(abs(low), abs(high), 1e-12):
            return step, answer(step)
    told = {"force": force, "row": row + 1, "rest": rest, "turns": TURNS}
    raise ConvergenceError("kernel.plasticity.section-not-find-normal", **told)

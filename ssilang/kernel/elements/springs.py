"""Impedances: springs and dashpots on a point or between two points (models IMPEDANCE).

With u the motion of the point (POI1), or that of the second point less that of the first (SEG2),
the force is, on each unknown by itself,

    ELASTIQUE   k u                         VOIGT      k u + c u'
    REUSS       u' = f'/k + f/c             COMPLEXE   [k(f) + i w c(f)] u, at frequency f

RAID k, VISC c, MASS (inertia of a point, AMOR per cent of the critical damping it then has) act
on translations, on the shares ALFA BETA of modes and static shapes, and on the unknowns that the
model names; where CPLE is given, CPLE, INER, AROT take their place on rotations. VISC of VOIGT and
REUSS is part of the law: PASAPAS has it without AMORTISSEMENT.

REUSS has matrices on a node of its own in each cell, where spring and dashpot meet: the spring
lies between the first point and that node, the dashpot between it and the second point (or the
ground). The node has no mass; its motion is that of Maxwell's internal variable.
"""

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.elements.catalog import by_cells, family_name
from ssilang.kernel.elements.families import register_family
from ssilang.kernel.elements.family import ElementFamily, Layout, StrainOperator
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import ZoneField, missing_parameter
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone

# Families of elements that give matrices and have no strains.


class StrainlessFamily(ElementFamily):
    """A family without strains and stresses; its own methods make its matrices."""

    refusal: str  # code of the error where strains are asked for

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Refused."""
        raise self.no_strains()

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Refused."""
        raise self.no_strains()

    def no_strains(self) -> FieldError:
        """The error of a request for strains."""
        return FieldError(self.refusal)


LAWS = ("ELASTIQUE", "VOIGT", "REUSS", "COMPLEXE")
"""Words that follow IMPEDANCE."""

ELEMENT = by_cells("impedance")
"""Element of an impedance by the cells that it stands on."""

_ROTATIONS = frozenset(u for names in NODE_ROTATIONS.values() for u in names)
_SHARES = {"MODAL": "ALFA", "STATIQUE": "BETA"}
_TERMS = {  # of translations, of rotations
    "RIGIDITE": ("RAID", "CPLE"), "MASSE": ("MASS", "INER"), "RATIO": ("AMOR", "AROT"),
}  # fmt: skip


def is_impedance(zone: Zone) -> bool:
    """Whether a zone is made of springs and dashpots."""
    return family_name(zone) == "impedance"


def law_of_impedance(zone: Zone) -> str:
    """Which of `LAWS` a zone has."""
    return zone.behaviour[-1] if zone.behaviour[-1] in LAWS else "ELASTIQUE"


def unknowns_of(zone: Zone) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Unknowns at the first and at the second point, those that the model names if it does."""
    named: Any = zone.options.get("UNKNOWNS", ((), ()))
    first, second = named
    if not first:
        share = next((u for w, u in _SHARES.items() if w in zone.behaviour), None)
        first = (share,) if share else (*NODE_TRANSLATIONS[zone.mode], *NODE_ROTATIONS[zone.mode])
    second = second or first
    if len(second) != len(first):
        told = {"n_first": len(first), "first": first, "n_second": len(second)}
        raise MaterialError("kernel.elements.impedance-joins-unknowns", **told)
    return tuple(first), tuple(second)


def impedance_layout(zone: Zone, parameters: ZoneField) -> Layout:
    """Rows on the unknowns: rotations only if CPLE is given or the model names them."""
    first, second = unknowns_of(zone)
    named: Any = zone.options.get("UNKNOWNS", ((), ()))
    whole = bool(named[0]) or "CPLE" in parameters
    taken = [i for i, u in enumerate(first) if whole or u not in _ROTATIONS]
    names = [first[i] for i in taken]
    local = np.zeros(len(names), dtype=np.int64)
    if zone.cells.cell_type == "SEG2":
        names += [second[i] for i in taken]
        local = np.concatenate([local, local + 1])
    return Layout(zone.cells.nodes, zone.cells.raw, local, tuple(names))


def _values(
    zone: Zone, parameters: ZoneField, term: str, required: bool = False
) -> tuple[FloatArray, FloatArray]:
    """A term on translations and on rotations, each (n_cells,)."""
    found = []
    for name in _TERMS[term]:
        if name not in parameters and required and name == "RAID":
            raise missing_parameter(zone, name, parameters.names)
        values = parameters.at(name, "RIGIDITE", 0.0)[:, 0]
        if (values < 0.0).any():
            raise MaterialError(
                "kernel.elements.impedance-not-negative", name=name, values_min=values.min()
            )
        found.append(np.broadcast_to(values, (len(zone.cells),)).astype(float))
    return found[0], found[1] if "CPLE" in parameters else found[0]


def spread(
    zone: Zone, layout: Layout, values: tuple[FloatArray, FloatArray], relative: bool = True
) -> FloatArray:
    """Element matrices (n_cells, n_rows, n_rows) of one number a cell and kind of unknown.

    `relative` terms act on the difference of the two points; others at each point, halved.
    """
    m = len(layout.unknowns)
    out = np.zeros((len(zone.cells), m, m))
    half = m // 2 if zone.cells.cell_type == "SEG2" else 0
    for i in range(half or m):
        value = values[int(layout.unknowns[i] in _ROTATIONS)]
        if half and relative:
            out[:, [i, i + half], [i, i + half]] = value[:, None]
            out[:, [i, i + half], [i + half, i]] = -value[:, None]
        elif half:
            out[:, [i, i + half], [i, i + half]] = 0.5 * value[:, None]
        else:
            out[:, i, i] = value
    return out


def dashpots(zone: Zone, parameters: ZoneField) -> FloatArray:
    """Damping matrices: VISC, and what AMOR (per cent of the critical one) makes of RAID, MASS.

    Raises
    ------
    MaterialError
        For AMOR without MASS.
    """
    viscous = parameters.at("VISC", "RIGIDITE", 0.0)[:, 0] if _is_number(parameters, "VISC") else 0
    total = []
    stiffness = _values(zone, parameters, "RIGIDITE")
    for k, m, ratio in zip(
        stiffness, _values(zone, parameters, "MASSE"), _values(zone, parameters, "RATIO"),
        strict=True,
    ):  # fmt: skip
        if (ratio > 0.0).any() and not (m > 0.0).all():
            raise MaterialError("kernel.elements.reduced-damping-amor-impedance")
        total.append(2.0 * ratio / 100.0 * np.sqrt(k * m))
    layout = impedance_layout(zone, parameters)
    turning = total[1] if "CPLE" in parameters else total[0] + viscous
    return spread(zone, layout, (total[0] + viscous, turning))


def in_series(zone: Zone, parameters: ZoneField, kind: str) -> tuple[FloatArray, Layout]:
    """Matrices of REUSS: springs ('RIGIDITE') or dashpots on the points and the inner nodes."""
    outer = impedance_layout(zone, parameters)
    m, two = len(outer.unknowns), zone.cells.cell_type == "SEG2"
    ends = m // 2 if two else m
    local = np.concatenate([outer.local, np.full(ends, 2 if two else 1)])
    names = (*outer.unknowns, *outer.unknowns[:ends])
    known: dict[str, Any] = zone.options  # inner nodes are the same for each matrix
    if "INNER" not in known:
        known["INNER"] = zone.cells.nodes.add(zone.cells.coordinates.mean(axis=1))
    raw = np.column_stack([zone.cells.raw, known["INNER"]])
    layout = Layout(zone.cells.nodes, raw, local, names)
    out = np.zeros((len(zone.cells), len(names), len(names)))
    elastic = kind == "RIGIDITE"
    viscous = parameters.at("VISC", "RIGIDITE")[:, 0]
    springs = _values(zone, parameters, "RIGIDITE", required=True) if elastic else (viscous,) * 2
    for i in range(ends):
        other = i if elastic else i + ends if two else None
        one, values = m + i, springs[int(names[i] in _ROTATIONS)]
        out[:, one, one] += values
        if other is not None:
            out[:, other, other] += values
            out[:, one, other] -= values
            out[:, other, one] -= values
    return out, layout


def dynamic_stiffness(
    zone: Zone, parameters: ZoneField, frequency: float
) -> tuple[ComplexArray, Layout] | None:
    """Complex matrices (n_cells, n_rows, n_rows) that depend on the frequency itself.

    None for a zone whose stiffness and damping are matrices: ELASTIQUE, VOIGT, and COMPLEXE with
    numbers.
    """
    law, layout = law_of_impedance(zone), impedance_layout(zone, parameters)
    pulsation = 2.0 * np.pi * frequency
    if law == "REUSS":
        c = parameters.at("VISC", "RIGIDITE")[:, 0]
        series = []
        for k in _values(zone, parameters, "RIGIDITE", required=True):
            with np.errstate(divide="ignore", invalid="ignore"):
                share = 1j * pulsation * c / (k + 1j * pulsation * c)
            series.append(np.where(k + pulsation * c > 0.0, k * share, 0.0))
        return _complex(zone, layout, *series), layout
    if law == "COMPLEXE" and (curves := _curves(parameters)):
        moving = np.zeros(len(zone.cells), complex)
        for name, parts in curves.items():
            values = [np.interp(frequency, p.abscissas, p.ordinates) for p in parts.values()]
            moving[[*parts]] += np.multiply(1.0 if name == "RAID" else 1j * pulsation, values)
        turning = moving
        if "CPLE" in parameters:
            turning = _values(zone, parameters, "RIGIDITE")[1].astype(complex)
        return _complex(zone, layout, moving, turning), layout
    return None


def _complex(
    zone: Zone, layout: Layout, moving: ComplexArray, turning: ComplexArray
) -> ComplexArray:
    """`spread` of complex numbers."""
    real = spread(zone, layout, (moving.real, turning.real))
    return real + 1j * spread(zone, layout, (moving.imag, turning.imag))


def counts_damping(zone: Zone, parameters: ZoneField) -> bool:
    """Whether a zone has damping that only a matrix (AMOR) brings into a calculation."""
    if law_of_impedance(zone) == "REUSS":  # in frequency it counts by itself
        return False
    return any(_is_number(parameters, n) for n in ("VISC", "AMOR", "AROT"))


def _is_number(parameters: ZoneField, name: str) -> bool:
    return name in parameters and parameters.raw(name)[0].dtype != object


def _curves(parameters: ZoneField) -> dict[str, dict[int, CurvePart]]:
    """Stiffness (RAID) and viscosity (VISC) of cells over the frequency, from MOCO or theirs."""
    found: dict[str, dict[int, CurvePart]] = {}
    for name in ("MOCO", "RAID", "VISC"):
        values = parameters.raw(name)[0] if name in parameters else np.zeros(1)
        if not isinstance(values.flat[0], Curve):
            continue
        cells: Any = np.broadcast_to(values, (len(parameters.zone.cells), 1)).ravel()
        first = None if name == "MOCO" else 1
        for i, part in ((i, part) for i, c in enumerate(cells) for part in c.parts[:first]):
            said = part.ordinate_name.strip().upper() if name == "MOCO" else name
            target = {"MOCO": "RAID", "RAID": "RAID", "VISC": "VISC"}.get(said)
            if target is None:
                raise MaterialError("kernel.elements.curve-moco-named", said=said)
            found.setdefault(target, {})[i] = part
    return found


class _ImpedanceFamily(StrainlessFamily):
    """Springs and dashpots: matrices, no strains."""

    refusal = "kernel.elements.impedance-no-strains"

    def layout(self, zone: Zone) -> Layout:
        """Rows without rotations: `impedance_layout` knows the parameters."""
        return impedance_layout(zone, ZoneField(zone, ()))

    def whole_matrices(
        self, zone: Zone, parameters: ZoneField, kind: str
    ) -> tuple[FloatArray, Layout]:
        """Springs or dashpots (n_cells, n_rows, n_rows)."""
        given = parameters.own()
        if law_of_impedance(zone) == "REUSS":
            return in_series(zone, given, kind)
        layout = impedance_layout(zone, given)
        if kind == "AMORTISSEMENT":
            return dashpots(zone, given), layout
        if law_of_impedance(zone) == "COMPLEXE" and _curves(given):
            raise MaterialError(
                "kernel.elements.impedance-changes-frequency-no",
                law_of_impedance=law_of_impedance(zone),
            )
        return spread(zone, layout, _values(zone, given, "RIGIDITE", required=True)), layout

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Masses at the points (half at each of two)."""
        given = parameters.own()
        layout = impedance_layout(zone, given)
        return spread(zone, layout, _values(zone, given, "MASSE"), relative=False), layout


register_family("impedance", _ImpedanceFamily())

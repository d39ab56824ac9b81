"""Names and strain-displacement tables of continuous elements, one entry a hypothesis.

Orders are Cast3M's: in-plane XX YY ZZ XY, axisymmetric RR ZZ TT RZ, Fourier RR ZZ TT RZ RT ZT,
space XX YY ZZ XY XZ YZ. Shear strains are engineering strains (GAXY = 2 EPXY).
"""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.materials.elasticity import PAIRS
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.mesh.mesh import Point

# strain row, unknown, derivative along axis 0, 1, 2 or the value over the radius, factor
Term = tuple[
    int, int, int | Literal["over_radius"], Literal["one", "harmonic", "-harmonic", "-one"]
]


@dataclass(frozen=True, slots=True)
class SolidKinematics:
    """How displacements of a continuous element make strains under one hypothesis."""

    unknowns: tuple[str, ...]  # at each node
    strains: tuple[str, ...]
    stresses: tuple[str, ...]
    gradient: tuple[str, ...]  # names of the displacement gradient's components (GRAD), row by row
    terms: tuple[Term, ...]

    @property
    def dimension(self) -> int:
        """Number of coordinates that matter."""
        return 1 + max(axis for _, _, axis, _ in self.terms if isinstance(axis, int))


_PLANE_TERMS: tuple[Term, ...] = (
    (0, 0, 0, "one"), (1, 1, 1, "one"), (3, 0, 1, "one"), (3, 1, 0, "one"),
)  # fmt: skip
_AXISYMMETRIC_TERMS: tuple[Term, ...] = (*_PLANE_TERMS, (2, 0, "over_radius", "one"))
_FOURIER_TERMS: tuple[Term, ...] = (
    *_AXISYMMETRIC_TERMS,
    (2, 2, "over_radius", "harmonic"),
    (4, 0, "over_radius", "-harmonic"),
    (4, 2, 0, "one"),
    (4, 2, "over_radius", "-one"),
    (5, 1, "over_radius", "-harmonic"),
    (5, 2, 1, "one"),
)
_SPACE_TERMS: tuple[Term, ...] = (
    (0, 0, 0, "one"), (1, 1, 1, "one"), (2, 2, 2, "one"),
    (3, 0, 1, "one"), (3, 1, 0, "one"),
    (4, 0, 2, "one"), (4, 2, 0, "one"),
    (5, 1, 2, "one"), (5, 2, 1, "one"),
)  # fmt: skip


def _entry(
    unknowns: tuple[str, ...],
    components: tuple[str, ...],
    gradient_axes: tuple[str, ...],
    terms: tuple[Term, ...],
) -> SolidKinematics:
    return SolidKinematics(
        unknowns,
        tuple(("EP" if i < 3 else "GA") + a for i, a in enumerate(components)),
        tuple("SM" + a for a in components),
        tuple(f"{u},{a}" for u in unknowns for a in gradient_axes),
        terms,
    )


_PLANE = _entry(("UX", "UY"), ("XX", "YY", "ZZ", "XY"), ("X", "Y"), _PLANE_TERMS)

SOLID_KINEMATICS: dict[Mode, SolidKinematics] = {
    Mode.PLANE_STRAIN: _PLANE,
    Mode.PLANE_STRESS: _PLANE,
    Mode.GENERALISED_PLANE_STRAIN: _PLANE,
    Mode.AXISYMMETRIC: _entry(
        ("UR", "UZ"), ("RR", "ZZ", "TT", "RZ"), ("R", "Z"), _AXISYMMETRIC_TERMS
    ),
    Mode.FOURIER: _entry(
        ("UR", "UZ", "UT"), ("RR", "ZZ", "TT", "RZ", "RT", "ZT"), ("R", "Z"), _FOURIER_TERMS
    ),
    Mode.THREE_DIMENSIONAL: _entry(
        ("UX", "UY", "UZ"), ("XX", "YY", "ZZ", "XY", "XZ", "YZ"), ("X", "Y", "Z"), _SPACE_TERMS
    ),
    Mode.UNIDIMENSIONAL: _entry(("UX",), ("XX", "YY", "ZZ"), ("X",), ((0, 0, 0, "one"),)),
}

# translations, rotations of a node with both, per hypothesis
NODE_TRANSLATIONS: dict[Mode, tuple[str, ...]] = {
    mode: k.unknowns for mode, k in SOLID_KINEMATICS.items()
}
NODE_ROTATIONS: dict[Mode, tuple[str, ...]] = {
    Mode.PLANE_STRAIN: ("RZ",),
    Mode.PLANE_STRESS: ("RZ",),
    Mode.GENERALISED_PLANE_STRAIN: ("RZ",),
    Mode.AXISYMMETRIC: ("RT",),
    Mode.FOURIER: ("RT",),
    Mode.THREE_DIMENSIONAL: ("RX", "RY", "RZ"),
    Mode.UNIDIMENSIONAL: (),
}


SECTION_UNKNOWNS = ("UZ", "RX", "RY")
"""What the point of a section in generalised plane strain has besides."""


def as_tensor(values: FloatArray, strains: bool) -> FloatArray:
    """Tensors (n, p, 3, 3) from components (n, 4 or 6, p); shear strains are halved."""
    n, m, p = values.shape
    T = np.zeros((n, p, 3, 3))
    for row, (i, j) in enumerate(PAIRS[:m]):
        factor = 0.5 if strains and i != j else 1.0
        T[..., i, j] = T[..., j, i] = factor * values[:, row]
    return T


def as_components(T: FloatArray, n_components: int, strains: bool) -> FloatArray:
    """Components (n, n_components, p) of tensors (n, p, 3, 3)."""
    rows = [T[..., i, j] * (2.0 if strains and i != j else 1.0) for i, j in PAIRS[:n_components]]
    return np.stack(rows, axis=1)


def cross_matrix(w: FloatArray) -> FloatArray:
    """W (..., 3, 3) with W u = w x u, w (..., 3)."""
    return np.cross(np.eye(3), w[..., None, :])


def on_diagonal(frames: NDArray[Any], count: int) -> NDArray[Any]:
    """Matrices (n, 3 count, 3 count) that have those (n, 3, 3) so often on their diagonal."""
    return np.kron(np.eye(count)[None], frames)


def harmonic(zone: Zone) -> int:
    """Fourier harmonic of a zone (0 where the model did not say)."""
    value = zone.options.get("harmonic", 0)
    return value if isinstance(value, int) else 0


def section_point(zone: Zone) -> Point:
    """Node that carries the section's own motion in generalised plane strain (DPGE).

    Raises
    ------
    MeshError
        If the model was made without it.
    """
    point = zone.options.get("DPGE")
    if not isinstance(point, Point):
        raise MeshError("kernel.elements.generalised-plane-strain-needs")
    return point


def term_factor(word: str, n: int) -> float:
    """Value of a term's factor for harmonic n."""
    return {"one": 1.0, "-one": -1.0, "harmonic": float(n), "-harmonic": -float(n)}[word]

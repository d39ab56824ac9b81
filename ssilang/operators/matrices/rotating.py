"""KENT GYRO: matrices of turning bodies."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.rotating import cross_matrix, gyroscopic, inertia_coupling
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.operators.matrices.element import joined, present

_SHAFT = (
    "OPTI DIME 3 MODE TRID ELEM SEG2 ; L = DROI 2 (0 0 0) (0 0 1) ; M = MODE L MECANIQUE TIMO ; "
    "A = MATE M 'YOUN' 1. 'NU' 0.3 'RHO' 2. 'SECT' 1. 'INRY' 1. 'INRZ' 1. 'TORS' 2. {} ; "
)


def _fields(call: Call) -> CellField:
    return joined((call.required("MCHAML"), *call.all("MCHAML")))


@operator(
    "KENT",
    family="matrix",
    help=Help(
        en="Stiffness of a body in a turning frame, to be added to that of its elements: "
        "'CENTRIFUGE' for the rotation vector w (rho w x (w x u), negative across the axis), "
        "'EULER' for the rate of the vector (rho dw/dt x u, antisymmetric). Continuous elements, "
        "bars, beams and pipes (whose mass stands on their line).",
        fr="Raideur d'un corps dans un repère tournant, à ajouter à celle de ses éléments : "
        "'CENTRIFUGE' pour le vecteur rotation w (rho w x (w x u), négative en travers de l'axe), "
        "'EULER' pour la dérivée du vecteur (rho dw/dt x u, antisymétrique). Massifs, barres, "
        "poutres et tuyaux (dont la masse est sur la ligne).",
        syntax="RIG1 = KENT 'CENTRIFUGE' | 'EULER' MODL1 MAT1 VEC1 ;",
        examples=(_SHAFT.format("") + "LIST (EXTR (KENT 'CENTRIFUGE' M A (0 0 3)) 'DIAG') ;",),
    ),
    reads_itself=True,
)
def kent(call: Call) -> Matrix:
    """Turning frame."""
    word = call.keyword(("CENT", "EULE"))
    if word is None:
        raise call.bad("which stiffness?", hint="'CENTRIFUGE' or 'EULER'")
    model = present(call, call.required("MMODEL"))
    material = _fields(call)
    vector = np.zeros(3)
    given = call.required("POINT").coordinates
    if len(given) == 2:
        raise call.bad("a rotation vector has three components", hint="OPTI DIME 3 ;")
    vector[:] = given
    W = cross_matrix(vector)
    coupling = W @ W if word == "CENT" else W
    blocks = tuple(inertia_coupling(z, material, coupling) for z in model.zones)
    return Matrix(model.mesh.nodes, blocks, (), "RIGIDITE")


@operator(
    "GYRO",
    family="matrix",
    full_name="GYROSCOPIQUE",
    help=Help(
        en="Gyroscopic coupling of beams that turn about their own axis at the speed OMEG (rad/s, "
        "a parameter), in a fixed frame: an antisymmetric matrix on the velocities, counted as a "
        "damping.",
        fr="Couplage gyroscopique de poutres qui tournent autour de leur axe à la vitesse OMEG "
        "(rad/s, une caractéristique), en repère fixe : une matrice antisymétrique sur les "
        "vitesses, comptée comme un amortissement.",
        syntax="RIG1 = GYRO MODL1 MAT1 ;",
        examples=(_SHAFT.format("'OMEG' 3.") + "LIST (TYPE (GYRO M A)) ;",),
    ),
    reads_itself=True,
)
def gyro(call: Call) -> Matrix:
    """Turning beams."""
    model = present(call, call.required("MMODEL"))
    material = _fields(call)
    blocks = tuple(gyroscopic(z, material) for z in model.zones)
    return Matrix(model.mesh.nodes, blocks, (), "AMORTISSEMENT")

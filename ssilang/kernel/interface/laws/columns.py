"""Numbers of the laws, of their parameters and of their internal variables, each given once.

Compiled code takes members of these enumerations for plain numbers.
"""

from enum import IntEnum


class LawCode(IntEnum):
    """Number that compiled code knows a law by."""

    ELASTIC = 0
    SDM = 1
    MOHR = 2
    STRIP = 3  # macro-elements: a whole footing at one point
    DISC = 4
    SPRINGS = 5
    BED = 6  # a place under a macro-element whose ground yields
    LEAD = 7  # bearings of isolated structures
    PENDULUM = 8


class Parameter(IntEnum):
    """Columns of the parameter table of joint points (all laws read the same table)."""

    KN = 0  # normal stiffness, Pa/m (N/m for a joint of two points)
    KS1 = 1  # shear stiffness along t1
    KS2 = 2  # shear stiffness along t2 (unused in 2D)
    FU = 3  # tensile strength, Pa
    GF = 4  # energy spent to open fully, N/m
    FC = 5  # closing traction, Pa, <= 0
    FROT = 6  # Coulomb coefficient, < 0: no bound on the shear of a closed point
    SHEAR = 7  # 0 lost when open, 1 literally elastic at any opening
    TPHI = 8  # tangent of the friction angle
    TPSI = 9  # tangent of the dilatancy angle
    COHE = 10  # cohesion
    FTRC = 11  # tensile strength of a Mohr-Coulomb joint
    EF = 12  # normal stiffness beyond the closing ECN
    ECN = 13
    FNE = 14  # compression from which a joint of two points yields, 0: never
    QT = 15  # its tangent stiffness then
    LARG = 16  # width of a footing (macro-elements), along t1 in 3D
    LONG = 17  # its other width
    RAYO = 18  # its radius; of a pendulum's bowl
    SYMMETRIC = 19  # 1: tangent of friction without its unsymmetric part
    QULT = 20  # pressure that the ground bears under a footing, Pa
    BED_KN = 21  # elastic stiffness of the bed at a place under a footing, Pa/m
    BED_KS = 22  # its shear stiffness
    QD = 23  # force of a lead core at no displacement
    KPOS = 24  # shear stiffness once it yields
    ETA = 25  # how sharply it does
    BETA = 26  # share of the hysteresis that unloads as it loads
    PDUR = 27  # share of the ground's strength in hard spots under a footing


class Variable(IntEnum):
    """Columns of the state of a point, its internal variables."""

    XI = 0  # largest irreversible opening; plastic normal jump of a Mohr-Coulomb joint or a bed
    SLIP1 = 1  # along t1
    SLIP2 = 2  # along t2
    DAMAGE = 3  # share of the shear stiffness lost; plastic compression of a Mohr-Coulomb joint
    SHEAR_ENERGY = 4  # stored
    PULLED = 4  # openings of a Mohr-Coulomb joint, added up
    SHEAR_LOSS = 5  # energy lost in shear so far
    HELD = 6  # in a step's iteration: CLOSED_SHEAR, OPEN_SHEAR, or 0: as the law says
    STATUS = 7  # of a Mohr-Coulomb joint: untouched (0), IS_OPEN or IN_CONTACT
    OPENING = 8  # of an open Mohr-Coulomb joint
    CUMULATED = 9  # length of its plastic jump
    HYSTERETIC1 = 8  # of a lead core, along t1: shares of its force
    HYSTERETIC2 = 9


N_PARAMETERS = len(Parameter)
N_STATE = len(Variable)

CLOSED_SHEAR, OPEN_SHEAR = 1.0, 2.0  # HELD: transmitted or not, whatever the normal traction
IS_OPEN, IN_CONTACT = 1.0, 2.0  # STATUS

"""What cannot be calculated or meshed is refused by its own code, at the limit of what can."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.loads.thermal import refuse_expanding
from ssilang.kernel.elements.results.supports import nodal_of_field, values_at_points
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.isovalue import isovalue
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.interface.laws.columns import N_PARAMETERS
from ssilang.kernel.interface.laws.law import columns_of
from ssilang.kernel.interface.laws.mohr_law import check_mohr_parameters
from ssilang.kernel.materials import behaviours
from ssilang.kernel.materials.elasticity import check_isotropic
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.materials.plastic import creep, laws
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.matrices import assembly, build, relations, superelement, tied_relations
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.changes.degree import quadratic
from ssilang.kernel.mesh.changes.merge import cut_open
from ssilang.kernel.mesh.combine import polygons
from ssilang.kernel.mesh.families import FAMILIES, family_of
from ssilang.kernel.mesh.generators import sweep
from ssilang.kernel.mesh.generators.interfaces import joint_mesh
from ssilang.kernel.mesh.lines.lines import line_chain, shortest_line
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.queries.measure import enclosed_volume, node_sizes
from ssilang.kernel.mesh.surfaces import charts, surface
from ssilang.kernel.modal import explicit, links, oscillator
from ssilang.kernel.modal.modes import complex_modes, modes_near
from ssilang.kernel.records import filters, floors, inelastic, matching, modulated, power, signals
from ssilang.kernel.records.soil_column import SoilColumn, free_field
from ssilang.kernel.solvers.active_set.contact_methods import augmented, penalty, uzawa
from ssilang.kernel.waves import layered_half_space as waves
from ssilang.kernel.waves.incoherence import Ground as Unlike
from ssilang.kernel.waves.incoherence import RigidBase
from tests.kernel.elements.samples import ELASTIC, material

PLANE, ROUND, SPATIAL = Mode.PLANE_STRESS, Mode.AXISYMMETRIC, Mode.THREE_DIMENSIONAL
ONE, TWO = np.ones(1), np.array([1.0, 2.0])
TABLE = NodeTable()
TABLE.add(np.array([[x, y, z] for z in (0, 1) for y in (0, 1, 2) for x in (0, 1, 2)], float))
MANY = NodeTable()
MANY.add(np.zeros((6001, 3)))
LINE, SURE = (Mesh.of(TABLE, "SEG2", np.array(c)) for c in ([[0, 1], [1, 2]], [[3, 4], [4, 5]]))
STAR = Mesh.of(TABLE, "SEG2", np.array([[1, 4], [3, 4], [4, 5]]))
QUADS = Mesh.of(TABLE, "QUA4", np.array([[0, 1, 4, 3], [1, 2, 5, 4]]))
FIVE = Mesh.of(TABLE, "POL5", np.array([[0, 1, 5, 7, 3]]))
POINTS = Mesh.of(TABLE, "POI1", np.array([[0], [4]]))
JOINT = Zone(CellBlock.make(TABLE, "RAC2", np.array([[0, 1, 3, 4]])), "MECANIQUE", ELASTIC, "JOI2",
             PLANE)  # fmt: skip
SOIL = SoilColumn(TWO, TWO, TWO, TWO * 0.1, 1.0, 2.0)
FLOOR = floors.Storey(TWO, TWO * 0.1, TWO)
SPACE = waves.HalfSpace(ONE, TWO, TWO, 2.0 * TWO, TWO * 0.1)
WAVE = waves.PlaneWave("SH", 0.0, "INCIDENTE", 0.0, 0.1, np.arange(3.0))
SIGNAL = modulated.ModulatedSignal(TWO, TWO, TWO, (TWO,), (TWO,))
FLAT = (TWO, TWO)
PLAN = explicit.ModalSteps(0.1, 4)
MODE = SimpleNamespace(M=np.eye(2), C=np.eye(2), K=np.eye(2), links=None)
RING = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
SIDES = np.stack([RING, np.roll(RING, -1, axis=0)], axis=1)
AXIS = np.array([[0.0, 0, 0], [0, 0, 1]])
TIMES = np.linspace(0.0, 1.0, 11)
LAW = {"law": np.array([[0.0, 0.0], [1.0, 2.0], [2.0, 3.0]]), "numbers": {links.PLASTIC: 1.0}}


def by(function, **usual):
    """Calls of a function, later, with what is usual but for what is given."""
    return lambda **given: lambda: function(**usual | given)


contact = by(
    lambda **link: links._check(2, SimpleNamespace(kind=min(links.CONTACTS), **link)), **LAW
)
psrs = by(power.response_spectrum, f=TWO, density=TWO, duration=1.0, periods=ONE, damping=0.1,
          kind="ACCE", law="CRAM")  # fmt: skip
modulation = by(
    lambda periods, damping, **numbers: modulated.modulated_response_spectrum(
        SIGNAL, periods, damping, "ACCE", SimpleNamespace(**numbers)
    ), periods=ONE, damping=0.1, processes=1, instants=1, precision=0.1,
)  # fmt: skip
floor = by(
    floors.floor_spectrum, storey=FLOOR, power=FLAT, envelope=FLAT, frequencies=ONE, damping=0.1
)
yielding = by(inelastic.yielding_peaks, times=TIMES, signal=TIMES, frequencies=ONE, damping=0.1,
              law="CINE", hardening=0.1, limits=ONE)  # fmt: skip
match = by(matching.matched, times=TIMES, values=TIMES, frequencies=ONE, target=ONE, damping=0.1,
           tolerance=0.1)  # fmt: skip
column = by(free_field, soil=SOIL, step=0.1, acceleration=TWO, depths=ONE, cutoff=5.0)


def masses(*values, table=TABLE):
    """A matrix of these terms at the first points, for UX."""
    nodes = np.arange(len(values))
    return build.nodal_diagonal(table, nodes, {"UX": np.array(values, float)}, "RIGIDITE")


def askew(*nodes):
    """An unsymmetric matrix between UX of two points."""
    block = replace(masses(1.0).blocks[0], raw_nodes=np.array([nodes]), local=np.arange(2),
                    unknowns=("UX", "UX"), duals=("FX", "FX"), symmetric=False,
                    values=np.array([[[2.0, 1.0], [0.0, 2.0]]]))  # fmt: skip
    return Matrix(TABLE, (block,))


def held(matrix, *nodes, dual=None):
    """The same with conditions on UX of points."""
    rows = relations.blocked(TABLE, np.array(nodes), ("UX",))
    return replace(matrix, relations=(replace(rows, dual=rows if dual else None),), cache={})


def vibrating(K, M):
    return lambda: modes_near(K, M, [(0.0, 1)])


def law(*rows):
    return contact(law=np.array(rows))


def plane(step=None, **given):
    return lambda: waves.plane_motion(SPACE, replace(WAVE, **given), ONE, ONE, step)


def cut(line):
    return lambda: cut_open(QUADS, line)


def modes(M=MODE.M, **given):
    problem = SimpleNamespace(**{**vars(MODE), "M": M})
    return lambda: explicit.integrate_modes(problem, None, replace(PLAN, **given))


def changed(value, **given):
    return lambda: replace(value, **given)


def zone(element, mode, *x):
    """One cell on points (n, d)."""
    table = NodeTable()
    nodes = table.add(np.array(x, float))[None]
    cells = CellBlock.make(table, ELEMENTS[element].cell_type, nodes)
    return Zone(cells, "MECANIQUE", ELASTIC, element, mode)


def stiff(element, mode, *x, **given):
    """The stiffness of such a cell, of ordinary material."""
    given = {"YOUN": 1.0, "NU": 0.2, "SECT": 1.0, "EPAI": 0.1, "INRY": 1.0, "INRZ": 1.0,
             "TORS": 1.0} | given  # fmt: skip
    at = zone(element, mode, *x)
    return lambda: families.stiffness(at, material(at, **given))


def words(family, *given):
    return lambda: behaviours.normalised(list(given), family)


def checked(law, **given):
    curves = {n: ([v], np.zeros(1, int)) for n, v in given.items() if isinstance(v, Curve)}
    arrays = {n: np.array([v, v]) for n, v in given.items() if n not in curves}
    for values in arrays.values():
        values[0] = 0.4  # admissible
    return lambda: PLASTIC_LAWS[law].check(PointParameters(arrays, curves))


def joint(check, value):
    parameters = np.full((2, N_PARAMETERS), 0.1)
    parameters[1, 0] = value
    return lambda: check(parameters)


REFUSED = {
    "solvers": {
        "penalty-needs-coefficient": [lambda: penalty(np.eye(2), TWO, None, None),
                                      lambda: penalty(np.eye(2), TWO, 0.0, None)],
        "augmentation-must": [lambda: augmented(np.eye(2), TWO, 0.0, None)],
        "uzawa-coefficient-not-converge": [lambda: uzawa(np.eye(2), TWO, 0.0, None),
                                           lambda: uzawa(np.eye(2), TWO, 2.0, None)],
    },
    "elements": {
        "joints-expand-in-time": [
            lambda n=n, s=s: refuse_expanding([JOINT], material(JOINT, ALPN=n, ALPS=s, ALQN=0.0))
            for n, s in ((1e-5, 0.0), (0.0, 1e-5))
        ],
        "field-empty": [lambda f=f: f(CellField(())) for f in (values_at_points, nodal_of_field)],
        "beam-cell-zero-length": [
            stiff("POUT", SPATIAL, [1, 0, 0], [1, 0, 0]), stiff("TIMO", PLANE, [1, 2], [1, 2])
        ],
        "vect-along-beam-must": [stiff("POUT", SPATIAL, [0, 0, 0], [1, 2, 0], VX=-2.0, VY=-4.0)],
        "line-cell-zero-length": [stiff("BARR", PLANE, [1, 2], [1, 2])],
        "shell-cell-zero-length": [stiff("COQ2", ROUND, [1, 2], [1, 2])],
        "shells-off-mesh-exce": [stiff("COQ2", ROUND, [1, 2], [2, 3], EXCE=0.1)],
        "flat-shell-no-area": [
            stiff("COQ4", SPATIAL, *RING[[0, 2, 0, 2]]),
            stiff("DKT", SPATIAL, [0, 0, 0], [1, 1, 1], [3, 3, 3]),
        ],
        "middle-surface-shell-folds": [stiff("COQ6", SPATIAL, *RING[[0, 0, 0, 0, 0, 0]])],
        "cell-axisymmetric-model-reaches": [
            stiff("QUA4", ROUND, [-1, 0], [1, 0], [1, 1], [-1, 1]),
            stiff("TRI3", ROUND, [-1, 0], [0.5, 0], [0.5, 1]),
        ],
        "hoop-on-axis": [stiff("CERC", ROUND, [0, 2])],
        "generalised-plane-strain-needs": [
            stiff("TRI3", Mode.GENERALISED_PLANE_STRAIN, [0, 0], [1, 0], [0, 1])
        ],
    },
    "materials": {
        "elements-family-no-elasticity": [words("bar", "ORTHOTROPE")],
        "behaviour-joints-only": [words("solid", "JOINT_DILATANT")],
        "plastic-law-bodies-not": [words("joint", "PLASTIQUE", "PARFAIT")],
        "elements-family-no-law": [words("solid", "IMPEDANCE")],
        "impedance-no-law": [
            words("impedance", "IMPEDANCE", "VOIGT", "REUSS"),
            words("impedance", "IMPEDANCE", "SOL"),
            words("impedance", "IMPEDANCE", "MODAL", "STATIQUE"),
        ],
        "family-without-law": [words("joint", "FLUAGE", "NORTON")],
        "which-law": [words("solid", "FLUAGE"), words("solid", "FLUAGE", "NORTON", "NORTON")],
        "law-of-isotropic-bodies": [words("solid", "ORTHOTROPE", "FLUAGE", "NORTON")],
        "beam-fibres-elastique-section": [words("fibre", "PLASTIQUE", "SECTION")],
        "elements-family-no-plastic": [
            words("solid", "PLASTIQUE", "BETON_BAEL"), words("fibre", "PLASTIQUE", "CAM_CLAY")
        ],
        "elements-family-no-plastic-law": [words("impedance", "PLASTIQUE", "PARFAIT")],
        "sections-no-plastic": [words("beam", "PLASTIQUE", "CAM_CLAY")],
        "plastic-laws-go-elasticity": [words("solid", "ORTHOTROPE", "PLASTIQUE", "PARFAIT")],
        "drucker-prager-needs-beta": [
            checked("DRUCKER_PRAGER", **dict.fromkeys(("ALFA", "BETA", "ETA", "MU", "DELT"), 0.4)
                    | {wrong: value})
            for wrong, value in (("BETA", 0.0), ("MU", 0.0), ("DELT", -1e-9))
        ],
        "rh-coulomb-needs-cohesion": [checked("RH_COULOMB", COHE=0.0, PHI=0.4)],
        "rh-coulomb-phi": [checked("RH_COULOMB", COHE=1.0, PHI=x) for x in (0.0, np.pi / 2)],
        "fc-concrete-needs-strength": [checked("BETON_BAEL", FC=0.0)],
        "young-modulus-youn-not": [lambda: check_isotropic(np.array([1.0, np.inf]), TWO / 5)],
        "drucker-parfait-ltr-lcs": [
            checked("DRUCKER_PARFAIT", LTR=x, LCS=y) for x, y in ((0.0, 1.0), (0.5, -0.49))
        ],
        "ultimate-cone-drucker-prager": [
            checked("DRUCKER_PRAGER", ALFA=0.4, BETA=0.4, ETA=x, MU=0.4, DELT=0.4)
            for x in (0.39, 0.41)
        ],
        "norton": [
            lambda wrong=wrong: creep.check(PointParameters({
                n: np.array([0.5 + k, v])
                for k, (n, v) in enumerate(({"AF1": 0.0, "AF2": 1.0, "AF3": 1.0} | wrong).items())
            }, {}))
            for wrong in ({"AF1": -1e-9}, {"AF2": 0.99}, {"AF3": 0.0}, {"AF3": 1.01})
        ],
        "no-plastic-law-bodies": [lambda: laws.plastic_law(("ELASTIQUE", "PLASTIQUE", "PERFECT"))],
        "must": [
            lambda: laws.check_parameters(
                PLASTIC_LAWS["PARFAIT"], PointParameters({"SIGY": TWO - 1.0}, {})
            )
        ],
        "curve-strengths-not": [checked("ISOTROPE", ECRO=Curve((CurvePart(TWO, TWO - 1.0),)))],
    },
    "plasticity": {
        "parameter-curve": [lambda: laws.different_curves("ECRO", np.array([1.0], object))],
    },
    "fields": {
        "no-value-looked-cells": [
            lambda: isovalue(CellField((CellFieldBlock(FIVE.blocks[0], {"T": ONE[None]}),)), 0.5)
        ],
    },
    "matrices": {
        "numbering-needs-least-matrix": [assembly.numbering_of],
        "relation-unknowns-numbering-lacks": [
            lambda: assembly.constraint_matrix(
                held(masses(1.0), 1), assembly.numbering_of(masses(1.0))
            )
        ],
        "full-matrix-rows-too": [
            lambda: build.sum_of_outer_products(
                [NodeField(TABLE, {"UX": NodeValues(np.arange(20_001), np.zeros(20_001))})],
                [1.0], "RIGIDITE",
            )
        ],
        "segment-cable-no-length": [
            lambda: build.cable_stiffness(
                Mesh.of(TABLE, "SEG2", np.array([[0, 1], [2, 2]])), 3, 1.0, 1.0
            )
        ],
        "weights-around-node-zero": [
            lambda r=r: build.filter_weights(
                NodeField(TABLE, {"T": NodeValues(np.arange(3), np.array([0.0, 0.0, 1.0]))}),
                r, 1.0, 0.0, "T", "Q",
            )
            for r in (0.0, 1.0)
        ],
        "factor-not-finite": [
            lambda x=x: relations.relation_rows(
                TABLE, [relations.Term(np.array([1.0, x]), "UX", np.array([0, 1]))]
            )
            for x in (np.nan, -np.inf)
        ],
        "antisymmetry-leaves-rotations-plane": [
            lambda: relations.mirror_rows(TABLE, np.array([0]), AXIS[1], (), ("RZ",), False)
        ],
        "sliding-relation-wants-line": [lambda: tied_relations.sliding(QUADS, QUADS, ("UX", "UY"))],
        "master-unknowns-make-too": [
            lambda: superelement.condense(many := masses(*np.ones(6001), table=MANY), many)
        ],
    },
    "interface": {
        "joint-parameter-not-finite": [joint(columns_of, np.nan), joint(columns_of, np.inf)],
        "joint-parameter-not-finite-or-steep": [
            joint(check_mohr_parameters, x) for x in (np.nan, np.inf)
        ],
    },
    "records": {
        "frequencies-values-function": [
            lambda: signals.inverse_laplace(TWO - 1.0, ONE, 1.0, 1),
            lambda: signals.inverse_laplace(ONE - 1.0, ONE, 1.0, 1),
        ],
        "frequencies-begin-constant-step": [lambda: signals.inverse_laplace(TWO, TWO, 1.0, 1)],
        "frequencies-not-split-groups": [
            *(lambda n=n: signals.inverse_laplace(TWO - 1.0, TWO, 1.0, n) for n in (0, 3)),
        ],
        "soil-needs-many-thicknesses": [changed(SOIL, density=ONE), changed(SOIL, damping=ONE)],
        "thickness-density-modulus-layer": [
            *(changed(SOIL, **{n: TWO - 1.0}) for n in ("thickness", "density", "modulus")),
            changed(SOIL, damping=np.array([0.0, -1e-9])),
        ],
        "frequencies-rayleigh-damping-must": [changed(SOIL, f1=0.0), changed(SOIL, f2=0.0)],
        "acceleration-needs-two-points": [
            column(step=0.0), column(cutoff=0.0), column(acceleration=ONE)
        ],
        "depth-outside-layers-end": [column(depths=-ONE), column(depths=3.1 * ONE)],
        "mode-frequency-damping-participation": [changed(FLOOR, participations=ONE)],
        "frequencies-modes-positive": [changed(FLOOR, frequencies=np.array([1.0, 0.0]))],
        "damping-between-not": [
            *(changed(FLOOR, dampings=np.array([0.1, x])) for x in (0.0, 1.0)),
            *(f(damping=x) for f in (floor, psrs, modulation) for x in (0.0, 1.0)),
            match(damping=1.0),
        ],
        "frequencies-spectrum-duration-positive": [
            floor(frequencies=0.0 * ONE), floor(envelope=(np.array([2.0, 2.0]), TWO))
        ],
        "power-spectrum-positive-over": [
            floor(power=(TWO, 0.0 * TWO)), psrs(f=TWO[::-1]), psrs(density=0.0 * TWO),
            psrs(density=TWO - 1.5), changed(SIGNAL, density=TWO - 1.5),
            changed(SIGNAL, density=0.0 * TWO), changed(SIGNAL, frequencies=TWO[[0, 0]]),
        ],
        "duration-periods-must-positive": [
            psrs(duration=0.0), psrs(periods=0.0 * ONE), modulation(periods=0.0 * ONE)
        ],
        "least-process-instant-needed": [
            modulation(processes=0), modulation(instants=0), modulation(precision=0.0)
        ],
        "power-spectrum-not-negative": [lambda: modulated.sines(TWO, TWO - 1.2, 10)],
        "elastic-limit-oscillator-must": [yielding(limits=0.0 * ONE)],
        "signal-times-must-go": [yielding(times=ONE), yielding(times=TIMES**1.001)],
        "frequency-oscillator-must-positive": [yielding(frequencies=0.0 * ONE)],
        "damping-oscillator-cannot-negative": [yielding(damping=-1e-9)],
        "hardening-ratio-lies-left": [yielding(hardening=1.0)],
        "target-not-positive": [match(target=0.0 * ONE)],
        "target-too-fast": [match(frequencies=5.1 * ONE)],
        "record-zero": [match(values=0.0 * TIMES)],
        "ductility-least": [
            lambda: inelastic.limits_for_ductility(TIMES, TIMES, ONE, 0.0, "CINE", 0.0, 0.99, ONE)
        ],
        "modulations-need-increasing-limits": [
            changed(SIGNAL, bands=np.arange(3.0)), changed(SIGNAL, bands=TWO[::-1])
        ],
        "modulations-not-go-instant": [
            changed(SIGNAL, bands=np.arange(3.0), times=(TWO, TWO + 1.0), modulations=(TWO, TWO))
        ],
        "baseline-points": [lambda: filters.without_trend(TIMES[:7], 0.1, 6)],
    },
    "waves": {
        "layers-differ": [changed(SPACE, shear=ONE), changed(SPACE, damping=ONE)],
        "last-layer-endless": [changed(SPACE, thickness=TWO)],
        "layer-not-positive": [
            changed(SPACE, thickness=0.0 * ONE), changed(SPACE, damping=TWO - 1.5),
            *(changed(SPACE, **{n: TWO - 1.0}) for n in ("density", "shear", "primary")),
        ],
        "frequencies-not-positive": [changed(SPACE, f1=0.0), changed(SPACE, f2=0.0)],
        "record-too-short": [plane(acceleration=ONE), plane(**{"step": 0.1}, acceleration=ONE)],
        "above-the-surface": [
            lambda: waves.transfers(SPACE, "P", 0.0, np.ones(1), np.array([-1.0]))
        ],
        "base-without-size": [
            lambda: RigidBase("disc", 0.0), lambda: RigidBase("rectangle", 2.0)
        ],
        "speed-not-positive": [lambda: Unlike(0.0), lambda: Unlike(200.0, 0.1, 0.0)],
        "gamma-negative": [lambda: Unlike(200.0, -0.1)],
        "step-not-positive": [plane(0.0)],
        "surface-at-rest": [  # a shear wave at 45 degrees shakes it upright alone
            lambda: waves.plane_motion(
                replace(SPACE, shear=ONE[[0, 0]], primary=2.0 * ONE[[0, 0]], damping=0.0 * TWO),
                replace(WAVE, kind="SV", angle=np.pi / 4, given="SURFACE"), ONE, ONE, None,
            )
        ],
        "angle-not-upwards": [plane(angle=np.pi / 2)],
    },
    "modal": {
        "modes-non-associated-relations": [
            vibrating(held(masses(1.0, 2.0), 0, dual=True), masses(1.0, 2.0))
        ],
        "matrices-not-symmetric-modes": [
            vibrating(askew(0, 1), masses(1.0, 2.0)), vibrating(masses(1.0, 2.0), askew(0, 1))
        ],
        "conditions-hold-every-unknown": [
            vibrating(held(masses(1.0, 2.0), 0, 1), masses(1.0, 2.0)),
            lambda: complex_modes(held(masses(1.0, 2.0), 0, 1), masses(1.0, 2.0), None, 0.0, 1),
        ],
        "mass-matrix-negative-eigenvalues": [vibrating(masses(1.0, -1.0), masses(1.0, -3.0))],
        "step-numbers-steps-must": [modes(h=0.0), modes(count=0), modes(every=0)],
        "mass-modes-singular": [modes(M=np.ones((2, 2))), modes(M=np.diag([1.0, np.inf]))],
        "link-no-positive-stiffness": [contact(law=None, numbers={links.STIFF: 0.0})],
        "law-link-wants-two": [law([0.0, 0.0]), law([0.0, 0.0], [0.0, 1.0])],
        "law-link-not-elastic": [
            law([0, 0], [1, 0], [2, 0]), law([0, 0], [1, 1], [2, 2]), law([0, 1], [1, 2], [2, 1.9])
        ],
        "damping-oscillator-cannot-negative": [lambda: oscillator.Oscillators(ONE, -1e-9)],
        "frequency-oscillator-must-positive": [lambda: oscillator.Oscillators(0.0 * ONE, 0.1)],
        "signal-times-must-increase": [
            lambda: oscillator.response(0.0 * TWO, TWO, 1.0, 0.1),
        ],
        "default-list-frequencies-too": [
            lambda: oscillator.default_frequencies(np.linspace(0.0, 1.0, 40_100), 0.0)
        ],
    },
    "mesh": {
        "cells-type-no-quadratic": [lambda: quadratic(FIVE)],
        "mesh-sizes-ask-elements": [lambda: subdivide(1.1, 1e-7, 1e-7)],
        "line-seg2-seg3-needed": [cut(QUADS)],
        "line-branches-node": [cut(STAR)],
        "line-not-separate-cells": [cut(LINE)],
        "no-polygons-five-sides": [lambda: polygons(QUADS)],
        "no-surface-made-elements": [FAMILIES["SEG2"].need_surface],
        "no-mesh-made-elements": [lambda: family_of("QUA5")],
        "facing-cells-paired-within": [lambda: joint_mesh(LINE, SURE, 0.0)],
        "line-needed-sweep-surface": [
            lambda: sweep.sweep_line(
                QUADS, sweep.translation(AXIS[1]), subdivide(1.0, count=2), "QUA4"
            )
        ],
        "no-volume-swept-cells": [
            lambda: sweep.sweep_surface(
                FIVE, sweep.translation(AXIS[1]), subdivide(1.0, count=2)
            )
        ],
        "line-of-segments-needed": [
            lambda: line_chain(QUADS), lambda: line_chain(Mesh(TABLE, ())),
            lambda: shortest_line(QUADS, 0, 5),
        ],
        "volume-inside-surface-asked": [lambda: enclosed_volume(LINE)],
        "mesh-sizes-measured-edges": [lambda: node_sizes(POINTS)],
        "contour-encloses-no-area": [
            lambda: charts.plane_chart(RING[[0, 2]], np.stack([RING[[0, 2]], RING[[2, 0]]], axis=1))
        ],
        "contour-not-plane-point": [
            lambda: charts.plane_chart(RING + 0.2 * AXIS[1] * RING[:, :1] ** 2, SIDES)
        ],
        "contour-goes-through-axis": [
            lambda: charts.cylinder_chart(RING + RING[0], AXIS[0], AXIS[1])
        ],
        "contour-goes-round-axis": [lambda: charts.cylinder_chart(RING, AXIS[0], AXIS[1])],
        "contour-both-sides-apex": [
            lambda: charts.cone_chart(RING + 3.0 * RING[0], AXIS[0], AXIS[1]),
            lambda: charts.cone_chart(RING[:, [2, 1, 0]] + 3.0 * RING[0], AXIS[0], AXIS[1]),
        ],
        "contour-goes-right-round": [lambda: charts.sphere_chart(RING, AXIS[0])],
        "lines-contour-not-run": [
            lambda: surface.contour_cells(
                Mesh.of(TABLE, "SEG2", np.array([[0, 1], [1, 3], [0, 3], [1, 2], [2, 5], [5, 1]]))
            )
        ],
    },
}  # fmt: skip
CASES = [
    (room, code, k) for room, codes in REFUSED.items() for code, ways in codes.items()
    for k in range(len(ways))
]  # fmt: skip


@together("room, code, way", CASES)
def test_what_cannot_be_is_refused_by_its_code(room, code, way):
    with refusal(KernelError, f"kernel.{room}.{code}"):
        REFUSED[room][code][way]()

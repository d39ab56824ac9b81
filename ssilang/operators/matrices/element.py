"""RIGI, MASS, LUMP, AMOR, HOOK, KSIG: matrices of the elements of a model."""

from functools import wraps

from ssilang.kernel.elements import families
from ssilang.kernel.elements.beams.rotating import corotational
from ssilang.kernel.elements.boundary import absorbing_boundary
from ssilang.kernel.elements.catalog import FLAT_SHELLS, family_name
from ssilang.kernel.elements.loads.follower import gradient_stiffness, pressure_stiffness
from ssilang.kernel.elements.shells.shell_section import moduli_on_mesh
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.solids.solid_moduli import hooke_block
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.matrices.build import lumped_matrix, nodal_diagonal
from ssilang.kernel.mesh.boundary import faces_inside
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix
from ssilang.messages.message import Refusal, find
from ssilang.operators.models.contact import model_relations
from ssilang.operators.prelude import *

UNKNOWNS = ("UX", "UY", "UZ", "UR", "UT", "RX", "RY", "RZ", "RT", "P", "PI", "T", "ALFA", "BETA")


def joined(fields: tuple[CellField, ...]) -> CellField:
    """Several fields of characteristics as one."""
    if len(fields) == 1:
        return fields[0]
    return CellField(tuple(b for f in fields for b in f.blocks), fields[0].title)


def present(call: Call, model: Model, pressures: bool = False) -> Model:
    """The mechanical zones of a model, Fourier ones with the harmonic that OPTI says now.

    With `pressures` the zones of loads are kept too.
    """
    harmonic = workspace(call.session).fourier
    zones = []
    for zone in model.zones:
        if zone.formulation != "MECANIQUE" and not pressures:
            continue
        if zone.mode is Mode.FOURIER and zone.options.get("harmonic") != harmonic:
            zone = replace(zone, options={**zone.options, "harmonic": harmonic})
        zones.append(zone)
    return Model(tuple(zones))


def _assembled(model: Model, blocks: list[ElementMatrices], kind: str) -> Matrix:
    if not blocks:
        raise MeshError("operators.matrices.no-mechanical-zone")
    return Matrix(model.mesh.nodes, tuple(blocks), (), kind)


MODEL = arg("model", "MMODEL", en="model")
PARAMETERS = many("fields", "MCHAML", at_least=1, en="parameters, or Hooke matrices")
_ON_MESH = flag("on_mesh", "REFE", en="of shells off the mesh (EXCE): of forces on the mesh")
NO_ERROR = flag("silent", "NOER", en="an error gives its number as the result")


def numbered(*codes: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Errors of these codes, all if none is said, give their number (or 1) where `silent` is."""

    def around(function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def made(*arguments: object, silent: bool, **named: object) -> object:
            try:
                return function(*arguments, silent=silent, **named)
            except Refusal as error:
                if not silent or (codes and error.code not in codes):
                    raise
                return find(error.code).number or 1

        return made

    return around


_BUCKLING = flag("buckling", "FLAM", en="of type MASSE, for an analysis of buckling with VIBR")
_AT_NODES = (
    key(
        "names",
        ("DEPL", "ROTA", *UNKNOWNS),
        repeated=True,
        en="all translations (default), all rotations, or unknowns",
    ),
    arg("amount", "FLOTTANT", usual=NOT_NEGATIVE, en="value at each node"),
    arg("place", "MAILLAGE", "POINT", en="nodes"),
)
_OF_SPRINGS = tuple(  # negative ones stand for the moment of a weight
    replace(entry, usual=ANY_NUMBER) if isinstance(entry, Argument) else entry
    for entry in _AT_NODES
)


def _additional(
    call: Call, kind: str, names: list[str], amount: float, place: Mesh | Point
) -> Matrix:
    """Values added at nodes, on groups of unknowns or on unknowns by name."""
    if amount < 0.0 and kind != "RIGIDITE":
        call.warn("operators.matrices.negative-at-nodes", kind=kind[:4], amount=amount)
    mode = workspace(call.session).mode
    groups = {"DEPL": NODE_TRANSLATIONS[mode], "ROTA": NODE_ROTATIONS[mode]}
    said = [n for name in names for n in groups.get(name, (name,))]
    nodes = place.sorted_node_ids
    if not len(nodes):
        call.warn("operators.matrices.at-no-node")
    chosen = dict.fromkeys(said or NODE_TRANSLATIONS[mode])
    values = {n: np.full(len(nodes), amount) for n in chosen}
    return nodal_diagonal(place.nodes, nodes, values, kind)


@operator(
    "RIGI",
    MODEL,
    replace(PARAMETERS, optional=True),
    NO_ERROR,
    family="matrix",
    full_name="RIGIDITE",
    gives=by("silent", {True: "RIGIDITE|ENTIER"}, default="RIGIDITE"),
)
@numbered()
def rigi(call: Call, model: Model, fields: tuple[CellField, ...], silent: bool) -> Matrix:
    """Elastic stiffness of a model."""
    if any(z.formulation == "CONTACT" for z in model.zones):
        # bodies, and the unilateral relations of sides
        material = joined(fields) if fields else None
        if any(z.behaviour[:1] == ("FROTTANT",) for z in model.zones):
            raise call.error("operators.matrices.friction-is-no-matrix")
        relations = tuple(c.relations for c in model_relations(model, material))
        zones = present(call, model).zones
        if zones and material is None:
            raise call.missing(("MCHAML",))
        blocks = [families.stiffness(z, material) for z in zones if material is not None]
        return Matrix(model.mesh.nodes, tuple(blocks), relations, "RIGIDITE")
    if not fields:
        raise call.missing(("MCHAML",))
    return _whole(present(call, model), fields, families.stiffness, "RIGIDITE")


@rigi.form(*_OF_SPRINGS)
def springs(call: Call, names: list[str], amount: float, place: Mesh | Point) -> Matrix:
    """Springs at nodes."""
    return _additional(call, "RIGIDITE", names, amount, place)


def _whole(
    model: Model, fields: tuple[CellField, ...], of: Callable[..., ElementMatrices], kind: str
) -> Matrix:
    """The matrix of the bodies of a model, and of its modes and static shapes."""
    material = joined(fields)
    shapes = shape_matrix(model.zones, material, kind)
    blocks = [of(z, material) for z in model.zones if not is_shape(z)]
    return _assembled(model, blocks if shapes is None else [*blocks, shapes], kind)


@operator("MASS", MODEL, PARAMETERS, family="matrix", full_name="MASSE")
def mass(call: Call, model: Model, fields: tuple[CellField, ...]) -> Matrix:
    """Consistent mass of a model."""
    shown = present(call, model)
    made = _whole(shown, fields, families.mass, "MASSE")
    return workspace(call.session).weighed(made, *(z.constituent for z in shown.zones))


@mass.form(*_AT_NODES)
def masses(call: Call, names: list[str], amount: float, place: Mesh | Point) -> Matrix:
    """Masses at nodes."""
    return workspace(call.session).weighed(_additional(call, "MASSE", names, amount, place))


@operator("LUMP", MODEL, PARAMETERS, family="matrix")
def lump(call: Call, model: Model, fields: tuple[CellField, ...]) -> Matrix:
    """Diagonal mass of a model."""
    shown, material = present(call, model), joined(fields)
    return _assembled(shown, [families.mass(z, material, True) for z in shown.zones], "MASSE")


@lump.form()
def lump_of_matrix(
    call: Call,
    matrix: Matrix = Arg("RIGIDITE", en="full mass"),
    kept: ListMots | None = Opt(
        "LISTMOTS", kind="component", en="unknowns that keep their diagonal term"
    ),
) -> Matrix:
    """Diagonal mass of a full one."""
    made = lumped_matrix(matrix, () if kept is None else tuple(m.rstrip() for m in kept.values))
    most = [max(np.abs(b.values).max(initial=0.0) for b in m.blocks) for m in (made, matrix)]
    if most[0] < 1e-9 * most[1]:
        call.warn("operators.matrices.lumped-to-nothing", matrix)
    return made


@operator(
    "AMOR",
    MODEL,
    arg("boundary", "MAILLAGE", en="absorbing boundary"),
    PARAMETERS,
    family="matrix",
    full_name="AMORTISSEMENT",
)
def amor(call: Call, model: Model, boundary: Mesh, fields: tuple[CellField, ...]) -> Matrix:
    """Absorbing boundary."""
    shown = present(call, model)
    if inner := faces_inside(boundary, shown.mesh):
        call.warn("operators.matrices.border-inside", boundary, count=inner)
    return absorbing_boundary(shown, boundary, joined(fields))


@amor.form(
    choice("turning", ("COROTATIF",), optional=False, en="the damping turns with the beams"),
    MODEL,
    PARAMETERS,
)
def turning_damping(
    call: Call, turning: bool, model: Model, fields: tuple[CellField, ...]
) -> tuple[Matrix, Matrix]:
    """Damping that turns with beams, and the circulatory stiffness beside it."""
    shown, material = present(call, model), joined(fields)
    blocks = [families.viscosity(z, material) for z in shown.zones if not is_shape(z)]
    pairs = zip(shown.zones, blocks, strict=True)
    turned = [corotational(z, b, material) for z, b in pairs]
    return _assembled(shown, blocks, "AMORTISSEMENT"), _assembled(shown, turned, "RIGIDITE")


@amor.form(MODEL, PARAMETERS)
def damping(call: Call, model: Model, fields: tuple[CellField, ...]) -> Matrix:
    """Viscous damping of a model."""
    return _whole(present(call, model), fields, families.viscosity, "AMORTISSEMENT")


@amor.form(*_AT_NODES)
def dashpots(call: Call, names: list[str], amount: float, place: Mesh | Point) -> Matrix:
    """Dashpots at nodes."""
    return _additional(call, "AMORTISSEMENT", names, amount, place)


@operator("HOOK", MODEL, PARAMETERS, _ON_MESH, family="matrix", full_name="HOOKE")
def hook(call: Call, model: Model, fields: tuple[CellField, ...], on_mesh: bool) -> CellField:
    """Elastic matrices at the integration points."""
    material = joined(fields)
    blocks = []
    for zone in present(call, model).zones:
        parameters = zone_field(zone, material)
        moduli = families.family_of(zone).moduli(zone, parameters, "RIGIDITE")
        if on_mesh and family_name(zone) in FLAT_SHELLS:
            moduli = moduli_on_mesh(moduli, zone, parameters)
        blocks.append(hooke_block(zone, moduli, "RIGIDITE"))
    return CellField(tuple(blocks), "MATRICE DE HOOKE")


@operator("KSIG", family="matrix", full_name="KSIGMA")
def ksig(
    call: Call,
    model: Model = MODEL,
    fields: tuple[CellField, ...] = Many("MCHAML", at_least=1, en="stresses, and parameters"),
    buckling: bool = _BUCKLING,
) -> Matrix:
    """Geometric stiffness."""
    shown = present(call, model)
    stress = next((f for f in fields if f.title != "CARACTERISTIQUES"), fields[0])
    rest = tuple(f for f in fields if f is not stress)
    material = joined(rest) if rest else None
    blocks = [families.geometric_stiffness(z, stress, material) for z in shown.zones]
    return _assembled(shown, blocks, "MASSE" if buckling else "RIGIDITE")


_WHOLE = flag("whole", "ASYM", en="the unsymmetric part too")


@operator("KP", family="matrix")
def kp(
    call: Call,
    model: Model = MODEL,
    pressure: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="pressure", unit="Pa"),
    buckling: bool = _BUCKLING,
    whole: bool = _WHOLE,
) -> Matrix:
    """Follower pressure."""
    shown = present(call, model, pressures=True)
    blocks = [pressure_stiffness(z, pressure, whole) for z in shown.zones]
    return _assembled(shown, blocks, "MASSE" if buckling else "RIGIDITE")


@kp.form()
def kp_of_gradient(
    call: Call,
    model: Model = MODEL,
    modulus: float = Arg("FLOTTANT", en="gradient of the pressure", unit="N/m3", range=ANY_NUMBER),
    direction: Point | None = Opt("POINT", en="its direction, else the sides' normals"),
    buckling: bool = _BUCKLING,
    whole: bool = _WHOLE,
) -> Matrix:
    """Pressure that varies in space."""
    shown = present(call, model, pressures=True)
    along = None if direction is None else direction.coordinates
    blocks = [gradient_stiffness(z, float(modulus), along, whole) for z in shown.zones]
    return _assembled(shown, blocks, "MASSE" if buckling else "RIGIDITE")

"""PASAPAS under OPTI 'MODE' 'FREQ': harmonic responses over a sweep of frequencies."""

from ssilang.kernel.elements.families import mass, stiffness
from ssilang.kernel.elements.springs import counts_damping, dynamic_stiffness, is_impedance
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields import node_algebra
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix
from ssilang.kernel.plasticity.points import is_plastic
from ssilang.kernel.statics.frequency import HarmonicInputs, default_frequencies, sweep
from ssilang.kernel.statics.thermal_load import loaded_sides, with_pressures
from ssilang.operators.prelude import *
from ssilang.operators.session.progress import ProgressLine
from ssilang.operators.statics.pasapas_contact import joined_matrix
from ssilang.operators.statics.pasapas_results import put_results
from ssilang.operators.statics.pasapas_stages import loads_taken
from ssilang.operators.tables.entries import Entries

_RESULTS = ("TEMPS", "DEPLACEMENTS", "REACTIONS")


@operator("ZFRE", family="statics")
def zfre(call: Call, table: Table = Arg("TABLE", en="table of PASAPAS")) -> None:
    """Fill TEMPS (frequencies in Hz), DEPLACEMENTS and REACTIONS, 0 being a state at rest."""
    entries = Entries(call, table, "PASAPAS")
    if isinstance(entries.get("REPRISE"), Table):
        entries.refuse({"REPRISE": "operators.dynamics.not-kept-frequencies"})
    inputs = _inputs(loads_taken(entries))
    frequencies = _frequencies(entries, inputs)
    for word in _RESULTS:
        entries.table.set(Mot(word), Table())
    entries.table.set(Mot("CONV"), False)
    line = ProgressLine("PASAPAS", entries.call.session.told)
    at_rest = partial(node_algebra.applied, function=np.zeros_like)
    try:
        for number, found in enumerate(sweep(inputs, frequencies), 1):
            fields = found.displacement, found.reactions
            if number == 1:
                _put(entries, 0, 0.0, *map(at_rest, fields))
            _put(entries, number, found.frequency, *fields)
    finally:
        line.close()
    entries.table.set(Mot("CONV"), True)
    entries.table.set(Mot("ERREUR"), False)


def _put(entries: Entries, number: int, *values: Any) -> None:
    put_results(entries.table, number, dict(zip(_RESULTS, values, strict=True)), keep=False)


def _frequencies(entries: Entries, inputs: HarmonicInputs) -> FloatArray:
    said = (entries.get(word) for word in ("TEMPS_CALCULES", "TEMPS_SAUVES"))
    given = next((values for values in said if values is not None), None)
    if given is None:
        return default_frequencies(inputs)
    values = np.asarray(given.values, dtype=float)
    if not len(values) or (values < 0.0).any():
        raise entries.error("operators.statics.frequencies-wanted")
    return values


def _inputs(entries: Entries) -> HarmonicInputs:
    model: Model | None = entries.get("MODELE")
    zones = () if model is None else model.zones
    mechanical = tuple(z for z in zones if z.formulation == "MECANIQUE")
    for zone in mechanical:
        _check_linear(zone)
    none = CellField((), "CARACTERISTIQUES")
    material: CellField = entries.needed("CARACTERISTIQUES") if mechanical else none
    blocks: dict[str, list[ElementMatrices]] = {"RIGIDITE": [], "MASSE": [], "AMORTISSEMENT": []}
    springs, silent = [], False
    for zone in (z for z in mechanical if not is_shape(z)):
        if is_impedance(zone):
            given = zone_field(zone, material).own()
            silent = silent or counts_damping(zone, given)
            blocks["MASSE"].append(mass(zone, material))
            if dynamic_stiffness(zone, given, 1.0) is not None:
                springs.append((zone, given))
            else:
                blocks["RIGIDITE"].append(stiffness(zone, material))
        else:
            blocks["RIGIDITE"].append(stiffness(zone, material))
            blocks["MASSE"].append(mass(zone, material))
    for kind, found in blocks.items():
        shapes = shape_matrix(mechanical, material, kind)
        found += [] if shapes is None else [shapes]
    damping = entries.get("AMORTISSEMENT")
    if silent and damping is None:
        entries.warn("operators.statics.dashpots-by-numbers")
    if damping is None and blocks["AMORTISSEMENT"]:
        damping = joined_matrix(entries, blocks["AMORTISSEMENT"], (), "AMORTISSEMENT")
    supports = entries.get("BLOCAGES_MECANIQUES")
    constant = entries.get("RIGIDITE_CONSTANTE")
    return HarmonicInputs(
        joined_matrix(entries, blocks["RIGIDITE"], (constant, supports), "RIGIDITE"),
        joined_matrix(entries, blocks["MASSE"], (entries.get("MASSE_CONSTANTE"),), "MASSE"),
        damping,
        with_pressures(entries.get("CHARGEMENT"), () if model is None else loaded_sides(model)),
        tuple(springs),
    )


def _check_linear(zone: Zone) -> None:
    if is_plastic(zone) or (is_joint(zone) and not law_of(zone.behaviour).linear):
        raise KernelError(
            "operators.statics.law-has-no-harmonic-response", behaviour=zone.behaviour
        )

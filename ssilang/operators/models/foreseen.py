"""What MODE and MATE say of a material before a script runs: laws by words, numbers as constants.

`ssilang check` asks here, so that it refuses what a run would refuse, at the same place.
"""

from ssilang.kernel.elements.catalog import ELEMENTS, GENERIC_ELEMENTS
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.interface.laws.parameter_table import check_given
from ssilang.kernel.materials.behaviours import UNIAXIAL_LAWS, normalised
from ssilang.kernel.materials.parameters import geometric_names
from ssilang.kernel.materials.plastic.laws import plastic_law
from ssilang.operators.models import materials
from ssilang.operators.models.mode import OF_JOINTS, Wish, read_word
from ssilang.operators.models.units import warn_of_units
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary.words import known_parameters, sample

_OTHERS = frozenset({"IMPEDANCE", "MODAL", "STATIQUE", "SECTION"})
"""Laws whose parameters are no numbers alone, or hang on what stands elsewhere."""


def foreseen_zone(call: Call, said: Iterable[str]) -> Zone | None:
    """A zone of one cell with the law that words of MODE name; None where they do not tell it."""
    wish = Wish()
    try:
        for word in said:
            read_word(call, word, wish)
        element = _element(wish)
        if element is None:
            return None
        kind = ELEMENTS[element]
        mode = Mode.PLANE_STRAIN if Mode.PLANE_STRAIN in kind.modes else next(iter(kind.modes))
        return sample(element, mode, normalised(wish.laws, kind.family))
    except (SsiError, KernelError):  # the words are wrong, which is told where they stand
        return None


def refuse_words(call: Call, said: Iterable[str]) -> None:
    """Refuse words of MODE that a run refuses whatever the mesh, and laws that an element lacks.

    Raises
    ------
    SsiError
        Of a word at its place.
    KernelError
        Of a law that the only element named does not have.
    """
    wish = Wish()
    for word in said:
        read_word(call, word, wish)
    named = [n for n in wish.elements if n not in GENERIC_ELEMENTS]
    if len(wish.elements) == len(named) == 1 and wish.laws and "IMPEDANCE" not in wish.laws:
        normalised(wish.laws, ELEMENTS[named[0]].family)


def _element(wish: Wish) -> str | None:
    """The element that is named, or one that has the law."""
    if wish.formulation not in ("", "MECANIQUE") or not wish.laws or _OTHERS & {*wish.laws}:
        return None
    named = [n for n in wish.elements if n not in GENERIC_ELEMENTS]
    if named:
        return named[0]
    if any(word in OF_JOINTS for word in wish.laws):
        law = law_of(tuple(wish.laws))
        return "JOI1" if law.macro or law.two_points else "JOI2"
    return "POJS" if any(word in UNIAXIAL_LAWS for word in wish.laws) else "QUA4"


def refuse_constants(call: Call, zone: Zone, pairs: Iterable[tuple[str, Any]]) -> None:
    """Refuse numbers of MATE that the law of a zone refuses, and warn of what a run warns of.

    Parameters
    ----------
    pairs : iterable of (str, object)
        Names and values, stand-ins where only the run knows the value. Names that the zone does
        not have may be those of the element that is not known here, if any has them.

    Raises
    ------
    SsiError
        Of a number at its place.
    MaterialError
        Of the law of a joint, as in a run.
    """
    known = (*materials.material_names(zone), *geometric_names(zone).all)
    law = None if is_joint(zone) else plastic_law(zone.behaviour)
    values: materials.Values = {}
    said: dict[str, Any] = {}
    for written, value in pairs:
        name = materials.parameter_name(written, known)
        if not {name, written.upper().rstrip()} & {*known, *known_parameters()}:
            raise materials.unknown_parameter(
                call, written, Model((zone,)), materials.material_names
            )
        if name not in known or (type(value) not in (int, float) and name in _curves(law)):
            continue
        number = type(value) in (int, float)
        one = np.full((1, 1), float(value)) if number else np.full((1, 1), None, dtype=object)
        values[name], said[name] = (one, "GRAVITE"), value
    if is_joint(zone):
        check_given(zone, {name: value for name, (value, _) in values.items()})
    materials.refuse_outside(call, zone, values, said)
    materials.check_plastic(call, zone, values, said)
    warn_of_units(call, zone, {name: (value, said[name]) for name, (value, _) in values.items()})


def _curves(law: Any) -> tuple[str, ...]:
    return () if law is None else law.curves

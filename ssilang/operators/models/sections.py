"""MOCU: moments and curvatures of sections of fibres."""

from ssilang.kernel.elements.beams.fibre_section import fibre_section
from ssilang.operators.matrices.supports import IN_PLANE, IN_SPACE
from ssilang.operators.prelude import *

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.moment_curvature import BentSection


_ENTRIES = (
    flag("checked", "VERIF", en="a table of the fields too"),
    many("lists", "LISTREEL", en="curvatures and normal force, one value a step", range=ANY_NUMBER),
    arg("model", "MMODEL", en="section of fibres"),
    arg("material", "MCHAML", en="its parameters"),
    arg("tolerance", "FLOTTANT", range=POSITIVE, en="error allowed on the normal force, relative"),
)


@operator(
    "MOCU",
    *_ENTRIES,
    when=IN_SPACE,
    gives=by("checked", {True: ("LISTREEL",) * 3 + ("TABLE",)}, ("LISTREEL",) * 3),
    family="model",
)
def mocu(
    call: Call,
    checked: bool,
    lists: tuple[ListReel, ...],
    model: Model,
    material: CellField,
    tolerance: float,
) -> tuple[object, ...]:
    """Bend a section."""
    from ssilang.kernel.plasticity.moment_curvature import bend

    space = workspace(call.session).mode.dimension == 3
    _check(call, lists, model, space)
    curvatures = np.stack([v.values for v in lists[:-1]], axis=1)
    if not space:
        curvatures = np.column_stack([np.zeros(len(curvatures)), curvatures])
    found = bend(fibre_section(model, material), curvatures, lists[-1].values, tolerance)
    moments = [ListReel.of(found.moments[:, i].copy()) for i in ((0, 1) if space else (1,))]
    return _results(found, moments, checked)


mocu.form(
    *_ENTRIES,
    when=IN_PLANE,
    gives=by("checked", {True: ("LISTREEL",) * 2 + ("TABLE",)}, ("LISTREEL",) * 2),
)(mocu.forms[0].function)


def _check(call: Call, lists: tuple[ListReel, ...], model: Model, space: bool) -> None:
    if len(lists) != (3 if space else 2):
        raise call.error(
            "operators.models.section-list-count", model, n_lists=len(lists), space=space
        )
    if len({len(v.values) for v in lists}) > 1:
        raise call.error("operators.models.lists-different-lengths", lists[-1])


def _results(found: "BentSection", moments: list[ListReel], checked: bool) -> tuple[object, ...]:
    results = (*moments, ListReel.of(found.strains))
    if not checked:
        return results
    stresses, variables = found.fields()
    table = Table.of(
        {
            "CONTRAINTES": Table.numbered(stresses),
            "VARIABLES_INTERNES": Table.numbered(variables),
            "DEFORMATION": Table.numbered(float(e) for e in found.strains),
        }
    )
    return (*results, table)

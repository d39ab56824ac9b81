"""PART and CCON: a mesh taken apart into a table of zones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.queries.partition import balanced, connected, scattered, separated
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Mot, Table

_CUT = "OPTI DIME 2 ELEM SEG2 ; L = (DROI 2 (0. 0.) (1. 0.)) ET (DROI 3 (2. 0.) (3. 0.)) ; "


@operator(
    "PART",
    family="mesh",
    full_name="PARTITION",
    help=Help(
        en="Table of the zones 1, 2 ... of a mesh, of sub-type 'ESCLAVE' unless 'NESC' is said. "
        "'CONN': parts joined by common nodes. 'SEPA': parts joined by common sides, except "
        "('FACE', 'LIGN') sides of more than two cells, ('MAIL') sides within cells of a mesh, "
        "('ANGL') sides where normals or tangents turn by more than an angle (20 degrees); cells "
        "described in opposite senses are not taken as folded unless 'TELQ' is said. 'OPTI': as "
        "many equal parts as said (a power of 2, by default 2). 'ARLE' (of a model also without "
        "this word): cells dealt out in turn to that many parts. ETG joins the parts again.",
        fr="Table des zones 1, 2 ... d'un maillage, de sous-type 'ESCLAVE' sauf avec 'NESC'. "
        "'CONN' : parties jointes par des noeuds communs. 'SEPA' : parties jointes par des côtés "
        "communs, sauf ('FACE', 'LIGN') ceux de plus de deux éléments, ('MAIL') ceux compris dans "
        "des éléments d'un maillage, ('ANGL') ceux où normales ou tangentes tournent de plus d'un "
        "angle (20 degrés) ; des éléments de sens contraires ne sont pas pris pour repliés sauf "
        "avec 'TELQ'. 'OPTI' : autant de parties égales que dit (puissance de 2, par défaut 2). "
        "'ARLE' (pour un modèle aussi sans ce mot) : éléments distribués tour à tour à ce nombre "
        "de parties. ETG les réunit.",
        syntax="TAB1 = PART ('NESC') 'CONN' MAIL1 ;\n"
        "TAB1 = PART ('NESC') 'SEPA' MAIL1 ('FACE'|'LIGN') ('MAIL' MAIL2) "
        "('ANGL' (FLOT1) ('TELQ')) ;\n"
        "TAB1 = PART ('NESC') 'OPTI' MAIL1 (N1) ; TAB1 = PART ('NESC') 'ARLE' MAIL1 N1 ;\n"
        "TAB1 = PART ('NESC') ('ARLE') MODL1 N1 ;",
        examples=(_CUT + "T = PART 'NESC' 'CONN' L ; MESS (DIME T) ;",),
    ),
    reads_itself=True,
)
def part(call: Call) -> Table:
    """Zones of a mesh."""
    slaves = call.keyword(("NESC",)) is None
    how = call.keyword(("CONN", "SEPA", "OPTI", "ARLE"))
    slaves = slaves and call.keyword(("NESC",)) is None
    model = call.read("MMODEL") if how in ("ARLE", None) else None
    if model is not None:
        return _table(_models(call, model.value), "ESCLAVE" if slaves else "")
    if how is None:
        raise call.bad(
            "how the mesh is taken apart is not said",
            hint="say 'CONN' (common nodes), 'SEPA' with what separates, 'OPTI' or 'ARLE'",
        )
    mesh: Mesh = call.required("MAILLAGE")
    return _table(_ZONES[how](call, mesh), "ESCLAVE" if slaves else "")


def _count(call: Call) -> int:
    count: int = call.required("ENTIER")
    if count < 1:
        raise call.bad(f"a mesh is not taken apart into {count} parts", count)
    return count


def _dealt_out(call: Call, mesh: Mesh) -> list[Mesh]:
    return scattered(mesh, _count(call))


def _models(call: Call, model: Model) -> list[Model]:
    """Models whose cells are dealt out in turn, zone by zone."""
    made: list[list[Zone]] = [[] for _ in range(_count(call))]
    for zone in model.zones:
        for place, mesh in enumerate(scattered(Mesh(zone.cells.nodes, (zone.cells,)), len(made))):
            made[place] += [replace(zone, cells=cells) for cells in mesh.blocks]
    return [Model(tuple(zones)) for zones in made if zones]


_ZONES: dict[str, Callable[[Call, Mesh], list[Mesh]]] = {
    "CONN": lambda call, mesh: connected(mesh),
    "SEPA": lambda call, mesh: separated(mesh, **_separators(call)),
    "OPTI": lambda call, mesh: balanced(mesh, call.optional("ENTIER", default=2)),
    "ARLE": _dealt_out,
}


def _separators(call: Call) -> dict[str, Any]:
    said: dict[str, Any] = {}
    while (word := call.keyword(("FACE", "LIGN", "MAIL", "ANGL"))) is not None:
        if word == "MAIL":
            said["separator"] = call.required("MAILLAGE", after=call.keyword_end)
        elif word == "ANGL":
            said["angle"] = float(call.optional("FLOTTANT", default=20.0))
            said["folded"] = call.keyword(("TELQ",)) is not None
        else:
            said["by_branching"] = True
    if not said:
        raise call.bad("nothing separates", hint="say 'FACE', 'LIGN', 'MAIL' MAIL2 or 'ANGL'")
    return said


def _table(zones: list[Mesh] | list[Model], kind: str) -> Table:
    table = Table()
    if kind:
        table.set(Mot("SOUSTYPE"), Mot(kind))
    for number, zone in enumerate(zones, 1):
        table.set(number, zone)
    return table


@operator(
    "CCON",
    family="mesh",
    help=Help(
        en="Table of the connected parts 1, 2 ... of a mesh. With 'STR1' points of more than two "
        "lines separate, with 'STR2' cells hang together by edges of not more than two cells. "
        "PART does more.",
        fr="Table des composantes connexes 1, 2 ... d'un maillage. Avec 'STR1' les points de plus "
        "de deux lignes séparent, avec 'STR2' les éléments se tiennent par des arêtes d'au plus "
        "deux éléments. PART en fait davantage.",
        syntax="TAB1 = CCON ('STR1'|'STR2') MAIL1 ;",
        examples=(_CUT + "T = CCON L ; MESS (NBEL (T . 2)) ;",),
    ),
    reads_itself=True,
)
def ccon(call: Call) -> Table:
    """Connected parts."""
    strict = call.keyword(("STR1", "STR2"))
    mesh: Mesh = call.required("MAILLAGE")
    strict = strict or call.keyword(("STR1", "STR2"))
    return _table(separated(mesh, by_branching=True) if strict else connected(mesh), "")

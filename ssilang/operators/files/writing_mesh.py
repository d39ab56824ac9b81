"""SORT and LIRE without a format: a mesh with its named parts, in ssilang's own file."""

from __future__ import annotations

from contextlib import closing
from typing import Any

import numpy as np

from ssilang.io.archive import Archive, Decoder, Encoder, Record, read_archive, write_archive
from ssilang.io.errors import InputError
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import flag, lead, main, named
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.files.meshes import mesh_table
from ssilang.operators.files.outputs import input_path, option_name, run_output
from ssilang.operators.files.reading import LIRE
from ssilang.operators.files.saving import check_settings
from ssilang.operators.files.writing import SORT, target_path
from ssilang.operators.workspace import workspace


@SORT.form(
    main("mesh", "MAILLAGE", en="mesh"),
    flag("kept", "NOOP", en="changes nothing"),
    syntax="SORT MAIL1 ('NOOP') ;",
    en="Without a word: a mesh with its named parts (points and meshes on its nodes), in a file of "
    "ssilang's own that LIRE reads; SAUV saves everything else too.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; OPTI SORT 'line' ; SORT L ; "
        "OPTI LECT 'line' ; LIRE L ; MESS (NBEL L) ;",
    ),
)
def _sort_mesh(call: Call, mesh: Mesh, kept: bool) -> None:
    frame = call.session.frame
    encoder = Encoder()
    names = {}
    for name in sorted(frame.names()):
        value = frame.find(name)
        if value is mesh or _is_part(value, mesh):
            names[name] = encoder.encode(value)
    if not any(frame.find(name) is mesh for name in names):
        names["MAILLAGE"] = encoder.encode(mesh)
    path = target_path(call)
    ws = workspace(call.session)
    write_archive(
        path, encoder.objects, encoder.arrays, [Record("", names)], {"DIME": ws.dimension}
    )
    run_output(call.session).wrote(path)


def _is_part(value: Any, mesh: Mesh) -> bool:
    if isinstance(value, Point):
        return bool(np.isin(value.node, mesh.sorted_node_ids))
    if isinstance(value, Mesh) and value.blocks:
        return bool(np.isin(value.sorted_node_ids, mesh.sorted_node_ids).all())
    return False


@LIRE.form(
    lead("file", "MOT", en="file, or mesh that must be there"),
    gives="TABLE|",
    syntax="TAB1 = LIRE FIC1 ;",
    en="A file by its ending (LIRE 'm.msh'): as MESH.",
    examples=(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ;\n"
        "OPTI SORT 'plate.inp' ; SORT 'MESH' S ; T = LIRE 'plate.inp' ; LIST (T . 'MAILLAGE') ;",
    ),
)
def _lire_file(call: Call, file: str) -> Table | None:
    if "." in file:  # which no name has
        return mesh_table(call, str(file))
    _lire_own(call, file.strip().upper())
    return None


@LIRE.form(
    named("wanted", optional=True, en="mesh that must be there"),
    syntax="LIRE (GEO1) ;",
    en="Without a word: the mesh and its named parts from the file that OPTI LECT names, written "
    "by SORT; GEO1 must be one of them if it is given.",
)
def _lire_own(call: Call, wanted: str) -> None:
    path = input_path(call, option_name(call.session, "LECT", 4))
    with closing(read_archive(path)) as archive:
        _restore(call, archive, wanted)


def _restore(call: Call, archive: Archive, wanted: str) -> None:
    names = archive.records[0].names if archive.records else {}
    if wanted and wanted not in names:
        known = ", ".join(names)
        raise InputError(
            "operators.files.no-such-mesh", name=archive.path.name, wanted=wanted, known=known
        )
    check_settings(archive, archive.path.name)
    ws = workspace(call.session)
    decoder = Decoder(archive, ws.nodes)
    for name, value in decoder.named(archive.records[:1]):
        call.session.frame.assign(name, value)
    ws.dimension = ws.dimension or int(archive.settings.get("DIME", 0))

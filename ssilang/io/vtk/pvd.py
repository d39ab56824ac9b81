"""The list of a series' files and times (.pvd), which ParaView opens as one data set."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from ssilang.io.atomic import write_text
from ssilang.io.errors import InputError
from ssilang.io.vtk.quoting import quoteattr


@dataclass(frozen=True, slots=True)
class Entry:
    """One file of a series: time, part name, file name relative to the .pvd."""

    time: float
    part: str
    file: str


def write_pvd(path: Path, entries: list[Entry]) -> None:
    """Write the collection `path`, whole or not at all."""
    numbers = {name: i for i, name in enumerate(dict.fromkeys(e.part for e in entries))}
    lines = [
        f'<DataSet timestep="{e.time!r}" group="" part="{numbers[e.part]}"'
        f" name={quoteattr(e.part)} file={quoteattr(e.file)}/>"
        for e in entries
    ]
    body = "\n".join(lines)
    write_text(
        path,
        '<?xml version="1.0"?>\n'
        '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
        f"<Collection>\n{body}\n</Collection>\n</VTKFile>\n",
    )


def read_pvd(path: Path) -> list[Entry]:
    """The entries of a collection.

    Raises
    ------
    InputError
        If the file is absent or no collection.
    """
    try:
        root = ElementTree.parse(path).getroot()
        return [
            Entry(float(e.attrib["timestep"]), e.attrib.get("name", ""), e.attrib["file"])
            for e in root.iter("DataSet")
        ]
    except (OSError, ElementTree.ParseError, KeyError, ValueError) as error:
        raise InputError("io.not-readable-pvd-collection", path=path, error=error) from error

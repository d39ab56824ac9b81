"""Which line, surface and volume cells go with the element chosen by OPTI ELEM."""

from dataclasses import dataclass

from ssilang.kernel.base.errors import MeshError


@dataclass(frozen=True, slots=True)
class Family:
    """Cells that the generators make for one choice of element.

    Attributes
    ----------
    line : str
        'SEG2' or 'SEG3'.
    surface : str
        'TRI3', 'TRI6', 'QUA4', 'QUA8' or 'POLY' (polygons); '' when the choice is a line.
    volume : str
        '' when the choice is a line or a surface.
    """

    line: str
    surface: str = ""
    volume: str = ""

    @property
    def quadratic(self) -> bool:
        """True when lines have a middle node."""
        return self.line == "SEG3"

    def need_surface(self) -> str:
        """The surface cell.

        Raises
        ------
        MeshError
            If the choice was a line element.
        """
        if not self.surface:
            raise MeshError("kernel.mesh.no-surface-made-elements", line=self.line)
        return self.surface


FAMILIES: dict[str, Family] = {
    "POI1": Family("SEG2"),
    "SEG2": Family("SEG2"),
    "SEG3": Family("SEG3"),
    "TRI3": Family("SEG2", "TRI3"),
    "TRI6": Family("SEG3", "TRI6"),
    "QUA4": Family("SEG2", "QUA4"),
    "QUA8": Family("SEG3", "QUA8"),
    "POLY": Family("SEG2", "POLY"),
    "RAC2": Family("SEG2"),
    "RAC3": Family("SEG3"),
    "LIA3": Family("SEG2", "TRI3"),
    "LIA4": Family("SEG2", "QUA4"),
    "LIA6": Family("SEG3", "TRI6"),
    "LIA8": Family("SEG3", "QUA8"),
    "TET4": Family("SEG2", "TRI3", "TET4"),
    "TE10": Family("SEG3", "TRI6", "TE10"),
    "PYR5": Family("SEG2", "QUA4", "PYR5"),
    "PRI6": Family("SEG2", "QUA4", "PRI6"),
    "PR15": Family("SEG3", "QUA8", "PR15"),
    "CUB8": Family("SEG2", "QUA4", "CUB8"),
    "CU20": Family("SEG3", "QUA8", "CU20"),
}


def family_of(element: str) -> Family:
    """The family of an element name.

    Raises
    ------
    MeshError
        If the name is unknown.
    """
    found = FAMILIES.get(element)
    if found is None:
        raise MeshError("kernel.mesh.no-mesh-made-elements", element=element)
    return found

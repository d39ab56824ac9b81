"""pyvista, loaded when something in it is used."""

from typing import TYPE_CHECKING

from ssilang.late_imports import Late

if TYPE_CHECKING:
    import pyvista
else:
    pyvista = Late("pyvista")

__all__ = ["pyvista"]

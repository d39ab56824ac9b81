"""VTK files that ParaView and pyvista open: .vtu, .pvd; `vtkhdf` writes one for a series."""

from ssilang.io.vtk.grid import Grid, grid_of
from ssilang.io.vtk.series import Part, SeriesWriter
from ssilang.io.vtk.vtu import Encoding, write_vtu

__all__ = ["Encoding", "Grid", "Part", "SeriesWriter", "grid_of", "write_vtu"]

"""VTK files (.vtu, .pvd, .vtkhdf) that ParaView and pyvista open."""

from ssilang.io.vtk.grid import Grid, grid_of
from ssilang.io.vtk.series import Part, SeriesWriter
from ssilang.io.vtk.vtkhdf import VtkHdfWriter
from ssilang.io.vtk.vtu import Encoding, write_vtu

__all__ = ["Encoding", "Grid", "Part", "SeriesWriter", "VtkHdfWriter", "grid_of", "write_vtu"]

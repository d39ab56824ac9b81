"""VTK's own messages, which show the words of a file as they stand."""

import logging
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def silent() -> Iterator[Callable[[], bool]]:
    """VTK prints nothing of damaged files: what is wrong is told by who reads them.

    Gives a function that says whether VTK has found a fault, of which it goes on with noughts.
    """
    try:
        from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
    except ImportError:  # told by who needs it
        yield lambda: False
        return
    said = vtkStringOutputWindow()
    before, log = vtkOutputWindow.GetInstance(), vtkLogger.GetCurrentVerbosityCutoff()
    told = logging.root.manager.disable
    logging.disable()  # pyvista logs what VTK says
    vtkOutputWindow.SetInstance(said)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        with warnings.catch_warnings(action="ignore"):  # pyvista warns of what VTK's readers say
            yield lambda: "ERROR: " in said.GetOutput() or "Error reading" in said.GetOutput()
    finally:
        logging.disable(told)
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(log)

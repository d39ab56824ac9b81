"""Where modules are searched: not in the working folder, which is a deck's and may be a stranger's.

`python -m ssilang...` puts that folder first; `python -P -m ssilang...` and the command do not.
"""

import os
import sys

_PACKAGE = os.path.dirname(os.path.realpath(__file__))


def leave_working_folder_out() -> None:
    """Take the folder away that `-m` has put first, unless the package itself stands there."""
    name = os.path.basename(_PACKAGE)
    named = any(w.removeprefix("-m").partition(".")[0] == name for w in sys.orig_argv)
    started = named and sys.argv[:1] == ["-m"] and not sys.flags.safe_path
    if started and os.path.realpath(sys.path[0]) != os.path.dirname(_PACKAGE):
        del sys.path[0]


leave_working_folder_out()

"""Jumps out of the running statement: FIN, QUIT and ITER of loops, QUIT of a procedure."""


class StopRun(Exception):
    """FIN: the run ends."""


class Jump(Exception):
    """Out of what is called so."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


class LeaveLoop(Jump):
    """QUIT name."""


class NextTurn(Jump):
    """ITER name."""


class LeaveProcedure(Jump):
    """QUIT procedure: control goes to FINP, whose results are returned."""

"""Jumps out of the running statement: FIN, QUIT and ITER of loops, QUIT of a procedure."""


class StopRun(Exception):
    """FIN: the run ends."""


class LeaveLoop(Exception):
    """QUIT name."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


class NextTurn(Exception):
    """ITER name."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


class LeaveProcedure(Exception):
    """QUIT procedure: control goes to FINP, whose results are returned."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

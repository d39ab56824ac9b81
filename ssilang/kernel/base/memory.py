"""How much memory a process may still take."""

from pathlib import Path

SHARE = 0.8  # of what is free: the rest of the run needs some
_MACHINE, _GROUP = Path("/proc/meminfo"), Path("/sys/fs/cgroup")


def available_bytes() -> float:
    """Free memory of the machine or of the process' control group; infinity if unknown."""
    return min(_of_machine(), _of_group())


def fits(n_bytes: float) -> bool:
    """Whether so much memory can be taken without the system ending the process."""
    return n_bytes <= SHARE * available_bytes()


def gigabytes(n_bytes: float) -> str:
    """'12.3 GB'."""
    return f"{n_bytes / 1e9:.3g} GB"


def _of_machine() -> float:
    try:
        lines = _MACHINE.read_text().splitlines()
    except OSError:
        return float("inf")
    found = [line.split()[1] for line in lines if line.startswith("MemAvailable:")]
    return 1024.0 * float(found[0]) if found else float("inf")


def _of_group() -> float:
    try:
        limit, used = ((_GROUP / name).read_text() for name in ("memory.max", "memory.current"))
        return float(limit) - float(used)
    except (OSError, ValueError):  # no group, or no limit ('max')
        return float("inf")

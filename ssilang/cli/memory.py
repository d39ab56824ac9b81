"""A bound on the memory of a run (`--max-memory`)."""

from __future__ import annotations


def limit_memory(megabytes: int) -> None:
    """Let the process hold at most so much; past it, operators fail with 'memory'.

    Only where the system can (POSIX); elsewhere nothing happens.
    """
    try:
        import resource
    except ImportError:
        return
    size = megabytes * 1024 * 1024
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (size, hard))

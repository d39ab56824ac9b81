"""`python -P -m ssilang.jupyter install` tells Jupyter of the kernel; without a word: be it."""

import argparse
import json
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError
from ssilang.messages.message import sentence, teller

LANGUAGE = "SSILANG_LANGUAGE"
"""Of the kernel's environment: the language of its messages."""
NAME = "gibiane"


def main(arguments: Sequence[str] | None = None) -> int:
    """Install the kernel, or run it for Jupyter; returns the exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        if words[:1] in (["install"], ["-h"], ["--help"]):
            return _install(words)
        from ipykernel.kernelapp import IPKernelApp

        from ssilang.jupyter.kernel import GibianeKernel

        IPKernelApp.launch_instance(argv=words, kernel_class=GibianeKernel, ignore_cwd=True)
    except ModuleNotFoundError as missing:
        if str(missing.name).partition(".")[0] not in ("ipykernel", "jupyter_client"):
            raise
        sys.stderr.write(render(SsiError("jupyter.extra", None)) + "\n")
        return 2
    return 0


def _install(words: list[str]) -> int:
    language = words[words.index("--lang") + 1] if "--lang" in words[:-1] else "en"
    told = teller(language if language in ("en", "fr") else "en")
    parser = argparse.ArgumentParser(
        "python -P -m ssilang.jupyter", description=told("jupyter.usage")
    )
    parser.add_argument("command", choices=["install"])
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--sys-prefix", action="store_true", help=told("jupyter.usage-sys-prefix"))
    where.add_argument("--prefix", help=told("jupyter.usage-prefix"))
    parser.add_argument("--lang", choices=["en", "fr"], default="en", help=told("cli.usage-lang"))
    options = parser.parse_args(words)
    prefix = sys.prefix if options.sys_prefix else options.prefix
    place = install(prefix, options.lang)
    sys.stdout.write(sentence("jupyter.installed", {"place": place}, options.lang) + "\n")
    return 0


def install(prefix: str | None = None, language: str = "en") -> Path:
    """Write what Jupyter reads of the kernel; returns its folder.

    Parameters
    ----------
    prefix : str, optional
        An environment; without it the user's own folder.
    language : 'en' or 'fr'
        Of messages.
    """
    from jupyter_client.kernelspec import KernelSpecManager

    spec = {
        "argv": [sys.executable, "-P", "-m", "ssilang.jupyter", "-f", "{connection_file}"],
        "display_name": "Gibiane (ssilang)",
        "language": "gibiane",
        "interrupt_mode": "signal",
        "env": {LANGUAGE: language},
    }
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "kernel.json").write_text(json.dumps(spec, indent=1), encoding="utf-8")
        manager = KernelSpecManager()
        return Path(manager.install_kernel_spec(folder, NAME, user=prefix is None, prefix=prefix))


if __name__ == "__main__":
    sys.exit(main())

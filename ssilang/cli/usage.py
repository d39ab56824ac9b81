"""What the command line accepts, and its help in the language asked for.

Helps are codes of the catalogue, which is loaded only where one is told.
"""

import argparse
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

from ssilang import __version__
from ssilang.messages.message import Teller, teller

COMMANDS = (
    "run", "report", "new", "check", "format", "help", "sweep", "warm", "repl", "view", "lsp",
    "completion", "version",
)  # fmt: skip
LANGUAGES = ("en", "fr")
SHELLS = ("bash", "zsh", "fish", "words")
REPORTS = ("text", "json", "github")

_HEADINGS = {
    "positional arguments": "cli.usage-positional",
    "options": "cli.usage-options",
}
_MISTAKES = {
    r"the following arguments are required: (?P<names>.*)": "cli.usage-required",
    r"unrecognized arguments: (?P<names>.*)": "cli.usage-unrecognized",
    r"argument (?P<name>.*?): invalid choice: (?P<value>'.*?') \(choose from (?P<choices>.*)\)": (
        "cli.usage-invalid-choice"
    ),
    r"argument (?P<name>.*?): invalid int value: (?P<value>'.*')": "cli.usage-invalid-int",
    r"argument (?P<name>.*?): (?P<value>\S+) is below (?P<least>.*)": "cli.usage-below",
    r"argument (?P<name>.*?): expected one argument": "cli.usage-expected-one",
    r"argument (?P<name>.*?): ignored explicit argument (?P<value>'.*')": "cli.usage-ignored",
    r"ambiguous option: (?P<name>.*?) could match (?P<choices>.*)": "cli.usage-ambiguous",
}
"""How argparse words what is wrong; what else it may say stands as it is."""

LEAST_MEMORY = 128
"""MB: in less the libraries themselves end in C, 115 with two threads of BLAS."""


class _Formatter(argparse.HelpFormatter):
    """Lays help out as argparse does, in the words of the catalogue."""

    def __init__(self, prog: str, told: Teller) -> None:
        super().__init__(prog)
        self._told = told

    def start_section(self, heading: str | None) -> None:
        code = _HEADINGS.get(heading or "")
        super().start_section(self._told(code) if code else heading)

    def add_text(self, text: str | None) -> None:
        is_code = (text or "").startswith("cli.")  # not so the version
        super().add_text(self._told(text) if text and is_code else text)

    def add_usage(
        self,
        usage: str | None,
        actions: Iterable[argparse.Action],
        groups: Iterable[Any],
        prefix: str | None = None,
    ) -> None:
        prefix = self._told("cli.usage") if prefix is None else prefix
        super().add_usage(usage, actions, groups, prefix)

    def _get_help_string(self, action: argparse.Action) -> str | None:
        return self._told(action.help) if action.help else action.help


def _from(least: int) -> Callable[[str], int]:
    """Reads integers that are not below a bound."""

    def read(word: str) -> int:
        if (value := int(word)) < least:
            raise argparse.ArgumentTypeError(f"{value} is below {least}")
        return value

    read.__name__ = "int"  # what argparse says of words that are no integers
    return read


class Parser(argparse.ArgumentParser):
    """A parser of the command line whose helps are codes."""

    def __init__(self, told: Teller, **options: Any) -> None:
        super().__init__(formatter_class=partial(_Formatter, told=told), add_help=False, **options)
        self._told = told
        self.add_argument("-h", "--help", action="help", help="cli.usage-help")

    def _check_help(self, action: argparse.Action) -> None:
        """Nothing: since Python 3.14 each argument's help would be worded as it is added."""

    def error(self, message: str) -> NoReturn:
        """Say how the command is used and what is wrong; the exit code is 2."""
        self.print_usage(sys.stderr)
        for pattern, code in _MISTAKES.items():
            if (found := re.fullmatch(pattern, message)) is not None:
                message = self._told(code, **found.groupdict())
                break
        self.exit(2, self._told("cli.usage-error", program=self.prog, problem=message) + "\n")

    def refuse(self, code: str) -> NoReturn:
        """The same for what the parser itself does not refuse."""
        self.error(self._told(code))


def parser(words: Sequence[str]) -> Parser:
    """The parser, which speaks the language that the arguments ask for."""
    told = teller(_language(words))
    made = Parser(told, prog="ssilang", description="cli.usage-program", epilog="cli.usage-short")
    made.add_argument(
        "--version",
        action="version",
        version=f"ssilang {__version__}",
        help="cli.usage-version-option",
    )
    commands = made.add_subparsers(dest="command", metavar=f"{{{','.join(COMMANDS)}}}")
    command = partial(commands.add_parser, told=told)
    _run(command("run", help="cli.usage-run"))
    report = command("report", help="cli.usage-report", epilog="cli.usage-report-example")
    report.add_argument("folder", type=Path, metavar="DIR", help="cli.usage-report-folder")
    _language_argument(report)
    new = command("new", help="cli.usage-new")
    new.add_argument("name", nargs="?", default="", help="cli.usage-new-name")
    new.add_argument("file", nargs="?", type=Path, help="cli.usage-new-file")
    _language_argument(new)
    check = command("check", help="cli.usage-check")
    check.add_argument("files", nargs="+", help="cli.usage-files")
    check.add_argument("--syntax-only", action="store_true", help="cli.usage-syntax-only")
    check.add_argument("--format", choices=REPORTS, default="text", help="cli.usage-check-format")
    _language_argument(check)
    layout = command("format", help="cli.usage-format")
    layout.add_argument("files", nargs="+", help="cli.usage-format-files")
    layout.add_argument("--check", action="store_true", help="cli.usage-format-check")
    layout.add_argument("--diff", action="store_true", help="cli.usage-format-diff")
    _language_argument(layout)
    helper = command("help", help="cli.usage-help-of")
    helper.add_argument("word", nargs="*", help="cli.usage-word")
    _language_argument(helper)
    _sweep(command("sweep", help="cli.usage-sweep"))
    _warm(command("warm", help="cli.usage-warm", epilog="cli.usage-warm-example"))
    _session_arguments(command("repl", help="cli.usage-repl"))
    _view(command("view", help="cli.usage-view"))
    _language_argument(command("lsp", help="cli.usage-lsp"))
    shell = command("completion", help="cli.usage-completion")
    shell.add_argument("shell", choices=SHELLS, help="cli.usage-shell")
    command("version", help="cli.usage-version")
    return made


def _language(words: Sequence[str]) -> str:
    """The language of messages, which the parser needs before it reads."""
    asked = "en"
    for word, following in zip(words, [*words[1:], ""], strict=False):
        option, sign, value = word.partition("=")
        if option == "--lang":
            asked = value if sign else following
    return asked if asked in LANGUAGES else "en"


def _run(run: argparse.ArgumentParser) -> None:
    run.add_argument("file", nargs="?", help="cli.usage-file")
    _session_arguments(run)
    run.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="cli.usage-set-one"
    )
    run.add_argument("--resume", action="store_true", help="cli.usage-resume")
    run.add_argument("--report", action="store_true", help="cli.usage-report-option")
    run.add_argument("-i", "--interactive", action="store_true", help="cli.usage-interactive")


def _sweep(sweep: argparse.ArgumentParser) -> None:
    sweep.add_argument("file", type=Path, help="cli.usage-file-alone")
    sweep.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUES", help="cli.usage-set-many"
    )
    sweep.add_argument("--motions", type=Path, metavar="DIR", help="cli.usage-motions")
    sweep.add_argument("--out", type=Path, help="cli.usage-out-sweep")
    sweep.add_argument("--jobs", type=_from(0), default=0, help="cli.usage-jobs")
    sweep.add_argument("--scheduler", default="", help="cli.usage-scheduler")
    sweep.add_argument("--report", action="store_true", help="cli.usage-report-sweep")
    sweep.add_argument(
        "--fragility", action="append", default=[], metavar="NAME>VALUE", help="cli.usage-fragility"
    )
    sweep.add_argument(
        "--intensity", action="append", default=[], metavar="NAME", help="cli.usage-intensity"
    )
    _allowed(sweep)
    _language_argument(sweep)


def _warm(warm: argparse.ArgumentParser) -> None:
    warm.add_argument("files", nargs="*", type=Path, metavar="DECK", help="cli.usage-warm-files")
    _allowed(warm)
    _language_argument(warm)


def _view(view: argparse.ArgumentParser) -> None:
    view.add_argument("file", type=Path, help="cli.usage-view-file")
    view.add_argument("-o", "--output", type=Path, metavar="FILE", help="cli.usage-view-output")
    view.add_argument("--field", default="", metavar="NAME[:PART]", help="cli.usage-view-field")
    view.add_argument("--step", type=int, metavar="N", help="cli.usage-view-step")
    view.add_argument("--scale", type=float, metavar="X", help="cli.usage-view-scale")
    _language_argument(view)


def _session_arguments(to: argparse.ArgumentParser) -> None:
    to.add_argument("--out", type=Path, help="cli.usage-out")
    _allowed(to)
    _language_argument(to)
    to.add_argument("-v", "--verbose", action="store_true", help="cli.usage-verbose")
    to.add_argument("-q", "--quiet", action="store_true", help="cli.usage-quiet")
    to.add_argument("--debug", action="store_true", help="cli.usage-debug")
    to.add_argument("--max-recursion", type=_from(1), default=200, help="cli.usage-max-recursion")
    to.add_argument("--max-statements", type=_from(1), help="cli.usage-max-statements")
    to.add_argument("--petsc", metavar="COMMAND", help="cli.usage-petsc")
    to.add_argument(
        "--max-memory", type=_from(LEAST_MEMORY), metavar="MB", help="cli.usage-max-memory"
    )


def _allowed(to: argparse.ArgumentParser) -> None:
    to.add_argument("--allow", type=Path, action="append", default=[], help="cli.usage-allow")
    to.add_argument("--allow-geo", action="store_true", help="cli.usage-allow-geo")


def _language_argument(to: argparse.ArgumentParser) -> None:
    to.add_argument("--lang", choices=LANGUAGES, default="en", help="cli.usage-lang")

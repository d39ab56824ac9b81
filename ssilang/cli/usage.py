"""What the command line accepts, and its help in the language asked for.

Helps are codes of the catalogue, which is loaded only where one is told.
"""

import argparse
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

from ssilang import __version__
from ssilang.messages.message import Teller, teller
from ssilang.remembered import tables_of

_TABLES: dict[str, Any] = tables_of(Path(__file__).with_suffix(".toml"))
COMMANDS = tuple(_TABLES["commands"])

LEAST_MEMORY = 128
"""MB: in less the libraries themselves end in C, 115 with two threads of BLAS."""


class _Formatter(argparse.HelpFormatter):
    """Lays help out as argparse does, in the words of the catalogue."""

    def __init__(self, prog: str, told: Teller) -> None:
        super().__init__(prog)
        self._told = told

    def start_section(self, heading: str | None) -> None:
        code = _TABLES["headings"].get(heading)
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


_READ: dict[str, Callable[[str], Any]] = {
    "path": Path, "int": int, "float": float,
    "count": _from(0), "positive": _from(1), "memory": _from(LEAST_MEMORY),
}  # fmt: skip


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
        for pattern, code in _TABLES["mistakes"].items():
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
    for name, helps in _TABLES["commands"].items():
        _add(commands.add_parser(name, told=told, **helps), _TABLES["arguments"][name])
    return made


def _add(to: argparse.ArgumentParser, rows: Sequence[Mapping[str, Any]]) -> None:
    """Add arguments from the rows of `usage.toml`."""
    for row in rows:
        if "like" in row:
            _add(to, _TABLES["shared"][row["like"]])
            continue
        options: dict[str, Any] = dict(row)
        if "type" in row:
            options["type"] = _READ[row["type"]]
        to.add_argument(*options.pop("name").split(), **options)


def _language(words: Sequence[str]) -> str:
    """The language of messages, which the parser needs before it reads."""
    asked = "en"
    for word, following in zip(words, [*words[1:], ""], strict=False):
        option, sign, value = word.partition("=")
        if option == "--lang":
            asked = value if sign else following
    return asked if asked in ("en", "fr") else "en"

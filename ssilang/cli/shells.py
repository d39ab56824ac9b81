"""`ssilang completion`: what shells need to complete commands, options, words of help, scripts."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

from ssilang.remembered import tables_of

ENDINGS = ("ssi", "dgibi")
"""Of scripts, which are offered before other files."""

Options = dict[str, dict[str, str]]
"""Of each command, its options and what they do."""


def write_completion(shell: str, parser: argparse.ArgumentParser, out: TextIO) -> None:
    """Print the completion of a shell ('bash', 'zsh', 'fish'), or the 'words' that help knows."""
    if shell == "words":
        out.write("\n".join(known_words()) + "\n")
        return
    out.write(_SHELLS[shell](options_of(parser), commands_of(parser)))


def known_words() -> list[str]:
    """Operators, procedures and words of the vocabulary."""
    from ssilang.language import vocabulary
    from ssilang.language.run.library import standard_procedures
    from ssilang.language.say.reference import page_names
    from ssilang.operators.loader import load_operators

    load_operators()
    words = {n for kind in vocabulary.KINDS for n in vocabulary.names(kind)}
    return sorted({*page_names(standard_procedures()), *words} - {""})


def _subparsers(parser: argparse.ArgumentParser) -> argparse._SubParsersAction:  # type: ignore[type-arg]
    found = (a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    return next(found)


def commands_of(parser: argparse.ArgumentParser) -> dict[str, str]:
    """The commands, and what each does."""
    formatter = parser._get_formatter()
    return {
        str(a.metavar or a.dest): formatter._get_help_string(a) or ""
        for a in _subparsers(parser)._choices_actions
    }


def options_of(parser: argparse.ArgumentParser) -> Options:
    """The options of each command, and what each does."""
    formatter = parser._get_formatter()
    found: Options = {}
    for name, command in _subparsers(parser).choices.items():
        actions = (a for a in command._actions if a.option_strings)
        found[name] = {a.option_strings[-1]: formatter._get_help_string(a) or "" for a in actions}
    return found


# ---- the shells ---------------------------------------------------------------------------------


def _bash(options: Options, commands: dict[str, str]) -> str:
    cases = "\n".join(f'    {name}) options="{" ".join(o)}" ;;' for name, o in options.items())
    scripts = " | ".join(f"*.{e}" for e in ENDINGS)
    return _filled("bash", cases=cases, commands=" ".join(commands), scripts=scripts)


def _zsh(options: Options, commands: dict[str, str]) -> str:
    described = "\n".join(f"    {_quoted(f'{n}:{_plain(h)}')}" for n, h in commands.items())
    told = {n: (_quoted(f"{o}[{_plain(h)}]") for o, h in own.items()) for n, own in options.items()}
    cases = "\n".join(f"    {name}) options=({' '.join(all_)}) ;;" for name, all_ in told.items())
    return _filled("zsh", cases=cases, commands=described, endings="|".join(ENDINGS))


def _filled(shell: str, **parts: str) -> str:
    text: str = tables_of(Path(__file__).with_suffix(".toml"))[shell]
    for name, part in parts.items():
        text = text.replace(f"@{name}@", part)
    return text


def _fish(options: Options, commands: dict[str, str]) -> str:
    lines = ["# ssilang completion fish > ~/.config/fish/completions/ssilang.fish"]
    first = "__fish_is_first_arg"
    for name, said in commands.items():
        lines.append(f"complete -c ssilang -n {first} -a {name} -d {_quoted(_plain(said))}")
    suffixes = "; ".join(f"__fish_complete_suffix .{e}" for e in ENDINGS)
    lines.append(f"complete -c ssilang -f -a {_quoted(f'({suffixes})')}")
    words = _quoted("(ssilang completion words)")
    lines.append(f"complete -c ssilang -n '__fish_seen_subcommand_from help' -f -a {words}")
    for name, own in options.items():
        for option, said in own.items():
            flag = f"-l {option[2:]}" if option.startswith("--") else f"-s {option[1:]}"
            when = _quoted(f"__fish_seen_subcommand_from {name}")
            lines.append(f"complete -c ssilang -n {when} {flag} -d {_quoted(_plain(said))}")
    return "\n".join(lines) + "\n"


def _plain(text: str) -> str:
    """A help on one line, without the signs that separate in zsh's lists."""
    return "".join(" " if c in "[]:\n" else c for c in text)


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"


_SHELLS: dict[str, Callable[[Options, dict[str, str]], str]] = {
    "bash": _bash,
    "zsh": _zsh,
    "fish": _fish,
}

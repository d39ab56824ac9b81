"""`ssilang completion`: what shells need to complete commands, options, words of help, scripts."""

import argparse
from collections.abc import Callable
from typing import TextIO

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
    return f"""\
# ssilang completion bash > ~/.local/share/bash-completion/completions/ssilang
_ssilang() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" command="${{COMP_WORDS[1]}}" options=""
  case "$command" in
{cases}
  esac
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{" ".join(commands)}" -- "$current"))
  elif [ "$command" = help ] && [ "${{current#-}}" = "$current" ]; then
    COMPREPLY=($(compgen -W "$(ssilang completion words)" -- "${{current^^}}"))
    return
  fi
  if [ "${{current#-}}" != "$current" ]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
    return
  fi
  local file
  while IFS= read -r file; do
    case "$file" in {" | ".join(f"*.{e}" for e in ENDINGS)}) COMPREPLY+=("$file") ;;
      *) [ -d "$file" ] && COMPREPLY+=("$file/") ;;
    esac
  done < <(compgen -f -- "$current")
}}
complete -o nospace -F _ssilang ssilang
"""


def _zsh(options: Options, commands: dict[str, str]) -> str:
    described = "\n".join(f"    {_quoted(f'{n}:{_plain(h)}')}" for n, h in commands.items())
    told = {n: (_quoted(f"{o}[{_plain(h)}]") for o, h in own.items()) for n, own in options.items()}
    cases = "\n".join(f"    {name}) options=({' '.join(all_)}) ;;" for name, all_ in told.items())
    return f"""\
#compdef ssilang
# ssilang completion zsh > a folder of $fpath, as _ssilang
_ssilang() {{
  local -a commands options
  commands=(
{described}
  )
  local scripts='*.({"|".join(ENDINGS)})'
  if (( CURRENT == 2 )); then
    _describe command commands
    _files -g "$scripts"
    return
  fi
  case "$words[2]" in
{cases}
  esac
  if [[ "$words[2]" == help && "$PREFIX" != -* ]]; then
    compadd -M 'm:{{a-z}}={{A-Z}}' -- ${{(f)"$(ssilang completion words)"}}
  else
    _arguments -s $options "*:file:_files -g \\"$scripts\\""
  fi
}}
_ssilang "$@"
"""


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

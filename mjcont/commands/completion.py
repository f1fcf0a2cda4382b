"""Scripts with which bash, zsh and fish complete mjcont's commands, made from the parser itself."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class _Option:
    """An option: its words, what it is for, its choices, and whether a value follows."""

    words: tuple[str, ...]
    text: str
    choices: tuple[str, ...]
    valued: bool


@dataclass(frozen=True, slots=True)
class _Command:
    """A command: what it does, its options, and the names that its arguments may have beside those of files."""

    name: str
    text: str
    options: tuple[_Option, ...]
    names: tuple[str, ...]


def script(shell: str, parser: argparse.ArgumentParser, names: Mapping[str, Sequence[str]]) -> str:
    """Return the script for a shell; `names` are those that arguments may have, by the arguments' own names."""
    return _SHELLS[shell](_commands(parser, names))


def _commands(parser: argparse.ArgumentParser, names: Mapping[str, Sequence[str]]) -> list[_Command]:
    (tree,) = (a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    texts = {a.dest: a.help or "" for a in tree._choices_actions}
    found = []
    for name, own in tree.choices.items():
        options = tuple(
            _Option(tuple(a.option_strings), a.help or "", tuple(map(str, a.choices or ())), a.nargs != 0)
            for a in own._actions if a.option_strings
        )
        plain = [a for a in own._actions if not a.option_strings]
        known = [n for a in plain for n in (*names.get(a.dest, ()), *map(str, a.choices or ()))]
        found.append(_Command(name, texts.get(name, ""), options, tuple(known)))
    return found


def _bash(commands: Sequence[_Command]) -> str:
    values, words = [], []
    for c in commands:
        for o in c.options:
            if o.valued:
                pattern = "|".join(f"{c.name}:{w}" for w in o.words)
                listed = f'COMPREPLY=($(compgen -W {shlex.quote(" ".join(o.choices))} -- "$cur"))' if o.choices else ":"
                values.append(f"    {pattern}) {listed}; return ;;")
        flags = " ".join(w for o in c.options for w in o.words)
        words.append(f"    {c.name}) flags={shlex.quote(flags)}; names={shlex.quote(' '.join(c.names))} ;;")
    return "\n".join([
        "# completion of mjcont for bash: in ~/.bashrc, eval \"$(mjcont completion bash)\"",
        "_mjcont() {",
        '  local cur="${COMP_WORDS[COMP_CWORD]}" prev="${COMP_WORDS[COMP_CWORD-1]}" flags= names=',
        "  COMPREPLY=()",
        "  if ((COMP_CWORD == 1)); then",
        f"    COMPREPLY=($(compgen -W {shlex.quote(' '.join(c.name for c in commands))} -- \"$cur\"))",
        "    return",
        "  fi",
        '  case "${COMP_WORDS[1]}:$prev" in',
        *values,
        "  esac",
        '  case "${COMP_WORDS[1]}" in',
        *words,
        "  esac",
        '  if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W "$flags" -- "$cur")); return; fi',
        '  COMPREPLY=($(compgen -W "$names" -- "$cur") $(compgen -f -- "$cur"))',
        "}",
        "complete -o filenames -o default -F _mjcont mjcont",
    ])


def _zsh(commands: Sequence[_Command]) -> str:
    lines = [
        "#compdef mjcont",
        "# completion of mjcont for zsh: eval \"$(mjcont completion zsh)\" after compinit in ~/.zshrc, or as _mjcont",
        "_mjcont() {",
        "  if ((CURRENT == 2)); then",
        "    local -a commands=(",
        *(f"      {shlex.quote(c.name + ':' + c.text.replace(':', ' '))}" for c in commands),
        "    )",
        "    _describe command commands",
        "    return",
        "  fi",
        "  case $words[2]:$words[CURRENT-1] in",
    ]
    for c in commands:
        for o in c.options:
            if o.valued:
                pattern = "|".join(f"{c.name}:{w}" for w in o.words)
                listed = f"compadd -- {' '.join(map(shlex.quote, o.choices))}" if o.choices else "_files"
                lines.append(f"    ({pattern}) {listed}; return ;;")
    lines += ["  esac", "  local -a flags names", "  case $words[2] in"]
    for c in commands:
        flags = [shlex.quote(f"{w}:{o.text}") for o in c.options for w in o.words]
        lines.append(f"    {c.name}) flags=({' '.join(flags)}); names=({' '.join(map(shlex.quote, c.names))}) ;;")
    return "\n".join([
        *lines,
        "  esac",
        "  if [[ $words[CURRENT] == -* ]]; then _describe option flags; return; fi",
        "  compadd -a names",
        "  _files",
        "}",
        'if [[ $funcstack[1] == _mjcont ]]; then _mjcont "$@"; else compdef _mjcont mjcont; fi',
    ])


def _fish(commands: Sequence[_Command]) -> str:
    lines = ["# completion of mjcont for fish: mjcont completion fish > ~/.config/fish/completions/mjcont.fish"]
    lines += [f"complete -c mjcont -f -n __fish_use_subcommand -a {c.name} -d {_quoted(c.text)}" for c in commands]
    for c in commands:
        here = f"complete -c mjcont -n '__fish_seen_subcommand_from {c.name}'"
        lines += [f"{here} -a {_quoted(' '.join(c.names))}"] if c.names else []
        for o in c.options:
            forms = " ".join(f"-l {w[2:]}" if w.startswith("--") else f"-s {w[1:]}" for w in o.words)
            value = f" -x -a {_quoted(' '.join(o.choices))}" if o.choices else " -r" if o.valued else ""
            lines.append(f"{here} {forms}{value} -d {_quoted(o.text)}")
    return "\n".join(lines)


def _quoted(text: str) -> str:
    """Return a word as fish reads it."""
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


_SHELLS = {"bash": _bash, "zsh": _zsh, "fish": _fish}
SHELLS = tuple(_SHELLS)

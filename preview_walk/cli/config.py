"""Options in a TOML file: what a run was made of, and the same run again."""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from typing import Any

from preview_walk.cli.option_table import FLAGS, OPTIONS
from preview_walk.errors import InvalidInput
from preview_walk.files import read_toml

NOT_KEPT = (
    *("--out", "--config", "--json", "--quiet", "--view", "--web", "--port"),
    *("--inspect", "--list-robots"),
)
"""Options that a file neither keeps nor gives: they say how a walk is shown, or make none."""


def with_config(arguments: list[str], parser: argparse.ArgumentParser) -> list[str]:
    """Return a command line with the options of its `--config` file before those typed.

    A later option counts, but for those that may be repeated, which add up.

    Args:
        arguments: as typed.
        parser: complains about a file that cannot be read, and ends the command.
    """
    finder = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    finder.add_argument("--config", nargs="?")
    path = finder.parse_known_args(arguments)[0].config
    if path is None:
        return arguments
    try:
        return [*_words(read_toml(path)), *arguments]
    except InvalidInput as error:
        parser.error(f"--config: {error}")


def config_text(found: Mapping[str, Any]) -> str:
    """Return the options of a parsed command line as TOML, those that were given alone.

    Args:
        found: values by the options' names, as argparse has them.
    """
    lines = ["# preview-walk --config FILE does this walk again."]
    for option in OPTIONS:
        value = found[_key(option.name)]
        if option.name in NOT_KEPT or value is None or value == [] or value == option.default:
            continue
        shown: Any = value if isinstance(value, int | float) else _text(value)
        if option.repeated:
            shown = [_text(item) for item in value]
        lines.append(f"{option.name[2:]} = {json.dumps(shown)}")
    flags = [name for name in FLAGS if found[_key(name)] and name not in NOT_KEPT]
    lines += [f"{name[2:]} = true" for name in flags]
    return "\n".join(lines) + "\n"


def _words(given: Mapping[str, Any]) -> list[str]:
    """Return a file's options as they would be typed, velocities and durations in turn."""
    names = {option.name[2:]: option for option in OPTIONS if option.name not in NOT_KEPT}
    flags = {name[2:] for name in FLAGS if name not in NOT_KEPT}
    words: list[tuple[int, str]] = []
    for name, value in given.items():
        if name in flags and isinstance(value, bool):
            words += [(0, f"--{name}")] if value else []
            continue
        if name not in names or isinstance(value, dict | bool):
            known = ", ".join(sorted([*names, *flags]))
            raise InvalidInput(f"a file of options must have the keys {known}; got '{name}'.")
        several = names[name].repeated and isinstance(value, list) and _is_list_of_values(value)
        for number, item in enumerate(value if several else [value]):
            words.append((number, f"--{name}={_text(item)}"))
    return [word for _, word in sorted(words, key=lambda pair: pair[0])]


def _is_list_of_values(value: list[Any]) -> bool:
    """Tell several values of a repeated option from the numbers of one."""
    return all(isinstance(item, str | list) for item in value) or len(value) == 1


def _text(value: Any) -> str:
    """Return a value as an option's text."""
    if isinstance(value, Mapping):
        return ",".join(f"{name}={_text(item)}" for name, item in value.items())
    if isinstance(value, list | tuple):
        return ",".join(map(_text, value))
    return str(value)


def _key(name: str) -> str:
    return name[2:].replace("-", "_")

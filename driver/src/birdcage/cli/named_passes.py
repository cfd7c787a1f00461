"""Which satellites' passes are asked for, by a name."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.paths import Paths
    from birdcage.sky.watch_source import Watched

SILENT_TOLD = 3
"""How many silent satellites are told of one by one."""


def one_satellite(watched: Watched, words: Iterable[str], paths: Paths, file: Path | None) -> Watched:
    """Return the one satellite that is named, and say if it is silent.

    click.UsageError where none is meant alone, or what is meant does not pass.
    """
    import click

    from birdcage.cli.named_target import find_target
    from birdcage.cli.say import say
    from birdcage.sky.targets.model import Satellite

    words = tuple(words)
    target = find_target(words, paths, file, _silently, note=say).target
    if not isinstance(target, Satellite):
        text = " ".join(words)
        raise click.UsageError(f"{target.name} makes no passes: `birdcage where {text}` tells where it stands.")
    return watched.chosen(lambda one: one == target.elements)


def with_name(watched: Watched, name: str, paths: Paths, file: Path | None) -> Watched:
    """Return the satellites with this in one of their names, or with this number, and say which are silent.

    ConfigError with a sentence if there is none.
    """
    from birdcage.base.errors import ConfigError
    from birdcage.cli.named_target import resolver_of
    from birdcage.cli.say import say

    resolver = resolver_of(paths, file, _silently)
    found = watched.chosen(resolver.matcher(name))
    if not found.elements:
        raise ConfigError(resolver.resolve(name).problem or f"No satellite has {name!r} in one of its names.")
    silent = [words for one in found.elements if (words := resolver.silence_words(one.norad_id, one.name))]
    for words in silent[:SILENT_TOLD]:
        say(words)
    if len(silent) > SILENT_TOLD:
        say(f"{len(silent) - SILENT_TOLD} more of them are silent: `birdcage downlinks --all` tells which.")
    return found


def _silently(_words: str) -> None:
    """What is wrong with the elements was told when they were read."""

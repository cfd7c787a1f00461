"""The target that a person names on the command line, and what to say of it."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Sequence
from datetime import datetime
from functools import cached_property
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import CatalogueEntry, SearchIndex
    from birdcage.sky.downlinks import Downlink, Downlinks
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Resolution, Resolver, Target

TEXT_WIDTH = 72


class _Shelf:
    """The satellites of a command: read only for what is none of the other kinds."""

    def __init__(self, paths: Paths, file: Path | None, tell: Callable[[str], None]) -> None:
        self._paths, self._file, self._tell = paths, file, tell

    @cached_property
    def _index(self) -> SearchIndex:
        from birdcage.cli.known_satellites import known_satellites
        from birdcage.sky.catalogue import SearchIndex

        return SearchIndex(known_satellites(self._paths, self._file, self._tell))

    def __len__(self) -> int:
        return len(self._index)

    def search(self, text: str, limit: int) -> Sequence[CatalogueEntry]:
        return self._index.search(text, limit)

    def names(self) -> Sequence[str]:
        return self._index.names()


def resolver_of(paths: Paths, file: Path | None, tell: Callable[[str], None]) -> Resolver:
    """Return what reads names here: with the satellites of `file` or the catalogue, and the user's own downlinks.

    `tell` gets what is wrong with the satellites' file.
    """
    from birdcage.sky.downlinks_read import load_downlinks
    from birdcage.sky.targets import Resolver

    return Resolver(_Shelf(paths, file, tell), load_downlinks(paths.downlinks_file))


def find_target(
    words: Iterable[str], paths: Paths, file: Path | None, tell: Callable[[str], None],
    note: Callable[[str], None] | None = None,
) -> Resolution:  # fmt: skip
    """Return the target that is meant. click.UsageError with a sentence when no single one is.

    `tell` gets what is known against it: damaged lines of the file, that its elements are frozen, and, unless `note`
    takes that, that it is silent.
    """
    from birdcage.cli.known_satellites import frozen_warning
    from birdcage.sky.targets.model import Satellite

    found = resolver_of(paths, file, tell).resolve(" ".join(words))
    if found.found is None:
        raise click.UsageError(textwrap.fill(found.problem, TEXT_WIDTH))
    if found.note:
        (note or tell)(found.note)
    target = found.target
    warning = frozen_warning([target.elements] if isinstance(target, Satellite) else [])
    if warning is not None:
        tell(warning)
    return found


def sender_of(
    words: Iterable[str], paths: Paths, downlinks: Downlinks
) -> tuple[str, tuple[Downlink, ...], str]:  # fmt: skip
    """Return the name of a target, what it sends, and a note; it need not be in the catalogue.

    click.UsageError with a sentence when no single one is meant.
    """
    from birdcage.sky.targets import Resolver
    from birdcage.sky.targets.model import Satellite, SlotTarget

    text = " ".join(words)
    resolver = Resolver(_Shelf(paths, None, lambda _words: None), downlinks)
    found = resolver.resolve(text)
    if found.found is None:
        sender = resolver.sender(text)
        if sender is None:
            raise click.UsageError(textwrap.fill(found.problem, TEXT_WIDTH))
        note = "" if sender.silence is None else sender.silence.words(sender.name)
        return sender.name, downlinks.of(sender.norad_id, sender.name), note
    target = found.target
    rows: tuple[Downlink, ...] = ()
    if isinstance(target, Satellite):
        rows = downlinks.of(target.elements.norad_id, target.elements.name)
    elif isinstance(target, SlotTarget):
        rows = downlinks.at(target.slot.longitude_deg)
    return target.name, rows, found.note


def tell_below(target: Target, observer: Observer, when: datetime, tell: Callable[[str], None]) -> None:
    """Say that a target is below the horizon, and when it rises; nothing for one that is up."""
    from birdcage.sky.targets.sight import below_words

    words = below_words(target, observer, when)
    if words:
        tell(words)

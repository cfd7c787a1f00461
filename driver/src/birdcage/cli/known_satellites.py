"""The satellites that a command can look up: of a file, of the catalogue, or the few that ship with birdcage."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.watch_source import Watched


def known_satellites(paths: Paths, file: Path | None, tell: Callable[[str], None]) -> tuple[CatalogueEntry, ...]:
    """Return the satellites of `--elements`, else of the catalogue, else those that ship with birdcage.

    `tell` gets a sentence about every damaged line. No file is made. ConfigError for a file without elements,
    StoreError when the catalogue can't be read.
    """
    from birdcage.base.errors import ConfigError
    from birdcage.sky.formats import read_path
    from birdcage.sky.frozen import frozen
    from birdcage.sky.watch_source import read_entries

    if file is None:
        return read_entries(paths.catalogue) or _entries(frozen())
    harvest = read_path(file)
    for complaint in harvest.complaints:
        tell(str(complaint))
    if not harvest.elements:
        raise ConfigError(f"{file} holds no elements that could be read.")
    return _entries(harvest.elements)


def find_elements(paths: Paths, file: Path | None, tell: Callable[[str], None]) -> Watched:
    """Return the same as a search for passes takes them; `tell` also gets a warning of frozen elements."""
    from birdcage.sky.watch_source import Watched

    entries = known_satellites(paths, file, tell)
    warning = frozen_warning(entry.elements for entry in entries)
    if warning is not None:
        tell(warning)
    return Watched.of(entries, warning or "")


def frozen_warning(elements: Iterable[ElementSet]) -> str | None:
    """Return what to say when some of these elements are those that ship with birdcage; None when none is."""
    from birdcage.sky.frozen import SOURCE

    epochs = sorted(each.epoch for each in elements if each.source == SOURCE)
    if not epochs:
        return None
    dates = " to ".join(dict.fromkeys((f"{epochs[0]:%Y-%m-%d}", f"{epochs[-1]:%Y-%m-%d}")))
    return (
        f"Warning: these are the frozen elements that ship with birdcage (epoch {dates}). Do not point a dish by them. "
        "`birdcage elements update` fetches new ones."
    )


def _entries(elements: Iterable[ElementSet]) -> tuple[CatalogueEntry, ...]:
    from birdcage.sky.catalogue import CatalogueEntry

    return tuple(CatalogueEntry(each, each.epoch) for each in elements)

"""The satellites that a command can look up: of a file, of the catalogue, or the few that ship with birdcage."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import Entry
    from birdcage.sky.elements import ElementSet

FROZEN = "frozen"


@dataclass(frozen=True, slots=True)
class KnownSatellites:
    """What was found."""

    entries: tuple[Entry, ...]
    frozen: bool = False
    """They are those that ship with birdcage, as the catalogue is empty."""


def known_satellites(paths: Paths, file: Path | None, tell: Callable[[str], None]) -> KnownSatellites:
    """Return the satellites of `--elements`, else of the catalogue, else those that ship with birdcage.

    `tell` gets a sentence about every damaged line. No file is made. ConfigError for a file without elements,
    StoreError when the catalogue can't be read.
    """
    from birdcage.base.errors import ConfigError
    from birdcage.sky.catalogue import Catalogue
    from birdcage.sky.frozen import frozen

    if file is not None:
        from birdcage.sky.formats import read_path

        harvest = read_path(file)
        for complaint in harvest.complaints:
            tell(f"{complaint.source}:{complaint.line}: {complaint.why}")
        if not harvest.elements:
            raise ConfigError(f"{file} holds no elements.")
        return KnownSatellites(_entries(harvest.elements))
    if paths.catalogue.exists():
        with Catalogue(paths.catalogue) as catalogue:
            entries = catalogue.entries()
        if entries:
            return KnownSatellites(entries)
    return KnownSatellites(_entries(frozen()), frozen=True)


def frozen_warning(elements: Iterable[ElementSet]) -> str | None:
    """Return what to say when some of these elements are those that ship with birdcage; None when none is."""
    epochs = sorted(each.epoch for each in elements if each.source == FROZEN)
    if not epochs:
        return None
    dates = f"{epochs[0]:%Y-%m-%d}" if len(epochs) == 1 else f"{epochs[0]:%Y-%m-%d} to {epochs[-1]:%Y-%m-%d}"
    return (
        f"Warning: frozen elements, which ship with birdcage for a first look (epoch {dates}). Where a satellite "
        "stands now cannot be told from them: do not point a dish by them. `birdcage elements update` fetches new ones."
    )


def _entries(elements: Iterable[ElementSet]) -> tuple[Entry, ...]:
    from birdcage.sky.catalogue import Entry

    return tuple(Entry(each, each.epoch) for each in elements)

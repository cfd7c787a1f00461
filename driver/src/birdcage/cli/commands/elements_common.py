"""What the commands of `birdcage elements` have in common."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.reason import Reason
from birdcage.cli.say import iso

if TYPE_CHECKING:
    from birdcage.base.config import ElementsSettings
    from birdcage.sky.catalogue import Catalogue, CatalogueEntry
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.formats import Complaint

EMPTY = (
    "The catalogue is empty. `birdcage elements update` fetches a few groups, `birdcage elements add FILE` reads one."
)


@contextmanager
def open_catalogue() -> Iterator[Catalogue]:
    """Give the catalogue for the length of one command."""
    from birdcage.cli.options import find_paths
    from birdcage.sky.catalogue import Catalogue

    with Catalogue(find_paths().catalogue) as catalogue:
        yield catalogue


def find_entry(catalogue: Catalogue, text: str) -> CatalogueEntry:
    """Return the satellite that a person names, as every command takes names, and say if it is silent.

    BirdcageError (UnknownTarget, or reason ``no_satellite`` for what is none) with a sentence when no single one is.
    """
    from birdcage.base.errors import BirdcageError
    from birdcage.cli.options import find_paths
    from birdcage.cli.say import say
    from birdcage.sky.downlinks_read import load_downlinks
    from birdcage.sky.targets import Resolver
    from birdcage.sky.targets.model import Satellite

    resolver = Resolver(catalogue.index(), load_downlinks(find_paths().downlinks_file))
    found = resolver.resolve(text)
    target = found.target
    if not isinstance(target, Satellite):
        raise BirdcageError(f"{target.name} is not in the catalogue.", reason=Reason.NO_SATELLITE)
    if found.note:
        say(found.note)
    entry = catalogue.entry(target.elements.norad_id or target.elements.name)
    assert entry is not None, "it was found there"
    return entry


def say_ahead(elements: Sequence[ElementSet]) -> None:
    """Say which elements are dated too far in the future, if any are."""
    from birdcage.cli.say import say
    from birdcage.sky.ahead import ahead_words

    words = ahead_words(elements, datetime.now(UTC))
    if words:
        say(words)


def elements_settings() -> ElementsSettings:
    """Return `[elements]`. ConfigError where it cannot be read: somebody with a mirror does not mean other servers."""
    from birdcage.base.errors import ConfigError
    from birdcage.cli.options import find_paths, load_settings

    settings = load_settings(find_paths())
    for problem in settings.problems:
        key = (problem.key or "").lower()
        if problem.key is None or key.startswith(("elements", "birdcage_elements", "birdcage_craft")):
            raise ConfigError(f"{problem.text} No server was asked.")
    return settings.elements


def entry_values(entry: CatalogueEntry, now: datetime) -> dict[str, object]:
    """Return a satellite for JSON."""
    return {
        "name": entry.name,
        "norad_id": entry.norad_id or None,
        "epoch": iso(entry.elements.epoch),
        "age_s": round((now - entry.elements.epoch).total_seconds()),
        "fetched": iso(entry.fetched),
        "source": entry.elements.source or None,
        "groups": list(entry.groups),
        "tags": list(entry.tags),
        "favourite": entry.favourite,
        "priority": entry.priority,
        "time_offset_s": entry.time_offset_s,
        "time_offset_set": iso(entry.time_offset_set),
    }


def complaint_values(complaint: Complaint) -> dict[str, object]:
    """Return a complaint for JSON."""
    return {"source": complaint.source, "line": complaint.line or None, "why": complaint.why}


def tell_entries(entries: Sequence[CatalogueEntry], now: datetime) -> None:
    """Print satellites, one a line."""
    from birdcage.cli.table import tell_table
    from birdcage.sky.catalogue.words import age

    head = ("", "NUMBER", "NAME", "EPOCH (UTC)", "AGE", "GROUPS, TAGS", "NOTES")
    rows = [
        (
            "*" if each.favourite else "",
            str(each.norad_id or "-"),
            each.name or "-",
            f"{each.elements.epoch:%Y-%m-%d %H:%M}",
            age(each.elements.epoch, now),
            " ".join((*each.groups, *each.tags)) or "-",
            _notes(each),
        )
        for each in entries
    ]
    tell_table(head, rows, right=" r  r")


def _notes(entry: CatalogueEntry) -> str:
    notes = [f"priority {entry.priority}"] if entry.priority else []
    if entry.time_offset_s is not None:
        dated = f" of {entry.time_offset_set:%Y-%m-%d}" if entry.time_offset_set is not None else ""
        notes.append(f"offset {entry.time_offset_s:+g} s{dated}")
    if entry.elements.source in ("frozen", "demo"):
        notes.append({"frozen": "shipped with birdcage", "demo": "made up"}[entry.elements.source])
    return ", ".join(notes)

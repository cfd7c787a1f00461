"""What a face may ask of the station about the settings that the dish keeps itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ReadSettings:
    """Read all settings that the dish keeps itself; resolves with a `SettingsTable`.

    It also tells what became of an earlier write that no save has settled. CommandRefused (`unsupported`) where the
    dish has none; BirdcageError (`moving`) while it moves; LeaseDenied while a person has its console.
    """


@dataclass(frozen=True, slots=True)
class WriteSettings:
    """Change rows of the dish's own settings in RAM, each checked; resolves with a `SettingsWritten`.

    The whole table is backed up before the first write of this program. A power cycle takes all of it back unless
    `SaveSettings` keeps it. Nothing is sent for a row that has the value already. ConfirmationNeeded where a row is
    dangerous, or no source tells of it, unless `agreed`; OutOfRange for a value that does not fit.
    """

    changes: Mapping[int, str]
    """New values by row, as a person would give them: `18`, `on`, `0x00000007`."""
    holder: str
    agreed: bool = False
    """Whether a person was told what a wrong value does, and agreed."""


@dataclass(frozen=True, slots=True)
class SaveSettings:
    """Write all that the dish's RAM holds to its flash, and see that it did; resolves with a `SettingsTable`.

    It counts from the next power cycle on. ConfirmationNeeded, which names the rows, unless `agreed`, and where a save
    would not write what was `shown`.
    """

    holder: str
    agreed: bool = False
    """Whether a person was told what is saved, and agreed."""
    shown: Mapping[int, str] | None = None
    """What that person was shown, as `SettingsTable.to_save`: values in RAM by row; null where it is not compared."""

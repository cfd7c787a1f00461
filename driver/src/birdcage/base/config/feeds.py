"""Feeds: what hangs in the focus, one profile each, one of them active."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, Literal

from birdcage.base.config.field import Complaint, Section, setting

STOCK = "stock-ku"


@dataclass(frozen=True, slots=True)
class FeedSettings(Section):
    """`[feed]`: which of the `[feed.NAME]` tables counts."""

    section: ClassVar[str] = "feed"
    limits_motion: ClassVar[bool] = True

    active: str = setting(STOCK, "Name of the feed that is mounted.", env="BIRDCAGE_FEED")


@dataclass(frozen=True, slots=True)
class FeedProfile(Section):
    """`[feed.NAME]`: one feed. Frequencies in Hz, angles in degrees."""

    section: ClassVar[str] = "feed.NAME"
    limits_motion: ClassVar[bool] = True

    freq_min_hz: float | None = setting(None, "Lower end of the band.", minimum=1e6, maximum=1e12)
    freq_max_hz: float | None = setting(None, "Upper end of the band.", minimum=1e6, maximum=1e12)
    beam_deg: float | None = setting(None, "Width of the beam at half power.", minimum=0.01, maximum=180.0)
    lo_hz: float | None = setting(None, "Local oscillator of the converter.", minimum=0.0, maximum=1e12)
    polarization: Literal["linear", "circular"] | None = setting(None, "Kind of polarisation.")
    system_k: float = setting(
        100.0, "Noise of receiver, ground and sky together, in kelvins; 100 is an assumption.", minimum=1.0, maximum=1e5
    )
    az_offset_deg: float = setting(
        0.0, "How far the beam looks clockwise of the dish's axis.", minimum=-45.0, maximum=45.0
    )
    el_offset_deg: float = setting(0.0, "How far the beam looks above the dish's axis.", minimum=-45.0, maximum=45.0)
    stow_allowed: bool = setting(False, "Whether the dish may fold flat with this feed: false if it would be crushed.")

    @property
    def middle_hz(self) -> float | None:
        """The middle of the band; None where that is not known."""
        low, high = self.freq_min_hz, self.freq_max_hz
        return None if low is None or high is None else (low + high) / 2.0

    def complaints(self) -> Iterator[Complaint]:
        """Yield a band turned upside down."""
        if self.freq_min_hz is not None and self.freq_max_hz is not None and self.freq_min_hz >= self.freq_max_hz:
            yield "freq_min_hz", f"is {self.freq_min_hz:g}, which is not below freq_max_hz ({self.freq_max_hz:g})"


STOCK_FEED = FeedProfile(freq_min_hz=10.7e9, freq_max_hz=12.75e9, beam_deg=6.3, stow_allowed=True)
"""The Ku-band LNB that the dish was sold with. The beam was measured on a G2 (reference section 7.6)."""

BUILT_IN: Mapping[str, FeedProfile] = MappingProxyType({STOCK: STOCK_FEED})

"""Feeds that can be fitted in the focus: one profile each, one of them active."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, Literal

from birdcage.base.config.field import Complaint, Section, setting

STOCK = "stock-ku"
STOCK_LABEL = "stock Ku LNB"


def feed_label(name: str) -> str:
    """Return a feed as people call it: an owner's own by the name that he gave it, the built-in one in words."""
    return STOCK_LABEL if name == STOCK else name


@dataclass(frozen=True, slots=True)
class FeedSettings(Section):
    """`[feed]`: which of the `[feed.NAME]` tables counts."""

    section: ClassVar[str] = "feed"
    limits_motion: ClassVar[bool] = True

    active: str = setting(STOCK, "Name of the mounted feed.", env="BIRDCAGE_FEED")


@dataclass(frozen=True, slots=True)
class FeedProfile(Section):
    """`[feed.NAME]`: one feed. Frequencies in Hz, angles in degrees."""

    section: ClassVar[str] = "feed.NAME"
    limits_motion: ClassVar[bool] = True

    freq_min_hz: float | None = setting(None, "Lower end of the band.", minimum=1e6, maximum=1e12)
    freq_max_hz: float | None = setting(None, "Upper end of the band.", minimum=1e6, maximum=1e12)
    beam_deg: float | None = setting(
        None,
        "Measured width of the beam at half power, the same both ways; not set: from reflector and band.",
        minimum=0.01,
        maximum=180.0,
    )
    beam_az_deg: float | None = setting(
        None, "The same across the line of sight, where the beam is no circle.", minimum=0.01, maximum=180.0
    )
    beam_el_deg: float | None = setting(
        None, "The same in elevation, where the beam is no circle.", minimum=0.01, maximum=180.0
    )
    beam_origin: Literal["entered", "scan", "counts"] = setting(
        "entered",
        "Where that width comes from; counts: a scan in counts, which makes it an upper bound.",
    )
    lo_hz: float | None = setting(None, "Local oscillator of the converter.", minimum=0.0, maximum=1e12)
    polarization: Literal["linear", "circular"] | None = setting(None, "Kind of polarisation.")
    system_k: float = setting(
        100.0, "Noise of receiver, ground and sky together, in kelvins; 100 is an assumption.", minimum=1.0, maximum=1e5
    )
    az_offset_deg: float = setting(
        0.0, "How far the beam looks clockwise of the dish's axis.", minimum=-45.0, maximum=45.0
    )
    el_offset_deg: float = setting(0.0, "How far the beam looks above the dish's axis.", minimum=-45.0, maximum=45.0)
    signal: str = setting(
        "tuner", "Where its signal is read: tuner, rigctl, satdump, gqrx, sdrpp, rtl_tcp, rtl_power, or a signal.NAME."
    )
    stow_allowed: bool = setting(False, "Whether the dish may fold flat with this feed: false if it would be crushed.")

    @property
    def middle_hz(self) -> float | None:
        """The middle of the band; None if that is not known."""
        low, high = self.freq_min_hz, self.freq_max_hz
        return None if low is None or high is None else (low + high) / 2.0

    def complaints(self) -> Iterator[Complaint]:
        """Yield half a beam, and a band turned upside down."""
        if self.beam_deg is None and (self.beam_az_deg is None) != (self.beam_el_deg is None):
            missing = "beam_az_deg" if self.beam_az_deg is None else "beam_el_deg"
            yield missing, "is missing: a beam that is no circle needs both beam_az_deg and beam_el_deg"
        if self.freq_min_hz is not None and self.freq_max_hz is not None and self.freq_min_hz >= self.freq_max_hz:
            yield "freq_min_hz", f"is {self.freq_min_hz:g}, which is not below freq_max_hz ({self.freq_max_hz:g})"


STOCK_FEED = FeedProfile(
    freq_min_hz=12.2e9, freq_max_hz=12.7e9, lo_hz=11.25e9, polarization="circular", stow_allowed=True
)
"""The LNB that the dish was sold with: for the circular direct broadcasts of North America. Its beam is the dish's."""

BUILT_IN: Mapping[str, FeedProfile] = MappingProxyType({STOCK: STOCK_FEED})

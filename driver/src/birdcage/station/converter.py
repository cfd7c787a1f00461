"""The converter of the mounted feed: what the tuner behind it is set to, as a frequency in the sky."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.config.feeds import FeedProfile


@dataclass(frozen=True, slots=True)
class FeedConverter:
    """Mixes a signal from the sky with a local oscillator (LO); frequencies in Hz."""

    lo_hz: float
    high_side: bool = False
    """Whether the LO lies above the signal: higher in the sky is then lower behind it."""

    def rf_hz(self, if_hz: float) -> float:
        """Return the frequency in the sky (RF) of one behind the converter (IF)."""
        return self.lo_hz - if_hz if self.high_side else self.lo_hz + if_hz


def converter_of(feed: FeedProfile) -> FeedConverter | None:
    """Return the converter of a feed; None where its LO is not set. A feed without a band has it below the signal."""
    if feed.lo_hz is None:
        return None
    return FeedConverter(feed.lo_hz, feed.middle_hz is not None and feed.lo_hz > feed.middle_hz)

"""How an RTL-SDR is tuned by a person: checked, and as settings of its `[signal.NAME]`."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.signal.rtl_tcp_meter import Tuned

LOWEST_HZ, HIGHEST_HZ = 500e3, 2.2e9
"""From the lowest that the RTL2832U takes directly to the highest of any of its tuners (E4000)."""
RATES_HZ = ((225_001.0, 300_000.0), (900_001.0, 2_400_000.0))
"""What the RTL2832U samples without loss: `rtlsdr_set_sample_rate` of librtlsdr refuses what lies between."""
LEAST_CHANNEL_HZ, MOST_GAIN_DB = 1e3, 60.0
AUTOMATIC = -1.0
"""In the settings: a gain that the tuner chooses by itself."""


def checked_tuning(freq_hz: float, sample_rate_hz: float, channel_hz: float, gain_db: float | None) -> Tuned:
    """Return it; a gain of None is the tuner's own. ValueError says the number, the range and what to type."""
    if not LOWEST_HZ <= freq_hz <= HIGHEST_HZ:
        raise ValueError(f"Frequency {freq_hz / 1e6:g} MHz is out of range. Type {LOWEST_HZ / 1e6:g} to 2200")
    if not any(low <= sample_rate_hz <= high for low, high in RATES_HZ):
        raise ValueError(f"Sample rate {sample_rate_hz / 1e3:g} kHz is out of range. Type 226 to 300, or 901 to 2400")
    if not LEAST_CHANNEL_HZ <= channel_hz <= sample_rate_hz:
        most = f"{sample_rate_hz / 1e3:g}, the sample rate"
        raise ValueError(f"Channel {channel_hz / 1e3:g} kHz is out of range. Type 1 to {most}")
    if gain_db is not None and not 0.0 <= gain_db <= MOST_GAIN_DB:
        raise ValueError(f"Gain {gain_db:g} dB is out of range. Type 0 to {MOST_GAIN_DB:g}, or auto")
    return Tuned(freq_hz, sample_rate_hz, channel_hz, gain_db)


def as_settings(source: str, tuned: Tuned) -> Mapping[str, float]:
    """Return the keys of birdcage.toml that say the same."""
    return {
        f"signal.{source}.freq_hz": tuned.freq_hz,
        f"signal.{source}.sample_rate_hz": tuned.sample_rate_hz,
        f"signal.{source}.channel_hz": tuned.channel_hz,
        f"signal.{source}.gain_db": AUTOMATIC if tuned.gain_db is None else tuned.gain_db,
    }

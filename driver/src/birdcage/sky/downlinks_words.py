"""What is told of a downlink, in words and in JSON: the same on every screen and in every command."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.sky.downlinks_age import age_days, is_doubtful

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.sky.downlinks import Downlink


def baud_words(baud: float | None) -> str:
    """Return a symbol rate as `2.333 Mbaud`, `665.4 kbaud`, `600 baud`; empty if it is not known."""
    if baud is None:
        return ""
    for unit, size in (("Mbaud", 1e6), ("kbaud", 1e3)):
        if baud >= size:
            return f"{baud / size:.4g} {unit}"
    return f"{baud:.4g} baud"


def air_words(downlink: Downlink, now: datetime) -> str:
    """Return `on 2026-10-16`, `off since 2025-08-13`, `doubtful: 2019-09-25, 7 y` or `doubtful: unconfirmed`.

    `on the air` where no date is known. Empty for the user's own entry that does not say.
    """
    if downlink.alive is False:
        return f"off since {downlink.silent_since}" if downlink.silent_since else f"off {downlink.date}".rstrip()
    if not is_doubtful(downlink, now):
        return (f"on {downlink.date}" if downlink.date else "on the air") if downlink.alive else ""
    days = age_days(downlink, now)
    if downlink.alive is None or days is None:
        return "doubtful: unconfirmed"
    return f"doubtful: {downlink.date}, {days / 365.25:.0f} y"


def signal_words(downlink: Downlink) -> str:
    """Return what is sent: `AHRPT, RHCP, 2.333 Mbaud`."""
    return ", ".join(filter(None, (downlink.mode, downlink.polarization, baud_words(downlink.symbol_rate_baud))))


def satdump_words(downlink: Downlink) -> str:
    """Return SatDump's name for it, `fengyun3_d_ahrpt (recording)` for what it decodes only later; empty for none."""
    if not downlink.pipeline:
        return ""
    return downlink.pipeline if downlink.pipeline_live else f"{downlink.pipeline} (recording)"


def downlink_values(downlink: Downlink, now: datetime) -> dict[str, object]:
    """Return it for JSON; what is not known is None."""
    return {
        "satellite": downlink.satellite,
        "norad_id": downlink.norad_id or None,
        "longitude_deg": downlink.longitude_deg,
        "freq_min_hz": downlink.freq_min_hz,
        "freq_max_hz": downlink.freq_max_hz,
        "mode": downlink.mode or None,
        "polarization": downlink.polarization,
        "symbol_rate_baud": downlink.symbol_rate_baud,
        "pipeline": downlink.pipeline or None,
        "pipeline_live": downlink.pipeline_live if downlink.pipeline else None,
        "alive": downlink.alive,
        "silent_since": downlink.silent_since or None,
        "date": downlink.date or None,
        "age_days": age_days(downlink, now),
        "doubtful": is_doubtful(downlink, now),
        "source": downlink.source,
        "note": downlink.note or None,
    }

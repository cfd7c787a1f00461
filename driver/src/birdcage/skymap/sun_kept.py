"""What the Sun in a map told, in lines for a person, and kept with a feed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.beam import Beam, BeamOrigin
from birdcage.base.config.edit import Value, edit
from birdcage.skymap.sun_lesson import SUN_LEAST, SUN_MOST

if TYPE_CHECKING:
    from birdcage.base.config.feeds import FeedProfile
    from birdcage.skymap.sun_lesson import SunLesson

MOST_SIGMA = 0.1
"""A beam that is less sure than this part of its width is not kept."""
SYSTEM_K = (1.0, 1e5)
"""What the settings take."""


def lesson_lines(found: SunLesson) -> list[str]:
    """Return what was found in lines for a person."""
    widths = f"{found.az_deg:.2f}° ±{found.az_sigma_deg:.2f}° x {found.el_deg:.2f}° ±{found.el_sigma_deg:.2f}°"
    where = f"{_away(found.right_deg, 'right', 'left')} and {_away(found.up_deg, 'above', 'below')}"
    lines = [
        f"Beam   {widths} (az x el on the sky, -3 dB, without the Sun's own disc)",
        f"Sun    {found.rise_db:.2f} ±{found.rise_sigma_db:.2f} dB over the sky beside it, {where} where it stood",
    ]
    noise = found.noise
    if noise is None:
        return [*lines, "System temperature and G/T: the frequency is not known, or outside 0.05 to 100 GHz."]
    (low_k, high_k), (low_db, high_db) = noise.system_span_k, noise.gt_span_db
    quiet = f"a quiet Sun of {noise.sun_k:.0f} K at {noise.freq_hz / 1e9:.2f} GHz"
    return [
        *lines,
        f"System {noise.system_k:.0f} K ({low_k:.0f} to {high_k:.0f} K)",
        f"G/T    {noise.gt_db:.1f} dB/K ({low_db:.1f} to {high_db:.1f} dB/K)",
        f"For {quiet}; the spans are for {SUN_LEAST:g} to {SUN_MOST:g} times that.",
    ]


def why_not_kept(found: SunLesson) -> str:
    """Return why this is not kept with a feed, in sentences; empty where it may be."""
    worst = max(found.az_sigma_deg / found.az_deg, found.el_sigma_deg / found.el_deg)
    if worst > MOST_SIGMA:
        return (
            f"The beam is sure to {100.0 * worst:.0f} %, and at most {100.0 * MOST_SIGMA:.0f} % is kept. "
            "Map the Sun with a smaller step, or listen longer."
        )
    return ""


def keep_lesson(config_file: Path, name: str, feed: FeedProfile, found: SunLesson) -> str:
    """Write beam and system temperature into `[feed.NAME]`, and say so. ConfigError where it can't be written.

    The beam is that at the middle of the feed's band.
    """
    beam = Beam(found.az_deg, found.el_deg, found.freq_hz, BeamOrigin.SCAN).at(feed.middle_hz)
    keys: dict[str, Value] = {
        "beam_deg": None, "beam_az_deg": round(beam.az_deg, 2), "beam_el_deg": round(beam.el_deg, 2),
        "beam_origin": BeamOrigin.SCAN.value,
    }  # fmt: skip
    told = f"beam {beam.size}"
    if found.noise is not None:
        keys["system_k"] = round(min(max(found.noise.system_k, SYSTEM_K[0]), SYSTEM_K[1]), 1)
        told = f"{told}, system temperature {found.noise.system_k:.0f} K"
    edit(config_file, {f"feed.{name}.{key}": value for key, value in keys.items()})
    return f"Kept with the feed {name}: {told}."


def _away(deg: float, one: str, other: str) -> str:
    return f"{abs(deg):.2f}° {one if deg >= 0.0 else other}"

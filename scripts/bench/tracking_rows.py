"""Who has a row in the table of the machines, and who follows beside birdcage."""

from __future__ import annotations

from birdcage.sim.port import firmware_names

OURS, GLIDING = "birdcage", "birdcage, gliding"
"""As it follows by itself; and as its owner may have it, on a dish whose gear is known (`GLIDES`)."""
POLICIES = (OURS, GLIDING, "move to now, 1 Hz", "Gpredict, 1°", "Gpredict, 5°")
GLIDES = {
    "g2": {
        f"{axis}.{fact}": value
        for axis in ("azimuth", "elevation")
        for fact, value in (("play_deg", 0.0), ("mean_overshoot_up_deg", 0.035), ("mean_overshoot_down_deg", 0.035))
    }
}
"""The gear of each that takes a speed from the driver, as `birdcage gear` and its readings at rest tell it."""
EXACT = ("g2?overshoot=0", "g2plus?overshoot=0")
"""Without their overshoot, which is the middle of what is known of one dish: what is left is the driver's."""
UNTOLD = "g2plus?bare_a=error"
"""The G2+ where it does not tell its position: that is not known of it."""
RANDOM_DELAY = frozenset({"pathway-x2"})
"""What they do is chance: shown, without a goal."""


def rows() -> tuple[str, ...]:
    """Return what has a row: each simulated machine, some of them again otherwise; after `?`, settings of its twin."""
    return tuple(sorted((*firmware_names(), *EXACT, UNTOLD)))

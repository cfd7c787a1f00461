"""Who has a row in the table of the machines, and who follows beside birdcage."""

from __future__ import annotations

from birdcage.sim.port import firmware_names

OURS = "birdcage"
POLICIES = (OURS, "move to now, 1 Hz", "Gpredict, 1°", "Gpredict, 5°")
UNTOLD = "g2plus?bare_a=error"
"""The G2+ where it does not tell its position: that is not known of it."""
RANDOM_DELAY = frozenset({"pathway-x2"})
"""What they do is chance: shown, without a goal."""


def rows() -> tuple[str, ...]:
    """Return what has a row: each simulated machine, and the G2+ a second time; after `?`, settings of its twin."""
    return tuple(sorted((*firmware_names(), UNTOLD)))

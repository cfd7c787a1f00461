"""What can be chosen about a simulated relative of the Carryout G2: above all, what no source tells of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.trk.knobs import TrkSettings


@dataclass(frozen=True, slots=True)
class KinSettings(TrkSettings):
    """The knobs of one. Angles in degrees, times in seconds of dish time."""

    menu_words: ClassVar[tuple[str, ...]] = ("mot",)
    """The menus that a source has seen."""
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **TrkSettings.choices,
        "bare_a": ("angles", "error", "nothing", "target"),
        "lag_ack": ("executed", "at_once"),
    }

    root_prompt: str = "TRK>"
    """What the root shows (assumed: only that of the motor menu was read)."""
    bare_a: str = "error"
    """What `a` without a number prints: both angles as a G2 does, that a parameter is missing, nothing, or the angle
    that the azimuth was last sent to (open)."""
    low_el: float = 18.0
    high_el: float = 65.0
    """The elevations that it takes (written of the G2+; of the others assumed)."""
    wrap_line: bool = False
    """Whether homing prints the limits of the cable, too, as a G2 does (open)."""
    homes_at_boot: bool = True
    """Whether it homes by itself at power-up (assumed; a G2+ whose row 20 is TRUE does not: written)."""
    boot_s: float = 6.0
    """How long it is silent at power-up before it homes (assumed)."""
    boot_text: str = ""
    """A line that it prints then; empty for none (open)."""
    lag_min_s: float = 0.0
    lag_max_s: float = 0.0
    """Before it executes the command of a move, or of homing (assumed), it waits. How long is drawn anew each time."""
    lag_ack: str = "executed"
    """Whether the answer to a move comes when it is executed, and the shell reads nothing before, or at once (open)."""

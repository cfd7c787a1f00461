"""What a plan has to know of a dish: how it moves, what limits it, and where it stands now."""

from __future__ import annotations

from dataclasses import dataclass, field

from birdcage.antenna.alignment import Alignment
from birdcage.protocol.model import DishModel
from birdcage.sky.reach_limits import ReachLimits

OCTAVE = 2.0


@dataclass(frozen=True, slots=True)
class Standing:
    """Where the dish stands, in its own degrees."""

    az_deg: float
    """The turn of the cable where that is known, else in [0, 360)."""
    el_deg: float


@dataclass(frozen=True, slots=True)
class Mount:
    """An azimuth-elevation mount at one moment. `station.mounting` makes it from what the station knows."""

    model: DishModel
    """With the speeds that are in force."""
    limits: ReachLimits
    """Floor, ceiling, horizon mask and no-go sectors are true; the cable is counted in the dish's own degrees."""
    alignment: Alignment = field(default_factory=Alignment)
    standing: Standing | None = None
    """None while the position is not known."""
    el_min_deg: float | None = None
    """Lowest and highest elevation that the gate lets through, in the dish's own degrees; None: as the model has it."""
    el_max_deg: float | None = None
    beam_deg: float | None = None
    """Width of the beam at half power; None where the feed does not say."""
    beam_at_hz: float | None = None
    """The frequency at which `beam_deg` holds; None where that is not known."""

    def beam_deg_at(self, frequency_hz: float | None) -> float | None:
        """Return the width of the beam at a frequency; see `beam_deg_at`."""
        return beam_deg_at(self.beam_deg, self.beam_at_hz, frequency_hz)


def beam_deg_at(beam_deg: float | None, beam_at_hz: float | None, frequency_hz: float | None) -> float | None:
    """Return the width of a beam at a frequency: it grows with the wavelength (reference section 5).

    As it is, where no frequency is asked for, or the one at which it holds is not known or an octave away: of a feed
    that is not made for a frequency no law tells.
    """
    if beam_deg is None or beam_at_hz is None or frequency_hz is None:
        return beam_deg
    ratio = beam_at_hz / frequency_hz
    return beam_deg * ratio if 1.0 / OCTAVE <= ratio <= OCTAVE else beam_deg

"""What a plan has to know of a dish: how it moves, what limits it, and where it stands now."""

from __future__ import annotations

from dataclasses import dataclass, field

from birdcage.antenna.alignment import Alignment
from birdcage.base.beam import Beam
from birdcage.rotator.facts import Facts
from birdcage.sky.reach_limits import ReachLimits


@dataclass(frozen=True, slots=True)
class Standing:
    """Where the dish stands, in its own degrees."""

    az_deg: float
    """The turn of the cable where that is known, else in [0, 360)."""
    el_deg: float


@dataclass(frozen=True, slots=True)
class Mount:
    """An azimuth-elevation mount at one moment. `station.mounting` makes it from what the station knows."""

    model: Facts
    """With the speeds that are in force."""
    limits: ReachLimits
    """Floor, ceiling, horizon mask and no-go sectors are true; the cable is counted in the dish's own degrees."""
    alignment: Alignment = field(default_factory=Alignment)
    standing: Standing | None = None
    """None while the position is not known."""
    el_min_deg: float | None = None
    """Lowest and highest elevation that the gate lets through, in the dish's own degrees; None: as the model has it."""
    el_max_deg: float | None = None
    beam: Beam | None = None
    """Of this dish with the feed that is mounted; None if it is not known."""

    def beam_at(self, frequency_hz: float | None) -> Beam | None:
        """Return the beam at a frequency, as `Beam.at`; None if it is not known."""
        return None if self.beam is None else self.beam.at(frequency_hz)

"""The simulated dishes of the benchmark: what the simulator is told, and what the driver takes them for."""

from __future__ import annotations

from dataclasses import dataclass, replace

from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts
from birdcage.sky.reach_limits import ReachLimits
from birdcage.tracking.mount import Mount, Standing
from tracking_passes import Case

IDEAL = {"overshoot": "0", "backlash": "0", "latency_min": "0.02", "latency_max": "0.1"}
"""The base case: no overshoot, no play, 20 to 100 ms of latency for each command."""
WORN = {**IDEAL, "overshoot": "1", "backlash": "0.06"}
"""The second row: comes to rest 0.01 to 0.06 degrees too far, with a play of 0.06."""
SHAKEN = {**IDEAL, "latency_max": "0.3", "backlash": "0.06"}
"""200 ms more of latency jitter, and play; a runner loses replies beside."""
PLAY = {**IDEAL, "backlash": "0.06"}
"""Play alone."""
ROBUST = {**SHAKEN, "overshoot": "1"}
"""All of it at once: jitter, overshoot, play, lost replies."""


@dataclass(frozen=True)
class Dish:
    """One dish."""

    name: str
    firmware: str
    model: Facts
    options: dict[str, str]
    stands: tuple[float, float]
    """Where it is before the pass: turn of the cable and elevation."""

    def address(self, conditions: dict[str, str], seed: int) -> str:
        given = {
            "az": f"{self.stands[0]:g}",
            "el": f"{self.stands[1]:g}",
            **self.options,
            **conditions,
            "pace_baud": str(self.model.baud),
            "seed": str(seed),
        }
        return f"{self.firmware}?" + "&".join(f"{name}={value}" for name, value in given.items())

    def mount(self, az_deg: float, el_deg: float) -> Mount:
        """Return it as a plan sees it: standing somewhere, the turn of its cable known."""
        cable = self.model.cable
        limits = ReachLimits(
            self.low_el, self.high_el, cable_min_deg=cable.min_deg if cable else None,
            cable_max_deg=cable.max_deg if cable else None, turn_known=True,
        )  # fmt: skip
        return Mount(self.model, limits, standing=Standing(az_deg, el_deg))

    @property
    def low_el(self) -> float:
        return self.model.elevation.min_deg

    @property
    def high_el(self) -> float:
        return self.model.elevation.max_deg

    def turn(self, case: Case) -> float | None:
        """Return how many degrees on a pass's unrolled azimuth is on the cable; None where no turn serves it."""
        az, el = case.track(case.times())
        az = az[el >= self.low_el]
        cable = self.model.cable
        if not len(az) or cable is None:
            return None
        turns = [360.0 * k for k in range(-3, 4)]
        fit = [by for by in turns if cable.min_deg + 0.5 <= az.min() + by and az.max() + by <= cable.max_deg - 0.5]
        middle = (cable.min_deg + cable.max_deg) / 2.0
        return min(fit, key=lambda by: abs((az.min() + az.max()) / 2.0 + by - middle)) if fit else None


def at_speed(axis: Axis, speed_deg_s: float, acceleration_deg_s2: float) -> Axis:
    return replace(axis, speed_deg_s=speed_deg_s, acceleration_deg_s2=acceleration_deg_s2, times=None)


G2 = Dish("Carryout G2", "g2", CARRYOUT_G2, {}, (0.0, 45.0))
TRAVLER_5 = Dish(
    "Trav'ler at 5°/s",
    "hal205",
    TRAVLER.with_axes(at_speed(TRAVLER.azimuth, 5.0, 20.0), at_speed(TRAVLER.elevation, 5.0, 20.0)),
    {"speed": "5", "accel": "20"},
    (180.0, 45.0),
)

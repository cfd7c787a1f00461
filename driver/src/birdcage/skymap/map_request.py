"""What a person asks for when a map is to be made: how it is begun, taken up again, and how long it takes."""

from __future__ import annotations

import math
import uuid
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING

from birdcage.kinematics import plan_slew
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
from birdcage.signal.listen import check_number
from birdcage.signal.source_path import SourcePath
from birdcage.skymap.plan import MapFrame, MapPlan

if TYPE_CHECKING:
    from birdcage.rotator.axis import Axis
    from birdcage.skymap.map_file import MapHead
    from birdcage.station.state import StationState
    from birdcage.station.task_state import TaskValue

KIND = "map"
STEPS_A_BEAM = 3.0
"""The usual step is so small a part of the beam: a source between two directions still stands out of both."""
HOURLY_S = 3600.0
QUIET_PART = 0.3
"""A quiet dish turns at so much of its speed."""
CROSS_POINTS = 5
"""Directions along each axis of a reference cross."""
LINES, LINE_S = 9, 0.06
"""Lines on the wire in one direction, and how long one takes: 20 to 100 ms, assumed."""
MENU_S = 3 * LINE_S
RADIO_LINES = 2
"""Where the level comes from a source of its own, nothing but the move and one look."""
TUNER_READ_S = 0.1
IN_TURN_S = 0.6
"""What it takes to see a dish at rest between two legs, where its axes turn one after the other."""


@dataclass(frozen=True, slots=True)
class MapRequest:
    """A map to be made."""

    plan: MapPlan
    key: str = ""
    """Names it across programs; empty for a new one."""
    target: str = ""
    """What it is around, for people; a moving one has a `path` too."""
    path: tuple[tuple[float, ...], ...] = ()
    """Where the target will be: rows as for `SourcePath`. Empty on a map in azimuth and elevation."""
    source: str = ""
    """The id of the signal source; empty for the feed's."""
    reads: int = 0
    """Readings in one direction; 0 for as many as suit the source."""
    details: bool = False
    """Whether the tuner's SNR and lock are read in each direction, too."""
    start_s: float = 0.0
    """When to begin, POSIX seconds; 0 for now."""
    until_s: float = 0.0
    """When to end at the latest; 0 for no such time."""
    reference: tuple[float, float] | None = None
    """The true direction of a strong source that is heard again and again, to see gain and pointing drift."""
    reference_every_s: float = HOURLY_S
    quiet: bool = False
    """Whether the dish turns slowly, which is quieter."""

    def values(self) -> dict[str, TaskValue]:
        """Return what `BeginTask("map", …)` is told."""
        az_deg, el_deg = self.reference or (0.0, 0.0)
        return {
            **self.plan.values(), "key": self.key or uuid.uuid4().hex, "target": self.target, "path": self.path,
            "source": self.source, "reads": self.reads, "details": self.details, "start_s": self.start_s,
            "until_s": self.until_s, "reference_az_deg": az_deg, "reference_el_deg": el_deg,
            "reference_every_s": self.reference_every_s if self.reference is not None else 0.0, "quiet": self.quiet,
        }  # fmt: skip

    @classmethod
    def of(cls, values: Mapping[str, TaskValue]) -> MapRequest:
        """Return the request that `values` told, perhaps by another program. TypeError, with a sentence, for others."""
        if unknown := values.keys() - UNSET.keys() - REGION:
            raise TypeError(f"a map has no {min(unknown)}")
        told = {**UNSET, **values}
        try:
            plan = MapPlan.of({name: told[name] for name in REGION & told.keys()})
        except ValueError as error:
            raise TypeError(str(error).removesuffix(".")) from error
        key, path = told["key"], told["path"]
        if not isinstance(key, str) or not key:
            raise TypeError("key is empty. Give a text that no other map has")
        numbers = {name: _checked(name, told[name], *span) for name, span in SPANS.items()}
        follows = plan.frame is MapFrame.TARGET
        if follows != bool(path):
            raise TypeError("a map around a moving target needs a path, and no other one has it")
        every_s, reference = numbers.pop("reference_every_s"), None
        az_deg, el_deg = numbers.pop("reference_az_deg"), numbers.pop("reference_el_deg")
        if every_s:
            reference = az_deg, el_deg
        reads = int(numbers.pop("reads"))  # other programs know no whole numbers
        return cls(
            plan, key, str(told["target"]), tuple(SourcePath.of(path).rows) if follows else (), str(told["source"]),
            reads, bool(told["details"]), reference=reference, reference_every_s=every_s, quiet=bool(told["quiet"]),
            **numbers,
        )  # fmt: skip


REGION = frozenset({"x_low_deg", "x_high_deg", "y_low_deg", "y_high_deg", "step_deg", "y_step_deg", "order", "frame"})
UNSET: Mapping[str, TaskValue] = MappingProxyType({
    "order": "coarse", "frame": "azel", "key": "", "target": "", "path": (), "source": "", "reads": 0,
    "details": False, "start_s": 0.0, "until_s": 0.0, "reference_az_deg": 0.0, "reference_el_deg": 0.0,
    "reference_every_s": 0.0, "quiet": False,
})  # fmt: skip
"""What holds where a program does not tell it of a map."""
SPANS = {
    "reads": (0, 1000), "start_s": (0.0, 1e11), "until_s": (0.0, 1e11), "reference_az_deg": (-720.0, 720.0),
    "reference_el_deg": (-90.0, 90.0), "reference_every_s": (0.0, 1e6),
}  # fmt: skip


def _checked(name: str, value: TaskValue, low: float, high: float) -> float:
    check_number(name, value, low, high)
    assert isinstance(value, int | float), "it was checked"
    return float(value)


def again(head: MapHead, path: tuple[tuple[float, ...], ...] = ()) -> MapRequest:
    """Return the request that goes on with an unfinished map, from now on; `path`: where its target will be."""
    about = head.about
    every_s, az_deg, el_deg = (_number(about, f"reference_{name}") for name in ("every_s", "az_deg", "el_deg"))
    return MapRequest(
        head.plan, head.key, str(about.get("target") or ""), path, head.source, int(_number(about, "reads")),
        bool(about.get("details")), reference=(az_deg, el_deg) if every_s else None,
        reference_every_s=every_s or HOURLY_S, quiet=bool(about.get("quiet")),
    )  # fmt: skip


def _number(about: object, name: str) -> float:
    value = about.get(name) if isinstance(about, dict) else None
    return float(value) if isinstance(value, int | float) else 0.0


def usual_step_deg(state: StationState) -> float:
    """Return a third of the beam, rounded down to a tenth of a degree."""
    width_deg = ASSUMED_WIDTH_DEG if state.beam is None else state.beam.narrow_deg
    return max(math.floor(width_deg / STEPS_A_BEAM * 10.0) / 10.0, 0.1)


def within_reach(plan: MapPlan, state: StationState) -> MapPlan:
    """Return the part of a map in azimuth and elevation that lies between the lowest and highest elevation allowed.

    ValueError, with the limits, where nothing of it does. The cells keep their places: what falls off are whole rows.
    """
    low, high = state.el_min_deg, state.el_max_deg
    if plan.frame is not MapFrame.AZEL or low is None or high is None:
        return plan
    rows = [row for row in range(plan.rows) if low <= plan.at(row * plan.columns)[1] <= high]
    if not rows:
        raise ValueError(
            f"Elevation {plan.y_low_deg:g} to {plan.y_high_deg:g}° is out of reach. "
            f"This dish reaches {low:g} to {high:g}°."
        )
    return replace(
        plan, y_low_deg=plan.at(rows[0] * plan.columns)[1], y_high_deg=plan.at(rows[-1] * plan.columns)[1]
    )  # fmt: skip


def length_words(seconds: float) -> str:
    """Say how long a map takes."""
    minutes = round(seconds / 60.0)
    if minutes < 1:
        return "a minute"
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60:02} min"


@dataclass(frozen=True, slots=True)
class MapEstimate:
    """How much a map is, before it begins."""

    directions: int
    seconds: float

    @property
    def words(self) -> str:
        """Say it in a few words."""
        return f"{self.directions} directions, about {length_words(self.seconds)}"


def estimate(
    request: MapRequest, state: StationState, *, dwell_s: float | None, heard: Collection[int] = ()
) -> MapEstimate:
    """Return how many directions are left, and how long they take by the dish's own speeds.

    `dwell_s`: how long the signal is listened to in one direction; None: by the dish's own tuner.
    """
    plan, facts = request.plan, state.dish
    cells = [cell for cell in plan.sequence if cell not in heard]
    lines = LINES if dwell_s is None else RADIO_LINES
    listens_s = (TUNER_READ_S if dwell_s is None else dwell_s) * max(request.reads, 1)
    seconds = len(cells) * (listens_s + lines * LINE_S)
    if facts is not None:
        before = None
        for cell in cells:
            at = plan.at(cell)
            if before is not None:
                ways = [
                    _travel_s(axis, round(abs(to - one), 6), QUIET_PART if request.quiet else 1.0)
                    for axis, one, to in zip((facts.azimuth, facts.elevation), before, at, strict=True)
                ]
                # The way to the tuner's menu is gone while a dish turns whose axes go together.
                hidden_s = MENU_S if dwell_s is None else 0.0
                seconds += max(max(ways) - hidden_s, 0.0) if facts.axes_together else sum(ways) + IN_TURN_S
            before = at
    if request.reference is not None:
        crosses = 1.0 + seconds // max(request.reference_every_s, 60.0)
        seconds += crosses * 2.0 * CROSS_POINTS * (listens_s + lines * LINE_S + 0.5)
    return MapEstimate(len(cells), seconds)


@lru_cache(maxsize=512)
def _travel_s(axis: Axis, way_deg: float, part: float) -> float:
    """Return how long an axis turns, from rest to rest, at a part of its speed where that can be set."""
    if axis.times is not None:
        return axis.times.seconds(way_deg)
    return plan_slew(0.0, way_deg, axis.speed_deg_s * part, axis.acceleration_deg_s2).duration_s

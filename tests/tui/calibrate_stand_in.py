"""A stand-in for the guide of the calibration: scenes to show, with a real fit in them, and notes of what was asked."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from functools import lru_cache

from birdcage.antenna.alignment import Alignment
from birdcage.base.alignments import AlignmentSet
from birdcage.base.config.sections import AlignmentSettings
from birdcage.calibration.candidates import CalibrationObject
from birdcage.calibration.fit import fit
from birdcage.calibration.guide import GuideView
from birdcage.calibration.next_best import Proposal
from birdcage.calibration.peak import MeasuredPeak
from birdcage.calibration.terms import priors_of
from birdcage.sky.targets.model import Fixed
from birdcage.station.state import Pointing
from birdcage_tui.shown.calibration import CalibrateNow, KeptSet

UTC_THEN = datetime(2026, 3, 20, 20, 30, tzinfo=UTC)
STANDS = Alignment(5.0, 0.4, 0.3, 1.2, 0.7)
SKY = (("61.5°W EchoStar 16", 132.8, 32.7), ("Sun", 223.0, 42.0), ("72.7°W Nimiq 5", 146.0, 38.9),
       ("119°W EchoStar 14", 214.4, 38.7), ("Moon", 201.0, 62.0))  # fmt: skip
WOBBLE = ((0.03, -0.05), (-0.04, 0.02), (0.06, 0.05), (-0.02, -0.04), (0.05, 0.01))
"""What each peak is off, in degrees."""
UP = (("82°W Nimiq 4", 159.0, 43.0), ("91°W Nimiq 6", 173.0, 45.0), ("95°W Galaxy 3C", 179.0, 45.0),
      ("101°W SES 1", 188.0, 44.0))  # fmt: skip


def peak(number, *, off=(0.0, 0.0)):
    """A peak on one of them, with the dish standing as `STANDS`."""
    name, az, el = SKY[number - 1]
    dish_az, dish_el = STANDS.to_dish(az, el)
    wobble = WOBBLE[number - 1]
    return MeasuredPeak(
        UTC_THEN, name, az, el, dish_az + wobble[0] + off[0], dish_el + wobble[1] + off[1], 0.1, number=number
    )


@lru_cache
def fitted(count, odd=0):
    peaks = tuple(peak(number, off=(2.0, 1.0) if number == odd else (0.0, 0.0)) for number in range(1, count + 1))
    return peaks, fit(peaks, priors_of(AlignmentSettings(), peaks), Alignment()) if peaks else None


def view(count, odd=0):
    peaks, found = fitted(count, odd)
    proposals = tuple(
        Proposal(
            CalibrationObject(Fixed(name, az, el), az, el, 0.13, None), 0.23 + 1.0 / (count + 1) ** 2, 0.2 + index / 50
        )
        for index, (name, az, el) in enumerate(UP)
    )
    return GuideView(
        peaks, found, None if found is None else 0.23, proposals,
        target="", expected=None, position=None, nudged=None, may_not_take="No object is chosen.",
        busy="", failure="", active="Roof" if count else "",
    )  # fmt: skip


def on_object(count, odd=0):
    """The dish on the next object, nudged a little."""
    name, az, el = UP[0]
    dish = STANDS.to_dish(az, el)
    where = Pointing(az + 0.2, el, *dish, 0.0, UTC_THEN, None)
    return replace(view(count, odd), target=name, expected=(az, el), position=where, nudged=(0.42, -0.1),
                   may_not_take="")  # fmt: skip


SETS = (KeptSet(AlignmentSet("Roof", 5.01, 0.38, 0.3, 1.2, 0.7, 0.04, 5), in_force=True),
        KeptSet(AlignmentSet("Van", -12.5, 0.1, rms_deg=0.21, peaks=3), in_force=False))  # fmt: skip
SCENES = {
    "opening": CalibrateNow(searching=True),
    "no-place": CalibrateNow(replace(view(0), proposals=()), wrong="No location set. L sets it."),
    "first": CalibrateNow(view(0)),
    "one": CalibrateNow(on_object(1), told="Peak 1 saved, ±0.10°."),
    "five": CalibrateNow(on_object(5), SETS, removed=1, enough=True),
    "odd": CalibrateNow(on_object(5, odd=3), SETS),
}  # fmt: skip


class Source:
    """Shows a scene, and notes each call."""

    def __init__(self, show, scene):
        self._show, self._scene = show, scene
        self.asked, self.looks = [], 0

    def start(self):
        self._show(SCENES[self._scene])

    def look(self):
        self.looks += 1

    def close(self):
        return

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return lambda *args: self.asked.append((name, *args))


def make(scene):
    return lambda show: Source(show, scene)

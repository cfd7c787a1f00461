"""`birdcage rssi`: readings of the feed's own source, one line each, and what they come to."""

from __future__ import annotations

import math
import queue
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.cli.attached_command import reach_dish
from birdcage.cli.say import iso, say, tell, tell_json
from birdcage.rotator.feature import POSITION
from birdcage.signal.heard_from import heard_from
from birdcage.signal.level_scale import find_scale, load_scales
from birdcage.signal.recording import SignalRecorder, about, row_of
from birdcage.signal.source_set import SourceSet
from birdcage.station.requests import Watch
from birdcage.station.state import LinkPhase

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.cli.station_command import StationCommand
    from birdcage.signal.level_scale import LevelScale
    from birdcage.signal.monitor import SignalMonitor
    from birdcage.signal.source import SignalFacts, SignalReading

HOLDER = "birdcage rssi"
FIRST_S = 20.0
"""How long the first reading is waited for: a line must be quiet for some seconds before its menu is left."""
QUIET_S = 3.0
"""A pause so long between two readings is told, if it is longer than usual."""


@dataclass
class Summary:
    """What all readings come to."""

    facts: SignalFacts
    scale: LevelScale | None = None
    """What its values are in dB, where two levels are known."""
    extrapolated: int = 0
    """Readings beyond these two."""
    count: int = 0
    first_at: float = 0.0
    last_at: float = 0.0
    mean: float = 0.0
    squares: float = 0.0
    """The sum of squares about the mean, by Welford's recurrence: m += (x - m) / n, s += (x - m_before) (x - m)."""
    best: float = -math.inf
    best_from: tuple[float | None, float | None] = field(default=(None, None))

    def take(self, reading: SignalReading, direction: tuple[float | None, float | None]) -> None:
        """Take one more."""
        self.first_at = self.first_at if self.count else reading.at
        self.count, self.last_at = self.count + 1, reading.at
        self.extrapolated += self.scale is not None and not self.scale.covers(reading.value)
        before = self.mean
        self.mean += (reading.value - before) / self.count
        self.squares += (reading.value - before) * (reading.value - self.mean)
        if reading.value > self.best:
            self.best, self.best_from = reading.value, direction

    def words(self) -> str:
        """Return it in a sentence; empty without a reading."""
        if not self.count:
            return ""
        unit, digits, span_s = self.facts.unit, self.facts.decimals + 1, self.last_at - self.first_at
        rate = f", {(self.count - 1) / span_s:.1f} a second" if span_s > 0.0 else ""
        scatter = f" ±{math.sqrt(self.squares / (self.count - 1)):.{digits}f}" if self.count > 1 else ""
        az_deg, el_deg = self.best_from
        where = "" if az_deg is None or el_deg is None else f" at {az_deg:.2f} / {el_deg:.2f}"
        return (
            f"{self.count} readings{rate}: mean {self.mean:.{digits}f}{scatter} {unit}, "
            f"highest {self.best:.{self.facts.decimals}f}{where}.{self._db_words()}"
        )

    def _db_words(self) -> str:
        """Return by what the decibels were told; empty where none were."""
        if self.scale is None:
            return ""
        beyond = f" {self.extrapolated} readings are beyond these levels (?)." if self.extrapolated else ""
        return f"\ndB by two known levels: {self.scale.words(self.facts.unit)}; a straight line is assumed.{beyond}"


def print_readings(
    dish_wanted: Wanted, source: str, *, count: int | None, seconds: float | None, record: bool, as_json: bool
) -> None:
    """Print readings until there are so many, or so long; without either until a signal. `source` is its id.

    CommandRefused for a dish without a tuner, NoReply where nothing is heard.
    """
    settings = dish_wanted.settings
    with reach_dish(dish_wanted, HOLDER, survey=False) as dish:
        dish.come_up(15.0)
        dish.station.submit(Watch(HOLDER, frozenset({POSITION}), 1.0))
        told: queue.SimpleQueue[SignalReading] = queue.SimpleQueue()
        sources = SourceSet(settings, dish.station.clock)
        sources.attach(dish.station)
        sources.choose(source)
        monitor = sources.monitor(told.put)
        facts = monitor.chosen.facts
        scales = load_scales(dish_wanted.paths.known_levels)
        for problem in scales.problems:
            say(problem)
        scale = find_scale(scales.entries, facts.id, settings.feed.active)
        summary, recorder = Summary(facts, scale), None
        if record:
            recorder = SignalRecorder(
                dish_wanted.paths.signal_recordings, facts, about(facts, settings.feed.active),
                demo=facts.demo or dish.state.demo,
            )  # fmt: skip
        try:
            monitor.watch(on=True, steady=True)
            _print(dish, monitor, told, summary, recorder, count=count, seconds=seconds, as_json=as_json)
        finally:
            monitor.close()
            sources.close()
            if words := summary.words():
                say(words)
            if recorder is not None:
                recorder.close()
                say(recorder.problem or f"Recording {recorder.number}: {recorder.kept} readings.")


def _print(
    dish: StationCommand, monitor: SignalMonitor, told: queue.SimpleQueue[SignalReading], summary: Summary,
    recorder: SignalRecorder | None, *, count: int | None, seconds: float | None, as_json: bool,
) -> None:  # fmt: skip
    begun, source, quiet, stopped = dish.now, monitor.chosen.facts.id, _Quiet(dish, monitor), False
    while (count is None or summary.count < count) and not (summary.count and seconds and dish.now >= begun + seconds):
        dish.look()
        while not told.empty() and (count is None or summary.count < count):
            reading = told.get()
            if reading.source == source:
                begun = begun if summary.count else dish.now  # the seconds are of readings, not of the way to them
                quiet.hear()
                _print_one(dish, reading, summary, as_json=as_json)
                if recorder is not None:
                    recorder.add(row_of(reading, summary.facts, dish.state, dish.now))
        if recorder is not None and recorder.problem and not stopped:
            stopped = True
            say(recorder.problem)
        if summary.count:
            quiet.look()
        else:
            _see_that_it_may_tell(dish, monitor, begun)


class _Quiet:
    """Says once why no reading follows, and waits for the next one."""

    def __init__(self, dish: StationCommand, monitor: SignalMonitor) -> None:
        self._dish, self._source = dish, monitor.chosen
        self._heard_at, self._said = dish.now, ""

    def hear(self) -> None:
        """There is a reading."""
        self._heard_at, self._said = self._dish.now, ""

    def look(self) -> None:
        """Say it where that is too long ago, and again where the reason is another one."""
        facts, link = self._source.facts, self._dish.state.link
        quiet_s = max(QUIET_S, facts.pause_s)
        if self._dish.now < self._heard_at + quiet_s:
            return
        why = self._source.trouble
        if facts.of_dish and link.state is not LinkPhase.UP:
            why = link.detail
        if facts.of_dish and not why:
            why = f"The {facts.label} has told nothing for {quiet_s:.0f} s. It is read while the dish rests."
        if why in ("", self._said):
            return
        self._said = why
        say(f"{self._said} Still waiting.")


def _see_that_it_may_tell(dish: StationCommand, monitor: SignalMonitor, begun: float) -> None:
    trouble = monitor.chosen.trouble
    if trouble and monitor.chosen.facts.of_dish:
        raise CommandRefused(trouble, reason=Reason.UNSUPPORTED)
    if trouble:
        dish.progress.show(f"{trouble} It is tried again …")
    if dish.now > begun + FIRST_S:
        rests = "It is read while the dish rests." if monitor.chosen.facts.of_dish else "Does the receiver answer?"
        raise NoReply(trouble or f"The {monitor.chosen.facts.label} told nothing in {FIRST_S:.0f} s. {rests}")


def _print_one(dish: StationCommand, reading: SignalReading, summary: Summary, *, as_json: bool) -> None:
    facts, scale, state = summary.facts, summary.scale, dish.state
    az_deg, el_deg = direction = heard_from(reading.at, facts, state)
    summary.take(reading, direction)
    if as_json:
        tell_json({
            "utc": iso(reading.utc), "value": reading.value, "scatter": reading.scatter, "n": reading.n,
            "unit": reading.unit, "source": reading.source,
            "db": None if scale is None else round(scale.db(reading.value), 3),
            "db_extrapolated": None if scale is None else not scale.covers(reading.value),
            "azimuth_deg": az_deg, "elevation_deg": el_deg, "port": state.port, "demo": facts.demo or state.demo,
        })  # fmt: skip
        return
    where = f"{'--':>7} {'--':>6}" if az_deg is None or el_deg is None else f"{az_deg:7.2f} {el_deg:6.2f}"
    in_db = ""
    if scale is not None:
        in_db = f"  {scale.db(reading.value):.1f} dB{'' if scale.covers(reading.value) else ' ?'}"
    tell(f"{reading.utc:%H:%M:%S.%f}"[:-4] + f"Z  {where}  {reading.value:.{facts.decimals}f} {reading.unit}{in_db}")

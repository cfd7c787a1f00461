"""What a replay shows: a banner that says so, the reading of that moment, its minute, and the whole recording."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from datetime import datetime, timedelta

from birdcage.base.geometry import shortest_turn
from birdcage.signal.recording import RecordedReading

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cut, shorten
from birdcage_tui.drawing.digits import put_big
from birdcage_tui.drawing.strip_scale import StripScale, strip_scale
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View
from birdcage_tui.signal.replay_deck import SPAN_S, ReplayDeck, digits_of
from birdcage_tui.widgets.pane import Pane

AXIS_COLUMNS = 8
GAP_S = 10.0
"""A longer silence is a gap, not a slope."""
LEAST = {"counts": 100.0, "dB": 10.0}
"""What an axis shows at least, so that noise looks like noise; of other units what they are."""
KEYS = (
    ("l", "live"), ("p", "pause"), ("- +", "speed"), ("g", "time"), ("v", "axis"), ("←→", "10 s"),
    ("PgUp PgDn", "1 min"),
)  # fmt: skip
"""The way back first."""
Reading = Callable[[RecordedReading], float | None]
AGAINST: dict[str, Reading] = {
    "time": lambda _reading: None,
    "azimuth": lambda reading: reading.az_deg,
    "elevation": lambda reading: reading.el_deg,
}


def clock_text(moment: datetime) -> str:
    """Return a time of day as the replay writes it."""
    return f"{moment:%H:%M:%S}Z"


class ReplayPane(Pane):
    """A pane that draws a deck."""

    def __init__(self, deck: ReplayDeck, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.deck = deck

    def title(self, words: str) -> None:
        """Write it into the frame."""
        if self.border_title != words:  # setting it repaints the pane, equal or not
            self.border_title = words


class ReplayBanner(ReplayPane):
    """One row: that this is the past, which recording, the moment, and how fast it goes."""

    INK = "bar-warn"

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it is of the past
        """Write it, the most important first."""
        deck, recording = self.deck, self.deck.tape.recording
        demo = "DEMO " if recording.demo else ""
        state = "at its end" if deck.is_over else "paused" if deck.paused else f"speed ×{deck.speed:g}"
        if deck.is_reading:
            state = "reading the disk"
        at = clock_text(deck.at)
        forms = (
            f" ◀◀ {demo}REPLAY {deck.at:%Y-%m-%d} {at}  {state}  not live",
            f" ◀◀ {demo}REPLAY {at}  {state}",
            f" ◀◀ REPLAY {at}  {state}",
        )
        x = cells.put(0, 0, next((form for form in forms if len(form) < cells.width), forms[-1]), "bar-warn")
        which = f"recording {recording.number}: {recording.source}, {recording.unit} "
        if x + len(which) < cells.width:
            cells.right(cells.width, 0, which, "bar-warn")


class ReplayLevelPane(ReplayPane):
    """The reading of that moment in big digits, and all that was kept beside it."""

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it is of the past
        """Draw it; a dash for what was not known then."""
        deck, unit = self.deck, self.deck.tape.recording.unit
        self.title(f"REPLAY: level at {clock_text(deck.at)}")
        heard = deck.heard
        last = heard[-1] if heard else None
        age_s = None if last is None else (deck.at - last.utc).total_seconds()
        old = age_s is None or age_s > GAP_S
        text = "---" if last is None else f"{last.value:.{digits_of([last.value])}f}"
        x = put_big(cells, 1, 0, text, "dim" if old else "strong") + 2
        age = "nothing read for a minute" if age_s is None else f"{age_text(age_s)} before"
        for y, words in enumerate([", ".join(filter(None, (unit, _counted(last), age))), *self._words(last)]):
            cells.put(x, y, shorten(words, cells.width - x - 1), "text" if y else "dim")

    def _words(self, last: RecordedReading | None) -> list[str]:
        best, where, target = self.deck.best, "-", "-"
        lock = snr = polarisation = activity = "-"
        if last is not None:
            where, target = _direction(last.az_deg, last.el_deg), last.target or "-"
            lock = "-" if last.lock is None else "yes" if last.lock else "no"
            snr = "-" if last.snr_db is None else f"{last.snr_db:.1f} dB"
            polarisation, activity = last.polarisation or "-", last.activity
        told = [f"dish {where}  target {target}", f"lock {lock}  SNR {snr}  pol {polarisation}  {activity}"]
        if best is not None:
            at = _direction(best.high_az_deg, best.high_el_deg)
            told.append(f"highest so far {best.high:.{digits_of([best.high])}f} at {at}, {clock_text(best.high_at)}")
        return told


class ReplayStripPane(ReplayPane):
    """The minute before that moment against time; or the same readings against azimuth or elevation."""

    def __init__(self, deck: ReplayDeck, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(deck, id=id)
        self.against = "time"

    def turn(self) -> None:
        """Take the next axis."""
        names = list(AGAINST)
        self.against = names[(names.index(self.against) + 1) % len(names)]

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it is of the past
        """Draw curve and axes."""
        deck, against = self.deck, self.against
        since = deck.at - timedelta(seconds=SPAN_S)
        self.title(f"REPLAY: {clock_text(since)} to {clock_text(deck.at)} against {against}")
        points = [(each, self._x(each, since, deck.heard)) for each in deck.heard]
        known = [(each.utc, x, each.value) for each, x in points if x is not None]
        if not known:
            why = "Nothing was heard in this minute." if not points else f"The {against} was not known then."
            cells.put(1, 0, cut("Reading the disk …" if deck.is_reading else why, cells.width - 2), "dim")
            return
        xs = [x for _utc, x, _value in known]
        ends = (0.0, SPAN_S) if against == "time" else _spread(min(xs), max(xs), 1.0)
        plot(cells, known, ends, LEAST.get(deck.tape.recording.unit, 0.0), joins=against == "time")
        y, x0, width = cells.height - 1, AXIS_COLUMNS, cells.width - AXIS_COLUMNS - 1
        names = (
            [clock_text(since), clock_text(deck.at)]
            if against == "time"
            else [f"{end % 360.0 if against == 'azimuth' else end:.2f}°" for end in ends]
        )
        cells.put(x0, y, names[0], "dim")
        cells.right(x0 + width, y, names[1], "dim")

    def _x(self, reading: RecordedReading, since: datetime, heard: Sequence[RecordedReading]) -> float | None:
        if self.against == "time":
            return (reading.utc - since).total_seconds()
        found = AGAINST[self.against](reading)
        if found is None or self.against == "elevation":
            return found
        first = next(each.az_deg for each in heard if each.az_deg is not None)
        return first + shortest_turn(first, found)


class ReplayWholePane(ReplayPane):
    """The whole recording: its highest and lowest values, and where the replay stands."""

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it is of the past
        """Draw it on its own axis of time."""
        deck, tape = self.deck, self.deck.tape
        self.title(f"REPLAY: the whole of it, {tape.recording.readings:,} readings")
        span_s = max((tape.ends - tape.begins).total_seconds(), 1e-3)
        width, height = cells.width - AXIS_COLUMNS - 1, cells.height - 1
        lows, highs = [each.low for each in tape.pieces], [each.high for each in tape.pieces]
        scale = strip_scale(min(lows), max(highs), LEAST.get(tape.recording.unit, 0.0), None, height)
        canvas = Braille(width, height)
        _write_levels(cells, canvas, scale)
        for piece in tape.pieces:
            x = (piece.begins - tape.begins).total_seconds() / span_s * (width * 2 - 1)
            ends = [scale.dot(value, height * 4 - 1) for value in (piece.low, piece.high)]
            canvas.line(x, ends[0], x, ends[1], "accent" if piece.begins <= deck.at else "dim")
        x = deck.part * (width * 2 - 1)
        canvas.line(x, 0, x, height * 4 - 1, "warn")
        canvas.onto(cells, AXIS_COLUMNS, 0)
        cells.put(AXIS_COLUMNS, height, clock_text(tape.begins), "dim")
        cells.right(AXIS_COLUMNS + width, height, clock_text(tape.ends), "dim")
        here = clock_text(deck.at)
        at = AXIS_COLUMNS + min(max(round(x / 2.0) - len(here) // 2, 0), max(width - len(here), 0))
        if 10 < at - AXIS_COLUMNS < width - 2 * len(here) - 1:
            cells.put(at, height, here, "warn")


class ReplayKeys(ReplayPane):
    """What its keys do."""

    INK = "bar-dim"

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - they hold always
        """Write as many as there is room for."""
        x = 1
        for key, words in KEYS:
            if x + len(key) + len(words) + 3 > cells.width:
                return
            x = cells.put(x, 0, f" {key} ", "key")
            x = cells.put(x, 0, f"{words} ", "bar") + 1


def plot(
    cells: Cells, points: Sequence[tuple[datetime, float, float]], ends: tuple[float, float], least: float, *,
    joins: bool,
) -> None:  # fmt: skip
    """Draw values at places between the ends of an axis; the newest one stands out."""
    width, height = cells.width - AXIS_COLUMNS - 1, cells.height - 1
    values = [value for _utc, _x, value in points]
    scale = strip_scale(min(values), max(values), least, None, height)
    canvas, (left, right) = Braille(width, height), ends
    _write_levels(cells, canvas, scale)

    def dot(x: float, value: float) -> tuple[float, float]:
        return (x - left) / (right - left) * (width * 2 - 1), scale.dot(value, height * 4 - 1)

    for _utc, x, value in points:
        canvas.dot(*dot(x, value), "accent")
    for one, other in itertools.pairwise(points):
        if joins and (other[0] - one[0]).total_seconds() <= GAP_S:
            canvas.line(*dot(*one[1:]), *dot(*other[1:]), "accent")
    x, y = dot(*points[-1][1:])
    canvas.line(x, y - 2, x, y + 2, "strong")
    canvas.line(x - 2, y, x + 2, y, "strong")
    canvas.onto(cells, AXIS_COLUMNS, 0)


def _write_levels(cells: Cells, canvas: Braille, scale: StripScale) -> None:
    """Write the round levels of a scale, with a line for each; where there are not two, both its ends."""
    if len(scale.ticks) < 2:
        for row, level in ((0, scale.high), (canvas.height - 1, scale.low)):
            cells.right(AXIS_COLUMNS - 1, row, f"{level:.{0 if scale.high - scale.low >= 10.0 else 1}f}", "dim")
        return
    for tick in scale.ticks:
        y = scale.dot(tick, canvas.height * 4 - 1)
        canvas.line(0, y, canvas.width * 2 - 1, y, "faint", every=8)
        cells.right(AXIS_COLUMNS - 1, int(y) // 4, f"{tick:.{scale.decimals}f}", "dim")


def _spread(low: float, high: float, least: float) -> tuple[float, float]:
    spare = max(least - (high - low), 0.0) / 2.0
    return low - spare, high + spare


def _direction(az_deg: float | None, el_deg: float | None) -> str:
    return "-" if az_deg is None or el_deg is None else f"{az_deg:.2f}°/{el_deg:.2f}°"


def _counted(reading: RecordedReading | None) -> str:
    if reading is None or reading.n is None:
        return ""
    scatter = "" if reading.scatter is None else f" ±{reading.scatter:.2g}"
    return f"mean of {reading.n}{scatter}"

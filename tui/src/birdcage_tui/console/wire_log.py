"""From events of the wire to lines of the log, and what the dish's prompt is now."""

from __future__ import annotations

from datetime import datetime

from birdcage.station.raw import LineJoiner, TranscriptEntry, printable

from birdcage_tui.console.lines import LinePart, LogLine
from birdcage_tui.console.sorter import Sorter, Speech
from birdcage_tui.console.tap import WireTap


class WireLog:
    """Takes from the tap what came since the last look."""

    def __init__(self, tap: WireTap, speech: Speech) -> None:
        self._tap, self._sorter, self._speech = tap, Sorter(speech), speech
        self._joiner = LineJoiner()
        self._sending = self._steps = False
        """Whether the last event went out, and whether a pursuit sent all that has gone out since the dish spoke."""
        self._own: list[LogLine] = []
        self.prompt = ""
        """The last prompt as the dish wrote it; empty when none was seen."""

    def remark(self, text: str, utc: datetime) -> None:
        """Put a sentence of this console's own among the lines."""
        self._own.append(LogLine(utc, "#", text.encode(), LinePart.WARNING))

    def take(self, now: datetime) -> list[LogLine]:
        """Return the lines that are new, in order."""
        missed, found = self._tap.take_out()
        joined: list[tuple[TranscriptEntry, bool]] = []
        for event, step in found:
            if event.direction == ">":  # what went out in one breath is a pursuit's only if all of it is
                self._steps = step and (self._steps or not self._sending)
            joined += [(line, self._steps) for line in self._joiner.join(event)]
            self._sending = event.direction == ">"
        if not found or self._speech.is_prompt(printable(self._joiner.unfinished)):
            joined += [(line, self._steps) for line in self._joiner.finish()]  # quiet, or a prompt without a line end
        lines = []
        if missed:
            words = f"{missed} events are not shown here. The transcript file has them."
            lines.append(LogLine(found[0][0].utc if found else now, "#", words.encode(), LinePart.WARNING))
        for event, step in joined:
            line = self._sorter.sort(LogLine(event.utc, event.direction, event.data), step=step)
            lines.append(line)
            self.prompt = line.text if line.is_prompt else self.prompt
        lines += self._own
        self._own = []
        return lines

    def forget_prompt(self) -> None:
        """The link went: what answers next may be in another menu."""
        self.prompt = ""

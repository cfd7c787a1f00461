"""The floor of `tui_load.py`: what a dish console must show, drawn with nothing but Textual.

A braille sky (60x30) whose mark moves, a braille strip of the signal (150x10), 42 readouts in one widget and a console
of six lines, fed by a thread 20 times a second and painted 10 times. A key changes one readout; `1` and `2` switch
between two pages of this kind; Ctrl+Q quits.

`composite.py signal` is the floor of F3 instead, fed 10 times a second: level and way to the peak (each 78x11), a strip
of the last minute (150x18) and three lines of the receiver.
"""

from __future__ import annotations

import math
import sys
import threading
import time
from collections import deque

from rich.segment import Segment
from rich.style import Style
from textual.app import App, ComposeResult
from textual.binding import Binding
from textual.containers import Container
from textual.message import Message
from textual.strip import Strip
from textual.widget import Widget
from textual.widgets import ContentSwitcher

SIGNAL = sys.argv[1:] == ["signal"]
FRAME_S = 0.1
TELEMETRY_S = 0.05
DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
INK, QUIET = Style(color="#63c7f2", bgcolor="#0b0e12"), Style(color="#8e99a6", bgcolor="#0b0e12")


class Telemetry(Message):
    """One reading."""

    def __init__(self, az_deg: float, el_deg: float, level: float) -> None:
        super().__init__()
        self.az_deg, self.el_deg, self.level = az_deg, el_deg, level


class Lines(Widget):
    """Shows rows of text; all of them are painted again whenever they are set."""

    rows: list[str] = []  # noqa: RUF012
    ink = INK

    def show(self, rows: list[str]) -> None:
        self.rows = rows
        self.refresh()

    def render_line(self, y: int) -> Strip:
        text = self.rows[y] if y < len(self.rows) else ""
        return Strip([Segment(text.ljust(self.size.width)[: self.size.width], self.ink)], self.size.width)


class Dots:
    """Braille dots."""

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self.bits = bytearray(width * height)

    def dot(self, x: float, y: float) -> None:
        column, row = int(x), int(y)
        if 0 <= column < self.width * 2 and 0 <= row < self.height * 4:
            self.bits[(row >> 2) * self.width + (column >> 1)] |= DOTS[row & 3][column & 1]

    def rows(self) -> list[str]:
        width = self.width
        return ["".join(chr(0x2800 + bits) for bits in self.bits[y * width : (y + 1) * width])
                for y in range(self.height)]  # fmt: skip


def sky(az_deg: float, el_deg: float) -> list[str]:
    dots = Dots(60, 30)
    for ring in (15, 30, 45, 60):
        for step in range(ring * 6):
            angle = step / (ring * 6) * 2 * math.pi
            dots.dot(60 + ring * math.sin(angle), 60 - ring * math.cos(angle))
    reach, az = 60 * (90 - el_deg) / 90, math.radians(az_deg)
    for step in range(60):
        dots.dot(60 + reach * math.sin(az) * step / 60, 60 - reach * math.cos(az) * step / 60)
    return dots.rows()


def strip(levels: deque[float], height: int = 10) -> list[str]:
    dots = Dots(150, height)
    for x, level in enumerate(levels):
        dots.dot(x, (height * 4 - 1) * (1.0 - level))
    return dots.rows()


class Board(Container):
    """One page."""

    def compose(self) -> ComposeResult:
        yield Lines(classes="sky")
        yield Lines(classes="readouts")
        yield Lines(classes="strip")
        yield Lines(classes="console")


class SignalBoard(Container):
    """The page of the signal."""

    def compose(self) -> ComposeResult:
        yield Lines(classes="level")
        yield Lines(classes="peak")
        yield Lines(classes="strip")
        yield Lines(classes="receiver")


class Composite(App[None]):
    CSS = """
    Board { layout: grid; grid-size: 2; grid-columns: 62 1fr; grid-rows: 30 1fr; height: 1fr; }
    .strip { column-span: 1; width: 62; } .console { height: 6; }
    SignalBoard { layout: grid; grid-size: 2; grid-rows: 11 18 3; height: 1fr; }
    SignalBoard .strip { column-span: 2; width: 150; } .receiver { column-span: 2; }
    """
    AUTO_FOCUS = None
    BINDINGS = [Binding("ctrl+q", "quit", priority=True)]  # noqa: RUF012

    def compose(self) -> ComposeResult:
        if SIGNAL:
            yield SignalBoard()
            return
        with ContentSwitcher(initial="one"):
            yield Board(id="one")
            yield Board(id="two")

    def on_mount(self) -> None:
        self.last = Telemetry(0.0, 45.0, 0.5)
        self.levels: deque[float] = deque(maxlen=300)
        self.lines: deque[str] = deque(maxlen=6)
        self.pressed = 0
        self.set_interval(FRAME_S, self.paint)
        threading.Thread(target=self.feed, daemon=True).start()

    def feed(self) -> None:
        began = time.monotonic()
        while True:
            t = time.monotonic() - began
            self.post_message(Telemetry(t * 2 % 360, 40 + 10 * math.sin(t), 0.5 + 0.4 * math.sin(t * 3)))
            time.sleep(FRAME_S if SIGNAL else TELEMETRY_S)

    def on_telemetry(self, message: Telemetry) -> None:
        self.last = message
        self.levels.append(message.level)
        self.lines.append(f"{time.monotonic():.3f} < Angle[0] = {message.az_deg:.2f} Angle[1] = {message.el_deg:.2f}")

    def on_key(self, event: object) -> None:
        key = getattr(event, "key", "")
        if key in ("1", "2"):
            self.query_one(ContentSwitcher).current = {"1": "one", "2": "two"}[key]
        self.pressed += 1
        self.paint()

    def paint(self) -> None:
        if SIGNAL:
            self.paint_signal()
            return
        board = self.query_one(ContentSwitcher).visible_content
        if board is None:
            return
        last = self.last
        board.query_one(".sky", Lines).show(sky(last.az_deg, last.el_deg))
        board.query_one(".strip", Lines).show(strip(self.levels))
        values = (last.az_deg, last.el_deg, last.level)
        rows = ["".join(f"{f'value {row * 3 + column}':<14}{values[column] + row:>12.2f}    " for column in range(3))
                for row in range(14)]  # fmt: skip
        board.query_one(".readouts", Lines).show([f"pressed {self.pressed:06d}", *rows])
        board.query_one(".console", Lines).show(list(self.lines))

    def paint_signal(self) -> None:
        board, last = self.query_one(SignalBoard), self.last
        bar = "█" * int(last.level * 74)
        big = [" ".join(f"│{digit}│" * 2 for digit in f"{last.level * 100:5.1f}") for _ in range(5)]
        board.query_one(".level", Lines).show([f"pressed {self.pressed:06d}", *big, f"{last.level:.3f}", *[bar] * 3])
        board.query_one(".peak", Lines).show([f"{last.az_deg:.2f} {last.el_deg:.2f} {row}" for row in range(11)])
        board.query_one(".strip", Lines).show(strip(self.levels, 18))
        board.query_one(".receiver", Lines).show([f"lock {last.level:.2f} SNR {last.level:.1f} dB"] * 3)


if __name__ == "__main__":
    Composite().run()

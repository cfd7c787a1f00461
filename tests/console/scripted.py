"""A tiny console, written from what is documented alone, with faults of the wire byte by byte."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable

from birdcage.base.clock import VirtualClock

MENUS = {"root": "TRK>", "mot": "MOT>", "dvb": "DVB>", "nvs": "NVS>"}
ALIKE = dict.fromkeys(MENUS, ">")
HELP_OF = {
    "root": ("Enter <mot> - Motor", "Enter <dvb> - Tuner", "Enter <nvs> - Settings", "reboot", "q - leaves"),
    "mot": ("a [<motor> <angle>]", "h <motor>", "q - leaves"),
    "dvb": ("agc", "rssi [<n>]", "q - leaves"),
    "nvs": ("d", "e <index> [<value>]", "s", "q - leaves"),
}
"""What a dish lists whose menus are told by help alone."""
HELP = ("help [<command>]", "Enter <dvb> - DVB Tuner", "Enter <mot> - Motor>", "a > b")

Fault = Callable[[int], list[tuple[float, bytes]]]
"""What becomes of one byte: (delay in seconds, bytes) pairs; none when it is lost."""


def clean(byte: int) -> list[tuple[float, bytes]]:
    return [(0.0, bytes([byte]))]


class Dish:
    """Root, mot, dvb, nvs; `h` takes time, `agc` runs until a key, `q` at the root kills. Also the port."""

    name = "scripted"
    demo = True

    def __init__(
        self, clock: VirtualClock, *, echo: bool = True, prompts: dict[str, str] = MENUS, help_of: dict | None = None
    ) -> None:
        self.prompts, self.help_of = prompts, help_of
        self.clock = clock
        self.menu = "root"
        self.alive = True
        self.echo = echo
        self.muted = False
        self.out_fault: Fault = clean
        self.in_fault: Fault = clean
        self.written = b""
        self.heard: list[tuple[str, str]] = []
        self._to_dish: deque[tuple[float, bytes]] = deque()
        self._to_host: deque[tuple[float, bytes]] = deque()
        self._busy_until = 0.0
        self._stream_next: float | None = None
        self._buffer = b""

    # the port
    def fileno(self) -> None:
        return None

    def pending(self) -> bool:
        self._run()
        return bool(self._to_host) and self._to_host[0][0] <= self.clock.monotonic()

    def next_event(self) -> float:
        self._run()
        times = [queue[0][0] for queue in (self._to_host,) if queue]
        if self._to_dish:
            times.append(max(self._to_dish[0][0], self._busy_until))
        if self._stream_next is not None:
            times.append(self._stream_next)
        return min(times, default=math.inf)

    def read(self) -> bytes:
        data = b""
        while self.pending():
            data += self._to_host.popleft()[1]
        return data

    def write(self, data: bytes) -> None:
        self.written += data
        for byte in data:
            self._carry(self._to_dish, byte, self.in_fault, self.clock.monotonic())

    def discard(self) -> None:
        self._to_host.clear()

    def close(self) -> None:
        pass

    # the dish
    @staticmethod
    def _carry(queue: deque[tuple[float, bytes]], byte: int, fault: Fault, now: float) -> None:
        for delay, data in fault(byte):
            queue.append((max(now + delay, queue[-1][0] if queue else 0.0), data))

    def say(self, text: str, at: float | None = None) -> None:
        for byte in text.encode("latin-1"):
            self._carry(self._to_host, byte, self.out_fault, self.clock.monotonic() if at is None else at)

    def _run(self) -> None:
        now = self.clock.monotonic()
        while True:
            if self._stream_next is not None:
                until = self._to_dish[0][0] if self._to_dish else math.inf
                if self._stream_next <= min(now, until):
                    self.say("AGC: 42\r", self._stream_next)
                    self._stream_next += 0.1
                    continue
                if until > now:
                    return
                self._stream_next = None
                self.say(f"\r\n{self.prompts[self.menu]}", until)
            if not self._to_dish or max(self._to_dish[0][0], self._busy_until) > now or not self.alive:
                return
            when, data = self._to_dish.popleft()
            self._key(data, max(when, self._busy_until))

    def _key(self, data: bytes, at: float) -> None:
        for index in range(len(data)):
            if self.muted:
                return
            byte = data[index : index + 1]
            if byte != b"\r":
                self._buffer += byte
                if self.echo:
                    self.say(byte.decode("latin-1"), at)
                continue
            line, self._buffer = self._buffer.decode("latin-1"), b""
            self.say("\r\n", at)
            self._line(line, at)

    def _line(self, line: str, at: float) -> None:
        self.heard.append((self.menu, line))
        if line == "q":
            if self.menu == "root":
                self.alive = False
                return
            self.menu = "root"
        elif self.menu == "root" and line in MENUS and line != "root":
            self.menu = line
        elif line == "?":
            listed = HELP if self.help_of is None else self.help_of[self.menu]
            self.say("".join(f"{text}\r\n" for text in listed), at)
        elif self.menu == "mot" and line == "a":
            self.say("Angle[0] = 180.00\r\nAngle[1] = 45.00\r\n", at)
        elif self.menu == "mot" and line.startswith("a "):
            self.say(f"Angle = {line.rsplit(maxsplit=1)[-1]}\r\n", at)
        elif self.menu == "mot" and line.startswith("h "):
            self._busy_until = at = at + 6.0
            self.say("wrap_min:-42333 wrap_max:2333\r\n", at)
        elif self.menu == "dvb" and line == "agc":
            self._stream_next = at
            return
        elif line:
            self.say("Invalid command\r\n", at)
        self.say(self.prompts[self.menu], at)

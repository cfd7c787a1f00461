"""The stand-in dish: bytes in, bytes out, on a clock that is handed in.

It is written from what sources say about a Carryout G2 and shares no code with birdcage, its simulator least of all:
what both of them believe wrongly shows here. `habits` are its switches, `Record` is what a test holds against what
birdcage says.
"""

from __future__ import annotations

import math
import random
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from .console import Console, Dead, Deeds, Key, Restart
from .habits import LOG_LINES, PROMPTS, Habits
from .mechanics import Asked, Mechanics
from .nvs import Nvs
from .voice import Voice

BYTE_S = 10 / 115200
LONGEST_LINE = 127
BOOT_TEXT = (
    "\nBootloader v1.01\nSPI1 init @ 4 MHz\nMotor init System=12Inch master=40000 slave=24960 ratio=1.602564\n"
    "SPI2 init @ 6.857 MHz\nEXTENDED_DVB_DEBUG ENABLED\nDVB init ID 0x4515 Rev B0 FW v113.37 strap 0x25018\n"
    "Enabled LNB STB\nAnt ID - 12-IN G2\nNVS load\n"
)


@dataclass
class Record:
    """What the dish itself saw."""

    lines: list[tuple[float, str, str]] = field(default_factory=list)
    """When each line was carried out, in which menu."""
    heard: bytearray = field(default_factory=bytearray)
    said: bytearray = field(default_factory=bytearray)
    restarts: int = 0


class StandIn:
    """One dish. Any thread may call its methods."""

    def __init__(self, now: Callable[[], float], habits: Habits | None = None) -> None:
        self.habits = habits or Habits()
        self.record = Record()
        self.lock = threading.RLock()
        self._clock = now
        self._now = now()
        self._rng = random.Random(self.habits.seed)
        self.nvs = Nvs({20: "FALSE" if self.habits.tracker else "TRUE"} | self.habits.nvs)
        self.mechanics = Mechanics(self.habits, self.nvs, lambda: self._now)
        self.voice = Voice(self.habits, self._rng)
        self._inbox: deque[tuple[float, int]] = deque()
        self._arrives = 0.0
        """When the last byte that was sent to it arrives."""
        self._chatter_at = self._next_chatter()
        self._cold_start()

    def _cold_start(self) -> None:
        self.console = Console(self.mechanics, self.nvs, self._rng)
        self._line = ""
        self._last = 0
        self.alive = True
        self._deaf = False
        self._asleep = False
        self._echoed = 0
        """How many bytes at the head of the inbox were echoed while the shell was busy."""
        self._heard_at = self._now
        self._deeds: Deeds | None = None
        self._resumes = math.inf
        self._on_key = False

    # what a port does

    def hear(self, data: bytes) -> None:
        """Take bytes from the wire."""
        with self.lock:
            self.run()
            now = self._clock()
            for byte in data:
                self._arrives = max(self._arrives, now + self.habits.wire_s) + BYTE_S
                drowned = self.habits.half_duplex and self.voice.speaks(self._arrives)
                if not (drowned or self._rng.random() < self.habits.loss):
                    self._inbox.append((self._arrives, byte))

    def take(self) -> bytes:
        """Return what has arrived from it so far."""
        with self.lock:
            self.run()
            return self.voice.take(self._clock())

    def pending(self) -> bool:
        """Return whether something has arrived from it."""
        with self.lock:
            self.run()
            return self.voice.next_event() <= self._clock()

    def next_event(self) -> float:
        """Return when to look again."""
        with self.lock:
            self.run()
            return min(self.voice.next_event(), self._next()[0])

    def blurt(self, data: bytes) -> None:
        """Put noise on the wire."""
        with self.lock:
            self.run()
            self.voice.put(self._now, data)

    # what a person does at the dish

    def reboot(self) -> None:
        """Restart it, as after a power cycle: it stands where it stands."""
        with self.lock:
            self.run()
            self._restart()

    # what a test asks

    def where(self) -> tuple[float, float]:
        """Return where it really points: azimuth from 0 to 360, and elevation."""
        with self.lock:
            self.run()
            return self.mechanics.where()

    def moves(self) -> bool:
        """Return whether it moves, or will by itself, behind the motion that is under way."""
        with self.lock:
            self.run()
            return self.mechanics.rests_at > self._now + 1e-6

    def span(self, axis: int) -> tuple[float, float]:
        """Return the lowest and highest place where an axis ever was; azimuth on the cable."""
        with self.lock:
            self.run()
            return self.mechanics.motors[axis].span(self._now)

    def asked(self, after: float = -math.inf) -> list[Asked]:
        """Return the moves by `a` that it was asked for."""
        with self.lock:
            self.run()
            return [each for each in self.mechanics.asked if each.at > after]

    @property
    def root_q(self) -> int:
        """How often a `q` reached the root menu."""
        return self.console.root_q

    # what goes on inside

    def run(self) -> None:
        """Let all happen that is due."""
        with self.lock:
            now = self._clock()
            while True:
                at, what = self._next()
                if at > now:
                    break
                self._now = max(self._now, at)
                what()
            self._now = max(self._now, now)

    def _next(self) -> tuple[float, Callable[[], None]]:
        """Return what happens next, and when."""
        events = [(self._chatter_at, self._chat)]
        if self._deeds is not None:
            events.append((self._resumes, lambda: self._go_on(key=False)))
        if self._inbox:
            if self._deeds is None or self._deaf:
                events.append((self._inbox[0][0], self._byte))
            elif self._on_key:
                events.append((self._inbox[0][0], lambda: self._go_on(key=True)))
            elif self.habits.echo_while_busy and self._echoed < len(self._inbox):
                events.append((self._inbox[self._echoed][0], self._echo_early))
        return min(events, key=lambda event: event[0])

    def _echo_early(self) -> None:
        byte = self._inbox[self._echoed][1]
        self._echoed += 1
        self._echo("\n" if byte in (10, 13) else chr(byte))

    def _byte(self) -> None:
        byte = self._inbox.popleft()[1]
        was_echoed, self._echoed = self._echoed > 0, max(self._echoed - 1, 0)
        self.record.heard.append(byte)
        if self._deaf or not self.alive or not self._awake(byte):
            return
        self._heard_at = self._now
        last, self._last = self._last, byte
        if byte == 10 and last == 13:
            return
        if byte in (10, 13):
            if not was_echoed:
                self._echo("\n")
            line, self._line = self._line, ""
            self._carry_out(line)
        elif len(self._line) < LONGEST_LINE:
            self._line += chr(byte)
            if not was_echoed:
                self._echo(chr(byte))

    def _awake(self, byte: int) -> bool:
        """Return whether it hears; what wakes it is lost."""
        sleeps = self.habits.sleep_s
        if not self._asleep and sleeps and self._now - self._heard_at > sleeps:
            self._asleep = True
        if not self._asleep:
            return True
        if self.habits.asleep != "deaf" and byte in (10, 13):
            self._asleep, self._heard_at = False, self._now
            if self.habits.asleep == "late":
                self._begin(iter([self._now + 2.0, "\n"]))
        return False

    def _echo(self, text: str) -> None:
        match self.habits.echo:
            case "on":
                self._say(text, plain=True)
            case "upper":
                self._say(text.upper(), plain=True)
            case "lower":
                self._say(text.lower(), plain=True)

    def _carry_out(self, line: str) -> None:
        self.record.lines.append((self._now, self.console.menu, line))
        self._begin(self._delayed(line))

    def _delayed(self, line: str) -> Deeds:
        habits = self.habits
        yield self._now + habits.latency_s + self._rng.uniform(0.0, habits.jitter_s)
        yield from self.console.run(line)

    def _begin(self, deeds) -> None:
        self._deeds = deeds
        self._go_on(key=False, first=True)

    def _go_on(self, *, key: bool, first: bool = False) -> None:
        """Carry the command under way on to where it waits next."""
        deeds, self._on_key = self._deeds, False
        if key:
            # The key that ends it is used up, unless a line begins with it.
            byte = self._inbox[0][1]
            if byte in (10, 13, ord("q")):
                self._inbox.popleft()
                self.record.heard.append(byte)
        try:
            deed = next(deeds) if first or not hasattr(deeds, "send") else deeds.send(key)
            while isinstance(deed, str):
                self._say(deed)
                deed = next(deeds)
        except StopIteration:
            self._deeds = None
            self._prompt()
        except Dead:
            self._deeds, self.alive = None, False
        except Restart:
            self._restart()
        else:
            self._on_key = isinstance(deed, Key)
            self._resumes = self._now + deed.longest_s if isinstance(deed, Key) else max(deed, self._now)

    def _prompt(self) -> None:
        self.voice.prompt(self._now, PROMPTS[self.habits.prompts][self.console.menu])
        self._note()

    def _say(self, text: str, *, plain: bool = False) -> None:
        self.voice.say(self._now, text, plain=plain)
        self._note()

    def _note(self) -> None:
        self.record.said += self.voice.new()

    def _restart(self) -> None:
        self.record.restarts += 1
        root_q = self.console.root_q
        self.mechanics.lose()
        self._cold_start()
        self.console.root_q = root_q
        self._inbox.clear()
        self._deaf = True
        self._begin(self._booting())

    def _booting(self) -> Deeds:
        self.nvs.ram = dict(self.nvs.flash)
        yield self._now + self.habits.boot_s / 4
        yield BOOT_TEXT
        yield self._now + self.habits.boot_s / 2
        tracker = self.nvs.ram[20] == "FALSE"
        if tracker:
            yield from self.mechanics.home((1, 0))
            yield "Antenna Facing Front\n"
        yield self._now + self.habits.boot_s / 4
        yield "Boot Complete\nLoc Startup: IDU NOT Present\n"
        self._deaf = False
        if tracker:
            self.mechanics.send(0, 90.0)

    def _next_chatter(self) -> float:
        mean = self.habits.chatter_s
        return self._now + self._rng.expovariate(1 / mean) if mean else math.inf

    def _chat(self) -> None:
        if self.alive and not self._asleep:
            self._say(f"\n{self._rng.choice(LOG_LINES)}\n")
        self._chatter_at = self._next_chatter()

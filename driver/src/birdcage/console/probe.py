"""What one baud rate shows: one bare Enter, a short listen, a verdict.

Nothing but that one byte is sent. At a wrong rate the dish takes it for one or two other bytes; none of them is a `q`,
whatever the pair of rates (tests/console/test_probe.py plays it through), and none ends a line.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum

from birdcage.base.clock import Clock, Outcome
from birdcage.base.wake import Wake
from birdcage.console.diagnosis import is_garbage
from birdcage.link.port import Port

USUAL_BAUDS = (115200, 57600, 9600, 19200, 38400)
"""The rates of known dishes first (reference section 1), then those that adapters and other consoles start with."""

ENTER = b"\r"
LISTEN_S = 0.7
"""Twenty times a console's round trip; a dish that is asked in vain costs this much a rate."""
KEPT = 65536
SAMPLE = 60

_SHAPE = re.compile(r"(?:^[A-Za-z0-9_]{2,15}|[\r\n][A-Za-z0-9_]{0,15})> ?$")
"""A prompt that no dialect declares: HAL prompts are unknown (reference section 1)."""
_WORD = re.compile(rb"[\x20-\x7e]{3}")
"""What text has and a byte or two of misread line has not."""

_LINE = re.compile(rb"[^\r\n]{3}[\r\n]")
"""The end of a line that holds more than a byte or two of noise."""


class Saw(Enum):
    """What came back after a bare Enter."""

    SILENCE = "silence"
    GARBAGE = "garbage"
    """Bytes that cannot be read: wrong baud rate, or the receiving pair swapped."""
    ECHO = "echo"
    """Our own bytes and nothing else: the adapter hears itself, or a deadlocked shell."""
    TEXT = "text"
    """Text that is not a prompt: a dish that boots, or something else."""
    PROMPT = "prompt"
    """A prompt of the firmware."""


@dataclass(frozen=True, slots=True)
class BaudFinding:
    """One baud rate, tried."""

    baud: int
    saw: Saw
    sample: str
    """The first printable characters of what came, unprintable ones as dots; empty for silence."""
    count: int
    """How many bytes came."""
    waited_s: float


def judge(heard: bytes, tokens: Iterable[str] = ()) -> Saw:
    """Say what `heard`, all that came after a bare Enter, is; `tokens` are the prompts that are known."""
    if not heard:
        return Saw.SILENCE
    if not heard.strip(b"\r\n"):
        return Saw.ECHO
    text = heard.decode("latin-1")
    starts = [line.lstrip() for line in re.split(r"[\r\n]", text)]
    if any(line.startswith(token) for line in starts for token in tokens if token):
        return Saw.PROMPT
    if is_garbage(heard):
        return Saw.GARBAGE
    if _SHAPE.search(text):
        return Saw.PROMPT
    return Saw.TEXT if _WORD.search(heard) else Saw.GARBAGE


def probe(
    link: Port,
    clock: Clock,
    baud: int,
    *,
    tokens: Iterable[str] = (),
    listen_s: float = LISTEN_S,
    wake: Wake | None = None,
    on_wake: Callable[[], None] = lambda: None,
) -> BaudFinding:
    """Send one bare Enter over `link`, which is open at `baud`, and say what came within `listen_s`.

    What had arrived before counts as well: a dish that boots talks unasked. `on_wake` is called when `wake` is set;
    it clears it, and may raise to end the wait. Raises LinkError when the port is gone.
    """
    began = clock.monotonic()
    until = began + listen_s
    link.write(ENTER)
    heard, count = b"", 0
    while clock.monotonic() < until:
        outcome = clock.wait(link, until, wake)
        if outcome is Outcome.INTERRUPTED:
            on_wake()
        elif outcome is Outcome.READY:
            data = link.read()
            heard, count = (heard + data)[:KEPT], count + len(data)
    return BaudFinding(baud, judge(heard, tokens), _sample(heard), count, round(clock.monotonic() - began, 3))


def overhear(link: Port, clock: Clock, baud: int, *, tokens: Iterable[str] = (), listen_s: float) -> BaudFinding:
    """Send nothing, and say what comes within `listen_s`; returns at the first whole line. LinkError without a port."""
    began = clock.monotonic()
    heard = b""
    while clock.monotonic() < began + listen_s and not _LINE.search(heard):
        if clock.wait(link, began + listen_s, None) is Outcome.READY:
            heard = (heard + link.read())[:KEPT]
    return BaudFinding(baud, judge(heard, tokens), _sample(heard), len(heard), round(clock.monotonic() - began, 3))


def _sample(heard: bytes) -> str:
    text = re.sub(rb"[\r\n\t]+", b" ", heard).strip()
    return "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in text[:SAMPLE])

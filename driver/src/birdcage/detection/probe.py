"""What one baud rate shows: one bare Enter, and a `?` where a prompt answers it.

Nothing else is sent. At a wrong rate the dish takes the Enter for one or two other bytes; none of them is a `q`,
whatever the pair of rates (tests/detection/test_probe.py plays it through), and none ends a line. The `?`, which lists
commands on all of these consoles and does nothing else (docs/reference/consoles.md, *Shell*), goes only where what
answers ends in `>`: to a login, a shell or a modem it could mean something.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from enum import Enum

from birdcage.base.clock import Clock, WaitOutcome
from birdcage.base.wake import Wake
from birdcage.console.diagnosis import is_garbage
from birdcage.console.escapes import without_escapes
from birdcage.console.places import commands
from birdcage.detection.spoken import longest_gap_s
from birdcage.link.port import Port

USUAL_BAUDS = (115200, 57600, 9600, 19200, 38400)
"""The rates of known dishes first (docs/reference/consoles.md, *Line*), then those that adapters and other consoles
start with."""

ENTER = b"\r"
HELP = b"?\r"
LISTEN_S = 0.7
"""Twenty times a console's round trip; a dish that is asked in vain costs this much a rate."""
HELP_S = 2.0
"""The longest that a list of commands takes at the slowest of these rates."""
QUIET_S = 0.2
"""How long nothing must follow a prompt for it to be the end of an answer."""
KEPT = 65536
SAMPLE = 60

_SHAPE = re.compile(r"(?:^[A-Za-z0-9_]{2,15}|[\r\n][A-Za-z0-9_]{0,15})> ?$")
"""A prompt that no dialect declares: HAL prompts are unknown (docs/reference/consoles.md, *Prompts*)."""
_STANDS = re.compile(r"(?:^|[\r\n]) *([!-~][ -~]{0,30})?> ?$")
"""What stands at the end without a line end, and may be a prompt that takes a `?`."""
_WORD = re.compile(rb"[\x20-\x7e]{3}")
"""What text has and a byte or two of misread line has not."""


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
    prompt: str = ""
    """What stood at the end as a prompt does; empty if nothing did."""
    listed: frozenset[str] = frozenset()
    """The commands that `?` listed; empty if it was not sent, or lists none."""
    text: str = field(default="", compare=False)
    """All that can be read of what came, a line end as a line end."""


def judge(heard: bytes, tokens: Iterable[str] = ()) -> Saw:
    """Say what `heard`, all that came after a bare Enter, is; `tokens` are the prompts that are known."""
    heard = without_escapes(heard)
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
    gap_s: float | None = None,
    wake: Wake | None = None,
    on_wake: Callable[[], None] = lambda: None,
) -> BaudFinding:
    """Send one bare Enter over `link`, which is open at `baud`, and say what came within `listen_s`.

    What had arrived before counts as well: a dish that boots talks unasked. Where a prompt answers, `?` is asked too,
    and once more after `gap_s` where that brings nothing: some consoles lose a line that comes too soon. None: after
    as long as any console that is spoken here may need.
    `on_wake` is called when `wake` is set; it clears it, and may raise to end the wait. Raises LinkError when the port
    is gone.
    """
    began, pause_s = clock.monotonic(), longest_gap_s() if gap_s is None else gap_s

    def ask(line: bytes, seconds: float) -> bytes:
        """Send a line, and return what comes until a prompt stands, or until the time is over."""
        link.write(line)
        heard, until, last = b"", clock.monotonic() + seconds, clock.monotonic()
        while clock.monotonic() < until:
            stands = _standing(heard)
            quiet_at = min(until, last + QUIET_S) if stands else until
            if clock.monotonic() >= quiet_at:
                break
            outcome = clock.wait(link, quiet_at, wake)
            if outcome is WaitOutcome.INTERRUPTED:
                on_wake()
            elif outcome is WaitOutcome.READY:
                heard, last = heard + link.read(), clock.monotonic()
                if len(heard) > KEPT:
                    break
        return heard

    def leave_alone(seconds: float) -> None:
        until = clock.monotonic() + seconds
        while clock.monotonic() < until:
            if clock.wait(link, until, wake) is WaitOutcome.INTERRUPTED:
                on_wake()
            link.read()

    heard = ask(ENTER, listen_s)
    saw, prompt, listed, text = judge(heard, tokens), _standing(heard), frozenset[str](), heard
    if saw is Saw.PROMPT and prompt:
        told = ask(HELP, HELP_S)
        if not told:
            # The prompt may have answered the program before this one, at another rate: only an Enter of ours tells.
            heard = text = ask(ENTER, listen_s)
            saw, prompt = judge(heard, tokens), _standing(heard)
            if pause_s and saw is Saw.PROMPT and prompt:
                leave_alone(pause_s)
                told = ask(HELP, HELP_S)
        text += told
        listed = commands(line for line in _readable(text[len(heard) :]).splitlines() if line.strip() != prompt)
    waited_s = round(clock.monotonic() - began, 3)
    return BaudFinding(baud, saw, _sample(heard), len(heard), waited_s, prompt, listed, _readable(text))


def overhear(
    link: Port, clock: Clock, baud: int, *, tokens: Iterable[str] = (), listen_s: float, told: Callable[[str], bool]
) -> BaudFinding:  # fmt: skip
    """Send nothing, and say what comes within `listen_s`; ends sooner when `told` says so. LinkError without a port."""
    began = clock.monotonic()
    heard = b""
    while clock.monotonic() < began + listen_s and not told(_readable(heard)):
        if clock.wait(link, began + listen_s, None) is WaitOutcome.READY:
            heard = (heard + link.read())[:KEPT]
    return finding_of(baud, heard, clock.monotonic() - began, tokens)


def finding_of(baud: int, heard: bytes, waited_s: float, tokens: Iterable[str] = ()) -> BaudFinding:
    """Return what was heard in a time, judged; nothing was asked in answer to it."""
    return BaudFinding(
        baud, judge(heard, tokens), _sample(heard), len(heard), round(waited_s, 3), text=_readable(heard)
    )  # fmt: skip


def _standing(heard: bytes) -> str:
    """Return the prompt that stands at the end; empty if none does."""
    found = _STANDS.search(_readable(heard))
    return found[0].strip() if found else ""


def _readable(heard: bytes) -> str:
    """Return what came as text: unreadable bytes as dots, control sequences left out."""
    return "".join(chr(byte) if 0x20 <= byte < 0x7F or byte in b"\r\n" else "." for byte in without_escapes(heard))


def _sample(heard: bytes) -> str:
    text = re.sub(rb"[\r\n\t]+", b" ", without_escapes(heard)).strip()
    return "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in text[:SAMPLE])

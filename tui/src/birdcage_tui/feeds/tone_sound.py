"""A tone through the sound system: PCM that is made here, piped into the system's own player, on a thread of its own.

A player that dies, hangs or is not there never holds up the app: the next one is tried, and at last `trouble` says why.
"""

from __future__ import annotations

import array
import contextlib
import math
import os
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from birdcage.base.text import clean

if TYPE_CHECKING:
    import subprocess

RATE = 22_050
"""Samples a second; each is a signed 16-bit number, little-endian, one channel."""
BLOCK = RATE // 50
LEAD_BYTES = 2 * RATE * 60 // 1000
"""So much waits in the pipe at most: 60 ms, besides what the player holds."""
TURN_S = 0.01
HOLD_S = 0.5
"""A pitch that is not renewed for so long ends: an app that stalls is silent."""
HANGS_S = 3.0
"""A player that takes nothing for so long is given up."""
CLOSE_S = 0.5
LOUDNESS = 9_000.0
RAMP = LOUDNESS / (0.008 * RATE)
"""Loudness a sample: from silence to full in 8 ms, so that nothing clicks."""
GLIDE = 1.0 / (0.015 * RATE)
"""Part of the way to a new pitch a sample: most of it in 15 ms."""
PLAYERS: Sequence[Sequence[str]] = (
    ("pacat", "--playback", "--raw", f"--rate={RATE}", "--channels=1", "--format=s16le", "--latency-msec=60",
     "--client-name=birdcage"),
    ("aplay", "-q", "-t", "raw", "-f", "S16_LE", "-c", "1", "-r", str(RATE), "--buffer-time=80000"),
    ("play", "-q", "--buffer", "1024", "-t", "raw", "-r", str(RATE), "-e", "signed", "-b", "16", "-c", "1", "-L", "-"),
)  # fmt: skip
"""Of PulseAudio and PipeWire, of ALSA, of SoX: each plays what comes in on its standard input."""


class Sound(Protocol):
    """Plays a tone. No call waits but `close`, and that not long."""

    @property
    def trouble(self) -> str:
        """Why there is no sound, in sentences; empty while there is, or before it was tried."""

    def play(self, pitch_hz: float | None) -> None:
        """Play this pitch from now on, or be silent with None; renew it often."""

    def close(self) -> None:
        """End it. It may be played again."""


class Oscillator:
    """A sine whose phase never jumps: pitch and loudness glide."""

    def __init__(self) -> None:
        self._phase = self._loudness = 0.0
        self._hz = 0.0

    def block(self, pitch_hz: float | None, count: int = BLOCK) -> bytes:
        """Return the next samples."""
        want, loud = (self._hz, 0.0) if pitch_hz is None else (pitch_hz, LOUDNESS)
        hz, loudness, phase = self._hz if self._loudness else want, self._loudness, self._phase
        samples, turn = array.array("h"), 2.0 * math.pi / RATE
        for _ in range(count):
            hz += (want - hz) * GLIDE
            loudness = min(loud, loudness + RAMP) if loudness < loud else max(loud, loudness - RAMP)
            phase += hz * turn
            samples.append(int(loudness * math.sin(phase)))
        self._hz, self._loudness, self._phase = hz, loudness, phase % (2.0 * math.pi)
        if sys.byteorder == "big":
            samples.byteswap()
        return samples.tobytes()


class PipedSound:
    """`players`: command lines, the best first."""

    def __init__(self, players: Sequence[Sequence[str]], hangs_s: float = HANGS_S) -> None:
        self._players, self._hangs_s = players, hangs_s
        self._pitch_hz: float | None = None
        self._until = 0.0
        self._trouble = ""
        self._lock = threading.Lock()
        self._over = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def trouble(self) -> str:
        """Why no player plays; `close` forgets it."""
        return self._trouble

    def play(self, pitch_hz: float | None) -> None:
        """Play it for `HOLD_S`; the first call starts a player."""
        with self._lock:
            self._pitch_hz, self._until = pitch_hz, time.monotonic() + HOLD_S
            if self._thread is None and not self._trouble:
                self._over = threading.Event()
                self._thread = threading.Thread(target=self._run, args=(self._over,), name="tone", daemon=True)
                self._thread.start()

    def close(self) -> None:
        """End the player, and wait for that a short time."""
        with self._lock:
            thread, self._thread, self._trouble = self._thread, None, ""
            self._over.set()
        if thread is not None:
            thread.join(CLOSE_S)

    def _run(self, over: threading.Event) -> None:
        trouble = "No player was found."
        for words in self._players:
            try:
                trouble = self._play_with(words, over)
            except OSError as error:
                trouble = f"{words[0]} can't be started ({error.strerror})."
            if over.is_set():
                return
        with self._lock:
            self._trouble = trouble

    def _play_with(self, words: Sequence[str], over: threading.Event) -> str:
        """Feed a player until all is over; return why it was given up."""
        import subprocess  # when somebody listens: a face paints without them
        import tempfile

        with tempfile.TemporaryFile() as said, subprocess.Popen(  # noqa: S603 - one of the players above
            list(words), stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said, start_new_session=True,
        ) as player:  # fmt: skip
            try:
                why = self._feed(player, over)
                if not over.is_set() and why == "ended":
                    player.wait(CLOSE_S)
                    said.seek(0)
                    last = said.read(2000).decode(errors="replace").strip().splitlines()
                    why = f"ended: {clean(last[-1])[:80]}" if last else why
                return f"{words[0]} {why}."
            finally:
                # Killed and not asked: what is in its buffer is no level any more.
                player.kill()
                assert player.stdin is not None, "it was piped"
                with contextlib.suppress(OSError):
                    player.stdin.close()

    def _feed(self, player: subprocess.Popen[bytes], over: threading.Event) -> str:
        assert player.stdin is not None, "it was piped"
        pipe, oscillator, waiting = player.stdin.fileno(), Oscillator(), b""
        os.set_blocking(pipe, False)
        took_at, before = time.monotonic(), 0
        while not over.wait(TURN_S):
            if player.poll() is not None:
                return "ended"
            now, backlog = time.monotonic(), _bytes_in(pipe)
            if backlog < before or not backlog:
                took_at = now
            elif now > took_at + self._hangs_s:
                return f"takes no sound for {self._hangs_s:g} s"
            while backlog < LEAD_BYTES:
                waiting = waiting or oscillator.block(self._pitch_hz if now < self._until else None)
                try:
                    count = os.write(pipe, waiting)
                except BlockingIOError:
                    break
                except OSError:
                    return "ended"
                waiting, backlog = waiting[count:], backlog + count
            before = backlog
        return ""


def _bytes_in(pipe: int) -> int:
    """Return how many bytes wait in a pipe: Linux tells that at either end."""
    import fcntl
    import struct
    import termios

    told: bytes = fcntl.ioctl(pipe, termios.FIONREAD, struct.pack("i", 0))
    return int(struct.unpack("i", told)[0])


def why_no_sound(environ: Mapping[str, str], which: Callable[[str], str | None]) -> str:
    """Return why the bell is all there is here; empty where a player may be tried."""
    if environ.get("SSH_CONNECTION") or environ.get("SSH_TTY"):
        return "Over ssh"
    if sys.platform != "linux":
        return "On this system"
    return "" if any(which(words[0]) for words in PLAYERS) else "Without pacat, aplay or play"


def find_sound(environ: Mapping[str, str], which: Callable[[str], str | None]) -> tuple[Sound | None, str]:
    """Return what plays here, or None and why there is only the bell."""
    why = why_no_sound(environ, which)
    if why:
        return None, why
    return PipedSound([words for words in PLAYERS if which(words[0])]), ""

"""The key storm through a real terminal: bytes in bursts, into the installed app over a simulated dish."""

from __future__ import annotations

import random
import time
from threading import Event

from birdcage.base.geometry import shortest_turn
from pty_dish import PtyDish
from pty_terminal import BOUND_S, PtyTerminal

LETTERS = [bytes([code]) for code in range(0x21, 0x7F)]
NAMED = [
    *(b"\r", b"\r", b"\x1b", b"\t", b"\x7f", b":", b";", b"?", b"g", b"H", b"y"),
    *(b"\x1b[" + each for each in (b"A", b"B", b"C", b"D", b"H", b"F", b"Z", b"5~", b"6~", b"3~")),
    *(b"\x1bO" + each for each in (b"P", b"Q", b"R", b"S")),
    *(b"\x1b[%d~" % number for number in (15, 17, 18, 19, 20, 21)),
]
CONTROL = [bytes([code]) for code in range(1, 27) if code not in (0x03, 0x11, 0x13)]
"""Ctrl+letters, but for Ctrl+C, which is pressed apart, Ctrl+Q, the way out, and Ctrl+S, which is the terminal's."""
MOUSE = [b"\x1b[<0;%d;%dM", b"\x1b[<0;%d;%dm", b"\x1b[<64;%d;%dM"]
OVERSHOOT_DEG = 0.3
"""A STOP that is sent again has the same target, which a dish comes to rest beside."""


def storm(seed, keys, folder):
    """Press so many keys, in bursts; return the exit status after Ctrl+Q."""
    (folder / "birdcage.toml").write_text('[place]\nname = "Bench"\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n')
    dish = PtyDish(f"seed={seed}")
    app = PtyTerminal("birdcage-tui", "--port", dish.path, "--firmware", "g2", env={"BIRDCAGE_HOME": str(folder)})
    try:
        app.wait_for(b"IDLE")
        blown = TerminalStorm(seed, app, dish, folder)
        while blown.pressed < keys:
            blown.gust()
        app.press(b"\x11")
        return app.status()
    finally:
        app.close()
        dish.close()


class TerminalStorm:
    """Writes to the terminal; after each gust STOP, and nothing turns until it is let go.

    `home` is the app's folder: HELD is a file there.
    """

    def __init__(self, seed: int, app, dish, home) -> None:
        self.rng, self.app, self.dish, self.home = random.Random(seed), app, dish, home
        self.pressed = 0

    def gust(self) -> None:
        """Some writes of keys, then Ctrl+C: HELD, the dish comes to rest and stays there; then out, and let go."""
        for _ in range(self.rng.randrange(3, 8)):
            keys = [self._key() for _ in range(self.rng.choice((1, 1, 2, 3, 6, 12)))]
            self.pressed += len(keys)
            self.app.press(b"".join(keys))
        self.app.press(b"\x03")
        self.pressed += 1
        self.until(lambda: not self.app.unread, "it reads no keys")
        self._asked_again()  # Ctrl+C was STOP then. Another key may have held the dish before.
        self.until(self.is_held, "Ctrl+C was no STOP")
        self.dish.wait_for(lambda truth: not truth.moving)
        rests = self.dish.device.truth()
        for _ in range(6):  # out of what lies over the page: one Esc a write, as together they may be another key
            self.app.press(b"\x1b")
            Event().wait(0.15)
        self.dish.wait_for(lambda truth: not truth.moving)  # where the app has not seen it at rest, Esc was STOP
        here = self.dish.device.truth()
        turned_deg = max(abs(shortest_turn(rests.az_deg, here.az_deg)), abs(here.el_deg - rests.el_deg))
        assert turned_deg < OVERSHOOT_DEG, f"after {self.pressed} keys it was turned by {turned_deg:.2f} deg while held"
        assert self.is_held(), f"after {self.pressed} keys: Esc has let go of HELD"
        self.until(self._let_go, "Enter does not let go")

    def _asked_again(self) -> None:
        """Wait until the app has asked the dish twice more."""
        lines = len(self.dish.lines())
        self.until(lambda: len(self.dish.lines()) >= lines + 2, "the dish is not asked")

    def _let_go(self) -> bool:
        self.app.press(b"\x1b")  # while it may still move, Esc has stopped it, and closed nothing
        Event().wait(0.2)
        self.app.press(b"\x1bOP\r")
        Event().wait(0.3)
        return not self.is_held()

    def is_held(self) -> bool:
        return any(self.home.rglob("held.json"))

    def until(self, what, words: str) -> None:
        end = time.monotonic() + BOUND_S
        while not what():
            assert self.app.process.poll() is None, (
                f"after {self.pressed} keys the app has ended: {self.app.text[-2000:]}"
            )
            assert time.monotonic() < end, f"after {self.pressed} keys: {words}\n{self.app.text[-3000:]}"
            Event().wait(0.05)

    def _key(self) -> bytes:
        kind = self.rng.random()
        if kind < 0.05:
            return self.rng.choice(MOUSE) % (self.rng.randrange(1, 100), self.rng.randrange(1, 30))
        return self.rng.choice(LETTERS if kind < 0.5 else CONTROL if kind < 0.6 else NAMED)

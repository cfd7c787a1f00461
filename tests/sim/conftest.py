"""A person at a terminal of a simulated dish, on a virtual clock."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pytest
from birdcage.base.clock import VirtualClock, WaitOutcome
from birdcage.sim.port import SimPort, open_port


class Terminal:
    def __init__(self, options: str = "", *, rate: float = 1.0, firmware: str = "g2") -> None:
        self.clock = VirtualClock()
        self.clock.rate = rate
        self.port: SimPort = open_port(f"{firmware}?{options}" if options else firmware, clock=self.clock)
        self.device = self.port.device

    def listen(self, seconds: float) -> str:
        """Everything that arrives within so many seconds."""
        heard = b""
        end = self.clock.monotonic() + seconds
        while self.clock.wait(self.port, end) is WaitOutcome.READY:
            heard += self.port.read()
        return heard.decode("latin-1")

    def type(self, text: str) -> None:
        self.port.write(text.encode("latin-1"))

    def ask(self, line: str, prompt: str = "", *, within: float = 20.0) -> str:
        """Type a line and read to the prompt (to silence without one)."""
        self.type(line + "\r")
        if not prompt:
            return self.listen(1.0)
        heard = ""
        end = self.clock.monotonic() + within
        while not heard.endswith(prompt):
            assert self.clock.wait(self.port, end) is WaitOutcome.READY, f"no {prompt} after {line!r}: {heard!r}"
            heard += self.port.read().decode("latin-1")
        return heard

    def angles(self) -> tuple[float, float]:
        lines = self.ask("a", "MOT>").splitlines()
        return float(lines[1].removeprefix("Angle[0] = ")), float(lines[2].removeprefix("Angle[1] = "))

    @property
    def now(self) -> float:
        return self.clock.monotonic()


@pytest.fixture
def terminal() -> Callable[..., Terminal]:
    return Terminal


@pytest.fixture
def hal() -> Callable[..., Terminal]:
    """A terminal of a simulated Trav'ler with HAL 2.05."""
    return partial(Terminal, firmware="hal205")


@pytest.fixture
def carryout() -> Callable[..., Terminal]:
    """A terminal of a simulated Carryout of 2003."""
    return partial(Terminal, firmware="carryout")

"""The command line on the stand-in dish, all in one thread on a virtual clock: words in, sentences and deeds out."""

from __future__ import annotations

import signal
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module

import pytest
from birdcage.base import clock as clocks
from birdcage.base.clock import VirtualClock
from birdcage.cli import dish as dishes
from birdcage.cli import talk
from birdcage.cli.app import cli
from birdcage.link import opening
from birdcage.pursuit.desk import PursuitDesk
from birdcage.station.session import Session
from click import testing

from .dish import StandIn
from .habits import Habits
from .ports import MemoryPort

SLICE_S = 0.1
INTERRUPT_S = 0.5
LONGEST_S = 3600.0
"""How long a command may take before the test counts it as hanging."""


@dataclass(frozen=True)
class Said:
    """What a command printed and ended as."""

    words: tuple[str, ...]
    code: int
    out: str
    err: str
    crash: BaseException | None

    @property
    def text(self) -> str:
        return self.out + self.err


class Scheme:
    """What `open_link` finds under `standin:`, as it finds a package's entry point."""

    def __init__(self, dish: StandIn) -> None:
        self._dish = dish

    def load(self):
        return lambda address, *, clock, baud: MemoryPort(self._dish, f"standin:{address}", baud)


class Terminal:
    """One dish that stays on, and a person who types one command after the other."""

    port = "standin:dish"

    def __init__(self, patch: pytest.MonkeyPatch, **habits: object) -> None:
        self.clock = VirtualClock()
        self.dish = StandIn(self.clock.monotonic, Habits(**habits))
        self.answers: list[str] = []
        """What is typed when a command asks, a line a second."""
        self._interrupts, self._interrupt_at = False, float("inf")
        self._ends_at = float("inf")
        self._desks: dict[PursuitDesk, float] = {}
        self._arrange(patch)

    def _arrange(self, patch: pytest.MonkeyPatch) -> None:
        import_module("birdcage.station.attached")  # makes a class of RealClock, which is none any more below
        registered = opening._registered
        patch.setattr(opening, "_registered", lambda: registered() | {"standin": Scheme(self.dish)})
        for module in (clocks, dishes):
            patch.setattr(module, "RealClock", lambda: self.clock)
        patch.setattr(Session, "start", lambda session: None)
        patch.setattr(dishes.DishSession, "_next", self._next(dishes.DishSession._next))
        patch.setattr(PursuitDesk, "start", lambda desk: self._desks.update({desk: 0.0}))
        patch.setattr(PursuitDesk, "__init__", self._unthreaded(PursuitDesk.__init__))
        patch.setattr(talk.TypedLines, "__init__", lambda answers, stream: None)
        patch.setattr(talk.TypedLines, "next", lambda answers: self._typed())
        patch.setattr(testing._NamedTextIOWrapper, "isatty", lambda stream: True, raising=False)

    @staticmethod
    def _unthreaded(init):
        return lambda desk, *given, **named: init(desk, *given, **{**named, "threads": False})

    def _next(self, look):
        """Let a slice of time pass where a command would wait for one."""

        def step(dish, hear=None, wait_s=None):
            if self.clock.monotonic() >= self._ends_at:
                raise TimeoutError("the command hangs")
            if self._interrupts and self.dish.moves():
                self._interrupts, self._interrupt_at = False, self.clock.monotonic() + INTERRUPT_S
            if self.clock.monotonic() >= self._interrupt_at:
                self._interrupt_at = float("inf")
                dish.on_signal(signal.SIGINT)
            if dish._events.empty():
                dish.session.step(SLICE_S)
                for desk, due in self._desks.items():
                    if due <= self.clock.monotonic():
                        self._desks[desk] = self.clock.monotonic() + desk.step()
                dish._events.put(Tick())
            return look(dish, hear, *(() if wait_s is None else (wait_s,)))

        return step

    def _typed(self) -> str | None:
        return self.answers.pop(0) if self.answers else None

    def run(self, *words: str, firmware: str = "g2", interrupted: bool = False) -> Said:
        """Type one command; `interrupted`: Ctrl+C soon after the dish has begun to move, if it does."""
        now = self.clock.monotonic()
        self._interrupts, self._interrupt_at = interrupted, float("inf")
        self._ends_at = now + LONGEST_S
        self._desks.clear()
        env = {"BIRDCAGE_PORT": self.port} | ({"BIRDCAGE_FIRMWARE": firmware} if firmware else {})
        result = testing.CliRunner().invoke(cli, list(words), env=env, prog_name="birdcage")
        crash = result.exception
        return Said(
            words, result.exit_code, result.stdout, result.stderr, None if isinstance(crash, SystemExit) else crash
        )

    def wait(self, seconds: float) -> None:
        """No one does anything."""
        self.clock.advance(seconds)
        self.dish.run()

    def run_all(self, commands: Iterable[tuple[str, ...]]) -> list[Said]:
        return [self.run(*words) for words in commands]


class Tick:
    """An event that means nothing: time has passed."""

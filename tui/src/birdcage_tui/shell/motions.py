"""The motions that you ask for: requests to the station, each counted as under way until its end."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from typing import Protocol

from birdcage.station.access import FaceStation
from birdcage.station.requests import (
    AcquireLease,
    BeginTask,
    Goto,
    Home,
    Jog,
    Release,
    ReleaseLease,
    Request,
    Stow,
    TurnSkew,
)

from birdcage_tui.commands.jog import STEPS_DEG
from birdcage_tui.feeds.horizon_book import HorizonBook
from birdcage_tui.feeds.track_feed import TrackFeed
from birdcage_tui.goto.reach import refusal_of
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.view import YOU

Motion = Goto | Jog | TurnSkew | Home | Stow


class MotionHost(Protocol):
    """The app, seen from your motions."""

    station: FaceStation
    horizon: HorizonBook
    track: TrackFeed
    keys: KeyQueue

    def say(self, words: str) -> None:
        """Tell what was done, or why not, in one sentence."""

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""

    def end_tour(self) -> None:
        """Let the demo do nothing by itself any more."""


class Motions:
    """Submits what you ask for, and knows what of it is not at its end."""

    def __init__(self, host: MotionHost) -> None:
        self._host = host
        self.under_way: set[Future[object]] = set()
        """Motions that you asked for and that are not at their end."""
        self.step_deg = 1.0
        """What one press of a jog key is."""
        self._skew_sent: float | None = None
        """Where the skew was sent last."""
        self._skew_turns: set[Future[object]] = set()
        """Its turn, while that is not at its end."""

    def ask(self, request: Request) -> None:
        """Submit a request; if it fails, the sentence of its error is shown."""
        host = self._host

        def done(future: Future[object]) -> None:
            self.under_way.discard(future)
            error = None if future.cancelled() else future.exception()
            if error is not None:
                host.soon(partial(host.say, str(error)))

        state = host.station.state
        pursuit = None if state.holder in (None, YOU) else pursuit_of(state)
        if isinstance(request, Motion) and pursuit is not None and state.holder == pursuit.holder:
            reason = refusal_of(request, state)
            if reason is not None:
                host.say(f"Refused: {reason}")
                return
            request = self._take_back_with(request)
        future = host.station.submit(request)
        if isinstance(request, Motion | BeginTask):
            host.end_tour()
        if isinstance(request, Motion):
            self.under_way.add(future)
            host.horizon.moved(jog=isinstance(request, Jog))
        future.add_done_callback(done)

    def begin_way(self) -> Future[object]:
        """Count a motion of yours that somebody else will submit as under way, until what is returned is done."""
        self._host.end_tour()
        self._host.horizon.moved(jog=False)
        way: Future[object] = Future()
        self.under_way.add(way)
        way.add_done_callback(self.under_way.discard)
        return way

    def _take_back_with(self, request: Motion) -> Motion:
        """Take control from your own pursuit with a motion: that it is by hand is word enough that you want it back.

        The station judges first: a pass that is followed is not left for a motion that it refuses.
        """
        if isinstance(request, Home | Stow):
            self._host.station.submit(AcquireLease(YOU, take_over=True))
            return request
        return replace(request, take_over=True)

    def jog(self, az_steps: float, el_steps: float) -> None:
        """Step from the last commanded target."""
        self.ask(Jog(az_steps * self.step_deg, el_steps * self.step_deg, YOU))

    def jog_skew(self, steps: float) -> None:
        """Step the skew from where it was sent last, so that ten presses are ten steps; within its range."""
        state = self._host.station.state
        here = None if state.position is None else state.position.skew_deg
        sent = self._skew_sent if any(not each.done() for each in self._skew_turns) else state.target_skew_deg
        start = here if sent is None else sent
        if start is None or state.dish is None or state.dish.skew is None:
            self._host.say("The skew is unknown. S turns it to an angle.")
            return
        low, high = state.dish.skew.min_deg, state.dish.skew.max_deg
        self.turn_skew(min(max(start + steps * self.step_deg, low), high))

    def turn_skew(self, deg: float) -> None:
        """Turn the feed about the beam."""
        self._skew_sent = deg
        before = set(self.under_way)
        self.ask(TurnSkew(deg, YOU))
        self._skew_turns = self.under_way - before

    def change_step(self, by: int) -> None:
        """Make a jog step larger or smaller."""
        index = STEPS_DEG.index(self.step_deg) + by
        self.step_deg = STEPS_DEG[min(max(index, 0), len(STEPS_DEG) - 1)]
        self._host.say(f"One step is {self.step_deg:g}°.")

    def resume(self) -> None:
        """Follow again what was interrupted: release first what is held, and go on once that is done."""
        host = self._host
        if host.keys.is_overtaken:
            return
        if host.station.state.held is None:
            self._resume()
            return

        def released(future: Future[object]) -> None:
            error = None if future.cancelled() else future.exception()
            host.soon(self._resume if error is None else partial(host.say, str(error)))

        host.keys.let_go(lambda: host.station.submit(Release(YOU)).add_done_callback(released))

    def _resume(self) -> None:
        source, now = self._host.track.source, self._host.track.now
        if source is None or now is None:
            return
        if self._host.station.state.holder == YOU:
            self.ask(ReleaseLease(YOU))
        if now.resumable is not None:
            source.resume()
        else:
            source.take_up()
        self._host.say("")

"""A day of a station on a virtual clock: several people and programs, and a bad moment now and then."""

from __future__ import annotations

import random

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BirdcageError, LinkError
from birdcage.link.link import Link
from birdcage.link.transcript import Transcript
from birdcage.sim.port import SimPort, open_device
from birdcage.sim.wire import PASS
from birdcage.station import requests as ask
from birdcage.station.raw import CONSOLE
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import Activity
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station

from .fault_mix import FaultMix
from .recorder import Recorder

ADDRESSES = {
    "g2": "g2?root_q=kill&az=-180&el=40",
    "hal205": "hal205?root_q=kill&boot_home_s=20&search_finds=0",
}
REACH = {"g2": (20.0, 64.0), "hal205": (20.0, 85.0)}
REST_DEG = 0.08
"""How far from its target a dish may come to rest: a G2's overshoot, and a step (`docs/reference/g2-motors.md`,
*Overshoot*)."""
FILE_LIMIT, TOTAL_LIMIT = 100_000, 500_000
PEOPLE = ("you", "Gpredict", "satdump")
CALM_S = 40.0
"""After this long without anything a dish at rest was read again, and lines that were owed are given up."""


class Day:
    """One dish, one station, and what happens to them."""

    def __init__(self, firmware: str, seed: int, folder) -> None:
        self.firmware, self.rng = firmware, random.Random(seed)
        self.clock = VirtualClock()
        self.device = open_device(f"{ADDRESSES[firmware]}&seed={seed}", clock=self.clock)
        self.recorder = Recorder(firmware, self.device, self.clock)
        self.tally = self.recorder.tally
        self.transcript = Transcript(folder, version="soak", file_limit=FILE_LIMIT, total_limit=TOTAL_LIMIT)
        self._fault_mix = FaultMix(random.Random(seed + 1))
        self._begin()

    @property
    def now(self) -> float:
        """Seconds since the day began."""
        return self.clock.monotonic() - 1000.0

    @property
    def state(self):
        """What the station says now."""
        return self.station.state

    def _begin(self) -> None:
        settings = StationSettings(port="sim:soak", firmware=self.firmware, open_link=self._open)
        self.station = Station(self.clock, settings)
        self.session = Session(self.clock, self.station)
        self.station.subscribe(self.recorder.hear)
        self.station.submit(ask.Watch("screen", frozenset({"position"}), 0.1))
        if not self._until(lambda: self.state.surveyed, 200.0):
            self.recorder.note(f"it did not come up: {self.state.link}")

    def _open(self, port, baud):
        try:
            sim = SimPort(self.device, port, baud=baud)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error
        return Link(sim, self.clock, self.transcript)

    def _step(self, seconds: float) -> None:
        self.session.step(seconds)

    def _until(self, true, seconds: float) -> bool:
        end = self.clock.monotonic() + seconds
        while not true():
            if self.clock.monotonic() >= end:
                return False
            self._step(0.5)
        return True

    def _do(self, request, seconds: float = 150.0):
        """Ask for something; return its result, or the error."""
        future = self.station.submit(request)
        if not self._until(future.done, seconds):
            self.recorder.note(f"never answered: {request}")
            return None
        error = future.exception(0)
        if error is not None and not isinstance(error, BirdcageError):
            raise error
        return error or future.result(0)

    # The day.

    def until(self, hour: float) -> None:
        """Live on until so many hours of the day have passed."""
        while self.now < hour * 3600.0:
            self.tell_one()
            # It keeps its last ten thousand lines: that is no growth of ours.
            self.device.shell.received.clear()
            self.transcript.flush()

    def tell_one(self) -> None:
        """One thing happens, is put right, and some minutes pass."""
        deeds = {
            self._go: 60, self._change_mind: 8, self._jog: 8, self._stop: 8, self._talk: 6, self._listen: 4,
            self._unplug: 4, self._noise: 6, self._restart_dish: 2, self._restart_program: 2,
        }  # fmt: skip
        deed = self.rng.choices(list(deeds), list(deeds.values()))[0]
        self.tally[deed.__name__.strip("_")] += 1
        deed()
        self._put_right()
        self._step(self.rng.uniform(60.0, 240.0))
        self._look()

    def _look(self) -> None:
        if self.state.activity is not Activity.IDLE or self.state.link.state is not LinkNow.UP:
            self.recorder.note(f"after minutes of peace: {self.state.activity}, {self.state.link}")
        if not self.device.truth().shell_alive:
            self.recorder.note("the shell has died")
        self.recorder.at_rest(self.state, within_deg=REST_DEG)

    def _somewhere(self) -> tuple[float, float]:
        return round(self.rng.uniform(0.0, 359.99), 2), round(self.rng.uniform(*REACH[self.firmware]), 2)

    def _go(self, who: str = "") -> None:
        az_deg, el_deg = self._somewhere()
        who = who or self.rng.choice(PEOPLE)
        told = self._do(ask.Goto(az_deg, el_deg, who))
        if isinstance(told, BirdcageError):
            self.recorder.note(f"a plain motion failed: {told}")
        else:
            self.tally["arrived"] += 1
            self.recorder.at_rest(self.state, commanded=(az_deg, el_deg), within_deg=REST_DEG)
        self._do(ask.ReleaseLease(who))

    def _change_mind(self) -> None:
        first = self.station.submit(ask.Goto(*self._somewhere(), "you"))
        self._step(self.rng.uniform(0.05, 4.0))
        self._go("you")
        if not first.done():
            self.recorder.note("a superseded motion was never answered")

    def _jog(self) -> None:
        self._do(ask.Jog(self.rng.uniform(-3, 3), self.rng.uniform(-0.5, 0.5), "you"))
        self._do(ask.ReleaseLease("you"))

    def _stop(self) -> None:
        future = self.station.submit(ask.Goto(*self._somewhere(), "you"))
        self._step(self.rng.uniform(0.02, 6.0))
        self.station.stop("you")
        self._step(CALM_S)
        if not future.done():
            self.recorder.note("a stopped motion was never answered")
        if self.state.held is None:
            self.recorder.note("STOP does not hold")
        refused = self._do(ask.Goto(*self._somewhere(), "Gpredict"))
        if not isinstance(refused, BirdcageError):
            self.recorder.note("a motion was taken while STOP holds")
        self.recorder.at_rest(self.state, within_deg=REST_DEG)

    def _talk(self) -> None:
        motors = "mot" if self.firmware == "g2" else "motor"
        for line in self.rng.sample(["a", "?", "q", "nvs", motors, "frobnicate", ""], k=5):
            self._do(ask.Raw(line, CONSOLE))
            self._step(self.rng.uniform(0.1, 8.0))
        self._do(ask.ListCommands())
        self._do(ask.ReleaseLease(CONSOLE))

    def _listen(self) -> None:
        """Somebody opens the signal page for a while."""
        if self.state.dish.has_rssi:
            self.station.submit(ask.Watch("signal", frozenset({"rssi", "position"}), 2.0))
            self._step(120.0)
            self.station.submit(ask.Unwatch("signal"))
        self._go()

    def _unplug(self) -> None:
        future = self.station.submit(ask.Goto(*self._somewhere(), "you"))
        self._step(self.rng.uniform(0.02, 6.0))
        self.device.unplug()
        self._step(self.rng.uniform(0.1, 90.0))
        self.device.plug()
        self._until(future.done, 60.0)

    def _noise(self) -> None:
        """Bytes are lost, doubled and replaced for a while, at rest and under way."""
        future = self.station.submit(ask.Goto(*self._somewhere(), "you"))
        self._step(self.rng.uniform(0.02, 6.0))
        self._fault_mix.spell = self.rng.choice(("drizzle", "drizzle", "storm", "silent"))

        def alter(value: int):
            self._fault_mix.begin()
            action = self._fault_mix(value)
            if action is not PASS:
                self.recorder.noise_at = self.clock.monotonic()
            return action

        self.device.wire.to_host.set_plan(alter)
        self._step(self.rng.uniform(1.0, 20.0))
        self.device.wire.to_host.set_plan(None)
        self._until(future.done, 150.0)
        self._step(CALM_S)

    def _restart_dish(self) -> None:
        self.device.reboot()
        self._step(CALM_S)

    def _restart_program(self) -> None:
        self.session.close()
        self._begin()

    def _put_right(self) -> None:
        """Do what a person would, until a plain motion works again."""
        for _ in range(6):
            if not self._until(lambda: self.state.link.state is LinkNow.UP and self.state.surveyed, 240.0):
                continue
            self._step(5.0)
            if self.state.fault is not None:
                self._do(ask.AcknowledgeFault("you"))
            if self.state.held is not None:
                self._do(ask.Release("you"))
            if self.state.homed is False and self.state.dish.homing_s is not None:
                self._do(ask.Home("you"))
            elif self.firmware == "hal205" and self.device.truth().moving:
                self._do(ask.SetSearch("you", disabled=True))
                self._until(lambda: self.state.activity is Activity.IDLE, 20.0)
            self._do(ask.ReleaseLease("you"))
            if self._is_right():
                return
            self.tally["not right yet"] += 1
        self.recorder.note(f"it can't be put right: {self.state}")

    def _is_right(self) -> bool:
        state = self.state
        return (
            state.link.state is LinkNow.UP and state.homed is True and state.held is None and state.fault is None
            and state.activity is Activity.IDLE and state.holder is None
        )  # fmt: skip

    def end(self) -> None:
        """Close the program."""
        self.session.close()
        self.transcript.close()

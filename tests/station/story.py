"""Tells a random story of people, requests and bad days around a console, and says what must hold whatever happens."""

from __future__ import annotations

import random

from birdcage.base.config import Settings
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import CableTurn
from birdcage.station import requests as ask
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.state import MOVING, Activity
from birdcage.station.state import LinkPhase as LinkNow

from .conftest import Bench

LINES = {
    "root": ("", "?", "help", "mot", "mot", "dvb", "step", "adc", "nvs", "os", "q", "stow", "frobnicate", "Mot "),
    "mot": (
        "", "a", "a", "p", "l", "q", "q", "a 0 100", "a 0 250.5", "A  0   300", "a 1 30", "a 1 55", "a 0 +40", "a 1 -5",
        "a 0 9999", "a 1 10", "h 0", "h 1", "h *", "r", "e", "mv", "frobnicate", "help a", "elminmaxhome", " a", "a 0",
    ),
    "step": ("", "mv", "mv 0 1500", "mv 0 7222", "p 0 -20000", "p 1 3500", "v 0 -900", "v 0 900", "v 0 0", "r", "e",
             "q", "q", "frobnicate"),
    "dvb": ("", "agc", "snr", "lnbv", "nid", "rssi 10", "rssi 99", "lnbdc odu", "config", "q", "q", "frobnicate", "m"),
    "adc": ("", "m", "rssi", "scan", "bdid", "q", "q", "scan 0 10"),
    "nvs": ("", "d 20", "d", "e 20", "e 102 60", "e 102 65", "e 20 0", "s", "q", "q", "x"),
    "os": ("", "id", "q", "reboot", "tasks"),
}  # fmt: skip
ANYBODY = ("you", "Gpredict", CONSOLE)
BOUND_S = 300.0
"""Every request is answered within this, whatever else happens: a restart is waited for, for 180 s."""
MOTIONS = {
    "mot": ("a ", "h ", "g ", "e"),
    "step": ("p ", "v ", "e"),
    "root": ("stow", "reboot"),
    "os": ("reboot",),
    "adc": ("scan",),
}
"""What sets the simulated dish in motion, told apart from the driver's own table."""


def is_motion(menu, line):
    words = line.lower().split()
    text = " ".join(words)
    if text in ("e", "stow", "reboot", "scan"):
        return any(text == start for start in MOTIONS.get(menu, ()))
    return any(text.startswith(start) for start in MOTIONS.get(menu, ()) if start != "e")


class Story(Bench):
    """One dish, one station, and everybody who wants something of them."""

    def __init__(self, seed):
        self.rng = rng = random.Random(seed)
        options = [
            f"seed={seed}", "root_q=kill",
            rng.choice(["az_speed=10", "az_speed=10", "az_speed=65"]),
            rng.choice(["stream_key=swallow", "stream_key=keep"]),
            rng.choice(["release_forgets=1", "release_forgets=0"]),
            rng.choice(["unhomed_scan=error", "unhomed_scan=deadlock"]),
            rng.choice(["stow_blocks=0", "stow_blocks=1"]),
            f"nvs20={rng.choice([1, 1, 0])}", f"az={rng.choice([0, -180, -300])}", "el=40",
        ]  # fmt: skip
        self.told, self.asked, self.wrong = [], [], []
        self.may_die = False
        self._serving, self._stopping, self._press = None, False, None
        self._releasing = False
        super().__init__("g2?" + "&".join(options), {"remark": self._note})
        station = self.station
        protocol, desk, talk = station._antenna.rotator.protocol, station._handler, station._raw_console
        interject, serve, tick = protocol.interject, desk.serve, talk.tick

        def interjecting(lines):
            self._stopping = True
            try:
                interject(lines)
            finally:
                self._stopping = False

        def serving(request, future, stops_seen):
            self._serving = request
            self._fresh = talk.holder is None
            try:
                serve(request, future, stops_seen)
            finally:
                self._serving = None

        protocol.interject, desk.serve = interjecting, serving
        self._tick = tick
        self.connect()
        self.watch("position", *(["rssi"] if rng.random() < 0.3 else []), rate_hz=1.0)
        self.step(rng.choice([0.5, 6]))
        if rng.random() < 0.5:
            self.do(ask.Home("you"), 60)
            self.do(ask.ReleaseLease("you"))

    def _note(self, text):
        self.told.append(f"{self.clock.monotonic():9.3f} # {text}")

    def _open(self, port, baud):
        link = super()._open(port, baud)
        sim = self.opened[-1]
        write = sim.write

        def writing(data):
            self._judge_bytes(data)
            write(data)
            if self._press is not None and not self._stopping:
                press, self._press = self._press, None
                press()

        sim.write = writing
        return link

    def _judge_bytes(self, data):
        """Look at every byte that leaves, with the eyes of the dish."""
        now, station = self.clock.monotonic(), self.station
        lines = data.decode("ascii").replace("\n", "").split("\r")
        menu, serving = self.device.shell.menu, self._serving
        self.told.append(f"{now:9.3f} > {lines[:-1]} in {menu}{' STOP' if self._stopping else ''} for {serving}")
        if self._stopping:
            return
        for line in lines[:-1]:
            if station._control.latched and is_motion(menu, line):
                self.wrong.append(f"{now:.3f} motion while latched: {line!r} in {menu}")
            if line.strip().lower() == "q" and menu == "root" and self.device.shell._script is None:
                typed = (
                    isinstance(serving, ask.Raw)
                    and serving.confirmed is Grade.RUINS
                    and serving.line.strip().lower() == "q"
                )
                if not typed:
                    self.wrong.append(f"{now:.3f} q at the root for {serving}")
                self.may_die = True
            if line.startswith("scan") and not self.device.truth().homed:
                self.may_die = True
            if not self._was_asked(line):
                self.wrong.append(f"{now:.3f} nobody typed {line!r}, sent in {menu} for {serving}")

    def _was_asked(self, line):
        """Whether somebody asked for these bytes, while a person talks."""
        state, serving = self.state, self._serving
        talks = state.holder == CONSOLE and self.station._raw_console.holder == CONSOLE
        if not talks or not line.strip() or state.activity in MOVING or state.link.state is not LinkNow.UP:
            return True
        if serving is None or isinstance(serving, ask.AcquireLease):
            homes = any(task.kind == "homing" and task.holder == CONSOLE for task in state.tasks)
            return homes or (self._fresh and isinstance(serving, ask.AcquireLease))
        if isinstance(serving, ask.Raw):
            return line == serving.line or line == serving.line.strip() or (self._fresh and line in ("q", "mot"))
        if isinstance(serving, ask.ListCommands):
            return line in ("?", "man") or (self._fresh and line in ("q", "mot"))
        return True  # what another request sends is its own business

    # What happens.

    def ask(self, request):
        self._note(f"ask {request}")
        self.asked.append((self.clock.monotonic(), request, self.station.submit(request)))

    def stop(self):
        self._note("STOP")
        self.station.stop("you")

    def act(self):
        rng = self.rng
        menu = self.device.shell.menu
        what = rng.random()
        if what < 0.45:
            line = rng.choice(LINES.get(menu if rng.random() < 0.9 else rng.choice(list(LINES)), ("",)))
            self.ask(ask.Raw(line, CONSOLE, confirmed=rng.choices(list(Grade), (15, 5, 10, 70))[0]))
        elif what < 0.48:
            self.ask(ask.ListCommands())
        elif what < 0.56:
            who = rng.choice(ANYBODY)
            self.ask(rng.choice([
                ask.Goto(rng.uniform(0, 359), rng.uniform(20, 64), who), ask.Jog(rng.uniform(-9, 9), 0.5, who),
                ask.Home(who, rng.choice([(), (0,), (1,)])),
            ]))  # fmt: skip
        elif what < 0.60:
            self.stop()
        elif what < 0.63:
            self._press = self.stop  # right after the next bytes, whosever they are
        elif what < 0.70:
            self.ask(ask.AcknowledgeFault("you"))
            self.ask(ask.Release("you"))
        elif what < 0.74:
            self.ask(ask.ReleaseLease(rng.choice(ANYBODY)))
        elif what < 0.78:
            self.ask(ask.AcquireLease(rng.choice(ANYBODY), rng.random() < 0.6))
        elif what < 0.84:
            who = rng.choice(ANYBODY)
            self.ask(rng.choice([
                ask.ReleaseMotors(who), ask.Engage(who), ask.Stow(who), ask.SetSpeed(0, rng.choice([5.0, 60.0]), who),
                ask.ApplySettings(Settings(), "you"), ask.SetSearch(who, disabled=rng.random() < 0.8),
            ]))  # fmt: skip
        elif what < 0.86:
            self.ask(rng.choice([ask.ProbePort(), ask.Connect("sim:test", None)]))
        elif what < 0.92:
            self._bad_day()
        self.step(rng.choice([0.0, 0.003, 0.02, 0.1, 0.5, 0.5, 2.0, 2.0, 8.0, 35.0]))

    def _bad_day(self):
        rng, device = self.rng, self.device
        self._note(what := rng.choice(["unplug", "reboot", "garble", "silent", "garble"]))
        match what:
            case "unplug":
                device.unplug()
                self.step(rng.choice([0.1, 1.0, 5.0]))
                device.plug()
            case "reboot":
                device.reboot()
            case "garble":
                device.wire.to_host.garble = rng.choice([0.005, 0.05, 0.5])
                self.step(rng.choice([0.05, 0.3, 2.0]))
                device.wire.to_host.garble = 0.0
            case "silent":
                device.wire.to_host.silent = True
                self.step(rng.choice([0.05, 0.3, 3.0]))
                device.wire.to_host.silent = False

    def tell(self, acts=20):
        for _ in range(acts):
            self.act()
            self.check_meanwhile()
        self.end()

    # What must hold.

    def check_meanwhile(self):
        now = self.clock.monotonic()
        for asked, request, future in self.asked:
            if not future.done() and now - asked > BOUND_S:
                self.wrong.append(f"{now:.3f} no answer to {request} of {asked:.3f}")
        self.asked = [each for each in self.asked if not each[2].done()]

    def end(self):
        """Everybody leaves; a person stops the dish; it falls quiet, and what the board says must be true."""
        self._press = None
        self._note("the end begins")
        self.stop()
        self.step(BOUND_S)
        self.check_meanwhile()
        self.wrong += [f"never answered: {request}" for _, request, future in self.asked if not future.done()]
        truth, state = self.device.truth(), self.state
        if not truth.shell_alive:
            if not self.may_die:
                self.wrong.append("the shell has died")
            return
        if state.link.state is not LinkNow.UP:
            self.wrong.append(f"the link did not come back: {state.link}")
            return
        if state.holder == CONSOLE or self.station._raw_console.holder is not None or self.station._monitor.paused:
            self.wrong.append(f"the talk has not ended: {state.holder}")
        if truth.moving:
            # A search of the dish's own after a restart, and what must not be stopped.
            if state.activity is Activity.IDLE and state.position_lost is None and not self._searches():
                self.wrong.append("the dish moves and the board says that it rests")
            return
        if state.raw_motion or state.activity in MOVING:
            self.wrong.append(f"the dish rests and the board says {state.activity} {state.activity_text!r}")
        self._compare(truth, state)

    def _searches(self):
        return not self.device.board.nvram.active[20]

    def _compare(self, truth, state):
        position = state.position
        if position is None or state.position_lost is not None:
            return
        off = abs(shortest_turn(position.dish_az_deg, truth.az_deg)), abs(position.dish_el_deg - truth.el_deg)
        if max(off) > 0.1:
            self.wrong.append(f"the board says {position}, the truth is {truth}")
        if state.turn is CableTurn.COUNTED and abs(position.cable_deg - truth.cable_deg) > 0.5:
            self.wrong.append(f"the cable is counted {position.cable_deg}, and is {truth.cable_deg}")

"""A stand-in station with states to show, and the app around it, on a virtual clock."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from types import MappingProxyType

import setup_stand_in
from birdcage.base.beam import Beam
from birdcage.base.clock import VirtualClock
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.protocol.menu_raw import MenuRaw
from birdcage.protocol.registry import get_protocol
from birdcage.rotator.facts import CableTurn
from birdcage.rotator.feature import Reading
from birdcage.rotator.ladder import StopMeans
from birdcage.setup.tally import StepTally
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.menu_commands import MenuCommands
from birdcage.station.state import (
    Activity,
    Fault,
    FaultReason,
    HeldState,
    LinkPhase,
    LinkState,
    Motion,
    Pointing,
    StationState,
    StopReport,
    TvSearch,
)
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import SignalSample, is_moving

PROTOCOL = get_protocol("g2")
PLACE = SitePlace(40.4, -95.0, "EN10")


class Station:
    """Notes what is asked of it."""

    def __init__(self, state):
        self.state = state
        self.asked, self.stops, self.listeners = [], [], []
        self.steering = False

    def submit(self, request):
        self.asked.append(request)
        return Future()

    def judge(self, line):
        return PROTOCOL.judge(line, self.state.menu, homed=self.state.homed)

    has_prompt = True

    def only_asks(self, line, prompt):
        return PROTOCOL.only_asks(line, prompt)

    def says_target(self, text):
        return PROTOCOL.says_target(text)

    def is_prompt(self, text):
        return MenuRaw(PROTOCOL).is_prompt(text)

    def is_steering(self):
        return self.steering and self.state.held is None

    def commands(self, menu):
        return MenuCommands(MenuRaw(PROTOCOL)).of(menu)

    def own_signal(self, source, holder):
        owners = {**self.state.signal_owners, source: holder}
        self.state = replace(self.state, signal_owners={name: by for name, by in owners.items() if by})

    def stop(self, by, *, leaving=False):
        self.stops.append(by)

    def subscribe(self, listener, *_kinds):
        self.listeners.append(listener)
        return lambda: self.listeners.remove(listener)

    def asked_for(self, kind):
        return [request for request in self.asked if isinstance(request, kind)]


class Session:
    def __init__(self, state, clock):
        self.clock, self.station = clock, Station(state)
        self.started = self.closed = self.barred = 0
        self.wire = None
        self.crash = None
        self.via, self.detached = "", False

    def bar(self):
        self.barred += 1
        return is_moving(self.station.state)

    def leave(self, by):
        self.station.stop(by, leaving=True)

    def start(self):
        self.started += 1

    def on_wire(self, listener):
        self.wire = listener
        return lambda: None

    def close(self):
        self.closed += 1
        return "The dish's position is not known."


def at_rest(clock):
    """A homed, simulated G2 that answers, and rests on 101°W."""
    now, utc = clock.monotonic(), clock.utc()
    return StationState(
        link=LinkState(LinkPhase.UP, now - 60, now - 0.2, 0.012),
        port="sim:g2",
        demo=True,
        dish=CARRYOUT_G2,
        unplanned_stop=StopMeans.RETARGET,
        firmware_version="02.02.48",
        position=Pointing(189.16, 42.87, 189.16, 42.87, now - 0.2, utc, -120.0),
        target_az_deg=189.16,
        target_el_deg=42.87,
        activity=Activity.IDLE,
        homed=True,
        search=TvSearch.OFF,
        turn=CableTurn.COUNTED,
        feed_name="Ku LNB",
        beam=Beam(2.6, 2.6),
        el_min_deg=18.0,
        el_max_deg=65.0,
        readings=MappingProxyType(
            {
                "rssi": Reading(512.0, "counts", now - 0.4, utc),
                "nvs.20": Reading("TRUE", "", now - 50, utc),
            }
        ),
    )


def slewing(clock):
    state, now = at_rest(clock), clock.monotonic()
    return replace(
        state,
        motion=Motion(231.0, 25.0, 160.7, 40.21, now - 0.6, now + 0.62, 0.3, StopMeans.RETARGET, az_way_deg=-70.3),
        position=replace(state.position, az_deg=201.3, el_deg=32.9, dish_az_deg=201.3),
        target_az_deg=160.7,
        target_el_deg=40.21,
        activity=Activity.SLEWING,
        holder="you",
    )


def held(clock):
    return replace(
        at_rest(clock),
        held=HeldState("you", clock.monotonic() - 8, clock.utc(), HeldReason.STOP, "Gpredict", 231.4, 44.0, 3),
        last_stop=StopReport("you", clock.monotonic() - 8, "retarget", True, "Stopped."),
        activity=Activity.IDLE,
    )


def lost(clock):
    state, now = slewing(clock), clock.monotonic()
    return replace(
        state,
        link=LinkState(
            LinkPhase.LOST, now - 7, now - 7.3, 0.012, "/dev/ttyUSB0 is not there. Plug it in; birdcage keeps looking."
        ),
        position=replace(state.position, at=now - 7.3),
        port="/dev/ttyUSB0",
        demo=False,
        homed=None,
    )


def silent(clock):
    now = clock.monotonic()
    link = LinkState(
        LinkPhase.SILENT, now - 4, now - 6, None, "no prompt: power off, cable out at the dish, or deadlocked"
    )
    return replace(at_rest(clock), link=link, position=None, homed=None, demo=False, port="/dev/ttyUSB0")


def not_homed(clock):
    return replace(
        at_rest(clock),
        homed=False,
        position=None,
        position_lost=Reason.UNHOMED,
        turn=CableTurn.UNKNOWN,
        target_az_deg=None,
        target_el_deg=None,
    )


def opening(clock):
    link = LinkState(LinkPhase.OPENING, clock.monotonic() - 1)
    return StationState(link=link, port="/dev/ttyUSB0", turn=CableTurn.UNKNOWN)


def fault(clock):
    return replace(
        at_rest(clock),
        fault=Fault(
            FaultReason.STALL,
            "Azimuth stalled at 203.1°.",
            "Something holds the dish, or a stop was hit; its steps may be lost.",
            "Clear its swing, then home it.",
            clock.utc(),
        ),
        holder=None,
    )


def late(clock):
    state, now = at_rest(clock), clock.monotonic()
    return replace(
        state, link=replace(state.link, last_reply=now - 2.3), position=replace(state.position, at=now - 2.3)
    )


def refused(clock):
    return replace(at_rest(clock), motion_refused_because="birdcage.toml line 7, motion.el_min_deg: not a number.")


def travler(clock):
    """A simulated Trav'ler at rest: no tuner, no turn of the cable, a third axis."""
    now, utc = clock.monotonic(), clock.utc()
    return replace(
        at_rest(clock),
        link=LinkState(LinkPhase.UP, now - 60, now - 0.2, 0.021),
        port="sim:hal205",
        dish=TRAVLER,
        unplanned_stop=StopMeans.WAIT,
        firmware_version=None,
        position=Pointing(189.16, 42.87, 189.16, 42.87, now - 0.2, utc, None, 45.0),
        target_skew_deg=45.0,
        search=TvSearch.OFF_UNTIL_POWER_UP,
        turn=CableTurn.UNKNOWN,
        homed=True,
        el_min_deg=15.0,
        el_max_deg=90.0,
        readings=MappingProxyType(
            {"nvs.125": Reading("15", "", now - 50, utc), "nvs.127": Reading("15", "", now - 50, utc)}
        ),
    )


def travler_slew(clock):
    """In a silent slew: nothing is read, the position is computed."""
    state, now = travler(clock), clock.monotonic()
    return replace(
        state,
        motion=Motion(
            231.0, 25.0, 160.7, 40.21, now - 4.6, now + 7.1, 0.4, StopMeans.ABORT, az_way_deg=-70.3, stop_proven=True
        ),
        position=replace(
            state.position,
            az_deg=201.3,
            el_deg=32.9,
            dish_az_deg=201.3,
            at=now,
            modelled=True,
            uncertainty_deg=9.8,
            read_at=now - 4.6,
        ),
        target_az_deg=160.7,
        target_el_deg=40.21,
        activity=Activity.SLEWING,
        holder="you",
    )


def travler_step(clock):
    """In a queued move of one axis, which nothing calls back."""
    state, now = travler(clock), clock.monotonic()
    return replace(
        state,
        motion=Motion(
            189.16, 42.87, 193.0, 42.87, now - 0.6, now + 9.2, 3.2, StopMeans.WAIT, rests_at=now + 3.2, az_way_deg=3.84
        ),
        target_az_deg=193.0,
        activity=Activity.SLEWING,
        holder="you",
    )


def travler_skew(clock):
    """Turning the feed."""
    state, now = travler(clock), clock.monotonic()
    return replace(
        state,
        motion=Motion(189.16, 42.87, 189.16, 42.87, now - 2.6, now + 5.2, 5.2, StopMeans.WAIT, 110.0, now + 5.2, 0.0),
        target_skew_deg=110.0,
        activity=Activity.SLEWING,
        holder="you",
    )


def travler_search(clock):
    """Just switched on: its TV search moves it."""
    return replace(travler(clock), search=TvSearch.RUNNING, activity=Activity.MOVING_UNASKED, target_skew_deg=None)


def travler_unread(clock):
    """Not homed: only switching it off and on homes it."""
    state = travler(clock)
    return replace(
        state, homed=False, position=None, position_lost=Reason.UNHOMED, target_az_deg=None, target_el_deg=None
    )


STATES = {
    "idle": at_rest,
    "slewing": slewing,
    "held": held,
    "lost": lost,
    "silent": silent,
    "not-homed": not_homed,
    "opening": opening,
    "fault": fault,
    "late": late,
    "refused": refused,
    "travler": travler,
    "travler-slew": travler_slew,
    "travler-step": travler_step,
    "travler-skew": travler_skew,
    "travler-search": travler_search,
    "travler-not-homed": travler_unread,
}


def samples(clock):
    """A sweep over two satellites, as the tuner hears it."""
    from math import exp, sin

    now = clock.monotonic()
    return [
        SignalSample(
            now - 0.4 - age * 0.5,
            480 + 12 * sin(age * 1.7) + 420 * exp(-(((age - 14) / 5) ** 2)) + 260 * exp(-(((age - 52) / 4) ** 2)),
        )
        for age in range(150, -1, -1)
    ]


def app_in(name, *, theme="dusk", tour=False, heard=True, **settings):
    clock = VirtualClock()
    state = STATES[name](clock)
    session = Session(state, clock)
    settings.setdefault("setup", setup_stand_in.Engine)
    settings = AppOptions(theme=theme, place=PLACE if state.demo else None, tour=tour, **settings)
    app = BirdcageApp(session, settings)
    app.feeds.ready.steps = StepTally(8, 11)
    if heard and state.position is not None:
        app.signals.book.of(TUNER_FACTS).extend(samples(clock))
    return app


def change_to(app, name):
    """Let an app that runs show another state, as if it had been in it from the start."""
    state = STATES[name](app.session.clock)
    app.station.state = state
    app.settings = replace(app.settings, place=PLACE if state.demo else None)
    app.signals.book.of(TUNER_FACTS).clear()
    if state.position is not None:
        app.signals.book.of(TUNER_FACTS).extend(samples(app.session.clock))


def text_of(app):
    """What a person reads, row by row."""
    strips = app.screen._compositor.render_strips()
    return "\n".join("".join(segment.text for segment in strip) for strip in strips)

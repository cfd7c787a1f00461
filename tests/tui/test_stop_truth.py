"""What the screen says of STOP is held against what STOP then does to a simulated dish, in every state of it.

A promise is a line without a way out: the dish must then be at rest in the time that it names. A line that says that
STOP can't must be true too: the dish then goes on.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from itertools import product

import pytest
from birdcage.base.held import HeldReason
from birdcage.protocol.carryout.model import CARRYOUT_2003
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.generic import GENERIC_FACTS
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.ladder import EVERY_MOVE, POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.own import OwnFacts
from birdcage.station.raw import Grade
from birdcage.station.requests import Goto, Home, Jog, Pursue, Stow
from birdcage.station.state import Activity, HeldState, LinkPhase, LinkState, Motion, StopReport, TvSearch
from birdcage.station.stop_words import ends_motion
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.panes.next_steps import next_steps
from birdcage_tui.shown.state_words import bad_day, calm, motion_text
from birdcage_tui.shown.stop_words import stop_text
from birdcage_tui.shown.view import View
from stand_in import STATES

from tests.station.conftest import Bench
from tests.station.pursuit_bench import at, g2, plan_of
from tests.station.queued_bench import connected
from tests.station.raw_console_bench import TalkBench

PROMISE = re.compile(r"^STOP (holds it|takes [\d.]+ s|should take|should stop|brings it|ends the|at end of move)")
DENIAL = re.compile(r"[Nn]o STOP|can't")
WIDEST = 36
"""Columns of the pane at 80x24."""


def view_of(bench) -> View:
    return View(bench.state, bench.clock.monotonic(), bench.clock.utc(), AppOptions())


# What STOP does, held against what was said of it.


@dataclass
class Pressed:
    """What was said before STOP, and how the dish stood then."""

    said: str
    at: float
    moving: bool
    az_deg: float


def press(bench) -> Pressed:
    pressed = Pressed(stop_text(view_of(bench)), bench.clock.monotonic(), bench.device.truth().moving,
                      bench.device.truth().az_deg)  # fmt: skip
    bench.station.stop("you")
    return pressed


def press_during(bench, activity: Activity) -> list[Pressed]:
    """STOP as soon as the station tells of this activity: in the middle of an exchange that takes long."""
    pressed: list[Pressed] = []

    def hear(event):
        if type(event).__name__ == "ActivityChanged" and event.activity is activity and not pressed:
            pressed.append(press(bench))

    bench.station.subscribe(hear)
    return pressed


def at_rest() -> tuple[Bench, Pressed]:
    bench = Bench().connect()
    bench.do(Goto(180, 45, "you"))
    return bench, press(bench)


def slewing() -> tuple[Bench, Pressed]:
    bench = Bench("g2?seed=1&az_speed=20").connect()
    bench.do(Goto(60, 45, "you"))
    bench.station.submit(Goto(210, 45, "you"))
    bench.step(1.0)
    return bench, press(bench)


def homing() -> tuple[Bench, Pressed]:
    bench = Bench("g2?seed=1&unhomed=1").connect()
    pressed = press_during(bench, Activity.HOMING)
    bench.station.submit(Home("you"))
    bench.step(0.5)
    return bench, pressed[0]


def stowing() -> tuple[Bench, Pressed]:
    bench = Bench("g2?seed=1", {"stow_allowed": True}).connect()
    pressed = press_during(bench, Activity.STOWING)
    bench.station.submit(Stow("you"))
    bench.step(0.5)
    return bench, pressed[0]


def typed_raw() -> tuple[Bench, Pressed]:
    bench = TalkBench("g2?seed=1&az_speed=20").counted()
    bench.type("a 0 100", confirmed=Grade.RUINS)
    bench.step(0.7)
    return bench, press(bench)


def following() -> tuple[Bench, Pressed]:
    bench = g2()
    bench.station.submit(Pursue(plan_of(at(bench) + 5.0), "you"))
    bench.step(30.0)
    assert bench.state.activity is Activity.FOLLOWING
    return bench, press(bench)


def queued_slew() -> tuple[Bench, Pressed]:
    bench = connected()
    bench.station.submit(Goto(290, 30, "you"))
    bench.step(6.0)
    return bench, press(bench)


def queued_step() -> tuple[Bench, Pressed]:
    bench = connected()
    bench.station.submit(Jog(4.0, 0.0, "you"))
    bench.step(0.6)
    return bench, press(bench)


def queued_search() -> tuple[Bench, Pressed]:
    bench = connected("searching=1&search_finds=0")
    bench.step(1.0)
    return bench, press(bench)


def unplugged() -> tuple[Bench, Pressed]:
    bench = Bench("g2?seed=1&az_speed=2").connect()
    bench.station.submit(Goto(300, 45, "you"))
    bench.step(1.0)
    bench.device.unplug()
    bench.step(2.0)
    return bench, press(bench)


def starting() -> tuple[Bench, Pressed]:
    bench = Bench("g2?seed=1&boot=1&nvs20=0")
    bench.step(2.0)
    return bench, press(bench)


def not_open() -> tuple[Bench, Pressed]:
    bench = Bench()
    return bench, press(bench)


SCENES: tuple[Callable[[], tuple[Bench, Pressed]], ...] = (
    at_rest, slewing, homing, stowing, typed_raw, following, queued_slew, queued_step, queued_search, unplugged,
    starting, not_open,
)  # fmt: skip


def promised_s(said: str) -> float:
    number = re.search(r"(\d+(?:\.\d)?) s", said)
    return 0.0 if number is None else float(number[1])


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.__name__)
def test_what_is_said_of_stop_is_what_stop_does(scene):
    bench, pressed = scene()
    if PROMISE.search(pressed.said):
        bench.step(max(0.0, pressed.at + promised_s(pressed.said) + 1.5 - bench.clock.monotonic()))
        truth = bench.device.truth()
        assert not truth.moving, f"{pressed.said!r}, and the dish goes on"
        rest_deg = truth.az_deg
        bench.step(20)
        assert bench.device.truth().az_deg == pytest.approx(rest_deg, abs=0.02), f"{pressed.said!r}, and it moved later"
    elif DENIAL.search(pressed.said) and pressed.moving:
        bench.step(max(0.0, pressed.at + 0.6 - bench.clock.monotonic()))
        assert bench.device.truth().moving, f"{pressed.said!r}, and STOP did it"
    if pressed.said == "STOP holds it where it is":
        assert not pressed.moving
        assert bench.device.truth().az_deg == pytest.approx(pressed.az_deg, abs=0.02)


def test_each_kind_of_line_is_met():
    """The scenes above are of use only as long as they show promises, denials and doubts."""
    said = [scene()[1].said for scene in SCENES if scene is not following]
    kinds = [bool(PROMISE.search(words)) - bool(DENIAL.search(words)) for words in said]
    assert {-1, 0, 1} <= set(kinds), said
    assert len(set(said)) >= 8, said


def test_while_homing_nothing_says_that_stop_holds_the_dish():
    bench = Bench("g2?seed=1&unhomed=1").connect()
    told = []

    def hear(event):
        if bench.state.activity is Activity.HOMING:
            told.extend((stop_text(view_of(bench)), *(words for _ink, words in next_steps(view_of(bench)))))

    bench.station.subscribe(hear)
    bench.station.submit(Home("you"))
    bench.step(40)
    assert "Homing: no STOP but the 12 V switch" in told
    assert not [words for words in told if "STOP holds" in words or "STOP takes" in words or "At rest" in words]


# All states, also those that a dish has not shown yet: no line may claim what the state does not bear out.

MEANS = (StopMeans.RETARGET, StopMeans.ABORT, StopMeans.COMMAND, StopMeans.WAIT, StopMeans.RELEASE, StopMeans.NONE)
UNPLANNED = (StopMeans.RETARGET, StopMeans.COMMAND, StopMeans.WAIT, StopMeans.NONE)
REPORTED = tuple(means for means in StopMeans if means is not StopMeans.POWER)
"""A rung that a person climbs is none that STOP can report."""
STOPPABLE = Rung(means=StopMeans.COMMAND, ends=EVERY_MOVE, proven=True, sentence="it halts", anywhere=True)
MACHINES = {
    "g2": CARRYOUT_G2, "hal205": TRAVLER, "carryout": CARRYOUT_2003, "generic": GENERIC_FACTS,
    "stoppable": replace(CARRYOUT_G2, stop_ladder=(STOPPABLE, POWER_SWITCH)),
    "mute": replace(CARRYOUT_2003, stop_ladder=(STOPPABLE, POWER_SWITCH)),
    "waiting": OwnFacts().that_waits(datetime(2026, 3, 20, tzinfo=UTC)).on(CARRYOUT_G2),
    "unproven": replace(CARRYOUT_G2, stop_ladder=(replace(STOPPABLE, proven=False), POWER_SWITCH)),
}  # fmt: skip


def motions(view: View) -> tuple[Motion | None, ...]:
    return None, *(
        Motion(10.0, 30.0, 99.0, 40.0, view.now - 1, view.now + 9.4, None if means is StopMeans.NONE else 0.4, means,
               stop_proven=proven)
        for means, proven in product(MEANS, (True, False))
    )  # fmt: skip


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("activity", Activity, ids=lambda activity: activity.value)
def test_no_line_claims_more_than_is_known(machine, activity):
    from birdcage.base.clock import VirtualClock

    clock = VirtualClock()
    state = replace(STATES["travler" if machine == "hal205" else "idle"](clock), dish=MACHINES[machine])
    plain = View(state, clock.monotonic(), clock.utc(), AppOptions())
    held = HeldState("you", plain.now, plain.utc, HeldReason.STOP)
    reports = [None, *(StopReport("you", plain.now, *each, "") for each in product(REPORTED, (None, False)))]
    kinds = [(motion, by) for motion in motions(plain) for by in (UNPLANNED if motion is None else UNPLANNED[:1])]
    for link, (motion, by), report, latched in product(LinkPhase, kinds, reports, (None, held)):
        now = replace(state, activity=activity, motion=motion, last_stop=report, held=latched, unplanned_stop=by,
                      link=LinkState(link, plain.now))  # fmt: skip
        _check(replace(plain, state=now))
        if report is None:
            _check(replace(plain, state=now, crash="Boom"))
            _check(replace(plain, state=replace(now, search=TvSearch.RUNNING)))


def _check(view: View) -> None:
    state, said = view.state, stop_text(view)
    assert len(said) <= WIDEST, said
    promised = PROMISE.search(said) is not None
    plans = state.motion is not None
    if not view.link_up or view.crash:
        assert not promised, said
    if state.activity in (Activity.INITIALIZING, Activity.STOWING, Activity.UNKNOWN) and not plans:
        assert not promised, said
    if promised and not plans:
        proven = {kind for rung in state.dish.stop_ladder if rung.proven and rung.means is not StopMeans.POWER
                  for kind in rung.ends}  # fmt: skip
        assert state.activity is not Activity.HOMING or MoveKind.HOME in proven, said
        assert state.activity is not Activity.MOVING_UNASKED or MoveKind.SEARCH in proven, said
        assert state.unplanned_stop is not StopMeans.NONE or said == "STOP ends the homing", said
    if not plans:
        ladder = state.dish.stop_ladder
        assert "looks" not in said or state.activity is Activity.STOPPING or any(rung.means.is_sent for rung in ladder)
        assert state.dish.tells_at_rest or "looks and" not in said, said
        assert state.dish.tells_at_rest or "holds it" not in said, said
        known = any(rung.means is state.unplanned_stop and rung.proven for rung in ladder)
        assert "brings it" not in said or known, said
    assert not ends_motion(state) or view.crash or promised or said.startswith("STOP stops it"), said
    if plans:
        assert state.motion.stop_proven or "STOP takes" not in said, said
    if said == "STOP holds it where it is":
        assert not view.moving, state
        assert state.activity is Activity.IDLE
    wrong = bad_day(view)
    told = [motion_text(view), calm(view), *(words for _ink, words in next_steps(view))]
    told += [] if wrong is None else [wrong[1]]
    for words in told:
        assert "Nothing moves" not in words, "birdcage sends nothing: whether anything moves is another matter"
        assert not re.search(r"\bnobody\b", words, re.IGNORECASE), words
        if words.startswith(("At rest", "IDLE")):
            assert state.activity is Activity.IDLE, (words, state.activity)
            assert view.link_up
            assert not plans
            assert not view.crash
    if state.last_stop is not None and not state.last_stop.means.is_sent:
        assert not [words for words in (said, *told) if "STOP sent" in words], (said, told)

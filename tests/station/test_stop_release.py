"""The last rung of STOP: the motors are released only if the user enabled it, and the position is unknown then."""

from __future__ import annotations

import pytest
from birdcage.base.config import Settings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.errors import PositionUnknown
from birdcage.station.requests import ApplySettings, Connect, Goto, Release
from birdcage.station.stop_words import stop_line

from .conftest import Bench

STUBBORN = "g2?seed=1&second_move=queue&az_speed=10"


def stopped_in_vain(**options):
    bench = Bench(STUBBORN, options).connect()
    bench.do(Goto(340, 45, "you"))
    bench.station.submit(Goto(200, 45, "you"))
    bench.step(1)
    bench.station.stop("you")
    bench.step(6)
    return bench


def test_not_without_being_asked_for():
    bench = stopped_in_vain()
    assert bench.state.last_stop.confirmed is False
    assert "r" not in bench.lines()
    assert not bench.device.truth().released


def test_released_when_enabled_and_the_position_forgotten():
    bench = stopped_in_vain(stop_releases_motors=True)
    assert bench.state.last_stop.means == "release"
    assert bench.lines().count("r") == 1
    assert bench.device.truth().released
    assert bench.state.last_stop.confirmed is None, "nobody can tell whether it stands still"
    assert bench.state.position is None
    assert bench.state.held is not None
    bench.do(Release("you"))
    with pytest.raises(PositionUnknown):
        bench.do(Goto(200, 45, "you"))


def test_what_has_failed_once_is_not_tried_again():
    """The dish takes new targets at the end of a move only: the second STOP releases the motors at once."""
    bench = stopped_in_vain()
    bench.step(30)
    bench.do(Release("you"))
    bench.station._antenna.stop_consent = True
    bench.station.submit(Goto(200, 45, "you"))
    bench.step(1)
    before = len(bench.lines())
    bench.station.stop("you")
    bench.step(1)
    assert bench.state.last_stop.means == "release"
    assert [line for line in bench.lines()[before:] if line == "r" or line.startswith(("a ", "g "))] == ["r"]
    assert bench.device.truth().released


def test_what_answers_after_a_change_of_ports_is_not_judged_by_that():
    bench = stopped_in_vain()
    bench.step(30)
    bench.do(Release("you"))
    bench.do(Connect("sim:test", None))
    bench.step(5)
    bench.station.submit(Goto(200, 45, "you"))
    bench.step(1)
    bench.station.stop("you")
    bench.step(0.1)
    assert bench.state.last_stop.means == "retarget"


def test_consent_that_is_given_or_taken_back_is_said_at_once():
    bench = stopped_in_vain()
    bench.step(30)
    bench.do(Release("you"))
    for consent, said in ((False, "No STOP is known"), (True, "STOP holds it"), (False, "No STOP is known")):
        motion = MotionSettings(stop_releases_motors=consent)
        bench.do(ApplySettings(Settings(motion=motion), "you"))
        assert stop_line(bench.state, bench.clock.monotonic()).startswith(said)


def test_without_consent_the_second_stop_says_that_nothing_stops_it():
    bench = stopped_in_vain()
    bench.step(30)
    bench.do(Release("you"))
    bench.station.submit(Goto(200, 45, "you"))
    bench.step(1)
    assert stop_line(bench.state, bench.clock.monotonic()).startswith("No STOP: it ends by itself in ")
    bench.station.stop("you")
    bench.step(1)
    assert bench.state.last_stop.sentence.startswith("This dish takes new targets only at the end of a move")

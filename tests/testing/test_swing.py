"""The contract, kept by a motor along an arc: one axis, no readback, no line of bytes, STOP on a thread of its own."""

from __future__ import annotations

import threading
from dataclasses import replace

import pytest
from birdcage.base.config import FeedProfile, Settings
from birdcage.base.config.feeds import FeedSettings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.errors import MotionRefused, NoReply
from birdcage.base.geometry import separation
from birdcage.base.no_go import NoGoSector
from birdcage.rotator.facts import Readback
from birdcage.rotator.ladder import END_OF_MOVE, POWER_SWITCH, MoveKind, StopBy, StopOrder
from birdcage.rotator.mapping import Site
from birdcage.rotator.values import Look
from birdcage.station.events import MoveEnded
from birdcage.station.requests import ApplySettings, Goto, Jog, Release, Watch
from birdcage.station.state import LinkPhase
from birdcage.testing import Contract, MachineBench, Stage, StopScene
from birdcage.testing.passing import refuses_passes
from installed_toys import installed

SITE = Site(48.0, 11.0)


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import swing_twin

        yield swing_twin


@pytest.fixture
def bench(twins):
    return MachineBench(
        "swing", twins.SwingTwin, stops=(StopScene("command", (60.0, 0.0), 4.0),), near_deg=0.15,
        settings={"site": SITE},
    )  # fmt: skip


class TestSwing(Contract):
    pass


@pytest.fixture
def telling(bench, monkeypatch):
    """The same motor with an encoder: its angle is read, at rest and mapped."""
    from birdcage_toys.swing import FACTS, HOUR, Swing

    def look(self, *, hurry=False, busy_s=0.0):
        self._call(self._machine.ping)
        return Look({HOUR.name: round(self._machine.motor.deg, 2)})

    monkeypatch.setattr(Swing, "facts", replace(FACTS, readback=Readback.ALWAYS))
    monkeypatch.setattr(Swing, "look", look)
    return bench


class TestSwingThatTells(Contract):
    @pytest.fixture
    def bench(self, telling):
        return telling


class TestSwingWithoutStop(Contract):
    """And one that nothing stops: STOP sends nothing that it does not know, and a newer target waits."""

    @pytest.fixture
    def bench(self, telling, monkeypatch):
        from birdcage_toys.swing import Swing

        def stop_now(self, order):
            raise ValueError(f"it has nothing for {order.by}")

        waits = replace(END_OF_MOVE, ends=frozenset({MoveKind.COMBINED}))
        monkeypatch.setattr(Swing, "facts", replace(Swing.facts, stop_ladder=(waits, POWER_SWITCH)))
        monkeypatch.setattr(Swing, "stop_now", stop_now)
        return replace(telling, stops=(StopScene("end of move", (60.0, 0.0), 4.0, reaches_target=True),))


def test_a_small_miss_is_gone_to_and_told(bench):
    with Stage(bench) as stage:
        stage.found()
        arrived = stage.do(Goto(200.0, 33.4, "you"))
        missed = separation(200.0, 33.4, arrived.az_deg, arrived.el_deg)
        assert 0.2 < missed < 1.0
        assert stage.state.target_miss_deg == pytest.approx(missed, abs=0.01)
        (end,) = [event for event in stage.events if isinstance(event, MoveEnded)][-1:]
        assert end.miss_deg == pytest.approx(missed, abs=0.01)
        assert stage.stands_at(arrived.az_deg, arrived.el_deg)
        stage.do(Goto(arrived.az_deg, arrived.el_deg, "you"))
        assert stage.state.target_miss_deg == pytest.approx(0.0, abs=1e-4)


def test_a_beam_that_is_known_says_how_large_a_miss_is_too_large(bench):
    with Stage(bench) as stage:
        stage.found()
        wide = Settings(feed=FeedSettings(active="wide"), feeds={"wide": FeedProfile(beam_az_deg=8.0, beam_el_deg=6.0)})
        assert "misses this direction by 2" in str(stage.refused(Goto(200.0, 35.4, "you"), MotionRefused))
        stage.do(ApplySettings(wide, "you"))
        stage.do(Goto(200.0, 35.4, "you"))


def test_no_go_sectors_are_judged_along_the_arc(bench):
    with Stage(bench) as stage:
        stage.found()
        sectors = (NoGoSector(200.0, 210.0, 33.0, "mast"),)
        stage.do(ApplySettings(Settings(motion=MotionSettings(no_go_sectors=sectors)), "you"))
        beyond, within = stage.target(45.0, 0.0), (205.0, 31.5)
        assert beyond[0] > 215.0
        refusal = str(stage.refused(Goto(*beyond, "you"), MotionRefused))
        assert "leads through the no-go sector from azimuth 200° to 210° below 33° (mast)" in refusal
        assert "lies in the no-go sector" in str(stage.refused(Goto(*within, "you"), MotionRefused))
        stage.do(Goto(*stage.target(-40.0, 0.0), "you"))


def test_in_the_south_its_arc_leads_through_north(twins):
    bench = MachineBench(
        "swing", lambda clock: twins.SwingTwin(clock, -33.0), (), near_deg=0.15, settings={"site": Site(-33.0, 18.0)}
    )
    with Stage(bench) as stage:
        stage.ready()
        stage.do(Goto(30.0, 47.2, "you"))
        assert stage.truth.az_deg == pytest.approx(30.0, abs=1.0)
        move = stage.station.submit(Goto(330.0, 47.2, "you"))
        seen = []
        while not move.done():
            stage.step(0.5)
            seen.append((stage.state.position.az_deg, stage.state.position.el_deg))
        assert stage.truth.az_deg == pytest.approx(330.0, abs=1.0)
        assert all(az >= 329.0 or az <= 31.0 for az, _ in seen)
        assert max(el for _, el in seen) > 51.0


@pytest.fixture
def nowhere(bench):
    return replace(bench, settings={})


def test_without_a_location_it_has_no_direction_and_says_so(nowhere):
    with Stage(nowhere) as stage:
        stage.station.submit(Watch("you", frozenset({"position"}), 2.0))
        stage.step(10.0)
        assert stage.state.link.state is LinkPhase.UP
        assert stage.state.position is None
        assert stage.state.position_lost == "no_direction"
        said = "The Swing has no azimuth and elevation. Its arc depends on where it stands: set your location"
        for request in (Goto(180.0, 34.0, "you"), Jog(1.0, 0.0, "you")):
            assert str(stage.refused(request, MotionRefused)).startswith(said)
        assert stage.state.holder is None
        assert not stage.twin.taken()
        stage.station.stop("you")
        stage.step(5.0)
        assert stage.state.held is not None
        stage.do(Release("you"))
        assert refuses_passes(stage)


def test_stop_returns_at_once_though_the_library_blocks(bench):
    """The motor is told on a thread of the machine's own, `settle` waits for that until its deadline, and it ends."""
    before = threading.enumerate()
    with Stage(bench) as stage:
        stage.found()
        stage.station.submit(Goto(*stage.target(60.0, 0.0), "you"))
        stage.step(4.0)
        stage.twin.free.clear()
        machine = stage.station._antenna.rotator._rotator
        machine.stop_now(StopOrder(StopBy.COMMAND))  # would never return if it waited
        with pytest.raises(NoReply, match="did not answer STOP"):
            machine.settle(0.2)
        assert not stage.truth.moving
        stage.twin.free.set()
        machine.stop_now(StopOrder(StopBy.COMMAND))
        assert machine.settle(5.0) == (None,)
        own = [thread for thread in threading.enumerate() if thread.name == "swing-halter" and thread not in before]
        assert len(own) == 1
    assert not own[0].is_alive()


def test_stop_halts_what_somebody_else_set_in_motion(bench):
    """Nothing tells of it, and by its time nothing moves: its own command goes out all the same."""
    with Stage(bench) as stage:
        stage.found()
        stage.step(5.0)
        stage.twin.motor.go(-60.0)
        stage.step(2.0)
        stage.station.stop("you")
        stage.step(3.0)
        assert not stage.truth.moving
        stop = stage.state.last_stop
        assert (stop.means, stop.confirmed) == ("command", None)

"""What goes on beside a pursuit: it is logged, the user's commands run, the receiver is tuned."""

from __future__ import annotations

import sqlite3
import sys
from contextlib import closing
from datetime import UTC, datetime

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings
from birdcage.base.config.feeds import FeedProfile, FeedSettings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.config.tracking_sections import HookSettings, RadioSettings
from birdcage.pursuit.desk import PursuitDesk
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.pursuit.pass_facts import facts_of
from birdcage.pursuit.pass_listener import PassListener
from birdcage.pursuit.pass_log import PassLog
from birdcage.pursuit.pass_tuner import tuning_of
from birdcage.station.events import Followed
from birdcage.station.pursuit_state import Phase

from .pass_events import wait_for

STATION = "DEMO LEO 2 station"
SHORT = MotionSettings(min_elevation_deg=50.0)


def follow(bench, frequency_hz=None):
    bench.desk.choose(STATION)
    bench.desk.set_frequency(frequency_hz)
    bench.desk.follow()
    bench.do()
    return bench


def test_a_pass_is_kept_in_the_journal_with_its_site_and_the_age_of_its_elements(bench):
    follow(bench)
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(5.0)
    bench.desk.close()
    with closing(sqlite3.connect(bench.paths.journal)) as journal:
        journal.row_factory = sqlite3.Row
        (row,) = journal.execute("SELECT * FROM pass")
    assert (row["name"], row["site"]) == (STATION, "here")
    assert row["elements_epoch"].startswith("2026-11-21T12:00:00")
    assert any(bench.paths.passes.iterdir())


def test_hooks_run_at_the_beginning_and_at_the_end_of_reach(make, tmp_path):
    line = (
        f'{sys.executable} -c \'import os; open(os.environ["BIRDCAGE_EVENT"], "w").write(os.environ["BIRDCAGE_NAME"])\''
    )
    where = f'sh -c "cd {tmp_path} && exec {line.replace(chr(34), chr(92) + chr(34))}"'
    bench = follow(make(settings=Settings(motion=SHORT, hooks=HookSettings(at_reach_start=where, at_reach_end=where))))
    begun, over = tmp_path / "reach_start", tmp_path / "reach_end"
    bench.until(lambda: bench.phase() is Phase.READY)
    assert not begun.exists()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(3.0)
    wait_for(begun)
    assert begun.read_text() == STATION
    assert not over.exists()
    bench.desk.leave()  # what was begun is ended
    bench.do(3.0)
    wait_for(over)


@pytest.fixture
def planned(bench):
    bench.desk.choose(STATION)
    bench.desk.set_frequency(1.7e9)
    return bench.do(), bench


def test_a_receiver_is_told_the_doppler_of_the_place(planned):
    now, bench = planned
    elements = bench.orbits[1]
    tuning = tuning_of(now.plan, Settings(radio=RadioSettings(lo_hz=1.6e9)), bench.observer, elements)
    assert tuning.start_s == now.plan.legs[0].start_s
    early, _ = tuning.wanted_hz(tuning.start_s)
    late, shift_hz = tuning.wanted_hz(tuning.end_s)
    assert early > 100e6 > late  # it comes near, and goes away
    assert shift_hz < 0.0
    assert tuning.shift_hz(now.plan.passing.tca.timestamp()) == pytest.approx(0.0, abs=2000.0)


def test_what_sends_nothing_and_what_is_no_satellite_is_not_tuned_to(planned):
    now, bench = planned
    assert tuning_of(now.plan, Settings(), bench.observer, None) is None
    bench.desk.set_frequency(None)
    assert tuning_of(bench.do().plan, Settings(), bench.observer, bench.orbits[1]) is None


def test_a_hook_is_told_the_highest_point_within_reach(planned):
    now, bench = planned
    facts = facts_of(now.plan, bench.observer)
    assert facts.max_el_deg == pytest.approx(now.passes[0].passing.max_elevation_deg, abs=0.1)
    assert abs((facts.tca - now.passes[0].passing.tca).total_seconds()) < 2.0
    assert (facts.name, facts.site, facts.freq_hz) == (STATION, "here", 1.7e9)


def test_a_desk_with_a_thread_plans_tells_and_ends(bench):
    told = []
    setup = DeskSetup(bench.paths.catalogue, Settings, bench.paths, bench.observer, demo=True)
    desk = PursuitDesk(bench.station, RealClock(), setup, told.append)
    desk.start()
    desk.choose("sun")
    clock = RealClock()
    end = clock.monotonic() + 20.0
    while desk.now.plan is None:
        assert clock.monotonic() < end, desk.now
        clock.wait(None, clock.monotonic() + 0.02)
    desk.close(5.0)
    assert desk.crash is None
    assert desk.now.aim.name == "Sun"
    assert desk.now.plan.made_at <= datetime.now(UTC)
    assert told[-1] is desk.now


def test_a_strength_is_logged_once_and_a_simulated_one_is_marked(make, monkeypatch):
    radio = RadioSettings(rigctld="sim:rig", strength=True)
    told = []
    monkeypatch.setattr(PassLog, "signal", lambda _log, value, unit, at: told.append((at, value, unit)))
    bench = follow(make(settings=Settings(motion=SHORT, radio=radio)), 11.7e9)
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    before = len(told)
    bench.step(10.0)
    assert 8 <= len(told) - before <= 11  # one a second, though it is tuned, and shown, ten times as often
    assert {unit for _, _, unit in told} == {"dB DEMO"}
    assert all(value == pytest.approx(-60.0, abs=2.0) for _, value, _ in told)


def test_a_receiver_that_is_set_is_shown_before_the_first_pass(make):
    bench = make(settings=Settings(motion=SHORT, radio=RadioSettings(rigctld="sim:rig")))
    assert bench.do().radio.address == "sim:rig"


def test_where_the_receiver_hears_the_feed_its_level_is_logged_of_what_it_is_not_tuned_to(make, monkeypatch):
    told = []
    monkeypatch.setattr(PassLog, "signal", lambda _log, value, unit, at: told.append((at, value, unit)))
    feeds = {"helix": FeedProfile(signal="rigctl")}
    radio = RadioSettings(rigctld="sim:rig")
    settings = Settings(motion=SHORT, radio=radio, feed=FeedSettings("helix"), feeds=feeds)
    bench = follow(make(settings=settings))  # no frequency is known of it
    bench.until(lambda: bench.phase() is Phase.READY)
    assert told == []
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(10.0)
    assert 8 <= len(told) <= 11
    assert bench.station.state.signal_owners == {"rigctl": STATION}
    bench.desk.leave()
    bench.do(5.0)
    after = len(told)
    bench.step(10.0)
    assert len(told) == after
    assert bench.station.state.signal_owners == {}


class Push(PassListener):
    """A listener of the tests: keeps what it is told, and can be made to fail."""

    label = "web push"

    def __init__(self, fails=()):
        self.told, self.samples, self.remarks, self.closed = [], [], [], 0
        self.fails = fails

    def _note(self, word, told):
        told.append(word)
        if word in self.fails:
            raise RuntimeError(f"no network at {word}")

    def begins(self, live):
        self._note("begins", self.told)
        assert (live.plan.aim.name, live.observer.name) == (STATION, "here")
        assert live.elements.name == STATION

    def changes(self, live):
        self._note(live.pursuit.phase, self.told)

    def ends(self):
        self._note("ends", self.told)

    def hear(self, event, *, demo):
        if isinstance(event, Followed):
            self.samples.append((event.sample.error_deg, demo))

    def remark(self, remark):
        self._note(remark.text, self.remarks)

    def step(self):
        self._note("step", [])
        return float("inf")

    def close(self):
        self.closed += 1


def whole_pass(bench):
    follow(bench)
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(5.0)
    bench.desk.leave()
    bench.do(3.0)


def test_anything_can_go_along_with_a_pass(make):
    settings = Settings(motion=SHORT, hooks=HookSettings(at_reach_start=f"{sys.executable} -c 'print(73)'"))
    bench, push = make(settings=settings), Push()
    bench.desk.add_listener(push)
    whole_pass(bench)
    assert (push.told[0], push.told[-1]) == ("begins", "ends")
    assert push.told.count("begins") == push.told.count("ends") == 1
    assert Phase.FOLLOWING in push.told
    assert len(push.samples) >= 5
    assert all(demo is True and error < 5.0 for error, demo in push.samples)
    assert any(text.startswith("reach_start: ") and text.endswith("started.") for text in push.remarks)
    bench.desk.close()
    bench.desk.close()
    assert push.closed == 1


def test_one_that_is_added_in_mid_pass_is_told_of_it(bench):
    follow(bench)
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    push = Push()
    bench.desk.add_listener(push)
    bench.do()
    assert push.told[0] == "begins"


@pytest.mark.parametrize("where", ["begins", Phase.FOLLOWING, "ends", "step"])
def test_one_that_fails_is_named_and_ends_nothing(make, where):
    bench, push, other = make(), Push(fails=(where,)), Push()
    bench.desk.add_listener(push)
    bench.desk.add_listener(other)
    whole_pass(bench)
    assert bench.desk.crash is None
    assert bench.desk.now.problem == f"The web push stopped: RuntimeError('no network at {where}')."
    if where != "step":
        assert push.told[-1] == where
    assert other.told[-1] == "ends"
    assert len(other.samples) >= 5
    bench.desk.close()
    assert (push.closed, other.closed) == (1, 1)
    with closing(sqlite3.connect(bench.paths.journal)) as journal:
        assert journal.execute("SELECT count(*) FROM pass_sample").fetchone()[0] >= 5

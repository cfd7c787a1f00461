"""A receiver through a whole pass, on a virtual clock: what it is told, when, and what a person is shown."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.radio.now import RadioNow, RadioState
from birdcage.radio.runner import ReceiverRunner

from .passing import passing
from .scripted import HANG_UP, SILENCE, Desk, sdr

SETTINGS = RadioSettings(rigctld="radio:4532", strength=True)


class House:
    """A runner and its receiver, with what was shown."""

    def __init__(self, clock, answer, settings=SETTINGS):
        self.clock = clock
        self.desk = Desk(clock, answer)
        self.shown: list[RadioNow] = []
        self.runner = ReceiverRunner(settings, clock, self.shown.append, connect=self.desk)

    @property
    def posix(self):
        return self.clock.utc().timestamp()

    def run(self, seconds):
        until = self.clock.monotonic() + seconds
        while self.clock.monotonic() < until:
            self.clock.wait(None, min(self.runner.step(), until))

    def in_pass(self, **more):
        """Follow a pass that has just come into reach."""
        tuning = passing(self.posix - 0.01, **more)
        self.runner.follow(tuning)
        return tuning

    @property
    def words(self):
        return [line for _, line in self.desk.heard if line in {"AOS", "LOS"}]


@pytest.fixture
def house(clock):
    return lambda answer=None, **more: House(clock, answer or sdr(), **more)


def test_a_pass_from_end_to_end(house):
    house = house()
    begin = house.clock.monotonic()
    house.runner.follow(passing(house.posix + 100.0))
    house.run(39.5)
    assert house.desk.connected == 0  # until a minute before, the receiver is its owner's
    assert (house.runner.now.state, house.runner.now.name) == (RadioState.OFF, "METEOR-M2 4")
    house.run(1.5)
    assert house.runner.now.state is RadioState.TUNED
    assert house.words == []
    house.run(60.0)
    assert house.runner.now.recording is True
    house.run(300.0)
    assert house.runner.now.strength_db == -41.5
    assert (house.clock.utc() - house.runner.now.strength_at).total_seconds() < 1.2
    house.run(305.0)
    assert house.words == ["AOS", "LOS"]
    assert [at - begin for at, line in house.desk.heard if line in {"AOS", "LOS"}] == pytest.approx([100, 700], abs=0.3)
    assert house.desk.open == 0
    assert (house.runner.now.state, house.runner.now.recording, house.runner.now.tuned_hz) == (
        RadioState.OFF,
        False,
        None,
    )


def test_it_is_never_off_by_more_than_the_step_and_a_tick_and_never_told_more_than_ten_times_a_second(house):
    house = house()
    tuning = house.in_pass()
    worst = 0.0
    house.run(1.0)
    for _ in range(5900):
        house.run(0.1)
        worst = max(worst, abs(house.runner.now.tuned_hz - tuning.wanted_hz(house.posix)[0]))
    told = house.desk.lines("F")
    gaps = [after - before for (before, _), (after, _) in itertools.pairwise(told)]
    steepest_hz_s = 1_701_300_000 * 7.4**2 / 850.0 / 299_792.458
    assert worst <= 10.0 + 0.3 * steepest_hz_s + 1.0
    assert min(gaps) >= 0.099
    assert len(told) > 1000


def test_whoever_comes_more_often_does_not_tune_more_often(house):
    house = house(settings=replace(SETTINGS, step_hz=1.0))
    house.desk.latency_s = 0.0
    house.in_pass()
    for _ in range(300):
        house.runner.step()
        house.clock.advance(0.01)
    assert 25 <= len(house.desk.lines("F")) <= 31


def test_what_is_right_is_left_alone(house):
    house = house()
    still = replace(passing(house.posix - 0.01), shift_hz=lambda _at: None)
    house.runner.follow(still)
    house.run(30.0)
    assert [line for _, line in house.desk.lines("F")] == ["F 1701300000"]
    assert 29 <= len(house.desk.lines("f")) <= 32
    assert house.runner.now.doppler_hz is None


def test_it_comes_high_and_goes_low(house):
    house = house()
    house.in_pass(downlink_hz=137_900_000.0)
    house.run(1.0)
    assert house.runner.now.doppler_hz > 3000
    assert house.runner.now.tuned_hz > 137_903_000
    house.run(598.0)
    assert house.runner.now.doppler_hz < -3000
    assert house.runner.now.tuned_hz < 137_897_000


@pytest.mark.parametrize(
    ("downlink_hz", "lo_hz", "at_first_hz"),
    [(1.7e9, 1.5e9, 200_039_100), (3.7e9, 5.15e9, 1_449_915_000)],
    ids=["below", "above, where it is upside down"],
)
def test_behind_a_converter(house, downlink_hz, lo_hz, at_first_hz):
    house = house()
    house.in_pass(downlink_hz=downlink_hz, lo_hz=lo_hz)
    house.run(0.5)
    assert house.runner.now.tuned_hz == pytest.approx(at_first_hz, abs=2000)
    assert house.runner.now.downlink_hz == downlink_hz


def test_stop_ends_the_recording_at_once(house):
    house = house()
    house.in_pass()
    house.run(5.0)
    house.runner.follow(None)
    house.runner.step()
    assert house.words == ["AOS", "LOS"]
    assert house.desk.open == 0


def test_closing_ends_the_recording(house):
    house = house()
    house.in_pass()
    house.run(5.0)
    assert house.runner.close()
    assert house.words == ["AOS", "LOS"]
    assert house.desk.open == 0


def test_the_same_pass_planned_anew_goes_on(house):
    house = house()
    tuning = house.in_pass()
    house.run(5.0)
    house.runner.follow(replace(tuning, end_s=tuning.end_s - 3.0))
    house.run(5.0)
    assert house.words == ["AOS"]
    assert house.desk.connected == 1


def test_another_satellite_ends_one_recording_and_begins_the_next(house):
    house = house()
    house.in_pass()
    house.run(5.0)
    house.in_pass(name="METOP-B")
    house.run(5.0)
    assert house.words == ["AOS", "LOS", "AOS"]


def test_no_recording_where_none_is_wanted(house):
    house = house(settings=replace(SETTINGS, record=False, strength=False))
    house.in_pass()
    house.run(5.0)
    house.runner.close()
    assert house.words == []
    assert house.desk.lines("l") == []


def test_a_receiver_that_does_not_know_aos_is_never_told_los(house):
    house = house(sdr(knows_recording=False))
    house.in_pass()
    house.run(700.0)
    assert house.words == ["AOS"]
    assert all(now.recording is None for now in house.shown)
    assert any(now.state is RadioState.TUNED for now in house.shown)


@pytest.mark.parametrize("reply", [SILENCE, HANG_UP])
def test_a_receiver_that_falls_silent_at_aos_is_tuned_all_the_same(house, reply):
    knows = sdr()
    house = house(lambda line: reply if line in {"AOS", "LOS"} else knows(line))
    house.in_pass()
    house.run(30.0)
    assert house.words == ["AOS", "AOS"]
    assert (house.runner.now.state, house.runner.now.recording) == (RadioState.TUNED, None)
    house.run(580.0)
    assert house.words == ["AOS", "AOS", "LOS"]  # it may have heard: silence is no answer
    assert house.desk.open == 0


def test_a_receiver_without_a_signal_is_not_asked_again(house):
    house = house(sdr(strength=None))
    house.in_pass()
    house.run(20.0)
    assert len(house.desk.lines("l")) == 1
    assert house.runner.now.strength_db is None


def test_a_receiver_that_falls_silent_at_its_signal_is_tuned_all_the_same(house):
    knows = sdr()
    house = house(lambda line: SILENCE if line[0] == "l" else knows(line))
    house.in_pass()
    house.run(20.0)
    assert len(house.desk.lines("l")) == 1
    assert house.desk.connected == 2
    assert house.runner.now.state is RadioState.TUNED


def test_a_receiver_that_goes_away_is_called_again_and_told_aos_again(house):
    house = house()
    house.in_pass()
    house.run(5.0)
    house.desk.there = False
    house.run(30.0)
    assert house.runner.now.state is RadioState.LOST
    assert house.runner.now.tuned_hz is None
    assert "Nothing listens at radio:4532" in house.runner.now.sentence
    calls = sum(now.state is RadioState.CONNECTING for now in house.shown)
    assert 4 <= calls <= 8  # at 0.5, 1, 2, 4, 8 s: not ten times a second
    house.desk.there = True
    house.run(9.0)
    assert house.runner.now.state is RadioState.TUNED
    assert house.runner.now.sentence == ""
    assert house.words == ["AOS", "AOS"]


def test_los_is_owed_to_a_receiver_that_was_away_at_the_end(house):
    house = house()
    house.in_pass()
    house.run(590.0)
    house.desk.there = False
    house.run(30.0)
    house.desk.there = True
    house.run(20.0)
    assert house.words == ["AOS", "LOS"]
    assert house.desk.open == 0


def test_a_receiver_that_stays_away_may_still_record_and_that_is_told(house):
    house = house()
    house.in_pass()
    house.run(590.0)
    house.desk.there = False
    house.run(100.0)
    assert house.runner.now.state is RadioState.OFF
    assert "may still record" in house.runner.now.sentence
    assert math.isinf(house.runner.step())


def test_a_refused_frequency_is_told_and_asked_for_once_a_second(house):
    knows = sdr()
    house = house(lambda line: b"RPRT -1\n" if line[0] == "F" else knows(line))
    house.in_pass()
    house.run(10.0)
    assert house.runner.now.state is RadioState.REFUSED
    assert house.runner.now.tuned_hz is None
    assert "RPRT -1" in house.runner.now.sentence
    assert len(house.desk.lines("F")) <= 11


def test_an_oscillator_on_the_frequency_itself(house):
    house = house()
    house.runner.follow(replace(passing(house.posix - 0.01, lo_hz=1_701_300_000.0), shift_hz=lambda _at: 0.0))
    house.run(1.0)
    assert house.runner.now.state is RadioState.REFUSED
    assert house.desk.lines("F") == []


def test_what_is_no_rigctld_is_told(house):
    house = house(lambda _line: b"SSH-2.0-OpenSSH_9.2\n")
    house.in_pass()
    house.run(10.0)
    assert house.runner.now.state is RadioState.REFUSED
    assert "not rigctld" in house.runner.now.sentence
    assert house.words == []


def test_a_receiver_that_is_silent_from_the_start_is_told_with_its_likely_causes(house):
    house = house(lambda _line: SILENCE)
    house.in_pass()
    house.run(1.0)
    assert house.runner.now.state is RadioState.LOST
    assert "one program at a time" in house.runner.now.sentence


def test_a_receiver_that_says_yes_and_stays_where_it_is(house):
    house = house(lambda line: b"100000000\n" if line[0] in "fl" else b"RPRT 0\n")
    house.in_pass()
    house.run(3.0)
    assert house.runner.now.state is RadioState.TUNED
    assert "says 100.000000" in house.runner.now.sentence
    assert house.runner.now.read_back_hz == 100e6


def test_an_address_that_is_none_and_none_at_all():
    wrong = ReceiverRunner(RadioSettings(rigctld="http://radio"), VirtualClock())
    assert "not an address" in wrong.now.sentence
    assert math.isinf(wrong.step())
    assert ReceiverRunner(RadioSettings(), VirtualClock()).now == RadioNow()

"""The runner on its own thread and on real sockets, and with Hamlib's own daemon."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.radio.now import RadioState
from birdcage.radio.runner import ReceiverRunner

from .passing import passing
from .scripted import HANG_UP, SILENCE, sdr


class TestOnItsThread:
    """The real clock and real sockets."""

    def run(self, address, shown):
        clock = RealClock()
        runner = ReceiverRunner(RadioSettings(rigctld=address), clock, shown.append)
        runner.start()
        runner.follow(passing(clock.utc().timestamp() - 1.0))
        return runner

    def until(self, true):
        deadline = time.monotonic() + 60.0
        while not true():
            assert time.monotonic() < deadline
            time.sleep(0.01)

    def test_closing_tells_los(self, server):
        there = server(sdr())
        runner = self.run(there.address, [])
        self.until(lambda: "AOS" in there.heard)
        assert runner.close()
        assert there.heard[-1] == "LOS"

    def test_a_fault_of_ours_ends_the_recording_and_is_told(self, server):
        there = server(sdr())
        shown = []
        runner = self.run(there.address, shown)
        self.until(lambda: "AOS" in there.heard)

        def fault(_at_s):
            raise ZeroDivisionError("of ours")

        now_s = RealClock().utc().timestamp()
        runner.follow(replace(passing(now_s - 1.0), shift_hz=fault))
        self.until(lambda: "a bug in birdcage" in runner.now.sentence)
        self.until(lambda: shown[-1] == runner.now)
        assert there.heard[-1] == "LOS"
        assert runner.close()

    def test_a_mute_receiver_holds_nobody_up(self, server):
        there = server(lambda _line: SILENCE)
        runner = self.run(there.address, [])
        self.until(lambda: there.heard == ["f"])
        began = time.monotonic()
        runner.follow(None)
        assert time.monotonic() - began < 0.05
        runner.close()
        assert time.monotonic() - began < 1.0

    def test_a_receiver_that_is_mute_from_some_moment_is_sent_los_all_the_same(self, server):
        knows, mute = sdr(), []
        there = server(lambda line: SILENCE if mute else knows(line))
        runner = self.run(there.address, [])
        self.until(lambda: "AOS" in there.heard)
        mute.append(True)
        so_far = len(there.heard)
        self.until(lambda: len(there.heard) > so_far)  # a question is out, and stays without an answer
        began = time.monotonic()
        assert not runner.close()
        self.until(lambda: there.heard[-1] == "LOS")
        assert time.monotonic() - began < 1.0

    def test_a_receiver_that_has_hung_up_is_called_once_more_for_los(self, server):
        knows, rude = sdr(), []
        there = server(lambda line: HANG_UP if rude and line != "LOS" else knows(line))
        shown = []
        runner = self.run(there.address, shown)
        self.until(lambda: "AOS" in there.heard)
        rude.append(True)
        self.until(lambda: shown[-1].state is RadioState.LOST)
        assert runner.close()
        assert there.heard[-1] == "LOS"


def test_hamlibs_dummy_through_a_doppler_curve(rigctld, clock):
    """Ten minutes of a pass at 1.7 GHz; in steps of 1 kHz, as the dummy takes 40 ms for each."""
    runner = ReceiverRunner(RadioSettings(rigctld=f"127.0.0.1:{rigctld}", strength=True, step_hz=1000.0), clock)
    tuning = passing(clock.utc().timestamp() - 0.01)
    runner.follow(tuning)
    tuned, looks = [], set()
    while True:
        at_s = clock.utc().timestamp()
        due = runner.step()
        now = runner.now
        if now.state is RadioState.OFF:
            break
        clock.wait(None, due)
        assert abs(now.tuned_hz - tuning.wanted_hz(at_s)[0]) <= 1001.0
        assert now.strength_db is not None
        tuned.append(now.tuned_hz)
        looks.add(now.read_back_hz)
    assert tuned == sorted(tuned, reverse=True)
    assert tuned[0] - tuned[-1] == pytest.approx(79_000.0, abs=2000.0)
    assert looks <= set(tuned)  # what it reads back is what was set, to the hertz
    assert len(looks) > 60
    assert now.recording is None  # AOS is not for it
    assert runner.close()


def test_hamlibs_dummy_in_the_steep_middle_of_a_pass(rigctld):
    """In real time: ten tunings a second, each where the satellite is at that moment."""
    clock = RealClock()
    told = []
    tuning = passing(clock.utc().timestamp() - 300.0)
    settings = RadioSettings(rigctld=f"127.0.0.1:{rigctld}", step_hz=1.0)
    runner = ReceiverRunner(settings, clock, lambda now: told.append((clock.utc().timestamp(), now)))
    runner.start()
    runner.follow(tuning)
    began = time.monotonic()
    while len(tunings := {now.tuned_hz: at_s for at_s, now in told[::-1] if now.state is RadioState.TUNED}) < 10:
        assert time.monotonic() < began + 60.0
        time.sleep(0.01)
    assert len(tunings) <= 10.0 * (time.monotonic() - began) + 2.0
    assert runner.close()
    # 109 Hz a second; the machine may be busy for a while.
    assert all(abs(freq_hz - tuning.wanted_hz(at_s)[0]) < 109.0 for freq_hz, at_s in tunings.items())

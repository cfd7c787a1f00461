"""SDR++ at the other end: what it does otherwise than its answers say, and how a person learns of it."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.radio import probe
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.now import RadioState
from birdcage.radio.probe import ReceiverAnswers, ask_receiver
from birdcage.radio.rigctl import RigctlClient
from birdcage.radio.runner import ReceiverRunner
from birdcage.radio.wire import connector

from .passing import passing
from .scripted import Desk, sdr
from .sdrpp import GET_LEVELS, OneAtATime, SdrPlusPlus

SETTINGS = RadioSettings(rigctld="radio:4532", strength=True)


@pytest.fixture
def listening():
    started = []

    def start(**more):
        started.append(OneAtATime(SdrPlusPlus(**more)))
        return started[-1]

    yield start
    for each in started:
        each.close()


@pytest.fixture
def in_pass(clock):
    """Follow a pass with a receiver for 20 s, and return the runner and the receiver's desk."""

    def follow(answer, settings=SETTINGS):
        desk = Desk(clock, answer)
        runner = ReceiverRunner(settings, clock, connect=desk)
        runner.follow(passing(clock.utc().timestamp() - 0.01))
        until = clock.monotonic() + 20.0
        while clock.monotonic() < until:
            clock.wait(None, min(runner.step(), until))
        return runner, desk

    return follow


def rig_at(server, reply_s=0.3):
    return RigctlClient(connector()("127.0.0.1", server.port, 1.0), time.monotonic, reply_s=reply_s)


def test_it_advertises_a_level_and_gives_none(in_pass):
    answer = SdrPlusPlus(armed=True)
    assert GET_LEVELS in answer("\\dump_state").decode().split()
    runner, desk = in_pass(answer)
    assert (runner.now.state, runner.now.strength_db, runner.now.strength_refused) == (RadioState.TUNED, None, 1)
    assert len(desk.lines("l")) == 1
    assert round(runner.now.tuned_hz) == answer.frequency_hz


@pytest.mark.parametrize("armed", [False, True])
def test_a_recording_is_told_and_never_called_proven(in_pass, armed):
    answer = SdrPlusPlus(armed=armed)
    runner, desk = in_pass(answer)
    assert answer.recordings == int(armed)
    assert len(desk.lines("AOS")) == 1
    assert "SDR++ takes AOS with Recording switched off, too" in runner.now.sentence


def test_that_is_told_where_no_level_is_asked_for_and_left_out_where_nothing_is_recorded(in_pass):
    assert "Recording switched off" in in_pass(SdrPlusPlus(), replace(SETTINGS, strength=False))[0].now.sentence
    assert in_pass(SdrPlusPlus(), replace(SETTINGS, strength=False, record=False))[0].now.sentence == ""


def test_a_receiver_with_a_level_is_not_sdrpp(in_pass):
    assert in_pass(sdr())[0].now.sentence == ""


def test_tuning_switched_off_in_it_is_told(in_pass):
    runner, _ = in_pass(SdrPlusPlus(tuning=False))
    assert "may it be tuned from here?" in runner.now.sentence


def test_the_second_program_waits_until_the_first_hangs_up(listening):
    there = listening()
    first, second = rig_at(there), rig_at(there)
    assert first.frequency_hz() == 100e6
    with pytest.raises(RadioLost) as lost:
        second.frequency_hz()
    assert lost.value.reason == "silent"
    with pytest.raises(RadioLost, match=r"has not answered|No answer"):
        ask_receiver(there.address, 0.2)
    second.close()
    first.close()
    assert ask_receiver(there.address, 2.0).is_sdrpp


def test_what_it_takes_apart_letter_by_letter_is_never_sent(listening):
    there = listening(armed=True)
    rig = rig_at(there)
    rig.tune(137_912_500)
    rig.word("AOS")
    with pytest.raises(RadioRefused, match="RPRT 1"):
        rig.strength_db()
    rig.word("LOS")
    assert rig.frequency_hz() == 137_912_500
    rig.close()
    assert there.sdr.recordings == 1
    assert there.sdr("+f") == b"RPRT 1\n137912500\n"  # two commands, two answers: out of step


class TestAsked:
    def test_only_what_changes_nothing(self, listening):
        there = listening(armed=True)
        assert ask_receiver(there.address) == ReceiverAnswers(
            100e6, None, 1, ("FM", "WFM", "AM", "DSB", "USB", "CW", "LSB", "RAW")
        )
        assert there.heard == ["f", "l STRENGTH", "M ?"]
        assert there.sdr.recordings == 0

    @pytest.mark.parametrize("armed", [False, True])
    def test_a_trial_recording_is_answered_alike_armed_or_not(self, listening, monkeypatch, armed):
        monkeypatch.setattr(probe, "TRIAL_S", 0.01)
        there = listening(armed=armed)
        assert ask_receiver(there.address, try_recording=True).recording_code == 0
        assert (there.sdr.recordings, there.sdr.recording) == (int(armed), False)
        assert there.heard[-2:] == ["AOS", "LOS"]

    def test_whoever_does_not_know_aos_is_not_told_los(self, server):
        there = server(sdr(knows_recording=False))
        assert ask_receiver(there.address, try_recording=True).recording_code == 1
        assert there.heard[-1] == "AOS"

    def test_hamlib_is_not_taken_for_it(self, rigctld):
        answers = ask_receiver(f"127.0.0.1:{rigctld}", 2.0)
        assert answers.modes
        assert not answers.is_sdrpp
        assert answers.level_db is not None

"""The client of Hamlib's protocol, over real sockets, against receivers that behave and that do not."""

from __future__ import annotations

import time

import pytest
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.probe import ReceiverAnswers, ask_receiver
from birdcage.radio.rigctl import RigctlClient
from birdcage.radio.wire import connector

from .scripted import HANG_UP, SILENCE, sdr


@pytest.fixture
def rig(server):
    made = []

    def make(answer, reply_s=0.25):
        there = server(answer)
        made.append(RigctlClient(connector()("127.0.0.1", there.port, 1.0), time.monotonic, reply_s=reply_s))
        return made[-1], there

    yield make
    for each in made:
        each.close()


def test_what_goes_over_the_wire(rig):
    radio, there = rig(sdr())
    radio.tune(137_912_500)
    assert radio.frequency_hz() == 137_912_500.0
    assert radio.strength_db() == -41.5
    radio.word("AOS")
    radio.word("LOS")
    assert there.heard == ["F 137912500", "f", "l STRENGTH", "AOS", "LOS"]


@pytest.mark.parametrize(
    ("reply", "value"),
    [
        (b"137912500\n", 137_912_500.0),
        (b"137912500\r\n", 137_912_500.0),
        (b"\n137912500.000000\n", 137_912_500.0),
        ([b"1379", 0.02, b"12500", 0.02, b"\n"], 137_912_500.0),
        (b"get_freq:\nFrequency: 137912500\nRPRT 0\n", 137_912_500.0),
        (b"RPRT 0\n137912500\n", 137_912_500.0),
    ],
    ids=["plain", "crlf", "blank line first", "in pieces", "extended", "after a leftover"],
)
def test_a_value_in_every_form(rig, reply, value):
    assert rig(lambda _line: reply)[0].frequency_hz() == value


def test_a_level_in_the_extended_form(rig):
    assert rig(lambda _line: b"get_level: STRENGTH\n-30\nRPRT 0\n")[0].strength_db() == -30.0


def test_success_in_the_extended_form(rig):
    rig(lambda _line: b"set_freq: 5000\nRPRT 0\n")[0].tune(5000)


def test_an_answer_that_came_too_late_is_not_taken_for_the_next(rig):
    replies = iter([b"1\n99\nRPRT 0\n", b"2\n"])
    radio, _ = rig(lambda _line: next(replies))
    assert radio.frequency_hz() == 1.0
    assert radio.frequency_hz() == 2.0


@pytest.mark.parametrize(("code", "told"), [(-1, "does not take"), (-11, "cannot do"), (1, r"RPRT 1\."), (-77, "-77")])
def test_a_refusal_has_its_code_and_leaves_the_connection(rig, code, told):
    replies = iter([f"RPRT {code}\n".encode(), b"7\n"])
    radio, _ = rig(lambda _line: next(replies))
    with pytest.raises(RadioRefused, match=told) as caught:
        radio.tune(1000)
    assert caught.value.code == code
    assert radio.frequency_hz() == 7.0


@pytest.mark.parametrize(
    ("reply", "reason"),
    [
        (SILENCE, "silent"),
        (b"1379", "silent"),
        (b"RPRT 0\n", "silent"),
        (b"HTTP/1.1 400 Bad Request\n", "garbage"),
        (b"nan\n", "garbage"),
        (b"\xff\x00\x07\n", "garbage"),
        (b"x" * 9000, "garbage"),
        (HANG_UP, "closed"),
        ([b"137", HANG_UP], "closed"),
    ],
)
def test_whoever_makes_no_sense_is_left(rig, reply, reason):
    began = time.monotonic()
    with pytest.raises(RadioLost) as caught:
        rig(lambda _line: reply)[0].frequency_hz()
    assert caught.value.reason == reason
    assert time.monotonic() - began < 2.0


def test_a_deadline_counts_for_the_whole_answer(rig):
    radio, _ = rig(lambda _line: [b"1", 0.1, b"2", 0.1, b"3", 0.1, b"4", 0.1, b"5", 0.1, b"\n"])
    began = time.monotonic()
    with pytest.raises(RadioLost, match="only '12"):
        radio.frequency_hz()
    assert time.monotonic() - began < 0.45


def test_words_that_are_no_answer_to_a_setting(rig):
    with pytest.raises(RadioLost, match="not rigctld"):
        rig(lambda _line: b"OK\n")[0].tune(1000)


def test_a_receiver_is_never_tuned_below_zero(rig):
    radio, there = rig(sdr())
    with pytest.raises(ValueError, match="-5"):
        radio.tune(-5)
    assert there.heard == []


def test_nothing_listens(server):
    there = server(sdr())
    there.close()
    with pytest.raises(RadioLost, match=f"Nothing listens at 127.0.0.1:{there.port}"):
        connector()("127.0.0.1", there.port, 1.0)


def test_asking_once(server):
    assert ask_receiver(server(sdr()).address).frequency_hz == 100e6
    assert ask_receiver(server(lambda _line: b"RPRT -11\n").address) == ReceiverAnswers(level_code=-11)
    began = time.monotonic()
    with pytest.raises(RadioLost):
        ask_receiver(server(lambda _line: SILENCE).address, 0.2)
    assert time.monotonic() - began < 1.0


class TestHamlibItself:
    """rigctld 4.5 and later, with its dummy radio."""

    @pytest.fixture
    def radio(self, rigctld):
        rig = RigctlClient(connector()("127.0.0.1", rigctld, 1.0), time.monotonic)
        yield rig
        rig.close()

    def test_tunes_and_reads_back(self, radio):
        for freq_hz in (137_912_500, 1_701_300_007, 10_489_500_001):
            radio.tune(freq_hz)
            assert radio.frequency_hz() == freq_hz

    def test_has_a_signal(self, radio):
        assert -100.0 < radio.strength_db() < 100.0

    def test_does_not_know_aos_and_stays_in_step(self, radio):
        with pytest.raises(RadioRefused):
            radio.word("AOS")
        radio.tune(145_800_000)
        assert radio.frequency_hz() == 145_800_000

    def test_takes_los_for_half_a_command(self, radio):
        """Why LOS is told only to whoever took AOS: it waits for a value, and the next command would be that."""
        with pytest.raises(RadioLost) as caught:
            RigctlClient(radio._wire, time.monotonic, reply_s=0.3).word("LOS")
        assert caught.value.reason == "silent"

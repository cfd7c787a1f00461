"""A session in plain lines: which line answers which request, what answers none, and STOP from any thread."""

from __future__ import annotations

import re
import threading

import pytest
from birdcage.base.errors import CommandRefused, LinkError, NoReply, Stopped
from birdcage.console.line_session import LineDialect, LineSession
from birdcage.link.link import Link
from birdcage.link.transcript import Transcript
from line_machine import LineMachine

POSITION = re.compile(r"AZ([\d.]+) EL([\d.]+)")
VERSION = re.compile(r"VE(.+)")
DIALECT = LineDialect(line_end=b"\n", refusals=((re.compile(r"^ERR\b"), "unknown_command"),))


class Bench:
    def __init__(self, clock, machine=None, link=None):
        self.clock, self.machine = clock, machine or LineMachine(clock)
        self.unasked = []
        self.on_wake = lambda: None
        self.session = LineSession(
            link or Link(self.machine, clock), clock, DIALECT, wake=clock.wake, on_wake=self._woken,
            on_line=lambda line: self.unasked.append(line.text),
        )  # fmt: skip

    def _woken(self):
        self.clock.wake.clear()
        self.on_wake()


@pytest.fixture
def bench(clock):
    return Bench(clock)


def test_a_request_is_answered_by_the_line_that_matches(bench, clock):
    bench.machine.say(b"boot ok\r\n", 0.01)
    answer = bench.session.ask("AZ EL", POSITION)
    assert answer.match.groups() == ("180.0", "45.0")
    assert answer.at == clock.monotonic() == pytest.approx(1000.02)
    assert bench.unasked == ["boot ok"]
    assert bench.machine.written == b"AZ EL\n"


def test_a_line_that_was_there_before_is_no_answer(bench):
    bench.machine.say(b"AZ1.0 EL2.0\r\n")
    assert bench.session.ask("AZ EL", POSITION).match[1] == "180.0"
    assert bench.unasked == ["AZ1.0 EL2.0"]


def test_what_says_no_is_a_refusal(bench):
    with pytest.raises(CommandRefused, match="`XX`: ERR unknown") as refused:
        bench.session.ask("XX", VERSION)
    assert refused.value.reason == "unknown_command"
    assert bench.session.ask("VE", VERSION).match[1] == "1.2"


@pytest.mark.parametrize(
    ("said", "reason"),
    [(b"", "silent"), (b"\xff\x01\x02\xff", "garbage"), (b"VE\r\n", "echo"), (b"GS2\r\n", "blocked")],
)
def test_silence_has_its_reasons(bench, clock, said, reason):
    bench.machine.silent = True
    bench.machine.say(said, 0.1)
    with pytest.raises(NoReply) as silence:
        bench.session.ask("VE", VERSION)
    assert silence.value.reason == reason
    assert clock.monotonic() == pytest.approx(1002.0)


def test_the_late_answer_of_a_request_that_was_given_up_is_not_taken_for_the_next_ones(bench, clock):
    bench.machine.latency_s = 1.0
    with pytest.raises(NoReply):
        bench.session.ask("AZ EL", POSITION, within_s=0.2)
    bench.machine.az_deg, bench.machine.latency_s = 200.0, 0.02
    assert bench.session.ask("AZ EL", POSITION).match[1] == "200.0"
    assert bench.unasked == ["AZ180.0 EL45.0"]
    assert clock.monotonic() == pytest.approx(1002.02)


def test_what_comes_between_requests_goes_to_the_listener(bench, clock):
    bench.machine.push("AZ180.0 EL45.0", 0.3)
    while clock.monotonic() < 1001.0:
        bench.session.listen(1001.0)
    assert bench.unasked == ["AZ180.0 EL45.0"] * 3


def test_stop_goes_out_while_a_request_waits_and_may_end_it(bench, clock):
    bench.machine.silent, clock.countdown = True, 1

    def stop():
        bench.session.interject(["SA SE"])
        raise Stopped("STOP")

    bench.on_wake = stop
    with pytest.raises(Stopped):
        bench.session.ask("AZ EL", POSITION)
    assert bench.machine.lines() == ["AZ EL", "SA SE"]


def test_stop_of_another_thread_waits_for_the_line_that_was_let_out_and_keeps_the_next_one_back(bench):
    latched, other = threading.Event(), []

    def permit():
        if latched.is_set():
            raise Stopped("STOP is latched")
        latched.set()
        other.append(threading.Thread(target=bench.session.interject, args=(["SA SE"],)))
        other[0].start()

    bench.session.send("AZ100.0", permit)
    other[0].join(10)
    assert bench.machine.written == b"AZ100.0\nSA SE\n"
    with pytest.raises(Stopped):
        bench.session.send("AZ200.0", permit)
    assert b"AZ200.0" not in bench.machine.written


def test_only_text_goes_out(bench):
    for line in ("AZ\r10", "AZ\u00b0"):
        with pytest.raises(ValueError, match="printable ASCII"):
            bench.session.send(line)
        with pytest.raises(ValueError, match="printable ASCII"):
            bench.session.interject([line])
    assert bench.machine.written == b""


def test_a_machine_that_is_unplugged_is_a_lost_link(bench):
    bench.machine.gone = True
    with pytest.raises(LinkError) as lost:
        bench.session.ask("AZ EL", POSITION)
    assert lost.value.reason == "lost"


def test_every_byte_stands_in_the_transcript(clock):
    entries = []
    transcript = Transcript(None, version="0")
    transcript.listen(entries.append)
    machine = LineMachine(clock)
    bench = Bench(clock, machine, Link(machine, clock, transcript))
    bench.session.ask("VE", VERSION)
    assert [(entry.direction, entry.data) for entry in entries if entry.direction != "#"] == [
        (">", b"VE\n"),
        ("<", b"VE1.2\r\n"),
    ]

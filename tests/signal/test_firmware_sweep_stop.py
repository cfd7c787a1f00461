"""STOP in the middle of a sweep that the dish makes by itself: a key goes out at once, and what is said is so."""

from __future__ import annotations

import pytest
from birdcage.rotator.ladder import StopMeans
from birdcage.station.events import ActivityChanged, StopConfirmed
from birdcage.station.requests import Release
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.stop_words import stop_line

from tests.signal.test_firmware_sweep import begin, end_of, made, sent


def swept_and_stopped(options, after_s, **values):
    """Return a bench whose STOP was called so long after the sweep began, and what had been heard by then."""
    bench = made(options)
    begin(bench, span_deg=40.0, **values)

    def stop():
        bench.asked_at, bench.written_before = bench.clock.monotonic(), len(bench.written)
        bench.line = stop_line(bench.state, bench.asked_at)
        bench.shown = bench.state.activity
        bench.station.stop("you")
        bench.first_bytes = bytes(bench.written[bench.written_before :])

    def begun(event):
        if isinstance(event, ActivityChanged) and event.activity is Activity.SWEEPING and not hasattr(bench, "line"):
            bench.later(after_s, stop)

    bench.station.subscribe(begun)
    return bench


def stops(bench):
    return [event.report for event in bench.events if isinstance(event, StopConfirmed)]


def test_stop_ends_a_sweep_where_a_key_does_and_the_dish_is_seen_at_rest():
    bench = swept_and_stopped("&sweep_key=abort", 1.5)
    ended = end_of(bench)
    bench.step(5.0)
    assert bench.first_bytes == b"\r"
    assert bench.shown is Activity.SWEEPING
    assert bench.line == "STOP sends a key; the sweep may go on to its end. In an emergency, switch off its 12 V."
    (report,) = stops(bench)
    assert (report.means, report.confirmed) == (StopMeans.KEY, True)
    assert report.sentence.startswith("Stands still at ")
    assert "STOP by you. The sweep is not complete." in ended.why
    assert 2 <= len(ended.found["line"]) < 30
    assert bench.state.position.az_deg < 160.0
    at = bench.clock.monotonic()
    bench.step(20.0)
    assert bench.moves_since(bench.asked_at) == []
    assert bench.state.activity is Activity.IDLE
    assert bench.state.held is not None
    assert at > bench.asked_at


@pytest.mark.parametrize("key", ["swallow", "keep"])
def test_whatever_becomes_of_the_key_the_console_is_proven_before_anything_else_is_sent(key):
    bench = swept_and_stopped(f"&sweep_key=abort&stream_key={key}", 1.5)
    end_of(bench)
    bench.step(8.0)
    assert stops(bench)[-1].confirmed is True
    lines = bench.lines()[bench.lines().index(sent(bench)[0]) + 1 :]
    assert set(lines) <= {"", "a"}, lines
    assert bench.state.menu == "mot"
    assert bench.state.link.state is LinkPhase.UP


def test_stop_is_not_confirmed_while_a_sweep_goes_on_that_takes_no_key():
    bench = swept_and_stopped("", 1.5, transponders=2)
    ended = end_of(bench)
    bench.step(10.0)
    assert bench.first_bytes == b"\r"
    first, last = stops(bench)
    assert (first.means, first.confirmed) == (StopMeans.KEY, False)
    assert first.sentence.startswith("The sweep goes on to its end")
    assert last.confirmed is False
    assert last.sentence.startswith("Stands still at 170.")
    assert "STOP by you." in ended.why
    assert len(ended.found["line"]) < 20
    assert bench.state.activity is Activity.IDLE
    assert bench.moves_since(bench.asked_at) == []
    assert bench.state.link.state is LinkPhase.UP


def test_the_words_of_stop_are_true_while_it_goes_on():
    bench = swept_and_stopped("", 1.5, transponders=2)
    seen = []
    bench.station.watch(lambda state: seen.append((state.activity, state.last_stop and state.last_stop.confirmed,
                                                   stop_line(state, 0.0))))  # fmt: skip
    end_of(bench)
    bench.step(10.0)
    not_confirmed = {line for activity, confirmed, line in seen if activity is Activity.STOPPING and confirmed is False}
    assert not_confirmed == {"STOP is not confirmed. If the dish moves, switch off its 12 V."}
    assert not any("holds" in line for activity, _, line in seen if activity in (Activity.SWEEPING, Activity.STOPPING))


def test_a_stop_before_the_line_is_out_keeps_it_back():
    bench = made()
    begin(bench)
    bench.later(0.5, lambda: bench.station.stop("you"))
    end_of(bench)
    bench.step(10.0)
    assert not sent(bench)


def test_a_stop_just_before_the_line_keeps_it_back():
    """It is latched between the last look at the position and the line, and noticed by nothing else than the permit."""
    bench = made()
    antenna = bench.station._antenna
    protocol = antenna.rotator._rotator.protocol
    relay = protocol.console.relay

    def late(*args):
        bench.station.stop("you")
        return relay(*args)

    protocol.console.relay = late
    begin(bench)
    end_of(bench)
    bench.step(10.0)
    assert not sent(bench)
    assert bench.state.held is not None


def test_a_sweep_can_be_made_after_a_stop_is_released():
    bench = swept_and_stopped("", 1.5)
    end_of(bench)
    bench.step(60.0)
    bench.do(Release("you"))
    begin(bench, span_deg=4.0)
    assert end_of(bench).is_done

"""Lines that must not come too fast: the session leaves the console alone for so long, and STOP does not wait."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import NoReply
from birdcage.base.wake import Wake
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.session import Console
from birdcage.sim.port import open_port

PACED = ConsoleDialect(prompts={"root": "TRK>", "mot": "MOT>", "nvs": "NVS>"}, gap_s=1.0, gaps_s={"mot": 0.2})


class Paced:
    def __init__(self, dialect=PACED, **hooks):
        self.clock = VirtualClock()
        self.port = open_port("g2?seed=1", clock=self.clock)
        self.sent = []
        write = self.port.write

        def note(data):
            self.sent.append((self.clock.monotonic(), data))
            write(data)

        self.port.write = note
        self.console = Console(self.port, self.clock, dialect, **hooks)

    @property
    def gaps(self):
        times = [at for at, _ in self.sent]
        return [later - earlier for earlier, later in itertools.pairwise(times)]


def test_each_line_waits_for_its_turn_the_first_one_too_as_another_program_may_have_sent_one():
    paced = Paced()
    before = paced.clock.monotonic()
    paced.console.synchronize()
    assert paced.sent[0][0] - before >= 1.0
    for _ in range(3):
        paced.console.run("nvs", "d 20")
    assert len(paced.gaps) >= 4
    assert min(paced.gaps) >= 1.0


def test_a_menu_may_hear_faster_but_not_after_what_leaves_it():
    paced = Paced()
    paced.console.enter("mot")
    for _ in range(3):
        paced.console.run("mot", "a")
    assert all(0.2 <= gap < 0.3 for gap in paced.gaps[-2:])
    paced.console.enter("nvs")
    for (_, line), gap in zip(paced.sent, paced.gaps, strict=False):
        assert gap >= (1.0 if b"q" in line else 0.2)


def test_without_a_gap_nothing_waits():
    paced = Paced(replace(PACED, gap_s=0.0, gaps_s={}))
    before = paced.clock.monotonic()
    paced.console.run("nvs", "d 20")
    assert paced.clock.monotonic() - before < 0.3


def test_stop_goes_out_at_once_and_what_follows_waits_for_it_too():
    paced = Paced()
    paced.console.run("mot", "a")
    at = paced.clock.monotonic()
    paced.console.interject(["a 0 10"])
    assert paced.sent[-1] == (at, b"a 0 10\r")
    paced.console.settle(2.0)
    paced.console.run("mot", "a")
    assert paced.sent[-1][0] - at >= 0.2


def test_a_line_that_waits_gives_way_to_stop():
    wake = Wake()

    class Ended(Exception):
        pass

    def on_wake():
        wake.clear()
        raise Ended

    paced = Paced(wake=wake, on_wake=on_wake)
    paced.console.synchronize()
    sent = len(paced.sent)
    wake.set()
    with pytest.raises(Ended):
        paced.console.exchange("?")
    assert len(paced.sent) == sent
    wake.close()


def test_what_took_long_to_begin_was_no_slow_answer():
    paced = Paced()
    paced.console.run("nvs", "d 20")
    paced.console.run("nvs", "d 20")
    assert paced.console.took_s < 0.2


@pytest.mark.parametrize(("within_s", "left"), [(0.9, False), (2.0, True)])
def test_before_the_port_closes_the_pace_counts_and_nothing_goes_out_that_has_no_time(within_s, left):
    paced = Paced(delay_s=0.2)
    paced.console.enter("mot")
    paced.console.run("mot", "a")
    paced.clock.advance(3.0)
    paced.console.synchronize()
    sent, began = len(paced.sent), paced.clock.monotonic()
    assert paced.console.leave_all(within_s) is left
    assert paced.clock.monotonic() - began <= within_s
    assert [line for _, line in paced.sent[sent:]] == ([b"\r", b"q\r"] if left else [])


def test_a_line_whose_turn_comes_too_late_is_not_sent():
    paced = Paced()
    paced.console.run("nvs", "d 20")
    wire, sent = paced.console._wire, len(paced.sent)
    wire.limit = paced.clock.monotonic() + 0.5
    with pytest.raises(NoReply, match="no time left"):
        paced.console.run("nvs", "d 20")
    assert len(paced.sent) == sent
    assert paced.clock.monotonic() < wire.limit, "and it says so at once"

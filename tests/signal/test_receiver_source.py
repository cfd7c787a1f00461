"""The receiver as a signal source: on its own, beside a dish that is not connected, and around a pass."""

from __future__ import annotations

import itertools

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings
from birdcage.base.config.feeds import FeedProfile, FeedSettings
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.radio.now import RadioState
from birdcage.radio.probe import ask_receiver
from birdcage.signal.receiver import PAUSE_S, ReceiverSource
from birdcage.signal.source import MONITOR, Scale

from tests.radio.passing import passing
from tests.radio.scripted import SILENCE, Desk, sdr
from tests.station.conftest import Bench

BY_RECEIVER = Settings(
    feed=FeedSettings("helix"), feeds={"helix": FeedProfile(signal="rigctl")}, radio=RadioSettings(rigctld="radio:4532")
)


class Counted(Desk):
    """Counts how many connections were open at a time."""

    most_open = 0

    def __call__(self, *address):
        wire = super().__call__(*address)
        self.most_open = max(self.most_open, self.open)
        return wire


class House:
    """A source on a virtual clock, its receiver, and a station whose dish was never connected."""

    def __init__(self, answer=None, settings=BY_RECEIVER):
        bench = Bench()
        self.clock, self.station = bench.clock, bench.station
        self.desk = Counted(self.clock, answer or sdr())
        self.source = ReceiverSource(self.station, settings, self.clock, threads=False, connect=self.desk)
        self.heard, self.owners = [], []
        self.source.subscribe(self.heard.append)

    def run(self, seconds):
        until = self.clock.monotonic() + seconds
        while self.clock.monotonic() < until:
            due = self.source.step()
            if not self.owners or self.owners[-1] != self.owner:
                self.owners.append(self.owner)
            self.clock.wait(None, min(due, until))
        return self

    def watched(self, seconds):
        self.source.watch(MONITOR)
        return self.run(seconds)

    @property
    def owner(self):
        return self.station.state.signal_owners.get("rigctl", "")

    @property
    def words(self):
        return {line.split()[0] for _, line in self.desk.heard}


def test_it_is_read_once_a_second_with_no_pass_and_no_dish_and_is_left_as_it_is_tuned():
    house = House().watched(30.0)
    assert 29 <= len(house.heard) <= 31
    assert {reading.value for reading in house.heard} == {-41.5}
    assert (house.heard[0].unit, house.heard[0].source) == ("dB", "rigctl")
    assert house.words == {"f", "l"}
    assert (house.owner, house.source.trouble) == (MONITOR, "")
    assert house.source.now.state is RadioState.LISTENING


def test_its_facts_say_what_is_known_and_nothing_else():
    facts = House().source.facts
    assert (facts.unit, facts.scale, facts.rate_hz) == ("dB", Scale.LOG, 1.0)
    assert (facts.latency_s, facts.dwell_s) == (None, None)
    assert not facts.demo


def test_nobody_looks_and_it_belongs_to_its_owner():
    house = House().run(60.0)
    assert house.desk.connected == 0
    house.watched(5.0)
    told = len(house.heard)
    house.source.unwatch(MONITOR)
    house.run(60.0)
    assert (house.desk.open, house.desk.connected, len(house.heard)) == (0, 1, told)
    assert house.owner == ""


def test_a_reading_is_of_the_middle_between_question_and_answer():
    house = House()
    house.desk.latency_s = 0.8
    house.watched(10.0)
    asked = [at for at, line in house.desk.heard if line == "l STRENGTH"]
    assert len(house.heard) >= 5
    for at, reading in zip(asked, house.heard, strict=False):
        assert reading.at == pytest.approx(at + 0.4)
        ago_s = (house.clock.utc() - reading.utc).total_seconds()
        assert ago_s == pytest.approx(house.clock.monotonic() - reading.at)


def test_one_that_is_listened_to_tells_where_it_is_tuned_when_somebody_turns_it():
    radio = sdr()
    house = House(radio).watched(3.0)
    assert house.source.facts.set_to == (("freq_hz", "100000000"),)
    radio("F 1420405000")
    house.run(12.0)
    assert house.source.facts.set_to == (("freq_hz", "1420405000"),)


def test_a_slow_one_makes_no_gap():
    house = House()
    house.desk.latency_s = 1.9  # of the two seconds that it is given
    house.watched(30.0)
    times = [reading.at for reading in house.heard]
    assert len(times) >= 12
    assert max(after - before for before, after in itertools.pairwise(times)) < PAUSE_S


@pytest.mark.parametrize(
    ("answer", "state", "words"),
    [
        (lambda _line: SILENCE, RadioState.LOST, "radio:4532: No answer to 'f' within 2 s."),
        (lambda _line: b"220 mail.example.org\n", RadioState.REFUSED, "that is not rigctld"),
        (lambda line: b"nan\n" if line[0] == "l" else b"1\n", RadioState.REFUSED, "'l STRENGTH' with 'nan'"),
        (sdr(strength=None), RadioState.REFUSED, "No level: SDR++ advertises one and answers RPRT 1."),
    ],
    ids=["silent", "garbage", "no number", "refuses"],
)
def test_one_that_tells_nothing_is_told_and_nothing_is_invented(answer, state, words):
    house = House(answer).watched(20.0)
    assert house.heard == []
    assert words in house.source.trouble
    assert house.source.now.state in (state, RadioState.CONNECTING)
    assert house.desk.most_open == 1


def test_one_that_refuses_its_level_is_hung_up_as_it_serves_one_program():
    house = House(sdr(strength=None)).watched(20.0)
    assert (house.desk.connected, house.desk.open) == (1, 0)
    house.run(50.0)
    assert house.desk.connected == 3  # every half a minute


def test_one_that_vanishes_leaves_a_gap_and_is_heard_again_when_it_returns():
    house = House().watched(10.0)
    house.desk.there = False
    gone = house.clock.monotonic()
    house.run(40.0)
    assert "radio:4532" in house.source.trouble
    assert all(reading.at <= gone for reading in house.heard)
    house.desk.there = True
    back = house.clock.monotonic()
    house.run(10.0)
    assert house.source.trouble == ""
    first = next(reading.at for reading in house.heard if reading.at > gone)
    assert back < first < back + 8.5


def test_a_receiver_that_nobody_has_set_is_told_with_what_sets_it():
    house = House(settings=Settings(feed=BY_RECEIVER.feed, feeds=BY_RECEIVER.feeds)).watched(5.0)
    assert house.source.trouble.startswith('No receiver is set. [radio] rigctld = "localhost:4532"')
    assert house.owner == ""


def test_a_pass_takes_it_over_its_one_connection_and_gives_it_back():
    house = House().watched(5.0)
    begin = house.clock.monotonic()
    house.source.follow(passing(house.clock.utc().timestamp() + 100.0, name="LEO 1"))
    house.run(39.0)
    assert house.words == {"f", "l"}, "until a minute before reach it is only listened to"
    house.run(2.0)
    assert "F" in house.words
    assert house.owner == "LEO 1"
    house.run(670.0)
    assert [line for _, line in house.desk.heard if line in ("AOS", "LOS")] == ["AOS", "LOS"]
    tuned = [at - begin for at, _ in house.desk.lines("F")]
    assert 39.5 <= tuned[0] <= 40.5
    assert tuned[-1] <= 700.5
    house.source.follow(None)
    house.run(20.0)
    assert house.owners == [MONITOR, "LEO 1", "", MONITOR]
    assert house.desk.most_open == 1, "never two connections"
    times = [reading.at for reading in house.heard]
    assert max(after - before for before, after in itertools.pairwise(times)) < PAUSE_S


def test_a_pass_has_its_level_read_where_the_feed_is_heard_by_it_and_hangs_up_where_nobody_looks():
    house = House()
    house.source.follow(passing(house.clock.utc().timestamp() + 61.0, length_s=60.0))
    house.run(130.0)
    assert 110 <= len(house.heard) <= 125
    assert (house.desk.open, house.owner) == (0, "")


def test_other_settings_count_between_two_passes_only():
    house = House().watched(5.0)
    house.source.follow(passing(house.clock.utc().timestamp() - 1.0))
    house.run(5.0)
    other = Settings(feed=BY_RECEIVER.feed, feeds=BY_RECEIVER.feeds, radio=RadioSettings(rigctld="other:7356"))
    house.source.use(other)
    house.run(5.0)
    assert house.source.now.address == "radio:4532"
    house.source.follow(None)
    house.run(2.0)
    house.source.use(other)
    house.run(2.0)
    assert house.source.now.address == "other:7356"
    assert house.desk.open == 1
    assert house.heard[-1].at > house.clock.monotonic() - 2.0


def test_the_simulated_receiver_is_read_by_its_address_with_no_dish_and_marked():
    bench, heard = Bench(), []
    settings = Settings(feed=BY_RECEIVER.feed, feeds=BY_RECEIVER.feeds, radio=RadioSettings(rigctld="sim:rig"))
    source = ReceiverSource(bench.station, settings, bench.clock, threads=False)
    assert source.now.address == "sim:rig"
    source.subscribe(heard.append)
    source.watch(MONITOR)
    until = bench.clock.monotonic() + 30.0
    while bench.clock.monotonic() < until:
        bench.clock.wait(None, source.step())
    assert 29 <= len(heard) <= 31
    assert all(reading.value == pytest.approx(-60.0, abs=2.0) for reading in heard), "its own noise"
    assert len({reading.value for reading in heard}) > 3
    assert source.facts.demo


class TestOnItsThread:
    """The real clock and real sockets."""

    def source(self, address):
        settings = Settings(feed=BY_RECEIVER.feed, feeds=BY_RECEIVER.feeds, radio=RadioSettings(rigctld=address))
        return ReceiverSource(Bench().station, settings, RealClock(), threads=True)

    def until(self, true):
        clock = RealClock()
        deadline = clock.monotonic() + 60.0
        while not true():
            assert clock.monotonic() < deadline
            clock.wait(None, clock.monotonic() + 0.01)

    def test_nothing_is_called_before_somebody_watches_and_closing_hangs_up(self, server):
        there, heard = server(sdr()), []
        source = self.source(there.address)
        source.subscribe(heard.append)
        assert there.accepted == 0
        source.watch(MONITOR)
        self.until(lambda: heard)
        assert heard[0].value == -41.5
        source.close()
        assert set(there.heard) == {"f", "l STRENGTH"}

    def test_a_mute_one_holds_up_nobody_who_looks_away_or_ends(self, server):
        there = server(lambda _line: SILENCE)
        source = self.source(there.address)
        source.watch(MONITOR)
        self.until(lambda: there.heard == ["f"])
        source.unwatch(MONITOR)
        source.close()
        self.until(lambda: source.now.state is RadioState.OFF)

    def test_hamlibs_own_daemon_is_read_and_left_as_it_is_tuned(self, rigctld):
        heard = []
        source = self.source(f"127.0.0.1:{rigctld}")
        source.subscribe(heard.append)
        before = ask_receiver(f"127.0.0.1:{rigctld}").frequency_hz
        source.watch(MONITOR)
        self.until(lambda: len(heard) >= 2)
        source.close()
        assert source.trouble == ""
        assert ask_receiver(f"127.0.0.1:{rigctld}").frequency_hz == before

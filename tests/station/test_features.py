"""`Read` and `Set`: features by name, at what each costs."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LeaseDenied,
    LinkError,
    NoReply,
    OutOfRange,
)
from birdcage.base.reason import Reason
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.g2.protocol import CarryoutG2Protocol
from birdcage.protocol.g2.tuner import Tuner
from birdcage.protocol.menu_rotator import MenuRotator
from birdcage.rotator.feature import Cost, Feature, FeatureKind, Reading, Writer
from birdcage.rotator.verdict import Grade
from birdcage.station.events import ReadingRead
from birdcage.station.requests import AcquireLease, Goto, Raw, Read, Release, ReleaseLease, Set
from birdcage.station.state import Activity, LinkPhase, TvSearch

from .conftest import Bench


@pytest.fixture
def bench(tmp_path):
    bench = Bench(options={"backup_folder": tmp_path})
    bench.watch("position")
    bench.connect(10.0)
    assert bench.state.activity is Activity.IDLE
    return bench


def told(bench, feature):
    return [event for event in bench.events if isinstance(event, ReadingRead) and event.feature == feature]


def test_features_are_read_shown_and_told_and_the_dish_is_back_in_the_motor_menu(bench):
    since = len(bench.lines())
    readings = bench.do(Read(("rssi", "lnb_supply", "version")))
    assert readings["rssi"].unit == "counts"
    assert readings["lnb_supply"].value == pytest.approx(18.0, abs=0.5)
    assert readings["version"].value == "02.02.48"
    assert bench.state.readings["lnb_supply"] == readings["lnb_supply"]
    assert [event.unit for event in told(bench, "lnb_supply")] == ["V"]
    assert bench.state.menu == "mot"
    assert [line for line in bench.lines()[since:] if line in ("rssi 10", "lnbv", "id")] == ["rssi 10", "lnbv", "id"]


def test_a_reading_stands_until_its_feature_may_be_read_again(bench):
    first = bench.do(Read(("lnb_supply",)))["lnb_supply"]
    assert bench.do(Read(("lnb_supply",)))["lnb_supply"] == first
    assert bench.lines().count("lnbv") == 1
    bench.step(bench.state.dish.features["lnb_supply"].cost.min_interval_s)
    assert bench.do(Read(("lnb_supply",)))["lnb_supply"].at > first.at
    assert bench.lines().count("lnbv") == 2


def test_nothing_is_read_or_set_while_the_dish_moves(bench):
    since = len(bench.lines())
    bench.station.submit(Goto(90.0, 45.0, "you"))
    bench.step(0.3)
    assert bench.state.motion is not None
    for request in (Read(("version",)), Set("speed.azimuth", 5.0, "you"), Set("tv_search", True, "you", agreed=True)):
        with pytest.raises(BirdcageError) as refused:
            bench.do(request, 0.5)
        assert refused.value.reason == "moving"
    assert not {"id", "mv 0 555", "e 20 0"} & set(bench.lines()[since:])


def test_what_the_dish_lacks_is_refused_with_nothing_sent(bench):
    before = bench.received()
    for request in (Read(("rssi", "rainfall")), Set("rssi", 5.0, "you"), Set("rainfall", 5.0, "you")):
        with pytest.raises(CommandRefused, match="Nothing was sent") as refused:
            bench.station.submit(request).result(bench.step(0.0))
        assert refused.value.reason == "unsupported"
    assert bench.received() == before


def test_a_speed_is_set_read_back_and_planned_with(bench):
    assert bench.do(Set("speed.azimuth", 10.0, "you")).value == pytest.approx(10.0, abs=0.01)
    assert bench.station._antenna.speeds_deg_s[0] == pytest.approx(10.0, abs=0.01)
    assert bench.state.readings["speed.elevation"].value == pytest.approx(45.0, abs=0.01)
    with pytest.raises(OutOfRange, match="beyond its limit of 65 deg/s"):
        bench.do(Set("speed.azimuth", 66.0, "you"))
    assert bench.state.readings["speed.azimuth"].value == pytest.approx(10.0, abs=0.01)


def test_a_hazard_needs_consent_and_settings_a_backup(bench, tmp_path):
    with pytest.raises(ConfirmationNeeded, match=r"it moves by itself\. Nothing was sent"):
        bench.do(Set("tv_search", True, "you"))
    assert "e 20 0" not in bench.lines()
    assert bench.do(Set("tv_search", True, "you", agreed=True)).value is True
    (backup,) = tmp_path.iterdir()
    assert "Disable Tracker" in backup.read_text()
    assert bench.lines().index("d") < bench.lines().index("e 20 0")
    bench.do(ReleaseLease("you"))
    bench.step(0.5)
    assert bench.do(Read(("tv_search",)))["tv_search"].value is True


def test_who_has_control_sets_and_held_nothing_is_done(bench):
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied, match="tracker has control"):
        bench.do(Set("tv_search", True, "you", agreed=True))
    assert bench.do(Read(("version",)))["version"].value == "02.02.48"
    bench.station.stop("you")
    bench.step(3.0)
    with pytest.raises(Held):
        bench.do(Set("tv_search", True, "you", agreed=True))


def test_a_question_that_is_refused_leaves_the_motor_menu_behind_it(bench, monkeypatch):
    def refuse(_tuner):
        raise CommandRefused("The tuner is off.")

    monkeypatch.setattr(Tuner, "snr_db", refuse)
    with pytest.raises(CommandRefused, match="The tuner is off"):
        bench.do(Read(("snr",)))
    assert bench.state.menu == "mot"
    assert not bench.station._reader.elsewhere
    assert set(bench.do(Read(("snr", "rssi")))) == {"rssi"}, "what is refused keeps nothing else from being read"
    assert bench.state.menu == "mot"
    assert not bench.station._reader.elsewhere


def test_who_talks_to_the_dish_is_not_disturbed(bench):
    bench.do(Raw("a", "console", Grade.HARMLESS))
    with pytest.raises(LeaseDenied, match="A person has the console"):
        bench.do(Read(("version",)))
    assert "id" not in bench.lines()[-2:]


def test_without_a_link_nothing_is_asked(bench):
    bench.device.unplug()
    bench.step(5.0)
    assert bench.state.link.state is not LinkPhase.UP
    with pytest.raises(LinkError):
        bench.do(Read(("version",)))


def test_a_search_that_is_only_ended_is_a_momentary_feature():
    bench = Bench("hal205?seed=1", firmware="hal205")
    bench.watch("position")
    bench.connect(15.0)
    assert bench.do(Set("end_tv_search", True, "you")).value is True
    assert bench.state.search is TvSearch.OFF_UNTIL_POWER_UP
    with pytest.raises(CommandRefused, match="end_tv_search that can be read"):
        bench.do(Read(("end_tv_search",)))


def test_a_watched_signal_is_read_no_sooner_than_its_feature_may_be():
    rssi = replace(CARRYOUT_G2.features["rssi"], cost=Cost(1, "dvb", 2.0))
    bench = Bench()
    rotator = bench.station._antenna.rotator
    rotator.facts = replace(rotator.facts, features={**rotator.facts.features, "rssi": rssi})
    bench.watch("position", "rssi")
    bench.connect(40.0)
    times = [event.at for event in told(bench, "rssi")]
    assert len(times) > 6
    assert min(later - before for before, later in pairwise(times)) >= 2.0


@pytest.mark.parametrize("asked", ["lnb_supply", "rssi"])
def test_stop_in_the_middle_of_a_question_is_confirmed_and_finds_the_motor_menu(bench, asked):
    began = bench.clock.monotonic()
    bench.later(0.08, lambda: bench.station.stop("you"))
    future = bench.station.submit(Read((asked,)))
    bench.step(8.0)
    assert future.done()
    stop = bench.state.last_stop
    assert stop.at == pytest.approx(began + 0.08, abs=0.01)
    assert (stop.confirmed, bench.state.held.reason) == (True, "stop")
    assert bench.state.menu == "mot"
    assert bench.state.link.state is LinkPhase.UP
    bench.do(Release("you"))
    bench.do(Goto(20.0, 45.0, "you"))


def test_a_value_that_the_dish_never_tells_is_not_kept_as_read(monkeypatch):
    """It may have forgotten it since, and nothing would tell."""
    lamp = Feature("lamp", "Lamp", kind=FeatureKind.SWITCH, writer=Writer.UNTIL_RESTART, told=False)
    model = replace(CARRYOUT_G2, features={**CARRYOUT_G2.features, "lamp": lamp})
    monkeypatch.setattr(CarryoutG2Protocol, "model", model)
    monkeypatch.setattr(MenuRotator, "write", lambda dish, _id, on: Reading(on, "", 0.0, dish.clock.utc()))
    bench = Bench().connect()
    assert bench.do(Set("lamp", True, "you")).value is True
    assert "lamp" not in bench.state.readings


def test_the_transponder_is_told_with_its_channel_by_one_line(bench):
    since = len(bench.lines())
    readings = bench.do(Read(("transponder", "frequency", "polarisation")))
    assert (readings["transponder"].value, readings["polarisation"].value) == (15, "V")
    assert readings["frequency"].value == pytest.approx(1178.12)
    assert bench.lines()[since:].count("dis") == 1


def test_what_was_read_before_something_was_set_is_read_again(bench):
    bench.do(Read(("frequency",)))
    bench.do(Set("transponder", 7.0, "you"))
    assert bench.do(Read(("frequency",)))["frequency"].value == pytest.approx(1061.48)
    since = len(bench.lines())
    bench.do(Read(("frequency", "transponder")))
    assert bench.lines()[since:] == [], "both are fresh"


@pytest.fixture
def lost_reply(monkeypatch):
    """What is written reaches the dish, and its reply does not come back."""
    write = MenuRotator.write

    def lost(rotator, name, value):
        write(rotator, name, value)
        raise NoReply("Garbled.", reason=Reason.GARBAGE)

    monkeypatch.setattr(MenuRotator, "write", lost)


def test_what_was_read_before_a_set_whose_reply_is_lost_is_read_again(bench, lost_reply):
    assert bench.do(Read(("frequency",)))["frequency"].value == pytest.approx(1178.12)
    with pytest.raises(NoReply):
        bench.do(Set("transponder", 7.0, "you"))
    bench.step(1.0)
    assert bench.do(Read(("frequency",)))["frequency"].value == pytest.approx(1061.48)


def test_what_reading_itself_changes_needs_consent_before_anything_is_sent(bench):
    since = len(bench.lines())
    with pytest.raises(ConfirmationNeeded, match="switches the LNB supply"):
        bench.do(Read(("lock", "odd_level")))
    assert {"dvb", "peak", "rssits", "ls"}.isdisjoint(bench.lines()[since:])
    told = bench.do(Read(("even_level", "odd_level"), agreed=True))
    assert bench.lines()[since:].count("rssits") == 1
    assert told["even_level"].value == pytest.approx(489, abs=5)
    assert told["odd_level"].value == pytest.approx(235, abs=5)

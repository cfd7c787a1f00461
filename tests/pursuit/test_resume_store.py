"""A program that dies in mid-pass: what the next one offers, and when it goes on by itself."""

from __future__ import annotations

import json

import pytest
from birdcage.base.config import Settings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.config.tracking_sections import TrackingSettings
from birdcage.pursuit.now import Mode
from birdcage.pursuit.resume_file import FILE
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Release

STATION = "DEMO LEO 2 station"
RESUMES = Settings(
    tracking=TrackingSettings(resume=True, resume_within_s=10.0), motion=MotionSettings(min_elevation_deg=50.0)
)


def follow(bench, seconds=8.0):
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(seconds)
    return bench


def kept(bench):
    file = bench.paths.state / FILE
    return json.loads(file.read_text()) if file.exists() else None


def test_nothing_is_kept_before_the_pass_and_its_place_while_it_is_followed(bench):
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do(5.0)
    assert kept(bench) is None
    follow(bench)
    first = kept(bench)
    assert (first["text"], first["name"], first["left"]) == (STATION, STATION, False)
    bench.step(5.0)
    later = kept(bench)
    assert later["seen"] > first["seen"]
    assert later["since"] == first["since"]
    truth = bench.device.truth()
    assert later["az_deg"] == pytest.approx(truth.az_deg % 360.0, abs=4.0)
    assert later["el_deg"] == pytest.approx(truth.el_deg, abs=1.0)


@pytest.mark.parametrize("end", ["leave", "stop", "its end"])
def test_a_pursuit_that_ends_in_order_is_forgotten(bench, end):
    follow(bench)
    if end == "leave":
        bench.desk.leave()
    elif end == "stop":
        bench.station.stop("you")
    bench.until(lambda: bench.phase() is Phase.OVER)
    bench.do(2.0)
    assert kept(bench) is None


def test_the_next_program_offers_it_and_waits_for_a_person(bench):
    follow(bench)
    bench.kill(3.0)
    bench.start()
    unfinished = bench.desk.now.unfinished
    assert (unfinished.name, unfinished.text) == (STATION, STATION)
    assert unfinished.reach_end > bench.clock.utc()
    bench.step(20.0)
    assert bench.pursuit is None
    bench.desk.take_up()
    now = bench.do(2.0)
    assert (now.mode, now.choice, now.unfinished) == (Mode.FOLLOW, STATION, None)
    bench.until(lambda: bench.phase() is Phase.FOLLOWING, 60.0)


def test_it_goes_on_by_itself_after_a_countdown_if_its_owner_wants_that(make):
    bench = follow(make(settings=RESUMES))
    bench.kill(1.0)
    bench.start()
    bench.until(lambda: bench.phase() is Phase.COUNTDOWN, 5.0)
    bench.until(lambda: bench.phase() is Phase.FOLLOWING, 60.0)
    assert bench.desk.now.unfinished is None


def test_after_a_long_gap_it_waits(make):
    bench = follow(make(settings=RESUMES))
    bench.kill(15.0)
    bench.start()
    bench.step(20.0)
    assert bench.pursuit is None
    assert bench.desk.now.unfinished is not None


def test_a_dish_that_was_moved_meanwhile_waits(make):
    bench = follow(make(settings=RESUMES))
    bench.kill(1.0)
    values = kept(bench)
    elsewhere = {key: values[key] + 2.0 for key in ("el_deg", "ahead_el_deg")}
    (bench.paths.state / FILE).write_text(json.dumps(values | elsewhere))
    bench.start()
    bench.step(20.0)
    assert bench.pursuit is None
    assert bench.desk.now.unfinished is not None


def test_a_program_that_was_ended_in_order_is_offered_but_does_not_go_on_by_itself(make):
    bench = follow(make(settings=RESUMES))
    bench.desk.close()
    assert kept(bench)["left"] is True
    bench.kill(1.0)
    bench.start()
    bench.step(10.0)
    assert bench.pursuit is None
    assert bench.desk.now.unfinished is not None


def test_once_its_pass_is_over_nothing_is_offered(bench):
    follow(bench)
    bench.kill(600.0)
    bench.start()
    assert bench.desk.now.unfinished is None
    assert kept(bench) is None


def test_it_can_be_forgotten(bench):
    follow(bench)
    bench.kill(3.0)
    bench.start()
    bench.desk.forget_unfinished()
    assert bench.do().unfinished is None
    assert kept(bench) is None


def test_what_is_followed_by_hand_meanwhile_takes_its_place(make):
    bench = follow(make(settings=RESUMES))
    bench.kill(15.0)
    bench.start()
    bench.desk.choose("az 30 el 55")
    bench.desk.follow()
    bench.do()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING, 60.0)
    bench.do(3.0)
    assert bench.desk.now.unfinished is None
    assert kept(bench)["text"] == "az 30 el 55"


def test_stop_in_the_countdown_ends_it(make):
    bench = follow(make(settings=RESUMES))
    bench.kill(1.0)
    bench.start()
    bench.until(lambda: bench.phase() is Phase.COUNTDOWN, 5.0, every=0.1)
    bench.station.stop("you")
    bench.until(lambda: bench.phase() is Phase.OVER, 5.0)
    bench.station.submit(Release("you"))
    bench.step(30.0)
    assert bench.phase() is Phase.OVER

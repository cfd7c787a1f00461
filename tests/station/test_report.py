"""What `status --json` tells: plain values, and None for what is not known."""

from __future__ import annotations

import json
from dataclasses import replace

from birdcage.base.config import AlignmentSettings, Settings
from birdcage.station.report import status_report
from birdcage.station.requests import ApplySettings, Goto
from birdcage.station.state import StationState


def report(bench):
    told = status_report(bench.state, bench.clock.monotonic())
    assert json.loads(json.dumps(told)) == told
    return told


def test_of_a_station_that_knows_nothing() -> None:
    told = status_report(StationState(), 5.0)
    assert {key for key, value in told.items() if value is not None} == {"connected", "link", "demo", "held", "stop"}
    assert told["connected"] is told["held"] is told["demo"] is False


def test_at_rest(bench) -> None:
    bench.watch("position")
    bench.step(3)
    told = report(bench)
    assert (told["azimuth_deg"], told["elevation_deg"]) == (bench.state.position.az_deg, bench.state.position.el_deg)
    assert (told["connected"], told["firmware"], told["homed"], told["activity"]) == (True, "g2", True, "idle")
    assert 0 <= told["age_s"] <= 1.1
    assert told["stop_power_s"] is told["target_azimuth_deg"] is told["turn_of_cable"] is None


def test_in_motion_tells_where_to_and_what_a_stop_takes(bench) -> None:
    bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.5)
    told = report(bench)
    assert (told["activity"], told["holder"], told["target_azimuth_deg"]) == ("slewing", "you", 210)
    assert 0 < told["stop_power_s"] < 1
    assert (told["stop_means"], told["stop"]) == ("retarget", "STOP should take 0.3 s")


def test_after_stop(bench) -> None:
    bench.station.stop("you")
    bench.step(5)
    told = report(bench)
    assert (told["held"], told["held_by"], told["held_reason"]) == (True, "you", "stop")
    assert told["last_stop"]["confirmed"] is True


def test_a_position_that_no_longer_holds_is_not_told(bench) -> None:
    assert report(bench)["azimuth_deg"] is not None
    bench.device.unplug()
    bench.step(3)
    told = report(bench)
    assert told["azimuth_deg"] is told["elevation_deg"] is told["age_s"] is told["activity"] is None
    assert (told["connected"], told["link"], told["position_lost"]) == (False, "lost", "link")


def test_an_alignment_is_told_whenever_it_is_not_zero(bench) -> None:
    assert report(bench)["alignment"] is None
    aligned = replace(Settings(), alignment=AlignmentSettings(az_offset_deg=12.0, an_deg=0.3, aw_deg=0.4, ca_deg=-0.1))
    bench.do(ApplySettings(aligned, "you"))
    assert report(bench)["alignment"] == "az +12.00°, el +0.00°, tilt 0.50° to 307°, beam 0.10° right"

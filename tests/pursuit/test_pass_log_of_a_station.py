"""The log of passes beside a station that follows one with a simulated dish."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.paths import Paths
from birdcage.pursuit.pass_book import list_passes, read_samples
from birdcage.pursuit.pass_log import PassLog
from birdcage.station.pursuit_state import Phase

from tests.station.pursuit_bench import PARK, at, g2, plan_of


@pytest.fixture
def paths(tmp_path):
    return Paths.in_folder(tmp_path)


@pytest.fixture
def bench(paths):
    bench = g2()
    bench.log = PassLog(paths.journal, paths.passes)
    bench.end = bench.station.subscribe(lambda event: bench.log.hear(event, demo=bench.state.demo))
    yield bench
    bench.log.close(2.0)


def test_a_pass_from_end_to_end(bench, paths):
    bench.pursue(plan_of(at(bench) + 30.0, lasts_s=60.0), at_end="park", **PARK)
    bench.until(Phase.FOLLOWING)
    assert bench.log.flush()
    assert list_passes(paths.journal)[0].ended is None
    bench.until(Phase.OVER)
    assert bench.log.flush()
    (record,) = list_passes(paths.journal)
    assert (record.head.name, record.head.norad_id, record.outcome) == ("NOAA 19", 33591, "The pass is over.")
    assert record.head.controller == bench.pursuit.controller != ""
    assert record.head.demo is bench.state.demo
    kept = read_samples(paths.journal, record.number)
    assert 55 <= len(kept) <= 65
    assert [(each.error_deg, each.reported_az_deg) for each in kept] == [
        (each.error_deg, each.reported_az_deg) for each in bench.samples
    ]
    assert record.max_error_deg == max(each.error_deg for each in bench.samples)
    assert record.rms_deg == pytest.approx(bench.pursuit.rms_error_deg, rel=0.3)
    assert 55.0 < (record.ended - record.head.started).total_seconds() < 70.0
    assert len(list(paths.passes.iterdir())) == 1


def test_stop_in_mid_pass_ends_the_record_with_its_words(bench, paths):
    bench.pursue(plan_of(at(bench) + 30.0, lasts_s=60.0))
    bench.until(Phase.FOLLOWING)
    bench.step(10.0)
    bench.station.stop("you")
    bench.until(Phase.OVER)
    assert bench.log.flush()
    (record,) = list_passes(paths.journal)
    assert record.outcome == bench.pursuit.why != ""
    assert 8 <= record.samples <= 13


def test_after_its_end_the_log_hears_nothing(bench, paths):
    bench.end()
    bench.pursue(plan_of(at(bench) + 30.0, lasts_s=20.0))
    bench.until(Phase.OVER)
    assert bench.log.flush()
    assert list_passes(paths.journal) == []


def test_what_stands_still_is_logged_with_what_the_tuner_hears_meanwhile(bench, paths):
    plan = plan_of(at(bench), lasts_s=900.0, az_rate=0.0, low=40.0, high=40.0, name="slot")
    bench.pursue(replace(plan, passing=None))
    bench.until(Phase.FOLLOWING)
    bench.step(70.0)
    bench.station.stop("you")
    bench.until(Phase.OVER)
    assert bench.log.flush()
    (record,) = list_passes(paths.journal)
    kept = read_samples(paths.journal, record.number)
    assert len(kept) >= 6
    assert [each.unit for each in kept[1:]] == ["counts"] * (len(kept) - 1)
    assert all(each.signal_n >= 3 for each in kept[1:]), "an excursion has four readings, or three and the SNR"
    assert all(each.signal_scatter is not None for each in kept[1:])
    told = [each.snr_db is not None for each in kept[1:]]
    assert 1 <= sum(told) <= len(told) // 2, "every third one tells the SNR"

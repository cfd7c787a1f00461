"""What the log of passes keeps of the signal and of files, and what that comes to against elevation."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import replace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.config.feeds import FeedProfile, FeedSettings
from birdcage.base.config.tracking_sections import HookSettings
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.pursuit.heard_by_elevation import Way, levels_by_elevation, snr_by_elevation
from birdcage.pursuit.hooks import HookLine, HookListener
from birdcage.pursuit.made_files import size_of, told_path
from birdcage.pursuit.pass_book import read_files, read_remarks, read_samples
from birdcage.pursuit.pass_level import PassLevel
from birdcage.pursuit.pass_listener import LivePass, PassFile, PassRemark
from birdcage.pursuit.pass_record import PassSample
from birdcage.signal.source import SignalReading
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.pursuit_state import Phase

from .pass_events import START, at


def heard(el_deg, level=None, n=1, scatter=None, unit="counts", snr_db=None):
    return PassSample(START, 10.0, el_deg, 10.0, el_deg, 10.0, el_deg, 10.0, el_deg, 0.0, None, level,
                      None if level is None else unit, scatter, n, snr_db)  # fmt: skip


def test_a_sample_has_mean_scatter_and_number_of_what_came_since_the_one_before(story, log, paths):
    story.rssi(-1.0, 900.0)
    story.phase(0, Phase.FOLLOWING)
    for second, counts in ((0.2, 500.0), (0.6, 504.0), (0.9, 502.0)):
        story.rssi(second, counts)
    story.snr(0.95, 9.5)
    story.look(1.0)
    story.look(2.0)
    story.look(9.0)
    assert log.flush()
    first, second, third = read_samples(paths.journal, 1)
    assert (first.signal, first.signal_scatter, first.signal_n, first.snr_db) == (502.0, 2.0, 3, 9.5)
    assert (second.signal, second.signal_scatter, second.signal_n, second.snr_db) == (502.0, None, 0, None)
    assert (third.signal, third.signal_n) == (None, 0), "nothing was heard for 8 s"


def test_rising_and_setting_are_apart_and_readings_are_pooled():
    samples = [
        heard(20.0, 400.0), heard(21.0, 410.0, n=3, scatter=2.0), heard(22.9, 430.0), heard(22.8), heard(21.5, 300.0),
        heard(21.4, 777.0, n=0), heard(20.5, 310.0),
    ]  # fmt: skip
    told = {(each.way, each.low_deg): each for each in levels_by_elevation(samples)}
    assert set(told) == {
        (Way.RISING, 20.0), (Way.RISING, 21.0), (Way.RISING, 22.0), (Way.SETTING, 20.0), (Way.SETTING, 21.0),
    }  # fmt: skip
    pooled = told[Way.RISING, 21.0]
    assert (pooled.mean, pooled.scatter, pooled.n, pooled.high_deg) == (410.0, 2.0, 3, 22.0)
    setting = told[Way.SETTING, 21.0]
    assert (setting.mean, setting.scatter, setting.n) == (300.0, None, 1), "what stood there counts no more"


def test_pooling_is_that_of_all_readings_together():
    """Of 1, 2, 3 and 10, 14: what a sum over all five gives."""
    samples = [heard(30.0, 2.0, n=3, scatter=1.0), heard(30.1, 12.0, n=2, scatter=8.0**0.5), heard(40.0, 0.0)]
    whole = next(each for each in levels_by_elevation(samples) if each.low_deg == 30.0)
    values = (1.0, 2.0, 3.0, 10.0, 14.0)
    mean = sum(values) / 5.0
    assert whole.mean == pytest.approx(mean)
    assert whole.scatter == pytest.approx((sum((each - mean) ** 2 for each in values) / 4.0) ** 0.5)


@pytest.mark.parametrize(
    ("low", "high", "step"), [(18.0, 28.0, 1.0), (18.0, 35.0, 2.0), (18.0, 65.0, 5.0), (0.0, 90.0, 10.0)]
)
def test_there_are_a_dozen_ranges_at_most(low, high, step):
    samples = [heard(low + (high - low) * index / 200.0, 1.0) for index in range(201)]
    bins = levels_by_elevation(samples)
    assert {each.high_deg - each.low_deg for each in bins} == {step}
    assert len(bins) <= 12
    assert sum(each.n for each in bins) == 201
    assert [each.low_deg for each in bins] == sorted((each.low_deg for each in bins), reverse=True)


def test_what_stands_neither_rises_nor_sets_and_units_stay_apart():
    samples = [heard(38.0, 1.0, unit="dB"), heard(38.1, 2.0, snr_db=8.0), heard(38.2, 3.0, unit="dB", snr_db=10.0)]
    bins = levels_by_elevation(samples)
    assert {each.way for each in bins} == {Way.STANDING}
    assert [(each.unit, each.n) for each in bins] == [("dB", 2), ("counts", 1)]
    (snr,) = snr_by_elevation(samples)
    assert (snr.mean, snr.n, snr.unit) == (9.0, 2, "dB")
    assert levels_by_elevation([]) == []


def test_a_journal_of_before_is_taken_over(story, log, paths):
    """Its levels were not counted: each sample is a reading."""
    with closing(open_database(paths.journal, MIGRATIONS[:4])) as journal:
        journal.execute(
            "INSERT INTO pass (id, pursuit, name, kind, started, controller, demo, site, time_offset_s) "
            "VALUES (7, 1, 'OLD', 'satellite', ?, 'fast', 0, '', 0.0)",
            (START.isoformat(),),
        )
        journal.execute(
            "INSERT INTO pass_sample VALUES (7, ?, 1, 30, 1, 30, 1, 30, 1, 30, 0.0, NULL, 512.0, 'counts')",
            (START.isoformat(),),
        )
    (sample,) = read_samples(paths.journal, 7)
    assert (sample.signal, sample.signal_n, sample.snr_db) == (512.0, None, None)
    assert [each.n for each in levels_by_elevation([sample])] == [1]
    assert read_files(paths.journal, 7) == []


# Files.


@pytest.mark.parametrize(
    ("line", "path"),
    [
        ("birdcage-file: /data/pass 7.wav", "/data/pass 7.wav"), ("  birdcage-file:/x", "/x"),
        ("birdcage-file: here.wav", None), ("see birdcage-file: /x", None), ("birdcage-file:", None), ("/x", None),
    ],
)  # fmt: skip
def test_how_a_hook_tells_of_a_file(line, path):
    assert told_path(line) == path


def test_a_folder_is_as_large_as_all_in_it(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "b.raw").write_bytes(b"x" * 300)
    (tmp_path / "c.raw").write_bytes(b"x" * 40)
    (tmp_path / "a" / "up").symlink_to(tmp_path)
    assert size_of(str(tmp_path)) == (340, 2), "a link is no way out of the folder"
    assert size_of(str(tmp_path / "c.raw")) == (40, 1)
    assert size_of(str(tmp_path / "gone")) is None


def test_a_file_of_a_hook_belongs_to_its_pass_and_is_as_large_as_at_the_end(story, log, paths, tmp_path):
    recorded = tmp_path / "iq.raw"
    log.made(PassFile("ISS (ZARYA)", at(-5), str(recorded)))
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    assert log.flush()
    (file,) = read_files(paths.journal, 1)
    assert (file.size_bytes, file.files) == (None, None), "it is not there yet"
    recorded.write_bytes(b"x" * 5000)
    log.made(PassFile("ANOTHER", at(3), "/elsewhere"))
    story.phase(400, Phase.OVER, "Done.")
    assert log.flush()
    (file,) = read_files(paths.journal, 1)
    assert (file.path, file.size_bytes, file.files) == (str(recorded), 5000, 1)
    recorded.write_bytes(b"x" * 6000)
    log.made(PassFile("ISS (ZARYA)", at(500), str(recorded)))
    assert log.flush()
    (file,) = read_files(paths.journal, 1)
    assert (file.size_bytes, file.utc) == (6000, at(500)), "the last hook tells it again"


def test_a_hook_without_end_fills_no_journal(story, log, paths, monkeypatch):
    monkeypatch.setattr("birdcage.pursuit.pass_log_store.MOST_FILES", 5)
    story.phase(0, Phase.FOLLOWING)
    for index in range(20):
        log.made(PassFile("ISS (ZARYA)", at(1), f"/nowhere/{index}"))
    assert log.flush()
    assert len(read_files(paths.journal, 1)) == 5
    assert log.problem == ""


def test_a_line_of_a_hook_is_a_file_or_a_remark(log, story, paths):
    listener = HookListener(HookSettings(), log.remark, VirtualClock(START), log.made)
    story.phase(0, Phase.FOLLOWING)
    listener._said(HookLine(at(1), "reach_start", "ISS (ZARYA)", "birdcage-file: /data/a"))
    listener._said(HookLine(at(2), "reach_start", "ISS (ZARYA)", "recording"))
    assert log.flush()
    assert [each.path for each in read_files(paths.journal, 1)] == ["/data/a"]
    assert [each.text for each in read_remarks(paths.journal, 1)] == ["reach_start: recording"]


# Sources beside the dish.


class Source:
    """Tells what the test has it tell."""

    facts = replace(TUNER_FACTS, id="meter", unit="dB", of_dish=False)

    def __init__(self):
        self.watchers, self.hear = [], None

    def subscribe(self, hear):
        self.hear = hear
        return lambda: setattr(self, "hear", None)

    def watch(self, watcher, *, steady):
        assert steady
        self.watchers.append(watcher)

    def unwatch(self, watcher):
        self.watchers.remove(watcher)


def test_the_feeds_own_source_is_read_while_the_dish_follows(story):
    source, told = Source(), []
    feed = FeedSettings("helix")
    settings = Settings(feed=feed, feeds={"helix": FeedProfile(signal="meter")})
    level = PassLevel(None, None, lambda *each: told.append(each), {"meter": source}.__getitem__)
    live = LivePass(replace(story.pursuit, phase=Phase.WAITING), settings, None, None)
    level.begins(live)
    assert source.watchers == []
    level.changes(replace(live, pursuit=replace(live.pursuit, phase=Phase.FOLLOWING)))
    level.changes(replace(live, pursuit=replace(live.pursuit, phase=Phase.FOLLOWING)))
    assert source.watchers == ["ISS (ZARYA)"]
    source.hear(SignalReading(-30.5, "dB", 12.0, at(12), "meter"))
    assert told == [(-30.5, "dB", 12.0)]
    level.ends()
    assert (source.watchers, source.hear) == ([], None)


@pytest.mark.parametrize("signal", ["tuner", "rigctl"])
def test_the_tuner_and_the_receiver_of_the_pass_are_not_its_matter(story, signal):
    settings = Settings(feed=FeedSettings("helix"), feeds={"helix": FeedProfile(signal=signal)})
    level = PassLevel(None, None, lambda *_each: None, {}.__getitem__)
    level.begins(LivePass(replace(story.pursuit, phase=Phase.FOLLOWING), settings, None, None))


def test_remarks_and_files_do_not_mix(paths, log, story):
    story.phase(0, Phase.FOLLOWING)
    log.remark(PassRemark("ISS (ZARYA)", at(1), "x"))
    log.made(PassFile("ISS (ZARYA)", at(1), "/x"))
    assert log.flush()
    with closing(sqlite3.connect(paths.journal)) as journal:
        assert journal.execute("SELECT count(*) FROM pass_remark").fetchone() == (1,)
        assert journal.execute("SELECT count(*) FROM pass_file").fetchone() == (1,)

"""The log of passes: what is kept of a pursuit, where, and what happens when that fails."""

from __future__ import annotations

import sqlite3
import subprocess
import sys
from dataclasses import replace

import pytest
from birdcage.base.config import Settings
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.pursuit.pass_book import list_passes, read_remarks, read_samples, total_of, worst_moments
from birdcage.pursuit.pass_listener import LivePass, PassRemark
from birdcage.pursuit.pass_record import stamp
from birdcage.sky.frozen import frozen
from birdcage.station.pursuit_state import Phase

from . import pass_events
from .pass_events import Story, at, plan, rows_of


def comments_of(path):
    return [line for line in path.read_text().splitlines() if line.startswith("#")]


def test_a_pass_is_kept_with_its_facts_and_figures(story, log, paths):
    story.whole_pass((0.03, 0.04), "Parked.")
    assert log.flush()
    (record,) = list_passes(paths.journal)
    head = record.head
    assert (record.number, head.pursuit, head.name, head.norad_id, head.kind) == (
        1, 1, "ISS (ZARYA)", 25544, "satellite",
    )  # fmt: skip
    assert (head.aos, head.los, head.reach_start, head.reach_end) == (at(-60), at(460), at(0), at(400))
    assert (head.started, record.ended, record.outcome) == (at(0), at(400), "Parked.")
    assert (head.controller, head.demo, head.site) == ("fast", False, "Home, 52.0 N 4.4 E")
    assert (head.max_el_deg, head.forecast_rms_deg, head.forecast_max_deg) == (61.5, 0.015, 0.02)
    assert record.samples == 2
    assert record.rms_deg == pytest.approx((0.5 * (0.03**2 + 0.04**2)) ** 0.5)
    assert (record.max_error_deg, record.within_share, record.followed_s) == (0.04, 1.0, 1.0)
    assert log.problem == ""


def test_the_file_has_the_same_samples_under_a_head_that_says_what_it_is(story, log, paths):
    story.whole_pass((0.03, 0.04))
    assert log.flush()
    (file,) = paths.passes.iterdir()
    assert file.name == "20261121T120000Z_ISS-ZARYA_25544.csv"
    assert list_passes(paths.journal)[0].csv == file
    comments = comments_of(file)
    assert "# target: ISS (ZARYA) (25544)" in comments
    assert "# site: Home, 52.0 N 4.4 E" in comments
    assert not any("DEMO" in line for line in comments)
    rows = rows_of(file)
    names = "utc target_az_deg target_el_deg planned_az_deg planned_el_deg commanded_az_deg commanded_el_deg"
    assert (
        " ".join(rows[0])
        == f"{names} reported_az_deg reported_el_deg error_deg loss_db signal unit signal_scatter signal_n snr_db"
    )
    assert [(row["utc"], row["error_deg"]) for row in rows] == [
        ("2026-11-21T12:00:00.000Z", "0.03"), ("2026-11-21T12:00:01.000Z", "0.04"),
    ]  # fmt: skip
    kept = read_samples(paths.journal, 1)
    assert [(each.utc, each.error_deg, each.commanded_az_deg) for each in kept] == [
        (at(0), 0.03, 100.1), (at(1), 0.04, 100.1),
    ]  # fmt: skip


def test_a_simulated_dish_is_marked(log, paths):
    Story(log, demo=True).whole_pass()
    assert log.flush()
    assert list_passes(paths.journal)[0].head.demo is True
    assert comments_of(next(paths.passes.iterdir()))[0] == "# DEMO: a simulated dish, not a real one"


def test_every_sample_is_on_disk_while_the_pass_goes_on(story, log, paths):
    """What a crash in mid-pass leaves: read by others while the log has both open."""
    story.phase(0, Phase.FOLLOWING)
    for second in range(20):
        story.look(float(second))
        assert log.flush()
        assert len(rows_of(next(paths.passes.iterdir()))) == second + 1
        assert len(read_samples(paths.journal, 1)) == second + 1
    (record,) = list_passes(paths.journal)
    assert (record.ended, record.outcome, record.samples) == (None, None, 20)


CRASH = """
import importlib.util, os, sys
spec = importlib.util.spec_from_file_location("pass_events", sys.argv[1])
events = importlib.util.module_from_spec(spec)
spec.loader.exec_module(events)
from pathlib import Path
from birdcage.base.paths import Paths
from birdcage.pursuit.pass_log import PassLog
from birdcage.station.pursuit_state import Phase
paths = Paths.in_folder(Path(sys.argv[2]))
log = PassLog(paths.journal, paths.passes)
story = events.Story(log)
story.phase(0, Phase.FOLLOWING)
for second in range(50):
    story.look(float(second))
    if second == 48:
        log.flush()
os.kill(os.getpid(), 9)
"""


def test_a_killed_program_loses_the_last_sample_at_most(paths, tmp_path):
    words = [sys.executable, "-c", CRASH, pass_events.__file__, str(tmp_path)]
    assert subprocess.run(words, timeout=60, check=False).returncode == -9
    assert len(rows_of(next(paths.passes.iterdir()))) >= 49
    assert len(read_samples(paths.journal, 1)) >= 49
    assert list_passes(paths.journal)[0].ended is None


def test_the_signal_beside_a_sample_is_fresh_and_the_receivers_goes_first(story, log, paths):
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    story.rssi(1.0, 512.0)
    story.look(2.0)
    story.look(9.0)
    log.signal(-31.5, "dB", 10.0)
    story.rssi(10.0, 500.0)
    story.look(11.0)
    assert log.flush()
    assert [(each.signal, each.unit) for each in read_samples(paths.journal, 1)] == [
        (None, None), (512.0, "counts"), (None, None), (-31.5, "dB"),
    ]  # fmt: skip
    rows = rows_of(next(paths.passes.iterdir()))
    assert [(row["signal"], row["unit"]) for row in rows] == [("", ""), ("512.0", "counts"), ("", ""), ("-31.5", "dB")]


def test_waiting_for_a_pass_is_no_pass(story, log, paths):
    story.phase(-300, Phase.WAITING)
    story.phase(-100, Phase.COUNTDOWN)
    story.phase(-90, Phase.OVER, "Ended by operator.")
    assert log.flush()
    assert list_passes(paths.journal) == []
    assert not paths.passes.exists()


def test_a_pass_that_was_missed_is_told(story, log, paths):
    story.phase(-300, Phase.YIELDED, "Gpredict has control.")
    assert log.flush()
    assert list_passes(paths.journal) == []
    story.phase(400, Phase.OVER, "Gpredict had control until its end.")
    assert log.flush()
    (record,) = list_passes(paths.journal)
    assert (record.outcome, record.samples) == ("Gpredict had control until its end.", 0)
    assert (record.rms_deg, record.max_error_deg, record.within_share, record.followed_s) == (None,) * 4


def test_a_gap_in_mid_pass_and_another_plan_leave_one_pass(story, log, paths):
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    story.phase(1, Phase.INTERRUPTED, "The link was lost.")
    story.phase(20, Phase.FOLLOWING, plan=plan(time_offset_s=1.5), latency_s=0.08)
    story.look(21.0)
    story.phase(400, Phase.PARKING, "On its way to 180 45.")
    story.phase(420, Phase.OVER, "Parked.")
    assert log.flush()
    (record,) = list_passes(paths.journal)
    assert (record.samples, record.head.time_offset_s, record.head.latency_s) == (2, 1.5, 0.08)
    assert (record.ended, record.outcome) == (at(400), "The pass is over.")
    assert len(rows_of(next(paths.passes.iterdir()))) == 2


def test_another_pursuit_ends_the_pass(story, log, paths):
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    story.phase(30, Phase.FOLLOWING, number=2, plan=plan("METEOR", 44387))
    story.look(31.0)
    assert log.flush()
    first, second = list_passes(paths.journal)
    assert (first.outcome, first.ended, first.samples) == ("Another pursuit began.", at(30), 1)
    assert (second.head.name, second.ended, second.samples) == ("METEOR", None, 1)
    assert len(list(paths.passes.iterdir())) == 2


def test_ending_the_program_in_mid_pass_says_so(story, log, paths):
    story.phase(0, Phase.FOLLOWING)
    story.look(0.0)
    story.look(5.0)
    log.close(2.0)
    (record,) = list_passes(paths.journal)
    assert (record.outcome, record.ended) == ("The program was ended.", at(5))


def test_what_does_not_pass_is_kept_seldom(story, log, paths):
    story.phase(0, Phase.FOLLOWING, plan=plan("Moon", None, passing=False))
    for second in range(31):
        story.look(float(second))
    assert log.flush()
    assert [each.utc for each in read_samples(paths.journal, 1)] == [at(0), at(10), at(20), at(30)]
    assert next(paths.passes.iterdir()).name == "20261121T120000Z_Moon.csv"


def test_what_hooks_say_finds_its_pass_before_during_and_after(story, log, paths):
    def said(seconds, text, name="ISS (ZARYA)"):
        log.remark(PassRemark(name, at(seconds), f"tca: {text}"))

    said(-10, "early")
    said(0, "of another", "METEOR")
    story.whole_pass()
    said(200, "in time")
    said(410, "late")
    said(5300, "of the next")
    story.pursuit = replace(story.pursuit, number=2, plan=plan(start=5400.0))
    story.phase(5400, Phase.FOLLOWING)
    said(5401, "in the next")
    assert log.flush()
    assert [(each.utc, each.text) for each in read_remarks(paths.journal, 1)] == [
        (at(-10), "tca: early"), (at(200), "tca: in time"), (at(410), "tca: late"),
    ]  # fmt: skip
    assert [each.text for each in read_remarks(paths.journal, 2)] == ["tca: of the next", "tca: in the next"]


def test_the_epoch_of_the_elements_is_that_by_which_the_pass_is_followed(story, log, paths):
    elements = next(iter(frozen()))
    log.begins(LivePass(story.pursuit, Settings(), None, elements))
    story.pursuit = replace(story.pursuit, plan=plan(elements.name, elements.norad_id))
    story.whole_pass()
    story.pursuit = replace(story.pursuit, number=2, plan=plan("ANOTHER", 1))
    story.whole_pass()
    assert log.flush()
    first, second = (each.head.elements_epoch for each in list_passes(paths.journal))
    assert (stamp(first), second) == (stamp(elements.epoch), None)
    assert f"# elements of: {stamp(elements.epoch)}" in comments_of(max(paths.passes.iterdir()))


def test_a_name_out_of_a_file_of_elements_makes_no_line_and_no_path_of_its_own(story, log, paths):
    story.pursuit = replace(story.pursuit, plan=plan("../../EVIL\n# demo: none", 99))
    story.whole_pass()
    assert log.flush()
    (file,) = paths.passes.iterdir()
    assert file.name == "20261121T120000Z_EVIL-demo-none_99.csv"
    assert "# target: ../../EVIL # demo: none (99)" in comments_of(file)


def test_two_passes_of_one_second_have_two_files(log, paths):
    story = Story(log)
    story.whole_pass()
    story.pursuit = replace(story.pursuit, number=2)
    story.whole_pass()
    assert log.flush()
    names = sorted(file.name for file in paths.passes.iterdir())
    assert names == ["20261121T120000Z_ISS-ZARYA_25544-2.csv", "20261121T120000Z_ISS-ZARYA_25544.csv"]


def test_choosing_among_the_passes(log, paths):
    story = Story(log)
    for number, (name, norad) in enumerate((("ISS", 25544), ("METEOR-M2 4", 59051), ("50%_OFF", 3)), start=1):
        story.pursuit = replace(story.pursuit, number=number, plan=plan(name, norad, start=number * 1000.0))
        story.phase(number * 1000.0, Phase.FOLLOWING)
        story.look(number * 1000.0, 0.1 * number, loss=0.3 * number)
        story.phase(number * 1000.0 + 400, Phase.OVER, "Done.")
    assert log.flush()

    def numbers(**wanted):
        return [each.number for each in list_passes(paths.journal, **wanted)]

    assert numbers() == [1, 2, 3]
    assert (numbers(last=2), numbers(since=at(2000)), numbers(number=2)) == ([2, 3], [2, 3], [2])
    assert (numbers(name="meteor"), numbers(name="25544"), numbers(name="%_"), numbers(name="_")) == (
        [2],
        [1],
        [3],
        [3],
    )
    total = total_of(list_passes(paths.journal))
    assert (total.passes, total.max_error_deg) == (3, pytest.approx(0.3))
    assert total.rms_deg == pytest.approx((0.14 / 3) ** 0.5)
    assert total.within_share == pytest.approx(1 / 3)


def test_the_worst_moments_are_apart(story, log, paths):
    story.phase(0, Phase.FOLLOWING)
    for second, error in ((0, 0.1), (30, 0.5), (31, 0.49), (60, 0.3), (90, 0.2)):
        story.look(float(second), error)
    assert log.flush()
    assert [each.error_deg for each in worst_moments(read_samples(paths.journal, 1))] == [0.5, 0.3, 0.2]


def test_a_journal_of_the_version_before_is_taken_over(paths, story, log):
    open_database(paths.journal, MIGRATIONS[:2]).close()
    story.whole_pass()
    assert log.flush()
    assert len(list_passes(paths.journal)) == 1
    with sqlite3.connect(paths.journal) as connection:
        assert {"fault", "wear", "pass"} <= {name for (name,) in connection.execute("SELECT name FROM sqlite_master")}

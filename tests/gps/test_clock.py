"""The clock: who says that it is right, how long that holds, and what an error costs."""

from __future__ import annotations

import sys
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.gps import system_time
from birdcage.gps.clock_check import FILE, check_clock, recall, remember
from birdcage.gps.fix import GpsFix
from birdcage.gps.system_time import by_system, run_tool
from birdcage.gps.verdict import by_gps, by_watch, cost_deg, cost_sentence

NOW = datetime(2026, 3, 20, 12, 0, 0, tzinfo=UTC)
CHRONY = "C0A80101,pi.lan,2,1773999990.1,{correction},0.0001,0.0002,-3.1,0.0,0.02,0.010,{dispersion},64.2,{leap}\n"
GOOD = CHRONY.format(correction="-0.000120", dispersion="0.0050", leap="Normal")


def system(**answers):
    return lambda words: answers.get(words[0])


def fix(ahead_s, utc=True):
    told = NOW - timedelta(seconds=ahead_s) if utc else None
    return GpsFix(51.9, 4.8, 10.0, told, NOW, 8, 0.9, "gpsd at localhost:2947")


class TestMeasured:
    @pytest.mark.parametrize(("ahead_s", "doubt"), [
        (0.25, ""), (0.9, ""), (-0.9, ""), (4.25, "4.0 s fast by gpsd"), (-3.75, "4.0 s slow"),
        (7200.25, "2 h fast"), (-864000.0, "10 days slow"),
    ])  # fmt: skip
    def test_by_gps(self, ahead_s, doubt):
        verdict = by_gps(fix(ahead_s))
        assert verdict.offset_s == pytest.approx(ahead_s - 0.25)
        assert verdict.doubtful is bool(doubt)
        assert doubt in verdict.sentence

    def test_an_old_receiver_whose_weeks_began_again_is_not_believed(self):
        verdict = by_gps(fix(1024 * 7 * 86400.0 + 3.0))
        assert "1024 weeks back" in verdict.doubt
        assert (verdict.offset_s, verdict.worst_s) == (None, None)

    def test_a_receiver_without_a_time_judges_nothing(self):
        assert by_gps(fix(0.0, utc=False)) is None

    @pytest.mark.parametrize(("ahead_s", "doubtful"), [(1.9, False), (-1.9, False), (2.1, True), (-30.0, True)])
    def test_by_a_watch_to_a_second(self, ahead_s, doubtful):
        verdict = by_watch(NOW - timedelta(seconds=ahead_s), NOW)
        assert (verdict.doubtful, verdict.precision_s) == (doubtful, 1.0)


class TestSystem:
    def test_chrony(self):
        verdict = by_system(NOW, system(chronyc=GOOD, timedatectl="NTPSynchronized=no\n"))
        assert verdict.sentence == "The clock is good by network time (chrony), to within 0.01 s."

    @pytest.mark.parametrize(
        ("answer", "says"),
        [
            (CHRONY.format(correction="0", dispersion="0.1", leap="Not synchronised"), "no time source"),
            (GOOD.replace("C0A80101", "7F7F0101"), "no time source"),
            (CHRONY.format(correction="3.5", dispersion="0.1", leap="Normal"), "may be 3.6 s off"),
            (CHRONY.format(correction="0", dispersion="9.0", leap="Normal"), "may be 9.0 s off"),
        ],
    )
    def test_chrony_that_does_not_know(self, answer, says):
        assert says in by_system(NOW, system(chronyc=answer)).doubt

    @pytest.mark.parametrize("chrony", ["506 Cannot talk to daemon\n", "", GOOD.replace("0.010", "x")])
    def test_systemd_where_chrony_tells_nothing(self, chrony):
        yes = by_system(NOW, system(chronyc=chrony, timedatectl="NTP=yes\nNTPSynchronized=yes\n"))
        assert (yes.doubtful, yes.source) == (False, "network time (systemd)")
        no = by_system(NOW, system(chronyc=chrony, timedatectl="NTP=no\nNTPSynchronized=no\n"))
        assert no.doubt == "The clock is not set by the network and network time is switched off."

    @pytest.mark.parametrize("answers", [{}, {"timedatectl": "Failed to connect to bus\n"}])
    def test_a_system_that_does_not_tell_is_not_taken_for_right(self, answers):
        verdict = by_system(NOW, system(**answers))
        assert (verdict.kind, verdict.doubtful, verdict.worst_s) == ("unknown", True, None)

    def test_a_program_that_does_not_end_is_left(self, monkeypatch):
        monkeypatch.setattr(system_time, "ASK_S", 0.2)
        assert run_tool((sys.executable, "-c", "import threading; threading.Event().wait(30)")) is None
        assert run_tool((sys.executable, "-c", "print('NTP=no'); raise SystemExit(1)")) is None
        assert run_tool(("no-such-program-anywhere",)) is None


class TestRemembered:
    def test_what_the_network_said_counts_for_hours_without_it(self, tmp_path):
        check_clock(NOW, tmp_path, system(chronyc=GOOD))
        later = check_clock(NOW + timedelta(hours=6), tmp_path, system())
        assert (later.doubtful, later.kind) == (False, "remembered")
        assert later.precision_s == pytest.approx(0.51, abs=0.01)
        assert "network time (chrony), 6 h ago" in later.sentence

    def test_and_is_doubted_after_days(self, tmp_path):
        check_clock(NOW, tmp_path, system(chronyc=GOOD))
        later = check_clock(NOW + timedelta(days=3), tmp_path, system())
        assert "Last compared: network time (chrony), 3 days ago. It may be 6.0 s off now." in later.doubt

    def test_an_offset_by_gps_stays_in_what_it_may_be_off(self, tmp_path):
        remember(tmp_path, by_gps(fix(0.95)))
        assert check_clock(NOW + timedelta(minutes=5), tmp_path, system()).worst_s == pytest.approx(0.96, abs=0.01)

    def test_a_clock_that_went_back_is_told(self, tmp_path):
        remember(tmp_path, by_watch(NOW, NOW))
        verdict = check_clock(NOW - timedelta(days=400), tmp_path, system())
        assert "went back" in verdict.doubt

    def test_one_that_has_to_be_set_is_another_clock_afterwards(self, tmp_path):
        remember(tmp_path, by_watch(NOW, NOW))
        remember(tmp_path, by_watch(NOW - timedelta(seconds=60), NOW))
        assert recall(tmp_path) is None

    @pytest.mark.parametrize("text", [
        "", "{", "[]", '{"checked_at": 7}', "null",
        '{"source":"x","checked_at":"2026-01-01","offset_s":null,"precision_s":1}',
    ])  # fmt: skip
    def test_a_damaged_memory_is_none(self, tmp_path, text):
        (tmp_path / FILE).write_text(text)
        assert recall(tmp_path) is None
        assert check_clock(NOW, tmp_path, system()).kind == "unknown"

    def test_a_folder_that_cannot_be_written_is_no_error(self, tmp_path):
        (tmp_path / "file").touch()
        assert remember(tmp_path / "file", by_watch(NOW, NOW)) is False
        assert not check_clock(NOW, tmp_path / "file", system(chronyc=GOOD)).doubtful


def test_what_a_second_costs():
    assert cost_deg(-2.0, 0.6) == pytest.approx(1.2)
    good = by_gps(fix(0.25))
    assert cost_sentence(good, 0.6, "NOAA 20") == (
        "One second costs 0.6° on NOAA 20 (0.6°/s); this clock at most 0.15°."
    )
    hours = by_watch(NOW - timedelta(hours=4), NOW)
    assert cost_sentence(hours, 1.0).endswith("with this clock the dish points elsewhere.")
    assert cost_sentence(by_watch(NOW - timedelta(seconds=30), NOW), 1.0).endswith("this clock at most 31°.")
    assert "is unknown" in cost_sentence(by_system(NOW, system()), 1.0)

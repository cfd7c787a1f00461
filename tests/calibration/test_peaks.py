"""Peaks: how much each counts, and that none is lost."""

from __future__ import annotations

import json
from datetime import UTC, datetime

import pytest
from birdcage.base.beam import Beam
from birdcage.base.errors import StoreError
from birdcage.calibration.peak import UNKNOWN_SIGMA_DEG, MeasuredPeak, sigma_by_hand
from birdcage.calibration.peaks_file import add_peak, load_peaks, remove_peaks

WHEN = datetime(2026, 3, 20, 18, 30, 0, 250000, tzinfo=UTC)
ROUND = Beam(6.3, 6.3)
SUN = MeasuredPeak(WHEN, "Sun", 180.5, 44.25, 155.0, 44.0, 0.1, "hand", 2.5)
SLOT = MeasuredPeak(WHEN, "101°W SES 1", 188.0, 44.0, 163.0, 43.8, 0.14, "rssi")


def test_a_strong_source_is_found_well_and_a_faint_one_hardly():
    in_this_beam = [sigma_by_hand(rise, ROUND) for rise in (10.0, 2.0, 1.2, 0.3, 0.05, 0.0)]
    assert in_this_beam == sorted(in_this_beam)
    assert in_this_beam[1] == pytest.approx(0.09, abs=0.02)
    assert in_this_beam[-2:] == [pytest.approx(3.15), 3.15]  # half a beam: a person sees that there is nothing
    assert sigma_by_hand(10.0, Beam(0.5, 0.5)) == 0.05  # gears and steps
    assert sigma_by_hand(None, ROUND) == sigma_by_hand(2.0, None) == UNKNOWN_SIGMA_DEG


def test_off_is_on_the_sky():
    high = MeasuredPeak(WHEN, "x", 1.0, 60.0, 0.0, 60.0, 0.1)
    assert high.off(359.0, 59.5) == (pytest.approx(1.0), pytest.approx(0.5))


def test_what_was_kept_is_read_again(tmp_path):
    path = tmp_path / "state" / "peaks.jsonl"
    assert load_peaks(path).entries == ()
    one, two = add_peak(path, SUN), add_peak(path, SLOT)
    assert (one.number, two.number) == (1, 2)
    assert load_peaks(path).entries == (one, two)
    assert remove_peaks(path, 1).entries == (two,)
    assert add_peak(path, SUN).number == 3  # a number never means another peak
    with pytest.raises(StoreError, match="no peak 1"):
        remove_peaks(path, 1, 2)
    assert len(load_peaks(path).entries) == 2
    assert remove_peaks(path).entries == ()


def test_half_a_line_costs_no_other_peak(tmp_path):
    path = tmp_path / "peaks.jsonl"
    add_peak(path, SUN)
    text = path.read_text()
    path.write_text(text + text[: len(text) // 2])
    found = load_peaks(path)
    assert len(found.entries) == 1
    assert "line 2 is no peak" in found.problems[0]
    added = add_peak(path, SLOT)
    assert load_peaks(path).entries[-1] == added
    remove_peaks(path, 1)
    assert load_peaks(path).entries == (added,)
    assert load_peaks(path).problems  # what can't be read is kept


@pytest.mark.parametrize(
    "wrong",
    [{"utc": "2026-03-20T18:30:00"}, {"true_az_deg": float("nan")}, {"sigma_deg": 0.0}, {"found": "magic"},
     {"number": "one"}],
)  # fmt: skip
def test_what_is_no_peak_is_said(tmp_path, wrong):
    path = tmp_path / "peaks.jsonl"
    add_peak(path, SUN)
    path.write_text(json.dumps({**json.loads(path.read_text()), **wrong}) + "\n")
    assert load_peaks(path).entries == ()
    assert "line 1 is no peak" in load_peaks(path).problems[0]

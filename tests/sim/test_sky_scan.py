"""The simulated sky is as loud as the one that a real G2 scanned (`scripts/bench/sky_scan.py`)."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "bench" / "sky_scan.py"
SPEC = importlib.util.spec_from_file_location("sky_scan", SCRIPT)
bench = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(bench)


@pytest.fixture(scope="module")
def scan():
    return bench.simulated()


def test_the_five_peaks_and_no_cell_is_louder(scan):
    assert {az: bench.peak(scan, az) for az in bench.PEAKS} == pytest.approx(bench.PEAKS, abs=4)
    assert max(scan.values()) == pytest.approx(562, abs=3)


@pytest.mark.parametrize(("threshold", "percent"), bench.SHARES.items())
def test_as_much_of_the_sky_is_loud(scan, threshold, percent):
    assert bench.share(scan, threshold) == pytest.approx(percent, abs=0.3)


@pytest.mark.parametrize(("slot", "most"), bench.AT_MOST.items())
def test_weak_slots_stay_weak(scan, slot, most):
    assert bench.at_slot(scan, slot) <= most


def test_a_slot_alone_is_as_wide_as_it_was(scan):
    """At half height, in degrees of the dish's axes: the real one 6.44 by 7.33 (61.5 W, at azimuth 124)."""

    def width(cut):
        offsets, counts = np.array(sorted(cut)).T
        half = (counts.max() + 402.0) / 2.0
        inside = np.flatnonzero(counts >= half)
        low, high = inside[0], inside[-1]
        left = np.interp(half, counts[low - 1 : low + 1], offsets[low - 1 : low + 1])
        right = np.interp(half, counts[high + 1 : high - 1 : -1], offsets[high + 1 : high - 1 : -1])
        return right - left

    assert width([(el, scan[124, el]) for el in range(20, 33)]) == pytest.approx(6.44, abs=0.3)
    assert width([(az, scan[az, 26]) for az in range(117, 131)]) == pytest.approx(7.33, abs=0.5)

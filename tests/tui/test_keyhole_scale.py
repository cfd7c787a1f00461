"""A keyhole's peak is told with its figure, and the rest of the pass is legible beside it."""

from __future__ import annotations

import re

import pytest
from birdcage_tui.shown.error_scale import error_top, legible_deg
from track_stage import read, run
from track_stand_in import keyhole


def error_rows(text):
    """The rows of the error strip, from its scale down to its zero."""
    rows = [row.rpartition("││")[2].rstrip("│") for row in text.splitlines()]
    last = next(at for at, row in reversed(list(enumerate(rows))) if re.match(r"\s+0 ", row) or row.startswith("err"))
    first = next(at for at in range(last, 0, -1) if re.search(r"^\D*\d+(\.\d+)?°", rows[at]) and at <= last)
    return rows[first : last + 1]


@pytest.mark.parametrize("size", [(80, 24), (100, 30), (120, 36), (160, 48), (240, 70)], ids=str)
def test_the_peak_has_its_figure_and_the_scale_is_that_of_the_rest(size):
    text = run(read, "craft-keyhole", size=size)
    [peak] = re.findall(r"↑ (\d+\.\d+)°", text)
    rows = error_rows(text)
    scale = float(re.search(r"(\d+(?:\.\d+)?)°", rows[0])[1])
    assert float(peak) > 5 * scale, rows
    assert scale <= 0.2, rows
    if len(rows) > 1:
        dots = [re.findall("[\u2801-\u28ff]", row) for row in rows[1:]]
        assert sum(map(len, dots)) > 10, "the rest of the pass is no flat line at the bottom"


def test_without_a_peak_nothing_is_cut_off_and_no_figure_stands_there():
    assert "↑ " not in run(read, "craft-following", size=(120, 36))
    assert legible_deg([0.01, 0.04, 0.08]) == 0.08
    assert error_top([0.01, 0.04, 0.09]) == 0.1


def test_a_scale_goes_to_the_largest_error_where_that_is_no_short_peak():
    assert error_top([0.02] * 90 + [3.1] * 10) == pytest.approx(0.05)
    assert error_top([0.02] * 60 + [3.1] * 40) == pytest.approx(5.0)


def test_the_figure_is_the_largest_error_that_the_plan_expects_or_that_was_seen():
    from birdcage.base.clock import VirtualClock

    state, _, seen = keyhole(VirtualClock())
    pointing = state.pursuit.plan.pointing
    level = pointing.dish if pointing.median is None else pointing.median
    worst = max([level.max_deg, *(look.error_deg for look in seen)])
    [peak] = re.findall(r"↑ (\d+\.\d+)°", run(read, "craft-keyhole", size=(160, 48)))
    assert float(peak) == pytest.approx(worst, abs=0.06)

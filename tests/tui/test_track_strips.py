"""The curves of the Craft tab: every figure beside them is whole, and is that of now."""

from __future__ import annotations

import re

import pytest
from track_stage import SIZES, read, run, run_each


def chart_of(text):
    """The rows of the curves, without what stands left of them."""
    rows = [row.rpartition("││")[2] for row in text.splitlines() if "││" in row]
    return [row for row in rows if re.search(r"[\u2800-\u28ff┆]|^(AZ|EL|err|dish)\b", row)]


@pytest.mark.parametrize("size", [*SIZES[:3], (100, 30), (120, 33)], ids=str)
def test_no_name_of_a_strip_is_written_on_a_figure_of_its_scale(size):
    for scene, text in run_each(read, size).items():
        assert re.findall(r"\b(?:AZ|EL|err|dish)[\d.-]+.*", text) == [], scene


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_ends_of_the_scale_of_azimuth_are_those_of_the_pass(size):
    text = "\n".join(chart_of(run(read, size=size)))
    assert re.search(r"(^|\s)158°", text)
    assert re.search(r"(^|\s)-19°", text)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_target_beside_the_curves_differs_from_the_dish_by_the_error(size):
    text = run(read, size=size)
    dish = [float(each) for each in re.search(r"AZ ([\d.]+)°  ?EL ([\d.]+)°", text).groups()]
    target = [float(re.search(r"(\d+\.\d+)°│?$", row)[1]) for row in chart_of(text)
              if re.search(r"\d+\.\d+°│?$", row.rstrip())]  # fmt: skip
    assert target == pytest.approx(dish, abs=0.06)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_target_beside_the_curves_is_the_one_in_words_while_the_dish_is_held(size):
    text = run(read, "craft-held", size=size)
    said = re.search(r"METEOR-M2 4  AZ ([\d.]+)°  EL ([\d.]+)°", text).groups()
    target = [match[1] for row in chart_of(text) if (match := re.search(r"(\d+\.\d+)°│?$", row.rstrip()))]
    assert target == list(said)


@pytest.mark.parametrize("size", SIZES[:3], ids=str)
@pytest.mark.parametrize("scene", ["craft-chosen", "craft-waiting", "craft-following", "craft-keyhole"])
def test_words_on_the_time_axis_stand_apart_above_a_row_of_times_and_a_countdown_looks_like_none(scene, size):
    rows = [row.rpartition("││")[2].rstrip("│ ") for row in run(read, scene, size=size).splitlines()]
    [at] = [at for at, row in enumerate(rows) if "▲" in row or "◀ rises" in row]
    assert re.findall(r"\d\d:\d\d", rows[at]) == []
    assert re.findall(r"(?:floor|ceiling|again|min) (?=[^ ╵▲])", rows[at]) == []
    assert re.search(r"\d\d:\d\d", rows[at + 1])

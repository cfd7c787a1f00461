"""The grid of a map, and the order in which the dish goes through it."""

import itertools
import math

import pytest
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan
from hypothesis import given
from hypothesis import strategies as st


@given(
    order=st.sampled_from(MapOrder), columns=st.integers(1, 40), rows=st.integers(1, 40),
    step=st.sampled_from([0.1, 0.3, 1.0, 2.5]),
)  # fmt: skip
def test_every_order_has_every_direction_once(order, columns, rows, step):
    plan = MapPlan(100.0, 100.0 + (columns - 1) * step, 20.0, 20.0 + (rows - 1) * step, step, order, MapFrame.TARGET)
    assert (plan.columns, plan.rows) == (columns, rows)
    assert sorted(plan.sequence) == list(range(columns * rows))


@pytest.mark.parametrize("order", [MapOrder.ROWS, MapOrder.COLUMNS])
def test_a_snake_never_takes_more_than_a_step(order):
    plan = MapPlan(0.0, 9.0, 20.0, 26.0, 1.0, order)
    places = [plan.at(cell) for cell in plan.sequence]
    assert all(abs(a[0] - b[0]) + abs(a[1] - b[1]) == pytest.approx(1.0) for a, b in itertools.pairwise(places))


def test_from_coarse_to_fine_each_pass_covers_the_whole_region():
    plan = MapPlan(160.0, 220.0, 25.0, 55.0, 1.0)
    coarse = plan.sequence[: 8 * 4]
    assert {plan.at(cell) for cell in coarse} == set(
        itertools.product((160.0 + 8 * n for n in range(8)), (25.0 + 8 * n for n in range(4)))
    )
    half = [plan.at(cell) for cell in plan.sequence[: 16 * 31]]
    for x, y in itertools.product((160.0, 190.0, 219.0), (25.0, 40.0, 55.0)):
        assert min(abs(a - x) + abs(b - y) for a, b in half) <= 2.0


def test_a_spiral_begins_in_the_middle():
    plan = MapPlan(-2.0, 2.0, -2.0, 2.0, 1.0, MapOrder.SPIRAL, MapFrame.TARGET)
    assert [plan.at(cell) for cell in plan.sequence[:4]] == [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


@pytest.mark.parametrize(("values", "words"), [
    ((220.0, 160.0, 25.0, 50.0, 1.0), "ends before it begins"), ((160.0, 220.0, 25.0, 50.0, 0.0), "step is 0°"),
    ((0.0, 400.0, 25.0, 50.0, 1.0), "wider than 360"), ((0.0, 360.0, 0.0, 90.0, 0.05), "give a longer step"),
    ((0.0, 10.0, 25.0, 95.0, 1.0), "Elevation goes from"),
    ((0.0, math.inf, 25.0, 50.0, 1.0), "has no ends"), ((math.nan, 10.0, 25.0, 50.0, 1.0), "has no ends"),
    ((0.0, 10.0, 25.0, 50.0, math.nan), "step is nan"),
])  # fmt: skip
def test_what_is_no_region_is_refused_with_what_to_do(values, words):
    with pytest.raises(ValueError, match=words):
        MapPlan(*values)


def test_what_a_file_keeps_of_it_makes_the_same_plan():
    plan = MapPlan(-3.0, 3.0, -2.0, 2.5, 0.5, MapOrder.SPIRAL, MapFrame.TARGET)
    assert MapPlan.of(plan.values()) == plan
    with pytest.raises(ValueError, match="tells no region"):
        MapPlan.of({"x_low_deg": 1.0})


def test_rows_may_lie_closer_than_columns():
    plan = MapPlan(90.0, 92.0, 5.0, 6.0, 1.0, MapOrder.ROWS, y_step_deg=0.2)
    assert (plan.columns, plan.rows) == (3, 6)
    assert plan.at(4) == (91.0, 5.2)
    assert MapPlan.of(plan.values()) == plan
    assert "y_step_deg" not in MapPlan(90.0, 92.0, 5.0, 6.0, 1.0).values()
    with pytest.raises(ValueError, match="The step is 0°"):
        MapPlan(90.0, 92.0, 5.0, 6.0, 1.0, y_step_deg=0.0)

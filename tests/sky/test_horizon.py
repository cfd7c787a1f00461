"""The horizon: straight between its points, all the way round."""

from __future__ import annotations

import re

import pytest
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.horizon_file import read_horizon, read_horizon_file, write_horizon
from hypothesis import given
from hypothesis import strategies as st

POINTS = st.lists(st.tuples(st.floats(-360, 360), st.floats(-90, 90)), max_size=12)


def test_without_a_point_it_is_flat():
    mask = HorizonMask()
    assert not mask
    assert mask.at(123.0) == 0.0


@pytest.mark.parametrize(
    ("az_deg", "el_deg"),
    [(0, 7.5), (10, 10), (55, 15), (100, 20), (225, 12.5), (350, 5), (355, 6.25), (370, 10), (-10, 5), (-345, 10.5556)],
)
def test_straight_lines_that_wrap_at_north(az_deg, el_deg):
    mask = HorizonMask([(100, 20), (10, 10), (350, 5)])
    assert mask.at(az_deg) == pytest.approx(el_deg, abs=1e-4)


@pytest.mark.parametrize("points", [[(200, 8)], [(200, 8), (200, 30)], [(359.98, 8), (0.01, 9)]])
def test_points_at_one_azimuth_are_no_line(points):
    mask = HorizonMask(points)
    assert mask
    assert not mask.is_line
    assert [mask.at(az_deg) for az_deg in (20, 200, 359.98)] == [0.0, 0.0, 0.0]


def test_two_azimuths_make_a_line():
    mask = HorizonMask([(200, 8)]).insert(20, 4)
    assert mask.is_line
    assert mask.at(110) == 6


def test_the_edge_of_a_wall_counts_as_the_wall():
    mask = HorizonMask([(90, 2), (90, 30), (120, 30), (120, 2)])
    assert mask.at(89.999) == pytest.approx(2.0, abs=0.01)
    assert (mask.at(90), mask.at(100), mask.at(120)) == (30, 30, 30)
    assert mask.at(120.001) == pytest.approx(2.0, abs=0.01)


@given(POINTS, st.lists(st.floats(-720, 720), min_size=1, max_size=8))
def test_it_lies_between_its_points_and_is_the_same_a_turn_on(points, azimuths):
    mask = HorizonMask(points)
    heights = [el for _, el in points] if mask.is_line else [0.0]
    lowest, highest = min(heights), max(heights)
    for each in azimuths:
        assert lowest - 1e-9 <= mask.at(each) <= highest + 1e-9
        assert mask.at(each % 360.0) == mask.at(each)


def test_recorded_points_replace_the_one_at_the_same_azimuth():
    mask = HorizonMask([(0, 5)])
    longer = mask.insert(90, 10).insert(359.99, 7)
    assert longer.points == ((90.0, 10.0), (359.99, 7.0))
    assert mask.points == ((0.0, 5.0),)
    assert longer.remove(89.5).points == ((359.99, 7.0),)
    with pytest.raises(LookupError):
        longer.remove(45)


@pytest.mark.parametrize("point", [(0, 91), (float("nan"), 1), (1, float("inf"))])
def test_no_point(point):
    with pytest.raises(ValueError, match="no point"):
        HorizonMask([point])


class TestText:
    @pytest.mark.parametrize(
        "text",
        ["0 5\n90 10.5\n", "0,5\n90,10.5", "az;el\n0;5\n90;10.5\n", "# trees\n\n 0\t5 # oak\n90\t10.5\n",
         "\ufeff; Stellarium\n0.0 5.0\n90.0 10.5", "0°, 5°\n90°, 10.5°"],
    )  # fmt: skip
    def test_azimuth_and_elevation(self, text, tmp_path):
        (tmp_path / "h.txt").write_text(text, encoding="utf-8")
        assert read_horizon_file(tmp_path / "h.txt").points == ((0.0, 5.0), (90.0, 10.5))

    def test_the_profile_that_pvgis_prints_counts_from_the_south(self):
        text = (
            "Latitude (decimal degrees):\t45.0\nLongitude (decimal degrees):\t8.0\n\n"
            "A\t\tH_hor\tA_sun(w)\tH_sun(w)\n-180.0\t2.7\t-180.0\t0.0\n-90.0\t4.0\t-1.0\t0.0\n0.0\t9.0\t1\t2\n"
            "\nA: Azimuth (0 = S, 90 = W, -90 = E) (degree)\nPVGIS (c) European Communities, 2001-2024\n"
        )
        assert read_horizon(text).points == ((0.0, 2.7), (90.0, 4.0), (180.0, 9.0))

    def test_heights_alone_begin_in_the_north(self):
        assert read_horizon("1\n2\n3\n4\n").points == ((0, 1), (90, 2), (180, 3), (270, 4))

    @pytest.mark.parametrize(
        ("text", "says"),
        [
            ("0 5\nninety 10\n", "h.txt:2: 'ninety 10' is no azimuth"),
            ("0 5\n\n90 95\n", "h.txt:3: elevation 95"),
            ("0 5\n400 5\n", "h.txt:2: azimuth 400"),
            ("0 5\n90\n", "h.txt:2: an elevation is missing"),
            ("nothing here\n", "holds no point"),
            ("0 nan\n", "h.txt:1: elevation nan"),
        ],
    )
    def test_what_is_wrong_is_named_with_its_line(self, text, says):
        with pytest.raises(ValueError, match=re.escape(says)):
            read_horizon(text, "h.txt")

    def test_what_is_written_is_read_again(self):
        mask = HorizonMask([(0, 5), (123.45, 6.5)])
        assert read_horizon(write_horizon(mask)) == mask

"""Several maps: averaged by their readings, subtracted, and refused with what differs."""

from __future__ import annotations

import math
import statistics
from dataclasses import replace

import pytest
from birdcage.skymap.combine import MapsDiffer, mean_of, minus
from birdcage.skymap.map_export import base_name, write_files
from birdcage.skymap.plan import MapFrame, MapPlan

from tests.skymap.made import made_map

PLAN = MapPlan(160.0, 162.0, 25.0, 26.0, 1.0)
ABOUT = {"dish": "Carryout G2", "feed": "own", "latitude_deg": 52.0, "longitude_deg": 4.0}


def one(number=1, level=400.0, plan=PLAN, heard=None, **other):
    return made_map(plan, lambda az, el: level + az, heard=heard, number=number, **{"about": ABOUT, **other})


def with_readings(sky_map, readings):
    """Return it with the mean, scatter and count of these in its first cell, which is the only one then."""
    sample = replace(
        sky_map.samples[0], value=statistics.mean(readings), n=len(readings),
        scatter=statistics.stdev(readings) if len(readings) > 1 else None,
    )  # fmt: skip
    return sky_map.with_samples((sample,))


def test_a_mean_is_that_of_all_readings_together():
    readings = ([400.0, 401.0, 405.0], [410.0, 412.0], [420.0])
    mean = mean_of([with_readings(one(number), each) for number, each in enumerate(readings, start=12)])
    (sample,) = mean.samples
    together = [each for group in readings for each in group]
    assert sample.value == pytest.approx(statistics.mean(together))
    assert sample.scatter == pytest.approx(statistics.stdev(together))
    assert (sample.n, sample.integration_s, sample.utc) == (6, 1.5, None)
    assert (mean.about["mean_of"], mean.number, mean.about["dish"]) == ([12, 13, 14], None, "Carryout G2")


def test_a_cell_that_only_some_maps_have_is_of_those():
    mean = mean_of([one(1, 400.0), one(2, 410.0, heard=2)])
    assert len(mean.samples) == 6
    values = {each.cell: (each.value, each.n) for each in mean.samples}
    both = {PLAN.sequence[0], PLAN.sequence[1]}
    for cell, told in values.items():
        level = PLAN.at(cell)[0]
        assert told == ((405.0 + level, 20) if cell in both else (400.0 + level, 10))
    assert mean_of([one(1), one(2)]).is_complete


def test_one_less_another_in_the_cells_that_both_have():
    difference = minus(one(12, 410.0), one(9, 400.0, heard=4))
    assert {each.cell for each in difference.samples} == set(PLAN.sequence[:4])
    for sample in difference.samples:
        assert (sample.value, sample.n) == (10.0, 1)
        assert sample.scatter == pytest.approx(math.sqrt(0.7**2 / 10 * 2))
    assert difference.about["minus"] == [9]
    assert base_name(difference).startswith("map-12-minus-9")
    with pytest.raises(MapsDiffer, match="Map 1 and Map 2 have no direction in common"):
        minus(one(1, heard=2), one(2).with_samples(one(2).samples[2:]))


TURNED = replace(PLAN, frame=MapFrame.TARGET)
TURNED_SMALL = MapPlan(-1.0, 1.0, -1.0, 1.0, 1.0, frame=MapFrame.TARGET)
UNLIKE = {
    "tuned": ({"settings": ({"transponder": "5"},)}, "The receiver's `transponder` differs: 1 on Map 1, 5 on Map 2."),
    "missing": ({"settings": ({},)}, "The receiver's `transponder` differs: 1 on Map 1, nothing on Map 2."),
    "source": ({"source": "rtl"}, "The source differs: tuner on Map 1, rtl on Map 2."),
    "unit": ({"unit": "dB"}, "The unit differs: counts on Map 1, dB on Map 2."),
    "scale": ({"decibels": True}, "The scale differs: no decibels on Map 1, decibels on Map 2."),
    "frame": ({"plan": TURNED}, "The frame differs: azel on Map 1, target on Map 2."),
    "grid": ({"plan": replace(PLAN, x_low_deg=159.0)}, "The lowest azimuth differs: 160° on Map 1, 159° on Map 2."),
    "step": ({"plan": replace(PLAN, step_deg=0.5)}, "The step between columns differs: 1° on Map 1, 0.5° on Map 2."),
    "rows": ({"plan": replace(PLAN, y_step_deg=0.5)}, "The step between rows differs: 1° on Map 1, 0.5° on Map 2."),
    "demo": ({"demo": False}, "The sky differs: simulated on Map 1, real on Map 2."),
    "feed": ({"about": {**ABOUT, "feed": "helix"}}, "`feed` differs: own on Map 1, helix on Map 2."),
}  # fmt: skip


@pytest.mark.parametrize("what", UNLIKE)
def test_maps_that_were_made_in_another_way_refuse_and_say_in_which(what):
    other, why = UNLIKE[what]
    for combine in (lambda a, b: mean_of([a, b]), minus):
        with pytest.raises(MapsDiffer) as refused:
            combine(one(1), one(2, **other))
        assert str(refused.value) == why


def test_a_map_that_was_retuned_in_the_middle_refuses_too():
    sky_map = one(1, settings=({"transponder": "1"}, {"transponder": "3"}))
    retuned = sky_map.with_samples((*sky_map.samples[:3], *(replace(each, settings=1) for each in sky_map.samples[3:])))
    with pytest.raises(MapsDiffer, match="`transponder` differs: 1 on Map 1, 3 on Map 1"):
        mean_of([retuned, one(2)])


def test_a_measured_voltage_may_differ_a_little_and_no_more():
    def fed(number, volts):
        return one(number, settings=({"lnb_supply": volts},))

    assert mean_of([fed(1, "13.1 V"), fed(2, "13.4 V")]).is_complete
    with pytest.raises(MapsDiffer, match=r"`lnb_supply` differs: 13\.1 V on Map 1, 18\.2 V on Map 2"):
        mean_of([fed(1, "13.1 V"), fed(2, "18.2 V")])


def test_the_order_of_the_directions_and_the_height_of_a_place_do_not_matter():
    other = one(2, about={**ABOUT, "height_m": 3.0}, plan=replace(PLAN, order=PLAN.order.ROWS))
    mean = mean_of([one(1), other])
    assert mean.is_complete
    assert "height_m" not in mean.about


def test_a_single_map_is_no_mean():
    with pytest.raises(MapsDiffer, match="two maps or more"):
        mean_of([one()])


def test_a_combined_map_is_written_like_any_other(tmp_path):
    for number, sky_map in enumerate((mean_of([one(1), one(2)]), minus(one(1, 500.0), one(2)))):
        done = write_files(sky_map, tmp_path / str(number))
        assert done.left_out == ["text"]
        assert done.notes == ["No raw text: its files are named by time alone, and hold a map as it was heard."]
        assert [each.suffix for each in done.paths] == [".csv", ".png", ".fits"]


def test_directions_are_averaged_across_north():
    def at(number, az_deg, n):
        sky_map = one(number)
        return sky_map.with_samples((replace(sky_map.samples[0], az_deg=az_deg, n=n),))

    (sample,) = mean_of([at(1, 359.98, 1), at(2, 0.02, 3)]).samples
    assert sample.az_deg == pytest.approx(0.01)
    (sample,) = mean_of([at(1, 0.02, 3), at(2, 359.98, 1)]).samples
    assert sample.az_deg == pytest.approx(0.01)
    (sample,) = mean_of([at(1, 359.98, 3), at(2, 0.02, 1)]).samples
    assert sample.az_deg == pytest.approx(359.99)


@pytest.mark.parametrize("combined", [lambda a, b: mean_of([a, b]), minus])
def test_a_combined_map_around_a_target_tells_no_direction(tmp_path, combined):
    (path,) = write_files(combined(one(1, plan=TURNED_SMALL), one(2, plan=TURNED_SMALL)), tmp_path, ("csv",)).paths
    (names,) = (line for line in path.read_text().splitlines() if line.startswith("cell,"))
    assert "x_deg,y_deg,value" in names
    (path,) = write_files(one(1, plan=TURNED_SMALL), tmp_path, ("csv",)).paths
    assert "x_deg,y_deg,az_deg,el_deg" in path.read_text()

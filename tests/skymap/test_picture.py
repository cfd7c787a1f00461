"""A map as a picture: each cell in its colour where it belongs, what was not measured hatched, and no place in it."""

from __future__ import annotations

import io
import math
import random
from dataclasses import replace
from datetime import timedelta

import numpy as np
import pytest
from birdcage.skymap import picture
from birdcage.skymap.colour_maps import COLOUR_MAPS, USUAL
from birdcage.skymap.picture import INK, PAPER, as_png
from birdcage.skymap.picture_words import (
    axis_names,
    axis_ticks,
    drawn,
    level_ticks,
    satellites_on,
    tick_words,
    title_of,
    told_of,
)
from birdcage.skymap.place_blur import blurred
from birdcage.skymap.plan import MapFrame, MapPlan
from PIL import Image

from tests.skymap.made import BEGUN, made_map

PLAN = MapPlan(160.0, 220.0, 25.0, 55.0, 1.0)
PLACE = {"latitude_deg": 39.1, "longitude_deg": -95.7}
ABOUT = {"dish": "Carryout G2", "feed": "Ku LNB", "source_label": "dish tuner", "freq_hz": 12.45e9, "beam_az_deg": 3.0,
         "beam_el_deg": 3.2, "target": ""}  # fmt: skip


def level(az, el):
    return 400.0 + az / 10.0 + el


def opened(sky_map, colours=USUAL):
    return Image.open(io.BytesIO(as_png(sky_map, colours)))


@pytest.mark.parametrize("colours", COLOUR_MAPS)
@pytest.mark.parametrize("plan", [PLAN, MapPlan(0.0, 360.0, 5.0, 65.0, 1.0), MapPlan(-2.0, 2.0, 30.0, 31.0, 0.5)])
def test_every_cell_has_the_colour_of_its_level_where_its_angles_are(plan, colours):
    random.seed(1)
    sky_map = made_map(plan, level, heard=plan.cells // 2)
    seen, at = opened(sky_map, colours).load(), picture._laid_out(sky_map).at
    values = [each.value for each in sky_map.samples]
    for sample in random.sample(sky_map.samples, min(40, len(sky_map.samples))):
        x, y = at(*plan.at(sample.cell))
        wanted = COLOUR_MAPS[colours]((sample.value - min(values)) / (max(values) - min(values)))
        assert max(abs(a - b) for a, b in zip(seen[int(x), int(y)], wanted, strict=True)) <= 3


def test_what_was_not_measured_is_hatched_in_no_colour_of_a_scale():
    sky_map = made_map(PLAN, level, heard=PLAN.cells - 1)
    (missing,) = set(range(PLAN.cells)) - {each.cell for each in sky_map.samples}
    x, y = picture._laid_out(sky_map).at(*PLAN.at(missing))
    block = np.array(opened(sky_map))[int(y) - 12 : int(y) + 12, int(x) - 12 : int(x) + 12].reshape(-1, 3).astype(int)
    assert len({tuple(each) for each in block}) == 2, "lines on grey"
    for colour_map in COLOUR_MAPS.values():
        for step in range(201):
            apart = np.abs(block - np.array(colour_map(step / 200))).max(axis=1)
            assert apart.min() > (1 if colour_map is COLOUR_MAPS["grey"] else 20)


def test_satellites_are_ringed_where_they_stand_and_named():
    sky_map = made_map(PLAN, level, about=PLACE)
    found = {label: (az, el, name) for az, el, label, name in satellites_on(sky_map)}
    assert found["119°W"][2] == "EchoStar 14"
    assert found["101°W"][:2] == pytest.approx((188.4, 44.4), abs=0.1)
    seen = opened(sky_map).load()
    for az, el, _name in found.values():
        x, y = picture._laid_out(sky_map).at(az, el)
        ring = [seen[round(x + 10 * math.cos(turn / 8)), round(y + 10 * math.sin(turn / 8))] for turn in range(50)]
        assert INK in ring
        ring = [seen[round(x + 13 * math.cos(turn / 8)), round(y + 13 * math.sin(turn / 8))] for turn in range(50)]
        assert PAPER in ring


def test_a_satellite_is_found_on_a_map_that_goes_across_north():
    sky_map = made_map(
        MapPlan(310.0, 410.0, 5.0, 70.0, 1.0), level, about={"latitude_deg": -33.9, "longitude_deg": 151.2}
    )
    told = [az for az, _el, _label, _name in satellites_on(sky_map)]
    assert all(310.0 <= az <= 410.0 for az in told)
    assert any(az > 360.0 for az in told)


@pytest.mark.parametrize("frame", MapFrame)
def test_a_blurred_map_is_drawn_as_one_without_a_place(frame):
    plan = replace(PLAN, frame=frame)
    known, unknown = (made_map(plan, level, about={**ABOUT, **more}) for more in (PLACE, {}))
    assert as_png(blurred(known)) == as_png(unknown)
    assert (as_png(known) == as_png(unknown)) is (frame is MapFrame.TARGET)


def test_a_simulated_sky_says_so_in_the_picture_and_in_its_text():
    demo, real = (opened(made_map(PLAN, level, number=12, demo=each)) for each in (True, False))
    assert demo.text["Comment"] == "DEMO: a simulated dish, not a real one"
    assert "Comment" not in real.text
    assert demo.text["Title"] == "Sky map 12: azimuth 160 to 220°, elevation 25 to 55°"
    dark = [np.all(np.array(each)[: picture.TOP + 60] == INK, axis=2).sum() for each in (demo, real)]
    assert dark[0] > dark[1] + 5000, "a badge beside the title"


def test_the_words():
    sky_map = made_map(PLAN, level, number=12, about=ABOUT)
    assert told_of(sky_map) == [
        "20 Mar 2026 06:00 to 06:47 UTC", "dish tuner", "Carryout G2", "feed Ku LNB", "12.45 GHz",
    ]  # fmt: skip
    late = replace(sky_map.samples[0], utc=BEGUN + timedelta(hours=20))
    assert told_of(sky_map.with_samples((*sky_map.samples, late)))[0] == "20 Mar 2026 06:00 to 21 Mar 2026 02:00 UTC"
    assert told_of(made_map(PLAN, level, begun=None, heard=0))[0] == "time unknown"
    assert title_of(made_map(PLAN, level, about={"mean_of": [3, 4]})).startswith("Mean of maps 3, 4: azimuth")
    assert title_of(made_map(PLAN, level, about={"mean_of": [3], "minus": [4]})).startswith("Sky map 3 minus 4: ")
    around = made_map(replace(PLAN, frame=MapFrame.TARGET), level, number=5, about={"target": "Sun"})
    assert (title_of(around), axis_names(around)) == ("Sky map 5: around Sun", ("Right of Sun", "Above Sun"))
    assert [tick_words(around, each, azimuth=True) for each in (-1.5, 0.0, 2.0)] == ["-1.5°", "0°", "+2°"]
    assert [tick_words(sky_map, each, azimuth=True) for each in (180.0, 350.0, 360.0, 405.0, -90.0)] == [
        "180° S", "350°", "0° N", "45° NE", "270° W",
    ]  # fmt: skip
    assert drawn("Müller’s 鍋 3°") == "Muller?s ? 3°"


def test_ticks_leave_room_and_are_round():
    assert axis_ticks(160.0, 220.0, 1.0, 36.0, 150.0) == [160.0 + 5.0 * each for each in range(13)]
    assert axis_ticks(170.0, 172.0, 1.0, 700.0, 150.0) == [170.0, 171.0, 172.0]
    assert level_ticks(400.0, 512.0, 8) == [400.0, 420.0, 440.0, 460.0, 480.0, 500.0]
    assert level_ticks(-42.7, -35.0, 10) == [-42.0, -41.0, -40.0, -39.0, -38.0, -37.0, -36.0, -35.0]
    assert level_ticks(5.0, 5.0, 8) == [5.0]


@pytest.mark.parametrize("heard", [0, 1])
def test_a_map_of_nothing_or_of_one_level_is_a_picture_too(heard):
    sky_map = made_map(MapPlan(160.0, 160.0, 25.0, 25.0, 1.0), level, heard=heard)
    assert opened(sky_map).size[0] > 1000
    assert opened(made_map(PLAN, lambda az, el: 400.0)).size[0] > 1000

"""Maps that the station makes of the simulated sky, over the wire: what they teach is what was planted."""

from __future__ import annotations

import pytest
from birdcage.base.beam import Beam
from birdcage.base.config import Settings
from birdcage.base.config.sections import PlaceSettings
from birdcage.sim.trees import TreeLine
from birdcage.skymap.lesson_inputs import inputs_for
from birdcage.skymap.plan import MapPlan

from tests.skymap.map_bench import made

PLACE = Settings(place=PlaceSettings(latitude_deg=39.1, longitude_deg=-95.7))
BY_THEORY = Beam(5.5, 5.5)
"""What the station tells of a G2's stock feed."""
TREES = "150:20,165:27,190:25,205:30"


def lessons(tmp_path, address, plan):
    bench = made(tmp_path, address)
    bench.begin(plan)
    ended = bench.run(5000.0)
    assert ended.is_done, ended.why
    sky_map = bench.read()
    bench.end()
    return inputs_for(sky_map, PLACE, (), BY_THEORY)


def test_a_base_turned_by_7_and_tilted_by_2_degrees_is_told_by_its_own_map(tmp_path):
    address = "g2?seed=1&heading=7&tilt_north=1.2&tilt_east=-1.6"
    found = lessons(tmp_path, address, MapPlan(115.0, 235.0, 20.0, 54.0, 2.0)).north(40.0).alignment
    assert (found.az_offset_deg, found.an_deg, found.aw_deg) == (
        pytest.approx(7.0, abs=0.2), pytest.approx(1.2, abs=0.2), pytest.approx(1.6, abs=0.2),
    )  # fmt: skip


def test_planted_trees_are_told_by_the_map(tmp_path):
    found = lessons(tmp_path, f"g2?seed=2&trees={TREES}", MapPlan(140.0, 215.0, 18.0, 46.0, 1.8)).horizon()
    line = TreeLine(TREES)
    inside = [edge for edge in found.edges if 153.0 <= edge.az_deg <= 202.0 and not edge.is_clear]
    assert len(inside) > 20
    assert [edge.az_deg for edge in inside if abs(edge.el_deg - line.at(edge.az_deg)) > 1.5] == []

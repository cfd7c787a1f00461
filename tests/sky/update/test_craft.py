"""The prediction server: asked as documented, and never believed blindly."""

from __future__ import annotations

import json
from datetime import UTC, datetime

import pytest
from birdcage.sky.update.craft import Craft
from birdcage.sky.update.errors import FetchError


def body(value):
    return (200, {"Content-Type": "application/json"}, json.dumps(value).encode())


def test_it_is_asked_by_the_documented_paths_and_understood(server):
    craft = Craft(server.url("/base/"))
    one_pass = {
        "satellite_name": "NOAA 20", "norad_id": 43013, "aos_time": "2026-07-04T12:00:00Z", "aos_az": 10.5,
        "tca_time": "2026-07-04T12:05:00", "tca_alt": 45, "tca_az": 90, "los_time": "2026-07-04T14:10:00+02:00",
        "los_az": None, "max_elevation": 45.0, "duration_seconds": 600, "is_visible": True, "magnitude": None,
    }  # fmt: skip
    look = {
        "name": "Moon", "target_type": "moon", "target_id": "moon", "azimuth_deg": 1.0, "altitude_deg": 2.0,
        "distance_km": 4e5, "range_rate_km_s": None, "is_above_horizon": True,
    }  # fmt: skip
    target = {"name": "Moon", "target_type": "moon", "target_id": "moon", "score": 1, "groups": ["solar"]}
    server.answers["/base/api/search?q=moon+%26+sun&limit=5"] = body({"results": [target]})
    server.answers["/base/api/sky/up?min_alt=18.0"] = body({"objects": [look]})
    server.answers["/base/api/passes?sat=NOAA+20&hours=12"] = body({"passes": [one_pass]})
    server.answers["/base/api/passes/next?sat=NOAA+20"] = body({"passes": []})

    (found,) = craft.search("moon & sun", 5)
    assert (found.name, found.target_type, found.groups, found.elevation_deg) == ("Moon", "moon", ("solar",), None)
    (seen,) = craft.up(18.0)
    assert (seen.azimuth_deg, seen.elevation_deg, seen.range_km, seen.range_rate_km_s) == (1.0, 2.0, 4e5, None)
    (over,) = craft.passes("NOAA 20", 12)
    assert over.aos == datetime(2026, 7, 4, 12, 0, tzinfo=UTC)
    assert over.los == datetime(2026, 7, 4, 12, 10, tzinfo=UTC)
    assert (over.tca.tzinfo, over.los_azimuth_deg, over.norad_id) == (UTC, None, 43013)
    assert craft.next_pass("NOAA 20") is None


@pytest.mark.parametrize(
    "answer",
    [
        (500, {}, b""),
        (200, {}, b"<html>"),
        body([]),
        body({"objects": None}),
        body({"objects": [1]}),
        body({"objects": [{"name": "x"}]}),
        body({"objects": [{"name": "x", "target_type": "y", "target_id": 1, "azimuth_deg": "north"}]}),
        (200, {}, b'{"objects": [{"name": "x", "target_type": "y", "target_id": 1, "azimuth_deg": NaN}]}'),
    ],
)
def test_an_answer_that_is_none_is_an_error_and_not_an_empty_sky(server, answer):
    server.answers["/api/sky/up?min_alt=0.0"] = answer
    with pytest.raises(FetchError) as caught:
        Craft(server.url("")).up()
    assert caught.value.reason in ("http", "garbage")

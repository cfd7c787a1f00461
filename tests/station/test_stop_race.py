"""STOP from another thread in the very moment in which a motion is being sent."""

from __future__ import annotations

import pytest
from birdcage.station.requests import Goto


@pytest.mark.parametrize("axis", ["0", "1"])
def test_no_line_of_the_motion_follows_stop(bench, axis):
    """STOP is called while one of the two lines of a go-to leaves: the other one must not go out after it."""
    bench.do(Goto(180, 45, "you"))
    written = []
    write = bench.sim.write

    def tap(data):
        write(data)
        written.append(data.decode())
        if data.startswith(f"a {axis} ".encode()) and not bench.station.state.held and len(stops) == 0:
            stops.append(len(written))
            bench.station.stop("you")

    stops = []
    bench.sim.write = tap
    bench.station.submit(Goto(230, 30, "you"))
    bench.step(10)
    after = "".join(written[stops[0] :]).split("\r")
    assert "a 0 230.00" not in after
    assert "a 1 30.00" not in after
    assert not bench.device.truth().moving
    assert abs(bench.device.truth().az_deg - 180) < 20
    assert bench.state.held is not None

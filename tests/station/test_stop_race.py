"""STOP from another thread in the very moment in which a motion is being sent."""

from __future__ import annotations

import pytest
from birdcage.base.errors import MotionRefused, Stopped
from birdcage.station.requests import Goto, Release

from .conftest import Bench


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


@pytest.mark.parametrize(("address", "firmware"), [
    ("g2plus?seed=1&bare_a=error", "g2plus"), ("pathway-x2?seed=1&lag_max_s=0", "pathway-x2"),
])  # fmt: skip
def test_stop_between_both_axes_of_a_dish_that_does_not_tell_leaves_no_position(address, firmware):
    bench = Bench(address, firmware=firmware).connect(8.0)
    bench.do(Goto(180, 45, "you"), 200)
    assert bench.state.position is not None
    write = bench.sim.write

    def tap(data):
        write(data)
        if data.startswith(b"a 0 230"):
            bench.station.stop("you")

    bench.sim.write = tap
    future = bench.station.submit(Goto(230, 30, "you"))
    bench.step(4)
    assert isinstance(future.exception(0), Stopped)
    assert [line for line in bench.lines() if line.startswith("a ")][-1] == "a 0 230.00"
    assert (bench.state.position, bench.state.position_lost) == (None, "untold")
    assert bench.state.last_stop.confirmed is not True
    assert bench.state.fault is None
    bench.do(Release("you"))
    with pytest.raises(MotionRefused, match="may still be on its way"):
        bench.do(Goto(100, 45, "you"))
    bench.step(100)
    bench.do(Goto(100, 45, "you"), 200)
    truth = bench.device.truth()
    assert (truth.az_deg, truth.el_deg) == (pytest.approx(100.0, abs=0.1), pytest.approx(45.0, abs=0.1))

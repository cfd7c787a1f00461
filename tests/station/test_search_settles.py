"""After the search was ended the dish is not told to rest before it does, and its last turn raises no alarm."""

from __future__ import annotations

import pytest
from birdcage.station.requests import AcknowledgeFault, Release, SetSearch
from birdcage.station.state import Activity

from .queued_bench import QueuedBench


@pytest.mark.parametrize("wait_s", [0.0, 0.1, 11.0, 12.0, 12.5, 13.0, 14.0])
def test_a_search_that_is_ended_settles(wait_s):
    bench = QueuedBench("search_finds=0&boot_home_s=20")
    bench.connect(12)
    bench.watch("position", rate_hz=1.0)
    bench.do(SetSearch("you", disabled=True))  # its prompts are learnt: the next time is quick
    bench.device.reboot()
    while bench.state.activity is not Activity.MOVING_UNASKED:
        bench.step(0.5)
    bench.step(wait_s)
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    while not (bench.device.truth().moving and bench.state.activity is Activity.MOVING_UNASKED):
        bench.step(0.1)
    future = bench.station.submit(SetSearch("you", disabled=True))
    while not future.done():
        bench.step(0.005)
    assert future.result(0) is None
    for _ in range(400):
        bench.step(0.05)
        assert not (bench.device.truth().moving and bench.state.activity is Activity.IDLE)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.fault is None

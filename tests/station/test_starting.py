"""A dish counts as starting by what it prints, never by answers that come late or in pieces."""

from __future__ import annotations

import pytest
from birdcage.station.state import Activity, LinkPhase

from .queued_bench import QueuedBench, connected


def silent() -> QueuedBench:
    bench = connected()
    bench.device.wire.to_dish.silent = True
    bench.watch("position")
    bench.step(6.0)
    assert bench.state.link.state is LinkPhase.SILENT
    return bench


@pytest.mark.parametrize("lines", [
    ("nvs", "reboot", "stow", "motor"), ("nv", "rebooot", "stow", "mtor"),
    ("Enter <motor> - motors", "stow - folds it", "nvs"),
])  # fmt: skip
def test_a_list_of_commands_that_comes_late_is_no_boot_log(lines):
    bench = silent()
    for line in lines:
        bench.device.shell.say(f"{line}\r\n")
        bench.step(0.1)
    assert bench.state.activity is not Activity.INITIALIZING


def test_a_boot_log_is_one():
    bench = silent()
    for line in ("HAL 2.05.003", "IDU found", "NVS loaded", "AZ calibrating"):
        bench.device.shell.say(f"{line}\r\n")
        bench.step(0.1)
    assert bench.state.activity is Activity.INITIALIZING

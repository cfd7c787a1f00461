"""An axis that fails to home is told with what helps it: by its papers where they say, and it says more than a restart.

`docs/safety.md`, *EL Motor Home Failure*: it needs the elevation calibrated by the buttons of the indoor unit.
"""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held
from birdcage.station.requests import AcknowledgeFault, Goto, Release
from birdcage.station.state import Activity

from .conftest import Bench

BUTTONS = ("press POWER", "hold ENTER for 2 s", "INSTALLATION", "Calibrate EL", "hard stop")


def starting() -> Bench:
    bench = Bench("hal205?seed=1&boot=1&boot_home_s=20&home_fails=1", firmware="hal205")
    bench.step(30.0)
    return bench


def restarted() -> Bench:
    bench = Bench("hal205?seed=1&boot_home_s=20&home_fails=1", firmware="hal205").connect(20.0)
    bench.device.reboot()
    bench.step(60.0)
    return bench


@pytest.mark.parametrize("begin", [starting, restarted])
def test_the_fault_names_the_buttons_of_the_indoor_unit(begin):
    bench = begin()
    fault = bench.state.fault
    assert fault.what == "The elevation did not home: the dish says 'EL Motor Home Failure'"
    assert all(words in fault.remedy for words in BUTTONS), fault.remedy
    with pytest.raises(Held):
        bench.do(Goto(180.0, 45.0, "you"))


def test_a_dish_that_fails_to_home_while_it_starts_is_still_shown_as_starting():
    bench = Bench("hal205?seed=1&boot=1&boot_home_s=20&home_fails=1", firmware="hal205")
    bench.step(10.0)
    assert bench.state.activity is Activity.INITIALIZING
    assert "did not home" in bench.state.fault.what


def test_once_acknowledged_the_next_restart_is_told_as_one():
    bench = restarted()
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    bench.device.shell.say("No LNB Voltage\r\n")
    bench.step(5.0)
    assert bench.state.fault.reason == "reboot"


def test_where_no_papers_tell_it_is_freed_and_homed_again():
    bench = Bench("g2?seed=1").connect()
    bench.device.shell.say("AZ Motor Home Failure\r\n")
    bench.step(2.0)
    assert bench.state.fault.what == "The azimuth did not home: the dish says 'AZ Motor Home Failure'"
    assert bench.state.fault.remedy == (
        "Find what blocks it, and free it. Then switch it off and on, or acknowledge and home it."
    )
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    bench.device.reboot()
    bench.step(60.0)
    assert bench.state.fault.reason == "reboot", "an old failure hides no new restart"

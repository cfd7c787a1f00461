"""A dish that answers, and whose position is no angle: it counts as connected, and homing mends it."""

from __future__ import annotations

import re

import pytest
from birdcage.base.errors import PositionUnknown
from birdcage.station.requests import Goto, Home
from birdcage.station.state import LinkPhase

from .conftest import Bench

KNOWN = (
    "2147483647", "2147483647.00", "2147483648.00", "-2147483648.00", "21474836.47", "21474836.00", "21474836.5",
    "-21474836.48",
)  # fmt: skip
"""INT_MAX and INT_MIN, whole and as hundredths, as single precision rounds them and with fewer decimals."""
ODD = ("nan", "------", "9999.00", "18000", "not homed", "Axis not calibrated.")


def home(bench: Bench) -> None:
    bench.do(Home("test"), 60.0)
    assert bench.state.homed is True
    assert bench.state.position is not None
    bench.do(Goto(20.0, 40.0, "test"), 60.0)


@pytest.mark.parametrize("printed", KNOWN)
def test_a_g2_that_prints_int_max_in_any_form_is_not_homed_and_can_be(printed):
    bench = Bench(f"g2?seed=1&unhomed=1&unhomed_angle={printed}").connect(8.0)
    assert (bench.state.homed, bench.state.position, bench.state.position_lost) == (False, None, "unhomed")
    with pytest.raises(PositionUnknown) as refused:
        bench.do(Goto(20.0, 40.0, "test"))
    assert refused.value.reason == "unhomed"
    assert bench.moves_since(0.0) == []
    home(bench)


@pytest.mark.parametrize("printed", KNOWN)
def test_a_travler_is_judged_by_the_same_numbers(printed):
    sent = printed if "." in printed else f"{printed}.00"
    address = f"hal205?seed=1&unhomed=1&search_finds=0&unhomed_angle={sent}"
    bench = Bench(address, {"baud": 57600}, firmware="hal205").connect(8.0)
    assert (bench.state.homed, bench.state.position, bench.state.position_lost) == (False, None, "unhomed")


@pytest.mark.parametrize("printed", ODD)
def test_a_g2_that_prints_no_angle_is_told_so_and_can_be_homed(printed):
    bench = Bench("g2?seed=1&unhomed=1", {})
    print_instead(bench, printed)
    bench.connect(8.0)
    lost = "unhomed" if printed.startswith(("not", "Axis")) else "unreadable"
    assert (bench.state.link.state, bench.state.position_lost) == (LinkPhase.UP, lost)
    assert bench.state.position is None
    assert (bench.state.held, bench.state.fault) == (None, None)
    if lost == "unreadable":
        assert printed in bench.state.position_text
    with pytest.raises(PositionUnknown) as refused:
        bench.do(Goto(20.0, 40.0, "test"))
    assert refused.value.reason == lost
    assert bench.moves_since(0.0) == []
    home(bench)
    assert bench.state.position_text == ""


def test_a_dish_whose_position_stays_unreadable_is_homed_all_the_same():
    bench = Bench("g2?seed=1")
    print_instead(bench, "n/a", always=True)
    bench.connect(8.0)
    bench.do(Home("test"), 60.0)
    assert [line for line in bench.lines() if line.startswith("h ")] == ["h 0", "h 1"]
    assert (bench.state.position_lost, bench.state.link.state) == ("unreadable", LinkPhase.UP)


def print_instead(bench: Bench, printed: str, *, always: bool = False) -> None:
    """Have `a` print this in place of the angle of an axis that is not homed, or of any."""
    menu = bench.device.shell._menus["mot"]
    run = menu.run

    def odd(words):
        for step in run(words):
            text = step
            if words == ["a"] and isinstance(step, str):
                pattern = r"= \S+" if always else r"= 2147483647\.00"
                text = re.sub(pattern, f"= {printed}", step)
            yield text

    menu.run = odd

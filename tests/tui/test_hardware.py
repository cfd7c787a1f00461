"""What the dish tells of its own hardware, on F1 and F8: with its age, or a dash."""

import re
from dataclasses import replace
from types import MappingProxyType

import pytest
from birdcage.rotator.feature import Reading
from stage import read, run


def told(supply_v=18.0, azimuth="OK", elevation="OK", age_s=12.0):
    """Return what makes a state's readings of a running app's stand-in."""

    async def read_with(app, pilot):
        now, utc = app.session.clock.monotonic(), app.session.clock.utc()
        values = {"lnb_supply": (supply_v, "V"), "driver.azimuth": (azimuth, ""), "driver.elevation": (elevation, "")}
        readings = {name: Reading(*each, now - age_s, utc) for name, each in values.items() if each[0] is not None}
        app.station.state = replace(app.station.state, readings=MappingProxyType(readings))
        app.paint()
        await pilot.pause()
        return await read(app, pilot)

    return read_with


def row(text):
    """Return the row that tells it: its own, or in a low pane the one of the firmware."""
    lines = [
        line for line in text.splitlines() if " hardware " in line or "● firmware  " in line or "▲ firmware  " in line
    ]
    (line,) = lines or [line for line in text.splitlines() if "· firmware  " in line]
    return line[line.index("ware  ") - 6 :].split("│")[0].rstrip()


def test_values_are_shown_with_the_age_of_the_oldest():
    assert row(run(told(), size=(160, 48))) == "● hardware  LNB 18.0 V, az driver OK, el driver OK, 12s ago"
    assert row(run(told(), size=(120, 36))) == "● firmware  02.02.48, LNB 18.0 V, rest OK, 12s ago"


@pytest.mark.parametrize("size", [(120, 36), (160, 48)], ids=str)
def test_a_fault_comes_first_and_is_marked(size):
    assert re.match(
        r"▲ .*ware  (02\.02\.48, )?el driver FAULT, LNB 18\.0 V", row(run(told(elevation="FAULT"), size=size))
    )


def test_what_was_not_told_is_a_dash():
    assert row(run(told(supply_v=None), size=(160, 48))).startswith("● hardware  LNB --, az driver OK")
    assert row(run(read, size=(160, 48))) == "· hardware  --"
    assert row(run(read, "travler", (160, 48))) == "· hardware  --"


def test_nothing_is_vouched_for_while_the_link_is_lost():
    assert row(run(told(), "lost", (160, 48))).startswith("· hardware  LNB 18.0 V")

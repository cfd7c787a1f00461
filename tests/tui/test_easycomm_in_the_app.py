"""The app on a real station and a simulated SatNOGS rotator: told where it points, driven, its motors shown, STOP."""

from __future__ import annotations

import asyncio

import pytest
from birdcage.station.requests import Goto, Sync

from .test_end_to_end import House


def in_the_app(check, options="&az=40&el=30", size=(120, 36)):
    """Run a check on the app."""

    async def run():
        house = House(f"easycomm?seed=1{options}")
        async with house.app.run_test(size=size) as house.pilot:
            for _ in range(5):
                await house.step(1.0)
            await check(house)
        house.session.close()

    asyncio.run(run())


def lines(house):
    with house.device.lock:
        house.device.machine.run()
        return [line for _, line in house.device.shell.received]


async def told(house):
    house.station.submit(Sync(40.0, None, "you"))
    for _ in range(3):
        await house.step(1.0)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)])
def test_f1_says_that_it_must_be_told_and_then_where_it_points(size):
    async def check(house):
        await house.pilot.press("f1")
        await house.step(1.0)
        assert "birdcage sync" in house.text() or "Y" in house.text()
        await told(house)
        await house.pilot.press("f1")
        await house.step(1.0)
        assert "40.0" in house.text()
        assert "30.0" in house.text()

    in_the_app(check, size=size)


def test_space_stops_it_by_its_own_command():
    async def check(house):
        await told(house)
        house.station.submit(Goto(120.0, 60.0, "you"))
        await house.step(2.0)
        assert house.device.truth().moving
        await house.pilot.press("space")
        for _ in range(8):
            await house.step(1.0)
        assert "STOP" in lines(house)
        assert "HELD" in house.text()
        assert not house.device.truth().moving

    in_the_app(check)


def test_f4_shows_its_gains_counts_and_accelerometer():
    async def check(house):
        await told(house)
        await house.pilot.press("f4", "m")
        for _ in range(12):
            await house.step(1.0)
        shown = house.text()
        for word in ("Proportional gain", "0.15", "Encoder ticks", "9784", "Accelerometer", "Take the elevation"):
            assert word in shown, word
        assert {"GAINS", "TICKS", "IMU", "GS", "GE"} <= set(lines(house))

    in_the_app(check, size=(160, 48))


def test_f5_warns_of_a_line_that_drives_a_motor_past_its_limits():
    async def check(house):
        await told(house)
        await house.pilot.press("f5", "i")
        await house.step(1.0)
        await house.pilot.press(*"DUTY", "underscore", *"AZ0", "full_stop", "2")
        await house.step(1.0)
        assert "past every limit" in house.text()
        await house.pilot.press("enter")
        for _ in range(3):
            await house.step(1.0)
        assert "DUTY_AZ0.2" not in lines(house), "it is asked first"

    in_the_app(check)

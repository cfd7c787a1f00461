"""The app on a real station and a simulated SatNOGS rotator: synced, driven, its motors shown, STOP."""

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
def test_f1_says_that_it_must_be_synced_and_then_where_it_points(size):
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
        for word in (
            "Proportional gain",
            "0.15",
            "Encoder ticks",
            "9784",
            "Accelerometer",
            "Recalibrate the elevation",
        ):
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


async def on_the_motor(house):
    """Select the azimuth's motor on F4, and agree to its hazard."""
    await told(house)
    await house.pilot.press("f4", "m")
    for _ in range(6):
        await house.step(1.0)
    while "Hold + to run the azimuth motor at 0.1" not in house.text():
        await house.pilot.press("down")
        await house.step(0.1)
    assert "birdcage set" not in house.text(), "it refuses what runs only while it is held"
    assert "duty.azimuth 0.1`" in house.text(), "that of birdcage motors run"
    await house.pilot.press("plus")
    await house.step(0.1)
    assert "allow the keys" in house.text()
    await house.pilot.press("y")
    await house.step(0.1)


def test_a_held_key_runs_a_motor_and_letting_go_sends_stop():
    async def check(house):
        await on_the_motor(house)
        assert not any(line.startswith("DUTY") for line in lines(house)), "the question alone runs nothing"
        for _ in range(20):
            await house.pilot.press("plus")
            await house.step(0.1)
        assert lines(house).count("DUTY_AZ0.10") == 1
        assert house.device.truth().moving
        assert "STOP" not in lines(house)
        assert "MOTOR" in house.text()
        for _ in range(10):
            await house.step(0.1)
        assert lines(house).count("STOP") == 1
        assert "No longer held: STOP was sent." in house.text()
        await house.step(2.0)
        assert not house.device.truth().moving
        await house.pilot.press("minus")
        await house.step(0.1)
        assert lines(house)[-1] != "STOP"
        assert "DUTY_AZ-0.10" in lines(house)

    in_the_app(check, size=(160, 48))


def test_space_ends_a_run_and_the_key_that_is_still_held_begins_none():
    async def check(house):
        await on_the_motor(house)
        await house.pilot.press("plus")
        await house.step(0.5)
        await house.pilot.press("space")
        await house.pilot.press("plus")
        await house.step(2.0)
        await house.pilot.press("plus")
        await house.step(2.0)
        assert [line for line in lines(house) if line.startswith("DUTY")] == ["DUTY_AZ0.10"]
        assert not house.device.truth().moving
        assert "HELD" in house.text()

    in_the_app(check)

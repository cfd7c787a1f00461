"""However the app ends, a dish that moves is stopped first, and the exit status says why it ended."""

import asyncio
import os
import signal

import pytest
import stand_in


async def after(name, end):
    app = stand_in.app_in(name)
    async with app.run_test() as pilot:
        await pilot.pause()
        await end(pilot)
        await pilot.pause(0.1)
        assert not app.is_running
    return app.station.stops, app.return_code


@pytest.mark.parametrize(("name", "stops"), [("idle", []), ("slewing", ["you"])])
def test_ctrl_q_stops_what_moves_and_ends_well(name, stops):
    assert asyncio.run(after(name, lambda pilot: pilot.press("ctrl+q"))) == (stops, 0)


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
@pytest.mark.parametrize(("state", "stops"), [("idle", []), ("slewing", ["signal"])])
@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="no such signals on this platform")
def test_a_signal_stops_what_moves_and_ends_with_its_status(name, state, stops):
    number = getattr(signal, name)

    async def send(pilot):
        os.kill(os.getpid(), number)

    before = signal.signal(number, lambda *_: pytest.fail("the app did not catch it"))
    try:
        assert asyncio.run(after(state, send)) == (stops, 128 + number)
    finally:
        signal.signal(number, before)

"""However the app ends, a dish that moves is stopped first, and the exit status says why it ended."""

import asyncio

import pytest
import stand_in
from burst import write


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


@pytest.mark.parametrize(("state", "stops"), [("idle", []), ("slewing", ["signal", "signal"])])
def test_a_signal_stops_what_moves_and_ends_with_its_status(state, stops):
    async def send(pilot):
        pilot.app.ending.by_signal(15)
        assert pilot.app.station.stops == stops[:1], "from the thread of the signals, whatever the app's own one does"

    assert asyncio.run(after(state, send)) == (stops, 143)


def test_a_signal_before_the_app_ends_it_as_soon_as_it_is_there():
    async def begin():
        app = stand_in.app_in("idle")
        app.ending.by_signal(15)
        async with app.run_test() as pilot:
            await pilot.pause(0.1)
            assert not app.is_running
        return app.return_code

    assert asyncio.run(begin()) == 143


def test_a_closed_terminal_is_taken_for_a_hangup():
    async def close(pilot):
        pilot.app.terminal_gone()

    assert asyncio.run(after("idle", close)) == ([], 129)


def test_an_end_while_a_layer_is_being_made_is_no_error():
    """A signal comes whenever it likes; what the layer then misses of itself is no fault."""

    async def ended(turns):
        app = stand_in.app_in("idle")
        async with app.run_test() as pilot:
            await pilot.pause()
            write(app, "question_mark")
            for _ in range(turns):
                await asyncio.sleep(0)
            app.ending.leave(status=143)
            await asyncio.sleep(1.0)
        return app.return_code

    assert {asyncio.run(ended(turns)) for turns in range(3, 9)} == {143}

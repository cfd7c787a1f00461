"""F4: what the dish tells of itself, read when somebody looks, set after a question, put back by one key."""

import re
from concurrent.futures import Future
from dataclasses import replace
from datetime import timedelta
from types import MappingProxyType

import pytest
import stand_in
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.diagnostics.motor_test_records import MotorTestBook
from birdcage.diagnostics.motor_test_task import MotorTests
from birdcage.protocol.carryout.model import CARRYOUT_2003
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.feature import Feature, FeaturePage, Reading, by_id
from birdcage.rotator.ladder import StopMeans
from birdcage.station.requests import Read, Set
from birdcage.station.state import Activity, BootLog
from birdcage_tui.system.detail_pane import DetailPane
from birdcage_tui.system.sheet_pane import SheetPane
from stage import run
from test_end_to_end import House, played, press

SIZES = [(80, 24), (120, 36), (160, 48)]


STOPPABLE = replace(CARRYOUT_G2, stop_ladder=tuple(replace(each, proven=True) for each in CARRYOUT_G2.stop_ladder))
"""A dish whose STOP is proven."""


def reading(value, unit="", at=100.0):
    return Reading(value, unit, at, stand_in.VirtualClock().utc())


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("key", ["b", "m", "d"])
def test_list_and_words_lie_inside_the_screen(size, key):
    async def look(app, pilot):
        await pilot.press(key)
        await pilot.pause()
        await pilot.pause()
        seen = [*app.query(SheetPane), app.query_one(DetailPane)]
        return [pane.region for pane in seen if pane.display]

    found = run(look, size=size, key="f4")
    assert len(found) == 2
    for region in found:
        assert region.width >= 40
        assert region.height >= 5
        assert region.right <= size[0]
        assert region.bottom <= size[1]


def answered(app, values, *, refuse=()):
    """Let the station of a stand-in answer each `Read` with these values, at once."""
    station = app.station

    def submit(request):
        station.asked.append(request)
        future = Future()
        if isinstance(request, Read):
            wrong = [each for each in request.features if each in refuse]
            if wrong:
                future.set_exception(CommandRefused(f"{wrong[0]} is not known here."))
            else:
                now = app.session.clock.monotonic()
                told = {each: reading(values.get(each, "x"), at=now) for each in request.features}
                station.state = replace(station.state, readings=MappingProxyType({**station.state.readings, **told}))
                future.set_result(told)
        return future

    station.submit = submit


async def settle(pilot):
    for _ in range(6):
        await pilot.pause()


def test_a_tab_asks_for_all_that_it_shows_in_two_questions_and_no_other_tab_does():
    async def look(app, pilot):
        answered(app, {})
        await pilot.press("f4", "b")
        await settle(pilot)
        return app.station.asked_for(Read)

    health, *reads = run(look)  # the first was for the Health tab, on arrival
    asked = [name for each in reads for name in each.features]
    page = {each.id for each in CARRYOUT_G2.features.values()
            if each.page is FeaturePage.HARDWARE and each.is_readable and not each.read_hazard}  # fmt: skip
    assert len(reads) <= 2
    assert sorted(asked) == sorted(page - set(health.features)), "what was just told is not asked for again"


def test_what_the_dish_refuses_is_marked_and_the_rest_is_read():
    async def look(app, pilot):
        answered(app, {}, refuse=("torque.azimuth", "torque.elevation"))
        await pilot.press("f4", "b")
        await settle(pilot)
        for _ in range(40):
            await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), app.system.sheets.now

    text, now = run(look, size=(120, 36))
    assert set(now.failed) == {"torque.azimuth", "torque.elevation"}
    assert not now.asked
    assert re.search(r"Torque of the motor +▲ not told +▲ not told", text)


@pytest.mark.parametrize(
    ("size", "state", "words"),
    [
        ((120, 36), {"activity": Activity.SLEWING, "unplanned_stop": StopMeans.RETARGET, "dish": STOPPABLE},
         "Nothing is read while it moves. Space stops it, then r reads."),
        ((120, 36), {"activity": Activity.SLEWING, "unplanned_stop": StopMeans.RETARGET},
         "Nothing is read while it moves. Once it rests, r reads."),
        ((120, 36), {"activity": Activity.HOMING, "dish": STOPPABLE},
         "Nothing is read while it moves. Once it rests, r reads."),
        ((80, 24), {"activity": Activity.SLEWING}, "Not read while moving"),
    ],
    ids=["stopped", "not proven", "homing", "narrow"],
)  # fmt: skip
def test_nothing_is_asked_while_the_dish_moves_and_the_page_says_what_ends_that(size, state, words):
    async def look(app, pilot):
        await pilot.press("f4", "b")
        await settle(pilot)
        return app.station.asked_for(Read), stand_in.text_of(app)

    reads, text = run(look, size=size, state=state)
    assert reads == []
    assert words in text


def test_a_hazard_is_read_only_after_a_question():
    risky = Feature("risky", "Risky level", page=FeaturePage.RECEIVER, read_hazard="It switches the LNB supply.")
    dish = replace(CARRYOUT_G2, features=by_id([risky]))

    async def look(app, pilot):
        answered(app, {"risky": 12.0})
        await pilot.press("f4", "d")
        await settle(pilot)
        before = app.station.asked_for(Read)
        await pilot.press("enter")
        await settle(pilot)
        asked = stand_in.text_of(app)
        await pilot.press("y")
        await settle(pilot)
        return before, asked, app.station.asked_for(Read)

    before, asked, after = run(look, state={"dish": dish})
    assert before == []
    assert "It switches the LNB supply." in asked
    assert after == [Read(("risky",), agreed=True)]


def test_a_dish_that_tells_less_names_the_headings_for_which_no_command_is_known():
    async def look(app, pilot):
        await pilot.press("f4", "d")
        await settle(pilot)
        return stand_in.text_of(app)

    text = run(look, state={"dish": CARRYOUT_2003})
    assert "Not on the Carryout of 2003, as no command is known: Signal, Channel" in text


def test_the_boot_log_is_what_the_station_heard_with_its_age():
    async def look(app, pilot):
        log = BootLog(app.session.clock.utc() - timedelta(seconds=50), ("Bootloader v1.01", "Boot Complete"))
        app.station.state = replace(app.station.state, boot_log=log)
        await pilot.press("f4", "b", "pagedown", "pagedown", "pagedown")
        await settle(pilot)
        await pilot.press("enter")
        await settle(pilot)
        return stand_in.text_of(app)

    text = run(look, size=(120, 36))
    assert "2 lines, 50s ago" in text
    assert "Bootloader v1.01" in text


# On a real station, with a simulated dish


async def on_tab(house, key, seconds=8):
    await house.step(3)
    await press(house, "f4", key)
    await house.step(seconds)


@played
async def test_what_the_dish_tells_stands_there_with_age_and_source(tmp_path):
    house = House()
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await on_tab(house, "b")
        text = house.text()
        assert re.search(r"Driver of the motor.* OK +OK", text)
        assert re.search(r"Antenna ID +12-IN G2", text)


def lines_sent(house, since):
    return [line for at, line in house.device.shell.received if at >= since]


@played
async def test_a_hidden_page_asks_nothing():
    house = House()
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await on_tab(house, "b", 1)
        await press(house, "f2")
        await house.step(6)
        since = house.clock.monotonic()
        await house.step(30)
        assert set(lines_sent(house, since)) <= {"a", ""}


async def settled(house):
    for _ in range(40):
        await house.step(0.2)
        if house.app.system.sheets.is_settled:
            return
    raise AssertionError("it is still reading")


@played
async def test_the_first_visit_costs_little_more_than_its_lines():
    house = House()
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await house.step(3)
        await press(house, "f4", "b")
        await settled(house)
        since = house.clock.monotonic()
        await press(house, "m")
        await settled(house)
        sent = [line for line in lines_sent(house, since) if line not in ("a", "")]
        least = ["l", "v", "p", "pid", "q", "step", "ma", "pid", "q", "mot"]
        assert set(least) <= set(sent)
        assert len(sent) <= 1.2 * len(least), sent


def choose(house, tab, feature):
    """Put the cursor on a feature."""
    pane = house.app.query_one(f"#system-{tab}")
    rows = pane.rows(house.app.view())
    pane.at = next(number for number, row in enumerate(rows) if row.cells[0].id == feature)


async def set_value(house, text):
    from textual.widgets import Input

    await press(house, "e")
    await house.step(0.3)
    house.app.screen.query_one(Input).value = text
    await press(house, "enter")
    await house.step(0.3)


@played
async def test_a_speed_is_set_after_a_question_that_names_old_and_new_and_u_puts_it_back():
    house = House()
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await on_tab(house, "m")
        choose(house, "motors", "speed.azimuth")
        await set_value(house, "20")
        asked = house.text()
        assert re.search(r"64\.99\d* deg/s +→ +20 deg/s", asked)
        await press(house, "y")
        await house.step(3)
        assert house.app.station.state.readings["speed.azimuth"].value == pytest.approx(20.0, abs=0.02)
        assert "u puts back the value from before" in house.text()
        await press(house, "u")
        await house.step(0.3)
        assert re.search(r"19\.99\d* deg/s +→ +64\.99\d* deg/s", house.text())
        await press(house, "y", "u", "u")
        await house.step(3)
        assert house.app.station.state.readings["speed.azimuth"].value == pytest.approx(65.0, abs=0.02)
        await press(house, "escape", "u")
        await house.step(1)
        assert "Nothing was set here that can be put back." in house.text()


@played
async def test_a_value_beyond_its_range_is_refused_in_the_field_and_sends_nothing():
    house = House()
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await on_tab(house, "m")
        choose(house, "motors", "speed.azimuth")
        await set_value(house, "400")
        assert "335 deg/s beyond its limit of 65 deg/s" in " ".join(re.findall(r"[^│\s]+", house.text()))
        assert house.app.station.state.readings["speed.azimuth"].value == pytest.approx(65.0, abs=0.02)


@played
async def test_a_message_on_the_coax_is_explained_before_it_is_sent_and_its_answer_stands_there():
    house = House("g2?seed=1&switch_port=1")
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await on_tab(house, "d")
        choose(house, "receiver", "diseqc")
        await set_value(house, "E0 10 zz")
        assert "is no byte in hex" in " ".join(re.findall(r"[^│\s]+", house.text()))
        await press(house, "escape")
        await set_value(house, "E0 10 38 F4")
        asked = " ".join(re.findall(r"[^│\s]+", house.text()))
        assert "E0 10 38 F4: from the master" in asked
        since = house.clock.monotonic()
        await house.step(1)
        assert not any(line.startswith("send") for line in lines_sent(house, since))
        await press(house, "y")
        await house.step(4)
        assert "send E0 10 38 F4" in lines_sent(house, since)
        assert house.app.system.sheets.now.answers["diseqc"].value


@played
async def test_a_motor_test_asks_first_and_what_it_measured_stands_there_against_nominal(tmp_path):
    journal = tmp_path / "journal.sqlite"
    tests = MotorTests(MotorTestBook(journal))
    house = House(tasks=tests.tasks)
    tests.attach(house.station)
    house.app.system.health._journal, house.app.system.health.beside = journal, lambda work: work()
    async with house.app.run_test(size=(160, 48)) as house.pilot:
        await on_tab(house, "m")
        assert "Not measured yet: t tests speed" in house.text()
        since = house.clock.monotonic()
        await press(house, "t")
        await house.step(0.5)
        assert "Keep the whole swing of the dish clear." in " ".join(re.findall(r"[^│\s]+", house.text()))
        assert house.moves(since) == []
        await press(house, "y")
        for _ in range(40):
            await house.step(2)
            if not house.station.state.tasks and house.moves(since):
                break
        assert tests.book.flush()
        await house.step(12)
        await house.step(1)
        assert re.search(r"Measured azimuth: 6\d\.\d ±\S+ deg/s of 65, .* no stall", house.text())
        assert re.search(r"Measured elevation: 4\d\.\d ±\S+ deg/s of 45", house.text())


def test_a_reading_that_a_person_agreed_to_is_asked_for_once_whatever_comes_of_it():
    risky = Feature("risky", "Risky level", page=FeaturePage.RECEIVER, read_hazard="It switches the LNB supply.")
    dish = replace(CARRYOUT_G2, features=by_id([risky]))

    async def look(app, pilot):
        asked = []

        def submit(request):
            asked.append(request)
            future = Future()
            if isinstance(request, Read):
                future.set_exception(NoReply("The dish is silent."))
            return future

        app.station.submit = submit
        await pilot.press("f4", "d", "enter", "y")
        for _ in range(5):
            app.session.clock.advance(5.0)
            app.paint()
            await settle(pilot)
        return [each for each in asked if isinstance(each, Read) and each.agreed]

    assert run(look, state={"dish": dish}) == [Read(("risky",), agreed=True)]


def test_what_a_question_showed_of_one_dish_is_not_set_on_another():
    async def look(app, pilot):
        await pilot.press("f4", "m")
        await settle(pilot)
        feed = app.system.sheets
        epoch = feed.epoch
        app.station.state = replace(app.station.state, port="/dev/ttyUSB7")
        feed.set(CARRYOUT_G2.features["speed.azimuth"], 20.0, epoch)
        await settle(pilot)
        return app.station.asked_for(Set), stand_in.text_of(app)

    asked, text = run(look, size=(120, 36))
    assert asked == []
    assert "Nothing was set." in text


def test_what_stands_below_the_last_row_can_be_scrolled_to():
    async def look(app, pilot):
        await pilot.press("f4", "m", *["down"] * 60)
        await settle(pilot)
        below = stand_in.text_of(app)
        await pilot.press(*["up"] * 60)
        await settle(pilot)
        return below, stand_in.text_of(app)

    below, top = run(look)
    assert "which move beyond every limit" in " ".join(re.findall(r"[^│\s]+", below))
    assert "▶ State of the motor" in top

"""The console before a line goes out: hazards named, control asked for, failures told."""

from concurrent.futures import Future

import pytest
from birdcage.base.errors import ConfirmationNeeded, Held, LeaseDenied
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import AcquireLease, ReleaseLease, Unwatch, Watch
from birdcage_tui.widgets.dialogs import QuestionScreen
from console_desk import desk
from stand_in import PROTOCOL

HAZARDS = [
    ("root", "q"), ("root", "reboot"), ("root", "stow"), ("os", "reboot"), ("a3981", "reset"), ("adc", "scan"),
    ("dvb", "def"), ("dvb", "lnbdc odu"), ("dvb", "srch"), ("dvb", "e 1 2"), ("eeprom", "ee 1 2"), ("eeprom", "inv 3"),
    ("eeprom", "def"), ("nvs", "e 20 1"), ("nvs", "s"), ("gpio", "w 3 1"), ("mot", "a 0 9999"), ("mot", "g 100 40"),
    ("mot", "h 0"), ("mot", "h *"), ("mot", "e"), ("mot", "r"), ("mot", "w 0 OFF"), ("mot", "sp 0 10"),
    ("mot", "sw 0 1"), ("mot", "vms 0 1 1"), ("mot", "motorboth"), ("mot", "sd"), ("mot", "azscan 1 2 3"),
    ("mot", "azscanwxp 0 10 10 1"), ("mot", "mv 0 10"), ("mot", "ma 0 10"), ("mot", "pid 0 1 2 3"),
    ("step", "v 0 100"), ("step", "p 0 100"), ("peak", "pxy1"), ("peak", "pw"), ("peak", "stb"), ("mot", "frobnicate"),
]  # fmt: skip


UNHOMED = [
    each for each in HAZARDS
    if PROTOCOL.judge(each[1], each[0], homed=True) != PROTOCOL.judge(each[1], each[0], homed=False)
]  # fmt: skip
"""Those that are worse while the dish is not homed."""


@pytest.mark.parametrize(("homed", "hazards"), [(True, HAZARDS), (False, UNHOMED)], ids=["homed", "unhomed"])
def test_each_hazard_names_its_consequence_before_enter_counts(homed, hazards):
    async def warn(at):
        await at.press("i")
        assert len(hazards) >= 5
        for menu, typed in hazards:
            at.app.station.asked.clear()
            at.state(holder=CONSOLE, menu=menu, homed=homed)
            at.line.value = typed
            await at.pilot.pause()
            at.app.paint()
            verdict = at.app.station.judge(typed)
            assert verdict.grade > Grade.HARMLESS, typed
            told = verdict.consequence.removeprefix("Moves ")
            told = told.partition(" birdcage checks no limits")[0] if verdict.limit else told
            assert told in at.words()
            assert verdict.limit in at.words()
            await at.pilot.press("enter")
            assert at.raw() == [], f"the first Enter sends nothing: {typed}"
            if verdict.grade >= Grade.MOVES or verdict.limit:
                assert isinstance(at.app.screen, QuestionScreen)
                assert told in at.words()
                await at.pilot.press("y")
            else:
                assert "Enter again sends it" in at.words()
                await at.pilot.press("enter")
            assert at.raw() == [(typed, verdict.grade)]
            assert at.line.value == ""

    desk(warn, size=(120, 36))


def test_enter_is_no_answer_to_the_question():
    async def enter(at):
        at.state(holder=CONSOLE, menu="mot")
        await at.type("r")
        await at.press("enter", "enter", "enter")
        return at.raw()

    assert desk(enter) == []


def test_a_line_that_is_worse_by_the_time_it_is_confirmed_is_asked_about_anew():
    async def worse(at):
        at.state(holder=CONSOLE, menu="mot", homed=True)
        await at.type("a 0 200")
        await at.press("enter")
        at.state(homed=False)
        await at.press("y")
        sent = at.raw()
        await at.look()
        words = at.words()
        await at.press("y")
        return sent, words, at.raw()

    sent, words, after = desk(worse)
    assert sent == []
    assert "Send a 0 200" in words
    assert "CAN RUIN" in words
    assert after == [("a 0 200", Grade.RUINS)]


def test_what_the_station_sends_back_as_worse_returns_to_the_line_and_is_not_sent_by_itself():
    async def refused(at):
        at.state(holder=CONSOLE, menu="mot")
        failed = Future()
        submit, at.app.stage.sheet._sent._submit = at.app.stage.sheet._sent._submit, lambda request: failed
        await at.type("a")
        await at.press("enter")
        failed.set_exception(ConfirmationNeeded("`a` was not sent. It would do worse now."))
        at.app.stage.sheet._sent._submit = submit
        await at.pilot.pause()
        return await at.look(), at.line.value, at.raw()

    text, value, sent = desk(refused)
    assert "# `a` was not sent. It would do worse now." in text
    assert value == "a"
    assert sent == []


def test_a_change_of_the_text_or_escape_takes_the_first_enter_back():
    async def arm(at):
        at.state(holder=CONSOLE, menu="nvs")
        await at.type("s")
        await at.press("enter", "backspace", "s", "enter")
        assert at.raw() == []
        await at.press("escape")
        await at.look()
        assert "Enter again" not in at.words()
        await at.press("enter")
        assert at.raw() == []
        await at.press("enter")
        assert at.raw() == [("s", Grade.SETTING)]

    desk(arm)


def test_another_menu_takes_the_first_enter_back():
    async def arm(at):
        at.state(holder=CONSOLE, menu="nvs")
        await at.type("s")
        await at.press("enter")
        at.state(menu="mot")
        await at.look()
        await at.press("enter")
        return at.raw()

    assert desk(arm) == []


def test_a_harmless_line_goes_out_at_once():
    async def send(at):
        at.state(holder=CONSOLE, menu="mot")
        await at.type("a")
        await at.press("enter")
        return at.raw(), at.line.value

    assert desk(send) == ([("a", Grade.HARMLESS)], "")


def waiting_answers(at):
    """Have the station take its time: the answers to what the console asks from now on, to be given by the test."""
    answers = []

    def submit(request):
        at.app.station.asked.append(request)
        answers.append(Future())
        return answers[-1]

    at.app.stage.sheet._sent._submit = submit
    return answers


def test_enter_twice_asks_once():
    async def twice(at):
        at.state(menu="mot")
        took = waiting_answers(at)
        await at.type("a 0 200")
        await at.press("enter", "enter")
        for future in took:
            future.set_result(None)
        await at.look()
        depth = len(at.app.screen_stack)
        await at.press("escape")
        return depth, len(at.app.screen_stack), at.raw()

    assert desk(twice) == (2, 1, [])


def test_the_first_enter_takes_control_and_another_holder_is_named_first():
    async def take(at):
        at.state(holder="Gpredict", menu="mot")
        await at.type("a")
        await at.press("enter")
        await at.look()
        assert "Gpredict controls the dish." in at.words()
        assert at.app.station.asked_for(AcquireLease) == []
        await at.press("y")
        return at.app.station.asked_for(AcquireLease)

    assert desk(take) == [AcquireLease(CONSOLE, take_over=True)]


def test_a_line_that_waits_for_control_is_not_sent_once_the_console_is_closed():
    async def close(at):
        at.state(menu="mot")
        waiting = waiting_answers(at)
        await at.type("a")
        await at.press("enter", "f5")
        for future in waiting:
            future.set_result(None)
        await at.look()
        return at.raw(), at.line.value

    assert desk(close) == ([], "a")


def test_raw_console_says_that_polling_pauses_and_how_old_the_position_is():
    async def talk(at):
        at.state(holder=CONSOLE)
        at.clock.advance(12)
        return await at.look()

    text = desk(talk)
    assert "TALK" in text
    assert "polling paused, position 12s old" in text
    assert "NO REPLY" not in text, "nobody asked it anything"


def test_closing_gives_control_back():
    async def close(at):
        at.state(holder=CONSOLE)
        await at.press("f5")
        return at.app.station.asked_for(ReleaseLease)

    assert desk(close) == [ReleaseLease(CONSOLE)]


def test_while_one_types_only_the_position_is_polled_so_that_the_menu_stays():
    def watched(at):
        watches = {}
        for each in at.app.station.asked:
            if isinstance(each, Watch):
                watches[each.watcher] = each.features
            elif isinstance(each, Unwatch):
                del watches[each.watcher]
        return set().union(*watches.values())

    async def watches(at):
        first = watched(at)
        await at.press("i")
        typing = watched(at)
        await at.press("escape")
        return first, typing, watched(at)

    first, typing, after = desk(watches)
    assert typing == {"position"}
    assert "rssi" in first
    assert after == first


@pytest.mark.parametrize("error", [Held("STOP is latched."), LeaseDenied("Gpredict has control.")])
def test_a_line_that_failed_is_told_and_comes_back(error):
    async def fail(at):
        at.state(holder=CONSOLE, menu="mot")
        failed = Future()
        at.app.stage.sheet._sent._submit = lambda request: failed
        await at.type("a")
        await at.press("enter")
        failed.set_exception(error)
        await at.pilot.pause()
        return await at.look(), at.line.value

    text, value = desk(fail)
    assert f"# `a`: {error}" in text
    assert value == "a"


def test_a_line_that_prints_on_says_so_and_enter_ends_it():
    async def stream(at):
        at.state(holder=CONSOLE, menu="dvb")
        await at.type("agc")
        await at.press("enter")
        at.clock.advance(3)
        text = await at.look()
        await at.press("enter")
        return text, at.raw()

    text, raw = desk(stream)
    assert "`agc` running 3 s. Enter ends it." in text
    assert raw == [("agc", Grade.HARMLESS), ("", Grade.HARMLESS)]

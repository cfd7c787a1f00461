"""F5 on a machine that speaks in plain lines: a line terminal, with the same warnings and no prompt made up."""

import re
from datetime import UTC, datetime

import pytest
from birdcage.protocol.hazard import Hazard, HazardTable
from birdcage.protocol.line_raw import LineRaw
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.verdict import Grade
from birdcage.station.menu_commands import MenuCommands
from birdcage.station.raw import CONSOLE
from birdcage_tui.console.frame import PromptCell
from birdcage_tui.console.lines import LinePart, LogLine
from birdcage_tui.console.sorter import Sorter
from console_desk import desk

HAZARDS = HazardTable(
    rows=(
        Hazard(frozenset(), re.compile("az el|")),
        Hazard(frozenset(), re.compile(r"az\d\S*"), Grade.MOVES, "Turns the azimuth at once."),
    ),
    unlisted={"": "Undocumented command."},
)
RAW = LineRaw(lambda: None, HAZARDS, (CommandDoc(None, "AZ", "AZ<deg>", "turns the azimuth"),))


def line_desk(test):
    async def body(at):
        station = at.app.station
        station.has_prompt, station.commands = False, MenuCommands(RAW).of
        station.judge = lambda line: RAW.judge(line, None, homed=None)
        at.state(menu=None)
        await at.look()
        return await test(at)

    return desk(body)


def prompt_of(at):
    return at.app.query_one(PromptCell).words


def test_no_prompt_is_shown_and_none_is_made_up():
    async def look(at):
        at.wire("<", b"AZ180.0 EL45.0\r\n")
        await at.look()
        quiet = prompt_of(at)
        at.wire("<", b"odd>")
        text = await at.look()
        return quiet, prompt_of(at), text

    quiet, after, text = line_desk(look)
    assert quiet == after == ""
    assert "AZ180.0 EL45.0" in text


def test_a_line_that_moves_is_asked_about_and_a_question_goes_out():
    async def send(at):
        at.state(holder=CONSOLE)
        await at.type("AZ EL")
        await at.press("enter")
        harmless = at.raw()
        await at.type("AZ100")
        await at.look()
        hint = at.words()
        await at.press("enter")
        await at.look()
        asked = at.words()
        await at.press("y")
        return harmless, hint, asked, at.raw()[-1]

    harmless, hint, asked, sent = line_desk(send)
    assert harmless == [("AZ EL", Grade.HARMLESS)]
    assert "▲ MOVES: Turns the azimuth at once." in hint
    assert "Send AZ100" in asked
    assert sent == ("AZ100", Grade.MOVES)


def test_a_line_that_moves_is_not_sent_while_held():
    async def held(at):
        at.state(holder=CONSOLE)
        at.latch()
        await at.type("AZ100")
        await at.press("enter")
        await at.look()
        return at.words(), at.raw()

    words, sent = line_desk(held)
    assert "STOP is latched: `AZ100` may move the dish and is not sent." in words
    assert sent == []


def test_tab_completes_from_what_is_documented_and_asks_nothing():
    async def complete(at):
        at.state(holder=CONSOLE)
        asked = len(at.app.station.asked)
        await at.press("i", "tab")
        return at.line.value, at.app.station.asked[asked:]

    value, asked = line_desk(complete)
    assert value.strip() == "AZ"
    assert not [request for request in asked if type(request).__name__ == "ListCommands"]


@pytest.mark.parametrize("end", [b"\n", b"\r", b"\r\n"])
def test_polls_are_polling_whatever_ends_a_line(end):
    now = datetime(2026, 3, 20, 12, tzinfo=UTC)
    talk = ((">", b"AZ EL" + end), ("<", b"AZ1.0 EL2.0" + end), (">", b"AZ100" + end))
    sorter = Sorter(RAW)
    assert [sorter.sort(LogLine(now, *each)).part for each in talk] == [LinePart.POLL, LinePart.POLL, LinePart.PLAIN]

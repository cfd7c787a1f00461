"""Who said a line: what is folded away as polling, and what never is."""

from datetime import UTC, datetime, timedelta

import pytest
from birdcage.protocol.menu_raw import MenuRaw
from birdcage.station.raw import TranscriptEntry
from birdcage_tui.console.lines import LinePart, LogLine
from birdcage_tui.console.scrollback import Scrollback
from birdcage_tui.console.sorter import Sorter
from birdcage_tui.console.tap import WireTap
from birdcage_tui.console.wire_log import WireLog
from console_desk import desk
from stand_in import PROTOCOL

RAW = MenuRaw(PROTOCOL)
START = datetime(2026, 3, 20, 12, tzinfo=UTC)


def sorted_parts(*lines, prompt="MOT>"):
    sorter = Sorter(RAW)
    sorter.sort(LogLine(START, "<", prompt.encode()))
    return [sorter.sort(LogLine(START + timedelta(seconds=second), way, data)).part for second, way, data in lines]


def test_a_poll_and_its_answer_are_polling_and_what_comes_unasked_is_not():
    assert sorted_parts(
        (0, ">", b"a\r"), (0.1, "<", b"a\r\n"), (0.1, "<", b"Angle[0] = 1.00\r\n"), (0.1, "<", b"MOT>"),
        (0.2, "<", b"Stalled.\r\n"),
    ) == [LinePart.POLL] * 4 + [LinePart.PLAIN]  # fmt: skip


def test_a_dish_that_restarts_instead_of_answering_is_seen():
    parts = sorted_parts((0, ">", b"a\r"), (0.1, "<", b"a\r\n"), (2.5, "<", b"Bootloader V1\r\n"))
    assert parts == [LinePart.POLL, LinePart.POLL, LinePart.PLAIN]


def test_what_birdcage_does_to_the_dish_is_never_folded():
    for data in (b"a 0 120\r", b"h 0\r", b"r\r", b"\ra 1 30\r", b"e\r"):
        assert sorted_parts((0, ">", data)) == [LinePart.PLAIN], data
    assert sorted_parts((0, ">", b"d 20\r"), prompt="who knows>") == [LinePart.PLAIN]


def test_a_typed_line_is_yours_its_echo_an_echo_and_its_mark_a_mark():
    assert sorted_parts(
        (0, "#", b"raw by console: a (HARMLESS)"), (0, ">", b"a\r"), (0, "<", b"a\r\n"),
        (0, "<", b"Angle[0] = 1.00\r\n"),
    ) == [LinePart.MARK, LinePart.YOURS, LinePart.ECHO, LinePart.PLAIN]  # fmt: skip
    moved = sorted_parts((0, "#", b"raw by console: a 0 9999 (MOVES, confirmed; Beyond.)"), (0, ">", b"a 0 9999\r"))
    assert moved == [LinePart.WARNING, LinePart.YOURS]


def test_an_echo_that_came_back_otherwise_is_seen():
    parts = sorted_parts((0, "#", b"raw by console: mv (HARMLESS)"), (0, ">", b"mv\r"), (0, "<", b"mw\r\n"))
    assert parts[-1] is LinePart.PLAIN


def test_a_fold_outlives_the_cutting_of_old_lines():
    back = Scrollback(kept=50)
    for _ in range(40):
        back.add([LogLine(START, "<", b"x", LinePart.POLL)] * 100)
    assert [row.text for row in back.rows] == ["4000 lines of polling, p shows all"]
    back.add([LogLine(START, "<", b"end")])
    assert [row.text for row in back.rows][1:] == ["end"]


STEP = (b"a 0 123.13\r", b"a 0 123.13\r\n", b"Angle = 123.13\r\n", b"MOT>")


def steps_of(*lines):
    """Parts of lines of which those that go out are a pursuit's."""
    sorter = Sorter(RAW)
    sorter.sort(LogLine(START, "<", b"MOT>"))
    return [sorter.sort(LogLine(START, way, data), step=way == ">").part for way, data in lines]


def test_a_step_of_a_pursuit_folds_with_its_answer_and_whatever_else_the_dish_says_is_seen():
    taken = [(">", STEP[0]), *(("<", line) for line in STEP[1:])]
    assert steps_of(*taken) == [LinePart.STEP] * 4
    assert steps_of(*taken[:2], ("<", b"Motor 0 stalled at 123.13\r\n")) == [LinePart.STEP] * 2 + [LinePart.PLAIN]
    assert steps_of(*taken, ("<", b"Angle = 9\r\n")) == [LinePart.STEP] * 4 + [LinePart.PLAIN], "nobody has asked"


def test_the_steps_of_a_pursuit_are_one_row_and_stop_and_what_you_move_are_not():
    async def see(at):
        at.app.station.steering = True
        at.wire("<", b"MOT>")
        await at.look()
        for _ in range(20):
            at.wire(">", STEP[0])
            at.wire("<", *STEP[1:])
        steps = await at.look()
        await at.press("p")
        shown = await at.look()
        await at.press("p", "c")
        at.wire(">", STEP[0])
        at.latch()
        at.wire(">", b"a 0 124.00\r")
        at.wire("<", b"a 0 124.00\r\n", b"Angle = 124.00\r\n", b"MOT>")
        return steps, shown, await at.look()

    steps, shown, stopped = desk(see)
    assert "+ 80 lines of tracking and polling, p shows all" in steps
    assert "a 0 123.13" not in steps
    assert "> a 0 123.13   by birdcage" in shown
    assert "a 0 124.00" in stopped, "STOP retargets too, and is never folded"


def test_polling_is_one_row_until_p_shows_every_byte_and_counts_as_nothing_new():
    async def see(at):
        at.wire("<", b"MOT>")
        await at.look()
        for _ in range(20):
            at.wire(">", b"a\r")
            at.wire("<", b"a\r\n", b"Angle[0] = 1.00\r\n", b"MOT>")
        folded = await at.look()
        await at.press("p")
        shown = await at.look()
        await at.press("p", "c")
        at.wire("#", b"raw by console: mv (HARMLESS)")
        at.wire(">", b"mv\r")
        at.wire("<", b"mv\r\n", b"Max\r\n")
        return folded, shown, await at.look()

    folded, shown, typed = desk(see)
    assert "+ 80 lines of polling, p shows all" in folded
    assert "Angle" not in folded
    assert "> a" in shown
    assert "< Angle[0] = 1.00" in shown
    assert "> mv" in typed
    assert "< mv" not in typed
    assert "HARMLESS" not in typed
    assert "< Max" in typed


def test_how_a_machine_says_where_it_goes_is_its_own_to_tell():
    class Going(MenuRaw):
        def says_target(self, text):
            return text == "going"

    sorter = Sorter(Going(PROTOCOL))
    lines = ((">", b"a 0 1.00\r"), ("<", b"a 0 1.00\r\n"), ("<", b"going\r\n"), ("<", b"Angle = 1.00\r\n"))
    sorter.sort(LogLine(START, "<", b"MOT>"))
    parts = [sorter.sort(LogLine(START, way, data), step=way == ">").part for way, data in lines]
    assert parts == [LinePart.STEP] * 3 + [LinePart.PLAIN]


class Ready(MenuRaw):
    """A machine with a prompt of another shape."""

    def is_prompt(self, text):
        return text.strip() == "READY:"


def heard(raw, *chunks):
    """Return the prompt that F5 shows, and what the answer to a poll is taken for, as it comes in pieces."""
    tap = WireTap(lambda: False, lambda _take: lambda: None)
    log = WireLog(tap, raw)
    lines = []
    for way, data in chunks:
        tap.take_in(TranscriptEntry(START, way, data))
        lines += log.take(START)
    return log.prompt, [(line.text, line.part) for line in lines if line.direction == "<"]


def test_an_angle_bracket_at_the_end_of_a_piece_is_no_prompt():
    prompt, lines = heard(
        RAW, ("<", b"MOT>"), (">", b"?\r"), ("<", b"?\r\ng <az> <el>"), ("<", b"\r\nq\r\n"), ("<", b"MOT>")
    )
    assert prompt == "MOT>"
    assert [text for text, _part in lines] == ["MOT>", "?", "g <az> <el>", "q", "MOT>"]
    assert {part for _text, part in lines[1:]} == {LinePart.POLL}


@pytest.mark.parametrize(("raw", "shown"), [(Ready(PROTOCOL), "READY:"), (RAW, ">"), (RAW, "MOT> ")])
def test_what_a_prompt_is_the_machine_tells(raw, shown):
    prompt, _lines = heard(raw, (">", b"\r"), ("<", b"\r\n" + shown.encode()))
    assert prompt == shown

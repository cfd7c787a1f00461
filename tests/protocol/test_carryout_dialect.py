"""What is sent to a Carryout of 2003, what its answers mean, and what raw lines may do."""

from __future__ import annotations

import math

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused
from birdcage.console.session import Console
from birdcage.link.link import Link
from birdcage.protocol.carryout.commands import COMMANDS
from birdcage.protocol.carryout.dialect import BAUD, DIALECT, NVS, TARGET
from birdcage.protocol.carryout.going import GotoAnswer, ceiling_of, go_line, judge_go, refusal_of
from birdcage.protocol.carryout.hazards import HAZARDS
from birdcage.protocol.carryout.records import LiveRecord, RecordReader
from birdcage.protocol.hal import HAL205Protocol
from birdcage.rotator.verdict import Grade
from birdcage.sim.port import SimPort, open_device


class Session:
    """A console at a simulated dish, at the rate of the dialect."""

    def __init__(self, options: str) -> None:
        self.clock = VirtualClock()
        self.device = open_device(f"carryout?{options}", clock=self.clock)
        self.unasked: list[str] = []
        port = SimPort(self.device, "sim:carryout", baud=BAUD)
        self.console = Console(Link(port, self.clock), self.clock, DIALECT, on_line=self.unasked.append)

    def go(self, az_deg: float, el_deg: float) -> tuple[str, ...]:
        return self.console.run(TARGET, go_line(az_deg, el_deg), takes_s=30.0).lines

    def rest(self) -> None:
        until = self.clock.monotonic() + 30.0
        while self.console.listen(until):
            pass


KNOBS = ["", "prompts=alike", "prompt_when=at_once", "prompts=alike&prompt_when=at_once", "second_move=block",
         "second_move=abort", "second_move=queue", "second_move=refuse", "record_end=cr", "records=key", "root_q=kill",
         "root_q=ignore&prompts=alike", "motor_help=a,g", "line_end=lf", "g_axes=turn"]  # fmt: skip


@pytest.mark.parametrize("options", KNOBS)
def test_a_go_to_arrives_whatever_the_console_is_like(options):
    dish = Session(options)
    lines = dish.go(200.0, 50.0)
    dish.rest()
    answer, last = judge_go((*lines, *dish.unasked))
    assert (answer, last) == (GotoAnswer.MOVING, LiveRecord(200.0, 50.0))
    truth = dish.device.truth()
    assert (truth.az_deg, truth.el_deg, truth.shell_alive) == (200.0, 50.0, True)


@pytest.mark.parametrize("options", KNOBS)
def test_its_ceiling_is_read_and_the_way_there_ends_no_shell(options):
    dish = Session(options)
    dish.go(190.0, 45.0)
    dish.rest()
    assert ceiling_of(dish.console.run(NVS, "e 102").lines) == 73.0
    assert dish.device.truth().shell_alive


def test_a_refusal_in_words_that_are_known_is_one():
    dish = Session("")
    with pytest.raises(CommandRefused) as refused:
        dish.go(180.0, 80.0)
    assert refused.value.reason == "bad_parameter"


@pytest.mark.parametrize("text", ["", "NO GO", "lim"])
def test_a_refusal_in_other_words_is_never_taken_for_a_motion(text):
    dish = Session(f"refusal_text={text}")
    assert judge_go(dish.go(180.0, 80.0)) == (GotoAnswer.NOTHING, None)


def test_what_the_lines_of_an_answer_tell():
    moving = "az = 17000   el = 4000"
    assert judge_go([]) == (GotoAnswer.NOTHING, None)
    assert judge_go(["hello", moving, "az = 17500   el = 4100"]) == (GotoAnswer.MOVING, LiveRecord(175.0, 41.0))
    assert judge_go([moving, "Motors busy."]) == (GotoAnswer.REFUSED, LiveRecord(170.0, 40.0))
    assert refusal_of("Target out of range.") == "bad_parameter"
    assert refusal_of("Unknown command") == "unknown_command"
    assert refusal_of("Not calibrated.") == "failed"
    assert refusal_of(moving) is None


@pytest.mark.parametrize(("az_deg", "el_deg", "line"), [
    (180.0, 45.0, "g 180.00 45.00"), (0, 22, "g 0.00 22.00"), (359.994, 89.999, "g 359.99 90.00"),
])  # fmt: skip
def test_the_line_of_a_go_to(az_deg, el_deg, line):
    assert go_line(az_deg, el_deg) == line


@pytest.mark.parametrize("place", [(-0.1, 45.0), (360.1, 45.0), (180.0, 21.9), (180.0, 90.1), (math.nan, 45.0),
                                   (180.0, math.nan), (math.inf, 45.0)])  # fmt: skip
def test_no_line_for_what_no_source_tells(place):
    with pytest.raises(ValueError, match="0 to 360, 22 to 90"):
        go_line(*place)


@pytest.mark.parametrize(("line", "ceiling"), [
    ("102) Maximum EL    73.00", 73.0), ("102 = 90", 90.0), ("nvs 102: 66", 66.0), ("73", 73.0),
    ("102)", None), ("102) Maximum EL 7300", None), ("102) 21", None), ("Invalid parameter. 80", None), ("", None),
    ("az = 18000   el = 4500", None),
])  # fmt: skip
def test_the_ceiling_as_a_row_may_be_printed(line, ceiling):
    assert ceiling_of([line]) == ceiling


@pytest.mark.parametrize(("menu", "line", "grade", "words"), [
    ("target", "", Grade.HARMLESS, ""),
    ("target", "q", Grade.HARMLESS, ""),
    ("root", "target", Grade.HARMLESS, ""),
    ("nvs", "e 102", Grade.HARMLESS, ""),
    ("target", "g 180 45", Grade.MOVES, "No command is known to stop them"),
    ("target", "g", Grade.MOVES, "missing angle"),
    (None, "g 180 45", Grade.MOVES, "birdcage checks no limits"),
    ("motor", "a 0 10", Grade.MOVES, "moves the motors by hand"),
    ("motor", "?", Grade.HARMLESS, ""),
    ("os", "kill Search", Grade.SETTING, "Its shell may be one of them"),
    ("nvs", "e 102 90", Grade.SETTING, "greatest elevation"),
    ("nvs", "e 20 1", Grade.SETTING, "disables tracking"),
    ("nvs", "s", Grade.SETTING, "flash"),
    ("dvb", "rssi 10", Grade.SETTING, "Undocumented"),
    ("root", "q", Grade.RUINS, "power cycle"),
    ("root", "quit", Grade.RUINS, "A byte lost"),
])  # fmt: skip
def test_what_raw_lines_may_do(menu, line, grade, words):
    verdict, _ = HAZARDS.judge(line, menu, homed=True)
    assert verdict.grade is grade
    assert words in verdict.consequence


def test_a_raw_go_to_tells_where_it_would_go():
    _, match = HAZARDS.judge("G 180  45.5", "target", homed=True)
    assert match is not None
    assert (match["az"], match["el"]) == ("180", "45.5")


def test_every_listed_command_is_in_a_menu_and_judged():
    assert {each.menu for each in COMMANDS} == set(DIALECT.prompts)
    for each in COMMANDS:
        if not each.usage.endswith((">", "]")):
            assert HAZARDS.judge(each.usage, each.menu, homed=True)[0].listed, each


def test_its_root_is_told_from_that_of_a_travler():
    listed = {"target", "motor", "dvb", "os", "nvs", "q"}
    assert DIALECT.root_marks <= listed
    assert not HAL205Protocol.dialect.root_marks <= listed
    assert not DIALECT.root_marks <= {"motor", "ngsearch", "nvs", "reboot", "stow", "q"}


def test_records_reach_the_reader_whether_asked_or_not():
    for options in ("", "prompt_when=at_once"):
        dish = Session(options)
        lines = dish.go(210.0, 45.0)
        dish.rest()
        reader = RecordReader()
        records = [each for line in (*lines, *dish.unasked) for each in reader.feed_line(line)]
        assert [each.az_deg for each in records] == sorted(each.az_deg for each in records)
        assert len(records) > 5

"""What raw lines do: every hazard warns with its consequence, and what is not listed says so."""

from __future__ import annotations

import pytest
from birdcage.base.reason import Reason
from birdcage.protocol.command_list import parse_help
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.rotator.values import Position
from birdcage.rotator.verdict import Grade

from .judged import Judged

SETTING, MOVES, RUINS = Grade.SETTING, Grade.MOVES, Grade.RUINS
DANGERS = [
    ("root", "q", RUINS, "until a power cycle"),
    ("root", "reboot", MOVES, "TV search"),
    ("os", "reboot", MOVES, "TV search"),
    ("root", "stow", RUINS, "crushed"),
    ("dvb", "def", SETTING, "factory"),
    ("eeprom", "def", RUINS, "lost"),
    ("eeprom", "inv 3", RUINS, "lost for good"),
    ("eeprom", "ee 3 7", RUINS, "lost for good"),
    ("nvs", "e 20 1", SETTING, "TV search"),
    ("nvs", "e 102 70", SETTING, "stops"),
    ("nvs", "e 83 1", SETTING, "permanent"),
    ("nvs", "s", SETTING, "flash"),
    ("adc", "scan 0 10", MOVES, "Sweeps"),
    ("mot", "h 0", MOVES, "Only cutting the power stops"),
    ("mot", "h *", MOVES, "Only cutting the power stops"),
    ("mot", "w 0 OFF", RUINS, "cable"),
    ("mot", "sp 0 100", RUINS, "wrong"),
    ("mot", "sw 0 0", RUINS, "cable"),
    ("mot", "vms 0 20 500", MOVES, "limits"),
    ("step", "v 0 1000", RUINS, "without end"),
    ("step", "p 0 20000", MOVES, "limits"),
    ("mot", "e", MOVES, "jerk"),
    ("step", "e", MOVES, "jerk"),
    ("mot", "r", MOVES, "fall"),
    ("step", "r", MOVES, "fall"),
    ("mot", "motorboth", MOVES, "both motors"),
    ("mot", "sd 0 1 500", MOVES, "stalls"),
    ("mot", "azscan 90 5 10", MOVES, "Sweeps"),
    ("mot", "azscanwxp 0 10 100 3", MOVES, "Sweeps"),
    ("peak", "pxy1", MOVES, "moves the dish"),
    ("peak", "pw", MOVES, "moves the dish"),
    ("dvb", "srch", MOVES, "TV search"),
    ("mot", "mv 0 90", SETTING, "loses steps"),
    ("mot", "ma 0 900", SETTING, "loses steps"),
    ("mot", "pid 0 1 2 3", SETTING, "loses steps"),
    ("step", "mv 0 9000", SETTING, "loses steps"),
    ("step", "ma 0 90", SETTING, "loses steps"),
    ("step", "pid 0 1 2", SETTING, "loses steps"),
    ("gpio", "w B0 1", RUINS, "destroy"),
    ("dvb", "lnbdc odu", SETTING, "LNB"),
    ("peak", "stb", SETTING, "LNB"),
    ("a3981", "reset", SETTING, "fault flags"),
    ("mot", "g 100 40", MOVES, "both axes"),
    ("mot", "a 0 100", MOVES, "an axis"),
]
HARMLESS = {
    "root": ("", "?", "help", "mot", "dvb", "nvs", "a3981", "help mot"),
    "mot": ("a", "p", "l", "life", "motorlife", "mv", "ma", "pid", "v", "elminmaxhome", "ela2s 45", "els2a 900", "q"),
    "nvs": ("d", "d 20", "e 20", "q", "?"),
    "dvb": ("rssi 10", "agc", "snr", "nid", "lnbv", "config", "dis", "freqs", "qls", "man", "di2stat", "pretx"),
    "adc": ("rssi", "m", "bdid"),
    "os": ("id",),
    "gpio": ("dir B0", "r B0", "regs"),
    "step": ("mv", "ma", "pid", "q"),
    "eeprom": ("ee 3",),
    "peak": ("ts",),
    "dipswitch": ("dipswitch",),
}


@pytest.fixture
def dish():
    return Judged(CarryoutG2Protocol(), Position(100.0, 40.0))


@pytest.mark.parametrize(("menu", "line", "grade", "word"), DANGERS)
def test_a_hazard_warns_with_its_consequence(dish, menu, line, grade, word):
    verdict = dish.judge(line, menu, homed=True)
    assert verdict.grade is grade
    assert word in verdict.consequence
    assert verdict.consequence.endswith(".")
    assert verdict.listed


@pytest.mark.parametrize(("menu", "line", "grade", "word"), DANGERS)
def test_typed_otherwise_it_is_the_same_line(dish, menu, line, grade, word):
    typed = f"  {line.upper().replace(' ', '   ')} "
    assert dish.judge(typed, menu, homed=True) == dish.judge(line, menu, homed=True)


@pytest.mark.parametrize(("menu", "line", "grade", "word"), DANGERS)
def test_in_an_unknown_menu_the_worst_counts(dish, menu, line, grade, word):
    assert dish.judge(line, None, homed=True).grade >= grade


@pytest.mark.parametrize(("menu", "line"), [(menu, line) for menu, lines in HARMLESS.items() for line in lines])
def test_questions_are_harmless(dish, menu, line):
    verdict = dish.judge(line, menu, homed=None)
    assert verdict.grade is Grade.HARMLESS
    assert verdict.consequence == ""
    assert not verdict.forgets


@pytest.mark.parametrize("homed", [False, None])
@pytest.mark.parametrize(
    ("menu", "line"),
    [("adc", "scan"), ("adc", "scan 0 10"), ("mot", "a 0 100"), ("mot", "a 1 +5"), ("mot", "g 1 2"), ("mot", "azscan"),
     ("mot", "azscanwxp 0 10 100 3"), ("mot", "motorboth"), ("step", "p 0 100")],
)  # fmt: skip
def test_without_a_reference_a_motion_may_deadlock_the_shell(dish, menu, line, homed):
    verdict = dish.judge(line, menu, homed=homed)
    assert verdict.grade is RUINS
    assert "2147483647" in verdict.consequence
    assert "power cycle" in verdict.consequence


def test_what_nobody_listed_changes_a_setting_and_says_so(dish):
    verdict = dish.judge("frobnicate 3", "mot", homed=True)
    assert verdict.grade is SETTING
    assert not verdict.listed
    assert "Undocumented" in verdict.consequence
    assert "next setting" in dish.judge("x", "nvs", homed=True).consequence


def test_a_q_is_harmless_in_a_submenu_only(dish):
    assert dish.judge("q", "mot", homed=True).grade is Grade.HARMLESS
    assert dish.judge("Q", None, homed=True).grade is RUINS
    assert dish.judge("freqs", "root", homed=True).grade is RUINS  # a `q` is what remains of it on a bad line


def test_what_a_line_makes_the_station_forget(dish):
    assert dish.judge("a 1 50", "mot", homed=True).forgets == {"position"}
    assert dish.judge("a 0 50", "mot", homed=True).forgets == {"position", "turn"}
    assert dish.judge("r", "mot", homed=True).forgets == {"position", "turn", "homed"}
    assert {"limits", "search"} <= dish.judge("e 20 1", "nvs", homed=True).forgets
    assert {"homed", "limits", "search"} <= dish.judge("reboot", "root", homed=True).forgets
    assert "search" in dish.judge("srch", "dvb", homed=True).forgets


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("a 0 9999", ("9639.00°", "360.00°")),
        ("a 1 70", ("5.00° above", "65.00°")),
        ("a 1 10.5", ("7.50° below", "18.00°")),
        ("a 1 +30", ("5.00° above", "65.00°")),
        ("a 1 -30", ("8.00° below", "18.00°")),
        ("a 0 +900", ("+900.00°", "446.66°")),
        ("g 400 40", ("40.00°", "360.00°")),
        ("g 100 80", ("15.00° above", "65.00°")),
        ("a 0 nan", ("not an angle",)),
        ("a 0 north", ("`north` is not an angle",)),
        ("a 0 +north", ("`+north` is not an angle",)),
        ("g 100 up", ("`up` is not an angle",)),
    ],
)
@pytest.mark.parametrize("homed", [True, None])
def test_a_motion_says_which_limit_and_by_how_much(dish, line, words, homed):
    limit = dish.judge(line, "mot", homed=homed).limit
    assert all(word in limit for word in words), limit
    assert "Nothing was sent" not in limit


@pytest.mark.parametrize("line", ["a 0 200", "a 1 30", "a 1 +5", "a 0 -20", "g 200 30", "a 0 359.99"])
def test_within_the_limits_nothing_is_said_of_them(dish, line):
    assert dish.judge(line, "mot", homed=True).limit == ""


def test_the_limit_is_told_where_the_position_is_unknown(dish):
    dish.gate.forget(Reason.RAW_COMMAND)
    assert "9639.00°" in dish.judge("a 0 9999", "mot", homed=True).limit
    assert "5.00° above" in dish.judge("a 1 70", "mot", homed=True).limit
    assert dish.judge("a 0 100", "mot", homed=True).limit == ""


def test_a_counted_cable_is_a_limit_too(dish):
    dish.gate.see(Position(10.0, 40.0))
    dish.gate.count_cable()
    assert "16.67° beyond its stop at +23.33°" in dish.judge("a 0 +30", "mot", homed=True).limit
    assert dish.judge("a 0 +10", "mot", homed=True).limit == ""


def test_a_no_go_sector_is_a_limit_too(dish):
    from birdcage.base.no_go import NoGoSector

    dish.gate.update(sectors=(NoGoSector(150.0, 160.0, 50.0),))
    assert "no-go sector" in dish.judge("a 0 155", "mot", homed=True).limit


def test_the_target_is_read_off_where_it_stands_there(dish):
    assert dish.judge("a 0 200.5", "mot", homed=True).aim.single == (0, 200.5)
    assert dish.judge("A 1  30", "mot", homed=True).aim.single == (1, 30.0)
    assert dish.judge("a 1 +5", "mot", homed=True).aim.single is None
    assert dish.judge("g 100 40", "mot", homed=True).aim.single is None
    assert dish.judge("a", "mot", homed=True).aim is None


def test_alignment_does_not_shift_what_was_typed_in_the_dish_own_degrees(dish):
    dish.gate.update(az_offset_deg=30.0, el_offset_deg=2.0)
    assert "Elevation 70.00°" in dish.judge("a 1 70", "mot", homed=True).limit


def test_patience(dish):
    assert dish.judge("rssi 100", "dvb", homed=True).takes_s == pytest.approx(10.0)
    assert dish.judge("h 0", "mot", homed=True).takes_s >= 15.0
    assert dish.judge("agc", "dvb", homed=True).streams
    assert dish.judge("h *", "mot", homed=True).homes == (0, 1)


def test_every_documented_command_is_known_to_the_table():
    dish = CarryoutG2Protocol()
    unknown = [c for c in dish.commands if not dish.judge(c.name, c.menu, homed=True).listed]
    # Their bare form is documented nowhere: each needs arguments.
    needy = "dvb e, dvb rssi, eeprom ee, gpio dir, gpio r, latlon l, mot ela2s, mot els2a"
    assert ", ".join(sorted(f"{c.menu} {c.name}" for c in unknown)) == needy


@pytest.mark.parametrize(
    ("line", "name", "usage", "text"),
    [
        ("Enter <dvb> - DVB Tuner", "dvb", "dvb", "DVB Tuner"),
        ("help [<command>]", "help", "help [<command>]", ""),
        ("a [<motor> <angle>]", "a", "a [<motor> <angle>]", ""),
        ("reboot", "reboot", "reboot", ""),
        ("?", "?", "?", ""),
        ("agc - reads the AGC", "agc", "agc", "reads the AGC"),
        ("pid [motor] [Kp] [Kv]   gains", "pid", "pid [motor] [Kp] [Kv]", "gains"),
    ],
)
def test_help_is_read_leniently(line, name, usage, text):
    (command,) = parse_help("mot", [line])
    assert (command.name, command.usage, command.help) == (name, usage, text)


def test_lines_that_are_no_commands_are_passed_over():
    assert parse_help("mot", ["*** Motor ***", "---", ""]) == ()

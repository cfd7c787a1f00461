"""Each command that a dish does, byte for byte, in the default form and the extended one."""

from __future__ import annotations

import pytest
from birdcage.rotctld.rotor import Advertised, MoveDirection
from birdcage.rotctld.rprt import Rprt

from .scripted_rotor import ScriptedRotor, done, talk

UP, DOWN, LEFT, RIGHT = MoveDirection.UP, MoveDirection.DOWN, MoveDirection.LEFT, MoveDirection.RIGHT
STATE = b"""1
2
min_az=-180.000000
max_az=450.000000
min_el=0.000000
max_el=90.000000
south_zero=0
rot_type=AzEl
done
"""
EXTENDED_STATE = b"""dump_state:
rotctld Protocol Ver: 1
Rotor Model: 2
Minimum Azimuth: -180.000000
Maximum Azimuth: 450.000000
Minimum Elevation: 0.000000
Maximum Elevation: 90.000000
South Zero: 0
rot_type=AzEl
done
RPRT 0
"""


@pytest.mark.parametrize(("said", "reply"), [
    (b"p", b"123.46\n45.68\n"),
    (b"\\get_pos", b"123.46\n45.68\n"),
    (b"+p", b"get_pos:\nAzimuth: 123.46\nElevation: 45.68\nRPRT 0\n"),
    (b"+\\get_pos", b"get_pos:\nAzimuth: 123.46\nElevation: 45.68\nRPRT 0\n"),
    (b";p", b"get_pos:;Azimuth: 123.46;Elevation: 45.68;RPRT 0\n"),
    (b"|p", b"get_pos:|Azimuth: 123.46|Elevation: 45.68|RPRT 0\n"),
    (b",p", b"get_pos:,Azimuth: 123.46,Elevation: 45.68,RPRT 0\n"),
    (b":p", b"get_pos::Azimuth: 123.46:Elevation: 45.68:RPRT 0\n"),
    (b"?p", b"get_pos:?Azimuth: 123.46?Elevation: 45.68?RPRT 0\n"),
    (b"P 10 20", b"RPRT 0\n"),
    (b"\\set_pos 10 20", b"RPRT 0\n"),
    (b"+P 10 20", b"set_pos: 10 20\nRPRT 0\n"),
    (b"|P 135 22.5", b"set_pos: 135 22.5|RPRT 0\n"),
    (b"K", b"RPRT 0\n"), (b"\\park", b"RPRT 0\n"), (b"+K", b"park:\nRPRT 0\n"),
    (b"S", b"RPRT 0\n"), (b"\\stop", b"RPRT 0\n"), (b"+S", b"stop:\nRPRT 0\n"), (b";S", b"stop:;RPRT 0\n"),
    (b"M 8 50", b"RPRT 0\n"), (b"\\move 8 50", b"RPRT 0\n"), (b"+M 8 100", b"move: 8 100\nRPRT 0\n"),
    (b"+M UP 50", b"move: UP 50\nRPRT 0\n"),
    (b"_", b"Winegard Trav'ler RS-485 Rotor\n"),
    (b"\\get_info", b"Winegard Trav'ler RS-485 Rotor\n"),
    (b"+_", b"get_info:\nInfo: Winegard Trav'ler RS-485 Rotor\nRPRT 0\n"),
    (b"s", b"\n"), (b"\\get_status", b"\n"), (b"+s", b"get_status:\nStatus flags: \nRPRT 0\n"),
    (b";s", b"get_status:;Status flags: ;RPRT 0\n"),
    (b"\\dump_state", STATE), (b"+\\dump_state", EXTENDED_STATE),
    (b";\\dump_state", EXTENDED_STATE.replace(b"\n", b";")[:-1] + b"\n"),
    (b"\\reset 1", b"RPRT -11\n"), (b"+\\reset 1", b"reset: 1\nRPRT -11\n"),
    (b"\\pause 3", b"RPRT 0\n"), (b"+\\pause 0", b"pause: 0\nRPRT 0\n"), (b"\\pause -1", b"RPRT -1\n"),
    (b"w AZ", b"RPRT 0\n"), (b"+w AZ", b"send_cmd: AZ\nRPRT 0\n"),
])  # fmt: skip
def test_a_command_and_its_reply(said, reply):
    assert talk(said + b"\n") == [reply]


@pytest.mark.parametrize(("where", "told"), [
    ((0.0, 0.0), b"0.00\n0.00\n"), ((-0.0, -0.0), b"0.00\n0.00\n"), ((359.996, -0.004), b"0.00\n0.00\n"),
    ((359.994, 90.0), b"359.99\n90.00\n"), ((360.0, -1.5), b"0.00\n-1.50\n"), ((-0.001, 18.0), b"0.00\n18.00\n"),
    ((-10.0, 0.005), b"350.00\n0.01\n"), ((400.25, 5), b"40.25\n5.00\n"),
])  # fmt: skip
def test_a_position_is_from_0_to_359_99_and_no_zero_has_a_sign(where, told):
    rotor = ScriptedRotor()
    rotor.where = where
    assert talk(b"p\n", rotor) == [told]


@pytest.mark.parametrize(("said", "wish"), [
    ("P 10 20", (10, 20)), ("P 123.456787 45.678001", (123.456787, 45.678001)), ("P -10.5 +20", (-10.5, 20)),
    ("P 900 -5", (900, -5)), ("P 169.90 156.92", (169.9, 156.92)), ("P 1e2 1e1", (100, 10)), ("P .5 5.", (0.5, 5)),
    ("P10 20", (10, 20)), ("P-10 20", (-10, 20)), ("set_pos 10 20", (10, 20)), ("P\t10  20 ", (10, 20)),
    ("P 148,17 55,06", (148.17, 55.06)), ("P 148,17 55", (148.17, 55)), ("P 10.5,20.5", (10.5, 20.5)),
    ("P -10.5,20.5", (-10.5, 20.5)), ("P 148, 55", (148, 55)),
])  # fmt: skip
def test_a_wish_reaches_the_dish_as_it_was_said(said, wish):
    rotor = ScriptedRotor()
    assert talk(f"{said}\n".encode(), rotor) == [b"RPRT 0\n"]
    assert rotor.calls == [("set_position", *wish)]


@pytest.mark.parametrize("said", [
    "P nan 10", "P 10 nan", "P inf 10", "P 10 -inf", "P 1e999 10", "P abc 10", "P 10 abc", "P 0x10 20", "P 10", "P",
    "P 10,20", "P 10,20,30 5", "P 1.234,56 10", "P 1.234,56", "P 10;20", "P 1_0 20", "P 10 20x", "P 10 -",
    "M 3 50", "M 8 0", "M 8 101", "M 8 -2", "M 8 50.5", "M 10 10", "M 0 10", "M SIDEWAYS 10", "M 8", "M", "M 512 10",
    "w #", "w", "\\pause", "\\pause 1.5", "\\reset", "\\reset x",
])  # fmt: skip
def test_a_wrong_argument_is_einval_and_nothing_is_done(said):
    rotor = ScriptedRotor()
    assert talk(f"{said}\n".encode(), rotor) == [b"RPRT -1\n"]
    assert rotor.calls == []


def test_an_error_in_the_extended_form_has_its_header():
    assert talk(b"+P abc 10\n") == [b"set_pos: abc 10\nRPRT -1\n"]
    assert talk(b"|P 10\n") == [b"set_pos: 10|RPRT -1\n"]
    assert talk(b"+M 8 101\n") == [b"move: 8 101\nRPRT -1\n"]


@pytest.mark.parametrize(("code", "reply"), [
    (Rprt.EIO, b"RPRT -6\n"), (Rprt.ETIMEOUT, b"RPRT -5\n"), (Rprt.ERJCTED, b"RPRT -9\n"),
    (Rprt.ENAVAIL, b"RPRT -11\n"),
])  # fmt: skip
@pytest.mark.parametrize(("said", "asked", "header"), [
    (b"p\n", "position", b"get_pos:"), (b"P 1 2\n", "set_position", b"set_pos: 1 2"), (b"S\n", "stop", b"stop:"),
    (b"K\n", "park", b"park:"), (b"M 2 5\n", "move", b"move: 2 5"), (b"s\n", "status", b"get_status:"),
    (b"w AZ\n", "send", b"send_cmd: AZ"),
])  # fmt: skip
def test_what_the_dish_refuses_is_its_code_in_one_line(code, reply, said, asked, header):
    rotor = ScriptedRotor()
    rotor.refuses = {asked: code}
    assert talk(said, rotor) == [reply]
    assert talk(b"+" + said, rotor) == [header + b"\n" + reply]


@pytest.mark.parametrize(("word", "direction"), [
    ("2", UP), ("4", DOWN), ("8", LEFT), ("16", RIGHT), ("32", UP | LEFT), ("64", UP | RIGHT), ("128", DOWN | LEFT),
    ("256", DOWN | RIGHT), ("UP", UP), ("DOWN", DOWN), ("LEFT", LEFT), ("CCW", LEFT), ("RIGHT", RIGHT), ("CW", RIGHT),
    ("UP_LEFT", UP | LEFT), ("UP_CCW", UP | LEFT), ("UP_RIGHT", UP | RIGHT), ("UP_CW", UP | RIGHT),
    ("DOWN_LEFT", DOWN | LEFT), ("DOWN_CCW", DOWN | LEFT), ("DOWN_RIGHT", DOWN | RIGHT), ("DOWN_CW", DOWN | RIGHT),
    ("up", UP), ("Cw", RIGHT),
])  # fmt: skip
def test_a_direction_by_number_or_word(word, direction):
    rotor = ScriptedRotor()
    assert talk(f"M {word} 50\n".encode(), rotor) == [b"RPRT 0\n"]
    assert rotor.calls == [("move", direction, 50)]


def test_an_unchanged_speed_is_the_one_that_was_named_last():
    rotor = ScriptedRotor()
    talk(b"M 2 -1\nM 2 30\nM 4 -1\nM 4 101\nM 4 -1\nM8 100\n", rotor)
    assert rotor.calls == [("move", UP, -1), ("move", UP, 30), ("move", DOWN, 30), ("move", DOWN, 30),
                           ("move", LEFT, 100)]  # fmt: skip


def test_words_of_the_status_each_have_a_blank_behind_them():
    rotor = ScriptedRotor()
    rotor.flags = ("BUSY", "MOVING", "MOVING_AZ")
    assert talk(b"s\n+s\n", rotor) == [b"BUSY MOVING MOVING_AZ \n",
                                       b"get_status:\nStatus flags: BUSY MOVING MOVING_AZ \nRPRT 0\n"]  # fmt: skip


def test_the_range_is_the_dishs_own():
    rotor = ScriptedRotor()
    rotor.range = Advertised(-423.0, 23.5, 0.0, 180.0)
    (state,) = talk(b"\\dump_state\n", rotor)
    assert b"min_az=-423.000000\nmax_az=23.500000\nmin_el=0.000000\nmax_el=180.000000\n" in state


def test_a_line_for_the_dish_brings_its_lines():
    rotor = ScriptedRotor()
    rotor.exchanges["send"] = done(("AZ = 1.00", "EL\x1b[2J = 2.00"))
    assert talk(b"w a 0  1 # x\n+w a\n", rotor) == [b"AZ = 1.00\nEL[2J = 2.00\n",
                                                    b"send_cmd: a\nAZ = 1.00\nEL[2J = 2.00\nRPRT 0\n"]  # fmt: skip
    assert rotor.calls == [("send", "a 0 1 # x"), ("send", "a")]


@pytest.mark.parametrize("said", [b"q\n", b"Q\n", b"+q\n", b"p q p\n"])
def test_q_hangs_up_without_a_reply(said):
    replies = talk(said + b"p\n")
    assert replies == ([b"123.46\n45.68\n"] if b"p q" in said else [])

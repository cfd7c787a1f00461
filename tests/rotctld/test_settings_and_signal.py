"""Levels, functions, parameters and configuration; and the published commands of ours beside Hamlib's letters."""

from __future__ import annotations

from concurrent.futures import Future

import pytest
from birdcage.rotctld.conversation import ClientConversation
from birdcage.rotctld.rotor import SignalCounts
from birdcage.rotctld.rprt import Rprt
from birdcage.rotctld.table import COMMANDS

from .scripted_rotor import ScriptedRotor, done, talk

COUNTS, OK, WRONG, ABSENT = b"10\n512\n498\n", b"RPRT 0\n", b"RPRT -1\n", b"RPRT -11\n"


@pytest.mark.parametrize(("said", "replies"), [
    (b"v SPEED\n", [b"100\n"]), (b"V SPEED 30\nv SPEED\n", [OK, b"30\n"]),
    (b"M 2 70\n\\get_level SPEED\n", [OK, b"70\n"]),
    (b"+V SPEED 30\n", [b"set_level: SPEED 30\nRPRT 0\n"]), (b"V SPEED 30\n+v SPEED\n;v SPEED\n", [
        OK, b"get_level: SPEED\n30\nRPRT 0\n", b"get_level: SPEED;30\nRPRT 0\n"]),
    (b"V SPEED 0\n", [WRONG]), (b"V SPEED 101\n", [WRONG]), (b"V SPEED x\n", [WRONG]), (b"V SPEED\n", [WRONG]),
    (b"V speed 30\n", [WRONG]), (b"v MGL\n", [WRONG]), (b"v\n", [WRONG]), (b"V\n", [WRONG]), (b"V SPEED\n30\n", [
        WRONG, b"RPRT -4\n"]),
    (b"V ?\n", [b"SPEED \nRPRT 0\n"]), (b"v ?\n", [b"SPEED \n"]), (b"+V ?\n", [b"set_level: ?\nSPEED \nRPRT 0\n"]),
    (b"+v ?\n", [b"get_level: ?\nSPEED \nRPRT 0\n"]), (b"V ? v ?\n", [b"SPEED \nRPRT 0\n", b"SPEED \n"]),
    (b"U ?\n", [b"\nRPRT 0\n"]), (b"u ?\n", [b"\n"]), (b"X ?\n", [b"\nRPRT 0\n"]), (b"x ?\n", [b"\n"]),
    (b"U MGEF 1\n", [WRONG]), (b"u MGEF\n", [WRONG]), (b"X MGP 1\n", [WRONG]), (b"x MGP\n", [WRONG]),
    (b"\\set_func A 1 \\get_func A \\set_parm A 1\n", [WRONG] * 3),
    (b"C timeout 1000\n", [ABSENT]), (b"+C min_az 0\n", [b"set_conf: min_az 0\nRPRT -11\n"]),
    (b"C nonsense 1\n", [WRONG]),
    (b"C timeout\n", [WRONG]), (b"C ?\n", [WRONG]),
    (b"\\get_conf min_az\n", [b"min_az=-180.000000\n"]), (b"\\get_conf max_az\n", [b"max_az=450.000000\n"]),
    (b"\\get_conf min_el\n", [b"min_el=0.000000\n"]), (b"\\get_conf max_el\n", [b"max_el=90.000000\n"]),
    (b"\\get_conf south_zero\n", [b"south_zero=0\n"]), (b"\\get_conf timeout\n", [ABSENT]),
    (b"\\get_conf x\n", [WRONG]),
    (b"+\\get_conf min_el\n", [b"get_conf: min_el\nmin_el=0.000000\nRPRT 0\n"]),
    (b"3\n", [OK]), (b"\\dump_conf\n", [OK]), (b"+3\n", [b"dump_conf:\nRPRT 0\n"]),
])  # fmt: skip
def test_settings(said, replies):
    assert talk(said) == replies


def test_a_speed_is_for_the_moves_that_leave_it_unchanged():
    rotor = ScriptedRotor()
    talk(b"V SPEED 30\nM 2 -1\n", rotor)
    assert rotor.calls == [("move", 2, 30)]


@pytest.mark.parametrize(("said", "reads", "reply"), [
    (b"R\n", 10, COUNTS), (b"R", 10, COUNTS), (b"R # now\n", 10, COUNTS), (b"R 2\n", 2, COUNTS),
    (b"R 1000\n", 1000, COUNTS),
    (b"R 1\n", 1, COUNTS), (b"\\get_rssi\n", 10, COUNTS), (b"\\get_rssi 25\n", 25, COUNTS),
    (b"get_rssi 1\n", 1, COUNTS),
    (b"+R 2\n", 2, b"get_rssi: 2\nReads: 10\nAverage: 512\nCurrent: 498\nRPRT 0\n"),
    (b";R\n", 10, b"get_rssi:;Reads: 10;Average: 512;Current: 498;RPRT 0\n"),
])  # fmt: skip
def test_reading_the_signal(said, reads, reply):
    rotor = ScriptedRotor()
    assert talk(said, rotor) == [reply]
    assert rotor.calls == [("read_signal", reads)]


@pytest.mark.parametrize("said", [b"R 0\n", b"R -1\n", b"R 1001\n", b"R x\n", b"R 2.5\n", b"\\get_rssi 0\n", b"R p\n"])
def test_a_count_of_reads_out_of_range_is_einval(said):
    rotor = ScriptedRotor()
    assert talk(said, rotor) == [WRONG]
    assert rotor.calls == []


@pytest.mark.parametrize("said", [b"L\n", b"L\r\n", b"L # on\n", b"\\enable_lna\n", b"enable_lna\n", b"p L\n"])
def test_a_bare_letter_l_is_ours(said):
    rotor = ScriptedRotor()
    assert talk(said, rotor)[-1] == OK
    assert rotor.calls[-1] == ("enable_lna",)


@pytest.mark.parametrize(
    "said", [b"L 13.4 52.5 4\n", b"L 13.4\n52.5\n4\n", b"\\lonlat2loc 13.4 52.5 4\n", b"\\lonlat2loc\n13.4 52.5 4\n"]
)
def test_a_letter_l_with_a_number_is_hamlibs(said):
    rotor = ScriptedRotor()
    assert talk(said, rotor) == [b"JO62\n"]
    assert rotor.calls == []


@pytest.mark.parametrize(("said", "replies"), [
    (b"D\n", [b"CAPS:rssi,lna\n"]), (b"\\get_caps\n", [b"CAPS:rssi,lna\n"]),
    (b"+D\n", [b"get_caps:\nCAPS:rssi,lna\nRPRT 0\n"]),
    (b";D\n", [b"get_caps:;CAPS:rssi,lna;RPRT 0\n"]), (b"D 10 30 30 0\n", [b"10.508333\n"]), (b"L x\n", [WRONG]),
    (b"D x\n", [WRONG]), (b"L p\n", [WRONG]), (b"D\nL\nR\n", [b"CAPS:rssi,lna\n", OK, COUNTS]),
])  # fmt: skip
def test_letters_that_are_hamlibs_and_ours(said, replies):
    assert talk(said) == replies


def test_a_dish_without_a_tuner_says_so():
    rotor = ScriptedRotor()
    rotor.able = ()
    rotor.refuses = {"read_signal": Rprt.EIO, "enable_lna": Rprt.EIO}
    assert talk(b"D\nL\nR\nR 5\n", rotor) == [b"CAPS:\n", b"RPRT -6\n", b"RPRT -6\n", b"RPRT -6\n"]


@pytest.mark.parametrize("state", [b"\\dump_state\n", b"+\\dump_state\n"])
def test_after_dump_state_r_1_is_hamlibs_reset_and_does_nothing(state):
    rotor = ScriptedRotor()
    assert talk(state + b"R 1\nR1 +R 1\n", rotor)[1:] == [ABSENT, b"RPRT -4\n"]
    assert talk(b"R 1\n" + state + b"+R 1\nR 2\n", rotor)[2:] == [b"reset: 1\nRPRT -11\n", COUNTS]
    assert talk(b"\\dump_state R 1\n", rotor)[1:] == [ABSENT]
    assert [call for call in rotor.calls if call[0] == "read_signal"] == [("read_signal", 1), ("read_signal", 2)]


def test_a_signal_is_waited_for():
    rotor = ScriptedRotor()
    rotor.exchanges["read_signal"] = counts = Future()
    conversation = ClientConversation(rotor)
    conversation.feed(b"R 3\np\n")
    assert conversation.take_replies() == []
    counts.set_result(SignalCounts(3, 500, 501))
    conversation.resume()
    assert conversation.take_replies() == [b"3\n500\n501\n", b"123.46\n45.68\n"]


def test_a_supply_is_waited_for():
    rotor = ScriptedRotor()
    rotor.exchanges["enable_lna"] = done(None)
    assert talk(b"+L\n", rotor) == [b"enable_lna:\nRPRT 0\n"]


def test_no_two_commands_share_a_name():
    names = [row.long for row in COMMANDS if row.long and not (row.long == "get_rssi" and not row.alone)]
    letters = [(row.short, row.alone) for row in COMMANDS if row.short]
    assert len(names) == len(set(names))
    assert len(letters) == len(set(letters))
    assert all("_" in row.long or row.long == "stop" for row in COMMANDS if row.word)

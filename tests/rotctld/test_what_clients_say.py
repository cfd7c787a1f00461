"""What known programs say, and that each gets what it can read. The exchanges were recorded beside Hamlib's rotctld."""

from __future__ import annotations

import re

import pytest
from birdcage.rotctld.conversation import ClientConversation
from birdcage.rotctld.table import BY_LETTER, BY_LETTER_ALONE, BY_WORD

from .scripted_rotor import ScriptedRotor, talk

HERE, OK = b"123.46\n45.68\n", b"RPRT 0\n"
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

SESSIONS = {
    "Gpredict 2.3": [
        (b"p\n", HERE), (b"P 174.43 29.83\n", OK), (b"p\n", HERE), (b"P 174.29 30.06\n", OK), (b"S\n", OK),
        (b"q\n", None),
    ],
    "Gpredict, where decimals have commas": [(b"p\n", HERE), (b"P 148,17 55,06\n", OK), (b"S\n", OK), (b"q\n", None)],
    "Gpredict, flipped": [(b"P 169.90 156.92\n", OK), (b"P -169.90 0.00\n", OK)],
    "rotctl -m 2 p": [(b"\\dump_state\n", STATE), (b"p\n", HERE), (b"q\n", None)],
    "rotctl -m 2 P": [(b"\\dump_state\n", STATE), (b"P 180.000000 45.000000\n", OK), (b"q\n", None)],
    "rotctl -m 2 M": [(b"\\dump_state\n", STATE), (b"M 16 50\n", OK), (b"M 64 10\n", OK), (b"S\n", OK), (b"K\n", OK)],
    "rotctl -m 2 R": [(b"\\dump_state\n", STATE), (b"R 1\n", b"RPRT -11\n"), (b"p\n", HERE)],
    "rotctl -m 2 _": [(b"\\dump_state\n", STATE), (b"_\n", b"Winegard Trav'ler RS-485 Rotor\n")],
    "rotctl -m 2 w": [(b"\\dump_state\n", STATE), (b"AZ\r", b"RPRT -4\n"), (b"p\n", HERE)],
    "SatNOGS": [(b"\\dump_state\n", STATE), (b"p\n", HERE), (b"P 123.456787 45.678001\n", OK), (b"q\n", None)],
    "SatDump": [(b"p\n", HERE), (b"P 12.30 4.56\n", OK), (b"P 12,30 4,56\n", OK)],
    "SDRangel": [(b"p\n", HERE), (b"P 12.3 45.6\n", OK)],
    "Look4Sat": [(b"P 12.3 45.6\n", OK), (b"set_pos 12.3 45.6\n", OK), (b"\\set_pos 12.3 45.6\n", OK)],
    "a terminal": [(b"\r\n", b""), (b"p\r\n", HERE), (b"help\r\n", b"RPRT -4\n"), (b"stop\r\n", OK), (b"q\r\n", None)],
}  # fmt: skip


@pytest.mark.parametrize("program", SESSIONS)
def test_a_session(program):
    conversation = ClientConversation(ScriptedRotor())
    for said, answer in SESSIONS[program]:
        conversation.feed(said)
        assert conversation.take_replies() == ([answer] if answer else []), said
        assert conversation.closed is (answer is None)


def test_positions_are_as_sdrangel_reads_them():
    """It finds the value of a line by a pattern that a single digit does not match."""
    rotor = ScriptedRotor()
    rotor.where = (5.0, 0.0)
    assert [re.fullmatch(rb"-?\d+.\d+", line) is not None for line in talk(b"p\n", rotor)[0].splitlines()] == [True] * 2


def test_a_client_that_never_reads_is_obeyed():
    rotor = ScriptedRotor()
    conversation = ClientConversation(rotor)
    for degree in range(500):
        conversation.feed(f"P {degree} 45.0\n".encode())
    assert len(rotor.calls) == 500
    assert len(conversation.take_replies()) == 500


@pytest.mark.parametrize("line", sorted({*BY_LETTER, *BY_LETTER_ALONE, *BY_WORD}))
def test_a_command_alone_on_its_line_means_what_it_means_beside_a_comment(line):
    bare, commented = ScriptedRotor(), ScriptedRotor()
    assert talk(f"{line}\n".encode(), bare) == talk(f" {line} # by hand\n".encode(), commented)
    assert bare.calls == commented.calls

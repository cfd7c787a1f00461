"""The golden transcripts of a Carryout G2, from the driver's side: what it sends, byte for byte,
and what it makes of what a dish has printed. The dish is played from the page; our simulator has no part in it.
"""

from __future__ import annotations

import pytest
from birdcage.console.codec import MARK
from birdcage.rotator.values import Position, RssiReading

T_G2_NVS = """\
TRK>nvs
NVS>d 20
Num  Name                         Current      Saved      Default
---- --------------------------  ----------  ----------  ----------
 20) Disable Tracker Proc?            FALSE       FALSE       FALSE
NVS>e 20 1
 20) Disable Tracker Proc?           FALSE .       TRUE
NVS>s
    Saving ... \n\
Flash file flashx:bank0 opened
Flash sector cache enabled.
Flash doneSuccess
NVS>d 20
Num  Name                         Current      Saved      Default
---- --------------------------  ----------  ----------  ----------
 20) Disable Tracker Proc?             TRUE        TRUE       FALSE
NVS>
"""
"""Verbatim but for the last `d 20`, with which the driver looks whether it worked."""
LINE_ENDS = pytest.mark.parametrize("line_end", ["\r\n", "\r", "\n", "\n\r"])


@LINE_ENDS
def test_t_g2_nvs(play, line_end):
    g2, port = play(T_G2_NVS, line_end)
    g2.kill_search()
    assert port.written == b"\rnvs\rd 20\re 20 1\rs\rd 20\r"


@LINE_ENDS
def test_t_g2_nvs_as_values(play, line_end):
    g2, _port = play(T_G2_NVS.split("NVS>e 20 1", maxsplit=1)[0] + "NVS>\n", line_end)
    row = g2.nvs.read(20)
    assert (row.index, row.name) == (20, "Disable Tracker Proc?")
    assert (row.value, row.saved_value, row.default_value) == (False, False, False)


@LINE_ENDS
def test_t_g2_move(play, line_end):
    g2, port = play(
        """\
TRK>mot
MOT>h 0
wrap_min:-42333 wrap_max:2333
MOT>h 1
MOT>a 0 180.00
Angle = 180.00
MOT>a 1 45.00
Angle = 45.00
MOT>a
Angle[0] = 180.01
Angle[1] = 45.02
MOT>
""",
        line_end,
    )
    g2.enter_motor_menu()
    g2.home_motor(0)
    g2.home_motor(1)
    g2.move_motor(0, 180.0)
    g2.move_motor(1, 45.0)
    assert g2.get_position() == Position(180.01, 45.02)
    assert port.written == b"\rmot\rh 0\rh 1\ra 0 180.00\ra 1 45.00\ra\r"


def test_the_q_of_t_g2_move_goes_out_once_an_enter_has_shown_the_submenu(play, clock):
    mark = MARK.encode() + b"\r"
    g2, port = play([
        (b"\r", b"\r\nTRK>"), (b"mot\r", b"mot\r\nMOT>"), (mark, mark + b"\nMOT>"), (b"\r", b"\r\nMOT>"),
        (b"q\r", b"q\r\nTRK>"),
    ])  # fmt: skip
    g2.enter_motor_menu()
    clock.advance(5.0)
    g2.reset_to_root()
    assert port.written == b"\rmot\r" + mark + b"\rq\r"
    assert g2.console.place == "root"


@LINE_ENDS
def test_t_g2_rssi(play, line_end):
    g2, port = play(
        """\
TRK>dvb
DVB>lnbdc odu
DVB>rssi 10
409 1
Reads:10 RSSI[avg: 403 cur: 402]
DVB>
""",
        line_end,
    )
    g2.enter_dvb_menu()
    g2.enable_lna()
    assert g2.get_rssi(10) == RssiReading(10, 403, 402)
    assert port.written == b"\rdvb\rlnbdc odu\rrssi 10\r"


@LINE_ENDS
def test_t_fox(play, line_end):
    g2, port = play(
        "TRK>mot\nMOT>h 0\nMOT>h 1\nMOT>a\nAngle[0] = 0.00\nAngle[1] = 65.00\n"
        "MOT>a 0 90.00\nAngle = 90.00\nMOT>a 1 45.00\nAngle = 45.00\nMOT>\n",
        line_end,
    )
    g2.enter_motor_menu()
    g2.home_motor(0)
    g2.home_motor(1)
    assert g2.get_position() == Position(0.0, 65.0)
    g2.move_motor(0, 90.0)
    g2.move_motor(1, 45.0)
    assert port.written == b"\rmot\rh 0\rh 1\ra\ra 0 90.00\ra 1 45.00\r"


def test_homing_may_keep_the_shell_for_long(play):
    g2, port = play([(b"\r", b"\r\nTRK>"), (b"mot\r", b"mot\r\nMOT>"), (b"h 0\r", 14.0, b"h 0\r\nMOT>")])
    g2.enter_motor_menu()
    g2.home_motor(0)
    assert port.written == b"\rmot\rh 0\r"


def test_every_byte_of_a_reply_may_come_alone(play, clock):
    g2, port = play([])
    answers = {
        b"\r": b"\r\nTRK>",
        b"mot\r": b"mot\r\nMOT>",
        b"a\r": b"a\r\nAngle[0] = 180.01\r\nAngle[1] = 45.02\r\nMOT>",
    }

    def write(data):
        port.out.extend((clock.monotonic() + 0.01 * n, bytes([byte])) for n, byte in enumerate(answers[data]))

    port.write = write
    assert g2.get_position() == Position(180.01, 45.02)

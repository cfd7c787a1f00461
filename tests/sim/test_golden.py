"""The golden transcripts of a Carryout G2, byte for byte where they are certain."""

from __future__ import annotations

import re


def test_t_g2_nvs(terminal):
    dish = terminal("nvs20=0")
    heard = "TRK>" + dish.ask("nvs", "NVS>") + dish.ask("", "NVS>")
    heard += dish.ask("d 20", "NVS>") + dish.ask("e 20 1", "NVS>") + dish.ask("s", "Success\r\nNVS>")
    assert heard.replace("\r\n", "\n") == (
        "TRK>nvs\n"
        "NVS>\n"
        "NVS>d 20\n"
        "Num  Name                         Current      Saved      Default\n"
        "---- --------------------------  ----------  ----------  ----------\n"
        " 20) Disable Tracker Proc?            FALSE       FALSE       FALSE\n"
        "NVS>e 20 1\n"
        " 20) Disable Tracker Proc?           FALSE .       TRUE\n"
        "NVS>s\n"
        "    Saving ... \n"
        "Flash file flashx:bank0 opened\n"
        "Flash sector cache enabled.\n"
        "Flash doneSuccess\n"
        "NVS>"
    )


def test_t_g2_move(terminal):
    dish = terminal("unhomed=1")
    assert dish.ask("q", "TRK>").startswith("q\r\n")
    assert dish.ask("mot", "MOT>") == "mot\r\nMOT>"
    start = dish.now
    homing = dish.ask("h 0", "MOT>", within=15.0)
    assert homing.startswith("h 0\r\n")
    assert "wrap_min:-42333 wrap_max:2333\r\n" in homing
    assert re.search(r"AZ\s*-\s*Angle:\s*1\s+Wrap:\s*0\r\n", homing)
    assert 1.0 < dish.now - start < 8.0
    assert dish.ask("h 1", "MOT>", within=15.0) == "h 1\r\nMOT>"
    assert dish.ask("a 0 180", "MOT>") == "a 0 180\r\nAngle = 180.00\r\nMOT>"
    assert dish.ask("a 1 45", "MOT>") == "a 1 45\r\nAngle = 45.00\r\nMOT>"
    dish.listen(5.0)
    reply = dish.ask("a", "MOT>")
    assert re.fullmatch(r"a\r\nAngle\[0\] = \d+\.\d\d\r\nAngle\[1\] = \d+\.\d\d\r\nMOT>", reply)
    az, el = map(float, re.findall(r"\d+\.\d+", reply))
    assert abs(az - 180) < 0.065
    assert abs(el - 45) < 0.065
    assert dish.ask("q", "TRK>") == "q\r\nTRK>"


def test_t_g2_rssi(terminal):
    dish = terminal()
    assert dish.ask("dvb", "DVB>") == "dvb\r\nDVB>"
    assert dish.ask("lnbdc odu", "DVB>") == "lnbdc odu\r\nDVB>"
    reply = dish.ask("rssi 10", "DVB>")
    assert reply.startswith("rssi 10\r\n")
    assert re.search(r"\r\nReads:10 RSSI\[avg: \d+ cur: \d+\]\r\nDVB>$", reply)
    assert len(re.findall(r"\d+", reply)) == 6  # the echoed 10 and five integers
    assert dish.ask("q", "TRK>") == "q\r\nTRK>"


def test_t_g2plus_home(terminal):
    dish = terminal("unhomed=1")
    dish.ask("mot", "MOT>")
    assert dish.ask("h *", "MOT>").splitlines()[-2] == "AZ - Angle: 1 Wrap: 0"
    assert dish.angles() == (0.01, 65.0)


def test_t_fox_and_numbers_as_scripts_send_them(terminal):
    dish = terminal()
    dish.ask("q", "TRK>")
    dish.ask("mot", "MOT>")
    assert "= 90.00" in dish.ask("a 0 90.0", "MOT>")
    assert "= 35.84" in dish.ask("a 1 35.839999999999996", "MOT>")
    assert "= 359.50" in dish.ask("a 0 359.5", "MOT>")


def test_help_holds_prompt_like_text_in_every_menu(terminal):
    dish = terminal()
    assert "Enter <dvb> - DVB Tuner\r\n" in dish.ask("?")
    assert "help [<command>]\r\n" in dish.ask("help")
    for menu in ("mot", "dvb", "nvs", "os"):
        prompt = f"{menu.upper()}>"
        assert dish.ask(menu) == f"{menu}\r\n{prompt}"
        help_text = dish.ask("?")
        assert help_text.endswith(f"\r\n{prompt}")
        assert help_text.count(">") >= 2
        assert dish.ask("q") == "q\r\nTRK>"


def test_identity(terminal):
    dish = terminal()
    dish.ask("os", "OS>")
    identity = dish.ask("id")
    assert "Antenna ID:    12-IN G2\r\n" in identity
    assert "Software:      02.02.48\r\n" in identity

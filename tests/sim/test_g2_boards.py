"""Every command of DVB, PEAK, A3981, GPIO, EE, LATLON and DIPSWITCH, over the wire.

What is documented word for word is quoted here; the rest is what the simulator makes of it.
"""

from __future__ import annotations

import re

import pytest
from birdcage.sim.g2.firmware import menus

PROMPTS = {"eeprom": "EE>"}
COUNTS = r"\d+"
ROW = r" *\d+\) \d+ kHz [HV] Lock:[01] SNR:\d+\.\d NID:[0-9A-F]{4}"
ANSWERS = {
    "dvb": {
        "config": r".*ID 0x4515 Rev B0, FW v113\.37.*0x25018\n",
        "def": r"DVB defaults restored\n",
        "diag": r"(Transponder \d+\n  .*\n  RSSI: \d+ Lock: 0 SNR: 0\.0 NID: FFFF\n){32}",
        "dis": r"Transponder: 15\n  0\) Frequency: 1178120 kHz\n  1\) Symbol Rate: 20000 ksps\n  2\) LNB Pol.*: V .*\n",
        "e 1 21500": r"  1\) Symbol Rate: 21500 ksps\n",
        "e 0": r"  0\) Frequency: 1178120 kHz\n",
        "freqs": r"( *\d+\) \d+ kHz [HV]\n){32}",
        "lnbdc odu": "",
        "ls": r"Lock: 0\nTotal reads: 1 No signal: 1 Glitches: 0\nNID table:\n  FFFF 1\n",
        "man": r"(?:.*\n)*srch_mode .*\nstats .*\n(?:.*\n)*di2conf .*\n(?:.*\n)*",
        "msw": r"Multi-switch: 0\n",
        "pwr": r"Tuner power: ON\n",
        "qls": r"Lock: 0 SNR: 0\.0\n",
        "range": r"Range: min \d+ max \d+ span \d+\n",
        "rssi 10": rf"\d+ \d+\nReads:10 RSSI\[avg: {COUNTS} cur: {COUNTS}\]\n",
        "shuf": r"Order:( \d+){32}\n",
        "srch": r"Auto search: blind scan 18000-24000 ksps rolloff 0\.35\nSearch done: 0 of 32\n",
        "srch_mode": r"Auto search mode: 0\n",
        "stats": r"Reads: 0 Locks: 0 Glitches: 0\nRSSI min: 0 max: 0\n",
        "t 3": r"Transponder: 3\n",
        "table": rf"({ROW}\n){{32}}",
        "tablex": rf"({ROW} Sym:\d+ RSSI:\d+\n){{32}}",
        "tabto": r"Table timeout: 50 ms\n",
        "to": r"Timeout: 500 ms\n",
        "di2conf": r"3 21180544 238 <4\.5\n",
        "di2cs": r"RxReplyTimeout\n",
        "di2id": r"RxReplyTimeout\n",
        "di2rcs": r"RxReplyTimeout\n",
        "di2sc": r"RxReplyTimeout\n",
        "di2stat": r"RxReplyTimeout\n",
        "ovraddr": r".*0x11\n",
        "pretx": r".* 15 ms\n",
        "rrto": r".* 210 ms\n",
        "send E0 10 38 F0": r"Tx: E0 10 38 F0\n",
        "send e2 1 38 f1 0 ff": r"Tx: E2 01 38 F1 00 FF\nRxReplyTimeout\n",
        "tdthresh": r".* 110 \(0\.16 counts/mV\)\n",
    },
    "peak": {
        "pw": r"Peak AZ Angle:\d+ RSSI:\d+\nPeak EL Angle:\d+ RSSI:\d+\n",
        "psnr": r"Peak SNR: 0\.0\n",
        "pxy1": r"Peak AZ Angle:\d+ RSSI:\d+\n",
        "pxy1 1": r"Peak EL Angle:\d+ RSSI:\d+\n",
        "rssits": r"Even_sig = \d+, Odd_sig = \d+\n",
        "stb": r"Enabled LNB STB\n",
        "stb 0": r"Disabled LNB STB\n",
        "ts": r"SW Status: 0b0000 0\n",
    },
    "a3981": {
        "cm": r"AZ CM: AUTO EL CM: AUTO\n",
        "diag": r"AZ DIAG: OK EL DIAG: OK\n",
        "reset": "",
        "sm": r"AZ SM: AUTO EL SM: AUTO\n",
        "ss": r"1\n",
        "st": r"AZ ST: LOW EL ST: LOW\n",
    },
    "gpio": {
        "dir E0": r"OUTPUT\n",
        "dir e4": r"INPUT\n",
        "r E3": r"0\n",
        "r E24": r"1\n",
        "r E29": r"Unknown bit E29\n",
        "r A20": r"Unknown bit A20\n",
        "dir B12": r"Unknown bit B12\n",
        "w B0 0": "",
        "w B13 0": r"Unknown bit B13\n",
        "regs": r"(([A-E]\d+:[01] ?)+\n)+Unknown bit E29\n",
    },
    "eeprom": {
        "ee 0": r"Index:0 Read value = 0\n",
        "ee 32": r"Failed to read eeprom index:32 val:65793\n",
        "ee 32 -7": r"Index:32 Write value = -7\n",
        "inv 0": "",
        "def": "",
    },
    "latlon": {
        "l 214.25 38.39 201.92 42.67": r"anglesentered = 21425 3839 20192 4267\nLat = -?\d+ Lon = -?\d+\n",
    },
    "dipswitch": {"dipswitch": r"val:ffffff01\napp_dipswitch:101\n"},
}
TABLE = [(menu, line, reply) for menu, lines in ANSWERS.items() for line, reply in lines.items()]


def prompt_of(menu):
    return PROMPTS.get(menu, f"{menu.upper()}>")


def talk(terminal, menu, options="az=0&el=58"):
    dish = terminal(options)
    dish.ask(menu, prompt_of(menu))
    return dish


def answer(dish, menu, line):
    prompt = f"\n{prompt_of(menu)}"
    return dish.ask(line, prompt, within=60.0).replace("\r\n", "\n").removeprefix(f"{line}\n").removesuffix(prompt[1:])


@pytest.mark.parametrize(("menu", "line", "reply"), TABLE)
def test_a_command_answers_in_its_documented_form(terminal, menu, line, reply):
    heard = answer(talk(terminal, menu), menu, line)
    assert re.fullmatch(reply, heard), heard


def test_the_table_knows_every_command(terminal):
    known = menus(terminal().device.board)
    streams = {"agc", "lnbv", "nid", "snr"}  # tried in test_streams
    for menu, lines in ANSWERS.items():
        tried = {line.split()[0] for line in lines} | (streams if menu == "dvb" else set())
        assert tried == set(known[menu].commands) - {"?", "help", "q"}, menu


def test_the_inventory_is_whole(terminal):
    counted = {
        menu: len(set(known.commands) - {"?", "help", "q"}) for menu, known in menus(terminal().device.board).items()
    }
    expected = {"dvb": 38, "peak": 6, "a3981": 6, "gpio": 4, "eeprom": 3, "latlon": 1, "dipswitch": 1}
    assert {menu: counted[menu] for menu in expected} == expected


@pytest.mark.parametrize("menu", sorted(ANSWERS))
def test_a_menu_has_its_prompt_and_is_left_by_q(terminal, menu):
    dish = terminal()
    assert dish.ask(menu, f"\n{prompt_of(menu)}") == f"{menu}\r\n{prompt_of(menu)}"
    assert dish.ask("bogus", f"\n{prompt_of(menu)}") == f"bogus\r\nInvalid command.\r\n{prompt_of(menu)}"
    assert dish.ask("q", "\nTRK>") == "q\r\nTRK>"


def test_the_root_enters_twelve_menus_and_says_so(terminal):
    lines = terminal().ask("?", "\nTRK>").split("\r\n")
    assert "help [<command>]" in lines
    assert "Enter <dvb> - DVB Tuner" in lines
    entered = re.findall(r"Enter <(\w+)> - \S", "\n".join(lines))
    assert " ".join(entered) == "a3981 adc dipswitch dvb eeprom gpio latlon mot nvs os peak step"


def test_help_of_one_command(terminal):
    dish = terminal()
    assert dish.ask("help dvb", "\nTRK>") == "help dvb\r\nEnter <dvb> - DVB Tuner\r\nTRK>"
    assert "Invalid command." in dish.ask("help bogus", "\nTRK>")
    dish.ask("gpio", "GPIO>")
    assert dish.ask("? dir", "\nGPIO>") == "? dir\r\ndir <pin>\r\nGPIO>"


BAD = {
    "dvb": (
        *("rssi", "rssi 0", "rssi x", "rssi 1001", "lnbdc", "lnbdc idu", "t 0", "t 33", "t x", "pwr 2", "msw 9"),
        *("e", "e 3", "e 0 1", "e 1 0", "e 2 X", "e 0 x", "tabto -1", "to x", "srch_mode 10"),
        *("di2cs 0", "di2cs 5", "ovraddr 100", "ovraddr g", "pretx -1", "rrto x", "tdthresh 9999"),
        *("send", "send 1 2 3 4 5 6 7", "send 100", "send xy", "send E010"),
    ),
    "peak": ("pxy1 2", "pxy1 x", "stb 2", "stb 0 1"),
    "a3981": ("cm 1", "st x"),
    "gpio": ("dir", "r", "r A0 1", "w", "w B0", "w B0 2"),
    "eeprom": ("ee", "ee x", "ee -1", "ee 0 x", "ee 256 1", "ee 0 1 2", "ee 0 2147483648", "inv", "inv 256"),
    "latlon": ("l", "l 1 2 3", "l 1 2 3 x", "l 1 91 3 4", "l 1 2 3 nan", "l 1 2 3 4 5"),
}


@pytest.mark.parametrize(("menu", "line"), [(menu, line) for menu, lines in BAD.items() for line in lines])
def test_bad_arguments_are_refused_and_move_nothing(terminal, menu, line):
    dish = talk(terminal, menu)
    before = dish.port.dish.truth()
    assert answer(dish, menu, line) == "Invalid parameter.\n"
    assert dish.port.dish.truth() == before


def test_what_the_sources_leave_open_of_os_and_a3981_is_a_setting(terminal):
    dish = terminal("ss_reply=axes&nvs_version=")
    dish.ask("a3981", "A3981>")
    assert "AZ SS: 1 EL SS: 1\r\n" in dish.ask("ss", "A3981>")
    dish.ask("q", "TRK>")
    dish.ask("os", "OS>")
    assert "NVS" not in dish.ask("id", "OS>")


def test_the_boot_log_names_the_tuner(terminal):
    assert "BCM4515 ID 0x4515 Rev B0, FW v113.37, strap 0x25018" in terminal("boot=1").listen(20.0)

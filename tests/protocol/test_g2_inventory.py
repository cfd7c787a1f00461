"""Every documented command has its grade, in its menu."""

from __future__ import annotations

import pytest
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.rotator.verdict import Grade

OF = {"-": Grade.HARMLESS, "s": Grade.SETTING, "m": Grade.MOVES, "!": Grade.RUINS}
INVENTORY = {
    "root": """- ? | - help | - help mot | - a3981 | - adc | - dipswitch | - dvb | - eeprom | - gpio | - latlon | - mot
        | - nvs | - os | - peak | - step | m reboot | ! stow | ! q""",
    "a3981": "- cm | - diag | s reset | - sm | - ss | - st",
    "adc": "- bdid | - bdrevid | - rssi | - m | m scan | m scan 0 10",
    "dipswitch": "- dipswitch",
    "dvb": """- agc | - config | s def | - diag | - dis | s e 3 1 | - freqs | s lnbdc odu | - lnbv | - ls | - man
        | s msw | - nid | s pwr | - qls | s range | - rssi 10 | s rssi 500 | s shuf | - snr | m srch | s srch_mode
        | s srch_mode 1 | - stats | s t | s t 5 | s table | s tablex | s tabto | s tabto 5 | s to | s to 5
        | - di2conf | s di2cs | - di2id | - di2rcs | s di2sc | - di2stat | - ovraddr | s ovraddr 12 | - pretx
        | s pretx 20 | - rrto | s rrto 200 | s send E0 10 38 F0 | - tdthresh | s tdthresh 100""",
    "eeprom": "- ee 3 | ! ee 3 7 | ! inv 3 | ! def",
    "gpio": "- dir B0 | - r B0 | - regs | ! w B0 1",
    "latlon": "- l 180.00 40.00 200.00 35.00",
    "mot": """- a | m a 0 46 | m a 1 30 | m a 0 +5 | m a 1 -5 | m azscan | m azscan 90 5 10 | m azscanwxp 0 10 100 3
        | m e | - ela2s 45 | - elminmaxhome | - els2a 900 | m g 100 40 | m h 0 | m h 1 | m h * | - l | - life | - ma
        | s ma 0 300 | m motorboth | - motorlife | - mv | s mv 0 50 | - p | - pid | s pid 0 1 2 3 | m r | m sd
        | m sd 0 1 500 | ! sp | ! sp 0 100 | ! sw | ! sw 0 0 | - v | m vms | m vms 0 20 500
        | s w | s w 0 ON | ! w 0 OFF""",
    "nvs": "- d | - d 20 | - e 20 | s e 20 1 | s e 101 15 | s e 38 0 | s s",
    "os": "- id | m reboot",
    "peak": "m pw | m psnr | m pxy1 | s rssits | s stb | - ts",
    "step": """m e | - ma | s ma 0 44 | - mv | s mv 0 7222 | m p | m p 0 100 | - pid | s pid 0 250 50 | m r | ! v
        | ! v 0 1000""",
}
SUBMENUS = [menu for menu in INVENTORY if menu != "root"]
ROWS = [(menu, *row.split(maxsplit=1)) for menu, text in INVENTORY.items() for row in text.split("|")]
ROWS += [(menu, "-", line) for menu in SUBMENUS for line in ("?", "q", "help", "")]
STREAMS = {("dvb", "agc"), ("dvb", "lnbv"), ("dvb", "snr"), ("dvb", "nid"), ("adc", "m")}
KEEP_THE_SHELL = {
    ("mot", "h 0"): 15.0,
    ("mot", "h *"): 30.0,
    ("mot", "azscan"): 60.0,
    ("mot", "azscanwxp 0 10 100 3"): 60.0,
    ("mot", "motorboth"): 10.0,
    ("mot", "sd 0 1 500"): 10.0,
    ("mot", "vms 0 20 500"): 10.0,
    ("adc", "scan"): 60.0,
    ("dvb", "rssi 90"): 9.0,
    ("dvb", "table"): 30.0,
    ("dvb", "diag"): 5.0,
    ("dvb", "srch"): 30.0,
    ("dvb", "di2stat"): 0.3,
    ("dvb", "send E0 10 38 F0"): 0.3,
    ("peak", "pw"): 30.0,
    ("peak", "rssits"): 2.0,
    ("gpio", "regs"): 2.0,
    ("nvs", "d"): 5.0,
    ("nvs", "s"): 5.0,
}


@pytest.fixture(scope="module")
def g2():
    return CarryoutG2Protocol()


@pytest.mark.parametrize(("menu", "grade", "line"), ROWS)
def test_each_command_has_its_own_row_and_grade(g2, menu, grade, line):
    line = line.strip()
    rows = [
        row for row in g2.hazards.rows if menu in row.menus and not row.loose and row.pattern.fullmatch(line.lower())
    ]
    assert rows
    verdict = g2.judge(line, menu, homed=True)
    assert (verdict.listed, verdict.grade) == (True, OF[grade])
    assert bool(verdict.consequence) is (verdict.grade is not Grade.HARMLESS)
    assert verdict.streams is ((menu, line) in STREAMS)


def test_the_inventory_and_the_list_of_commands_are_the_same():
    listed = {(command.menu, command.name) for command in CarryoutG2Protocol.commands}
    assert listed == {(menu, line.split()[0]) for menu, _grade, line in ROWS if line.strip()} - {
        *((menu, "help") for menu in SUBMENUS),
        ("root", "?"),
    }


@pytest.mark.parametrize(("menu", "line"), KEEP_THE_SHELL)
def test_what_keeps_the_shell_is_waited_for(g2, menu, line):
    assert g2.judge(line, menu, homed=True).takes_s >= KEEP_THE_SHELL[menu, line]


def test_every_menu_has_a_prompt_and_is_entered_from_the_root(g2):
    assert set(g2.dialect.prompts) == set(INVENTORY)
    assert g2.dialect.prompts["eeprom"] == "EE>"

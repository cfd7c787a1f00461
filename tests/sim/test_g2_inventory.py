"""Every command of the menus MOT, STEP, ADC, NVS and OS, over the wire, in the documented form."""

from __future__ import annotations

import re

import pytest
from birdcage.sim.g2.firmware import menus

NUMBER = r"-?\d+(\.\d+)?"
POINT = r"Motor:[01] Angle:\d+ RSSI:\d+ Lock:[01] SNR:\d+ Scan Delta:\d+"
ROW = r" *\d+\) .{26} +\S+"
ANSWERS = {
    "mot": {
        "a": rf"Angle\[0\] = {NUMBER}\nAngle\[1\] = {NUMBER}\n",
        "a 0 350": r"Angle = 350\.00\n",
        "a 0 -10": r"Angle = -10\.00\n",
        "a 1 +5": r"Angle = 50\.00\n",
        "azscan 5 0 10": rf"({POINT}\n){{5}}",
        "azscanwxp 0 10 100 3": rf"({POINT}\n){{30}}",
        "e": "",
        "ela2s 45": r"Angle: 4500 Steps: 3120\n",
        "elminmaxhome": r"Min: 18\.00 Max: 65\.00 Home: 65\.00\n",
        "els2a 3120": r"Steps: 3120 Angle: 4500\n",
        "els2a 999999": r"Steps: 999999 overflow\n",
        "g 350 50": "",
        "h 0": r"wrap_min:-42333 wrap_max:2333\nAZ - Angle: 1 Wrap: 0\n",
        "h 1": "",
        "h *": r"wrap_min:-42333 wrap_max:2333\nAZ - Angle: 1 Wrap: 0\n",
        "l": r"0=AZIMUTH HOLDING\n1=ELEVATION HOLDING\n",
        "life": r"AZIMUTH moves: 0\nAZIMUTH degrees: 0\nELEVATION moves: 0\nELEVATION degrees: 0\n",
        "ma": rf"Max Accel \[0\] = {NUMBER}\nMax Accel \[1\] = {NUMBER}\n",
        "motorboth": "",
        "motorlife": r"(AZIMUTH|ELEVATION) moves: 0 homings: 0\n[\S\s]*seconds: 0\.0\n",
        "mv": r"Max Vel \[0\] = 65\.00\nMax Vel \[1\] = 45\.00\n",
        "p": r"Position\[0\] = 0\nPosition\[1\] = 3120\n",
        "pid": r"PID\[0\] Kp=250 Kv=50 Ki=0\nPID\[1\] Kp=250 Kv=50 Ki=0\n",
        "pid 1 200 40 3": r"PID\[1\] Kp=200 Kv=40 Ki=3\n",
        "r": "",
        "sd 0 1 60000": r"AZ MOTOR STALLED\n",
        "sd 1 0 100": r"EL - No stall\n",
        "sp 0 90": r"Position\[0\] = 10000\n",
        "sw 0 -10": r"wrap_min:-41333 wrap_max:3333\n",
        "v": r"Velocity\[0\] = 0\.00\nVelocity\[1\] = 0\.00\n",
        "vms 0 -10 500": "",
        "w": r"Wrap\[0\] = ON\nWrap\[1\] = ON\n",
        "w 0 off": r"Wrap\[0\] = OFF\n",
    },
    "step": {
        "e": "",
        "ma": r"Accel\[0\] = 44\nAccel\[1\] = 28\n",
        "ma 0 22": r"Accel\[0\] = 22\nAccel\[1\] = 28\n",
        "mv": r"Max Vel \[0\] = 7222\nMax Vel \[1\] = 3120\n",
        "mv 1 1000": r"Max Vel \[0\] = 7222\nMax Vel \[1\] = 1000\n",
        "p 0 -100": "",
        "pid": r"Kp=250 Kv=50\n",
        "pid 1": r"Kp=250 Kv=50\n",
        "pid 1 100 20": r"Kp=100 Kv=20\n",
        "r": "",
        "v 0 -100": "",
    },
    "adc": {
        "bdid": r"STATIONARY\n",
        "bdrevid": r"A\n",
        "rssi": r"\d+\n",
        "scan": rf"({POINT}\n){{11}}",
        "scan 1 5 50": rf"({POINT}\n){{11}}",
    },
    "nvs": {
        "d": rf"Num  Name +Current +Saved +Default\n---- -{{26}}  -{{10}}  -{{10}}  -{{10}}\n({ROW} +\S+ +\S+\n){{41}}",
        "d 38": r"Num .*\n---- .*\n 38\) Sleep Mode Timer Secs              420         420         420\n",
        "e 41": r" 41\) Satellite Scan Velocity         55\.00\n",
        "e 102 70": r"102\) Maximum Elevation Angle         65\.00 \.      70\.00\n",
        "s": r"    Saving \.\.\. \nFlash file flashx:bank0 opened\nFlash sector cache enabled\.\nFlash doneSuccess\n",
        "anything": r"  0\) Log ID's                   0x00000007\n",
    },
    "os": {"id": r"NXP Kinetis K60 ARM Cortex-M4\n(  [A-Za-z-]+( [A-Za-z]+)?: +\S.*\n){12}  NVS Version: +\S+\n"},
}
TABLE = [(menu, line, reply) for menu, lines in ANSWERS.items() for line, reply in lines.items()]


@pytest.mark.parametrize(("menu", "line", "reply"), TABLE)
def test_a_command_answers_in_its_documented_form(terminal, menu, line, reply):
    dish = terminal()
    prompt = f"{menu.upper()}>"
    dish.ask(menu, prompt)
    heard = dish.ask(line, f"\n{prompt}", within=60.0).replace("\r\n", "\n")
    assert re.fullmatch(f"{re.escape(line)}\n{reply}{prompt}", heard), heard


def test_the_table_knows_every_command(terminal):
    elsewhere = {"?", "help", "q", "m", "reboot"}  # tried in tests of their own
    known = menus(terminal().device.board)
    for menu, lines in ANSWERS.items():
        assert set(known[menu].commands) - elsewhere <= {line.split()[0] for line in lines}, menu
    assert len(set(known["mot"].commands) - {"?", "help", "q"}) == 24  # the notes have 25, as they list `a` twice


BAD = {
    "mot": (
        "a 2 10",
        "azscan x",
        "azscan 10 0 -5",
        "azscanwxp 2 10 100 3",
        "azscanwxp 0 10 0 3",
        "azscanwxp 0 10 100 0",
        "azscanwxp 0 10 100 33",
        "azscanwxp 0 0 100 1",
        "ela2s",
        "els2a 1.5",
        "g 10",
        "g x 30",
        "g 10 30 0",
        "h",
        "h 2",
        "l 1",
        "motorboth 1",
        "mv 0 100",
        "pid 2",
        "pid 0 1 2",
        "sd 0 1",
        "sd 0 2 100",
        "sd 0 1 0",
        "sp 0",
        "sp 0 nan",
        "sw 2 0",
        "vms 0 10",
        "vms 0 10 -1",
        "w 2",
        "w 0 maybe",
    ),
    "step": ("v 0", "v 2 10", "p 0 x", "pid 0 1", "pid 2"),
    "adc": ("scan 2", "scan 0 x", "scan 0 10 0.5"),
    "nvs": ("e 5", "d 5", "e 20 2", "e 101 nan", "e 101 inf", "e 38 1e3", "e 0 0x1FFFFFFFF", "e", "e 20 1 1"),
}


@pytest.mark.parametrize(("menu", "line"), [(menu, line) for menu, lines in BAD.items() for line in lines])
def test_bad_arguments_are_refused_and_move_nothing(terminal, menu, line):
    dish = terminal()
    prompt = f"{menu.upper()}>"
    dish.ask(menu, prompt)
    before = dish.port.dish.truth()
    assert dish.ask(line, f"\n{prompt}") == f"{line}\r\nInvalid parameter.\r\n{prompt}"
    assert dish.port.dish.truth() == before

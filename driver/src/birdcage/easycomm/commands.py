"""The commands of both firmwares, and what each may do (`docs/reference/easycomm.md`): the help and the table of F5."""

from __future__ import annotations

import re

from birdcage.protocol.hazard import Hazard, HazardTable
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.verdict import Grade

_LISTED = (
    "AZ EL | | asks where it points; the only question that no firmware takes for a move",
    "AZ | <deg> [EL<deg>] | sends the azimuth, and the elevation; without a number, stock firmware turns to 0",
    "EL | <deg> | sends the elevation (RP2040)",
    "SA SE | | stops both axes",
    "STOP | | stops both axes (RP2040)",
    "PARK | | turns to azimuth 0, elevation 0, or where the stock firmware is set to park",
    "RESET | | stock: homes both axes at their switches; RP2040: forgets that it is homed, for good",
    "VE | | version of the firmware",
    "GS | | status: 1 idle, 2 moving, 4 pointing, 8 error",
    "GE | | error: 1 none, 4 homing, 8 motor; the RP2040 adds them up",
    "TICKS | | counts of both encoders (RP2040)",
    "INFO | | position, counts, switches, faults, mode (RP2040)",
    "ZERO | | counts both encoders from where they stand (RP2040)",
    "MONITOR | | prints counts ten times a second, until it is typed again (RP2040)",
    "GAINS | | gains of the control loop (RP2040)",
    "KP | <gain> | sets the proportional gain; KI and KD likewise (RP2040)",
    "IMU | | reads the accelerometer (RP2040)",
    "RECAL | | takes the elevation from the accelerometer (RP2040)",
    "DUTY_AZ | <duty> | drives the azimuth, -1 to 1, until STOP; DUTY_EL likewise (RP2040)",
    "HELP | | lists the bench commands (RP2040)",
    "IP | <0 to 8> | temperature, switches, angles, loads, speeds (stock)",
    "CR | <1 to 9> | reads gains and park position (stock)",
    "CW | <1 to 8>,<value> | sets them (stock)",
    "VU | <mdeg/s> | raises the elevation; VD lowers it, VL and VR turn the azimuth (stock, not its steppers)",
    "RB | | restarts the controller, which then homes (stock)",
)  # fmt: skip
DOCUMENTED = tuple(
    CommandDoc(None, name, f"{name}{arguments}", text)
    for name, arguments, text in ((part.strip() for part in line.split("|")) for line in _LISTED)
)

_WHERE = frozenset({"position", "turn"})
_ALL = frozenset({"position", "turn", "homed"})
_UNGUARDED = "birdcage checks no limits for this line."


def _row(pattern: str, grade: Grade = Grade.HARMLESS, said: str = "", **more: object) -> Hazard:
    return Hazard(frozenset(), re.compile(pattern), grade, said, **more)  # type: ignore[arg-type]


HAZARDS = HazardTable(
    rows=(
        _row(r"|az el|ve|gs|ge|ticks|info|gains|imu|help|\?|ip ?[0-8]|cr [1-9]"),
        _row("sa se|sa|se|s|stop"),
        _row("az", Grade.MOVES,
             "Stock firmware takes AZ without a number for azimuth 0, and turns there. To ask, type AZ EL.",
             forgets=_WHERE),
        _row("el"),
        _row(r"az ?(?P<az>[-+]?[\d.]+)( el ?(?P<el>[-+]?[\d.]+))?", Grade.MOVES,
             f"Moves the rotator. STOP ends it. {_UNGUARDED}", forgets=_WHERE, takes_s=0.2),
        _row(r"el ?(?P<el>[-+]?[\d.]+)", Grade.MOVES, f"Moves the rotator. STOP ends it. {_UNGUARDED}", forgets=_WHERE),
        _row("park.*", Grade.MOVES, f"Turns to where it parks, azimuth 0 and elevation 0. {_UNGUARDED}",
             forgets=_WHERE),
        _row("reset|r", Grade.RUINS,
             "On an RP2040 it forgets that it is homed, until it is switched off and on. Stock firmware homes both "
             "axes, reads nothing meanwhile, and nothing stops it.", forgets=_ALL, takes_s=80.0),
        _row(r"duty_(az|el).*", Grade.MOVES,
             "Drives a motor until STOP, past every limit and into its end stop. Nothing ends it by itself.",
             forgets=_WHERE),
        _row("zero|z", Grade.MOVES,
             "Counts both axes from where they stand, so its angles mean something else. An axis that its loop drives "
             "goes on to the old target from there.", forgets=_ALL),
        _row("recal", Grade.SETTING, "Takes the elevation from the accelerometer.", forgets=_WHERE),
        _row(r"k[pid][-+\d.]\S*", Grade.SETTING,
             "Changes a gain of the control loop until it restarts. The loop may swing."),
        _row("monitor|mon", Grade.SETTING, "Prints ten lines a second until MONITOR is typed again."),
        _row("v[udlr].*", Grade.MOVES, f"Turns an axis at a speed, without end. {_UNGUARDED}", forgets=_WHERE),
        _row(r"cw[1-8],\S*", Grade.SETTING, "Changes a gain or the park position until it restarts."),
        _row("rb.*", Grade.MOVES, "Restarts the controller, which then homes: nothing stops that.", forgets=_ALL,
             restarts=True, takes_s=100.0),
        _row("rst.*", Grade.RUINS,
             "Hangs the controller: it then answers only GS and GE. RB restarts it, and it homes.", forgets=_ALL,
             restarts=True, takes_s=100.0),
    ),
    unlisted={"": "Undocumented command. It may move the rotator."},
    unlisted_grade=Grade.MOVES,
)  # fmt: skip

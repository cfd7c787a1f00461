"""What lines in the G2's two motor menus do (docs/reference/g2-commands.md; docs/reference/g2.md, *Hazards*)."""

from __future__ import annotations

from birdcage.protocol.g2.hazard_rows import DEADLOCK, REFERENCE, WHERE, harmless, moves, rows, ruins, setting
from birdcage.rotator.verdict import Grade

_ONE_AXIS = r"a (?P<axis>[01]) (?P<angle>\S+)"
_BOTH_AXES = r"g (?P<az>\S+) (?P<el>\S+)"
_HOMING = "Runs the axis into its stop to find its reference. Only cutting the power stops that."
_UNGUARDED = "birdcage checks no limits for this line."
_CURRENT = (
    *moves(
        "mot step",
        "Switches the motor current on: they may jerk, and after a release the reported position is wrong.", "e( .*)?",
    ),
    *rows(
        "mot step",
        Grade.MOVES,
        "Switches the motor current off: the dish may fall under its own weight, and its position is then unknown.",
        "r( .*)?", forgets=REFERENCE, releases=True,
    ),
)  # fmt: skip
_MOT = (
    *harmless("mot", "a|ela2s .+|elminmaxhome|els2a .+|l|life|ma|motorlife|mv|p|pid|v"),
    *moves("mot", f"Moves an axis at once. {_UNGUARDED}",
            r"a (?P<axis>1) (?P<angle>\S+)", forgets=frozenset({"position"})),
    *moves("mot", f"Moves an axis at once. {_UNGUARDED}", _ONE_AXIS, "a .+"),
    *moves("mot", f"Moves both axes at once. {_UNGUARDED}", _BOTH_AXES, "g( .*)?"),
    *ruins("mot", f"Moves the dish. {DEADLOCK}",
            _ONE_AXIS, "a .+", _BOTH_AXES, "g( .*)?", "motorboth( .*)?", forgets=WHERE, unhomed=True),
    *ruins("mot", f"Sweeps the azimuth. {DEADLOCK}",
            r"azscan\S*( .*)?", forgets=WHERE, takes_s=120.0, unhomed=True),
    *moves("mot", "Sweeps the azimuth by itself, up to minutes; nothing stops it for sure.",
            r"azscan\S*( .*)?", takes_s=120.0),
    *moves("mot", _HOMING, "h 0", forgets=REFERENCE, takes_s=15.0, homes=(0,)),
    *moves("mot", _HOMING, "h 1", forgets=REFERENCE, takes_s=15.0, homes=(1,)),
    *moves("mot", _HOMING, r"h \*", forgets=REFERENCE, takes_s=30.0, homes=(0, 1)),
    *moves("mot", _HOMING, "h( .*)?", forgets=REFERENCE, takes_s=30.0),
    *moves("mot", "Moves both motors at the same time, as a test of its own.", "motorboth( .*)?", takes_s=30.0),
    *moves("mot", "Drives a motor until it stalls, as a test: it runs into whatever is in its way.",
            "sd( .*)?", takes_s=30.0),
    *moves("mot", "Spins a motor for a time, ignoring the limits and the cable.",
            "vms( .*)?", takes_s=30.0),
    *ruins("mot", "Overwrites the dish's position: every angle and limit is wrong until it is homed.",
            "sp( .*)?", forgets=REFERENCE),
    *ruins("mot", "Overwrites the turn of the cable: the dish may then wind the cable until it tears.",
            "sw( .*)?", forgets=REFERENCE),
    *ruins("mot", "Switches the protection of the cable off: the dish may then wind it until it tears.",
            "w( .*)? off( .*)?"),
    *setting("mot", "Switches the protection of the cable.", "w( .*)?"),
    *setting("mot step", "Changes how hard the motors are driven. Too much loses steps, and then angles are wrong.",
              "(ma|mv|pid) .+", forgets=frozenset({"settings"})),
)  # fmt: skip
_STEP = (
    *harmless("step", "ma|mv|pid"),
    *ruins("step", f"Moves a motor. {DEADLOCK}", "p( .*)?", forgets=WHERE, unhomed=True),
    *moves("step", "Sends a motor to a count of steps, ignoring the limits and the cable.", "p( .*)?"),
    *ruins("step", "Spins a motor without end: it winds the cable until it tears, or runs into a stop.",
            "v( .*)?", forgets=WHERE),
)  # fmt: skip

MOTOR_ROWS = _CURRENT + _MOT + _STEP
"""Every line of `mot` and `step`."""

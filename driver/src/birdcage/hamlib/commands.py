"""The commands of a rotctld, for the help of F5 (`docs/reference/rotctl.md`, *Commands*)."""

from __future__ import annotations

from birdcage.rotator.raw import CommandDoc

_LISTED = """
    p | | azimuth and elevation, a line each
    P | <az> <el> | sends both axes to an angle
    S | | stops both axes
    K | | sends the rotator to its own park position
    M | <direction> <speed> | turns until stopped: 2 up, 4 down, 8 left, 16 right; speed 1 to 100, -1 as it is
    R | <what> | resets the rotator: 1 all of it
    _ | | what the server calls its rotator
    s | | status flags
    v | <level> | a level: SPEED; ? lists them
    V | <level> <value> | sets a level
    \\dump_state | | model, ranges and kind
    \\dump_caps | | all that Hamlib knows of the rotator
    w | <line> | hands a line to the rotator's controller
    q | | ends the connection
"""

COMMANDS = tuple(
    CommandDoc(None, name, f"{name} {arguments}".strip(), text)
    for name, arguments, text in (
        (part.strip() for part in line.split("|", 2)) for line in _LISTED.strip().splitlines()
    )
)

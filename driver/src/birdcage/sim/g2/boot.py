"""What a G2 prints when it gets power. Tokens (noted); lines around them and times (assumed).

Source: docs/reference/g2.md, *Power-up*.
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.tracker import Tracker
from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.homing import home

BEFORE_HOMING = (
    (0.3, "Bootloader v1.01"),
    (1.2, "SPI1 init @ 4 MHz (mode 0x03)"),
    (0.1, "Motor init System=12Inch master=40000 slave=24960 ratio=1.602564"),
    (0.1, "SPI2 init @ 6.857 MHz (mode 0x03)"),
    (0.1, "EXTENDED_DVB_DEBUG ENABLED"),
    (1.5, "DVB init: AP RAM FW verified, BCM4515 ID 0x4515 Rev B0, FW v113.37, strap 0x25018"),
    (0.2, "Auto search: blind scan 18000-24000 ksps rolloff 0.35"),
    (0.3, "Enabled LNB STB"),
    (0.2, "Ant ID - 12-IN G2"),
    (0.4, "NVS loaded"),
)


def fail_to_home(board: G2Board) -> Script:
    """Time out on both axes (setting `home_fails`)."""
    for index in (1, 0):
        data = board.dish.axes[index].data
        yield Pause(data.homing_timeout_s)
        yield f"{data.name} Motor Home Failure\n"


def boot_log(board: G2Board, tracker: Tracker) -> Script:
    """Play the log; home and start the TV search unless NVS 20 is TRUE. The shell prints its prompt afterwards."""
    for seconds, line in BEFORE_HOMING:
        yield Pause(seconds)
        yield f"{line}\n"
    if not board.nvram.active[20]:
        if board.settings.home_fails:
            yield from fail_to_home(board)
        else:
            yield from home(board, 1)
            yield from home(board, 0)
            yield "Antenna Facing Front\n"
    yield Pause(0.2)
    yield "Boot Complete\nLoc Startup: IDU NOT Present\n"
    tracker.start()

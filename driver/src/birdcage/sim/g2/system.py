"""The system menu, `OS>` (docs/reference/g2.md, *Identity*)."""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Script

IDENTITY = """\
NXP Kinetis K60 ARM Cortex-M4
  Package:       144-pin
  Silicon Rev:   2.4
  Mask Set:      4N22D
  P-Flash:       512 KB
  RAM:           128 KB
  Core Clock:    96 MHz (CCLK)
  Bus Clock:     48 MHz (BCLK)
  System ID:     TWELINCH
  Antenna ID:    12-IN G2
  Software:      02.02.48
  Flash Base:    0x00010000 (65536)
  Flash Size:    458752 bytes (448 KB)
"""
"""Fields and order (noted); the layout is that source's own rendering, not certainly the wire's. The NVS version that
the notes name is printed below them (setting `nvs_version`)."""


class SystemMenu(G2Menu):
    """Identity and reboot."""

    prompt = "OS>"
    help_lines = ("help [<command>]", "id - Identification", "q", "reboot - Reboot the processor")

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"id": self._id, "reboot": self._reboot}

    def _id(self, args: list[str]) -> Script:  # noqa: ARG002
        version = self.board.settings.nvs_version
        yield IDENTITY + (f"  {'NVS Version:':<14} {version}\n" if version else "")

    def _reboot(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.reboot()
        yield ""

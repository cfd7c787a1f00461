"""The root menu, `TRK>` (docs/reference/g2-commands.md, *TRK>*; docs/reference/g2.md, *Hazards*)."""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Enter, Pause, Script, quitting
from birdcage.sim.trk.limits import INT_MAX

SUBMENUS = {
    "a3981": "Motor Driver",
    "adc": "Analog Inputs",
    "dipswitch": "Dipswitch",
    "dvb": "DVB Tuner",
    "eeprom": "EEPROM",
    "gpio": "GPIO",
    "latlon": "Lat/Lon Calculator",
    "mot": "Motor Control",
    "nvs": "Non-Volatile Storage",
    "os": "OS",
    "peak": "Peak Signal",
    "step": "Stepper Control",
}
"""The line of `dvb` is quoted (noted); the others are made like it (assumed)."""


class G2RootMenu(G2Menu):
    """Enters submenus. What `q` does here is a setting, as the sources disagree."""

    prompt = "TRK>"
    help_lines = (
        "help [<command>]",
        *(f"Enter <{name}> - {what}" for name, what in SUBMENUS.items()),
        "reboot",
        "stow",
        "q",
    )

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"q": self._quit, "reboot": self._reboot, "stow": self._stow}

    def run(self, words: list[str]) -> Script:
        """Carry out one line; the name of a submenu enters it."""
        if words[0] in SUBMENUS:
            yield Enter(words[0])
        else:
            yield from super().run(words)

    def _quit(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from quitting(self.board.settings.root_q, lambda: self.unknown(["q"]))

    def _reboot(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.reboot()
        yield ""

    def _stow(self, args: list[str]) -> Script:  # noqa: ARG002
        """Fold: what it prints, and whether it waits, no source says."""
        az, el = self.board.dish.axes
        for axis in (az, el):
            if not axis.homed:
                yield f"Step to Position {axis.data.name} angle error: {INT_MAX}\n"
                return
        settings, now = self.board.settings, self.board.now_s
        az.retarget(now, settings.stow_az)
        el.retarget(now, settings.stow_el)
        if settings.stow_blocks:
            yield Pause(max(az.end_s(), el.end_s()) - now)

"""Winegard Carryout G2+ (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import ClassVar

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol.g2plus.model import CARRYOUT_G2_PLUS, DIALECT, FEATURES, KNOWN
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.nvs import DISABLE_TRACKER, NvsRow
from birdcage.protocol.trk.kin import TrkKin
from birdcage.protocol.trk.kin_commands import kin_commands
from birdcage.protocol.trk.kin_hazards import kin_hazards
from birdcage.protocol.trk.nvs import TrkNvsProtocol
from birdcage.protocol.trk.settings_rows import tv_search_of
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.own_settings import SettingKnown, row_id
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.values import Survey


class CarryoutG2PlusProtocol(TrkKin, TrkNvsProtocol):
    """The G2+'s console: `MOT>` answers a move with `Angle = 46.00`; `NVS>` switches its TV search."""

    name: ClassVar[str] = "g2plus"
    model: Facts = CARRYOUT_G2_PLUS
    dialect: ClassVar[ConsoleDialect] = DIALECT
    feature_table: ClassVar[FeatureTable] = FEATURES
    settings_known: ClassVar[Mapping[int, SettingKnown]] = KNOWN
    hazards: ClassVar[HazardTable] = kin_hazards(DIALECT, CARRYOUT_G2_PLUS)
    commands: ClassVar[tuple[CommandDoc, ...]] = kin_commands(DIALECT.prompts)

    def read_nvs(self, index: int) -> NvsRow:
        """Read one row of the settings memory. NoReply (`no_row`) without it, or where row 20 is not the TV search.

        Which row that is was published of one dish.
        """
        row = super().read_nvs(index)
        if index == DISABLE_TRACKER and "tracker" not in row.name.lower():
            raise NoReply(f"NVS row {index} of this dish is {row.name!r}, not its TV search.", reason=Reason.NO_ROW)
        return row

    def survey(self) -> Survey:
        """Read whether the TV search is off. A dish that does not tell is surveyed without it."""
        try:
            row = self.read_nvs(DISABLE_TRACKER)
        except NoReply as missing:
            if missing.reason != Reason.NO_ROW:
                raise
            return Survey()
        return Survey(
            features=tv_search_of(row),
            settings={row_id(row.index): row.current},
            search_disabled=row.current == "TRUE",
        )

    def _tell_search(self, tell: Callable[[str], None]) -> None:
        try:
            disabled = self.read_nvs(DISABLE_TRACKER).current == "TRUE"
        except (CommandRefused, NoReply) as untold:
            tell(f"It does not tell whether its TV search is off: {untold}")
            return
        tell(
            "The TV search is off (NVS 20 is TRUE)."
            if disabled
            else "NVS 20 is FALSE: this dish homes and searches for TV satellites by itself at power-up."
        )

    def kill_search(self) -> None:
        """Switch the TV search off for good, as `TrkNvsProtocol` does."""
        TrkNvsProtocol.kill_search(self)

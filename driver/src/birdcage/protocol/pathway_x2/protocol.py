"""Winegard Pathway X2 (`docs/reference/g2-kin.md`): it waits before it executes a command, and tells no position."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Unpack

from birdcage.base.clock import Clock
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.session_hooks import SessionHooks
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.pathway_x2.model import ANSWER, DIALECT, FEATURES, LAG_S, PATHWAY_X2, way_s
from birdcage.protocol.trk.answers import MoveAnswer
from birdcage.protocol.trk.kin import TrkKin
from birdcage.protocol.trk.kin_commands import kin_commands
from birdcage.protocol.trk.kin_hazards import kin_hazards
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.values import Taken

if TYPE_CHECKING:
    from birdcage.link.link import Link


class PathwayX2Protocol(TrkKin):
    """Its lines end in CR LF, and each command of a move goes between two blank ones."""

    name: ClassVar[str] = "pathway-x2"
    model: Facts = PATHWAY_X2
    dialect: ClassVar[ConsoleDialect] = DIALECT
    move_answer: ClassVar[MoveAnswer] = ANSWER
    asks_where: ClassVar[bool] = False
    lag_s: ClassVar[float] = LAG_S
    blank_lines: ClassVar[bool] = True
    feature_table: ClassVar[FeatureTable] = FEATURES
    hazards: ClassVar[HazardTable] = kin_hazards(DIALECT, PATHWAY_X2)
    commands: ClassVar[tuple[CommandDoc, ...]] = kin_commands(DIALECT.prompts)

    _stands: tuple[float, float] | None = None
    """Where its last move should have ended; None where that is not known."""
    _goes: tuple[float, float] | None = None
    """Where its last move leads; None unless both axes were sent."""
    _over_at: float = -math.inf
    """When both axes have reached where they go, at the latest."""

    def attach(self, link: Link, clock: Clock, **hooks: Unpack[SessionHooks]) -> None:
        """Speak over an open link: where it stands is not known."""
        super().attach(link, clock, **hooks)
        self._stands = self._goes = None
        self._over_at = -math.inf

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:
        """Send both axes as `TrkKin`. They may begin to move only with their answers, up to 15 s later each."""
        stands, goes, axes = self._stands, (az_deg, el_deg), (self.model.azimuth, self.model.elevation)
        self._stands = self._goes = None
        # From an unknown place the way is the longest. Across north it may go the other way round.
        ways = tuple(axis.max_deg - axis.min_deg for axis in axes)
        if stands is not None:
            ways = tuple(abs(there - here) for here, there in zip(stands, goes, strict=True))
        times_s = [self.lag_s + way_s(axis, way_deg) for axis, way_deg in zip(axes, ways, strict=True)]
        super().begin_slew(az_deg, el_deg, skew_deg)
        self._goes = goes
        self._over_at = self.clock.monotonic() + sum(times_s) / self.clock.rate

    def slew_is_over(self) -> bool:
        """Return whether both commands were answered, as `TrkKin`, and may have been executed: by time.

        Whether an answer comes with the execution or before it is open.
        """
        if not super().slew_is_over() or self.clock.monotonic() < self._over_at:
            return False
        self._stands = self._goes
        return True

    def _send_move(self, motor_id: int, degrees: float, busy_s: float) -> Taken:
        """Send one axis between two blank lines, and wait for as long as it may wait to answer."""
        self.console.run("mot", "")
        taken = super()._send_move(motor_id, degrees, busy_s + self.lag_s)
        self.console.run("mot", "")
        return taken

    def says_target(self, text: str) -> bool:
        """Return whether a line does nothing but say where the dish goes."""
        return self.move_answer.pattern.match(text.strip()) is not None

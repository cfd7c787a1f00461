"""What a command is judged by when its key comes, between two frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from birdcage.signal.source import SignalFacts
from birdcage.station.access import FaceSession
from birdcage.station.state import StationState

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shell.dishes import Dishes
from birdcage_tui.shell.motions import Motions
from birdcage_tui.shell.page_stage import PageStage

if TYPE_CHECKING:
    from birdcage.pursuit.now import DeskNow

    from birdcage_tui.shown.calibration import CalibrateNow
    from birdcage_tui.shown.horizon_state import HorizonState
    from birdcage_tui.shown.sky_picture import SkyPicture


class ContextHost(AppHost, Protocol):
    """The app, seen from what its commands are judged by."""

    session: FaceSession
    dishes: Dishes
    motions: Motions
    stage: PageStage


@dataclass(frozen=True, slots=True)
class LiveContext:
    """The station's state of one moment. All else is looked up only when a command asks for it: a frame has it all."""

    state: StationState
    _host: ContextHost

    @property
    def now(self) -> float:
        """Monotonic seconds."""
        return self._host.session.clock.monotonic()

    @property
    def asked(self) -> bool:
        """Whether something that you asked for is not at its end yet."""
        return bool(self._host.motions.under_way)

    @property
    def scopes(self) -> tuple[str, ...]:
        """Whose commands hold, innermost first."""
        return tuple(scope.scope for scope in self._host.stage.scopes())

    @property
    def track(self) -> DeskNow | None:
        """What the pursuit desk shows."""
        return self._host.track.now

    @property
    def heard(self) -> SignalFacts:
        """The source of the signal that is shown."""
        return self._host.signals.book.heard

    @property
    def via(self) -> str:
        """The program that drives the dish; empty where this one does itself."""
        return self._host.session.via

    @property
    def calibrate(self) -> CalibrateNow | None:
        """What the calibration shows."""
        return self._host.calibrate.now

    @property
    def sky(self) -> SkyPicture | None:
        """What is up, and which passes come."""
        return self._host.sky.now

    @property
    def several(self) -> bool:
        """Whether the app drives several dishes."""
        return self._host.dishes.several

    @property
    def has_map(self) -> bool:
        """Whether a map of the sky is open."""
        return self._host.maps.book.shown is not None

    @property
    def horizon(self) -> HorizonState:
        """The line of trees and roofs."""
        return self._host.horizon.state

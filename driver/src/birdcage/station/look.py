"""Looking at the dish: where it is, who it is, what it may do, what it hears."""

from __future__ import annotations

from birdcage.antenna.antenna import STILL_DEG, BirdcageAntenna
from birdcage.base.errors import CommandRefused, PositionUnknown
from birdcage.base.geometry import shortest_turn
from birdcage.protocol.model import Turn
from birdcage.protocol.types import Survey
from birdcage.station.board import Board
from birdcage.station.events import PositionRead
from birdcage.station.settings import StationSettings
from birdcage.station.state import Activity, Pointing, Search
from birdcage.station.watches import RSSI_ITERATIONS


class Look:
    """Reads from the dish onto the board. Every method may raise LinkError or NoReply."""

    def __init__(self, board: Board, antenna: BirdcageAntenna, settings: StationSettings) -> None:
        self._board, self._antenna, self._settings = board, antenna, settings
        self._surveyed = False

    def forget_survey(self) -> None:
        """The dish may be another one, or have other settings: read them again when the link comes up."""
        self._surveyed = False

    def forget(self, why: str) -> None:
        """The position and the turn of the cable no longer hold; `why` is for the board."""
        self._antenna.protocol.gate.forget("unread")
        self._board.change(position_lost=why, turn=self._turn())

    def unknown(self, unknown: PositionUnknown) -> None:
        """The dish does not know where it is."""
        homed = False if unknown.reason == "unhomed" else None
        self._board.change(homed=homed, position=None, position_lost=unknown.reason, turn=self._turn())

    def _turn(self) -> Turn:
        gate = self._antenna.protocol.gate
        return gate.model.turn if gate.cable_deg is None else Turn.COUNTED

    def first(self) -> None:
        """Look where the dish is, after the link came up."""
        self._antenna.protocol.enter_motor_menu()
        self.position()

    def position(self) -> Pointing | None:
        """Read where the dish is; None when it does not know: not homed, or released since."""
        try:
            true = self._antenna.get_position()
        except PositionUnknown as unknown:
            self.unknown(unknown)
            self._board.change(activity=Activity.IDLE)
            return None
        gate = self._antenna.protocol.gate
        dish = gate.position
        assert dish is not None, "it was read just now"
        at, utc = self._board.stamp()
        pointing = Pointing(
            true.azimuth, true.elevation, dish.azimuth, dish.elevation, at, utc, cable_deg=gate.cable_deg
        )
        self._board.change(position=pointing, position_lost=None, homed=True, turn=self._turn())
        self._board.tell(PositionRead(at, utc, pointing))
        return pointing

    @staticmethod
    def apart_deg(one: Pointing, other: Pointing) -> float:
        """Return the larger of the two axes' differences, azimuth the short way round."""
        turn = shortest_turn(other.dish_az_deg, one.dish_az_deg)
        return max(abs(turn), abs(one.dish_el_deg - other.dish_el_deg))

    def is_still(self, one: Pointing, other: Pointing) -> bool:
        """Return whether two readings are those of a dish at rest."""
        return self.apart_deg(one, other) <= STILL_DEG

    def signal(self) -> None:
        """Read the tuner's signal strength."""
        reading = self._antenna.protocol.get_rssi(RSSI_ITERATIONS)
        self._board.read("rssi", float(reading.average), "counts")

    @property
    def may_leave(self) -> bool:
        """Whether the console can leave its menu at once: else it would first have to wait for a quiet line."""
        return self._antenna.protocol.console.in_step

    @property
    def wants_survey(self) -> bool:
        """Whether identity and limits are to be read, and can be at once."""
        return self._settings.survey and not self._surveyed and self.may_leave

    def survey(self) -> None:
        """Read identity and limits, and come back to the motor menu."""
        try:
            survey = self._antenna.protocol.survey()
        except CommandRefused as refused:
            if refused.reason == "wrong_menu":
                raise
            survey = Survey()  # this dish does not tell: its model's limits hold
        self._board.forget_readings()
        for name, text in (*survey.settings.items(), *survey.identity.items()):
            self._board.read(name, text)
        self._board.change(
            firmware_version=survey.version,
            search={None: Search.UNKNOWN, True: Search.OFF, False: Search.UNKNOWN}[survey.search_disabled],
        )
        self.limit(survey)
        self._surveyed = True
        self._antenna.protocol.enter_motor_menu()

    def limit(self, survey: Survey) -> None:
        """Set the limits: the dish's own settings, or its model's where it does not tell, narrowed by the user's."""
        gate, offset = self._antenna.protocol.gate, self._antenna.alignment.el_offset_deg
        axis, user = gate.model.elevation, self._settings
        low = axis.min_deg if survey.el_min_deg is None else survey.el_min_deg
        high = axis.max_deg if survey.el_max_deg is None else survey.el_max_deg
        if user.min_elevation_deg is not None:
            low = max(low, user.min_elevation_deg)
        if user.max_elevation_deg is not None:
            high = min(high, user.max_elevation_deg)
        gate.update(el_min_deg=low, el_max_deg=high)
        self._board.change(el_min_deg=low + offset, el_max_deg=high + offset)

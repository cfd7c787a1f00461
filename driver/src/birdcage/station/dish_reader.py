"""Looking at the dish: where it is, who it is, what it may do, what it hears."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import timedelta
from functools import partial
from types import MappingProxyType

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.reckoning import ToldPosition
from birdcage.antenna.rest import STILL_DEG
from birdcage.base.errors import CommandRefused, OutOfRange, PositionUnknown
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.no_go import NoGoSector
from birdcage.base.reason import Reason
from birdcage.rotator import values
from birdcage.rotator.facts import CableTurn, Facts, SearchSwitch
from birdcage.rotator.feature import RSSI, VERSION, Reading, speed_of
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import laid_by_owner
from birdcage.rotator.values import Position, Survey
from birdcage.station.events import PositionRead
from birdcage.station.settings import Rules, StationSettings
from birdcage.station.signals import Signals
from birdcage.station.state import Activity, LimitSource, Pointing, TvSearch
from birdcage.station.state_store import StateStore


class DishReader:
    """Reads from the dish into the state. Every method may raise LinkError or NoReply."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, settings: StationSettings, signals: Signals
    ) -> None:
        self._store, self._antenna, self._settings, self._signals = store, antenna, settings, signals
        self._survey = Survey()
        self.rules: Rules = settings
        """The user's own limits, as they are now."""
        self.recall_zero: Callable[[], bool] = lambda: False
        """Takes up where the zeros of the machine point, if an earlier program has left that and it still holds."""
        self.elsewhere = False
        """Whether the console may be in another menu than the motors'."""

    def forget_survey(self) -> None:
        """The dish may be another one, or have other settings: read them again when the link comes up."""
        self._store.change(surveyed=False)
        self.note_speeds({})

    def forget(self, why: Reason) -> None:
        """The position and the turn of the cable no longer hold; `why` is for the state."""
        self._antenna.gate.forget(Reason.UNREAD)
        self._store.change(position_lost=why, position_text="", turn=self._turn())
        if self._antenna.rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP:
            # It may have been without power meanwhile, and then it searches again.
            self._store.change(search=TvSearch.UNKNOWN)

    def unknown(self, unknown: PositionUnknown) -> None:
        """The dish does not know where it points."""
        homed = False if unknown.reason in (Reason.UNHOMED, Reason.UNSYNCED) else None
        forgot = homed is False and self._store.state.homed is True
        said = str(unknown) if unknown.reason == Reason.UNREADABLE else ""
        self._store.change(
            homed=homed, position=None, position_lost=unknown.reason, position_text=said, turn=self._turn()
        )
        if forgot:
            self._signals.forgotten()

    def _turn(self) -> CableTurn:
        gate = self._antenna.gate
        if gate.cable_deg is None or gate.model.turn is CableTurn.REPORTED:
            return gate.model.turn
        return CableTurn.REMEMBERED if gate.remembers_cable else CableTurn.COUNTED

    def first(self) -> None:
        """Look where the dish is, after the link came up."""
        self._antenna.rotator.make_ready()
        self.position()

    def meet_untold(self) -> None:
        """Of a dish that does not tell where it is: see that it answers, once no move can be under way."""
        antenna = self._antenna
        if not antenna.strategy.reads_position and antenna.reckoning.moves_until <= self._store.clock.monotonic():
            antenna.rotator.meet()

    def position(self, *, glance: bool = False, heard: values.Look | None = None) -> Pointing | None:
        """Read where the dish is; None when it does not know: not homed, or released since.

        A `glance` is for a stream of targets: NoReply (`late`) where waiting would hold that up.
        `heard` is what the machine has told unasked: then nothing is asked that need not be.
        """
        antenna = self._antenna
        try:
            look = antenna.glance if glance else antenna.get_position
            true = look() if heard is None else antenna.hear(heard)
        except PositionUnknown as unknown:
            if unknown.reason is Reason.UNSYNCED and self.recall_zero():
                return self.position(glance=glance)
            self.elsewhere = False
            self.unknown(unknown)
            moves = self._antenna.reckoning.moves_until > self._store.clock.monotonic()
            self._store.change(activity=Activity.UNKNOWN if moves else Activity.IDLE)
            return None
        self.elsewhere = False
        gate = self._antenna.gate
        dish = gate.position
        assert dish is not None, "it was read just now"
        self._signals.position_read()
        at, utc = self._store.stamp()
        told, word = self._antenna.strategy.reads_position, self._antenna.reckoning.word
        if not told and word is not None:
            return self.told(word)
        pointing = Pointing(
            wrap_360(true.azimuth), true.elevation, dish.azimuth, dish.elevation, at, utc, cable_deg=gate.cable_deg,
            skew_deg=dish.skew, modelled=not told, read_at=None if told else antenna.reckoning.since,
            uncertainty_deg=None if told else antenna.strategy.uncertainty_deg(self._store.clock),
        )  # fmt: skip
        homed = True if told else None  # where it should be does not tell that it knows its reference
        self._store.change(position=pointing, position_lost=None, position_text="", homed=homed, turn=self._turn())
        self._store.tell(PositionRead(at, utc, pointing))
        return pointing

    def modelled(self) -> Pointing | None:
        """Show where the model has the dish while nothing may be asked; None, and nothing is shown, at rest.

        One that tells where it is while it moves is shown where it was told to be.
        """
        motion, clock, before = self._antenna.motion, self._store.clock, self._store.state.position
        if motion is not None and (told := self._antenna.reckoning.told_in(motion)) is not None:
            return self.told(told)
        if motion is None or not motion.start_known:
            return None
        at, utc = self._store.stamp()
        dish = motion.at(at, clock.rate)
        az_deg, el_deg = self._antenna.alignment.to_true(dish.azimuth, dish.elevation)
        pointing = Pointing(
            wrap_360(az_deg), el_deg, dish.azimuth, dish.elevation, at, utc,
            skew_deg=before.skew_deg if before is not None and dish.skew is None else dish.skew,
            modelled=True, read_at=motion.azimuth.started if before is None else before.told_at,
            uncertainty_deg=self._antenna.strategy.uncertainty_deg(clock),
        )  # fmt: skip
        self._store.change(position=pointing)
        return pointing

    def told(self, told: ToldPosition) -> Pointing:
        """Show where a dish that does not tell at rest was while it moved, by its own word; nothing counts with it."""
        dish, shown = told.position, self._store.state.position
        if shown is not None and not shown.modelled and shown.at == told.at:
            return shown
        at, utc = self._store.stamp()
        utc -= timedelta(seconds=(at - told.at) * self._store.clock.rate)
        az_deg, el_deg = self._antenna.alignment.to_true(dish.azimuth, dish.elevation)
        pointing = Pointing(wrap_360(az_deg), el_deg, dish.azimuth, dish.elevation, told.at, utc)
        self._store.change(position=pointing, position_lost=None, position_text="")
        self._store.tell(PositionRead(told.at, utc, pointing))
        return pointing

    def swept(self, dish: Position) -> Pointing:
        """Take in, and show, where a dish that sweeps by itself has told that it is."""
        gate = self._antenna.gate
        gate.see(dish)
        at, utc = self._store.stamp()
        az_deg, el_deg = self._antenna.alignment.to_true(dish.azimuth, dish.elevation)
        pointing = Pointing(
            wrap_360(az_deg), el_deg, dish.azimuth, dish.elevation, at, utc, cable_deg=gate.cable_deg,
            skew_deg=dish.skew,
        )  # fmt: skip
        self._store.change(position=pointing)
        self._store.tell(PositionRead(at, utc, pointing))
        return pointing

    @staticmethod
    def apart_deg(one: Pointing, other: Pointing) -> float:
        """Return the largest of the axes' differences, azimuth the short way round."""
        turn = shortest_turn(other.dish_az_deg, one.dish_az_deg)
        skew = 0.0 if one.skew_deg is None or other.skew_deg is None else one.skew_deg - other.skew_deg
        return max(abs(turn), abs(one.dish_el_deg - other.dish_el_deg), abs(skew))

    def is_still(self, one: Pointing, other: Pointing) -> bool:
        """Return whether two readings are those of a dish at rest."""
        return self.apart_deg(one, other) <= STILL_DEG

    def signal(self) -> None:
        """Read the tuner's signal strength."""
        self.features([RSSI])

    def features(self, ids: Sequence[str]) -> Mapping[str, Reading]:
        """Read features, show and return what was told: also what the same answers told of others.

        CommandRefused and NoReply (`garbage`, `no_row`) where the machine does not tell.
        """
        readings = self._antenna.rotator.read(ids)
        self.note(readings)
        return readings

    def not_before(self, feature: str) -> float:
        """When the machine may be asked for a feature again, in monotonic seconds."""
        last = self._store.state.readings.get(feature)
        return -math.inf if last is None else last.at + self._antenna.rotator.features[feature].cost.min_interval_s

    def note(self, readings: Mapping[str, Reading]) -> None:
        """Show what features the machine has just told."""
        for name, reading in readings.items():
            self._store.read(name, reading.value, reading.unit, (reading.at, reading.utc))

    def clear_up(self) -> None:
        """Account for what an earlier program may have sent, so that the survey need not wait for a quiet line."""
        if self._settings.survey and not self._store.state.surveyed:
            self._antenna.rotator.catch_up()

    @property
    def may_leave(self) -> bool:
        """Whether the console can leave its menu at once: else it would first have to wait for a quiet line."""
        return self._antenna.rotator.line.is_settled

    @property
    def wants_survey(self) -> bool:
        """Whether identity and limits are to be read, and can be at once."""
        return self._settings.survey and not self._store.state.surveyed and self.may_leave

    def survey(self) -> None:
        """Read identity and limits, and come back to the motor menu."""
        try:
            survey = self._antenna.rotator.survey()
        except CommandRefused as refused:
            if refused.reason == Reason.WRONG_MENU:
                raise
            survey = Survey()  # this dish does not tell: its model's limits hold
        self._store.forget_readings()
        for name, text in (*survey.settings.items(), *survey.identity.items()):
            self._store.read(name, text)
        features = self._antenna.rotator.features
        for name in sorted(survey.features.keys() & features.keys()):
            self._store.read(name, survey.features[name], features[name].unit)
        axes, told = self._antenna.rotator.facts.axes, survey.features
        speeds = {axis.index: told[speed_of(axis.name)] for axis in axes if speed_of(axis.name) in told}
        self._antenna.use_speeds({motor: float(speed) for motor, speed in speeds.items()})
        version = survey.features.get(VERSION)
        self._store.change(firmware_version=None if version is None else str(version))
        if self._antenna.rotator.facts.search_switch is SearchSwitch.FOR_GOOD:
            self._store.change(search=TvSearch.OFF if survey.search_disabled else TvSearch.UNKNOWN)
        elif self._antenna.rotator.facts.search_switch is SearchSwitch.NEVER_SEARCHES:
            self._store.change(search=TvSearch.NONE)
        self.limit(survey)
        try:
            self._antenna.rotator.make_ready()
        finally:
            # Last: who waits for it may close the port, and a dish that is left in a menu costs the next one time.
            self._store.change(surveyed=True)

    def learn(self, facts: Facts) -> None:
        """Take what the machine itself has told that it is; what its owner laid down lies over that, too."""
        self._antenna.rotator.facts, _wrong = laid_by_owner(facts, self._settings.own_facts)
        self.take_facts()

    def tell_zero(self, zero_deg: Mapping[str, float] | None) -> None:
        """From now on the zeros of the machine point there; None: not known."""
        self._antenna.rotator.tell_zero(zero_deg)
        self._antenna.gate.forget(Reason.UNSYNCED)
        self.take_facts()

    def take_facts(self) -> None:
        """Go by the facts that the machine has now."""
        antenna = self._antenna
        antenna.gate.model = antenna.rotator.facts
        antenna.know(antenna.own)
        antenna.doubt()
        self._store.change(dish=antenna.kind, turn=self._turn(), unplanned_stop=antenna.strategy.unplanned)
        self.limit()

    def set_speed(self, motor: int, speed_deg_s: float) -> float:
        """Set the greatest speed of an axis, plan with it, and return what is in force, read back.

        CommandRefused where the machine shows another one: then it is not known.
        """
        rotator = self._antenna.rotator
        known = {axis: speed for axis, speed in self._antenna.speeds_deg_s.items() if axis != motor}
        try:
            reading = rotator.write(speed_of(rotator.facts.numbered[motor].name), speed_deg_s)
        except OutOfRange:
            raise  # nothing was sent
        except CommandRefused:
            self.note_speeds(known)
            raise
        self.note_speeds(known | {motor: float(reading.value)})
        return float(reading.value)

    def note_speeds(self, speeds: Mapping[int, float]) -> None:
        """Plan with the speeds that are in force, and show them; what is not among them is not known."""
        self._antenna.use_speeds(speeds)
        self._store.forget_readings("speed.")
        for motor, speed in speeds.items():
            self._store.read(speed_of(self._antenna.rotator.facts.numbered[motor].name), speed, "deg/s")

    def limit(self, survey: Survey | None = None) -> None:
        """Set the limits: the dish's own settings, or its model's where it does not tell, narrowed by the user's.

        Without a survey, by the last one.
        """
        if survey is not None:
            self._survey = survey
        gate, offset, told = self._antenna.gate, self._antenna.alignment.el_offset_deg, self._survey
        axis, cable, user = gate.model.elevation, gate.model.cable, self.rules
        whose = partial(_whose, gate.model)
        low = SourcedLimit.of(told.el_min_deg, axis.min_deg, whose("elevation.min_deg"))
        high = SourcedLimit.of(told.el_max_deg, axis.max_deg, whose("elevation.max_deg"))
        if whose("elevation.min_deg") is LimitSource.USER:
            low = low.at_least(axis.min_deg)
        if whose("elevation.max_deg") is LimitSource.USER:
            high = high.at_most(axis.max_deg)
        low, high = low.at_least(user.min_elevation_deg), high.at_most(user.max_elevation_deg)
        limits = {"el_min": low, "el_max": high}
        if cable is not None:
            limits["cable_min"] = SourcedLimit(cable.min_deg, whose("cable.min_deg")).at_least(user.cable_min_deg)
            limits["cable_max"] = SourcedLimit(cable.max_deg, whose("cable.max_deg")).at_most(user.cable_max_deg)
        gate.update(
            el_min_deg=low.deg, el_max_deg=high.deg, cable_min_deg=user.cable_min_deg, cable_max_deg=user.cable_max_deg,
            sectors=tuple(self._antenna.alignment.sector_to_dish(*sector) for sector in user.sectors),
        )  # fmt: skip
        points = gate.model.points
        self._store.change(
            el_min_deg=low.deg + offset if points else None, el_max_deg=high.deg + offset if points else None,
            cable_min_deg=limits["cable_min"].deg if cable else None,
            cable_max_deg=limits["cable_max"].deg if cable else None,
            no_go_sectors=tuple(NoGoSector(*sector) for sector in user.sectors),
            limit_sources=MappingProxyType({name: limit.source for name, limit in limits.items()}),
        )  # fmt: skip


def _whose(model: Facts, name: str) -> LimitSource:
    return LimitSource.USER if model.origin_of(name) is Origin.USER else LimitSource.MODEL


@dataclass(frozen=True, slots=True)
class SourcedLimit:
    """One limit in degrees, and whose it is."""

    deg: float
    source: LimitSource

    @classmethod
    def of(cls, told_deg: float | None, model_deg: float, whose: LimitSource) -> SourcedLimit:
        """Return what the dish told, or else its model's, and `whose` that is."""
        return cls(model_deg, whose) if told_deg is None else cls(told_deg, LimitSource.DISH)

    def at_least(self, user_deg: float | None) -> SourcedLimit:
        """Return the higher of this and the user's."""
        return self if user_deg is None or user_deg <= self.deg else SourcedLimit(user_deg, LimitSource.USER)

    def at_most(self, user_deg: float | None) -> SourcedLimit:
        """Return the lower of this and the user's."""
        return self if user_deg is None or user_deg >= self.deg else SourcedLimit(user_deg, LimitSource.USER)

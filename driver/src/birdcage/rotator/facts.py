"""What a machine is and can do, as data: every language declares its `Facts`, and every face reads them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property

from birdcage.base.beam import Reflector
from birdcage.rotator.axis import Axis, CableRange, Role
from birdcage.rotator.feature import RSSI, Feature, speed_of
from birdcage.rotator.ladder import MoveKind, Rung, StopMeans
from birdcage.rotator.mapping import SkyMapping, mapped_axes
from birdcage.rotator.origin import Origin
from birdcage.rotator.own_settings import SettingKnown
from birdcage.rotator.sweep import OwnSweep
from birdcage.rotator.wiring import Adapter, Connector

MOST_AXES = 3


class CableTurn(Enum):
    """How well the turn of the cable is known (`docs/decisions/0027-remembered-turn.md`)."""

    REPORTED = "reported"
    """The azimuth that is read is the turn of the cable, beyond the circle."""
    COUNTED = "counted"
    """From a homing that this program saw."""
    REMEMBERED = "remembered"
    """Counted when it was last left, and the dish stands where it stood then."""
    UNKNOWN = "unknown"


class Readback(Enum):
    """When it tells where it is."""

    ALWAYS = "always"
    """Whenever it is asked, or of its own accord."""
    MOVING = "moving"
    """Only while its motors run, of its own accord. At rest it is reckoned from its moves, and never called confirmed.
    """
    NEVER = "never"
    """Nothing tells. It is reckoned from its moves throughout."""


class SecondMove(Enum):
    """What the command of a move does while a motor still runs."""

    RETARGET = "retarget"
    """It is taken at once."""
    QUEUE = "queue"
    """It is answered, and waits for the motor."""
    BLOCK = "block"
    """The shell waits for the motor, and answers nothing meanwhile."""
    UNKNOWN = "unknown"

    @property
    def waits(self) -> bool:
        """Whether the move begins only when the motor stands."""
        return self in (SecondMove.QUEUE, SecondMove.BLOCK)


class SearchSwitch(Enum):
    """How the firmware's own TV search is switched off."""

    FOR_GOOD = "for good"
    """By a setting, which holds from the next power-up on."""
    UNTIL_POWER_UP = "until power-up"
    """By ending it while it runs; it begins again at each power-up."""
    NOT_KNOWN = "not known"
    """No command is known that ends it, nor a setting that can be recommended."""
    NEVER_SEARCHES = "never searches"
    """It has no search: it moves when it is told to, and never by itself."""


@dataclass(frozen=True, slots=True)
class Setting:
    """A setting that the machine keeps itself, and that `Rotator.survey` may read."""

    id: str
    """As `Survey.settings` has it."""
    label: str
    """As a person finds it in the machine's own papers."""


@dataclass(frozen=True, slots=True)
class SearchSetting(Setting):
    """The one that switches the firmware's TV search off for good."""

    name: str
    """What the machine itself calls it."""
    off: str
    """What it prints as its value while the search is off."""
    on: str


@dataclass(frozen=True, slots=True)
class SilentSlew:
    """All axes are sent in one go: while they move nothing is asked, and the position is modelled.

    Whether anything ends it before its target the ladder of STOP says: on some machines any byte, on others nothing.
    """

    least_deg: float
    """An axis that has further to go than this is sent by it, as a queued move cannot be called back
    (`docs/decisions/0011-queued-dish.md`)."""


@dataclass(frozen=True, slots=True)
class Handling:
    """What a person at the dish has to know of it as a machine: sentences from its papers, empty if none is known.

    `docs/safety.md` has them all, with who says so.
    """

    clearance: str = ""
    """What must keep away from it."""
    weight: str = ""
    coax: str = ""
    """What voltage its coax carries, and what that forbids."""
    north: str = ""
    """How its base is marked."""
    home_remedies: Mapping[str, str] = field(default_factory=dict)
    """What helps an axis that fails to home, by the name of the axis."""
    reversed_remedies: Mapping[str, str] = field(default_factory=dict)
    """What helps an axis that turns the other way than it should, by the name of the axis."""
    stow_by_hand: str = ""
    """How it is folded when its electronics are dead."""
    supply: str = ""
    """What it is fed with."""


def _no_axis(role: Role, span_deg: float) -> Axis:
    """Return what stands for an axis that a machine has not: nothing is sent to it (`Facts.points`)."""
    return Axis(role.value, role, 0.0, span_deg, 1.0, 1.0, 0.1, speed_known=False)


@dataclass(frozen=True, kw_only=True)
class Facts:
    """A dish. What it lacks is None or False here, and every face greys it out and says why.

    What is asked at every move is worked out once, from facts that never change: `cached_property`.
    """

    name: str
    firmware: str
    baud: int
    """0 of a machine that is not at the end of a serial line."""
    any_baud: bool = False
    """Whether it answers at every rate: a serial line over USB may have none of its own."""
    axes: tuple[Axis, ...]
    """One to three, each with a name of its own."""
    azimuth: Axis = field(init=False, repr=False, compare=False)
    """The axis of that role. Of a machine with a mapping: the azimuths that it reaches by that. See `points` else."""
    elevation: Axis = field(init=False, repr=False, compare=False)
    """As above."""
    skew: Axis | None = field(init=False, repr=False, compare=False)
    """The axis that turns the feed about the beam; None if there is none."""
    cable: CableRange | None
    turn: CableTurn
    second_same: SecondMove
    """What a second move does on the axis that moves."""
    second_other: SecondMove
    """What it does on the other one."""
    stop_ladder: tuple[Rung, ...]
    slew: SilentSlew | None
    """How long ways are gone; None if each axis is always sent by itself."""
    search_switch: SearchSwitch
    homing_s: float | None
    """The longest that homing one axis takes; None when it homes only by itself, or never."""
    never_homes: bool = False
    """Whether it has no homing at all: it knows where it is as soon as it has power, is synced by a person, or
    tells nothing."""
    zero_at_power_up: tuple[str, ...] = ()
    """The axes, by name, whose zero is where they stood when it was switched on: only a person can say where that
    points (`birdcage sync`). Its `Rotator.look` tells them as it counts them."""
    zero_deg: Mapping[str, float] = field(default_factory=dict)
    """Where those zeros point, in degrees by name, once a person has synced it; empty before. The range of the cable
    and of an elevation count with it."""
    boot_s: float
    """The longest that a boot takes; waiting for it never lasts longer unless asked."""
    has_motor_power: bool = False
    """Whether its motors can be released and engaged by command."""
    has_stow: bool = False
    sweep: OwnSweep | None = None
    """Whether it can sweep an axis by itself and tell the signal meanwhile; `no_sweep` says so of one that can't."""
    readback: Readback
    least_look_interval_s: float | None = None
    """How long it is left alone between two questions where it is, in seconds of the wire; None where any rate will do.

    Whoever watches, follows or stops it asks no oftener.
    """
    least_line_interval_s: float | None = None
    """The least time from one line that moves it, or asks where it is, to the next, in seconds of the wire; None where
    none comes too fast.

    What is planned or forecast counts with it.
    """
    power_switch: str
    """What a person switches off where no STOP helps: `12 V switch`, `power switch`."""
    reflector: Reflector | None = None
    """As sold; None if its size is not known. It makes the beam, together with the feed."""
    cable_known: bool = True
    """Whether that is known; without a `cable` then, nothing winds up."""
    moves_one_axis: bool = True
    """Whether azimuth and elevation can each be sent by itself; else both are, by a slew or by a mapping."""
    drives_on: bool = False
    """Whether it goes on driving an axis that is blocked, and so moves by itself once that is free, until it is stopped
    or sent elsewhere. A console gives such a move up itself."""
    sends_together: bool = False
    """Whether azimuth and elevation are sent in one call where both change; else in two, one after the other."""
    mapping: SkyMapping | None = None
    """How its axes point to the sky, where it has no azimuth and elevation of its own; None where it is not known."""
    mapping_lacks: str = ""
    """What that waits for, as a sentence that says what to do: `Set your location.`"""
    handling: Handling = Handling()
    tells_version: bool = False
    """Whether a command is known that tells the version of its firmware; if not, it is what its console speaks."""
    type_field: str = ""
    """Which field of its identity (`Survey.identity`) names its type; empty if none does."""
    floor_settings: tuple[Setting, ...] = ()
    """Where it keeps its lowest elevation: the greatest of them counts."""
    ceiling_settings: tuple[Setting, ...] = ()
    """Where it keeps its highest elevation, if that is told."""
    search_setting: SearchSetting | None = None
    features: Mapping[str, Feature] = field(default_factory=dict)
    """What it tells and lets be set besides its position, by id; `Rotator.read` and `Rotator.write` do it."""
    has_own_settings: bool = False
    """Whether it keeps settings in a memory of its own that can be read and changed: `Rotator.own_settings`."""
    settings_known: Mapping[int, SettingKnown] = field(default_factory=dict)
    """What sources tell of the rows of that memory, by index."""
    console_only: Mapping[str, str] = field(default_factory=dict)
    """What of a page of features (`FeaturePage.value`) stays in its raw console, and why, in sentences."""
    settings_name: str = "settings"
    """What the machine calls the table of its settings: its backups are named by it."""
    rotctld_name: str = ""
    """What clients of Hamlib's network protocol are told that it is; empty: its name."""
    connectors: tuple[Connector, ...] = ()
    """Its plugs; none where it is not reached by a cable, or no source draws it."""
    adapters: tuple[Adapter, ...] = ()
    """The adapters that were used with it."""
    origin: Mapping[str, Origin] = field(default_factory=dict)
    """Who stands for each fact, by its flat name (`listed_facts`); a fact that is missing has no source."""

    def __post_init__(self) -> None:
        """Look the axes up by their roles. ValueError for axes that nothing could name, or go by."""
        if not 1 <= len(self.axes) <= MOST_AXES or len({axis.name for axis in self.axes}) < len(self.axes):
            raise ValueError(f"The {self.name} needs one to three axes, each with a name of its own.")
        by_role = {axis.role: axis for axis in self.axes}
        roles = [axis.role for axis in self.axes if axis.role is not Role.ARC]
        if len(set(roles)) < len(roles):
            raise ValueError(f"Two axes of the {self.name} have the same role.")
        if self.mapping is not None:
            sky = mapped_axes(self.axes, self.mapping)
        else:
            sky = by_role.get(Role.AZ, _no_axis(Role.AZ, 360.0)), by_role.get(Role.EL, _no_axis(Role.EL, 90.0))
        for name, axis in (("azimuth", sky[0]), ("elevation", sky[1]), ("skew", by_role.get(Role.SKEW))):
            object.__setattr__(self, name, axis)

    def with_axes(self, *others: Axis) -> Facts:
        """Return the facts with other axes in the place of those of the same names."""
        named = {axis.name: axis for axis in others}
        return replace(self, axes=tuple(named.get(axis.name, axis) for axis in self.axes))

    def told_zero(self, zero_deg: Mapping[str, float]) -> Facts:
        """Return the facts of a machine whose zeros point there: all angles that it counts are raised by as much."""
        az_deg, el_deg = (zero_deg.get(axis.name, 0.0) for axis in (self.azimuth, self.elevation))
        cable, tilt = self.cable, self.elevation
        if cable is not None:
            cable = CableRange(cable.min_deg + az_deg, cable.max_deg + az_deg)
        told = replace(self, zero_deg=dict(zero_deg), cable=cable)
        if not el_deg:
            return told
        return told.with_axes(replace(tilt, min_deg=tilt.min_deg + el_deg, max_deg=tilt.max_deg + el_deg))

    def origin_of(self, name: str) -> Origin | None:
        """Return who stands for a fact; None if it has no source."""
        return self.origin.get(name)

    @property
    def has_rssi(self) -> bool:
        """Whether it tells the signal strength of a tuner of its own."""
        return RSSI in self.features

    @cached_property
    def has_speeds(self) -> bool:
        """Whether the greatest speed of an axis can be read and lowered; `Axis.speed_deg_s` is the most it can do."""
        return any(speed_of(axis.name) in self.features for axis in self.axes)

    @property
    def homing_stoppable(self) -> bool:
        """Whether STOP is known to end its homing; else only a person at its switch does."""
        return any(MoveKind.HOME in rung.ends and rung.ends_what_it_is_busy_with for rung in self.stop_ladder)

    @property
    def ends_search(self) -> bool:
        """Whether a source says of such machines that a program can end their TV search; else it may be tried."""
        ends = (rung for rung in self.stop_ladder if MoveKind.SEARCH in rung.ends)
        return any(rung.proven and rung.means is not StopMeans.POWER for rung in ends)

    def bits_s(self, bits: float) -> float:
        """Return how long so many bits take on its line; no time where it has none."""
        return bits / self.baud if self.baud else 0.0

    @property
    def tells_at_rest(self) -> bool:
        """Whether where it stands can be known from itself."""
        return self.readback is Readback.ALWAYS

    @cached_property
    def axes_together(self) -> bool:
        """Whether both axes are known to move at once."""
        return not self.second_other.waits

    @cached_property
    def moves_in_turn(self) -> bool:
        """Whether it is sent one move at a time: it waits for the one before, or has a mapping."""
        return self.mapping is not None or self.second_same.waits or self.second_other.waits

    @cached_property
    def points(self) -> bool:
        """Whether it can be sent to an azimuth and an elevation; else those two axes only stand for what it lacks."""
        return self.mapping is not None or {Role.AZ, Role.EL} <= {axis.role for axis in self.axes}

    @property
    def no_homing(self) -> str:
        """Why it is not homed by command, and what to do instead; empty if it can be."""
        if self.homing_s is not None:
            return ""
        if self.never_homes:
            return f"The {self.name} has no homing. {self.must_be_synced}".rstrip()
        return f"The {self.name} homes only at power-up. Switch it off and on."

    @property
    def must_be_synced(self) -> str:
        """How it comes to know where it points, where only a person can say; empty where it knows by itself."""
        if not self.zero_at_power_up:
            return ""
        return "It counts from where it was switched on. Sync it: `birdcage sync AZ EL` says where it points."

    @property
    def no_sync(self) -> str:
        """Why it is not synced; empty if it can be."""
        return "" if self.zero_at_power_up else f"The {self.name} knows by itself where it points."

    @property
    def no_sweep(self) -> str:
        """Why it is not told to sweep by itself, and what to do instead; empty if it can be."""
        return "" if self.sweep is not None else f"The {self.name} has no sweep of its own. Sweep it by steps."

    @cached_property
    def no_direction(self) -> str:
        """Why it cannot be sent to an azimuth and an elevation, and what helps; empty if it can."""
        if self.points:
            return ""
        return f"The {self.name} has no azimuth and elevation. {self.mapping_lacks}".strip()

    @cached_property
    def no_following(self) -> str:
        """Why it follows nothing, and what helps; empty if it can."""
        if self.mapping is None:
            return self.no_direction
        along = "one axis along an arc" if len(self.axes) == 1 else "axes of its own"
        return f"The {self.name} turns {along}, so it follows no pass. Send it to a single direction."

    @cached_property
    def numbered(self) -> Mapping[int, Axis]:
        """Azimuth, elevation and skew by their numbers above the seam (`Axis.index`)."""
        return {axis.index: axis for axis in (self.azimuth, self.elevation, self.skew) if axis is not None}

    @cached_property
    def named(self) -> Mapping[str, Axis]:
        """The machine's own axes by the names that the seam calls them by."""
        return {axis.name: axis for axis in self.axes}

"""What a machine tells, and lets be set, besides its position: one table, from which the faces are made."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from enum import Enum

from birdcage.base.errors import OutOfRange

Value = float | str | bool

RSSI = "rssi"
"""The signal strength of the machine's own tuner."""
LOCK, SNR, NETWORK = "lock", "snr", "network"
"""Whether that tuner has locked, its signal-to-noise ratio in dB, and whose transponder it hears."""
TRANSPONDER = "transponder"
"""Which channel of its list the tuner is set to."""
EVEN_LEVEL, ODD_LEVEL = "even_level", "odd_level"
"""The signal strength of the channels of either polarisation, where the machine hears both in turn."""
NO_NETWORK = "none"
"""The value of `NETWORK` where none is heard."""
VERSION = "version"
"""Of its firmware."""
SETTINGS = "settings"
"""All its settings, as printed."""
TV_SEARCH = "tv_search"
"""Whether it searches for TV satellites by itself from the next power-up on."""
END_TV_SEARCH = "end_tv_search"
"""Ends that search while it runs; it begins again at the next power-up."""
ENABLE_LNA = "enable_lna"
"""Switches the supply of the LNB on, at the coax of the machine's own tuner."""
DISEQC = "diseqc"
"""A message to what hangs on the coax of the machine's own tuner, typed in hex (`birdcage.coax`)."""
DRIVER = "driver"
"""How the id of a motor driver's own judgement begins; the name of the axis follows: `driver.azimuth`."""
LNB_SUPPLY, POLARISATION = "lnb_supply", "polarisation"
"""The supply of the LNB in volts, and which polarisation (H or V) the tuner is set to."""
SLEEP_TIMER = "sleep_timer"
"""After how many seconds without work it sleeps; 0: never."""
FLOOR, CEILING = "floor", "ceiling"
"""The lowest and the highest elevation that its settings allow, in degrees; of several each has a suffix."""
LIMITING = (FLOOR, CEILING, TV_SEARCH)
"""Settings, each with its suffixes, that limit motion or start it: a change of one between two days is told."""
POSITION = "position"
"""What faces watch for where a machine points. It is no feature: none may have this id."""
HEALTH = "health"
"""What faces watch for all features that tell how well a machine is (`Feature.health`). None may have this id."""
WELL_FORMED = re.compile(r"[a-z][a-z0-9_]*(\.[a-z0-9][a-z0-9_]*)*")
"""How an id is written: small letters, digits and underscores; points part a name from what it belongs to."""


def speed_of(axis: str) -> str:
    """Return the id of the greatest speed of an axis, by the axis' name."""
    return f"speed.{axis}"


class FeatureKind(Enum):
    """What a value is."""

    NUMBER = "number"
    TEXT = "text"
    LINES = "lines"
    """Text of several lines, as the machine prints it."""
    SWITCH = "switch"
    """True or false."""
    MOMENTARY = "momentary"
    """No value at all: writing it does something, and nothing can be read."""
    HELD = "held"
    """A number that drives a motor without end: it runs only while it is asked for, again and again (`Feature.held`).
    """


class Writer(Enum):
    """How a value is written, and how long it then holds."""

    NONE = "read only"
    UNTIL_RESTART = "until restart"
    FROM_POWER_UP = "from power-up"
    """It is saved, and in force from the next power-up on."""
    AT_ONCE = "at once"
    """It is done, and over."""
    WHILE_HELD = "while held"
    """The machine itself would go on: whoever writes it has to send STOP."""


class FeaturePage(Enum):
    """Which part of a machine a feature tells of: a page of its own in the faces."""

    HARDWARE = "hardware"
    MOTORS = "motors"
    RECEIVER = "receiver"
    SETTINGS = "settings"


@dataclass(frozen=True, slots=True)
class Range:
    """The least and the greatest value, in the feature's unit; infinite where there is none."""

    low: float = -math.inf
    high: float = math.inf

    def holds(self, value: float) -> bool:
        """Return whether a value lies within."""
        return self.low <= value <= self.high

    def __str__(self) -> str:
        """Return it for a person."""
        if math.isinf(self.low):
            return f"up to {self.high:.4g}"
        return f"from {self.low:.4g}" if math.isinf(self.high) else f"{self.low:.4g} to {self.high:.4g}"


@dataclass(frozen=True, slots=True)
class Cost:
    """What reading or writing it takes on the line."""

    lines: int = 1
    """How many lines are sent at most, changes of the menu not counted."""
    menu: str | None = None
    """Where that is done; None on a machine without menus, or where any will do."""
    min_interval_s: float = 0.0
    """How long the machine is left alone between two reads; until then the last reading stands."""
    while_moving: bool = False
    """Whether it may be read while the machine moves."""


@dataclass(frozen=True, slots=True)
class HealthMark:
    """That a feature tells how well the machine is: how it is called in a list of such, and how often it is read."""

    label: str
    """One or two short words."""
    every_s: float = 30.0
    """How often it is read for that, in seconds; `Cost.min_interval_s` holds as well."""
    good: tuple[Value, ...] = ()
    """What it tells of a machine that is well; empty where no value says so."""

    def is_good(self, value: Value) -> bool | None:
        """Return whether a value tells of a machine that is well; None where it says neither."""
        return value in self.good if self.good else None


@dataclass(frozen=True, slots=True)
class HeldMotor:
    """Which motor a feature drives while it is held. Greater values turn it towards greater angles, if wired so."""

    axis: str
    """By its name."""
    value: float
    """What it is run at unless somebody asks for more, in the feature's unit: little."""


@dataclass(frozen=True, slots=True)
class Feature:
    """One row of the table."""

    id: str
    label: str
    unit: str = ""
    """Empty for what has none."""
    kind: FeatureKind = FeatureKind.NUMBER
    range: Range | None = None
    """Of a number; None if it is not known."""
    writer: Writer = Writer.NONE
    hazard: str = ""
    """The consequence of writing it, which a person has to agree to; empty if none is asked."""
    cost: Cost = field(default_factory=Cost)
    told: bool = True
    """Whether the machine tells it when asked. If not, it can only be set; its answer to that is all that it tells."""
    samples: int = 1
    """How many measurements the machine averages in one reading."""
    health: HealthMark | None = None
    """How it tells how well the machine is; None for what does not."""
    note: str = ""
    """What a person should know who reads or writes it, in sentences."""
    read_hazard: str = ""
    """The consequence of reading it, which a person has to agree to; empty for what only tells."""
    page: FeaturePage | None = None
    """Where the faces show it; None for what belongs to none of the pages."""
    group: str = ""
    """The heading under which it stands there; groups stand in the order of the table."""
    asked: str = ""
    """What the machine is asked for it, as a person would type it in its console: `A3981> diag`.

    Of what can only be set: what sets it. Empty where no such line is known.
    """
    held: HeldMotor | None = None
    """What it drives, of a kind that is `HELD`. Its range ends where the axis goes at its full speed."""

    @property
    def is_readable(self) -> bool:
        """Whether the machine can be asked for it."""
        return self.told and self.kind is not FeatureKind.MOMENTARY

    @property
    def is_writable(self) -> bool:
        """Whether it can be written."""
        return self.writer is not Writer.NONE

    def check(self, value: Value) -> None:
        """Raise OutOfRange, which names number, limit and remedy, for a value that this can't be set to."""
        if self.kind is FeatureKind.MOMENTARY:
            if value is not True:
                raise OutOfRange(f"{self.label} takes no value, and {value!r} was given. Nothing was sent.")
        elif self.kind is FeatureKind.SWITCH:
            if not isinstance(value, bool):
                raise OutOfRange(f"{self.label}: {value!r} is neither on nor off. Nothing was sent.")
        elif self.kind in (FeatureKind.NUMBER, FeatureKind.HELD):
            self._check_number(value)
        elif self.kind is FeatureKind.TEXT and not (isinstance(value, str) and value.isprintable()):
            raise OutOfRange(f"{self.label}: {value!r} is no line of plain text. Nothing was sent.")

    def _check_number(self, value: Value) -> None:
        if isinstance(value, bool | str) or not math.isfinite(value):
            raise OutOfRange(f"{self.label} is {value!r}, which is no number. Nothing was sent.")
        if self.range is None or self.range.holds(value):
            return
        limit = self.range.low if value < self.range.low else self.range.high
        raise OutOfRange(
            f"{self.label}: {value:g}{self._unit} is {abs(value - limit):.6g}{self._unit} beyond its limit of "
            f"{limit:g}{self._unit}. Nothing was sent. Give {self.range}{self._unit}."
        )

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""


@dataclass(frozen=True, slots=True)
class Reading:
    """One value that a machine told."""

    value: Value
    unit: str
    at: float
    """When it was so: monotonic seconds."""
    utc: datetime


def by_id(features: Iterable[Feature]) -> Mapping[str, Feature]:
    """Return features by their ids. ValueError where two have the same."""
    found: dict[str, Feature] = {}
    for each in features:
        if each.id in found:
            raise ValueError(f"two features are called {each.id!r}")
        found[each.id] = each
    return found

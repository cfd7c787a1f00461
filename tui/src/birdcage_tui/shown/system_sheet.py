"""The rows of a tab of the System page: what the machine tells, under its headings, the values of its axes abreast."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING

from birdcage.rotator import machines
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import SETTINGS, Feature, FeatureKind, FeaturePage, Reading, Value
from birdcage.station.raw import CONSOLE, OTHER_CONSOLE
from birdcage.station.state import MOVING, LinkPhase, StationState
from birdcage.station.stop_words import ends_motion

if TYPE_CHECKING:
    from birdcage_tui.shown.view import View

OLD_S = 60.0
"""A reading older than this is dim: the next look at the page reads it again."""


@dataclass(frozen=True, slots=True)
class SheetRow:
    """One row: a feature, or the same feature of several axes."""

    group: str
    label: str
    cells: tuple[Feature, ...]
    axes: tuple[str, ...] = ()
    """The axis of each cell; empty for a feature of the whole machine."""

    @property
    def key(self) -> str:
        """What tells the row from all others, also on another machine."""
        return self.cells[0].id

    @property
    def unit(self) -> str:
        """The unit that values abreast share: it stands once, behind the label. Empty for a single value."""
        units = {feature.unit for feature in self.cells}
        return units.pop() if self.axes and len(units) == 1 else ""


@dataclass(frozen=True, slots=True)
class CellText:
    """One value as it is shown."""

    value: str
    """With its unit; `--` where nothing was told."""
    age_s: float | None
    """None where nothing was told."""

    @property
    def is_old(self) -> bool:
        """Whether it no longer says much of now."""
        return self.age_s is not None and self.age_s > OLD_S


@dataclass(frozen=True, slots=True)
class FeatureChange:
    """A value that was set here, and what it was before; None where the machine had not told that."""

    feature: Feature
    before: Value | None
    after: Value


@dataclass(frozen=True, slots=True)
class SheetNow:
    """What the page shows beside the readings themselves."""

    asked: frozenset[str] = frozenset()
    """What is still to be read."""
    failed: Mapping[str, str] = field(default_factory=dict)
    """Why a feature could not be read, as a sentence, by its id."""
    answers: Mapping[str, Reading] = field(default_factory=dict)
    """What the machine answered to what can only be sent, by id."""
    undo: FeatureChange | None = None
    """What was set last, and can be put back."""


BOOT_LOG = Feature(
    "boot_log", "Boot log", kind=FeatureKind.LINES, told=False, page=FeaturePage.HARDWARE, group="Last start",
    note="What the dish printed when it last started. Switch it off and on while birdcage runs to see it.",
)  # fmt: skip
"""Nothing that can be asked for: the station keeps what it heard."""
BESIDE = {FeaturePage.MOTORS: (FeaturePage.SETTINGS,)}
"""Pages that stand on the same tab: what limits motion is read out of the settings."""


def in_motion(state: StationState) -> bool:
    """Return whether nothing is read because the machine moves, or may by a raw line."""
    return state.motion is not None or state.activity in MOVING or state.raw_motion


def waits_for(state: StationState) -> str:
    """Return why the machine is not asked now, as a sentence; empty where it is."""
    if state.link.state is not LinkPhase.UP:
        return "The dish does not answer."
    if in_motion(state):
        then = "Space stops it, then r reads." if ends_motion(state) else "Once it rests, r reads."
        return f"Nothing is read while it moves. {then}"
    if state.holder in (CONSOLE, OTHER_CONSOLE):
        return "A person has the console, so nothing else is asked."
    return ""


def features_on(dish: Facts | None, page: FeaturePage) -> list[Feature]:
    """Return what stands on a tab; the whole table of settings has one of its own."""
    if dish is None:
        return []
    pages = (page, *BESIDE.get(page, ()))
    found = [each for at in pages for each in dish.features.values() if each.page is at and each.id != SETTINGS]
    return [*found, BOOT_LOG] if page is FeaturePage.HARDWARE else found


@lru_cache(maxsize=16)
def absent_groups(firmware: str, page: FeaturePage) -> tuple[str, ...]:
    """Return the headings that its kin have on a tab, and this one has not."""
    own = {each.group for each in features_on(machines.facts_of(firmware), page)}
    others = (each.group for name in machines.kin_of(firmware) for each in features_on(machines.facts_of(name), page))
    return tuple(dict.fromkeys(group for group in others if group and group not in own))


def sheet_readings(view: View) -> Mapping[str, Reading]:
    """Return what the dish told, and what it printed when it last started."""
    told, log = {**view.state.readings, **view.sheet.answers}, view.state.boot_log
    if log is not None:
        at = view.now - (view.utc - log.utc).total_seconds()
        told[BOOT_LOG.id] = Reading("\n".join(log.lines), "", at, log.utc)
    return told


def sheet_rows(dish: Facts | None, page: FeaturePage) -> tuple[SheetRow, ...]:
    """Return the rows of a tab in the order of the machine's own table; none where the machine is not known yet."""
    if dish is None:
        return ()
    axes = [axis.name for axis in dish.axes]
    together: dict[tuple[str, str], list[tuple[Feature, str]]] = {}
    for feature in features_on(dish, page):
        stem, axis = _parted(feature.id, axes)
        together.setdefault((feature.group, stem if axis else feature.id), []).append((feature, axis))
    groups = {group: number for number, group in enumerate(dict.fromkeys(group for group, _ in together))}
    rows = [_row(group, found) for (group, _), found in together.items()]
    return tuple(sorted(rows, key=lambda row: groups[row.group]))


def _parted(name: str, axes: Iterable[str]) -> tuple[str, str]:
    """Return what a feature is called without its axis, and the axis; empty for a feature of the whole machine."""
    stem, _, last = name.rpartition(".")
    return (stem, last) if stem and last in axes else (name, "")


def _row(group: str, found: list[tuple[Feature, str]]) -> SheetRow:
    feature, axis = found[0]
    if not axis or len(found) == 1:
        return SheetRow(group, feature.label, (feature,))
    label = " ".join(feature.label.replace(axis, "").split()).replace(" ,", ",").rstrip(",: ")
    return SheetRow(
        group, label[:1].upper() + label[1:], tuple(each for each, _ in found), tuple(at for _, at in found)
    )


def cell_text(
    feature: Feature, readings: Mapping[str, Reading], now: float, *, with_unit: bool = True
) -> CellText:  # fmt: skip
    """Return a value with its age; of several lines how many there are."""
    reading = readings.get(feature.id)
    if reading is None and feature.held is not None:
        return CellText(number_words(feature.held.value), None)
    if reading is None:
        return CellText("do it" if feature.kind is FeatureKind.MOMENTARY else "--", None)
    return CellText(value_words(feature, reading, with_unit=with_unit), max(0.0, now - reading.at))


def value_words(feature: Feature, reading: Reading, *, with_unit: bool = True) -> str:
    """Return a value as a person reads it: `on`, `65 deg/s`, `0x4515`; of several lines their number."""
    value = reading.value
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, str):
        lines = value.splitlines()
        return f"{len(lines)} lines" if feature.kind is FeatureKind.LINES and len(lines) != 1 else value.strip()
    number = number_words(value)
    return f"{number} {reading.unit}".strip() if with_unit else number


def words_of_value(feature: Feature, value: Value) -> str:
    """Return a value that is about to be set, as a person reads it, with its unit."""
    if isinstance(value, bool):
        return "on" if value else "off"
    return value if isinstance(value, str) else f"{number_words(value)} {feature.unit}".strip()


def number_words(value: float) -> str:
    """Return a number with no more digits than it has: 6 at most beyond a whole number."""
    return f"{value:.10g}" if value == int(value) else f"{value:.6g}"


def lines_of(feature: Feature, readings: Mapping[str, Reading]) -> list[str]:
    """Return the lines of a value as printed; none where nothing was told."""
    reading = readings.get(feature.id)
    return [] if reading is None else str(reading.value).splitlines()


def may_be_set_words(feature: Feature) -> str:
    """Return within which limits it can be set and how long that holds; empty for one that only tells."""
    if not feature.is_writable:
        return ""
    limits = "" if feature.range is None else f" {feature.range} {feature.unit}".rstrip()
    if feature.held is not None:
        return f"e sets the value it runs at, up to {0.0 if feature.range is None else feature.range.high:g}"
    return f"Set{limits}, {feature.writer.value}" if feature.kind is not FeatureKind.MOMENTARY else "Done at once"

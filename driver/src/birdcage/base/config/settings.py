"""What was read: every section, what was wrong, and where each value came from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from birdcage.base.config.fact_sections import FACT_SECTIONS
from birdcage.base.config.feeds import BUILT_IN, FeedProfile, FeedSettings
from birdcage.base.config.field import Section
from birdcage.base.config.network_sections import RotctldSettings
from birdcage.base.config.progress import SetupSettings
from birdcage.base.config.sections import (
    AlignmentSettings,
    AppSettings,
    DishSettings,
    LinkSettings,
    MotionSettings,
    PlaceSettings,
)
from birdcage.base.config.signals import PRESETS, SignalProfile
from birdcage.base.config.sky_sections import ElementsSettings
from birdcage.base.config.station_section import StationSection
from birdcage.base.config.tracking_sections import AutotrackSettings, HookSettings, RadioSettings, TrackingSettings
from birdcage.base.text import clean

Source = Literal["file", "environment", "flag", "port"]


@dataclass(frozen=True, slots=True)
class Problem:
    """Something that could not be read. The setting keeps its default; the file is left as it is."""

    file: Path | None
    """None if a variable or a flag is to blame."""
    line: int | None
    """Counted from 1; None if it has no place."""
    key: str | None
    """`motion.min_elevation_deg`, or the variable's name; None if the whole file is meant."""
    sentence: str
    limits_motion: bool

    @property
    def text(self) -> str:
        """The sentence with its place in front: `birdcage.toml:12: motion...`."""
        if self.file is None:
            return self.sentence
        place = clean(str(self.file)) + ("" if self.line is None else f":{self.line}")
        return f"{place}: {self.sentence}"


@dataclass(frozen=True, slots=True)
class Settings:
    """All settings, typed. With nothing given, every default."""

    dish: DishSettings = field(default_factory=DishSettings)
    facts: Mapping[str, Section] = field(
        default_factory=lambda: MappingProxyType({section.section: section() for section in FACT_SECTIONS})
    )
    """What the owner says of the machine, by the name of the section: `dish.facts`, `dish.facts.azimuth`, …"""
    link: LinkSettings = field(default_factory=LinkSettings)
    motion: MotionSettings = field(default_factory=MotionSettings)
    alignment: AlignmentSettings = field(default_factory=AlignmentSettings)
    place: PlaceSettings = field(default_factory=PlaceSettings)
    feed: FeedSettings = field(default_factory=FeedSettings)
    feeds: Mapping[str, FeedProfile] = field(default_factory=lambda: BUILT_IN)
    """Every profile by name, the built-in ones among them."""
    signals: Mapping[str, SignalProfile] = field(default_factory=lambda: PRESETS)
    """The same of signals."""
    elements: ElementsSettings = field(default_factory=ElementsSettings)
    tracking: TrackingSettings = field(default_factory=TrackingSettings)
    autotrack: AutotrackSettings = field(default_factory=AutotrackSettings)
    hooks: HookSettings = field(default_factory=HookSettings)
    station: StationSection = field(default_factory=StationSection)
    radio: RadioSettings = field(default_factory=RadioSettings)
    rotctld: RotctldSettings = field(default_factory=RotctldSettings)
    app: AppSettings = field(default_factory=AppSettings)
    setup: SetupSettings = field(default_factory=SetupSettings)
    problems: tuple[Problem, ...] = ()
    sources: Mapping[str, Source] = field(default_factory=lambda: MappingProxyType({}))
    """Where a value came from, by its dotted key; what is not in here has its default."""

    @property
    def own_facts(self) -> dict[str, float | str]:
        """What the owner says of the machine, by flat names (`azimuth.speed_deg_s`); what is unset is not in it."""
        return {
            f"{name}.{each.name}".removeprefix("dish.facts."): value
            for name, section in self.facts.items()
            for each in fields(section)  # type: ignore[arg-type]
            if (value := getattr(section, each.name)) is not None
        }

    def section(self, name: str) -> Section:
        """Return a section by its name; AttributeError for those of feeds, which have names of their own."""
        found: Section = self.facts[name] if name in self.facts else getattr(self, name)
        return found

    @property
    def active_feed(self) -> FeedProfile:
        """The profile that counts. It never allows to stow while something that limits motion could not be read."""
        profile = self.feeds[self.feed.active]
        return replace(profile, stow_allowed=False) if self.motion_problem else profile

    @property
    def motion_problem(self) -> str | None:
        """Why motion is to be refused: a setting that limits it could not be read. None when all could."""
        first = next((problem for problem in self.problems if problem.limits_motion), None)
        if first is None:
            return None
        return f"Settings that limit motion could not be read, so nothing moves. {first.text} Fix it and start again."

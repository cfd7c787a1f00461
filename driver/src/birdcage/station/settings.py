"""What the station needs to be told before it begins. Built by `station.build` from `birdcage.toml` and flags."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from birdcage.antenna.alignment import Alignment
from birdcage.base.config import FeedProfile, Settings
from birdcage.base.no_go import NoGoSector
from birdcage.link.link import Link
from birdcage.rotator.mapping import Site
from birdcage.station.held_keeper import HeldKeeper
from birdcage.station.not_now import NotNow
from birdcage.station.task import Task

OpenLink = Callable[[str, int], Link]
"""Opens a port by its name at a baud rate. LinkError says what is wrong."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rules:
    """What limits motion, how the dish stands, and what hangs in its focus: `ApplySettings` replaces it."""

    alignment: Alignment = field(default_factory=Alignment)
    min_elevation_deg: float | None = None
    max_elevation_deg: float | None = None
    cable_min_deg: float | None = None
    cable_max_deg: float | None = None
    sectors: tuple[NoGoSector, ...] = ()
    """No-go sectors, true."""
    feed_name: str = ""
    feed: FeedProfile = field(default_factory=FeedProfile)
    """It makes the beam, together with the dish's reflector."""
    stow_allowed: bool = False
    stop_releases_motors: bool = False
    refuse_motion: str | None = None
    """Why no motion may be taken at all: settings that limit it could not be read."""


def site_from(settings: Settings) -> Site | None:
    """Return where the machine stands, if its owner has said so."""
    place = settings.place
    if place.latitude_deg is None or place.longitude_deg is None:
        return None
    return Site(place.latitude_deg, place.longitude_deg, place.height_m)


def rules_from(settings: Settings) -> Rules:
    """Derive the rules from what `birdcage.toml` says."""
    feed, motion, alignment = settings.active_feed, settings.motion, settings.alignment
    return Rules(
        alignment=Alignment(
            alignment.az_offset_deg + feed.az_offset_deg,
            alignment.el_offset_deg + feed.el_offset_deg,
            alignment.ca_deg,
            alignment.an_deg,
            alignment.aw_deg,
        ),
        min_elevation_deg=motion.min_elevation_deg,
        max_elevation_deg=motion.max_elevation_deg,
        cable_min_deg=motion.cable_min_deg,
        cable_max_deg=motion.cable_max_deg,
        sectors=motion.no_go_sectors,
        feed_name=settings.feed.active,
        feed=feed,
        stow_allowed=feed.stow_allowed,
        stop_releases_motors=motion.stop_releases_motors,
        refuse_motion=settings.motion_problem,
    )


@dataclass(frozen=True, slots=True)
class SettingsFile:
    """birdcage.toml as this program reads it, for programs that have written there and are attached."""

    path: Path
    load: Callable[[], Settings]
    """Reads it again; what was given at the start lies over it."""


@dataclass(frozen=True, slots=True)
class StationSettings(Rules):
    """Everything that the station is told before it begins. Of its rules, only the first."""

    port: str
    firmware: str
    open_link: OpenLink
    site: Site | None = None
    """Where the machine stands, by `[place]`; None if that is not set."""
    own_facts: Mapping[str, float | str] = field(default_factory=dict)
    """What the owner says of this machine, by flat names: `[dish.facts]`. It lies over the facts of its kind."""
    find_port: Callable[[str], str | None] = lambda port: port
    """Where that port is now: the same path, or another one with the same USB identity; None while it is gone."""
    baud: int | None = None
    delay_s: float = 2.0
    survey: bool = True
    """Read identity and limits from the dish after connecting."""
    reconnect: bool = True
    backup_folder: Path | None = None
    """Where tables are kept before the dish's settings are written."""
    state_folder: Path | None = None
    """Where speeds that a pursuit changes are kept until they are put back."""
    identify: Callable[[str], str | None] = lambda _port: None
    """The identity of the dish at a port, under which it is remembered; None for one that ends with the program."""
    held_keeper: HeldKeeper | None = None
    """Keeps HELD for the programs that come after; None if it ends with this one."""
    tasks: Mapping[str, Callable[..., Task]] = field(default_factory=dict)
    """Tasks that `BeginTask` may ask for, and that can be taken up again after the program has died, by their kinds."""
    not_now: NotNow | None = None
    """The command that says whether the dish may move unattended; None: it may."""
    home_after_reboot: bool = False
    """Home a dish that has restarted, and let what was interrupted go on, with no person near."""
    file: SettingsFile | None = None
    """What `ReloadSettings` reads; None: it is refused."""
    remark: Callable[[str], None] = lambda _text: None
    """Puts a remark into the transcript."""

"""The sections of `birdcage.toml`, feeds apart. A default of None means: not set."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal, NamedTuple

from birdcage.base.config.field import Complaint, Section, setting
from birdcage.base.no_go import NoGoSector


class HorizonPoint(NamedTuple):
    """One point of the line below which nothing is heard: trees, roofs, hills. True degrees."""

    az_deg: float
    el_deg: float


@dataclass(frozen=True, slots=True)
class DishSettings(Section):
    """Which dish, and where it is plugged in."""

    section: ClassVar[str] = "dish"

    port: str | None = setting(
        None, "Serial port or URL: /dev/ttyUSB0, COM4, socket://host:port, sim:g2.", env="BIRDCAGE_PORT"
    )
    firmware: str | None = setting(
        None, "Firmware of the dish, as `--firmware` takes it; not set: the port is asked.", env="BIRDCAGE_FIRMWARE"
    )
    baud: int | None = setting(
        None,
        "Speed of the serial port; not set: the firmware's own.",
        minimum=50,
        maximum=4_000_000,
        env="BIRDCAGE_BAUD",
    )


@dataclass(frozen=True, slots=True)
class LinkSettings(Section):
    """The wire."""

    section: ClassVar[str] = "link"

    delay_s: float = setting(
        2.0, "How late a reply may come and still be told from the next.", minimum=0.1, maximum=60.0
    )
    transcript: bool = setting(True, "Keep every byte that passes, with its time.")
    usb_identity: str | None = setting(
        None, "The adapter to find again when it comes back elsewhere, as `birdcage ports` prints it."
    )


@dataclass(frozen=True, slots=True)
class MotionSettings(Section):
    """Limits beside the dish's own: the narrower of the two counts."""

    section: ClassVar[str] = "motion"
    limits_motion: ClassVar[bool] = True

    min_elevation_deg: float | None = setting(None, "The floor, in the dish's own frame.", minimum=-10.0, maximum=180.0)
    max_elevation_deg: float | None = setting(
        None, "The ceiling, in the dish's own frame.", minimum=-10.0, maximum=180.0
    )
    cable_min_deg: float | None = setting(
        None, "How far the cable lets the azimuth turn counterclockwise.", minimum=-1080.0, maximum=1080.0
    )
    cable_max_deg: float | None = setting(
        None, "How far the cable lets the azimuth turn clockwise.", minimum=-1080.0, maximum=1080.0
    )
    no_go_sectors: tuple[NoGoSector, ...] = setting(
        (),
        "Where something stands in the way: [[az_from, az_to, el_below], ...], clockwise, true degrees; a fourth "
        'may say what: "mast".',
    )
    stop_releases_motors: bool = setting(
        False, "Let STOP release the motors where nothing else stops the dish; its position is unknown afterwards."
    )

    def complaints(self) -> Iterator[Complaint]:
        """Yield limits that leave nothing between them."""
        if None not in (self.min_elevation_deg, self.max_elevation_deg):
            yield from _ordered(self, "min_elevation_deg", "max_elevation_deg")
        if None not in (self.cable_min_deg, self.cable_max_deg):
            yield from _ordered(self, "cable_min_deg", "cable_max_deg")
        for sector in self.no_go_sectors:
            if not (-360.0 <= sector.az_from_deg <= 360.0 and -360.0 <= sector.az_to_deg <= 360.0):
                yield "no_go_sectors", f"has an azimuth outside -360 to 360 in {list(sector)}"
            if not -90.0 <= sector.el_below_deg <= 180.0:
                yield "no_go_sectors", f"has an elevation outside -90 to 180 in {list(sector)}"


@dataclass(frozen=True, slots=True)
class AlignmentSettings(Section):
    """How the base stands in the world: true = the dish's own + offset, then the beam's aside and the axis's lean."""

    section: ClassVar[str] = "alignment"
    limits_motion: ClassVar[bool] = True

    active: str | None = setting(None, "Name of the set of alignments.toml that these terms were taken from.")
    az_offset_deg: float = setting(0.0, "Added to the dish's azimuth.", minimum=-360.0, maximum=360.0)
    el_offset_deg: float = setting(0.0, "Added to the dish's elevation.", minimum=-90.0, maximum=90.0)
    ca_deg: float = setting(
        0.0, "Collimation: how far the beam looks to the left, at every elevation.", minimum=-10.0, maximum=10.0
    )
    an_deg: float = setting(0.0, "How far the azimuth axis leans to the north.", minimum=-20.0, maximum=20.0)
    aw_deg: float = setting(0.0, "How far the azimuth axis leans to the west.", minimum=-20.0, maximum=20.0)
    pitch_deg: float | None = setting(
        None,
        "How far the base leans back, its front (the dish's azimuth 0) up; a calibration begins from it.",
        minimum=-45.0,
        maximum=45.0,
    )
    roll_deg: float | None = setting(
        None, "How far its right side is down; a calibration begins from it.", minimum=-45.0, maximum=45.0
    )


@dataclass(frozen=True, slots=True)
class PlaceSettings(Section):
    """Where the dish stands."""

    section: ClassVar[str] = "place"

    name: str | None = setting(None, "What to call the place.")
    latitude_deg: float | None = setting(None, "North is positive.", minimum=-90.0, maximum=90.0)
    longitude_deg: float | None = setting(None, "East is positive.", minimum=-180.0, maximum=180.0)
    height_m: float = setting(0.0, "Above the ellipsoid.", minimum=-500.0, maximum=9000.0)
    declination_deg: float | None = setting(
        None, "Magnetic declination there, east positive; not set: by the World Magnetic Model.",
        minimum=-180.0, maximum=180.0,
    )  # fmt: skip
    horizon: tuple[HorizonPoint, ...] = setting(
        (),
        "The line of trees and roofs: [[az, el], ...], true degrees, straight in between; at one azimuth only: flat.",
    )
    gps: str | None = setting(
        None, "Where a GPS receiver is asked: gpsd, gpsd://host:port, or its own port: /dev/ttyACM0."
    )

    def complaints(self) -> Iterator[Complaint]:
        """Yield half a place."""
        if (self.latitude_deg is None) != (self.longitude_deg is None):
            missing = "latitude_deg" if self.latitude_deg is None else "longitude_deg"
            yield missing, "is missing: a place needs both latitude_deg and longitude_deg"


@dataclass(frozen=True, slots=True)
class AppSettings(Section):
    """How the terminal app looks."""

    section: ClassVar[str] = "app"

    theme: Literal["daylight", "dusk", "night"] = setting("dusk", "Colours.", env="BIRDCAGE_THEME")
    glyphs: Literal["braille", "block", "ascii"] = setting(
        "braille", "What pictures are drawn with.", env="BIRDCAGE_GLYPHS"
    )
    map_colours: Literal["blue-yellow", "violet-yellow", "red", "grey"] = setting(
        "blue-yellow", "Colours of maps of the sky; the night theme shows them in red whatever stands here."
    )
    cell_aspect: float | None = setting(
        None, "Height of a character over its width; unset: what the terminal tells, else 2.", minimum=1.0, maximum=4.0
    )
    update_hz: float = setting(10.0, "How often moving pictures are drawn, at most.", minimum=0.5, maximum=30.0)


def _ordered(section: Section, low: str, high: str) -> Iterator[Complaint]:
    below, above = getattr(section, low), getattr(section, high)
    if below >= above:
        yield low, f"is {below:g}, which is not below {high} ({above:g})"

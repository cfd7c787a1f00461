"""What the app is told before it begins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from birdcage_tui.drawing.terminal_cells import ASPECT
from birdcage_tui.shown.options import SitePlace

if TYPE_CHECKING:
    from birdcage.setup.tally import StepTally
    from birdcage.sky.horizon import HorizonMask

    from birdcage_tui.feeds.calibrate_feed import MakeCalibrate
    from birdcage_tui.feeds.map_lessons import MapLessons
    from birdcage_tui.feeds.network_source import NetworkSource
    from birdcage_tui.feeds.ready_watch import ReadySource
    from birdcage_tui.feeds.setup_engine import SetupEngine
    from birdcage_tui.feeds.signal_feed import SignalSources
    from birdcage_tui.feeds.sky_feed import MakeSky
    from birdcage_tui.feeds.tone_sound import Sound
    from birdcage_tui.feeds.track_feed import MakeTrack
    from birdcage_tui.shown.clock_told import ClockTold


class HorizonFile(Protocol):
    """Where the line of trees and roofs is kept."""

    @property
    def begin(self) -> HorizonMask:
        """What the settings held when the app began."""

    def read(self) -> HorizonMask:
        """Return what the settings hold now. ConfigError where they cannot be read."""

    def write(self, mask: HorizonMask) -> None:
        """Keep another one. ConfigError says why not."""


@dataclass(frozen=True, slots=True)
class AppOptions:
    """The app's own settings, from flags and `birdcage.toml`."""

    theme: str = "dusk"
    keep_theme: Callable[[str], None] | None = field(default=None, compare=False)
    """Keeps the theme that a person has picked for the next start; ConfigError says why not. None: nowhere."""
    map_colours: str = ""
    """The colours of maps of the sky (`skymap.colour_maps`); empty for the usual ones."""
    keep_map_colours: Callable[[str], None] | None = field(default=None, compare=False)
    """Keeps the colours that a person has picked for the next start; ConfigError says why not. None: nowhere."""
    place: SitePlace | None = None
    """None while the user has not told it: then no geostationary arc is drawn."""
    tour: bool = False
    """Whether the dish follows passes by itself from the start. Only with a simulated dish."""
    notice: str = ""
    """A sentence about the settings that a person must see (a damaged file, say)."""
    glyphs: str = "braille"
    """What pictures are drawn with: `braille`, `block` or `ascii`."""
    cell_aspect: float = ASPECT
    """How much taller than wide a character is: so circles are round."""
    cell_aspect_set: bool = False
    """Whether a setting says so; else the terminal does, where it tells."""
    update_hz: float = 10.0
    """How many frames a second are drawn at most."""
    history_file: Path | None = None
    """Where lines typed into the console are kept; None: nowhere."""
    logs_folder: Path | None = None
    """Where the console saves what it shows; None: nowhere."""
    presets_file: Path | None = None
    """Where directions with names are kept; None: nowhere."""
    recordings_file: Path | None = None
    """Where the signal is recorded; None: nowhere."""
    sound: Callable[[], tuple[Sound | None, str]] | None = field(default=None, compare=False)
    """Finds what plays a tone, or says why there is only the terminal's bell."""
    journal_file: Path | None = None
    """What programs have kept of faults, wear and replies; None for none."""
    backups_folder: Path | None = None
    """Where backups of the dish's own settings are; None for none."""
    levels_file: Path | None = None
    """Where known levels of the signal are kept; None: nowhere."""
    setup: Callable[[], SetupEngine] | None = field(default=None, compare=False)
    """Makes the engine of the setup page when it is first visited; None: there is no setup."""
    setup_steps: Callable[[], StepTally] | None = field(default=None, compare=False)
    """Counts the steps of the setup that are done, on a thread after the first frame; None: nothing does."""
    sky: MakeSky | None = field(default=None, compare=False)
    """Makes what watches the sky, after the first frame; None: nothing does."""
    track: MakeTrack | None = field(default=None, compare=False)
    """Makes the pursuit desk, after the first frame; None: there is none."""
    signal: SignalSources | None = field(default=None, compare=False)
    """The sources of the signal; None: the dish's own tuner alone."""
    network: NetworkSource | None = field(default=None, compare=False)
    """Runs the server for other programs; None: it can't be run here."""
    calibrate: MakeCalibrate | None = field(default=None, compare=False)
    """Makes the guide of the calibration when its tab is first visited; None: there is none."""
    horizon: HorizonFile | None = field(default=None, compare=False)
    """Where the line of trees and roofs is kept; None: nowhere."""
    clock_check: Callable[[], ClockTold] | None = field(default=None, compare=False)
    """Finds out how good this machine's clock is, on a thread after the first frame; None: nothing does."""
    ready: ReadySource | None = field(default=None, compare=False)
    """Finds what the station lacks, on a thread after the first frame; None: nothing does."""
    lessons: MapLessons | None = field(default=None, compare=False)
    """What the lessons of a map take from the settings, and keep there; None: there are none."""
    keep_place: Callable[[float, float, float, str], None] | None = field(default=None, compare=False)
    """Writes latitude, longitude, height in metres and name of the dish's place; None: nowhere. ConfigError."""
    first_page: str = "dashboard"
    """The page that the app opens with."""

    def like(self, other: AppOptions) -> AppOptions:
        """Return these with what is the app's and not the dish's taken from `other`."""
        return replace(
            self, theme=other.theme, keep_theme=other.keep_theme, map_colours=other.map_colours,
            keep_map_colours=other.keep_map_colours, glyphs=other.glyphs, cell_aspect=other.cell_aspect,
            cell_aspect_set=other.cell_aspect_set, update_hz=other.update_hz,
        )  # fmt: skip

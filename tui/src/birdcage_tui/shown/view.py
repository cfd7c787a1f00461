"""Everything that one frame shows: the station's state, the time, and what the app itself remembers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.base.geometry import shortest_turn
from birdcage.base.presets import Preset
from birdcage.signal.level_scale import LevelScale
from birdcage.signal.source import MONITOR, SignalFacts, Spectrum
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.pursuit_state import Phase
from birdcage.station.raw import CONSOLE, OTHER_CONSOLE
from birdcage.station.state import MOVING, Activity, LinkPhase, Motion, StationState

from birdcage_tui.shown.clock_told import ClockTold
from birdcage_tui.shown.health_state import HealthNow
from birdcage_tui.shown.horizon_state import HorizonState
from birdcage_tui.shown.markers import Marker
from birdcage_tui.shown.options import FrameOptions
from birdcage_tui.shown.own_settings import OwnSettingsNow
from birdcage_tui.shown.system_sheet import SheetNow

if TYPE_CHECKING:
    from birdcage.pursuit.now import DeskNow
    from birdcage.ready.check import Check
    from birdcage.setup.tally import StepTally
    from birdcage.signal.peak_hold import LevelNow
    from birdcage.station.pursuit_state import PointingSample

    from birdcage_tui.shown.calibration import CalibrateNow
    from birdcage_tui.shown.map_book import MapShown
    from birdcage_tui.shown.polarisation_book import Levels
    from birdcage_tui.shown.sky_picture import SkyPicture
    from birdcage_tui.shown.sweep_book import SweepShown

YOU = "you"
"""The lease holder's name of whoever sits at this terminal."""
STALE_S = 2.0
"""A value older than this dims and shows its age."""
NEAR_DEG = 1.0
"""So far beyond its target an axis may be that has overshot it."""
LATE_S = 1.5
"""A watched dish that has answered nothing for so long is late: told within 2 s, with LISTEN_S between looks."""


@dataclass(frozen=True, slots=True)
class SignalSample:
    """One reading of the signal, at a monotonic time in seconds."""

    at: float
    value: float
    az_deg: float | None = None
    """Where the dish pointed, true; None if that was not known."""
    el_deg: float | None = None


@dataclass(frozen=True, slots=True)
class Trip:
    """The slowest answer of about a second, at a monotonic time in seconds."""

    at: float
    seconds: float


@dataclass(frozen=True, slots=True)
class CommandNote:
    """What a command did, in one sentence, and when."""

    utc: datetime
    words: str


@dataclass(frozen=True, slots=True)
class View:
    """One frame. Pure data: everything drawn follows from it."""

    state: StationState
    now: float
    """Monotonic seconds."""
    utc: datetime
    settings: FrameOptions
    signal: Sequence[SignalSample] = ()
    """What was heard, by one source."""
    tour: str = ""
    """What the demo says of itself; empty when it does nothing by itself."""
    crash: str = ""
    """What ended the station's own thread, if something did: nothing below answers any more."""
    note: str = ""
    """What the last command did, in one sentence."""
    watched: bool = False
    """Whether the visible page has the station ask the dish all the time."""
    scopes: tuple[str, ...] = ()
    """Whose commands hold, innermost first: the widget that has the focus, what it lies in, the page."""
    step_deg: float = 1.0
    """What one press of a jog key is."""
    asked: bool = False
    """Whether something that you asked for is not at its end yet: a motion may be about to begin."""
    typing: bool = False
    """Whether a text field has the focus: keys that print do nothing else, and Space is a space."""
    presets: Sequence[Preset] = ()
    """Directions with names."""
    aim: tuple[float, float] | None = None
    """Where the go-to line would lead, while one types into it; true degrees."""
    told: Sequence[CommandNote] = ()
    """What the last commands did, the newest last: `note`, unless that was cleared since."""
    sky: SkyPicture | None = None
    """What is up, and which passes come; None before it was first worked out."""
    horizon: HorizonState = field(default_factory=HorizonState)
    """The line of trees and roofs, as it counts now."""
    clock: ClockTold | None = None
    """How good this machine's clock is; None before it was checked."""
    track: DeskNow | None = None
    """What the pursuit desk shows; None before it has told anything."""
    followed: Sequence[PointingSample] = ()
    """How well the dish has pointed in the pursuit under way, a look a second."""
    heard: SignalFacts = TUNER_FACTS
    """What tells `signal`, and what its values mean."""
    level: LevelNow | None = None
    """How well it is heard, and where the peak was; None before the first reading."""
    scale: LevelScale | None = None
    """What its values are in dB, by two known levels; None where there are none."""
    markers: Sequence[Marker] = ()
    """Moments of it that a person has marked, the newest last."""
    health: HealthNow = field(default_factory=HealthNow)
    """What the System page says of the dish's health."""
    own_settings: OwnSettingsNow = field(default_factory=OwnSettingsNow)
    """The settings that the dish keeps itself, and what is about to be written there."""
    sheet: SheetNow = field(default_factory=SheetNow)
    """What the System page is still to read, and what could not be."""
    recorded: str = ""
    """How far a recording of the signal is, or why it has stopped; empty while nothing is recorded."""
    spectra: Sequence[Spectrum] = ()
    """What was heard, by a source that tells spectra; the newest last."""
    sweeps: Sequence[SweepShown] = ()
    """Those of this session, the newest last."""
    map: MapShown | None = None
    """The map of the sky that is open; None for none."""
    map_ended: str | None = None
    """How the last task that made it has ended, as a sentence; None while none has in this session."""
    map_trouble: str = ""
    """Why the file of maps can't be read, as a sentence; empty while it can."""
    polarisations: Levels = field(default_factory=dict)
    """What the dish's own tuner heard of either polarisation, in turn."""
    signal_trouble: str = ""
    """Why the source of the mounted feed tells nothing, in sentences."""
    trips: Sequence[Trip] = ()
    """How long the dish took to answer, over the last minutes."""
    calibrate: CalibrateNow | None = None
    """What the calibration shows; None before its tab was visited."""
    ready: tuple[Check, ...] | None = None
    """What the station lacks; None before that was looked at, and where it can't be told."""
    setup_steps: StepTally | None = None
    """How many steps of the setup are done; None before that was counted."""
    via: str = ""
    """The program that drives the dish: `birdcage station run (process 4711)`. Empty where this one does itself."""
    detached: bool = False
    """Whether that program is gone, and no other was found."""
    tag: str = ""
    """What tells this dish from the others of the app; empty where there is one."""
    others: Sequence[View] = ()
    """Those dishes, as far as a row shows them."""

    @property
    def several(self) -> bool:
        """Whether the app drives several dishes."""
        return bool(self.others)

    @property
    def has_map(self) -> bool:
        """Whether a map of the sky is open."""
        return self.map is not None

    @property
    def position_age_s(self) -> float | None:
        """How old the last position is; None when there is none."""
        position = self.state.position
        return None if position is None else max(0.0, self.now - position.told_at)

    @property
    def modelled(self) -> bool:
        """Whether the position is computed and was not read: a silent slew lasts, and nothing can be asked."""
        return self.state.position is not None and self.state.position.modelled

    @property
    def pointer(self) -> str:
        """The sign of the dish: hollow while its position is modelled."""
        return "◎" if self.modelled else "◉"

    @property
    def stale(self) -> bool:
        """Whether the position is too old to be believed. One that is modelled says so instead, and its age."""
        if self.modelled and self.link_up:
            return False
        age_s = self.position_age_s
        return age_s is None or age_s > STALE_S

    @property
    def reply_age_s(self) -> float | None:
        """How long ago the dish last answered; None when it never did."""
        heard = self.state.link.last_reply
        return None if heard is None else max(0.0, self.now - heard)

    @property
    def on_an_untold_way(self) -> bool:
        """Whether the dish moves, or may, and is one that is asked nothing meanwhile."""
        dish, may_move = self.state.dish, self.state.motion is not None or self.state.activity is Activity.UNKNOWN
        return dish is not None and not dish.tells_at_rest and may_move

    @property
    def late(self) -> bool:
        """Whether the dish owes an answer: the link is up and watched, yet nothing has come for too long.

        A dish that homes or starts is silent by nature; one that a person talks to is asked nothing else.
        """
        if not (self.watched and self.link_up) or self.state.activity in (Activity.HOMING, Activity.INITIALIZING):
            return False
        if self.state.holder in (CONSOLE, OTHER_CONSOLE) or self.modelled or self.on_an_untold_way:
            return False
        return self.reply_age_s is not None and self.reply_age_s > LATE_S

    @property
    def heard_by(self) -> str:
        """The signal's source, in a word; one that is simulated beside a real dish says so."""
        marked = self.heard.demo and not self.state.demo
        return f"DEMO {self.heard.label}" if marked else self.heard.label

    @property
    def heard_for(self) -> str:
        """The target that the signal's source is read for; empty while that is only somebody who looks."""
        owner = self.state.signal_owners.get(self.heard.id, MONITOR)
        return "" if owner == MONITOR else owner.removeprefix("DEMO ")

    @property
    def link_up(self) -> bool:
        """Whether the dish answers."""
        return self.state.link.state is LinkPhase.UP

    @property
    def waiting(self) -> bool:
        """Whether it is too early to expect an answer: the port is not open yet."""
        return self.state.link.state in (LinkPhase.CLOSED, LinkPhase.OPENING)

    @property
    def moving(self) -> bool:
        """Whether the dish is known to move."""
        return is_moving(self.state)

    @property
    def animated(self) -> bool:
        """Whether frames are worth drawing between what the dish tells: a slew is foretold, following is looked at."""
        if any(other.animated for other in self.others):
            return True
        return self.moving and self.state.activity is not Activity.FOLLOWING

    @property
    def may_move(self) -> bool:
        """Whether it, or another dish of the app, moves or may move by itself: then Esc stops first.

        What you or somebody at the console asked for has come to its end when nothing moves any more.
        """
        if any(other.may_move for other in self.others):
            return True
        return self.asked or bool(self.tour) or may_move(self.state, self.track)

    @property
    def to_go_deg(self) -> float | None:
        """How far the larger of the two axes has to go, from the last position read; None if that is not known."""
        motion, position = self.state.motion, self.state.position
        if motion is None or position is None:
            return None
        turn = _turn_left(position.az_deg, motion)
        if motion.to_skew_deg is not None:
            return None if position.skew_deg is None else abs(motion.to_skew_deg - position.skew_deg)
        return None if turn is None else max(turn, abs(motion.to_el_deg - position.el_deg))

    @property
    def progress(self) -> float | None:
        """The part of the motion's time that has passed, 0 to 1; None when nothing moves, or at unknown speeds."""
        motion = self.state.motion
        if motion is None or not motion.eta_known:
            return None
        span = motion.eta - motion.started
        return 1.0 if span <= 0 else min(1.0, max(0.0, (self.now - motion.started) / span))


def _turn_left(az_deg: float, motion: Motion) -> float | None:
    """Return how far the azimuth has to turn from where it is; None while which way round it goes is not known."""
    if motion.az_way_deg is None:
        return None
    short_deg = shortest_turn(az_deg, motion.to_az_deg)
    beyond = short_deg * motion.az_way_deg < 0 and abs(short_deg) > NEAR_DEG  # nearer, it has overshot a little
    return 360.0 - abs(short_deg) if beyond else abs(short_deg)


def is_moving(state: StationState) -> bool:
    """Return whether the dish is known to move."""
    return state.motion is not None or state.activity in MOVING


def may_move(state: StationState, desk: DeskNow | None) -> bool:
    """Return whether the dish moves, or may without a word of yours: by a raw line, another holder or a pursuit."""
    by_itself = state.holder not in (None, CONSOLE, OTHER_CONSOLE, YOU) and state.held is None
    pursued = state.pursuit is not None and state.pursuit.phase is not Phase.OVER
    pursued = pursued or (desk is not None and desk.autotrack and state.held is None)
    return is_moving(state) or state.raw_motion or by_itself or pursued

"""The calibration as one headless thing, which a face draws and answers. Nothing here waits for the dish."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.alignments import AlignmentSet, alignment_settings, keep_set, load_sets
from birdcage.base.config import Settings, edit, load
from birdcage.base.errors import BirdcageError, ConfigError
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.calibration.candidates import CalibrationObject, expected
from birdcage.calibration.peak import MeasuredPeak
from birdcage.calibration.peak_search import SETTLES_S, PeakSearch, peak_found, search_for
from birdcage.calibration.peaks_file import add_peak, load_peaks, peaks_file, remove_peaks
from birdcage.calibration.work import fit_for, in_force, observer_of, peak_at, proposals_for, set_from, sky_error_for
from birdcage.station.access import FaceSession
from birdcage.station.pursuit_state import Phase
from birdcage.station.reach_limits import reach_limits_of
from birdcage.station.requests import ApplySettings, Goto, Jog, ReleaseLease, Request, Unwatch, Watch
from birdcage.station.state import MOVING, LinkPhase, Pointing

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.calibration.fit import Fit
    from birdcage.calibration.next_best import Proposal
    from birdcage.sky.targets.model import Target

FRESH_S = 5.0
"""A position older than this is no measurement."""


class NoPeak(BirdcageError):
    """No peak can be taken now. Reasons: target, moving, position."""

    reason = Reason.POSITION


@dataclass(frozen=True, slots=True)
class GuideView:
    """What a face draws. True angles in degrees unless named the dish's."""

    peaks: tuple[MeasuredPeak, ...]
    fit: Fit | None
    sky_error_deg: float | None
    """The error to expect by the fit, over all of the sky that this dish reaches; None without a peak."""
    proposals: tuple[Proposal, ...]
    """As `refresh` found them, best first."""
    target: str
    """What the dish was sent to, or shall be peaked on; empty for nothing."""
    expected: tuple[float, float] | None
    """Where that stands now."""
    position: Pointing | None
    """Where the dish is, read just now."""
    nudged: tuple[float, float] | None
    """How far the dish points right of and above where the target is expected to be, by the present fit."""
    may_not_take: str
    """Why no peak can be taken now; empty if it can."""
    busy: str
    failure: str
    active: str
    """The set in force; empty for none."""


class Guide:
    """From the first object to an alignment in force, over a session. All calls from one thread; `tick` often.

    `settings` are as loaded, `environ` and `flags` those that they were loaded with. `holder` takes control with the
    first motion, and `close` gives it back; with `over_pursuit` it takes it from a pursuit too, as a person who
    moves the dish by hand wants. What takes longer than a moment (`refresh`: some tenths of a second) says
    so; an app calls it from a worker of its own that owns the guide.
    """

    def __init__(
        self, session: FaceSession, settings: Settings, paths: Paths, *, environ: Mapping[str, str] | None = None,
        flags: Mapping[str, object] | None = None, holder: str = "calibration", watch: bool = True,
        over_pursuit: bool = False,
    ) -> None:  # fmt: skip
        self._station, self._clock = session.station, session.clock
        self.settings, self._paths, self._holder = settings, paths, holder
        self._over_pursuit = over_pursuit
        self._environ = os.environ if environ is None else environ
        self._flags = dict(flags or {})
        self._target: Target | None = None
        self._future: Future[object] | None = None
        self._search: PeakSearch | None = None
        self._begins: Future[object] | None = None
        """Of a search for a peak that the station was asked for; None once its number is known."""
        self._busy = self._failure = ""
        self._found: MeasuredPeak | None = None
        self._proposals: tuple[Proposal, ...] = ()
        self._read()
        if watch:
            self._station.submit(Watch("calibration", frozenset({"position"}), rate_hz=2.0))

    @property
    def peaks(self) -> tuple[MeasuredPeak, ...]:
        """Those that were taken."""
        return self._peaks.entries

    @property
    def problems(self) -> tuple[str, ...]:
        """What in the file of peaks could not be read."""
        return self._peaks.problems

    @property
    def fit(self) -> Fit | None:
        """The fit to them; None without any."""
        return self._fit

    @property
    def _beam(self) -> Beam | None:
        return self._station.state.beam

    @property
    def busy(self) -> str:
        """What is under way; empty if nothing is."""
        return self._busy or ("" if self._search is None else self._search.words)

    def close(self) -> None:
        """Look away from the dish, and give control back."""
        self._station.submit(Unwatch("calibration"))
        self._end_search()
        if self._station.state.holder == self._holder:
            self._station.submit(ReleaseLease(self._holder))

    def view(self) -> GuideView:
        """Return what to draw now."""
        position, stands = self._position, self._stands()
        nudged = None
        if position is not None and stands is not None:
            across, above = _off(self._aim.to_true(position.dish_az_deg, position.dish_el_deg), stands)
            nudged = (across, above)
        return GuideView(
            peaks=self.peaks, fit=self._fit, sky_error_deg=self._sky_error_deg, proposals=self._proposals,
            target="" if self._target is None else self._target.name, expected=stands, position=position,
            nudged=nudged, may_not_take=self._may_not_take(), busy=self.busy, failure=self._failure,
            active=self.settings.alignment.active or "",
        )  # fmt: skip

    def refresh(self) -> tuple[Proposal, ...]:
        """Look what is up now and which of it is best to peak on next. ConfigError where no place is set."""
        limits = reach_limits_of(self._station.state, self.settings)
        self._proposals = proposals_for(self.settings, self.peaks, self._clock.utc(), limits, self._fit, self._beam)
        return self._proposals

    def choose(self, target: Target | CalibrationObject) -> None:
        """Take this as the object of the next peak, without moving."""
        self._target = target.target if isinstance(target, CalibrationObject) else target
        self._failure = ""

    def go(self, target: Target | CalibrationObject | None = None) -> None:
        """Turn the dish to where an object is expected, by the peaks so far; None: the chosen one, as it moves on.

        Returns at once; what becomes of it shows in `view`. Limits and STOP hold as for every motion.
        """
        if target is not None:
            self.choose(target)
        stands = self._stands()
        if stands is None or self._target is None:
            raise NoPeak("No object is chosen.", reason=Reason.TARGET)
        # The station aims by the alignment in force; the peaks taken since know better.
        az_deg, el_deg = in_force(self.settings).to_true(*self._aim.to_dish(*stands))
        self._ask(Goto(az_deg, el_deg, self._holder, take_over=self._takes_over), f"going to {self._target.name}")

    def nudge(self, right_deg: float, up_deg: float) -> None:
        """Step so far on the sky, as a person looks at the meter."""
        position = self._position
        if position is None:
            raise NoPeak("The dish's position is not known.")
        level = max(math.cos(math.radians(position.el_deg)), 0.02)
        self._ask(Jog(right_deg / level, up_deg, self._holder, self._takes_over), "nudging")

    def take(self, sigma_deg: float | None = None) -> MeasuredPeak:
        """Peaked here: keep where the dish is and where the object was then, and fit anew.

        `sigma_deg` is how well that was done; by default, how well a person can by its expected signal. NoPeak while
        the dish moves or its position is not known; StoreError if it can't be kept.
        """
        reason, position, target = self._may_not_take(), self._position, self._target
        if reason or position is None or target is None:
            raise NoPeak(
                reason, reason=Reason.TARGET if target is None else Reason.MOVING if self._moving else Reason.POSITION
            )
        peak = peak_at(self.settings, target, position, sigma_deg, self._beam)
        kept = add_peak(peaks_file(self._paths), peak)
        self._read()
        return kept

    def find_peak(self, source: str = "") -> None:
        """Have the station find the peak by the signal, around where the dish points; what it finds is kept as a peak.

        Returns at once. STOP ends it as every motion; without a peak nothing is kept, and `failure` says why.
        `source`: what it hears by, empty for the feed's own. NoPeak as for `take`.
        """
        reason, position, stands = self._may_not_take(), self._position, self._stands()
        if reason or position is None or stands is None:
            raise NoPeak(reason, reason=Reason.TARGET if self._target is None else Reason.POSITION)
        self._end_search()
        self._failure = ""
        self._search = PeakSearch(self._station)
        self._begins = self._station.submit(
            search_for(self.settings, stands, position, self._beam, self._holder, source)
        )  # fmt: skip

    def take_found(self) -> MeasuredPeak | None:
        """Return the peak that was found since this was asked last; None if there is none."""
        found, self._found = self._found, None
        return found

    def remove(self, *numbers: int) -> None:
        """Forget peaks by their numbers, all of them without one, and fit anew. StoreError where there is none."""
        remove_peaks(peaks_file(self._paths), *numbers)
        self._read()

    def put_back(self, peak: MeasuredPeak) -> MeasuredPeak:
        """Keep a peak that was removed, under a number of its own, and fit anew. StoreError if it can't be kept."""
        kept = add_peak(peaks_file(self._paths), peak)
        self._read()
        return kept

    def apply(self, name: str) -> AlignmentSet:
        """Keep the fit as a set called `name` and put it into force. ConfigError, NoPeak: nothing was changed."""
        if self._fit is None:
            raise NoPeak("No peaks yet, so there is nothing to apply.", reason=Reason.TARGET)
        found = set_from(self.settings, self._fit, name, self._clock.utc())
        keep_set(self._paths.alignments_file, found)
        return self.use(name)

    def use(self, name: str) -> AlignmentSet:
        """Put the set called `name`, which was kept before, into force. ConfigError where there is none."""
        kept = load_sets(self._paths.alignments_file).named(name)
        if kept is None:
            raise ConfigError(f"No saved set is called {name!r}.")
        edit(self._paths.config_file, alignment_settings(kept))
        self.settings = load(self._paths.config_file, self._environ, self._flags)
        self._ask(ApplySettings(self.settings, self._holder), f"putting {kept.name} into force")
        self._read()
        return kept

    def tick(self) -> None:
        """Look what became of what was asked for."""
        self._look_at_search()
        if self._future is None or not self._future.done():
            return
        future, self._future, self._busy = self._future, None, ""
        try:
            future.result(0)
        except BirdcageError as error:
            self._failure = str(error)

    def _look_at_search(self) -> None:
        """Keep what was found, once the dish has told where it rests."""
        search = self._search
        if search is None:
            return
        try:
            if self._begins is not None and self._begins.done():
                number, self._begins = self._begins.result(0), None
                assert isinstance(number, int), "a task that has begun has one"
                search.number = number
            if search.ended is None:
                return
            if not search.ended.is_done or not search.ended.found:
                raise NoPeak(search.ended.why, reason=Reason.SILENT)
            position, now = self._position, self._clock.monotonic()
            search.ended_at = now if search.ended_at is None else search.ended_at
            if position is not None and not self._moving and position.at >= search.ended_at:
                assert self._target is not None, "it was sought"
                peak = peak_found(self.settings, self._target, position, search.ended.found, self._beam)
                self._found = add_peak(peaks_file(self._paths), peak)
                self._read()
            elif now < search.ended_at + SETTLES_S:
                return
            else:
                raise NoPeak("The dish's position is unknown: no reading just now.")
        except BirdcageError as error:
            self._failure = str(error)
        self._end_search()

    def _end_search(self) -> None:
        if self._search is not None:
            self._search.close()
        self._search = self._begins = None

    def _ask(self, request: Request, busy: str) -> None:
        self._failure = ""
        self._future, self._busy = self._station.submit(request), busy

    def _read(self) -> None:
        self._peaks = load_peaks(peaks_file(self._paths))
        self._fit = fit_for(self.settings, self._peaks.entries)
        self._aim = in_force(self.settings) if self._fit is None else self._fit.alignment
        limits = reach_limits_of(self._station.state, self.settings)
        self._sky_error_deg = None if self._fit is None else sky_error_for(self._fit, limits)

    @property
    def _position(self) -> Pointing | None:
        """Where the dish is, read just now; None if that is not known."""
        state = self._station.state
        seen = state.position if state.position_lost is None and state.link.state is LinkPhase.UP else None
        return seen if seen is not None and self._clock.monotonic() - seen.told_at <= FRESH_S else None

    @property
    def _takes_over(self) -> bool:
        """Whether a pursuit has control that a motion of this guide may take."""
        pursuit, holder = self._station.state.pursuit, self._station.state.holder
        live = pursuit is not None and pursuit.phase is not Phase.OVER and pursuit.holder == holder
        return self._over_pursuit and live

    @property
    def _moving(self) -> bool:
        state = self._station.state
        return state.motion is not None or state.activity in MOVING

    def _stands(self) -> tuple[float, float] | None:
        if self._target is None:
            return None
        observer = observer_of(self.settings)
        return expected(self._target, observer, self._clock.utc(), self.settings.tracking.refraction)

    def _may_not_take(self) -> str:
        if self._target is None:
            return "No object is chosen."
        if self._moving:
            return "The dish is moving. Wait until it rests."
        position = self._position
        if position is None or position.modelled:
            return "The dish's position is unknown: no reading just now."
        return ""


def _off(seen: tuple[float, float], stands: tuple[float, float]) -> tuple[float, float]:
    """Return how far a direction lies right of and above another, on the sky."""
    turn = (seen[0] - stands[0] + 180.0) % 360.0 - 180.0
    return turn * math.cos(math.radians(stands[1])), seen[1] - stands[1]

"""What a calibration is made of, without a dish: for the guide, and for commands that only compute.

Numpy is imported inside the functions that need it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.antenna.alignment import Alignment
from birdcage.base.alignments import AlignmentSet
from birdcage.base.errors import ConfigError
from birdcage.base.geometry import separation, shortest_turn
from birdcage.calibration.candidates import expected
from birdcage.calibration.peak import SLOT_RISE_DB, MeasuredPeak, sigma_by_hand
from birdcage.calibration.terms import Priors, priors_of
from birdcage.sky.observer import Observer
from birdcage.sky.rise import Ear, expected_rise_db
from birdcage.sky.targets.model import SlotTarget
from birdcage.station.settings import rules_from

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import Settings
    from birdcage.calibration.candidates import CalibrationObject
    from birdcage.calibration.fit import Fit
    from birdcage.calibration.next_best import Proposal
    from birdcage.sky.reach_limits import ReachLimits
    from birdcage.sky.targets.model import Target
    from birdcage.station.state import Pointing

SAME_DEG = 3.0
"""Nearer than this to a peak, another one tells little: what was wrong with the first is wrong with it too."""


def observer_of(settings: Settings) -> Observer:
    """Return where the dish stands. ConfigError where no place is set."""
    place = settings.place
    if place.latitude_deg is None or place.longitude_deg is None:
        raise ConfigError(
            "No place is set, so directions can't be computed. Set one in Setup, or with `birdcage place`."
        )
    return Observer(place.latitude_deg, place.longitude_deg, place.height_m, place.name or "")


def in_force(settings: Settings) -> Alignment:
    """Return the alignment that the settings put into force, what the feed adds included."""
    return rules_from(settings).alignment


def priors_for(settings: Settings, peaks: Sequence[MeasuredPeak]) -> Priors:
    """Return what is believed of this dish before the fit."""
    feed = settings.active_feed
    return priors_of(settings.alignment, peaks, (feed.az_offset_deg, feed.el_offset_deg))


def fit_for(settings: Settings, peaks: Sequence[MeasuredPeak]) -> Fit | None:
    """Return the fit to these peaks; None without any."""
    from birdcage.calibration.fit import fit

    return fit(peaks, priors_for(settings, peaks), in_force(settings)) if peaks else None


def sky_error_for(fitted: Fit, limits: ReachLimits) -> float:
    """Return the error to expect over all of the sky that this dish reaches, in degrees."""
    from birdcage.calibration.next_best import sky_error_deg

    return sky_error_deg(fitted, (limits.el_floor_deg, limits.el_ceiling_deg))


def set_from(settings: Settings, fitted: Fit, name: str, utc: datetime) -> AlignmentSet:
    """Return a fit as a set with a name: without what the feed adds, to a ten-thousandth of a degree."""
    feed, found = settings.active_feed, fitted.alignment
    return AlignmentSet(
        name,
        round(shortest_turn(0.0, found.az_offset_deg - feed.az_offset_deg), 4),
        round(found.el_offset_deg - feed.el_offset_deg, 4),
        round(found.ca_deg, 4),
        round(found.an_deg, 4),
        round(found.aw_deg, 4),
        rms_deg=round(fitted.rms_deg, 4),
        peaks=len(fitted.residuals),
        made=f"{utc:%Y-%m-%dT%H:%MZ}",
    )


def proposals_for(
    settings: Settings,
    peaks: Sequence[MeasuredPeak],
    when: datetime,
    limits: ReachLimits,
    fitted: Fit | None = None,
    beam: Beam | None = None,
) -> tuple[Proposal, ...]:
    """Return what to peak on next, best first; what lies beside a peak already taken is left out.

    `beam`: of dish and feed, where known. ConfigError where no place is set. It takes some tenths of a second at first,
    while the ephemeris is read.
    """
    from birdcage.calibration.candidates import candidates
    from birdcage.calibration.next_best import rank

    alignment = in_force(settings) if fitted is None else fitted.alignment
    found = candidates(
        observer_of(settings),
        when,
        settings.active_feed,
        allowed_by(limits),
        settings.tracking.refraction,
        beam,
    )
    return rank(
        [each for each in found if not _beside(each, peaks)], peaks, priors_for(settings, peaks), alignment,
        (limits.el_floor_deg, limits.el_ceiling_deg),
    )  # fmt: skip


def peak_at(
    settings: Settings, target: Target, position: Pointing, sigma_deg: float | None = None, beam: Beam | None = None
) -> MeasuredPeak:
    """Return a peak by hand on a target with the dish as it was read. BirdcageError where the target is nowhere.

    A positive `sigma_deg` is how well it was done; without it, as well as a person can.
    """
    observer, feed = observer_of(settings), settings.active_feed
    az_deg, el_deg = expected(target, observer, position.utc, settings.tracking.refraction)
    rise_db = expected_rise_db(target, target.look(observer, position.utc), Ear.of(feed, beam))
    heard_db = SLOT_RISE_DB if isinstance(target, SlotTarget) else rise_db
    sigma = sigma_by_hand(heard_db, beam) if sigma_deg is None else sigma_deg
    return MeasuredPeak(
        position.utc, target.name, az_deg, el_deg, position.dish_az_deg, position.dish_el_deg, sigma, "hand", rise_db
    )


def allowed_by(limits: ReachLimits) -> Callable[[float, float], bool]:
    """Return what tells whether a true direction is within reach."""
    from birdcage.sky.reach_checks import checks_of

    checks = checks_of(limits)
    return lambda az_deg, el_deg: all(check.of_point(az_deg, el_deg) >= 0.0 for check in checks)


def _beside(candidate: CalibrationObject, peaks: Sequence[MeasuredPeak]) -> bool:
    return any(
        separation(candidate.az_deg, candidate.el_deg, peak.true_az_deg, peak.true_el_deg) < SAME_DEG for peak in peaks
    )

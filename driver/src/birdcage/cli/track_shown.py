"""What a pursuit is told as: lines on stderr, one line that is written over on a terminal, and events as JSON."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.cli.say import iso, say, tell_json

if TYPE_CHECKING:
    from birdcage.cli.say import Progress
    from birdcage.station.pursuit_state import PointingSample, Pursuit
    from birdcage.tracking.plan import Plan


class PursuitShown:
    """Tells of one pursuit, each thing once."""

    def __init__(self, progress: Progress, *, as_json: bool) -> None:
        self._progress, self._as_json = progress, as_json
        self._phase: tuple[object, ...] = ()
        self._plan: Plan | None = None
        self._believed = ""

    def plan(self, pursuit: Pursuit, utc: datetime) -> None:
        """Tell that there is another plan: all of it as JSON, and to a person what error to expect of it."""
        if pursuit.plan is not self._plan and self._as_json:
            from birdcage.tracking.plan_values import plan_values

            # Second by second it is hundreds of kilobytes, and the samples tell what became of it.
            values = {key: each for key, each in plan_values(pursuit.plan).items() if key != "path"}
            tell_json({"event": "plan", "at": iso(utc), **values})
        self._plan = pursuit.plan
        believed = _believed(pursuit.plan)
        if believed and believed != self._believed:
            self._progress.clear()
            say(believed)
        self._believed = believed

    def phase(self, pursuit: Pursuit, utc: datetime) -> None:
        """Tell that it is in another phase."""
        phase = (pursuit.number, pursuit.phase, pursuit.why)
        if phase == self._phase:
            return
        self._phase = phase
        self._progress.clear()
        say(f"{utc:%H:%M:%S} {pursuit.phase.value}: {pursuit.why}".rstrip(": "))
        if self._as_json:
            tell_json({
                "event": "phase", "at": iso(utc), "phase": pursuit.phase.value, "why": pursuit.why,
                "next": pursuit.next_what or None, "next_at": iso(pursuit.next_at), "controller": pursuit.controller,
            })  # fmt: skip

    def waiting(self, pursuit: Pursuit, utc: datetime) -> None:
        """Show how long it is to what comes next."""
        if pursuit.next_at is not None and pursuit.next_at > utc:
            self._progress.show(f"{pursuit.phase.value}  {pursuit.next_what} in {_span(pursuit.next_at, utc)}")

    def sample(self, sample: PointingSample, pursuit: Pursuit | None) -> None:
        """Tell how well it points."""
        ahead = ""
        if pursuit is not None and pursuit.next_at is not None and pursuit.next_at > sample.utc:
            ahead = f"  {pursuit.next_what} in {_span(pursuit.next_at, sample.utc)}"
        self._progress.show(
            f"AZ {sample.reported_az_deg:6.2f}° EL {sample.reported_el_deg:5.2f}°  {live_words(sample)}{ahead}"
        )
        if self._as_json:
            tell_json(sample_values(sample))

    def end(self, pursuit: Pursuit, utc: datetime) -> None:
        """Tell how it ended, and how well it pointed."""
        self._progress.clear()
        if pursuit.rms_error_deg is not None and pursuit.max_error_deg is not None:
            own = f"{pursuit.rms_error_deg:.3f}° RMS, {pursuit.max_error_deg:.3f}° max"
            if pursuit.plan.elements is None:
                say(f"Error {own}.")
            else:
                say(f"Error {measured_words(pursuit)}. The dish alone: {own}.")
        if self._as_json:
            expected = expected_rms_deg(pursuit)
            tell_json({
                "event": "end", "at": iso(utc), "why": pursuit.why, "controller": pursuit.controller,
                "expected_rms_error_deg": _rounded(expected[0]), "expected_rms_error_p90_deg": _rounded(expected[1]),
                "rms_error_deg": _rounded(pursuit.rms_error_deg), "max_error_deg": _rounded(pursuit.max_error_deg),
                "latency_s": _rounded(pursuit.latency_s),
            })  # fmt: skip


def sample_values(sample: PointingSample) -> dict[str, object]:
    """Return a sample for JSON: true degrees."""
    return {
        "event": "sample",
        "at": iso(sample.utc),
        "target_azimuth_deg": _rounded(sample.target_az_deg),
        "target_elevation_deg": _rounded(sample.target_el_deg),
        "planned_azimuth_deg": _rounded(sample.planned_az_deg),
        "planned_elevation_deg": _rounded(sample.planned_el_deg),
        "commanded_azimuth_deg": _rounded(sample.commanded_az_deg),
        "commanded_elevation_deg": _rounded(sample.commanded_el_deg),
        "reported_azimuth_deg": _rounded(sample.reported_az_deg),
        "reported_elevation_deg": _rounded(sample.reported_el_deg),
        "error_deg": _rounded(sample.error_deg),
        "expected_error_deg": _rounded(sample.expected_error_deg),
        "loss_db": _rounded(sample.loss_db),
    }


def _believed(plan: Plan) -> str:
    """Return what error to expect of a plan, why, and what would help; empty if no elements are followed."""
    from birdcage.tracking.pointing_error import element_words, error_words

    found = plan.pointing
    if found is None or found.elements is None:
        return ""
    advice = f": {found.advice}" if found.advice else ""
    return f"Error to expect: {error_words(found)}. {element_words(found.elements)}{advice}."


def expected_rms_deg(pursuit: Pursuit) -> tuple[float | None, float | None]:
    """Return the error of what was followed, elements and all: as a rule, and in nine cases of ten; None: unknown."""
    found = pursuit.plan.pointing
    if found is None:
        return pursuit.rms_error_deg, pursuit.rms_error_deg
    return found.with_dish(pursuit.rms_error_deg)


def measured_words(pursuit: Pursuit) -> str:
    """Return the same in words: `±0.26° (90 %: 2.2°)`, `unknown`."""
    from birdcage.sky.age_words import plus_minus

    return plus_minus(*expected_rms_deg(pursuit))


def live_words(sample: PointingSample) -> str:
    """Return how far off the dish is now and what that costs: `error ±0.26° 0.02 dB, dish 0.013°`."""
    loss = "" if sample.loss_db is None else f" {sample.loss_db:.2f} dB"
    if sample.expected_error_deg is None:
        return f"error unknown, dish {sample.error_deg:.3f}°"
    if sample.expected_error_deg == sample.error_deg:
        return f"error {sample.error_deg:.3f}°{loss}"
    return f"error ±{sample.expected_error_deg:.2f}°{loss}, dish {sample.error_deg:.3f}°"


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 4)


def _span(then: datetime, now: datetime) -> str:
    seconds = round((then - now).total_seconds())
    return f"{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}" if seconds >= 3600 else (
        f"{seconds // 60:02}:{seconds % 60:02}")  # fmt: skip

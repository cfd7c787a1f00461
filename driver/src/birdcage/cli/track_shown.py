"""What a pursuit is told as: lines on stderr, one line that is written over on a terminal, and events as JSON."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.cli.say import iso, say, tell_json

if TYPE_CHECKING:
    from birdcage.cli.say import Progress
    from birdcage.station.pursuit import Pursuit, Sample
    from birdcage.tracking.plan import Plan


class Shown:
    """Tells of one pursuit, each thing once."""

    def __init__(self, progress: Progress, *, as_json: bool) -> None:
        self._progress, self._as_json = progress, as_json
        self._phase: tuple[object, ...] = ()
        self._plan: Plan | None = None

    def plan(self, pursuit: Pursuit, utc: datetime) -> None:
        """Tell that there is another plan, to whom can read all of it."""
        if pursuit.plan is not self._plan and self._as_json:
            from birdcage.tracking.plan_values import plan_values

            # Second by second it is hundreds of kilobytes, and the samples tell what became of it.
            values = {key: each for key, each in plan_values(pursuit.plan).items() if key != "path"}
            tell_json({"event": "plan", "at": iso(utc), **values})
        self._plan = pursuit.plan

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

    def sample(self, sample: Sample, pursuit: Pursuit | None) -> None:
        """Tell how well it points."""
        ahead = ""
        if pursuit is not None and pursuit.next_at is not None and pursuit.next_at > sample.utc:
            ahead = f"  {pursuit.next_what} in {_span(pursuit.next_at, sample.utc)}"
        loss = "" if sample.loss_db is None else f" {sample.loss_db:.2f} dB"
        self._progress.show(
            f"AZ {sample.reported_az_deg:6.2f}° EL {sample.reported_el_deg:5.2f}°  "
            f"error {sample.error_deg:.3f}°{loss}{ahead}"
        )
        if self._as_json:
            tell_json(sample_values(sample))

    def end(self, pursuit: Pursuit, utc: datetime) -> None:
        """Tell how it ended, and how well it pointed."""
        self._progress.clear()
        if pursuit.rms_error_deg is not None and pursuit.max_error_deg is not None:
            say(f"Error {pursuit.rms_error_deg:.3f}° RMS, {pursuit.max_error_deg:.3f}° at most.")
        if self._as_json:
            tell_json({
                "event": "end", "at": iso(utc), "why": pursuit.why, "controller": pursuit.controller,
                "rms_error_deg": _rounded(pursuit.rms_error_deg), "max_error_deg": _rounded(pursuit.max_error_deg),
                "latency_s": _rounded(pursuit.latency_s),
            })  # fmt: skip


def sample_values(sample: Sample) -> dict[str, object]:
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
        "loss_db": _rounded(sample.loss_db),
    }


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 4)


def _span(then: datetime, now: datetime) -> str:
    seconds = round((then - now).total_seconds())
    return f"{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}" if seconds >= 3600 else (
        f"{seconds // 60:02}:{seconds % 60:02}")  # fmt: skip

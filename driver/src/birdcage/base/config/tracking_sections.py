"""The sections of `birdcage.toml` about following: how, which passes by itself, what runs beside, the radio."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

from birdcage.base.config.field import Complaint, Section, setting


@dataclass(frozen=True, slots=True)
class TrackingSettings(Section):
    """`[tracking]`: how a pass is followed."""

    section: ClassVar[str] = "tracking"

    controller: Literal["auto", "fast", "velocity", "queued", "modelled", "leapfrog"] = setting(
        "auto", "What steers the dish; auto: what suits it. leapfrog is the old fixed overshoot."
    )
    velocity_allowed: bool = setting(
        False, "Let `velocity` change the greatest speed of the motors while it follows. Unproven on a real dish.",
    )  # fmt: skip
    dead_band_steps: float = setting(
        0.5, "An axis that would move by fewer of its steps is left alone.", minimum=0.0, maximum=100.0
    )
    dead_band_db: float | None = setting(
        None, "The same as what may be lost of the signal.", minimum=0.001, maximum=3.0
    )
    preposition_s: float = setting(
        60.0, "How long before it comes into reach the dish is to be in place.", minimum=0.0, maximum=3600.0
    )
    at_end: Literal["park", "stay", "next"] = setting(
        "park", "After a pass: park, stay, or go to wherever the next pass begins. Never stow."
    )
    park_az_deg: float | None = setting(None, "Where to park, true; not set: it stays.", minimum=0.0, maximum=360.0)
    park_el_deg: float | None = setting(None, "Where to park, true.", minimum=-10.0, maximum=180.0)
    resume: bool = setting(
        False, "Go on by itself after a short gap, if the dish has not restarted and stands where it was."
    )
    resume_within_s: float = setting(10.0, "The longest gap of that kind.", minimum=1.0, maximum=120.0)
    refraction: Literal["radio", "optical", "none"] = setting("radio", "What lifts a target near the horizon.")

    def complaints(self) -> Iterator[Complaint]:
        """Yield half a park direction, and a controller that is not allowed."""
        if (self.park_az_deg is None) != (self.park_el_deg is None):
            missing = "park_az_deg" if self.park_az_deg is None else "park_el_deg"
            yield missing, "is missing: a park direction needs both park_az_deg and park_el_deg"
        if self.controller == "velocity" and not self.velocity_allowed:
            yield "controller", "is velocity, which needs velocity_allowed = true"


@dataclass(frozen=True, slots=True)
class AutotrackSettings(Section):
    """`[autotrack]`: which passes of the favourites are followed by themselves, once that is switched on."""

    section: ClassVar[str] = "autotrack"

    min_elevation_deg: float = setting(10.0, "Passes that stay lower within reach are left out.", minimum=0.0,
        maximum=90.0)  # fmt: skip
    min_duration_s: float = setting(120.0, "Passes that are shorter within reach are left out.", minimum=0.0,
        maximum=7200.0)  # fmt: skip
    hysteresis_s: float = setting(
        60.0, "How much longer a pass of equal priority must be before the plan changes for it.", minimum=0.0,
        maximum=3600.0,
    )  # fmt: skip
    hours: float = setting(24.0, "How far ahead is planned.", minimum=1.0, maximum=72.0)


@dataclass(frozen=True, slots=True)
class HookSettings(Section):
    """`[hooks]`: command lines that run at moments of a pass, or when something happens, with what there is to know."""

    section: ClassVar[str] = "hooks"

    at_reach_start: str | None = setting(
        None, "Run when the target comes into reach. Words as in a shell, without one: sh -c '...' where one is wanted."
    )
    at_tca: str | None = setting(None, "Run when it is highest.")
    at_reach_end: str | None = setting(None, "Run when it goes out of reach.")
    on_event: str | None = setting(
        None,
        "Run on a fault, a link lost or back, HELD or released, the end of a pass or a scan: `docs/unattended.md`.",
    )
    pre_s: float = setting(0.0, "How much earlier the first one runs.", minimum=0.0, maximum=600.0)
    post_s: float = setting(0.0, "How much later the last one runs.", minimum=0.0, maximum=600.0)
    deadline_s: float = setting(
        900.0, "After that long a command is ended: asked to, and killed 5 s later.", minimum=1.0, maximum=86_400.0
    )


@dataclass(frozen=True, slots=True)
class RadioSettings(Section):
    """`[radio]`: a receiver that is kept on the frequency by Doppler, over Hamlib's network protocol."""

    section: ClassVar[str] = "radio"

    rigctld: str | None = setting(
        None, "Where it listens: localhost:4532, or sim:rig for a simulated one; not set: none is tuned."
    )
    record: bool = setting(True, "Tell it AOS and LOS: SDR++ and gqrx begin and end a recording then.")
    step_hz: float = setting(
        10.0, "It is tuned again when the frequency is off by more.", minimum=1.0, maximum=100_000.0
    )
    strength: bool = setting(False, "Take its `l STRENGTH` as the signal of the pass.")
    lo_hz: float | None = setting(
        None, "Subtracted from the downlink before tuning; not set: the LO of the feed.", minimum=0.0, maximum=1e12
    )

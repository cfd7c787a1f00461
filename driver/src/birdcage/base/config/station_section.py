"""The section of `birdcage.toml` about a dish that is left alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from birdcage.base.config.field import Section, setting


@dataclass(frozen=True, slots=True)
class StationSection(Section):
    """`[station]`: what birdcage may do by itself while no person is near."""

    section: ClassVar[str] = "station"

    after_reboot: Literal["ask", "home"] = setting(
        "ask", "When the dish has restarted: ask waits for you. home ends its TV search, homes it and goes on, after a "
        "countdown.",
    )  # fmt: skip
    not_now: str | None = setting(
        None, "A command that says whether the dish may move unattended: status 0, it may; any other, its first line "
        "says why not.",
    )  # fmt: skip
    not_now_then: Literal["stop", "park"] = setting(
        "stop", "What the dish does on *not now*: come to rest, or go to the park position after a countdown."
    )
    not_now_every_s: float = setting(
        5.0, "How often it is asked while the dish moves unattended, or is about to.", minimum=1.0, maximum=600.0
    )

"""What the page needs of the engine behind it, which knows the steps and does them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from birdcage.base.config import Settings
from birdcage.setup.case import Cause
from birdcage.setup.step import StepView


class SetupEngine(Protocol):
    """`birdcage.setup.engine.Setup`, seen from the page. For the app's own thread only."""

    @property
    def settings(self) -> Settings:
        """The settings as they are now."""

    @property
    def current(self) -> str:
        """The name of the present step."""

    @property
    def begin_anew(self) -> str:
        """The firmware that a person has chosen instead of the one spoken; empty while that is the right one."""

    @property
    def area_clear(self) -> bool:
        """Whether a person has said that the area is clear."""

    @property
    def finished(self) -> bool:
        """Whether every step is done, skipped or for later."""

    def read_place(self) -> None:
        """Read the settings again: the place was written elsewhere."""

    def causes(self) -> tuple[Cause, ...]:
        """Return what may keep the port from answering, likeliest first; empty while the dish answers."""

    def steps(self) -> tuple[StepView, ...]:
        """Return all steps, in order."""

    def clear(self) -> None:
        """Take a person's word that the area is clear."""

    def choose(self, step: str, choice: str, values: Mapping[str, str] = ...) -> None:
        """Take an answer. BirdcageError says why not."""

    def skip(self, step: str) -> None:
        """Leave a step open."""

    def back(self) -> None:
        """Make the step before the present one."""

    def go(self, step: str) -> None:
        """Make that step the present one."""

    def tick(self) -> None:
        """Go on with what is under way."""

"""What the setup page shows in an app that was built without a setup behind it."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.config import Settings
from birdcage.setup.case import Cause
from birdcage.setup.step import Mark, StepView

_ONLY = StepView(
    1, "link", "Setup", Mark.LATER, "not in this app",
    ("This app has no file for the setup. Use `birdcage setup` in a terminal.",),
)  # fmt: skip


class AbsentSetup:
    """A `SetupEngine` of one step that cannot be answered."""

    settings = Settings()
    current = _ONLY.name
    area_clear = False
    finished = False
    begin_anew = ""

    def read_place(self) -> None:
        """There is nothing to read."""

    def causes(self) -> tuple[Cause, ...]:
        """Return nothing: no port was tried."""
        return ()

    def steps(self) -> tuple[StepView, ...]:
        """Return the one that says so."""
        return (_ONLY,)

    def clear(self) -> None:
        """Nothing here moves."""

    def choose(self, step: str, choice: str, values: Mapping[str, str] | None = None) -> None:
        """There are no answers."""

    def skip(self, step: str) -> None:
        """There is nothing to skip."""

    def back(self) -> None:
        """There is nothing before it."""

    def go(self, step: str) -> None:
        """There is nowhere to go."""

    def tick(self) -> None:
        """Nothing goes on."""

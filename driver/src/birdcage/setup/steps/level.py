"""Step 8: how the base stands."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.setup.step import Choice, Field
from birdcage.setup.steps.base import Step
from birdcage.setup.typed import number


class LevelStep(Step):
    """Typed from a phone or a spirit level."""

    name = "level"
    title = "Level"

    def words(self) -> tuple[str, ...]:
        """Say where to measure."""
        return (
            "Lay a phone with a level on the base plate. Better than typing: put wedges under it until both are 0.",
            "A calibration starts from these figures. Without one, pointing does not correct for them.",
        )

    def choices(self) -> tuple[Choice, ...]:
        """Type both."""
        kept = self.bench.settings.alignment
        fields = (
            Field("pitch_deg", "pitch", "deg", "front of the base up is +", _shown(kept.pitch_deg)),
            Field("roll_deg", "roll", "deg", "right side down is +", _shown(kept.roll_deg)),
        )
        return (Choice("typed", "enter", "Type pitch and roll", fields=fields),)

    def take(self, choice: str, values: Mapping[str, str]) -> None:  # noqa: ARG002 - a step's signature
        """Keep them."""
        pitch = number(values, "pitch_deg", "pitch", -45.0, 45.0)
        roll = number(values, "roll_deg", "roll", -45.0, 45.0)
        self.bench.done(
            self.name,
            f"pitch {pitch:+.2f} deg, roll {roll:+.2f} deg",
            {"alignment.pitch_deg": pitch, "alignment.roll_deg": roll},
        )


def _shown(value: float | None) -> str:
    return "" if value is None else f"{value:g}"

"""Step 6: how far it may go."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.config.edit import Value
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import optional_number

_KEYS = {
    "floor": ("min_elevation_deg", "lowest elevation", -10.0, 180.0),
    "ceiling": ("max_elevation_deg", "highest elevation", -10.0, 180.0),
    "cable_min": ("cable_min_deg", "cable counterclockwise", -1080.0, 1080.0),
    "cable_max": ("cable_max_deg", "cable clockwise", -1080.0, 1080.0),
}
"""By field: the key of `[motion]`, its label, and what may be typed."""


class LimitsStep(Step):
    """The dish's own, read from it; a person's only where they are narrower."""

    name = "limits"
    title = "Limits"

    def evidence(self) -> str:
        """Show the limits that count."""
        return self._shown() if self.bench.is_up else super().evidence() or self._shown()

    def _shown(self) -> str:
        state = self.bench.state
        if state.dish is None or state.el_min_deg is None or state.el_max_deg is None:
            return "not known yet"
        offset = state.el_offset_deg
        origin = self._origin()
        own = self.bench.settings.motion
        if own.min_elevation_deg is not None or own.max_elevation_deg is not None:
            origin += ", narrowed by yours"
        text = f"el {state.el_min_deg - offset:.2f} to {state.el_max_deg - offset:.2f} ({origin})"
        cable = state.dish.cable
        if cable is None:
            return text
        low = cable.min_deg if own.cable_min_deg is None else max(cable.min_deg, own.cable_min_deg)
        high = cable.max_deg if own.cable_max_deg is None else min(cable.max_deg, own.cable_max_deg)
        return f"{text}; cable {low:+.0f} to {high:+.0f}"

    def _origin(self) -> str:
        """Say where floor and ceiling come from: each dish keeps both, its floor alone, or neither."""
        state = self.bench.state
        assert state.dish is not None, "limits are known of a known dish"
        floor, ceiling = state.dish.floor_settings, state.dish.ceiling_settings
        told = [setting for setting in (*floor, *ceiling) if setting.id in state.readings]
        if ceiling and len(told) == len((*floor, *ceiling)):
            return "read from the dish"
        if ceiling or not told:
            return "of the model: not read from this dish"
        rows = ", ".join(f"{setting.label} is {state.readings[setting.id].value}" for setting in told)
        return f"floor read from the dish: {rows}"

    def words(self) -> tuple[str, ...]:
        """Ask for what the dish can't know."""
        return (
            "Does your coax, a wall or the tripod stop it sooner? The narrower limit counts.",
            "Elevations here are the dish's own. The cable counts from where it homes; counterclockwise is negative.",
        )

    def choices(self) -> tuple[Choice, ...]:
        """Take the dish's, or narrow them."""
        motion = self.bench.settings.motion
        fields = tuple(
            Field(name, label, "deg", "empty: the dish's own", _text(getattr(motion, key)))
            for name, (key, label, _low, _high) in _KEYS.items()
        )
        if not self.bench.is_up:
            return (Choice("own", "n", "Narrow them", fields=fields),)
        return (
            Choice("accept", "enter", "Take the limits as they are"),
            Choice("own", "n", "Narrow them", fields=fields),
        )

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Keep them."""
        if choice == "own":
            typed = {name: optional_number(values, name, row[1], row[2], row[3]) for name, row in _KEYS.items()}
            for low, high in (("floor", "ceiling"), ("cable_min", "cable_max")):
                below, above = typed[low], typed[high]
                if below is not None and above is not None and below >= above:
                    raise NoSuchChoice(f"{_KEYS[low][1]} {below:g} is not below {_KEYS[high][1]} {above:g}.")
            changes: dict[str, Value] = {f"motion.{_KEYS[name][0]}": value for name, value in typed.items()}
            self.bench.write(changes)
        self.begin(self._apply(), "telling the station")

    def _apply(self) -> Plan:
        yield self.bench.apply()
        self.bench.done(self.name, self._shown())


def _text(value: float | None) -> str:
    return "" if value is None else f"{value:g}"

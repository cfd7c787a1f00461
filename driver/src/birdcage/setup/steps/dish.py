"""Step 2: which dish it is."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.setup.step import Choice
from birdcage.setup.steps.base import Step
from birdcage.setup.steps.firmware import OTHER, other_firmwares, speak_another


class DishStep(Step):
    """Done by itself once the dish has told who it is."""

    name = "dish"
    title = "Dish"

    def evidence(self) -> str:
        """Name the dish as it names itself."""
        return self._told() or super().evidence()

    def _told(self) -> str:
        state = self.bench.state
        if not self.bench.is_up or state.dish is None:
            return ""
        if state.firmware_version is None:
            mute = state.surveyed and not state.dish.tells_version
            return f"{state.dish.name}, speaks {state.dish.firmware}; it tells no version" if mute else ""
        antenna = state.readings.get(state.dish.type_field)
        return f"{state.dish.name} {state.firmware_version}" + (f" ({antenna.value})" if antenna else "")

    def words(self) -> tuple[str, ...]:
        """Say what is waited for."""
        model = self.bench.state.dish
        name = model.name if model else "dish"
        if not self.bench.is_up:
            return self.trouble()
        return (f"Asking the {name} for its version and settings. Nothing moves.",)

    def choices(self) -> tuple[Choice, ...]:
        """For a dish that does not tell: take it for what it was spoken to as; or it is another one."""
        model = self.bench.state.dish
        if not self.bench.is_up or model is None:
            return other_firmwares(self.bench)
        if self._told():
            return ()
        return (
            *other_firmwares(self.bench),
            Choice("keep", "k", f"Don't wait: it is a {model.name} ({model.firmware})"),
        )

    def take(self, choice: str, values: Mapping[str, str]) -> None:  # noqa: ARG002 - a step's signature
        """Keep the firmware without a version, or speak another one."""
        if choice.startswith(OTHER):
            speak_another(self.bench, choice.removeprefix(OTHER))
            return
        model = self.bench.state.dish
        assert model is not None, "the choice is only there with a model"
        self.bench.done(self.name, f"{model.name}, version not read", {"dish.firmware": model.firmware})

    def look(self) -> None:
        """Keep what the dish told."""
        told, kept, model = self._told(), self.bench.kept(self.name), self.bench.state.dish
        if told and model is not None and (kept is None or kept.evidence != told):
            self.bench.done(self.name, told, {"dish.firmware": model.firmware})

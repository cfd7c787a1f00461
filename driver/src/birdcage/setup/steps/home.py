"""Step 4: find the references."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.setup.step import Choice
from birdcage.setup.steps.base import Plan, Step
from birdcage.station.requests import Home
from birdcage.station.state import Activity


class HomeStep(Step):
    """Whether a dish is homed is a fact of the dish and of no file."""

    name = "home"
    title = "Home"
    page = "control"

    @property
    def proven(self) -> bool | None:
        """Only the dish knows, and what it says counts."""
        state = self.bench.state
        return self.bench.is_up and state.homed is True and state.position_lost is None

    def evidence(self) -> str:
        """Say where it stands."""
        state = self.bench.state
        if not self.bench.is_up:
            return "not known before the dish answers"
        if self.proven and state.position is not None:
            return f"homed, now at AZ {state.position.az_deg:.2f} EL {state.position.el_deg:.2f}"
        if state.activity is Activity.HOMING:
            return f"homing the {state.activity_text}"
        return "not homed: it does not know where it is" if state.homed is False else "not known yet"

    def words(self) -> tuple[str, ...]:
        """Name the consequence."""
        model = self.bench.state.dish
        words = ["Turns through its whole range, knocks at its stops, ~20 s. Keep its swing clear."]
        if model is None or not model.homing_stoppable:
            words.append("Homing cannot be stopped from here: keep a hand on the 12 V switch.")
        return (*words, *self.trouble())

    def choices(self) -> tuple[Choice, ...]:
        """Home it, once it answers."""
        if not self.bench.is_up:
            return ()
        label = "Home again" if self.proven else "Area is clear: home"
        return (*self.release_choice(), Choice("home", "h" if self.proven else "enter", label, moves=True))

    def take(self, choice: str, values: Mapping[str, str]) -> None:  # noqa: ARG002 - a step's signature
        """Home, or release."""
        if choice == "release":
            self.begin(self.release(), "releasing")
        else:
            self.begin(self._home(), "homing; cut the 12 V to stop it")

    def _home(self) -> Plan:
        yield self.bench.ask(Home(self.bench.holder))
        self.bench.forget("home")  # that it was skipped before
        self.bench.completed.add(self.name)

"""Step 4: find the references."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from birdcage.base.errors import ConfirmationNeeded
from birdcage.setup.context import SetupContext
from birdcage.setup.step import Choice, Field
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import number, optional_number
from birdcage.station.known import Facts
from birdcage.station.requests import Home, Sync
from birdcage.station.state import Activity

EMPTY_EL = "empty: its own reading"


class HomeStep(Step):
    """Whether a dish is homed is a fact of the dish and of no file."""

    name = "home"
    title = "Home"
    page = "control"

    def __init__(self, bench: SetupContext) -> None:
        super().__init__(bench)
        self._asked: Sync | None = None
        """The sync that it has asked about."""

    @property
    def proven(self) -> bool | None:
        """Only the dish knows, and what it says counts."""
        state = self.bench.state
        if self._synced_by_a_person:
            return self.bench.is_up and state.homed is True and state.position_lost is None
        if self._never:
            return self.bench.is_up
        homed = state.homed is not False and state.position is not None if self._by_itself else state.homed is True
        return self.bench.is_up and homed and state.position_lost is None

    @property
    def _by_itself(self) -> bool:
        """Whether the dish homes at power-up, and by no command."""
        model = self.bench.state.dish
        return model is not None and model.homing_s is None

    @property
    def _never(self) -> bool:
        """Whether it has no homing at all."""
        model = self.bench.state.dish
        return model is not None and model.never_homes

    @property
    def _synced_by_a_person(self) -> bool:
        """Whether its zero is where it was switched on."""
        model = self.bench.state.dish
        return model is not None and bool(model.must_be_synced)

    def evidence(self) -> str:
        """Say where it stands."""
        state = self.bench.state
        if not self.bench.is_up:
            return "not known before the dish answers"
        if self._synced_by_a_person:
            here = state.position
            if not self.proven or here is None:
                return "not synced yet"
            return f"synced, now at AZ {here.az_deg:.2f} EL {here.el_deg:.2f}"
        if self._never:
            return "this dish has no homing"
        if self.proven and state.position is not None:
            how = "homed by itself at power-up" if self._by_itself else "homed"
            return f"{how}, now at AZ {state.position.az_deg:.2f} EL {state.position.el_deg:.2f}"
        if state.activity is Activity.HOMING:
            return f"homing the {state.activity_text}"
        return "not homed: its position is unknown" if state.homed is False else "not known yet"

    def words(self) -> tuple[str, ...]:
        """Name the consequence."""
        model = self.bench.state.dish
        if self._synced_by_a_person:
            return (
                "Its zero is where it was switched on. Sync it: say where it points. Nothing moves.",
                "Look along it: its azimuth clockwise from true north, its elevation above the horizon.",
                *self.trouble(),
            )
        if model is not None and self._never:
            return (model.no_homing,)
        if model is not None and self._by_itself:
            return (*self._wait(model), *self.trouble())
        takes = "" if model is None or model.homing_s is None else f", up to {model.homing_s * 2:.0f} s"
        words = [f"Turns through its whole range, runs into its end stops{takes}. Keep its swing clear."]
        if model is None or not model.homing_stoppable:
            switch = "power switch" if model is None else model.power_switch
            words.append(f"Homing can't be stopped: keep a hand on the {switch}.")
        return (*words, *self.trouble())

    def _wait(self, dish: Facts) -> tuple[str, ...]:
        """Say that there is nothing to press: the power switch homes it."""
        if self.proven:
            return ("This dish homed by itself at power-up. There is no command for it.",)
        minutes = dish.boot_s / 60
        return (
            "This dish homes by itself at power-up; there is no command for it.",
            f"Switch it off and on, keep its swing clear, and wait: up to {minutes:.0f} min with its TV search.",
            *(words for words in (dish.handling.clearance, dish.handling.weight) if words),
        )

    def choices(self) -> tuple[Choice, ...]:
        """Home it, once it answers; where it homes by itself there is nothing to press."""
        if not self.bench.is_up:
            return ()
        if self._synced_by_a_person:
            fields = (Field("az_deg", "azimuth", "deg", "true"), Field("el_deg", "elevation", "deg", EMPTY_EL))
            sync = Choice("sync", "t" if self.proven else "enter", "Sync: say where it points", fields=fields)
            sure = () if self._asked is None else (Choice("sure", "y", "It points there: sync all the same"),)
            return (*self.release_choice(), *sure, sync)
        if self._by_itself:
            return self.release_choice()
        label = "Home again" if self.proven else "Area is clear: home"
        return (*self.release_choice(), Choice("home", "h" if self.proven else "enter", label, moves=True, far=True))

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Home, sync, or release."""
        if choice == "sync":
            az_deg = number(values, "az_deg", "azimuth", 0.0, 360.0)
            el_deg = optional_number(values, "el_deg", "elevation", -90.0, 90.0)
            self.begin(self._sync(Sync(az_deg, el_deg, self.bench.holder)), "syncing")
        elif choice == "sure" and self._asked is not None:
            self.begin(self._sync(replace(self._asked, agreed=True)), "syncing")
        elif choice == "release":
            self.begin(self.release(), "releasing")
        else:
            self.begin(self._home(), "homing; only cutting its power stops it")

    def _sync(self, request: Sync) -> Plan:
        self._asked = None
        try:
            yield self.bench.ask(request)
        except ConfirmationNeeded:
            self._asked = request
            raise
        self.bench.forget("home")
        self.bench.completed.add(self.name)

    def _home(self) -> Plan:
        yield self.bench.ask(Home(self.bench.holder))
        self.bench.forget("home")  # that it was skipped before
        self.bench.completed.add(self.name)

"""Step 3: the firmware's own TV search."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from birdcage.setup.step import Choice
from birdcage.setup.steps.base import Plan, Step
from birdcage.station.known import SearchSetting, SearchSwitch
from birdcage.station.requests import Connect, SetSearch
from birdcage.station.state import Activity, FaultReason, TvSearch

_AT_ONCE = {
    TvSearch.OFF_UNTIL_POWER_UP: "ended: it begins again at each power-up",
    TvSearch.RUNNING: "runs, and moves the dish by itself",
    TvSearch.OFF: "off",
    TvSearch.NONE: "none",
    TvSearch.UNKNOWN: "unknown whether it runs",
}
"""What is known of a search that no setting switches off."""

_UNKNOWN = SearchSetting("", "the setting of the search", "", off="off", on="on")
"""For a dish whose own name for it is not known."""

_STILL = "Nothing moves."
NONE = "this dish has none"


class SearchStep(Step):
    """Off for good takes a written setting, a power cycle, and a look afterwards."""

    name = "search"
    title = "TV search off"
    page = "console"

    gone = False
    """Whether it has started anew since: its boot text was seen, or a person says so. Silence alone proves nothing."""

    @property
    def written(self) -> str:
        """The name of the backup, from the writing on until the dish was switched off and on; empty otherwise."""
        kept = self.bench.kept(self.name)
        return kept.evidence if kept is not None and kept.word == "begun" else ""

    @property
    def _setting(self) -> SearchSetting:
        """What switches it off for good."""
        model = self.bench.state.dish
        return (model.search_setting if model is not None else None) or _UNKNOWN

    @property
    def _value(self) -> str | None:
        """What the dish last told of it; None while it has not."""
        reading = self.bench.state.readings.get(self._setting.id)
        return None if reading is None else str(reading.value)

    @property
    def _at_once(self) -> bool:
        """Whether this dish's search is ended while it runs, and begins again at each power-up."""
        model = self.bench.state.dish
        return model is not None and model.search_switch is SearchSwitch.UNTIL_POWER_UP

    @property
    def _endless(self) -> bool:
        """Whether nothing is known that ends this dish's search."""
        model = self.bench.state.dish
        return model is not None and model.search_switch is SearchSwitch.NOT_KNOWN

    @property
    def _never(self) -> bool:
        """Whether this dish has no search at all."""
        model = self.bench.state.dish
        return model is not None and model.search_switch is SearchSwitch.NEVER_SEARCHES

    @property
    def proven(self) -> bool | None:
        """Off in force, and a restart acknowledged; None while the dish has not told."""
        state = self.bench.state
        if self._never:
            return True
        if self._endless:
            kept = self.bench.kept(self.name)
            return True if kept is not None and kept.done else None
        if self._at_once:
            return state.search is TvSearch.OFF_UNTIL_POWER_UP if self.bench.is_up else None
        if self.written:
            return False
        if not self.bench.is_up or self._value is None:
            return None
        return state.search is TvSearch.OFF

    def evidence(self) -> str:
        """Say what the dish says, and where the backup is."""
        state, kept = self.bench.state, self.bench.kept(self.name)
        if self._never:
            return NONE
        if self._endless:
            return kept.evidence if kept else "no known command ends it"
        if self._at_once:
            return _AT_ONCE.get(state.search, "not known") if self.bench.is_up else "begins at each power-up"
        if self.written:
            waits = "in force once you go on" if self._restarted else "waits for the dish to be switched off and on"
            return f"saved as off; {waits}"
        if self.proven is False:
            return f"on: {self._setting.label} is {self._value}; the dish moves by itself after power-up"
        return kept.evidence if kept else ""

    def words(self) -> tuple[str, ...]:
        """Name the consequences."""
        if self._never:
            return ("This dish has no TV search of its own.",)
        if self._endless:
            return (
                "After power-up the dish homes, then searches for TV satellites: it moves by itself.",
                "No known command ends the search. Wait until the dish rests, and go on then.",
                *self.trouble(),
            )
        if self._at_once:
            return (
                "After power-up the dish homes, then searches for TV satellites: it moves by itself.",
                "This ends the search now, whether it runs or not. The dish stays where it is then.",
                "No setting keeps it off: it comes back at each power-up. `birdcage init` ends it then; in the app, K.",
                *self.trouble(),
            )
        if self.written:
            return (*self._awaited(), f"Backup of the dish's settings: {self.written}.")
        setting = self._setting
        return (
            "The dish's own TV search moves it by itself.",
            f"This saves {setting.label} as {setting.off} in the dish, after a backup of its whole table. {_STILL}",
            "It takes effect when the dish is switched off and on: you are asked to do that next.",
            "Then it no longer homes by itself: home it after each power-up.",
            "`birdcage init --restore-search` undoes this.",
            *self.trouble(),
        )

    def _awaited(self) -> tuple[str, ...]:
        """Say what is waited for: the power cycle, the end of the start, or that a person goes on."""
        if self._restarted:
            if self.bench.is_up:
                return ("The dish has started anew, as it should. Go on.",)
            return ("The dish was switched on and is starting. Wait until it answers: that may take minutes.",)
        if self.gone and self.bench.is_up:
            return ("Asking the dish whether it is in force.", *self.trouble())
        if not self.bench.is_up:
            return ("No answer: it is off, or starting. After power-up it may take minutes to answer.",)
        return ("Now switch the dish off and on (12 V), and wait until it has started.", *self.trouble())

    @property
    def _restarted(self) -> bool:
        """Whether the station has met the restart that was asked for."""
        fault = self.bench.state.fault
        return fault is not None and fault.reason is FaultReason.REBOOT

    def choices(self) -> tuple[Choice, ...]:
        """Switch it off, or say that the power was cycled."""
        if not self.bench.is_up or self._never:
            return ()
        if self._endless:
            return () if self.proven else (*self.release_choice(), Choice("rests", "enter", "It rests: go on"))
        if self._at_once:
            key, label = ("e", "End it again") if self.proven else ("enter", "End the TV search now")
            return (*self.release_choice(), Choice("end", key, label))
        if self.written and self._restarted:
            return (Choice("release", "enter", "I did that: go on"),)
        if self.written:
            again = () if self.gone else (Choice("cycled", "c", "I switched it off and on"),)
            return (*self.release_choice(), *again)
        if self.proven is not False:
            return self.release_choice()
        return (*self.release_choice(), Choice("off", "enter", "Switch the TV search off"))

    def take(self, choice: str, values: Mapping[str, str]) -> None:  # noqa: ARG002 - a step's signature
        """Write, or go on after the power cycle."""
        if choice == "release":
            self.begin(self.release(), "releasing")
        elif choice == "rests":
            self.bench.done(self.name, "not ended: it was seen at rest")
        elif choice == "end":
            self.begin(self._end_now(), "ending the TV search")
        elif choice == "cycled":
            self.begin(self._look_again(), "looking at the dish anew")
        else:
            self.begin(self._off(), "copying the dish's settings, then writing")

    def _end_now(self) -> Plan:
        yield from self.release_after_restart()  # its search may be what moved it
        yield self.bench.ask(SetSearch(self.bench.holder, disabled=True))
        self.bench.done(self.name, _AT_ONCE[TvSearch.OFF_UNTIL_POWER_UP])

    def _off(self) -> Plan:
        yield from self.release_after_restart()  # its search may be what moved it
        backup = yield self.bench.ask(SetSearch(self.bench.holder, disabled=True))
        self.gone = False
        self.bench.begun(self.name, Path(str(backup)).name)

    def _look_again(self) -> Plan:
        """Meet the dish anew: nothing that was known of it before it was switched off counts."""
        yield self.bench.ask(Connect(self.bench.state.port, self.bench.settings.dish.baud))
        self.gone = True

    def look(self) -> None:
        """Notice the power cycle, and that the search is off."""
        state, setting = self.bench.state, self._setting
        if self._at_once or self._endless:
            return
        if self._never:
            kept = self.bench.kept(self.name)
            if self.bench.is_up and (kept is None or not kept.done):
                self.bench.done(self.name, NONE)
            return
        if self.written:
            self.gone = self.gone or self._restarted or state.activity is Activity.INITIALIZING
            if not self.gone or not self._off_now() or state.fault is not None:
                return
            was = f"was {setting.on}; backup {self.written}"
            self.bench.done(self.name, f"off: {setting.label} {setting.off}, saved ({was})")
        elif self.proven:
            kept = self.bench.kept(self.name)
            if kept is None or not kept.done:
                self.bench.done(self.name, f"off: {setting.label} {setting.off}")

    def _off_now(self) -> bool:
        state = self.bench.state
        return self.bench.is_up and state.search is TvSearch.OFF and self._value is not None

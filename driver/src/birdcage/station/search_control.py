"""Switches the firmware's own TV search: by a setting, never without a copy of them first, or by ending it now."""

from __future__ import annotations

from pathlib import Path

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.facts import SearchSwitch as Switch
from birdcage.rotator.feature import SETTINGS, TV_SEARCH
from birdcage.station.applying import refuse_while_moving
from birdcage.station.events import SettingsSaved
from birdcage.station.parts import Parts
from birdcage.station.state import Activity, TvSearch


class SearchControl:
    """What the switch does depends on the dish: see `Facts.search_switch`."""

    def __init__(self, parts: Parts) -> None:
        self._store, self._antenna, self._reader = parts.store, parts.antenna, parts.reader
        self._backup = parts.backup

    def refuse(self, *, disabled: bool) -> None:
        """Raise CommandRefused (`unsupported`) where this can't be done, BirdcageError (`moving`) while it may not.

        A search that is to be ended at once may well move the dish; a motion of ours must not be aborted by it.
        """
        facts = self._antenna.rotator.facts
        why = {
            Switch.NOT_KNOWN: f"The {facts.name} has no known command that ends its TV search.",
            Switch.NEVER_SEARCHES: f"The {facts.name} has no TV search.",
        }.get(facts.search_switch)
        if self._until_power_up and not disabled:
            why = f"The {facts.name} has no command that begins its TV search: it begins by itself at power-up."
        if why is not None:
            raise CommandRefused(f"{why} Nothing was sent.", reason=Reason.UNSUPPORTED)
        if self._until_power_up and self._store.state.activity is not Activity.MOVING_UNASKED:
            refuse_while_moving(self._store, self._antenna, "The search is not ended")

    @property
    def _until_power_up(self) -> bool:
        return self._antenna.rotator.facts.search_switch is Switch.UNTIL_POWER_UP

    def set(self, *, disabled: bool) -> Path | None:
        """Switch the search off, or back on; return the path of the backup, None if no setting was written."""
        rotator = self._antenna.rotator
        if self._until_power_up:
            ended = self._antenna.maintenance.end_search()
            rotator.make_ready()
            self._store.change(search=TvSearch.OFF_UNTIL_POWER_UP)
            self._reader.position()
            self._reader.note(ended)
            return None
        table = self._settings_table()
        self._refuse_to_save_others(table)
        backup = self._backup.keep(table)
        self._backup.forget()  # flash may be another one from here on, even if no reply comes
        written = self._antenna.maintenance.end_search() if disabled else {TV_SEARCH: rotator.write(TV_SEARCH, True)}
        named = rotator.features.get(TV_SEARCH)
        self._store.tell(SettingsSaved(*self._store.stamp(), (TV_SEARCH if named is None else named.label,)))
        self._reader.survey()
        self._reader.note(written)
        if self._store.state.search is not TvSearch.OFF:
            # Written, but the search process that the dish started at power-up goes on until the next one.
            self._store.change(search=TvSearch.UNKNOWN)
        return backup

    def _refuse_to_save_others(self, table: list[str]) -> None:
        """Raise CommandRefused where RAM holds a change that is not saved: a save writes all of RAM to flash."""
        own, setting = self._antenna.rotator.own_settings, self._antenna.rotator.facts.search_setting
        name = "" if setting is None else setting.name
        rows = () if own is None else own.parse(table).values()
        for row in rows:
            if row.is_unsaved and not (name and row.name.startswith(name)):
                raise CommandRefused(
                    f"Row {row.index} ({row.name}) was changed in RAM ({row.saved} to {row.current}) and not saved. "
                    "This would save it, too. Save it by `birdcage nvs save`, or switch the dish off and on. Nothing "
                    "was written.",
                    reason=Reason.BAD_PARAMETER,
                )

    def _settings_table(self) -> list[str]:
        """Read all settings. NoReply (`garbage`) where none were shown: then nothing is written."""
        table = self._antenna.rotator.read([SETTINGS]).get(SETTINGS)
        if table is None:
            raise NoReply("The dish did not show its settings, so there is no backup. Nothing was written.")
        return str(table.value).split("\n")

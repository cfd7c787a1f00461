"""Cases: the settings that the machine keeps in its own memory."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from birdcage.base.errors import CommandRefused, OutOfRange
from birdcage.base.reason import Reason
from birdcage.rotator import machines
from birdcage.rotator.own_settings import SettingsTable
from birdcage.rotator.setting_values import given_value, same_value, typed
from birdcage.station.requests import ReadSettings, SaveSettings, WriteSettings
from birdcage.testing.stage import Stage, require
from birdcage.testing.twin import MachineBench

BY = "contract"


@contextmanager
def with_backups(bench: MachineBench) -> Iterator[Stage]:
    """Give a stage with a folder for backups, at rest."""
    with tempfile.TemporaryDirectory() as folder, Stage(bench, settings={"backup_folder": Path(folder)}) as stage:
        yield stage.ready()


class OwnSettingsContract:
    """A machine without settings of its own keeps this by refusing to read any."""

    def test_its_facts_say_what_settings_it_keeps(self, bench: MachineBench) -> None:
        """Known before a port is open, and the machine says the same."""
        facts, own = machines.facts_of(bench.machine), machines.make(bench.machine).own_settings
        require(facts.has_own_settings is (own is not None), "the machine and its facts differ about its settings")
        known = {} if own is None else own.known
        require(known == facts.settings_known, "the machine and its facts know different rows")
        for index, each in known.items():
            require(index == each.index, f"row {index} is filed as row {each.index}")

    def test_settings_are_read_or_refused(self, bench: MachineBench) -> None:
        """Each row is among the lines that were printed, and nothing moves."""
        with with_backups(bench) as stage:
            before = stage.truth
            if not stage.facts.has_own_settings:
                error = stage.refused(ReadSettings(), CommandRefused)
                require(error.reason == Reason.UNSUPPORTED, f"reading its settings: {error}")
                return
            own, table = machines.make(bench.machine).own_settings, stage.do(ReadSettings())
            require(table.rows, "no row was read")
            require(own is not None and own.parse(table.printed) == table.rows, "its lines are read in two ways")
            told = {row.saved is not None for row in table.rows.values()}
            require(own is not None and told == {own.tells_saved}, "it tells what flash holds of some rows alone")
            require(stage.truth == before and not stage.twin.taken(), "reading has moved it")

    def test_one_row_changes_and_no_other(self, bench: MachineBench) -> None:
        """A row is changed in RAM and put back: the table is then the one from before."""
        with with_backups(bench) as stage:
            if not stage.facts.has_own_settings:
                return
            before: SettingsTable = stage.do(ReadSettings())
            index, value = self._change(stage, before)
            after: SettingsTable = stage.do(WriteSettings({index: value}, BY, agreed=True)).table
            require(same_value(after.rows[index].current, value), f"row {index} is not {value} after it was changed")
            require(after.rows[index].saved == before.rows[index].saved, f"row {index} was saved unasked")
            others = [each for each in before.rows if each != index and after.rows[each] != before.rows[each]]
            require(not others, f"row {index} was changed, and {others} too")
            stage.do(WriteSettings({index: before.rows[index].current}, BY, agreed=True))
            stage.do(SaveSettings(BY, agreed=True))
            require(stage.do(ReadSettings()).printed == before.printed, "the table is not the one from before")
            require(not stage.twin.taken(), "that has moved it")

    @staticmethod
    def _change(stage: Stage, table: SettingsTable) -> tuple[int, str]:
        """Return a row, and a value that it may have and has not."""
        for index, row in table.rows.items():
            now = typed(row.current)
            if isinstance(now, str):
                continue
            tries = [str(not now).upper()] if isinstance(now, bool) else [f"{now + 1:g}", f"{now - 1:g}"]
            for text in tries:
                try:
                    return index, given_value(row, stage.facts.settings_known.get(index), text)
                except OutOfRange:
                    continue
        raise AssertionError("no row can be changed")

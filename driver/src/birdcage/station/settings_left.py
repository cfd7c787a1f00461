"""What a write of the dish's own settings has left behind, judged by what the dish shows now."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime

from birdcage.rotator.own_settings import RowState, SettingRow, SettingsTable, UnfinishedRow, UnfinishedWrite
from birdcage.rotator.setting_values import same_value

_UNTOLD = (
    "A save was interrupted, and this dish does not tell what flash holds. What it shows after a power cycle is what "
    "flash holds. `birdcage nvs save` saves once more."
)


@dataclass(frozen=True, slots=True)
class NotedRow:
    """A row that is about to be written."""

    index: int
    name: str
    before: str
    """What RAM held."""
    before_saved: str | None
    """What flash held; None where the dish does not tell."""
    wanted: str
    is_back: bool = False
    """Whether RAM may hold `before` though flash does not: a save was interrupted earlier, and its outcome is open."""


@dataclass(frozen=True, slots=True)
class NotedWrite:
    """What is about to be written, as it is kept on disk meanwhile."""

    firmware: str
    began: datetime
    by: str
    backup: str | None
    rows: tuple[NotedRow, ...]
    saving: bool = False
    """Whether a save was begun: from then on flash may hold the new values, until one succeeds."""

    def with_rows(self, rows: tuple[NotedRow, ...]) -> NotedWrite:
        """Return it with more rows. One that is noted already keeps what it was before."""
        noted = {row.index: row for row in self.rows}
        for row in rows:
            first = noted.get(row.index, row)
            is_back = first.is_back or (self.saving and (not self.rows or same_value(row.wanted, first.before)))
            noted[row.index] = replace(first, wanted=row.wanted, is_back=is_back)
        return replace(self, rows=tuple(noted[index] for index in sorted(noted)))


def state_of(noted: NotedRow, row: SettingRow | None, *, saving: bool) -> RowState:
    """Return where a row stands; None is one that the dish does not show any more."""
    if row is None:
        return RowState.OTHER
    is_new, is_old = same_value(row.current, noted.wanted), same_value(row.current, noted.before)
    if row.saved is None or noted.before_saved is None:
        if saving and (is_new or (is_old and noted.is_back)):
            return RowState.UNTOLD
        if is_old:  # nothing but a power cycle has brought it back: flash holds it
            return RowState.UNTOUCHED
        return RowState.IN_RAM if is_new else RowState.OTHER
    was_saved = same_value(row.saved, noted.before_saved)
    if is_old and was_saved:
        return RowState.UNTOUCHED
    if is_new and same_value(row.saved, noted.wanted):
        return RowState.SAVED
    return RowState.IN_RAM if is_new and was_saved else RowState.OTHER


def left_by(noted: NotedWrite, table: SettingsTable) -> UnfinishedWrite:
    """Return where each noted row stands in a table that was just read, with what that means."""
    rows = tuple(
        UnfinishedRow(
            each.index, each.name, each.before, each.wanted,
            state_of(each, table.rows.get(each.index), saving=noted.saving),
        )
        for each in noted.rows
    )  # fmt: skip
    return UnfinishedWrite(noted.began, noted.by, noted.backup, rows, tuple(_sentences(noted, rows, table)))


def is_settled(left: UnfinishedWrite, *, saving: bool) -> bool:
    """Return whether nothing is open any more: every row is as it was, or saved.

    A save that was begun without a row of note (`saving`) is settled by another save alone.
    """
    if not left.rows:
        return not saving
    return all(row.state in (RowState.UNTOUCHED, RowState.SAVED) for row in left.rows)


def _sentences(noted: NotedWrite, rows: tuple[UnfinishedRow, ...], table: SettingsTable) -> list[str]:
    by_state = {state: [row.index for row in rows if row.state is state] for state in RowState}
    said = []
    if found := by_state[RowState.UNTOUCHED]:
        said.append(f"{named(found)} as before the write of {noted.began:%Y-%m-%d %H:%M:%S}Z.")
    if found := by_state[RowState.SAVED]:
        said.append(f"{named(found)} saved with the new value. It counts from the next power cycle.")
    if found := by_state[RowState.IN_RAM]:
        said.append(f"{named(found)} changed in RAM only. `birdcage nvs save` keeps that, a power cycle takes it back.")
    if found := by_state[RowState.UNTOLD]:
        said.append(f"{named(found)} not known to be saved. {_UNTOLD}")
    if noted.saving and not rows:
        said.append(_UNTOLD)
    shown = {row.index: row.before_saved for row in noted.rows}
    others = (row for row in rows if row.state is RowState.OTHER)
    said += [_other(row, shown[row.index], table.rows.get(row.index)) for row in others]
    if noted.backup is not None and not (rows and all(row.state is RowState.UNTOUCHED for row in rows)):
        said.append(f"Backup: {noted.backup}")
    return said


def _other(row: UnfinishedRow, before_saved: str | None, now: SettingRow | None) -> str:
    if now is None:
        return f"Row {row.index} is not shown any more. Read the table again."
    what = f"Row {row.index} holds {now.current} in RAM. It was {row.before} and was to be {row.wanted}."
    if now.saved is None or before_saved is None:
        return f"{what} Set it again, or switch the dish off and on and read it."
    if same_value(now.saved, before_saved):
        return f"{what} Flash has {now.saved} as before: a power cycle takes the change back."
    return f"{what} Flash holds {now.saved}, and held {before_saved}. `birdcage nvs restore` puts the backup back."


def named(indices: list[int]) -> str:
    """Return `Row 38 is` or `Rows 38 and 101 are`."""
    if len(indices) == 1:
        return f"Row {indices[0]} is"
    return f"Rows {', '.join(map(str, indices[:-1]))} and {indices[-1]} are"

"""Rows of a dish's settings for a person and for JSON, and what is asked before any is changed."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from birdcage.rotator.own_settings import SettingKnown, SettingRow, SettingsTable, UnfinishedWrite
    from birdcage.rotator.settings_compare import SettingDifference

COUNTS = "It counts from the next power cycle: switch the dish off and on."
HEAD = ("row", "name", "current", "saved", "default", "unit")


def row_cells(row: SettingRow, known: Mapping[int, SettingKnown]) -> tuple[str, ...]:
    """Return a row as cells of a table; what the dish does not tell is a dash."""
    told = known.get(row.index)
    values = (row.current, row.saved, row.default)
    return (str(row.index), row.name or "-", *(each or "-" for each in values), told.unit if told else "")


def row_values(row: SettingRow, known: Mapping[int, SettingKnown]) -> dict[str, object]:
    """Return a row for JSON, with what is known of it."""
    from birdcage.rotator.setting_values import danger_of

    told = known.get(row.index)
    return {
        "row": row.index, "name": row.name, "current": row.current, "saved": row.saved, "default": row.default,
        "unit": told.unit if told else "", "danger": danger_of(told), "note": told.note if told else "",
    }  # fmt: skip


def unfinished_values(left: UnfinishedWrite | None) -> dict[str, object] | None:
    """Return what an earlier write has left behind, for JSON."""
    from birdcage.cli.say import iso

    if left is None:
        return None
    rows = [
        {"row": each.index, "name": each.name, "before": each.before, "wanted": each.wanted, "state": each.state.value}
        for each in left.rows
    ]
    return {
        "began": iso(left.began), "by": left.by, "backup": left.backup, "rows": rows, "sentences": list(left.sentences),
    }  # fmt: skip


def difference_cells(each: SettingDifference) -> tuple[str, str, str, str]:
    """Return a difference as cells of a table."""
    return str(each.index), each.name or "-", each.first or "-", each.second or "-"


def show_changes(changes: Mapping[int, str], table: SettingsTable, known: Mapping[int, SettingKnown]) -> None:
    """Say what is about to change: row, name, old value, new value, unit, and what a wrong value does."""
    for index, value in changes.items():
        row, told = table.rows[index], known.get(index)
        unit = f" {told.unit}" if told is not None and told.unit else ""
        click.echo(f"Row {index} {row.name}: {row.current} -> {value}{unit}", err=True)
    for sentence in dict.fromkeys(_warnings(changes, known)):
        click.echo(f"  {sentence}", err=True)


def show_saves(table: SettingsTable, indices: Iterable[int], known: Mapping[int, SettingKnown]) -> None:
    """Say what a save is about to change in flash: row, name, saved value, value in RAM, what a wrong value does."""
    indices = list(indices)
    for index in indices:
        row = table.rows[index]
        what = f"{row.current} in RAM" if row.saved is None else f"{row.saved} -> {row.current} in flash"
        click.echo(f"Row {index} {row.name}: {what}", err=True)
    for sentence in dict.fromkeys(_warnings(indices, known)):
        click.echo(f"  {sentence}", err=True)


def _warnings(changes: Iterable[int], known: Mapping[int, SettingKnown]) -> Iterable[str]:
    from birdcage.rotator.setting_values import danger_of

    for index in changes:
        told = known.get(index)
        if danger := danger_of(told):
            yield danger
        if told is not None and told.note:
            yield told.note


def agree(question: str, yes: bool) -> None:
    """Ask a person once. UsageError where no terminal can be asked; Abort for a no."""
    if yes:
        return
    if not sys.stdin.isatty():
        raise click.UsageError("Give --yes to do it.")
    click.confirm(question, abort=True, err=True)

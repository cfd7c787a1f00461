"""Which features a person asks for by page and group, and how a whole page is shown."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason

Row = Mapping[str, Any]
"""A row of the table of features, as `feature_report.feature_values`."""


def heading_of(row: Row) -> str:
    """Return the heading under which a feature stands: `Hardware: Drivers`."""
    return ": ".join(part for part in (str(row["page"] or "other").capitalize(), row["group"]) if part)


def on_page(rows: Iterable[Row], page: str | None, group: str | None) -> list[Row]:
    """Return what can be read of a page, and of a group of it; None is all.

    CommandRefused (`unsupported`), which says what there is, where nothing is.
    """
    readable = [row for row in rows if row["told"]]
    found = [row for row in readable if page in (None, row["page"]) and _is_in(row, group)]
    if found:
        return found
    have = ", ".join(dict.fromkeys(heading_of(row) for row in readable)) or "nothing"
    asked = ": ".join(part for part in (page, group) if part)
    raise CommandRefused(
        f"This dish tells nothing of {asked}. It has {have}. Nothing was sent.", reason=Reason.UNSUPPORTED
    )


def _is_in(row: Row, group: str | None) -> bool:
    return group is None or str(row["group"] or "").lower() == group.lower()


def by_menu(rows: Iterable[Row]) -> list[tuple[str, ...]]:
    """Return ids menu by menu, those first whose reading needs consent: asked so, the dish changes menus least."""
    ordered = sorted(rows, key=lambda row: row["read_hazard"] is None)
    menus: dict[str | None, list[str]] = {}
    for row in ordered:
        menus.setdefault(row["cost"]["menu"], []).append(row["id"])
    return [tuple(ids) for ids in menus.values()]


def page_lines(rows: Sequence[Row], shown: Mapping[str, Sequence[str]]) -> list[str]:
    """Return a page for a person: its headings, and below them what was read, as `shown` by id."""
    lines: list[str] = []
    heading = ""
    for row in rows:
        if heading_of(row) != heading:
            heading = heading_of(row)
            lines.append(heading)
        lines += shown[row["id"]]
    return lines

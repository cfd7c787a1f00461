"""A listing that shows a page at a time, asked for until it comes round (`docs/reference/travler-pro.md`)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason

MOST_PAGES = 64
_ROW = re.compile(r"\s*(\d{1,6})[).:]?\s+\S", re.ASCII)
"""A row begins with its number. Headings may stand on each page, and don't say that it has come round."""


def all_pages(ask: Callable[[], Iterable[str]]) -> tuple[str, ...]:
    """Return the lines of all pages, each row once: `ask` brings the next page.

    It has come round when a row shows for the second time, or a page shows no row that is new. Where the listing was
    left off before, it begins in its middle: the rows are put in order of their numbers, heading and all first. NoReply
    (`garbage`) if it does not come round within `MOST_PAGES`.
    """
    others: list[str] = []
    rows: dict[int, str] = {}
    for _ in range(MOST_PAGES):
        came_round, found = False, False
        for line in ask():
            row = _ROW.match(line)
            if row is None:
                others += [line] if line not in others else []
            elif int(row[1]) in rows:
                came_round = True
            else:
                rows[int(row[1])], found = line, True
        if came_round or not found:
            return (*others, *(rows[index] for index in sorted(rows)))
    raise NoReply(
        f"The dish has shown {MOST_PAGES} pages of settings, and always new ones. Nothing was changed.",
        reason=Reason.GARBAGE,
    )

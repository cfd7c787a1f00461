"""The world map of the page: asks for the world at the moment that the page shows, and draws what comes."""

from __future__ import annotations

from typing import cast

from birdcage.sky.world import WorldView
from textual.message import Message

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.feeds.world_ask import Ask
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.passes.world_map import WorldMapPane
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.sky_picture import ShownPass
from birdcage_tui.shown.view import View

MOST = 60
"""Satellites on the map; the favourites first, then those that pass next."""


def ask_of(selection: PassSelection, view: View) -> Ask:
    """Return what the page shows now."""
    chosen = selection.chosen(view)
    found: dict[tuple[int, str], ShownPass] = {}
    pursuit = pursuit_of(view.state)
    if pursuit is not None and view.sky is not None:  # also where the filter of the list leaves it out
        aim = pursuit.plan.aim
        same = (row for row in view.sky.rows if row.norad_id == aim.norad_id and (row.norad_id or row.name == aim.name))
        for row in same:
            found.setdefault((row.norad_id, row.name), row)
    for row in sorted(selection.rows(view), key=lambda row: not row.favourite):
        found.setdefault((row.norad_id, row.name), row)
    if chosen is not None:
        found.pop((chosen.norad_id, chosen.name), None)
    return Ask(int(selection.time(view)), chosen, tuple(found.values())[:MOST])


def seen_text(row: ShownPass, t_s: float) -> str:
    """Return `in view here to 15:40`, `in view here 15:52 to 16:02`; empty for a pass that is over."""
    if row.stays:
        return "always in view here"
    if t_s > row.los_s:
        return ""
    until = "" if row.still_up else f" to {clock_text(row.los_s, seconds=False)}"
    since = "" if t_s >= row.aos_s else f" {clock_text(row.aos_s, seconds=False)}"
    return f"in view here{since}{until}"


def reach_span_text(row: ShownPass, t_s: float) -> str:
    """Return when the dish can follow a pass: `in reach 15:33-15:37`; empty when the pass is over."""
    if row.stays or t_s > row.los_s:
        return ""
    if not row.reach.intervals:
        return "never in reach"
    left = [(one.start_s, one.end_s) for one in row.reach.intervals if one.end_s > t_s]
    if not left:
        return "no longer in reach"
    start, end = left[0]
    until = clock_text(end, seconds=False)
    return f"in reach to {until}" if start <= t_s else f"in reach {clock_text(start, seconds=False)}-{until}"


class PassWorld(WorldMapPane):
    """The map with the chosen pass of the page."""

    class Seen(Message):
        """The world at the moment asked for; posted from the thread that worked it out."""

        def __init__(self, world: WorldView) -> None:
            super().__init__()
            self.world = world

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._selection = selection
        self._asked: Ask | None = None
        self._waits = False
        """Whether an answer is on its way: until then nothing else is asked."""

    def show(self, view: View) -> None:
        """Draw what is known, and ask for what is not."""
        super().show(view)
        if not self.display or self._waits:
            return
        ask = ask_of(self._selection, view)
        if ask != self._asked:
            self._asked = ask
            self._waits = cast(AppHost, self.app).sky.look_down(ask, lambda world: self.post_message(self.Seen(world)))

    def seen(self) -> tuple[str, ...]:
        """Return when the dish can follow the chosen pass, and when it is in view from here."""
        row = None if self.view is None else self._selection.chosen(self.view)
        if row is None or self.view is None:
            return ()
        t_s = self._selection.time(self.view)
        return reach_span_text(row, t_s), seen_text(row, t_s)

    def on_pass_world_seen(self, event: Seen) -> None:
        """Draw the answer; ask again if another moment is shown meanwhile."""
        event.stop()
        self._waits = False
        self.look_down(event.world)

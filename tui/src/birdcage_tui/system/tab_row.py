"""The tabs of the System page, and whether it asks the dish now."""

from __future__ import annotations

from birdcage_tui.shown.system_sheet import in_motion, waits_for
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.tab_row import TabRow

TABS = ("health", "hardware", "motors", "settings", "receiver")


class SystemTabs(TabRow):
    """Says at the right how far the reading or a task of yours is, or why nothing is read."""

    def __init__(self) -> None:
        super().__init__(TABS, "system-")

    def words(self, view: View) -> tuple[str, ...]:
        """Return it; else that only the tab that is seen is read."""
        task = next((each for each in view.state.tasks if each.done is not None and each.holder == YOU), None)
        if task is not None:
            return (f"{task.kind}, {task.done} of {task.of}",)
        if view.crash:
            return ()
        if waits := waits_for(view.state):
            moves = view.link_up and in_motion(view.state)
            return (waits, "Not read while moving") if moves else (waits,)
        return (f"reading, {len(view.sheet.asked)} to go" if view.sheet.asked else "only this tab is read",)

"""The map of the sky on a phone: to look at, while somebody stands at the dish."""

from __future__ import annotations

from birdcage_tui.pocket.reading import wrong_rows
from birdcage_tui.shown.view import View
from birdcage_tui.signal.map_pane import MapPane


class PocketMap(MapPane, can_focus=False):
    """As on F3, without a cursor. What is wrong with the dish goes before it."""

    DEFAULT_CSS = """
    PocketMap { height: 1fr; display: none; }
    """

    def __init__(self) -> None:
        super().__init__()
        self.is_wanted = False
        """Whether a person has asked for it."""

    def keep(self, view: View, *, listed: bool) -> bool:
        """Be seen where there is a map, nothing is wrong, and no passes are listed; return whether it is."""
        self.display = (
            self.is_wanted and not listed and view.map is not None and not wrong_rows(view, self.app.size.width)[1]
        )
        return self.display

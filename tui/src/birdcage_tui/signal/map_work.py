"""What the keys of a map and its lessons share: the page that shows it, and when a dialog may open by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.signal.map_pane import MapPane

if TYPE_CHECKING:
    from birdcage_tui.feeds.app_host import AppHost
    from birdcage_tui.widgets.page import Page

OTHER_DISH = "The other dish was shown first."
"""Why what was asked for came to nothing."""
NO_MAP = "No map is open. M lists those that are kept, m begins one."


class MapWork:
    """`page` is where the map is seen."""

    def __init__(self, page: Page) -> None:
        self._page = page

    @property
    def _host(self) -> AppHost:
        return self._page.host

    def _is_gone(self, lost: str) -> bool:
        """Return whether another dish is shown in place of this page's; then tell this dish what is `lost` by it.

        Whatever comes of this page then would be about that one.
        """
        if self._page.is_attached:
            return False
        self._page.dish.say(f"{OTHER_DISH} {lost}")
        return True

    @property
    def _pane(self) -> MapPane:
        return self._page.query_one(MapPane)

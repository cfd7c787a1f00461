"""What every page is: a container that shows views while it is visible."""

from __future__ import annotations

from textual.containers import Container

from birdcage_tui.pane import Pane
from birdcage_tui.view import View


class Page(Container):
    """A page. `WATCHES` names what the station should read while somebody looks at it."""

    WATCHES: frozenset[str] = frozenset({"position"})
    """The status line shows the position on every page."""
    RATE_HZ = 1.0

    def show(self, view: View) -> None:
        """Hand the view to every pane."""
        for pane in self.query(Pane):
            pane.show(view)

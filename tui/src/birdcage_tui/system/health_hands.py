"""What the commands of the Health tab do: explain a finding, and take in that a person has seen it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.system.ask_feature import DETAIL_WIDTH, lines_screen
from birdcage_tui.system.findings_pane import FindingsPane

if TYPE_CHECKING:
    from birdcage_tui.widgets.page import Page


class HealthHands:
    """Does them on its page."""

    def __init__(self, page: Page) -> None:
        self._page = page

    def do(self, name: str, pane: FindingsPane) -> bool:
        """Carry out one; return False for one that it does not know."""
        match name:
            case "up" | "down":
                pane.move(1 if name == "down" else -1)
            case "open":
                self._open(pane)
            case "acknowledge":
                self._acknowledge(pane)
            case _:
                return False
        return True

    def _open(self, pane: FindingsPane) -> None:
        if self._page.releases_first():
            return
        if (detail := pane.detail(self._page.host.view(), DETAIL_WIDTH)) is not None:
            self._page.app.push_screen(lines_screen(detail))

    def _acknowledge(self, pane: FindingsPane) -> None:
        finding = pane.chosen(self._page.host.view())
        if finding is None:
            self._page.host.say("Nothing to acknowledge.")
        elif finding.lasts:
            self._page.host.say("That can't be acknowledged: it clears when its cause is gone.")
        else:
            self._page.host.system.health.acknowledge(finding, self._page.host.say)

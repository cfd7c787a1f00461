"""What every page is: a container that shows views while it is visible."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from textual.containers import Container
from textual.widget import Widget

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage_tui.feeds.app_host import ShownDish


class Page(Container):
    """A page. `WATCHES` names what the station should read while somebody looks at it."""

    WATCHES: frozenset[str] = frozenset({"position"})
    """The status line shows the position on every page."""
    RATE_HZ = 1.0
    agreed = False
    """Whether a person has agreed to what reading what is watched does to the dish (`Feature.read_hazard`)."""
    FIRST_FOCUS: str | None = None
    """The selector of what has the focus on arrival; never a text field. None: nothing has."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.scope = (id or "").removeprefix("page-")
        """The page's name, which its commands have in `where`."""

    def on_mount(self) -> None:
        """Keep which dish it is about; showing another one makes another page."""
        self.dish: ShownDish = self.host.dish

    @property
    def watches(self) -> frozenset[str]:
        """What the station should read now: `WATCHES`, and what a page adds for what it shows."""
        return self.WATCHES

    @property
    def host(self) -> AppHost:
        """The app, as far as a page needs it."""
        return cast(AppHost, self.app)

    @property
    def part(self) -> Widget:
        """What of it is seen, and says in `HELP` what it is for."""
        return self

    @property
    def is_free(self) -> bool:
        """Whether the page is seen, nothing lies over it, and no text is typed: only then may a dialog open late.

        Never once it is gone. The page that is seen then may have its name, and be about another dish.
        """
        if not self.is_attached:
            return False
        view = self.host.view()
        return len(self.app.screen_stack) == 1 and self.scope in view.scopes and not view.typing

    @property
    def under_way(self) -> str:
        """What of its dish would be lost with the page, in words that follow "Wait: "; empty: nothing."""
        return ""

    def releases_first(self) -> bool:
        """Release what is held, or acknowledge a fault, before Enter does anything else; return whether it did."""
        if can_release(self.host.view()) is not None:
            return False
        self.host.action_command("release")
        return True

    def show(self, view: View) -> None:
        """Hand the view to every pane."""
        for pane in self.walk_children(Pane):
            pane.show(view)

    def place_changed(self) -> None:
        """Take in that the dish stands elsewhere; a page that keeps no place of its own does nothing."""

    def do(self, command: str) -> bool:  # noqa: ARG002 - a page without commands of its own
        """Carry out a command of this page; return False for one that it does not know."""
        return False

"""What lies over a page and is closed by an answer: dialogs, help, the palette, the letters of a jump."""

from __future__ import annotations

from typing import TypeVar

from textual.await_complete import AwaitComplete
from textual.screen import Screen

Found = TypeVar("Found")


class Layer(Screen[Found]):
    """Closes once: the one way in which anything over a page is closed. The base after one of Textual's own."""

    def dismiss(self, result: Found | None = None) -> AwaitComplete:
        """Close with a result; do nothing where it is closed already, or where another layer lies over it.

        Textual would close whatever lies on top then: a dialog that is not answered, or the last screen, which
        ends the app. A second click, or a message that was under way, is enough for that.
        """
        stack = self.app.screen_stack
        on_top = bool(stack) and stack[-1] is self
        return super().dismiss(result) if on_top else AwaitComplete()

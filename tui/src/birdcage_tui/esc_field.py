"""A text field that says what Esc does at this moment: it stops the dish first, wherever it may move."""

from __future__ import annotations

from textual.widgets import Input

from birdcage_tui.stop_words import esc_text
from birdcage_tui.view import View


class EscField(Input):
    """`hints` tell what to type and what Enter does, the longest first: the first that fits is shown.

    `closes` is what Esc does while nothing moves.
    """

    def __init__(self, *hints: str, closes: str, id: str | None = None) -> None:  # noqa: A002
        super().__init__(placeholder=hints[0], id=id, disabled=True)
        self._hints, self._closes = hints, closes

    def show(self, view: View) -> None:
        """Renew the placeholder."""
        esc = esc_text(view, closes=self._closes)
        said = [f"{hint}, {esc}" for hint in self._hints]
        width = self.content_size.width
        words = next((each for each in said if not width or len(each) <= width), said[-1])
        if self.placeholder != words:
            self.placeholder = words

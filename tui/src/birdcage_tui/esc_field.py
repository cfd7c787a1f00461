"""A text field that says what Esc does at this moment: it stops the dish first, wherever it may move."""

from __future__ import annotations

from textual.widgets import Input

from birdcage_tui.stop_words import esc_text
from birdcage_tui.view import View


class EscField(Input):
    """`hint` tells what to type and what Enter does; `closes` what Esc does while nothing moves."""

    def __init__(self, hint: str, *, closes: str, id: str | None = None) -> None:  # noqa: A002
        super().__init__(placeholder=hint, id=id, disabled=True)
        self._hint, self._closes = hint, closes

    def show(self, view: View) -> None:
        """Renew the placeholder."""
        words = f"{self._hint}, {esc_text(view, closes=self._closes)}"
        if self.placeholder != words:
            self.placeholder = words

"""What the app says to a person: notes each sentence of each screen it is shown, and each text that a pane cut off."""

from __future__ import annotations

import stand_in
from birdcage_tui.drawing.canvas import Cells
from textual.widgets import Input

from tests.house.habits import habits_filled_in
from tests.house.on_screen import of_screen


class Said:
    """All sentences so far with the place where each was first said, and what is wrong with them."""

    def __init__(self, monkeypatch):
        self.sentences = {}
        self.cut = {}
        self._place = ""
        self._drawn = {}
        put = Cells.put

        def put_whole(cells, x, y, text, ink="text"):
            left = cells.width - x
            if 0 <= y < cells.height and 0 < left < len(text) and text[left - 1].isalpha() and text[left].isalpha():
                self._drawn[text] = text[:left]
            return put(cells, x, y, text, ink)

        monkeypatch.setattr(Cells, "put", put_whole)

    def begin(self, place):
        """Name the place that is drawn next."""
        self._place = place

    def read(self, app):
        """Note what stands on the screen."""
        seen = stand_in.text_of(app)
        for sentence in of_screen(seen, self._place):
            self.sentences.setdefault(sentence.text, sentence)
        for text, shown in self._drawn.items():
            if shown in seen:  # it may have been drawn at a size that is gone
                self.cut.setdefault(text, (self._place, shown))
        self._drawn.clear()
        for field in app.screen.query(Input):
            if field.is_on_screen and not field.value and 0 < field.content_size.width < len(field.placeholder):
                self.cut.setdefault(field.placeholder, (self._place, field.placeholder[: field.content_size.width]))

    def check(self):
        """Assert that no sentence has a bad habit, and that no text lost the end of a word without telling so."""
        wrong = [
            f"{sentence.where}: {', '.join(found)}: {sentence.text}"
            for sentence in self.sentences.values()
            if (found := habits_filled_in(sentence))
        ]
        wrong += [f"{place}: cut off after {shown!r}: {text!r}" for text, (place, shown) in self.cut.items()]
        assert not wrong, "\n".join(wrong)

"""Jump to any control: a label on everything that can have the focus or be clicked."""

from __future__ import annotations

import math
from dataclasses import dataclass

from textual import events
from textual.app import ComposeResult
from textual.geometry import Offset, Region
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import Static

from birdcage_tui.commands import BY_NAME
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.status import TopRow

LETTERS = "asdfgqwertzuiopyxcvbnmhjkl"
"""In the order in which they are given out: those under the left hand first. A digit is the key of a page."""
HINT = " Type a label to go there. ; closes. "


@dataclass(frozen=True, slots=True)
class JumpTarget:
    """One thing to jump to: a widget that takes the focus, or a command that is written on one."""

    label: str
    region: Region
    widget: Widget
    command: str | None = None

    @property
    def cap(self) -> int:
        """Columns of its label: as many as the key that it lies on."""
        shown = BY_NAME[self.command].shown if self.command in BY_NAME else ""
        drawn = self._key_width()
        wide = drawn if 0 < drawn < self.region.width else max(len(shown) + 2, 3)
        return min(wide, max(self.region.width, 3))

    def _key_width(self) -> int:
        """Return how many columns a key is drawn in, from the left end; 0 where none is."""
        if not isinstance(self.widget, Pane):
            return 0
        corner = self.region.offset - self.widget.content_region.offset
        return self.widget.run_of("key", corner.x, corner.y)


def _corner(widget: Widget) -> Offset:
    """Return where its frame begins, which may be that of the box that it fills: there it covers no words."""
    framed = next((each for each in (widget, widget.parent) if isinstance(each, Widget) and each.styles.border_top[0]),
                  widget)  # fmt: skip
    return framed.region.offset


def targets(screen: Screen[object]) -> tuple[JumpTarget, ...]:
    """Return everything on the screen that a person could go to, from the top left."""
    found: list[tuple[Region, Widget, str | None]] = []
    for widget in screen.query("*"):
        region = widget.region
        if not widget.is_on_screen or not region.area or not screen.region.contains_region(region):
            continue
        if widget.focusable:
            found.append((region, widget, None))
        if isinstance(widget, Pane):
            inside = widget.content_region
            found += [(spot.translate(inside.offset), widget, command) for spot, command in widget.hot]
    found.sort(key=lambda each: (each[0].y, each[0].x))
    return tuple(
        JumpTarget(label, region, widget, command)
        for label, (region, widget, command) in zip(labels(len(found)), found, strict=False)
    )


def labels(count: int) -> list[str]:
    """Return so many labels, none the beginning of another: one letter each, two where the letters run out.

    With p of the n letters kept to begin pairs there are n - p + p n labels: p is the fewest that suffice.
    """
    begin = min(max(math.ceil((count - len(LETTERS)) / (len(LETTERS) - 1)), 0), len(LETTERS))
    single = len(LETTERS) - begin
    pairs = [first + second for first in LETTERS[single:] for second in LETTERS]
    return [*LETTERS[:single], *pairs][:count]


class JumpScreen(Dialog[JumpTarget | None]):
    """The page shines through; a label goes there, any other key closes."""

    def __init__(self, places: tuple[JumpTarget, ...]) -> None:
        super().__init__()
        self._places = {place.label: place for place in places}
        self._typed = ""

    def compose(self) -> ComposeResult:
        """A label at the corner of each target."""
        yield TopRow()
        yield Static(HINT, id="jump-hint", markup=False)
        for text, place in self._places.items():
            label = Static(f"{text:^{place.cap}}", classes="jump", name=text, markup=False)
            label.absolute_offset = place.region.offset if place.command else _corner(place.widget)
            label.styles.width = place.cap
            yield label

    def on_key(self, event: events.Key) -> None:
        """Go there, wait for the second letter, or close."""
        event.stop()
        self._typed += event.character or " "
        left = [text for text in self._places if text.startswith(self._typed)]
        if self._typed in self._places or not left:
            self.dismiss(self._places.get(self._typed))
        for label in self.query(".jump"):
            label.display = label.name in left

    def on_click(self, event: events.Click) -> None:
        """Close."""
        event.stop()
        self.dismiss(None)

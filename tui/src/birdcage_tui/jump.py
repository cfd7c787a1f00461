"""Jump to any control: a letter on everything that can have the focus or be clicked."""

from __future__ import annotations

from dataclasses import dataclass

from textual import events
from textual.app import ComposeResult
from textual.geometry import Offset, Region
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import Static

from birdcage_tui.commands import BY_NAME
from birdcage_tui.dialogs import Dialog
from birdcage_tui.pane import Pane
from birdcage_tui.status import TopRow

LETTERS = "asdfgqwertzuiopyxcvbnmhjkl1234567890"
"""In the order in which they are given out: those under the left hand first."""
HINT = " Type a label to go there. ; closes. "


@dataclass(frozen=True, slots=True)
class Target:
    """One thing to jump to: a widget that takes the focus, or a command that is written on one."""

    letter: str
    region: Region
    widget: Widget
    command: str | None = None

    @property
    def cap(self) -> int:
        """Columns of its label: as many as the key that it lies on."""
        shown = BY_NAME[self.command].shown if self.command in BY_NAME else ""
        return min(max(len(shown) + 2, 3), max(self.region.width, 3))


def _corner(widget: Widget) -> Offset:
    """Return where its frame begins, which may be that of the box that it fills: there it covers no words."""
    framed = next((each for each in (widget, widget.parent) if isinstance(each, Widget) and each.styles.border_top[0]),
                  widget)  # fmt: skip
    return framed.region.offset


def targets(screen: Screen[object]) -> tuple[Target, ...]:
    """Return everything on the screen that a person could go to, from the top left; as many as there are letters."""
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
        Target(letter, region, widget, command)
        for letter, (region, widget, command) in zip(LETTERS, found, strict=False)
    )


class JumpScreen(Dialog[Target | None]):
    """The page shines through; a letter goes there, any other key closes."""

    def __init__(self, places: tuple[Target, ...]) -> None:
        super().__init__()
        self._places = {place.letter: place for place in places}

    def compose(self) -> ComposeResult:
        """A label at the corner of each target."""
        yield TopRow()
        yield Static(HINT, id="jump-hint", markup=False)
        for letter, place in self._places.items():
            label = Static(f"{letter:^{place.cap}}", classes="jump", markup=False)
            label.absolute_offset = place.region.offset if place.command else _corner(place.widget)
            label.styles.width = place.cap
            yield label

    def on_key(self, event: events.Key) -> None:
        """Go there, or close."""
        event.stop()
        self.dismiss(self._places.get(event.character or ""))

    def on_click(self, event: events.Click) -> None:
        """Close."""
        event.stop()
        self.dismiss(None)

"""The floor: the least Textual app that paints a frame and a line, and quits on Ctrl+Q."""

from __future__ import annotations

from textual.app import App, ComposeResult
from textual.widgets import Static


class Minimal(App[None]):
    CSS = "Static { border: round; height: 1fr; }"

    def compose(self) -> ComposeResult:
        yield Static("--.--")


if __name__ == "__main__":
    Minimal().run()

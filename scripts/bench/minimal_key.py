"""The floor of `stop_latency.py`: the least Textual app that answers a key with one byte on a port."""

from __future__ import annotations

import os
import sys

from textual import events
from textual.app import App, ComposeResult
from textual.widgets import Static


class Minimal(App[None]):
    def __init__(self, port: str) -> None:
        super().__init__()
        self._port = os.open(port, os.O_RDWR | os.O_NOCTTY)

    def compose(self) -> ComposeResult:
        yield Static("ready")

    def on_key(self, _event: events.Key) -> None:
        os.write(self._port, b"x")


if __name__ == "__main__":
    Minimal(sys.argv[1]).run()

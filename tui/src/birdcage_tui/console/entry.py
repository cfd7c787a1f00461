"""The two lines a person types into: one for the dish, one to search with."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import cast

from textual.binding import Binding
from textual.widgets import Input

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.widgets.esc_field import LeaveField


class ConsoleInput(Input):
    """One line for the dish. Space types a space here; Ctrl+C stops."""

    HELP = (
        "A line for the dish's own console. The first Enter takes control and pauses polling (TALK). 30 s idle, or F5, "
        "returns control. A line that changes a setting needs Enter twice. One that moves the dish or can damage it "
        "asks first. Your limits do not apply here. Space types a space. Ctrl+C stops the dish. F-keys change the "
        "page above. The console stays open."
    )
    # Tab would leave the line: the screen's own binding comes before those of the app.
    BINDINGS = [Binding("tab", "complete", show=False)]  # noqa: RUF012

    def __init__(self, do: Callable[[str], bool]) -> None:
        super().__init__(select_on_focus=False)
        self._do = do

    @property
    def scope(self) -> str:
        """Its commands' `where`."""
        return "console-input"

    def do(self, command: str) -> bool:
        """Have the console around it do it."""
        return self._do(command)

    def action_complete(self) -> None:
        """Complete what was typed."""
        cast(AppHost, self.app).action_command("console-complete")


class Purpose(Enum):
    """What is searched."""

    LOG = "find"
    HISTORY = "recall"


class FindInput(LeaveField):
    """Searches the log, or the lines typed before, while one types."""

    HELP = (
        "Searches while you type. Enter accepts. Backspace leaves the empty line; at rest Esc leaves. Space types a "
        "space. Ctrl+C stops the dish."
    )

    def __init__(self, do: Callable[[str], bool]) -> None:
        super().__init__(select_on_focus=False, disabled=True)
        self._do = do
        self.purpose = Purpose.LOG
        self.display = False

    @property
    def scope(self) -> str:
        """Its commands' `where`."""
        return "console-find"

    def do(self, command: str) -> bool:
        """Have the console around it do it."""
        return self._do(command)

    def open(self, purpose: Purpose) -> None:
        """Show it, and take the focus."""
        self.purpose = purpose
        self.disabled = False
        self.display = True
        self.value = ""
        self.placeholder = "part of a line you typed" if purpose is Purpose.HISTORY else "text in the log"
        self.screen.set_focus(self)

    def close(self) -> None:
        """Hide it. Whoever closes it has given the focus to something else."""
        self.display = False
        self.disabled = True

"""What each command does: a request to the station, a dialog, another page, or a command of the page that is seen."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

from birdcage.base.errors import BirdcageError
from birdcage.station.access import FaceStation
from birdcage.station.requests import AcknowledgeFault, Release
from textual.app import App

from birdcage_tui import commands
from birdcage_tui.commands.jog import DIRECTIONS, SKEW_DIRECTIONS
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.pages.dashboard import DashboardPage
from birdcage_tui.shell.appearance import next_theme
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shell.live_context import ContextHost, LiveContext
from birdcage_tui.shell.questions import Questions
from birdcage_tui.shown.unready import SETUP, setup_step
from birdcage_tui.shown.view import YOU
from birdcage_tui.widgets.help import HelpScreen, help_words
from birdcage_tui.widgets.jump import JumpScreen, JumpTarget, targets
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.palette import Palette


class DeedHost(ContextHost, Protocol):
    """The app, seen from its commands."""

    settings: AppOptions
    station: FaceStation
    questions: Questions
    keys: KeyQueue

    @property
    def page(self) -> Page:
        """The page that is seen."""

    def end_tour(self) -> None:
        """Let the demo do nothing by itself any more."""

    def leave(self) -> None:
        """End the app."""


class Deeds:
    """Does the commands of the table, or says why not."""

    def __init__(self, app: App[None], host: DeedHost) -> None:
        self._app, self._host = app, host
        questions = host.questions
        self._deeds: dict[str, Callable[[], object]] = {
            **{f"page-{name}": partial(host.show_page, name) for name, _, _ in commands.PAGES},
            SETUP: self._show_setup,
            **{name: partial(self._jog, steps) for name, steps in DIRECTIONS.items()},
            **{name: partial(self._jog_skew, steps) for name, steps in SKEW_DIRECTIONS.items()},
            "step-up": partial(self._change_step, 1),
            "step-down": partial(self._change_step, -1),
            "stop": self.stop,
            "release": self.release,
            "goto": self.open_goto,
            "skew": partial(self.open_goto, "skew "),
            "home": questions.home,
            "sync": questions.sync.ask,
            "resume": self._resume,
            "search": questions.end_search,
            "help": self._show_help,
            "jump": self._show_jump,
            "palette": self._show_palette,
            "elements-add": questions.elements,
            "place-set": questions.place,
            "theme": self._next_theme,
            "quit": host.leave,
        }
        """What the app itself does for a command; a page does the others."""

    def do(self, name: str) -> None:
        """Do the command, or say why not; nothing between two dishes, where no page is seen."""
        if self._host.stage.seen() is None:
            return
        command = commands.BY_NAME[name]
        reason = command.refused(LiveContext(self._host.station.state, self._host))
        if reason is not None:
            self._host.say("" if name == "release" else reason)
            return
        for scope in self._host.stage.scopes():
            if scope.scope in command.where and scope.do(name):
                return
        deed = self._deeds.get(name)
        if deed is not None:
            deed()
        else:
            # Another page's: go there, and do it.
            self._host.show_page(command.page or command.where[0], then=name)

    # The motions of the dish that is shown at that moment.

    def _jog(self, steps: tuple[float, float]) -> None:
        self._host.motions.jog(*steps)

    def _jog_skew(self, steps: float) -> None:
        self._host.motions.jog_skew(steps)

    def _change_step(self, by: int) -> None:
        self._host.motions.change_step(by)

    def _resume(self) -> None:
        self._host.motions.resume()

    def _show_setup(self) -> None:
        """Show the page; from the dashboard, with the cursor on the step that it says comes next."""
        step = setup_step(self._host.view()) if isinstance(self._host.page, DashboardPage) else None
        self._host.show_page("setup", then=f"look-{step}" if step else None)

    def open_goto(self, text: str = "") -> None:
        """Open the go-to line, over whatever page is seen."""
        self._app.screen_stack[0].query_one(GotoLine).open(text)

    def stop(self) -> None:
        """STOP, for every dish."""
        self._host.dishes.stop(YOU)
        self._host.end_tour()
        self._host.say("STOP.")

    def release(self) -> None:
        """Acknowledge a fault; with none, let go of HELD; with neither, accept the dish's own limits. Of this dish."""
        state = self._host.station.state
        if state.fault is not None:
            self._host.ask(AcknowledgeFault(YOU))
        elif state.held is not None:
            self._host.keys.let_go(lambda: self._host.ask(Release(YOU)))
        elif state.motion_refused_because:
            self._host.questions.limits(state.motion_refused_because)
        self._host.say("")

    def _show_help(self) -> None:
        """Show what can be done here, and do what is chosen there."""

        def chosen(name: str | None) -> None:
            if name is not None:
                self.do(name)

        self._app.push_screen(
            HelpScreen(self._host.view(), help_words(self._app.screen.focused, self._host.page.part)), chosen
        )

    def _show_palette(self) -> None:
        """Show every command by its name."""
        if not isinstance(self._app.screen, Palette):
            self._app.push_screen(Palette())

    def _show_jump(self) -> None:
        """Put a letter on everything that can be reached; go to the one that is chosen."""

        def chosen(target: JumpTarget | None) -> None:
            if target is None:
                return
            if target.command is not None:
                self.do(target.command)
            else:
                self._app.screen.set_focus(target.widget)
                self._host.paint()

        self._app.push_screen(JumpScreen(targets(self._app.screen_stack[0])), chosen)

    def _next_theme(self) -> None:
        """Change to the next look, and keep it for the next start."""
        self._app.theme = next_theme(self._app.theme)
        if self._host.settings.keep_theme is not None:
            try:
                self._host.settings.keep_theme(self._app.theme)
            except BirdcageError as wrong:
                self._host.say(f"The theme was not saved. {wrong}")

"""The app: what the commands do. Every deed is a request to the station or a change of what is shown."""

from __future__ import annotations

import signal
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from functools import partial

from birdcage.base.errors import BirdcageError
from birdcage.base.signals import STATUS
from birdcage.station.requests import (
    AcceptLimits,
    AcknowledgeFault,
    AcquireLease,
    Goto,
    Home,
    Jog,
    Release,
    ReleaseLease,
    Request,
    SetSearch,
    Stow,
    TurnSkew,
)

from birdcage_tui.commands import BY_NAME, for_key
from birdcage_tui.commands.jog import DIRECTIONS, SKEW_DIRECTIONS, STEPS_DEG
from birdcage_tui.drawing.themes import LOOKS
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.goto.reach import refusal_of
from birdcage_tui.pages.dashboard import DashboardPage
from birdcage_tui.shell.adding import ask_elements, ask_place
from birdcage_tui.shell.shell import Shell
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.stop_words import power_switch
from birdcage_tui.shown.unready import SETUP, setup_step
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.help import HelpScreen, help_words
from birdcage_tui.widgets.jump import JumpScreen, JumpTarget, targets
from birdcage_tui.widgets.messages import CommandChosen
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.palette import Palette

Motion = Goto | Jog | TurnSkew | Home | Stow


class BirdcageApp(Shell):
    """A ground station in a terminal."""

    anew = False
    """Whether the app is to begin again at once, with another session."""
    _skew_sent: float | None = None
    """Where the skew was sent last."""
    _skew_turns: frozenset[Future[object]] | set[Future[object]] = frozenset()
    """Its turn, while that is not at its end."""

    ended_by: int | None = None
    """The signal that ends the app."""
    take_signal: Callable[[int], object] | None = None
    """Ends the app as that signal does, and its process if the app does not end; `run` sets it."""

    def on_mount(self) -> None:
        """End at once where a signal came before there was an app to end."""
        if self.ended_by is not None:
            self.leave("signal", STATUS + self.ended_by)

    def action_key(self, key: str) -> None:
        """Do what the key means to what has the focus."""
        command = for_key(key, [scope.scope for scope in self.scopes()])
        if command is not None:
            self.action_command(command.name)

    def action_command(self, name: str) -> None:
        """Do the command, or say why not."""
        command = BY_NAME[name]
        reason = command.refused(self.view())
        if reason is not None:
            self.say("" if name == "release" else reason)
            return
        for scope in self.scopes():
            if scope.scope in command.where and scope.do(name):
                return
        deed = self._deed(name)
        if deed is not None:
            deed()
        else:
            # Another page's: go there, and do it.
            self.show_page(command.page or command.where[0], then=name)

    def _deed(self, name: str) -> Callable[[], object] | None:
        """Return what the app itself does for a command; None for what a page does."""
        if name == SETUP and isinstance(self.page, DashboardPage) and (step := setup_step(self.view())):
            return lambda: self.show_page("setup", then=f"look-{step}")
        if name.startswith("page-"):
            return lambda: self.show_page(name.removeprefix("page-"))
        if name in DIRECTIONS:
            return lambda: self.jog(*DIRECTIONS[name])
        if name in SKEW_DIRECTIONS:
            return lambda: self.jog_skew(SKEW_DIRECTIONS[name])
        deeds: dict[str, Callable[[], object]] = {
            "stop": self.stop_now,
            "release": self.release,
            "goto": self.open_goto,
            "step-up": lambda: self.change_step(1),
            "step-down": lambda: self.change_step(-1),
            "home": self.ask_home,
            "resume": self.resume,
            "skew": lambda: self.open_goto("skew "),
            "search": self.ask_end_search,
            "help": self.show_help,
            "jump": self.show_jump,
            "palette": self.show_palette,
            "elements-add": lambda: ask_elements(self),
            "place-set": lambda: ask_place(self),
            "theme": self.next_theme,
            "quit": self.leave,
        }
        return deeds.get(name)

    def ask(self, request: Request) -> None:
        """Submit a request; if it fails, the sentence of its error is shown."""

        def done(future: Future[object]) -> None:
            self.under_way.discard(future)
            error = None if future.cancelled() else future.exception()
            if error is not None and self._loop is not None and not self._loop.is_closed():
                self._loop.call_soon_threadsafe(self.say, str(error))

        if isinstance(request, Motion):
            reason = refusal_of(request, self.station.state) if self._pursuit_leads else None
            if reason is not None:
                self.say(f"Refused: {reason}")
                return
            request = self._take_back_with(request)
        future = self.station.submit(request)
        if isinstance(request, Motion):
            self.end_tour()
            self.under_way.add(future)
            self.horizon.moved(jog=isinstance(request, Jog))
        future.add_done_callback(done)

    def begin_way(self) -> Future[object]:
        """Count a motion of yours that somebody else will submit as under way, until what is returned is done."""
        self.end_tour()
        self.horizon.moved(jog=False)
        way: Future[object] = Future()
        self.under_way.add(way)
        way.add_done_callback(self.under_way.discard)
        return way

    def _take_back_with(self, request: Motion) -> Motion:
        """Take control from your own pursuit with a motion: that it is by hand is word enough that you want it back.

        The station judges first: a pass that is followed is not left for a motion that it refuses.
        """
        if not self._pursuit_leads:
            return request
        if isinstance(request, Home | Stow):
            self.station.submit(AcquireLease(YOU, take_over=True))
            return request
        return replace(request, take_over=True)

    @property
    def _pursuit_leads(self) -> bool:
        pursuit = pursuit_of(self.view())
        return pursuit is not None and self.station.state.holder == pursuit.holder != YOU

    def open_goto(self, text: str = "") -> None:
        """Open the go-to line, over whatever page is seen."""
        self.screen_stack[0].query_one(GotoLine).open(text)

    def jog(self, az_steps: float, el_steps: float) -> None:
        """Step from the last commanded target."""
        self.ask(Jog(az_steps * self.step_deg, el_steps * self.step_deg, YOU))

    def jog_skew(self, steps: float) -> None:
        """Step the skew from where it was sent last, so that ten presses are ten steps; within its range."""
        state = self.station.state
        here = None if state.position is None else state.position.skew_deg
        sent = self._skew_sent if any(not each.done() for each in self._skew_turns) else state.target_skew_deg
        start = here if sent is None else sent
        if start is None or state.dish is None or state.dish.skew is None:
            self.say("The skew is unknown. S turns it to an angle.")
            return
        low, high = state.dish.skew.min_deg, state.dish.skew.max_deg
        self.turn_skew(min(max(start + steps * self.step_deg, low), high))

    def turn_skew(self, deg: float) -> None:
        """Turn the feed about the beam."""
        self._skew_sent = deg
        before = set(self.under_way)
        self.ask(TurnSkew(deg, YOU))
        self._skew_turns = self.under_way - before

    def ask_end_search(self) -> None:
        """Ask in words, then end the firmware's TV search."""
        words = (
            "This ends the firmware's TV search, and the dish stays in place. "
            "The search starts again at each power-up. This dish has no setting to disable it."
        )

        def answered(yes: bool | None) -> None:
            if yes:
                self.ask(SetSearch(YOU, disabled=True))

        self.push_screen(QuestionScreen("End the TV search", words, "end it"), answered)

    def change_step(self, by: int) -> None:
        """Make a jog step larger or smaller."""
        index = STEPS_DEG.index(self.step_deg) + by
        self.step_deg = STEPS_DEG[min(max(index, 0), len(STEPS_DEG) - 1)]
        self.say(f"One step is {self.step_deg:g}°.")

    def stop_now(self) -> None:
        """STOP."""
        self.station.stop(YOU)
        self.end_tour()
        self.say("STOP.")

    def release(self) -> None:
        """Acknowledge a fault; with none, let go of HELD; with neither, accept the dish's own limits."""
        state = self.station.state
        if state.fault is not None:
            self.ask(AcknowledgeFault(YOU))
        elif state.held is not None:
            self.ask(Release(YOU))
        elif state.motion_refused_because:
            self.ask_limits(state.motion_refused_because)
        self.say("")

    def resume(self) -> None:
        """Follow again what was interrupted: release first what is held, and go on once that is done."""
        if self.station.state.held is None:
            self._resume()
            return

        def released(future: Future[object]) -> None:
            error = None if future.cancelled() else future.exception()
            self.soon(self._resume if error is None else partial(self.say, str(error)))

        self.station.submit(Release(YOU)).add_done_callback(released)

    def _resume(self) -> None:
        source, now = self.track.source, self.track.now
        if source is None or now is None:
            return
        if self.station.state.holder == YOU:
            self.ask(ReleaseLease(YOU))
        if now.resumable is not None:
            source.resume()
        else:
            source.take_up()
        self.say("")

    def ask_limits(self, because: str) -> None:
        """Ask in words, then move within the dish's own limits although yours could not be read."""
        words = (
            f"{because}\n\nUntil you fix the file, only the dish's own limits apply. Your limits are unknown: "
            "a wall or a low roof does not stop a motion. Nothing moves now."
        )

        def answered(yes: bool | None) -> None:
            if yes:
                self.ask(AcceptLimits(YOU))

        self.push_screen(
            QuestionScreen("Move without your own limits", words, "accept the dish's own limits"), answered
        )

    def ask_home(self) -> None:
        """Ask in words, then home."""
        dish = self.station.state.dish
        takes = "T" if dish is None or dish.homing_s is None else f"In up to {dish.homing_s * 2:.0f} s t"
        stoppable = dish is not None and dish.homing_stoppable
        words = f"{takes}he dish turns through its whole range and runs into its end stops. Keep its swing clear."
        if not stoppable:
            words += f" Homing can't be stopped: keep a hand on the {power_switch(self.view())}."

        def answered(yes: bool | None) -> None:
            if yes:
                self.ask(Home(YOU))

        self.push_screen(QuestionScreen("Home the dish", words, "area is clear: home"), answered)

    def show_help(self) -> None:
        """Show what can be done here, and do what is chosen there."""

        def chosen(name: str | None) -> None:
            if name is not None:
                self.action_command(name)

        self.push_screen(HelpScreen(self.view(), help_words(self.screen.focused, self.page.part)), chosen)

    def show_palette(self) -> None:
        """Show every command by its name."""
        if not isinstance(self.screen, Palette):
            self.push_screen(Palette())

    def show_jump(self) -> None:
        """Put a letter on everything that can be reached; go to the one that is chosen."""

        def chosen(target: JumpTarget | None) -> None:
            if target is None:
                return
            if target.command is not None:
                self.action_command(target.command)
            else:
                self.screen.set_focus(target.widget)
                self.paint()

        self.push_screen(JumpScreen(targets(self.screen_stack[0])), chosen)

    def move_to(self, place: SitePlace) -> None:
        """Let every page and the search for passes count from another place."""
        self.settings = replace(self.settings, place=place)
        for page in self.screen_stack[0].query(Page):
            page.place_changed()
        self.horizon.place_changed()
        self._keep_sky()

    def next_theme(self) -> None:
        """Change to the next look, and keep it for the next start."""
        names = list(LOOKS)
        self.theme = names[(names.index(self.theme) + 1) % len(names)] if self.theme in names else names[0]
        if self.settings.keep_theme is not None:
            try:
                self.settings.keep_theme(self.theme)
            except BirdcageError as wrong:
                self.say(f"The theme was not saved. {wrong}")

    def begin_anew(self) -> None:
        """End, and begin again with the settings as they are then: the dish is another one than was thought."""
        self.anew = True
        self.leave()

    def leave(self, by: str = YOU, status: int = 0) -> None:
        """STOP first if anything moves; give the terminal back; `main` closes the session."""
        self._stop_what_moves(by)
        self.keys.close()
        self.sky.close()
        self.exit(return_code=status)

    def _stop_what_moves(self, by: str) -> None:
        moving = View(self.station.state, 0.0, self.session.clock.utc(), self.settings).moving
        # It waits for nothing. Told after STOP, the desk would take what is followed for ended, and not offer it again.
        self.track.close()
        if moving:
            self.station.stop(by, leaving=True)

    def _handle_exception(self, error: Exception) -> None:
        """End the app by an error. A layer or a page that was still being made when a person left is none."""
        if self.keys.closed:
            self._close_messages_no_wait()
        else:
            super()._handle_exception(error)

    def end_by_signal(self, number: int) -> None:
        """End as Ctrl+Q does. Any thread: STOP goes out from here, as the app's own thread may be stuck."""
        self.ended_by = number
        self._stop_what_moves("signal")
        self.soon(partial(self.leave, "signal", STATUS + number))

    def terminal_gone(self) -> None:
        """End as by SIGHUP: the driver has found the terminal closed. Any thread."""
        (self.take_signal or self.end_by_signal)(signal.SIGHUP)

    @property
    def fault(self) -> Exception | None:
        """What ended the app, if a fault of birdcage did."""
        return self._exception

    def restore_terminal(self) -> bool:
        """Give the terminal back where the app's own thread no longer can; return whether it takes any words."""
        restore: Callable[[], bool] | None = getattr(self._driver, "restore", None)
        return restore is not None and restore()

    def on_stop_button_pressed(self) -> None:
        """The mouse stops."""
        self.stop_now()

    def on_bad_day_row_pressed(self) -> None:
        """The mouse releases or acknowledges."""
        self.release()

    def on_command_chosen(self, event: CommandChosen) -> None:
        """The mouse does what a key does."""
        self.action_command(event.name)

    def on_goto_line_sent(self, event: GotoLine.Sent) -> None:
        """Go where the person typed."""
        self.ask(Goto(event.az_deg, event.el_deg, YOU))

    def on_goto_line_skew_sent(self, event: GotoLine.SkewSent) -> None:
        """Turn the skew to what the person typed."""
        self.turn_skew(event.deg)

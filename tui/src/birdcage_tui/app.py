"""The app: what the commands do. Every deed is a request to the station or a change of what is shown."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable
from concurrent.futures import Future

from birdcage.station.requests import AcceptLimits, AcknowledgeFault, Goto, Home, Jog, Release, Request

from birdcage_tui.commands import BY_NAME
from birdcage_tui.dialogs import GotoLine, HelpScreen, QuestionScreen
from birdcage_tui.footer import KeyBar
from birdcage_tui.shell import Shell
from birdcage_tui.themes import LOOKS

YOU = "you"
STEP_DEG = 1.0
STEPS = {
    "left": (-STEP_DEG, 0.0),
    "right": (STEP_DEG, 0.0),
    "up": (0.0, STEP_DEG),
    "down": (0.0, -STEP_DEG),
}


class BirdcageApp(Shell):
    """A ground station in a terminal."""

    def on_mount(self) -> None:
        """End as Ctrl+Q does when the system says so."""
        self._catch_signals()

    def action_command(self, name: str) -> None:
        """Do the command, or say why not."""
        reason = BY_NAME[name].refused(self.view())
        if reason is not None:
            self.say("" if name == "release" else reason)
            return
        self._deed(name)()

    def _deed(self, name: str) -> Callable[[], object]:
        if name.startswith("page-"):
            return lambda: self.show_page(name.removeprefix("page-"))
        if name in STEPS:
            return lambda: self.ask(Jog(*STEPS[name], YOU))
        deeds: dict[str, Callable[[], object]] = {
            "stop": self.stop_now,
            "release": self.release,
            "goto": lambda: self.query_one(GotoLine).open(),
            "home": self.ask_home,
            "help": lambda: self.push_screen(HelpScreen(self.view())),
            "palette": self.action_command_palette,
            "theme": self.next_theme,
            "quit": self.leave,
        }
        return deeds[name]

    def say(self, words: str) -> None:
        """Put a sentence into row 2, where the calm line is."""
        self._note = words
        self.paint()

    def ask(self, request: Request) -> None:
        """Submit a request; if it fails, the sentence of its error is shown."""

        def done(future: Future[object]) -> None:
            error = None if future.cancelled() else future.exception()
            if error is not None and self._loop is not None and not self._loop.is_closed():
                self._loop.call_soon_threadsafe(self.say, str(error))

        self.station.submit(request).add_done_callback(done)

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

    def ask_limits(self, because: str) -> None:
        """Ask in words, then move within the dish's own limits although yours could not be read."""
        words = (
            f"{because}\n\nUntil the file is mended, the dish would move within its own limits only: yours, "
            "such as a wall or a low roof that you had told it of, are not known and not kept. Nothing moves by this."
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
        words = f"{takes}he dish turns through its whole range and knocks at its stops. Keep its swing clear."
        if not stoppable:
            words += " Homing cannot be stopped from here: keep a hand on the 12 V switch."

        def answered(yes: bool | None) -> None:
            if yes:
                self.ask(Home(YOU))

        self.push_screen(QuestionScreen("Home the dish", words, "area is clear: home"), answered)

    def next_theme(self) -> None:
        """Change to the next look."""
        names = list(LOOKS)
        self.theme = names[(names.index(self.theme) + 1) % len(names)] if self.theme in names else names[0]

    def leave(self) -> None:
        """STOP first if anything moves; give the terminal back; `main` closes the session."""
        if self.view().moving:
            self.station.stop(YOU)
        self.exit()

    def _catch_signals(self) -> None:
        """SIGTERM and SIGHUP end the app as Ctrl+Q does, with the customary exit status."""
        loop = asyncio.get_running_loop()
        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(signal, name, None)
            if number is None:
                continue
            try:
                loop.add_signal_handler(number, self._leave_by, int(number))
            except (NotImplementedError, RuntimeError, ValueError):
                return  # no signal handlers on this platform, or not in the main thread: the default action stays

    def _leave_by(self, number: int) -> None:
        if self.view().moving:
            self.station.stop("signal")
        self.exit(return_code=128 + number)

    def on_stop_button_pressed(self) -> None:
        """The mouse stops."""
        self.stop_now()

    def on_bad_day_row_pressed(self) -> None:
        """The mouse releases or acknowledges."""
        self.release()

    def on_key_bar_chosen(self, event: KeyBar.Chosen) -> None:
        """The mouse does what a key does."""
        self.end_tour()
        self.action_command(event.name)

    def on_goto_line_sent(self, event: GotoLine.Sent) -> None:
        """Go where the person typed."""
        self.ask(Goto(event.az_deg, event.el_deg, YOU))

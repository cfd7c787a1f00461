"""F8: from wires to the first satellite, step by step."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.errors import BirdcageError
from birdcage.setup.engine import clear_question
from birdcage.setup.step import Choice
from textual import events, on

from birdcage_tui.setup.body import SetupBody
from birdcage_tui.setup.form import AnswerForm, ChoiceButton
from birdcage_tui.setup.steps import StepsPane
from birdcage_tui.widgets.dialogs import QuestionScreen


class SetupPage(SetupBody):
    """What the keys do. What is seen is in `SetupBody`."""

    HELP = (
        "Eleven steps. Enter does the usual action, letters do the others. Up and down look at other steps and change "
        "nothing; b goes back to the current step, and so does Esc at rest. ▲ marks what moves the dish. The app "
        "first asks whether the area is clear. The arrows don't move the dish here. o opens the page of a step, where "
        "they do; F8 comes back."
    )

    def do(self, command: str) -> bool:
        """Carry out a command of this page; return False for one that it does not know.

        `look-limits` puts the cursor on a step: F1's *What next* leads there.
        """
        if command.startswith("look-"):
            names = [step.name for step in self.views]
            self.look_at(names.index(command.removeprefix("look-")))
            return True
        deeds = {
            "setup-do": self.do_step,
            "setup-up": lambda: self.look(-1),
            "setup-down": lambda: self.look(1),
            "setup-skip": self.skip,
            "setup-back": self.back,
            "setup-open": self.open_page,
            "setup-wiring": self.show_wiring,
            "setup-next-cause": lambda: self.walk(1),
            "setup-previous-cause": lambda: self.walk(-1),
            "setup-goto": self.goto,
            "setup-first": self.show_first,
        }
        if command not in deeds:
            return False
        deeds[command]()
        return True

    # Keys.

    def do_step(self) -> None:
        """Release first, then go to the step that is looked at, then take its main answer."""
        state = self.host.station.state
        main = next((choice for choice in self.answers() if choice.key == "enter"), None)
        if main is not None and main.name == "release":
            self.take(main, typed=False)
            return
        if state.fault is not None or state.held is not None:
            self.host.action_command("release")
            return
        if state.motion_refused_because and not self.limits_asked:
            self.limits_asked = True
            self.host.action_command("release")
            return
        if main is not None:
            self.take(main, typed=False)
        elif self.step.busy:
            self.remark(f"Wait: {self.step.busy}.")
        else:
            keys = " or ".join(choice.key for choice in self.answers())
            self.remark(f"Press {keys}." if keys else "Nothing to do here now.")

    def look(self, by: int) -> None:
        """Look at another step; the wiring scrolls instead while it fills the page."""
        if self.wiring_fills:
            self.scroll_wiring(by)
        else:
            self.look_at(self.looked + by)

    def skip(self) -> None:
        """Leave the step that is looked at. The present one stays, unless it is that."""
        present, step = self.present, self.step.name

        def leave() -> None:
            self.engine.skip(step)
            if step != present:
                self.engine.go(present)

        self._attempt(leave)

    def back(self) -> None:
        """Go to the step before; from one that is only looked at, back to the current step."""
        if self.step.name == self.present:
            self._attempt(self.engine.back)
        self.follow()

    def open_page(self) -> None:
        """Show the step's own page."""
        page = self.step.page
        if page:
            self.host.show_page(page)
        else:
            self.remark(f"Step {self.step.number} has no separate page.")

    def show_wiring(self) -> None:
        """Show the plug, or hide it."""
        self.wiring = not self.wiring
        self.host.paint()

    def show_first(self) -> None:
        """Go to the last step."""
        self._attempt(lambda: self.engine.go("first"))
        self.follow()

    def goto(self) -> None:
        """Open the go-to line, once the area is clear."""
        self._when_clear(lambda: self.host.action_command("goto"))

    def on_key(self, event: events.Key) -> None:
        """Take an answer by its key; Esc goes back to the steps."""
        if event.key == "escape":
            event.stop()
            if not self.typing and not self.wiring:
                self.follow()
            self.wiring = False
            self.focus_steps()
            self.host.paint()
            return
        if self.typing:
            return
        for choice in self.answers():
            if choice.key != "enter" and event.character == choice.key:
                event.stop()
                if choice.far:
                    self.form.focus_button(choice)
                    self.remark(f"Enter: {choice.label}. Nothing moves before.")
                else:
                    self.take(choice, typed=False)
                return

    # Answers.

    @on(ChoiceButton.Pressed)
    def _pressed(self, event: ChoiceButton.Pressed) -> None:
        event.stop()
        self.take(event.choice, typed=any(value.strip() for value in self.form.values(event.choice).values()))

    @on(AnswerForm.Submitted)
    def _submitted(self, event: AnswerForm.Submitted) -> None:
        event.stop()
        self.take(event.choice, typed=True)

    @on(StepsPane.Chosen)
    def _chosen(self, event: StepsPane.Chosen) -> None:
        event.stop()
        self.look_at(event.index)

    def take(self, choice: Choice, *, typed: bool) -> None:
        """Take an answer: its fields first, then the question whether the area is clear, then the engine."""
        if choice.fields and not typed:
            self.form.focus_fields(choice)
            self.host.paint()
            return
        step, values = self.step.name, self.form.values(choice)

        def give() -> None:
            if choice.name == "here":
                self._attempt(lambda: self.engine.go(step))
            elif choice.name == "use-baud":
                rate = {"port": self.host.station.state.port, "baud": str(self.baud_that_mends)}
                self._attempt(lambda: self.engine.choose("link", "other", rate))
            else:
                self._attempt(lambda: self.engine.choose(step, choice.name, values))
            if not self.wrong:
                self.form.forget(step)

        if choice.name == "release":
            self.host.keys.let_go(give)
        elif choice.moves:
            self._when_clear(give)
        else:
            give()

    def _when_clear(self, then: Callable[[], None]) -> None:
        if self.engine.area_clear:
            then()
            return

        def answered(yes: bool | None) -> None:
            if yes:
                self.engine.clear()
                then()
            else:
                self.remark("Nothing moved. Press y when the area is clear.")

        question = clear_question(self.host.station.state.dish)
        self.app.push_screen(QuestionScreen("Is the area clear?", question, "it is clear: go on"), answered)

    def _attempt(self, deed: Callable[[], None]) -> None:
        self.wrong = self.note = ""
        try:
            deed()
        except BirdcageError as error:
            self.wrong = str(error)
        else:
            self.focus_steps()
        self.host.paint()

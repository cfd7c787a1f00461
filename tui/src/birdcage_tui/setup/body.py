"""What the setup page shows: the list of steps, and the one that is looked at. Where it stands is in `layout`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

from birdcage.setup.case import Cause
from birdcage.setup.step import Choice, Mark, StepView
from birdcage.setup.wiring import connectors_of
from birdcage.station.state import LinkPhase
from textual.app import ComposeResult
from textual.containers import Container, Vertical, VerticalScroll
from textual.widgets import Input

from birdcage_tui.calibrate.tabs import SetupTabs
from birdcage_tui.feeds.setup_engine import SetupEngine
from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.setup.absent import AbsentSetup
from birdcage_tui.setup.causes import told_apart
from birdcage_tui.setup.extra import ExtraKind, ExtraPane, kind_for
from birdcage_tui.setup.form import AnswerForm
from birdcage_tui.setup.setup_host import SetupHost
from birdcage_tui.setup.setup_layout import SetupLayout, lay_out
from birdcage_tui.setup.setup_words import StepText, StepWords
from birdcage_tui.setup.steps import StepsPane
from birdcage_tui.shown.hardware import hardware_words
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import View

HERE = Choice("here", "enter", "Go to this step")
HAND_STEPS = ("north", "first")
"""Steps at which a person may want to move the dish by hand."""
HARDWARE_STEPS = ("dish", "home")
"""Where the dish's own word on its hardware matters: before its motors are used."""
HIDDEN_S = 1.0
"""Between two looks at what is under way, whatever page is seen."""
AGAIN = "To repeat a step, select it with the arrows and press Enter. Home the dish after each power-up."


class SetupBody(SetupLayout):
    """Lays out list, words, answers and what belongs under them, for the step that is looked at."""

    WATCHES = frozenset({"position", "health"})
    FIRST_FOCUS = "#setup-steps"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.wrong = ""
        """Why the last answer was not taken."""
        self.note = ""
        """A sentence about the last key. Row 2 may be taken by what is wrong with the dish."""
        self.limits_asked = False
        self.chosen = 0
        """Which of the causes is unfolded."""
        self.causes: tuple[Cause, ...] = ()
        self._place: SitePlace | None = None
        """Where the dish stands, as the other pages were told last."""
        self._busy: tuple[str, float] | None = None
        self._shape: object = None

    def compose(self) -> ComposeResult:
        """The list above, the step, the list below; wider, list and step side by side."""
        yield SetupTabs("setup")
        with Container(id="setup-frame"):
            with Vertical(id="setup-list") as column:
                column.border_title = "Setup: eleven steps"
                steps = StepsPane(id="setup-steps")
                steps.can_focus = True
                yield steps
            with VerticalScroll(id="setup-step", can_focus=False):
                yield StepWords(id="setup-words")
                yield AnswerForm(id="setup-form")
                yield ExtraPane(id="setup-extra")
                yield PointingPane(id="setup-pointing")
                yield ExtraPane(id="setup-below")
            yield StepsPane(id="setup-rest")

    def on_mount(self) -> None:
        """Make the engine, and look at its present step."""
        make = self.host.settings.setup
        self.engine: SetupEngine = AbsentSetup() if make is None else make()
        self.views = self.engine.steps()
        self.follow()
        self.set_interval(HIDDEN_S, self.go_on)

    def go_on(self) -> None:
        """Let what is under way go on while another page is looked at: it ends, and gives control back."""
        if any(step.busy for step in self.views):
            self.engine.tick()
            self.views = self.engine.steps()

    @property
    def under_way(self) -> str:
        """The step that is being done: only this page's engine ends it, and gives control back."""
        return next((step.busy for step in self.views if step.busy), "")

    @property
    def host(self) -> SetupHost:
        """The app."""
        return cast(SetupHost, self.app)

    @property
    def baud_that_mends(self) -> int | None:
        """The rate that the chosen cause asks for."""
        chosen = self.causes[self.chosen : self.chosen + 1]
        return chosen[0].use_baud if chosen else None

    @property
    def typing(self) -> bool:
        """Whether a text field has the focus."""
        return isinstance(self.screen.focused, Input)

    def answers(self) -> tuple[Choice, ...]:
        """Return what can be answered now: only the present step is answered."""
        step = self.step
        if step.name != self.present:
            return (HERE,)
        choices = step.choices
        baud = self.baud_that_mends
        if baud is not None and choices and not any(choice.name == "connect" for choice in choices):
            return (Choice("use-baud", "u", f"Use {baud} baud"), *choices)
        return choices

    def later(self) -> tuple[Choice, ...]:
        """Return what a step that is only looked at will ask."""
        return () if self.step.name == self.present else self.step.choices

    def look_at(self, index: int) -> None:
        """Look at another step."""
        index = min(max(index, 0), len(self.views) - 1)
        if index != self.looked:
            self.looked, self.wrong, self.note = index, "", ""
        self.host.paint()

    def follow(self) -> None:
        """Look at the present step."""
        self.present = self.engine.current
        self.look_at(next(index for index, step in enumerate(self.views) if step.name == self.present))

    def remark(self, words: str) -> None:
        """Say something under the words of the step."""
        self.note, self.wrong = words, ""
        self.host.paint()

    def focus_steps(self) -> None:
        """Give the keys to the page."""
        self.screen.set_focus(self.query_one("#setup-steps"))

    def scroll_wiring(self, by: int) -> None:
        """Move the wiring up or down by some rows."""
        self.query_one("#setup-step", VerticalScroll).scroll_relative(y=by * 4, animate=False)

    def show(self, view: View) -> None:
        """Let the engine go on, and draw what it says."""
        if not self.is_attached or not self.views or not self.size:
            return
        self.engine.tick()
        if self.engine.begin_anew:
            self.host.begin_anew()
            return
        self.views = self.engine.steps()
        if self.engine.current != self.present:
            self.follow_soon(looking=self.step.name != self.present)
        if self.screen.focused is None and self.app.screen is self.screen:
            self.focus_steps()
        self._tell_place()
        self._find_causes(view)
        self._fill(view)
        shape = lay_out(self)
        super().show(view)
        if shape != self._shape:
            # Widths and heights follow only after this frame: look once more when they have.
            self._shape = shape
            self.call_after_refresh(self.host.paint)

    def on_resize(self) -> None:
        """Lay out at the new size."""
        self.call_after_refresh(self.host.paint)

    def follow_soon(self, *, looking: bool) -> None:
        """Go along with the engine to its next step, but not while a person is looking at another one."""
        self.present = self.engine.current
        if looking:
            return
        self.looked = next(index for index, step in enumerate(self.views) if step.name == self.present)
        self.wrong, self.note, self.wiring = "", "", False

    def _find_causes(self, view: View) -> None:
        """Take the causes of silence; with others, the walk begins anew."""
        link = next(step for step in self.views if step.name == "link")
        if link.busy and self.causes:
            return  # what it was before, until there is something new to tell: nothing jumps meanwhile
        causes = self.engine.causes() if view.state.port else ()
        if [cause.title for cause in causes] != [cause.title for cause in self.causes]:
            self.chosen = 0
        self.causes = causes

    def walk(self, by: int) -> None:
        """Go to another cause."""
        self.chosen = min(max(self.chosen + by, 0), max(len(self.causes) - 1, 0))
        self.host.paint()

    def place_changed(self) -> None:
        """Read the place again: it was set from another page."""
        self.engine.read_place()

    def _tell_place(self) -> None:
        """Let every page know where the dish stands, as soon as the setup does."""
        place, host = self.engine.settings.place, self.host
        if place.latitude_deg is None or place.longitude_deg is None:
            return
        here = SitePlace(place.latitude_deg, place.longitude_deg, place.name or "")
        if here != self._place:
            self._place = here
            host.settings = replace(host.settings, place=here)

    def _fill(self, view: View) -> None:
        step, present = self.step, self.step.name == self.present
        if not step.busy:
            self._busy = None
        elif self._busy is None or self._busy[0] != step.name:
            self._busy = (step.name, view.now)
        dish = view.state.dish
        wired = not view.state.port.startswith("sim:") and (dish is None or bool(connectors_of(dish.firmware)))
        kind = kind_for(step.name, mute=bool(self.causes), wiring_asked=self.wiring, wide=self.wide, wired=wired)
        extra = self.query_one("#setup-extra", ExtraPane)
        told = step
        if kind is not ExtraKind.CAUSES:
            extra.seen = ""
        else:
            words, seen = told_apart(step, self.causes, view.state.link.detail)
            extra.seen = extra.seen if step.busy else seen
            told = replace(step, words=words)
        self.query_one(StepWords).telling = StepText(
            told,
            present,
            None if self._busy is None else view.now - self._busy[1],
            wrong=self.wrong,
            whole=kind is not ExtraKind.CAUSES
            and not step.busy
            and self.query_one("#setup-steps", StepsPane).cuts(step),
            news=_finished(self.views) if present and self.engine.finished and not step.busy else (),
            extra=_hardware(step, view)
            + (_asides(self.answers(), step, view) if present else (self._only_looking(view),)),
            note=self.note,
        )
        extra.kind, extra.causes, extra.chosen, extra.place = kind, self.causes, self.chosen, view.settings.place
        dish = view.state.dish
        extra.firmware = None if dish is None else dish.firmware

    def _only_looking(self, view: View) -> str:
        step = next(step for step in self.views if step.name == self.present)
        key = "b goes back. Esc stops the dish." if view.may_move else "Esc goes back."
        return f"Preview. Current step: {step.number} {step.title}. {key}"


def _finished(views: Sequence[StepView]) -> tuple[str, ...]:
    """Sum up a setup in which nothing is open: what was left out is named."""
    skipped = [step.title for step in views if step.mark is Mark.SKIPPED]
    left = f", but for {', '.join(skipped)} (skipped)" if skipped else ""
    return (f"The setup is complete{left}. 1 shows the sky, 2 moves the dish by hand.", AGAIN)


def _hardware(step: StepView, view: View) -> tuple[str, ...]:
    """Return what the dish tells of its own health, at the steps that begin to use it; nothing without a link."""
    told = step.name in HARDWARE_STEPS and view.state.link.state is LinkPhase.UP
    return (f"Hardware: {hardware_words(view)[0]}",) if told else ()


def _asides(answers: Sequence[Choice], step: StepView, view: View) -> tuple[str, ...]:
    """Return what the page itself has to add to a step."""
    state = view.state
    if any(choice.name == "release" and choice.key == "enter" for choice in answers):
        return ()
    if state.fault is not None:
        return ("Enter acknowledges the fault first. Press it again to do the step.",)
    if state.held is not None:
        return ("Enter releases HELD first. Press it again to do the step.",)
    if step.name in HAND_STEPS and step.choices:
        return ("The arrows don't move the dish here. o opens Control, where they do; 8 comes back.",)
    return ()

"""What the commands of a tab of features do: show all of a value, read what has a hazard, set, put back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.rotator.feature import DISEQC, Feature, FeatureKind, Value
from birdcage.station.requests import BeginTask

from birdcage_tui.shown.system_sheet import cell_text
from birdcage_tui.shown.view import YOU
from birdcage_tui.system.ask_feature import (
    DETAIL_WIDTH,
    lines_screen,
    new_value,
    read_value,
    set_question,
    value_field,
)
from birdcage_tui.system.sheet_pane import SheetPane
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import Values

if TYPE_CHECKING:
    from birdcage_tui.feeds.sheet_feed import SheetFeed
    from birdcage_tui.widgets.page import Page

PUTS_BACK = "This puts back what was set last."
TEST = (
    "The azimuth and then the elevation turn up to 60° to and fro, three times, at full speed, and then back. "
    "Where the azimuth has no room, it first turns to a place that has. Keep the whole swing of the dish clear."
)


class SheetHands:
    """Does them on its page."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._agreed: tuple[str, int] | None = None
        """Which motor may be run by keys, and on which dish: a person has agreed to that."""

    @property
    def _feed(self) -> SheetFeed:
        return self._page.host.system.sheets

    def do(self, name: str, sheet: SheetPane) -> bool:
        """Carry out a command of the tab that is seen; return False for an unknown one."""
        match name:
            case "up" | "down":
                sheet.move(1 if name == "down" else -1)
            case "page-up" | "page-down":
                sheet.move(sheet.page_rows if name == "page-down" else -sheet.page_rows)
            case "left" | "right":
                sheet.move_across(1 if name == "right" else -1)
            case "open":
                self._open(sheet)
            case "set":
                self._set(sheet)
            case "undo":
                self._undo()
            case "test":
                self._test()
            case "run" | "run-back":
                self._run(sheet, -1.0 if name == "run-back" else 1.0)
            case _:
                return False
        return True

    def _open(self, sheet: SheetPane) -> None:
        if self._page.releases_first():
            return
        view = self._page.host.view()
        feature = sheet.chosen(view)
        if feature is None:
            return
        if feature.read_hazard and feature.id not in view.state.readings:
            self.ask_to_read(feature)
            return
        if (detail := sheet.detail(view, DETAIL_WIDTH)) is not None:
            self._page.app.push_screen(lines_screen(detail))

    def ask_to_read(self, feature: Feature) -> None:
        """Read what switches something, or takes long, once a person has agreed."""
        question = QuestionScreen(feature.label, feature.read_hazard, "read it")
        self._page.app.push_screen(question, lambda yes: self._feed.read(feature) if yes else None)

    def _set(self, sheet: SheetPane) -> None:
        view = self._page.host.view()
        feature = sheet.chosen(view)
        if feature is None or not feature.is_writable:
            self._page.host.say("This value can't be set." if feature is not None else "Nothing is selected.")
        elif feature.kind is FeatureKind.MOMENTARY:
            self._ask(feature, True)
        elif feature.kind is FeatureKind.SWITCH:
            self._ask(feature, new_value(feature, view))
        else:
            self._page.app.push_screen(value_field(feature, view), lambda values: self._typed(feature, values))

    def _typed(self, feature: Feature, values: Values | None) -> None:
        if values is None:
            return
        value = read_value(feature, values[0])
        if feature.held is not None:
            self._feed.hold_at(feature, abs(float(value)))
        else:
            self._ask(feature, value)

    def _ask(self, feature: Feature, value: Value) -> None:
        epoch = self._feed.epoch

        def answered(yes: bool | None) -> None:
            if yes:
                self._feed.set(feature, value, epoch)

        said = _coax_words(value) if feature.id == DISEQC else ""
        self._page.app.push_screen(set_question(feature, value, self._page.host.view(), said), answered)

    def _run(self, sheet: SheetPane, sign: float) -> None:
        """Run the motor under the cursor while the key is held; the first time a question comes before."""
        view = self._page.host.view()
        feature = sheet.chosen(view)
        if feature is None or feature.held is None:
            self._page.host.say("No motor that runs while held is selected: see the rows under Run while held.")
            return
        if self._agreed == (agreed := (feature.id, self._feed.epoch)):
            value = abs(float(cell_text(feature, view.sheet.answers, view.now).value))
            self._page.host.system.motor_run.press(feature, sign * value)
            return

        def answered(yes: bool | None) -> None:
            if yes:
                self._agreed = agreed
                self._page.host.say("Nothing runs yet. Hold + or -: it runs until you let go.")

        self._page.app.push_screen(QuestionScreen(feature.label, feature.hazard, "allow the keys"), answered)

    def _test(self) -> None:
        from birdcage.diagnostics.motor_test_task import KIND

        def answered(yes: bool | None) -> None:
            if yes:
                self._page.host.ask(BeginTask(KIND, {"axis": ""}, YOU))
                self._page.host.say("Motor test requested. Space stops the dish.")

        self._page.app.push_screen(QuestionScreen("Motor test", TEST, "area is clear: begin"), answered)

    def _undo(self) -> None:
        change = self._feed.now.undo
        if change is None or change.before is None:
            self._page.host.say("Nothing was set here that can be put back.")
            return
        epoch = self._feed.epoch
        question = set_question(change.feature, change.before, self._page.host.view(), PUTS_BACK)
        self._page.app.push_screen(question, lambda yes: self._feed.undo(change, epoch) if yes else None)


def _coax_words(value: Value) -> str:
    """Return what a DiSEqC message means, before it is sent."""
    from birdcage.coax.messages import read_message, typed_message

    return str(read_message(typed_message(str(value))))

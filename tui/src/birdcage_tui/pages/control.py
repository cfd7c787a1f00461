"""F2: move the dish by hand, safely."""

from __future__ import annotations

from birdcage.base.errors import ConfigError
from birdcage.base.presets import Preset
from birdcage.station.requests import Engage, Goto, ReleaseMotors, SetSpeed, Stow
from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.control import ask
from birdcage_tui.control.actions import ActionsPane
from birdcage_tui.control.cable import CablePane
from birdcage_tui.control.control_layout import WITH_ARC, sizes
from birdcage_tui.control.elevation import ElevationPane
from birdcage_tui.control.horizon_hands import HorizonHands
from birdcage_tui.control.horizon_pane import HorizonPane
from birdcage_tui.control.jog import JogPane
from birdcage_tui.control.last import LastLine, LogPane
from birdcage_tui.control.nudge import DigitsPane
from birdcage_tui.control.presets import PresetsBox, PresetsPane
from birdcage_tui.control.readout import ReadoutPane
from birdcage_tui.control.rose import RosePane
from birdcage_tui.control.tabbing import TABS, Tabbed
from birdcage_tui.goto.reach import refusal_of
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.skew import SkewPane, has_skew
from birdcage_tui.widgets.tab_row import TabRow


class ControlPage(Tabbed):
    """Rose and elevation at the left, cable under them, words and keys at the right."""

    DEFAULT_CSS = """
    ControlPage { layout: vertical; }
    ControlPage #control-top, ControlPage #control-side, ControlPage #control-upper { height: 1fr; }
    ControlPage #control-side, ControlPage #control-right, ControlPage PresetsBox { width: 1fr; }
    ControlPage #control-lower { height: 1fr; display: none; }
    ControlPage RosePane, ControlPage ElevationPane, ControlPage #control-right, ControlPage PresetsBox,
    ControlPage LogPane { border: round $line; height: 1fr; border-title-color: $dim; border-title-style: none;
        border-subtitle-color: $dim; }
    ControlPage RosePane:focus, ControlPage PresetsBox:focus-within { border: round $focus;
        border-title-color: $foreground; }
    ControlPage #control-hands { height: auto; }
    ControlPage PresetsPane { height: 1fr; }
    ControlPage PresetsBox Input, ControlPage PresetsBox Input:focus { height: 1; border: none; padding: 0 1;
        background: $panel; }
    ControlPage LastLine { height: 1; }
    ControlPage.-listing #control-upper { display: none; }
    ControlPage.-listing #control-lower, ControlPage.-roomy #control-lower { display: block; }
    ControlPage.-roomy #control-right { border: none; }
    ControlPage.-roomy ReadoutPane, ControlPage.-roomy CablePane, ControlPage.-roomy #control-hands {
        border: round $line; border-title-color: $dim; border-title-style: none; border-subtitle-color: $dim; }
    ControlPage.-roomy #control-hands:focus-within { border: round $focus; border-title-color: $foreground; }
    """
    RATE_HZ = 2.0
    _with_skew = False

    def compose(self) -> ComposeResult:
        """The parts, from the top left."""
        yield TabRow(TABS, "tab-", id="tabs")
        with Horizontal(id="control-top"):
            yield RosePane(id="rose")
            with Vertical(id="control-side"):
                with Horizontal(id="control-upper"):
                    yield ElevationPane(id="elevation")
                    with Vertical(id="control-right") as right:
                        right.border_title = "Command"
                        yield ReadoutPane(id="readout")
                        with Vertical(id="control-hands") as hands:
                            hands.border_title = "Command"
                            yield DigitsPane(id="digits")
                            yield SkewPane(id="turn-skew")
                            yield JogPane(id="jog")
                            yield ActionsPane(id="actions")
                            yield HorizonPane(id="horizon")
                with Horizontal(id="control-lower"):
                    yield LogPane(id="log")
                    with PresetsBox(id="presets-box") as box:
                        box.border_title = "Presets"
        yield CablePane(id="cable")
        yield LastLine(id="last")

    def show(self, view: View) -> None:
        """Give the third axis its rows where the dish has one, then draw."""
        if self.show_body(view):
            return
        if has_skew(view) != self._with_skew:
            self._with_skew = has_skew(view)
            self.on_resize()
        super().show(view)
        self._horizon.look(view)

    def on_mount(self) -> None:
        """Make what the keys of the horizon do."""
        self._horizon = HorizonHands(self)

    def on_resize(self) -> None:
        """Choose the layout."""
        found = sizes(self.size.width, self.size.height - 1, with_skew=self._with_skew)  # the tabs take a row
        self.set_class(found.roomy, "-roomy")
        for name, width in (("#rose", found.rose), ("#elevation", found.elevation)):
            self.query_one(name).styles.width = width
        for name, height in (
            ("#readout", found.readout), ("#digits", found.digits), ("#jog", found.jog), ("#actions", found.actions),
            ("#turn-skew", found.skew), ("#horizon", found.horizon), ("#cable", found.cable),
        ):  # fmt: skip
            self.query_one(name).styles.height = height
        turn = self.query_one(SkewPane)
        turn.display, turn.styles.margin = found.skew > 0, (0, 0, int(found.skew >= WITH_ARC), 0)
        self.query_one(CablePane).framed = found.roomy
        self.query_one("#control-upper").styles.height = found.upper or "1fr"
        log = self.query_one("#log", LogPane)
        log.display, log.styles.width = found.log > 0 and self.tab == "manual", found.log
        self._face()

    def on_descendant_focus(self, _: events.DescendantFocus) -> None:
        """Where there is no room for both, show what has the focus: the list, or the hands."""
        self._face()

    def on_descendant_blur(self, _: events.DescendantBlur) -> None:
        """Show the hands again when the list has lost the focus to nothing here."""
        self.call_after_refresh(self._face)

    def _face(self) -> None:
        box, focused = self.query_one(PresetsBox), self.screen.focused
        listing = focused is not None and box in focused.ancestors and not self.has_class("-roomy")
        self.set_class(listing, "-listing")
        right, words = self.query_one("#control-right"), "" if self.has_class("-roomy") else "p presets"
        if (right.border_subtitle or "") != words:  # setting it repaints, equal or not
            right.border_subtitle = words

    def do(self, command: str) -> bool:
        """Do what is the page's own, on the tab that it belongs to; hand on what a widget of it does."""
        tab = tab_for(command, self.tab)
        if tab != self.tab:
            self.show_tab(tab)
        if command.startswith("tab-"):
            return True
        if tab == "craft":
            return self.do_on_craft(command)
        if tab == "network":
            return self.do_on_network(command)
        if command.startswith("digit-"):
            return self.query_one(DigitsPane).do(command)
        if command.startswith("preset"):
            return self._preset(command)
        if command.startswith("horizon-"):
            return self._horizon.do(command)
        match command:
            case "digits":
                self.set_class(False, "-listing")
                self.query_one(DigitsPane).focus()
            case "engage":
                self._question(*ask.engage(), Engage(YOU))
            case "release-motors":
                self._question(*ask.release(), ReleaseMotors(YOU))
            case "stow":
                self._question(*ask.stow(self.host.view()), Stow(YOU))
            case "speeds":
                self._ask_speeds()
            case _:
                return False
        return True

    def _question(self, title: str, words: str, yes: str, request: Engage | ReleaseMotors | Stow) -> None:
        def answered(agreed: bool | None) -> None:
            if agreed:
                self.host.ask(request)

        self.app.push_screen(QuestionScreen(title, words, yes), answered)

    def _ask_speeds(self) -> None:
        view = self.host.view()

        def answered(values: tuple[str, ...] | None) -> None:
            for axis, speed in ask.speeds_of(values, view):
                self.host.ask(SetSpeed(axis, speed, YOU))

        self.app.push_screen(ask.speeds(view), answered)

    # Presets.

    def _preset(self, command: str) -> bool:
        pane, book = self.query_one(PresetsPane), self.host.presets
        match command:
            case "presets":
                self._list()
            case "preset-up" | "preset-down":
                pane.move(1 if command == "preset-down" else -1)
            case "preset-filter":
                self._list()
                self.query_one(PresetsBox).open_filter()
            case "preset-undo":
                self._tell(book.undo)
            case "preset-add":
                self._add()
            case "preset-go" | "preset-edit" | "preset-delete":
                self._with_chosen(command, pane.chosen())
            case _:
                return False
        return True

    def _list(self) -> None:
        if not self.has_class("-roomy"):
            self.set_class(True, "-listing")
        self.query_one(PresetsPane).focus()

    def _with_chosen(self, command: str, preset: Preset | None) -> None:
        if command == "preset-go" and can_release(self.host.view()) is None:
            self.host.action_command("release")
        elif preset is None:
            self._with_sky(command)
        elif command == "preset-go":
            goto = Goto(preset.az_deg, preset.el_deg, YOU)
            reason = refusal_of(goto, self.host.view().state)
            if reason is not None:
                self.host.say(f"Refused: {reason}")
                return
            self.host.say(f'To "{preset.name}", {preset.az_deg:.2f}°/{preset.el_deg:.2f}°.')
            self.host.ask(goto)
        elif command == "preset-delete":
            self._tell(lambda: self.host.presets.delete(preset.name))
        else:
            self._edit(preset)

    def _with_sky(self, command: str) -> None:
        sky = self.query_one(PresetsPane).chosen_sky()
        if sky is None:
            self.host.say("No preset selected. a: save the current direction.")
        elif command == "preset-go":
            self.host.open_goto(sky.typed)  # it says where that stands by then, and what forbids it
        else:
            self.host.say(f"{sky.name} is no preset. a: save the current direction.")

    def _tell(self, change: ask.Change) -> None:
        """Change the presets, and say what was done or why not."""
        try:
            words = change()
        except ConfigError as refused:
            words = str(refused)
        self.host.say(words)

    def _add(self) -> None:
        book, position = self.host.presets, self.host.view().state.position
        if book.problem:
            self.host.say(book.problem)
            return
        fields = ask.preset_fields(None if position is None else Preset("", position.az_deg, position.el_deg))

        def answered(values: tuple[str, ...] | None) -> None:
            if values is not None:
                self._tell(lambda: book.add(ask.preset_of(values)))

        self.app.push_screen(ask.preset("Save as preset", fields, book, None), answered)

    def _edit(self, old: Preset) -> None:
        book = self.host.presets
        if book.problem:
            self.host.say(book.problem)
            return

        def answered(values: tuple[str, ...] | None) -> None:
            if values is not None:
                self._tell(lambda: book.replace(old.name, ask.preset_of(values)))

        self.app.push_screen(ask.preset("Edit preset", ask.preset_fields(old), book, old.name), answered)


def tab_for(command: str, now: str) -> str:
    """Return on which tab a command of the page is done; the presets have two of them."""
    if command.startswith("tab-"):
        return command.removeprefix("tab-")
    if command in ("open-craft", "open-offer") or command.startswith(("track-", "offer-")):
        return "craft"
    if command.startswith("network-"):
        return "network"
    if command.startswith("preset"):
        return now if now in ("manual", "presets") else "presets"
    return "manual"

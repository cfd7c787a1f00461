"""F3: how strong the signal is, and which way it gets stronger."""

from __future__ import annotations

from birdcage.signal.drift_task import DriftTask
from birdcage.signal.on_off_task import OnOffTask
from birdcage.signal.peak_task import PeakTask
from birdcage.signal.source_path import SourcePath
from birdcage.signal.step_track_task import StepTrackTask
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.control.jog import JogPane
from birdcage_tui.feeds.signal_feed import STEADY
from birdcage_tui.shown.level_words import followed_name, way_to
from birdcage_tui.shown.strip_words import set_words
from birdcage_tui.shown.view import View
from birdcage_tui.signal.ask_levels import levels_question, read_levels
from birdcage_tui.signal.ask_receiver import supply_13_volts, supply_question, transponder_question, tune
from birdcage_tui.signal.ask_sweep import begin_sweep, sweep_question
from birdcage_tui.signal.ask_tuning import read_tuning, tuning_question
from birdcage_tui.signal.choose import source_question
from birdcage_tui.signal.find import (
    ACQUIRE,
    begin_drift,
    begin_find,
    begin_on_off,
    begin_step_track,
    drift_path,
    drift_words,
    find_question,
    on_off_question,
    step_track_question,
)
from birdcage_tui.signal.head import SignalHead
from birdcage_tui.signal.level import LevelPane
from birdcage_tui.signal.map_hands import MapHands
from birdcage_tui.signal.map_pane import MapPane
from birdcage_tui.signal.polarisations import FEATURES as POLARISED
from birdcage_tui.signal.polarisations import PolarisationPane, polarisations_question
from birdcage_tui.signal.receiver import FEATURES, SUPPLY, ReceiverPane
from birdcage_tui.signal.strip import StripPane
from birdcage_tui.signal.sweep import SweepPane
from birdcage_tui.signal.to_peak import ToPeakPane
from birdcage_tui.signal.waterfall import WaterfallPane
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import Values
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.page_tone import PageTone
from birdcage_tui.widgets.pane import Pane

UPPER, UPPER_TALL = 9, 13
"""Rows of level and way to the peak, and where there is room for larger digits."""
TALL = 30
VIEWS: tuple[type[Pane], ...] = (StripPane, SweepPane, WaterfallPane, MapPane, PolarisationPane)
"""What stands below, one at a time."""


class SignalPage(Page):
    """Level and way to the peak above, the last minute below, the receiver's own words at the bottom."""

    DEFAULT_CSS = """
    SignalPage { layout: vertical; }
    SignalPage SignalHead { height: 1; }
    SignalPage #signal-upper { height: 9; }
    SignalPage LevelPane, SignalPage #signal-peak, SignalPage StripPane, SignalPage SweepPane,
    SignalPage MapPane, SignalPage WaterfallPane, SignalPage PolarisationPane, SignalPage ReceiverPane {
        border: round $line; border-title-color: $dim; border-title-style: none; border-subtitle-color: $dim;
        width: 1fr; }
    SignalPage #signal-peak Pane { width: 1fr; }
    SignalPage ToPeakPane { height: 1fr; }
    SignalPage JogPane { height: 1; }
    SignalPage StripPane, SignalPage SweepPane, SignalPage MapPane, SignalPage WaterfallPane,
    SignalPage PolarisationPane { height: 1fr; }
    SignalPage SweepPane, SignalPage MapPane, SignalPage WaterfallPane, SignalPage PolarisationPane { display: none; }
    SignalPage MapPane:focus { border: round $focus; }
    SignalPage ReceiverPane { height: 4; }
    """
    WATCHES = frozenset({"position", STEADY, *FEATURES})
    RATE_HZ = 1.0
    HELP = (
        "The signal, read as often as the wire allows. Arrows step the dish. f finds the peak, p goes there. "
        "s chooses the source. m maps the sky."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._tone = PageTone(self)
        self._maps = MapHands(self, self._show_map, self._switch_whole)

    def compose(self) -> ComposeResult:
        """From the top."""
        yield SignalHead()
        with Horizontal(id="signal-upper"):
            yield LevelPane(id="level")
            with Vertical(id="signal-peak") as column:
                column.border_title = "To the peak"
                yield ToPeakPane(id="to-peak")
                yield JogPane(id="signal-jog")
        yield StripPane(id="signal-strip")
        yield SweepPane(id="signal-sweep")
        yield MapPane(id="signal-map")
        yield WaterfallPane(id="signal-waterfall")
        yield PolarisationPane(id="signal-polarisations")
        yield ReceiverPane(id="receiver")

    _view: type[Pane] = StripPane
    _whole = True

    def show(self, view: View) -> None:
        """Draw, and take up the tone again where the page was left with one."""
        self._tone.resume()
        if self._maps.has_begun():
            self._show_map()
            self.call_after_refresh(self._enter_map)  # the page itself may not be seen yet
        column, title = self.query_one("#signal-peak"), "While following" if followed_name(view) else "To the peak"
        if column.border_title != title:
            column.border_title = title
        level = self.query_one(LevelPane)
        if level.border_subtitle != self._tone.words:  # setting it repaints the pane, equal or not
            level.border_subtitle = self._tone.words
        super().show(view)

    def on_resize(self) -> None:
        """Give the digits more room where there is some."""
        tall = self.size.height >= TALL
        self.query_one("#signal-upper").styles.height = UPPER_TALL if tall else UPPER
        self._give_room()
        self.query_one(ReceiverPane).styles.height = 5 if tall else 4

    def _find(self, what: str | None) -> None:
        """Begin what was chosen, or ask what else it needs."""
        match what:
            case PeakTask.kind:
                self.host.signals.book.forget_peak()
                begin_find(self.host.view(), self.host.ask)
                self.host.say("Finding the peak. Space stops the dish.")
            case StepTrackTask.kind:
                self.app.push_screen(step_track_question(), self._step_track)
            case OnOffTask.kind:
                self.app.push_screen(on_off_question(self.host.view()), self._on_off)
            case DriftTask.kind:
                path = self._drift_path()
                if path is not None:
                    question = QuestionScreen("Drift scan", drift_words(path), "area is clear: begin")
                    self.app.push_screen(question, self._drift)
            case str(acquire) if acquire == ACQUIRE:
                self.host.show_page("setup", then="setup-first")

    def _step_track(self, values: Values | None) -> None:
        if values is not None:
            begin_step_track(self.host.view(), values, self.host.ask)
            self.host.say("Step-track: first the peak. Space stops the dish.")

    def _on_off(self, values: Values | None) -> None:
        if values is not None:
            begin_on_off(self.host.view(), values, self.host.ask)
            self.host.say("On-off: on the source and beside it. Space stops the dish.")

    def _drift(self, agreed: bool | None) -> None:
        path = self._drift_path() if agreed else None
        if path is not None:
            self._show_view(SweepPane)
            begin_drift(self.host.view(), path, self.host.ask)
            self.host.say("Drift scan. Space stops the dish.")

    def _drift_path(self) -> SourcePath | None:
        """Return the Sun's way through the beam; say why where it has none."""
        try:
            return drift_path(self.host.view())
        except ValueError as wrong:
            self.host.say(str(wrong))
            return None

    def _sweep(self, values: Values | None) -> None:
        if values is not None:
            self._show_view(SweepPane)
            begin_sweep(self.host.view(), values, self.host.ask)
            self.host.say("Sweeping. Space stops the dish.")

    @property
    def _next_view(self) -> type[Pane]:
        """What stands below after this one: a waterfall where the source tells spectra, a map where one is open."""
        view = self.host.view()
        here = {StripPane: True, SweepPane: True, WaterfallPane: bool(view.spectra), MapPane: view.has_map}
        after = VIEWS.index(self._view) + 1
        return next(kind for kind in (*VIEWS[after:], *VIEWS) if here.get(kind))  # the rest only where it is agreed to

    def _show_map(self) -> None:
        """Show the map of the sky."""
        self._show_view(MapPane)

    def _enter_map(self) -> None:
        """Give the focus to a map that has taken the page, where nothing else has it: a step by hand would end it."""
        if self.shows_map and self.screen.focused is None and self.scope in self.host.view().scopes:
            self.screen.set_focus(self.query_one(MapPane))

    def _switch_whole(self) -> None:
        """Give the page to the map alone, or take that back where it has it."""
        self._whole = not self.shows_whole_map
        self._show_map()

    @property
    def shows_map(self) -> bool:
        """Whether it is the map that stands below."""
        return self._view is MapPane

    @property
    def shows_whole_map(self) -> bool:
        """Whether the map has the page alone."""
        return self.shows_map and self._whole

    def _show_view(self, kind: type[Pane]) -> None:
        """Show it in place of the others."""
        self._view = kind
        self.agreed = kind is PolarisationPane
        for each in VIEWS:
            self.query_one(each).display = each is kind
        self._give_room()
        self.host.watch_page()
        self.host.paint()

    def _give_room(self) -> None:
        """Give up the receiver's own words for a picture on a small screen, and while they are not read."""
        tall = self.size.height >= TALL and self._view is not PolarisationPane
        whole = self.shows_whole_map
        self.query_one("#signal-upper").display = not whole
        self.query_one(ReceiverPane).display = not whole and (tall or self._view is StripPane)

    def _switch_record(self) -> None:
        signals = self.host.signals
        if signals.recorder is not None:
            self.host.say(signals.end_record())
            return
        if signals.record():
            self.host.say("Recording every reading. r ends it; R replays what was kept.")
        else:
            self.host.say("There is no folder for recordings.")

    def _tune(self, values: Values | None) -> None:
        if values is not None:
            tune(self.host, values)

    def _supply(self, agreed: bool | None) -> None:
        if agreed:
            supply_13_volts(self.host)

    @property
    def watches(self) -> frozenset[str]:
        """What the page reads anyway; in place of the receiver's own words both polarisations, while they are shown.

        What is not steady takes its turn, one every few seconds: with all of them either would come too seldom.
        """
        return frozenset({"position", STEADY, SUPPLY, *POLARISED}) if self.agreed else self.WATCHES

    def _hear_both(self, agreed: bool | None) -> None:
        if agreed:
            self._show_view(PolarisationPane)
            self.host.say("Both polarisations are read while F3 shows them. v shows another view.")

    def _keep_levels(self, values: Values | None) -> None:
        if values is not None:
            self.host.say(self.host.signals.keep_levels(read_levels(values, self.host.view())))

    def _retune(self, values: Values | None) -> None:
        if values is not None:
            self.host.say(self.host.signals.tune(read_tuning(values)))

    def _mark(self) -> None:
        if self.releases_first():
            return
        view, book = self.host.view(), self.host.signals.book
        if self.shows_map:
            self._maps.do("map-enter")
            return
        marker = book.mark(view.now, view.utc, view.state)
        if marker is None:
            self.host.say("The last reading is too old to be marked.")
        else:
            self.host.say(set_words(marker, book.heard))

    def _replay(self) -> None:
        from birdcage_tui.signal.replay import ReplayDesk

        path = self.host.signals.recordings_file
        if path is None:
            self.host.say("There is no folder for recordings.")
        else:
            ReplayDesk(self, path).open()

    def _hear_by(self, source: str | None) -> None:
        if source is None:
            return
        self.host.signals.choose(source)
        facts = self.host.signals.book.chosen
        feed = self.host.view().state.feed_name
        self.host.say(f'Source: {facts.label}. signal = "{facts.id}" in [feed.{feed}] keeps it.')

    def do(self, command: str) -> bool:
        """Offer the way to the peak, or forget it."""
        level = self.host.view().level
        if command.startswith("map-"):
            return self._maps.do(command)
        match command:
            case "signal-peak":
                to = None if level is None else way_to(level)
                if to is None:
                    self.host.say("No peak with a direction was heard yet.")
                else:
                    self.host.open_goto(f"{to[0]:.2f} {to[1]:.2f}")
            case "signal-find":
                self.app.push_screen(find_question(self.host.view()), self._find)
            case "signal-sweep":
                self.app.push_screen(sweep_question(self.host.view()), self._sweep)
            case "signal-view":
                self._show_view(self._next_view)
            case "signal-source":
                self.app.push_screen(source_question(self.host.signals.choices), self._hear_by)
            case "signal-record":
                self._switch_record()
            case "signal-transponder":
                self.app.push_screen(transponder_question(self.host.view()), self._tune)
            case "signal-polarisations":
                self.app.push_screen(polarisations_question(self.host.view()), self._hear_both)
            case "signal-13v":
                self.app.push_screen(supply_question(self.host.view()), self._supply)
            case "signal-mark":
                self._mark()
            case "signal-unmark":
                count = self.host.signals.book.clear_markers()
                self.host.say("Markers cleared." if count else "There are no markers. Enter sets one.")
            case "signal-tune":
                tuned, label = self.host.signals.tuned, self.host.signals.book.chosen.label
                if tuned is None:
                    self.host.say(f"The {label} is not tuned from here. s chooses an RTL-SDR behind rtl_tcp.")
                else:
                    self.app.push_screen(tuning_question(tuned, label), self._retune)
            case "signal-levels":
                self.app.push_screen(levels_question(self.host.view()), self._keep_levels)
            case "signal-replay":
                self._replay()
            case "signal-forget":
                self.host.signals.book.forget_peak()
                self.host.say("Peak and floor forgotten.")
            case "signal-tone":
                self._tone.switch()
            case _:
                return False
        return True

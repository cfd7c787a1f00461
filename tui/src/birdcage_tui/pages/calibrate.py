"""F8, second tab: how the dish really stands, from peaks on what is where it is known to be."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
from textual import events
from textual.app import ComposeResult
from textual.containers import Container

from birdcage_tui.calibrate import ask
from birdcage_tui.calibrate.aim import AimPane
from birdcage_tui.calibrate.calibrate_layout import regions
from birdcage_tui.calibrate.figures import FiguresPane, rows_needed, said_below
from birdcage_tui.calibrate.lists import ListPane, ObjectsPane, PeaksPane, SetsPane, present_row
from birdcage_tui.calibrate.over_sky import OverSkyPane
from birdcage_tui.calibrate.scatter import ScatterPane
from birdcage_tui.calibrate.tabs import SetupTabs
from birdcage_tui.feeds.calibrate_feed import CalibrateSource
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import Values
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.calibration.candidates import CalibrationObject

NUDGES = {"left": (-1.0, 0.0), "right": (1.0, 0.0), "up": (0.0, 1.0), "down": (0.0, -1.0)}
PARTS: dict[str, type[Pane]] = {
    "scatter": ScatterPane, "sky": OverSkyPane, "fit": FiguresPane, "aim": AimPane, "signal": SignalPane,
    "objects": ObjectsPane, "peaks": PeaksPane, "sets": SetsPane,
}  # fmt: skip
LISTS: dict[str, type[ListPane]] = {"objects": ObjectsPane, "peaks": PeaksPane, "sets": SetsPane}


class CalibratePage(Page):
    """Pictures and figures at the left; at the right what is pointed at, objects, peaks and sets."""

    HELP = (
        "Peaks on known objects give the alignment of the dish. n selects the next best object, Enter goes there. "
        "f finds its peak by the signal and saves it. Without a tuner, nudge with the arrows until your own meter is "
        "highest, then press Enter. Three objects give the tilt. a uses the fit. All limits apply."
    )
    DEFAULT_CSS = """
    CalibratePage { layout: vertical; }
    CalibratePage SetupTabs { height: 1; }
    CalibratePage #calibrate-body { height: 1fr; }
    CalibratePage #calibrate-body > Pane { position: absolute; }
    CalibratePage ScatterPane, CalibratePage OverSkyPane, CalibratePage FiguresPane, CalibratePage AimPane,
    CalibratePage SignalPane, CalibratePage ListPane { border: round $line; border-title-color: $dim;
        border-title-style: none; border-subtitle-color: $dim; }
    CalibratePage AimPane:focus, CalibratePage ListPane:focus { border: round $focus;
        border-title-color: $foreground; }
    """
    WATCHES = frozenset({"position", "signal"})
    RATE_HZ = 2.0
    FIRST_FOCUS = "#calibrate-aim"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._over_sky = False
        """Which picture is seen where there is room for one."""
        self._fit_words: tuple[str, ...] | None = None
        """What the figures say below themselves; None without figures: then the other words have their room."""
        self._listed = "objects"
        """The same of the lists."""

    def compose(self) -> ComposeResult:
        """The parts, from the top left."""
        yield SetupTabs("calibrate")
        with Container(id="calibrate-body"):
            yield ScatterPane(id="calibrate-scatter")
            yield OverSkyPane(id="calibrate-sky")
            yield FiguresPane(id="calibrate-fit")
            yield AimPane(id="calibrate-aim")
            yield SignalPane(id="calibrate-signal")
            yield ObjectsPane(id="calibrate-objects")
            yield PeaksPane(id="calibrate-peaks")
            yield SetsPane(id="calibrate-sets")

    @property
    def source(self) -> CalibrateSource | None:
        """The guide; None where there is none."""
        return self.host.calibrate.source

    def on_mount(self) -> None:
        """Open the guide: this is the first visit."""
        self.host.calibrate.open()

    def show(self, view: View) -> None:
        """Keep the guide fresh, and draw what it says."""
        if self.source is not None:
            self.source.look()
        chosen = self._candidate(view)
        self.query_one(OverSkyPane).chosen = "" if chosen is None else chosen.name
        now = view.calibrate
        words = said_below(now)
        if words != self._fit_words:
            self._fit_words = words
            self.on_resize()
        super().show(view)

    def on_resize(self) -> None:
        """Give every part its place."""
        width, height = self.size.width, self.size.height - 1  # the tabs take a row
        picture = "sky" if self._over_sky else "scatter"
        found = regions(
            width,
            height,
            fit_rows=lambda room: rows_needed(self._fit_words, room),
            picture=picture,
            listed=self._listed,
        )
        for name, kind in PARTS.items():
            pane, place = self.query_one(kind), found.get(name)
            pane.display = place is not None
            if place is not None:
                pane.styles.offset = place.offset
                pane.styles.width, pane.styles.height = place.width, place.height

    def place_changed(self) -> None:
        """Look again what is up: it was another sky."""
        if self.source is not None:
            self.source.refresh()

    def on_descendant_focus(self, event: events.DescendantFocus) -> None:
        """Where there is room for one list only, keep showing the one that had the focus last."""
        name = (event.widget.id or "").removeprefix("calibrate-")
        if name in LISTS and name != self._listed:
            self._listed = name
            self.on_resize()

    def do(self, command: str) -> bool:
        """Carry out a command of the tab."""
        name = command.removeprefix("calibrate-")
        source = self.source
        if command == "tab-calibrate":
            return True
        if name in LISTS:
            self._focus(name)
            return True
        if name.startswith(("object-", "peak-", "set-")) and name.endswith(("-up", "-down")):
            return self.query_one(LISTS[f"{name.partition('-')[0]}s"]).do(command)
        if name == "view":
            self._over_sky = not self._over_sky
            self.on_resize()
            self.call_after_refresh(self.host.paint)
            return True
        if source is None:
            self.host.say("This app has no calibration.")
            return True
        if name in ("take", "object-go", "set-use") and can_release(self.host.view()) is None:
            self.host.action_command("release")
            return True
        now = self.host.view().calibrate
        guide = None if now is None else now.guide
        match name:
            case "left" | "right" | "up" | "down":
                right, up = NUDGES[name]
                step_deg = self.host.view().step_deg
                source.nudge(right * step_deg, up * step_deg, self.host.begin_way())
            case "take":
                source.take()
            case "find":
                self._ask_find(source)
            case "next":
                self._select(0)
            case "again":
                self._select(present_row(guide) if guide is not None else None)
            case "object-go":
                self._go(source)
            case "peak-forget":
                self._forget(source)
            case "undo":
                source.undo()
            case "refresh":
                source.refresh()
            case "begin":
                self._ask_begin(source)
            case "apply":
                self._ask_name(source)
            case "set-use":
                self._use(source)
            case _:
                return False
        return True

    def _focus(self, name: str) -> None:
        if name != self._listed:
            self._listed = name
            self.on_resize()
        self.call_after_refresh(lambda: self.screen.set_focus(self.query_one(LISTS[name])))

    def _candidate(self, view: View) -> CalibrationObject | None:
        """Return the object under the cursor; None on the present one, and where there is none."""
        now = view.calibrate
        guide = None if now is None else now.guide
        if guide is None:
            return None
        found, here = guide.proposals, present_row(guide)
        at = min(self.query_one(ObjectsPane).at, max(len(found) - 1, here or 0))
        return found[at].candidate if at < len(found) else None

    def _select(self, row: int | None) -> None:
        """Put the cursor on an object, where Enter goes there: no letter turns the dish that far."""
        self.query_one(ObjectsPane).at = row or 0
        self._focus("objects")

    def _go(self, source: CalibrateSource) -> None:
        view, objects = self.host.view(), self.query_one(ObjectsPane)
        candidate = self._candidate(view)
        now = view.calibrate
        if candidate is None and (now is None or now.guide is None or not now.guide.target):
            self.host.say(
                "This dish can hear nothing that is in reach now." if now is None or not now.wrong else now.wrong
            )
            return
        objects.at = 0  # when this one is peaked, the best of the others comes first
        source.go(candidate, self.host.begin_way())
        self.screen.set_focus(self.query_one(AimPane))

    def _forget(self, source: CalibrateSource) -> None:
        now = self.host.view().calibrate
        peaks = () if now is None or now.guide is None else now.guide.peaks
        if peaks:
            source.remove(peaks[min(self.query_one(PeaksPane).at, len(peaks) - 1)].number)

    def _use(self, source: CalibrateSource) -> None:
        now = self.host.view().calibrate
        if now is not None and now.sets:
            source.use(now.sets[min(self.query_one(SetsPane).at, len(now.sets) - 1)].entry.name)

    def _ask_begin(self, source: CalibrateSource) -> None:
        def answered(yes: bool | None) -> None:
            if yes:
                source.remove()

        self.app.push_screen(QuestionScreen(*ask.begin()), answered)

    def _ask_find(self, source: CalibrateSource) -> None:
        view = self.host.view()
        guide = None if view.calibrate is None else view.calibrate.guide

        def answered(yes: bool | None) -> None:
            if yes:
                source.find(view.heard.id, self.host.begin_way())

        if guide is not None:
            width_deg = ASSUMED_WIDTH_DEG if view.state.beam is None else view.state.beam.mean_deg
            self.app.push_screen(QuestionScreen(*ask.find(guide.target, width_deg)), answered)

    def _ask_name(self, source: CalibrateSource) -> None:
        def answered(values: Values | None) -> None:
            if values is not None:
                source.apply(values[0])

        self.app.push_screen(ask.name(self.host.view().calibrate), answered)

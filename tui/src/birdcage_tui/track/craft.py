"""The Craft tab: find a target, see its pass, and follow it."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

from birdcage.station.requests import EndPursuit
from textual import events, on
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.widgets import Input

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.feeds.track_feed import TrackSource
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.offer import Offer
from birdcage_tui.shown.pursuit import plan_of
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.track.found import FoundList
from birdcage_tui.track.head import TrackHead
from birdcage_tui.track.now import TrackNow
from birdcage_tui.track.offer import OfferLine
from birdcage_tui.track.passes import TrackPasses
from birdcage_tui.track.plot import TrackSky
from birdcage_tui.track.radio import RadioPane
from birdcage_tui.track.schedule import SchedulePane
from birdcage_tui.track.strips import TrackStrips
from birdcage_tui.track.track_layout import VIEWS, layout
from birdcage_tui.widgets.esc_field import EscField, NamedField
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen
from birdcage_tui.widgets.pane import Pane

OFFSETS_S = {"track-earlier": -0.1, "track-later": 0.1, "track-far-earlier": -1.0, "track-far-later": 1.0}
ORDERS: dict[str, Callable[[TrackSource], None]] = {
    "track-watch": lambda source: source.watch(),
    "track-leave": lambda source: source.leave(),
    "track-forget": lambda source: source.forget_unfinished(),
}
ENDS_OFFER = frozenset({"track-search", "track-watch", "track-aim", "track-follow", "track-leave", "track-up",
                        "track-down", "track-autotrack"})  # fmt: skip
"""After these Enter no longer does what was offered before."""
LOWEST_HZ, HIGHEST_HZ = 1e6, 100e9


def frequency_of(text: str) -> float | None:
    """Return what was typed, in MHz, as hertz; None for nothing. ValueError says what to type instead."""
    words = text.strip().lower().removesuffix("mhz").strip().replace(",", ".")
    if not words:
        return None
    try:
        hertz = float(words) * 1e6
    except ValueError:
        hertz = 0.0
    if not LOWEST_HZ <= hertz <= HIGHEST_HZ:
        raise ValueError("Type MHz, from 1 to 100000: 137.9")
    return hertz


class CraftTab(Vertical):
    """Head, map, curves; passes, autotrack and radio beside or behind them; targets in place of the curves."""

    DEFAULT_CSS = """
    CraftTab { height: 1fr; }
    CraftTab OfferLine { height: 1; }
    CraftTab Input, CraftTab Input:focus { height: 1; border: none; padding: 0 1; background: $panel; }
    CraftTab #craft-upper { height: 1fr; }
    CraftTab #craft-right, CraftTab TrackStrips, CraftTab FoundList, CraftTab TrackPasses, CraftTab SchedulePane,
    CraftTab RadioPane { width: 1fr; height: 1fr; }
    CraftTab TrackSky, CraftTab #craft-right { border: round $line; border-title-color: $dim;
        border-title-style: none; height: 1fr; }
    CraftTab.-roomy #craft-right { border: none; }
    CraftTab.-roomy TrackNow, CraftTab.-roomy TrackStrips, CraftTab.-roomy FoundList, CraftTab TrackPasses,
    CraftTab SchedulePane, CraftTab RadioPane { border: round $line; border-title-color: $dim;
        border-title-style: none; }
    """
    HELP = (
        "Track a target. / searches, Enter selects. f then Enter follows it, a then Enter aims at it once, w watches "
        "it, x stops following. [ and ] shift its time when it comes early or late."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._shown = VIEWS[0]
        self._searching = False
        self._enter_waits = False
        """Whether Enter was pressed before what was typed had been searched for."""
        self._arranged: object = None

    def compose(self) -> ComposeResult:
        """The parts, from the top left."""
        offer = OfferLine(self._offered_done, id="craft-offer")
        offer.display = False
        yield offer
        yield TrackHead(id="craft-head")
        field = NamedField(
            "search", "name, number, 19.2E, moon, 180 45; Enter selects", "name, number, 180 45",
            enter="Enter selects", closes="closes", field_id="craft-search",
        )  # fmt: skip
        field.display = False
        yield field
        with Horizontal(id="craft-upper"):
            yield TrackSky(id="craft-sky")
            with Vertical(id="craft-right") as right:
                right.border_title = "Now"
                yield TrackNow(id="craft-now")
                yield TrackStrips(id="craft-strips")
                yield FoundList(id="craft-found")
        with Horizontal(id="craft-lower"):
            yield TrackPasses(id="craft-passes")
            yield SchedulePane(id="craft-schedule")
            yield RadioPane(id="craft-radio")

    @property
    def host(self) -> AppHost:
        """The app."""
        return cast(AppHost, self.app)

    def listing(self, view: View) -> bool:
        """Return whether targets stand in place of the curves: while one searches, and before one is chosen."""
        if self._searching:
            return True
        return plan_of(view) is None and (view.track is None or view.track.choice is None)

    def lay_out(self, view: View) -> None:
        """Give every part its room; nothing is done where nothing has changed."""
        taken = bool(self._searching) + self.query_one(OfferLine).display
        found = layout(self.size.width, self.size.height - taken, self._shown)
        listing = self.listing(view)
        shown = VIEWS[0] if listing and not found.roomy else self._shown
        key = (found, listing, shown, bool(TrackNow.lines(view, 80)))
        if key == self._arranged or not self.size:
            return
        self._arranged = key
        self.set_class(found.roomy, "-roomy")
        self.query_one(TrackHead).styles.height = found.head
        self.query_one(TrackSky).styles.width = found.sky
        lower, upper = self.query_one("#craft-lower"), self.query_one("#craft-upper")
        now, strips, listed = self.query_one(TrackNow), self.query_one(TrackStrips), self.query_one(FoundList)
        now.styles.height = found.now
        now.display = key[-1] and not (listing and self._searching)
        title = "Targets" if listing and not now.display else "Now"
        if self.query_one("#craft-right").border_title != title:
            self.query_one("#craft-right").border_title = title
        strips.display, listed.display = not listing and (found.roomy or shown == VIEWS[0]), listing
        beside = "radio" if found.roomy and not found.radio and shown == "radio" else "autotrack"
        for kind, name in ((TrackPasses, "passes"), (SchedulePane, "autotrack"), (RadioPane, "radio")):
            pane = self.query_one(kind)
            pane.display = name in ("passes", beside) or found.radio > 0 if found.roomy else shown == name
            pane.styles.width = found.radio if found.radio and name == "radio" else "1fr"
        lower.display = found.roomy or shown != VIEWS[0]
        lower.styles.height = found.lower if found.roomy else "1fr"
        upper.display = found.roomy or shown == VIEWS[0]
        for pane in self.query(Pane):
            pane.redraw()

    def on_resize(self) -> None:
        """Choose the layout."""
        self.lay_out(self.host.view())

    def show(self, view: View) -> None:
        """Choose the layout, and draw."""
        offer = self.query_one(OfferLine)
        if offer.display and self.screen.focused is not offer:
            offer.display = False  # something else was taken up: Enter is no longer its own
        self.lay_out(view)
        for pane in self.query(Pane):
            pane.show(view)
        source = self.host.track.source
        if self._enter_waits and source is not None and self._is_found(view):
            self._take(view, source)

    def _is_found(self, view: View) -> bool:
        """Return whether the list is that of what is typed."""
        return view.track is None or view.track.query == self.query_one(Input).value

    # What the keys do.

    def do(self, command: str) -> bool:
        """Do one of the tab's commands."""
        view, source = self.host.view(), self.host.track.source
        if command in ENDS_OFFER and self.query_one(OfferLine).display:
            self.screen.set_focus(None)
        match command:
            case "open-craft" | "tab-craft":
                return True
            case "open-offer":
                self._open_offer(source)
            case "offer-follow" | "offer-aim" | "offer-autotrack":
                self.host.say("Nothing is offered now. f offers to follow the target.")
            case "track-search":
                self._open_search()
            case "track-leave" if source is None:
                self.host.ask(EndPursuit(YOU))
            case "track-up" | "track-down":
                self._move(view, 1 if command == "track-down" else -1)
            case "track-view":
                self._shown = VIEWS[(VIEWS.index(self._shown) + 1) % len(VIEWS)]
            case "track-frequency":
                self._ask_frequency(view)
            case _ if source is None:
                return False
            case "track-take":
                self._take(view, source)
            case "track-aim" | "track-follow":
                self._offer(command)
            case "track-autotrack" if view.track is None or not view.track.autotrack:
                self._offer(command)
            case _:
                return self.do_with(command, view, source)
        self.host.paint()
        return True

    def _offered_done(self) -> None:
        self.screen.set_focus(None)
        self.host.paint()

    def do_with(self, command: str, view: View, source: TrackSource) -> bool:
        """Do what the desk is asked for, and moves nothing."""
        match command:
            case "track-autotrack":
                source.set_autotrack(False)
            case _ if command in ORDERS:
                ORDERS[command](source)
            case _ if command in OFFSETS_S or command == "track-on-time":
                aim = None if view.track is None else view.track.aim
                by_s = OFFSETS_S.get(command)
                before_s = 0.0 if aim is None else aim.time_offset_s
                source.set_time_offset(0.0 if by_s is None else round(before_s + by_s, 3))
            case _:
                return False
        self.host.paint()
        return True

    def _move(self, view: View, by: int) -> None:
        if self.listing(view):
            self.query_one(FoundList).move(by)
            return
        if not self.has_class("-roomy"):
            self._shown = "passes"
            self.lay_out(view)
        self.query_one(TrackPasses).move(by)

    def _take(self, view: View, source: TrackSource) -> None:
        if can_release(view) is None and not self._searching:
            self.host.action_command("release")
        elif self.listing(view):
            chosen = self.query_one(FoundList).chosen(view)
            self._enter_waits = self._searching and not self._is_found(view)
            if self._enter_waits:
                self.host.say("Searching. Enter counts once it is found.")
                return
            if chosen is None:
                note = "" if view.track is None else view.track.found_note
                self.host.say(note or "No match.")
                return
            self._close_search()
            source.choose(chosen.text)
        else:
            row = self.query_one(TrackPasses).chosen(view)
            if row is None:
                self.host.say("No passes.")
                return
            source.choose_pass(row.passing.aos)
            self._shown = VIEWS[0]

    def _open_offer(self, source: TrackSource | None) -> None:
        """Choose the pass that was picked on F7, and offer to follow it."""
        offer = self.host.track.offer
        if offer is None or source is None:
            self.host.say("The pursuit desk is not open yet.")
            return
        self._close_search()
        source.choose(offer.text)
        source.choose_pass(offer.tca)
        self._shown = VIEWS[0]
        self._offer("track-follow", offer)

    def _offer(self, deed: str, offer: Offer | None = None) -> None:
        """Say in a row what would move; Enter there does it, since no letter turns the dish that far."""
        line = self.query_one(OfferLine)
        line.deed, line.offer, line.display = deed, offer, True
        self.screen.set_focus(line)

    def _ask_frequency(self, view: View) -> None:
        aim = None if view.track is None else view.track.aim
        hertz = None if aim is None else aim.frequency_hz
        field = FieldRow("MHz", "" if hertz is None else f"{hertz / 1e6:.6f}".rstrip("0").rstrip("."), "default")
        words = "Sets the receiver, Doppler and pointing loss. Empty: the satellite's own downlink."

        def check(values: tuple[str, ...]) -> str:
            try:
                frequency_of(values[0])
            except ValueError as wrong:
                return str(wrong)
            return ""

        def answered(values: tuple[str, ...] | None) -> None:
            source = self.host.track.source
            if values is not None and source is not None:
                source.set_frequency(frequency_of(values[0]))

        self.app.push_screen(FieldsScreen("Frequency of the downlink", words, [field], check), answered)

    # Searching.

    def _open_search(self) -> None:
        field = self.query_one(Input)
        self._searching, self._shown = True, VIEWS[0]
        field.disabled = False
        self.query_one(NamedField).display = True
        field.value = ""
        self.query_one(FoundList).restart()
        self._search("")
        field.focus()

    def _close_search(self) -> None:
        field = self.query_one(Input)
        self._searching = self._enter_waits = False
        if field.has_focus:
            self.screen.set_focus(None)
        field.disabled = True
        self.query_one(NamedField).display = False
        self.host.paint()

    def _search(self, text: str) -> None:
        source = self.host.track.source
        if source is not None:
            source.search(text)

    def on_input_changed(self, event: Input.Changed) -> None:
        """Look for what was typed so far."""
        event.stop()
        if self._searching:
            self._enter_waits = False
            self.query_one(FoundList).restart()
            self._search(event.value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Take what stands under the cursor."""
        event.stop()
        source = self.host.track.source
        if source is not None:
            self._take(self.host.view(), source)

    @on(EscField.Left)
    def _left_search(self, event: EscField.Left) -> None:
        event.stop()
        self._close_search()

    def on_key(self, event: events.Key) -> None:
        """Esc closes the search; the arrows choose while one types."""
        if not self.query_one(Input).has_focus:
            return
        if event.key == "escape":
            event.stop()
            self._close_search()
        elif event.key in ("up", "down"):
            event.stop()
            event.prevent_default()
            self.query_one(FoundList).move(1 if event.key == "down" else -1)

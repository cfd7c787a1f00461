"""F7: what comes next, how high, where, and how much of it this dish can follow."""

from __future__ import annotations

from birdcage.base.config import feed_label
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.timer import Timer
from textual.widgets import Input

from birdcage_tui.passes.figures import PassFigures
from birdcage_tui.passes.head import PassHeadRow
from birdcage_tui.passes.listing import PassList
from birdcage_tui.passes.passes_layout import BESIDE_MAP, MAP_LIST, VIEWS, PassesLayout, layout
from birdcage_tui.passes.plot import PassSky
from birdcage_tui.passes.selection import PassSelection, utc_of
from birdcage_tui.passes.strip import PassStrip
from birdcage_tui.passes.time_ask import time_screen
from birdcage_tui.passes.time_text import moment_of
from birdcage_tui.passes.timeline import Timeline
from birdcage_tui.passes.world_map_ask import PassWorld
from birdcage_tui.shown.offer import Offer
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.esc_field import EscField
from birdcage_tui.widgets.fields_screen import Values
from birdcage_tui.widgets.filter_box import FilterHands
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.pane import Pane

SHIFTS_S = {"time-back": -60.0, "time-forward": 60.0, "time-far-back": -1800.0, "time-far-forward": 1800.0}
RUN_S = 0.25
"""Between two frames while the time shown runs by itself."""


class PassesPage(FilterHands, Page):
    """The list at the left, the chosen pass at the right, the timeline below; or the world."""

    DEFAULT_CSS = """
    PassesPage { layout: vertical; }
    PassesPage PassHeadRow { height: 1; }
    PassesPage #pass-upper { height: auto; }
    PassesPage PassList, PassesPage PassSky, PassesPage PassStrip, PassesPage PassFigures, PassesPage Timeline,
    PassesPage PassWorld { border: round $line; border-title-color: $dim; border-title-style: none;
        border-subtitle-color: $dim; }
    PassesPage PassWorld { width: 1fr; height: 1fr; }
    PassesPage PassList:focus, PassesPage PassWorld:focus { border: round $focus; border-title-color: $foreground; }
    PassesPage #pass-side { width: 1fr; }
    PassesPage Input, PassesPage Input:focus { height: 1; border: none; padding: 0 1; background: $panel; }
    """
    RATE_HZ = 1.0
    FIRST_FOCUS = "#pass-list"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.selection = PassSelection()
        self._shown = VIEWS[0]
        self._layout: PassesLayout | None = None
        self._pace: Timer | None = None
        self._toggled: list[tuple[int, str, bool]] = []
        """Favourites marked or unmarked here, the last one last: number, name, what it was before."""

    def compose(self) -> ComposeResult:
        """The parts, from the top left."""
        yield PassHeadRow(self.selection, id="pass-head")
        field = EscField("names, numbers, groups; Enter applies it", closes="clears it", id="pass-filter")
        field.display = False
        yield field
        with Horizontal(id="pass-upper"):
            yield PassList(self.selection, id="pass-list")
            with Vertical(id="pass-side"):
                yield PassSky(self.selection, id="pass-sky")
                yield PassStrip(self.selection, id="pass-strip")
                yield PassFigures(self.selection, id="pass-figures")
            world = PassWorld(self.selection, id="pass-world")
            world.display = False
            yield world
        yield Timeline(self.selection, id="pass-timeline")

    def on_mount(self) -> None:
        """Have a timer ready for a time that runs."""
        self._pace = self.set_interval(RUN_S, self._run, pause=True)

    def on_resize(self) -> None:
        """Choose the layout."""
        self._arrange()

    def _arrange(self) -> None:
        field = self.query_one(Input)
        found = layout(self.size.width, self.size.height - bool(field.display), self._shown)
        if found == self._layout and self.selection.world == self.query_one(PassWorld).display:
            return
        self._layout = found
        self.query_one(PassWorld).display = self.selection.world
        side, upper = self.query_one("#pass-side"), self.query_one("#pass-upper")
        listing = self.query_one(PassList)
        listing.styles.width, listing.styles.height = found.list_width, found.list_height
        listing.display = not self.selection.world or self.size.width >= BESIDE_MAP
        lower = found.strip_height + found.figures_height
        side.display = found.plot_height + lower > 0
        side.styles.height = found.plot_height + lower
        self.query_one(PassSky).alone = not found.figures_height
        upper.styles.layout = "horizontal" if found.plot_height else "vertical"
        upper.styles.height = found.list_height + (0 if found.plot_height else lower)
        for kind, rows in ((PassSky, found.plot_height), (PassStrip, found.strip_height),
                           (PassFigures, found.figures_height), (Timeline, found.timeline_height)):  # fmt: skip
            pane = self.query_one(kind)
            pane.display = rows > 0 and not self.selection.world
            pane.styles.height = rows
        if self.selection.world:
            side.display = False
            listing.styles.width, listing.styles.height = MAP_LIST, "1fr"
            upper.styles.layout, upper.styles.height = "horizontal", "1fr"
        for pane in self.query(Pane):
            pane.redraw()

    # The time machine.

    def _run(self) -> None:
        if not self.display or not self.selection.machine.runs:
            if self._pace is not None:
                self._pace.pause()
            return
        self.host.paint()

    def show(self, view: View) -> None:
        """Draw; and go on drawing while the time shown runs."""
        if self._pace is not None and self.selection.machine.runs:
            self._pace.resume()
        super().show(view)

    def on_timeline_scrubbed(self, event: Timeline.Scrubbed) -> None:
        """Show the moment under the mouse; there it stands still."""
        event.stop()
        machine, now_s = self.selection.machine, self.host.view().utc.timestamp()
        machine.to(now_s, event.t_s)
        self._moment()

    def _time(self, command: str, view: View) -> bool:
        machine, now_s = self.selection.machine, view.utc.timestamp()
        self.selection.time(view)  # the bounds
        match command:
            case "time-now":
                machine.back_to_now()
            case "time-pause":
                machine.pause(now_s)
            case "time-faster" | "time-slower":
                machine.faster(now_s, 1 if command == "time-faster" else -1)
            case "time-event":
                self._jump(view)
            case "time-type":
                self._ask_time(view)
            case _ if command in SHIFTS_S:
                machine.shift(now_s, SHIFTS_S[command])
            case _:
                return False
        self._moment()
        return True

    def _jump(self, view: View) -> None:
        row, t_s = self.selection.chosen(view), self.selection.time(view)
        if row is None:
            return
        # At LOS it is over, and no longer in the list.
        moments = sorted([row.tca_s, *(at_s for at_s, word in row.events() if word != "LOS")])
        later = next((at_s for at_s in moments if at_s > t_s + 0.5), None)
        if later is None:
            self.host.say("No more events before it sets.")
            return
        self.selection.machine.to(view.utc.timestamp(), later)
        self.selection.choose(row)

    def _ask_time(self, view: View) -> None:
        shown = utc_of(self.selection.time(view))

        def answered(values: Values | None) -> None:
            if values is None:
                return
            now = self.host.view()
            wanted_s = moment_of(values[0], shown).timestamp()
            self.selection.machine.to(now.utc.timestamp(), wanted_s)
            if abs(self.selection.time(now) - wanted_s) > 1.0:
                known_until = utc_of(self.selection.time(now))
                self.host.say(f"Passes are known until {known_until:%Y-%m-%d %H:%M}Z. That time is shown.")
            self._moment()

        self.app.push_screen(time_screen(shown), answered)

    def _moment(self) -> None:
        self.selection.changed()
        self.host.paint()

    # The list.

    def do(self, command: str) -> bool:
        """Do what is the page's own."""
        view = self.host.view()
        if command.startswith("time-"):
            return self._time(command, view)
        choice = self.selection.choice
        match command:
            case "pass-up" | "pass-down":
                self.selection.move(view, 1 if command == "pass-down" else -1)
            case "pass-page-up" | "pass-page-down":
                rows = self.query_one(PassList).page_rows
                self.selection.move(view, rows if command == "pass-page-down" else -rows)
            case "pass-first":
                self.selection.choose(None)
            case "pass-sort":
                self.host.say(f"Sorted by {choice.next_sort()}.")
            case "pass-reachable":
                choice.reachable_only = not choice.reachable_only
                self._hidden(choice.reachable_only, "passes in reach of this dish")
            case "pass-hearable":
                choice.hearable_only = not self.selection.hearable(view)
                heard = f"satellites that the feed {feed_label(self.selection.sky(view).feed)} can hear"
                self._hidden(choice.hearable_only, heard)
            case "pass-favourites":
                choice.favourites_only = not choice.favourites_only
                self._hidden(choice.favourites_only, "favourites")
            case "pass-view" if not self.selection.world:
                views = VIEWS if self._layout is None or not self._layout.roomy else ("elevation", "figures")
                self._shown = views[(views.index(self._shown) + 1) % len(views) if self._shown in views else 1]
                self._arrange()
            case "pass-world" | "pass-view":
                self.selection.world = not self.selection.world
                self._arrange()
                self._focus()
            case "pass-filter":
                self._open_filter()
            case "pass-favourite" | "pass-undo":
                self._favourite(command, view)
            case "pass-follow":
                self._follow(view)
                return True
            case "pass-export":
                self._export(view)
            case _:
                return False
        self._moment()
        return True

    def _hidden(self, only: bool, what: str) -> None:
        self.host.say(f"Showing {'only ' if only else 'more than '}{what}.")

    def _favourite(self, command: str, view: View) -> None:
        if command == "pass-undo":
            if not self._toggled:
                self.host.say("No favourite change to undo.")
                return
            number, name, wanted = self._toggled.pop()
        else:
            row = self.selection.chosen(view)
            if row is None:
                return
            number, name, wanted = row.norad_id, row.name, not row.favourite
            self._toggled.append((number, name, row.favourite))
        self.host.sky.set_favourite(number or name, wanted)
        undo = "" if command == "pass-undo" else " u: undo."
        self.host.say(f"{name} is {'a favourite' if wanted else 'no longer a favourite'}.{undo}")

    def _follow(self, view: View) -> None:
        """Show the plan of the chosen pass on F2, where Enter follows it."""
        row = self.selection.chosen(view)
        if row is None:
            self.host.say("No pass selected.")
            return
        self.host.track.offer = Offer(row.name, row.norad_id, row.tca_s)
        self.host.show_page("control", "open-offer")

    def _export(self, view: View) -> None:
        self.host.sky.export(self.selection.rows(view))

    def _focus(self) -> None:
        self.query_one(PassWorld if self.selection.world else PassList).focus()

    # The filter.

    def _open_filter(self) -> None:
        field = self.query_one(Input)
        field.disabled, field.display = False, True
        self._arrange()
        field.focus()

    def close_filter(self, words: str) -> None:
        """Go back to the list, with these words in force."""
        field = self.query_one(Input)
        field.value = words
        self.selection.choice.filter = words
        self._locate(words)
        self._focus()
        field.disabled, field.display = True, False
        self._arrange()
        self._moment()

    def on_input_changed(self, event: Input.Changed) -> None:
        """Show what is left, as one types."""
        event.stop()
        self.selection.choice.filter = event.value.strip()
        self._locate(self.selection.choice.filter)
        self.selection.choose(None)
        self._moment()

    def _locate(self, text: str) -> None:
        """Have the target desk say what is meant, for where no pass is left: a known name is not an unknown one."""
        source = self.host.track.source
        if source is not None:
            source.locate(text)

"""The map of the sky as it fills in: in degrees, with what stands in it, a cursor that reads it out, and cuts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import cast

from birdcage.skymap.plan import MapFrame
from birdcage.station.task_state import TaskPhase
from rich.style import Style
from textual import events

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len, shorten, wrap
from birdcage_tui.drawing.themes import DEFAULT, LOOKS
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.map_book import MapShown, map_task
from birdcage_tui.shown.map_offer import AWAY, HEADS, RELEASES, MapOffer
from birdcage_tui.shown.map_words import drift_words, enter_first, readout, state_words, value_words
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import View
from birdcage_tui.signal.map_cuts import draw_column_cut, draw_row_cut
from birdcage_tui.signal.map_inks import colours_for, glyph, inks_of, pair
from birdcage_tui.signal.map_layout import BAR, SMALL, MapLayout
from birdcage_tui.signal.map_marks import SUN_SIGN, draw_beam
from birdcage_tui.signal.map_offer_drawing import draw_offer
from birdcage_tui.signal.map_overlay import MapOverlay
from birdcage_tui.signal.map_picture import MapPicture
from birdcage_tui.signal.map_raster import LEVELS
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.pane import Pane

EMPTY = "No map yet. m maps the sky, M lists the maps that are kept."
LOADING = "The map begins with its first direction."
NO_ROOM = "Too small for a map."
TROUBLE = "file not read"
"""Of a map whose file can't be read, where there is no room to say why."""
NEXT = "□"
LEGEND = "◆ satellite  ─ horizon  ·· Sun  ◉ dish, beam  □ next"
MOVES = {"map-left": (-1, 0), "map-right": (1, 0), "map-up": (0, 1), "map-down": (0, -1), "map-far-left": (-10, 0),
         "map-far-right": (10, 0), "map-far-up": (0, 10), "map-far-down": (0, -10)}  # fmt: skip
"""Columns and rows of the map that a key moves the cursor by."""
OFFER_KEYS: Mapping[str, Callable[[MapOffer], MapOffer]] = {
    "map-offer-left": lambda offer: offer.moved(-1), "map-offer-right": lambda offer: offer.moved(1),
    "map-offer-accept": MapOffer.toggled, "map-offer-all": MapOffer.all_toggled,
}  # fmt: skip
"""What a key does to a proposed horizon."""


class MapPane(Pane, can_focus=True):
    """Draws the map that the app has open."""

    HELP = (
        "The sky as it was heard. ▲ and ▶ mark the cursor's column and row, □ the next direction, ◉ the dish and its "
        "beam, ◆ satellites. The line is the horizon, dots are the Sun's path. Dim directions show a neighbour's "
        "level until they are heard themselves. i goes in and out, g offers to point there."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Map"
        self.cuts: bool | None = None
        """Whether cuts are drawn; None: where there is room."""
        self.colours = ""
        """Which colours were chosen; empty for the usual ones."""
        self._cell: int | None = None
        self._of = ""
        self._layout: MapLayout | None = None
        self._picture = MapPicture()
        self.offer: MapOffer | None = None
        """A horizon that this map proposes, while a person accepts it."""

    @property
    def inks(self) -> Mapping[str, Style]:  # type: ignore[override]
        """The styles of the theme, and those of the picture."""
        theme = self.app.theme if self.app.theme in LOOKS else DEFAULT
        chosen = self.colours or cast(AppHost, self.app).settings.map_colours
        return inks_of(theme, colours_for(chosen, theme))

    @property
    def scope(self) -> str:
        """What its commands have in `where`."""
        return "map" if self.offered is None else "map-offer"

    @property
    def offered(self) -> MapOffer | None:
        """The proposed horizon while keys go to it: without the focus arrows step the dish, so it is not drawn."""
        return self.offer if self.screen.focused is self else None

    def do(self, command: str) -> bool:
        """Move the cursor; the page does the rest."""
        if self.offer is not None and command in OFFER_KEYS:
            self.offer = OFFER_KEYS[command](self.offer)
            cast(AppHost, self.app).paint()
            return True
        if command not in MOVES:
            return self.query_ancestor(Page).do(command)
        self._step(*MOVES[command])
        return True

    def cursor(self, shown: MapShown) -> int | None:
        """Return the cell of the cursor: where it was put, or at first the loudest; None while nothing was heard."""
        if self._of != shown.key:
            self._of, self._cell = shown.key, None
        return self._cell if self._cell is not None else shown.loudest

    def direction(self, shown: MapShown) -> tuple[float, float] | None:
        """Return azimuth and elevation under the cursor; None on a map that moves with its target."""
        at = self.cursor(shown)
        if at is None or shown.plan.frame is MapFrame.TARGET:
            return None
        az_deg, el_deg = shown.plan.at(at)
        return az_deg % 360.0, el_deg

    @property
    def has_cuts(self) -> bool:
        """Whether cuts are drawn now."""
        return self._layout is not None and self._layout.cut_rows > 0

    def _step(self, right: int, up: int) -> None:
        shown = None if self.view is None else self.view.map
        if shown is None:
            return
        start = self.cursor(shown)
        row, column = divmod(0 if start is None else start, shown.plan.columns)
        column = min(max(column + right, 0), shown.plan.columns - 1)
        row = min(max(row + up, 0), shown.plan.rows - 1)
        self._cell = row * shown.plan.columns + column
        cast(AppHost, self.app).paint()

    def draw(self, cells: Cells, view: View) -> None:
        """Draw head, picture, axes, bar and readout."""
        shown = view.map
        if self.offer is not None and (shown is None or shown.key != self.offer.key):
            self.offer = None  # it was another map's
        ink, words = state_words(view)
        self._layout = None
        self._entitle(shown)
        if shown is None:
            told = view.map_trouble or (EMPTY if map_task(view.state.tasks) is None else LOADING)
            if words[0]:
                cells.put(1, 0, shorten(words[0], cells.width - 2), ink)
            for row, line in enumerate(wrap(told, max(cells.width - 2, 10)), int(bool(words[0]))):
                cells.put(1, row, line, "dim")
            return
        layout = MapLayout.of(shown.plan, cells.width, cells.height, view.settings.cell_aspect, cuts=self.cuts)
        if layout is None:
            cells.put(0, 0, shorten(NO_ROOM, cells.width), "dim")
            return
        self._layout = layout
        self._head(cells, shown, ink, words)
        place = _place(shown, view)
        plain = self.app.has_class("-few-colours") or view.settings.glyphs == "ascii"
        surface = self._picture.surface(shown, layout.chart, view, place, plain=plain)
        surface.lay(self._moving(shown, layout, view, place))
        surface.onto(cells, layout.left, layout.top)
        at = self.cursor(shown)
        _axes(cells, layout, None if at is None else layout.chart.spot_of(at))
        _bar(cells, layout, shown, plain=plain)
        if at is not None:
            self._at(cells, layout, shown, at)
        if (offer := self.offered) is not None:
            _offered(cells, offer)
            return
        _bottom(cells, shown, at, self._picture.slot_places(place), self._hint(view), chosen=self._cell is not None)

    def _hint(self, view: View) -> str:
        """Return how the cursor gets the arrows, and what they do until then."""
        if self.has_focus or not self.can_focus:
            return ""
        enters = f"{BY_NAME['map-enter'].shown}: cursor"
        return f"arrows step the dish and end the map, {enters}" if _runs(view) else enters

    def _entitle(self, shown: MapShown | None) -> None:
        """Tell in the frame what it is a map of."""
        name = "Map"
        if shown is not None:
            demo = "DEMO, " if shown.sky.demo else ""
            name = f"Map  {demo}{shown.sky.title}, every {shown.plan.step_deg:g}°"
        if self.border_title != name:  # setting it repaints the pane, equal or not
            self.border_title = name
        legend = LEGEND if shown is not None and self.size.width >= len(LEGEND) + 4 else ""
        if self.border_subtitle != legend:
            self.border_subtitle = legend

    def _head(self, cells: Cells, shown: MapShown, ink: str, words: tuple[str, ...]) -> None:
        room = cells.width - 2
        if self.offer is not None:
            ink, words = "accent-strong", self._offer_heads(self.offer)
        told = next((each for each in words if cell_len(each) <= room), shorten(words[-1], room))
        x = cells.put(1, 0, told, ink)
        aside = [("dim", f"{shown.sky.about.get('source_label') or shown.sky.source}, {shown.sky.unit}")]
        ink, drift = drift_words(
            None if self.view is None else map_task(self.view.state.tasks, shown.key), decibels=shown.sky.decibels
        )
        if drift:
            aside.insert(0, (ink, drift))
        if self.view is not None and self.view.map_trouble:
            aside = [("fault-strong", self.view.map_trouble), ("fault-strong", TROUBLE)]
        for ink, each in aside:
            if x + cell_len(each) + 3 <= cells.width:
                cells.right(cells.width - 1, 0, each, ink)
                break

    def _offer_heads(self, offer: MapOffer) -> tuple[str, ...]:
        """Return what the keys do to it now, the longest first."""
        if self.offered is None:
            return tuple(each.format(len(offer.accepted)) for each in AWAY)
        if self.view is not None and (releases := enter_first(self.view)):
            return tuple(each.format(releases) for each in RELEASES)
        return tuple(each.format(len(offer.accepted)) for each in HEADS)

    def _moving(self, shown: MapShown, layout: MapLayout, view: View, place: SitePlace | None) -> MapOverlay:
        """Draw what is elsewhere in each frame: the Sun, the dish and its beam, the next direction, the cursor."""
        overlay = MapOverlay(layout.chart.width, layout.chart.height)
        if (offer := self.offered) is not None:
            draw_offer(overlay, layout.chart, offer)
            return overlay
        chart, task = layout.chart, map_task(view.state.tasks, shown.key)
        if task is not None and place is not None and chart.plan.frame is MapFrame.AZEL:
            spot = chart.spot(*self._picture.sun(place, view.utc))
            if chart.holds(*spot):
                overlay.put(int(spot[0]), int(spot[1]), SUN_SIGN, "target-strong")
        if _runs(view) and shown.next_cell is not None:
            x, y = chart.spot_of(shown.next_cell)
            overlay.put(int(x), int(y), NEXT, "accent-strong")
        position = view.state.position
        if position is not None and chart.plan.frame is MapFrame.AZEL:
            spot = chart.spot(position.az_deg, position.el_deg)
            if view.state.beam is not None:
                canvas = Braille(chart.width, chart.height)
                draw_beam(canvas, chart, spot, view.state.beam, position.el_deg)
                overlay.lines(canvas)
            if chart.holds(*spot):
                overlay.put(int(spot[0]), int(spot[1]), view.pointer, "dim" if view.stale else "accent-strong")
        if self.has_focus and (at := self.cursor(shown)) is not None:
            x, y = chart.spot_of(at)
            overlay.put(int(x), int(y), "╋", "strong")
        return overlay

    def _at(self, cells: Cells, layout: MapLayout, shown: MapShown, at: int) -> None:
        """Mark the cursor on both axes, and draw the cuts through it."""
        chart = layout.chart
        x, y = (int(each) for each in chart.spot_of(at))
        ink = "target-strong" if self.has_focus else "dim"
        if layout.axis:
            cells.put(layout.left + x, layout.axis_row, "▲", ink)
            cells.put(layout.left - 1, layout.top + y, "▶", ink)
        if layout.cut_rows:
            draw_row_cut(cells, shown, chart, at, (layout.left, layout.axis_row + 1), layout.cut_rows)
        if layout.cut_columns:
            left = layout.left + chart.width + 1
            draw_column_cut(cells, shown, chart, at, (left, layout.top), layout.cut_columns)
            if shown.span is not None and layout.axis:
                cells.put(left, layout.axis_row, value_words(shown, shown.span[0]), "dim")
                cells.right(left + layout.cut_columns, layout.axis_row, value_words(shown, shown.span[1]), "dim")

    def on_click(self, event: events.Click) -> None:
        """Put the cursor there."""
        offset = event.get_content_offset(self)
        shown = None if self.view is None else self.view.map
        if offset is None or shown is None or self._layout is None:
            return
        cell = self._layout.chart.cell(offset.x - self._layout.left + 0.5, offset.y - self._layout.top + 0.5)
        if cell is not None:
            event.stop()
            self._of, self._cell = shown.key, cell
            self.focus()
            cast(AppHost, self.app).paint()

    def on_key(self, event: events.Key) -> None:
        """Esc leaves the map (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            if self.offered is not None:
                self.withdraw()
            else:
                self.leave()

    def withdraw(self) -> None:
        """Take the proposed horizon off the map; nothing is kept."""
        self.offer = None
        cast(AppHost, self.app).say("Proposal discarded. The horizon is unchanged.")
        cast(AppHost, self.app).paint()

    def leave(self) -> None:
        """Give the arrows back to the dish."""
        self.screen.set_focus(None)
        cast(AppHost, self.app).paint()

    def on_focus(self) -> None:
        """Show the cursor, once Textual has taken the focus in."""
        self.call_later(self._again)

    def on_blur(self) -> None:
        """Hide it."""
        self.call_later(self._again)

    def _again(self) -> None:
        if self.view is not None and self.is_attached:
            self.show(self.view)


def _place(shown: MapShown, view: View) -> SitePlace | None:
    """Return where the map was heard; where it does not say, where the dish stands now."""
    place = shown.sky.place()
    return view.settings.place if place is None else SitePlace(*place)


def _axes(cells: Cells, layout: MapLayout, marked: tuple[float, float] | None) -> None:
    """Write round angles under and left of the picture, where they leave the cursor's marks free."""
    if not layout.axis:
        return
    chart = layout.chart
    for deg in chart.y_ticks(3):
        y = min(int(chart.y(deg)), chart.height - 1)
        if marked is not None and int(marked[1]) == y:
            continue
        cells.right(layout.left - 1, layout.top + y, chart.y_text(deg), "dim")
        cells.put(layout.left - 1, layout.top + y, "┤", "line")
    end = 0
    for deg in chart.x_ticks(8):
        text, x = chart.x_text(deg), layout.left + min(int(chart.x(deg)), chart.width - 1)
        start = min(max(x - len(text) // 2, layout.left), layout.left + chart.width - len(text))
        free = marked is None or not start <= layout.left + int(marked[0]) < start + len(text)
        if start >= end and free:
            end = cells.put(start, layout.axis_row, text, "dim") + 1


def _bar(cells: Cells, layout: MapLayout, shown: MapShown, *, plain: bool) -> None:
    """Draw the colour bar with its numbers."""
    if not layout.bar or shown.span is None:
        return
    height, (low, high) = layout.chart.height, shown.span
    for row in range(height):
        upper, lower = (round((1.0 - (row + part) / height) * (LEVELS - 1)) for part in (0.25, 0.75))
        sign = glyph(upper, ascii_only=cells.glyphs == "ascii") if plain else "▀"
        cells.put(layout.bar, layout.top + row, sign * BAR, "text" if plain else pair(upper, lower))
    numbers = min(max(height // 4, 1), 6)
    for index in range(numbers + 1):
        row = round(index * (height - 1) / numbers)
        value = high - (high - low) * (row / max(height - 1, 1))
        cells.put(layout.bar + BAR + 1, layout.top + row, value_words(shown, value), "dim")
    cells.put(layout.bar, layout.axis_row, shown.sky.unit, "dim")


def _offered(cells: Cells, offer: MapOffer) -> None:
    """Write what the proposed point under the cursor says."""
    x = 1
    for index, each in enumerate(offer.words()):
        if x + cell_len(each) > cells.width:
            break
        x = cells.put(x, cells.height - 1, each, "strong" if index else "text") + 2


def _runs(view: View) -> bool:
    """Return whether the map that is shown is being made, so that a step by hand would end it."""
    task = None if view.map is None else map_task(view.state.tasks, view.map.key)
    return task is not None and task.phase is TaskPhase.RUNNING


def _bottom(
    cells: Cells, shown: MapShown, at: int | None, slots: tuple[tuple[str, float, float], ...], hint: str, *,
    chosen: bool,
) -> None:  # fmt: skip
    """Write what was heard at the cursor; at first at the loudest direction."""
    y = cells.height - 1
    if at is None:
        return
    x = 1
    if not chosen:
        x = cells.put(x, y, "loudest", "dim") + 1
    for index, each in enumerate(readout(shown, at, slots, brief=cells.width < SMALL[0])):
        if x + cell_len(each) > cells.width:
            break
        x = cells.put(x, y, each, "strong" if index < 2 else "text") + 2
    if hint and x + cell_len(hint) + 1 <= cells.width:
        cells.right(cells.width - 1, y, hint, "dim")

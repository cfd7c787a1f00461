"""The world from above: where satellites are, the way of the chosen one, from where it is seen, day and night."""

from __future__ import annotations

from birdcage.sky.footprint import radius_km
from birdcage.sky.world import SubPoint, WorldView
from textual import events

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len, elide
from birdcage_tui.passes.world_map_chart import Chart, Layers
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.sky_ground import QUIET

OVER = (*QUIET, "target", "text", "accent")
"""Dots that a mark may stand on."""
CALM = ("faint", "line")
SMALLEST = (20, 6)
LONGEST = 16
"""Letters of a name."""
CELLS_A_NAME = 90
"""A name for so many cells of the map, at most."""
FOLLOWED = "following "
"""Before the name of the satellite that the dish follows: ink alone tells nothing without colours."""
NOTHING = "No pass selected, or no position for its satellite."
EMPTY = "Loading the map …"


class WorldMapPane(Pane, can_focus=True):
    """Shows one `WorldView` after another."""

    HELP = (
        "World map with the satellites of the listed passes. For the selected one the track ahead is solid, "
        "behind dotted. The ring is its footprint. Dots are night, ☼ is under the Sun. Up and down select another "
        "pass. w goes back to the list."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "World  solid ahead  dotted behind  ○ footprint  · night  ☼ Sun overhead"
        self.world: WorldView | None = None
        self._layers = Layers()
        self._drawn: tuple[WorldView | None, str, str | None] | None = None
        """The world that stands there, the sign of the dish on it, and what it follows."""

    def show(self, view: View) -> None:
        """Draw the world, unless that one stands there already: it changes once a second, and frames are many."""
        pursuit = pursuit_of(view.state)
        now = (self.world, view.pointer, None if pursuit is None else pursuit.plan.aim.name)
        if self._cells is not None and self._drawn == now:
            self.view = view
            return
        self._drawn = now
        super().show(view)

    def look_down(self, world: WorldView | None) -> None:
        """Show the world as it is at another moment; None for nothing that is known."""
        if world is not self.world:
            self.world = world
            if self.view is not None:
                self.show(self.view)

    def chart(self, width: int, height: int) -> tuple[Chart, int, int]:
        """Return the map, and the cell of its top left corner: in the middle of what is not the row of figures."""
        chart = Chart.within(width, height - 1)
        return chart, (width - chart.width) // 2, (height - 1 - chart.height) // 2

    def draw(self, cells: Cells, view: View) -> None:
        """Draw what is quiet (kept between frames), then what moves, then the figures."""
        world = self.world
        if world is None or cells.width < SMALLEST[0] or cells.height < SMALLEST[1]:
            cells.put(1, 0, (EMPTY if world is None else "Too small for a map.")[: cells.width - 1], "dim")
            return
        chart, left, top = self.chart(cells.width, cells.height)
        canvas = self._layers.draw(chart, world.sun)
        _lines(canvas, chart, world)
        canvas.onto(cells, left, top)
        _marks(cells, chart, left, top, world, view)
        _figures(cells, world, self.seen())

    def seen(self) -> tuple[str, ...]:
        """Return when the chosen satellite is in reach and in view of the observer, where known: nothing here."""
        return ()

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Read out the place under the mouse, and whether it is day there."""
        chart, left, top = self.chart(self.size.width, self.size.height)
        found = chart.place(event.x - 1 - left, event.y - 1 - top)
        if found is None or self.world is None:
            self.border_subtitle = ""
            return
        height_deg = self.world.sun.elevation_deg(*found)
        self.border_subtitle = f"{place_text(*found, digits=0)}  Sun {height_deg:.0f}°"

    def on_leave(self) -> None:
        """The mouse is elsewhere."""
        self.border_subtitle = ""


def place_text(latitude_deg: float, longitude_deg: float, digits: int = 1) -> str:
    """Return `52.1°N 5.2°E`."""
    north, east = "N" if latitude_deg >= 0.0 else "S", "E" if longitude_deg >= 0.0 else "W"
    return f"{abs(latitude_deg):.{digits}f}°{north} {abs(longitude_deg):.{digits}f}°{east}"


def _lines(canvas: Braille, chart: Chart, world: WorldView) -> None:
    """Draw the ring, then the way: past is dotted, future is solid."""
    for places, ink, spacing in ((world.footprint, "dim", 1.0), (world.behind, "target", 4.0),
                                 (world.ahead, "target", 1.0)):  # fmt: skip
        for x, y in chart.along(places, spacing):
            canvas.dot(x, y, ink)


def _marks(cells: Cells, chart: Chart, left: int, top: int, world: WorldView, view: View) -> None:
    """Write Sun, observer and satellites, and names where they lie on nothing."""

    def at(latitude_deg: float, longitude_deg: float) -> tuple[int, int]:
        x, y = chart.cell(latitude_deg, longitude_deg)
        return left + x, top + y

    def is_followed(one: SubPoint) -> bool:
        return aim is not None and (one.norad_id == aim.norad_id if aim.norad_id else one.name == aim.name)

    pursuit = pursuit_of(view.state)
    aim = None if pursuit is None else pursuit.plan.aim
    cells.put(*at(world.sun.latitude_deg, world.sun.longitude_deg), "☼", "strong")
    for one in world.satellites:
        spot = at(one.latitude_deg, one.longitude_deg)
        if cells.free(*spot, 1, *OVER):
            cells.put(*spot, "•", "strong" if one.favourite else "text")
    if world.observer is not None:
        spot = at(world.observer.latitude_deg, world.observer.longitude_deg)
        cells.put(*spot, view.pointer, "accent-strong")
        _name(cells, chart, left, world.observer.name or "you", *spot, "accent", CALM, QUIET, OVER)
    if world.chosen is not None:
        spot = at(world.chosen.latitude_deg, world.chosen.longitude_deg)
        cells.put(*spot, "•", "target-strong")
        which = FOLLOWED if is_followed(world.chosen) else ""
        _name(cells, chart, left, world.chosen.name, *spot, "target-strong", CALM, QUIET, OVER, before=which)
    for one in filter(is_followed, world.satellites):
        spot = at(one.latitude_deg, one.longitude_deg)
        cells.put(*spot, "•", "accent-strong")
        _name(cells, chart, left, one.name, *spot, "accent-strong", CALM, QUIET, OVER, before=FOLLOWED)
    room = chart.width * chart.height // CELLS_A_NAME
    others = [one for one in world.satellites if not is_followed(one)]
    for one in sorted(others, key=lambda one: (not one.favourite, one.name))[:room]:
        spot = at(one.latitude_deg, one.longitude_deg)
        if one.favourite:
            _name(cells, chart, left, one.name, *spot, "text", CALM, rows=1)
        else:
            _name(cells, chart, left, one.name, *spot, "dim", ("faint",), CALM, rows=1)


def _name(
    cells: Cells, chart: Chart, left: int, name: str, x: int, y: int, ink: str, *over: tuple[str, ...], rows: int = 3,
    before: str = "",
) -> None:  # fmt: skip
    """Write a name beside its mark, away from the nearer side, on dots in the first of those inks that leave room.

    `rows`: 3 for a name that may also stand a row above or below, 1 for one that then would be taken for another's.
    """
    name = before + elide(name, LONGEST)
    sides = (x + 2, x - 1 - cell_len(name))
    for inks in over:
        for start in sides if x < left + chart.width // 2 else sides[::-1]:
            for row in (y, y - 1, y + 1)[:rows]:
                inside = left <= start <= left + chart.width - cell_len(name)
                begin, end = max(start - 1, 0), min(start + cell_len(name) + 1, cells.width)
                if inside and cells.free(begin, row, end - begin, *inks):
                    cells.put(start, row, name, ink)
                    return


def _figures(cells: Cells, world: WorldView, seen: tuple[str, ...]) -> None:
    """Write the last row: when, where the chosen satellite is, and when it is in view; what has no room is left out."""
    y = cells.height - 1
    x = cells.put(1, y, f"{world.utc:%H:%M:%S}Z  ", "dim")
    chosen = world.chosen
    if chosen is None:
        cells.put(x, y, NOTHING[: cells.width - x], "dim")
        return
    told = [
        ("target-strong", chosen.name),
        *(("target", words) for words in seen),
        ("text", _where(chosen)),
        ("dim", _wide(chosen)),
    ]
    for ink, words in told:
        if words and x + cell_len(words) <= cells.width:
            x = cells.put(x, y, words, ink) + 2


def _where(one: SubPoint) -> str:
    return f"{place_text(one.latitude_deg, one.longitude_deg)}  {one.altitude_km:,.0f} km up"


def _wide(one: SubPoint) -> str:
    return f"footprint radius {radius_km(one.altitude_km):,.0f} km"

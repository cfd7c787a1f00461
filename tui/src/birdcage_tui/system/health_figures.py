"""The figures under the findings: motors, and link with power. What is not known is a dash."""

from __future__ import annotations

from birdcage.diagnostics.figures import HealthFigures, MotorFigures
from birdcage.station.state import TvSearch

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import elide
from birdcage_tui.shown.state_words import SEARCH, age_text, unhomed_word
from birdcage_tui.shown.system_sheet import number_words
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

BARS = "▁▂▃▄▅▆▇█"
NAME, AXIS, LINK_NAME = 13, 12, 10
"""Columns of a row's name, of the value of an axis, and of a row's name beside."""


def figures_of(view: View) -> HealthFigures | None:
    """Return the figures; None before they were read."""
    health = view.health.health
    return None if health is None else health.figures


class MotorFiguresPane(Pane):
    """Stalls, driver, moves and turns of each axis."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Motors"

    def draw(self, cells: Cells, view: View) -> None:
        """Write a column for each axis."""
        figures = figures_of(view)
        if figures is None or not figures.motors:
            cells.put(1, 0, "--", "dim")
            return
        days = f"{figures.days} d"
        rows = (f"stalls, {days}", "driver", f"moves, {days}", f"turns, {days}", "turns in all")
        for y, name in enumerate(rows, 1):
            cells.put(1, y, name, "dim")
        axis = max(min(AXIS, (cells.width - NAME - 3) // len(figures.motors)), 6)
        whole = all(len(motor.axis) < axis for motor in figures.motors)
        for number, motor in enumerate(figures.motors):
            x = 2 + NAME + axis * number
            cells.put(x, 0, motor.axis if whole else motor.axis[:2], "dim")
            for y, (value, ink) in enumerate(_motor_values(motor, view), 1):
                cells.put(x, y, elide(value, axis - 1), ink)


def _motor_values(motor: MotorFigures, view: View) -> list[tuple[str, str]]:
    driver = ("--", "dim")
    if motor.driver is not None:
        ink = {True: "text", False: "fault", None: "text"}[motor.driver_is_good]
        driver = (f"{motor.driver.value} {age_text(view.now - motor.driver.at)}", ink)
    total = "--" if motor.turns_in_all is None else _turns(motor.turns_in_all)
    return [
        (str(motor.stalls), "warn" if motor.stalls else "text"), driver, (f"{motor.moves:,}", "text"),
        (_turns(motor.turns), "text"), (total, "text"),
    ]  # fmt: skip


def _turns(turns: float) -> str:
    """Return turns with no more digits than they mean."""
    return f"{turns:,.0f}" if turns >= 100.0 else f"{turns:.1f}"


class LinkFiguresPane(Pane):
    """Replies, restarts, what stands in the dish now."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Link and power"

    def draw(self, cells: Cells, view: View) -> None:
        """Write a row for each."""
        figures = figures_of(view)
        title = "Link and power" if figures is None else f"Link and power, {figures.days} days"
        if title != self.border_title:
            self.border_title = title
        if figures is None:
            cells.put(1, 0, "--", "dim")
            return
        link = figures.link
        trip = "" if link.round_trip_s is None else f"{link.round_trip_s * 1000:.0f} ms, "
        lost = f"{trip}{link.unanswered:,} of {link.asked:,} lost" if link.asked else f"{trip}lost: --"
        last = "" if link.last_restart is None else f", last {link.last_restart.utc:%d %b %H:%M}Z"
        supply = "--" if link.lnb_supply is None else f"{number_words(float(link.lnb_supply.value))} V"
        position = {True: "known", False: unhomed_word(view), None: "--"}[link.homed]
        search = "--" if link.search is TvSearch.UNKNOWN else SEARCH[link.search]
        rows = (
            ("replies", lost, "text"),
            ("restarts", f"{link.restarts}{last}", "text"),
            ("link lost", f"silent {link.silences}, port gone {link.port_losses}", "text"),
            ("position", position, "warn" if link.homed is False else "text"),
            ("TV search", search.removeprefix("TV search "), "text"),
            ("coax", supply, "text"),
        )
        for y, (name, value, ink) in enumerate(rows):
            cells.put(1, y, name, "dim")
            cells.put(2 + LINK_NAME, y, elide(value, cells.width - 2 - LINK_NAME), "dim" if value == "--" else ink)


class DaysPane(Pane):
    """The days one beside the other: a sign where something happened, a bar for how far the motors turned."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Day by day"

    def draw(self, cells: Cells, view: View) -> None:
        """Write a row for each sort of event, and the dates of the first and the last day."""
        figures = figures_of(view)
        if figures is None or not figures.by_day:
            cells.put(1, 0, "--", "dim")
            return
        room = cells.width - 3 - NAME
        days = figures.by_day[-room:]
        each = max(min(room // len(days), 3), 1)
        rows = (
            ("stalls", [day.stalls for day in days], "warn"), ("restarts", [day.restarts for day in days], "text"),
            ("link lost", [day.losses for day in days], "text"),
            ("lost replies", [day.unanswered for day in days], "text"),
        )  # fmt: skip
        for y, (name, counts, ink) in enumerate(rows):
            cells.put(1, y, name, "dim")
            for number, count in enumerate(counts):
                shown = "·" if not count else str(count) if count < 10 else "▲"
                cells.put(2 + NAME + each * number, y, shown, ink if count else "faint")
        most = max((1e-9, *(day.turns for day in days)))
        cells.put(1, 4, "turns", "dim")
        for number, day in enumerate(days):
            bar = BARS[min(round(day.turns / most * (len(BARS) - 1)), len(BARS) - 1)] if day.turns else "·"
            cells.put(2 + NAME + each * number, 4, bar, "accent" if day.turns else "faint")
        first, last = f"{days[0].day:%d %b}", f"{days[-1].day:%d %b}"
        cells.put(2 + NAME, 5, first, "dim")
        end = 2 + NAME + each * len(days)
        if end - 2 - NAME > len(first) + len(last) + 1:
            cells.right(end, 5, last, "dim")

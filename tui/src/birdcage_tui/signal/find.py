"""What the dish can do by the signal alone, once a person has chosen it: find, follow, compare, or rest and listen."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG, CUTS
from birdcage.signal.drift_task import WIDTHS, DriftTask
from birdcage.signal.on_off_task import BEAMS_AWAY, OnOffTask
from birdcage.signal.peak_task import SIDE, SPACING, PeakTask
from birdcage.signal.source_path import SourcePath, sun_path
from birdcage.signal.step_track_task import StepTrackTask
from birdcage.sky.observer import Observer
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskValue

from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.choice_screen import ChoiceRow, ChoiceScreen
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

Ask = Callable[[BeginTask], object]
ACQUIRE = "acquire"
KEEP_CLEAR = "The dish moves by itself. Keep its swing clear."
SLEW_S = 30.0
"""From Enter to the first reading of a drift scan: the dish has to get there."""


def find_question(view: View) -> ChoiceScreen:
    """Return the list of what there is to choose from."""
    reach_deg = width_deg(view) * SPACING * (SIDE - 1) / 2
    rows = (
        ChoiceRow(PeakTask.kind, "Find the peak",
                  f"{SIDE * SIDE} directions, up to {reach_deg:.1f}° to each side, then to the middle."),
        ChoiceRow(StepTrackTask.kind, "Step-track …", "Stay on an inclined satellite. Its day is remembered."),
        ChoiceRow(OnOffTask.kind, "On-off …", "How much the source stands over the sky beside it."),
        ChoiceRow(DriftTask.kind, "Drift scan …", "Park ahead of the Sun, let it pass, measure the beam."),
        ChoiceRow(ACQUIRE, "Acquire a satellite …", "Search where it should be, and set north by it: Setup, step 11."),
    )  # fmt: skip
    return ChoiceScreen("By the signal", rows, KEEP_CLEAR)


def begin_find(view: View, ask: Ask) -> None:
    """Have the station find the peak around where the dish points now."""
    position = view.state.position
    if position is not None:
        values: dict[str, TaskValue] = {
            "az_deg": position.az_deg, "el_deg": position.el_deg, "patterns": patterns_here(view),
        }  # fmt: skip
        ask(BeginTask(PeakTask.kind, values | _heard(view), YOU))


def step_track_question() -> FieldsScreen:
    """Return what is asked before: under which name, how often, how long."""
    rows = (
        FieldRow("name", "", "or empty. Its way is remembered by it."),
        FieldRow("peak every, minutes", "15", "at least so often"),
        FieldRow("for, hours", "24", "then it ends, and the dish stays"),
    )
    words = "The dish finds the peak here, and stays on it with small searches. " + KEEP_CLEAR
    return FieldsScreen("Step-track", words, rows, wrong_step_track, enter="Enter begins")


def wrong_step_track(values: Values) -> str:
    """Return what is wrong with interval and length; empty where nothing is."""
    return _wrong(values[1], "Interval", "minutes", 0.5, 1440.0) or _wrong(values[2], "Length", "hours", 0.01, 240.0)


def begin_step_track(view: View, values: Values, ask: Ask) -> None:
    """Have the station stay on what is here."""
    position = view.state.position
    if position is not None:
        told: dict[str, TaskValue] = {
            "az_deg": position.az_deg, "el_deg": position.el_deg, "name": values[0].strip(),
            "every_s": _number(values[1]) * 60.0, "hours": _number(values[2]), "patterns": patterns_here(view),
        }  # fmt: skip
        ask(BeginTask(StepTrackTask.kind, told | _heard(view), YOU))


def on_off_question(view: View) -> FieldsScreen:
    """Return what is asked before: how far beside it, along which axis, how often."""
    rows = (
        FieldRow("beside it, degrees", f"{BEAMS_AWAY * width_deg(view):.0f}", "where there is only sky"),
        FieldRow("axis", "el", "el beside the arc of satellites, az for the Sun"),
        FieldRow("cycles", "3", "on it, beside it twice, on it"),
    )
    words = "The dish goes to and fro between here and the sky beside it. " + KEEP_CLEAR
    return FieldsScreen("On-off", words, rows, wrong_on_off, enter="Enter begins")


def wrong_on_off(values: Values) -> str:
    """Return what is wrong with them; empty where nothing is."""
    away, axis, cycles = values
    if axis.strip().lower() not in CUTS:
        return f"Axis is {axis.strip()!r}. Type az or el."
    return _wrong(away, "Beside it", "degrees", 0.1, 90.0) or _wrong(cycles, "Cycles", "", 2, 200)


def begin_on_off(view: View, values: Values, ask: Ask) -> None:
    """Have the station compare what is here with the sky beside it."""
    position = view.state.position
    if position is not None:
        told: dict[str, TaskValue] = {
            "path": ((view.utc.timestamp(), position.az_deg, position.el_deg),), "away_deg": _number(values[0]),
            "axis": values[1].strip().lower(), "cycles": int(_number(values[2])), "source": view.heard.id,
        }  # fmt: skip
        ask(BeginTask(OnOffTask.kind, told, YOU))


def drift_path(view: View) -> SourcePath:
    """Return the Sun's way through the beam, from a moment on. ValueError says why it can't be heard now."""
    place = view.settings.place
    if place is None:
        raise ValueError(NO_LOCATION)
    observer = Observer(place.latitude_deg, place.longitude_deg)
    begin_s = view.utc.timestamp() + SLEW_S
    rate_deg_s = sun_path(observer, begin_s, 60.0).moves_deg_s(begin_s + 30.0)
    path = sun_path(observer, begin_s, WIDTHS * width_deg(view) / rate_deg_s)
    low_deg = view.state.el_min_deg or 0.0
    if path.at((path.begin_s + path.end_s) / 2.0)[1] < low_deg or min(row[2] for row in path.rows) < 0.0:
        raise ValueError(f"The Sun is below {low_deg:.0f}° now, or soon. Try again when it is higher.")
    return path


def drift_words(path: SourcePath) -> str:
    """Say what happens, and how long it takes."""
    az_deg, el_deg = path.at((path.begin_s + path.end_s) / 2.0)
    return (
        f"The dish goes to {az_deg:.1f}°/{el_deg:.1f}°, ahead of the Sun, and rests there for "
        f"{(path.end_s - path.begin_s) / 60.0:.0f} minutes while the Sun passes. {KEEP_CLEAR}"
    )


def begin_drift(view: View, path: SourcePath, ask: Ask) -> None:
    """Have the station listen while the Sun passes."""
    ask(BeginTask(DriftTask.kind, {"path": tuple(path.rows)} | _heard(view), YOU))


def width_deg(view: View) -> float:
    """Return how wide the beam is, or is assumed to be."""
    return ASSUMED_WIDTH_DEG if view.state.beam is None else view.state.beam.mean_deg


def patterns_here(view: View) -> tuple[tuple[float, ...], ...]:
    """Return which satellites of the arc may be heard beside one another here; none of them without a place."""
    from birdcage.signal.slots_heard import patterns_near, seen_from

    place, position = view.settings.place, view.state.position
    if place is None or position is None:
        return ((),)
    slots = seen_from(Observer(place.latitude_deg, place.longitude_deg), "radio")
    return patterns_near(position.az_deg, position.el_deg, slots, width_deg(view))


def _heard(view: View) -> dict[str, TaskValue]:
    return {"width_deg": 0.0 if view.state.beam is None else view.state.beam.mean_deg, "source": view.heard.id}


def _number(text: str) -> float:
    return float(text.strip().removesuffix("°").replace(",", "."))


def _wrong(text: str, what: str, unit: str, low: float, high: float) -> str:
    try:
        number = _number(text)
    except ValueError:
        number = float("nan")
    if low <= number <= high:
        return ""
    return f"{what} is {text.strip() or 'empty'!r}. Type {low:g} to {high:g}{' ' if unit else ''}{unit}."

"""Has the dish sweep an axis, once a person has said which, how far and in which steps."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.signal.sweep_task import MOST_POINTS, SweepTask
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskValue

from birdcage_tui.shown.view import YOU, View
from birdcage_tui.signal.find import patterns_here
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

SPAN_DEG, STEP_DEG = 20.0, 1.0
WORDS = "The dish goes along the axis, through where it points now, and listens at each step. Keep its swing clear."


def sweep_question() -> FieldsScreen:
    """Return what is asked before: axis, span and step."""
    rows = (
        FieldRow("axis", "az", "az or el"),
        FieldRow("span, degrees", f"{SPAN_DEG:g}", "from one end to the other"),
        FieldRow("step, degrees", f"{STEP_DEG:g}", "from one direction to the next"),
    )
    return FieldsScreen("Sweep", WORDS, rows, wrong_sweep, enter="Enter sweeps")


def wrong_sweep(values: Values) -> str:
    """Return what is wrong with axis, span and step; empty for a sweep that can be made."""
    axis, *numbers = (value.strip().lower() for value in values)
    if axis not in ("az", "el"):
        return f"Axis is {axis!r}. Type az or el."
    try:
        span_deg, step_deg = (float(number.removesuffix("°")) for number in numbers)
    except ValueError:
        return "Span and step are degrees. Type 20 and 1."
    if not 0.1 <= span_deg <= 360.0:
        return f"Span {span_deg:g}° is out of range. Type 0.1 to 360."
    if not 0.05 <= step_deg <= span_deg / 2.0:
        return f"Step {step_deg:g}° is out of range. Type 0.05 to {span_deg / 2.0:g}."
    if span_deg / step_deg >= MOST_POINTS:
        return f"That is more than {MOST_POINTS} directions. Type a longer step."
    return ""


def begin_sweep(view: View, values: Values, ask: Callable[[BeginTask], object]) -> None:
    """Ask the station for it, through where the dish points now."""
    position = view.state.position
    if position is None:
        return
    axis, *numbers = (value.strip().lower() for value in values)
    span_deg, step_deg = (float(number.removesuffix("°")) for number in numbers)
    told: dict[str, TaskValue] = {
        "axis": axis, "az_deg": position.az_deg, "el_deg": position.el_deg, "span_deg": span_deg,
        "step_deg": step_deg, "width_deg": 0.0 if view.state.beam is None else view.state.beam.mean_deg,
        "patterns": patterns_here(view), "source": view.heard.id,
    }  # fmt: skip
    ask(BeginTask(SweepTask.kind, told, YOU))

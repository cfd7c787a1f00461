"""Has the dish sweep an axis, once a person has said which, how far and in which steps."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.signal.firmware_sweep_task import MOST_TRANSPONDERS, FirmwareSweepTask
from birdcage.signal.sweep_task import MOST_POINTS, SweepTask
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskValue

from birdcage_tui.shown.view import YOU, View
from birdcage_tui.signal.find import patterns_here
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

SPAN_DEG, STEP_DEG = 20.0, 1.0
DASH = "—"
WORDS = "The dish goes along the axis, through where it points now, and listens at each step. Keep its swing clear."
BY_FIRMWARE = (
    "The dish sweeps by itself. STOP sends it a key then, but it may go on to its end. Keep its span free on both "
    "sides of where it begins."
)


def sweep_question(view: View) -> FieldsScreen:
    """Return what is asked before: axis, span and step, and who sweeps."""
    why = no_firmware_sweep(view)
    by = FieldRow("by", "steps", "steps or firmware") if not why else FieldRow("by", f"steps: {why}", is_off=True)
    rows = (
        FieldRow("axis", "az", "az or el"),
        FieldRow("span, degrees", f"{SPAN_DEG:g}", "from one end to the other"),
        FieldRow("step, degrees", f"{STEP_DEG:g}", "from one direction to the next"),
        by,
        FieldRow("transponders", "1" if not why else DASH, "by firmware: how many in each direction", is_off=bool(why)),
    )
    return FieldsScreen("Sweep", WORDS, rows, wrong_sweep, read=_told, enter="Enter sweeps")


def no_firmware_sweep(view: View) -> str:
    """Return why the firmware can't sweep here, in a few words; empty where it can."""
    dish = view.state.dish
    if dish is None or dish.sweep is None:
        return f"the {'dish' if dish is None else dish.name} has no sweep of its own"
    return "" if view.heard.of_dish else "the firmware hears by the dish's own tuner only"


def _told(values: Values) -> str:
    return BY_FIRMWARE if _is_by_firmware(values) else ""


def _is_by_firmware(values: Values) -> bool:
    return values[3:4] != () and values[3].strip().lower() == "firmware"


def wrong_sweep(values: Values) -> str:
    """Return what is wrong with axis, span, step, who sweeps and transponders; empty for a sweep that can be made."""
    axis, *numbers = (value.strip().lower() for value in values[:3])
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
    return _wrong_by(*values[3:]) if len(values) > 3 else ""


def _wrong_by(by: str, transponders: str) -> str:
    by = by.partition(":")[0].strip().lower()
    if by not in ("steps", "firmware"):
        return f"By is {by!r}. Type steps or firmware."
    if by == "firmware" and transponders.strip() not in map(str, range(1, MOST_TRANSPONDERS + 1)):
        return f"Transponders are {transponders.strip()!r}. Type 1 to {MOST_TRANSPONDERS}."
    return ""


def begin_sweep(view: View, values: Values, ask: Callable[[BeginTask], object]) -> None:
    """Ask the station for it, through where the dish points now."""
    position = view.state.position
    if position is None:
        return
    axis, *numbers = (value.strip().lower() for value in values[:3])
    span_deg, step_deg = (float(number.removesuffix("°")) for number in numbers)
    told: dict[str, TaskValue] = {
        "axis": axis, "az_deg": position.az_deg, "el_deg": position.el_deg, "span_deg": span_deg,
        "step_deg": step_deg, "width_deg": 0.0 if view.state.beam is None else view.state.beam.mean_deg,
        "patterns": patterns_here(view), "source": view.heard.id,
    }  # fmt: skip
    if _is_by_firmware(values):
        ask(BeginTask(FirmwareSweepTask.kind, {**told, "transponders": int(values[4])}, YOU))
    else:
        ask(BeginTask(SweepTask.kind, told, YOU))

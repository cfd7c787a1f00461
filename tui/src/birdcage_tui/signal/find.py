"""Has the dish find the peak by itself, once a person has agreed to that."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
from birdcage.signal.peak_task import SIDE, SPACING, PeakTask
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskValue

from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.dialogs import QuestionScreen

DIRECTIONS = SIDE * SIDE


def find_question(view: View) -> QuestionScreen:
    """Return what is asked before: how far the dish goes, and what ends it."""
    reach_deg = _width_deg(view) * SPACING * (SIDE - 1) / 2
    words = (
        f"The dish goes through {DIRECTIONS} directions, up to {reach_deg:.1f}° to each side of where it points now, "
        "and ends in the middle of the satellite. That takes half a minute or more. Keep its swing clear."
    )
    return QuestionScreen("Find the peak", words, "area is clear: find it")


def begin_find(view: View, ask: Callable[[BeginTask], object]) -> None:
    """Ask the station for it, around where the dish points now."""
    position = view.state.position
    if position is None:
        return
    width_deg = 0.0 if view.state.beam is None else view.state.beam.mean_deg
    values: dict[str, TaskValue] = {
        "az_deg": position.az_deg, "el_deg": position.el_deg, "width_deg": width_deg, "patterns": patterns_here(view),
        "source": view.heard.id,
    }  # fmt: skip
    ask(BeginTask(PeakTask.kind, values, YOU))


def _width_deg(view: View) -> float:
    return ASSUMED_WIDTH_DEG if view.state.beam is None else view.state.beam.mean_deg


def patterns_here(view: View) -> tuple[tuple[float, ...], ...]:
    """Return which satellites of the arc may be heard beside one another here; none of them without a place."""
    from birdcage.signal.slots_heard import patterns_near, seen_from
    from birdcage.sky.observer import Observer

    place, position = view.settings.place, view.state.position
    if place is None or position is None:
        return ((),)
    slots = seen_from(Observer(place.latitude_deg, place.longitude_deg), "radio")
    return patterns_near(position.az_deg, position.el_deg, slots, _width_deg(view))

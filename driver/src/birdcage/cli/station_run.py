"""A station without a face: it runs until a signal ends it, and tells what happens."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NoReturn

from birdcage.cli.exits import EndedBySignal
from birdcage.cli.say import say, tell_json
from birdcage.cli.station_command import SLICE_S
from birdcage.station.events import (
    Event,
    FaultAcknowledged,
    FaultRaised,
    HeldChanged,
    LeaseChanged,
    LinkChanged,
    StopConfirmed,
)
from birdcage.station.json_form import to_json
from birdcage.station.narration import words_of

if TYPE_CHECKING:
    from birdcage.cli.station_command import StationCommand

TOLD = (LinkChanged, HeldChanged, LeaseChanged, FaultRaised, FaultAcknowledged, StopConfirmed)
"""What a person is told on stderr. A stream of targets makes too many moves to name each."""


def run_station(
    dishes: Sequence[StationCommand], *, as_json: bool = False, each_time: Callable[[], None] = lambda: None
) -> NoReturn:
    """Run until a signal ends it, `EndedBySignal` then, or what ended a station's thread.

    A lost link, or a dish that is not there yet, ends nothing: its station looks for it. `as_json` prints every event
    in the form of docs/events.md, to the last one; of several dishes with the port of each. `each_time` is called
    about ten times a second; what it raises ends the run.
    """
    several = len(dishes) > 1
    for dish in dishes if as_json else ():
        dish.hear_all = partial(_tell_event, dish, several)
    heard = [(dish, _Told(dish if several else None)) for dish in dishes]
    while True:
        for dish, told in heard:
            if dish.look(told.hear, SLICE_S / len(dishes)):
                while dish.look(told.hear, 0.0):
                    pass
        each_time()


class _Told:
    """Tells a person what happens, and nothing twice; with the port where there are several dishes."""

    def __init__(self, dish: StationCommand | None) -> None:
        self._dish, self._last = dish, ""

    def hear(self, event: Event) -> None:
        """Take an event."""
        if not isinstance(event, TOLD):
            return
        words = words_of(event)
        if words != self._last:
            whose = "" if self._dish is None else f"{self._dish.state.port}: "
            say(f"{event.utc:%H:%M:%S}Z  {whose}{words}")
        self._last = words


def _tell_event(dish: StationCommand, several: bool, event: Event) -> None:
    whose = {"port": dish.state.port} if several else {}
    tell_while_read(dish, {**whose, **to_json(event)})


def tell_while_read(dish: StationCommand, value: Mapping[str, object]) -> None:
    """Print a line of JSON. Where whoever read them is gone, the command ends as by a signal. Any thread."""
    try:
        tell_json(value)
    except EndedBySignal as ended:
        dish.hear_all = None
        if dish.number is None:
            dish.end_wait(ended.number)

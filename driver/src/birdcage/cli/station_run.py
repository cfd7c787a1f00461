"""A station without a face: it runs until a signal ends it, and tells what happens."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NoReturn

from birdcage.cli.exits import EndedBySignal
from birdcage.cli.say import say, tell_json
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
    dish: StationCommand, *, as_json: bool = False, each_time: Callable[[], None] = lambda: None
) -> NoReturn:
    """Run until a signal ends it, `EndedBySignal` then, or what ended the station's thread.

    A lost link, or a dish that is not there yet, ends nothing: the station looks for it. `as_json` prints every event
    in the form of docs/events.md, to the last one. `each_time` is called about ten times a second; what it raises ends
    the run.
    """
    last = ""

    def hear(event: Event) -> None:
        nonlocal last
        if isinstance(event, TOLD):
            words = words_of(event)
            if words != last:
                say(f"{event.utc:%H:%M:%S}Z  {words}")
            last = words

    if as_json:
        dish.hear_all = lambda event: tell_while_read(dish, to_json(event))
    while True:
        dish.look(hear)
        each_time()


def tell_while_read(dish: StationCommand, value: Mapping[str, object]) -> None:
    """Print a line of JSON. Where whoever read them is gone, the command ends as by a signal. Any thread."""
    try:
        tell_json(value)
    except EndedBySignal as ended:
        dish.hear_all = None
        if dish.number is None:
            dish.end_wait(ended.number)

"""`birdcage events`."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING, Any

import click

from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.station.control_client import Owner
    from birdcage.station.control_messages import ControlRequest
    from birdcage.station.events import Event

BY = "birdcage events"


@click.command("events", epilog=exits.EPILOG)
@click.option(
    "--watch", "features", metavar="NAME", multiple=True,
    help="Also have this read about once a second: position, or a name of `birdcage features`; repeatable.",
)  # fmt: skip
@global_options()
@click.pass_context
def command(context: click.Context, features: tuple[str, ...]) -> None:
    """Print what happens to the dish, one line each, as the program that has the port tells it.

    Positions, moves, STOP, HELD, control, faults, readings. Follows the program that drives the dish, and moves
    nothing. With --json each line is one event in the form of docs/events.md. Ctrl+C ends it.
    """
    from birdcage.base.errors import NoReply
    from birdcage.cli.say import say
    from birdcage.station.control_client import NoAnswer, OwnerGone

    dish = wanted()
    try:
        owner = _owner(dish)
        if owner is None:
            say(f"No birdcage program has {dish.port}. `birdcage events` follows one that drives a dish there.")
            context.exit(exits.LINK)
        context.exit(_follow(owner, _request(features)))
    except NoAnswer as error:
        raise NoReply(f"{error}.") from error
    except OwnerGone as error:
        say(f"No more events: {error}.")
        context.exit(exits.LINK)
    except KeyboardInterrupt:
        context.exit(exits.SIGNAL + signal.SIGINT)


def _owner(dish: Wanted) -> Owner | None:
    """Return the program to follow. ConfigError where several may be meant."""
    from birdcage.base.errors import ConfigError
    from birdcage.cli.owners import owners_of

    owners = [owner for owner in owners_of(dish) if _lives(owner)]
    if len(owners) > 1:
        ports = ", ".join(owner.port for owner in owners)
        raise ConfigError(f"{len(owners)} programs drive a dish: at {ports}. Name one with --port.")
    return owners[0] if owners else None


def _lives(owner: Owner) -> bool:
    """Return whether a program still runs: `kill -9` leaves its file behind."""
    from birdcage.station.control_client import OwnerGone, call_owner
    from birdcage.station.control_messages import TellStatus

    try:
        call_owner(owner, TellStatus(), BY)
    except OwnerGone:
        return False
    return True


def _request(features: tuple[str, ...]) -> ControlRequest:
    from birdcage.station.control_messages import TellStatus
    from birdcage.station.requests import Watch

    return Watch(f"{BY} {os.getpid()}", frozenset(features)) if features else TellStatus()


def _follow(owner: Owner, request: ControlRequest) -> int:
    """Print events until there are no more, and return the exit status."""
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.station.control_client import follow_owner
    from birdcage.station.control_messages import EndOfEvents, EventsEnded

    why = ""
    with follow_owner(owner, request, BY) as events:
        say(f"Following process {owner.pid} at {owner.port}. Ctrl+C ends it.")
        for told in events:
            if told.get("type") == EventsEnded.__name__:
                why = str(told.get("why"))
                say(str(told.get("sentence")))
            elif flags().json:
                tell_json(told)
            else:
                tell(_line(told))
    return exits.OK if why == EndOfEvents.CLOSING else exits.NOT_DONE


def _line(told: dict[str, Any]) -> str:
    """Return an event for a person; one that only a newer birdcage knows by its name."""
    from birdcage.base.errors import BadMessage
    from birdcage.station.json_form import event_from_json

    try:
        event = event_from_json(told)
    except BadMessage:
        return f"{'':9}  {told.get('type')} (unknown to this birdcage)"
    return f"{event.utc:%H:%M:%S}Z  {_words_of(event)}"


def _words_of(event: Event) -> str:
    """Return an event in words; the log leaves some of them out, and `birdcage events` none."""
    from birdcage.station.events import Followed, MoveProgress, TranscriptLine
    from birdcage.station.narration import words_of

    match event:
        case MoveProgress(position=position):
            here = f"AZ {position.az_deg:.2f} EL {position.el_deg:.2f}"
            return f"under way at {here}, {event.to_go_deg:.2f}° to go, {event.left_s:.1f} s left"
        case Followed(sample=sample):
            return f"following: {sample.error_deg:.3f}° off"
        case TranscriptLine():
            return f"line {event.direction} {event.text}".rstrip()
    return " ".join((words_of(event) or type(event).__name__).split())

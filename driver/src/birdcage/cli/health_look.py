"""The present state of a dish for `birdcage health`: of the program that has its port, or of the dish itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, LinkError, NoReply, StoreError
from birdcage.cli.say import say
from birdcage.rotator.feature import Reading
from birdcage.station.state import LinkPhase, StationState

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.cli.station_command import StationCommand

COME_UP_S, READ_S = 15.0, 60.0


def look(dish: Wanted, *, asks: bool) -> StationState:
    """Return what is known of the dish now; nothing is moved. Where it does not answer, that is said.

    Without `asks`, or where no port is named and none is there, only the kind of dish is known, if that.
    """
    state = StationState()
    if asks:
        try:
            state = _reach(dish)
        except (LinkError, NoReply) as error:
            if dish.port_given:
                say(str(error))
    return state if state.dish is not None else replace(state, dish=dish.named_model)


def _reach(wanted: Wanted) -> StationState:
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.dish import DishSession
    from birdcage.cli.dish_features import see_at_rest

    with reach_dish(wanted, "birdcage health") as dish:
        try:
            dish.come_up(COME_UP_S)
        except (LinkError, NoReply) as error:
            if not wanted.port_given:
                raise
            say(str(error))
            return dish.state
        if isinstance(dish, DishSession):
            dish.survey()
            see_at_rest(dish)
        readings = dict(dish.state.readings) | _read(dish)
        return replace(dish.state, readings=readings)


def _read(dish: StationCommand) -> dict[str, Reading]:
    """Return what the rules look at, asked one by one: a dish that lacks a setting tells the others all the same."""
    from birdcage.diagnostics.health import features_for_health
    from birdcage.station.requests import Read

    told: dict[str, Reading] = {}
    for each in () if dish.state.dish is None else features_for_health(dish.state.dish):
        try:
            answer = dish.ask(Read((each,)), READ_S)
        except LinkError:
            raise
        except BirdcageError as refused:
            say(f"{each} was not read: {refused}")
            continue
        assert isinstance(answer, Mapping)
        told |= {name: reading for name, reading in answer.items() if isinstance(reading, Reading)}
    return told


def whose(dish: Wanted, state: StationState) -> tuple[str, StationState]:
    """Return under which name the history of the dish is kept, and the state with its facts, where they are known.

    Of a dish that was not reached and is not named, the one that was used last counts: a real one, if there is any.
    """
    from birdcage.diagnostics.history import list_dishes
    from birdcage.station.known import list_models
    from birdcage.station.wear import dish_key, is_demo

    if state.dish is not None and state.link.state is LinkPhase.UP:
        return dish_key(state.dish.name, demo=state.demo), state
    if state.dish is not None:
        return dish_key(state.dish.name, demo=False), state
    try:
        known = list_dishes(dish.paths.journal)
    except StoreError:
        known = []  # the history itself says so
    models = {dish_key(each.name, demo=demo): each for each in list_models() for demo in (False, True)}
    real = [each for each in known if not is_demo(each)]
    name = next(iter(real or known), "")
    return name, replace(state, dish=models.get(name))

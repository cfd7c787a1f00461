"""The features of one dish: asked of the program that has its port, or of the dish itself."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from birdcage.cli.dish import DishSession
    from birdcage.cli.options import Wanted
    from birdcage.rotator.feature import Reading
    from birdcage.station.requests import Read, Set

T = TypeVar("T")
AT_REST_S = 8.0
"""How long a dish that has just answered is watched, to see that it rests."""
TAKES_S = 150.0
"""Longer than any reading takes: a table of transponders up to a minute."""


def list_features(dish: Wanted) -> dict[str, Any]:
    """Return port, firmware and the rows of the table. ConfigError where nothing tells which firmware it is.

    LinkError for a port that has to be asked, and can't be opened.
    """
    from birdcage.base.errors import ConfigError, NoReply
    from birdcage.cli.owners import ask_owner
    from birdcage.cli.which import with_firmware
    from birdcage.station.control_messages import ListFeatures
    from birdcage.station.feature_report import feature_values
    from birdcage.station.known import list_firmwares

    answer = ask_owner(dish, ListFeatures(), "birdcage features")
    if answer is not None:
        port, told = answer
        if told["firmware"] is None:
            raise NoReply(f"The program that has {port} does not know yet which dish it is. Try again in a moment.")
        return {"port": port, "firmware": told["firmware"], "features": told["features"]}
    dish = with_firmware(dish, must_open=True)
    if not dish.firmware_given:
        raise ConfigError(f"Nothing answers at {dish.port}. Name the firmware with --firmware.")
    if (model := dish.model) is None:
        raise ConfigError(f"Firmware {dish.firmware} is unknown. This version speaks {', '.join(list_firmwares())}.")
    rows = [feature_values(each) for each in model.features.values()]
    return {"port": dish.port, "firmware": dish.firmware, "features": rows}


def read_features(dish: Wanted, ids: tuple[str, ...], *, agreed: bool = False) -> dict[str, Any]:
    """Return readings by id, as `feature_report.reading_values`, with the port.

    `agreed`: a person was told what reading does (`read_hazard`). ConfirmationNeeded where one has to be.
    """
    from birdcage.station.requests import Read

    request = Read(ids, agreed=agreed)
    return _read_by_owner(dish, request, "birdcage get") or _ask(dish, request, ids)


def set_feature(dish: Wanted, feature: str, value: bool | float | str, *, look_first: bool = False) -> dict[str, Any]:
    """Set a feature, with a person's consent, and return what was read back, as `read_features`.

    `look_first`: read it before, too, and return that as `before`, in the form of a reading; None if it was not told.
    """
    from birdcage.base.held import user_name
    from birdcage.cli.exits import EndedBySignal
    from birdcage.station.feature_report import may_be_set
    from birdcage.station.requests import Read, Set

    by, ids = f"{user_name()} (birdcage set)", (feature,)
    look = Read(ids) if look_first else None
    try:
        request = Set(feature, value, by, agreed=True)
        return _set_by_owner(dish, look, request, by) or _ask(dish, request, ids, look)
    except KeyboardInterrupt:
        ended = EndedBySignal(signal.SIGINT)
    except EndedBySignal as signalled:
        ended = signalled
    ended.add_note(may_be_set(feature))
    raise ended


def _read_by_owner(dish: Wanted, request: Read, by: str) -> dict[str, Any] | None:
    """Ask the program that has the port, menu by menu: it answers none that takes long."""
    from birdcage.base.errors import CommandRefused, NoReply
    from birdcage.cli.feature_pages import by_menu
    from birdcage.cli.owners import ask_owner
    from birdcage.rotator.feature_table import ends_reading
    from birdcage.station.control_messages import ListFeatures

    listed = ask_owner(dish, ListFeatures(), by)
    if listed is None:
        return None
    port, rows = listed[0], listed[1]["features"]
    named = [row for row in rows if row["id"] in request.features]
    unknown = tuple(each for each in request.features if each not in {row["id"] for row in named})
    parts = [unknown] if unknown else by_menu(named)
    readings: dict[str, Reading] = {}
    first: CommandRefused | NoReply | None = None
    for part in parts:
        try:
            answer = ask_owner(dish, replace(request, features=part), by)
        except (CommandRefused, NoReply) as error:
            if ends_reading(error):
                raise
            first = first or error
            continue
        if answer is None:
            return None
        readings |= answer[1]
    if first is not None and not readings:
        raise first
    return _readings(port, request.features, readings, rows)


def _set_by_owner(dish: Wanted, look: Read | None, request: Set, by: str) -> dict[str, Any] | None:
    from birdcage.cli.owners import ask_owner

    before = None if look is None else _look(lambda: ask_owner(dish, look, by))
    was = None if before is None else before[1]
    answer = ask_owner(dish, request, by)
    if answer is None:
        return None
    port, told = answer
    return _with_before(_readings(port, (request.feature,), told, ()), request.feature, was)


def _ask(wanted: Wanted, request: Read | Set, ids: tuple[str, ...], look: Read | None = None) -> dict[str, Any]:
    from birdcage.cli.dish import open_dish
    from birdcage.station.feature_report import feature_values

    with open_dish(wanted, survey=False) as dish:
        dish.come_up(15.0)
        see_at_rest(dish)
        was = None if look is None else _look(lambda: dish.ask(look, TAKES_S))
        told = dish.ask(request, TAKES_S)
        state = dish.state
    features = state.dish.features.values() if state.dish else ()
    return _with_before(
        _readings(state.port, ids, told, map(feature_values, features)),
        ids[0],
        was if isinstance(was, Mapping) else None,
    )


def _look(ask: Callable[[], T]) -> T | None:
    """Return what is asked; None where the dish does not tell it: what it was is then not known."""
    from birdcage.base.errors import CommandRefused, NoReply
    from birdcage.rotator.feature_table import ends_reading

    try:
        return ask()
    except (CommandRefused, NoReply) as error:
        if ends_reading(error):
            raise
        return None


def _with_before(told: dict[str, Any], feature: str, before: Mapping[str, Reading] | None) -> dict[str, Any]:
    from birdcage.station.feature_report import reading_values

    if before is None:
        return told
    return told | {"before": reading_values((feature,), (), before)[feature]}


def _readings(port: str, ids: tuple[str, ...], told: object, rows: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Return what `Read` or `Set` resolves with, for JSON; `rows` is the table of features."""
    from birdcage.rotator.feature import Reading
    from birdcage.station.feature_report import reading_values, told_in_lines

    readings = {ids[0]: told} if isinstance(told, Reading) else told
    assert isinstance(readings, Mapping)
    return {"port": port, "readings": reading_values(ids, told_in_lines(rows), readings)}


def see_at_rest(dish: DishSession) -> None:
    """Watch a dish that has just answered until it is seen at rest, or for some seconds: it is read only at rest."""
    from birdcage.station.requests import Watch
    from birdcage.station.state import Activity

    until = dish.now + AT_REST_S
    dish.station.submit(Watch("birdcage", frozenset({"position"}), 2.0))
    while dish.state.activity is Activity.UNKNOWN and dish.now < until:
        dish.look()

"""The features of one dish: asked of the program that has its port, or of the dish itself."""

from __future__ import annotations

import signal
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from birdcage.cli.dish import DishSession
    from birdcage.cli.options import Wanted
    from birdcage.station.requests import Read, Set

AT_REST_S = 8.0
"""How long a dish that has just answered is watched, to see that it rests."""
TAKES_S = 60.0


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
    return _ask_owner(dish, request, ids, "birdcage get") or _ask(dish, request, ids)


def set_feature(dish: Wanted, feature: str, value: bool | float | str) -> dict[str, Any]:
    """Set a feature, with a person's consent, and return what was read back, as `read_features`."""
    from birdcage.base.held import user_name
    from birdcage.cli.exits import EndedBySignal
    from birdcage.station.feature_report import may_be_set
    from birdcage.station.requests import Set

    by = f"{user_name()} (birdcage set)"
    try:
        request = Set(feature, value, by, agreed=True)
        return _ask_owner(dish, request, (feature,), by) or _ask(dish, request, (feature,))
    except KeyboardInterrupt:
        ended = EndedBySignal(signal.SIGINT)
    except EndedBySignal as signalled:
        ended = signalled
    ended.add_note(may_be_set(feature))
    raise ended


def _ask_owner(dish: Wanted, request: Read | Set, ids: tuple[str, ...], by: str) -> dict[str, Any] | None:
    from birdcage.cli.owners import ask_owner
    from birdcage.station.control_messages import ListFeatures

    answer = ask_owner(dish, request, by)
    if answer is None:
        return None
    port, told = answer
    table = ask_owner(dish, ListFeatures(), by)
    return _readings(port, ids, told, [] if table is None else table[1]["features"])


def _ask(wanted: Wanted, request: Read | Set, ids: tuple[str, ...]) -> dict[str, Any]:
    from birdcage.cli.dish import open_dish
    from birdcage.station.feature_report import feature_values

    with open_dish(wanted, survey=False) as dish:
        dish.come_up(15.0)
        see_at_rest(dish)
        told = dish.ask(request, TAKES_S)
        state = dish.state
    features = state.dish.features.values() if state.dish else ()
    return _readings(state.port, ids, told, map(feature_values, features))


def _readings(port: str, ids: tuple[str, ...], told: object, rows: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Return what `Read` or `Set` resolves with, for JSON; `rows` is the table of features."""
    from birdcage.rotator.feature import Reading
    from birdcage.station.feature_report import reading_values, told_in_lines

    readings = {ids[0]: told} if isinstance(told, Reading) else told
    assert isinstance(readings, Mapping)
    return {"port": port, "readings": reading_values(ids, told_in_lines(rows), readings)}


def see_at_rest(dish: DishSession) -> None:
    """Watch a dish that has just answered, until it is known whether it rests."""
    from birdcage.station.requests import Watch
    from birdcage.station.state import Activity

    until = dish.now + AT_REST_S
    dish.station.submit(Watch("birdcage", frozenset({"position"}), 2.0))
    while dish.state.activity is Activity.UNKNOWN and dish.now < until:
        dish.look()

"""The features of one dish: asked of the program that has its port, or of the dish itself."""

from __future__ import annotations

import signal
from collections.abc import Mapping
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
    from birdcage.station.feature_report import feature_values
    from birdcage.station.known import list_firmwares

    told = ask_owner(dish, "features", "birdcage features")
    if told is not None and told["firmware"] is None:
        raise NoReply(f"The program that has {told['port']} does not know yet which dish it is. Try again in a moment.")
    if told is not None:
        return {"port": told["port"], "firmware": told["firmware"], "features": told["features"]}
    dish = with_firmware(dish, must_open=True)
    if not dish.firmware_given:
        raise ConfigError(f"Nothing answers at {dish.port}. Name the firmware with --firmware.")
    if (model := dish.model) is None:
        raise ConfigError(f"Firmware {dish.firmware} is unknown. This version speaks {', '.join(list_firmwares())}.")
    rows = [feature_values(each) for each in model.features.values()]
    return {"port": dish.port, "firmware": dish.firmware, "features": rows}


def read_features(dish: Wanted, ids: tuple[str, ...]) -> dict[str, Any]:
    """Return readings by id, as `feature_report.reading_values`, with the port."""
    from birdcage.cli.owners import ask_owner
    from birdcage.station.requests import Read

    told = ask_owner(dish, "get", "birdcage get", ids=ids)
    return told or _ask(dish, Read(ids), ids)


def set_feature(dish: Wanted, feature: str, value: bool | float | str) -> dict[str, Any]:
    """Set a feature, with a person's consent, and return what was read back, as `read_features`."""
    from birdcage.base.held import user_name
    from birdcage.cli.app import EndedBySignal
    from birdcage.cli.owners import ask_owner
    from birdcage.station.feature_report import may_be_set
    from birdcage.station.requests import Set

    by = f"{user_name()} (birdcage set)"
    try:
        told = ask_owner(dish, "set", by, id=feature, value=value, agreed=True)
        return told or _ask(dish, Set(feature, value, by, agreed=True), (feature,))
    except KeyboardInterrupt:
        ended = EndedBySignal(signal.SIGINT)
    except EndedBySignal as signalled:
        ended = signalled
    ended.add_note(may_be_set(feature))
    raise ended


def _ask(wanted: Wanted, request: Read | Set, ids: tuple[str, ...]) -> dict[str, Any]:
    from birdcage.cli.dish import open_dish
    from birdcage.rotator.feature import Reading
    from birdcage.station.feature_report import reading_values

    with open_dish(wanted, survey=False) as dish:
        dish.come_up(15.0)
        _see_at_rest(dish)
        told = dish.ask(request, TAKES_S)
        state = dish.state
    readings = {ids[0]: told} if isinstance(told, Reading) else told
    assert isinstance(readings, Mapping)
    return {"port": state.port, "readings": reading_values(ids, state.dish.features if state.dish else {}, readings)}


def _see_at_rest(dish: DishSession) -> None:
    from birdcage.station.requests import Watch
    from birdcage.station.state import Activity

    until = dish.now + AT_REST_S
    dish.station.submit(Watch("birdcage", frozenset({"position"}), 2.0))
    while dish.state.activity is Activity.UNKNOWN and dish.now < until:
        dish.look()

"""Asking the birdcage programs that have the port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted


def ask_owner(dish: Wanted, do: str, by: str, **more: object) -> dict[str, Any] | None:
    """Ask the program that has the port; None if there is none, or it keeps silent, which is said.

    Raises what it tells went wrong.
    """
    from birdcage.cli.say import say
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner, find_owner, owners_folder
    from birdcage.station.feature_report import error_of

    owner = find_owner(owners_folder(dish.paths), dish.port)
    if owner is None:
        return None
    try:
        told = call_owner(owner, do, by, **more)
    except NoAnswer as error:
        say(f"{error}.")
        return None
    except OwnerGone:
        return None  # it has ended: the port is free to be opened
    if isinstance(told.get("error"), dict):
        raise error_of(told["error"])
    return told | {"port": owner.port}


def ring_owners(dish: Wanted, do: str, by: str) -> list[dict[str, Any]]:
    """Have the owner of the port do it, or every owner when no port is named anywhere; empty if there is none.

    NoReply where one lives and does not answer.
    """
    from birdcage.base.errors import NoReply
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner, find_owner, find_owners, owners_folder

    folder = owners_folder(dish.paths)
    one = find_owner(folder, dish.port) if dish.port_given else None
    owners = find_owners(folder) if not dish.port_given else [one] if one is not None else []
    told = []
    for owner in owners:
        try:
            told.append(call_owner(owner, do, by) | {"port": owner.port, "pid": owner.pid})
        except OwnerGone:
            continue
        except NoAnswer as error:
            raise NoReply(f"{error}: cut the power of the dish.") from error
    return told

"""Asking the birdcage programs that have the port."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.station.control_client import Owner
    from birdcage.station.control_messages import ControlRequest

_T = TypeVar("_T")


def owners_of(dish: Wanted) -> list[Owner]:
    """Return the program that has the port, or all that have one where no port is named anywhere."""
    from birdcage.station.control_client import find_owner, find_owners, owners_folder

    folder = owners_folder(dish.paths)
    if not dish.port_given:
        return find_owners(folder)
    owner = find_owner(folder, dish.port)
    return [] if owner is None else [owner]


def ask_owner(dish: Wanted, request: ControlRequest, by: str) -> tuple[str, Any] | None:
    """Ask the program that has the port; return that port and what it tells (`control_messages`).

    None if there is none, or it keeps silent, which is said. Raises what it tells went wrong.
    """
    from birdcage.cli.say import say
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner, find_owner, owners_folder

    owner = find_owner(owners_folder(dish.paths), dish.port)
    if owner is None:
        return None
    try:
        return owner.port, call_owner(owner, request, by)
    except NoAnswer as error:
        say(f"{error}.")
        return None
    except OwnerGone:
        return None  # it has ended: the port is free to be opened


def ring_owners(dish: Wanted, request: ControlRequest, by: str) -> list[dict[str, Any]]:
    """Have the owner of the port do it, or every owner when no port is named anywhere; empty if there is none.

    All of them at once: none waits for another's dish. NoReply where one lives and does not answer.
    """
    from birdcage.base.errors import NoReply
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner

    def ring(owner: Owner) -> dict[str, Any] | None:
        try:
            told: dict[str, Any] = call_owner(owner, request, by)
        except OwnerGone:
            return None
        except NoAnswer as error:
            raise NoReply(f"{error}: cut the power of the dish.") from error
        return told | {"port": owner.port, "pid": owner.pid}

    return [told for told in ring_all(owners_of(dish), ring) if told is not None]


def ring_all(owners: Sequence[Owner], ring: Callable[[Owner], _T]) -> list[_T]:
    """Ring all owners at the same time; return what each told, in their order, or raise what the first one did.

    A program that does not answer, or a dish that takes its time, keeps STOP from no other dish.
    """
    if len(owners) < 2:
        return [ring(owner) for owner in owners]
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(len(owners)) as pool:
        return list(pool.map(ring, owners))

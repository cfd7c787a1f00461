"""What the commands of one client share."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.rotctld.rotor import Rotor


@dataclass(slots=True)
class ClientContext:
    """One client's dish, and what its commands leave behind for those that follow."""

    rotor: Rotor
    has_dumped_state: bool = False
    r"""It has asked for `\dump_state`, as only clients made of Hamlib do: its `R 1` is Hamlib's reset."""
    speed: int | None = None
    """What it has named last as the speed of its moves, 1 to 100; None before it has named one."""
    closed: bool = False
    """It said `q`."""

"""What a machine tells its owner, and asks of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from birdcage.base.trouble import MotorTrouble
from birdcage.rotator.facts import Facts
from birdcage.rotator.mapping import Site
from birdcage.rotator.values import Look

if TYPE_CHECKING:
    from birdcage.base.wake import Wake


def _nothing(*_: object) -> None:
    pass


@dataclass(slots=True)
class Hooks:
    """Each may be left as it is. Those that hear something do so on the owner's thread, within an exchange."""

    dial: Callable[[str, int], Any] | None = None
    """Opens a line of bytes (a `Link`) to an address, at a rate where that is ours to set.

    None: as the machine does it. LinkError says what is wrong.
    """
    site: Site | None = None
    """Where the machine stands; None if that is not known."""
    delay_s: float = 2.0
    """The longest that an answer may be on its way."""
    permit: Callable[[], None] | None = None
    """Asked, with writing locked, just before anything that moves the machine; raises to keep it from going out."""
    wake: Wake | None = None
    """Ends waits early."""
    on_wake: Callable[[], None] | None = None
    """Called then; it may raise to abandon the exchange."""
    on_line: Callable[[str], None] = _nothing
    """Hears a line that nothing asked for, and that is none of what follows."""
    on_prompt: Callable[[], None] = _nothing
    """Hears that a machine with a console shows its prompt, in its place among the lines: it waits for a line."""
    on_look: Callable[[Look], None] = _nothing
    """Hears where the machine is, told unasked; only from within `Rotator.listen`, never while something is asked."""
    on_facts: Callable[[Facts], None] = _nothing
    """Hears what the machine itself has told that it is, within `meet` or `survey`: ranges, speeds, cable.

    What stops it stays as it was told before it was opened, and so does how it takes a second move, unless `readback`
    changes with it.
    """
    on_restart: Callable[[str], None] = _nothing
    """Hears a line that tells that the machine has just started: it has forgotten everything."""
    on_recount: Callable[[], None] = _nothing
    """Hears that the machine counts an axis from elsewhere from now on: where that points must be told anew."""
    on_trouble: Callable[[MotorTrouble], None] = _nothing
    """Hears that an axis does not turn, or did not find its reference."""
    on_busy: Callable[[], None] = _nothing
    """Hears that a move is left unanswered, perhaps because of a motor that runs."""

"""What the owner of a console's session may give it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

from birdcage.base.wake import Wake
from birdcage.console.events import LineSink


class SessionHooks(TypedDict, total=False):
    """What the owner of a session may give it. What is left out is not there; `delay_s` is `DELAY_S` then."""

    delay_s: float
    """The longest that a byte may be on its way, in each direction: every answer has that long beyond its command."""
    wake: Wake | None
    """Ends waits early, and then calls `on_wake`."""
    on_wake: Callable[[], None] | None
    """Must clear `wake`, and may raise to abandon the exchange."""
    on_line: LineSink | None
    """Hears lines that no command asked for: boot texts."""
    on_prompt: Callable[[], None] | None
    """Hears that the prompt came, in its place among those lines."""

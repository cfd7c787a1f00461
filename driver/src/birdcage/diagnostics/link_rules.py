"""What lost replies say of the line to the dish."""

from __future__ import annotations

import math
from collections.abc import Iterator
from datetime import timedelta

from birdcage.diagnostics.examination import RECENT, Examination
from birdcage.diagnostics.finding import Finding, Urgency
from birdcage.diagnostics.wording import many, share

LEAST_ASKED, LEAST_LOST = 200, 5
"""Of fewer lines, or fewer losses, a share says nothing."""
SHARE, WORSE = 0.005, 3.0
"""So large a share is too much, and so many times what it was before."""
BARE = 0.0005
"""What a sound line may lose: the least that a share is compared with."""
BAD = 0.05
"""With so many lost, moves are given up."""


def replies(seen: Examination) -> Iterator[Finding]:
    """Lost replies of the last days, against those before."""
    history = seen.history
    tomorrow = history.span[1]
    begin = tomorrow - RECENT
    now, before = history.asked(begin, tomorrow), history.asked(tomorrow - timedelta(days=2 * history.days), begin)
    if now.asked < LEAST_ASKED or now.unanswered < LEAST_LOST:
        return
    lost, lost_before = now.unanswered / now.asked, before.unanswered / before.asked if before.asked else 0.0
    known_before = before.asked >= LEAST_ASKED
    if lost < (SHARE if known_before else 2 * SHARE) or (known_before and lost < WORSE * max(lost_before, BARE)):
        return
    compared = f" Before, it was {share(before.unanswered, before.asked)}." if known_before else ""
    changed, earlier = "", before.adapter.split(", ")
    if known_before and now.adapter not in earlier and all((now.adapter, *earlier)) and ", " not in now.adapter:
        which = "the one" if len(earlier) == 1 else "one"
        changed = f" The adapter changed meanwhile. Try {which} that was there before."
    noise = f" {many(now.stray_bytes, 'byte')} of noise came with them." if now.stray_bytes else ""
    bad = lost >= BAD
    yield Finding(
        "replies", Urgency.STOPS if bad else Urgency.WILL_STOP,
        f"Replies get lost on the line: {share(now.unanswered, now.asked)} in the last {RECENT.days} days.{compared}",
        f"A plug that corrodes or loosens, a bad cable, or an adapter loses them.{noise}"
        f"{' With so many lost, moves are given up.' if bad else ''}{changed}",
        (
            "Pull each plug between dish and adapter. Clean contacts that are green or black, and plug them in again.",
            "Check the pair from the dish at the adapter: both wires tight, not swapped, shield or ground connected.",
            "On a long line, switch the adapter's termination on (120 ohms), and its failsafe bias if it has one.",
            "Then try another cable, and another adapter.",
        ),
        None, None, now.unanswered, grade=float(int(math.log2(lost / SHARE))),
    )  # fmt: skip

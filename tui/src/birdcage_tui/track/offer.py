"""A pass that was picked on F7: its plan is shown, and one row says what Enter would do with it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING, cast

from textual import events

from birdcage_tui.canvas import Cells
from birdcage_tui.cell_text import cut, fit, pad
from birdcage_tui.commands.mending import release_mend
from birdcage_tui.commands.table import can_release
from birdcage_tui.commands.track import can_follow, can_watch
from birdcage_tui.host import Host
from birdcage_tui.pane import Pane
from birdcage_tui.passes.words import clock_text
from birdcage_tui.stop_words import esc_text
from birdcage_tui.track.pursuing import plan_of, pursuit_of, shown_is_followed
from birdcage_tui.view import View

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

SAME_S = 120.0
"""As near as this two times of TCA are one pass: newer elements may have moved it."""


@dataclass(frozen=True, slots=True)
class Offer:
    """One pass of one satellite."""

    name: str
    norad_id: int
    tca_s: float
    """POSIX seconds."""

    @property
    def text(self) -> str:
        """What the desk is to choose."""
        return str(self.norad_id or self.name)

    @property
    def tca(self) -> datetime:
        """When it is highest: a time within the pass whatever its AOS is computed to be."""
        return datetime.fromtimestamp(self.tca_s, UTC)

    def is_of(self, plan: Plan | None) -> bool:
        """Return whether a plan is for this pass."""
        if plan is None or plan.aim.norad_id != self.norad_id:
            return False
        if plan.passing is None:
            return plan.day is not None and plan.day.always_up  # it has no other pass
        return abs(plan.passing.tca.timestamp() - self.tca_s) < SAME_S


def offer_words(offer: Offer, view: View) -> tuple[str, str]:
    """Return whether Enter would follow it (`accent-row`) or not (`warn-row`), and the words: what moves, where to."""
    plan, name = plan_of(view), fit(offer.name, 24).rstrip()
    if not offer.is_of(plan):
        chosen = view.track is not None and view.track.choice == offer.text
        if chosen and plan is not None and plan.passing is not None:
            return "warn-row", f"{name}: the desk plans another pass. Pick one on F7 again."
        return "bar", f"{name}: its pass is worked out …"
    if shown_is_followed(view) and pursuit_of(view) is not None:
        return "bar", f"{name} is followed already."
    first = release_mend(view)
    if first is not None:
        return "warn-row", f"{first.sentence}. Enter again follows {name}."
    if (reason := can_follow(view)) is not None:
        if view.link_up and view.state.homed is False and can_watch(view) is None:  # why stands above
            dish = view.state.dish
            by_itself = dish is not None and dish.homing_s is None
            how = "switch the dish off and on, and it homes by itself" if by_itself else "home the dish first (H)"
            return "warn-row", f"{name}: {how}."
        return "warn-row", f"{name}: {reason}"
    assert plan is not None, "it is of this pass"
    t_s = view.utc.timestamp()
    leg = next((each for each in plan.legs if each.end_s > t_s), None)
    if leg is None:
        if plan.day is not None and plan.day.standing:
            return "warn-row", f"{name}: {plan.day.standing}."
        return "warn-row", f"{name} is not in reach on this pass: nothing to follow."
    if pursuit_of(view) is not None:
        name += " instead"
    az_deg, el_deg = plan.sky.at(max(leg.start_s, t_s))
    when = "now" if leg.start_s <= t_s else f"by {clock_text(leg.start_s)}"
    return "accent-row", f"Enter follows {name}: the dish goes to {az_deg % 360.0:.0f}°/{el_deg:.0f}° {when}."


class OfferLine(Pane, can_focus=True):
    """One row. As long as it has the focus, Enter follows what it names; Esc closes it."""

    scope = "offer"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.offer: Offer | None = None

    def draw(self, cells: Cells, view: View) -> None:
        """Write what Enter would do."""
        if self.offer is None:
            return
        ink, words = offer_words(self.offer, view)
        closes = f"  {esc_text(view, closes='closes')} "
        room = cells.width - len(closes)
        cells.put(0, 0, pad(cut(f" ▶ {words}", room), room) + closes, ink)
        self.heat(0, 0, cells.width, "offer-follow")

    def do(self, command: str) -> bool:
        """Follow it: once its plan is seen, and nothing is held."""
        if command != "offer-follow" or self.offer is None:
            return False
        host = cast(Host, self.app)
        view = host.view()
        if can_release(view) is None:
            host.action_command("release")
        elif not self.offer.is_of(plan_of(view)):
            host.say("Its pass is still worked out: Enter again.")
        else:
            host.action_command("track-follow")
        return True

    def on_key(self, event: events.Key) -> None:
        """Esc closes it (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            self.screen.set_focus(None)
            cast(Host, self.app).paint()

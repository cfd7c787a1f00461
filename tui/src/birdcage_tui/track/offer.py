"""What a letter offers to do with the dish: its plan is shown, one row says what would move, and Enter does it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, cast

from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import ReleaseLease
from textual import events

from birdcage_tui.commands.mending import release_mend
from birdcage_tui.commands.track import can_autotrack, can_follow, can_watch
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, fit, pad
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.offer import Offer
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.pursuit import plan_of, pursuit_of, shown_is_followed, target_place
from birdcage_tui.shown.stop_words import esc_text
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

ENDS_HERE = "Following ends with this terminal. `birdcage station run` goes on without one."
BROKEN_OFF = (Phase.YIELDED, Phase.INTERRUPTED)
"""Phases in which a pursuit can be taken up again."""


def offer_words(offer: Offer, view: View) -> tuple[str, str]:
    """Return whether Enter would follow it (`accent-row`) or not (`warn-row`), and the words: what moves, where to."""
    plan, name = plan_of(view), fit(offer.name, 24).rstrip()
    if not offer.is_of(plan):
        chosen = view.track is not None and view.track.choice == offer.text
        if chosen and plan is not None and plan.passing is not None:
            return "warn-row", f"{name}: the desk plans another pass. Pick one on F7 again."
        return "bar", f"{name}: computing the pass …"
    return _follow_words(name, plan, view)


def deed_words(deed: str, view: View) -> tuple[str, str]:
    """Return the same of a command of Track: to follow the chosen target, to aim at it once, or to start autotrack."""
    desk = view.track
    plan = None if desk is None else desk.plan
    name = fit((desk.choice if desk is not None else "") or "" if plan is None else plan.aim.name, 24).rstrip()
    if deed == "track-follow":
        return _follow_words(name, plan, view)
    if (reason := (can_autotrack if deed == "track-autotrack" else can_follow)(view)) is not None:
        return "warn-row", reason
    if deed == "track-autotrack":
        kept = [] if desk is None else [one for one in desk.schedule if one.kept and one.reach_end > view.utc]
        first = f": first {kept[0].name}, {_when(kept[0].reach_start.timestamp(), view)}" if kept else ""
        return "accent-row", f"Enter starts autotrack{first}."
    place = target_place(view)
    if place is None and desk is not None and desk.look is not None:
        place = desk.look.az_deg, desk.look.el_deg
    if place is not None and place[1] < 0.0:
        return "warn-row", f"{name} is below the horizon now."
    where = "" if place is None else f": the dish goes to {place[0]:.0f}°/{place[1]:.0f}°"
    return "accent-row", f"Enter points once at {name}{where}."


def _when(at_s: float, view: View) -> str:
    return "now" if at_s <= view.utc.timestamp() else f"by {clock_text(at_s)}"


def _follow_words(name: str, plan: Plan | None, view: View) -> tuple[str, str]:
    pursuit = pursuit_of(view.state)
    if pursuit is not None and shown_is_followed(view) and pursuit.phase not in BROKEN_OFF:
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
    if plan is None:
        return "accent-row", f"Enter follows {name}: computing the pass …"
    t_s = view.utc.timestamp()
    leg = next((each for each in plan.legs if each.end_s > t_s), None)
    if leg is None:
        if plan.day is not None and plan.day.standing:
            return "warn-row", f"{name}: {plan.day.standing}."
        lies = "out of reach" if plan.passing is None else "not in reach on this pass"
        return "warn-row", f"{name} is {lies}: nothing to follow."
    if pursuit is not None:
        name += " again" if shown_is_followed(view) else " instead"
    az_deg, el_deg = plan.sky.at(max(leg.start_s, t_s))
    where = f"{az_deg % 360.0:.0f}°/{el_deg:.0f}°"
    return "accent-row", f"Enter follows {name}: the dish goes to {where} {_when(leg.start_s, view)}."


def carry_out(deed: str, host: AppHost) -> None:
    """Ask the desk for what was offered."""
    source = host.track.source
    if source is None:
        return
    if host.view().state.holder == YOU:
        # What you have taken by hand is given back to the tracker first.
        host.ask(ReleaseLease(YOU))
    match deed:
        case "track-autotrack":
            source.set_autotrack(True)
        case "track-aim":
            source.aim_once()
        case _:
            source.follow()


class OfferLine(Pane, can_focus=True):
    """One row. As long as it has the focus, Enter does what it says; Backspace, at rest also Esc, closes it."""

    def __init__(self, done: Callable[[], object], *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._done = done
        self.deed = "track-follow"
        """The command of Track that Enter carries out."""
        self.offer: Offer | None = None
        """The pass that was picked elsewhere; None: what is chosen on the tab."""

    @property
    def scope(self) -> str:
        """What its command has in `where`."""
        return self.deed.replace("track", "offer", 1)

    def draw(self, cells: Cells, view: View) -> None:
        """Write what Enter would do."""
        ink, words = self.words(view)
        closes = f"  {esc_text(view, closes='closes', other='Backspace closes')} "
        room = cells.width - len(closes)
        cells.put(0, 0, pad(cut(f" ▶ {words}", room), room) + closes, ink)
        self.heat(0, 0, cells.width, self.scope)

    def words(self, view: View) -> tuple[str, str]:
        """Return ink and words of what Enter would do."""
        return deed_words(self.deed, view) if self.offer is None else offer_words(self.offer, view)

    def do(self, command: str) -> bool:
        """Do it: once its plan is seen, and nothing is held."""
        if command != self.scope:
            return False
        host = cast(AppHost, self.app)
        view = host.view()
        if can_release(view) is None:
            host.action_command("release")
        elif self.offer is not None and not self.offer.is_of(plan_of(view)):
            host.say("Still computing the pass. Press Enter again.")
        elif (reason := (can_autotrack if self.deed == "track-autotrack" else can_follow)(view)) is not None:
            host.say(reason)
        else:
            carry_out(self.deed, host)
            self._done()
        return True

    def on_focus(self) -> None:
        """Say once that what lasts ends with this terminal, where this app drives the dish itself."""
        host = cast(AppHost, self.app)
        view = host.view()
        if self.deed != "track-aim" and not view.via and not view.state.demo:
            host.say_once(ENDS_HERE)

    def on_key(self, event: events.Key) -> None:
        """Close it by Backspace, or by Esc (with which the app has stopped the dish first, if it could move)."""
        if event.key in ("escape", "backspace"):
            event.stop()
            self.closed()
            cast(AppHost, self.app).paint()

    def closed(self) -> None:
        """Give the focus away, after Esc."""
        self.screen.set_focus(None)

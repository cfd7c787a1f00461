"""The maps that are kept, the newest first: to look at one."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.skymap.map_file import MapHead
from birdcage.skymap.plan import MapFrame

from birdcage_tui.widgets.choice_screen import ChoiceRow, ChoiceScreen

WORDS = "Enter shows one. u on F3 then goes on with one that is unfinished."


def maps_question(heads: Sequence[MapHead], shown: str, under_way: str) -> ChoiceScreen:
    """Return the list; `shown` and `under_way` are the keys of those that are."""
    return ChoiceScreen("Maps of the sky", [_row(each, shown, under_way) for each in heads], WORDS)


def title_of(head: MapHead) -> str:
    """Return what it is a map of."""
    plan = head.plan
    if plan.frame is MapFrame.TARGET:
        return f"around {head.about.get('target') or 'a moving target'}"
    return f"az {plan.x_low_deg:g}:{plan.x_high_deg:g} el {plan.y_low_deg:g}:{plan.y_high_deg:g}"


def is_whole(head: MapHead) -> bool:
    """Return whether nothing of it is to be heard any more."""
    return head.ended is not None or head.heard >= head.plan.cells


def _row(head: MapHead, shown: str, under_way: str) -> ChoiceRow:
    demo = "DEMO  " if head.demo else ""
    first = f"{head.number:>3}  {head.begun:%Y-%m-%d %H:%M}Z  {demo}{title_of(head)}, every {head.plan.step_deg:g}°"
    state = "running" if head.key == under_way else "finished" if is_whole(head) else "unfinished"
    count = f"{head.heard}" if is_whole(head) else f"{head.heard} of {head.plan.cells}"
    span = "" if head.low is None or head.high is None else f", {head.low:.4g} to {head.high:.4g} {head.unit}"
    return ChoiceRow(head.key, first, f"     {state}, {count} directions{span}, {head.source}", head.key == shown)

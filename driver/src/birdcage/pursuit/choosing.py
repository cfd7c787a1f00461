"""From a target to a choice, and what the catalogue says of a choice later."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.pursuit.chosen_target import ChosenTarget
from birdcage.pursuit.frequency import sent_by

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.config import Settings
    from birdcage.pursuit.finder import Finder
    from birdcage.sky.targets import Target


def choice_of(text: str, target: Target, finder: Finder | None) -> ChosenTarget:
    """Return a choice without passes and plan. With a `finder` a satellite is of its catalogue."""
    from birdcage.sky.targets.model import Satellite

    if not isinstance(target, Satellite):
        return ChosenTarget(text, target)
    entry = None if finder is None else finder.entry(target.elements.norad_id)
    return ChosenTarget(
        text, Satellite(target.elements), target.elements, target.time_offset_s, of_catalogue=finder is not None,
        favourite=entry is not None and entry.favourite, priority=0 if entry is None else entry.priority,
    )  # fmt: skip


def listen_at(choice: ChosenTarget, settings: Settings, downlinks: Path) -> None:
    """Find out what it sends, and what of it is heard with the feed that is mounted."""
    if choice.elements is not None:
        choice.sent, choice.usual = sent_by(choice.elements, settings.active_feed, downlinks)


def bring_up_to_date(choice: ChosenTarget, finder: Finder) -> bool:
    """Take over what the catalogue says of it now; return whether that is anything else."""
    from birdcage.sky.targets.model import Satellite

    if choice.elements is None or not choice.of_catalogue:
        return False
    entry = finder.entry(choice.elements.norad_id)
    if entry is None:
        return False
    before = (choice.elements, choice.time_offset_s, choice.favourite, choice.priority)
    choice.target, choice.elements = Satellite(entry.elements), entry.elements
    choice.time_offset_s = entry.time_offset_s or 0.0
    choice.favourite, choice.priority = entry.favourite, entry.priority
    return before != (choice.elements, choice.time_offset_s, choice.favourite, choice.priority)

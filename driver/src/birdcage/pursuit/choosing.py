"""From a target to a choice, and what the catalogue says of a choice later."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.pursuit.chosen_target import ChosenTarget

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
    """Find out what it is not known to have ceased to send, and what of it is heard with the feed that is mounted.

    `downlinks`: the user's own table, which need not be there.
    """
    from birdcage.sky.downlinks_hearing import first_heard
    from birdcage.sky.downlinks_read import load_downlinks

    if choice.elements is None:
        return
    norad_id, name, table = choice.elements.norad_id, choice.elements.name, load_downlinks(downlinks)
    choice.sent = tuple(each for each in table.of(norad_id, name) if each.alive is not False)
    choice.usual = first_heard(table, settings.active_feed)(norad_id, name)


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

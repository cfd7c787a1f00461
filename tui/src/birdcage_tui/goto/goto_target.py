"""Targets and presets in the go-to line: what is meant, where it stands now, or why not."""

from __future__ import annotations

from birdcage.pursuit.now import Located
from birdcage.sky.targets.direction import read_direction, refuse_two_ways

from birdcage_tui.goto.goto_text import EXAMPLES, GotoAim, is_direction, is_numbers, preset_of, resolve
from birdcage_tui.shown.view import View


class StillLooking(ValueError):
    """The desk has not said yet what a text means."""


def asks_for(text: str, view: View) -> str:
    """Return what the desk is to look up: the text, unless it is a direction or a preset's whole name; else nothing."""
    preset = preset_of(text, view.presets)
    if is_direction(text) or is_numbers(text) or (preset is not None and preset[1]):
        return ""
    return " ".join(text.split())


def aim_of(text: str, view: View) -> GotoAim:
    """Return where `text` leads from where things stand now. ValueError says what to type instead.

    A direction comes first, then a preset by its whole name, then a target, then the only preset that begins so. A
    preset that begins as a target is called is ambiguous.
    """
    refuse_two_ways(text)
    if is_direction(text) or is_numbers(text) or not text.strip():
        return resolve(read_direction(text), view.state)
    found = preset_of(text, view.presets)
    preset = None if found is None else GotoAim(found[0].az_deg, found[0].el_deg, found[0].name)
    if preset is not None and found is not None and found[1]:
        return preset
    if view.track is None:
        if preset is None:
            raise ValueError(f"{text.strip()[:24]} is not a direction or preset. Type {EXAMPLES}.")
        return preset
    located = located_of(text, view)
    if located is None:
        raise StillLooking(f"Looking for {text.strip()} …")
    if preset is not None and (located.several or (located.name and not located.exact)):
        other = located.name or "one of several targets"
        raise ValueError(f"{text.strip()} matches the preset {preset.name} and {other}. Type the whole name.")
    if preset is not None and not located.name:
        return preset
    if located.az_deg is None or located.el_deg is None:
        raise ValueError(located.problem)
    name = ", ".join(filter(None, (located.name, located.silence)))
    return GotoAim(located.az_deg, located.el_deg, name, located.skew)


def located_of(text: str, view: View) -> Located | None:
    """Return what the desk has said of this text; None while it has not."""
    located = None if view.track is None else view.track.located
    return located if located is not None and located.text == " ".join(text.split()) else None

"""What the machine tells of its own health, in words: its features with a `HealthMark`."""

from __future__ import annotations

from birdcage.rotator.feature import Feature, HealthMark, Reading

from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View


def hardware_words(view: View) -> tuple[str, ...]:
    """Return it from all that there is to say to the least; a dash where the machine tells nothing of the kind.

    What is not well comes first; the age is that of the oldest reading.
    """
    told = [(mark, each, view.state.readings.get(each.id)) for mark, each in _marked(view)]
    ages = [view.now - reading.at for _mark, _each, reading in told if reading is not None]
    if not ages:
        return ("--",)
    told.sort(key=lambda each: (_is_good(each[0], each[2]) is not False, _is_good(each[0], each[2]) is True))
    whole = ", ".join(_words(*each) for each in told)
    brief = [_words(*each) for each in told if _is_good(each[0], each[2]) is not True]
    good = len(told) - len(brief)
    if good:
        brief.append("all OK" if not brief else "rest OK")
    age = age_text(max(ages))
    return f"{whole}, {age} ago", f"{', '.join(brief)}, {age} ago", f"{', '.join(brief)}, {age}"


def hardware_is_well(view: View) -> bool | None:
    """Return whether all that was told is well, as far as values tell that; None where none does."""
    judged = [_is_good(mark, view.state.readings.get(each.id)) for mark, each in _marked(view)]
    known = [each for each in judged if each is not None]
    return all(known) if known else None


def _marked(view: View) -> list[tuple[HealthMark, Feature]]:
    dish = view.state.dish
    features = () if dish is None else dish.features.values()
    return [(each.health, each) for each in features if each.health is not None]


def _is_good(mark: HealthMark, reading: Reading | None) -> bool | None:
    return None if reading is None else mark.is_good(reading.value)


def _words(mark: HealthMark, feature: Feature, reading: Reading | None) -> str:
    if reading is None:
        return f"{mark.label} --"
    value = reading.value
    shown = (
        ("on" if value else "off") if isinstance(value, bool) else value if isinstance(value, str) else f"{value:.1f}"
    )
    return f"{mark.label} {shown}{f' {feature.unit}' if feature.unit else ''}"

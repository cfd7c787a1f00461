"""Why a text names no single target, in words that say what to type or do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches

from birdcage.base.reason import Reason
from birdcage.sky.targets.names import NamedSender, plain
from birdcage.sky.targets.resolution import Resolution, Searchable, TargetCandidate

UNDERSTOOD = (
    "Type a satellite's name or number, sun, moon, a planet, polaris, cas a, 28.2E, dish 119 or QO-100. Directions "
    "are ra=5h34m,dec=+22d; gal 120,-5; az 180 el 45."
)
TOLD = 8
"""How many candidates a sentence names."""
ALIKE = 0.72
"""How alike a name must be to be offered, as `difflib` counts it."""
UPDATE = "`birdcage elements update` fetches the usual groups, `birdcage elements update active` every active one."
HIGHEST_LONGITUDE = 180


def unknown(typed: str, names: Iterable[str]) -> Resolution:
    """Nothing is called that, nor has it in its name: offer what is spelt alike."""
    if not typed:
        return Resolution(typed, reason=Reason.UNKNOWN, problem=f"No target was named. {UNDERSTOOD}")
    spelt = {plain(name): name for name in names}
    alike = [spelt[each] for each in get_close_matches(plain(typed), spelt, 3, ALIKE)]
    if alike:
        problem = f"No target is called {typed!r}. Did you mean {_or(alike)}?"
    else:
        problem = f"No target is called {typed!r}. {UNDERSTOOD}"
    return Resolution(typed, reason=Reason.UNKNOWN, problem=problem)


def ambiguous(typed: str, found: Sequence[TargetCandidate]) -> Resolution:
    """Several have it in their names."""
    more = f" and {len(found) - TOLD} more" if len(found) > TOLD else ""
    names = ", ".join(each.words for each in found[:TOLD])
    problem = f"{typed!r} fits several: {names}{more}. Type the whole name or the number."
    return Resolution(typed, reason=Reason.AMBIGUOUS, problem=problem, candidates=tuple(found))


def only_silent(typed: str, found: TargetCandidate) -> Resolution:
    """The only one that has it in its name is off the air: a person may mean another, or has to say so."""
    assert found.silence is not None, "it is silent"
    problem = (
        f"Only {found.target.name} has {typed!r} in its name. {found.silence.words(found.target.name)} "
        f"Type {found.text} to choose it all the same."
    )
    return Resolution(typed, reason=Reason.SILENT, problem=problem, candidates=(found,))


def absent(typed: str, sender: NamedSender, shelf: Searchable | None) -> Resolution:
    """It is known by that name, but there are no elements of it."""
    number = f" ({sender.norad_id})" if sender.norad_id else ""
    name = sender.name if sender.norad_id else typed  # one of a fleet is not called as the fleet is
    problem = f"{name}{number} is {_not_among(shelf)}. {UPDATE}"
    if sender.silence is not None:
        problem = f"{sender.silence.words(sender.name)} It is {_not_among(shelf)}. Run `birdcage elements update`."
    return Resolution(typed, reason=Reason.ABSENT, problem=problem)


def unnumbered(typed: str, alike: Sequence[TargetCandidate], shelf: Searchable | None) -> Resolution:
    """No satellite has that number."""
    problem = f"Number {typed} is not {_among(shelf)}. {UPDATE}"
    if int(typed) <= HIGHEST_LONGITUDE:
        problem = f"{problem} For a place on the arc type {typed}E or {typed}W, for a direction {typed} 45."
    if alike:
        problem = f"{problem} Near: {', '.join(each.words for each in alike[:3])}."
    return Resolution(typed, reason=Reason.ABSENT, problem=problem, candidates=tuple(alike))


def _not_among(shelf: Searchable | None) -> str:
    return f"not {_among(shelf)}"


def _among(shelf: Searchable | None) -> str:
    return f"among your {0 if shelf is None else len(shelf)} satellites"


def _or(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"

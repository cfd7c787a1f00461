"""What a face shows of one step of the setup, and what a person may answer."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from birdcage.base.errors import BirdcageError, MotionRefused
from birdcage.base.reason import Reason

NAMES = ("link", "dish", "search", "home", "feed", "limits", "direction", "level", "place", "north", "first")
"""The steps, in order."""


class AreaNotClear(MotionRefused):
    """Nothing that moves is taken before a person has said that the area is clear."""

    reason = Reason.AREA


class NoSuchChoice(BirdcageError):
    """What was answered is not among the choices, or what was typed can't be used; the message says what can."""

    reason = Reason.CHOICE


class Mark(Enum):
    """How far a step is."""

    TODO = "todo"
    DONE = "done"
    SKIPPED = "skipped"
    FAILED = "failed"
    """Tried, and it did not work; the evidence says why. It can be tried again."""
    LATER = "later"
    """This version has no means for it yet, and says so."""


@dataclass(frozen=True, slots=True)
class Field:
    """Something to type."""

    name: str
    label: str
    unit: str = ""
    hint: str = ""
    value: str = ""
    """What stands there to begin with."""


@dataclass(frozen=True, slots=True)
class Choice:
    """One answer. Its key is a single letter or digit, or `enter` for the one that is most often right.

    `s`, `b`, `o`, `l` and `q` are never among the keys: a face needs them for skip, back, open, list and quit.
    """

    name: str
    key: str
    label: str
    moves: bool = False
    """Whether it moves the dish: not before the person has said that the area is clear."""
    fields: tuple[Field, ...] = ()
    """What has to be typed for this answer."""
    far: bool = False
    """Whether it may turn the dish farther than one jog step: its letter alone is not enough."""


@dataclass(frozen=True, slots=True)
class StepView:
    """One step at one moment. Pure data."""

    number: int
    """1 to 11."""
    name: str
    """One of `NAMES`."""
    title: str
    mark: Mark
    evidence: str
    """One line: what is known, or why it failed; empty when nothing is."""
    words: tuple[str, ...] = ()
    """Sentences for when this is the present step: what it does, its consequence, what to look at."""
    choices: tuple[Choice, ...] = ()
    busy: str = ""
    """What is under way, in a few words; empty when nothing is. No choice is taken meanwhile."""
    page: str = ""
    """The app's page that shows more of it: `control`, `console`; empty for none."""

"""Where the source of a signal is that a person names, now and for a while."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from birdcage.base.errors import MotionRefused
from birdcage.base.reason import Reason
from birdcage.cli.named_target import find_target
from birdcage.cli.say import say
from birdcage.cli.sky_options import find_observer
from birdcage.signal.source_path import SourcePath, seen_path
from birdcage.sky.targets.model import Fixed

if TYPE_CHECKING:
    from collections.abc import Callable

    from birdcage.cli.options import Wanted
    from birdcage.sky.targets.model import Target
    from birdcage.station.state import Pointing


def named(words: tuple[str, ...], wants: Wanted) -> Target:
    """Return the target that is meant. click.UsageError with a sentence when no single one is."""
    return find_target(words, wants.paths, None, say).target


def path_from(
    target: Target, wants: Wanted, begin_s: float, length_s: float, *, whole: bool = True
) -> SourcePath:  # fmt: skip
    """Return where it is from a time on. ConfigError where no place is set; MotionRefused for one that is not up.

    `whole`: it has to be up all that time, and not at its beginning alone.
    """
    if isinstance(target, Fixed):
        return SourcePath(((begin_s, target.az_deg, target.el_deg),))
    observer = find_observer(wants.settings, None, None, None)
    path = seen_path(target, observer, wants.settings.tracking.refraction, begin_s, length_s)
    if any(row[2] < 0.0 for row in (path.rows if whole else path.rows[:1])):
        words = f"{target.name} is not above the horizon{' all that time' if whole else ' then'}. Nothing moves."
        raise MotionRefused(words, reason=Reason.BELOW_HORIZON)
    return path


def path_now(
    words: tuple[str, ...], wants: Wanted, length_s: float
) -> tuple[Target | None, Callable[[Pointing | None], SourcePath]]:
    """Return the target and its path from now on, or that it is where the dish points, where none is named."""
    if not words:
        return None, _here
    target = named(words, wants)
    path = path_from(target, wants, time.time(), length_s)
    return target, lambda _position: path


def _here(position: Pointing | None) -> SourcePath:
    assert position is not None, "it was waited for"
    return SourcePath(((time.time(), position.az_deg, position.el_deg),))

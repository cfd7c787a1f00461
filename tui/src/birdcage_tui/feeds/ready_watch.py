"""Finds out now and then what the station lacks, on a thread of its own: files are read, and a catalogue may be large.

Nothing is asked over a wire or a network. The clock is watched by `clock_watch`; a receiver is the tracker's alone, as
some serve one program at a time.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Protocol

from birdcage.base.errors import BirdcageError

from birdcage_tui.shown.unready import SETUP_STEPS

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.clock import Clock
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.ready.check import Check
    from birdcage.setup.tally import StepTally
    from birdcage.station.access import FaceSession

FIRST_S = 2.0
"""After the first frame: dish and sky come first."""
LOOK_S = 2.0
"""Between two looks at whether a file has changed."""
AGAIN_S = 600.0
"""At the latest: elements grow old by themselves."""


class ReadySource(Protocol):
    """Where the checks come from. Called on the watch's thread."""

    def fingerprint(self) -> object:
        """Return something that changes with the files; cheap."""

    def find(self) -> tuple[Check, ...]:
        """Return what is not good; may take a second."""


class KeptChecks:
    """What the files of a running app tell."""

    def __init__(self, load_again: Callable[[], Settings], paths: Paths, clock: Clock) -> None:
        self._load_again, self._paths, self._clock = load_again, paths, clock

    def fingerprint(self) -> object:
        """Return when the files that count were written."""
        catalogue = self._paths.catalogue
        files = (
            self._paths.config_file, self._paths.downlinks_file, catalogue,
            catalogue.with_name(f"{catalogue.name}-wal"),
        )  # fmt: skip
        return tuple(_written(file) for file in files)

    def find(self) -> tuple[Check, ...]:
        """Return what must be fixed or is worth a look, in order; without what a person has decided in the setup."""
        from birdcage.ready.checks import kept_checks

        settings = self._load_again()

        def decided(check: Check) -> bool:
            kept = settings.setup.kept(SETUP_STEPS[check.subject]) if check.subject in SETUP_STEPS else None
            return check.state == "look" and kept is not None and (kept.done or kept.skipped)

        found = kept_checks(self._paths, settings, self._clock.utc())
        return tuple(check for check in found if check.state != "good" and not decided(check))


class KeptSteps:
    """How many steps of the setup are done, by the file and the dish."""

    def __init__(self, session: FaceSession, load_again: Callable[[], Settings], paths: Paths) -> None:
        self._session, self._load_again, self._paths = session, load_again, paths
        self._read: tuple[object, Settings] | None = None

    def count(self) -> StepTally:
        """Count them now; the file is read where it has changed. BirdcageError where it can't be read."""
        from birdcage.setup.tally import count_steps

        written = _written(self._paths.config_file)
        if self._read is None or self._read[0] != written:
            self._read = written, self._load_again()
        return count_steps(self._session, self._read[1], self._paths)


def _written(file: Path) -> tuple[int, int] | None:
    try:
        found = file.stat()
    except OSError:
        return None
    # A reader makes an empty write-ahead log, and takes it away again.
    return (found.st_mtime_ns, found.st_size) if found.st_size else None


class ReadyWatch:
    """`now` is what was found last, `steps` what is done of the setup; None before, and where it can't be told."""

    def __init__(
        self, source: ReadySource | None, soon: Callable[[Callable[[], None]], object], changed: Callable[[], object],
        count: Callable[[], StepTally] | None = None,
    ) -> None:  # fmt: skip
        self._source, self._soon, self._changed, self._count = source, soon, changed, count
        self._closed = threading.Event()
        self.now: tuple[Check, ...] | None = None
        self.steps: StepTally | None = None

    def begin(self) -> None:
        """Begin to look; after the first frame."""
        if self._source is not None or self._count is not None:
            threading.Thread(target=self._work, name="ready-check", daemon=True).start()

    def close(self) -> None:
        """Look no more. A look that is under way ends by itself, unheard."""
        self._closed.set()

    def _work(self) -> None:
        source, wait_s, left_s, before = self._source, FIRST_S, 0.0, None
        while not self._closed.wait(wait_s):
            left_s, wait_s = left_s - wait_s, LOOK_S
            self.tally()
            seen = None if source is None else source.fingerprint()
            if source is None or (seen == before and left_s > 0):
                continue
            before, left_s = seen, AGAIN_S
            try:
                found: tuple[Check, ...] | None = source.find()
            except (BirdcageError, OSError):
                found = None  # what is not known is no finding
            if not self._closed.is_set():
                self._soon(partial(self.take, found))

    def tally(self) -> None:
        """Count the steps of the setup. Any thread."""
        try:
            steps = None if self._count is None else self._count()
        except (BirdcageError, OSError):
            steps = None
        if steps != self.steps and not self._closed.is_set():
            self._soon(partial(self.take_steps, steps))

    def take(self, found: tuple[Check, ...] | None) -> None:
        """Show what was found; on the app's thread."""
        if found != self.now:
            self.now = found
            self._changed()

    def take_steps(self, steps: StepTally | None) -> None:
        """Show how many steps of the setup are done; on the app's thread."""
        if steps != self.steps:
            self.steps = steps
            self._changed()

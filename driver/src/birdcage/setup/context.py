"""What the steps share: the station, the settings, the file, and the hand-over of control."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from datetime import datetime

from birdcage.base.config import KeptStep, Settings, edit, load
from birdcage.base.config.edit import Value
from birdcage.base.paths import Paths
from birdcage.setup.receiver import AskReceiver, ask_receiver
from birdcage.station.access import FaceSession
from birdcage.station.known import PortInfo, SystemFacts
from birdcage.station.requests import ApplySettings, ReleaseLease, Request
from birdcage.station.state import LinkPhase, Pointing, StationState

FRESH_S = 5.0
"""A position older than this, in seconds, is no base for a measurement."""


class SetupContext:
    """One for each `Setup`. Only for the thread that drives it."""

    def __init__(
        self, session: FaceSession, settings: Settings, paths: Paths, *, environ: Mapping[str, str] | None,
        flags: Mapping[str, object] | None, holder: str, ports: Callable[[], list[PortInfo]],
        system: Callable[[str], SystemFacts], receiver: AskReceiver = ask_receiver,
    ) -> None:  # fmt: skip
        self.station, self.clock, self.via = session.station, session.clock, session.via
        self.settings, self.paths, self.holder = settings, paths, holder
        self.ports, self.system, self.receiver = ports, system, receiver
        self._environ = os.environ if environ is None else environ
        self._flags = dict(flags or {})
        self.begin_anew = ""
        """The firmware to speak instead, once a person has said that it is another dish; empty otherwise."""
        self.completed: set[str] = set()
        """Names of steps that were done since the engine looked last."""

    @property
    def state(self) -> StationState:
        """What the station knows now."""
        return self.station.state

    @property
    def now(self) -> float:
        """Monotonic seconds."""
        return self.clock.monotonic()

    @property
    def utc(self) -> datetime:
        """The time of day."""
        return self.clock.utc()

    @property
    def stamp(self) -> str:
        """The time as the file has it."""
        return f"{self.utc:%Y-%m-%dT%H:%MZ}"

    @property
    def is_up(self) -> bool:
        """Whether the dish answers."""
        return self.state.link.state is LinkPhase.UP

    @property
    def position(self) -> Pointing | None:
        """Where the dish stands, read just now; None when that is not known or old."""
        state = self.state
        seen = state.position if state.position_lost is None and self.is_up else None
        return seen if seen is not None and self.now - seen.at <= FRESH_S else None

    @property
    def step_4(self) -> str:
        """What step 4 does to this machine: `home`, or `sync` where only a person can say where it points."""
        dish = self.state.dish
        return "sync" if dish is not None and dish.must_be_synced else "home"

    def kept(self, step: str) -> KeptStep | None:
        """Return what the file keeps of a step."""
        return self.settings.setup.kept(step)

    def write(self, changes: Mapping[str, Value]) -> None:
        """Put settings into the file and read it again. ConfigError, with nothing written, when that can't be done."""
        edit(self.paths.config_file, changes)
        for dotted in changes:
            # What a person has chosen here counts from now on, and not what was given at the start.
            self._flags.pop(dotted, None)
        self.settings = load(self.paths.config_file, self._environ, self._flags)

    def read_again(self, section: str) -> None:
        """Read the file again: what it holds of `section` counts over what was given at the start."""
        self._flags = {dotted: value for dotted, value in self._flags.items() if not dotted.startswith(section)}
        self.settings = load(self.paths.config_file, self._environ, self._flags)

    def done(self, step: str, evidence: str, changes: Mapping[str, Value] | None = None) -> None:
        """Keep a step as done, with the settings that it makes, in one writing."""
        self._keep(step, "done", evidence, changes or {})
        self.completed.add(step)

    def skipped(self, step: str) -> None:
        """Keep a step as skipped."""
        self._keep(step, "skipped", "", {})

    def begun(self, step: str, evidence: str) -> None:
        """Keep a step as half done."""
        self._keep(step, "begun", evidence, {})

    def _keep(self, step: str, word: str, evidence: str, changes: Mapping[str, Value]) -> None:
        kept = KeptStep(word, self.stamp, " ".join(evidence.split()))
        self.write({**changes, f"setup.{step}": kept.text})

    def forget(self, step: str) -> None:
        """Take a step out of the file: it has to be done again."""
        if getattr(self.settings.setup, step) is not None:
            self.write({f"setup.{step}": None})

    def overridden(self, *dotted: str) -> str:
        """Return a remark on variables that stand over what was just written; empty for none."""
        over = [key for key in dotted if self.settings.sources.get(key) == "environment"]
        return f" (but an environment variable sets {', '.join(over)})" if over else ""

    def ask(self, request: Request) -> Future[object]:
        """Ask the station."""
        return self.station.submit(request)

    def apply(self) -> Future[object]:
        """Have the station take limits, alignment and feed from the settings as they are now."""
        return self.ask(ApplySettings(self.settings, self.holder))

    def give_back(self) -> None:
        """Give control back: another page or program of the same person may need it."""
        self.ask(ReleaseLease(self.holder))

"""The eleven steps as one headless thing, which a face draws and answers. Nothing here waits for the dish."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from birdcage.base.config import Settings
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.setup.case import Cause
from birdcage.setup.context import SetupContext
from birdcage.setup.receiver import AskReceiver, ask_receiver
from birdcage.setup.step import NAMES, AreaNotClear, Choice, Mark, NoSuchChoice, StepView
from birdcage.setup.steps.base import Step
from birdcage.setup.steps.direction import DirectionStep
from birdcage.setup.steps.dish import DishStep
from birdcage.setup.steps.feed import FeedStep
from birdcage.setup.steps.first import FirstStep
from birdcage.setup.steps.home import HomeStep
from birdcage.setup.steps.level import LevelStep
from birdcage.setup.steps.limits import LimitsStep
from birdcage.setup.steps.link import LinkStep
from birdcage.setup.steps.north import NorthStep
from birdcage.setup.steps.place import PlaceStep
from birdcage.setup.steps.search import SearchStep
from birdcage.station.access import FaceSession
from birdcage.station.known import Facts, PortInfo, SystemFacts, list_ports, look_at_system
from birdcage.station.requests import Unwatch, Watch

CLEAR_QUESTION = (
    "The dish is about to move by motor, and homing turns it through its whole range. Is its area clear of people, "
    "animals and things, the cable free, and a hand near its power switch?"
)
"""To be answered with yes once a run, before anything that moves is taken."""


def clear_question(dish: Facts | None) -> str:
    """Return `CLEAR_QUESTION`, with what the papers of this dish say must keep away from it."""
    clearance = "" if dish is None else dish.handling.clearance
    return f"{CLEAR_QUESTION} {clearance}".rstrip()


STEPS: tuple[type[Step], ...] = (
    LinkStep, DishStep, SearchStep, HomeStep, FeedStep, LimitsStep, DirectionStep, LevelStep, PlaceStep, NorthStep,
    FirstStep,
)  # fmt: skip
_OPEN = (Mark.TODO, Mark.FAILED)
_NOTHING: Mapping[str, str] = MappingProxyType({})


class Setup:
    """From wires to the first satellite, over a session. All calls from one thread; `tick` often.

    `settings` are as loaded, `environ` and `flags` those that they were loaded with; what is written is read again
    with them. `holder` takes control while something moves, and gives it back.
    """

    def __init__(
        self, session: FaceSession, settings: Settings, paths: Paths, *, environ: Mapping[str, str] | None = None,
        flags: Mapping[str, object] | None = None, holder: str = "setup",
        ports: Callable[[], list[PortInfo]] = list_ports, system: Callable[[str], SystemFacts] = look_at_system,
        receiver: AskReceiver = ask_receiver,
    ) -> None:  # fmt: skip
        self._bench = SetupContext(
            session,
            settings,
            paths,
            environ=environ,
            flags=flags,
            holder=holder,
            ports=ports,
            system=system,
            receiver=receiver,
        )
        self._steps = {step.name: step(self._bench) for step in STEPS}
        self._clear = False
        self._touched = False
        self._seen_up = False
        """Whether the dish has answered in this run."""
        self._bench.ask(Watch("setup", frozenset({"position"})))
        self.current = self._next_open(-1)
        """Name of the present step."""
        self._mark = self._steps[self.current].mark

    @property
    def settings(self) -> Settings:
        """The settings as they are now."""
        return self._bench.settings

    def read_place(self) -> None:
        """Read the settings again: the place was written elsewhere, and counts over what was given at the start."""
        self._bench.read_again("place.")

    def causes(self) -> tuple[Cause, ...]:
        """Return what may keep the port from answering, likeliest first; empty while the dish answers."""
        link = self._steps["link"]
        assert isinstance(link, LinkStep), "that is its name"
        return link.causes()

    def close(self) -> None:
        """Look away from the dish."""
        self._bench.ask(Unwatch("setup"))

    def steps(self) -> tuple[StepView, ...]:
        """Return all eleven steps as they are now, in order."""
        return tuple(step.view(number) for number, step in enumerate(self._steps.values(), 1))

    def step(self, name: str) -> StepView:
        """Return one step. NoSuchChoice for a name that is none."""
        step = self._known(name)
        return step.view(NAMES.index(name) + 1)

    @property
    def begin_anew(self) -> str:
        """The firmware that a person has chosen instead of the one spoken; empty while it is the right one.

        It is kept in birdcage.toml, and needs a new session and a new `Setup`: the face closes these, and goes on.
        """
        return self._bench.begin_anew

    @property
    def area_clear(self) -> bool:
        """Whether a person has said so in this run."""
        return self._clear

    def clear(self) -> None:
        """A person has answered `clear_question` with yes. It holds for this run."""
        self._clear = True

    @property
    def busy(self) -> str:
        """What is under way in any step; empty when nothing is."""
        return next((step.busy for step in self._steps.values() if step.busy), "")

    @property
    def finished(self) -> bool:
        """Whether every step is done, skipped, or for later."""
        return not any(step.mark in _OPEN for step in self._steps.values())

    def choose(self, step: str, choice: str, values: Mapping[str, str] = _NOTHING) -> None:
        """Answer a step. Returns at once; what takes time goes on in `tick`.

        NoSuchChoice for an answer that there is not, or what was typed can't be used; AreaNotClear when it moves the
        dish and `clear` was not called; other BirdcageErrors from the file or the step itself. Nothing was begun then.
        """
        if self.busy:
            raise NoSuchChoice(f"Wait: {self.busy}.", reason=Reason.BUSY)
        chosen = self._choice(self._known(step), choice)
        unknown = set(values) - {field.name for field in chosen.fields}
        if unknown:
            raise NoSuchChoice(f"Nothing to type for {', '.join(sorted(unknown))} here.")
        if chosen.moves and not self._clear:
            raise AreaNotClear(f"{chosen.label}: this moves the dish. Confirm first that its area is clear.")
        self._touched = True
        self.go(step)
        self._steps[step].choose(choice, values)
        self._advance()

    @staticmethod
    def _choice(step: Step, name: str) -> Choice:
        choices = step.choices()
        for choice in choices:
            if choice.name == name:
                return choice
        raise NoSuchChoice(
            f"{step.title}: there is no answer {name!r} now"
            + (f"; there are {', '.join(choice.name for choice in choices)}." if choices else ".")
        )

    def _known(self, name: str) -> Step:
        if name not in self._steps:
            raise NoSuchChoice(f"There is no step {name!r}; there are {', '.join(NAMES)}.")
        return self._steps[name]

    def skip(self, step: str) -> None:
        """Leave a step out, and go on. One that is done stays done."""
        chosen = self._known(step)
        if chosen.busy:
            raise NoSuchChoice(f"Wait: {chosen.busy}.", reason=Reason.BUSY)
        if chosen.mark in _OPEN:
            self._bench.skipped(step)
            chosen.failure = ""
        self._touched = True
        self._move_to(self._next_open(NAMES.index(step)))

    def back(self) -> None:
        """Go to the step before."""
        self.go(NAMES[max(0, NAMES.index(self.current) - 1)])

    def go(self, step: str) -> None:
        """Go to a step, done or not."""
        self._known(step)
        self._touched = True
        self._move_to(step)

    def _move_to(self, step: str) -> None:
        self.current, self._mark = step, self._steps[step].mark

    def tick(self) -> None:
        """Look at what was asked for and at the dish, and go on to the next step when the present one is done."""
        for step in self._steps.values():
            step.tick()
        self._seen_up = self._seen_up or self._bench.is_up
        link = self._steps["link"]
        if not self._touched and not self._awaits_power and self.current != "link" and link.mark is Mark.FAILED:
            # Resumed, and the wire is not as it was: nothing else can be done before that.
            self._move_to("link")
        self._advance()

    @property
    def _awaits_power(self) -> bool:
        """Whether the dish is silent because it was asked for: somebody switches it off and on."""
        search = self._steps["search"]
        assert isinstance(search, SearchStep), "that is its name"
        return self.current == "search" and bool(search.written) and self._seen_up

    def _advance(self) -> None:
        done, self._bench.completed = self._bench.completed, set()
        for name in done:
            self._steps[name].failure = ""
        step = self._steps[self.current]
        became = self._mark in _OPEN and step.mark is Mark.DONE
        self._mark = step.mark
        if not step.busy and (became or (self.current in done and step.mark not in _OPEN)):
            self._move_to(self._next_open(NAMES.index(self.current)))

    def _next_open(self, index: int) -> str:
        """Return the first open step after `index`, else the first open one, else the last."""
        order = (*NAMES[index + 1 :], *NAMES[: index + 1])
        return next((name for name in order if self._steps[name].mark in _OPEN), NAMES[-1])

"""Step 11: the first satellite, found by its signal."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.config.signals import OWN_TUNER
from birdcage.base.errors import BirdcageError
from birdcage.setup.context import SetupContext
from birdcage.setup.step import Choice, Field, Mark, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.steps.north import set_north
from birdcage.signal.acquire_task import AcquireTask, values_for
from birdcage.signal.acquired import Acquired, acquired
from birdcage.signal.slots_heard import SlotSeen, apart_deg, seen_from, slot_typed
from birdcage.sky.observer import Observer
from birdcage.station.events import Event, TaskChanged
from birdcage.station.requests import BeginTask, Goto
from birdcage.station.task_state import TaskPhase, TaskState

REACH_DEG = (15.0, 5.0)
"""How far north and level may be off after the steps before: to the sides, and up and down."""
MADE_FOR = "DISH"
"""The network that these dishes were sold for, whose satellites are the strongest."""
NO_TUNER = (
    'This dish has no tuner to search with. In birdcage.toml, signal = "rigctl" in [feed.{}] hears by a receiver.'
)
MOST_OFFERED = 3
"""Of the satellites that it may be; each has a digit."""


class FirstStep(Step):
    """Finds a satellite near where it should be, says which it may be, and sets north by it."""

    name = "first"
    title = "First satellite"
    page = "control"

    def __init__(self, bench: SetupContext) -> None:
        super().__init__(bench)
        self._pointed = ""
        self._found: Acquired | None = None
        self._meant: SlotSeen | None = None
        self._tasks: dict[int, TaskState] = {}
        """The last that was heard of each search, by number."""

    @property
    def mark(self) -> Mark:
        """Without a tuner, and without another source for the feed, nothing can tell that a satellite was found."""
        mark = super().mark
        return Mark.LATER if mark is Mark.TODO and not self._hears else mark

    @property
    def _hears(self) -> bool:
        dish = self.bench.state.dish
        return dish is None or dish.has_rssi or self._source != OWN_TUNER

    @property
    def _source(self) -> str:
        """The id of what the mounted feed is heard by."""
        return self.bench.settings.active_feed.signal

    @property
    def _slots(self) -> tuple[SlotSeen, ...]:
        """The slots over this place; none while that is not known."""
        place = self.bench.settings.place
        if place.latitude_deg is None or place.longitude_deg is None:
            return ()
        observer = Observer(place.latitude_deg, place.longitude_deg, place.height_m)
        return seen_from(observer, self.bench.settings.tracking.refraction)

    def _best(self) -> SlotSeen | None:
        """Return the slot that tells north best: of the dish's own network, within its limits, far from others.

        A satellite that is heard beside another is found some tenths of a degree off.
        """
        state = self.bench.state
        low = 0.0 if state.el_min_deg is None else max(0.0, state.el_min_deg)
        high = 90.0 if state.el_max_deg is None else state.el_max_deg
        within = [seen for seen in self._slots if low <= seen.el_deg <= high]
        return max(
            within, key=lambda seen: (MADE_FOR in seen.slot.networks, apart_deg(seen, self._slots), seen.el_deg),
            default=None,
        )  # fmt: skip

    def evidence(self) -> str:
        """Say what was found, or where the dish was turned, or where the likeliest one stands."""
        kept = self.bench.kept(self.name)
        if self._found is not None:
            return _place_words(self._found)
        if kept is not None and kept.done:
            return kept.evidence
        return self._pointed or self._expected()

    def _expected(self) -> str:
        """Name the slot and where it stands; empty if none does."""
        best = self._best()
        return "" if best is None else f"{_named(best)} expected at {best.az_deg:.1f} / {best.el_deg:.1f}"

    def words(self) -> tuple[str, ...]:
        """Say what is there, what the search does, and what it has found."""
        first = f"To point there, {self.bench.step_4} it (step 4) and set north (step 10)."
        missing = () if self._aligned else (first,)
        if self.bench.settings.place.latitude_deg is None:
            where: tuple[str, ...] = ("Set the location in step 9 first: directions need it.",)
        elif self._found is not None and self._meant is not None:
            where = _found_words(self._found, self._meant)
        elif self._pointed:
            where = (f"The dish {self._pointed}.",)
        elif self._best() is None:
            where = ("No well-known geostationary slot is within this dish's limits here.",)
        else:
            where = (f"{self._expected()}: strong, and far from its neighbours.",)
        if not self._hears:
            where = (*where, NO_TUNER.format(self.bench.settings.feed.active))
        elif self._found is None:
            around = f"{REACH_DEG[0]:.0f}° to the sides, and {REACH_DEG[1]:.0f}° up and down"
            where = (*where, f"The search goes there, then outwards: at most {around}. It may take some minutes.")
        return (*where, *missing, *self.trouble())

    @property
    def _aligned(self) -> bool:
        kept = self.bench.kept("north")
        return kept is not None and kept.done and self.bench.position is not None

    def choices(self) -> tuple[Choice, ...]:
        """Search, or point there, when everything that this needs is known; set north by what was found."""
        best = self._best()
        if not self._aligned or best is None:
            return self.release_choice()
        point = Choice("point", "p" if self._hears else "enter", f"Only point at {_named(best)}", moves=True)
        if not self._hears:
            return (*self.release_choice(), point)
        which = (Field("slot", "satellite", "", "its longitude, as 119W", best.slot.label.replace("°", "")),)
        offered = self._offered()
        search = Choice(
            "search", "f" if offered else "enter", "Search again" if offered else "Find it by its signal",
            moves=True, fields=which, far=True,
        )  # fmt: skip
        return (*self.release_choice(), *offered, search, point)

    def _offered(self) -> tuple[Choice, ...]:
        """Offer to set north by each of the satellites that it may be, or to leave it."""
        if self._found is None:
            return ()
        likely = enumerate(self._found.may_be[:MOST_OFFERED], 1)
        return (
            *(Choice(f"is{number}", "enter" if number == 1 else str(number), f"It is {_named(seen)}: set north by it")
              for number, seen in likely),
            Choice("keep", "k", "Leave north as it is"),
        )  # fmt: skip

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Search, point, set north, or release."""
        if choice == "release":
            self.begin(self.release(), "releasing")
        elif choice == "search":
            typed = values.get("slot", "").strip()
            best = self._best()
            meant = best if not typed else slot_typed(typed, self._slots)
            if meant is None:
                raise NoSuchChoice(f"{typed} is no satellite of the list that is up here. Give one as 119W.")
            self._found, self._meant, self._pointed = None, meant, ""
            self.begin(self._search(meant), f"turning to {_named(meant)}")
        elif choice == "keep":
            assert self._found is not None, "the choice is only there with something found"
            self.bench.done(self.name, f"{_place_words(self._found)}; north left as it was")
            self._found = None
        elif choice == "point":
            best = self._best()
            assert best is not None, "the choice is only there with a slot"
            self.begin(self._point(best), f"turning to {_named(best)}")
        else:
            assert self._found is not None, "the choice is only there with something found"
            self.begin(self._is(self._found, self._found.may_be[int(choice[2:]) - 1]), "setting north")

    def _point(self, seen: SlotSeen) -> Plan:
        yield self.bench.ask(Goto(seen.az_deg, seen.el_deg, self.bench.holder))
        self._found = None
        self._pointed = f"points at {seen.az_deg:.2f} / {seen.el_deg:.2f}, where {_named(seen)} stands"
        self.bench.completed.add(self.name)

    def _search(self, meant: SlotSeen) -> Plan:
        state, slots = self.bench.state, self._slots
        width_deg = 0.0 if state.beam is None else state.beam.mean_deg
        features = () if state.dish is None else tuple(state.dish.features)
        values = {"source": self._source, **values_for(meant, slots, REACH_DEG, width_deg, features)}
        self._tasks.clear()
        unsubscribe = self.bench.station.subscribe(self._on_task, TaskChanged)
        try:
            number = yield self.bench.ask(BeginTask(AcquireTask.kind, values, self.bench.holder))
            assert isinstance(number, int), "a task that has begun has one"
            while (task := self._tasks.get(number)) is None or task.phase is not TaskPhase.OVER:
                if task is not None and task.done:
                    self.busy = f"searching: {task.done} of at most {task.of} directions heard"
                yield None
        finally:
            unsubscribe()
        if not task.found:
            raise BirdcageError(task.why)
        position = self.bench.state.position
        assert position is not None, "it has just come to rest"
        self._found = acquired(task.found, position, slots, REACH_DEG[0])

    def _on_task(self, event: Event) -> None:
        if isinstance(event, TaskChanged) and event.task.kind == AcquireTask.kind:
            self._tasks[event.task.number] = event.task

    def _is(self, found: Acquired, seen: SlotSeen) -> Plan:
        az_deg, el_deg = found.offsets(seen, self.bench.settings.active_feed)
        yield from set_north(self.bench, az_deg, el_deg, f"by the signal of {_named(seen)}")
        self._found = None
        self.bench.done(self.name, f"{_named(seen)}: {found.heard}; north set by it")


def _named(seen: SlotSeen) -> str:
    return f"{seen.slot.name} ({seen.slot.label})"


def _place_words(found: Acquired) -> str:
    return f"found at {found.az_deg:.2f} / {found.el_deg:.2f}: {found.heard}"


def _found_words(found: Acquired, meant: SlotSeen) -> tuple[str, ...]:
    """Say what was found, which satellites it may be, and what that means for north."""
    where = f"Found at {found.az_deg:.2f} / {found.el_deg:.2f} ±{found.sigma_deg:.2f}: {found.heard}."
    if not found.may_be:
        return (where, "No known satellite stands at that height: check location and level, then search again.")
    across, up = found.off(found.may_be[0])
    likeliest = f"Most likely it is {_named(found.may_be[0])}: {across:+.2f}° in azimuth, {up:+.2f}° in elevation off."
    others = ", ".join(_named(seen) for seen in found.may_be[1:MOST_OFFERED])
    also = f"By its place it may also be {others}." if others else ""
    other = "" if found.may_be[0] == meant else f"{_named(meant)} was searched for."
    return tuple(filter(None, (where, likeliest, also, other)))

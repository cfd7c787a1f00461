"""The dishes of the app: one is seen on the pages, all of them move, and STOP reaches each."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from birdcage.station.access import FaceSession
from birdcage.station.every_dish import EveryDish, do_each

from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.one_dish import DishHost, OneDish
from birdcage_tui.shown.view import View, is_moving


class Dishes:
    """One, or several with a tag each. `shown` is the one that pages, keys and questions are about."""

    def __init__(self, host: DishHost, given: Sequence[tuple[FaceSession, AppOptions]]) -> None:
        self.all = tuple(
            OneDish(host, session, settings, str(number) if len(given) > 1 else "")
            for number, (session, settings) in enumerate(given, 1)
        )
        self.shown = self.all[0]
        self._every = EveryDish(len(self.all))

    @property
    def several(self) -> bool:
        """Whether there is more than one."""
        return len(self.all) > 1

    @property
    def number(self) -> int:
        """Which one is shown, from 1."""
        return self.all.index(self.shown) + 1

    @property
    def rest(self) -> tuple[OneDish, ...]:
        """Those that are not seen on the pages, in their order from the one that is seen."""
        at = self.all.index(self.shown)
        return (*self.all[at + 1 :], *self.all[:at])

    def begin_with(self, number: int) -> None:
        """Show this one, from 1, with the first frame; before the app runs."""
        first, self.shown = self.shown, self.all[number - 1]
        self.shown.settings = self.shown.settings.like(first.settings)

    def begin(self) -> None:
        """Begin all their sessions and feeds; after the first frame."""
        for dish in self.all:
            dish.begin()
        for dish in self.rest:
            dish.hide()

    def close(self) -> None:
        """Let go of what was made for them; their sessions are closed apart."""
        self._every.close()
        for dish in self.all:
            dish.close()

    def take_next(self) -> None:
        """Have pages, keys and questions be about the next one."""
        before, after = self.shown, self.rest[0]
        # What the terminal and the person have told of this app holds for all of its dishes.
        after.settings = after.settings.like(before.settings)
        before.hide()
        self.shown = after
        after.show()

    def stop(self, by: str) -> None:
        """STOP for all: their first bytes are on their way when this returns. Any thread."""
        # All of them whichever is shown: another thread may show another one meanwhile.
        self._every.do([partial(dish.station.stop, by) for dish in self.all])

    def stop_elsewhere(self, by: str) -> None:
        """STOP for those that move and are another program's. Any thread."""
        elsewhere = [dish for dish in self.all if dish.session.via and is_moving(dish.station.state)]
        self._every.do([partial(dish.station.stop, by) for dish in elsewhere])

    def leave(self, by: str) -> None:
        """STOP whatever moves, and let nothing else begin to, for an app that ends. Any thread; waits for nothing."""
        moving = [dish for dish in self.all if is_moving(dish.station.state)]

        def stop() -> None:
            # Closing one dish may take seconds: all are barred before, also what rests just now between two motions.
            may = [dish for dish in self.all if dish.session.bar() or dish in moving]
            self._every.do([partial(dish.session.leave, by) for dish in may])

        # It waits for nothing. Told after STOP, a desk would take what is followed for ended, and not offer it again.
        do_each([*(dish.track.close for dish in self.all), stop])

    def end(self, by: str, wait_s: float) -> str:
        """Close all sessions, what moves being stopped first; return where each dish is, a line for each.

        Raises the first error once all is done; where the other dishes are is among its notes.
        """
        farewells = list[str]()

        def close(dish: OneDish) -> None:
            farewells.append(f"{dish.tag}  {dish.session.close()}".strip())

        try:
            do_each([
                partial(self.leave, by),
                *(partial(close, dish) for dish in self.all),
                *(partial(dish.track.wait, wait_s) for dish in self.all),
            ])  # fmt: skip
        except Exception as error:
            for line in farewells:
                error.add_note(line)
            raise
        return "\n".join(farewells)

    @property
    def crash(self) -> BaseException | None:
        """What ended a station's thread in this program, if something did."""
        return next((dish.session.crash for dish in self.all if dish.session.crash is not None), None)

    @property
    def may_move(self) -> bool:
        """Whether any of them moves or may move by itself. Any thread."""
        return any(dish.may_move for dish in self.all)

    def glances(self) -> tuple[View, ...]:
        """Return what the rows of the others show."""
        return tuple(dish.glance() for dish in self.rest)

    def step_tours(self, view: View) -> None:
        """Move each tour on; `view` is of the dish that is shown."""
        for dish in self.all:
            if dish is self.shown or dish.tour.running or dish.tour.says:
                dish.tour.step(view if dish is self.shown else dish.glance())

    def end_tours(self) -> None:
        """Let no demo do anything by itself any more."""
        for dish in self.all:
            dish.end_tour()

    def keep(self) -> None:
        """Tell the feeds what has become of each dish, its place and the horizon there."""
        for dish in self.all:
            dish.feeds.keep(dish.settings.place)

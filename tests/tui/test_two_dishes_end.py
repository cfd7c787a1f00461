"""STOP and the end of an app with two dishes: neither waits for the other, and neither is missed."""

from __future__ import annotations

import pytest
from birdcage_tui.shell.dishes import Dishes
from birdcage_tui.shown.view import YOU
from test_two_dishes import run, stations


class FlippingDishes(Dishes):
    """Another thread shows the other dish at every look."""

    def __init__(self, host, given):
        self.looks = 0
        super().__init__(host, given)

    @property
    def shown(self):
        self.looks += 1
        return self.all[self.looks % 2]

    @shown.setter
    def shown(self, dish):
        pass


def test_stop_reaches_both_while_another_thread_shows_the_other_dish():
    async def stop(app, _pilot):
        app.dishes.__class__ = FlippingDishes
        app.dishes.looks = 0
        app.dishes.stop(YOU)
        return [station.stops for station in stations(app)]

    assert run(stop, "idle", "idle") == [[YOU], [YOU]]


def test_at_the_end_nothing_begins_to_move_while_the_first_dish_is_closed():
    async def end(app, _pilot):
        first, second = (dish.session for dish in app.dishes.all)
        seen, close = [], first.close
        first.close = lambda: seen.append((first.barred, second.barred)) or close()
        app.dishes.end("quit", 0.0)
        return seen

    assert run(end, "idle", "idle") == [(1, 1)]


def test_a_dish_that_cannot_be_closed_keeps_the_other_from_nothing():
    async def end(app, _pilot):
        first, second = (dish.session for dish in app.dishes.all)

        def fail():
            raise OSError("the journal is full")

        first.close = app.dishes.all[0].track.close = fail
        with pytest.raises(OSError, match="the journal is full") as wrong:
            app.dishes.end("quit", 0.0)
        del first.close, app.dishes.all[0].track.close
        return [station.stops for station in stations(app)], second.closed, wrong.value.__notes__

    assert run(end, "slewing", "slewing") == ([["quit"], ["quit"]], 1, ["2  The dish's position is not known."])

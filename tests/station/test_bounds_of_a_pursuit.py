"""What limits a pursuit is worked out anew where the state differs in what it goes by, and only there."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

from birdcage.base.no_go import NoGoSector
from birdcage.station.pursuit_contexts import BOUNDED_BY, _DishNow, bounds_of
from birdcage.tracking.planning.bounds import PlanBounds

from .conftest import Bench

ASIDE = {"position", "position_lost", "readings", "speeds_lent"}
"""Read for a mount, and of no account for its bounds: where it stands, and how fast it goes."""


class Watched:
    """A state that notes what is read of it."""

    def __init__(self, state) -> None:
        self._state, self.read = state, set()

    def __getattr__(self, name):
        self.read.add(name)
        return getattr(self._state, name)


def test_all_that_bounds_are_worked_out_from_is_looked_at() -> None:
    bench = Bench().connect()
    watched = Watched(replace(bench.state, no_go_sectors=(NoGoSector(100.0, 120.0, 30.0),)))
    bounds = bounds_of(watched)
    assert isinstance(bounds, PlanBounds)
    assert watched.read - ASIDE <= set(BOUNDED_BY)


def test_speed_and_place_do_not_move_them() -> None:
    bench = Bench().connect()
    state = bench.state
    assert bounds_of(replace(state, position=None, readings={}, speeds_lent={0: 1.0, 1: 1.0})) == bounds_of(state)


def test_another_limit_counts_at_once() -> None:
    store = SimpleNamespace(state=Bench().connect().state)
    now = _DishNow(store, None)
    before = now.bounds()
    assert now.bounds() is before
    store.state = replace(store.state, el_min_deg=30.0)
    assert now.bounds().low_el_deg == 30.0
    store.state = replace(store.state, no_go_sectors=(NoGoSector(100.0, 120.0, 30.0),))
    assert len(now.bounds().keepouts) > 0

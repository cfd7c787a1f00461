"""The garbage collector: off up to the first frame, on while the app runs, and nothing of an app outlives it."""

import gc
import weakref

import pytest
import stage


@pytest.fixture
def as_at_the_start():
    """The collector as `main` leaves it to the app, and afterwards as the tests had it."""
    gc.disable()
    gc.unfreeze()
    yield
    gc.enable()


async def how_it_stands(app, _pilot):
    return weakref.ref(app), gc.isenabled(), gc.get_freeze_count()


def test_what_the_start_made_is_set_aside_while_the_app_runs_and_no_longer(as_at_the_start):
    _, collecting, frozen = stage.run(how_it_stands)
    assert collecting
    assert frozen > 10_000
    # The second app of the program, after another firmware was chosen, starts as the first did.
    assert not gc.isenabled()
    assert gc.get_freeze_count() == 0
    first, collecting, frozen = stage.run(how_it_stands)
    assert collecting
    assert frozen > 10_000
    gc.collect()
    assert first() is None


def test_an_app_in_the_process_of_somebody_else_leaves_its_collector_alone_and_does_not_outlive_itself():
    before = gc.get_freeze_count()
    app, collecting, frozen = stage.run(how_it_stands)
    assert collecting
    assert gc.isenabled()
    assert gc.get_freeze_count() <= frozen <= before
    gc.collect()
    assert app() is None

"""STOP for several dishes at once: all in the calling thread, and around one that hangs."""

from __future__ import annotations

import threading

import pytest
from birdcage.station.every_dish import EveryDish


@pytest.fixture
def every():
    every = EveryDish(2)
    yield every
    every.close()


def test_all_are_done_in_their_order_by_who_calls(every) -> None:
    done: list[tuple[str, str]] = []

    def noting(name):
        return lambda: done.append((name, threading.current_thread().name))

    every.do([noting("north"), noting("south")])
    here = threading.current_thread().name
    assert done[:2] == [("north", here), ("south", here)]


def test_one_that_hangs_does_not_keep_the_other_waiting(every) -> None:
    reached = threading.Event()
    waited: list[bool] = []
    every.do([lambda: waited.append(reached.wait(5.0)), reached.set])
    assert waited == [True], "the second dish was reached while the first one hung"


def test_one_that_fails_keeps_the_other_from_nothing(every) -> None:
    done: list[str] = []

    def fail() -> None:
        raise OSError("unplugged")

    with pytest.raises(OSError, match="unplugged"):
        every.do([fail, lambda: done.append("south")])
    assert "south" in done


def test_the_second_thread_ends(every) -> None:
    (thread,) = [each for each in threading.enumerate() if each.name == "every dish" and each is every._thread]
    every.close()
    thread.join(5.0)
    assert not thread.is_alive()


def test_one_dish_needs_no_second_thread() -> None:
    done: list[str] = []
    every = EveryDish(1)
    every.do([lambda: done.append("north")])
    assert (done, every._thread) == (["north"], None)


def test_a_deed_that_fails_beside_one_that_hangs_leaves_the_second_thread_for_the_next_time(every) -> None:
    for _ in range(2):
        failed, reached = threading.Event(), threading.Event()
        waited: list[bool] = []

        def fail(failed=failed) -> None:
            failed.set()
            raise OSError("unplugged")

        def hang(failed=failed, reached=reached, waited=waited) -> None:
            waited.append(failed.wait(5.0) and reached.wait(5.0))

        with pytest.raises(OSError, match="unplugged"):
            every.do([hang, fail, reached.set])
        assert waited == [True], "the third dish was reached while the first one hung"

"""The search for passes in a process of its own: it finds what a search in this one finds, and never stays behind."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import threading
import time
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.no_go import NoGoSector
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.observer import Observer
from birdcage.sky.pass_search_job import PassSearchJob
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.search_process import SearchFailed, SearchProcess
from birdcage.sky.watch import MOST_FAILURES, SkyWatch
from birdcage.sky.watch_source import read_catalogue

HERE = Observer(50.0, 10.0, 300.0, "here")
NOW = datetime(2026, 11, 21, 12, tzinfo=UTC)
START = NOW - timedelta(minutes=30)
LIMITS = ReachLimits(
    el_floor_deg=20.0, horizon=HorizonMask(((0.0, 30.0), (180.0, 5.0))), no_go=(NoGoSector(10, 40, 50),)
)
BOUND_S = 40.0


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "catalogue.sqlite"
    with Catalogue(path) as catalogue:
        catalogue.add(demo_orbits(NOW, HERE))
        catalogue.set_favourite(demo_orbits(NOW, HERE)[0].norad_id)
    return path


@pytest.fixture
def process(path):
    """The process, and a flag that it raises."""
    came = threading.Event()
    process = SearchProcess(path, came.set)
    process.came = came
    yield process
    process.close()


def finish(process, job, now=NOW):
    """Wait until all is found."""
    while True:
        process.came.clear()
        job.work(now)
        if job.idle:
            return job.rows(now)
        assert process.came.wait(BOUND_S)


def rows_here(path, limits, now=NOW):
    hunt = PassSearchJob(read_catalogue(path), HERE, limits, START)
    while hunt.work(now):
        pass
    return hunt.rows(now)


def test_it_finds_what_a_search_in_this_process_finds(process, path):
    job = process.begin(HERE, LIMITS, START, NOW)
    rows = finish(process, job)
    assert rows
    assert rows == rows_here(path, LIMITS)
    assert job.progress is None


def test_other_limits_count_for_every_row(process, path):
    job = process.begin(HERE, ReachLimits(), START, NOW)
    finish(process, job)
    job.set_limits(LIMITS)
    assert job.rows(NOW) == ()
    assert finish(process, job) == rows_here(path, LIMITS)


def test_another_time_is_looked_at(process, path):
    job = process.begin(HERE, ReachLimits(), START, NOW)
    finish(process, job)
    later = NOW + timedelta(hours=5)
    job.work(later)
    assert job.rows(later) == rows_here(path, ReachLimits(), later)


def test_a_search_that_was_given_up_finds_nothing_any_more(process):
    first = process.begin(HERE, ReachLimits(), START, NOW)
    second = process.begin(replace(HERE, latitude_deg=-35.0), ReachLimits(), START, NOW)
    assert finish(process, second)
    first.work(NOW)
    assert first.rows(NOW) == ()


def gone(pid):
    """Wait until a process that is not our child is gone."""
    end = time.monotonic() + BOUND_S
    while time.monotonic() < end:
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        threading.Event().wait(0.02)
    return False


def test_closing_ends_it(process):
    job = process.begin(HERE, ReachLimits(), START, NOW)
    pid = process.pid
    process.close()
    assert process.pid is None
    assert gone(pid)
    job.work(NOW)


@pytest.mark.skipif(sys.platform == "win32", reason="kill -9")
def test_it_ends_by_itself_when_its_program_is_killed(path):
    code = (
        "import sys; from pathlib import Path; from birdcage.sky.search_process import SearchProcess;"
        "process = SearchProcess(Path(sys.argv[1]), lambda: None);"
        "child = process._start();"
        "print(child.pid, flush=True); sys.stdin.read()"
    )
    program = subprocess.Popen(
        [sys.executable, "-c", code, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    pid = int(program.stdout.readline())
    program.kill()
    program.communicate()
    assert gone(pid)


def test_one_that_ends_is_told(process):
    job = process.begin(HERE, ReachLimits(), START, NOW)
    process._child.kill()
    with pytest.raises(SearchFailed):
        finish(process, job)


def test_what_goes_wrong_there_is_told_here(process):
    process.begin(HERE, ReachLimits(), START, NOW)
    job = process.begin(HERE, "no limits", START, NOW)
    with pytest.raises(SearchFailed, match="AttributeError"):
        finish(process, job)


@pytest.fixture
def watch(path):
    """A watch that searches apart, on the wall's clock but without its thread."""
    watch = SkyWatch(path, lambda now: watch.published.append(now), RealClock(), observer=HERE, apart=True)
    watch.published = []
    yield watch
    watch.close()


def settle(watch):
    """Step until the search is at its end."""
    end = time.monotonic() + BOUND_S
    while not watch.published or watch.published[-1].searching is not None or not watch.published[-1].passes:
        assert time.monotonic() < end
        until = watch.step()
        watch._clock.wait(None, until, watch._wake)
        watch._wake.clear()
    return watch.published[-1]


def test_a_watch_that_loses_its_search_begins_another_one_a_few_times(watch):
    settle(watch)
    for _ in range(MOST_FAILURES):
        pid = watch._process.pid
        watch._process._child.kill()
        watch._process._child.wait()
        watch.refresh()
        watch.published.clear()
        settle(watch)
        assert watch._process.pid not in (None, pid)
    watch._process._child.kill()
    watch._process._child.wait()
    watch.refresh()
    with pytest.raises(SearchFailed):
        watch.step()


def test_a_watch_that_searches_apart_never_loads_the_search():
    code = (
        "import sys, threading; from pathlib import Path; from birdcage.base.clock import RealClock;"
        "from birdcage.sky.watch import SkyWatch; from birdcage.sky.observer import Observer;"
        "done = threading.Event();"
        "show = lambda now: now.passes and now.searching is None and done.set();"
        "watch = SkyWatch(Path('none.sqlite'), show, RealClock(), observer=Observer(50.0, 10.0), apart=True);"
        "watch.start(); ended = done.wait(50); watch.close(1.0);"
        "print(ended, [name for name in sys.modules if name.startswith(('birdcage.sky.passes.', 'birdcage.sky.reach.'))"
        " and name not in ('birdcage.sky.passes.model',)])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=55, check=False)
    assert (done.stdout.strip(), done.stderr) == ("True []", "")


def test_rows_are_small_enough_to_be_read_between_two_looks_at_the_keys(path):
    rows = rows_here(path, LIMITS)
    assert len(pickle.dumps(rows[:4])) < 8192, "a message is four rows: reading it holds every other thread up"

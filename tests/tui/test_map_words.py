"""What the head line of a map says: exact in every state of the map and of the dish, and in the pocket view."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import map_stand_in
import pytest
import stand_in
from birdcage.station.task_state import TaskPhase
from birdcage.station.tasks.words import ended_by
from birdcage_tui.shown.map_book import MapBook, MapRead
from birdcage_tui.shown.map_words import clock_words, drift_words, state_words
from map_stand_in import KEY, task

SKY = map_stand_in.made(heard=40)


def view_of(name="idle", *tasks, **other):
    app, book = stand_in.app_in(name), MapBook()
    book.read(KEY, MapRead.of(SKY))
    view = app.view()
    return replace(view, map=book.shown, state=replace(view.state, tasks=tasks), **other)


def said(*args, **other):
    return state_words(view_of(*args, **other))[1]


@pytest.mark.parametrize(
    ("name", "ended", "words"),
    [
        ("idle", None, "unfinished, 40 of 3993. u resumes it"),
        ("idle", ended_by("you"), "paused at 40 of 3993. u resumes it"),
        ("idle", "It is 05:30 UTC. 40 of 3993 directions are heard.", "unfinished, 40 of 3993: It is 05:30 UTC. u "),
        ("idle", "Ended by anna.", "unfinished, 40 of 3993: Ended by anna. u resumes it"),
        ("held", "STOP by you. Kept.", "unfinished, 40 of 3993. Dish HELD: Enter releases it, then u resumes the map"),
        ("fault", "Azimuth stalled. Kept.", "unfinished, 40 of 3993. Dish FAULT: Enter acknowledges it first"),
    ],
)  # fmt: skip
def test_a_map_that_nothing_makes_says_why_and_what_enter_does(name, ended, words):
    assert said(name, map_ended=ended)[0].startswith(words)


@pytest.mark.parametrize("name", ["idle", "held", "fault"])
def test_every_length_of_it_counts_what_was_heard(name):
    assert all("40 of 3993" in each for each in said(name, map_ended=ended_by("you")))


@pytest.mark.parametrize(
    ("name", "why", "words"),
    [
        ("held", "", "HELD at 40 of 3993. Enter releases the dish, and the map goes on"),
        ("fault", "The dish has restarted. Home it.", "interrupted at 40 of 3993. Enter acknowledges the fault first"),
        ("held", "The link was lost. Release it.", "HELD at 40 of 3993: The link was lost. Release it"),
        ("idle", "The link was lost.", "interrupted at 40 of 3993: The link was lost"),
    ],
)
def test_an_interrupted_map_says_what_enter_does(name, why, words):
    assert said(name, task(SKY, phase=TaskPhase.INTERRUPTED, why=why))[0] == words


def test_a_running_map_says_when_it_is_whole_or_until_when_it_goes_on():
    now = view_of().utc
    soon, late = (now + timedelta(minutes=each) for each in (10, 90))
    assert f"20 min left, ends {now + timedelta(minutes=20):%H:%M}Z. e pauses it" in said(
        "idle", task(SKY, left_s=1200.0, until_s=late.timestamp())
    )[0]  # fmt: skip
    cut = said("idle", task(SKY, left_s=1200.0, until_s=soon.timestamp()))
    assert f"20 min left, pauses {soon:%H:%M}Z" in cut[0]
    assert not any("ends" in each for each in cut)


def test_the_pocket_view_names_no_key_that_it_lacks():
    pocket = ("pocket",)
    for name, tasks, ended in (
        ("idle", (), None), ("idle", (), ended_by("you")), ("idle", (), "Ended by anna."), ("held", (), None),
        ("idle", (task(SKY, left_s=60.0),), None),
    ):  # fmt: skip
        larger = said(name, *tasks, map_ended=ended)[0]
        assert " u resumes" in larger or " e pauses" in larger
        for each in said(name, *tasks, map_ended=ended, scopes=pocket):
            assert " u " not in each
            assert " e " not in each


def test_drift_has_the_unit_of_its_map():
    drifted = task(SKY, gain=0.97, right_deg=0.4, up_deg=0.0)
    assert drift_words(drifted, decibels=False)[1] == "drift: gain ×0.97, +0.40° right, +0.00° up"
    assert drift_words(drifted, decibels=True)[1] == "drift: gain +0.97 dB, +0.40° right, +0.00° up"


def test_a_time_of_another_day_has_its_date():
    now = view_of().utc
    assert clock_words(now + timedelta(hours=5), now) == "17:00Z"
    assert clock_words(now + timedelta(hours=29), now) == f"{now + timedelta(hours=29):%Y-%m-%d} 17:00Z"

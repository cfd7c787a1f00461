"""F1's row of cards: each with its key and a line that is true now, by key and mouse, grey where it can't be given."""

from dataclasses import replace

import pytest
import sky_stand_in
import stand_in
from birdcage.base.config import Settings
from birdcage.base.paths import throw_away_paths
from birdcage.setup.engine import Setup
from birdcage.setup.step import Mark
from birdcage.setup.tally import StepTally, count_steps
from birdcage.signal.tuner import TUNER_FACTS
from birdcage_tui.feeds.ready_watch import ReadyWatch
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.panes.cards import CARDS, CardsPane
from birdcage_tui.panes.health import HealthPane
from birdcage_tui.shown.view import SignalSample
from birdcage_tui.widgets.fields_screen import FieldsScreen
from stage import run, run_each
from textual.geometry import Offset

SIZES = ((100, 30), (120, 36), (160, 48))


def cards_of(app):
    """Return the text of each card, its two rows in one."""
    cells = app.query_one(CardsPane)._cells
    rows = ["".join(cells._chars[y]) for y in range(2)]
    return [" ".join(" ".join(rows[y][spot.x : spot.right].split()) for y in range(2)).strip()
            for spot, _ in app.query_one(CardsPane).hot]  # fmt: skip


async def seen(app, _pilot):
    return cards_of(app)


def on(*size, name="idle", **options):
    return run(seen, name, size, sky=sky_stand_in.make(), **options)


@pytest.mark.parametrize("size", SIZES)
def test_five_cards_stand_whole_below_the_panes(size):
    async def body(app, _pilot):
        pane = app.query_one(CardsPane)
        assert pane.display
        assert app.screen.region.contains_region(pane.region)
        return [command for _, command in pane.hot], cards_of(app)

    commands, cards = run(body, size=size, sky=sky_stand_in.make())
    assert commands == ["goto", "next-pass", "page-signal", "scan-sky", "page-setup"]
    assert [card.split(" ", 1)[0] for card in cards] == ["g", "n", "3", "w", "8"]
    assert not any("…" in card for card in cards)


@pytest.mark.parametrize("size", [(80, 24), (99, 40), (120, 29)])
def test_a_smaller_terminal_has_no_row(size):
    async def body(app, _pilot):
        return app.query_one(CardsPane).display, app.query_one(CardsPane).region.height

    assert run(body, size=size) in ((False, 0), (False, 2))


def test_each_card_says_what_is_so():
    point, passing, monitor, scan, setup = on(120, 36)
    assert point == "g Point 18° to 65° elevation"
    assert passing == "n Next pass now METEOR-M2 4, max 71°", "it is in reach"
    assert monitor == "3 Monitor 480 counts, tuner"
    assert scan == "w Scan the sky a map, live"
    assert setup == "8 Setup 8 of 11 steps done"


def test_how_long_a_pass_is_in_reach_still():
    assert on(160, 48)[1] == "n Next pass now, 01:29 left METEOR-M2 4, max 71°"


def test_what_keeps_the_dish_is_on_the_cards_that_move_it():
    said = run_each(seen, ("held", "lost", "not-homed", "travler"), (120, 36), sky=sky_stand_in.make())
    assert (said["held"][0], said["held"][3]) == ("g Point Enter: release", "w Scan the sky Enter: release")
    assert (said["lost"][0], said["lost"][3]) == ("g Point no answer", "w Scan the sky no answer")
    assert said["not-homed"][0] == "g Point H: home first"
    assert said["travler"][3] == "w Scan the sky no tuner in this dish"


def test_such_a_card_is_grey_and_its_key_says_the_whole_reason():
    async def body(app, pilot):
        inks = app.query_one(CardsPane)._cells._inks[0]
        await pilot.press("w")
        await pilot.pause()
        return "strong" in inks[:20], app.view().note

    strong, said = run(body, "lost", (120, 36))
    assert not strong
    assert said == "The dish does not answer."


def test_an_old_reading_tells_its_age_and_none_says_so():
    async def body(app, pilot):
        book = app.signals.book.of(TUNER_FACTS)
        last = book[-1]
        book.clear()
        book.append(SignalSample(last.at - 60.0, last.value))
        app.paint()
        await pilot.pause()
        old = cards_of(app)[2]
        book.clear()
        app.paint()
        await pilot.pause()
        return old, cards_of(app)[2]

    old, none = run(body, size=(120, 36))
    assert old == "3 Monitor 480 counts, 60s ago"
    assert none == "3 Monitor tuner: no reading"


def test_without_a_place_or_a_sky_no_pass_is_promised():
    async def body(app, pilot):
        await pilot.press("n")
        await pilot.pause()
        return cards_of(app)[1], stand_in.text_of(app), app.page.scope

    card, said, page = run(body, size=(120, 36))
    assert card == "n Next pass no passes yet"
    assert "No passes yet." in said
    assert page == "dashboard"


def test_n_shows_the_plan_of_the_pass_on_the_card():
    async def body(app, pilot):
        await pilot.press("n")
        await pilot.pause()
        await pilot.pause()
        return app.track.offer, app.page.scope

    offer, page = run(body, size=(120, 36), sky=sky_stand_in.make())
    assert offer.name == "METEOR-M2 4"
    assert page == "craft"


def test_w_asks_for_a_map():
    async def body(app, pilot):
        await pilot.press("w")
        await pilot.pause()
        await pilot.pause()
        return app.page.scope, isinstance(app.screen, FieldsScreen), stand_in.text_of(app)

    page, asked, said = run(body, size=(120, 36))
    assert page == "signal"
    assert asked
    assert "Map the sky" in said
    assert "directions, about" in said


@pytest.mark.parametrize("row", [0, 1])
def test_a_click_anywhere_on_a_card_does_it(row):
    async def body(app, pilot):
        spots = {command: spot for spot, command in app.query_one(CardsPane).hot}
        await pilot.click(CardsPane, offset=Offset(spots["goto"].x + 9, row))
        await pilot.pause()
        opened = app.screen.query_one(GotoLine).display
        await pilot.press("escape")
        await pilot.click(CardsPane, offset=Offset(spots["page-setup"].right - 1, row))
        await pilot.pause()
        await pilot.pause()
        return opened, app.page.scope

    assert run(body, size=(120, 36)) == (True, "setup")


def test_the_cards_take_nothing_from_the_other_panes():
    async def body(app, _pilot):
        cells = app.query_one(HealthPane)._cells
        health = "\n".join("".join(row) for row in cells._chars)
        return health, app.query_one("#signal").size.height

    health, signal_rows = run(body, size=(120, 36))
    for words in ("up, 12 ms, sim:g2, heard 0.2s ago", "18.0° to 65.0°, offset +0.00° +0.00°", "homed", "TV search",
                  "clock", "firmware", "feed"):  # fmt: skip
        assert words in health
    assert "…" not in health
    assert signal_rows >= 3, "its curve has two rows still"


def test_every_card_has_its_command():
    async def body(app, _pilot):
        return [command for _, command in app.query_one(CardsPane).hot]

    assert run(body, size=(100, 30)) == [name for name, _ in CARDS]


@pytest.mark.parametrize("name", ["idle", "not-homed", "lost", "travler"])
def test_steps_are_counted_as_setup_marks_them(name):
    kept = replace(Settings().setup, north="done 2026-03-20T12:00Z: 3.2", level="skipped 2026-03-20T12:00Z")
    settings, session = replace(Settings(), setup=kept), stand_in.app_in(name).session
    with throw_away_paths() as paths:
        marks = [step.mark for step in Setup(session, settings, paths, environ={}, ports=list).steps()]
        counted, fresh = (count_steps(session, each, paths) for each in (settings, Settings()))
    assert counted == StepTally(marks.count(Mark.DONE), len(marks)), "a step that was skipped is not done"
    assert counted.done == fresh.done + 1, "the file's north"


def test_the_count_is_told_when_it_changes_and_not_when_it_cannot_be_made():
    told, answers = [], iter((StepTally(2, 11), StepTally(2, 11), OSError(), StepTally(3, 11)))

    def count():
        answer = next(answers)
        if isinstance(answer, OSError):
            raise answer
        return answer

    watch = ReadyWatch(None, lambda work: work(), lambda: told.append(watch.steps), count)
    for _ in range(4):
        watch.tally()
    assert told == [StepTally(2, 11), None, StepTally(3, 11)]

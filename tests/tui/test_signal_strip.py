"""The strip of F3: a scale on which noise looks like noise, statistics, and markers against now."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest
import stage
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.signal.source import Scale, SignalFacts, SignalReading
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.requests import Release
from birdcage_tui.drawing.strip_scale import strip_scale
from birdcage_tui.shown.markers import MOST
from birdcage_tui.shown.signal_book import SignalBook
from birdcage_tui.shown.strip_words import statistics_text
from birdcage_tui.shown.view import SignalSample
from birdcage_tui.signal.strip import StripPane

RECEIVER = SignalFacts("sdr", "sdr", "dB", Scale.LOG, 10.0, 2.0, None, None, 1, 10.0, None, of_dish=False, demo=False)
SIZES = [(80, 24), (120, 36), (160, 48)]
NOISE = (0.6, -0.7, 0.1, 0.9, -0.5, -0.4)


def hear(app, values, facts=TUNER_FACTS, every_s=0.1, first_s=0.1):
    """Have the app hear these, the last one just now."""
    book, state = app.signals.book, app.station.state
    now, utc = app.session.clock.monotonic(), app.session.clock.utc()
    for back, value in reversed(list(enumerate(reversed(values)))):
        at = now - first_s - back * every_s
        known = replace(state, position=replace(state.position, at=at))
        book.hear(SignalReading(value, facts.unit, at, utc, facts.id), facts, known)


def shown(values, *keys, size=(120, 36), name="idle", facts=TUNER_FACTS, then=(), **options):
    """Return all text and the cells of the strip, after readings, keys, and more readings."""

    async def look(app, pilot):
        app.signals.book.choose(facts)  # without what the stand-in has heard
        hear(app, values, facts)
        for key in keys:
            await pilot.press(key)
        if then:
            app.session.clock.advance(2.0)
            state = app.station.state
            at = app.session.clock.monotonic()
            moved = replace(state.position, az_deg=190.3, el_deg=42.97, at=at)
            app.station.state = replace(state, position=moved)
            hear(app, then, facts)
        app.paint()
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), app.query_one(StripPane), app.station

    return stage.run(look, name, size, key="f3", **options)


@pytest.mark.parametrize(("lowest", "highest", "span", "least", "rows", "ticks"), [
    (441.0, 446.0, 13.0, 0.0, 4, (440.0, 445.0, 450.0)),
    (0.0, 3.0, 13.0, 0.0, 4, (0.0, 5.0)),
    (399.0, 545.0, 13.0, 0.0, 2, (400.0, 500.0)),
    (412.0, 545.0, 13.0, 0.0, 2, (500.0,)),
    (-40.2, -39.9, 1.0, None, 10, (-40.4, -40.2, -40.0, -39.8, -39.6)),
    (-60.0, -20.0, 10.0, None, 10, (-60.0, -50.0, -40.0, -30.0, -20.0)),
])  # fmt: skip
def test_the_scale_has_its_lines_at_round_numbers(lowest, highest, span, least, rows, ticks):
    scale = strip_scale(lowest, highest, span, least, rows)
    assert scale.ticks == pytest.approx(ticks)
    assert scale.low <= lowest < highest <= scale.high
    assert scale.high - scale.low >= (span if least is None else 5.0)
    assert (scale.dot(scale.low, 15), scale.dot(scale.high, 15)) == (15.0, 0.0)
    assert scale.low >= (-1e9 if least is None else least)


def test_labels_tell_the_lines_apart():
    assert strip_scale(-40.2, -39.9, 1.0, None, 10).decimals == 1
    assert strip_scale(400.0, 900.0, 10.0, 0.0, 10).decimals == 0
    assert strip_scale(0.001, 0.002, 0.0, 0.0, 10).decimals == 4


def test_a_scale_of_one_value_is_still_a_scale():
    scale = strip_scale(5.0, 5.0, 0.0, None, 4)
    assert scale.high > scale.low
    assert scale.ticks


def rows_of(pane):
    """The rows of dots in which the curve is drawn, from top to bottom."""
    cells = pane._cells
    return [y for y in range(1, cells.height) if any(
        ink == "accent" and "⠀" < char <= "⣿" for char, ink in zip(cells._chars[y], cells._inks[y], strict=True)
    )]  # fmt: skip


@pytest.mark.parametrize("loud", [1.0, 3.0, 10.0])
def test_noise_takes_a_small_part_of_the_height_and_a_step_stands_out_of_it(loud):
    noise = [443.0 + loud * each for each in NOISE * 8]
    quiet = shown(noise, size=(160, 48))[1]
    height = quiet._cells.height - 3
    assert 0.05 * height < len(rows_of(quiet)) <= 0.3 * height
    stepped = shown([*noise, *(each + 12.0 * loud for each in noise)], size=(160, 48))[1]
    assert len(rows_of(stepped)) > 0.45 * height


def test_a_curve_that_grows_looks_as_one_drawn_at_once():
    async def look(app, pilot):
        app.signals.book.choose(TUNER_FACTS)
        pane, kept = app.query_one(StripPane), 0
        for step in range(60):
            app.session.clock.advance(3.0 if step == 40 else 0.1)  # a gap, too
            hear(app, [443.0 + 9.0 * math.sin(step / 4.0)], first_s=0.0)
            before = pane._traced
            app.paint()
            await pilot.pause()
            kept += before is not None and pane._traced is not None and before[1] is pane._traced[1]
            grown = pane._cells
            pane._traced = None
            pane.show(pane.view)
            assert pane._cells.rows_unlike(grown) == []
            pane._traced = None if step % 7 == 0 else pane._traced
        assert kept > 10, "else nothing was tried"

    stage.run(look, "idle", (120, 36), key="f3")


@pytest.mark.parametrize(("width", "said"), [
    (90, "mean 443.0 ±1.0 counts  min 442  max 444  3 readings"),
    (50, "mean 443.0 ±1.0 counts  min 442  max 444"),
    (30, "mean 443.0 ±1.0 counts"),
])  # fmt: skip
def test_the_statistics_give_way_from_the_end(width, said):
    samples = [SignalSample(1.0, 442.0), SignalSample(2.0, 443.0), SignalSample(3.0, 444.0)]
    assert statistics_text(samples, TUNER_FACTS, width) == said


def test_one_reading_has_no_scatter():
    assert statistics_text([SignalSample(1.0, -40.0)], RECEIVER, 80) == (
        "mean -40.00 dB  min -40.0  max -40.0  1 reading"
    )


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_marker_is_drawn_numbered_and_listed_with_now_against_it(size):
    text, pane, station = shown([443.0] * 12, "enter", size=size, then=[441.0] * 12)
    assert "mean 442.0 ±1.0" in text
    line = next(line for line in text.splitlines() if re.search(r"│.* 1 \d\d:\d\d:\d\d", line))
    # The stand-in points to 189.16/42.87, and was turned to 190.3/42.97.
    want = r"1 \d\d:\d\d:\d\dZ?   443 +-2\.0 +(◀1\.14° ▼0\.10°)" if size[0] >= 100 else r"443 +-2\.0 +0\.8°"
    assert re.search(want, line), line
    first = "".join(pane._cells._chars[1])
    assert first.count("1") >= 1
    assert "strong" in pane._cells._inks[1]
    assert station.asked_for(Release) == []


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_list_of_more_markers_than_rows_has_its_heading_and_says_so(size):
    text, pane, _station = shown([443.0] * 6, *["enter"] * MOST, size=size)
    listed = [int(told[1]) for told in re.finditer(r" (\d+) \d\d:\d\d:\d\dZ? +443 ", text)]
    heading = next(line for line in text.splitlines() if re.search("level +now.* (way back|away) ", line))
    assert listed == list(range(MOST, MOST - len(listed), -1))
    assert 2 <= len(listed) <= pane._cells.height - 2
    assert (" marker " if len(listed) == MOST else f" newest {len(listed)} ") in heading


def test_decibels_are_called_so_and_a_marker_says_where_it_was_set():
    text, _pane, _station = shown([-40.0] * 6, "enter", facts=RECEIVER, then=[-41.5] * 6)
    assert "-1.5 dB" in text
    text, _pane, _station = shown([443.0] * 6, "enter")
    assert re.search(r"Marker 1: 443 counts at \d+\.\d\d°/\d+\.\d\d°, \d\d:\d\d:\d\dZ\. X clears all markers\.", text)


def test_what_is_old_is_not_marked_and_what_is_not_heard_neither():
    async def body(app, pilot):
        app.signals.book.choose(TUNER_FACTS)
        await pilot.press("enter")
        await pilot.pause()
        nothing = stand_in.text_of(app), app.view().markers
        app.signals.book.choose(TUNER_FACTS)
        hear(app, [443.0], first_s=TUNER_FACTS.pause_s + 1.0)
        await pilot.press("enter")
        await pilot.pause()
        return nothing, (stand_in.text_of(app), app.view().markers)

    for text, markers in stage.run(body, "idle", (120, 36), key="f3"):
        assert not markers
        assert "too old to be marked" in text


def test_x_clears_them_and_enter_releases_first_while_held():
    text, _pane, station = shown([443.0] * 6, "enter", "enter", "X")
    assert "Markers cleared." in text
    assert "way back" not in text
    text, _pane, station = shown([443.0] * 6, "enter", name="held")
    assert len(station.asked_for(Release)) == 1
    assert "Marker 1" not in text


def test_the_oldest_gives_way_and_another_source_has_its_own():
    clock = VirtualClock()
    book, state = SignalBook(), stand_in.at_rest(clock)
    book.hear(SignalReading(443.0, "counts", clock.monotonic(), clock.utc(), "tuner"), TUNER_FACTS, state)
    for _ in range(MOST + 2):
        book.mark(clock.monotonic(), clock.utc(), state)
    assert [each.number for each in book.markers] == list(range(3, MOST + 3))
    book.choose(RECEIVER)
    assert not book.markers
    assert book.clear_markers() == 0


def test_where_there_are_few_rows_the_statistics_take_the_first_and_the_scale_tells_two_values():
    text, _pane, _station = shown([400.0] * 20 + [545.0] * 20, size=(80, 24))
    lines = text.splitlines()
    top = next(y for y, line in enumerate(lines) if "─ Signal ─" in line)
    rows = lines[top + 1 : next(y for y, line in enumerate(lines) if "last 60 s" in line)]
    assert "mean 472.5 ±" in rows[0]
    assert "min 400  max 545  40 readings" in rows[0]
    assert len([row for row in rows[1:] if re.match(r"│ +\d{3} ", row)]) >= 2, rows

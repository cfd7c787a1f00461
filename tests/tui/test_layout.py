"""Everything a person needs lies inside the screen, at every size; and says what it should."""

import itertools
import re
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.beam import beam_of
from birdcage.base.config import STOCK_FEED
from birdcage_tui.commands import PAGES
from birdcage_tui.pages.register import MADE
from birdcage_tui.panes.health import HealthPane
from birdcage_tui.panes.next import NextPane
from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.shown.stop_words import stop_text
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.skew import SkewPane
from birdcage_tui.widgets.status import BadDayRow, StatusLine, StopButton
from stage import read, run, run_each

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]
ALWAYS = [StatusLine, StopButton, BadDayRow, KeyBar]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_a_person_needs_is_inside_the_screen(size):
    async def regions(app, pilot):
        third = SignalPane if app.station.state.dish is not stand_in.TRAVLER else SkewPane
        wanted = [*ALWAYS, SkyPane, PointingPane, third, NextPane, *([HealthPane] if size[0] >= 100 else [])]
        found = {kind.__name__: app.query_one(kind).region for kind in wanted}
        insides = {kind.__name__: app.query_one(kind).content_size for kind in wanted}
        return found, insides, app.screen.region

    for name, (found, insides, screen) in run_each(regions, size=size).items():
        for what, region in found.items():
            assert region.area > 0, (name, what)
            assert screen.contains_region(region), f"{name}: {what} {region} is not inside {screen}"
            assert insides[what].area > 0, (name, what)
        for (what, region), (other, second) in itertools.combinations(found.items(), 2):
            assert not region.overlaps(second), f"{name}: {what} lies over {other}"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_first_questions_are_answered_at_every_size(size):
    text = run(read, "slewing", size)
    for words in ("AZ 201.30°", "EL 32.90°", "SLEWING", "you", "DEMO", "12:00:00Z", "■ STOP", "Space STOP"):
        assert words in text
    assert "40.6° to go, 0.6 s" in text
    assert "STOP should take 0.3 s" in text
    assert "CCW 303°" in text
    assert "counts" in text
    assert "You move it to" in text


@pytest.mark.parametrize("size", SIZES[1:], ids=str)
def test_health_is_whole_when_there_is_room(size):
    text = run(read, "idle", size)
    for words in ("12 ms", "02.02.48", "off (NVS 20)", "18.0° to 65.0°", "+0.00°", "stow locked", "Ku LNB"):
        assert words in text


def test_the_geostationary_arc_names_its_slots_and_only_with_a_place():
    assert "129°W" in run(read, "idle")
    assert "119°W EchoStar" in run(read, "idle", (160, 49))
    assert "119°W" not in run(read, "opening", (160, 48))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("held", ("■ HELD by you", "Gpredict 231.4/44.0 ignored x3", "Enter release")),
        (
            "lost",
            (
                "LOST  ",
                "○ LINK LOST 00:07",
                "It was moving when last heard. /dev/ttyUSB0 is not there. Plug it in; birdcage keeps looking.",
            ),
        ),
        ("silent", ("◍ SILENT 00:04", "power off", "AZ ---.--°", "EL --.--°")),
        ("not-homed", ("▲ NOT HOMED", "H homes it.", "AZ ---.--°", " NOT HOMED ")),
        (
            "fault",
            (
                "✖ FAULT 12:00:00  Azimuth stalled at 203.1°. Something",
                " FAULT ",
                "its steps",
                "Clear its swing",
                "Enter",
                "acknowledge",
            ),
        ),
        ("opening", ("Opening /dev/ttyUSB0", "AZ ---.--°")),
    ],
)
@pytest.mark.parametrize("size", SIZES[:2], ids=str)
def test_a_bad_day_is_told_in_words(name, words, size):
    text = run(read, name, size)
    for word in words:
        assert word in text or word in " ".join(text.split()), text


def test_while_the_link_is_lost_nothing_in_health_is_vouched_for():
    text = run(read, "lost", (160, 48))
    assert "●" not in text[text.index(" Health ") :]
    assert "a reply" not in text


@pytest.mark.parametrize("state", ["held", "fault", "not-homed"])
def test_the_last_row_offers_no_way_to_go_while_the_dish_cannot_be_moved(state):
    assert "g go to" not in run(read, state, (120, 36)).splitlines()[-1]
    assert "g go to" in run(read, "idle", (120, 36)).splitlines()[-1]


def test_what_is_unknown_is_dashes_and_never_a_number():
    text = run(read, "not-homed", (120, 36))
    assert "╶─╴╶─╴ ╶─╴╶─╴" in text
    assert "azimuth  unknown" in text
    assert "turn unknown" in text
    assert "189" not in text
    assert "STOP holds" in text


def test_a_stale_position_dims_and_shows_its_age():
    async def age(app, pilot):
        fresh = stand_in.text_of(app)
        pane = app.query_one(PointingPane)
        ink = pane._strips[0]._segments[1].style
        app.session.clock.advance(5.0)
        app.paint()
        await pilot.pause()
        return fresh, ink, stand_in.text_of(app), pane._strips[0]._segments[1].style, pane.inks

    fresh, ink, text, stale_ink, inks = run(age)
    assert "s old" not in fresh
    assert "5.2s old" in text
    assert ink == inks["big"]
    assert stale_ink == inks["dim"]


def test_a_real_dish_is_not_called_a_demo():
    assert "DEMO" not in run(read, "lost", (160, 48))


@pytest.mark.parametrize("name", [name for name, _, _ in PAGES if name not in (*MADE, "console")])
def test_pages_to_come_are_honest(name):
    async def visit(app, pilot):
        app.show_page(name)
        await pilot.pause()
        await pilot.pause()
        app.paint()
        await pilot.pause()
        focusable = [widget for widget in app.screen.query("#pages *") if widget.focusable]
        return stand_in.text_of(app), focusable

    text, focusable = run(visit)
    title = next(title for page, title, _ in PAGES if page == name)
    assert title in text
    assert "not built yet" in text
    assert not focusable
    said = [set(re.findall(r"[a-z]{4,}", row.lower())) for row in text.splitlines()[3:-2]]
    twice = [row for at, row in enumerate(said) for other in said[at + 1 :] if len(row) >= 3 and row <= other]
    assert not twice, f"said twice: {twice}"


def test_only_rows_that_changed_are_asked_for():
    async def count(app, pilot):
        asked = []
        for pane in app.query(Pane):
            pane.refresh = lambda *regions, pane=pane, **_: asked.append((type(pane).__name__, len(regions)))
        app.paint()
        unchanged = list(asked)
        app.session.clock.advance(1.0)
        app.paint()
        return unchanged, asked

    unchanged, asked = run(count)
    assert unchanged == []
    assert ("StatusLine", 1) in asked
    assert not [name for name, _ in asked if name in ("SkyPane", "KeyBar", "StopButton")]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_names_of_slots_never_touch_each_other_or_a_mark(size):
    text = run(read, "idle", size)
    labels = re.findall(r"\d+(?:\.\d)?°W", text)
    assert len(labels) >= 5
    assert len(set(labels)) == len(labels)
    assert "101°W" in labels, "what is pointed at is named"
    for label in labels:
        assert re.search(rf"[^\d•◉✕]{re.escape(label)}(?: [A-Z][\w ]+?)?[ ⠀-⣿]", text), label


@pytest.mark.parametrize("means", ["retarget", "release", "none"])
def test_what_stop_can_do_is_never_cut_off(means):
    async def tell(app, pilot):
        state = app.station.state
        motion = replace(state.motion, stop_means=means, eta=app.session.clock.monotonic() + 25)
        app.station.state = replace(state, motion=motion)
        app.paint()
        await pilot.pause()
        return stop_text(app.view()), stand_in.text_of(app)

    words, text = run(tell, "slewing")
    assert f"│ {words}" in text


def test_health_names_both_widths_of_the_beam_and_their_origin_where_there_is_room():
    def health(size):
        async def show(app, pilot):
            beam = beam_of(STOCK_FEED, stand_in.TRAVLER.reflector)
            app.station.state = replace(app.station.state, beam=beam, feed_name="stock-ku", stow_allowed=True)
            app.paint()
            await pilot.pause()
            return stand_in.text_of(app)

        return run(show, size=size)

    assert "stock Ku LNB 2.0° x 2.9°, stow allowed" in health((120, 36))
    assert "stock Ku LNB, beam 2.0° x 2.9° theory, stow allowed" in health((160, 48))
    assert "stock Ku LNB, beam 2.0° x 2.9° from reflector and frequency, stow allowed" in health((220, 60))

"""F1 names the worst of what the station lacks, and the key beside it leads to what mends it."""

from __future__ import annotations

import argparse
import threading
from dataclasses import replace

import pytest
import sky_stand_in
import stage
import stand_in
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.config.edit import edit
from birdcage.base.errors import ConfigError
from birdcage.base.paths import Paths, throw_away_paths
from birdcage.ready.check import Check
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.frozen import frozen
from birdcage.station.state import LinkPhase, LinkState, TvSearch
from birdcage_tui.feeds.ready_watch import KeptChecks, ReadyWatch
from birdcage_tui.panes.next import NextPane
from birdcage_tui.run import _build
from birdcage_tui.shown.unready import worst
from birdcage_tui.widgets.fields_screen import FieldsScreen

NO_PLACE = Check("place", "place", "must", "not set", "birdcage place add")
SHIPPED = Check("elements", "elements", "must", "only the few old sets of birdcage", "birdcage elements update")
OLD_FAVOURITE = Check("favourites", "ISS (ZARYA)", "look", "○ doubtful: 5 d old", "birdcage elements update")
NO_FAVOURITE = Check("favourites", "favourites", "look", "none is named", "birdcage elements favourite NAME")
LIMITS = Check("limits", "limits", "look", "only the firmware's cable limits", "birdcage setup")
FEED = Check("feed", "feed", "look", "stock Ku LNB, the default: is this feed mounted?", "birdcage setup")
SEARCH = Check("search", "TV search", "look", "unknown: the dish may start to search by itself", "birdcage init")
DISH = Check("dish", "dish", "look", "firmware not set: the port is asked", "birdcage setup")
PORT = Check("port", "port", "look", "not set; plug in the adapter", "birdcage ports")
HOOKS = Check("hooks", "hooks", "look", "at_tca: there is no program 'x'", "birdcage config path")


class Found:
    """A source that has found this."""

    def __init__(self, *checks):
        self.checks = checks

    def fingerprint(self):
        return 0

    def find(self):
        return self.checks


def play(test, *checks, size=(80, 24), name="idle", **options):
    async def begin(app, pilot):
        app.feeds.ready.take(checks)
        app.paint()
        await pilot.pause()
        return await test(app, pilot)

    return stage.run(begin, name, size, sky=sky_stand_in.make(), **options)


async def told(app, _pilot):
    """What the pane says, in one line."""
    rows = ["".join(row).strip() for row in app.query_one(NextPane)._cells._chars]
    return " ".join(" ".join(rows).split())


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (240, 70)], ids=str)
def test_the_worst_is_named_with_its_key_until_it_is_mended(size):
    async def through(app, pilot):
        before = await told(app, pilot)
        app.feeds.ready.take(())
        app.paint()
        await pilot.pause()
        return before, await told(app, pilot)

    before, after = play(through, LIMITS, OLD_FAVOURITE, SHIPPED, size=size)
    assert "✗ Elements: only the old ones that ship. I: add newer ones, or run `birdcage elements update`." in before
    assert "Cable limits" not in before, "one at a time"
    assert before.startswith("At rest.")
    assert "Elements" not in after


def test_the_pocket_view_has_what_must_be_fixed_in_its_calm_row():
    async def read(app, _pilot):
        return stand_in.text_of(app)

    assert "✗ Old elements. I: add newer ones" in play(read, LIMITS, SHIPPED, size=(40, 12))
    assert "▲" not in play(read, LIMITS, size=(40, 12)).replace("[  ▲ ]", "")


@pytest.mark.parametrize(
    ("check", "sentence", "key", "title"),
    [
        (NO_PLACE, "✗ No location set. L sets it.", "L", "Set location"),
        (OLD_FAVOURITE, "▲ The elements of ISS (ZARYA) are old: expect a larger error. I: add newer ones.", "I",
         "Add elements"),
    ],
)  # fmt: skip
def test_its_key_asks_for_what_is_missing(check, sentence, key, title):
    async def press(app, pilot):
        if check is NO_PLACE:
            app.settings = replace(app.settings, place=None)
            app.paint()
            await pilot.pause()
        words = await told(app, pilot)
        await pilot.press(key)
        await pilot.pause()
        return words, app.screen, stand_in.text_of(app)

    words, screen, text = play(press, check, keep_place=lambda *_: None)
    assert sentence in words
    assert isinstance(screen, FieldsScreen)
    assert title in text


@pytest.mark.parametrize("way", ["key", "F key", "mouse"])
@pytest.mark.parametrize(
    ("check", "state", "step", "sentence"),
    [
        (LIMITS, {}, "limits", "▲ Cable limits are the firmware's. Your coax may be shorter. 8: set yours."),
        (FEED, {}, "feed", "▲ Which feed is fitted? birdcage assumes stock Ku LNB. 8: tell which."),
        (SEARCH, {"search": TvSearch.UNKNOWN}, "search",
         "▲ The TV search may move the dish: not known to be off. 8: switch it off."),
        (PORT, {"link": LinkState(LinkPhase.LOST, 0.0, 0.0, 0.0, "Plug in the adapter."), "port": ""}, "link",
         "▲ No port is set. 8: find the dish."),
    ],
    ids=lambda each: each.subject if isinstance(each, Check) else "",
)  # fmt: skip
def test_8_opens_the_setup_with_the_cursor_on_the_step(check, state, step, sentence, way):
    async def press(app, pilot):
        words = await told(app, pilot)
        if way == "mouse":
            pane = app.query_one(NextPane)
            spot = next(region for region, name in pane.hot if name == "page-setup")
            await pilot.click(NextPane, offset=(spot.x + 3, spot.y))
        else:
            await pilot.press({"key": "8", "F key": "f8"}[way])
        await pilot.pause()
        return words, app.page.id, app.page.step.name

    words, page, looked = play(press, check, state=state)
    assert sentence in words
    assert (page, looked) == ("page-setup", step)


def test_7_opens_the_passes_where_a_favourite_is_marked():
    async def press(app, pilot):
        words = await told(app, pilot)
        await pilot.press("7")
        await pilot.pause()
        await pilot.press("asterisk")
        return words, app.page.id, sky_stand_in.Source.made[0].favourites

    words, page, favourites = play(press, NO_FAVOURITE)
    assert "▲ No satellite is marked as a favourite. 7: * there marks one." in words
    assert page == "page-passes"
    assert favourites


def test_8_elsewhere_stays_where_the_setup_is():
    async def press(app, pilot):
        await pilot.press("2", "8")
        await pilot.pause()
        return app.page.step.name == app.page.present

    assert play(press, LIMITS)


@pytest.mark.parametrize(
    ("checks", "state"),
    [
        ((NO_PLACE,), {}),
        ((DISH, PORT, SEARCH), {}),
        ((SEARCH,), {"search": TvSearch.OFF_UNTIL_POWER_UP}),
    ],
)
def test_what_the_station_knows_to_be_so_is_no_finding(checks, state):
    async def look(app, _pilot):
        return worst(app.view())

    assert play(look, *checks, state=state) is None


def test_nothing_known_is_no_finding():
    async def look(app, _pilot):
        return app.view().ready, worst(app.view())

    assert stage.run(look) == (None, None)


def test_what_no_key_mends_names_none():
    async def look(app, _pilot):
        return worst(app.view())

    found = play(look, HOOKS)
    assert (found.words, found.command) == ("▲ Hooks: at_tca: there is no program 'x'. Fix the file.", "")


@pytest.mark.parametrize(("name", "first"), [("held", "birdcage sends no motion"), ("not-homed", "Next: H homes it")])
def test_what_is_wrong_with_the_dish_comes_first(name, first):
    words = play(told, SHIPPED, size=(160, 48), name=name)
    assert words.index(first) < words.index("only the old ones")


def test_a_demo_looks_for_nothing_that_it_lacks():
    with throw_away_paths() as paths:
        options = argparse.Namespace(
            demo=True, speed=None, firmware=None, baud=None, port=None, theme=None, glyphs=None, config=None,
            skip_init=False,
        )  # fmt: skip
        session, settings, _services = _build(options, paths)
        session.close()
    assert settings.ready is None


# Where it comes from.


def kept(tmp_path):
    paths = Paths.in_folder(tmp_path)
    return paths, KeptChecks(lambda: load(paths.config_file, environ={}), paths, RealClock())


def test_a_fresh_install_lacks_a_place_and_elements(tmp_path):
    _, source = kept(tmp_path)
    found = {check.subject: check.state for check in source.find()}
    assert {subject for subject, state in found.items() if state == "must"} == {"place", "elements"}
    assert found["limits"] == "look"
    assert "clock" not in found, "the app watches that itself"


def test_what_was_written_is_seen(tmp_path):
    paths, source = kept(tmp_path)
    before = source.fingerprint()
    edit(paths.config_file, {"place.latitude_deg": 52.0, "place.longitude_deg": 5.0})
    assert source.fingerprint() != before
    assert "place" not in {check.subject for check in source.find()}


def test_reading_the_catalogue_is_no_change_of_it(tmp_path):
    paths, source = kept(tmp_path)
    with Catalogue(paths.catalogue) as catalogue:
        catalogue.add(frozen()[:1])
    before = source.fingerprint()
    with Catalogue(paths.catalogue) as catalogue:
        catalogue.entries()
        assert source.fingerprint() == before
    assert source.fingerprint() == before
    with Catalogue(paths.catalogue) as catalogue:
        catalogue.add(frozen())
        assert source.fingerprint() != before


def test_what_was_skipped_in_the_setup_is_decided(tmp_path):
    paths, source = kept(tmp_path)
    edit(paths.config_file, {"setup.limits": "skipped 2026-03-20T12:00Z", "setup.feed": "done 2026-03-20T12:00Z"})
    assert not {"limits", "feed"} & {check.subject for check in source.find()}


def test_it_is_looked_for_on_a_thread_of_its_own_and_a_failure_is_no_finding(monkeypatch):
    monkeypatch.setattr("birdcage_tui.feeds.ready_watch.FIRST_S", 0.0)
    monkeypatch.setattr("birdcage_tui.feeds.ready_watch.LOOK_S", 0.0)
    seen, enough = [], threading.Event()

    class Source:
        def __init__(self):
            self.stamp = 0

        def fingerprint(self):
            self.stamp += 1
            return self.stamp

        def find(self):
            seen.append(threading.current_thread())
            if len(seen) == 2:
                raise ConfigError("It can't be read.")
            return (LIMITS,)

    taken = []

    def soon(work):
        work()
        taken.append(watch.now)
        if len(taken) == 3:
            watch.close()
            enough.set()

    watch = ReadyWatch(Source(), soon, lambda: None)
    watch.begin()
    assert enough.wait(5.0)
    assert taken == [(LIMITS,), None, (LIMITS,)]
    assert threading.main_thread() not in seen


def test_files_that_stay_are_read_once(monkeypatch):
    monkeypatch.setattr("birdcage_tui.feeds.ready_watch.FIRST_S", 0.0)
    monkeypatch.setattr("birdcage_tui.feeds.ready_watch.LOOK_S", 0.0)
    looks, read, enough = [], [], threading.Event()

    class Source(Found):
        def fingerprint(self):
            looks.append(1)
            if len(looks) == 20:
                watch.close()
                enough.set()
            return 0

        def find(self):
            read.append(1)
            return ()

    watch = ReadyWatch(Source(), lambda work: work(), lambda: None)
    watch.begin()
    assert enough.wait(5.0)
    assert len(read) == 1

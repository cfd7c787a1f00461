"""The real watch behind the app: the demo's orbits, on a virtual clock and without a thread."""

import asyncio
import csv
import json
import re
import threading
from dataclasses import replace
from datetime import datetime, timedelta

import pytest
import stand_in
from birdcage.base.clock import RealClock, VirtualClock
from birdcage.base.config import FeedProfile, PlaceSettings, Settings
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.frozen import frozen
from birdcage.sky.observer import Observer
from birdcage_tui.demo import DEMO_PLACE
from birdcage_tui.feeds.sky_feed import make_sky
from birdcage_tui.shown.options import SitePlace
from icalendar import Calendar

HERE = Settings(
    place=PlaceSettings(
        name=DEMO_PLACE.name, latitude_deg=DEMO_PLACE.latitude_deg, longitude_deg=DEMO_PLACE.longitude_deg
    )
)

SIDEREAL_DAY = timedelta(days=0.9972695663)


class Stage:
    """A source, its clock, what it showed and what it said."""

    def __init__(self, tmp_path, *, settings=HERE, demo=True):
        self.paths = Paths.in_folder(tmp_path)
        self.clock = VirtualClock()
        self.shown, self.said = [], []
        make = make_sky(settings, self.paths, self.clock, demo=demo, threads=False)
        self.source = make(self.shown.append, self.said.append)
        self.source.keep(stand_in.at_rest(self.clock), DEMO_PLACE if settings is HERE else None)
        self.source.start()

    def step(self, seconds=0.0):
        self.clock.advance(seconds)
        self.source.step()
        return self.shown[-1]


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path)


def test_the_demo_has_a_sky_that_moves(stage):
    first = stage.step()
    later = stage.step(3.0)
    assert len(first.up) >= 10
    before = {one.norad_id: (one.az_deg, one.el_deg) for one in first.up if not one.fixed}
    moved = [one for one in later.up if one.norad_id in before and (one.az_deg, one.el_deg) != before[one.norad_id]]
    assert len(moved) >= 8
    assert any(one.fixed for one in first.up), "the geostationary ones stand still"
    assert first.sun is not None
    assert later.t_s == first.t_s + 3.0
    assert later.source == "demo orbits"
    assert later.note == ""


def test_passes_come_with_reach_path_and_age(stage):
    sky = stage.step()
    assert sky.searched == 1.0
    assert len(sky.rows) > 50
    assert [row.aos_s for row in sky.rows] == sorted(row.aos_s for row in sky.rows)
    soon = next(row for row in sky.rows if row.reach_s > 60 and row.aos_s > sky.t_s)
    path = soon.path
    assert path.t_s[0] == pytest.approx(soon.aos_s, abs=1e-3)
    assert path.el_deg[0] == pytest.approx(0.0, abs=0.05)
    assert max(path.el_deg) == pytest.approx(soon.max_el_deg, abs=0.05)
    start = soon.reach.intervals[0].start_s
    assert soon.path.at(start)[1] == pytest.approx(18.0, abs=0.3), "the dish's floor"
    assert soon.age.words == "made up for the demo"
    assert not any(row.name.startswith("DEMO") for row in sky.rows), "the status line says so already"


def test_what_has_re_entered_by_its_own_elements_is_told_in_the_list(tmp_path):
    station = next(each for each in frozen() if each.norad_id == 25544)
    with Catalogue(Paths.in_folder(tmp_path).catalogue) as catalogue:
        catalogue.add([replace(station, epoch=VirtualClock().utc() - timedelta(days=2000), source="")])
    rows = Stage(tmp_path, demo=False).step().rows
    assert rows
    assert {row.age.short for row in rows} == {"re-entered?"}
    assert {row.age.ink for row in rows} == {"fault"}
    assert "by its elements it re-entered about" in rows[0].age.words


def test_passes_that_are_the_same_stay_the_same_objects(stage):
    stage.step()
    first, later = stage.step(1.0), stage.step(2.0)  # by then the groups are read
    same = {id(row) for row in first.rows}
    assert sum(id(row) in same for row in later.rows) >= len(later.rows) - 2


def test_other_limits_of_the_dish_give_another_reach(stage):
    before = stage.step()
    state = replace(stand_in.at_rest(stage.clock), el_min_deg=50.0)
    stage.source.keep(state, DEMO_PLACE)
    after = stage.step(2.0)
    assert sum(row.reach_s for row in after.rows) < sum(row.reach_s for row in before.rows) / 2


def test_another_place_gives_other_passes(stage):
    before = stage.step()
    stage.source.keep(stand_in.at_rest(stage.clock), SitePlace(-33.9, 18.4, "Cape Town"))
    after = stage.step(2.0)
    assert {row.tca_s for row in after.rows}.isdisjoint({row.tca_s for row in before.rows})


def test_a_favourite_is_shown_at_once_and_kept(stage):
    sky = stage.step()
    row = next(row for row in sky.rows if not row.favourite)
    count = len(stage.shown)
    stage.source.set_favourite(row.norad_id, True)
    stage.source.step()
    first = stage.shown[count]
    assert all(one.favourite for one in first.rows if one.norad_id == row.norad_id), "before the catalogue is read"
    with Catalogue(stage.paths.catalogue) as catalogue:
        assert catalogue.entry(row.norad_id).favourite
    again = stage.step(30.0)
    assert all(one.favourite for one in again.rows if one.norad_id == row.norad_id)
    with Catalogue(stage.paths.catalogue) as catalogue:
        catalogue.set_favourite(row.norad_id, False)
    other = stage.step(30.0)
    assert not any(one.favourite for one in other.rows if one.norad_id == row.norad_id), "another program's word counts"


def test_passes_are_written_as_three_files(stage):
    sky = stage.step()
    rows = [row for row in sky.rows if row.reach_s > 0][:5]
    stage.source.export(rows)
    stage.source.step()
    (words,) = stage.said
    folder = stage.paths.catalogue.parent / "passes"
    stem = folder / "passes-20260320-120000"
    assert words == f"{stem}.ics, .csv, .json: 5 passes"
    values = json.loads(stem.with_suffix(".json").read_text())
    assert [each["norad_id"] for each in values] == [row.norad_id for row in rows]
    assert datetime.fromisoformat(values[0]["aos"]).timestamp() == pytest.approx(rows[0].aos_s, abs=0.01)
    with stem.with_suffix(".csv").open(newline="") as file:
        assert len(list(csv.DictReader(file))) == 5
    calendar = Calendar.from_ical(stem.with_suffix(".ics").read_bytes())
    events = calendar.walk("VEVENT")
    assert len(events) == 5
    assert all("DEMO" in str(event["description"]) for event in events)


def test_a_folder_that_cannot_be_written_is_told(stage):
    sky = stage.step()
    (stage.paths.catalogue.parent / "passes").write_text("in the way")
    stage.source.export(sky.rows[:2])
    stage.source.step()
    assert "Cannot write to" in stage.said[0]


def test_without_a_catalogue_the_elements_that_ship_are_marked(tmp_path):
    sky = Stage(tmp_path, demo=False).step()
    assert sky.source == "elements that ship"
    assert re.search(r"the newest of \d{4}-\d\d-\d\d\. They are too old", sky.note)
    assert sky.up
    assert all(one.old for one in sky.up), "no place of theirs is to be believed"


def test_what_is_up_by_elements_that_are_too_old_is_marked(tmp_path):
    stage = Stage(tmp_path, demo=False)
    (up, *_) = [one for one in demo_orbits(stage.clock.utc(), Observer(39.1, -95.7)) if one.mean_motion_rev_day < 1.1]
    young = replace(up, name="YOUNG", norad_id=1, source="mine")
    aged = replace(up, name="AGED", norad_id=2, source="mine", epoch=up.epoch - 400 * SIDEREAL_DAY)  # stands there, too
    with Catalogue(stage.paths.catalogue) as catalogue:
        catalogue.add([young, aged])
    stage.source._watch.refresh()
    sky = stage.step(5.0)
    assert {one.name: one.old for one in sky.up} == {"YOUNG": False, "AGED": True}


def test_an_exported_pass_tells_what_the_feed_listens_to(tmp_path):
    feed = FeedProfile(freq_min_hz=137e6, freq_max_hz=138e6)
    stage = Stage(tmp_path, demo=False, settings=replace(HERE, feeds={**HERE.feeds, "stock-ku": feed}))
    stage.paths.downlinks_file.write_text(
        '[[downlink]]\nsatellite = "ISS"\nfreq_mhz = 137.5\nnames = ["ISS (ZARYA)"]\nmode = "LRPT"\n'
        'pipeline = "meteor_m2-x_lrpt"\n'
    )
    sky = stage.step()
    stage.source.export([row for row in sky.rows if row.name == "ISS (ZARYA)"][:1])
    stage.source.step()
    (path,) = (stage.paths.catalogue.parent / "passes").glob("*.json")
    assert json.loads(path.read_text())[0]["downlink_pipeline"] == "meteor_m2-x_lrpt"


def test_real_elements_tell_their_age_and_what_the_feed_hears_of_them(tmp_path):
    feed = FeedProfile(freq_min_hz=137e6, freq_max_hz=1710e6)
    settings = replace(HERE, feeds={**HERE.feeds, "stock-ku": feed})
    stage = Stage(tmp_path, demo=False, settings=settings)
    stage.step()
    sky = stage.step(30.0)
    assert {row.age.short[-1] for row in sky.rows} <= set("dhn")
    assert all("old" in row.age.words or "ahead" in row.age.words for row in sky.rows)
    assert sky.feed == "stock-ku"
    assert not sky.hear_first, "nobody has said that this feed is mounted"
    heard = {row.name: row.hears for row in sky.rows if row.hears}
    assert "MHz" in heard["METOP-B"]
    assert "METEOR-M 2" not in heard, "it is off the air"
    assert "AQUA" not in heard, "too high for this feed"


def test_without_a_place_there_are_no_passes(tmp_path):
    sky = Stage(tmp_path, settings=Settings(), demo=False).step()
    assert sky.rows == ()
    assert sky.up == ()


def test_the_moon_is_looked_at(stage):
    stage.step()
    stage.source.look_at_moon()
    assert stage.step(1.0).moon is not None


def test_the_app_shows_it_and_a_person_reads_a_list_of_passes(tmp_path):
    async def body():
        paths = Paths.in_folder(tmp_path)
        app = stand_in.app_in("idle")
        app.settings = replace(app.settings, place=DEMO_PLACE)
        app.sky._make = make_sky(HERE, paths, app.session.clock, demo=True, threads=False)
        async with app.run_test(size=(120, 36)) as pilot:
            await pilot.pause()

            async def step(seconds):
                app.session.clock.advance(seconds)
                app.sky.source.step()
                await pilot.pause()
                app.paint()
                await pilot.pause()
                return stand_in.text_of(app)

            sky = await step(1.0)
            later = await step(4.0)
            await pilot.press("f7")
            await pilot.pause()
            await pilot.pause()
            page = await step(1.0)
            await pilot.press("right_square_bracket")
            shifted = await step(0.0)
            return sky, later, page, shifted

    sky, later, page, shifted = asyncio.run(body())
    assert "LEO 1 polar" in sky

    def left(text):
        return [line[:66] for line in text.splitlines()[2:-1]]

    assert left(sky) != left(later), "within five seconds satellites are seen to move"
    assert re.search(r"(reach|AOS) +\d\d:\d\d LEO \d+ \w+ .* \d+m\d\d +\d+° ", page)
    assert "demo orbits" in page
    assert "NOT NOW" in shifted


def test_on_threads_it_starts_in_the_background_and_ends(tmp_path):
    shown = threading.Event()
    source = make_sky(HERE, Paths.in_folder(tmp_path), RealClock(), demo=True)(lambda _: shown.set(), print)
    source.keep(stand_in.at_rest(VirtualClock()), DEMO_PLACE)
    source.start()
    assert not shown.is_set(), "nothing is worked out on the calling thread"
    assert shown.wait(20.0)
    source.close()

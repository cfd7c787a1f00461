"""Own elements, a place and a preset, added from inside the app: keys counted, used at once, errors lose nothing."""

import asyncio
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.config import Settings, load
from birdcage.base.paths import Paths
from birdcage.base.places import moved_settings
from birdcage.base.presets import load_presets
from birdcage.sky.catalogue import Catalogue
from birdcage_tui import main
from birdcage_tui import run as run_module
from birdcage_tui.feeds.sky_feed import make_sky
from birdcage_tui.shown.options import SitePlace
from textual import events
from textual.widgets import Input

SIZES = pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
MOST_KEYS = 6
TLE = (
    "MYSAT\n"
    "1 25544U 98067A   26079.50000000  .00010000  00000-0  18000-3 0  9991\n"
    "2 25544  51.6400 100.0000 0005000  50.0000 310.0000 15.50000000    05\n"
)


def summed(text):
    """Set the right sum of the digits at the end of the lines of a TLE."""

    def line(row):
        if row[:2] not in ("1 ", "2 "):
            return row
        return row[:68] + str(sum(int(c) if c.isdigit() else c == "-" for c in row[:68]) % 10)

    return "\n".join(map(line, text.splitlines())) + "\n"


TLE = summed(TLE)
BAD = TLE.replace("51.6400", "51.64x0")


class Garden:
    """The app over a real catalogue and a real settings file, and a person who types."""

    def __init__(self, folder, app, pilot, paths):
        self.folder, self.app, self.pilot, self.paths = folder, app, pilot, paths
        self.keys = 0

    async def press(self, *keys):
        self.keys += len(keys)
        await self.pilot.press(*keys)
        await self.settle()

    async def type(self, text):
        """Type a text; its letters are not counted."""
        self.app.screen.focused.insert_text_at_cursor(text)
        await self.settle()

    async def paste(self, text):
        self.app.screen.focused.post_message(events.Paste(text))
        await self.settle()

    async def settle(self, seconds=0.0):
        for _ in range(3):
            await self.pilot.pause()
            self.app.session.clock.advance(seconds)
            self.app.sky.source.step()
            self.app.paint()
        await self.pilot.pause()
        return stand_in.text_of(self.app)


def run(test, folder, size=(80, 24)):
    paths = Paths.in_folder(folder)

    def keep_place(lat, lon, height_m, name):
        from birdcage.base.config import edit

        edit(paths.config_file, moved_settings(load(paths.config_file, {}).place, lat, lon, height_m, name or None))

    async def body():
        app = stand_in.app_in("idle", presets_file=paths.presets_file, keep_place=keep_place)
        app.settings = replace(app.settings, place=SitePlace(51.9, 4.8))
        app.sky._make = make_sky(Settings(), paths, app.session.clock, demo=False, threads=False)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            return await test(Garden(folder, app, pilot, paths))

    return asyncio.run(body())


def names(garden):
    with Catalogue(garden.paths.catalogue) as catalogue:
        return [entry.name for entry in catalogue.entries()]


@SIZES
def test_a_file_of_elements_in_two_keys_and_its_passes_on_f7(tmp_path, size, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "own.txt").write_text(TLE)

    async def add(garden):
        await garden.settle()
        await garden.press("I")
        await garden.type("~/own.txt")
        await garden.press("enter")
        assert garden.keys <= MOST_KEYS
        assert names(garden) == ["MYSAT"]
        assert "1 new" in garden.app.view().told[-1].words
        await garden.press("f7")
        return await garden.settle(6.0)

    text = run(add, tmp_path, size)
    assert "MYSAT" in text


@SIZES
def test_pasted_elements_are_taken_whole(tmp_path, size):
    async def add(garden):
        await garden.press("I")
        await garden.paste(TLE)
        await garden.press("enter")
        assert garden.keys <= MOST_KEYS
        return names(garden)

    assert run(add, tmp_path, size) == ["MYSAT"]


def test_omm_in_one_line_is_text_and_no_path(tmp_path):
    async def add(garden):
        await garden.press("I")
        await garden.type('[{"OBJECT_NAME": "NOTHING"}]')
        await garden.press("enter")
        return await garden.settle()

    text = " ".join(run(add, tmp_path, (120, 36)).split())
    assert "No elements added." in text
    assert "pasted text" in text


@SIZES
@pytest.mark.parametrize("from_file", [False, True])
def test_a_damaged_line_is_named_and_what_was_typed_stands_there_to_be_mended(tmp_path, size, from_file):
    (tmp_path / "bad.txt").write_text(BAD)

    async def add(garden):
        await garden.press("I")
        if from_file:
            await garden.type(str(tmp_path / "bad.txt"))
        else:
            await garden.paste(BAD)
        before = garden.app.screen.query_one(Input).value
        await garden.press("enter")
        text = await garden.settle()
        assert garden.app.screen.query_one(Input).value == before
        said = next(row for row in text.splitlines() if "No elements added." in row)
        left = said.rindex("│", 0, said.index("No elements added."))
        box = slice(left + 1, said.index("│", left + 1))  # a long path is wrapped, with the page beside each row of it
        inside = "".join("".join(row[box] for row in text.splitlines()).split())
        assert ("bad.txt:3" if from_file else "pastedtext:3") in inside
        assert "No elements added." in text
        assert not garden.paths.catalogue.exists() or names(garden) == []
        if not from_file:
            await garden.press("home")
            garden.app.screen.query_one(Input).value = before.replace("51.64x0", "51.6400")
            await garden.press("enter")
            assert names(garden) == ["MYSAT"]

    run(add, tmp_path, size)


def test_a_file_that_is_not_there_is_told_and_the_path_stays(tmp_path):
    async def add(garden):
        await garden.press("I")
        await garden.type("/nowhere/x.txt")
        await garden.press("enter")
        text = await garden.settle()
        assert "/nowhere/x.txt" in garden.app.screen.query_one(Input).value
        assert "No elements added." in text
        await garden.press("escape")
        assert len(garden.app.screen_stack) == 1

    run(add, tmp_path)


@SIZES
@pytest.mark.parametrize(
    ("typed", "lat", "lon"), [("Rotterdam", 51.9, 4.5), ("JO21jv", 51.9, 4.8), ("33.5S 151.2E", -33.5, 151.2)]
)
def test_a_place_in_two_keys_counts_at_once_and_is_kept(tmp_path, size, typed, lat, lon):
    async def add(garden):
        await garden.press("L")
        await garden.type(typed)
        await garden.press("enter")
        assert garden.keys <= MOST_KEYS
        place = garden.app.settings.place
        assert (place.latitude_deg, place.longitude_deg) == pytest.approx((lat, lon), abs=0.1)
        kept = load(garden.paths.config_file, {}).place
        assert (kept.latitude_deg, kept.longitude_deg) == (place.latitude_deg, place.longitude_deg)
        seen = garden.app.sky.source._observer
        assert (seen.latitude_deg, seen.longitude_deg) == (place.latitude_deg, place.longitude_deg)
        return garden.app.view().told[-1].words

    assert run(add, tmp_path, size).startswith("Location set: ")


def test_what_is_no_place_is_told_and_stays(tmp_path):
    async def add(garden):
        await garden.press("L")
        await garden.type("JO21")
        await garden.press("enter")
        text = await garden.settle()
        assert garden.app.screen.query_one(Input).value == "JO21"
        assert "six characters" in text
        assert not garden.paths.config_file.exists()

    run(add, tmp_path)


@SIZES
def test_a_preset_of_the_present_direction_and_one_of_typed_angles(tmp_path, size):
    async def add(garden):
        await garden.press("2", "a")
        await garden.type("Here")
        await garden.press("enter")
        assert garden.keys <= MOST_KEYS
        garden.keys = 0
        await garden.press("1")
        garden.keys = 0
        await garden.press("2", "a")
        await garden.type("Wall")
        await garden.press("tab")
        await garden.press(*"200")
        await garden.press("tab")
        await garden.press(*"30")
        await garden.press("enter")
        assert garden.keys - len("200") - len("30") <= MOST_KEYS

    run(add, tmp_path, size)
    here, wall = load_presets(Paths.in_folder(tmp_path).presets_file).entries
    assert (here.name, here.az_deg, here.el_deg) == ("Here", 189.16, 42.87)
    assert (wall.name, wall.az_deg, wall.el_deg) == ("Wall", 200.0, 30.0)


@SIZES
def test_the_palette_finds_all_three(tmp_path, size):
    async def find(garden):
        for word in ("add elements", "set location", "preset"):
            await garden.press("colon")
            await garden.type(word)
            for _ in range(5):
                await garden.pilot.pause(0.05)
            assert word.split()[-1].lower() in stand_in.text_of(garden.app).lower()
            await garden.press("escape")
            await garden.press("escape")

    run(find, tmp_path, size)


def test_a_place_that_is_set_in_the_demo_counts_over_the_one_it_began_with(tmp_path):
    paths = Paths.in_folder(tmp_path)
    session, settings, _services = run_module._build(main.parser().parse_args(["--demo"]), paths)
    try:
        before = settings.setup()
        settings.keep_place(-33.5, 151.2, 0.0, "Sydney")
        before.read_place()
        for engine in (before, settings.setup()):
            place = engine.settings.place
            assert (place.name, place.latitude_deg, place.longitude_deg) == ("Sydney", -33.5, 151.2)
    finally:
        session.close()


@pytest.mark.parametrize("size", [(40, 12), (80, 24), (120, 36)], ids=str)
def test_what_is_understood_of_a_place_stands_under_the_field_while_one_types(tmp_path, size):
    async def add(garden):
        await garden.press("L")
        told = []
        for text in ("rotterdam", "rotterdxm", "JO21jv", "51.9 4.8 12", "springfield", ""):
            garden.app.screen.focused.value = text
            told.append(" ".join((await garden.settle()).replace("│", " ").split()))
        return told, garden.app.settings.place

    told, place = run(add, tmp_path, size)
    for text, words in zip(
        told,
        ("Rotterdam, NL: 51.92", "No city called 'rotterdxm'", "51.8958° N, 4.7917° E", "51.9000° N, 4.8000° E, 12 m",
         "Which one? Springfield, US"),
        strict=False,
    ):  # fmt: skip
        assert words in text, text
    assert "No city" not in told[-1], "nothing is said of an empty field"
    assert place == SitePlace(51.9, 4.8), "and nothing is set before Enter"

"""The horizon on F2: marked where the dish rests, recorded while jogging, typed, taken back, cleared, and drawn."""

from dataclasses import replace

import pytest
import sky_stand_in
import stage
import stand_in
import track_stand_in
from birdcage.base.config import load
from birdcage.base.paths import throw_away_paths
from birdcage.sky.horizon import HorizonMask
from birdcage.station.requests import Goto, Jog
from birdcage.station.state import Activity
from birdcage_tui.commands import BY_NAME
from birdcage_tui.commands.horizon import can_mark
from birdcage_tui.control.horizon_hands import point_of
from birdcage_tui.feeds.horizon_file import ConfigHorizon
from birdcage_tui.widgets.pane import Pane
from horizon_stand_in import TREES, File
from textual.widgets import Input

SIZES = [(80, 24), (100, 30), (120, 36), (160, 48), (200, 60)]


def run(test, name="idle", size=(120, 36), file=None, **options):
    return stage.run(test, name, size, key="f2", horizon=File() if file is None else file, **options)


async def settled(app, pilot):
    await pilot.pause()
    app.paint()
    await pilot.pause()
    await pilot.pause()
    return stand_in.text_of(app)


async def stands(app, pilot, az_deg, el_deg, after_s=0.5):
    """Let the dish rest there, read just now, some time later."""
    clock, state = app.session.clock, app.station.state
    clock.advance(after_s)
    app.motions.under_way.clear()
    position = replace(state.position, az_deg=az_deg, el_deg=el_deg, at=clock.monotonic())
    link = replace(state.link, last_reply=clock.monotonic())
    app.station.state = replace(state, position=position, link=link)
    return await settled(app, pilot)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_where_the_dish_points_becomes_a_point_and_is_told_in_words(size):
    async def mark(app, pilot):
        await pilot.press("m")
        return await settled(app, pilot), app.view().horizon.mask, app.station.asked_for(Jog)

    file = File(HorizonMask([(10, 4), (20, 5)]))
    text, mask, asked = run(mark, size=size, file=file)
    row = text.splitlines()[-2 - (size[0] >= 100)]  # the pages stand below
    assert "Horizon 42.9° at 189.2° saved, 3 points." in row
    assert mask == file.mask == HorizonMask([(10, 4), (20, 5), (189.16, 42.87)])
    assert asked == []


def test_one_point_hides_nothing_and_says_so():
    async def mark(app, pilot):
        await pilot.press("m")
        return await settled(app, pilot)

    text = run(mark, size=(160, 48), file=File(HorizonMask()))
    assert "1 point. It applies to all azimuths until you add more." in text
    assert "horizon 1 point, no line yet" in text
    assert "horizon  42.9°" not in text


@pytest.mark.parametrize(
    ("name", "change", "says"),
    [
        ("lost", {}, "does not answer"),
        ("not-homed", {}, "position is unknown"),
        ("slewing", {}, "moving"),
        ("travler-slew", {}, "only modelled"),
        ("late", {}, "is 2 s old"),
        ("idle", {"activity": Activity.UNKNOWN, "raw_activity": True}, "moving or may move"),
    ],
)
def test_only_what_was_just_read_at_rest_is_a_point(name, change, says):
    async def mark(app, pilot):
        await pilot.press("m")
        return await settled(app, pilot), can_mark(app.view())

    file = File()
    text, reason = run(mark, name, (160, 48), file=file, state=change)
    assert says in reason
    assert reason in text
    assert file.mask == TREES


def test_a_dish_that_leans_back_marks_nothing():
    async def reason(app, _pilot):
        position = replace(app.station.state.position, el_deg=91.0)
        app.station.state = replace(app.station.state, position=position)
        return can_mark(app.view())

    assert "beyond the zenith" in run(reason)


def test_each_rest_after_a_jog_is_a_point_while_recording():
    async def record(app, pilot):
        await pilot.press("M")
        on = await settled(app, pilot)
        kept = []

        async def rest(az_deg, el_deg, looks=4):
            for _ in range(looks):
                await stands(app, pilot, az_deg, el_deg)
            kept.append(app.horizon.mask.points)

        await rest(189.16, 42.87)  # nothing was jogged yet
        await pilot.press("right")
        await rest(200.0, 20.0)
        await rest(200.0, 20.0)  # once is enough
        await pilot.press("up")
        await rest(200.0, 25.0)  # measured again: the one before was in the trees
        await pilot.press("right")
        await rest(210.0, 25.0, looks=2)  # only half a second
        await rest(220.0, 25.0, looks=1)
        app.ask(Goto(90.0, 60.0, "you"))
        await rest(90.0, 60.0)  # a look elsewhere is no tree
        await pilot.press("M", "right")
        await rest(230.0, 30.0)
        return on, kept, await settled(app, pilot)

    on, kept, off = run(record, file=File(HorizonMask()))
    assert "● RECORDING  flat" in on
    assert "● recording" in on
    assert " M end " in on
    assert kept == [(), ((200.0, 20.0),), ((200.0, 20.0),), *[((200.0, 25.0),)] * 5]
    assert "RECORDING" not in off


def test_a_dish_that_is_not_read_after_the_jog_gives_no_point():
    async def record(app, pilot):
        await pilot.press("M", "right")
        app.motions.under_way.clear()
        for _ in range(3):
            app.session.clock.advance(0.55)  # the position stays the one from before
            await settled(app, pilot)
        return app.horizon.mask

    assert run(record) == TREES


def test_a_point_is_typed_and_a_wrong_one_says_why():
    async def enter(app, pilot):
        await pilot.press("t")
        await pilot.pause()
        app.screen.query_one(Input).value = "231 north"
        await pilot.press("enter")
        wrong = await settled(app, pilot)
        app.screen.query_one(Input).value = "231 12,3"
        await pilot.press("enter")
        return wrong, await settled(app, pilot)

    file = File()
    wrong, text = run(enter, file=file)
    assert "Type two numbers in degrees" in wrong
    assert "Horizon 12.3° at 231.0° saved, 5 points." in text
    assert (231.0, 12.3) in file.mask.points


@pytest.mark.parametrize(
    ("text", "point"),
    [
        ("231 12.3", (231.0, 12.3)),
        ("231,12", (231.0, 12.0)),
        ("231,5 12,25", (231.5, 12.25)),
        ("231.5, 12.3", (231.5, 12.3)),
        ("231° / −1.5°", (231.0, -1.5)),
        ("-90 3", (270.0, 3.0)),
        ("360 3", (0.0, 3.0)),
    ],
)
def test_what_a_point_may_be_typed_as(text, point):
    assert point_of(text) == point


@pytest.mark.parametrize("text", ["", "12", "1 2 3", "nan 3", "400 3", "10 91", "1,2,3", "N 12"])
def test_what_is_no_point(text):
    with pytest.raises(ValueError, match=r"Type two numbers|full turn|is out of range"):
        point_of(text)


def test_changes_are_taken_back_one_by_one():
    async def undo(app, pilot):
        await pilot.press("m")
        marked = app.horizon.mask
        await pilot.press("Z", "y")
        flat = await settled(app, pilot)
        cleared = app.horizon.mask
        await pilot.press("z")
        back = app.horizon.mask
        await pilot.press("z")
        words = await settled(app, pilot)
        await pilot.press("z")
        return marked, cleared, back, flat, words, await settled(app, pilot)

    file = File()
    marked, cleared, back, flat, words, nothing = run(undo, file=file)
    assert len(marked.points) == 5
    assert cleared == HorizonMask()
    assert "The horizon is flat now. z: undo." in flat
    assert back == marked
    assert "Horizon: undid 42.9° at 189.2°, 4 points." in words
    assert "No horizon changes to undo" in nothing
    assert file.mask == TREES


def test_clearing_asks_first():
    async def leave(app, pilot):
        await pilot.press("Z")
        text = await settled(app, pilot)
        await pilot.press("escape")
        return text, app.horizon.mask

    text, mask = run(leave)
    assert "4 points" in text
    assert mask == TREES


def test_a_file_that_cannot_be_written_changes_nothing_and_says_why():
    async def mark(app, pilot):
        await pilot.press("m")
        return await settled(app, pilot), app.horizon.mask

    file = File()
    file.wrong = "The disk is full."
    text, mask = run(mark, file=file)
    assert "The disk is full." in text
    assert mask == TREES


def test_what_another_program_has_written_since_is_what_is_changed():
    async def mark(app, pilot):
        file.mask = HorizonMask([(5, 5)])
        await pilot.press("m")
        await pilot.press("z")
        await settled(app, pilot)
        return file.mask

    file = File()
    assert run(mark, file=file) == HorizonMask([(5, 5)])


def test_without_a_file_the_keys_say_so():
    async def keys(app, pilot):
        found = []
        for key in "mMtZ":
            await pilot.press(key)
            found.append((await settled(app, pilot)).splitlines()[-3])
        return found

    for row in stage.run(keys, "idle", (120, 36), key="f2"):
        assert "This app has no horizon file." in row


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "travler"])
def test_the_keys_can_be_seen_and_clicked(name, size):
    async def targets(app, pilot):
        return {
            command
            for pane in app.query(Pane)
            for spot, command in pane.hot
            if pane.is_on_screen and pane.content_region.contains_region(spot.translate(pane.content_region.offset))
        }

    found = run(targets, name, size)
    assert {"horizon-mark", "horizon-record", "horizon-undo"} <= found
    if size[1] >= 36:
        assert {"horizon-type", "horizon-clear"} <= found


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_elevation_arc_says_how_high_the_trees_stand_here(size):
    async def both(app, pilot):
        trees = stand_in.text_of(app)
        app.horizon.mask = HorizonMask()
        return trees, await settled(app, pilot)

    trees, flat = run(both, size=size)
    assert "horizon  12.5°" in trees
    assert "horizon  12" not in flat


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_rose_draws_the_skyline_as_the_sky_map_has_it(size):
    async def row(app, pilot):
        pane = app.query_one("#rose")
        shown = ["".join(segment.text for segment in strip) for strip in pane._strips]
        app.horizon.mask = HorizonMask()
        await settled(app, pilot)
        flat = ["".join(segment.text for segment in strip) for strip in pane._strips]
        return [sum(a != b for a, b in zip(*rows, strict=True)) for rows in zip(shown, flat, strict=True)]

    changed = run(row, size=size, file=File(HorizonMask([(90, 30), (270, 30)])))
    assert sum(1 for count in changed if count) > len(changed) / 2


def test_every_key_is_in_help_and_palette():
    for name, key in (("mark", "m"), ("record", "M"), ("type", "t"), ("undo", "z"), ("clear", "Z")):
        command = BY_NAME[f"horizon-{name}"]
        assert command.keys == (key,)
        assert command.title
        assert command.help


def test_the_sky_and_the_pursuit_desk_hear_of_it_at_once():
    async def mark(app, pilot):
        before = sky_stand_in.Source.made[-1].horizon
        await pilot.press("m")
        app._tick()
        return before, sky_stand_in.Source.made[-1].horizon, track_stand_in.Source.made[-1].horizon

    before, after, tracked = run(mark, sky=sky_stand_in.make(), track=track_stand_in.Source(track_stand_in.desk()))
    assert before == TREES
    assert (189.16, 42.87) in after.points
    assert tracked == after


# The file.


@pytest.fixture
def paths():
    with throw_away_paths() as found:
        found.config_file.parent.mkdir(parents=True, exist_ok=True)
        found.config_file.write_text("[place]\nhorizon = [[10, 4]]\n")
        yield found


def horizon_of(paths, environ=None, flags=None):
    def again():
        return load(paths.config_file, environ=environ or {}, flags=flags)

    return ConfigHorizon(paths, again(), again)


def test_points_are_kept_in_the_settings_file(paths):
    async def mark(app, pilot):
        await pilot.press("m")
        return await settled(app, pilot)

    file = horizon_of(paths)
    assert file.begin == HorizonMask([(10, 4)])
    assert "2 points" in run(mark, file=file)
    assert load(paths.config_file, environ={}).place.horizon == ((10.0, 4.0), (189.16, 42.87))


def test_points_that_cannot_be_read_are_not_overwritten(paths):
    paths.config_file.write_text('[place]\nhorizon = [[10, "four"]]\n')

    async def mark(app, pilot):
        await pilot.press("m")
        return await settled(app, pilot)

    assert "The horizon was not saved" in run(mark, file=horizon_of(paths))
    assert paths.config_file.read_text() == '[place]\nhorizon = [[10, "four"]]\n'

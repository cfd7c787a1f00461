"""The selected pass over the sky: its name and times beside the marks, and the figures, each where it can be read."""

import re

import pytest
import sky_stand_in
from birdcage_tui.passes.listing import PassList
from birdcage_tui.passes.plot import PassSky
from stage import run
from stand_in import text_of

NAME = "LEO 12 station"


def near_the_rim(before_los_s):
    """Passes that set soon, one at each part of the rim, the next to set first."""
    found = []
    for place, az_deg in enumerate(range(0, 360, 40)):
        path = sky_stand_in.path_of(sky_stand_in.NOON - 440.0 + before_los_s + place, 440.0, az_deg + 100, az_deg, 12)
        times_s, azimuths = (tuple(each[index] for index in (0, 60, -1)) for each in (path.t_s, path.az_deg))
        reach = sky_stand_in.reach_of(path)
        row = sky_stand_in.shown_pass(NAME, 12000 + place, times_s, azimuths, 12.0, reach=reach, path=path)
        found.append(sky_stand_in.changed(row, favourite=True, groups=("weather",)))
    return tuple(found)


def plots(size, rows, presses):
    """The rows inside the frame of the path, for each pass in turn."""

    async def each(app, pilot):
        found = []
        for _ in range(presses):
            app.paint()
            await pilot.pause()
            where = app.query_one(PassSky).content_region
            lines = text_of(app).splitlines()[where.y : where.bottom]
            found.append([line[where.x : where.right] for line in lines])
            await pilot.press("down")
            await pilot.pause()
        return found

    return run(each, "idle", size, key="f7", sky=sky_stand_in.make(rows=rows))


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
@pytest.mark.parametrize("before_los_s", [20.0, 420.0])
def test_a_name_near_the_rim_is_whole_and_touches_neither_times_nor_figures(size, before_los_s):
    rows = near_the_rim(before_los_s)
    for lines in plots(size, rows, len(rows)):
        text = "\n".join(lines)
        named = [line for line in lines if NAME in line]
        assert text.count(NAME) == 2, text  # beside the mark, and above the figures
        for line in named:
            assert not re.search(rf"[\w°:]{NAME}|{NAME}[\w°:]", line), text
        assert text.count("✕") == 1
        assert sum(bool(re.search(rf"(?<![A-Za-z]){sign}(?![A-Za-z])", text)) for sign in "NESW") >= 3, text
        for time in re.findall(r".?\d\d:\d\d.?", "\n".join(line for line in lines if "in" not in line)):
            assert not time[0].isalpha(), text
        assert "never in reach" in text


@pytest.mark.parametrize("size", [(80, 24), (100, 30), (120, 36), (160, 48)], ids=str)
def test_what_is_told_of_the_elements_is_whole_or_its_age_alone(size):
    lines = run(read_figures, "fault", size, key="f7", sky=sky_stand_in.make())
    told = " ".join(line.strip() for line in lines)
    told = told[told.index("elements") :]
    assert told.startswith("elements 1 d old"), lines
    assert "about" not in told or "about ±0.26° (90 %: 2.2°) at closest" in told, lines


async def read_figures(app, _pilot):
    """What stands under or beside the map of the sky, without the map."""
    where = app.query_one(PassSky).content_region
    lines = [line[where.x : where.right] for line in text_of(app).splitlines()[where.y : where.bottom]]
    first = next(line for line in lines if "59051" in line)
    if lines.index(first):
        return lines[lines.index(first) :]
    return [line[first.index("★") :] for line in lines]


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (240, 70)], ids=str)
def test_the_signs_of_reach_are_explained_on_the_list(size):
    async def title(app, _pilot):
        where = app.query_one(PassList).region
        return text_of(app).splitlines()[where.y][where.x : where.right]

    assert "● all, ◍ part, ○ none in reach" in run(title, "idle", size, key="f7", sky=sky_stand_in.make())

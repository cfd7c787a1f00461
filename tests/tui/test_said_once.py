"""What is wrong is said once on a page, and large terminals show more, not larger charts."""

import re

import pytest
import sky_stand_in
from birdcage_tui.panes.next import NextPane
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.shown.next_passes import next_rows
from birdcage_tui.widgets.skew import SkewPane
from stage import read, run

SIZES = [(80, 24), (120, 36), (160, 48), (240, 70)]


def flat(text):
    return re.sub(r"[\s│╭╮╰╯─]+", " ", text)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(
    ("state", "sentences"),
    [
        ("fault", ("stalled at 203.1°", "Something holds the dish", "Clear its swing")),
        ("lost", ("is not there", "was moving", "Plug it in")),
    ],
)
def test_a_fault_and_a_lost_link_are_said_once(state, sentences, size):
    text = run(read, state, size)
    for sentence in sentences:
        assert flat(text).count(sentence) == 1, text
    assert "The adapter is gone" not in text
    assert len(re.findall(r"AZ[ ~]", text)) == 1, "the angles stand in row 1, and as digits"


@pytest.mark.parametrize(("state", "chart"), [("slewing", SignalPane), ("travler", SkewPane)])
def test_a_tall_terminal_shows_more_passes_and_no_taller_chart(state, chart):
    async def rows(app, _pilot):
        view = app.query_one(NextPane).view
        cells = app.query_one(NextPane)._cells
        lines = ["".join(row) for row in cells._chars]
        return app.query_one(chart).size.height, [line for line in lines if "in reach" in line], next_rows(view)

    height, lines, coming = run(rows, state, (240, 70), heard=state == "slewing", sky=sky_stand_in.make())
    assert height <= 14
    assert len(lines) >= 12
    assert len(coming) >= len(lines)
    assert all(re.search(r"\d+° to +\d+° +max +\d+°", line) for line in lines), "where it rises and sets"


def test_the_scale_of_elevation_and_its_words_do_not_touch_at_80x24():
    text = run(read, "slewing", (80, 24), key="f2")
    for words in ("ceiling", "floor"):
        row = next(row for row in text.splitlines() if words in row)
        assert re.search(rf"│ +{words} +\d", row), row
    assert not re.search(r"65° *\n?.*\b60 ", text), text


def test_control_and_passes_fill_a_tall_terminal_with_what_comes_next():
    control = run(read, "slewing", (240, 70), key="f2", sky=sky_stand_in.make())
    assert "In reach now and next" in control
    assert "NOAA 20 (JPSS-1)" in control
    assert "In reach now and next" not in run(read, "slewing", (80, 24), key="f2", sky=sky_stand_in.make())
    passes = run(read, "slewing", (240, 70), key="f7", sky=sky_stand_in.make())
    timeline = passes[passes.index("Timeline of favourites, then of what comes next") :]
    lanes = [row[1:20].strip() for row in timeline.splitlines()[2:]]
    assert lanes[:4] == ["METEOR-M2 4", "ISS (ZARYA)", "METEOR-M2 3", "METOP-C"]
    assert "NOAA 20 (JPSS-1)" in lanes


def test_a_page_that_is_to_come_says_what_to_use_until_then():
    for key in ("f6", "f10"):
        text = flat(run(read, "idle", (240, 70), key=key))
        assert "Until then:" in text, text


def test_open_steps_of_a_tall_setup_say_what_they_ask():
    text = run(read, "idle", (240, 70), key="f8")
    assert "Which feed is fitted? Frequencies and offsets come from it." in text
    assert "Where does the dish stand?" in text
    assert "Which feed is fitted?" not in run(read, "idle", (120, 36), key="f8")

"""Every place at sizes that no layout was made for: inside the screen, over nothing else, and no word cut."""

import itertools

import pytest
from birdcage_tui.widgets.dialogs import AnswerRow
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.status import BadDayRow, StatusLine, StopButton
from places import BY_NAME, PLACES, Place, at, settle
from stand_in import text_of
from textual.widgets import Input, OptionList, Static

SIZES = [(81, 25), (99, 29), (100, 30), (149, 40)]
PAGES = [
    Place("dashboard", ()), Place("control", ("f2",)), Place("presets", ("f2", "p")), Place("console", ("f5",)),
    Place("console over control", ("f2", "f5")), Place("line", ("f5", "i")), Place("find", ("f5", "slash")),
    *(BY_NAME[f"setup, {engine}"] for engine in ("home", "mute", "feed", "place", "north")),
]  # fmt: skip
DIALOGS = [place for place in PLACES if place.dialog and "pocket" not in place.name]
EVERYWHERE = [place for place in DIALOGS if not place.keys[0].startswith("f")]
"""Those that the pocket view has, too."""
PARTS = (Pane, Input, Static, OptionList)
OVER = {"ConsoleOverlay", "GotoLine"}
"""What lies over a page by design."""


def parts(screen):
    """What is drawn on the screen and holds nothing else, with its place; what the console lies over is left out."""
    found = [
        widget
        for kind in PARTS
        for widget in screen.query(kind)
        if all(each.display for each in widget.ancestors_with_self)
        and widget.is_on_screen
        and not (isinstance(widget, Static) and not str(widget.render()))
    ]
    over = [each for each in screen.query("*") if type(each).__name__ in OVER and each.display]
    return [
        widget for widget in found
        if all(each in widget.ancestors or not each.region.overlaps(widget.region) for each in over)
    ]  # fmt: skip


def assert_whole(app, places):
    """Assert that each part lies in its own holder and in the screen, and over no other."""
    for part in places:
        assert part.region.area > 0, part
        assert app.screen.region.contains_region(part.region), (part, part.region)
        holder = part.parent
        if holder.region.area:  # none: the list of the palette is drawn over the screen
            assert holder.region.contains_region(part.region) or holder.allow_vertical_scroll, (part, holder)
    for one, other in itertools.combinations(places, 2):
        if one not in other.ancestors and other not in one.ancestors:
            assert not one.region.overlaps(other.region), (one, one.region, other, other.region)


def cut_words(app, place):
    """Every row of the screen in which a word is cut. The list of steps cuts its evidence, and tells it whole below."""
    rows = [row for row in text_of(app).splitlines() if "…" in row]
    return [row for row in rows if not place.name.startswith("setup") or row.startswith("╭")]


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("place", PAGES, ids=lambda place: place.name)
def test_every_part_is_whole_and_over_no_other(place, size, tmp_path):
    async def look(app, pilot, _):
        await settle(app, pilot)
        places = parts(app.screen)
        for kind in (StatusLine, StopButton, BadDayRow, KeyBar):
            assert any(isinstance(part, kind) for part in places), kind
        assert_whole(app, places)
        return cut_words(app, place)

    assert at(place, tmp_path, look, size=size) == []


@pytest.mark.parametrize(
    ("place", "size"),
    [(place, (81, 25)) for place in DIALOGS] + [(place, size) for place in EVERYWHERE for size in [(40, 12), (79, 23)]],
    ids=lambda each: each.name if isinstance(each, Place) else str(each),
)
def test_every_dialog_is_whole_under_row_1(place, size, tmp_path):
    async def look(app, pilot, _):
        assert type(app.screen).__name__ == place.dialog
        places = [part for part in parts(app.screen) if "jump" not in part.classes]
        assert any(isinstance(part, StopButton) for part in places)
        inside = [part for part in places if not isinstance(part, Static) or isinstance(part, AnswerRow)]
        assert_whole(app, inside)
        frame = next((each for each in app.screen.children if each.border_title), None)
        assert (frame is None) is (place.dialog in ("JumpScreen", "ReplayScreen"))
        if frame is not None:
            assert len(str(frame.border_title)) + 4 <= frame.size.width
        return [str(part.render()) for part in places if isinstance(part, AnswerRow)], text_of(app)

    answers, text = at(place, tmp_path, look, size=size)
    for answer in answers:
        assert answer.strip() in text

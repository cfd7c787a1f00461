"""NO_COLOR and terminals of few colours: what colours say is said by attributes, signs and words too."""

import asyncio

import pytest
import stage
import stand_in
from birdcage_tui.drawing import attributes
from birdcage_tui.drawing.themes import LOOKS
from rich.color import ColorSystem


def pieces(app):
    return [[(text, style) for text, style, _ in strip] for strip in app.screen._compositor.render_strips()]


def rows(state, *keys, size=(80, 24), theme="dusk"):
    """Every row as (text, style) pieces, as they go to a terminal."""

    async def main():
        app = stand_in.app_in(state, theme=theme)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            for key in keys:
                await pilot.press(key)
                await pilot.pause()
            await pilot.wait_for_scheduled_animations()
            app.paint()
            await pilot.pause()
            return pieces(app)

    return asyncio.run(main())


def style_of(found, words):
    """The style of the piece that holds these words."""
    return next(style for row in found for text, style in row if words in text)


@pytest.fixture
def no_color(monkeypatch):
    monkeypatch.setenv("NO_COLOR", "1")


@pytest.mark.parametrize(
    ("environ", "without"),
    [({"NO_COLOR": "1"}, True), ({"NO_COLOR": ""}, False), ({"TERM": "vt100"}, True), ({"TERM": "dumb"}, True),
     ({"TERM": "linux"}, False), ({"TERM": "xterm-16color"}, False), ({}, False)],
)  # fmt: skip
def test_when_there_are_no_colours(environ, without):
    assert attributes.wanted(environ) is without


@pytest.mark.usefixtures("no_color")
@pytest.mark.parametrize("theme", LOOKS)
@pytest.mark.parametrize("keys", [(), ("H",), ("g",), ("question_mark",), ("colon",), ("semicolon",)], ids=str)
def test_no_colour_goes_out(keys, theme):
    coloured = [
        (text, str(style))
        for row in rows("held", *keys, theme=theme)
        for text, style in row
        if style is not None and not (style.color is None and style.bgcolor is None)
    ]
    assert coloured == []


@pytest.mark.usefixtures("no_color")
@pytest.mark.parametrize("theme", LOOKS)
@pytest.mark.parametrize("size", [(80, 24), (40, 12)], ids=str)
def test_what_is_wrong_stands_out_without_colour(size, theme):
    async def look_at(app, _pilot):
        return pieces(app)

    wrong = {"held": "■ HELD", "fault": "✖ FAULT", "lost": "○ LINK LOST", "not-homed": "▲ NOT HOMED"}
    for state, found in stage.run_each(look_at, tuple(wrong), size, theme=theme).items():
        assert style_of(found, wrong[state]).reverse, state
        assert style_of(found, "STOP" if size == (80, 24) else "S T O P").reverse, state
        assert not style_of(found, "12:00:00Z").reverse, state


@pytest.mark.usefixtures("no_color")
@pytest.mark.parametrize("theme", LOOKS)
def test_keys_that_hold_and_keys_that_do_not_look_different(theme):
    lost, idle = rows("lost", theme=theme)[-1:], rows("idle", theme=theme)[-1:]
    assert style_of(lost, " g ").dim
    assert style_of(lost, " H ").dim
    assert not style_of(lost, " H ").bold
    fault = rows("fault", theme=theme)
    lit = [text for text, style in fault[-1] if " H " in text and style.bold]
    assert lit == [], "refused until the fault is acknowledged"
    assert any("FAULT, at rest" in "".join(text for text, _ in row) for row in fault)
    assert style_of(idle, " H ").bold
    assert not style_of(idle, " H ").dim


@pytest.mark.usefixtures("no_color")
@pytest.mark.parametrize("theme", LOOKS)
def test_cursors_and_labels_are_reversed_and_frames_quiet(theme):
    assert style_of(rows("idle", "question_mark", "down", theme=theme), "Stop everything now").reverse
    assert style_of(rows("idle", "semicolon", theme=theme), " s ").reverse
    page = rows("idle", theme=theme)
    assert style_of(page, "╭").dim
    assert not style_of(page, "IDLE, at rest").dim


@pytest.mark.usefixtures("no_color")
@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_the_frame_of_what_has_the_focus_is_bold(look):
    from rich.style import Style

    focused = attributes.without_colour(Style(color=look.focus, bgcolor=look.ground), look)
    other = attributes.without_colour(Style(color=look.line, bgcolor=look.ground), look)
    assert (focused.bold, focused.dim) == (True, False)
    assert (other.bold, other.dim) == (False, True)


def test_what_a_click_finds_is_kept():
    from rich.style import Style

    style = attributes.without_colour(Style(color="#ffffff", meta={"option": 3}), LOOKS["dusk"])
    assert style.meta == {"option": 3}
    assert style.color is None


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_in_16_colours_nothing_that_is_read_vanishes(look):
    def in_16(colour):
        return colour.downgrade(ColorSystem.STANDARD).number

    for name, style in look.inks.items():
        if name != "faint":
            assert in_16(style.color) != in_16(style.bgcolor), name
    assert in_16(look.inks["dim"].color) != in_16(look.inks["text"].color)
    if look.name != "night":
        for one, other in (("accent", "dim"), ("accent", "text"), ("target", "warn"), ("warn", "text")):
            assert in_16(look.inks[one].color) != in_16(look.inks[other].color), (one, other)
    for name in ("warn-row", "fault-row"):
        if look.name != "night":
            assert in_16(look.inks[name].bgcolor) != in_16(look.inks["text"].bgcolor), name


@pytest.mark.parametrize(
    ("environ", "underlined"),
    [({"NO_COLOR": "1"}, True), ({"TERM": "xterm-16color", "COLORTERM": ""}, True), ({"TERM": "linux"}, True),
     ({"TERM": "xterm-256color"}, False)],
    ids=str,
)  # fmt: skip
def test_a_text_field_can_be_told_from_the_page_where_its_ground_cannot(environ, underlined, monkeypatch):
    monkeypatch.delenv("COLORTERM", raising=False)
    monkeypatch.setattr("rich.console.Console.is_terminal", True)
    for name, value in environ.items():
        monkeypatch.setenv(name, value)
    assert bool(style_of(rows("idle", "g"), "nter goes there").underline) is underlined
    assert bool(style_of(rows("idle", "g", "q", "q"), "qq").underline) is underlined

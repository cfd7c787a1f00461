"""Circles are round on terminals whose characters are not twice as tall as wide."""

import struct
import sys

import pytest
from birdcage.base.config import load
from birdcage_tui.control.compass import Compass
from birdcage_tui.control.elevation import Quarter
from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.drawing.terminal_cells import CellAnswers, window_aspect
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.widgets.skew import SkewPane
from stage import run

ASPECTS = (1.6, 2.0, 2.1, 2.5)


def extent(canvas, aspect):
    """Width and height of everything drawn, in widths of a cell."""
    spots = [
        (2 * (index % canvas.width) + right, 4 * (index // canvas.width) + down)
        for index, bits in enumerate(canvas._bits)
        for right, column in enumerate(((0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80)))
        for down, bit in enumerate(column)
        if bits & bit
    ]
    across, along = ([spot[axis] for spot in spots] for axis in (0, 1))
    return (max(across) - min(across)) / 2, (max(along) - min(along)) / 4 * aspect


@pytest.mark.parametrize("aspect", ASPECTS)
@pytest.mark.parametrize("size", [(40, 20), (60, 20), (30, 40)], ids=str)
def test_the_rim_of_sky_and_rose_is_as_wide_as_it_is_tall(size, aspect):
    for shape in (Polar(*size, aspect), Compass(*size, aspect)):
        canvas = Braille(*size)
        canvas.circle(*shape.middle, shape.radius, "dim", dot_aspect=shape.dot_aspect)
        width, height = extent(canvas, aspect)
        assert abs(width - height) <= 1.0, shape
        assert width <= size[0]
        assert height <= size[1] * aspect
        for az_deg in range(0, 360, 15):
            column, row = shape.cell(az_deg, 45.0) if isinstance(shape, Polar) else shape.cell(az_deg, 0.5)
            found = shape.direction(column, row)
            found = found[0] if isinstance(found, tuple) else found
            assert abs((found - az_deg + 180) % 360 - 180) < 12, "a click lands where the mark was drawn"


@pytest.mark.parametrize("aspect", ASPECTS)
def test_the_arc_of_elevation_is_a_quarter_of_a_circle(aspect):
    quarter = Quarter(40, 20, aspect=aspect)
    (x0, y0), (right, _), (_, top) = quarter.hub, quarter.dot(0.0), quarter.dot(90.0)
    assert (right - x0) / 2 == pytest.approx((y0 - top) / 4 * aspect)


@pytest.mark.parametrize("aspect", ASPECTS)
def test_the_arc_of_the_skew_is_half_a_circle(aspect):
    async def shape(app, _pilot):
        cells = app.query_one(SkewPane)._cells
        spots = [(x, y) for y, row in enumerate(cells._chars) for x, char in enumerate(row)
                 if "\u2801" <= char <= "\u28ff" and cells._inks[y][x] == "dim"]  # fmt: skip
        across, along = ([spot[axis] for spot in spots] for axis in (0, 1))
        return max(across) - min(across), (max(along) - min(along)) * aspect

    width, height = run(shape, "travler", (240, 70), heard=False, cell_aspect=aspect)
    assert abs(width / 2 - height) <= 2 * aspect


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pty")
def test_the_kernel_is_asked_for_the_window_in_pixels():
    import fcntl
    import os
    import termios

    ours, theirs = os.openpty()
    try:
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 80 * 8, 24 * 18))
        assert window_aspect(theirs) == 2.25
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        assert window_aspect(theirs) is None
    finally:
        os.close(ours)
        os.close(theirs)


def test_what_a_terminal_answers_is_no_key_wherever_it_is_cut():
    whole = "a\x1b[6;20;9t\x1b[4;480;720tb\x1b[6~\x1b"
    for cut in range(len(whole) + 1):
        answers = CellAnswers()
        seen = answers.take(whole[:cut], due=True) + answers.take(whole[cut:], due=True) + answers.pause()
        assert seen == "ab\x1b[6~\x1b", cut
        assert answers.cell == (9, 20)
        assert answers.aspect(80, 24) == pytest.approx(20 / 9)


def test_an_esc_alone_is_a_key_at_once_when_no_answer_is_due():
    assert CellAnswers().take("\x1b") == "\x1b"
    assert CellAnswers().take("\x1b[") == "\x1b["


def test_the_text_area_serves_where_the_character_is_not_told_and_nonsense_does_not():
    answers = CellAnswers()
    answers.take("\x1b[4;480;720t")
    assert answers.aspect(80, 24) == pytest.approx(20 / 9)
    answers.take("\x1b[6;1;900t")
    assert answers.aspect(80, 24) == pytest.approx(20 / 9)
    assert CellAnswers().aspect(80, 24) is None


@pytest.mark.parametrize(("set_by_hand", "wide"), [(False, True), (True, False)])
def test_the_sky_takes_the_shape_that_the_terminal_tells_unless_a_setting_does(set_by_hand, wide):
    async def told(app, pilot):
        before = app.query_one(SkyPane).size.width
        app.cell_aspect_told(2.5)
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return app.query_one(SkyPane).size.width - before

    assert (run(told, "idle", (200, 40), cell_aspect_set=set_by_hand) > 10) is wide


def test_the_setting_is_read(tmp_path):
    file = tmp_path / "birdcage.toml"
    file.write_text("[app]\ncell_aspect = 2.2\n")
    assert load(file, environ={}).app.cell_aspect == 2.2
    file.write_text("")
    assert load(file, environ={}).app.cell_aspect is None

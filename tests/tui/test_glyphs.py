"""Glyph sets: nothing but ASCII on any page in `ascii`, signs that stay different, cells that keep their width."""

import asyncio
from types import SimpleNamespace

import pytest
import stage
import stand_in
from birdcage_tui import main, run
from birdcage_tui.commands import PAGES
from birdcage_tui.drawing import glyphs
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.digits import put_big, width_of
from birdcage_tui.feeds.settings import AppOptions
from rich.cells import cell_len

STATE_SIGNS = "●○◍✖▨■▲◉✕☼☾•✓▼◀▶"


def screen(state, size, keys=(), *, page=None, glyph_set="ascii", seconds=0):
    async def body():
        app = stand_in.app_in(state, glyphs=glyph_set)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            if page is not None:
                app.show_page(page)
                await pilot.pause()
                await pilot.pause()
            for key in keys:
                await pilot.press(key)
                await pilot.pause()
            await pilot.wait_for_scheduled_animations()
            app.paint()
            await pilot.pause()
            return stand_in.text_of(app)

    return asyncio.run(body())


def beyond_ascii(text):
    return {char for char in text if not ("\n" <= char < "\x7f")}


@pytest.mark.parametrize("size", [(40, 12), (60, 40), (80, 24), (120, 36), (160, 48)], ids=str)
def test_every_cell_is_ascii_in_every_state(size):
    found = stage.run_each(stage.read, size=size, glyphs="ascii")
    assert {name: beyond for name, text in found.items() if (beyond := beyond_ascii(text))} == {}


@pytest.mark.parametrize("page", [name for name, _, _ in PAGES])
def test_every_cell_is_ascii_on_every_page(page):
    for size in ((80, 24), (120, 36)):
        assert not beyond_ascii(screen("idle", size, page=page))


@pytest.mark.parametrize("size", [(40, 12), (80, 24)], ids=str)
@pytest.mark.parametrize(
    "keys", [("H",), ("g", "1"), ("question_mark",), ("colon",), ("colon", "h"), ("semicolon",)], ids=str
)
def test_every_cell_is_ascii_in_every_dialog(keys, size):
    assert not beyond_ascii(screen("idle", size, keys))


def test_frames_arcs_and_words_are_still_there_in_ascii():
    text = screen("slewing", (80, 24))
    for words in ("- Sky", "AZ 201.30d", "! STOP", "CCW 303d", "SLEWING", "@", "X", "%", "N", "| "):
        assert words in text, words
    assert "?" not in text.replace("? help", "").replace("? keys", ""), "nothing without a likeness"


def test_the_block_set_has_no_braille_and_the_default_is_left_alone():
    block, braille = (screen("slewing", (80, 24), glyph_set=name) for name in ("block", "braille"))
    assert not any("\u2800" <= char <= "\u28ff" for char in block)
    assert any("\u2800" <= char <= "\u28ff" for char in braille)
    assert "▞" in block
    assert "◉" in block
    assert not glyphs.GlyphFilter("braille").enabled


def test_signs_of_states_stay_different():
    signs = [glyphs.translate(char, "ascii") for char in STATE_SIGNS]
    assert len(set(signs)) == len(STATE_SIGNS), dict(zip(STATE_SIGNS, signs, strict=True))
    assert not set(signs) & set("-|+.'"), "those are frames"


@pytest.mark.parametrize("glyph_set", glyphs.SETS)
def test_cells_keep_their_width(glyph_set):
    for text in (
        "Schüssel Größe",
        "衛星 dish",
        "🔎 search",
        "e\u0301",
        "╔╗╬▂▐…°",
        "".join(map(chr, range(0x2800, 0x2900))),
    ):
        there = glyphs.translate(text, glyph_set)
        assert cell_len(there) == cell_len(text), text
        assert glyph_set != "ascii" or not beyond_ascii(there)
    assert glyphs.translate("Schüssel", "ascii") == "Schussel"


@pytest.mark.parametrize(
    ("dots", "block", "plain"),
    [("⠀", " ", " "), ("⠉", "▀", '"'), ("⣀", "▄", "_"), ("⡇", "▌", "|"), ("⢸", "▐", "|"), ("⠤", "▄", "-"),
     ("⢁", "▚", "\\"), ("⡈", "▞", "/"), ("⠁", "▘", "'"), ("⢀", "▗", "."), ("⣿", "█", "#")],
)  # fmt: skip
def test_dots_become_what_looks_most_like_them(dots, block, plain):
    assert glyphs.translate(dots, "block") == block
    assert glyphs.translate(dots, "ascii") == plain


@pytest.mark.parametrize("large", [False, True])
def test_big_digits_can_be_told_apart_in_ascii(large):
    drawn = {}
    for char in "0123456789-":
        cells = Cells(width_of(char, large=large), 5 if large else 3, glyphs="ascii")
        put_big(cells, 0, 0, char, "text", large=large)
        drawn[char] = tuple("".join(row) for row in cells._chars)
    assert len(set(drawn.values())) == len(drawn)
    assert not beyond_ascii("".join("".join(rows) for rows in drawn.values()))
    if not large:
        assert drawn["2"] == (" _ ", " _|", "|_ ")
        assert drawn["9"] == (" _ ", "|_|", " _|")


@pytest.mark.parametrize(
    ("term", "encoding", "expected"),
    [("xterm-256color", "utf-8", "braille"), ("xterm", "UTF-8", "braille"), ("xterm", "ISO-8859-1", "ascii"),
     ("xterm", "ANSI_X3.4-1968", "ascii"), ("vt100", "utf-8", "ascii"), ("linux", "utf-8", "ascii"),
     ("xterm", "no-such-code", "ascii")],
)  # fmt: skip
def test_the_terminal_decides_when_nobody_does(term, encoding, expected):
    assert glyphs.fitting({"TERM": term}, encoding) == expected


@pytest.mark.parametrize(("chosen", "expected"), [("block", "block"), (None, "ascii")])
def test_the_flag_is_over_the_guess(chosen, expected, monkeypatch, tmp_path):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    monkeypatch.setenv("TERM", "vt100")
    made = []

    class App:
        return_code = 0
        track = SimpleNamespace(wait=lambda _seconds: None)
        fault = None
        ending = SimpleNamespace(by_signal=None, anew=None, take_signal=None)

        def __init__(self, session, settings, *_):
            self.session = session
            self.dishes = SimpleNamespace(end=lambda *_: session.close(), crash=None)
            made.append(settings)

        def begin_with(self, number):
            pass

        def run(self):
            pass

    monkeypatch.setattr(run, "BirdcageApp", App)
    flags = ["--demo"] + (["--glyphs", chosen] if chosen else [])
    assert run.run(main.parser().parse_args(flags)) == 0
    assert made[0].glyphs == expected
    assert AppOptions().glyphs == "braille"

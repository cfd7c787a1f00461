"""Contrast in every theme, of every letter on every screen; and distance for people who see colours differently."""

import asyncio
import itertools

import pytest
import sky_stand_in
import stand_in
from birdcage_tui.drawing.themes import LOOKS, contrast

VISIONS = {
    "deuteranope": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    "protanope": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    "tritanope": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)),
}
"""Machado, Oliveira and Fernandes 2009, severity 1; on linear RGB."""
LETTERS = ("text", "accent", "target", "good", "warn", "fault")
SCREENS = {
    "the page": (),
    "a question": ("H",),
    "go to": ("g",),
    "go to, typed": ("g", "1", "8", "0"),
    "help": ("question_mark",),
    "help, moved on": ("question_mark", "down"),
    "control": ("2",),
    "the console": ("5",),
    "the console, a hazard typed": ("5", "i", *"stow"),
    "the console, searched": ("5", "slash", "x"),
    "setup": ("8",),
    "passes": ("7",),
    "passes, not now": ("7", "right_square_bracket"),
    "passes, the world": ("7", "w"),
    "passes, filter": ("7", "slash", "m"),
    "a page to come": ("6",),
    "jump": ("semicolon",),
    "the palette": ("colon",),
    "the palette, searched": ("colon", "h", "o", "m"),
}


def linear(colour):
    channels = [int(colour[index : index + 2], 16) / 255 for index in (1, 3, 5)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]


def seen(colour, vision):
    """CIELAB of a colour as that person sees it."""
    r, g, b = (
        min(max(sum(a * c for a, c in zip(row, linear(colour), strict=True)), 0.0), 1.0) for row in VISIONS[vision]
    )
    x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047
    y = 0.2126 * r + 0.7152 * g + 0.0722 * b
    z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883
    x, y, z = (t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (x, y, z))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def distance(one, other, vision):
    return sum((p - q) ** 2 for p, q in zip(seen(one, vision), seen(other, vision), strict=True)) ** 0.5


def test_contrast_is_that_of_the_web_guidelines():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_everything_can_be_read(look):
    night = look.name == "night"
    for ink in LETTERS:
        assert contrast(getattr(look, ink), look.ground) >= 4.5, ink
    for ink in ("text", "warn"):  # the status line
        assert contrast(getattr(look, ink), look.raised) >= 4.5, ink
    assert contrast(look.text, look.ground) >= (4.5 if night else 7.0)
    for ground in (look.ground, look.raised):
        assert contrast(look.dim, ground) >= (3.0 if night else 4.5), ground
    assert 1.5 <= contrast(look.faint, look.ground) < contrast(look.line, look.ground)
    for name, style in look.inks.items():
        if name.endswith("-row"):
            ink, ground = style.color.get_truecolor().hex, style.bgcolor.get_truecolor().hex
            assert contrast(ink, ground) >= 4.5, name


@pytest.mark.parametrize("vision", VISIONS)
@pytest.mark.parametrize("name", ["dusk", "daylight"])
def test_what_means_something_else_looks_different_to_everybody(name, vision):
    look = LOOKS[name]
    for one, other in itertools.combinations(("accent", "target", "warn", "fault"), 2):
        assert distance(getattr(look, one), getattr(look, other), vision) >= 12, (one, other)


def test_every_state_has_its_own_sign_and_word_beside_its_colour():
    rows = {}
    for state in ("held", "fault", "lost", "silent", "not-homed", "refused", "late"):

        async def row(app, pilot, state=state):
            for _ in range(5 if state == "late" else 0):
                app.session.clock.advance(0.5)
            app.paint()
            await pilot.pause()
            return stand_in.text_of(app).splitlines()[1].strip()

        rows[state] = shown(state, "dusk", row)
    words = {state: (text.split()[0], " ".join(text.split()[1:3])) for state, text in rows.items()}
    assert words["held"] == ("■", "HELD by")
    assert words["fault"] == ("✖", "FAULT 12:00:00")
    assert words["lost"] == ("○", "LINK LOST")
    assert words["silent"][0] == "◍"
    assert words["not-homed"] == ("▲", "NOT HOMED")
    assert len(set(words.values())) == len(words), words


def test_night_is_red_on_black_only():
    look = LOOKS["night"]
    for ink in ("ground", "raised", "row", "dim", "line", "focus", *LETTERS):
        red, green, blue = (int(getattr(look, ink)[i : i + 2], 16) for i in (1, 3, 5))
        assert green <= red * 0.3, ink
        assert blue <= red * 0.25, ink


def test_a_bar_at_night_is_no_lamp():
    look = LOOKS["night"]
    for ink in ("warn-row", "fault-row", "target-row"):
        assert contrast(look.inks[ink].bgcolor.get_truecolor().hex, look.ground) < 2


def shown(state, theme, look_at, size=(80, 24), **settings):
    async def main():
        settings.setdefault("sky", sky_stand_in.make())
        app = stand_in.app_in(state, theme=theme, **settings)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return await look_at(app, pilot)

    return asyncio.run(main())


@pytest.mark.parametrize("keys", SCREENS.values(), ids=SCREENS)
def test_every_word_on_every_screen_can_be_read(keys):
    """Textual's own parts too: placeholders, cursors, lists, the palette, labels.

    One app goes through the themes; over a dialog, where no key changes the theme, each theme has its own.
    """
    left = list(LOOKS)

    async def look_at(app, pilot):
        for key in keys:
            await pilot.press(key)
            await pilot.pause()
        dialog, found = len(app.screen_stack) > 1, {}
        for theme in left[: 1 if dialog else None]:
            app.theme = theme
            await pilot.wait_for_scheduled_animations()
            app.paint()
            await pilot.pause()
            faint = faint_words(app, 3.0 if theme == "night" else 4.5)
            covered = dialog and keys != SCREENS["jump"]
            found[theme] = [each for each in faint if not covered or not veiled(each, app, LOOKS[theme])]
        return found

    while left:
        found = shown("idle", left[0], look_at)
        assert {theme: faint for theme, faint in found.items() if faint} == {}
        left = [theme for theme in left if theme not in found]


def faint_words(app, least):
    """Return each piece of text whose contrast is less than this, with both colours."""
    found = []
    for strip in app.screen._compositor.render_strips():
        for text, style, _ in strip:
            word = "".join(char for char in text if char.isalnum() and char < "\u2500")
            if not word or style is None or style.color is None or style.bgcolor is None:
                continue
            ink, ground = (colour.get_truecolor().hex for colour in (style.color, style.bgcolor))
            ink, ground = (ground, ink) if style.reverse else (ink, ground)
            if contrast(ink, ground) < least:
                found.append((text, ink, ground, round(contrast(ink, ground), 1)))
    return found


def veiled(each, app, look):
    """Whether these words belong to the page under a dialog, which is veiled on purpose."""
    base = app.screen_stack[0]
    page = "\n".join("".join(s.text for s in strip) for strip in base._compositor.render_strips())
    return each[0] in page and each[2] != look.row

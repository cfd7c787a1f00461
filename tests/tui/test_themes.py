"""Contrast in every theme, and distance for people who do not tell red from green."""

import itertools

import pytest
from birdcage_tui.themes import LOOKS


def linear(colour):
    channels = [int(colour[index : index + 2], 16) / 255 for index in (1, 3, 5)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]


def luminance(colour):
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear(colour), strict=True))


def contrast(one, other):
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def deuteranope(colour):
    """CIELAB of a colour as a deuteranope sees it (Machado, Oliveira and Fernandes 2009, severity 1)."""
    r, g, b = linear(colour)
    r, g, b = (
        0.367322 * r + 0.860646 * g - 0.227968 * b,
        0.280085 * r + 0.672501 * g + 0.047413 * b,
        -0.011820 * r + 0.042940 * g + 0.968881 * b,
    )
    x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047
    y = 0.2126 * r + 0.7152 * g + 0.0722 * b
    z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883
    x, y, z = (t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (x, y, z))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_everything_can_be_read(look):
    night = look.name == "night"
    for ink in ("text", "accent", "target", "good", "warn", "fault"):
        assert contrast(getattr(look, ink), look.ground) >= 4.5, ink
    assert contrast(look.text, look.ground) >= (4.5 if night else 7.0)
    assert contrast(look.text, look.raised) >= 4.5
    assert contrast(look.dim, look.ground) >= (3.0 if night else 4.5)
    assert contrast(look.line, look.ground) >= 1.5


@pytest.mark.parametrize("name", ["dusk", "daylight"])
def test_what_means_something_else_looks_different_to_a_deuteranope(name):
    look = LOOKS[name]
    for one, other in itertools.combinations(("accent", "target", "fault"), 2):
        a, b = deuteranope(getattr(look, one)), deuteranope(getattr(look, other))
        assert sum((p - q) ** 2 for p, q in zip(a, b, strict=True)) ** 0.5 >= 10, (one, other)


def test_night_is_red_on_black_only():
    look = LOOKS["night"]
    for ink in ("ground", "raised", "text", "dim", "line", "focus", "accent", "target", "good", "warn", "fault"):
        red, green, blue = (int(getattr(look, ink)[i : i + 2], 16) for i in (1, 3, 5))
        assert green <= red * 0.3, ink
        assert blue <= red * 0.25, ink

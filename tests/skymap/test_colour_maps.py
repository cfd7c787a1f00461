"""The colours of a scale: every level apart from its neighbours for every eye, higher always lighter."""

from __future__ import annotations

import itertools

import pytest
from birdcage.skymap.colour_maps import COLOUR_MAPS, USUAL

VISIONS = {
    "usual": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "deuteranope": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    "protanope": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    "tritanope": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)),
}
"""Machado, Oliveira and Fernandes 2009, severity 1; on linear RGB."""
LEVELS = [step / 16 for step in range(17)]


def lab(colour, vision):
    """CIELAB of a colour as that person sees it."""
    linear = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
    seen = [min(max(sum(a * c for a, c in zip(row, linear, strict=True)), 0.0), 1.0) for row in VISIONS[vision]]
    rows = ((0.4339, 0.3762, 0.1899), (0.2126, 0.7152, 0.0722), (0.0177, 0.1095, 0.8728))
    xyz = [sum(a * c for a, c in zip(row, seen, strict=True)) for row in rows]
    x, y, z = (t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116 for t in xyz)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def apart(one, other):
    return sum((p - q) ** 2 for p, q in zip(one, other, strict=True)) ** 0.5


@pytest.mark.parametrize("vision", VISIONS)
@pytest.mark.parametrize("name", COLOUR_MAPS)
def test_higher_is_lighter_and_no_two_levels_look_alike(name, vision):
    seen = [lab(COLOUR_MAPS[name](level), vision) for level in LEVELS]
    lightness = [each[0] for each in seen]
    assert lightness == sorted(lightness)
    assert min(apart(*pair) for pair in itertools.pairwise(seen)) >= (2.0 if name == "red" else 4.5)
    assert lightness[-1] - lightness[0] >= (40 if name == "red" else 75)


def test_the_red_one_spoils_no_night():
    for red, green, blue in map(COLOUR_MAPS["red"], LEVELS):
        assert green <= 0.3 * red
        assert blue <= 0.25 * red


def test_a_level_beyond_the_scale_has_the_colour_of_its_end():
    colour = COLOUR_MAPS[USUAL]
    assert (colour(-3.0), colour(7.0)) == (colour(0.0), colour(1.0))
    assert COLOUR_MAPS["grey"](0.5) == (124, 124, 124)

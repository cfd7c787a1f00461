"""`scripts/moving.py`: what stays is drawn once, what changes is shown for its frames alone, the first frame stands."""

from __future__ import annotations

import re
import sys

import pytest
from rich.style import Style

from tests.house.pages import ROOT

GROUND = "#000000"
INK = Style(color="#ffffff")


@pytest.fixture
def moving(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    import moving

    yield moving
    for name in ("moving", "picture", "marks"):
        sys.modules.pop(name, None)


def screens(*texts: str) -> list[list[list[tuple[str, Style]]]]:
    return [[[(row, INK)] for row in text.split("\n")] for text in texts]


def words(svg: str) -> list[str]:
    return re.findall(r">([^<]+)</text>", svg)


FRAMES = ("AZ 1\nstays", "AZ 2\nstays", "AZ 2\nstays", "AZ 1\nstays")


def test_what_stays_is_drawn_once_and_what_changes_for_its_frames(moving):
    svg = moving.moving(screens(*FRAMES), GROUND, 0.5)
    assert words(svg).count("stays") == words(svg).count("AZ") == 1
    assert sorted(words(svg)) == ["1", "1", "2", "AZ", "stays"]
    assert "2s step-end infinite" in svg
    assert "@keyframes f0-1{0%{visibility:visible}25%{visibility:hidden}}" in svg
    assert "@keyframes f1-3{0%{visibility:hidden}25%{visibility:visible}75%{visibility:hidden}}" in svg
    assert "@keyframes f3-4{0%{visibility:hidden}75%{visibility:visible}}" in svg


def test_without_animation_the_first_frame_stands(moving):
    svg = moving.moving(screens(*FRAMES), GROUND, 0.5)
    shown = re.sub(r'<g class="[^"]+" visibility="hidden">.*?</g>', "", svg, flags=re.DOTALL)
    assert sorted(words(shown)) == ["1", "AZ", "stays"]
    assert "prefers-reduced-motion:reduce" in svg


@pytest.mark.parametrize("at", range(len(FRAMES)))
def test_each_frame_is_its_screen(moving, at):
    seen = " ".join(sorted(words(moving.still(screens(*FRAMES), GROUND, at))))
    assert seen == " ".join(sorted(FRAMES[at].split()))

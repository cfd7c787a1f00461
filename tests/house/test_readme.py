"""The first screen of the README: what it is, what it looks like, how one starts it."""

from __future__ import annotations

import os
import re
import subprocess

import pytest

from tests.house.pages import ROOT, command_lines, text_of

SHORT = range(70, 121)
"""Lines: the rest lives in docs/."""
MOST_KB = 1000


def test_the_two_commands_of_a_fresh_machine_come_first() -> None:
    assert [words[0] for words in command_lines("README.md")[:2]] == ["scripts/demo", "scripts/test"]


@pytest.mark.parametrize("script", ["scripts/demo", "scripts/test", ".ci/run"])
def test_a_script_can_be_started(script: str) -> None:
    assert os.access(ROOT / script, os.X_OK)
    assert subprocess.run(["sh", "-n", script], cwd=ROOT, timeout=60, check=False).returncode == 0


def test_it_is_short_and_begins_with_a_line_and_a_picture_that_moves() -> None:
    text = text_of("README.md")
    assert len(text.splitlines()) in SHORT
    title, line, picture = [part for part in text.split("\n\n") if part][:3]
    assert title == "# birdcage"
    assert "\n" not in line
    name = re.fullmatch(r"!\[[^\]]+\]\(([^)]+)\)", picture)
    assert name is not None, picture
    svg = (ROOT / name[1]).read_text(encoding="utf-8")
    assert "@keyframes" in svg
    assert "prefers-reduced-motion" in svg
    assert len(svg.encode()) < MOST_KB * 1000

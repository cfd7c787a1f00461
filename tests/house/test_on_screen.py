"""Sentences are read off a screen as a person reads them: across wrapped rows, not across panes."""

from __future__ import annotations

import pytest

from tests.house.habits import habits_filled_in
from tests.house.on_screen import of_screen
from tests.house.sentences import Sentence

SCREEN = """
╭─ Next ─────────────╮╭─ Health ───────────────────╮
│ The link was lost  ││ firmware 02.02.48          │
│ for 12 s: f        ││ 12 ms a reply              │
│ follows again.     ││                            │
│ Press f.   Or wait ││ No position. Home it       │
╰────────────────────╯╰────────────────────────────╯
"""


def test_a_wrapped_sentence_is_one_and_rows_of_a_list_are_not() -> None:
    read = [each.text for each in of_screen(SCREEN, "here")]
    assert "The link was lost for 12 s: f follows again." in read
    for words in ("12 ms a reply", "firmware 02.02.48", "Press f.", "Or wait", "No position.", "Home it", "Health"):
        assert words in read, words


@pytest.mark.parametrize("text", [
    "It stopped at 12.0°. .", "Home it: : press H.", "Not read , look again.", "Azimuth nan°.", "at None",
    "{count} left", "ValueError(3)", "It stopped at 12.0°..", "word " * 26,
])  # fmt: skip
def test_what_went_wrong_when_it_was_filled_in_is_seen(text: str) -> None:
    assert habits_filled_in(Sentence(text.strip(), "here"))


@pytest.mark.parametrize("text", [
    "Reading …", "AZ ---.--°", "0.1 to 65 °/s; empty: unchanged", "in 01:00, 12.5° up.", "/ find",
    "at 159° / 43°: error", 'prints {"port": …}.', "Type two numbers, 231 45; or az=231, or el=231.",
])  # fmt: skip
def test_what_is_plain_is_left_alone(text: str) -> None:
    assert habits_filled_in(Sentence(text, "here")) == []

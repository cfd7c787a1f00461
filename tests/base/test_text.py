"""Text from outside loses what a terminal would obey, and nothing else."""

from __future__ import annotations

import unicodedata

import pytest
from birdcage.base.errors import BirdcageError
from birdcage.base.text import clean, clean_all
from hypothesis import given
from hypothesis import strategies as st


@pytest.mark.parametrize("text", ["", "ISS (ZARYA)", "Łódź 東京 ñ °", "A B", "🛰 up"])
def test_what_can_be_seen_stays(text):
    assert clean(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b]0;own\x07ISS", "]0;ownISS"), ("a\x1b[2Jb", "a[2Jb"), ("a\x9b31mb", "a31mb"), ("a\u202eb\u2066c", "abc"),
        ("a\tb\nc\x85d\u2028e\xa0f", "a b c d e f"), ("a\ud800b", "a\ufffdb"), ("a\x00\x7fb", "ab"),
    ],
)  # fmt: skip
def test_what_orders_a_terminal_about_goes(text, shown):
    assert clean(text) == shown


@given(st.text(st.characters(codec=None), max_size=30))
def test_all_that_is_left_can_be_printed(text):
    found = clean(text)
    assert not {unicodedata.category(each) for each in found} & {"Cc", "Cf", "Cs", "Zl", "Zp"}
    assert clean(found) == found
    found.encode()


def test_what_a_parser_made_is_cleaned_through_and_through():
    assert clean_all({"a\x1b": ["b\x9b", {"c": "\u202ed", "n": 1.5}], "t": True}) == {
        "a": ["b", {"c": "d", "n": 1.5}], "t": True,
    }  # fmt: skip


def test_an_error_quotes_nothing_that_a_terminal_obeys():
    assert str(BirdcageError("There is no \x1b[2Jsky.")) == "There is no [2Jsky."

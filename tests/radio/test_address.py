"""Addresses as people write them."""

from __future__ import annotations

import pytest
from birdcage.base.errors import ConfigError
from birdcage.radio.opening import parse_address


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("localhost:4532", ("localhost", 4532)),
        ("radio.lan", ("radio.lan", 4532)),
        (" 10.0.0.7:7356 ", ("10.0.0.7", 7356)),
        (":7356", ("localhost", 7356)),
        ("[::1]:7356", ("::1", 7356)),
        ("[fe80::2]", ("fe80::2", 4532)),
    ],
)
def test_what_is_meant(text, meant):
    assert parse_address(text) == meant


@pytest.mark.parametrize("text", ["", "radio:no", "radio:0", "radio:99999", "::1", "http://radio", "a b", "[::1"])
def test_what_is_no_address_is_told(text):
    with pytest.raises(ConfigError, match="Write localhost:4532"):
        parse_address(text)

"""A terminal at the stand-in dish."""

import pytest

from .typed import Terminal


@pytest.fixture
def terminal(monkeypatch):
    """`terminal(second_other="block")`: a dish with that habit, and somebody who types commands."""
    return lambda **habits: Terminal(monkeypatch, **habits)

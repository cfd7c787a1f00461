from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from hamlib_program import hamlib_program

from .scripted import Server


@pytest.fixture
def clock():
    return VirtualClock()


@pytest.fixture
def server():
    """Start scripted servers; they end with the test."""
    started = []

    def start(answer):
        started.append(Server(answer))
        return started[-1]

    yield start
    for each in started:
        each.close()


@pytest.fixture
def rigctld():
    """Run Hamlib's own daemon with its dummy radio, and return its port."""
    with hamlib_program("rigctld") as port:
        yield port

"""Reference transcript T-HAL000 from the driver's side, byte by byte."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.protocol import HAL000Protocol
from birdcage.rotator.values import Position

from .hal_transcript import WAYS, Transcript, named, talk


@pytest.fixture(params=WAYS, ids=named)
def dish(request):
    return Transcript(*request.param, firmware="hal000")


@pytest.fixture
def older(dish):
    protocol = HAL000Protocol()
    protocol.attach(dish, VirtualClock())
    return protocol


def test_the_search_is_ended_by_its_task(older, dish):
    told = []
    older.initialize(told.append)
    assert dish.lines == ["os", "kill Search", "q", "mot"]
    assert told


def test_the_moves_of_t_hal000(older, dish):
    older.enter_motor_menu()
    before = len(dish.sent)
    assert older.get_position() == Position(8.34, 34.33, 0.0)
    older.move_motor(0, 8.16)
    older.move_motor(1, 35.16)
    dish.position = dish.position.replace("8.34", "8.12").replace("34.33", "34.70")
    assert older.get_position() == Position(8.12, 34.70, 0.0)
    assert talk(dish.sent[before:]) == ["a", "a 0 8.16", "a 1 35.16", "a"]


def test_the_lowest_elevations_are_read_and_not_written(older, dish):
    older.enter_motor_menu()
    before = len(dish.lines)
    older.survey()
    assert dish.lines[before:] == ["q", "nvs", "e 125", "e 127"]

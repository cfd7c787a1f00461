"""Reference transcripts T-HAL205, and the tokens of T-HAL000 that it shares, from the driver's side, byte by byte."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.protocol import HAL205Protocol
from birdcage.rotator.values import Position

from .hal_transcript import WAYS, Transcript, named, talk


@pytest.fixture(params=WAYS, ids=named)
def dish(request):
    return Transcript(*request.param)


@pytest.fixture
def trav_ler(dish):
    protocol = HAL205Protocol()
    protocol.attach(dish, VirtualClock())
    return protocol


def test_t_hal205(trav_ler, dish):
    told = []
    trav_ler.initialize(told.append)
    assert dish.lines == ["ngsearch", "s", "q", "motor"]
    before = len(dish.sent)
    assert trav_ler.get_position() == Position(8.34, 34.33, 0.0)
    trav_ler.move_motor(0, 180.0)
    assert talk(dish.sent[before:]) == ["a", "a 0 180.00"]
    assert told


def test_the_moves_of_t_hal000(trav_ler, dish):
    trav_ler.enter_motor_menu()
    before = len(dish.sent)
    trav_ler.get_position()
    trav_ler.move_motor(0, 8.16)
    trav_ler.move_motor(1, 35.16)
    dish.position = dish.position.replace("8.34", "8.12").replace("34.33", "34.70")
    assert trav_ler.get_position() == Position(8.12, 34.70, 0.0)
    assert talk(dish.sent[before:]) == ["a", "a 0 8.16", "a 1 35.16", "a"]


def test_a_combined_move_and_the_byte_that_ends_it(trav_ler, dish):
    trav_ler.get_position()
    before = len(dish.sent)
    trav_ler.begin_slew(120.0, 40.0, 0.0)
    trav_ler.interject(trav_ler.abort_lines())
    assert dish.sent[before:] == b"g 120.00 40.00 0.00\r\r\r"
    assert len(trav_ler.console.settle(2.0)) == 2
    assert trav_ler.slew_is_over()


def test_the_lowest_elevations_are_read_and_not_written(trav_ler, dish):
    trav_ler.enter_motor_menu()
    before = len(dish.lines)
    trav_ler.survey()
    assert dish.lines[before:] == ["q", "nvs", "e 125", "e 127"]

"""The state of a station: replaced as a whole, field by field as its type says."""

from __future__ import annotations

from dataclasses import fields
from typing import get_type_hints

from birdcage.station.pursuit_state import Pursuit, PursuitChanges
from birdcage.station.state import StationState
from birdcage.station.state_changes import StateChanges


def test_each_field_of_the_state_can_be_changed_and_no_other():
    assert list(StateChanges.__annotations__) == [field.name for field in fields(StationState)]


def test_a_change_has_the_type_of_its_field():
    assert get_type_hints(StateChanges) == get_type_hints(StationState)


def test_a_change_of_a_pursuit_has_the_type_of_its_field():
    types = {field.name: field.type for field in fields(Pursuit)}
    for name, wanted in PursuitChanges.__annotations__.items():
        assert wanted.__forward_arg__ == types[name], name

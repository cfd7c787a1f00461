"""A dish of which no STOP, no switch of its search and no position at rest is known: Setup says just that."""

from __future__ import annotations

import pytest


@pytest.fixture
def house(build):
    return build("carryout?seed=1", firmware="carryout").up()


def test_its_search_ends_by_itself_and_a_person_says_when(house):
    step = house.view("search")
    assert "no known command ends it" in step.evidence
    assert "Wait until the dish rests" in " ".join(step.words)
    [rests] = (each for each in step.choices if each.key == "enter")
    before = list(house.lines()) if hasattr(house, "lines") else None
    house.choose("search", rests.name)
    assert house.view("search").evidence == "not ended: it was seen at rest"
    assert before is None or house.lines() == before


def test_its_ceiling_was_read_from_its_own_settings(house):
    assert house.state.el_max_deg == pytest.approx(73.0)
    assert "nvs.102" in house.state.readings

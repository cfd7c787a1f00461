"""Keys at random, one by one and many at once, over every page and layer: no end, no lost STOP, no motion unasked."""

import asyncio

import pytest
from key_storm import blow


@pytest.mark.parametrize(("seed", "size"), [(3, (80, 24)), (3, (60, 20))], ids=["pages", "pocket"])
def test_no_key_ends_the_app_loses_a_stop_or_moves_the_dish_unasked(seed, size):
    storm = asyncio.run(blow(seed, 500, size))
    assert not storm.wrong, "\n".join(storm.wrong)
    assert {"HelpScreen", "JumpScreen", "Palette", "QuestionScreen"} <= storm.met.keys()

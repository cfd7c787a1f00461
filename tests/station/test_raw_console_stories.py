"""Random stories around the console: what must hold, holds in each (see `story.py`)."""

from __future__ import annotations

import pytest
from night import by_night

from .story import Story


def tell(seed):
    story = Story(seed)
    story.tell()
    assert not story.wrong, "\n".join([f"seed {seed}", *story.told[-60:], *story.wrong])


@pytest.mark.parametrize("seed", range(12))
def test_a_story(seed):
    tell(seed)


@pytest.mark.soak
@pytest.mark.parametrize("score", by_night(range(100), 3))
def test_two_thousand_stories(score):
    for seed in range(1000 + 20 * score, 1020 + 20 * score):
        tell(seed)

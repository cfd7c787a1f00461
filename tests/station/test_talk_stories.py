"""Random stories around the console: what must hold, holds in each (see `story.py`)."""

from __future__ import annotations

import pytest

from .story import Story


def tell(seed):
    story = Story(seed)
    story.tell()
    assert not story.wrong, "\n".join([f"seed {seed}", *story.told[-60:], *story.wrong])


@pytest.mark.parametrize("seed", range(12))
def test_a_story(seed):
    tell(seed)


@pytest.mark.soak
@pytest.mark.parametrize("hundred", range(20))
def test_two_thousand_stories(hundred):
    for seed in range(1000 + 100 * hundred, 1100 + 100 * hundred):
        tell(seed)

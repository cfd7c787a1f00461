"""The ground the other tests stand on: no setting and no file of the developer reaches a test."""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize("attempt", [1, 2])
def test_each_test_starts_in_an_empty_home(attempt: int) -> None:
    assert list(Path.home().iterdir()) == []
    (Path.home() / "left-behind").touch()


def test_every_folder_for_settings_and_data_lies_in_that_home() -> None:
    for folder in (
        platformdirs.user_config_path("birdcage"),
        platformdirs.user_data_path("birdcage"),
        platformdirs.user_cache_path("birdcage"),
        platformdirs.user_state_path("birdcage"),
        platformdirs.user_log_path("birdcage"),
    ):
        assert folder.is_relative_to(Path.home())


def test_variables_of_the_developer_are_gone() -> None:
    assert [name for name in os.environ if name.startswith(("BIRDCAGE_", "TEXTUAL")) or name == "NO_COLOR"] == []


@given(st.integers())
def test_properties_have_no_deadline_and_may_use_the_home(number: int) -> None:
    assert settings.default is not None
    assert settings.default.deadline is None

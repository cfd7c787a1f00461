"""The stand-in lies beside the tests; importlib mode puts no folder on the path by itself."""

import sys
from pathlib import Path

import pytest
from birdcage.base.presets import Preset, add_preset
from textual._styles_cache import StylesCache

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def kept(tmp_path):
    """The path of a presets file with twelve directions in it."""
    path = tmp_path / "presets.toml"
    for index in range(12):
        add_preset(path, Preset(f"Direction {index}", 30.0 * index, 20.0 + index, "a note" if index % 2 else ""))
    return path


@pytest.fixture(autouse=True)
def _forget_the_drawn():
    """Let go of what Textual remembers of the last thousand widgets, all that they drew included."""
    yield
    StylesCache.get_inner_outer.cache_clear()

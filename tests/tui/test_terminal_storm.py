"""The key storm through a real terminal, into the installed app. Thousands of keys: `tests/soak/test_key_storm.py`."""

import sys

import pytest

if sys.platform == "win32":
    pytest.skip("needs a pty", allow_module_level=True)

from terminal_storm import storm


def test_the_app_lives_holds_and_quits(tmp_path):
    assert storm(1, 150, tmp_path) == 0

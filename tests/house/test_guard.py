"""A test that computes for ever fails by its name, and the tests after it are run all the same."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CONFTEST = Path(__file__).resolve().parents[1] / "conftest.py"
TESTS = """
import time

def test_that_never_ends():
    while True:
        pass

def test_that_waits_longer_than_it_computes():
    time.sleep(1.5)

def test_after_it():
    pass
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no timer of processor time")
def test_a_test_that_computes_for_ever_fails_and_the_rest_is_run(tmp_path):
    (tmp_path / "shared").mkdir()
    shutil.copy(CONFTEST, tmp_path)
    shutil.copy(CONFTEST.parent / "shared" / "night.py", tmp_path / "shared")
    (tmp_path / "by_night.txt").touch()
    (tmp_path / "test_it.py").write_text(TESTS)
    (tmp_path / "pytest.ini").write_text("[pytest]\ncpu_limit_s = 0.5\nmarkers = soak: long\n")
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)],
        cwd=tmp_path, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    assert "1 failed, 2 passed" in ran.stdout
    assert "FAILED test_it.py::test_that_never_ends" in ran.stdout
    assert "It has taken more than 0.5 s of processor time." in ran.stdout

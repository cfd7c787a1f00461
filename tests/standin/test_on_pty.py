"""The command as a process of its own, on a real pty with the stand-in dish behind it."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from .habits import Habits
from .ports import PtyDish

PROGRAM = "from birdcage.cli import main; main()"


def birdcage(served: PtyDish, *words: str) -> subprocess.CompletedProcess[str]:
    env = {**os.environ, "BIRDCAGE_PORT": served.path}
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *words], env=env, capture_output=True, text=True, check=False, timeout=110
    )


def test_it_is_found_out_pointed_and_stopped():
    with PtyDish(Habits(second_same="block", second_other="block", colour=True, pieces=True), rate=2.0) as served:
        detected = birdcage(served, "detect", "--json")
        assert json.loads(detected.stdout)["firmware"] == "g2", detected.stderr
        moved = birdcage(served, "move", "--az", "200", "--el", "30", "--json")
        assert moved.returncode == 0, moved.stderr
        assert served.dish.where() == (pytest.approx(200.0), pytest.approx(30.0))
        stopped = birdcage(served, "stop")
        assert (stopped.returncode, served.dish.moves()) == (0, False), stopped.stdout + stopped.stderr
        held = birdcage(served, "move", "--az", "100", "--el", "30")
        assert held.returncode != 0
        assert "birdcage release" in held.stderr
        assert birdcage(served, "release").returncode == 0
        moved = birdcage(served, "move", "--az", "190", "--el", "40")
        assert moved.returncode == 0, moved.stderr
        assert served.dish.where() == (pytest.approx(190.0), pytest.approx(40.0))
        assert served.dish.root_q == 0

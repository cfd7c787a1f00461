"""`birdcage sim --rig` as Hamlib's own `rigctl` meets it."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
import time

import pytest

BIRDCAGE = [sys.executable, "-c", "from birdcage.cli import main; main()"]


@pytest.fixture
def served(tmp_path):
    """Serve a dish at az 180, el 45, with a beacon in its beam; return the address of the receiver."""
    now_s = time.time()
    rows = [[now_s + second, 180.0, 45.0, -40.0, 2000.0] for second in range(-30, 300, 10)]
    beacons = tmp_path / "beacons.json"
    beacons.write_text(json.dumps({"beacons": [{"name": "DEMO", "frequency_hz": 11.7e9, "rows": rows}]}))
    command = [*BIRDCAGE, "--json", "sim", "--tcp", "--rig", "0", "--beacons", str(beacons), "-o", "az=-180"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        yield json.loads(process.stdout.readline())["rig"]
    finally:
        process.send_signal(signal.SIGTERM)
        _, complaints = process.communicate(timeout=60)
    assert (process.returncode, complaints) == (0, "")


def test_hamlibs_rigctl_tunes_it_and_reads_the_beacon(served):
    rigctl = shutil.which("rigctl")
    if rigctl is None:
        pytest.skip("Hamlib's rigctl is not installed (libhamlib-utils)")

    def ask(*words):
        done = subprocess.run(
            [rigctl, "-m", "2", "-r", served, *words], capture_output=True, text=True, timeout=60, check=True
        )
        return done.stdout.split()

    ask("F", "11700002000")
    assert ask("f") == ["11700002000"]
    assert float(ask("l", "STRENGTH")[0]) == pytest.approx(-40.0, abs=2.0)
    ask("F", "11700050000")
    assert float(ask("l", "STRENGTH")[0]) == pytest.approx(-60.0, abs=2.0)


def test_what_a_receiver_would_hear_needs_a_receiver(tmp_path):
    done = subprocess.run(
        [*BIRDCAGE, "sim", "--tcp", "--beacons", str(tmp_path / "none.json")], capture_output=True, text=True,
        timeout=60, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "--rig PORT serves one" in done.stderr

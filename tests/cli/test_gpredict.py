"""Gpredict itself, its window driven on a screen of its own, follows satellites with `birdcage serve` for a minute.

It runs in real time: `scripts/test -m gpredict` (docs/developing.md).
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import time
from datetime import UTC, datetime, timedelta
from statistics import median

import pytest
from birdcage.base.geometry import separation
from birdcage.base.paths import Paths
from birdcage.rotctld.recorded_session import sessions_in
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.targets.model import Satellite

NEEDED = ("gpredict", "Xvfb", "xdotool")
pytestmark = [
    pytest.mark.gpredict,
    pytest.mark.skipif(not all(map(shutil.which, NEEDED)), reason=f"needs {', '.join(NEEDED)}"),
]

PLACE = Observer(50.0, 8.0, 100.0)
BEYOND_DEG = 3.0
"""How far north or south of the place the satellite goes by: up to 50 degrees high, and no limit of the dish is met."""
CULMINATES_S = 50.0
ENGAGED_S = 60.0
MENU, ANTENNA_CONTROL, TRACK, ENGAGE = (680, 45), (760, 240), (347, 196), (779, 196)
"""Where Gpredict 2.3 has them, in a window without a frame at the corner of the screen."""


def passing(now: datetime, inclination_deg: float) -> ElementSet:
    """Return a circular orbit whose northernmost point is on the meridian of the place at the time of culmination."""
    days = (now - datetime(2000, 1, 1, 12, tzinfo=UTC)).total_seconds() / 86400.0
    greenwich_deg = 280.46061837 + 360.98564736629 * (days + CULMINATES_S / 86400.0)
    return ElementSet(
        name="TEST", norad_id=99001, epoch=now, inclination_deg=inclination_deg,
        raan_deg=(greenwich_deg + PLACE.longitude_deg - 90.0) % 360.0, eccentricity=0.0002,
        argument_of_perigee_deg=0.0, mean_anomaly_deg=90.0 - 15.5 * 360.0 * CULMINATES_S / 86400.0,
        mean_motion_rev_day=15.5, source="test",
    )  # fmt: skip


def two_lines(elements: ElementSet) -> list[str]:
    """Return it as Gpredict reads it, with the checksums."""
    year = datetime(elements.epoch.year, 1, 1, tzinfo=UTC)
    day = (elements.epoch - year) / timedelta(days=1) + 1.0
    node, anomaly = f"{elements.raan_deg:8.4f}", f"{elements.mean_anomaly_deg:8.4f}"
    lines = (
        f"1 99001U 26001A   {year:%y}{day:012.8f}  .00000000  00000-0  00000-0 0  999",
        f"2 99001 {elements.inclination_deg:8.4f} {node} 0002000   0.0000 {anomaly} 15.50000000    1",
    )
    return [f"{line}{sum(int(x) if x.isdigit() else x == '-' for x in line) % 10}" for line in lines]


class GpredictWindow:
    """Gpredict with one satellite and our rotator, and its Antenna Control open."""

    def __init__(self, folder, elements, rotator):
        first, second = two_lines(elements)
        files = {
            "gpredict.cfg": "[GLOBAL]\nDEFAULT_QTH=here.qth\n[MODULES]\nOPEN_MODULES=Amateur\n",
            "here.qth": f"[QTH]\nLOCATION=Here\nLAT={PLACE.latitude_deg}\nLON={PLACE.longitude_deg}\nALT=100\n",
            "modules/Amateur.mod": "[GLOBAL]\nSATELLITES=99001;\nQTHFILE=here.qth\n",
            "satdata/99001.sat": f"[Satellite]\nVERSION=1.1\nNAME=T\nNICKNAME=T\nTLE1={first}\nTLE2={second}\n",
            "hwconf/birdcage.rot": rotator,
        }
        for name, text in files.items():
            path = folder / "Gpredict" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        self._screen = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        )  # fmt: skip
        display = f":{self._screen.stdout.readline().strip()}"
        self._env = {**os.environ, "DISPLAY": display, "XDG_CONFIG_HOME": str(folder), "NO_AT_BRIDGE": "1"}
        self._program = subprocess.Popen(
            ["gpredict"], env=self._env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self.await_window("Gpredict: Amateur")
        self.press(MENU)
        # The menu has no name to wait for; a press before it is there goes to the map, which takes none.
        end = time.monotonic() + 20.0
        while not self._windows("Rotator Control"):
            assert time.monotonic() < end
            self.press(ANTENNA_CONTROL)

    def press(self, where):
        self._xdotool("mousemove", *where, "click", 1)

    def await_window(self, title):
        end = time.monotonic() + 30.0
        while not self._windows(title):
            assert time.monotonic() < end, title
            assert self._program.poll() is None

    def _windows(self, title):
        return self._xdotool("search", "--onlyvisible", "--name", title).split()

    def _xdotool(self, *words):
        command = ["xdotool", *map(str, words)]
        return subprocess.run(command, env=self._env, capture_output=True, text=True, timeout=10, check=False).stdout

    def close(self):
        for each in (self._program, self._screen):
            each.terminate()
            try:
                each.wait(10)
            except subprocess.TimeoutExpired:  # Gpredict may hang as it leaves, its window waiting for its client
                each.kill()
                each.wait(10)


@pytest.mark.parametrize("by_north", [False, True], ids=["south", "north"])
def test_its_satellite_is_recognised_and_the_dish_follows_it_closely(start, run, as_json, pty_dish, tmp_path, by_north):
    paths, target = Paths.default(), passing(
        datetime.now(UTC), PLACE.latitude_deg + (BEYOND_DEG if by_north else -BEYOND_DEG)
    )  # fmt: skip
    paths.config_file.parent.mkdir(parents=True, exist_ok=True)
    paths.config_file.write_text(
        f"[place]\nlatitude_deg = {PLACE.latitude_deg}\nlongitude_deg = {PLACE.longitude_deg}\nheight_m = 100.0\n"
    )
    with Catalogue(paths.catalogue) as catalogue:
        catalogue.add([target, *demo_orbits(datetime.now(UTC), PLACE)])
    process = start("serve", "--port", pty_dish.path, "--firmware", "g2", "--listen-port", 0)
    while not (found := re.search(r"Listening on \S+ port (\d+)", process.stderr.readline())):
        assert process.poll() is None
    window = GpredictWindow(tmp_path, target, run("serve", "--listen-port", found[1], "--print-gpredict").stdout)
    try:
        window.press(TRACK)
        window.press(ENGAGE)
        off, end = [], time.monotonic() + ENGAGED_S
        pty_dish.wait_for_motion()
        while time.monotonic() < end:
            time.sleep(0.5)
            truth, look = pty_dish.device.truth(), Satellite(target).look(PLACE, datetime.now(UTC))
            off.append(separation(truth.az_deg % 360.0, truth.el_deg, look.az_deg, look.el_deg))
        client = as_json(run("status", "--json", port=pty_dish.path))["network"]["clients"][0]
    finally:
        window.close()
    assert (client["program"], client["follows"]) == ("Gpredict", "TEST"), (client, off)
    assert client["follow_error_deg"] < 0.3
    assert median(off[-40:]) < 0.3


@pytest.mark.parametrize("by_north", [False, True], ids=["south", "north"])
def test_it_stays_engaged_for_a_pass_and_the_dish_follows(start, run, pty_dish, tmp_path, by_north):
    kept = tmp_path / "session.txt"
    words = ("--listen-port", 0, "--record", kept)
    process = start("serve", "--port", pty_dish.path, "--firmware", "g2", *words)
    while not (found := re.search(r"Listening on \S+ port (\d+)", process.stderr.readline())):
        assert process.poll() is None
    rotator = run("serve", "--listen-port", found[1], "--print-gpredict").stdout
    target = passing(datetime.now(UTC), PLACE.latitude_deg + (BEYOND_DEG if by_north else -BEYOND_DEG))
    window = GpredictWindow(tmp_path, target, rotator)
    try:
        window.press(TRACK)
        window.press(ENGAGE)
        off, azimuths, end = [], [], time.monotonic() + ENGAGED_S
        pty_dish.wait_for_motion()
        while time.monotonic() < end:
            time.sleep(0.5)
            truth, look = pty_dish.device.truth(), Satellite(target).look(PLACE, datetime.now(UTC))
            azimuths.append(look.az_deg)
            off.append(max(abs((truth.az_deg - look.az_deg + 180.0) % 360.0 - 180.0), abs(truth.el_deg - look.el_deg)))
        said_before = kept.read_text("ascii")
        window.press(ENGAGE)
        pty_dish.wait_for(lambda _truth: r" > q\n" in kept.read_text("ascii"), 10.0)
    finally:
        window.close()
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=30)
    assert r" > S\n" not in said_before
    ((first, *more),) = sessions_in(kept.read_text("ascii"))
    assert first.sent == b"p\n"
    assert [each.sent for each in more[-2:]] == [b"S\n", b"q\n"]
    asked = [each for each in more if each.sent.startswith(b"P ")]
    assert len(asked) > 10
    assert {each.answer for each in asked} == {b"RPRT 0\n"}
    assert sum(each.sent == b"p\n" for each in more) > 0.8 * ENGAGED_S
    assert (min(azimuths) < 20.0 and max(azimuths) > 340.0) is by_north
    assert median(off) < 2.0
    assert max(off[20:]) < 5.0  # nor does it go all the way round where it crosses north

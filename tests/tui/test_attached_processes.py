"""`birdcage station run` and two apps, each a process of its own on a real pty: any of them may die, and none loses."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from birdcage.base.geometry import shortest_turn

if sys.platform == "win32":
    pytest.skip("needs a pty", allow_module_level=True)

from pty_dish import PtyDish
from pty_terminal import BIN, PtyTerminal

SETTINGS = (
    '[dish]\nport = "{port}"\nfirmware = "g2"\n[place]\nname = "Bench"\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n'
)
WITHIN_S = 40.0


@pytest.fixture
def dish():
    dish = PtyDish("seed=1&az_speed=6")  # it still slews when a loaded machine gets round to it
    yield dish
    dish.close()


@pytest.fixture
def house(dish, tmp_path, monkeypatch):
    house = House(dish, tmp_path, monkeypatch)
    yield house
    house.close()


class House:
    """One dish, one folder of settings, and the programs at it."""

    def __init__(self, dish, folder, monkeypatch):
        self.dish, self.folder = dish, folder
        monkeypatch.setenv("BIRDCAGE_HOME", str(folder))
        (folder / "birdcage.toml").write_text(SETTINGS.format(port=dish.path))
        self.apps, self.stations = [], []

    def station(self):
        """Start a station without a face; return it once other programs find it."""
        station = subprocess.Popen(
            [str(BIN / "birdcage"), "station", "run", "--skip-init"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self.stations.append(station)
        self.until(lambda: any(f'"pid": {station.pid},' in text for text in self.announced()))
        return station

    def announced(self):
        return [file.read_text() for file in Path(self.folder).rglob("owners/*.json")]

    def app(self):
        """Start an app; return it once it shows that it is attached, and where the dish is."""
        app = PtyTerminal("birdcage-tui", columns=120, rows=36)
        self.apps.append(app)
        app.wait_for(b" ATTACHED ")
        app.wait_for(b"IDLE")
        return app

    def send(self, app, where):
        """Send the dish somewhere by the go-to line of an app."""
        shown = len(app.output)
        app.press(b"g")
        app.wait_for(b"Enter goes there", shown)
        app.press(where + b"\r")
        self.dish.wait_for(lambda truth: truth.moving)

    @staticmethod
    def until(seen):
        end = time.monotonic() + WITHIN_S
        while not seen():
            assert time.monotonic() < end, "not seen in time"
            time.sleep(0.05)

    def close(self):
        for app in self.apps:
            app.close()
        for station in self.stations:
            if station.poll() is None:
                station.kill()
            station.wait()


def test_a_killed_station_is_shown_in_both_apps_and_the_next_one_is_attached_to(house, dish):
    first = house.station()
    one, other = house.app(), house.app()
    house.send(one, b"300 45")
    shown = len(one.output), len(other.output)
    first.kill()
    first.wait()
    for app, after in zip((one, other), shown, strict=True):
        app.wait_for(b"LINK LOST", after)
    shown = len(one.output), len(other.output)
    house.station()
    for app, after in zip((one, other), shown, strict=True):
        app.wait_for(b"FAULT", after)  # the dish moves, and this station has not asked for that
    dish.wait_for(lambda truth: not truth.moving)
    after = len(other.output)
    one.press(b"\r")  # acknowledges
    other.wait_for(b"IDLE", after)
    assert all(app.process.poll() is None for app in (one, other))


def test_a_killed_app_takes_nothing_with_it_and_one_that_comes_sees_all(house, dish):
    house.station()
    one, other = house.app(), house.app()
    house.send(one, b"320 45")
    one.process.kill()
    dish.wait_for(lambda truth: not truth.moving)
    assert dish.device.truth().az_deg % 360.0 == pytest.approx(320.0, abs=0.5)
    other.wait_for(b"320.0")
    house.app().wait_for(b"320.0")
    house.send(other, b"310 45")  # control was given back


@pytest.mark.parametrize("name", ["SIGHUP", "SIGTERM", "Ctrl+Q"])
def test_an_app_that_ends_leaves_the_motion_alone_and_says_what_goes_on(house, dish, name):
    station = house.station()
    app = house.app()
    house.send(app, b"320 45")
    if name == "Ctrl+Q":
        app.press(b"\x11")
    else:
        app.signal(getattr(signal, name))
    assert app.status() == (0 if name == "Ctrl+Q" else 128 + getattr(signal, name))
    assert f"birdcage station run (process {station.pid}) goes on: the dish moves to AZ 320.00 EL 45.00°." in app.text
    dish.wait_for(lambda truth: not truth.moving)
    assert dish.device.truth().az_deg % 360.0 == pytest.approx(320.0, abs=0.5)


def test_a_terminal_that_is_closed_leaves_the_motion_alone(house, dish):
    house.station()
    app = house.app()
    house.send(app, b"320 45")
    app.hang_up()
    assert app.status() == 128 + signal.SIGHUP
    dish.wait_for(lambda truth: not truth.moving)
    assert dish.device.truth().az_deg % 360.0 == pytest.approx(320.0, abs=0.5)


def test_space_in_one_app_holds_the_dish_for_the_other_and_enter_there_releases_it(house, dish):
    house.station()
    one, other = house.app(), house.app()
    house.send(one, b"200 45")
    after = len(other.output), len(one.output)
    other.press(b" ")
    one.wait_for(b"HELD", after[1])
    dish.wait_for(lambda truth: not truth.moving)
    assert dish.device.truth().az_deg % 360.0 != pytest.approx(200.0, abs=5.0)
    after = len(other.output)
    one.press(b"\r")
    other.wait_for(b"IDLE", after)


def test_a_frozen_station_is_told_of_when_stop_has_no_answer(house):
    station = house.station()
    app = house.app()
    station.send_signal(signal.SIGSTOP)
    try:
        shown = len(app.output)
        app.press(b" ")
        app.wait_for(b"STOP DID NOT GET THROUGH", shown)
    finally:
        station.send_signal(signal.SIGCONT)
    app.wait_for(b"HELD", shown)


def test_the_second_app_attaches_to_the_first(house, dish):
    first = PtyTerminal("birdcage-tui", columns=120, rows=36)
    house.apps.append(first)
    first.wait_for(b"IDLE")
    house.until(house.announced)
    second = house.app()
    assert b" ATTACHED " not in first.output
    second.wait_for(b"attached to birdcage-tui")
    after = len(second.output)
    first.press(b"\x11")
    assert first.status() == 0
    second.wait_for(b"LINK LOST", after)


def test_what_an_app_follows_goes_on_when_it_is_killed_and_the_next_app_shows_it(house, dish):
    house.station()
    app = house.app()
    for keys, shown in ((b"2c", b"No target selected"), (b"/19.2E", b"Astra 19"), (b"\r", b"stands still"),
                        (b"f", b"Enter follows"), (b"\r", b"control: tracker")):  # fmt: skip
        after = len(app.output)
        app.press(keys)
        app.wait_for(shown, after)
    dish.wait_for(lambda truth: truth.moving)
    app.process.kill()
    az_deg = dish.device.truth().az_deg
    dish.wait_for(lambda truth: truth.moving and abs(shortest_turn(az_deg, truth.az_deg)) > 30.0)
    later = PtyTerminal("birdcage-tui", columns=120, rows=36)
    house.apps.append(later)
    later.wait_for(b"GO TO AOS")
    after = len(later.output)
    later.press(b" ")
    later.wait_for(b"HELD", after)
    dish.wait_for(lambda truth: not truth.moving)

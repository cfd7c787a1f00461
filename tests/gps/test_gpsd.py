"""gpsd: JSON lines, a deadline, and what a person has to do when there is no fix."""

from __future__ import annotations

import json
import socket
import threading
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.clock import RealClock, VirtualClock
from birdcage.gps.fix import NoFix
from birdcage.gps.gpsd import WATCH, read_gpsd
from birdcage.gps.locate import locate

from .receiver import Bank

URL = "socket://localhost:2947"
VERSION = {"class": "VERSION", "release": "3.25", "proto_major": 3}
DEVICES = {"class": "DEVICES", "devices": [{"path": "/dev/ttyACM0"}]}
TPV = {
    "class": "TPV", "mode": 3, "time": "2026-03-20T12:00:00.000Z", "lat": 51.9, "lon": 4.8,
    "altHAE": 55.1, "altMSL": 10.0, "alt": 10.0,
}  # fmt: skip
SKY = {"class": "SKY", "hdop": 0.8, "uSat": 11}


def said(*reports, at=0.3):
    return [(at, b"".join(json.dumps(each).encode() + b"\r\n" for each in reports))]


NOON = datetime(2026, 3, 20, 12, 0, 0, tzinfo=UTC)


@pytest.fixture
def clock():
    return VirtualClock(NOON)


def ask(clock, script, **more):
    bank = Bank(clock, {(URL, 9600): script})
    return read_gpsd(clock, open_link=bank, **more), bank


def test_a_fix(clock):
    fix, bank = ask(clock, said(VERSION, DEVICES, SKY, TPV))
    assert (fix.latitude_deg, fix.longitude_deg, fix.height_m) == (51.9, 4.8, 55.1)
    assert (fix.satellites, fix.hdop) == (11, 0.8)
    assert fix.clock_offset_s == pytest.approx(0.3)
    assert fix.source == "gpsd at localhost:2947"
    assert bank.receivers[0].written == WATCH
    assert bank.receivers[0].closed


def test_a_fix_whose_satellites_are_not_told_does_not_wait_for_long(clock):
    fix, _ = ask(clock, said(VERSION, TPV) + said(TPV, at=1.3) + said(SKY, at=8.0))
    assert (fix.satellites, fix.received_utc) == (None, NOON + timedelta(seconds=1.3))


@pytest.mark.parametrize(
    ("changes", "height_m"),
    [({"mode": 2}, None), ({"altHAE": None}, 10.0), ({"altHAE": None, "altMSL": None, "alt": None}, None)],
)
def test_a_height_that_is_not_known_is_none(clock, changes, height_m):
    fix, _ = ask(clock, said(VERSION, SKY, {**TPV, **changes}))
    assert fix.height_m == height_m


@pytest.mark.parametrize(
    ("reports", "reason", "says"),
    [
        ((VERSION, DEVICES, {"class": "TPV", "mode": 1}, {**SKY, "uSat": 2}), "no_fix", r"mode 1, 2 satellites used"),
        ((VERSION, {"class": "DEVICES", "devices": []}), "no_fix", r"has no receiver"),
        ((), "no_gps", "is not gpsd: silence for 10 s"),
        ((VERSION, {**TPV, "lat": 200}), "no_fix", "has no fix"),
        ((VERSION, {**TPV, "mode": 1}), "no_fix", "mode 1"),
        ((VERSION, {**TPV, "lat": True}), "no_fix", "has no fix"),
        (([1, 2], "x"), "no_gps", "2 lines that are not JSON"),
    ],
)
def test_without_a_fix_the_deadline_says_what_was_seen(clock, reports, reason, says):
    with pytest.raises(NoFix, match=says) as no:
        ask(clock, said(*reports))
    assert no.value.reason == reason
    assert clock.monotonic() == pytest.approx(1010.0)


def test_what_is_damaged_is_skipped(clock):
    fix, _ = ask(clock, [(0.1, b'{"class":"TPV","mode":3,\n\xff\xfe\n'), *said(VERSION, {"class": 7}, SKY, TPV)])
    assert fix.satellites == 11


@pytest.mark.parametrize("time", [None, "yesterday", "2026-03-20T12:00:00", 7])
def test_a_time_that_is_none_judges_no_clock(clock, time):
    fix, _ = ask(clock, said(VERSION, SKY, {**TPV, "time": time}))
    assert (fix.utc, fix.clock_offset_s) == (None, None)


def test_none_runs(clock):
    with pytest.raises(NoFix, match="No gpsd at pi:2947: start it") as no:
        locate("gpsd://pi", clock, open_link=Bank(clock, {}))
    assert no.value.reason == "no_gps"


@pytest.mark.parametrize("name", ["gpsd://pi:99999", "gpsd://[oops"])
def test_an_address_that_is_none(clock, name):
    with pytest.raises(NoFix, match="write it as gpsd://host:port"):
        locate(name, clock, open_link=Bank(clock, {}))


def test_over_real_tcp():
    with socket.create_server(("127.0.0.1", 0)) as server:
        heard = []

        def serve():
            connection, _ = server.accept()
            with connection:
                connection.sendall(json.dumps(VERSION).encode() + b"\n")
                heard.append(connection.recv(100))
                connection.sendall(said(SKY, TPV)[0][1])
                connection.recv(100)

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        fix = locate(f"gpsd://127.0.0.1:{server.getsockname()[1]}", RealClock(), timeout_s=5.0)
        thread.join(5)
    assert heard == [WATCH]
    assert fix.height_m == 55.1


def test_a_daemon_that_hangs_up(clock):
    bank = Bank(clock, {(URL, 9600): said(VERSION)}, hangs_up=True)
    with pytest.raises(NoFix, match="closed the connection"):
        read_gpsd(clock, open_link=bank)

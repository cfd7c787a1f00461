"""NMEA from a receiver's own port: a fix is whole, damaged sentences are skipped, a deadline says what was seen."""

from __future__ import annotations

import os
import threading
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.clock import RealClock, VirtualClock
from birdcage.base.errors import LinkError
from birdcage.gps.fix import NoFix
from birdcage.gps.locate import locate
from birdcage.gps.nmea import read_nmea
from birdcage.link.link import Link

from .receiver import Bank, Receiver, gga, rmc, sentence

URL = "/dev/ttyACM0"


NOON = datetime(2026, 3, 20, 12, 0, 0, tzinfo=UTC)


@pytest.fixture
def clock():
    return VirtualClock(NOON)


def read(clock, script, baud=9600, **more):
    bank = Bank(clock, {(URL, baud): script})
    return read_nmea(URL, clock, open_link=bank, **more), bank


def test_a_fix_from_gga_and_rmc(clock):
    fix, bank = read(clock, [(0.4, gga("120000") + rmc("120000"))])
    assert (fix.latitude_deg, fix.longitude_deg) == (pytest.approx(48.1173), pytest.approx(11.516667))
    assert fix.height_m == pytest.approx(545.4 + 46.9)
    assert (fix.satellites, fix.hdop) == (8, 0.9)
    assert fix.utc == NOON
    assert fix.received_utc == NOON + timedelta(seconds=0.4)
    assert fix.clock_offset_s == pytest.approx(0.4)
    assert fix.source == "/dev/ttyACM0 at 9600 baud"
    assert bank.receivers[0].closed


def test_place_and_date_of_different_seconds_make_no_fix(clock):
    fix, _ = read(clock, [(0.5, rmc("115959")), (0.6, gga("120000")), (0.7, rmc("120000"))])
    assert fix.received_utc == NOON + timedelta(seconds=0.7)


def test_damaged_sentences_are_skipped(clock):
    wrong = gga("120000").replace(b"4807.038", b"9907.038")
    noise = b"\x00\xff$GP" + b"$GPGGA,,*\r\n" + sentence("GPGGA,x,y,z") + b"$" + rmc("120000")[:20] + b"\r\n" + wrong
    fix, _ = read(clock, [(0.1, noise), (1.0, b"junk" + gga("120001")), (1.1, rmc("120001"))])
    assert fix.latitude_deg == pytest.approx(48.1173)
    assert fix.utc.second == 1


def test_sentences_that_come_in_pieces(clock):
    whole = gga("120000") + rmc("120000")
    fix, _ = read(clock, [(0.01 * index, whole[index : index + 1]) for index in range(len(whole))])
    assert fix.satellites == 8


def test_the_usual_speeds_are_tried_one_after_the_other(clock):
    bank = Bank(
        clock, {(URL, 38400): [(0.5, gga("120000")), (0.6, rmc("120000"))], (URL, 9600): [(0.3, b"\xf8\x80\n")]}
    )
    fix = read_nmea(URL, clock, open_link=bank)
    assert [baud for _url, baud in bank.opened] == [9600, 4800, 38400]
    assert fix.source.endswith("38400 baud")
    assert all(each.closed for each in bank.receivers)


def test_a_given_speed_is_the_only_one(clock):
    bank = Bank(clock, {(URL, 9600): [(0.5, gga("120000") + rmc("120000"))]})
    with pytest.raises(NoFix, match=r"No GPS receiver speaks NMEA at /dev/ttyACM0: 57600 baud nothing\.") as no:
        read_nmea(URL, clock, baud=57600, timeout_s=5.0, open_link=bank)
    assert no.value.reason == "silent"
    assert clock.monotonic() == pytest.approx(1005.0)


def test_without_a_fix_the_deadline_says_what_was_seen(clock):
    script = [
        (float(s), gga(f"1200{s:02}", quality=0, satellites=3) + rmc(f"1200{s:02}", status="V")) for s in range(60)
    ]
    with pytest.raises(NoFix, match=r"has no fix after 20 s \(3 satellites\)") as no:
        read(clock, script, timeout_s=20.0)
    assert no.value.reason == "no_fix"
    assert clock.monotonic() == pytest.approx(1020.0)


@pytest.mark.parametrize("quality", [0, 6, 7, 8])
def test_a_place_that_was_not_measured_is_none(clock, quality):
    with pytest.raises(NoFix, match="has no fix"):
        read(clock, [(0.5, gga("120000", quality=quality) + rmc("120000"))], timeout_s=5.0)


def test_a_receiver_that_sends_one_kind_alone(clock):
    fix, _ = read(clock, [(s + 0.5, rmc(f"12000{s}")) for s in range(5)])
    assert (fix.height_m, fix.satellites, fix.utc.second) == (None, None, 2)
    fix, _ = read(clock, [(s + 0.5, gga(f"12000{s}")) for s in range(5)])
    assert (fix.utc, fix.clock_offset_s, fix.satellites) == (None, None, 8)


def test_noise_without_an_end_does_not_grow(clock):
    with pytest.raises(NoFix, match="no sentence in what came") as no:
        read(clock, [(0.1 * index, b"\x55" * 4000) for index in range(200)], timeout_s=12.0)
    assert no.value.reason == "no_gps"


def test_a_stream_without_a_pause_ends_as_well(clock):
    class Flood(Receiver):
        reads = 0

        def pending(self):
            return True

        def read(self):
            self.reads += 1
            assert self.reads < 100, "nobody looks at the clock"
            clock.advance(0.5)
            return b"\x55\n"

    with pytest.raises(NoFix, match="no sentence in what came"):
        read_nmea(URL, clock, baud=9600, timeout_s=5.0, open_link=lambda url, _baud: Link(Flood(clock, url, []), clock))


def test_a_port_that_is_not_there_says_so(clock):
    with pytest.raises(LinkError, match="not there"):
        locate("/dev/ttyACM7", clock, open_link=Bank(clock, {}))


def test_the_port_of_the_dish_is_never_opened(clock, tmp_path):
    (tmp_path / "dish").touch()
    (tmp_path / "alias").symlink_to(tmp_path / "dish")
    bank = Bank(clock, {})
    with pytest.raises(NoFix, match="is where the dish is"):
        locate(str(tmp_path / "alias"), clock, dish_port=str(tmp_path / "dish"), open_link=bank)
    assert bank.opened == []


@pytest.mark.skipif(os.name != "posix", reason="pseudo terminals are a thing of Unix")
def test_on_a_real_pty():
    import pty

    controller, terminal = pty.openpty()
    done = threading.Event()

    def speak():
        while not done.wait(0.05):
            os.write(controller, gga("120000") + rmc("120000"))

    speaker = threading.Thread(target=speak, daemon=True)
    speaker.start()
    try:
        fix = read_nmea(os.ttyname(terminal), RealClock(), timeout_s=5.0)
    finally:
        done.set()
        speaker.join(5)
        os.close(controller)
        os.close(terminal)
    assert fix.satellites == 8

"""Sessions that are kept: the bytes in their order, said again with the same answers; a disk that is full."""

from __future__ import annotations

import io
import time
from datetime import UTC, datetime
from pathlib import Path

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.errors import ConfigError
from birdcage.rotctld.recorded_session import NAMES, Exchange, packaged_sessions, sessions_in
from birdcage.rotctld.session_lines import SessionDirection, SessionLine, parse_session_line
from birdcage.rotctld.session_recorder import SessionRecorder
from hypothesis import given
from hypothesis import strategies as st

from tests.rotctld.net_bench import NetBench

RECORDINGS = sorted((Path(__file__).parent / "recordings").glob("*.txt"))


@pytest.fixture
def bench():
    bench = NetBench().connect()
    bench.run(2.0)
    yield bench
    bench.close()


def said_again(bench, session):
    """Say a session to a server; return what each exchange was answered."""
    client = bench.join()
    for exchange in session:
        client.send(exchange.sent)
        came, end = b"", time.monotonic() + 5.0
        while came.count(b"\n") < exchange.lines and time.monotonic() < end:
            came += client.read() or b""
            bench.run(0.1)
        yield exchange, came


@given(st.binary(max_size=60), st.sampled_from(SessionDirection), st.integers(0, 10**6))
def test_a_line_of_any_bytes_reads_back_as_it_was(data, direction, client):
    line = SessionLine(datetime(2026, 11, 23, 15, 0, 0, 123000, UTC), client, direction, data)
    text = str(line)
    assert text.isascii()
    assert text.isprintable()
    assert not text.endswith(" ") or not data
    assert parse_session_line(text + "\n") == line


@pytest.mark.parametrize("line", ["", "p", "2026-11-23T15:00:00.000Z 1 > \\q", "2026-11-23T15:00:00.000Z 1 ? p"])
def test_what_is_no_line_is_refused(line):
    with pytest.raises(ValueError, match="no line of a session"):
        parse_session_line(line)


@pytest.mark.parametrize("name", NAMES)
def test_packaged_sessions_get_their_answers(bench, name):
    for session in packaged_sessions(name):
        for exchange, came in said_again(bench, session):
            assert exchange.fits(came), (exchange, came)


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda path: path.stem)
def test_recordings_get_their_answers(bench, path):
    for session in sessions_in(path.read_text("ascii")):
        for exchange, came in said_again(bench, session):
            assert exchange.fits(came), (exchange, came)


def test_what_clients_say_is_kept_and_said_again(tmp_path):
    path = tmp_path / "new" / "session.txt"
    recorder = SessionRecorder(path, RealClock(), pytest.fail)
    first = NetBench(recorder=recorder).connect()
    first.run(2.0)
    one, other = first.join(), first.join()
    assert one.ask(b"\\dump_st") == b""
    one.ask(b"ate\r\n")
    other.ask(b"p\nP 180 45\n\xff\\\n")
    one.ask(b"_\nq\n")
    first.close()
    recorder.close()
    text = path.read_text("ascii")
    assert next(line for line in text.splitlines() if " 2 > " in line).endswith(r" 2 > p\nP 180 45\n\xff\\\n")
    assert " 1 # connected from 127.0.0.1:" in text
    assert " 1 # gone: quit" in text
    sessions = list(sessions_in(text))
    assert [exchange.sent for exchange in sessions[0]] == [b"\\dump_state\r\n", b"_\nq\n"]
    again = NetBench().connect()
    again.run(2.0)
    try:
        told = [(exchange, came) for session in sessions for exchange, came in said_again(again, session)]
    finally:
        again.close()
    assert len(told) == 3
    assert all(exchange.fits(came) for exchange, came in told), told


@pytest.mark.parametrize(
    ("sent", "answer", "came", "fits"),
    [
        (b"p\n", b"1.00\n2.00\n", b"359.99\n18.25\n", True),
        (b"p\n", b"1.00\n2.00\n", b"RPRT -6\n", False),
        (b"p\n", b"1.00\n2.00\n", b"1.00 2.00\n", False),
        (b"P 1 2\n", b"RPRT 0\n", b"RPRT -9\n", False),
        (b"_\n", b"Carryout G2\n", b"Winegard Trav'ler RS-485 Rotor\n", True),
        (b"_\n", b"Carryout G2\n", b"RPRT -6\n", False),
    ],
)
def test_values_may_differ_and_nothing_else(sent, answer, came, fits):
    assert Exchange(sent, answer).fits(came) is fits


def test_it_goes_on_with_a_file_that_is_there(tmp_path):
    path = tmp_path / "session.txt"
    for word in ("first", "second"):
        recorder = SessionRecorder(path, RealClock(), pytest.fail)
        recorder.remark(0, word)
        recorder.close()
    assert [parse_session_line(line).data for line in path.read_text().splitlines()] == [b"first", b"second"]


def test_a_file_that_cannot_be_written_is_refused_at_once(tmp_path):
    with pytest.raises(ConfigError, match="can't be written"):
        SessionRecorder(tmp_path, RealClock(), pytest.fail)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_a_full_disk_is_told_once_and_serving_goes_on():
    told = []
    recorder = SessionRecorder(Path("/dev/full"), RealClock(), told.append, retry_s=0.0)
    bench = NetBench(recorder=recorder).connect()
    bench.run(2.0)
    client = bench.join()
    for _ in range(5):
        assert client.ask(b"p\n").count(b"\n") == 2
        recorder._writer.flush()
    bench.close()
    recorder.close()
    assert len(told) == 1
    assert told[0].startswith("/dev/full can't be written: No space left on device.")


class Disk(io.RawIOBase):
    """Takes half a line, then nothing, then all."""

    def __init__(self):
        super().__init__()
        self.kept, self.room = b"", 20

    def write(self, data):
        if self.room == 0:
            raise OSError(28, "No space left on device")
        taken = bytes(data[: self.room])
        self.kept += taken
        self.room -= len(taken)
        return len(taken)


def test_when_there_is_room_again_it_says_what_is_missing(tmp_path):
    told, disk = [], Disk()
    recorder = SessionRecorder(tmp_path / "session.txt", RealClock(), told.append, retry_s=0.0)
    recorder._file = disk
    for word in ("one", "two"):
        recorder.remark(0, word)
        recorder._writer.flush()
    disk.room = 10**6
    recorder.remark(0, "three")
    recorder.close()
    torn, missing, three = disk.kept.decode().splitlines()
    assert len(torn) == 20
    assert missing.endswith("0 # 2 lines are missing here: the disk was full or too slow")
    assert three.endswith("0 # three")
    assert len(told) == 1


def test_a_client_that_floods_does_not_fill_the_disk(tmp_path):
    told, path = [], tmp_path / "session.txt"
    recorder = SessionRecorder(path, RealClock(), told.append, most_bytes=1000)
    for _ in range(100):
        recorder.note(1, SessionDirection.CLIENT, b"p\n")
        recorder._writer.flush()
    recorder.close()
    assert path.stat().st_size <= 1000
    assert len(told) == 1
    assert "no more is recorded" in told[0]

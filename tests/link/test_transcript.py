from __future__ import annotations

import threading
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.link.transcript import Transcript
from birdcage.link.transcript_file import TranscriptFiles
from birdcage.link.transcript_line import Header, TranscriptEntry, escape, format_line, parse_line, unescape
from hypothesis import given
from hypothesis import strategies as st

NOON = datetime(2026, 3, 20, 12, 0, 0, 123456, tzinfo=UTC)
START = datetime(2000, 1, 1, tzinfo=UTC)


def stamps():
    return st.integers(0, 10**14).map(lambda microseconds: START + timedelta(microseconds=microseconds))


@given(stamps(), st.sampled_from("<>#"), st.binary())
def test_a_line_gives_its_bytes_back(utc, direction, data):
    line = format_line(TranscriptEntry(utc, direction, data))
    assert line.isascii()
    assert line.isprintable()
    assert not data or not line.endswith(" ")
    kept = utc.replace(microsecond=utc.microsecond // 1000 * 1000)
    assert parse_line(line + "\n") == TranscriptEntry(kept, direction, data)


@given(st.text(alphabet=r"\xrnt019af \ü"))
def test_only_what_escape_writes_is_read(text):
    try:
        data = unescape(text)
    except ValueError:
        return
    assert unescape(escape(data)) == data


def test_people_can_read_it():
    assert format_line(TranscriptEntry(NOON, ">", b"a 0 180\r")) == r"2026-03-20T12:00:00.123Z > a 0 180\r"
    assert format_line(TranscriptEntry(NOON, "<", b"\x00\xff\\ \r\n")) == r"2026-03-20T12:00:00.123Z < \x00\xff\\ \r\n"


@pytest.mark.parametrize("line", ["", "hello", "2026-03-20T12:00:00.123Z ? x", "2026-03-20T12:00:00.123Z > \\q"])
def test_what_is_no_line_is_refused(line):
    with pytest.raises(ValueError, match="transcript"):
        parse_line(line)


chunks = st.lists(st.tuples(st.sampled_from("<>"), st.binary(min_size=1, max_size=300)), max_size=20)


@given(chunks)
def test_files_hold_the_same_bytes_in_the_same_order(tmp_path_factory, parts):
    folder = tmp_path_factory.mktemp("wire")
    files = TranscriptFiles(folder)
    files.write([Header(NOON, "#", b"birdcage")], 0)
    for direction, data in parts:
        files.write([TranscriptEntry(NOON, direction, data)], 0)
    files.write([], 0)
    files.close()
    entries = [parse_line(line) for path in folder.glob("*") for line in path.read_text().splitlines()]
    assert runs([(each.direction, each.data) for each in entries if each.direction != "#"]) == runs(parts)


def runs(parts):
    joined = []
    for direction, data in parts:
        if joined and joined[-1][0] == direction:
            joined[-1][1] += data
        else:
            joined.append([direction, data])
    return joined


@pytest.fixture
def transcript(tmp_path):
    made = Transcript(tmp_path / "wire", version="0.1.0")
    yield made
    made.close()


def written(transcript):
    transcript.close()
    return [line[25:] for line in transcript.path.read_text().splitlines()]


def test_chunks_become_the_lines_of_the_dish(transcript):
    transcript.begin("/dev/ttyUSB0", demo=False, utc=NOON)
    transcript.record(">", b"a\r", NOON)
    for chunk in (b"a\r", b"\nAngle", b"[0] = 1.00\r\nAng", b"le[1] = 2.00\r\nMOT>"):
        transcript.record("<", chunk, NOON)
    transcript.record(">", b"q\r", NOON)
    assert written(transcript) == [
        "# birdcage 0.1.0 port /dev/ttyUSB0",
        r"> a\r",
        r"< a\r\n",
        r"< Angle[0] = 1.00\r\n",
        r"< Angle[1] = 2.00\r\n",
        "< MOT>",
        r"> q\r",
    ]


def test_the_first_line_of_a_demo_says_so(transcript):
    transcript.begin("sim:g2", demo=True, utc=NOON)
    transcript.remark("hello\nthere", NOON)
    assert written(transcript) == ["# birdcage 0.1.0 port sim:g2 DEMO (simulated dish)", r"# hello\nthere"]


def test_a_prompt_is_written_once_the_wire_is_quiet(transcript):
    transcript.begin("p", demo=False, utc=NOON)
    transcript.record("<", b"TRK>", NOON)
    seen = threading.Event()
    for _ in range(200):
        transcript.flush()
        if transcript.path and "TRK>" in transcript.path.read_text():
            break
        seen.wait(0.01)
    assert "< TRK>" in transcript.path.read_text()


def test_a_second_port_is_announced_in_the_same_file(transcript):
    transcript.begin("/dev/ttyUSB0", demo=False, utc=NOON)
    transcript.record("<", b"half", NOON)
    transcript.begin("/dev/ttyUSB1", demo=False, utc=NOON)
    assert written(transcript) == ["# birdcage 0.1.0 port /dev/ttyUSB0", "< half", "# birdcage 0.1.0 port /dev/ttyUSB1"]


def test_files_rotate_each_with_its_header_and_the_oldest_go(tmp_path):
    transcript = Transcript(tmp_path, version="0.1.0", file_limit=2000, total_limit=8000)
    transcript.begin("sim:g2", demo=True, utc=NOON)
    for number in range(1000):
        transcript.record("<", b"line %d\r\n" % number, NOON + timedelta(seconds=number))
    transcript.close()
    files = sorted(tmp_path.glob("*"))
    assert 2 <= len(files) <= 4
    assert sum(path.stat().st_size for path in files) <= 8200
    for path in files:
        assert path.read_text().splitlines()[0].endswith("# birdcage 0.1.0 port sim:g2 DEMO (simulated dish)")
    assert "line 999" in files[-1].read_text()


def test_events_that_do_not_fit_are_counted(tmp_path):
    files = TranscriptFiles(tmp_path)
    files.write([Header(NOON, "#", b"head"), TranscriptEntry(NOON, "<", b"a\n")], 0)
    files.write([TranscriptEntry(NOON, "<", b"z\n")], 3)
    files.close()
    lines = [line[25:] for line in files.path.read_text().splitlines()]
    assert lines == ["# head", r"< a\n", "# 3 events are missing here: the disk was too slow", r"< z\n"]


def test_what_waits_for_a_slow_disk_is_bounded_in_bytes(tmp_path, monkeypatch):
    """Chunks are as large as the system hands them out: so many of them say nothing of the memory they take."""
    disk, written = threading.Event(), []

    def slow(self, items, dropped):
        disk.wait(10)
        written.append((sum(len(item.data) for item in items), dropped))

    monkeypatch.setattr(TranscriptFiles, "write", slow)
    transcript = Transcript(tmp_path, version="0.1.0", queue_bytes=100_000)
    for _ in range(50):
        transcript.record("<", bytes(30_000), NOON)
    transcript.record("<", b"small", NOON)
    disk.set()
    transcript.close(10)
    assert max(size for size, _dropped in written) <= 100_000
    assert sum(dropped for _size, dropped in written) >= 44


def test_a_folder_that_cannot_be_written_is_a_problem_not_a_crash(tmp_path):
    (tmp_path / "wire").write_text("in the way")
    transcript = Transcript(tmp_path / "wire", version="0.1.0")
    transcript.begin("p", demo=False, utc=NOON)
    transcript.record("<", b"x\n", NOON)
    assert transcript.flush()
    assert "cannot be written" in transcript.problem
    transcript.close()


def test_listeners_hear_everything_at_once_and_can_leave():
    transcript = Transcript(None, version="0.1.0")
    heard = []
    leave = transcript.listen(heard.append)
    transcript.record(">", b"q\r", NOON)
    assert [(entry.direction, entry.text) for entry in heard] == [(">", r"q\r")]
    leave()
    transcript.record(">", b"q\r", NOON)
    assert len(heard) == 1
    assert transcript.path is None
    transcript.close()

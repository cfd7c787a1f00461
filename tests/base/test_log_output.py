"""Where log records go, and what they can't do to the program."""

from __future__ import annotations

import io
import logging
import re
import threading

import pytest
from birdcage.base.errors import ConfigError
from birdcage.base.log_output import FILES_KEPT, LogOutput

log = logging.getLogger("birdcage.station")


@pytest.fixture
def output():
    made = LogOutput(io.StringIO())
    yield made
    made.close()


def told(output):
    output.close()
    return output._stream.getvalue()


def test_once_shows_decisions_and_twice_exchanges_too(output):
    output.set(verbosity=1)
    log.info("the link is up")
    log.debug("> a")
    output.set(verbosity=2)
    log.debug("< Angle")
    lines = told(output).splitlines()
    assert [line.split(maxsplit=2)[1:] for line in lines] == [["station", "the link is up"], ["station", "< Angle"]]
    assert all(re.match(r"\d\d:\d\d:\d\d\.\d{3}Z ", line) for line in lines)


def test_a_file_gets_everything_and_stderr_nothing(output, tmp_path):
    file = tmp_path / "deep" / "birdcage.log"
    output.set(file=file)
    log.debug("> a 0 180")
    assert told(output) == ""
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT[\d:]+\.\d{3}Z station  > a 0 180\n", file.read_text())


def test_a_file_is_turned_over_and_older_ones_are_few(output, tmp_path, monkeypatch):
    monkeypatch.setattr("birdcage.base.log_output.FILE_BYTES", 2000)
    output.set(file=tmp_path / "a.log")
    for number in range(400):
        log.info("record %d", number)
    output.close()
    assert len(list(tmp_path.iterdir())) == 1 + FILES_KEPT
    assert "record 399" in (tmp_path / "a.log").read_text()


def test_what_comes_from_outside_stays_one_plain_line(output):
    output.set(verbosity=1)
    log.info("%s", "a\x1b]0;title\x07\r\nfaked \x9b2J \u202e")
    text = told(output)
    assert text.count("\n") == 1
    assert text.rstrip("\n").isprintable()


@pytest.mark.parametrize("name", ["/dev/null", "{folder}", "{file}/below"])
def test_a_file_that_cannot_be_written_is_refused_by_name(output, tmp_path, name):
    (tmp_path / "file").write_text("")
    path = type(tmp_path)(name.format(folder=tmp_path, file=tmp_path / "file"))
    with pytest.raises(ConfigError, match=r"\(--log\)"):
        output.set(file=path)


def test_a_full_disk_is_told_once_and_stops_nothing(output, tmp_path):
    output.set(file=tmp_path / "a.log")
    handler = output._file._handler

    class Full:
        def write(self, _text):
            raise OSError(28, "No space left on device")

        def flush(self):
            raise OSError(28, "No space left on device")

        def close(self):
            pass

        def tell(self):
            return 0

        def seek(self, *_):
            pass

    handler.stream.close()
    handler.stream = Full()
    log.info("lost")
    output._file._writer.flush()
    assert "No space left" in output.close()
    assert output._stream.getvalue() == ""


def test_a_terminal_that_takes_nothing_makes_nobody_wait():
    taken = threading.Event()

    class Held(io.StringIO):
        def write(self, _text):
            taken.wait(30)
            return 0

    output = LogOutput(Held())
    output.set(verbosity=1)
    for _ in range(20_000):
        log.info("more than the queue holds")  # it returns, though nothing was written
    taken.set()
    output.close()


def test_nothing_is_left_behind(output):
    before = list(logging.getLogger("birdcage").handlers)
    output.set(verbosity=2)
    output.close()
    assert logging.getLogger("birdcage").handlers == before
    assert not log.isEnabledFor(logging.DEBUG) or logging.getLogger().isEnabledFor(logging.DEBUG)

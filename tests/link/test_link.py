from __future__ import annotations

import threading

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.link.link import Link
from birdcage.link.transcript import Transcript


class SlowPort:
    """Takes its time for each byte, so that a second writer would get between."""

    name = "slow"
    demo = False

    def __init__(self):
        self.wire = b""
        self.arrived = b""
        self.error = None

    def fileno(self):
        return None

    def next_event(self):
        return None

    def pending(self):
        self._check()
        return bool(self.arrived)

    def read(self):
        self._check()
        data, self.arrived = self.arrived, b""
        return data

    def write(self, data):
        self._check()
        for byte in data:
            threading.Event().wait(0.0005)
            self.wire += bytes([byte])

    def discard(self):
        self._check()

    def close(self):
        pass

    def _check(self):
        if self.error is not None:
            raise self.error


@pytest.fixture
def port():
    return SlowPort()


def test_writes_of_two_threads_never_mix(port):
    heard = []
    transcript = Transcript(None, version="0")
    transcript.listen(heard.append)
    link = Link(port, VirtualClock(), transcript)
    threads = [
        threading.Thread(target=lambda data=data: [link.write(data) for _ in range(10)])
        for data in (b"aaaaaaaa", b"bbbbbbbb")
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    pieces = [port.wire[start : start + 8] for start in range(0, len(port.wire), 8)]
    assert sorted(pieces) == [b"aaaaaaaa"] * 10 + [b"bbbbbbbb"] * 10
    assert b"".join(entry.data for entry in heard if entry.direction == ">") == port.wire


def test_every_byte_is_in_the_transcript_with_its_time(port):
    heard = []
    transcript = Transcript(None, version="1.2")
    transcript.listen(heard.append)
    clock = VirtualClock()
    link = Link(port, clock, transcript)
    began = clock.utc()
    link.write(b"a\r")
    clock.advance(1.5)
    port.arrived = b"MOT>"
    assert link.read() == b"MOT>"
    assert link.read() == b""
    link.close()
    assert [(entry.direction, entry.data) for entry in heard] == [
        ("#", b"birdcage 1.2 port slow"),
        (">", b"a\r"),
        ("<", b"MOT>"),
        ("#", b"closed slow"),
    ]
    assert (heard[2].utc - began).total_seconds() == 1.5


@pytest.mark.parametrize("error", [ConnectionError("unplugged"), OSError(5, "Input/output error")])
@pytest.mark.parametrize("use", [Link.read, Link.pending, Link.discard, lambda link: link.write(b"x")])
def test_a_port_that_is_gone_is_lost_whatever_is_asked(port, error, use):
    link = Link(port, VirtualClock())
    port.error = error
    with pytest.raises(LinkError, match="slow is gone: unplugged") as lost:
        use(link)
    assert lost.value.reason == "lost"
    link.close()


def test_a_closed_link_says_so(port):
    link = Link(port, VirtualClock())
    link.close()
    link.close()
    assert link.fileno() is None
    for use in (link.read, link.pending, link.discard):
        with pytest.raises(LinkError, match="closed by this program"):
            use()
